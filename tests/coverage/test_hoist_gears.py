"""A gear that gives and has play against an integration of its own; without it nothing is claimed, or nothing lost."""

from typing import Any

import numpy as np
import pytest
from support.bars import Limit, Trial, bounded, claim_of, misses, near, numbers, opposites, tried, verdicts
from support.hoist_gear import lift, lower, random_geared
from support.hoists import hoist_of
from support.travelling_statics import number

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.estimate import Estimate
from ptmcalc.engine.plan import plan_scene
from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.hoist.motion.effects import ALWAYS
from ptmcalc.machines.hoist.motion.hoist_train import TRAIN

WITHOUT_BARS = {"hoist": ("gear_backlash", "gear_elasticity")}
KIND = load_kind("hoist")
SEED, ALWAYS_TRIED = 1951, 16
KNOWN = 1e-6
"""What the reference is good for, as a share; of a force, of the largest."""
WAYS: dict[str, frozenset[str]] = {
    "elastic with play": TRAIN.represents,
    "elastic": ALWAYS | {"structure", "gear_elasticity"},
    "rigid": ALWAYS | {"structure"},
}
LIMITS = (
    Limit("gear_impact_factor", ("checks", "gear_impact"), 1.0001),
    Limit("lift_off_factor", ("checks", "lift_off_factor"), 1.0001),
    Limit("lowering_brake_factor", ("checks", "lowering_factor"), 1.0001),
)


def trial_of(index: int) -> Trial:
    """A lift from rest, or a stop of a lowered load; one whose motion is not followed to its end is drawn again."""
    for again in range(20):
        rng = np.random.default_rng((SEED, index, again))
        one, data = random_geared(rng)
        asked: dict[str, Any] = data["scenes"][index % 4 // 2]
        spec = hoist_of(data | {"scenes": [asked]})
        (scene,) = spec.all_scenes
        plan = plan_scene(KIND, spec, scene)
        window = TRAIN.run(spec, plan.scene, TRAIN.represents, 0).window
        assert window is not None
        lifts = asked["type"] == "lift"
        found = lift(one, number(asked["slack"]), window[1]) if lifts else lower(one, window[1])
        if found is not None:
            break
    else:
        raise AssertionError("no machine whose motion is followed to its end")
    found["natural_frequency"] = one.frequency()
    sizes = {"rope_force_min": found["rope_force_max"], "rope_force_share": 1.0}
    truth = {name: Estimate.within(value, KNOWN * sizes.get(name, abs(value))) for name, value in found.items()}
    claims = {name: claim_of(plan, spec, TRAIN, carried) for name, carried in WAYS.items()}
    return tried(index, rng, KIND, spec, scene, claims, truth, LIMITS)


@pytest.fixture(scope="module", params=numbers(ALWAYS_TRIED))
def machines(request: pytest.FixtureRequest) -> list[Trial]:
    return [trial_of(index) for index in request.param]


@pytest.mark.parametrize("way", WAYS)
def test_what_is_claimed_is_what_is_integrated(machines: list[Trial], way: str) -> None:
    assert misses(machines, way) == []


def _taut(trial: Trial) -> bool:
    """Whether the rope is not known to go slack."""
    least = trial.claims["elastic with play"].get("rope_force_min")
    return least is None or least.low > 0


def test_without_the_gear_nothing_is_known_and_without_its_play_only_where_there_is_none(
    machines: list[Trial],
) -> None:
    taut = [trial for trial in machines if _taut(trial)]
    assert len(taut) > 0.7 * len(machines)
    assert bounded(taut, "elastic with play", "gear_impact_factor") == 1, "only a rope that goes slack has no upper end"
    assert 0 < bounded(machines, "elastic", "gear_impact_factor") < 1
    assert bounded(machines, "rigid", "gear_impact_factor") == 0
    for trial in machines:
        whole, even = (trial.claims[way]["rope_force_max"] for way in ("elastic with play", "elastic"))
        assert not even.bounded or whole.value == pytest.approx(even.value, rel=1e-9)


def test_no_verdict_is_another(machines: list[Trial]) -> None:
    assert opposites(machines) == []
    assert near(machines) >= 0.4
    said = verdicts(machines, "HST120", "HST122", "HST125")
    assert min(said.count(Verdict.PASS), said.count(Verdict.FAIL)) > 0.05 * len(said)
