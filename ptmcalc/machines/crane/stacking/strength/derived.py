"""What follows from the loads of an event: the force that marks its combination, stresses, stability.

Every solver of an event hands its own loads through `with_derived` at the end of its run, and every effect that bounds
one of those loads hands its bounds through `bounds_of_derived`: so the bars of what follows are those of the run.
Each derived load rises or falls evenly with each load it comes from, so that its ends belong to theirs.
"""

import itertools
import math
from collections.abc import Mapping

from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.contract.result import Found, of
from ptmcalc.machines.crane.stacking.machine.scenes import StackerScene
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.strength import stresses

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


UNMARKED = {"overhead_stacker": ("11.1,1", "11.1,2", "11.1,6"), "rack_stacker": ("11.2,1",)}
"""The combinations of weights alone, which standing gives."""


def derived(spec: Stacker, scene: StackerScene, loads: Mapping[str, float]) -> dict[str, float]:
    """What follows from plain numbers of the loads of an event."""
    found: dict[str, float] = {}
    marked = MARKED_BY[spec.type].get(scene.type)
    if marked and marked[1] in loads:
        found[of("combination_force", marked[0])] = loads[marked[1]]
    if "total_weight" in loads:
        found |= {of("combination_force", number): loads["total_weight"] for number in UNMARKED[spec.type]}
    happens = stresses.event(spec, scene, loads)
    if happens is None:
        return found
    largest = {
        "column_stress": stresses.column_stress(spec, scene, happens),
        "bridge_stress": stresses.bridge_stress(spec, scene, happens),
    }
    found |= {name: value for name, value in largest.items() if value is not None}
    reserves = stresses.stability(spec, scene, happens)
    if reserves:
        found["stability_reserve"] = min(reserves.values())
        found |= {of("stability_reserve", side): reserve for side, reserve in reserves.items()}
    return found


DERIVED = frozenset({"combination_force", "column_stress", "bridge_stress", "stability_reserve"})
"""Families of all that may follow: part of what a solver of an event gives."""


def with_derived(spec: Stacker, scene: StackerScene, found: Mapping[str, Found]) -> dict[str, Found]:
    """The loads of a run, with those that follow from them and carry their bars."""
    estimates = {name: one.estimate for name, one in found.items()}
    values = {name: one.value for name, one in estimates.items()}
    whole = _Ranges(spec, scene, values, {name: (one.low, one.high) for name, one in estimates.items()})
    numerical = _Ranges(spec, scene, values, {name: _about(one, one.numerical) for name, one in estimates.items()})
    model = _Ranges(spec, scene, values, {name: _about(one, one.model) for name, one in estimates.items()})
    follows = dict(found)
    for name, value in derived(spec, scene, values).items():
        low, high = whole.of(name)
        estimate = Estimate(value, min(low, value), max(high, value), numerical.width(name), model.width(name))
        follows[name] = Found(estimate, at=_when(found))
    return follows


def bounds_of_derived(
    spec: Stacker, scene: StackerScene, loads: Mapping[str, Estimate], bounds: Mapping[str, Interval]
) -> dict[str, Interval]:
    """Bounds of an effect on the loads of a run, with those on what follows from them."""
    values = {name: one.value for name, one in loads.items()}
    moved = {name: (values[name] + one.low, values[name] + one.high) for name, one in bounds.items() if name in values}
    ranges = _Ranges(spec, scene, values, moved)
    spread = dict(bounds)
    for name, value in derived(spec, scene, values).items():
        low, high = ranges.of(name)
        if math.isfinite(value):
            spread[name] = Interval(min(low - value, 0.0), max(high - value, 0.0))
    return spread


def _about(one: Estimate, part: float) -> tuple[float, float]:
    return one.value - part, one.value + part


class _Ranges:
    """What follows from loads that are known within ranges: it rises or falls evenly with each of them."""

    def __init__(
        self,
        spec: Stacker,
        scene: StackerScene,
        values: Mapping[str, float],
        ranges: Mapping[str, tuple[float, float]],
    ) -> None:
        self._spec, self._scene, self._values = spec, scene, values
        self._ranges = {key: ends for key, ends in ranges.items() if ends[0] != ends[1]}
        self._known: dict[tuple[tuple[str, float], ...], dict[str, float]] = {}

    def _of(self, **loads: float) -> dict[str, float]:
        key = tuple(sorted(loads.items()))
        if key not in self._known:
            self._known[key] = derived(self._spec, self._scene, {**self._values, **loads})
        return self._known[key]

    def of(self, name: str) -> tuple[float, float]:
        """Least and largest value of a derived load over the corners of the ranges of what it reads; anything where one
        of them has no end."""
        value = self._of()[name]
        read = [key for key in self._ranges if self._moves(name, key)]
        if any(not math.isfinite(end) for key in read for end in self._ranges[key]):
            return -math.inf, math.inf
        corners = [
            self._of(**{key: self._ranges[key][side] for key, side in zip(read, sides, strict=True)})[name]
            for sides in itertools.product((0, 1), repeat=len(read))
        ]
        return min(value, *corners), max(value, *corners)

    def width(self, name: str) -> float:
        """Half of what is between the ends."""
        low, high = self.of(name)
        return (high - low) / 2 if high > low else 0.0

    def _moves(self, name: str, key: str) -> bool:
        """Whether a derived load reads another; a number is put in for an end that is not there."""
        value = self._of()[name]
        finite = [end for end in self._ranges[key] if math.isfinite(end)] or [1.0]
        return any(self._of(**{key: at})[name] != value for at in (*finite, 2 * abs(finite[0]) + 1.0))


def _when(found: Mapping[str, Found]) -> Mapping[str, float]:
    """When the loads of a run peak, where one peak marks it."""
    for name in ("mast_force_max", "collision_force", "rope_force_caught", "fork_push_force", "safety_gear_force"):
        if name in found:
            return found[name].at
    return {}
