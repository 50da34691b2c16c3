"""A sweep: which points, and where the verdict of a check turns along a key."""

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from pydantic_core import PydanticCustomError

from ptmcalc.base.errors import UsageError
from ptmcalc.contract.study import FloatArray, Points, Said, Stretch, Track, Turning, VariedKey
from ptmcalc.engine.load import Loaded
from ptmcalc.engine.points import varied_key
from ptmcalc.spec.fields import Measure

MOST_POINTS, MOST_KEYS = 1_000_000, 20
"""Limits of a sweep; numerical choices. `MOST_POINTS`: points. `MOST_KEYS`: keys that vary. Both together take 160 MB
of values. Larger limits need more memory; smaller ones refuse long sweeps earlier."""
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
        """Values at parts of the way; of a key that takes whole numbers the nearest ones."""
        if self.log:
            found: FloatArray = np.exp(math.log(self.start) + (math.log(self.end) - math.log(self.start)) * parts)
        else:
            found = self.start + (self.end - self.start) * parts
        least, most = sorted((self.start, self.end))
        return np.clip(np.rint(found) if self.key.whole else found, least, most)

    def drawn(self, parts: FloatArray) -> FloatArray:
        """Values at parts of the way that are drawn; every whole number is as likely as the others."""
        if not self.key.whole:
            return self.at(parts)
        least, most = sorted((self.start, self.end))
        return np.clip(least + np.floor((most - least + 1) * parts), least, most)


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
        raise UsageError(f"`--vary {text}` is not a range", f"write {form}; `:{_LOG}` behind it for equal ratios")
    key, measure = varied_key(loaded, name.strip())
    start, end = (_number(key, measure, part) for part in parts[:2])
    if counted and not (re.fullmatch("[0-9]{1,9}", parts[2]) and 1 <= int(parts[2]) <= MOST_POINTS):
        raise UsageError(
            f"`--vary {text}`: `{parts[2]}` is not a number of points",
            f"write how many, at most {MOST_POINTS}, e.g. 21",
        )
    if log and min(start, end) <= 0:
        raise UsageError(f"`--vary {text}`: equal ratios need values above 0", f"leave `:{_LOG}` out")
    count = int(parts[2]) if counted else 0
    if key.whole and (log or (count > 1 and (end - start) % (count - 1))):
        hint = f"write e.g. `{key.name}={start:g}:{end:g}:{abs(int(end - start)) + 1}`"
        raise UsageError(
            f"`--vary {text}`: `{key.name}` takes whole numbers, and some of these values are not whole numbers", hint
        )
    return Axis(key, start, end, count, log)


def _number(key: VariedKey, measure: Measure, text: str) -> float:
    try:
        number = measure.read(text)
        if key.whole and not number.is_integer():
            raise UsageError(f"`{key.name}` takes whole numbers, and `{text}` is not one", "write e.g. 2")
        return number
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
        raise UsageError(f"`--points {count}` is not a number of points", f"write one from 1 to {MOST_POINTS}")
    chance = np.random.default_rng(seed)
    parts = [(chance.permutation(count) + chance.random(count)) / count for _ in given]
    return np.stack([one.drawn(part) for one, part in zip(given, parts, strict=True)], axis=1)


# -- where verdicts turn --------------------------------------------------------------------------------------------


def turnings(points: Points, given: Sequence[Axis]) -> list[Turning]:
    """Where the verdict of each check changes along each key of a grid."""
    shape = tuple(one.count for one in given)
    found = []
    for track in points.tracks.values():
        for number, one in enumerate(given):
            stretches = tuple(_stretches(track, shape, number, given))
            if stretches:
                ends = _ends(stretches, one)
                up, down = _turns(stretches)
                lines = math.prod(shape) // one.count
                place = (track.scene, track.code, track.element)
                others = tuple(other.key for other in given if other is not one)
                found.append(Turning(*place, one.key, *ends, up, down, lines, stretches, others))
    return found


def _stretches(track: Track, shape: tuple[int, ...], number: int, given: Sequence[Axis]) -> Iterator[Stretch]:
    """The stretches of one verdict along a key, by rising values, on each line of the grid on which it changes."""
    one = given[number]
    way = slice(None, None, -1) if one.start > one.end else slice(None)
    said = np.moveaxis(track.said.reshape(shape), number, -1).reshape(-1, one.count)[:, way]
    margin = np.moveaxis(track.margin.reshape(shape), number, -1).reshape(-1, one.count)[:, way]
    values = one.at(np.linspace(0, 1, one.count))[way]
    columns = [other.at(np.linspace(0, 1, other.count)) for other in given if other is not one]
    lines = np.unravel_index(np.arange(len(said)), tuple(map(len, columns)) or (1,))
    changes = said[:, :-1] != said[:, 1:]
    for line in np.flatnonzero(changes.any(axis=1)).tolist():
        at = np.flatnonzero(changes[line])
        inner = values[at] if one.key.whole else _between(one, values, said[line], margin[line], at)
        lows = [values[0], *(values[at + 1] if one.key.whole else inner)]
        others = tuple(float(column[index[line]]) for column, index in zip(columns, lines, strict=False))
        for state, low, high in zip(said[line][[0, *(at + 1)]], lows, [*inner, values[-1]], strict=True):
            yield Stretch(Said(state), float(low), float(high), line, others)


def _between(
    one: Axis, values: FloatArray, said: NDArray[np.int8], margin: FloatArray, at: NDArray[np.intp]
) -> FloatArray:
    """Where a verdict changes between points and the next ones: where a straight line through their margins is 0, if
    one passes, the other fails and both have a margin; else in the middle."""
    first, second = margin[at], margin[at + 1]
    with np.errstate(all="ignore"):
        part = first / (first - second)
    decided = np.isin(said[at], (Said.PASS, Said.FAIL)) & np.isin(said[at + 1], (Said.PASS, Said.FAIL))
    known = decided & np.isfinite(part) & np.isfinite(first) & np.isfinite(second)
    part = np.where(known, np.clip(part, 0, 1), 0.5)
    if one.log:
        found: FloatArray = values[at] * (values[at + 1] / values[at]) ** part
    else:
        found = values[at] + (values[at + 1] - values[at]) * part
    return found


def _turns(stretches: Sequence[Stretch]) -> tuple[int, int]:
    """How often a check passes above a value at which it fails below, and the other way, whatever is open between."""
    up = down = 0
    before: Stretch | None = None
    for one in stretches:
        if one.said not in (Said.PASS, Said.FAIL):
            continue
        if before is not None and before.line == one.line:
            up += before.said is Said.FAIL and one.said is Said.PASS
            down += before.said is Said.PASS and one.said is Said.FAIL
        before = one
    return up, down


def _ends(stretches: Sequence[Stretch], one: Axis) -> tuple[float, float]:
    """The least and the largest value at which a verdict changes; of whole numbers one that still passes."""
    found = []
    for before, after in pairwise(stretches):
        if before.line == after.line:
            found.append(after.low if one.key.whole and after.said is Said.PASS else before.high)
    return min(found), max(found)


def lowest(points: Points) -> Iterator[tuple[Track, int]]:
    """Each check with the number of the point at which its margin is least; -1 where it has none."""
    for track in points.tracks.values():
        margin = np.where(np.isnan(track.margin), np.inf, track.margin)
        known = bool(np.any(~np.isnan(track.margin)))
        yield track, int(np.argmin(margin)) if known else -1
