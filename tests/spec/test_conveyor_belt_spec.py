"""What a designer writes of trough, load, curves, transitions and forces with a name: what is missing, what disagrees.

A key that is too much is blamed itself, a missing one is blamed on the key of its block, a wrong value on the value.
"""

from functools import partial

import pytest
from support import design_files
from support.design_files import problem_in, read

from ptmcalc.base.diagnostic import Diagnostic, Severity
from ptmcalc.base.span import dotted
from ptmcalc.machines.conveyor.machine.spec import Conveyor

MACHINE = """\
kind: conveyor
route:
  sections:
    - length: 200 m
      lift: -4 m
      carry_pitch: 1 m
    - length: 300 m
      lift: 22 m
      curve_radius: 800 m
belt:
  width: 1000 mm
  mass: 20 kg/m
  stiffness: 40 MN
  strength: 2000 N/mm
  carcass: steel_cord
  warp: steel_cord
  carcass_thickness: 6.4 mm
idlers:
  carry:
    pitch: 1.2 m
    set_mass: 20 kg
    trough: {angle: 35 deg, middle_roll: 380 mm}
  return:
    pitch: 3 m
    set_mass: 24 kg
load:
  capacity: 1700 t/h
  density: 1600 kg/m^3
  surcharge_angle: 15 deg
transitions:
  head: {length: 2 m, pulley_lift: 60 mm}
  tail: {length: 2 m}
resistance:
  coefficient: 0.022
  secondary_force: 12 kN
  start_factor: 1.2
  forces:
    skirt:
      skirt: {width: 600 mm, length: 5 m, friction: 0.6}
    scraper:
      scraper: {width: 900 mm, thickness: 15 mm, pressure: 50 kPa, friction: 0.6}
      at: return
    chute:
      loading: {speed: 1 m/s}
    tripper:
      force: 1 kN
      at: carry
speed: 4 m/s
drive:
  motor: {inertia: 5 kg*m^2, mean_starting_torque: 4 kN*m}
  coupling_inertia: 1 kg*m^2
  gear: {ratio: 20, efficiency: 0.94}
  drum: {diameter: 1000 mm, wrap: 200 deg, friction: 0.35, inertia: 200 kg*m^2}
takeup: {type: gravity, tension: 120 kN}
tail_drum: {inertia: 50 kg*m^2, diameter: 800 mm}
scenes: [{type: run}]
"""
edited = partial(design_files.edited, MACHINE)

CEMA = (
    ("coefficient: 0.022", "cema: {roll: 6in, flexure: 0.03, temperature: 1}"),
    ("secondary_force: 12 kN", "secondary_force: 2 kN"),
)


def at(problem: Diagnostic, text: str) -> str:
    """What stands where a problem is shown."""
    assert problem.span is not None
    return text.splitlines()[problem.span.line - 1][problem.span.column - 1 :]


@pytest.mark.parametrize("edits", [(), CEMA], ids=["iso", "cema"])
def test_the_machine_of_these_tests_is_sound(edits: tuple[tuple[str, str], ...]) -> None:
    found = read(edited(*edits))
    assert found.diagnostics == ()
    assert isinstance(found.spec, Conveyor)
    assert found.assumed == ()


FAULTS: dict[str, tuple[tuple[tuple[str, str], ...], str, str, str]] = {
    "a curve into the first section": (
        (("carry_pitch: 1 m", "curve_radius: 300 m"),),
        "route.sections[0].curve_radius",
        "curve_radius: 300 m",
        "write it under the section after the curve",
    ),
    "a diameter and a carcass": (
        (("warp: steel_cord", "warp: steel_cord\nminimum_drum_diameter: 900 mm"),),
        "belt.carcass_thickness",
        "carcass_thickness:",
        "delete `carcass_thickness`",
    ),
    "a carcass of an unknown material": ((("warp: steel_cord", ""),), "belt", "belt:", "add `warp: cotton`"),
    "a textile carcass of steel": (
        (("carcass: steel_cord", "carcass: textile"),),
        "belt.warp",
        "warp:",
        "delete `warp`, or correct `carcass`",
    ),
    "a surcharge of nothing": (
        (("density: 1600 kg/m^3", ""), ("skirt: {width: 600 mm, length: 5 m, friction: 0.6}", "force: 1 kN")),
        "load",
        "load:",
        "add `density: 1600 kg/m^3`",
    ),
    "skirts beside an unknown load": (
        (("density: 1600 kg/m^3", ""), ("surcharge_angle: 15 deg", "")),
        "load",
        "load:",
        "add `density: 1600 kg/m^3`",
    ),
    "a force and a scraper": (
        (("force: 1 kN", "force: 1 kN\nscraper: {width: 1 m, thickness: 10 mm, pressure: 50 kPa, friction: 0.6}"),),
        "resistance.forces.tripper.scraper",
        "scraper:",
        "delete `scraper`",
    ),
    "a force of nothing": ((("force: 1 kN", ""),), "resistance.forces.tripper", "tripper:", "add `force: 1.5 kN`"),
    "skirts on the return strand": (
        (("at: return", "at: carry"), ("skirt:", "skirt:\n  at: return")),
        "resistance.forces.skirt.at",
        "at: return",
        "write `at: tail`, or `at: carry`",
    ),
    "a loading point beside C": (
        (("secondary_force: 12 kN", "secondary: 1.1"),),
        "resistance.forces.chute.loading",
        "loading:",
        "give `secondary_force` instead of C",
    ),
    "a motor faster under load than without": (
        (
            (
                "motor: {inertia: 5 kg*m^2, mean_starting_torque: 4 kN*m}",
                "motor: {inertia: 5 kg*m^2, mean_starting_torque: 4 kN*m, speed: 1500 rpm, no_load_speed: 1480 rpm}",
            ),
        ),
        "drive.motor.no_load_speed",
        "no_load_speed:",
        "check both speeds",
    ),
    "cema and a coefficient": (
        (("secondary_force: 12 kN", "secondary_force: 12 kN\ncema: {roll: 6in, flexure: 0.03, temperature: 1}"),),
        "resistance.coefficient",
        "coefficient:",
        "delete `coefficient`, or `cema`",
    ),
    "cema without its rolls": (
        (("coefficient: 0.022", "cema: {flexure: 0.03}"), CEMA[1]),
        "resistance.cema",
        "cema:",
        "add `idler_drag: 7 N`",
    ),
    "cema with a drag and rolls": (
        (("coefficient: 0.022", "cema: {idler_drag: 8 N, roll: 6in, flexure: 0.03}"), CEMA[1]),
        "resistance.cema.roll",
        "roll:",
        "delete `roll`",
    ),
    "cema without idler sets": (
        (*CEMA, ("pitch: 1.2 m", ""), ("set_mass: 20 kg", "line_mass: 20 kg/m")),
        "idlers.carry",
        "carry:",
        "add `pitch: 1200 mm`",
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", FAULTS)
def test_what_does_not_go_together_is_said_once_at_its_place_with_what_to_do(case: str) -> None:
    edits, path, words, hint = FAULTS[case]
    text = edited(*edits)
    problem = problem_in(text)
    assert problem.code == "SPC113"
    assert dotted(problem.path) == path
    assert problem.hint == hint
    assert at(problem, text).startswith(words)


TROUGH = "trough: {angle: 35 deg, middle_roll: 380 mm}"
SCRAPER = "scraper: {width: 900 mm, thickness: 15 mm, pressure: 50 kPa, friction: 0.6}"
VALUES: dict[str, tuple[tuple[str, str], str, str, str]] = {
    "a trough that is no trough": (
        (TROUGH, TROUGH.replace("35", "80")),
        "SPC110",
        "idlers.carry.trough.angle",
        "80 deg",
    ),
    "a bare angle": ((TROUGH, TROUGH.replace("35 deg", "35")), "SPC106", "idlers.carry.trough.angle", "35,"),
    "a line mass for a density": (("density: 1600 kg/m^3", "density: 1600 kg/m"), "SPC105", "load.density", "1600"),
    "a surcharge too steep": (
        ("surcharge_angle: 15 deg", "surcharge_angle: 50 deg"),
        "SPC110",
        "load.surcharge_angle",
        "50 deg",
    ),
    "a force for a pressure": (
        (SCRAPER, SCRAPER.replace("50 kPa", "50 N")),
        "SPC105",
        "resistance.forces.scraper.scraper.pressure",
        "50 N",
    ),
    "rolls CEMA does not have": (
        ("coefficient: 0.022", "cema: {roll: 8in, flexure: 0.03}"),
        "SPC112",
        "resistance.cema.roll",
        "8in",
    ),
    "a misspelt radius": (
        ("curve_radius: 800 m", "curve_radus: 800 m"),
        "SPC104",
        "route.sections[1].curve_radus",
        "curve_radus",
    ),
    "a horizontal curve without its radius": (
        ("carry_pitch: 1 m", "horizontal_curve: {banking: 5 deg}"),
        "SPC103",
        "route.sections[0].horizontal_curve.radius",
        "horizontal_curve",
    ),
    "banking beyond any idler": (
        ("carry_pitch: 1 m", "horizontal_curve: {radius: 900 m, banking: 35 deg}"),
        "SPC110",
        "route.sections[0].horizontal_curve.banking",
        "35 deg",
    ),
    "a curve that goes round more than once": (
        ("carry_pitch: 1 m", "horizontal_curve: {radius: 20 m}"),
        "SPC113",
        "route.sections[0].horizontal_curve.radius",
        "radius: 20 m",
    ),
    "a transition elsewhere": (("tail: {length: 2 m}", "tial: {length: 2 m}"), "SPC104", "transitions.tial", "tial"),
    "a transition without its length": (
        ("tail: {length: 2 m}", "tail: {pulley_lift: 60 mm}"),
        "SPC103",
        "transitions.tail.length",
        "tail:",
    ),
}


@pytest.mark.parametrize("case", VALUES)
def test_a_wrong_value_is_blamed_itself_with_a_hint(case: str) -> None:
    edit, code, path, words = VALUES[case]
    text = edited(edit)
    problem = problem_in(text)
    assert (problem.code, dotted(problem.path)) == (code, path)
    assert problem.hint
    assert at(problem, text).startswith(words)


def warnings_of(text: str) -> list[Diagnostic]:
    result = read(text)
    assert result.spec is not None, [(d.code, d.message) for d in result.diagnostics]
    return [d for d in result.diagnostics if d.severity is Severity.WARNING]


@pytest.mark.parametrize(
    ("edits", "path", "words"),
    [
        ((("lift: 22 m", "lift: -6 m"),), "route.sections[1].curve_radius", "same slope"),
        ((("curve_radius: 800 m", "curve_radius: 5 km"),), "route.sections[1].curve_radius", "a length of 200 m"),
    ],
    ids=["nothing curves", "no room"],
)
def test_a_curve_that_cannot_be_is_warned_of(edits: tuple[tuple[str, str], ...], path: str, words: str) -> None:
    (warning,) = warnings_of(edited(*edits))
    assert (warning.code, dotted(warning.path)) == ("SPC201", path)
    assert words in warning.message
    assert warning.hint


ASSUMED = {
    "resistance.forces.skirt.skirt.friction": (
        ("skirt: {width: 600 mm, length: 5 m, friction: 0.6}", "skirt: {width: 600 mm, length: 5 m}"),
        0.6,
    ),
    "resistance.forces.scraper.scraper.friction": (
        (
            "scraper: {width: 900 mm, thickness: 15 mm, pressure: 50 kPa, friction: 0.6}",
            "scraper: {width: 900 mm, thickness: 15 mm, pressure: 50 kPa}",
        ),
        0.6,
    ),
    "load.surcharge_angle": (("surcharge_angle: 15 deg", ""), 0.2617993877991494),
    "resistance.cema.flexure": ((CEMA[0][0], "cema: {roll: 6in, temperature: 1}"), 0.03),
}


@pytest.mark.parametrize("key", ASSUMED)
def test_a_value_left_out_is_assumed_and_listed_with_its_interval(key: str) -> None:
    edit, value = ASSUMED[key]
    result = read(edited(edit))
    assert result.spec is not None
    (assumed,) = result.assumed
    assert dotted(assumed.path) == key
    assert assumed.value == pytest.approx(value)
    assert assumed.interval.low < assumed.value < assumed.interval.high
    assert assumed.source
    assert result.spec.value_at(assumed.path) == assumed.value


def test_beyond_the_table_of_c_the_interval_reaches_down_and_the_source_says_so() -> None:
    long = (
        ("- length: 300 m", "- length: 7800 m"),
        ("secondary_force: 12 kN", ""),
        ("loading: {speed: 1 m/s}", "force: 1 kN"),
    )
    (assumed,) = read(edited(*long)).assumed
    assert dotted(assumed.path) == "resistance.secondary"
    assert assumed.value == 1.05
    assert assumed.interval.low == pytest.approx(1 + 0.75 * 0.05 * 2000 / 8000)
    assert "2000 m" in assumed.source
    (inside,) = read(edited(*long[1:])).assumed
    assert "2000 m" not in inside.source
