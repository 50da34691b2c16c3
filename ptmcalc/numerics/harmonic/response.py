"""Peaks of the force in a chain whose ends move periodically, over a sweep of speeds."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ptmcalc.numerics.harmonic.parts import FREE, Chain, Excitation
from ptmcalc.numerics.harmonic.rest import rest_of
from ptmcalc.numerics.harmonic.search import Search
from ptmcalc.numerics.harmonic.waves import EPS, RESONANT, Waves, ratios_of

FloatArray = NDArray[np.float64]

_BLOCK = 2**15
"""Harmonics of all speeds computed at a time: what they need stays in the cache."""


@dataclass(frozen=True, slots=True)
class Peaks:
    """Largest and smallest dynamic force per speed, where in the pitch, and between which numbers they truly lie.

    Unbounded forces are infinite, with infinite ends. `bound` is the sum of the absolute terms, the tail included: no
    force is larger, whatever the phases [N].
    """

    largest: FloatArray
    largest_place: FloatArray
    largest_low: FloatArray
    largest_high: FloatArray
    smallest: FloatArray
    smallest_place: FloatArray
    smallest_low: FloatArray
    smallest_high: FloatArray
    bound: FloatArray


def polygon_response(
    chain: Chain,
    frequency: ArrayLike,
    near: Excitation,
    far: Excitation | None = None,
    at_far_end: bool = False,
) -> Peaks:
    """Peaks of the force of a chain whose ends move periodically, speed by speed.

        S(x) = sum_n Im((D_1 u_n + D_2 u_n,far) exp(2 pi i n x)),   u_n = -b_n/(n w)^2

    Args:
        chain: the strands and their ends.
        frequency: w, of the teeth, above 0, shape () or (speeds,) [rad/s].
        near: acceleration of the run-on.
        far: acceleration of the far end, against its mass where it is free; none where not given.
        at_far_end: the force at the far end instead of the run-on.

    Returns:
        the peaks, arrays of the shape of the frequency.

    **Range** linear, the strands stay taut.
    **Error** told with every peak; infinite where damping is too light to bound what lies behind the last harmonic.
    With 1024 harmonics and 0.5 to 5 % of damping it is below 0.6 % of the largest force from a fiftieth of the first
    natural frequency upwards.
    **Source** `waves`, `rest` and `search`, the module docstrings.
    """
    speeds = np.atleast_1d(np.asarray(frequency, float))
    parts = [near] if far is None else [near, far]
    if chain.far == FREE and chain.far_mass == 0 and (far is not None or at_far_end):
        raise ValueError("a free end without mass is not moved by anything and has no force")
    if far is not None and far.harmonics.shape[-1] != near.harmonics.shape[-1]:
        raise ValueError("both ends need the same number of harmonics")
    found: list[list[FloatArray]] = []
    step = max(_BLOCK // near.harmonics.shape[-1], 1)
    for first in range(0, len(speeds), step):
        rows = slice(first, first + step)
        own = [Excitation(np.broadcast_to(p.harmonics, (len(speeds), p.harmonics.shape[-1]))[rows], p.place)
               for p in parts]  # fmt: skip
        found.append(_block(chain, speeds[rows], own, at_far_end))
    return Peaks(*(np.concatenate(column).reshape(np.shape(frequency)) for column in zip(*found, strict=True)))


def _block(chain: Chain, speeds: FloatArray, parts: list[Excitation], at_far_end: bool) -> list[FloatArray]:
    count = parts[0].harmonics.shape[-1]
    orders = np.arange(1, count + 1)
    w = speeds[:, None] * orders
    ratios = ratios_of(chain, Waves(chain, w), w)
    resonant = ratios.sound <= RESONANT
    forces, rests = [], []
    apart = chain.far != FREE or len(parts) == 2 or at_far_end
    for k, part in enumerate(parts):
        above = (ratios.far if at_far_end else ratios.near)[k]
        moved = -part.harmonics / w**2 * np.exp(-2j * np.pi * orders * part.place)
        force = np.divide(above * moved, ratios.below, out=np.zeros_like(above), where=~resonant)
        forces.append(force)
        crossed = (k == 1) != at_far_end
        rests.append(rest_of(chain, speeds, part, crossed=crossed, at_far_end=at_far_end, apart=apart))
    driven = np.sum([np.abs(part.harmonics) for part in parts], axis=0) > 0
    unbounded = np.any(resonant & driven, axis=-1)
    sizes: FloatArray = np.sum(np.abs(forces), axis=0)
    rounding = np.sum(sizes * (4 * EPS + 4 / np.maximum(ratios.sound, RESONANT)), axis=-1)
    bound = sizes.sum(axis=-1) + np.sum([rest.whole for rest in rests], axis=0)
    search = Search(forces, [part.place for part in parts], rests, rounding)
    largest = search.largest(1.0)
    smallest = search.largest(-1.0)
    columns = [*largest, -smallest[0], smallest[1], -smallest[3], -smallest[2], bound]
    limits = [np.inf, 0.0, np.inf, np.inf, -np.inf, 0.0, -np.inf, -np.inf, np.inf]
    return [np.where(unbounded, limit, column) for column, limit in zip(columns, limits, strict=True)]
