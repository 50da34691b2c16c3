"""A load that swings at any angle: against Newton's laws in Cartesian coordinates, closed forms and its energy."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import ellipkm1
from support.swinging import Hanging, still

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.collocation import radau
from ptmcalc.numerics.pendulum.linear import LinearCase, linear_swing
from ptmcalc.numerics.pendulum.march import March
from ptmcalc.numerics.pendulum.parts import (
    Axis,
    Buffer,
    Case,
    Follow,
    Gear,
    Jib,
    Load,
    Push,
    Rail,
    Smooth,
    Straight,
)
from ptmcalc.numerics.pendulum.pieces import Pieces, braking
from ptmcalc.numerics.pendulum.swing import Swing, swing

G = 9.81
CLOSE = 1e-9
"""Of angles [rad], of other numbers as a share."""


def ramp(speed: float, time: float) -> Pieces:
    return Pieces.through(((0.0, 0.0), (time, speed)))


def smooth(value: float, rate: float, bend: float) -> Pieces:
    """A length or a radius without jumps of its speed."""
    return Pieces((0.0,), ((value, rate, bend),))


def of(pieces: Pieces) -> "object":
    one, two = pieces.derivative(), pieces.derivative().derivative()
    return lambda t: (float(pieces.at(t)), float(one.at(t)), float(two.at(t)))


def agrees(found: Swing, hanging: Hanging, time: float, y: np.ndarray) -> None:
    along, across, sway = hanging.angles(time, y)
    for name, wanted in (("along", along), ("across", across), ("sway", sway)):
        peak = found.known(name, time)
        assert peak.value == pytest.approx(wanted, abs=CLOSE), name
        assert abs(peak.value - wanted) <= 10 * peak.bar + 1e-11
    assert float(found.at("position", time)) == pytest.approx(y[0], rel=CLOSE, abs=CLOSE)
    assert float(found.at("speed", time)) == pytest.approx(y[1], rel=CLOSE, abs=CLOSE)


class TestAgainstCartesianCoordinates:
    @pytest.mark.parametrize("seed", range(6))
    def test_hoisting_while_a_trolley_is_moved(self, seed: int) -> None:
        rng = np.random.default_rng(seed)
        length = smooth(rng.uniform(4, 9), rng.uniform(-0.6, 0.6), rng.uniform(-0.02, 0.02))
        v, t1 = rng.uniform(0.3, 3), rng.uniform(0.5, 5)
        along, across, *rates = rng.normal(0, 0.15, 4).tolist()
        load = Load(700.0, length, along, across, *rates)
        found = swing(Case(G, Rail(), Axis(900.0, Follow(ramp(v, t1))), load), 9.0)
        hanging = Hanging(G, 700.0, 900.0, of(length), imposed=lambda t: v / t1 if t < t1 else 0.0)
        y = hanging.run(hanging.start(0.0, 0.0, along, across, tuple(rates)), (t1,))
        agrees(found, hanging, t1, y)
        y = Hanging(G, 700.0, 900.0, of(length), imposed=lambda t: 0.0).run(y, (9.0,), t1)
        agrees(found, hanging, 9.0, y)
        assert found.works().residual < 1e-11

    @pytest.mark.parametrize("seed", range(6))
    def test_a_trolley_that_is_pushed(self, seed: int) -> None:
        rng = np.random.default_rng(seed)
        length = smooth(rng.uniform(4, 9), rng.uniform(-0.4, 0.4), 0.0)
        mass, trolley, force = (10 ** rng.uniform(2, 4, 3)).tolist()
        along, across, *rates = rng.normal(0, 0.15, 4).tolist()
        found = swing(
            Case(G, Rail(), Axis(trolley, Push(force), speed=0.3), Load(mass, length, along, across, *rates)), 8.0
        )
        hanging = Hanging(G, mass, trolley, of(length), force=lambda t, s, v: force)
        agrees(found, hanging, 8.0, hanging.run(hanging.start(0.0, 0.3, along, across, tuple(rates)), (8.0,)))
        assert found.works().residual < 1e-11

    @pytest.mark.parametrize("seed", range(6))
    def test_a_jib_that_is_slewed_while_hoisting_and_luffing(self, seed: int) -> None:
        rng = np.random.default_rng(seed)
        length = smooth(rng.uniform(4, 12), rng.uniform(-0.3, 0.3), rng.uniform(-0.02, 0.02))
        radius = smooth(rng.uniform(5, 30), rng.uniform(-0.3, 0.3), rng.uniform(-0.02, 0.02))
        v, t1 = rng.uniform(0.05, 0.4), rng.uniform(0.5, 5)
        found = swing(
            Case(G, Jib(radius), Axis(4e4, Follow(ramp(v, t1))), Load(2e3, length, 0.1, -0.05, 0.02, 0.1)), 9.0
        )
        hanging = Hanging(G, 2e3, 4e4, of(length), of(radius), imposed=lambda t: v / t1)
        y = hanging.run(hanging.start(0.0, 0.0, 0.1, -0.05, (0.02, 0.1)), (t1,))
        agrees(found, hanging, t1, y)
        y = replace(hanging, imposed=lambda t: 0.0).run(y, (9.0,), t1)
        agrees(found, hanging, 9.0, y)
        assert found.works().residual < 1e-11

    @pytest.mark.parametrize("seed", range(6))
    def test_a_jib_under_a_motor(self, seed: int) -> None:
        rng = np.random.default_rng(seed)
        length, radius = smooth(8.0, rng.uniform(-0.3, 0.3), 0.01), smooth(12.0, rng.uniform(-0.3, 0.3), 0.0)
        inertia, torque, top = 10 ** rng.uniform(4, 6), 10 ** rng.uniform(3, 4.5), rng.uniform(0.1, 0.4)

        def curve(v: np.ndarray) -> np.ndarray:  # a Kloss-like curve
            slip = 1 - np.asarray(v) / top
            return np.asarray(2 * torque * slip * 0.2 / (slip**2 + 0.04))

        drive = Push(Smooth(curve, torque), gate=Pieces.through(((0.0, 0.2), (2.0, 1.0))))
        gust = Pieces.through(((0.0, 0.0), (1.0, 900.0), (4.0, -400.0)))
        load = Load(3e3, length, 0.05, 0.02, wind_along=Pieces.constant(0.0))
        found = swing(Case(G, Jib(radius), Axis(inertia, drive, outer=gust, speed=0.02), load), 7.0)
        hanging = Hanging(
            G, 3e3, inertia, of(length), of(radius),
            lambda t, s, v: float(curve(v)) * min(0.2 + 0.4 * t, 1.0) + float(np.interp(t, [0, 1, 4], [0, 900, -400])),
        )  # fmt: skip
        y = hanging.run(hanging.start(0.0, 0.02, 0.05, 0.02), (1.0, 2.0, 4.0, 7.0))
        agrees(found, hanging, 7.0, y)
        assert found.works().residual < 1e-10

    def test_a_jib_stopped_by_a_brake_sticks_slips_and_sticks(self) -> None:
        """The events of the reference are found by bracketing: at rest, loose as soon as the load pulls hard enough,
        and at rest again."""
        grip, start, inertia = 6e4, 0.22, 5e4
        hanging = Hanging(G, 3e3, inertia, still(7.0), still(14.0), lambda t, s, v: -grip)

        def sliding(y: np.ndarray, begin: float, low: float, high: float) -> tuple[float, np.ndarray]:
            rest = brentq(lambda t: float(hanging.run(y, (t,), begin)[1]), low, high, xtol=1e-12)
            y = hanging.run(y, (rest,), begin)
            y[1] = 0.0
            return rest, y

        first, y1 = sliding(hanging.start(0.0, start, 0.0, 0.05), 0.0, 0.05, 0.35)

        def spare(t: float) -> float:
            return grip - hanging.pull(t, hanging.run(y1, (t,), first, held=True))

        loose = brentq(spare, first + 1e-3, 0.6, xtol=1e-12)
        y2 = hanging.run(y1, (loose,), first, held=True)
        second, y3 = sliding(y2, loose, 1.5, 2.0)
        load = Load(3e3, Pieces.constant(7.0), 0.0, 0.05)
        axis = Axis(inertia, friction=grip, speed=start)
        found = swing(Case(G, Jib(Pieces.constant(14.0)), axis, load), 3.0)
        assert [e.after for e in found.events] == ["rest", "forward", "rest"]
        assert [e.time for e in found.events] == pytest.approx([first, loose, second], abs=1e-7)
        for time, y in ((first, y1), (loose, y2), (second, y3)):
            agrees(found, hanging, time, y)
        assert np.all(found.at("speed", np.linspace(first, loose, 30)[:-1]) == 0)
        assert found.works().residual < 1e-12
        assert found.works().works["grip"] < 0

    def test_a_jib_on_a_tilted_axis_with_an_unbalance(self) -> None:
        tilt, downhill, moment, inertia = 0.04, 0.9, 2e4, 3e5
        pivot = Jib(Pieces.constant(15.0), tilt, downhill, moment)
        load = Load(3e3, Pieces.constant(8.0), -math.atan(math.tan(tilt) * math.sin(downhill)))
        found = swing(Case(G, pivot, Axis(inertia, speed=0.1), load), 9.0)

        def force(t: float, s: float, v: float) -> float:
            return moment * G * math.sin(tilt) * math.sin(downhill - s)

        hanging = Hanging(G, 3e3, inertia, still(8.0), still(15.0), force, tilt=tilt, downhill=downhill)
        across = math.atan(math.tan(tilt) * math.cos(downhill))
        y = hanging.run(hanging.start(0.0, 0.1, 0.0, across), (9.0,))  # square to the axis along, plumb across
        assert float(found.at("position", 9.0)) == pytest.approx(y[0], rel=CLOSE)
        assert float(found.at("speed", 9.0)) == pytest.approx(y[1], rel=CLOSE)
        assert found.works().residual < 1e-12

    def test_a_sudden_change_of_the_hoisting_speed_is_the_limit_of_a_quick_one(self) -> None:
        """Momentum, angles and energy behind the jerk; also of an axis that is free to give way."""

        def hauled(time: float) -> Pieces:
            quick = Pieces.through(((1.0, 0.0), (1.0 + time, -0.7)))
            return quick.integral(9.0) if time else Pieces.through(((1.0, 9.0), (9.0, 3.4)))

        for pivot, axis in (
            (Rail(), Axis(700.0, Push(300.0))),
            (Jib(Pieces.constant(6.0)), Axis(700.0 * 36, speed=0.05)),
            (Rail(), Axis(700.0, Follow(ramp(1.0, 2.5)))),
        ):
            at = []
            for time in (0.0, 1e-5):
                found = swing(Case(G, pivot, axis, Load(2e3, hauled(time), 0.2, 0.1, 0.1, 0.0)), 7.0)
                assert found.works().residual < 1e-11
                at.append([float(found.at(name, 7.0)) for name in ("along", "across", "speed", "along_rate")])
            assert at[0] == pytest.approx(at[1], abs=2e-5)

    def test_a_sudden_change_of_the_radius_is_the_limit_of_a_quick_one(self) -> None:
        at = []
        for time in (0.0, 1e-5):
            quick = Pieces.through(((1.0, 0.0), (1.0 + time, 0.6), (4.0, 0.6), (4.0 + time, 0.0))).integral(9.0)
            way = quick if time else Pieces.through(((1.0, 9.0), (4.0, 10.8)))
            found = swing(Case(G, Jib(way), Axis(3e4, speed=0.1), Load(2e3, Pieces.constant(7.0), 0.1)), 7.0)
            assert found.works().residual < 1e-11
            at.append([float(found.at(name, 7.0)) for name in ("along", "across", "speed", "across_rate")])
        assert at[0] == pytest.approx(at[1], abs=2e-5)


class TestClosedForms:
    @pytest.mark.parametrize("angle", [1e-6, 0.1, 1.0, 1.5])
    @pytest.mark.parametrize("length", [1e-3, 7.0, 1e3])
    def test_period_of_a_free_swing(self, angle: float, length: float) -> None:
        period = 4 * math.sqrt(length / G) * ellipkm1(math.cos(angle / 2) ** 2)
        found = swing(
            Case(G, Rail(), Axis(1.0, Follow(Pieces())), Load(50.0, Pieces.constant(length), angle)), 3 * period
        )
        for k in (1, 2, 3):
            back = found.known("along", k * period)
            assert back.value == pytest.approx(angle, rel=1e-8)
        assert found.smallest("along").value == pytest.approx(-angle, rel=1e-10)
        assert found.smallest("along", period).time % period == pytest.approx(period / 2, rel=1e-4)
        assert found.largest("amplitude").value == pytest.approx(angle, rel=1e-8)
        assert found.largest("tension").value == pytest.approx(50 * G * (3 - 2 * math.cos(angle)), rel=1e-9)

    @pytest.mark.parametrize("a", [0.05, 2.0, 9.0])
    def test_sudden_acceleration_and_force(self, a: float) -> None:
        rope = Load(500.0, Pieces.constant(5.0))
        moved = swing(Case(G, Rail(), Axis(900.0, Follow(Pieces((0.0,), ((0.0, a),)))), rope), 6.0)
        pushed = swing(Case(G, Rail(), Axis(900.0, Push(1400.0 * a)), rope), 6.0)
        for found in (moved, pushed):
            lean = found.smallest("along")
            assert lean.value == pytest.approx(-2 * math.atan(a / G), abs=1e-10)
        assert moved.smallest("tension").value == pytest.approx(500 * G, rel=1e-9)

    def test_small_angles_are_the_linear_pendulum(self) -> None:
        tiny = 1e-4
        push = Pieces.steps(((0.0, tiny), (3.0, 0.0)))
        length = Pieces.through(((1.0, 9.0), (8.0, 3.0)))
        linear = linear_swing(LinearCase(G, length, push), 14.0)
        found = swing(Case(G, Rail(), Axis(1.0, Follow(push.integral())), Load(1.0, length)), 14.0)
        t = np.linspace(0, 14, 50)
        assert found.at("along", t) == pytest.approx(linear.at("angle", t), abs=1e-12)
        pushed = linear_swing(LinearCase(G, Pieces.constant(5.0), push, mass_ratio=2.0), 14.0)
        found = swing(Case(G, Rail(), Axis(1.0, Push(1.0, gate=push)), Load(2.0, Pieces.constant(5.0))), 14.0)
        assert found.at("along", t) == pytest.approx(pushed.at("angle", t), abs=1e-12)
        assert found.at("speed", t) == pytest.approx(pushed.at("speed", t), abs=1e-11)

    def test_steady_slewing(self) -> None:
        w, radius, length = 0.4, 12.0, 8.0
        lean = brentq(lambda x: G * math.tan(x) - w * w * (radius + length * math.sin(x)), 0, 1, xtol=1e-15)
        load = Load(500.0, Pieces.constant(length), across=lean)
        found = swing(Case(G, Jib(Pieces.constant(radius)), Axis(1e4, speed=w), load), 40.0)
        assert found.largest("across").value == pytest.approx(lean, abs=1e-10)
        assert found.smallest("across").value == pytest.approx(lean, abs=1e-10)
        assert found.farthest("along").value == pytest.approx(0, abs=1e-10)

    def test_a_slope_turns_the_plumb_line(self) -> None:
        load = Load(500.0, Pieces.constant(6.0))
        found = swing(Case(G, Rail(0.05), Axis(900.0, friction=1e4), load), 9.0)
        assert found.farthest("sway").value == pytest.approx(0, abs=1e-12)
        assert found.events == ()
        rolling = swing(Case(G, Rail(0.05), Axis(900.0), load), 9.0)
        assert rolling.largest("along").value == pytest.approx(2 * 0.05, rel=1e-9)  # a = g sin, tilted as the rail
        assert rolling.works().residual < 1e-13

    def test_the_amplitude_is_what_a_free_swing_comes_to(self) -> None:
        load = Load(500.0, Pieces.constant(7.0), 0.2, -0.1, 0.1, 0.3)
        found = swing(Case(G, Rail(), Axis(1.0, Follow(Pieces())), load), 60.0)
        said = found.at("amplitude", np.linspace(0, 60, 40))
        assert said == pytest.approx(said[0], rel=1e-8)
        assert found.largest("sway").value == pytest.approx(said[0], rel=1e-8)

    def test_a_gust_on_the_load(self) -> None:
        load = Load(500.0, Pieces.constant(6.0), wind_along=Pieces.constant(400.0))
        found = swing(Case(G, Rail(), Axis(1.0, Follow(Pieces())), load), 9.0)
        assert found.largest("along").value == pytest.approx(2 * math.atan(400 / 500 / G), rel=1e-10)
        assert found.works().residual < 1e-12

    def test_a_field_over_position_and_speed(self) -> None:
        """A spring and a damper of a trolley without a load worth naming."""
        axis = Axis(100.0, field=lambda t, s, v: -400.0 * s - 40.0 * v, position=0.5)
        found = swing(Case(G, Rail(), axis, Load(1e-9, Pieces.constant(6.0))), 5.0)
        turn = math.sqrt(4 - 0.04)
        t = np.linspace(0, 5, 20)
        wanted = 0.5 * np.exp(-0.2 * t) * (np.cos(turn * t) + 0.2 / turn * np.sin(turn * t))
        assert found.at("position", t) == pytest.approx(wanted, abs=1e-9)

    def test_when_a_signal_goes_through_a_level(self) -> None:
        found = swing(Case(G, Rail(), Axis(9.0, Follow(ramp(1.2, 4.0))), Load(5.0, Pieces.constant(6.0))), 9.0)
        half = found.crossing("speed", 0.6)
        assert half is not None
        assert half.time == pytest.approx(2.0, abs=1e-11)
        place = found.crossing("position", 2.4 + 1.2 * 3.0)
        assert place is not None
        assert place.time == pytest.approx(7.0, abs=1e-11)
        assert place.bar < 1e-9
        assert found.crossing("speed", 1.3) is None
        assert found.crossing("speed", 0.6, rising=False) is None

    def test_momentum_about_the_axis_stays(self) -> None:
        """A jib left alone: angular momentum of jib and load."""
        load = Load(4e3, smooth(9.0, -0.2, 0.0), 0.2, 0.1, 0.1)
        found = swing(Case(G, Jib(smooth(15.0, 0.2, 0.0)), Axis(2e5, speed=0.1), load), 12.0)
        t = np.linspace(0, 12, 25)
        at = {name: found.at(name, t) for name in ("speed", "along", "across", "along_rate", "across_rate")}
        length, radius = 9 - 0.2 * t, 15 + 0.2 * t
        tangent = np.stack([np.tan(at["along"]), np.tan(at["across"]), -np.ones_like(t)])
        size = np.linalg.norm(tangent, axis=0)
        n = tangent / size
        turned = np.stack(
            [at["along_rate"] / np.cos(at["along"]) ** 2, at["across_rate"] / np.cos(at["across"]) ** 2, 0 * t]
        )
        rate = (turned - n * (n * turned).sum(axis=0)) / size
        place_t, place_r = length * n[0], radius + length * n[1]
        speed_t = -0.2 * n[0] + length * rate[0] + at["speed"] * place_r
        speed_r = 0.2 - 0.2 * n[1] + length * rate[1] - at["speed"] * place_t
        momentum = 2e5 * at["speed"] + 4e3 * (place_r * speed_t - place_t * speed_r)
        assert momentum == pytest.approx(momentum[0], rel=1e-10)


class TestDrives:
    def test_a_drive_that_reaches_its_speed_keeps_it(self) -> None:
        axis = Axis(1000.0, Push(3000.0, reaches=2.0, limit=1e5), friction=200.0)
        found = swing(Case(G, Rail(), axis, Load(900.0, Pieces.constant(7.0))), 20.0)
        reached = [e.time for e in found.events if e.after == "speed reached"]
        assert len(reached) == 1
        assert found.at("speed", np.linspace(reached[0], 20, 50)) == pytest.approx(2.0, abs=1e-11)
        pull = found.at("pull_along", 15.0)
        assert float(found.at("drive", 15.0)) == pytest.approx(200 - float(pull), rel=1e-9)
        assert found.works().residual < 1e-12

    def test_a_drive_with_a_limit_gives_way_and_comes_back(self) -> None:
        """Against a law of force written out: it never exceeds the limit, and the reference is met again."""
        reference = Pieces.through(((0.0, 0.0), (3.0, 1.5), (8.0, 1.5), (10.0, 0.0)))
        axis = Axis(2000.0, Follow(reference, limit=2500.0), friction=100.0)
        found = swing(Case(G, Rail(), axis, Load(1500.0, Pieces.constant(5.0))), 22.0)
        assert {e.after for e in found.events} >= {"high", "low", "keep"}
        assert abs(found.farthest("motor").value) == pytest.approx(2500, rel=1e-9)
        assert found.at("speed", 21.0) == 0.0
        assert found.works().residual < 1e-12
        free = replace(axis, drive=Follow(reference))
        assert (
            abs(swing(Case(G, Rail(), free, Load(1500.0, Pieces.constant(5.0))), 22.0).farthest("motor").value) > 2500
        )

    def test_a_limit_behind_a_gear_whose_power_turns_round(self) -> None:
        """The force in front of a lossy gear has a corner where the power turns; the limit is kept on either side."""
        gear = Gear(1300.0, 0.52, 0.45)
        axis = Axis(4300.0, Follow(ramp(0.3, 9.5), limit=127.0, until=5.5), friction=4.2, gear=gear)
        found = swing(Case(G, Rail(), axis, Load(820.0, Pieces.constant(4.7), 0.043, 0.31, 0.0, -0.22)), 9.0)
        assert any(e.after == "high" for e in found.events)
        assert abs(found.farthest("motor").value) == pytest.approx(127.0, rel=1e-8)
        t = np.linspace(0, 9, 2000)
        drive, motor, grip = (found.at(name, t) for name in ("drive", "motor", "grip"))
        moving = found.at("speed", t) > 1e-6
        into = motor - 1300 * found.at("acceleration", t)
        wanted = np.where(into > 0, 0.52 * into, into / 0.45)
        assert drive[moving] == pytest.approx(wanted[moving], abs=1e-6)
        assert grip[moving] == pytest.approx(-4.2)

    def test_a_start_below_friction_stays_at_rest(self) -> None:
        axis = Axis(1e5, Push(900.0), friction=1000.0)
        found = swing(Case(G, Jib(Pieces.constant(10.0)), axis, Load(500.0, Pieces.constant(6.0))), 30.0)
        assert found.events == ()
        assert found.farthest("position").value == 0.0
        assert float(found.at("grip", 3.0)) == pytest.approx(-900)

    def test_straight_pieces_and_the_same_curve_as_a_smooth_one(self) -> None:
        knots, values = (0.0, 0.1, 0.2), (3e4, 2e4, 0.0)
        load = Load(800.0, Pieces.constant(6.0))

        def started(law: Straight | Smooth, tolerance: float) -> Swing:
            axis = Axis(3e5, Push(law), friction=1e3)
            return swing(Case(G, Jib(Pieces.constant(9.0)), axis, load), 9.0, tolerance=tolerance)

        straight = started(Straight(knots, values), 1e-11)
        assert straight.largest("speed").value > 0.1
        jagged = started(Smooth(lambda v: np.interp(v, knots, values), 3e4), 1e-9)
        assert float(straight.at("along", 9.0)) == pytest.approx(float(jagged.at("along", 9.0)), abs=1e-7)
        assert straight.works().residual < 1e-12

    @pytest.mark.parametrize("reverse", [1.0, 0.5])
    def test_a_gear_loses_what_the_power_says(self, reverse: float) -> None:
        """Without a load worth naming. Driven I a = eta (F - I_r a) - W; running out the rotor still drives; a brake in
        front of the gear is driven through it: I a = -(B + I_r a)/reverse - W."""
        gear = Gear(300.0, 0.8, reverse, Pieces.steps(((3.0, 400.0),)))
        axis = Axis(1000.0, Push(500.0, until=2.0), friction=100.0, gear=gear)
        found = swing(Case(G, Rail(), axis, Load(1e-6, Pieces.constant(5.0))), 3.2)
        up, down = (0.8 * 500 - 100) / (1000 + 0.8 * 300), 100 / (1000 + 0.8 * 300)
        braked = (400 / reverse + 100) / (1000 + 300 / reverse)
        assert float(found.at("speed", 2.0)) == pytest.approx(2 * up, rel=1e-8)
        assert float(found.at("speed", 3.0)) == pytest.approx(2 * up - down, rel=1e-8)
        assert float(found.at("speed", 3.2)) == pytest.approx(2 * up - down - 0.2 * braked, rel=1e-8)
        assert found.works().residual < 1e-12
        assert found.works().works["gear"] < 0

    def test_a_brake_in_front_of_the_gear_holds_more_behind_it(self) -> None:
        for force, moves in ((119.0, False), (121.0, True)):
            axis = Axis(1000.0, outer=Pieces.constant(force), gear=Gear(0.0, 0.9, 0.5, braking(60.0)))
            found = swing(Case(G, Rail(), axis, Load(1e-6, Pieces.constant(5.0))), 3.0)
            assert (float(found.at("position", 3.0)) > 0) == moves

    def test_brake_with_delay_and_rise(self) -> None:
        axis = Axis(1000.0, brake=braking(500.0, 1.0, 0.4, 0.6), speed=1.0)
        found = swing(Case(G, Rail(), axis, Load(1e-6, Pieces.constant(5.0))), 9.0)
        # 1 - (0.5/0.6) t^2/2 for 0.6 s, then 0.5 m/s^2
        rest = 1.4 + 0.6 + (1 - 0.5 * 0.3) / 0.5
        (event,) = [e for e in found.events if e.element == "axis"]
        assert event.time == pytest.approx(rest, abs=1e-6)
        assert found.at("speed", 8.0) == 0.0


class TestBuffers:
    def hit(self, buffer: Buffer, push: float = 0.0, end: float = 4.0, load: float = 1e-6) -> Swing:
        drive = Push(push) if push else None
        axis = Axis(2000.0, drive, buffers=(buffer,), speed=1.5)
        return swing(Case(G, Rail(), axis, Load(load, Pieces.constant(5.0))), end)

    def test_linear(self) -> None:
        found = self.hit(Buffer(1.0, "linear", 8e4))
        assert -found.smallest("buffer").value == pytest.approx(1.5 * math.sqrt(8e4 * 2000), rel=1e-8)
        assert found.largest("position").value - 1 == pytest.approx(1.5 * math.sqrt(2000 / 8e4), rel=1e-8)
        assert found.at("speed", 4.0) == pytest.approx(-1.5, rel=1e-8)

    def test_linear_with_the_drive_on(self) -> None:
        found, speed = self.hit(Buffer(0.0, "linear", 8e4), 3000.0, 0.5), 1.5
        wanted = 3000 + math.hypot(3000, speed * math.sqrt(8e4 * 2000))
        assert -found.smallest("buffer").value == pytest.approx(wanted, rel=1e-8)

    def test_constant(self) -> None:
        found = self.hit(Buffer(1.0, "constant", 9e3))
        assert found.largest("position").value - 1 == pytest.approx(2000 * 1.5**2 / 2 / 9e3, rel=1e-8)
        assert float(found.at("speed", 4.0)) == pytest.approx(0.0, abs=1e-8)  # its load draws it back
        pushed = self.hit(Buffer(1.0, "constant", 9e3), 4000.0)
        met = next(e.time for e in pushed.events if e.after == "met")
        speed = float(pushed.at("speed", met))
        assert pushed.largest("position").value - 1 == pytest.approx(2000 * speed**2 / 2 / 5e3, rel=1e-7)
        assert pushed.at("speed", 4.0) == 0.0

    def test_orifice(self) -> None:
        found = self.hit(Buffer(1.0, "orifice", 6e3), end=3.0)
        since = 3.0 - 1 / 1.5
        assert float(found.at("speed", 3.0)) == pytest.approx(1.5 / (1 + 6e3 * 1.5 * since / 2000), rel=1e-8)
        assert -found.smallest("buffer").value == pytest.approx(6e3 * 1.5**2, rel=1e-8)

    def test_a_buffer_that_becomes_solid_ends_it_with_the_speed_that_is_left(self) -> None:
        found = self.hit(Buffer(1.0, "constant", 9e3, stroke=0.1))
        assert found.solid
        left = math.sqrt(1.5**2 - 2 * 9e3 * 0.1 / 2000)
        assert float(found.at("speed", found.end)) == pytest.approx(left, rel=1e-9)
        assert found.events[-1].after == "solid"
        assert not self.hit(Buffer(1.0, "constant", 9e3, stroke=0.3)).solid

    def test_a_swinging_load_presses_later(self) -> None:
        found = self.hit(Buffer(1.0, "linear", 8e4), load=3000.0)
        alone = 1.5 * math.sqrt(8e4 * 2000)
        stuck = 1.5 * math.sqrt(8e4 * 5000)
        assert alone < -found.smallest("buffer").value < 0.8 * stuck
        assert found.works().residual < 1e-12


class TestHard:
    def test_a_swing_near_a_right_angle(self) -> None:
        load = Load(100.0, Pieces.constant(3.0), along=0.5 * math.pi - 1e-3)
        found = swing(Case(G, Rail(), Axis(1.0, Follow(Pieces())), load), 8.0)
        assert found.smallest("tension").value == pytest.approx(100 * G * math.sin(1e-3), rel=1e-7)
        assert found.works().residual < 1e-12

    def test_a_slack_rope_is_told(self) -> None:
        load = Load(100.0, Pieces.constant(3.0), along=0.5 * math.pi + 1e-3)
        with pytest.raises(NumericsError, match="slack") as caught:
            swing(Case(G, Rail(), Axis(1.0, Follow(Pieces())), load), 8.0)
        assert caught.value.code == "NUM102"

    def test_a_drive_that_stops_exactly_at_rest(self) -> None:
        """It brakes down to 0 and is switched off there, with and without friction."""
        for friction in (0.0, 50.0):
            down = Pieces.through(((0.0, 1.0), (2.0, 0.0)))
            axis = Axis(1e9, Follow(down, until=2.0), friction=friction, speed=1.0)
            found = swing(Case(G, Rail(), axis, Load(1e-3, Pieces.constant(4.0))), 9.0)
            assert float(found.at("speed", 8.0)) == pytest.approx(0.0, abs=1e-9)
            assert float(found.at("position", 8.0)) == pytest.approx(1.0, abs=1e-8)

    @pytest.mark.parametrize("time", [1e-3, 3600.0])
    def test_very_short_and_very_long_ramps(self, time: float) -> None:
        omega, v = math.sqrt(G / 7), 0.3
        found = swing(Case(G, Rail(), Axis(1.0, Follow(ramp(v, time))), Load(1.0, Pieces.constant(7.0))), time + 7.0)
        linear = 2 * v / time / G * abs(math.sin(omega * time / 2))
        left = found.largest("sway", time)
        assert left.value == pytest.approx(linear, rel=1e-3 if time < 1 else 1e-6)
        assert left.bar < 1e-9

    def test_ramps_in_step_with_the_swing(self) -> None:
        """Thirty jolts forth and back; the swing falls out of step as it grows, as the reference says too."""
        half, a = math.pi * math.sqrt(5 / G), 0.15
        points = [(k * half, a * (-1) ** k) for k in range(30)]
        speed = Pieces.steps((*points, (30 * half, 0.0))).integral()
        found = swing(Case(G, Rail(), Axis(1.0, Follow(speed)), Load(1.0, Pieces.constant(5.0))), 30 * half)
        y = None
        for k in range(30):
            hanging = Hanging(G, 1.0, 1.0, still(5.0), imposed=lambda t, k=k: a * (-1) ** k)
            y = hanging.start(0.0, 0.0, 0.0, 0.0) if y is None else y
            y = hanging.run(y, ((k + 1) * half,), k * half)
        assert float(found.at("along", 30 * half)) == pytest.approx(hanging.angles(0.0, y)[0], abs=1e-9)

    @pytest.mark.parametrize(
        "case",
        [
            Case(0.0, Rail(), Axis(1.0), Load(1.0, Pieces.constant(1.0))),
            Case(math.nan, Rail(), Axis(1.0), Load(1.0, Pieces.constant(1.0))),
            Case(G, Rail(), Axis(0.0), Load(1.0, Pieces.constant(1.0))),
            Case(G, Rail(), Axis(math.nan), Load(1.0, Pieces.constant(1.0))),
            Case(G, Rail(), Axis(1.0), Load(0.0, Pieces.constant(1.0))),
            Case(G, Rail(), Axis(1.0), Load(1.0, Pieces.through(((0.0, 1.0), (2.0, -1.0))))),
            Case(G, Rail(), Axis(1.0, friction=-1.0), Load(1.0, Pieces.constant(1.0))),
            Case(G, Rail(), Axis(1.0, gear=Gear(reverse=0.0)), Load(1.0, Pieces.constant(1.0))),
            Case(G, Rail(), Axis(1.0, Follow(Pieces.constant(2.0))), Load(1.0, Pieces.constant(1.0))),
            Case(G, Rail(), Axis(1.0, buffers=(Buffer(1.0, "rubber", 9.0),)), Load(1.0, Pieces.constant(1.0))),
            Case(G, Jib(Pieces.steps(((0.0, 5.0), (1.0, 6.0)))), Axis(1.0), Load(1.0, Pieces.constant(1.0))),
            Case(G, Jib(Pieces.constant(5.0)), Axis(1.0), Load(1.0, Pieces.constant(1.0), across=1.6)),
        ],
    )
    def test_what_does_not_swing_is_refused(self, case: Case) -> None:
        with pytest.raises(NumericsError):
            swing(case, 3.0)

    def test_a_motion_without_end_is_given_up(self) -> None:
        with pytest.raises(NumericsError, match="steps") as caught:
            swing(Case(G, Rail(), Axis(1.0), Load(1.0, Pieces.constant(1.0), 0.1)), 1e6, most_steps=200)
        assert caught.value.code == "NUM103"


class TestBars:
    def test_a_coarser_run_knows_how_coarse_it_is_and_a_finer_one_is_better(self) -> None:
        case = Case(G, Jib(Pieces.constant(14.0)), Axis(5e4, speed=0.2), Load(3e3, Pieces.constant(7.0), 0.3, 0.2))
        hanging = Hanging(G, 3e3, 5e4, still(7.0), still(14.0))
        wanted = hanging.angles(12.0, hanging.run(hanging.start(0.0, 0.2, 0.3, 0.2), (12.0,)))[0]
        errors, steps = [], []
        for tolerance in (1e-3, 1e-5, 1e-7, 1e-11):
            found = swing(case, 12.0, tolerance=tolerance)
            peak = found.known("along", 12.0)
            errors.append(abs(peak.value - wanted))
            steps.append(found.steps)
            assert errors[-1] <= peak.bar + 5e-12  # the reference's own error
        order = math.log(errors[0] / errors[1]) / math.log(steps[1] / steps[0])
        assert order > 10
        assert errors[-1] < 5e-12

    def test_peaks_are_those_of_many_samples(self) -> None:
        axis = Axis(6e4, Push(2e4, until=6.0), friction=900.0, brake=braking(1.5e4, 6.0, 0.3, 0.5))
        case = Case(G, Jib(Pieces.constant(12.0)), axis, Load(2500.0, Pieces.through(((2.0, 7.0), (9.0, 4.0)))))
        found = swing(case, 15.0)
        assert found.settled
        t = np.linspace(0, 15, 30_001)
        for name in ("along", "across", "sway", "tension", "pull_along", "speed", "along_rate"):
            seen, top, bottom = found.at(name, t), found.largest(name), found.smallest(name)
            size = np.abs(seen).max()
            assert top.value >= seen.max() - 1e-9 * size
            assert top.value <= seen.max() + 1e-3 * size
            assert bottom.value <= seen.min() + 1e-9 * size
        times, values = found.history(("along", "tension"))
        assert np.all(np.diff(times) >= 0)
        assert values.shape == (2, len(times))


def test_a_ramp_that_ends_at_rest_does_not_jump_by_its_rounding() -> None:
    """(v - a t) at t = v/a is 0 but for the rounding of v; a real step, be it a millionth of v, is a jump."""
    rng = np.random.default_rng(2011)
    for speed, ramp in zip(rng.uniform(0.1, 5.0, 200).tolist(), rng.uniform(0.02, 3.0, 200).tolist(), strict=True):
        assert not Pieces.through(((0.0, speed), (speed / ramp, 0.0))).jumps
        assert not Pieces.through(((0.0, 0.0), (speed / ramp, speed))).jumps
        assert Pieces((0.0, speed / ramp), ((speed, -ramp), (1e-6 * speed,))).jumps


@pytest.mark.parametrize("work", [-3e-12, -1e-3, 5.0, 5e4])
def test_what_the_energy_balance_leaves_over_is_a_share_of_what_was_turned_over(work: float) -> None:
    """A free swing with a work put into its ledger that nobody did: all of it, beside the largest of kinetic energy
    and works, less 64 roundings of the energies at both ends."""
    found = swing(Case(G, Rail(), Axis(900.0, speed=0.7), Load(300.0, Pieces.constant(5.0), 0.1)), 2.0)
    clean = found.works()
    assert clean.residual == 0
    assert abs(clean.stored) < 1e-8
    energies = []
    for time in (0.0, 2.0):
        v, angle, rate = (float(found.at(name, time)) for name in ("speed", "along", "along_rate"))
        ahead, up = v + 5.0 * rate * math.cos(angle), 5.0 * rate * math.sin(angle)
        energies += [900 * v**2 / 2 + 300 * (ahead**2 + up**2) / 2, 300 * G * 5 * math.cos(angle)]
    moving, unseen = max(energies[::2]), 64 * 2**-52 * sum(energies)
    for name in ("outer", "motor"):
        found._fine.jerks[name] = work
        told = found.works()
        found._fine.jerks[name] = 0.0
        assert told.works[name] == work
        left = max(abs(work) - unseen, 0.0)
        assert told.residual == pytest.approx(left / max(moving, abs(work)), rel=1e-3, abs=2e-14)
    found._fine.jerks["motor"], found._fine.jerks["outer"] = 2 * work, -3 * work
    expected = max(abs(work) - unseen, 0.0) / max(moving, 3 * abs(work))
    assert found.works().residual == pytest.approx(expected, rel=1e-3, abs=2e-14)


def test_rounding_of_the_energies_at_both_ends_is_not_left_over() -> None:
    """A load on 500 m of rope that hardly moves: its height is 1e10 times its motion."""
    found = swing(Case(G, Rail(), Axis(900.0, speed=1e-4), Load(300.0, Pieces.constant(500.0))), 2.0)
    height = 2 * 300 * G * 500
    for share in (0.5, 40.0):
        work = share * 64 * 2**-52 * height
        found._fine.jerks["outer"] = work
        scale = 1200 * 1e-8 / 2
        left = (share - 1) * 64 * 2**-52 * height if share > 1 else 0.0
        assert found.works().residual == pytest.approx(left / scale, rel=0.1)


@pytest.mark.parametrize("size", [1e-6, 1.0, 1e6])
@pytest.mark.parametrize("way", [1, -1])
@pytest.mark.parametrize(("excess", "moves"), [(-1e-9, False), (3e-12, False), (1e-9, True)])
def test_from_rest_it_moves_for_what_exceeds_friction_by_more_than_rounding(
    size: float, way: int, excess: float, moves: bool
) -> None:
    axis = Axis(900.0 * size, Push(way * 100.0 * size * (1 + excess)), friction=100.0 * size)
    found = swing(Case(G, Rail(), axis, Load(300.0 * size, Pieces.constant(5.0))), 1.0)
    assert found.farthest("speed").value * way == pytest.approx(100 * excess / 1200 if moves else 0.0, rel=0.4)
    assert [e.after for e in found.events] == []


@pytest.mark.parametrize("size", [1e-6, 1.0, 1e6])
def test_what_nothing_gives_a_speed_is_measured_by_what_its_forces_give_it_in_a_swing(size: float) -> None:
    """F/(m w), w^2 = g/L; where that is small, by the swing of its load."""
    axis = Axis(700.0 * size, Push(1e5 * size), friction=100.0 * size, gear=Gear(200.0 * size))
    case = Case(G, Rail(), axis, Load(300.0 * size, Pieces.constant(5.0)))
    w = math.sqrt(G / 5.0)
    scales = March(case, 1.0, 1e-11, radau(12), 10)._scales()
    assert scales == pytest.approx([1e5 / (900 * w) / w, 1e5 / (900 * w), 1, 1, 1, w, w, w])
