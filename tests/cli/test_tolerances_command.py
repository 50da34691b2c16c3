"""`tolerances`: probabilities against an analytic case, what drives them, and faults of a block at their place."""

import csv
import json
import re
import shlex
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy import stats
from support.command import ROOT, Done, ptmcalc

from ptmcalc.contract.study import Points, Said
from ptmcalc.engine import tolerances as engine
from ptmcalc.engine.check import Options
from ptmcalc.engine.load import Loaded, load_text
from ptmcalc.engine.points import Study

TEXT = (Path(__file__).parent / "specs" / "passing.yaml").read_text("utf-8")
RUN = ("--scene", "run_loaded")
LINES = len(TEXT.splitlines())


@pytest.fixture(autouse=True)
def _beside(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def drawn(block: str, *options: str, form: str = "json", scene: tuple[str, ...] = RUN, text: str = TEXT) -> Done:
    Path("yard.yaml").write_text(f"{text}tolerances:\n{block}", encoding="utf-8")
    return ptmcalc("tolerances", "yard.yaml", *scene, "--format", form, *options)


def rows(done: Done) -> dict[str, Any]:
    assert done.status == 0, done.err
    return {row["code"]: row for row in json.loads(done.out)["rows"]}


def loaded(block: str) -> Loaded:
    return load_text(f"{TEXT}tolerances:\n{block}".encode(), "yard.yaml")


# -- an analytic case -----------------------------------------------------------------------------------------------


def slack_margin(tension: float) -> float:
    """Margin of CNV105 at a tension of the take-up, by `check`."""
    Path("one.yaml").write_text(TEXT.replace("tension: 30 kN", f"tension: {tension!r} N"), encoding="utf-8")
    found = json.loads(ptmcalc("check", "one.yaml", *RUN, "--format", "json").out)
    checks = found["files"][0]["scenes"][0]["checks"]
    return float(next(one["margin"] for one in checks if one["code"] == "CNV105"))


def test_a_linear_margin_of_a_normal_value_fails_as_often_as_the_normal_distribution_says() -> None:
    """The margin to slack rises with the tension of the take-up newton by newton: P = Phi(-m/sd), and its quantile is
    m - 1.645 sd. Intervals of twenty seeds hold both about as often as they say."""
    mean, sd = 6e3, 2.5e3
    margin = slack_margin(mean)
    assert slack_margin(mean + sd) - margin == pytest.approx(sd, rel=1e-9)
    truth, quantile = stats.norm.cdf(-margin / sd), margin + sd * stats.norm.ppf(0.05)
    assert 0.02 < truth < 0.3
    held = np.zeros(3, int)
    block = f"  takeup.tension: {{normal: {{mean: {mean} N, sd: {sd} N, min: 1 N}}}}\n"
    cut = stats.norm.cdf((1 - mean) / sd)  # of what `min` leaves
    truth, quantile = (truth - cut) / (1 - cut), margin + sd * stats.norm.ppf(cut + 0.05 * (1 - cut))
    for seed in range(20):
        row = rows(drawn(block, "--samples", "1000", "--seed", str(seed)))["CNV105"]
        share, left = row["fail"], row["margin"]
        assert row["samples"] == 1000
        assert share["value"] == share["hits"] / 1000 == pytest.approx(truth, abs=5 * np.sqrt(truth / 1000))
        assert left["value"] == pytest.approx(quantile, abs=0.35 * sd)
        held += (share["low"] <= truth <= share["high"], left["low"] <= quantile <= left["high"], share["hits"] > 0)
    assert held[2] == 20
    assert all(stats.binomtest(int(number), 20, 0.95, alternative="less").pvalue > 0.01 for number in held[:2])


@pytest.mark.parametrize(
    ("given", "low", "high"),
    [("{uniform: {min: 2 kN, max: 8 kN}}", 2e3, 8e3), ("{plus: 1 kN, minus: 28.5 kN}", 1.5e3, 31e3)],
)
def test_uniform_values_fail_by_the_part_of_their_range(given: str, low: float, high: float) -> None:
    limit = 6e3 - slack_margin(6e3)
    truth = (limit - low) / (high - low)
    share = rows(drawn(f"  takeup.tension: {given}\n", "--samples", "4000"))["CNV105"]["fail"]
    assert 0 < truth < 0.5
    assert share["low"] < truth < share["high"]
    assert share["high"] - share["low"] < 0.04


# -- what is drawn --------------------------------------------------------------------------------------------------

BLOCK = """  takeup.tension: {normal: {sd: 3 kN}}
  belt.mass: {plus: 1 kg/m, minus: 0.5 kg/m}
  drive.drum.friction: {uniform: {min: 0.25, max: 0.4}}
  scenes[1].profile.time: {normal: {sd: 1 s}}
"""


def test_values_are_drawn_from_their_distributions() -> None:
    points = engine.drawn(loaded(BLOCK), 20_000, 1)
    assert [key.name for key in points.keys] == [line.split(":")[0].strip() for line in BLOCK.splitlines()]
    for column, law in zip(
        points.values.T,
        (stats.norm(30e3, 3e3), stats.uniform(14.5, 1.5), stats.uniform(0.25, 0.15), stats.norm(12, 1)),
        strict=True,
    ):
        assert stats.kstest(column, law.cdf).pvalue > 1e-3
    assert np.abs(np.corrcoef(points.values.T) - np.eye(4)).max() < 0.03
    cut = engine.drawn(loaded("  takeup.tension: {normal: {sd: 3 kN, min: 29 kN, max: 34 kN}}\n"), 20_000, 1).values[
        :, 0
    ]
    assert stats.kstest(cut, stats.truncnorm(-1 / 3, 4 / 3, 30e3, 3e3).cdf).pvalue > 1e-3


def test_a_seed_gives_the_same_machines_whatever_other_keys_there_are() -> None:
    all_of_them = engine.drawn(loaded(BLOCK), 500, 7)
    one = engine.drawn(loaded(BLOCK.splitlines()[1] + "\n"), 500, 7)
    np.testing.assert_array_equal(all_of_them.values[:, 1], one.values[:, 0])
    assert not np.array_equal(engine.drawn(loaded(BLOCK), 500, 8).values, all_of_them.values)
    first, again = (drawn(BLOCK, "--samples", "500", "--seed", "7") for _ in range(2))
    assert first == again


def test_what_drives_a_margin_is_told_by_rank_and_only_where_it_is_more_than_chance() -> None:
    points = engine.drawn(loaded(BLOCK), 3000, 2)
    study = Study(loaded(BLOCK), points, Options(("run_loaded",)))
    study.run_by_lanes()
    for risk in engine.risks(points, 0.95):
        for driver in risk.drivers:
            column = points.values[:, list(points.keys).index(driver.key)]
            if np.ptp(risk.track.margin) > 0:
                assert driver.correlation == pytest.approx(stats.spearmanr(column, risk.track.margin)[0], abs=1e-12)
        clear = {driver.key.name for driver in risk.drivers if driver.clear}
        assert "scenes[1].profile.time" not in clear, "a start's time moves nothing of a run"
        if risk.track.code == "CNV101":
            assert [driver.key.name for driver in risk.drivers][:2] == ["drive.drum.friction", "takeup.tension"]
            assert clear >= {"drive.drum.friction", "takeup.tension"}


# -- what it says ---------------------------------------------------------------------------------------------------


def test_every_form_says_the_same() -> None:
    found = rows(drawn(BLOCK, "--samples", "1000"))
    lines = {row["code"]: row for row in csv.DictReader(StringIO(drawn(BLOCK, "--samples", "1000", form="csv").out))}
    table = drawn(BLOCK, "--samples", "1000", form="table").out
    assert set(found) == set(lines) == {"CNV101", "CNV102", "CNV103", "CNV105"}
    for code, row in found.items():
        assert code in table
        assert float(lines[code]["fail_high"]) == row["fail"]["high"]
        assert float(lines[code]["margin"]) == row["margin"]["value"]
    assert "yard.yaml: 1000 machines, seed 0" in table
    assert "yard.yaml:25  takeup.tension: 29.87 kN mean, 95 % from " in table


def test_undecided_machines_count_as_neither_and_widen_the_upper_end() -> None:
    text = TEXT.replace("coefficient: 0.022, ", "")  # assumed: 0.017 to 0.030
    row = rows_of(drawn("  takeup.tension: {normal: {mean: 20 kN, sd: 3 kN}}\n", "--samples", "400", text=text))[
        "CNV101"
    ]
    assert row["undecided"]["hits"] > 40
    assert row["fail"]["hits"] + row["undecided"]["hits"] < 400
    assert row["fail_or_undecided"]["hits"] == row["fail"]["hits"] + row["undecided"]["hits"]
    assert row["fail_or_undecided"]["high"] > row["fail"]["high"] + 0.1


def rows_of(done: Done) -> dict[str, Any]:
    assert done.status == 3
    return {row["code"]: row for row in json.loads(done.out)["rows"]}


def test_samples_that_need_a_run_of_their_own_are_as_many_as_the_budget_says() -> None:
    """A third of the work that is predicted for all computes a third of them, whatever a run costs."""
    little = drawn(BLOCK, "--samples", "40", "--budget", "1 ms", scene=())
    told = re.search(r"in start_empty: each is predicted to take ([0-9.e-]+) s, all ([0-9.e-]+) s", little.err)
    assert told is not None, little.err
    each, together = map(float, told.groups())
    assert together == pytest.approx(40 * each, rel=0.05)  # `each` has two digits
    done = drawn(BLOCK, "--samples", "40", "--budget", f"{together / 3} s", scene=())
    assert done.status == 3
    found = {(row["scene"], row["code"]): row for row in json.loads(done.out)["rows"]}
    assert found["run_loaded", "CNV101"]["samples"] == 40
    some = found["start_empty", "CNV101"]
    assert 12 <= some["samples"] <= 14
    assert f"{some['samples']} of 40 open points are computed one by one in start_empty" in done.err
    assert some["fail"]["high"] - some["fail"]["low"] > found["run_loaded", "CNV101"]["fail"]["high"]


def test_without_a_computed_sample_nothing_is_said() -> None:
    points = engine.drawn(loaded(BLOCK), 10, 1)
    study = Study(loaded(BLOCK), points, Options(("run_loaded",)))
    study.run_by_lanes()
    for track in points.tracks.values():
        track.said[:] = Said.NOT_COMPUTED
    for risk in engine.risks(Points(points.keys, points.values, points.tracks), 0.95):
        assert (risk.size, risk.fails.low, risk.fails.high) == (0, 0.0, 1.0)
        assert np.isnan(risk.fails.value)
        assert np.isnan(risk.margin)


# -- what is wrong --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("block", "place", "message"),
    [
        ("  takeup.tenson: {plus: 1 kN}\n", "1:3", "`takeup.tenson` is not a numerical key of this file; did you mean"),
        ("  takeup.type: {plus: 1 kN}\n", "1:3", "`takeup.type` is not a numerical key"),
        ("  takeup.tension: {plus: 1 m}\n", "1:26", "`tolerances.takeup.tension.plus`: `1 m` is a length, not a force"),
        ("  takeup.tension: {plus: 1}\n", "1:26", "`1` has no unit"),
        ("  takeup.tension: {plus: -1 kN}\n", "1:26", "out of range: it must be at least 0 N"),
        ("  takeup.tension: {normal: {sd: 0 kN}}\n", "1:33", "out of range: it must be greater than 0 N"),
        ("  takeup.tension: {normal: {sd: .nan}}\n", "1:33", "`.nan` is not a finite number"),
        ("  takeup.tension: {normal: {}}\n", "1:20", "`sd` is missing"),
        ("  takeup.tension: {normal: {sd: 1 kN, men: 2 kN}}\n", "1:39", "unknown key"),
        ("  takeup.tension: {normal: {sd: [1]}}\n", "1:33", "expected a value of the key, found a list"),
        ("  takeup.tension: {uniform: {min: 3 kN, max: 2 kN}}\n", "1:41", "the maximum is not above the minimum"),
        ("  takeup.tension: {normal: {sd: 1 kN}, plus: 1 kN}\n", "1:20", "give it or `plus`, not both"),
        ("  takeup.tension: {normal: {sd: 1 kN}, uniform: {min: 1 kN, max: 2 kN}}\n", "1:40", "not both"),
        ("  takeup.tension: {}\n", "1:3", "give `normal` or `uniform`"),
        ("  takeup.tension: {plus: 0 kN}\n", "1:3", "a tolerance of plus and minus zero has no effect"),
        ("  takeup.tension: 1 kN\n", "1:19", "takes a mapping"),
        ("  takeup.tension: {plus: 1 kN}\n  takeup.tension: {plus: 2 kN}\n", "2:3", "is written twice"),
        ("  - takeup.tension\n", "1:3", "takes a mapping"),
    ],
)  # fmt: skip
def test_a_tolerance_that_is_none_is_a_finding_at_its_place(block: str, place: str, message: str) -> None:
    done = drawn(block)
    line, column = place.split(":")
    assert (done.status, done.out) == (2, "")
    assert message in done.err
    assert f"yard.yaml:{LINES + 1 + int(line)}:{column}:" in done.err


def test_all_faults_are_told_at_once_beside_those_of_the_machine() -> None:
    text = TEXT.replace("width: 1000 mm", "width: 1000")
    done = drawn("  belt.width: {plus: 1 kN}\n  takeup.tension: {plus: 1}\n  speeed: {plus: 1 m/s}\n", text=text)
    assert done.status == 2
    assert len(done.err.splitlines()) == 5


MANY = "".join(
    f"  {key}: {{normal: {{sd: 1e-9 {unit}}}}}\n"
    for key, unit in (
        *(("route.length", "m"), ("route.lift", "m"), ("belt.width", "m"), ("belt.mass", "kg/m"), ("speed", "m/s")),
        *(("belt.stiffness", "N"), ("belt.strength", "N/mm"), ("idlers.carry.pitch", "m"), ("takeup.tension", "N")),
        *(("idlers.carry.set_mass", "kg"), ("idlers.return.pitch", "m"), ("idlers.return.set_mass", "kg")),
        *(("load.capacity", "kg/s"), ("resistance.coefficient", ""), ("resistance.secondary", "")),
        *(("drive.motor.inertia", "kg*m^2"), ("drive.motor.speed", "rpm"), ("drive.motor.mean_starting_torque", "N*m")),
        *(("drive.gear.ratio", ""), ("drive.gear.efficiency", ""), ("drive.drum.friction", "")),
    )
)


@pytest.mark.parametrize(
    ("block", "options", "reason"),
    [
        ("  {}\n", (), "has no `tolerances`"),
        ("  takeup.stroke: {plus: 1 m}\n", (), "the file has no value of it"),
        ("  takeup.tension: {normal: {sd: 20 kN}}\n", (), "some random machines have impossible values"),
        ("  takeup.tension: {minus: 40 kN}\n", (), "the value must be greater than 0 N"),
        ("  takeup.tension: {normal: {sd: 1 kN, min: 90 kN}}\n", (), "the probability between"),
        ("  takeup.tension: {plus: 1 kN}\n", ("--samples", "0"), "`--samples 0` is not a number of samples"),
        ("  takeup.tension: {plus: 1 kN}\n", ("--samples", "1000001"), "write one from 1 to 1000000"),
        (MANY, ("--samples", "1000000"), "`--samples 1000000` of 21 values are too many (write one from 1 to 952380"),
        ("".join(f"  belt.mass{n}: {{plus: 1 kg}}\n" for n in range(101)), (), "at most 100"),
        ("  takeup.tension: {plus: 1 kN}\n", ("--confidence", "100%"), "is not from 50 % to below 100 %"),
        ("  takeup.tension: {plus: 1 kN}\n", ("--confidence", "sure"), "--confidence:"),
        ("  takeup.tension: {plus: 1 kN}\n", ("--scene", "stop"), "unknown scene `stop`"),
    ],
)  # fmt: skip
def test_what_cannot_be_drawn_is_refused(block: str, options: tuple[str, ...], reason: str) -> None:
    done = drawn(block, *options)
    assert (done.status, done.out) == (2, "")
    assert reason in done.err
    assert "Traceback" not in done.err


def test_tolerances_change_nothing_of_a_check() -> None:
    plain, tolerant = TEXT, f"{TEXT}tolerances:\n{BLOCK}"
    found = []
    for text in (plain, tolerant):
        Path("yard.yaml").write_text(text, encoding="utf-8")
        found.append(ptmcalc("check", "yard.yaml", *RUN, "--format", "json"))
    assert found[0] == found[1]


def test_the_commands_and_the_block_of_the_documentation_are_true() -> None:
    text = (ROOT / "docs" / "studies.md").read_text("utf-8")
    ((command,), (block,)) = (re.findall(rf"```{form}\n(.*?)```", text, re.DOTALL) for form in ("sh", "yaml"))
    words = shlex.split(command)
    Path("specs").mkdir()
    Path("specs/conveyor.yaml").write_bytes((ROOT / "specs" / "conveyor.yaml").read_bytes())
    assert words[0] == "ptmcalc"
    assert ptmcalc(*words[1:]).status == 0
    with Path("specs/conveyor.yaml").open("a", encoding="utf-8") as file:
        file.write(block)
    done = ptmcalc("tolerances", "specs/conveyor.yaml", *RUN, "--samples", "1000", "--seed", "1", "--confidence", "95%")
    assert (done.status, done.err) == (0, "")
