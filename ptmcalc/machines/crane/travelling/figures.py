"""What of a travelling crane people look at: how the load swings, and how it pulls at the crane."""

from ptmcalc.contract.figure import Course, Figure

_MOVING = ("start", "brake", "hoist_while_travelling")
_MOMENTS = (("start_time", "full speed"), ("brake_time", "crane at standstill"))

FIGURES = (
    Figure(
        "sway",
        "Sway angle of the load over time",
        _MOVING,
        (Course("sway_angle_max", ("sway_residual",), "angle of the load"),),
        "angle of the rope",
        moments=_MOMENTS,
    ),
    Figure(
        "pull",
        "Horizontal force of the load over time",
        _MOVING,
        (Course("horizontal_force", title="force of the load on the crane"),),
        "horizontal force",
        moments=_MOMENTS,
    ),
)
