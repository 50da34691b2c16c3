"""Stress waves in a belt: speed, impedance, reflection, and the textbook start of a conveyor.

Source of the textbook forms: N. Yu. Dorokhov, "Dynamics of hoisting and conveying machines", lecture notes,
Kramatorsk 2007 (the chapter on wave processes in the belt); its lost formulas are recovered from the prose.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]


def wave_speed(stiffness: float, line_mass: float) -> float:
    """Speed of a longitudinal wave in a strand of belt or chain.

        c = sqrt(EA / rho)

    Args:
        stiffness: EA, tensile stiffness of belt or chain, a force [N].
        line_mass: rho, moving mass per length: belt or chain, load, plates, idlers reduced to the rim [kg/m].

    Returns:
        c [m/s].

    **Range** a taut strand, wavelength much longer than a link or the idler pitch; sag softens it at low tension.
    **Error** exact for the one-dimensional strand; the moving belt shifts it by v/c, 0.3 % at 4 m/s.
    **Source** d'Alembert's wave equation; lecture notes Kramatorsk 2007.
    """
    return float(np.sqrt(stiffness / line_mass))


def impedance(stiffness: float, line_mass: float) -> float:
    """Force a wave carries per unit of particle speed.

        Z = rho c = sqrt(rho EA)

    Args:
        stiffness: EA, tensile stiffness of the belt [N].
        line_mass: rho, moving mass per length [kg/m].

    Returns:
        Z [N*s/m].

    **Range** as `wave_speed`.
    **Error** exact for the one-dimensional strand.
    **Source** the force of the direct wave, S = EA |u_x| = Z v; lecture notes Kramatorsk 2007.
    """
    return float(np.sqrt(stiffness * line_mass))


def reflection(impedance_from: float, impedance_to: float) -> float:
    """Part of a tension wave that a jump of impedance sends back.

        r = (Z_b - Z_a) / (Z_a + Z_b)

    Args:
        impedance_from: Z_a, of the strand the wave comes in on [N*s/m].
        impedance_to: Z_b, of the strand behind the jump [N*s/m].

    Returns:
        r, between -1 (free end) and 1 (clamped end) [1].

    **Range** a massless junction of two strands that move together.
    **Error** exact.
    **Source** continuity of tension and speed at the junction.
    """
    return (impedance_to - impedance_from) / (impedance_from + impedance_to)


def first_wave_time(transit_carry: float, transit_return: float) -> float:
    """Time at which the textbook expects the largest dynamic tension.

        t_max = 2 (L/c1 + L/c2)

    The direct wave runs round the whole contour to the take-up, is turned into a wave of opposite sign there and
    runs back the whole contour. The echo of the tail, at 2 L/c1, comes earlier.

    Args:
        transit_carry: L/c1, travel time of the carry strand [s].
        transit_return: L/c2, travel time of the return strand [s].

    Returns:
        t_max [s].

    **Range** a gravity take-up beside the drive.
    **Error** exact as a travel time; the peak itself may come later (see `first_wave_peak`).
    **Source** lecture notes Kramatorsk 2007.
    """
    return 2 * (transit_carry + transit_return)


def first_wave_force(force: float, impedance: float, drive_mass: float, time: ArrayLike) -> FloatArray:
    """Dynamic tension of the direct wave at the drive drum after a step of rim force.

        m v' + Z v = F,  v(0) = 0   =>   S = Z v = F (1 - exp(-Z t / m))

    Args:
        force: F, step of rim force [N].
        impedance: Z, sum of the impedances the drum works against [N*s/m].
        drive_mass: m, drive reduced to the rim [kg].
        time: t, since the step [s].

    Returns:
        S [N].

    **Range** until the first echo comes back to the drum.
    **Error** exact up to that time.
    **Source** lecture notes Kramatorsk 2007; ordinary differential equation solved in closed form.
    """
    return np.asarray(-force * np.expm1(-impedance * np.asarray(time, float) / drive_mass))


def first_wave_speed(force: float, impedance: float, drive_mass: float, time: ArrayLike) -> FloatArray:
    """Speed of the rim behind the direct wave after a step of rim force.

        v = (F / Z) (1 - exp(-Z t / m))

    Args:
        force: F, step of rim force [N].
        impedance: Z, sum of the impedances the drum works against [N*s/m].
        drive_mass: m, drive reduced to the rim [kg].
        time: t, since the step [s].

    Returns:
        v [m/s].

    **Range** until the first echo; a massless belt (Z -> 0) gives F t / m.
    **Error** exact up to that time.
    **Source** lecture notes Kramatorsk 2007.
    """
    rate = impedance / drive_mass
    times = np.asarray(time, float)
    if rate == 0:
        return force / drive_mass * times
    return np.asarray(-force / drive_mass * np.expm1(-rate * times) / rate)


def first_wave_peak(force: float, impedance: float, drive_mass: float, time_max: float) -> float:
    """Largest dynamic tension by the textbook: the direct wave at t_max.

        S_max = F (1 - exp(-Z1 t_max / m))

    Args:
        force: F, step of rim force over the static resistance [N].
        impedance: Z1, impedance of the carry strand [N*s/m].
        drive_mass: m, drive reduced to the rim [kg].
        time_max: t_max of `first_wave_time` [s].

    Returns:
        S_max [N].

    **Range** a gravity take-up beside the drive, carry and return strand of equal impedance, one echo.
    **Error** no bound: from -29 % to +23 % of the true peak over the usual belts, because the echo of the tail and
    the later echoes are left out. It is shown beside the simulated value and never decides.
    **Source** lecture notes Kramatorsk 2007.
    """
    return float(first_wave_force(force, impedance, drive_mass, time_max))


def two_interval_force(force: float, contour_time: float, time_constant: float, time: ArrayLike) -> FloatArray:
    """Exact dynamic run-on tension of a uniform loop over its first two contour times.

        0 <= t <= T :  S = F (1 - exp(-t/tau))
        T <= t <= 2T:  S = F (1 - exp(-t/tau) - 2 x exp(-x)),   x = (t - T)/tau

    Args:
        force: F, step of rim force over the static resistance [N].
        contour_time: T = 2 (L1 + L2)/c, time for a wave to the take-up and back [s].
        time_constant: tau = m/Z [s].
        time: t, since the step, at most 2 T [s].

    Returns:
        S [N].

    **Range** equal impedance of both strands, no tail mass, gravity take-up, 0 <= t <= 2 T.
    **Error** exact.
    **Source** method of steps on m v' + Z v = F - N, with N the echo of the constant-tension end.
    """
    times = np.asarray(time, float)
    x = (times - contour_time) / time_constant
    late = -np.expm1(-times / time_constant) - 2 * x * np.exp(-np.maximum(x, 0))
    return np.asarray(force * np.where(x <= 0, -np.expm1(-times / time_constant), late))


def two_interval_peak(force: float, contour_time: float, time_constant: float, window: float) -> tuple[float, float]:
    """Largest value of `two_interval_force`, with its time.

    The force rises to t = T, where the echo makes a corner, falls to x = 1 - exp(-T/tau)/2 and rises again; so the
    largest value lies at T or at the end of the window.

    Args:
        force: F, step of rim force over the static resistance [N].
        contour_time: T, contour time [s].
        time_constant: tau = m/Z [s].
        window: end of the window, at most 2 T [s].

    Returns:
        (largest [N], its time [s]).

    **Range** as `two_interval_force`.
    **Error** exact.
    **Source** derivative of `two_interval_force`.
    """
    times = np.array([min(contour_time, window), window])
    forces = two_interval_force(force, contour_time, time_constant, times)
    top = int(np.argmax(forces))
    return float(forces[top]), float(times[top])
