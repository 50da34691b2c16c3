"""Steady running of random chains with a driven tail: tensions at all four ends against finite elements over time.

The reference moves both ends of each strand by the teeth of both sprockets until the start has decayed. Tensions
without teeth are worked out from the numbers of the file, the share of the tail among them.
"""

import math
from typing import Any

import numpy as np
import pytest
from support.chain_starts import built
from support.driven_tails import Machine, random_machine, stacked, total
from support.held_fem import Bar, Motion, moved_by_ends, teeth

from ptmcalc.machines.chain_drive.polygon.distributed_strand import DISTRIBUTED_STRAND
from ptmcalc.machines.chain_drive.polygon.excitation import FAR, POLYGON

SEED, MACHINES, ALWAYS = 2027, 24, 4
DECAYED, LOOKED = 7.0, 2
"""Time constants of the slowest mode before the reference is looked at, and pitches that are looked at."""


def even(speed: float, times: np.ndarray) -> Motion:
    return speed * times, np.full_like(times, speed), np.zeros_like(times)


def peaks(machine: Machine, phase: float, pieces: int) -> tuple[float, float]:
    """Smallest and largest tension of all ends."""
    head, tail = machine.teeth
    period = machine.pitch / machine.speed
    least, most = [], []
    # run-on of the drive at 0, run-off of the tail at the phase, each other side half a turn away
    places = ((head / 2, phase + tail / 2), (phase, 0.0))
    for strand, (begin, end) in enumerate(places):
        bar: Bar = machine.bars[strand]
        free = strand == 0 and not machine.fixed
        transit = bar.length * math.sqrt(bar.line_mass / bar.stiffness)
        lowest = math.pi / transit / (2 if free else 1)
        settled = DECAYED / (bar.damping * lowest**2 / 2)
        count = math.ceil(settled / period) + LOOKED
        dt = period / math.ceil(period / (transit / pieces / 1.5))
        times = np.arange(0.0, count * period, dt)
        mean = even(machine.speed, times)
        numbers = (tail, head) if strand == 1 else (head, tail)
        first, last = (
            stacked([total(mean, teeth(mean, machine.pitch, z, -place % 1.0))])
            for z, place in zip(numbers, (begin, end), strict=True)
        )
        found = moved_by_ends(bar, pieces, dt, None if free else first, last)[-round(LOOKED * period / dt) :, :, 0]
        for side, static in zip((0, -1), machine.static[strand], strict=True):
            least.append(static + float(found[:, side].min()))
            most.append(static + float(found[:, side].max()))
    return min(least), max(most)


def running(index: int) -> tuple[Machine, float, Any]:
    machine = random_machine(index, type="run")
    rng = np.random.default_rng((SEED, index))
    phase = float(rng.random())
    data = machine.data | {"accuracy": "1 %"}
    data["layout"]["tail"]["phase"] = phase
    for key in ("drive", "brake"):
        data.pop(key, None)
    data["layout"]["tail"].pop("synchronised")
    return machine, phase, built(data)


@pytest.mark.parametrize(
    "index", [*range(ALWAYS), *(pytest.param(k, marks=pytest.mark.study) for k in range(ALWAYS, MACHINES))]
)
def test_the_tensions_of_steady_running_with_a_driven_tail_hold(index: int) -> None:
    machine, phase, spec = running(3000 + index)
    (scene,) = spec.all_scenes
    loads = DISTRIBUTED_STRAND.run(spec, scene, frozenset({POLYGON, FAR}), 1).loads
    least, design = loads["tension_min"].estimate, loads["tension_design"].estimate
    (low_1, high_1), (low_2, high_2) = (peaks(machine, phase, pieces) for pieces in (24, 48))
    swing = high_2 - machine.static[1][1]
    centrifugal = machine.back.line_mass * machine.speed**2
    for one, coarse, fine in ((least, low_1, low_2), (design, high_1 + centrifugal, high_2 + centrifugal)):
        slack = 2 * abs(fine - coarse) + 0.01 * abs(swing) + 1e-6 * abs(fine)
        assert one.low - slack <= fine <= one.high + slack, (one, fine, coarse)
