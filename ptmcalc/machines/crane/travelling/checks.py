"""The checks of a travelling crane: start, stop, sway, grip, wheel loads; and what its checks share."""

import math
from collections.abc import Mapping

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.components.motor import number_at
from ptmcalc.contract.check import AnyCheck, Check, LimitState, Sense, at, blames, no_needs, no_repair, only
from ptmcalc.machines.crane.travelling import model
from ptmcalc.machines.crane.travelling.scenes import (
    Brake,
    HoistWhileTravelling,
    Moving,
    Run,
    Start,
    Storm,
    TravelScene,
)
from ptmcalc.machines.crane.travelling.spec import Travelling
from ptmcalc.spec.scene import Scene

Loads = Mapping[str, Estimate]
OneCheck = Check[Travelling, TravelScene]
STARTS: frozenset[type[Scene]] = frozenset({Start, HoistWhileTravelling})
MOVES: frozenset[type[Scene]] = STARTS | {Brake}
RUNNING: frozenset[type[Scene]] = frozenset({Run})


def hangs(spec: Travelling, scene: TravelScene) -> bool:
    """Whether anything hangs on the ropes."""
    return model.hanging(spec, scene) > 0


def torque_key(spec: Travelling) -> KeyPath:
    """What says how strongly the motors start."""
    motor = spec.drive.motor
    if motor.mean_starting_torque is not None:
        return ("drive", "motor", "mean_starting_torque")
    if motor.largest_starting_torque is not None:
        return ("drive", "motor", "largest_starting_torque")
    return ("drive", "motor", "curve")


def torque_repair(spec: Travelling, scene: TravelScene) -> KeyPath:
    """The torque of the motors, where it is one number."""
    return curve_number(spec, torque_key(spec))


def curve_number(spec: Travelling, path: KeyPath) -> KeyPath:
    """The number that a key stands for: of the motors' curve, the one that all its torques grow with."""
    motor = spec.drive.motor
    return number_at(path, motor.curve, rated=motor.power is not None)


def rate_key(spec: Travelling, scene: Moving) -> KeyPath:
    """What says how fast a start or a stop is."""
    if model.starts(scene):
        if spec.drive.ramp_time is not None:
            return ("drive", "ramp_time")
        return ("drive", "acceleration") if spec.drive.acceleration is not None else torque_key(spec)
    return ("drive", "deceleration") if model.commanded(spec, scene) is not None else ("drive", "brake", "torque")


def _rate_repair(spec: Travelling, scene: TravelScene) -> KeyPath:
    return curve_number(spec, rate_key(spec, _moving(scene)))


def _rate_blame(spec: Travelling, scene: TravelScene, loads: Loads) -> KeyPath:
    return rate_key(spec, _moving(scene))


def _moving(scene: TravelScene) -> Moving:
    assert isinstance(scene, Start | Brake | HoistWhileTravelling)
    return scene


# -- start and stop -------------------------------------------------------------------------------------------------


def _start_limit(spec: Travelling, scene: TravelScene) -> Estimate:
    """Longest start, 15 s by default.

    **Range** any crane.
    **Error** none: an engineering rule; 5 to 10 s is usual.
    **Source** handbooks of lifting machines.
    """
    return Estimate.exact(spec.checks.start_time)


SLOW: OneCheck = Check(
    code="CRN150",
    title="travel start time",
    question="Does the crane reach travel speed within the limit against wind and slope?",
    failure="crane takes too long to start travelling",
    limit_state=LimitState("travel drive stalls"),
    scenes=STARTS,
    loads=("start_time",),
    sense=Sense.AT_MOST,
    limit=_start_limit,
    needs=no_needs,
    blame=_rate_blame,
    repair=_rate_repair,
    what="The crane reaches full travel speed within the maximum start time against wind and slope. The load sways"
    " behind the crane.",
    why="A drive with little excess torque stalls in the first gust. It heats its motors during the whole start.",
    formula="t = v m_red/(F - W), with the load swinging; infinite for F <= W: it stalls",
    source="balance of forces; pendulum under a pivot that is pushed",
)


def _stop_limit(spec: Travelling, scene: TravelScene) -> Estimate:
    """Longest stop, 15 s by default.

    **Range** any crane.
    **Error** none: an engineering rule.
    **Source** handbooks of lifting machines.
    """
    return Estimate.exact(spec.checks.brake_time)


LONG_STOP: OneCheck = Check(
    code="CRN151",
    title="travel stop time",
    question="Does the crane stop within the limit with wind and slope behind it?",
    failure="crane takes too long to stop",
    limit_state=LimitState("brakes do not stop the crane"),
    scenes=frozenset({Brake}),
    loads=("brake_time",),
    sense=Sense.AT_MOST,
    limit=_stop_limit,
    needs=no_needs,
    blame=_rate_blame,
    repair=_rate_repair,
    what="The crane stops within the maximum stop time. Wind and slope act in the direction of travel, and the load"
    " pushes the crane.",
    why="A longer stopping time endangers people and end buffers ahead of the crane.",
    formula="t = t_d + ..., m_red x'' = -F_b(t) - W + M g theta; infinite where brakes do not hold wind and slope",
    source="balance of forces; pendulum under a pivot that is pushed",
)


def _distance_limit(spec: Travelling, scene: TravelScene) -> Estimate:
    """Longest way to a stop that the file allows.

    **Range** any crane.
    **Error** none: a limit of the file.
    **Source** the file.
    """
    asked = spec.checks.brake_distance
    return Estimate.exact(math.inf if asked is None else asked)


LONG_WAY: OneCheck = only(lambda spec, scene: spec.checks.brake_distance is not None)(
    Check(
        code="CRN152",
        title="travel stopping distance",
        question="Does the crane stop within the permissible distance?",
        failure="stopping distance is too long",
        scenes=frozenset({Brake}),
        loads=("brake_distance",),
        sense=Sense.AT_MOST,
        limit=_distance_limit,
        needs=no_needs,
        blame=_rate_blame,
        repair=_rate_repair,
        what="The stopping distance of the crane is at most the limit.",
        why="The settings of limit switches and the reactions of operators rely on this distance.",
        formula="s = integral of x' from the command to rest",
        source="balance of forces",
    )
)

# -- sway -----------------------------------------------------------------------------------------------------------


def _sway_limit(spec: Travelling, scene: TravelScene) -> Estimate:
    """Largest angle of the load, 10 deg by default.

    **Range** any crane.
    **Error** none: an engineering rule; 3 to 6 deg where loads are set down by hand.
    **Source** the file, else usual practice.
    """
    return Estimate.exact(spec.checks.sway_angle)


SWAY: OneCheck = only(hangs)(
    Check(
        code="CRN153",
        title="maximum load sway angle",
        question="Is the sway angle of the load within its limit?",
        failure="load sways too far",
        scenes=MOVES,
        loads=("sway_angle_max",),
        sense=Sense.AT_MOST,
        limit=_sway_limit,
        needs=no_needs,
        blame=_rate_blame,
        repair=_rate_repair,
        what="The angle of the ropes from the vertical is at most the limit, during the start or stop and after it.",
        why="A load that sways hits obstacles. It acts on the crane with twice its share of the force.",
        formula="theta = 2 atan(a/g) from rest under a sudden a; less for ramps that match the period",
        source="pendulum under a moved pivot",
    )
)


def _residual_limit(spec: Travelling, scene: TravelScene) -> Estimate:
    """Largest angle that stays, as the file allows.

    **Range** any crane.
    **Error** none: a limit of the file.
    **Source** the file.
    """
    asked = spec.checks.residual_sway
    return Estimate.exact(math.inf if asked is None else asked)


RESIDUAL: OneCheck = only(lambda spec, scene: hangs(spec, scene) and spec.checks.residual_sway is not None)(
    Check(
        code="CRN154",
        title="residual load sway",
        question="Is the sway left after the start or stop within its limit?",
        failure="residual sway is too large",
        scenes=MOVES,
        loads=("sway_residual",),
        sense=Sense.AT_MOST,
        limit=_residual_limit,
        needs=no_needs,
        blame=_rate_blame,
        repair=no_repair,
        what="The sway that remains after the start or stop is at most the limit.",
        why="A load cannot be set down or picked up before it hangs still. A ramp of one sway period leaves no"
        " residual sway.",
        formula="theta_r = (2 a/g) |sin(omega t_a/2)| for small angles",
        source="pendulum under a moved pivot",
    )
)

# -- grip -----------------------------------------------------------------------------------------------------------


def _skid_limit(spec: Travelling, scene: TravelScene) -> Estimate:
    """Least adhesion over what is asked of a driven wheel, 1.2 by default.

    **Range** steel wheels on rails.
    **Error** none: an engineering rule.
    **Source** handbooks of lifting machines.
    """
    return Estimate.exact(spec.checks.skid_reserve)


def _skid_repair(spec: Travelling, scene: TravelScene) -> KeyPath:
    key = rate_key(spec, _moving(scene))
    return key if key[-1] not in ("curve", "mean_starting_torque", "largest_starting_torque") else ()


SKID: OneCheck = Check(
    code="CRN155",
    title="wheel adhesion reserve",
    question="Does every driven or braked wheel transmit its force without slip?",
    failure="adhesion reserve of a driven wheel is too small",
    limit_state=LimitState("driven wheel slips on the rail", 1),
    scenes=MOVES,
    loads=("skid_reserve_min",),
    sense=Sense.AT_LEAST,
    limit=_skid_limit,
    needs=no_needs,
    blame=_rate_blame,
    repair=_skid_repair,
    what="The adhesion of every driven or braked wheel is at least the required multiple of its drive or brake force."
    " This includes the wheel with the minimum load. The trolley is at the far end, the load sways, and the"
    " acceleration tilts the crane.",
    why="A wheel that slips wears flat and skews the crane. This occurs even where the mean adhesion of all wheels is"
    " sufficient.",
    formula="mu N_k/|F_k| >= 1.2,   F_k = s_k (m a + W + H),   N_k with m a h/B and H h/B taken off",
    source="Coulomb's friction; equilibrium of the crane",
)


def _ramp_limit(spec: Travelling, scene: TravelScene) -> Estimate:
    """All that the motors give.

    **Range** drives that keep to a ramp of speed.
    **Error** none: a definition.
    **Source** the mean starting torque of the file.
    """
    return Estimate.exact(1.0)


RAMP: OneCheck = only(lambda spec, scene: model.commanded(spec, _moving(scene)) is not None)(
    Check(
        code="CRN156",
        title="motor torque demand on the speed ramp",
        question="Can the motors deliver the torque that the speed ramp requires?",
        failure="motors cannot follow the speed ramp",
        scenes=MOVES,
        loads=("drive_utilisation",),
        sense=Sense.AT_MOST,
        limit=_ramp_limit,
        needs=no_needs,
        blame=lambda spec, scene, loads: torque_key(spec),
        repair=torque_repair,
        what="The motor torque required by the ramp, at the maximum pull of the load, is at most the mean starting"
        " torque of the motors.",
        why="A converter at its torque limit does not follow the ramp. Start time, sway and adhesion then differ from"
        " those of the ramp.",
        formula="J e + (m a + W + H) r/(u eta) <= M_mean",
        source="balance of forces; power balance of the gear",
    )
)

# -- wheel loads ----------------------------------------------------------------------------------------------------


def _wheel_limit(spec: Travelling, scene: TravelScene) -> Estimate:
    """Largest load of a wheel by its rating.

    **Range** any wheel and rail.
    **Error** none: a limit of the file.
    **Source** the maker of wheel or rail.
    """
    rating = spec.wheels.rating
    return Estimate.exact(math.inf if rating is None else rating)


WHEEL: OneCheck = Check(
    code="CRN157",
    title="maximum wheel load",
    question="Is the largest wheel load within the rating of wheel and rail?",
    failure="wheel load exceeds its rating",
    scenes=MOVES | RUNNING,
    loads=("wheel_load_max",),
    sense=Sense.AT_MOST,
    limit=_wheel_limit,
    needs=lambda spec, scene: (("wheels", "rating"),),
    blame=blames("wheels", "rating"),
    repair=at("wheels", "rating"),
    what="The load of every wheel is at most its rating. The trolley is in its worst position, and the crane starts or"
    " stops.",
    why="Wheel treads pit and rails roll out. The runway is designed for this load.",
    formula="N = sum G b_s/2 +- (m a h + H h_r + F_w h_w)/B",
    source="equilibrium of the crane",
)


def _lift_limit(spec: Travelling, scene: TravelScene) -> Estimate:
    """A wheel stays on its rail.

    **Range** any crane.
    **Error** none: a wheel does not pull.
    **Source** equilibrium.
    """
    return Estimate.exact(0.0)


LIFTS: OneCheck = Check(
    code="CRN158",
    title="minimum wheel load",
    question="Do all wheels stay in contact with the rail?",
    failure="wheel lifts off the rail",
    scenes=MOVES | RUNNING,
    loads=("wheel_load_min",),
    sense=Sense.AT_LEAST,
    limit=_lift_limit,
    needs=no_needs,
    blame=lambda spec, scene, loads: ("wheels", "base"),
    repair=at("wheels", "base"),
    what="The load of every wheel is at least zero, so that every wheel stays on the rail. The trolley is in its worst"
    " position, and the crane starts or stops.",
    why="A wheel without contact does not drive, brake or guide. A high gantry on a short wheel base tips.",
    formula="N = sum G b_s/2 +- (m a h + H h_r + F_w h_w)/B >= 0",
    source="equilibrium of the crane",
)


def _stability_limit(spec: Travelling, scene: TravelScene) -> Estimate:
    """Moments that keep the crane on its wheels at least those that tip it, both with partial factors.

    **Range** any crane.
    **Error** none: a balance; the factors are those of the edition.
    **Source** EN 13001-2, FEM 1.001.
    """
    return Estimate.exact(spec.checks.stability)


TIPS: OneCheck = Check(
    code="CRN159",
    title="stability ratio",
    question="Do the stabilising moments exceed the tipping moments by the required ratio?",
    failure="stability ratio is too small",
    limit_state=LimitState("crane tips", 1),
    scenes=MOVES | RUNNING | {Storm},
    loads=("stability_reserve",),
    sense=Sense.AT_LEAST,
    limit=_stability_limit,
    needs=no_needs,
    blame=lambda spec, scene, loads: ("wheels", "base"),
    repair=at("wheels", "base"),
    what="About each tipping edge of the wheels, the stabilising moment is at least the required multiple of the"
    " tipping moment. The partial factors of the edition (`class.stability`) apply: they increase loads, drive forces"
    " and wind, and reduce the stabilising weight.",
    why="Equal moments do not prove stability, because weights, loads and wind are not known with that accuracy.",
    formula="sum k_h G b / (sum k_o G b' + k_l (m a h + H h_r) + k_w F_w h_w) >= 1",
    source="equilibrium; EN 13001-2, ISO 8686-1; FEM 1.001",
)

CHECKS: tuple[AnyCheck, ...] = (SLOW, LONG_STOP, LONG_WAY, SWAY, RESIDUAL, SKID, RAMP, WHEEL, LIFTS, TIPS)
"""The drive is judged in `checks_drive`, buffers, rails, storm and factors in `checks_events`."""
