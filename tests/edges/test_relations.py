"""Rule 6: reports agree with themselves: the relations that a kind declares hold between the loads that are printed,
and loads that contradict each other make each check that reads them undecided."""

import math
import os
from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import cache
from typing import Any

import pytest
import yaml
from support.random_machines import KINDS, machine, texts, written

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.contract.machine import AnyKind
from ptmcalc.contract.relation import Relation
from ptmcalc.contract.report import SceneReport
from ptmcalc.contract.result import Found, Result, family, of
from ptmcalc.contract.solver import AnySolver
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import load_text
from ptmcalc.engine.plan import plan_scene
from ptmcalc.engine.run import settle
from ptmcalc.engine.settled import Settled
from ptmcalc.spec.machine import MachineSpec
from ptmcalc.spec.scene import Scene

WITHOUT = frozenset({"potential"})
"""Blocks without which a relation holds that does not hold with them."""
SEED = int(os.environ.get("PTMCALC_SEED", "41"))
NUMBER = 3
_ROUNDING = 1e-6
"""Relative difference of printed values that is rounding; each relation is evaluated here from the values alone."""
_CHEAP = 1.0
"""Predicted seconds of work of a scene."""


# -- on the printed report ------------------------------------------------------------------------------------------


def parts_of(relation: Relation, loads: Mapping[str, Estimate]) -> Iterator[dict[str, str]]:
    """The names of the loads of a relation, for each part of the machine that has all of them."""
    elements = {name.partition("[")[2].removesuffix("]") for name in loads if family(name) in relation.loads}
    for element in sorted(elements):
        own = {name: of(name, element) if element else name for name in relation.loads}
        names = {name: one if one in loads else name for name, one in own.items()}
        if all(one in loads for one in names.values()) and (not element or own != dict(zip(own, names, strict=True))):
            yield names


def contradictions(kind: AnyKind, spec: MachineSpec, scene: Scene, printed: SceneReport) -> Iterator[str]:
    """Relations that the printed loads of a scene do not keep, by their intervals or by their values."""
    loads = {one.info.name: one.estimate for one in printed.loads if not math.isnan(one.estimate.value)}
    for relation in kind.relations:
        if type(scene) not in relation.scenes:
            continue
        for names in parts_of(relation, loads):
            known = {name: loads[one] for name, one in names.items()}
            for name, bounds in relation.bounds(spec, scene, known).items():
                if not _touches(known[name], bounds):
                    yield f"{scene.label}: {names[name]} {known[name]} is outside {bounds}: {relation.why}"


def _touches(estimate: Estimate, bounds: Interval) -> bool:
    """Whether an estimate and the interval of a relation intersect, and the value is in it."""
    size = max(abs(end) for end in (estimate.value, bounds.low, bounds.high, 0.0) if math.isfinite(end))
    room = _ROUNDING * size
    return bounds.low - room <= estimate.value <= bounds.high + room


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.label)
def test_kinds_declare_relations(kind: AnyKind) -> None:
    assert len(kind.relations) >= 4
    names = {info.name for info in kind.loads}
    for relation in kind.relations:
        assert relation.why.strip()
        assert {family(name) for name in relation.loads} <= {family(name) for name in names}, relation.why


@pytest.mark.parametrize("index", range(NUMBER))
@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.label)
def test_declared_relations_hold_on_the_printed_report(kind: AnyKind, index: int) -> None:
    assert wrong(kind, SEED, index) == []


@pytest.mark.study
@pytest.mark.parametrize("part", range(20))
@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.label)
def test_on_two_hundred_machines_too(kind: AnyKind, part: int) -> None:
    assert [one for index in range(10 * part, 10 * part + 10) for one in wrong(kind, SEED + 1, index)] == []


def wrong(kind: AnyKind, seed: int, index: int) -> list[str]:
    """What a random machine says that does not agree with itself."""
    made = machine(kind, seed, index)
    report = check(replace(made.loaded, assumed=()), Options(repairs=False, budget=_CHEAP))
    scenes = {one.label: one for one in made.spec.all_scenes}
    found = [one.message for one in report.diagnostics if one.code == "NUM111"]
    found += [
        one for printed in report.scenes for one in contradictions(kind, made.spec, scenes[printed.name], printed)
    ]
    return [f"{made.name}: {one}" for one in found]


# -- a contradiction that is planted --------------------------------------------------------------------------------


def planting(solver: AnySolver, name: str, value: float) -> AnySolver:
    """The solver with another value of one load."""

    def run(spec: Any, scene: Any, carried: frozenset[str], level: int) -> Result:
        result = solver.run(spec, scene, carried, level)
        if name not in result.loads:
            return result
        false = Found(Estimate.exact(value))
        return replace(result, loads={**result.loads, name: false}, failures=(), beyond={})

    return replace(solver, run=run)


def outside(bounds: Interval, estimate: Estimate) -> float | None:
    """A value that no relation with these bounds allows; none where it allows all values of that sign."""
    if math.isfinite(bounds.high) and bounds.high > 0:
        return 3.0 * bounds.high
    if math.isfinite(bounds.low) and bounds.low > 0:
        return bounds.low / 3.0
    size = max(abs(end) for end in (bounds.low, bounds.high, estimate.value, 1.0) if math.isfinite(end))
    if math.isfinite(bounds.high):
        return bounds.high + size
    return bounds.low - size if math.isfinite(bounds.low) else None


def settled(kind: AnyKind, spec: MachineSpec, scene: Scene) -> Settled:
    return settle(kind, spec, plan_scene(kind, spec, scene), budget=_CHEAP)


@cache
def scenes_of(label: str) -> tuple[tuple[MachineSpec, Settled], ...]:
    """The scenes of the design files of a kind as they are computed, and of the same without one of their blocks."""
    (kind,) = (one for one in KINDS if one.label == label)
    found = []
    for text in texts(kind):
        data = yaml.load(text, yaml.BaseLoader)
        for key in (None, *(WITHOUT & data.keys())):
            less = {name: value for name, value in data.items() if name != key}
            spec = load_text(written(less), "spec.yaml").spec
            assert spec is not None
            found += [(spec, settled(kind, spec, scene)) for scene in spec.all_scenes]
    return tuple(found)


def planted(kind: AnyKind, relation: Relation) -> Iterator[tuple[str, Settled]]:
    """Scenes of the design files of a kind with a value planted that a relation does not allow, and the load."""
    for spec, honest in scenes_of(kind.label):
        scene = honest.plan.scene
        if type(scene) not in relation.scenes:
            continue
        known = {name: one for name, one in honest.estimates.items() if one.bounded}
        read = {name for one in honest.rulings if one.value is not None for name in one.check.loads}
        for names in parts_of(relation, known):
            bounds = relation.bounds(spec, scene, {name: known[one] for name, one in names.items()})
            for name in sorted(bounds, key=lambda name: names[name] not in read):
                value = outside(bounds[name], known[names[name]])
                if value is not None:
                    solvers = tuple(planting(one, names[name], value) for one in kind.solvers)
                    yield names[name], settled(replace(kind, solvers=solvers), spec, scene)


def told(load: str, found: Settled) -> bool:
    """Whether a planted value is a finding, and no check that reads it is decided."""
    codes = {one.code for one in found.findings}
    reading = [one for one in found.rulings if load in one.check.loads]
    open_ones = all(one.verdict in (Verdict.UNDECIDED, Verdict.NOT_CHECKED, Verdict.OFF) for one in reading)
    return load in found.broken and "NUM111" in codes and open_ones


CASES = [(kind, number) for kind in KINDS for number in range(len(kind.relations))]


@pytest.mark.parametrize(("kind", "number"), CASES, ids=lambda one: getattr(one, "label", str(one)))
def test_a_planted_contradiction_is_found(kind: AnyKind, number: int) -> None:
    """A relation that no design file has the loads of would be tested by nothing: none is."""
    relation = kind.relations[number]
    tried = []
    for load, found in planted(kind, relation):
        if told(load, found):
            return
        tried.append(f"{found.plan.scene.label}: {load} {found.loads[load].estimate if load in found.loads else '-'}")
    pytest.fail(f"{relation.why}: not found in {tried}")


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.label)
def test_a_planted_contradiction_makes_its_check_undecided(kind: AnyKind) -> None:
    """The reason that is printed names the relation."""
    read = {name for one in kind.checks for name in one.loads}
    for relation in (one for one in kind.relations if not read.isdisjoint(one.loads)):
        for load, found in planted(kind, relation):
            reasons = [one.reason for one in found.rulings if load in one.check.loads and one.value is not None]
            if told(load, found) and any(relation.why in one for one in reasons):
                return
    pytest.fail("no check reads a load of a relation")
