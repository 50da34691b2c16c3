"""A rack stacker on an uneven rail against wheels and a column that are integrated.

The answer of wheels that stay on the rail and that of wheels that may leave it claim no bar but rounding, or nothing
at all: where a wheel jumps the closed answer says so.
"""

import math

import numpy as np
import pytest
from support.bars import Limit, Trial, bounded, claim_of, misses, near, numbers, opposites, tried, verdicts
from support.machines import loaded
from support.stacker_rail import OnRail, random_rail

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.solver import AnySolver
from ptmcalc.engine.plan import plan_scene
from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.crane.stacking.rail.roll import RAIL_JUMP, RAIL_RESPONSE

WITHOUT_BARS = {"crane": ("aisle_rail", "aisle_rail_answer", "aisle_rail_jump", "wheel_lift")}
KIND = next(one for one in load_kind("crane").types if one.type == "rack_stacker")
SEED, ALWAYS = 1931, 24
WAYS: dict[str, AnySolver] = {"on the rail": RAIL_RESPONSE, "off the rail": RAIL_JUMP}
KNOWN = 1e-7
"""What the reference is good for, as a share; of a contact, of the static load."""
LIMITS = (
    Limit("rail_detuning", ("checks", "rail_detuning"), 0.001, 10.0),
    Limit("column_stress", ("checks", "column_stress"), 1.0),
)


def trial_of(index: int) -> Trial:
    rng = np.random.default_rng((SEED, index))
    data = random_rail(rng)
    spec = loaded(data).spec
    assert spec is not None
    (scene,) = spec.all_scenes
    plan = plan_scene(KIND, spec, scene)
    claims = {name: claim_of(plan, spec, way, way.always) for name, way in WAYS.items() if way.usable_for(spec, scene)}
    truth = {
        name: Estimate.within(value, KNOWN * (max(abs(value), 1.0) if name == "rail_contact" else abs(value)))
        for name, value in OnRail(data).loads().items()
    }
    return tried(index, rng, KIND, spec, scene, claims, truth, LIMITS)


@pytest.fixture(scope="module", params=numbers(ALWAYS))
def machines(request: pytest.FixtureRequest) -> list[Trial]:
    return [trial_of(index) for index in request.param]


@pytest.mark.parametrize("way", WAYS)
def test_what_is_claimed_is_what_is_integrated(machines: list[Trial], way: str) -> None:
    assert misses(machines, way) == []
    for trial in machines:
        if way in trial.claims:
            assert trial.claims[way].keys() >= trial.truth.keys()
            assert trial.judged & trial.claims[way].keys() <= trial.truth.keys()


def test_wheels_that_may_jump_leave_nothing_open(machines: list[Trial]) -> None:
    """But on waves that throw the wheels off, of which no steady swing is known."""
    for trial in machines:
        for load in trial.truth:
            one = trial.claims["off the rail"][load]
            assert one.bounded, (trial.number, load)
            assert one.high - one.low <= 1e-9 * max(abs(one.value), 1e-3)


def test_where_a_wheel_leaves_the_rail_the_answer_on_it_says_that_it_does_not_know(machines: list[Trial]) -> None:
    for trial in machines:
        loads = trial.claims.get("on the rail", {})
        for load in {"phi4", "wheel_force"} & loads.keys():
            assert loads[load].bounded == (loads["rail_contact"].value >= 0), trial.number
    assert 0.1 < bounded(machines, "on the rail", "phi4") < 1


def test_no_verdict_is_another(machines: list[Trial]) -> None:
    assert opposites(machines) == []
    assert near(machines) >= 0.4
    for codes in (("CRN293",), ("CRN209", "CRN294")):
        said = verdicts(machines, *codes)
        assert min(said.count(Verdict.PASS), said.count(Verdict.FAIL)) > 0.05 * len(said)


def test_a_column_with_a_guide_at_its_head_swings_not_at_all(machines: list[Trial]) -> None:
    guided = [trial for trial in machines if "mast_moment_max" not in trial.truth]
    assert 0 < len(guided) < len(machines)
    assert all("mast_moment_max" not in trial.claims["off the rail"] for trial in guided)
    assert all(math.isfinite(trial.claims["off the rail"]["phi4"].value) for trial in guided)
