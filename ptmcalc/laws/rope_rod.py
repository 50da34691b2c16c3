"""A hoisting rope with mass of its own: its frequencies, the wave of a snatch, and what hauling it in does to a swing.

The rope is a rod fixed at the drum with the load at its lower end. Stiffness K = E A/l and rope mass m_r are those at
the hook: of a reeved rope m_r is the mass of the falls.
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]

_STEPS = 60
_HALVINGS = 1200
_EPS = float(np.finfo(float).eps)
_FAR = 30.0
"""Argument of a Bessel function from which its asymptotic series has all digits."""
_TERMS = 60
"""Terms of a Taylor series over at most half its radius of convergence."""


def rod_root(mass_ratio: float, mode: int) -> float:
    """Root of the frequency equation of a rod with a mass at its end.

        B tan(B) = r,   (k - 1) pi < B < (k - 1) pi + pi/2

    Args:
        mass_ratio: r = m_r/M, rope mass over load [1].
        mode: k, 1 for the lowest.

    Returns:
        B; 0 in the first mode of a rope without mass [1].

    **Range** r >= 0.
    **Error** rounding: B sin(B) - r cos(B) rises between the bounds, so Newton's method kept inside them cannot miss.
    **Source** S. Timoshenko, Vibration problems in engineering: longitudinal vibration of a bar with a loaded end.
    """
    base = (mode - 1) * math.pi
    if mass_ratio == 0:
        return base
    low, high = 0.0, math.pi / 2
    x = math.sqrt(mass_ratio / (1 + mass_ratio * (4 / math.pi**2))) if mode == 1 else math.atan(mass_ratio / base)
    for _ in range(_STEPS):
        sine, cosine = math.sin(x), math.cos(x)
        value = (base + x) * sine - mass_ratio * cosine
        low, high = (x, high) if value < 0 else (low, x)
        step = value / ((1 + mass_ratio) * sine + (base + x) * cosine)
        following = x - step if low < x - step < high else (low + high) / 2
        if abs(following - x) <= 2 * _EPS * (base + x):
            break
        x = following
    return base + x


def rod_frequency(stiffness: float, rope_mass: float, load_mass: float, mode: int) -> float:
    """Natural frequency of a load on a rope with mass.

        w = B (K/m_r)^(1/2),   B tan(B) = m_r/M

    Args:
        stiffness: K [N/m].
        rope_mass: m_r, of the hanging rope [kg].
        load_mass: M [kg].
        mode: k, 1 for the lowest.

    Returns:
        w; of a rope without mass (K/M)^(1/2), higher modes infinite [rad/s].

    **Range** a uniform taut rope held at the drum, m_r >= 0, M > 0.
    **Error** exact for that model.
    **Source** as `rod_root`.
    """
    ratio = rope_mass / load_mass
    if mode > 1:
        return rod_root(ratio, mode) * math.sqrt(stiffness / rope_mass) if rope_mass > 0 else math.inf
    share = rod_root(ratio, 1) / math.sqrt(ratio) if ratio > 0 else 1.0
    return share * math.sqrt(stiffness / load_mass)


def free_rod_root(drive_ratio: float, load_ratio: float) -> float:
    """First root of the frequency equation of a rod with a mass at either end, travel left out.

        B = atan(1/(a B)) + atan(1/(b B)),   0 < B <= pi

    Args:
        drive_ratio: a = m_1/m_r, drive mass over rope mass [1].
        load_ratio: b = M/m_r, load over rope mass [1].

    Returns:
        B; pi for a rope without masses at its ends [1].

    **Range** a, b >= 0, not both infinite.
    **Error** rounding: the two sides cross once, and no term is lost beside another.
    **Source** derived: cos(B x/l + alpha) with tan(alpha) = a B at the drive, tan(B + alpha) = -b B at the load; for
    a infinite `rod_root`.
    """
    low, high = 0.0, math.pi
    x = min(math.sqrt(1 / drive_ratio + 1 / load_ratio), high) if drive_ratio > 0 and load_ratio > 0 else high
    for _ in range(_STEPS):
        value, slope = x, 1.0
        for ratio in (drive_ratio, load_ratio):
            value -= math.atan2(1.0, ratio * x)
            slope += ratio / (1 + (ratio * x) ** 2)
        low, high = (x, high) if value < 0 else (low, x)
        following = x - value / slope if low < x - value / slope < high else (low + high) / 2
        if abs(following - x) <= 2 * _EPS * x:
            break
        x = following
    return x


def free_rod_frequency(stiffness: float, rope_mass: float, drive_mass: float, load_mass: float) -> float:
    """Lowest natural frequency of drive and load on a rope with mass.

        w = B (K/m_r)^(1/2),   B = atan(m_r/(m_1 B)) + atan(m_r/(M B))

    Args:
        stiffness: K [N/m].
        rope_mass: m_r, of the hanging rope [kg].
        drive_mass: m_1, at the hook [kg].
        load_mass: M [kg].

    Returns:
        w; of a rope without mass (K/m_1 + K/M)^(1/2) [rad/s].

    **Range** a uniform taut rope between two masses that are free, m_r >= 0.
    **Error** exact for that model.
    **Source** as `free_rod_root`.
    """
    light = math.sqrt(stiffness / drive_mass + stiffness / load_mass)
    if rope_mass == 0:
        return light
    root = free_rod_root(drive_mass / rope_mass, load_mass / rope_mass)
    return root / math.sqrt(rope_mass / drive_mass + rope_mass / load_mass) * light


def framed_rod_frequency(
    stiffness: float,
    rope_mass: float,
    drive_mass: float,
    load_mass: float,
    structure_stiffness: float,
    structure_mass: float,
) -> float:
    """Lowest natural frequency of drive and load on a rope with mass, the drum on a structure that gives.

        w (m_r/K)^(1/2) = atan(Z/(M w)) + atan(Z w (1/(m_1 w^2) - 1/(K_b - m_b w^2))),   Z = (K m_r)^(1/2)

    Args:
        stiffness: K [N/m].
        rope_mass: m_r, of the hanging rope [kg].
        drive_mass: m_1, at the hook [kg].
        load_mass: M [kg].
        structure_stiffness: K_b, infinite where it stands fast [N/m].
        structure_mass: m_b, that moves with the drum, 0 for a spring alone [kg].

    Returns:
        w [rad/s].

    **Range** a uniform taut rope, m_r >= 0, a drive that is free, a structure of one mode.
    **Error** rounding: the left side rises and the right one falls up to (K_b/m_b)^(1/2), so they cross there once.
    **Source** derived: cos(k (l - x) - phi) with the compliance of drive and structure at its top; for K_b infinite
    `free_rod_frequency`.
    """
    share = math.sqrt(rope_mass / load_mass)
    frame, beside = structure_stiffness / stiffness, structure_mass / load_mass

    def angle(value: float) -> float:
        return math.atan(share * value) / share if share > 0 else value

    def short(x: float) -> bool:
        gives = x / (frame - beside * x * x)
        return x - angle(1 / x) < angle(load_mass / drive_mass / x - gives)

    low, high = 0.0, math.sqrt(frame / beside) if beside > 0 and math.isfinite(frame) else 1.0
    while not (beside > 0 and math.isfinite(frame)) and short(high):
        low, high = high, 2 * high
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        if not low < middle < high:
            break
        low, high = (middle, high) if short(middle) else (low, middle)
    return high * math.sqrt(stiffness / load_mass)


def third_mass_frequency(stiffness: float, rope_mass: float, load_mass: float) -> float:
    """Lowest natural frequency with a third of the rope's mass added to the load.

        w = (K/(M + m_r/3))^(1/2)

    Args:
        stiffness: K [N/m].
        rope_mass: m_r, of the hanging rope [kg].
        load_mass: M [kg].

    Returns:
        w [rad/s].

    **Range** as `rod_frequency`.
    **Error** never too low (Rayleigh's quotient of a straight line); too high by at most the share (m_r/M)^2/90, the
    first term left out: 0.1 % at 0.3, and by 10 % for a rope without load.
    **Source** Lord Rayleigh, The theory of sound; the error from B^2 = r - r^2/3 + 4 r^3/45 - ...
    """
    return math.sqrt(stiffness / (load_mass + rope_mass / 3))


def snatch_wave_force(speed: ArrayLike, stiffness: float, rope_mass: float) -> FloatArray:
    """Force in a rope the moment one of its ends gets a speed: it is there before the other end knows.

        F = v (E A mu)^(1/2) = v (K m_r)^(1/2)

    Args:
        speed: v, by which the end departs from the rope [m/s].
        stiffness: K [N/m].
        rope_mass: m_r [kg].

    Returns:
        F; doubled as the wave meets a load that does not move [N].

    **Range** until the first wave has run along the rope, l (mu/(E A))^(1/2).
    **Error** exact for a uniform rope.
    **Source** impedance of a rod, `wave.impedance`.
    """
    return np.asarray(np.asarray(speed, float) * (math.sqrt(stiffness) * math.sqrt(rope_mass)))


def hauling_gain(length: ArrayLike, shorter: ArrayLike) -> FloatArray:
    """Growth of a swing of the rope force while the rope is hauled in.

        F_1/F_0 = (l_0/l_1)^(1/4)

    The drum's rim takes up strained rope at a constant speed V. Strain and length then obey

        e'' - (V/l) e' + (E A/(M l)) e = g/l,   l' = -V

    whose middle term is of the size of the effect: without it the gain would be (l_0/l_1)^(3/4).

    Args:
        length: l_0, at the start [m].
        shorter: l_1, at the end [m].

    Returns:
        gain of the amplitude, for any speed that is slow against the swing [1].

    **Range** no slip on the drum, no damping, massless rope; x = 2 (E A l_1/M)^(1/2)/V well above 1.
    **Error** the share 1/(2 x) of the amplitude read as (e^2 + (e'/w)^2)^(1/2), 1/(8 x^2) of its envelope.
    **Source** derived: adiabatic limit of `hauled_strain`.
    """
    return np.asarray(np.sqrt(np.sqrt(np.asarray(length, float) / np.asarray(shorter, float))))


def paying_out_gain(length: ArrayLike, longer: ArrayLike) -> FloatArray:
    """Change of a swing of the rope force while the rope is paid out.

        F_1/F_0 = (l_0/l_1)^(3/4)

    The drum feeds rope of a strain frozen in when it was wound: the stretch q obeys q'' + (E A/(M l)) q = 0.

    Args:
        length: l_0, at the start [m].
        longer: l_1, at the end [m].

    Returns:
        gain of the amplitude, below 1 as the rope gets longer [1].

    **Range** as `hauling_gain`, l' = V.
    **Error** the share 1/(2 x) of the amplitude, x = 2 (E A l_0/M)^(1/2)/V.
    **Source** derived: action of a slowly changing oscillator, q^2 w constant with w as l^(-1/2), force as q/l.
    """
    return np.asarray((np.asarray(length, float) / np.asarray(longer, float)) ** 0.75)


def hauled_strain(
    stiffness: float, mass: float, speed: float, length: float, shorter: float, strain: float, rate: float
) -> tuple[float, float]:
    """Dynamic strain of a rope that is hauled in, and its rate.

        e = C_0(x),  x = 2 (E A l/M)^(1/2)/V      C_0 a Bessel function of order 0

    Args:
        stiffness: E A [N].
        mass: M, of the load [kg].
        speed: V, of the drum's rim [m/s].
        length: l_0, of the hanging rope at the start [m].
        shorter: l_1, at the end [m].
        strain: e_0, beside that of the weight [1].
        rate: e_0', at the start [1/s].

    Returns:
        (e [1], e' [1/s]) at l_1.

    **Range** no slip on the drum, no damping, massless rope that stays taut, V > 0, 0 < l_1 <= l_0.
    **Error** rounding of the phase x_0 - x_1, 1e-16 of it; the asymptotic series above x = 30 and the Taylor series
    below it have all digits.
    **Source** derived: `hauling_gain`; with x for the time the equation is that of Bessel. H. Hankel's series:
    Abramowitz and Stegun, Handbook of mathematical functions, 9.2.5.
    """
    scale = 2 * math.sqrt(stiffness / mass) / speed
    first, last = scale * math.sqrt(length), scale * math.sqrt(shorter)
    slope = scale * speed / (2 * math.sqrt(length))  # -dx/dt
    y, dy = strain, -rate / slope
    if first > _FAR:
        reached = max(shorter, (_FAR / scale) ** 2)
        turn = scale * ((length - reached) / (math.sqrt(length) + math.sqrt(reached)))
        y, dy = _far(first, max(last, _FAR), turn, y, dy)
        first = max(last, _FAR)
    while first > last:
        step = min(first - last, 1.0, first / 2)
        y, dy = _taylor(first, -step, y, dy)
        first = last if first - last <= step else first - step
    return y, -dy * scale * speed / (2 * math.sqrt(shorter))


def _far(first: float, last: float, turn: float, y: float, dy: float) -> tuple[float, float]:
    """C_0 and its derivative carried from one large argument to another, `turn` apart, by Hankel's functions."""
    (p, dp), (q, dq) = _hankel(first), _hankel(last)
    # h = p exp(i x): y = Re(a h), y' = Re(a h'); h conj(h') - h' conj(h) = -2 i/x
    a = complex(0, -1) * first * (y * dp.conjugate() - dy * p.conjugate())
    spin = complex(math.cos(turn), -math.sin(turn))
    return -(a * q * spin).real, -(a * dq * spin).real


def _hankel(x: float) -> tuple[complex, complex]:
    """x^(-1/2) sum of Hankel's series of order 0 and its derivative, without exp(i x)."""
    term, total, slope = complex(1.0), complex(1.0), complex(0.0)
    for k in range(1, _TERMS):
        term *= complex(0, -1) * (2 * k - 1) ** 2 / (8 * k * x)
        total, slope = total + term, slope - k * term / x
        if abs(term) <= _EPS / 8:
            break
    root = 1 / math.sqrt(x)
    return total * root, (slope + total * (complex(0, 1) - 1 / (2 * x))) * root


def _taylor(x: float, step: float, y: float, dy: float) -> tuple[float, float]:
    """A step of x y'' + y' + x y = 0 by its Taylor series, at most half way to the singular point 0."""
    share = step / x
    before, a, b = 0.0, y, dy * step  # coefficients times powers of the step
    value, slope = a + b, b
    for k in range(_TERMS):
        c = -((k + 1) ** 2 * share * b + step**2 * (a + share * before)) / ((k + 2) * (k + 1))
        value, slope = value + c, slope + (k + 2) * c
        before, a, b = a, b, c
    return value, slope / step
