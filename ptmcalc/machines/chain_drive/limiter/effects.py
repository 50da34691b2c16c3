"""A trip of the limiter in a start or a stop: the motion is then another one."""

from collections.abc import Mapping

from ptmcalc.base.estimate import ANYTHING, Estimate, Interval
from ptmcalc.contract.effect import Criterion, Effect
from ptmcalc.machines.chain_drive.limiter.starts import best_torque
from ptmcalc.machines.chain_drive.limiter.stops import STOPS, stop_torque
from ptmcalc.machines.chain_drive.limiter.trips import least
from ptmcalc.machines.chain_drive.spec import ChainDrive, ChainScene, Start, Stopping
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
    value = 0.0 if spec.torque_limiter is None else _upper(spec, scene) / least(spec)
    return Criterion("E", value, 1.0, "torque of the torque limiter / lowest trip torque", "limiter_start")


def _upper(spec: ChainDrive, scene: ChainScene) -> float:
    """Upper bound of the torque, as close as is needed to know whether the limiter trips [N*m]."""

    def decided(torque: Estimate) -> bool:
        return torque.high < least(spec) or torque.low >= least(spec)

    if isinstance(scene, Start):
        return best_torque(spec, scene, decided).high
    assert isinstance(scene, Stopping)
    torque = stop_torque(spec, scene, 0)
    return torque.high if decided(torque) else stop_torque(spec, scene, 1).high


def bound(spec: ChainDrive, scene: ChainScene, loads: Mapping[str, Estimate]) -> Mapping[str, Interval]:
    """No bound for any load of a start or stop in which the limiter may trip; no change otherwise.

        E < 1: 0

    **Range** any start and any stop.
    **Error** exact below the lowest trip torque.
    **Source** a limiter that holds is a rigid shaft.
    """
    if spec.torque_limiter is None or not criterion(spec, scene).exceeded:
        return {}
    return {name: ANYTHING for name in loads if name in _MOVED}


LIMITER_TRIP: Effect[ChainDrive, ChainScene] = Effect(
    "limiter_trip", "trip of the torque limiter", frozenset({Start}) | STOPS, criterion, bound
)
