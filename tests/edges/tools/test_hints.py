"""Hints: an example is of that very key, and words of the field lead to the key that is meant."""

from importlib import resources

import pytest
from support.keys import TYPES, blocks, fields_of

from ptmcalc.base.units import UnitError, is_of, read
from ptmcalc.contract.machine import AnyKind
from ptmcalc.engine.load import load_text
from ptmcalc.spec.rooms import texts_in
from ptmcalc.spec.shape import USUAL, example_at, is_whole, keys_of, measure_of, usual

of_every_type = pytest.mark.parametrize("kind", TYPES.values(), ids=TYPES)


@of_every_type
def test_every_number_has_an_example_of_its_own_that_it_takes(kind: AnyKind) -> None:
    faulty = []
    for model, key in fields_of(kind):
        field = keys_of(model)[key]
        measure = measure_of(field)
        if measure is None and not is_whole(field):
            continue
        example = example_at(model, key)
        if not (field.examples or usual(model, key)):
            faulty.append(
                f"{model.__name__}.{key} has no usual value: add `Field(examples=['...'])` to its annotation, or"
                f" `{model.__name__}.{key}: ...` to usual.txt of its topic or kind"
            )
        elif measure is None:
            assert int(example) >= 0
        else:
            quantity = measure.quantity_of(example)
            try:
                broken = measure.broken_by(read(example, quantity))
            except UnitError as error:
                broken = error.reason
            if broken or (float(read(example, quantity)) == 0 and not field.examples):
                faulty.append(f"{model.__name__}.{key}: {example}: {broken}")
    assert faulty == []


PACKAGES = {model.__module__.rpartition(".")[0] for kind in TYPES.values() for model in blocks(kind.spec, set())}


def with_usual_values(package: str) -> str:
    """The package that lists the usual values of another one: itself, or the nearest above it."""
    here = resources.files(package).joinpath(USUAL).is_file()
    return package if here else with_usual_values(package.rpartition(".")[0])


@pytest.mark.parametrize("package", sorted({with_usual_values(one) for one in PACKAGES}))
def test_no_usual_value_is_of_nothing(package: str) -> None:
    lines = [line for text in texts_in(package, USUAL).values() for line in text.splitlines()]
    listed = [line.partition(": ")[0] for line in lines if not line.startswith("#")]
    assert len(set(listed)) == len(listed)
    known = {
        f"{one.__name__}.{key}"
        for kind in TYPES.values()
        for model, key in fields_of(kind)
        for one in model.__mro__
        if usual(model, key)
    }
    assert set(listed) <= known


FAULTY = """\
kind: conveyor
name: x
route: {length: 100 m}
belt: {width: 1000 mm, mass: 15 kg/m, modulus: 9000 N/mm, strength: 800 N/mm}
idlers: {carry: {line_mass: 18 kg/m}, return: {line_mass: 6 kg/m}}
load: {mass: 100 kg/m}
speed: 2 m/s
drive:
  motor: {inertia: 1.4 kg*m^2, speed: 1480 rpm, mean_starting_torque: 900 N*m}
  gear: {ratio: 24.8}
  drum: {diameter: 800 mm, wrap: 200 deg}
resistance: {coefficient: 0.022, secondary: 1.4}
takeup: {type: gravity, tension: 30 kN}
"""


def hints(text: str) -> list[tuple[str, str]]:
    return [(one.code, one.hint) for one in load_text(text.encode(), "x.yaml").diagnostics]


@pytest.mark.parametrize(
    ("change", "code", "hint"),
    [
        ((", strength: 800 N/mm", ", strength: strong"), "SPC114", "write a number with a unit, e.g. `800 N/mm`"),
        (("mass: 15 kg/m", "mass: 15 kN"), "SPC105", "write a mass per length, e.g. `15 kg/m`"),
        (("speed: 2 m/s", "speed: [2 m/s]"), "SPC111", "write e.g. `2.5 m/s`"),
        (("wrap: 200 deg", "wrap: .nan deg"), "SPC109", "write a number, e.g. `200 deg`"),
        (("inertia: 1.4 kg*m^2, ", ""), "SPC113", "add `inertia: 1.4 kg*m^2`"),
        (("{coefficient: 0.022, secondary: 1.4}", "0.02"), "SPC111", "write `resistance: {coefficient: 0.022}`"),
        (("carry: {line_mass: 18 kg/m}", "carry: {set_mass: 22 kg}"), "SPC113", "add `pitch: 1.2 m`"),
        (("carry: {line_mass: 18 kg/m}", "carry: {pitch: 1.2 m}"), "SPC113", "add `set_mass: 22 kg`"),
    ],
)
def test_an_example_is_of_that_very_key(change: tuple[str, str], code: str, hint: str) -> None:
    assert change[0] in FAULTY
    assert (code, hint) in hints(FAULTY.replace(*change))


WORDS = [
    ("conveyor", "s-curve", "did you mean `shape: cosine` under `scenes`, or under `scenes.profile`?"),
    ("conveyor", "travel", "did you mean `stroke` under `takeup`?"),
    ("conveyor", "VFD", "did you mean `profile` under `scenes`?"),
    ("conveyor", "fluid coupling", "did you mean `fluid_coupling` under `drive`, or under `drives`?"),
    ("conveyor", "Fluid-Coupling", "did you mean `fluid_coupling` under `drive`, or under `drives`?"),
    ("conveyor", "counterweight", "did you mean `mass` under `takeup`?"),
    ("conveyor", "wrap", "did you mean `wrap` under `drive.drum`?"),
    ("hoist", "holdback", "this machine kind has no key for `holdback` in this version"),
    ("hoist", "VFD", "did you mean `profile` under `scenes`?"),
    ("crane travelling", "VFD", "did you mean `type: converter` under `drive.motor.curve`?"),
    ("crane travelling", "s-curve", "this machine kind has no key for `s-curve` in this version"),
    ("crane travelling", "travel", "did you mean `stroke` under `buffers`?"),
    ("chain_drive", "hold_back", "did you mean `backstop`?"),
    ("shaft", "s-curve", "this machine kind has no key for `s-curve` in this version"),
    ("shaft", "fluid coupling", "this machine kind has no key for `fluid coupling` in this version"),
]


@pytest.mark.parametrize(("label", "word", "hint"), WORDS)
def test_a_word_of_the_field_leads_to_its_key_or_is_said_to_have_none(label: str, word: str, hint: str) -> None:
    template = TYPES[label].template
    assert ("SPC104", hint) in hints(f"{template}\n{word}: 3\n")


def test_a_word_of_the_field_is_known_as_a_value_too() -> None:
    scenes = "scenes:\n  - {type: start, profile: {shape: s-curve, time: 3 s}}\n"
    assert ("SPC112", "did you mean `cosine`?") in hints(FAULTY + scenes)


def test_an_example_is_of_its_quantity() -> None:
    """A torque or a force: either, as the machine has it."""
    for kind in TYPES.values():
        for model, key in fields_of(kind):
            measure = measure_of(keys_of(model)[key])
            if measure is not None and measure.or_else is not None:
                example = example_at(model, key)
                assert is_of(example, measure.quantity) or is_of(example, measure.or_else)
