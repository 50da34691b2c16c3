"""What a designer writes of routes, drives, brakes and scenes: what is missing, what disagrees, what is said of it.

A key that is too much is blamed itself, a missing one is blamed on the key of its block, a wrong value on the value.
"""

import re
from functools import partial
from typing import Any

import pytest
import yaml
from support import design_files
from support.design_files import place, problem_in, problems_in, read

from ptmcalc.base.diagnostic import Diagnostic, Severity
from ptmcalc.base.span import dotted
from ptmcalc.machines.conveyor.machine.scenes import EmergencyStop, Jam, Start, Stop
from ptmcalc.machines.conveyor.machine.spec import Conveyor

MACHINE = """\
kind: conveyor
route:
  sections:
    - length: 300 m
      lift: -5 m
    - length: 700 m
      lift: 47 m
belt: {width: 1200 mm, mass: 20 kg/m, stiffness: 90 MN}
idlers: {carry: {line_mass: 26 kg/m}, return: {line_mass: 13 kg/m}}
load: {mass: 160 kg/m}
resistance: {coefficient: 0.022, secondary: 1.09}
speed: 4 m/s
drives:
  primary:
    motor: {count: 2, inertia: 6 kg*m^2, mean_starting_torque: 2200 N*m}
    gear: {ratio: 20}
    drum: {diameter: 1000 mm, wrap: 200 deg, friction: 0.35}
  secondary:
    at: head
    delay: 0.5 s
    motor: {inertia: 6 kg*m^2, mean_starting_torque: 2200 N*m}
    gear: {ratio: 20}
    drum: {diameter: 1000 mm, wrap: 200 deg, friction: 0.35}
brakes:
  disc:
    at: head
    shaft: drum
    torque: 40 kN*m
    delay: 0.2 s
    rise_time: 2 s
backstop:
  torque: 60 kN*m
  reserve: 1.5
takeup:
  type: gravity
  tension: 240 kN
  mass: 48.93 t
  stroke: 4 m
  permanent_elongation: 0.5 %
scenes:
  - type: start
    belt: relaxed
    aborted:
      run: 5 s
      pause: 4 s
  - type: stop
    load: uphill
  - type: emergency_stop
  - type: coast
    measured_distance: 60 m
  - type: jam
    at: tail
    duration: 3 s
  - type: backstop
checks:
  stop_distance: 20 m
  emergency_stop_distance: 15 m
  stop_time: 30 s
  slip_heat: 50 kJ
"""
edited = partial(design_files.edited, MACHINE)

DRIVE: dict[str, Any] = {
    "motor": {"inertia": "6 kg*m^2", "mean_starting_torque": "2200 N*m"},
    "gear": {"ratio": 20},
    "drum": {"diameter": "1000 mm", "wrap": "200 deg", "friction": 0.35},
}


def with_blocks(**blocks: Any) -> str:
    """The machine with whole blocks replaced, in the order of the file; None deletes one."""
    data = yaml.safe_load(MACHINE) | blocks
    return yaml.safe_dump({key: value for key, value in data.items() if value is not None}, sort_keys=False)


def warnings_of(text: str) -> list[Diagnostic]:
    result = read(text)
    assert result.spec is not None, [(d.code, d.message) for d in result.diagnostics]
    assert all((d.code, d.severity) == ("SPC201", Severity.WARNING) for d in result.diagnostics)
    return list(result.diagnostics)


def place_of(text: str, words: str, nth: int = 0) -> tuple[int, int]:
    """Line and column of the nth line that begins with these words, be it in a list."""
    lines = text.splitlines()
    found = [number for number, line in enumerate(lines) if line.lstrip(" -").startswith(words)]
    return found[nth] + 1, lines[found[nth]].index(words) + 1


def value_of(text: str, words: str, nth: int = 0) -> tuple[int, int]:
    """Line and column of the value behind a key."""
    line, column = place_of(text, words, nth)
    return line, column + len(words.split(":")[0]) + 2


def test_the_machine_of_these_tests_is_sound() -> None:
    result = read(MACHINE)
    assert result.diagnostics == ()
    assert isinstance(result.spec, Conveyor)
    assert [scene.label for scene in result.spec.all_scenes] == [
        "start_loaded",
        "stop_uphill",
        "emergency_stop_loaded",
        "coast_loaded",
        "jam_loaded",
        "backstop_loaded",
    ]


# --- what does not go together ---------------------------------------------------------------------------------------


def test_a_drive_beside_drives_is_blamed_on_the_second_and_deleting_it_mends_the_file() -> None:
    written = yaml.safe_dump(DRIVE, default_flow_style=True, width=1000).strip()
    text = edited(("speed: 4 m/s", f"speed: 4 m/s\ndrive: {written}"))
    problem = problem_in(text)
    assert (problem.code, dotted(problem.path)) == ("SPC113", "drives")
    assert place(problem) == place_of(text, "drives:")
    assert problem.hint == "delete `drives`"


def test_without_any_drive_the_hint_can_be_copied() -> None:
    problem = problem_in(with_blocks(drives=None))
    assert (problem.code, place(problem)) == ("SPC113", (1, 1))
    assert "`drive` or `drives`" in problem.message
    pasted = re.fullmatch(r"add `(.*)`", problem.hint)
    assert pasted is not None
    left = {d.code for d in read(with_blocks(drives=None, **yaml.safe_load(pasted[1]))).diagnostics}
    assert left <= {"SPC113", "SPC201"}  # a choice between two keys may still be open


@pytest.mark.parametrize(
    ("new", "path", "words", "hint"),
    [
        ("length: 1000 m\nsections:", "route.sections", "sections:", "delete `sections`"),
        ("lift: 42 m\nsections:", "route.lift", "lift: 42", "delete `lift`"),
    ],
)
def test_a_route_is_one_slope_or_sections(new: str, path: str, words: str, hint: str) -> None:
    text = edited(("sections:", new))
    problem = problem_in(text)
    assert (problem.code, dotted(problem.path), problem.hint) == ("SPC113", path, hint)
    assert place(problem) == place_of(text, words)


def test_a_route_without_length_and_sections_lacks_one() -> None:
    text = with_blocks(route={"inclination": "exact"})
    problem = problem_in(text)
    assert (problem.code, place(problem)) == ("SPC113", place_of(text, "route:"))
    assert "`length` or `sections`" in problem.message
    assert problem.hint.startswith("add `length: ")


@pytest.mark.parametrize("lift", ["700 m", "-700 m", "701 m", "1e6 m"])
def test_a_section_cannot_rise_further_than_it_is_long(lift: str) -> None:
    text = edited(("lift: 47 m", f"lift: {lift}"))
    problem = problem_in(text)
    assert (problem.code, dotted(problem.path)) == ("SPC113", "route.sections[1].lift")
    assert place(problem) == place_of(text, "lift:", 1)


def test_short_sections_need_their_secondary_resistances() -> None:
    route = {"sections": [{"length": "30 m"}, {"length": "40 m"}]}
    text = with_blocks(route=route, resistance={"coefficient": 0.022}, scenes=[{"type": "run"}])
    problem = problem_in(text)
    assert (problem.code, place(problem)) == ("SPC113", place_of(text, "resistance:"))
    assert "80 m" in problem.message
    assert read(text.replace("40 m", "50 m")).spec is not None


def test_drives_that_are_all_at_the_tail_are_refused_by_name() -> None:
    text = with_blocks(drives={"a": DRIVE | {"at": "tail"}, "b": DRIVE | {"at": "tail"}})
    problem = problem_in(text)
    assert (problem.code, dotted(problem.path)) == ("SPC113", "drives")
    assert place(problem) == place_of(text, "drives:")
    assert "head" in problem.hint
    assert read(with_blocks(drives={"a": DRIVE | {"at": "tail"}, "b": DRIVE})).spec is not None


def test_a_rigid_takeup_has_no_mass() -> None:
    text = edited(("type: gravity", "type: rigid"))
    problem = problem_in(text)
    assert (problem.code, dotted(problem.path)) == ("SPC113", "takeup.mass")
    assert place(problem) == place_of(text, "mass: 48.93 t")
    assert problem.hint == "delete `mass`, or write `type: gravity`"
    mended = edited(("type: gravity", "type: rigid"), ("mass: 48.93 t", "# none"))
    assert read(mended).spec is not None


@pytest.mark.parametrize("shape", ["ramp", "cosine"])
def test_an_imposed_speed_is_not_broken_off(shape: str) -> None:
    text = edited(("belt: relaxed", f"profile: {{shape: {shape}, time: 8 s}}"))
    problem = problem_in(text)
    assert (problem.code, dotted(problem.path)) == ("SPC113", "scenes[0].aborted")
    assert place(problem) == place_of(text, "aborted:")
    assert problem.hint == "add `power: 90 kW` and `poles: 4` to the motor, or write `control: torque`"
    mended = text.replace("time: 8 s}", "time: 8 s, control: torque}")
    assert [scene.type for scene in read(mended).spec.all_scenes][:1] == ["start"]  # type: ignore[union-attr]


def test_a_torque_step_can_be_broken_off() -> None:
    scene = {"type": "start", "aborted": {"run": "1 s"}}
    spec = read(with_blocks(scenes=[scene])).spec
    assert isinstance(spec, Conveyor)
    (start,) = spec.all_scenes
    assert isinstance(start, Start)
    assert start.aborted is not None
    assert (start.aborted.run, start.aborted.pause) == (1.0, 0.0)


def test_a_brake_on_a_motor_shaft_needs_a_motor_where_it_stands() -> None:
    text = edited(("shaft: drum", "shaft: motor")).replace("  disc:\n    at: head", "  disc:\n    at: tail")
    problem = problem_in(text)
    assert (problem.code, dotted(problem.path)) == ("SPC113", "brakes.disc.shaft")
    assert place(problem) == place_of(text, "shaft:")
    assert "`shaft: drum`" in problem.hint
    assert read(text.replace("shaft: motor", "shaft: drum")).diagnostics == ()
    at_tail = text.replace("    at: head\n    delay: 0.5 s", "    at: tail\n    delay: 0.5 s")
    assert read(at_tail).diagnostics == ()


def test_a_brake_on_the_motor_of_a_single_drive_at_the_tail_is_refused_too() -> None:
    brakes = {"disc": {"torque": "4 kN*m", "at": "tail", "shaft": "motor"}}
    problem = problem_in(with_blocks(drives=None, drive=DRIVE, brakes=brakes))
    assert (problem.code, dotted(problem.path)) == ("SPC113", "brakes.disc.shaft")


# --- what is missing -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("line", "block", "path"),
    [
        ("torque: 40 kN*m", "disc:", "brakes.disc.torque"),
        ("torque: 60 kN*m", "backstop:", "backstop.torque"),
        ("run: 5 s", "aborted:", "scenes[0].aborted.run"),
        ("tension: 240 kN", "takeup:", "takeup.tension"),
    ],
)
def test_a_missing_key_is_blamed_on_its_block_and_the_hint_can_be_copied(line: str, block: str, path: str) -> None:
    text = edited((line, "# none"))
    problem = problem_in(text)
    assert (problem.code, dotted(problem.path)) == ("SPC103", path)
    assert place(problem) == place_of(text, block)
    pasted = re.fullmatch(r"add `(.*)`", problem.hint)
    assert pasted is not None
    assert {d.code for d in read(edited((line, pasted[1]))).diagnostics} <= {"SPC201"}


def test_a_section_without_length_is_blamed_on_its_item() -> None:
    text = edited(("- length: 300 m", "- {lift: 1 m}"), ("lift: -5 m", "# none"))
    problem = problem_in(text)
    assert (problem.code, dotted(problem.path)) == ("SPC103", "route.sections[0].length")
    assert place(problem)[0] == place_of(text, "{lift: 1 m}")[0]


@pytest.mark.parametrize("part", ["motor", "gear", "drum"])
def test_every_drive_needs_its_parts(part: str) -> None:
    drives = {"one": DRIVE, "two": {key: value for key, value in DRIVE.items() if key != part}}
    text = with_blocks(drives=drives)
    problem = problem_in(text)
    assert (problem.code, dotted(problem.path)) == ("SPC103", f"drives.two.{part}")
    assert place(problem) == place_of(text, "two:")


# --- words and values ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("old", "new", "code", "word", "meant"),
    [
        ("- type: emergency_stop", "- type: emergency", "SPC112", "emergency", "emergency_stop"),
        ("- type: coast", "- type: cost", "SPC112", "cost", "coast"),
        ("- type: jam", "- type: jamm", "SPC112", "jamm", "jam"),
        ("- type: backstop", "- type: backstp", "SPC112", "backstp", "backstop"),
        ("belt: relaxed", "belt: relax", "SPC112", "relax", "relaxed"),
        ("load: uphill", "load: uphil", "SPC112", "uphil", "uphill"),
        ("load: uphill", "brakes: onn", "SPC112", "onn", "on"),
        ("at: tail", "at: tale", "SPC112", "tale", "tail"),
        ("shaft: drum", "shaft: drumm", "SPC112", "drumm", "drum"),
        ("delay: 0.5 s", "delai: 0.5 s", "SPC104", "delai", "delay"),
        ("rise_time: 2 s", "risetime: 2 s", "SPC104", "risetime", "rise_time"),
        ("reserve: 1.5", "reserv: 1.5", "SPC104", "reserv", "reserve"),
        ("stroke: 4 m", "strok: 4 m", "SPC104", "strok", "stroke"),
        ("pause: 4 s", "paus: 4 s", "SPC104", "paus", "pause"),
        ("measured_distance: 60 m", "measured_way: 60 m", "SPC104", "measured_way", "measured_distance"),
        ("stop_distance: 20 m", "stop_distanc: 20 m", "SPC104", "stop_distanc", "stop_distance"),
        ("slip_heat: 50 kJ", "slip_heet: 50 kJ", "SPC104", "slip_heet", "slip_heat"),
        ("backstop:", "backstopp:", "SPC104", "backstopp", "backstop"),
        ("brakes:", "braks:", "SPC104", "braks", "brakes"),
        ("drives:", "drivs:", "SPC104", "drivs", "drives"),
        ("sections:", "section:", "SPC104", "section", "sections"),
    ],
)
def test_a_misspelt_word_is_found_at_its_place_with_the_one_that_is_meant(
    old: str, new: str, code: str, word: str, meant: str
) -> None:
    text = edited((old, new))
    problem = problem_in(text)
    line = next(number for number, line in enumerate(text.splitlines(), 1) if line.strip() == new)
    assert problem.code == code
    assert place(problem) == (line, text.splitlines()[line - 1].index(word) + 1)
    assert f"`{meant}`" in problem.hint


@pytest.mark.parametrize("word", ["braking", "Stop", "xyz", ""])
def test_an_unknown_scene_gets_the_list_of_those_known(word: str) -> None:
    problem = problem_in(with_blocks(scenes=[{"type": word}]))
    assert problem.code == "SPC112"
    assert all(name in problem.message for name in ("emergency_stop", "coast", "jam", "backstop"))


@pytest.mark.parametrize(
    ("old", "new", "code"),
    [
        ("delay: 0.5 s", "delay: 0.5 m", "SPC105"),
        ("delay: 0.5 s", "delay: 0.5", "SPC106"),
        ("delay: 0.5 s", "delay: -0.5 s", "SPC110"),
        ("delay: 0.5 s", "delay: 0,5 s", "SPC107"),
        ("torque: 40 kN*m", "torque: 40 kN", "SPC105"),
        ("torque: 40 kN*m", "torque: 0 kN*m", "SPC110"),
        ("torque: 40 kN*m", "torque: -40 kN*m", "SPC110"),
        ("torque: 40 kN*m", "torque: 1e16 N*m", "SPC110"),
        ("torque: 40 kN*m", "torque: .nan", "SPC109"),
        ("delay: 0.2 s", "delay: 1e16 s", "SPC110"),
        ("rise_time: 2 s", "rise_time: -2 s", "SPC110"),
        ("rise_time: 2 s", "rise_time: 2 m", "SPC105"),
        ("torque: 60 kN*m", "torque: 60 t", "SPC105"),
        ("reserve: 1.5", "reserve: 0.9", "SPC110"),
        ("mass: 48.93 t", "mass: 48.93 kN", "SPC105"),
        ("mass: 48.93 t", "mass: 0 t", "SPC110"),
        ("stroke: 4 m", "stroke: 4 s", "SPC105"),
        ("stroke: 4 m", "stroke: 0 m", "SPC110"),
        ("permanent_elongation: 0.5 %", "permanent_elongation: 101 %", "SPC110"),
        ("permanent_elongation: 0.5 %", "permanent_elongation: -1 %", "SPC110"),
        ("run: 5 s", "run: 0 s", "SPC110"),
        ("run: 5 s", "run: 5 kg", "SPC105"),
        ("pause: 4 s", "pause: -4 s", "SPC110"),
        ("measured_distance: 60 m", "measured_distance: 60 s", "SPC105"),
        ("measured_distance: 60 m", "measured_distance: -60 m", "SPC110"),
        ("duration: 3 s", "duration: 0 s", "SPC110"),
        ("duration: 3 s", "duration: 3 m", "SPC105"),
        ("stop_distance: 20 m", "stop_distance: 20 s", "SPC105"),
        ("stop_distance: 20 m", "stop_distance: 0 m", "SPC110"),
        ("emergency_stop_distance: 15 m", "emergency_stop_distance: -1 m", "SPC110"),
        ("stop_time: 30 s", "stop_time: 30 m", "SPC105"),
        ("slip_heat: 50 kJ", "slip_heat: 50 N", "SPC105"),
        ("slip_heat: 50 kJ", "slip_heat: -50 kJ", "SPC110"),
        ("- length: 300 m", "- length: 0 m", "SPC110"),
        ("lift: 47 m", "lift: 47 kg", "SPC105"),
    ],
)
def test_a_wrong_value_is_blamed_itself(old: str, new: str, code: str) -> None:
    text = edited((old, new))
    problem = problem_in(text)
    line = next(number for number, line in enumerate(text.splitlines(), 1) if line.strip() == new)
    key = new.lstrip("- ").split(":")[0]
    assert problem.code == code
    assert place(problem) == (line, text.splitlines()[line - 1].index(f"{key}:") + len(key) + 3)
    assert key in problem.message
    assert problem.hint


@pytest.mark.parametrize(
    ("blocks", "code", "path"),
    [
        ({"drives": {}}, "SPC110", "drives"),
        ({"drives": [DRIVE]}, "SPC111", "drives"),
        ({"drives": {f"d{number}": DRIVE for number in range(9)}}, "SPC110", "drives"),
        ({"drives": {"a": 5}}, "SPC111", "drives.a"),
        ({"brakes": [{"torque": "1 kN*m"}]}, "SPC111", "brakes"),
        ({"brakes": {"disc": "4 kN*m"}}, "SPC111", "brakes.disc"),
        ({"brakes": 5}, "SPC111", "brakes"),
        ({"backstop": True}, "SPC111", "backstop"),
        ({"route": {"sections": []}}, "SPC110", "route.sections"),
        ({"route": {"sections": {"length": "9 m"}}}, "SPC111", "route.sections"),
        ({"route": {"sections": ["300 m"]}}, "SPC111", "route.sections[0]"),
        ({"route": {"sections": [{"length": "1 m"}] * 201}}, "SPC110", "route.sections"),
        ({"scenes": [{"type": "stop", "brakes": 5}]}, "SPC112", "scenes[0].brakes"),
        ({"scenes": [{"type": "jam", "brakes": "on"}]}, "SPC104", "scenes[0].brakes"),
        ({"scenes": [{"type": "stop", "aborted": {"run": "1 s"}}]}, "SPC104", "scenes[0].aborted"),
        ({"scenes": [{"type": "run", "belt": "relaxed"}]}, "SPC104", "scenes[0].belt"),
        ({"scenes": [{"type": "start", "aborted": "1 s"}]}, "SPC111", "scenes[0].aborted"),
        ({"drives": None, "drive": DRIVE | {"at": "head"}}, "SPC104", "drive.at"),
        ({"drives": None, "drive": DRIVE | {"delay": "1 s"}}, "SPC104", "drive.delay"),
    ],
)
def test_a_block_of_the_wrong_form_is_blamed_with_a_hint(blocks: dict[str, Any], code: str, path: str) -> None:
    problem = problem_in(with_blocks(**blocks))
    assert (problem.code, dotted(problem.path)) == (code, path)
    assert problem.hint


def test_two_scenes_of_one_name_are_told_apart_by_a_name() -> None:
    text = with_blocks(scenes=[{"type": "stop"}, {"type": "stop", "brakes": "off"}])
    problem = problem_in(text)
    assert (problem.code, dotted(problem.path)) == ("SPC113", "scenes[1]")
    named = with_blocks(scenes=[{"type": "stop"}, {"type": "stop", "brakes": "off", "name": "run_out"}])
    assert read(named).diagnostics == ()


def test_every_fault_is_shown_at_once_in_the_order_of_the_file() -> None:
    text = edited(
        ("lift: 47 m", "lift: 800 m"),
        ("delay: 0.5 s", "delay: 0.5 m"),
        ("torque: 40 kN*m", "# none"),
        ("reserve: 1.5", "reserve: 0"),
        ("type: gravity", "type: rigid"),
        ("belt: relaxed", "belt: relax"),
        ("- type: coast", "- type: cost"),
        ("duration: 3 s", "duration: 3"),
        ("slip_heat: 50 kJ", "slip_heat: 50 kN"),
    )
    found = problems_in(text)
    assert [(d.code, dotted(d.path)) for d in found] == [
        ("SPC113", "route.sections[1].lift"),
        ("SPC105", "drives.secondary.delay"),
        ("SPC103", "brakes.disc.torque"),
        ("SPC110", "backstop.reserve"),
        ("SPC113", "takeup.mass"),
        ("SPC112", "scenes[0].belt"),
        ("SPC112", "scenes[3].type"),
        ("SPC106", "scenes[4].duration"),
        ("SPC105", "checks.slip_heat"),
    ]
    assert [place(d) for d in found] == sorted(place(d) for d in found)
    assert all(d.hint for d in found)


# --- sound values that disagree --------------------------------------------------------------------------------------


def test_the_motor_speed_of_every_drive_is_compared_with_the_belt() -> None:
    fast = DRIVE | {"motor": DRIVE["motor"] | {"speed": "1490 rpm"}}
    slow = fast | {"gear": {"ratio": 30}}
    assert warnings_of(with_blocks(drives={"one": fast, "two": fast})) == []
    text = with_blocks(drives={"one": fast, "two": slow})
    (note,) = warnings_of(text)
    assert "`two`" in note.message
    assert place(note) == value_of(text, "speed: 4")


@pytest.mark.parametrize(("mass", "said"), [("48.93 t", 0), ("47 t", 0), ("24.5 t", 1), ("98 t", 1), ("1 kg", 1)])
def test_a_weight_that_does_not_make_the_tension_is_noted_with_the_one_that_does(mass: str, said: int) -> None:
    text = edited(("mass: 48.93 t", f"mass: {mass}"))
    notes = warnings_of(text)
    assert len(notes) == said
    for note in notes:
        assert place(note) == value_of(text, f"mass: {mass}")
        pasted = re.search(r"`(mass: [^`]*)`", note.hint)
        assert pasted is not None
        assert warnings_of(edited(("mass: 48.93 t", pasted[1]))) == []


@pytest.mark.parametrize(("load", "lift"), [("uphill", "-9 m"), ("uphill", "0 m"), ("downhill", "9 m")])
def test_a_partial_load_without_such_a_section_is_noted(load: str, lift: str) -> None:
    text = with_blocks(route={"length": "400 m", "lift": lift}, scenes=[{"type": "run", "load": load}])
    (note,) = warnings_of(text)
    assert place(note) == value_of(text, f"load: {load}")
    assert note.hint == "write `load: empty`"
    assert warnings_of(text.replace(f"load: {load}", "load: empty")) == []


def test_an_emergency_stop_without_brakes_is_noted() -> None:
    text = with_blocks(brakes=None, scenes=[{"type": "emergency_stop"}])
    (note,) = warnings_of(text)
    assert place(note) == value_of(text, "type: emergency_stop")
    assert "`type: coast`" in note.hint


def test_a_delay_that_an_imposed_speed_passes_over_is_noted() -> None:
    profile = {"shape": "ramp", "time": "8 s"}
    text = with_blocks(scenes=[{"type": "start", "profile": profile}])
    (note,) = warnings_of(text)
    assert "`secondary`" in note.message
    assert place(note)[0] in (place_of(text, "profile:")[0], place_of(text, "profile:")[0] + 1)
    assert warnings_of(with_blocks(scenes=[{"type": "start", "profile": profile | {"control": "torque"}}])) == []


# --- the spec --------------------------------------------------------------------------------------------------------


def test_defaults() -> None:
    text = with_blocks(
        drives={"one": DRIVE},
        brakes={"disc": {"torque": "1 kN*m"}},
        backstop={"torque": "1 kN*m"},
        takeup={"type": "gravity", "tension": "240 kN"},
        scenes=[{"type": "stop"}, {"type": "jam"}, {"type": "start"}, {"type": "emergency_stop"}],
        checks=None,
    )
    spec = read(text).spec
    assert isinstance(spec, Conveyor)
    assert spec.drives is not None
    assert (spec.drives["one"].at, spec.drives["one"].delay) == ("head", 0.0)
    brake = spec.brakes["disc"]
    assert (brake.at, brake.shaft, brake.delay, brake.rise_time) == ("head", "drum", 0.0, 0.0)
    assert spec.backstop is not None
    assert spec.backstop.reserve == 1.25
    assert spec.takeup.mass == pytest.approx(2 * 240e3 / spec.gravity)
    assert (spec.takeup.stroke, spec.takeup.permanent_elongation) == (None, None)
    stop, jam, start, emergency = spec.all_scenes
    assert isinstance(stop, Stop)
    assert isinstance(jam, Jam)
    assert isinstance(start, Start)
    assert isinstance(emergency, EmergencyStop)
    assert (stop.brakes, jam.at, jam.duration, start.belt, start.aborted) == ("on", "head", None, "frozen", None)
    assert spec.checks.stop_distance is None
    assert spec.resistance.stop_factor == 1.0


def test_values_are_si_and_sections_add_up() -> None:
    spec = read(MACHINE).spec
    assert isinstance(spec, Conveyor)
    assert (spec.route.span, spec.route.climb) == pytest.approx((1000.0, 42.0))
    assert spec.brakes["disc"].torque == pytest.approx(40e3)
    assert spec.takeup.mass == pytest.approx(48930.0)
    assert spec.takeup.permanent_elongation == pytest.approx(0.005)
    assert spec.checks.slip_heat == pytest.approx(50e3)


def test_the_main_drive_is_the_first_at_the_head() -> None:
    drives = {"booster": DRIVE | {"at": "tail"}, "one": DRIVE, "two": DRIVE}
    spec = read(with_blocks(drives=drives)).spec
    assert isinstance(spec, Conveyor)
    assert spec.main_path == ("drives", "one")
    assert list(spec.all_drives) == ["booster", "one", "two"]
    assert spec.main_drive.drum.wrap == pytest.approx(3.490658503988659)
