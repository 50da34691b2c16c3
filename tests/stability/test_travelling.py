"""Travelling cranes at the edge of what a file may say: no traceback, no number that is none, none outside its bar."""

import math
import warnings
from typing import Any

import numpy as np
import pytest
import yaml
from support.travelling import crane, scene_report
from support.turns import first_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import load_text
from ptmcalc.numerics.extremes import Extremes
from ptmcalc.numerics.panels import FloatArray

SEED = 314


def absurd_crane(rng: np.random.Generator) -> dict[str, Any]:
    """Sizes over many decades, in any combination."""

    def size(low: float, high: float) -> float:
        return float(10 ** rng.uniform(low, high))

    span, base = size(-1, 3), size(-1, 2)
    data: dict[str, Any] = {
        "kind": "crane",
        "type": "travelling",
        "load": f"{size(-3, 7)} kg",
        "hook_block": f"{size(-3, 4)} kg" if rng.integers(2) else "0 kg",
        "bridge": {"mass": f"{size(0, 7)} kg", "span": f"{span} m", "height": f"{size(-2, 2)} m"},
        "trolley": {"mass": f"{size(0, 6)} kg", "nearest": f"{0.3 * span} m", "height": f"{size(-2, 2)} m"},
        "wheels": {
            "diameter": f"{size(-2, 1)} m",
            "base": f"{base} m",
            "per_corner": int(rng.integers(1, 5)),
            "driven": [["A1", "B1"], ["A1", "A2", "B1", "B2"], ["B2"]][int(rng.integers(3))],
            "rating": f"{size(2, 7)} N",
            "frame": ["hinged", "rigid"][int(rng.integers(2))],
        },
        "rolling": {"coefficient": size(-4, -1)},
        "rail": {"adhesion": 0.14, "slope": float(rng.choice([0.0, 0.001, 0.1])), "step": "1 mm", "frequency": "9 Hz"},
        "speed": f"{size(-3, 1.5)} m/s",
        "drive": {
            "motor": {"inertia": f"{size(-6, 2)} kg*m^2", "mean_starting_torque": f"{size(-3, 5)} N*m"},
            "gear": {"ratio": size(-1, 3), "efficiency": float(rng.uniform(0.55, 1.0))},
            "brake": {"torque": f"{size(-3, 5)} N*m", "delay": f"{size(-3, 0)} s", "rise_time": f"{size(-3, 0)} s"},
            "wheels": ["separate", "coupled"][int(rng.integers(2))],
        },
        "suspension": {"length": f"{size(-2, 3)} m", "hoist_speed": f"{size(-4, 0)} m/s"},
        "buffers": {"type": "linear", "stiffness": f"{size(2, 8)} N/m", "stroke": f"{size(-3, 0)} m", "rating": "1 MN"},
        "guide": {"clearance": f"{size(-4, -1)} m", "rating": "1 MN"},
    }
    if rng.integers(2):
        data["drive"] |= {"acceleration": f"{size(-4, 1.5)} m/s^2", "deceleration": f"{size(-4, 1.5)} m/s^2"}
    if rng.integers(2):
        data["wind"] = {"area": f"{size(-1, 3)} m^2", "load_area": f"{size(-2, 2)} m^2", "pressure": "100 Pa"}
        data["wind"]["pressure_storm"] = "900 Pa"
    return data


@pytest.mark.parametrize("seed", first_of(6, range(16)))
def test_absurd_sizes_through_a_whole_check(seed: int) -> None:
    data = absurd_crane(np.random.default_rng([SEED, seed]))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        report = check(load_text(yaml.safe_dump(data).encode(), "case.yaml"), Options(repairs=False))
    assert [(d.path, d.message) for d in report.diagnostics if d.severity == "error"] == []
    for scene in report.scenes:
        for load in scene.loads:
            one = load.estimate
            assert not any(math.isnan(part) for part in (one.value, one.low, one.high)), load.info.name
            assert one.low <= one.value <= one.high, (load.info.name, one)
        assert all(judgement.verdict is not Verdict.UNDECIDED or judgement.reason for judgement in scene.checks)


@pytest.mark.parametrize("scale", [1e-3, 1e3])
def test_masses_and_forces_in_other_sizes(scale: float) -> None:
    """Everything that has a mass in it so many times: the same times, angles and reserves."""
    changes = {
        "load": f"{1e4 * scale} kg",
        "hook_block": f"{250 * scale} kg",
        "bridge__mass": f"{13e3 * scale} kg",
        "trolley__mass": f"{2.2e3 * scale} kg",
        "drive__motor__inertia": f"{0.006 * scale} kg*m^2",
        "drive__motor__coupling_inertia": f"{0.002 * scale} kg*m^2",
        "drive__motor__mean_starting_torque": f"{32 * scale} N*m",
        "drive__brake__torque": f"{16 * scale} N*m",
    }
    scenes = [{"type": "start"}, {"type": "brake", "by": "brake"}]
    for name in ("start_loaded", "brake_loaded"):
        one, other = (
            {load.info.name: load.estimate.value for load in scene_report(crane(scenes=scenes, **given), name).loads}
            for given in ({}, changes)
        )
        for load in ("sway_angle_max", "sway_residual", "skid_reserve_min", "acceleration_max"):
            assert other[load] == pytest.approx(one[load], rel=1e-6), load


def test_a_drive_that_stops_exactly_as_the_load_swings_back() -> None:
    """Half a period and whole ones: the load hangs plumb, or swings its most, when the ramp ends."""
    half = math.pi * math.sqrt(8 / 9.81)
    swings = []
    for times in (1, 2, 4):
        data = crane(drive__acceleration=None, drive__ramp_time=f"{times * half!r} s")
        loads = {load.info.name: load.estimate.value for load in scene_report(data).loads}
        swings.append(loads["sway_residual"] / loads["sway_angle_max"])
    assert swings == pytest.approx([1.0, 0.0, 0.0], abs=1e-3)


@pytest.mark.parametrize("gravity", ["1e9 m/s^2", "1e11 m/s^2", "1e13 m/s^2"])
def test_swings_without_number_are_not_looked_at_one_by_one(gravity: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """A load that swings a million times while its crane starts: said to be unknown, and at no price."""
    seen, ours = [], Extremes.see

    def counted(self: Extremes, starts: FloatArray, *given: Any, **named: Any) -> None:
        seen.append(len(starts))
        ours(self, starts, *given, **named)

    monkeypatch.setattr(Extremes, "see", counted)
    data = crane(gravity=gravity, suspension__hoist_speed="8 m/min", scenes=[{"type": "start"}, {"type": "brake"}])
    report = check(load_text(yaml.safe_dump(data).encode(), "case.yaml"), Options(repairs=False, budget=0.5))
    assert {d.code for d in report.diagnostics if d.code.startswith("NUM")} >= {"NUM103"}
    assert sum(seen) <= 1_000_000
