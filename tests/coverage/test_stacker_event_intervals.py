"""What the bars of a stacker's events cover: closed forms with the bounds of their effects against the whole run.

Random machines, loads and racks; every bound holds everywhere, and a third of it would not.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest
from support.machines import changed
from support.stacker_events import RACK, machine

from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.contract.effect import AnyEffect
from ptmcalc.machines.crane.stacking.effects_events import EFFECTS_OF_EVENTS
from ptmcalc.machines.crane.stacking.solvers.fork_caught import CAUGHT_STOPPED, CAUGHT_TRAIN
from ptmcalc.machines.crane.stacking.solvers.fork_pushed import PUSH_RIGID, PUSH_TRAIN

COUNT = 30
EFFECT = {effect.name: effect for effect in EFFECTS_OF_EVENTS}


def caught(rng: np.random.Generator, **fixed: Any) -> dict[str, Any]:
    """A fork caught by a rack of any stiffness, by a motor of any strength and slope."""
    weight = rng.uniform(700, 3000)
    drive = {"reduced_mass": f"{10 ** rng.uniform(2.5, 4.2)} kg"}
    if rng.random() < 0.7:
        drive["largest_force"] = f"{weight * 9.81 * rng.uniform(1, 2.8)} N"
    if rng.random() < 0.7 or "largest_force" not in drive:
        drive["slope"] = f"{10 ** rng.uniform(3, 5.3)} N*s/m"
    return changed(
        RACK,
        load=f"{weight - 600} kg",
        hoisting__speed=f"{rng.uniform(0.05, 1.0)} m/s",
        hoisting__rope__stiffness=f"{10 ** rng.uniform(5, 6.7)} N/m",
        hoisting__drive=drive,
        rack__stiffness_vertical=f"{10 ** rng.uniform(5.3, 7.5)} N/m",
        **fixed,
    )


def pushed(rng: np.random.Generator) -> dict[str, Any]:
    fork = {
        "mass": f"{10 ** rng.uniform(1, 3)} kg",
        "speed": f"{rng.uniform(0.02, 0.6)} m/s",
        "motor_force": f"{10 ** rng.uniform(3, 4)} N",
    }
    if rng.random() < 0.4:
        fork["clutch_force"] = f"{10 ** rng.uniform(2.8, 3.6)} N"
    return changed(
        RACK,
        load=f"{rng.uniform(1, 2000)} kg",
        fork=fork,
        rack__stiffness_push=f"{10 ** rng.uniform(4.5, 6.5)} N/m",
        column__second_moment=f"{10 ** rng.uniform(3.5, 5)} cm^4",
        scenes=[{"type": "fork_push", "height": f"{rng.uniform(2, 12.5)} m"}],
    )


def misses(
    sample: list[dict[str, Any]], solver: Any, whole: Any, left_out: tuple[str, ...]
) -> dict[float, tuple[int, int]]:
    """Loads outside their bars, below and above, by the whole bounds and by a third of them.

    A solver leaves effects out; its loads are widened by their bounds, one after the other.
    """
    found = {1.0: [0, 0], 1 / 3: [0, 0]}
    for data in sample:
        spec = machine(data)
        scene = spec.all_scenes[0]
        truth = whole.run(spec, scene, whole.represents, 0).loads
        run = solver.run(spec, scene, solver.represents - set(left_out), 0).loads
        for share, count in found.items():
            loads = {name: one.estimate for name, one in run.items()}
            for name in left_out:
                effect: AnyEffect = EFFECT[name]
                bounds: Mapping[str, Interval] = effect.bound(spec, scene, loads)
                for load, offset in bounds.items():
                    loads[load] = loads[load].widened(Interval(offset.low * share, offset.high * share))
            for name, bar in loads.items():
                value = truth[name].estimate.value
                slack = 1e-9 * abs(value)
                count[0] += value < bar.low - slack
                count[1] += value > bar.high + slack
    return {share: (count[0], count[1]) for share, count in found.items()}


def sample(seed: int, of: Any, **fixed: Any) -> "list[dict[str, Any]]":
    rng = np.random.default_rng(seed)
    return [of(rng, **fixed) for _ in range(COUNT)]


@pytest.mark.parametrize(
    ("seed", "left_out", "whole"),
    [
        (81, ("rack_elasticity", "hoist_motor_slope", "load_limiter"), False),
        (82, ("rack_elasticity",), True),
        (83, ("hoist_motor_slope",), True),
    ],
)
def test_a_caught_fork(seed: int, left_out: tuple[str, ...], whole: bool) -> None:
    """The closed form with all bounds, and the run without one effect."""
    solver = CAUGHT_TRAIN if whole else CAUGHT_STOPPED
    machines = sample(seed, caught)
    found = misses(machines, solver, CAUGHT_TRAIN, left_out)
    assert found[1.0] == (0, 0)
    assert sum(found[1 / 3]) > 0


def test_a_soft_motor_on_a_rack_that_does_not_give() -> None:
    """There the bound is the work of the motor alone."""
    machines = [{**data, "rack": {"stiffness_push": "500 kN/m"}} for data in sample(84, caught)]
    found = misses(machines, CAUGHT_STOPPED, CAUGHT_TRAIN, ("hoist_motor_slope",))
    assert found[1.0] == (0, 0)
    assert found[1 / 3][0] > 0


def test_a_limiter_that_never_trips_needs_no_bound() -> None:
    machines = [changed(data, hoisting__limiter={"force": "1 MN", "reaction": "50 ms"}) for data in sample(85, caught)]
    left_out = ("rack_elasticity", "hoist_motor_slope", "load_limiter")
    assert misses(machines, CAUGHT_STOPPED, CAUGHT_TRAIN, left_out)[1.0] == (0, 0)


def test_a_limiter_that_may_trip_is_never_left_out() -> None:
    rng = np.random.default_rng(86)
    for _ in range(COUNT):
        data = changed(caught(rng), hoisting__limiter={"force": "15 kN", "reaction": "50 ms"})
        spec = machine(data)
        scene = spec.all_scenes[0]
        effect: AnyEffect = EFFECT["load_limiter"]
        criterion = effect.criterion(spec, scene)
        assert criterion is not None
        loads = {name: one.estimate for name, one in CAUGHT_STOPPED.run(spec, scene, frozenset(), 0).loads.items()}
        bounds = effect.bound(spec, scene, loads)
        assert bool(bounds) == criterion.exceeded
        assert not any(offset.bounded for offset in bounds.values())


def test_a_pushing_fork() -> None:
    machines = sample(87, pushed)
    found = misses(machines, PUSH_RIGID, PUSH_TRAIN, ("column_yield",))
    assert found[1.0] == (0, 0)
    assert found[1 / 3][0] > 0
    assert found[1 / 3][1] > 0


def test_without_the_catch_the_weight_is_all() -> None:
    """What leaving the catch out would change: between nothing and the bound of the energy."""
    beyond = 0
    for data in sample(88, caught):
        spec = machine(data)
        scene = spec.all_scenes[0]
        weight = spec.gravity * (spec.load + 600)
        still = {"rope_force_caught": Estimate.exact(weight)}
        offset = EFFECT["fork_catching"].bound(spec, scene, still)["rope_force_caught"]
        force = CAUGHT_TRAIN.run(spec, scene, CAUGHT_TRAIN.represents, 0).loads["rope_force_caught"].estimate.value
        assert weight + offset.low <= force <= weight + offset.high
        beyond += force > weight + offset.high / 3
    assert beyond > 0
