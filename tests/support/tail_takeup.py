"""A belt with a take-up weight that pulls its tail pulley, as masses and springs: imports nothing from `ptmcalc`.

The tail pulley turns with the mean of both belt speeds and moves with half of their difference:

    v_before = q + x,   v_after = q - x
    (m_b + m_a + m_t) q' + (m_b - m_a) x' = S_after - S_before - R sgn q
    (m_b - m_a) q' + (m_b + m_a + M) x' = 2 T - S_before - S_after

with the half elements m_b, m_a on both sides, the pulley m_t at its surface and the weight M. Explicit steps in time at
half the limit of stability; Coulomb friction by its return map.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from support.belt_fem import Length
from support.belt_scenes import Rig


@dataclass(frozen=True)
class Course:
    """Over time: tensions at the drive, its speed, position of the carriage [m], extremes of the whole belt."""

    times: np.ndarray
    on: np.ndarray
    off: np.ndarray
    speed: np.ndarray
    carriage: np.ndarray
    highest: float
    lowest: float


@dataclass
class _Strand:
    """A strand in elements: its nodes from the upstream end on."""

    stiffness: np.ndarray
    mass: np.ndarray
    friction: np.ndarray
    climb: np.ndarray
    tension: np.ndarray
    speed: np.ndarray


def _strand(lengths: tuple[Length, ...], size: float, start: float, speed: float) -> _Strand:
    parts = [(one, max(round(one.length / size), 2)) for one in lengths]
    h = np.concatenate([np.full(n, one.length / n) for one, n in parts])

    def of(name: str) -> np.ndarray:
        return np.concatenate([np.full(n, getattr(one, name)) for one, n in parts])

    def lumped(per_length: np.ndarray) -> np.ndarray:
        return np.append(per_length * h, 0.0) / 2 + np.append(0.0, per_length * h) / 2

    rises = (of("friction") + of("climb")) * h
    tension = start + np.cumsum(rises) - rises / 2
    nodes = [lumped(of(name)) for name in ("line_mass", "friction", "climb")]
    return _Strand(of("stiffness") / h, *nodes, tension, np.full(len(h) + 1, speed))


def _slid(speed: np.ndarray, impulse: np.ndarray) -> np.ndarray:
    return np.copysign(np.maximum(np.abs(speed) - impulse, 0.0), speed)


def simulate(
    rig: Rig,
    window: float,
    force: Callable[[float], float],
    weight: float,
    tail_force: float = 0.0,
    begins: float = 0.0,
    factor: float = 1.0,
    elements: int = 160,
) -> Course:
    """A belt from its running tensions and one speed on, its only drive at the head.

    Args:
        rig: the machine; its tension is half the force of the carriage.
        window: [s].
        force: rim force of the drive over time [N]; the drive is held until it exceeds the static pull.
        weight: mass that the carriage moves [kg].
        tail_force: resistance at the tail [N].
        begins: belt speed at the start [m/s].
        factor: resistance relative to that in running.
        elements: of the whole belt.
    """
    lengths = rig.lengths(factor=factor)
    half, (drive,) = len(lengths) // 2, rig.drives.values()
    size = sum(one.length for one in lengths) / elements
    rise = sum(one.length * (one.friction + one.climb) for one in lengths[:half])
    back = _strand(lengths[:half], size, rig.tension - tail_force / 2 - rise, begins)
    carry = _strand(lengths[half:], size, rig.tension + tail_force / 2, begins)
    strands = (back, carry)
    quick = max(float((part.stiffness * (1 / part.mass[1:] + 1 / part.mass[:-1])).max()) for part in strands)
    step = 0.5 * 2 / math.sqrt(quick)
    ends = back.mass[-1], carry.mass[0]
    inertia = np.array(
        [
            [sum(ends) + rig.tail_mass, ends[0] - ends[1]],
            [ends[0] - ends[1], sum(ends) + weight],
        ]
    )
    inverse = np.linalg.inv(inertia)
    rubs = back.friction[-1] + carry.friction[0] + tail_force
    rising = back.climb[-1], carry.climb[0]
    at_drum, drags = drive.mass + back.mass[0] + carry.mass[-1], back.friction[0] + carry.friction[-1]
    climbs = back.climb[0] + carry.climb[-1]
    q = x = 0.0
    q, drum, moved, loose, held = begins, begins, 0.0, begins > 0, False
    rows, high, low = [], -math.inf, math.inf
    steps = math.ceil(window / step)
    for k in range(steps):
        time = (k + 1) * step
        for part in strands:
            part.tension += part.stiffness * np.diff(part.speed) * step
            pulls = np.diff(part.tension) - part.climb[1:-1]
            inner = part.speed[1:-1] + pulls / part.mass[1:-1] * step
            part.speed[1:-1] = _slid(inner, part.friction[1:-1] / part.mass[1:-1] * step)
        before, after = back.tension[-1], carry.tension[0]
        given = np.array([after - before - sum(rising), 2 * rig.tension - before - after - rising[0] + rising[1]])
        free = np.array([q, x]) + inverse @ given * step
        most = rubs * step
        impulse = max(-most, min(most, free[0] / inverse[0, 0]))
        q, x = free - inverse[:, 0] * impulse
        back.speed[-1], carry.speed[0] = q + x, q - x
        moved += x * step
        pull = force(time)
        on, off = carry.tension[-1], back.tension[0]
        loose = loose or pull > on - off + climbs + drags
        if loose and not held:
            drum += (pull + off - on - climbs) / at_drum * step
            drum = math.copysign(max(abs(drum) - drags / at_drum * step, 0.0), drum)
            held = pull > 0 and drum >= rig.speed
        if held:
            drum = rig.speed
        back.speed[0] = carry.speed[-1] = drum
        sense = 1.0 if drum > 0 or time < 1e-9 or not loose else 0.0
        rate = 0.0 if held or not rows else (drum - rows[-1][3]) / step
        on += sense * carry.friction[-1] + carry.climb[-1] + carry.mass[-1] * rate
        off -= sense * back.friction[0] + back.climb[0] + back.mass[0] * rate
        rows.append((time, on, off, drum, moved))
        high = max(high, float(back.tension.max()), float(carry.tension.max()), on)
        low = min(low, float(back.tension.min()), float(carry.tension.min()), off)
    return Course(*np.array(rows).T, high, low)
