"""A pendulum of small angles: against closed forms, Bessel functions and scipy's DOP853."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import jv, yv

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.pendulum.linear import LinearCase, LinearSwing, _series, linear_swing
from ptmcalc.numerics.pendulum.pieces import Pieces, braking

G = 9.81


def ramp(speed: float, time: float) -> Pieces:
    return Pieces.steps(((0.0, speed / time), (time, 0.0)))


def period(length: float) -> float:
    return 2 * math.pi * math.sqrt(length / G)


class TestRamps:
    @pytest.mark.parametrize("length", [1e-3, 0.4, 7.0, 1e3])
    def test_a_ramp_of_one_period_leaves_nothing(self, length: float) -> None:
        ta = period(length)
        swing = linear_swing(LinearCase(G, Pieces.constant(length), ramp(0.1 * G * ta, ta)), 4 * ta)
        assert swing.farthest("angle", ta).value == pytest.approx(0.0, abs=1e-13)
        assert swing.largest("angle", ta).bar < 1e-9
        assert swing.smallest("angle").value == pytest.approx(-0.2, rel=1e-12)
        assert swing.smallest("angle").time == pytest.approx(ta / 2, rel=1e-5)

    @pytest.mark.parametrize("ta", [1e-3, 0.3, 2.0, 7.9, 3600.0])
    def test_residual_swing_of_a_ramp(self, ta: float) -> None:
        omega, a = math.sqrt(G / 7), 1.3 / ta
        swing = linear_swing(LinearCase(G, Pieces.constant(7.0), ramp(1.3, ta)), ta + 30)
        left = 2 * a / G * abs(math.sin(omega * ta / 2))
        for peak in (swing.largest("angle", ta), swing.smallest("angle", ta)):
            assert abs(peak.value) == pytest.approx(left, rel=1e-11, abs=1e-15)
        assert float(swing.amplitude(ta + 11)) == pytest.approx(left, rel=1e-11, abs=1e-15)
        assert swing.bar(ta + 30) < 1e-11 * a / G + 1e-15

    def test_a_swing_that_ramps_feed_in_step_grows_by_as_much_each_time(self) -> None:
        """Ramps forth and back, half a period each: 2 a/g more with every one."""
        half, a, n = period(5.0) / 2, 0.05, 40
        points = [(k * half, a * (-1) ** k) for k in range(n)]
        swing = linear_swing(LinearCase(G, Pieces.constant(5.0), Pieces.steps((*points, (n * half, 0.0)))), n * half)
        assert float(swing.amplitude(n * half)) == pytest.approx(2 * n * a / G, rel=1e-11)

    @pytest.mark.parametrize("push", [(0.3,), (0.3, -0.2), (0.3, -0.2, 0.05), (0.1, 0.4, -0.3, 0.07)])
    def test_a_push_of_any_power_is_followed(self, push: tuple[float, ...]) -> None:
        """theta'' + w^2 theta = -a(t)/L: Duhamel's integral, by Gauss points."""
        length, end = 4.0, 3.0
        swing = linear_swing(LinearCase(G, Pieces.constant(length), Pieces((0.0,), (push,))), end)
        omega = math.sqrt(G / length)
        nodes, weights = np.polynomial.legendre.leggauss(30)
        for t in (0.4, 1.7, end):
            s = t * (nodes + 1) / 2
            a = sum(c * s**k for k, c in enumerate(push))
            expected = -t / 2 * np.sum(weights * a * np.sin(omega * (t - s))) / (length * omega)
            assert float(swing.at("angle", t)) == pytest.approx(expected, rel=1e-10)


class TestAgainstOthers:
    def steps(self, case: LinearCase, breaks: tuple[float, ...]) -> np.ndarray:
        length, slope = case.length, case.length.derivative()

        def rate(t: float, y: np.ndarray, middle: float) -> list[float]:
            v = float(slope.at(middle))
            now = float(length.at(middle)) + v * (t - middle)
            push = float(case.push.within(case.push.piece(middle), t))
            pivot = push + case.mass_ratio * case.gravity * y[0]
            return [y[1], -(2 * v * y[1] + case.gravity * y[0] + pivot) / now, pivot]

        y, before = np.array([case.angle, case.rate, case.speed]), 0.0
        for stop in breaks:
            found = solve_ivp(rate, (before, stop), y, "DOP853", rtol=3e-14, atol=1e-17, args=((before + stop) / 2,))
            y, before = found.y[:, -1], stop
        return y

    @pytest.mark.parametrize("seed", range(8))
    def test_hoisting_while_pushed(self, seed: int) -> None:
        rng = np.random.default_rng(seed)
        t = np.sort(rng.uniform(0, 15, 5)).tolist()
        lengths = (10 ** rng.uniform(0, 1.2, 3)).tolist()
        case = LinearCase(
            G,
            Pieces.through(((t[0], lengths[0]), (t[2], lengths[1]), (t[4], lengths[2]))),
            Pieces.through(((t[0], 0.0), (t[1], rng.normal()), (t[1], rng.normal()), (t[3], 0.0))),
            float(rng.choice([0.0, 0.3, 4.0])),
            *rng.normal(0, 0.1, 3).tolist(),
        )
        swing, wanted = linear_swing(case, 20.0), self.steps(case, (*t, 20.0))
        found = [float(swing.at(name, 20.0)) for name in ("angle", "rate", "speed")]
        assert found == pytest.approx(wanted.tolist(), rel=1e-9, abs=1e-11)
        assert swing.bar(20.0) < 1e-10

    def test_a_rope_hauled_in_steadily_swings_as_bessel_says(self) -> None:
        l0, v = 20.0, -1.1
        case = LinearCase(G, Pieces.through(((0.0, l0), (17.0, l0 + 17 * v))), Pieces.constant(0.0), 0.0, 0.1, 0.03)
        swing = linear_swing(case, 17.0)

        def basis(t: float) -> np.ndarray:  # u = L^(1/2) C_1(s), s = 2 (g L)^(1/2)/|V|; s' = V s/(2 L)
            length = l0 + v * t
            s = 2 * math.sqrt(G * length) / abs(v)
            rows, root = [], math.sqrt(length)
            for c in (jv, yv):
                slope = (c(0, s) - c(1, s) / s) * v * s / (2 * length)
                rows.append([root * c(1, s), v / (2 * root) * c(1, s) + root * slope])
            return np.array(rows).T

        weights = np.linalg.solve(basis(0.0), [l0 * 0.1, l0 * 0.03 + v * 0.1])
        for t in (0.3, 5.0, 11.0, 17.0):
            assert float(swing.at("offset", t)) == pytest.approx(float((basis(t) @ weights)[0]), rel=1e-11, abs=1e-12)

    @pytest.mark.parametrize("ratio", [0.05, 1.0, 30.0])
    def test_a_pushed_trolley_swings_faster(self, ratio: float) -> None:
        """theta = -(a/g)(1 - cos w t), a = (F/m)/(1 + M/m), w^2 = (g/L)(1 + M/m); momentum of both is F t."""
        swing = linear_swing(LinearCase(G, Pieces.constant(6.0), Pieces.constant(0.5), ratio), 9.0)
        a, omega = 0.5 / (1 + ratio), math.sqrt(G / 6 * (1 + ratio))
        t = np.linspace(0, 9, 40)
        assert swing.at("angle", t) == pytest.approx(-a / G * (1 - np.cos(omega * t)), rel=1e-11, abs=1e-14)
        assert swing.at("speed", t) == pytest.approx(a * (t + ratio / omega * np.sin(omega * t)), rel=1e-11, abs=1e-14)
        assert swing.smallest("acceleration").value == pytest.approx(a * (1 - ratio), rel=1e-11)

    @pytest.mark.parametrize("ratio", [0.0, 0.3, 4.0])
    def test_amplitude_is_how_far_it_swings_from_then_on(self, ratio: float) -> None:
        """Let go beside the plumb line with a rate, on a trolley that rolls as it likes."""
        case = LinearCase(G, Pieces.constant(3.0), Pieces.constant(0.0), ratio, 0.07, -0.2)
        swing = linear_swing(case, 20.0)
        most = math.hypot(0.07, 0.2 / math.sqrt(G * (1 + ratio) / 3.0))
        assert swing.amplitude(np.array([0.0, 1.3, 17.0])) == pytest.approx([most] * 3, rel=1e-11)
        assert swing.largest("angle").value == pytest.approx(most, rel=1e-11)


def test_the_bar_goes_down_with_the_swing() -> None:
    """Nothing in a linear motion has a size of its own, on a rope that changes or one that stays."""
    rope = Pieces.through(((0.0, 9.0), (4.0, 7.0), (20.0, 7.0)))
    bars = [linear_swing(LinearCase(G, rope, Pieces.constant(0.3 * one), 0.2, 0.1 * one), 20.0) for one in (1.0, 1e-6)]
    for time in (1.0, 5.0, 20.0):
        assert bars[1].bar(time) == pytest.approx(1e-6 * bars[0].bar(time), rel=1e-9, abs=0)


@pytest.mark.parametrize("speed", [-1.5, 0.0, 0.4, 1.5])
@pytest.mark.parametrize("stiff", [0.2, 9.81, 40.0])
def test_what_a_series_cuts_off_is_a_geometric_row_above_all_that_follows(speed: float, stiff: float) -> None:
    """The row of the module's docstring, added up one by one; its terms go on by the equation of motion."""
    length, h = 6.0, 1.0
    row, missed = _series(0.3, -0.2, h, (length, speed), stiff, (0.5, 0.1))
    n = len(row)
    q, kappa = abs(speed) * h / length, stiff * h**2 / (length * n * (n - 1))
    r = (q + math.sqrt(q**2 + 4 * kappa)) / 2
    j = np.arange(1, 200)
    last = max(abs(row[-1]), r * abs(row[-2]))
    assert missed == pytest.approx(last * float(((n - 1 + j) * r**j).sum()), rel=1e-12, abs=0)
    c = row.tolist()
    for k in range(n - 2, n + 40):
        c.append(-(speed * h / length * (k + 1) * k * c[k + 1] + stiff * h**2 / length * c[k]) / ((k + 2) * (k + 1)))
    beyond = np.abs(c[n:])
    assert float(beyond @ np.arange(n, n + len(beyond))) <= missed


class TestParts:
    def test_the_extremes_of_a_stretch_are_those_of_many_samples(self) -> None:
        push = Pieces.through(((0.0, 0.0), (3.0, 1.0), (5.0, 1.0), (6.0, -0.4), (6.0, 0.0)))
        swing = linear_swing(LinearCase(G, Pieces.through(((2.0, 9.0), (8.0, 3.0))), push, 0.4, 0.02), 20.0)
        for name in ("angle", "rate", "offset", "speed", "acceleration"):
            for since, until in ((0.0, 20.0), (3.3, 7.7), (11.0, 11.2)):
                seen = swing.at(name, np.linspace(since, until, 20_001))
                top, bottom = swing.largest(name, since, until), swing.smallest(name, since, until)
                near = 2e-3 if name == "acceleration" else 1e-6  # a jump has two sides, samples one of them
                assert top.value == pytest.approx(float(seen.max()), abs=near)
                assert bottom.value == pytest.approx(float(seen.min()), abs=near)
                assert top.value >= float(seen.max()) - top.bar
                assert bottom.value <= float(seen.min()) + bottom.bar
                assert since <= top.time <= until

    @pytest.mark.parametrize(("length", "speed", "end"), [(20.0, -1.1, 17.0), (3.0, 2.0, 20.0), (30.0, -8.0, 3.5)])
    def test_a_peak_on_a_changing_rope_is_the_motion_at_its_time(self, length: float, speed: float, end: float) -> None:
        """Panels are short enough for what is found by them to be no more than the motion itself, within the bar."""
        course = Pieces.through(((0.0, length), (end, length + end * speed)))
        swing = linear_swing(LinearCase(G, course, Pieces.constant(0.3), 0.7, 0.1, 0.03), end)
        for name in ("angle", "rate", "offset", "speed", "acceleration"):
            for since, until in ((0.0, end), (end / 3, end / 2), (end / 2, end), (0.9 * end, end)):
                for sign, peak in ((1, swing.largest(name, since, until)), (-1, swing.smallest(name, since, until))):
                    assert peak.value == pytest.approx(float(swing.at(name, peak.time)), rel=1e-14)
                    near = np.clip(peak.time + np.linspace(-1e-3, 1e-3, 201), since, until)
                    assert sign * peak.value >= float((sign * swing.at(name, near)).max()) - peak.bar

    def test_late_in_a_long_swing_only_what_is_asked_for_is_looked_at(self) -> None:
        """After 243 000 radians: theta = theta_0 cos w t, w^2 = (g/L)(1 + M/m), and what its bar is worth elsewhere."""
        length, ratio, end = 2.5, 0.5, 1e5
        swing = linear_swing(LinearCase(G, Pieces.constant(length), Pieces(), ratio, 0.1), end)
        omega, bar = math.sqrt(G / length * (1 + ratio)), swing.bar(end)
        sizes = {
            "angle": 0.1,
            "offset": 0.1 * length,
            "rate": 0.1 * omega,
            "speed": 0.1 * length * omega * ratio / (1 + ratio),
            "acceleration": 0.1 * G * ratio,
        }
        peaks = {name: swing.largest(name, end - 10) for name in sizes}
        for name, size in sizes.items():
            assert peaks[name].value - size == pytest.approx(0.0, abs=1e-3 * size if name == "speed" else 1e-10 * size)
        assert 1e-16 * omega * end * 0.1 < bar < 4e-15 * omega * end * 0.1, "of the rounding of so many radians"
        assert bar < peaks["angle"].bar < bar + 1e-11 * 0.1
        assert peaks["offset"].bar == pytest.approx(length * peaks["angle"].bar, rel=1e-9)
        assert peaks["acceleration"].bar == pytest.approx(G * ratio * peaks["angle"].bar, rel=1e-9)
        for name, worth in (("rate", omega), ("speed", omega * length * ratio)):
            assert 1.95 * worth * bar < peaks[name].bar < 2 * worth * peaks["angle"].bar

    def test_pieces(self) -> None:
        f = Pieces.through(((1.0, 2.0), (3.0, 6.0), (3.0, 0.0), (4.0, 1.0)))
        assert f.at([0.0, 1.0, 2.0, 3.0, 3.5, 9.0]).tolist() == [2.0, 2.0, 4.0, 0.0, 0.5, 1.0]
        assert f.jumps
        assert not f.integral(5.0).jumps
        assert f.integral(5.0).at(4.0) == pytest.approx(5 + 2 + 8 + 0.5)
        assert f.plus(f.times(-1.0)).at([0.5, 2.2, 7.0]).tolist() == [0.0, 0.0, 0.0]
        assert f.next_break(1.0) == 3.0
        assert f.next_break(4.0) == math.inf
        assert f.around(2.0) == (4.0, 2.0)
        assert braking(9.0, 1.0, 0.5, 0.2).at([1.4, 1.5, 1.6, 1.8]) == pytest.approx([0.0, 0.0, 4.5, 9.0])
        assert braking(9.0).at(0.0) == 9.0
        with pytest.raises(ValueError, match="one after the other"):
            Pieces((0.0, 0.0), ((1.0,), (2.0,)))
        with pytest.raises(ValueError, match="finite"):
            Pieces.constant(math.nan)

    @pytest.mark.parametrize(
        "case",
        [
            LinearCase(0.0, Pieces.constant(1.0), Pieces()),
            LinearCase(math.nan, Pieces.constant(1.0), Pieces()),
            LinearCase(G, Pieces.constant(0.0), Pieces()),
            LinearCase(G, Pieces.through(((0.0, 5.0), (4.0, 0.0))), Pieces()),
            LinearCase(G, Pieces.steps(((0.0, 5.0), (1.0, 4.0))), Pieces()),
            LinearCase(G, Pieces((0.0,), ((5.0, 0.1, 1e-3),)), Pieces()),
            LinearCase(G, Pieces.constant(1.0), Pieces(), mass_ratio=-0.1),
        ],
    )
    def test_what_does_not_swing_is_refused(self, case: LinearCase) -> None:
        with pytest.raises(NumericsError):
            linear_swing(case, 9.0)

    def test_a_motion_without_end_is_given_up(self) -> None:
        swing = linear_swing(LinearCase(G, Pieces.constant(1e-3), Pieces.constant(0.1)), 1e9)
        assert isinstance(swing, LinearSwing)
        with pytest.raises(NumericsError, match="panels"):
            swing.largest("angle")
        with pytest.raises(NumericsError, match="pieces"):
            linear_swing(LinearCase(G, Pieces.through(((0.0, 1e-3), (1e9, 1.0))), Pieces()), 1e9)
