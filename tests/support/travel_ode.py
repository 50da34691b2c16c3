"""A travelling crane with its load as two coordinates, the way and the angle of the ropes, integrated independently.

Nothing of ptmcalc's numerics or laws is in it: equations in the angle itself, DOP853, and levers of its own.
"""

import itertools
import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

FloatArray = NDArray[np.float64]
G = 9.81


@dataclass(frozen=True)
class Machine:
    """A crane as numbers; `ramp` is a commanded acceleration, else `force` acts at the rims, `rotor` before them."""

    starts: bool
    speed: float
    load: float
    body: float
    length: float
    rolling: float = 0.0
    wind: float = 0.0
    wind_on_load: float = 0.0
    hoisting: float = 0.0
    ramp: float | None = None
    force: float = 0.0
    rotor: float = 0.0
    rotor_braked: float = 0.0
    delay: float = 0.0
    rise: float = 0.0


@dataclass
class Seen:
    """What the integration saw."""

    time: float = math.nan
    distance: float = math.nan
    sway: float = 0.0
    residual: float = 0.0
    pulls: list[float] = field(default_factory=lambda: [math.inf, -math.inf])
    states: list[tuple[float, float, float, float]] = field(default_factory=list)
    """acceleration, pull against the travel, weight, traction over time"""


def _angle_rates(one: Machine, angle: float, rate: float, a: float, length: float, v: float) -> float:
    return (-G * math.sin(angle) - (a + one.wind_on_load / one.load) * math.cos(angle) - 2 * v * rate) / length


def _tension(one: Machine, angle: float, rate: float, a: float, length: float) -> float:
    inertia = one.load * (G * math.cos(angle) - a * math.sin(angle) + length * rate * rate)
    return inertia - one.wind_on_load * math.sin(angle)


def travel(one: Machine) -> Seen:
    """The start or stop, and two swings after it."""
    seen = Seen()
    lean = -math.atan(one.wind_on_load / (one.load * G))
    state = np.array([0.0, 0.0 if one.starts else one.speed, lean, 0.0])
    lasts = one.speed / one.ramp if one.ramp is not None else None
    if one.ramp is not None:
        a = one.ramp if one.starts else -one.ramp
        time, state = _leg(one, seen, state, 0.0, lambda t: ("ramp", a), lasts, None)
    elif one.starts:
        time, state = _leg(one, seen, state, 0.0, lambda t: ("force", one.force, one.rotor), None, one.speed)
    else:
        time = 0.0
        if one.delay:
            time, state = _leg(one, seen, state, 0.0, lambda t: ("force", 0.0, one.rotor), one.delay, None)
        began = time
        if one.rise:

            def rising(t: float) -> tuple[str, float, float]:
                return "force", -one.force * (t - began) / one.rise, one.rotor_braked

            time, state = _leg(one, seen, state, time, rising, one.rise, 0.0)
        if state[1] > 0:
            time, state = _leg(one, seen, state, time, lambda t: ("force", -one.force, one.rotor_braked), None, 0.0)
    seen.time, seen.distance = time, float(state[0])
    period = 2 * math.pi * math.sqrt(one.length / G)
    kind = "travel" if one.starts else "standing"
    shortest = one.length - one.hoisting * time
    final = Machine(**{**one.__dict__, "length": shortest, "hoisting": 0.0})
    state = np.array([state[0], one.speed if one.starts else 0.0, state[2], state[3]])
    after = Seen()
    _leg(final, after, state, 0.0, lambda t: ("ramp", 0.0, kind), 2.1 * period, None)
    seen.residual = after.sway
    seen.sway = max(seen.sway, after.sway)
    seen.pulls = [min(seen.pulls[0], after.pulls[0]), max(seen.pulls[1], after.pulls[1])]
    seen.states += after.states
    return seen


def _near_peaks(times: FloatArray, motion) -> list[FloatArray]:  # type: ignore[no-untyped-def]
    """Closer looks around the largest angles either way."""
    angles, closer = motion(times)[2], []
    for k in (int(angles.argmax()), int(angles.argmin())):
        low, high = times[max(k - 1, 0)], times[min(k + 1, len(times) - 1)]
        closer.append(np.linspace(low, high, 401))
    return closer


def _leg(one: Machine, seen: Seen, state: FloatArray, start: float, drive, lasts, until):  # type: ignore[no-untyped-def]
    def acceleration(t: float, y: FloatArray) -> float:
        what, value, *more = drive(t)
        if what == "ramp":
            return float(value)
        length = one.length - one.hoisting * t
        angle, rate = y[2], y[3]
        rope = one.load * (G * math.cos(angle) + length * rate * rate) - one.wind_on_load * math.sin(angle)
        net = value - one.rolling - one.wind + rope * math.sin(angle)
        return float(net / (one.body + more[0] + one.load * math.sin(angle) ** 2))

    def rates(t: float, y: FloatArray) -> list[float]:
        a = acceleration(t, y)
        length = one.length - one.hoisting * t
        return [y[1], a, y[3], _angle_rates(one, y[2], y[3], a, length, -one.hoisting)]

    events = None
    if until is not None:

        def reached(t: float, y: FloatArray) -> float:
            return float(y[1] - until)

        reached.terminal = True  # type: ignore[attr-defined]
        reached.direction = 1 if one.starts else -1  # type: ignore[attr-defined]
        events = reached
    end = start + (lasts if lasts is not None else 1e3)
    longest = math.sqrt(min(one.length, one.length - one.hoisting * (lasts or 0.0)) / G) / 20
    found = solve_ivp(
        rates, (start, end), state, "DOP853", events=events, rtol=1e-12, atol=1e-14, max_step=longest, dense_output=True
    )
    times = np.concatenate([np.linspace(a, b, 6)[:-1] for a, b in itertools.pairwise(found.t)] + [found.t[-1:]])
    times = np.unique(np.concatenate([times, *_near_peaks(times, found.sol)]))
    values = found.sol(times)
    for t, y in zip(times, values.T, strict=True):
        a = acceleration(t, y)
        length = one.length - one.hoisting * t
        rope = _tension(one, y[2], y[3], a, length)
        pull, weight = -rope * math.sin(y[2]), rope * math.cos(y[2])
        what, value, *more = drive(t)
        if what == "force":
            traction = value - more[0] * a
        elif more and more[0] == "standing":
            traction = one.wind + pull
        else:
            traction = one.body * a + one.rolling + one.wind + pull
        seen.states.append((a, pull, weight, traction))
        seen.sway = max(seen.sway, abs(float(y[2])))
        seen.pulls = [min(seen.pulls[0], pull), max(seen.pulls[1], pull)]
    return float(found.t[-1]), values[:, -1]
