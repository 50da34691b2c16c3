"""A torque step on a two-strand loop with gravity take-up as a sum over echoes: closed form, no grid, no modes.

Imports nothing from `ptmcalc`. In the Laplace domain the tail without mass answers an incoming tension wave with
A(s) = r e^{-2 t1 s} - (1 - r^2) e^{-2 (t1 + t2) s} sum_k (r e^{-2 t2 s})^k and the drum with K(s) = (s - a)/(s + a),
a = Z1/m, so that the wave leaving the drum is P = 2 F a/(s (s + a)) sum_j (K A)^j. Every term is a delay times
(s - a)^j/(s (s + a)^{j+1}), whose inverse is 1 - e^{-x} L with Laguerre-like polynomials, evaluated by recursion.
"""

from math import comb

import numpy as np


def _base(order: int, a: float, t: np.ndarray) -> np.ndarray:
    """Inverse transform of a (s - a)^n/(s (s + a)^{n+1}) for n = order, by partial fractions in s/(s + a).

    a (s-a)^n/(s (s+a)^{n+1}): residue (-1)^n at 0; the rest is e^{-at} times a polynomial in t, from
    (s - a)^n = ((s + a) - 2a)^n expanded about s = -a.
    """
    x = a * np.maximum(t, 0.0)
    # with u = s + a: a (u - 2a)^n/((u - a) u^{n+1}); expand (u-2a)^n/(u-a) = q(u) + (-a)^n/(u - a)
    # coefficients of the Taylor series of (u-2a)^n/(u-a) about u = 0 up to u^n, in units of a
    series = [0.0] * (order + 1)
    for k in range(order + 1):
        # (u-2)^n = sum_i comb(n,i) u^i (-2)^(n-i);  1/(u-1) = -sum u^j
        series[k] = -sum(comb(order, i) * (-2.0) ** (order - i) for i in range(k + 1))
    total = np.full_like(x, (-1.0) ** order)
    term = np.exp(-x)
    power = np.ones_like(x)
    factorial = 1.0
    for p in range(order + 1):  # u^{-(p+1)} -> t^p/p! e^{-at}; its coefficient is series[n-p]
        if p:
            power = power * x
            factorial *= p
        total = total + series[order - p] * power / factorial * term
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
        for delay, coefficient in power.items():
            for extra, gain in tail.items():
                if delay + extra <= horizon:
                    key = round(delay + extra, 12)
                    grown[key] = grown.get(key, 0.0) + coefficient * gain
        power = grown
        j += 1
    return out
