"""Torques in their stages and pieces: the functional that holds, what ends it, what comes next."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ptmcalc.numerics.motion import Curve
from ptmcalc.numerics.train.parts import Drive, Governed, Law, Smooth, Stage, Straight
from ptmcalc.numerics.train.signals import FloatArray, Now, Signal

DriveState = tuple[int, int]
"""Stage, and the piece of its law: of a straight line (-1 before the first knot), or -1, 0, 1 of a limited control."""


@dataclass(frozen=True, slots=True)
class Place:
    """A body's speed and position as functionals, the functional 1, and what signals are now."""

    speed: FloatArray
    position: FloatArray
    one: FloatArray
    signals: "SignalRows"

    def argument(self, on: str) -> FloatArray:
        return self.speed if on == "speed" else self.position


class SignalRows:
    """Functionals of the signals of a system in one mode."""

    def __init__(self, rows: dict[Signal, FloatArray], pieces: dict[Signal, Now]) -> None:
        self.rows, self.pieces = rows, pieces

    def __getitem__(self, signal: Signal) -> FloatArray:
        return self.rows[signal]

    def level(self, signal: Signal) -> float:
        """The value of a signal of steps."""
        now = self.pieces[signal]
        return signal.values[now.piece] if now.piece >= 0 else signal.before


def signals_of(drive: Drive) -> Iterator[Signal]:
    """Every signal a drive depends on."""
    yield drive.gate
    for stage in drive.stages:
        if isinstance(stage.law, Signal):
            yield stage.law
        elif isinstance(stage.law, Governed):
            yield stage.law.reference


def active_law(drive: Drive, state: DriveState) -> Law:
    """The law of the present stage."""
    return drive.stages[state[0]].law


def knot(law: Straight, index: int) -> float:
    """Position of a knot; periodic ones go on to both sides."""
    if not law.period:
        return law.knots[index]
    turns, index = divmod(index, len(law.knots) - 1)
    return law.knots[index] + turns * law.period


def piece_at(law: Straight, place: float) -> int:
    """The piece that holds at a place."""
    if law.period:
        turns, inside = divmod(place - law.knots[0], law.period)
        base = int(turns) * (len(law.knots) - 1)
        return base + max(int(np.searchsorted(law.knots, law.knots[0] + inside, "right")) - 1, 0)
    found = int(np.searchsorted(law.knots, place, "right")) - 1
    if law.extends and len(law.knots) > 1:
        return min(max(found, 0), len(law.knots) - 2)
    return found


def drive_row(drive: Drive, state: DriveState, at: Place) -> FloatArray:
    """The torque as a functional, without what a curve adds."""
    gate = at.signals.level(drive.gate)
    law, piece = active_law(drive, state), state[1]
    if gate == 0 or isinstance(law, Smooth):
        return np.zeros_like(at.one)
    if isinstance(law, Signal):
        return gate * at.signals[law]
    if isinstance(law, Governed):
        if piece:
            return gate * piece * law.limit * at.one
        return gate * law.stiffness * (at.signals[law.reference] - at.speed)
    first, second = _values(law, piece)
    if first[0] == second[0]:
        return gate * first[1] * at.one
    slope = (second[1] - first[1]) / (second[0] - first[0])
    return gate * (first[1] * at.one + slope * (at.argument(law.on) - first[0] * at.one))


def _values(law: Straight, piece: int) -> tuple[tuple[float, float], tuple[float, float]]:
    """Two points of the line that a piece is; twice the same one where it is constant."""
    last = len(law.knots) - 1
    if law.period:
        index = piece % last
        return (knot(law, piece), law.values[index]), (knot(law, piece + 1), law.values[index + 1])
    if 0 <= piece < last:
        return (law.knots[piece], law.values[piece]), (law.knots[piece + 1], law.values[piece + 1])
    end = (law.knots[0], law.values[0]) if piece < 0 else (law.knots[last], law.values[last])
    return end, end


def drive_curve(drive: Drive, state: DriveState, at: Place) -> Curve | None:
    """The torque of a smooth law."""
    gate = at.signals.level(drive.gate)
    law = active_law(drive, state)
    if gate == 0 or not isinstance(law, Smooth):
        return None
    return Curve(
        at.argument(law.on)[None],
        lambda y: gate * law.value(y[0]),
        lambda y: gate * law.slope(float(y[0])),
        abs(gate) * law.size,
        abs(gate) * law.grain,
    )


def drive_guards(drive: Drive, state: DriveState, at: Place) -> Iterator[tuple[FloatArray, DriveState]]:
    """What keeps a stage and a piece, and what follows. A drive that is off still goes through its pieces."""
    number, piece = state
    stage, law = drive.stages[number], active_law(drive, state)
    if stage.until is not None and number + 1 < len(drive.stages):
        yield stage.until * at.one - at.speed, (number + 1, 0)
    if isinstance(law, Straight):
        x, last = at.argument(law.on), len(law.knots) - 1
        inner = bool(law.period) or 0 <= piece < last
        low = bool(law.period) or (piece > 0 if law.extends else piece >= 0)
        high = bool(law.period) or (piece < last - 1 if law.extends else piece < last)
        if low and (inner or piece == last):
            yield x - knot(law, piece) * at.one, (number, piece - 1)
        if high:
            yield knot(law, piece + 1) * at.one - x, (number, piece + 1)
    elif isinstance(law, Governed):
        free = law.stiffness * (at.signals[law.reference] - at.speed)
        if piece == 0:
            yield law.limit * at.one - free, (number, 1)
            yield law.limit * at.one + free, (number, -1)
        else:
            yield piece * free - law.limit * at.one, (number, 0)


def law_now(law: Law, speed: float, position: float) -> int:
    """The piece a law starts in."""
    if isinstance(law, Straight):
        return piece_at(law, speed if law.on == "speed" else position)
    return 0


def stage_breaks(drive: Drive, state: DriveState) -> float:
    """The time at which the present stage ends by itself."""
    stage: Stage = drive.stages[state[0]]
    if stage.until_time is None or state[0] + 1 >= len(drive.stages):
        return float("inf")
    return stage.until_time
