"""Relations between the loads of a chain drive that hold for every chain at every moment."""

import math
from collections.abc import Mapping

from ptmcalc.contract.relation import Relation, computed, ordered
from ptmcalc.machines.chain_drive.machine import strength
from ptmcalc.machines.chain_drive.machine.model import chain_line
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, Run, Start
from ptmcalc.machines.chain_drive.starting.motion import start_case
from ptmcalc.spec.scene import Scene

_RUN: frozenset[type[Scene]] = frozenset({Run})
_START: frozenset[type[Scene]] = frozenset({Start})


def _start_tension(spec: ChainDrive, scene: Start, loads: Mapping[str, float]) -> float:
    return start_case(spec, scene).line.run_on + loads["tension_dynamic_start"]


def _start_safety(spec: ChainDrive, scene: Start, loads: Mapping[str, float]) -> float:
    tension = loads["tension_start"] + chain_line(spec, scene).centrifugal
    if not math.isfinite(tension):
        return 0.0 if tension > 0 else math.inf
    return strength.safety(spec, tension)


RELATIONS: tuple[Relation, ...] = (
    ordered(
        "tension_polygon_bound",
        "tension_dynamic_polygon",
        _RUN,
        "the maximum polygon tension is at most the sum of its absolute harmonics",
    ),
    ordered("tension_design", "tension_min", _RUN, "the maximum tension is at least the minimum"),
    ordered("tension_start", "tension_min", _START, "the maximum tension is at least the minimum"),
    computed(
        "tension_start",
        ("tension_dynamic_start",),
        _start_tension,
        _START,
        "the starting tension is the sum of static tension and dynamic part",
    ),
    computed(
        "safety_start",
        ("tension_start",),
        _start_safety,
        _START,
        "the safety factor is the breaking load divided by maximum plus centrifugal tension",
    ),
)
