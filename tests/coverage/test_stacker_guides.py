"""A rack stacker whose head a guide holds, with play or without, against elements marched with all their modes.

Two masses know nothing of a guide, and of what is left out only frequencies are bounded; the column in modes has it.
"""

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest
from support.bars import (
    MACHINES,
    THIRD,
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
    widest,
)
from support.machines import loaded
from support.mast_fem import Reference
from support.mast_steps import March
from support.stacker_masts import random_stacker
from support.stacker_statics import STEEL
from support.travelling_statics import G, number

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.estimate import Estimate
from ptmcalc.engine.plan import plan_scene
from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.crane.stacking.mast.beam import MAST_BEAM
from ptmcalc.machines.crane.stacking.mast.modal import MAST_MODAL
from ptmcalc.machines.crane.stacking.mechanisms.drive_times import DRIVE_TIMES

ON_TRIAL = {"crane": ("top_guide",)}
KIND = next(one for one in load_kind("crane").types if one.type == "rack_stacker")
SEED, ALWAYS = 1940, 12
COUNT, STEPS = 12, 3000
KNOWN = {"mast_deflection_max": 2e-5, "mast_force_max": 2e-5, "start_time": 1e-6, "brake_time": 1e-6}
"""What the reference is good for, as a share: its elements, and peaks between its steps."""
WAYS: dict[str, tuple[Any, frozenset[str]]] = {
    "modes": (MAST_MODAL, MAST_MODAL.represents),
    "modes without weights": (MAST_MODAL, MAST_MODAL.always),
    "frequencies": (MAST_BEAM, frozenset()),
    "momentum": (DRIVE_TIMES, frozenset()),
}
LIMITS = (
    Limit("mast_deflection_max", ("checks", "mast_deflection"), 1e-9),
    Limit("mast_force_max", ("checks", "column_force"), 1e-3),
    Limit("start_time", ("checks", "start_time"), 1e-6),
    Limit("brake_time", ("checks", "brake_time"), 1e-6),
)


def trial_of(index: int) -> Trial:
    """A start or a stop by a force with a guide at the head, from a tenth to thirty times as stiff as the column; two
    of three have play, about what the head would swing without it."""
    rng = np.random.default_rng((SEED, index))
    while "driving_force" not in (data := random_stacker(rng))["travel"]:
        pass
    data.pop("settling", None)
    column, travel, starts = data["column"], data["travel"], data["scenes"][0]["type"] == "start"
    length, bending = number(column["length"]), STEEL * number(column["second_moment"])
    turn = number(column["root_stiffness"]) if "root_stiffness" in column else None
    free = 1 / (length**3 / 3 / bending + (length**2 / turn if turn else 0.0))
    mass = number(data["load"]) + number(data["carriage"]["mass"])
    whole, force = number(data["base"]["mass"]) + number(column["mass"]) + mass, number(travel["driving_force"])
    stiff = free * 10 ** rng.uniform(-1, 1.5)
    play = float(rng.choice([0.0, rng.uniform(0.1, 1.5), rng.uniform(0.1, 1.5)])) * force * mass / whole / free
    column["top_guide"] = {"stiffness": f"{stiff!r} N/m", "gap": f"{play!r} m"}
    spec = loaded(data).spec
    assert spec is not None
    (scene,) = spec.all_scenes
    plan = plan_scene(KIND, spec, scene)
    claims = {name: claim_of(plan, spec, *way) for name, way in WAYS.items()}
    window = MAST_MODAL.run(spec, plan.scene, MAST_MODAL.represents, 0).window
    assert window is not None

    def mast(count: int, **more: float) -> Reference:
        return Reference(
            number(data["base"]["mass"]), length, bending, number(column["mass"]), mass, count,
            turn=turn, **{"pull": -G, "guide": 0.0 if play else stiff} | more,
        )  # fmt: skip

    decrement, still = column.get("log_decrement", 0.0), mast(2 * COUNT)
    ratio = decrement / math.hypot(2 * math.pi, decrement) * float(still.held()[0] / still.rolling()[0])
    speed, rise = number(travel["speed"]), number(travel.get("driving_rise" if starts else "braking_rise", "0 s"))
    march = March(
        mast(COUNT, held_ratio=ratio), 0.0 if starts else speed, speed if starts else 0.0, force, rise, stiff,
        play or math.inf,
    )  # fmt: skip
    seen = march.run(window[1], STEPS)
    found = {
        "mast_deflection_max": seen.swing,
        "mast_force_max": seen.swing * free,
        "start_time" if starts else "brake_time": seen.first if starts else seen.last,
    }
    truth = {load: Estimate.within(value, KNOWN[load] * value) for load, value in found.items()}
    weighed, other = (mast(count, guide=0.0).tip_stiffness() for count in (2 * COUNT, COUNT))
    truth["column_stiffness"] = Estimate.within(weighed, abs(weighed - other) + 1e-7 * weighed)
    truth |= frequencies(mast(2 * COUNT).rolling(), mast(COUNT).rolling())
    return tried(index, rng, KIND, spec, scene, claims, truth, LIMITS)


def frequencies(fine: Any, coarse: Any) -> Mapping[str, Estimate]:
    """Of elements, and what half as many tell of their error."""
    found = {}
    for mode, (value, other) in enumerate(zip(fine[:3].tolist(), coarse[:3].tolist(), strict=True), 1):
        found[f"natural_frequency[{mode}]"] = Estimate.within(value, abs(value - other) / 5 + 1e-7 * value)
    low = found["natural_frequency[1]"]
    swing = 2 * math.pi / low.value
    return found | {"period": Estimate.within(swing, 2 * math.pi / low.low - swing)}


@pytest.fixture(scope="module", params=numbers(ALWAYS, MACHINES))
def machines(request: pytest.FixtureRequest) -> list[Trial]:
    return [trial_of(index) for index in request.param]


@pytest.mark.parametrize("way", WAYS)
def test_what_elements_of_another_hand_find_lies_in_the_bars(machines: list[Trial], way: str) -> None:
    assert misses(machines, way) == []


def test_only_the_column_in_modes_knows_its_guide(machines: list[Trial]) -> None:
    assert bounded(machines, "modes", "mast_deflection_max") == 1
    assert all("mast_deflection_max" not in trial.claims["frequencies"] for trial in machines)
    for load in ("start_time", "brake_time"):
        assert bounded(machines, "momentum", load) == 0


def test_a_third_of_what_a_guide_may_do_to_a_frequency_would_not_hold(machines: list[Trial]) -> None:
    assert misses(machines, "frequencies", THIRD) != []
    assert misses(machines, "modes without weights", THIRD) != []
    assert wide(machines, "modes") <= widest("modes")


def test_no_verdict_is_another(machines: list[Trial]) -> None:
    assert opposites(machines) == []
    assert near(machines) >= 0.4
    said = verdicts(machines, "CRN251", "CRN252", "CRN204", "CRN205")
    assert min(said.count(Verdict.PASS), said.count(Verdict.FAIL)) > 0.05 * len(said)
