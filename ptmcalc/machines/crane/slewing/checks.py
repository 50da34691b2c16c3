"""The checks of a slewing crane's drive: what starts it, what stops it, what holds it."""

import math
from collections.abc import Mapping

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.components.motor import braking_number_at, number_at
from ptmcalc.contract.check import AnyCheck, Check, LimitState, Sense, at, blames, needs, no_needs, no_repair, only
from ptmcalc.machines.crane.slewing import drive, model
from ptmcalc.machines.crane.slewing.solvers.consistent import start_of
from ptmcalc.machines.crane.slewing.spec import Slew, SlewingCrane, SlewingScene

Loads = Mapping[str, Estimate]
OneCheck = Check[SlewingCrane, SlewingScene]
SLEWING = frozenset({Slew})


def reaches(spec: SlewingCrane, scene: SlewingScene) -> bool:
    """Whether the motor's curve carries the crane to its speed: of one that does not (CRN118) no start is asked."""
    least = model.least_torque(spec, scene)
    return least is None or model.at_column(spec, least) >= model.steady_torque(spec, scene)


def starts(spec: SlewingCrane, scene: SlewingScene) -> bool:
    """Whether the rigid crane starts: of one that stalls (CRN101, CRN118) no stop is asked."""
    return math.isfinite(start_of(spec, scene)[0]) and reaches(spec, scene)


def turns(spec: SlewingCrane, scene: SlewingScene) -> bool:
    """Whether the rigid crane starts and stops: of one that stalls (CRN101, CRN118), or that no brake stops (CRN105),
    nothing more is asked."""
    return starts(spec, scene) and math.isfinite((model.stop(spec, scene) or (0.0, 0.0))[0])


# -- start ----------------------------------------------------------------------------------------------------------


def torque_key(spec: SlewingCrane, scene: SlewingScene) -> KeyPath:
    """What says how strongly it starts, or in which time."""
    if spec.motor.mean_torque(1.0) is not None:
        return ("motor", spec.motor.torque_key)
    return ("cycle", "start_time" if spec.cycle.start_time is not None else "start_angle")


def _torque_repair(spec: SlewingCrane, scene: SlewingScene) -> KeyPath:
    return curve_number(spec, torque_key(spec, scene))


def curve_number(spec: SlewingCrane, path: KeyPath) -> KeyPath:
    """The number that a key stands for: of the motors' curve, the one that all its torques grow with."""
    return number_at(path, spec.motor.curve, rated=spec.motor.power is not None)


def _reserve_limit(spec: SlewingCrane, scene: SlewingScene) -> Estimate:
    """Minimum ratio of starting torque to steady slewing torque, 1.1 by default.

    **Range** motors that start against friction, steady wind and slope.
    **Error** none: an engineering rule.
    **Source** handbooks of lifting machines.
    """
    return Estimate.exact(spec.checks.starting_reserve)


STALL: OneCheck = Check(
    code="CRN101",
    title="slewing starting torque reserve",
    question="Does the starting torque exceed friction, steady wind and slope with reserve?",
    failure="starting torque reserve is too small",
    limit_state=LimitState("slewing drive stalls", 1),
    scenes=SLEWING,
    loads=("starting_reserve",),
    sense=Sense.AT_LEAST,
    limit=_reserve_limit,
    needs=no_needs,
    blame=lambda spec, scene, loads: torque_key(spec, scene),
    repair=_torque_repair,
    what="The starting torque at the slewing axis is at least the required multiple of the torque of friction, steady"
    " wind and slope. It is the minimum torque of the motor curve up to full speed, or the mean starting torque where"
    " no curve is given.",
    why="A motor torque below the resistance does not turn the crane. The motor stalls and overheats.",
    formula="M_m u eta/(M_fr + M_w) >= 1.1",
    source="balance of torques about the slewing axis; handbooks of lifting machines",
)


def _longest_start(spec: SlewingCrane, scene: SlewingScene) -> Estimate:
    """Maximum starting time, 10 s by default.

    **Range** slewing cranes in service.
    **Error** none: an engineering rule; 4 to 10 s are usual.
    **Source** handbooks of lifting machines.
    """
    return Estimate.exact(spec.checks.start_time)


SLOW: OneCheck = only(reaches)(
    Check(
        code="CRN102",
        title="maximum slewing start time",
        question="Does the crane reach its slewing speed within the limit?",
        failure="slewing start takes too long",
        limit_state=LimitState("slewing drive stalls"),
        scenes=SLEWING,
        loads=("start_time",),
        sense=Sense.AT_MOST,
        limit=_longest_start,
        needs=no_needs,
        blame=lambda spec, scene, loads: torque_key(spec, scene),
        repair=_torque_repair,
        what="The crane reaches its slewing speed within the maximum start time.",
        why="A slow start delays the work and heats the motor.",
        formula="t_s = J w/(M_start - M_steady) <= 10 s",
        source="change of angular momentum; handbooks of lifting machines",
    )
)


def _at_least_steady(spec: SlewingCrane, scene: SlewingScene) -> Estimate:
    """The steady slewing torque.

    **Range** torque-speed curves, from standstill to the slewing speed.
    **Error** none: a balance of torques.
    **Source** balance of torques about the slewing axis.
    """
    return Estimate.exact(1.0)


SPEED: OneCheck = only(lambda spec, scene: model.least_torque(spec, scene) is not None)(
    Check(
        code="CRN118",
        title="slewing torque reserve up to full speed",
        question="Does the motor curve stay above the steady slewing torque up to full speed?",
        failure="motor torque falls below the steady slewing torque",
        scenes=SLEWING,
        loads=("speed_reserve",),
        sense=Sense.AT_LEAST,
        limit=_at_least_steady,
        needs=no_needs,
        blame=blames("motor", "curve"),
        repair=no_repair,
        what="From standstill to the slewing speed, the torque of the motor curve is at least the torque of friction,"
        " steady wind and slope.",
        why="Where the curve falls below the resistance, the crane does not accelerate further. The mean of the curve"
        " does not show this.",
        formula="min M(w) u eta/(M_fr + M_w) >= 1",
        source="balance of torques about the slewing axis",
    )
)


def _shortest_start(spec: SlewingCrane, scene: SlewingScene) -> Estimate:
    """Minimum starting time, 1 s by default.

    **Range** slewing cranes in service.
    **Error** none: an engineering rule.
    **Source** handbooks of lifting machines.
    """
    return Estimate.exact(spec.checks.least_start_time)


HARSH: OneCheck = only(turns)(
    Check(
        code="CRN103",
        title="minimum slewing start time",
        question="Is the starting time long enough for a smooth start?",
        failure="slewing start is too abrupt",
        scenes=SLEWING,
        loads=("start_time",),
        sense=Sense.AT_LEAST,
        limit=_shortest_start,
        needs=no_needs,
        blame=lambda spec, scene, loads: torque_key(spec, scene),
        repair=_torque_repair,
        what="The start of the crane to its slewing speed takes at least the minimum start time.",
        why="An oversized motor causes load sway and impacts in gear and jib.",
        formula="t_s >= 1 s",
        source="handbooks of lifting machines",
    )
)


def _whole_rotation(spec: SlewingCrane, scene: SlewingScene) -> Estimate:
    """The whole slewing angle.

    **Range** any rotation.
    **Error** none: a definition.
    **Source** start and stop are parts of one slewing motion.
    """
    return Estimate.exact(1.0)


SHORT: OneCheck = only(turns)(
    Check(
        code="CRN106",
        title="rotation share of start and stop",
        question="Do start and stop fit into the slewing angle of the cycle?",
        failure="slewing angle is too short to reach full speed",
        scenes=SLEWING,
        loads=("rotation_used",),
        sense=Sense.AT_MOST,
        limit=_whole_rotation,
        needs=no_needs,
        blame=blames("cycle", "rotation"),
        repair=at("cycle", "rotation"),
        what="The slewing angle of start and stop together is at most the angle of the rotation.",
        why="A crane that does not reach its slewing speed has a different cycle from the computed one.",
        formula="(beta_s + beta_b)/beta <= 1",
        source="course notes on the slewing crane on a fixed column (3.5.2.3)",
    )
)

# -- stop -----------------------------------------------------------------------------------------------------------


def _allowed_angle(spec: SlewingCrane, scene: SlewingScene) -> Estimate:
    """Permissible stopping angle, given in the file.

    **Range** 15 deg in light duty.
    **Error** none: a given value.
    **Source** course notes on the slewing crane on a fixed column (3.5.2.2).
    """
    return Estimate.exact(spec.cycle.brake_angle)


BRAKE_ANGLE: OneCheck = only(starts)(
    Check(
        code="CRN104",
        title="slewing stopping angle",
        question="Does the brake stop the crane within the permissible angle against in-service wind?",
        failure="crane slews too far before it stops",
        scenes=SLEWING,
        loads=("brake_angle",),
        sense=Sense.AT_MOST,
        limit=_allowed_angle,
        needs=needs(("brake",)),
        blame=blames("brake", "torque"),
        repair=at("brake", "torque"),
        what="The brake stops the crane within the permissible angle against the maximum in-service wind. The brake"
        " delay is included.",
        why="A jib that slews too far hits objects in its path. The operator cannot place the load.",
        formula="beta_b <= beta",
        source="power balance of the gear (laws.slewing.geared_stop); course notes on the slewing crane",
    )
)


def _longest_stop(spec: SlewingCrane, scene: SlewingScene) -> Estimate:
    """Maximum stopping time, 10 s by default.

    **Range** slewing cranes in service.
    **Error** none: an engineering rule.
    **Source** handbooks of lifting machines.
    """
    return Estimate.exact(spec.checks.brake_time)


BRAKE_TIME: OneCheck = only(starts)(
    Check(
        code="CRN105",
        title="maximum slewing stop time",
        question="Does the brake stop the crane within the limit against in-service wind?",
        failure="slewing stop takes too long",
        limit_state=LimitState("brake does not stop the crane"),
        scenes=SLEWING,
        loads=("brake_time",),
        sense=Sense.AT_MOST,
        limit=_longest_stop,
        needs=needs(("brake",)),
        blame=blames("brake", "torque"),
        repair=at("brake", "torque"),
        what="The brake stops the crane within the maximum stop time against the maximum in-service wind. The brake"
        " delay is included.",
        why="A crane with a long stopping time does not stop before an obstacle. A brake torque below the wind torque"
        " does not stop it at all.",
        formula="t_b <= 10 s",
        source="power balance of the gear (laws.slewing.geared_stop)",
    )
)


def _shortest_stop(spec: SlewingCrane, scene: SlewingScene) -> Estimate:
    """Minimum stopping time, 1 s by default.

    **Range** slewing cranes in service; an emergency stop may be shorter.
    **Error** none: an engineering rule.
    **Source** handbooks of lifting machines.
    """
    return Estimate.exact(spec.checks.least_brake_time)


HARSH_STOP: OneCheck = only(turns)(
    Check(
        code="CRN119",
        title="minimum slewing stop time",
        question="Is the stopping time long enough for a smooth stop?",
        failure="slewing stop is too abrupt",
        scenes=SLEWING,
        loads=("brake_time",),
        sense=Sense.AT_LEAST,
        limit=_shortest_stop,
        needs=needs(("brake",)),
        blame=blames("brake", "torque"),
        repair=at("brake", "torque"),
        what="The stop of the crane to standstill takes at least the minimum stop time.",
        why="An oversized brake causes load sway and impacts in gear and jib.",
        formula="t_b >= 1 s",
        source="handbooks of lifting machines",
    )
)

# -- motor and gear -------------------------------------------------------------------------------------------------


def _rating(spec: SlewingCrane, scene: SlewingScene) -> KeyPath:
    return ("motor", *spec.motor.rating_key)


def _all_of_it(spec: SlewingCrane, scene: SlewingScene) -> Estimate:
    """The full rating.

    **Range** ratings of the manufacturer.
    **Error** none: a definition.
    **Source** IEC 60034-1; catalogues.
    """
    return Estimate.exact(1.0)


HEATING: OneCheck = only(turns)(
    Check(
        code="CRN107",
        title="slewing motor thermal utilisation",
        question="Is the rms torque within the permissible torque at this duty factor?",
        failure="slewing motor is thermally overloaded",
        scenes=SLEWING,
        loads=("heating_utilisation",),
        sense=Sense.AT_MOST,
        limit=_all_of_it,
        needs=lambda spec, scene: () if spec.motor.rated is not None else (("motor", "rated_torque"),),
        blame=lambda spec, scene, loads: _rating(spec, scene),
        repair=_rating,
        what="Start and steady slewing heat the motor at most as much as its rated torque does at the duty factor of"
        " the cycle.",
        why="The life of the winding insulation halves with every 10 K of excess temperature.",
        formula="sqrt(sum M^2 t/sum t) <= M_N sqrt(B(ED_N)/B(ED))",
        source="IEC 60034-1",
    )
)


def _largest_torque(spec: SlewingCrane, scene: SlewingScene) -> Estimate:
    """Permissible short-time torque of all motors together.

    **Range** the manufacturer's overload limit.
    **Error** none: a given value.
    **Source** the manufacturer's data.
    """
    most = spec.motor.largest_torque
    return Estimate.exact(math.inf if most is None else spec.motor.count * most)


OVERLOAD: OneCheck = only(lambda spec, scene: spec.motor.largest_torque is not None)(
    Check(
        code="CRN108",
        title="slewing motor starting torque",
        question="Is the starting torque within the short-time overload limit of the motors?",
        failure="slewing motor is overloaded during the start",
        scenes=SLEWING,
        loads=("torque_motor_start",),
        sense=Sense.AT_MOST,
        limit=_largest_torque,
        needs=no_needs,
        blame=blames("motor", "largest_torque"),
        repair=at("motor", "largest_torque"),
        what="The motor torque in the start is at most the short-time overload torque of the motors.",
        why="A motor stalls beyond its breakdown torque.",
        formula="M_m <= M_max",
        source="the manufacturer's data",
    )
)


def _gearbox_rating(spec: SlewingCrane, scene: SlewingScene) -> Estimate:
    """Rated torque of the gearbox at its input shaft, for its mechanism group.

    **Range** the catalogue rating at the motor speed.
    **Error** none: a given value.
    **Source** the manufacturer's catalogue.
    """
    rated = spec.gear.rated_torque
    return Estimate.exact(math.inf if rated is None else rated)


GEARBOX: OneCheck = only(lambda spec, scene: spec.gear.rated_torque is not None)(
    Check(
        code="CRN109",
        title="slewing gearbox equivalent torque",
        question="Is the equivalent input torque within the gearbox rating?",
        failure="slewing gearbox is overloaded",
        scenes=SLEWING,
        loads=("torque_worm",),
        sense=Sense.AT_MOST,
        limit=_gearbox_rating,
        needs=no_needs,
        blame=blames("gear", "rated_torque"),
        repair=at("gear", "rated_torque"),
        what="The equivalent torque of the gearbox is at most its rating. The equivalent torque causes the same"
        " fatigue as the cycle.",
        why="Pitting and wear of worm wheel teeth increase with the cube of their load.",
        formula="M_eq/(u eta) <= M_N",
        source="course notes on the slewing crane on a fixed column (3.5.2.13); Palmgren 1924, Miner 1945",
    )
)


def _pinion_rating(spec: SlewingCrane, scene: SlewingScene) -> Estimate:
    """Permissible torque of the open pinion for its service life.

    **Range** from the designer's calculation of the teeth.
    **Error** none: a given value.
    **Source** the file.
    """
    rated = spec.gear.pinion_torque
    return Estimate.exact(math.inf if rated is None else rated)


PINION: OneCheck = only(lambda spec, scene: spec.gear.pinion_torque is not None)(
    Check(
        code="CRN116",
        title="slewing pinion equivalent torque",
        question="Is the equivalent torque of the open pinion within its rating?",
        failure="slewing pinion is overloaded",
        scenes=SLEWING,
        loads=("torque_pinion",),
        sense=Sense.AT_MOST,
        limit=_pinion_rating,
        needs=needs(("gear", "open")),
        blame=blames("gear", "pinion_torque"),
        repair=at("gear", "pinion_torque"),
        what="The equivalent torque of the open pinion is at most its rating. The equivalent torque causes the same"
        " fatigue as the cycle.",
        why="The open stage carries the largest torque of the drive. It runs in dirt and without oil.",
        formula="M_eq/(u_o eta_o) <= M_p",
        source="course notes on the slewing crane on a fixed column (3.5.2.12)",
    )
)


def _driven_back(spec: SlewingCrane, scene: SlewingScene) -> bool:
    """Whether the crane drives a self-locking gear in the stop: against the brake on the motor, or blown by the wind
    before a brake on the crane has closed."""
    if spec.gear.back >= 0 or spec.brake is None:
        return False
    if spec.brake.shaft == "motor":
        return True
    return spec.brake.delay + spec.brake.rise_time > 0 and model.driving_wind(spec, scene) > spec.friction


LOCKS: OneCheck = only(_driven_back)(
    Check(
        code="CRN114",
        title="jam ratio of the self-locking gear",
        question="Is the rotor inertia large enough to prevent jamming of the self-locking gear during braking?",
        failure="self-locking gear jams during braking",
        scenes=SLEWING,
        loads=("gear_locks",),
        sense=Sense.AT_MOST,
        limit=_all_of_it,
        needs=no_needs,
        blame=blames("gear", "efficiency"),
        repair=no_repair,
        what="The rotor inertia of a self-locking drive is large enough for the rotor to decelerate together with the"
        " crane.",
        why="A crane that drives a self-locking worm gear stops at once. The impact loads gear, jib and load.",
        formula="-eta_r J/(J_1 u^2) <= 1",
        source="derived: laws.gearing.jams",
    )
)

# -- wind -----------------------------------------------------------------------------------------------------------


def _holding(spec: SlewingCrane, scene: SlewingScene) -> Estimate:
    """Minimum ratio of the torque to that of the maximum in-service wind, 1 by default.

    **Range** in-service wind; out of service the crane slews freely or is locked.
    **Error** none: an engineering rule.
    **Source** handbooks of lifting machines; FEM 1.001 and EN 13001-2 for the wind itself.
    """
    return Estimate.exact(spec.checks.holding_reserve)


def _blown(spec: SlewingCrane, scene: SlewingScene) -> bool:
    return model.driving_wind(spec, scene) > 0


def _wind_key(spec: SlewingCrane) -> KeyPath:
    gusty = spec.wind.gust_torque > 0 and spec.wind.maximum_torque == spec.wind.steady_torque + spec.wind.gust_torque
    keys = ("gust", "gust_pressure") if gusty else ("maximum", "maximum_pressure")
    for key in (*keys, "steady", "steady_pressure"):
        if getattr(spec.wind, key) is not None:
            return ("wind", key)
    return ("slope",)


WIND_MOTOR: OneCheck = only(_blown)(
    Check(
        code="CRN112",
        title="slewing motor reserve against wind",
        question="Can the starting torque turn the crane against the maximum in-service wind?",
        failure="motor reserve against in-service wind is too small",
        limit_state=LimitState("slewing motor cannot turn against the in-service wind", 1),
        scenes=SLEWING,
        loads=("wind_reserve_motor",),
        sense=Sense.AT_LEAST,
        limit=_holding,
        needs=no_needs,
        blame=lambda spec, scene, loads: _wind_key(spec),
        repair=_torque_repair,
        what="The starting torque is at least the required multiple of the torque of friction and maximum in-service"
        " wind. It is the minimum torque of the motor curve up to full speed, or the mean starting torque where no"
        " curve is given.",
        why="A crane that the wind turns while its motor is on is out of the operator's control.",
        formula="M_m u eta/(M_fr + M_w,max) >= 1",
        source="balance of torques about the slewing axis",
    )
)


def _overhauling_limit(spec: SlewingCrane, scene: SlewingScene) -> Estimate:
    """1: the braking torque of the motors is at least the overhauling torque of wind and slope.

    **Range** motors with a curve in the file.
    **Error** none: an equilibrium.
    **Source** balance of torques about the slewing axis.
    """
    return Estimate.exact(1.0)


def _driven(spec: SlewingCrane, scene: SlewingScene) -> bool:
    """Whether wind or slope, stronger than the friction, drive motors with a curve."""
    reserve = drive.braking_reserve(spec, scene)
    return reserve is not None and math.isfinite(reserve)


def _braking_repair(spec: SlewingCrane, scene: SlewingScene) -> KeyPath:
    return braking_number_at(("motor", "curve"), spec.motor.curve, rated=spec.motor.power is not None)


OVERHAULED: OneCheck = only(_driven)(
    Check(
        code="CRN120",
        title="motor braking torque reserve",
        question="Does the motor hold the crane at its speed in the maximum in-service wind?",
        failure="wind or slope overcomes the braking torque of the motor",
        scenes=SLEWING,
        loads=("overhauling_reserve",),
        sense=Sense.AT_LEAST,
        limit=_overhauling_limit,
        needs=no_needs,
        blame=blames("motor", "curve"),
        repair=_braking_repair,
        what="The maximum braking torque of the motor curve above its no-load speed is at least the overhauling torque"
        " of maximum in-service wind and slope on the motor shaft. Friction and gear losses reduce the overhauling"
        " torque.",
        why="A crane that exceeds the braking torque of its motor accelerates without limit. The rotor overspeeds, and"
        " the stopping angle grows with the square of the speed.",
        formula="n M_b/((M_w,max - M_fr) eta_r/u) >= 1",
        source="balance of torques about the slewing axis",
    )
)
WIND_BRAKE: OneCheck = only(_blown)(
    Check(
        code="CRN113",
        title="slewing brake reserve against wind",
        question="Can the brake hold the crane against the maximum in-service wind?",
        failure="brake reserve against in-service wind is too small",
        limit_state=LimitState("slewing brake cannot hold against the in-service wind", 1),
        scenes=SLEWING,
        loads=("wind_reserve_brake",),
        sense=Sense.AT_LEAST,
        limit=_holding,
        needs=needs(("brake",)),
        blame=blames("brake", "torque"),
        repair=at("brake", "torque"),
        what="The torque of the closed brake and the bearing friction are together at least the required multiple of"
        " the torque of the maximum in-service wind. Gear losses are neglected.",
        why="A jib that the wind turns against the closed brake hits adjacent objects.",
        formula="(M_B u + M_fr)/M_w,max >= 1, losses of the gear left out",
        source="balance of torques about the slewing axis",
    )
)

CHECKS_OF_DRIVE: tuple[AnyCheck, ...] = (
    STALL,
    SLOW,
    SPEED,
    HARSH,
    BRAKE_ANGLE,
    BRAKE_TIME,
    HARSH_STOP,
    SHORT,
    HEATING,
    OVERLOAD,
    GEARBOX,
    WIND_MOTOR,
    OVERHAULED,
    WIND_BRAKE,
    LOCKS,
    PINION,
)
