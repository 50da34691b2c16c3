"""Rule 1: the ends of an assumed value are tried only where its kind says it is used; elsewhere it changes nothing.

The scenes and loads that are left out are computed here at both ends, and every load that a check reads is the same.
"""

from collections.abc import Iterator

import pytest
from support.random_machines import KINDS, machine, settled, texts

from ptmcalc.base.span import dotted
from ptmcalc.contract.machine import AnyKind
from ptmcalc.contract.report import AssumedReport
from ptmcalc.contract.result import family
from ptmcalc.engine.load import Loaded, load_text
from ptmcalc.engine.solve import variants
from ptmcalc.spec.machine import MachineSpec
from ptmcalc.spec.scene import Scene

SEED, MACHINES = 43, 20
SECONDS = 0.3
"""Predicted seconds of work of a scene: what is computed later would be the same, too."""


def changed(loaded: Loaded) -> list[str]:
    """Loads of checks that an assumed value changes although it is said not to be used there."""
    kind, spec = loaded.kind, loaded.spec
    assert kind is not None
    assert spec is not None
    of_checks = {family(name) for check in kind.checks for name in check.loads}
    restricted = [one for one in loaded.assumed if one.scenes or one.loads]
    wrong = []
    for scene in spec.all_scenes:
        here = [one for one in restricted if _unused(one, scene, of_checks)]
        if not here:
            continue
        base = _loads(kind, spec, scene)
        for assumed, end, other in variants(spec, here):
            moved = next(one for one in other.all_scenes if one.label == scene.label)
            unused = _unused(assumed, scene, of_checks)
            wrong += [
                f"{dotted(assumed.path)} at {end}: {scene.label}: {name} of {run}"
                for (run, name), known in _loads(kind, other, moved).items()
                if family(name) in unused and (run or not assumed.limits_only)
                if known != base.get((run, name), known if run else "")
            ]
    return wrong


def _unused(assumed: AssumedReport, scene: Scene, loads: set[str]) -> set[str]:
    """Families of the loads that the value is said not to change in a scene."""
    if not assumed.read_in(scene):
        return loads
    if assumed.limits_only:
        return loads
    return loads - assumed.loads if assumed.loads else set()


def _loads(kind: AnyKind, spec: MachineSpec, scene: Scene) -> dict[tuple[str, str], str]:
    """Each load as it is known best, and that of each run by the run's solver, effects and level; limits decide which
    runs are made."""
    found = settled(spec, kind, scene, budget=SECONDS)
    loads = {("", name): str(best.estimate) for name, best in found.loads.items()}
    for run in found.runs:
        named = f"{run.rung.solver.name}, {sorted(run.rung.carried)}, level {run.rung.level}"
        loads |= {(named, name): str(estimate) for name, estimate in run.estimates.items()}
    return loads


def files(kind: AnyKind) -> Iterator[Loaded]:
    """The template and the design files of a kind."""
    return (load_text(text.encode(), f"{number}.yaml") for number, text in enumerate(texts(kind)))


def test_keys_that_are_named_are_assumed_in_a_file() -> None:
    """A misspelt key would be used everywhere, unseen."""
    assumed = {dotted(one.path) for kind in KINDS for loaded in files(kind) for one in loaded.assumed}
    assert {key for kind in KINDS for key in kind.uses} <= assumed


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.label)
def test_an_assumed_value_changes_nothing_elsewhere(kind: AnyKind) -> None:
    of_most = max(files(kind), key=lambda loaded: sum(bool(one.scenes or one.loads) for one in loaded.assumed))
    assert changed(of_most) == []


@pytest.mark.study
@pytest.mark.parametrize("index", range(MACHINES))
@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.label)
def test_nor_in_a_random_machine(kind: AnyKind, index: int) -> None:
    assert changed(machine(kind, SEED, index).loaded) == []
