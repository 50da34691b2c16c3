"""A wheel that may leave its rail, and a column that a tilting base swings: both as one mass on a spring."""

import math
from collections.abc import Iterator

from ptmcalc.laws import rail, vibration
from ptmcalc.machines.crane.stacking.events import Roll, Swinger
from ptmcalc.machines.crane.stacking.marching import Played, Reading
from ptmcalc.numerics.train.parts import LINEAR, NO_PULL, Body, Drive, Spring, Train
from ptmcalc.numerics.train.signals import Signal, Sine

MASS, WHEEL, COLUMN = "machine", "wheel", "column"
_PERIODS = 3


def _pulse(name: str, size: float, way: float, speed: float, half_turns: int, since: float = 0.0) -> Drive:
    """A force `size` cos(O t) while a wheel passes a way: half a turn or a whole one."""
    lasts = way / speed
    rate = half_turns * math.pi / lasts
    law = Signal(sines=(Sine(size, rate, math.pi / 2 - rate * since),))
    times, values = (0.0, lasts), (1.0, 0.0)
    if since:
        times, values = (0.0, since, since + lasts), (0.0, 1.0, 0.0)  # type: ignore[assignment]
    return Drive.of(name, 0, law, Signal(times, values, (0.0,) * len(times)))


def _passes(roll: Roll) -> Iterator[tuple[str, float, int, float]]:
    """What is run over: (name, way of the wheel over it, half turns, side on which it begins)."""
    if roll.step:
        climb = math.sqrt(2 * roll.step * roll.radius)
        yield "step up", climb, 1, 1.0
        yield "step down", climb, 1, -1.0
    if roll.gap:
        yield "gap", roll.gap, 2, -1.0


def machine_trains(roll: Roll, law: str = NO_PULL) -> Iterator[tuple[Train, float]]:
    """The machine on a wheel that cannot pull, seen from the wheel's path, for each step and gap; with the time to
    look. Its mass is 1 kg: forces are accelerations. With a linear law the wheel is held to the rail."""
    spring = roll.frequency**2
    for name, way, half_turns, side in _passes(roll):
        body = Body(MASS, 1.0)
        damper = 2 * roll.damping * roll.frequency
        side_of = -1 if law == NO_PULL else 0
        rest = roll.gravity / spring
        wheel = Spring(WHEEL, 0, None, spring, damper, law=law, side=side_of, rest=rest)
        drives = (
            Drive.of("weight", 0, Signal.constant(-roll.gravity)),
            _pulse(name, -side * roll.acceleration, way, roll.speed, half_turns),
        )
        window = way / roll.speed + _PERIODS * 2 * math.pi / roll.frequency
        # a machine thrown up comes down as late as its speed has it
        window += 4 * roll.acceleration / roll.gravity * min(way / roll.speed, 1 / roll.frequency)
        yield Train((body,), springs=(wheel,), drives=drives), window


def wheel_readings(played: Played, gravity: float) -> dict[str, Reading]:
    """Largest and least load of the wheel over the static one."""
    low, when = played.bottom("link", played.link(WHEEL))
    high, then = played.top("link", played.link(WHEEL))
    return {"phi4": (-low / gravity, when), "rail_contact": (-high / gravity, then)}


def column_trains(roll: Roll, column: Swinger) -> Iterator[tuple[Train, float]]:
    """The column's mode, of 1 kg, over a base whose wheels run over a step or a gap one after the other."""
    apart = roll.base / roll.speed
    size = column.driven * roll.acceleration / roll.base
    for name, way, half_turns, side in _passes(roll):
        if name == "step down":
            continue  # the same with the other sign
        spring = Spring(COLUMN, 0, None, column.frequency**2, law=LINEAR)
        drives = (
            _pulse("front wheel", side * size, way, roll.speed, half_turns),
            _pulse("rear wheel", -side * size, way, roll.speed, half_turns, apart),
        )
        window = apart + way / roll.speed + 2 * math.pi / column.frequency
        yield Train((Body(COLUMN, 1.0),), springs=(spring,), drives=drives), window


def column_readings(played: Played, column: Swinger) -> dict[str, Reading]:
    """Swing of the head of the column from its place on the tilted base, and what the column feels of it.

    The moment at the root is that of the masses that swing, with their levers.
    """
    force, when = played.largest("link", played.link(COLUMN))
    return {name: (value, when) for name, value in swing_loads(force / column.frequency**2, column).items()}


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
