"""Vertical curves of a belt conveyor: where the belt lifts off its idlers, and what a curve asks of edge and middle.

**A small element.** A piece ds of belt with the mass rho ds turns by d(phi) = ds/R. Its two ends pull with T, together
T d(phi) = T ds/R towards the centre of the curve; the idlers push with n ds away from the belt's underside, the weight
presses rho g cos(delta) ds on them, and the piece is accelerated by v^2/R towards the centre:

    concave (centre above):  n = rho g cos(delta) - (T - rho v^2)/R
    convex (centre below):   n = rho g cos(delta) + (T - rho v^2)/R

The tension may be that of any state: running, starting, with the next stretch loaded and this one empty.

**Across the belt.** A fibre at the height z over the neutral line runs on the radius R - z (concave) or R + z
(convex); with the mean strain given by T, its strain differs from the mean by z/R and its tension per width by
(EA/W) z/R, W the width. The neutral line is at the mean height of the belt.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]


def lift_off_radius(
    tension: ArrayLike, line_mass: float, speed: float, gravity: float, slope_cosine: float
) -> FloatArray:
    """Smallest radius of a concave curve in which the belt stays on its idlers.

        R = (T - rho v^2) / (rho g cos(delta))

    Args:
        tension: T, largest tension at the curve, starting included [N].
        line_mass: rho, of what lies in the curve: the bare belt while the curve is empty [kg/m].
        speed: v; 0 is on the safe side [m/s].
        gravity: g [m/s^2].
        slope_cosine: cos(delta), steepest slope in the curve [1].

    Returns:
        R; 0 where the belt has not even its centrifugal tension [m].

    **Range** a belt without bending stiffness, a curve longer than a few idler pitches.
    **Error** exact for that; a belt that does lift off finds a new line and is not lost at once.
    **Source** derived: equilibrium of an element (module docstring), n = 0; DIN 22101 and CEMA give it for v = 0.
    """
    force = np.maximum(np.asarray(tension, float) - line_mass * speed**2, 0.0)
    return np.asarray(force / (line_mass * gravity * slope_cosine))


def lift_off_tension(
    radius: ArrayLike, line_mass: float, speed: float, gravity: float, slope_cosine: float
) -> FloatArray:
    """Tension at which the belt lifts off in a concave curve.

        T = rho (g R cos(delta) + v^2)

    Args:
        radius: R [m].
        line_mass: rho, of what lies in the curve [kg/m].
        speed: v; 0 is on the safe side [m/s].
        gravity: g [m/s^2].
        slope_cosine: cos(delta), steepest slope in the curve [1].

    Returns:
        T [N].

    **Range** as `lift_off_radius`.
    **Error** as `lift_off_radius`.
    **Source** `lift_off_radius` solved for the tension.
    """
    return np.asarray(line_mass * (gravity * np.asarray(radius, float) * slope_cosine + speed**2))


def idler_line_load(
    tension: ArrayLike,
    radius: ArrayLike,
    line_mass: float,
    speed: float,
    gravity: float,
    slope_cosine: float,
    convex: bool,
) -> FloatArray:
    """Load of the idlers in a vertical curve per length.

        n = rho g cos(delta) + (T - rho v^2)/R in a convex curve,   - in a concave one

    Args:
        tension: T, at the curve [N].
        radius: R [m].
        line_mass: rho, belt and load [kg/m].
        speed: v [m/s].
        gravity: g [m/s^2].
        slope_cosine: cos(delta) [1].
        convex: True for a crest, False for a hollow.

    Returns:
        n; negative where the belt has to be held down [N/m].

    **Range** as `lift_off_radius`.
    **Error** exact for a belt without bending stiffness; single idlers differ with their alignment.
    **Source** derived: equilibrium of an element (module docstring).
    """
    bend = (np.asarray(tension, float) - line_mass * speed**2) / np.asarray(radius, float)
    return np.asarray(line_mass * gravity * slope_cosine + (bend if convex else -bend))


def idler_radius(
    tension: ArrayLike, line_mass: float, gravity: float, slope_cosine: float, spacing: float, allowed: float
) -> FloatArray:
    """Smallest radius of a convex curve whose idlers bear the belt.

        R = T l / (F - rho g cos(delta) l)

    Args:
        tension: T, at the curve [N].
        line_mass: rho, belt and load [kg/m].
        gravity: g [m/s^2].
        slope_cosine: cos(delta), least slope in the curve [1].
        spacing: l, of the idlers in the curve [m].
        allowed: F, load one idler set may bear [N].

    Returns:
        R; infinite where belt and load are too much on a straight already [m].

    **Range** as `lift_off_radius`; speed left out, on the safe side.
    **Error** as `idler_line_load`.
    **Source** `idler_line_load` times the spacing, solved for the radius.
    """
    left = allowed - line_mass * gravity * slope_cosine * spacing
    force = np.asarray(tension, float) * spacing
    return np.asarray(force / left) if left > 0 else np.full_like(force, np.inf)


def trough_heights(centre_width: float, side_width: float, trough_angle: float) -> tuple[float, float]:
    """How far the edge of a troughed belt is above the neutral line and its middle below.

        z_m = s^2 sin(lambda)/W,   edge: s sin(lambda) - z_m,   W = c + 2 s

    Args:
        centre_width: c, of the belt on the middle roll; 0 for two rolls [m].
        side_width: s, of the belt on each wing roll [m].
        trough_angle: lambda [rad].

    Returns:
        (edge [m], middle [m]), both positive distances.

    **Range** one stiffness over the width.
    **Error** exact for straight rolls.
    **Source** derived: mean height of the belt.
    """
    depth = side_width * np.sin(trough_angle)
    share = side_width / (centre_width + 2 * side_width)
    return depth * (1 - share), depth * share


def radius_for_largest(
    tension: ArrayLike, width: float, stiffness: float, height: float, allowed: ArrayLike
) -> FloatArray:
    """Smallest radius at which the fibre that a curve stretches keeps within an allowed tension.

        R = (EA/W) z / (k_max - T/W)

    Args:
        tension: T, at the curve [N].
        width: W, of the belt [m].
        stiffness: EA, tensile stiffness of the whole belt [N].
        height: z, of `trough_heights`: edge in a convex curve, middle in a concave one [m].
        allowed: k_max, tension per width the belt may have [N/m].

    Returns:
        R; infinite where the mean alone is too much [m].

    **Range** plane sections, R much larger than the trough is deep.
    **Error** z/R of the value; a belt of low stiffness across evens out part of it, on the safe side.
    **Source** derived: strain z/R of a fibre (module docstring); the same rule in DIN 22101 and CEMA.
    """
    left = np.asarray(allowed, float) - np.asarray(tension, float) / width
    return _radius(stiffness / width * height, left)


def radius_for_least(tension: ArrayLike, width: float, stiffness: float, height: float, least: ArrayLike) -> FloatArray:
    """Smallest radius at which the fibre that a curve relieves keeps a wanted tension.

        R = (EA/W) z / (T/W - k_min)

    Args:
        tension: T, least tension at the curve [N].
        width: W, of the belt [m].
        stiffness: EA, tensile stiffness of the whole belt [N].
        height: z, of `trough_heights`: middle in a convex curve, edge in a concave one [m].
        least: k_min, tension per width that must be left; 0 is where it buckles [N/m].

    Returns:
        R; infinite where the mean alone is too little [m].

    **Range** as `radius_for_largest`.
    **Error** as `radius_for_largest`.
    **Source** as `radius_for_largest`.
    """
    left = np.asarray(tension, float) / width - np.asarray(least, float)
    return _radius(stiffness / width * height, left)


def _radius(bending: float, left: FloatArray) -> FloatArray:
    there = left > 0
    return np.asarray(np.divide(bending, left, out=np.full(left.shape, np.inf), where=there))
