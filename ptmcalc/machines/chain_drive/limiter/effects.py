"""A trip of the limiter in a start or a stop: the motion is then another one."""

from collections.abc import Mapping

from ptmcalc.base.estimate import ANYTHING, Estimate, Interval
from ptmcalc.contract.effect import Criterion, Effect
from ptmcalc.machines.chain_drive.limiter.starts import best_torque, start_torque
from ptmcalc.machines.chain_drive.limiter.stops import STOPS, stop_torque
from ptmcalc.machines.chain_drive.limiter.trips import least
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, ChainScene, Start, Stopping
from ptmcalc.machines.chain_drive.starting.bounds import TENSIONS
from ptmcalc.machines.chain_drive.stopping.formulas import OF_STOP

_MOVED = frozenset(TENSIONS) | OF_STOP | {"start_time", "stop_time", "stop_distance", "coast_distance"}
"""Loads of a scene that a trip changes."""


def criterion(spec: ChainDrive, scene: ChainScene) -> Criterion:
    """Largest torque through the limiter relative to its lowest trip torque.

        E = M/M_min

    **Range** any start and any stop; 0 without a torque limiter, infinite where the torque has no bound.
    **Error** an upper bound of the ratio.
    **Source** `limiter_start`, `limiter_stop`.
    """
    value = 0.0
    if spec.torque_limiter is not None:
        torque = start_torque(spec, scene, 0)[0] if isinstance(scene, Start) else _stopped(spec, scene)
        value = torque.high / least(spec)
    return Criterion("E", value, 1.0, "torque of the torque limiter / lowest trip torque", "limiter_start")


def _stopped(spec: ChainDrive, scene: ChainScene) -> Estimate:
    """The torque of a stop by its coarsest modes [N*m]."""
    assert isinstance(scene, Stopping)
    return stop_torque(spec, scene, 0)


def _may_trip(spec: ChainDrive, scene: ChainScene) -> bool:
    """Whether the limiter may trip: by the bound of the criterion, else with every tooth of a start, or finer modes."""
    if not criterion(spec, scene).exceeded:
        return False
    if isinstance(scene, Start):
        torque = best_torque(spec, scene, lambda one: one.low >= least(spec))
    else:
        assert isinstance(scene, Stopping)
        torque = stop_torque(spec, scene, 1)
    return torque.high >= least(spec)


def bound(spec: ChainDrive, scene: ChainScene, loads: Mapping[str, Estimate]) -> Mapping[str, Interval]:
    """No bound for any load of a start or stop in which the limiter may trip; no change otherwise.

        E < 1: 0,   also where a start with every tooth, or a stop with more modes, stays below the lowest trip torque

    **Range** any start and any stop.
    **Error** exact below the lowest trip torque.
    **Source** a limiter that holds is a rigid shaft.
    """
    if spec.torque_limiter is None or not _may_trip(spec, scene):
        return {}
    return {name: ANYTHING for name in loads if name in _MOVED}


LIMITER_TRIP: Effect[ChainDrive, ChainScene] = Effect(
    "limiter_trip", "trip of the torque limiter", frozenset({Start}) | STOPS, criterion, bound
)
