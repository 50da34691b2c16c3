"""Bars of a column of two masses, of one without weights and of times by momentum, against one with all its modes and
weights: they hold, and are needed."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from support.bars import (
    THIRD,
    WIDEST,
    Limit,
    Loads,
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
from support.machines import loaded
from support.mast_fem import Reference, first_at_speed
from support.stacker_masts import OVERHEAD, random_stacker

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.estimate import Estimate
from ptmcalc.engine.plan import plan_scene
from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.mast.beam import MAST_BEAM
from ptmcalc.machines.crane.stacking.mast.modal import MAST_MODAL
from ptmcalc.machines.crane.stacking.mast.two_mass_run import MAST_TWO_MASS
from ptmcalc.machines.crane.stacking.mechanisms.drive_times import DRIVE_TIMES

ON_TRIAL = {
    "crane": (
        "mast_flexibility", "column_mass", "column_modes", "mast_gravity", "brake_sticking", "drive_times",
        "mast_beam", "mast_two_mass", "mast_modal",
    )
}  # fmt: skip
KIND = next(one for one in load_kind("crane").types if one.type == "rack_stacker")
SEED, ALWAYS = 101, 24
WAYS: dict[str, tuple[Any, frozenset[str], int]] = {
    "two masses": (MAST_TWO_MASS, MAST_TWO_MASS.represents, 0),
    "two masses without weights": (MAST_TWO_MASS, MAST_TWO_MASS.always, 0),
    "modes without weights": (MAST_MODAL, MAST_MODAL.always, 0),
    "frequencies": (MAST_BEAM, frozenset(), 0),
    "momentum": (DRIVE_TIMES, frozenset(), 0),
    "modes": (MAST_MODAL, MAST_MODAL.represents, 0),
}
CHEAP = tuple(WAYS)[:-1]
LIMITS = (
    Limit("mast_deflection_max", ("checks", "mast_deflection"), 1e-9),
    Limit("mast_force_max", ("checks", "column_force"), 1e-3),
    Limit("start_time", ("checks", "start_time"), 1e-6),
    Limit("brake_time", ("checks", "brake_time"), 1e-6),
)


def _number(text: str) -> float:
    return float(text.split()[0])


def _time(data: dict[str, Any], spec: Stacker) -> Loads:
    """Time of a start by force without damping, by elements of another hand."""
    travel, column = data["travel"], data["column"]
    if "driving_force" not in travel or "log_decrement" in column or data["scenes"][0]["type"] != "start":
        return {}
    turn = _number(column["root_stiffness"]) if "root_stiffness" in column else None
    bending = 210e9 * _number(column["second_moment"])
    reference = Reference(
        _number(data["base"]["mass"]), spec.column.length, bending, spec.column.mass, spec.load + spec.carriage.mass,
        32, pull=-9.81, turn=turn,
    )  # fmt: skip
    rise = _number(travel.get("driving_rise", "0 s"))
    time = first_at_speed(reference, _number(travel["driving_force"]), _number(travel["speed"]), rise)
    return {"start_time": Estimate.within(time, 1e-6 * time)}


def trial_of(index: int) -> Trial:
    rng = np.random.default_rng((SEED, index))
    data = random_stacker(rng)
    spec = loaded(data).spec
    assert isinstance(spec, Stacker)
    (scene,) = spec.all_scenes
    plan = plan_scene(KIND, spec, scene)
    claims = {name: claim_of(plan, spec, *way) for name, way in WAYS.items()}
    truth = {**claims["modes"], **_time(data, spec)}
    cheap = {name: claims[name] for name in CHEAP}
    return replace(tried(index, rng, KIND, spec, scene, cheap, truth, LIMITS), claims=claims)


@pytest.fixture(scope="module", params=numbers(ALWAYS))
def trials(request: pytest.FixtureRequest) -> list[Trial]:
    return [trial_of(index) for index in request.param]


@pytest.mark.parametrize("way", WAYS)
def test_every_load_lies_in_its_bar(trials: list[Trial], way: str) -> None:
    assert misses(trials, way) == []


def test_the_times_of_starts_are_those_of_other_elements(trials: list[Trial]) -> None:
    assert sum(trial.truth.get("start_time") is not trial.claims["modes"].get("start_time") for trial in trials) > 2


@pytest.mark.parametrize("way", CHEAP)
def test_a_third_of_the_bar_would_not_hold(trials: list[Trial], way: str) -> None:
    assert misses(trials, way, THIRD)


@pytest.mark.parametrize("way", ["two masses without weights", "modes without weights", "momentum"])
def test_it_is_not_much_wider_than_the_true_error(trials: list[Trial], way: str) -> None:
    assert 0 < wide(trials, way) <= WIDEST


def test_the_ladder_never_says_the_opposite(trials: list[Trial]) -> None:
    assert opposites(trials) == []
    assert near(trials) >= 0.45
    said = verdicts(trials, "CRN251", "CRN252", "CRN204", "CRN205")
    assert min(said.count(Verdict.PASS), said.count(Verdict.FAIL)) > 0.1 * len(trials)


@pytest.mark.parametrize("seed", [8057, 8058, 8068])
def test_bars_know_of_the_weights_of_the_run(seed: int) -> None:
    """Weights of a third of what buckles the column: the deflection of two masses is a thousandth off even at rest,
    and a swing that is larger by them settles a swing later."""
    spec = loaded(random_stacker(np.random.default_rng(seed))).spec
    assert isinstance(spec, Stacker)
    plan = plan_scene(KIND, spec, spec.all_scenes[0])
    said, right = (claim_of(plan, spec, *WAYS[way]) for way in ("two masses", "modes"))
    for name in {"mast_deflection_max", "settling_time"} & said.keys():
        assert said[name].low <= right[name].value <= said[name].high


@pytest.mark.parametrize("scene", ["start", "brake"])
@pytest.mark.parametrize("second_moment", ["1e9 m^4", "2e-4 m^4", "2e-5 m^4"])
@pytest.mark.parametrize("girders", ["1e-9 m^4", "1e-6 m^4", "1e-4 m^4"])
def test_bars_know_how_weights_lean_by_a_root_that_turns_less_than_it_shifts(
    scene: str, second_moment: str, girders: str
) -> None:
    """The trolley sits at the root: it shifts the girders, but does not turn the root, which one shape says it does."""
    bridge = OVERHEAD["bridge"] | {"girder_vertical": "1.2e-3 m^4", "girder_horizontal": girders}
    column = {"length": "6 m", "mass": "1200 kg", "second_moment": second_moment}
    travel = {"speed": "1 m/s", "driving_force": "5 kN", "braking_force": "5.5 kN", "driving_rise": "0.8 s"}
    data = OVERHEAD | {"bridge": bridge, "column": column, "bridge_travel": travel}
    spec = loaded(data | {"scenes": [{"type": scene, "mechanism": "bridge"}]}).spec
    assert spec is not None
    plan = plan_scene(KIND, spec, spec.all_scenes[0])
    said, right = (claim_of(plan, spec, *WAYS[way]) for way in ("two masses", "modes"))
    for name in ("mast_deflection_max", "mast_moment_max"):
        assert said[name].low <= right[name].value <= said[name].high
