"""Rope that climbs to the next layer on its drum: how the drum's radius grows, what it does to the load, its stress.

Source of the formulas called "of the paper": N. Fidrovska and O. Varchenko on the dynamics of multilayer winding of a
hoist of 5 t; its misprints (9200 for 96^2, a sign and an argument in the branch after the pulse) are put right where
the response is computed, `numerics.decay_pulse`.
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]

PAPER_SLOW, PAPER_FAST = 3.0, 96.0
"""Decay and rise of the forcing of the paper, at the 12 rpm of its drum [1/s]."""
PAPER_SPEED = 0.4 * math.pi
"""12 rpm [rad/s]."""


def paper_frequency(modulus: float, area: float, load: float, rope_length: float, gravity: float) -> float:
    """Natural frequency of a load on its rope by the paper, which leaves the tackle out.

        k = (E F g/(P l))^(1/2)

    Args:
        modulus: E, in the paper that of the wire [N/m^2].
        area: F, metallic area of the rope [m^2].
        load: P, weight of the load [N].
        rope_length: l, of the whole rope of the tackle [m].
        gravity: g [m/s^2].

    Returns:
        k [rad/s].

    **Range** one fall. On a tackle the rope carries P/m and moves m times as far as the load: k is m times as large.
    **Error** on m falls 1/m of the frequency, times the root of wire over rope modulus: 0.35 of it in the paper.
    **Source** paper, formula (3); its seven printed values follow to the last digit.
    """
    return math.sqrt(modulus * area / load / rope_length * gravity)


def paper_amplitude(drum_speed: float, rope_diameter: float) -> float:
    """Amplitude of the forcing A (exp(-3 t) - exp(-96 t)) of the paper.

        A = w^2 d

    Args:
        drum_speed: w [rad/s].
        rope_diameter: d [m].

    Returns:
        A [m/s^2].

    **Range** the factor before w^2 d is hard to read in print: 1 is its most probable value, 2 the other one.
    **Error** a third of what the climb of one diameter needs: the impulse 0.323 s A is not w d; see
        `climb_amplitude`.
    **Source** paper, formula (2).
    """
    return drum_speed**2 * rope_diameter


def climb_amplitude(drum_speed: float, climb: float) -> float:
    """Amplitude of the acceleration of the rope as it climbs, in the shape of the paper, at any speed of the drum.

        a = B w^2 dR (exp(-p f) - exp(-q f)),   B = p q/(q - p),   p = 3/(0.4 pi),   q = 96/(0.4 pi)

    over the angle f = w t of the drum. Its impulse is w dR, the jump of the rope's speed: B (1/p - 1/q) = 1.

    Args:
        drum_speed: w [rad/s].
        climb: dR, by which the radius grows [m].

    Returns:
        B w^2 dR, B = 2.464; p = 2.387 and q = 76.39 by `climb_rates` [m/s^2].

    **Range** an even drum; the shape was drawn for one hoist.
    **Error** the impulse is exact; the shape is the paper's and not derived from the way a rope climbs.
    **Source** derived: the paper's law over the angle instead of the time, so that it goes with the speed of the drum.
    """
    slow, fast = climb_rates(1.0)
    return slow * fast / (fast - slow) * drum_speed**2 * climb


def climb_rates(drum_speed: float) -> tuple[float, float]:
    """Decay and rise of the acceleration of `climb_amplitude`.

        l_1 = p w,   l_2 = q w

    Args:
        drum_speed: w [rad/s].

    Returns:
        l_1 and l_2; 3 and 96 at 12 rpm [1/s].

    **Range** as `climb_amplitude`.
    **Error** as `climb_amplitude`.
    **Source** as `climb_amplitude`.
    """
    return PAPER_SLOW / PAPER_SPEED * drum_speed, PAPER_FAST / PAPER_SPEED * drum_speed


def stretch_stress(modulus: float, stretch: ArrayLike, rope_length: float) -> FloatArray:
    """Stress of a rope from a stretch of it.

        s = E q/l

    Args:
        modulus: E, of the rope [N/m^2].
        stretch: q, of the rope [m].
        rope_length: l [m].

    Returns:
        s [N/m^2].

    **Range** within the elastic limit.
    **Error** exact; the paper's claim mixes a stretch of the whole rope with the length of one fall.
    **Source** Hooke; paper, formula (8).
    """
    return np.asarray(modulus * np.asarray(stretch, float) / rope_length)


def fall_stress(load: float, falls: int, area: float) -> float:
    """Mean stress of the rope of a tackle at rest.

        s = P/(m F)

    Args:
        load: P, weight of the load [N].
        falls: m, parts of rope it hangs on.
        area: F, metallic area of the rope [m^2].

    Returns:
        s [N/m^2].

    **Range** sheaves without friction, a rope without weight.
    **Error** friction of the sheaves takes it to m eta_r instead of m at the drum.
    **Source** balance of the hook block.
    """
    return load / falls / area


def stress_ratio(response_factor: float, amplitude: float, falls: int, ropes: int, gravity: float) -> float:
    """Dynamic over mean stress of a rope whose end at the drum is accelerated.

        s_dyn/s_mean = C A n/(m g),   C = k^2 q_max/A

    Args:
        response_factor: C, largest stretch over that of the steady acceleration A; below 2 [1].
        amplitude: A, of the acceleration of the rope at the drum [m/s^2].
        falls: m, parts of rope the load hangs on.
        ropes: n, parts of rope that run onto the drum.
        gravity: g [m/s^2].

    Returns:
        ratio [1].

    **Range** as `paper_frequency` for m = n = 1; the length of the rope acts through C alone.
    **Error** exact: s_dyn = E q/l, s_mean = P/(m F), k^2 = (m/n)^2 n E F g/(P l).
    **Source** derived. With the paper's own numbers 0.18 to 0.32 %; its 7 to 18 % need 24 to 62 times its amplitude.
    """
    return response_factor * amplitude / gravity * (ropes / falls)


def sudden_ratio(
    drum_speed: float, climb: float, natural_frequency: float, falls: int, ropes: int, gravity: float
) -> float:
    """Dynamic over mean stress if the radius grew at once: no shape of the climb gives more.

        s_dyn/s_mean <= w dR k n/(m g)

    Args:
        drum_speed: w [rad/s].
        climb: dR [m].
        natural_frequency: k, of the load on its tackle [rad/s].
        falls: m, parts of rope the load hangs on.
        ropes: n, parts of rope that run onto the drum.
        gravity: g [m/s^2].

    Returns:
        ratio; below 0.02 the climb does not matter, above 0.1 it is worth a simulation [1].

    **Range** one climb, a load that hung still; repeated climbs can add up.
    **Error** a bound, exact for a climb short against a period.
    **Source** derived: jump w dR of the rope's speed on an oscillator, |q| <= w dR/k for any rising speed.
    """
    return drum_speed * climb * natural_frequency / gravity * (ropes / falls)


def crossover_ratio(crossovers: int, drum_speed: float, natural_frequency: float) -> float:
    """Frequency with which the rope crosses over, over that of the load on its rope.

        r = n w/k

    Args:
        crossovers: n, in a turn.
        drum_speed: w [rad/s].
        natural_frequency: k [rad/s].

    Returns:
        r, resonance at 1 [1].

    **Range** equal distances between the crossovers.
    **Error** exact; harmonics of the crossovers meet the load at r = 1/2, 1/3 and so on, ever weaker.
    **Source** definition; drums grooved parallel have two crossovers in a turn.
    """
    return crossovers * drum_speed / natural_frequency


def crossover_rise(rope_diameter: float, layer_step: float) -> float:
    """What the rope rises and falls again where it crosses over from one valley of the layer below to the next.

        h = d - step

    Args:
        rope_diameter: d [m].
        layer_step: step, from layer to layer: 3^(1/2)/2 d for nested turns that touch, d for square ones [m].

    Returns:
        h; nothing where it lies on top of the layer below anyway [m].

    **Range** round ropes; 0 <= step <= d.
    **Error** a rope under tension is pressed flat by some per cent of d.
    **Source** geometry: on the crest of the rope below, the centre is one diameter above its centre.
    """
    return max(rope_diameter - layer_step, 0.0)


def winding_radius(
    radius: float, layer_step: float, rise: float, crossovers: int, arc: float, turns: float
) -> FloatArray:
    """Radius of the centre of the rope over the angle of the drum: a climb to the next layer, and crossovers on it.

        R even, climbing by `step` over one arc, then n times a turn up by h over half an arc and down over the other

    Args:
        radius: R, of the layer it climbs from [m].
        layer_step: step [m].
        rise: h, of `crossover_rise` [m].
        crossovers: n, in a turn.
        arc: angle of the drum that a crossover takes [rad].
        turns: wound from the beginning of the climb [1].

    Returns:
        corners, between which the radius goes straight: angle from half a crossover before the climb, and radius, shape
        (corners, 2) [rad] and [m].

    Raises:
        ValueError: for crossovers that exceed one turn.

    **Range** layers wound parallel, with a crossover every 1/n of a turn; the climb takes one of them.
    **Error** the true shape is round at its corners, which excites less; the arc is 60 to 70 deg on drums made for
        parallel crossovers and hardly known on others.
    **Source** geometry of parallel-grooved drums.
    """
    apart = 2 * math.pi / crossovers
    if arc >= apart:
        raise ValueError("the crossovers exceed one turn")
    high = radius + layer_step
    corners = [(0.0, radius), (arc / 2, radius), (arc / 2 + arc, high)]
    for k in range(1, max(1, math.ceil(turns * crossovers))):
        begin = arc / 2 + k * apart
        if rise > 0:
            corners += [(begin, high), (begin + arc / 2, high + rise), (begin + arc, high)]
    corners.append((arc / 2 + max(1, math.ceil(turns * crossovers)) * apart, high))
    return np.array(corners)
