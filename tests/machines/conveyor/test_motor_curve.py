"""Starts along the motors' torque curve, and special resistances: the rigid conveyor by an ODE solver, and by hand."""

import math
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support.machines import changed, check_of, load_of, report_of, scene_of, spec_of, template

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.machines.conveyor.machine.model import belt_line

CURVE = ((0.0, 1700.0), (800.0, 1500.0), (1300.0, 2100.0), (1480.0, 700.0), (1500.0, 0.0))
"""Motor speed [rpm] and torque [N*m], straight between."""
MOTOR = {
    "count": 1,
    "inertia": "1.4 kg*m^2",
    "speed": "1480 rpm",
    "curve": {"type": "table", "points": [{"speed": f"{n} rpm", "torque": f"{m} N*m"} for n, m in CURVE]},
}


def machine(**changes: Any) -> dict[str, Any]:
    start = {"type": "start", "profile": {"shape": "curve"}}
    data = changed(template(), drive__motor=MOTOR, scenes=[start], **changes)
    return data | {"drive": data["drive"] | {"motor": MOTOR}}


def rim_force(data: dict[str, Any], speed: float) -> float:
    """n M(w) i eta/R from the data of the file."""
    gear, drum = data["drive"]["gear"], data["drive"]["drum"]
    radius = float(drum["diameter"].split()[0]) / 2000
    turns = gear["ratio"] / radius
    rpm, torque = zip(*CURVE, strict=True)
    return float(np.interp(speed * turns * 30 / math.pi, rpm, torque)) * turns * gear["efficiency"]


def test_the_rigid_conveyor_reaches_its_speed_when_an_ode_solver_says_so() -> None:
    data = machine()
    spec = spec_of(data)
    line = belt_line(spec, spec.all_scenes[0])
    mass = sum(part.line_mass * part.length for part in (line.carry, line.back)) + line.tail_mass + line.drive_mass
    resistance = line.static_resistance

    def reached(t: float, y: np.ndarray) -> float:
        return float(y[0] - line.speed)

    reached.terminal = True  # type: ignore[attr-defined]
    motion = solve_ivp(
        lambda t, y: [(rim_force(data, y[0]) - resistance) / mass],
        (0, 100),
        [0.0],
        events=reached,
        rtol=1e-9,
        max_step=0.01,
    )
    assert motion.t_events[0].size == 1
    found = load_of(scene_of(report_of(data)), "start_time").estimate.value
    assert found == pytest.approx(float(motion.t_events[0][0]), rel=2e-3)


def test_the_tension_of_a_soft_start_along_the_curve_is_that_of_the_force() -> None:
    """S_on = T0 + F - m_drive a with a gravity take-up: its largest is that of the breakdown force or more."""
    data = machine(takeup__tension="90 kN", belt__modulus="300000 N/mm", effects={"sag": "off"})
    scene = scene_of(report_of(data))
    spec = spec_of(data)
    line = belt_line(spec, spec.all_scenes[0])
    mass = sum(part.line_mass * part.length for part in (line.carry, line.back)) + line.tail_mass + line.drive_mass
    speeds = np.linspace(0, line.speed, 2000)
    forces = np.array([rim_force(data, v) for v in speeds])
    on = line.takeup_tension + forces - line.drive_mass * (forces - line.static_resistance) / mass
    load = load_of(scene, "tension_run_on_max").estimate
    assert load.high >= float(on.max()) * 0.999
    assert load.value <= float(on.max()) * 1.6


def test_a_motor_with_a_saddle_below_the_resistance_does_not_start() -> None:
    data = machine()
    points = [{"speed": f"{n} rpm", "torque": f"{m} N*m"} for n, m in ((0, 1700), (700, 300), (1400, 1700), (1500, 0))]
    data["drive"]["motor"] = MOTOR | {"curve": {"type": "table", "points": points}}
    scene = scene_of(report_of(data))
    weak = check_of(scene, "CNV104")
    assert weak.verdict is Verdict.FAIL
    assert weak.blame.path[-1] == "curve"
    assert math.isinf(load_of(scene, "start_time").estimate.value)


def test_special_resistances_add_their_force_where_they_act() -> None:
    run = changed(template(), scenes=[{"type": "run"}])
    forces = {
        "skirt": {"force": "2 kN"},
        "plough": {"force": "1 kN", "at": "return"},
        "scraper": {"force": "0.5 kN", "at": "carry"},
    }
    plain, more = (scene_of(report_of(data)) for data in (run, changed(run, resistance__forces=forces)))

    def moved(name: str) -> float:
        return load_of(more, name).estimate.value - load_of(plain, name).estimate.value

    assert moved("effective_tension") == pytest.approx(3500, rel=1e-9)
    assert moved("tension_run_on_max") == pytest.approx(3500, rel=1e-9)
    assert moved("tension_run_off_min") == pytest.approx(0, abs=1e-6)
    assert moved("power_drive_running") == pytest.approx(3500 * 2.5, rel=1e-9)
