"""Single steps of the compiled belt, as functions of numbers."""

import ctypes

from ptmcalc.numerics.belt.compiled import check, library


def velocity(
    old: float,
    mass: float,
    against: float,
    friction: tuple[float, float],
    forcing: tuple[float, float],
    step: float,
) -> float:
    """Speed at the end of a step of m v' + Z v + R sgn v = g, with R and g linear over the step."""
    fault, pairs = ctypes.c_int64(), [(ctypes.c_double * 2)(*pair) for pair in (friction, forcing)]
    ends = [ctypes.addressof(one) for one in (*pairs, fault)]
    found: float = library().belt_velocity(old, mass, against, *ends[:2], step, ends[2])
    check(fault.value, 0.0)
    return found


def exponential(x: float) -> tuple[float, float, float]:
    """exp(-x), and by what the forcing at the start and the end of a step counts."""
    found = (ctypes.c_double * 3)()
    library().belt_exponential(x, ctypes.addressof(found))
    return found[0], found[1], found[2]
