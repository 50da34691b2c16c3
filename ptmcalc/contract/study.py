"""Results of a study of many variants of one machine: verdict and margin of each check at every point."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base.span import KeyPath, Span, dotted
from ptmcalc.base.units import Quantity
from ptmcalc.contract.check import Sense
from ptmcalc.contract.result import LoadInfo

FloatArray = NDArray[np.float64]


class Said(IntEnum):
    """Verdict of a check at a point."""

    PASS = 0
    FAIL = 1
    UNDECIDED = 2
    NOT_CHECKED = 3
    NOT_COMPUTED = 4
    """beyond the budget, or an invalid machine at that point"""

    @property
    def word(self) -> str:
        """As it is printed."""
        return self.name.lower()


@dataclass(frozen=True, slots=True)
class VariedKey:
    """A key that has another value at every point; `present` is that of the file, or what is assumed for it."""

    path: KeyPath
    quantity: Quantity
    present: float | None
    span: Span
    whole: bool = False
    """whether it takes whole numbers only"""

    @property
    def name(self) -> str:
        """`takeup.tension`"""
        return dotted(self.path)


@dataclass(frozen=True, slots=True)
class Track:
    """One check over all points: shape (n,) each; no number is there where nothing was computed."""

    scene: str
    code: str
    element: str
    title: str
    sense: Sense
    quantity: Quantity
    said: NDArray[np.int8]
    value: FloatArray
    limit: FloatArray

    @property
    def margin(self) -> FloatArray:
        """Signed distance of the value from the limit; positive on the permissible side."""
        with np.errstate(invalid="ignore"):
            return self.value - self.limit if self.sense is Sense.AT_LEAST else self.limit - self.value

    def count(self, said: Said) -> int:
        """At how many points it says so."""
        return int(np.count_nonzero(self.said == said))

    @property
    def computed(self) -> NDArray[np.bool_]:
        """Where it was looked at."""
        looked: NDArray[np.bool_] = (self.said != Said.NOT_CHECKED) & (self.said != Said.NOT_COMPUTED)
        return looked


@dataclass(frozen=True, slots=True)
class LoadTrack:
    """One load over all points: shape (n,) each."""

    scene: str
    info: LoadInfo
    value: FloatArray
    low: FloatArray
    high: FloatArray


@dataclass(slots=True)
class Points:
    """Variants of a machine: `values` (n, k) of the keys, and what was found of each."""

    keys: Sequence[VariedKey]
    values: FloatArray
    tracks: dict[tuple[str, str, str], Track] = field(default_factory=dict)
    loads: dict[tuple[str, str], LoadTrack] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    """what has to be said of how it was computed"""
    missing: NDArray[np.bool_] | None = None
    """where a scene was not computed at all"""

    def __len__(self) -> int:
        return len(self.values)

    def worst(self) -> NDArray[np.int8]:
        """The verdict of each point: fail, not computed, undecided as not checked is, or pass: the first there is."""
        rank = np.array([0, 4, 2, 2, 3], np.int8)
        back = np.array([Said.PASS, Said.PASS, Said.UNDECIDED, Said.NOT_COMPUTED, Said.FAIL], np.int8)
        found = np.zeros(len(self), np.int8)
        for track in self.tracks.values():
            found = np.maximum(found, rank[track.said])
        if self.missing is not None:
            found = np.maximum(found, np.where(self.missing, rank[Said.NOT_COMPUTED], 0))
        worst: NDArray[np.int8] = back[found]
        return worst


@dataclass(frozen=True, slots=True)
class Stretch:
    """Values of a key from `low` to `high` at which a check says the same, on one line of a grid: that on which the
    other keys, in their order, have the values `others`.

    Between a point that passes and one that fails it ends where a straight line through their margins is 0, else in
    the middle of two points.
    """

    said: Said
    low: float
    high: float
    line: int
    others: tuple[float, ...] = ()


@dataclass(frozen=True, slots=True)
class Turning:
    """Where the verdict of a check changes along a key of a grid: the least and the largest such value over all lines
    of the grid, how often it passes above, how often below, on so many lines; and of each line on which it changes the
    stretches of one verdict, by rising values."""

    scene: str
    code: str
    element: str
    key: VariedKey
    least: float
    most: float
    above: int
    below: int
    lines: int
    stretches: tuple[Stretch, ...] = ()
    others: tuple[VariedKey, ...] = ()
    """the other keys of the grid"""


@dataclass(frozen=True, slots=True)
class Share:
    """How often something was seen, and the interval of its probability."""

    hits: int
    value: float
    low: float
    high: float


@dataclass(frozen=True, slots=True)
class Driver:
    """Rank correlation of an input with a margin, and what one of no influence exceeds once in 370 studies."""

    key: VariedKey
    correlation: float
    noise: float

    @property
    def clear(self) -> bool:
        """Whether it is more than chance."""
        return abs(self.correlation) > self.noise


@dataclass(frozen=True, slots=True)
class Risk:
    """One check over machines drawn at random: `size` of them were looked at.

    `fails_or_undecided` says what the probability is at most where the undecided ones would all fail. The margin is the
    one that so many machines have as the confidence says, with the interval of that number.
    """

    track: Track
    size: int
    fails: Share
    undecided: Share
    fails_or_undecided: Share
    margin: float
    margin_low: float
    margin_high: float
    drivers: Sequence[Driver]
