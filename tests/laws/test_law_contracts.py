"""What the docstrings of all laws promise: units that fit together, floats and arrays alike, and the errors raised.

Dimensions: the units in brackets are read from the docstrings; mass, length and time are then measured in other units
at random, every argument is converted, and the result must come out converted. A wrong unit in a docstring or a
formula that adds metres to seconds cannot pass.
"""

import importlib
import inspect
import math
import pkgutil
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, fields, is_dataclass, replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import ArrayLike
from support.each import over

import ptmcalc.laws
from ptmcalc.laws import (
    backlash,
    belt_damping,
    belt_modes,
    belt_resistance,
    belt_section,
    belt_splice,
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
    drum_shell,
    duty,
    equalising,
    fork,
    gearing,
    held_strands,
    hoist_class,
    hoisting,
    horizontal_curve,
    idler_roll,
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
    rope_life,
    rope_proof,
    rope_rod,
    runway_actions,
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
    threadline,
    travel,
    two_mass,
    vertical_curve,
    vibration,
    wave,
    wheel_loads,
    winding,
    wire_rope,
)
from ptmcalc.laws.held_strands import HeldStrands
from ptmcalc.laws.loop_bounds import CARRY, RETURN, LoopMasses
from ptmcalc.laws.mast_modes import Mast

SEEDS = range(5)
SHAPES_OF_ARRAYS = [(7,), (2, 3), (1,), (0,)]
Law = Callable[..., Any]
Dimension = tuple[int, int, int]
"""Exponents of mass, length and time."""

BASE: dict[str, Dimension] = {
    "1": (0, 0, 0),
    "rad": (0, 0, 0),
    "kg": (1, 0, 0),
    "m": (0, 1, 0),
    "s": (0, 0, 1),
    "Hz": (0, 0, -1),
    "N": (1, 1, -2),
    "J": (1, 2, -2),
    "W": (1, 2, -3),
}


def dimension(unit: str) -> Dimension:
    """kg*m^2, N*s/m, m/s^2: products, then one quotient after each stroke."""
    total = np.zeros(3, dtype=int)
    for k, part in enumerate(unit.split("/")):
        for factor in part.split("*"):
            name, _, power = factor.partition("^")
            total += np.array(BASE[name]) * int(power or 1) * (-1 if k else 1)
    return tuple(int(p) for p in total)  # type: ignore[return-value]


def section(law: Law, title: str) -> str:
    """A section of a docstring, up to the next heading at the same indentation."""
    found = re.search(rf"^{title}:\n((?:    .*\n|\n)*)", (inspect.getdoc(law) or "") + "\n", re.MULTILINE)
    return found[1] if found else ""


def units(text: str) -> list[str]:
    return re.findall(r"\[([^\[\]]+)\]", text)


def argument_units(law: Law) -> dict[str, str]:
    """Unit of every argument that has one."""
    entries = re.split(r"^    (\w+): ", section(law, "Args"), flags=re.MULTILINE)[1:]
    return {name: units(text)[-1] for name, text in zip(entries[::2], entries[1::2], strict=True) if units(text)}


def array_arguments(law: Law) -> list[str]:
    return [name for name, p in inspect.signature(law).parameters.items() if p.annotation == ArrayLike]


def all_laws() -> dict[str, Law]:
    """Every public function of every module of the laws."""
    found = {}
    for info in pkgutil.iter_modules(ptmcalc.laws.__path__):
        module = importlib.import_module(f"ptmcalc.laws.{info.name}")
        for name, law in vars(module).items():
            if inspect.isfunction(law) and law.__module__ == module.__name__ and not name.startswith("_"):
                found[f"{info.name}.{name}"] = law
    return found


LAWS = all_laws()
FIXED_LOOP = LoopMasses(3e3, 9e3, 400.0, 5e3, 1e-5, 3e-5, fixed_length=True, imposed_speed=False)
GRAVITY_LOOP = replace(FIXED_LOOP, fixed_length=False)
LOOPS = [replace(loop, imposed_speed=speed) for loop in (FIXED_LOOP, GRAVITY_LOOP) for speed in (False, True)]
HELD = [
    HeldStrands(3e3, 9e3, 400.0, 5e3, 1e-5, 3e-5, fixed_length=fixed, imposed_speed=speed)
    for fixed in (False, True)
    for speed in (False, True)
]
HELD_SECTIONS = [(loop, strand, 0.3) for loop in HELD for strand in (RETURN, CARRY)]
HELD_MODES = [
    (loop, np.array([5.0, 9.0, 12.0]), strand, np.array([0.0, 0.3]))
    for loop in HELD[1::2]
    for strand in (RETURN, CARRY)
]
SECTIONS = [(loop, strand, 0.3) for loop in LOOPS for strand in (RETURN, CARRY)]
RISES = ("linear", "exponential")
DAMPINGS = (0.0, 0.02, 1.0, 1.7)
FLOWS = ("drive", "brake", "energy")
READINGS = ("tip_stopped", "whole")
CRANK = (0.06, 0.42, 0.02)  # radius, rod, offset
HOIST = (2e4, 0.9, 400.0, 40.0)  # static torque, rotor, load, ratio
MASSES = tuple(map(np.array, ([18e4, 3e5], [11.2, 3.0], [0.1, 0.3], [-9e3, 1e4], [2e3, -5e3], [0.8, 2.0])))
PAIRS = (np.array([0.0, 4.2]), np.array([1.0, 0.0]), np.array([2e5, 1.6e5]))  # distances, coupling, weights
SKEW_EDITIONS = ("en_13001_2", "en_1991_3")
MODELS = [("full", 0.1, 0.1, 1.0, 1.0), ("geometric", 0.1, 0.5, 0.7, 1.0), ("ballast", 0.1, 1.0, 1.0, 1.0)]

PACKINGS = ("nested", "square")
SHAPES = ("step", "ramp", "cosine", "parabolic")
POINTS = ((0.0, 0.0), (0.3, 0.1), (1.0, 1.0))
ENDS, ATTITUDES = ("supported", "clamped"), ("hanging", "standing")
BRIDGE = (6.0, 210e9, 2e-4, 16.5, 1.2e-3)  # column, elasticity, its second moment, span, that of a girder
MASTS = (
    Mast(6.0, 4.2e7, 1200.0, 4e3, 1800.0, 500.0, 3e-8, 4e-7, 0.7, 80.0),
    Mast(6.0, 4.2e7, 1200.0, np.inf, 1800.0),
    Mast(6.0, 4.2e7, 1200.0, 4e3, 1800.0, 0.0, 3e-8, 0.0, 0.7, 80.0, 4e5),
)

BENDING = rope_life.Constants(1.3, 1.29, 8.149, -3.635)

CALLS: dict[Law, list[tuple[Any, ...]]] = {
    belt_damping.kelvin_voigt_change: [(0.7, 0.02)],
    belt_damping.hysteretic_change: [(0.02,)],
    belt_damping.zener_change: [(0.7, 0.4, 0.3), (0.0, 0.4, 0.3)],
    capstan.slip_utilisation: [(9e3, 3e3, 400.0, 1.3), (9e3, 300.0, 400.0, 1.3)],
    capstan.slip_reserve_force: [(9e3, 3e3, 1.3), (2e3, 3e3, 1.3), (3e3, -1.0, 1.3)],
    capstan.slip_reserve_ratio: [(0.7, 1.3), (0.1, 1.3)],
    capstan.slip_ratio: [(1.4, 1.3), (0.0, 1.3)],
    inertia.reduced_drive_mass: [(3.0, 20.0, 0.94, 60.0, 0.4)],
    inertia.inertia_on_motor_shaft: [(90.0, 20.0, 0.9, flow) for flow in FLOWS],
    inertia.inertia_on_slow_shaft: [(0.9, 20.0, 0.9, flow) for flow in FLOWS],
    inertia.mass_on_motor_shaft: [(8e3, 0.2, 2.0, 40.0, 0.9, "drive")],
    inertia.slewing_inertia: [(5e4, 8.0, 8e4, 2.5, 6e4, 3.0, 9.81)],
    inertia.rotating_parts_coefficient: [
        (0.4, np.array([1.5, 20.0]), np.array([4.0, 5.0]), np.array([0.97, 0.96]), flow) for flow in FLOWS
    ],
    backlash.new_clearance: [(0.25, 2), (0.25, 3), (0.25, 4)],
    backlash.wear_share: [(0.002, 0.008)],
    backlash.worn_clearance: [(4e-4, 0.2, 0.008, False), (4e-4, 0.2, 0.008, True)],
    backlash.clearance_angle: [(4e-4, 0.14, 0.35)],
    backlash.clearance_on_motor_shaft: [(np.array([0.002, 0.003]), np.array([1.0, 4.0]))],
    backlash.gap_closing: [(120.0, 0.02, 1.0, np.inf), (120.0, 0.02, 1.0, 1.0)],
    backlash.backlash_number: [(120.0, 0.02, 5e3, 1.0, 7.0)],
    backlash.backlash_peak_ratio: [(0.7,)],
    backlash.backlash_peak_torque: [(120.0, 0.02, 5e3, 1.0, 7.0, *more) for more in ((40.0, np.inf), (900.0, 1.0))],
    backlash.impact_loss: [(1.0, 7.0, 9.0, 0.4)],
    bodies.solid_cylinder: [(120.0, 0.5)],
    bodies.hollow_cylinder: [(120.0, 0.5, 0.3)],
    bodies.thin_ring: [(120.0, 0.5)],
    bodies.point_mass: [(120.0, 3.0)],
    bodies.parallel_axis: [(9.0, 120.0, 3.0)],
    bodies.rings: [(7850.0, np.array([0.25, 0.2]), np.array([0.2, 0.05]), np.array([0.06, 0.01]))],
    bodies.drum: [(7850.0, 0.52, 0.48, 1.2, 0.02, 0.1)],
    bodies.estimated_body: [(120.0, 0.26, 0.7)],
    bodies.rod_about_end: [(60.0, 3.0)],
    bodies.rod_about_centre: [(60.0, 3.0)],
    bodies.rod_radial: [(60.0, 3.0, 0.5)],
    bodies.rod_parallel: [(60.0, 0.5, 0.1)],
    bodies.rod_inclined: [(60.0, 3.0, 0.6)],
    bodies.inertia_of_gd2: [(15.0, "gyration"), (15.0, "outer_diameter")],
    brake.braking_torque: [(t, 700.0, 0.15, r, shape) for t in (0.1, 0.3, 0.9) for r in (0.0, 0.3) for shape in RISES],
    brake.brake_stop: [
        (3.2, w, 700.0, other, 0.15, r, shape)
        for w in (0.5, 104.0) for other in (-3e3, -300.0, 0.0, 250.0, 900.0) for r in (0.0, 0.3) for shape in RISES
    ],
    brake.brake_torque_for_time: [(3.2, 104.0, t, 250.0, 0.15, 0.3, shape) for t in (0.1, 0.3, 0.9) for shape in RISES],
    brake.uniform_stop_time: [(0.26, 0.16)],
    brake.brake_reserve: [(700.0, 400.0), (700.0, 0.0)],
    brake.stop_heat: [(3.2, 104.0, 250.0, 40.0)],
    buffer.collision_force: [(5e3, 2e3, 6e5, 0.8, w, reading) for w in (4e3, -9e3) for reading in READINGS],
    buffer.collision_force_bound: [(5e3, 2e3, 6e5, 0.8, 4e3)],
    buffer.series_stiffness: [(6e5, 3e5)],
    buffer.linear_buffer: [(5e3, 6e5, 0.8)],
    buffer.constant_force_buffer: [(5e3, 0.15, 0.8)],
    buffer.driven_buffer: [(4e3, 5e3, 6e5, 0.8), (-4e3, 5e3, 6e5, 0.8)],
    buffer.constant_force_stroke: [(4e3, 2e4, 5e3, 0.8), (2e4, 2e4, 5e3, 0.8)],
    buffer.progressive_buffer: [(push, 5e3, 0.8, 6e4, 0.12, p) for push in (4e3, 0.0, -4e3) for p in (0.5, 1.0, 2.5)],
    buffer.speed_left: [(4e3, 5e3, 0.8, 900.0, 0.12), (4e3, 5e3, 0.8, 9e3, 0.12)],
    buffer.collision_mass: [(5e3, 2e3, 0.4)],
    buffer.meeting: [(3e4, 5e4, 0.8, 0.5, 4e3, -1e3)],
    buffer.series_orifice: [(9e3, 4e4)],
    buffer.orifice_buffer_speed: [(0.2, 5e3, 9e3, 0.8, push) for push in (0.0, 4e3, -2e4)],
    buffer.orifice_buffer_force: [(0.2, 5e3, 9e3, 0.8, push) for push in (0.0, 4e3, -4e3)],
    buffer.energy_share: [(np.array([0.0, 3e4, 4e4]), np.array([0.0, 0.05, 0.12]))],
    buffer.orifice_energy_share: [(5e3, 9e3, 0.2)],
    buffer.orifice_buffer_path: [(0.7, 5e3, 9e3, 0.8)],
    buffer.buffer_factor: [(xi, edition) for xi in (0.3, 0.8) for edition in ("line", "two_values")],
    coulomb.coulomb_slide: [
        (100.0, 50.0, p, v, t) for p in (-20.0, 120.0) for v in (-1.0, 0.0, 1.0) for t in (0.7, 9.0)
    ],
    coulomb.coulomb_decay: [(0.0177, 20.0, 31.0, 1e4, 4.0), (-0.3, 20.0, 20.0, 1e4, 4.0)],
    gearing.reverse_efficiency: [(0.85,), (0.4,)],
    gearing.input_torque: [(900.0, w, 40.0, 0.85, 0.8) for w in (-2.0, 0.0, 2.0)],
    gearing.motor_torque: [(a, w, *HOIST, 0.85, 0.8) for a in (-60.0, 60.0) for w in (-1.0, 1.0)],
    gearing.motor_torque_seed_rule: [(a, w, *HOIST, 0.85, 0.8) for a in (-60.0, 60.0) for w in (-1.0, 1.0)],
    gearing.motor_acceleration: [
        (m, w, *HOIST, eta, 2 - 1 / eta) for m in (-900.0, 900.0) for w in (-1.0, 1.0) for eta in (0.4, 0.85)
    ],
    gearing.jams: [(0.9, 4e3, 40.0, -0.5), (0.9, 400.0, 40.0, 0.8)],
    response.free_response: [(5.0, zeta, 0.02, -0.3, 1.7) for zeta in DAMPINGS],
    response.free_speed: [(5.0, zeta, 0.02, -0.3, 1.7) for zeta in DAMPINGS],
    response.decay_envelope: [(5.0, 0.02, 0.3, 1.7)],
    response.sine_response: [(5.0, w, 3.0, t) for w in (0.2, 5.0, 5.001, 9.0) for t in (0.02, 1.7)],
    response.decay_response: [(5.0, zeta, 3.0, 2.0, 1.7) for zeta in DAMPINGS],
    response.pulse_response: [(5.0, zeta, 3.0, 96.0, 2.0, t) for zeta in DAMPINGS for t in (1e-3, 1.7)],
    shock.step_factor: [(0.04,), (1.5,)],
    shock.ramp_factor: [(0.7,)],
    shock.rectangular_pulse_factor: [(0.2,), (0.8,)],
    shock.half_sine_pulse_factor: [(0.2,), (0.8,), (3.3,)],
    shock.impulse_displacement: [(0.7, 2e4, 50.0)],
    shock.impact_force_unloaded: [(500.0, 2e4, 50.0, 0.8)],
    shock.impact_force_preloaded: [(500.0, 2e4, 50.0, 0.8)],
    similarity.scales: MODELS,
    similarity.distortions: MODELS,
    similarity.section_scales: [(0.1, 1.0, 0.02, 2e-4, 1e-3, 0.01, 2e-3)],
    similarity.self_weight_strain: [(7850.0, 9.81, 20.0, 2.1e11, 1.0)],
    threadline.transverse_frequency: [(2.0, 0.9, 2.6, 2400.0, 1.2), (1.0, 0.9, 2.6, 0.0, 0.0)],
    two_mass.two_mass_frequency: [(1.2e6, 18e3, 5e3)],
    two_mass.takeup: [(18e3, 5e3, 1.2e6, p, 5e4, 0.25) for p in (2e4, 5e4, 8e4)] + [(18e3, 5e3, 1.2e6, 2e4, 5e4, 0.01)],
    two_mass.hanging_start_force: [(8e4, 5e4, 18e3, 5e3)],
    two_mass.speed_step_force: [(0.25, 1.2e6, 5e3, 5e4)],
    two_mass.lowering_brake_force: [(8e4, 5e4, 0.18, 18e3, 5e3, 1.2e6)],
    two_mass.hoisting_stop_force: [(0.25, 8e4, 5e4, 18e3, 5e3, 1.2e6), (9.0, 8e4, 5e4, 18e3, 5e3, 1.2e6)],
    vibration.natural_frequency: [(8e5, 2e3)],
    vibration.damping_ratio: [(3e3, 8e5, 2e3)],
    vibration.damping_ratio_of_decrement: [(0.25,)],
    vibration.decrement_of_damping_ratio: [(0.04,), (1.5,)],
    vibration.damping_of_decrement: [(0.25, 2e3, 0.31)],
    vibration.damped_frequency: [(20.0, 0.04), (20.0, 1.5)],
    vibration.amplification: [(0.8, 0.04), (1.3, 0.0)],
    vibration.phase_lag: [(0.8, 0.04), (1.3, 0.0)],
    vibration.resonance_ratio: [(0.04,), (0.9,)],
    vibration.peak_amplification: [(0.04,), (0.9,)],
    vibration.transmissibility: [(0.8, 0.04), (1.3, 0.0)],
    vibration.unbalance_amplification: [(0.8, 0.04), (1.3, 0.0)],
    loop_bounds.mass_behind: SECTIONS,
    loop_bounds.quasi_static: SECTIONS,
    loop_bounds.tension_green: SECTIONS,
    loop_bounds.stray: SECTIONS,
    loop_bounds.give: SECTIONS,
    loop_bounds.speed_stray: SECTIONS,
    loop_bounds.held_swing: [(*section, 37.0) for section in SECTIONS],
    loop_bounds.energy_of_rates: [(loop, share) for loop in LOOPS for share in (0.0, 0.3, 1.0)],
    loop_bounds.lowest_frequency_bound: [(loop,) for loop in LOOPS],
    loop_bounds.drive_lead: [(loop, 0.4) for loop in LOOPS],
    loop_bounds.window_leak: [(3.0, 2.5), (0.1, 2.5)],
    held_strands.quasi_static: HELD_SECTIONS,
    held_strands.tension_green: HELD_SECTIONS,
    held_strands.stray: HELD_SECTIONS,
    held_strands.lowest_frequency: [(loop,) for loop in HELD],
    held_strands.natural_frequencies: [(loop, 5) for loop in HELD],
    held_strands.modal_tensions: HELD_MODES,
    held_strands.modal_shapes: HELD_MODES,
    held_strands.modal_rest: HELD_MODES,
    held_strands.all_frequencies: [(loop, 5) for loop in HELD if not loop.imposed_speed],
    held_strands.drive_mobilities: [
        (loop, held_strands.natural_frequencies(loop, 3)) for loop in HELD if not loop.imposed_speed
    ],
    held_strands.swung_mass: HELD_SECTIONS,
    pendulum.swing_frequency: [(7.0, 9.81)],
    pendulum.swing_period: [(7.0, 9.81, 0.0), (7.0, 9.81, 1.2)],
    pendulum.driven_frequency: [(7.0, 9.81, 5e3, 2e3)],
    pendulum.steady_lean: [(0.4, 9.81)],
    pendulum.largest_lean: [(0.4, 9.81)],
    pendulum.swing_force: [(5e3, 0.4, 9.81), (5e3, 9.0, 9.81)],
    pendulum.driven_slow_down: [(0.4, 1.2, 0.7)],
    pendulum.ramp_residual: [(0.4, 9.81, 1.2, 3.0)],
    pendulum.ramp_swing: [(0.4, 9.81, 7.0, t) for t in (0.3, 2.0, 4.0, 9.0)],
    pendulum.start_stop_residual: [(0.7, 9.81, 1.2, 3.0, 4.0, 2.0), (0.7, 9.81, 1.2, 7.0, 0.0, 2.0)],
    pendulum.cancelling_ramp: [(1.3, 0.2, 5.3), (1.3, 9.0, 5.3)],
    pendulum.hoisted_angle: [(0.1, 12.0, 3.0)],
    pendulum.hoisted_angle_bounds: [(0.1, 12.0, 3.0, -0.6, 9.81)],
    pendulum.slewing_lean: [(0.2, 12.0, 8.0, 9.81), (2.0, 0.0, 8.0, 9.81)],
    pendulum.small_angle_error: [(0.1, 6.0, 0.1), (0.9, 60.0, 1.0)],
    motor.mean_starting_torque: [(900.0, 500.0)],
    motor.rim_force: [(700.0, 20.0, 0.94, 0.4)],
    motor.rated_torque: [(22e3, 150.0)],
    motor.linear_torque: [(90.0, 400.0, 150.0)],
    motor.slip: [(90.0, 157.0), (200.0, 157.0)],
    motor.breakdown_slip: [(0.04, 2.3, 0.0), (0.04, 2.3, 1.5)],
    motor.largest_stator_ratio: [(0.04, 2.3)],
    motor.kloss: [(0.1, 400.0, 0.17, 0.0), (-0.3, 400.0, 0.17, 1.5), (2.0, 400.0, 0.17, 1.5)],
    motor.kloss_slope: [(0.1, 400.0, 0.17, 0.0), (-0.3, 400.0, 0.17, 1.5), (2.0, 400.0, 0.17, 1.5)],
    motor.kloss_slip: [(200.0, 400.0, 0.17, 0.0), (-200.0, 400.0, 0.17, 1.5)],
    motor.mean_kloss_torque: [(1.0, 0.03, 400.0, 0.17, 1.5), (0.3, 0.3, 400.0, 0.17, 0.0)],
    motor.stage_breakdown_slip: [(0.17, 4.0)],
    motor.switching_speed: [(4.0, 0.05, 157.0)],
    motor.rheostat_factors: [(0.1, 0.04)],
    motor.converter_reference: [(1.3, 120.0, 4.0), (5.0, 120.0, 4.0), (1.3, 120.0, 0.0)],
    motor.converter_torque: [(90.0, 100.0, 30.0, 400.0), (10.0, 100.0, 30.0, 400.0)],
    duty.rms_torque: [(np.array([400.0, 150.0, 0.0]), np.array([2.0, 9.0, 30.0]), np.array([0.7, 1.0, 0.33]))],
    duty.equivalent_torque: [
        (np.array([400.0, 150.0]), np.array([300.0, -90.0]), np.array([2.0, 9.0]), 1.0),
        (np.array([0.0]), np.array([0.0]), np.array([9.0]), 1.0),
    ],
    duty.duty_factor: [(4.0, 6.0)],
    duty.permissible_torque: [(400.0, 0.4, 0.25, 0.0, 1.0), (400.0, 1.0, 0.25, 0.5, 0.33)],
    duty.switching_heat: [(1.3, 157.0, 1.0, 0.0, 1.2, 0.4)],
    duty.permissible_switching_rate: [(900.0, 500.0, 0.25, 0.33, 2e4), (900.0, 2500.0, 0.9, 0.33, 2e4)],
    duty.load_factor: [(0.6, 0.4, 0.5), (1.2, 0.4, 0.5)],
    resistance.main_resistance_per_length: [(0.022, 9.81, 180.0, 15.0, 0.97)],
    resistance.length_factor: [(430.0,)],
    quotient.over: [(3.0, 2.0), (3.0, 0.0)],
    sag.sag_ratio: [(900.0, 5e4), (900.0, -1.0)],
    sag.tension_at_sag: [(900.0, 0.015)],
    sag.softening: [(1.2e8, 900.0, 5e4), (1.2e8, 900.0, 0.0)],
    start_profile.rise: [(shape, 4.0, t) for shape in (*SHAPES, POINTS) for t in (0.0, 1.3, 9.0)],
    start_profile.rise_integral: [(shape, 4.0, t) for shape in (*SHAPES, POINTS) for t in (0.0, 1.3, 9.0)],
    start_profile.time_of_share: [(shape, 4.0, q) for shape in (*SHAPES, POINTS) for q in (-0.4, 0.2, 0.7)],
    start_profile.time_to_momentum: [(shape, 4.0, 9e3, 5e3, 2.0, 7e4) for shape in (*SHAPES, POINTS)],
    start_profile.rise_rate: [(shape, 4.0, t) for shape in (*SHAPES[1:], POINTS) for t in (1.3, 9.0)],
    start_profile.peak_rate: [("ramp", 4.0), ("cosine", 4.0), ("parabolic", 4.0), (POINTS, 4.0)],
    start_profile.residual: [(shape, 4.0, 3.0) for shape in (*SHAPES, POINTS)],
    start_profile.phases: [
        ("step", False, 4.0, 3.0), ("ramp", False, 4.0, 3.0), ("cosine", False, 4.0, 3.0), ("ramp", True, 4.0, 3.0),
        ("cosine", True, 4.0, 3.0), ("cosine", True, 0.5, 3.0), ("parabolic", False, 4.0, 3.0),
        ("parabolic", True, 4.0, 3.0), (POINTS, False, 4.0, 3.0), (POINTS, True, 4.0, 3.0),
    ],
    shaft.acceleration: [(90.0, 30.0, -8.0, 12.0)],
    shaft.torque_of_motion: [(30.0, -8.0, 12.0, 3.0)],
    shaft.speed_after_work: [(30.0, 12.0, -900.0, 34.0), (30.0, 12.0, -9e3, 34.0)],
    shaft.gear_factor: [(5.0, 0.2, 30.0, 12.0, 90.0, 0.94, 0.9), (-50.0, 0.2, 30.0, 12.0, 90.0, 0.94, 0.9)],
    shaft.irregularity: [(13.6, 12.3), (0.0, 0.0)],
    shaft.flywheel_inertia: [(1060.0, 0.02, 13.0, 34.0), (10.0, 0.02, 13.0, 34.0)],
    shaft.cycle_efficiency: [(1400.0, 220.0), (0.0, 0.0)],
    shaft.loss_factor: [(1400.0, 220.0), (0.0, 0.0)],
    shaft.inertia_criterion: [(8.0, 12.0, 260.0), (8.0, 12.0, 0.0), (0.0, 12.0, 0.0)],
    shaft.slope_criterion: [(0.48, 820.0, 34.0)],
    shaft.run_out_angle: [(30.0, 12.0, 335.0), (30.0, 12.0, 0.0)],
    shaft.run_out_time: [(30.0, 12.0, 335.0), (30.0, 12.0, 0.0)],
    shaft.brake_torque_for_angle: [(30.0, 12.0, 6.8, 35.0), (30.0, 12.0, 6.8, 900.0)],
    shaft.recoverable_energy: [(2280.0, 240.0, 0.94)],
    shaft.braked_stop: [
        (30.0, 12.0, 35.0, 2.0, 300.0, 0.1, 0.2), (30.0, 12.0, 35.0, 0.0, 300.0, 0.1, 0.0),
        (30.0, 12.0, 35.0, 9.0, 300.0, 0.1, 9.0), (30.0, 12.0, 350.0, 9.0, 300.0, 9.0, 9.0),
        (30.0, 12.0, -35.0, 1.0, 300.0, 0.1, 0.2), (30.0, 12.0, 0.0, 1.0, 0.0, 0.1, 0.2),
    ],
    slider_crank.slider_position: [(1.1, *CRANK)],
    slider_crank.slider_velocity: [(1.1, *CRANK)],
    slider_crank.dead_centre: [(*CRANK, True), (*CRANK, False)],
    slider_crank.crank_angles: [(0.45, *CRANK)],
    slider_crank.reduced_inertia: [(1.1, *CRANK, 180.0, 35.0, 0.3, 0.6)],
    slider_crank.reduced_inertia_slope: [(1.1, *CRANK, 180.0, 35.0, 0.3, 0.6)],
    slider_crank.rod_centre_height: [(1.1, *CRANK, 0.3, 1.2)],
    slider_crank.rod_centre_lift: [(1.1, *CRANK, 0.3, 1.2)],
    wave.wave_speed: [(1.2e8, 70.0)],
    wave.impedance: [(1.2e8, 70.0)],
    wave.reflection: [(9e4, 4e4)],
    wave.first_wave_time: [(1.3, 0.5)],
    wave.first_wave_force: [(5e4, 9e4, 4e4, 0.7)],
    wave.first_wave_speed: [(5e4, 9e4, 4e4, 0.7), (5e4, 0.0, 4e4, 0.7)],
    wave.first_wave_peak: [(5e4, 9e4, 4e4, 0.7)],
    wave.two_interval_force: [(5e4, 2.0, 0.6, t) for t in (0.7, 3.1)],
    wave.two_interval_peak: [(5e4, 2.0, 0.6, t) for t in (0.7, 3.9)],
    strand_tension.section_pull: [(300.0, h, 18.0, 160.0, 20.0, 0.022, 9.81) for h in (-20.0, 0.0, 20.0)],
    strand_tension.load_pull: [(300.0, h, 160.0, 0.022, 9.81) for h in (-20.0, 0.0, 20.0)],
    strand_tension.strand_tensions: [(3e4, np.array([4e3, -900.0, 7e3]))],
    strand_tension.tension_extremes: [(np.array([4e3, -900.0, 7e3]),)],
    strand_tension.worst_loading: [(np.array([4e3, -900.0, 7e3]), sense) for sense in ("most", "least")],
    strand_tension.worst_stretch: [(np.array([4e3, -900.0, 7e3]), sense) for sense in ("most", "least")],
    strand_tension.slope_loading: [(np.array([4.0, -9.0, 7.0]), sense) for sense in ("most", "least")],
    strand_tension.loading_envelope: [(3e4, np.array([4e3, -900.0]), np.array([-4e3, 900.0]))],
    belt_resistance.secondary_resistance: [(4e4, 430.0)],
    belt_resistance.loading_resistance: [(300.0, 3.5, 0.8), (300.0, 2.0, 3.0)],
    belt_resistance.acceleration_length: [(3.5, 0.8, 0.6, 9.81), (2.0, 3.0, 0.6, 9.81)],
    belt_resistance.skirt_resistance: [(500.0, 900.0, 2.5, 0.8, 4.0, 0.6, 9.81)],
    belt_resistance.scraper_resistance: [(0.012, 5e4, 0.6)],
    belt_resistance.wrap_resistance: [(1.2, 9e4, 0.018, 0.8, 1260.0, 0.09)],
    belt_resistance.bearing_resistance: [(8e4, 0.14, 0.8, 0.005)],
    belt_resistance.idler_tilt_resistance: [(0.4, 0.35, 100.0, 150.0, 9.81, 0.97, 0.03)],
    belt_resistance.effective_tension: [(3e4, 1.2, 2e3, -5e4)],
    belt_resistance.shaft_power: [(3e4, 2.5), (-3e4, 2.5)],
    belt_resistance.motor_power: [(9e4, 0.9), (-9e4, 0.9)],
    belt_resistance.cycle_time: [(2030.0, 3.5)],
    belt_resistance.takeup_travel: [(2030.0, 9e4, 3e4, 1.2e7, 0.004, 2)],
    belt_resistance.mean_tension: [(np.array([400.0, 900.0]), np.array([3e4, 8e4, 9e4]))],
    belt_resistance.takeup_mass: [(3e4, 2, 9.81)],
    belt_resistance.cema_idler_resistance: [(15.0, 130.0, 9.81, 6.7, 1.2)],
    belt_resistance.cema_effective_tension: [(600.0, 20.0, 15.0, 130.0, 9.81, 1.0, 6.5, 0.024, 3e3)],
    belt_section.usable_width: [(0.8,), (2.4,)],
    belt_section.water_section: [(0.9, 0.38, 0.6), (0.3, 0.38, 0.6)],
    belt_section.surcharge_section: [(0.9, 0.38, 0.6, 0.3), (0.3, 0.38, 0.6, 0.3)],
    belt_section.triangle_surcharge_section: [(0.9, 0.38, 0.6, 0.3)],
    belt_section.standard_edge_width: [(1.2,)],
    belt_section.arc_surcharge_section: [(0.9, 0.38, 0.6, 0.3), (0.9, 0.38, 0.6, 1e-4)],
    belt_splice.splice_reserve: [(2e6, 0.45, 4e5, 1.1, 1.7), (2e6, 0.45, 0.0, 1.1, 1.7)],
    idler_roll.roll_speed: [(4.0, 0.133)],
    idler_roll.roll_load: [(0.67, 1.5e3, 1.2, 400.0, 60.0)],
    idler_roll.bearing_life: [(25e3, 2e3, 60.0)],
    belt_section.slope_reduction: [(0.1, 0.3), (0.4, 0.3)],
    belt_section.capacity: [(0.17, 3.2, 850.0)],
    belt_section.load_line_mass: [(300.0, 3.2)],
    belt_section.fill_share: [(300.0, 400.0), (300.0, 0.0)],
    belt_section.belt_safety: [(1.25e6, 1.0, 1.3e5), (1.25e6, 1.0, -1.0)],
    belt_section.minimum_pulley_diameter: [("polyester", 0.006)],
    belt_section.transition_strains: [(3.0, 0.4, 0.38, 0.7, 0.05)],
    belt_section.transition_length: [(0.002, 0.4, 0.38, 0.7, 0.05), (0.002, 0.4, 0.38, 0.7, 0.5)],
    horizontal_curve.inward_force: [(6e4, 20.0, 4.0, 1500.0)],
    horizontal_curve.bed_width: [(0.46, 0.6, 0.12, 0.26), (0.46, 0.6, 0.005, 0.26), (0.46, 0.6, 0.12, 0.0)],
    horizontal_curve.drift: [
        (1.2, 0.46, 0.6, beta, 200.0, load, area, 0.26, pull, 2.0, rule)
        for beta, pull in ((0.08, 40.0), (0.0, -3.0), (0.2, 900.0))
        for load, area in ((0.0, 0.0), (1800.0, 0.12), (60.0, 0.004))
        for rule in horizontal_curve.RULES
    ],
    horizontal_curve.edge_strain: [(0.46, 0.37, 0.6, 1500.0)],
    vertical_curve.lift_off_radius: [(6e4, 22.0, 5.0, 9.81, 0.98), (100.0, 22.0, 5.0, 9.81, 0.98)],
    vertical_curve.lift_off_tension: [(250.0, 22.0, 5.0, 9.81, 0.98)],
    vertical_curve.idler_line_load: [(6e4, 250.0, 22.0, 5.0, 9.81, 0.98, convex) for convex in (False, True)],
    vertical_curve.idler_radius: [(9e4, 180.0, 9.81, 0.98, spacing, 3e3) for spacing in (0.8, 2.0)],
    vertical_curve.trough_heights: [(0.4, 0.38, 0.7)],
    vertical_curve.radius_for_largest: [(9e4, 1.2, 2e7, 0.1, 2e5), (9e4, 1.2, 2e7, 0.1, 2e4)],
    vertical_curve.radius_for_least: [(9e4, 1.2, 2e7, 0.1, 3e4), (9e4, 1.2, 2e7, 0.1, 2e5)],
    stopping.moving_resistance: [(60.0, beta, 150.0, 80.0, 0.05, 9.81) for beta in (-0.2, 0.2)],
    stopping.rollback_force: [(60.0, beta, 150.0, 80.0, 0.05, 9.81) for beta in (-0.2, 0.2)],
    stopping.critical_coefficient: [(0.2, 150.0, 80.0)],
    stopping.backstop_torque: [(9e3, 0.65, 1.5), (-9e3, 0.65, 1.5)],
    stopping.torque_on_motor_shaft: [(5e3, 40.0, 0.9)],
    stopping.brake_torque_for_distance: [
        (19e3, w, 0.5, s, 0.65, 40.0, 0.9, 0.35, form)
        for w in (-9e3, 28e3) for s in (0.1, 0.3) for form in ("signed", "notes")
    ],
    stopping.stopping_distance: [
        (19e3, w, 0.5, torque, 0.65, 40.0, 0.9, 0.35) for w in (-9e3, 28e3) for torque in (0.0, 300.0)
    ],
    stopping.braking_force: [(19e3, 0.5, 0.1)],
    stopping.fixed_loop_braking: [(14e3, 5e3, 1.25)],
    stopping.coasting: [(19e3, w, b, 0.5) for w in (-9e3, 0.0, 28e3) for b in (0.0, 50.0, 9e4)],
    stopping.coast_down_coefficient: [(19e3, 9e2, 2e5, 1.1, 1.8, 4.0, 0.02, 0.05)],
    slip_heat.slip_heat: [(np.array([0.0, 0.3, 1.0]), *np.array([[9e3, 8e3, 5e3], [3.0, 4.0, 3.5], [0.0, 1.0, 3.5]]))],
    slip_heat.slip_heat_of_linear_change: [(1.3, 9e3, 7e3, 3.0, 0.5)],
    slip_heat.slip_distance: [(np.array([0.0, 0.3, 1.0]), np.array([3.0, 4.0, 3.5]), np.array([0.0, 1.0, 6.0]))],
    slip_heat.temperature_rise: [(4e6, 14.0, 1700.0)],
    slip_heat.largest_drum_forces: [(6e4, 0.9, 1.1)],
    slip_heat.best_share: [(0.9, 1.1)],
    slip_heat.drum_forces_in_slip: [
        (force, share, 6e4, 0.9, 1.1, sharing)
        for force in (1e5, 3e5, 9e5) for share in (0.2, 0.67, 0.95) for sharing in (False, True)
    ],
    belt_modes.natural_frequencies: [(loop, mass, 4) for loop in LOOPS for mass in (0.0, 900.0)],
    belt_modes.natural_frequencies_of_lengths: [
        (loop, np.array([300.0, 150.0]), np.array([1e-6, 2e-6]), *np.array([[200.0, 900.0], [2e-6, 1e-6]]), mass, 3)
        for loop in LOOPS for mass in (0.0, 900.0)
    ],
    belt_modes.modes_below: [(loop, mass, w) for loop in LOOPS for mass in (0.0, 900.0) for w in (1.7, 23.0, 91.0)],
    belt_modes.modal_damping: [(3.0, 0.02, 12.0, 180.0)],
    sprocket.pitch_radius: [(0.32, 8)],
    sprocket.sprocket_speed: [(0.5, 0.32, 8)],
    sprocket.speed_extremes: [(0.5, 8)],
    sprocket.speed_ripple: [(8, "largest"), (8, "mean")],
    sprocket.pitch_fraction: [(1.1, 0.32)],
    sprocket.transverse_speed: [(0.5, 8)],
    sprocket.transverse_travel: [(0.32, 8)],
    sprocket.engagement_speed: [(0.5, 8, "translating"), (0.5, 8, "guided")],
    sprocket.engagement_energy: [(9.0, 0.4, 0.8)],
    polygon.peak_acceleration: [(0.5, 0.32, 8)],
    polygon.polygon_displacement: [(0.3, 0.32, 8), (0.7, 0.32, 8)],
    polygon.polygon_speed: [(0.3, 0.5, 8), (0.7, 0.5, 8)],
    polygon.polygon_acceleration: [(0.3, 0.5, 0.32, 8), (0.7, 0.5, 0.32, 8)],
    polygon.ramped_acceleration: [(0.2, 1.3, 0.4, 0.32, 8)],
    polygon.engagement_times: [(1.3, 0.4, 8, 5), (0.0, 0.4, 8, 5), (1.3, -0.1, 8, 5)],
    polygon.acceleration_harmonics: [(np.array([1.0, 2.0, 7.0]), 0.5, 0.32, 8)],
    polygon.harmonic_tail: [(100, 2.0, 0.5, 0.32, 8)],
    polygon.return_share: [(20.0,), (40.0,), (80.0,)],
    polygon.nearest_threshold: [(20.0,), (50.0,)],
    polygon.textbook_mass: [(120.0, 80.0, 40.0, 1.5)],
    polygon.textbook_polygon_force: [(9600.0, 0.24)],
    equalising.equalising_angle: [(0.3, 6)],
    equalising.equalising_speed: [(0.3, 0.8, 0.4, 6)],
    equalising.equalising_ratio: [(6,)],
    equalising.equalising_acceleration: [(0.8, 0.4, 6)],
    chain_resonance.start_shares: [(loop, np.array([31.0, 74.0])) for loop in (LOOPS[0], LOOPS[2])],
    chain_resonance.drive_mobilities: [(loop, np.array([31.0, 74.0])) for loop in (LOOPS[0], LOOPS[2])],
    chain_resonance.modal_tensions: [
        (loop, np.array([31.0, 74.0]), strand, np.array([0.0, 0.3])) for loop in LOOPS for strand in (RETURN, CARRY)
    ],
    chain_resonance.modal_shapes: [
        (loop, np.array([31.0, 74.0]), strand, np.array([0.0, 0.3])) for loop in LOOPS for strand in (RETURN, CARRY)
    ],
    chain_resonance.modal_rest: [
        (loop, belt_modes.natural_frequencies(loop, 0.0, 2), strand, np.array([0.0, 0.3]))
        for loop in LOOPS
        for strand in (RETURN, CARRY)
    ],
    chain_resonance.modal_masses: [
        (loop, np.array([31.0, 74.0])) for loop in (LOOPS[1], LOOPS[3])
    ],
    chain_resonance.resonance_speeds: [(np.array([31.0, 74.0]), np.array([1.0, 2.0, 3.0]), 0.32)],
    chain_resonance.resonance_weights: [
        (np.array([1.0, 2.0]), np.array([0.01, 0.0]), np.array([0.7, 0.2])),
    ],
    chain_resonance.exclusion_half_widths: [(np.array([0.01, 0.2]), 0.15)],
    chain_resonance.exclusion_bands: [(np.array([1.0, 0.5, 0.9]), np.array([0.15, 0.15, 0.15]))],
    chain_resonance.safe_windows: [(np.array([[0.4, 0.6], [0.9, 1.1]]), 0.1, 1.0)],
    chain_resonance.nearest_safe_speeds: [
        (speed, np.array([[0.4, 0.6], [0.9, 1.1]])) for speed in (0.5, 0.7)
    ],
    chain_resonance.transverse_frequencies: [(0.9, 4e3, 3.8, 2.0, 1)],
    chain_resonance.textbook_resonance_speed: [(3500.0, 0.32, 40.0, 16e-4, 1962.0)],
    chain_resonance.textbook_resonance_factor: [(2.06e11, 9.81, wave) for wave in ("quarter", "half", "full")],
    chain_resonance.textbook_resonance_modulus: [(3500.0, 9.81, wave) for wave in ("quarter", "half", "full")],
    chain_start.start_acceleration: [(160.0, 90.0, 3.4)],
    chain_start.start_time: [(160.0, 90.0, 3.4, 102.0), (80.0, 90.0, 3.4, 102.0)],
    chain_start.start_force: [(42e3, 20.0, 0.325, 40.0)],
    chain_start.start_series: [
        (np.array([8e3, 1e3]), np.array([30.0, 90.0]), np.array(zeta), 0.07)
        for zeta in ([0.0, 0.0], [0.1, 0.3], [1.0, 3.0])
    ],
    chain_start.start_series_tail: [(np.array([8e3, 1e3]), 1e4)],
    chain_start.rigid_acceleration: [
        (160.0, 0.35, 40.0, 0.9, 0.325, 42e3, 9e3),
        (0.0, 0.35, 40.0, 0.9, 0.325, 42e3, -9e3),
    ],
    chain_start.passing_bound: [
        (np.array([30.0, 90.0]), np.array([0.02, 1.3]), 1.2, 0.3, 0.32, 8, passes) for passes in (1.0, 40.0, math.inf)
    ],
    chain_selection.application_factor: [("smooth", "heavy"), ("moderate", "smooth")],
    chain_selection.tooth_factor: [(17, 1.08, 19)],
    chain_selection.design_power: [(9e3, 1.4, 1.1, 1.7)],
    chain_selection.chain_pitches: [(0.7, 0.019, 19, 57)],
    chain_selection.even_pitches: [(113.2,)],
    chain_selection.centre_distance: [(114.0, 0.019, 19, 57)],
    chain_selection.wrap_angle: [(0.7, 0.06, 0.17)],
    chain_selection.centrifugal_force: [(3.8, 2.0)],
    chain_selection.chain_safety: [(5e5, 4e4, 1.2), (5e5, 0.0, 1.2)],
    chain_selection.articulation_pressure: [(4e3, 0.008, 0.02)],
    chain_selection.shaft_load: [(4e3, 300.0, 2.9)],
    chain_selection.lubrication: [(0.019, speed) for speed in (0.5, 5.0, 15.0)],
    chain_wear.sprocket_path: [(0.03, 8)],
    chain_wear.guide_path: [(0.03, 0.32, 2.0)],
    chain_wear.contact_time: [(0.32, 0.5)],
    chain_wear.wear_per_revolution: [
        (*np.array([[6e4, 1.4e4], [8e3, 1.5e4], [0.012, 0.012], [0.64, 0.64], [2e-12, 3e-12]]), form)
        for form in ("sum", "mean")
    ],
    chain_wear.archard_wear: [
        (*np.array([[6e4, 1.4e4], [8e3, 1.5e4], [0.012, 0.012]]), 2e-3, 1e-15, 1e7, m) for m in (1.0, 1.5)
    ],
    chain_wear.allowed_growth: [(0.32, 0.04)],
    chain_wear.chain_life: [(0.0128, 2e-9, 82.0, 0.5), (0.0128, 0.0, 82.0, 0.5)],
    chain_fatigue.revolutions: [(1e8, 82.0, 0.5)],
    chain_fatigue.tooth_passes: [(1e8, 0.32, 0.5)],
    chain_fatigue.stress_amplitude: [(7e4, 8e3, 16e-4)],
    chain_fatigue.fatigue_utilisation: [(2e7, 2.5e7, 9e7, 6e8), (2e7, 2.5e7, 9e7, np.inf)],
    carriage.roller_reaction: [(1.2e4, 1.2, 1.03), (-9e3, 1.2, 1.0)],
    carriage.roller_coefficient: [(0.015, 0.05, 5e-4, 0.16)],
    carriage.guide_resistance: [(9e3, 0.011)],
    carriage.jamming_ratio: [(-1.2e4, 1.5e4, 1.2, 0.3)],
    carriage.rope_pull: [(1.5e4, 1.03, w, 2, 0.97, up) for w in (200.0, 9e4) for up in (True, False)],
    carriage.sheave_of_tackle: [(2, 0.97), (1, 0.97), (4, 0.2)],
    overturning.holding_moment: [(np.array([3e4, 1e4]), np.array([1.2, -0.4]))],
    overturning.tipping_moment: [(4e4, 6e3, 0.5, 9e3, 0.4)],
    overturning.stability_reserve: [(m, t) for m in (9e4, -2e3, 0.0) for t in (4e4, 0.0)],
    reeving.tackle_efficiency: [(4, 0.98), (1, 0.98)],
    reeving.lowering_tackle_efficiency: [(4, 0.98), (1, 0.98)],
    reeving.fall_pulls: [(5e4, falls, 0.98, 400.0, up) for falls in (1, 4, 5) for up in (True, False)],
    reeving.rope_speed: [(0.1, 4, 2)],
    reeving.rope_between_drum_and_end: [(12.0, 4, 2, 3.0)],
    wire_rope.metallic_area: [(0.0175, 0.5)],
    wire_rope.hook_stiffness: [(1.05e11, 1.14e-4, 4, 2, 27.0)],
    wire_rope.rope_safety: [(9e4, 1.3e4), (9e4, 0.0)],
    rope_life.diameter_factor: [(0.02,)],
    rope_life.length_factor: [(12.0, 0.016), (0.1, 0.016)],
    rope_life.bending_number: [(2.5e4, 0.016, 22.0, 1.96e9, BENDING, 0.8), (0.0, 0.016, 22.0, 1.96e9, BENDING, 0.8)],
    rope_life.reversed_number: [(9e4, 9.026, 0.618), (10.0, 9.026, 0.618)],
    rope_life.wire_breaks: [(2.5e4, 0.016, 22.0, rope) for rope in ("FC-8x19", "34x7")],
    rope_life.discard_force: [(0.016, 22.0, "FC-8x19", wires) for wires in (8.0, 40.0)],
    rope_proof.static_resistance: [(22.0,), (11.2,), (5.0,)],
    rope_proof.history: [(np.array([0.3, 0.7]), np.array([1.0, 0.4]), 3e5, 5e5)],
    rope_proof.fatigue_resistance: [(1.6e5, 0.9, 7.0, 0.2), (1.6e5, 0.9, 7.0, 0.0)],
    drum_shell.yield_strength: [("S355", 0.02), ("S235", 0.05)],
    drum_shell.layer_pressures: [(5, 0.144)],
    drum_shell.pull_left: [(5, 0.144), (1, 0.144)],
    drum_shell.edge_of_winding: [(np.array([0.0, 0.7, 2.0]),)],
    drum_shell.single_wrap: [(4e4, 0.19, 0.02)],
    drum_shell.equivalent_stress: [(np.array([3e7, -2e7]), np.array([-9e7, -8e7]), 5e6)],
    drum_shell.flange_loads: [(np.array([1e6, 5e5]), np.array([0.2, 0.22, 0.25]), 0.2)],
    rope_drum.layer_step: [(0.0175, 0.0195, packing) for packing in PACKINGS],
    rope_drum.layer_radius: [(0.3, 0.0175, 0.0152, 3)],
    rope_drum.turns_in_layer: [(30.0, packing, 2) for packing in PACKINGS],
    rope_drum.drum_capacity: [(0.3, 0.0175, 30.0, 5, 0.0152, packing) for packing in PACKINGS],
    rope_drum.length_below: [(5.0, 0.3, 0.0175, 30.0, 0.0152, packing) for packing in PACKINGS],
    rope_drum.turns_for_length: [(length, 0.3, 0.0175, 30.0, 0.0152, p) for length in (9.0, 163.0) for p in PACKINGS],
    rope_drum.drum_length_required: [(163.0, 0.3, 0.0175, 0.0195, 5, 0.0152, packing) for packing in PACKINGS],
    rope_drum.fleet_angle: [(0.5, 0.05, 6.0)],
    rope_drum.hoop_stress: [(1.3e4, 0.0195, 0.012, 1.75)],
    rope_drum.layer_factor: [(1,), (2,)],
    hoisting.drum_torque: [(1.3e4, 2, 0.16)],
    hoisting.hoisting_torque: [(4e3, 40.0, 0.9)],
    hoisting.lowering_torque: [(4e3, 40.0, 0.9), (4e3, 40.0, -0.2)],
    hoisting.sinking_acceleration: [
        (4e3, brake, 0.5, 130.0, 40.0, eta, 2 - 1 / eta) for brake in (60.0, 120.0) for eta in (0.9, 0.45)
    ],
    hoisting.speed_after_drop: [(0.6, 12.0)],
    hoisting.hoist_start_time: [
        (mean, 4e3, 0.5, 130.0, 101.0, 40.0, 0.9, 0.89, up) for mean in (90.0, 200.0) for up in (True, False)
    ],
    hoisting.load_frequency: [(4e6, 12850.0, kb, mb) for kb in (6e6, np.inf) for mb in (0.0, 6500.0)],
    slewing.fatigue_torque: [(np.array([0.4, 0.5, 0.1]), np.array([1e4, 3e3, 8e3]), 3.0)],
    slewing.uniform_start_time: [(6.5e4, 0.21, 1e4, 3e3), (6.5e4, 0.21, 3e3, 1e4)],
    slewing.torque_for_start: [(6.5e4, 0.21, 8.0, 3e3)],
    slewing.geared_stop: [
        (6e4, 6.5e3, 0.7, back, 0.21, on_motor, on_crane, against, 0.2, rise)
        for back in (0.57, -0.2, 0.0)
        for on_motor, on_crane in ((5e3, 0.0), (0.0, 6e3))
        for against in (1e3, -2e3)
        for rise in (0.0, 0.4)
    ],
    slewing.swing_reach: [(4e4, 1e3, 5.0, 6.0, 0.21, 9.81), (4e4, 1e3, 5.0, 6.0, 9.0, 9.81)],
    slewing.momentum_range: [(4e4, 1e3, 5.2, 0.21)],
    classification.spectrum_factor: [(np.array([0.2, 0.3, 0.5]), np.array([1.0, 0.6, 0.3]), 3.0)],
    classification.equivalent_load: [(0.28, 3.0)],
    classification.use_of_cycles: [(1e5,)],
    classification.use_of_hours: [(5e3,)],
    classification.load_class: [(0.28,), (1.0,)],
    classification.load_class_en_13001: [(0.28,), (0.01,)],
    classification.group: [(3, 3)],
    hoist_class.rope_safety_of_group: [("M5", layers, hot) for layers in (1, 3) for hot in (True, False)],
    lift_off.speed_source_factor: [(0.25, 0.04, 9.81)],
    lift_off.elasticity_number: [(0.4, 8e4, 5e4, 18e3, 5e3, 1.2e6), (0.0, 8e4, 5e4, 18e3, 5e3, 1.2e6)],
    lift_off.drive_mass_number: [(8e4, 5e4, 18e3, 5e3, 1.2e6, v) for v in (0.0, 0.25, 9.0)],
    lift_off.motor_slope_number: [(6e5, 1.2e6, 18e3, 5e3)],
    lift_off.structure_number: [(1.2e6, 5e6, 9e3, 5e3)],
    lift_off.held_swing_force: [(4e4, 5e4, -0.2, 1.2e6, 5e3)],
    lift_off.release_factor: [(0.4, 0.5)],
    lift_off_standard.stiffness_class: [(x,) for x in (0.9, 0.4, 0.2, 0.1)],
    lift_off_standard.class_lift_off_speed: [
        (f"HD{k}", combination, 0.4, 0.1, "filled") for k in range(1, 6) for combination in ("regular", "exceptional")
    ],
    lift_off_standard.fem_lift_off_factor: [("bridge", 0.1), ("bridge", 0.5), ("jib", 2.0)],
    lift_off_standard.standard_lift_off_factor: [
        (f"HC{k}", drive, 0.25, edition)
        for k in range(1, 5) for edition in ("by_class", "by_drive", "raised") for drive in ("HD1", "HD3")
    ],
    rope_rod.rod_root: [(0.06, 1), (9.0, 3), (0.0, 2)],
    rope_rod.rod_frequency: [(1.4e5, 180.0, 3e3, 1), (1.4e5, 180.0, 3e3, 2), (1.4e5, 0.0, 3e3, 1)],
    rope_rod.third_mass_frequency: [(1.4e5, 180.0, 3e3)],
    rope_rod.free_rod_root: [(60.0, 17.0), (0.4, 0.0)],
    rope_rod.framed_rod_frequency: [(1.4e5, 180.0, 1e4, 3e3, 6e5, 2e3), (1.4e5, 0.0, 1e4, 3e3, 6e5, 0.0)],
    rope_rod.free_rod_frequency: [(1.4e5, 180.0, 1e4, 3e3), (1.4e5, 0.0, 1e4, 3e3)],
    rope_rod.snatch_wave_force: [(0.4, 1.4e5, 180.0)],
    rope_rod.hauling_gain: [(120.0, 15.0)],
    rope_rod.paying_out_gain: [(15.0, 120.0)],
    rope_rod.hauled_strain: [
        (1.7e7, 3e3, 1.5, 120.0, 15.0, 2e-4, 1e-3),
        (1e3, 3e3, 1.5, 120.0, 0.2, 2e-4, 0.0),
        (1.7e7, 3e3, 1.5, 120.0, 120.0, 2e-4, 1e-3),
    ],
    winding.paper_frequency: [(2.1e11, 1.14e-4, 49050.0, 160.0, 9.81)],
    winding.paper_amplitude: [(1.2566, 0.0175)],
    winding.climb_amplitude: [(1.2566, 0.0152)],
    winding.climb_rates: [(1.2566,)],
    winding.stretch_stress: [(1.05e11, 2e-3, 160.0)],
    winding.fall_stress: [(49050.0, 4, 1.14e-4)],
    winding.stress_ratio: [(1.57, 0.059, 4, 1, 9.81)],
    winding.sudden_ratio: [(1.2566, 0.0152, 21.9, 4, 1, 9.81)],
    winding.crossover_ratio: [(2, 1.2566, 21.9)],
    winding.crossover_rise: [(0.0175, 0.0152), (0.0175, 0.0175)],
    winding.winding_radius: [(0.159, 0.0152, rise, 2, 1.05, 3.0) for rise in (0.0, 0.0023)],
    wheel_loads.corner_loads: [(*MASSES, 22.5, 4.2, frame) for frame in ("hinged", "rigid")],
    wheel_loads.corner_load_range: [
        (MASSES[0], MASSES[1], MASSES[1] + 9.0, *MASSES[2:], 22.5, 4.2, frame) for frame in ("hinged", "rigid")
    ],
    wheel_loads.wheels_of_rail: [
        (60e3, 100e3, np.array([-2.6, -1.6, 1.5, 2.5]), carriage) for carriage in ("equalised", "rigid")
    ],
    wheel_loads.mean_wheel_load: [(30e3, 160e3)],
    wheel_loads.wheel_spectrum_factor: [(np.array([4e4, 9e4]), np.array([0.3, 0.7]), 3.0)],
    wheel_loads.even_travel_factor: [(0.0, 3.0), (0.3, 10 / 3), (1.0, 3.0)],
    travel.rolling_coefficient: [(0.015, 0.1, 0.0005, 0.4, 1.5)],
    travel.wind_pressure: [(20.0, 1.25)],
    travel.wind_force: [(250.0, 30.0, 1.6)],
    travel.travel_resistance: [(v, 3e5, 0.01, 0.004, -5e3) for v in (0.7, -0.7)],
    travel.holding_force: [(3e5, 0.006, 0.0, 2e4), (3e5, 0.006, 0.002, 0.0)],
    standard_factors.hoisting_factors: [(0.1,)],
    standard_factors.drive_factor: [
        *((change, much, "by_change") for change in ("smooth", "sudden") for much in (False, True)),
        *(("two_step", much, "by_control") for much in (False, True)),
    ],
    standard_factors.load_test_factors: [(1.4,)],
    rail.rail_acceleration: [(1.4, 0.315)],
    rail.step_number: [(26.0, 1.4, 0.315, 0.002)],
    rail.gap_number: [(26.0, 1.4, 0.03)],
    rail.residual_step: [(a,) for a in (0.4, 1.0, 3.3)],
    rail.residual_gap: [(a,) for a in (0.4, 1.0, 3.3)],
    rail.step_extremes: [(a,) for a in (0.4, 1.0, 1.2, 3.3)],
    rail.gap_extremes: [(a,) for a in (0.4, 0.7, 1.0, 1.2, 3.3)],
    rail.wheel_modes: [(3e4, 1.2e4, 2e7, 4e5), (2e4, 2e4, 8e6, 8e6)],
    rail.rail_factor: [(1.4, 0.315, 9.81, xi) for xi in (1.6, -1.2)],
    rail.waviness_acceleration: [(1.4, 0.6, 0.004)],
    rail.tilt_way: [(0.002, 8.0, 3.2)],
    rail.resonance_speed: [(7.0, 1.2)],
    fork.push_force: [(4e3, 5e5, 300.0, 0.4)],
    fork.push_bound: [(4e3, 5e5, 8e5, 300.0, 0.4)],
    fork.push_least: [(4e3, 5e5, 8e5, m, 1600.0, 0.4) for m in (300.0, 3e4)],
    fork.clutch_push: [(4e3, 5e5, 80.0, 0.4)],
    fork.caught_force: [(34e3, 15696.0, 9e5, 9e3, 0.3)],
    fork.soft_caught_force: [(15696.0, 9e5, 9e3, 0.3, h) for h in (0.0, 4e4, 3e5)],
    fork.stall_force: [(15696.0, 4e4, 0.3)],
    fork.caught_bound: [(34e3, 15696.0, 9e5, 2.5e6, 9e3, 1600.0, 0.3)],
    fork.rack_bound: [(34e3, 15696.0, 9e5, 2.5e6, 9e3, 1600.0, 0.3)],
    fork.catching_number: [(p, 15696.0, 9e5, 9e3, 0.3) for p in (15696.0, 60e3)],
    fork.slope_number: [(4e4, 9e5, 9e3)],
    runway_actions.drive_force: [(0.2, np.array([2.2e4, 2.4e4]))],
    runway_actions.fatigue_wheel_load: [(3e4, 4e4, 1.1, 1.2, 0.63)],
    safety_gear.trip_speed: [(1.0, 1.4)],
    safety_gear.trip_time: [(1.0, 1.4, 9.81)],
    safety_gear.catch_speed: [(1.0, 1.4, 0.05, 9.81)],
    safety_gear.fall_before_catch: [(1.0, 1.89, 9.81)],
    safety_gear.progressive_deceleration: [(31392.0, 1600.0, 9.81)],
    safety_gear.progressive_distance: [(31392.0, 1600.0, 1.89, 9.81)],
    safety_gear.gear_force_needed: [(1600.0, 1.89, 0.2, 9.81)],
    safety_gear.gear_speed_left: [(f, 1600.0, 1.89, 0.1, 9.81) for f in (31392.0, 12e3)],
    safety_gear.instantaneous_force: [(1600.0, 4e6, 1.89, 9.81)],
    safety_gear.eccentric_moment: [(3e4, 0.9)],
    safety_gear.axial_shock: [(3e4,)],
    skew.skew_angle: [(x, 0.006, 4.2, 0.01, 0.001, e) for x in (0.008, 0.02) for e in ("full", *SKEW_EDITIONS)],
    skew.skew_play: [(x, 0.006, e) for x in (0.004, 0.007, 0.02) for e in ("full", *SKEW_EDITIONS)],
    skew.skew_friction: [(0.006, 0.3)],
    skew.slip_pole: [(*PAIRS, 0.35, 22.5, rail) for rail in ("fixed", "movable")],
    skew.skew_forces: [(0.24, *PAIRS, 0.35, 22.5, rail) for rail in ("fixed", "movable")],
    skew.skew_equilibrium: [(0.3, 0.006, *PAIRS, 0.35, 22.5, rail) for rail in ("fixed", "movable")],
    skew.start_side_forces: [(12e3, 0.2, 22.5, 4.2)],
    skid.wheel_grip: [(4e3, 0.25, 9e4, 0.006, 12.0, 0.3)],
    skid.driven_forces: [(24e3, 0.36, 2354.0, np.array([0.5, 0.5]))],
    skid.skid_reserve: [(0.14, 5e4, 5e3), (0.14, 5e4, -5e3)],
    skid.slip_accelerations: [(24e3, w, 0.14, np.full(2, 0.5), np.full(2, 58e3), np.array([300.0, -300.0]))
                              for w in (2354.0, -2354.0)],
    skid.rail_force: [(a, push, 3600.0, 0.14, 58e3, 300.0) for push in (4e3, 3e4, -3e4) for a in (0.2, -0.2)],
    skid.slipping_acceleration: [
        (np.full(2, push), np.full(2, 3600.0), 24e3, 2354.0, 0.14, np.array([58e3, 30e3]), np.array([300.0, -300.0]))
        for push in (4e3, 7e3, 3e4, -3e4)
    ],
    skid.slip_motor_torque: [(0.59, 31200.0, 2354.0, 0.2, 20.0, 0.9)],
    mast_compliance.column_bending: [BRIDGE[:3]],
    mast_compliance.bridge_travel_compliance: [
        (*BRIDGE, 1.6e-4, 2.0, 5.0, ends, wheels) for ends in ENDS for wheels in ("free", "braked")
    ],
    mast_compliance.trolley_travel_compliance: [(*BRIDGE, 5.0, ends) for ends in ENDS],
    mast.mean_shape: [(0.3, 0.1)],
    mast.mass_coefficient: [(0.3, 0.1)],
    mast.tip_shape: [(0.6, 0.3, 0.1)],
    mast.consistent_masses: [(4e3, 1800.0, 1200.0, 500.0, 0.3, 0.1, place) for place in (0.6, 1.0)],
    mast.consistent_frequency: [(6e5, 4600.0, 170.0, 2100.0)],
    mast.two_mass_damping: [(6e5, 4e3, 2100.0, 0.15), (6e5, np.inf, 2100.0, 0.15)],
    mast.static_lag: [(9e3, 6e5, 4600.0, 170.0, 2100.0)],
    mast.notes_deflection: [(9e3, 6e5, 4e3, 1800.0, 1200.0, 0.236)],
    mast.rise_factor: [(0.3,), (0.0,)],
    mast.after_stop_ratio: [(2.1, 0.5), (2.1, 3.0)],
    mast.root_moment: [(9e3, 7e3, 1800.0, 1200.0, 6.0)],
    mast.leaning: [(1e4, 6.0, 4.2e7, k, 0.8) for k in (3e7, np.inf)],
    mast.gravity_stiffness: [(2e4, 1.2e4, 6.0, 0.3, 0.1, attitude) for attitude in ATTITUDES],
    mast_compliance.weighted_tip_compliance: [
        (6.0, 4.2e7, 3e7, weight, attitude) for weight in (0.0, 2e4, 9e5) for attitude in ATTITUDES
    ],
    mast_modes.clamped_beam_root: [(0.5, 1), (0.0, 2)],
    mast_modes.mast_frequency: [(one, k) for one in MASTS for k in (1, 2)],
    mast_modes.mode_compliance: [(MASTS[0], 1, "base"), *((one, 1, "load") for one in MASTS)],
    mast_modes.shortest_part: [(one,) for one in MASTS],
    contact_damping.dashpot_ratio: [(e,) for e in (0.0, 0.05, 0.6, 1.0)],
    obstacle.elastic_contact_force: [(0.8, 3e7, 2100.0)],
    obstacle.damped_contact: [(0.8, 2100.0, 3e5, 0.01, n, c) for n in (1.0, 1.5) for c in (0.0, 0.01, 0.4)],
    obstacle.column_force_bound: [(7100.0, 6e5, 0.8, push, 3e5, x, 1.5) for push in (0.0, 4e3) for x in (0.0, 0.01)],
}  # fmt: skip
"""Calls of every law, in its range and over its branches."""

ONE_CALL_EACH = {f"{law.__name__}-{k}": (law, call) for law, calls in CALLS.items() for k, call in enumerate(calls)}
BY_NAME = {law.__name__: law for law in CALLS}
OF_ARRAYS = {name: law for name, law in BY_NAME.items() if array_arguments(law)}
TABLES_IN_METRES = {
    backlash.new_clearance,
    resistance.length_factor,
    belt_resistance.secondary_resistance,
    belt_section.usable_width,
    belt_section.standard_edge_width,
}
"""Laws that are read from a table and know no other unit than its own."""
IN_PRINTED_UNITS = {
    polygon.return_share,
    polygon.nearest_threshold,
    chain_resonance.textbook_resonance_speed,
    chain_resonance.textbook_resonance_factor,
    chain_resonance.textbook_resonance_modulus,
    chain_selection.lubrication,
    lift_off_standard.stiffness_class,
    lift_off_standard.standard_lift_off_factor,
    lift_off_standard.fem_lift_off_factor,
    rope_life.diameter_factor,
    rope_life.bending_number,
    rope_life.wire_breaks,
    rope_life.discard_force,
    drum_shell.yield_strength,
}
"""Laws whose numbers belong to units that are mixed in print: their factors are told in SI."""

REFUSED: dict[Law, list[tuple[type[Exception], tuple[Any, ...]]]] = {
    backlash.new_clearance: [(ValueError, (0.25, 7))],
    bodies.inertia_of_gd2: [(ValueError, (15.0, "radius"))],
    brake.brake_stop: [(ValueError, (3.2, 104.0, 700.0, 0.0, 0.1, 0.3, "sudden"))],
    brake.brake_torque_for_time: [(ValueError, (3.2, 104.0, 0.9, 0.0, 0.1, 0.3, "sudden"))],
    brake.braking_torque: [(ValueError, (0.9, 700.0, 0.1, 0.3, "sudden"))],
    buffer.buffer_factor: [
        (ValueError, (1.1,)),
        (ValueError, (-0.1,)),
        (ValueError, (np.nan,)),
        (ValueError, (0.5, "2004")),
    ],
    buffer.collision_force: [(ValueError, (5e3, 2e3, 6e5, 0.8, 4e3, "all"))],
    coulomb.coulomb_decay: [(ValueError, (0.1, 0.0, 20.0, 1e4, 4.0))],
    sprocket.speed_ripple: [(ValueError, (8, "smallest"))],
    sprocket.engagement_speed: [(ValueError, (0.5, 8, "loose"))],
    polygon.engagement_times: [(ValueError, (1.3, -9.0, 8, 5))],
    chain_resonance.textbook_resonance_factor: [(ValueError, (2.06e11, 9.81, "eighth"))],
    chain_resonance.textbook_resonance_modulus: [(ValueError, (3500.0, 9.81, "eighth"))],
    chain_selection.centre_distance: [(ValueError, (40.0, 0.019, 19, 57)), (ValueError, (38.0, 0.019, 38, 38))],
    chain_selection.wrap_angle: [(ValueError, (0.1, 0.06, 0.17))],
    chain_wear.wear_per_revolution: [(ValueError, ([6e4], [8e3], [0.012], [0.64], [2e-12], "both"))],
    inertia.inertia_on_motor_shaft: [(ValueError, (90.0, 20.0, 0.9, "coast"))],
    inertia.inertia_on_slow_shaft: [(ValueError, (0.9, 20.0, 0.9, "coast"))],
    inertia.mass_on_motor_shaft: [(ValueError, (8e3, 0.2, 2.0, 40.0, 0.9, "coast"))],
    inertia.rotating_parts_coefficient: [(ValueError, (0.4, [1.5], [4.0], [0.97], "coast"))],
    similarity.distortions: [(ValueError, ("full", 0.1))],
    similarity.scales: [(ValueError, ("full", 0.1)), (ValueError, ("half", 0.1)), (ValueError, ("ballast", 3.0))],
    duty.rms_torque: [(ValueError, ([9.0], [0.0])), (ValueError, ([9.0], [1.0], 0.0)), (ValueError, ([], []))],
    duty.equivalent_torque: [(ValueError, ([9.0], [9.0], [0.0]))],
    duty.permissible_torque: [(ValueError, (400.0, 0.25, 1.0, 2.0, 0.33))],
    motor.breakdown_slip: [(ValueError, (0.04, 2.3, 9.0))],
    motor.kloss_slip: [(ValueError, (401.0, 400.0, 0.17)), (ValueError, (-401.0, 400.0, 0.17))],
    resistance.length_factor: [(ValueError, (79.0,))],
    contact_damping.dashpot_ratio: [(ValueError, (1.1,)), (ValueError, (-0.1,))],
    mast_compliance.bridge_travel_compliance: [
        (ValueError, (*BRIDGE, 1.6e-4, 2.0, 5.0, "hinged", "free")),
        (ValueError, (*BRIDGE, 1.6e-4, 2.0, 5.0, "clamped", "locked")),
    ],
    mast_compliance.trolley_travel_compliance: [(ValueError, (*BRIDGE, 5.0, "hinged"))],
    mast.gravity_stiffness: [(ValueError, (2e4, 1.2e4, 6.0, 0.3, 0.1, "lying"))],
    mast_compliance.weighted_tip_compliance: [
        (ValueError, (6.0, 4.2e7, np.inf, 2e4, "lying")),
        (ValueError, (6.0, 4.2e7, np.inf, 3e6, "standing")),
        (ValueError, (6.0, 4.2e7, 1e6, 2e5, "standing")),
    ],
    mast_modes.mode_compliance: [(ValueError, (MASTS[0], 1, "tip"))],
    start_profile.phases: [(ValueError, ("step", True, 4.0, 3.0))],
    strand_tension.load_pull: [(ValueError, (5.0, 5.1, 160.0, 0.022, 9.81))],
    strand_tension.section_pull: [(ValueError, (5.0, -5.1, 18.0, 160.0, 20.0, 0.022, 9.81))],
    strand_tension.slope_loading: [(ValueError, (np.array([4.0, -9.0]), "worst"))],
    strand_tension.worst_loading: [(ValueError, (np.array([4.0, -9.0]), "worst"))],
    strand_tension.worst_stretch: [(ValueError, (np.array([4.0, -9.0]), "worst"))],
    belt_resistance.secondary_resistance: [(ValueError, (4e4, 79.0))],
    belt_section.minimum_pulley_diameter: [(ValueError, ("rubber", 0.006))],
    stopping.brake_torque_for_distance: [(ValueError, (19e3, 9e3, 0.5, 0.1, 0.65, 40.0, 0.9, 0.35, "seed"))],
    rope_life.diameter_factor: [(ValueError, (0.001,))],
    rope_drum.layer_step: [(ValueError, (0.0175, 0.0195, "loose")), (ValueError, (0.0175, 0.035, "nested"))],
    rope_drum.layer_factor: [(ValueError, (3,))],
    hoist_class.rope_safety_of_group: [(ValueError, ("M7", 2))],
    lift_off_standard.class_lift_off_speed: [
        (ValueError, ("HD6", "regular", 0.4, 0.1)),
        (ValueError, ("HD1", "A1", 0.4, 0.1)),
        (ValueError, ("HD1", "regular", 0.4, 0.1, "2004")),
        (ValueError, ("HD1", "exceptional", 0.4, 0.1, "printed")),
        (ValueError, ("HD3", "exceptional", 0.4, 0.1, "printed")),
    ],
    lift_off_standard.fem_lift_off_factor: [(ValueError, ("tower", 0.5))],
    lift_off_standard.standard_lift_off_factor: [
        (ValueError, ("HC5", "HD1", 0.4, "by_class")),
        (ValueError, ("HC1", "HD6", 0.4, "by_class")),
        (ValueError, ("HC1", "HD1", 0.4, "2004")),
    ],
    standard_factors.hoisting_factors: [(ValueError, (0.11,)), (ValueError, (-0.1,)), (ValueError, (np.nan,))],
    standard_factors.drive_factor: [
        (ValueError, ("two_step", False)),
        (ValueError, ("sudden", False, "by_control")),
        (ValueError, ("sudden", False, "2004")),
    ],
    skew.skew_angle: [(ValueError, (0.02, 0.006, 4.2, 0.01, 0.001, "iso_8686"))],
    skew.skew_play: [(ValueError, (0.02, 0.006, "iso_8686"))],
    skew.slip_pole: [
        (ValueError, (*PAIRS, 0.35, 22.5, "hinged")),
        (ValueError, (np.zeros(2), *PAIRS[1:], 0.35, 22.5, "fixed")),
    ],
    skew.skew_equilibrium: [(ValueError, (0.3, 0.006, *PAIRS, 0.35, 22.5, "hinged"))],
    skew.skew_forces: [(ValueError, (0.24, *PAIRS, 0.35, 22.5, "hinged"))],
    wheel_loads.corner_loads: [(ValueError, (*MASSES, 22.5, 4.2, "three_legs"))],
    wheel_loads.corner_load_range: [(ValueError, (*MASSES[:2], *MASSES[1:], 22.5, 4.2, "three_legs"))],
    wheel_loads.wheels_of_rail: [
        (ValueError, (60e3, 100e3, np.array([-2.0, 2.0]), "sprung")),
        (ValueError, (60e3, 100e3, np.array([-2.0, 0.0, 2.0]), "equalised")),
        (ValueError, (60e3, 100e3, np.array([2.0, -2.0]), "rigid")),
    ],
    winding.winding_radius: [(ValueError, (0.159, 0.0152, 0.0023, 2, 3.2, 3.0))],
}


@dataclass(frozen=True)
class Units:
    """How large the units of mass, length and time are in the others."""

    scale: tuple[float, float, float]

    def factor(self, unit: str) -> float:
        return float(np.prod([s**p for s, p in zip(self.scale, dimension(unit), strict=True)]))

    def converted(self, value: Any, unit: str | None) -> Any:
        if isinstance(value, LoopMasses):
            of = dict(re.findall(r"(masses|compliances)[^\[]*\[([^\]]+)\]", inspect.getdoc(LoopMasses) or ""))
            suffix = {"mass": of["masses"], "compliance": of["compliances"]}
            numbers = {f.name: suffix[f.name.rpartition("_")[2]] for f in fields(value) if f.type is float}
            return replace(value, **{name: getattr(value, name) * self.factor(u) for name, u in numbers.items()})
        if isinstance(value, Mast):
            told = {
                f.name: re.search(rf"\b{f.name}\b[^\[]*\[([^\]]+)\]", inspect.getdoc(Mast) or "") for f in fields(value)
            }
            return replace(
                value, **{name: getattr(value, name) * self.factor(one[1]) for name, one in told.items() if one}
            )
        return value * self.factor(unit) if unit is not None else value


def numbers_of(result: Any) -> Iterator[float]:
    """All numbers of a result, in order."""
    if is_dataclass(result):
        for f in fields(result):
            yield from numbers_of(getattr(result, f.name))
    elif isinstance(result, tuple):
        for part in result:
            yield from numbers_of(part)
    elif isinstance(result, str):
        yield from map(float, re.findall(r"\d+(?:\.\d+)?(?:e[+-]?\d+)?", result))
    else:
        yield from np.ravel(np.asarray(result, float)).tolist()


def random_units(seed: int) -> Units:
    return Units(tuple(float(x) for x in 10 ** np.random.default_rng(seed).uniform(-3, 3, 3)))  # type: ignore[arg-type]


def test_every_law_is_called_here() -> None:
    assert {law.__name__ for law in CALLS} == {law.__name__ for law in LAWS.values()}
    assert set(CALLS) == set(LAWS.values())


NOT_NUMBERS = (str, bool, int, LoopMasses, HeldStrands, Mast, start_profile.Shape, rope_life.Constants)


@over(BY_NAME)
def test_every_number_has_a_unit(law: Law) -> None:
    parameters = inspect.signature(law).parameters
    assert list(parameters) == re.findall(r"^    (\w+): ", section(law, "Args"), re.MULTILINE)
    numbers = {name for name, p in parameters.items() if p.annotation not in NOT_NUMBERS}
    assert set(argument_units(law)) == numbers
    for unit in [*argument_units(law).values(), *units(section(law, "Returns"))]:
        assert dimension(unit) is not None


@over(ONE_CALL_EACH)
def test_other_units_of_mass_length_and_time_give_the_same_physics(law: Law, call: tuple[Any, ...]) -> None:
    of, names, here = argument_units(law), list(inspect.signature(law).parameters), list(numbers_of(law(*call)))
    results = units(section(law, "Returns")) or ["1"]  # a result without a unit is a pure number
    results = results * (len(here) // len(results))
    for seed in SEEDS:
        other = random_units(seed)
        if law in TABLES_IN_METRES:
            other = Units((other.scale[0], 1.0, other.scale[2]))
        if law in IN_PRINTED_UNITS:
            other = Units((1.0, 1.0, 1.0))
        converted = [other.converted(value, of.get(name)) for name, value in zip(names, call, strict=True)]
        expected = [value * other.factor(unit) for value, unit in zip(here, results, strict=True)]
        assert list(numbers_of(law(*converted))) == pytest.approx(expected, rel=1e-9), seed


@over({f"{name}, {shape}": (law, shape) for name, law in OF_ARRAYS.items() for shape in SHAPES_OF_ARRAYS})
def test_an_array_gives_what_its_numbers_give_one_by_one(law: Law, shape: tuple[int, ...]) -> None:
    rng = np.random.default_rng(8)
    names = list(inspect.signature(law).parameters)
    for call in CALLS[law]:
        given = dict(zip(names, call, strict=True))
        arrays = {name: given[name] * rng.uniform(0.2, 1.8, shape) for name in array_arguments(law)}
        if "x" in arrays:
            arrays["x"] = np.minimum(arrays["x"], 1.0)  # fraction of a strand
        whole = np.asarray(law(**given | arrays))
        assert whole.shape == shape
        for index in np.ndindex(shape):
            one = law(**given | {name: float(values[index]) for name, values in arrays.items()})
            assert float(whole[index]) == pytest.approx(float(one), rel=1e-14, abs=1e-300)


@over(OF_ARRAYS)
def test_arguments_are_left_as_they_were(law: Law) -> None:
    names = list(inspect.signature(law).parameters)
    given = dict(zip(names, CALLS[law][0], strict=True))
    arrays = {name: np.full(4, float(given[name])) for name in array_arguments(law)}
    result = np.asarray(law(**given | arrays))
    result[...] = -1.0  # nor is the result a view of them
    assert all(np.all(values == given[name]) for name, values in arrays.items())


def documented_errors(law: Law) -> set[str]:
    return set(re.findall(r"^    (\w+):", section(law, "Raises"), re.MULTILINE))


def test_the_errors_tested_are_those_documented() -> None:
    documented = {law: documented_errors(law) for law in CALLS if documented_errors(law)}
    assert documented == {law: {error.__name__ for error, _ in calls} for law, calls in REFUSED.items()}


@over({f"{law.__name__}-{k}": (law, *refused) for law, calls in REFUSED.items() for k, refused in enumerate(calls)})
def test_documented_errors_are_raised(law: Law, error: type[Exception], call: tuple[Any, ...]) -> None:
    with pytest.raises(error, match=r"\w+ \w+"):  # with a sentence
        law(*call)
