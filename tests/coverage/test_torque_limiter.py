"""Bars of the loads of a torque limiter hold finite elements, arms of passing teeth, and waves of a rigid jam."""

import math
from typing import Any

import numpy as np
import pytest
from support import limiter_ref
from support.bars import (
    THIRD,
    WIDEST,
    Limit,
    Trial,
    bounded,
    claim_of,
    known_to,
    misses,
    near,
    numbers,
    opposites,
    tried,
    verdicts,
    wide,
)
from support.chain_starts import KIND, built, random_chain
from support.limiter_ref import Rig

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.estimate import Estimate
from ptmcalc.engine.plan import plan_scene
from ptmcalc.machines.chain_drive.limiter.running import LIMITER_JAM, LIMITER_RUN
from ptmcalc.machines.chain_drive.limiter.starts import LIMITER_START, LIMITER_TEETH
from ptmcalc.machines.chain_drive.limiter.stops import LIMITER_STOP
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive

ON_TRIAL = {
    "chain_drive": (
        "limiter_start",
        "limiter_start_teeth",
        "limiter_stop",
        "limiter_run",
        "limiter_jam",
        "limiter_trip",
    )
}
SEED = 7_310
TOLERANCE = 0.1
ELEMENTS = 0.006
"""What the elements of the reference are good for, relative to the torque [1]: from twice as many of them."""


def _set(spec: ChainDrive, value: float) -> ChainDrive:
    return spec.with_value(("torque_limiter", "torque"), value / (1 - TOLERANCE))


TORQUE = Limit("limiter_torque", _set, least=1.0)
SAFETY = Limit("safety_jam", ("checks", "safety_jam"), least=1e-6)


def drawn(rng: np.random.Generator, **changed: Any) -> dict[str, Any]:
    """A conveyor with Kelvin-Voigt damping that stays taut and whose load does not drive it."""
    while True:
        data = random_chain(rng) | changed
        data["chain"]["damping"] = {"ratio": float(rng.uniform(0.02, 0.1))}
        taut = float(rng.uniform(3, 8)) * float(data["layout"]["takeup"]["tension"].split()[0])
        data["layout"]["takeup"]["tension"] = f"{taut!r} N"
        rig = Rig(data)
        moves = rig.pull > 1.02 * rig.resistance(data["layout"]["resistance"]["start_factor"])
        if min(rig.rises(data["layout"]["resistance"]["stop_factor"])) > 0 and moves:
            setting = rig.arm * rig.resistance(1.0) * float(rng.uniform(1.2, 3))
            limiter = {"torque": f"{setting!r} N*m", "tolerance": f"{100 * TOLERANCE} %"}
            return data | {"torque_limiter": limiter}


def trial(number: int, rng: np.random.Generator, data: dict[str, Any], solver: Any, truth: float, level: int) -> Trial:
    spec = built(data)
    (scene,) = spec.all_scenes
    claims = {"bar": claim_of(plan_scene(KIND, spec, scene), spec, solver, solver.always, level)}
    exact = {"limiter_torque": known_to(ELEMENTS, truth)}
    return tried(number, rng, KIND, spec, scene, claims, exact, [TORQUE])


def start_trial(number: int) -> Trial:
    rng = np.random.default_rng((SEED, 1, number))
    data = drawn(rng, effects={"tooth_passing": "off"})
    _, torque = limiter_ref.start(Rig(data), lambda t: 1.0, float(rng.uniform(0, 1)))
    return trial(number, rng, data, LIMITER_START, torque, number % 2)


def toothed_trial(number: int) -> Trial:
    rng = np.random.default_rng((SEED, 2, number))
    data = drawn(rng)
    data["layout"]["takeup"]["type"] = "gravity"
    rig = Rig(data)
    _, torque = limiter_ref.toothed_start(rig, float(rng.uniform(0, 1)))
    return trial(number, rng, data, LIMITER_TEETH, torque, 0)


def stop_trial(number: int) -> Trial:
    rng = np.random.default_rng((SEED, 3, number))
    data = drawn(rng)
    data["drive"]["gear"]["efficiency"] = 1.0
    rig, behind = Rig(data), number % 3 == 0
    torque = float(rng.uniform(0.5, 4)) * rig.resistance(0.8) * rig.arm / (1.0 if behind else rig.ratio)
    brake = {"torque": f"{torque!r} N*m", "shaft": "sprocket" if behind else "motor", "delay": "0.1 s",
             "rise_time": "0.2 s"}  # fmt: skip
    data |= {"brake": brake, "scenes": [{"type": "stop"}]}
    return trial(number, rng, data, LIMITER_STOP, rig.arm * limiter_ref.stop(rig, brake), number % 2)


def run_trial(number: int) -> Trial:
    rng = np.random.default_rng((SEED, 4, number))
    data = drawn(rng)
    data["layout"]["takeup"]["type"] = "gravity"
    rig = Rig(data)
    del data["drive"]
    data |= {"scenes": [{"type": "run"}]}
    return trial(number, rng, data, LIMITER_RUN, limiter_ref.running(rig)[0], number % 2)


def jam_trial(number: int) -> Trial:
    """A rigid jam at the far end of the working strand: the tension at the obstacle, with any arm."""
    rng = np.random.default_rng((SEED, 5, number))
    data = drawn(rng)
    data["layout"]["takeup"]["type"] = "gravity"
    rig = Rig(data)
    data |= {"scenes": [{"type": "run"}]}
    setting = float(data["torque_limiter"]["torque"].split()[0]) * (1 + TOLERANCE)
    arm = rig.radius * float(rng.uniform(math.cos(math.pi / rig.teeth), 1))
    impedance = math.sqrt(rig.stiffness * rig.chain)
    step = impedance * rig.speed
    cap = max(setting / arm - rig.resistance(1.0), 0.0)
    most = limiter_ref.jammed(rig.sprocket / (rig.chain * rig.length), cap / step)
    tension = rig.leaving(1.0) + rig.resistance(1.0) + most * step
    if rig.teeth % 2:  # the arms of both sides differ
        tension += rig.leaving(1.0) * float(rng.uniform(math.cos(math.pi / rig.teeth) - 1, 0))
    spec = built(data)
    (scene,) = spec.all_scenes
    claims = {"bar": claim_of(plan_scene(KIND, spec, scene), spec, LIMITER_JAM)}
    strength = 2 * 350e3 / 1.2
    exact = {"tension_jam": known_to(1e-3, tension), "safety_jam": known_to(1e-3, strength / tension)}
    return tried(number, rng, KIND, spec, scene, claims, exact, [SAFETY])


WAYS = {"start": (start_trial, 10), "teeth": (toothed_trial, 4), "stop": (stop_trial, 10), "run": (run_trial, 30),
        "jam": (jam_trial, 60)}  # fmt: skip
CASES = [
    pytest.param((way, *param.values), id=f"{way}-{param.id}", marks=param.marks)
    for way, (_, always) in WAYS.items()
    for param in numbers(always, max(always, 60))
]


@pytest.fixture(scope="module", params=CASES)
def trials(request: pytest.FixtureRequest) -> tuple[str, list[Trial]]:
    way, some = request.param
    return way, [WAYS[way][0](number) for number in some]


def test_a_bar_holds_the_reference(trials: tuple[str, list[Trial]]) -> None:
    way, tried_ones = trials
    load = "tension_jam" if way == "jam" else "limiter_torque"
    assert bounded(tried_ones, "bar", load) >= 0.7
    assert misses(tried_ones, "bar") == []
    assert wide(tried_ones, "bar") <= WIDEST


def test_a_third_of_it_would_not(trials: tuple[str, list[Trial]]) -> None:
    way, tried_ones = trials
    if way not in ("teeth", "stop"):  # a stop has the arms of its whole tooth; the sample of the teeth is small
        assert misses(tried_ones, "bar", THIRD) != []


def test_no_verdict_is_the_opposite(trials: tuple[str, list[Trial]]) -> None:
    way, tried_ones = trials
    assert opposites(tried_ones) == []
    assert near(tried_ones) >= 0.35
    said = verdicts(tried_ones, "CHN135" if way == "jam" else "CHN134")
    assert said.count(Verdict.PASS) + said.count(Verdict.FAIL) > 0


def test_the_waves_of_a_jam_need_what_is_added_to_the_tension_of_the_limiter() -> None:
    """The largest excess over the root, of which 2.5 is taken."""
    most = max(
        limiter_ref.jammed(mass, cap) - cap - math.sqrt(1 + mass)
        for mass in (0.05, 0.2, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 30.0, 60.0)
        for cap in np.linspace(0.05, 12, 40)
    )
    assert 1.8 <= most <= 2.3


def test_an_estimate_of_the_reference_is_not_that_of_the_package() -> None:
    """The reference knows no error bar: it is given one here, from twice as many elements."""
    data = drawn(np.random.default_rng(SEED), effects={"tooth_passing": "off"})
    rig = Rig(data)
    drive = rig.rotor(rig.eta) + rig.sprocket

    def peak(pieces: int) -> float:
        found = limiter_ref.simulated(rig, drive, lambda t: 1.0, 0.5, pieces, 1500)
        return float(np.max(found.excess - drive * found.acceleration))

    assert Estimate.within(peak(60), ELEMENTS * peak(60)).low <= peak(120) <= peak(60) * (1 + ELEMENTS)
