"""Stopping a conveyor: what holds it, what brakes it within a distance, how far it coasts, what a coast-down tells.

The conveyor is a rigid mass at the rim of the drum. W is its static resistance there, positive when it opposes the
motion: friction + lift uphill, friction - lift downhill, where it may be negative. Everything of a section along the
strand comes from `moving_resistance`, or strand by strand from `strand_tension`. A brake with delay and rise is
`brake.brake_stop`.

Source of the textbook forms: N. Yu. Dorokhov, "Dynamics of hoisting and conveying machines", lecture notes,
Kramatorsk 2007 (the chapter on stopping the drive); its lost formulas are recovered from the prose.
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ptmcalc.laws.loop_bounds import CARRY, RETURN, LoopMasses, quasi_static

FloatArray = NDArray[np.float64]

SIGNED, NOTES = "signed", "notes"


# -- holding ------------------------------------------------------------------------------------------------------


def moving_resistance(
    length: ArrayLike, slope: ArrayLike, load_line_mass: ArrayLike, strand_line_mass: ArrayLike,
    coefficient: ArrayLike, gravity: float,
) -> FloatArray:  # fmt: skip
    """Static resistance of a straight conveyor while it moves forward.

        W = g L ((q_G + 2 q_0) f cos(beta) + q_G sin(beta))

    Args:
        length: L, of the conveyor [m].
        slope: beta, positive uphill [rad].
        load_line_mass: q_G [kg/m].
        strand_line_mass: q_0, belt or chain and what turns or rolls with it, one strand [kg/m].
        coefficient: f, resistance coefficient, turning points included (k f) [1].
        gravity: g [m/s^2].

    Returns:
        W; negative where a descent drives [N].

    **Range** one slope, equal strands: their weights cancel and only friction counts both.
    **Error** exact but for f.
    **Source** lecture notes Kramatorsk 2007; equilibrium strand by strand.
    """
    drag, weight = _drag_and_weight(length, slope, load_line_mass, strand_line_mass, coefficient, gravity)
    return np.asarray(drag + weight)


def rollback_force(
    length: ArrayLike, slope: ArrayLike, load_line_mass: ArrayLike, strand_line_mass: ArrayLike,
    coefficient: ArrayLike, gravity: float,
) -> FloatArray:  # fmt: skip
    """Force at the rim with which a stopped uphill conveyor wants to run back.

        F = g L (q_G sin(beta) - (q_G + 2 q_0) f cos(beta))

    Args:
        length: L, loaded; for a partial load each worst part by itself [m].
        slope: beta, positive uphill [rad].
        load_line_mass: q_G [kg/m].
        strand_line_mass: q_0, one strand with what moves with it [kg/m].
        coefficient: f, the lowest there can be: running and warm [1].
        gravity: g [m/s^2].

    Returns:
        F; negative where friction holds it [N].

    **Range** as `moving_resistance`.
    **Error** exact but for f.
    **Source** lecture notes Kramatorsk 2007; equilibrium strand by strand.
    """
    drag, weight = _drag_and_weight(length, slope, load_line_mass, strand_line_mass, coefficient, gravity)
    return np.asarray(weight - drag)


def _drag_and_weight(
    length: ArrayLike, slope: ArrayLike, load: ArrayLike, strand: ArrayLike, coefficient: ArrayLike, gravity: float
) -> tuple[FloatArray, FloatArray]:
    whole = np.asarray(length, float) * gravity
    both = np.asarray(load, float) + 2 * np.asarray(strand, float)
    drag = whole * both * np.asarray(coefficient, float) * np.cos(slope)
    return np.asarray(drag), np.asarray(whole * np.asarray(load, float) * np.sin(slope))


def critical_coefficient(slope: ArrayLike, load_line_mass: ArrayLike, strand_line_mass: ArrayLike) -> FloatArray:
    """Resistance coefficient below which a loaded conveyor runs back by itself.

        f = q_G tan(beta) / (q_G + 2 q_0)

    Args:
        slope: beta, positive uphill [rad].
        load_line_mass: q_G [kg/m].
        strand_line_mass: q_0, one strand with what moves with it [kg/m].

    Returns:
        f [1].

    **Range** as `rollback_force`.
    **Error** exact.
    **Source** `rollback_force` = 0.
    """
    load = np.asarray(load_line_mass, float)
    return np.asarray(np.tan(slope) * load / (load + 2 * np.asarray(strand_line_mass, float)))


def backstop_torque(rollback_force: ArrayLike, drum_diameter: float, reserve: float) -> FloatArray:
    """Torque a backstop on the drum shaft has to hold.

        M = k F D/2,   F > 0

    Args:
        rollback_force: F of `rollback_force`, or weights less resistances of any route [N].
        drum_diameter: D [m].
        reserve: k, of holding; 1.25 to 1.75 in practice, the lecture notes have none [1].

    Returns:
        M; 0 where friction holds the conveyor [N*m].

    **Range** standstill; not the blow of a backstop that engages with play.
    **Error** exact.
    **Source** lecture notes Kramatorsk 2007 (k = 1).
    """
    return np.asarray(reserve * np.maximum(np.asarray(rollback_force, float), 0.0) * (drum_diameter / 2))


def torque_on_motor_shaft(drum_torque: ArrayLike, ratio: float, efficiency: float) -> FloatArray:
    """Torque that holds, on the motor shaft, what drives the drum shaft.

        M_st = M eta / i

    Args:
        drum_torque: M, on the drum shaft [N*m].
        ratio: i, motor speed over drum speed [1].
        efficiency: eta, of the gear; the highest plausible one for holding [1].

    Returns:
        M_st [N*m].

    **Range** a load that drives the brake through the gear, so that the losses help.
    **Error** eta at standstill differs from that in motion.
    **Source** lecture notes Kramatorsk 2007.
    """
    return np.asarray(np.asarray(drum_torque, float) * (efficiency / ratio))


# -- braking ------------------------------------------------------------------------------------------------------


def brake_torque_for_distance(
    mass: float,
    resistance: float,
    speed: float,
    distance: float,
    drum_diameter: float,
    ratio: float,
    efficiency: float,
    rotor_inertia: float,
    form: str,
) -> float:
    """Torque of a brake on the motor shaft that stops a conveyor in a given distance.

        a = v^2/(2 s),   F_b = m a - W,   R = D/2
        signed: M_T = F_b R eta/i + J a i/R  for F_b >= 0,   F_b R/(eta i) + J a i/R  for F_b < 0
        notes:  M_T = |W| R eta/i + m a R eta/i + J a i/R

    F_b is what the drive must hold back at the rim. For F_b >= 0 the conveyor drives the brake through the gear and
    its losses help; for F_b < 0 the resistance alone would stop the conveyor shorter than s and the rotor pushes it.

    Args:
        mass: m, of everything that moves with the belt [kg].
        resistance: W, static, positive against the motion [N].
        speed: v, when the brake acts [m/s].
        distance: s, wanted [m].
        drum_diameter: D [m].
        ratio: i, motor speed over drum speed [1].
        efficiency: eta, of the gear [1].
        rotor_inertia: J, everything on the motor shaft [kg*m^2].
        form: `signed` (recommended) or `notes`, the form of the lecture notes.

    Returns:
        M_T; 0 where the conveyor stops within s by itself [N*m].

    **Range** rigid conveyor, constant torque without delay. `notes` equals `signed` for W < 0; uphill it adds the
    torque of the resistance instead of crediting it.
    **Error** `signed` exact for the rigid conveyor; `notes` is too large by 2 W R eta/i for W > 0 and F_b >= 0.
    **Source** derived; `notes`: lecture notes Kramatorsk 2007, M, M_st and M_T in turn.

    Raises:
        ValueError: for another form.
    """
    if form not in (SIGNED, NOTES):
        raise ValueError(f"the form of the brake torque is {SIGNED} or {NOTES}")
    radius = drum_diameter / 2
    deceleration = speed * (speed / distance) / 2
    rotor = rotor_inertia * deceleration * (ratio / radius)
    if form == NOTES:
        return (mass * deceleration + abs(resistance)) * radius * efficiency / ratio + rotor
    force = mass * deceleration - resistance
    gear = efficiency if force >= 0 else 1 / efficiency
    return max(force * radius * gear / ratio + rotor, 0.0)


def stopping_distance(
    mass: float,
    resistance: float,
    speed: float,
    torque: float,
    drum_diameter: float,
    ratio: float,
    efficiency: float,
    rotor_inertia: float,
) -> float:
    """Distance in which a brake on the motor shaft stops a conveyor.

        s = v^2/(2 a),   a = (M_T + W R e/i) / (m R e/i + J i/R),   e = eta for F_b >= 0, 1/eta for F_b < 0

    Args:
        mass: m, of everything that moves with the belt [kg].
        resistance: W, static, positive against the motion [N].
        speed: v, when the brake acts [m/s].
        torque: M_T; 0 coasts with the gear engaged [N*m].
        drum_diameter: D [m].
        ratio: i, motor speed over drum speed [1].
        efficiency: eta, of the gear [1].
        rotor_inertia: J, everything on the motor shaft [kg*m^2].

    Returns:
        s; infinite where brake and friction do not hold the load [m].

    **Range** as `brake_torque_for_distance`, form `signed`.
    **Error** exact for the rigid conveyor.
    **Source** the inverse of `brake_torque_for_distance`: torque rises with deceleration on both branches.
    """
    radius = drum_diameter / 2
    balanced = rotor_inertia * (resistance / mass) * (ratio / radius)  # torque at which the gear carries nothing
    arm = radius / ratio * (efficiency if torque >= balanced else 1 / efficiency)
    deceleration = (torque + resistance * arm) / (mass * arm + rotor_inertia * (ratio / radius))
    return speed * (speed / deceleration) / 2 if deceleration > 0 else math.inf


def braking_force(mass: ArrayLike, speed: ArrayLike, distance: ArrayLike) -> FloatArray:
    """Force that a uniform stop of a mass adds to the tensions of the belt in all.

        S_ov = m v^2/(2 s) = m a

    Where it appears: with a gravity take-up on the slack side the tight side drops by it and the slack side keeps its
    tension; with a brake at the upper end of a descent the strand below rises by its own mass times a; in a loop of
    fixed length both sides share it (`fixed_loop_braking`).

    Args:
        mass: m, of the belt, the load and the idlers behind the section looked at [kg].
        speed: v [m/s].
        distance: s, of the stop [m].

    Returns:
        S_ov, rigid-body value; waves come on top of it [N].

    **Range** uniform deceleration.
    **Error** exact for a rigid belt; a brake that closes at once can double it.
    **Source** lecture notes Kramatorsk 2007, overload 2 (M_T i/eta - M)/D without the torque of the rotor, which is
    the same for a load that drives.
    """
    v = np.asarray(speed, float)
    return np.asarray(np.asarray(mass, float) * v * (v / np.asarray(distance, float)) / 2)


def fixed_loop_braking(carry_mass: float, return_mass: float, deceleration: float) -> tuple[float, float]:
    """How a loop of fixed length shares the force of a uniform stop.

        slack side: + a (3 m_2 + m_1)/4,   tight side: - a (m_2 + 3 m_1)/4

    Args:
        carry_mass: m_1, of the carry strand [kg].
        return_mass: m_2, of the return strand [kg].
        deceleration: a [m/s^2].

    Returns:
        (rise of the slack side [N], drop of the tight side [N]).

    **Range** strands of equal length and stiffness, rigid take-up, drive at the head, no tail mass.
    **Error** exact for slow changes; waves oscillate about it.
    **Source** `loop_bounds.quasi_static`: the total elongation stays.
    """
    loop = LoopMasses(return_mass, carry_mass, 0.0, 1.0, 1.0, 1.0, fixed_length=True, imposed_speed=True)
    rise, drop = -quasi_static(loop, RETURN, 0.0), quasi_static(loop, CARRY, 1.0)
    return float(rise * deceleration), float(drop * deceleration)


# -- coasting -----------------------------------------------------------------------------------------------------


def coasting(mass: float, resistance: float, resistance_rate: float, speed: float) -> tuple[float, float]:
    """Distance and time in which a conveyor comes to rest by its own resistance W + b v.

        s = (m/b) (v - (W/b) ln(1 + b v/W)),   t = (m/b) ln(1 + b v/W);   b = 0: s = m v^2/(2 W), t = m v/W

    Args:
        mass: m, of the conveyor; with the gear engaged `inertia.reduced_drive_mass` more, because the rotor drives
            the conveyor [kg].
        resistance: W of `moving_resistance`, with k f for the turning points [N].
        resistance_rate: b, resistance per speed [N*s/m].
        speed: v, when the drive is cut off [m/s].

    Returns:
        (distance [m], time [s]); both infinite for W < 0, a descent that does not stop by itself; for W = 0 the time is
        infinite and the distance m v/b.

    **Range** rigid conveyor, b >= 0.
    **Error** exact for that.
    **Source** lecture notes Kramatorsk 2007 for b = 0; integration of m v' = -(W + b v).
    """
    if speed == 0:
        return 0.0, 0.0
    if resistance <= 0:
        return (mass / resistance_rate * speed if resistance == 0 and resistance_rate > 0 else math.inf), math.inf
    x = resistance_rate / resistance * speed
    time = mass / resistance * speed
    return time * speed * _distance_share(x), time * (math.log1p(x) / x if x > 0 else 1.0)


def _distance_share(x: float) -> float:
    """(x - log(1 + x))/x^2, from 1/2 at 0."""
    if x < 0.1:
        return sum((-x) ** k / (k + 2) for k in range(17))
    return (1 - math.log1p(x) / x) / x


def coast_down_coefficient(
    mass: float,
    lift_force: float,
    normal_force: float,
    turn_factor: float,
    speed: float,
    distance: float,
    speed_deviation: float,
    distance_deviation: float,
) -> tuple[float, float]:
    """Resistance coefficient from a measured coast-down, with its standard deviation.

        f = (m v^2/(2 s) - F_h) / (k N)
        d_f = sqrt((m v d_v/s)^2 + (m v^2 d_s/(2 s^2))^2) / (k N)

    Args:
        mass: m, conveyor and, with the gear engaged, `inertia.reduced_drive_mass` [kg].
        lift_force: F_h = g q_G L sin(beta), positive uphill [N].
        normal_force: N = g (q_G + 2 q_0) L cos(beta), what the idlers carry [N].
        turn_factor: k, for the turning points; 1 gives the total coefficient [1].
        speed: v, measured when the drive was cut off [m/s].
        distance: s, measured to rest [m].
        speed_deviation: d_v, standard deviation of v [m/s].
        distance_deviation: d_s, standard deviation of s [m].

    Returns:
        (f [1], d_f [1]); a negative f says that the data do not fit together.

    **Range** constant resistance; deviations small against v and s, independent of each other.
    **Error** d_f to first order in the deviations.
    **Source** lecture notes Kramatorsk 2007, f = v^2/(2 g k s) on the level; propagation of errors.
    """
    braked = mass * speed * (speed / distance) / 2
    relative = math.hypot(2 * speed_deviation / speed, distance_deviation / distance)
    return (braked - lift_force) / (turn_factor * normal_force), braked / (turn_factor * normal_force) * relative
