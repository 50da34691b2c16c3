"""Proofs of rope and drum of a hoist: values that turn a verdict, bends counted by hand, bad values."""

import math
from pathlib import Path
from typing import Any

import pytest
import yaml
from support.machines import changed, check_of, load_of, report_of, scene_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.report import SceneReport
from ptmcalc.engine.load import load_text

SPEC = Path(__file__).parents[3] / "specs" / "hoist" / "rope_proofs.yaml"
HOIST: dict[str, Any] = yaml.safe_load(SPEC.read_text("utf-8"))
BLOCKS = ("rope_life", "rope_proof", "fleet", "drum__shell", "brake__holding")


def run_of(**changes: Any) -> SceneReport:
    return scene_of(report_of(changed(HOIST, **changes)))


@pytest.mark.parametrize(
    ("code", "change"),
    [
        ("HST150", {"reeving__sheave_diameter": "250 mm"}),
        ("HST151", {"reeving__sheave_diameter": "250 mm"}),
        ("HST152", {"rope_life__wire_breaks__count": 37}),
        ("HST153", {"rope_life__donandt_force": "33 kN"}),
        ("HST154", {"rope__breaking_force": "108 kN"}),
        ("HST154", {"rope_proof__load_factor": 1.9}),
        ("HST155", {"rope_proof__ropes": 1.5}),
        (
            "HST155",
            {"reeving__deflection_sheaves": 5, "rope_proof__reverse_sheaves": 5, "rope_proof__termination": "wedge"},
        ),
        ("HST156", {"fleet__lay": "lang"}),
        ("HST158", {"drum__shell__material": "S235"}),
        ("HST161", {"brake__torque": "170 N*m"}),
        ("HST161", {"brake__holding__brakes": 2}),
        ("HST161", {"brake__holding__torque_loss": 0.3}),
        ("HST158", {"drum__shell_thickness": "9 mm"}),
        ("HST156", {"rope__rotation_resistant": "yes"}),
        ("HST156", {"fleet__limit": "3.3 deg"}),
    ],
)
def test_a_value_turns_the_verdict(code: str, change: dict[str, Any]) -> None:
    assert check_of(run_of(), code).verdict is Verdict.PASS
    assert check_of(run_of(**change), code).verdict is Verdict.FAIL


@pytest.mark.parametrize("block", BLOCKS)
def test_without_a_block_nothing_changes(block: str) -> None:
    """The file has the checks and loads of a file without the block, and those of the block."""
    with_it, without = run_of(), run_of(**{block: None})
    known = {one.code: (one.verdict, one.value, one.limit) for one in with_it.checks}
    assert {one.code: (one.verdict, one.value, one.limit) for one in without.checks}.items() <= known.items()
    loads = {one.info.name: one.estimate for one in with_it.loads}
    assert {one.info.name: one.estimate for one in without.loads}.items() <= loads.items()


class TestBendsOfALift:
    """2 for a sheave, 1 for the drum, of the worst piece."""

    @pytest.mark.parametrize(
        ("change", "bendings"),
        [
            ({"reeving__falls": 4}, 3),  # two falls of each rope: one sheave, and the drum
            ({"reeving__falls": 8}, 7),  # three sheaves and the drum: falls of 13.1 m shorten to 1.1 m
            (
                {"reeving__falls": 8, "height": "1.5 m", "drum__length": "2 m"},
                5,
            ),  # 2.6 m to 1.1 m: two sheaves at 2.5 m
            ({"reeving__falls": 2, "reeving__ropes": 1, "reeving__lead_length": "40 m"}, 2),  # never on the drum
            ({"reeving__deflection_sheaves": 2, "reeving__lead_length": "3 m"}, 7),
            ({"reeving__falls": 2}, 1),  # the rope runs over no sheave
        ],
    )
    def test_count(self, change: dict[str, Any], bendings: int) -> None:
        assert load_of(run_of(**change), "rope_bendings").estimate.value == bendings


LAYERS = {"drum__length": "160 mm", "drum__layers": 3, "drum__flange_height": "80 mm", "reeving__lead_length": "6 m"}
"""Three layers of a drum that is too short for one, with a fixed sheave off its middle."""


@pytest.mark.parametrize(
    ("offset", "least", "verdict"), [("0 mm", 0.7639, Verdict.PASS), ("30 mm", 0.4775, Verdict.FAIL)]
)
def test_a_sheave_off_the_middle_does_not_draw_the_rope_back(offset: str, least: float, verdict: Verdict) -> None:
    """atan(80/6000) and atan(50/6000)."""
    scene = run_of(**LAYERS, reeving__lead_offset=offset)
    assert math.degrees(load_of(scene, "fleet_angle_least").estimate.value) == pytest.approx(least, abs=1e-4)
    assert check_of(scene, "HST157").verdict is verdict


def test_the_crossover_adds_half_a_pitch() -> None:
    """atan((80 + 9)/6000) = 0.8498 deg."""
    scene = run_of(**LAYERS, reeving__lead_offset="0 mm")
    assert math.degrees(load_of(scene, "fleet_angle_top").estimate.value) == pytest.approx(0.8498, abs=1e-4)


THICK = {"drum__shell_thickness": "20 mm", "drum__shell__flange_thickness": "30 mm"}


@pytest.mark.parametrize(
    ("code", "change"),
    [
        ("HST159", {"drum__shell_thickness": "1 mm", "rope__modulus": "130 GPa", "rope__area": "150 mm^2"}),
        ("HST160", {"drum__shell__flange_thickness": "8 mm"}),
    ],
)
def test_a_value_turns_the_verdict_of_a_drum_with_layers(code: str, change: dict[str, Any]) -> None:
    assert check_of(run_of(**LAYERS, **THICK), code).verdict is Verdict.PASS
    assert check_of(run_of(**LAYERS, **(THICK | change)), code).verdict is Verdict.FAIL


def test_layers_by_a_rule_are_not_those_of_elastic_layers() -> None:
    """DNV: 1.75 for two layers, and no value for three; a factor of the file overrides both."""
    two = LAYERS | THICK | {"drum__length": "230 mm"}
    assert load_of(run_of(**two, drum__shell__layers="dnv"), "shell_layer_factor").estimate.value == 1.75
    assert 1.75 < load_of(run_of(**two), "shell_layer_factor").estimate.value < 2
    three = run_of(**LAYERS, **THICK, drum__shell__layers="dnv")
    assert check_of(three, "HST158").verdict is Verdict.NOT_CHECKED
    given = run_of(**LAYERS, **THICK, checks__layer_factor=2.2)
    assert load_of(given, "shell_layer_factor").estimate.value == 2.2


@pytest.mark.parametrize(
    ("rule", "brakes", "control", "limit"),
    [
        ("cmaa_70", 1, "other", 1.25),
        ("cmaa_70", 1, "mechanical", 1.0),
        ("osha_1910_179", 2, "other", 1.0),
        ("fem_1_001", 1, "other", 1.6),
        ("en_14492_2", 2, "other", 1.25),
    ],
)
def test_factors_of_the_rules(rule: str, brakes: int, control: str, limit: float) -> None:
    holding = {"rule": rule, "edition": "of a test", "brakes": brakes, "control_braking": control}
    found = check_of(run_of(brake__holding=holding), "HST161")
    assert found.limit is not None
    assert found.limit.value == limit


def test_the_rules_refer_to_different_torques() -> None:
    """Hoisting over holding torque is 1/(eta eta_r) of gear and reeving: the ratio of the reserves."""
    ratios = {
        which: load_of(run_of(brake__holding__load_torque=which), "holding_torque_ratio").estimate.value
        for which in ("hoisting", "without_losses", "holding")
    }
    assert ratios["hoisting"] < ratios["without_losses"] < ratios["holding"]
    assert ratios["holding"] == pytest.approx(load_of(run_of(), "brake_reserve_static").estimate.value)


def test_the_report_names_the_edition_and_the_factors_that_are_not_given() -> None:
    scene = run_of(rope_proof__factors={"strength": 0.95})
    assert "EN 13001-3-2:2014" in load_of(scene, "rope_static_utilisation").note
    assert "f_f1, f_f3, f_f4, f_f5, f_f6, f_f7 not given: 1" in load_of(scene, "rope_fatigue_utilisation").note
    assert "not the attainable one" in load_of(scene, "rope_design_lifts").note
    assert "placeholders" in load_of(scene, "rope_lifts_discard").note


def test_the_design_lifts_are_those_of_the_full_utilisation() -> None:
    """With as many cycles as design lifts of its ropes, the fatigue strength is just used up."""
    lifts = load_of(run_of(), "rope_design_lifts").estimate.value
    full = run_of(rope_proof__cycles=8 * lifts)
    assert load_of(full, "rope_fatigue_utilisation").estimate.value == pytest.approx(1.0, rel=1e-12)


def refused(**changes: Any) -> str:
    result = load_text(yaml.safe_dump(changed(HOIST, **changes)).encode(), "case.yaml")
    found = [one for one in result.diagnostics if one.severity.rank == 2]
    assert len(found) == 1
    return found[0].message + found[0].hint


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"rope_life__strands": None}, "add `strands: 6`"),
        ({"rope_life__core": None, "rope_life__strands": None}, "core"),
        ({"rope_life__core_factor": 1}, "not both"),
        ({"rope_life__reverse_sheaves": 1}, "reversal"),
        ({"rope_life__source": None}, "source"),
        ({"rope_life__force_factor": 0.9}, "at least 1"),
        ({"rope_proof__termination": None}, "termination"),
        ({"rope_proof__edition": "EN 13001-3-2:2004"}, "EN 13001-3-2:2014"),
        ({"rope_proof__ropes": 0.5}, "at least 1"),
        ({"drum__shell__yield_strength": "235 MPa"}, "not both"),
        ({"drum__shell__material": None}, "material"),
        ({"drum__shell_thickness": "95 mm"}, "thin shell"),
        ({"drum__shell__flange_thickness": "110 mm"}, "yield_strength"),
        ({"drum__shell__flange_pressure": 2}, "at most 1"),
        ({"brake__holding__edition": None}, "edition"),
        ({"brake__holding__rule": "fem"}, "fem_1_001"),
        ({"brake__holding__torque_loss": 1}, "90 %"),
        ({"fleet__edition": None}, "edition"),
        ({"fleet__limit": "0 deg"}, "greater than 0"),
        ({"rope__diameter": "2 mm", "drum__pitch": None}, "3 mm"),
    ],
)
def test_bad_values_are_refused_with_one_message(changes: dict[str, Any], said: str) -> None:
    assert said in refused(**changes)
