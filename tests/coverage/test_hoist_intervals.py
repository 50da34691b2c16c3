"""Bars of a hoist in motion against integrations of its own: a rope with mass, and a rope that gets shorter."""

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from support import hoist_ode
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
from support.hoist_ode import Machine, Seen
from support.hoists import hoist_of
from support.machines import report_of, scene_of
from support.turns import first_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.estimate import NOTHING, Estimate
from ptmcalc.contract.effect import AnyEffect
from ptmcalc.contract.solver import AnySolver
from ptmcalc.engine.plan import plan_scene
from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.hoist.machine.spec import Hoist
from ptmcalc.machines.hoist.motion import scene as motion
from ptmcalc.machines.hoist.motion.cases import case_of
from ptmcalc.machines.hoist.motion.effects import ALWAYS, ROPE_MASS, ROPE_SHORTENING
from ptmcalc.machines.hoist.motion.hoist_train import TRAIN
from ptmcalc.machines.hoist.motion.rope_hauled import ROPE_HAULED
from ptmcalc.machines.hoist.motion.rope_waves import ROPE_WAVES
from ptmcalc.machines.hoist.motion.two_mass import TWO_MASS

ON_TRIAL = {
    "hoist": (
        "rope_elasticity", "drive_motion", "structure", "rope_mass", "rope_shortening", "two_mass", "hoist_train",
        "rope_waves", "rope_hauled",
    )
}  # fmt: skip
KIND = load_kind("hoist")
SEED, ALWAYS_TRIED = 20261122, 12
PIECES = 6
TIGHTER = 1 / 3


def random_hoist(rng: np.random.Generator, rope_share: float, structure: bool) -> tuple[Machine, dict[str, Any]]:
    """A hoist by chance, as a reference knows it and as a file says it."""
    load, falls = float(rng.uniform(2e3, 2e4)), int(rng.choice([2, 4]))
    weight, length = load * 9.81, float(rng.uniform(6, 20))
    deflection = float(10 ** rng.uniform(-2.2, -1))
    stiffness, speed = weight / deflection, float(rng.uniform(0.1, 0.5)) * math.sqrt(9.81 * deflection)
    diameter, gear, sheave = 0.02, float(rng.uniform(0.8, 0.98)), float(rng.uniform(0.97, 1.0))
    arm = (0.4 + diameter) / 2 / falls
    motor_speed = 100.0
    ratio = motor_speed / (speed / arm)
    tackle = sum(sheave**k for k in range(falls)) / falls
    lowering = falls / sum(sheave**-k for k in range(falls))
    motor = float(10 ** rng.uniform(0, 1)) * load * (arm / ratio) ** 2
    drum = float(rng.uniform(0, 0.2)) * load * arm**2
    static = weight * arm / ratio
    share, free = float(rng.uniform(4, 12)), motor_speed
    given = (float(rng.uniform(3, 20)) * stiffness, float(rng.uniform(0.2, 3)) * load) if structure else None
    one = Machine(
        load, stiffness, length, rope_share * load, arm, ratio, motor, drum, gear, tackle, lowering, speed,
        share * static, free, float(rng.uniform(1.6, 3)) * static, float(rng.uniform(0, 0.2)),
        float(rng.choice([0.0, 0.1])), given,
    )  # fmt: skip
    data: dict[str, Any] = {
        "kind": "hoist",
        "load": f"{load} kg",
        "height": f"{length} m",
        "speed": {"main": f"{speed} m/s"},
        "reeving": {"falls": falls, "sheave_efficiency": sheave},
        "rope": {
            "diameter": f"{diameter} m",
            "area": "200 mm^2",
            "modulus": f"{stiffness * length / falls / 200e-6} Pa",
            "mass": f"{rope_share * load / (length * falls)} kg/m",
        },
        "drum": {"diameter": "0.4 m", "length": "40 m", "pitch": "22 mm", "inertia": f"{drum} kg*m^2"},
        "gearbox": {"ratio": ratio, "efficiency": gear},
        "motor": {
            "inertia": f"{motor} kg*m^2",
            "coupling_inertia": "0 kg*m^2",
            "curve": {
                "type": "linear",
                "starting_torque": f"{one.starting} N*m",
                "no_load_speed": f"{free} rad/s",
                "rated_torque": f"{static} N*m",
            },
        },
        "brake": {"torque": f"{one.brake} N*m", "delay": f"{one.delay} s", "rise_time": f"{one.rise} s"},
        "scenes": [{"type": "lift", "profile": {"shape": "curve"}}, {"type": "lower_brake"}],
    }
    if given is not None:
        data["structure"] = {"stiffness": f"{given[0]} N/m", "mass": f"{given[1]} kg"}
    return one, data


def truths(one: Machine, scene: str, seen: Seen, pieces: int) -> Mapping[str, float]:
    """What the reference says of each load."""
    found = {"rope_force_max": seen.most, "natural_frequency": hoist_ode.natural_frequency(one, pieces)}
    if one.structure is not None:
        found["bridge_force_max"] = seen.bridge
    if scene == "lift":
        factor = seen.most / one.weight
        return found | {"lift_off_factor": factor, "lift_off_time": seen.lifted, "lift_off_speed": seen.speed}
    return found | {
        "lowering_brake_factor": seen.most / one.weight,
        "rope_force_min": seen.least,
        "stop_time": seen.stopped,
        "stop_distance_lowering": -seen.lowest,
    }


def outside(one: Estimate, truth: float, tighter: float = 1.0) -> bool:
    """Whether the truth lies outside a bar, or outside a part of it; half a millionth is the reference's own."""
    low, high = one.value - tighter * (one.value - one.low), one.value + tighter * (one.high - one.value)
    slack = 5e-7 * abs(truth)
    return not low - slack <= truth <= high + slack


def bounded(spec: Hoist, scene: Any, effect: AnyEffect) -> tuple[dict[str, Estimate], float]:
    """Loads of the train that leaves an effect out, with its bound; and the time they cover."""
    found = motion.result(scene, case_of(spec, scene, ALWAYS | {"structure"}), 0)
    estimates = {name: load.estimate for name, load in found.loads.items()}
    offsets = effect.bound(spec, scene, estimates)
    assert found.window is not None
    return {name: one.widened(offsets.get(name, NOTHING)) for name, one in estimates.items()}, found.window[1]


def compared(
    seed: int, rope_share: float, structure: bool, pieces: int, shortens: bool
) -> list[tuple[str, bool, bool]]:
    """Loads of both scenes of a hoist: name, whether the bar misses the truth, whether a third of it does."""
    rng = np.random.default_rng(seed)
    one, data = random_hoist(rng, rope_share, structure)
    spec, found = hoist_of(data), []
    for scene in spec.all_scenes:
        known, window = bounded(spec, scene, ROPE_SHORTENING if shortens else ROPE_MASS)
        kind = "lift" if scene.type == "lift" else "lower"
        play = hoist_ode.lift if kind == "lift" else hoist_ode.lower
        seen = play(one, window, pieces, shortens)
        if seen.slips:
            continue
        for load, truth in truths(one, kind, seen, pieces).items():
            found.append((load, outside(known[load], truth), outside(known[load], truth, TIGHTER)))
    return found


@pytest.fixture(scope="module")
def with_rope_mass() -> list[tuple[str, bool, bool]]:
    rng = np.random.default_rng(11)
    return [
        one
        for seed in range(3)
        for one in compared(seed, float(10 ** rng.uniform(-2, -0.6)), seed % 2 == 1, PIECES, shortens=False)
    ]


def test_waves_along_the_rope_stay_in_the_bars(with_rope_mass: list[tuple[str, bool, bool]]) -> None:
    assert [name for name, missed, _ in with_rope_mass if missed] == []


def test_a_third_of_the_bars_would_not_do(with_rope_mass: list[tuple[str, bool, bool]]) -> None:
    assert [name for name, _, missed in with_rope_mass if missed]


def _samples(sort: str) -> list[Any]:
    whole = pytest.param((sort, MACHINES), id=f"{sort}-all-{MACHINES}", marks=pytest.mark.study)
    return [pytest.param((sort, ALWAYS_TRIED), id=f"{sort}-some-{ALWAYS_TRIED}"), whole]


WAYS: dict[str, tuple[AnySolver, frozenset[str]]] = {
    "drive and load": (TWO_MASS, ALWAYS),
    "train": (TRAIN, ALWAYS | {"structure"}),
}
LIMITS = (
    Limit("lift_off_factor", ("checks", "lift_off_factor"), 1.0001),
    Limit("lowering_brake_factor", ("checks", "lowering_factor"), 1.0001),
    Limit("stop_distance_lowering", ("checks", "stop_distance"), 1e-6),
)
SORTS: dict[str, tuple[AnySolver, str]] = {
    "waves": (ROPE_WAVES, "rope_shortening"),
    "hauled": (ROPE_HAULED, "rope_mass"),
}
"""What is right, and the effect that it leaves out and the file too."""


def trial_of(sort: str, index: int) -> Trial:
    """A lift or a stop of a hoist, half of them on a structure that gives and has mass."""
    rng = np.random.default_rng((SEED, list(SORTS).index(sort), index))
    share = float(10 ** rng.uniform(-1.7, -0.3)) if sort == "waves" else 1e-9
    _, data = random_hoist(rng, share, structure=bool(rng.integers(2)))
    best, out = SORTS[sort]
    data["effects"] = {out: "off"}
    data["scenes"] = [data["scenes"][index % 4 // 2]]
    spec = hoist_of(data)
    (scene,) = spec.all_scenes
    plan = plan_scene(KIND, spec, scene)
    claims = {name: _moving(claim_of(plan, spec, *way)) for name, way in WAYS.items()}
    truth = _moving(claim_of(plan, spec, best, ALWAYS | {"structure"} | best.always))
    return replace(tried(index, rng, KIND, spec, scene, claims, truth, LIMITS), claims=claims)


def _moving(loads: Loads) -> dict[str, Estimate]:
    return {name: one for name, one in loads.items() if name != "energy_residual"}


@pytest.fixture(scope="module", params=[p for sort in SORTS for p in _samples(sort)])
def tried_hoists(request: pytest.FixtureRequest) -> list[Trial]:
    sort, count = request.param
    return [trial_of(sort, index) for index in range(count)]


@pytest.mark.parametrize("way", WAYS)
def test_the_bars_hold_the_richer_run(tried_hoists: list[Trial], way: str) -> None:
    assert misses(tried_hoists, way) == []


def test_a_third_of_the_bars_would_not_do_for_it(tried_hoists: list[Trial]) -> None:
    assert misses(tried_hoists, "train", THIRD)


def test_the_bars_of_a_lift_are_not_much_wider_than_the_error(tried_hoists: list[Trial]) -> None:
    lifts = [trial for trial in tried_hoists if "lift_off_factor" in trial.truth]
    assert wide(lifts, "train") <= WIDEST


def test_the_ladder_never_says_the_opposite(tried_hoists: list[Trial]) -> None:
    assert opposites(tried_hoists) == []
    assert near(tried_hoists) >= 0.4
    said = verdicts(tried_hoists, "HST120", "HST122", "HST123")
    assert min(said.count(Verdict.PASS), said.count(Verdict.FAIL)) > 0.1 * len(tried_hoists)


@pytest.mark.parametrize("seed", first_of(4, range(21, 33)))
def test_a_rope_that_gets_shorter_stays_in_the_bars(seed: int) -> None:
    found = compared(seed, 1e-9, seed % 2 == 1, 1, shortens=True)
    assert [name for name, missed, _ in found if missed] == []


@pytest.mark.parametrize("seed", [31, 32])
def test_without_either_the_numbers_are_those_of_the_reference(seed: int) -> None:
    """Both effects off: nothing is left but rounding, structure and losses included."""
    one, data = random_hoist(np.random.default_rng(seed), 1e-9, structure=True)
    data["effects"] = {"rope_mass": "off", "rope_shortening": "off"}
    report = report_of(data)
    for name in ("lift_loaded", "lower_brake_loaded"):
        scene, kind = scene_of(report, name), name.removesuffix("_loaded")
        known = {load.info.name: load for load in scene.loads}
        window = known["rope_force_max"].window
        assert window is not None
        play = hoist_ode.lift if kind == "lift" else hoist_ode.lower
        for load, truth in truths(one, kind, play(one, window[1]), 1).items():
            assert known[load].estimate.value == pytest.approx(truth, rel=1e-6), load
