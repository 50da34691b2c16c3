"""Tolerances: machines drawn by what a file says of its values, how often each check fails, and what drives it."""

import math
import zlib
from collections.abc import Iterator

import numpy as np

from ptmcalc.base.errors import UsageError
from ptmcalc.base.span import dotted, known
from ptmcalc.contract.study import Driver, FloatArray, Points, Risk, Said, Share, Track, VariedKey
from ptmcalc.engine.load import Loaded
from ptmcalc.engine.points import varied_key
from ptmcalc.engine.spread import BLOCK, Spread, spread_of
from ptmcalc.numerics.statistics import quantile_interval, rank_correlation, ranks, share_interval
from ptmcalc.spec.fields import Measure

MOST_SAMPLES, MOST_VALUES = 1_000_000, 20_000_000
"""Limits of a random sample; numerical choices. `MOST_SAMPLES`: machines. `MOST_VALUES`: machines times tolerances,
which take 160 MB. Larger limits need more memory; smaller ones refuse large samples earlier."""
_LEAST_KEPT = 1e-3
"""Share of a normal distribution that `min` and `max` must leave [1]. A numerical choice: less is no tolerance of the
value, and drawing takes longer."""


def drawn(loaded: Loaded, count: int, seed: int) -> Points:
    """Machines drawn at random, independently: the same for the same seed, key by key whatever other keys there are.

    Raises:
        UsageError: the file has no tolerances, or one of them is about a value that it does not know or cannot have.
    """
    if not 1 <= count <= MOST_SAMPLES:
        raise UsageError(f"`--samples {count}` is not a number of samples", f"write one from 1 to {MOST_SAMPLES}")
    spec = loaded.spec
    assert spec is not None
    if not spec.tolerances:
        hint = f"add e.g. `{BLOCK}: {{takeup.tension: {{normal: {{sd: 2 kN}}}}}}`, by keys of the file"
        raise UsageError(f"`{loaded.document.name}` has no `{BLOCK}`", hint)
    if count * len(spec.tolerances) > MOST_VALUES:
        most = MOST_VALUES // len(spec.tolerances)
        raise UsageError(
            f"`--samples {count}` of {len(spec.tolerances)} values are too many", f"write one from 1 to {most}"
        )
    keys, columns = [], []
    for name, tolerance in spec.tolerances.items():
        key, measure = varied_key(loaded, name)
        spread, _ = spread_of(tolerance, measure, (BLOCK, name))
        assert spread is not None, "the file was read"
        chance = np.random.default_rng([seed, zlib.crc32(name.encode())])
        columns.append(_values(loaded, key, measure, spread, count, chance))
        keys.append(key)
    return Points(keys, np.stack(columns, axis=1))


def _values(
    loaded: Loaded, key: VariedKey, measure: Measure, spread: Spread, count: int, chance: np.random.Generator
) -> FloatArray:
    line = loaded.document.key_span((BLOCK, dotted(known(key.path)))).line
    where = f"{loaded.document.name}:{line}: `{BLOCK}.{key.name}`"
    if spread.about_the_file and key.present is None:
        raise UsageError(
            f"{where}: the file has no value of it", "give it, or `mean:`, or `uniform: {min: ..., max: ...}`"
        )
    present = key.present or 0.0
    if spread.sd is not None:
        mean = present if spread.mean is None else spread.mean
        values = _normal(mean, spread.sd, spread.low, spread.high, count, chance)
        if values is None:
            raise UsageError(f"{where}: the probability between `min` and `max` is almost 0", "check them")
    elif spread.plus is not None and spread.minus is not None:
        values = chance.uniform(present - spread.minus, present + spread.plus, count)
    else:
        values = chance.uniform(spread.low, spread.high, count)
    for value in (float(values.min()), float(values.max()), float(values[np.argmin(np.abs(values))])):
        if broken := measure.broken_by(value):
            hint = "add `min:` or `max:` under `normal`, or make it narrower"
            raise UsageError(f"{where}: some random machines have impossible values; the value must be {broken}", hint)
    return values


def _normal(
    mean: float, sd: float, low: float, high: float, count: int, chance: np.random.Generator
) -> FloatArray | None:
    """Values of a normal distribution, drawn again until they lie between two limits; None where hardly any do."""
    kept: list[FloatArray] = []
    missing, tried = count, 0
    while missing:
        values = mean + sd * chance.standard_normal(max(missing, 1000))
        tried += values.size
        inside = values[(values >= low) & (values <= high)][:missing]
        kept.append(inside)
        missing -= inside.size
        if tried * _LEAST_KEPT > count - missing + 10:
            return None
    return np.concatenate(kept)


# -- what the sample says -------------------------------------------------------------------------------------------


def risks(points: Points, confidence: float) -> list[Risk]:
    """Of each check how often it fails, its margin, and what drives that; the riskiest first."""
    places = [ranks(column) for column in points.values.T]
    found = [_risk(points, track, places, confidence) for track in points.tracks.values()]
    return sorted(found, key=lambda one: (-one.fails.hits, -one.undecided.hits))


def _risk(points: Points, track: Track, places: list[FloatArray], confidence: float) -> Risk:
    size = int(np.count_nonzero(track.computed))
    fails, undecided = track.count(Said.FAIL), track.count(Said.UNDECIDED)
    margin = track.margin
    known = track.computed & ~np.isnan(margin)
    quantile = quantile_interval(margin[known], 1 - confidence, confidence) if known.any() else (math.nan,) * 3
    drivers = sorted(_drivers(points, margin, known, places), key=lambda one: -abs(one.correlation))
    return Risk(
        track,
        size,
        _share(fails, size, confidence),
        _share(undecided, size, confidence),
        _share(fails + undecided, size, confidence),
        *quantile,
        tuple(drivers),
    )


def _share(hits: int, size: int, confidence: float) -> Share:
    if not size:
        return Share(0, math.nan, 0.0, 1.0)
    return Share(hits, hits / size, *share_interval(hits, size, confidence))


def _drivers(points: Points, margin: FloatArray, known: np.ndarray, places: list[FloatArray]) -> Iterator[Driver]:
    """Rank correlation of each input with the margin, with the size that one of no influence seldom exceeds."""
    size = int(np.count_nonzero(known))
    if size < 3:
        return
    whole = bool(known.all())
    of_margin = ranks(margin[known])
    for key, place, column in zip(points.keys, places, points.values.T, strict=True):
        correlation = rank_correlation(place if whole else ranks(column[known]), of_margin)
        yield Driver(key, correlation, min(3 / math.sqrt(size - 1), 1.0))
