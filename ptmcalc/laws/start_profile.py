"""How a drive brings a machine up to speed, and how far an undamped mode can stray from the quasi-static answer.

A profile is a factor that rises from 0 to 1 in the time `rise`: `step` at once, `ramp` linearly, `cosine` as
(1 - cos(pi t/t_s))/2 (Harrison), `parabolic` as two parabolas that meet in the middle (Nordell); a table says it
point by point, straight between them. Imposed on the torque it is the force; imposed on the speed its rate is the
acceleration.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]

STEP, RAMP, COSINE, PARABOLIC = "step", "ramp", "cosine", "parabolic"
Shape = str | tuple[tuple[float, float], ...]
"""One of these words, or points (share of the rise time, factor): the shares rise from 0 to 1, the factors do not
fall and end at 1."""


def rise(shape: Shape, rise_time: float, time: ArrayLike) -> FloatArray:
    """The factor of a start profile.

        step: 1      ramp: u = t/t_s      cosine: (1 - cos(pi u))/2      each 1 after t_s
        parabolic: 2 u^2 up to the middle, then 1 - 2 (1 - u)^2      points: straight between them

    Args:
        shape: `step`, `ramp`, `cosine`, `parabolic`, or points.
        rise_time: t_s [s].
        time: t [s].

    Returns:
        factor between 0 and 1 [1].

    **Range** t >= 0.
    **Error** exact.
    **Source** A. Harrison's cosine, L. Nordell's parabolas and the linear ramp, as used for controlled starts.
    """
    times = np.asarray(time, float)
    if shape == STEP:
        return np.ones_like(times)
    share = np.clip(times / rise_time, 0.0, 1.0)
    if isinstance(shape, tuple):
        return np.asarray(np.interp(share, *_columns(shape)))
    if shape == PARABOLIC:
        return np.where(share < 0.5, 2 * share**2, 1 - 2 * (1 - share) ** 2)
    return share if shape == RAMP else np.asarray(np.sin(np.pi / 2 * share) ** 2)


def rise_integral(shape: Shape, rise_time: float, time: ArrayLike) -> FloatArray:
    """Time integral of `rise` from 0.

        step: t    ramp: t^2/(2 t_s)    cosine: t/2 - t_s sin(pi t/t_s)/(2 pi)    each + (t - t_s) after t_s
        parabolic: 2 t^3/(3 t_s^2) up to the middle, then t - t_s/2 + 2 (t_s - t)^3/(3 t_s^2)
        points: trapezia

    Args:
        shape: `step`, `ramp`, `cosine`, `parabolic`, or points.
        rise_time: t_s [s].
        time: t [s].

    Returns:
        integral [s].

    **Range** t >= 0.
    **Error** exact.
    **Source** elementary integration.
    """
    times = np.asarray(time, float)
    if shape == STEP:
        return times.copy()
    inside = np.minimum(times, rise_time)
    if isinstance(shape, tuple):
        shares, factors = _columns(shape)
        whole = np.concatenate([[0.0], np.cumsum(np.diff(shares) * (factors[1:] + factors[:-1]) / 2)])
        u = inside / rise_time
        before = np.clip(np.searchsorted(shares, u, "right") - 1, 0, len(shares) - 2)
        mean = (factors[before] + np.interp(u, shares, factors)) / 2
        area = rise_time * (whole[before] + (u - shares[before]) * mean)
    elif shape == RAMP:
        area = inside**2 / (2 * rise_time)
    elif shape == PARABOLIC:
        u = inside / rise_time
        late = u - 0.5 + 2 / 3 * (1 - u) ** 3
        area = rise_time * np.where(u < 0.5, 2 / 3 * u**3, late)
    else:
        angle = np.pi * inside / rise_time
        area = rise_time / (2 * np.pi) * _angle_less_sine(angle)
    return np.asarray(area + np.maximum(times - rise_time, 0))


def _angle_less_sine(y: FloatArray) -> FloatArray:
    """y - sin y, by its series where the difference would lose digits."""
    series = y**3 / 6 * (1 - y**2 / 20 * (1 - y**2 / 42 * (1 - y**2 / 72 * (1 - y**2 / 110))))
    return np.where(y < 0.5, series, y - np.sin(y))


def time_of_share(shape: Shape, rise_time: float, share: ArrayLike) -> FloatArray:
    """When a start profile reaches a factor for the first time.

        step: 0      ramp: q t_s      cosine: t_s arccos(1 - 2 q)/pi
        parabolic: t_s sqrt(q/2) up to one half, then t_s (1 - sqrt((1 - q)/2))      points: straight between them

    Args:
        shape: `step`, `ramp`, `cosine`, `parabolic`, or points.
        rise_time: t_s [s].
        share: factor q [1].

    Returns:
        time from switching on, 0 for a factor that is there at once, infinite for one that never comes [s].

    **Range** any q.
    **Error** exact.
    **Source** the inverse of `rise`.
    """
    asked = np.asarray(share, float)
    wanted = np.clip(asked, 0.0, 1.0)
    if isinstance(shape, tuple):
        shares, factors = _columns(shape)
        above = np.searchsorted(factors, wanted)
        before = np.maximum(above - 1, 0)
        gap = factors[above] - factors[before]
        part = np.divide(wanted - factors[before], gap, out=np.zeros_like(wanted), where=gap > 0)
        reached = np.where(above > 0, shares[before] + part * (shares[above] - shares[before]), 0.0)
    elif shape == STEP:
        reached = np.zeros_like(wanted)
    elif shape == PARABOLIC:
        reached = np.where(wanted < 0.5, np.sqrt(wanted / 2), 1 - np.sqrt((1 - wanted) / 2))
    else:
        reached = wanted if shape == RAMP else np.arccos(1 - 2 * wanted) / np.pi
    return np.asarray(np.where(asked > 1, np.inf, rise_time * reached))


def time_to_momentum(
    shape: Shape, rise_time: float, force: ArrayLike, resistance: ArrayLike, held: ArrayLike, momentum: ArrayLike
) -> FloatArray:
    """Time from its release in which a body under a rising force and a constant resistance gathers a momentum.

        F (I(t_0 + t) - I(t_0)) - W t = p,   I the time integral of the profile

    Args:
        shape: `step`, `ramp`, `cosine`, `parabolic`, or points.
        rise_time: of the profile [s].
        force: F, at its plateau [N].
        resistance: W [N].
        held: t_0, from switching on to the release [s].
        momentum: p [kg*m/s].

    Returns:
        time t; infinite where F is not above W [s].

    **Range** F rises through W at t_0.
    **Error** rounding: a bisection to the last digit.
    **Source** Newton's law.
    """
    f, w, start, wanted = np.broadcast_arrays(*(np.asarray(one, float) for one in (force, resistance, held, momentum)))
    moves = f > w
    excess = wanted / np.where(moves, f - w, 1.0)
    if shape == STEP:
        return np.where(moves, excess, np.inf)
    high = rise_time + excess
    low, before = np.zeros_like(high), rise_integral(shape, rise_time, start)
    while True:
        middle = (low + high) / 2
        inside = moves & (low < middle) & (middle < high)
        if not inside.any():
            return np.where(moves, high, np.inf)
        short = f * (rise_integral(shape, rise_time, start + middle) - before) - w * middle < wanted
        low, high = np.where(inside & short, middle, low), np.where(inside & ~short, middle, high)


def rise_rate(shape: Shape, rise_time: float, time: ArrayLike) -> FloatArray:
    """Slope of `rise`.

        ramp: 1/t_s      cosine: pi/(2 t_s) sin(pi t/t_s)      parabolic: 4 min(t, t_s - t)/t_s^2
        points: (q_k+1 - q_k)/(t_k+1 - t_k)      0 after t_s

    Args:
        shape: `ramp`, `cosine`, `parabolic`, or points.
        rise_time: t_s [s].
        time: t [s].

    Returns:
        slope [Hz].

    **Range** t >= 0, t_s > 0; at t_s and at points the slope from the left.
    **Error** exact.
    **Source** derivative of `rise`.
    """
    times = np.asarray(time, float)
    inside = times <= rise_time
    slope = np.full_like(times, 1 / rise_time)
    if isinstance(shape, tuple):
        shares, slopes = _columns(shape)[0], _slopes(shape)
        after = np.searchsorted(shares, times / rise_time)
        slope = slopes[np.clip(after - 1, 0, len(slopes) - 1)] / rise_time
    elif shape == COSINE:
        slope = np.pi / (2 * rise_time) * np.sin(np.pi * np.minimum(times / rise_time, 1.0))
    elif shape == PARABOLIC:
        slope = 4 / rise_time * np.minimum(times / rise_time, 1 - times / rise_time)
    return np.where(inside, slope, 0.0)


def peak_rate(shape: Shape, rise_time: float) -> float:
    """Steepest slope of `rise`.

        ramp: 1/t_s      cosine: pi/(2 t_s)      parabolic: 2/t_s      points: the steepest between two

    Args:
        shape: `ramp`, `cosine`, `parabolic`, or points.
        rise_time: t_s [s].

    Returns:
        slope [Hz].

    **Range** t_s > 0; a step has no finite slope.
    **Error** exact.
    **Source** derivative of `rise`.
    """
    if isinstance(shape, tuple):
        return float(_slopes(shape).max()) / rise_time
    return {RAMP: 1.0, COSINE: np.pi / 2, PARABOLIC: 2.0}[shape] / rise_time


def _columns(points: tuple[tuple[float, float], ...]) -> tuple[FloatArray, FloatArray]:
    """Shares of the rise time, and factors."""
    shares, factors = np.array(points, float).T
    return shares, factors


def _slopes(points: tuple[tuple[float, float], ...]) -> FloatArray:
    """Slope between neighbouring points over the rise time."""
    shares, factors = _columns(points)
    return np.asarray(np.diff(factors) / np.diff(shares))


def residual(shape: Shape, rise_time: float, frequency: ArrayLike) -> FloatArray:
    """Swing that a profile leaves in a mode after its end, over the one that a step would leave.

        R = |integral of q'(t) exp(i w t) dt|,   x = w t_s/2
        ramp: |sin x/x|      cosine: |cos x/(1 - (2 x/pi)^2)|      parabolic: (sin(x/2)/(x/2))^2      step: 1
        points: |q_0 + sum (q_k+1 - q_k) sin y_k/y_k exp(i w t_k)|,   y_k = w (t_k+1 - t_k)/2, t_k in the middle

    Args:
        shape: `step`, `ramp`, `cosine`, `parabolic`, or points.
        rise_time: t_s [s].
        frequency: w, of the mode [rad/s].

    Returns:
        R; 0 where a ramp lasts whole periods of the mode [1].

    **Range** an undamped mode at rest before, t_s > 0; a profile of the torque as well as one of the speed.
    **Error** exact; damping makes it smaller.
    **Source** derived: Fourier transform of the rise; the ramp's in handbooks of vibration.
    """
    w = np.asarray(frequency, float)
    if shape == STEP:
        return np.ones_like(w)
    x = w * rise_time / 2
    if isinstance(shape, tuple):
        shares, factors = _columns(shape)
        turns = 2 * x[..., None]
        middles, halves = (shares[1:] + shares[:-1]) / 2, np.diff(shares) / 2
        gained = np.diff(factors) * np.sinc(turns * halves / np.pi) * np.exp(1j * turns * middles)
        return np.asarray(np.abs(factors[0] + gained.sum(axis=-1)))
    if shape == RAMP:
        return np.asarray(np.abs(np.sinc(x / np.pi)))
    if shape == PARABOLIC:
        return np.asarray(np.sinc(x / (2 * np.pi)) ** 2)
    # sin y/y over 1 + 2 x/pi, y = pi/2 - x: no pole at x = pi/2
    return np.asarray(np.pi / 4 * np.abs(np.sinc(0.5 - x / np.pi) / (0.5 + x / np.pi)))


@dataclass(frozen=True, slots=True)
class Phase:
    """A stretch of a start: the quasi-static answer is `low` to `high` times that of the plateau, and no undamped
    mode strays from it by more than `stray` times its share."""

    low: float
    high: float
    stray: float


def phases(shape: Shape, imposed_speed: bool, rise_time: float, lowest_frequency: float) -> tuple[Phase, ...]:
    """Bounds on the answer of every undamped mode with at least this frequency, phase by phase of a start.

    For x'' + w^2 x = w^2 q(t), q the force factor (torque) or the acceleration over its peak (speed), b = pi/(w t_s):

        torque step    |x - 1| <= 1
        torque ramp    |x - q| <= 1/(w t_s) in the ramp, then |x - 1| <= 2/(w t_s)
        torque cosine  |x - q| <= b^2/(1 - b^2) in and after the rise
        torque parab.  |x - q| <= 16/(w t_s)^2 in and after the rise
        speed ramp     |x - 1| <= 1 in the ramp, then |x| <= 2
        speed cosine   |x - q| <= b/(1 - b) in the rise, then |x| <= 2 b/(1 - b^2)
        speed parab.   |x - q| <= 6/(w t_s) in the rise, then |x| <= 8/(w t_s)
        torque points  |x - q| <= q_0 + sum |change of slope|/w in and after the rise
        speed points   |x - q| <= sum |change of acceleration| in the rise, the last not counted, |x| <= all after it

    each capped by the response to its increases one by one: 1 for a torque (it only rises), 2 for a speed (the
    acceleration rises and falls by its peak; that of points by all its changes). All decrease with w, so the lowest
    frequency bounds every mode.

    Args:
        shape: `step`, `ramp`, `cosine`, `parabolic`, or points.
        imposed_speed: True when the speed is imposed, False for the torque.
        rise_time: t_s [s].
        lowest_frequency: w, a lower bound of the natural frequencies [rad/s].

    Returns:
        the phases in order of time.

    **Range** undamped linear modes, t_s > 0 unless the shape is a step; a speed step has no bound.
    **Error** a bound, attained by the torque step; over a whole start up to 1.8 times the worst mode otherwise.
    **Source** Duhamel's integral for each profile in closed form.

    Raises:
        ValueError: for a step of speed.
    """
    if shape == STEP:
        if imposed_speed:
            raise ValueError("a step of speed needs an infinite force")
        return (Phase(1.0, 1.0, 1.0),)
    x = lowest_frequency * rise_time
    if isinstance(shape, tuple):
        return _phases_of_points(shape, imposed_speed, x)
    b = np.pi / x if x > 0 else np.inf
    if shape == RAMP:
        if imposed_speed:
            return Phase(1.0, 1.0, 1.0), Phase(0.0, 0.0, 2.0)
        return Phase(0.0, 1.0, _capped(1 / x if x > 0 else np.inf, 1)), Phase(
            1.0, 1.0, _capped(2 / x if x > 0 else np.inf, 1)
        )
    if shape == PARABOLIC:  # every corner of q'' (torque) or of q (speed) leaves its own swing behind
        if imposed_speed:
            late = _capped(8 / x if x > 0 else np.inf, 2)
            return Phase(0.0, 1.0, _capped(6 / x if x > 0 else np.inf, 2)), Phase(0.0, 0.0, late)
        stray = _capped(16 / x**2 if x > 0 else np.inf, 1)
        return Phase(0.0, 1.0, stray), Phase(1.0, 1.0, stray)
    if imposed_speed:
        return (
            Phase(0.0, 1.0, _capped(b / (1 - b) if b < 1 else np.inf, 2)),
            Phase(0.0, 0.0, _capped(2 * b / (1 - b**2) if b < 1 else np.inf, 2)),
        )
    stray = _capped(b**2 / (1 - b**2) if b < 1 else np.inf, 1)
    return Phase(0.0, 1.0, stray), Phase(1.0, 1.0, stray)


def _phases_of_points(points: tuple[tuple[float, float], ...], imposed_speed: bool, turns: float) -> tuple[Phase, ...]:
    """`phases` where every corner leaves its own swing behind; `turns` is w t_s."""
    slopes = _slopes(points)
    changes = np.abs(np.diff(np.concatenate([[0.0], slopes, [0.0]])))
    if imposed_speed:
        peak = slopes.max()
        inside = float(changes[:-1].sum() / peak)
        return Phase(float(slopes.min() / peak), 1.0, inside), Phase(0.0, 0.0, inside + float(changes[-1] / peak))
    first = points[0][1]
    stray = _capped(first + changes.sum() / turns if turns > 0 else np.inf, 1)
    return Phase(first, 1.0, stray), Phase(1.0, 1.0, stray)


def _capped(value: float, cap: float) -> float:
    return float(min(value, cap))
