"""What a start does besides pulling at the belt: heat in the motors, swings it leaves, a control that pulsates."""

import math
from collections.abc import Iterator

import numpy as np

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate
from ptmcalc.components.motor_starts import no_load_speed
from ptmcalc.contract.result import Found, LoadInfo, of
from ptmcalc.laws import loop_bounds, sag, slip_heat, start_profile
from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.conveyor.machine.drives import moving_mass
from ptmcalc.machines.conveyor.machine.keys.drives import Drive, PlacedDrive
from ptmcalc.machines.conveyor.machine.model import FloatArray
from ptmcalc.machines.conveyor.machine.motion import Moving, moving
from ptmcalc.machines.conveyor.machine.resistances import filled
from ptmcalc.machines.conveyor.machine.scenes import Start
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.machine.start_case import StartCase, frequencies_of, lowest_frequency, start_case
from ptmcalc.machines.conveyor.waves import start_enclosure

START_LOADS = (
    LoadInfo("motor_start_heat", "rotor heat per start, one motor", units.ENERGY, headline=False),
    LoadInfo("coupling_start_heat", "fluid coupling heat per start, one coupling", units.ENERGY, headline=False),
    LoadInfo("resonance_distance", "drive ripple separation from belt modes", units.SHARE, headline=False),
    LoadInfo("start_residual", "residual first-mode oscillation (step = 1)", units.RATIO, headline=False),
)
"""Loads of a start besides those of `loads.LOADS`."""

OF_STARTING = frozenset(info.name for info in START_LOADS)
_STEPS = 4000
"""Steps of a start for motor heat and residual oscillation; a numerical choice. The rules are of second order: twice
the number takes twice the time and leaves a quarter of the error."""
_X = np.linspace(0.0, 1.0, 65)
"""Points of a strand as fractions of its length [1]; a numerical choice. Tensions and travel between them are linear or
neglected. More points take longer."""


def start_parts(spec: Conveyor) -> Iterator[LoadInfo]:
    """Those of them that a conveyor has."""
    for info in START_LOADS:
        if info.name == "motor_start_heat":
            yield from (info.of(name) for name in spec.all_drives)
        elif info.name == "coupling_start_heat":
            yield from (info.of(name) for name, drive in spec.all_drives.items() if drive.fluid_coupling is not None)
        else:
            yield info


def start_loads(spec: Conveyor, scene: Start, case: StartCase) -> dict[str, Found]:
    """What the file gives enough for."""
    found: dict[str, float] = {}
    left = spec.checks.start_residual is not None and scene.profile.rise_time > 0 and case.moves
    if not case.line.weight_at_tail and (scene.profile.ripple is not None or left):
        frequencies = frequencies_of(case, spec.takeup_weight)
        if scene.profile.ripple is not None:
            turns = np.array(frequencies) / (2 * math.pi)
            found["resonance_distance"] = float(np.min(np.abs(scene.profile.ripple / turns - 1)))
        if left:
            found["start_residual"] = _residual(case, frequencies[0])
    heats = _heats(spec, scene, case) if any(map(heated, spec.all_drives.values())) else {}
    return {name: Found(Estimate.exact(value)) for name, value in found.items()} | heats


def _residual(case: StartCase, frequency: float) -> float:
    """Swing of a mode after the rise, over that of a step; of a torque only what is over the resistance acts.

    A part of a ramp is a ramp; of other shapes the part that acts is summed up, straight from point to point.
    """
    shape, rise = case.shape, case.rise_time if case.imposed_speed else case.rise
    if case.imposed_speed or shape == start_profile.RAMP:
        return float(start_profile.residual(shape, rise, frequency))
    times = np.linspace(0.0, rise, _STEPS + 1)
    force = case.force(times)
    step = rise / _STEPS
    turns = np.exp(1j * frequency * (times[1:] - step / 2))
    swing = force[0] + np.sum(np.diff(force) * turns) * np.sinc(frequency * step / (2 * math.pi))
    return float(abs(swing) / force[-1])


# -- heat of the motors ---------------------------------------------------------------------------------------------


def heated(drive: Drive) -> str:
    """The load of the heat of a drive in a start, of its rotor or its fluid coupling; empty where it is unknown."""
    coupling = drive.fluid_coupling
    allowed = drive.motor.start_heat if coupling is None else coupling.start_heat
    if allowed is None or no_load_speed(drive.motor) is None:
        return ""
    return "motor_start_heat" if coupling is None else "coupling_start_heat"


def _heats(spec: Conveyor, scene: Start, case: StartCase) -> dict[str, Found]:
    """Heat of one rotor or fluid coupling of each drive, from switching on to rated speed, with the bar of the belt's
    stretch.

        Q = integral of M (w_0 - w) dt

    By the rigid conveyor, less what the drum runs ahead of the mean of all that moves: under a step of torque by
    nothing to twice the quasi-static lead, since every mode swings between 0 and twice its share.

    **Range** a motor on the mains, its rotor's resistance constant; not one that an inverter leads. A fluid coupling
    behind a motor that has run up takes the heat of both.
    **Error** the bar of the lead, which holds for one drive and a torque that does not depend on the speed, and is an
    estimate elsewhere; the losses of gear and stator are not in it.
    **Source** power of the air gap less that of the shaft; `laws.slip_heat.slip_heat` with torques.
    """
    found: dict[str, Found] = {}
    for name, drive in spec.all_drives.items() if not scene.profile.imposes_speed else ():
        load, fast = heated(drive), no_load_speed(drive.motor)
        if load and fast is not None:
            found[of(load, name)] = Found(slip_heat_of(spec, scene, case, name, fast))
    return found


def slip_heat_of(spec: Conveyor, scene: Start, case: StartCase, name: str, fast: float) -> Estimate:
    """Heat of one rotor or fluid coupling of a drive whose no-load speed is known [rad/s], in one start [J]; infinite
    where the belt does not move."""
    motion, drive = moving(spec, scene), spec.all_drives[name]
    if not case.moves or motion.rigid_time <= 0:
        return Estimate.exact(math.inf)
    turns = drive.gear.ratio * 2 / drive.drum.diameter
    times, torque, speed = _rigid(motion, name, drive)
    heat = slip_heat.slip_heat(times, torque, np.full_like(times, fast), np.minimum(speed * turns, fast))
    lead = float(np.abs(torque).max()) * turns * loop_bounds.drive_lead(case.masses, case.acceleration)
    return Estimate(heat - lead, heat - 2 * lead, heat, model=lead)


def _rigid(motion: Moving, name: str, drive: PlacedDrive) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Times [s], torque of one motor of a drive [N*m] and speed of the rigid conveyor [m/s] until it is at speed."""
    per_motor = drive.drum.diameter / 2 / (drive.gear.ratio * filled(drive.gear.efficiency) * drive.motor.count)
    line = motion.line
    mass, resistance = moving_mass(line), line.static_resistance + line.tail_pull
    times = np.linspace(0.0, motion.rigid_time, _STEPS + 1)
    step = float(times[1])
    if not motion.curves:
        forces = {one: pull(times) for one, pull in motion.pulls.items()}
        over = sum(forces.values(), np.zeros_like(times)) - resistance
        gained = np.concatenate([[0.0], np.cumsum(over[1:] + over[:-1])]) * (step / 2 / mass)
        return times, forces[name] * per_motor, gained - np.minimum.accumulate(gained)
    speed = np.zeros_like(times)
    force = np.zeros_like(times)
    for k in range(_STEPS + 1):
        pulls = {one: curve(float(times[k]), float(speed[k]))[0] for one, curve in motion.curves.items()}
        force[k] = pulls[name]
        if k == _STEPS:
            break
        first = (sum(pulls.values()) - resistance) / mass
        ahead = max(speed[k] + first * step, 0.0)
        second = (sum(curve(float(times[k + 1]), ahead)[0] for curve in motion.curves.values()) - resistance) / mass
        speed[k + 1] = max(speed[k] + (first + second) / 2 * step, 0.0)
    return times, force * per_motor, speed


# -- what the margins allow -----------------------------------------------------------------------------------------


def allowed_acceleration(spec: Conveyor, scene: Start) -> float | None:
    """Largest acceleration with which grip and tension surely last, waves included [m/s^2]; None where no bound is
    known.

        grip:   (S_off - a l_off)(exp(mu alpha) - 1)/k_T >= S_on + a h_on - S_off + a l_off, and with on for off
        slack:  S(s) - a l(s) >= w l/(8 h_slack)

    with -a l and a h the bounds of the dynamic tension: r low - b stray and r high + b stray while the force acts, and
    what waves can do once it has fallen at the speed of the drum.

    **Range** one drive, both strands of even mass, a belt that starts from its running state; the reserve on the force.
    **Error** on the safe side: the waves' largest swings are taken to come together.
    **Source** `laws.loop_bounds.stray`, `laws.start_profile.phases`; Euler-Eytelwein.
    """
    case = start_case(spec, scene)
    line = case.line
    even = all(len(set(strand.masses)) == 1 for strand in (line.carry, line.back))
    unusual = scene.aborted is not None or scene.belt == "relaxed" or scene.profile.shape == "curve"
    if unusual or not even or len(spec.all_drives) > 1 or spec.takeup_weight or line.weight_at_tail:
        return None
    phases = case.phases(lowest_frequency(case))
    allowed = math.inf
    ends: dict[int, tuple[FloatArray, FloatArray, FloatArray]] = {}
    for strand in (RETURN, CARRY):
        r, b = loop_bounds.quasi_static(case.masses, strand, _X), loop_bounds.stray(case.masses, strand, _X)
        low = np.min([np.minimum(r * phase.low, r * phase.high) - b * phase.stray for phase in phases], axis=0)
        high = np.max([np.maximum(r * phase.low, r * phase.high) + b * phase.stray for phase in phases], axis=0)
        span = line.strand(strand).span_weight
        slack = sag.tension_at_sag(span, line.slack_sag) if span is not None else 0.0
        static = line.static(strand, _X)
        swing = start_enclosure.once_held(case, phases, strand, _X)
        falls, rises = np.maximum(-low, swing), np.maximum(high, swing)
        ends[strand] = static, falls, rises
        if (falls > 0).any():
            allowed = min(allowed, float(np.min((static - slack)[falls > 0] / falls[falls > 0])))
    if line.grip_exponent is not None:
        grip = math.expm1(line.grip_exponent) / spec.checks.slip.reserve
        off, on = (tuple(float(part[at]) for part in ends[strand]) for strand, at in ((RETURN, 0), (CARRY, -1)))
        for slack_side, tight in ((off, on), (on, off)):
            asked = tight[2] + slack_side[1] * (1 + grip)
            if asked > 0:
                allowed = min(allowed, (slack_side[0] * grip - (tight[0] - slack_side[0])) / asked)
    return max(allowed, 0.0)
