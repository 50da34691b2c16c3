"""Travelling crane: a bridge, a gantry or a trolley on its wheels, with a load that swings."""

from collections.abc import Iterator

from ptmcalc.base import units
from ptmcalc.contract.example import symbols_in
from ptmcalc.contract.machine import MachineKind, reference_methods_in, template_in
from ptmcalc.contract.result import Finding
from ptmcalc.contract.topic import of_topics
from ptmcalc.laws import skew
from ptmcalc.machines.crane.travelling.assumptions import USES, assumptions
from ptmcalc.machines.crane.travelling.buffers.topic import BUFFERS
from ptmcalc.machines.crane.travelling.figures import FIGURES
from ptmcalc.machines.crane.travelling.machine import model
from ptmcalc.machines.crane.travelling.machine.spec import Travelling
from ptmcalc.machines.crane.travelling.rail.topic import RAIL
from ptmcalc.machines.crane.travelling.relations import RELATIONS
from ptmcalc.machines.crane.travelling.runway.table import tables
from ptmcalc.machines.crane.travelling.runway.topic import RUNWAY
from ptmcalc.machines.crane.travelling.skewing.topic import SKEW
from ptmcalc.machines.crane.travelling.statics.factors import CREEPING
from ptmcalc.machines.crane.travelling.statics.topic import STATICS
from ptmcalc.machines.crane.travelling.storm.topic import STORM_PARKED
from ptmcalc.machines.crane.travelling.sway.topic import TRAVEL

_SPEED_TOLERANCE = 0.05
"""Relative difference [1] of the stated speed and that of motor, gear and wheels, above which SPC201 is reported. An
engineering choice: a smaller value reports the slip of motors, a larger one accepts a wrong ratio. No load depends on
it."""


def inspect(spec: Travelling) -> Iterator[Finding]:
    """Values of the file that disagree with each other."""
    motor = spec.drive.motor
    if motor.speed is not None:
        given = motor.speed / model.rim_ratio(spec)
        if abs(given / spec.speed - 1) > _SPEED_TOLERANCE:
            yield Finding(
                "SPC201",
                f"motor, gear and wheels result in a travel speed of {units.show(given, units.SPEED)}, the file states"
                f" {units.show(spec.speed, units.SPEED)}",
                ("speed",),
                "correct the speed, the ratio, the wheels or the motor",
            )

    yield from _plays(spec)
    hoists = spec.suspension.hoist_speed is not None and spec.classes.hoisting is not None
    if hoists and spec.classes.drive in CREEPING and spec.suspension.creep_speed is None:
        yield Finding(
            "SPC201",
            f"a hoist of class {spec.classes.drive} has a creep speed",
            ("class", "drive"),
            "add `creep_speed: 0.02 m/s` to `suspension`, or write `drive: HD1`",
        )


def _plays(spec: Travelling) -> Iterator[Finding]:
    """A play below the least with which its edition computes."""
    guide = spec.guide
    if guide is None:
        return
    least = skew.LEAST_PLAY[guide.type]
    for_runway = spec.runway is not None and spec.runway.skew_angle is None
    used = skew.skew_play(guide.clearance, least, skew.EN_1991_3 if for_runway else guide.edition)
    if used > guide.clearance:
        yield Finding(
            "SPC201",
            f"{units.show(guide.clearance, units.LENGTH)} of clearance is below the"
            f" minimum of EN 1991-3 with {guide.type}:"
            f" the skewing angle is computed with {units.show(least, units.LENGTH)}",
            ("guide", "clearance"),
            f"write `clearance: {units.show(least / 0.75, units.LENGTH)}` or more, or "
            + ("the `skew_angle` of the runway" if for_runway else "another `edition`"),
        )


TOPICS = (STATICS, TRAVEL, BUFFERS, RAIL, SKEW, STORM_PARKED, RUNWAY)

TRAVELLING = MachineKind(
    name="crane",
    type="travelling",
    title="travelling crane: bridge, gantry, trolley",
    spec=Travelling,
    figures=FIGURES,
    starting=template_in(__package__),
    seconding=reference_methods_in(__package__),
    symbols=symbols_in(__package__, TOPICS),
    assumed=assumptions,
    levers=("trolley.nearest", "drive.motor.ramp_time"),
    uses=USES,
    inspect=inspect,
    relations=RELATIONS,
    tables=tables,
    **of_topics(TOPICS),
)
