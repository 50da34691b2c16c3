"""Rule 5: an effect that is forced on is simulated, or refused with the reason; one that is forced off is in no run and
in no bound, and what can be computed without it is computed."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import pytest
import yaml
from support.machines import changed, load_of, report_of
from support.random_machines import KINDS, settled, texts

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.contract.effect import AnyEffect
from ptmcalc.contract.machine import AnyKind
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.forced import why_not
from ptmcalc.engine.load import load_text
from ptmcalc.engine.plan import PlannedEffect, ScenePlan, plan_scene
from ptmcalc.engine.settled import Settled
from ptmcalc.engine.unknown import why_open
from ptmcalc.spec.machine import MachineSpec
from ptmcalc.spec.scene import Scene

_BUDGET = 1.0
"""Predicted seconds of work of a scene."""
EFFECTS = [(kind, effect) for kind in KINDS for effect in kind.effects]


@dataclass(frozen=True)
class Where:
    """A scene of a design file that an effect belongs to."""

    spec: MachineSpec
    scene: Scene
    price: float
    """of the cheapest run that carries the effect; infinite where none does [s]"""
    reason: str
    """why none does"""


def forced(spec: MachineSpec, name: str, wish: str) -> MachineSpec:
    return spec.model_copy(update={"effects": {**spec.effects, name: wish}})


def planned(plan: ScenePlan, name: str) -> PlannedEffect:
    return next(one for one in plan.effects if one.effect.name == name)


@cache
def specs(label: str) -> tuple[MachineSpec, ...]:
    """The design files of a kind."""
    (kind,) = (one for one in KINDS if one.label == label)
    found = [load_text(text.encode(), "spec.yaml").spec for text in texts(kind)]
    assert None not in found
    return tuple(one for one in found if one is not None)


@cache
def places(label: str, name: str) -> tuple[Where, ...]:
    """The scenes of all design files that an effect belongs to."""
    kind, effect = next(one for one in EFFECTS if (one[0].label, one[1].name) == (label, name))
    found = []
    for spec in specs(label):
        for scene in (one for one in spec.all_scenes if effect.applies_to(one)):
            plan = plan_scene(kind, forced(spec, name, "on"), scene)
            carrying = [rung.seconds for rung in plan.rungs if name in rung.carried]
            reason = why_not(kind, spec, plan, planned(plan, name))
            found.append(Where(spec, scene, min(carrying, default=float("inf")), reason))
    return tuple(found)


def cheapest(kind: AnyKind, effect: AnyEffect) -> Where:
    """The scene in which the effect costs least; where nothing carries it, the first one."""
    return min(places(kind.label, effect.name), key=lambda one: one.price)


@cache
def as_it_is(kind: str, name: str) -> tuple[Where, Settled]:
    """A scene of an effect that nobody forces."""
    manifest, effect = next(one for one in EFFECTS if (one[0].label, one[1].name) == (kind, name))
    where = cheapest(manifest, effect)
    return where, settled(where.spec, manifest, where.scene, budget=_BUDGET)


def verdicts(found: Settled) -> dict[tuple[str, str], Verdict]:
    return {(one.check.code, one.check.element): one.verdict for one in found.rulings}


def opened(before: Settled, after: Settled) -> set[tuple[str, str]]:
    """Checks that were decided before and are undecided after."""
    known = verdicts(before)
    return {key for key, one in verdicts(after).items() if one is Verdict.UNDECIDED and known.get(key) in DECIDED}


DECIDED = (Verdict.PASS, Verdict.FAIL)


def name_of(value: Any) -> str:
    return str(getattr(value, "label", getattr(value, "name", value)))


# -- on -------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("kind", "effect"), EFFECTS, ids=name_of)
def test_on_is_simulated_or_refused_with_a_reason(kind: AnyKind, effect: AnyEffect) -> None:
    """In each scene of each design file some run carries it, or a reason tells why none can."""
    for where in places(kind.label, effect.name):
        assert (where.reason == "") == (where.price < float("inf")), (where.scene.label, where.reason)


@pytest.mark.parametrize(("kind", "effect"), EFFECTS, ids=name_of)
def test_on_is_in_the_loads_that_are_reported(kind: AnyKind, effect: AnyEffect) -> None:
    where, before = as_it_is(kind.label, effect.name)
    found = settled(forced(where.spec, effect.name, "on"), kind, where.scene, budget=_BUDGET)
    told = any(one.code == "NUM103" for one in found.findings)
    if where.price < float("inf"):
        assert effect.name in found.carried or told
    assert not opened(before, found) or found.findings, opened(before, found)


@pytest.mark.parametrize("kind", KINDS, ids=name_of)
def test_on_that_no_scene_can_simulate_is_refused(kind: AnyKind) -> None:
    """The file is invalid, and the message names the effect; one that only some scenes can simulate is warned of."""
    spec = specs(kind.label)[0]
    plans = [plan_scene(kind, spec, scene) for scene in spec.all_scenes]
    data = yaml.safe_load(kind.template)
    for name in dict.fromkeys(one.effect.name for plan in plans for one in plan.effects):
        wished = forced(spec, name, "on")
        again = [plan_scene(kind, wished, scene) for scene in spec.all_scenes]
        about = [plan for plan in again if any(one.effect.name == name for one in plan.effects)]
        if all(why_not(kind, wished, plan, planned(plan, name)) for plan in about):
            report = check(load_text(yaml.safe_dump(data | {"effects": {name: "on"}}).encode(), "on.yaml"), Options())
            assert report.verdict == "invalid"
            assert any(one.code == "SPC205" and f"`{name}`" in one.message for one in report.diagnostics)


# -- off ------------------------------------------------------------------------------------------------------------


def unbounded(effect: AnyEffect) -> AnyEffect:
    """The effect with a bound that must not be asked for."""

    def bound(spec: Any, scene: Any, loads: Mapping[str, Estimate]) -> Mapping[str, Interval]:
        raise AssertionError(f"`{effect.name}` is off and was bounded")

    return replace(effect, bound=bound)


@pytest.mark.parametrize(("kind", "effect"), EFFECTS, ids=name_of)
def test_off_is_in_no_run_and_in_no_bound(kind: AnyKind, effect: AnyEffect) -> None:
    where, before = as_it_is(kind.label, effect.name)
    parts = {one.name for one in kind.effects if effect.name in (one.name, one.part_of)}
    without = replace(kind, effects=tuple(unbounded(one) if one.name in parts else one for one in kind.effects))
    spec = forced(where.spec, effect.name, "off")
    found = settled(spec, without, where.scene, budget=_BUDGET)
    assert not any(parts & run.rung.carried for run in found.runs)
    for ruling in found.rulings:
        if (ruling.check.code, ruling.check.element) in opened(before, found):
            assert ruling.value is not None or why_open(kind, spec, found, ruling.check.loads)
    if not found.loads and before.loads:
        able = [one for one in kind.solvers if one.decides and one.usable_for(spec, where.scene)]
        assert all(parts & one.always for one in able), "nothing is computed without it"


@pytest.mark.parametrize("wish", ["on", "off"])
@pytest.mark.parametrize("kind", KINDS, ids=name_of)
def test_no_forced_effect_breaks_a_file(kind: AnyKind, wish: str) -> None:
    """All effects at once, by the command's own way; exit 4 would be an exception here."""
    data = yaml.safe_load(kind.template)
    effects = {one.name: wish for one in kind.effects}
    loaded = load_text(yaml.safe_dump(data | {"effects": effects}).encode(), "all.yaml")
    if loaded.spec is not None:
        assert check(replace(loaded, assumed=()), Options(repairs=False, budget=0.3)).verdict != "broken"


# -- the pull of a load on a crane ----------------------------------------------------------------------------------


@pytest.mark.parametrize("scene", [{"type": "start"}, {"type": "brake", "by": "brake"}], ids=lambda one: one["type"])
def test_a_crane_without_the_pull_of_its_load_moves_as_if_that_were_rigid(scene: dict[str, str]) -> None:
    """m v/F: (15.2 t + 10.25 t + rotors) 1.05 m/s over the motors' force less the resistance."""
    (kind,) = (one for one in KINDS if one.label == "crane travelling")
    data = changed(yaml.safe_load(kind.template), drive__acceleration=None, drive__brake__delay="0 s", scenes=[scene])
    data = changed(data, drive__brake__rise_time="0 s", wheels__inertia="0 kg*m^2", rolling={"coefficient": 0.008})
    starts = scene["type"] == "start"
    torque, loss = (2 * 32.0, 0.9) if starts else (16.0, 1 / (2 - 1 / 0.9))
    mass = 15200 + 10250 + 2 * 0.008 * 22**2 * loss / 0.1575**2
    force = torque * 22 * loss / 0.1575 + (-1 if starts else 1) * 0.008 * 25450 * 9.81
    name = "start_time" if starts else "brake_time"
    times = {
        word: load_of(report_of(data | {"effects": {"drive_reaction": word}}).scenes[0], name).estimate
        for word in ("auto", "off")
    }
    assert times["off"].value == pytest.approx(1.05 * mass / force, rel=1e-6)
    assert abs(times["auto"].value / times["off"].value - 1) > 1e-3, "the load that swings pulls at the crane"


# -- an effect that is not in the scene -----------------------------------------------------------------------------


def test_an_effect_that_is_absent_from_a_scene_takes_nothing_away_from_it() -> None:
    """No motor of this crane has a curve: forced off, it leaves every verdict as it is."""
    (kind,) = (one for one in KINDS if one.label == "crane travelling")
    data = yaml.safe_load(kind.template)
    as_is, without = (
        check(load_text(yaml.safe_dump(data | {"effects": effects}).encode(), "crane.yaml"), Options(repairs=False))
        for effects in ({}, {"torque_curve": "off"})
    )
    before, after = (
        [(scene.name, one.code, one.element, one.verdict) for scene, one in report.judgements]
        for report in (as_is, without)
    )
    assert before == after
