"""The bars of every setting of a machine of each kind, against another method: none misses, and the sentence agrees."""

from functools import cache

import pytest
from support.command import ROOT

from ptmcalc.contract.cost import CostReport, Held, Outcome, Role
from ptmcalc.engine.cost import MARGINS, cost
from ptmcalc.engine.load import load_file
from ptmcalc.engine.registry import kind_names, load_kind
from ptmcalc.report.cost import conclusion, seconds

SPECS = {
    "specs/conveyor.yaml": 1.5,
    "specs/chain_drive.yaml": 2.0,
    "specs/hoist.yaml": 2.0,
    "specs/crane_slewing.yaml": 2.0,
    "specs/crane_travelling.yaml": 2.0,
    "specs/crane_overhead_stacker.yaml": 3.0,
    "specs/crane_rack_stacker.yaml": 3.0,
    "specs/shaft.yaml": 2.0,
    "specs/drivetrain.yaml": 2.0,
}
"""A machine of each kind and type, and the predicted seconds that measuring it once may take."""
WHOLE = [
    pytest.param((path.relative_to(ROOT).as_posix(), 30.0), marks=pytest.mark.study, id=path.stem)
    for path in sorted((ROOT / "specs").rglob("*.yaml"))
]


@cache
def report(path: str, budget: float) -> CostReport:
    loaded = load_file(ROOT / path, path)
    assert loaded.kind is not None
    assert loaded.spec is not None
    return cost(path, loaded.kind, loaded.spec, budget=budget, most_runs=1)


@pytest.fixture(params=[*SPECS.items(), *WHOLE], ids=lambda one: one[0] if isinstance(one, tuple) else None)
def found(request: pytest.FixtureRequest) -> CostReport:
    return report(*request.param)


def test_there_is_a_machine_of_each_kind() -> None:
    labels = {one.label for name in kind_names() for one in load_kind(name).manifests}
    assert {report(*one).kind for one in SPECS.items()} == labels


def test_no_bar_misses_the_true_error(found: CostReport) -> None:
    held = [(one.name, load) for one in found.settings for load in one.loads if load.held is not None]
    assert [part for part in held if part[1].held is Held.NO] == []


def test_no_setting_is_held_against_its_own_method(found: CostReport) -> None:
    methods = {(one.scene, one.name): one.method for one in found.settings}
    for one in found.settings:
        for load in one.loads:
            assert not load.reference or methods[one.scene, load.reference] != one.method
            assert (load.error is None) == (load.reference == "")


def test_every_start_and_stop_of_a_travelling_crane_is_held_by_another_method() -> None:
    found = report("specs/crane_travelling.yaml", 2.0)
    tops = [one for one in found.settings if one.name.startswith("sway_simulated") and one.name.endswith("all")]
    tops += [one for one in found.settings if one.solver in ("buffer_collision", "rail_response", "skewing")]
    assert len(tops) == 2 * 5 + 3
    for one in tops:
        assert [load.name for load in one.loads if load.held is not Held.YES] == []


def test_no_setting_of_a_sound_machine_fails(found: CostReport) -> None:
    assert [(one.name, one.reason) for one in found.settings if one.outcome is Outcome.FAILED] == []


def test_what_is_chosen_proves_what_was_asked(found: CostReport) -> None:
    """By the rows of the table themselves, and no dearer than any one setting that does it alone."""
    for choice in found.choices:
        if choice.target == MARGINS or not choice.settings:
            continue
        rows = {one.name: one for one in found.of_scene(choice.scene) if one.role is Role.LADDER}
        chosen = [rows[name] for name in choice.settings]
        assert choice.seconds == pytest.approx(sum(one.seconds or 0.0 for one in chosen))
        best: dict[str, float] = {}
        for one in chosen:
            for load in one.loads:
                if load.bar is not None:
                    best[load.name] = min(best.get(load.name, load.bar), load.bar)
        wanted = {load.name for one in rows.values() for load in one.loads}
        assert set(best) == wanted
        assert max(best.values()) <= (choice.accuracy or 0.0)
        if len(chosen) > 1:
            continue
        for one in rows.values():
            bars = {load.name: load.bar for load in one.loads if load.bar is not None}
            if set(bars) == wanted and max(bars.values()) <= (choice.accuracy or 0.0):
                assert (one.seconds or 0.0) >= (choice.seconds or 0.0)


def test_the_sentence_agrees_with_the_table(found: CostReport) -> None:
    said = conclusion(found)
    for target in found.targets:
        choices = found.chosen(target)
        name = "is decided in" if target == MARGINS else f"{target} costs"
        price = seconds(sum(one.seconds or 0.0 for one in choices))
        assert (f"{name} {price}" in said) == all(one.reached for one in choices)
    count = [one.held for one in found.settings if one.held is not None]
    if count:
        assert f"{count.count(Held.YES)} of {len(count)} compared settings" in said
