"""The rope on its drum: layers, turns, room, fleet angle, stress of the shell.

Turns count as real numbers: a part of a turn takes its part of the length. Every layer but the first lies either in the
valleys of the one below (`nested`), which for even layers are one fewer than its turns, or on top of it (`square`).
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]

NESTED, SQUARE = "nested", "square"


def layer_step(rope_diameter: float, pitch: float, packing: str) -> float:
    """What a layer adds to the radius of the rope's centre.

        nested: sqrt(d^2 - (p/2)^2)      square: d

    Args:
        rope_diameter: d [m].
        pitch: p, from turn to turn [m].
        packing: `nested` or `square`.

    Returns:
        step; sqrt(3)/2 d for nested turns that touch [m].

    Raises:
        ValueError: for another packing, or where a rope falls through between turns two diameters apart.

    **Range** round ropes that keep their shape.
    **Error** a rope under tension is pressed flat by some per cent of d.
    **Source** geometry: the centres of a rope and of the two it lies on.
    """
    if packing == SQUARE:
        return rope_diameter
    if packing != NESTED:
        raise ValueError(f"the packing is {NESTED} or {SQUARE}")
    if pitch >= 2 * rope_diameter:
        raise ValueError("a rope falls through between turns that are two diameters apart")
    return math.sqrt((rope_diameter - pitch / 2) * (rope_diameter + pitch / 2))


def layer_radius(drum_diameter: float, rope_diameter: float, layer_step: float, layer: int) -> float:
    """Radius of the centre of the rope in a layer.

        R_k = D/2 + d/2 + (k - 1) step

    Args:
        drum_diameter: D, of the surface the rope lies on [m].
        rope_diameter: d [m].
        layer_step: step, of `layer_step` [m].
        layer: k, from 1.

    Returns:
        R_k; with step = d the diameter is D + (2 k - 1) d [m].

    **Range** away from the places where the rope climbs over.
    **Error** as `layer_step`.
    **Source** geometry.
    """
    return (drum_diameter + rope_diameter) / 2 + (layer - 1) * layer_step


def turns_in_layer(turns: float, packing: str, layer: int) -> float:
    """Turns that a layer has room for.

        nested: N - 1 in even layers, N in odd ones      square: N

    Args:
        turns: N, of the first layer [1].
        packing: `nested` or `square`.
        layer: k, from 1.

    Returns:
        turns, not below 0 [1].

    **Range** a rope laid parallel; drums with half a groove more keep N in every layer.
    **Error** one turn in two layers.
    **Source** N turns side by side have N - 1 valleys.
    """
    return max(turns - 1, 0.0) if packing == NESTED and layer % 2 == 0 else turns


def drum_capacity(
    drum_diameter: float, rope_diameter: float, turns: float, layers: int, layer_step: float, packing: str
) -> float:
    """Length of rope a drum takes.

        l = sum over layers of 2 pi R_k N_k

    Args:
        drum_diameter: D, of the surface the rope lies on [m].
        rope_diameter: d [m].
        turns: N, of the first layer: length of the wound part over the pitch [1].
        layers: their number.
        layer_step: of `layer_step` [m].
        packing: `nested` or `square`.

    Returns:
        l [m].

    **Range** turns side by side; the rise of the helix, (p/(2 pi R))^2/2 of the length, is left out.
    **Error** below 0.02 % for p = d and D = 15 d; one turn in two layers, see `turns_in_layer`.
    **Source** geometry.
    """
    return math.fsum(
        2 * math.pi * layer_radius(drum_diameter, rope_diameter, layer_step, k) * turns_in_layer(turns, packing, k)
        for k in range(1, layers + 1)
    )


def length_below(
    layer: ArrayLike, drum_diameter: float, rope_diameter: float, turns: float, layer_step: float, packing: str
) -> FloatArray:
    """Length of rope on a drum as a layer begins: what the full layers below it hold.

        l = 2 pi (sum of odd layers R_k N + sum of even layers R_k N')

    Args:
        layer: k, whole numbers from 1 [1].
        drum_diameter: D, of the surface the rope lies on [m].
        rope_diameter: d [m].
        turns: N, of the first layer; N' of `turns_in_layer` [1].
        layer_step: of `layer_step` [m].
        packing: `nested` or `square`.

    Returns:
        l [m].

    **Range** as `drum_capacity`.
    **Error** as `drum_capacity`.
    **Source** sums of whole numbers: o odd layers have the radii R_1 + 2 j step, e even ones R_1 + (2 j + 1) step.
    """
    below = np.asarray(layer, float) - 1
    first = (drum_diameter + rope_diameter) / 2
    odd, even = np.ceil(below / 2), np.floor(below / 2)
    held = turns * odd * (first + (odd - 1) * layer_step)
    held = held + turns_in_layer(turns, packing, 2) * even * (first + even * layer_step)
    return np.asarray(2 * np.pi * held)


def turns_for_length(
    length: float, drum_diameter: float, rope_diameter: float, turns: float, layer_step: float, packing: str
) -> tuple[float, int]:
    """Turns and layers a length of rope makes on a drum.

        l = sum 2 pi R_k N_k, the last layer as full as needed

    Args:
        length: l, of the rope on the drum [m].
        drum_diameter: D, of the surface the rope lies on [m].
        rope_diameter: d [m].
        turns: N, of the first layer [1].
        layer_step: of `layer_step` [m].
        packing: `nested` or `square`.

    Returns:
        turns altogether [1], and the layers they lie in [1].

    **Range** as `drum_capacity`; N > 0; the flanges are not looked at.
    **Error** as `drum_capacity`.
    **Source** geometry.
    """
    # whole pairs of layers are counted at once: a drum that is far too short holds its rope in very many layers
    even = turns_in_layer(turns, packing, 2)
    done, layer, rest = 0.0, 1, length
    first = layer_radius(drum_diameter, rope_diameter, layer_step, 1)
    pairs = _whole_pairs(length / (2 * math.pi), first, layer_step, turns, even)
    if pairs:
        rest -= 2 * math.pi * _in_pairs(pairs, first, layer_step, turns, even)
        done, layer = pairs * (turns + even), 2 * pairs + 1
    while True:
        here = turns_in_layer(turns, packing, layer)
        turn = 2 * math.pi * layer_radius(drum_diameter, rope_diameter, layer_step, layer)
        if rest <= here * turn * (1 + 1e-12):
            return done + max(rest, 0.0) / turn, layer
        rest, done, layer = rest - here * turn, done + here, layer + 1


def _in_pairs(pairs: float, first: float, step: float, odd: float, even: float) -> float:
    """Length over 2 pi in pairs of layers: sum of (R + 2 j s) N + (R + (2 j + 1) s) N'."""
    return pairs * (odd + even) * (first + (pairs - 1) * step) + pairs * even * step


def _whole_pairs(length: float, first: float, step: float, odd: float, even: float) -> int:
    """Pairs of layers that surely lie below the last two: the root of `_in_pairs`, a little short of it."""
    a = (odd + even) * step
    b = (odd + even) * first - odd * step
    width = math.sqrt(b**2 + 4 * a * length)
    root = 2 * length / (b + width) if b >= 0 else (width - b) / (2 * a)
    return max(int(root * (1 - 1e-9)) - 1, 0)


def drum_length_required(
    length: float,
    drum_diameter: float,
    rope_diameter: float,
    pitch: float,
    layers: int,
    layer_step: float,
    packing: str,
) -> float:
    """Length of the wound part that takes a length of rope in so many layers.

        L = p N,   sum over layers of 2 pi R_k N_k = l

    Args:
        length: l, of the rope on the drum, dead wraps in it [m].
        drum_diameter: D, of the surface the rope lies on [m].
        rope_diameter: d [m].
        pitch: p, from turn to turn [m].
        layers: their number.
        layer_step: of `layer_step` [m].
        packing: `nested` or `square`.

    Returns:
        L; in one layer p l/(2 pi R_1) [m].

    **Range** as `drum_capacity`, layers all full.
    **Error** as `drum_capacity`.
    **Source** geometry.
    """
    radii = [layer_radius(drum_diameter, rope_diameter, layer_step, k) for k in range(1, layers + 1)]
    lost = math.fsum(radii[1::2]) if packing == NESTED else 0.0
    return pitch * (length / (2 * math.pi) + lost) / math.fsum(radii)


def fleet_angle(wound_width: float, offset: float, distance: float) -> float:
    """Largest angle between a rope and the plane of its turn on the drum.

        tan a = (b/2 + e)/l

    Args:
        wound_width: b, along the drum between its outermost turns [m].
        offset: e, of the sheave from the middle of the wound part, along the drum [m].
        distance: l, of the sheave from the drum [m].

    Returns:
        a [rad].

    **Range** a sheave whose plane is square to the drum's axis.
    **Error** the slope of the groove, atan(p/(pi D)), adds or takes about half a degree.
    **Source** geometry; 4 deg, and 2 deg for rotation-resistant ropes, by makers' manuals
        after ISO 4308-1 and ISO 16625.
    """
    return math.atan2(wound_width / 2 + offset, distance)


def hoop_stress(pull: float, pitch: float, thickness: float, layer_factor: float) -> float:
    """Pressing together of a drum shell by the rope wound on it.

        s = C S/(p t)

    Args:
        pull: S, of the rope [N].
        pitch: p, from turn to turn [m].
        thickness: t, of the shell below the grooves [m].
        layer_factor: C, of `layer_factor` [1].

    Returns:
        s, compressive, along the circumference [N/m^2].

    **Range** shells long and thin, away from flanges and from the end of the rope; bending at the edge of the wound
        part is not in it.
    **Error** that of C.
    **Source** balance of a ring of the width of a turn; DNV 2.22:2011 for C.
    """
    return layer_factor * pull / (pitch * thickness)


def layer_factor(layers: int) -> float:
    """Hoop stress of a drum wound in layers over that of one layer.

        C = 1 for one layer, 1.75 for two

    Args:
        layers: of rope on the drum.

    Returns:
        C [1].

    Raises:
        ValueError: for more layers, for which the rules ask a proof of its own.

    **Range** one or two layers.
    **Error** not known; measured values lie below for stiff ropes on soft drums.
    **Source** DNV 2.22:2011, lifting appliances; quoted from secondary sources, to be confirmed against the text.
    """
    factors = {1: 1.0, 2: 1.75}
    if layers not in factors:
        raise ValueError("more than two layers on a drum shell need a factor of their own")
    return factors[layers]
