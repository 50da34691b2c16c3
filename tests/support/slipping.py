"""A slipping drum by brute force: lumped masses, tiny steps, a friction limit. Imports nothing from `ptmcalc`.

The belt's node at the drum either moves with the drum or is dragged by the friction limit (e - 1) S_off, with
e = exp(mu alpha) and the run-off tension of the moment. Semi-implicit Euler; first order in space and time.
"""

from dataclasses import dataclass

import numpy as np

from support.fem import Belt, elements


@dataclass(frozen=True)
class Slipped:
    """What is left at the end, and the largest run-on tension."""

    belt_speed: float
    drum_speed: float
    slip_distance: float
    run_on_max: float


def start(
    belt: Belt, count: tuple[int, int], force: float, run_on: float, run_off: float, grip: float, window: float
) -> Slipped:
    """A step of `force` over the static resistance on a belt with static tensions `run_on` and `run_off`."""
    bare = Belt(belt.lengths, belt.line_masses, belt.stiffness, 0.0, belt.tail_mass, belt.rigid_takeup)
    mass, _, springs = elements(bare, count)
    lumped = mass.sum(axis=1)
    nodes = len(lumped)
    first = np.arange(len(springs))
    second = (first + 1) % nodes
    fastest = max(
        np.sqrt(belt.stiffness / rho) * n / length
        for rho, n, length in zip(belt.line_masses, count, belt.lengths, strict=True)
    )
    step = 0.25 / fastest
    u, v = np.zeros(nodes), np.zeros(nodes)
    drum, slip, largest, slipping = 0.0, 0.0, 0.0, False
    e = np.exp(grip)
    for _ in range(int(window / step)):
        pull = springs * (u[first] - u[second])
        net = np.zeros(nodes)
        net[first] -= pull
        net[second] += pull
        off = pull[-1] if belt.rigid_takeup else 0.0
        limit = (e - 1) * (run_off + off) - (run_on - run_off)  # dynamic part of what friction transmits
        together = (force + net[0]) / (belt.drum_mass + lumped[0])
        if not slipping and lumped[0] * together - net[0] > limit:
            slipping = True
        if slipping:
            v[0] += step * (net[0] + limit) / lumped[0]
            drum += step * (force - limit) / belt.drum_mass
            slip += step * (drum - v[0])
            if drum <= v[0]:
                drum = v[0] = (belt.drum_mass * drum + lumped[0] * v[0]) / (belt.drum_mass + lumped[0])
                slipping = False
        else:
            v[0] += step * together
            drum = v[0]
        v[1:] += step * net[1:] / lumped[1:]
        u += step * v
        largest = max(largest, pull[0])
    return Slipped(float(v[0]), float(drum), float(slip), run_on + float(largest))
