"""Shares of the take-up travel of random conveyors, against sums over their sections that share no code."""

from typing import Any

import numpy as np
import pytest
from support.bars import Limit, Trial, claim, known_to, misses, near, opposites, tried, verdicts
from support.conveyor_statics import Statics, drawn
from support.machines import loaded

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.conveyor.takeup.travel import TRAVEL

WITHOUT_BARS = {"conveyor": ("takeup_shares",)}
KIND = load_kind("conveyor")
SEED, MACHINES, REFERENCE = 2711, 40, 1e-9
LIMITS = (Limit("takeup_travel_total", ("takeup", "stroke"), 1e-3),)


def _mean(machine: Statics, loaded_with: str, rubs: float, at_tail: bool) -> float:
    """Mean tension over the loop less that of the take-up [N]; `rubs` is 0 without friction."""
    parts = machine.rig.lengths(loaded_with)
    half = len(parts) // 2
    forces = {name: drive.force for name, drive in machine.rig.drives.items()}
    pulls = sum(force for name, force in forces.items() if machine.rig.drives[name].at == "tail") / sum(forces.values())
    whole = sum(part.length * (rubs * part.friction + part.climb) for part in parts)
    tension, area, before_tail = 0.0, 0.0, 0.0
    for index, part in enumerate(parts):
        if index == half:
            before_tail = tension
            tension -= pulls * whole * (rubs > 0)
        rise = part.length * (rubs * part.friction + part.climb)
        area += part.length * (tension + rise / 2)
        tension += rise
    mean = area / sum(part.length for part in parts)
    return mean - before_tail if at_tail else mean


def truth_of(machine: Statics, keys: dict[str, float], at_tail: bool) -> dict[str, float]:
    rig = machine.rig
    length = sum(part.length for part in rig.lengths())
    rest = _mean(machine, "empty", 0.0, at_tail)
    means = [_mean(machine, state, 1.0, at_tail) - rest for state in ("full", "empty")]
    ways = [0.0] if rig.rigid else [0.0, *(length / 2 * mean / rig.stiffness for mean in means)]
    found = {
        "takeup_travel_elastic": max(ways) - min(ways),
        "takeup_travel_thermal": length / 2 * keys["thermal_expansion"] * keys["temperature_range"],
        "takeup_travel_permanent": length / 2 * machine.elongation,
        "takeup_travel_installation": keys["installation"],
    }
    return found | {"takeup_travel_total": sum(found.values())}


def trial_of(index: int) -> Trial:
    rng = np.random.default_rng((SEED, index))
    machine = drawn(rng)
    keys = {
        "thermal_expansion": float(rng.uniform(1e-5, 8e-5)),
        "temperature_range": float(rng.uniform(0, 60)),
        "installation": float(rng.uniform(0, 3)),
    }
    tail_is_free = all(drive.at == "head" for drive in machine.rig.drives.values())
    at_tail = tail_is_free and not machine.rig.rigid and bool(rng.random() < 0.5)
    data: dict[str, Any] = machine.running()
    units = {"thermal_expansion": "1/K", "temperature_range": "K", "installation": "m"}
    data["takeup"] |= {key: f"{value!r} {units[key]}" for key, value in keys.items()}
    data["takeup"] |= {"at": "tail"} if at_tail else {}
    spec = loaded(data).spec
    assert spec is not None
    scene = spec.all_scenes[0]
    truth = {name: known_to(REFERENCE, value) for name, value in truth_of(machine, keys, at_tail).items()}
    claims = {"run": claim(KIND, spec, scene, TRAVEL)}
    return tried(index, rng, KIND, spec, scene, claims, truth, LIMITS)


@pytest.fixture(scope="module")
def trials() -> list[Trial]:
    return [trial_of(index) for index in range(MACHINES)]


def test_the_shares_are_the_sums(trials: list[Trial]) -> None:
    assert misses(trials, "run") == []
    for trial in trials:
        assert trial.claims["run"].keys() >= trial.truth.keys()


def test_no_verdict_is_another(trials: list[Trial]) -> None:
    assert opposites(trials) == []
    assert near(trials) > 0.3
    said = verdicts(trials, "CNV140")
    assert min(said.count(Verdict.PASS), said.count(Verdict.FAIL)) > 0.05 * len(said)
