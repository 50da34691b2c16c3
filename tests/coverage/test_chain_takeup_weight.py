"""Bound of the take-up weight's inertia in a start of a chain, against finite elements with and without it.

What is on trial is a start known without the weight, and the bound around it: no other way knows the weight.
"""

from typing import Any

import numpy as np
import pytest
from scipy.linalg import expm, solve
from support import chain_fem
from support.bars import (
    MACHINES,
    THIRD,
    Limit,
    Trial,
    misses,
    near,
    numbers,
    opposites,
    told,
    tried,
    verdicts,
    wide,
    widest,
)
from support.chain_starts import KIND, built, random_chain

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.estimate import NOTHING, Estimate
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive
from ptmcalc.machines.chain_drive.starting.bounds import loads_of
from ptmcalc.machines.chain_drive.starting.motion import StartCase, start_case

ON_TRIAL = {"chain_drive": ("takeup_weight",)}
WAY = "takeup_weight"
WEIGHT = next(effect for effect in KIND.effects if effect.name == WAY)
LIMIT = Limit("safety_start", ("checks", "safety_start"), least=1e-6)
SEED, ALWAYS = 3_301, 70
PIECES, STEPS = 16, 900


def peaks(case: StartCase, weight: float, force: float, window: float) -> float:
    """Largest run-on tension over the static one after a step of rim force; the weight hangs on both falls beside the
    drive and moves by half of what they differ."""
    loop = case.masses
    strands = (
        chain_fem.Strand(1.0, loop.carry_mass, 1 / loop.carry_compliance),
        chain_fem.Strand(1.0, loop.return_mass, 1 / loop.return_compliance),
    )
    mass, stiff = chain_fem.matrices(chain_fem.Chain(strands, loop.tail_mass), PIECES, lumped=True)
    mass[0, 0] += loop.drive_mass
    ends = np.ix_([0, -1], [0, -1])
    mass[ends] += weight / 4 * np.array([[1, -1], [-1, 1]])
    n, dt = len(mass), window / STEPS
    rate = np.zeros((2 * n + 1, 2 * n + 1))
    rate[:n, n : 2 * n] = np.eye(n)
    rate[n : 2 * n, :n] = -solve(mass, stiff)
    rate[n : 2 * n, -1] = solve(mass, np.eye(n)[0] * force)
    step, state, most = expm(rate * dt), np.append(np.zeros(2 * n), 1.0), 0.0
    for _ in range(STEPS):
        state = step @ state
        most = max(most, float(stiff[0, 1] * (state[1] - state[0])))
    return most


def light_enough(spec: ChainDrive, data: dict[str, Any], share: float) -> tuple[ChainDrive, float]:
    """The same machine with a weight at so much of the threshold, and its mass."""
    low, high = 1e-6, 1e6
    for _ in range(60):
        mass = (low * high) ** 0.5
        spec = built(
            data | {"layout": data["layout"] | {"takeup": data["layout"]["takeup"] | {"mass": f"{mass:.9g} kg"}}}
        )
        criterion = WEIGHT.criterion(spec, spec.all_scenes[0])
        assert criterion is not None
        low, high = (mass, high) if criterion.value < share else (low, mass)
    return spec, low


def trial_of(number: int) -> Trial:
    rng = np.random.default_rng((SEED, number))
    while True:
        data = random_chain(rng)
        data["layout"]["takeup"]["type"] = "gravity"
        spec = built(data)
        bare = start_case(spec, spec.all_scenes[0])
        alone = bare.acceleration * bare.whole_mass / bare.masses.drive_mass / 0.03 / 9.81 if bare.moves else 1.0
        if alone <= 0.85:
            break
    spec, mass = light_enough(spec, data, float(rng.uniform(max(0.4, alone), 0.95)))
    (scene,) = spec.all_scenes
    case = start_case(spec, scene)
    force, window = case.acceleration * case.whole_mass, min(case.window, 2.0)
    without, exact = (
        loads_of(spec, case, Estimate.exact(peaks(case, weight, force, window)), None) for weight in (0.0, mass)
    )
    offsets = WEIGHT.bound(spec, scene, without)
    claims = {name: one.widened(offsets.get(name, NOTHING)) for name, one in without.items()}
    return tried(number, rng, KIND, spec, scene, {WAY: claims}, exact, [LIMIT], climbs=False)


@pytest.fixture(scope="module", params=numbers(ALWAYS))
def trials(request: pytest.FixtureRequest) -> list[Trial]:
    return [trial_of(number) for number in request.param]


def test_the_bound_of_the_weight_holds_what_it_changes(trials: list[Trial]) -> None:
    assert misses(trials, WAY) == []
    assert wide(trials, WAY) <= widest(WAY), told(trials)


def test_a_third_of_it_would_not(trials: list[Trial]) -> None:
    """Nor a sixth of it on the few that are always tried."""
    assert misses(trials, WAY, THIRD if len(trials) == MACHINES else THIRD / 2) != []


def test_no_verdict_is_the_opposite_of_the_elements(trials: list[Trial]) -> None:
    assert opposites(trials) == []
    assert near(trials) >= 0.45
    said = verdicts(trials, "CHN122")
    assert min(said.count(Verdict.PASS), said.count(Verdict.FAIL)) > 0.05 * len(said)
