"""A sprocket as the polygon it is: its size, how unevenly it moves a chain, how hard a joint meets a tooth.

R = p/(2 sin(pi/z)) is the radius of the pins, not z p/(2 pi). V is the mean speed of the chain, exactly z p per turn;
the pins themselves move at omega R, which is more. h = pi/z is half the angle of one pitch.

Source of the textbook forms: N. Yu. Dorokhov, "Dynamics of hoisting and conveying machines", lecture notes,
Kramatorsk 2007 (the chapters on the chain conveyor and on the element of chain drives).
"""

import math

OF_LARGEST, OF_MEAN = "largest", "mean"
TRANSLATING, GUIDED = "translating", "guided"


def pitch_radius(pitch: float, teeth: int) -> float:
    """Radius of the circle through the pins of a chain on its sprocket.

        R = p/(2 sin(pi/z))

    Args:
        pitch: p [m].
        teeth: z, at least 3.

    Returns:
        R [m].

    **Range** any number of teeth from 3.
    **Error** exact for an unworn chain; a worn one rides higher by its elongation.
    **Source** lecture notes Kramatorsk 2007: sin(alpha/2) = p/(2 R).
    """
    return pitch / (2 * math.sin(math.pi / teeth))


def sprocket_speed(chain_speed: float, pitch: float, teeth: int) -> float:
    """Angular speed of a sprocket from the mean speed of its chain.

        w = 2 pi V/(z p)

    Args:
        chain_speed: V, mean speed of the chain [m/s].
        pitch: p [m].
        teeth: z.

    Returns:
        w [rad/s].

    **Range** a chain that does not skip.
    **Error** exact.
    **Source** lecture notes Kramatorsk 2007; one turn moves z pitches.
    """
    return 2 * math.pi / teeth * (chain_speed / pitch)


def speed_extremes(chain_speed: float, teeth: int) -> tuple[float, float]:
    """Smallest and largest speed of a chain on a sprocket that turns evenly.

        v_min = V h/tan(h),   v_max = w R = V h/sin(h),   h = pi/z

    Args:
        chain_speed: V, mean speed of the chain [m/s].
        teeth: z.

    Returns:
        (v_min, v_max) [m/s].

    **Range** a straight strand that leaves the sprocket in one direction.
    **Error** exact.
    **Source** lecture notes Kramatorsk 2007: v = w R cos(phi).
    """
    half = math.pi / teeth
    return chain_speed * half / math.tan(half), chain_speed * half / math.sin(half)


def speed_ripple(teeth: int, reference: str) -> float:
    """How unevenly a sprocket that turns evenly moves its chain.

        largest: (v_max - v_min)/v_max = 1 - cos(pi/z)      mean: (v_max - v_min)/V = (pi/z) tan(pi/(2 z))

    Args:
        teeth: z.
        reference: `largest` (recommended: the figure of handbooks) or `mean`.

    Returns:
        ripple [1].

    **Range** as `speed_extremes`; pi^2/(2 z^2) is a common approximation of both.
    **Error** exact.
    **Source** `speed_extremes`; 1 - cos(pi/z) in ACA and chain manufacturers' handbooks.

    Raises:
        ValueError: for another reference.
    """
    half = math.pi / teeth
    if reference == OF_LARGEST:
        return 2 * math.sin(half / 2) ** 2
    if reference == OF_MEAN:
        return half * math.tan(half / 2)
    raise ValueError(f"the ripple is relative to the `{OF_LARGEST}` or the `{OF_MEAN}` speed, not `{reference}`")


def pitch_fraction(length: float, pitch: float) -> float:
    """Place in the pitch of the joints at the other end of a stretch of chain.

        x = L/p - floor(L/p)

    Two sprockets, or run-on and run-off of one with L the arc between them, move the ends of a strand with this
    difference of their places.

    Args:
        length: L, of the stretch between both engagements [m].
        pitch: p [m].

    Returns:
        x, at least 0 and below 1 [1].

    **Range** an unworn chain under its working tension.
    **Error** that of L: a stretch of a few hundred worn pitches knows its x no more; take the worst of all.
    **Source** joints are one pitch apart.
    """
    return length / pitch % 1.0


def transverse_speed(chain_speed: float, teeth: int) -> float:
    """Largest speed across the strand of the joint that just meets or leaves the sprocket.

        v = w R sin(pi/z) = w p/2 = pi V/z

    Args:
        chain_speed: V, mean speed of the chain [m/s].
        teeth: z.

    Returns:
        v [m/s].

    **Range** as `speed_extremes`.
    **Error** exact.
    **Source** lecture notes Kramatorsk 2007; kinematics of the polygon.
    """
    return chain_speed * (math.pi / teeth)


def transverse_travel(pitch: float, teeth: int) -> float:
    """How far the end of the strand moves across it within one pitch.

        y = R (1 - cos(pi/z)) = (p/2) tan(pi/(2 z))

    Args:
        pitch: p [m].
        teeth: z.

    Returns:
        y, from the lowest to the highest position [m].

    **Range** as `speed_extremes`.
    **Error** exact.
    **Source** kinematics of the polygon.
    """
    return pitch / 2 * math.tan(math.pi / (2 * teeth))


def engagement_speed(chain_speed: float, teeth: int, strand: str) -> float:
    """Speed at which a joint of the chain meets its tooth, along the radius that bisects the pitch.

        translating: v = w p = 2 pi V/z      guided: v = w p/2 = pi V/z

    Args:
        chain_speed: V, mean speed of the chain [m/s].
        teeth: z.
        strand: `translating` (recommended: the free strand moves as its last joint on the sprocket does) or `guided`
            (a rail holds the strand in its line).

    Returns:
        v [m/s].

    **Range** a chain that is not worn; a free strand moves between both.
    **Error** exact for either case.
    **Source** derived: both joints have the speed w R, at an angle of one pitch to each other.

    Raises:
        ValueError: for another strand.
    """
    if strand == TRANSLATING:
        return 2 * transverse_speed(chain_speed, teeth)
    if strand == GUIDED:
        return transverse_speed(chain_speed, teeth)
    raise ValueError(f"a strand is `{TRANSLATING}` or `{GUIDED}`, not `{strand}`")


def engagement_energy(link_mass: float, speed: float, normal_share: float) -> float:
    """Energy a link loses as its joint meets a tooth.

        E = m (v c)^2/2

    Args:
        link_mass: m, of one link with what is fixed to it [kg].
        speed: v, of `engagement_speed` [m/s].
        normal_share: c, part of it normal to the flank, 1 on the safe side [1].

    Returns:
        E [J].

    **Range** a plastic blow; the links behind follow later.
    **Error** an estimate: the mass that takes part is between half a link and several.
    **Source** lecture notes Kramatorsk 2007 name the blow; derived.
    """
    return link_mass * (speed * normal_share) ** 2 / 2
