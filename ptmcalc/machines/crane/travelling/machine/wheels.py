"""Loads and grip of the wheels of a crane, corner by corner."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ptmcalc.laws import skid, wheel_loads
from ptmcalc.machines.crane.travelling.machine import model
from ptmcalc.machines.crane.travelling.machine.model import CORNERS, State, filled
from ptmcalc.machines.crane.travelling.machine.scenes import TravelScene
from ptmcalc.machines.crane.travelling.machine.spec import Travelling

FloatArray = NDArray[np.float64]

_PLACE = {"A1": (0, 1), "A2": (0, 0), "B1": (1, 1), "B2": (1, 0)}
"""Rail and end of a corner as `laws.wheel_loads` counts them."""
_NOTHING = State(0.0, 0.0, 0.0, 0.0, 0.0)


def corner_loads(spec: Travelling, hook: float, state: State) -> dict[str, float]:
    """Of the four corners with the hook so far from rail A, in one state [N]."""
    bodies = model.bodies(spec, hook)
    gauge = spec.gauge
    found = wheel_loads.corner_loads(
        np.array([*(body.mass * spec.gravity for body in bodies), float(state.weight), 0.0]),
        np.array([*(body.across for body in bodies), hook, gauge / 2]),
        np.zeros(len(bodies) + 2),
        np.array([*(-body.mass * state.acceleration for body in bodies), -float(state.pull), -float(state.wind)]),
        np.zeros(len(bodies) + 2),
        np.array([*(body.height for body in bodies), model.rope_height(spec), model.wind_height(spec)]),
        gauge,
        spec.wheels.base,
        spec.wheels.frame,
    )
    return {corner: float(found[_PLACE[corner]]) for corner in CORNERS}


def at_rest(spec: Travelling, scene: TravelScene) -> State:
    """The crane without any force along the rails."""
    return _NOTHING._replace(weight=model.hanging(spec, scene) * spec.gravity)


def driven_corners(spec: Travelling) -> Iterator[str]:
    """Corners with driven wheels, in order."""
    return (corner for corner in CORNERS if model.driven_at(spec, corner))


@dataclass(frozen=True, slots=True)
class Wheels:
    """The wheels of a crane over the places of the hook that a scene is about; loads are linear in the state."""

    spec: Travelling
    hooks: tuple[float, ...]
    levers: FloatArray
    """load of a wheel at rest without anything on the hook, and what each part of a state adds; shape (hooks, 4, 5)"""

    @classmethod
    def of(cls, spec: Travelling, scene: TravelScene) -> "Wheels":
        """The wheels in a scene."""
        hooks = model.hook_places(spec, scene)
        units = [_NOTHING, *(_NOTHING._replace(**{name: 1.0}) for name in ("acceleration", "pull", "weight", "wind"))]
        loads = np.array(
            [[list(corner_loads(spec, hook, state).values()) for state in units] for hook in hooks]
        )  # (hooks, units, 4)
        loads[:, 1:] -= loads[:, :1]
        return cls(spec, hooks, loads.transpose(0, 2, 1) / spec.wheels.per_corner)

    def loads(self, state: State) -> FloatArray:
        """Of a wheel of each corner with the hook in each place, shape (hooks, 4, n) [N]."""
        parts = np.broadcast_arrays(1.0, state.acceleration, state.pull, state.weight, state.wind)
        return np.asarray(np.tensordot(self.levers, np.stack([np.atleast_1d(part) for part in parts]), axes=1))

    def extreme(self, state: State, largest: bool) -> FloatArray:
        """Of all wheels and places, shape (n,) [N]."""
        loads = self.loads(state)
        return np.asarray(loads.max(axis=(0, 1)) if largest else loads.min(axis=(0, 1)))

    def where(self, state: State, largest: bool) -> str:
        """Where the extreme wheel load of one state stands, in words."""
        loads = self.loads(state)[:, :, 0]
        hook, corner = np.unravel_index(int(loads.argmax() if largest else loads.argmin()), loads.shape)
        return f"corner {CORNERS[corner]}, hook {self.hooks[hook]:.3g} m from rail A"

    def grip(self, state: State, corner: str) -> FloatArray:
        """Adhesion of a driven wheel of a corner over what is asked of it, in the worst place; of wheels on one shaft,
        of all together, shape (n,) [1]."""
        spec = self.spec
        adhesion, loads = filled(spec.rail.adhesion), np.maximum(self.loads(state), 0.0)
        if spec.drive.wheels == "coupled":
            driven = np.array([model.driven_at(spec, one) for one in CORNERS], float)
            carried = np.einsum("hcn,c->hn", loads, driven)
            return np.asarray(skid.skid_reserve(adhesion, carried, state.traction).min(axis=0))
        one = np.asarray(state.traction) / model.driven_wheels(spec)
        return np.asarray(skid.skid_reserve(adhesion, loads[:, CORNERS.index(corner)], one).min(axis=0))

    def least_grip(self, state: State) -> FloatArray:
        """Of all driven wheels, shape (n,) [1]."""
        return np.asarray(np.min([self.grip(state, corner) for corner in driven_corners(self.spec)], axis=0))
