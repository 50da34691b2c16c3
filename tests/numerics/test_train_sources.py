"""Torques over time, speed and position, their stages and triggers: against closed forms and an own integration."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support.trains import run

from ptmcalc.numerics.train.parts import Body, Drive, Governed, Grip, Smooth, Spring, Stage, Straight, Train
from ptmcalc.numerics.train.signals import Signal, Sine, Trigger

J = 2.0


def alone(*drives: Drive, speed: float = 0.0, position: float = 0.0, grips: tuple[Grip, ...] = ()) -> Train:
    return Train((Body("m", J, position, speed),), drives=drives, grips=grips)


class TestSignals:
    def test_straight_pieces(self) -> None:
        signal = Signal.through(((0.5, 0.0), (1.0, 4.0), (3.0, -2.0)))
        found = run(alone(Drive.of("d", 0, signal)), 4.0)
        impulse = 0.5 * 4 / 2 + 2.0 * 1.0 - 2.0 * 1.0
        assert found.last("speed") == pytest.approx(impulse / J, rel=1e-13)
        assert (found.top("drive"), found.bottom("drive")) == pytest.approx((4.0, -2.0), rel=1e-13)

    @pytest.mark.parametrize("frequency", [0.1, 1.0, 40.0])
    def test_a_sine(self, frequency: float) -> None:
        found = run(alone(Drive.of("d", 0, Signal(sines=(Sine(3.0, frequency, 0.4),)))), 5.0)
        exact = 3.0 / (J * frequency) * (math.cos(0.4) - math.cos(5 * frequency + 0.4))
        assert found.last("speed") == pytest.approx(exact, rel=1e-11)
        square = 9.0 * (2.5 - (math.sin(10 * frequency + 0.8) - math.sin(0.8)) / (4 * frequency))
        assert found.work("square") == pytest.approx(square, rel=1e-11)

    def test_a_decay_that_starts_late(self) -> None:
        """A brake that closes as 1 - exp(-(t - 1)/0.2)."""
        signal = Signal((0.0, 1.0), (0.0, 5.0), (0.0, 0.0), decay=-5.0, decay_time=0.2, decay_start=1.0)
        found = run(alone(Drive.of("d", 0, signal)), 3.0)
        exact = 5.0 * (2.0 - 0.2 * (1 - math.exp(-10.0))) / J
        assert found.last("speed") == pytest.approx(exact, rel=1e-12)

    @pytest.mark.parametrize("rising", [True, False])
    def test_a_trigger(self, rising: bool) -> None:
        """A brake that starts as the speed passes 1, either way."""
        way = 1.0 if rising else -1.0
        brake = Signal((0.0, 0.5), (0.0, 9.0), (0.0, 0.0), trigger=Trigger(0, "speed", 1.0, rising))
        train = alone(
            Drive.of("d", 0, Signal.constant(4.0 * way)), speed=1.0 - 2.0 * way, grips=(Grip("b", 0, None, brake),)
        )
        found = run(train, 10.0)
        started = [time for time, _, after in found.events("b") if after == "started"]
        assert started == pytest.approx([1.0], rel=1e-13)
        assert found.last("speed") == 0.0


class TestStraight:
    def test_a_falling_line_over_speed(self) -> None:
        """T = 6 - 2 v: v = 3 (1 - exp(-2 t/J))."""
        law = Straight("speed", (0.0, 3.0), (6.0, 0.0), extends=True)
        found = run(alone(Drive.of("d", 0, law)), 2.5)
        assert found.last("speed") == pytest.approx(3 * (1 - math.exp(-2.5)), rel=1e-13)

    def test_a_table_over_speed(self) -> None:
        knots, values = (0.0, 1.0, 2.0, 3.0), (5.0, 3.0, 8.0, 0.0)
        found = run(alone(Drive.of("d", 0, Straight("speed", knots, values))), 3.0)

        def rate(t: float, y: np.ndarray) -> np.ndarray:
            return np.interp(y, knots, values) / J

        exact = solve_ivp(rate, (0, 3.0), [0.0], rtol=1e-12, atol=1e-13, max_step=1e-3, method="DOP853").y[0, -1]
        assert found.last("speed") == pytest.approx(exact, rel=1e-8)

    def test_a_step_over_position(self) -> None:
        """A load that acts from x = 1 on: v^2 J/2 = 4 x - 3 (x - 1)."""
        law = Straight("position", (1.0, 1.0 + 1e-9), (0.0, -3.0))
        found = run(alone(Drive.of("d", 0, Signal.constant(4.0)), Drive.of("load", 0, law)), 2.0)
        x, v = found.last("position"), found.last("speed")
        assert x > 1
        assert J * v**2 / 2 == pytest.approx(4 * x - 3 * (x - 1), rel=1e-8)

    def test_a_period_of_positions(self) -> None:
        """A saw tooth over every turn, passed many times both ways."""
        law = Straight("position", (0.0, 0.5, 1.0), (0.0, 1.0, 0.0), period=1.0)
        found = run(alone(Drive.of("d", 0, law), speed=-3.0), 4.0)
        x, v = found.last("position"), found.last("speed")
        turns, inside = math.floor(x), x - math.floor(x)
        work = turns / 2 + (inside**2 if inside < 0.5 else 0.5 - (1 - inside) ** 2)
        assert J * (v**2 - 9.0) / 2 == pytest.approx(work, rel=1e-10)


class TestOthers:
    def test_a_governed_speed(self) -> None:
        """At its limit 2 until 10 (1 - v) = 2, then v -> 1 with exp(-10 t/J)."""
        found = run(alone(Drive.of("d", 0, Governed(Signal.constant(1.0), 10.0, 2.0))), 2.0)
        limited = 0.8 * J / 2.0
        assert found.times("d") == pytest.approx([limited], rel=1e-13)
        assert found.last("speed") == pytest.approx(1 - 0.2 * math.exp(-10 / J * (2.0 - limited)), rel=1e-12)

    def test_a_smooth_curve(self) -> None:
        """T = -v^2: v = v0/(1 + v0 t/J)."""
        law = Smooth("speed", lambda v: -(v**2), lambda v: -2 * v, 9.0, 0.1)
        found = run(alone(Drive.of("d", 0, law), speed=3.0), 4.0, closes=1e-8)
        assert found.last("speed") == pytest.approx(3.0 / (1 + 6.0), rel=1e-8)

    def test_stages_by_speed_and_by_time(self) -> None:
        """6 up to 1.5, then 2 until t = 1, then -1."""
        stages = (
            Stage(Signal.constant(6.0), until=1.5),
            Stage(Signal.constant(2.0), until_time=1.0),
            Stage(Signal.constant(-1.0)),
        )
        found = run(alone(Drive("d", 0, stages)), 3.0)
        assert found.times("d") == pytest.approx([0.5, 1.0], rel=1e-13)
        assert found.last("speed") == pytest.approx(1.5 + 0.5 - 1.0, rel=1e-13)

    def test_a_gate(self) -> None:
        gate = Signal((0.0, 1.0), (1.0, 0.0), (0.0, 0.0))
        found = run(alone(Drive.of("d", 0, Signal.constant(4.0), gate)), 3.0)
        assert found.last("speed") == pytest.approx(2.0, rel=1e-14)
        assert found.last("drive") == 0.0


class TestLinks:
    def test_a_rope_with_slack(self) -> None:
        """Free for 0.1, then m x'' = -k (x - 0.1): peak v sqrt(k m)."""
        train = Train(
            (Body("m", 4.0, 0.0, 2.0),), springs=(Spring("r", 0, None, 100.0, law="no_pull", side=1, rest=0.1),)
        )
        found = run(train, 1.0)
        assert found.top("link") == pytest.approx(2.0 * 20.0, rel=1e-11)
        assert found.times("r") == pytest.approx([0.05, 0.05 + math.pi / 5], rel=1e-12)
        assert found.last("speed") == pytest.approx(-2.0, rel=1e-12)

    def test_hunt_and_crossley_lose_little_by_little(self) -> None:
        """The restitution of a slow blow is 1 - c v to first order."""
        spring = Spring("c", 0, None, 1e6, law="hunt_crossley", side=1, dissipation=0.01, exponent=1.5)
        found = run(Train((Body("m", 1.0, -0.1, 1.0),), springs=(spring,)), 0.3, closes=1e-7)
        assert -found.last("speed") == pytest.approx(1 - 0.01, abs=2e-4)

    @pytest.mark.parametrize("side", [1, -1])
    def test_a_gap_both_ways_is_symmetric(self, side: int) -> None:
        train = Train((Body("m", 1.0, 0.0, side * 3.0),), springs=(Spring("g", 0, None, 900.0, 0.0, 0.2, "clamped"),))
        found = run(train, 3.0)
        period = 4 * 0.1 / 3.0 + 2 * math.pi / 30
        assert found.top("link") == pytest.approx(90.0, rel=1e-10)
        assert found.bottom("link") == pytest.approx(-90.0, rel=1e-10)
        back = run(train, period)
        assert back.last("speed") == pytest.approx(side * 3.0, rel=1e-12)
        assert back.last("position") == pytest.approx(0.0, abs=1e-12)


class TestFriction:
    @pytest.mark.parametrize("pull", [3.0, 4.99])
    def test_coulomb_decay_rests_off_the_middle(self, pull: float) -> None:
        """k = 100, F = 5: each swing loses 2 F/k; it ends where the spring no longer overcomes friction."""
        train = Train(
            (Body("m", 1.0, pull / 10),), springs=(Spring("s", 0, None, 100.0),),
            grips=(Grip("b", 0, None, Signal.constant(5.0)),),
        )  # fmt: skip
        found = run(train, 20.0)
        x, swings = pull / 10, 0
        while 100.0 * abs(x) > 5.0:
            x, swings = -math.copysign(1.0, x) * (abs(x) - 0.1), swings + 1
        assert found.last("position") == pytest.approx(x, rel=1e-11)
        assert found.last("speed") == 0.0
        assert found.times("b")[-1] == pytest.approx(swings * math.pi / 10, rel=1e-12)

    def test_stick_slip_on_a_belt(self) -> None:
        """Static 1.5: drawn to 1.5 F/k before the block breaks loose, then F + sqrt((0.5 F)^2 + k m v^2)."""
        train = Train(
            (Body("block", 1.0), Body("puller", 1.0, 0.0, 0.1)),
            springs=(Spring("s", 1, 0, 100.0),),
            grips=(Grip("b", 0, None, Signal.constant(2.0), 1.5),),
            drives=(Drive.of("keep", 1, Governed(Signal.constant(0.1), 1e6, 1e9)),),
        )
        found = run(train, 3.0)
        assert found.times("b")[0] == pytest.approx(3.0 / 100.0 / 0.1, rel=1e-4)
        assert found.top("link") == pytest.approx(2.0 + math.sqrt(2.0), rel=1e-4)

    def test_a_clutch_brings_two_masses_to_one_speed(self) -> None:
        train = Train((Body("a", 1.0, 0.0, 3.0), Body("b", 2.0)), grips=(Grip("c", 0, 1, Signal.constant(4.0)),))
        found = run(train, 5.0)
        assert found.times("c") == pytest.approx([3.0 / (4.0 + 2.0)], rel=1e-13)
        assert found.last("speed", 0) == pytest.approx(1.0, rel=1e-14)
        assert found.ledger.lost["c"] == pytest.approx(2.0 / 3.0 * 9.0 / 2, rel=1e-12)
