"""Checks of an emergency stop: descent of the load, heat, temperature and wear of the brake."""

from collections.abc import Callable

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import AnyCheck, Check, LimitState, Sense, at, blames, no_needs, no_repair, only
from ptmcalc.contract.limits import key
from ptmcalc.machines.hoist.braking.loads import DESCENT, HEAT, REPEATED, STOPS
from ptmcalc.machines.hoist.machine.spec import EmergencyStop, Hoist

OneCheck = Check[Hoist, EmergencyStop]
_STOPPED = frozenset({EmergencyStop})
_KEPT = LimitState("brake does not stop the load")


def _descent_limit(spec: Hoist, scene: EmergencyStop) -> Estimate:
    """Stopping distance of the file, at most the height of the hook above the ground in the scene, or the lifting
    height.

    **Range** a load that is lowered, or sinks after it was hoisted.
    **Error** none: a chosen limit.
    **Source** the plant's rules; the ground.
    """
    ground = scene.hook_height or spec.height
    given = spec.checks.stop_distance
    return Estimate.exact(ground if given is None else min(given, ground))


def _needs_distance(spec: Hoist, scene: EmergencyStop) -> tuple[KeyPath, ...]:
    """A distance: without one, the load might be just above the ground."""
    known = spec.checks.stop_distance is not None or scene.hook_height is not None
    return () if known else (("checks", "stop_distance"),)


DESCENDS: OneCheck = Check(
    code="HST128",
    hazard=True,
    title="descent of the load in an emergency stop",
    question="Does the brake stop the load after a power failure within the permissible distance, above the ground?",
    failure="load descends too far before it stops",
    limit_state=_KEPT,
    scenes=_STOPPED,
    loads=(DESCENT,),
    sense=Sense.AT_MOST,
    limit=_descent_limit,
    needs=_needs_distance,
    blame=blames("brake", "torque"),
    repair=no_repair,
    what="After a power failure the load descends at most the distance of the file and not to the ground. A brake that"
    " does not stop the load fails. A load that is hoisted may sink before the brake closes.",
    why="The load accelerates during the delay of the brake. It then has more energy than at the rated speed.",
    formula="phi R n_r/(u m) <= limit",
    source="motion of the rigid drive with delay and rise of the brake",
)


def _has(*names: str) -> Callable[[Hoist, EmergencyStop], bool]:
    """Whether the file gives one of the keys of the brake."""
    return lambda spec, scene: any(getattr(spec.brake, name) is not None for name in names)


def _lacks(*names: str) -> Callable[[Hoist, EmergencyStop], tuple[KeyPath, ...]]:
    """Those keys of the brake that the file does not give."""
    return lambda spec, scene: tuple(("brake", name) for name in names if getattr(spec.brake, name) is None)


STOP_HEAT: OneCheck = only(_has("stop_heat"))(
    Check(
        code="HST129",
        title="brake heat per emergency stop",
        question="Is the friction work of an emergency stop within the data-sheet value of the brake?",
        failure="friction work of the stop exceeds the data-sheet value of the brake",
        limit_state=_KEPT,
        scenes=_STOPPED,
        loads=(HEAT,),
        sense=Sense.AT_MOST,
        limit=key(
            "brake.stop_heat",
            meaning="Permissible friction work of one stop, from the data sheet",
            valid="all brakes together, at the number of stops per hour of the data sheet",
            error="none: a given value",
            source="the manufacturer's data",
        ),
        needs=no_needs,
        blame=blames("brake", "stop_heat"),
        repair=at("brake", "stop_heat"),
        what="The friction work of an emergency stop is at most the data-sheet value. It contains the work of the load"
        " until the drive is at rest.",
        why="A brake that takes too much heat in one stop loses its friction before the load is at rest.",
        formula="J w_0^2/2 + M_L phi <= Q_perm",
        source="energy balance of the stop; the manufacturer's data",
    )
)

TEMPERATURE: OneCheck = only(_has("temperature_rise"))(
    Check(
        code="HST130",
        title="brake temperature rise in repeated stops",
        question="Does the brake stay below its permissible temperature in repeated emergency stops?",
        failure="repeated stops overheat the brake",
        limit_state=_KEPT,
        scenes=_STOPPED,
        loads=(REPEATED,),
        sense=Sense.AT_MOST,
        limit=key(
            "brake.temperature_rise",
            meaning="Permissible temperature rise of the discs above the ambient air",
            valid="organic linings 180 to 230 K, sintered linings 380 to 580 K: engineering values, to be compared with"
            " the data sheet",
            error="none: a given value",
            source="the manufacturer's data",
        ),
        needs=_lacks("disc_mass", "stops_per_hour"),
        blame=blames("brake", "disc_mass"),
        repair=at("brake", "disc_mass"),
        what="The temperature rise of the discs just after a stop, in the steady state of equal stops, is at most the"
        " permissible rise.",
        why="The friction of a lining falls with its temperature, and the brake torque with it.",
        formula="dT/(1 - exp(-t_c/tau)) <= dT_perm",
        source="geometric series of equal stops; the manufacturer's data",
    )
)

WEAR: OneCheck = only(_has("stops_per_service"))(
    Check(
        code="HST131",
        title="emergency stops until brake service",
        question="Does the lining last for the emergency stops between two services?",
        failure="lining is worn before the next service",
        limit_state=LimitState("brake does not stop the load", 0),
        scenes=_STOPPED,
        loads=(STOPS,),
        sense=Sense.AT_LEAST,
        limit=key(
            "brake.stops_per_service",
            meaning="Emergency stops between two services of the brake",
            valid="brakes whose lining wears in emergency stops only, as with a converter",
            error="none: a given value",
            source="the plant's rules",
        ),
        needs=_lacks("friction_work"),
        blame=blames("brake", "friction_work"),
        repair=at("brake", "friction_work"),
        what="The permissible friction work of the lining, divided by the friction work of a stop, is at least the"
        " number of emergency stops between two services.",
        why="A worn lining no longer reaches the brake disc, and the brake torque is lost.",
        formula="W_perm/Q >= N",
        source="wear in proportion to the friction work; the manufacturer's data",
    )
)

CHECKS_OF_BRAKING: tuple[AnyCheck, ...] = (DESCENDS, STOP_HEAT, TEMPERATURE, WEAR)
