"""Every effect of steady running counts: machines stand on both sides of its threshold, and it changes a verdict."""

import math
from typing import Any

import numpy as np
import pytest
from scipy.linalg import eigh
from support import chain_fem
from support.chains import CH_05, FIRST, MOTOR, ROLLER, Reference, chain_of
from support.machines import changed, check_of, load_of, report_of, scene_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.effect import EffectState
from ptmcalc.contract.report import EffectReport, FileReport
from ptmcalc.engine.plan import plan_scene
from ptmcalc.engine.registry import load_kind
from ptmcalc.engine.widen import widen

KIND = load_kind("chain_drive")
SCREW = changed(CH_05, layout__takeup={"type": "screw", "tension": "60 kN"})
DRIVEN = changed(CH_05, drive=MOTOR)
HEAVY_DRIVE = changed(DRIVEN, drive__motor__inertia="40 kg*m^2")

SIDES: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "polygon": (changed(CH_05, speed="0.05 m/s"), changed(CH_05, speed="0.5 m/s")),
    "far_polygon": (changed(CH_05, layout__takeup__tension="3 kN", layout__takeup__mass="612 kg"), SCREW),
    "weak_drive": (HEAVY_DRIVE, DRIVEN),
}
"""For each effect a machine below its threshold and one above."""


def effect_of(report: FileReport, name: str) -> EffectReport:
    return next(effect for effect in scene_of(report).effects if effect.name == name)


def value(report: FileReport, name: str) -> float:
    return load_of(scene_of(report), name).estimate.value


@pytest.mark.parametrize("name", SIDES)
def test_machines_stand_on_both_sides_of_the_threshold(name: str) -> None:
    below, above = (effect_of(report_of(data), name).criterion for data in SIDES[name])
    assert below is not None
    assert above is not None
    assert below.threshold == above.threshold == 0.05
    assert below.value < 0.05 <= above.value
    assert effect_of(report_of(SIDES[name][1]), name).state is EffectState.SIMULATED


def test_the_criterion_sees_a_loop_of_fixed_length() -> None:
    """The textbook's own criterion is blind to a loop of fixed length: at a crawl the chain still stretches."""
    crawl = changed(SCREW, speed="0.01 m/s", sprocket__teeth=9)
    open_loop, closed = (
        effect_of(report_of(data), "polygon").criterion for data in (changed(CH_05, speed="0.01 m/s"), crawl)
    )
    assert open_loop is not None
    assert closed is not None
    assert open_loop.value < 1e-3
    assert closed.value > 0.05


def test_without_an_input_an_effect_has_no_number() -> None:
    assert effect_of(report_of(CH_05), "weak_drive").criterion is None
    far = effect_of(report_of(CH_05), "far_polygon").criterion
    assert far is not None
    assert far.value == 0


@pytest.mark.parametrize("data", [CH_05, SCREW, DRIVEN, ROLLER, changed(ROLLER, drive=MOTOR)])
def test_what_is_left_out_is_inside_the_bars(data: dict[str, Any]) -> None:
    """Every run with fewer effects holds the loads of the run with all."""
    spec = chain_of(data)
    scene = plan_scene(KIND, spec, spec.all_scenes[0])
    richest = {}
    runs = []
    for rung in scene.rungs:
        estimates = widen(scene, spec, rung, rung.solver.run(spec, spec.all_scenes[0], rung.carried, rung.level))
        runs.append((rung, estimates))
        if rung.solver.name in ("distributed_strand", "chain_modes"):
            richest |= estimates if len(rung.carried) == most(scene, rung.solver.name) else {}
    seen = 0
    for rung, estimates in runs:
        for name in (estimates.keys() & richest.keys()) - {"tension_polygon_bound"}:  # a bound, not what it bounds
            one, truth = estimates[name], richest[name]
            if one.value == truth.value:  # an infinite distance too
                continue
            assert one.low - 1e-9 * abs(one.low) <= truth.value <= one.high + 1e-9 * abs(one.high), (rung, name)
            seen += one.bar > 1.01 * truth.bar
    assert seen > 5


def most(scene: Any, solver: str) -> int:
    return max(len(rung.carried) for rung in scene.rungs if rung.solver.name == solver)


# --- each changes a verdict ------------------------------------------------------------------------------------------


def with_limit_between(data: dict[str, Any], load: str, other: dict[str, Any]) -> dict[str, Any]:
    """The machine with its breaking load such that one value of a tension keeps the dynamic safety and one does not."""
    tensions = [value(report_of(one), load) for one in (data, other)]
    return changed(data, chain__breaking_load=f"{7 * sum(tensions) / 2} N")


def test_the_polygon_effect_decides_about_strength() -> None:
    data = changed(CH_05, speed=f"{0.8 * FIRST} m/s")
    off = changed(data, effects={"polygon": "off"})
    strong = with_limit_between(data, "tension_design", off)
    assert check_of(scene_of(report_of(strong)), "CHN102").verdict is Verdict.FAIL
    without = check_of(scene_of(report_of(changed(strong, effects={"polygon": "off"}))), "CHN102")
    assert without.verdict is Verdict.PASS
    assert without.without == ("polygon",)


def test_the_motion_of_the_far_end_decides_about_strength() -> None:
    off = changed(SCREW, effects={"far_polygon": "off"})
    lower, higher = sorted((SCREW, off), key=lambda data: value(report_of(data), "tension_design"))
    between = sum(value(report_of(data), "tension_design") for data in (SCREW, off)) * 7 / 2
    verdicts = [
        check_of(scene_of(report_of(changed(data, chain__breaking_load=f"{between} N"))), "CHN102").verdict
        for data in (lower, higher)
    ]
    assert verdicts == [Verdict.PASS, Verdict.FAIL]


def test_a_drive_that_gives_way_moves_the_resonance() -> None:
    """Nothing but its inertia decides whether the speed lies in the band."""
    held = changed(DRIVEN, effects={"weak_drive": "off"})
    first, moved = (value(report_of(data), "resonance_speed_first") for data in (held, DRIVEN))
    assert moved > 1.2 * first
    verdicts = [
        check_of(scene_of(report_of(changed(data, speed=f"{first} m/s"))), "CHN101").verdict for data in (held, DRIVEN)
    ]
    assert verdicts == [Verdict.FAIL, Verdict.PASS]


def test_the_frequency_with_a_drive_that_gives_way_is_that_of_finite_elements() -> None:
    chain = Reference(CH_05).chain
    mass, stiff = chain_fem.matrices(chain, 200, lumped=False)
    arm = 8 * 0.32 / (2 * math.pi)
    mass[0, 0] += 0.15 * 42.4**2 / arm**2
    frequencies = np.sqrt(np.maximum(eigh(stiff, mass, eigvals_only=True), 0.0))
    found = value(report_of(DRIVEN), "natural_frequency[1]")
    assert found == pytest.approx(frequencies[frequencies > 1.0][0], rel=1e-4)


def test_no_resonance_is_looked_for_without_the_polygon_effect() -> None:
    report = report_of(changed(CH_05, speed=f"{FIRST} m/s", effects={"polygon": "off"}))
    assert [j.code for j in scene_of(report).checks if j.code == "CHN101"] == []
    assert report.verdict == "pass"
