"""Starts on converters of drives at both ends, by finite elements whose motors follow Kloss at the frequency of the
profile."""

import math
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq
from support.belt_fem import Motion, simulate
from support.belt_scenes import Drive, Rig
from support.machines import check_of, load_of, report_of, scene_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.report import SceneReport

SYNCHRONOUS, RATED, OVERLOAD = 157.08, 150.0, 2.4
POWERS = {"head": 90e3, "booster": 60e3}
RISE, CONTOURS = 20.0, 4.0
RIG = Rig(
    sections=((300.0, 18.0),),
    stiffness=15e6,
    speed=3.0,
    drives={"head": Drive(ratio=20.0, friction=None), "booster": Drive(ratio=20.0, at="tail", friction=None)},
    tension=60e3,
)
ELEMENTS = 150
SHAPES: dict[str, Callable[[float], float]] = {
    "ramp": lambda u: u,
    "cosine": lambda u: (1 - math.cos(math.pi * u)) / 2,
    "parabolic": lambda u: 2 * u * u if u < 0.5 else 1 - 2 * (1 - u) ** 2,
    "table": lambda u: float(np.interp(u, [0, 0.2, 0.8, 1], [0, 0.1, 0.9, 1])),
}


def pull(name: str, speed: float, part: float = 1.0) -> float:
    """Force of a drive at a part of the rated frequency, at the rated ratio of voltage and frequency."""
    drive = RIG.drives[name]
    turns = drive.ratio / (drive.diameter / 2)
    slip = part - speed * turns / SYNCHRONOUS
    rated = 1 - RATED / SYNCHRONOUS
    most = rated * (OVERLOAD + math.sqrt(OVERLOAD**2 - 1))
    torque = OVERLOAD * POWERS[name] / RATED * 2 * slip * most / (slip**2 + most**2)
    return turns * torque * (drive.efficiency if torque > 0 else 1 / drive.efficiency)


@cache
def steady() -> dict[str, float]:
    """Forces in steady running, with the stretch of the belt that enters each pulley."""
    whole, rises = RIG.resistance(), [part.length * (part.friction + part.climb) for part in RIG.lengths()]
    before = {"booster": RIG.tension + rises[0]}

    def forces(still: float) -> dict[str, float]:
        booster = pull("booster", still * (1 + before["booster"] / RIG.stiffness))
        return {"booster": booster, "head": pull("head", still * (1 + (RIG.tension + whole - booster) / RIG.stiffness))}

    top = SYNCHRONOUS / 20.0 * RIG.drives["head"].diameter / 2
    return forces(brentq(lambda speed: sum(forces(speed).values()) - whole, 0.9 * top, top, xtol=1e-14))


@cache
def elements(shape: str, window: float, count: int = ELEMENTS) -> Motion:
    """The belt begins with the tensions of steady running, and each end is held until its drive pulls as much."""
    force = {name: drive.force / drive.torque for name, drive in RIG.drives.items()}
    drives = {name: replace(one, torque=steady()[name] / force[name]) for name, one in RIG.drives.items()}
    rig, rise = replace(RIG, drives=drives), SHAPES[shape]

    def pulls(name: str) -> Callable[[float, float], float]:
        return lambda time, speed: pull(name, speed, rise(min(time / RISE, 1.0)))

    moved = {name: pulls(name) for name in drives}
    places = {"head": "head", "tail": "booster"}
    holds = {at: rig._held(moved, at, steady()[name]) for at, name in places.items()}
    lengths = rig.lengths()
    return simulate(rig.plan(lengths, moved, holds=holds), count, window, rig.running(lengths, count), 0.0)


@cache
def scene(shape: str, accuracy: str = "1 %") -> SceneReport:
    profile: dict[str, Any] = {"shape": shape, "time": f"{RISE} s"}
    if shape == "table":
        points = ((0, 0), (0.2, 0.1), (0.8, 0.9), (1, 1))
        profile = {"shape": shape, "control": "speed"}
        profile["points"] = [{"time": f"{at * RISE} s", "share": share} for at, share in points]
    data = RIG.data({"type": "start", "profile": profile}, accuracy=accuracy)
    for name, drive in data["drives"].items():
        curve = {"type": "induction", "power": f"{POWERS[name]} W", "speed": f"{RATED} rad/s", "overload": OVERLOAD}
        drive["motor"] |= {"curve": curve | {"synchronous_speed": f"{SYNCHRONOUS} rad/s"}}
    return scene_of(report_of(data))


def right(shape: str) -> dict[str, float]:
    window = load_of(scene(shape), "tension_max").window
    assert window is not None
    motion = elements(shape, window[1])
    return {
        "tension_run_on_max[head]": max(motion.head.on),
        "tension_run_off_min[head]": min(motion.head.off),
        "tension_run_on_max[booster]": max(motion.tail.on),
        "tension_run_off_min[booster]": min(motion.tail.off),
        "tension_max": float(motion.highest.max()),
    }


@pytest.mark.parametrize("shape", SHAPES)
def test_motors_follow_their_slip_lines_at_the_frequency_of_the_profile(shape: str) -> None:
    for name, value in right(shape).items():
        one = load_of(scene(shape), name).estimate
        assert one.bounded, name
        assert one.bar < 0.03 * value, "nothing is left to come after the window"
        assert one.low - 0.004 * value <= value <= one.high + 0.004 * value, (name, one)


def test_the_belt_ends_in_the_load_sharing_of_steady_running() -> None:
    """At rated frequency each motor pulls by its slip: the booster does not take ever more, nor ever less."""
    motion = elements("cosine", 60.0)
    booster = np.array(motion.tail.on) - np.array(motion.tail.off)
    assert float(booster[-400:].mean()) == pytest.approx(steady()["booster"], rel=0.06)
    assert check_of(scene("cosine"), "CNV104").verdict is Verdict.PASS


ABORTED, PAUSE = 3.0, 8.0
LEVEL = replace(RIG, sections=((500.0, 0.0),), stiffness=6e6, drives={"head": RIG.drives["head"]}, tension=45e3)


@cache
def level(count: int = ELEMENTS) -> Motion:
    """A level belt whose only drive is switched off early in its start."""
    whole = LEVEL.resistance()
    drive = LEVEL.drives["head"]
    rig = replace(LEVEL, drives={"head": replace(drive, torque=whole / (drive.force / drive.torque))})

    def moved(time: float, speed: float) -> float:
        return pull("head", speed, SHAPES["cosine"](time / RISE)) if time < ABORTED else 0.0

    holds = {"head": rig._held({"head": moved}, "head", whole)}
    lengths = rig.lengths()
    return simulate(
        rig.plan(lengths, {"head": moved}, holds=holds), count, ABORTED + PAUSE, rig.running(lengths, count), 0.0
    )


def aborted(**more: Any) -> SceneReport:
    profile = {"shape": "cosine", "time": f"{RISE} s"}
    again = {"run": f"{ABORTED} s", "pause": f"{PAUSE} s"}
    data = LEVEL.data({"type": "start", "profile": profile, "aborted": again}, accuracy="1 %") | more
    curve = {"type": "induction", "power": f"{POWERS['head']} W", "speed": f"{RATED} rad/s", "overload": OVERLOAD}
    data["drive"]["motor"] |= {"curve": curve | {"synchronous_speed": f"{SYNCHRONOUS} rad/s"}}
    return scene_of(report_of(data))


def test_a_level_belt_runs_back_by_its_stretch_after_an_aborted_start() -> None:
    motion = level()
    belt = np.array(motion.head.belt)
    way = np.concatenate([[0.0], np.cumsum((belt[1:] + belt[:-1]) / 2)]) * float(motion.times[1])
    scene, back = aborted(), float((np.maximum.accumulate(way) - way).max())
    for name, value in (("run_back_distance", back), ("run_back_speed", float(-belt.min()))):
        one = load_of(scene, name).estimate
        assert one.low <= value <= one.high
        assert one.bar < 0.3 * value
    judged = check_of(scene, "CNV124")
    assert judged.verdict is Verdict.FAIL
    assert judged.blame.path == ("scenes", 0, "aborted")


def test_a_backstop_keeps_the_belt_where_it_is() -> None:
    """Nothing is left to check."""
    scene = aborted(backstop={"torque": "20 kN*m"})
    assert "CNV124" not in {one.code for one in scene.checks}
