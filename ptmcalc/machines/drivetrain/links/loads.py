"""Loads of the links."""

from collections.abc import Iterator

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo
from ptmcalc.machines.drivetrain.machine.spec import Drivetrain

TORQUE_PEAK = LoadInfo("torque_peak", "peak link torque or force", units.TORQUE, governing=True)
TORQUE_STEADY = LoadInfo("torque_steady", "final link torque, rigid-train model", units.TORQUE)
DYNAMIC_FACTOR = LoadInfo("dynamic_factor", "dynamic factor, peak / rigid train", units.RATIO)
WEAR = LoadInfo("wear_share", "tooth wear / tooth thickness", units.SHARE, governing=True)

LOADS_OF_LINKS = (
    TORQUE_PEAK,
    TORQUE_STEADY,
    DYNAMIC_FACTOR,
    WEAR,
)


def parts(spec: Drivetrain) -> Iterator[LoadInfo]:
    """The loads of the links and gears of one train."""
    ends = {name: link.body for name, link in spec.links.items()}
    ends |= {name: gear.end for name, gear in spec.gears.items()}
    for info in (TORQUE_PEAK, TORQUE_STEADY, DYNAMIC_FACTOR):
        for name, end in ends.items():
            force = info.quantity is units.TORQUE and not spec.turns(end)
            yield info.of(name, units.FORCE if force else None)
    for name, link in spec.links.items():
        if link.clearance is not None:
            yield WEAR.of(name)
