"""The hoist of the winding paper as a design file, and references of its motion that share nothing with the package."""

import itertools
import math
from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from ptmcalc.machines.hoist.machine.spec import Hoist
from support.machines import changed, loaded

PAPER: dict[str, Any] = {
    "kind": "hoist",
    "load": "5 t",
    "height": "40 m",
    "speed": {"drum": "12 rpm"},
    "reeving": {"falls": 4, "sheave_efficiency": 0.98},
    "rope": {"diameter": "17.5 mm", "area": "114 mm^2", "modulus": "105 GPa", "mass": "1.1 kg/m"},
    "drum": {
        "diameter": "300 mm",
        "length": "640 mm",
        "pitch": "17.5 mm",
        "layers": 4,
        "flange_height": "95 mm",
    },
    "winding": {"crossover": "60 deg", "paper_modulus": "210 GPa"},
    "scenes": [{"type": "winding"}],
}
HEIGHTS = {"160 m": "40 m", "140 m": "35 m", "120 m": "30 m", "100 m": "25 m"}
"""Lifting height by the length of the rope on four falls."""
DIAMETERS = {"114 mm^2": "17.5 mm", "94.5 mm^2": "16 mm", "77 mm^2": "14.5 mm", "61 mm^2": "13 mm"}
"""Rope diameter by metallic area."""
PRINTED = {
    ("160 m", "114 mm^2"): "5.47",
    ("140 m", "114 mm^2"): "5.848",
    ("120 m", "114 mm^2"): "6.317",
    ("100 m", "114 mm^2"): "6.92",
    ("160 m", "94.5 mm^2"): "4.981",
    ("160 m", "77 mm^2"): "4.496",
    ("160 m", "61 mm^2"): "4.002",
}
"""Frequencies as printed, rad/s, by rope length and metallic area."""


def variant(length: str, area: str, **changes: Any) -> dict[str, Any]:
    """The hoist with another lifting height and rope."""
    return changed(PAPER, height=HEIGHTS[length], rope__area=area, rope__diameter=DIAMETERS[area], **changes)


def hoist(data: dict[str, Any]) -> Hoist:
    """A machine of a design file."""
    spec = loaded(data).spec
    assert isinstance(spec, Hoist)
    return spec


def general(
    k: float, force: Callable[[float], float], until: float, times: np.ndarray, breaks: tuple[float, ...] = ()
) -> np.ndarray:
    """Deflection of an oscillator at rest under a force by DOP853, restarted at the breaks."""
    edges, state, found = [0.0, *breaks, until], [0.0, 0.0], np.empty(len(times))
    for begin, end in itertools.pairwise(edges):
        middle = (begin + end) / 2
        inside = (times >= begin) & (times <= end)
        run = solve_ivp(
            lambda t, y, m=middle: [y[1], force(t if begin <= t <= end else m) - k * k * y[0]],  # noqa: B023
            (begin, end), state, "DOP853", dense_output=True, rtol=1e-11, atol=1e-16, max_step=0.3 / k,
        )  # fmt: skip
        found[inside], state = run.sol(times[inside])[0], run.y[:, -1].tolist()
    return found


def paper_force(amplitude: float, turn: float) -> Callable[[float], float]:
    """The forcing of the paper, for one turn of its drum."""
    return lambda t: amplitude * (math.exp(-3 * t) - math.exp(-96 * t)) if t <= turn else 0.0
