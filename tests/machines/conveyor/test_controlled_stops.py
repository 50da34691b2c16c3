"""Controlled stops against finite elements of our own, and the rigid conveyor by hand."""

import math
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq
from support.belt_fem import Motion, simulate
from support.belt_scenes import Brake, Drive, Rig, loads_of
from support.machines import changed, check_of, load_of, report_of, scene_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.report import SceneReport

SHAPES: dict[str, Callable[[float], float]] = {
    "ramp": lambda u: u,
    "cosine": lambda u: (1 - math.cos(math.pi * u)) / 2,
    "parabolic": lambda u: 2 * u * u if u < 0.5 else 1 - 2 * (1 - u) ** 2,
}
STEEPEST = {"ramp": 1.0, "cosine": math.pi / 2, "parabolic": 2.0}
TIME, ELEMENTS = 6.0, 300
HEAD = Rig(
    sections=((200.0, -6.0), (300.0, 24.0)),
    drives={"head": Drive(friction=None, efficiency=0.9)},
    tension=150e3,
    brakes=(Brake(20e3, 0.3, 0.5),),
)


def stopped(rig: Rig, shape: str, time: float = TIME, **more: Any) -> SceneReport:
    data = rig.data({"type": "controlled_stop", "time": f"{time} s", "shape": shape}, **({"accuracy": "1 %"} | more))
    return scene_of(report_of(changed(data, resistance__stop_factor=1)))


def driven(drive: Drive) -> float:
    """Mass of a drive at the rim with the losses of the gear on the motor's side [kg]."""
    return (drive.rotor * drive.count * drive.ratio**2 / drive.efficiency + drive.drum) * 4 / drive.diameter**2


@cache
def elements(shape: str, window: float) -> Motion:
    lengths, fall = HEAD.lengths(), SHAPES[shape]
    plan = replace(HEAD.plan(lengths), head_speed=lambda now: HEAD.speed * (1 - fall(min(now / TIME, 1.0))))
    return simulate(plan, ELEMENTS, window, HEAD.running(lengths, ELEMENTS), HEAD.speed)


@pytest.mark.parametrize("shape", SHAPES)
def test_the_belt_follows_the_speed_of_its_pulley(shape: str) -> None:
    scene = stopped(HEAD, shape)
    window = load_of(scene, "tension_max").window
    assert window is not None
    motion = elements(shape, window[1])
    found = loads_of(HEAD, motion).loads
    drive = HEAD.drives["head"]
    times, belt = motion.times, np.array(motion.head.belt)
    inertia = driven(drive) * np.gradient(belt, times)
    force = -(np.array(motion.head.on) - np.array(motion.head.off) + inertia)
    during = times < TIME - 0.05  # the elements leave a needle where the acceleration ends
    right = {name: found[name] for name in ("tension_run_on_max", "tension_max", "tension_min")} | {
        "stop_distance": HEAD.speed * TIME / 2,
        "stop_distance_max": float(motion.farthest.max()),
        "braking_force_needed": float(force[during].max()),
        "braking_power_max": float((force * belt)[during].max()) * drive.efficiency,
    }
    for name, value in right.items():
        one = load_of(scene, name).estimate
        assert one.bounded, name
        assert one.low - 0.006 * abs(value) <= value <= one.high + 0.006 * abs(value), (name, one, value)
        assert one.bar <= 0.05 * abs(value), (name, one)
    time = load_of(scene, "stop_time").estimate
    assert time.low <= TIME <= time.high
    assert time.bar < 0.02


@pytest.mark.parametrize("shape", SHAPES)
def test_the_textbook_values_are_those_of_the_rigid_conveyor(shape: str) -> None:
    """F = M a - W, and the power by the profile itself."""
    drive, scene = HEAD.drives["head"], stopped(HEAD, shape)
    mass = HEAD.mass() - drive.mass + driven(drive)
    needed = mass * HEAD.speed * STEEPEST[shape] / TIME - HEAD.resistance()
    parts = np.linspace(0, 1, 200_001)
    speeds = HEAD.speed * (1 - np.array([SHAPES[shape](part) for part in parts.tolist()]))
    power = (-mass * np.gradient(speeds, parts[1]) / TIME - HEAD.resistance()) * speeds
    available = drive.force / drive.efficiency**2
    right = {
        "braking_force_needed": needed,
        "braking_force_reserve": available / needed,
        "braking_power_max": float(power.max()) * drive.efficiency,
        "stop_time": TIME,
        "stop_distance": HEAD.speed * TIME / 2,
    }
    for name, value in right.items():
        formula = load_of(scene, name).formula
        assert formula is not None
        assert formula.value == pytest.approx(value, rel=1e-4), name
    left_out = load_of(stopped(HEAD, shape, effects={"belt_wave": "off"}), "braking_force_needed")
    assert left_out.solver == "stiff_stop"
    assert left_out.estimate.value == pytest.approx(needed, rel=1e-9)


SYNCHRONOUS, RATED, OVERLOAD = 157.08, 150.0, 2.4
POWERS = {"head": 90e3, "booster": 60e3}
BOTH = Rig(
    sections=((300.0, 18.0),),
    stiffness=15e6,
    speed=3.7,
    drives={"head": Drive(ratio=20.0, friction=None), "booster": Drive(ratio=20.0, at="tail", friction=None)},
    tension=60e3,
    brakes=(Brake(30e3, 0.5),),
)
SLOW = 12.0


def pull(name: str, speed: float, part: float) -> float:
    """Force of a drive at a part of the rated frequency, by Kloss."""
    drive = BOTH.drives[name]
    turns = drive.ratio / (drive.diameter / 2)
    slip = part - speed * turns / SYNCHRONOUS
    rated = 1 - RATED / SYNCHRONOUS
    most = rated * (OVERLOAD + math.sqrt(OVERLOAD**2 - 1))
    torque = OVERLOAD * POWERS[name] / RATED * 2 * slip * most / (slip**2 + most**2)
    return turns * torque * (drive.efficiency if torque > 0 else 1 / drive.efficiency)


@cache
def steady() -> tuple[float, dict[str, float]]:
    """Part of the rated frequency at which the belt runs at its rated speed, and the forces of the drives there."""
    whole = BOTH.resistance()

    def forces(part: float) -> dict[str, float]:
        booster = pull("booster", BOTH.speed, part)
        return {"booster": booster, "head": pull("head", BOTH.speed, part)}

    part = brentq(lambda part: sum(forces(part).values()) - whole, 0.5, 1.1, xtol=1e-14)
    return part, forces(part)


def test_motors_at_both_ends_follow_their_slip_lines_down() -> None:
    curves = {
        name: {"type": "induction", "power": f"{power} W", "speed": f"{RATED} rad/s", "overload": OVERLOAD}
        for name, power in POWERS.items()
    }
    data = BOTH.data({"type": "controlled_stop", "time": f"{SLOW} s", "shape": "cosine"}, accuracy="1 %")
    data["resistance"]["stop_factor"] = 1
    for name, drive in data["drives"].items():
        drive["motor"] |= {"curve": curves[name] | {"synchronous_speed": f"{SYNCHRONOUS} rad/s"}}
    scene = scene_of(report_of(data))
    part, share = steady()
    force = {name: drive.force / drive.torque for name, drive in BOTH.drives.items()}
    drives = {
        name: replace(one, torque=share[name] / force[name], rotor=one.rotor / one.efficiency**2)
        for name, one in BOTH.drives.items()
    }
    rig = replace(BOTH, drives=drives)

    def pulls(name: str) -> Callable[[float, float], float]:
        return lambda time, speed: pull(name, speed, part * (1 - SHAPES["cosine"](min(time / SLOW, 1.0))))

    lengths, window = rig.lengths(), load_of(scene, "tension_max").window
    assert window is not None
    closes = (replace(BOTH.brakes[0], delay=SLOW + 0.5),)
    plan = rig.plan(lengths, {name: pulls(name) for name in drives}, brakes=closes)
    motion = simulate(plan, 200, window[1], rig.running(lengths, 200), rig.speed)
    right = {
        "tension_run_on_max[head]": max(motion.head.on),
        "tension_run_off_min[booster]": min(motion.tail.off),
        "tension_run_on_max[booster]": max(motion.tail.on),
        "tension_max": float(motion.highest.max()),
        "stop_distance": loads_of(rig, motion)["stop_distance"],
    }
    for name, value in right.items():
        one = load_of(scene, name).estimate
        assert one.bounded, name
        assert one.low - 0.006 * abs(value) <= value <= one.high + 0.006 * abs(value), (name, one, value)
        assert one.bar < 0.05 * abs(value), (name, one)


def test_a_short_ramp_fails_and_a_longer_one_passes() -> None:
    """The repair is the time of the stop; converters that take nothing back leave the power undecided."""
    checks = {"stop_distance": "20 m", "braking_power": "150 kW"}
    short = stopped(HEAD, "ramp", 2.5, checks=checks)
    for code in ("CNV125", "CNV126"):
        judged = check_of(short, code)
        assert judged.verdict is Verdict.FAIL, code
        assert judged.blame.path == ("scenes", 0, "time")
    longer = stopped(HEAD, "ramp", 9.5, checks=checks)
    for code in ("CNV106", "CNV107", "CNV125", "CNV126"):
        assert check_of(longer, code).verdict is Verdict.PASS, code
    assert check_of(stopped(HEAD, "ramp", 12.0, checks=checks), "CNV106").verdict is Verdict.FAIL
    assert check_of(stopped(HEAD, "ramp", 4.0), "CNV126").verdict is Verdict.UNDECIDED
