"""Relations between the loads of a main shaft that hold for every machine at every moment."""

from collections.abc import Mapping

from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.contract.relation import Bounds, Relation, ordered
from ptmcalc.machines.shaft.machine.spec import RunOut, Shaft, Steady
from ptmcalc.spec.scene import Scene

_CYCLE: frozenset[type[Scene]] = frozenset({Steady})
_RUN_OUT: frozenset[type[Scene]] = frozenset({RunOut})
_ROUNDING = 1e-9
"""Relative width that rounding of loads from different sums may need."""


def _shares(spec: Shaft, scene: Steady, loads: Mapping[str, Estimate]) -> Bounds:
    """efficiency + loss factor = 1, of a machine that is driven and does something useful."""
    one, other = loads["cycle_efficiency"], loads["loss_factor"]
    if not (one.low > 0 and other.high < 1):
        return {}
    return {
        "cycle_efficiency": Interval(1 - other.high - _ROUNDING, 1 - other.low + _ROUNDING),
        "loss_factor": Interval(1 - one.high - _ROUNDING, 1 - one.low + _ROUNDING),
    }


def _mean(spec: Shaft, scene: Steady, loads: Mapping[str, Estimate]) -> Bounds:
    """w_mean = (w_max + w_min)/2 by definition."""
    high, low = loads["speed_max"], loads["speed_min"]
    between = Interval((high.low + low.low) / 2, (high.high + low.high) / 2)
    room = _ROUNDING * abs(between.high)
    return {"speed_mean": Interval(between.low - room, between.high + room)}


def _recovered(spec: Shaft, scene: RunOut, loads: Mapping[str, Estimate]) -> Bounds:
    """No more can be recovered than the shaft has, where no load drives it in the run-out."""
    driven = spec.potential or scene.load == "full"
    return {} if driven else {"energy_recoverable": Interval(-_ROUNDING, loads["kinetic_energy"].high)}


RELATIONS: tuple[Relation, ...] = (
    ordered("speed_max", "speed_mean", _CYCLE, "the maximum speed is at least the mean speed"),
    ordered("speed_mean", "speed_min", _CYCLE, "the mean speed is at least the minimum speed"),
    ordered("torque_motor_max", "torque_motor_rms", _CYCLE, "the maximum torque is at least the rms torque"),
    Relation(
        ("cycle_efficiency", "loss_factor"), _CYCLE, _shares, "efficiency and loss factor of a cycle have the sum 1"
    ),
    Relation(
        ("speed_mean", "speed_max", "speed_min"), _CYCLE, _mean, "the mean speed is the mean of the two extreme speeds"
    ),
    Relation(
        ("energy_recoverable", "kinetic_energy"),
        _RUN_OUT,
        _recovered,
        "the recoverable energy is at most the kinetic energy",
    ),
)
