"""Hoist: a load on a tackle, a drum, a gearbox, a motor and a brake."""

from collections.abc import Iterator

from ptmcalc.base import units
from ptmcalc.contract.example import examples_in, symbols_in
from ptmcalc.contract.machine import MachineKind, Use, reference_methods_in, template_in
from ptmcalc.contract.result import Finding
from ptmcalc.contract.topic import of_topics
from ptmcalc.laws import lift_off_standard
from ptmcalc.machines.hoist.assumptions import assumptions
from ptmcalc.machines.hoist.braking.topic import BRAKING
from ptmcalc.machines.hoist.drive.cycle import CYCLE
from ptmcalc.machines.hoist.drive.holding import HOLDING_RULE
from ptmcalc.machines.hoist.drive.topic import DRIVE
from ptmcalc.machines.hoist.figures import FIGURES
from ptmcalc.machines.hoist.machine import model
from ptmcalc.machines.hoist.machine.model import drum_speed
from ptmcalc.machines.hoist.machine.spec import CREEPING, Hoist, Run
from ptmcalc.machines.hoist.motion.topic import MOTION
from ptmcalc.machines.hoist.relations import RELATIONS
from ptmcalc.machines.hoist.rope import life, shell
from ptmcalc.machines.hoist.rope.fleet import FLEET_ANGLES
from ptmcalc.machines.hoist.rope.life import ROPE_LIFE
from ptmcalc.machines.hoist.rope.proof import ROPE_PROOF
from ptmcalc.machines.hoist.rope.shell import DRUM_SHELL
from ptmcalc.machines.hoist.statics.topic import STATICS
from ptmcalc.machines.hoist.winding.topic import WINDING

_SPEED_TOLERANCE = 0.05
"""Difference of two drum speeds of a file from which on SPC201 is reported [1]. An engineering choice: a smaller value
reports rounded ratios, a larger one accepts wrong entries."""
_WIRE = 1.7e11
"""Modulus of a rope above which SPC201 is reported [Pa]. An engineering choice between ropes (90 to 130 GPa) and their
wire. A smaller value reports valid ropes; a larger one accepts the modulus of wire."""


def inspect(spec: Hoist) -> Iterator[Finding]:
    """Values of the file that disagree with each other."""
    motor, gear = spec.motor, spec.gearbox
    if motor is not None and motor.speed is not None and gear is not None:
        drum = motor.speed / gear.ratio
        if abs(drum / drum_speed(spec) - 1) > _SPEED_TOLERANCE:
            said = units.show(drum_speed(spec), units.ANGULAR_SPEED)
            yield Finding(
                "SPC201",
                f"motor and gearbox result in a drum speed of {units.show(drum, units.ANGULAR_SPEED)},"
                f" the file states {said}",
                ("speed",),
                "correct the speed, the ratio or the reeving",
            )
    if motor is not None and motor.rated is not None and motor.mean_torque < motor.rated:
        rated, mean = (units.show(torque, units.TORQUE) for torque in (motor.rated, motor.mean_torque))
        yield Finding(
            "SPC201",
            f"the mean starting torque of {mean} is below the rated torque of {rated}",
            ("motor",),
            "correct its power, speed or starting torque: hoisting motors start with 1.5 to 2.5 times the rated torque",
        )
    if spec.rope.modulus is not None and spec.rope.modulus > _WIRE:
        yield Finding(
            "SPC201",
            f"{units.show(spec.rope.modulus, units.STRESS)} is the modulus of wire, not of a rope",
            ("rope", "modulus"),
            "write the rope modulus on the metallic area, 90 to 130 GPa",
        )
    if spec.classes.drive in CREEPING and spec.speed.creep is None:
        yield Finding(
            "SPC201",
            f"a drive of class {spec.classes.drive} has a creep speed",
            ("class", "drive"),
            "add `creep: 0.02 m/s` to `speed`, or write `drive: HD1`",
        )
    yield from _editions_that_differ(spec)


def _editions_that_differ(spec: Hoist) -> Iterator[Finding]:
    """The factor of lifting off depends on the edition, and the file names none."""
    chosen = "edition" in spec.classes.model_fields_set or spec.checks.lift_off_factor is not None
    if chosen or not any(scene.type == "lift" for scene in spec.all_scenes):
        return
    factor = model.class_factor(spec)
    others = {name: model.class_factor(spec, name) for name in (lift_off_standard.BY_CLASS, lift_off_standard.BY_DRIVE)}
    said = [f"`{name}` {other:.3g}" for name, other in others.items() if other is not None and other != factor]
    if factor is not None and said:
        yield Finding(
            "SPC201",
            f"the editions of the standard have different phi_2 for {spec.classes.drive}:"
            f" `{spec.classes.edition}` gives {factor:.3g}, {' and '.join(said)}",
            ("class",),
            f"write `edition: {spec.classes.edition}`, or that of the edition that applies, under `class`",
        )


TOPICS = (
    STATICS,
    DRIVE,
    MOTION,
    WINDING,
    BRAKING,
    CYCLE,
    ROPE_LIFE,
    ROPE_PROOF,
    FLEET_ANGLES,
    DRUM_SHELL,
    HOLDING_RULE,
)

USES = {
    "rope_life.force_factor": Use(frozenset({Run}), frozenset(info.name for info in life.LOADS)),
    "drum.shell.modulus": Use(frozenset({Run}), frozenset(info.name for info in shell.LOADS)),
    "drum.shell.flange_pressure": Use(frozenset({Run}), frozenset(info.name for info in shell.LOADS)),
}
"""Where constants are used that declarations of keys assume."""

KIND = MachineKind(
    name="hoist",
    title="hoist: rope, drum, motor, brake",
    spec=Hoist,
    figures=FIGURES,
    starting=template_in(__package__),
    symbols=symbols_in(__package__, TOPICS),
    examples=examples_in(__package__),
    assumed=assumptions,
    levers=("gearbox.ratio", "scenes[*].profile.time"),
    inspect=inspect,
    relations=RELATIONS,
    uses=USES,
    seconding=reference_methods_in(__package__),
    **of_topics(TOPICS),
)
