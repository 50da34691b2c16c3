"""Converters at their torque limit: the belt lags behind the profile, whose force that of the motors does not reach."""

import math
from typing import Any

import pytest
from support.belt_scenes import Brake, Drive, Rig
from support.machines import changed, check_of, load_of, report_of, scene_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.report import SceneReport

SYNCHRONOUS, RATED, POWER, LIMIT = 157.08, 155.0, 90e3, 1.5
UP = Rig(sections=((300.0, 18.0),), stiffness=15e6, speed=3.0, drives={"head": Drive(ratio=25.0, friction=None)},
         tension=60e3)  # fmt: skip
DOWN = Rig(
    sections=((400.0, -40.0),),
    stiffness=40e6,
    speed=3.0,
    drives={"head": Drive(ratio=25.0, friction=None)},
    brakes=(Brake(40e3),),
    tension=160e3,
)
START = {"type": "start", "profile": {"shape": "cosine", "time": "3 s"}}
STOP = {"type": "controlled_stop", "shape": "cosine", "time": "5 s"}


def ran(rig: Rig, scene: dict[str, Any], power: float = POWER, limit: float = LIMIT) -> SceneReport:
    resistance = {"coefficient": rig.friction, "secondary": rig.secondary, "start_factor": 1, "stop_factor": 1}
    checks = {"braking_power": "1 MW"} if scene is not START else {}
    data = rig.data(scene, resistance=resistance, checks=checks)
    del data["drive"]["motor"]["mean_starting_torque"]
    plate = {"power": f"{power} W", "speed": f"{RATED} rad/s", "no_load_speed": f"{SYNCHRONOUS} rad/s"}
    plate |= {"locked_rotor_ratio": 2, "breakdown_ratio": 2.5}
    data["drive"]["motor"] |= plate
    return scene_of(report_of(changed(data, drive__converter={"torque_limit": limit})))


def most(power: float = POWER, limit: float = LIMIT) -> float:
    """Torque limit at the pulley surface without losses [N]."""
    drive = UP.drives["head"]
    return limit * power / RATED * drive.ratio * 2 / drive.diameter


def test_a_start_at_the_torque_limit_fails_by_the_force_of_its_profile() -> None:
    """W + M pi V/(2 t): the force of the motors themselves never exceeds their limit."""
    one, drive = check_of(ran(UP, START), "CNV104"), UP.drives["head"]
    required = UP.resistance() + UP.mass() * math.pi * UP.speed / 2 / 3.0
    assert one.verdict is Verdict.FAIL
    assert "reach their torque limit" in one.reason
    assert one.value is not None
    assert one.value.value == pytest.approx(most() * drive.efficiency / required, rel=2e-3)
    assert one.value.value < 0.9


def test_a_start_below_the_limit_passes() -> None:
    one = check_of(ran(UP, START | {"profile": {"shape": "cosine", "time": "60 s"}}), "CNV104")
    assert one.verdict is Verdict.PASS
    assert not one.reason


def test_a_controlled_stop_at_the_torque_limit_fails_by_the_force_of_its_profile() -> None:
    """M pi V/(2 t) - W, with the gear on the side of the brake."""
    scene, drive = ran(DOWN, STOP), DOWN.drives["head"]
    rotor = drive.rotor * drive.ratio**2 * 4 / drive.diameter**2
    mass = DOWN.mass() + rotor * (1 / drive.efficiency - drive.efficiency)
    required = mass * math.pi * DOWN.speed / 2 / 5.0 - DOWN.resistance()
    one = check_of(scene, "CNV125")
    assert one.verdict is Verdict.FAIL
    assert "reach their torque limit" in one.reason
    assert load_of(scene, "braking_force_needed").estimate.value == pytest.approx(required, rel=2e-3)
    assert one.value is not None
    assert one.value.value == pytest.approx(most() / drive.efficiency / required, rel=2e-3)


def test_a_longer_controlled_stop_passes() -> None:
    assert check_of(ran(DOWN, STOP | {"time": "25 s"}, power=1.5 * POWER), "CNV125").verdict is Verdict.PASS
