"""The energy ledger of a march: what was put in, what was lost where, and what no entry accounts for."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ptmcalc.numerics.energy import residual
from ptmcalc.numerics.record import Record
from ptmcalc.numerics.train.signals import FloatArray
from ptmcalc.numerics.train.state import State
from ptmcalc.numerics.train.system import TrainSystem


@dataclass(frozen=True, slots=True)
class Ledger:
    """Works in J. `put_in` of each drive and prescribed motion (negative where it takes energy out), `lost` in each
    link, brake or clutch and mesh, `shocks` in impacts, `stored` the change of kinetic and elastic energy.

    The works are integrals of torque times speed over Gauss-Lobatto nodes; the stored energy comes from the states at
    both ends alone. So the residual verifies the propagation and every event.
    """

    put_in: Mapping[str, float]
    lost: Mapping[str, float]
    shocks: float
    stored: float
    residual: float


def ledger(system: TrainSystem, start: tuple[State, FloatArray], record: Record) -> Ledger:
    """The ledger of a march from `start`."""
    train = system.train
    work = dict(zip(system.works, record.integrals.tolist(), strict=True))
    put_in = {drive.name: work["drive", i] for i, drive in enumerate(train.drives)}
    put_in |= {guide.name: work["guide", i] for i, guide in enumerate(train.guides)}
    lost = {spring.name: work["link", i] for i, spring in enumerate(train.springs)}
    lost |= {grip.name: work["grip", i] for i, grip in enumerate(train.grips)}
    lost |= {mesh.name: work["mesh_in", i] - work["mesh_out", i] for i, mesh in enumerate(train.meshes)}
    before, after = system.energy(record.began, start[1]), system.energy(record.mode, record.state)
    turned = sum(abs(work["mesh_in", i]) for i in range(len(train.meshes)))
    gone = sum(lost.values()) + record.lost
    scale = max(abs(before) + abs(after), _kinetic(system, record), turned, *map(abs, put_in.values()))
    left = residual(sum(put_in.values()), gone, after - before, scale)
    return Ledger(put_in, lost, record.lost, after - before, left)


def _kinetic(system: TrainSystem, record: Record) -> float:
    """Kinetic energy with every body at its largest speed: what a train that ends where it began has turned over."""
    fastest = [system.watched["speed", index] for index in range(len(system.train.bodies))]
    speeds = np.maximum(record.top.values[fastest], -record.bottom.values[fastest])
    return float(np.array([body.inertia for body in system.train.bodies]) @ speeds**2) / 2
