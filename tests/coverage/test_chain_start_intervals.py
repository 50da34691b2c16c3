"""Bars of every solver of a chain's start, stop and speed range hold the next better one, near limits and away from
them, on seeded machines."""

import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import pytest
from support.bars import (
    MACHINES,
    THIRD,
    WIDEST,
    Limit,
    Trial,
    claim_of,
    misses,
    near,
    numbers,
    opposites,
    tried,
    verdicts,
    wide,
)
from support.chain_starts import KIND, built, profile, random_chain

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.estimate import Estimate
from ptmcalc.engine.plan import ScenePlan, plan_scene
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive
from ptmcalc.machines.chain_drive.speed_change.tooth_passes import RANGE, START_TEETH
from ptmcalc.machines.chain_drive.starting.breakaway import BREAKAWAY
from ptmcalc.machines.chain_drive.starting.motion import start_case
from ptmcalc.machines.chain_drive.starting.rigid import RIGID_START
from ptmcalc.machines.chain_drive.starting.waves import ONE_MODE, WAVES, natural_frequencies
from ptmcalc.machines.chain_drive.stopping.formulas import HELD, STOP_WAVES, STOPPED

ON_TRIAL = {
    "chain_drive": (
        "chain_rigid_start",
        "chain_one_mode",
        "chain_start_waves",
        "chain_start_teeth",
        "chain_stop",
        "chain_stop_waves",
        "chain_run_through",
        "chain_elasticity",
        "higher_modes",
        "tooth_passing",
    )
}
WITHOUT_BARS = {"chain_drive": ("chain_breakaway", "chain_sticking", "chain_hold")}
START_LOADS = ("tension_dynamic_start", "tension_start", "safety_start", "tension_min")
STOP_LOADS = ("safety_start", "tension_min")
LIMIT = Limit("safety_start", ("checks", "safety_start"), least=1e-6)
SEED = 2_101


def kept(claims: Mapping[str, Estimate], names: tuple[str, ...]) -> dict[str, Estimate]:
    return {name: one for name, one in claims.items() if name in names}


def machine(rng: np.random.Generator, scene: Callable[[], dict[str, Any]], effects: dict[str, str]) -> ChainDrive:
    """A chain that the waves can carry, of the scene drawn."""
    while True:
        spec = built(random_chain(rng, **scene()) | {"effects": effects})
        if WAVES.usable_for(spec, spec.all_scenes[0]):
            return spec


# -- waves ----------------------------------------------------------------------------------------------------------

NO_TEETH = {"tooth_passing": "off"}
WAVY = {"rigid body": (RIGID_START, 0), "two masses": (ONE_MODE, 0), "coarse waves": (WAVES, 0)}


def wave_trial(number: int) -> Trial:
    """Truth is the sum of many modes; on every fifth machine one of four times as many."""
    rng = np.random.default_rng((SEED, 1, number))
    spec = machine(rng, lambda: {"profile": profile(rng)}, NO_TEETH)
    (scene,) = spec.all_scenes
    plan = plan_scene(KIND, spec, scene)
    claims = {
        name: kept(claim_of(plan, spec, solver, solver.always, level), START_LOADS)
        for name, (solver, level) in WAVY.items()
    }
    truth = kept(claim_of(plan, spec, WAVES, WAVES.always, 2 if number % 5 == 0 else 1), START_LOADS)
    return tried(number, rng, KIND, spec, scene, claims, truth, [LIMIT])


@pytest.fixture(scope="module", params=numbers(20))
def waves(request: pytest.FixtureRequest) -> list[Trial]:
    return [wave_trial(number) for number in request.param]


@pytest.mark.parametrize("way", WAVY)
def test_a_bar_of_a_start_holds_its_waves(waves: list[Trial], way: str) -> None:
    assert misses(waves, way) == []
    assert wide(waves, way) <= WIDEST


@pytest.mark.parametrize("way", ["rigid body", "two masses"])
def test_a_third_of_it_would_not(waves: list[Trial], way: str) -> None:
    """The bar of the coarse waves is that of the modes they leave out, whose phases are never all at their worst."""
    assert misses(waves, way, THIRD) != []


def test_no_verdict_of_a_start_is_the_opposite(waves: list[Trial]) -> None:
    assert opposites(waves) == []
    assert near(waves) >= 0.45
    said = verdicts(waves, "CHN122", "CHN123")
    assert min(said.count(Verdict.PASS), said.count(Verdict.FAIL)) > 0.1 * len(waves)


def test_more_modes_have_smaller_bars(waves: list[Trial]) -> None:
    name = "tension_dynamic_start"
    bars = np.array([(trial.claims["coarse waves"][name].bar, trial.truth[name].bar) for trial in waves])
    bars = bars[np.isfinite(bars).all(axis=1)]
    assert np.all(bars[:, 1] <= bars[:, 0] * (1 + 1e-9))
    assert bars[:, 1].sum() < 0.6 * bars[:, 0].sum()


# -- teeth ----------------------------------------------------------------------------------------------------------

RAMP = {"shape": "ramp", "time": "1.5 s"}
SHAPES = ({}, RAMP, RAMP | {"control": "torque"}, {"shape": "cosine", "time": "2 s", "control": "torque"})


def tooth_trial(number: int) -> Trial:
    """Truth is every pass of every tooth, with what it says of itself."""
    rng = np.random.default_rng((SEED, 2, number))
    spec = machine(rng, lambda: {"profile": SHAPES[number % len(SHAPES)]}, {})
    (scene,) = spec.all_scenes
    plan = plan_scene(KIND, spec, scene)
    claims = {"waves": kept(claim_of(plan, spec, WAVES, WAVES.always, 1), START_LOADS)}
    truth = kept(claim_of(plan, spec, START_TEETH, START_TEETH.always, 0), START_LOADS)
    return tried(number, rng, KIND, spec, scene, claims, truth, [LIMIT])


@pytest.fixture(scope="module", params=numbers(12))
def teeth(request: pytest.FixtureRequest) -> list[Trial]:
    return [tooth_trial(number) for number in request.param]


def test_the_bound_of_the_teeth_holds_every_pass(teeth: list[Trial]) -> None:
    assert misses(teeth, "waves") == []
    assert misses(teeth, "waves", THIRD) != []
    assert wide(teeth, "waves") <= WIDEST
    assert opposites(teeth) == []
    assert near(teeth) >= 0.45


# -- stops ----------------------------------------------------------------------------------------------------------


def stop_trial(number: int) -> Trial:
    rng = np.random.default_rng((SEED, 3, number))
    while True:
        data = random_chain(rng)
        motor = float(data["drive"]["motor"]["mean_starting_torque"].split()[0])
        torque = motor * float(rng.uniform(0.2, 1.5))
        brake = {"torque": f"{torque:.6g} N*m", "delay": "0.1 s", "rise_time": "0.2 s"}
        spec = built(data | {"brake": brake, "scenes": [{"type": ("stop", "coast")[number // 2 % 2]}]})
        (scene,) = spec.all_scenes
        if STOP_WAVES.usable_for(spec, scene):
            break
    plan = plan_scene(KIND, spec, scene)
    claims = {
        "rigid body": kept(claim_of(plan, spec, STOPPED), STOP_LOADS),
        "coarse waves": kept(claim_of(plan, spec, STOP_WAVES, STOP_WAVES.always, 0), STOP_LOADS),
    }
    truth = kept(claim_of(plan, spec, STOP_WAVES, STOP_WAVES.always, 1), STOP_LOADS)
    return tried(number, rng, KIND, spec, scene, claims, truth, [LIMIT])


@pytest.fixture(scope="module", params=numbers(20))
def stops(request: pytest.FixtureRequest) -> list[Trial]:
    return [stop_trial(number) for number in request.param]


@pytest.mark.parametrize("way", ["rigid body", "coarse waves"])
def test_a_bar_of_a_stop_holds_its_waves(stops: list[Trial], way: str) -> None:
    assert misses(stops, way) == []
    assert wide(stops, way) <= WIDEST


def test_no_verdict_of_a_stop_is_the_opposite(stops: list[Trial]) -> None:
    assert misses(stops, "rigid body", THIRD) != []
    assert opposites(stops) == []
    assert near(stops) >= 0.45


# -- ranges of speed ------------------------------------------------------------------------------------------------


def range_trial(number: int) -> Trial:
    """The coarsest run through a range of speeds, and one of four times as many modes and places of the first joint."""
    rng = np.random.default_rng((SEED, 4, number))
    data = random_chain(rng)
    speed = float(data["speed"].split()[0])
    scene = {
        "type": "speed_range",
        "from": f"{speed * float(rng.uniform(0.2, 0.9))!r} m/s",
        "to": f"{speed * float(rng.uniform(1.0, 1.5))!r} m/s",
        "time": f"{float(np.exp(rng.uniform(0, 3)))!r} s",
    }
    spec = built(data | {"scenes": [scene]})
    (read,) = spec.all_scenes
    plan: ScenePlan = plan_scene(KIND, spec, read)
    names = ("tension_speed_range", "safety_start")
    claims = {"coarse": kept(claim_of(plan, spec, RANGE, RANGE.always, 0), names)}
    truth = kept(claim_of(plan, spec, RANGE, RANGE.always, 2), names)
    return tried(number, rng, KIND, spec, read, claims, truth, [LIMIT])


@pytest.fixture(scope="module", params=numbers(10))
def ranges(request: pytest.FixtureRequest) -> list[Trial]:
    return [range_trial(number) for number in request.param]


def test_a_bar_of_a_speed_range_holds_more_modes_and_places(ranges: list[Trial]) -> None:
    assert misses(ranges, "coarse") == []
    assert misses(ranges, "coarse", THIRD) != []
    assert wide(ranges, "coarse") <= WIDEST
    assert opposites(ranges) == []


# -- no bar but rounding --------------------------------------------------------------------------------------------


def breakaway_trial(number: int) -> Trial:
    """A relaxed chain without damping as two masses: the drive winds it up, then both swing against each other.

        stuck until S = F (1 - cos w t) = W;    then x'' + w_r^2 x = F/m + W/M

    The mass of the strands is left out on purpose: with it nothing is known, and the claim has no end.
    """
    rng = np.random.default_rng((SEED, 5, number))
    while True:
        data = random_chain(rng, chain="relaxed") | {"effects": {"higher_modes": "off", "tooth_passing": "off"}}
        data["chain"] |= {"damping": {"ratio": 0.0}}
        data["layout"]["takeup"]["type"] = "gravity"
        spec = built(data)
        (scene,) = spec.all_scenes
        if BREAKAWAY.usable_for(spec, scene):
            break
    plan = plan_scene(KIND, spec, scene)
    claims = {"chain_breakaway": kept(claim_of(plan, spec, BREAKAWAY, BREAKAWAY.always), START_LOADS)}
    static = claims["chain_breakaway"]["tension_start"].value - claims["chain_breakaway"]["tension_dynamic_start"].value
    case = start_case(spec, scene)
    drive, load, pull, resist = (
        case.masses.drive_mass,
        case.masses.belt_mass,
        case.available,
        case.line.static_resistance,
    )
    stiffness = float(natural_frequencies(case, 1)[0]) ** 2 * drive * load / (drive + load)
    loose, speed = resist / stiffness, 0.0
    speed = math.sqrt(max((2 * pull * loose - stiffness * loose**2) / drive, 0.0))
    reduced = drive * load / (drive + load)
    middle = (pull / drive + resist / load) * reduced / stiffness
    peak = stiffness * (middle + math.hypot(loose - middle, speed / math.sqrt(stiffness / reduced)))
    dynamic = max(case.line.run_off + peak - case.line.run_on, 0.0)
    truth = {
        "tension_dynamic_start": Estimate.exact(dynamic),
        "tension_start": Estimate.exact(static + dynamic),
    }
    return tried(number, rng, KIND, spec, scene, claims, truth, [LIMIT])


@pytest.fixture(scope="module", params=numbers(30))
def loose(request: pytest.FixtureRequest) -> list[Trial]:
    return [breakaway_trial(number) for number in request.param]


def test_what_breaks_loose_is_two_masses(loose: list[Trial]) -> None:
    assert misses(loose, "chain_breakaway") == []
    assert opposites(loose) == []
    assert near(loose) >= 0.45


def test_nothing_is_claimed_of_a_relaxed_chain_whose_load_may_stick() -> None:
    rng = np.random.default_rng((SEED, 6))
    for _ in range(MACHINES):
        spec = built(random_chain(rng, chain="relaxed"))
        (scene,) = spec.all_scenes
        if WAVES.usable_for(spec, scene):
            claims = claim_of(plan_scene(KIND, spec, scene), spec, RIGID_START)
            assert not any(claims[name].bounded for name in START_LOADS)


def hold_trial(number: int) -> Trial:
    """A loaded conveyor at rest, from its file alone: the weight of its load against what friction holds."""
    rng = np.random.default_rng((SEED, 7, number))
    data = random_chain(rng)
    data["layout"]["resistance"] |= {"turn_factor": 1.0}
    if number % 2 == 0:  # steep enough to run back
        data["layout"] |= {"lift": f"{0.7 * float(str(data['layout']['length']).split()[0])} m"}
    data |= {"scenes": [{"type": "backstop"}], "backstop": {"torque": "1 kN*m"}}
    number_of = {key: float(str(data["layout"][key]).split()[0]) for key in ("length", "lift", "load")}
    chain, resistance = float(data["chain"]["mass"].split()[0]), data["layout"]["resistance"]
    level = math.sqrt(number_of["length"] ** 2 - number_of["lift"] ** 2)
    friction = resistance["stop_factor"] * resistance["coefficient"] * 9.81 * level * (2 * chain + number_of["load"])
    arm = float(data["chain"]["pitch"].split()[0]) * data["sprocket"]["teeth"] / (2 * math.pi)
    torque = max(9.81 * number_of["load"] * number_of["lift"] - friction, 0.0) * arm
    spec = built(data)
    (scene,) = spec.all_scenes
    claims = {"chain_hold": claim_of(plan_scene(KIND, spec, scene), spec, HELD)}
    assert spec.backstop is not None
    reserve = spec.backstop.reserve

    def rated(spec: ChainDrive, limit: float) -> ChainDrive:
        return spec.with_value(("backstop", "torque"), limit * reserve)

    truth = {"backstop_torque": Estimate.exact(torque)}
    return tried(number, rng, KIND, spec, scene, claims, truth, [Limit("backstop_torque", rated, least=1e-3)])


def test_what_runs_back_is_the_weight_less_the_friction() -> None:
    trials = [hold_trial(number) for number in range(MACHINES)]
    assert misses(trials, "chain_hold") == []
    assert opposites(trials) == []
    assert sum(trial.near for trial in trials) > 0.1 * MACHINES
    assert sum(trial.truth["backstop_torque"].value > 0 for trial in trials) > 0.1 * MACHINES
