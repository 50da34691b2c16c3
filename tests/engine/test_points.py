"""Many points at once: by lanes the numbers of files of their own, check by check, and where that cannot be, files."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from unittest import mock

import numpy as np
import pytest
from support.any_conveyor import any_conveyor
from support.command import ROOT

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.errors import UsageError
from ptmcalc.contract.study import Points, Said
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import Loaded, load_file, load_text
from ptmcalc.engine.points import Study, numbers_of, varied_key
from ptmcalc.engine.registry import kind_names, load_kind

SPEC = ROOT / "tests" / "cli" / "specs" / "passing.yaml"
SIZE = 12
SAID = {
    Verdict.PASS: Said.PASS,
    Verdict.FAIL: Said.FAIL,
    Verdict.UNDECIDED: Said.UNDECIDED,
    Verdict.NOT_CHECKED: Said.NOT_CHECKED,
}


def loaded_file(path: Path = SPEC) -> Loaded:
    return load_file(path, path.name)


def study(loaded: Loaded, columns: dict[str, Any], *scenes: str) -> Study:
    keys = [varied_key(loaded, name)[0] for name in columns]
    return Study(loaded, Points(keys, np.stack(list(columns.values()), axis=1)), Options(scenes))


def varied(loaded: Loaded, seed: int) -> dict[str, Any]:
    """Some keys of a machine, up to a third off."""
    chance, columns = np.random.default_rng(seed), dict[str, Any]()
    assert loaded.spec is not None
    for name in map(str, chance.permutation(numbers_of(loaded.spec))[:6]):
        key, measure = varied_key(loaded, name)
        values = (key.present or 0.0) * chance.uniform(0.7, 1.3, SIZE)
        if key.present and not any(measure.broken_by(value) for value in values):
            columns[name] = values
    return columns


def same_as_files(made: Study, scene: str, every: int = 1) -> int:
    """Holds verdict, value and limit of each check against those of a file of its own; how many it compared."""
    compared = 0
    for index in range(0, len(made.points), every):
        report = check(load_text(made.text_of(index), ""), Options((scene,), repairs=False))
        if not report.valid:
            assert all(track.said[index] == Said.NOT_COMPUTED for track in made.points.tracks.values())
        for _, one in report.judgements:
            track = made.points.tracks[scene, one.code, one.element]
            assert Said(track.said[index]) is SAID[one.verdict], (index, one.code)
            numbers = (one.value.value if one.value else np.nan, one.limit.value if one.limit else np.nan)
            assert (track.value[index], track.limit[index]) == pytest.approx(numbers, rel=1e-9, nan_ok=True)
            assert track.margin[index] == pytest.approx(one.margin if one.margin is not None else np.nan, nan_ok=True)
            compared += 1
        for load in (load for one in report.scenes for load in one.loads):
            if load.info.governing:
                mine = made.points.loads[scene, load.info.name]
                assert mine.value[index] == pytest.approx(load.estimate.value, rel=1e-9)
    return compared


def conveyors() -> Iterator[tuple[str, Loaded]]:
    for seed in range(300, 308):
        machine = any_conveyor(seed) | {"scenes": [{"type": "run"}, {"type": "run", "name": "empty", "load": "empty"}]}
        yield f"seed {seed}", load_text(json.dumps(machine).encode(), "any")
    for name in ("hollow_conveyor", "two_drive_conveyor", "steel_cord_strength"):
        yield name, loaded_file(ROOT / "specs" / "conveyor" / f"{name}.yaml")


@pytest.mark.parametrize(("name", "loaded"), list(conveyors()), ids=lambda one: one if isinstance(one, str) else "")
def test_lanes_are_files_of_their_own(name: str, loaded: Loaded) -> None:
    """Every check of random conveyors, and of some with hollows and several drives: a reference that knows no lanes."""
    assert loaded.spec is not None
    compared = 0
    for number, scene in enumerate(one.label for one in loaded.spec.all_scenes if one.type == "run"):
        made = study(loaded, varied(loaded, number), scene)
        with mock.patch("ptmcalc.engine.points._VERIFIED", 0):
            made.run_by_lanes()
        assert [note for note in made.points.notes if " points are no machines, the first since " not in note] == []
        assert made.by_lanes > SIZE / 2
        compared += same_as_files(made, scene, every=3)
    assert compared >= 8


def test_all_solvers_that_take_lanes_are_held_to_it_here() -> None:
    found = {
        (kind.name, solver.name)
        for name in kind_names()
        for kind in load_kind(name).manifests
        for solver in kind.solvers
        if solver.by_lanes
    }
    assert found == {("conveyor", "statics")}


def test_blocks_and_what_is_assumed(tmp_path: Path) -> None:
    """More points than a block; and values that the file leaves out, whose ends turn verdicts into undecided ones."""
    text = SPEC.read_text("utf-8").replace("{coefficient: 0.022, secondary: 1.4, start_factor: 1.2}", "{}")
    loaded = load_text(text.encode(), "assumed")
    assert [one.path[-1] for one in loaded.assumed] == ["coefficient", "secondary", "start_factor", "mass"]
    with mock.patch("ptmcalc.engine.points.BLOCK", 16):
        made = study(loaded, {"takeup.tension": np.linspace(4e3, 30e3, 40)}, "run_loaded")
        made.run_by_lanes()
    assert made.by_lanes == 40
    said = made.points.tracks["run_loaded", "CNV101", ""].said
    assert set(said.tolist()) == {Said.PASS, Said.FAIL, Said.UNDECIDED}
    same_as_files(made, "run_loaded", every=3)


def test_lanes_that_differ_from_files_do_not_count() -> None:
    """The guard of each study: a formula that says another thing to an array than to a number is found out."""
    from ptmcalc.laws import capstan

    right = capstan.slip_reserve_force

    def wrong(*given: Any) -> Any:
        return right(*given) * (1 if np.ndim(given[0]) == 0 else 1 + 1e-6)

    with mock.patch("ptmcalc.laws.capstan.slip_reserve_force", wrong):
        made = study(loaded_file(), {"takeup.tension": np.linspace(10e3, 30e3, 40)}, "run_loaded")
        made.run_by_lanes()
    assert made.by_lanes == 0
    assert made.points.tracks == {}
    (note,) = made.points.notes
    assert note.startswith("scene `run_loaded` is computed point by point: CNV101 of a file of its own comes to")
    assert [(labels, where.size) for labels, where in made.open_points()] == [(("run_loaded",), 40)]
    assert bool(np.all(made.points.missing))


def test_what_code_cannot_do_by_lanes_is_left_to_files() -> None:
    with mock.patch("ptmcalc.machines.conveyor.running.statics.number", float):
        made = study(loaded_file(), {"takeup.tension": np.linspace(10e3, 30e3, 4)}, "run_loaded")
        made.run_by_lanes()
    assert made.points.notes == ["scene `run_loaded` is computed point by point: LanesError: lanes have no float"]
    assert made.points.tracks == {}


def test_scenes_of_other_solvers_are_open() -> None:
    made = study(loaded_file(), {"takeup.tension": np.linspace(10e3, 30e3, 4)})
    made.run_by_lanes()
    ((labels, where),) = made.open_points()
    assert labels == ("start_empty",)
    assert where.tolist() == [0, 1, 2, 3]
    assert [Said(one) for one in made.points.worst()] == [Said.FAIL] * 2 + [Said.NOT_COMPUTED] * 2, (
        "half a pass is none"
    )
    made.take(2, check(load_text(made.text_of(2), ""), Options(labels, repairs=False)), labels)
    assert [Said(one) for one in made.points.worst()] == [Said.FAIL, Said.FAIL, Said.PASS, Said.NOT_COMPUTED]


def test_a_point_is_a_file_of_its_own() -> None:
    """With all that matters to its verdicts, to the last digit; blocks are made where there are none."""
    text = SPEC.read_text("utf-8") + "waive: [{check: CNV101, reason: soon, until: 2027-01-01}]\n"
    loaded = load_text(text.encode(), "file")
    made = study(loaded, {"takeup.tension": [1e4 / 3], "checks.sag": [0.1 + 0.2], "drive.drum.wrap": [2 / 3]})
    again = load_text(made.text_of(0), "point")
    assert again.spec is not None
    assert loaded.spec is not None
    changed = {("takeup", "tension"): 1e4 / 3, ("checks", "sag"): 0.1 + 0.2, ("drive", "drum", "wrap"): 2 / 3}
    assert {path: again.spec.value_at(path) for path in changed} == changed
    spec = loaded.spec
    for path, value in changed.items():
        spec = spec.with_value(path, value)
    left_out = {"waive": (), "name": "", "description": ""}
    weight = ("takeup", "mass")  # assumed of the tension, which varies
    assert again.spec.with_value(weight, None) == spec.model_copy(update=left_out).with_value(weight, None)


@pytest.mark.parametrize(
    ("name", "hint"),
    [
        ("takeup.tensoin", "did you mean `takeup.tension`?"),
        ("drum.friction", "did you mean `drive.drum.friction`?"),
        ("takeup", "`takeup."),
        ("takeup.type", "`takeup.tension`"),
        ("scenes[7].time", "`"),
        ("", "keys: "),
        ("[0]", "keys: "),
        ("....", "keys: "),
    ],
)
def test_a_key_that_is_none_of_a_number_is_refused(name: str, hint: str) -> None:
    with pytest.raises(UsageError) as error:
        varied_key(loaded_file(), name)
    assert "is not a numerical key of this file" in error.value.message
    assert hint.strip("`") in error.value.hint


def test_a_key_knows_its_place_and_its_value() -> None:
    key, measure = varied_key(loaded_file(), "drive.drum.wrap")
    assert (key.name, key.span.line, key.quantity.si) == ("drive.drum.wrap", 23, "rad")
    assert key.present == pytest.approx(np.radians(200))
    assert measure.above == 0
    assert varied_key(loaded_file(), "scenes[1].profile.time")[0].present == 12
    assert not key.whole
    count, _ = varied_key(loaded_file(), "drive.motor.count")
    assert (count.whole, count.quantity.si) == (True, "1")


def test_points_that_are_no_machines_are_left_out() -> None:
    """The belt cannot rise further than it is long: no key is out of its own range, two do not go together."""
    made = study(loaded_file(), {"route.lift": np.linspace(18, 300, 20), "route.length": np.linspace(240, 260, 20)})
    made.run_by_lanes()
    (note,) = made.points.notes
    fits = made.points.values[:, 0] < made.points.values[:, 1]
    assert 2 < np.count_nonzero(~fits) < 18
    assert note.startswith(
        f"{np.count_nonzero(~fits)} points are no machines, the first since `route.lift`: the lift is"
    )
    ((labels, where),) = made.open_points()
    assert labels == ("start_empty",)
    np.testing.assert_array_equal(where, np.flatnonzero(fits))
    track = made.points.tracks["run_loaded", "CNV101", ""]
    np.testing.assert_array_equal(track.said == Said.NOT_COMPUTED, ~fits)
    np.testing.assert_array_equal(made.points.worst()[~fits], Said.NOT_COMPUTED)
