"""Converters with droop and torque limit: load sharing by hand, a limited start and stop by finite elements."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq
from support.belt_fem import Motion, simulate
from support.belt_scenes import Drive, Rig
from support.machines import check_of, load_of, report_of, scene_of

from ptmcalc.base.diagnostic import Verdict

SYNCHRONOUS, RATED, POWER = 157.08, 152.0, 90e3
SLIP = 1 - RATED / SYNCHRONOUS
CURVE = {"type": "induction", "power": f"{POWER} W", "speed": f"{RATED} rad/s", "overload": 2.4}
CURVE |= {"synchronous_speed": f"{SYNCHRONOUS} rad/s"}


def torque(part: float, speed: float, droop: float, limit: float) -> float:
    """On the straight slip line at a part of the rated frequency, within the limit [N*m]."""
    rated = POWER / RATED
    return float(np.clip((part - speed / SYNCHRONOUS) / (SLIP + droop), -limit, limit)) * rated


def on_converters(data: dict[str, Any], **converter: float) -> dict[str, Any]:
    for drive in data["drives"].values() if "drives" in data else [data["drive"]]:
        drive["motor"] |= {"curve": CURVE}
        drive["converter"] = converter
    return data


@pytest.mark.parametrize("droop", [0.0, 0.03])
def test_droop_shares_the_load_of_unequal_pulleys(droop: float) -> None:
    """Belt speed from the balance of both forces; the second pulley turns slower by the creep F_1/EA."""
    drives = {"first": Drive(friction=None, diameter=1.0), "second": Drive(friction=None, diameter=0.99)}
    rig = Rig(sections=((900.0, 6.0),), drives=drives, stiffness=60e6)
    scene = scene_of(report_of(on_converters(rig.data({"type": "run"}), droop=droop, torque_limit=1.5)))
    on = rig.tension + rig.resistance()

    def pulls(still: float) -> dict[str, float]:
        found, tension = {}, on
        for name, drive in drives.items():
            turns = drive.ratio * 2 / drive.diameter
            one = torque(1.0, still * (1 + tension / rig.stiffness) * turns, droop, 1.5)
            found[name] = turns * one * (drive.efficiency if one > 0 else 1 / drive.efficiency)
            tension -= found[name]
        return found

    still = brentq(lambda speed: sum(pulls(speed).values()) - rig.resistance(), 3.0, 4.2, xtol=1e-13)
    shares = pulls(still)
    for name, drive in drives.items():
        turns = drive.ratio * 2 / drive.diameter
        right = shares[name] / turns / drive.efficiency / (POWER / RATED)
        found = load_of(scene, f"motor_utilisation[{name}]").estimate.value
        assert found == pytest.approx(right, rel=1e-6), name
    apart = abs(shares["first"] - shares["second"]) / rig.resistance()
    assert (apart < 0.08) if droop else (apart > 0.12)


LIMIT, RISE = 1.3, 4.0
LEVEL = Rig(sections=((400.0, 2.0),), speed=3.7, drives={"head": Drive(friction=None)}, tension=90e3, stiffness=30e6)


def limited(scene: dict[str, Any]) -> Any:
    data = on_converters(LEVEL.data(scene, accuracy="1 %"), droop=0.01, torque_limit=LIMIT)
    data["resistance"]["stop_factor"] = 1
    return scene_of(report_of(data))


def elements(window: float, *, stops: bool) -> Motion:
    """The belt with a motor whose frequency rises or falls in a straight line, and whose torque is limited."""
    drive = LEVEL.drives["head"]
    turns = drive.ratio * 2 / drive.diameter
    whole = LEVEL.resistance()
    steady = whole / turns / drive.efficiency / (POWER / RATED) * (SLIP + 0.01)
    top = LEVEL.speed * turns / SYNCHRONOUS + steady  # the frequency at which the belt runs at its rated speed

    def pull(time: float, speed: float) -> float:
        share = min(time / RISE, 1.0)
        part = top * (1 - share) if stops else share
        one = torque(part, speed * turns, 0.01, LIMIT)
        return turns * one * (drive.efficiency if one > 0 else 1 / drive.efficiency)

    one = replace(drive, torque=whole / (drive.force / drive.torque))
    one = replace(one, rotor=one.rotor / drive.efficiency**2) if stops else one
    rig = replace(LEVEL, drives={"head": one})
    lengths = rig.lengths()
    holds = None if stops else {"head": rig._held({"head": pull}, "head", whole)}
    plan = rig.plan(lengths, {"head": pull}, holds=holds)
    return simulate(plan, 300, window, rig.running(lengths, 300), LEVEL.speed if stops else 0.0)


@pytest.mark.parametrize("stops", [False, True], ids=["start", "stop"])
def test_a_converter_at_its_torque_limit_does_not_hold_the_speed(stops: bool) -> None:
    profile = {"type": "start", "profile": {"shape": "ramp", "time": f"{RISE} s"}}
    scene = limited({"type": "controlled_stop", "time": f"{RISE} s"} if stops else profile)
    window = load_of(scene, "tension_max").window
    assert window is not None
    motion = elements(window[1], stops=stops)
    right = {
        "tension_run_on_max": max(motion.head.on),
        "tension_run_off_min": min(motion.head.off),
        "tension_max": float(motion.highest.max()),
        "tension_min": float(motion.lowest.min()),
    }
    if stops:
        first = int(np.flatnonzero(np.array(motion.head.belt) <= 0)[0])
        right["stop_time"] = float(motion.times[first])
        assert right["stop_time"] > 1.05 * RISE
    else:
        early = np.array(motion.head.belt)[np.searchsorted(motion.times, RISE)]
        assert early < 0.9 * LEVEL.speed
    for name, value in right.items():
        one = load_of(scene, name).estimate
        assert one.low - 0.006 * abs(value) <= value <= one.high + 0.006 * abs(value), (name, one, value)


def test_one_gear_between_mains_and_motor() -> None:
    data = on_converters(LEVEL.data({"type": "run"}), droop=0.01)
    data["drive"]["starter"] = {"type": "soft", "time": "8 s"}
    with pytest.raises(AssertionError, match="has a `starter` already"):
        report_of(data)


def test_a_tolerance_of_the_diameter_is_tried_at_both_ends() -> None:
    """Equal pulleys share nearly equally; 8 mm more or less on one of them overload a motor."""
    drives = {"first": Drive(friction=None), "second": Drive(friction=None)}
    rig = Rig(sections=((900.0, 1.0),), drives=drives, stiffness=60e6)

    def judged(**drum: str) -> Verdict:
        data = on_converters(rig.data({"type": "run"}), droop=0.0, torque_limit=1.5)
        data["drives"]["second"]["drum"] |= drum
        return check_of(scene_of(report_of(data)), "CNV122").verdict

    assert judged() is Verdict.PASS
    assert judged(tolerance="0.2 mm") is Verdict.PASS
    assert judged(tolerance="8 mm") is Verdict.UNDECIDED
    assert Verdict.FAIL in {judged(deviation="8 mm"), judged(deviation="-8 mm")}
    with pytest.raises(AssertionError, match="more than a tenth"):
        judged(tolerance="200 mm")
