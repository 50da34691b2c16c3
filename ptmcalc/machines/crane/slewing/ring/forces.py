"""The forces of a slewing ring, or of the bearings of a column."""

import math
from collections.abc import Sequence

import numpy as np

from ptmcalc.machines.crane.slewing.machine import model
from ptmcalc.machines.crane.slewing.machine.spec import RingPoint, SlewingCrane, SlewingScene


def known(spec: SlewingCrane) -> bool:
    """Whether the file says what rests on the ring."""
    parts = spec.inertia is None or (spec.ring.mass_above is not None and spec.ring.unbalance is not None)
    return parts and spec.load is not None


def weight_above(spec: SlewingCrane) -> float:
    """Weight on the ring without what hangs [N]."""
    if spec.ring.mass_above is not None:
        return spec.ring.mass_above * spec.gravity
    parts = (spec.slewing_part, spec.counterweight, spec.jib)
    return spec.gravity * sum(part.mass for part in parts if part is not None)


def moment_above(spec: SlewingCrane) -> float:
    """Tilting moment of the weight on the ring without what hangs, towards the load [N*m]."""
    if spec.ring.unbalance is not None:
        return spec.ring.unbalance
    return model.structure_unbalance(spec) * spec.gravity


def of_ring(spec: SlewingCrane, scene: SlewingScene) -> dict[str, float]:
    """Forces of the ring in steady slewing, the largest wind along the jib, and the use of the catalogue's curve."""
    if not known(spec) or spec.load is None:
        return {}
    hanging, wind = model.hanging_mass(spec, scene) * spec.gravity, spec.ring.wind_force or 0.0
    outwards = hanging * spec.load.radius / spec.gravity * spec.speed**2
    behind = moment_above(spec) / spec.gravity * spec.speed**2
    loads = {
        "ring_force_axial": weight_above(spec) + hanging,
        "ring_force_radial": abs(outwards + behind) + wind,
        "ring_moment": _moment(spec, hanging, outwards, wind),
    }
    if spec.ring.curve is not None:
        factor = spec.ring.load_factor
        with_load = _use(spec, spec.ring.curve, factor * hanging, factor * outwards, wind)
        loads["ring_utilisation"] = max(with_load, _use(spec, spec.ring.curve, 0.0, 0.0, wind))
    return loads


def _use(spec: SlewingCrane, curve: Sequence[RingPoint], hanging: float, outwards: float, wind: float) -> float:
    """Use of the catalogue's curve with so much on the hook; without any, a counterweight may win."""
    bears = borne(curve, weight_above(spec) + hanging)
    return _moment(spec, hanging, outwards, wind) / bears if bears > 0 else math.inf


def _moment(spec: SlewingCrane, hanging: float, outwards: float, wind: float) -> float:
    assert spec.load is not None
    standing = moment_above(spec) + hanging * spec.load.radius + outwards * (spec.ring.head_height or 0.0)
    return abs(standing) + wind * (spec.ring.wind_height or 0.0)


def borne(curve: Sequence[RingPoint], axial: float) -> float:
    """Tilting moment the ring bears with an axial force: straight between the points, none beyond the last [N*m]."""
    forces, moments = [point.axial for point in curve], [point.moment for point in curve]
    return float(np.interp(axial, forces, moments, right=moments[-1] if axial <= forces[-1] else 0.0))
