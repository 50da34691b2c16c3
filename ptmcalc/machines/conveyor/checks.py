"""The checks of a conveyor."""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import AnyCheck, Check, LimitState, Sense, needs, no_needs, no_repair
from ptmcalc.contract.result import of
from ptmcalc.machines.conveyor.brakes import brakes_of, braking
from ptmcalc.machines.conveyor.drives import moving_mass, running
from ptmcalc.machines.conveyor.holding.scenes import asks_for_hold
from ptmcalc.machines.conveyor.model import belt_line, starting_force
from ptmcalc.machines.conveyor.running.belt_safety import safety_limit, safety_needs, strength_key
from ptmcalc.machines.conveyor.running.checks_belt import CHECKS_OF_THE_BELT
from ptmcalc.machines.conveyor.running.checks_motor import CHECKS_OF_THE_DRIVE
from ptmcalc.machines.conveyor.spec import (
    IN_MOTION,
    Backstop,
    Coast,
    Conveyor,
    ConveyorScene,
    Drive,
    EmergencyStop,
    Hold,
    Jam,
    Run,
    Start,
    Stop,
)
from ptmcalc.machines.conveyor.starting.checks import CHECKS_OF_THE_START, starting_torque_key

Loads = Mapping[str, Estimate]
Checks = Iterable[AnyCheck]
ANY_MOTION = IN_MOTION | {Run}
_GRIPPING = ANY_MOTION - {Jam}
"""Scenes in which a drum has to hold the belt: over a jammed one it must slip."""

_LEAST_WRAP = 2.8  # rad, 160 deg
_LEAST_GRIP = 0.6931471805599453  # mu alpha = ln 2: below it the drum transmits less than the run-off tension
_NO_RESERVE = math.nextafter(1, 0)  # just below any k_T
_HOUR = 3600.0
_STRONG_START = 1.5  # starting force over static resistance: the usual upper end of practice

_TENSION: KeyPath = ("takeup", "tension")


def _takeup_tension(spec: Conveyor, scene: ConveyorScene) -> KeyPath:
    return _TENSION


def _blame_tension(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> KeyPath:
    return _TENSION


# -- belt slip -----------------------------------------------------------------------------------------------------


def _slip_limit(spec: Conveyor, scene: ConveyorScene) -> Estimate:
    """k_T of the file.

    **Range** at least 1.
    **Error** none: a chosen limit.
    **Source** lecture notes Kramatorsk 2007: 1.1 to 1.5; 1.2 is the usual value of handbooks.
    """
    return Estimate.exact(spec.checks.slip.reserve)


def _slip_value(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> Estimate:
    """The reserve of grip by the definition of the file: of force, or of the ratio of tensions (1/U).

    The reserve of force leaves out the centrifugal tension; a belt at U = 1 slips whatever it says, and has none.

    **Range** any state of the drum; infinite where it transmits nothing.
    **Error** that of the load.
    **Source** `laws.capstan`.
    """
    used = loads["slip_utilisation_max"]
    if spec.checks.slip.definition == "force":
        left = loads["slip_reserve_min"]
        value, low, high = (
            min(reserve, _NO_RESERVE) if state >= 1 else reserve
            for reserve, state in ((left.value, used.value), (left.low, used.high), (left.high, used.low))
        )
        return Estimate(value, low, high, left.numerical, left.model)
    value, low, high = (_inverse(part) for part in (used.value, used.high, used.low))
    return Estimate(value, low, high, used.numerical / used.value**2, used.model / used.value**2)


def _inverse(value: float) -> float:
    return 1 / value if value > 0 else float("inf")


def _blame_slip(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> KeyPath:
    """The key that stands out: a small wrap, a poor friction, a violent start; else the take-up tension."""
    return _blame_grip(spec, scene, spec.main_path, spec.main_drive)


def _blame_grip(spec: Conveyor, scene: ConveyorScene, path: KeyPath, drive: Drive) -> KeyPath:
    drum = drive.drum
    if drum.wrap < _LEAST_WRAP:
        return (*path, "drum", "wrap")
    if drum.friction is not None and drum.friction * drum.wrap < _LEAST_GRIP:
        return (*path, "drum", "friction")
    if isinstance(scene, Start) and starting_force(spec) > _STRONG_START * max(
        belt_line(spec, scene).static_resistance, 0
    ):
        return _TENSION if scene.profile.imposes_speed else starting_torque_key(spec, path)
    if isinstance(scene, Stop | EmergencyStop) and (acting := brakes_of(spec, scene)):
        return ("brakes", max(acting, key=lambda name: braking(spec, acting[name]).force), "torque")
    return _TENSION


def _slip_checks(spec: Conveyor, scene: ConveyorScene) -> Iterator[Check[Conveyor, ConveyorScene]]:
    """The drum's own, or one for each drum where there are several."""
    if len(spec.all_drives) == 1:
        yield SLIP
        return
    for name, drive in spec.all_drives.items():
        path = spec.drive_path(name)
        used, left = of("slip_utilisation_max", name), of("slip_reserve_min", name)
        yield replace(
            SLIP,
            each=None,
            element=name,
            loads=(left, used),
            value=_slip_value_of(left, used),
            needs=needs((*path, "drum", "friction")),
            blame=_blames_grip(path, drive),
        )


def _slip_value_of(left: str, used: str) -> Callable[[Conveyor, ConveyorScene, Loads], Estimate]:
    def value(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> Estimate:
        return _slip_value(spec, scene, {"slip_reserve_min": loads[left], "slip_utilisation_max": loads[used]})

    return value


def _blames_grip(path: KeyPath, drive: Drive) -> Callable[[Conveyor, ConveyorScene, Loads], KeyPath]:
    return lambda spec, scene, loads: _blame_grip(spec, scene, path, drive)


SLIP: Check[Conveyor, ConveyorScene] = Check(
    code="CNV101",
    title="drive pulley traction reserve",
    question="Can every drive pulley transmit its force without belt slip?",
    failure="traction reserve at the drive pulley is too small",
    limit_state=LimitState("belt slips at the drive pulley", 1),
    scenes=_GRIPPING,
    loads=("slip_reserve_min", "slip_utilisation_max"),
    value=_slip_value,
    sense=Sense.AT_LEAST,
    limit=_slip_limit,
    needs=lambda spec, scene: ((*spec.main_path, "drum", "friction"),),
    blame=_blame_slip,
    repair=_takeup_tension,
    each=_slip_checks,
    what="The traction of every drive pulley exceeds the force that it transmits by the reserve k_T. The criterion"
    " applies at every moment and in both directions of the force.",
    why="A slipping belt wears the pulley lagging, overheats and can burn. Slip does not end by itself.",
    formula="k = S_slack (exp(mu alpha) - 1)/(S_tight - S_slack) >= k_T, and U < 1   (definition `force`)\n"
    "1/U >= k_T,  U = (S_tight - rho_B v^2)/((S_slack - rho_B v^2) exp(mu alpha))   (definition `ratio`)",
    source="Euler-Eytelwein; k_T 1.1 to 1.5, lecture notes Kramatorsk 2007; 1.2 in handbooks",
)

# -- belt strength --------------------------------------------------------------------------------------------------


STRENGTH: Check[Conveyor, ConveyorScene] = Check(
    code="CNV102",
    title="belt safety factor",
    question="Is the belt breaking force high enough for the largest belt tension?",
    failure="belt is overloaded",
    limit_state=LimitState("belt breaks", 1),
    scenes=ANY_MOTION,
    loads=("belt_safety_min",),
    sense=Sense.AT_LEAST,
    limit=safety_limit,
    needs=safety_needs,
    blame=lambda spec, scene, loads: strength_key(spec, scene),
    repair=strength_key,
    what="The breaking force of the belt is at least the safety factor times the maximum tension of any section.",
    why="A broken belt runs off the conveyor. Splices fail first, by fatigue.",
    formula="breaking force / S_max >= safety",
    source="DIN 22101:1982-02 as quoted by belt makers: 8.0/5.4 textile, 6.7/4.8 steel cord (running/starting)",
)

# -- sag ------------------------------------------------------------------------------------------------------------


def _sag_limit(spec: Conveyor, scene: Run) -> Estimate:
    """Largest sag over idler pitch of the file, 1 % by default.

    **Range** steady running; more is allowed for a moment.
    **Error** none: a chosen limit.
    **Source** DIN 22101: at most 1 % in steady running.
    """
    return Estimate.exact(spec.checks.sag)


def _idler_pitches(spec: Conveyor, scene: ConveyorScene) -> tuple[KeyPath, ...]:
    return (("idlers", "carry", "pitch"), ("idlers", "return", "pitch"))


SAG: Check[Conveyor, Run] = Check(
    code="CNV103",
    title="belt sag between idlers, steady running",
    question="Is the belt sag ratio within its limit in steady running?",
    failure="belt sags too much between the idlers",
    scenes=frozenset({Run}),
    loads=("sag_relative_max",),
    sense=Sense.AT_MOST,
    limit=_sag_limit,
    needs=_idler_pitches,
    blame=_blame_tension,
    repair=_takeup_tension,
    what="In steady running, the sag ratio of the belt between any two idlers is at most the limit.",
    why="Excessive sag spills the load, flexes the load at every idler and increases the power demand.",
    formula="w l/(8 S_min) <= limit",
    source="DIN 22101: at most 1 % in steady running",
)

# -- start ----------------------------------------------------------------------------------------------------------


def _start_limit(spec: Conveyor, scene: Start) -> Estimate:
    """The starting force must reach the force needed.

    **Range** any start.
    **Error** none.
    **Source** Newton's law.
    """
    return Estimate.exact(1.0)


START: Check[Conveyor, Start] = Check(
    code="CNV104",
    title="starting force reserve",
    question="Can the drives start the loaded belt?",
    failure="starting force is below the required force",
    scenes=frozenset({Start}),
    loads=("starting_reserve",),
    sense=Sense.AT_LEAST,
    limit=_start_limit,
    needs=no_needs,
    blame=lambda spec, scene, loads: starting_torque_key(spec),
    repair=lambda spec, scene: () if (key := starting_torque_key(spec))[-1] == "curve" else key,
    what="With a torque profile, the mean starting force at the pulley surface exceeds the static resistance. With an"
    " imposed speed, it exceeds the force that the profile requires.",
    why="A drive that cannot move the belt stalls, and its motors overheat.",
    formula="n M i eta/R > W   (torque)      n M i eta/R >= max(m a + S_on - S_off)   (imposed speed)",
    source="lecture notes Kramatorsk 2007",
)

# -- slack ----------------------------------------------------------------------------------------------------------


def _slack_limit(spec: Conveyor, scene: ConveyorScene) -> Estimate:
    """Nothing may be missing to the tension at which the belt counts as slack.

    **Range** with idler pitches given: 10 % sag by default, where the parabola ends; else no tension at all.
    **Error** none: a chosen limit.
    **Source** validity of the shallow parabola (`laws.sag.sag_ratio`), an engineering choice.
    """
    return Estimate.exact(0.0)


SLACK: Check[Conveyor, ConveyorScene] = Check(
    code="CNV105",
    title="belt tension above slack limit",
    question="Does every belt section stay above the slack limit (10 % sag by default)?",
    failure="belt tension falls below the slack limit",
    scenes=ANY_MOTION,
    loads=("slack_margin_min",),
    sense=Sense.AT_LEAST,
    limit=_slack_limit,
    needs=no_needs,
    blame=_blame_tension,
    repair=_takeup_tension,
    what="At every moment, the tension of every belt section is at least the slack limit.",
    why="A slack belt lifts off its idlers, folds and runs off. An impact loads it when it becomes taut again.",
    formula="S_min - w l/(8 h_slack) >= 0 on either strand   (h_slack 10 %; without idler pitches S_min >= 0)",
    source="shallow parabola; slack as the end of the linear belt, lecture notes Kramatorsk 2007",
)

# -- stop -----------------------------------------------------------------------------------------------------------


def _stop_limit(spec: Conveyor, scene: ConveyorScene) -> Estimate:
    """Longest way of the file, by the kind of stop.

    **Range** a stop or an emergency stop with a limit.
    **Error** none: a chosen limit.
    **Source** the plant's safety rules.
    """
    return Estimate.exact(spec.stop_distance_limit(scene) or math.inf)


def _only_with(
    check: str, limit: Callable[[Conveyor, ConveyorScene], float | None]
) -> Callable[[Conveyor, ConveyorScene], Checks]:
    """The check itself where the file gives its limit."""

    def each(spec: Conveyor, scene: ConveyorScene) -> Checks:
        return (_BY_CODE[check],) if limit(spec, scene) is not None else ()

    return each


def _brake_key(spec: Conveyor, scene: ConveyorScene) -> KeyPath:
    acting = brakes_of(spec, scene)
    if not acting:
        return ("brakes",)
    return ("brakes", max(acting, key=lambda name: braking(spec, acting[name]).force), "torque")


def _brake_repair(spec: Conveyor, scene: ConveyorScene) -> KeyPath:
    return _brake_key(spec, scene) if brakes_of(spec, scene) else ()


def _time_key(spec: Conveyor, scene: ConveyorScene) -> KeyPath:
    """What must hold the belt: its strongest brake; without one the limit that no brake was asked to keep."""
    if brakes_of(spec, scene) or spec.checks.stop_time is None:
        return _brake_key(spec, scene)
    return ("checks", "stop_time")


def _stop_key(spec: Conveyor, scene: ConveyorScene) -> KeyPath:
    """The latest brake's delay or rise, where full torque from the first moment would stop the rigid body in time; else
    the strongest brake's torque."""
    acting, limit = brakes_of(spec, scene), spec.stop_distance_limit(scene)
    line = running(spec, scene)
    force = line.static_resistance + line.tail_pull + sum(braking(spec, brake).force for brake in acting.values())
    if acting and limit is not None and moving_mass(line) * line.speed**2 <= 2 * force * limit:
        name = max(acting, key=lambda name: acting[name].delay + acting[name].rise_time / 2)
        late = acting[name]
        if late.delay or late.rise_time:
            return ("brakes", name, "delay" if late.delay >= late.rise_time / 2 else "rise_time")
    return _brake_key(spec, scene)


def _stop_repair(spec: Conveyor, scene: ConveyorScene) -> KeyPath:
    return _stop_key(spec, scene) if brakes_of(spec, scene) else ()


STOP: Check[Conveyor, ConveyorScene] = Check(
    code="CNV106",
    title="belt stopping distance",
    question="Does the belt at the head stop within the permissible distance?",
    failure="belt stopping distance is too long",
    scenes=frozenset({Stop, EmergencyStop}),
    loads=("stop_distance_max",),
    sense=Sense.AT_MOST,
    limit=_stop_limit,
    needs=no_needs,
    blame=lambda spec, scene, loads: _stop_key(spec, scene),
    repair=_stop_repair,
    each=_only_with("CNV106", Conveyor.stop_distance_limit),
    what="Every point of the belt stops within the distance given in the file. The criterion applies at the head, at"
    " the tail and between them.",
    why="A long stopping distance overfills the chute below and endangers persons caught by the belt. The tail of a"
    " long belt continues at full speed until the wave of the brake arrives.",
    formula="max over the belt of the integral of v dt until v = 0 <= limit",
    source="the plant's safety rules",
)


def _time_limit(spec: Conveyor, scene: ConveyorScene) -> Estimate:
    """Longest time of any stop, from the file; an hour without one: then it never stops.

    **Range** any stop; a run-out only where the file gives the limit.
    **Error** none: a chosen limit.
    **Source** the plant's rules.
    """
    return Estimate.exact(spec.checks.stop_time or _HOUR)


def _where_timed(spec: Conveyor, scene: ConveyorScene) -> Checks:
    """Every stop; a run-out only with a limit."""
    held = not isinstance(scene, Coast) or spec.checks.stop_time is not None
    return (STOP_TIME,) if held else ()


STOP_TIME: Check[Conveyor, ConveyorScene] = Check(
    code="CNV107",
    title="belt stopping time",
    question="Does the belt at the head come to rest within the limit, or at all?",
    failure="belt takes too long to stop",
    limit_state=LimitState("belt does not stop"),
    scenes=frozenset({Stop, EmergencyStop, Coast}),
    loads=("stop_time",),
    sense=Sense.AT_MOST,
    limit=_time_limit,
    needs=no_needs,
    blame=lambda spec, scene, loads: _time_key(spec, scene),
    repair=_brake_repair,
    each=_where_timed,
    what="The belt at the head stops within the time given in the file. Without that time, a belt that moves longer"
    " than one hour counts as not stopping.",
    why="Conveyors that feed one another must stop in sequence; otherwise the transfer points block. A load that"
    " lowers itself against too weak brakes runs away.",
    formula="t(v = 0) <= limit",
    source="the plant's rules; balance of the whole belt",
)


def _brake_limit(spec: Conveyor, scene: ConveyorScene) -> Estimate:
    """Torque of all brakes that act, on the drum shaft of the head.

        M = sum F_brake R

    **Range** brakes at full torque; delay and rise are in the simulated way (CNV106), not here.
    **Error** that of the gear's efficiency, which is an input.
    **Source** `motion.braking`.
    """
    forces = sum(braking(spec, brake).force for brake in brakes_of(spec, scene).values())
    return Estimate.exact(forces * spec.main_drive.drum.diameter / 2)


BRAKE: Check[Conveyor, ConveyorScene] = Check(
    code="CNV108",
    title="required brake torque",
    question="Is the total brake torque enough to stop within the permissible distance?",
    failure="brake torque is too low for the stopping distance",
    scenes=frozenset({Stop, EmergencyStop}),
    loads=("brake_torque_required",),
    sense=Sense.AT_MOST,
    limit=_brake_limit,
    needs=no_needs,
    blame=lambda spec, scene, loads: _brake_key(spec, scene),
    repair=_brake_repair,
    each=_only_with("CNV108", Conveyor.stop_distance_limit),
    what="The total brake torque is at least the torque that stops the rigid body within the distance given in the"
    " file.",
    why="A brake sized without the sign of the resistance is too weak downhill and unnecessarily severe uphill.",
    formula="(m v^2/(2 s) - W) R <= sum M_brake on the drum shaft",
    source="lecture notes Kramatorsk 2007, in the signed form",
)


def _backstop_limit(spec: Conveyor, scene: ConveyorScene) -> Estimate:
    """Torque that backstop and closed brakes hold at the head pulley, with the reserve of a backstop.

        M = (M_backstop + sum F_brake R)/reserve

    **Range** a belt at standstill with its drives off: brakes are closed then. Those at the tail are not counted.
    **Error** none: a chosen reserve.
    **Source** practice: reserve 1.25 to 1.75.
    """
    closed = sum(braking(spec, brake).force for brake in spec.brakes.values() if brake.at == "head")
    held = closed * spec.main_drive.drum.diameter / 2
    if spec.backstop is None:
        return Estimate.exact(held / Backstop.model_fields["reserve"].default)
    return Estimate.exact((held + spec.backstop.torque) / spec.backstop.reserve)


def _holding_key(spec: Conveyor) -> KeyPath:
    """The backstop, else the strongest brake at the head."""
    closed = {name: brake for name, brake in spec.brakes.items() if brake.at == "head"}
    if spec.backstop is None and closed:
        return ("brakes", max(closed, key=lambda name: braking(spec, closed[name]).force), "torque")
    return ("backstop", "torque") if spec.backstop else ("backstop",)


BACKSTOP: Check[Conveyor, ConveyorScene] = Check(
    code="CNV109",
    title="belt rollback torque",
    question="Is the rollback torque of the stopped loaded belt held by friction or the backstop?",
    failure="rollback torque exceeds what the backstop may hold",
    limit_state=LimitState("loaded belt runs back"),
    scenes=frozenset({Hold, Stop, EmergencyStop, Coast, Start, Run}),
    loads=("backstop_torque",),
    sense=Sense.AT_MOST,
    limit=_backstop_limit,
    needs=no_needs,
    each=lambda spec, scene: (replace(BACKSTOP, each=None),) if asks_for_hold(spec, scene) else (),
    blame=lambda spec, scene, loads: _holding_key(spec),
    repair=lambda spec, scene: _holding_key(spec) if spec.backstop or spec.brakes else (),
    what="Idler resistance, backstop and closed brakes hold the force of the load on the stopped belt. The rollback"
    " torque is at most the torque of backstop and brakes, divided by the reserve.",
    why="A belt that rolls back buries its tail and drives the motors backward.",
    formula="(climb of the load - idler friction at rest) D/2 <= (M_backstop + M_brakes)/reserve",
    source="lecture notes Kramatorsk 2007",
)


def _stroke_limit(spec: Conveyor, scene: Run) -> Estimate:
    """Way the take-up can go, from the file.

    **Range** any take-up with its stroke given.
    **Error** none.
    **Source** the maker's data.
    """
    return Estimate.exact(spec.takeup.stroke or math.inf)


STROKE: Check[Conveyor, Run] = Check(
    code="CNV110",
    title="required take-up travel",
    question="Is the take-up travel enough for elastic and permanent belt elongation?",
    failure="take-up travel is too short",
    scenes=frozenset({Run}),
    loads=("takeup_travel",),
    sense=Sense.AT_MOST,
    limit=_stroke_limit,
    needs=no_needs,
    blame=lambda spec, scene, loads: ("takeup", "stroke"),
    repair=lambda spec, scene: ("takeup", "stroke"),
    each=_only_with("CNV110", lambda spec, scene: spec.takeup.stroke),
    what="The required take-up travel is at most the stroke. It starts from the new belt at standstill, closed with"
    " the take-up tension S_0 all round. It ends at the old belt in steady running. A take-up weight follows the"
    " elastic and the permanent elongation. A take-up screw moves for the permanent elongation only, because its"
    " belt runs with the set mean tension S_0.",
    why="A take-up at the end of its stroke lets the tension fall, and the belt slips.",
    formula="L_loop ((S_mean - S_0)/EA + permanent)/2 <= stroke",
    source="DIN 22101, elongation of the belt",
)


def _heat_limit(spec: Conveyor, scene: ConveyorScene) -> Estimate:
    """Largest heat of slip of the file.

    **Range** any scene in motion with the limit given.
    **Error** none: a chosen limit.
    **Source** the lagging maker's data.
    """
    return Estimate.exact(spec.checks.slip_heat or math.inf)


def _heat_checks(spec: Conveyor, scene: ConveyorScene) -> Checks:
    if spec.checks.slip_heat is None:
        return
    for name, drive in spec.all_drives.items():
        path = (*spec.drive_path(name), "drum", "friction")
        if drive.drum.friction is not None:
            yield HEAT.of(name, _heat_limit, path)


HEAT: Check[Conveyor, ConveyorScene] = Check(
    code="CNV111",
    title="slip heat at the drive pulley",
    question="Is the frictional heat of belt slip within the limit of the pulley?",
    failure="belt slip heats the drive pulley too much",
    scenes=IN_MOTION - {Jam},
    loads=("slip_heat",),
    sense=Sense.AT_MOST,
    limit=_heat_limit,
    needs=no_needs,
    blame=_blame_tension,
    repair=no_repair,
    each=_heat_checks,
    what="The frictional heat of temporary belt slip at a drive pulley is at most the limit of the file.",
    why="A slipping pulley sets the belt on fire before the operator notices.",
    formula="integral of |S_on - S_off| |v_drum - v_belt| dt <= limit",
    source="work of friction",
)

_OF_MOTION = (SLIP, STRENGTH, SAG, START, SLACK, STOP, STOP_TIME, BRAKE, BACKSTOP, STROKE, HEAT)
_BY_CODE: dict[str, AnyCheck] = {check.code: check for check in _OF_MOTION}
CHECKS: tuple[AnyCheck, ...] = (*_OF_MOTION, *CHECKS_OF_THE_DRIVE, *CHECKS_OF_THE_BELT, *CHECKS_OF_THE_START)
