"""Slewing cranes far outside of any sense: a number with an honest bar, a verdict, or a finding; never a traceback."""

import math

import numpy as np
import pytest
from support.machines import changed, loaded, report_of
from support.slewing import YARD
from support.slewing_samples import absurd_crane
from support.turns import first_of

from ptmcalc.engine.check import Options, check


@pytest.mark.parametrize("seed", first_of(12, range(60)))
def test_an_absurd_crane_gets_numbers_or_a_finding(seed: int) -> None:
    read = loaded(absurd_crane(np.random.default_rng(seed)))
    report = check(read, Options(repairs=False, budget=1.0))
    for scene in report.scenes:
        for load in scene.loads:
            assert not math.isnan(load.estimate.value), load.info.name
            assert load.estimate.low <= load.estimate.value <= load.estimate.high, load.info.name
        for judgement in scene.checks:
            said = judgement.reason or any(one.code.startswith("NUM") for one in report.diagnostics)
            assert judgement.verdict.value in ("pass", "fail") or said


@pytest.mark.parametrize(
    "changes",
    [
        {"load__rope_length": "1 mm"},
        {"load__rope_length": "1 km"},
        {"load__mass": "1 g", "load__hook_block": "0 kg"},
        {"load__mass": "2000 t"},
        {"friction": "0 N*m", "wind": None},
        {"brake__torque": "1 MN*m"},
        {"brake__delay": "60 s"},
        {"cycle__rotation": "15.1 deg"},
        {"cycle__rotation": "3600 deg"},
        {"gear__efficiency": 1, "gear__open": None},
        {"gear__efficiency": 0.5},
        {"gear__efficiency": 0.3, "motor__mean_starting_torque": "40 N*m"},
        {"motor__mean_starting_torque": "5.41 N*m"},
        {"motor__mean_starting_torque": "10 kN*m"},
        {"speed": "20 rpm", "motor__speed": None, "motor__power": None},
        {"gravity": "1 mm/s^2"},
        {"wind__gust": "1 MN*m"},
        {"wind__maximum": "1 MN*m"},
        {
            "wind": {
                "steady": "1.5 kN*m",
                "maximum": "4 kN*m",
                "gust": "2 kN*m",
                "gust_rise": "1 ms",
                "gust_time": "1 h",
            }
        },
        {"scenes": [{"type": "slew", "load": "empty"}]},
    ],
    ids=str,
)
def test_the_ends_of_what_a_file_can_say(changes: dict[str, object]) -> None:
    report = check(loaded(changed(YARD, **changes)), Options(repairs=False, budget=1.0))
    assert report.valid
    for scene in report.scenes:
        for load in scene.loads:
            assert not math.isnan(load.estimate.value), load.info.name
        for judgement in scene.checks:
            said = judgement.reason or any(one.code.startswith("NUM") for one in report.diagnostics)
            assert judgement.verdict.value in ("pass", "fail") or said


def test_a_start_that_just_stalls_and_one_that_just_starts_differ() -> None:
    """5.4012 N*m carry 3.5 kN*m to the axis: below nothing starts, above it takes long and is still a number."""

    def start(torque: str) -> float:
        report = report_of(changed(YARD, motor__mean_starting_torque=torque), budget=5.0)
        return next(load.estimate.value for load in report.scenes[0].loads if load.info.name == "start_time")

    assert start("5.4012 N*m") == math.inf
    assert 1e4 < start("5.40124 N*m") < math.inf
