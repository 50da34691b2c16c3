"""Reduced mass of a drive against balances of power and momentum that know nothing of it."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import solve

from ptmcalc.laws import inertia, motor

SEED = 20


def machines(count: int) -> list[dict[str, float]]:
    rng = np.random.default_rng(SEED)
    return [
        {
            "motor_side_inertia": float(rng.uniform(0.1, 20)),
            "ratio": float(rng.uniform(1, 60)),
            "efficiency": float(rng.uniform(0.5, 1)),
            "drum_inertia": float(rng.uniform(0, 500)),
            "drum_radius": float(rng.uniform(0.1, 1)),
        }
        for _ in range(count)
    ]


@pytest.mark.parametrize("machine", machines(8))
def test_kinetic_energy_without_losses(machine: dict[str, float]) -> None:
    """A lossless gear: the mass at the rim holds the energy of rotor and drum."""
    machine = machine | {"efficiency": 1.0}
    speed = 2.7
    drum = speed / machine["drum_radius"]
    rotor = drum * machine["ratio"]
    energy = machine["motor_side_inertia"] * rotor**2 / 2 + machine["drum_inertia"] * drum**2 / 2
    assert inertia.reduced_drive_mass(**machine) * speed**2 / 2 == pytest.approx(energy, rel=1e-13)


@pytest.mark.parametrize("machine", machines(8))
def test_the_gear_loses_its_share_of_the_power_that_enters_it(machine: dict[str, float]) -> None:
    """Power balance while the motor drives: what the rotor does not keep enters the gear, eta of it leaves; the rim
    gets what the drum does not keep. Integrated over a start against a rim load, the speed follows the mass."""
    torque, load = 50.0, 10.0
    rotor_inertia, ratio, eta, drum_inertia, radius = machine.values()

    def rate(t: float, rim_speed: np.ndarray) -> np.ndarray:
        # unknown: rotor acceleration, drum acceleration, shaft torque before and after the gear
        system = np.array(
            [
                [rotor_inertia, 0, 1, 0],  # J e = M - T
                [1, -ratio, 0, 0],  # kinematics
                [0, 0, eta * ratio, -1],  # power out = eta * power in
                [0, drum_inertia, 0, -1],  # J_d e_d = T_d - F R
            ]
        )
        return np.array([solve(system, [torque, 0, 0, -load * radius])[1] * radius])

    history = solve_ivp(rate, (0, 3), [0.0], rtol=1e-10, atol=1e-12)
    mass = inertia.reduced_drive_mass(**machine)
    force = motor.rim_force(torque, ratio, eta, radius)
    assert history.y[0, -1] == pytest.approx((force - load) / mass * 3, rel=1e-9)


def test_efficiency_counts_for_the_motor_side_and_not_for_the_drum() -> None:
    """A worse gear makes the rotor look lighter from the rim, never heavier; the drum sits behind the gear."""
    rotor_only = [inertia.reduced_drive_mass(4.0, 20.0, eta, 0.0, 0.4) for eta in (0.6, 0.8, 1.0)]
    assert rotor_only == pytest.approx([0.6 * rotor_only[2], 0.8 * rotor_only[2], rotor_only[2]], rel=1e-14)
    drum_only = [inertia.reduced_drive_mass(0.0, 20.0, eta, 32.0, 0.4) for eta in (0.6, 0.8, 1.0)]
    assert drum_only == pytest.approx([200.0] * 3, rel=1e-14)


def test_several_motors_on_one_gear_add_their_inertia() -> None:
    one = inertia.reduced_drive_mass(2.0, 15.0, 0.9, 0.0, 0.5)
    assert inertia.reduced_drive_mass(2 * 2.0, 15.0, 0.9, 0.0, 0.5) == pytest.approx(2 * one, rel=1e-14)


def test_a_hoop_at_the_rim_is_its_own_mass() -> None:
    radius, mass = 0.63, 410.0
    assert inertia.reduced_drive_mass(0.0, 1.0, 1.0, mass * radius**2, radius) == pytest.approx(mass, rel=1e-14)
