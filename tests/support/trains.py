"""Trains for the marcher: run with their energy ledger held closed, read by name; and those of `hybrid` translated."""

from dataclasses import dataclass

import numpy as np

from ptmcalc.numerics.piecewise import march
from ptmcalc.numerics.record import Record
from ptmcalc.numerics.train.ledger import Ledger, ledger
from ptmcalc.numerics.train.parts import Body, Drive, Grip, Mesh, Spring, Train
from ptmcalc.numerics.train.signals import Signal, Sine
from ptmcalc.numerics.train.system import TrainSystem
from support.hybrid import Course, Machine

LINEAR_CLOSES = 1e-9


@dataclass(frozen=True)
class Run:
    """A march of a train; signals are named as ("speed", 0)."""

    system: TrainSystem
    record: Record
    ledger: Ledger

    def last(self, what: str, index: int = 0) -> float:
        return float(self.record.last[self.system.watched[what, index]])

    def top(self, what: str, index: int = 0) -> float:
        return float(self.record.top.values[self.system.watched[what, index]])

    def bottom(self, what: str, index: int = 0) -> float:
        return float(self.record.bottom.values[self.system.watched[what, index]])

    def top_at(self, what: str, index: int = 0) -> float:
        return float(self.record.top.at[self.system.watched[what, index]])

    def work(self, what: str, index: int = 0) -> float:
        return float(self.record.integrals[list(self.system.works).index((what, index))])

    def events(self, element: str | None = None) -> list[tuple[float, str, str]]:
        """(time, before, after) of one element, or of all."""
        return [(float(e.time), e.before, e.after) for e in self.record.events if element in (None, e.element)]

    def times(self, element: str | None = None) -> list[float]:
        return [time for time, _, _ in self.events(element)]

    def history(self, what: str, index: int = 0) -> tuple[np.ndarray, np.ndarray]:
        """Times and values of a signal that was kept."""
        assert self.record.samples is not None
        values = np.concatenate(self.record.samples.values)[:, self.system.watched[what, index]]
        return np.concatenate(self.record.samples.times), values


def run(train: Train, end: float, closes: float = LINEAR_CLOSES, **options: object) -> Run:
    """A march to `end`, whose energy ledger must close."""
    system = TrainSystem(train)
    start = system.start()
    record = march(system, *start, end=end, **options)  # type: ignore[arg-type]
    found = ledger(system, start, record)
    assert found.residual <= closes, f"energy residual {found.residual:.3g}"
    assert np.isfinite(record.state).all()
    assert record.finished or record.time == end
    return Run(system, record, found)


def signal(course: Course) -> Signal:
    """A course of `hybrid` as a signal."""
    times, values, slopes = zip(*course.pieces, strict=True)
    return Signal(times, values, slopes, tuple(Sine(*wave) for wave in course.sines))


def train_of(machine: Machine) -> Train:
    """A machine of `hybrid` (torques over time only) as a train: bodies b0.., gears g0.., links l0.., brakes k0.."""
    assert all(torque.over is None for torque in machine.torques)
    bodies = zip(machine.inertias, machine.positions, machine.speeds, strict=True)
    return Train(
        tuple(Body(f"b{i}", *body) for i, body in enumerate(bodies)),
        tuple(
            Mesh(f"g{i}", one.inner, one.outer, one.ratio, one.forward, one.reverse)
            for i, one in enumerate(machine.gears)
        ),
        tuple(
            Spring(
                f"l{i}", one.first, one.second, one.stiffness, one.damping, one.play, one.law, one.side, one.rest,
                dissipation=one.dissipation, exponent=one.exponent,
            )
            for i, one in enumerate(machine.links)
        ),
        tuple(
            Grip(f"k{i}", one.first, one.second, signal(one.capacity), one.static)
            for i, one in enumerate(machine.brakes)
        ),
        tuple(Drive.of(f"m{i}", one.body, signal(one.course)) for i, one in enumerate(machine.torques)),
    )  # fmt: skip
