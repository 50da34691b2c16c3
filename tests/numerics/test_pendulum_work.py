"""Bars of pendulums by closed forms, what is refused at the edges, and how much work a motion takes."""

import math
from dataclasses import replace

import numpy as np
import pytest

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.collocation import radau
from ptmcalc.numerics.pendulum.equations import KEEP, STATES, Leg, Mode
from ptmcalc.numerics.pendulum.linear import LinearCase, _growth, _series, linear_swing
from ptmcalc.numerics.pendulum.parts import Axis, Buffer, Case, Follow, Gear, Jib, Load, Push, Rail, Straight
from ptmcalc.numerics.pendulum.pieces import Pieces, moved
from ptmcalc.numerics.pendulum.steps import Stepper
from ptmcalc.numerics.pendulum.swing import swing

G = 9.81
EPS = 2.0**-52
HANGING = Load(300.0, Pieces.constant(5.0), 0.1)


class TestLinearBars:
    @pytest.mark.parametrize("angle", [1e-6, 0.3])
    @pytest.mark.parametrize("time", [5.0, 1e3])
    def test_of_a_free_swing_is_the_rounding_of_its_phase(self, angle: float, time: float) -> None:
        omega = math.sqrt(G / 2.5)
        found = linear_swing(LinearCase(G, Pieces.constant(2.5), Pieces(), angle=angle), time)
        assert found.bar(time) == pytest.approx(4 * EPS * (1 + omega * time) * angle, rel=1e-3)
        sideways = linear_swing(LinearCase(G, Pieces.constant(2.5), Pieces(), rate=omega * angle), time)
        assert sideways.bar(time) == pytest.approx(4 * EPS * (1 + omega * time) * angle, rel=1e-3)
        pushed = linear_swing(LinearCase(G, Pieces.constant(2.5), Pieces.constant(G * angle)), time)
        assert pushed.bar(time) == pytest.approx(4 * EPS * (1 + omega * time) * angle, rel=1.1)
        peak = found.largest("angle")
        assert found.bar(time) <= peak.bar <= 1e-11 * angle + found.bar(time)

    def test_of_other_signals_are_those_of_the_angle_in_their_units(self) -> None:
        ratio, length = 0.4, 2.5
        found = linear_swing(LinearCase(G, Pieces.constant(length), Pieces(), ratio, 0.1), 1e5)
        omega = math.sqrt(G * (1 + ratio) / length)
        seen = {
            "angle": 1.0, "offset": length, "rate": 2 * omega, "speed": ratio * length * 2 * omega,
            "acceleration": ratio * G,
        }  # fmt: skip
        part = found.parts[-1]
        assert {name: found._per_angle(part, name) for name in seen} == pytest.approx(seen)
        longer = linear_swing(LinearCase(G, Pieces.through(((0.0, 1.0), (2.0, 3.0))), Pieces(), ratio, 0.1), 0.01)
        assert longer._per_angle(longer.parts[0], "offset") == pytest.approx(1.01)

    def test_of_a_rope_that_shortens_it_grows_as_the_swing_can(self) -> None:
        """Slowly, (L_0/L_1)^(3/4) after Liouville and Green; what the speed adds, by its share e of (g L)^(1/2)."""
        assert _growth(9.0, 4.0, -1e-12, G) == pytest.approx(1.5**1.5, rel=1e-10)
        assert _growth(4.0, 9.0, 1e-12, G) == pytest.approx(1.5**-1.5, rel=1e-10)
        assert _growth(4.0, 4.0, 0.0, G) == 1.0
        for v in (-0.7, 1.0, 0.7):
            e = abs(v) / math.sqrt(G * 4.0)
            assert _growth(4.0, 4.0, v, G) == pytest.approx(math.exp(0.75 * e), rel=1e-12)
            assert math.log(_growth(4.0, 16.0, v, G) * 4**0.75) == pytest.approx((0.5625 + 0.09375) * e, rel=1e-12)
            assert math.log(_growth(16.0, 4.0, v, G) / 4**0.75) == pytest.approx((0.5625 + 0.09375) * e, rel=1e-12)

    @pytest.mark.parametrize("shrink", [-0.25, 0.25, 0.1])
    @pytest.mark.parametrize("turn", [0.1, 2.56])
    def test_what_a_series_cuts_off_is_bounded_closely(self, shrink: float, turn: float) -> None:
        """All further terms of u and of h u', by the recursion of the equation itself."""
        h, l0 = 0.5, 3.0
        row, missed = _series(0.3, 0.2, h, (l0, shrink * l0 / h), turn * l0 / h**2, (0.7, -0.2))
        forced = {0: 0.7 * h**2, 1: (-0.2 * h + shrink * 0.7) * h**2, 2: shrink * -0.2 * h**3}
        c = [0.3, 0.2 * h]
        for k in range(300):
            known = forced.get(k, 0.0) + shrink * (k + 1) * k * c[k + 1] + turn * c[k]
            c.append(-known / ((k + 2) * (k + 1)))
        assert row == pytest.approx(c[: len(row)], rel=1e-12, abs=1e-300)
        cut = max(abs(sum(c[len(row) :])), abs(sum(k * one for k, one in enumerate(c) if k >= len(row))))
        worst = sum(k * abs(one) for k, one in enumerate(c) if k >= len(row))
        assert cut <= missed
        assert worst <= missed <= 4 * worst


class TestBars:
    def test_of_what_both_runs_agree_on_is_the_dust_of_its_size(self) -> None:
        found = swing(Case(G, Rail(), Axis(1.0, Follow(Pieces())), Load(300.0, Pieces.constant(5.0))), 3.0)
        for peak in (found.largest("tension"), found.smallest("tension"), found.known("tension", 1.0)):
            assert peak.value == pytest.approx(300 * G, rel=1e-14)
            assert 300 * G * 5e-13 < peak.bar < 300 * G * 2e-12
        assert found.largest("position").bar == 0.0
        moved = swing(Case(G, Rail(), Axis(1.0, Follow(Pieces.constant(0.5)), speed=0.5), HANGING), 4.0)
        crossed = moved.crossing("position", 1.0)
        assert crossed is not None
        assert 4.0 * 5e-13 < crossed.bar < 4.0 * 1e-11

    def test_a_stretch_begins_where_it_is_told_to(self) -> None:
        """A speed that falls from the start on: the first hundredth counts, the last too."""
        falling = Pieces((0.0,), ((1.0, -0.2),))
        found = swing(Case(G, Rail(), Axis(1.0, Follow(falling), speed=1.0), HANGING), 2.0)
        assert (found.largest("speed").value, found.smallest("speed").value) == pytest.approx((1.0, 0.6))
        assert found.farthest("speed").value == pytest.approx(1.0)
        assert found.largest("speed", 0.5, 1.0).value == pytest.approx(0.9)
        level = found.crossing("speed", 0.999, rising=False)
        assert level is not None
        assert level.time == pytest.approx(0.005, abs=1e-11)


SMALL = Case(
    0.5, Rail(), Axis(0.5, Push(0.1), 0.01, gear=Gear(0.1, 0.9, 0.9), buffers=(Buffer(9.0, "linear", 0.5),)),
    Load(0.5, Pieces.constant(0.5), 0.01),
)  # fmt: skip


@pytest.mark.parametrize("coefficients", [(), (2.0,), (2.0, -1.0), (2.0, -1.0, 0.5, 3.0), (1.0, 0.0, 2.0, -1.0, 4.0)])
def test_a_polynomial_about_another_place(coefficients: tuple[float, ...]) -> None:
    for place in (0.0, 0.7, -2.0):
        found = moved(coefficients, place)
        for x in (-1.0, 0.0, 0.4):
            expected = sum(c * (place + x) ** k for k, c in enumerate(coefficients))
            assert sum(c * x**k for k, c in enumerate(found)) == pytest.approx(expected, rel=1e-12, abs=1e-12)


class TestEdges:
    def test_small_machines_swing_for_a_moment(self) -> None:
        assert swing(SMALL, 0.5).end == 0.5
        assert linear_swing(LinearCase(0.5, Pieces.constant(0.5), Pieces()), 0.5).end == 0.5
        assert linear_swing(LinearCase(0.5, Pieces.constant(0.5), Pieces()), 0.0).end == 0.0

    @pytest.mark.parametrize(
        "wrong",
        [
            replace(SMALL, gravity=math.inf),
            replace(SMALL, load=replace(SMALL.load, mass=-1.0)),
            replace(SMALL, load=replace(SMALL.load, length=Pieces.through(((0.0, 1.0), (0.3, 0.0))))),
            replace(SMALL, load=replace(SMALL.load, across=1.575)),
            replace(SMALL, load=replace(SMALL.load, along=1.575, across_rate=0.1)),
            *(
                replace(SMALL, axis=replace(SMALL.axis, **changed))
                for changed in (
                    {"inertia": -0.05},
                    {"inertia": 0.0, "gear": Gear()},
                    {"gear": Gear(-0.1)},
                    {"gear": Gear(forward=0.0)},
                    {"gear": Gear(forward=1.5)},
                    {"gear": Gear(reverse=1.5)},
                    {"gear": Gear(reverse=-0.5)},
                    {"friction": -0.1},
                    {"brake": Pieces.constant(-0.1)},
                    {"gear": Gear(brake=Pieces.through(((0.1, 0.2), (0.4, -0.1))))},
                    {"buffers": (Buffer(9.0, "linear", -0.5),)},
                    {"buffers": (Buffer(9.0, "linear", 0.0),)},
                    {"buffers": (Buffer(9.0, "linear", 0.5, side=2),)},
                    {"buffers": (Buffer(9.0, "linear", 0.5, side=-2),)},
                    {"buffers": (Buffer(9.0, "linear", 0.5, side=0),)},
                    {"drive": Straight((0.0,), (1.0,))},
                    {"drive": Follow(Pieces.constant(1.0)), "speed": 1.0 + 1e-6},
                    {"drive": Follow(Pieces.steps(((0.0, 1.0), (0.2, 2.0)))), "speed": 1.0},
                )
            ),
        ],
    )
    def test_what_is_just_beyond_is_refused(self, wrong: Case) -> None:
        with pytest.raises(NumericsError) as told:
            swing(wrong, 0.5)
        assert told.value.code == "NUM102"

    @pytest.mark.parametrize("end", [0.0, -1.0, math.inf, math.nan])
    def test_an_end_that_is_none_is_refused(self, end: float) -> None:
        with pytest.raises(NumericsError, match="ends at"):
            swing(SMALL, end)
        if end:
            with pytest.raises(NumericsError, match="ends at"):
                linear_swing(LinearCase(G, Pieces.constant(1.0), Pieces()), end)

    def test_a_buffer_behind_and_one_ahead(self) -> None:
        """Either is met at its place, as far as its way goes."""
        buffers = (Buffer(0.5, "linear", 400.0), Buffer(-0.5, "linear", 400.0, side=-1))
        found = swing(Case(G, Rail(), Axis(4.0, buffers=buffers, speed=1.0), Load(1e-9, Pieces.constant(1.0))), 3.0)
        assert found.largest("position").value == pytest.approx(0.6, rel=1e-8)
        assert found.smallest("position").value == pytest.approx(-0.6, rel=1e-8)


class TestWork:
    """How often a motion is looked at. Steps are as long as the tail lets them be: one try for nearly each, and few
    rounds of Newton's method in each."""

    @pytest.fixture
    def counted(self, monkeypatch: pytest.MonkeyPatch) -> dict[str, int]:
        counts = {"tries": 0, "rates": 0, "inverses": 0}
        solve, rate, inverse = Stepper._solve, Leg.rate, np.linalg.inv

        def tried(self: Stepper, *given: object) -> object:
            counts["tries"] += 1
            return solve(self, *given)  # type: ignore[arg-type]

        def rated(self: Leg, time: np.ndarray, z: np.ndarray) -> np.ndarray:
            counts["rates"] += 1
            return rate(self, time, z)

        def inverted(matrix: np.ndarray) -> np.ndarray:
            counts["inverses"] += 1
            return np.asarray(inverse(matrix))

        monkeypatch.setattr(Stepper, "_solve", tried)
        monkeypatch.setattr(Leg, "rate", rated)
        monkeypatch.setattr(np.linalg, "inv", inverted)
        return counts

    @pytest.mark.parametrize("length", [1e-9, 0.05, 5.0, 2000.0, 1e10])
    def test_of_a_free_swing_is_the_same_at_any_length(self, counted: dict[str, int], length: float) -> None:
        end = 20 * math.sqrt(length / G)
        found = swing(Case(G, Rail(), Axis(1.0, Follow(Pieces())), Load(1.0, Pieces.constant(length), 0.3)), end)
        assert found.steps <= 28
        assert counted["tries"] <= 55
        assert counted["rates"] <= 525
        assert counted["inverses"] <= 40

    def test_of_a_jib_that_is_driven_and_held(self, counted: dict[str, int]) -> None:
        axis = Axis(6e4, Push(2e4, until=3.0), friction=900.0, brake=Pieces.steps(((3.3, 1.5e4),)))
        hauled = Load(2500.0, Pieces.through(((1.0, 7.0), (4.0, 4.0))))
        found = swing(Case(G, Jib(Pieces.constant(12.0)), axis, hauled), 8.0)
        assert found.steps <= 46
        assert counted["tries"] <= 108
        assert counted["rates"] <= 960
        assert counted["inverses"] <= 103

    def test_of_a_stretch_that_stiffens_suddenly(self, counted: dict[str, int]) -> None:
        """A wall of tanh: what the steps before it lead one to expect is far too long."""
        wall = Axis(1.0, field=lambda t, s, v: -4e3 * (1 + np.tanh(300 * (s - 0.7))) * 0.5 + 0 * t, speed=1.0)
        found = swing(Case(G, Rail(), wall, Load(1e-6, Pieces.constant(5.0))), 1.4)
        assert found.steps <= 29
        assert counted["tries"] <= 80
        assert counted["rates"] <= 540
        assert counted["inverses"] <= 75

    @pytest.mark.parametrize(("rounds", "grown"), [(9, 2.5), (10, 1.0), (14, 1.0)])
    def test_of_newtons_method_that_hardly_ends(self, rounds: int, grown: float) -> None:
        """A longer step would not end at all; and a Jacobian that served badly is no use to the next one."""
        case = Case(G, Rail(), Axis(1.0, Follow(Pieces())), HANGING)
        leg = Leg(case, Mode(KEEP, 0, 0, True, ()), 0.0, (), None)
        stepper, row = Stepper(radau(4), 1e-9, np.ones(STATES), 1.0), np.zeros((STATES, 4))
        stepper._solve = lambda *_: (row, 0.0, rounds)  # type: ignore[method-assign]
        stepper.inverse = leg, 0.3, np.eye(4 * STATES)
        first = stepper.step(leg, 0.0, np.zeros(STATES), 10.0)
        assert stepper.step(leg, first.end, first.last(), 10.0).length == pytest.approx(grown * first.length)
        assert (stepper.inverse is None) == (grown == 1.0)


class TestBothSides:
    """What is read at a jump."""

    @pytest.mark.parametrize("ulps", [-3, -2, -1, 0, 1, 2, 3])
    @pytest.mark.parametrize("later", [False, True])
    def test_of_a_stop_are_found_from_a_rounded_time(self, ulps: int, later: bool) -> None:
        """A trolley that friction brings to rest: 2 m/s^2 until then, none after; the pull of its rope is another."""
        stopping = Axis(4.0, friction=8.0, speed=1.0)
        track = swing(Case(G, Rail(), stopping, Load(1e-9, Pieces.constant(1.0))), 3.0)._fine
        (stop,) = (event.time for event in track.events if event.after == "rest")
        wanted = 0.0 if later else -2.0
        found = track.polished("acceleration", wanted, stop + ulps * np.spacing(stop), 0.0, 3.0)
        assert stop == pytest.approx(0.5)
        assert found == pytest.approx(wanted, abs=1e-8)
