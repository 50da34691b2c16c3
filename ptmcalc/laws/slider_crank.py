"""Slider-crank: where the slider is, how fast it moves, and what all its masses are worth on the crank.

The crank pin is at r (cos phi, sin phi), the slider at (x, e): the angle 0 is where a slider without offset is farthest
from the crank's axis. The rod is inclined by psi with sin psi = (r sin phi - e)/l.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Linkage:
    """Crank radius r, rod length l > r + |e| and offset e of the slider's line [m]."""

    radius: float
    rod: float
    offset: float

    def at(self, angle: ArrayLike) -> "Position":
        """The linkage at angles of the crank [rad]."""
        phi = np.asarray(angle, float)
        sin, cos = np.sin(phi), np.cos(phi)
        crank = self.radius / self.rod
        lean = crank * sin - self.offset / self.rod
        upright = np.sqrt((1 - lean) * (1 + lean))
        turn = crank * cos / upright
        return Position(self, sin, cos, lean, upright, turn, (lean * turn**2 - crank * sin) / upright)


@dataclass(frozen=True, slots=True)
class Position:
    """A linkage at some angles: sine and cosine of crank and rod, and the turn of the rod per turn of the crank.

    psi' = r cos phi/(l cos psi),  psi'' = (l sin psi psi'^2 - r sin phi)/(l cos psi)
    """

    linkage: Linkage
    sin: FloatArray
    cos: FloatArray
    lean: FloatArray
    upright: FloatArray
    turn: FloatArray
    turn_slope: FloatArray

    def along(self, centre: float) -> FloatArray:
        """Distance of a point of the rod from the crank's axis along the slider's line; 1 is the slider [m]."""
        return self.linkage.radius * self.cos + centre * self.linkage.rod * self.upright

    def across(self, centre: float) -> FloatArray:
        """Its distance across that line [m]."""
        return (1 - centre) * self.linkage.radius * self.sin + centre * self.linkage.offset

    def along_slope(self, centre: float) -> FloatArray:
        """Change of `along` with the angle [m]."""
        return -self.linkage.radius * self.sin - centre * self.linkage.rod * self.lean * self.turn

    def across_slope(self, centre: float) -> FloatArray:
        """Change of `across` with the angle [m]."""
        return (1 - centre) * self.linkage.radius * self.cos

    def inertia(
        self, slider_mass: float, rod_mass: float, rod_centre: float, rod_inertia: float
    ) -> tuple[FloatArray, FloatArray]:
        """Reduced inertia [kg*m^2] and its change with the angle."""
        slider = self.along_slope(1.0)
        value = slider_mass * slider**2
        bend = self.linkage.rod * (self.upright * self.turn**2 + self.lean * self.turn_slope)
        swing = -self.linkage.radius * self.cos
        half = slider_mass * slider * (swing - bend)
        if rod_mass == 0 == rod_inertia:
            return value, 2 * half
        along, across = self.along_slope(rod_centre), self.across_slope(rod_centre)
        value = value + rod_mass * (along**2 + across**2) + rod_inertia * self.turn**2
        across_bend = -(1 - rod_centre) * self.linkage.radius * self.sin
        half = half + rod_mass * (along * (swing - rod_centre * bend) + across * across_bend)
        return value, 2 * (half + rod_inertia * self.turn * self.turn_slope)

    def lift(self, centre: float, inclination: float) -> FloatArray:
        """Change with the angle of the height of a point of the rod [m]."""
        across, along = self.across_slope(centre), self.along_slope(centre)
        return np.asarray(across * np.cos(inclination) - along * np.sin(inclination))


def slider_position(angle: ArrayLike, crank_radius: float, rod_length: float, offset: float) -> FloatArray:
    """Distance of the slider from the crank's axis, along its line.

        x = r cos phi + sqrt(l^2 - (r sin phi - e)^2)

    Args:
        angle: phi, of the crank [rad].
        crank_radius: r [m].
        rod_length: l, longer than r + |e| [m].
        offset: e, of the slider's line from the crank's axis [m].

    Returns:
        x [m].

    **Range** l > r + |e|: the crank turns round.
    **Error** exact for rigid links.
    **Source** geometry of the triangle.
    """
    return np.asarray(Linkage(crank_radius, rod_length, offset).at(angle).along(1.0))


def slider_velocity(angle: ArrayLike, crank_radius: float, rod_length: float, offset: float) -> FloatArray:
    """Way of the slider per angle of the crank: the arm at which a force on the slider acts on the crank.

        dx/dphi = -r sin phi - l sin psi psi'

    Args:
        angle: phi, of the crank [rad].
        crank_radius: r [m].
        rod_length: l, longer than r + |e| [m].
        offset: e, of the slider's line from the crank's axis [m].

    Returns:
        dx/dphi; negative while the slider comes nearer [m/rad].

    **Range** l > r + |e|.
    **Error** exact for rigid links.
    **Source** derivative of `slider_position`.
    """
    return np.asarray(Linkage(crank_radius, rod_length, offset).at(angle).along_slope(1.0))


def dead_centre(crank_radius: float, rod_length: float, offset: float, far: bool) -> tuple[float, float]:
    """Position of the slider at a dead centre, and the angle of the crank there.

        far:   x = sqrt((l + r)^2 - e^2),  phi = asin(e/(l + r))
        near:  x = sqrt((l - r)^2 - e^2),  phi = pi + asin(e/(l - r))

    Args:
        crank_radius: r [m].
        rod_length: l, longer than r + |e| [m].
        offset: e [m].
        far: whether the dead centre farthest from the crank's axis is meant.

    Returns:
        (x [m], phi [rad]).

    **Range** l > r + |e|.
    **Error** exact.
    **Source** crank and rod in one line.
    """
    reach = rod_length + crank_radius if far else rod_length - crank_radius
    angle = float(np.arcsin(offset / reach)) + (0.0 if far else np.pi)
    return float(np.sqrt((reach - offset) * (reach + offset))), angle


def crank_angles(position: float, crank_radius: float, rod_length: float, offset: float) -> tuple[float, float]:
    """The two angles of the crank at which the slider is at a position, on its way out and on its way back.

        phi = atan2(e, x) -+ acos((r^2 + x^2 + e^2 - l^2)/(2 r sqrt(x^2 + e^2)))

    Args:
        position: x, between the dead centres [m].
        crank_radius: r [m].
        rod_length: l, longer than r + |e| [m].
        offset: e [m].

    Returns:
        (phi on the way out, phi on the way back); the first is below the second [rad].

    **Range** beyond a dead centre both are its angle.
    **Error** exact; near a dead centre the digits of the angle are half those of the position.
    **Source** law of cosines.
    """
    away = float(np.hypot(position, offset))
    cosine = (crank_radius / away + (away - rod_length) / away * ((away + rod_length) / crank_radius)) / 2
    opening = float(np.arccos(np.clip(cosine, -1.0, 1.0)))
    middle = float(np.arctan2(offset, position))
    return middle - opening, middle + opening


def reduced_inertia(
    angle: ArrayLike,
    crank_radius: float,
    rod_length: float,
    offset: float,
    slider_mass: float,
    rod_mass: float,
    rod_centre: float,
    rod_inertia: float,
) -> FloatArray:
    """Inertia on the crank that stands for slider and rod.

        J = m_s x'^2 + m_r (x_c'^2 + y_c'^2) + J_r psi'^2,
        x_c' = -r sin phi - c l sin psi psi',  y_c' = (1 - c) r cos phi

    Args:
        angle: phi, of the crank [rad].
        crank_radius: r [m].
        rod_length: l, longer than r + |e| [m].
        offset: e [m].
        slider_mass: m_s [kg].
        rod_mass: m_r [kg].
        rod_centre: c, distance of its centre of mass from the crank pin over l [1].
        rod_inertia: J_r, about its centre of mass [kg*m^2].

    Returns:
        J [kg*m^2].

    **Range** l > r + |e|.
    **Error** exact for rigid links.
    **Source** kinetic energy over w^2/2.
    """
    position = Linkage(crank_radius, rod_length, offset).at(angle)
    return np.asarray(position.inertia(slider_mass, rod_mass, rod_centre, rod_inertia)[0])


def reduced_inertia_slope(
    angle: ArrayLike,
    crank_radius: float,
    rod_length: float,
    offset: float,
    slider_mass: float,
    rod_mass: float,
    rod_centre: float,
    rod_inertia: float,
) -> FloatArray:
    """Change of `reduced_inertia` with the angle.

        dJ/dphi = 2 (m_s x' x'' + m_r (x_c' x_c'' + y_c' y_c'') + J_r psi' psi'')

    Args:
        angle: phi, of the crank [rad].
        crank_radius: r [m].
        rod_length: l, longer than r + |e| [m].
        offset: e [m].
        slider_mass: m_s [kg].
        rod_mass: m_r [kg].
        rod_centre: c, distance of its centre of mass from the crank pin over l [1].
        rod_inertia: J_r, about its centre of mass [kg*m^2].

    Returns:
        dJ/dphi [kg*m^2/rad].

    **Range** l > r + |e|.
    **Error** exact for rigid links.
    **Source** derivative of `reduced_inertia`.
    """
    position = Linkage(crank_radius, rod_length, offset).at(angle)
    return np.asarray(position.inertia(slider_mass, rod_mass, rod_centre, rod_inertia)[1])


def rod_centre_height(
    angle: ArrayLike, crank_radius: float, rod_length: float, offset: float, rod_centre: float, inclination: float
) -> FloatArray:
    """Height of the rod's centre of mass above the crank's axis.

        h = y_c cos beta - x_c sin beta,
        x_c = r cos phi + c l cos psi,  y_c = (1 - c) r sin phi + c e

    Args:
        angle: phi, of the crank [rad].
        crank_radius: r [m].
        rod_length: l, longer than r + |e| [m].
        offset: e [m].
        rod_centre: c, distance of its centre of mass from the crank pin over l; 1 is the slider itself [1].
        inclination: beta, of the slide below the horizontal, from the crank to the slider [rad].

    Returns:
        h [m].

    **Range** l > r + |e|.
    **Error** exact for rigid links.
    **Source** geometry.
    """
    position = Linkage(crank_radius, rod_length, offset).at(angle)
    across, along = position.across(rod_centre), position.along(rod_centre)
    return np.asarray(across * np.cos(inclination) - along * np.sin(inclination))


def rod_centre_lift(
    angle: ArrayLike, crank_radius: float, rod_length: float, offset: float, rod_centre: float, inclination: float
) -> FloatArray:
    """Change of `rod_centre_height` with the angle: times its weight, the torque against the motion.

        dh/dphi = y_c' cos beta - x_c' sin beta

    Args:
        angle: phi, of the crank [rad].
        crank_radius: r [m].
        rod_length: l, longer than r + |e| [m].
        offset: e [m].
        rod_centre: c, distance of its centre of mass from the crank pin over l; 1 is the slider itself [1].
        inclination: beta, of the slide below the horizontal, from the crank to the slider [rad].

    Returns:
        dh/dphi [m/rad].

    **Range** l > r + |e|.
    **Error** exact for rigid links.
    **Source** derivative of `rod_centre_height`.
    """
    return np.asarray(Linkage(crank_radius, rod_length, offset).at(angle).lift(rod_centre, inclination))
