"""What the bars of a stacker's events cover: closed forms with the bounds of their effects against the whole run.

Random machines, loads and racks, every other one near a limit; every bound holds everywhere, and a third of it would
not. The whole run itself is held by an independent integration.
"""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from support import stacker_ode
from support.bars import MACHINES, THIRD, WIDEST, Limit, Trial, claim_of, misses, near, opposites, tried, verdicts, wide
from support.machines import changed
from support.stacker_events import RACK, machine

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.effect import AnyEffect
from ptmcalc.engine.plan import plan_scene
from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.crane.stacking.fork.cases import catch_of, push_of
from ptmcalc.machines.crane.stacking.fork.caught import CAUGHT_STOPPED, CAUGHT_TRAIN
from ptmcalc.machines.crane.stacking.fork.effects import EFFECTS_OF_THE_FORK
from ptmcalc.machines.crane.stacking.fork.pushed import PUSH_RIGID, PUSH_TRAIN
from ptmcalc.machines.crane.stacking.rail.effects import EFFECTS_OF_THE_RAIL
from ptmcalc.machines.crane.stacking.safety_gear.effects import EFFECTS_OF_THE_SAFETY_GEAR

ON_TRIAL = {
    "crane": (
        "fork_catching", "rack_elasticity", "hoist_motor_slope", "load_limiter", "fork_pushing", "column_yield",
        "caught_stopped", "caught_train", "push_rigid", "push_train",
    )
}  # fmt: skip
KIND = next(one for one in load_kind("crane").types if one.type == "rack_stacker")
COUNT, SEED = 30, 20261122
REFERENCE = 1e-7
"""What the independent integration is good for."""
EFFECT = {effect.name: effect for effect in (*EFFECTS_OF_THE_FORK, *EFFECTS_OF_THE_RAIL, *EFFECTS_OF_THE_SAFETY_GEAR)}


def caught(rng: np.random.Generator, **fixed: Any) -> dict[str, Any]:
    """A fork caught by a rack of any stiffness, by a motor of any strength and slope."""
    weight = rng.uniform(700, 3000)
    drive = {"reduced_mass": f"{10 ** rng.uniform(2.5, 4.2)} kg"}
    if rng.random() < 0.7:
        drive["largest_force"] = f"{weight * 9.81 * rng.uniform(1, 2.8)} N"
    if rng.random() < 0.7 or "largest_force" not in drive:
        drive["slope"] = f"{10 ** rng.uniform(3, 5.3)} N*s/m"
    return changed(
        RACK,
        load=f"{weight - 600} kg",
        hoisting__speed=f"{rng.uniform(0.05, 1.0)} m/s",
        hoisting__rope__stiffness=f"{10 ** rng.uniform(5, 6.7)} N/m",
        hoisting__drive=drive,
        rack__stiffness_vertical=f"{10 ** rng.uniform(5.3, 7.5)} N/m",
        **fixed,
    )


def pushed(rng: np.random.Generator) -> dict[str, Any]:
    fork = {
        "mass": f"{10 ** rng.uniform(1, 3)} kg",
        "speed": f"{rng.uniform(0.02, 0.6)} m/s",
        "motor_force": f"{10 ** rng.uniform(3, 4)} N",
    }
    if rng.random() < 0.4:
        fork["clutch_force"] = f"{10 ** rng.uniform(2.8, 3.6)} N"
    return changed(
        RACK,
        load=f"{rng.uniform(1, 2000)} kg",
        fork=fork,
        rack__stiffness_push=f"{10 ** rng.uniform(4.5, 6.5)} N/m",
        column__second_moment=f"{10 ** rng.uniform(3.5, 5)} cm^4",
        scenes=[{"type": "fork_push", "height": f"{rng.uniform(2, 12.5)} m"}],
    )


WAYS: dict[str, dict[str, Any]] = {
    "caught": {
        "stopped": (CAUGHT_STOPPED, ("fork_catching",)),
        "no rack": (CAUGHT_TRAIN, ("fork_catching", "hoist_motor_slope", "load_limiter")),
        "no slope": (CAUGHT_TRAIN, ("fork_catching", "rack_elasticity", "load_limiter")),
        "whole": (CAUGHT_TRAIN, CAUGHT_TRAIN.represents),
    },
    "pushed": {"rigid": (PUSH_RIGID, ("fork_pushing",)), "whole": (PUSH_TRAIN, PUSH_TRAIN.represents)},
}
LIMITS = {
    "caught": (Limit("fork_caught_factor", ("checks", "fork_caught_factor"), least=0.1),),
    "pushed": (Limit("fork_push_force", ("rack", "rating_push"), least=1.0),),
}


def trial_of(sort: str, index: int) -> Trial:
    rng = np.random.default_rng((SEED, sorted(WAYS).index(sort), index))
    spec = machine({"caught": caught, "pushed": pushed}[sort](rng))
    (scene,) = spec.all_scenes
    plan = plan_scene(KIND, spec, scene)
    claims = {name: claim_of(plan, spec, solver, carried) for name, (solver, carried) in WAYS[sort].items()}
    truth = {name: one for name, one in claims["whole"].items() if name != "energy_residual"}
    cheap = {name: one for name, one in claims.items() if name != "whole"}
    return replace(tried(index, rng, KIND, spec, scene, cheap, truth, LIMITS[sort]), claims=claims)


@pytest.fixture(scope="module")
def sample() -> dict[str, list[Trial]]:
    return {sort: [trial_of(sort, index) for index in range(MACHINES)] for sort in WAYS}


@pytest.mark.parametrize(("sort", "way"), [(sort, way) for sort in WAYS for way in WAYS[sort] if way != "whole"])
def test_a_bar_holds_the_whole_run_and_a_third_of_it_would_not(
    sample: dict[str, list[Trial]], sort: str, way: str
) -> None:
    assert misses(sample[sort], way) == []
    assert misses(sample[sort], way, THIRD)


@pytest.mark.parametrize("way", ["stopped", "no rack", "no slope"])
def test_the_bar_of_a_caught_fork_is_not_much_wider_than_its_error(sample: dict[str, list[Trial]], way: str) -> None:
    assert wide(sample["caught"], way) <= WIDEST


@pytest.mark.parametrize("sort", sorted(WAYS))
def test_the_ladder_never_says_the_opposite(sample: dict[str, list[Trial]], sort: str) -> None:
    trials = sample[sort]
    assert opposites(trials) == []
    assert near(trials) >= 0.45
    said = verdicts(trials, *{"caught": ("CRN284",), "pushed": ("CRN287",)}[sort])
    assert min(said.count(Verdict.PASS), said.count(Verdict.FAIL)) > 0.1 * MACHINES


def test_the_whole_run_holds_the_independent_integration(sample: dict[str, list[Trial]]) -> None:
    """As many machines as the time allows; both kinds of motor and racks of any stiffness are among them."""
    for trial in sample["caught"][:8]:
        case = catch_of(trial.spec, trial.spec.all_scenes[0])  # type: ignore[arg-type, attr-defined]
        force = min(case.cap, 1e9) if case.slope else case.force
        one = stacker_ode.Caught(
            case.drive_mass, case.carriage_mass, case.weight, case.rope, case.rack, case.speed, force, case.slope
        )  # fmt: skip
        known = trial.truth["rope_force_caught"]
        exact = one.peaks(case.window())[0]
        assert abs(known.value - exact) <= known.bar + REFERENCE * exact
    for trial in [one for one in sample["pushed"] if not push_of(one.spec, one.spec.all_scenes[0]).clutch][:8]:  # type: ignore[arg-type, attr-defined]
        push = push_of(trial.spec, trial.spec.all_scenes[0])  # type: ignore[arg-type, attr-defined]
        given = (push.mass, push.carriage_mass, push.rack, push.support, push.speed, push.force, push.window())
        exact = stacker_ode.pushed(*given)
        known = trial.truth["fork_push_force"]
        assert abs(known.value - exact) <= known.bar + REFERENCE * exact


def both(data: dict[str, Any]) -> tuple[Mapping[str, Estimate], Mapping[str, Estimate]]:
    """What the closed form claims with the bounds of all it leaves out, and what the whole run finds."""
    spec = machine(data)
    (scene,) = spec.all_scenes
    plan = plan_scene(KIND, spec, scene)
    claim = claim_of(plan, spec, CAUGHT_STOPPED, ("fork_catching",))
    return claim, claim_of(plan, spec, CAUGHT_TRAIN, CAUGHT_TRAIN.represents)


def sampled(seed: int, of: Any, **fixed: Any) -> "list[dict[str, Any]]":
    rng = np.random.default_rng(seed)
    return [of(rng, **fixed) for _ in range(COUNT)]


def test_a_soft_motor_on_a_rack_that_does_not_give() -> None:
    """There the bound is the work of the motor alone."""
    below = 0
    for data in sampled(84, caught):
        claim, whole = both({**data, "rack": {"stiffness_push": "500 kN/m"}})
        one, value = claim["rope_force_caught"], whole["rope_force_caught"].value
        assert one.low <= value * (1 + 1e-9)
        assert value <= one.high * (1 + 1e-9)
        below += value < one.value - (one.value - one.low) / 3
    assert below > 0


def test_a_limiter_that_never_trips_needs_no_bound() -> None:
    for data in sampled(85, caught):
        claim, whole = both(changed(data, hoisting__limiter={"force": "1 MN", "reaction": "50 ms"}))
        one, value = claim["rope_force_caught"], whole["rope_force_caught"].value
        assert one.low <= value * (1 + 1e-9)
        assert value <= one.high * (1 + 1e-9)


def test_a_limiter_that_may_trip_is_never_left_out() -> None:
    rng = np.random.default_rng(86)
    for _ in range(COUNT):
        data = changed(caught(rng), hoisting__limiter={"force": "15 kN", "reaction": "50 ms"})
        spec = machine(data)
        scene = spec.all_scenes[0]
        effect: AnyEffect = EFFECT["load_limiter"]
        criterion = effect.criterion(spec, scene)
        assert criterion is not None
        loads = {name: one.estimate for name, one in CAUGHT_STOPPED.run(spec, scene, frozenset(), 0).loads.items()}
        bounds = effect.bound(spec, scene, loads)
        assert bool(bounds) == criterion.exceeded
        assert not any(offset.bounded for offset in bounds.values())


def test_without_the_catch_the_weight_is_all() -> None:
    """What leaving the catch out would change: between nothing and the bound of the energy."""
    beyond = 0
    for data in sampled(88, caught):
        spec = machine(data)
        scene = spec.all_scenes[0]
        weight = spec.gravity * (spec.load + 600)
        still = {"rope_force_caught": Estimate.exact(weight)}
        offset = EFFECT["fork_catching"].bound(spec, scene, still)["rope_force_caught"]
        force = CAUGHT_TRAIN.run(spec, scene, CAUGHT_TRAIN.represents, 0).loads["rope_force_caught"].estimate.value
        assert weight + offset.low <= force <= weight + offset.high
        beyond += force > weight + offset.high / 3
    assert beyond > 0
