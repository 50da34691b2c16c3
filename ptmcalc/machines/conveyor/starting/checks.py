"""Checks of a start: its motors' heat, its sharpness, the swings it leaves, a control that pulsates."""

import math
from collections.abc import Callable, Iterable, Mapping

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import AnyCheck, Check, Sense, no_needs, no_repair
from ptmcalc.contract.limits import fixed, key
from ptmcalc.machines.conveyor.machine.governing_keys import starting_torque_key
from ptmcalc.machines.conveyor.machine.loads import RUN_BACK_DISTANCE, may_run_back
from ptmcalc.machines.conveyor.machine.scenes import Start
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.starting.loads import allowed_acceleration

Loads = Mapping[str, Estimate]
Checks = Iterable[AnyCheck]


def _profile_key(key: str = "") -> Callable[[Conveyor, Start], KeyPath]:
    """Where a key of the profile of a scene stands in the file; without one, the key that says how long it takes."""
    return lambda spec, scene: (
        "scenes",
        list(spec.all_scenes).index(scene),
        "profile",
        key or scene.profile.time_key,
    )


_time_key, _ripple_key = _profile_key(), _profile_key("ripple")


# -- heat of the motors ---------------------------------------------------------------------------------------------


def _heat_limit(spec: Conveyor, scene: Start) -> Estimate:
    """Permissible rotor heat of one motor per start, given in the file.

    **Range** a start from the thermal state of the manufacturer's value: cold, or warm from operation.
    **Error** that of the manufacturer's value.
    **Source** the motor's data sheet.
    """
    return Estimate.exact(spec.main_drive.motor.start_heat or math.inf)


def _coupling_heat_limit(spec: Conveyor, scene: Start) -> Estimate:
    """Permissible heat of a fluid coupling per start.

    **Range** a start from the thermal state of the manufacturer's value.
    **Error** that of the manufacturer's value.
    **Source** the data sheet of the coupling.
    """
    heats = [one.fluid_coupling.start_heat for one in spec.all_drives.values() if one.fluid_coupling is not None]
    return Estimate.exact(next((heat for heat in heats if heat is not None), math.inf))


def _coupling_checks(spec: Conveyor, scene: Start) -> Checks:
    """One for each drive whose fluid coupling says what it bears, in a start by its own torque."""
    for name, drive in spec.all_drives.items() if not scene.profile.imposes_speed else ():
        coupling = drive.fluid_coupling
        if coupling is not None and coupling.start_heat is not None:
            path = (*spec.drive_path(name), "fluid_coupling")
            key = (*path, "torque_limit")
            yield COUPLING_HEAT.of(name, _exactly(coupling.start_heat), key, (), key)


COUPLING_HEAT: Check[Conveyor, Start] = Check(
    code="CNV123",
    title="fluid coupling heat per start",
    question="Is the heat of the fluid coupling in a start within the data-sheet value?",
    failure="heat of the start exceeds the data-sheet value of the coupling",
    scenes=frozenset({Start}),
    loads=("coupling_start_heat",),
    sense=Sense.AT_MOST,
    limit=_coupling_heat_limit,
    needs=no_needs,
    blame=lambda spec, scene, loads: starting_torque_key(spec),
    repair=no_repair,
    each=_coupling_checks,
    what="The heat of each fluid coupling in a start is at most the manufacturer's value.",
    why="A coupling that slips too long melts its fusible plug and loses its oil, and the belt stops.",
    formula="integral of M (w_0 - w) dt <= allowed",
    source="power into the coupling less that of its turbine wheel; the coupling's data sheet",
)


def _heat_checks(spec: Conveyor, scene: Start) -> Checks:
    """One for each drive without a fluid coupling whose motors say what they bear, in a start on the mains."""
    for name, drive in spec.all_drives.items() if not scene.profile.imposes_speed else ():
        most = drive.motor.start_heat
        if most is None or drive.fluid_coupling is not None or drive.converter is not None:
            continue
        path = spec.drive_path(name)
        key = starting_torque_key(spec, path)
        needs = () if drive.motor.running_curve is not None else ((*path, "motor", "no_load_speed"),)
        yield MOTOR_HEAT.of(name, _exactly(most), key, needs, () if key[-1] == "curve" else key)


def _exactly(limit: float) -> Callable[[Conveyor, Start], Estimate]:
    return lambda spec, scene: Estimate.exact(limit)


MOTOR_HEAT: Check[Conveyor, Start] = Check(
    code="CNV117",
    title="rotor heat per start",
    question="Is the rotor heat of a start within the data-sheet value?",
    failure="rotor heat of the start exceeds the data-sheet value",
    scenes=frozenset({Start}),
    loads=("motor_start_heat",),
    sense=Sense.AT_MOST,
    limit=_heat_limit,
    needs=no_needs,
    blame=lambda spec, scene, loads: starting_torque_key(spec),
    repair=no_repair,
    each=_heat_checks,
    what="The rotor heat of each mains-fed motor in a start is at most the manufacturer's value.",
    why="A rotor that accelerates slowly melts its bars before any relay in the stator circuit responds.",
    formula="integral of M (w_0 - w) dt <= allowed",
    source="power of the air gap less that of the shaft; the motor's data sheet",
)

# -- sharpness ------------------------------------------------------------------------------------------------------


def _sharp_limit(spec: Conveyor, scene: Start) -> Estimate:
    """Permissible acceleration of the file; if required by the file, also the acceleration at which traction and slack
    limit are met for certain.

    **Range** any start; the margins for one drive and a uniformly loaded belt.
    **Error** on the safe side: the margins are bounds.
    **Source** the plant's rules; `starting.loads.allowed_acceleration`.
    """
    margins = allowed_acceleration(spec, scene) if spec.checks.start_margins == "on" else None
    asked = [limit for limit in (spec.checks.start_acceleration, margins) if limit is not None]
    return Estimate.exact(min(asked, default=math.inf))


def _sharp_checks(spec: Conveyor, scene: Start) -> Checks:
    """Where the file gives a limit, or asks for one that is known."""
    if math.isfinite(_sharp_limit(spec, scene).value):
        yield SHARP


def _sharp_key(spec: Conveyor, scene: Start) -> KeyPath:
    return _time_key(spec, scene) if scene.profile.rise_time else starting_torque_key(spec)


def _sharp_repair(spec: Conveyor, scene: Start) -> KeyPath:
    key = _sharp_key(spec, scene)
    return () if key[-1] in ("curve", "points") else key


SHARP: Check[Conveyor, Start] = Check(
    code="CNV118",
    title="belt starting acceleration",
    question="Is the acceleration of the start within its limit?",
    failure="start is too fast",
    scenes=frozenset({Start}),
    loads=("acceleration_rigid",),
    sense=Sense.AT_MOST,
    limit=_sharp_limit,
    needs=no_needs,
    blame=lambda spec, scene, loads: _sharp_key(spec, scene),
    repair=_sharp_repair,
    each=_sharp_checks,
    what="The maximum acceleration of the profile is at most the limit of the file. If the file requires it, the"
    " acceleration is also at most the bound set by traction and slack.",
    why="In a hard start, load slides back on a slope and the pulley slips. The belt goes slack behind the starting"
    " wave.",
    formula="v q'_max <= a   (speed)      (F - W)/M <= a   (torque)",
    source="practice: 0.1 to 0.3 m/s^2; bounds of `laws.loop_bounds`",
)

# -- swings ---------------------------------------------------------------------------------------------------------


def _residual_checks(spec: Conveyor, scene: Start) -> Checks:
    if spec.checks.start_residual is not None and scene.profile.rise_time:
        yield RESIDUAL


RESIDUAL: Check[Conveyor, Start] = Check(
    code="CNV119",
    title="residual belt oscillation after start",
    question="Is the residual oscillation in the first belt mode within its limit?",
    failure="start profile excites the first belt mode",
    scenes=frozenset({Start}),
    loads=("start_residual",),
    sense=Sense.AT_MOST,
    limit=key(
        "checks.start_residual",
        meaning="Permissible residual oscillation, given in the file",
        valid="profiles over time",
        source="the plant's rules",
    ),
    needs=no_needs,
    blame=lambda spec, scene, loads: _time_key(spec, scene),
    repair=lambda spec, scene: () if scene.profile.points else _time_key(spec, scene),
    each=_residual_checks,
    what="The residual oscillation of the profile in the lowest belt mode is at most the limit of the file.",
    why="A belt that oscillates after its start wears splices and take-up. A rise time of whole periods leaves no"
    " oscillation.",
    formula="R = |integral of q'(t) exp(i w_1 t) dt| <= limit,   1 for a step",
    source="`laws.start_profile.residual`; frequencies of `laws.belt_modes`",
)


def _band_checks(spec: Conveyor, scene: Start) -> Checks:
    if scene.profile.ripple is not None:
        yield RESONANCE


RESONANCE: Check[Conveyor, Start] = Check(
    code="CNV120",
    title="drive ripple separation from belt modes",
    question="Is the drive torque ripple far enough from the three lowest belt modes?",
    failure="drive ripple is close to a belt natural frequency",
    scenes=frozenset({Start}),
    loads=("resonance_distance",),
    sense=Sense.AT_LEAST,
    limit=key(
        "checks.resonance_band",
        meaning="Required separation of the drive ripple from the three lowest belt frequencies, 15 % by default",
        valid="belt and idlers damp the higher modes",
        source="15 %: a damping of 0.05 lets a mode grow to a third of its peak there; an engineering choice",
    ),
    needs=no_needs,
    blame=lambda spec, scene, loads: _ripple_key(spec, scene),
    repair=_ripple_key,
    each=_band_checks,
    what="The relative distance of the drive ripple from each of the three lowest belt natural frequencies is at least"
    " the band.",
    why="A small ripple in resonance amplifies the belt oscillation until the pulley slips or a splice fails.",
    formula="min over k = 1, 2, 3 of |f/f_k - 1| >= band",
    source="frequencies of `laws.belt_modes`; the band is an engineering choice",
)


START: Check[Conveyor, Start] = Check(
    code="CNV104",
    title="starting force reserve",
    question="Can the drives start the loaded belt?",
    failure="starting force is below the required force",
    scenes=frozenset({Start}),
    loads=("starting_reserve",),
    sense=Sense.AT_LEAST,
    limit=fixed(
        1.0, meaning="1: the starting force reaches the required force", valid="any start", source="Newton's law"
    ),
    needs=no_needs,
    blame=lambda spec, scene, loads: starting_torque_key(spec),
    repair=lambda spec, scene: () if (key := starting_torque_key(spec))[-1] == "curve" else key,
    what="With a torque profile, the mean starting force at the pulley surface exceeds the static resistance. With an"
    " imposed speed, it exceeds the force that the profile requires.",
    why="A drive that cannot move the belt stalls, and its motors overheat.",
    formula="n M i eta/R > W   (torque)      n M i eta/R >= max(m a + S_on - S_off)   (imposed speed)",
    source="lecture notes Kramatorsk 2007",
)


# -- aborted starts -------------------------------------------------------------------------------------------------


def _run_back_checks(spec: Conveyor, scene: Start) -> Checks:
    if may_run_back(spec, scene):
        yield RUN_BACK


RUN_BACK: Check[Conveyor, Start] = Check(
    code="CNV124",
    hazard=True,
    title="belt run-back distance, aborted start",
    question="Does the belt stay where it is when a start is aborted?",
    failure="belt runs back after the aborted start; a `backstop` prevents it",
    scenes=frozenset({Start}),
    loads=(RUN_BACK_DISTANCE,),
    sense=Sense.AT_MOST,
    limit=key(
        "checks.run_back",
        meaning="Permissible run-back distance of an aborted start, 0.1 m by default",
        valid="an aborted start without a backstop at all drives",
        source="engineering choice; the stretch at the drive pulley that a short belt releases",
    ),
    needs=no_needs,
    blame=lambda spec, scene, loads: ("scenes", list(spec.all_scenes).index(scene), "aborted"),
    repair=no_repair,
    each=_run_back_checks,
    what="The backward travel of the belt at each drive after an aborted start is at most the limit `checks.run_back`.",
    why="The stretch that a start stores in the belt drives the pulleys backward, also on a level conveyor. Material"
    " is carried to the tail, and the motors restart against the backward motion. A `backstop` prevents it.",
    formula="max over t of (max of s up to t - s(t)) <= limit",
    source="simulation of the belt; the limit is an engineering choice",
)
