"""Heat of the brakes by the balance of energy of the rigid conveyor, and by finite elements of the belt."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from support.belt_scenes import Brake, Drive, Rig, loads_of
from support.machines import changed, check_of, load_of, report_of, scene_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.report import SceneReport

ONE = Rig(
    sections=((200.0, -6.0), (300.0, 24.0)),
    drives={"head": Drive(friction=None, efficiency=0.9)},
    brakes=(Brake(14e3, 0.5, 1.5),),
)
TWO = replace(ONE, brakes=(Brake(10e3, 0.3, 0.5), Brake(4e3, 0.6, 0.0, "tail")))


def stopped(rig: Rig, **brake: Any) -> SceneReport:
    data = changed(rig.data({"type": "stop"}, accuracy="1 %"), resistance__stop_factor=1)
    data["brakes"]["b0"] |= brake
    return scene_of(report_of(data))


@pytest.mark.parametrize("shaft", ["drum", "motor"])
def test_the_textbook_heat_is_the_energy_that_resistance_leaves(shaft: str) -> None:
    """Q = m v^2/2 - W s; a gear between brake and pulley takes its part, and its losses count on the other side."""
    drive = ONE.drives["head"]
    part = drive.efficiency if shaft == "motor" else 1.0
    rotor = drive.count * drive.rotor * drive.ratio**2 * 4 / drive.diameter**2
    mass = ONE.mass() + rotor * (1 / part - drive.efficiency if shaft == "motor" else 0.0)
    torque = 14e3 / drive.ratio if shaft == "motor" else 14e3
    scene = stopped(ONE, shaft=shaft, torque=f"{torque} N*m")
    way = load_of(scene, "stop_distance").formula
    heat = load_of(scene, "brake_heat[b0]").formula
    assert way is not None
    assert heat is not None
    right = part * (mass * ONE.speed**2 / 2 - ONE.resistance() * way.value)
    assert heat.value == pytest.approx(right, rel=1e-6)


@pytest.mark.parametrize("rig", [ONE, TWO], ids=["one brake", "head and tail"])
def test_brakes_of_an_elastic_belt_take_the_heat_of_its_finite_elements(rig: Rig) -> None:
    scene = stopped(rig)
    window = load_of(scene, "tension_max").window
    assert window is not None
    motion = rig.stopped(window[1], 400)
    assert loads_of(rig, motion)["stop_time"] > 0
    for number, brake in enumerate(rig.brakes):
        spot, diameter = (motion.head, rig.drives["head"].diameter) if brake.at == "head" else (motion.tail, 0.8)
        capacity = brake.capacity(diameter / 2)
        power = [capacity(now) * abs(speed) for now, speed in zip(motion.times.tolist(), spot.belt, strict=True)]
        right = float(np.trapezoid(power, motion.times))
        one = load_of(scene, f"brake_heat[b{number}]").estimate
        assert one.bounded
        assert one.low - 0.004 * right <= right <= one.high + 0.004 * right, (one, right)
        assert one.bar < 0.05 * right


def test_data_of_the_brake_turn_the_verdict() -> None:
    heat = load_of(stopped(ONE), "brake_heat[b0]").estimate.value
    enough = stopped(ONE, stop_heat=f"{1.1 * heat} J", heat_power=f"{heat / 300} W", stops_per_hour=10)
    assert check_of(enough, "CNV127").verdict is Verdict.PASS
    assert check_of(enough, "CNV128").verdict is Verdict.PASS
    assert load_of(enough, "brake_power_mean[b0]").estimate.value == pytest.approx(heat / 360, rel=1e-9)
    short = stopped(ONE, stop_heat=f"{0.9 * heat} J", heat_power=f"{heat / 400} W", stops_per_hour=10)
    for code, key in (("CNV127", "stop_heat"), ("CNV128", "stops_per_hour")):
        judged = check_of(short, code)
        assert judged.verdict is Verdict.FAIL
        assert judged.blame.path == ("brakes", "b0", key)
    assert check_of(stopped(ONE, stops_per_hour=10), "CNV128").verdict is Verdict.NOT_CHECKED
