"""A belt conveyor as a designer writes it: what may be left out, what goes together, and what is said otherwise.

Places follow one rule: a key that is too much is blamed itself, a missing one is blamed on the key of the block it
is missing from, a wrong value on the value.
"""

import copy
import re
from collections.abc import Iterator
from functools import partial
from typing import Any, get_args

import pytest
import yaml
from pydantic import BaseModel, ValidationError
from support import design_files
from support.design_files import place, problem_in, problems_of, read
from support.machines import changed, loaded, spec_of, template

from ptmcalc.base.span import KeyPath, dotted, key_path
from ptmcalc.engine.load import load_text, measure_at
from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.conveyor.machine.scenes import Run, Start
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.spec.fields import Measure

MACHINE = """\
kind: conveyor
route:
  inclination: exact
  length: 240 m
  lift: 18 m
belt:
  width: 1000 mm
  mass: 15 kg/m
  modulus: 7000 N/mm
idlers:
  carry:
    pitch: 1.2 m
    set_mass: 22 kg
  return:
    line_mass: 6 kg/m
load:
  capacity: 900 t/h
resistance:
  coefficient: 0.022
  secondary: 1.4
speed: 2.5 m/s
drive:
  motor:
    count: 1
    inertia: 1.4 kg*m^2
    mean_starting_torque: 900 N*m
  gear:
    ratio: 24.8
  drum:
    diameter: 800 mm
    wrap: 200 deg
takeup:
  type: gravity
  tension: 30 kN
scenes:
  - name: soft
    load: full
    type: start
    profile:
      control: torque
      shape: ramp
      time: 12 s
"""
edited = partial(design_files.edited, MACHINE)


def place_of(text: str, key: str) -> tuple[int, int]:
    """Line and column of the only line that begins with these words."""
    lines = text.splitlines()
    found = [number for number, line in enumerate(lines) if line.strip().startswith(key)]
    assert len(found) == 1, found
    return found[0] + 1, lines[found[0]].index(key) + 1


def test_the_machine_of_these_tests_is_sound() -> None:
    assert read(MACHINE).diagnostics == ()
    assert isinstance(read(MACHINE).spec, Conveyor)


# --- what may be written in two ways ---------------------------------------------------------------------------------

TOO_MUCH: dict[str, tuple[str, tuple[tuple[str, str], ...], str]] = {
    "stiffness and modulus": ("belt", (("modulus: 7000 N/mm", "stiffness: 7 MN\nmodulus: 7000 N/mm"),), "modulus:"),
    "strength and breaking force": (
        "belt",
        (("width: 1000 mm", "width: 1000 mm\nbreaking_force: 800 kN\nstrength: 800 N/mm"),),
        "strength:",
    ),
    "mass and capacity": ("load", (("capacity: 900 t/h", "mass: 100 kg/m\ncapacity: 900 t/h"),), "capacity:"),
    "C and a force": (
        "resistance",
        (("secondary: 1.4", "secondary: 1.4\nsecondary_force: 4 kN"),),
        "secondary_force:",
    ),
    "set mass and line mass": (
        "idlers.carry",
        (("set_mass: 22 kg", "set_mass: 22 kg\nline_mass: 18 kg/m"), ("line_mass: 6 kg/m", "# a\nline_mass: 6 kg/m")),
        "line_mass: 18",
    ),
    "mean and largest torque": (
        "drive.motor",
        (("mean_starting_torque: 900 N*m", "mean_starting_torque: 900 N*m\nlargest_starting_torque: 950 N*m"),),
        "largest_starting_torque:",
    ),
    "mean and smallest torque": (
        "drive.motor",
        (("mean_starting_torque: 900 N*m", "mean_starting_torque: 900 N*m\nsmallest_starting_torque: 850 N*m"),),
        "smallest_starting_torque:",
    ),
    "a step with a time": (
        "scenes[0].profile",
        (("shape: ramp", "shape: step"),),
        "time:",
    ),
}

MISSING: dict[str, tuple[str, tuple[tuple[str, str], ...], str]] = {
    "neither stiffness nor modulus": ("belt", (("modulus: 7000 N/mm", "# none"),), "belt:"),
    "modulus without width": ("belt", (("width: 1000 mm", "# none"),), "belt:"),
    "strength without width": (
        "belt",
        (("width: 1000 mm", "strength: 800 N/mm"), ("modulus: 7000 N/mm", "stiffness: 7 MN")),
        "belt:",
    ),
    "two values per width without it": (
        "belt",
        (("width: 1000 mm", "strength: 800 N/mm"),),
        "belt:",
    ),
    "neither mass nor capacity": ("load", (("load:", "load: {}"), ("capacity: 900 t/h", "# none")), "load: {}"),
    "neither set mass nor line mass": ("idlers.carry", (("set_mass: 22 kg", "# none"),), "carry:"),
    "set mass without pitch": ("idlers.carry", (("pitch: 1.2 m", "# none"),), "carry:"),
    "no starting torque": ("drive.motor", (("mean_starting_torque: 900 N*m", "# none"),), "motor:"),
    "largest torque alone": (
        "drive.motor",
        (("mean_starting_torque: 900 N*m", "largest_starting_torque: 950 N*m"),),
        "motor:",
    ),
    "smallest torque alone": (
        "drive.motor",
        (("mean_starting_torque: 900 N*m", "smallest_starting_torque: 850 N*m"),),
        "motor:",
    ),
    "a ramp without a time": ("scenes[0].profile", (("time: 12 s", "# none"),), "profile:"),
}

CONTRADICTION: dict[str, tuple[str, tuple[tuple[str, str], ...]]] = {
    "smallest torque above largest": (
        "drive.motor",
        (("mean_starting_torque: 900 N*m", "largest_starting_torque: 800 N*m\nsmallest_starting_torque: 900 N*m"),),
    ),
    "lift as long as the belt": ("route", (("lift: 18 m", "lift: 240 m"),)),
    "lowered further than the belt is long": ("route", (("lift: 18 m", "lift: -250 m"),)),
    "a step of speed": (
        "scenes[0].profile",
        (("shape: ramp", "shape: step"), ("control: torque", "control: speed"), ("time: 12 s", "# none")),
    ),
}


@pytest.mark.parametrize("case", [*TOO_MUCH, *MISSING, *CONTRADICTION])
def test_values_that_do_not_go_together_give_one_clear_error(case: str) -> None:
    where, edits = (TOO_MUCH | MISSING | CONTRADICTION)[case][:2]
    problem = problem_in(edited(*edits))
    assert problem.code == "SPC113"
    assert problem.path[: len(key_path(where))] == key_path(where)
    assert where in problem.message
    assert problem.hint


@pytest.mark.parametrize("case", TOO_MUCH)
def test_the_key_that_is_too_much_is_blamed(case: str) -> None:
    _, edits, key = TOO_MUCH[case]
    text = edited(*edits)
    assert place(problem_in(text)) == place_of(text, key)


@pytest.mark.parametrize("case", MISSING)
def test_a_key_that_is_missing_is_blamed_on_its_block(case: str) -> None:
    _, edits, key = MISSING[case]
    text = edited(*edits)
    assert place(problem_in(text)) == place_of(text, key)


@pytest.mark.parametrize(
    ("case", "keys"),
    [
        ("smallest torque above largest", ("largest_starting_torque:", "smallest_starting_torque:")),
        ("lift as long as the belt", ("length:", "lift:")),
        ("lowered further than the belt is long", ("length:", "lift:")),
        ("a step of speed", ("control:", "shape:")),
    ],
)
def test_a_contradiction_is_blamed_on_one_of_its_sides(case: str, keys: tuple[str, str]) -> None:
    _, edits = CONTRADICTION[case]
    text = edited(*edits)
    assert place(problem_in(text))[0] in [place_of(text, key)[0] for key in keys]


def test_a_short_belt_without_secondary_resistances_is_blamed_where_they_are_missing() -> None:
    text = edited(("length: 240 m", "length: 60 m"), ("secondary: 1.4", "# none"))
    problem = problem_in(text)
    assert problem.code == "SPC113"
    assert "80 m" in problem.message
    assert "resistance" in problem.hint
    assert place(problem) == place_of(text, "resistance:")


@pytest.mark.parametrize("line", ["secondary: 2.5", "secondary_force: 1 kN"])
def test_a_short_belt_with_its_secondary_resistances_is_sound(line: str) -> None:
    assert read(edited(("length: 240 m", "length: 60 m"), ("secondary: 1.4", line))).spec is not None


@pytest.mark.parametrize("case", [case for case in TOO_MUCH if " and " in case and "smallest" not in case])
def test_deleting_what_the_hint_of_a_conflict_names_mends_the_file(case: str) -> None:
    _, edits, key = TOO_MUCH[case]
    text = edited(*edits)
    assert problem_in(text).hint == f"delete `{key.split(':')[0]}`"
    line, _ = place_of(text, key)
    assert read("\n".join(text.splitlines()[: line - 1] + text.splitlines()[line:])).spec is not None


ALTERNATIVES = {
    "stiffness": {"belt__stiffness": "7 MN", "belt__modulus": None},
    "modulus and width": {"belt__stiffness": None, "belt__modulus": "7000 N/mm", "belt__width": "1 m"},
    "no strength": {"belt__strength": None},
    "breaking force": {"belt__strength": None, "belt__breaking_force": "800 kN"},
    "load mass": {"load": {"mass": "100 kg/m"}},
    "capacity": {"load": {"capacity": "900 t/h"}},
    "no load at all": {"load": {"capacity": "0 t/h"}},
    "secondary force": {"resistance": {"secondary_force": "4 kN"}},
    "no resistance block": {"resistance": None},
    "line mass": {"idlers__carry": {"line_mass": "18 kg/m"}},
    "line mass and pitch": {"idlers__carry": {"line_mass": "18 kg/m", "pitch": "1.2 m"}},
    "rheostat": {
        "drive__motor__mean_starting_torque": None,
        "drive__motor__largest_starting_torque": "1100 N*m",
        "drive__motor__smallest_starting_torque": "700 N*m",
    },
    "rheostat of one step": {
        "drive__motor__mean_starting_torque": None,
        "drive__motor__largest_starting_torque": "900 N*m",
        "drive__motor__smallest_starting_torque": "900 N*m",
    },
    "no tail drum": {"tail_drum": None},
    "no name": {"name": None},
}


@pytest.mark.parametrize("case", ALTERNATIVES)
def test_each_way_to_say_it_is_sound(case: str) -> None:
    assert spec_of(changed(template(), **ALTERNATIVES[case])).kind == "conveyor"


def test_a_row_of_idlers_weighs_the_same_in_both_ways() -> None:
    by_set = spec_of(changed(template(), idlers__carry={"set_mass": "24 kg", "pitch": "1.2 m"}))
    by_length = spec_of(changed(template(), idlers__carry={"line_mass": "20 kg/m"}))
    assert by_set.idlers.carry.rotating_line_mass == pytest.approx(20.0)
    assert by_length.idlers.carry.rotating_line_mass == pytest.approx(20.0)


# --- several faults --------------------------------------------------------------------------------------------------


def test_faults_in_different_blocks_are_all_shown_in_the_order_of_the_file() -> None:
    text = edited(
        ("lift: 18 m", "lift: 18"),
        ("mass: 15 kg/m", "mass: 15 kg"),
        ("capacity: 900 t/h", "capacity: 900 t/h\nmass: 100 kg/m"),
        ("speed: 2.5 m/s", "speed: 2,5 m/s"),
        ("ratio: 24.8", "ratio: -1"),
        ("type: gravity", "type: gravty"),
    )
    result = read(text)
    assert [d.code for d in result.diagnostics] == ["SPC106", "SPC105", "SPC113", "SPC107", "SPC110", "SPC112"]
    assert [place(d) for d in result.diagnostics] == sorted(place(d) for d in result.diagnostics)


def test_a_conflict_is_shown_beside_a_wrong_value_in_the_same_block() -> None:
    text = edited(("mass: 15 kg/m", "mass: 15 kg"), ("modulus: 7000 N/mm", "modulus: 7000 N/mm\nstiffness: 7 MN"))
    assert sorted(d.code for d in read(text).diagnostics) == ["SPC105", "SPC113"]


def test_two_scenes_of_one_name_are_shown_beside_a_wrong_value() -> None:
    text = edited(("lift: 18 m", "lift: 18 kg"), ("scenes:", "scenes:\n  - {type: run, name: soft}"))
    assert [d.code for d in read(text).diagnostics] == ["SPC105", "SPC113"]


def test_faults_of_the_text_and_an_unknown_kind_come_in_the_order_of_the_file() -> None:
    text = edited(("kind: conveyor", "kind: conveyer"), ("lift: 18 m", "lift: 18 m\nlift: 19 m"))
    assert [(d.code, place(d)[0]) for d in read(text).diagnostics] == [("SPC102", 1), ("TXT106", 6)]


def test_every_sort_of_conflict_is_shown_beside_a_wrong_value_elsewhere() -> None:
    """One fault hid all that held between keys, and between blocks."""
    text = edited(
        ("length: 240 m", "length: 60 m"),
        ("lift: 18 m", "lift: 70 m"),
        ("width: 1000 mm", "width: 1000"),
        ("secondary: 1.4", "# none"),
        ("mean_starting_torque: 900 N*m", "largest_starting_torque: 8 N*m\nsmallest_starting_torque: 9 N*m"),
        ("shape: ramp", "shape: step"),
    )
    found = [(d.code, dotted(d.path)) for d in read(text).diagnostics]
    assert found == [
        ("SPC113", "route.lift"),
        ("SPC106", "belt.width"),
        ("SPC113", "resistance"),
        ("SPC113", "drive.motor.smallest_starting_torque"),
        ("SPC113", "scenes[0].profile.time"),
    ]


@pytest.mark.parametrize(
    ("edits", "code"),
    [
        ((("modulus: 7000 N/mm", "modullus: 7000 N/mm"),), "SPC104"),  # neither stiffness nor modulus
        ((("width: 1000 mm", "widht: 1000 mm"),), "SPC104"),  # a modulus without its width
        ((("capacity: 900 t/h", "capacty: 900 t/h"),), "SPC104"),
        ((("length: 240 m", "length: 60 m"), ("resistance:", "resistanse:")), "SPC104"),
        ((("length: 240 m", "length: 60 m"), ("secondary: 1.4", "secondry: 1.4")), "SPC104"),
        ((("shape: ramp", "shape: ramb"), ("time: 12 s", "# none")), "SPC112"),
        ((("type: start", "tpye: start"),), "SPC104"),
        ((("type: gravity", "tpye: gravity"),), "SPC104"),
        ((("length: 240 m", "length: *x"),), "TXT110"),
        ((("modulus: 7000 N/mm", "modulus: *x"),), "TXT110"),
        ((("width: 1000 mm", "<<: *x"),), "TXT110"),
        ((("type: start", "type: *x"),), "TXT110"),
        ((("kind: conveyor", "kind: *x"),), "TXT110"),
        ((("count: 1", "count: *x"),), "TXT110"),
        ((("resistance:", "resistance: 5\ndescription:"), ("length: 240 m", "length: 60 m")), "SPC111"),
    ],
)
def test_what_follows_from_a_fault_is_not_said_as_well(edits: tuple[tuple[str, str], ...], code: str) -> None:
    found = [d for d in read(edited(*edits)).diagnostics if d.path[:1] != ("description",)]
    assert [d.code for d in found] == [code]


def test_scenes_of_one_name_are_found_beside_faults_in_them() -> None:
    text = edited(("- name: soft", "- {type: run, name: soft}\n- name: soft"), ("time: 12 s", "time: 12 kg"))
    assert [(d.code, dotted(d.path)) for d in read(text).diagnostics] == [
        ("SPC113", "scenes[1]"),
        ("SPC105", "scenes[1].profile.time"),
    ]


# --- words that are not known ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("old", "new", "code", "word", "meant"),
    [
        ("kind: conveyor", "kind: conveyer", "SPC102", "conveyer", "conveyor"),
        ("kind: conveyor", "kind: Conveyor", "SPC102", "Conveyor", "conveyor"),
        ("lift: 18 m", "lfit: 18 m", "SPC104", "lfit", "lift"),
        ("lift: 18 m", "Lift: 18 m", "SPC104", "Lift", "lift"),
        ("inclination: exact", "inclination: exakt", "SPC112", "exakt", "exact"),
        ("coefficient: 0.022", "coeficient: 0.022", "SPC104", "coeficient", "coefficient"),
        ("resistance:", "resistence:", "SPC104", "resistence", "resistance"),
        ("type: gravity", "type: gravty", "SPC112", "gravty", "gravity"),
        ("type: start", "type: strat", "SPC112", "strat", "start"),
        ("shape: ramp", "shape: ramb", "SPC112", "ramb", "ramp"),
        ("load: full", "load: ful", "SPC112", "ful", "full"),
        ("control: torque", "controll: torque", "SPC104", "controll", "control"),
        ("speed: 2.5 m/s", "speed: 2.5 m/s\neffects: {belt_vawe: off}", "SPC104", "belt_vawe", "belt_wave"),
        ("speed: 2.5 m/s", "speed: 2.5 m/s\neffects: {slip: oft}", "SPC112", "oft", "off"),
        ("speed: 2.5 m/s", "speed: 2.5 m/s\nchecks: {slp: {reserve: 1.3}}", "SPC104", "slp", "slip"),
        ("speed: 2.5 m/s", "speed: 2.5 m/s\nchecks: {slip: {reserv: 1.3}}", "SPC104", "reserv", "reserve"),
    ],
)
def test_a_misspelt_word_is_found_at_its_place_with_the_one_that_is_meant(
    old: str, new: str, code: str, word: str, meant: str
) -> None:
    text = edited((old, new))
    problem = problem_in(text)
    line = next(number for number, line in enumerate(text.splitlines(), 1) if word in line)
    assert problem.code == code
    assert place(problem) == (line, text.splitlines()[line - 1].index(word) + 1)
    assert f"`{meant}`" in problem.hint


@pytest.mark.parametrize(
    ("old", "new", "word"),
    [
        ("kind: conveyor", "kind: xyz", "conveyor"),
        ("lift: 18 m", "xyz: 18 m", "inclination"),
        ("speed: 2.5 m/s", "speed: 2.5 m/s\neffects: {xyz: off}", "belt_wave"),
        ("speed: 2.5 m/s", "speed: 2.5 m/s\nchecks: {xyz: 1}", "belt_safety_running"),
        ("speed: 2.5 m/s", "speed: 2.5 m/s\nchecks: {CNV999: {off: x}}", "CNV101"),
        ("type: start", "type: xyz", "run"),
    ],
)
def test_a_word_like_no_other_gets_the_list_of_those_known(old: str, new: str, word: str) -> None:
    assert word in problem_in(edited((old, new))).hint


@pytest.mark.parametrize("code", ["cnv101", "CNV1O1", "CNV10"])
def test_a_misspelt_code_of_a_check_gets_the_codes(code: str) -> None:
    problem = problem_in(edited(("speed: 2.5 m/s", f"speed: 2.5 m/s\nchecks: {{{code}: {{off: x}}}}")))
    assert problem.code == "SPC104"
    assert "CNV101" in problem.hint


@pytest.mark.parametrize(
    "key", ["length: 240 m", "mass: 15 kg/m", "inertia: 1.4 kg*m^2", "ratio: 24.8", "wrap: 200 deg"]
)
def test_a_misspelt_required_key_is_one_fault(key: str) -> None:
    """That it is missing under its right name only follows from the misspelling."""
    text = edited((key, key[:2] + "x" + key[2:]))
    problem = problem_in(text)
    assert problem.code == "SPC104"
    assert f"`{key.split(':')[0]}`" in problem.hint


def test_a_misspelt_off_is_one_fault_too() -> None:
    problem = problem_in(edited(("speed: 2.5 m/s", "speed: 2.5 m/s\nchecks: {CNV103: {of: later}}")))
    assert problem.code == "SPC104"
    assert "`off`" in problem.hint


@pytest.mark.parametrize("key", ["run", "start"])
def test_an_unknown_key_named_like_a_scene_keeps_its_own_name(key: str) -> None:
    problem = problem_in(edited(("type: start", f"type: start\n{key}: 5")))
    assert problem.code == "SPC104"
    assert dotted(problem.path) == f"scenes[0].{key}"


REQUIRED = [
    "route",
    "belt",
    "idlers",
    "load",
    "speed",
    "takeup",
    "belt.mass",
    "idlers.carry",
    "idlers.return",
    "drive.motor",
    "drive.gear",
    "drive.gear.ratio",
    "drive.drum",
    "drive.drum.diameter",
    "drive.drum.wrap",
    "takeup.type",
    "takeup.tension",
]


def without(data: dict[str, Any], path: KeyPath) -> dict[str, Any]:
    data = copy.deepcopy(data)
    node = data
    for step in path[:-1]:
        node = node[step]
    del node[path[-1]]
    return data


def test_a_motor_without_a_rating_plate_needs_its_inertia() -> None:
    text = yaml.safe_dump(without(yaml.safe_load(MACHINE), key_path("drive.motor.inertia")), sort_keys=False)
    problem = problem_in(text)
    assert (problem.path, problem.hint) == (("drive", "motor"), "add `inertia: 1.4 kg*m^2`")


@pytest.mark.parametrize("key", REQUIRED)
def test_a_missing_key_is_blamed_on_its_block_and_the_hint_can_be_copied(key: str) -> None:
    path = key_path(key)
    text = yaml.safe_dump(without(yaml.safe_load(MACHINE), path), sort_keys=False)
    problem = problem_in(text)
    assert (problem.code, problem.path) == ("SPC103", path)
    assert place(problem) == (place_of(text, f"{path[-2]}:") if len(path) > 1 else (1, 1))
    pasted = re.fullmatch(r"add `(.*)`", problem.hint)
    assert pasted is not None
    data = without(yaml.safe_load(MACHINE), path)
    node = data
    for step in path[:-1]:
        node = node[step]
    node |= yaml.safe_load(pasted[1])
    # what is pasted has the right form; a choice between two keys may still be open
    assert {d.code for d in read(yaml.safe_dump(data)).diagnostics} <= {"SPC113", "SPC201"}


def test_every_other_block_may_be_left_out() -> None:
    optional = ["name", "resistance", "tail_drum", "checks", "scenes", "effects", "accuracy", "gravity"]
    spec = spec_of(changed(template(), **dict.fromkeys(optional)))
    assert spec.all_scenes == Conveyor.DEFAULT_SCENES


# --- values ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("old", "new", "code"),
    [
        ("lift: 18 m", "lift: 18 kg", "SPC105"),
        ("lift: 18 m", "lift: 18", "SPC106"),
        ("lift: 18 m", "lift: 18,5 m", "SPC107"),
        ("ratio: 24.8", "ratio: 24,8", "SPC107"),
        ("lift: 18 m", "lift: 18 ft", "SPC108"),
        ("lift: 18 m", "lift: .nan", "SPC109"),
        ("lift: 18 m", "lift: -.inf", "SPC109"),
        ("ratio: 24.8", "ratio: .inf", "SPC109"),
        ("ratio: 24.8", "ratio: 1e400", "SPC109"),
        ("ratio: 24.8", f"ratio: {'9' * 350}", "SPC109"),
        ("lift: 18 m", "lift: 1e400 m", "SPC109"),
        ("mass: 15 kg/m", "mass: -15 kg/m", "SPC110"),
        ("mass: 15 kg/m", "mass: 0 kg/m", "SPC110"),
        ("mass: 15 kg/m", "mass: 1e-400 kg/m", "SPC110"),
        ("secondary: 1.4", "secondary: 0.99", "SPC110"),
        ("ratio: 24.8", "efficiency: 101 %\nratio: 24.8", "SPC110"),
        ("count: 1", "count: 0", "SPC110"),
        ("count: 1", "count: 65", "SPC110"),
        ("count: 1", "count: 1.5", "SPC111"),
        ("count: 1", "count: yes", "SPC111"),
        ("count: 1", "count: '1'", "SPC111"),
        ("lift: 18 m", "lift: true", "SPC111"),
        ("lift: 18 m", "lift: [18 m]", "SPC111"),
        ("lift: 18 m", "lift: {high: 18 m}", "SPC111"),
        ("takeup:", "takeup: gravity\nx:", "SPC111"),
        ("lift: 18 m", "lift: 1e16 m", "SPC110"),
        ("lift: 18 m", "lift: -1e13 km", "SPC110"),
        ("lift: 18 m", "lift: 1e-10 mm", "SPC110"),
        ("mass: 15 kg/m", "mass: 1e-13 kg/m", "SPC110"),
        ("ratio: 24.8", "ratio: 1e300", "SPC110"),
        ("lift: 18 m", "lift: high", "SPC114"),
        ("lift: 18 m", "lift: 1 200 mm", "SPC114"),
        ("lift: 18 m", "lift: ''", "SPC114"),
    ],
)
def test_a_wrong_value_is_blamed_itself(old: str, new: str, code: str) -> None:
    text = edited((old, new))
    wrong = new.splitlines()[0]
    key = wrong.split(":")[0]
    problem = next(d for d in read(text).diagnostics if d.code == code)
    line, column = place_of(text, wrong)
    assert place(problem) == (line, column + len(key) + 2)
    assert key in problem.message


@pytest.mark.parametrize(
    ("key", "value", "code"),
    [
        ("name", 12, "SPC111"),
        ("name", "x" * 201, "SPC110"),
        ("scenes", [], "SPC110"),
        ("scenes", [{"type": "run", "name": f"run{number}"} for number in range(51)], "SPC110"),
        ("scenes", ["run"], "SPC111"),
        ("scenes", {"type": "run"}, "SPC111"),
        ("scenes", [{"type": "run", "name": "a b"}], "SPC111"),
        ("checks", {"CNV101": {"off": ""}}, "SPC110"),
        ("checks", {"CNV101": "off"}, "SPC111"),
        ("checks", 5, "SPC111"),
        ("effects", "slip", "SPC111"),
        ("effects", ["slip"], "SPC111"),
        ("drive__motor__count", 0, "SPC110"),
        ("drive__motor__count", 65, "SPC110"),
        ("drive__motor__count", 1.5, "SPC111"),
        ("takeup", "gravity", "SPC111"),
        ("resistance", 0.02, "SPC111"),
    ],
)
def test_a_value_of_the_wrong_form_or_size_gets_a_hint(key: str, value: Any, code: str) -> None:
    (problem,) = problems_of(changed(template(), **{key: value}))
    assert problem.code == code
    assert problem.hint


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("kind: conveyor", "kind:", "nothing"),
        ("lift: 18 m", "lift: true", "`true`"),
        ("lift: 18 m", "lift: -.inf", "`-.inf`"),
        ("count: 1", "count: false", "`false`"),
        ("lift: 18 m", "lift: -3 kg", "`-3 kg`"),
        ("lift: 18 m", "lift: [18 m]", "a list"),
        ("lift: 18 m", "lift:", "nothing"),
    ],
)
def test_a_message_quotes_the_words_of_the_file(old: str, new: str, words: str) -> None:
    assert words in problem_in(edited((old, new))).message


@pytest.mark.parametrize(
    ("line", "value"),
    [
        ("route: {length: 240 m, lift: 18,5 m}", "18.5 m"),
        ("takeup: {type: gravity, tension: 30,5 kN}", "30.5 kN"),
        ("checks: {sag: 0,01}", "0.01"),
        ("resistance: {coefficient: 0,022, secondary: 1.4}", "0.022"),
    ],
)
def test_a_decimal_comma_in_a_flow_mapping_is_one_fault(line: str, value: str) -> None:
    """There the comma parts the value from its rest, which must not be said twice."""
    key = line.partition(":")[0]
    text = yaml.safe_dump({k: v for k, v in yaml.safe_load(MACHINE).items() if k != key}, sort_keys=False) + line
    problem = problem_in(text)
    assert problem.code == "SPC107"
    assert place(problem)[0] == len(text.splitlines())
    assert value in problem.hint


@pytest.mark.parametrize(
    ("key", "value", "hint"),
    [
        ("scenes", ["start"], "write `{type: start}`"),
        ("scenes", [5], "write `{type: run}`"),
        ("resistance", 0.02, "write `resistance: {coefficient: 0.022}`"),
        ("checks", {"slip": 1.2}, "write `slip: {reserve: 1.2}`"),
        ("checks", {"CNV101": "off"}, "write `CNV101: {off: ...}`"),
        ("drive__motor__count", 0, "write a value at least 1"),
        ("drive__motor__count", 65, "write a value at most 64"),
        ("name", "x" * 201, "write at most 200 characters"),
        ("scenes", [], "write at least 1 item"),
    ],
)
def test_a_hint_says_what_to_write(key: str, value: Any, hint: str) -> None:
    (problem,) = problems_of(changed(template(), **{key: value}))
    assert problem.hint == hint


def test_a_long_value_does_not_bury_the_message() -> None:
    for line in (f"lift: {'x' * 5000}", f"lift: {'9' * 290}", f"lift: 5 {'q' * 5000}", f"{'k' * 900}: 5"):
        problem = problem_in(edited(("lift: 18 m", line)))
        assert len(problem.message) < 250
        assert len(problem.hint) < 250


def fields(model: type[BaseModel]) -> Iterator[tuple[str, Measure]]:
    """Every number with a quantity in a model and the models inside it."""
    for name, field in model.model_fields.items():
        yield from ((f"{model.__name__}.{name}", part) for part in parts(field.annotation, field.metadata))
        for inner in models(field.annotation):
            yield from fields(inner)


def parts(annotation: Any, metadata: list[Any]) -> Iterator[Measure]:
    yield from (part for part in (*metadata, *getattr(annotation, "__metadata__", ())) if isinstance(part, Measure))
    for argument in get_args(annotation):
        yield from parts(argument, [])


def models(annotation: Any) -> Iterator[type[BaseModel]]:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield annotation
    for argument in get_args(annotation):
        yield from models(argument)


MEASURES = dict(fields(Conveyor))


def test_every_number_of_the_machine_is_found() -> None:
    assert {"Route.length", "IdlerRow.line_mass", "SlipLimit.reserve", "Profile.time", "Conveyor.accuracy"} <= set(
        MEASURES
    )


@pytest.mark.parametrize("name", MEASURES)
def test_the_example_a_message_shows_is_in_range(name: str) -> None:
    measure = MEASURES[name]
    assert measure.broken_by(measure.read(measure.quantity.example)) == ""


@pytest.mark.parametrize("value", ["0 m", "1e-12 m", "-1e-12 m", "1e15 m", "-1e15 m"])
def test_the_ends_of_what_any_machine_has_are_allowed(value: str) -> None:
    assert MEASURES["Route.lift"].read(value) == float(value.removesuffix(" m"))


@pytest.mark.parametrize("name", MEASURES)
def test_no_number_is_beyond_what_any_machine_has(name: str) -> None:
    measure = MEASURES[name]
    assert measure.broken_by(1.001e15)
    assert measure.broken_by(-1.001e15)
    assert measure.broken_by(0.999e-12)


@pytest.mark.parametrize("path", ["route.length", "drive.drum.friction", "checks.slip.reserve", "resistance.secondary"])
def test_the_range_of_a_number_is_found_by_its_key(path: str) -> None:
    key = key_path(path)[-1]
    measure = measure_at(spec_of(template()), key_path(path))
    assert measure is not None
    assert any(name.endswith(f".{key}") and other == measure for name, other in MEASURES.items())


@pytest.mark.parametrize(
    "path", ["", "name", "route", "nowhere", "drive.drum.nowhere", "scenes[0].profile.time", "takeup.type"]
)
def test_no_number_is_found_where_there_is_none(path: str) -> None:
    assert measure_at(spec_of(template()), key_path(path)) is None


# --- the filled-in spec ----------------------------------------------------------------------------------------------


def test_defaults() -> None:
    spec = spec_of(changed(template(), name=None, route__lift=None, drive__motor__count=None, effects=None))
    assert (spec.name, spec.description, spec.gravity, spec.accuracy, spec.effects) == ("", "", 9.81, None, {})
    assert (spec.route.lift, spec.route.inclination) == (0.0, "exact")
    assert spec.drive.motor.count == 1
    assert (spec.checks.slip.reserve, spec.checks.slip.definition) == (1.2, "force")
    assert (spec.checks.sag, spec.checks.slack_sag) == (0.01, 0.10)
    assert (spec.checks.belt_safety_running, spec.checks.belt_safety_starting) == (None, None)


def test_default_scenes_are_a_run_and_two_starts() -> None:
    scenes = spec_of(template()).all_scenes
    assert [scene.label for scene in scenes] == ["run_loaded", "start_loaded", "start_empty"]
    assert [type(scene) for scene in scenes] == [Run, Start, Start]


def test_scenes_of_the_file_replace_the_default_ones() -> None:
    scenes = [{"type": "start", "name": "soft", "profile": {"shape": "cosine", "time": "12 s"}}, {"type": "run"}]
    spec = spec_of(changed(template(), scenes=scenes))
    assert [scene.label for scene in spec.all_scenes] == ["soft", "run_loaded"]


@pytest.mark.parametrize(
    ("profile", "imposes_speed"),
    [
        ({"shape": "step"}, False),
        ({"shape": "ramp", "time": "5 s"}, True),
        ({"shape": "cosine", "time": "5 s"}, True),
        ({"shape": "ramp", "time": "5 s", "control": "torque"}, False),
        ({"shape": "step", "control": "torque"}, False),
    ],
)
def test_ramps_are_of_speed_unless_the_file_says_torque(profile: dict[str, str], imposes_speed: bool) -> None:
    spec = spec_of(changed(template(), scenes=[{"type": "start", "profile": profile}]))
    (scene,) = spec.all_scenes
    assert isinstance(scene, Start)
    assert scene.profile.imposes_speed is imposes_speed


ASSUMED = {
    "resistance.coefficient": 0.020,
    "resistance.start_factor": 1.2,
    "drive.gear.efficiency": 0.94,
    "drive.coupling_inertia": 0.15 * 1.4,
    "drive.drum.inertia": 0.0,
    "tail_drum.inertia": 0.0,
}


@pytest.mark.parametrize("key", ASSUMED)
def test_a_value_left_out_is_assumed_and_listed_with_its_interval(key: str) -> None:
    path = key_path(key)
    result = loaded(without(template(), path))
    assert result.spec is not None
    (assumed,) = result.assumed
    assert assumed.path == path
    assert assumed.value == pytest.approx(ASSUMED[key])
    assert result.spec.value_at(path) == assumed.value
    assert assumed.interval.low <= assumed.value <= assumed.interval.high
    assert assumed.interval.low < assumed.interval.high
    assert assumed.source


def test_the_length_factor_is_assumed_unless_a_force_stands_for_it() -> None:
    by_table = loaded(without(template(), ("resistance", "secondary")))
    by_force = loaded(
        changed(
            template(),
            resistance={"coefficient": 0.022, "start_factor": 1.2, "rest_factor": 0.5, "secondary_force": "4 kN"},
        )
    )
    assert [value.path for value in by_table.assumed] == [("resistance", "secondary")]
    assert by_force.assumed == ()


def test_nothing_is_assumed_where_the_file_says_it_all() -> None:
    assert loaded(template()).assumed == ()


@pytest.mark.parametrize(
    ("path", "value"),
    [
        (("speed",), 2.5),
        (("route", "length"), 240.0),
        (("idlers", "return", "pitch"), 3.0),
        (("idlers", "carry", "set_mass"), 22.0),
        (("drive", "drum", "friction"), 0.35),
        (("checks", "slip", "reserve"), 1.2),
        (("load", "mass"), None),
        (("scenes", 0, "load"), None),
        (("nowhere", "at", "all"), None),
        (("speed", "deeper"), None),
    ],
)
def test_value_at(path: KeyPath, value: float | None) -> None:
    assert spec_of(template()).value_at(path) == value


def test_value_at_reaches_scenes_effects_and_switches() -> None:
    data = changed(
        template(),
        scenes=[{"type": "run"}, {"type": "start", "profile": {"shape": "ramp", "time": "5 s"}}],
        effects={"slip": "off"},
        checks={"CNV103": {"off": "later"}},
    )
    spec = spec_of(data)
    assert spec.value_at(("scenes", 1, "profile", "time")) == 5.0
    assert spec.value_at(("scenes", 2, "type")) is None
    assert spec.value_at(("effects", "slip")) == "off"
    assert spec.value_at(("checks", "CNV103", "off")) == "later"
    assert spec.checks.switched_off("CNV103") == "later"
    assert spec.checks.switched_off("CNV101") == ""


@pytest.mark.parametrize(
    "path",
    [
        ("speed",),
        ("route", "length"),
        ("idlers", "return", "pitch"),
        ("drive", "drum", "inertia"),
        ("checks", "slip", "reserve"),
        ("scenes", 1, "profile", "time"),
    ],
)
def test_with_value_changes_that_value_in_a_copy_and_nothing_else(path: KeyPath) -> None:
    scenes = [{"type": "run"}, {"type": "start", "profile": {"shape": "ramp", "time": "5 s"}}]
    spec = spec_of(changed(template(), scenes=scenes))
    before = spec.model_dump()
    copied = spec.with_value(path, 123.0)
    assert copied.value_at(path) == 123.0
    assert spec.model_dump() == before
    assert type(copied) is Conveyor
    assert copied.with_value(path, spec.value_at(path)) == spec


@pytest.mark.parametrize(
    "path", [("speed",), ("route", "length"), ("idlers", "back"), ("checks", "sag"), ("drive", "motor")]
)
def test_a_spec_cannot_be_changed_in_place(path: KeyPath) -> None:
    node: Any = spec_of(template())
    for step in path[:-1]:
        node = getattr(node, str(step))
    with pytest.raises(ValidationError, match="frozen"):
        setattr(node, str(path[-1]), 1.0)


def test_values_are_si() -> None:
    spec = spec_of(template())
    assert spec.belt.width == pytest.approx(1.0)
    assert spec.belt.modulus == pytest.approx(7e6)
    assert spec.load.capacity == pytest.approx(250.0)
    assert spec.takeup.tension == pytest.approx(30e3)
    assert spec.drive.drum.wrap == pytest.approx(3.490658503988659)
    assert spec.drive.motor.speed == pytest.approx(154.98523757709646)


# --- the loader ------------------------------------------------------------------------------------------------------


def test_effects_of_the_command_line_go_over_those_of_the_file() -> None:
    raw = yaml.safe_dump(changed(template(), effects={"slip": "on", "sag": "on"})).encode()
    result = load_text(raw, "a.yaml", {"slip": "off"}, "2 %")
    assert result.spec is not None
    assert result.spec.effects == {"slip": "off", "sag": "on"}
    assert result.spec.accuracy == pytest.approx(0.02)


def test_values_that_disagree_are_a_warning_at_their_place_and_the_machine_is_read() -> None:
    text = edited(("count: 1", "count: 1\nspeed: 990 rpm"))
    result = read(text)
    assert result.spec is not None
    (note,) = result.diagnostics
    assert (note.code, note.severity.value) == ("SPC201", "warning")
    assert place(note) == (place_of(text, "speed: 2.5")[0], 8)


def test_a_file_with_a_text_fault_alone_is_not_computed() -> None:
    result = read(edited(("lift: 18 m", "lift: 18 m\nlift: 18 m")))
    assert result.spec is None
    assert [d.code for d in result.diagnostics] == ["TXT106"]


def test_the_template_is_sound_and_says_nothing() -> None:
    result = read(load_kind("conveyor").template)
    assert result.spec is not None
    assert result.diagnostics == ()
