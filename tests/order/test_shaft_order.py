"""Observed orders of the discretised motions of a shaft: the textbook's tables, and collocation."""

import math

import numpy as np
import pytest
from support.shafts import C23, Reference, spec_of

from ptmcalc.machines.shaft.cycle import bounds, energy_step
from ptmcalc.machines.shaft.machine.cases import machine_for
from ptmcalc.machines.shaft.speed_changes import step_table
from ptmcalc.numerics.cycle import Grid, solve
from ptmcalc.numerics.passage import Phase, State, follow
from ptmcalc.numerics.steps import energy_steps
from ptmcalc.numerics.steps import step_table as table


def orders(errors: list[float], ratio: float = 2.0) -> np.ndarray:
    return np.log(np.array(errors[:-1]) / errors[1:]) / math.log(ratio)


class TestStepTable:
    def test_the_worked_case_with_its_printed_steps(self) -> None:
        """0.883 s with 1 ms and 0.8826 s with 0.1 ms, exact 0.882493 s: the end is put on the line of the last step."""
        machine = machine_for(spec_of(C23), "idle")
        rate = step_table.acceleration(machine, driven=True)
        target = 0.95 * 50 * math.pi / 12
        for step, printed in ((1e-3, 0.883), (2.5e-4, 0.8826)):
            found = table(rate, 0.0, 0.0, target, step, 10**5)
            assert math.ceil(found.time / 1e-4) * 1e-4 == pytest.approx(printed, abs=2.5 * step)
        assert table(rate, 0.0, 0.0, target, 2.5e-4, 10**5).time == pytest.approx(0.882493, rel=5e-4)

    def test_it_is_of_first_order(self) -> None:
        machine = machine_for(spec_of(C23), "idle")
        rate = step_table.acceleration(machine, driven=True)
        exact, angle = Reference(C23).run_up(0.0, 12.0)
        tables = [table(rate, 0.0, 0.0, 12.0, 4e-3 / 2**k, 10**5) for k in range(4)]
        assert orders([abs(one.time - exact) for one in tables])[-1] == pytest.approx(1.0, abs=0.15)
        assert orders([abs(one.angle - angle) for one in tables])[-1] == pytest.approx(1.0, abs=0.15)

    def test_a_run_out_in_the_table(self) -> None:
        machine = machine_for(spec_of(C23), "idle")
        rate = step_table.acceleration(machine, driven=False)
        exact, angle = Reference(C23).run_out(0.0, 12.3294)
        errors = []
        for k in range(3):
            found = table(rate, 0.0, 12.3294, 0.0, 4e-3 / 2**k, 10**5)
            errors.append(abs(found.angle - angle))
            assert found.time == pytest.approx(exact, rel=1e-2)
        assert orders(errors)[-1] == pytest.approx(1.0, abs=0.3)

    def test_constant_acceleration_is_exact(self) -> None:
        found = table(lambda t, phi, w: 3.0, 1.0, 0.0, 12.0, 0.01, 10**4)
        assert (found.time, found.angle) == pytest.approx((4.0, 24.0), rel=1e-12)

    def test_a_table_that_does_not_come_to_its_end_says_so(self) -> None:
        assert not table(lambda t, phi, w: -1.0, 0.0, 0.0, 12.0, 0.01, 100).reached
        assert not table(lambda t, phi, w: 1e-6, 0.0, 0.0, 12.0, 0.01, 100).reached


class TestEnergySteps:
    def test_the_case_of_a_varying_inertia_from_rest(self) -> None:
        """J = 2 + cos phi, M = 1: w(pi) = sqrt(2 pi) to the last digits, at every number of steps."""
        for count in (1, 7, 360):
            phi = np.linspace(0, math.pi, count + 1)
            speeds = energy_steps(2 + np.cos(phi), phi, 0.0)
            assert speeds[-1] == pytest.approx(2.5066282746310007, rel=1e-14)

    def test_the_cycle_is_of_second_order(self) -> None:
        spec = spec_of(C23 | {"load": {"type": "table", "points": [
            {"angle": "0 deg", "torque": "100 N*m"}, {"angle": "90 deg", "torque": "300 N*m"},
            {"angle": "250 deg", "torque": "50 N*m"},
        ]}, "losses": {"torque": "35 N*m"}})  # fmt: skip
        machine = machine_for(spec, "full")
        cycle = bounds.held(machine)
        assert cycle is not None
        found = [energy_step.steps_of(machine, cycle, 12 << k).irregularity(0.0) for k in range(8)]
        errors = [abs(one - found[-1]) for one in found[:-2]]
        assert orders([errors[0], errors[-1]], 2.0 ** (len(errors) - 1))[0] == pytest.approx(2.0, abs=0.4)


class TestCollocation:
    @pytest.mark.parametrize("order", [3, 4, 5])
    def test_over_the_angle_the_order_is_twice_the_nodes_less_one(self, order: int) -> None:
        """de/dphi = -0.4 e (1 + 0.5 cos phi) from e = 1: e(2 pi) = exp(-0.8 pi)."""
        errors = []
        for count in (2, 4, 8):
            g = Grid(np.linspace(0, 2 * math.pi, count + 1), order)
            rise = -0.4 * (1 + 0.5 * np.cos(g.angles))
            orbit = solve(g, lambda e, rise=rise: (rise * e, rise), np.full(g.angles.shape, 1.0), start=1.0)
            assert orbit is not None
            errors.append(abs(float(orbit.within([1.0])[-1, 0]) - math.exp(-0.8 * math.pi)))
        assert orders(errors)[-1] >= 2 * order - 1 - 0.6

    @pytest.mark.parametrize("order", [7, 11])
    def test_in_time_a_tolerance_is_kept(self, order: int) -> None:
        """A pendulum that goes round: its energy after two seconds."""
        phase = Phase(lambda t, a, w: -9.0 * np.sin(a), lambda t, a, w: np.array([w]), until_time=2.0)
        for tolerance in (1e-5, 1e-8, 1e-11):
            end = follow(phase, State(0.0, 0.0, 9.0), order, tolerance).end
            assert end.speed**2 / 2 - 9 * math.cos(end.angle) == pytest.approx(40.5 - 9, rel=10 * tolerance)
