"""Terms of the field for keys and choices of design files, for "did you mean": by meaning first, then by spelling."""

import re
from collections.abc import Iterable, Mapping
from types import MappingProxyType

_BY_KEY: Mapping[str, str] = {
    "backstop": "holdback, hold-back, anti-rollback, sprag clutch, one-way clutch",
    "cosine": "s-curve, s_curve, scurve",
    "ramp": "linear, soft start, soft_start",
    "step": "dol, direct-on-line, direct",
    "stroke": "travel, take-up travel, takeup_travel, take_up_travel",
    "profile": "start_profile, vfd, vsd, inverter, frequency converter, converter, acceleration_curve",
    "converter": "vfd, vsd, inverter, frequency converter",
    "curve": "torque_curve, torque-speed curve, motor_curve",
    "fluid_coupling": "fluid coupling, hydraulic coupling, turbo coupling",
    "starter": "soft starter, star-delta, wye-delta, star_delta_starter",
    "takeup.mass": "counterweight, counterweight_mass, gravity weight",
    "mass": "counterweight, weight, counterweight_mass",
    "takeup": "take-up, take_up, tensioner, gtu",
    "tension": "pretension, t2, initial_tension",
    "drum": "pulley, head_pulley, drive_pulley",
    "tail_drum": "tail_pulley, return_pulley",
    "wrap": "wrap_angle, arc_of_contact, contact_angle",
    "friction": "mu, lagging, traction",
    "lift": "height, rise, elevation",
    "length": "centres, center_distance, pulley_centres",
    "capacity": "mass_flow, tonnage, throughput, flow",
    "loading_points": "feeds, feeders, feed points, hoppers, loading_stations",
    "coefficient": "friction_factor, f, artificial_friction",
    "secondary": "length_factor, c_factor",
    "start_factor": "breakaway_factor, breakaway",
    "carry": "carrying, carrying_idlers, troughing",
    "pitch": "spacing, idler_spacing",
    "set_mass": "rotating_mass, roll_mass, idler_mass",
    "stiffness": "ea, tensile_stiffness",
    "strength": "rated_strength, belt_strength",
    "ratio": "gear_ratio, transmission_ratio",
    "efficiency": "eta",
    "inertia": "gd2, wk2, flywheel, moment_of_inertia",
    "delay": "dead_time, reaction_time",
    "rise_time": "build-up time, build_up_time, application_time",
    "mean_starting_torque": "starting_torque, locked_rotor_torque, breakaway_torque",
    "sprocket": "drive_sprocket, driver",
    "breaking_force": "mbf, minimum_breaking_force, breaking_strength",
    "diameter": "dia, wire_diameter",
    "falls": "parts_of_line, reeving_ratio",
    "hook_block": "bottom_block, block",
    "rope": "wire_rope, cable",
    "span": "bridge_span",
    "emergency_stop": "e-stop, estop, trip",
    "coast": "run-out, power_failure, power failure",
}
"""By the key or word of a design file, what others call it. A dot stands between a block and its key."""
_WORDS = frozenset({"converter", "cosine", "emergency_stop", "ramp", "step"})
"""Those that are written behind a key and are no keys: a key of that name elsewhere is another matter."""


def folded(word: str) -> str:
    """A word without regard to case, and to how its parts are joined."""
    return re.sub(r"[\s_-]+", " ", word.strip().lower())


def _called() -> Mapping[str, tuple[str, ...]]:
    found: dict[str, tuple[str, ...]] = {}
    for key, names in _BY_KEY.items():
        for name in dict.fromkeys(map(folded, names.split(", "))):
            found[name] = (*found.get(name, ()), key)
    return MappingProxyType(found)


_CALLED = _called()


def as_a_word(word: str) -> str:
    """How a word that is written behind a key is told from a key."""
    return f"{word}:" if word in _WORDS else word


def meanings(word: str) -> tuple[str, ...]:
    """The keys and words of design files that a word of the field stands for, the likeliest first."""
    return tuple(map(as_a_word, _CALLED.get(folded(word), ())))


def by_meaning(word: str, known: Iterable[str]) -> str:
    """The known word that another word of the field means, or an empty text."""
    names = tuple(known)
    return next((key for key in _CALLED.get(folded(word), ()) if key in names), "")
