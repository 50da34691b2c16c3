"""A torque step on a two-strand loop with gravity take-up as a sum over echoes: closed form, no grid, no modes.

Imports nothing from `ptmcalc`. In the Laplace domain the tail without mass answers an incoming tension wave with
A(s) = r e^{-2 t1 s} - (1 - r^2) e^{-2 (t1 + t2) s} sum_k (r e^{-2 t2 s})^k and the drum with K(s) = (s - a)/(s + a),
a = Z1/m, so that the wave leaving the drum is P = 2 F a/(s (s + a)) sum_j (K A)^j. Every term is a delay times
(s - a)^j/(s (s + a)^{j+1}), whose inverse is 1 - e^{-x} L with Laguerre-like polynomials, evaluated by recursion.
"""

import numpy as np


def _base(order: int, a: float, t: np.ndarray) -> np.ndarray:
    """Inverse transform of a (s - a)^n/(s (s + a)^{n+1}) for n = order.

    That of (s - a)^n/(s + a)^{n+1} is the Laguerre function f_n = e^{-at} L_n(2at). As a/(s (s + a)) = 1/s - 1/(s + a),
    the sought one is h_n - f_n, h_n that of (s - a)^n/(s (s + a)^n): h_0 = 1, h_{n+1} = 2 f_n - h_n. Nothing cancels.
    """
    x = a * np.maximum(t, 0.0)
    before, now, held = np.zeros_like(x), np.exp(-x), np.ones_like(x)
    for n in range(order):
        held = 2 * now - held
        before, now = now, ((2 * n + 1 - 2 * x) * now - n * before) / (n + 1)
    total = held - now
    return np.where(t >= 0, total, 0.0)


def run_on(
    force: float, z: tuple[float, float], mass: float, transit: tuple[float, float], t: np.ndarray
) -> np.ndarray:
    """Dynamic run-on tension at times t: half the sum of the wave leaving the drum and the one arriving."""
    a = z[0] / mass
    r = (z[1] - z[0]) / (z[0] + z[1])
    t1, t2 = transit
    horizon = float(np.max(t))
    # words: (number of passes j, delay) -> coefficient of A^j
    tail = {2 * t1: r}
    k = 0
    while 2 * (t1 + t2) + 2 * t2 * k <= horizon:
        delay = 2 * (t1 + t2) + 2 * t2 * k
        tail[delay] = tail.get(delay, 0.0) - (1 - r * r) * r**k
        k += 1
    out = np.zeros_like(t)
    power = {0.0: 1.0}
    j = 0
    while power:
        for delay, coefficient in power.items():
            wave = 2 * force * coefficient * _base(j, a, t - delay)
            out = out + wave / 2
            for extra, gain in tail.items():
                out = out + gain * (2 * force * coefficient * _base(j, a, t - delay - extra)) / 2
        grown: dict[float, float] = {}
        kept: dict[float, float] = {}  # sums of the same delays differ by rounding
        for delay, coefficient in power.items():
            for extra, gain in tail.items():
                if delay + extra <= horizon:
                    key = kept.setdefault(round(delay + extra, 9), delay + extra)
                    grown[key] = grown.get(key, 0.0) + coefficient * gain
        power = grown
        j += 1
    return out
