"""Machines over ten decades in every parameter: conveyors, hoists and the four cranes, as the data of a design file.

Every size is a designer's number times a power of ten from -5 to 5, each drawn for itself: what comes out is no sound
machine, and its file may be refused with a clear message. A `Pick` says where the numbers come from, a strategy of
Hypothesis or a generator with a seed.
"""

from collections.abc import Callable, Sequence
from typing import Any, Protocol, TypeVar

import numpy as np
from hypothesis import strategies as st

DECADES = 5.0
One = TypeVar("One")
Data = dict[str, Any]


class Pick(Protocol):
    """Where the numbers of a machine come from."""

    def real(self, low: float, high: float) -> float:
        """Any number from low to high."""

    def one(self, choices: Sequence[One]) -> One:
        """Any of several things."""


class Seeded:
    """Numbers of a generator with a seed."""

    def __init__(self, *seed: int) -> None:
        self.rng = np.random.default_rng(seed)

    def real(self, low: float, high: float) -> float:
        return float(self.rng.uniform(low, high))

    def one(self, choices: Sequence[One]) -> One:
        return choices[int(self.rng.integers(len(choices)))]


class Drawn:
    """Numbers that Hypothesis draws and shrinks."""

    def __init__(self, draw: Callable[[Any], Any]) -> None:
        self.draw = draw

    def real(self, low: float, high: float) -> float:
        value: float = self.draw(st.floats(low, high, allow_nan=False))
        return min(max(value, low), high)

    def one(self, choices: Sequence[One]) -> One:
        value: One = self.draw(st.sampled_from(choices))
        return value


class Sizes:
    """Quantities around a designer's number, and shares that are what they are."""

    def __init__(self, pick: Pick, decades: float = DECADES) -> None:
        self.pick, self.decades = pick, decades

    def number(self, centre: float) -> float:
        """The number times any power of ten within the decades."""
        return centre * 10 ** self.pick.real(-self.decades, self.decades)

    def __call__(self, centre: float, unit: str) -> str:
        return f"{self.number(centre)!r} {unit}"

    def maybe(self, centre: float, unit: str) -> str:
        """The quantity, or none of it."""
        return self.pick.one((f"0 {unit}", self(centre, unit)))

    def share(self, low: float = 0.05, high: float = 1.0) -> float:
        """A share, an efficiency."""
        return self.pick.one((high, self.pick.real(low, high)))

    def above(self, text: str, most: float) -> str:
        """A quantity of so many times another one, from once on."""
        number, unit = text.split(" ")
        return f"{float(number) * 10 ** self.pick.real(0, most)!r} {unit}"

    def below(self, text: str, least: float) -> str:
        """A quantity of less than half of another one, down to so many decades less."""
        number, unit = text.split(" ")
        return f"{float(number) * 10 ** self.pick.real(-least, -0.31)!r} {unit}"


def _motor(s: Sizes, torque: float, speed: float, inertia: float) -> Data:
    """A motor by its mean starting torque, or by a curve whose rated values are not said twice."""
    kind = s.pick.one(("torque", "linear", "induction"))
    found: Data = {"inertia": s(inertia, "kg*m^2")}
    if kind == "torque":
        return found | {"mean_starting_torque": s(1.5 * torque, "N*m"), "rated_torque": s(torque, "N*m")}
    synchronous = s(1.05 * speed, "rad/s")
    if kind == "linear":
        found["rated_torque"] = s(torque, "N*m")
        curve = {"type": "linear", "starting_torque": s(2 * torque, "N*m"), "no_load_speed": synchronous}
        return found | {"curve": curve}
    own = float(synchronous.split(" ")[0]) * (1 - 10 ** s.pick.real(-6, -0.01))
    power = f"{own * s.number(torque)!r} W"
    curve = {"type": "induction", "power": power, "speed": f"{own!r} rad/s", "synchronous_speed": synchronous}
    return found | {"curve": curve | {"overload": s.pick.one((1.001, 2.5, 5.0))}}


def slewing(pick: Pick, decades: float = DECADES) -> Data:
    """A slewing crane."""
    s = Sizes(pick, decades)
    steady = s.maybe(2e3, "N*m")
    ratio = s.number(400)
    rotation = f"{pick.real(20, 400)!r} deg"
    efficiency = s.share(0.3)
    data: Data = {
        "kind": "crane",
        "type": "slewing",
        "load": {
            "mass": s(1e3, "kg"), "hook_block": s.maybe(50, "kg"), "radius": s(5, "m"), "rope_length": s(6, "m"),
        },
        "slewing_part": {"mass": s(8e3, "kg"), "radius": s(0.3, "m"), "inertia": s(9e3, "kg*m^2")},
        "counterweight": {"mass": s(5e3, "kg"), "radius": s(2.6, "m")},
        "jib": {"mass": s(1e3, "kg"), "length": s(8, "m")},
        "speed": s(0.2, "rad/s"),
        "friction": s.maybe(1e3, "N*m"),
        "wind": {"steady": steady, "maximum": s.above(steady, 3)},
        "motor": _motor(s, 26, 84, 0.02),
        "gear": {"ratio": ratio, "efficiency": efficiency},
        "brake": {
            "torque": s(16, "N*m"), "delay": s.maybe(0.1, "s"), "rise_time": s.maybe(0.1, "s"),
            "shaft": pick.one(("motor", "crane")),
        },
        "cycle": {"rotation": rotation, "brake_angle": f"{pick.real(1, 15)!r} deg", "pause": s.maybe(40, "s")},
        "ring": {"mass_above": s(5.5e3, "kg"), "unbalance": s(-2e4, "N*m"), "head_height": s.maybe(4, "m")},
    }  # fmt: skip
    if pick.one((True, False)):
        data["wind"]["gust"] = s(1e3, "N*m")
        data["wind"].pop("maximum")
    return data


def travelling(pick: Pick, decades: float = DECADES) -> Data:
    """A crane that travels, in a start, a stop, and one scene of another sort."""
    s = Sizes(pick, decades)
    span = s(22.5, "m")
    speed = s(1.05, "m/s")
    motor = {"count": pick.one((1, 2))} | _motor(s, 20, 146, 0.006)
    brake = {"torque": s(16, "N*m"), "delay": s.maybe(0.1, "s"), "rise_time": s.maybe(0.1, "s")}
    drive: Data = {"motor": motor, "gear": {"ratio": s.number(22), "efficiency": s.share(0.55)}, "brake": brake}
    if pick.one((True, False)):
        drive |= {"acceleration": s(0.13, "m/s^2"), "deceleration": s(0.15, "m/s^2")}
    kind = pick.one(("linear", "progressive", "constant", "hydraulic"))
    hard = {
        "linear": ("stiffness", 4e5, "N/m"), "progressive": ("end_force", 8e4, "N"),
        "constant": ("force", 6e4, "N"), "hydraulic": ("orifice", 3e4, "kg/m"),
    }[kind]  # fmt: skip
    wind = s(150, "Pa")
    others = [
        {"type": "run"},
        {"type": "hoist_while_travelling", "hoist": pick.one(("up", "down"))},
        {"type": "collision", "suspension": pick.one(("swinging", "guided")), "drive": pick.one(("on", "off"))},
        {"type": "rail_step"},
        {"type": "skew"},
        {"type": "storm"},
    ]
    return {
        "kind": "crane",
        "type": "travelling",
        "load": s(1e4, "kg"),
        "hook_block": s.maybe(250, "kg"),
        "bridge": {"mass": s(1.3e4, "kg"), "span": span, "height": s.maybe(0.6, "m")},
        "trolley": {"mass": s(2.2e3, "kg"), "nearest": s.below(span, 3), "height": s.maybe(1.1, "m")},
        "wheels": {
            "diameter": s(0.315, "m"), "base": s(3.6, "m"),
            "driven": pick.one((["A1", "B1"], ["A1", "A2", "B1", "B2"])),
            "frame": pick.one(("hinged", "rigid")), "inertia": s.maybe(0.25, "kg*m^2"), "rating": s(1.2e5, "N"),
        },
        "rolling": {"coefficient": s.pick.one((0.0, 1e-6, 0.008, 0.3))},
        "rail": {
            "adhesion": s.pick.one((1e-6, 0.14, 1.0)), "slope": s.pick.one((0.0, 1e-6, 0.002, 0.1)),
            "step": s(5e-4, "m"), "gap": s(4e-3, "m"), "frequency": s(8, "Hz"),
        },
        "guide": {"clearance": s(0.02, "m"), "rating": s(4e4, "N"), "rail_two": pick.one(("fixed", "movable"))},
        "wind": {
            "area": s.maybe(30, "m^2"), "load_area": s.maybe(6, "m^2"), "pressure": wind,
            "pressure_storm": s.above(wind, 3),
        },
        "speed": speed,
        "drive": drive,
        "suspension": {"length": s(8, "m"), "hoist_speed": s(0.13, "m/s")},
        "buffers": {"type": kind, hard[0]: s(hard[1], hard[2]), "stroke": s(0.15, "m"), "rating": s(6e4, "N")},
        "scenes": [
            {"type": "start", "wind": pick.one(("against", "with", "none"))},
            {"type": "brake", "by": "brake", "slope": pick.one(("against", "with", "none"))},
            pick.one(others),
        ],
    }  # fmt: skip


def hoist(pick: Pick, decades: float = DECADES) -> Data:
    """A hoist in three scenes."""
    s = Sizes(pick, decades)
    d = s(0.016, "m")
    wide = s.above(d, 3)
    motor = _motor(s, 144, 153, 0.13)
    gear: Data = {"ratio": s.number(106), "efficiency": s.share(0.3)}
    if pick.one((True, False)):
        gear |= {"stiffness": s(1.5e6, "N*m/rad"), "backlash": s.maybe(0.1, "deg"), "damping": s.pick.one((0, 0.03, 1))}
    brake = {"torque": s(250, "N*m"), "delay": s.maybe(0.1, "s"), "rise_time": s.maybe(0.1, "s")}
    height = s(12, "m")
    scenes = [
        {"type": "run"},
        {"type": "lift", "rope": pick.one(("slack", "taut"))},
        {"type": "start", "direction": pick.one(("up", "down"))},
        {"type": "start", "direction": "up", "load": "empty", "name": "start_empty"},
        {"type": "start", "profile": {"shape": "ramp", "time": s(2, "s")}, "name": "start_ramp"},
        {"type": "stop", "direction": pick.one(("up", "down"))},
        {"type": "lower_brake", "hook_height": s.below(height, 3)},
        {"type": "release", "share": pick.one((1.0, 0.5)), "manner": pick.one(("quick", "slow"))},
        {"type": "lift", "profile": {"shape": "cosine", "time": s(2, "s"), "control": "torque"}, "name": "lift_slow"},
    ]
    first = pick.one(range(len(scenes) - 2))
    data: Data = {
        "kind": "hoist",
        "load": s(1.25e4, "kg"),
        "hook_block": s(350, "kg"),
        "height": height,
        "least_fall": s(1.1, "m"),
        "speed": {"main": s(0.133, "m/s")},
        "reeving": {
            "falls": pick.one((1, 2, 4, 8, 64)), "sheave_efficiency": s.share(0.5), "lead_length": s.maybe(3, "m"),
        },
        "rope": {
            "diameter": d, "area": s(1.2e-4, "m^2"), "modulus": s(1.1e11, "Pa"), "mass": s(1.05, "kg/m"),
            "breaking_force": s(1.8e5, "N"), "damping": pick.one((0, 0.02, 0.3, 1)),
        },
        "drum": {"diameter": wide, "length": s.above(wide, 2), "inertia": s.maybe(14, "kg*m^2")},
        "gearbox": gear,
        "motor": motor,
        "brake": brake | {"shaft": pick.one(("motor", "drum"))},
        "class": {"mechanism": "M5", "hoisting": "HC2", "drive": "HD2"},
        "scenes": scenes[first : first + 3],
    }  # fmt: skip
    if pick.one((True, False)):
        data["structure"] = {"stiffness": s(6e6, "N/m"), "mass": s.maybe(6500, "kg"), "damping": pick.one((0, 0.05))}
    return data


def _travel(s: Sizes, speed: float) -> Data:
    found: Data = {"speed": s(speed, "m/s"), "resistance": s.maybe(1e3, "N")}
    if s.pick.one((True, False)):
        found |= {"acceleration": s(0.4, "m/s^2"), "deceleration": s(0.4, "m/s^2"), "ramp_rise": s.maybe(0.5, "s")}
    else:
        found |= {
            "driving_force": s(5e3, "N"), "driving_rise": s.maybe(0.8, "s"), "braking_force": s(4.5e3, "N"),
            "braking_rise": s.maybe(0.8, "s"), "braking_delay": s.maybe(0.2, "s"),
        }  # fmt: skip
    found["buffers"] = {"type": "linear", "stiffness": s(1.5e5, "N/m"), "stroke": s(0.35, "m"), "rating": s(5e4, "N")}
    return found


def _stacker(s: Sizes) -> Data:
    return {
        "kind": "crane",
        "load": s(1e3, "kg"),
        "carriage": {
            "mass": s(400, "kg"), "load_arm": s.maybe(0.9, "m"), "own_arm": s.maybe(0.35, "m"),
            "rollers": {
                "distance": s(1.2, "m"), "diameter": s(0.16, "m"), "axle_diameter": s(0.05, "m"), "rating": s(8e3, "N"),
            },
        },
        "hoisting": {
            "speed": s(0.2, "m/s"), "acceleration": s(0.3, "m/s^2"), "group": "M5",
            "rope": {"falls": 2, "breaking_force": s(6.6e4, "N"), "stiffness": s(1.1e6, "N/m")},
            "drive": {"reduced_mass": s(9e3, "kg"), "largest_force": s(3e4, "N"), "slope": s(6e4, "N*s/m")},
        },
        "settling": {"window": s(0.018, "m"), "wait": s(8, "s")},
    }  # fmt: skip


def _column(s: Sizes, length: str) -> Data:
    found: Data = {"length": length, "foot": s.maybe(0.3, "m"), "mass": s(1200, "kg")}
    found |= s.pick.one(
        ({"second_moment": s(2e-4, "m^4"), "section_modulus": s(1.3e-3, "m^3")}, {"stiffness": s(2e5, "N/m")})
    )
    if s.pick.one((True, False)):
        found["log_decrement"] = s.pick.one((1e-6, 0.15, 3))
    return found


def overhead_stacker(pick: Pick, decades: float = DECADES) -> Data:
    """An overhead stacker in three scenes."""
    s = Sizes(pick, decades)
    mechanism = pick.one(("bridge", "trolley"))
    column, girders = _column(s, s(6, "m")), {}
    if "stiffness" not in column:
        girders = {"girder_vertical": s(1.2e-3, "m^4"), "girder_horizontal": s(1.6e-4, "m^4")}
        girders["ends"] = pick.one(("supported", "clamped"))
    scenes = [
        {"type": "hoist", "direction": pick.one(("up", "down"))},
        {"type": "start", "mechanism": mechanism},
        {"type": "brake", "mechanism": mechanism, "load": pick.one(("full", "empty"))},
        {"type": "obstacle", "mechanism": mechanism, "brake": pick.one(("on", "off"))},
        {"type": "buffer", "mechanism": mechanism, "drive": pick.one(("on", "off"))},
        {"type": "fork_caught"},
        {"type": "stand"},
    ]
    first = pick.one(range(len(scenes) - 2))
    return _stacker(s) | {
        "type": "overhead_stacker",
        "bridge": {"mass": s(6e3, "kg"), "span": s(16.5, "m")} | girders,
        "trolley": {"mass": s(4e3, "kg"), "gauge": s(2, "m")},
        "column": column,
        "cab": {"mass": s.maybe(350, "kg"), "arm": s(-0.6, "m")},
        "bridge_travel": _travel(s, 1.0),
        "trolley_travel": _travel(s, 0.4),
        "obstacle": pick.one(
            ({"contact": "plastic"}, {"stiffness": s(8e6, "N/m"), "restitution": pick.one((0, 0.5, 1))})
        ),
        "rack": {"stiffness_vertical": s(2.5e6, "N/m")},
        "scenes": scenes[first : first + 3],
    }  # fmt: skip


def rack_stacker(pick: Pick, decades: float = DECADES) -> Data:
    """A rack stacker in three scenes."""
    s = Sizes(pick, decades)
    diameter, base = s(0.4, "m"), s(4.2, "m")
    gear = pick.one(
        (
            {"type": "progressive", "force": s(3.5e4, "N"), "stroke": s(0.4, "m")},
            {"type": "instantaneous", "stiffness": s(2e6, "N/m"), "stroke": s(0.4, "m")},
        )
    )
    scenes = [
        {"type": "stand"},
        {"type": "start"},
        {"type": "brake", "load": pick.one(("full", "empty"))},
        {"type": "buffer", "drive": pick.one(("on", "off"))},
        {"type": "fork_push"},
        {"type": "fork_caught"},
        {"type": "rail"},
        {"type": "safety_gear"},
        {"type": "hoist", "direction": pick.one(("up", "down"))},
    ]
    first = pick.one(range(len(scenes) - 2))
    return _stacker(s) | {
        "type": "rack_stacker",
        "base": {"mass": s(2.6e3, "kg"), "wheel_base": base, "wheel_diameter": diameter, "height": s.maybe(0.4, "m")},
        "column": _column(s, s(13.5, "m")) | {"top_guide": {"rating": s(1.2e4, "N")}},
        "travel": _travel(s, 2.0),
        "fork": {"mass": s(350, "kg"), "speed": s(0.3, "m/s"), "motor_force": s(1500, "N")},
        "rack": {"stiffness_push": s(3e5, "N/m"), "stiffness_vertical": s(2e6, "N/m")},
        "rail": {
            "step": s.below(diameter, 4), "gap": s.below(diameter, 4),
            "waviness": {"height": s(2e-3, "m"), "length": s(3, "m")}, "frequency": s(9, "Hz"),
            "damping": pick.one((0, 0.05, 0.5)),
        },
        "safety_gear": gear,
        "scenes": scenes[first : first + 3],
    }  # fmt: skip


def conveyor(pick: Pick, decades: float = DECADES) -> Data:
    """A conveyor in two scenes."""
    s = Sizes(pick, decades)
    length = s.number(1000)
    drum: Data = {"diameter": s(1, "m"), "wrap": s(210, "deg"), "inertia": s.maybe(400, "kg*m^2")}
    if pick.one((True, False, True)):
        drum["friction"] = s.number(0.35)
    takeup: Data = {"type": pick.one(("gravity", "rigid")), "tension": s(2.3e5, "N")}
    if takeup["type"] == "gravity" and pick.one((True, False)):
        takeup["mass"] = s(4.7e4, "kg")
    scenes: list[Data] = [
        {"type": "run"},
        {"type": "start"},
        {"type": "start", "load": "empty"},
        {"type": "start", "profile": {"shape": pick.one(("ramp", "cosine", "parabolic")), "time": s(10, "s")}},
        {"type": "start", "profile": {"shape": "ramp", "time": s(10, "s"), "control": "torque"}},
        {"type": "start", "belt": "relaxed"},
        {"type": "stop"},
        {"type": "emergency_stop"},
        {"type": "coast"},
        {"type": "jam", "at": pick.one(("head", "tail"))},
        {"type": "backstop"},
    ]
    return {
        "kind": "conveyor",
        "route": {"length": f"{length!r} m", "lift": f"{length * pick.real(-0.3, 0.3)!r} m"},
        "belt": {
            "mass": s(20, "kg/m"), "stiffness": s(1.4e8, "N"), "breaking_force": s(4.8e6, "N"), "carcass": "textile",
        },
        "idlers": {
            "carry": {"line_mass": s.maybe(25, "kg/m"), "pitch": s(1.2, "m")},
            "return": {"line_mass": s.maybe(18, "kg/m"), "pitch": s(3, "m")},
        },
        "load": {"mass": s(200, "kg/m")},
        "resistance": {"coefficient": s.number(0.02), "secondary": pick.one((1, 1.1, 3))},
        "speed": s(4, "m/s"),
        "drive": {
            "motor": {"count": pick.one((1, 3)), "inertia": s(6, "kg*m^2"), "mean_starting_torque": s(3150, "N*m")},
            "gear": {"ratio": s.number(20), "efficiency": s.share(0.3)},
            "drum": drum,
        },
        "brakes": {"disc": {"torque": s(1e4, "N*m"), "delay": s.maybe(0.5, "s"), "rise_time": s.maybe(1, "s")}},
        "backstop": {"torque": s(6e4, "N*m")},
        "takeup": takeup,
        "tail_drum": {"inertia": s.maybe(150, "kg*m^2"), "diameter": s(0.8, "m")},
        "scenes": [pick.one(scenes) | {"name": name} for name in ("one", "two")],
    }  # fmt: skip


KINDS: dict[str, Callable[..., Data]] = {
    "conveyor": conveyor,
    "hoist": hoist,
    "slewing": slewing,
    "travelling": travelling,
    "overhead_stacker": overhead_stacker,
    "rack_stacker": rack_stacker,
}
