"""The exponential step of m v' + Z v = g(t), for g a polynomial over a panel of steps, and many steps at once."""

import math
from functools import cache, cached_property

import numpy as np

from ptmcalc.numerics.collocation import gauss
from ptmcalc.numerics.loop import FloatArray

_STRETCH, _AT_ONCE = 32, 128
_GAUSS, _FADED = 32, 40.0


class ExponentialStep:
    """m v' + Z v = g(t) by the exponential step for g a polynomial through the samples of a panel of steps."""

    def __init__(self, mass: float, impedance: float, step: float, panel: int = 1) -> None:
        self.impedance = impedance
        self.rate = impedance / mass if mass > 0 else math.inf
        self.full = weights(self.rate * step)
        self.step_size = step
        self.panel = panel
        fading = self.full[0] ** np.arange(1, panel + 1)
        self.kernel = np.concatenate([panel_weights(self.rate * step, panel).T / impedance, fading[None]])
        self.ends = Fading(float(fading[-1]))
        self.speed = 0.0
        self.forcing = 0.0

    def block(self, forcing: FloatArray) -> FloatArray:
        """Speeds at the samples after the present one, at which the forcing is given: whole panels of them."""
        if math.isinf(self.rate):
            speeds = forcing / self.impedance
            self.go_on(float(speeds[-1]), float(forcing[-1]))
            return speeds
        panels = forcing.reshape(-1, self.panel)
        inputs = np.empty((len(panels), self.panel + 2))  # of each: forcing at start and samples, speed at the start
        inputs[:, 1:-1] = panels
        inputs[0, 0], inputs[1:, 0] = self.forcing, panels[:-1, -1]
        ends = self.ends.run(self.speed, inputs[:, :-1] @ self.kernel[:-1, -1])
        inputs[0, -1], inputs[1:, -1] = self.speed, ends[:-1]
        self.go_on(float(ends[-1]), float(forcing[-1]))
        return np.asarray((inputs @ self.kernel).ravel())

    def go_on(self, speed: float, forcing: float) -> None:
        """Take this as the present sample."""
        self.speed, self.forcing = speed, forcing

    def part(self, speed: float, before: float, after: float, share: float) -> float:
        """Speed after a share of a step from `speed`, with the forcing going from `before` to `after`."""
        decay, old, new = weights(self.rate * self.step_size * share)
        return decay * speed + (old * before + new * after) / self.impedance


def weights(x: float) -> tuple[float, float, float]:
    """exp(-x) and the weights of the forcing at the start and the end of a step of x time constants."""
    if math.isinf(x):
        return 0.0, 0.0, 1.0
    grown = -math.expm1(-x)
    slope = x / 2 - x * x / 6 + x**3 / 24 - x**4 / 120 if x < 1e-3 else 1 - grown / x
    return math.exp(-x), grown - slope, slope


class Fading:
    """y_k = d y_(k-1) + u_k for many k at once: a convolution with the powers of d; for very many the same powers over
    stretches, and from one of these to the next the same rule with the power of d over a whole one."""

    def __init__(self, decay: float) -> None:
        self.powers = decay ** np.arange(_AT_ONCE + 1.0)
        self.fading = self.powers[1 : _STRETCH + 1]
        self.decay = decay
        self.longer: Fading | None = None

    @cached_property
    def within(self) -> FloatArray:
        """What is given at one place of a stretch, at each of them."""
        ahead = np.concatenate([np.zeros(_STRETCH - 1), self.powers[:_STRETCH]])
        return np.lib.stride_tricks.sliding_window_view(ahead, _STRETCH)[::-1].copy()

    def run(self, start: float, given: FloatArray) -> FloatArray:
        """y_1 ... y_n from y_0 = `start`."""
        n = len(given)
        if n <= _AT_ONCE:
            return np.convolve(np.concatenate([[start], given]), self.powers[: n + 1])[1 : n + 1]
        whole = -(-n // _STRETCH)
        padded = np.zeros((whole, _STRETCH))
        padded.ravel()[:n] = given
        if self.longer is None:
            self.longer = Fading(float(self.fading[-1]))
        found: FloatArray = padded @ self.within
        starts = np.empty(whole)
        starts[0], starts[1:] = start, self.longer.run(start, found[:-1, -1])
        found += starts[:, None] * self.fading
        return np.asarray(found.ravel()[:n])


def _lagrange(count: int, x: FloatArray) -> list[FloatArray]:
    """The polynomials that are 1 at one of the nodes 0 ... count and 0 at the others, at x."""
    found = [np.full_like(x, (-1.0) ** count / math.factorial(count))]
    for k in range(1, count + 1):
        found.append(found[-1] * ((x - (k - 1)) * ((k - 1 - count) / k)))
    above = np.ones_like(x)
    for k in range(count, -1, -1):
        found[k] *= above
        above *= x - k
    return found


@cache
def panel_weights(x: float, panel: int) -> FloatArray:
    """Weights of the forcing at the nodes of a panel, of steps of x time constants, on the answer after every step:
    shape (panel, panel + 1).

        W_ij = int_0^i x e^(-x (i - s)) l_j(s) ds

    with l_j the polynomials of Lagrange: exact for a forcing that is one of so high a degree.
    """
    if panel == 1:
        return np.array([weights(x)[1:]])
    nodes, shares = gauss(_GAUSS)
    reach = min(_FADED / x, 1.0)  # before that, nothing is left of the forcing at the end of the step
    sharp = min(x, _FADED)
    starts = np.arange(panel)[:, None]
    inputs = np.array(_lagrange(panel, starts + 1 - reach * nodes))
    steps: FloatArray = np.einsum("jiq,q->ij", inputs, shares * sharp * np.exp(-sharp * nodes))
    for i in range(1, panel):
        steps[i] += math.exp(-x) * steps[i - 1]
    steps.setflags(write=False)
    return steps
