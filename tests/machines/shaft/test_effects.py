"""Both effects of a main shaft count: machines stand on both sides of their thresholds, and each changes a verdict."""

import math
from typing import Any

import pytest
from support.machines import changed, check_of, load_of, report_of, scene_of
from support.shafts import C23, Reference, spec_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.effect import EffectState
from ptmcalc.contract.report import EffectReport, FileReport
from ptmcalc.engine.plan import plan_scene
from ptmcalc.engine.registry import load_kind
from ptmcalc.engine.run import settle
from ptmcalc.engine.widen import widen

KIND = load_kind("shaft")

SLACK = {"run_up_time": "60 s", "stop_angle": "300 rad", "stop_time": "60 s"}
HEAVY = changed(C23, inertia__mean="1200 kg*m^2", checks=C23["checks"] | SLACK)
EVEN = changed(HEAVY, inertia__terms__0__cosine="-0.05 kg*m^2")
STIFF: dict[str, Any] = {
    "kind": "shaft",
    "inertia": {"type": "constant", "value": "5 kg*m^2"},
    "drive": {
        "motor": {
            "type": "linear",
            "starting_torque": "1000 N*m",
            "no_load_speed": "10 rad/s",
            "rated_torque": "80 N*m",
            "largest_torque": "150 N*m",
        },
        "gear": {"ratio": 1, "efficiency": 1},
    },
    "load": {"type": "sectors", "sectors": [{"from": "0 rad", "to": "1.5707963267948966 rad", "torque": "240 N*m"}]},
    "scenes": [{"type": "steady"}],
}
"""A straight motor with hardly a flywheel: it follows the load, 240 N*m over a quarter."""


def effect_of(report: FileReport, scene: str, name: str) -> EffectReport:
    return next(effect for effect in scene_of(report, scene).effects if effect.name == name)


@pytest.fixture(scope="module")
def even() -> FileReport:
    return report_of(EVEN)


@pytest.fixture(scope="module")
def uneven() -> FileReport:
    return report_of(C23)


# --- thresholds ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("scene", "effect", "threshold"),
    [
        ("run_up", "varying_inertia", 0.05),
        ("steady", "varying_inertia", 0.05),
        ("run_out", "varying_inertia", 0.05),
        ("steady", "motor_slope", 1.0),
    ],
)
def test_machines_stand_on_both_sides_of_the_threshold(
    even: FileReport, uneven: FileReport, scene: str, effect: str, threshold: float
) -> None:
    below, above = (effect_of(report, scene, effect) for report in (even, uneven))
    assert below.criterion is not None
    assert above.criterion is not None
    assert below.criterion.threshold == above.criterion.threshold == threshold
    assert below.criterion.value < threshold <= above.criterion.value
    assert (below.state, above.state) == (EffectState.SKIPPED, EffectState.SIMULATED)


def test_the_numbers_are_those_of_the_theory(uneven: FileReport) -> None:
    """q = max J' w^2/(2 M) with J' = 8 kg*m^2, and h = t k/J."""
    up, steady, out = (effect_of(uneven, name, "varying_inertia").criterion for name in ("run_up", "steady", "run_out"))
    slope = effect_of(uneven, "steady", "motor_slope").criterion
    assert up is not None
    assert steady is not None
    assert out is not None
    assert slope is not None
    reference = Reference(C23)
    mean = 900 / 4 + 35
    carrying = 12 * 0.94
    low, high = 0.9 * 50 * math.pi / 12, 50 * math.pi / 12
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if carrying * reference.motor(12 * middle) > mean else (low, middle)
    assert steady.value == pytest.approx(8 * low**2 / 2 / mean, rel=1e-3)
    assert out.value == pytest.approx(8 * low**2 / 2 / 335, rel=1e-3)
    speeds = [0.95 * 50 * math.pi / 12 * (k + 0.5) / 400 for k in range(400)]
    driving = sum(carrying * reference.motor(12 * w) for w in speeds) / 400
    assert up.value == pytest.approx(8 * (0.95 * 50 * math.pi / 12) ** 2 / 2 / driving, rel=5e-3)
    fall = carrying * (reference.motor(12 * low * 0.999) - reference.motor(12 * low * 1.001)) / (0.002 * low)
    assert slope.value == pytest.approx(2 * math.pi / low * fall / 34, rel=1e-3)


def test_an_inertia_that_does_not_change_has_no_number() -> None:
    criterion = effect_of(report_of(STIFF), "steady", "varying_inertia").criterion
    assert criterion is not None
    assert criterion.value == 0


def test_a_motor_that_stalls_has_an_infinite_one() -> None:
    data = changed(STIFF, load__sectors__0__torque="8000 N*m")
    criterion = effect_of(report_of(data), "steady", "motor_slope").criterion
    assert criterion is not None
    assert math.isinf(criterion.value)


# --- below it: left out, and inside the bars -------------------------------------------------------------------------


def test_forced_on_below_their_thresholds_they_stay_inside_the_bars(even: FileReport) -> None:
    forced = report_of(changed(EVEN, effects={"varying_inertia": "on", "motor_slope": "on"}))
    seen = moved = 0
    for scene in even.scenes:
        other = scene_of(forced, scene.name)
        assert {effect.state for effect in other.effects} == {EffectState.SIMULATED}
        assert [j.verdict for j in scene.checks] == [j.verdict for j in other.checks]
        assert {j.verdict for j in scene.checks} == {Verdict.PASS}
        for load in scene.loads:
            exact = load_of(other, load.info.name).estimate
            slack = exact.bar + 1e-9 * abs(load.estimate.value)
            assert load.estimate.bounded
            assert load.estimate.low - slack <= exact.value <= load.estimate.high + slack, load.info.name
            seen += 1
            moved += abs(exact.value - load.estimate.value) > 1e-6 * abs(exact.value)
    assert seen >= 20
    assert moved >= 6, "the effects do move the loads, by less than the bars"


def test_an_even_shaft_with_a_flywheel_is_decided_by_closed_forms(even: FileReport) -> None:
    deciding = {solver.name for scene in even.scenes for solver in scene.solvers if solver.decides}
    assert deciding.isdisjoint({"tachogram_up", "tachogram_out", "closed_cycle", "closed_mean_cycle"})
    reference = Reference(EVEN)
    cycle = reference.cycle()
    for name in ("speed_mean", "speed_max", "speed_min", "irregularity", "torque_motor_rms"):
        estimate = load_of(scene_of(even, "steady"), name).estimate
        assert estimate.low <= cycle[name] <= estimate.high, name
    time, angle = reference.run_up(0.0, 0.95 * 50 * math.pi / 12)
    for name, exact in (("run_up_time", time), ("run_up_angle", angle)):
        estimate = load_of(scene_of(even, "run_up"), name).estimate
        assert estimate.low <= exact <= estimate.high, name


@pytest.mark.parametrize(
    ("scene", "rung", "loads"),
    [
        ("run_up", "speed_quadrature", ("run_up_time", "run_up_angle")),
        ("run_out", "stop_formula", ("run_out_time",)),
        ("steady", "work_balance", ("irregularity", "speed_max", "speed_min", "torque_motor_rms", "torque_motor_max")),
    ],
)
def test_the_cheapest_rung_alone_holds_the_truth(
    even: FileReport, scene: str, rung: str, loads: tuple[str, ...]
) -> None:
    spec = spec_of(EVEN)
    plan = plan_scene(KIND, spec, next(one for one in spec.all_scenes if one.label == scene))
    cheap = next(one for one in plan.rungs if one.solver.name == rung)
    claims = widen(plan, spec, cheap, cheap.solver.run(spec, plan.scene, cheap.carried, cheap.level))
    exact = scene_of(report_of(changed(EVEN, effects={"varying_inertia": "on", "motor_slope": "on"})), scene)
    for name in loads:
        truth = load_of(exact, name).estimate.value
        assert claims[name].bounded
        assert claims[name].bar > 1e-6 * abs(truth), name
        assert claims[name].low <= truth <= claims[name].high, name


# --- above it: simulated, and another verdict ------------------------------------------------------------------------

# (effect, machine, scene, check, verdict, verdict without the effect)
CHANGED_VERDICTS = [
    ("varying_inertia", changed(C23, checks__run_up_time="0.87 s"), "run_up", "SHF103", "fail", "pass"),
    ("varying_inertia", changed(C23, checks__irregularity=0.0995), "steady", "SHF102", "pass", "fail"),
    ("varying_inertia", C23, "steady", "SHF107", "pass", "fail"),
    ("varying_inertia", changed(C23, checks__stop_time="1.165 s"), "run_out", "SHF106", "pass", "fail"),
    ("motor_slope", changed(C23, checks__irregularity=0.15), "steady", "SHF102", "pass", "fail"),
    ("motor_slope", STIFF, "steady", "SHF104", "fail", "pass"),
    ("motor_slope", STIFF, "steady", "SHF107", "fail", "pass"),
]


def test_every_effect_is_shown_to_change_a_verdict() -> None:
    assert {effect for effect, *_ in CHANGED_VERDICTS} == {effect.name for effect in KIND.effects}
    assert {"pass", "fail"} == {verdict for *_, verdict, _ in CHANGED_VERDICTS}


@pytest.mark.parametrize(
    ("effect", "data", "scene", "code", "verdict", "other"),
    CHANGED_VERDICTS,
    ids=[f"{effect}-{code}-{k}" for k, (effect, _, _, code, *_) in enumerate(CHANGED_VERDICTS)],
)
def test_leaving_the_effect_out_gives_another_verdict(
    effect: str, data: dict[str, Any], scene: str, code: str, verdict: str, other: str
) -> None:
    data = changed(data, scenes=[one for one in data["scenes"] if one["type"] == scene])
    auto, off = report_of(data), report_of(changed(data, **{f"effects__{effect}": "off"}))
    assert effect_of(auto, scene, effect).state is EffectState.SIMULATED
    assert check_of(scene_of(auto), code).verdict == verdict
    without = check_of(scene_of(off), code)
    assert without.verdict == other
    assert effect in without.without, "a verdict without an effect says so"
    line = effect_of(off, scene, effect)
    assert line.state is EffectState.SKIPPED
    assert line.forced
    assert "forced off" in line.note


def test_the_verdict_with_the_effect_is_that_of_an_integration_of_its_own() -> None:
    reference = Reference(C23)
    assert reference.run_up(0.0, 0.95 * 50 * math.pi / 12)[0] > 0.87
    cycle = reference.cycle()
    assert cycle["irregularity"] < 0.0995
    assert reference.run_out(0.0, reference.speed_at(0.0, cycle["start"]))[0] < 1.165
    assert Reference(STIFF).cycle()["torque_motor_rms"] > 80


def test_one_check_alone_settles_without_the_effect_it_does_not_need() -> None:
    """The run-up of an even shaft is settled by its closed form, and no run in time is made."""
    spec = spec_of(EVEN)
    plan = plan_scene(KIND, spec, spec.all_scenes[0])
    settled = settle(KIND, spec, plan, only=next(check for check in KIND.checks if check.code == "SHF103"))
    assert [run.rung.solver.name for run in settled.runs] == ["speed_quadrature"]
    assert [ruling.verdict for ruling in settled.rulings] == [Verdict.PASS]
