"""Main shafts, drive trains and chain drives over ten decades in every size, for Hypothesis.

They need not be sound, nor even such as anybody could build; the files are valid.
"""

from itertools import pairwise
from typing import Any

from hypothesis import strategies as st
from hypothesis.strategies import DrawFn, SearchStrategy

DECADES = 10


def size(middle: float, decades: float = DECADES) -> SearchStrategy[float]:
    """Numbers over so many decades about one."""
    half = decades / 2
    return st.floats(-half, half).map(lambda exponent: round(exponent, 3)).map(lambda e: middle * 10.0**e)


@st.composite
def of(draw: DrawFn, middle: float, unit: str, decades: float = DECADES) -> str:
    """A quantity over so many decades."""
    return f"{draw(size(middle, decades))!r} {unit}"


def or_none(one: SearchStrategy[str], unit: str) -> SearchStrategy[str]:
    """The same, and sometimes nothing."""
    return st.one_of(one, st.just(f"0 {unit}"))


# -- drive trains -----------------------------------------------------------------------------------------------------


@st.composite
def _torque(draw: DrawFn, at: str) -> dict[str, Any]:
    kind = draw(st.sampled_from(["constant", "ramp", "sine"]))
    torque = draw(of(10.0, "N*m"))
    if kind == "sine":
        frequency = draw(of(10.0, "rad/s", 4))
        return {"at": at, "type": kind, "amplitude": torque, "angular_frequency": frequency}
    return {"at": at, "type": kind, "torque": torque, **({"time": draw(of(1.0, "s"))} if kind == "ramp" else {})}


@st.composite
def _motor(draw: DrawFn, at: str) -> dict[str, Any]:
    motor = {"type": "induction", "power": draw(of(1e3, "W")), "speed": "965 rpm", "synchronous_speed": "1000 rpm"}
    return {"at": at, "motor": {**motor, "overload": draw(st.floats(1.5, 3.5))}}


@st.composite
def any_train(draw: DrawFn) -> dict[str, Any]:
    """Two to four inertias in a row, with a gear, play, a brake or friction, and one scene."""
    names = [f"j{number}" for number in range(draw(st.integers(2, 4)))]
    data: dict[str, Any] = {
        "kind": "drivetrain",
        "inertias": {name: {"inertia": draw(of(1.0, "kg*m^2"))} for name in names},
        "links": {},
        "checks": {"start_time": "10 s", "stop_time": "10 s", "stop_angle": "10 rad"},
    }
    for one, other in pairwise(names):
        if draw(st.integers(0, 4)) == 0:
            ratio = draw(size(1.0)) * draw(st.sampled_from([1, 1, -1]))
            data.setdefault("gears", {})[f"{one}{other}"] = {
                "from": one, "to": other, "ratio": ratio, "efficiency": draw(st.sampled_from([1.0, 0.9, 0.5]))
            }  # fmt: skip
            continue
        link = {"between": [one, other], "stiffness": draw(of(1e3, "N*m/rad")), "limit": draw(of(1e2, "N*m"))}
        if draw(st.booleans()):
            link["damping"] = draw(of(1.0, "N*m*s/rad"))
        if draw(st.integers(0, 2)) == 0:
            link["gap"] = draw(or_none(of(1e-3, "rad"), "rad"))
            link["start"] = draw(st.sampled_from(["centred", "driving", "braking"]))
        data["links"][f"{one}{other}"] = link
    ends = st.sampled_from(names)
    data["torques"] = {f"t{k}": draw(_torque(draw(ends))) for k in range(draw(st.integers(0, 2)))}
    if draw(st.integers(0, 3)) == 0:
        data["motors"] = {"motor": draw(_motor(names[0]))}
    if draw(st.booleans()):
        data["brakes"] = {"brake": {"at": draw(ends), "torque": draw(of(10.0, "N*m")), "applied": "always"}}
    if draw(st.booleans()):
        friction = {"coulomb": draw(or_none(of(1.0, "N*m"), "N*m")), "viscous": draw(of(0.1, "N*m*s/rad"))}
        data["resistances"] = {"oil": {"at": draw(ends), **friction}}
    scene: dict[str, Any] = {"type": draw(st.sampled_from(["run", "run", "stop"])), "of": names[0]}
    scene["duration"] = draw(of(1.0, "s", 6))
    if scene["type"] == "stop" or draw(st.booleans()):
        scene["speed"] = draw(or_none(of(10.0, "rad/s"), "rad/s"))
    if scene["type"] == "stop":
        scene["links"] = "relaxed"
    data["scenes"] = [scene]
    return data


# -- main shafts ------------------------------------------------------------------------------------------------------


@st.composite
def any_shaft(draw: DrawFn) -> dict[str, Any]:
    """A shaft with an inertia that swings or not, any motor, any load."""
    mean = draw(size(10.0))
    inertia: dict[str, Any] = {"type": "constant", "value": f"{mean!r} kg*m^2"}
    if draw(st.booleans()):
        swing = max(mean * draw(st.one_of(size(1e-5, 9), st.floats(0.0, 0.95))), 1e-12)
        term = {"order": draw(st.integers(1, 6)), "cosine": f"{swing!r} kg*m^2"}
        inertia = {"type": "harmonics", "mean": f"{mean!r} kg*m^2", "terms": [term]}
    torque, speed = draw(size(100.0)), draw(size(10.0, 6))
    motor: dict[str, Any] = {
        "type": "linear",
        "starting_torque": f"{torque!r} N*m",
        "no_load_speed": f"{speed!r} rad/s",
        "rated_torque": f"{torque / 2!r} N*m",
        "largest_torque": f"{0.9 * torque!r} N*m",
    }
    if draw(st.booleans()):
        motor = {"type": "induction", "power": f"{torque * speed / 2!r} W", "speed": f"{0.96 * speed!r} rad/s",
                 "synchronous_speed": f"{speed!r} rad/s", "overload": draw(st.floats(1.6, 3.0))}  # fmt: skip
    gear = {"ratio": draw(size(1.0, 6)), "efficiency": draw(st.sampled_from([1.0, 0.94, 0.5]))}
    data: dict[str, Any] = {
        "kind": "shaft",
        "inertia": inertia,
        "drive": {"motor": motor, "motor_inertia": draw(or_none(of(0.1, "kg*m^2"), "kg*m^2")), "gear": gear},
        "losses": {
            "torque": draw(or_none(of(1.0, "N*m"), "N*m")),
            "viscous": draw(or_none(of(0.1, "N*m*s/rad"), "N*m*s/rad")),
        },
        "checks": {
            "irregularity": draw(size(0.05, 4)),
            "run_up_time": "10 s",
            "stop_time": "10 s",
            "stop_angle": "10 rad",
        },
    }
    if draw(st.booleans()):
        start, wide = round(draw(st.floats(0, 6)), 3), draw(size(0.1, 2))
        useful = draw(size(torque * gear["ratio"] / wide, 4)) * draw(st.sampled_from([1, 1, -1]))
        sector = {"from": f"{start!r} rad", "to": f"{start + wide!r} rad", "torque": f"{useful!r} N*m"}
        data["load"] = {"type": "sectors", "sectors": [sector]}
    if draw(st.booleans()):
        data["brake"] = {"torque": draw(of(100.0, "N*m")), "delay": draw(or_none(of(0.1, "s"), "s"))}
    data["scenes"] = [{"type": draw(st.sampled_from(["run_up", "steady", "run_out"]))}]
    if data["scenes"][0]["type"] == "run_out":
        data["scenes"][0]["from"] = "0 rad"
    return data


# -- chain drives -----------------------------------------------------------------------------------------------------


@st.composite
def any_chain(draw: DrawFn) -> dict[str, Any]:
    """A chain conveyor with a drive, in one scene."""
    pitch, teeth, tail = draw(size(0.1, 4)), draw(st.integers(6, 40)), draw(st.integers(6, 40))
    least = pitch * (teeth + tail) / 4
    length = least * 10 ** draw(st.floats(0.0, 5.0))
    damping: dict[str, Any] = {"law": draw(st.sampled_from(["kelvin_voigt", "hysteretic"]))}
    damping["ratio"] = draw(st.one_of(st.just(0.0), size(1e-4, 6)))
    data: dict[str, Any] = {
        "kind": "chain_drive",
        "layout": {
            "type": "conveyor",
            "length": f"{length!r} m",
            "lift": f"{length * round(draw(st.floats(-0.9, 0.9)), 3)!r} m",
            "load": draw(or_none(of(10.0, "kg/m"), "kg/m")),
            "resistance": {"coefficient": draw(size(1e-2, 4)), "turn_factor": 1.1},
            "takeup": {"type": draw(st.sampled_from(["gravity", "screw"])), "tension": draw(of(1e4, "N"))},
            "tail": {"teeth": tail, "inertia": draw(or_none(of(1.0, "kg*m^2"), "kg*m^2"))},
        },
        "chain": {
            "pitch": f"{pitch!r} m",
            "mass": draw(of(10.0, "kg/m")),
            "stiffness": draw(of(1e7, "N")),
            "breaking_load": draw(of(1e5, "N")),
            "damping": damping,
        },
        "sprocket": {"teeth": teeth, "inertia": draw(or_none(of(1.0, "kg*m^2"), "kg*m^2"))},
        "speed": draw(of(0.3, "m/s")),
        "drive": {
            "motor": {"inertia": draw(of(0.1, "kg*m^2")), "mean_starting_torque": draw(of(100.0, "N*m"))},
            "gear": {"ratio": draw(size(10.0, 6)), "efficiency": 0.93},
        },
        "brake": {"torque": draw(of(100.0, "N*m")), "delay": draw(or_none(of(0.1, "s"), "s"))},
        "checks": {"stop_distance": "1 m", "stop_time": "5 s", "start_time": "10 s"},
    }
    kind = draw(st.sampled_from(["run", "start", "stop", "coast", "speed_range"]))
    scene: dict[str, Any] = {"type": kind, "load": draw(st.sampled_from(["full", "empty"]))}
    if kind == "start" and draw(st.booleans()):
        scene["profile"] = {
            "shape": draw(st.sampled_from(["ramp", "cosine", "parabolic"])),
            "time": draw(of(1.0, "s", 7)),
        }
    if kind == "speed_range":
        first = draw(size(0.3, 4))
        scene |= {
            "from": f"{first!r} m/s",
            "to": f"{first * draw(st.floats(1.01, 10))!r} m/s",
            "time": draw(of(1.0, "s", 5)),
        }
    data["scenes"] = [scene]
    return data
