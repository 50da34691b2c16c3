"""A start on the motor curve with the teeth that pass during it."""

from dataclasses import replace

import numpy as np

from ptmcalc.base import units
from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Interval
from ptmcalc.base.memory import kept_for
from ptmcalc.contract.result import Found, History, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.chain_drive.machine.alike import moving_alike
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, Start
from ptmcalc.machines.chain_drive.speed_change.coupled_teeth import Coupled, coupled_cost, coupled_teeth, entering
from ptmcalc.machines.chain_drive.speed_change.teeth import Passing, curve_passings
from ptmcalc.machines.chain_drive.speed_change.tooth_passes import (
    TeethAlone,
    cost_of_teeth,
    driven_teeth_alone,
    teeth_alone,
)
from ptmcalc.machines.chain_drive.starting.bounds import TENSIONS, loads_of
from ptmcalc.machines.chain_drive.starting.motion import start_case
from ptmcalc.machines.chain_drive.starting.motor_curve_waves import (
    MOTOR_WAVES,
    SHOWN,
    Judged,
    histories,
    judged,
    valid,
)
from ptmcalc.machines.chain_drive.starting.motor_force import start_force
from ptmcalc.machines.chain_drive.starting.waves import beyond_slack

_MODES = 24
"""Modes that the teeth excite one by one at the coarsest level, twice as many at each finer one. A numerical choice:
the rest is bounded and added. More narrow the error bar and take longer."""
_LOOKS = 201
"""Times at which the largest speed of a part of the start is looked for; a numerical choice."""
_PARTS = 3.0
"""Predicted work of all parts relative to that of the last one [1]; only the order of solvers depends on it."""
_ALONG = 80
"""Sections for the predicted cost; a numerical choice. No load depends on it."""


def curve_teeth_simulated(spec: ChainDrive, scene: Start, level: int) -> tuple[TeethAlone, ...]:
    """What the teeth of a start on a motor curve change, from its beginning up to the end of each of its parts.

    Raises:
        NumericsError: NUM102 where the rigid chain is not followed.
    """
    return _curve_teeth_simulated(*moving_alike(spec, scene), level)


@kept_for(16)
def _curve_teeth_simulated(spec: ChainDrive, scene: Start, level: int) -> tuple[TeethAlone, ...]:
    """The same of the machine that represents all that move alike."""
    passings = curve_passings(spec, scene, _MODES << level)
    if not passings:
        raise NumericsError("NUM102", "the motors do not bring the rigid chain to a steady speed")
    case, release = start_case(spec, scene), start_force(spec, start_case(spec, scene)).release
    ends = [min(end - release, passings[0].window) for end, _, _ in judged(spec, scene, level).parts]
    return tuple(teeth_alone(spec, tuple(_until(one, end) for one in passings), case, level) for end in ends)


def _until(passing: Passing, end: float) -> Passing:
    """The teeth up to a time."""
    if end >= passing.window:
        return passing
    fastest = float(passing.speed(np.linspace(0.0, end, _LOOKS)).max())
    return replace(passing, window=end, fastest=fastest, kinks=tuple(one for one in passing.kinks if one < end))


def run(spec: ChainDrive, scene: Start, carried: frozenset[str], level: int) -> Result:
    """Tensions of a start on the motor curve, with every tooth that passes.

        x = x_d + u(x_d),   m_d x_d'' = e M(t, v) i/R - (S_on - S_off),   v = x_d'

    x is the motion of the entering chain, x_d that of its sprocket, which the motors follow, u the polygon motion, m_d
    the mass of the drive. Chain, drive and motors run together, tooth after tooth, for several places of the first
    joint. Before that a bound is tried, which is the result of the first level where it is finite. It is all there is
    with a screw take-up, where both ends of the chain are on the teeth, with a driven tail, and for starts with very
    many teeth:

        S = S_motor +- (|S_m| + |S_v|),   part by part of the start

    S_motor is the tension of `chain_motor_waves`. S_m and S_v are the tensions that the teeth add, tooth after tooth as
    in `chain_start_teeth`, for a torque that does not depend on the speed and for a constant speed: the tension of
    motors in between does not exceed their sum (`teeth.curve_teeth`). The sprocket turns as that of the rigid chain.
    The teeth of a driven sprocket are counted in this way in each case.

    **Range** as `chain_motor_waves`.
    **Error** samples, neglected modes and sections by bounds, steps by halving, and places of the first joint by the
    difference from half as many; that of `chain_motor_waves` and the sum where the teeth do not run with the motors.
    **Source** derived in `numerics.toothed_modes`; `numerics.run_through`; derived in `teeth.curve_teeth`.
    """
    if level and (found := coupled_teeth(spec, scene, level - 1)) is not None:
        return beyond_slack(spec, _together(spec, scene, level - 1, found), "CHN123")
    bound = beyond_slack(spec, _limiting(spec, scene, min(level, 1)), "CHN123")
    finite = all(one.estimate.bounded for one in bound.loads.values())
    if level or finite or (found := coupled_teeth(spec, scene, 0)) is None:
        return bound
    return beyond_slack(spec, _together(spec, scene, 0, found), "CHN123")


def _together(spec: ChainDrive, scene: Start, level: int, found: Coupled) -> Result:
    """Chain, drive and motors in one run with the teeth; those of a driven sprocket are added to the bar."""
    case = start_case(spec, scene)
    driven = driven_teeth_alone(spec, curve_passings(spec, scene, _MODES << level), case)
    dynamic = found.largest.widened(Interval(-min(driven.entering, found.largest.low), driven.entering))
    above = max(min(driven.added, min(case.line.ends) - found.smallest.high), 0.0)
    smallest = found.smallest.widened(Interval(-driven.taken, above))
    loads = {name: Found(load, {"time": found.time}) for name, load in loads_of(spec, case, dynamic, None).items()}
    loads["tension_min"] = Found(smallest, found.where)
    return Result(
        loads, work=found.steps, window=(0.0, found.end), histories=lambda: _histories(spec, scene, level, found.lead)
    )


def _histories(spec: ChainDrive, scene: Start, level: int, lead: float) -> dict[str, History]:
    """Entering tension over time with the first joint that makes it largest."""
    times, tensions = entering(spec, scene, level, lead)
    shown = np.arange(0, len(times), max(len(times) // SHOWN, 1))
    kept = np.unique(np.concatenate([shown, [int(tensions.argmax()), len(times) - 1]]))
    times, order = np.unique(times[kept], return_index=True)
    seen = start_case(spec, scene).line.run_on + tensions[kept][order]
    return {"tension_start": History(units.FORCE, times.tolist(), seen.tolist())}


def _limiting(spec: ChainDrive, scene: Start, level: int) -> Result:
    """The bound of both limiting drives."""
    found, case = judged(spec, scene, level), start_case(spec, scene)
    teeth = curve_teeth_simulated(spec, scene, level)
    high = max(part[1] + one.entering for part, one in zip(found.parts, teeth, strict=True))
    low = min(part[2] - one.taken for part, one in zip(found.parts, teeth, strict=True))
    peak, dip = (_part_of(found, time) for time in (found.times[0], found.where["time"]))
    less = min(teeth[peak].entering, found.dynamic.low)
    dynamic = found.dynamic.widened(Interval(-less, max(high - found.dynamic.high, 0.0)))
    top = min(min(case.line.ends), found.smallest.high + teeth[dip].added)
    smallest = found.smallest.widened(Interval(min(low - found.smallest.low, 0.0), max(top - found.smallest.high, 0.0)))
    work = sum(one.work for one in teeth)
    at = {"time": found.times[0]}
    loads = {name: Found(load, at) for name, load in loads_of(spec, case, dynamic, None).items()}
    loads["tension_min"] = Found(smallest, found.where)
    return Result(
        loads,
        work=found.steps + work,
        window=(0.0, found.end),
        histories=lambda: histories(spec, scene, level),
    )


def _part_of(found: Judged, time: float) -> int:
    """The part of the start in which a time is."""
    return next(k for k, (end, _, _) in enumerate(found.parts) if time <= end)


def _cost(spec: ChainDrive, scene: Start, carried: frozenset[str], level: int) -> float:
    together = coupled_cost(spec, scene, level - 1) if level else None
    if together is not None:
        return MOTOR_WAVES.cost(spec, scene, carried, level - 1) + together
    whole = MOTOR_WAVES.cost(spec, scene, carried, min(level, 1))
    for one in curve_passings(spec, scene, _MODES << min(level, 1)):
        whole += _PARTS * cost_of_teeth(spec, one, _ALONG, min(level, 1))
    return whole


_CARRIED = frozenset({"chain_elasticity", "higher_modes", "tooth_passing"})
MOTOR_TEETH: Solver[ChainDrive, Start] = Solver(
    name="chain_motor_teeth",
    title="start on the motor curve, modes of chain and drive with polygon excitation",
    fidelity=Fidelity.TRANSIENT,
    scenes=frozenset({Start}),
    represents=_CARRIED,
    gives=frozenset(TENSIONS),
    run=run,
    cost=_cost,
    source="derived in ptmcalc.numerics.toothed_modes and ptmcalc.numerics.run_through",
    valid=valid,
    always=_CARRIED,
    levels=3,
)
