"""Limits written as a key or a constant, and every key that a check names for each machine: the kind has it."""

import math
from collections.abc import Iterator
from typing import Any

import pytest
from support.each import over

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath, dotted, key_path
from ptmcalc.contract.check import AnyCheck, Check
from ptmcalc.contract.limits import Limit, fixed, key
from ptmcalc.contract.machine import AnyKind
from ptmcalc.engine.load import load_text
from ptmcalc.engine.registry import kind_names, load_kind
from ptmcalc.spec.machine import MachineSpec
from ptmcalc.spec.scene import Scene
from ptmcalc.spec.shape import inner, keys_of, models_of

KINDS = {one.label: one for name in kind_names() for one in load_kind(name).manifests}
HOIST = KINDS["hoist"]


def known(annotation: Any, path: KeyPath) -> bool:
    """Whether a description may have a value at `path`: where a block has several types, one of them is enough."""
    if not path:
        return True
    if models := models_of(annotation):  # open keys, which are codes of checks, do not count
        fields = [keys_of(model).get(str(path[0])) for model in models]
        return any(known(field.annotation, path[1:]) for field in fields if field)
    behind = inner(annotation, path[0], None)
    return behind is not None and known(behind, path[1:])


def fixed_paths(check: AnyCheck) -> Iterator[KeyPath]:
    """Keys that a check names for every machine: by `key`, `needs`, `blames` and `at`."""
    if isinstance(check.limit, Limit):
        yield check.limit.path
    if check.needs.__module__ == Check.__module__:
        yield from check.needs(None, None)
    if check.blame.__module__ == Check.__module__:
        yield check.blame(None, None, {})
    if check.repair.__module__ == Check.__module__:
        yield check.repair(None, None)


PATHS = {
    f"{label} {check.code}: {dotted(path)}": (kind, path)
    for label, kind in KINDS.items()
    for check in kind.checks
    if not check.types or kind.type in check.types
    for path in fixed_paths(check)
    if path
}


@over(PATHS)
def test_a_key_that_a_check_names_for_every_machine_is_a_key_of_the_kind(kind: AnyKind, path: KeyPath) -> None:
    assert known(kind.spec, path)


def test_there_are_keys_to_look_at() -> None:
    assert len(PATHS) > 100


@pytest.mark.parametrize("path", [("checks", "dead_wrap"), ("drum", "length", "of"), ("classes", "mechanism")])
def test_a_wrong_key_is_found(path: KeyPath) -> None:
    assert not known(HOIST.spec, path)


@pytest.mark.parametrize("path", [("checks", "dead_wraps"), ("class", "mechanism"), ("scenes", 0, "load")])
def test_a_right_key_is_known(path: KeyPath) -> None:
    assert known(HOIST.spec, path)


# -- the limits themselves ------------------------------------------------------------------------------------------


def machine(text: str = HOIST.template) -> tuple[MachineSpec, Scene]:
    spec = load_text(text.encode(), "hoist.yaml").spec
    assert spec is not None
    return spec, spec.all_scenes[0]


def test_the_value_of_a_key() -> None:
    spec, scene = machine()
    changed = spec.with_value(("checks", "dead_wraps"), 3.5)
    limit = key("checks.dead_wraps", meaning="Dead wraps", valid="any drum")
    assert limit(changed, scene) == Estimate.exact(3.5)
    assert limit(spec.with_value(("checks", "dead_wraps"), 0.0), scene) == Estimate.exact(0.0)


def test_a_key_of_a_block_that_is_a_reserved_word() -> None:
    spec, scene = machine()
    assert key("class.edition", meaning="Edition", valid="any")(spec, scene).value == spec.value_at(
        ("class", "edition")
    )


@pytest.mark.parametrize(("path", "removed"), [("checks.hoop_stress", "checks.hoop_stress"), ("motor.curve", "motor")])
def test_without_the_key_or_its_block_there_is_no_limit(path: str, removed: str) -> None:
    spec, scene = machine()
    without = spec.with_value(key_path(removed), None)
    assert key(path, meaning="Limit", valid="any hoist")(without, scene) == Estimate.exact(math.inf)
    assert key(path, meaning="Limit", valid="any hoist", absent=7.0)(without, scene) == Estimate.exact(7.0)


def test_a_constant_is_the_same_for_every_machine() -> None:
    assert fixed(0.0, meaning="0: taut", valid="any rope", source="equilibrium")(*machine()) == Estimate.exact(0.0)


def test_the_texts_are_those_of_a_docstring() -> None:
    """In lines of 116 columns, with the full stops."""
    made = fixed(2.0, meaning="Number of dead wraps", valid="any rope", source=" ".join(["equilibrium"] * 10))
    assert made.__doc__ == (
        "Number of dead wraps.\n\n**Range** any rope.\n**Error** none.\n"
        f"**Source** {' '.join(['equilibrium'] * 8)}\nequilibrium equilibrium."
    )
    made = key("checks.dead_wraps", meaning="Number of dead wraps, from the file", valid="any rope")
    assert made.__doc__ == (
        "Number of dead wraps, from the file.\n\n**Range** any rope.\n**Error** none: a chosen limit.\n"
        "**Source** the file."
    )
