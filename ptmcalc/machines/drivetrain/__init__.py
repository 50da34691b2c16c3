"""Drive train: inertias, elastic links with play, gears with losses, motors, brakes."""

from collections.abc import Iterator

from ptmcalc.contract.example import examples_in, symbols_in
from ptmcalc.contract.machine import MachineKind, reference_methods_in, template_in
from ptmcalc.contract.result import Finding
from ptmcalc.contract.topic import of_topics
from ptmcalc.machines.drivetrain.assumptions import assumed
from ptmcalc.machines.drivetrain.figures import FIGURES
from ptmcalc.machines.drivetrain.links.topic import LINKS
from ptmcalc.machines.drivetrain.machine.spec import Drivetrain
from ptmcalc.machines.drivetrain.motion.topic import MOTION
from ptmcalc.machines.drivetrain.motors.topic import MOTORS
from ptmcalc.machines.drivetrain.relations import RELATIONS
from ptmcalc.machines.drivetrain.vibration.topic import VIBRATION


def inspect(spec: Drivetrain) -> Iterator[Finding]:
    """Values of the file that disagree with each other."""
    for name, gear in spec.gears.items():
        if gear.reverse_efficiency is not None and gear.reverse_efficiency > gear.efficiency:
            yield Finding(
                "SPC201",
                f"`{name}` has a higher efficiency in reverse than forward",
                ("gears", name, "reverse_efficiency"),
                "check both efficiencies; 2 - 1/efficiency is usual",
            )


TOPICS = (LINKS, MOTION, MOTORS, VIBRATION)

KIND = MachineKind(
    name="drivetrain",
    title="drive train: link torques, start, stop, backlash, resonance",
    spec=Drivetrain,
    figures=FIGURES,
    starting=template_in(__package__),
    symbols=symbols_in(__package__, TOPICS),
    examples=examples_in(__package__),
    assumed=assumed,
    relations=RELATIONS,
    inspect=inspect,
    seconding=reference_methods_in(__package__),
    **of_topics(TOPICS),
)
