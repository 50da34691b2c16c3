"""What the sprockets of a chain drive force on its chain, and what the chain answers.

A take-up weight is moved by the run-off's polygon, not by a drive that gives way: with a weight of a tenth of the chain
the answer then peaks 2 % beside the natural frequency.
"""

import math
from dataclasses import dataclass, replace
from typing import cast

import numpy as np
from numpy.typing import ArrayLike

from ptmcalc.base.estimate import Estimate
from ptmcalc.laws import inertia, polygon, sprocket
from ptmcalc.machines.chain_drive.machine.layout import TwoShafts
from ptmcalc.machines.chain_drive.machine.model import (
    FloatArray,
    chain_line,
    damping,
    drive_mass,
    ends_at_tail,
    natural_frequencies,
    tail_teeth,
    vibrating,
)
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, Run
from ptmcalc.numerics.harmonic import parts
from ptmcalc.numerics.harmonic.inside import joint_forces
from ptmcalc.numerics.harmonic.parts import Chain, Excitation
from ptmcalc.numerics.harmonic.response import Peaks, polygon_response
from ptmcalc.numerics.harmonic.waves import RESONANT, Waves, ratios_of

POLYGON, FAR, WEAK = "polygon", "far_polygon", "weak_drive"
HARMONICS = (1024, 4096)
"""Tooth harmonics of the Fourier series by level. A numerical choice: the rest is bounded and added. More narrow the
error bar and take longer."""
_EXACT = 1e-5
"""Relative difference of a tooth harmonic and a natural frequency [1] below which an undamped chain is in resonance. A
numerical choice. A larger value reports more speeds without a bound; a smaller one gives very large tensions
instead."""


def residual(spec: ChainDrive) -> float:
    """What an equalising drive leaves of the polygon effect of its sprocket."""
    return spec.equalising.residual if spec.equalising is not None else 1.0


def mass_of_drive(spec: ChainDrive, carried: frozenset[str]) -> float:
    """The drive as a mass at the chain: infinite where it does not give way [kg]."""
    return drive_mass(spec, inertia.ENERGY) if WEAK in carried else math.inf


def excites_far(spec: ChainDrive, chain: Chain) -> bool:
    """Whether something moves the far end: the run-off of the same sprocket, or another sprocket."""
    return chain.far != parts.FREE or chain.far_mass > 0


def far_place(spec: ChainDrive) -> float | None:
    """Place in the pitch of the joints at the far end; None where nobody knows it."""
    if isinstance(spec.layout, TwoShafts):
        return spec.layout.driven.phase
    if spec.layout.tail.driven == "on":
        return spec.layout.tail.phase
    return sprocket.pitch_fraction(spec.sprocket.teeth / 2, 1.0)  # half a turn round the drive


def harmonics(spec: ChainDrive, speeds: FloatArray, teeth: int, share: float, count: int) -> FloatArray:
    """Of the acceleration of a chain on a sprocket, shape (speeds, count) [m/s^2]."""
    orders = np.arange(1, count + 1)
    one = polygon.acceleration_harmonics(orders.astype(float), 1.0, spec.chain.pitch, teeth)
    return np.asarray(share * one * speeds[:, None] ** 2)


def excitations(
    spec: ChainDrive, chain: Chain, speeds: FloatArray, carried: frozenset[str], count: int
) -> tuple[Excitation, Excitation | None]:
    """Of the run-on and of the far end; none where the far end is at rest or left out."""
    share = residual(spec)
    near = Excitation(harmonics(spec, speeds, spec.sprocket.teeth, share, count))
    if FAR not in carried or not excites_far(spec, chain):
        return near, None
    if ends_at_tail(spec):
        moved = harmonics(spec, speeds, tail_teeth(spec), 1.0, count)
    else:  # the run-off of the same sprocket
        moved = near.harmonics
    return near, Excitation(moved, far_place(spec) or 0.0)


def still(part: Excitation) -> Excitation:
    """The same without any motion."""
    return replace(part, harmonics=np.zeros_like(part.harmonics))


def tooth_frequency(spec: ChainDrive, speeds: ArrayLike) -> FloatArray:
    """Circular frequency with which teeth pass [rad/s]."""
    return np.asarray(2 * np.pi * np.asarray(speeds, float) / spec.chain.pitch)


@dataclass(frozen=True, slots=True)
class Swept:
    """Peaks over speeds: largest and smallest at one end, with their ends, the sum of absolute terms, the place."""

    largest: FloatArray
    largest_low: FloatArray
    largest_high: FloatArray
    smallest: FloatArray
    smallest_low: FloatArray
    smallest_high: FloatArray
    bound: FloatArray
    place: FloatArray | None


def swept(
    spec: ChainDrive, chain: Chain, speeds: FloatArray, carried: frozenset[str], count: int, at_far_end: bool = False
) -> Swept:
    """Peaks of the force at an end of the chain."""
    near, far = excitations(spec, chain, speeds, carried, count)
    return peaks_of(chain, tooth_frequency(spec, speeds), near, far, far_place(spec) is not None, at_far_end)


def peaks_of(
    chain: Chain, w: FloatArray, near: Excitation, far: Excitation | None, placed: bool, at_far_end: bool = False
) -> Swept:
    """The same for given motions of both ends, with or without a known place of the far joints.

    Where nobody knows the place of the far sprocket's joints the worst of all is taken: the peaks of both parts fall
    together at some place, so their sum is that of the worst one exactly.
    """
    if far is None or placed:
        return _swept(polygon_response(chain, w, near, far, at_far_end), placed=True)
    one = _swept(polygon_response(chain, w, near, still(far), at_far_end), placed=False)
    other = _swept(polygon_response(chain, w, still(near), far, at_far_end), placed=False)
    added = {
        name: cast(FloatArray, getattr(one, name)) + cast(FloatArray, getattr(other, name))
        for name in Swept.__dataclass_fields__
        if name != "place"
    }
    return Swept(**added, place=None)


def _swept(peaks: Peaks, placed: bool) -> Swept:
    return Swept(
        peaks.largest,
        peaks.largest_low,
        peaks.largest_high,
        peaks.smallest,
        peaks.smallest_low,
        peaks.smallest_high,
        peaks.bound,
        peaks.largest_place if placed else None,
    )


def _estimate(values: FloatArray, lows: FloatArray, highs: FloatArray) -> Estimate:
    """Of the only speed."""
    value, low, high = (float(one[0]) for one in (values, lows, highs))
    if math.isinf(value):
        return Estimate.exact(value)
    return Estimate(value, low, high, numerical=max(value - low, high - value))


def ended(peaks: Swept) -> tuple[Estimate, Estimate]:
    """Largest and smallest force of the only speed [N]."""
    return (
        _estimate(peaks.largest, peaks.largest_low, peaks.largest_high),
        _estimate(peaks.smallest, peaks.smallest_low, peaks.smallest_high),
    )


def undamped(spec: ChainDrive, scene: Run) -> bool:
    """Whether the chain damps nothing."""
    kind = damping(spec, scene)
    return kind.share == 0 and (kind.law != parts.KELVIN_VOIGT or kind.time == 0)


def unbounded(spec: ChainDrive, scene: Run, carried: frozenset[str]) -> bool:
    """Whether a chain without damping runs at a resonance: no machine turns more exactly than the tolerance."""
    if not undamped(spec, scene) or residual(spec) == 0:
        return False
    modes = natural_frequencies(spec, scene, mass_of_drive(spec, carried))
    turns = modes / float(tooth_frequency(spec, spec.speed))
    harmonic = np.maximum(np.round(turns), 1.0)
    return bool(np.any(np.abs(turns / harmonic - 1) < _EXACT))


def change_by_drive(spec: ChainDrive, scene: Run) -> float:
    """Most by which a drive that gives way changes the dynamic tension at either end or at the tail [N].

    |dS| <= sum |D'_n - D_n| |u_n| + what both leave out behind the last harmonic
    """
    chains = [vibrating(spec, scene, mass) for mass in (math.inf, drive_mass(spec, inertia.ENERGY))]
    w = tooth_frequency(spec, [spec.speed])
    count = HARMONICS[0]
    near, far = excitations(spec, chains[0], np.array([spec.speed]), frozenset({FAR}), count)
    orders = w[:, None] * np.arange(1, count + 1)
    found = [ratios_of(chain, Waves(chain, orders), orders) for chain in chains]
    if any(np.any(one.sound <= RESONANT) for one in found):
        return math.inf
    ends = (False, True) if excites_far(spec, chains[0]) else (False,)
    worst = 0.0
    for end in ends:
        forces = [(one.far if end else one.near) for one in found]
        change, known = 0.0, [0.0, 0.0]
        for k, part in enumerate((near,) if far is None else (near, far)):
            moved = np.abs(part.harmonics) / orders**2
            stiff = [force[k] / one.below for force, one in zip(forces, found, strict=True)]
            change += float(np.sum(np.abs(stiff[1] - stiff[0]) * moved))
            known = [whole + float(np.sum(np.abs(one) * moved)) for whole, one in zip(known, stiff, strict=True)]
        bounds = [float(polygon_response(chain, w, near, far, at_far_end=end).bound[0]) for chain in chains]
        worst = max(worst, change + sum(max(b - a, 0.0) for a, b in zip(known, bounds, strict=True)))
    if len(chains[0].lines) == 2:
        held, weak = (joint_forces(chain, w, near, far) for chain in chains)
        rest = float(held[2][0] + weak[2][0])
        worst = max(worst, *(float(np.sum(np.abs(weak[k] - held[k]))) + rest for k in (0, 1)))
    return worst


def static_scale(spec: ChainDrive, scene: Run) -> float:
    """Largest static tension with the centrifugal one: what dynamic tensions are measured by [N]."""
    line = chain_line(spec, scene)
    return max(line.ends) + line.centrifugal
