"""A tail pulley on the carriage of a take-up weight: what its own rotation makes of the tensions.

The cells keep the tension behind the tail pulley, T + D/2 with the step D of steady running. The carriage keeps the
mean of both sides. They differ by half of what the step deviates from D:

    e = (m_t v' + R (sgn v - 1))/2,   m_t v' = S_after - S_before

with the mass m_t of the pulley at its surface and the resistance R at the tail.
"""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from ptmcalc.contract.result import Found
from ptmcalc.machines.conveyor.machine.motion import Moving
from ptmcalc.machines.conveyor.waves.effects.shared import moved_by
from ptmcalc.numerics.belt.march import Drawn

_AMPLIFIED = 6.0
"""Bound of the change of any tension relative to the largest deviation by the rotation of the tail pulley [1]: it
doubles where it meets the drive, and its echoes add. Calibrated: below 4 on the machines of
`tests/coverage/test_tail_takeup.py`. A smaller value loses the safety of the bar; a larger one widens it."""


def deviation(case: Moving, drawn: Drawn) -> float:
    """Bound of the deviation of any tension from that of a belt with a carriage [N].

    6 max |m_t v'|/2 + R,   R only for a belt that comes to rest or begins relaxed
    """
    line, tail = case.line, drawn.tail
    turning = float(np.abs(tail.tensions[:, -1] - tail.tensions[:, 0]).max()) / 2
    going = tail.belt > 0
    first = int(going.argmax()) if going.any() else len(going)
    stands = case.begins_loose or bool((tail.belt[first:] <= 0).any())  # friction frozen in from running acts fully
    return _AMPLIFIED * turning + (abs(line.tail_force) if stands else 0.0)


def widened(case: Moving, drawn: Drawn, loads: Mapping[str, Found]) -> dict[str, Found]:
    """Loads with the error of a tail pulley whose rotation the carriage does not feel.

    **Range** a gravity take-up at the tail.
    **Error** calibrated, see `_AMPLIFIED`.
    **Source** equilibrium of the carriage; independent model of masses in `tests/support/tail_takeup.py`.
    """
    if not case.line.weight_at_tail:
        return dict(loads)
    estimates = {name: found.estimate for name, found in loads.items()}
    change = deviation(case, drawn)
    offsets = moved_by(case.spec, case.scene, case.line, estimates, change, off=True)
    return {
        name: replace(found, estimate=found.estimate.widened(offsets[name])) if name in offsets else found
        for name, found in loads.items()
    }
