"""Cage motors by their rating plate: typical values of the table, and the curve through their torques."""

import csv
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pydantic import TypeAdapter, ValidationError
from support.command import ROOT

from ptmcalc.components.plate_motor import PlateMotor
from ptmcalc.components.rating_plate import plate_motor, synchronous_speed, typical

RPM = math.pi / 30
TABLE = Path(ROOT, "ptmcalc", "catalogue", "cage_motors.csv").read_text("utf-8").splitlines()
ROWS = list(csv.DictReader(line for line in TABLE if not line.startswith("#")))
READER = TypeAdapter(PlateMotor)


@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"{row['poles']}-{row['power']}")
def test_typical_values_are_those_of_the_table(row: dict[str, str]) -> None:
    found = typical(int(row["poles"]), float(row["power"]))
    for name in ("slip", "locked_rotor", "breakdown", "inertia"):
        value, interval = getattr(found, name)
        assert value == pytest.approx(float(row[name]))
        assert (interval.low, interval.high) == pytest.approx((float(row[f"{name}_low"]), float(row[f"{name}_high"])))


def test_larger_motors_than_those_of_the_table_have_more_inertia() -> None:
    assert typical(4, 630e3).inertia[0] == pytest.approx(typical(4, 315e3).inertia[0] * 2)
    assert typical(4, 630e3).slip == typical(4, 315e3).slip


@pytest.mark.parametrize(
    ("rated", "synchronous"),
    [(2950, 3000), (1485, 1500), (1420, 1500), (985, 1000), (740, 750), (3550, 3600), (1785, 1800), (1180, 1200),
     (885, 900), (590, 600)],
)  # fmt: skip
def test_the_synchronous_speed_is_the_next_one_above(rated: float, synchronous: float) -> None:
    assert synchronous_speed(rated * RPM) == pytest.approx(synchronous * RPM)


def test_no_synchronous_speed_is_far_above() -> None:
    assert synchronous_speed(4000 * RPM) is None


def test_the_curve_goes_through_the_torques_of_the_catalogue() -> None:
    motor = plate_motor(90e3, 1480 * RPM, 1500 * RPM, 2.2, 2.6)
    rated = 90e3 / (1480 * RPM)
    breakdown = (20 / 1500) * (2.6 + math.sqrt(2.6**2 - 1))
    for speed, torque in (
        (0.0, 2.2),
        (500.0, 0.85 * 2.2),
        (1500 * (1 - breakdown), 2.6),
        (1480.0, 1.0),
        (1500.0, 0.0),
        (1520.0, -1.0),
    ):
        assert float(motor.torque(speed * RPM, 0.0)) == pytest.approx(torque * rated, rel=1e-9, abs=1e-9)
    halfway = (500 + 1500 * (1 - breakdown)) / 2
    assert float(motor.torque(halfway * RPM, 0.0)) == pytest.approx((0.85 * 2.2 + 2.6) / 2 * rated)


def test_its_slope_is_that_of_the_torque() -> None:
    stage = plate_motor(90e3, 1480 * RPM, 1500 * RPM, 2.2, 2.6).stages[0]
    assert stage.slope is not None
    for speed in np.array([5.0, 300.0, 900.0, 1300.0, 1450.0, 1490.0, 1530.0]) * RPM:
        wanted = (float(stage.torque(speed + 1e-5)) - float(stage.torque(speed - 1e-5))) / 2e-5
        assert float(stage.slope(np.array(speed))) == pytest.approx(wanted, rel=1e-5)


def motor(**keys: Any) -> PlateMotor:
    return READER.validate_python(keys)


def test_a_plate_with_a_starting_torque_starts_by_that_torque() -> None:
    both = motor(power="90 kW", speed="1480 rpm", inertia="1 kg*m^2", mean_starting_torque="700 N*m",
                 breakdown_ratio=2.6)  # fmt: skip
    assert both.start_curve is None
    assert both.running_curve is not None
    assert both.mean_torque == 700
    assert both.rated_torque == pytest.approx(90e3 / (1480 * RPM))


@pytest.mark.parametrize(
    ("keys", "text"),
    [
        ({"power": "90 kW"}, "add `speed: 1485 rpm` or `poles: 4`"),
        ({"poles": 4, "inertia": "1 kg*m^2", "mean_starting_torque": "70 N*m"}, "`power` is missing"),
        ({"power": "90 kW", "speed": "1500 rpm", "poles": 4}, "below its synchronous speed"),
        ({"power": "90 kW", "speed": "5000 rpm"}, "no_load_speed: 1500 rpm"),
        ({"power": "90 kW", "speed": "740 rpm"}, "typical values are known of motors with 4 and 6 poles only"),
        ({"mean_starting_torque": "70 N*m"}, "the rotor of the motor"),
    ],
)
def test_what_a_plate_lacks_is_said(keys: dict[str, Any], text: str) -> None:
    with pytest.raises(ValidationError, match="error") as found:
        motor(**keys)
    said = str([one.get("ctx", one) for one in found.value.errors()])
    assert text in said
