"""A start of the rigid chain under motors on their curve, until it runs steadily."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Estimate
from ptmcalc.base.memory import kept_for
from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.chain_drive.machine import loops
from ptmcalc.machines.chain_drive.machine.model import FloatArray
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, Start
from ptmcalc.machines.chain_drive.starting.bounds import static_at
from ptmcalc.machines.chain_drive.starting.motion import StartCase, start_case
from ptmcalc.machines.chain_drive.starting.motor_force import gear_of, start_force
from ptmcalc.numerics import driven_modes
from ptmcalc.numerics.driven_body import Body, Followed, Places, Plan

_X = np.linspace(0.0, 1.0, 33)
"""Shares of a strand at which the tension of the rigid chain is read [1]; it is linear between them."""
_STEPS = 5
"""Steps of the rigid chain within the shortest time constant of its motors; a numerical choice. The difference from
half as many is in the error bar."""
_MOST = 20_000
"""Most steps of the rigid chain. A numerical choice: a start that takes more has no bound."""
_LEFT = 1e-3
"""Force that may be left to come at the end, relative to the tension at the entering strand [1]; a numerical choice. A
smaller value follows the chain longer."""
_SHORT = 1e-9
"""Shortest start time for the step [s]; a numerical choice far below any start."""
_WAVES = ((CARRY, np.ones(1)), (RETURN, _X), (CARRY, _X))


@dataclass(frozen=True, slots=True)
class RigidStart:
    """A start of the rigid chain: largest dynamic entering tension and smallest tension anywhere [N], half of the total
    variation of the force [N], release and end [s]; times since the release [s], accelerations [m/s^2], speeds [m/s]
    and travels [m] between which the acceleration is linear."""

    dynamic: Estimate
    smallest: Estimate
    swing: float
    release: float
    end: float
    times: FloatArray
    accelerations: FloatArray
    speeds: FloatArray
    travels: FloatArray

    @property
    def sharpest(self) -> float:
        """Largest acceleration [m/s^2]."""
        return float(np.abs(self.accelerations).max())

    @property
    def fastest(self) -> float:
        """Largest speed [m/s]."""
        return float(self.speeds.max())

    @property
    def kinks(self) -> tuple[float, ...]:
        """Times at which the acceleration jumps, since the release [s]."""
        return tuple(self.times[1:][np.diff(self.times) <= 0].tolist())

    def reached(self, shares: tuple[float, ...]) -> tuple[float, ...]:
        """Times, from switching on, at which the speed first reaches shares of the largest one [s]."""
        rising = np.maximum.accumulate(self.speeds)
        found = {float(self.times[int(np.argmax(rising >= share * self.fastest))]) for share in shares}
        return tuple(self.release + one for one in sorted(found) if one > 0)

    def acceleration(self, t: FloatArray) -> FloatArray:
        """Acceleration at times since the release [m/s^2]."""
        return np.asarray(np.interp(t, self.times, self.accelerations))

    def speed(self, t: FloatArray) -> FloatArray:
        """Speed at times since the release [m/s]."""
        j, since, slope = self._piece(t)
        return np.asarray(self.speeds[j] + since * (self.accelerations[j] + since * slope / 2))

    def way(self, t: FloatArray) -> FloatArray:
        """Travel at times since the release [m]."""
        j, since, slope = self._piece(t)
        return np.asarray(
            self.travels[j] + since * (self.speeds[j] + since * (self.accelerations[j] / 2 + since * slope / 6))
        )

    def _piece(self, t: FloatArray) -> tuple[NDArray[np.intp], FloatArray, FloatArray]:
        j = np.clip(np.searchsorted(self.times, t, "right") - 1, 0, len(self.times) - 2)
        width = self.times[j + 1] - self.times[j]
        rise = self.accelerations[j + 1] - self.accelerations[j]
        slope = np.divide(rise, width, out=np.zeros_like(width), where=width > 0)
        return j, np.asarray(t) - self.times[j], slope


@kept_for(32)
def rigid_start(spec: ChainDrive, scene: Start) -> RigidStart | None:
    """A start of the rigid chain on the curve of its motors; None where they do not move it, or take too many steps.

        M V' = e M(t, V) i/R - W,   S = S_static + r V'

    **Range** any start on a curve.
    **Error** the difference from steps twice as long, second order.
    **Source** Newton's law; steps of `numerics.driven_modes` without modes.
    """
    case = start_case(spec, scene)
    try:
        return _followed(spec, scene, case)
    except NumericsError:
        return None


def _followed(spec: ChainDrive, scene: Start, case: StartCase) -> RigidStart | None:
    force, loop = start_force(spec, case), case.masses
    release = force.release
    if math.isinf(release):
        return None
    none, mass = np.zeros(0), loop.total_mass
    step = max(case.end, _SHORT) / _STEPS if math.isfinite(case.end) and case.end > 0 else math.inf
    whole = np.concatenate([loops.quasi_static(loop, *one) for one in _WAVES]) / mass
    places = Places(np.zeros((0, len(whole))), whole, np.zeros(len(whole)), np.full(len(whole), mass))
    body, gear = Body(mass, none, none, none, 0.0), gear_of(spec, case)
    step = min([step, *(rise / _STEPS for rise in (force.motors.fill, *force.kinks) if rise > 0)])
    plan = Plan(release, step, 1 / _STEPS, _LEFT * abs(case.line.run_on), 0, most=_MOST)
    fine, coarse = (driven_modes.follow(body, gear, force, places, one) for one in (plan, plan.coarser(2)))
    off = max(float(np.abs(fine.largest - coarse.largest).max()), float(np.abs(fine.smallest - coarse.smallest).max()))
    static = np.concatenate([static_at(case, *one) for one in _WAVES])
    lows = (static + fine.smallest)[1:]
    return RigidStart(
        Estimate.within(float(fine.largest[0]), off),
        Estimate.within(float(lows.min()), off),
        _swing(fine),
        release,
        fine.end,
        *_motion(fine, release, mass),
    )


def _motion(found: Followed, release: float, mass: float) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Times since the release, accelerations, speeds and travels at the nodes of a march."""
    times, forces = np.array(found.times) - release, np.array(found.forces) / mass
    widths, rises = np.diff(times), np.diff(forces)
    speeds = np.concatenate([[0.0], np.cumsum(widths * (forces[1:] + forces[:-1]) / 2)])
    gained = widths * (speeds[:-1] + widths * (forces[:-1] / 2 + rises / 6))
    return times, forces, speeds, np.concatenate([[0.0], np.cumsum(gained)])


def _swing(found: Followed) -> float:
    """Half of the total variation of the force, which is 0 before and after: a force that begins and ends at once has
    its size."""
    forces = np.concatenate([[0.0], found.forces, [0.0]])
    return float(np.abs(np.diff(forces)).sum()) / 2
