"""Checks of starts and stops: times, distance, sway, adhesion, ramp torque."""

from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import AnyCheck, Check, LimitState, Sense, no_needs, no_repair, only
from ptmcalc.contract.limits import fixed, key
from ptmcalc.machines.crane.travelling.machine import model
from ptmcalc.machines.crane.travelling.machine.judging import (
    MOVES,
    STARTS,
    Loads,
    OneCheck,
    curve_number,
    hangs,
    rate_key,
    torque_key,
    torque_repair,
)
from ptmcalc.machines.crane.travelling.machine.scenes import (
    Brake,
    HoistWhileTravelling,
    Moving,
    Start,
    TravelScene,
)
from ptmcalc.machines.crane.travelling.machine.spec import Travelling


def _moving(scene: TravelScene) -> Moving:
    assert isinstance(scene, Start | Brake | HoistWhileTravelling)
    return scene


def _rate_repair(spec: Travelling, scene: TravelScene) -> KeyPath:
    return curve_number(spec, rate_key(spec, _moving(scene)))


def _rate_blame(spec: Travelling, scene: TravelScene, loads: Loads) -> KeyPath:
    return rate_key(spec, _moving(scene))


SLOW: OneCheck = Check(
    code="CRN150",
    title="travel start time",
    question="Does the crane reach travel speed within the limit against wind and slope?",
    failure="crane takes too long to start travelling",
    limit_state=LimitState("travel drive stalls"),
    scenes=STARTS,
    loads=("start_time",),
    sense=Sense.AT_MOST,
    limit=key(
        "checks.start_time",
        meaning="Maximum starting time, 15 s by default",
        valid="any crane",
        error="none: an engineering rule; 5 to 10 s is usual",
        source="handbooks of lifting machines",
    ),
    needs=no_needs,
    blame=_rate_blame,
    repair=_rate_repair,
    what="The crane reaches full travel speed within the maximum start time against wind and slope. The load sways"
    " behind the crane.",
    why="A drive with little excess torque stalls in the first gust. It heats its motors during the whole start.",
    formula="t = v m_red/(F - W), with the load swinging; infinite for F <= W: it stalls",
    source="balance of forces; pendulum under a pivot that is pushed",
)


LONG_STOP: OneCheck = Check(
    code="CRN151",
    title="travel stop time",
    question="Does the crane stop within the limit with wind and slope behind it?",
    failure="crane takes too long to stop",
    limit_state=LimitState("brakes do not stop the crane"),
    scenes=frozenset({Brake}),
    loads=("brake_time",),
    sense=Sense.AT_MOST,
    limit=key(
        "checks.brake_time",
        meaning="Maximum stopping time, 15 s by default",
        valid="any crane",
        error="none: an engineering rule",
        source="handbooks of lifting machines",
    ),
    needs=no_needs,
    blame=_rate_blame,
    repair=_rate_repair,
    what="The crane stops within the maximum stop time. Wind and slope act in the direction of travel, and the load"
    " pushes the crane.",
    why="A longer stopping time endangers people and end buffers ahead of the crane.",
    formula="t = t_d + ..., m_red x'' = -F_b(t) - W + M g theta; infinite where brakes do not hold wind and slope",
    source="balance of forces; pendulum under a pivot that is pushed",
)


LONG_WAY: OneCheck = only(lambda spec, scene: spec.checks.brake_distance is not None)(
    Check(
        code="CRN152",
        hazard=True,
        title="travel stopping distance",
        question="Does the crane stop within the permissible distance?",
        failure="stopping distance is too long",
        scenes=frozenset({Brake}),
        loads=("brake_distance",),
        sense=Sense.AT_MOST,
        limit=key(
            "checks.brake_distance",
            meaning="Permissible stopping distance, given in the file",
            valid="any crane",
            error="none: a limit of the file",
        ),
        needs=no_needs,
        blame=_rate_blame,
        repair=_rate_repair,
        what="The stopping distance of the crane is at most the limit.",
        why="The settings of limit switches and the reactions of operators rely on this distance.",
        formula="s = integral of x' from the command to rest",
        source="balance of forces",
    )
)


SWAY: OneCheck = only(hangs)(
    Check(
        code="CRN153",
        title="maximum load sway angle",
        question="Is the sway angle of the load within its limit?",
        failure="load sways too far",
        scenes=MOVES,
        loads=("sway_angle_max",),
        sense=Sense.AT_MOST,
        limit=key(
            "checks.sway_angle",
            meaning="Maximum sway angle of the load, 10 deg by default",
            valid="any crane",
            error="none: an engineering rule; 3 to 6 deg if loads are guided by hand",
            source="the file, otherwise usual practice",
        ),
        needs=no_needs,
        blame=_rate_blame,
        repair=_rate_repair,
        what="The angle of the ropes from the vertical is at most the limit, during the start or stop and after it.",
        why="A load that sways hits obstacles. It acts on the crane with twice its share of the force.",
        formula="theta = 2 atan(a/g) from rest under a sudden a; less for ramps that match the period",
        source="pendulum under a moved pivot",
    )
)


RESIDUAL: OneCheck = only(lambda spec, scene: hangs(spec, scene) and spec.checks.residual_sway is not None)(
    Check(
        code="CRN154",
        title="residual load sway",
        question="Is the sway left after the start or stop within its limit?",
        failure="residual sway is too large",
        scenes=MOVES,
        loads=("sway_residual",),
        sense=Sense.AT_MOST,
        limit=key(
            "checks.residual_sway",
            meaning="Permissible residual sway angle, given in the file",
            valid="any crane",
            error="none: a limit of the file",
        ),
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


def _skid_repair(spec: Travelling, scene: TravelScene) -> KeyPath:
    key = rate_key(spec, _moving(scene))
    return key if key[-1] not in ("curve", "mean_starting_torque", "largest_starting_torque") else ()


SKID: OneCheck = Check(
    code="CRN155",
    hazard=True,
    title="wheel adhesion reserve",
    question="Does every driven or braked wheel transmit its force without slip?",
    failure="adhesion reserve of a driven wheel is too small",
    limit_state=LimitState("driven wheel slips on the rail", 1),
    scenes=MOVES,
    loads=("skid_reserve_min",),
    sense=Sense.AT_LEAST,
    limit=key(
        "checks.skid_reserve",
        meaning="Minimum ratio of the adhesion to the required force of a driven wheel, 1.2 by default",
        valid="steel wheels on rails",
        error="none: an engineering rule",
        source="handbooks of lifting machines",
    ),
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


RAMP: OneCheck = only(lambda spec, scene: model.commanded(spec, _moving(scene)) is not None)(
    Check(
        code="CRN156",
        title="motor torque demand on the speed ramp",
        question="Can the motors deliver the torque that the speed ramp requires?",
        failure="motors cannot follow the speed ramp",
        scenes=MOVES,
        loads=("drive_utilisation",),
        sense=Sense.AT_MOST,
        limit=fixed(
            1.0,
            meaning="The full torque of the motors",
            valid="drives on a speed ramp",
            error="none: a definition",
            source="the mean starting torque of the file",
        ),
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

CHECKS_OF_SWAY: tuple[AnyCheck, ...] = (SLOW, LONG_STOP, LONG_WAY, SWAY, RESIDUAL, SKID, RAMP)
