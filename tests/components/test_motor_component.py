"""Motors as a file gives them: their curves against the plate, closed forms and whole starts, and what they refuse."""

import math
import pickle
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from pydantic import TypeAdapter, ValidationError
from scipy.integrate import solve_ivp

from ptmcalc.components.motor import (
    AnyMotor,
    ConstantMotor,
    ConverterMotor,
    InductionMotor,
    LinearMotor,
    RheostatMotor,
    Stage,
    TableMotor,
)
from ptmcalc.components.motor_rating import braking_number_at, number_at
from ptmcalc.components.motor_torque import overhauled_torque, overhauling_reserve, range_up_to
from ptmcalc.spec.machine import replaced
from ptmcalc.spec.shape import example_of, keys_of, measure_of

READER: TypeAdapter[Any] = TypeAdapter(AnyMotor)
RPM = math.pi / 30

CONSTANT = {"type": "constant", "torque": "80 N*m"}
LINEAR = {"type": "linear", "starting_torque": "80 N*m", "no_load_speed": "1500 rpm"}
PLATE = {"power": "22 kW", "speed": "1440 rpm", "synchronous_speed": "1500 rpm", "overload": 2.5}
INDUCTION = {"type": "induction", **PLATE}
RHEOSTAT = {"type": "rheostat", **PLATE, "steps": [6, 3, 1.5], "smallest_torque": "160 N*m"}
TIMES = ["1 s", "1.5 s", "1.75 s"]
BY_TIME = {"type": "rheostat", **PLATE, "steps": [6, 3, 1.5], "switch_times": TIMES}
CONVERTER = {
    "type": "converter",
    "power": "22 kW",
    "speed": "1500 rpm",
    "ramp_time": "2 s",
    "torque_limit": "200 N*m",
    "slip": 0.04,
}
POINTS = [
    {"speed": "0 rpm", "torque": "90 N*m"},
    {"speed": "300 rpm", "torque": "70 N*m"},
    {"speed": "1200 rpm", "torque": "160 N*m"},
    {"speed": "1500 rpm", "torque": "0 N*m"},
    {"speed": "1600 rpm", "torque": "-120 N*m"},
]
TABLE = {"type": "table", "points": POINTS}
ALL = [CONSTANT, LINEAR, INDUCTION, RHEOSTAT, BY_TIME, CONVERTER, TABLE]


def read(data: dict[str, Any], **changes: Any) -> Any:
    """The motor of a file; None takes a key away."""
    return READER.validate_python({key: value for key, value in (data | changes).items() if value is not None})


def faults(data: dict[str, Any], **changes: Any) -> list[tuple[str, str, str]]:
    """Key, reason and hint of all that is wrong."""
    with pytest.raises(ValidationError) as caught:
        read(data, **changes)
    errors = caught.value.errors(include_url=False)
    return [(".".join(map(str, e["loc"][1:])), e["msg"], e.get("ctx", {}).get("hint", "")) for e in errors]


def by_type(data: dict[str, Any]) -> str:
    return str(data["type"]) + ("_by_time" if "switch_times" in data else "")


@pytest.mark.parametrize("data", ALL, ids=by_type)
class TestEveryMotor:
    def test_reads_and_stays_as_it_is(self, data: dict[str, Any]) -> None:
        motor = read(data)
        assert motor.type == data["type"]
        assert pickle.loads(pickle.dumps(motor)) == motor

    def test_takes_arrays_as_numbers(self, data: dict[str, Any]) -> None:
        motor = read(data)
        speeds, times = np.linspace(-50, 250, 12).reshape(3, 4), np.linspace(0, 3, 12).reshape(3, 4)
        whole = motor.torque(speeds, times)
        for index in np.ndindex(3, 4):
            assert motor.torque(float(speeds[index]), float(times[index])) == whole[index]
        assert motor.torque(speeds[0], 0.7).tolist() == motor.torque(speeds[0], np.full(4, 0.7)).tolist()

    def test_is_without_torque_at_its_no_load_speed_and_brakes_above(self, data: dict[str, Any]) -> None:
        motor, late = read(data), 100.0
        speed = motor.no_load_speed
        assert (speed is None) == isinstance(motor, ConstantMotor)
        if speed is not None:
            assert speed == pytest.approx(1500 * RPM, rel=1e-12)
            assert motor.torque(speed, late) == pytest.approx(0.0, abs=1e-9)
            assert motor.torque(0.99 * speed, late) > 0 > motor.torque(1.01 * speed, late)

    def test_the_last_stage_is_the_torque_of_a_start_long_ago(self, data: dict[str, Any]) -> None:
        motor, speeds = read(data), np.linspace(-80, 260, 35)
        last: Stage = motor.stages[-1]
        assert (last.until_speed, last.until_time) == (None, None)
        late = speeds[speeds > 150] if motor.stages[0].until_speed else speeds
        assert motor.torque(late, 1e6) == pytest.approx(last.torque(late), rel=1e-12, abs=1e-9)

    def test_every_stage_is_pieces_or_a_formula_with_its_slope(self, data: dict[str, Any]) -> None:
        for stage in read(data).stages:
            assert (stage.pieces is None) != (stage.formula is None)
            assert (stage.formula is None) == (stage.slope is None)
            if stage.formula and stage.slope:
                at = np.array([-30.0, 0.0, 60.0, 140.0, 156.0, 170.0])
                difference = (stage.formula(at + 1e-4) - stage.formula(at - 1e-4)) / 2e-4
                assert stage.slope(at) == pytest.approx(difference, rel=1e-6, abs=1e-5)

    def test_a_changed_copy_has_the_changed_torque(self, data: dict[str, Any]) -> None:
        """As a study of one value makes it: nothing of the old curve stays."""
        motor, speed, late = read(data), 155.0, 50.0
        key = next(k for k in ("torque", "starting_torque", "power", "points") if k in data)
        path = (key, 2, "torque") if key == "points" else (key,)
        attribute = motor.constant if key == "torque" else None
        value = motor.points[2].torque if key == "points" else attribute or getattr(motor, key)
        changed = replaced(motor, path, 0.9 * value)
        assert changed.torque(speed, late) == pytest.approx(0.9 * motor.torque(speed, late), rel=1e-12)

    def test_too_small_an_overload_limit(self, data: dict[str, Any]) -> None:
        plate = {} if "power" in data else {"rated_torque": "140 N*m"}
        rated = read(data, **plate).rated
        assert rated == pytest.approx(140.0 if plate else 22e3 / read(data).speed, rel=1e-12)
        ((key, reason, hint),) = faults(data, **plate, largest_torque="100 N*m")
        assert (key, reason[:25]) == ("largest_torque", "it is below the rated tor")
        assert read(data, **plate, largest_torque=hint.split("`")[1].removeprefix("largest_torque: "))


@pytest.mark.parametrize("data", ALL, ids=by_type)
def test_no_speed_up_to_ten_times_the_no_load_speed_brakes_more(data: dict[str, Any]) -> None:
    motor = READER.validate_python(data)
    most = overhauled_torque(motor)
    looked = -motor.torque(np.linspace(0.0, 10 * (motor.no_load_speed or 157.0), 200_001), 1e6)
    if data["type"] == "linear":
        assert most == math.inf
    else:
        assert most == pytest.approx(max(float(looked.max()), 0.0), rel=1e-6)


def test_a_table_that_only_brakes_backwards_holds_no_load_forwards() -> None:
    points = [(-100, -50), (0, 50), (100, 0)]
    table = [{"speed": f"{speed} rpm", "torque": f"{torque} N*m"} for speed, torque in points]
    assert overhauled_torque(READER.validate_python({"type": "table", "points": table})) == 0.0


class TestPieces:
    def test_constant(self) -> None:
        motor = read(CONSTANT)
        assert motor.torque([-1e3, 0.0, 1e3]).tolist() == [80, 80, 80]
        assert motor.rated is None
        assert motor.stages == (Stage(pieces=((0.0, 80.0),)),)

    def test_linear_goes_on_beyond_both_ends(self) -> None:
        motor = read(LINEAR)
        end = 1500 * RPM
        assert motor.torque([-end, 0.0, end / 4, end, 2 * end]) == pytest.approx([160, 80, 60, 0, -80], abs=1e-9)
        assert motor.stages[0].pieces == ((0.0, 80.0), (pytest.approx(end), 0.0))
        assert motor.stages[0].extends

    def test_table_is_straight_between_its_points_and_level_outside(self) -> None:
        motor = read(TABLE)
        speeds = np.array([-100, 0, 150, 300, 750, 1350, 1500, 1550, 1600, 5000]) * RPM
        torques = [90, 90, 80, 70, 115, 80, 0, -60, -120, -120]
        assert motor.torque(speeds) == pytest.approx(torques, abs=1e-9)
        assert not motor.stages[0].extends

    @pytest.mark.parametrize(
        ("torques", "rpm"),
        [([50, 50], None), ([50, 0], 200), ([50, -50], 150), ([0, 50, -150, 20, -1], 225), ([-9, -1], None)],
    )
    def test_no_load_speed_of_a_table(self, torques: list[float], rpm: float | None) -> None:
        points = [{"speed": f"{100 * (k + 1)} rpm", "torque": f"{m} N*m"} for k, m in enumerate(torques)]
        speed = read(TABLE, points=points).no_load_speed
        assert speed is None if rpm is None else speed == pytest.approx(rpm * RPM, rel=1e-12)


class TestInduction:
    def test_gives_its_rated_torque_at_its_rated_speed(self) -> None:
        for formula in ({}, {"formula": "full"}, {"formula": "full", "stator_ratio": 2}):
            motor: InductionMotor = read(INDUCTION, **formula)
            assert motor.rated == pytest.approx(22e3 / (1440 * RPM), rel=1e-12)
            assert motor.torque(1440 * RPM) == pytest.approx(motor.rated, rel=1e-12)
            assert motor.speed_at(motor.rated) == pytest.approx(1440 * RPM, rel=1e-12)
            curve = motor.torque(np.linspace(0, 1500 * RPM, 40_001))
            assert float(np.max(curve)) == pytest.approx(motor.breakdown_torque, rel=1e-6)
            assert np.argmax(curve) / 40_000 == pytest.approx(1 - motor.breakdown_slip, abs=1e-3)

    def test_the_stator_ratio_is_1_when_left_out(self) -> None:
        speeds = np.linspace(-100.0, 200.0, 31)
        full = read(INDUCTION, formula="full").torque(speeds)
        assert full.tolist() == read(INDUCTION, formula="full", stator_ratio=1).torque(speeds).tolist()
        assert full[speeds == 0] > 1.1 * read(INDUCTION).torque(0.0)

    def test_drives_a_press_up_to_speed(self) -> None:
        """J = 30 + 8 sin^2 phi kg m^2, friction 35 N m, gear 12 of efficiency 0.94, to 95 % of no load; the run-up was
        integrated elsewhere: 0.882493 s and 4.75784 rad."""
        motor = read(INDUCTION, power="5.5 kW", overload=2.3)
        assert (motor.rated, motor.breakdown_slip) == pytest.approx((36.473, 0.174849), rel=3e-6)
        assert motor.breakdown_torque == pytest.approx(83.8879, rel=3e-6)
        ratio, gear = 12.0, 12 * 0.94
        assert float(motor.torque(0.0)) * gear == pytest.approx(321.088, rel=3e-6)

        def right(_: float, y: NDArray[np.float64]) -> list[float]:
            inertia, change = 30 + 8 * math.sin(y[0]) ** 2, 8 * math.sin(2 * y[0])
            return [y[1], (float(motor.torque(y[1] * ratio)) * gear - 35 - change * y[1] ** 2 / 2) / inertia]

        def up(_: float, y: NDArray[np.float64]) -> float:
            return float(y[1]) - 0.95 * 1500 * RPM / ratio

        up.terminal = True  # type: ignore[attr-defined]
        run = solve_ivp(right, (0, 3), [0.0, 0.0], method="DOP853", rtol=1e-10, atol=1e-12, events=up)
        assert run.t[-1] == pytest.approx(0.882493, rel=2e-6)
        assert run.y[0, -1] == pytest.approx(4.75784, rel=2e-6)


class TestRheostat:
    def test_steps_are_cut_out_at_the_smallest_torque(self) -> None:
        motor: RheostatMotor = read(RHEOSTAT)
        *steps, natural = motor.stages
        speeds = [step.until_speed for step in steps]
        assert None not in speeds
        assert speeds == sorted(speeds)
        slip = 1 - motor.speed_at(160.0) / (1500 * RPM)
        for step, factor, speed in zip(steps, motor.steps, speeds, strict=True):
            assert 1 - speed / (1500 * RPM) == pytest.approx(factor * slip, rel=1e-12)
            assert step.torque(speed) == pytest.approx(160.0, rel=1e-12)
            assert motor.torque(speed - 1e-9) == pytest.approx(160.0, rel=1e-6)
            assert motor.torque(speed) > 200
        assert natural.torque(speeds[-1]) == motor.torque(speeds[-1])
        assert motor.torque(1440 * RPM) == pytest.approx(motor.rated, rel=1e-12)

    def test_a_start_never_sees_less_than_the_smallest_torque(self) -> None:
        motor = read(RHEOSTAT)
        torques = motor.torque(np.linspace(0, motor.speed_at(160.0), 5000, endpoint=False))
        assert float(np.min(torques)) == pytest.approx(160.0, rel=2e-3)
        assert 160.0 <= float(np.min(torques)) <= float(np.max(torques)) <= motor.breakdown_torque

    def test_steps_are_cut_out_at_their_times(self) -> None:
        motor = read(BY_TIME)
        assert [stage.until_time for stage in motor.stages] == [1.0, 1.5, 1.75, None]
        times = [0.0, 0.999, 1.0, 1.499, 1.5, 1.75, 60.0]
        expected = [float(motor.stages[k].torque(100.0)) for k in (0, 0, 1, 1, 2, 3, 3)]
        assert motor.torque(100.0, times).tolist() == expected
        assert len(set(expected)) == 4

    @pytest.mark.parametrize("formula", [{}, {"formula": "full"}])
    def test_resistance_moves_the_curve_along_the_slip(self, formula: dict[str, str]) -> None:
        """The same torque at f times the slip: of the circuit, in which resistance and slip stand as R_2/s alone."""
        motor = read(RHEOSTAT, **formula)
        field, slips = 1500 * RPM, np.array([-0.3, 0.01, 0.1, 0.3])
        natural = motor.stages[-1].torque(field * (1 - slips))
        for stage, factor in zip(motor.stages, (6, 3, 1.5), strict=False):
            assert stage.torque(field * (1 - factor * slips)) == pytest.approx(natural, rel=1e-12)


class TestConverter:
    def test_follows_its_ramp_as_far_as_its_limit_lets_it(self) -> None:
        motor: ConverterMotor = read(CONVERTER)
        assert motor.reference([0.0, 0.5, 2.0, 7.0]) == pytest.approx(np.array([0, 375, 1500, 1500]) * RPM)
        droop = 0.04 * 1500 * RPM
        assert motor.stiffness == pytest.approx(motor.rated / droop, rel=1e-12)
        reference = float(motor.reference(0.5))
        speeds = reference + droop * np.array([-9, -1, 0, 0.5, 9])
        expected = np.clip(motor.rated * np.array([9, 1, 0, -0.5, -9]), -200, 200)
        assert motor.torque(speeds, 0.5) == pytest.approx(expected, abs=1e-9)

    def test_rating_at_another_speed_than_the_one_asked_for(self) -> None:
        motor = read(CONVERTER, speed="600 rpm", rated_speed="1470 rpm")
        assert motor.rated == pytest.approx(22e3 / (1470 * RPM), rel=1e-12)
        assert motor.no_load_speed == pytest.approx(600 * RPM)
        assert motor.torque((600 - 0.04 * 1470) * RPM, 9.0) == pytest.approx(motor.rated, rel=1e-12)

    def test_rated_torque_and_stiffness_as_such(self) -> None:
        plain = {"power": None, "slip": None, "rated_torque": "120 N*m", "stiffness": "30 N*m*s/rad"}
        motor = read(CONVERTER, **plain)
        assert (motor.rated, motor.stiffness, motor.limit) == (120, 30, 200)
        assert motor.torque(1500 * RPM - 2, 9.0) == pytest.approx(60.0)
        assert replaced(motor, ("stiffness",), 10.0).torque(1500 * RPM - 2, 9.0) == pytest.approx(20.0)


WRONG: list[tuple[dict[str, Any], dict[str, Any], str, str, dict[str, Any]]] = [
    (INDUCTION, {"speed": "1500 rpm"}, "speed", "below the synchronous", {"speed": "1455 rpm"}),
    (INDUCTION, {"speed": "1600 rpm"}, "speed", "swap", {"speed": "1500 rpm", "synchronous_speed": "1600 rpm"}),
    (INDUCTION, {"stator_ratio": 1}, "stator_ratio", "`formula: full`", {"formula": "full"}),
    (INDUCTION, {"formula": "full", "stator_ratio": 9}, "stator_ratio", "`stator_ratio: 3.14`", {"stator_ratio": 3.14}),
    (INDUCTION, {"formula": "full", "speed": "1200 rpm"}, "formula", "`stator_ratio: 0.629`", {"stator_ratio": 0.629}),
    (INDUCTION, {"overload": 1}, "overload", "greater than 1", {"overload": 1.01}),
    (RHEOSTAT, {"steps": [6, 1, 2]}, "steps.1", "greater than 1", {"steps": [6, 2]}),
    (RHEOSTAT, {"steps": [3, 3, 2]}, "steps.1", "largest first", {"steps": [3, 2]}),
    (RHEOSTAT, {"steps": [2, 6]}, "steps.1", "largest first", {"steps": [6, 2]}),
    (RHEOSTAT, {"steps": [40, 3]}, "steps.0", "below 22.4", {"steps": [22.3, 3]}),
    (RHEOSTAT, {"steps": []}, "steps", "at least 1", {"steps": [2]}),
    (RHEOSTAT, {"smallest_torque": "400 N*m"}, "smallest_torque", "182.4 N*m", {"smallest_torque": "182.4 N*m"}),
    (RHEOSTAT, {"switch_times": ["1 s", "2 s", "3 s"]}, "switch_times", "delete", {"switch_times": None}),
    (RHEOSTAT, {"smallest_torque": None}, "", "add `smallest_torque", {"smallest_torque": "150 N*m"}),
    (BY_TIME, {"switch_times": ["1 s", "2 s"]}, "switch_times", "3 steps", {"steps": [3, 2]}),
    (BY_TIME, {"switch_times": ["1 s", "2 s", "2 s"]}, "switch_times.2", "sort", {"switch_times": TIMES}),
    (CONVERTER, {"torque_limit": "100 N*m"}, "torque_limit", "210.1 N*m", {"torque_limit": "210.1 N*m"}),
    (CONVERTER, {"stiffness": "30 N*m*s/rad"}, "stiffness", "delete `stiffness`", {"stiffness": None}),
    (CONVERTER, {"slip": None}, "", "add `slip: 0.03`", {"slip": 0.03}),
    (CONVERTER, {"power": None}, "", "add `power: 250 kW`", {"power": "25 kW"}),
    (CONVERTER, {"rated_torque": "100 N*m"}, "rated_torque", "delete", {"rated_torque": None}),
    (CONVERTER, {"slip": 1.5}, "slip", "at most 1", {"slip": 0.05}),
    (
        CONVERTER | {"power": None, "slip": None, "rated_torque": "90 N*m", "stiffness": "9 N*m*s/rad"},
        {"rated_speed": "1470 rpm"}, "rated_speed", "delete `rated_speed`", {"rated_speed": None},
    ),
    (TABLE, {"points": [*POINTS[:2], POINTS[1]]}, "points.2.speed", "sort", {"points": POINTS}),
    (TABLE, {"points": POINTS[:1]}, "points", "at least 2", {"points": POINTS[:2]}),
]  # fmt: skip
"""A sound motor, what is changed, the key that is blamed, a part of what is said, and a change that mends it."""


@pytest.mark.parametrize(("data", "changes", "key", "said", "mended"), WRONG)
def test_what_does_not_go_together(
    data: dict[str, Any], changes: dict[str, Any], key: str, said: str, mended: dict[str, Any]
) -> None:
    ((blamed, reason, hint),) = faults(data, **changes)
    assert blamed == key
    assert said in f"{reason} {hint}"
    assert read(data, **changes | mended)


@pytest.mark.parametrize("data", ALL, ids=by_type)
def test_a_faulty_value_is_told_once_and_nothing_is_guessed_from_it(data: dict[str, Any]) -> None:
    """Whatever else would be compared with it."""
    for key in set(data) - {"type"}:
        if key == "points":
            wrong: Any = [*data[key][:2], {"speed": "fast", "torque": "1 N*m"}, *data[key][2:]]
        elif isinstance(data[key], list):
            wrong = ["fast", *data[key][1:]]
        else:
            wrong = "fast"
        assert [blamed.split(".")[0] for blamed, _, _ in faults(data, **{key: wrong})] == [key]


@pytest.mark.parametrize("data", ALL, ids=by_type)
def test_every_key_is_described_with_an_example_that_reads(data: dict[str, Any]) -> None:
    model = type(read(data))
    keys = keys_of(model)
    properties = READER.json_schema()["$defs"][model.__name__]["properties"]
    assert set(data) <= set(properties) == set(keys)
    for key in set(keys) - {"type"}:
        assert properties[key]["description"], key
        measure = measure_of(keys[key])
        if measure is not None:
            assert measure.read(example_of(keys[key])) > 0


def test_the_types() -> None:
    types = {type(read(data)) for data in ALL}
    assert types == {ConstantMotor, LinearMotor, InductionMotor, RheostatMotor, ConverterMotor, TableMotor}
    with pytest.raises(ValidationError, match="type"):
        READER.validate_python({"torque": "3 N*m"})


@pytest.mark.parametrize(
    ("data", "key"),
    [
        (CONSTANT, "torque"),
        (LINEAR, "starting_torque"),
        (INDUCTION, "power"),
        (RHEOSTAT, "power"),
        (BY_TIME, "power"),
        (CONVERTER, "torque_limit"),
    ],
    ids=["constant", "linear", "induction", "rheostat", "rheostat by time", "converter"],
)
def test_the_number_behind_a_curve_makes_every_torque_of_it_larger(data: dict[str, Any], key: str) -> None:
    """In proportion, or to a larger limit."""
    assert number_at(("drive", "motor", "curve"), read(data)) == ("drive", "motor", "curve", key)
    number, unit = data[key].split()
    larger = read(data, **{key: f"{1.25 * float(number)} {unit}"})
    stages = list(zip(read(data).stages, larger.stages, strict=True))
    for before, after in stages:
        assert after.torque(0.0) == pytest.approx(1.25 * before.torque(0.0), rel=1e-9)


def test_a_table_has_no_such_number_and_other_keys_stand_for_themselves() -> None:
    assert number_at(("motor", "curve"), read(TABLE)) == ()
    assert number_at(("motor", "curve"), None) == ()
    assert number_at(("motor", "mean_starting_torque"), read(TABLE)) == ("motor", "mean_starting_torque")


@pytest.mark.parametrize("data", [INDUCTION, RHEOSTAT, BY_TIME], ids=["induction", "rheostat", "by time"])
def test_a_power_that_is_given_twice_is_not_the_number_of_a_curve(data: dict[str, Any]) -> None:
    """It would have to change in two places; the breakdown torque grows with the overload too."""
    motor, path = read(data), ("motor", "curve")
    assert number_at(path, motor, rated=True) == ()
    assert braking_number_at(path, motor) == (*path, "power")
    assert braking_number_at(path, motor, rated=True) == (*path, "overload")
    assert overhauled_torque(read(data, overload=2 * motor.overload)) == pytest.approx(
        2 * overhauled_torque(motor), rel=1e-9
    )


def test_the_other_numbers_of_a_curve_stand_alone() -> None:
    for data, key in ((LINEAR, "starting_torque"), (CONVERTER, "torque_limit")):
        assert braking_number_at(("curve",), read(data), rated=True) == ("curve", key)
    assert braking_number_at(("curve",), read(TABLE), rated=True) == ()


def test_the_reserve_of_braking_is_that_of_all_motors_over_the_load() -> None:
    points = [{"speed": "0 rpm", "torque": "50 N*m"}, {"speed": "100 rpm", "torque": "-20 N*m"}]
    motor = READER.validate_python({"type": "table", "points": points})
    assert overhauling_reserve(motor, 3, 30.0) == pytest.approx(2.0, rel=1e-12)
    assert overhauling_reserve(motor, 3, 0.0) == overhauling_reserve(motor, 3, -1.0) == math.inf


def test_steps_that_end_by_speed_do_so_at_any_time() -> None:
    """A long time after the start too, at which steps that end by time are over."""
    motor = read(RHEOSTAT)
    first = motor.stages[0]
    assert first.until_speed is not None
    below = 0.99 * first.until_speed
    for time in (0.0, 1.0, math.inf):
        assert motor.torque(below, time) == first.torque(below)
    assert read(BY_TIME).torque(below, math.inf) == motor.stages[-1].torque(below)


@pytest.mark.parametrize("data", [INDUCTION, RHEOSTAT, BY_TIME], ids=["induction", "rheostat", "by time"])
def test_the_range_of_a_start_holds_the_torque_of_each_stage(data: dict[str, Any]) -> None:
    motor = read(data)
    top = motor.speed
    least, most = range_up_to(motor, top)
    for stage in motor.stages:
        torques = stage.torque(np.linspace(0.0, min(stage.until_speed or top, top), 777))
        assert least <= torques.min()
        assert torques.max() <= most
    assert least >= motor.stages[-1].torque(top) / 6 - 1
    assert most <= 1.01 * max(float(stage.torque(np.linspace(0.0, top, 4000)).max()) for stage in motor.stages)
