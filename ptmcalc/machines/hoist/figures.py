"""What of a hoist people look at: the force of the rope in a lift or a stop with its phases, and what winding adds."""

from ptmcalc.contract.figure import Course, Figure

_MOVING = ("lift", "start", "stop", "lower_brake", "release")
_MOMENTS = (
    ("tension_time", "the rope is taut"),
    ("lift_off_time", "the load leaves the ground"),
    ("start_time", "full speed"),
    ("stop_time", "drum at standstill"),
)

FIGURES = (
    Figure(
        "rope_force",
        "Force of the rope over time, with its phases",
        _MOVING,
        (Course("rope_force_max", ("rope_force_min",), "force of the rope"),),
        "force of all falls",
        moments=_MOMENTS,
    ),
    Figure(
        "shaft_torque",
        "Torque of the drive over time",
        _MOVING,
        (Course("backlash_torque_peak", title="torque of the shaft"),),
        "torque",
        moments=_MOMENTS,
    ),
    Figure(
        "winding",
        "Rope stress added by the layer change",
        ("winding",),
        (Course("winding_stress_max"), Course("winding_stress_paper")),
        "additional stress",
    ),
)
