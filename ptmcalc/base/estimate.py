"""A number that knows its error."""

import math
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Interval:
    """A closed interval; as an error bar it is an offset and contains 0."""

    low: float
    high: float

    def __add__(self, other: "Interval") -> "Interval":
        return Interval(self.low + other.low, self.high + other.high)

    @property
    def width(self) -> float:
        return self.high - self.low

    @property
    def bounded(self) -> bool:
        return math.isfinite(self.low) and math.isfinite(self.high)


NOTHING = Interval(0.0, 0.0)
ANYTHING = Interval(-math.inf, math.inf)


@dataclass(frozen=True, slots=True)
class Estimate:
    """An SI value and the interval it is known to lie in, not always symmetric.

    `numerical` is the share of the bar from step, tolerance and truncation: it shrinks with work.
    `model` is the share from what the solver leaves out: it shrinks only by another solver.
    """

    value: float
    low: float
    high: float
    numerical: float = 0.0
    model: float = 0.0

    @classmethod
    def exact(cls, value: float) -> "Estimate":
        """A closed form: no bar but rounding, which is not tracked."""
        return cls(value, value, value)

    @classmethod
    def within(cls, value: float, numerical: float) -> "Estimate":
        """A computed number with a numerical bar on either side."""
        return cls(value, value - numerical, value + numerical, numerical=numerical)

    @classmethod
    def unknown(cls, value: float = math.nan) -> "Estimate":
        """A number without a provable bar: shown, never decides."""
        return cls(value, -math.inf, math.inf, model=math.inf)

    def widened(self, offset: Interval) -> "Estimate":
        """The same number when the truth may differ from it by anything in `offset`: a model error.

        Offsets that rule the number itself out move it to the nearest one they allow.
        """
        if offset.low == offset.high == 0:
            return self
        low = -math.inf if offset.low == -math.inf else self.low + offset.low  # of an infinite number too
        high = math.inf if offset.high == math.inf else self.high + offset.high
        return Estimate(
            min(max(self.value, low), high),
            low,
            high,
            self.numerical,
            self.model + max(-offset.low, offset.high),
        )

    @property
    def bar(self) -> float:
        """The larger of the two sides of the bar; 0 for a number without one, be it infinite."""
        if self.low == self.high:
            return 0.0
        return max(self.value - self.low, self.high - self.value) if self.bounded else math.inf

    @property
    def bounded(self) -> bool:
        return math.isfinite(self.low) and math.isfinite(self.high) and math.isfinite(self.value)
