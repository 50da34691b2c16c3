"""What of a conveyor people look at: tension over time and along the belt, grip of the drums, and when it runs out."""

from ptmcalc.base.units import SPAN, digits
from ptmcalc.contract.figure import Course, Figure, Marks, Moment, Threshold
from ptmcalc.contract.report import SceneReport
from ptmcalc.machines.conveyor.machine.spec import Conveyor

_IN_MOTION = ("start", "stop", "emergency_stop", "controlled_stop", "coast", "jam")


def _all_of_it(spec: Conveyor, scene: SceneReport) -> Marks:
    """At 1 the drum slips; and when the reserve is least."""
    least = next((load for load in scene.loads if load.info.name == "slip_reserve_min" and "time" in load.at), None)
    moments = (Moment(least.at["time"], f"least reserve, {digits(least.estimate.value)}"),) if least else ()
    return Marks(thresholds=(Threshold(1.0, "traction fully used: the belt slips"),), moments=moments)


def _tail(spec: Conveyor, scene: SceneReport) -> Marks:
    """Where the belt turns."""
    return Marks(moments=(Moment(spec.route.span, "tail drum"),))


FIGURES = (
    Figure(
        "tension_over_time",
        "Belt tension at the drive over time",
        _IN_MOTION,
        (
            Course("tension_run_on_max", title="entering tension"),
            Course("tension_run_off_min", title="leaving tension"),
        ),
        "belt tension",
    ),
    Figure(
        "speed_over_time",
        "Belt speed at head and tail over time",
        _IN_MOTION,
        (Course("belt_speed_max", title="belt speed"),),
        "belt speed",
        moments=(("stop_time", "belt at standstill"), ("start_time_rigid", "full speed of the rigid belt")),
    ),
    Figure(
        "slip_over_time",
        "Traction utilisation over time",
        _IN_MOTION,
        (Course("slip_utilisation_max", title="traction utilisation"),),
        "traction utilisation",
        moments=(("stop_time", "belt at standstill"), ("start_time_rigid", "full speed of the rigid belt")),
        marks=_all_of_it,
    ),
    Figure(
        "tension_over_position",
        "Belt tension around the loop",
        ("run", *_IN_MOTION),
        (
            Course("tension_max", title="maximum tension at each position"),
            Course("tension_min", title="minimum tension at each position"),
        ),
        "belt tension",
        over=SPAN,
        across="distance after the head pulley",
        marks=_tail,
    ),
)
