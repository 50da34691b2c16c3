"""The short table: one screen of what governs. It may leave out what passes, never what does not, and it counts."""

import math
import random
import re
from collections import Counter
from collections.abc import Iterable
from dataclasses import replace
from itertools import takewhile

import pytest
from support.command import report_of_file
from support.samples import SAMPLES

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import Span
from ptmcalc.base.units import FORCE, LENGTH
from ptmcalc.contract.check import Sense
from ptmcalc.contract.report import FileReport, Judgement, LoadReport, Place, SceneReport
from ptmcalc.contract.result import LoadInfo
from ptmcalc.engine.registry import kind_names, load_kind
from ptmcalc.report import Format, pick, render, words

SPECS = ("specs/short_conveyor.yaml", "specs/drivetrain.yaml", "specs/shaft.yaml", "tests/cli/specs/slipping.yaml")
WIDE = 250
MARGIN = {Verdict.FAIL: -1.0, Verdict.UNDECIDED: 0.1, Verdict.WAIVED: -2.0, Verdict.PASS: 1.0}


def short(report: FileReport, width: int = WIDE) -> str:
    return render(Format.TABLE, [report], width=width)


def whole(report: FileReport) -> str:
    return render(Format.TABLE, [report], width=WIDE, verbose=True)


def section(text: str, heading: str) -> list[str]:
    """The lines of a section of the short table, its heading left out."""
    lines = text.splitlines()
    rest = lines[1 + next(index for index, line in enumerate(lines) if line.split("  ")[0] == heading) :]
    if heading in ("Loads", "Checks"):
        return rest[: rest.index("")]
    return list(takewhile(lambda line: line.startswith(" "), rest))


def judged(code: str, verdict: Verdict, margin: float, element: str = "", loads: Iterable[str] = ()) -> Judgement:
    value = None if verdict is Verdict.NOT_CHECKED else Estimate.exact(10 + margin)
    return Judgement(
        code=code,
        title=f"a fault of {code}",
        verdict=verdict,
        value=value,
        limit=Estimate.exact(10),
        sense=Sense.AT_LEAST,
        quantity=FORCE,
        margin=None if value is None else margin,
        blame=Place(("key",), Span(7, 3)),
        element=element,
        loads=tuple(loads),
    )


def load(name: str, value: float = 1.0, *, headline: bool = True, governing: bool = False) -> LoadReport:
    info = LoadInfo(name, f"title of {name}", FORCE, headline, governing)
    return LoadReport(info, Estimate.exact(value), "statics", "told so")


def scene(name: str, loads: Iterable[LoadReport] = (), checks: Iterable[Judgement] = ()) -> SceneReport:
    return SceneReport(name, "hang", (), (), tuple(loads), tuple(checks), {})


def file(*scenes: SceneReport) -> FileReport:
    return FileReport("toy.yaml", "toy", "Toy", scenes=scenes)


def crowd(seed: int) -> FileReport:
    """Many verdicts of every sort over scenes and parts, each of a load of its own."""
    dice = random.Random(seed)
    scenes = []
    for label in ("rest", "start", "stop"):
        checks, loads = [], []
        for code in ("TOY101", "TOY102", "TOY103"):
            for part in ("head", "tail", ""):
                verdict = dice.choice(list(Verdict))
                name = f"{label}_{code}_{part}"
                margin = MARGIN.get(verdict, 0.0) * dice.uniform(0.5, 2)
                checks.append(judged(code, verdict, margin, part, [name]))
                loads.append(load(name, headline=dice.random() < 0.5))
        scenes.append(scene(label, loads, checks))
    return file(*scenes)


# -- checks ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(20))
def test_nothing_that_is_not_passed_is_left_out(seed: int) -> None:
    report = crowd(seed)
    bad = [(s.name, j) for s, j in report.judgements if j.verdict is not Verdict.PASS]
    shown = pick.checks(report)
    told = {(where, *pick.as_read(row.judgement)): row for row in shown for where in row.scenes}
    assert all((where, *pick.as_read(judgement)) in told for where, judgement in bad)
    assert {name for _, judgement in bad for name in judgement.loads} <= pick.loads(report)
    text = short(report)
    unwrapped = text.replace("\n   ", " ")
    for where, judgement in bad:
        title = rf"{judgement.code} a fault of {judgement.code}" + (f": {judgement.element}" * bool(judgement.element))
        verdict = judgement.verdict.value.replace("_", " ")
        row = told[(where, *pick.as_read(judgement))]
        name = " ".join(filter(None, (judgement.code, judgement.element, row.scene)))
        assert re.search(rf"^{verdict} +{re.escape(title)} +{row.scene} ", text, re.MULTILINE)
        if row is shown[0]:
            assert re.match(
                rf"toy.*\n {verdict} {title}, {row.scenes[0]}: .*governing key: key \(toy.yaml:7:3\)", text
            ), "the worst stands above everything"
        else:
            told_once = r"governing key: key \(toy.yaml:7:3\)|key and cause as of"
            assert re.search(rf"^{verdict} (.+, )?{re.escape(name)}(, .+)?: ({told_once})", unwrapped, re.MULTILINE)
        assert f"title of {judgement.loads[0]} " in text


@pytest.mark.parametrize("seed", range(20))
def test_of_what_passes_the_closest_of_each_code_is_shown_and_the_rest_is_counted(seed: int) -> None:
    report = crowd(seed)
    passed = [j for _, j in report.judgements if j.verdict is Verdict.PASS]
    rows = {row.judgement.code: row for row in pick.checks(report) if row.judgement.verdict is Verdict.PASS}
    assert Counter({code: row.more + 1 for code, row in rows.items()}) == Counter(j.code for j in passed)
    for code, row in rows.items():
        assert row.judgement.margin == min(j.margin for j in passed if j.code == code and j.margin is not None)
    shown = sum(len(row.scenes) + row.more for row in pick.checks(report))
    assert shown == len(list(report.judgements))


def test_hazards_come_before_what_takes_long_but_not_where_all_is_well() -> None:
    """A slipping belt stands above a sag that misses its limit by more."""
    for verdict, first in ((Verdict.FAIL, "TOY102"), (Verdict.UNDECIDED, "TOY102"), (Verdict.PASS, "TOY101")):
        mild, grave = judged("TOY101", verdict, -6.0), replace(judged("TOY102", verdict, -1.0), hazard=True)
        assert pick.checks(file(scene("rest", checks=[mild, grave])))[0].judgement.code == first


def test_a_cause_is_said_once_with_all_its_checks() -> None:
    slack, sag, long = (
        replace(judged(f"TOY10{k}", Verdict.FAIL, -1.0), reason=why)
        for k, why in ((1, "the belt slips"), (2, "the belt is loose"), (3, "the belt is loose"))
    )
    text = short(file(scene("rest", checks=[slack, sag]), scene("stop", checks=[slack, long])))
    assert text.count("the belt slips") == 1
    assert "fail TOY102 rest, TOY103 stop: governing key: key (toy.yaml:7:3); the belt is loose" in text


@pytest.mark.parametrize(("margin", "told"), [(math.inf, "unlimited"), (-math.inf, "none"), (-1.0, "-10.0 %")])
def test_a_fault_without_end_leaves_no_margin(margin: float, told: str) -> None:
    assert words.margin(judged("TOY101", Verdict.FAIL, margin)) == told


def test_a_verdict_that_reads_the_same_in_several_scenes_is_told_once() -> None:
    weak, weaker = (judged("TOY101", Verdict.FAIL, margin) for margin in (-1.0, -2.0))
    report = file(scene("rest", checks=[weak]), scene("start", checks=[weaker]), scene("stop", checks=[weak]))
    assert [(row.scene, row.judgement.margin) for row in pick.checks(report)] == [("start", -2.0), ("rest, stop", -1.0)]
    assert short(report).count("fail TOY101 rest, stop: key and cause as of TOY101 start") == 1
    assert [row.scene for row in pick.all_checks(report)] == ["start", "rest", "stop"]


def test_the_closest_margin_to_a_limit_of_nothing_is_the_smallest() -> None:
    """Relative to the value they are all alike."""
    slack = [replace(judged("TOY101", Verdict.PASS, left), limit=Estimate.exact(0.0)) for left in (9.0, 2.0, 5.0)]
    slack = [replace(one, value=Estimate.exact(one.margin or 0.0)) for one in slack]
    (row,) = pick.checks(file(scene("rest", checks=slack)))
    assert (row.judgement.margin, row.more) == (2.0, 2)


def test_what_is_not_passed_stands_first_of_all() -> None:
    """The loads are first where nothing has to be done."""
    bad, sound = short(SAMPLES["failing"]), short(SAMPLES["passing"])
    assert bad.index("governing key") < bad.index("\nChecks") < bad.index("\nLoads")
    assert sound.index("\nLoads") < sound.index("\nChecks")


def test_a_passed_check_tells_beside_it_what_it_rests_on_and_how_many_more_pass() -> None:
    assert section(short(SAMPLES["passing"]), "Checks")[1].split("   ")[-1].strip() == "without rain"
    assert section(short(SAMPLES["moving"]), "Checks")[1].split("   ")[-1].strip() == "+3 more"


# -- loads ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", kind_names())
def test_every_kind_says_which_of_its_headlines_govern(kind: str) -> None:
    governing = [info for info in load_kind(kind).loads if info.governing]
    assert 0 < len(governing) < sum(info.headline for info in load_kind(kind).loads)
    assert all(info.headline for info in governing)


def test_a_load_is_shown_that_the_kind_calls_governing_or_that_a_check_reads() -> None:
    loads = [load("governing", governing=True), load("read"), load("other"), load("quiet", headline=False)]
    report = file(scene("rest", loads, [judged("TOY101", Verdict.PASS, 1.0, loads=["read", "quiet"])]))
    assert pick.loads(report) == {"governing", "read"}
    assert pick.all_loads(report) == {"governing", "read", "other"}


@pytest.mark.parametrize("verdict", [verdict for verdict in Verdict if verdict is not Verdict.PASS])
def test_what_a_check_reads_that_is_not_passed_is_shown_whatever_it_is(verdict: Verdict) -> None:
    loads = [load("governing", governing=True), load("quiet", headline=False)]
    report = file(scene("rest", loads, [judged("TOY101", verdict, -1.0, loads=["quiet", "not_found"])]))
    assert pick.loads(report) == pick.all_loads(report) == {"governing", "quiet"}


def test_where_nothing_governs_all_headlines_are_shown() -> None:
    report = file(scene("rest", [load("one"), load("two"), load("quiet", headline=False)]))
    assert pick.loads(report) == {"one", "two"}


@pytest.mark.parametrize(
    ("whole_machine", "told"),
    [(1.0, {"grip"}), (3.0, {"grip"}), (2.0, {"grip", "grip[a]", "grip[b]", "grip[c]"})],
    ids=["smallest", "largest", "in between"],
)
def test_a_machine_stands_for_its_parts_as_far_as_it_tells_their_worst(whole_machine: float, told: set[str]) -> None:
    parts = [load(f"grip[{name}]", value, governing=True) for name, value in zip("abc", (1.0, 2.0, 3.0), strict=True)]
    report = file(scene("rest", [load("grip", whole_machine, governing=True), *parts]))
    assert pick.loads(report) == told


def test_a_part_is_shown_beside_its_machine_where_its_check_is_not_passed() -> None:
    loads = [load("grip", 1.0), load("grip[a]", 1.0), load("grip[b]", 2.0)]
    checks = [
        judged("TOY101", Verdict.UNDECIDED, -1.0, "a", ["grip[a]"]),
        judged("TOY101", Verdict.PASS, 1.0, "b", ["grip[b]"]),
    ]
    assert pick.loads(file(scene("rest", loads, checks))) == {"grip", "grip[a]"}


def test_a_part_is_shown_where_one_scene_tells_nothing_of_the_whole_machine() -> None:
    both = scene("rest", [load("heat", 1.0, governing=True), load("heat[a]", 1.0, governing=True)])
    alone = scene("start", [load("heat[a]", 1.0, governing=True)])
    assert pick.loads(file(both)) == {"heat"}
    assert pick.loads(file(both, alone)) == {"heat", "heat[a]"}


def test_a_scene_without_such_a_load_takes_no_column() -> None:
    report = file(scene("rest", [load("one", governing=True)]), scene("start", [load("two")]))
    assert "start" not in short(report)
    assert "start" in whole(report)


def test_a_load_stands_behind_the_one_it_follows_in_its_scene() -> None:
    """`dynamic part of it` says nothing elsewhere."""
    one = scene("rest", [load("pull"), load("safety"), load("power"), load("mass")])
    two = scene("start", [load("pull"), load("dynamic"), load("safety")])
    names = re.findall(r"title of (\w+)", short(file(one, two)))
    assert names == ["pull", "dynamic", "safety", "power", "mass"]


# -- the ledger -----------------------------------------------------------------------------------------------------


def test_every_effect_stands_with_its_state_and_the_number_that_decided() -> None:
    assert section(short(SAMPLES["passing"]), "Effects") == [
        " hang: simulated waves x = 3 ≥ 0.1, sag x = 0.15 ≥ 0.1; bounded frost x = 5 ≥ 0.1; skipped wind x = 0.01 <"
        " 0.1; switched off by the file rain x = 5 ≥ 0.1; not assessed (input missing) fog"
    ]


def test_an_effect_forced_on_says_so() -> None:
    (only,) = SAMPLES["passing"].scenes
    forced = tuple(replace(effect, forced=effect.name in ("waves", "frost")) for effect in only.effects)
    (line,) = section(short(replace(SAMPLES["passing"], scenes=(replace(only, effects=forced),))), "Effects")
    assert "simulated waves (forced) x = 3 ≥ 0.1, sag x" in line
    assert "bounded frost (forced) x = 5 ≥ 0.1;" in line


def test_scenes_with_the_same_ledger_stand_together() -> None:
    (only,) = SAMPLES["passing"].scenes
    other = replace(only, name="gust")
    calm = replace(only, name="calm", effects=only.effects[:1])
    lines = section(short(replace(SAMPLES["passing"], scenes=(only, other, calm))), "Effects")
    assert [line.split(": ")[0] for line in lines] == [" hang, gust", " calm"]


def test_no_number_is_parted_from_its_effect_at_the_end_of_a_line() -> None:
    (only,) = SAMPLES["passing"].scenes
    for width in range(60, 120):
        lines = section(short(SAMPLES["passing"], width), "Effects")
        assert max(map(len, lines)) <= width
        told = [part.strip(" ,;") for line in lines for part in re.split("[,;]", line) if part.strip()]
        assert len(told) == len(only.effects)
        assert all(re.search(r"\w+ x = [\d.]+ [≥<] 0\.1$|missing\) fog$", part) for part in told)


def test_events_are_counted_by_part() -> None:
    assert section(short(SAMPLES["moving"]), "Events") == [" gust: 35 from 0 s to 0.41975 s, rope 35"]


def test_the_solvers_behind_the_verdicts_stand_with_window_and_the_worst_balance() -> None:
    (only,) = SAMPLES["passing"].scenes
    worse = replace(only, name="gust", health={"energy_residual": 3e-4, "steps": 9.0})
    still = replace(only, name="calm", health={})
    (line,) = section(short(replace(SAMPLES["passing"], scenes=(only, worse, still))), "Solvers")
    assert line == (
        " hang rich over 4 s; gust rich over 4 s; calm rich over 4 s; energy balance error 3.0e-04 at worst, in gust"
    )


def test_a_balance_that_is_rounding_has_no_digits_and_no_scene() -> None:
    """They would be others on another processor."""
    (only,) = SAMPLES["passing"].scenes
    scenes = tuple(replace(only, name=str(left), health={"energy_residual": left}) for left in (9e-12, 3e-16))
    (line,) = section(short(replace(SAMPLES["passing"], scenes=scenes)), "Solvers")
    assert line.endswith("; energy balance error at rounding level")
    above = replace(only, name="above", health={"energy_residual": 1.1e-11})
    (line,) = section(short(replace(SAMPLES["passing"], scenes=(*scenes, above))), "Solvers")
    assert line.endswith("; energy balance error 1.1e-11 at worst, in above")


def test_a_balance_that_is_no_number_is_the_worst() -> None:
    (only,) = SAMPLES["passing"].scenes
    unknown = replace(only, name="gust", health={"energy_residual": float("nan")})
    for scenes in ((only, unknown), (unknown, only)):
        (line,) = section(short(replace(SAMPLES["passing"], scenes=scenes)), "Solvers")
        assert line.endswith("energy balance error nan at worst, in gust")


def test_a_scene_that_is_undecided_tells_the_price_of_the_next_run() -> None:
    (line,) = section(short(report_of_file("tests/cli/specs/slipping.yaml")), "Solvers")
    assert re.search(r"start_empty rigid over [\d.]+ s \(next: characteristics, \d+ ms\)", line)
    assert "next:" not in short(SAMPLES["passing"])


def test_assumed_values_stand_with_their_interval() -> None:
    assert section(short(SAMPLES["undecided"]), "Assumptions (not given in the file)") == [" shock = 1.1 (1 to 1.2)"]


@pytest.mark.parametrize("name", ["warned", "broken", "invalid", "failing"])
def test_everything_found_in_the_file_is_shown(name: str) -> None:
    head = whole(SAMPLES[name]).split("\nLoads")[0].split("\nChecks")[0]
    for diagnostic in SAMPLES[name].diagnostics:
        assert diagnostic.code in head
        assert diagnostic.message in short(SAMPLES[name])
        assert diagnostic.hint in short(SAMPLES[name])


# -- what is left out -----------------------------------------------------------------------------------------------


def table_rows(text: str, heading: str) -> int:
    """Rows under a heading of the whole table, or under one of the short one, on a screen where no row is broken."""
    lines = text.splitlines()
    begin = next(index for index, line in enumerate(lines) if re.match(rf"{heading}\b", line))
    rule = next(index for index in range(begin, len(lines)) if set(lines[index]) <= set(" ─") and lines[index])
    return lines[rule:].index("") - 1


@pytest.mark.parametrize("path", SPECS)
def test_what_is_left_out_is_counted_truthfully(path: str) -> None:
    report = report_of_file(path)
    last = short(report).splitlines()[-1]
    assert last.startswith("Further output with --verbose: ")
    told = {name: int(number) for number, name in re.findall(r"(\d+) (load|passed check|event)", last)}
    for heading, name in (("Loads", "load"), ("Checks", "passed check")):
        assert table_rows(whole(report), heading) - table_rows(short(report), heading) == told.get(name, 0), heading
    assert told.get("event", 0) == sum(len(scene.events) for scene in report.scenes)
    assert ("reasons for assumptions" in last) == bool(report.assumed)


@pytest.mark.parametrize("path", SPECS)
def test_the_whole_table_shows_everything(path: str) -> None:
    report, text = report_of_file(path), whole(report_of_file(path))
    for scene in report.scenes:
        for one in scene.loads:
            assert not one.info.headline or re.search(rf"^ {re.escape(one.info.title)} ", text, re.MULTILINE)
        for check in scene.checks:
            title = f"{check.code} {check.title}" + (f": {check.element}" if check.element else "")
            assert re.search(rf"{re.escape(title)} +{scene.name} ", text)
        for effect in scene.present:
            assert re.search(rf"^ {scene.name} +{effect.name} +{effect.state.value}", text, re.MULTILINE)
        for solver in scene.solvers:
            assert re.search(rf"^ {scene.name} +{solver.name} ", text, re.MULTILINE)
        for event in scene.events:
            assert re.search(rf"^ {scene.name} .* {event.element} +{event.before} +{event.after}$", text, re.MULTILINE)
    assert "--verbose" not in text


def test_what_is_left_out_is_counted_over_all_files_at_the_end() -> None:
    both = [SAMPLES["moving"], SAMPLES["switched_off"], SAMPLES["moving"], SAMPLES["passing"]]
    *_, summary, last = render(Format.TABLE, both).splitlines()
    assert summary == "4 files, 9 checks passed, 1 switched off"
    assert last == "Further output with --verbose: 6 passed checks, 60 events, meaning of the effects, all runs"


def test_one_is_one() -> None:
    loads = [load("governing", governing=True), load("other")]
    report = file(scene("rest", loads, [judged("TOY101", Verdict.PASS, margin) for margin in (1.0, 2.0)]))
    assert short(report).splitlines()[-1] == "Further output with --verbose: 1 load, 1 passed check"


@pytest.mark.parametrize("name", ["invalid", "unreadable"])
def test_a_report_that_leaves_nothing_out_says_nothing_of_it(name: str) -> None:
    assert short(SAMPLES[name]) == whole(SAMPLES[name])


def test_a_load_of_a_part_keeps_what_its_family_is() -> None:
    info = LoadInfo("grip", "grip", FORCE, headline=False, governing=True).of("head", LENGTH)
    assert info == LoadInfo("grip[head]", "grip, head", LENGTH, headline=False, governing=True)
