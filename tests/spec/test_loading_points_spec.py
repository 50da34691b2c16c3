"""Loading points as a designer writes them: one clear message for each mistake, with what to do."""

from functools import partial

import pytest
from support import design_files
from support.design_files import problem_in, read

from ptmcalc.base.diagnostic import Severity
from ptmcalc.base.span import dotted
from ptmcalc.machines.conveyor.machine.spec import Conveyor

MACHINE = """\
kind: conveyor
route: {length: 600 m, lift: 24 m}
belt: {mass: 20 kg/m, stiffness: 40 MN}
idlers:
  carry: {line_mass: 20 kg/m}
  return: {line_mass: 8 kg/m}
load:
  density: 1600 kg/m^3
  surcharge_angle: 15 deg
  loading_points:
    tail_hopper: {at: 0 m, capacity: 300 t/h}
    side_belt: {at: 420 m, capacity: 600 t/h, skirt: {width: 700 mm, length: 4 m, friction: 0.6}}
resistance:
  coefficient: 0.02
  secondary: 1.2
  start_factor: 1.2
  forces:
    tripper: {force: 1 kN, at: carry}
speed: 4 m/s
drive:
  motor: {inertia: 5 kg*m^2, mean_starting_torque: 4 kN*m}
  coupling_inertia: 1 kg*m^2
  gear: {ratio: 20, efficiency: 0.94}
  drum: {diameter: 1000 mm, wrap: 200 deg, friction: 0.35, inertia: 200 kg*m^2}
takeup: {type: gravity, tension: 120 kN}
tail_drum: {inertia: 50 kg*m^2, diameter: 800 mm}
scenes:
  - {type: run, loading_points: [side_belt]}
  - {type: run}
"""
edited = partial(design_files.edited, MACHINE)
TAIL = "tail_hopper: {at: 0 m, capacity: 300 t/h}"
SIDE = "side_belt: {at: 420 m, capacity: 600 t/h, skirt: {width: 700 mm, length: 4 m, friction: 0.6}}"
SCENE = "- {type: run, loading_points: [side_belt]}"
NAMED = "scenes[0].loading_points"

FAULTS: dict[str, tuple[tuple[tuple[str, str], ...], str, str, str]] = {
    "capacity and points": (
        (("density: 1600 kg/m^3", "density: 1600 kg/m^3\ncapacity: 900 t/h"),),
        "load.capacity",
        "the `loading_points` have capacities of their own",
        "delete `capacity`, or `loading_points`",
    ),
    "mass and points": (
        (("density: 1600 kg/m^3", "density: 1600 kg/m^3\nmass: 60 kg/m"),),
        "load.mass",
        "the `loading_points` have capacities of their own",
        "delete `mass`, or `loading_points`",
    ),
    "beyond the route": (
        ((SIDE, "side_belt: {at: 620 m, capacity: 600 t/h}"),),
        "load.loading_points.side_belt.at",
        "the route ends at 600 m",
        "as `at: 300 m`",
    ),
    "two at one place": (
        ((SIDE, "side_belt: {at: 0 m, capacity: 600 t/h}"),),
        "load.loading_points.side_belt.at",
        "it is at the place of `tail_hopper`",
        "write another `at`, or one point with the sum of both capacities",
    ),
    "plates without a density": (
        (("density: 1600 kg/m^3", ""), ("surcharge_angle: 15 deg", "")),
        "load.loading_points.side_belt.skirt",
        "`skirt` plates require the bulk density: it is missing",
        "add `density: 1600 kg/m^3` under `load`",
    ),
    "a name of two words": (
        ((TAIL, "tail hopper: {at: 0 m, capacity: 300 t/h}"),),
        "load.loading_points.tail hopper",
        "a name is one word",
        "write `tail_hopper:`",
    ),
    "plates among the forces": (
        (("tripper: {force: 1 kN, at: carry}", "plates: {skirt: {width: 1 m, length: 2 m, friction: 0.6}}"),),
        "resistance.forces.plates.skirt",
        "with `loading_points` the force of `skirt` is at each of them",
        "delete it, and write `skirt` under a loading point",
    ),
    "an unknown point": (
        ((SCENE, "- {type: run, loading_points: [side_bell]}"),),
        f"{NAMED}[0]",
        "the load has no loading point `side_bell`",
        "write `side_belt`",
    ),
    "a point twice": (
        ((SCENE, "- {type: run, loading_points: [side_belt, side_belt]}"),),
        f"{NAMED}[1]",
        "`side_belt` is named twice",
        "delete one of both",
    ),
    "points of an empty belt": (
        ((SCENE, "- {type: run, load: empty, loading_points: [side_belt]}"),),
        NAMED,
        "an empty belt has no loading point in operation",
        "delete it, or write `load: full`",
    ),
    "points that the file does not have": (
        (("loading_points:", "capacity: 900 t/h"), (TAIL, ""), (SIDE, "")),
        NAMED,
        "the `load` of the file has no `loading_points`",
        "write `load: full`, or add `loading_points` under `load`",
    ),
}


def test_the_machine_of_these_tests_is_sound() -> None:
    found = read(MACHINE)
    assert found.diagnostics == ()
    assert isinstance(found.spec, Conveyor)
    assert [scene.label for scene in found.spec.all_scenes] == ["run_side_belt", "run_loaded"]


@pytest.mark.parametrize("case", FAULTS)
def test_each_mistake_has_one_message_with_what_to_do(case: str) -> None:
    edits, path, reason, hint = FAULTS[case]
    problem = problem_in(edited(*edits))
    assert problem.code == "SPC113"
    assert dotted(problem.path) == path
    assert reason in problem.message
    assert problem.hint is not None
    assert problem.hint.endswith(hint)


@pytest.mark.parametrize(
    ("edit", "path"),
    [
        ((TAIL, "tail_hopper: {at: -3 m, capacity: 300 t/h}"), "load.loading_points.tail_hopper.at"),
        ((TAIL, "tail_hopper: {at: 3, capacity: 300 t/h}"), "load.loading_points.tail_hopper.at"),
        ((TAIL, "tail_hopper: {capacity: 300 t/h}"), "load.loading_points.tail_hopper.at"),
        ((TAIL, "tail_hopper: {at: 0 m}"), "load.loading_points.tail_hopper.capacity"),
        ((SCENE, "- {type: run, loading_points: []}"), NAMED),
    ],
    ids=["before the tail", "no unit", "no place", "no capacity", "no point"],
)
def test_a_wrong_value_is_blamed_itself(edit: tuple[str, str], path: str) -> None:
    problem = problem_in(edited(edit))
    assert dotted(problem.path) == path
    assert problem.hint


def test_the_friction_of_plates_left_out_is_assumed() -> None:
    found = read(MACHINE.replace(", friction: 0.6", ""))
    (assumed,) = found.assumed
    assert dotted(assumed.path) == "load.loading_points.side_belt.skirt.friction"
    assert (assumed.interval.low, assumed.value, assumed.interval.high) == (0.5, 0.6, 0.7)


def test_a_load_that_no_belt_carries_is_noted_at_its_point() -> None:
    problem = problem_in(edited((TAIL, "tail_hopper: {at: 0 m, capacity: 300 kg/h}")), Severity.WARNING)
    assert (problem.code, dotted(problem.path)) == ("SPC201", "load.loading_points.tail_hopper.capacity")


def test_a_misspelt_key_is_said_once() -> None:
    problem = problem_in(MACHINE.replace("  loading_points:", "  loading_point:"))
    assert (problem.code, dotted(problem.path)) == ("SPC104", "load.loading_point")
