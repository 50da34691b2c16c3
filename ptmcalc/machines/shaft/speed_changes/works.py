"""Works of a run-up or a run-out, its skipped cycles included."""

from dataclasses import replace

import numpy as np

from ptmcalc.machines.shaft.machine.ledger import ORDER, Ledger, Nodes, booked, over_angle
from ptmcalc.machines.shaft.machine.model import Machine
from ptmcalc.machines.shaft.speed_changes.motion import Part, Run


def works_of(run: Run) -> Ledger:
    """The works of a run-up or a run-out."""
    machine, nodes = run.machine, []
    skipped: list[Part] = []
    for part in run.parts:
        if part.orbit is not None:
            nodes.append(over_angle(machine, part.orbit, part.stage))
        if part.skipped is not None:
            skipped.append(part)
        for step in part.steps:
            time, angle, speed, acceleration, weight = step.sample(ORDER)
            if part.stage is None:
                motor, brake = np.zeros(time.shape), machine.brake_torque(time)
            else:
                motor, brake = machine.drive.torque(part.stage, speed, time), np.zeros(time.shape)
            nodes.append(Nodes(angle, part.low, part.high, speed, acceleration, weight, motor, brake))
    ends = [machine.mechanism(np.array([state.angle]))[0][0] * state.speed**2 / 2 for state in (run.begin, run.end)]
    inertia = float(machine.mechanism(np.zeros(1))[0][0])
    leaps = [part.skipped for part in skipped if part.skipped is not None]
    leapt = sum(inertia * (leap.energy - leap.trace[0][2]) for leap in leaps)
    books = booked(machine, nodes, float(ends[1] - ends[0]) - leapt)
    return _with_leaps(machine, books, skipped)


def _with_leaps(machine: Machine, books: Ledger, parts: list[Part]) -> Ledger:
    """With the work of the brake over cycles that were skipped, and the worst balance of the cycles they rest on."""
    brake, residual = books.brake, books.residual
    inertia = float(machine.mechanism(np.zeros(1))[0][0])
    for part in parts:
        assert part.skipped is not None
        if part.stage is None:
            brake += machine.brake_most * machine.period * part.skipped.cycles
        for orbit in part.skipped.orbits:
            stored = inertia * float(orbit.within([1.0])[-1, 0] - orbit.start[0])
            residual = max(residual, booked(machine, [over_angle(machine, orbit, part.stage)], stored).residual)
    return replace(books, brake=brake, residual=residual)
