"""Other names of keys: accepted wherever the key is, and named by every message as the file writes them."""

import copy
import itertools
import json as reader
import math
import pickle
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import yaml
from jsonschema import Draft202012Validator
from support.machines import template
from support.random_machines import KINDS

from ptmcalc.base.diagnostic import Diagnostic
from ptmcalc.base.span import AliasedKey, KeyPath, dotted, known
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import Loaded, keys_as_known, load_text
from ptmcalc.engine.points import varied_key
from ptmcalc.engine.registry import load_kind
from ptmcalc.report import json, plain
from ptmcalc.spec.alias import key_of
from ptmcalc.spec.shape import aliases_of, keys_of, models_inside
from ptmcalc.text.document import parse

SPECS = Path(__file__).parents[2] / "specs"


def spec(name: str) -> dict[str, Any]:
    data = yaml.safe_load((SPECS / name).read_text("utf-8"))
    assert isinstance(data, dict)
    return data


def several_drives() -> dict[str, Any]:
    data = template()
    data["drives"] = {"head": data.pop("drive")}
    return data


def with_value(data: dict[str, Any], path: KeyPath, value: object) -> dict[str, Any]:
    data = copy.deepcopy(data)
    block: Any = data
    for step in path[:-1]:
        block = block[step] if isinstance(step, int) else block.setdefault(step, {})
    block.setdefault(path[-1], value)
    return data


def drivetrain() -> dict[str, Any]:
    data = spec("drivetrain.yaml")
    del data["links"]["coupling"]["clearance"]
    return data


NAMES: dict[str, tuple[dict[str, Any], KeyPath, str, object]] = {
    "drive pulley": (template(), ("drive", "drum"), "pulley", {}),
    "one of several drive pulleys": (several_drives(), ("drives", "head", "drum"), "pulley", {}),
    "tail pulley": (template(), ("tail_drum",), "tail_pulley", {"inertia": "20 kg*m^2"}),
    "holdback of a conveyor": (template(), ("backstop",), "holdback", {"torque": "40 kN*m"}),
    "counterweight": (template(), ("takeup", "mass"), "counterweight_mass", "6 t"),
    "take-up travel": (template(), ("takeup", "stroke"), "travel", "2 m"),
    "pulley of a belt": (template(), ("belt", "minimum_drum_diameter"), "minimum_pulley_diameter", "500 mm"),
    "drive sprocket": (spec("chain_drive.yaml"), ("sprocket",), "drive_sprocket", {}),
    "holdback of a chain": (spec("chain_drive/inclined_scraper.yaml"), ("backstop",), "holdback", {}),
    "slewing ring": (spec("crane_slewing.yaml"), ("ring",), "slewing_ring", {}),
    "mast of a rack stacker": (spec("crane_rack_stacker.yaml"), ("column",), "mast", {}),
    "mast of an overhead stacker": (spec("crane_overhead_stacker.yaml"), ("column",), "mast", {}),
    "positioning tolerance": (
        spec("crane_rack_stacker.yaml"),
        ("settling", "window"),
        "positioning_tolerance",
        "10 mm",
    ),
    "backlash": (drivetrain(), ("links", "coupling", "gap"), "backlash", "0.01 rad"),
}


def renamed(data: dict[str, Any], path: KeyPath, name: str, *, both: bool = False) -> dict[str, Any]:
    data = copy.deepcopy(data)
    block: Any = data
    for step in path[:-1]:
        block = block[step]
    entries = list(block.items())
    block.clear()
    for key, value in entries:
        if key != path[-1] or both:
            block[key] = value
        if key == path[-1]:
            block[name] = value
    return data


def read(data: dict[str, Any]) -> Loaded:
    return load_text(written(data).encode(), "case.yaml")


def written(data: dict[str, Any]) -> str:
    return yaml.dump(data, Dumper=_Dumper, sort_keys=False, allow_unicode=True)


class _Dumper(yaml.SafeDumper):
    """Writes every value where it is, without anchors."""

    def ignore_aliases(self, data: Any) -> bool:
        return True


@pytest.fixture(params=NAMES)
def case(request: pytest.FixtureRequest) -> tuple[dict[str, Any], KeyPath, str]:
    data, path, name, value = NAMES[request.param]
    return with_value(data, path, value), path, name


Case = tuple[dict[str, Any], KeyPath, str]


def all_declared() -> Iterator[tuple[str, str, str]]:
    for kind in KINDS:
        for model in models_inside(kind.spec):
            yield from ((kind.name, key, name) for name, key in aliases_of(model).items())


def test_every_declared_name_has_a_case_here() -> None:
    tried = {(data["kind"], path[-1], name) for data, path, name, _ in NAMES.values()}
    assert set(all_declared()) == tried


def test_the_page_lists_every_declared_name() -> None:
    page = (SPECS.parent / "docs" / "editor.md").read_text("utf-8")
    rows = [re.findall(r"`([^`]+)`", row) for row in re.findall(r"^\| (.*`.*) \|$", page, re.MULTILINE)]
    last = [[word.rpartition(".")[2] for word in row if word != "slewing"] for row in rows]
    listed = {(kind, key, name) for kind, *words in last for key, name in zip(*halves(words), strict=True)}
    assert listed == set(all_declared())


def halves(words: list[str]) -> tuple[list[str], list[str]]:
    return words[: len(words) // 2], words[len(words) // 2 :]


def test_no_other_name_is_a_key_of_its_block() -> None:
    for kind in KINDS:
        for model in models_inside(kind.spec):
            assert not set(aliases_of(model)) & set(keys_of(model)), model


def test_a_file_with_the_other_name_is_the_same_machine(case: Case) -> None:
    data, path, name = case
    plain_file, other = read(data), read(renamed(data, path, name))
    assert [one.message for one in plain_file.diagnostics] == [one.message for one in other.diagnostics]
    assert plain_file.spec is not None
    assert plain_file.spec == other.spec
    assert other.document.data == plain_file.document.data
    assert dotted(other.document.as_written(path)) == dotted((*path[:-1], name))


def test_every_value_is_where_the_file_has_it(case: Case) -> None:
    data, path, name = case
    text = written(renamed(data, path, name))
    document = load_text(text.encode(), "case.yaml").document
    place = document.key_span(path)
    assert text.splitlines()[place.line - 1][place.column - 1 :].startswith(f"{name}:")
    raw = parse(text.encode(), "case.yaml")
    assert set(document.values.values()) == set(raw.values.values())


def test_both_names_at_once_are_one_error(case: Case) -> None:
    data, path, name = case
    text = written(renamed(data, path, name, both=True))
    (problem,) = load_text(text.encode(), "case.yaml").diagnostics
    where = dotted((*path[:-1], name))
    assert problem.code == "SPC113"
    assert problem.message == f"`{where}`: give it or `{path[-1]}`, not both: they are one key"
    assert problem.hint == f"delete `{name}`"
    assert problem.span is not None
    assert text.splitlines()[problem.span.line - 1].strip().startswith(f"{name}:")


def test_the_second_name_is_at_fault_whichever_it_is() -> None:
    data = template()
    torque = data.pop("backstop")
    (problem,) = read(data | {"holdback": torque} | {"backstop": torque}).diagnostics
    assert problem.message == "`backstop`: give it or `holdback`, not both: they are one key"
    assert problem.hint == "delete `backstop`"


def test_an_unknown_key_below_it_is_named_as_the_file_does(case: Case) -> None:
    data, path, name = case
    block: Any = data
    for step in path:
        block = block[step]
    if not isinstance(block, dict):
        block = data
        for step in path[:-1]:
            block = block[step]
        block[str(path[-1])] = "5 kelvin"
        wanted = dotted((*path[:-1], name))
    else:
        block["xyzzy"] = "1 m"
        wanted = dotted((*path[:-1], name, "xyzzy"))
    text = written(renamed(data, path, name))
    (problem,) = load_text(text.encode(), "case.yaml").diagnostics
    assert problem.message.startswith((f"unknown key `{wanted}`", f"`{wanted}`: ")), problem.message
    assert known(problem.path)[: len(path)] == path, "the path in JSON is that of the key"
    assert problem.span is not None
    assert text.splitlines()[problem.span.line - 1].strip().startswith(wanted.split(".")[-1])


def test_a_misspelt_other_name_is_told() -> None:
    data = renamed(template(), ("drive", "drum"), "puley")
    (problem,) = read(data).diagnostics
    assert (problem.code, problem.message) == ("SPC104", "unknown key `drive.puley`")
    assert problem.hint == "did you mean `pulley`?"


def test_a_key_that_is_missing_below_it_is_named_as_the_file_does() -> None:
    data = renamed(template(), ("drive", "drum"), "pulley")
    del data["drive"]["pulley"]["diameter"]
    (problem,) = read(data).diagnostics
    assert problem.message == "`diameter` is missing under `drive.pulley`"


def test_a_contradiction_between_keys_names_them_as_the_file_does() -> None:
    data = template()
    data["takeup"] = {"type": "rigid", "tension": "30 kN", "counterweight_mass": "6 t"}
    (problem,) = read(data).diagnostics
    assert problem.code == "SPC113"
    assert "takeup.counterweight_mass" in problem.message
    assert "`mass`" not in problem.message + problem.hint


def test_merged_keys_give_way_to_those_of_the_mapping_itself() -> None:
    text = written(several_drives())
    head, _, rest = text.partition("drives:\n  head:\n")
    assert rest
    block = "".join(itertools.takewhile(lambda line: line.startswith("    "), rest.splitlines(keepends=True)))
    after = rest.removeprefix(block)
    pulley = "    pulley: {diameter: 800 mm, wrap: 123 deg, inertia: 5 kg*m^2}\n"
    made = f"{head}drives:\n  head: &head\n{block}  second:\n    <<: *head\n{pulley}{after}"
    found = load_text(made.encode(), "case.yaml")
    assert found.diagnostics == ()
    assert found.spec is not None
    assert found.spec.value_at(("drives", "second", "drum", "wrap")) == pytest.approx(math.radians(123))


def test_tolerances_take_either_name() -> None:
    data = renamed(template() | {"backstop": {"torque": "40 kN*m"}}, ("backstop",), "holdback")
    for name in ("backstop.torque", "holdback.torque"):
        found = read(data | {"tolerances": {name: {"plus": "1 kN*m"}}})
        assert found.diagnostics == (), name
        assert found.spec is not None
        assert list(found.spec.tolerances) == ["backstop.torque"]
    (problem,) = read(data | {"tolerances": {"holdback.torque": {"plus": "1 m"}}}).diagnostics
    assert problem.message.startswith("`tolerances.holdback.torque"), problem.message


@pytest.mark.parametrize("in_file", ["stroke", "travel"])
@pytest.mark.parametrize("asked", ["takeup.stroke", "takeup.travel"])
def test_a_varied_key_is_called_by_either_name(in_file: str, asked: str) -> None:
    found = read(with_value(template(), ("takeup", in_file), "2 m"))
    key, _ = varied_key(found, asked)
    assert known(key.path) == ("takeup", "stroke")
    assert key.name == f"takeup.{in_file}", "as the file has it"
    assert key.present == 2


def test_paths_through_lists_and_names_of_parts() -> None:
    data = several_drives()
    assert key_of(("drives", "head", "pulley", "wrap"), load_kind("conveyor").spec, data) == (
        "drives",
        "head",
        "drum",
        "wrap",
    )
    assert key_of(("scenes", 0, "pulley"), load_kind("conveyor").spec, data) == ("scenes", 0, "pulley")


def weak() -> Loaded:
    """A belt whose smallest pulley fails, with names of its own."""
    data = renamed(template(), ("drive", "drum"), "pulley")
    data["belt"]["minimum_pulley_diameter"] = "3 m"
    data["scenes"] = [{"type": "run"}]
    return read(data)


def test_reports_name_keys_as_the_file_does() -> None:
    report = check(weak(), Options())
    text = plain.render((report,), width=200, color=False)
    (failed,) = [one for _, one in report.judgements if one.verdict.value == "fail"]
    assert failed.repair is not None
    assert dotted(failed.repair.path) == "drive.pulley.diameter"
    assert known(failed.repair.path) == ("drive", "drum", "diameter")
    assert dotted(failed.blame.path).startswith("drive.pulley")
    assert "drive.pulley.diameter" in text
    assert "drive.drum" not in text


def test_json_has_the_keys() -> None:
    text = json.render((check(weak(), Options()),), width=200, color=False)
    (failed,) = [one for one in reader.loads(text)["files"][0]["scenes"][0]["checks"] if one["verdict"] == "fail"]
    assert failed["repair"]["path"] == ["drive", "drum", "diameter"]


def test_two_files_that_differ_in_names_alone_are_the_same() -> None:
    data = template()
    one, other = (
        keys_as_known(parse(written(each).encode(), "a.yaml"))
        for each in (data, renamed(data, ("drive", "drum"), "pulley"))
    )
    assert one.data == other.data


def test_the_schema_takes_one_name_of_a_key(case: Case) -> None:
    data, path, name = case
    kind = load_kind("crane").types if data["kind"] == "crane" else (load_kind(data["kind"]),)
    (schema,) = [one.spec.model_json_schema() for one in kind if data["kind"] != "crane" or one.type == data["type"]]
    validator = Draft202012Validator(schema)
    assert [error.message for error in validator.iter_errors(renamed(data, path, name))] == []
    assert not validator.is_valid(renamed(data, path, name, both=True))


def test_a_key_remembers_its_name_in_other_processes() -> None:
    key = pickle.loads(pickle.dumps(AliasedKey("drum", "pulley")))
    assert (key, key.written, dotted(("drive", key))) == ("drum", "pulley", "drive.pulley")


def test_a_diagnostic_without_other_names_stays_as_it_is() -> None:
    data = template()
    data["takeup"] = {"type": "rigid", "tension": "30 kN", "mass": "6 t"}
    (problem,) = read(data).diagnostics
    assert isinstance(problem, Diagnostic)
    assert "takeup.mass" in problem.message
