"""Actions on the runway by EN 1991-3: the public example row by row, cases by hand, what a table says is missing, and
verdicts that turn."""

from pathlib import Path
from typing import Any

import pytest
import yaml
from support.command import ROOT
from support.machines import changed, check_of, load_of, report_of
from support.travelling import scene_report

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.report import Amount, SceneReport, TableReport
from ptmcalc.engine.check import Options, check_file

SPEC = ROOT / "specs" / "crane" / "bridge_crane_runway.yaml"
PAGE = Path(__file__).with_suffix("").parent / "travelling_runway.md"
EXAMPLE = {
    "runway_wheel_max": {"1": 73.4514944, "2": 68.3508, "4": 65.5613333, "5": 65.5613333},
    "runway_wheel_max_other": {"1": 27.5811722, "2": 27.2652, "4": 24.9986667, "5": 24.9986667},
    "runway_wheel_min_other": {
        "1": 30.6841333, "2": 30.6841333, "3": 27.8946667, "4": 27.8946667, "5": 27.8946667,
    },
    "runway_wheel_min": {"1": 24.9318667, "2": 24.9318667, "3": 22.6653333, "4": 22.6653333, "5": 22.6653333},
    "runway_drive_force": {"1": 9.97274667, "2": 9.97274667, "3": 9.06613333, "4": 9.06613333},
    "runway_longitudinal": {"1": 7.47956, "2": 7.47956, "3": 6.7996, "4": 6.7996},
    "runway_transverse_1": {"1": 4.17166517, "2": 4.17166517, "3": 3.7832618, "4": 3.7832618},
    "runway_transverse_2": {"1": 11.1095728, "2": 11.1095728, "3": 9.9219567, "4": 9.9219567},
    "runway_guide_force": {"light rail": 8.49572487},
    "runway_skew_across_1": {"light rail, 1": 2.34520532, "light rail, 2": 0.0},
    "runway_skew_across_2": {"light rail, 1": 6.15051955, "light rail, 2": 0.0},
    "runway_skew_net": {"light rail, 1": 6.15051955},
}  # fmt: skip
"""In kN: the open program crane_loads (github.com/pmav99/crane_loads), run as published; 80 kN, span 18 m."""
FATIGUE = {"runway_fatigue_normal": 27.7901516, "runway_fatigue_shear": 40.2502196}


def example(**changes: Any) -> dict[str, Any]:
    data = changed(yaml.safe_load(SPEC.read_text("utf-8")), **changes)
    assert isinstance(data, dict)
    return data | {"scenes": [{"type": "runway"}]}


def by_hand(number: int) -> dict[str, Any]:
    """A design file of the page."""
    data = yaml.safe_load(PAGE.read_text("utf-8").split("```yaml\n")[number].split("```")[0])
    assert isinstance(data, dict)
    return data


def kilonewtons(scene: SceneReport, name: str) -> float:
    return load_of(scene, name).estimate.value / 1000


@pytest.mark.parametrize("load", EXAMPLE)
def test_the_public_example_row_by_row(load: str) -> None:
    report = check_file(SPEC, Options(("runway",)))
    (scene,) = report.scenes
    for element, value in EXAMPLE[load].items():
        assert kilonewtons(scene, f"{load}[{element}]") == pytest.approx(value, rel=1e-6, abs=1e-9), element


def test_numbers_of_the_public_example_that_no_group_has() -> None:
    scene = scene_report(example())
    assert load_of(scene, "runway_skew_share").estimate.value == pytest.approx(0.0938132164, rel=1e-6)
    for name, value in FATIGUE.items():
        assert kilonewtons(scene, name) == pytest.approx(value, rel=1e-6)


def test_the_drive_force_of_characteristic_loads() -> None:
    scene = scene_report(example(runway__K_with_phi=False))
    assert kilonewtons(scene, "runway_drive_force[1]") == pytest.approx(9.06613333, rel=1e-6)
    assert kilonewtons(scene, "runway_longitudinal[1]") == pytest.approx(6.7996, rel=1e-6)
    assert kilonewtons(scene, "runway_transverse_1[1]") == pytest.approx(3.79242288, rel=1e-6)
    assert kilonewtons(scene, "runway_transverse_2[1]") == pytest.approx(10.0996116, rel=1e-6)


HANDS = {
    1: {
        "runway_wheel_max[1]": 161.2, "runway_wheel_max_other[1]": 66.8, "runway_wheel_max[2]": 146.8,
        "runway_wheel_min[3]": 52.0, "runway_wheel_min_other[3]": 68.0, "runway_longitudinal[1]": 15.6,
        "runway_transverse_1[4]": 5.3485714, "runway_transverse_2[4]": 12.48,
        "runway_guide_force[light rail]": 7.6879528, "runway_guide_force[loaded rail]": 17.938556,
        "runway_skew_across_1[light rail, 1]": 9.2255433, "runway_skew_across_1[light rail, 2]": -1.5375906,
        "runway_skew_across_2[light rail, 1]": 0.0, "runway_skew_along[light rail, 1]": 0.0,
        "runway_transverse_3[6]": 20.0, "runway_buffer[9]": 32.268405, "runway_buffer_trolley[9]": 20.0,
        "runway_wind[1]": 4.4, "runway_wind[3]": 3.2, "runway_wind[7]": 12.8,
        "runway_fatigue_normal": 94.878, "runway_fatigue_shear": 114.1548,
    },
    2: {
        "runway_drive_force[4]": 50.0, "runway_longitudinal[4]": 37.5, "runway_transverse_1[4]": 11.7,
        "runway_transverse_2[4]": 33.3, "runway_guide_force[light rail]": 39.767520,
        "runway_guide_force[loaded rail]": 39.767520, "runway_skew_along[light rail, 1]": 3.2922854,
        "runway_skew_across_1[light rail, 1]": 6.0595847, "runway_skew_across_1[light rail, 2]": 4.2799710,
        "runway_skew_across_2[light rail, 1]": 17.246510, "runway_skew_across_2[light rail, 2]": 12.181455,
        "runway_skew_net[light rail, 1]": 33.707935,
    },
}  # fmt: skip
"""In kN: the page, with more digits."""


@pytest.mark.parametrize(("case", "load"), [(case, load) for case, loads in HANDS.items() for load in loads])
def test_cases_by_hand(case: int, load: str) -> None:
    assert kilonewtons(scene_report(by_hand(case)), load) == pytest.approx(HANDS[case][load], rel=1e-6, abs=1e-9)


def test_forces_of_skewing_are_in_balance() -> None:
    """Their sum across is S, and the moments about the guide vanish."""
    for case, distances in ((1, (1.0, 6.0)), (2, (0.0, 4.0))):
        data = by_hand(case)
        scene, span = scene_report(data), float(str(data["bridge"]["span"]).split()[0])
        for rail in ("light rail", "loaded rail"):
            across, along = (
                [sum(kilonewtons(scene, f"{name}[{rail}, {k}]") for name in names) for k in (1, 2)]
                for names in (("runway_skew_across_1", "runway_skew_across_2"), ("runway_skew_along",))
            )
            assert sum(across) == pytest.approx(kilonewtons(scene, f"runway_guide_force[{rail}]"), rel=1e-12)
            moment = sum(force * place for force, place in zip(across, distances, strict=True))
            assert moment == pytest.approx(sum(along) * span, rel=1e-9, abs=1e-9)


# -- the table --------------------------------------------------------------------------------------------------------


def table_of(data: dict[str, Any], name: str = "runway") -> TableReport:
    return next(one for one in report_of(data).tables if one.name == name)


def test_the_table_has_every_group_and_says_its_edition() -> None:
    for name in ("runway", "runway forces", "runway skewing", "runway fatigue"):
        assert "EN 1991-3:2006" in table_of(example(), name).title
    table, forces = table_of(example()), table_of(example(), "runway forces")
    assert [row[0] for row in table.rows] == ["1", "2", "3", "4", "5", "6", "7", "8 dynamic", "8 static", "9", "10"]
    assert [row[0] for row in forces.rows] == ["1", "2", "3", "4", "5", "6", "8 dynamic", "9"]
    place = [column.heading for column in forces.columns].index("H_T,2")
    first = forces.rows[0][place]
    assert isinstance(first, Amount)
    assert first.estimate.value == pytest.approx(11109.5728, rel=1e-6)
    assert forces.rows[4][place] == "-"
    for one in (table, forces):
        assert any("to be compared with EN 1991-3:2006" in note for note in one.notes)


@pytest.mark.parametrize(
    ("changes", "note"),
    [
        ({"class": None}, "group 1 needs `class.hoisting`"),
        ({"class": None}, "H_T of group 2 needs `class.hoisting`"),
        ({"runway__skew_angle": None}, "S and H_S need `guide` or `skew_angle`"),
        ({}, "H_B,1 needs `buffers`"),
        ({"buffers": {"type": "linear", "stiffness": "1 kN/m", "stroke": "10 mm"}}, "bottom out"),
        ({}, "F_W needs `wind`"),
        ({"wind": {"area": "10 m^2", "pressure": "100 Pa"}}, "F_W out of service needs `wind.pressure_storm`"),
        ({"runway__suspension": "guided"}, "H_TA of a guided load are not computed"),
        ({"wheels__driven": ["A1", "A2"]}, "equal numbers of driven wheels"),
    ],
)
def test_what_is_missing_is_said(changes: dict[str, Any], note: str) -> None:
    data = example(**changes)
    notes = [*table_of(data).notes, *table_of(data, "runway forces").notes]
    assert any(note in one and one.startswith("missing: ") for one in notes), notes


def test_loads_without_data_are_missing_and_not_zero() -> None:
    table = table_of(example(**{"class": None}))
    assert table.rows[0][1] == "missing"
    scene = scene_report(example(**{"class": None}))
    assert "runway_wheel_max[1]" not in {load.info.name for load in scene.loads}
    assert "runway_wheel_max[4]" in {load.info.name for load in scene.loads}


def test_groups_to_be_compared_say_so() -> None:
    scene = scene_report(example())
    assert "to be compared" in load_of(scene, "runway_transverse_3[6]").note
    assert load_of(scene, "runway_wheel_max[1]").note == ""


def test_the_skewing_force_at_both_ends_of_an_assumed_wear() -> None:
    data = changed(by_hand(2), guide__wear=None)
    assert any(one.path == ("guide", "wear") for one in report_of(data).assumed)
    (note,) = (one for one in table_of(data, "runway skewing").notes if "interval of an assumed wear" in one)
    ends = [
        kilonewtons(scene_report(changed(by_hand(2), guide__wear=wear)), "runway_guide_force[light rail]")
        for wear in ("4.5 mm", "10 mm")
    ]
    assert f"S is {ends[0]:.4g} to {ends[1]:.4g} kN" in note


def test_a_rail_step_gives_phi4_of_its_own_topic() -> None:
    data = by_hand(2) | {"rail": {"adhesion": 0.14, "step": "1 mm", "frequency": "8 Hz"}}
    phi4 = load_of(scene_report(data | {"scenes": [{"type": "rail_step"}]}), "phi4").estimate.value
    scene = scene_report(data)
    assert phi4 > 1.01
    assert kilonewtons(scene, "runway_wheel_max[4]") == pytest.approx(74 * phi4, rel=1e-9)


def test_a_single_buffer_stops_the_whole_crane() -> None:
    data = by_hand(1)
    scene = scene_report(changed(data, buffers__count=1, buffers__stiffness="300 kN/m"))
    assert kilonewtons(scene, "runway_buffer[9]") == pytest.approx(1.25 * 0.7 * (24e3 * 3e5) ** 0.5 / 1000, rel=1e-9)


# -- verdicts that turn -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("clearance", "verdict"), [("68.0 mm", Verdict.PASS), ("68.1 mm", Verdict.FAIL)])
def test_the_skewing_angle_at_its_limit(clearance: str, verdict: Verdict) -> None:
    """0.75 * 68 mm + 5 mm are 0.014 * 4 m."""
    scene = scene_report(changed(by_hand(2), guide__clearance=clearance, guide__tolerance="0.001 rad"))
    assert check_of(scene, "CRN176").verdict is verdict


def test_an_assumed_wear_leaves_the_angle_undecided() -> None:
    """Without `wear` it is 4.5 to 10 mm: the limit of 0.015 rad lies between."""
    data = changed(by_hand(2), guide__clearance="64 mm", guide__wear=None)
    assert check_of(scene_report(data), "CRN176").verdict is Verdict.UNDECIDED


@pytest.mark.parametrize(("nearest", "verdict"), [("-2.99 m", Verdict.PASS), ("-3.00 m", Verdict.FAIL)])
def test_a_cantilever_lifts_the_other_rail(nearest: str, verdict: Verdict) -> None:
    """The static test, phi1 = 1.1 and 1.25: 44 = (1.1 * 20 + 1.25 * 100) x/10 at x = 2.993 m."""
    scene = scene_report(changed(by_hand(3), trolley__nearest=nearest))
    rest = 44 - 14.7 * float(nearest.removeprefix("-").removesuffix(" m"))
    assert kilonewtons(scene, "runway_wheel_least") == pytest.approx(rest / 2, rel=1e-9)
    assert check_of(scene, "CRN177").verdict is verdict


@pytest.mark.parametrize(
    ("changes", "key"),
    [
        ({}, "nearest"),
        ({"trolley__nearest": "1 m", "trolley__farthest": "15 m", "bridge__cantilever_b": "6 m"}, "farthest"),
    ],
)
def test_the_end_that_lifts_a_wheel_is_blamed(changes: dict[str, Any], key: str) -> None:
    judged = check_of(scene_report(changed(by_hand(3), **changes)), "CRN177")
    assert judged.verdict is Verdict.FAIL
    assert judged.blame.path == ("trolley", key)


@pytest.mark.parametrize(("wear", "key"), [("12 mm", "clearance"), ("70 mm", "wear")])
def test_what_lets_the_crane_skew_is_blamed(wear: str, key: str) -> None:
    judged = check_of(scene_report(changed(by_hand(3), guide__wear=wear)), "CRN176")
    assert judged.verdict is Verdict.FAIL
    assert judged.blame.path == ("guide", key)


def test_neither_a_guide_nor_an_angle() -> None:
    assert check_of(scene_report(example(runway__skew_angle=None)), "CRN176").verdict is Verdict.NOT_CHECKED
