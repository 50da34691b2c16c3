"""Whether a crane tips: moments that keep it on its wheels over those that tip it, with partial factors."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from ptmcalc.machines.crane.travelling.machine import model
from ptmcalc.machines.crane.travelling.machine.model import State, filled
from ptmcalc.machines.crane.travelling.machine.scenes import Storm, TravelScene
from ptmcalc.machines.crane.travelling.machine.spec import Travelling

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Partial:
    """Partial factors of one combination of loads."""

    load: float
    """on a load that tips, and on the forces of the drive"""
    own: float
    """on own weight that tips"""
    helps: float
    """on own weight that keeps the crane on its wheels"""
    wind: float


NO_WIND, WINDY, PARKED = "regular", "in the wind", "out of service"
FACTORS: Mapping[str, Mapping[str, Partial]] = MappingProxyType(
    {
        "en_13001_2": MappingProxyType(
            {
                NO_WIND: Partial(1.34, 1.22, 0.90, 1.0),
                WINDY: Partial(1.22, 1.16, 0.95, 1.22),
                PARKED: Partial(1.10, 1.10, 1.0, 1.2),
            }
        ),
        "fem_1_001": MappingProxyType(
            {
                NO_WIND: Partial(1.6, 1.0, 1.0, 1.0),
                WINDY: Partial(1.35, 1.0, 1.0, 1.0),
                PARKED: Partial(1.0, 1.0, 1.0, 1.1),
            }
        ),
    }
)
"""By edition: EN 13001-2 with calculated weights (combinations A, B, C2), and the booklet of FEM 1.001. Quoted from
secondary sources; to be confirmed."""


def partial(spec: Travelling, scene: TravelScene) -> Partial:
    """The factors of a scene by its combination of loads."""
    edition = FACTORS[spec.classes.stability]
    if isinstance(scene, Storm):
        return edition[PARKED]
    return edition[NO_WIND if spec.wind is None else WINDY]


def reserve(spec: Travelling, scene: TravelScene, state: State) -> FloatArray:
    """Moments that keep the crane on its wheels over those that tip it, the least over all edges, shape (n,) [1].

        front, rear:  (g_h G + G_l) B/2 / (g_l |sum m a h + H h_r| + g_w F_w h_w)
        rails:        g_h sum G b / (g_o sum G b' + g_l G_l b'),   b inside of the rail, b' beyond it

    **Range** a crane that does not bend, on four corners; the load as it pulls at its ropes.
    **Error** exact for that model; the factors are those of the edition.
    **Source** equilibrium; EN 13001-2 and ISO 8686-1, FEM 1.001 for the factors.
    """
    factors = partial(spec, scene)
    acceleration, pull, weight, wind = np.broadcast_arrays(
        *(np.atleast_1d(part) for part in (state.acceleration, state.pull, state.weight, state.wind))
    )
    least = np.full(len(pull), math.inf)
    for hook in model.hook_places(spec, scene):
        bodies = model.bodies(spec, hook)
        own = sum(body.mass for body in bodies) * spec.gravity
        driven = sum(body.mass * body.height for body in bodies) * acceleration + pull * model.rope_height(spec)
        tips = factors.load * np.abs(driven) + factors.wind * np.abs(wind) * model.wind_height(spec)
        keeps = (factors.helps * own + weight) * spec.wheels.base / 2
        least = np.minimum(least, _over(keeps, tips))
        for towards in (1.0, -1.0):
            edge = 0.0 if towards > 0 else spec.gauge
            kept, tipped = np.zeros(len(pull)), np.zeros(len(pull))
            for body in bodies:
                arm = towards * (body.across - edge)
                kept += factors.helps * body.mass * spec.gravity * max(arm, 0.0)
                tipped += factors.own * body.mass * spec.gravity * max(-arm, 0.0)
            arm = towards * (hook - edge)
            least = np.minimum(
                least, _over(kept + weight * max(arm, 0.0), tipped + factors.load * weight * max(-arm, 0.0))
            )
    return least


def of_rest(spec: Travelling, scene: TravelScene, pressure: float | None) -> float:
    """Of a crane that stands or travels evenly in a wind [1]."""
    load = filled(model.hanging(spec, scene)) * spec.gravity
    state = State(0.0, model.wind_on_load(spec, scene, pressure), load, 0.0, model.wind_force(spec, pressure))
    return float(reserve(spec, scene, state)[0])


def _over(keeps: FloatArray, tips: FloatArray) -> FloatArray:
    safe = np.where(tips > 0, tips, 1.0)
    return np.where(tips > 0, keeps / safe, math.inf)
