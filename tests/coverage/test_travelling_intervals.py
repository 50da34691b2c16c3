"""Bars of a travelling crane's small angles against an integration at any angle: they hold, and are needed."""

import math
from dataclasses import replace

import numpy as np
import pytest
from support import travel_ode
from support.bars import (
    THIRD,
    WIDEST,
    Limit,
    Trial,
    bounded,
    claim_of,
    misses,
    near,
    numbers,
    opposites,
    tried,
    verdicts,
    wide,
)
from support.machines import loaded
from support.travel_ode import Machine, Seen
from support.travelling import as_file

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.estimate import Estimate
from ptmcalc.engine.plan import Rung, plan_scene
from ptmcalc.engine.registry import load_kind
from ptmcalc.engine.widen import widen
from ptmcalc.machines.crane.travelling.sway.effects import IN_PLANE
from ptmcalc.machines.crane.travelling.sway.sway_exact import SWAY_EXACT
from ptmcalc.machines.crane.travelling.sway.sway_linear import SWAY_LINEAR
from ptmcalc.machines.crane.travelling.sway.sway_simulated import SWAY_SIMULATED

ON_TRIAL = {
    "crane": (
        "travel_sway", "drive_reaction", "hoisting_sway", "travel_wind", "large_sway", "torque_curve", "wheel_slip",
        "sway_linear", "sway_exact", "sway_simulated",
    )
}  # fmt: skip
SEED, ALWAYS = 1907, 50
REFERENCE = 2e-6
"""What the reference is good for."""
KIND = next(one for one in load_kind("crane").types if one.type == "travelling")


def random_ramp(rng: np.random.Generator) -> Machine:
    """A start or stop along a ramp, from gentle to as steep as nobody drives."""
    ramp = float(10 ** rng.uniform(-1.3, 0.6))
    length = float(rng.uniform(1.0, 20.0))
    swings = float(rng.uniform(0.15, 3.0))
    speed = ramp * swings * 2 * math.pi * math.sqrt(length / 9.81)
    load = float(10 ** rng.uniform(2.5, 4.5))
    body = float(rng.uniform(0.5, 4.0)) * load + 1200.0
    return Machine(bool(rng.integers(2)), speed, load, body, length, 0.005 * (load + body) * 9.81, ramp=ramp)


def truths(one: Machine, seen: Seen) -> dict[str, float]:
    """What the reference says of each load, with levers of its own."""
    wheels = [_wheels(one, *state) for state in seen.states]
    grips = [
        0.5 * min(loads) / abs(traction / 4) if traction else math.inf
        for loads, (_, _, _, traction) in zip(wheels, seen.states, strict=True)
    ]
    return {
        "sway_angle_max": seen.sway,
        "sway_residual": seen.residual,
        "horizontal_force": max(map(abs, seen.pulls)),
        "wheel_load_max": max(map(max, wheels)),
        "wheel_load_min": min(map(min, wheels)),
        "traction_max": max(abs(state[3]) for state in seen.states),
        "skid_reserve_min": min(grips) if min(map(min, wheels)) > 0 else 0.0,
    }


def _wheels(one: Machine, a: float, pull: float, weight: float, traction: float) -> list[float]:
    """Trolley of 1 t with its hook 1 m from either rail of 20 m, 1.5 m high; the rest in the middle, 1 m high."""
    g, base, body = 9.81, 4.0, one.body - 1000.0
    loads = []
    for share in (0.95, 0.05):
        down = (body * g / 2 + (1000 * g + weight) * share) / 2
        back = (body * a * 1.0 / 2 + (1000 * a + pull) * 1.5 * share) / base
        loads += [down - back, down + back]
    return loads


WAYS = {
    "small angles": (SWAY_LINEAR, IN_PLANE, 0),
    "closed form": (SWAY_EXACT, SWAY_EXACT.represents, 0),
    "simulated": (SWAY_SIMULATED, SWAY_SIMULATED.represents, 0),
}
LIMITS = (
    Limit("sway_angle_max", ("checks", "sway_angle"), 1e-6, 1.5),
    Limit("sway_residual", ("checks", "residual_sway"), 1e-6, 1.5),
    Limit("skid_reserve_min", ("checks", "skid_reserve"), 0.01),
    Limit("wheel_load_max", ("wheels", "rating"), 1.0),
)
SIMULATED = 10
"""Every so many a machine is simulated too."""


def trial_of(index: int) -> Trial:
    rng = np.random.default_rng((SEED, index))
    one = random_ramp(rng)
    spec = loaded(as_file(one)).spec
    assert spec is not None
    (scene,) = spec.all_scenes
    plan = plan_scene(KIND, spec, scene)
    ways = [name for name in WAYS if name != "simulated" or index % SIMULATED == 0]
    claims = {name: claim_of(plan, spec, *WAYS[name]) for name in ways}
    seen = {
        name: Estimate.within(value, REFERENCE * value) for name, value in truths(one, travel_ode.travel(one)).items()
    }
    truth = claims["closed form"] | seen
    return replace(
        tried(index, rng, KIND, spec, scene, {"small angles": claims["small angles"]}, truth, LIMITS), claims=claims
    )


@pytest.fixture(scope="module", params=numbers(ALWAYS))
def trials(request: pytest.FixtureRequest) -> list[Trial]:
    return [trial_of(index) for index in request.param]


@pytest.mark.parametrize("way", WAYS)
def test_a_bar_holds_the_integration_at_any_angle(trials: list[Trial], way: str) -> None:
    assert misses(trials, way) == []


def test_a_third_of_the_bars_of_small_angles_would_not_and_they_are_not_much_wider(trials: list[Trial]) -> None:
    tight = {miss.load for miss in misses(trials, "small angles", THIRD)}
    assert {"sway_residual", "horizontal_force", "traction_max"} <= tight
    assert wide(trials, "small angles") <= WIDEST
    assert wide(trials, "closed form") <= WIDEST
    assert bounded(trials, "small angles", "sway_residual") > 0.7


def test_the_ladder_never_says_the_opposite(trials: list[Trial]) -> None:
    assert opposites(trials) == []
    assert near(trials) >= 0.45
    said = verdicts(trials, "CRN153", "CRN154", "CRN155")
    assert min(said.count(Verdict.PASS), said.count(Verdict.FAIL)) > 0.1 * len(trials)


@pytest.mark.parametrize("what", ["hoisting", "wind", "torque"])
def test_what_has_no_bound_is_not_bounded(what: str) -> None:
    one = Machine(True, 1.0, 1e4, 2e4, 8.0, 1500.0, ramp=0.15)
    changes = {
        "hoisting": {"hoisting": 0.1},
        "wind": {"wind_on_load": 500.0},
        "torque": {"ramp": None, "force": 6000.0},
    }
    data = as_file(Machine(**{**one.__dict__, **changes[what]}))
    spec = loaded(data).spec
    assert spec is not None
    plan = plan_scene(KIND, spec, spec.all_scenes[0])
    result = SWAY_LINEAR.run(spec, plan.scene, IN_PLANE, 0)  # type: ignore[arg-type]
    assert not widen(plan, spec, Rung(SWAY_LINEAR, IN_PLANE, 0, 0.0), result)["sway_angle_max"].bounded
