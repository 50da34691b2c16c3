"""Inertia of a drive brought to one shaft or to the rim of its drum.

Which way the efficiency enters depends on which way the power flows while the inertia is accelerated or braked:
`drive` from the motor to the load, `brake` from the load to the motor, `energy` for the stored kinetic energy alone.
The mode holds for an inertia that acts alone; beside a static load the sign of the total torque decides
(`gearing.motor_torque`).
"""

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

DRIVE, BRAKE, ENERGY = "drive", "brake", "energy"


def _loss(efficiency: float, flow: str) -> float:
    """What a gear makes of an inertia behind it, seen from the motor."""
    if flow not in (DRIVE, BRAKE, ENERGY):
        raise ValueError(f"the flow of power is {DRIVE}, {BRAKE} or {ENERGY}")
    return 1 / efficiency if flow == DRIVE else efficiency if flow == BRAKE else 1.0


def reduced_drive_mass(
    motor_side_inertia: float, ratio: float, efficiency: float, drum_inertia: float, drum_radius: float
) -> float:
    """Mass at the rim that stands for motors, couplings and drum while the motors drive.

        m = J i^2 eta / R^2 + J_drum / R^2

    From the motor's balance (M - J e) i eta / R = F: the efficiency enters with the same power as in the rim
    force M i eta / R, so it is never put in one of them only. The drum sits behind the gear.

    Args:
        motor_side_inertia: J, rotors and couplings of all motors on the motor shaft [kg*m^2].
        ratio: i, motor speed over drum speed [1].
        efficiency: eta, of the gear from motor to drum [1].
        drum_inertia: J_drum, drum on its own shaft [kg*m^2].
        drum_radius: R, drum radius [m].

    Returns:
        m [kg].

    **Range** power flows from motor to drum; when the load drives the motor, eta divides instead.
    **Error** exact for a gear of constant efficiency.
    **Source** lecture notes Kramatorsk 2007, reduction of inertia in power mode.
    """
    return (motor_side_inertia * ratio**2 * efficiency + drum_inertia) / drum_radius**2


def inertia_on_motor_shaft(inertia: float, ratio: float, efficiency: float, flow: str) -> float:
    """Moment of inertia of a slow shaft as the motor feels it.

        drive: J/(u^2 eta)      brake: J eta/u^2      energy: J/u^2

    Args:
        inertia: J, on the slow shaft [kg*m^2].
        ratio: u, motor speed over speed of the slow shaft [1].
        efficiency: eta, of the gear between, in the direction of the flow [1].
        flow: `drive`, `brake` or `energy`.

    Returns:
        inertia on the motor shaft [kg*m^2].

    **Range** the inertia alone loads the gear; with a static load beside it use `gearing.motor_torque`.
    **Error** exact for a gear of constant efficiency.
    **Source** lecture notes Kramatorsk 2007: in power mode eta stands in one line with u^2, in braking in the other.

    Raises:
        ValueError: for another flow.
    """
    return inertia / ratio**2 * _loss(efficiency, flow)


def inertia_on_slow_shaft(inertia: float, ratio: float, efficiency: float, flow: str) -> float:
    """Moment of inertia of the motor shaft as the slow shaft feels it.

        drive: J u^2 eta      brake: J u^2/eta      energy: J u^2

    Args:
        inertia: J, on the motor shaft [kg*m^2].
        ratio: u, motor speed over speed of the slow shaft [1].
        efficiency: eta, of the gear between, in the direction of the flow [1].
        flow: `drive`, `brake` or `energy`.

    Returns:
        inertia on the slow shaft [kg*m^2].

    **Range** the gear is loaded in the direction of the flow.
    **Error** exact for a gear of constant efficiency.
    **Source** lecture notes Kramatorsk 2007: in power mode eta stands in one line with u^2, in braking in the other.

    Raises:
        ValueError: for another flow.
    """
    return inertia * ratio**2 / _loss(efficiency, flow)


def mass_on_motor_shaft(
    mass: float, radius: float, reeving: float, ratio: float, efficiency: float, flow: str
) -> float:
    """Moment of inertia on the motor shaft that stands for a mass moved by a drum or a wheel.

        drive: m r^2/(a^2 u^2 eta)      brake: m r^2 eta/(a^2 u^2)      energy: m r^2/(a^2 u^2)

    Args:
        mass: m, that travels or hangs on the hook [kg].
        radius: r, of drum or wheel [m].
        reeving: a, rope speed at the drum over hook speed; 1 for a wheel [1].
        ratio: u, motor speed over speed of drum or wheel [1].
        efficiency: eta, from motor to mass: gear, drum and tackle [1].
        flow: `drive`, `brake` or `energy`.

    Returns:
        inertia on the motor shaft [kg*m^2].

    **Range** rope or wheel without slip; otherwise as `inertia_on_motor_shaft`.
    **Error** exact for constant efficiency.
    **Source** lecture notes Kramatorsk 2007; v = r omega/(a u).

    Raises:
        ValueError: for another flow.
    """
    return inertia_on_motor_shaft(mass * (radius / reeving) ** 2, ratio, efficiency, flow)


def slewing_inertia(
    load: float,
    load_arm: float,
    crane: float,
    crane_arm: float,
    counterweight: float,
    counterweight_arm: float,
    gravity: float,
) -> float:
    """Moment of inertia of a slewing crane about its axis, its parts as points.

        J = (Q a^2 + G b^2 + G_cw c^2) / g

    Args:
        load: Q, weight of load and hook [N].
        load_arm: a, from the slewing axis to the load [m].
        crane: G, weight of the slewing structure [N].
        crane_arm: b, from the axis to its centre of mass [m].
        counterweight: G_cw [N].
        counterweight_arm: c, from the axis to it [m].
        gravity: g [m/s^2].

    Returns:
        J [kg*m^2].

    **Range** add the central inertia of a part longer than its arm (`bodies.rod_radial`); the hanging load counts
    like this for a slow start only, otherwise it swings.
    **Error** leaves out the central inertias, (l/a)^2/12 of its share for a part of length l.
    **Source** lecture notes Kramatorsk 2007, slewing inertia.
    """
    return (load * load_arm**2 + crane * crane_arm**2 + counterweight * counterweight_arm**2) / gravity


def rotating_parts_coefficient(
    motor_inertia: float,
    inertias: FloatArray,
    stage_ratios: FloatArray,
    stage_efficiencies: FloatArray,
    flow: str,
) -> float:
    """How much more than its rotor a drive has to accelerate in rotating parts.

        drive: delta = 1 + sum J_i/(J_1 u_1i^2 eta_1i)      brake: eta_1i in the numerator      energy: without it

    u_1i and eta_1i are the products over the stages between the motor shaft and shaft i.

    Args:
        motor_inertia: J_1, on the motor shaft [kg*m^2].
        inertias: J_i, of the shafts behind each stage in turn, shape (n,) [kg*m^2].
        stage_ratios: of each stage, shape (n,) [1].
        stage_efficiencies: of each stage in the direction of the flow, shape (n,) [1].
        flow: `drive`, `brake` or `energy`.

    Returns:
        delta [1].

    **Range** rotating parts only: load and travelling masses come on top.
    **Error** exact for an inertia that acts alone; a handbook takes 1.1 to 1.25 when only J_1 is known.
    **Source** lecture notes Kramatorsk 2007, coefficient of rotating parts.

    Raises:
        ValueError: for another flow.
    """
    ratio, efficiency = np.cumprod(np.asarray(stage_ratios, float)), np.cumprod(np.asarray(stage_efficiencies, float))
    seen = [
        inertia_on_motor_shaft(float(j), float(u), float(eta), flow)
        for j, u, eta in zip(np.asarray(inertias, float), ratio, efficiency, strict=True)
    ]
    return 1 + sum(seen) / motor_inertia
