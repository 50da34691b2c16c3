"""Rule 2: a motor `curve` of the file is followed in each scene and each check. A check whether a drive can start or
lift reads the smallest surplus over the whole speed range; the mean of a curve decides nothing."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import pytest
import yaml
from support.machines import changed
from support.machines import report_of as whole_report_of
from support.random_machines import KINDS, meet

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.machine import AnyKind
from ptmcalc.contract.report import FileReport

Data = dict[str, Any]
DIPS = (0.0, 0.4, 0.9)
"""Shares of the speed range at which a curve falls below the load."""
_WIDTH = 0.1
"""Half the width of a dip, over the speed range."""
_BUDGET = 1.0
"""Predicted seconds of work of a scene."""
_LEFT = 0.01
"""Torque at the bottom of a dip, over the mean torque."""


@dataclass(frozen=True)
class Starting:
    """A machine that starts: its file by what the motor gives, and the checks that a weak motor fails."""

    made: Callable[[Data, Data], Data]
    """from the template and the keys of the torque"""
    torque: float
    """with which it starts [N*m]"""
    top: float
    """full speed of the motor [rpm]"""
    fails: tuple[str, ...]
    """checks whether it can start or lift"""
    mean: str = "mean_starting_torque"
    """key of a torque that does not change; empty where a motor is always a curve"""
    rated: bool = False
    """whether its file gives the power of the motor beside the curve"""
    holds: bool = False
    """whether a motor with a mean torque keeps full speed once it has it, and a curve that never falls does not"""


def _conveyor(data: Data, torque: Data) -> Data:
    data = changed(data, drive__motor__mean_starting_torque=None, scenes=[{"type": "start"}])
    data["drive"]["motor"] |= torque
    return data


def _chain_drive(data: Data, torque: Data) -> Data:
    motor = {"inertia": "0.12 kg*m^2", "speed": "1470 rpm", **torque}
    gear = {"ratio": 52.2, "efficiency": 0.93}
    return data | {
        "drive": {"motor": motor, "gear": gear}, "scenes": [{"type": "start"}], "checks": {"start_time": "60 s"}
    }  # fmt: skip


def _hoist(data: Data, torque: Data) -> Data:
    scenes = [{"type": "run"}, {"type": "start", "direction": "up"}, {"type": "lift", "speed": "main"}]
    data = changed(data, motor__mean_starting_torque=None, scenes=scenes)
    data["motor"] |= torque
    return data


def _slewing(data: Data, torque: Data) -> Data:
    data = changed(data, motor__mean_starting_torque=None, scenes=[{"type": "slew"}])
    data["motor"] |= torque
    return data


def _travelling(data: Data, torque: Data) -> Data:
    scenes = [{"type": "run"}, {"type": "start"}]
    data = changed(data, drive__motor__mean_starting_torque=None, drive__acceleration=None, scenes=scenes)
    data["drive"]["motor"] |= torque
    return data


def _stacker(block: str) -> Callable[[Data, Data], Data]:
    def made(data: Data, torque: Data) -> Data:
        drive = {
            "motor": {"inertia": "0.02 kg*m^2", "speed": "1400 rpm", **torque},
            "gear": {"ratio": 14.66, "efficiency": 0.9},
            "brake": {"torque": "40 N*m", "delay": "0 s"},
        }
        travel = {"speed": "2 m/s", "drive": drive, "wheel_diameter": "400 mm", "resistance": "400 N"}
        return data | {block: travel, "scenes": [{"type": "start"}]}

    return made


def _shaft(data: Data, torque: Data) -> Data:
    scenes = [{"type": "run_up"}]
    inertia = {"type": "constant", "value": "300 kg*m^2"}
    data = data | {"inertia": inertia, "scenes": scenes, "potential": []}
    data = {key: value for key, value in data.items() if key not in ("load", "potential")}
    return changed(data, drive__motor=torque["curve"], scenes__0__to="55 rpm")


def _drivetrain(data: Data, torque: Data) -> Data:
    data = changed(data, motors__main__motor=torque["curve"], links__shaft__gap=None)
    return data | {"scenes": [{"type": "start", "until": "930 rpm"}], "checks": {"start_time": "60 s"}}


STARTING = {
    "conveyor": Starting(_conveyor, 700, 1480, ("CNV104",)),
    "chain_drive": Starting(_chain_drive, 250, 1470, ("CHN120", "CHN121")),
    "hoist": Starting(_hoist, 95, 1400, ("HST114",), rated=True, holds=True),
    "crane slewing": Starting(_slewing, 18, 900, ("CRN101", "CRN102", "CRN118"), rated=True),
    "crane travelling": Starting(_travelling, 32, 1400, ("CRN150", "CRN160"), rated=True),
    "crane overhead_stacker": Starting(_stacker("bridge_travel"), 40, 1400, ("CRN204",)),
    "crane rack_stacker": Starting(_stacker("travel"), 40, 1400, ("CRN204",)),
    "shaft": Starting(_shaft, 60, 1400, ("SHF103",), mean=""),
    "drivetrain": Starting(_drivetrain, 200, 960, ("DRV102", "DRV109"), mean=""),
}


def table(*points: tuple[float, float]) -> Data:
    """A curve through points of speed [rpm] and torque [N*m]."""
    return {"type": "table", "points": [{"speed": f"{n!r} rpm", "torque": f"{m!r} N*m"} for n, m in points]}


def dipped(mean: float, top: float, at: float) -> Data:
    """A curve that is even but for a dip, with a mean of its own up to full speed."""
    least, width = _LEFT * mean, _WIDTH * top
    inside = 1.0 if at else 0.5  # half of a dip at rest is below 0
    even = (mean - least * inside * _WIDTH) / (1 - inside * _WIDTH)
    middle = at * top
    points = [(0.0, even), (middle - width, even)] if at else []
    return table(*points, (middle, least), (middle + width, even), (2 * top, even))


def report_of(data: Data) -> FileReport:
    return whole_report_of(data, budget=_BUDGET)


def file_of(kind: AnyKind, torque: Data) -> Data:
    return STARTING[kind.label].made(yaml.safe_load(kind.template), torque)


def verdicts(report: FileReport, codes: tuple[str, ...]) -> dict[tuple[str, str], Verdict]:
    return {(scene.name, one.code): one.verdict for scene, one in report.judgements if one.code in codes}


def even(kind: AnyKind) -> Data:
    case = STARTING[kind.label]
    return file_of(kind, {"curve": {"type": "constant", "torque": f"{case.torque} N*m"}})


def test_each_kind_starts() -> None:
    assert STARTING.keys() == {kind.label for kind in KINDS}


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.label)
def test_an_even_curve_starts_the_machine(kind: AnyKind) -> None:
    found = verdicts(report_of(even(kind)), STARTING[kind.label].fails)
    assert {code for _, code in found} == set(STARTING[kind.label].fails)
    assert set(found.values()) == {Verdict.PASS}


@pytest.mark.parametrize("at", DIPS)
@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.label)
def test_a_curve_of_the_same_mean_that_falls_below_the_load_fails(kind: AnyKind, at: float) -> None:
    case = STARTING[kind.label]
    report = report_of(file_of(kind, {"curve": dipped(case.torque, case.top, at)}))
    assert set(verdicts(report, case.fails).values()) == {Verdict.FAIL}
    assert report.verdict == "fail"


def slip_ring(case: Starting, step: float, smallest: float) -> Data:
    """A slip-ring motor with one step of rotor resistance, rated for the starting torque at full speed; torques over
    the rated torque."""
    power = case.torque * case.top * math.pi / 30
    return {
        "type": "rheostat", "power": f"{power!r} W", "speed": f"{case.top!r} rpm", "overload": 2.5, "steps": [step],
        "synchronous_speed": f"{case.top / 0.94!r} rpm", "smallest_torque": f"{smallest * case.torque!r} N*m",
    }  # fmt: skip


@pytest.mark.parametrize(("step", "smallest", "fails"), [(3, 1.1, False), (40, 0.02, True)])
@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.label)
def test_each_step_of_a_slip_ring_motor_must_start_the_machine(
    kind: AnyKind, step: float, smallest: float, fails: bool
) -> None:
    """The rotor alone would start each of them: what decides is the torque at which the resistance is cut out."""
    case = STARTING[kind.label]
    curve = slip_ring(case, step, smallest)
    rated = {"power": curve["power"]} if case.rated else {}
    found = set(verdicts(report_of(file_of(kind, {"curve": curve, **rated})), case.fails).values())
    assert found == {Verdict.FAIL} if fails else Verdict.FAIL not in found


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.label)
def test_an_even_curve_gives_the_loads_of_the_same_torque(kind: AnyKind) -> None:
    case = STARTING[kind.label]
    level = table((0.0, float(case.torque)), (2.0 * case.top, float(case.torque)))
    assert apart(kind, report_of(even(kind)), report_of(file_of(kind, {"curve": level}))) == []


@pytest.mark.parametrize("kind", [one for one in KINDS if STARTING[one.label].mean], ids=lambda kind: kind.label)
def test_an_even_curve_gives_the_loads_of_a_mean_torque(kind: AnyKind) -> None:
    case = STARTING[kind.label]
    mean = report_of(file_of(kind, {case.mean: f"{case.torque} N*m"}))
    assert apart(kind, report_of(even(kind)), mean, but=HELD if case.holds else RACED) == []


HELD = ("rope_force", "bridge_f", "lift_off_", "backlash_", "gear_impact_", "tension_time")
"""Loads of a hoist that depend on what its motor does once it has its speed: how these names begin."""
RACED = ("belt_speed_max", "motor_speed_max")
"""The same of a conveyor: a motor with an even torque accelerates beyond its speed."""


def apart(kind: AnyKind, one: FileReport, other: FileReport, but: tuple[str, ...] = ()) -> list[str]:
    """Loads of two reports whose intervals do not intersect, and checks of a start whose verdicts differ."""
    first, second = (verdicts(report, STARTING[kind.label].fails) for report in (one, other))
    wrong = [f"{key}: {first[key]} {second[key]}" for key in first.keys() & second.keys() if first[key] != second[key]]
    assert first.keys() & second.keys()
    for scene, same in zip(one.scenes, other.scenes, strict=True):
        loads = {load.info.name: load.estimate for load in same.loads if load.info.name not in same.health}
        wrong += [
            f"{scene.name}: {load.info.name} {load.estimate} {loads[load.info.name]}"
            for load in scene.loads
            if load.info.name in loads
            and not load.info.name.startswith(but or ("-",))
            and not meet(load.estimate, loads[load.info.name], rounding=1e-6)
        ]
    return wrong
