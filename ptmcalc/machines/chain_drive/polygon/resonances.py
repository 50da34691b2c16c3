"""Speeds of a chain drive at which a tooth harmonic meets a natural frequency, and the speeds between them."""

from dataclasses import dataclass

import numpy as np

from ptmcalc.laws import chain_resonance
from ptmcalc.machines.chain_drive.machine.model import (
    MODES,
    FloatArray,
    chain_line,
    damping,
    damping_ratios,
    natural_frequencies,
    vibrating,
)
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, Run
from ptmcalc.machines.chain_drive.polygon.excitation import mass_of_drive, residual
from ptmcalc.machines.chain_drive.polygon.return_strand import return_chain, return_frequencies
from ptmcalc.numerics.harmonic.parts import Chain
from ptmcalc.numerics.harmonic.waves import dynamic_stiffness

_MOST_ORDERS = 64
"""Tooth harmonics whose resonances are computed; a numerical choice. The amplitude of a harmonic falls with its order.
More take longer and add resonances at low speeds; fewer omit them."""
_WIDEST = 0.5
"""Half width of the speed range by default, relative to the speed [1]. An engineering choice. A larger value finds safe
speeds farther away; the sweep becomes coarser."""


@dataclass(frozen=True, slots=True)
class Resonances:
    """Speeds V[n, k] of harmonics and modes, their weights over m a_max, the half widths of their bands, and the bands
    of those that matter."""

    frequencies: FloatArray
    speeds: FloatArray
    weights: FloatArray
    half_widths: FloatArray
    bands: FloatArray
    least_weight: float

    @property
    def matter(self) -> FloatArray:
        return np.asarray(self.weights >= self.least_weight)

    def nearest(self, speed: float) -> tuple[float, int, int] | None:
        """(distance of a speed from the nearest resonance that matters, in half widths of its band, harmonic, mode)."""
        distances = np.where(self.matter, np.abs(speed / self.speeds - 1) / self.half_widths, np.inf)
        order, mode = np.unravel_index(int(np.argmin(distances)), distances.shape)
        least = float(distances[order, mode])
        return (least, int(order) + 1, int(mode) + 1) if np.isfinite(least) else None


def resonances(spec: ChainDrive, scene: Run, carried: frozenset[str]) -> Resonances:
    """All resonance speeds of a scene.

        V_nk = p w_k/(2 pi n),   W_nk = (2/(pi n)) |D(w_k)|/(m w_k^2)

    D is the dynamic stiffness of the damped chain at the sprocket, whatever its ends; without damping it is infinite at
    w_k, and so are the weights. The modes of the return strand in front of a driven tail are among the others; D is
    that at the tail.
    """
    drive = mass_of_drive(spec, carried)
    frequencies = natural_frequencies(spec, scene, drive)
    parts = [_weights(spec, scene, vibrating(spec, scene, drive), frequencies, residual(spec))]
    back = return_chain(spec, scene)
    if back is not None:
        own = return_frequencies(spec, scene, MODES)
        parts.append(_weights(spec, scene, back, own, 1.0))
        frequencies = np.concatenate([frequencies, own])
    order = np.argsort(frequencies, kind="stable")[:MODES]
    frequencies = frequencies[order]
    orders = np.arange(1.0, _MOST_ORDERS + 1)
    weights = np.concatenate(parts)[order] / orders[:, None]
    limit = spec.checks.resonance
    ratios = damping_ratios(damping(spec, scene), frequencies)
    speeds = chain_resonance.resonance_speeds(frequencies, orders, spec.chain.pitch)
    half = chain_resonance.exclusion_half_widths(ratios, limit.band)
    weights, half = (np.broadcast_to(one, speeds.shape) for one in (weights, half))
    matter = weights >= limit.weight
    bands = chain_resonance.exclusion_bands(speeds[matter], half[matter])
    return Resonances(frequencies, speeds, np.asarray(weights), np.asarray(half), bands, limit.weight)


def _weights(spec: ChainDrive, scene: Run, chain: Chain, frequencies: FloatArray, share: float) -> FloatArray:
    """Weights of the modes of a chain for the first harmonic of the teeth, of which the drive leaves a share [1]."""
    if share == 0:
        return np.zeros_like(frequencies)
    stiff = np.abs(dynamic_stiffness(chain, frequencies))
    stiff = np.where(damping_ratios(damping(spec, scene), frequencies) > 0, stiff, np.inf)
    return np.asarray(2 / np.pi * share * (stiff / (chain_line(spec, scene).moving_mass * frequencies**2)))


def safe_speeds(spec: ChainDrive, scene: Run, carried: frozenset[str]) -> tuple[float, float]:
    """The nearest speeds below and above that of the file outside the bands of this and every other run [m/s]."""
    runs = [scene, *(other for other in spec.all_scenes if isinstance(other, Run) and other != scene)]
    found = [resonances(spec, one, carried) for one in runs]
    centres, halves = (
        np.concatenate([getattr(one, part)[one.matter] for one in found]) for part in ("speeds", "half_widths")
    )
    return chain_resonance.nearest_safe_speeds(spec.speed, chain_resonance.exclusion_bands(centres, halves))


def operating_range(spec: ChainDrive) -> tuple[float, float]:
    """Speeds between which safe windows and the sweep are looked for [m/s]."""
    if spec.operating is not None:
        return spec.operating.lowest, spec.operating.highest
    return (1 - _WIDEST) * spec.speed, (1 + _WIDEST) * spec.speed
