"""Heat of a drum that slips under its belt, and what two drums carry when one of them slips."""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]


def slip_heat(time: FloatArray, force: FloatArray, rim_speed: FloatArray, belt_speed: FloatArray) -> float:
    """Heat of a slip that is known at some times.

        Q = integral (S_on - S_off) (v_d - v_b) dt

    Args:
        time: t, ascending [s].
        force: S_on - S_off, at these times [N].
        rim_speed: v_d, of the drum's rim [m/s].
        belt_speed: v_b [m/s].

    Returns:
        Q; positive as long as friction opposes the slip [J].

    **Range** force and speeds linear between the times.
    **Error** exact for that; of second order in the step else.
    **Source** power of friction; each step in closed form (`slip_heat_of_linear_change`).
    """
    t, f = np.asarray(time, float), np.asarray(force, float)
    u = np.asarray(rim_speed, float) - np.asarray(belt_speed, float)
    steps = f[:-1] * (2 * u[:-1] + u[1:]) + f[1:] * (u[:-1] + 2 * u[1:])
    return float(np.sum(np.diff(t) * steps) / 6)


def slip_heat_of_linear_change(
    duration: ArrayLike,
    force_first: ArrayLike,
    force_last: ArrayLike,
    slip_speed_first: ArrayLike,
    slip_speed_last: ArrayLike,
) -> FloatArray:
    """Heat of a slip in which force and slip speed change linearly.

        Q = T (F_0 (2 u_0 + u_1) + F_1 (u_0 + 2 u_1)) / 6;   constant force and slip that dies out: Q = F u_0 T/2

    Args:
        duration: T [s].
        force_first: F_0 [N].
        force_last: F_1 [N].
        slip_speed_first: u_0, rim less belt [m/s].
        slip_speed_last: u_1 [m/s].

    Returns:
        Q [J].

    **Range** no change of the sign of u in between.
    **Error** exact.
    **Source** integral of the product of two linear functions.
    """
    f, g = np.asarray(force_first, float), np.asarray(force_last, float)
    u, w = np.asarray(slip_speed_first, float), np.asarray(slip_speed_last, float)
    return np.asarray(np.asarray(duration, float) * (f * (2 * u + w) + g * (u + 2 * w)) / 6)


def slip_distance(time: FloatArray, rim_speed: FloatArray, belt_speed: FloatArray) -> float:
    """Way the rim slides along the belt.

        s = integral |v_d - v_b| dt

    Args:
        time: t, ascending [s].
        rim_speed: v_d [m/s].
        belt_speed: v_b [m/s].

    Returns:
        s [m].

    **Range** speeds linear between the times; a change of sign inside a step is found there.
    **Error** exact for that.
    **Source** definition.
    """
    u = np.asarray(rim_speed, float) - np.asarray(belt_speed, float)
    first, last = np.abs(u[:-1]), np.abs(u[1:])
    whole = first + last
    turned = u[:-1] * u[1:] < 0
    crossed = np.divide(first**2 + last**2, whole, out=np.zeros_like(whole), where=whole > 0)
    return float(np.sum(np.diff(np.asarray(time, float)) * np.where(turned, crossed, whole)) / 2)


def temperature_rise(heat: ArrayLike, heated_mass: ArrayLike, heat_capacity: float) -> FloatArray:
    """Rise of temperature of the zone that takes up the heat of a slip.

        dT = Q / (m c)

    Args:
        heat: Q, of one slip, or the share of it that goes into this body [J].
        heated_mass: m, of the zone: lagging or shell that the heat reaches within the slip, about
            area * density * sqrt(diffusivity * time) [kg].
        heat_capacity: c, per kelvin; rubber about 1700, steel 460 [J/kg].

    Returns:
        dT, in kelvin [1].

    **Range** slips too short for the heat to leave the zone.
    **Error** an upper bound of the zone's mean; its surface may be hotter. The zone is the reader's assumption.
    **Source** first law, adiabatic.
    """
    return np.asarray(np.asarray(heat, float) / (np.asarray(heated_mass, float) * heat_capacity))


def largest_drum_forces(slack_tension: float, exponent_tight: float, exponent_slack: float) -> tuple[float, float]:
    """Most that two drums in a row carry together.

        F_2 = S_off (exp(mu_2 a_2) - 1),   F_1 = S_off exp(mu_2 a_2) (exp(mu_1 a_1) - 1)

    Args:
        slack_tension: S_off, behind drum 2 [N].
        exponent_tight: mu_1 a_1, of drum 1 on the tight side [1].
        exponent_slack: mu_2 a_2, of drum 2 on the slack side [1].

    Returns:
        (F_1 [N], F_2 [N]).

    **Range** drum 2 at its limit; a drum 2 that carries less leaves less for drum 1. Slow belts: with centrifugal
    tension take S_off - rho v^2.
    **Error** as Eytelwein's law.
    **Source** Euler-Eytelwein, drum by drum.
    """
    slack = slack_tension * math.expm1(exponent_slack)
    return (slack_tension + slack) * math.expm1(exponent_tight), slack


def best_share(exponent_tight: ArrayLike, exponent_slack: ArrayLike) -> FloatArray:
    """Share of the drum on the tight side at which both drums use their grip equally far.

        F_1/(F_1 + F_2) = (1 - exp(-mu_1 a_1)) / (1 - exp(-(mu_1 a_1 + mu_2 a_2)))

    Args:
        exponent_tight: mu_1 a_1 [1].
        exponent_slack: mu_2 a_2 [1].

    Returns:
        share between 0 and 1 [1].

    **Range** exponents above 0.
    **Error** exact.
    **Source** F_1/F_2 = exp(mu_2 a_2) (exp(mu_1 a_1) - 1)/(exp(mu_2 a_2) - 1) of `largest_drum_forces`.
    """
    first, second = np.asarray(exponent_tight, float), np.asarray(exponent_slack, float)
    return np.asarray(np.expm1(-first) / np.expm1(-(first + second)))


def drum_forces_in_slip(
    force: float,
    share_tight: float,
    slack_tension: float,
    exponent_tight: float,
    exponent_slack: float,
    load_sharing: bool,
) -> tuple[float, float, float]:
    """What each of two drums carries when one or both of them would have to carry more than they grip.

        wanted: F_1 = phi F, F_2 = (1 - phi) F;   limits: F_2 <= S_off (e_2 - 1), F_1 <= (S_off + F_2) (e_1 - 1)
        drum 2 slips: F_2 = S_off (e_2 - 1), F_1 takes F - F_2 if the drives share the load
        drum 1 slips: F_1 = (S_off + F) (1 - 1/e_1), F_2 takes F - F_1 if the drives share the load

    A slipping drum carries what its (kinetic) friction lets it; drum 1 that slips while drum 2 takes over stands
    on the higher middle tension S_off + F_2. Without load sharing a drum that does not slip keeps what it had.

    Args:
        force: F, wanted from both [N].
        share_tight: phi, share of drum 1 on the tight side [1].
        slack_tension: S_off, behind drum 2, kept by the take-up [N].
        exponent_tight: mu_1 a_1, ln e_1; kinetic friction where the drum already slips [1].
        exponent_slack: mu_2 a_2, ln e_2 [1].
        load_sharing: True for drives that take over (one common speed controller), False for fixed torques.

    Returns:
        (F_1 [N], F_2 [N], force that is missing [N]).

    **Range** driving; slow belts, else S_off - rho v^2; steady or slowly changing forces.
    **Error** as Eytelwein's law.
    **Source** Euler-Eytelwein on each drum; the take-over from F_1 + F_2 = F.
    """
    most_slack = slack_tension * math.expm1(exponent_slack)
    first, second = share_tight * force, (1 - share_tight) * force
    if not load_sharing:
        left = min(second, most_slack)
        carried = min(first, (slack_tension + left) * math.expm1(exponent_tight))
        return carried, left, (first - carried) + (second - left)
    most_tight, _ = largest_drum_forces(slack_tension, exponent_tight, exponent_slack)
    if force >= most_tight + most_slack:
        return most_tight, most_slack, force - (most_tight + most_slack)
    if second > most_slack:
        return force - most_slack, most_slack, 0.0
    if first > (slack_tension + second) * math.expm1(exponent_tight):
        first = -(force + slack_tension) * math.expm1(-exponent_tight)
        second = force - first
    return first, second, 0.0
