"""The main shaft of a machine: a body of one degree of freedom whose inertia may change with its angle.

T = J(phi) w^2/2 is its kinetic energy; torques do the work A = integral of M dphi. Source of the textbook forms:
lecture notes "Main shaft and tachogram", Kramatorsk (chapter 6); the numbers in brackets are those of its formulas.
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]

# -- motion ---------------------------------------------------------------------------------------------------------


def acceleration(torque: ArrayLike, inertia: ArrayLike, inertia_slope: ArrayLike, speed: ArrayLike) -> FloatArray:
    """Angular acceleration of a shaft whose inertia changes with its angle (6.8).

        eps = (M - w^2 J'/2) / J

    Args:
        torque: M, of all torques, positive in the sense of the motion [N*m].
        inertia: J, at this angle [kg*m^2].
        inertia_slope: J' = dJ/dphi [kg*m^2/rad].
        speed: w [rad/s].

    Returns:
        eps [rad/s^2].

    **Range** rigid links, one degree of freedom.
    **Error** exact.
    **Source** d(J w^2/2)/dt = M w.
    """
    w = np.asarray(speed, float)
    j = np.asarray(inertia, float)
    return np.asarray(np.asarray(torque, float) / j - w * (w * (np.asarray(inertia_slope, float) / j) / 2))


def torque_of_motion(
    inertia: ArrayLike, inertia_slope: ArrayLike, speed: ArrayLike, acceleration: ArrayLike
) -> FloatArray:
    """Sum of all torques on a shaft whose motion is known: the decoding of a tachogram.

        M = J eps + w^2 J'/2

    Args:
        inertia: J, at this angle [kg*m^2].
        inertia_slope: J' = dJ/dphi [kg*m^2/rad].
        speed: w [rad/s].
        acceleration: eps [rad/s^2].

    Returns:
        M, positive in the sense of the motion [N*m].

    **Range** rigid links, one degree of freedom.
    **Error** exact.
    **Source** the inverse of `acceleration`.
    """
    w = np.asarray(speed, float)
    both = np.asarray(inertia, float) * np.asarray(acceleration, float)
    return np.asarray(both + w * (w * np.asarray(inertia_slope, float)) / 2)


def speed_after_work(
    inertia_before: ArrayLike, speed_before: ArrayLike, work: ArrayLike, inertia_after: ArrayLike
) -> FloatArray:
    """Speed of a shaft after a work has been done on it: the energy step (6.9).

        w = sqrt((J_0 w_0^2 + 2 A) / J)

    Args:
        inertia_before: J_0 [kg*m^2].
        speed_before: w_0 [rad/s].
        work: A, of all torques in between; negative where they brake [J].
        inertia_after: J [kg*m^2].

    Returns:
        w; 0 where the work takes all there is or more: the shaft has stopped on the way [rad/s].

    **Range** any torques, any change of the inertia.
    **Error** exact for the work given.
    **Source** the theorem of kinetic energy (6.6).
    """
    j, w0 = np.asarray(inertia_after, float), np.asarray(speed_before, float)
    square = np.asarray(inertia_before, float) / j * w0**2 + 2 * (np.asarray(work, float) / j)
    return np.asarray(np.sqrt(np.maximum(square, 0.0)))


def gear_factor(
    motor_torque: ArrayLike,
    motor_inertia: ArrayLike,
    inertia: ArrayLike,
    ratio: float,
    resistance: ArrayLike,
    efficiency: float,
    reverse_efficiency: float,
) -> FloatArray:
    """What a lossy gear makes of the torque through its mesh.

        N = M_m - J_m u eps,  M_shaft = u f N:   f = eta for N > 0,  1/eta_r for N < 0
        N has the sign of M_m J + u J_m R, whichever factor holds

    Args:
        motor_torque: M_m [N*m].
        motor_inertia: J_m, on the motor shaft [kg*m^2].
        inertia: J, of the main shaft without the motor's side [kg*m^2].
        ratio: u, motor speed / main shaft speed [1].
        resistance: R, all torques against the motion on the main shaft, with w^2 J'/2 [N*m].
        efficiency: eta, from motor to main shaft [1].
        reverse_efficiency: eta_r, from main shaft to motor [1].

    Returns:
        f [1].

    **Range** the shaft turns in the sense in which the motor drives; no self-locking (eta_r > 0).
    **Error** exact for a gear of constant efficiencies.
    **Source** derived: N from the equations of both shafts; the sign of the power through the mesh decides.
    """
    driven = np.asarray(motor_torque, float) * np.asarray(inertia, float)
    through = driven + np.asarray(motor_inertia, float) * ratio * np.asarray(resistance, float)
    return np.where(through >= 0, efficiency, 1 / reverse_efficiency)


# -- the cycle ------------------------------------------------------------------------------------------------------


def irregularity(speed_max: ArrayLike, speed_min: ArrayLike) -> FloatArray:
    """Irregularity of a steady cycle.

        delta = (w_max - w_min) / w_mean,  w_mean = (w_max + w_min)/2

    Args:
        speed_max: w_max, the largest speed of the cycle [rad/s].
        speed_min: w_min, the smallest [rad/s].

    Returns:
        delta, between 0 and 2; 0 at rest [1].

    **Range** w_max >= w_min >= 0.
    **Error** exact.
    **Source** definition.
    """
    high, low = np.asarray(speed_max, float), np.asarray(speed_min, float)
    mean = (high + low) / 2
    return np.asarray((high - low) / np.where(mean > 0, mean, 1.0))


def flywheel_inertia(
    work_swing: ArrayLike, irregularity: ArrayLike, speed: ArrayLike, present_inertia: ArrayLike
) -> FloatArray:
    """Inertia to be added for a wanted irregularity, by the textbook.

        J_f = Delta_A / (delta w^2) - J

    Args:
        work_swing: Delta_A, largest less smallest value of the work of all torques over the cycle [J].
        irregularity: delta, the one wanted, above 0 [1].
        speed: w, mean speed [rad/s].
        present_inertia: J, that is there already [kg*m^2].

    Returns:
        J_f; 0 where nothing is to be added [kg*m^2].

    **Range** the motor's torque stays at its mean over the cycle: period of the load x slope of the motor / J well
    below 1; constant inertia.
    **Error** no bound: with a working motor slope it has been seen to give half as much again as is needed.
    **Source** F. Wittenbauer, Graphische Dynamik, Berlin 1923; any textbook of the theory of machines.
    """
    w = np.asarray(speed, float)
    needed = np.asarray(work_swing, float) / np.asarray(irregularity, float) / w / w
    return np.asarray(np.maximum(needed - np.asarray(present_inertia, float), 0.0))


def cycle_efficiency(useful_work: ArrayLike, lost_work: ArrayLike) -> FloatArray:
    """Efficiency of a steady cycle (6.10).

        eta = A_u / (A_u + A_l)

    Args:
        useful_work: A_u, of the useful load over a cycle, not below 0 [J].
        lost_work: A_l, of the losses, not below 0 [J].

    Returns:
        eta; 0 where no work is done at all [1].

    **Range** works of a closed cycle, in which weights and springs do none.
    **Error** exact.
    **Source** A_drive = A_useful + A_loss.
    """
    useful, lost = np.asarray(useful_work, float), np.asarray(lost_work, float)
    whole = useful + lost
    return np.asarray(useful / np.where(whole > 0, whole, 1.0))


def loss_factor(useful_work: ArrayLike, lost_work: ArrayLike) -> FloatArray:
    """Loss factor of a steady cycle: what the losses take of the work of the drive; at 1 nothing is left to be useful.

        psi = A_l / (A_u + A_l) = 1 - eta

    Args:
        useful_work: A_u, of the useful load over a cycle, not below 0 [J].
        lost_work: A_l, of the losses, not below 0 [J].

    Returns:
        psi; 1 where no work is done at all [1].

    **Range** works of a closed cycle, in which weights and springs do none.
    **Error** exact.
    **Source** A_drive = A_useful + A_loss.
    """
    useful, lost = np.asarray(useful_work, float), np.asarray(lost_work, float)
    whole = useful + lost
    return np.asarray(np.where(whole > 0, lost / np.where(whole > 0, whole, 1.0), 1.0))


def inertia_criterion(inertia_slope: ArrayLike, speed: ArrayLike, torque: ArrayLike) -> FloatArray:
    """How much of the torque on a shaft its changing inertia takes.

        q = |J'| w^2 / (2 |M|)

    Args:
        inertia_slope: J' = dJ/dphi, the largest [kg*m^2/rad].
        speed: w [rad/s].
        torque: M, on the main shaft [N*m].

    Returns:
        q; infinite where the inertia changes and no torque acts [1].

    **Range** any shaft in motion.
    **Error** exact.
    **Source** the two terms of `acceleration`.
    """
    m, w = np.abs(np.asarray(torque, float)), np.asarray(speed, float)
    taken = np.abs(np.asarray(inertia_slope, float)) * w * w / 2
    return _over(np.asarray(taken), m)


def slope_criterion(period: ArrayLike, slope: ArrayLike, inertia: ArrayLike) -> FloatArray:
    """How far a motor holds the speed within a period of the load.

        h = t k / J

    Args:
        period: t, of the useful load [s].
        slope: k, fall of the drive's torque with the speed, on the main shaft [N*m*s/rad].
        inertia: J, of all that turns [kg*m^2].

    Returns:
        h: well below 1 the motor's torque stays at its mean, well above 1 it follows the load [1].

    **Range** any drive.
    **Error** exact.
    **Source** the period over the time constant J/k of shaft and motor.
    """
    return np.asarray(np.asarray(period, float) / np.asarray(inertia, float) * np.asarray(slope, float))


# -- run-out --------------------------------------------------------------------------------------------------------


def run_out_angle(inertia: ArrayLike, speed: ArrayLike, torque: ArrayLike) -> FloatArray:
    """Angle a shaft turns by until a constant torque has stopped it.

        phi = J_0 w_0^2 / (2 M)

    Only the inertia at the angle where it begins counts: at the stop there is no kinetic energy whatever the inertia.

    Args:
        inertia: J_0, at the beginning [kg*m^2].
        speed: w_0, at the beginning [rad/s].
        torque: M, of losses and brake together [N*m].

    Returns:
        phi; infinite without a torque [rad].

    **Range** torques that depend on neither speed nor time.
    **Error** exact.
    **Source** T_0 = A_loss + A_brake.
    """
    return _over(np.asarray(inertia, float) * np.asarray(speed, float) ** 2 / 2, torque)


def run_out_time(inertia: ArrayLike, speed: ArrayLike, torque: ArrayLike) -> FloatArray:
    """Time in which a constant torque stops a shaft of constant inertia.

        t = J w_0 / M

    Args:
        inertia: J [kg*m^2].
        speed: w_0, at the beginning [rad/s].
        torque: M, of losses and brake together [N*m].

    Returns:
        t; infinite without a torque [s].

    **Range** constant torque and inertia.
    **Error** exact.
    **Source** momentum.
    """
    return _over(np.asarray(inertia, float) * np.asarray(speed, float), torque)


def _over(above: FloatArray, below: ArrayLike) -> FloatArray:
    """A quotient that is infinite where the denominator is 0, and 0 where both are."""
    m = np.asarray(below, float)
    there = np.broadcast_to(m > 0, np.broadcast(above, m).shape)
    return np.asarray(np.divide(above, m, out=np.where(above > 0, np.inf, np.zeros(there.shape)), where=there))


def brake_torque_for_angle(
    inertia: ArrayLike, speed: ArrayLike, angle: ArrayLike, loss_torque: ArrayLike
) -> FloatArray:
    """Brake torque for a wanted angle of the run-out, of a brake that acts at once.

        M_b = J_0 w_0^2 / (2 phi) - M_l

    Args:
        inertia: J_0, at the beginning [kg*m^2].
        speed: w_0, at the beginning [rad/s].
        angle: phi, the one wanted, above 0 [rad].
        loss_torque: M_l, of the losses [N*m].

    Returns:
        M_b; 0 where the losses alone do it [N*m].

    **Range** no delay, no rise, torques that do not depend on the speed.
    **Error** exact.
    **Source** the inverse of `run_out_angle`.
    """
    w = np.asarray(speed, float)
    whole = np.asarray(inertia, float) * w / 2 * (w / np.asarray(angle, float))
    return np.asarray(np.maximum(whole - np.asarray(loss_torque, float), 0.0))


def recoverable_energy(kinetic_energy: ArrayLike, lost_work: ArrayLike, efficiency: ArrayLike) -> FloatArray:
    """What a regenerating motor in place of the brake could give back in a run-out.

        E = eta_r (T_0 - A_l)

    Args:
        kinetic_energy: T_0, at the beginning [J].
        lost_work: A_l, of the losses until the stop [J].
        efficiency: eta_r, from the main shaft to the motor [1].

    Returns:
        E; 0 where the losses take everything [J].

    **Range** the same stop, with the motor's torque on the main shaft that of the brake.
    **Error** exact; the motor's own losses are not in it.
    **Source** T_0 = A_loss + A_brake.
    """
    left = np.maximum(np.asarray(kinetic_energy, float) - np.asarray(lost_work, float), 0.0)
    return np.asarray(left * np.asarray(efficiency, float))


def braked_stop(
    inertia: float, speed: float, loss: float, viscous: float, brake: float, delay: float, rise: float
) -> tuple[float, float]:
    """Time and angle in which a shaft of constant inertia comes to rest under a brake that comes up in a straight line.

        J w' = -(M_l + b w + M_b(t)),  M_b = 0 until t_d, M_b (t - t_d)/t_r until t_d + t_r, then M_b

    Args:
        inertia: J [kg*m^2].
        speed: w_0 [rad/s].
        loss: M_l, constant torque of the losses; negative where a load drives [N*m].
        viscous: b, torque of the losses per speed [N*m*s/rad].
        brake: M_b, full torque of the brake [N*m].
        delay: t_d, until the first torque [s].
        rise: t_r, from the first to the full torque; 0 is a step [s].

    Returns:
        (time until rest [s], angle until rest [rad]); infinite where nothing but `viscous` acts, or the brake does not
        exceed a load that drives.

    **Range** constant inertia, no torque that depends on the angle.
    **Error** exact but for rounding: closed forms of each part, the end of the ramp by bisection.
    **Source** the linear differential equation of each part.
    """
    if speed == 0:
        return 0.0, 0.0
    if loss + brake <= 0 or (loss <= 0 and math.isinf(delay)):
        return math.inf, math.inf
    time = angle = 0.0
    w, rate = speed, viscous / inertia
    for level, ramp, span in ((loss, 0.0, delay), (loss, brake / rise if rise > 0 else 0.0, rise)):
        if span <= 0:
            continue
        parts = level / inertia, ramp / inertia, rate
        if _coasted(w, *parts, span)[0] > 0:
            w, turned = _coasted(w, *parts, span)
            time, angle = time + span, angle + turned
            continue
        end = _standstill(w, *parts, span)
        return time + end, angle + _coasted(w, *parts, end)[1]
    full = (loss + brake) / inertia
    end = w / full * _log_part(rate * w / full)
    return time + end, angle + _coasted(w, full, 0.0, rate, end)[1]


def _log_part(x: float) -> float:
    """log(1 + x)/x."""
    return math.log1p(x) / x if x > 1e-300 else 1.0


def _coasted(speed: float, fall: float, growth: float, rate: float, time: float) -> tuple[float, float]:
    """Speed and angle after a time of w' = -fall - growth t - rate w."""
    x = rate * time
    one, two, three = _phi(x)
    speed_lost = time * (fall * one + growth * time * two)
    turned = time * (speed * one - time * (fall * two + growth * time * three))
    return speed * math.exp(-x) - speed_lost, turned


def _phi(x: float) -> tuple[float, float, float]:
    """(1 - e^-x)/x, (x - 1 + e^-x)/x^2, (x^2/2 - x + 1 - e^-x)/x^3, by their series where they would cancel."""
    if x == 0.0:
        return 1.0, 1 / 2, 1 / 6
    if x > 1.0:
        one = -math.expm1(-x) / x
        two = (1 - one) / x
        return one, two, (0.5 - two) / x
    terms = [1.0, 1 / 2, 1 / 6]
    sums = list(terms)
    for k in range(1, 22):
        terms = [-term * x / (k + 1 + order) for order, term in enumerate(terms)]
        sums = [total + term for total, term in zip(sums, terms, strict=True)]
    return sums[0], sums[1], sums[2]


def _standstill(speed: float, fall: float, growth: float, rate: float, latest: float) -> float:
    """The time at which such a speed is 0, by bisection."""
    low, high = 0.0, latest
    for _ in range(200):
        middle = (low + high) / 2
        if not low < middle < high:
            break
        low, high = (middle, high) if _coasted(speed, fall, growth, rate, middle)[0] > 0 else (low, middle)
    return high
