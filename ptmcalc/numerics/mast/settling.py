"""When a free vibration stays inside a window for good: its last time outside, found from the back.

    x(t) = Re sum_k c_k e^(lambda_k t),   lambda_k = -zeta_k w_k + i w_k sqrt(1 - zeta_k^2)

After the time at which the envelopes sum |c_k| e^(-sigma_k t) fit into the window nothing leaves it. Before, stretches
of time are taken from the last one on: one is passed over where no point of it can be outside,

    |x| <= |x(m)| + sum_k d_k,   d_k = min(|c_k| e^(-sigma_k a) |lambda_k| h/2, |c_k| e^(-sigma_k a) + |x_k(m)|)

with the middle m of a stretch of half the length h/2 from a on, and for the parts slower than the stretch by the
tangent and the curvature; else it is halved. No samples: the answer lies between two numbers that are proven.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.mast.parts import FloatArray

_EPS = float(np.finfo(float).eps)
_FINEST = 1e-13
"""Share of the whole time below which a stretch is no longer halved."""
_MOST = 20_000
_DOUBLINGS = 400
_SLOW = 1.0
_BISECTIONS = 50
_TOLD = 0.1
"""Share of the room beside the lean that rounding may take before swings are no longer told apart."""


@dataclass(frozen=True, slots=True)
class Ring:
    """A free vibration from time 0 on: amplitudes c_k and rates lambda_k, shape (k,), complex; none of them grows."""

    amplitudes: NDArray[np.complex128]
    rates: NDArray[np.complex128]

    @classmethod
    def of(cls, gains: FloatArray, w: FloatArray, ratios: FloatArray, q: FloatArray, rates: FloatArray) -> "Ring":
        """sum gains_k q_k of modes with the frequencies w, the damping ratios below 1, and such a state."""
        turning = w * np.sqrt(1 - ratios**2)
        sine = (rates + ratios * w * q) / turning
        return cls(np.asarray(gains * (q - 1j * sine), complex), np.asarray(-ratios * w + 1j * turning, complex))

    def at(self, time: float) -> float:
        """x."""
        return float((self.amplitudes * np.exp(self.rates * time)).real.sum())

    def envelope(self, time: float) -> float:
        """What |x| never exceeds from a time on."""
        return float(np.abs(self.amplitudes) @ np.exp(self.rates.real * time))


@dataclass(frozen=True, slots=True)
class Settled:
    """The first time after which a vibration stays inside a window: infinite where it never does, with the reason."""

    time: float
    low: float
    high: float
    reason: str = ""


def settling(ring: Ring, window: float, lean: float = 0.0, doubt: float = 0.0) -> Settled:
    """When |x + lean| stays within a window.

    Args:
        ring: the vibration about its place of rest.
        window: half width of the window, above 0 [m].
        lean: how far the place of rest is from the middle of the window [m].
        doubt: how far x may be off at any time [m].

    Returns:
        the time, and the numbers between which it lies.

    **Error** told: `low` is the time of a window that much wider, `high` that of one that much narrower; the time falls
    as the window widens.
    **Source** module docstring.

    Raises:
        NumericsError: where halving finds no end.
    """
    if not (window > 0 and doubt >= 0):
        raise NumericsError("NUM102", "a window is wider than 0")
    if window <= abs(lean):
        reason = "at rest already outside the window" if window < abs(lean) else "at rest on the edge of the window"
        return Settled(math.inf, math.inf, math.inf, reason)
    reason = ""
    found = _last(ring, window, lean)
    if math.isinf(found[1]):
        reason = "without damping the swing never fades into the window"
    if not doubt:
        return Settled(found[1], *found, reason)
    low = _last(ring, window + doubt, lean)[0]
    high = _last(ring, window - doubt, lean)[1]
    return Settled(found[1], min(low, found[0]), max(high, found[1]), reason)


def _last(ring: Ring, window: float, lean: float) -> tuple[float, float]:
    """Between which numbers the last time outside lies: 0 where there is none."""
    room = window - abs(lean)
    end = _inside(ring, room)
    if end is None:
        return (0.0 if _stays_near(ring, room) else math.inf), math.inf
    top, bottom = window - lean, window + lean
    waiting, low, high = [(0.0, end)], 0.0, 0.0
    finest = max(_FINEST * end, 1e-300)
    slack = 8 * _EPS * (1 + float(np.abs(ring.rates).max()) * end) * float(np.abs(ring.amplitudes).sum())
    if slack > _TOLD * room:
        return 0.0, end  # so many swings from now the phase is rounding: all that is told is when the envelopes fit
    slowest = ring.rates[int(np.argmax(ring.rates.real))]
    if -2 * math.pi * slowest.real * room < 4 * slack * abs(slowest):  # rounding hides what one swing fades by
        waiting, high = [(0.0, _inside(ring, room + 4 * slack) or end)], end
    for _ in range(_MOST):
        if not waiting:
            return low, max(low, high)
        begins, ends = waiting.pop()
        middle = begins + (ends - begins) / 2
        value, reach = _reach(ring, begins, ends, middle)
        if -bottom < value - reach - slack and value + reach + slack < top:
            continue
        if value >= top + slack or value <= -bottom - slack:
            low, waiting = middle, []  # outside here: what is earlier does not matter
            if ends - begins > finest:
                waiting = [(middle, ends)]
            else:
                high = max(high, ends)
        elif (
            ends - begins <= finest or reach <= slack
        ):  # a summit that only touches cannot be told from one that leaves
            high = max(high, ends)
        else:
            waiting += [(begins, middle), (middle, ends)]
    return low, max(high, *(ends for _, ends in waiting)) if waiting else max(low, high)  # what is not yet looked at


def _stays_near(ring: Ring, room: float) -> bool:
    """Whether modes without damping, several of them, may still never meet in one peak."""
    return int(((np.abs(ring.amplitudes) > 0) & (ring.rates.real == 0)).sum()) > 1


def _inside(ring: Ring, room: float) -> float | None:
    """A time from which on the envelopes fit; None where they never do."""
    lasting = float(np.abs(ring.amplitudes[ring.rates.real >= 0]).sum())
    if lasting >= room:
        return None
    if ring.envelope(0.0) < room:
        return 0.0
    damped = -ring.rates.real[(ring.rates.real < 0) & (np.abs(ring.amplitudes) > 0)]
    low, high = 0.0, 1 / float(damped.max())
    for _ in range(_DOUBLINGS):
        if ring.envelope(high) < room:
            break
        low, high = high, 2 * high
    else:
        return None
    for _ in range(_BISECTIONS):
        middle = (low + high) / 2
        low, high = (low, middle) if ring.envelope(middle) < room else (middle, high)
    return high


def _reach(ring: Ring, begins: float, ends: float, middle: float) -> tuple[float, float]:
    """x in the middle of a stretch, and how far it comes from that anywhere in it."""
    half = (ends - begins) / 2
    parts = ring.amplitudes * np.exp(ring.rates * middle)
    size = np.abs(ring.amplitudes) * np.exp(ring.rates.real * begins)
    speed = np.abs(ring.rates)
    slow = speed * half <= _SLOW
    slope = abs(float((parts * ring.rates).real[slow].sum()))
    curved = float((size * speed**2)[slow].sum())
    fast = np.minimum(size * speed * half, size + np.abs(parts.real))[~slow]
    return float(parts.real.sum()), slope * half + curved * half**2 / 2 + float(fast.sum())
