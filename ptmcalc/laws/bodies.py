"""Moments of inertia of the bodies a drive train and a crane are made of, each about the axis that is named.

Source of the list: N. Yu. Dorokhov, "Dynamics of hoisting and conveying machines", lecture notes, Kramatorsk 2007
(the table of inertias); its sketches are lost, every formula here is the elementary integral of r^2 dm.
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]

DRUM_SHAPE, SHEAVE_SHAPE, COUPLING_SHAPE = (0.65, 0.80), (0.55, 0.70), (0.40, 0.60)
"""Usual range of k in `estimated_body`: drums with end discs and shaft, sheaves and gears of rim, web and hub (both
recomputed from typical proportions), couplings of any kind (estimated) [1]."""

GYRATION, OUTER_DIAMETER = "gyration", "outer_diameter"


def solid_cylinder(mass: float, diameter: float) -> float:
    """Moment of inertia of a solid cylinder about its axis.

        J = m D^2 / 8

    Args:
        mass: m [kg].
        diameter: D [m].

    Returns:
        J [kg*m^2].

    **Range** uniform density.
    **Error** exact.
    **Source** elementary integration.
    """
    return mass * diameter**2 / 8


def hollow_cylinder(mass: float, outer_diameter: float, inner_diameter: float) -> float:
    """Moment of inertia of a hollow cylinder about its axis.

        J = m (D^2 + d^2) / 8

    Args:
        mass: m, of the ring of material [kg].
        outer_diameter: D [m].
        inner_diameter: d, 0 for a solid one [m].

    Returns:
        J [kg*m^2].

    **Range** uniform density, 0 <= d <= D.
    **Error** exact.
    **Source** elementary integration.
    """
    return mass * (outer_diameter**2 + inner_diameter**2) / 8


def thin_ring(mass: float, mean_diameter: float) -> float:
    """Moment of inertia of a thin ring about its axis.

        J = m D^2 / 4

    Args:
        mass: m [kg].
        mean_diameter: D, in the middle of the wall [m].

    Returns:
        J [kg*m^2].

    **Range** wall thickness s well below D.
    **Error** too small by the share (s/D)^2: 1 % for a wall of a tenth of the diameter.
    **Source** elementary integration.
    """
    return mass * mean_diameter**2 / 4


def point_mass(mass: float, distance: float) -> float:
    """Moment of inertia of a mass that is small against its distance from the axis.

        J = m a^2

    Args:
        mass: m [kg].
        distance: a, from the axis [m].

    Returns:
        J [kg*m^2].

    **Range** a hanging load too, while it does not swing; a body longer than a fraction of a needs `parallel_axis`.
    **Error** leaves out the central moment of inertia of the body.
    **Source** definition of the moment of inertia.
    """
    return mass * distance**2


def parallel_axis(central_inertia: float, mass: float, distance: float) -> float:
    """Moment of inertia of a body about an axis parallel to the one through its centre of mass.

        J = J_c + m a^2

    Args:
        central_inertia: J_c, about the parallel axis through the centre of mass [kg*m^2].
        mass: m [kg].
        distance: a, between the axes [m].

    Returns:
        J [kg*m^2].

    **Range** any rigid body.
    **Error** exact.
    **Source** C. Huygens, J. Steiner: parallel axis theorem.
    """
    return central_inertia + mass * distance**2


def rings(density: float, outer_radii: FloatArray, inner_radii: FloatArray, widths: FloatArray) -> tuple[float, float]:
    """Mass and moment of inertia of a sheave, pulley or gear made of coaxial rings: rim, web, hub.

        m_i = pi rho b_i (R_i - r_i)(R_i + r_i)      J = sum m_i (R_i^2 + r_i^2)/2

    Args:
        density: rho, the same for all rings [kg/m^3].
        outer_radii: R_i, shape (n,) [m].
        inner_radii: r_i, shape (n,) [m].
        widths: b_i, along the axis, shape (n,) [m].

    Returns:
        (m = sum m_i [kg], J [kg*m^2]).

    **Range** full rings; spokes and holes count as a web of the same mass and radii.
    **Error** exact for rings; fillets, grooves and teeth are left out.
    **Source** elementary integration.
    """
    outer, inner = np.asarray(outer_radii, float), np.asarray(inner_radii, float)
    masses = math.pi * density * np.asarray(widths, float) * (outer - inner) * (outer + inner)
    return float(masses.sum()), float((masses * (outer**2 + inner**2)).sum() / 2)


def drum(
    density: float,
    outer_diameter: float,
    inner_diameter: float,
    length: float,
    disc_thickness: float,
    shaft_diameter: float,
) -> tuple[float, float]:
    """Mass and moment of inertia of a drum: a shell, two end discs on a shaft, the shaft as long as the shell.

        J = J_shell(D, d, L) + 2 J_disc(d, d_s, b) + J_shaft(d_s, 0, L)      each a ring of `rings`

    Args:
        density: rho, of the whole drum [kg/m^3].
        outer_diameter: D, of the shell [m].
        inner_diameter: d, of the shell, where the discs end [m].
        length: L, of shell and shaft [m].
        disc_thickness: b, of each of the two end discs [m].
        shaft_diameter: d_s, where the discs begin; 0 for none [m].

    Returns:
        (m [kg], J [kg*m^2]).

    **Range** 0 <= d_s <= d <= D.
    **Error** exact for these rings; ribs, hubs and grooves are left out.
    **Source** elementary integration.
    """
    outer = np.array([outer_diameter, inner_diameter, shaft_diameter]) / 2
    inner = np.array([inner_diameter, shaft_diameter, 0.0]) / 2
    return rings(density, outer, inner, np.array([length, 2 * disc_thickness, length]))


def estimated_body(mass: float, outer_radius: float, shape: float) -> float:
    """Moment of inertia of a turning part of which only mass and size are known.

        J = k m R^2

    Args:
        mass: m [kg].
        outer_radius: R [m].
        shape: k; usual ranges are `DRUM_SHAPE`, `SHEAVE_SHAPE`, `COUPLING_SHAPE` [1].

    Returns:
        J [kg*m^2].

    **Range** 1/2 is a solid cylinder, 1 a thin ring; a first estimate until a drawing is there.
    **Error** the width of the range: 10 % of the middle for drums, 12 % for sheaves and gears, 20 % for couplings.
    **Source** derived: `rings` on typical proportions; the coefficients of the lecture notes Kramatorsk 2007 are lost.
    """
    return shape * mass * outer_radius**2


def rod_about_end(mass: float, length: float) -> float:
    """Moment of inertia of a slender rod about an axis across it through one end.

        J = m l^2 / 3

    Args:
        mass: m [kg].
        length: l [m].

    Returns:
        J [kg*m^2].

    **Range** thickness s well below l.
    **Error** too small by the share (s/l)^2/4 for a square section.
    **Source** elementary integration.
    """
    return mass * length**2 / 3


def rod_about_centre(mass: float, length: float) -> float:
    """Moment of inertia of a slender rod about an axis across it through its centre.

        J = m l^2 / 12

    Args:
        mass: m [kg].
        length: l [m].

    Returns:
        J [kg*m^2].

    **Range** thickness s well below l.
    **Error** too small by the share (s/l)^2 for a square section.
    **Source** elementary integration.
    """
    return mass * length**2 / 12


def rod_radial(mass: float, length: float, distance: float) -> float:
    """Moment of inertia of a slender rod that points away from the axis and begins at a distance: a jib.

        J = m (l^2/12 + (a + l/2)^2)

    Args:
        mass: m [kg].
        length: l [m].
        distance: a, from the axis to the nearer end [m].

    Returns:
        J [kg*m^2].

    **Range** the rod at right angles to the axis; a = 0 gives `rod_about_end`.
    **Error** as `rod_about_centre`.
    **Source** parallel axis theorem.
    """
    return parallel_axis(rod_about_centre(mass, length), mass, distance + length / 2)


def rod_parallel(mass: float, distance: float, rod_radius: float) -> float:
    """Moment of inertia of a round rod parallel to the axis.

        J = m (a^2 + r^2/2)

    Args:
        mass: m [kg].
        distance: a, between rod and axis [m].
        rod_radius: r, of the rod; 0 for a slender one [m].

    Returns:
        J [kg*m^2].

    **Range** any length.
    **Error** exact.
    **Source** parallel axis theorem.
    """
    return parallel_axis(mass * rod_radius**2 / 2, mass, distance)


def rod_inclined(mass: float, length: float, angle: float) -> float:
    """Moment of inertia of a slender rod that starts on the axis at an angle to it.

        J = (m l^2/3) sin(alpha)^2

    Args:
        mass: m [kg].
        length: l [m].
        angle: alpha, between rod and axis [rad].

    Returns:
        J [kg*m^2].

    **Range** thickness well below l sin(alpha).
    **Error** exact for a line.
    **Source** elementary integration.
    """
    return rod_about_end(mass, length) * math.sin(angle) ** 2


def inertia_of_gd2(gd2: ArrayLike, definition: str) -> FloatArray:
    """Moment of inertia of a catalogue's GD^2, by what its D is.

        gyration:        J = GD^2/4     D is twice the radius of gyration (catalogues of motors and couplings)
        outer_diameter:  J = GD^2/8     D is the outer diameter of a solid cylinder (handbook tables)

    GD^2 in kgf m^2 is the same number as in kg m^2, a kilogram-force being the weight of a kilogram.

    Args:
        gd2: GD^2, printed in kgf m^2 [kg*m^2].
        definition: `gyration` or `outer_diameter`.

    Returns:
        J [kg*m^2].

    **Range** each reading where it is meant; they differ by a factor of 2.
    **Error** exact.
    **Source** J = m i^2 with the radius of gyration i = D/2; `solid_cylinder`; J = GD^2/(8 g) in kgf m s^2 in the
    lecture notes Kramatorsk 2007.

    Raises:
        ValueError: for another definition.
    """
    divisors = {GYRATION: 4.0, OUTER_DIAMETER: 8.0}
    if definition not in divisors:
        raise ValueError(f"a definition of GD^2 is {GYRATION} or {OUTER_DIAMETER}")
    return np.asarray(gd2, float) / divisors[definition]
