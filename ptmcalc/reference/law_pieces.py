"""Pieces of a torque curve of straight lines: where a body stands, and the line there."""

from bisect import bisect_right

from ptmcalc.numerics.train.parts import Straight


def _pieces(law: Straight) -> tuple[int, int]:
    """The first piece and the last one: -1 and the last knot where the torque is constant beyond its ends."""
    last = len(law.knots) - 1
    return (0, last - 1) if law.extends and last > 0 else (-1, last)


def _knot(law: Straight, index: int) -> float:
    if not law.period:
        return law.knots[index]
    turns, index = divmod(index, len(law.knots) - 1)
    return law.knots[index] + turns * law.period


def piece_of(law: object, speed: float, position: float) -> int:
    """The piece of a law in which a body stands."""
    if not isinstance(law, Straight):
        return 0
    x = speed if law.on == "speed" else position
    if law.period:
        turns = int((x - law.knots[0]) // law.period)
        inside = x - turns * law.period
        within = min(max(bisect_right(law.knots, inside) - 1, 0), len(law.knots) - 2)
        return turns * (len(law.knots) - 1) + within
    first, last = _pieces(law)
    return min(max(bisect_right(law.knots, x) - 1, first), last)


def ends(law: Straight, piece: int) -> tuple[float | None, float | None]:
    """Where a piece begins and ends."""
    if law.period:
        return _knot(law, piece), _knot(law, piece + 1)
    first, last = _pieces(law)
    return (law.knots[piece] if piece > first else None), (law.knots[piece + 1] if piece < last else None)


def line(law: Straight, piece: int) -> tuple[tuple[float, float], float]:
    """A point of a piece and its slope."""
    last = len(law.knots) - 1
    if law.period:
        index = piece % last
        slope = (law.values[index + 1] - law.values[index]) / (law.knots[index + 1] - law.knots[index])
        return (_knot(law, piece), law.values[index]), slope
    if 0 <= piece < last:
        run = law.knots[piece + 1] - law.knots[piece]
        return (law.knots[piece], law.values[piece]), (law.values[piece + 1] - law.values[piece]) / run
    index = 0 if piece < 0 else last
    return (law.knots[index], law.values[index]), 0.0
