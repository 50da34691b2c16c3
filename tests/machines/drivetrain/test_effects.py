"""Both effects of a drive train count: machines stand on both sides of their thresholds, and each changes a verdict."""

from typing import Any

import pytest
from support.drivetrains import spec_of
from support.machines import changed, check_of, load_of, report_of, scene_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.effect import EffectState
from ptmcalc.contract.report import EffectReport, FileReport
from ptmcalc.contract.result import family
from ptmcalc.engine.plan import plan_scene
from ptmcalc.engine.registry import load_kind
from ptmcalc.engine.run import settle
from ptmcalc.engine.widen import widen

KIND = load_kind("drivetrain")

# J1 = 1, J2 = 7 kg*m^2, C = 20 kN*m/rad: period 41.56 ms; the rigid link carries 105 of 120 N*m
JERK: dict[str, Any] = {
    "kind": "drivetrain",
    "inertias": {"motor": {"inertia": "1 kg*m^2"}, "wheel": {"inertia": "7 kg*m^2"}},
    "links": {"shaft": {"between": ["motor", "wheel"], "stiffness": "20 kN*m/rad", "limit": "150 N*m"}},
    "torques": {"drive": {"at": "motor", "type": "constant", "torque": "120 N*m"}},
    "scenes": [{"type": "run", "duration": "0.5 s"}],
}
RAMP = {"at": "motor", "type": "ramp", "torque": "120 N*m"}
GENTLE = changed(JERK, torques__drive=RAMP | {"time": "0.6 s"}, scenes=[{"type": "run", "duration": "0.7 s"}])
LOOSE = changed(JERK, links__shaft__gap="3.7012e-3 rad", links__shaft__limit="230 N*m")
TIGHT = changed(LOOSE, links__shaft__gap="3e-4 rad")


def effect_of(report: FileReport, name: str) -> EffectReport:
    return next(effect for effect in scene_of(report).effects if effect.name == name)


@pytest.mark.parametrize(
    ("effect", "below", "above", "threshold"),
    [("elasticity", GENTLE, JERK, 0.05), ("backlash", TIGHT, LOOSE, 0.1)],
    ids=["elasticity", "backlash"],
)
def test_machines_stand_on_both_sides_of_the_threshold(
    effect: str, below: dict[str, Any], above: dict[str, Any], threshold: float
) -> None:
    numbers = [effect_of(report_of(data), effect).criterion for data in (below, above)]
    assert numbers[0] is not None
    assert numbers[1] is not None
    assert numbers[0].value < threshold <= numbers[1].value
    assert numbers[0].threshold == numbers[1].threshold == threshold


def test_the_numbers_are_those_of_the_theory() -> None:
    jerk, loose = effect_of(report_of(JERK), "elasticity").criterion, effect_of(report_of(LOOSE), "backlash").criterion
    assert jerk is not None
    assert loose is not None
    assert jerk.value == pytest.approx(1.0), "a step swings as much as it carries"
    assert loose.value == pytest.approx(2 * 20e3 * 3.7012e-3 / 2 / 120 * 8 / 7)


@pytest.mark.parametrize(
    ("effect", "data"), [("elasticity", JERK), ("backlash", LOOSE)], ids=["elasticity", "backlash"]
)
def test_leaving_the_effect_out_turns_a_fail_into_a_pass(effect: str, data: dict[str, Any]) -> None:
    auto, off = report_of(data), report_of(changed(data, **{f"effects__{effect}": "off"}))
    assert effect_of(auto, effect).state is EffectState.SIMULATED
    assert check_of(scene_of(auto), "DRV101").verdict is Verdict.FAIL
    without = check_of(scene_of(off), "DRV101")
    assert without.verdict is Verdict.PASS
    assert effect in without.without, "a verdict without an effect says so"
    line = effect_of(off, effect)
    assert line.state is EffectState.SKIPPED
    assert line.forced
    assert "forced off" in line.note


@pytest.mark.parametrize(
    ("effect", "data"), [("elasticity", GENTLE), ("backlash", TIGHT)], ids=["elasticity", "backlash"]
)
def test_forced_on_below_its_threshold_it_stays_inside_the_bars(effect: str, data: dict[str, Any]) -> None:
    auto, forced = report_of(data), report_of(changed(data, **{f"effects__{effect}": "on"}))
    assert effect_of(forced, effect).state is EffectState.SIMULATED
    assert [j.verdict for j in scene_of(auto).checks] == [j.verdict for j in scene_of(forced).checks] == [Verdict.PASS]
    seen = 0
    for load in scene_of(auto).loads:
        if family(load.info.name) == "energy_residual":
            continue
        other = load_of(scene_of(forced), load.info.name).estimate
        slack = other.bar + 1e-9 * abs(load.estimate.value)
        assert load.estimate.low - slack <= other.value <= load.estimate.high + slack, load.info.name
        seen += 1
    assert seen >= 8


def test_a_gentle_ramp_is_decided_by_one_rigid_shaft() -> None:
    report = report_of(GENTLE)
    assert effect_of(report, "elasticity").state is EffectState.SKIPPED
    assert "elastic" not in [solver.name for solver in scene_of(report).solvers]
    peak = load_of(scene_of(report), "torque_peak[shaft]").estimate
    assert peak.low < 105 < peak.high
    assert peak.bar < 0.05 * 105


def test_a_little_play_is_bounded_by_the_closed_form() -> None:
    """105 (1 + (1 + Pi)^(1/2)): the run without play, widened, holds the one with it and settles the check alone."""
    spec = spec_of(TIGHT)
    plan = plan_scene(KIND, spec, spec.all_scenes[0])
    rung = next(rung for rung in plan.rungs if rung.carried == {"elasticity"})
    claims = widen(plan, spec, rung, rung.solver.run(spec, plan.scene, rung.carried, rung.level))
    number = 2 * 20e3 * 1.5e-4 / 120 * 8 / 7
    peak = claims["torque_peak[shaft]"]
    assert peak.low == pytest.approx(210)
    assert peak.high == pytest.approx(105 * (1 + (1 + number) ** 0.5))
    with_play = load_of(scene_of(report_of(TIGHT)), "torque_peak[shaft]").estimate
    assert peak.low < with_play.value <= peak.high
    torque = next(check for check in KIND.checks if check.code == "DRV101")
    settled = settle(KIND, spec, plan, only=torque)
    assert [run.rung.carried for run in settled.runs if run.rung.carried] == [{"elasticity"}]
    assert [ruling.verdict for ruling in settled.rulings] == [Verdict.PASS]
