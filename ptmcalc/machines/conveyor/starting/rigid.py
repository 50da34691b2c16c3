"""A start of the rigid body: closed form. Its error bar is the bound of the belt's waves."""

import math
from dataclasses import replace

import numpy as np

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Found, Result, of
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import wave
from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.conveyor.machine.drives import least_pull
from ptmcalc.machines.conveyor.machine.loads import DRIVE, OF_BELT, OF_START, PER_DRIVE, SLIPS
from ptmcalc.machines.conveyor.machine.model import FloatArray
from ptmcalc.machines.conveyor.machine.motion import moving
from ptmcalc.machines.conveyor.machine.plain_start import is_plain
from ptmcalc.machines.conveyor.machine.scenes import Start
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.machine.start_case import (
    StartCase,
    drive_loads,
    frequencies_of,
    start_case,
    start_duration,
)
from ptmcalc.machines.conveyor.machine.tension_loads import Sides, derived_loads, slip_loads
from ptmcalc.machines.conveyor.starting.loads import OF_STARTING, start_loads
from ptmcalc.machines.conveyor.starting.permitted_starts import PERMITTED, permitted_starts
from ptmcalc.machines.conveyor.waves.start_enclosure import along


def run(spec: Conveyor, scene: Start, carried: frozenset[str], level: int) -> Result:
    """Loads of a start in which drive and belt move as one body.

        a = F_d/M,   F_d = F - W,   S(s) = S_static(s) + a r(s)

    r(s) is the mass accelerated by a section (gravity take-up), or this mass less its mean over the loop (fixed
    take-up).

    **Range** any start that moves the belt.
    **Error** no error bar of its own: the bounds of the neglected effects cover the difference.
    **Source** Newton's law; the split of a fixed loop from constant elongation (`laws.loop_bounds.quasi_static`).
    """
    case = start_case(spec, scene)
    loads = _closed_forms(case) | _rigid_loads(case)
    if not is_plain(spec, scene):
        loads["start_time_rigid"] = moving(spec, scene).rigid_time if case.moves else math.inf
    if scene.profile.shape == "curve":  # the weakest moment of the motors decides whether they start
        loads |= drive_loads(replace(case, available_force=least_pull(spec, scene)), case.line.static_resistance)
        if loads["starting_reserve"] < 1:
            loads["start_time_rigid"] = math.inf
    loads["start_time"] = loads["start_time_rigid"]
    if len(spec.all_drives) == 1:
        loads |= _of_the_drive(next(iter(spec.all_drives)), loads)
    loop = () if case.line.weight_at_tail else frequencies_of(case, spec.takeup_weight)
    for number, frequency in enumerate(loop, 1):
        loads[of("natural_frequency", str(number))] = frequency
    window = (0.0, case.held + case.window)
    found = {name: Found(Estimate.exact(value)) for name, value in loads.items()}
    found |= start_loads(spec, scene, case) | permitted_starts(spec, scene, case)
    return Result(found, work=1, window=window)


def _of_the_drive(name: str, loads: dict[str, float]) -> dict[str, float]:
    """What is known of the only drive by its own name; it sticks, and the effect `slip` says what that leaves out."""
    found = {of(load, name): value for load, value in loads.items() if load in PER_DRIVE}
    if "slip_utilisation_max" in loads:
        found |= {of(load, name): 0.0 for load in SLIPS}
    return found


def _rigid_tension(case: StartCase, strand: int) -> tuple[FloatArray, FloatArray]:
    """Smallest and largest tension of the rigid body at both ends of a strand [N]."""
    part, ends = along(case), (strand, [0, -1])
    static, swing = part.static[ends], case.acceleration * part.rigid[ends]
    return static + np.minimum(swing, 0), static + np.maximum(swing, 0)


def _rigid_loads(case: StartCase) -> dict[str, float]:
    """Loads of the rigid body during a start, SI."""
    line = case.line
    ranges = [_rigid_tension(case, strand) for strand in (RETURN, CARRY)]
    on, off = float(ranges[CARRY][1][1]), float(ranges[RETURN][0][0])
    loads = {
        "tension_dynamic_run_on_max": on - line.run_on,
        "tension_run_on_max": on,
        "tension_run_off_min": off,
        "tension_max": float(max(high.max() for _, high in ranges)),
        "tension_min": float(min(low.min() for low, _ in ranges)),
    }
    loads |= drive_loads(case, case.line.static_resistance + (case.excess if case.imposed_speed else 0.0))
    loads |= derived_loads(
        line,
        tension_max=loads["tension_max"],
        smallest=(float(ranges[RETURN][0].min()), float(ranges[CARRY][0].min())),
    )
    if line.grip_exponent is not None:
        worst = [Sides(on, off, line.centrifugal_at_speed), Sides(line.run_on, line.run_off, 0.0)]
        loads |= slip_loads(line.grip_exponent, worst)
    return loads


def _closed_forms(case: StartCase) -> dict[str, float]:
    """Closed forms of a start that no wave can change."""
    line = case.line
    return {
        "wave_speed_carry": line.wave_speed(CARRY),
        "wave_speed_return": line.wave_speed(RETURN),
        "impedance_carry": line.impedance(CARRY),
        "impedance_return": line.impedance(RETURN),
        "reduced_drive_mass": line.drive_mass,
        "static_resistance": line.static_resistance,
        "starting_force": case.available_force,
        "rim_force_excess": case.excess if case.moves else case.available_force - line.static_resistance,
        "acceleration_rigid": case.acceleration,
        "start_time_rigid": start_duration(case),
        "first_wave_time_max": wave.first_wave_time(line.transit(CARRY), line.transit(RETURN)),
    }


RIGID: Solver[Conveyor, Start] = Solver(
    name="rigid",
    title="start, rigid-belt model with wave bounds",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Start}),
    represents=frozenset(),
    gives=OF_BELT.union(DRIVE, OF_START, OF_STARTING, PER_DRIVE, {PERMITTED.name}),
    run=run,
    cost=lambda spec, scene, carried, level: 3e-3,
    source="Newton's law; bounds derived in ptmcalc.laws.loop_bounds",
)
