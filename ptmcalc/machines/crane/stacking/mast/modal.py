"""The column in finite elements and modes, marched through drive, brake, standstill and contact."""

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from ptmcalc.base import units
from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Estimate
from ptmcalc.base.memory import remembered
from ptmcalc.contract.result import Event, Finding, Found, History, Result, of
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.crane.stacking.machine import model
from ptmcalc.machines.crane.stacking.machine.loads import MODES
from ptmcalc.machines.crane.stacking.machine.scenes import Brake, ObstacleScene, StackerScene, Stand, Start
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.machine.travelling import evenly
from ptmcalc.machines.crane.stacking.mast import march
from ptmcalc.machines.crane.stacking.mast.march import Built, Happening
from ptmcalc.machines.crane.stacking.mast.modal_readings import (
    Played,
    blow_loads,
    settling,
    stands_at_once,
    swing_loads,
)
from ptmcalc.machines.crane.stacking.mast.names import CONTACT, FLEXIBLE, GRAVITY, GUIDE, HOLDING, MASS
from ptmcalc.machines.crane.stacking.mast.names import MODES as MODES_HIGHER
from ptmcalc.machines.crane.stacking.strength.derived import DERIVED, with_derived
from ptmcalc.numerics.mast.modes import Mast, frequencies, speed_left_out, wanted
from ptmcalc.numerics.mast.parts import Column
from ptmcalc.numerics.mast.run import Course, play
from ptmcalc.numerics.record import MOST_KEPT, most_work, too_much_memory
from ptmcalc.spec.scene import Scene

ALWAYS = frozenset({FLEXIBLE, MASS})
MODES_FIRST, MODES_MOST, LEVELS = 4, 8, 3
"""Modes at the coarsest refinement, for a load that comes at once and at most; how often they are doubled, less one."""
_ELEMENTS = 3
"""Elements per mode."""
_CLOSES = 1e-8
"""Largest relative residual [1] of the energy balance. A numerical choice: it is above the rounding of a run and below
the accuracy of any input. Above it NUM101 is reported and the error bar is unbounded."""
_FAINT = 1e-9
"""Share of the lowest mode's deflection below which a mode is not followed; what it adds is in the bar."""
_SWINGS = 3.0
"""Periods of the column beside a base at rest that are looked at after the event."""
_BLOW = 1.5
"""Periods of everything against the column in which a collision is looked at."""
_COMPARED = 0.7
"""Panels of the run that a bar is found with, over the usual ones."""
_DOUBLINGS = 5
"""Most extensions [1] of the simulated time until the base is held permanently; each doubles it while no end is known.
A numerical choice: fewer report a late standstill as missing, more allow longer runs."""
_FREQUENCIES = 16
"""Beam elements [1] for the lowest frequencies and the stiffness of the mast; the error bar compares another number of
elements. A numerical choice: more elements narrow the bar, but rounding grows with the fourth power of their number."""


def run(spec: Stacker, scene: StackerScene, carried: frozenset[str], level: int) -> Result:
    """Mast motion relative to its base, from the beginning of an event until several oscillations after it.

        M w'' + C w' + (K + K_weights) w = -M 1 a + forces,   m a + (M 1)^T w'' = drive + friction + contact

    The base slips or is held (by a brake or a speed-controlled drive); contacts open and close. Each change of state is
    a root of the exact motion; peaks are roots too. A base on a speed ramp follows the ramp.

    **Range** small deflections of slender columns; a drive or brake whose force depends on time alone.
    **Error** numerical: three times the difference to half as many elements and modes, plus the bound of the neglected
    modes for a sudden load. Maxima also include the sum of all modes in phase after the run, with the base held
    permanently.
    **Source** `numerics.mast`; lecture notes Kramatorsk 2007 for the underlying two-mass equations.
    """
    gravity = GRAVITY in carried
    if isinstance(scene, Stand):
        return Result(_of_the_column(march.built(spec, scene, gravity=gravity), math.inf), work=_FREQUENCIES)
    moves = march.happening(spec, scene, gravity=gravity)
    modes = followed(moves, level)
    if _panels(moves, modes, scene) > MOST_KEPT:
        raise too_much_memory(moves.lasts)
    most = most_work(_seconds(scene, moves, modes, level))
    course, other, nudged = _runs(moves, spec.column.log_decrement, model.window_factor(scene), modes, most)
    fine, coarse = Played(moves, course, nudged), Played(moves, other)
    found = _of_the_column(moves.column, moves.rolling)
    if isinstance(scene, ObstacleScene):
        found |= blow_loads(fine, coarse)
    else:
        found |= swing_loads(scene, fine, coarse)
        found |= settling(spec, scene, fine, coarse)
    residual = max(course.residual, other.residual)
    findings = list(_remarks(scene, fine))
    if residual > _CLOSES:
        findings.append(
            Finding(
                "NUM101",
                f"scene `{scene.label}`: the energy balance has a residual of {residual:.1e}: no number is reliable",
            )
        )
        found = {name: Found(Estimate.unknown(one.estimate.value), one.at, one.note) for name, one in found.items()}
    return Result(
        with_derived(spec, scene, found),
        work=course.record.steps + other.record.steps,
        window=(0.0, course.record.time),
        health={"energy_residual": residual, "steps": float(course.record.steps)},
        findings=tuple(findings),
        events=tuple(Event(float(e.time), e.element, e.before, e.after) for e in course.record.events),
        histories=lambda: _histories(spec, scene, moves, level, course.record.time),
    )


def followed(moves: Happening, level: int) -> int:
    """Modes that are followed at a refinement, even in number: half of them are at least those up to 5/rise in Hz, and
    no more than move anything: those of a column of a gram are so fast and so faint that nobody would see them."""
    modes = MODES_FIRST
    if moves.rise > 0:
        values = frequencies(moves.column.column, MODES_MOST // 2, moves.rolling, MODES_MOST).values
        modes = min(max(2 * wanted(values, moves.rise), MODES_FIRST), MODES_MOST)
    modes <<= level
    place = moves.column.column.length
    mast = Mast.of(moves.column.column, _ELEMENTS * modes, (place,))
    gives = np.abs(mast.at(place) * mast.participation) / mast.frequencies**2
    return min(modes, 2 * int((gives > _FAINT * gives[0]).sum()))


Nudged = tuple[Course | None, Course | None]


@remembered(16)
def _runs(
    moves: Happening, decrement: float | None, factor: float, modes: int, most: float
) -> tuple[Course, Course, Nudged]:
    """The run, the same with half as many modes, and with a little less and more speed; a machine that differs in
    nothing that moves has the same."""
    course = _play(moves, decrement, modes, factor, most)
    coarser = march.case_of(moves, decrement, _ELEMENTS * (modes // 2), modes // 2)
    other = play(coarser, course.record.time, _COMPARED, most_work=most)
    return course, other, _nudged(moves, course, most)


def _play(moves: Happening, decrement: float | None, modes: int, factor: float, most: float) -> Course:
    """One run until the event is over and some swings after it; given up after so many panels."""
    case = march.case_of(moves, decrement, _ELEMENTS * modes, modes)
    after = factor * _SWINGS * 2 * math.pi / float(case.mast.frequencies[0])
    if moves.obstacle is not None:
        swing = 2 * math.pi * math.sqrt(moves.column.total / moves.column.stiffness)
        return play(case, factor * _BLOW * swing, most_work=most)
    end = moves.lasts + after
    course = play(case, end, most_work=most)
    for _ in range(_DOUBLINGS):
        since = course.held_since
        if since + after <= course.record.time * (1 + 1e-9):
            break
        end = since + after if math.isfinite(since) else 2 * end
        course = play(case, end, most_work=most)
    return course


def _of_the_column(built: Built, base: float) -> dict[str, Found]:
    """Stiffness at the far end, with the weights of the run and without a guide, and the lowest frequencies, over a
    base that is held or rolls."""
    found = _stiffness(replace(built.column, props=()))
    lowest = frequencies(built.column, len(MODES), base, _FREQUENCIES)
    for mode, value, doubt in zip(MODES, lowest.values.tolist(), lowest.bars.tolist(), strict=False):
        found[of("natural_frequency", mode)] = Found(Estimate.within(value, doubt))
        if mode == MODES[0]:
            swing = 2 * math.pi / value
            found["period"] = Found(Estimate.within(swing, 2 * math.pi / (value - doubt) - swing))
    return found


def _stiffness(free: Column) -> dict[str, Found]:
    """Of a column whose head is free; nothing where only its guide keeps it from buckling."""
    try:
        fine, coarse = (Mast.of(free, count, (free.length,)) for count in (_FREQUENCIES, _FREQUENCIES // 2))
    except NumericsError:
        return {}
    stiffness, other = (1 / mast.gives(free.length, free.length) for mast in (fine, coarse))
    bar = abs(stiffness - other) + 1e-9 * stiffness
    return {"column_stiffness": Found(Estimate.within(stiffness, bar))}


def _nudged(moves: Happening, course: Course, most: float) -> Nudged:
    """The same run of a base that has a little less speed to win or to lose, and a little more.

    When it stands, or has its speed, decides in which swing of the column it is held, and whether it slips again: what
    the modes left out may add to its speed is then in all that comes after.
    """
    if moves.follows or moves.obstacle is not None or not moves.base.grips:
        return None, None
    jolt = speed_left_out(course.case.mast, moves.base.mass, course.system.count, moves.rise, moves.jump)
    found = []
    for more in (-jolt, jolt):
        base, (grip,) = moves.base, moves.base.grips
        speed = (base.speed or grip.speed) + more
        if base.speed:
            base = replace(base, speed=speed)
        else:
            base = replace(base, grips=(replace(grip, speed=speed),))
        found.append(play(replace(course.case, base=base), course.record.time, most_work=most) if speed > 0 else None)
    return found[0], found[1]


def _remarks(scene: StackerScene, fine: Played) -> list[Finding]:
    """What happened on the way that a reader must know."""
    course, said = fine.course, []
    if isinstance(scene, Start | Brake) and not fine.moves.follows and math.isinf(course.held_since):
        what = "reached its speed" if isinstance(scene, Start) else "come to rest"
        said.append(
            Finding(
                "NUM103", f"scene `{scene.label}`: by {course.record.time:.3g} s the base has not {what} permanently"
            )
        )
    first = course.first("base", "at rest") if isinstance(scene, Brake) and not fine.moves.follows else math.inf
    if math.isfinite(first) and math.isfinite(course.held_since) and not stands_at_once(course):
        text = (
            f"scene `{scene.label}`: the oscillating mast pulls the base through its brake: standstill at"
            f" {first:.3g} s, permanently at {course.held_since:.3g} s"
        )
        damps = "" if course.stays else "the damping of the mast, `column.log_decrement`, determines when it ends"
        said.append(Finding("NUM110", text, hint=damps))
    return said


def _histories(spec: Stacker, scene: StackerScene, moves: Happening, level: int, end: float) -> Mapping[str, History]:
    """Deflection, force and moment over time, from a run that keeps them."""
    modes = followed(moves, level)
    case = march.case_of(moves, spec.column.log_decrement, _ELEMENTS * modes, modes)
    course = play(case, end, keep=True)
    times, deflections = course.over_time("deflection")
    force = (deflections * moves.column.stiffness).tolist()
    at = times.tolist()
    if isinstance(scene, ObstacleScene):
        contact = course.over_time("contact")[1].tolist()
        return {
            "collision_deflection": History(units.LENGTH, at, deflections.tolist()),
            "collision_force": History(units.FORCE, at, force),
            "contact_force": History(units.FORCE, at, contact),
        }
    return {
        "mast_deflection_max": History(units.LENGTH, at, deflections.tolist()),
        "mast_force_max": History(units.FORCE, at, force),
        "mast_moment_max": History(units.TORQUE, at, course.over_time("moment")[1].tolist()),
    }


def _cost(spec: Stacker, scene: StackerScene, carried: frozenset[str], level: int) -> float:
    """Seconds of a run and of the one its bars are found with."""
    if isinstance(scene, Stand):
        return 0.02
    moves = march.happening(spec, scene, gravity=False)
    try:
        modes = followed(moves, level)
    except NumericsError:  # it has no modes, as its run will say at once
        return 0.04
    return _seconds(scene, moves, modes, level)


def _panels(moves: Happening, modes: int, scene: StackerScene) -> float:
    """Panels in which some mode that rings on could still have its summit: about eight to a radian of the slowest."""
    factor = model.window_factor(scene)
    return 8 * modes * factor * moves.lasts * math.sqrt(moves.column.stiffness / moves.column.total)


def _seconds(scene: StackerScene, moves: Happening, modes: int, level: int) -> float:
    """By the swings of the modes in the time that is looked at: fast ones are passed over by long panels; a point that
    stops dead is struck again by every mode."""
    slowest = math.sqrt(moves.column.stiffness / moves.column.total)
    if moves.obstacle is not None and math.isinf(moves.obstacle.stiffness):
        return 0.04 * math.pow(modes / MODES_FIRST, 2.5)
    runs = (
        1 if moves.follows or moves.obstacle is not None else 2
    )  # two more of a base that is as fast, but for a little
    return runs * 0.04 * (1 + level) + runs * 1e-3 * modes * (1 + (moves.lasts * slowest + 20) / 20)


def _solver(
    name: str,
    title: str,
    scenes: frozenset[type[Scene]],
    always: frozenset[str],
    gives: frozenset[str],
    levels: int,
    fidelity: Fidelity = Fidelity.TRANSIENT,
) -> Solver[Stacker, StackerScene]:
    return Solver(
        name=name,
        title=title,
        fidelity=fidelity,
        scenes=scenes,
        represents=always | {GRAVITY},
        gives=gives | {"column_stiffness", "natural_frequency", "period"} | DERIVED,
        run=run,
        cost=_cost,
        source="finite elements of Euler and Bernoulli; exact propagation between events (`numerics.mast`)",
        valid=evenly,
        always=always,
        levels=levels,
    )


MAST_MODAL = _solver(
    "mast_modal",
    "mast start or stop, finite-element modes",
    frozenset({Start, Brake}),
    ALWAYS | {MODES_HIGHER, HOLDING, GUIDE},
    frozenset(
        {"start_time", "brake_time", "settling_time", "mast_deflection_max", "mast_force_max", "mast_moment_max"}
    ),
    LEVELS,
)
COLLISION_MODAL = _solver(
    "collision_modal",
    "collision with an obstacle, finite-element modes",
    frozenset({ObstacleScene}),
    ALWAYS | {CONTACT},
    frozenset({"collision_force", "collision_deflection", "mast_moment_max", "contact_force"}),
    LEVELS,
)
STANDING_MODAL = _solver(
    "standing_modal",
    "mast frequencies, finite elements",
    frozenset({Stand}),
    frozenset(),
    frozenset(),
    1,
    Fidelity.MODAL,
)
