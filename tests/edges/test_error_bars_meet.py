"""Rule 7: the intervals of one load always intersect, whatever accuracy, budget, window and effects are asked for."""

import os
from collections.abc import Callable
from itertools import combinations

import pytest
from support.random_machines import KINDS, all_on, longer, machine, meet, settled

from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.machine import AnyKind
from ptmcalc.spec.machine import MachineSpec
from ptmcalc.spec.scene import Scene

SEED = int(os.environ.get("PTMCALC_SEED", "37"))
NUMBER = 8
QUICK, STUDY = 0.4, 1.0
"""Predicted seconds of a scene of these and of the study, which takes all settings of each."""
AUTOMATIC, ALL_ON = "automatic", "all effects on"

Loads = dict[str, Estimate]
Asked = Callable[[], Loads]


def settings(kind: AnyKind, spec: MachineSpec, scene: Scene, seconds: float) -> dict[str, Asked]:
    """What can be asked for, and the loads of a scene by it; nothing of a run's own health."""

    def loads(of: MachineSpec = spec, what: Scene = scene, budget: float = seconds) -> Asked:
        def found() -> Loads:
            done = settled(of, kind, what, budget=budget)
            return {name: best.estimate for name, best in done.loads.items() if name not in best.result.health}

        return found

    asked = {AUTOMATIC: loads(), ALL_ON: loads(all_on(kind, spec, scene))}
    for accuracy in (0.05, 0.01, 0.001):
        asked[f"accuracy {accuracy:g}"] = loads(spec.model_copy(update={"accuracy": accuracy}))
    for budget in (seconds / 400, seconds / 20):
        asked[f"budget {budget:g} s"] = loads(budget=budget)
    if (longer_scene := longer(scene, 1.5)) is not scene:
        asked["window 1.5"] = loads(what=longer_scene)
    return asked


def disjoint(kind: AnyKind, seed: int, index: int, *, whole: bool = True) -> list[str]:
    """Loads of a random machine whose intervals do not intersect: of all settings, or of three with little work."""
    made = machine(kind, seed, index)
    wrong = []
    for number, scene in enumerate(made.spec.all_scenes):
        asked = settings(kind, made.spec, scene, STUDY if whole else QUICK)
        others = [name for name in asked if name != AUTOMATIC]
        chosen = asked if whole else dict.fromkeys((AUTOMATIC, ALL_ON, others[(index + number) % len(others)]))
        try:
            found = [(name, asked[name]()) for name in chosen]
        except NumericsError as error:
            wrong.append(f"{made.name}: {scene.label}: {error}")
            continue
        for (one, first), (other, second) in combinations(found, 2):
            wrong += [
                f"{made.name}: {scene.label}: {name}: {one} {first[name]}, {other} {second[name]}"
                for name in first.keys() & second.keys()
                if not meet(first[name], second[name])
            ]
    return wrong


@pytest.mark.parametrize("index", range(NUMBER))
@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.label)
def test_intervals_of_one_load_intersect(kind: AnyKind, index: int) -> None:
    assert disjoint(kind, SEED, index, whole=False) == []


@pytest.mark.parametrize(
    ("label", "seed", "index"), [("drivetrain", 11, 51), ("crane slewing", 61, 144), ("hoist", 61, 190)]
)
def test_machines_that_failed_once_do_not_fail_again(label: str, seed: int, index: int) -> None:
    """A motor that creeps to the speed of no surplus gained 1e-6 after the window; its bar was 5e-9. A slip-ring motor
    that waits at a step until a gust is over. A hoist that does not lift its load, on a rope that gets shorter."""
    (kind,) = (one for one in KINDS if one.label == label)
    assert disjoint(kind, seed, index) == []


@pytest.mark.study
@pytest.mark.parametrize("part", range(20))
@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.label)
def test_of_two_hundred_machines_too(kind: AnyKind, part: int) -> None:
    wrong = [one for index in range(10 * part, 10 * part + 10) for one in disjoint(kind, SEED + 1, index)]
    assert wrong == []
