"""Numerical bars of the transient solver, and bounds of the small effects, against a finer or fuller run.

The bar of the coarsest setting must hold the value of the finest on every machine of the sample, and a third of it
must fail on some. Bounds marked calibrated are held on machines other than those they were calibrated with.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cache

import numpy as np
import pytest
from support.bars import (
    MACHINES,
    THIRD,
    WIDEST,
    Limit,
    Loads,
    Trial,
    claim_within,
    misses,
    near,
    opposites,
    tried,
    wide,
)
from support.conveyors import random_conveyor, text

from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.engine.plan import plan_scene
from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.conveyor.machine.loads import DRIVE, OF_BELT
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.machine.start_case import start_case
from ptmcalc.machines.conveyor.waves import start_intervals
from ptmcalc.machines.conveyor.waves.characteristics import CHARACTERISTICS
from ptmcalc.machines.conveyor.waves.effects import sag, tail

ON_TRIAL = {"conveyor": ("characteristics", "tail_jump", "tail_mass", "sag")}
KIND = load_kind("conveyor")
LINEAR = frozenset({"belt_wave", "tail_jump", "tail_mass"})
MOST_CONTOURS = 25
LIMITS = (
    Limit("belt_safety_min", ("checks", "belt_safety_starting"), least=0.1),
    Limit("slip_reserve_min", ("checks", "slip", "reserve"), least=1.0),
)


def _machine(
    rng: np.random.Generator, change: Callable[[dict, np.random.Generator], dict], off: Iterable[str]
) -> Conveyor:
    """A conveyor that moves, in a start that is short enough, without the effects that no run here carries."""
    while True:
        spec = Conveyor.model_validate(change(random_conveyor(rng), rng) | {"effects": dict.fromkeys(off, "off")})
        case = start_case(spec, spec.all_scenes[0])
        if case.moves and case.window < MOST_CONTOURS * case.line.contour_time:
            return spec


# -- bars of the grids ----------------------------------------------------------------------------------------------


def _as_drawn(data: dict, rng: np.random.Generator) -> dict:
    return data


def _slippery(data: dict, rng: np.random.Generator) -> dict:
    data["drive"]["drum"]["friction"] = float(rng.uniform(0.15, 0.3))
    return data


SETTINGS = {
    "straight": (LINEAR, _as_drawn),
    "slip": (LINEAR | {"slip"}, _slippery),
    "sag": (LINEAR | {"slip", "sag"}, _as_drawn),
}
ALWAYS = {"straight": 24, "slip": 20, "sag": 8}
KEEN = {"straight": (38,)}
"""Machines beside the first ones that take a large part of their bars."""


def _sizes(always: dict[str, int]) -> list:
    """Samples that always run, and of all machines as a study."""
    return [
        *(pytest.param(name, count, id=f"{name}-some") for name, count in always.items()),
        *(pytest.param(name, MACHINES, id=f"{name}-all", marks=pytest.mark.study) for name in always),
    ]


def _grid_trial(setting: str, number: int) -> Trial:
    """The coarsest grid, held against the finest."""
    carried, change = SETTINGS[setting]
    rng = np.random.default_rng((11_001, list(SETTINGS).index(setting), number))
    spec = _machine(rng, change, {"slip", "sag", "moving_belt"} - carried)
    (scene,) = spec.all_scenes
    plan = plan_scene(KIND, spec, scene)
    coarse, fine = (claim_within(plan, spec, CHARACTERISTICS, carried, level) for level in (0, 2))
    return tried(number, rng, KIND, spec, scene, {"coarse": coarse}, fine, LIMITS)


@cache
def grids(setting: str, count: int) -> list[Trial]:
    return [_grid_trial(setting, number) for number in sorted({*range(count), *KEEN.get(setting, ())})]


@pytest.mark.parametrize(("setting", "count"), _sizes(ALWAYS))
def test_the_bar_of_the_coarsest_grid_holds_the_finest(setting: str, count: int) -> None:
    trials = grids(setting, count)
    assert misses(trials, "coarse") == []
    assert wide(trials, "coarse") <= WIDEST
    assert opposites(trials) == []
    assert near(trials) >= 0.4


@pytest.mark.parametrize(("setting", "count"), _sizes({"straight": ALWAYS["straight"]}))
def test_a_third_of_that_bar_would_not(setting: str, count: int) -> None:
    assert misses(grids(setting, count), "coarse", THIRD) != []


# -- bounds of the small effects ------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Small:
    """A small effect: how a machine gets some of it, what leaves it out, and its bound."""

    change: Callable[[dict, np.random.Generator], dict]
    name: str
    bound: Callable[..., dict[str, Interval]]


def _empty(data: dict) -> dict:
    data["scenes"][0]["load"] = "empty"
    return data


def _small_jump(data: dict, rng: np.random.Generator) -> dict:
    reflected = rng.uniform(-0.02, 0.02)
    carry, belt = data["idlers"]["carry"], float(data["belt"]["mass"].split()[0])
    on_idlers = float(carry["set_mass"].split()[0]) / float(carry["pitch"].split()[0])
    mass = (belt + on_idlers) * ((1 - reflected) / (1 + reflected)) ** 2 - belt
    data["idlers"]["return"] = {"pitch": "3 m", "line_mass": text(mass, "kg/m")}
    return _empty(data)


def _small_tail(data: dict, rng: np.random.Generator) -> dict:
    spec = Conveyor.model_validate(_empty(data))
    belt = start_case(spec, spec.all_scenes[0]).masses
    share = float(np.exp(rng.uniform(np.log(1e-4), np.log(0.0099))))
    data["tail_drum"]["inertia"] = text(share * (belt.belt_mass - belt.tail_mass) * 0.16, "kg*m^2")
    return data


def _small_sag(data: dict, rng: np.random.Generator) -> dict:
    """The take-up tension at which the largest softening of the start is the one drawn."""
    target = float(np.exp(rng.uniform(np.log(2e-3), np.log(0.05))))
    low, high = (float(data["takeup"]["tension"].split()[0]) * share for share in (0.2, 50.0))
    for _ in range(30):
        data["takeup"]["tension"] = text((low * high) ** 0.5, "N")
        spec = Conveyor.model_validate(data)
        softening = start_intervals.largest_softening(start_case(spec, spec.all_scenes[0]))
        low, high = ((low * high) ** 0.5, high) if softening > target else (low, (low * high) ** 0.5)
    data["takeup"]["tension"] = text(high, "N")
    return data


SMALL = [
    Small(_small_jump, "tail_jump", tail.jump_bound),
    Small(_small_tail, "tail_mass", tail.tail_mass_bound),
    Small(_small_sag, "sag", sag.sag_bound),
]


SMALL_ONES = {small.name: small for small in SMALL}


def _small_trial(name: str, number: int) -> Trial:
    """A run without the effect and with its bound, held against one that carries it on the same grid."""
    small = SMALL_ONES[name]
    rng = np.random.default_rng((13_001, list(SMALL_ONES).index(name), number))
    spec = _machine(rng, small.change, {"slip", "sag", "moving_belt"} - {name})
    (scene,) = spec.all_scenes
    plan, carried = plan_scene(KIND, spec, scene), LINEAR | {name}
    claims: dict[str, Loads] = {name: claim_within(plan, spec, CHARACTERISTICS, carried - {name}, 1)}
    return tried(number, rng, KIND, spec, scene, claims, claim_within(plan, spec, CHARACTERISTICS, carried, 1), LIMITS)


@cache
def small_ones(name: str, count: int) -> list[Trial]:
    return [_small_trial(name, number) for number in range(count)]


@pytest.mark.parametrize(("name", "count"), _sizes(dict.fromkeys(SMALL_ONES, 12)))
def test_the_bound_of_a_small_effect_holds_what_it_changes(name: str, count: int) -> None:
    trials = small_ones(name, count)
    assert misses(trials, name) == []
    assert misses(trials, name, 0.0) != []
    assert opposites(trials) == []
    assert near(trials) >= 0.4


@pytest.mark.parametrize("small", SMALL, ids=lambda small: small.name)
def test_what_is_no_longer_small_is_unbounded(small: Small) -> None:
    rng = np.random.default_rng(7)
    data = small.change(random_conveyor(rng, takeup="rigid", load="full"), rng)
    data["tail_drum"]["inertia"] = "1e7 kg*m^2"
    data["scenes"][0]["load"] = "full"
    data["takeup"]["tension"] = "10 N"
    spec = Conveyor.model_validate(data)
    scene = spec.all_scenes[0]
    moved = OF_BELT.union(DRIVE if start_case(spec, scene).imposed_speed else ())
    loads = dict.fromkeys(moved, Estimate.exact(1.0))
    assert all(not offset.bounded for offset in small.bound(spec, scene, loads).values())
    assert set(small.bound(spec, scene, loads)) == set(loads)
