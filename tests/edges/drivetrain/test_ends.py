"""Starts and stops: a limit is one that the file states, and a motion that never ends fails."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from support.command import ptmcalc

HERE = Path(__file__).parent


def findings(path: Path) -> dict[str, str]:
    """The verdict lines of a file by code, without those of other scenes."""
    done = ptmcalc("check", path, "--no-repairs")
    lines = [line.split(": ", 1)[1] for line in done.out.splitlines() if ": " in line]
    return {words[1]: line for line in lines if len(words := line.split()) > 1}


def test_nobody_set_a_limit() -> None:
    found = findings(HERE / "start-limit.yaml")
    assert found["DRV102"].startswith("not_checked")
    assert "`checks.start_time` is not given" in found["DRV102"]
    assert found["DRV103"].startswith("not_checked")
    assert "`checks.stop_time` is not given" in found["DRV103"]
    assert found["DRV109"].startswith("pass")
    assert found["DRV110"].startswith("pass")


TRAIN = """\
kind: drivetrain
inertias: {{motor: {{inertia: 1 kg*m^2}}}}
motors: {{main: {{at: motor, motor: {{type: linear, starting_torque: {torque} N*m, no_load_speed: 100 rad/s}}}}}}
brakes: {{brake: {{at: motor, torque: {brake} N*m, delay: 0 s, rise_time: 0 s}}}}
torques: {{load: {{at: motor, type: constant, torque: -50 N*m}}}}
checks: {{start_time: 60 s, stop_time: 60 s}}
scenes:
  - {{type: start}}
  - {{type: stop, speed: -10 rad/s}}
"""


@pytest.mark.parametrize(
    ("torque", "brake", "verdicts", "said"),
    [
        # 95 rad/s needs 5 % of the torque at rest: 1000 N*m; 500 N*m hold 50 N*m at 90 rad/s (859.4 rpm)
        (2000, 60, {"DRV109": "pass", "DRV110": "pass"}, ""),
        (500, 60, {"DRV109": "fail", "DRV110": "pass"}, "stays at 859.4 rpm and never reaches 907.2 rpm"),
        (2000, 40, {"DRV109": "pass", "DRV110": "fail"}, "does not come to rest"),
    ],
)
def test_what_never_ends_fails(
    tmp_path: Path, torque: float, brake: float, verdicts: dict[str, str], said: str
) -> None:
    path = tmp_path / "train.yaml"
    path.write_text(TRAIN.format(torque=torque, brake=brake), "utf-8")
    found = findings(path)
    assert {code: found[code].split()[0] for code in verdicts} == verdicts
    assert said in " ".join(found.values())


def test_a_start_that_goes_on_after_its_duration_is_undecided(tmp_path: Path) -> None:
    """2 kg*m^2 and 20 N*m reach 100 rad/s after 10 s; 1 s of it is computed."""
    path = tmp_path / "train.yaml"
    path.write_text(
        "kind: drivetrain\ninertias: {motor: {inertia: 2 kg*m^2}}\n"
        "motors: {main: {at: motor, motor: {type: constant, torque: 20 N*m}}}\n"
        "checks: {start_time: 11 s}\n"
        "scenes: [{type: start, until: 100 rad/s, duration: 1 s}]\n",
        "utf-8",
    )
    found = findings(path)
    assert found["DRV102"].startswith("undecided")
    assert found["DRV109"].startswith("undecided")


@pytest.mark.parametrize(("friction", "verdict"), [(40, "fail"), (60, "undecided")])
def test_a_load_that_pulls_back_after_the_duration_fails_a_stop(tmp_path: Path, friction: float, verdict: str) -> None:
    """3 kg*m^2 at 100 rad/s against 50 N*m of load: after at most 6 s they stand, and 40 N*m do not hold them."""
    path = tmp_path / "train.yaml"
    path.write_text(
        "kind: drivetrain\ninertias: {motor: {inertia: 3 kg*m^2}}\n"
        "torques: {load: {at: motor, type: constant, torque: -50 N*m}}\n"
        f"resistances: {{bearing: {{at: motor, coulomb: {friction} N*m, static_ratio: 1}}}}\n"
        "scenes: [{type: stop, speed: 100 rad/s, duration: 0.1 s}]\n",
        "utf-8",
    )
    found = findings(path)
    assert found["DRV110"].startswith(verdict)


def test_speeds_that_still_rise_at_the_end_of_a_start_are_bounded_by_no_window(tmp_path: Path) -> None:
    """50 N*m beyond the speed that ends the start: 2 kg*m^2 go on by 25 rad/s a second, without end."""
    path = tmp_path / "train.yaml"
    path.write_text(
        "kind: drivetrain\ninertias: {motor: {inertia: 2 kg*m^2}}\n"
        "motors: {main: {at: motor, motor: {type: constant, torque: 50 N*m}}}\n"
        "checks: {start_time: 11 s}\n"
        "scenes: [{type: start, until: 100 rad/s}]\n",
        "utf-8",
    )
    report = json.loads(ptmcalc("check", path, "--no-repairs", "--format", "json").out)
    (scene,) = report["files"][0]["scenes"]
    (speed,) = (load for load in scene["loads"] if load["name"] == "speed_max[motor]")
    assert speed["unbounded"]
    assert speed["low"] > 100
    assert any(one["code"] == "NUM112" and "`speed_max[motor]` is not steady" in one["message"] for one in _all(report))


def _all(node: Any) -> Iterator[dict[str, Any]]:
    """Diagnostics anywhere in a report."""
    if isinstance(node, dict):
        if {"code", "message"} <= node.keys():
            yield node
        node = list(node.values())
    if isinstance(node, list):
        for one in node:
            yield from _all(one)
