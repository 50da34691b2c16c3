"""Chain drive: a chain conveyor, or two shafts with a chain between them."""

from collections.abc import Iterator

from ptmcalc.base import units
from ptmcalc.contract.example import examples_in, symbols_in
from ptmcalc.contract.machine import MachineKind, reference_methods_in, template_in
from ptmcalc.contract.result import Finding
from ptmcalc.contract.topic import of_topics
from ptmcalc.laws import chain_selection
from ptmcalc.machines.chain_drive.assumptions import assumptions
from ptmcalc.machines.chain_drive.figures import FIGURES
from ptmcalc.machines.chain_drive.limiter.topic import LIMITER
from ptmcalc.machines.chain_drive.machine.layout import ConveyorLayout, TwoShafts
from ptmcalc.machines.chain_drive.machine.model import mean_arm
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive
from ptmcalc.machines.chain_drive.polygon.topic import POLYGON
from ptmcalc.machines.chain_drive.relations import RELATIONS
from ptmcalc.machines.chain_drive.running.topic import RUNNING
from ptmcalc.machines.chain_drive.selection.topic import SELECTION
from ptmcalc.machines.chain_drive.spans.topic import SPANS
from ptmcalc.machines.chain_drive.speed_change.topic import SPEED_CHANGE
from ptmcalc.machines.chain_drive.starting.topic import STARTING
from ptmcalc.machines.chain_drive.stopping.topic import STOPPING

_SPEED_TOLERANCE = 0.05
"""Difference of two chain speeds of a file from which on SPC201 is reported [1]. An engineering choice: a smaller value
reports rounded ratios, a larger one accepts wrong entries."""
_WEIGHT_TOLERANCE = 0.05
"""Difference of the take-up tension from half of the weight from which on SPC201 is reported [1]. An engineering
choice: a smaller value reports rounded masses, a larger one accepts the whole weight as tension."""
_PITCHES_TOLERANCE = 1.0
"""Difference of the chain length from that of the centre distance from which on SPC201 is reported [pitches]. An
engineering choice: a length is rounded to whole pitches, an even number if possible. A larger value accepts a chain
that cannot be closed."""


def inspect(spec: ChainDrive) -> Iterator[Finding]:
    """Values of the file that disagree with each other."""
    if spec.drive is not None and spec.drive.motor.speed is not None:
        chain = spec.drive.motor.speed / spec.drive.gear.ratio * mean_arm(spec)
        if abs(chain / spec.speed - 1) > _SPEED_TOLERANCE:
            yield Finding(
                "SPC201",
                f"motor speed, gear ratio and sprocket move the chain at {units.show(chain, units.SPEED)}, the"
                f" file states {units.show(spec.speed, units.SPEED)}",
                ("speed",),
                "correct the speed, the ratio or the teeth",
            )
    if spec.operating is not None and not spec.operating.lowest <= spec.speed <= spec.operating.highest:
        yield Finding(
            "SPC201",
            "the speed is outside the speed range of the file",
            ("operating",),
            "correct the range or the speed",
        )
    if isinstance(spec.layout, ConveyorLayout):
        yield from _of_a_conveyor(spec, spec.layout)
    else:
        yield from _of_two_shafts(spec, spec.layout)


def _of_a_conveyor(spec: ChainDrive, layout: ConveyorLayout) -> Iterator[Finding]:
    takeup = layout.takeup
    pull = takeup.mass * spec.gravity / 2 if takeup.mass is not None else takeup.tension
    if abs(pull / takeup.tension - 1) > _WEIGHT_TOLERANCE:
        yield Finding(
            "SPC201",
            f"a take-up weight on two falls results in half of its weight force, {units.show(pull, units.FORCE)};"
            f" the tension is {units.show(takeup.tension, units.FORCE)}",
            ("layout", "takeup", "mass"),
            f"write `mass: {units.show(2 * takeup.tension / spec.gravity, units.MASS)}`, or correct the tension",
        )


def _of_two_shafts(spec: ChainDrive, layout: TwoShafts) -> Iterator[Finding]:
    if layout.pitches is None or layout.centre_distance is None:
        return
    exact = chain_selection.chain_pitches(
        layout.centre_distance, spec.chain.pitch, spec.sprocket.teeth, layout.driven.teeth
    )
    fits = layout.pitches == chain_selection.even_pitches(exact)
    if not fits and abs(exact - layout.pitches) > _PITCHES_TOLERANCE:
        yield Finding(
            "SPC201",
            f"a centre distance of {units.show(layout.centre_distance, units.LENGTH)} requires {exact:.1f} pitches",
            ("layout", "pitches"),
            f"write `pitches: {chain_selection.even_pitches(exact)}`, or correct the distance",
        )


TOPICS = (RUNNING, SELECTION, POLYGON, SPANS, STARTING, SPEED_CHANGE, STOPPING, LIMITER)

KIND = MachineKind(
    name="chain_drive",
    title="chain conveyor or chain drive: polygon effect, resonance, safety, life, start",
    spec=ChainDrive,
    figures=FIGURES,
    starting=template_in(__package__),
    symbols=symbols_in(__package__, TOPICS),
    examples=examples_in(__package__),
    assumed=assumptions,
    levers=("scenes[*].profile.time",),
    relations=RELATIONS,
    inspect=inspect,
    seconding=reference_methods_in(__package__),
    **of_topics(TOPICS),
)
