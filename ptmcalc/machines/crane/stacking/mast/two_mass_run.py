"""The column as two coupled masses: consistent masses of its static shape, exactly from event to event."""

import math
from collections.abc import Mapping

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Event, Finding, Found, History, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.crane.stacking.machine.columns import swinging
from ptmcalc.machines.crane.stacking.machine.scenes import Brake, DrivenScene, Start
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.machine.travelling import evenly, push_of
from ptmcalc.machines.crane.stacking.mast import march
from ptmcalc.machines.crane.stacking.mast.names import FLEXIBLE, GRAVITY, HOLDING, MASS
from ptmcalc.machines.crane.stacking.mast.resting import at_rest
from ptmcalc.machines.crane.stacking.mast.two_mass import course_of
from ptmcalc.machines.crane.stacking.strength.derived import DERIVED, with_derived
from ptmcalc.numerics.mast.run import Course

ALWAYS = frozenset({FLEXIBLE, MASS, HOLDING})
_ROUNDING = 1e-9
"""Relative error bar [1] of the two-mass motion, which is exact but for rounding. A numerical choice: it is above the
rounding of a run; a larger value widens every bar. The model error is the bound of the higher modes."""
_CLOSES = 1e-8
"""Largest relative residual [1] of the energy balance, as in `mast_modal`. A numerical choice: above it NUM101 is
reported and the error bar is unbounded."""


def run(spec: Stacker, scene: DrivenScene, carried: frozenset[str], level: int) -> Result:
    """Motion of the load relative to the base, from the beginning of a start or stop until several oscillations after
    it.

        m_22 x'' + b x' + c x = -(m_12 + m_22) u'',   (m_11 + 2 m_12 + m_22) u'' + (m_12 + m_22) x'' = P(t)

    The base slips or is held by a brake or a speed-controlled drive; each change and each peak is a root of the exact
    motion. The moment is that of the inertia forces of mast and load.

    **Range** the deflection shape of a force at the tip; no top guide.
    **Error** rounding for two masses, verified by the energy balance; the bound of the higher modes covers the assumed
    shape.
    **Source** lecture notes Kramatorsk 2007 (two masses); consistent masses (`laws.mast`); `numerics.mast`.
    """
    if push_of(spec, scene).size <= 0:  # the drive stalls: nothing moves
        return Result({}, work=1)
    course = course_of(spec, scene, GRAVITY in carried)
    stiffness = swinging(spec, scene).stiffness
    value, time = course.largest("deflection")
    moment, when = course.largest("moment")
    found = {
        "mast_deflection_max": Found(_told(value), {"time": time}),
        "mast_force_max": Found(_told(stiffness * value), {"time": time}),
        "mast_moment_max": Found(_told(moment), {"time": when}),
        **_settling(spec, scene, course),
    }
    findings = []
    if course.residual > _CLOSES:
        text = (
            f"scene `{scene.label}`: the energy balance has a residual of {course.residual:.1e}: no number is reliable"
        )
        findings.append(Finding("NUM101", text))
        found = {name: Found(Estimate.unknown(one.estimate.value), one.at, one.note) for name, one in found.items()}
    return Result(
        with_derived(spec, scene, found),
        work=course.record.steps,
        window=(0.0, course.record.time),
        health={"energy_residual": course.residual, "steps": float(course.record.steps)},
        findings=tuple(findings),
        events=tuple(Event(float(e.time), e.element, e.before, e.after) for e in course.record.events),
        histories=lambda: _histories(spec, scene, GRAVITY in carried),
    )


def _told(value: float) -> Estimate:
    return Estimate.within(value, _ROUNDING * abs(value))


def _settling(spec: Stacker, scene: DrivenScene, course: Course) -> dict[str, Found]:
    """From the standstill of the base until the far end stays in the window."""
    window = spec.settling.window
    if window is None or spec.column.log_decrement is None or not isinstance(scene, Brake):
        return {}
    if not course.stays:
        return {"settling_time": Found(Estimate.unknown(math.inf), note="the base is not yet held permanently")}
    found = at_rest(spec, scene, course, window)
    if math.isinf(found.time):
        return {"settling_time": Found(Estimate.exact(math.inf), note=found.reason)}
    return {"settling_time": Found(Estimate(found.time, found.low, found.high, numerical=found.high - found.low))}


def _histories(spec: Stacker, scene: DrivenScene, gravity: bool) -> Mapping[str, History]:
    course = course_of(spec, scene, gravity, keep=True)
    stiffness = swinging(spec, scene).stiffness
    times, deflections = course.over_time("deflection")
    at = times.tolist()
    return {
        "mast_deflection_max": History(units.LENGTH, at, deflections.tolist()),
        "mast_force_max": History(units.FORCE, at, (stiffness * deflections).tolist()),
        "mast_moment_max": History(units.TORQUE, at, course.over_time("moment")[1].tolist()),
    }


def valid(spec: Stacker, scene: DrivenScene) -> Criterion | None:
    """A column that bends, whose head is free, and that its weights do not buckle.

    **Range** every start and stop.
    **Error** none.
    **Source** the shape it keeps to.
    """
    guide = spec.column.top_guide
    if guide is not None and guide.stiffness is not None:
        return Criterion("k_g", 1.0, 1.0, "the top guide excludes a single deflection shape", "the file")
    return evenly(spec, scene)


def _cost(spec: Stacker, scene: DrivenScene, carried: frozenset[str], level: int) -> float:
    moves = march.happening(spec, scene, gravity=False)
    swings = moves.lasts * math.sqrt(moves.column.stiffness / moves.column.total)
    return 5e-3 + 1e-5 * min(swings, 1e6)


MAST_TWO_MASS: Solver[Stacker, DrivenScene] = Solver(
    name="mast_two_mass",
    title="mast start or stop, two-mass model",
    fidelity=Fidelity.MODAL,
    scenes=frozenset({Start, Brake}),
    represents=ALWAYS | {GRAVITY},
    gives=frozenset({"mast_deflection_max", "mast_force_max", "mast_moment_max", "settling_time"}) | DERIVED,
    run=run,
    cost=_cost,
    valid=valid,
    source="lecture notes Kramatorsk 2007; consistent masses of the static shape; `numerics.mast`",
    always=ALWAYS,
)
