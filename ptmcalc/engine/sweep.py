"""A sweep: which points, and where the verdict of a check turns along a key."""

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from pydantic_core import PydanticCustomError

from ptmcalc.base.errors import UsageError
from ptmcalc.contract.study import FloatArray, Points, Said, Track, Turning, VariedKey
from ptmcalc.engine.load import Loaded
from ptmcalc.engine.points import varied_key
from ptmcalc.spec.fields import Measure

MOST_POINTS, MOST_KEYS = 1_000_000, 20
_EXAMPLE = "takeup.tension=20 kN:60 kN:21"
_LOG = "log"


@dataclass(frozen=True, slots=True)
class Axis:
    """A key that goes from one value to another, evenly or by equal ratios, over so many points."""

    key: VariedKey
    start: float
    end: float
    count: int
    log: bool

    def at(self, parts: FloatArray) -> FloatArray:
        """Values at parts of the way."""
        if self.log:
            found: FloatArray = np.exp(math.log(self.start) + (math.log(self.end) - math.log(self.start)) * parts)
        else:
            found = self.start + (self.end - self.start) * parts
        least, most = sorted((self.start, self.end))
        return np.clip(found, least, most)


def axis(loaded: Loaded, text: str, *, counted: bool) -> Axis:
    """What `--vary` says: `KEY=from:to:n`, or `KEY=from:to` where the points are drawn; `:log` for equal ratios.

    Raises:
        UsageError: it says something else, or the key or a value is none of this file.
    """
    name, _, range_of = text.partition("=")
    parts = [part.strip() for part in range_of.split(":")]
    log = parts[-1] == _LOG
    parts = parts[:-1] if log else parts
    if not name.strip() or len(parts) != (3 if counted else 2) or not all(parts):
        form = f"KEY=from:to:n, e.g. `{_EXAMPLE}`" if counted else f"KEY=from:to, e.g. `{_EXAMPLE.rpartition(':')[0]}`"
        raise UsageError(f"`--vary {text}` is no range", f"write {form}; `:{_LOG}` behind it for equal ratios")
    key, measure = varied_key(loaded, name.strip())
    start, end = (_number(key, measure, part) for part in parts[:2])
    if counted and not (re.fullmatch("[0-9]{1,9}", parts[2]) and 1 <= int(parts[2]) <= MOST_POINTS):
        raise UsageError(
            f"`--vary {text}`: `{parts[2]}` is no number of points", f"write how many, at most {MOST_POINTS}, e.g. 21"
        )
    if log and min(start, end) <= 0:
        raise UsageError(f"`--vary {text}`: equal ratios need values above 0", f"leave `:{_LOG}` out")
    return Axis(key, start, end, int(parts[2]) if counted else 0, log)


def _number(key: VariedKey, measure: Measure, text: str) -> float:
    try:
        return measure.read(text)
    except PydanticCustomError as error:
        context = error.context or {}
        raise UsageError(f"`{key.name}`: {context['reason']}", context["hint"]) from None


def axes(loaded: Loaded, texts: Sequence[str], *, counted: bool) -> list[Axis]:
    """All keys of a sweep.

    Raises:
        UsageError: one of them is none, or stands there twice.
    """
    if not texts:
        raise UsageError("nothing varies", f"e.g. --vary '{_EXAMPLE}'")
    if len(texts) > MOST_KEYS:
        raise UsageError(f"{len(texts)} keys vary", f"at most {MOST_KEYS} in one sweep")
    found = [axis(loaded, text, counted=counted) for text in texts]
    names = [one.key.name for one in found]
    for name in names:
        if names.count(name) > 1:
            raise UsageError(f"`{name}` varies twice", "give each key once")
    return found


def grid(given: Sequence[Axis]) -> FloatArray:
    """All combinations, the last key fastest: shape (n, k).

    Raises:
        UsageError: they are too many.
    """
    count = math.prod(one.count for one in given)
    if count > MOST_POINTS:
        raise UsageError(f"that makes {count} points", f"at most {MOST_POINTS}; fewer, or --sample lhs --points N")
    columns = [one.at(np.linspace(0, 1, one.count)) for one in given]
    mesh = np.meshgrid(*columns, indexing="ij")
    return np.stack([column.ravel() for column in mesh], axis=1)


def hypercube(given: Sequence[Axis], count: int, seed: int) -> FloatArray:
    """Points drawn so that each key has one in each of `count` equal parts of its range: shape (n, k).

    **Source** McKay, Beckman and Conover, Technometrics 21 (1979) 239.
    """
    if not 1 <= count <= MOST_POINTS:
        raise UsageError(f"`--points {count}` is no number of points", f"write one from 1 to {MOST_POINTS}")
    chance = np.random.default_rng(seed)
    parts = [(chance.permutation(count) + chance.random(count)) / count for _ in given]
    return np.stack([one.at(part) for one, part in zip(given, parts, strict=True)], axis=1)


# -- where verdicts turn --------------------------------------------------------------------------------------------


def turnings(points: Points, given: Sequence[Axis]) -> list[Turning]:
    """Where the verdict of each check turns between pass and fail along each key of a grid."""
    shape = tuple(one.count for one in given)
    found = []
    for track in points.tracks.values():
        for number, one in enumerate(given):
            values, rising = _crossings(track, shape, number, one)
            if values.size:
                up, down = int(np.count_nonzero(rising)), int(np.count_nonzero(~rising))
                lines = math.prod(shape) // one.count
                ends = float(values.min()), float(values.max())
                place = (track.scene, track.code, track.element)
                found.append(Turning(*place, one.key, *ends, up, down, lines))
    return found


def _crossings(track: Track, shape: tuple[int, ...], number: int, one: Axis) -> tuple[FloatArray, NDArray[np.bool_]]:
    """Values of a key at which a check turns, on any line of the grid, and whether it passes above.

    Between a point that passes and one that fails, where a straight line through their margins is 0; in the middle
    where a margin is not finite.
    """
    said = np.moveaxis(track.said.reshape(shape), number, -1)
    margin = np.moveaxis(track.margin.reshape(shape), number, -1)
    before, after = said[..., :-1], said[..., 1:]
    rising = (before == Said.FAIL) & (after == Said.PASS)
    turns = rising | ((before == Said.PASS) & (after == Said.FAIL))
    at = np.nonzero(turns)
    first, second = margin[..., :-1][at], margin[..., 1:][at]
    with np.errstate(all="ignore"):
        part = first / (first - second)
    part = np.where(np.isfinite(part) & np.isfinite(first) & np.isfinite(second), np.clip(part, 0, 1), 0.5)
    return one.at((at[-1] + part) / max(one.count - 1, 1)), rising[at]


def lowest(points: Points) -> Iterator[tuple[Track, int]]:
    """Each check with the number of the point at which its margin is least; -1 where it has none."""
    for track in points.tracks.values():
        margin = np.where(np.isnan(track.margin), np.inf, track.margin)
        known = bool(np.any(~np.isnan(track.margin)))
        yield track, int(np.argmin(margin)) if known else -1
