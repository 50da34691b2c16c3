"""Small systems with guards against closed forms: roots of every kind, breaks, faded components, curves."""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support.modes import Modes, Part, turning, with_one

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.motion import Curve, Look
from ptmcalc.numerics.piecewise import march

NOTHING = np.zeros((2, 2))


def oscillator(frequency: float, *guards: tuple[np.ndarray, str], others: dict[str, Part] | None = None) -> Modes:
    """x'' = -w^2 x beside a constant 1: state (x, v, 1)."""
    rate = with_one(turning(frequency), np.zeros(2))
    parts = {"swing": Part(rate, guards), **(others or {})}
    return Modes(parts, np.eye(3)[:2], 2, products=((1, 1),), ends="stopped", sizes=(1.0, frequency, 1.0))


STOPPED = {"stopped": Part(np.zeros((3, 3)))}


class TestLinear:
    @pytest.mark.parametrize("frequency", [1e-6, 1.0, 37.0, 1e9])
    def test_an_oscillator_keeps_its_phase(self, frequency: float) -> None:
        """A hundred radians, on any scale of time."""
        found = march(oscillator(frequency), "swing", np.array([1.0, 0.0, 1.0]), 100.0 / frequency)
        assert found.last == pytest.approx([math.cos(100), -frequency * math.sin(100)], rel=3e-12)
        assert found.top.values == pytest.approx([1.0, frequency], rel=1e-11)
        assert found.bottom.values == pytest.approx([-1.0, -frequency], rel=1e-11)

    def test_integral_of_a_product(self) -> None:
        """int v^2 dt of v = -sin t is t/2 - sin(2t)/4."""
        found = march(oscillator(1.0), "swing", np.array([1.0, 0.0, 1.0]), 7.3)
        assert found.integrals == pytest.approx([7.3 / 2 - math.sin(14.6) / 4], rel=1e-13)

    def test_free_flight_of_a_defective_matrix(self) -> None:
        rate = with_one(np.array([[0.0, 1.0], [0.0, 0.0]]), np.array([0.0, -9.81]))
        system = Modes({"flight": Part(rate)}, np.eye(3)[:2], 2)
        found = march(system, "flight", np.array([0.0, 0.25, 1.0]), 1e-4)
        assert found.last == pytest.approx([2.4950950000000002e-05, 0.25 - 9.81e-4], rel=1e-15)
        assert found.steps <= 2

    def test_nothing_moves(self) -> None:
        system = Modes({"still": Part(np.zeros((2, 2)))}, np.eye(2), 2)
        found = march(system, "still", np.array([3.0, -4.0]), 1e9)
        assert found.last.tolist() == found.top.values.tolist() == found.bottom.values.tolist() == [3.0, -4.0]

    def test_no_time(self) -> None:
        found = march(oscillator(1.0), "swing", np.array([1.0, 0.5, 1.0]), 0.0)
        assert found.state.tolist() == [1.0, 0.5, 1.0]
        assert found.steps == 0

    def test_samples_lie_on_the_motion(self) -> None:
        found = march(oscillator(2.0), "swing", np.array([1.0, 0.0, 1.0]), 20.0, keep=True)
        times, values = np.concatenate(found.samples.times), np.concatenate(found.samples.values)
        assert (times[0], times[-1]) == (0.0, pytest.approx(20.0))
        assert (np.diff(times) >= -1e-14).all()
        assert values[:, 0] == pytest.approx(np.cos(2 * times), abs=1e-12)

    def test_two_runs_of_unlike_panels_agree(self) -> None:
        first, other = (
            march(oscillator(3.0), "swing", np.array([1.0, 0.0, 1.0]), 50.0, refined=refined) for refined in (1.0, 0.6)
        )
        assert first.steps < other.steps
        assert first.last == pytest.approx(other.last, rel=1e-12)


class TestRoots:
    @pytest.mark.parametrize("level", [0.999999, 0.9, 0.5, 1e-3, 0.0, -0.5, -0.999])
    @pytest.mark.parametrize("frequency", [1e-3, 1.0, 1e6])
    def test_a_level_that_is_crossed(self, level: float, frequency: float) -> None:
        """cos wt falls through a level at arccos(level)/w."""
        system = oscillator(frequency, (np.array([1.0, 0.0, -level]), "stopped"), others=STOPPED)
        found = march(system, "swing", np.array([1.0, 0.0, 1.0]), 10.0 / frequency)
        assert found.finished
        assert found.time * frequency == pytest.approx(math.acos(level), rel=1e-14, abs=1e-15 / math.sqrt(1 - level**2))
        assert found.state[0] == pytest.approx(level, abs=1e-16)

    @pytest.mark.parametrize("beside", [1e-2, 1e-4, 1e-6, 1e-8, 1e-10])
    @pytest.mark.parametrize("phase", [0.0, 0.3, 0.77])
    def test_a_double_root_just_reached(self, beside: float, phase: float) -> None:
        """1 - beside - sin(t + phase): both roots lie 2 sqrt(2 beside) apart around the summit."""
        system = oscillator(1.0, (np.array([-1.0, 0.0, 1 - beside]), "stopped"), others=STOPPED)
        start = np.array([math.sin(phase), math.cos(phase), 1.0])
        found = march(system, "swing", start, 4.0)
        assert found.finished
        exact = math.asin(1 - beside) - phase
        assert found.time == pytest.approx(exact, abs=3e-16 / math.sqrt(2 * beside) + 1e-15)

    @pytest.mark.parametrize("beside", [1e-2, 1e-4, 1e-6, 1e-8, 1e-10])
    @pytest.mark.parametrize("phase", [0.0, 0.3, 0.77])
    def test_a_double_root_just_missed(self, beside: float, phase: float) -> None:
        system = oscillator(1.0, (np.array([-1.0, 0.0, 1 + beside]), "stopped"), others=STOPPED)
        found = march(system, "swing", np.array([math.sin(phase), math.cos(phase), 1.0]), 40.0)
        assert not found.finished
        assert found.time == 40.0

    @pytest.mark.parametrize("height", [1.0, 1e-3, 1e-8, 1e-14])
    def test_a_root_at_the_start_that_comes_back(self, height: float) -> None:
        """A ball on the ground thrown up with v is back after 2v/g, however low it flies."""
        g = 9.81
        speed = math.sqrt(2 * g * height)
        rate = with_one(np.array([[0.0, 1.0], [0.0, 0.0]]), np.array([0.0, -g]))
        parts = {"flight": Part(rate, ((np.array([1.0, 0.0, 0.0]), "stopped"),)), **STOPPED}
        system = Modes(parts, np.eye(3)[:2], 2, ends="stopped")
        found = march(system, "flight", np.array([0.0, speed, 1.0]), 100.0)
        assert found.time == pytest.approx(2 * speed / g, rel=1e-13)
        assert found.state[:2] == pytest.approx([0.0, -speed], abs=1e-12 * speed)
        assert found.top.values[0] == pytest.approx(height, rel=1e-12)

    def test_a_root_at_the_start_that_leaves_is_no_event(self) -> None:
        system = oscillator(1.0, (np.array([1.0, 0.0, 0.0]), "stopped"), others=STOPPED)
        found = march(system, "swing", np.array([0.0, 1.0, 1.0]), 10.0)
        assert found.time == pytest.approx(math.pi, rel=1e-14)

    def test_the_first_of_several_guards_fires(self) -> None:
        levels = [0.2, 0.7, -0.3]
        guards = [(np.array([1.0, 0.0, -level]), name) for level, name in zip(levels, "abc", strict=True)]
        system = oscillator(1.0, *guards, others=dict.fromkeys("abc", STOPPED["stopped"]))
        found = march(system, "swing", np.array([1.0, 0.0, 1.0]), 10.0, most_events=1)
        assert found.events[0].after == "b"
        assert found.events[0].time == pytest.approx(math.acos(0.7), rel=1e-14)

    def test_two_guards_at_once_both_fire(self) -> None:
        """One after the other, at the same time."""
        rate = with_one(turning(1.0), np.zeros(2))
        g1, g2 = np.array([1.0, 0.0, -0.5]), np.array([2.0, 0.0, -1.0])
        parts = {
            "swing": Part(rate, ((g1, "first"), (g2, "second"))),
            "first": Part(rate, ((g2, "stopped"),)),
            "second": Part(rate, ((g1, "stopped"),)),
            "stopped": Part(np.zeros((3, 3))),
        }
        found = march(Modes(parts, np.eye(3), 2, ends="stopped"), "swing", np.array([1.0, 0.0, 1.0]), 10.0)
        assert [event.after for event in found.events][-1] == "stopped"
        assert found.time == pytest.approx(math.acos(0.5), rel=1e-13)

    @pytest.mark.parametrize("power", [1, 2, 3, 4, 5])
    def test_sides_are_told_by_the_first_derivative_that_is_not_zero(self, power: int) -> None:
        """x = t^k and x = -t^k at t = 0."""
        n = power + 1
        rate = np.diag(np.ones(power), 1)
        row = np.eye(n)[0]
        system = Modes({"chain": Part(rate, ((row, "chain"), (-row, "chain")))}, np.eye(n), n)
        assert Look(system, np.eye(n)[power]).sides("chain").tolist() == [1, -1]
        assert Look(system, np.zeros(n)).sides("chain").tolist() == [0, 0]

    def test_sides_do_not_see_rounding(self) -> None:
        row = np.array([1.0, 1.0])
        system = Modes({"still": Part(NOTHING, ((row, "still"),))}, np.eye(2), 2)
        assert Look(system, np.array([0.1 + 0.2, -0.3])).sides("still").tolist() == [0]
        assert Look(system, np.array([0.1 + 0.2, -0.3 + 1e-13])).sides("still").tolist() == [1]


class TestModes:
    def test_a_spring_with_another_stiffness_on_the_other_side(self) -> None:
        """x'' = -w_i^2 x with w = 3 for x > 0 and 1 below: half periods pi/3 and pi, by turns."""
        right, left = (np.array([1.0, 0.0, 0.0]), "left"), (np.array([-1.0, 0.0, 0.0]), "right")
        parts = {
            "right": Part(with_one(turning(3.0), np.zeros(2)), (right,)),
            "left": Part(with_one(turning(1.0), np.zeros(2)), (left,)),
        }
        found = march(Modes(parts, np.eye(3)[:2], 2), "right", np.array([0.0, 3.0, 1.0]), 20.5)
        period = math.pi / 3 + math.pi
        exact = sorted(k * period + add for k in range(5) for add in (math.pi / 3, period) if k * period + add < 20.5)
        assert [event.time for event in found.events] == pytest.approx(exact, rel=1e-13)
        assert found.top.values == pytest.approx([1.0, 3.0], rel=1e-11)
        assert found.bottom.values == pytest.approx([-3.0, -3.0], rel=1e-11)

    def test_bounces_and_their_jumps(self) -> None:
        """A ball thrown up with v, restitution 0.8: at the ground at 2v/g (1 + 0.8 + ...)."""
        g, e, v = 9.81, 0.8, 2.0
        rate = with_one(np.array([[0.0, 1.0], [0.0, 0.0]]), np.array([0.0, -g]))
        ground = np.array([1.0, 0.0, 0.0])
        system = Modes(
            {"flight": Part(rate, ((ground, "flight"),))}, np.eye(3)[:2], 2,
            jumps={"flight": lambda z: np.array([0.0, -e * z[1], 1.0])},
        )  # fmt: skip
        count = 30
        end = 2 * v / g * (1 - e**count) / (1 - e) + 1e-6
        found = march(system, "flight", np.array([0.0, v, 1.0]), end)
        exact = 2 * v / g * np.cumsum(e ** np.arange(count))
        assert [event.time for event in found.events] == pytest.approx(exact, rel=1e-12)

    def test_breaks_of_time_change_the_mode_exactly_then(self) -> None:
        """Constant pushes: up, none, down."""
        parts = {
            name: Part(with_one(np.array([[0.0, 1.0], [0.0, 0.0]]), np.array([0.0, push])))
            for name, push in (("up", 2.0), ("none", 0.0), ("down", -3.0))
        }
        system = Modes(parts, np.eye(3)[:2], 2, breaks=((0.1, "up", "none"), (0.3, "none", "down")))
        found = march(system, "up", np.array([0.0, 0.0, 1.0]), 1.0)
        v = 2.0 * 0.1
        exact = 0.1**2 + v * 0.9 - 3.0 * 0.7**2 / 2
        assert found.last == pytest.approx([exact, v - 2.1], rel=1e-14)
        assert [event.time for event in found.events] == [0.1, 0.3]

    def test_an_end_in_the_middle_of_an_interval(self) -> None:
        first = march(oscillator(5.0), "swing", np.array([1.0, 0.0, 1.0]), 1.0 + 1e-9)
        assert first.time == 1.0 + 1e-9
        assert first.last[0] == pytest.approx(math.cos(5 * (1 + 1e-9)), rel=1e-13)

    def test_chattering_is_given_up(self) -> None:
        """Two modes that throw each other out for ever, at finite speed: a finding, not an endless loop."""
        rate = with_one(turning(50.0), np.zeros(2))
        row = np.array([1.0, 0.0, 0.0])
        parts = {"a": Part(rate, ((row, "b"),)), "b": Part(rate, ((-row, "a"),))}
        with pytest.raises(NumericsError, match="chattering") as raised:
            march(Modes(parts, np.eye(3), 2), "a", np.array([1.0, 0.0, 1.0]), 1000.0, most_events=50)
        assert raised.value.code == "NUM101"

    def test_standing_still_in_time_is_given_up(self) -> None:
        """Two modes that each cross into the other at the very same time."""
        push = with_one(np.array([[0.0, 1.0], [0.0, 0.0]]), np.array([0.0, -1.0]))
        pull = with_one(np.array([[0.0, 1.0], [0.0, 0.0]]), np.array([0.0, 1.0]))
        row = np.array([0.0, 1.0, 0.0])
        parts = {"a": Part(push, ((row, "b"),)), "b": Part(pull, ((-row, "a"),))}
        with pytest.raises(NumericsError, match="without end") as raised:
            march(Modes(parts, np.eye(3), 2), "a", np.array([0.0, 1.0, 1.0]), 10.0)
        assert raised.value.code == "NUM101"

    @pytest.mark.parametrize(("count", "stands"), [(200, False), (201, True)])
    def test_two_hundred_changes_at_once_and_no_more(self, count: int, stands: bool) -> None:
        """x' = 1 from -1 reaches 0 once; there so many modes hand it on, each out of its own at once."""
        rate = with_one(np.zeros((1, 1)), np.ones(1))
        reached = np.array([-1.0, 0.0])
        names = ["on the way", *(f"at once {k}" for k in range(count)), "beyond"]
        parts = {name: Part(rate, ((reached, after),)) for name, after in itertools.pairwise(names)}
        system = Modes(parts | {"beyond": Part(rate)}, np.eye(2)[:1], 1)
        if stands:
            with pytest.raises(NumericsError, match="without end"):
                march(system, "on the way", np.array([-1.0, 1.0]), 3.0)
            return
        found = march(system, "on the way", np.array([-1.0, 1.0]), 3.0)
        assert [event.time for event in found.events] == pytest.approx([1.0] * (count + 1), rel=1e-14)
        assert found.crossings == count + 1
        assert found.last[0] == pytest.approx(2.0, rel=1e-13)

    @pytest.mark.parametrize("size", [1e-6, 1.0, 1e6])
    def test_so_much_work_and_no_more(self, size: float) -> None:
        """A hundred panels of half a second in 8, 16, 32, 32 and 12 at once, and the look at each of these as ten."""
        system, start = oscillator(1.0), np.array([size, 0.0, 1.0])
        found = march(system, "swing", start, 50.0, most_work=100 + 5 * 10)
        assert (found.steps, found.long, found.crossings, found.work) == (100, 0, 0, 100)
        with pytest.raises(NumericsError, match="given up"):
            march(system, "swing", start, 50.0, most_work=100 + 5 * 10 - 0.001)


class TestFastComponents:
    @pytest.mark.parametrize("fast", [1e3, 1e6, 1e9, 1e12])
    def test_what_has_faded_needs_no_step(self, fast: float) -> None:
        """x' = -x beside y' = -fast y: the same number of steps whatever the speed of what is gone."""
        rate = np.diag([-1.0, -fast])
        row = np.array([1.0, 1.0, -0.5])
        whole = np.zeros((3, 3))
        whole[:2, :2] = rate
        system = Modes(
            {"fall": Part(whole, ((row, "stopped"),)), **STOPPED}, np.array([[1.0, 1.0, 0.0]]), 2, ends="stopped"
        )
        found = march(system, "fall", np.array([1.0, 1.0, 1.0]), 10.0)
        assert found.time == pytest.approx(math.log(2.0), rel=1e-13)
        assert found.top.values == pytest.approx([2.0], rel=1e-14)
        assert found.steps < 200

    @pytest.mark.parametrize("fast", [1e2, 1e4, 1e6])
    @pytest.mark.parametrize("zeta", [0.05, 0.5, 2.0])
    def test_a_stiff_damped_oscillator_on_a_slow_one(self, fast: float, zeta: float) -> None:
        """e'' + 2 z w e' + w^2 e = cos t after its own vibration has faded: e = Re(H exp(it))."""
        rate = np.zeros((4, 4))
        rate[:2, :2] = turning(1.0)
        rate[2, 3], rate[3] = 1.0, [1.0, 0.0, -(fast**2), -2 * zeta * fast]
        system = Modes({"both": Part(rate)}, np.eye(4), 4, sizes=(1.0, 1.0, 1.0 / fast, 1.0))
        found = march(system, "both", np.array([1.0, 0.0, 0.0, 0.0]), 20.0)
        follows = (np.exp(20j) / (fast**2 - 1 + 2j * zeta * fast)).real
        digits = 1e-11
        assert found.last[:2] == pytest.approx([math.cos(20.0), -math.sin(20.0)], rel=digits)
        assert found.last[2] == pytest.approx(follows, rel=digits + math.exp(-20 * zeta * fast))
        assert found.steps < 1500

    def test_a_fast_component_that_a_jump_wakes_up_is_seen(self) -> None:
        """Asleep for 5 s, then struck: its peak v/w is not stepped over."""
        fast = 1e4
        rate = np.zeros((5, 5))
        rate[:2, :2], rate[2:4, 2:4] = turning(1.0), turning(fast)
        row = np.array([0.0, 0.0, 0.0, 0.0, 0.0])
        system = Modes(
            {"asleep": Part(rate, ((row, "asleep"),)), "awake": Part(rate)}, np.eye(5)[:4], 4,
            breaks=((5.0, "asleep", "awake"),), jumps={"awake": lambda z: z + np.array([0, 0, 0, 1.0, 0])},
        )  # fmt: skip
        found = march(system, "asleep", np.array([1.0, 0.0, 0.0, 0.0, 1.0]), 5.01)
        assert found.top.values[2] == pytest.approx(1 / fast, rel=1e-10)
        assert found.last[2] == pytest.approx(math.sin(fast * 0.01) / fast, rel=1e-8)


def cube(size: float = 1.0) -> Curve:
    return Curve(np.eye(1), lambda y: -(y[0] ** 3), lambda y: -3 * float(y[0]) ** 2, size, 0.05)


class TestCurves:
    @pytest.mark.parametrize("tolerance", [1e-4, 1e-6, 1e-9, 1e-12])
    def test_a_cubic_decay(self, tolerance: float) -> None:
        """x' = -x^3: x = 1/sqrt(1 + 2t), to the tolerance that is asked for."""
        system = Modes({"fall": Part(np.zeros((1, 1)), gain=np.ones((1, 1)), curves=(cube(),))}, np.eye(1), 1)
        found = march(system, "fall", np.ones(1), 50.0, tolerance=tolerance)
        assert found.last[0] == pytest.approx(1 / math.sqrt(101.0), rel=max(30 * tolerance, 1e-13))

    def test_more_digits_cost_more_steps(self) -> None:
        system = Modes({"fall": Part(np.zeros((1, 1)), gain=np.ones((1, 1)), curves=(cube(),))}, np.eye(1), 1)
        steps = [
            march(system, "fall", np.ones(1), 50.0, tolerance=tolerance).steps for tolerance in (1e-4, 1e-8, 1e-12)
        ]
        assert steps == sorted(steps)
        assert steps[-1] < 2000

    def test_nine_digits_where_none_are_asked_for(self) -> None:
        system = Modes({"fall": Part(np.zeros((1, 1)), gain=np.ones((1, 1)), curves=(cube(),))}, np.eye(1), 1)
        plain, asked = march(system, "fall", np.ones(1), 50.0), march(system, "fall", np.ones(1), 50.0, tolerance=1e-9)
        assert (plain.steps, plain.last[0]) == (asked.steps, asked.last[0])
        assert plain.last[0] == pytest.approx(1 / math.sqrt(101.0), rel=3e-8)

    def test_a_guard_along_a_curve(self) -> None:
        """x = 1/sqrt(1 + 2t) falls to 1/3 at t = 4."""
        rate = np.zeros((2, 2))
        curve = replace(cube(), rows=np.array([[1.0, 0.0]]))
        parts = {
            "fall": Part(rate, ((np.array([1.0, -1 / 3]), "stopped"),), np.array([[1.0], [0.0]]), (curve,)),
            "stopped": Part(rate),
        }
        found = march(Modes(parts, np.eye(2), 1, ends="stopped"), "fall", np.ones(2), 10.0, tolerance=1e-12)
        assert found.time == pytest.approx(4.0, rel=1e-11)

    def test_a_curve_on_top_of_a_stiff_linear_part(self) -> None:
        """Two states, one stiff; against an implicit integration."""
        rate = np.array([[-1e4, 1e4], [0.5, -0.5]])
        curve = Curve(
            np.array([[0.0, 1.0]]), lambda y: np.sin(3 * y[0]), lambda y: 3 * math.cos(3 * float(y[0])), 1.0, 0.05
        )
        system = Modes({"both": Part(rate, gain=np.array([[0.0], [1.0]]), curves=(curve,))}, np.eye(2), 2)
        found = march(system, "both", np.array([2.0, 0.1]), 10.0, tolerance=1e-11)

        def rates(t: float, z: np.ndarray) -> np.ndarray:
            return rate @ z + np.array([0.0, math.sin(3 * z[1])])

        exact = solve_ivp(rates, (0, 10), [2.0, 0.1], method="Radau", rtol=1e-11, atol=1e-13).y[:, -1]
        assert found.last == pytest.approx(exact, rel=1e-8)

    def test_a_curve_that_blows_up_is_a_finding(self) -> None:
        """x' = x^2 from 1 is infinite at t = 1."""
        curve = Curve(np.eye(1), lambda y: y[0] ** 2, lambda y: 2 * float(y[0]), 1.0, 0.05)
        system = Modes({"rise": Part(np.zeros((1, 1)), gain=np.ones((1, 1)), curves=(curve,))}, np.eye(1), 1)
        with np.errstate(over="ignore", invalid="ignore"), pytest.raises(NumericsError, match="resolved"):
            march(system, "rise", np.ones(1), 2.0)

    def test_up_to_just_before_it_blows_up(self) -> None:
        curve = Curve(np.eye(1), lambda y: y[0] ** 2, lambda y: 2 * float(y[0]), 1.0, 0.05)
        system = Modes({"rise": Part(np.zeros((1, 1)), gain=np.ones((1, 1)), curves=(curve,))}, np.eye(1), 1)
        found = march(system, "rise", np.ones(1), 0.9, tolerance=1e-10)
        assert found.last[0] == pytest.approx(10.0, rel=1e-8)
