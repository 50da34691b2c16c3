"""The bounds of the small effects that only the belt in cells carries: the same grid with the effect and without it.

What a grid misses is in both. The ladder is held against the finest grid with what halving its cells changes three
times over; other effects are off in these files, so that nothing else stands between them.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from support.bars import (
    MACHINES,
    THIRD,
    Limit,
    Trial,
    bounded,
    claim_within,
    misses,
    near,
    opposites,
    tried,
    wide,
    widest,
)
from support.conveyors import random_conveyor, text

from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.contract.result import family
from ptmcalc.engine.plan import plan_scene
from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.conveyor.machine.model import belt_line, starting_force
from ptmcalc.machines.conveyor.machine.motion import AFTER_START, moving
from ptmcalc.machines.conveyor.machine.scenes import Start
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.waves import cell_loads, cell_runs, network
from ptmcalc.machines.conveyor.waves.characteristics import CHARACTERISTICS
from ptmcalc.machines.conveyor.waves.effects import damping, idlers, moving_belt, takeup
from ptmcalc.machines.conveyor.waves.effects.damping import DAMPING_THRESHOLD, damping_change
from ptmcalc.machines.conveyor.waves.effects.moving_belt import TRAVEL_THRESHOLD, belt_travel

ON_TRIAL = {"conveyor": ("takeup_mass", "viscous_idlers", "coulomb_idlers", "belt_damping", "moving_belt")}
KIND = load_kind("conveyor")
ALWAYS = frozenset({"belt_wave", "tail_jump", "tail_mass", "coulomb_idlers"})
CELLS = 240
MOST_CONTOURS = 7
SEED = 23_001
TAUT = 1.5
"""Tension besides that keeps a belt taut, in starting forces."""
LIMITS = (
    Limit("belt_safety_min", ("checks", "belt_safety_starting"), least=0.1),
    Limit("slip_reserve_min", ("checks", "slip", "reserve"), least=1.0),
)
OFF = ("sag", "slip", "moving_belt", "takeup_mass", "viscous_idlers", "belt_damping")
JUDGED = ("tension_run_on_max", "tension_run_off_min", "tension_max", "tension_min", "belt_safety_min",
          "slip_reserve_min", "slack_margin_min", "slip_utilisation_max")  # fmt: skip
Make = Callable[[dict[str, Any], np.random.Generator], None]


@dataclass(frozen=True)
class Small:
    """A small effect: how a machine gets some of it, and its bound."""

    make: Make
    bound: Callable[..., Mapping[str, Interval]]
    number: Callable[[Conveyor], float]
    """over the threshold"""


def _number(value: str) -> float:
    return float(value.split()[0])


def _weight(data: dict[str, Any], rng: np.random.Generator) -> None:
    """A take-up weight on two falls, and a drive so heavy that the weight hardly moves."""
    data["takeup"] |= {"type": "gravity"}
    data["takeup"]["mass"] = text(2 * _number(data["takeup"]["tension"]) / 9.81, "kg")
    motor = data["drive"]["motor"]
    motor["inertia"] = text(_number(motor["inertia"]) * float(np.exp(rng.uniform(0, 3))), "kg*m^2")


def _viscous(data: dict[str, Any], rng: np.random.Generator) -> None:
    data["resistance"]["speed_share"] = float(rng.uniform(0.002, 0.0499))


def _relaxed(data: dict[str, Any], rng: np.random.Generator) -> None:
    """A relaxed belt on idlers whose friction is small beside the force that accelerates it; its take-up keeps it taut
    when that force falls at rated speed."""
    data["scenes"][0]["belt"] = "relaxed"
    motor = data["drive"]["motor"]
    for _ in range(12):
        spec = Conveyor.model_validate(data)
        if idlers.coulomb_criterion(spec, spec.all_scenes[0]).value < idlers.COULOMB_THRESHOLD:
            break
        motor["mean_starting_torque"] = text(_number(motor["mean_starting_torque"]) * 1.3, "N*m")
    data["takeup"]["tension"] = text(_number(data["takeup"]["tension"]) + TAUT * starting_force(spec), "N")


def _dashpots(data: dict[str, Any], rng: np.random.Generator) -> None:
    """Damping drawn up to the threshold; the change it makes is as its square or as it is."""
    wanted = DAMPING_THRESHOLD * float(np.exp(rng.uniform(math.log(0.05), 0.0)))
    low, high = 1e-9, 10.0
    for _ in range(40):
        middle = (low * high) ** 0.5
        data["belt"]["damping"] = {"model": "kelvin_voigt", "time": text(middle, "s")}
        spec = Conveyor.model_validate(data)
        over = damping_change(spec, belt_line(spec, spec.all_scenes[0])) > wanted
        low, high = (low, middle) if over else (middle, high)


def _running(data: dict[str, Any], rng: np.random.Generator) -> None:
    """The speed of the belt drawn up to the threshold."""
    spec = Conveyor.model_validate(data)
    line = belt_line(spec, spec.all_scenes[0])
    share = TRAVEL_THRESHOLD * float(np.exp(rng.uniform(math.log(0.1), 0.0)))
    data["speed"] = text(line.speed * share / belt_travel(line) * (1 - 1e-9), "m/s")


def _over(criterion: Callable[..., Any]) -> Callable[[Conveyor], float]:
    def number(spec: Conveyor) -> float:
        found = criterion(spec, spec.all_scenes[0])
        return float(found.value / found.threshold)

    return number


SMALL = {
    "takeup_mass": Small(_weight, takeup.takeup_bound, _over(takeup.takeup_criterion)),
    "viscous_idlers": Small(_viscous, idlers.speed_bound, _over(idlers.speed_criterion)),
    "coulomb_idlers": Small(_relaxed, idlers.coulomb_bound, _over(idlers.coulomb_criterion)),
    "belt_damping": Small(_dashpots, damping.damping_bound, _over(damping.damping_criterion)),
    "moving_belt": Small(_running, moving_belt.travel_bound, _over(moving_belt.travel_criterion)),
}


def _machine(name: str, rng: np.random.Generator) -> Conveyor:
    """A machine with some of the effect, below its threshold, whose scene is short enough."""
    small = SMALL[name]
    while True:
        stops = name != "coulomb_idlers" and rng.random() < 0.3
        data = random_conveyor(rng) | {"effects": dict.fromkeys(set(OFF) - {name}, "off")}
        if stops:
            data["scenes"] = [{"type": "stop", "load": data["scenes"][0]["load"]}]
            torque = text(float(np.exp(rng.uniform(7, 11))), "N*m")
            data["brakes"] = {"disc": {"torque": torque, "rise_time": "0.5 s"}}
        small.make(data, rng)
        spec = Conveyor.model_validate(data)
        scene = spec.all_scenes[0]
        case = moving(spec, scene)
        held = AFTER_START * case.line.contour_time if isinstance(scene, Start) and case.imposed is None else 0.0
        if not held < case.window < held + MOST_CONTOURS * case.line.contour_time or not small.number(spec) < 1:
            continue
        refused = network.valid(spec, scene)
        if refused is None or not refused.exceeded:
            return spec


def _exactly(values: cell_loads.Values) -> dict[str, Estimate]:
    return {name: Estimate.exact(value) for name, (value, _) in values.items()}


def trial_of(name: str, number: int) -> Trial:
    rng = np.random.default_rng((SEED, list(SMALL).index(name), number))
    spec = _machine(name, rng)
    (scene,) = spec.all_scenes
    case = moving(spec, scene)
    full = ALWAYS | ({name} if name != "coulomb_idlers" else set())
    fine, coarse = (cell_runs.marched(case, full, cells, True, CELLS).values for cells in (CELLS, CELLS // 2))
    apart = {load: 3 * abs(value - coarse[load][0]) for load, (value, _) in fine.items()}
    known = {load: Estimate.within(value, apart[load]) for load, (value, _) in fine.items()}
    if name == "coulomb_idlers":
        plan = plan_scene(KIND, spec, scene)
        claims = claim_within(plan, spec, CHARACTERISTICS, CHARACTERISTICS.always | {"tail_jump", "tail_mass"}, 1)
        truth = known
    else:
        bare = _exactly(cell_runs.marched(case, full - {name}, CELLS, True, CELLS).values)
        offsets = SMALL[name].bound(spec, scene, bare)
        claims = {load: one.widened(offsets.get(load, Interval(0.0, 0.0))) for load, one in bare.items()}
        truth = _exactly(fine)
    claims = {load: one for load, one in claims.items() if family(load) in JUDGED}
    trial = tried(number, rng, KIND, spec, scene, {name: claims}, known, LIMITS)
    return replace(trial, truth=truth)


@cache
def trials(name: str, count: int) -> list[Trial]:
    return [trial_of(name, number) for number in range(count)]


MANY = {"takeup_mass": 32}
"""Machines that are always tried, where few of them have an error that counts: else 16."""
SAMPLES = [
    *(pytest.param(name, MANY.get(name, 16), id=f"{name}-some-{MANY.get(name, 16)}") for name in SMALL),
    *(pytest.param(name, MACHINES, id=f"{name}-all-{MACHINES}", marks=pytest.mark.study) for name in SMALL),
]


@pytest.mark.parametrize(("name", "count"), SAMPLES)
def test_the_bound_holds_what_the_effect_changes(name: str, count: int) -> None:
    found = trials(name, count)
    assert misses(found, name) == []
    assert bounded(found, name, "tension_run_on_max") > 0.7


@pytest.mark.study
@pytest.mark.parametrize("name", SMALL)
def test_a_third_of_it_would_not(name: str) -> None:
    assert misses(trials(name, MACHINES), name, THIRD) != []


@pytest.mark.parametrize(("name", "count"), SAMPLES)
def test_it_is_not_much_wider_than_what_changes(name: str, count: int) -> None:
    assert wide(trials(name, count), name) <= widest(name)


@pytest.mark.parametrize(("name", "count"), SAMPLES)
def test_no_verdict_is_the_opposite(name: str, count: int) -> None:
    found = trials(name, count)
    assert opposites(found) == []
    assert near(found) >= 0.4
