"""The bound of what a running belt carries along: the belt in cells on one grid, with it and without it.

That the cells carry it rightly is held by `tests/numerics/test_belt_travel.py`. The bound is calibrated: machines here
are others than those it was found with.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache

import numpy as np
import pytest
from support.conveyors import random_conveyor, text

from ptmcalc.base.estimate import Estimate
from ptmcalc.machines.conveyor.machine.model import belt_line
from ptmcalc.machines.conveyor.machine.motion import moving
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.waves import cell_runs
from ptmcalc.machines.conveyor.waves.effects import moving_belt
from ptmcalc.machines.conveyor.waves.effects.moving_belt import TRAVEL_THRESHOLD, belt_travel

CELLS = 240
MOST_ROUNDS = 16
CARRIED = frozenset({"belt_wave", "tail_jump", "tail_mass", "coulomb_idlers"})
TENSIONS = ("tension_run_on_max", "tension_run_off_min", "tension_max", "tension_min")
SCENES = {
    "torque": ({"profile": "step"}, {"profile": "torque_ramp"}, {"profile": "torque_cosine"}),
    "speed": ({"profile": "ramp"}, {"profile": "cosine"}),
    "relaxed": ({"profile": "step"}, {"profile": "torque_ramp"}, {"profile": "cosine"}),
    "stop": ({},),
    "jam": ({},),
}


@dataclass(frozen=True)
class Change:
    """What the running belt changed of a tension, over what the bound allows."""

    seed: int
    load: str
    used: float


def _machine(scene: str, seed: int) -> Conveyor:
    """A conveyor whose v/c is drawn up to the threshold."""
    rng = np.random.default_rng(seed)
    forms = SCENES[scene]
    data = random_conveyor(rng, **forms[int(rng.integers(len(forms)))])
    if scene == "relaxed":
        data["scenes"][0]["belt"] = "relaxed"
    elif scene == "jam":
        data["scenes"] = [{"type": "jam", "at": str(rng.choice(["head", "tail"])), "time": "0.3 s"}]
    elif scene == "stop":
        data["scenes"] = [{"type": "stop", "load": data["scenes"][0]["load"]}]
        data["brakes"] = {"disc": {"torque": text(float(np.exp(rng.uniform(7, 11))), "N*m"), "rise_time": "0.5 s"}}
    line = belt_line(spec := Conveyor.model_validate(data), spec.all_scenes[0])
    share = TRAVEL_THRESHOLD * float(np.exp(rng.uniform(math.log(0.1), 0.0)))
    data["speed"] = text(line.speed * share / belt_travel(line) * (1 - 1e-9), "m/s")
    return Conveyor.model_validate(data)


def _changes(scene: str, seed: int) -> Iterator[Change]:
    spec = _machine(scene, seed)
    case = moving(spec, spec.all_scenes[0])
    if not 0 < case.window < MOST_ROUNDS * case.line.contour_time:
        return
    still, moves = (
        cell_runs.marched(case, carried, CELLS, True, CELLS).values for carried in (CARRIED, CARRIED | {"moving_belt"})
    )
    loads = {name: Estimate.exact(value) for name, (value, _) in still.items()}
    allowed = moving_belt.travel_bound(spec, case.scene, loads)
    for name in TENSIONS:
        if name in allowed and (most := max(allowed[name].high, -allowed[name].low)) > 0:
            yield Change(seed, name, abs(moves[name][0] - still[name][0]) / most)


@cache
def changes(scene: str, first: int, number: int) -> list[Change]:
    found: list[Change] = []
    for seed in range(first, first + number):
        found += _changes(scene, seed)
    return found


@pytest.mark.parametrize("scene", SCENES)
def test_the_bound_holds_what_the_running_belt_changes(scene: str) -> None:
    found = changes(scene, 21_000, 16)
    assert len(found) > 8
    assert [change for change in found if change.used > 1] == []


@pytest.mark.study
@pytest.mark.parametrize("scene", SCENES)
def test_the_bound_holds_on_a_larger_sample_and_is_no_empty_claim(scene: str) -> None:
    found = changes(scene, 22_000, 300)
    assert [change for change in found if change.used > 1] == []
    assert max(change.used for change in found) > 1 / 3
