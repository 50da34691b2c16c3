"""Values of a slewing crane's file that disagree with each other."""

import math
from collections.abc import Iterator

from ptmcalc.base import units
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.result import Finding
from ptmcalc.machines.crane.slewing.machine import model
from ptmcalc.machines.crane.slewing.machine.spec import SlewingCrane, SlewingScene
from ptmcalc.machines.crane.slewing.rotation import chain

_TIME_TOLERANCE = 0.02
"""Relative difference [1] of the stated start time and that of the stated torque, above which SPC201 is reported. An
engineering choice: a smaller value reports rounded inputs, a larger one accepts contradictions. No load depends on
it."""
_SPEED_TOLERANCE = 0.1
"""Relative difference [1] of the stated slewing speed and that of motor and gear, above which SPC201 is reported. An
engineering choice: a smaller value reports the slip of motors, a larger one accepts a wrong ratio. No load depends on
it."""


def inspect(spec: SlewingCrane) -> Iterator[Finding]:
    """Torque and time of a start that exclude each other; a motor whose speed is not that of the crane."""
    scene = spec.all_scenes[0]
    for block in ("cycle", "handbook"):
        given = getattr(spec, block)
        key = "start_time" if given.start_time is not None else "start_angle"
        time = model.start_time_of(given.start_time, given.start_angle, spec.speed)
        if time is not None:
            yield from _exclude(spec, scene, time, (block, key))
    if spec.motor.speed is not None:
        turns = spec.motor.speed / spec.gear.ratio
        if abs(turns / spec.speed - 1) > _SPEED_TOLERANCE:
            said = units.show(spec.speed, units.ANGULAR_SPEED)
            yield Finding(
                "SPC201",
                f"motor and gear result in a slewing speed of {units.show(turns, units.ANGULAR_SPEED)},"
                f" the file states {said}",
                ("speed",),
                "correct the speed, or the ratio from motor to crane with its open stage",
            )


def _exclude(spec: SlewingCrane, scene: SlewingScene, time: float, key: KeyPath) -> Iterator[Finding]:
    """What to say of a start whose torque takes another time than the one given."""
    torque = model.motor_torque(spec, scene)
    if torque is None:
        return
    own = model.start_time(spec, scene)
    if abs(own / time - 1) <= _TIME_TOLERANCE:
        return
    needed = model.start_torque(spec, scene, time) / (spec.gear.ratio * spec.gear.efficiency)
    given = spec.motor.count
    shown, wanted = (units.show(one / given, units.TORQUE) for one in (torque, needed))
    asked = units.show(time, units.TIME)
    takes = (
        f"{shown} result in a starting time of {units.show(own, units.TIME)}"
        if math.isfinite(own)
        else f"{shown} do not start the crane"
    )
    yield Finding(
        "SPC201",
        f"{shown} and {asked} contradict each other: {takes}, {asked} require {wanted}"
        + _worth(spec, scene, time, needed),
        ("motor", spec.motor.torque_key),
        "correct one of them; `handbook` takes both as they are, everything else the torque",
        key,
    )


def _worth(spec: SlewingCrane, scene: SlewingScene, time: float, needed: float) -> str:
    """The equivalent torques of both readings: of the torque, and of the handbook's chain with the torque it needs."""
    own, torque = model.start_time(spec, scene), model.motor_torque(spec, scene)
    if torque is None or not math.isfinite(own):
        return ""
    by_torque = _equivalent(spec, scene, own, torque, rounded=False)
    by_time = _equivalent(spec, scene, time, needed, rounded=spec.handbook.shares == "rounded")
    return f"; the equivalent torque about the slewing axis is {by_torque} with the torque, {by_time} with the time"


def _equivalent(spec: SlewingCrane, scene: SlewingScene, start: float, torque: float, *, rounded: bool) -> str:
    times = model.phases(spec, (start, spec.speed * start / 2), model.allowed_stop(spec))
    at = model.phase_torques(spec, scene, model.at_column(spec, torque), by_direction=False)
    found = chain.loads(spec, scene, times, at, rounded=rounded, even=True)["torque_equivalent"]
    return units.show(found, units.TORQUE)
