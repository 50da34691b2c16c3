"""What of a stacker crane people look at: the tip of the mast in the window of its fork, and a collision."""

from ptmcalc.contract.figure import Course, Figure, Marks, Moment, Threshold
from ptmcalc.contract.report import SceneReport
from ptmcalc.machines.crane.stacking.machine.spec import Stacker

_DRIVEN = ("start", "brake")


def _window(spec: Stacker, scene: SceneReport) -> Marks:
    """To either side of where the fork goes in, and after a stop how long the fork waits at most."""
    half = spec.settling.window
    if half is None:
        return Marks()
    thresholds = (Threshold(half, "window of the fork"), Threshold(-half, "window of the fork"))
    loads = {load.info.name: load.estimate.value for load in scene.loads}
    stands, settles = loads.get("brake_time"), loads.get("settling_time")
    moments: tuple[Moment, ...] = () if stands is None else (Moment(stands, "crane at standstill"),)
    if stands is not None and settles:
        moments += (Moment(stands + settles, "mast tip within the positioning tolerance"),)
    return Marks(thresholds=thresholds, moments=moments)


FIGURES = (
    Figure(
        "mast_tip",
        "Mast tip over time, with the positioning tolerance",
        _DRIVEN,
        (Course("mast_deflection_max", title="deflection of the tip"),),
        "deflection of the tip",
        moments=(("start_time", "full speed"),),
        marks=_window,
    ),
    Figure(
        "mast_force",
        "Mast force over time",
        _DRIVEN,
        (Course("mast_force_max", title="mast force"),),
        "force",
    ),
    Figure(
        "collision",
        "Forces of a collision over time",
        ("obstacle",),
        (
            Course("contact_force", title="force on the obstacle"),
            Course("collision_force", title="mast force"),
        ),
        "force",
    ),
)
