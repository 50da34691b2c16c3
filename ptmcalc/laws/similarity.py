"""Model tests of metal structures: the scales between model and prototype, and what a model cannot show.

A scale C is model over prototype. With inertia, external forces and gravity a linear-elastic structure has the groups
F/(E L^2), M/(rho L^3), E/(rho g L), omega L (rho/E)^(1/2) and v^2/(g L). Only `full` keeps all of them. `geometric` is
a plain copy, which leaves gravity out of scale; `ballast` adds masses to the copy, which carry no load themselves.
"""

import math
from dataclasses import dataclass

FULL, GEOMETRIC, BALLAST = "full", "geometric", "ballast"
_SAME = 1e-9
"""How closely the scales have to fit each other: products of given numbers agree up to rounding only."""


@dataclass(frozen=True, slots=True)
class Scales:
    """Model over prototype of each quantity [1]; `torsion` is torque per angle, strains and angles keep their size."""

    length: float
    displacement: float
    force: float
    stress: float
    mass: float
    stiffness: float
    frequency: float
    time: float
    velocity: float
    acceleration: float
    moment: float
    inertia: float
    torsion: float
    damping: float


def scales(law: str, length: float, modulus: float = 1.0, density: float = 1.0, gravity: float = 1.0) -> Scales:
    """All scales of a model that keeps the strains of external forces.

        force C_E C_l^2     stress C_E     stiffness C_E C_l     frequency (C_c/C_m)^(1/2)
        mass  full, geometric: C_rho C_l^3     ballast: C_E C_l^2/C_g

    `full` needs C_E = C_rho C_g C_l. time is 1/frequency, velocity C_l/time, damping (C_c C_m)^(1/2), moment and torque
    per angle C_E C_l^3, moment of inertia C_m C_l^2.

    Args:
        law: `full`, `geometric` or `ballast`.
        length: C_l [1].
        modulus: C_E, of the elastic modulus; 1 for the same material [1].
        density: C_rho, of the material; 1 for the same material [1].
        gravity: C_g; 1 unless the model stands in a centrifuge [1].

    Returns:
        the scales [1].

    **Range** linear elasticity, small displacements.
    **Error** exact for what the law keeps; `distortions` says what it does not.
    **Source** derived: dimensional analysis; lecture notes Kramatorsk 2007, conditions of modelling (heading only).

    Raises:
        ValueError: for another law, for `full` with scales that do not fit, for ballast of negative mass.
    """
    if law not in (FULL, GEOMETRIC, BALLAST):
        raise ValueError(f"a law of similarity is {FULL}, {GEOMETRIC} or {BALLAST}")
    copied, weighty = density * length**3, modulus * length**2 / gravity
    if law == FULL and not math.isclose(copied, weighty, rel_tol=_SAME):
        needed = modulus / (gravity * length)
        raise ValueError(f"full similarity needs a density scale of {needed:.4g}, not {density:.4g}")
    if law == BALLAST and copied > weighty * (1 + _SAME):
        raise ValueError(f"the copy weighs {copied / weighty:.4g} times what it should; ballast cannot be taken off it")
    mass = copied if law == GEOMETRIC else weighty
    stiffness = modulus * length
    frequency = math.sqrt(stiffness / mass)
    return Scales(
        length=length,
        displacement=length,
        force=modulus * length**2,
        stress=modulus,
        mass=mass,
        stiffness=stiffness,
        frequency=frequency,
        time=1 / frequency,
        velocity=length * frequency,
        acceleration=length * frequency**2,
        moment=modulus * length**3,
        inertia=mass * length**2,
        torsion=modulus * length**3,
        damping=math.sqrt(stiffness) * math.sqrt(mass),
    )


def distortions(
    law: str, length: float, modulus: float = 1.0, density: float = 1.0, gravity: float = 1.0
) -> tuple[str, ...]:
    """What a model shows wrongly, in words and numbers, each as model over what similarity asks.

        gravity stress: C_rho C_g C_l/C_E     v^2/(g L) and sway angle a/g: C_E/(C_rho C_g C_l)

    Args:
        law: `full`, `geometric` or `ballast`.
        length: C_l [1].
        modulus: C_E, of the elastic modulus [1].
        density: C_rho, of the material [1].
        gravity: C_g [1].

    Returns:
        one sentence for each.

    **Range** as `scales`.
    **Error** exact for the numbers given; friction, damping and plasticity follow no law of this kind.
    **Source** derived: dimensional analysis; lecture notes Kramatorsk 2007, conditions of modelling (heading only).

    Raises:
        ValueError: as `scales`.
    """
    of = scales(law, length, modulus, density, gravity)
    weight = density * gravity * length / modulus  # gravity stress over what similarity asks
    said = []
    if law == GEOMETRIC and not math.isclose(weight, 1, rel_tol=_SAME):
        said = [
            f"stress and strain of its own weight are {weight:.4g} times what they should be",
            f"v^2/(g L) and the sway angle a/g are {1 / weight:.4g} times what they should be",
            f"the sway period over the periods of the structure is {weight**-0.5:.4g} times what it should be",
        ]
    if law == BALLAST and not math.isclose(weight, 1, rel_tol=_SAME):
        said = [
            f"{1 - weight:.4g} of the mass is ballast, which neither stiffens nor carries: spread it, and fix it so "
            "that no part is stiffened",
            f"members without ballast vibrate {weight**-0.5:.4g} times too fast against the structure",
        ]
    return (
        *said,
        f"damping scales as {of.damping:.4g} only if the damping ratio is the same, which no law ensures",
        "friction coefficients are those of the model's surfaces and do not scale",
        f"the slope of a motor curve, force per speed, has to be {of.force / of.velocity:.4g} times that of the "
        "prototype and does not scale by itself",
    )


@dataclass(frozen=True, slots=True)
class SectionScales:
    """Model over prototype where sections have scales of their own [1]."""

    displacement: float
    bending_stress: float
    axial_displacement: float
    axial_stress: float
    stiffness: float
    frequency: float


def section_scales(
    length: float,
    modulus: float,
    area: float,
    second_moment: float,
    section_modulus: float,
    force: float,
    mass: float,
) -> SectionScales:
    """Scales of a model whose sections are not geometric copies.

        bending:  deflection C_F C_l^3/(C_E C_I)     stress C_F C_l/C_W     stiffness C_E C_I/C_l^3
        axial:    elongation C_F C_l/(C_E C_A)       stress C_F/C_A
        frequency in bending (C_E C_I/(C_m C_l^3))^(1/2)

    Args:
        length: C_l, of the axes [1].
        modulus: C_E [1].
        area: C_A, of the sections [1].
        second_moment: C_I [1].
        section_modulus: C_W [1].
        force: C_F [1].
        mass: C_m, of all masses [1].

    Returns:
        the scales [1].

    **Range** linear problems, where displacements need not be similar to the structure; either bending or axial force
    decides. Both together, buckling and shear deformation need C_I = C_A C_l^2.
    **Error** exact for slender members.
    **Source** derived: beam and bar equations.
    """
    stiffness = modulus * second_moment / length**3
    return SectionScales(
        displacement=force / stiffness,
        bending_stress=force * length / section_modulus,
        axial_displacement=force * length / (modulus * area),
        axial_stress=force / area,
        stiffness=stiffness,
        frequency=math.sqrt(stiffness / mass),
    )


def self_weight_strain(density: float, gravity: float, span: float, modulus: float, depth: float) -> float:
    """Strain of a girder under its own weight, to judge whether a model must keep gravity to scale.

        eps = rho g L^2 / (E h)

    Args:
        density: rho [kg/m^3].
        gravity: g [m/s^2].
        span: L [m].
        modulus: E [N/m^2].
        depth: h, of the girder [m].

    Returns:
        eps; gravity matters above 5 % of the working strain [1].

    **Range** slender girders of any support and section: an order of magnitude.
    **Error** a factor of section and support, 3/4 for a simply supported full rectangle.
    **Source** derived: bending under uniform load.
    """
    return density * gravity * span**2 / (modulus * depth)
