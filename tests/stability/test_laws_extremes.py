"""The laws far outside a machine's numbers: twenty-four decades, zeros, huge exponents, tiny differences.

Warnings are errors in this suite, so a silent overflow or 0/0 fails a test by itself. Digits are checked against
rational and decimal arithmetic of the standard library (60 digits), written from the physics and not from the code.
"""

import math
import re
from collections.abc import Callable
from dataclasses import astuple, replace
from decimal import Decimal, getcontext, localcontext
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from ptmcalc.laws import (
    backlash,
    belt_damping,
    belt_modes,
    belt_resistance,
    belt_section,
    bodies,
    brake,
    buffer,
    capstan,
    carriage,
    chain_fatigue,
    chain_resonance,
    chain_selection,
    chain_start,
    chain_wear,
    classification,
    contact_damping,
    coulomb,
    duty,
    equalising,
    fork,
    gearing,
    hoist_class,
    hoisting,
    inertia,
    lift_off,
    lift_off_standard,
    loop_bounds,
    mast,
    mast_compliance,
    mast_modes,
    motor,
    obstacle,
    overturning,
    pendulum,
    polygon,
    quotient,
    rail,
    reeving,
    resistance,
    response,
    rope_drum,
    rope_rod,
    safety_gear,
    sag,
    shaft,
    shock,
    similarity,
    skew,
    skid,
    slewing,
    slider_crank,
    slip_heat,
    sprocket,
    standard_factors,
    start_profile,
    stopping,
    strand_tension,
    travel,
    two_mass,
    vertical_curve,
    vibration,
    wave,
    wheel_loads,
    winding,
    wire_rope,
)
from ptmcalc.laws.loop_bounds import CARRY, RETURN, LoopMasses

DIGITS = 60
PI = Decimal("3.14159265358979323846264338327950288419716939937510582097494")
DECADES = (-12.0, 12.0)


def precise(compute: Callable[[], Decimal]) -> float:
    """A number computed with 60 digits and rounded once."""
    with localcontext() as context:
        context.prec = DIGITS
        context.Emin, context.Emax = -9999, 9999
        return float(compute())


def test_the_decimal_reference_has_its_digits() -> None:
    assert precise(lambda: Decimal(1).exp()) == math.e
    assert float(PI) == math.pi
    assert getcontext().prec < DIGITS  # only inside `precise`


def sine(angle: Decimal) -> Decimal:
    """Taylor series, for angles up to pi."""
    term = total = angle
    for k in range(1, 60):
        term *= -angle * angle / ((2 * k) * (2 * k + 1))
        total += term
    return total


# --- every law over twenty-four decades -------------------------------------------------------------------------


class Draw:
    """Random positive numbers, their decades spread evenly."""

    def __init__(self, seed: int, decades: tuple[float, float] = DECADES) -> None:
        self.rng, self.decades = np.random.default_rng(seed), decades

    def positive(self, count: int) -> list[float]:
        return [float(x) for x in 10 ** self.rng.uniform(*self.decades, count)]

    def share(self) -> float:
        """Between 0 and 1, both ends among them."""
        return float(self.rng.choice([0.0, 1.0, *self.rng.uniform(0, 1, 4)]))

    def loop(self, fixed_length: bool, imposed_speed: bool) -> LoopMasses:
        return LoopMasses(*self.positive(6), fixed_length=fixed_length, imposed_speed=imposed_speed)

    def shape(self, *among: str) -> str | tuple[tuple[float, float], ...]:
        """One of the words, or points that rise from 0 to 1."""
        if "ramp" in among and self.rng.random() < 0.2:
            return (0.0, 0.0), (self.share() / 2 + 1e-12, self.share()), (1.0, 1.0)
        return str(self.rng.choice(among))


def under_a_bridge(draw: Draw) -> tuple[Any, ...]:
    """A column under two girders, somewhere between their ends."""
    column, span = draw.positive(3), draw.positive(1)[0]
    place = span * (0.01 + 0.98 * draw.share())
    ends, wheels = draw.rng.choice(["supported", "clamped"]), draw.rng.choice(["free", "braked"])
    return *column, span, *draw.positive(3), place, str(ends), str(wheels)


def shares_of_a_root(draw: Draw) -> tuple[float, float]:
    turned = draw.share()
    return turned, (1 - turned) * draw.share()


def a_mast(draw: Draw) -> mast_modes.Mast:
    """Masses and springs twelve decades apart, a base that is free, a load at its tip or below."""
    draw = Draw(int(draw.rng.integers(1 << 30)), (-3.0, 3.0))
    place = draw.rng.uniform(0.3, 1.0) if draw.share() else 1.0
    return mast_modes.Mast(*draw.positive(6), *(one * draw.share() for one in draw.positive(2)), place)


def packed(draw: Draw) -> str:
    return str(draw.rng.choice(["nested", "square"]))


def two_interval(draw: Draw) -> tuple[float, float, float, float]:
    force, contour, tau = draw.positive(3)
    return force, contour, tau, 2 * contour * draw.share()


def in_loop(fixed_length: bool) -> Callable[[Draw], tuple[LoopMasses, int, float]]:
    def arguments(draw: Draw) -> tuple[LoopMasses, int, float]:
        loop = draw.loop(fixed_length, bool(draw.rng.integers(2)))
        return loop, int(draw.rng.integers(2)), draw.share()

    return arguments


def whole_loop(fixed_length: bool) -> Callable[[Draw], tuple[LoopMasses]]:
    return lambda draw: in_loop(fixed_length)(draw)[:1]


def phase_numbers(shape: str, imposed_speed: bool, rise_time: float, frequency: float) -> list[tuple[float, ...]]:
    return [astuple(phase) for phase in start_profile.phases(shape, imposed_speed, rise_time, frequency)]


def rating(draw: Draw) -> tuple[float, float, float]:
    """Rated slip, overload and a stator ratio a motor of this rating may have."""
    slip, more = draw.positive(2)
    return slip, 1 + more, 0.999 * draw.share() * motor.largest_stator_ratio(slip, 1 + more)


def kloss_curve(draw: Draw) -> tuple[float, float, float]:
    """Breakdown torque, breakdown slip, stator ratio."""
    torque, slip = draw.positive(2)
    return torque, slip, 0.999 * draw.share() / slip


def on_kloss_curve(draw: Draw) -> tuple[float, float, float, float]:
    return float(draw.rng.choice([-1, 1])) * draw.positive(1)[0], *kloss_curve(draw)


def stable_on_kloss_curve(draw: Draw) -> tuple[float, float, float, float]:
    curve = kloss_curve(draw)
    return (2 * draw.share() - 1) * curve[0], *curve


def range_of_kloss_curve(draw: Draw) -> tuple[float, ...]:
    return *draw.positive(2), *kloss_curve(draw)


def two_slips(draw: Draw) -> tuple[float, float]:
    low = 10 ** draw.rng.uniform(-12.0, -1e-9)
    return low ** draw.rng.uniform(1e-3, 0.9), low


def cycle(draw: Draw, numbers: int) -> tuple[Any, ...]:
    """So many lists, a number for each of 1 to 9 pieces."""
    pieces = int(draw.rng.integers(1, 10))
    return tuple(np.array(draw.positive(pieces)) for _ in range(numbers))


def duties(draw: Draw) -> tuple[float, ...]:
    """Torque, two duty factors of which the second is not above the first, loss ratio and cooling at rest."""
    torque, ratio = draw.positive(2)
    shares = 10 ** draw.rng.uniform(-12.0, 0.0, 2)
    return torque, float(max(shares)), float(min(shares)), ratio, draw.share()


def efficiency(draw: Draw) -> float:
    return float(10 ** draw.rng.uniform(DECADES[0], 0.0))


def geared(draw: Draw) -> tuple[float, ...]:
    """Two torques or an acceleration and a torque of any sign, a direction, and a train that does not jam."""
    first, load, rotor, slow, ratio = draw.positive(5)
    signs = draw.rng.choice([-1.0, 1.0], 3)
    return signs[0] * first, signs[1], signs[2] * load, rotor, slow, ratio, efficiency(draw), efficiency(draw)


def nested(draw: Draw, count: int) -> list[float]:
    """Sizes from large to small."""
    return sorted(draw.positive(count), reverse=True)


def braked(draw: Draw) -> tuple[Any, ...]:
    """A body and a brake that is stronger than what drives it."""
    inertia_, speed, torque, delay, rise, load = draw.positive(6)
    other = draw.rng.choice([-load, torque * (1 - draw.share()) * 0.999, -torque * draw.share()])
    return inertia_, speed, torque, float(other), delay, rise, draw.shape("linear", "exponential")


def to_be_braked(draw: Draw) -> tuple[Any, ...]:
    inertia_, speed, _, other, delay, rise, shape = braked(draw)
    return inertia_, speed, delay * (1.001 + draw.positive(1)[0]), other, delay, rise, shape


def modelled(draw: Draw) -> tuple[Any, ...]:
    """A law of similarity and scales that fit it."""
    law = draw.shape("full", "geometric", "ballast")
    length, density, gravity, more = draw.positive(4)
    modulus = density * length**3 * gravity / length**2
    return law, length, modulus * (1 + more if law == "ballast" else 1), density, gravity


def distortion_numbers(*given: Any) -> list[float]:
    return [float(x) for x in re.findall(r"\d+(?:\.\d+)?(?:e[+-]?\d+)?", " ".join(similarity.distortions(*given)))]


def linkage(draw: Draw) -> tuple[float, float, float]:
    """Crank radius, rod length and offset of a crank that can turn round."""
    radius, offset, more = draw.positive(3)
    return radius, (radius + offset) * (1.001 + more), offset


def in_linkage(draw: Draw) -> tuple[float, ...]:
    return float(draw.rng.uniform(-9, 9)), *linkage(draw)


def from_large_to_small(draw: Draw) -> tuple[float, float]:
    high, low = nested(draw, 2)
    return high, low


def rising(draw: Draw, numbers: int) -> tuple[float, ...]:
    """A section of a route that rises by a share of its length, and so many other numbers."""
    length, *others = draw.positive(1 + numbers)
    return length, length * draw.share(), *others


def row(draw: Draw) -> np.ndarray:
    """Five numbers of either sign."""
    return np.asarray(draw.rng.choice([-1.0, 1.0], 5) * np.array(draw.positive(5)))


def teeth(draw: Draw) -> int:
    """From 3 to 10^9, decades spread evenly."""
    return 3 + int(10 ** draw.rng.uniform(0, 9))


def modes_of_chain(imposed_speed: bool) -> Callable[[Draw], tuple[Any, ...]]:
    """A loop and its lowest frequencies; masses and compliances within six decades."""

    def arguments(draw: Draw) -> tuple[Any, ...]:
        loop = LoopMasses(*(10 ** draw.rng.uniform(-3, 3, 6)).tolist(), bool(draw.rng.integers(2)), imposed_speed)
        return loop, belt_modes.natural_frequencies(loop, 0.0, 3)

    return arguments


def sections_of_chain(draw: Draw) -> tuple[Any, ...]:
    """The same, either way of driving it, and sections of a strand."""
    loop, frequencies = modes_of_chain(bool(draw.rng.integers(2)))(draw)
    return loop, frequencies, int(draw.rng.integers(2)), np.array([0.0, draw.share(), 1.0])


def bands(draw: Draw) -> np.ndarray:
    return chain_resonance.exclusion_bands(np.array(draw.positive(5)), np.array([0.15]))


def slowly_hoisted(draw: Draw) -> tuple[float, ...]:
    """A swing whose rope is at most as fast as its load."""
    angle, length, other, gravity = draw.positive(4)
    return angle, length, other, draw.share() * math.sqrt(gravity * min(length, other)), gravity


def small_swing(draw: Draw) -> tuple[float, ...]:
    """A swing so small, short and gently moved that a bound of its error follows."""
    angle = 10 ** draw.rng.uniform(-12, -1)
    return angle, draw.share() / angle**2 / 9, draw.share() / angle / 9


FINITE: dict[str, tuple[Callable[..., Any], Callable[[Draw], tuple[Any, ...]]]] = {
    "kelvin_voigt_change": (belt_damping.kelvin_voigt_change, lambda d: tuple(d.positive(2))),
    "hysteretic_change": (belt_damping.hysteretic_change, lambda d: tuple(d.positive(1))),
    "zener_change": (belt_damping.zener_change, lambda d: tuple(d.positive(3))),
    "reduced_drive_mass": (inertia.reduced_drive_mass, lambda d: tuple(d.positive(5))),
    "inertia_on_motor_shaft": (
        inertia.inertia_on_motor_shaft,
        lambda d: (*d.positive(2), efficiency(d), d.shape("drive", "brake", "energy")),
    ),
    "inertia_on_slow_shaft": (
        inertia.inertia_on_slow_shaft,
        lambda d: (*d.positive(2), efficiency(d), d.shape("drive", "brake", "energy")),
    ),
    "mass_on_motor_shaft": (
        inertia.mass_on_motor_shaft,
        lambda d: (*d.positive(4), efficiency(d), d.shape("drive", "brake", "energy")),
    ),
    "slewing_inertia": (inertia.slewing_inertia, lambda d: tuple(d.positive(7))),
    "rotating_parts": (
        inertia.rotating_parts_coefficient,
        lambda d: (d.positive(1)[0], *(np.array(d.positive(3)) for _ in range(2)), np.full(3, efficiency(d)), "drive"),
    ),
    "new_clearance": (backlash.new_clearance, lambda d: (*d.positive(1), 3)),
    "wear_share": (backlash.wear_share, lambda d: tuple(d.positive(2))),
    "worn_clearance": (backlash.worn_clearance, lambda d: (*d.positive(3), True)),
    "clearance_angle": (backlash.clearance_angle, lambda d: (*d.positive(2), 1.5 * d.share())),
    "clearance_on_motor_shaft": (
        backlash.clearance_on_motor_shaft,
        lambda d: (np.array(d.positive(3)), np.array(d.positive(3))),
    ),
    "gap_closing": (backlash.gap_closing, lambda d: tuple(d.positive(4))),
    "backlash_number": (backlash.backlash_number, lambda d: tuple(d.positive(5))),
    "backlash_peak_ratio": (backlash.backlash_peak_ratio, lambda d: tuple(d.positive(1))),
    "backlash_peak_torque": (backlash.backlash_peak_torque, lambda d: tuple(d.positive(7))),
    "impact_loss": (backlash.impact_loss, lambda d: (*d.positive(3), d.share())),
    "solid_cylinder": (bodies.solid_cylinder, lambda d: tuple(d.positive(2))),
    "hollow_cylinder": (bodies.hollow_cylinder, lambda d: tuple(d.positive(3))),
    "thin_ring": (bodies.thin_ring, lambda d: tuple(d.positive(2))),
    "point_mass": (bodies.point_mass, lambda d: tuple(d.positive(2))),
    "parallel_axis": (bodies.parallel_axis, lambda d: tuple(d.positive(3))),
    "rings": (
        bodies.rings,
        lambda d: (*d.positive(1), *np.array([nested(d, 2) for _ in range(3)]).T, np.array(d.positive(3))),
    ),
    "drum": (bodies.drum, lambda d: (*d.positive(1), *(sizes := nested(d, 3))[:2], *d.positive(2), sizes[2])),
    "estimated_body": (bodies.estimated_body, lambda d: tuple(d.positive(3))),
    "rod_about_end": (bodies.rod_about_end, lambda d: tuple(d.positive(2))),
    "rod_about_centre": (bodies.rod_about_centre, lambda d: tuple(d.positive(2))),
    "rod_radial": (bodies.rod_radial, lambda d: tuple(d.positive(3))),
    "rod_parallel": (bodies.rod_parallel, lambda d: tuple(d.positive(3))),
    "rod_inclined": (bodies.rod_inclined, lambda d: tuple(d.positive(3))),
    "inertia_of_gd2": (bodies.inertia_of_gd2, lambda d: (*d.positive(1), d.shape("gyration", "outer_diameter"))),
    "braking_torque": (brake.braking_torque, lambda d: (*d.positive(4), d.shape("linear", "exponential"))),
    "brake_stop": (brake.brake_stop, braked),
    "brake_torque_for_time": (brake.brake_torque_for_time, to_be_braked),
    "uniform_stop_time": (brake.uniform_stop_time, lambda d: tuple(d.positive(2))),
    "brake_reserve": (brake.brake_reserve, lambda d: tuple(d.positive(2))),
    "stop_heat": (brake.stop_heat, lambda d: tuple(d.positive(4))),
    "collision_force": (
        buffer.collision_force,
        lambda d: (*d.positive(4), d.rng.choice([-1.0, 1.0]) * d.positive(1)[0], d.shape("tip_stopped", "whole")),
    ),
    "collision_force_bound": (buffer.collision_force_bound, lambda d: tuple(d.positive(5))),
    "column_bending": (mast_compliance.column_bending, lambda d: tuple(d.positive(3))),
    "bridge_travel_compliance": (lambda *a: astuple(mast_compliance.bridge_travel_compliance(*a)), under_a_bridge),
    "trolley_travel_compliance": (
        lambda *a: astuple(mast_compliance.trolley_travel_compliance(*a[:5], *a[7:9])),
        under_a_bridge,
    ),
    "mean_shape": (mast.mean_shape, shares_of_a_root),
    "mass_coefficient": (mast.mass_coefficient, shares_of_a_root),
    "tip_shape": (mast.tip_shape, lambda d: (d.share(), *shares_of_a_root(d))),
    "consistent_masses": (
        mast.consistent_masses,
        lambda d: (*d.positive(4), *shares_of_a_root(d), d.rng.uniform(0.3, 1.0)),
    ),
    "consistent_frequency": (
        mast.consistent_frequency,
        lambda d: (lambda c, a, b: (c, a, 0.9 * d.share() * math.sqrt(a * b), b))(*d.positive(3)),
    ),
    "two_mass_damping": (mast.two_mass_damping, lambda d: tuple(d.positive(4))),
    "static_lag": (mast.static_lag, lambda d: tuple(d.positive(5))),
    "notes_deflection": (mast.notes_deflection, lambda d: tuple(d.positive(6))),
    "rise_factor": (mast.rise_factor, lambda d: tuple(d.positive(1))),
    "after_stop_ratio": (mast.after_stop_ratio, lambda d: tuple(d.positive(2))),
    "root_moment": (mast.root_moment, lambda d: tuple(d.positive(5))),
    "leaning": (mast.leaning, lambda d: (*d.positive(4), d.share())),
    "gravity_stiffness": (
        mast.gravity_stiffness,
        lambda d: (*d.positive(3), *shares_of_a_root(d), "hanging"),
    ),
    "weighted_tip_compliance": (
        mast_compliance.weighted_tip_compliance,
        lambda d: (*d.positive(4), "hanging"),
    ),
    "clamped_beam_root": (mast_modes.clamped_beam_root, lambda d: (d.positive(1)[0], int(d.rng.integers(1, 4)))),
    "mast_frequency": (mast_modes.mast_frequency, lambda d: (a_mast(d), int(d.rng.integers(1, 4)))),
    "mode_compliance": (mast_modes.mode_compliance, lambda d: (a_mast(d), 1, str(d.rng.choice(["base", "load"])))),
    "dashpot_ratio": (contact_damping.dashpot_ratio, lambda d: (d.share(),)),
    "elastic_contact_force": (obstacle.elastic_contact_force, lambda d: tuple(d.positive(3))),
    "damped_contact": (
        obstacle.damped_contact,
        lambda d: (*d.positive(4), d.rng.uniform(0.5, 4.0), d.positive(1)[0] * d.share()),
    ),
    "column_force_bound": (
        obstacle.column_force_bound,
        lambda d: (*d.positive(5), d.positive(1)[0] * d.share(), d.rng.uniform(0.5, 4.0)),
    ),
    "series_stiffness": (buffer.series_stiffness, lambda d: tuple(d.positive(2))),
    "linear_buffer": (buffer.linear_buffer, lambda d: tuple(d.positive(3))),
    "constant_force_buffer": (buffer.constant_force_buffer, lambda d: tuple(d.positive(3))),
    "driven_buffer": (buffer.driven_buffer, lambda d: (d.rng.choice([-1.0, 1.0]) * d.positive(1)[0], *d.positive(3))),
    "constant_force_stroke": (buffer.constant_force_stroke, lambda d: (*nested(d, 2)[::-1], *d.positive(2))),
    "progressive_buffer": (
        buffer.progressive_buffer,
        lambda d: (d.rng.choice([-1.0, 0.0, 1.0]) * d.positive(1)[0], *d.positive(4), 0.5 + 3 * d.share()),
    ),
    "speed_left": (buffer.speed_left, lambda d: tuple(d.positive(5))),
    "collision_mass": (buffer.collision_mass, lambda d: (*d.positive(2), d.share())),
    "meeting": (buffer.meeting, lambda d: tuple(d.positive(6))),
    "series_orifice": (buffer.series_orifice, lambda d: tuple(d.positive(2))),
    "orifice_buffer_speed": (
        buffer.orifice_buffer_speed,
        lambda d: (*d.positive(4), d.rng.choice([-1.0, 0.0, 1.0]) * d.positive(1)[0]),
    ),
    "orifice_buffer_force": (
        buffer.orifice_buffer_force,
        lambda d: (*d.positive(4), d.rng.choice([-1.0, 0.0, 1.0]) * d.positive(1)[0]),
    ),
    "energy_share": (buffer.energy_share, lambda d: (np.array(d.positive(4)), np.cumsum(d.positive(4)))),
    "orifice_energy_share": (buffer.orifice_energy_share, lambda d: tuple(d.positive(3))),
    "orifice_buffer_path": (buffer.orifice_buffer_path, lambda d: tuple(d.positive(4))),
    "buffer_factor": (buffer.buffer_factor, lambda d: (d.share(),)),
    "coulomb_slide": (
        coulomb.coulomb_slide,
        lambda d: (*d.positive(2), *(d.rng.choice([-1, 0, 1], 2) * d.positive(2)), *d.positive(1)),
    ),
    "coulomb_decay": (coulomb.coulomb_decay, lambda d: (*d.positive(1), *nested(d, 2)[::-1], *d.positive(2))),
    "reverse_efficiency": (gearing.reverse_efficiency, lambda d: (efficiency(d),)),
    "input_torque": (gearing.input_torque, lambda d: (*geared(d)[:2], *d.positive(1), efficiency(d), efficiency(d))),
    "motor_torque": (gearing.motor_torque, geared),
    "motor_torque_seed_rule": (gearing.motor_torque_seed_rule, geared),
    "motor_acceleration": (gearing.motor_acceleration, geared),
    "jams": (gearing.jams, lambda d: tuple(d.positive(4))),
    "free_response": (response.free_response, lambda d: tuple(d.positive(5))),
    "free_speed": (response.free_speed, lambda d: tuple(d.positive(5))),
    "decay_envelope": (response.decay_envelope, lambda d: tuple(d.positive(4))),
    "sine_response": (response.sine_response, lambda d: tuple(d.positive(4))),
    "decay_response": (response.decay_response, lambda d: tuple(d.positive(5))),
    "pulse_response": (response.pulse_response, lambda d: tuple(d.positive(6))),
    "step_factor": (shock.step_factor, lambda d: tuple(d.positive(1))),
    "ramp_factor": (shock.ramp_factor, lambda d: tuple(d.positive(1))),
    "rectangular_pulse_factor": (shock.rectangular_pulse_factor, lambda d: tuple(d.positive(1))),
    "half_sine_pulse_factor": (shock.half_sine_pulse_factor, lambda d: tuple(d.positive(1))),
    "impulse_displacement": (shock.impulse_displacement, lambda d: tuple(d.positive(3))),
    "impact_force_unloaded": (shock.impact_force_unloaded, lambda d: tuple(d.positive(4))),
    "impact_force_preloaded": (shock.impact_force_preloaded, lambda d: tuple(d.positive(4))),
    "scales": (lambda *given: astuple(similarity.scales(*given)), modelled),
    "distortions": (distortion_numbers, modelled),
    "section_scales": (lambda *given: astuple(similarity.section_scales(*given)), lambda d: tuple(d.positive(7))),
    "self_weight_strain": (similarity.self_weight_strain, lambda d: tuple(d.positive(5))),
    "two_mass_frequency": (two_mass.two_mass_frequency, lambda d: tuple(d.positive(3))),
    "takeup": (lambda *given: astuple(two_mass.takeup(*given)), lambda d: tuple(d.positive(6))),
    "hanging_start_force": (two_mass.hanging_start_force, lambda d: tuple(d.positive(4))),
    "speed_step_force": (two_mass.speed_step_force, lambda d: tuple(d.positive(4))),
    "lowering_brake_force": (two_mass.lowering_brake_force, lambda d: tuple(d.positive(6))),
    "hoisting_stop_force": (two_mass.hoisting_stop_force, lambda d: tuple(d.positive(6))),
    "natural_frequency": (vibration.natural_frequency, lambda d: tuple(d.positive(2))),
    "damping_ratio": (vibration.damping_ratio, lambda d: tuple(d.positive(3))),
    "damping_ratio_of_decrement": (vibration.damping_ratio_of_decrement, lambda d: tuple(d.positive(1))),
    "decrement_of_damping_ratio": (vibration.decrement_of_damping_ratio, lambda d: (1 - efficiency(d),)),
    "damping_of_decrement": (vibration.damping_of_decrement, lambda d: tuple(d.positive(3))),
    "damped_frequency": (vibration.damped_frequency, lambda d: tuple(d.positive(2))),
    "amplification": (vibration.amplification, lambda d: tuple(d.positive(2))),
    "phase_lag": (vibration.phase_lag, lambda d: tuple(d.positive(2))),
    "resonance_ratio": (vibration.resonance_ratio, lambda d: tuple(d.positive(1))),
    "peak_amplification": (vibration.peak_amplification, lambda d: tuple(d.positive(1))),
    "transmissibility": (vibration.transmissibility, lambda d: tuple(d.positive(2))),
    "unbalance_amplification": (vibration.unbalance_amplification, lambda d: tuple(d.positive(2))),
    "mean_starting_torque": (motor.mean_starting_torque, lambda d: tuple(d.positive(2))),
    "rim_force": (motor.rim_force, lambda d: tuple(d.positive(4))),
    "rated_torque": (motor.rated_torque, lambda d: tuple(d.positive(2))),
    "linear_torque": (motor.linear_torque, lambda d: tuple(d.positive(3))),
    "slip": (motor.slip, lambda d: tuple(d.positive(2))),
    "breakdown_slip": (motor.breakdown_slip, rating),
    "largest_stator_ratio": (motor.largest_stator_ratio, lambda d: rating(d)[:2]),
    "kloss": (motor.kloss, on_kloss_curve),
    "kloss_slope": (motor.kloss_slope, on_kloss_curve),
    "kloss_slip": (motor.kloss_slip, stable_on_kloss_curve),
    "mean_kloss_torque": (motor.mean_kloss_torque, range_of_kloss_curve),
    "stage_breakdown_slip": (motor.stage_breakdown_slip, lambda d: tuple(d.positive(2))),
    "switching_speed": (motor.switching_speed, lambda d: tuple(d.positive(3))),
    "rheostat_factors": (motor.rheostat_factors, two_slips),
    "converter_reference": (motor.converter_reference, lambda d: tuple(d.positive(3))),
    "converter_torque": (motor.converter_torque, lambda d: tuple(d.positive(4))),
    "rms_torque": (duty.rms_torque, lambda d: cycle(d, 3)),
    "equivalent_torque": (duty.equivalent_torque, lambda d: cycle(d, 4)),
    "duty_factor": (duty.duty_factor, lambda d: tuple(d.positive(2))),
    "permissible_torque": (duty.permissible_torque, duties),
    "switching_heat": (
        duty.switching_heat,
        lambda d: (*d.positive(2), 1.0, d.share(), *d.positive(1), d.share() * 0.9),
    ),
    "permissible_switching_rate": (
        duty.permissible_switching_rate,
        lambda d: (*d.positive(2), d.share(), d.share(), *d.positive(1)),
    ),
    "main_resistance": (resistance.main_resistance_per_length, lambda d: tuple(d.positive(5))),
    "length_factor": (resistance.length_factor, lambda d: (80 * max(d.positive(1)[0], 1.0),)),
    "over": (quotient.over, lambda d: tuple(d.positive(2))),
    "sag_ratio": (sag.sag_ratio, lambda d: tuple(d.positive(2))),
    "tension_at_sag": (sag.tension_at_sag, lambda d: tuple(d.positive(2))),
    "softening": (sag.softening, lambda d: tuple(d.positive(3))),
    "rise": (start_profile.rise, lambda d: (d.shape("step", "ramp", "cosine", "parabolic"), *d.positive(2))),
    "rise_integral": (
        start_profile.rise_integral,
        lambda d: (d.shape("step", "ramp", "cosine", "parabolic"), *d.positive(2)),
    ),
    "time_of_share": (
        start_profile.time_of_share,
        lambda d: (d.shape("step", "ramp", "cosine", "parabolic"), *d.positive(1), d.share()),
    ),
    "time_to_momentum": (
        start_profile.time_to_momentum,
        lambda d: (d.shape("step", "ramp", "cosine", "parabolic"), *d.positive(2), 0.0, 0.0, *d.positive(1)),
    ),
    "rise_rate": (start_profile.rise_rate, lambda d: (d.shape("ramp", "cosine", "parabolic"), *d.positive(2))),
    "residual": (start_profile.residual, lambda d: (d.shape("step", "ramp", "cosine", "parabolic"), *d.positive(2))),
    "peak_rate": (start_profile.peak_rate, lambda d: (d.shape("ramp", "cosine", "parabolic"), *d.positive(1))),
    "phases_torque": (phase_numbers, lambda d: (d.shape("step", "ramp", "cosine", "parabolic"), False, *d.positive(2))),
    "phases_speed": (phase_numbers, lambda d: (d.shape("ramp", "cosine", "parabolic"), True, *d.positive(2))),
    "acceleration": (shaft.acceleration, lambda d: tuple(d.positive(4))),
    "torque_of_motion": (shaft.torque_of_motion, lambda d: tuple(d.positive(4))),
    "speed_after_work": (
        shaft.speed_after_work,
        lambda d: (*d.positive(2), d.rng.normal() * d.positive(1)[0], *d.positive(1)),
    ),
    "gear_factor": (
        shaft.gear_factor,
        lambda d: (d.rng.normal() * d.positive(1)[0], *d.positive(4), efficiency(d), efficiency(d)),
    ),
    "irregularity": (shaft.irregularity, from_large_to_small),
    "flywheel_inertia": (shaft.flywheel_inertia, lambda d: tuple(d.positive(4))),
    "cycle_efficiency": (shaft.cycle_efficiency, lambda d: tuple(d.positive(2))),
    "loss_factor": (shaft.loss_factor, lambda d: tuple(d.positive(2))),
    "inertia_criterion": (shaft.inertia_criterion, lambda d: tuple(d.positive(3))),
    "slope_criterion": (shaft.slope_criterion, lambda d: tuple(d.positive(3))),
    "run_out_angle": (shaft.run_out_angle, lambda d: tuple(d.positive(3))),
    "run_out_time": (shaft.run_out_time, lambda d: tuple(d.positive(3))),
    "brake_torque_for_angle": (shaft.brake_torque_for_angle, lambda d: tuple(d.positive(4))),
    "recoverable_energy": (shaft.recoverable_energy, lambda d: (*d.positive(2), d.share())),
    "braked_stop": (shaft.braked_stop, lambda d: tuple(d.positive(7))),
    "braked_stop_driven": (
        shaft.braked_stop,
        lambda d: (
            *d.positive(2),
            -(load := d.positive(1)[0]),
            *d.positive(1),
            1.001 * load + d.positive(1)[0],
            *d.positive(2),
        ),
    ),
    "slider_position": (slider_crank.slider_position, in_linkage),
    "slider_velocity": (slider_crank.slider_velocity, in_linkage),
    "dead_centre": (slider_crank.dead_centre, lambda d: (*linkage(d), bool(d.rng.integers(2)))),
    "crank_angles": (slider_crank.crank_angles, lambda d: (*d.positive(1), *linkage(d))),
    "reduced_inertia": (
        slider_crank.reduced_inertia,
        lambda d: (*in_linkage(d), *d.positive(2), d.share(), *d.positive(1)),
    ),
    "reduced_inertia_slope": (
        slider_crank.reduced_inertia_slope,
        lambda d: (*in_linkage(d), *d.positive(2), d.share(), *d.positive(1)),
    ),
    "rod_centre_height": (slider_crank.rod_centre_height, lambda d: (*in_linkage(d), d.share(), 3 * d.share())),
    "rod_centre_lift": (slider_crank.rod_centre_lift, lambda d: (*in_linkage(d), d.share(), 3 * d.share())),
    "wave_speed": (wave.wave_speed, lambda d: tuple(d.positive(2))),
    "impedance": (wave.impedance, lambda d: tuple(d.positive(2))),
    "reflection": (wave.reflection, lambda d: tuple(d.positive(2))),
    "first_wave_time": (wave.first_wave_time, lambda d: tuple(d.positive(2))),
    "first_wave_force": (wave.first_wave_force, lambda d: tuple(d.positive(4))),
    "first_wave_speed": (wave.first_wave_speed, lambda d: tuple(d.positive(4))),
    "first_wave_peak": (wave.first_wave_peak, lambda d: tuple(d.positive(4))),
    "two_interval_force": (wave.two_interval_force, two_interval),
    "two_interval_peak": (wave.two_interval_peak, two_interval),
    "window_leak": (loop_bounds.window_leak, lambda d: tuple(d.positive(2))),
    "mass_behind": (loop_bounds.mass_behind, in_loop(False)),
    "quasi_static_gravity": (loop_bounds.quasi_static, in_loop(False)),
    "quasi_static_fixed": (loop_bounds.quasi_static, in_loop(True)),
    "tension_green_gravity": (loop_bounds.tension_green, in_loop(False)),
    "tension_green_fixed": (loop_bounds.tension_green, in_loop(True)),
    "stray_gravity": (loop_bounds.stray, in_loop(False)),
    "stray_fixed": (loop_bounds.stray, in_loop(True)),
    "lowest_frequency_gravity": (loop_bounds.lowest_frequency_bound, whole_loop(False)),
    "lowest_frequency_fixed": (loop_bounds.lowest_frequency_bound, whole_loop(True)),
    "section_pull": (strand_tension.section_pull, lambda d: rising(d, 5)),
    "load_pull": (strand_tension.load_pull, lambda d: rising(d, 3)),
    "strand_tensions": (strand_tension.strand_tensions, lambda d: (d.positive(1)[0], row(d))),
    "tension_extremes": (strand_tension.tension_extremes, lambda d: (row(d),)),
    "worst_loading": (strand_tension.worst_loading, lambda d: (row(d), d.shape("most", "least"))),
    "worst_stretch": (strand_tension.worst_stretch, lambda d: (row(d), d.shape("most", "least"))),
    "slope_loading": (strand_tension.slope_loading, lambda d: (row(d), d.shape("most", "least"))),
    "loading_envelope": (strand_tension.loading_envelope, lambda d: (d.positive(1)[0], row(d), row(d))),
    "secondary_resistance": (
        belt_resistance.secondary_resistance,
        lambda d: (*d.positive(1), 80 * max(d.positive(1)[0], 1.0)),
    ),
    "loading_resistance": (belt_resistance.loading_resistance, lambda d: tuple(d.positive(3))),
    "acceleration_length": (belt_resistance.acceleration_length, lambda d: tuple(d.positive(4))),
    "skirt_resistance": (belt_resistance.skirt_resistance, lambda d: tuple(d.positive(7))),
    "scraper_resistance": (belt_resistance.scraper_resistance, lambda d: tuple(d.positive(3))),
    "wrap_resistance": (belt_resistance.wrap_resistance, lambda d: tuple(d.positive(6))),
    "bearing_resistance": (belt_resistance.bearing_resistance, lambda d: tuple(d.positive(4))),
    "idler_tilt_resistance": (belt_resistance.idler_tilt_resistance, lambda d: (*d.positive(6), d.share())),
    "effective_tension": (belt_resistance.effective_tension, lambda d: tuple(d.positive(4))),
    "shaft_power": (belt_resistance.shaft_power, lambda d: tuple(d.positive(2))),
    "motor_power": (belt_resistance.motor_power, lambda d: (*d.positive(1), efficiency(d))),
    "cycle_time": (belt_resistance.cycle_time, lambda d: tuple(d.positive(2))),
    "takeup_travel": (belt_resistance.takeup_travel, lambda d: (*d.positive(5), 2)),
    "mean_tension": (
        belt_resistance.mean_tension,
        lambda d: (np.array(d.positive(4)), np.array(d.positive(5))),
    ),
    "takeup_mass": (belt_resistance.takeup_mass, lambda d: (*d.positive(1), 2, *d.positive(1))),
    "cema_idler_resistance": (belt_resistance.cema_idler_resistance, lambda d: tuple(d.positive(5))),
    "cema_effective_tension": (belt_resistance.cema_effective_tension, lambda d: tuple(d.positive(9))),
    "usable_width": (belt_section.usable_width, lambda d: tuple(d.positive(1))),
    "water_section": (belt_section.water_section, lambda d: (*d.positive(2), 1.5 * d.share())),
    "surcharge_section": (
        belt_section.surcharge_section,
        lambda d: (*d.positive(2), 1.5 * d.share(), 1.5 * d.share()),
    ),
    "slope_reduction": (belt_section.slope_reduction, lambda d: (1.5 * d.share(), 1.5 * d.share())),
    "capacity": (belt_section.capacity, lambda d: tuple(d.positive(3))),
    "load_line_mass": (belt_section.load_line_mass, lambda d: tuple(d.positive(2))),
    "fill_share": (belt_section.fill_share, lambda d: tuple(d.positive(2))),
    "belt_safety": (belt_section.belt_safety, lambda d: tuple(d.positive(3))),
    "minimum_pulley_diameter": (
        belt_section.minimum_pulley_diameter,
        lambda d: (d.shape(*belt_section.PULLEY_FACTORS), *d.positive(1)),
    ),
    "transition_strains": (
        belt_section.transition_strains,
        lambda d: (*d.positive(3), 1.5 * d.share(), *d.positive(1)),
    ),
    "transition_length": (
        belt_section.transition_length,
        lambda d: (*d.positive(3), 1.5 * d.share(), *d.positive(1)),
    ),
    "lift_off_radius": (vertical_curve.lift_off_radius, lambda d: tuple(d.positive(5))),
    "lift_off_tension": (vertical_curve.lift_off_tension, lambda d: tuple(d.positive(5))),
    "idler_line_load": (vertical_curve.idler_line_load, lambda d: (*d.positive(6), bool(d.rng.integers(2)))),
    "idler_radius": (
        vertical_curve.idler_radius,
        lambda d: (*(given := d.positive(5)), 1.001 * math.prod(given[1:]) + d.positive(1)[0]),
    ),
    "trough_heights": (vertical_curve.trough_heights, lambda d: (*d.positive(2), 1.5 * d.share())),
    "radius_for_largest": (
        vertical_curve.radius_for_largest,
        lambda d: (*(given := d.positive(4)), 1.001 * given[0] / given[1] + d.positive(1)[0]),
    ),
    "radius_for_least": (
        vertical_curve.radius_for_least,
        lambda d: (*(given := d.positive(4)), 0.999 * d.share() * given[0] / given[1]),
    ),
    "moving_resistance": (stopping.moving_resistance, lambda d: (*d.positive(1), 1.5 * d.share(), *d.positive(4))),
    "rollback_force": (stopping.rollback_force, lambda d: (*d.positive(1), 1.5 * d.share(), *d.positive(4))),
    "critical_coefficient": (stopping.critical_coefficient, lambda d: (1.5 * d.share(), *d.positive(2))),
    "backstop_torque": (stopping.backstop_torque, lambda d: tuple(d.positive(3))),
    "torque_on_motor_shaft": (stopping.torque_on_motor_shaft, lambda d: (*d.positive(2), efficiency(d))),
    "brake_torque_for_distance": (
        stopping.brake_torque_for_distance,
        lambda d: (
            *d.positive(1),
            float(d.rng.choice([-1.0, 1.0])) * d.positive(1)[0],
            *d.positive(4),
            efficiency(d),
            *d.positive(1),
            d.shape("signed", "notes"),
        ),
    ),
    "stopping_distance": (
        stopping.stopping_distance,
        lambda d: (*d.positive(6), efficiency(d), *d.positive(1)),
    ),
    "braking_force": (stopping.braking_force, lambda d: tuple(d.positive(3))),
    "fixed_loop_braking": (stopping.fixed_loop_braking, lambda d: tuple(d.positive(3))),
    "coasting": (stopping.coasting, lambda d: tuple(d.positive(4))),
    "coast_down_coefficient": (stopping.coast_down_coefficient, lambda d: tuple(d.positive(8))),
    "pitch_radius": (sprocket.pitch_radius, lambda d: (*d.positive(1), teeth(d))),
    "sprocket_speed": (sprocket.sprocket_speed, lambda d: (*d.positive(2), teeth(d))),
    "speed_extremes": (sprocket.speed_extremes, lambda d: (*d.positive(1), teeth(d))),
    "speed_ripple": (sprocket.speed_ripple, lambda d: (teeth(d), d.shape("largest", "mean"))),
    "pitch_fraction": (sprocket.pitch_fraction, lambda d: tuple(d.positive(2))),
    "transverse_speed": (sprocket.transverse_speed, lambda d: (*d.positive(1), teeth(d))),
    "transverse_travel": (sprocket.transverse_travel, lambda d: (*d.positive(1), teeth(d))),
    "engagement_speed": (
        sprocket.engagement_speed,
        lambda d: (*d.positive(1), teeth(d), d.shape("translating", "guided")),
    ),
    "engagement_energy": (sprocket.engagement_energy, lambda d: (*d.positive(2), d.share())),
    "peak_acceleration": (polygon.peak_acceleration, lambda d: (*d.positive(2), teeth(d))),
    "polygon_displacement": (polygon.polygon_displacement, lambda d: (d.rng.normal(), *d.positive(1), teeth(d))),
    "polygon_speed": (polygon.polygon_speed, lambda d: (d.rng.normal(), *d.positive(1), teeth(d))),
    "polygon_acceleration": (polygon.polygon_acceleration, lambda d: (d.rng.normal(), *d.positive(2), teeth(d))),
    "ramped_acceleration": (polygon.ramped_acceleration, lambda d: (d.rng.normal(), *d.positive(3), teeth(d))),
    "engagement_times": (polygon.engagement_times, lambda d: (*d.positive(2), teeth(d), 4)),
    "acceleration_harmonics": (
        polygon.acceleration_harmonics,
        lambda d: (np.array([1.0, 2.0, 1e6]), *d.positive(2), teeth(d)),
    ),
    "harmonic_tail": (polygon.harmonic_tail, lambda d: (teeth(d), 0.5 + 2 * d.share(), *d.positive(2), teeth(d))),
    "return_share": (polygon.return_share, lambda d: tuple(d.positive(1))),
    "nearest_threshold": (polygon.nearest_threshold, lambda d: tuple(d.positive(1))),
    "textbook_mass": (polygon.textbook_mass, lambda d: tuple(d.positive(4))),
    "textbook_polygon_force": (polygon.textbook_polygon_force, lambda d: tuple(d.positive(2))),
    "equalising_angle": (equalising.equalising_angle, lambda d: (d.rng.normal(), teeth(d))),
    "equalising_speed": (equalising.equalising_speed, lambda d: (d.rng.normal(), *d.positive(2), teeth(d))),
    "equalising_ratio": (equalising.equalising_ratio, lambda d: (teeth(d),)),
    "equalising_acceleration": (equalising.equalising_acceleration, lambda d: (*d.positive(2), teeth(d))),
    "modal_masses": (chain_resonance.modal_masses, modes_of_chain(imposed_speed=True)),
    "modal_tensions": (chain_resonance.modal_tensions, sections_of_chain),
    "modal_shapes": (chain_resonance.modal_shapes, sections_of_chain),
    "modal_rest": (chain_resonance.modal_rest, sections_of_chain),
    "start_shares": (chain_resonance.start_shares, modes_of_chain(imposed_speed=False)),
    "resonance_speeds": (
        chain_resonance.resonance_speeds,
        lambda d: (np.array(d.positive(3)), np.array([1.0, 2.0]), *d.positive(1)),
    ),
    "resonance_weights": (
        chain_resonance.resonance_weights,
        lambda d: (np.array([1.0, 2.0]), *(np.array(d.positive(3)) for _ in range(2))),
    ),
    "exclusion_half_widths": (chain_resonance.exclusion_half_widths, lambda d: (np.array(d.positive(3)), d.share())),
    "exclusion_bands": (
        chain_resonance.exclusion_bands,
        lambda d: (np.array(d.positive(5)), np.array(d.positive(5))),
    ),
    "safe_windows": (
        lambda *given: chain_resonance.safe_windows(*given).ravel().tolist() or [0.0],
        lambda d: (bands(d), *nested(d, 2)[::-1]),
    ),
    "nearest_safe_speeds": (chain_resonance.nearest_safe_speeds, lambda d: (*d.positive(1), bands(d))),
    "transverse_frequencies": (chain_resonance.transverse_frequencies, lambda d: (*d.positive(4), 2)),
    "textbook_resonance_speed": (chain_resonance.textbook_resonance_speed, lambda d: tuple(d.positive(5))),
    "textbook_resonance_factor": (
        chain_resonance.textbook_resonance_factor,
        lambda d: (*d.positive(2), d.shape("quarter", "half", "full")),
    ),
    "textbook_resonance_modulus": (
        chain_resonance.textbook_resonance_modulus,
        lambda d: (*d.positive(2), d.shape("quarter", "half", "full")),
    ),
    "start_acceleration": (chain_start.start_acceleration, lambda d: tuple(d.positive(3))),
    "start_time": (chain_start.start_time, lambda d: (*nested(d, 2), *d.positive(2))),
    "start_force": (chain_start.start_force, lambda d: tuple(d.positive(4))),
    "start_series": (
        chain_start.start_series,
        lambda d: (*(np.array(d.positive(3)) for _ in range(3)), *d.positive(1)),
    ),
    "start_series_tail": (chain_start.start_series_tail, lambda d: (np.array(d.positive(3)), *d.positive(1))),
    "rigid_acceleration": (
        lambda *given: chain_start.rigid_acceleration(*given),
        lambda d: (*d.positive(3), efficiency(d), *d.positive(2), d.rng.choice([-1.0, 1.0]) * d.positive(1)[0]),
    ),
    "passing_bound": (
        chain_start.passing_bound,
        lambda d: (np.array(d.positive(3)), np.array(d.positive(3)), *d.positive(3), teeth(d), 1 + 1e3 * d.share()),
    ),
    "tooth_factor": (chain_selection.tooth_factor, lambda d: (teeth(d), 1.08)),
    "design_power": (chain_selection.design_power, lambda d: tuple(d.positive(4))),
    "chain_pitches": (chain_selection.chain_pitches, lambda d: (*d.positive(2), teeth(d), teeth(d))),
    "even_pitches": (chain_selection.even_pitches, lambda d: tuple(d.positive(1))),
    "centre_distance": (
        chain_selection.centre_distance,
        lambda d: (2.5e9 * (1 + d.positive(1)[0]), *d.positive(1), teeth(d), teeth(d)),
    ),
    "wrap_angle": (
        chain_selection.wrap_angle,
        lambda d: ((sizes := nested(d, 2))[0] * (1 + d.positive(1)[0]), sizes[1], sizes[0]),
    ),
    "centrifugal_force": (chain_selection.centrifugal_force, lambda d: tuple(d.positive(2))),
    "chain_safety": (chain_selection.chain_safety, lambda d: tuple(d.positive(3))),
    "articulation_pressure": (chain_selection.articulation_pressure, lambda d: tuple(d.positive(3))),
    "shaft_load": (chain_selection.shaft_load, lambda d: (*d.positive(2), 3 * d.share())),
    "lubrication": (
        lambda *given: len(chain_selection.lubrication(*given)),
        lambda d: tuple(d.positive(2)),
    ),
    "sprocket_path": (chain_wear.sprocket_path, lambda d: (*d.positive(1), teeth(d))),
    "guide_path": (chain_wear.guide_path, lambda d: tuple(d.positive(3))),
    "contact_time": (chain_wear.contact_time, lambda d: tuple(d.positive(2))),
    "wear_per_revolution": (
        chain_wear.wear_per_revolution,
        lambda d: (*(np.array(d.positive(3)) for _ in range(5)), d.shape("sum", "mean")),
    ),
    "archard_wear": (
        chain_wear.archard_wear,
        lambda d: (*(np.array(d.positive(3)) for _ in range(3)), *d.positive(3), 1 + 2 * d.share()),
    ),
    "allowed_growth": (chain_wear.allowed_growth, lambda d: tuple(d.positive(2))),
    "chain_life": (chain_wear.chain_life, lambda d: tuple(d.positive(4))),
    "revolutions": (chain_fatigue.revolutions, lambda d: tuple(d.positive(3))),
    "tooth_passes": (chain_fatigue.tooth_passes, lambda d: tuple(d.positive(3))),
    "stress_amplitude": (chain_fatigue.stress_amplitude, lambda d: (*nested(d, 2), *d.positive(1))),
    "fatigue_utilisation": (chain_fatigue.fatigue_utilisation, lambda d: tuple(d.positive(4))),
    "slip_heat": (
        slip_heat.slip_heat,
        lambda d: (np.cumsum(d.positive(5)), *(np.array(d.positive(5)) for _ in range(3))),
    ),
    "slip_heat_of_linear_change": (slip_heat.slip_heat_of_linear_change, lambda d: tuple(d.positive(5))),
    "slip_distance": (
        slip_heat.slip_distance,
        lambda d: (np.cumsum(d.positive(5)), *(np.array(d.positive(5)) for _ in range(2))),
    ),
    "temperature_rise": (slip_heat.temperature_rise, lambda d: tuple(d.positive(3))),
    "largest_drum_forces": (slip_heat.largest_drum_forces, lambda d: (*d.positive(1), 9 * d.share(), 9 * d.share())),
    "best_share": (slip_heat.best_share, lambda d: tuple(d.positive(2))),
    "drum_forces_in_slip": (
        slip_heat.drum_forces_in_slip,
        lambda d: (
            *d.positive(1),
            d.share(),
            *d.positive(1),
            9 * d.share(),
            9 * d.share(),
            bool(d.rng.integers(2)),
        ),
    ),
    "natural_frequencies_gravity": (belt_modes.natural_frequencies, lambda d: (*whole_loop(False)(d), 0.0, 3)),
    "natural_frequencies_weight": (
        belt_modes.natural_frequencies,
        lambda d: (*whole_loop(False)(d), *d.positive(1), 3),
    ),
    "natural_frequencies_fixed": (belt_modes.natural_frequencies, lambda d: (*whole_loop(True)(d), 0.0, 3)),
    "modes_below": (
        lambda loop, mass, share: belt_modes.modes_below(
            loop, mass, share * belt_modes.natural_frequencies(loop, mass, 3)
        ),
        lambda d: (*whole_loop(bool(d.rng.integers(2)))(d), *d.positive(1), 0.9 + d.share()),
    ),
    "modal_damping": (belt_modes.modal_damping, lambda d: tuple(d.positive(4))),
    "roller_reaction": (carriage.roller_reaction, lambda d: tuple(d.positive(3))),
    "roller_coefficient": (carriage.roller_coefficient, lambda d: tuple(d.positive(4))),
    "guide_resistance": (carriage.guide_resistance, lambda d: tuple(d.positive(2))),
    "jamming_ratio": (carriage.jamming_ratio, lambda d: tuple(d.positive(4))),
    "rope_pull": (
        carriage.rope_pull,
        lambda d: (*d.positive(3), int(d.rng.integers(1, 64)), max(d.share(), 1e-12), bool(d.rng.integers(2))),
    ),
    "sheave_of_tackle": (carriage.sheave_of_tackle, lambda d: (int(d.rng.integers(1, 64)), d.share())),
    "holding_moment": (
        overturning.holding_moment,
        lambda d: (np.array(d.positive(3)), np.array(d.positive(3)) * d.rng.choice([-1, 1], 3)),
    ),
    "tipping_moment": (overturning.tipping_moment, lambda d: tuple(d.positive(5))),
    "stability_reserve": (overturning.stability_reserve, lambda d: tuple(d.positive(2))),
    "tackle_efficiency": (reeving.tackle_efficiency, lambda d: (int(d.rng.integers(1, 64)), d.share())),
    "lowering_tackle_efficiency": (
        reeving.lowering_tackle_efficiency,
        lambda d: (int(d.rng.integers(1, 26)), max(d.share(), 1e-12)),
    ),
    "fall_pulls": (
        reeving.fall_pulls,
        lambda d: (
            d.positive(1)[0],
            int(d.rng.integers(1, 24)),
            max(d.share(), 1e-12),
            d.positive(1)[0],
            bool(d.rng.integers(2)),
        ),
    ),
    "rope_speed": (reeving.rope_speed, lambda d: (*d.positive(1), 4, 2)),
    "rope_between_drum_and_end": (
        reeving.rope_between_drum_and_end,
        lambda d: (d.positive(1)[0], 4, 2, d.positive(1)[0]),
    ),
    "metallic_area": (wire_rope.metallic_area, lambda d: (*d.positive(1), d.share())),
    "hook_stiffness": (wire_rope.hook_stiffness, lambda d: (*d.positive(2), 4, 2, *d.positive(1))),
    "rope_safety": (wire_rope.rope_safety, lambda d: tuple(d.positive(2))),
    "layer_step": (rope_drum.layer_step, lambda d: (on := d.positive(1)[0], on * (1 + 0.99 * d.share()), packed(d))),
    "layer_radius": (rope_drum.layer_radius, lambda d: (*d.positive(3), 7)),
    "turns_in_layer": (rope_drum.turns_in_layer, lambda d: (*d.positive(1), packed(d), 4)),
    "drum_capacity": (
        rope_drum.drum_capacity,
        lambda d: (*d.positive(3), int(d.rng.integers(1, 20)), *d.positive(1), packed(d)),
    ),
    "length_below": (
        rope_drum.length_below,
        lambda d: (int(d.rng.integers(1, 10**9)), *d.positive(4), packed(d)),
    ),
    "turns_for_length": (
        rope_drum.turns_for_length,
        lambda d: (*d.positive(3), 1e-3 + d.positive(1)[0], *d.positive(1), packed(d)),
    ),
    "drum_length_required": (
        rope_drum.drum_length_required,
        lambda d: (*d.positive(4), int(d.rng.integers(1, 20)), *d.positive(1), packed(d)),
    ),
    "fleet_angle": (rope_drum.fleet_angle, lambda d: tuple(d.positive(3))),
    "hoop_stress": (rope_drum.hoop_stress, lambda d: tuple(d.positive(4))),
    "layer_factor": (rope_drum.layer_factor, lambda d: (int(d.rng.integers(1, 3)),)),
    "drum_torque": (hoisting.drum_torque, lambda d: (*d.positive(1), 2, *d.positive(1))),
    "hoisting_torque": (hoisting.hoisting_torque, lambda d: (*d.positive(2), max(d.share(), 1e-12))),
    "lowering_torque": (hoisting.lowering_torque, lambda d: (*d.positive(2), d.share())),
    "sinking_acceleration": (
        hoisting.sinking_acceleration,
        lambda d: (*d.positive(5), eta := max(d.share(), 0.51), 2 - 1 / eta),
    ),
    "fatigue_torque": (slewing.fatigue_torque, lambda d: ([0.4, 0.5, 0.1], d.positive(3), 0.5 + 9 * d.share())),
    "uniform_start_time": (
        lambda *given: min(float(slewing.uniform_start_time(*given)), 1e99),  # infinite where the motor stalls
        lambda d: tuple(d.positive(4)),
    ),
    "torque_for_start": (slewing.torque_for_start, lambda d: tuple(d.positive(4))),
    "geared_stop": (
        lambda *given: min(*slewing.geared_stop(*given), 1e99),  # infinite where the wind wins
        lambda d: (
            *d.positive(2),
            max(d.share(), 1e-3),
            1 - 2 * d.share(),
            *d.positive(3),
            d.positive(1)[0] * (1 - 2 * int(d.rng.integers(2))),
            *d.positive(2),
        ),
    ),
    "swing_reach": (slewing.swing_reach, lambda d: tuple(d.positive(6))),
    "momentum_range": (
        lambda *given: (-slewing.momentum_range(*given)[0], slewing.momentum_range(*given)[1]),
        lambda d: tuple(d.positive(4)),
    ),
    "speed_after_drop": (hoisting.speed_after_drop, lambda d: tuple(d.positive(2))),
    "hoist_start_time": (
        lambda *given: min(hoisting.hoist_start_time(*given), 1e99),  # infinite where the motor stalls
        lambda d: (*d.positive(6), eta := max(d.share(), 0.51), 2 - 1 / eta, bool(d.rng.integers(2))),
    ),
    "load_frequency": (hoisting.load_frequency, lambda d: tuple(d.positive(4))),
    "spectrum_factor": (classification.spectrum_factor, lambda d: (np.full(4, 0.25), np.array([d.share()] * 4))),
    "equivalent_load": (classification.equivalent_load, lambda d: (d.share(),)),
    "use_of_cycles": (classification.use_of_cycles, lambda d: tuple(d.positive(1))),
    "use_of_hours": (classification.use_of_hours, lambda d: tuple(d.positive(1))),
    "load_class": (classification.load_class, lambda d: (d.share(),)),
    "load_class_en_13001": (classification.load_class_en_13001, lambda d: (d.share(),)),
    "group": (classification.group, lambda d: (int(d.rng.integers(10)), int(d.rng.integers(1, 5)))),
    "rope_safety_of_group": (
        hoist_class.rope_safety_of_group,
        lambda d: (f"M{d.rng.integers(1, 7)}", int(d.rng.integers(1, 9)), bool(d.rng.integers(2))),
    ),
    "speed_source_factor": (lift_off.speed_source_factor, lambda d: tuple(d.positive(3))),
    "elasticity_number": (lift_off.elasticity_number, lambda d: tuple(d.positive(6))),
    "drive_mass_number": (lift_off.drive_mass_number, lambda d: tuple(d.positive(6))),
    "motor_slope_number": (lift_off.motor_slope_number, lambda d: tuple(d.positive(4))),
    "structure_number": (lift_off.structure_number, lambda d: tuple(d.positive(4))),
    "held_swing_force": (lift_off.held_swing_force, lambda d: tuple(d.positive(5))),
    "release_factor": (lift_off.release_factor, lambda d: (d.share(), d.share())),
    "class_lift_off_speed": (
        lift_off_standard.class_lift_off_speed,
        lambda d: (str(d.rng.choice(lift_off_standard.DRIVES)), "regular", *d.positive(2), "printed"),
    ),
    "fem_lift_off_factor": (
        lift_off_standard.fem_lift_off_factor,
        lambda d: (d.shape("bridge", "jib"), *d.positive(1)),
    ),
    "standard_lift_off_factor": (
        lift_off_standard.standard_lift_off_factor,
        lambda d: (str(d.rng.choice(list(lift_off_standard.BETA))), "HD5", *d.positive(1), "by_drive"),
    ),
    "swing_frequency": (pendulum.swing_frequency, lambda d: tuple(d.positive(2))),
    "swing_period": (pendulum.swing_period, lambda d: (*d.positive(2), 3.1 * d.share())),
    "driven_frequency": (pendulum.driven_frequency, lambda d: tuple(d.positive(4))),
    "steady_lean": (pendulum.steady_lean, lambda d: tuple(d.positive(2))),
    "largest_lean": (pendulum.largest_lean, lambda d: tuple(d.positive(2))),
    "swing_force": (pendulum.swing_force, lambda d: tuple(d.positive(3))),
    "driven_slow_down": (pendulum.driven_slow_down, lambda d: tuple(d.positive(3))),
    "ramp_residual": (pendulum.ramp_residual, lambda d: tuple(d.positive(4))),
    "ramp_swing": (pendulum.ramp_swing, lambda d: tuple(d.positive(4))),
    "start_stop_residual": (pendulum.start_stop_residual, lambda d: tuple(d.positive(6))),
    "cancelling_ramp": (pendulum.cancelling_ramp, lambda d: tuple(d.positive(3))),
    "hoisted_angle": (pendulum.hoisted_angle, lambda d: tuple(d.positive(3))),
    "hoisted_angle_bounds": (pendulum.hoisted_angle_bounds, slowly_hoisted),
    "slewing_lean": (pendulum.slewing_lean, lambda d: (*d.positive(4),)),
    "small_angle_error": (pendulum.small_angle_error, small_swing),
    "rod_root": (rope_rod.rod_root, lambda d: (*d.positive(1), int(d.rng.integers(1, 9)))),
    "rod_frequency": (rope_rod.rod_frequency, lambda d: (*d.positive(3), int(d.rng.integers(1, 9)))),
    "free_rod_root": (rope_rod.free_rod_root, lambda d: tuple(d.positive(2))),
    "framed_rod_frequency": (rope_rod.framed_rod_frequency, lambda d: tuple(d.positive(6))),
    "free_rod_frequency": (rope_rod.free_rod_frequency, lambda d: tuple(d.positive(4))),
    "third_mass_frequency": (rope_rod.third_mass_frequency, lambda d: tuple(d.positive(3))),
    "snatch_wave_force": (rope_rod.snatch_wave_force, lambda d: tuple(d.positive(3))),
    "hauling_gain": (rope_rod.hauling_gain, lambda d: tuple(d.positive(2))),
    "paying_out_gain": (rope_rod.paying_out_gain, lambda d: tuple(d.positive(2))),
    "hauled_strain": (
        rope_rod.hauled_strain,
        lambda d: (*d.positive(3), *sorted(d.positive(2), reverse=True), *d.positive(2)),
    ),
    "corner_loads": (wheel_loads.corner_loads, lambda d: (*cycle(d, 6), *d.positive(2), d.shape("hinged", "rigid"))),
    "corner_load_range": (
        wheel_loads.corner_load_range,
        lambda d: (*cycle(d, 7), *d.positive(2), d.shape("hinged", "rigid")),
    ),
    "wheels_of_rail": (
        wheel_loads.wheels_of_rail,
        lambda d: (*d.positive(2), np.arange(6) * d.positive(1)[0], d.shape("equalised", "rigid")),
    ),
    "mean_wheel_load": (wheel_loads.mean_wheel_load, lambda d: tuple(d.positive(2))),
    "wheel_spectrum_factor": (wheel_loads.wheel_spectrum_factor, lambda d: (*cycle(d, 2), 10 / 3)),
    "even_travel_factor": (wheel_loads.even_travel_factor, lambda d: (d.share(), 3.0)),
    "rolling_coefficient": (travel.rolling_coefficient, lambda d: tuple(d.positive(5))),
    "wind_pressure": (travel.wind_pressure, lambda d: tuple(d.positive(2))),
    "wind_force": (travel.wind_force, lambda d: tuple(d.positive(3))),
    "travel_resistance": (
        travel.travel_resistance,
        lambda d: (d.rng.choice([-1.0, 1.0]) * d.positive(1)[0], *d.positive(2), d.share(), *d.positive(1)),
    ),
    "holding_force": (travel.holding_force, lambda d: (*d.positive(2), d.share(), *d.positive(1))),
    "hoisting_factors": (standard_factors.hoisting_factors, lambda d: (0.1 * d.share(),)),
    "drive_factor": (
        standard_factors.drive_factor,
        lambda d: (d.shape(*standard_factors.DRIVE_CHANGES), bool(d.rng.integers(2)), "by_change"),
    ),
    "load_test_factors": (standard_factors.load_test_factors, lambda d: tuple(d.positive(1))),
    "rail_acceleration": (rail.rail_acceleration, lambda d: tuple(d.positive(2))),
    "step_number": (rail.step_number, lambda d: tuple(d.positive(4))),
    "gap_number": (rail.gap_number, lambda d: tuple(d.positive(3))),
    "residual_step": (rail.residual_step, lambda d: tuple(d.positive(1))),
    "residual_gap": (rail.residual_gap, lambda d: tuple(d.positive(1))),
    "step_extremes": (rail.step_extremes, lambda d: tuple(d.positive(1))),
    "gap_extremes": (rail.gap_extremes, lambda d: tuple(d.positive(1))),
    "wheel_modes": (rail.wheel_modes, lambda d: tuple(d.positive(4))),
    "rail_factor": (rail.rail_factor, lambda d: tuple(d.positive(4))),
    "waviness_acceleration": (rail.waviness_acceleration, lambda d: tuple(d.positive(3))),
    "tilt_way": (rail.tilt_way, lambda d: tuple(d.positive(3))),
    "resonance_speed": (rail.resonance_speed, lambda d: tuple(d.positive(2))),
    "push_force": (fork.push_force, lambda d: tuple(d.positive(4))),
    "push_bound": (fork.push_bound, lambda d: tuple(d.positive(5))),
    "push_least": (fork.push_least, lambda d: tuple(d.positive(6))),
    "clutch_push": (fork.clutch_push, lambda d: tuple(d.positive(4))),
    "caught_force": (fork.caught_force, lambda d: tuple(d.positive(5))),
    "soft_caught_force": (fork.soft_caught_force, lambda d: tuple(d.positive(5))),
    "stall_force": (fork.stall_force, lambda d: tuple(d.positive(3))),
    "caught_bound": (fork.caught_bound, lambda d: tuple(d.positive(7))),
    "rack_bound": (fork.rack_bound, lambda d: tuple(d.positive(7))),
    "catching_number": (fork.catching_number, lambda d: tuple(d.positive(5))),
    "slope_number": (fork.slope_number, lambda d: tuple(d.positive(3))),
    "trip_speed": (safety_gear.trip_speed, lambda d: tuple(d.positive(2))),
    "trip_time": (safety_gear.trip_time, lambda d: (*d.positive(1), 1.2 + d.share(), *d.positive(1))),
    "catch_speed": (safety_gear.catch_speed, lambda d: tuple(d.positive(4))),
    "fall_before_catch": (safety_gear.fall_before_catch, lambda d: (*sorted(d.positive(2)), *d.positive(1))),
    "progressive_deceleration": (
        lambda *given: abs(safety_gear.progressive_deceleration(*given)),  # below 0 where the gear does not hold
        lambda d: tuple(d.positive(3)),
    ),
    "progressive_distance": (
        lambda *given: min(safety_gear.progressive_distance(*given), 1e99),  # infinite where the gear does not hold
        lambda d: tuple(d.positive(4)),
    ),
    "gear_force_needed": (safety_gear.gear_force_needed, lambda d: tuple(d.positive(4))),
    "gear_speed_left": (safety_gear.gear_speed_left, lambda d: tuple(d.positive(5))),
    "instantaneous_force": (safety_gear.instantaneous_force, lambda d: tuple(d.positive(4))),
    "eccentric_moment": (safety_gear.eccentric_moment, lambda d: tuple(d.positive(2))),
    "axial_shock": (safety_gear.axial_shock, lambda d: tuple(d.positive(1))),
    "skew_angle": (skew.skew_angle, lambda d: (*d.positive(5), d.shape("full", "en_13001_2", "en_1991_3"))),
    "skew_friction": (skew.skew_friction, lambda d: (*d.positive(1), d.share())),
    "slip_pole": (
        skew.slip_pole,
        lambda d: (*cycle(d, 3), 0.999 * d.share(), *d.positive(1), d.shape("fixed", "movable")),
    ),
    "skew_forces": (
        skew.skew_forces,
        lambda d: (d.share(), *cycle(d, 3), 0.999 * d.share(), *d.positive(1), d.shape("fixed", "movable")),
    ),
    "skew_equilibrium": (
        skew.skew_equilibrium,
        lambda d: (
            0.3,
            0.015 * d.share(),
            *cycle(d, 3),
            0.999 * d.share(),
            *d.positive(1),
            d.shape("fixed", "movable"),
        ),
    ),
    "start_side_forces": (skew.start_side_forces, lambda d: (*d.positive(1), d.share(), *d.positive(2))),
    "wheel_grip": (skid.wheel_grip, lambda d: tuple(d.positive(6))),
    "driven_forces": (skid.driven_forces, lambda d: (*d.positive(3), np.array(d.positive(3)))),
    "skid_reserve": (skid.skid_reserve, lambda d: tuple(d.positive(3))),
    "slip_accelerations": (
        lambda *given: np.minimum(skid.slip_accelerations(*given), 1e99),  # infinite where a wheel never slips
        lambda d: (*d.positive(3), *(np.array(d.positive(3)) for _ in range(3))),
    ),
    "slipping_acceleration": (
        skid.slipping_acceleration,
        lambda d: (
            *(np.array(d.positive(3)) for _ in range(2)),
            *d.positive(3),
            np.array(d.positive(3)),
            np.zeros(3),
        ),
    ),
    "rail_force": (skid.rail_force, lambda d: tuple(d.positive(6))),
    "slip_motor_torque": (skid.slip_motor_torque, lambda d: tuple(d.positive(6))),
    "paper_frequency": (winding.paper_frequency, lambda d: tuple(d.positive(5))),
    "paper_amplitude": (winding.paper_amplitude, lambda d: tuple(d.positive(2))),
    "climb_amplitude": (winding.climb_amplitude, lambda d: tuple(d.positive(2))),
    "climb_rates": (winding.climb_rates, lambda d: tuple(d.positive(1))),
    "stretch_stress": (winding.stretch_stress, lambda d: tuple(d.positive(3))),
    "fall_stress": (winding.fall_stress, lambda d: (d.positive(1)[0], 4, d.positive(1)[0])),
    "stress_ratio": (winding.stress_ratio, lambda d: (*d.positive(2), 4, 2, d.positive(1)[0])),
    "sudden_ratio": (winding.sudden_ratio, lambda d: (*d.positive(3), 4, 2, d.positive(1)[0])),
    "crossover_ratio": (winding.crossover_ratio, lambda d: (2, *d.positive(2))),
    "crossover_rise": (winding.crossover_rise, lambda d: (on := d.positive(1)[0], on * d.share())),
    "winding_radius": (winding.winding_radius, lambda d: (*d.positive(3), 2, 3 * d.share() + 1e-3, 9 * d.share())),
}
SIGNED = {
    "acceleration",
    "holding_moment",
    "crank_angles",
    "reduced_inertia_slope",
    "rod_centre_height",
    "rod_centre_lift",
    "slider_velocity",
    "converter_torque",
    "mode_compliance",
    "coulomb_decay",
    "coulomb_slide",
    "decay_response",
    "free_response",
    "free_speed",
    "hanging_start_force",
    "hoisting_stop_force",
    "input_torque",
    "kloss",
    "kloss_slip",
    "kloss_slope",
    "linear_torque",
    "motor_acceleration",
    "motor_torque",
    "motor_torque_seed_rule",
    "pulse_response",
    "quasi_static_fixed",
    "reflection",
    "reverse_efficiency",
    "sine_response",
    "slip",
    "switching_speed",
    "strand_tensions",
    "tension_extremes",
    "loading_envelope",
    "loading_resistance",
    "takeup_travel",
    "idler_line_load",
    "rollback_force",
    "coast_down_coefficient",
    "slip_heat",
    "polygon_displacement",
    "polygon_speed",
    "polygon_acceleration",
    "ramped_acceleration",
    "acceleration_harmonics",
    "nearest_threshold",
    "equalising_angle",
    "modal_masses",
    "modal_tensions",
    "modal_shapes",
    "start_shares",
    "start_acceleration",
    "rigid_acceleration",
    "fall_pulls",
    "release_factor",
    "hauled_strain",
    "corner_loads",
    "corner_load_range",
    "wheels_of_rail",
    "travel_resistance",
    "wheel_grip",
    "rail_force",
    "slipping_acceleration",
    "skew_forces",
    "skew_equilibrium",
    "start_side_forces",
}
"""Laws whose value may be negative."""
BELOW_ROUNDING = {"two_interval_force", "two_interval_peak", "rise_integral"}
"""Laws with a difference whose rounding may take it below 0; their digits are checked further down."""


@pytest.mark.parametrize("name", FINITE)
def test_no_law_overflows_or_loses_its_sign_over_twenty_four_decades(name: str) -> None:
    law, arguments = FINITE[name]
    draw = Draw(seed=2)
    for _ in range(300):
        given = arguments(draw)
        values = np.ravel(np.asarray(law(*given), float))
        assert np.all(np.isfinite(values)), given
        assert name in SIGNED | BELOW_ROUNDING or np.all(values >= 0), given


def test_grip_over_twenty_four_decades_is_finite_or_where_the_docstring_says_infinite() -> None:
    draw = Draw(seed=3)
    for _ in range(1000):
        slack, more, lift, exponent = draw.positive(4)
        tight = slack + more
        used = float(capstan.slip_utilisation(tight, slack, lift, exponent))
        assert math.isinf(used) == (slack <= lift)
        reserve = float(capstan.slip_reserve_force(tight, slack, exponent))
        nothing_transmitted = tight == slack  # the sum may round it away
        beyond_floats = exponent > 709 - math.log(max(slack / more, 1.0))
        assert reserve > 0
        assert not math.isinf(reserve) or nothing_transmitted or beyond_floats


# --- digits: exponentials ---------------------------------------------------------------------------------------

SMALL_TO_LARGE = [1e-12, 1e-9, 1e-5, 0.1, 1.0, 7.0, 50.0]


class TestGripKeepsItsDigits:
    @pytest.mark.parametrize("exponent", [*SMALL_TO_LARGE, 300.0, 700.0])
    def test_utilisation(self, exponent: float) -> None:
        tight, slack, lift = 7e4, 2e4, 3e3
        exact = precise(
            lambda: (Decimal(tight) - Decimal(lift)) / (Decimal(slack) - Decimal(lift)) * (-Decimal(exponent)).exp()
        )
        assert capstan.slip_utilisation(tight, slack, lift, exponent) == pytest.approx(exact, rel=1e-13, abs=0)

    @pytest.mark.parametrize("exponent", [*SMALL_TO_LARGE, 300.0, 690.0])
    def test_reserve(self, exponent: float) -> None:
        tight, slack = 7e4, 2e4
        exact = precise(lambda: Decimal(slack) * (Decimal(exponent).exp() - 1) / (Decimal(tight) - Decimal(slack)))
        assert capstan.slip_reserve_force(tight, slack, exponent) == pytest.approx(exact, rel=1e-13, abs=0)

    @pytest.mark.parametrize("exponent", SMALL_TO_LARGE)
    def test_reserve_of_a_ratio_and_back(self, exponent: float) -> None:
        ratio, reserve = 1.25, 1.4
        by_ratio = precise(lambda: (1 - (-Decimal(exponent)).exp()) / (Decimal(ratio) - (-Decimal(exponent)).exp()))
        by_reserve = precise(lambda: (-Decimal(exponent)).exp() + (1 - (-Decimal(exponent)).exp()) / Decimal(reserve))
        assert capstan.slip_reserve_ratio(ratio, exponent) == pytest.approx(by_ratio, rel=1e-13, abs=0)
        assert capstan.slip_ratio(reserve, exponent) == pytest.approx(by_reserve, rel=1e-13, abs=0)

    def test_four_hundred_turns(self) -> None:
        """A winch that nothing can make slip: no use of its grip, no end to its reserve, no overflow."""
        exponent = 0.4 * 2 * math.pi * 400
        assert capstan.slip_utilisation(5e5, 1.0, 0.0, exponent) == 0.0
        assert capstan.slip_reserve_force(5e5, 1.0, exponent) == math.inf
        assert capstan.slip_ratio(2.0, exponent) == pytest.approx(0.5, rel=1e-15)
        assert capstan.slip_reserve_ratio(0.5, exponent) == pytest.approx(2.0, rel=1e-15)

    def test_without_tension_and_without_wrap(self) -> None:
        assert capstan.slip_utilisation(0.0, 0.0, 0.0, 0.0) == math.inf
        assert capstan.slip_reserve_force(0.0, 0.0, 0.0) == 0.0
        assert capstan.slip_reserve_force(1.0, 1.0, 0.0) == math.inf
        assert capstan.slip_reserve_ratio(1.0, 0.0) == math.inf
        assert capstan.slip_ratio(2.0, 0.0) == 1.0


class TestFirstWaveKeepsItsDigits:
    @pytest.mark.parametrize("time", SMALL_TO_LARGE)
    def test_force_and_speed(self, time: float) -> None:
        force, impedance, mass = 3.0, 5.0, 7.0

        def grown() -> Decimal:
            return 1 - (-Decimal(impedance) * Decimal(time) / Decimal(mass)).exp()

        exact = precise(lambda: Decimal(force) * grown())
        assert wave.first_wave_force(force, impedance, mass, time) == pytest.approx(exact, rel=1e-14, abs=0)
        speed = precise(lambda: Decimal(force) / Decimal(impedance) * grown())
        assert wave.first_wave_speed(force, impedance, mass, time) == pytest.approx(speed, rel=1e-14, abs=0)

    @pytest.mark.parametrize("impedance", [1e-300, 1e-30, 1e-12])
    def test_speed_behind_a_belt_that_weighs_next_to_nothing(self, impedance: float) -> None:
        """The division by the impedance takes nothing away: F t/m, as with no belt at all."""
        with_belt = wave.first_wave_speed(12.0, impedance, 3.0, 5.0)
        assert with_belt == pytest.approx(20.0, rel=1e-11)
        assert wave.first_wave_speed(12.0, 0.0, 3.0, 5.0) == 20.0

    def test_no_force_and_no_time(self) -> None:
        times = np.array([0.0, 1.0])
        assert wave.first_wave_force(0.0, 5.0, 7.0, times).tolist() == [0.0, 0.0]
        assert wave.first_wave_speed(0.0, 5.0, 7.0, times).tolist() == [0.0, 0.0]
        assert wave.first_wave_force(3.0, 5.0, 7.0, 0.0) == 0.0


class TestTwoIntervalsKeepTheirDigits:
    """Against the delay equation's solution in decimals, over mass ratios of belt to drive of 5e-13 to 25."""

    @pytest.mark.parametrize("ratio", SMALL_TO_LARGE)
    @pytest.mark.parametrize("at", [0.25, 1.0, 1.25, 1.5])
    def test_error_is_small_against_the_peak(self, ratio: float, at: float) -> None:
        """T/tau = ratio. The peak F (1 - exp(-T/tau)) itself is small for a heavy drive."""
        contour, tau = ratio, 1.0
        time = at * contour

        def solution() -> Decimal:
            x = Decimal(time) - Decimal(contour)
            if x <= 0:
                return 1 - (-Decimal(time)).exp()
            return 1 - (2 * x + (-Decimal(contour)).exp()) * (-x).exp()

        peak = -math.expm1(-ratio)
        assert wave.two_interval_force(1.0, contour, tau, time) == pytest.approx(
            precise(solution), rel=0, abs=1e-12 * peak
        )

    @pytest.mark.parametrize("ratio", SMALL_TO_LARGE)
    def test_both_branches_meet_at_the_corner(self, ratio: float) -> None:
        """The peak is at the corner and is approached from both sides."""
        peak, when = wave.two_interval_peak(1.0, ratio, 1.0, 2 * ratio)
        assert when == ratio
        assert peak == pytest.approx(-math.expm1(-ratio), rel=1e-14)
        beside = wave.two_interval_force(1.0, ratio, 1.0, np.nextafter(ratio, 100))
        assert beside == pytest.approx(peak, rel=1e-12)


# --- digits: motors ---------------------------------------------------------------------------------------------


def kloss_exactly(slip: float, most: float, s_k: float, ratio: float) -> Fraction:
    s, m, k, a = map(Fraction, (slip, most, s_k, ratio))
    return 2 * m * (1 + a * k) * s * k / (s * s + k * k + 2 * a * k * k * s)


class TestKlossKeepsItsDigits:
    RATIOS = [0.0, 1e-9, 1.0, 4.0, 8 * (1 - 2**-20)]
    """Of which 8 would be a pole at s = -s_k = -1/8."""
    SLIPS = [1e-300, 1e-12, 0.01, 0.124999, 0.125, 0.125001, 1.0, 2.0, 1e12, 1e300]

    @pytest.mark.parametrize("ratio", RATIOS)
    @pytest.mark.parametrize("slip", [0.0, *SLIPS, *(-s for s in SLIPS)])
    def test_torque(self, ratio: float, slip: float) -> None:
        exact = float(kloss_exactly(slip, 700.0, 0.125, ratio))
        tolerance = 1e-9 if ratio > 7 and -0.13 < slip < -0.12 else 1e-14  # at the pole the rounded input decides
        assert motor.kloss(slip, 700.0, 0.125, ratio) == pytest.approx(exact, rel=tolerance, abs=0)

    @pytest.mark.parametrize("ratio", RATIOS)
    @pytest.mark.parametrize("share", [-1.0, -0.5, -1e-12, 0.0, 1e-300, 1e-9, 0.6, 1 - 1e-9, 1.0])
    def test_torque_and_back(self, ratio: float, share: float) -> None:
        def exactly() -> Decimal:
            q, m = Decimal(ratio) / 8, Decimal(share)
            n = 1 + q - q * m
            return m / 8 / (n + (n * n - m * m).sqrt())

        found = motor.kloss_slip(share * 512.0, 512.0, 0.125, ratio)
        assert found == pytest.approx(precise(exactly), rel=1e-14, abs=0)

    @pytest.mark.parametrize("overload", [1.0, 1 + 2**-40, 1.5, 3.0, 1e6])
    @pytest.mark.parametrize("share", [0.0, 1e-9, 0.5, 1 - 1e-12])
    def test_breakdown_slip(self, overload: float, share: float) -> None:
        rated_slip = 0.03
        ratio = share * motor.largest_stator_ratio(rated_slip, overload)

        def exactly() -> Decimal:
            """The larger root of the quadratic of the rated point."""
            s, most, a = map(Decimal, (rated_slip, overload, ratio))
            leading = 1 - 2 * a * s * (most - 1)
            return s * (most + (most * most - leading).sqrt()) / leading

        assert motor.breakdown_slip(rated_slip, overload, ratio) == pytest.approx(precise(exactly), rel=1e-14, abs=0)


class TestHeatingKeepsItsDigits:
    @pytest.mark.parametrize("size", [1e-300, 1e-12, 1.0, 1e12, 1e300])
    def test_of_torques_of_any_size(self, size: float) -> None:
        """The squares alone would overflow, or vanish."""
        torques = [3 * size, -4 * size]
        assert duty.rms_torque(torques, [1.0, 1.0]) == pytest.approx(math.sqrt(12.5) * size, rel=1e-14, abs=0)

    def test_of_a_torque_that_turns_round(self) -> None:
        """M_1^2 + M_1 M_2 + M_2^2 with M_2 next to -M_1 is M^2 all the same."""
        turned = -7.0 * (1 + 2**-30)
        exact = precise(lambda: ((49 + 7 * Decimal(turned) + Decimal(turned) ** 2) / 3).sqrt())
        assert duty.equivalent_torque([7.0], [turned], [3.0]) == pytest.approx(exact, rel=1e-15)

    @pytest.mark.parametrize("nearly", [1.0, 1 - 2**-50])
    def test_of_a_motor_that_never_or_hardly_ever_rests(self, nearly: float) -> None:
        assert duty.permissible_torque(400.0, 1.0, nearly, 3.0, 0.0) == pytest.approx(400.0, rel=1e-13)
        assert duty.permissible_switching_rate(900.0, 900.0, 1.0, 0.3, 1e4) == 0.0


# --- digits: start profiles -------------------------------------------------------------------------------------

SHARES = [1e-9, 1e-6, 1e-3, 0.03, 0.4, 0.999]


class TestProfilesKeepTheirDigits:
    @pytest.mark.parametrize("share", SHARES)
    def test_cosine(self, share: float) -> None:
        rise_time = 8.0
        angle = PI * Decimal(share)

        def factor() -> Decimal:
            half = sine(angle / 2)
            return half * half

        time = share * rise_time  # exact: a power of two
        assert start_profile.rise("cosine", rise_time, time) == pytest.approx(precise(factor), rel=1e-13, abs=0)
        slope = precise(lambda: PI / 2 / 8 * sine(angle))
        assert start_profile.rise_rate("cosine", rise_time, time) == pytest.approx(slope, rel=1e-12, abs=0)

    @pytest.mark.parametrize("share", SHARES)
    def test_integral_of_the_cosine(self, share: float) -> None:
        """pi^2 t^3/(12 t_s^2) at first: the two terms of the closed form nearly cancel there."""
        rise_time = 8.0
        area = precise(lambda: Decimal(rise_time) / 2 * (Decimal(share) - sine(PI * Decimal(share)) / PI))
        found = start_profile.rise_integral("cosine", rise_time, share * rise_time)
        assert found == pytest.approx(area, rel=1e-9, abs=0)

    @pytest.mark.parametrize("share", SHARES)
    def test_ramp(self, share: float) -> None:
        rise_time = 8.0
        assert start_profile.rise("ramp", rise_time, share * rise_time) == pytest.approx(share, rel=1e-15, abs=0)
        area = float(Fraction(share) ** 2 * 4)
        assert start_profile.rise_integral("ramp", rise_time, share * rise_time) == pytest.approx(
            area, rel=1e-14, abs=0
        )

    def test_long_after_the_rise(self) -> None:
        for shape in ("ramp", "cosine"):
            assert start_profile.rise(shape, 1e-12, 1e12) == 1.0
            assert start_profile.rise_rate(shape, 1e-12, 1e12) == 0.0
            assert start_profile.rise_integral(shape, 1e-12, 1e12) == 1e12


class TestPhasesAtTheirEdges:
    @pytest.mark.parametrize("product", [1e2, 1e5, 1e9, 1e12])
    def test_of_a_very_slow_start_are_the_leading_terms(self, product: float) -> None:
        """Duhamel's integral by parts: the first jump that remains, in the slope or in the curvature of the load."""
        b = math.pi / product
        tolerance = 2 * b + 1e-12
        strays = {
            key: [phase.stray for phase in start_profile.phases(*key, 1.0, product)]
            for key in [("ramp", False), ("cosine", False), ("cosine", True)]
        }
        assert strays["ramp", False] == pytest.approx([1 / product, 2 / product], rel=tolerance)
        assert strays["cosine", False] == pytest.approx([b**2, b**2], rel=tolerance)
        assert strays["cosine", True] == pytest.approx([b, 2 * b], rel=tolerance)

    @pytest.mark.parametrize("times_pi", [0.0, 1e-12, 0.5, 1 - 1e-15, 1.0, 1 + 1e-15, 1 + 1e-9, 1.2])
    def test_at_resonance_with_the_rise_the_caps_hold(self, times_pi: float) -> None:
        """w t_s = pi divides by nothing: there the cap of a step by step answer holds, and beside it, too."""
        for shape in ("ramp", "cosine"):
            for imposed_speed, cap in ((False, 1.0), (True, 2.0)):
                for phase in start_profile.phases(shape, imposed_speed, 1.0, times_pi * math.pi):
                    assert 0 < phase.stray <= cap
        caps = [phase.stray for phase in start_profile.phases("cosine", True, 1.0, math.pi)]
        assert caps == [2.0, 2.0]


class TestWindowLeakAtItsEdges:
    @pytest.mark.parametrize(
        ("angle", "leak"),
        [
            (0.0, 1.0), (math.pi, 1.0), (math.nextafter(math.pi, 4), 1.0), (1.4 * math.pi, 1.0),
            (2 * math.pi, 1 / 3), (10 * math.pi, 1 / 99), (1e12 * math.pi, 1e-24),
        ],
    )  # fmt: skip
    def test_is_capped_where_the_average_could_see_everything(self, angle: float, leak: float) -> None:
        assert loop_bounds.window_leak(angle, 1.0) == pytest.approx(leak, rel=1e-12, abs=0)
        assert loop_bounds.window_leak(1.0, angle) == pytest.approx(leak, rel=1e-12, abs=0)


# --- digits: loops ----------------------------------------------------------------------------------------------


def exact_opening(loop: LoopMasses, strand: int, x: float | Fraction) -> Fraction:
    """G in rational numbers, as the power of the opening: the integral of the squared acceleration over all masses.

    The acceleration is 0 at the run-off and the drum, rises with the compliance passed (fixed loop) and drops by 1 at
    the section; a drum that is free to follow adds the same to all masses, so that no momentum is left over.
    """
    x = Fraction(x)
    back, tail, carry, drive = map(Fraction, (loop.return_mass, loop.tail_mass, loop.carry_mass, loop.drive_mass))
    whole = Fraction(loop.return_compliance) + Fraction(loop.carry_compliance)
    g = Fraction(loop.return_compliance) / whole
    one = Fraction(1)
    if not loop.fixed_length:
        g, rest = Fraction(0), Fraction(0)
    else:
        rest = 1 - g
    # (mass, acceleration at its two ends), linear between them
    if strand == RETURN:
        parts = [(back * x, Fraction(0), g * x), (back * (1 - x), g * x - 1, g - 1)]
        parts += [(tail, g - 1, g - 1), (carry, g - 1, g + rest - 1)]
    else:
        parts = [(back, Fraction(0), g), (tail, g, g), (carry * x, g, g + rest * x)]
        parts += [(carry * (1 - x), g + rest * x - 1, g + rest - 1)]
    drum = Fraction(0) if loop.fixed_length else -one
    if loop.imposed_speed:
        rigid = -drum
    else:
        parts.append((drive, drum, drum))
        rigid = -sum((m * (a + b) / 2 for m, a, b in parts), Fraction(0)) / sum((m for m, _, _ in parts), Fraction(0))
    return sum(
        (m * ((a + rigid) ** 2 + (a + rigid) * (b + rigid) + (b + rigid) ** 2) / 3 for m, a, b in parts), Fraction(0)
    )


BOOLE = [(Fraction(k, 4), Fraction(w, 90)) for k, w in enumerate((7, 32, 12, 32, 7))]
"""Exact for polynomials up to degree 5; G has degree 4 at most."""


def exact_frequency(loop: LoopMasses) -> float:
    total = sum(
        Fraction(compliance) * weight * exact_opening(loop, strand, x)
        for strand, compliance in ((RETURN, loop.return_compliance), (CARRY, loop.carry_compliance))
        for x, weight in BOOLE
    )
    return precise(lambda: 1 / (Decimal(total.numerator) / Decimal(total.denominator)).sqrt())


class TestLoopsKeepTheirDigits:
    """Masses and compliances drawn over so many decades each way; a belt conveyor knows two."""

    @pytest.mark.parametrize(("decades", "digits"), [(1, 1e-11), (2, 1e-9), (12, 1e-6)])
    @pytest.mark.parametrize("fixed_length", [False, True], ids=["gravity", "fixed"])
    @pytest.mark.parametrize("imposed_speed", [False, True], ids=["force", "speed"])
    def test_opening(self, decades: int, digits: float, fixed_length: bool, imposed_speed: bool) -> None:
        draw = Draw(seed=9, decades=(-decades, decades))
        for _ in range(80):
            loop = draw.loop(fixed_length, imposed_speed)
            for strand in (RETURN, CARRY):
                x = draw.share()
                exact = float(exact_opening(loop, strand, x))
                assert loop_bounds.tension_green(loop, strand, x) == pytest.approx(exact, rel=digits, abs=0)

    @pytest.mark.parametrize(("decades", "digits"), [(1, 1e-11), (2, 1e-9), (12, 1e-6)])
    @pytest.mark.parametrize("fixed_length", [False, True], ids=["gravity", "fixed"])
    @pytest.mark.parametrize("imposed_speed", [False, True], ids=["force", "speed"])
    def test_lowest_frequency(self, decades: int, digits: float, fixed_length: bool, imposed_speed: bool) -> None:
        draw = Draw(seed=10, decades=(-decades, decades))
        for _ in range(40):
            loop = draw.loop(fixed_length, imposed_speed)
            assert loop_bounds.lowest_frequency_bound(loop) == pytest.approx(exact_frequency(loop), rel=digits, abs=0)

    def test_stray_at_the_run_on_of_a_gravity_take_up_is_the_belt_down_to_no_drive(self) -> None:
        for drive in (1e12, 1.0, 1e-12, 1e-300):
            loop = LoopMasses(1e3, 3e3, 70.0, drive, 1e-5, 1e-5, fixed_length=False, imposed_speed=False)
            assert loop_bounds.stray(loop, CARRY, 1.0) == pytest.approx(4070.0, rel=1e-14)

    @pytest.mark.parametrize("fixed_length", [False, True])
    @pytest.mark.parametrize("without", ["return_mass", "carry_mass", "tail_mass"])
    @pytest.mark.parametrize("imposed_speed", [False, True])
    def test_a_part_without_mass(self, fixed_length: bool, imposed_speed: bool, without: str) -> None:
        loop = LoopMasses(1e3, 3e3, 70.0, 2e3, 1e-5, 3e-5, fixed_length=fixed_length, imposed_speed=imposed_speed)
        loop = replace(loop, **{without: 0.0})
        x = np.linspace(0, 1, 9)
        for strand in (RETURN, CARRY):
            exact = [float(exact_opening(loop, strand, float(at))) for at in x]
            assert loop_bounds.tension_green(loop, strand, x) == pytest.approx(exact, rel=1e-12, abs=1e-10)
            assert np.all(np.isfinite(loop_bounds.stray(loop, strand, x)))
        assert loop_bounds.lowest_frequency_bound(loop) == pytest.approx(exact_frequency(loop), rel=1e-12)

    @pytest.mark.parametrize("fixed_length", [False, True])
    def test_an_imposed_speed_asks_nothing_of_the_drive(self, fixed_length: bool) -> None:
        """The drum moves as told: its mass, even none, changes nothing."""
        base = LoopMasses(1e3, 3e3, 70.0, 0.0, 1e-5, 3e-5, fixed_length=fixed_length, imposed_speed=True)
        x = np.linspace(0, 1, 5)
        for strand in (RETURN, CARRY):
            strays = [loop_bounds.stray(replace(base, drive_mass=drive), strand, x) for drive in (0.0, 1.0, 1e12)]
            assert strays[0].tolist() == strays[1].tolist() == strays[2].tolist()


# --- zeros ------------------------------------------------------------------------------------------------------


class TestWithoutWeight:
    """A span that weighs nothing does not sag and does not soften; without tension both are infinite as documented,
    whatever it weighs."""

    TENSIONS = np.array([-1.0, 0.0, 1e-12, 1e12])

    @pytest.mark.parametrize("weight", [0.0, 50.0])
    def test_sag(self, weight: float) -> None:
        ratio = sag.sag_ratio(weight, self.TENSIONS)
        assert np.isinf(ratio).tolist() == [True, True, False, False]
        assert ratio[2:] == pytest.approx([weight / 8e-12, weight / 8e12], rel=1e-14)

    @pytest.mark.parametrize("weight", [0.0, 50.0])
    def test_softening(self, weight: float) -> None:
        f = sag.softening(1e8, weight, self.TENSIONS)
        assert np.isinf(f).tolist() == [True, True, False, False]
        assert f[2:] == pytest.approx([1e8 * weight**2 / 12e-36, 1e8 * weight**2 / 12e36], rel=1e-13)


def test_a_drive_without_rotor_drum_force_or_torque() -> None:
    assert inertia.reduced_drive_mass(0.0, 20.0, 0.9, 0.0, 0.4) == 0.0
    assert motor.mean_starting_torque(0.0, 0.0) == 0.0
    assert motor.rim_force(0.0, 20.0, 0.9, 0.4) == 0.0
    assert resistance.main_resistance_per_length(0.0, 9.81, 180.0, 15.0, 1.0) == 0.0


def test_reflection_at_nothing_and_at_everything() -> None:
    assert wave.reflection(1e-12, 0.0) == -1.0
    assert wave.reflection(0.0, 1e-12) == 1.0
    assert wave.reflection(1e12, 1e-12) == -1.0
    assert wave.reflection(1e12, math.nextafter(1e12, 2e12)) == pytest.approx(math.ulp(1e12) / 2e12, rel=1e-9)
