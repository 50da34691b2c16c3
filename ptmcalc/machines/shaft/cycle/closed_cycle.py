"""The exact steady cycle: the motion that closes, and the flywheel with which it is as even as wanted."""

import math

import numpy as np

from ptmcalc.base import units
from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Found, History, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import shaft as law
from ptmcalc.machines.shaft.cycle import impossible
from ptmcalc.machines.shaft.cycle.bounds import cycle_shares
from ptmcalc.machines.shaft.cycle.loads import OF_CYCLE
from ptmcalc.machines.shaft.machine.cases import cycle_of, inertia_forced_off, machine_in
from ptmcalc.machines.shaft.machine.ledger import Ledger, booked, over_angle
from ptmcalc.machines.shaft.machine.model import Machine
from ptmcalc.machines.shaft.machine.results import FLOOR, MARGIN, bar, result_of
from ptmcalc.machines.shaft.machine.spec import Shaft, Steady
from ptmcalc.machines.shaft.machine.steady import Cycle, closed_cycle, light_cycle
from ptmcalc.numerics.cycle import Orbit

_MOST_SECANTS = 40
"""Secant steps [1] for the flywheel in each of the two searches. A numerical choice: the secant method converges in a
few steps. Fewer refuse flywheels with NUM101; more only delay the refusal."""
_NEAR, _FLYWHEEL = 1e-3, 1e-11
"""Relative deviation [1] from the required irregularity on the stretches of the cycle without flywheel, and on its own.
A numerical choice: 1e-3 suffices as a start; 1e-11 is near the rounding of the irregularity. A larger `_FLYWHEEL`
widens the error bar; a smaller one may not converge."""
_LARGEST_FLYWHEEL = 1e6  # times the present inertia


def run(spec: Shaft, scene: Steady, carried: frozenset[str], level: int) -> Result:
    """Loads of the steady cycle from the equation of motion, with the motor curve at every moment.

        de/dphi = eps(phi, e),  e = w^2/2,   w(0) = w(Theta)

    The segments of a cycle are solved by collocation with 12 nodes in the angle. Newton's method finds the periodic
    cycle as the fixed point of the Poincare map, without a transient run. Segments end at every discontinuity of the
    angle and are divided until the polynomials have a negligible remainder. The flywheel inertia gives the required
    speed fluctuation of that cycle. A stalling motor is detected by the map: it is below its argument at every speed.

    **Range** rigid links, one degree of freedom, rotation in one sense.
    **Error** twice the difference to the same segments with 8 nodes, whose own error is far larger, and 1e-10 for
    rounding. If the work balance, by a separate quadrature, has an error above 1e-8, there is no result.
    **Source** Radau IIA: Hairer and Wanner, Solving ordinary differential equations II; derived in `numerics.cycle`.
    """
    if machine_in(spec, scene).races:
        return impossible.races(spec, scene)
    cycle = cycle_of(spec, scene.load, mean_inertia="varying_inertia" not in carried)
    if cycle is None:
        return impossible.stalls(spec, scene)
    books = _works(cycle.machine, cycle.orbit)
    fine, rough = (_loads_of(cycle, orbit) for orbit in (cycle.orbit, cycle.rough))
    loads = {name: Found(bar(value, rough[name][0]), at) for name, (value, at) in fine.items()}
    work, wanted = cycle.work, spec.checks.irregularity
    if wanted is not None:
        estimate, used = _flywheel(cycle, wanted)
        loads["flywheel_inertia"] = Found(estimate)
        work += used
    _, speeds, weights = cycle.speeds()
    period = float(np.sum(weights / speeds))
    return result_of(loads, books, work, len(cycle.orbit.start), period, lambda: _histories(cycle))


def _works(machine: Machine, orbit: Orbit) -> Ledger:
    """The works of a steady cycle."""
    return booked(machine, [over_angle(machine, orbit, len(machine.drive.stages) - 1)], 0.0)


def _histories(cycle: Cycle) -> dict[str, History]:
    """Speed and motor torque over the time of a cycle."""
    _, speed, weights = (values.ravel() for values in cycle.speeds(8))
    time = np.cumsum(weights / speed) - weights / speed / 2
    drive = cycle.machine.drive
    torque = drive.torque(len(drive.stages) - 1, speed)
    return {
        "speed_max": History(units.ANGULAR_SPEED, time.tolist(), speed.tolist()),
        "torque_motor_max": History(units.TORQUE, time.tolist(), torque.tolist()),
    }


def _loads_of(cycle: Cycle, orbit: Orbit) -> dict[str, tuple[float, dict[str, float]]]:
    """Loads of an orbit and where they occur."""
    (low, at_low), (high, at_high) = orbit.extremes()
    slow, fast = math.sqrt(2 * low), math.sqrt(2 * high)
    books = _works(cycle.machine, orbit)
    most, at_most = _largest_torque(cycle.machine, orbit)
    values = {
        "speed_max": (fast, {"angle": at_high}),
        "speed_min": (slow, {"angle": at_low}),
        "speed_mean": ((fast + slow) / 2, {}),
        "irregularity": (float(law.irregularity(fast, slow)), {}),
        "torque_motor_rms": (books.motor_rms, {}),
        "torque_motor_max": (most, {"angle": at_most}),
        "work_drive": (books.drive, {}),
        "work_useful": (books.useful, {}),
        "work_loss": (books.loss, {}),
    }
    efficiency, lost = cycle_shares(books.useful, books.loss)
    return values | {"cycle_efficiency": (efficiency, {}), "loss_factor": (lost, {})}


def _largest_torque(machine: Machine, orbit: Orbit) -> tuple[float, float]:
    """Largest motor torque either way over a cycle, and its angle: at the extremes of the speed, and at samples where
    the curve of the motor has its own largest value in between."""
    places = np.linspace(0.0, 1.0, 41)
    (low, at_low), (high, at_high) = orbit.extremes()
    angles = np.append((orbit.grid.edges[:-1, None] + orbit.grid.lengths[:, None] * places).ravel(), [at_low, at_high])
    e = np.append(orbit.within(places).ravel(), [low, high])
    torque = np.abs(machine.drive.torque(len(machine.drive.stages) - 1, np.sqrt(2 * np.maximum(e, 0.0))))
    top = int(np.argmax(torque))
    return float(torque[top]), float(angles[top])


def _irregularity(orbit: Orbit) -> float:
    (low, _), (high, _) = orbit.extremes()
    return float(law.irregularity(math.sqrt(2 * high), math.sqrt(2 * low)))


def _flywheel(cycle: Cycle, wanted: float) -> tuple[Estimate, int]:
    """The inertia to be added so that the irregularity of the cycle is the one wanted.

    A root in 1/delta, which is nearly a straight line: on the stretches of the cycle without a flywheel first, then
    corrected on its own.
    """
    delta = _irregularity(cycle.orbit)
    if delta <= wanted:
        return Estimate.exact(0.0), 0
    orbit, work = cycle.orbit, 0
    before, at_before = 0.0, wanted / delta - 1
    added = cycle.machine.survey.inertia_mean * (delta / wanted - 1)
    slope = 0.0
    for _ in range(_MOST_SECANTS):
        found = light_cycle(cycle.machine.with_flywheel(added), orbit)
        work += found.work if found else 0
        if found is None:
            raise NumericsError("NUM101", "no steady cycle exists with one of the flywheels of the search")
        orbit = found.orbit
        at = wanted / _irregularity(orbit) - 1
        slope = (at - at_before) / (added - before) if added != before else slope
        if abs(at) <= _NEAR or not slope > 0:
            break
        before, at_before = added, at
        added = min(max(added - at / slope, added / 8), 8 * added)
        if added > _LARGEST_FLYWHEEL * cycle.machine.survey.inertia_mean:
            return Estimate.unknown(math.inf), work
    return _corrected(cycle, wanted, added, slope, work, orbit)


def _corrected(
    cycle: Cycle, wanted: float, added: float, slope: float, work: int, orbit: Orbit
) -> tuple[Estimate, int]:
    """The flywheel on stretches of its own, with its bar."""
    before = at_before = math.nan
    for _ in range(_MOST_SECANTS):
        found = closed_cycle(cycle.machine.with_flywheel(added), orbit)
        if found is None or not slope > 0:
            raise NumericsError("NUM101", "no flywheel inertia was found")
        work, orbit = work + found.work, found.orbit
        delta, rough = _irregularity(found.orbit), _irregularity(found.rough)
        at = wanted / delta - 1
        if added != before and (at - at_before) / (added - before) > 0:
            slope = (at - at_before) / (added - before)
        if abs(at) <= _FLYWHEEL:
            break
        before, at_before, added = added, at, max(added - at / slope, added / 8)
    else:
        raise NumericsError("NUM101", "no flywheel inertia was found")
    off = MARGIN * wanted * abs(1 / delta - 1 / rough) + abs(at) + FLOOR
    return Estimate.within(added, off / slope + FLOOR * added), work


def cost(spec: Shaft, scene: Steady, carried: frozenset[str], level: int) -> float:
    """Predicted seconds: some tenths of a millisecond for each stretch of the angle, three times with a flywheel."""
    stretches = len(machine_in(spec, scene).corners) + 8
    return 2.5e-4 * stretches * (3 if spec.checks.irregularity is not None else 1)


CLOSED_CYCLE: Solver[Shaft, Steady] = Solver(
    name="closed_cycle",
    title="periodic cycle, motor curve and varying inertia",
    fidelity=Fidelity.TRANSIENT,
    scenes=frozenset({Steady}),
    represents=frozenset({"varying_inertia", "motor_slope"}),
    gives=OF_CYCLE,
    run=run,
    cost=cost,
    source="Radau collocation; derived in ptmcalc.numerics.cycle",
    always=frozenset({"varying_inertia", "motor_slope"}),
)

MEAN_CYCLE: Solver[Shaft, Steady] = Solver(
    name="closed_mean_cycle",
    title="periodic cycle, motor curve and mean inertia",
    fidelity=Fidelity.TRANSIENT,
    scenes=frozenset({Steady}),
    represents=frozenset({"motor_slope"}),
    gives=OF_CYCLE,
    run=run,
    cost=cost,
    source="Radau collocation; derived in ptmcalc.numerics.cycle",
    valid=inertia_forced_off,
    always=frozenset({"motor_slope"}),
)
