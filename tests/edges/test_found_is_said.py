"""Rule 4: what a run finds out is a failed check: a load that sinks, a belt that slips permanently or runs away, a
rope, belt or chain that goes slack, a motor that stalls, a brake that does not hold, a shaft that does not pass a dead
centre. No file below states a limit for what is found."""

import os
from dataclasses import replace
from typing import Any

import pytest
import yaml
from support.machines import changed
from support.random_machines import KINDS, machine

from ptmcalc.base.diagnostic import Severity, Verdict
from ptmcalc.contract.machine import AnyKind
from ptmcalc.contract.report import FileReport
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import load_text

Data = dict[str, Any]
SEED = int(os.environ.get("PTMCALC_SEED", "43"))
NUMBER = 3


def _template(label: str, scene: Data, **changes: Any) -> Data:
    (kind,) = (one for one in KINDS if one.label == label)
    return changed(yaml.safe_load(kind.template), scenes=[scene], **changes)


def _chain(scene: Data, **changes: Any) -> Data:
    motor = {"inertia": "0.12 kg*m^2", "speed": "1470 rpm", "mean_starting_torque": "200 N*m"}
    drive = {"motor": motor, "gear": {"ratio": 62.7, "efficiency": 0.93}}
    return changed(_template("chain_drive", scene, drive=drive), **changes)


def _hoist(scene: Data, **changes: Any) -> Data:
    return _template("hoist", scene, **changes)


def _slewing(**changes: Any) -> Data:
    return _template("crane slewing", {"type": "slew"}, **changes)


def _travelling(scene: Data, **changes: Any) -> Data:
    return _template("crane travelling", scene, **changes)


def _stacker(label: str, block: str, scene: Data, **changes: Any) -> Data:
    drive = {
        "motor": {"inertia": "0.02 kg*m^2", "speed": "1400 rpm", "mean_starting_torque": "40 N*m"},
        "gear": {"ratio": 14.66, "efficiency": 0.9},
        "brake": {"torque": "40 N*m", "delay": "0 s"},
    }
    travel = {"speed": "2 m/s", "drive": drive, "wheel_diameter": "400 mm", "resistance": "400 N"}
    return _template(label, scene, **{block: travel}, **changes)


def _shaft(scene: Data, **changes: Any) -> Data:
    return _template("shaft", scene, checks=None, **changes)


def _train(scene: Data, **changes: Any) -> Data:
    return _template("drivetrain", scene, checks=None, **changes)


OVERHEAD, RACK = "crane overhead_stacker", "crane rack_stacker"
LIFTED = [{"type": "unbalance", "mass": "1 t", "radius": "500 mm", "top": "90 deg"}]
"""A weight that the shaft lifts from its angle 0 on, by up to 4.9 kN*m"""
CASES: dict[str, tuple[Data, tuple[str, ...]]] = {
    "conveyor: the motor stalls": (
        _template("conveyor", {"type": "start"}, drive__motor__mean_starting_torque="200 N*m"), ("CNV104",)),
    "conveyor: the belt slips": (
        _template("conveyor", {"type": "run"}, takeup__tension="2 kN"), ("CNV101",)),
    "conveyor: the belt goes slack": (
        _template("conveyor", {"type": "run"}, takeup__tension="0.5 kN"), ("CNV105",)),
    "conveyor: the belt runs back": (
        _template("conveyor", {"type": "backstop"}, resistance__rest_factor=0.3, backstop=None), ("CNV109",)),
    "conveyor: the belt slips on its braked pulley and runs away": (
        _template("conveyor", {"type": "stop"}, route__lift="-40 m", drive__drum__friction=0.1,
                  brakes={"disc": {"at": "head", "torque": "40 kN*m", "shaft": "drum", "delay": "0.3 s"}}),
        ("CNV107",)),
    "conveyor: the brake does not hold the belt": (
        _template("conveyor", {"type": "stop"}, route__lift="-40 m",
                  brakes={"disc": {"at": "head", "torque": "1 kN*m", "shaft": "drum", "delay": "0.3 s"}}),
        ("CNV107",)),
    "chain_drive: the motor stalls": (
        _chain({"type": "start"}, drive__motor__mean_starting_torque="60 N*m"), ("CHN120",)),
    "chain_drive: the chain goes slack in its start": (
        _chain({"type": "start"}, layout__takeup__tension="100 N"), ("CHN123",)),
    "chain_drive: the chain runs slack": (
        _chain({"type": "run"}, layout__takeup__tension="10 N", speed="2 m/s"), ("CHN105",)),
    "chain_drive: the chain runs away": (
        _chain({"type": "coast"}, layout__lift="-20 m", layout__resistance__coefficient=0.1,
               layout__resistance__load_coefficient=0.1), ("CHN125",)),
    "chain_drive: the brake does not stop the chain": (
        _chain({"type": "stop"}, layout__lift="-20 m", layout__resistance__coefficient=0.1,
               layout__resistance__load_coefficient=0.1, brake={"torque": "1 N*m", "shaft": "motor"}),
        ("CHN125",)),
    "chain_drive: the brake does not hold the chain": (
        _chain({"type": "backstop"}, layout__lift="30 m", layout__resistance__coefficient=0.05,
               layout__resistance__load_coefficient=0.05, brake={"torque": "1 N*m", "shaft": "motor"}),
        ("CHN129",)),
    "hoist: the load sinks": (
        _hoist({"type": "start", "direction": "up"}, motor__mean_starting_torque="30 N*m"), ("HST114",)),
    "hoist: the motor stalls": (
        _hoist({"type": "lift"}, motor__mean_starting_torque="30 N*m"), ("HST121",)),
    "hoist: the brake does not hold": (
        _hoist({"type": "lower_brake"}, brake__torque="20 N*m"), ("HST118", "HST122")),
    "hoist: the brake does not hold a lifted load": (
        _hoist({"type": "stop", "direction": "up"}, brake__torque="20 N*m"), ("HST118",)),
    "hoist: the rope goes slack": (
        _hoist({"type": "release", "share": 0.95}), ("HST126",)),
    "crane slewing: the motor stalls": (
        _slewing(motor__mean_starting_torque="3 N*m"), ("CRN101",)),
    "crane slewing: the brake does not hold against the wind": (
        _slewing(wind__maximum="30 kN*m"), ("CRN113",)),
    "crane travelling: the motors stall": (
        _travelling({"type": "start"}, drive__acceleration=None, drive__motor__mean_starting_torque="3 N*m"),
        ("CRN150", "CRN160")),
    "crane travelling: the brakes do not hold the crane": (
        _travelling({"type": "brake", "by": "brake"}, rail__slope=0.1), ("CRN151",)),
    "crane travelling: wheels slide": (
        _travelling({"type": "start"}, drive__acceleration="2 m/s^2"), ("CRN155",)),
    "crane travelling: a motor does not follow its ramp": (
        _travelling({"type": "start"}, drive__motor__mean_starting_torque="8 N*m"), ("CRN156",)),
    "crane travelling: the buffers bottom out": (
        _travelling({"type": "collision"}, buffers={
            "type": "linear", "count": 2, "stiffness": "40 kN/m", "stroke": "100 mm"}), ("CRN170",)),
    "crane travelling: the storm drives it away": (
        _travelling({"type": "storm"}, wind={"area": "60 m^2", "pressure": "150 Pa", "pressure_storm": "2000 Pa"}),
        ("CRN175",)),
    "crane overhead_stacker: the motor stalls": (
        _stacker(OVERHEAD, "bridge_travel", {"type": "start"},
                 bridge_travel__drive__motor__mean_starting_torque="2 N*m"), ("CRN204",)),
    "crane rack_stacker: the motor stalls": (
        _stacker(RACK, "travel", {"type": "start"}, travel__drive__motor__mean_starting_torque="2 N*m"),
        ("CRN204",)),
    "shaft: the motor does not pass the dead centre": (
        _shaft({"type": "run_up"}, potential=LIFTED), ("SHF103",)),
    "shaft: the motor stalls in its run-up": (_shaft({"type": "run_up"}, losses__torque="5 kN*m"), ("SHF103",)),
    "shaft: the motor stalls": (_shaft({"type": "steady"}, losses__torque="5 kN*m"), ("SHF101",)),
    "shaft: the brake does not hold at the worst angle": (
        _shaft({"type": "run_out"}, potential=LIFTED, brake__torque="4 kN*m", inertia__crank_inertia="900 kg*m^2"),
        ("SHF105", "SHF106")),
    "shaft: the brake does not hold": (
        _shaft({"type": "run_out", "from": "0 deg"}, potential=LIFTED, brake__torque="2 kN*m",
               inertia__crank_inertia="900 kg*m^2"), ("SHF105", "SHF106")),
    "drivetrain: the motor stalls": (
        _train({"type": "start"}, resistances__rolling__coulomb="60 kN"), ("DRV109",)),
    "drivetrain: the brake does not hold": (
        _train({"type": "stop", "speed": "980 rpm"},
               torques={"pull": {"at": "crane", "type": "constant", "torque": "40 kN"}},
               brakes__brake__torque="20 N*m"), ("DRV110",)),
}  # fmt: skip


def report_of(data: Data, *, repairs: bool = False) -> FileReport:
    loaded = load_text(yaml.safe_dump(data, sort_keys=False).encode(), "case.yaml")
    assert loaded.spec is not None, [(one.path, one.message, one.hint) for one in loaded.diagnostics]
    return check(loaded, Options(repairs=repairs, budget=1.0))


def test_each_kind_has_cases() -> None:
    assert {name.partition(":")[0] for name in CASES} == {kind.label for kind in KINDS}


@pytest.mark.parametrize("name", CASES)
def test_what_is_found_fails(name: str) -> None:
    data, codes = CASES[name]
    report = report_of(data)
    found = {one.code: one.verdict for _, one in report.judgements if one.code in codes}
    assert found == dict.fromkeys(codes, Verdict.FAIL)
    assert report.verdict == "fail"


@pytest.mark.parametrize(
    "name", [name for name in CASES if name.partition(":")[0] in ("hoist", "shaft", "chain_drive")]
)
def test_a_failure_names_its_cure(name: str) -> None:
    """A value of a key that passes, what was tried, or a cure in words; a machine without a brake lacks one."""
    data, codes = CASES[name]
    for _, one in report_of(data, repairs=True).judgements:
        if one.code in codes:
            assert one.repair or one.tried or "; " in one.reason or one.blame.path == ("brake",)


@pytest.mark.parametrize("name", CASES)
def test_a_check_switched_off_stays_off(name: str) -> None:
    data, codes = CASES[name]
    off = {code: {"off": "held by others"} for code in codes}
    report = report_of({**data, "checks": {**(data.get("checks") or {}), **off}})
    assert {one.verdict for _, one in report.judgements if one.code in codes} == {Verdict.OFF}


MOTIONS = frozenset({"NUM110"})
"""Findings of a motion that does not come about."""


@pytest.mark.parametrize("index", range(NUMBER))
@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.label)
def test_no_warning_of_a_motion_stands_beside_passed_checks(kind: AnyKind, index: int) -> None:
    made = machine(kind, SEED, index)
    report = check(replace(made.loaded, assumed=()), Options(repairs=False, budget=0.3))
    told = [one.message for one in report.diagnostics if one.code in MOTIONS and one.severity is Severity.WARNING]
    assert not told or report.verdict == "fail", (made.name, told)
