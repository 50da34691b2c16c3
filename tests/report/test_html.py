"""The pages of `check --html`: well formed, self-contained, accessible, complete, escaped, and the same every time."""

import base64
import hashlib
import json
import math
import re
from collections.abc import Iterator
from concurrent.futures import BrokenExecutor, Executor
from dataclasses import fields, is_dataclass, replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from support.command import ROOT, environment, ptmcalc, python, report_of_file
from support.web_pages import Element, as_document, page_of, page_of_text, read, reported, without_texts

from ptmcalc.base import units
from ptmcalc.base.diagnostic import Verdict
from ptmcalc.cli.pages import _each
from ptmcalc.contract.report import FileReport
from ptmcalc.contract.result import History, family
from ptmcalc.engine.figures import figures_of
from ptmcalc.engine.load import load_file
from ptmcalc.engine.registry import kind_names, load_kind
from ptmcalc.report import html, words
from ptmcalc.report.html import draw, view

KINDS = {
    "conveyor": "specs/plant_conveyor.yaml",
    "chain_drive": "specs/chain_drive.yaml",
    "hoist": "specs/hoist.yaml",
    "shaft": "specs/shaft.yaml",
    "drivetrain": "specs/drivetrain.yaml",
    "crane slewing": "specs/crane_slewing.yaml",
    "crane travelling": "specs/crane_travelling.yaml",
    "crane rack_stacker": "specs/crane_rack_stacker.yaml",
}
"""A design file of each kind and type that looks different; the other stacker has the same figures."""

SHORT = """\
kind: drivetrain
name: two discs
inertias:
  motor: {inertia: 2 kg*m^2}
  load: {inertia: 3 kg*m^2}
links:
  shaft: {between: [motor, load], stiffness: 20 kN*m/rad, damping: 40 N*m*s/rad, limit: 100 N*m}
torques:
  drive: {at: motor, type: constant, torque: 100 N*m}
scenes:
  - {type: run, duration: 0.5 s}
"""
"""The shaft carries up to about 120 N*m: it fails, and no key of the design would let it pass."""
BRAKED = """\
kind: drivetrain
name: a disc
inertias:
  disc: {inertia: 2 kg*m^2}
brakes:
  band: {at: disc, torque: 100 N*m, delay: 0.1 s, rise_time: 0.1 s}
checks: {stop_time: 1 s}
scenes:
  - {type: stop, of: disc, speed: 600 rpm}
"""
"""It stops in 1.4 s: a stronger brake lets it pass."""

HOSTILE = "<script>alert(1)</script>\" onload='x' & $\\frac{1}{2}$ ]]> \u202e \x1b[31m é 漢"


@pytest.fixture(params=KINDS, scope="module")
def path(request: pytest.FixtureRequest) -> str:
    return KINDS[request.param]


@pytest.fixture(scope="module")
def short() -> tuple[FileReport, str]:
    return page_of_text(SHORT)


def elements(text: str, *names: str) -> list[Element]:
    return list(read(text).all(*names))


# -- form -----------------------------------------------------------------------------------------------------------


def sound(text: str) -> None:
    """What holds of every page."""
    top = read(text)
    every = list(top.all())
    ids = [one.attributes["id"] for one in every if "id" in one.attributes]
    assert len(ids) == len(set(ids))
    for one in every:
        for target in (one.attributes.get("href", ""), *re.findall(r"url\(([^)]*)\)", str(one.attributes))):
            assert target == "" or re.fullmatch(r"#[A-Za-z][\w.\[\], -]*|[\w.-]+\.html", target), target
            assert not target.startswith("#") or target[1:] in ids, target
        for name in one.attributes.get("aria-labelledby", "").split():
            assert name in ids
        assert not {name for name in one.attributes if name.startswith("on") or name in ("src", "srcset", "action")}
    assert not re.search(r"https?:|//|@import", without_texts(text), re.IGNORECASE)
    for table in top.all("table"):
        assert [one.name for one in table.children][:2] == ["caption", "thead"]
        assert table.children[0].words
        heads = list(table.children[1].all("th"))
        assert all(one.attributes["scope"] == "col" and one.words for one in heads)
        for row in (one for body in table.children[2:] for one in body.all("tr")):
            wide = sum(int(cell.attributes.get("colspan", "1")) for cell in row.children)
            assert wide == len(heads)
            assert any(cell.attributes.get("scope") in ("row", "rowgroup") for cell in row.all("th"))
        assert table.parent is not None
        assert {"tabindex", "role", "aria-label"} <= table.parent.attributes.keys()
    for picture in (one for one in top.all("svg") if one.attributes.get("aria-hidden") != "true"):
        assert [one.name for one in picture.children][:2] == ["title", "desc"]
        assert all(one.words for one in picture.children[:2])
        assert picture.attributes["role"] == "img"
    (policy,) = (one.attributes["content"] for one in top.all("meta") if "http-equiv" in one.attributes)
    assert policy.startswith("default-src 'none'; style-src 'unsafe-inline'")
    scripts = [one.text for one in top.all("script")]
    allowed = [base64.b64encode(hashlib.sha256(one.encode()).digest()).decode() for one in scripts]
    assert re.findall(r"script-src '([^;]*)'", policy) == [f"sha256-{one}" for one in allowed]
    levels = [int(one.name[1]) for one in every if re.fullmatch("h[1-6]", one.name)]
    assert levels[0] == 1
    assert levels.count(1) == 1
    assert all(after <= before + 1 for before, after in pairwise(levels))


def test_a_page_is_sound(path: str) -> None:
    sound(page_of(path))


def test_the_page_of_a_failed_check_is_sound(short: tuple[FileReport, str]) -> None:
    sound(short[1])


def test_a_page_without_a_machine_is_sound() -> None:
    report, text = page_of_text("kind: conveyer\nbelt: 3\n")
    assert report.verdict == "invalid"
    sound(text)
    assert report.diagnostics[0].message in " ".join(one.words for one in elements(text, "td"))
    assert [one.words for one in elements(text, "li") if "marked" in one.attributes.get("class", "")]


@pytest.mark.parametrize(
    "page",
    [
        "<!DOCTYPE html><p><b></p></b>",
        "<!DOCTYPE html><p>",
        '<!DOCTYPE html><p id="a" id="b"></p>',
        "<p></p>",
    ],
)
def test_the_reader_of_pages_is_strict(page: str) -> None:
    with pytest.raises(AssertionError):
        read(page)


# -- what a page says -----------------------------------------------------------------------------------------------


def test_whatever_the_json_says_is_on_the_page(path: str) -> None:
    top = read(page_of(path))
    document: Any = as_document(reported(path))
    codes = [one.words for one in top.all("code")]
    tables = {one.attributes["id"]: one.words for one in top.all("table")}
    checks = [row.words for one in top.all("table") if one.attributes["id"] == "checks-table" for row in one.all("tr")]
    assert len(checks) == 1 + sum(len(scene["checks"]) for scene in document["scenes"])
    for number, scene in enumerate((one for one in document["scenes"] if one["loads"]), 1):
        told = next(one for one in top.all("table") if one.attributes["id"] == f"loads-{number}")
        assert [one.words for one in told.all("code")] == [load["name"] for load in scene["loads"]]
        assert {load["solver"] for load in scene["loads"]} <= {one.words for one in told.all("a")}
    for scene in document["scenes"]:
        for check in scene["checks"]:
            said = [row for row in checks if check["code"] in row and scene["name"] in row]
            assert any(check["verdict"].replace("_", " ") in row and check["title"] in row for row in said)
            assert ".".join(map(str, check["blame"]["path"])).replace(".[", "[")[:5] in " ".join(codes)
        for effect in (one for one in scene["effects"] if not one.get("absent")):
            assert effect["name"] in codes
            if effect["criterion"]:
                assert effect["criterion"]["meaning"] in tables["effects-table"]
                assert effect["criterion"]["source"] in tables["effects-table"]
        for solver in scene["solvers"]:
            assert solver["name"] in tables["solvers-table"]
        for load in scene["loads"]:
            assert load["source"] in tables["solvers-table"]
    for assumed in document["assumed"]:
        assert assumed["source"] in tables["assumed-table"]
    for own in document.get("tables", ()):
        assert own["title"] in [one.words for one in top.all("caption")]


def test_every_number_of_a_load_has_its_unit_its_level_and_its_source(path: str) -> None:
    report = reported(path)
    shown = view.page(report, view.Source(""))
    for scene, told in zip([one for one in report.scenes if one.loads], shown["loads"], strict=True):
        for load, entry in zip(scene.loads, told["rows"], strict=True):
            if math.isfinite(load.estimate.value) and load.info.quantity.si != "1":
                assert re.search(r"\d \S*[A-Za-z°%]", entry["value"]), load.info.name
            assert entry["level"] in ("formula", "modal", "transient")
            assert entry["solver"] == load.solver
    sources = {row["name"]: row["source"] for scene in shown["solvers"] for row in scene["rows"] if row["source"]}
    assert all(load.source in sources.values() for scene in report.scenes for load in scene.loads)


def test_the_worst_check_stands_first_with_its_line_and_its_repair() -> None:
    report, text = page_of_text(BRAKED)
    ((_, worst), *_) = words.worst_first(report)
    assert worst.verdict is Verdict.FAIL
    assert worst.repair is not None
    (box,) = (one for one in elements(text, "section") if one.attributes["id"] == "verdict")
    assert f"Worst: {worst.code}" in box.words
    assert [one.words for one in box.all("b")][-1] == worst.meaning
    assert f"brakes.band.torque = {words.number(worst.repair.value, worst.repair.quantity)}" in box.words
    (marked,) = (one for one in box.all("li") if "marked" in one.attributes.get("class", ""))
    assert marked.attributes["data-line"] == "6" == str(worst.blame.span.line)
    assert marked.text.startswith("  band: {at: disc, torque: 100 N*m")
    assert [one.attributes["href"] for one in box.all("a")] == ["#L6"]
    (line,) = (one for one in elements(text, "li") if one.attributes.get("id") == "L6")
    assert f"{worst.code} fail" in line.words


def test_the_textbook_stands_beside_what_was_simulated() -> None:
    (scene,) = (one for one in reported(KINDS["chain_drive"]).scenes if one.name == "start_loaded")
    (load,) = (one for one in scene.loads if one.info.name == "tension_start")
    assert load.formula is not None
    table = next(
        one for one in elements(page_of(KINDS["chain_drive"]), "table") if one.attributes["id"] == "summary-table"
    )
    (row,) = (one for one in table.all("tr") if one.words.startswith(load.info.title))
    assert f"textbook {load.formula.value / 1e3:.4g} kN, ×{load.formula.ratio:.3f}" in row.words


# -- figures --------------------------------------------------------------------------------------------------------


def drawn(report: FileReport) -> Iterator[tuple[str, Any]]:
    for scene in report.scenes:
        yield from ((scene.name, figure) for figure in scene.figures)


def test_a_figure_is_drawn_or_says_why_not(path: str) -> None:
    report = reported(path)
    figures = [figure for _, figure in drawn(report)]
    shown = elements(page_of(path), "figure")
    strips = sum(bool(scene.events) for scene in report.scenes)
    assert len(shown) == len(figures) + strips
    assert any(not figure.missing for figure in figures)
    for figure in figures:
        assert bool(figure.curves) != bool(figure.missing)
        if figure.missing:
            assert figure.missing in " ".join(one.words for one in shown)


def test_no_axis_is_without_a_unit_and_no_label_too_long(path: str) -> None:
    for _, figure in drawn(reported(path)):
        if not figure.missing:
            texts = [one.words for one in elements("<!DOCTYPE html>" + draw.courses(figure, "f").svg, "text")]
            labels = [text for text in texts if text.endswith("]")]
            assert [text.partition(" [")[0] for text in labels] == [figure.across, figure.upright]
            assert all(re.fullmatch(r".+ \[\S+\]", text) for text in labels)
            assert len(figure.upright) <= 24
            assert len(figure.across) <= 40


def test_a_curve_keeps_the_extremes_it_is_told_with(path: str) -> None:
    """What stands beside a curve is its largest or smallest value, to what lies between its samples."""
    compared = 0
    for _, figure in drawn(reported(path)):
        for curve in figure.curves:
            told = curve.told[0] if curve.told else None
            if told is None or "textbook" in curve.title:
                continue
            if told.quantity.si != curve.history.quantity.si or not told.estimate.bounded:
                continue
            ends = [abs(max(curve.history.values)), abs(min(curve.history.values))]
            if told.load.startswith(("tension_dynamic_polygon", "winding_stress_paper")):
                continue  # at the speed of the file, not over the range; a formula without a bound
            near = [math.isclose(abs(told.estimate.value), end, rel_tol=2e-3) for end in ends]
            assert any(near), (told.load, told.estimate.value, ends)
            compared += 1
    assert compared or "chain" in path


def test_the_moment_of_the_least_reserve_is_marked() -> None:
    (figure,) = (
        figure
        for scene, figure in drawn(reported(KINDS["conveyor"]))
        if (scene, figure.name) == ("start_loaded", "slip_over_time")
    )
    (scene,) = (one for one in reported(KINDS["conveyor"]).scenes if one.name == "start_loaded")
    least = next(load for load in scene.loads if load.info.name == "slip_reserve_min")
    (moment,) = (one for one in figure.marks.moments if one.title.startswith("least reserve"))
    assert moment.at == least.at["time"]
    assert [one.value for one in figure.marks.thresholds] == [1.0]
    (curve,) = figure.curves
    top = max(curve.history.values)
    assert curve.history.times[curve.history.values.index(top)] == pytest.approx(moment.at, abs=0.01)


def test_the_chain_keeps_away_from_what_is_forbidden() -> None:
    """Forbidden bands and safe ranges fill the range of speeds, and the operating point lies in none of the former."""
    (scene,) = (one for one in reported(KINDS["chain_drive"]).scenes if one.name == "run_loaded")
    (figure,) = scene.figures
    loads = {load.info.name: load.estimate.value for load in scene.loads}
    bands = [(band.low, band.high) for band in figure.marks.bands]
    safe = [(loads[f"safe_window_low[{k}]"], loads[f"safe_window_high[{k}]"]) for k in (1, 2)]
    stretches = sorted([*bands, *safe])
    assert (stretches[0][0], stretches[-1][1]) == pytest.approx((0.3, 0.9))
    assert all(one[1] == pytest.approx(other[0]) for one, other in pairwise(stretches))
    (spot,) = (one for one in figure.marks.spots if one.title == "operating point")
    assert (spot.at, spot.value) == (0.74, loads["tension_dynamic_polygon"])
    assert not any(low < spot.at < high for low, high in bands)


def test_the_window_of_the_fork_is_drawn() -> None:
    (scene,) = (one for one in reported(KINDS["crane rack_stacker"]).scenes if one.name == "brake_loaded")
    figure = next(one for one in scene.figures if one.name == "mast_tip")
    window = [one.value for one in figure.marks.thresholds if one.title == "window of the fork"]
    assert len(window) == 2
    assert window[0] == -window[1] > 0
    keys = [key.says for key in draw.courses(figure, "f").keys]
    assert any("window of the fork" in says for says in keys)


def test_parts_have_courses_where_the_machine_has_none() -> None:
    """A belt in cells knows the grip of each drum over time; the largest of all is a number. Twice as many samples as
    are drawn keep their extremes."""
    path = KINDS["conveyor"]
    (scene,) = (one for one in reported(path).scenes if one.name == "start_loaded")
    loaded = load_file(ROOT / path, path)
    assert loaded.spec is not None
    times = [k / 1000 for k in range(5000)]
    course = History(units.RATIO, times, [0.5 + 0.2 * math.sin(37 * t) + (k == 1234) for k, t in enumerate(times)])
    known = {"slip_utilisation_max[head]": course}
    figures = {one.name: one for one in figures_of(load_kind("conveyor"), scene, loaded.spec, known, {})}
    (curve,) = figures["slip_over_time"].curves
    assert curve.told[0].load == "slip_utilisation_max[head]"
    assert len(curve.history.times) < 1000
    assert max(curve.history.values) == course.values[1234]
    assert curve.history.times[curve.history.values.index(max(curve.history.values))] == 1.234
    assert min(curve.history.values) == min(course.values)
    assert "their curve does not" in figures["tension_over_time"].missing


def test_what_lies_below_zero_is_marked_there() -> None:
    """The swing of a start is told as a size; its course leans back."""
    (scene,) = (one for one in reported(KINDS["crane rack_stacker"]).scenes if one.name == "start_loaded")
    figure = next(one for one in scene.figures if one.name == "mast_tip")
    (told,) = figure.curves[0].told
    (spot,) = figure.marks.spots
    assert told.mirrored
    assert told.estimate.value > 0
    assert spot.value == -told.estimate.value == pytest.approx(min(figure.curves[0].history.values), rel=1e-3)
    assert told.ends == (-told.estimate.high, -told.estimate.low)
    assert [one.value < 0 for one in figure.marks.thresholds if one.title.startswith("limit")] == [True]


def test_the_interval_of_a_load_is_a_band() -> None:
    """The rope of the hoist is known to some percent: the band goes from the low to the high end."""
    (scene,) = (one for one in reported(KINDS["hoist"]).scenes if one.name == "lift_loaded")
    figure = next(one for one in scene.figures if one.name == "rope_force")
    keys = draw.courses(figure, "f").keys
    assert [key.says for key in keys if key.sign == "band"] == ["interval of: total rope force at hook, maximum"]
    assert {key.says.partition(":")[0] for key in keys if key.sign == "moment"} == {
        "the rope is taut",
        "the load leaves the ground",
    }


def test_events_are_a_strip_of_each_part() -> None:
    (scene,) = (one for one in reported(KINDS["hoist"]).scenes if one.name == "stop_up")
    strip = draw.events(scene, "e")
    said = [key.says for key in strip.keys]
    assert set(said) >= {event.element for event in scene.events} | {event.after for event in scene.events}
    assert strip.svg.count("<path") > len(scene.events)


# -- escaping -------------------------------------------------------------------------------------------------------


def poisoned(node: Any) -> Any:
    """A report in which every text that a file may bring, or anybody's kind, is hostile."""
    if isinstance(node, tuple):
        return tuple(poisoned(one) for one in node)
    if is_dataclass(node) and not isinstance(node, type):
        texts = (
            "title",
            "message",
            "hint",
            "source",
            "note",
            "reason",
            "element",
            "meaning",
            "symbol",
            "before",
            "after",
        )
        texts += ("upright", "across", "missing", "heading")
        changed = {}
        for part in fields(node):
            value = getattr(node, part.name)
            hostile = part.name in texts and isinstance(value, str) and value
            changed[part.name] = HOSTILE if hostile else poisoned(value)
        return replace(node, **changed)
    return node


@pytest.mark.parametrize("kind", ["hoist", "crane rack_stacker"])
def test_no_text_of_a_report_becomes_markup(kind: str) -> None:
    report = replace(poisoned(reported(KINDS[kind])), name=HOSTILE, kind=HOSTILE, path=HOSTILE)
    text = html.page(report, f"# {HOSTILE}\n" * 200)
    top = read(text)
    assert not list(top.all("script"))
    assert "onload" not in {name for one in top.all() for name in one.attributes}
    assert not any(
        re.search(r"https?:|//", value) for one in top.all() for value in one.attributes.values() if "M" not in value
    )
    assert "\x1b" not in text
    assert "\u202e" not in text
    assert "<script>alert(1)</script>" in top.words


def test_no_text_of_a_report_becomes_markup_of_the_index() -> None:
    report = replace(poisoned(reported(KINDS["hoist"])), name=HOSTILE, kind=HOSTILE, path=HOSTILE)
    pages = dict(html.site([report, reported(KINDS["shaft"])], lambda one: ""))
    sound(pages[html.INDEX])
    assert len(elements(pages[html.INDEX], "script")) == 1
    assert HOSTILE.partition('"')[0] in read(pages[html.INDEX]).words


# -- names, index, folders ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("paths", "names"),
    [
        (["specs/a.yaml"], ["a.html"]),
        (["specs/a.yaml", "specs/b/c.yml"], ["a.html", "b-c.html"]),
        (["x/index.yaml", "x/Index.yml"], ["index-2.html", "Index-3.html"]),
        (["x/a b.yaml", "x/a_b.yaml"], ["a_b.html", "a_b-2.html"]),
        (["../../<&>.yaml"], ["file.html"]),
        ([], []),
    ],
)
def test_names_of_pages_are_plain_and_differ(paths: list[str], names: list[str]) -> None:
    assert html.page_names(paths) == names


def test_the_index_leads_to_every_page_the_worst_first(tmp_path: Path) -> None:
    specs, out = tmp_path / "specs", tmp_path / "out" / "here"
    (specs / "deep").mkdir(parents=True)
    (specs / "failing.yaml").write_text(SHORT, encoding="utf-8")
    (specs / "deep" / "passing.yaml").write_text(SHORT.replace("limit: 100", "limit: 300"), encoding="utf-8")
    (specs / "faulty.yaml").write_text("kind: conveyer\n", encoding="utf-8")
    done = ptmcalc("check", specs, "--html", out, "--no-repairs")
    assert done.status == 2
    assert sorted(one.name for one in out.iterdir()) == [
        "deep-passing.html",
        "failing.html",
        "faulty.html",
        "index.html",
    ]
    text = (out / "index.html").read_text("utf-8")
    sound(text)
    links = [one.attributes["href"] for one in elements(text, "a") if one.attributes["href"].endswith(".html")]
    assert links == ["faulty.html", "failing.html", "deep-passing.html"]
    for name in links:
        page = (out / name).read_text("utf-8")
        sound(page)
        assert '<a href="index.html">All files</a>' in page
    verdicts = [
        one.text.strip() for one in elements(text, "span") if one.attributes.get("class", "").startswith("badge")
    ]
    assert verdicts == ["invalid", "fail", "pass"]


def test_one_file_gives_one_page(tmp_path: Path) -> None:
    spec, page = tmp_path / "case.yaml", tmp_path / "case.html"
    spec.write_text(SHORT, encoding="utf-8")
    plain = ptmcalc("check", spec, "--format", "json")
    done = ptmcalc("check", spec, "--format", "json", "--html", page)
    assert (done.status, done.out, done.err) == (1, plain.out, "")
    assert "history" not in done.out
    sound(page.read_text("utf-8"))


def test_the_same_file_gives_the_same_bytes(tmp_path: Path) -> None:
    """In processes of their own, whose sets are in different orders, with a taste of their own in pictures."""
    spec = tmp_path / "case.yaml"
    spec.write_text(SHORT, encoding="utf-8")
    (tmp_path / "matplotlibrc").write_text("font.size: 33\nsvg.hashsalt: other\naxes.grid: False\n", encoding="utf-8")
    pages = []
    for seed, folder in (("1", ROOT), ("2", tmp_path)):
        env = environment(ROOT, PYTHONHASHSEED=seed)
        done = python(
            "-m",
            "ptmcalc",
            "check",
            "case.yaml",
            "--html",
            f"{seed}.html",
            cwd=tmp_path,
            env=env | {"MATPLOTLIBRC": str(folder)},
        )
        assert (done.status, done.err) == (1, "")
        pages.append((tmp_path / f"{seed}.html").read_text("utf-8"))
    assert pages[0] == pages[1]


def test_pages_are_the_same_whoever_draws_them(tmp_path: Path) -> None:
    files = [tmp_path / f"{number}.yaml" for number in range(3)]
    for file in files:
        file.write_text(SHORT, encoding="utf-8")
    for jobs in ("1", "2"):
        assert ptmcalc("check", *files, "--html", tmp_path / jobs, "--jobs", jobs).status == 1
    one, two = ({page.name: page.read_bytes() for page in (tmp_path / jobs).iterdir()} for jobs in ("1", "2"))
    assert one == two
    assert len(one) == 4


class Gone(Executor):
    """Processes that end before they have done anything."""

    def submit(self, *given: Any, **named: Any) -> Any:
        raise BrokenExecutor


def test_where_nobody_else_draws_the_command_does() -> None:
    assert list(_each(Gone())(str.upper, iter(["a", "b"]))) == ["A", "B"]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["{spec}", "{other}", "--html", "{folder}/one.html"], "is one page, and there are several files"),
        (["{folder}", "--html", "{folder}/one.html"], "is one page, and there are several files"),
        (["{spec}", "--html", "{spec}"], "is a file"),
        (["{spec}", "--html", "{folder}/no/such/page.html"], "cannot write"),
        (["{spec}", "--html", "{spec}/below"], "cannot write"),
    ],
)
def test_what_cannot_be_written_is_told(arguments: list[str], said: str, tmp_path: Path) -> None:
    names = {"spec": tmp_path / "one.yaml", "other": tmp_path / "two.yaml", "folder": tmp_path}
    for name in ("spec", "other"):
        names[name].write_text(SHORT, encoding="utf-8")
    done = ptmcalc("check", *(one.format(**names) for one in arguments), "--no-repairs")
    assert done.status == 2
    assert said in done.err


def test_a_missing_extra_is_told_before_anything_is_computed(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(html, "find_spec", lambda name: None)
    done = ptmcalc("check", tmp_path / "no such file.yaml", "--html", tmp_path / "x.html")
    assert done.status == 2
    assert done.err == (
        'ptmcalc: --html needs jinja2 and matplotlib (install the extra: python -m pip install "ptmcalc[report]")\n'
    )


IMPORTED = """
import sys
from ptmcalc.cli.main import main
sys.argv = ["ptmcalc", "check", "case.yaml", *sys.argv[1:]]
try:
    main()
finally:
    found = {name.partition(".")[0] for name in sys.modules} & {"jinja2", "matplotlib", "markupsafe"}
    print(sorted(found), "ptmcalc.report.html" in sys.modules, "ptmcalc.engine.figures" in sys.modules)
"""


def test_what_draws_is_imported_only_where_a_page_is_asked_for(tmp_path: Path) -> None:
    (tmp_path / "case.yaml").write_text(SHORT, encoding="utf-8")
    found = {}
    for name, more in {"plain": [], "html": ["--html", "page.html"]}.items():
        done = python("-c", IMPORTED, "--no-repairs", "--format", "plain", *more, cwd=tmp_path, env=environment(ROOT))
        assert done.err == ""
        found[name] = done.out.splitlines()[-1]
    assert found["plain"] == "[] False False"
    assert found["html"] == "['jinja2', 'markupsafe', 'matplotlib'] True True"


# -- what kinds declare ---------------------------------------------------------------------------------------------


def test_the_figures_of_every_kind_are_of_its_own_loads_and_scenes() -> None:
    for kind in map(load_kind, kind_names()):
        for one in kind.manifests:
            assert one.figures, one.label
            loads = {family(info.name) for info in one.loads}
            scenes = {scene.model_fields["type"].default for solver in one.solvers for scene in solver.scenes}
            names = [figure.name for figure in one.figures]
            assert len(names) == len(set(names))
            for figure in one.figures:
                used = {name for course in figure.courses for name in (course.load, *course.also)}
                used |= {name for name, _ in figure.moments}
                assert used <= loads, (one.label, figure.name, used - loads)
                assert set(figure.scenes) & scenes, (one.label, figure.name)


def test_json_of_a_page_is_that_without(tmp_path: Path) -> None:
    """Figures are for those who look: no other format says anything of them."""
    document = json.dumps(as_document(reported(KINDS["shaft"])))
    assert "figures" not in document
    assert "history" not in document


def test_no_interval_has_the_same_text_at_both_ends() -> None:
    """`1.857 s to 1.857 s` says nothing: the interval is there, and too narrow for the digits."""
    path = "specs/crane_slewing.yaml"
    text = html.page(report_of_file(path), (ROOT / path).read_text("utf-8"))
    ends = re.findall(r'<td class="number">([^<]+) to ([^<]+)</td>', text)
    assert all(low != high for low, high in ends)
    assert "narrower than its digits" in text
    assert "exact for its level" in text
