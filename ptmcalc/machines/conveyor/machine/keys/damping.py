"""Internal damping of the belt, as a design file gives it."""

from collections.abc import Iterator
from typing import Annotated, Literal

from ptmcalc.laws import belt_damping
from ptmcalc.spec.fields import PositiveRatio, PositiveTime
from ptmcalc.spec.fragment import Conflict, Fragment, Given
from ptmcalc.spec.optional import Absent


class Damping(Fragment):
    """Damping of the belt: Kelvin-Voigt, S = EA (e + t e'), or Zener, stiffer by a factor for short times."""

    model: Literal["kelvin_voigt", "zener"]
    """`kelvin_voigt`: increases with frequency; `zener`: maximum near its relaxation frequency"""
    time: PositiveTime
    """retardation time of a Kelvin-Voigt belt (10 to 50 ms), relaxation time of a Zener belt"""
    stiffening: Annotated[
        PositiveRatio | None, Absent("a Kelvin-Voigt belt has one stiffness; a Zener belt requires it")
    ] = None
    """Zener: stiffness for rapid changes / stiffness for slow changes - 1"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """Only a Zener belt has a second stiffness."""
        model = given.word("model")
        if model == "zener" and "stiffening" not in given:
            yield given.missing("stiffening", "a Zener belt is stiffer under rapid changes")
        elif model == "kelvin_voigt" and "stiffening" in given:
            reason = "a Kelvin-Voigt belt has one stiffness"
            yield Conflict(("stiffening",), reason, "delete `stiffening`, or write `model: zener`")

    def change(self, frequency: float) -> float:
        """Relative change of the complex frequency of a wave [rad/s] by it."""
        if self.stiffening is None:
            return belt_damping.kelvin_voigt_change(frequency, self.time)
        return belt_damping.zener_change(frequency, self.time, self.stiffening)
