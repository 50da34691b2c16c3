"""Steady running on motor curves, against a root search on the sum of the curves."""

import math
from typing import Any

import numpy as np
import pytest
from pydantic import TypeAdapter
from scipy.optimize import brentq, minimize_scalar

from ptmcalc.components.motor import AnyMotor
from ptmcalc.components.steady_drive import Motors, shared_forces, steady_reserve

READER: TypeAdapter[Any] = TypeAdapter(AnyMotor)
RPM = math.pi / 30
TURNS = 61.0


def induction(power: float, speed: float, overload: float) -> Any:
    plate = {"power": f"{power!r} W", "speed": f"{speed!r} rpm", "synchronous_speed": "1500 rpm", "overload": overload}
    return READER.validate_python({"type": "induction", **plate})


def kloss(power: float, rated: float, overload: float, speed: float) -> float:
    slip, rated_slip = 1 - speed / (1500 * RPM), 1 - rated / 1500
    most = rated_slip * (overload + math.sqrt(overload**2 - 1))
    return 2 * overload * power / (rated * RPM) * slip * most / (slip**2 + most**2)


def random_drives(seed: int) -> tuple[list[Motors], Any]:
    rng = np.random.default_rng(seed)
    plates = [
        (rng.uniform(5e3, 90e3), rng.uniform(1430, 1490), rng.uniform(1.7, 3.0), int(rng.integers(1, 4)))
        for _ in range(int(rng.integers(1, 4)))
    ]
    efficiency = float(rng.uniform(0.85, 0.99))
    drives = [Motors(induction(*plate[:3]), plate[3], TURNS, efficiency) for plate in plates]

    def force(speed: float) -> float:
        torques = [count * kloss(power, rated, most, speed * TURNS) for power, rated, most, count in plates]
        return sum(TURNS * torque * (efficiency if torque > 0 else 1 / efficiency) for torque in torques)

    return drives, force


@pytest.mark.parametrize("seed", range(40))
def test_induction_motors_together(seed: int) -> None:
    drives, force = random_drives(seed)
    full = 1500 * RPM / TURNS
    speed = 0.97 * full
    tried = np.linspace(0.9 * speed, full, 4001)
    near = tried[int(np.argmax([force(one) for one in tried]))]
    peak = minimize_scalar(lambda v: -force(v), bounds=(max(0.9 * speed, near - 0.01), near + 0.01), method="bounded",
                           options={"xatol": 1e-12})  # fmt: skip
    most = max(-peak.fun, force(0.9 * speed))
    assert steady_reserve(drives, 1e3, speed) == pytest.approx(most / 1e3, rel=1e-7)
    for load in (0.3 * most, -0.4 * most):
        at = brentq(lambda v, load=load: force(v) - load, max(near, 0.9 * speed) if load > 0 else full,
                    full if load > 0 else full + (full - near) / 2 + 1e-3, xtol=1e-14)  # fmt: skip
        wanted = [float(one.force(np.array(at))) for one in drives]
        assert shared_forces(drives, load, speed) == pytest.approx(wanted, rel=1e-6)


def test_motors_that_brake_hold_their_breakdown_torque() -> None:
    drives = [Motors(induction(11e3, 1455, 2.4), 2, TURNS, 0.9)]
    breakdown = 2.4 * 11e3 / (1455 * RPM)
    assert steady_reserve(drives, -5e3, 2.5) == pytest.approx(2 * breakdown * TURNS / 0.9 / 5e3, rel=1e-12)
    assert shared_forces(drives, -5e3, 2.5) == [-5e3]
    assert drives[0].torque(-5e3) == pytest.approx(-5e3 * 0.9 / TURNS / 2, rel=1e-12)


def test_nothing_to_carry_needs_no_motor() -> None:
    assert steady_reserve([Motors(induction(11e3, 1455, 2.4), 1, TURNS, 0.9)], 0.0, 2.5) == math.inf


def test_a_linear_motor_holds_any_load_and_a_constant_one_none() -> None:
    linear = READER.validate_python({"type": "linear", "starting_torque": "80 N*m", "no_load_speed": "1500 rpm"})
    constant = READER.validate_python({"type": "constant", "torque": "80 N*m"})
    assert steady_reserve([Motors(linear, 1, TURNS, 0.9)], -1e9, 2.5) == math.inf
    assert steady_reserve([Motors(constant, 1, TURNS, 0.9)], -1.0, 2.5) <= 0
    assert steady_reserve([Motors(constant, 1, TURNS, 0.9)], 1e3, 2.5) == pytest.approx(80 * TURNS * 0.9 / 1e3)


def test_drives_that_cannot_carry_the_load_share_it_as_their_largest_forces() -> None:
    drives = [Motors(induction(11e3, 1455, 2.4), 1, TURNS, 0.9), Motors(induction(22e3, 1455, 2.4), 1, TURNS, 0.9)]
    one, two = shared_forces(drives, 1e6, 2.5)
    assert two == pytest.approx(2 * one, rel=1e-6)
    assert one + two == pytest.approx(1e6)
