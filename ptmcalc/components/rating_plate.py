"""A cage motor of which only the rating plate is known: power, and rated speed or number of poles."""

import math
from dataclasses import dataclass
from functools import cache

import numpy as np

from ptmcalc.base.estimate import Interval
from ptmcalc.catalogue.table import rows
from ptmcalc.components.motor import InductionMotor
from ptmcalc.components.motor_stage import FloatArray, Stage

FREQUENCY = 50.0
"""Frequency of the supply [Hz] of a motor whose number of poles is given."""
_FREQUENCIES = (50.0, 60.0)
_MOST_SLIP = 0.12
"""Largest rated slip of a cage motor [1] by which the synchronous speed is found. An engineering choice: motors of
0.37 kW have 0.09. A larger value makes the speed of more poles ambiguous."""
_PULL_UP_AT, _PULL_UP = 1 / 3, 0.85
"""Speed of the pull-up torque relative to the synchronous speed [1]; pull-up torque relative to the locked-rotor torque
[1]. Engineering choices: catalogues state 0.2 to 0.5 and 0.7 to 1."""
POLES = (4, 6)
"""Numbers of poles for which typical values are known."""


@dataclass(frozen=True, slots=True)
class Typical:
    """Typical values of a cage motor: usual value and interval of each."""

    slip: tuple[float, Interval]
    locked_rotor: tuple[float, Interval]
    breakdown: tuple[float, Interval]
    inertia: tuple[float, Interval]


@cache
def typical(poles: int, power: float) -> Typical:
    """Typical values of a cage motor of a rated power.

        interpolated over log P;   beyond the table the ratios of its end, and an inertia in proportion to P

    Args:
        poles: 4 or 6.
        power: P, rated power [W].

    Returns:
        Rated slip, locked-rotor torque and breakdown torque over the rated torque, inertia [kg*m^2].

    **Range** 0.37 kW to 315 kW (4 poles), 250 kW (6 poles); beyond it an extrapolation.
    **Error** as the intervals state.
    **Source** `catalogue/cage_motors.csv`.
    """
    table = [row for row in rows("cage_motors") if int(row["poles"]) == poles]
    at = np.log([float(row["power"]) for row in table])
    inside = float(np.clip(math.log(power), at[0], at[-1]))

    def found(name: str, exponent: float = 0.0) -> tuple[float, Interval]:
        usual, low, high = (
            float(np.exp(np.interp(inside, at, np.log([float(row[column]) for row in table]))))
            * math.exp(exponent * (math.log(power) - inside))
            for column in (name, f"{name}_low", f"{name}_high")
        )
        return usual, Interval(min(low, usual), max(high, usual))

    return Typical(found("slip"), found("locked_rotor"), found("breakdown"), found("inertia", 1.0))


def synchronous_speed(speed: float) -> float | None:
    """Synchronous speed of a motor with a rated speed [rad/s]: the next one above it, at 50 or 60 Hz; None where none
    is near."""
    pairs = range(1, 13)
    every = [2 * math.pi * frequency / pair for frequency in _FREQUENCIES for pair in pairs]
    above = [one for one in every if speed < one <= speed / (1 - _MOST_SLIP)]
    return min(above, default=None)


def speed_of_poles(poles: int) -> float:
    """Synchronous speed of a number of poles at 50 Hz [rad/s]."""
    return 4 * math.pi * FREQUENCY / poles


def poles_at(synchronous: float) -> int:
    """Number of poles of a synchronous speed, at 50 or 60 Hz; 0 where there is none."""
    for frequency in _FREQUENCIES:
        poles = 4 * math.pi * frequency / synchronous
        if abs(poles - round(poles)) < 1e-6 and round(poles) % 2 == 0:
            return round(poles)
    return 0


class CageMotor(InductionMotor):
    """A cage motor switched on directly: straight lines through the locked-rotor, the pull-up and the breakdown torque,
    and the formula of Kloss above the breakdown speed.

    The formula alone has 0.3 to 0.6 of the locked-rotor torque of a cage with current displacement.
    """

    locked_rotor_ratio: float
    """locked-rotor torque / rated torque"""

    @property
    def stages(self) -> tuple[Stage, ...]:
        natural = self._stage()
        formula, slope = natural.formula, natural.slope
        assert formula is not None
        assert slope is not None
        top = (1 - self.breakdown_slip) * self.synchronous_speed
        rest = self.locked_rotor_ratio * self.rated
        knots = ((0.0, rest), (min(_PULL_UP_AT * self.synchronous_speed, top / 2), _PULL_UP * rest),
                 (top, self.breakdown_torque))  # fmt: skip
        speeds, torques = np.array(knots).T

        def torque(speed: FloatArray) -> FloatArray:
            return np.where(speed > top, formula(speed), np.interp(speed, speeds, torques))

        def rise(speed: FloatArray) -> FloatArray:
            inside = np.searchsorted(speeds, speed).clip(1, len(speeds) - 1)
            line = (np.diff(torques) / np.diff(speeds))[inside - 1]
            return np.where(speed > top, slope(speed), np.where(speed < 0, 0.0, line))

        return (Stage(formula=torque, slope=rise, kloss=natural.kloss, knots=knots),)


def plate_motor(power: float, speed: float, synchronous: float, locked_rotor: float, breakdown: float) -> CageMotor:
    """The motor of a rating plate: power [W], speeds [rad/s], torques relative to the rated one."""
    return CageMotor.model_construct(
        type="induction",
        power=power,
        speed=speed,
        synchronous_speed=synchronous,
        overload=max(breakdown, _LEAST_BREAKDOWN),
        locked_rotor_ratio=locked_rotor,
        formula="simplified",
        stator_ratio=None,
        largest_torque=None,
    )


_LEAST_BREAKDOWN = 1.0 + 1e-9
"""Smallest breakdown ratio for which the formula of Kloss has a stable branch [1]; a numerical choice."""
