"""The safety gear of a lifting carriage: from the break of the rope to rest.

The carriage goes down at the speed v when its rope breaks, falls freely until the governor trips at k v, and on until
the gear has closed; a progressive gear then brakes with a constant force, an instantaneous one is a stiff spring.
"""

import math


def trip_speed(speed: float, ratio: float) -> float:
    """Speed at which the governor trips.

        v_t = k v

    Args:
        speed: v, rated speed of lowering [m/s].
        ratio: k, from 1.2 to 1.5 in most governors [1].

    Returns:
        v_t [m/s].

    **Range** k >= 1.
    **Error** a setting, not a law.
    **Source** lifts and stacker cranes: the governor's plate.
    """
    return ratio * speed


def trip_time(speed: float, ratio: float, gravity: float) -> float:
    """Time of free fall until the governor trips.

        t = (k - 1) v/g

    Args:
        speed: v, as the rope breaks [m/s].
        ratio: k, of `trip_speed` [1].
        gravity: g [m/s^2].

    Returns:
        t [s].

    **Range** free fall: no counterweight, no friction of guides.
    **Error** exact for that; friction makes it longer.
    **Source** free fall.
    """
    return (ratio - 1) * speed / gravity


def catch_speed(speed: float, ratio: float, reaction: float, gravity: float) -> float:
    """Speed at which the gear begins to hold.

        v_c = k v + g t_r

    Args:
        speed: v, rated speed of lowering [m/s].
        ratio: k, of `trip_speed` [1].
        reaction: t_r, from the trip until the gear holds [s].
        gravity: g [m/s^2].

    Returns:
        v_c [m/s].

    **Range** as `trip_time`.
    **Error** exact for free fall.
    **Source** free fall.
    """
    return trip_speed(speed, ratio) + gravity * reaction


def fall_before_catch(speed: float, catch: float, gravity: float) -> float:
    """Way of free fall until the gear holds.

        h = (v_c^2 - v^2)/(2 g)

    Args:
        speed: v, as the rope breaks [m/s].
        catch: v_c, of `catch_speed`, at least v [m/s].
        gravity: g [m/s^2].

    Returns:
        h [m].

    **Range** as `trip_time`.
    **Error** exact for free fall.
    **Source** free fall.
    """
    return (catch - speed) * ((catch + speed) / (2 * gravity))


def progressive_deceleration(force: float, mass: float, gravity: float) -> float:
    """Deceleration by a progressive gear.

        a = F_c/M - g

    Args:
        force: F_c, of the gear, constant [N].
        mass: M, of carriage and load [kg].
        gravity: g [m/s^2].

    Returns:
        a; 0 or below where the gear does not hold [m/s^2].

    **Range** a gear of constant force.
    **Error** exact for that gear.
    **Source** Newton's law.
    """
    return force / mass - gravity


def progressive_distance(force: float, mass: float, speed: float, gravity: float) -> float:
    """Way in which a progressive gear stops the carriage.

        s = v_c^2/(2 (F_c/M - g))

    Args:
        force: F_c, of the gear, constant [N].
        mass: M, of carriage and load [kg].
        speed: v_c, of `catch_speed` [m/s].
        gravity: g [m/s^2].

    Returns:
        s; infinite for F_c <= M g, a gear that does not hold [m].

    **Range** a gear of constant force.
    **Error** exact for that gear.
    **Source** energy M v_c^2/2 + M g s = F_c s.
    """
    slows = progressive_deceleration(force, mass, gravity)
    if slows <= 0:
        return math.inf
    return speed * (speed / (2 * slows))


def gear_force_needed(mass: float, speed: float, stroke: float, gravity: float) -> float:
    """Force of a progressive gear that stops the carriage within a stroke.

        F = M (g + v_c^2/(2 s))

    Args:
        mass: M, of carriage and load [kg].
        speed: v_c, of `catch_speed` [m/s].
        stroke: s, there is [m].
        gravity: g [m/s^2].

    Returns:
        F [N].

    **Range** a gear of constant force.
    **Error** exact for that gear.
    **Source** `progressive_distance`, solved for the force.
    """
    return mass * (gravity + speed * (speed / (2 * stroke)))


def gear_speed_left(force: float, mass: float, speed: float, stroke: float, gravity: float) -> float:
    """Speed that a progressive gear leaves at the end of its stroke.

        v_1 = (v_c^2 - 2 a s)^(1/2),   a = F_c/M - g

    Args:
        force: F_c, of the gear, constant [N].
        mass: M, of carriage and load [kg].
        speed: v_c, of `catch_speed` [m/s].
        stroke: s, there is [m].
        gravity: g [m/s^2].

    Returns:
        v_1; 0 where it stops before, above v_c where the gear does not hold [m/s].

    **Range** a gear of constant force.
    **Error** exact for that gear.
    **Source** energy.
    """
    slows = progressive_deceleration(force, mass, gravity)
    if slows <= 0:
        return math.hypot(speed, math.sqrt(-slows) * math.sqrt(2 * stroke))
    taken = math.sqrt(slows) * math.sqrt(2 * stroke)
    return math.sqrt((speed - taken) * (speed + taken)) if speed > taken else 0.0


def instantaneous_force(mass: float, stiffness: float, speed: float, gravity: float) -> float:
    """Force of an instantaneous gear: rollers or eccentrics that bite into the guide.

        F = M g + ((M g)^2 + K M v_c^2)^(1/2)

    Args:
        mass: M, of carriage and load [kg].
        stiffness: K, of gear, guide and mast, one behind the other [N/m].
        speed: v_c, of `catch_speed` [m/s].
        gravity: g [m/s^2].

    Returns:
        F; at least twice the weight at any speed [N].

    **Range** an elastic gear that stays closed.
    **Error** exact for a spring; crushed metal makes it less.
    **Source** energy M v_c^2/2 + M g x = K x^2/2.
    """
    weight = mass * gravity
    return weight + math.hypot(weight, speed * math.sqrt(stiffness) * math.sqrt(mass))


def eccentric_moment(force: float, arm: float) -> float:
    """Moment that the gear puts on the mast.

        M = F a

    Args:
        force: F, of the gear [N].
        arm: a, from the guide to the axis of the mast [m].

    Returns:
        M [N*m].

    **Range** both gears hold at once; one that lags behind tilts the carriage as well.
    **Error** exact for the static moment; `axial_shock` for its rise.
    **Source** statics.
    """
    return force * arm


def axial_shock(force: float) -> float:
    """Largest force at the foot of a mast on which a constant force is put at once.

        N = 2 F

    Args:
        force: F, along the mast, anywhere on it [N].

    Returns:
        N; without its own weight [N].

    **Range** a uniform mast of length l, its foot fast, its top free; a force at the height z that lasts longer than
    (2 l - z)/c, some milliseconds.
    **Error** exact without damping.
    **Source** derived: waves of F/2 go down and up; the one doubles at the foot at z/c, the other is turned round at
    the top and doubles there at (2 l - z)/c; the next two take both away again.
    """
    return 2 * force
