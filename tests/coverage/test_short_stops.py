"""Stops of belts too short to simulate: intervals of the rigid conveyor hold finite elements on seeded machines.

The machines are short enough for their waves to go round often and long enough for elements to follow them.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
import pytest
from support.bars import MACHINES as ALL
from support.bars import THIRD, Limit, Trial, misses, near, opposites, tried, wide, widest
from support.belt_scenes import Brake, Drive, Rig, loads_of
from support.machines import check_of, load_of, report_of, scene_of, spec_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.estimate import Estimate
from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.conveyor.machine.motion import MOST_ROUNDS, moving, rounds
from ptmcalc.machines.conveyor.stopping import stiff_bounds

ON_TRIAL = {"conveyor": ("stiff_stop",)}
KIND = load_kind("conveyor")
LIMITS = (
    Limit("stop_distance", ("checks", "stop_distance"), least=0.001),
    Limit("stop_time", ("checks", "stop_time"), least=0.001),
)
MACHINES, SEED = 12, 20261123
ELEMENTS = 40


@dataclass(frozen=True)
class Case:
    """A machine: what is claimed of each load, and what the elements find."""

    rig: Rig
    claims: dict[str, Estimate]
    found: dict[str, float]
    trial: Trial

    def ratio(self, name: str) -> float:
        """Distance of the elements from the rigid body, as a part of the bar on that side."""
        claim, value = self.claims[name], self.found[name]
        room = claim.high - claim.value if value > claim.value else claim.value - claim.low
        apart = abs(value - claim.value)
        rounding = _known(self.rig) * abs(claim.value)
        return 0.0 if apart <= rounding else (apart - rounding) / room if room else math.inf


def _known(rig: Rig) -> float:
    """So far the elements know their ends, as a share."""
    least = rig.tension / 2 if rig.rigid else rig.tension
    return 2 * sum(one.length * (one.friction + abs(one.climb)) for one in rig.lengths()) / ELEMENTS / least


def _drawn(rng: np.random.Generator) -> Rig:
    length = float(np.exp(rng.uniform(math.log(2), math.log(60))))
    slope = float(rng.uniform(-0.15, 0.25))
    drive = Drive(
        rotor=float(rng.uniform(1, 8)), drum=float(rng.uniform(20, 400)), friction=float(rng.uniform(0.2, 0.4))
    )
    brakes = tuple(
        Brake(float(rng.uniform(0.5e3, 8e3)), float(rng.uniform(0, 1)), float(rng.choice([0.0, 0.02, 1.0])))
        for _ in range(int(rng.integers(0, 3)))
    )
    return Rig(
        sections=((length, slope * length),),
        belt=float(rng.uniform(8, 30)),
        stiffness=float(rng.uniform(5e6, 60e6)),
        load=float(rng.uniform(0, 150)),
        friction=float(rng.uniform(0.015, 0.05)),
        speed=float(rng.uniform(0.5, 4.0)),
        drives={"head": drive},
        brakes=brakes,
        tension=float(rng.uniform(20e3, 200e3)),
        rigid=bool(rng.random() < 0.5),
        tail_inertia=float(rng.choice([0.0, 5.0, 100.0])),
    )


def drawn_cases(count: int, seed: int) -> list[Case]:
    rng = np.random.default_rng(seed)
    found: list[Case] = []
    while len(found) < count:
        rig = _drawn(rng)
        spec = spec_of(rig.data({"type": "stop"}))
        (scene,) = spec.all_scenes
        stop, case = stiff_bounds.short_stop(spec, scene), moving(spec, scene)
        if stop is None or not 20 < case.window / case.line.contour_time < 200:
            continue
        values = {name: Estimate.exact(value) for name, value in stiff_bounds.loads(stop).items()}
        offsets = stiff_bounds.offsets(stop, values)
        claims = {name: one.widened(offsets[name]) for name, one in values.items() if name in offsets}
        window = (claims["stop_time"].high if claims["stop_time"].bounded else case.window) + 2 * rig.contour()
        motion = rig.stopped(window, ELEMENTS)
        values = loads_of(rig, motion).loads
        exact = {name: Estimate.within(one, _known(rig) * abs(one)) for name, one in values.items()}
        plain = spec.with_value(("effects",), {"moving_belt": "off"})
        trial = tried(len(found), rng, KIND, plain, scene, {"stiff_stop": claims}, exact, LIMITS)
        found.append(Case(rig, claims, values, trial))
    return found


@pytest.fixture(scope="module")
def cases() -> list[Case]:
    return drawn_cases(MACHINES, SEED)


def told(cases: list[Case]) -> list[tuple[int, str, float]]:
    return [
        (number, name, case.ratio(name))
        for number, case in enumerate(cases)
        for name in case.claims
        if name in case.found
    ]


def test_the_sample_has_brakes_and_none_both_takeups_and_both_slopes(cases: list[Case]) -> None:
    assert {len(case.rig.brakes) for case in cases} == {0, 1, 2}
    assert {case.rig.rigid for case in cases} == {True, False}
    assert {case.rig.sections[0][1] > 0 for case in cases} == {True, False}
    assert sum(case.claims["stop_distance"].bounded for case in cases) > 0.9 * MACHINES
    assert {"tension_max", "tension_min", "stop_time", "stop_distance"} <= {name for _, name, _ in told(cases)}


def test_every_interval_holds_finite_elements(cases: list[Case]) -> None:
    assert [one for one in told(cases) if one[2] > 1] == []


def test_no_verdict_is_the_opposite_of_the_elements(cases: list[Case]) -> None:
    trials = [case.trial for case in cases]
    assert misses(trials, "stiff_stop", ignored=("tension_dynamic_run_on_max",)) == []
    assert opposites(trials) == []
    assert near(trials) >= 0.45
    assert wide(trials, "stiff_stop") <= widest("stiff_stop")


@pytest.mark.study
def test_every_interval_holds_finite_elements_on_a_larger_sample() -> None:
    cases = drawn_cases(ALL, SEED + 1)
    assert [one for one in told(cases) if one[2] > 1] == []
    trials = [case.trial for case in cases]
    assert misses(trials, "stiff_stop", ignored=("tension_dynamic_run_on_max",)) == []
    assert opposites(trials) == []
    assert wide(trials, "stiff_stop") <= widest("stiff_stop")


def test_a_third_of_the_intervals_would_not(cases: list[Case]) -> None:
    assert misses([case.trial for case in cases], "stiff_stop", THIRD, ("tension_dynamic_run_on_max",)) != []


@pytest.mark.parametrize("weight", [None, 2 * 120e3 / 9.81])
def test_a_belt_of_one_metre_gets_its_verdicts(weight: float | None) -> None:
    """Both a way the rigid conveyor keeps and one that it does not are decided, and so is all else, by whatever mass of
    the take-up's weight."""
    rig = Rig(sections=((1.0, 0.1),), brakes=(Brake(10e3, 0.5, 1.0),), weight=weight)
    for limit, verdict in (("9 m", Verdict.PASS), ("7 m", Verdict.FAIL)):
        data = rig.data({"type": "stop"}, checks={"stop_distance": limit, "slip_heat": "1 J"})
        data["belt"] |= {"breaking_force": "2 MN", "carcass": "textile"}
        spec = spec_of(data)
        assert rounds(spec, spec.all_scenes[0]) > MOST_ROUNDS
        scene = scene_of(report_of(data))
        assert check_of(scene, "CNV106").verdict is verdict
        assert {judged.verdict for judged in scene.checks if judged.code != "CNV106"} == {Verdict.PASS}
        assert load_of(scene, "stop_distance").solver == "stiff_stop"


@pytest.mark.parametrize(
    "more",
    [
        {"drives": {"one": Drive(), "two": Drive()}},
        {"sections": ((0.5, 0.1), (0.5, 0.0))},
        {"brakes": (Brake(10e3, 0.5, 1.0, "tail"),)},
    ],
    ids=["two drives", "two slopes", "brake at the tail"],
)
def test_a_short_belt_out_of_their_range_says_why_it_is_not_judged(more: dict[str, object]) -> None:
    rig = replace(Rig(sections=((1.0, 0.1),), brakes=(Brake(10e3, 0.5, 1.0),)), **more)
    report = report_of(rig.data({"type": "stop"}, checks={"stop_distance": "9 m"}))
    (said,) = [d for d in report.diagnostics if d.code == "NUM103"]
    assert "times in the time of the scene" in said.message
    assert check_of(scene_of(report), "CNV106").verdict is Verdict.UNDECIDED
