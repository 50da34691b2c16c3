"""Heating of a motor over its cycle: equivalent torque, duty factor, and how often it may be switched.

A motor heats by its losses and cools by the air it moves. At rest a motor with a fan on its shaft cools worse: so much
as `REST_COOLING` says of what it does at speed. While it starts and stops the mean of both is taken.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
Pieces = Sequence[float] | FloatArray
"""One number for each piece of a cycle."""

REST_COOLING: Mapping[str, float] = MappingProxyType(
    {"self_ventilated": 0.33, "self_ventilated_closed": 0.5, "unventilated": 0.95, "separately_ventilated": 1.0}
)
"""Cooling at rest over cooling at speed [1], by the way a motor is cooled; the first is the careful choice for any.

Usual ranges: 0.25 to 0.35 with a fan on the shaft and an open frame, 0.45 to 0.55 with a closed one, 0.95 to 0.98
closed without a fan, 1 with a fan of its own (Chilikin and Sandler, General course of electric drive, Moscow 1981).
"""


@dataclass(frozen=True, slots=True)
class DutyType:
    """A duty type of IEC 60034-1: what the motor does, and what is compared with its rating."""

    meaning: str
    compared: str
    at_rest: bool
    """whether the cycle has a rest"""
    counts_starts: bool
    """whether the heat of starting (and electric braking) is part of the rating"""


DUTY_TYPES: Mapping[str, DutyType] = MappingProxyType(
    {
        "S1": DutyType(
            "continuous running: constant load until the temperature is steady",
            "the steady torque with the rated torque",
            at_rest=False,
            counts_starts=False,
        ),
        "S2": DutyType(
            "short-time: constant load for 10, 30, 60 or 90 min from cold, then rest until it is cold again",
            "the torque and its duration with the rated ones",
            at_rest=True,
            counts_starts=False,
        ),
        "S3": DutyType(
            "intermittent periodic: equal cycles of load and rest, the starts do not heat (15, 25, 40, 60 % of 10 min)",
            "the equivalent torque of the time under load with the torque of the rated duty factor",
            at_rest=True,
            counts_starts=False,
        ),
        "S4": DutyType(
            "intermittent periodic with starting: as S3, and the starts heat",
            "the equivalent torque of the cycle with its starts, and the starts per hour",
            at_rest=True,
            counts_starts=True,
        ),
        "S5": DutyType(
            "intermittent periodic with electric braking: as S4, and the motor brakes",
            "the equivalent torque of the cycle with its starts and stops, and the switchings per hour",
            at_rest=True,
            counts_starts=True,
        ),
        "S6": DutyType(
            "continuous operation, periodic: equal cycles of load and no load, never at rest",
            "the equivalent torque of the whole cycle with the continuous torque",
            at_rest=False,
            counts_starts=False,
        ),
        "S7": DutyType(
            "continuous operation, periodic, with electric braking: start, load, braking, never at rest",
            "the equivalent torque of the cycle with its starts and stops, and the switchings per hour",
            at_rest=False,
            counts_starts=True,
        ),
        "S8": DutyType(
            "continuous operation, periodic, with changes of load and speed, never at rest",
            "the losses over the cycle at each speed with those of the rating: a torque alone does not determine them",
            at_rest=False,
            counts_starts=True,
        ),
        "S9": DutyType(
            "loads and speeds that change without a period, with frequent overloads",
            "the largest torque with the overload limit; the heating with that of a continuous reference torque",
            at_rest=True,
            counts_starts=True,
        ),
        "S10": DutyType(
            "discrete constant loads (and speeds), each until the temperature is steady",
            "the thermal life the loads use up together with that of the reference load",
            at_rest=True,
            counts_starts=False,
        ),
    }
)
"""The duty types of IEC 60034-1."""


def rms_torque(torques: Pieces, times: Pieces, cooling: Pieces | float = 1.0) -> float:
    """Torque that heats a motor as much as a cycle of constant torques.

        M = sqrt( sum M_i^2 t_i / sum k_i t_i )

    Args:
        torques: M_i, in each piece of the cycle, 0 at rest [N*m].
        times: t_i, duration of each piece [s].
        cooling: k_i, cooling in each piece over that at speed: 1 in motion, at rest k_0 of `REST_COOLING`, in starting
            and stopping (1 + k_0)/2; 0 at rest leaves the rest out [1].

    Returns:
        M [N*m].

    Raises:
        ValueError: the cycle takes no time, or nothing cools in it.

    **Range** losses that go with the square of the torque: constant flux, on the straight part of an induction motor's
    curve; direct starts of a cage motor heat more, see `switching_heat`. A cycle much shorter than the motor's time
    constant of heating (10 min against 20 to 90 min).
    **Error** the constant losses are left out: on the safe side where sum k_i t_i is above the time the motor is on.
    **Source** equal heat over the cycle; duty types of IEC 60034-1.
    """
    return equivalent_torque(torques, torques, times, cooling)


def equivalent_torque(
    torques_before: Pieces, torques_after: Pieces, times: Pieces, cooling: Pieces | float = 1.0
) -> float:
    """Torque that heats a motor as much as a cycle of torques that change in straight lines.

        M = sqrt( sum (M_1^2 + M_1 M_2 + M_2^2)_i t_i / 3 / sum k_i t_i )

    Args:
        torques_before: M_1, at the beginning of each piece [N*m].
        torques_after: M_2, at the end of each piece [N*m].
        times: t_i, duration of each piece [s].
        cooling: k_i, as in `rms_torque` [1].

    Returns:
        M [N*m].

    Raises:
        ValueError: the cycle takes no time, or nothing cools in it.

    **Range** as `rms_torque`.
    **Error** exact for straight pieces.
    **Source** the square of a straight line integrated; as `rms_torque`.
    """
    before, after = np.asarray(torques_before, float), np.asarray(torques_after, float)
    span = np.asarray(times, float)
    cooled = float(np.sum(np.asarray(cooling, float) * span))
    if not cooled > 0:
        raise ValueError("the cycle takes no time, or nothing cools the motor in it")
    scale = float(np.max(np.maximum(np.abs(before), np.abs(after)), initial=0.0))
    if scale == 0:
        return 0.0
    m1, m2 = before / scale, after / scale
    squares = ((m1 + m2) ** 2 / 4) + (m1 - m2) ** 2 / 12  # the mean square, as a sum that cannot cancel
    return scale * math.sqrt(float(np.sum(squares * (span / cooled))))


def duty_factor(running_time: float, rest_time: float) -> float:
    """Cyclic duration factor: the share of a cycle in which the motor is on.

        ED = t_b / (t_b + t_0)

    Args:
        running_time: t_b, with starting and electric braking; in S6 the time under load [s].
        rest_time: t_0; in S6 the time without load [s].

    Returns:
        ED [1].

    **Range** equal cycles of no more than 10 min; rated ones are 15, 25, 40 and 60 %.
    **Error** exact.
    **Source** IEC 60034-1.
    """
    return running_time / (running_time + rest_time)


def permissible_torque(
    rated_torque: float, rated_duty: float, duty: float, loss_ratio: float = 0.0, rest_cooling: float = 1.0
) -> float:
    """Torque a motor bears at another duty factor than its rated one.

        M = M_r sqrt( (1 + alpha) B(ED_r) / B(ED) - alpha ),  B(ED) = ED / (ED + k_0 (1 - ED))
        with alpha = 0 and k_0 = 1:  M = M_r sqrt(ED_r / ED)

    Args:
        rated_torque: M_r, at the rated duty factor [N*m].
        rated_duty: ED_r; 1 for continuous duty [1].
        duty: ED, of the cycle [1].
        loss_ratio: alpha, constant losses over those that go with the torque, at the rating; 0 leaves them out [1].
        rest_cooling: k_0, cooling at rest over that at speed, see `REST_COOLING`; 1 makes no difference [1].

    Returns:
        M [N*m].

    Raises:
        ValueError: the constant losses alone heat too much.

    **Range** the short form from 15 to 60 % both, cycles of no more than 10 min, starts that do not heat; from or to
    continuous duty give the cooling at rest: a motor with its own fan gains less (1.41 against 2 times from
    continuous duty to 25 %, k_0 = 0.33). The largest torque stays what it is: compare it with the overload limit.
    **Error** the long form is exact for a motor of one temperature, the short one where alpha = 0 and k_0 = 1 hold.
    **Source** derived: heat over the cycle equal to that carried off; the short form is the usual one.
    """
    share, rated_share = (ed / (ed + rest_cooling * (1 - ed)) for ed in (duty, rated_duty))
    square = rated_share / share + loss_ratio * ((rated_share - share) / share)
    if square < 0:
        raise ValueError("the constant losses alone heat the motor too much at this duty factor")
    return rated_torque * math.sqrt(square)


def switching_heat(
    inertia: float,
    synchronous_speed: float,
    from_slip: float,
    to_slip: float,
    stator_ratio: float = 0.0,
    load_share: float = 0.0,
) -> float:
    """Heat in the windings of an induction motor while it changes its speed.

        A = 1/2 J w0^2 (s_1^2 - s_2^2) (1 + a) / (1 - m)

    Args:
        inertia: J, of the motor and all it moves, reduced to its shaft [kg*m^2].
        synchronous_speed: w0 [rad/s].
        from_slip: s_1, at the beginning: 1 at rest, 2 when the field is reversed at full speed [1].
        to_slip: s_2, at the end [1].
        stator_ratio: a = R_1/R_2', resistance of the stator over that of the whole rotor circuit; 0 gives the heat of
            the rotor circuit alone [1].
        load_share: m, load torque over motor torque, below 1; negative where the load helps the change [1].

    Returns:
        A [J].

    **Range** direct switching or rheostat, field of constant speed; of a rheostat start most of it stays in the
    resistances.
    **Error** exact for m constant over the change; else take the mean torques.
    **Source** derived: the rotor loses M s w0, the stator a times that, and J w0 ds/dt = -M (1 - m).
    """
    field_energy = inertia * synchronous_speed**2 / 2
    return field_energy * (from_slip - to_slip) * (from_slip + to_slip) * (1 + stator_ratio) / (1 - load_share)


def permissible_switching_rate(
    rated_loss: float, running_loss: float, duty: float, rest_cooling: float, heat: float
) -> float:
    """How often a motor may be switched for the heat it carries off.

        Z = ((P_n - P) ED + P_n k_0 (1 - ED)) / A

    Args:
        rated_loss: P_n, losses at the continuous rating, P (1/eta - 1) [W].
        running_loss: P, losses at the load of the cycle between its switchings [W].
        duty: ED, of the cycle without its switchings [1].
        rest_cooling: k_0, cooling at rest over that at speed, see `REST_COOLING` [1].
        heat: A, of the start and the electric braking of one cycle, see `switching_heat` [J].

    Returns:
        Z, starts per second, 3600 Z per hour; 0 where running alone heats too much [Hz].

    **Range** many starts in the motor's time constant of heating; continuous rating (S1).
    **Error** starts count as short; a cage that is heated before the winding is not seen: the maker's limit of starts
    per hour holds beside it.
    **Source** derived: heat brought in per cycle equal to heat carried off; Chilikin and Sandler, General course of
    electric drive, Moscow 1981.
    """
    spare = (rated_loss - running_loss) * duty + rated_loss * rest_cooling * (1 - duty)
    return max(spare, 0.0) / heat


def load_factor(load: float, constant_share: float, rest_cooling: float) -> float:
    """Permitted starts of a motor that runs on between its starts, relative to no-load starts of the same heat.

        k_P = 2 (1 - v) (1 - p^2)/(1 - v + k_0)

    Args:
        load: p, torque of the running motor over its rated torque [1].
        constant_share: v, part of the rated losses that the load does not change [1].
        rest_cooling: k_0, cooling at rest over that at speed, see `REST_COOLING` [1].

    Returns:
        k_P; 0 where running alone heats as much as the rating or more [1].

    **Range** many starts in the motor's time constant of heating; the no-load starts are those of a duty factor of
    50 %, the running is continuous.
    **Error** exact for losses that rise with the square of the torque.
    **Source** derived: ratio of two `permissible_switching_rate` of one heat, with losses v + (1 - v) p^2 at a duty
    factor of 100 % and v at 50 %.
    """
    running = permissible_switching_rate(1.0, constant_share + (1 - constant_share) * load**2, 1.0, rest_cooling, 1.0)
    return running / permissible_switching_rate(1.0, constant_share, 0.5, rest_cooling, 1.0)
