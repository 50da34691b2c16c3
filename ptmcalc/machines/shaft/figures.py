"""What of a main shaft people look at: its tachogram, and the even running of a cycle."""

from ptmcalc.contract.figure import Course, Figure

FIGURES = (
    Figure(
        "tachogram",
        "Tachogram: speed over time",
        ("run_up", "run_out"),
        (
            Course("run_up_time", title="speed of the main shaft"),
            Course("run_out_time", ("speed_run_out",), "speed of the main shaft"),
        ),
        "speed",
        moments=(("run_up_time", "end of run-up"), ("run_out_time", "shaft at standstill")),
    ),
    Figure(
        "way_of_the_shaft",
        "Angle over time",
        ("run_up", "run_out"),
        (
            Course("run_up_angle", title="rotation angle of the main shaft"),
            Course("run_out_angle", title="rotation angle of the main shaft"),
        ),
        "angle turned",
    ),
    Figure(
        "cycle",
        "Speed over a cycle",
        ("steady",),
        (Course("speed_max", ("speed_min", "speed_mean"), "speed of the main shaft"),),
        "speed",
    ),
    Figure(
        "cycle_torque",
        "Torque of the motor over a cycle",
        ("steady",),
        (Course("torque_motor_max", ("torque_motor_rms",), "torque of the motor"),),
        "motor torque",
    ),
)
