"""A start on the motor curve with the teeth that pass during it."""

from dataclasses import replace

import numpy as np

from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Interval
from ptmcalc.base.memory import kept_for
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.chain_drive.spec import ChainDrive, Start
from ptmcalc.machines.chain_drive.speed_change.teeth import Passing, curve_passings
from ptmcalc.machines.chain_drive.speed_change.tooth_passes import (
    TeethAlone,
    cost_of_teeth,
    teeth_alone,
)
from ptmcalc.machines.chain_drive.starting.bounds import TENSIONS, loads_of
from ptmcalc.machines.chain_drive.starting.motion import start_case
from ptmcalc.machines.chain_drive.starting.motor_curve_waves import MOTOR_WAVES, Judged, histories, judged, valid
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


@kept_for(16)
def curve_teeth_simulated(spec: ChainDrive, scene: Start, level: int) -> tuple[TeethAlone, ...]:
    """What the teeth of a start on a motor curve change, from its beginning up to the end of each of its parts.

    Raises:
        NumericsError: NUM102 where the rigid chain is not followed.
    """
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

        S = S_motor +- (|S_m| + |S_v|),   part by part of the start

    S_motor is the tension of `chain_motor_waves`. S_m and S_v are the tensions that the teeth add, tooth after tooth as
    in `chain_start_teeth`, for a torque that does not depend on the speed and for a constant speed: the tension of
    motors in between does not exceed their sum (`teeth.curve_teeth`). The sprocket turns as that of the rigid chain.

    **Range** as `chain_motor_waves`.
    **Error** that of `chain_motor_waves`, and the sum of both.
    **Source** `chain_motor_waves`; `numerics.run_through`; derived in `teeth.curve_teeth`.
    """
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
    result = Result(
        loads,
        work=found.steps + work,
        window=(0.0, found.end),
        histories=lambda: histories(spec, scene, level),
    )
    return beyond_slack(spec, result, "CHN123")


def _part_of(found: Judged, time: float) -> int:
    """The part of the start in which a time is."""
    return next(k for k, (end, _, _) in enumerate(found.parts) if time <= end)


def _cost(spec: ChainDrive, scene: Start, carried: frozenset[str], level: int) -> float:
    whole = MOTOR_WAVES.cost(spec, scene, carried, level)
    for one in curve_passings(spec, scene, _MODES << level):
        whole += _PARTS * cost_of_teeth(spec, one, _ALONG, level)
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
    source="derived in ptmcalc.numerics.driven_modes and ptmcalc.numerics.run_through",
    valid=valid,
    always=_CARRIED,
    levels=2,
)
