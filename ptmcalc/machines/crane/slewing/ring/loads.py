"""Loads of the slewing ring."""

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo

OF_THE_RING = (
    LoadInfo("ring_force_axial", "slewing ring axial force", units.FORCE, governing=True),
    LoadInfo("ring_force_radial", "slewing ring radial force", units.FORCE),
    LoadInfo("ring_moment", "slewing ring tilting moment", units.TORQUE, governing=True),
    LoadInfo("ring_utilisation", "slewing ring utilisation", units.SHARE),
)
RING_LOADS = tuple(info.name for info in OF_THE_RING)
"""Names of the loads of the ring, the utilisation last."""
