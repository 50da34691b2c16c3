"""Frequencies of the column of a stacker that stands against finite elements of another hand.

Weights on the column, a head that a guide holds, girders that give: the elements know them all. Bars of a column
without its weights are needed; those of elements that know them are the change from half as many, of which little is
left.
"""

import math
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
from support.stacker_statics import STEEL, Statics, random_stacker
from support.travelling_statics import G, number, text

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.solver import AnySolver
from ptmcalc.engine.plan import plan_scene
from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.crane.stacking.mast.beam import MAST_BEAM
from ptmcalc.machines.crane.stacking.mast.modal import STANDING_MODAL
from ptmcalc.machines.crane.stacking.strength.weights import WEIGHTS

ON_TRIAL = {"crane": ("standing_modal", "mast_beam", "mast_gravity")}
KINDS = {one.type: one for one in load_kind("crane").types}
SEED, ALWAYS = 1936, 30
COUNT = 32
"""Elements of the reference, of half as many, and of the grid on which a carriage stands."""
WAYS: dict[str, tuple[AnySolver, frozenset[str]]] = {
    "elements": (STANDING_MODAL, STANDING_MODAL.represents),
    "elements without weights": (STANDING_MODAL, STANDING_MODAL.always),
    "beam": (MAST_BEAM, MAST_BEAM.always),
    "statics": (WEIGHTS, WEIGHTS.always),
}
LIMITS = (
    Limit("stability_reserve", ("checks", "stability"), 0.01),
    Limit("column_stress", ("checks", "column_stress"), 1.0),
    Limit("bridge_stress", ("checks", "bridge_stress"), 1.0),
)


def standing(rng: np.random.Generator, kind: str) -> dict[str, Any]:
    """A stacker of either kind that stands, its weights from a hundredth to half of what buckles its column, the head
    of some in an aisle guided, with play or without."""
    data = random_stacker(rng, kind)
    column, scene = data["column"], data["scenes"][2]
    whole = Statics(data, joint=True)
    length, weight = number(column["length"]), (whole.climbing({}) + whole.column) * G
    flexural = 4 / math.pi**2 * weight * length**2 * 10 ** rng.uniform(0.8, 2)
    column["second_moment"] = text(flexural / STEEL, "m^4")
    column["root_stiffness"] = text(weight * length * 10 ** rng.uniform(0.7, 2.5), "N*m/rad")
    if kind == "rack_stacker" and rng.random() < 0.5:
        stiff = 3 * flexural / length**3 * 10 ** rng.uniform(-1, 1.5)
        column["top_guide"] = {"stiffness": text(stiff, "N/m"), "gap": str(rng.choice(["0 m", "0.003 m"]))}
    share = int(rng.integers(3, COUNT // 2 + 1)) / (COUNT // 2)
    up = share if kind == "rack_stacker" else 1 - share
    scene |= {"height": text(number(column["foot"]) + up * length, "m"), "load": str(rng.choice(["full", "empty"]))}
    del data["effects"]
    return data | {"scenes": [scene], "share": share}


def mast(
    data: dict[str, Any], whole: Statics, scene: dict[str, Any], share: float, count: int, free: bool = False
) -> Reference:
    """The column in elements, over a base that is held; `free` without its guide."""
    column, hangs = data["column"], data["type"] == "overhead_stacker"
    length, turns, shift, root = number(column["length"]), 1 / number(column["root_stiffness"]), None, 0.0
    if hangs:
        turned, shifted = whole.girders(length)
        turns, shift, root = turns + turned / length**2, 1 / shifted, number(data["trolley"]["mass"])
    guide = column.get("top_guide", {"gap": "0 m", "stiffness": "0 N/m"})
    return Reference(
        1.0, length, STEEL * number(column["second_moment"]), whole.column, whole.climbing(scene), count,
        load_node=round(share * count), pull=G if hangs else -G, turn=1 / turns, shift=shift, root=root,
        guide=0.0 if free or number(guide["gap"]) else number(guide["stiffness"]),
    )  # fmt: skip


def trial_of(index: int) -> Trial:
    rng = np.random.default_rng((SEED, index))
    kind = KINDS["rack_stacker" if index % 3 else "overhead_stacker"]
    data = standing(rng, str(kind.type))
    share = data.pop("share")
    (asked,), spec, whole = data["scenes"], loaded(data).spec, Statics(data, joint=True)
    assert spec is not None
    (scene,) = spec.all_scenes
    plan = plan_scene(kind, spec, scene)
    claims = {name: claim_of(plan, spec, *way) for name, way in WAYS.items()}
    fine, coarse = (mast(data, whole, asked, share, count).held()[:3] for count in (COUNT, COUNT // 2))
    exact = fine - (coarse - fine) / 15
    truth = {load: Estimate.exact(value) for load, value in whole.stand(asked).items()}
    stiff, other = (mast(data, whole, asked, share, count, free=True).tip_stiffness() for count in (COUNT, COUNT // 2))
    truth["column_stiffness"] = Estimate.within(stiff, abs(stiff - other) + 1e-7 * stiff)
    for mode, (value, other) in enumerate(zip(exact, fine, strict=True), 1):
        truth[f"natural_frequency[{mode}]"] = Estimate.within(value, abs(value - other) / 2 + 2e-8 * value)
    lowest = truth["natural_frequency[1]"]
    truth["period"] = Estimate.within(2 * math.pi / lowest.value, 2 * math.pi / lowest.low - 2 * math.pi / lowest.value)
    return tried(index, rng, kind, spec, scene, claims, truth, LIMITS)


@pytest.fixture(scope="module", params=numbers(ALWAYS, MACHINES))
def machines(request: pytest.FixtureRequest) -> list[Trial]:
    return [trial_of(index) for index in request.param]


@pytest.mark.parametrize("way", list(WAYS)[:3])
def test_what_elements_of_another_hand_find_lies_in_the_bars(machines: list[Trial], way: str) -> None:
    assert misses(machines, way) == []
    assert bounded(machines, way, "natural_frequency[1]") >= (1 if way == "elements" else 0.9)
    told = {"column_stiffness", "period", *(f"natural_frequency[{mode}]" for mode in (1, 2, 3))}
    assert all(told <= trial.claims[way].keys() & trial.truth.keys() for trial in machines)


def test_of_elements_that_know_the_weights_next_to_nothing_is_open(machines: list[Trial]) -> None:
    loads = [one for trial in machines for one in trial.claims["elements"].values()]
    assert max(one.bar / abs(one.value) for one in loads) < 2e-4


@pytest.mark.parametrize("way", ["elements without weights", "beam"])
def test_a_third_of_what_weights_may_do_would_not_hold(machines: list[Trial], way: str) -> None:
    assert misses(machines, way, THIRD) != []
    assert wide(machines, way) <= widest(way)


def test_no_verdict_is_another(machines: list[Trial]) -> None:
    assert opposites(machines) == []
    assert near(machines) >= 0.4
    said = verdicts(machines, "CRN207", "CRN208", "CRN209", "CRN210")
    assert min(said.count(Verdict.PASS), said.count(Verdict.FAIL)) > 0.05 * len(said)
