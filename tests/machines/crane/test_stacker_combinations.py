"""Tables 11.1 and 11.2: every dynamic load is that of a run, and moves with its event alone."""

import json
from functools import cache
from typing import Any

import pytest
import yaml
from support.command import ROOT
from support.machines import changed, report_of

from ptmcalc.contract.effect import EffectState
from ptmcalc.contract.report import Amount, FileReport, TableReport
from ptmcalc.machines.crane.stacking.strength import combinations
from ptmcalc.machines.crane.stacking.strength.derived import MARKED_BY, UNMARKED
from ptmcalc.report import Format, render

OVERHEAD, RACK = "crane_overhead_stacker", "crane_rack_stacker"


@cache
def _file(name: str) -> str:
    return (ROOT / "specs" / f"{name}.yaml").read_text("utf-8")


def _data(name: str) -> dict[str, Any]:
    data = yaml.safe_load(_file(name))
    assert isinstance(data, dict)
    return data


@cache
def _report(name: str) -> FileReport:
    return report_of(_data(name), ends=False)


def _rows(table: TableReport) -> list[dict[str, Any]]:
    return [dict(zip((column.key for column in table.columns), row, strict=True)) for row in table.rows]


def _forces(report: FileReport) -> dict[str, float]:
    """The largest force of each combination: that of its first row."""
    found: dict[str, float] = {}
    for row in _rows(report.tables[1]):
        found.setdefault(row["combination"], row["force"].estimate.value)
    return found


@pytest.mark.parametrize("name", [OVERHEAD, RACK])
class TestTables:
    def test_every_combination_has_its_force_from_a_run_of_its_event(self, name: str) -> None:
        report = _report(name)
        scenes = {scene.name: scene for scene in report.scenes}
        rows = _rows(report.tables[1])
        assert len({row["combination"] for row in rows}) == 6
        for row in rows:
            scene = scenes[row["scene"]]
            marked = f"combination_force[{row['combination']}]"
            load = next(one for one in scene.loads if one.info.name == marked)
            assert isinstance(row["force"], Amount)
            assert row["force"].estimate == load.estimate
            assert row["solver"] == load.solver
            assert any(one.name == load.solver and one.decides for one in scene.solvers)

    def test_every_dynamic_load_traces_to_an_effect_of_the_ledger(self, name: str) -> None:
        report = _report(name)
        scenes = {scene.name: scene for scene in report.scenes}
        for row in _rows(report.tables[1]):
            states = {effect.name: effect.state for effect in scenes[row["scene"]].effects}
            named = {entry.removesuffix(" (bounded)") for entry in row["effects"]}
            assert all(states[name] is not EffectState.SKIPPED for name in named)
            if row["dynamic_load"].startswith("dynamic"):
                assert named

    def test_the_force_is_the_largest_of_the_scenes_of_its_event(self, name: str) -> None:
        report = _report(name)
        for combination, force in _forces(report).items():
            marked = f"combination_force[{combination}]"
            found = [load.estimate.value for scene in report.scenes for load in scene.loads if load.info.name == marked]
            assert force == max(found)

    def test_force_and_stresses_of_a_row_are_of_one_run(self, name: str) -> None:
        report = _report(name)
        scenes = {scene.name: {load.info.name: load.estimate for load in scene.loads} for scene in report.scenes}
        for row in _rows(report.tables[1]):
            loads = scenes[row["scene"]]
            assert row["force"].estimate == loads[f"combination_force[{row['combination']}]"]
            assert row["column_stress"].estimate == loads["column_stress"]

    def test_stresses_stand_beside_the_forces(self, name: str) -> None:
        for row in _rows(_report(name).tables[1]):
            assert isinstance(row["column_stress"], Amount)
            assert ("bridge_stress" in row) is (name == OVERHEAD)

    def test_json_has_both_tables_with_notes(self, name: str) -> None:
        document = json.loads(render(Format.JSON, (_report(name),), width=100, color=False))
        matrix, forces = document["files"][0]["tables"]
        assert [row["load"] for row in matrix["rows"]][:2] == ["weight of the crane", "weight of the lifted load"]
        for row in forces["rows"]:
            assert row["force"]["unit"] == "N"
            assert row["use"]
        assert matrix["notes"]
        assert forces["notes"]


def test_the_matrix_is_that_of_the_source() -> None:
    """One dynamic load on the diagonal; weights in all."""
    table = combinations.OVERHEAD
    taken = ["".join("+" if n in row.taken else "-" for n in range(1, 7)) for row in table.rows]
    assert taken == ["++++++", "++++++", "--+---", "---+--", "----+-"]
    table = combinations.RACK
    taken = ["".join("+" if n in row.taken else "-" for n in range(1, 7)) for row in table.rows]
    assert taken == ["++++++", "++++++", "-+----", "--+---", "---+--", "----+-", "-----+"]


@pytest.mark.parametrize(("word", "table"), sorted(combinations.TABLES.items()))
def test_every_combination_is_bound_to_the_event_it_takes(word: str, table: combinations.Combinations) -> None:
    """The data that mark loads and the tables agree."""
    bound = {number: scene for scene, (number, _) in MARKED_BY[word].items()}
    for number in range(1, 7):
        dynamic = [load for load in table.loads(number) if load.startswith("dynamic")]
        marked = f"{table.name},{number}"
        assert (marked in bound) is bool(dynamic)
        assert (marked in UNMARKED[word]) is not bool(dynamic)
        for load in dynamic:
            assert bound[marked] in combinations.EVENTS[load].split(" or ")


CHANGES = [
    (
        OVERHEAD,
        {"bridge_travel__braking_force": "4.9 kN", "trolley_travel__braking_force": "2.2 kN"},
        {"11.1,3", "11.1,4"},
    ),
    (OVERHEAD, {"scenes__10__speed_share": 0.55}, {"11.1,4"}),
    (OVERHEAD, {"hoisting__speed": "0.21 m/s"}, {"11.1,5"}),
    (RACK, {"travel__speed": "2.1 m/s"}, {"11.2,5"}),  # starts and stops swing the most before they are at that speed
    (RACK, {"rail__step": "0.6 mm"}, {"11.2,5"}),
    (RACK, {"travel__acceleration": "0.42 m/s^2"}, {"11.2,2"}),
    (RACK, {"fork__speed": "0.31 m/s"}, {"11.2,3"}),
    (RACK, {"hoisting__speed": "0.61 m/s"}, {"11.2,4"}),
    (RACK, {"safety_gear__force": "36 kN"}, {"11.2,6"}),
]


@pytest.mark.parametrize(("name", "changes", "moved"), CHANGES)
def test_a_change_of_an_event_changes_its_combinations(name: str, changes: dict[str, Any], moved: set[str]) -> None:
    before, after = _forces(_report(name)), _forces(report_of(changed(_data(name), **changes), ends=False))
    assert {number for number in before if before[number] != pytest.approx(after[number], rel=1e-9)} == moved


def test_a_combination_without_a_run_says_which_scene_is_missing() -> None:
    data = changed(_data(RACK), scenes=[{"type": "stand"}])
    rows = _rows(report_of(data, ends=False).tables[1])
    assert rows[0]["force"].estimate.value == pytest.approx((1000 + 2600 + 1900 + 550) * 9.81)
    assert [row["force"] for row in rows[1:]] == [""] * 5
    assert rows[2]["scene"] == "no scene `fork_push` was run"


@pytest.mark.parametrize("form", [Format.TABLE, Format.PLAIN])
def test_tables_are_printed(form: Format) -> None:
    out = render(form, (_report(OVERHEAD),), width=160, color=False)
    assert "11.1,3" in out
    assert "fork snagged in the rack while hoisting" in out
    assert "combinations 1, 2 and 6 have the same loads" in " ".join(out.split())
