"""Keys of the actions of a travelling crane on its runway."""

from collections.abc import Iterator
from typing import Annotated, Literal

from ptmcalc.base import units
from ptmcalc.machines.crane.travelling.machine.keys.duty import Phi
from ptmcalc.spec.fields import Measure, PositiveAngle, PositiveFraction
from ptmcalc.spec.fragment import Conflict, Fragment, Given
from ptmcalc.spec.optional import Absent

_BY_CLASS = "the factor that the file itself results in"
DamageClass = Literal["S0", "S1", "S2", "S3", "S4", "S5", "S6", "S7", "S8", "S9"]


class Actions(Fragment):
    """Actions of the crane on its runway: a table for the designer of the runway beams."""

    edition: Literal["EN 1991-3:2006"]
    """standard of the actions"""
    K_with_phi: bool = False
    """whether the wheel loads of the drive force K have the factor of their group; characteristic loads when false"""
    contact: Literal["steel", "rubber"] = "steel"
    """treads of the driven wheels on the rail, for the drive force: friction 0.2 or 0.5"""
    skew_angle: Annotated[PositiveAngle | None, Absent("the angle by clearance, wear and tolerance of the `guide`")] = (
        None
    )
    """skewing angle; default: computed from the `guide`"""
    fatigue_class: DamageClass | None = None
    """S class of the crane, EN 13001-1; needed for the fatigue wheel load"""
    fatigue_factor: Literal["separate", "larger"] = "separate"
    """factors of the fatigue wheel load: that of crane and hoist load each, or the larger one on both"""
    suspension: Literal["swinging", "guided"] = "swinging"
    """suspended load, or guided load that moves with the crane and acts on its buffers"""
    speed_share: Annotated[PositiveFraction, Absent("the 70 % of EN 1991-3")] = 0.7
    """impact speed at the buffers / full speed"""
    phi1: Annotated[Phi | None, Absent(_BY_CLASS)] = None
    """factor on the crane; default: `class.lifting_share`"""
    phi2: Annotated[Phi | None, Absent(_BY_CLASS)] = None
    """factor on the hoist load; default: `class.hoisting` and `suspension.hoist_speed`"""
    phi3: Annotated[Annotated[float, Measure(units.RATIO, at_least=-1, at_most=1)] | None, Absent(_BY_CLASS)] = None
    """factor of the release of a part of the load; default: `class.release`"""
    phi4: Annotated[Phi | None, Absent("1 on rails within the tolerances of EN 1993-6")] = None
    """factor of travelling; default: by `rail.step` and `rail.gap`, 1 without them"""
    phi5: Annotated[Phi | None, Absent(_BY_CLASS)] = None
    """factor on drive forces; default: `class.drive_change` and the type of drive"""
    phi6: Annotated[Phi | None, Absent("(1 + phi2)/2, the rule of the standard")] = None
    """factor on the dynamic test load"""
    phi7: Annotated[Phi | None, Absent(_BY_CLASS)] = None
    """factor on buffer forces; default: by the buffer curve"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """A factor for the fatigue wheel load belongs to a class."""
        if "fatigue_factor" in given and "fatigue_class" not in given:
            reason = "there is no fatigue wheel load without a class"
            yield Conflict(("fatigue_factor",), reason, "add `fatigue_class: S3`, or delete `fatigue_factor`")
