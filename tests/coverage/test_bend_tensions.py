"""Tensions in horizontal curves of random conveyors against sums over every choice of loaded sections."""

import itertools

import numpy as np
import pytest
from support.bars import Trial, claim, known_to, misses, opposites, tried, verdicts
from support.belt_scenes import Rig
from support.machines import changed, loaded

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.conveyor.curves.tensions import BEND_TENSIONS

WITHOUT_BARS = {"conveyor": ("bend_tensions",)}
KIND = load_kind("conveyor")
SEED, MACHINES, REFERENCE = 1501, 40, 1e-9


def around(rig: Rig, filling: tuple[bool, ...]) -> tuple[list[float], list[float]]:
    """Tension of the return and of the carrying strand at the ends of the sections, counted from the tail."""
    full, empty, count = rig.lengths(), rig.lengths("empty"), len(rig.sections)
    belt = [*empty[:count], *((full if one else empty)[count + k] for k, one in enumerate(filling))]
    rises, area, way = [0.0], 0.0, 0.0
    for one in belt:
        rises.append(rises[-1] + one.length * (one.friction + one.climb))
        area, way = area + one.length * (rises[-1] + rises[-2]) / 2, way + one.length
    start = rig.tension - (area / way if rig.rigid else 0.0)
    whole = [start + rise for rise in rises]
    return whole[count::-1], whole[count:]


def truth_of(rig: Rig, number: int) -> dict[str, float]:
    """Extremes of the tensions in a section, counted from 0, over all fillings."""
    ends: dict[str, list[float]] = {}
    for filling in itertools.product((False, True), repeat=len(rig.sections)):
        back, carry = around(rig, filling)
        state = "full" if filling[number] else "empty"
        ends.setdefault(f"[{number + 1}_carry_{state}]", []).extend(carry[number : number + 2])
        ends.setdefault(f"[{number + 1}_return]", []).extend(back[number : number + 2])
    least = {f"tension_bend_min{name}": min(tensions) for name, tensions in ends.items()}
    return least | {f"tension_bend_max{name}": max(tensions) for name, tensions in ends.items()}


def trial_of(index: int) -> Trial:
    rng = np.random.default_rng((SEED, index))
    lengths = rng.uniform(100, 600, int(rng.integers(2, 5))).tolist()
    rig = Rig(
        sections=tuple((length, length * float(rng.uniform(-0.05, 0.08))) for length in lengths),
        tension=float(rng.uniform(40e3, 200e3)),
        load=float(rng.uniform(30, 250)),
        belt=float(rng.uniform(10, 40)),
        rigid=bool(rng.integers(2)),
    )
    number = int(rng.integers(len(lengths)))
    curve = {"radius": f"{rng.uniform(1000, 5000)!r} m", "banking": "5 deg", "banking_return": "4 deg"}
    data = changed(
        rig.data({"type": "run"}),
        belt__width="1200 mm",
        load__density="1600 kg/m^3",
        checks={"belt_drift": "95 mm"},
        idlers__carry__trough={"angle": "35 deg", "middle_roll": "465 mm"},
        **{f"route__sections__{number}__horizontal_curve": curve},
    )
    data["idlers"]["return"]["trough"] = {"angle": "15 deg", "middle_roll": "0 mm"}
    spec = loaded(data).spec
    assert spec is not None
    scene = spec.all_scenes[0]
    truth = {name: known_to(REFERENCE, value) for name, value in truth_of(rig, number).items()}
    return tried(index, rng, KIND, spec, scene, {"run": claim(KIND, spec, scene, BEND_TENSIONS)}, truth)


@pytest.fixture(scope="module")
def trials() -> list[Trial]:
    return [trial_of(index) for index in range(MACHINES)]


def test_the_tensions_are_the_extremes(trials: list[Trial]) -> None:
    assert misses(trials, "run") == []
    for trial in trials:
        assert trial.claims["run"].keys() == trial.truth.keys()


def test_no_verdict_is_another(trials: list[Trial]) -> None:
    assert opposites(trials) == []
    said = verdicts(trials, "CNV150", "CNV151")
    assert min(said.count(Verdict.PASS), said.count(Verdict.FAIL)) > 0.05 * len(said)
