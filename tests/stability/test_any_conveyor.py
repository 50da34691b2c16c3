"""Random conveyors in random scenes: no crash, no NaN, no bar below 0, and no two runs that contradict each other.

Warnings are errors. Every run of the ladder claims an interval for each load; any two of them must have a value in
common, whatever solver and whatever effects they carry, for the truth lies in both.
"""

import itertools
import math

import pytest
from support.any_conveyor import any_conveyor
from support.machines import spec_of

from ptmcalc.engine.plan import plan_scene
from ptmcalc.engine.registry import load_kind
from ptmcalc.engine.run import settle
from ptmcalc.engine.settled import Run, Settled
from ptmcalc.machines.conveyor.machine.spec import Conveyor

KIND = load_kind("conveyor")
BUDGET = 2.0
SEEDS = (1, 5, 7, 11, 12, 17, 19, 21, *range(100, 104))


def settled(spec: Conveyor) -> list[Settled]:
    return [settle(KIND, spec, plan_scene(KIND, spec, scene), budget=BUDGET) for scene in spec.all_scenes]


def faulty(run: Run) -> list[str]:
    """Loads that are no numbers in intervals."""
    return [
        name
        for name, one in run.estimates.items()
        if any(map(math.isnan, (one.value, one.low, one.high, one.numerical, one.model)))
        or not one.low <= one.value <= one.high
        or min(one.numerical, one.model) < 0
        or (name.startswith(("slip_distance", "slip_heat")) and one.low < 0)
    ]


def contradictory(one: Run, other: Run) -> list[str]:
    """Loads of which two runs claim intervals without a common value."""
    found = []
    for name in one.estimates.keys() & other.estimates.keys():
        a, b = one.estimates[name], other.estimates[name]
        rounding = 1e-9 * (abs(a.value) + abs(b.value)) if math.isfinite(a.value + b.value) else 0.0
        if max(a.low, b.low) > min(a.high, b.high) + rounding:
            found.append(name)
    return found


def _is_sound(seed: int) -> None:
    for scene in settled(spec_of(any_conveyor(seed))):
        label = scene.plan.scene.label
        assert {run.rung.solver.name: bad for run in scene.runs if (bad := faulty(run))} == {}, label
        for one, other in itertools.combinations(scene.runs, 2):
            assert contradictory(one, other) == [], (label, one.rung, other.rung)
        assert not [finding for finding in scene.findings if finding.code == "NUM101"], label


@pytest.mark.parametrize("seed", SEEDS)
def test_a_random_conveyor_ends_in_numbers_that_agree(seed: int) -> None:
    _is_sound(seed)


@pytest.mark.study
@pytest.mark.parametrize("seed", range(1000, 1300))
def test_any_of_300_conveyors_ends_in_numbers_that_agree(seed: int) -> None:
    _is_sound(seed)
