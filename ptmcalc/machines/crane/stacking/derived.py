"""What follows from the loads of an event: the force that marks its combination.

Every solver of an event hands its own loads through `with_derived` at the end of its run, and every effect that bounds
one of those loads hands its bounds through `bounds_of_derived`: so the bars of what follows are those of the run.
Each derived load rises or falls evenly with each load it comes from, so that its ends belong to theirs.
"""

import itertools
from collections.abc import Callable, Mapping

from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.contract.result import Found, of
from ptmcalc.machines.crane.stacking.scenes import StackerScene
from ptmcalc.machines.crane.stacking.spec import Stacker

MARKED_BY = {
    "overhead_stacker": {
        "start": ("11.1,3", "mast_force_max"),
        "brake": ("11.1,3", "mast_force_max"),
        "obstacle": ("11.1,4", "collision_force"),
        "fork_caught": ("11.1,5", "rope_force_caught"),
    },
    "rack_stacker": {
        "start": ("11.2,2", "mast_force_max"),
        "brake": ("11.2,2", "mast_force_max"),
        "fork_push": ("11.2,3", "fork_push_force"),
        "fork_caught": ("11.2,4", "rope_force_caught"),
        "rail": ("11.2,5", "wheel_force"),
        "safety_gear": ("11.2,6", "safety_gear_force"),
    },
}
"""The combination an event belongs to, and the load of its run that marks it, for each type of machine and scene."""


def derived(spec: Stacker, scene: StackerScene, loads: Mapping[str, float]) -> dict[str, float]:
    """What follows from plain numbers of the loads of an event."""
    found: dict[str, float] = {}
    marked = MARKED_BY[spec.type].get(scene.type)
    if marked and marked[1] in loads:
        found[of("combination_force", marked[0])] = loads[marked[1]]
    return found


def with_derived(spec: Stacker, scene: StackerScene, found: Mapping[str, Found]) -> dict[str, Found]:
    """The loads of a run, with those that follow from them and carry their bars."""
    estimates = {name: one.estimate for name, one in found.items()}
    values = {name: one.value for name, one in estimates.items()}
    follows = dict(found)
    for name, value in derived(spec, scene, values).items():
        low, high = _ends(spec, scene, name, {key: (one.low, one.high) for key, one in estimates.items()})
        numerical = _share(spec, scene, name, estimates, lambda one: one.numerical)
        model = _share(spec, scene, name, estimates, lambda one: one.model)
        estimate = Estimate(value, min(low, value), max(high, value), numerical, model)
        follows[name] = Found(estimate, at=_when(found))
    return follows


def bounds_of_derived(
    spec: Stacker, scene: StackerScene, loads: Mapping[str, Estimate], bounds: Mapping[str, Interval]
) -> dict[str, Interval]:
    """Bounds of an effect on the loads of a run, with those on what follows from them."""
    values = {name: one.value for name, one in loads.items()}
    moved = {
        name: (value + bounds[name].low, value + bounds[name].high) if name in bounds else (value, value)
        for name, value in values.items()
    }
    spread = dict(bounds)
    for name, value in derived(spec, scene, values).items():
        low, high = _ends(spec, scene, name, moved)
        spread[name] = Interval(min(low - value, 0.0), max(high - value, 0.0))
    return spread


def _ends(
    spec: Stacker, scene: StackerScene, name: str, ranges: Mapping[str, tuple[float, float]]
) -> tuple[float, float]:
    """Least and largest value of a derived load over the corners of the ranges it reads."""
    middle = {key: low for key, (low, _) in ranges.items()}
    read = [key for key in ranges if _moves(spec, scene, name, ranges, middle, key)]
    values = []
    for corner in itertools.product((0, 1), repeat=len(read)):
        at = middle | {key: ranges[key][side] for key, side in zip(read, corner, strict=True)}
        values.append(derived(spec, scene, at)[name])
    return min(values), max(values)


def _moves(
    spec: Stacker,
    scene: StackerScene,
    name: str,
    ranges: Mapping[str, tuple[float, float]],
    middle: Mapping[str, float],
    key: str,
) -> bool:
    low, high = ranges[key]
    if low == high:
        return False
    return derived(spec, scene, {**middle, key: low})[name] != derived(spec, scene, {**middle, key: high})[name]


def _share(
    spec: Stacker,
    scene: StackerScene,
    name: str,
    estimates: Mapping[str, Estimate],
    part: Callable[[Estimate], float],
) -> float:
    """A share of the error of a derived load, from the shares of what it comes from."""
    ranges = {key: (one.value - part(one), one.value + part(one)) for key, one in estimates.items()}
    low, high = _ends(spec, scene, name, ranges)
    return (high - low) / 2


def _when(found: Mapping[str, Found]) -> Mapping[str, float]:
    """When the loads of a run peak, where one peak marks it."""
    for name in ("mast_force_max", "collision_force", "rope_force_caught", "fork_push_force", "safety_gear_force"):
        if name in found:
            return found[name].at
    return {}
