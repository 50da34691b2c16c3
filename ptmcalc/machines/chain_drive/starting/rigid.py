"""A start of the rigid chain: closed form, and the textbook's beside it. What waves add is the bound of that effect."""

import math

import numpy as np

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Found, History, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import chain_start, inertia, wave
from ptmcalc.machines.chain_drive.machine.model import (
    drive_of,
    filled,
    gear_side_inertia,
    mean_arm,
    radius,
    shares_torque,
    sprocket_inertia,
)
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, Start
from ptmcalc.machines.chain_drive.starting.bounds import TENSIONS, loads_of, rigid_tensions
from ptmcalc.machines.chain_drive.starting.geared import geared_start
from ptmcalc.machines.chain_drive.starting.motion import (
    UP_TO,
    StartCase,
    curve_start,
    motor_torque,
    speed_over_time,
    start_case,
)
from ptmcalc.machines.chain_drive.starting.motor_force import stands_still
from ptmcalc.machines.chain_drive.starting.permitted_starts import PERMITTED, permitted_starts
from ptmcalc.machines.chain_drive.starting.rigid_curve import rigid_start


def run(spec: ChainDrive, scene: Start, carried: frozenset[str], level: int) -> Result:
    """Loads of a start in which motors, chain and load move as one body.

        m a + W = e (M i/R - J (i/R)^2 a),   e = eta or 1/eta by the direction of the power
        J_red = J + m (R/i)^2/e,   t = (J_red/(M - W R/(e i))) w,   S = S_static + a r

    m includes chain, load, tail and sprocket; R = z p/(2 pi). r is the mass accelerated by the entering strand
    (gravity take-up), or this mass less its mean over the loop (screw take-up); with a driven tail, which has the
    speed of the driving sprocket, half of the mass of the working strand. For an imposed speed a = V q'_max. A
    star-delta starter, a soft starter or fluid couplings change M over speed and time. On a curve a is the largest
    acceleration on the way to the operating speed.

    **Range** any start; the gear losses are those at full torque.
    **Error** no error bar of its own except the quadrature error on a motor curve; the bounds of the effects cover
    waves and teeth.
    **Source** Newton's law; lecture notes Kramatorsk 2007 with the efficiency in the direction of the power.
    """
    case = start_case(spec, scene)
    _, swing, least = rigid_tensions(case)
    loads = loads_of(spec, case, Estimate.exact(swing), Estimate.exact(least))
    loads |= {name: Estimate.exact(value) for name, value in _of_the_drive(spec, case).items()}
    loads["start_time"] = _start_time(spec, scene, case)
    if case.follows_curve:
        loads |= _on_curve(spec, scene, case)
    if shares_torque(spec) and not case.imposed_speed:
        loads |= {name: Estimate.unknown(loads[name].value) for name in TENSIONS if name in loads}
    loads |= permitted_starts(spec, scene, case)
    window = (0.0, case.held + case.window)
    found = {name: Found(load) for name, load in loads.items()}
    return Result(found, work=1, window=window, histories=lambda: _histories(case))


def _on_curve(spec: ChainDrive, scene: Start, case: StartCase) -> dict[str, Estimate]:
    """Tensions of the rigid chain along the curve of its motors: the static ones where they do not move it, without a
    bound where the start takes too many steps."""
    if stands_still(spec, case):
        return loads_of(spec, case, Estimate.exact(0.0), Estimate.exact(min(case.line.ends)))
    found = rigid_start(spec, scene)
    if found is None:
        _, swing, least = rigid_tensions(case)
        loads = loads_of(spec, case, Estimate.exact(swing), Estimate.exact(least))
        return {name: Estimate.unknown(loads[name].value) for name in TENSIONS}
    return loads_of(spec, case, found.dynamic, found.smallest)


def _histories(case: StartCase) -> dict[str, History]:
    """Speed of the rigid chain over time; along a motor's curve it follows no course of time."""
    if case.follows_curve or not case.moves:
        return {}
    times, speeds = speed_over_time(case)
    return {"start_time": History(units.SPEED, times.tolist(), speeds.tolist())}


def _of_the_drive(spec: ChainDrive, case: StartCase) -> dict[str, float]:
    gear, arm, mass = drive_of(spec).gear, mean_arm(spec), case.line.moving_mass
    needed = case.line.static_resistance
    if case.imposed_speed:
        needed += case.acceleration * (mass + inertia_at_chain(spec, case))
    driven = mass + sprocket_inertia(spec) / arm**2
    return {
        "static_resistance": case.line.static_resistance,
        "starting_force": case.available,
        "starting_reserve": least_force(spec, case) / needed if needed > 0 else math.inf,
        "acceleration_motor": case.acceleration * gear.ratio / arm,
        "reduced_inertia": gear_side_inertia(spec) + driven * (arm / gear.ratio) ** 2 / case.losses,
        "wave_speed": wave.wave_speed(case.line.working.stiffness, case.line.working.line_mass),
    }


def least_force(spec: ChainDrive, case: StartCase) -> float:
    """Force of the drive that must move the chain [N]: the mean one, or the smallest on the curve of the motors up to
    nine tenths of the rated speed."""
    drive = drive_of(spec)
    if not case.follows_curve or drive.start_curve is None:
        return case.available
    turns = drive.gear.ratio / mean_arm(spec)
    until = max(UP_TO * case.line.speed * turns, drive.switch_over * _JUST_BELOW)
    speeds = np.linspace(0.0, until, _SPEEDS)
    return case.available * float(drive.torques(speeds).min()) / drive.mean_torque


_JUST_BELOW = 1 - 1e-9
"""Speed in star connection at its end relative to that of the switch-over [1]; a numerical choice near 1."""


_SPEEDS = 181
"""Speeds at which the torque curve is evaluated: steps of half a percent of the rated speed. A numerical choice: more
find a narrow minimum more closely."""


def inertia_at_chain(spec: ChainDrive, case: StartCase) -> float:
    """Motors, couplings and sprocket at the chain, through the losses of the start [kg]."""
    gear, arm = drive_of(spec).gear, mean_arm(spec)
    return (case.losses * gear_side_inertia(spec) * gear.ratio**2 + sprocket_inertia(spec)) / arm**2


def _start_time(spec: ChainDrive, scene: Start, case: StartCase) -> Estimate:
    if not case.follows_curve:
        return Estimate.exact(case.duration)
    drive = drive_of(spec)
    by_gear = drive.starter is not None or drive.fluid_coupling is not None
    time, off = geared_start(spec, scene) if by_gear else curve_start(spec, scene)
    if math.isinf(time):
        return Estimate.exact(time)
    return Estimate(time, time, math.inf, math.inf) if math.isinf(off) else Estimate.within(time, off)


_GIVES = frozenset(
    {
        *TENSIONS,
        PERMITTED.name,
        "static_resistance",
        "starting_force",
        "starting_reserve",
        "start_time",
        "acceleration_motor",
        "reduced_inertia",
        "wave_speed",
    }
)
RIGID_START: Solver[ChainDrive, Start] = Solver(
    name="chain_rigid_start",
    title="start, rigid chain",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Start}),
    represents=frozenset(),
    gives=_GIVES,
    run=run,
    cost=lambda spec, scene, carried, level: 4e-3,
    source="Newton's law; bounds derived in ptmcalc.laws.loop_bounds",
)


def notes(spec: ChainDrive, scene: Start, carried: frozenset[str], level: int) -> Result:
    """Textbook start.

        J_pr = J + m R^2/(i^2 eta),   eps = (M_p - M_s)/J_pr,   t = J_pr w/(M_p - M_s),   S = S_C + m eps R/i
        M_s = W R/(i eta)

    **Range** a torque; R is the radius through the pins, as in the textbook, not z p/(2 pi).
    **Error** no bound: rigid body only, the oscillation of the elastic chain is neglected; eta always as for a driving
    motor.
    **Source** lecture notes Kramatorsk 2007.
    """
    case = start_case(spec, scene)
    if case.imposed_speed:
        return Result({}, work=1)
    gear, r, mass = drive_of(spec).gear, radius(spec), case.line.moving_mass
    ratio, efficiency = gear.ratio, filled(gear.efficiency)
    whole = gear_side_inertia(spec) + inertia.mass_on_motor_shaft(mass, r, 1.0, ratio, efficiency, inertia.DRIVE)
    static = case.line.static_resistance * r / (ratio * efficiency)
    torque, speed = motor_torque(spec), case.line.speed / r * ratio
    eps = chain_start.start_acceleration(torque, static, whole)
    dynamic = chain_start.start_force(mass, max(eps, 0.0), r, ratio)
    loads = {
        "reduced_inertia": whole,
        "acceleration_motor": max(eps, 0.0),
        "start_time": chain_start.start_time(torque, static, whole, speed),
        "tension_dynamic_start": dynamic,
        "tension_start": case.line.run_on + dynamic,
    }
    return Result({name: Found(Estimate.exact(value)) for name, value in loads.items()}, work=1)


START_NOTES: Solver[ChainDrive, Start] = Solver(
    name="chain_start_notes",
    title="textbook start: reduced inertia, time, force",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Start}),
    represents=frozenset(),
    gives=frozenset({"reduced_inertia", "acceleration_motor", "start_time", "tension_dynamic_start", "tension_start"}),
    run=notes,
    cost=lambda spec, scene, carried, level: 5e-5,
    source="lecture notes Kramatorsk 2007",
    decides=False,
)
