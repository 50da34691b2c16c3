"""Bars of one climb, with the bound of the layer's map, against the whole layer, on seeded hoists."""

import math
from typing import Any

import numpy as np
from support.machines import changed
from support.winding import PAPER, hoist

from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import NOTHING, Estimate
from ptmcalc.machines.hoist.effects_winding import LAYER_MAP
from ptmcalc.machines.hoist.solvers.winding_corrected import WINDING_CORRECTED
from ptmcalc.machines.hoist.solvers.winding_map import WINDING_MAP

_ROUNDING = 1e-9


def random_hoist(rng: np.random.Generator) -> dict[str, Any]:
    """From slow cranes to fast one-fall hoists, hardly and well damped, anywhere on their way."""
    ropes = int(rng.integers(1, 3))
    falls, height = ropes * int(rng.integers(1, 5)), float(rng.uniform(20, 120))
    d = float(rng.uniform(0.008, 0.036))
    hook, drum = float(rng.uniform(0, 0.9)) * height, d * float(rng.uniform(16, 30))
    scene = {"type": "winding", "layer": int(rng.integers(2, 5)), "hook_height": f"{hook!r} m"}
    return changed(
        PAPER,
        load=f"{10 ** rng.uniform(2.5, 4.5)!r} kg",
        height=f"{height!r} m",
        least_fall=f"{rng.uniform(2, 20)!r} m",
        gravity=f"{rng.uniform(9.7, 9.9)!r} m/s^2",
        speed={"drum": f"{10 ** rng.uniform(-1, 1.2)!r} rad/s"},
        reeving__falls=falls,
        reeving__ropes=ropes,
        rope__diameter=f"{d!r} m",
        rope__area=f"{0.5 * math.pi / 4 * d * d!r} m^2",
        rope__damping=float(rng.choice([0.0, 0.005, 0.05, 0.3])),
        drum__diameter=f"{drum!r} m",
        drum__length=f"{d * rng.uniform(15, 60)!r} m",
        drum__pitch=f"{d * rng.uniform(1, 1.15)!r} m",
        drum__flange_height=f"{8 * d!r} m",
        winding={"packing": str(rng.choice(["nested", "square"])), "crossovers": int(rng.integers(1, 4))},
        winding__crossover=f"{rng.uniform(20, 100)!r} deg",
        scenes=[scene],
    )


def test_one_climb_holds_the_whole_layer() -> None:
    rng, compared, needed = np.random.default_rng(6_140), 0, 0.0
    for _ in range(120):
        spec = hoist(random_hoist(rng))
        scene = spec.all_scenes[0]
        try:
            better = WINDING_MAP.run(spec, scene, frozenset(), 0).loads
        except NumericsError:
            continue
        found = {name: one.estimate for name, one in WINDING_CORRECTED.run(spec, scene, frozenset(), 0).loads.items()}
        offsets = LAYER_MAP.bound(spec, scene, found)
        for name, estimate in found.items():
            if name not in better:
                continue
            wide, exact = estimate.widened(offsets.get(name, NOTHING)), better[name].estimate
            assert inside(wide, exact), (name, wide, exact)
            if name in offsets:
                needed = max(needed, exact.value / wide.high)
                compared += 1
    assert compared >= 200
    assert needed > 0.3


def inside(wide: Estimate, exact: Estimate) -> bool:
    """Whether a bar leaves the better number possible; both may be off by the better one's own bar."""
    slack = _ROUNDING * (abs(exact.value) + 1e-12)
    return wide.low <= exact.high + slack and exact.low - slack <= wide.high
