"""Chain drives at the edge of what a file may say: no traceback, no number that is none, none outside its bar."""

import math
import warnings
from typing import Any

import numpy as np
import pytest
import yaml
from support.chain_samples import absurd_chain
from support.chains import CH_05, ROLLER, chain_of
from support.machines import changed, load_of, report_of, scene_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.report import FileReport
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import load_text
from ptmcalc.engine.plan import plan_scene
from ptmcalc.engine.registry import load_kind
from ptmcalc.engine.widen import widen

SEED = 4711
KIND = load_kind("chain_drive")


def sound(report: FileReport) -> FileReport:
    """Every load is a number or infinite, its value inside its bar; what is not known is said."""
    assert [d for d in report.diagnostics if d.severity == "error"] == []
    for scene in report.scenes:
        for load in scene.loads:
            one = load.estimate
            assert not any(math.isnan(part) for part in (one.value, one.low, one.high)), load.info.name
            assert one.low <= one.value <= one.high, (load.info.name, one)
        for judgement in scene.checks:
            assert judgement.verdict is not Verdict.UNDECIDED or judgement.reason
    return report


@pytest.mark.parametrize("seed", range(40))
def test_absurd_sizes(seed: int) -> None:
    """Every run that could be made gives numbers, infinite ones or none, with bars round them."""
    spec = chain_of(absurd_chain(np.random.default_rng([SEED, seed])))
    scene = plan_scene(KIND, spec, spec.all_scenes[0])
    for planned in scene.effects:
        assert planned.criterion is None or not math.isnan(planned.criterion.value)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for rung in scene.rungs:
            result = rung.solver.run(spec, spec.all_scenes[0], rung.carried, rung.level)
            for name, one in widen(scene, spec, rung, result).items():
                assert not any(math.isnan(part) for part in (one.value, one.low, one.high)), (rung.solver.name, name)
                assert one.low <= one.value <= one.high, (rung.solver.name, name, one)


@pytest.mark.parametrize("seed", [100, 101])
def test_absurd_sizes_through_a_whole_check(seed: int) -> None:
    data = absurd_chain(np.random.default_rng([SEED, seed]))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        sound(check(load_text(yaml.safe_dump(data).encode(), "case.yaml"), Options(histories=True)))


@pytest.mark.parametrize("scale", [1e-6, 1e-3, 1e3, 1e6])
def test_stiffness_and_masses_in_other_sizes(scale: float) -> None:
    """All masses, stiffnesses and forces so many times: the same safety, ratios and speeds."""

    def times(text: Any) -> str:
        value, unit = text.split()
        return f"{float(value) * scale!r} {unit}"

    keys = {
        "layout__load": CH_05["layout"]["load"],
        "layout__takeup__tension": CH_05["layout"]["takeup"]["tension"],
        "chain__mass": CH_05["chain"]["mass"],
        "chain__breaking_load": CH_05["chain"]["breaking_load"],
        "chain__section": CH_05["chain"]["section"],
    }
    plain = sound(report_of(CH_05))
    scaled = sound(report_of(changed(CH_05, **{key: times(text) for key, text in keys.items()})))
    for name in ("safety_dynamic", "safety_static", "frequency_ratio", "resonance_distance", "resonance_speed_first"):
        one, other = (load_of(scene_of(report), name).estimate.value for report in (plain, scaled))
        assert other == pytest.approx(one, rel=1e-9)
    for name in ("tension_design", "tension_dynamic_polygon", "tension_min"):
        one, other = (load_of(scene_of(report), name).estimate.value for report in (plain, scaled))
        assert other == pytest.approx(scale * one, rel=1e-9)


@pytest.mark.parametrize("data", [CH_05, ROLLER])
@pytest.mark.parametrize("ratio", [0.0, 1e-12, 1e-6, 1.0])
def test_damping_of_any_size(data: dict[str, Any], ratio: float) -> None:
    for law in ("kelvin_voigt", "hysteretic"):
        report = sound(report_of(changed(data, chain__damping={"law": law, "ratio": ratio})))
        assert (report.verdict == "pass") <= (ratio > 0)


@pytest.mark.parametrize("speed", [1e-9, 1e-3, 1e3, 1e6])
def test_speeds_of_fifteen_decades(speed: float) -> None:
    report = sound(report_of(changed(CH_05, speed=f"{speed!r} m/s")))
    load = load_of(scene_of(report), "tension_dynamic_polygon").estimate
    if speed == 1e-3:  # the chain follows as a whole: 3 m a_max is 30 mN
        assert 0 <= load.value < load.high < 1.0


def test_a_held_loop_keeps_its_polygon_tension_at_a_crawl() -> None:
    """EA u/L of the loop: nine teeth pull and slacken both runs by half a pitch apart."""
    data = changed(CH_05, layout__takeup={"type": "screw", "tension": "60 kN"}, sprocket__teeth=9, speed="0.001 m/s")
    found = load_of(scene_of(sound(report_of(data))), "tension_dynamic_polygon").estimate
    half, p = math.pi / 9, 0.32
    radius = p / (2 * math.sin(half))
    x = np.linspace(-0.5, 0.5, 20001)
    u = radius * np.sin(2 * half * x) - p * x
    other = radius * np.sin(2 * half * (x - np.round(x - 0.5) - 0.5)) - p * (x - np.round(x - 0.5) - 0.5)
    expected = 206e9 * 1.6e-3 / 80 * np.max(np.abs(u - other))
    assert found.value == pytest.approx(expected, rel=0.02)
