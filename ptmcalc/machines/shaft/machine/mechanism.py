"""Inertia of the mechanism on a main shaft over the angle, with the torque of its weights and springs."""

from collections.abc import Callable
from functools import partial

import numpy as np
from numpy.typing import NDArray

from ptmcalc.laws import slider_crank
from ptmcalc.laws.slider_crank import Linkage
from ptmcalc.machines.shaft.machine.spec import (
    EnergyTable,
    HarmonicInertia,
    PotentialHarmonic,
    Shaft,
    SliderCrank,
    TableInertia,
    ToolSpring,
    Unbalance,
)
from ptmcalc.numerics import spline

FloatArray = NDArray[np.float64]
OverAngle = Callable[[FloatArray], FloatArray]
ValueAndSlope = Callable[[FloatArray], tuple[FloatArray, FloatArray]]
Shape = Callable[[FloatArray], tuple[FloatArray, FloatArray, FloatArray | None]]
"""Inertia of the mechanism, its slope, and the torque of weights and springs, over the angle."""
SAME_ANGLE = 1e-9
"""Distance [rad] up to which two breaks of the cycle count as one; for tool positions relative to the crank radius. A
numerical choice: it is above the rounding of an angle, about 1e-15. A larger value merges separate breaks; a smaller
one leaves stretches of rounding width."""


def filled(value: float | None) -> float:
    """A value the file or an assumption has given by now."""
    assert value is not None, "assumptions are filled in before anything is computed"
    return value


def shape_of(spec: Shaft) -> tuple[Shape, list[float]]:
    """Inertia, its slope and the torque of weights and springs over the angle, and where they are not smooth."""
    potential, breaks = _potential(spec)
    given = spec.inertia
    if isinstance(given, SliderCrank):
        return _crank(given, spec, potential), breaks
    if isinstance(given, TableInertia):
        curve = inertia_curve(given, spec.cycle_angle)
        return _with(curve, potential), [*breaks, *curve.knots[:-1].tolist()]
    if isinstance(given, HarmonicInertia):
        series = _series(given.mean, [(term.order, term.cosine, term.sine) for term in given.terms])
        return _with(series, potential), breaks
    value = given.value
    return _with(lambda angle: (np.full(angle.shape, value), np.zeros(angle.shape)), potential), breaks


def _with(inertia: ValueAndSlope, potential: OverAngle | None) -> Shape:
    return lambda angle: (*inertia(angle), None if potential is None else potential(angle))


def inertia_curve(table: TableInertia, period: float) -> spline.PeriodicSpline:
    """The closed curve through the points of a table."""
    return spline.through([p.angle for p in table.points], [p.inertia for p in table.points], period)


def _series(mean: float, terms: list[tuple[int, float, float]]) -> ValueAndSlope:
    def value_and_slope(angle: FloatArray) -> tuple[FloatArray, FloatArray]:
        value, slope = np.full(angle.shape, mean), np.zeros(angle.shape)
        for order, cosine, sine in terms:
            c, s = np.cos(order * angle), np.sin(order * angle)
            value = value + (cosine * c + sine * s)
            slope = slope + order * (sine * c - cosine * s)
        return value, slope

    return value_and_slope


def linkage_of(crank: SliderCrank) -> Linkage:
    """The linkage of a slider-crank."""
    return Linkage(crank.crank_radius, crank.rod_length, crank.offset)


def _crank(crank: SliderCrank, spec: Shaft, potential: OverAngle | None) -> Shape:
    """All of a slider-crank from one look at its linkage: masses, weights, springs at the tool."""
    linkage, far = (
        linkage_of(crank),
        slider_crank.dead_centre(crank.crank_radius, crank.rod_length, crank.offset, True)[0],
    )
    centre, rod_inertia = filled(crank.rod_centre), filled(crank.rod_inertia)
    masses = crank.slider_mass, crank.rod_mass, centre, rod_inertia
    tilt, g = crank.inclination, spec.gravity
    springs = [given for given in spec.potential if isinstance(given, ToolSpring)]
    plain = tilt is None and not springs

    def shape(angle: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray | None]:
        at = linkage.at(angle)
        value, slope = at.inertia(*masses)
        value = crank.crank_inertia + value
        torque = None if potential is None else potential(angle)
        if plain:
            return value, slope, torque
        whole = np.zeros(angle.shape) if torque is None else torque
        if tilt is not None:
            whole = whole + g * (crank.slider_mass * at.lift(1.0, tilt) + crank.rod_mass * at.lift(centre, tilt))
        for spring in springs:  # the pull towards the crank acts against the way out, dx/dphi > 0
            pull = spring.force - spring.stiffness * (far - at.along(1.0))
            whole = whole + pull * at.along_slope(1.0)
        return value, slope, whole

    return shape


def _potential(spec: Shaft) -> tuple[OverAngle | None, list[float]]:
    """Torque of weights and springs that act on the shaft itself, the slope of the energy they store, and the angles at
    which it is not smooth."""
    parts: list[OverAngle] = []
    breaks: list[float] = []
    for given in spec.potential:
        if isinstance(given, EnergyTable):
            curve = spline.through([p.angle for p in given.points], [p.energy for p in given.points], spec.cycle_angle)
            parts.append(partial(_slope_of, curve))
            breaks += curve.knots[:-1].tolist()
        elif isinstance(given, Unbalance):
            parts.append(partial(_unbalance, given.mass * spec.gravity * given.radius, given.top))
        elif isinstance(given, PotentialHarmonic):
            parts.append(partial(_harmonic, given.order, given.cosine, given.sine))
    if not parts:
        return None, []
    return lambda angle: np.asarray(sum(part(angle) for part in parts)), breaks


def _slope_of(curve: spline.PeriodicSpline, angle: FloatArray) -> FloatArray:
    return curve(angle)[1]


def _unbalance(weight: float, top: float, angle: FloatArray) -> FloatArray:
    return -weight * np.sin(angle - top)


def _harmonic(order: int, cosine: float, sine: float, angle: FloatArray) -> FloatArray:
    return np.asarray(cosine * np.cos(order * angle) + sine * np.sin(order * angle))
