"""Speeds at which a tooth harmonic meets a natural frequency of a chain, and the speeds between that are safe.

The n-th harmonic of the tooth frequency V/p meets the k-th natural frequency f_k at V = p f_k/n. The frequencies of the
two strands come from `belt_modes.natural_frequencies` with the speed imposed.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ptmcalc.laws.loop_bounds import LoopMasses, tension_green

FloatArray = NDArray[np.float64]

QUARTER_WAVE, HALF_WAVE, FULL_WAVE = "quarter", "half", "full"
_EPS = float(np.finfo(float).eps)
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
    shape = _shape(loop, w)
    share = (shape.on - shape.off) / w / shape.mass
    return np.asarray(share * (shape.on / w)), np.asarray(share * (shape.off / w))


def start_shares(loop: LoopMasses, frequencies: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Parts of a step of rim force with which the modes of a chain and its drive swing at run-on and run-off.

        c_on = u_d N_1/(G w),   c_off = u_d N_0/(G w)

    u_d is the amplitude of the drive, N w that of the force at run-off (0) and run-on (1), G the generalised mass with
    the drive in it. A step F makes the tension F sum c_k (1 - cos(w_k t)), damped as in `chain_start.start_series`.
    Over all modes c_on and c_off sum up to the quasi-static tensions over F; c_on - c_off is never negative, and with a
    constant tension at the run-off the tension stays between 0 and twice its quasi-static value.

    Args:
        loop: the loop, torque imposed.
        frequencies: w, natural circular frequencies of `belt_modes.natural_frequencies` without a take-up mass, shape
            (k,) [rad/s].

    Returns:
        (c_on [1], c_off [1]), shape (k,); c_off is 0 with a constant tension at the run-off.

    **Range** undamped linear strands, take-up beside the drive, without mass; above 0 in w: the rigid motion has no
    dynamic tension of its own.
    **Error** rounding of the frequencies.
    **Source** derived: modes of two strands in series and a mass, integral of their squares in closed form.
    """
    w = np.asarray(frequencies, float)
    shape = _shape(loop, w)
    share = shape.drive / w / (shape.mass + loop.drive_mass * shape.drive**2)
    return np.asarray(share * shape.on), np.asarray(share * shape.off)


def drive_mobilities(loop: LoopMasses, frequencies: FloatArray) -> tuple[FloatArray, float]:
    """Shares of the modes of a chain and its drive in the motion of the drive under a force at the sprocket.

        g_k = u_d^2/G,   sum over all modes = 1/m - 1/M

    u_d is the amplitude of the drive, G the generalised mass with the drive, m its mass and M all masses. A force F at
    the sprocket accelerates the drive by F/M + sum g_k y_k'', with y_k'' + 2 zeta w y_k' + w^2 y_k = F.

    Args:
        loop: the loop, torque imposed.
        frequencies: w, of the lowest modes, as in `modal_tensions`, shape (k,) [rad/s].

    Returns:
        g_k, shape (k,), and the sum of those of all other modes [1/kg].

    **Range** as `modal_tensions`.
    **Error** rounding of the frequencies.
    **Source** derived: completeness of the modes at the drive.
    """
    shape = _shape(loop, np.asarray(frequencies, float))
    shares = shape.drive**2 / (shape.mass + loop.drive_mass * shape.drive**2)
    whole = loop.belt_mass / loop.drive_mass / loop.total_mass
    return np.asarray(shares), max(whole - float(shares.sum()), 0.0)


def modal_tensions(loop: LoopMasses, frequencies: FloatArray, strand: int, x: FloatArray) -> FloatArray:
    """Parts of the tension at sections of a chain with which its modes follow an acceleration.

        M_k(s) = A_k B_k(s),   speed imposed: A_k = (N_1 - N_0)/(w G^(1/2))     torque imposed: A_k = M u_d/G^(1/2)
        B_k(s) = N_s/(w G^(1/2))

    N_s w is the force amplitude of the mode at the section, at run-off (0) and run-on (1), G its generalised mass, with
    the drive where the torque is imposed, u_d the amplitude of the drive and M all masses. A rigid-body acceleration
    a, F/M for a rim force F, makes the tension a sum M_k where every mode follows at once; over all modes the M_k sum
    up to `loop_bounds.quasi_static`.

    Args:
        loop: the loop, its speed or its torque imposed.
        frequencies: w, natural circular frequencies of `belt_modes.natural_frequencies` without a take-up mass, shape
            (k,) [rad/s].
        strand: RETURN or CARRY.
        x: fractions of the strand's length, shape (n,) [1].

    Returns:
        M_k, shape (k, n) [kg].

    **Range** undamped linear strands, take-up beside the drive, without mass.
    **Error** rounding of the frequencies.
    **Source** derived: modes of two strands in series, integral of their squares in closed form.
    """
    moved, felt = _moved_and_felt(loop, np.asarray(frequencies, float), strand, np.asarray(x, float))
    return np.asarray(moved[:, None] * felt)


def modal_shapes(loop: LoopMasses, frequencies: FloatArray, strand: int, x: FloatArray) -> FloatArray:
    """Tensions that modes have at sections of a chain, as masses.

        B_k(s) = N_s/(w G^(1/2)) M_belt^(1/2)

    An end of the chain that moves ahead by a polygon's acceleration a_p against the drive makes the tension at a
    section B_k(s) B_k(on) a_p/M_belt at the run-on, - B_k(s) B_k(off) a_p/M_belt at the run-off, in the mode that
    follows at once; a rigid-body acceleration a makes it B_k(s) (B_k(on) - B_k(off)) c a/M_belt, c = 1 with the speed
    imposed and M/m with the torque: the M_k of `modal_tensions`.

    Args:
        loop: the loop, its speed or its torque imposed.
        frequencies: w, as in `modal_tensions`, shape (k,) [rad/s].
        strand: RETURN or CARRY.
        x: fractions of the strand's length, shape (n,) [1].

    Returns:
        B_k, shape (k, n) [kg].

    **Range** as `modal_tensions`.
    **Error** rounding of the frequencies.
    **Source** derived: work of a dislocation between the chain and its drive.
    """
    _, felt = _moved_and_felt(loop, np.asarray(frequencies, float), strand, np.asarray(x, float))
    return np.asarray(felt * math.sqrt(loop.belt_mass))


def modal_rest(loop: LoopMasses, frequencies: FloatArray, strand: int, x: FloatArray) -> FloatArray:
    """Most that the parts of all modes left out of `modal_tensions` can add up to, whatever their signs.

        sum_(k>K) |M_k(s)| <= ((A - sum_(k<=K) A_k^2)(G_s - sum_(k<=K) B_k(s)^2))^(1/2)
        speed imposed: A = M_belt      torque imposed: A = M M_belt/m

    Args:
        loop: the loop; the drive has a mass m where the torque is imposed.
        frequencies: w, of the modes taken, the lowest K, shape (k,) [rad/s].
        strand: RETURN or CARRY.
        x: fractions of the strand's length, shape (n,) [1].

    Returns:
        the bound, shape (n,) [kg].

    **Range** as `modal_tensions`.
    **Error** a bound; exact at the run-on with a constant tension at the run-off, where no mode has another sign.
    **Source** derived: sums over all modes known from completeness and from `loop_bounds.tension_green`; Cauchy and
    Schwarz.
    """
    places = np.asarray(x, float)
    moved, felt = _moved_and_felt(loop, np.asarray(frequencies, float), strand, places)
    whole = loop.belt_mass
    if not loop.imposed_speed:
        whole *= loop.total_mass / loop.drive_mass
    green = tension_green(loop, strand, places)
    left = np.maximum(whole - np.sum(moved**2), 8 * _EPS * whole)
    return np.asarray(np.sqrt(left * np.maximum(green - np.sum(felt**2, axis=0), 8 * _EPS * green)))


def _moved_and_felt(loop: LoopMasses, w: FloatArray, strand: int, x: FloatArray) -> tuple[FloatArray, FloatArray]:
    """A_k, shape (k,), and B_k, shape (k, n), of `modal_tensions`."""
    shape = _shape(loop, w)
    root = np.sqrt(shape.mass if loop.imposed_speed else shape.mass + loop.drive_mass * shape.drive**2)
    moved = (shape.on - shape.off) / w / root if loop.imposed_speed else loop.total_mass * shape.drive / root
    impedance, transit, (a, b) = shape.strands[strand]
    angle = (w * transit)[:, None] * x
    return moved, impedance * (b[:, None] * np.cos(angle) - a[:, None] * np.sin(angle)) / (w * root)[:, None]


@dataclass(frozen=True, slots=True)
class _Shape:
    """Of modes: amplitude of the drive, force over w at run-on and run-off, generalised mass without the drive; and of
    each strand its impedance, its travel time and (a, b) of its displacement a cos + b sin."""

    drive: FloatArray
    on: FloatArray
    off: FloatArray
    mass: FloatArray
    strands: tuple[tuple[float, float, tuple[FloatArray, FloatArray]], ...]


def _shape(loop: LoopMasses, w: FloatArray) -> _Shape:
    """Two strands in series from the run-off on: u = a cos + b sin along each."""
    t1 = math.sqrt(loop.carry_mass) * math.sqrt(loop.carry_compliance)
    t2 = math.sqrt(loop.return_mass) * math.sqrt(loop.return_compliance)
    z1 = math.sqrt(loop.carry_mass) / math.sqrt(loop.carry_compliance)
    z2 = math.sqrt(loop.return_mass) / math.sqrt(loop.return_compliance)
    s1, c1, s2, c2 = np.sin(w * t1), np.cos(w * t1), np.sin(w * t2), np.cos(w * t2)
    held = loop.tail_mass * w
    if not loop.fixed_length:
        a, b = np.ones_like(w), np.zeros_like(w)
    elif loop.imposed_speed:
        a, b = np.zeros_like(w), np.ones_like(w)
    else:  # closed at the drive: what a and b bring to the run-on is a again
        from_a = c1 * c2 - (z2 * s2 + held * c2) * s1 / z1
        from_b = c1 * s2 + (z2 * c2 - held * s2) * s1 / z1
        a, b = from_b, 1 - from_a
    tail = a * c2 + b * s2
    swing = (z2 * (b * c2 - a * s2) - held * tail) / z1
    mass = _swinging(loop.return_mass, a, b, w * t2) + loop.tail_mass * tail**2
    mass = mass + _swinging(loop.carry_mass, tail, swing, w * t1)
    strands = (z2, t2, (a, b)), (z1, t1, (tail, swing))
    return _Shape(tail * c1 + swing * s1, z1 * (swing * c1 - tail * s1), z2 * b, mass, strands)


def _swinging(mass: float, a: FloatArray, b: FloatArray, angle: FloatArray) -> FloatArray:
    """Generalised mass of a strand of this mass that swings as a cos + b sin."""
    even, cross = np.sinc(2 * angle / np.pi), np.sin(angle) * np.sinc(angle / np.pi)
    return np.asarray(mass * ((a**2 + b**2) / 2 + (a**2 - b**2) / 2 * even + a * b * cross))


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
