"""Slewing cranes for tests: plain data of design files."""

from typing import Any

COURSE: dict[str, Any] = {
    "kind": "crane",
    "type": "slewing",
    "scenes": [{"type": "slew"}],
    "inertia": "60826 kg*m^2",
    "speed": "2 rpm",
    "friction": "983.8 N*m",
    "wind": {"steady": "2184.4 N*m", "maximum": "3120.6 N*m"},
    "motor": {"inertia": "0.021 kg*m^2", "coupling_factor": 1.7, "mean_starting_torque": "37 N*m"},
    "gear": {
        "ratio": 400,
        "efficiency": 0.7,
        "rotating_factor": 1.15,
        "open": {"ratio": 10, "efficiency": 0.95},
    },
    "cycle": {"rotation": "180 deg", "brake_angle": "15 deg"},
    "handbook": {"start_time": "8 s"},
}
"""What is printed of the course project's crane on a fixed column."""

NOTES: dict[str, Any] = {
    "kind": "crane",
    "type": "slewing",
    "scenes": [{"type": "slew"}],
    "load": {"mass": "5000 kg", "radius": "8 m"},
    "slewing_part": {"mass": "8000 kg", "radius": "2.5 m"},
    "counterweight": {"mass": "6000 kg", "radius": "3 m"},
    "speed": "0.15708 rad/s",
    "friction": "9000 N*m",
    "motor": {"inertia": "0.12 kg*m^2", "coupling_inertia": "0 kg*m^2"},
    "gear": {"ratio": 900, "efficiency": 0.8, "reverse_efficiency": 0.8, "rotating_factor": 1.15},
    "cycle": {"brake_angle": "22.5 deg", "start_time": "5 s"},
}
"""The crane of the lecture notes on slewing inertia, its start given by its time."""

YARD: dict[str, Any] = {
    "kind": "crane",
    "type": "slewing",
    "scenes": [{"type": "slew"}],
    "load": {"mass": "3 t", "hook_block": "60 kg", "radius": "8 m", "rope_length": "5 m"},
    "slewing_part": {"mass": "8 t", "radius": "0.3 m", "inertia": "9000 kg*m^2"},
    "counterweight": {"mass": "5 t", "radius": "2.6 m"},
    "jib": {"mass": "1.2 t", "length": "8 m"},
    "speed": "1 rpm",
    "friction": "2 kN*m",
    "wind": {"steady": "1.5 kN*m", "maximum": "4 kN*m"},
    "motor": {
        "inertia": "0.02 kg*m^2",
        "coupling_factor": 1.7,
        "mean_starting_torque": "15 N*m",
        "speed": "900 rpm",
        "power": "1.5 kW",
    },
    "gear": {"ratio": 900, "efficiency": 0.72, "open": {"ratio": 9, "efficiency": 0.95}},
    "brake": {"torque": "12 N*m", "delay": "0.1 s"},
    "cycle": {"brake_angle": "15 deg"},
}
"""A whole crane, given by its parts."""
