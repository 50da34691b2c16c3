"""A main shaft as a designer writes it: what ties its parts together, and what is said where they do not fit.

Every fault is told at the line and column of the value at fault, and what the hint offers to write makes a sound file.
"""

import inspect
from collections.abc import Iterator
from typing import Any

import pytest
import yaml
from pydantic import BaseModel
from support.design_files import place, problem_in, read
from support.machines import loaded, report_of
from support.shafts import spec_of

from ptmcalc.base.diagnostic import Severity
from ptmcalc.base.span import KeyPath, dotted, key_path
from ptmcalc.engine.load import measure_at
from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.shaft.machine import spec
from ptmcalc.machines.shaft.machine.spec import RunOut, RunUp, Shaft, Steady
from ptmcalc.spec.shape import inner, keys_of, model_of

CRANK = """\
inertia:
  type: slider_crank
  crank_radius: 60 mm
  rod_length: 480 mm
  crank_inertia: 260 kg*m^2
  slider_mass: 420 kg
"""
HARMONICS = """\
inertia:
  type: harmonics
  mean: 30 kg*m^2
  terms:
    - {order: 2, cosine: 4 kg*m^2}
"""
TABLE = """\
inertia:
  type: table
  points:
    - {angle: 0 deg, inertia: 30 kg*m^2}
    - {angle: 90 deg, inertia: 35 kg*m^2}
    - {angle: 180 deg, inertia: 32 kg*m^2}
"""
CONSTANT = "inertia: {type: constant, value: 30 kg*m^2}\n"
DRIVE = """\
drive:
  motor: {type: linear, starting_torque: 200 N*m, no_load_speed: 100 rad/s}
  gear: {ratio: 10, efficiency: 0.9}
"""
ALWAYS = """\
drive:
  motor: {type: constant, torque: 200 N*m}
  gear: {ratio: 10, efficiency: 0.9}
"""
TOOL = """\
load:
  type: tool_force
  points:
    - {distance: 1 mm, force: 60 kN}
    - {distance: 4 mm, force: 90 kN}
"""
SECTORS = """\
load:
  type: sectors
  sectors:
    - {from: 270 deg, to: 360 deg, torque: 900 N*m}
"""
OVER_ANGLE = """\
load:
  type: table
  points:
    - {angle: 10 deg, torque: 60 N*m}
    - {angle: 200 deg, torque: 90 N*m}
"""
BALANCE = """\
potential:
  - {type: tool_spring, force: 5 kN}
"""
WEIGHT = """\
potential:
  - {type: unbalance, mass: 4 kg, radius: 50 mm}
"""
WAVE = """\
potential:
  - {type: harmonic, order: 3, sine: 4 N*m}
"""
ENERGY = """\
potential:
  - type: energy
    points:
      - {angle: 5 deg, energy: 1 J}
      - {angle: 95 deg, energy: 2 J}
      - {angle: 185 deg, energy: 3 J}
"""
BRAKE = "brake: {torque: 600 N*m, delay: 60 ms}\n"
SCENES = """\
scenes:
  - {type: run_up}
  - {type: steady}
  - {type: run_out}
"""


def file(*parts: str) -> str:
    return "kind: shaft\n" + "".join(parts)


def place_of(text: str, words: str) -> tuple[int, int]:
    """Line and column of words that stand only once in a text."""
    assert text.count(words) == 1, (words, text.count(words))
    before = text[: text.index(words)]
    return before.count("\n") + 1, len(before) - before.rfind("\n")


SOUND = [
    file(CRANK, DRIVE, TOOL, BALANCE, BRAKE, SCENES),
    file(HARMONICS, DRIVE, SECTORS, WEIGHT),
    file(TABLE, DRIVE, OVER_ANGLE, WAVE),
    file(CONSTANT, DRIVE, ENERGY),
]


@pytest.mark.parametrize("text", SOUND)
def test_the_machines_of_these_tests_are_sound(text: str) -> None:
    assert read(text).diagnostics == ()
    assert isinstance(read(text).spec, Shaft)


# --- what does not fit -----------------------------------------------------------------------------------------------

# name: (file, words of it that are at fault, what the hint makes of them, path, words where it is told, message, hint)
FAULTS: dict[str, tuple[str, str, str, str, str, str, str]] = {
    "harmonics that reach below 0": (
        file(HARMONICS, DRIVE),
        "cosine: 4 kg",
        "cosine: 31 kg",
        "inertia.terms",
        "terms:",
        "decreases to -1.0",
        "above 0 at every angle",
    ),
    "angles of an inertia that fall": (
        file(TABLE, DRIVE),
        "{angle: 180 deg, inertia: 32",
        "{angle: 80 deg, inertia: 32",
        "inertia.points[2].angle",
        "angle: 80 deg",
        "not above that of the point before",
        "sort the points",
    ),
    "an angle of an inertia twice": (
        file(TABLE, DRIVE),
        "{angle: 180 deg, inertia: 32",
        "{angle: 1.5707963267948966 rad, inertia: 32",
        "inertia.points[2].angle",
        "angle: 1.5707963267948966 rad",
        "not above that of the point before",
        "give each place once",
    ),
    "an inertia whose first point comes again": (
        file(TABLE, DRIVE),
        "{angle: 180 deg, inertia: 32",
        "{angle: 360 deg, inertia: 32",
        "inertia.points",
        "points:",
        "span a cycle of 360 deg or more",
        "delete the point at the end",
    ),
    "a curve through points that falls below 0": (
        file(TABLE, DRIVE),
        "inertia: 35 kg*m^2}\n    - {angle: 180 deg, inertia: 32 kg*m^2}",
        "inertia: 35 kg*m^2}\n    - {angle: 95 deg, inertia: 0.01 kg*m^2}\n    - {angle: 270 deg, inertia: 32 kg*m^2}",
        "inertia.points",
        "points:",
        "the smooth curve through the points decreases to",
        "add points",
    ),
    "a rod that is too short": (
        file(CRANK, DRIVE),
        "rod_length: 480 mm",
        "rod_length: 60 mm",
        "inertia.rod_length",
        "rod_length:",
        "the crank cannot rotate fully",
        "check the three lengths",
    ),
    "an offset that the rod does not reach": (
        file(CRANK, DRIVE),
        "rod_length: 480 mm\n",
        "rod_length: 480 mm\n  offset: -420 mm\n",
        "inertia.rod_length",
        "rod_length:",
        "the crank cannot rotate fully",
        "check the three lengths",
    ),
    "a sector that ends before it begins": (
        file(CONSTANT, DRIVE, SECTORS),
        "to: 360 deg",
        "to: 90 deg",
        "load.sectors[0].to",
        "to: 90 deg",
        "ends at or before its start",
        "`to: 450 deg`",
    ),
    "a sector of no width": (
        file(CONSTANT, DRIVE, SECTORS),
        "to: 360 deg",
        "to: 270 deg",
        "load.sectors[0].to",
        "to: 270 deg",
        "ends at or before its start",
        "`to: 630 deg`",
    ),
    "a sector wider than a cycle": (
        file(CONSTANT, DRIVE, SECTORS),
        "to: 360 deg",
        "to: 631 deg",
        "load.sectors[0]",
        "{from: 270",
        "wider than a cycle of 360 deg",
        "the period of the whole machine",
    ),
    "angles of a load that fall": (
        file(CONSTANT, DRIVE, OVER_ANGLE),
        "angle: 200 deg",
        "angle: 9 deg",
        "load.points[1].angle",
        "angle: 9 deg",
        "not above that of the point before",
        "sort the points",
    ),
    "a load whose first point comes again": (
        file(CONSTANT, DRIVE, OVER_ANGLE),
        "angle: 200 deg",
        "angle: 370 deg",
        "load.points",
        "points:",
        "span a cycle of 360 deg or more",
        "delete the point at the end",
    ),
    "distances that fall": (
        file(CRANK, DRIVE, TOOL),
        "distance: 4 mm",
        "distance: 0.9 mm",
        "load.points[1].distance",
        "distance: 0.9 mm",
        "not above that of the point before",
        "sort the points",
    ),
    "angles of an energy that fall": (
        file(CONSTANT, DRIVE, ENERGY),
        "angle: 95 deg",
        "angle: 4 deg",
        "potential[0].points[1].angle",
        "angle: 4 deg",
        "not above that of the point before",
        "sort the points",
    ),
    "an energy whose first point comes again": (
        file(CONSTANT, DRIVE, ENERGY),
        "angle: 185 deg",
        "angle: 365 deg",
        "potential[0].points",
        "points:",
        "span a cycle of 360 deg or more",
        "delete the point at the end",
    ),
    "a tool on a constant inertia": (
        file(CONSTANT, DRIVE, SECTORS),
        SECTORS,
        TOOL,
        "load.type",
        "type: tool_force",
        "only a slider-crank has a tool for a force",
        "`inertia: {type: slider_crank, ...}`",
    ),
    "a spring at the tool of a table": (
        file(TABLE, DRIVE, WEIGHT),
        WEIGHT,
        BALANCE,
        "potential[0].type",
        "type: tool_spring",
        "only a slider-crank has a tool for a spring",
        "`inertia: {type: slider_crank, ...}`",
    ),
    "a slider-crank that does not repeat itself": (
        file(CRANK, DRIVE),
        CRANK,
        "cycle_angle: 540 deg\n" + CRANK,
        "cycle_angle",
        "cycle_angle:",
        "the slider-crank has no period of 540 deg",
        "usually `360 deg`",
    ),
    "a harmonic that does not repeat itself": (
        file(HARMONICS, DRIVE),
        HARMONICS,
        "cycle_angle: 120 deg\n" + HARMONICS,
        "cycle_angle",
        "cycle_angle:",
        "the harmonic of order 2 has no period of 120 deg",
        "usually `360 deg`",
    ),
    "an unbalance that does not repeat itself": (
        file(CONSTANT, DRIVE, WEIGHT),
        CONSTANT,
        "cycle_angle: 180 deg\n" + CONSTANT,
        "cycle_angle",
        "cycle_angle:",
        "the unbalance has no period of 180 deg",
        "usually `360 deg`",
    ),
    "a wave of the weights that does not repeat itself": (
        file(CONSTANT, DRIVE, WAVE),
        CONSTANT,
        "cycle_angle: 100 deg\n" + CONSTANT,
        "cycle_angle",
        "cycle_angle:",
        "the harmonic of order 3 has no period of 100 deg",
        "usually `360 deg`",
    ),
    "an efficiency that nothing uses": (
        file(CONSTANT, DRIVE),
        "efficiency: 0.9}",
        "efficiency: 0.9, reverse_efficiency: 0.8, braking: multiplies}",
        "drive.gear.reverse_efficiency",
        "reverse_efficiency",
        "`braking: multiplies` uses `efficiency` in both directions",
        "`braking: divides`",
    ),
    "a brake that is not there": (
        file(CONSTANT, DRIVE, BRAKE, SCENES.replace("run_out", "run_out, brake: on")),
        BRAKE,
        "",
        "scenes[2].brake",
        "brake: on",
        "the machine has no brake",
        "write `off`",
    ),
    "a run-up without an end": (
        file(CONSTANT, DRIVE, SCENES),
        DRIVE,
        ALWAYS,
        "scenes[0]",
        "{type: run_up}",
        "the final speed of the run-up is not defined",
        "`to: 60 rpm`",
    ),
    "a run-up without an end that nobody wrote": (
        file(CONSTANT, DRIVE),
        DRIVE,
        ALWAYS,
        "",
        "kind",
        "the final speed of the run-up is not defined",
        "`scenes: [{type: run_up, to: 60 rpm}, {type: steady}, {type: run_out}]`",
    ),
    "a curve of the motor that never falls to 0": (
        file(CONSTANT, DRIVE, SCENES),
        "{type: linear, starting_torque: 200 N*m, no_load_speed: 100 rad/s}",
        "{type: table, points: [{speed: 0 rad/s, torque: 9 N*m}, {speed: 9 rad/s, torque: 8 N*m}]}",
        "scenes[0]",
        "{type: run_up}",
        "the final speed of the run-up is not defined",
        "`to: 60 rpm`",
    ),
    "two scenes of one name": (
        file(CONSTANT, DRIVE, SCENES),
        "{type: steady}",
        "{type: steady}\n  - {type: steady, load: idle}",
        "scenes[2]",
        "{type: steady, load: idle}",
        "two scenes have the name `steady`",
        "give this one a `name:` of its own",
    ),
}


@pytest.mark.parametrize("case", FAULTS)
def test_what_does_not_fit_is_told_at_its_place(case: str) -> None:
    sound, part, faulty, path, words, message, hint = FAULTS[case]
    assert sound.count(part) == 1
    assert read(sound).spec is not None
    text = sound.replace(part, faulty)
    problem = problem_in(text)
    assert (problem.code, dotted(problem.path)) == ("SPC113", path)
    assert place(problem) == place_of(text, words)
    assert message in problem.message
    assert hint in problem.hint


# (case, what is written instead of what): what the hint says, copied
COPIED = [
    ("a sector that ends before it begins", "to: 90 deg", "to: 450 deg"),
    ("a sector of no width", "to: 270 deg", "to: 630 deg"),
    ("an efficiency that nothing uses", "braking: multiplies", "braking: divides"),
    ("a brake that is not there", "brake: on", "brake: off"),
    ("a run-up without an end", "{type: run_up}", "{type: run_up, to: 60 rpm}"),
    ("a curve of the motor that never falls to 0", "{type: run_up}", "{type: run_up, to: 60 rpm}"),
    (
        "a run-up without an end that nobody wrote",
        "kind: shaft\n",
        "kind: shaft\nscenes: [{type: run_up, to: 60 rpm}, {type: steady}, {type: run_out}]\n",
    ),
    ("a slider-crank that does not repeat itself", "540 deg", "360 deg"),
    ("a harmonic that does not repeat itself", "120 deg", "360 deg"),
    ("an unbalance that does not repeat itself", "180 deg", "360 deg"),
    ("two scenes of one name", "{type: steady, load: idle}", "{type: steady, load: idle, name: idling}"),
]


@pytest.mark.parametrize(("case", "old", "new"), COPIED, ids=[case for case, *_ in COPIED])
def test_the_hint_can_be_copied(case: str, old: str, new: str) -> None:
    sound, part, faulty, *_ = FAULTS[case]
    text = sound.replace(part, faulty)
    assert text.count(old) == 1
    assert read(text.replace(old, new)).diagnostics == ()


def test_a_cycle_of_two_turns_repeats_whatever_comes_once_a_turn() -> None:
    for parts in ((CRANK, DRIVE, TOOL), (HARMONICS, DRIVE, WEIGHT), (CONSTANT, DRIVE, WAVE)):
        assert read(file("cycle_angle: 720 deg\n", *parts)).diagnostics == ()
    assert read(file("cycle_angle: 180 deg\n", HARMONICS, DRIVE)).diagnostics == ()


def test_several_faults_are_told_at_once() -> None:
    text = file(CONSTANT, ALWAYS, TOOL, BALANCE, SCENES.replace("run_out", "run_out, brake: on"))
    found = {dotted(d.path) for d in read(text).diagnostics}
    assert found == {"load.type", "potential[0].type", "scenes[0]", "scenes[2].brake"}


# --- values that disagree --------------------------------------------------------------------------------------------

# (file, path, words at which it stands, words of the message, old and new that mend it)
DISAGREEING = [
    (
        file("speed: 11 rad/s\n", CONSTANT, DRIVE),
        "speed",
        "11 rad/s",
        "motor and gear result in 95.49 rpm without load, the file states 105",
        ("speed: 11 rad/s", "speed: 10 rad/s"),
    ),
    (
        file("speed: 8 rad/s\n", CONSTANT, DRIVE),
        "speed",
        "8 rad/s",
        "motor and gear result in 95.49 rpm without load, the file states 76",
        ("ratio: 10", "ratio: 12"),
    ),
    (
        file(CONSTANT, DRIVE, SCENES.replace("run_up", "run_up, to: 10 rad/s")),
        "scenes[0].to",
        "10 rad/s}",
        "where the motor torque is zero",
        ("to: 10 rad/s", "to: 9.9 rad/s"),
    ),
    (
        file(CONSTANT, DRIVE, WEIGHT.replace("4 kg", "400 kg"), "brake: {torque: 190 N*m, delay: 0 s}\n"),
        "brake.torque",
        "190 N*m",
        "above the holding torque of brake and friction",
        ("torque: 190", "torque: 200"),
    ),
    (
        file(CRANK, DRIVE, TOOL.replace("4 mm", "121 mm")),
        "load.points[1].distance",
        "121 mm",
        "the slider moves by 120 mm",
        ("distance: 121 mm", "distance: 120 mm"),
    ),
]


@pytest.mark.parametrize(("text", "path", "words", "message", "mend"), DISAGREEING, ids=[c[2] for c in DISAGREEING])
def test_values_that_disagree_are_a_warning(
    text: str, path: str, words: str, message: str, mend: tuple[str, str]
) -> None:
    problem = problem_in(text, Severity.WARNING)
    assert (problem.code, dotted(problem.path)) == ("SPC201", path)
    assert place(problem) == place_of(text, words)
    assert message in problem.message
    assert problem.hint
    assert read(text.replace(*mend)).diagnostics == ()


# --- words and blocks ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("old", "new", "meant"),
    [
        ("rod_length", "rod_lenght", "rod_length"),
        ("slider_mass", "slide_mass", "slider_mass"),
        ("distance: 4", "distence: 4", "distance"),
        ("delay", "dealy", "delay"),
        ("efficiency", "eficiency", "efficiency"),
        ("brake:", "break:", "brake"),
    ],
)
def test_a_misspelt_key_is_found_with_the_one_that_is_meant(old: str, new: str, meant: str) -> None:
    text = SOUND[0].replace(old, new)
    problems = read(text).diagnostics
    problem = next(d for d in problems if d.code == "SPC104")
    assert place(problem) == place_of(text, new.split(":")[0] + ":")
    assert f"`{meant}`" in problem.hint


@pytest.mark.parametrize(
    ("old", "new", "meant"),
    [
        ("type: tool_force", "type: tool_forces", "tool_force"),
        ("type: tool_spring", "type: toolspring", "tool_spring"),
        ("type: steady", "type: stedy", "steady"),
        ("type: tool_force", "type: tool_force\n  stroke: aproach", "approach"),
        ("type: tool_force", "type: tool_force\n  dead_centre: fare", "far"),
        ("efficiency: 0.9", "efficiency: 0.9, braking: divide", "divides"),
        ("type: run_up", "type: run_up, load: ful", "full"),
        ("type: run_out", "type: run_out, after: idel", "idle"),
    ],
)
def test_a_misspelt_word_is_found_with_the_one_that_is_meant(old: str, new: str, meant: str) -> None:
    text = SOUND[0].replace(old, new)
    problem = problem_in(text)
    assert problem.code == "SPC112"
    assert place(problem)[0] == place_of(text, new.split()[-1])[0]
    assert f"`{meant}`" in problem.hint


def test_effects_and_checks_of_other_kinds_are_not_known() -> None:
    text = SOUND[0] + "effects: {elasticity: off}\nchecks:\n  DRV101: {off: no link}\n"
    assert [(d.code, dotted(d.path)) for d in read(text).diagnostics] == [
        ("SPC104", "effects.elasticity"),
        ("SPC104", "checks.DRV101"),
    ]


def test_without_scenes_there_are_three() -> None:
    found = read(SOUND[1]).spec
    assert isinstance(found, Shaft)
    assert [type(scene) for scene in found.all_scenes] == [RunUp, Steady, RunOut]


def test_the_template_says_nothing() -> None:
    result = read(load_kind("shaft").template)
    assert result.spec is not None
    assert result.diagnostics == ()


# --- numbers ---------------------------------------------------------------------------------------------------------

EVERYTHING = """\
kind: shaft
name: everything
description: a machine with every key
gravity: 9.81 m/s^2
effects: {varying_inertia: auto}
speed: 9.8 rad/s
cycle_angle: 360 deg
inertia:
  type: slider_crank
  crank_radius: 60 mm
  rod_length: 480 mm
  offset: 10 mm
  crank_inertia: 260 kg*m^2
  slider_mass: 420 kg
  rod_mass: 90 kg
  rod_centre: 0.3
  rod_inertia: 1.9 kg*m^2
  inclination: 90 deg
drive:
  motor: {type: linear, starting_torque: 200 N*m, no_load_speed: 100 rad/s}
  motor_inertia: 0.02 kg*m^2
  gear: {ratio: 10, efficiency: 0.9, reverse_efficiency: 0.8, braking: divides}
load:
  type: tool_force
  points:
    - {distance: 1 mm, force: 60 kN}
    - {distance: 4 mm, force: 90 kN}
  stroke: approach
  dead_centre: far
losses: {torque: 20 N*m, viscous: 1 N*m*s/rad, share: 5 %}
potential:
  - {type: tool_spring, force: 5 kN, stiffness: 4 N/mm}
  - {type: unbalance, mass: 4 kg, radius: 50 mm, top: 10 deg}
  - {type: harmonic, order: 3, sine: 4 N*m, cosine: 3 N*m}
  - type: energy
    points:
      - {angle: 5 deg, energy: 1 J}
      - {angle: 95 deg, energy: 2 J}
      - {angle: 185 deg, energy: 3 J}
brake: {torque: 600 N*m, delay: 60 ms, rise: 40 ms}
checks: {irregularity: 50 %, run_up_time: 10 s, stop_angle: 3000 deg, stop_time: 20 s, breakdown_share: 0.81}
scenes:
  - {type: run_up, name: up, from: 10 deg, to: 9 rad/s, load: idle}
  - {type: steady, name: work, load: full}
  - {type: run_out, name: down, from: 30 deg, brake: "on", load: idle, after: full}
"""
DATA: dict[str, Any] = yaml.safe_load(EVERYTHING)
WRONG = [(".nan", "SPC111"), (".inf", "SPC111"), ("-.inf", "SPC111"), ("1e300", "SPC109")]


def _numbers(node: Any, path: KeyPath = ()) -> Iterator[KeyPath]:
    """Paths of all values with a unit, and of bare numbers."""
    items = node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ()
    for key, value in items:
        if isinstance(value, int | float) or (isinstance(value, str) and value[:1].isdigit()):
            yield (*path, key)
        yield from _numbers(value, (*path, key))


NUMBERS = [path for path in _numbers(DATA) if path[-1] != "order"]


def _replaced(path: KeyPath, value: Any) -> str:
    data = yaml.safe_load(EVERYTHING)
    node: Any = data
    for step in path[:-1]:
        node = node[step]
    node[path[-1]] = value
    return str(yaml.safe_dump(data, sort_keys=False))


def _unit(path: KeyPath) -> str:
    node: Any = DATA
    for step in path:
        node = node[step]
    return node.partition(" ")[2] if isinstance(node, str) else ""


@pytest.mark.parametrize(("index", "path"), list(enumerate(NUMBERS)), ids=[dotted(path) for path in NUMBERS])
def test_a_number_that_is_none_or_infinite_or_too_large_is_blamed_itself(index: int, path: KeyPath) -> None:
    for value, _ in (WRONG[index % 4], WRONG[(index + 3) % 4]):
        unit = _unit(path)
        plain = float(value.replace(".n", "n").replace(".i", "i"))
        diagnostics = read(_replaced(path, f"{value} {unit}" if unit else plain)).diagnostics
        mine = [d for d in diagnostics if d.path == path]
        assert len(mine) == 1, (value, [(d.code, d.message) for d in diagnostics])
        assert mine[0].severity is Severity.ERROR
        assert mine[0].span is not None


@pytest.mark.parametrize(("index", "path"), list(enumerate(NUMBERS)), ids=[dotted(path) for path in NUMBERS])
def test_any_number_may_be_0_or_negative_without_a_crash(index: int, path: KeyPath) -> None:
    """Either it is sound, or something is said, at this number or where it meets another one."""
    unit = _unit(path)
    for number in (0, -3):
        result = read(_replaced(path, f"{number} {unit}" if unit else number))
        assert (result.spec is None) == any(d.severity == "error" for d in result.diagnostics)
        assert all(d.hint and d.span is not None for d in result.diagnostics)


@pytest.mark.parametrize("path", [path for path in NUMBERS if _unit(path) not in ("", "%")], ids=dotted)
def test_a_number_without_its_unit_is_told_with_one(path: KeyPath) -> None:
    (problem,) = read(_replaced(path, 7)).diagnostics
    assert problem.path == path
    assert "unit" in problem.message
    assert problem.hint
    assert problem.span is not None


def _keys(annotation: Any, data: Any) -> Iterator[tuple[str, str]]:
    """The keys that data uses, each with the model that declares it."""
    model = model_of(annotation, data) if isinstance(data, dict) else None
    items = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
    for key, value in items:
        if model is not None and key in keys_of(model):
            yield _declared(model, key)
        yield from _keys(inner(annotation, key, data), value)


def _declared(model: type[BaseModel], key: str) -> tuple[str, str]:
    name = next(name for name, field in model.model_fields.items() if (field.alias or name) == key)
    return next(one.__name__ for one in reversed(model.__mro__) if name in inspect.get_annotations(one)), key


def test_the_files_of_these_tests_use_every_key() -> None:
    models = [
        one
        for one in vars(spec).values()
        if isinstance(one, type) and issubclass(one, BaseModel) and one.__module__ == spec.__name__
    ]
    wanted = {_declared(model, key) for model in models for key in keys_of(model)}
    used = {key for text in (EVERYTHING, *SOUND) for key in _keys(Shaft, yaml.safe_load(text))}
    assert len(wanted) > 70
    of_any_kind = {("MachineSpec", key) for key in ("accuracy", "project", "tolerances", "waive")}
    assert wanted - used == of_any_kind | {("Harmonic", "sine")}


def test_a_file_with_everything_in_it_is_read_and_computed() -> None:
    assert [type(scene) for scene in spec_of(DATA).all_scenes] == [RunUp, Steady, RunOut]
    assert loaded(DATA).diagnostics == ()
    report = report_of(DATA)
    assert [scene.name for scene in report.scenes] == ["up", "work", "down"]
    assert all(load.estimate.bounded for scene in report.scenes for load in scene.loads)


def test_values_are_si_in_the_quantity_of_their_kind() -> None:
    shaft = spec_of(DATA)
    assert shaft.checks.stop_angle == pytest.approx(3000 * 3.141592653589793 / 180)
    assert shaft.losses.share == pytest.approx(0.05)
    for path, name in [
        ("inertia.crank_inertia", "moment of inertia"),
        ("inertia.slider_mass", "mass"),
        ("inertia.inclination", "angle"),
        ("load.points[0].force", "force"),
        ("losses.torque", "torque"),
        ("potential[0].stiffness", "force per length"),
        ("potential[3].points[0].energy", "energy"),
        ("scenes[0].to", "rotational speed"),
        ("brake.delay", "time"),
    ]:
        measure = measure_at(shaft, key_path(path))
        assert measure is not None, path
        assert measure.quantity.name == name, path
