"""The wire rope of a hoist: metallic area, stiffness at the hook, safety.

Standards: ISO 4308-1:2003 (selection of wire ropes), ISO 2408:2017 and EN 12385-4:2002 (rope data). The modulus is that
of the rope on its metallic area, 90 to 130 GPa, not that of its wire: strands give way as they settle.
"""

import math


def metallic_area(diameter: float, fill_factor: float) -> float:
    """Metallic cross-section of a rope.

        A = f pi d^2/4

    Args:
        diameter: d, nominal [m].
        fill_factor: f, 0.4 with a fibre core to 0.6 and more compacted [1].

    Returns:
        A [m^2].

    **Range** round ropes.
    **Error** that of the fill factor.
    **Source** definition of the fill factor, ISO 17893:2004.
    """
    return fill_factor * math.pi * diameter**2 / 4


def hook_stiffness(modulus: float, area: float, falls: int, ropes: int, rope_length: float) -> float:
    """Stiffness of a reeved rope, felt at the hook.

        K = n (m/n)^2 E A/l

    which without a lead to the drum, l = m H/n, is m E A/H.

    Args:
        modulus: E, of the rope [N/m^2].
        area: A, metallic area of a rope [m^2].
        falls: m, parts of rope the load hangs on.
        ropes: n, parts of rope that run onto the drum.
        rope_length: l, of one rope between drum and fixed end or equalising sheave [m].

    Returns:
        K [N/m].

    **Range** a rope that runs freely over its sheaves; sheaves that hold the rope by friction stiffen small motions.
    **Error** that of the modulus.
    **Source** a hook that sinks by x takes m x/n of each rope and is pulled by m/n of each. The formula of Fidrovska
        and Varchenko for the multilayer winding of a tackle, E A/l with l the whole rope, misses (m/n)^2.
    """
    return modulus * area / rope_length * (falls / ropes) * falls


def rope_safety(breaking_force: float, pull: float) -> float:
    """Safety of a rope, the coefficient Z_p of its standard.

        Z_p = F_min/S

    Args:
        breaking_force: F_min, smallest breaking force of the rope [N].
        pull: S, largest pull in service, without acceleration [N].

    Returns:
        Z_p; infinite without a pull [1].

    **Range** ropes that run on drums and sheaves of the ratios of their group.
    **Error** exact.
    **Source** ISO 4308-1:2003; quoted from secondary sources.
    """
    return breaking_force / pull if pull > 0 else math.inf
