"""Error bars are claims: those of one rigid shaft, of a train without play and of every refinement hold the truth.

Truth is an independent integration of every machine, and the finest run with everything in it where that one says
nothing. Half of the machines stand within three bars of a limit; the ladder never says of one the opposite.
"""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from support import hybrid
from support.bars import (
    MACHINES,
    THIRD,
    WIDEST,
    Limit,
    Loads,
    Trial,
    claim_of,
    misses,
    near,
    opposites,
    tried,
    verdicts,
    wide,
)
from support.drivetrain_samples import linear_train, loads_of, machine_of, motor_train, number, train_with_play
from support.drivetrains import spec_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import family, of
from ptmcalc.engine.plan import plan_scene
from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.drivetrain.motion.elastic import ELASTIC
from ptmcalc.machines.drivetrain.motion.reduced import REDUCED
from ptmcalc.machines.drivetrain.vibration.modal import MODAL

ON_TRIAL = {"drivetrain": ("reduced", "elastic", "elasticity", "backlash")}
WITHOUT_BARS = {"drivetrain": ("modal_train",)}
KIND = load_kind("drivetrain")
EVERYTHING = frozenset({"elasticity", "backlash"})
SORTS: dict[str, Callable[[np.random.Generator], dict[str, Any]]] = {
    "linear": linear_train,
    "play": train_with_play,
    "motor": motor_train,
}
WAYS = {
    "one shaft": (REDUCED, frozenset(), 0),
    "without play": (ELASTIC, frozenset({"elasticity"}), 0),
    "first refinement": (ELASTIC, EVERYTHING, 0),
    "second refinement": (ELASTIC, EVERYTHING, 1),
    "finest": (ELASTIC, EVERYTHING, 2),
}
TRIED = {
    "linear": ("one shaft", "first refinement", "finest"),
    "play": ("one shaft", "without play", "first refinement", "finest"),
    "motor": ("one shaft", "first refinement", "second refinement", "finest"),
}
MORE_THAN_ROUNDING = {
    "linear": ("one shaft",),
    "play": ("without play",),
    "motor": ("first refinement", "second refinement"),
}
"""Ways of which one has bars that are more than rounding on a sort of machines."""
REFERENCE = 3e-9
"""What the independent integration is good for, as a share of the largest load of a kind."""
POSITIONS = 1e-12
"""How well it knows a position, as a share of the way a train has turned: ten times what it asks of its steps."""
SEED = 20261122
ALWAYS = {"linear": 30, "play": 18, "motor": 15}
SAMPLES = [
    *(pytest.param((sort, count), id=f"{sort}-some-{count}") for sort, count in ALWAYS.items()),
    *(pytest.param((sort, MACHINES), id=f"{sort}-all-{MACHINES}", marks=pytest.mark.study) for sort in SORTS),
]


def trial_of(sort: str, index: int) -> Trial:
    rng = np.random.default_rng((SEED, list(SORTS).index(sort), index))
    data = SORTS[sort](rng)
    spec = spec_of(data)
    (scene,) = spec.all_scenes
    plan = plan_scene(KIND, spec, scene)
    claims = {name: _moving(claim_of(plan, spec, *WAYS[name])) for name in TRIED[sort]}
    limits = [Limit(of("torque_peak", link), ("links", link, "limit"), least=1e-9) for link in spec.links]
    cheap = {name: claims[name] for name in list(claims)[:-1]}
    trial = tried(index, rng, KIND, spec, scene, cheap, claims["finest"] | _truth(data), limits)
    return replace(trial, claims=claims)


def _moving(loads: Loads) -> dict[str, Estimate]:
    """Loads that come from the motion, and not from the rigid train whatever the way."""
    return {name: one for name, one in loads.items() if family(name) not in ("torque_steady", "energy_residual")}


def _truth(data: dict[str, Any]) -> dict[str, Estimate]:
    """What the independent integration finds, and how well it knows it."""
    found = loads_of(data)
    assert len(found) > 5
    stiffest = max(number(link["stiffness"]) for link in data["links"].values())
    way = max(abs(value) for name, value in found.items() if family(name) == "angle_end")
    read = REFERENCE * 1e-3 + POSITIONS * stiffest * (0.1 + way)
    return {name: Estimate.within(value, REFERENCE * _size(name, found) + read) for name, value in found.items()}


def _size(load: str, loads: dict[str, float]) -> float:
    """Largest load of a kind."""
    kind = family(load).partition("_")[0]
    return max(abs(value) for name, value in loads.items() if family(name).partition("_")[0] == kind)


@pytest.fixture(scope="module", params=SAMPLES)
def sample(request: pytest.FixtureRequest) -> tuple[str, list[Trial]]:
    sort, count = request.param
    return sort, [trial_of(sort, index) for index in range(count)]


@pytest.mark.parametrize("way", WAYS)
def test_a_bar_holds_the_truth_on_every_machine(sample: tuple[str, list[Trial]], way: str) -> None:
    """That of the finest run holds the independent integration."""
    assert misses(sample[1], way) == []


def test_a_third_of_it_would_not(sample: tuple[str, list[Trial]]) -> None:
    sort, trials = sample
    assert any(misses(trials, way, THIRD) for way in MORE_THAN_ROUNDING[sort])


@pytest.mark.parametrize("way", WAYS)
def test_it_is_not_much_wider_than_the_true_error(sample: tuple[str, list[Trial]], way: str) -> None:
    assert wide(sample[1], way) <= WIDEST


def test_the_claims_are_worth_something(sample: tuple[str, list[Trial]]) -> None:
    """A sample whose intervals are infinite proves nothing."""
    sort, trials = sample
    way = MORE_THAN_ROUNDING[sort][0]
    peaks = [one for trial in trials for name, one in trial.claims[way].items() if family(name) == "torque_peak"]
    assert sum(one.bounded for one in peaks) > {"linear": 0.9, "play": 0.3, "motor": 0.95}[sort] * len(peaks)
    if sort != "motor":
        assert sum(one.bar > 1e-6 * abs(one.value) for one in peaks) > 0.2 * len(peaks)


def test_the_ladder_never_says_the_opposite(sample: tuple[str, list[Trial]]) -> None:
    _, trials = sample
    assert opposites(trials) == []
    said = verdicts(trials)
    assert near(trials) >= 0.45
    assert min(said.count(Verdict.PASS), said.count(Verdict.FAIL)) > 0.1 * len(trials)
    assert said.count(Verdict.UNDECIDED) < 0.1 * len(said)


# -- natural frequencies, in closed form -----------------------------------------------------------------------------


def _frequencies(data: dict[str, Any]) -> np.ndarray:
    """Natural frequencies from the matrices of the train, those of its free travel left out [rad/s]."""
    machine = machine_of(data, play=False)
    groups = hybrid.Groups(machine)
    inertia, stiff = np.zeros(groups.count), np.zeros((groups.count, groups.count))
    for body, size in enumerate(machine.inertias):
        inertia[groups.of[body]] += size * groups.ratio[body] ** 2
    for link in machine.links:
        row = groups.row(link.first, link.second)
        stiff += link.stiffness * np.outer(row, row)
    squares = np.linalg.eigvalsh(stiff / np.sqrt(np.outer(inertia, inertia)))
    return np.sqrt(squares[squares > 1e-9 * squares[-1]])


def frequency_trial(index: int) -> Trial:
    rng = np.random.default_rng((SEED, 9, index))
    data = linear_train(rng)
    natural = _frequencies(data)
    sine = {"type": "sine", "amplitude": "1e-9 N*m", "phase": "0 rad", "at": next(iter(data["inertias"]))}
    if "mass" in data["inertias"][sine["at"]]:
        sine["amplitude"] = "1e-9 N"
    omega = float(rng.choice(natural)) * float(np.exp(rng.uniform(-0.7, 0.7)))
    data["torques"] = {"beat": sine | {"angular_frequency": f"{omega!r} rad/s"}}
    data["scenes"][0]["duration"] = f"{float(3 / natural[-1])!r} s"
    spec = spec_of(data)
    (scene,) = spec.all_scenes
    truth = {of("natural_frequency", str(k)): Estimate.exact(float(w)) for k, w in enumerate(natural, 1)}
    truth[of("resonance_separation", "beat")] = Estimate.exact(float(np.abs(omega / natural - 1).min()))
    limits = [Limit(of("resonance_separation", "beat"), ("checks", "resonance_margin"), 1e-6, 0.9)]
    claims = {"modal_train": claim_of(plan_scene(KIND, spec, scene), spec, MODAL)}
    return tried(index, rng, KIND, spec, scene, claims, truth, limits)


@pytest.fixture(scope="module")
def frequencies() -> list[Trial]:
    return [frequency_trial(index) for index in range(MACHINES)]


def test_natural_frequencies_are_those_of_its_matrices(frequencies: list[Trial]) -> None:
    assert misses(frequencies, "modal_train") == []
    assert sum(len(trial.claims["modal_train"]) for trial in frequencies) > 2 * MACHINES


def test_no_resonance_is_judged_the_opposite(frequencies: list[Trial]) -> None:
    assert opposites(frequencies) == []
    said = verdicts(frequencies, "DRV107")
    assert near(frequencies) >= 0.4
    assert min(said.count(Verdict.PASS), said.count(Verdict.FAIL)) > 0.1 * MACHINES
