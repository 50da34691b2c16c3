"""Envelopes of the tension along strands without sag."""

import numpy as np

from ptmcalc.numerics.loop import FloatArray, Loop, Motion, at_end, steps_of

_SHOWN = 60
"""Stretches of a strand whose ends are shown."""


def envelopes(loop: Loop, motion: Motion, window: float) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Places along the belt from the head's run-off [m], and the largest and the smallest tension there [N].

    Of strands that are pure delays: two waves that were sampled where they left meet at a place after their ways to it.
    The places are some tens on each strand, on the nodes of the grid, its ends among them.
    """
    steps, last_share = steps_of(window, motion.grid)
    from_drum, from_tail, into_back, from_off = motion.waves
    found = []
    for strand, cells, towards_start, towards_end, ahead in (
        (loop.back, motion.grid.back, into_back, from_off, 0.0),
        (loop.carry, motion.grid.carry, from_drum, from_tail, loop.back.length),
    ):
        nodes = np.unique(np.rint(np.linspace(0, cells, _SHOWN + 1)).astype(int))
        static = strand.static(nodes / cells)
        tops, lows = np.empty(len(nodes)), np.empty(len(nodes))
        for k, node in enumerate(nodes.tolist()):
            both = _arrived(towards_start, cells - node, steps) + _arrived(towards_end, node, steps)
            course = static[k] + both / 2
            course[-1] = at_end(course, last_share)
            tops[k], lows[k] = course.max(), course.min()
        found.append((ahead + nodes / cells * strand.length, tops, lows))
    places, highest, lowest = (np.concatenate(parts) for parts in zip(*found, strict=True))
    return places, highest, lowest


def _arrived(wave: FloatArray, late: int, steps: int) -> FloatArray:
    """What a wave is, so many steps after it left: nothing before it has come."""
    return np.concatenate([np.zeros(min(late, steps + 1)), wave[: max(steps + 1 - late, 0)]])
