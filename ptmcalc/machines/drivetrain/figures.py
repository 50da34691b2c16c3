"""What of a drive train people look at: torques of its links and speeds of its parts over time."""

from ptmcalc.contract.figure import Course, Figure

_SCENES = ("run", "start", "stop")
_MOMENTS = (("start_time", "full speed"), ("stop_time", "at rest"))

FIGURES = (
    Figure(
        "link_torques", "Torques of the links over time", _SCENES, (Course("torque_peak"),), "torque", moments=_MOMENTS
    ),
    Figure("motor_torques", "Torques of the motors over time", _SCENES, (Course("motor_torque_peak"),), "torque"),
    Figure("speeds", "Speeds over time", _SCENES, (Course("speed_max", title="speed"),), "speed", moments=_MOMENTS),
)
