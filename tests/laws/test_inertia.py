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


# --- reduction to a shaft ---------------------------------------------------------------------------------------


def accelerations(
    torque: float, motor_inertia: float, slow_inertia: float, ratio: float, out_over_in: float, load: float
) -> np.ndarray:
    """Motor and slow shaft and the torques on both sides of the mesh, from the four balances of the train."""
    system = np.array(
        [
            [motor_inertia, 0, 1, 0],  # J1 e1 = M - T_in
            [1, -ratio, 0, 0],  # e1 = u e2
            [0, 0, out_over_in * ratio, -1],  # T_out = u (loss) T_in
            [0, slow_inertia, 0, -1],  # J2 e2 = T_out - load
        ]
    )
    return solve(system, [torque, 0, 0, -load])


class TestReductionToTheMotorShaft:
    @pytest.mark.parametrize(
        ("flow", "out_over_in"),
        [(inertia.DRIVE, 0.85), (inertia.BRAKE, 1 / 0.85), (inertia.ENERGY, 1.0)],
        ids=["drive", "brake", "energy"],
    )
    def test_accelerates_like_the_train(self, flow: str, out_over_in: float) -> None:
        """Driven, the mesh lets out 0.85 of the torque times the ratio; driving the motor, 0.85 of what comes in."""
        torque, rotor, slow, ratio = 40.0, 0.9, 310.0, 24.0
        reduced = inertia.inertia_on_motor_shaft(slow, ratio, 0.85, flow)
        exact = accelerations(torque, rotor, slow, ratio, out_over_in, 0.0)[0]
        assert torque / (rotor + reduced) == pytest.approx(exact, rel=1e-12)

    @pytest.mark.parametrize(
        ("flow", "out_over_in", "torque"),
        [(inertia.DRIVE, 0.85, -900.0), (inertia.BRAKE, 1 / 0.85, 900.0), (inertia.ENERGY, 1.0, 900.0)],
        ids=["drive", "brake", "energy"],
    )
    def test_carries_the_rotor_to_the_slow_shaft(self, flow: str, out_over_in: float, torque: float) -> None:
        """A torque on the slow shaft alone: braked there, the rotor drives on; pushed, it is dragged along."""
        rotor, slow, ratio = 0.9, 310.0, 24.0
        reduced = inertia.inertia_on_slow_shaft(rotor, ratio, 0.85, flow)
        exact = accelerations(0.0, rotor, slow, ratio, out_over_in, -torque)[1]
        assert torque / (slow + reduced) == pytest.approx(exact, rel=1e-12)

    def test_energy_of_a_hoisted_mass(self) -> None:
        mass, radius, reeving, ratio, motor_speed = 8000.0, 0.2, 2.0, 40.0, 150.0
        hook_speed = motor_speed / ratio * radius / reeving
        reduced = inertia.mass_on_motor_shaft(mass, radius, reeving, ratio, 0.9, inertia.ENERGY)
        assert reduced * motor_speed**2 / 2 == pytest.approx(mass * hook_speed**2 / 2, rel=1e-13)

    @pytest.mark.parametrize("flow", [inertia.DRIVE, inertia.BRAKE])
    def test_a_mass_on_a_drum_is_a_hoop_of_the_drum(self, flow: str) -> None:
        hoop = inertia.inertia_on_motor_shaft(500.0 * 0.3**2, 12.0, 0.9, flow)
        assert inertia.mass_on_motor_shaft(500.0, 0.3, 1.0, 12.0, 0.9, flow) == pytest.approx(hoop, rel=1e-14)


class TestSlewingInertia:
    def test_of_points_is_the_kinetic_energy_of_points(self) -> None:
        weights, arms, g, speed = np.array([49e3, 78e3, 59e3]), np.array([8.0, 2.5, 3.0]), 9.81, 0.16
        energy = float(np.sum(weights / g * (speed * arms) ** 2 / 2))
        pairs = [value for pair in zip(weights, arms, strict=True) for value in map(float, pair)]
        assert inertia.slewing_inertia(*pairs, g) * speed**2 / 2 == pytest.approx(energy, rel=1e-13)


class TestRotatingParts:
    INERTIAS, RATIOS, LOSSES = np.array([1.5, 20.0, 150.0]), np.array([4.0, 5.0, 4.0]), np.array([0.97, 0.97, 0.96])

    def shaft_by_shaft(self, power: int) -> float:
        """From the last shaft forward: each stage passes on what is behind it, losses as eta^power."""
        behind = 0.0
        for own, ratio, eta in zip(self.INERTIAS[::-1], self.RATIOS[::-1], self.LOSSES[::-1], strict=True):
            behind = (own + behind) / ratio**2 * eta**power
        return 1 + behind / 0.4

    @pytest.mark.parametrize(("flow", "power"), [(inertia.DRIVE, -1), (inertia.BRAKE, 1), (inertia.ENERGY, 0)])
    def test_is_what_each_stage_passes_on(self, flow: str, power: int) -> None:
        found = inertia.rotating_parts_coefficient(0.4, self.INERTIAS, self.RATIOS, self.LOSSES, flow)
        assert found == pytest.approx(self.shaft_by_shaft(power), rel=1e-13)

    def test_of_a_motor_alone_is_one(self) -> None:
        nothing = np.array([])
        assert inertia.rotating_parts_coefficient(0.4, nothing, nothing, nothing, inertia.DRIVE) == 1.0
