"""The laws of waves and modes of a chain: of one loop, or strand by strand where the tail keeps the speed."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ptmcalc.laws import chain_resonance, held_strands, loop_bounds
from ptmcalc.laws.held_strands import HeldStrands
from ptmcalc.laws.loop_bounds import CARRY, RETURN, LoopMasses

FloatArray = NDArray[np.float64]
__all__ = ["CARRY", "RETURN", "HeldStrands", "LoopMasses"]


def quasi_static(loop: LoopMasses, strand: int, x: ArrayLike) -> FloatArray:
    """Change of tension per unit of acceleration of the rigid body [kg]."""
    if isinstance(loop, HeldStrands):
        return held_strands.quasi_static(loop, strand, x)
    return loop_bounds.quasi_static(loop, strand, x)


def stray(loop: LoopMasses, strand: int, x: ArrayLike) -> FloatArray:
    """Most by which the answer to a step strays from it, per unit of acceleration [kg]."""
    if isinstance(loop, HeldStrands):
        return held_strands.stray(loop, strand, x)
    return loop_bounds.stray(loop, strand, x)


def tension_green(loop: LoopMasses, strand: int, x: ArrayLike) -> FloatArray:
    """Tension at a section opened with unit relative acceleration [kg]."""
    if isinstance(loop, HeldStrands):
        return held_strands.tension_green(loop, strand, x)
    return loop_bounds.tension_green(loop, strand, x)


def lowest_frequency_bound(loop: LoopMasses) -> float:
    """A lower bound of every natural frequency [rad/s]."""
    if isinstance(loop, HeldStrands):
        return held_strands.lowest_frequency(loop)
    return loop_bounds.lowest_frequency_bound(loop)


def modal_tensions(loop: LoopMasses, frequencies: FloatArray, strand: int, x: FloatArray) -> FloatArray:
    """Parts of the tension at sections with which the modes follow an acceleration, shape (k, n) [kg]."""
    if isinstance(loop, HeldStrands):
        return held_strands.modal_tensions(loop, frequencies, strand, x)
    return chain_resonance.modal_tensions(loop, frequencies, strand, x)


def drive_mobilities(loop: LoopMasses, frequencies: FloatArray) -> tuple[FloatArray, float]:
    """Shares of the modes in the motion of the drive under a force at it, and of all others [1/kg]."""
    if isinstance(loop, HeldStrands):
        return held_strands.drive_mobilities(loop, frequencies)
    return chain_resonance.drive_mobilities(loop, frequencies)


def swung_mass(loop: LoopMasses, strand: int, x: FloatArray) -> FloatArray:
    """Mass through which the energy of the accelerations bounds the tension at sections, shape (n,) [kg]."""
    if isinstance(loop, HeldStrands):
        return held_strands.swung_mass(loop, strand, x)
    behind = loop_bounds.mass_behind(loop, strand, x)
    return np.maximum(behind, loop.belt_mass - behind) if loop.fixed_length else behind


def modal_shapes(loop: LoopMasses, frequencies: FloatArray, strand: int, x: FloatArray) -> FloatArray:
    """Tensions of the modes at sections, shape (k, n) [kg]."""
    if isinstance(loop, HeldStrands):
        return held_strands.modal_shapes(loop, frequencies, strand, x)
    return chain_resonance.modal_shapes(loop, frequencies, strand, x)


def modal_rest(loop: LoopMasses, frequencies: FloatArray, strand: int, x: FloatArray) -> FloatArray:
    """Most that the modes left out can add up to at sections, shape (n,) [kg]."""
    if isinstance(loop, HeldStrands):
        return held_strands.modal_rest(loop, frequencies, strand, x)
    return chain_resonance.modal_rest(loop, frequencies, strand, x)
