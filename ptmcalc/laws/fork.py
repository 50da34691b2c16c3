"""The fork of a stacker crane: pushed against the rack, or caught by it while the carriage is hoisted.

Pushed: the drive of the fork, reduced to its travel, runs onto the rack. Caught: the carriage is stopped by the rack
while the drive of the hoist goes on and stretches the rope, which already bears the weight of carriage and load.
"""

import math


def push_force(force: float, stiffness: float, mass: float, speed: float) -> float:
    """Force of a fork that runs against the rack with its drive on.

        F = P + (P^2 + K m v^2)^(1/2)

    Args:
        force: P, of the drive at the fork, constant [N].
        stiffness: K, of the rack, in series with what gives way behind the fork [N/m].
        mass: m, of the drive and the moving fork, reduced to the travel of the fork [kg].
        speed: v, as it touches [m/s].

    Returns:
        F, at which the fork first stands [N].

    **Range** P >= 0, constant until the fork stands; no mass of the carriage between drive and rack.
    **Error** exact for that model; `push_bound` where the mass of the carriage lies between.
    **Source** energy m v^2/2 + P x = F^2/(2 K), x = F/K.
    """
    return force + math.hypot(force, speed * math.sqrt(stiffness) * math.sqrt(mass))


def push_bound(force: float, stiffness: float, support: float, mass: float, speed: float) -> float:
    """Most that a fork pushes, whatever mass hangs between its drive and the mast.

        F <= P + (P^2 (1 + K/c) + K m v^2)^(1/2)

    The carriage is pushed back with the same force on the mast's stiffness c; how far depends on its mass.

    Args:
        force: P, of the drive at the fork, its largest [N].
        stiffness: K, of the rack alone [N/m].
        support: c, of the mast at the height of the fork; infinite for a rigid one [N/m].
        mass: m, of drive and fork, reduced to the travel of the fork over the carriage [kg].
        speed: v, as it touches [m/s].

    Returns:
        a bound of F for all times [N].

    **Range** a drive whose force does not grow with its speed and is at most P; a carriage at rest before.
    **Error** a bound; attained as the mass of the carriage grows beyond all (c without influence) with P = 0.
    **Source** derived: F^2/(2 K) + c z^2/2 <= m v^2/2 + P (F/K - z), at its worst z = -P/c.
    """
    return force + math.hypot(force, force * math.sqrt(stiffness / support), speed * math.sqrt(stiffness * mass))


def push_least(force: float, stiffness: float, support: float, mass: float, carriage: float, speed: float) -> float:
    """Least that a fork pushes at its hardest, on a carriage that leans on the mast.

        F^2 - 2 P F + 4 (K/c) F (F - P) >= K m v^2               while  m/M <= 1 - P/F,   else
        F^2 - 2 P F + (K/c) (F (1 + m/M) - P)^2 M/m >= K m v^2

    Args:
        force: P, of the drive at the fork, constant [N].
        stiffness: K, of the rack alone [N/m].
        support: c, of the mast at the height of the fork; infinite for a rigid one [N/m].
        mass: m, of drive and fork, reduced to the travel of the fork over the carriage [kg].
        carriage: M, of all that is pushed back [kg].
        speed: v, as it touches [m/s].

    Returns:
        a bound of the largest F from below, not under P [N].

    **Range** a drive of constant force, without a clutch; a carriage at rest before.
    **Error** a bound; exact for a rigid mast.
    **Source** derived. Until F first falls it has only risen, so that the carriage z strays from F/c by no more than
    that: z^2 + (z'/w)^2 <= 2 z F/c, w^2 = c/M. Where F is largest s' = z', and what the energy of the fork,
    F^2/(2 K) = m v^2/2 + P (F/K + z) - m z'^2/2 - c (z^2 + (z'/w)^2)/2, loses to the carriage is at most
    z (F (1 + m/M) - P) - (m/M) c z^2/2, largest at z = 2 F/c or before.
    """
    share, drawn = stiffness / support, speed * math.sqrt(stiffness * mass)
    middle = (1 + 2 * share) * force
    least = (middle + math.hypot(middle, drawn * math.sqrt(1 + 4 * share))) / (1 + 4 * share)
    ratio = mass / carriage
    if ratio > 1 - force / least:
        whole = 1 + share / ratio * (1 + ratio) ** 2
        root = math.hypot(force * math.sqrt(1 + 2 * share + share / ratio), drawn * math.sqrt(whole))
        least = (force * (1 + share * (1 + 1 / ratio)) + root) / whole
    return max(least, force)


def clutch_push(force: float, stiffness: float, mass: float, speed: float) -> float:
    """Force of a fork whose clutch slips.

        F = P_c (1 + Pi),   Pi = v (K m)^(1/2)/P_c

    Args:
        force: P_c, at which the clutch slips, at the fork [N].
        stiffness: K, of the rack, in series with what gives way behind the fork [N/m].
        mass: m, behind the clutch: the fork and what moves with it [kg].
        speed: v, of the motor, which the clutch lets turn on [m/s].

    Returns:
        F [N].

    **Range** a motor that keeps its speed; a clutch that slips with the torque it holds.
    **Error** exact for that motor; a bound for one that loses speed.
    **Source** derived: the spring reaches P_c at the speed v, then m swings about P_c/K.
    """
    return force + speed * math.sqrt(stiffness) * math.sqrt(mass)


def caught_force(force: float, weight: float, stiffness: float, mass: float, speed: float) -> float:
    """Force of the rope when the rack stops the carriage dead and the motor pulls on.

        F = P + ((P - Q)^2 + K m_1 v^2)^(1/2),   P = Q: Q + v (K m_1)^(1/2)

    Args:
        force: P, of the motor at the hook, constant [N].
        weight: Q, that the rope bears before [N].
        stiffness: K, of the rope at the hook [N/m].
        mass: m_1, of the drive at the hook, power flowing from the motor to it [kg].
        speed: v, of hoisting [m/s].

    Returns:
        F, at which the drive first stands [N].

    **Range** a carriage that stops at once and stays; a constant force until the drive stands.
    **Error** exact for that model; a rack that gives, or throws the carriage back, can raise it: `caught_bound`.
    **Source** energy m_1 v^2/2 + P x = (F^2 - Q^2)/(2 K), x = (F - Q)/K; table of combinations "fork catching the
    rack while hoisting" of the lecture notes Kramatorsk 2007.
    """
    return force + math.hypot(force - weight, speed * math.sqrt(stiffness) * math.sqrt(mass))


def soft_caught_force(weight: float, stiffness: float, mass: float, speed: float, slope: float) -> float:
    """Force of the rope when the rack stops the carriage dead and the motor gives way along a straight line.

        F = Q + v (K m_1)^(1/2) (2 z + exp(-(pi - t) cot t)),   z = h/(2 (K m_1)^(1/2)) = cos t,   z >= 1: Q + h v

    Args:
        weight: Q, that the rope bears before, and the motor at its speed v [N].
        stiffness: K, of the rope at the hook [N/m].
        mass: m_1, of the drive at the hook [kg].
        speed: v, of hoisting [m/s].
        slope: h, by which the motor's force rises as its speed falls: P = Q + h (v - x') [N*s/m].

    Returns:
        F [N].

    **Range** as `caught_force`; a straight line that goes on beyond the standstill.
    **Error** exact for that model.
    **Source** derived: m_1 x'' + h x' + K x = h v, x = 0 and x' = v at first; x' = 0 where its phase is pi - t.
    """
    shock = speed * math.sqrt(stiffness) * math.sqrt(mass)
    share = slope / (2 * math.sqrt(stiffness) * math.sqrt(mass))
    if share >= 1:
        return weight + slope * speed
    angle = math.acos(share)
    return weight + slope * speed + shock * math.exp(-(math.pi - angle) / math.tan(angle))


def stall_force(weight: float, slope: float, speed: float) -> float:
    """Force with which a soft motor stands.

        F = Q + h v

    Args:
        weight: Q, that it lifts at its speed [N].
        slope: h, by which its force rises as its speed falls [N*s/m].
        speed: v [m/s].

    Returns:
        F [N].

    **Range** a straight line of force over speed.
    **Error** exact at standstill; the rope overshoots it, `soft_caught_force`.
    **Source** the line P = Q + h (v - x') at x' = 0.
    """
    return weight + slope * speed


def caught_bound(
    force: float,
    weight: float,
    stiffness: float,
    rack_stiffness: float,
    drive_mass: float,
    carriage_mass: float,
    speed: float,
) -> float:
    """Most that the rope of a caught fork bears, however the rack gives and throws the carriage back.

        F <= P + ((P - Q)^2 (1 + K/K_r) + K (m_1 + M) v^2)^(1/2)

    Args:
        force: P, of the motor at the hook at its largest, at least Q [N].
        weight: Q, that the rope bears before [N].
        stiffness: K, of the rope at the hook [N/m].
        rack_stiffness: K_r, of rack and fork; infinite for a rigid one [N/m].
        drive_mass: m_1, of the drive at the hook [kg].
        carriage_mass: M, of carriage and load [kg].
        speed: v, of hoisting [m/s].

    Returns:
        a bound of F for all times [N].

    **Range** a motor whose force does not grow with its speed and is P at standstill; a rack that only pushes.
    **Error** a bound.
    **Source** derived: (F^2 - Q^2)/(2 K) + K_r y^2/2 + Q y <= (m_1 + M) v^2/2 + P (y + (F - Q)/K), at its worst
    y = (P - Q)/K_r.
    """
    over = force - weight
    shock = speed * math.sqrt(stiffness) * math.sqrt(drive_mass + carriage_mass)
    return force + math.hypot(over, over * math.sqrt(stiffness / rack_stiffness), shock)


def rack_bound(
    force: float,
    weight: float,
    stiffness: float,
    rack_stiffness: float,
    drive_mass: float,
    carriage_mass: float,
    speed: float,
) -> float:
    """Most that the rack gets from a caught fork.

        R <= (P - Q) + ((P - Q)^2 (1 + K_r/K) + K_r (m_1 + M) v^2)^(1/2)

    Args:
        force: P, of the motor at the hook at its largest, at least Q [N].
        weight: Q, that the rope bears before [N].
        stiffness: K, of the rope at the hook [N/m].
        rack_stiffness: K_r, of rack and fork [N/m].
        drive_mass: m_1, of the drive at the hook [kg].
        carriage_mass: M, of carriage and load [kg].
        speed: v, of hoisting [m/s].

    Returns:
        a bound of R for all times [N].

    **Range** as `caught_bound`, with a rope that stays taut at the peak; a slack one bears less.
    **Error** a bound.
    **Source** derived from the balance of `caught_bound`, at its worst for a rope of the force P.
    """
    over = force - weight
    shock = speed * math.sqrt(rack_stiffness) * math.sqrt(drive_mass + carriage_mass)
    return over + math.hypot(over, over * math.sqrt(rack_stiffness / stiffness), shock)


def catching_number(force: float, weight: float, stiffness: float, mass: float, speed: float) -> float:
    """Whether a caught fork matters beside the weight on the rope.

        max( v (K m_1)^(1/2), P - Q )/Q

    Args:
        force: P, of the motor at the hook at its largest [N].
        weight: Q, on the rope [N].
        stiffness: K, of the rope at the hook [N/m].
        mass: m_1, of the drive at the hook [kg].
        speed: v, of hoisting [m/s].

    Returns:
        the number; below 0.05 catching the rack is no load case of its own [1].

    **Range** every hoist.
    **Error** an engineering measure: a motor that pulls on matters at any speed.
    **Source** derived from `caught_force`.
    """
    return max(speed * math.sqrt(stiffness) * math.sqrt(mass), force - weight) / weight


def slope_number(slope: float, stiffness: float, mass: float) -> float:
    """How far the slope of a motor damps the shock of a caught fork.

        z = h/(2 (K m_1)^(1/2))

    Args:
        slope: h, by which the motor's force rises as its speed falls [N*s/m].
        stiffness: K, of the rope at the hook [N/m].
        mass: m_1, of the drive at the hook [kg].

    Returns:
        z; above 1 the rope comes to the stall force without overshoot [1].

    **Range** a straight line of force over speed.
    **Error** exact for a carriage that is held.
    **Source** damping ratio of m_1 x'' + h x' + K x.
    """
    return slope / (2 * math.sqrt(stiffness) * math.sqrt(mass))
