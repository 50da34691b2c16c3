"""Main shaft of a machine with its tachogram: run-up, steady cycle and run-out."""

from collections.abc import Iterator

import numpy as np

from ptmcalc.base import units
from ptmcalc.contract.example import examples_in, symbols_in
from ptmcalc.contract.machine import MachineKind, reference_methods_in, template_in
from ptmcalc.contract.result import Finding
from ptmcalc.contract.topic import of_topics
from ptmcalc.laws import slider_crank
from ptmcalc.machines.shaft.assumptions import ASSUMPTIONS
from ptmcalc.machines.shaft.cycle.topic import CYCLE
from ptmcalc.machines.shaft.figures import FIGURES
from ptmcalc.machines.shaft.inertia.topic import INERTIA
from ptmcalc.machines.shaft.machine.model import machine_of
from ptmcalc.machines.shaft.machine.spec import RunUp, Shaft, SliderCrank, ToolLoad
from ptmcalc.machines.shaft.relations import RELATIONS
from ptmcalc.machines.shaft.speed_changes.topic import SPEED_CHANGES

_SPEED_TOLERANCE = 0.05
"""Share [1] by which the stated speed may exceed the no-load speed of motor and gear; above, SPC201 is reported. An
engineering choice: a smaller value reports rounded speeds, a larger one accepts a wrong ratio. No load depends on
it."""


def inspect(spec: Shaft) -> Iterator[Finding]:
    """Values of the file that disagree with each other."""
    free = spec.drive.motor.no_load_speed
    ratio = spec.drive.gear.ratio
    if spec.speed is not None and free is not None and not 0.85 <= spec.speed * ratio / free <= 1 + _SPEED_TOLERANCE:
        yield Finding(
            "SPC201",
            f"motor and gear result in {units.show(free / ratio, units.ANGULAR_SPEED)} without load, the file"
            f" states {units.show(spec.speed, units.ANGULAR_SPEED)}",
            ("speed",),
            "correct the speed, the ratio or the motor",
        )
    for index, scene in enumerate(spec.scenes or ()):
        if isinstance(scene, RunUp) and scene.to is not None and free is not None and scene.to * ratio >= free:
            yield Finding(
                "SPC201",
                f"the run-up is to end at {units.show(scene.to, units.ANGULAR_SPEED)}, where the motor torque is zero"
                f" ({units.show(free / ratio, units.ANGULAR_SPEED)})",
                ("scenes", index, "to"),
                "write a lower speed",
            )
    yield from _brake_that_does_not_hold(spec)
    yield from _force_beyond_the_stroke(spec)


def _brake_that_does_not_hold(spec: Shaft) -> Iterator[Finding]:
    if spec.brake is None or spec.brake.torque == 0:
        return
    machine = machine_of(spec, "idle")
    turning = float(np.max(np.abs(machine.potential_torque(np.linspace(0.0, machine.period, 721)))))
    if turning > spec.brake.torque + spec.losses.torque:
        yield Finding(
            "SPC201",
            f"weights and springs drive the shaft with up to {units.show(turning, units.TORQUE)}, above the holding"
            " torque of brake and friction",
            ("brake", "torque"),
            "increase the brake torque, or improve the balancing",
        )


def _force_beyond_the_stroke(spec: Shaft) -> Iterator[Finding]:
    if not isinstance(spec.load, ToolLoad) or not isinstance(spec.inertia, SliderCrank):
        return
    crank = spec.inertia
    shape = crank.crank_radius, crank.rod_length, crank.offset
    stroke = slider_crank.dead_centre(*shape, True)[0] - slider_crank.dead_centre(*shape, False)[0]
    for index, point in enumerate(spec.load.points):
        if point.distance > stroke * (1 + 1e-9):
            yield Finding(
                "SPC201",
                f"the slider moves by {units.show(stroke, units.LENGTH)}: it never is"
                f" {units.show(point.distance, units.LENGTH)} from its dead centre",
                ("load", "points", index, "distance"),
                "correct the distance or the crank radius",
            )
            return


TOPICS = (INERTIA, CYCLE, SPEED_CHANGES)

KIND = MachineKind(
    name="shaft",
    title="main shaft of a cyclic machine: run-up, steady cycle, flywheel, stop",
    spec=Shaft,
    figures=FIGURES,
    starting=template_in(__package__),
    symbols=symbols_in(__package__, TOPICS),
    examples=examples_in(__package__),
    assumptions=ASSUMPTIONS,
    relations=RELATIONS,
    inspect=inspect,
    seconding=reference_methods_in(__package__),
    **of_topics(TOPICS),
)
