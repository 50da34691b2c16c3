"""Speeds at which a tooth harmonic meets a natural frequency of a chain, and the speeds between that are safe.

The n-th harmonic of the tooth frequency V/p meets the k-th natural frequency f_k at V = p f_k/n. The frequencies of the
two strands come from `belt_modes.natural_frequencies` with the speed imposed.
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ptmcalc.laws.loop_bounds import LoopMasses

FloatArray = NDArray[np.float64]

QUARTER_WAVE, HALF_WAVE, FULL_WAVE = "quarter", "half", "full"
_WAVES = {QUARTER_WAVE: 4.0, HALF_WAVE: 2.0, FULL_WAVE: 1.0}


def modal_masses(loop: LoopMasses, frequencies: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Masses with which the modes of a chain held at its sprocket answer a motion of the sprocket.

        M_on = (N_1 - N_0) N_1/(G w^2),   M_off = (N_1 - N_0) N_0/(G w^2)

    N w is the force amplitude of the mode at run-off (0) and run-on (1) and G its generalised mass; M_on - M_off is
    the effective mass of the mode. Under an acceleration a of the sprocket the mode adds M a to the tension when it
    follows at once, M a/(2 zeta) in resonance. Over all modes M_on and M_off sum up to the quasi-static tensions.

    Args:
        loop: the loop, speed imposed.
        frequencies: w, natural circular frequencies of `belt_modes.natural_frequencies` without a take-up mass, shape
            (k,) [rad/s].

    Returns:
        (M_on [kg], M_off [kg]), shape (k,); M_off is 0 with a constant tension at the run-off.

    **Range** undamped linear strands, take-up beside the drive, without mass.
    **Error** rounding of the frequencies.
    **Source** derived: modes of two strands in series, integral of their squares in closed form.
    """
    w = np.asarray(frequencies, float)
    t1 = math.sqrt(loop.carry_mass) * math.sqrt(loop.carry_compliance)
    t2 = math.sqrt(loop.return_mass) * math.sqrt(loop.return_compliance)
    z1 = math.sqrt(loop.carry_mass) / math.sqrt(loop.carry_compliance)
    z2 = math.sqrt(loop.return_mass) / math.sqrt(loop.return_compliance)
    s1, c1, s2, c2 = np.sin(w * t1), np.cos(w * t1), np.sin(w * t2), np.cos(w * t2)
    fixed = loop.fixed_length
    tail = s2 if fixed else c2
    first = np.full_like(w, z2 if fixed else 0.0)
    sign = -1.0 if fixed else 1.0
    behind = (z2 * c2 if fixed else -z2 * s2) - loop.tail_mass * w * tail
    last = behind * c1 - z1 * tail * s1
    swing = behind / z1
    generalised = loop.return_mass * (1 + sign * np.sinc(2 * w * t2 / np.pi)) / 2 + loop.tail_mass * tail**2
    generalised += loop.carry_mass / 2 * (
        tail**2 + swing**2 + (tail**2 - swing**2) * np.sinc(2 * w * t1 / np.pi)
    ) + loop.carry_mass * tail * swing * s1 * np.sinc(w * t1 / np.pi)  # fmt: skip
    share = (last - first) / w / generalised
    return np.asarray(share * (last / w)), np.asarray(share * (first / w))


def resonance_speeds(frequencies: FloatArray, orders: FloatArray, pitch: float) -> FloatArray:
    """Speeds at which a tooth harmonic meets a natural frequency.

        V_nk = p w_k/(2 pi n)

    Args:
        frequencies: w_k, natural circular frequencies, shape (k,) [rad/s].
        orders: n, of the harmonics, shape (n,) [1].
        pitch: p [m].

    Returns:
        V_nk, shape (n, k) [m/s].

    **Range** light damping; the peak lies at most zeta_k^2 of it lower.
    **Error** that of the frequencies.
    **Source** tooth frequency V/p; derived.
    """
    return np.asarray(pitch / (2 * np.pi) * np.asarray(frequencies, float) / np.asarray(orders, float)[:, None])


def resonance_weights(orders: FloatArray, damping_ratios: FloatArray, mass_shares: FloatArray) -> FloatArray:
    """Force of a tooth harmonic in resonance with a mode, over m a_max.

        W_nk = (2/(pi n)) (M_k/m)/(2 zeta_k)

    Args:
        orders: n, of the harmonics, shape (n,) [1].
        damping_ratios: zeta_k, of the modes, shape (k,) [1].
        mass_shares: M_k/m, of `modal_masses` over the whole moving mass; 8/(pi^2 (2 k - 1)^2) for one strand, shape
            (k,) [1].

    Returns:
        W_nk; infinite without damping, shape (n, k) [1].

    **Range** light damping.
    **Error** leaves out the other modes and harmonics and n^2 z^2/(n^2 z^2 - 1), 0.4 % of 1 for n = 1 and 16 teeth.
    **Source** first term of the Fourier series of the acceleration; derived.
    """
    zeta, share = np.broadcast_arrays(np.asarray(damping_ratios, float), np.abs(np.asarray(mass_shares, float)))
    high = np.divide(share, 2 * zeta, out=np.where(share > 0, np.inf, 0.0), where=zeta > 0)
    return np.asarray(2 / np.pi * high / np.asarray(orders, float)[:, None])


def exclusion_half_widths(damping_ratios: FloatArray, least: float) -> FloatArray:
    """How near to a resonance speed, as a share of it, is too near.

        d_k = max(d_0, 2 zeta_k)

    Args:
        damping_ratios: zeta_k, of the modes [1].
        least: d_0; recommended 0.15 [1].

    Returns:
        d_k [1].

    **Range** light damping; at d the response has fallen to about zeta/d of its peak.
    **Error** d_0 is a choice: it covers what is not known of the stiffness, twice its own value.
    **Source** engineering rule; no source known for the printed bands of the lecture notes.
    """
    return np.asarray(np.maximum(2 * np.asarray(damping_ratios, float), least))


def exclusion_bands(speeds: FloatArray, half_widths: FloatArray) -> FloatArray:
    """Bands of speed round resonances, those that overlap as one.

        band = V (1 - d) ... V (1 + d)

    Args:
        speeds: V, of resonances that matter, any shape [m/s].
        half_widths: d, of the same or a smaller shape that fits [1].

    Returns:
        lower and upper ends in rising order, shape (m, 2) [m/s].

    **Range** V > 0.
    **Error** exact.
    **Source** definition.
    """
    values, widths = np.broadcast_arrays(np.asarray(speeds, float), np.asarray(half_widths, float))
    low, high = (values * np.maximum(1 - widths, 0.0)).ravel(), (values * (1 + widths)).ravel()
    order = np.argsort(low)
    low, high = low[order], np.maximum.accumulate(high[order])
    if low.size == 0:
        return np.zeros((0, 2))
    new = np.concatenate([[True], low[1:] > high[:-1]])
    return np.stack([low[new], high[np.concatenate([new[1:], [True]])]], axis=-1)


def safe_windows(bands: FloatArray, slowest: float, fastest: float) -> FloatArray:
    """Ranges of speed between the bands of resonances.

        windows = (V_low, V_high) without every band

    Args:
        bands: of `exclusion_bands`, shape (m, 2) [m/s].
        slowest: V_low [m/s].
        fastest: V_high [m/s].

    Returns:
        lower and upper ends in rising order, shape (w, 2); none where the bands cover the whole range [m/s].

    **Range** V_low <= V_high.
    **Error** exact.
    **Source** definition.
    """
    ends = np.asarray(bands, float).reshape(-1, 2)
    low = np.clip(np.concatenate([[slowest], ends[:, 1]]), slowest, fastest)
    high = np.clip(np.concatenate([ends[:, 0], [fastest]]), slowest, fastest)
    return np.asarray(np.stack([low, high], axis=-1)[high > low])


def nearest_safe_speeds(chain_speed: float, bands: FloatArray) -> tuple[float, float]:
    """Nearest speeds below and above one that lie outside every band.

        below, above = V itself outside the bands, else the ends of its band

    Args:
        chain_speed: V [m/s].
        bands: of `exclusion_bands`, shape (m, 2) [m/s].

    Returns:
        below, 0 where the band begins at rest [m/s], above [m/s].

    **Range** a speed on the end of a band is outside it.
    **Error** exact.
    **Source** definition.
    """
    for low, high in np.asarray(bands, float).reshape(-1, 2).tolist():
        if low < chain_speed < high:
            return low, high
    return chain_speed, chain_speed


def textbook_resonance_speed(factor: float, pitch: float, length: float, section: float, line_weight: float) -> float:
    """Resonance speed by the textbook's coefficient, with the units that fit its printed range.

        V = K (p/L) (A/q)^(1/2),   A in cm^2, q in N/m, V in m/s

    Args:
        factor: K, printed as 3000 to 4000, a number for these units [1].
        pitch: p [m].
        length: L, of one strand [m].
        section: A, of the plates [m^2].
        line_weight: q, of what moves [N/m].

    Returns:
        V [m/s].

    **Range** a cross-check beside `resonance_speeds`, never a result: the lecture notes lost the units of K.
    **Error** the uniform strand behind it is 44 % high in a worked case of a loaded working and an empty return
    strand; with q in kgf/m and the wave of the full ring K has the same range and V is 3.13 times as high.
    **Source** lecture notes Kramatorsk 2007 for the shape; units derived (`textbook_resonance_factor`).
    """
    return factor * (pitch / length) * 100 * math.sqrt(section / line_weight)


def textbook_resonance_factor(modulus: float, gravity: float, wave: str) -> float:
    """Textbook's coefficient of the resonance speed for a modulus of the chain.

        K = (1/s) (E g/10^4)^(1/2),   s = 4, 2, 1 for a quarter, a half, a full wave in the strand

    Args:
        modulus: E, of the chain over the section of its plates [N/m^2].
        gravity: g [m/s^2].
        wave: `quarter` (recommended: sprocket at one end, constant tension at the other), `half` or `full`.

    Returns:
        K, a number for A in cm^2, q in N/m, V in m/s [1].

    **Range** a uniform strand.
    **Error** exact for it.
    **Source** derived: V = p f, f = c/(s L), c = (E A g/q)^(1/2).

    Raises:
        ValueError: for another wave.
    """
    if wave not in _WAVES:
        raise ValueError(f"the wave is one of {', '.join(_WAVES)}, not `{wave}`")
    return math.sqrt(modulus * gravity) / (100 * _WAVES[wave])


def textbook_resonance_modulus(factor: float, gravity: float, wave: str) -> float:
    """Modulus of the chain that the textbook's coefficient implies: the inverse of `textbook_resonance_factor`.

        E = 10^4 (s K)^2/g

    Args:
        factor: K, a number for A in cm^2, q in N/m, V in m/s [1].
        gravity: g [m/s^2].
        wave: `quarter` (recommended), `half` or `full`.

    Returns:
        E [N/m^2].

    **Range** as `textbook_resonance_factor`; 0.5 to 0.8 of that of steel is usual for a chain.
    **Error** exact for a uniform strand.
    **Source** as `textbook_resonance_factor`.

    Raises:
        ValueError: for another wave.
    """
    if wave not in _WAVES:
        raise ValueError(f"the wave is one of {', '.join(_WAVES)}, not `{wave}`")
    return (100 * _WAVES[wave] * factor) ** 2 / gravity


def transverse_frequencies(
    span: float, tension: ArrayLike, line_mass: float, chain_speed: float, order: int
) -> FloatArray:
    """Natural frequency of a span of moving chain across its line.

        w_k = k pi (c^2 - V^2)/(c l),   c^2 = T/m

    Args:
        span: l, between sprockets or supports [m].
        tension: T, whole tension, the centrifugal part m V^2 included [N].
        line_mass: m, of the chain [kg/m].
        chain_speed: V [m/s].
        order: k.

    Returns:
        w_k; 0 from V = c on, where the span has no stiffness left [rad/s].

    **Range** a taut span of even tension, its links short against it.
    **Error** exact for a string that moves along itself; the sag of the slack strand raises the first one.
    **Source** R. D. Swope, W. F. Ames, "Vibrations of a moving threadline", J. Franklin Inst. 275 (1963).
    """
    wave = np.sqrt(np.asarray(tension, float) / line_mass)
    return np.asarray(order * np.pi / span * np.maximum((wave - chain_speed) * (1 + chain_speed / wave), 0.0))
