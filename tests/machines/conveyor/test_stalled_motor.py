"""What a backstop holds when the motors of a jammed belt stall: torques of the plates, by hand."""

import math
from typing import Any

import pytest
import yaml
from support.machines import changed, load_of, report_of, scene_of, template

from ptmcalc.engine.load import load_text

PLATE = {"power": "110 kW", "speed": "1485 rpm", "synchronous_speed": "1500 rpm", "overload": 2.5}
RPM = math.pi / 30


def machine(curve: bool = True, stalled: str = "on") -> dict[str, Any]:
    backstop = {"torque": "20 kN*m", "stalled_motor": stalled}
    data = changed(template(), backstop=backstop, scenes=[{"type": "backstop"}])
    if curve:
        data["drive"]["motor"] |= {"curve": {"type": "induction"} | PLATE}
    return data


def held(data: dict[str, Any]) -> float:
    return load_of(scene_of(report_of(data)), "backstop_torque").estimate.value


def test_the_backstop_holds_the_breakdown_torque() -> None:
    data = machine()
    drive = data["drive"]
    stalled = (
        drive["motor"]["count"] * 2.5 * 110e3 / (1485 * RPM) * drive["gear"]["ratio"] * drive["gear"]["efficiency"]
    )
    assert held(data) == pytest.approx(stalled, rel=1e-4)
    assert held(machine(stalled="off")) < stalled


def test_a_motor_without_a_curve_is_asked_for_one() -> None:
    (problem,) = load_text(yaml.safe_dump(machine(curve=False)).encode(), "x.yaml").diagnostics
    assert problem.code == "SPC113"
    assert problem.hint == "add `power: 90 kW` and `poles: 4`, or write `stalled_motor: off`"
