"""A wheel that may leave its rail, and a column that a tilting base swings: both as one mass on a spring."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from ptmcalc.laws import rail, vibration
from ptmcalc.machines.crane.stacking.machine.marching import Played, Reading, Stages, play
from ptmcalc.machines.crane.stacking.rail.base import Roll, Swinger
from ptmcalc.numerics.train.parts import LINEAR, NO_PULL, Body, Drive, Spring, Train
from ptmcalc.numerics.train.signals import Signal, Sine

MASS, WHEEL, COLUMN = "machine", "wheel", "column"
DOWN = "step down"
_PERIODS = 3
"""Periods [1] of the machine on its wheels that are simulated after a step or gap. A numerical choice: the free
vibration of one damped mode has its extremes in the first period. Fewer may miss an impact after lift-off; more cost
time."""


@dataclass(frozen=True, slots=True)
class Pulse:
    """What a wheel runs over: its path begins with a cosine of acceleration that lasts so long, a half turn of it or a
    whole one, upward or downward."""

    name: str
    lasts: float
    half_turns: int
    side: float

    def force(self, size: float) -> Drive:
        """A force `size` cos(O t) on the first body."""
        wave = Sine(self.side * size, self.half_turns * math.pi / self.lasts, math.pi / 2)
        return Drive.of(self.name, 0, Signal(sines=(wave,)))


def pulses(roll: Roll) -> Iterator[Pulse]:
    """All that is run over."""
    if roll.step:
        climb = math.sqrt(2 * roll.step * roll.radius) / roll.speed
        yield Pulse("step up", climb, 1, 1.0)
        yield Pulse(DOWN, climb, 1, -1.0)
    if roll.gap:
        yield Pulse("gap", roll.gap / roll.speed, 2, -1.0)


def _ends(played: Played) -> tuple[float, float]:
    """Position and speed of the body at the end of a run."""
    return played.last("position", 0), played.last("speed", 0)


# -- the machine on its wheel ---------------------------------------------------------------------------------------


def machine_stages(roll: Roll, pulse: Pulse, law: str = NO_PULL, longer: float = 1.0) -> Stages:
    """The machine on a wheel that cannot pull, seen from the wheel's path, over a step or gap and for three periods
    behind it, or `longer` times that. Its mass is 1 kg: forces are accelerations. With a linear law the wheel is held
    to the rail."""
    spring, damper = roll.frequency**2, 2 * roll.damping * roll.frequency
    side = -1 if law == NO_PULL else 0
    weight = Drive.of("weight", 0, Signal.constant(-roll.gravity))
    wheel = Spring(WHEEL, 0, None, spring, damper, law=law, side=side, rest=roll.gravity / spring)
    window = longer * _PERIODS * 2 * math.pi / roll.frequency
    # a machine thrown up comes down as late as its speed has it
    window += 4 * roll.acceleration / roll.gravity * min(pulse.lasts, 1 / roll.frequency)

    def stages(refined: float) -> tuple[Sequence[Played], Mapping[str, Reading]]:
        over = Train((Body(MASS, 1.0),), springs=(wheel,), drives=(weight, pulse.force(-roll.acceleration)))
        first = play(over, pulse.lasts, refined)
        behind = Train((Body(MASS, 1.0, *_ends(first)),), springs=(wheel,), drives=(weight,))
        second = play(behind, window, refined)
        top, low = (
            max(
                ((sign * played.largest_of(sign, WHEEL)[0], since + played.largest_of(sign, WHEEL)[1]))
                for played, since in ((first, 0.0), (second, pulse.lasts))
            )
            for sign in (-1, 1)
        )
        return (first, second), {
            "phi4": (top[0] / roll.gravity, top[1]),
            "rail_contact": (-low[0] / roll.gravity, low[1]),
        }

    return stages


# -- the column over its base ---------------------------------------------------------------------------------------


def column_stages(roll: Roll, column: Swinger, pulse: Pulse) -> Stages:
    """The column's mode, of 1 kg, over a base whose wheels run over a step or a gap one after the other.

    In between and behind it swings freely: its amplitude is that of the state at the end of the pulse.
    """
    size, w = column.driven * roll.acceleration / roll.base, column.frequency
    spring = Spring(COLUMN, 0, None, w**2, law=LINEAR)
    pause = max(roll.base / roll.speed - pulse.lasts, 0.0)

    def stages(refined: float) -> tuple[Sequence[Played], Mapping[str, Reading]]:
        front = play(Train((Body(COLUMN, 1.0),), springs=(spring,), drives=(pulse.force(-size),)), pulse.lasts, refined)
        x, v = _ends(front)
        between, turned = _free_top(x, v, w, pause), w * pause
        start = x * math.cos(turned) + v / w * math.sin(turned), v * math.cos(turned) - x * w * math.sin(turned)
        rear = play(
            Train((Body(COLUMN, 1.0, *start),), springs=(spring,), drives=(pulse.force(size),)), pulse.lasts, refined
        )
        x, v = _ends(rear)
        inside = max(one.largest("link", 0)[0] / w**2 for one in (front, rear))
        swing = max(inside, between, math.hypot(x, v / w))
        return (front, rear), {name: (value, None) for name, value in swing_loads(swing, column).items()}

    return stages


def _free_top(x: float, v: float, w: float, time: float) -> float:
    """Largest deflection of a free swing from a state on, within a time."""
    top = math.hypot(x, v / w)
    phase = math.atan2(v / w, x) % math.pi  # to the next turn
    end = abs(x * math.cos(w * time) + v / w * math.sin(w * time))
    return top if phase <= w * time else max(abs(x), end)


def swing_loads(swing: float, column: Swinger) -> dict[str, float]:
    """What a swing at the carriage comes to [m, N, N*m]."""
    force = column.stiffness * swing
    return {
        "mast_deflection_max": column.outreach * swing,
        "mast_force_max": force,
        "mast_moment_max": force * column.driven,
    }


# -- waves ----------------------------------------------------------------------------------------------------------


def wave_share(roll: Roll) -> float:
    """What even waves add to the wheel loads at most, and take off, over the static ones; infinite in resonance
    without damping; 0 without waves."""
    if not roll.wave_length:
        return 0.0
    size = rail.waviness_acceleration(roll.speed, roll.wave_length, roll.wave_height) / roll.gravity
    return size * float(vibration.transmissibility(roll.wave_rate / roll.frequency, roll.damping))


def wave_swing(roll: Roll, column: Swinger) -> float:
    """Steady swing of the head of the column on even waves; its wheels a wheel base apart [m].

    x = H (s/B) h |sin(pi B/lambda)| O^2/|w^2 - O^2|
    """
    if not roll.wave_length:
        return 0.0
    tilt = roll.wave_height * abs(math.sin(math.pi * roll.base / roll.wave_length)) / roll.base
    ratio = roll.wave_rate / column.frequency
    gap = abs((1 - ratio) * (1 + ratio))
    size = column.driven * tilt * ratio**2
    return size / gap if gap else (math.inf if size else 0.0)


def detuning(roll: Roll) -> float:
    """Least distance of the waves' frequency from those of wheels and column, over these; infinite without waves."""
    modes = [roll.frequency] + ([roll.column.frequency] if roll.column is not None else [])
    if not roll.wave_length:
        return math.inf
    return min(abs(roll.speed / rail.resonance_speed(mode, roll.wave_length) - 1) for mode in modes)
