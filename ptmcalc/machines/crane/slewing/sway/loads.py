"""Loads of the sway."""

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo

OF_THE_SWING = (
    LoadInfo("sway_radial_max", "radial sway angle, maximum", units.ANGLE, governing=True),
    LoadInfo("sway_tangential_max", "tangential sway angle, maximum", units.ANGLE, governing=True),
    LoadInfo("sway_max", "hoist rope angle, maximum", units.ANGLE, headline=False),
    LoadInfo("sway_residual", "residual sway amplitude after stop", units.ANGLE),
)
