"""Wheel loads of both rails with the trolley at its ends."""

from dataclasses import dataclass

import numpy as np

from ptmcalc.laws import runway_actions, skew
from ptmcalc.machines.crane.travelling.machine import model, wheels
from ptmcalc.machines.crane.travelling.machine.keys.actions import Actions
from ptmcalc.machines.crane.travelling.machine.model import CORNERS, State
from ptmcalc.machines.crane.travelling.machine.scenes import TravelScene
from ptmcalc.machines.crane.travelling.machine.spec import Travelling

Both = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Place:
    """Static wheel loads of the rail with the larger load and of the other one, with the trolley at one end [N]."""

    crane: Both
    hoist: Both

    def loads(self, on_crane: float, on_hoist: float) -> Both:
        """With factors."""
        first, other = (on_crane * self.crane[side] + on_hoist * self.hoist[side] for side in (0, 1))
        return first, other


@dataclass(frozen=True, slots=True)
class Rails:
    """Wheel loads of a crane on its runway with the trolley at either end."""

    places: tuple[Place, ...]
    per_rail: int
    """wheels on one rail"""

    @classmethod
    def of(cls, spec: Travelling, scene: TravelScene) -> "Rails":
        """The rails of a crane."""
        count = 2 * spec.wheels.per_corner
        hoist = model.hanging(spec, scene) * spec.gravity
        return cls(tuple(_place(spec, hook, hoist, count) for hook in model.hook_places(spec, scene)), count)

    def loaded(self, on_crane: float, on_hoist: float) -> Both:
        """Q_r,max and the accompanying Q_r,(max) [N]."""
        return max(max(both, both[::-1]) for both in (place.loads(on_crane, on_hoist) for place in self.places))

    def unloaded(self, on_crane: float) -> Both:
        """Q_r,min and the accompanying Q_r,(min) [N]."""
        return min(min(both, both[::-1]) for both in (place.loads(on_crane, 0.0) for place in self.places))

    @property
    def worst(self) -> Place:
        """The trolley position of the largest static wheel load."""
        return max(self.places, key=lambda place: place.loads(1.0, 1.0))


def _place(spec: Travelling, hook: float, hoist: float, count: int) -> Place:
    nothing = State(0.0, 0.0, 0.0, 0.0, 0.0)
    empty, full = (wheels.corner_loads(spec, hook, nothing._replace(weight=weight)) for weight in (0.0, hoist))
    rails = [
        [sum(loads[corner] for corner in CORNERS if corner[0] == rail) / count for rail in "AB"]
        for loads in (empty, full)
    ]
    crane, load = rails[0], [both - one for one, both in zip(rails[0], rails[1], strict=True)]
    if rails[1][0] >= rails[1][1]:
        return Place((crane[0], crane[1]), (load[0], load[1]))
    return Place((crane[1], crane[0]), (load[1], load[0]))


def driven_per_rail(spec: Travelling) -> int | None:
    """Driven wheels of each rail; None where the rails have different numbers."""
    one, other = (sum(model.driven_at(spec, f"{rail}{end}") for end in (1, 2)) for rail in "AB")
    return one if one == other else None


def drive_force(spec: Travelling, given: Actions, rails: Rails, on_crane: float) -> float | None:
    """K of the wheel loads with a factor; None where it does not act alike on both rails [N]."""
    count = driven_per_rail(spec)
    if count is None:
        return None
    least, other = rails.unloaded(on_crane if given.K_with_phi else 1.0)
    second = other if spec.drive.wheels == "coupled" else least
    return runway_actions.drive_force(runway_actions.DRIVE_FRICTION[given.contact], np.repeat([least, second], count))


def transverse(spec: Travelling, force: float, largest: float, other: float) -> Both:
    """H_T,1 of the light and H_T,2 of the loaded rail, without phi_5 [N]."""
    guide = spec.guide
    rollers = guide is not None and guide.type == "rollers" and guide.base is not None
    apart = guide.base if rollers and guide is not None and guide.base is not None else spec.wheels.base
    return skew.start_side_forces(force, largest / (largest + other), spec.gauge, apart)
