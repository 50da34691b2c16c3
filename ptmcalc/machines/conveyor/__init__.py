"""Belt conveyor with one drive drum at the head: steady running and start."""

from collections.abc import Iterator
from importlib import resources

from ptmcalc.base import units
from ptmcalc.contract.machine import MachineKind
from ptmcalc.contract.result import Finding
from ptmcalc.machines.conveyor.assumptions import assumptions
from ptmcalc.machines.conveyor.checks import CHECKS
from ptmcalc.machines.conveyor.effects import EFFECTS
from ptmcalc.machines.conveyor.loads import LOADS, parts
from ptmcalc.machines.conveyor.solvers import SOLVERS
from ptmcalc.machines.conveyor.spec import Conveyor

_SPEED_TOLERANCE = 0.05
_STEEP = 0.309  # sine of 18 degrees


def inspect(spec: Conveyor) -> Iterator[Finding]:
    """Values of the file that disagree with each other."""
    drive = spec.main_drive
    if drive.motor.speed is not None:
        rim = drive.motor.speed / drive.gear.ratio * drive.drum.diameter / 2
        if abs(rim / spec.speed - 1) > _SPEED_TOLERANCE:
            yield Finding(
                "SPC201",
                f"motor speed, gear ratio and drum give {units.show(rim, units.SPEED)} at the rim, the belt runs at"
                f" {units.show(spec.speed, units.SPEED)}",
                ("speed",),
                "correct the speed, the ratio or the diameter",
            )
    if spec.route.inclination == "small_angle" and abs(spec.route.climb) > _STEEP * spec.route.span:
        yield Finding(
            "SPC201",
            "the slope is above 18 degrees: its cosine is not 1",
            ("route", "inclination"),
            "write `inclination: exact`",
        )


KIND = MachineKind(
    name="conveyor",
    title="belt conveyor: slip, belt tension, sag and start",
    spec=Conveyor,
    loads=LOADS,
    effects=EFFECTS,
    solvers=SOLVERS,
    checks=CHECKS,
    template=resources.files(__package__).joinpath("template.yaml").read_text("utf-8"),
    assumed=assumptions,
    parts=parts,
    inspect=inspect,
)
