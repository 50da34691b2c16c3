"""A drive train as a designer writes it: what ties its parts together, and what is said where they do not fit.

A key that does not go with the others is blamed itself, a missing one on its block, a wrong value on the value.
"""

import inspect
from collections.abc import Iterator
from functools import partial
from typing import Any

import pytest
import yaml
from pydantic import BaseModel
from support import design_files
from support.design_files import place, problem_in, read
from support.drivetrains import EVERYTHING, data_of, spec_of
from support.machines import report_of

from ptmcalc.base.span import KeyPath, dotted, key_path
from ptmcalc.engine.load import measure_at
from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.drivetrain.machine import spec
from ptmcalc.machines.drivetrain.machine.keys import bodies, brakes, gears, inertias, links, torques
from ptmcalc.machines.drivetrain.machine.spec import Drivetrain, Run, Start, Stop
from ptmcalc.spec.shape import inner, keys_of, model_of

MACHINE = """\
kind: drivetrain
inertias:
  motor: {inertia: 1 kg*m^2}
  wheel: {inertia: 2 kg*m^2}
  crane: {mass: 1 t}
  spare: {inertia: 3 kg*m^2}
links:
  shaft:
    between: [motor, wheel]
    stiffness: 10 kN*m/rad
    damping: 3 N*m*s/rad
  tail:
    between: [wheel, spare]
    stiffness: 12 kN*m/rad
    gap: 1 deg
gears:
  rail: {from: wheel, to: crane, radius: 250 mm}
brakes:
  brake: {at: motor, torque: 100 N*m}
motors:
  main: {at: motor, motor: {type: constant, torque: 50 N*m}}
torques:
  wind: {at: crane, type: constant, torque: -1 kN}
resistances:
  rolling: {at: crane, coulomb: 200 N}
motions:
  guided: {at: spare, points: [{time: 0 s, speed: 1 rad/s}, {time: 1 s, speed: 2 rad/s}]}
impulses:
  blow: {at: crane, time: 1 s, size: 3 N*s}
checks:
  stop_angle: 90 deg
scenes:
  - {type: run, duration: 1 s, speed: 10 rad/s}
  - {type: stop, duration: 2 s}
"""
edited = partial(design_files.edited, MACHINE)


def one_edit(old: str, new: str) -> tuple[tuple[str, str], ...]:
    """A part of one line replaced."""
    line = next(line.strip() for line in MACHINE.splitlines() if old in line)
    return ((line, line.replace(old, new)),)


def place_of(text: str, words: str) -> tuple[int, int]:
    """Line and column of words that stand only once in a text."""
    found = [number for number, line in enumerate(text.splitlines()) if words in line]
    assert len(found) == 1, (words, found)
    return found[0] + 1, text.splitlines()[found[0]].index(words) + 1


def test_the_machine_of_these_tests_is_sound() -> None:
    assert read(MACHINE).diagnostics == ()
    assert isinstance(read(MACHINE).spec, Drivetrain)


# --- wiring ----------------------------------------------------------------------------------------------------------

FIRST = "first: {from: motor, to: wheel, ratio: 4}\n"
LAST = FIRST + "last: {from: motor, to: spare, ratio: 2}\n"
GUIDED = "{time: 1 s, speed: 2 rad/s}]}"
# name: (edits, path that is blamed, words at which it stands, words of the message, words of the hint)
WIRING: dict[str, tuple[tuple[tuple[str, str], ...], str, str, str, str]] = {
    "a link to an inertia that is not there": (
        one_edit("between: [motor, wheel]", "between: [motor, weel]"),
        "links.shaft.between[1]",
        "weel]",
        "unknown inertia `weel`",
        "did you mean `wheel`?",
    ),
    "a name like no other": (
        one_edit("between: [motor, wheel]", "between: [xyzzy, wheel]"),
        "links.shaft.between[0]",
        "xyzzy",
        "unknown inertia `xyzzy`",
        "inertias: motor, wheel, crane, spare",
    ),
    "a gear from nowhere": (
        one_edit("rail: {from: wheel", "rail: {from: whel"),
        "gears.rail.from",
        "from: whel",
        "unknown inertia `whel`",
        "did you mean `wheel`?",
    ),
    "a brake on nothing": (
        one_edit("brake: {at: motor", "brake: {at: moter"),
        "brakes.brake.at",
        "at: moter",
        "unknown inertia `moter`",
        "did you mean `motor`?",
    ),
    "a clutch against nothing": (
        one_edit("brake: {at: motor", "brake: {at: motor, against: shaft"),
        "brakes.brake.against",
        "against: shaft",
        "unknown inertia `shaft`",
        "inertias: motor, wheel, crane, spare",
    ),
    "a motor on nothing": (
        one_edit("main: {at: motor", "main: {at: engine"),
        "motors.main.at",
        "at: engine",
        "unknown inertia `engine`",
        "inertias: motor",
    ),
    "a torque on nothing": (
        one_edit("wind: {at: crane", "wind: {at: crain"),
        "torques.wind.at",
        "at: crain",
        "unknown inertia `crain`",
        "did you mean `crane`?",
    ),
    "a resistance on nothing": (
        one_edit("rolling: {at: crane", "rolling: {at: cranes"),
        "resistances.rolling.at",
        "at: cranes",
        "unknown inertia `cranes`",
        "did you mean `crane`?",
    ),
    "a motion of nothing": (
        one_edit("guided: {at: spare", "guided: {at: spar"),
        "motions.guided.at",
        "at: spar,",
        "unknown inertia `spar`",
        "did you mean `spare`?",
    ),
    "an impulse on nothing": (
        one_edit("blow: {at: crane", "blow: {at: carne"),
        "impulses.blow.at",
        "at: carne",
        "unknown inertia `carne`",
        "did you mean `crane`?",
    ),
    "a scene about nothing": (
        one_edit("type: stop, duration: 2 s", "type: stop, duration: 2 s, of: motr"),
        "scenes[1].of",
        "of: motr",
        "unknown inertia `motr`",
        "did you mean `motor`?",
    ),
    "a scene about the ground": (
        one_edit("type: stop, duration: 2 s", "type: stop, duration: 2 s, of: ground"),
        "scenes[1].of",
        "of: ground",
        "unknown inertia `ground`",
        "inertias: motor",
    ),
    "a link to itself": (
        one_edit("between: [motor, wheel]", "between: [motor, motor]"),
        "links.shaft.between[1]",
        "motor]",
        "both ends are `motor`",
        "name two different ones",
    ),
    "a link between the ground and the ground": (
        one_edit("between: [motor, wheel]", "between: [ground, ground]"),
        "links.shaft.between[1]",
        "ground]",
        "both ends are `ground`",
        "name two different ones",
    ),
    "a gear to itself": (
        one_edit("rail: {from: wheel, to: crane", "rail: {from: crane, to: crane"),
        "gears.rail.to",
        "to: crane",
        "both ends are `crane`",
        "name two different ones",
    ),
    "a clutch to itself": (
        one_edit("brake: {at: motor", "brake: {at: motor, against: motor"),
        "brakes.brake.against",
        "against: motor",
        "both ends are `motor`",
        "name two different ones",
    ),
    "a gear to the ground": (
        one_edit("to: crane", "to: ground"),
        "gears.rail.to",
        "to: ground",
        "the ground does not move",
        "name an inertia",
    ),
    "a brake on the ground": (
        one_edit("brake: {at: motor", "brake: {at: ground"),
        "brakes.brake.at",
        "at: ground",
        "the ground does not move",
        "name an inertia",
    ),
    "a motor on the ground": (
        one_edit("main: {at: motor", "main: {at: ground"),
        "motors.main.at",
        "at: ground",
        "the ground does not move",
        "name an inertia",
    ),
    "friction on the ground": (
        one_edit("rolling: {at: crane", "rolling: {at: ground"),
        "resistances.rolling.at",
        "at: ground",
        "the ground does not move",
        "name an inertia",
    ),
    "gears that contradict": (
        one_edit("radius: 250 mm}", "radius: 250 mm}\n" + LAST + "extra: {from: wheel, to: spare, ratio: 3}"),
        "gears.extra",
        "extra:",
        "which make the ratio 0.5",
        "delete one of the gears",
    ),
    "a radius that contradicts a ratio": (
        one_edit("radius: 250 mm}", "radius: 250 mm}\n" + FIRST + "extra: {from: motor, to: crane, radius: 60 mm}"),
        "gears.extra",
        "extra:",
        "which make the radius 0.0625 m",
        "delete one of the gears",
    ),
    "a loop of gears": (
        one_edit("radius: 250 mm}", "radius: 250 mm}\n" + FIRST + "extra: {from: motor, to: crane, radius: 62.5 mm}"),
        "gears.extra",
        "extra:",
        "it closes a loop of gears",
        "delete one of the gears",
    ),
    "the same gear twice": (
        one_edit("radius: 250 mm}", "radius: 250 mm}\nagain: {from: wheel, to: crane, radius: 250 mm}"),
        "gears.again",
        "again:",
        "it closes a loop of gears",
        "delete one of the gears",
    ),
    "a massless free node": (
        one_edit("motor: {inertia: 1 kg*m^2}", "motor: {inertia: 0 kg*m^2}"),
        "inertias.motor.inertia",
        "inertia: 0",
        "a node without inertia",
        "give it an inertia",
    ),
    "a link between turning and travelling": (
        one_edit("between: [motor, wheel]", "between: [motor, crane]"),
        "links.shaft.between[1]",
        "crane]",
        "one end rotates, the other travels",
        "a gear with a `radius`",
    ),
    "a clutch between turning and travelling": (
        one_edit("brake: {at: motor", "brake: {at: motor, against: crane"),
        "brakes.brake.against",
        "against: crane",
        "one end rotates, the other travels",
        "a gear with a `radius`",
    ),
    "a radius in the wrong order": (
        one_edit("rail: {from: wheel, to: crane", "rail: {from: crane, to: wheel"),
        "gears.rail.radius",
        "radius:",
        "`from` rotates and `to` travels",
        "swap `from` and `to`",
    ),
    "a radius between shafts": (
        one_edit("rail: {from: wheel, to: crane", "rail: {from: wheel, to: motor"),
        "gears.rail.radius",
        "radius:",
        "`from` rotates and `to` travels",
        "write a `ratio`",
    ),
    "a ratio between turning and travelling": (
        one_edit("radius: 250 mm", "ratio: 4"),
        "gears.rail.ratio",
        "ratio: 4",
        "one side rotates, the other travels",
        "write the `radius`",
    ),
    "a ratio of 0": (
        one_edit("radius: 250 mm}", "radius: 250 mm}\nextra: {from: motor, to: spare, ratio: 0}"),
        "gears.extra.ratio",
        "ratio: 0",
        "transmits no motion",
        "speed ratio",
    ),
    "a motor on a mass": (
        one_edit("main: {at: motor", "main: {at: crane"),
        "motors.main.at",
        "at: crane, motor",
        "a motor rotates, and this inertia travels",
        "a gear of a `radius`",
    ),
    "two motions of inertias that gears tie": (
        (
            *one_edit(GUIDED, GUIDED + "\nagain: {at: motor, points: [{time: 0 s, speed: 1 rad/s}]}"),
            *one_edit("radius: 250 mm}", "radius: 250 mm}\nextra: {from: motor, to: spare, ratio: 2}"),
        ),
        "motions.again.at",
        "at: motor, points",
        "the motion of `motor` is already prescribed by `guided`",
        "delete one of the two",
    ),
    "speeds that a gear does not allow": (
        (
            ("wheel: {inertia: 2 kg*m^2}", "wheel: {inertia: 2 kg*m^2, speed: 4 rad/s}"),
            ("crane: {mass: 1 t}", "crane: {mass: 1 t, speed: 2 m/s}"),
        ),
        "inertias.crane.speed",
        "speed: 2 m/s",
        "`wheel`, connected by gears",
        "the speed of one of the two",
    ),
    "the name of an inertia that is no word": (
        one_edit("spare: {inertia", "2nd: {inertia") + one_edit("[wheel, spare]", "[wheel, crane]"),
        "inertias.2nd",
        "2nd:",
        "`2nd` is not a name",
        "give it another name",
    ),
    "a name with a blank": (
        one_edit("brake: {at", "big brake: {at"),
        "brakes.big brake",
        "big brake:",
        "`big brake` is not a name",
        "give it another name",
    ),
    "ground as an inertia": (
        one_edit("motor: {inertia: 1 kg*m^2}", "motor: {inertia: 1 kg*m^2}\nground: {inertia: 1 kg*m^2}"),
        "inertias.ground",
        "ground:",
        "`ground` is not a name",
        "give it another name",
    ),
    "one name for two parts": (
        one_edit("brake: {at", "shaft: {at"),
        "brakes.shaft",
        "shaft: {at",
        "`shaft` is also one of the `links`",
        "a name of its own",
    ),
    "stops that turn and travel": (
        one_edit("duration: 2 s}", "duration: 2 s}\n- {type: stop, name: other, duration: 2 s, of: crane}"),
        "scenes[2].of",
        "of: crane",
        "stopping distances are compared",
        "a file of its own",
    ),
}


def _without_motion(case: str) -> str:
    """Some wiring takes the spare inertia away, to which the prescribed motion belongs."""
    edits = WIRING[case][0]
    if case == "the name of an inertia that is no word":
        edits = (*edits, *one_edit("guided: {at: spare", "guided: {at: motor"))
        edits = tuple((old, new.replace("crane]", "motor]")) for old, new in edits)
    return edited(*edits)


@pytest.mark.parametrize("case", WIRING)
def test_bad_wiring_is_explained_at_its_place(case: str) -> None:
    _, path, words, reason, hint = WIRING[case]
    text = _without_motion(case)
    problem = problem_in(text)
    assert problem.code == "SPC113"
    assert dotted(problem.path) == path
    assert place(problem) == place_of(text, words)
    assert reason in problem.message
    assert hint in problem.hint


def test_a_scene_about_what_travels_makes_the_way_of_a_stop_a_length() -> None:
    text = edited(
        *one_edit("stop_angle: 90 deg", "stop_angle: 2 m"),
        *one_edit("type: stop, duration: 2 s", "type: stop, duration: 2 s, of: crane"),
    )
    train = read(text).spec
    assert isinstance(train, Drivetrain)
    measure = measure_at(train, ("checks", "stop_angle"))
    assert measure is not None
    assert measure.quantity.name == "length"
    assert train.checks.stop_angle == 2.0


def test_a_node_without_inertia_is_sound_on_a_shaft_that_a_gear_ties() -> None:
    assert read(edited(*one_edit("crane: {mass: 1 t}", "crane: {mass: 0 t}"))).spec is not None


def test_speeds_of_one_shaft_may_be_rounded() -> None:
    edits = (
        ("wheel: {inertia: 2 kg*m^2}", "wheel: {inertia: 2 kg*m^2, speed: 3.333 rad/s}"),
        ("crane: {mass: 1 t}", "crane: {mass: 1 t, speed: 0.8333 m/s}"),
    )
    assert read(edited(*edits)).spec is not None


# --- quantities of the other kind of motion --------------------------------------------------------------------------

# (part of a line, what is written instead, the key at fault, what it is)
OTHER_KIND = [
    ("torque: 100 N*m", "torque: 1 kN", "brakes.brake.torque", "a torque"),
    ("torque: -1 kN", "torque: -1 kN*m", "torques.wind.torque", "a force"),
    ("stiffness: 10 kN*m/rad", "stiffness: 10 kN/m", "links.shaft.stiffness", "a torsional stiffness"),
    ("damping: 3 N*m*s/rad", "damping: 3 N*s/m", "links.shaft.damping", "a torsional damping"),
    ("gap: 1 deg", "gap: 1 mm", "links.tail.gap", "an angle"),
    ("damping: 3 N*m*s/rad", "damping: 3 N*m*s/rad\nlimit: 3 kN", "links.shaft.limit", "a torque"),
    ("damping: 3 N*m*s/rad", "damping: 3 N*m*s/rad\npreload: 3 kN", "links.shaft.preload", "a torque"),
    ("gap: 1 deg", "slack: 10 mm", "links.tail.slack", "an angle"),
    ("coulomb: 200 N}", "coulomb: 200 N*m}", "resistances.rolling.coulomb", "a force"),
    ("coulomb: 200 N}", "viscous: 2 N*m*s/rad}", "resistances.rolling.viscous", "a damping"),
    ("size: 3 N*s", "size: 3 N*m*s", "impulses.blow.size", "an impulse"),
    ("{time: 1 s, speed: 2 rad/s}", "{time: 1 s, speed: 2 m/s}", "motions.guided.points[1].speed", "a rotational"),
    ("motor: {inertia: 1 kg*m^2}", "motor: {inertia: 1 kg*m^2, speed: 1 m/s}", "inertias.motor.speed", "a rotational"),
    ("motor: {inertia: 1 kg*m^2}", "motor: {inertia: 1 kg*m^2, position: 1 m}", "inertias.motor.position", "an angle"),
    ("crane: {mass: 1 t}", "crane: {mass: 1 t, speed: 1 rad/s}", "inertias.crane.speed", "a speed"),
    ("speed: 10 rad/s", "speed: 10 m/s", "scenes[0].speed", "a rotational speed"),
    ("speed: 10 rad/s", "speed: 10 rad/s, of: crane", "scenes[0].speed", "a speed"),
    ("type: run, duration: 1 s, speed: 10 rad/s", "type: start, until: 3 m/s", "scenes[0].until", "a rotational"),
    ("stop_angle: 90 deg", "stop_angle: 2 m", "checks.stop_angle", "an angle"),
    ("torque: 100 N*m", "torque: 100 N*m, below: 1 m/s", "brakes.brake.below", "a rotational"),
    (
        "type: constant, torque: -1 kN",
        "type: over_speed, points: [{speed: 1 rad/s, torque: 1 kN}, {speed: 2 m/s, torque: 1 kN}]",
        "torques.wind.points[0].speed",
        "a speed",
    ),
    (
        "type: constant, torque: -1 kN",
        "type: over_position, points: [{position: 1 m, torque: 1 kN}, {position: 2 m, torque: 1 kN*m}]",
        "torques.wind.points[1].torque",
        "a force",
    ),
    (
        "type: constant, torque: -1 kN",
        "type: over_position, period: 1 rad, points: [{position: 1 m, torque: 1 kN}, {position: 2 m, torque: 1 kN}]",
        "torques.wind.period",
        "a length",
    ),
    (
        "type: constant, torque: -1 kN",
        "type: sine, amplitude: 1 N*m, frequency: 1 Hz",
        "torques.wind.amplitude",
        "a force",
    ),
    ("type: constant, torque: -1 kN", "type: ramp, torque: 1 N*m, time: 1 s", "torques.wind.torque", "a force"),
    (
        "gap: 1 deg",
        "clearance: {value: 1 mm, pitch_radius: 10 mm}\nlimit: 2 N",
        "links.tail.limit",
        "a torque",
    ),
]


@pytest.mark.parametrize(("old", "new", "path", "wanted"), OTHER_KIND, ids=[case[2] for case in OTHER_KIND])
def test_a_quantity_of_the_other_kind_of_motion_is_found(old: str, new: str, path: str, wanted: str) -> None:
    text = edited(*one_edit(old, new))
    problem = problem_in(text)
    assert (problem.code, dotted(problem.path)) == ("SPC113", path)
    assert f"so this is {wanted}" in problem.message
    key = str(problem.path[-1])
    line, column = place(problem)
    assert text.splitlines()[line - 1][column - 1 :].startswith(f"{key}:")
    example = problem.hint.removeprefix("write e.g. `").removesuffix("`")
    written = text.splitlines()[line - 1][column - 1 :].removeprefix(f"{key}: ").split(",")[0].split("}")[0]
    mended = read(text.replace(f"{key}: {written}", f"{key}: {example}", 1))
    assert [d for d in mended.diagnostics if "so this is" in d.message] == []


def test_the_clearance_of_a_gear_is_no_play_of_masses() -> None:
    text = edited(
        *one_edit("spare: {inertia: 3 kg*m^2}", "spare: {mass: 3 kg}"),
        *one_edit("between: [wheel, spare]", "between: [crane, spare]"),
        *one_edit("stiffness: 12 kN*m/rad", "stiffness: 12 kN/m"),
        *one_edit("gap: 1 deg", "clearance: {value: 1 mm, pitch_radius: 10 mm}"),
        *one_edit("points: [{time: 0 s", "points: [{time: 0 s, speed: 1 m/s}] } # {"),
    )
    problem = problem_in(text)
    assert (problem.code, dotted(problem.path)) == ("SPC113", "links.tail.clearance")
    assert "write the clearance as `gap`" in problem.hint


# --- what one part needs ---------------------------------------------------------------------------------------------

# (part of a line, what is written instead, the path that is blamed, its place, words of the hint)
OF_ONE_PART = [
    ("stiffness: 10 kN*m/rad", "# none", "links.shaft", "shaft:", "add `stiffness: 20 kN*m/rad`"),
    ("damping: 3 N*m*s/rad", "law: clamped", "links.shaft.law", "law:", "add `gap: 0 deg`"),
    ("gap: 1 deg", "gap: 1 deg\nslack: 2 deg", "links.tail.gap", "gap:", "delete `gap`"),
    (
        "gap: 1 deg",
        "gap: 1 deg\nclearance: {value: 1 mm, pitch_radius: 10 mm}",
        "links.tail.clearance",
        "clearance:",
        "delete `clearance`",
    ),
    ("gap: 1 deg", "gap: 1 deg\nlaw: rigid", "links.tail.stiffness", "stiffness: 12", "delete `stiffness`"),
    ("gap: 1 deg", "gap: 1 deg\nrestitution: 0.5", "links.tail.restitution", "restitution", "write `law: rigid`"),
    (
        "gap: 1 deg",
        "gap: 1 deg\nlaw: kelvin\ndissipation: 0.5",
        "links.tail.dissipation",
        "dissipation",
        "write `law: hunt_crossley`",
    ),
    ("gap: 1 deg", "gap: 1 deg\nexponent: 2", "links.tail.exponent", "exponent", "write `law: hunt_crossley`"),
    (
        "gap: 1 deg",
        "gap: 1 deg\nlaw: hunt_crossley\ndamping: 5 N*m*s/rad",
        "links.tail.damping",
        "damping: 5",
        "delete `damping`",
    ),
    (
        "gap: 1 deg",
        "clearance: {pitch_radius: 10 mm}",
        "links.tail.clearance",
        "clearance:",
        "add `value",
    ),
    (
        "gap: 1 deg",
        "clearance: {centre_distance: 250 mm, pitch_radius: 10 mm}",
        "links.tail.clearance",
        "clearance:",
        "add `accuracy_class",
    ),
    (
        "gap: 1 deg",
        "clearance: {accuracy_class: 3, pitch_radius: 10 mm}",
        "links.tail.clearance",
        "clearance:",
        "add `centre_distance",
    ),
    (
        "gap: 1 deg",
        "clearance: {value: 1 mm, wear: 1 mm, pitch_radius: 10 mm}",
        "links.tail.clearance",
        "clearance:",
        "add `module",
    ),
    (
        "gap: 1 deg",
        "clearance: {value: 1 mm, centre_distance: 1 m, accuracy_class: 3, pitch_radius: 10 mm}",
        "links.tail.clearance.value",
        "value:",
        "delete `value`",
    ),
    ("crane: {mass: 1 t}", "crane: {mass: 1 t, inertia: 1 kg*m^2}", "inertias.crane.mass", "mass: 1", "delete `mass`"),
    ("spare: {inertia: 3 kg*m^2}", "spare: {}", "inertias.spare", "spare: {}", "add `inertia"),
    ("radius: 250 mm}", "radius: 250 mm, ratio: 3}", "gears.rail.radius", "radius:", "delete `radius`"),
    (", radius: 250 mm}", "}", "gears.rail", "rail:", "add `ratio"),
    (
        "type: constant, torque: -1 kN",
        "type: sine, amplitude: 1 kN",
        "torques.wind",
        "wind:",
        "add `frequency",
    ),
    (
        "type: constant, torque: -1 kN",
        "type: sine, amplitude: 1 kN, frequency: 1 Hz, angular_frequency: 6 rad/s",
        "torques.wind.angular_frequency",
        "angular_frequency",
        "delete `angular_frequency`",
    ),
    (
        "type: constant, torque: -1 kN",
        "type: over_time, points: [{time: 1 s, torque: 1 kN}, {time: 0 s, torque: 2 kN}]",
        "torques.wind.points[1].time",
        "time: 0 s, torque",
        "sort the points",
    ),
    (
        "type: constant, torque: -1 kN",
        "type: over_time, points: [{time: 1 s, torque: 1 kN}, {time: 1 s, torque: 2 kN}]",
        "torques.wind.points[1].time",
        "time: 1 s, torque: 2",
        "sort the points",
    ),
    (
        "type: constant, torque: -1 kN",
        "type: over_speed, points: [{speed: 1 m/s, torque: 1 kN}, {speed: 0.5 m/s, torque: 2 kN}]",
        "torques.wind.points[1].speed",
        "speed: 0.5",
        "sort the points",
    ),
    (
        "type: constant, torque: -1 kN",
        "type: over_position, points: [{position: 3 m, torque: 1 kN}, {position: 2 m, torque: 2 kN}]",
        "torques.wind.points[1].position",
        "position: 2",
        "sort the points",
    ),
    (
        "type: constant, torque: -1 kN",
        "type: over_position, period: 5 m, points: [{position: 0 m, torque: 1 kN}, {position: 2 m, torque: 2 kN}]",
        "torques.wind.period",
        "period:",
        "give the first point again at the end",
    ),
    (
        "{time: 0 s, speed: 1 rad/s}",
        "{time: 0.5 s, speed: 1 rad/s}",
        "motions.guided.points[0].time",
        "time: 0.5",
        "`0 s`",
    ),
    (
        "{time: 1 s, speed: 2 rad/s}",
        "{time: 0 s, speed: 2 rad/s}",
        "motions.guided.points[1].time",
        "time: 0 s, speed: 2",
        "sort",
    ),
]


@pytest.mark.parametrize(
    ("old", "new", "path", "words", "hint"), OF_ONE_PART, ids=[f"{case[2]}-{case[4][:12]}" for case in OF_ONE_PART]
)
def test_keys_of_one_part_that_do_not_go_together_are_explained(
    old: str, new: str, path: str, words: str, hint: str
) -> None:
    text = edited(*one_edit(old, new))
    problem = problem_in(text)
    assert (problem.code, dotted(problem.path)) == ("SPC113", path)
    start = place_of(text, words)
    assert place(problem)[0] == start[0]
    assert hint in problem.hint


SHELL = "type: drum, outer_diameter: 1 m, length: 1 m"
BODIES = [
    (
        "{type: hollow, mass: 1 kg, outer_diameter: 1 m, inner_diameter: 1 m}",
        "inner_diameter",
        "not below the outer diameter",
    ),
    (
        f"{{{SHELL}, inner_diameter: 2 m, disc_thickness: 0 m, shaft_diameter: 0 m}}",
        "inner_diameter",
        "not below the outer diameter",
    ),
    (
        f"{{{SHELL}, inner_diameter: 0.9 m, disc_thickness: 0 m, shaft_diameter: 1 m}}",
        "shaft_diameter",
        "the shaft does not fit",
    ),
    (
        f"{{{SHELL}, inner_diameter: 0.9 m, disc_thickness: 0.6 m, shaft_diameter: 0 m}}",
        "disc_thickness",
        "the two discs do not fit",
    ),
    (
        "{type: sheave, rings: [{outer_radius: 1 m, inner_radius: 1 m, width: 10 mm}]}",
        "rings[0].inner_radius",
        "not below the outer radius",
    ),
    ("{type: rod, mass: 1 kg, length: 1 m, position: inclined}", "", "needs its `angle`"),
    ("{type: rod, mass: 1 kg, length: 1 m, position: end, angle: 30 deg}", "angle", "only an inclined rod"),
    ("{type: rod, mass: 1 kg, length: 1 m, position: centre, distance: 1 m}", "distance", "`radial` or `parallel`"),
    ("{type: rod, mass: 1 kg, length: 1 m, position: radial, radius: 10 mm}", "radius", "`parallel`"),
]


@pytest.mark.parametrize(("body", "key", "reason"), BODIES)
def test_dimensions_of_a_body_that_cannot_be_are_explained(body: str, key: str, reason: str) -> None:
    text = edited(*one_edit("motor: {inertia: 1 kg*m^2}", f"motor: {{body: {body}}}"))
    problem = problem_in(text)
    assert problem.code == "SPC113"
    assert dotted(problem.path) == f"inertias.motor.body{'.' * bool(key)}{key}"
    assert place(problem)[0] == 3
    assert reason in problem.message


# --- several faults --------------------------------------------------------------------------------------------------


def test_several_faults_at_once_are_all_shown_in_the_order_of_the_file() -> None:
    text = edited(
        *one_edit("motor: {inertia: 1 kg*m^2}", "motor: {inertia: 1}"),
        *one_edit("between: [motor, wheel]", "between: [motor, weel]"),
        *one_edit("gap: 1 deg", "gap: 1 mm"),
        *one_edit("radius: 250 mm", "radius: -1 m"),
        *one_edit("torque: 100 N*m", "torque: 1 kN"),
        *one_edit("torque: -1 kN", "torque: 5 N*m"),
        *one_edit("duration: 2 s", "duration: 2 s, of: moter"),
    )
    found = [(d.code, dotted(d.path)) for d in read(text).diagnostics]
    assert found == [
        ("SPC106", "inertias.motor.inertia"),
        ("SPC113", "links.shaft.between[1]"),
        ("SPC113", "links.tail.gap"),
        ("SPC110", "gears.rail.radius"),
        ("SPC113", "brakes.brake.torque"),
        ("SPC113", "torques.wind.torque"),
        ("SPC113", "scenes[1].of"),
    ]


@pytest.mark.parametrize(
    ("old", "new", "code"),
    [
        ("inertias:", "inertia:", "SPC104"),
        ("inertias:", "inertias: []\nx_y_z:", "SPC111"),
        ("inertias:", "inertias: {}\nx_y_z:", "SPC110"),
        ("motor: {inertia: 1 kg*m^2}", "motor:", "SPC111"),
        ("motor: {inertia: 1 kg*m^2}", "motor: 5", "SPC111"),
        ("motor: {inertia: 1 kg*m^2}", "motor: {inertai: 1 kg*m^2}", "SPC104"),
        ("crane: {mass: 1 t}", "crane: {maas: 1 t}", "SPC104"),
        ("crane: {mass: 1 t}", "crane: {mass: 1 t, inertia: 1 kg*m^2}", "SPC113"),
        ("crane: {mass: 1 t}", "crane: {mass: .nan}", "SPC109"),
        ("between: [motor, wheel]", "betwen: [motor, wheel]", "SPC104"),
        ("between: [motor, wheel]", "between: [motor]", "SPC110"),
        ("between: [motor, wheel]", "between: []", "SPC110"),
        ("between: [motor, wheel]", "between: [motor, wheel, crane]", "SPC110"),
        ("between: [motor, wheel]", "between: motor", "SPC111"),
        ("between: [motor, wheel]", "between: {motor: wheel}", "SPC111"),
        ("between: [motor, wheel]", "between: [motor, [wheel]]", "SPC111"),
        ("between: [motor, wheel]", "between: [motor, 5]", "SPC111"),
        ("between: [motor, wheel]", "between: [motor, {wheel: 1}]", "SPC111"),
        ("rail: {from: wheel", "rail: {from: [wheel]", "SPC111"),
        ("rail: {from: wheel", "rail: {form: wheel", "SPC104"),
        ("brake: {at: motor", "brake: {at: [motor]", "SPC111"),
        ("brake: {at: motor", "brake: {at: {motor: 1}", "SPC111"),
        ("brake: {at: motor, torque", "brake: {torque", "SPC103"),
        ("main: {at: motor", "main: {at: 7", "SPC111"),
        ("type: constant, torque: -1 kN", "type: konstant, torque: -1 kN", "SPC112"),
        ("type: constant, torque: -1 kN", "torque: -1 kN", "SPC103"),
        ("duration: 2 s", "duration: 2 s, of: [motor]", "SPC111"),
        ("gears:", "geers:", "SPC104"),
        ("gears:", "gears: [1]\nx_y_z:", "SPC111"),
        ("links:", "links: nothing\nx_y_z:", "SPC111"),
        ("links:", "links: *x\nx_y_z:", "TXT110"),
    ],
)
def test_what_follows_from_a_fault_is_not_said_as_well(old: str, new: str, code: str) -> None:
    text = edited(*one_edit(old, new)) if old.strip() not in MACHINE.splitlines() else edited((old, new))
    if old == "gears:":  # a massless node that only the gear made sound
        text = text.replace("crane: {mass: 1 t}", "crane: {mass: 0 t}") if new == "geers:" else text
    found = [d for d in read(text).diagnostics if d.path[:1] != ("x_y_z",)]
    assert [d.code for d in found] == [code], [(d.code, dotted(d.path), d.message) for d in found]


# --- numbers ---------------------------------------------------------------------------------------------------------


def _numbers(data: Any, path: KeyPath = ()) -> Iterator[KeyPath]:
    """Paths of all texts with a unit and of all numbers."""
    items = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
    for key, value in items:
        if isinstance(value, dict | list):
            yield from _numbers(value, (*path, key))
        elif key not in ("accuracy_class", "both_worn") and str(value)[:1] in "-0123456789":
            yield (*path, key)


DATA: dict[str, Any] = data_of(EVERYTHING)
NUMBERS = list(_numbers(DATA))
WRONG = ((".nan", "SPC109"), ("1e400", "SPC109"), ("1e30", "SPC110"))


def _replaced(path: KeyPath, value: Any) -> str:
    data = data_of(EVERYTHING)
    node = data
    for step in path[:-1]:
        node = node[step]
    node[path[-1]] = value
    return str(yaml.safe_dump(data, sort_keys=False))


def _unit(path: KeyPath) -> str:
    node: Any = DATA
    for step in path:
        node = node[step]
    return node.partition(" ")[2] if isinstance(node, str) else ""


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


def test_the_file_with_everything_has_every_key_of_every_part() -> None:
    models = [
        one
        for module in (spec, bodies, brakes, gears, inertias, links, torques)
        for one in vars(module).values()
        if isinstance(one, type) and issubclass(one, BaseModel) and one.__module__ == module.__name__
    ]
    wanted = {_declared(model, key) for model in models for key in keys_of(model)}
    assert len(wanted) > 100
    of_any_kind = {("MachineSpec", key) for key in ("accuracy", "project", "tolerances", "waive")} | {
        ("TransientScene", "window_factor")
    }
    assert wanted - set(_keys(Drivetrain, DATA)) == of_any_kind


def test_a_file_with_everything_in_it_is_read_and_computed() -> None:
    assert [type(scene) for scene in spec_of(DATA).all_scenes] == [Run, Start, Stop]
    (scene,) = report_of(DATA, ends=False, scenes=("work",)).scenes
    assert scene.health["energy_residual"] < 1e-6
    assert len(scene.events) > 20
    assert {load.info.name.partition("[")[0] for load in scene.loads} >= {"torque_peak", "wear_share", "speed_end"}


@pytest.mark.parametrize(("index", "path"), list(enumerate(NUMBERS)), ids=[dotted(path) for path in NUMBERS])
def test_a_number_that_is_none_or_infinite_or_too_large_is_blamed_itself(index: int, path: KeyPath) -> None:
    value, code = WRONG[index % len(WRONG)]
    unit = _unit(path)
    diagnostics = read(_replaced(path, f"{value} {unit}" if unit else float(value.removeprefix(".")))).diagnostics
    codes = [d.code for d in diagnostics if d.path == path]
    assert codes == [code] or (not unit and codes == ["SPC111"]), [(d.code, d.message) for d in diagnostics]
    assert all(d.span is not None for d in diagnostics)


@pytest.mark.parametrize(("index", "path"), list(enumerate(NUMBERS)), ids=[dotted(path) for path in NUMBERS])
def test_any_number_may_be_0_or_negative_without_a_crash(index: int, path: KeyPath) -> None:
    """Either it is sound, or something is said, at this number or where it meets another one."""
    unit, number = _unit(path), (0, -3)[index % 2]
    result = read(_replaced(path, f"{number} {unit}" if unit else number))
    assert (result.spec is None) == any(d.severity == "error" for d in result.diagnostics)
    assert all(d.hint and d.span is not None for d in result.diagnostics)


ZEROS = ["inertias.motor.inertia", "inertias.hook.mass", "inertias.load.mass", "inertias.table.inertia"]


@pytest.mark.parametrize("name", ZEROS)
def test_an_inertia_of_0_is_sound_only_where_a_gear_ties_it(name: str) -> None:
    path = key_path(name)
    result = read(_replaced(path, f"0 {_unit(path)}"))
    if name == "inertias.hook.mass":
        assert result.spec is not None
    else:
        (problem,) = result.diagnostics
        assert (problem.code, dotted(problem.path)) == ("SPC113", name)


# --- words and blocks ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("old", "new", "meant"),
    [
        ("stiffness: 10 kN*m/rad", "stifness: 10 kN*m/rad", "stiffness"),
        ("gap: 1 deg", "gapp: 1 deg", "gap"),
        ("torque: 100 N*m", "troque: 100 N*m", "torque"),
        ("coulomb: 200 N", "colomb: 200 N", "coulomb"),
        ("size: 3 N*s", "siz: 3 N*s", "size"),
        ("stop_angle: 90 deg", "stop_angel: 90 deg", "stop_angle"),
        ("duration: 2 s", "duraton: 2 s", "duration"),
        ("radius: 250 mm", "radios: 250 mm", "radius"),
    ],
)
def test_a_misspelt_key_is_found_with_the_one_that_is_meant(old: str, new: str, meant: str) -> None:
    text = edited(*one_edit(old, new))
    problem = problem_in(text)
    assert problem.code == "SPC104"
    assert place(problem) == place_of(text, new.split(":")[0] + ":")
    assert f"`{meant}`" in problem.hint


@pytest.mark.parametrize(
    ("old", "new", "meant"),
    [
        ("gap: 1 deg", "gap: 1 deg\nlaw: clampd", "clamped"),
        ("gap: 1 deg", "gap: 1 deg\nstart: drivin", "driving"),
        ("type: constant, torque: -1 kN", "type: constnt, torque: -1 kN", "constant"),
        ("torque: 100 N*m", "torque: 100 N*m, applied: allways", "always"),
        ("type: stop", "type: stopp", "stop"),
        ("duration: 2 s", "duration: 2 s, links: loadet", "loaded"),
        ("kind: drivetrain", "kind: drivetrein", "drivetrain"),
    ],
)
def test_a_misspelt_word_is_found_with_the_one_that_is_meant(old: str, new: str, meant: str) -> None:
    problem = problem_in(edited(*one_edit(old, new)))
    assert problem.code in ("SPC112", "SPC102")
    assert f"`{meant}`" in problem.hint


def test_effects_and_checks_of_other_kinds_are_not_known() -> None:
    text = edited(("checks:", "effects: {belt_wave: off}\nchecks:\n  CNV101: {off: no belt}"))
    assert [(d.code, dotted(d.path)) for d in read(text).diagnostics] == [
        ("SPC104", "effects.belt_wave"),
        ("SPC104", "checks.CNV101"),
    ]


def test_without_scenes_the_train_starts() -> None:
    data = data_of(MACHINE)
    del data["scenes"]
    assert [type(scene) for scene in spec_of(data).all_scenes] == [Start]


def test_values_are_si_in_the_quantity_of_their_kind() -> None:
    train = spec_of(data_of(EVERYTHING))
    assert train.links["gap_link"].gap == pytest.approx(0.4 * 3.141592653589793 / 180)
    assert train.links["rope"].slack == pytest.approx(0.010)
    assert train.brakes["holding"].below == pytest.approx(20 * 3.141592653589793 / 30)
    assert train.links["rope"].stiffness == 400e3
    for path, name in [
        ("links.rope.stiffness", "stiffness"),
        ("links.gap_link.stiffness", "torsional stiffness"),
        ("links.anchor.damping", "torsional damping"),
        ("inertias.load.speed", "speed"),
        ("inertias.motor.position", "angle"),
        ("brakes.holding.torque", "torque"),
        ("torques.weight.torque", "force"),
        ("torques.cam.period", "angle"),
        ("scenes[0].speed", "rotational speed"),
        ("impulses.blow.size", "angular impulse"),
        ("checks.stop_angle", "angle"),
    ]:
        measure = measure_at(train, key_path(path))
        assert measure is not None, path
        assert measure.quantity.name == name, path


def test_the_template_and_the_design_file_say_nothing() -> None:
    result = read(load_kind("drivetrain").template)
    assert result.spec is not None
    assert result.diagnostics == ()
