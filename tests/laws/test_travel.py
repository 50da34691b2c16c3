"""Travel on rails: free bodies written anew, a pendulum integrated, and case C19."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from ptmcalc.laws import inertia, skid, travel, wheel_loads

GRAVITY = 9.81


class TestResistance:
    def test_a_wheel_by_moments_about_its_axle(self) -> None:
        """N acts f before the axle, the bearing rubs at d/2; the pull at the axle times D/2 balances both."""
        load, mu, d, f, D = 80e3, 0.015, 0.1, 0.0005, 0.4
        pull = (load * f + mu * load * d / 2) / (D / 2)
        assert travel.rolling_coefficient(mu, d, f, D, 1.0) * load == pytest.approx(pull, rel=1e-14)
        assert travel.rolling_coefficient(mu, d, f, D, 1.5) == pytest.approx(1.5 * pull / load, rel=1e-14)

    def test_wind_of_the_standard(self) -> None:
        assert travel.wind_pressure(20.0) == 250.0
        assert travel.wind_force(250.0, 30.0, 1.6) == pytest.approx(12e3)

    def test_friction_turns_with_the_motion_and_slope_and_wind_do_not(self) -> None:
        forward, rest, back = travel.travel_resistance(np.array([0.7, 0.0, -0.7]), 3e5, 0.01, 0.004, 5e3)
        grade = 3e5 * math.sin(0.004)
        assert forward - back == pytest.approx(2 * 0.01 * 3e5 * math.cos(0.004), rel=1e-12)
        assert rest == pytest.approx(grade + 5e3, rel=1e-12)

    @pytest.mark.parametrize(("slope", "wind"), [(0.004, 2e4), (-0.004, -2e4), (0.0, 1e3), (0.003, -900.0)])
    def test_what_holds_is_what_lacks_at_the_break_away(self, slope: float, wind: float) -> None:
        held = travel.holding_force(3e5, 0.006, slope, wind)
        drive = 3e5 * math.sin(slope) + wind
        friction = 0.006 * 3e5 * math.cos(slope)
        assert held == pytest.approx(max(0.0, abs(drive) - friction))
        assert (held == 0) == (abs(drive) <= friction)


class TestCaseC19:
    """24 t on four wheels, two of them driven: theory, case C19."""

    MASS, RADIUS, RATIO, ETA, ROTOR, MU, W = 24e3, 0.2, 20.0, 0.9, 0.8, 0.14, 0.01

    def test_printed_numbers(self) -> None:
        weight = self.MASS * GRAVITY
        resistance = float(travel.travel_resistance(1.0, weight, self.W, 0.0, 0.0))
        assert resistance == pytest.approx(2354.4, rel=1e-9)
        reduced = self.MASS + inertia.reduced_drive_mass(self.ROTOR, self.RATIO, self.ETA, 0.0, self.RADIUS)
        assert reduced == pytest.approx(31200.0, rel=1e-9)
        a = (150.0 * self.RATIO * self.ETA / self.RADIUS - resistance) / reduced
        assert a == pytest.approx(0.357231, rel=1e-5)
        loads, shares = np.full(2, weight / 4), np.full(2, 0.5)
        forces = skid.driven_forces(self.MASS, a, resistance, shares)
        assert np.sum(forces) == pytest.approx(10927.9, rel=1e-5)
        assert skid.skid_reserve(self.MU, loads, forces) == pytest.approx([1.50813, 1.50813], rel=1e-5)
        still = np.zeros(2)
        slips = skid.slip_accelerations(self.MASS, resistance, self.MU, shares, loads, still)
        assert slips == pytest.approx([0.5886, 0.5886], rel=1e-9)
        brakes = skid.slip_accelerations(self.MASS, -resistance, self.MU, shares, loads, still)
        assert brakes == pytest.approx([0.7848, 0.7848], rel=1e-9)
        limit = skid.slip_motor_torque(float(slips[0]), reduced, resistance, self.RADIUS, self.RATIO, self.ETA)
        assert limit == pytest.approx(230.208, rel=1e-5)

    def test_what_the_driven_wheels_take_themselves_never_reaches_the_rail(self) -> None:
        """The printed reserve lets the rail carry all of the resistance; half of it is the driven wheels' own."""
        a, load = 0.35723077, self.MASS * GRAVITY / 4
        wheel_torque = (self.MASS * a + 2354.4) / 2 * self.RADIUS
        force = skid.wheel_grip(wheel_torque, self.RADIUS, load, self.W, 0.0, a)
        balance = 2 * float(force) - 2 * self.W * load  # driven wheels push, the others are pushed
        assert balance == pytest.approx(self.MASS * a, rel=1e-9)
        assert skid.skid_reserve(self.MU, load, force) == pytest.approx(1.69022, rel=1e-5)

    def test_the_motors_spin_their_wheels(self) -> None:
        """Twice the torque: the crane stays at the acceleration of its grip, the rims run away."""
        push = 2 * 250.0 * self.RATIO * self.ETA / self.RADIUS
        rotor = inertia.reduced_drive_mass(self.ROTOR, self.RATIO, self.ETA, 0.0, self.RADIUS)
        loads = np.full(2, self.MASS * GRAVITY / 4)
        a = skid.slipping_acceleration(
            np.full(2, push / 2), np.full(2, rotor / 2), self.MASS, 2354.4, self.MU, loads, np.zeros(2)
        )
        assert a == pytest.approx(0.5886, rel=1e-9)
        assert skid.rail_force(a, push / 2, rotor / 2, self.MU, loads[0], 0.0) == pytest.approx(self.MU * loads[0])


class TestWheelByWheel:
    """A bridge whose driven wheels stand one on each rail: the trolley at one end unloads the other one."""

    SPAN, BASE, MU = 24.0, 3.6, 0.14
    WEIGHTS, HEIGHTS = np.array([200e3, 50e3, 200e3]), np.array([0.6, 1.5, 2.0])

    def loads(self, place: float, a: float) -> np.ndarray:
        across = np.array([self.SPAN / 2, place, place])
        still = np.zeros(3)
        return wheel_loads.corner_loads(
            self.WEIGHTS, across, still, -self.WEIGHTS / GRAVITY * a, still, self.HEIGHTS, self.SPAN, self.BASE
        )

    def test_the_mean_passes_and_a_wheel_at_the_far_end_slips(self) -> None:
        mass, a = float(np.sum(self.WEIGHTS)) / GRAVITY, 0.45
        resistance = 0.008 * mass * GRAVITY
        forces = skid.driven_forces(mass, a, resistance, np.full(2, 0.5))
        driven = self.loads(1.0, a)[:, 0]  # the rear wheels of both rails
        mean = self.MU * np.sum(driven) / np.sum(forces)
        each = skid.skid_reserve(self.MU, driven, forces)
        assert mean > 1.2
        assert each[0] > 1.2
        assert each[1] < 1.0

    def test_first_slip_is_where_force_and_grip_meet(self) -> None:
        mass = float(np.sum(self.WEIGHTS)) / GRAVITY
        at_rest, moved = self.loads(1.0, 0.0)[:, 0], self.loads(1.0, 1.0)[:, 0]
        found = skid.slip_accelerations(mass, 3600.0, self.MU, np.full(2, 0.5), at_rest, moved - at_rest)
        for wheel in range(2):

            def gap(a: float, wheel: int = wheel) -> float:
                return 0.5 * (mass * a + 3600.0) - self.MU * float(self.loads(1.0, a)[wheel, 0])

            assert found[wheel] == pytest.approx(brentq(gap, 0, 50), rel=1e-9)

    def test_slips_before_it_moves_and_never(self) -> None:
        found = skid.slip_accelerations(
            1e4, 9e3, 0.1, np.array([0.5, 0.25, 0.25]), np.array([2e4, 4e4, 4e4]), np.array([0.0, 2.5e4, 1e4])
        )
        assert found[0] == 0.0  # needs 4.5 kN of 2 kN
        assert found[1] == math.inf  # its load grows as fast as its force
        assert 0 < found[2] < math.inf

    @pytest.mark.parametrize("change", [4e3, 4e4])
    def test_some_wheels_slip_and_the_others_carry_on(self, change: float) -> None:
        """Against a root found for random cranes, wheel by wheel with Coulomb contact."""
        rng = np.random.default_rng(7)
        partly = 0
        for _ in range(300):
            wheels, sign = int(rng.integers(1, 6)), rng.choice([-1.0, 1.0])
            pushes, rotors = sign * rng.uniform(0, 2e4, wheels), rng.uniform(500, 4e3, wheels)
            loads, transfers = rng.uniform(1e3, 1.2e5, wheels), rng.uniform(-change, change, wheels)

            def rails(a: float, of: tuple = (pushes, rotors, loads, transfers)) -> list[tuple[float, bool]]:
                forces = []
                for push, rotor, load, transfer in zip(*of, strict=True):
                    wish, most = push - rotor * a, 0.14 * max(load + transfer * a, 0.0)
                    forces.append((max(min(wish, most), -most), abs(wish) > most * (1 + 1e-9)))
                return forces

            a = skid.slipping_acceleration(pushes, rotors, 4e4, 3e3, 0.14, loads, transfers)
            found = brentq(lambda a: sum(f for f, _ in rails(a)) - 3e3 - 4e4 * a, -30, 30, xtol=1e-14)
            assert a == pytest.approx(found, abs=1e-10)
            small = [of * 2.0**-30 for of in (pushes, rotors, loads, transfers)]  # a toy of the same crane
            sizes = (4e4 * 2.0**-30, 3e3 * 2.0**-30, 0.14)
            assert a == skid.slipping_acceleration(*small[:2], *sizes, *small[2:])
            forces = [
                float(skid.rail_force(a, *wheel, 0.14, load, transfer))
                for *wheel, load, transfer in zip(pushes, rotors, loads, transfers, strict=True)
            ]
            assert forces == pytest.approx([f for f, _ in rails(found)], abs=1e-5)
            partly += 0 < sum(slips for _, slips in rails(found)) < wheels
        assert partly >= 50

    def test_a_crane_with_a_spinning_wheel_integrated(self) -> None:
        """Two motors of their own, one wheel nearly without load: three bodies with Coulomb contact."""
        push, rotor, mass, mu, loads = 9e3, 3e3, 2e4, 0.14, (1.5e4, 1.4e5)

        def rate(t: float, y: np.ndarray) -> list[float]:
            slip = [y[1] - y[0], y[2] - y[0]]
            rail = [mu * n * max(-1.0, min(1.0, s / 1e-4)) for n, s in zip(loads, slip, strict=True)]
            return [(sum(rail) - 2e3) / mass, (push - rail[0]) / rotor, (push - rail[1]) / rotor]

        run = solve_ivp(rate, (0, 4), [0.0, 0.0, 0.0], method="Radau", rtol=1e-9, atol=1e-10)
        a = skid.slipping_acceleration(np.full(2, push), np.full(2, rotor), mass, 2e3, mu, np.array(loads), np.zeros(2))
        assert run.y[0, -1] / 4 == pytest.approx(a, rel=1e-3)
        assert run.y[1, -1] > 2 * run.y[0, -1]  # one rim runs away
        assert run.y[2, -1] == pytest.approx(run.y[0, -1], rel=1e-3)  # the other rolls

    def test_grip_by_moments_about_the_axle(self) -> None:
        """Torque, bearing, rolling and inertia of a wheel; the rail takes the rest."""
        torque, radius, load, w, J, a = 4e3, 0.25, 9e4, 0.006, 12.0, 0.3
        force = float(skid.wheel_grip(torque, radius, load, w, J, a))
        assert force * radius == pytest.approx(torque - w * load * radius - J * a / radius, rel=1e-13)
        careful = float(skid.wheel_grip(torque, radius, load, 0.0, J, a))
        assert careful - force == pytest.approx(w * load)

    @pytest.mark.parametrize(("rail", "force"), [("indoor", 16e3), ("outdoor", 9.6e3), ("sanded", 20e3)])
    def test_what_a_rail_gives_as_handbooks_have_it(self, rail: str, force: float) -> None:
        """80 kN on a wheel: 0.2 dry indoors, 0.12 outdoors, 0.25 with sand; there nothing is left over."""
        assert skid.skid_reserve(skid.ADHESION[rail], 80e3, force) == pytest.approx(1.0, rel=1e-12)

    def test_a_wheel_that_lifts_off_or_needs_nothing(self) -> None:
        assert skid.skid_reserve(0.14, [-5.0, 8e4, 0.0], [1e3, 0.0, 0.0]).tolist() == [0.0, math.inf, math.inf]
