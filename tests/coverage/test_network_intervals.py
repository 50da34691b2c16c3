"""Bars of the belt in cells are claims: on seeded random machines the same scene in 16 times the cells lies within.

The bars are those of the coarsest level, the reference is the finest grid of a level four steps above. Only the
discretisation is judged here; the physics of both is the same.
"""

import math
from dataclasses import dataclass

import numpy as np
import pytest
from support.bars import MACHINES, Limit, Trial, misses, near, opposites, tried, wide, widest
from support.conveyor_scenes import SCENES, random_scene
from support.machines import spec_of

from ptmcalc.base.estimate import Estimate
from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.conveyor.machine.motion import moving
from ptmcalc.machines.conveyor.waves import cell_runs, network

ON_TRIAL = {"conveyor": ("network", "running_network")}
KIND = load_kind("conveyor")
LIMITS = (
    Limit("stop_distance", ("checks", "stop_distance"), least=0.01),
    Limit("stop_distance", ("checks", "emergency_stop_distance"), least=0.01),
    Limit("stop_time", ("checks", "stop_time"), least=0.01),
    Limit("slip_reserve_min", ("checks", "slip", "reserve"), least=1.0),
)
FINER = 16
MOST_CONTOURS = 10  # longer scenes cost more and say no more
EFFECTS = frozenset({"belt_wave", "tail_jump", "tail_mass", "slip", "coulomb_idlers"})
SEEDS = range(42)


@dataclass(frozen=True)
class Case:
    """A machine: what the bars claim of each load, and the load in many more cells."""

    seed: int
    scene: str
    trial: Trial
    claims: dict[str, Estimate]
    fine: dict[str, float]

    def ratios(self) -> dict[str, float]:
        """Distance from the finer grid in bars, of the loads with a finite bar."""
        found = {}
        for name, claim in self.claims.items():
            if not math.isfinite(claim.value) or not math.isfinite(claim.bar):
                continue
            apart = abs(self.fine[name] - claim.value)
            found[name] = apart / claim.bar if apart else 0.0
        return found


def cases_of(seeds: range, most_contours: float) -> list[Case]:
    found = []
    for seed in seeds:
        runs = seed % 3 == 0
        data = random_scene(seed) | {"effects": {"moving_belt": "on" if runs else "off"}}
        spec = spec_of(data)
        (scene,) = spec.all_scenes
        case = moving(spec, scene)
        refused = network.valid(spec, scene)
        if (refused and refused.exceeded) or case.window > most_contours * case.line.contour_time:
            continue
        carried = EFFECTS | ({"takeup_mass"} if "mass" in data["takeup"] else set())
        carried |= {"moving_belt"} if runs else set()
        claims = {name: one.estimate for name, one in network.run(spec, scene, carried, 0).loads.items()}
        values = cell_runs.marched(
            case, carried, cell_runs.grids_of(scene, 0)[0] * FINER, True, cell_runs.grids_of(scene, 0)[0] * FINER
        ).values
        fine = {name: value for name, (value, _) in values.items()}
        known = {name: Estimate.exact(value) for name, value in fine.items()}
        rng = np.random.default_rng((seed, 1))
        trial = tried(seed // 2, rng, KIND, spec, scene, {"network": claims}, known, LIMITS)
        found.append(Case(seed, scene.type, trial, claims, fine))
    return found


def missed(cases: list[Case]) -> list[tuple[int, str, str, float]]:
    return [
        (case.seed, case.scene, name, ratio) for case in cases for name, ratio in case.ratios().items() if ratio > 1
    ]


@pytest.fixture(scope="module")
def cases() -> list[Case]:
    return cases_of(SEEDS, MOST_CONTOURS)


def test_the_sample_has_every_scene_and_several_drives(cases: list[Case]) -> None:
    assert {case.scene for case in cases} == {"start", "stop", "coast", "jam", "emergency_stop"}
    assert len(SCENES) == 6
    several = [case for case in cases if "slip_utilisation_max[two]" in case.claims]
    assert len(several) >= 0.2 * len(cases)
    assert len(cases) >= 25


def test_the_bars_are_no_empty_claims(cases: list[Case]) -> None:
    """Nearly all are finite, and most are small beside the largest tension."""
    bars = [(claim, case.claims["tension_max"].value) for case in cases for claim in case.claims.values()]
    finite = [claim for claim, _ in bars if math.isfinite(claim.bar)]
    assert len(finite) >= 0.9 * len([claim for claim, _ in bars if math.isfinite(claim.value)])
    tensions = [case.claims["tension_max"] for case in cases if case.scene != "jam"]
    assert sorted(one.bar / abs(one.value) for one in tensions)[len(tensions) // 2] < 0.03


def test_every_bar_holds_the_finer_grid(cases: list[Case]) -> None:
    assert missed(cases) == []
    assert misses([case.trial for case in cases], "network") == []


def test_a_third_of_the_bars_would_not(cases: list[Case]) -> None:
    assert max(max(case.ratios().values()) for case in cases) > 1 / 3


def test_they_are_not_much_wider_than_the_true_error_and_no_verdict_is_the_opposite(cases: list[Case]) -> None:
    trials = [case.trial for case in cases]
    assert wide(trials, "network") <= widest("network")
    assert opposites(trials) == []
    assert near(trials) >= 0.4


def test_a_load_that_never_comes_is_never_there_in_the_finer_grid(cases: list[Case]) -> None:
    """A belt that does not stop on one grid stops on none."""
    for case in cases:
        for name, claim in case.claims.items():
            if not math.isfinite(claim.value):
                assert case.fine[name] == claim.value, (case.seed, name)


@pytest.mark.study
def test_every_bar_holds_the_finer_grid_on_a_larger_sample() -> None:
    cases = cases_of(range(1000, 1000 + 2 * MACHINES), 40)
    assert len(cases) >= MACHINES
    assert missed(cases) == []
    assert opposites([case.trial for case in cases]) == []
