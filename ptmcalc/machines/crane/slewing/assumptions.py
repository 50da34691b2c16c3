"""What is filled in where a design file leaves it out, and how wrong that may be."""

from collections.abc import Iterator

from ptmcalc.base import units
from ptmcalc.base.estimate import Interval
from ptmcalc.contract.machine import Assumption
from ptmcalc.machines.crane.slewing.spec import SlewingCrane


def assumptions(spec: SlewingCrane) -> Iterator[Assumption[SlewingCrane]]:
    """The coupling of the motor, where the file says nothing of it."""
    if spec.motor.coupling_inertia is None:
        yield Assumption(
            ("motor", "coupling_factor"),
            units.FACTOR,
            lambda spec: 1.7,
            lambda spec: Interval(1.4, 2.0),
            "rotor with coupling: 1.4 to 2 times the rotor (course notes on the slewing crane on a fixed column)",
        )
