"""Loads of multilayer winding."""

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo

OF_THE_WINDING = (
    LoadInfo("winding_frequency", "natural frequency of load on rope", units.ANGULAR_FREQUENCY, governing=True),
    LoadInfo("winding_displacement_max", "dynamic rope elongation, maximum", units.LENGTH),
    LoadInfo("winding_stress_max", "dynamic rope stress, maximum", units.STRESS, governing=True),
    LoadInfo("winding_stress_ratio", "dynamic / mean rope stress", units.RATIO, governing=True),
    LoadInfo("winding_crossover_ratio", "crossover / natural frequency", units.RATIO),
    LoadInfo("winding_detuning", "crossover separation, minimum", units.RATIO),
)
OF_THE_PAPER = (
    LoadInfo("winding_displacement_paper", "rope elongation, published formula", units.LENGTH, headline=False),
    LoadInfo("winding_stress_paper", "rope stress, published formula", units.STRESS, headline=False),
)
