"""Loads of the vibration."""

from collections.abc import Iterator

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo
from ptmcalc.machines.drivetrain.machine.spec import Drivetrain

SEPARATION = LoadInfo("resonance_separation", "excitation separation from resonance", units.SHARE, governing=True)
FREQUENCY = LoadInfo("natural_frequency", "natural frequency", units.ANGULAR_FREQUENCY)

LOADS_OF_VIBRATION = (
    SEPARATION,
    FREQUENCY,
)


def parts(spec: Drivetrain) -> Iterator[LoadInfo]:
    """The natural frequencies of one train, and their distance from its harmonic torques."""
    for name, torque in spec.torques.items():
        if torque.type == "sine":
            yield SEPARATION.of(name)
    for number in range(1, len(spec.inertias) + len(spec.links) + 1):
        yield FREQUENCY.of(str(number))
