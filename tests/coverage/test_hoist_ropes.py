"""Rope proofs of a hoist against pieces of rope that are followed through the lift, and laws as products of powers.

The closed forms claim no bar but rounding.
"""

import numpy as np
import pytest
from support.bars import Limit, Trial, claim, known_to, misses, near, numbers, opposites, tried, verdicts
from support.hoist_ropes import Ropes, random_fleet, random_holding, random_life, random_proof, random_shell
from support.hoist_statics import random_hoist
from support.machines import loaded

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.hoist.drive.holding import SOLVER as HOLDING
from ptmcalc.machines.hoist.rope.fleet import SOLVER as FLEET
from ptmcalc.machines.hoist.rope.life import SOLVER as LIFE
from ptmcalc.machines.hoist.rope.proof import SOLVER as PROOF
from ptmcalc.machines.hoist.rope.shell import SOLVER as SHELL

WITHOUT_BARS = {"hoist": ("rope_bending_life", "rope_proof", "fleet_angles", "drum_shell", "holding_by_rule")}
KIND = load_kind("hoist")
SEED, ALWAYS, MACHINES = 3513, 16, 64
REFERENCE = {"life": 1e-9, "proof": 1e-9, "fleet": 1e-9, "shell": 1e-4, "holding": 1e-9}
"""Errors of the reference, relative; of the shell those of finite differences with steps of 0.01/beta."""
LIMITS = {
    "life": (
        Limit("rope_lifts_discard", ("rope_life", "lifts"), 1e-3, 1e12),
        Limit("rope_life_years", ("rope_life", "years"), 1e-3, 1e12),
    ),
    "proof": (),
    "fleet": (),
    "shell": (),
    "holding": (),
}
WAYS = {"life": LIFE, "proof": PROOF, "fleet": FLEET, "shell": SHELL, "holding": HOLDING}
JUDGED = {
    "life": ("HST150", "HST151", "HST152", "HST153"),
    "proof": ("HST154", "HST155"),
    "fleet": ("HST156", "HST157"),
    "shell": ("HST158", "HST160"),
    "holding": ("HST161",),
}


def trials_of(index: int) -> dict[str, Trial]:
    rng = np.random.default_rng((SEED, index))
    data = random_hoist(rng)
    data |= {
        "rope_life": random_life(rng),
        "rope_proof": random_proof(rng),
        "fleet": random_fleet(rng),
        "scenes": [{"type": "run"}],
    }
    data["drum"]["shell"] = random_shell(rng)
    data["brake"]["holding"] = random_holding(rng)
    if rng.random() < 0.4:
        data["reeving"]["lead_length"] = "0 m"
    if rng.random() < 0.5:
        del data["checks"]["layer_factor"]
    spec, reference = loaded(data).spec, Ropes(data)
    assert spec is not None
    scene, found = spec.all_scenes[0], {}
    for way, solver in WAYS.items():
        truth = {name: known_to(REFERENCE[way], value) for name, value in getattr(reference, way)().items()}
        claims = {way: claim(KIND, spec, scene, solver)}
        if way == "life":  # a whole number that the reference does not name
            claims[way] = {name: one for name, one in claims[way].items() if name != "rope_bendings"}
        found[way] = tried(index, rng, KIND, spec, scene, claims, truth, LIMITS[way])
    return found


@pytest.fixture(scope="module", params=numbers(ALWAYS, MACHINES))
def machines(request: pytest.FixtureRequest) -> list[dict[str, Trial]]:
    return [trials_of(index) for index in request.param]


@pytest.mark.parametrize("way", WAYS)
def test_what_is_claimed_is_what_the_reference_finds(machines: list[dict[str, Trial]], way: str) -> None:
    trials = [machine[way] for machine in machines]
    assert misses(trials, way) == []
    for trial in trials:
        assert trial.claims[way].keys() == trial.truth.keys()


@pytest.mark.parametrize("way", WAYS)
def test_no_verdict_is_another(machines: list[dict[str, Trial]], way: str) -> None:
    trials = [machine[way] for machine in machines]
    assert opposites(trials) == []
    assert not LIMITS[way] or near(trials) >= 0.4
    for code in JUDGED[way]:
        said = verdicts(trials, code)
        assert min(said.count(Verdict.PASS), said.count(Verdict.FAIL)) > 0.05 * len(said), code
