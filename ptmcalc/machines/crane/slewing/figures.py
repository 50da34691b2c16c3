"""What of a slewing crane people look at: how the load swings."""

from ptmcalc.contract.figure import Course, Figure

FIGURES = (
    Figure(
        "sway",
        "Sway angles of the load over time",
        ("slew",),
        (Course("sway_tangential_max"), Course("sway_radial_max")),
        "angle of the rope",
        moments=(("start_time", "full speed"),),
    ),
)
