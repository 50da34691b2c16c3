"""What a linear flow says of itself: how long its panels may be, when a guard can be back, what rounding leaves.

Reference: two uncoupled decays and an oscillator, whose components are read off the matrix.
"""

import math

import numpy as np
import pytest
from scipy.linalg import expm

from ptmcalc.numerics.flow import MOST_PANELS, RESOLVED, WORTH_A_LOOK, Flow

FAST, SLOW = 7e4, 3.1


def decays(**more: float) -> Flow:
    """x' = -7e4 x, y' = -3.1 y, watched one by one and guarded together; an input stands still."""
    return Flow(np.diag([-FAST, -SLOW, 0.0]), np.array([[1.0, 1.0, 0.0]]), np.eye(3)[:2], 2, **more)


def sizes() -> np.ndarray:
    return np.ones(2)


def resolves(panel: float, speed: float, unit: float = 1.0) -> None:
    """The longest power of two, in units, that turns by no more than what is resolved."""
    assert speed * panel <= RESOLVED < 2 * speed * panel
    assert math.log2(panel / unit) == pytest.approx(round(math.log2(panel / unit)), abs=1e-12)


class TestPanels:
    def test_resolve_what_is_still_seen(self) -> None:
        assert decays().panel(np.array([1.0, 1.0, 1.0]), 20.0, sizes) < RESOLVED / FAST
        resolves(decays().panel(np.array([1.0, 1.0, 1.0]), 20.0, sizes), FAST)
        resolves(decays().panel(np.array([1e-13, 1.0, 1.0]), 20.0, sizes), SLOW)
        resolves(decays(faded=1e-3).panel(np.array([1e-4, 1.0, 1.0]), 20.0, sizes), SLOW)
        resolves(decays(faded=1e-3).panel(np.array([1e-2, 1.0, 1.0]), 20.0, sizes), FAST)

    def test_an_input_is_as_fast_as_it_is(self) -> None:
        resolves(decays(input_speed=50.0).panel(np.array([1e-13, 1.0, 1.0]), 20.0, sizes), 50.0)
        resolves(decays(input_speed=3 * FAST).finest, 3 * FAST)

    @pytest.mark.parametrize("radians", [0.99 * WORTH_A_LOOK, 1.01 * WORTH_A_LOOK])
    def test_what_has_faded_is_asked_for_where_much_is_to_come(self, radians: float) -> None:
        found = decays().panel(np.array([1e-13, 1.0, 1.0]), radians / FAST, sizes)
        if radians < WORTH_A_LOOK:
            resolves(found, FAST)
        else:
            assert found == radians / FAST, "no more than what is asked for, and the slow one turns by less"

    def test_end_where_they_are_asked_to(self) -> None:
        assert decays().panel(np.array([1.0, 1.0, 1.0]), 0.79 / FAST, sizes) == 0.79 / FAST
        assert decays().panel(np.array([1.0, 1.0, 1.0]), 0.81 / FAST, sizes) < 0.79 / FAST

    def test_long_ones_resolve_the_slowest(self) -> None:
        resolves(decays().longest(np.array([1.0, 1.0, 1.0]), sizes), SLOW)
        resolves(decays().longest(np.array([1.0, 1e-13, 1.0]), sizes), FAST)
        assert decays().longest(np.array([0.0, 0.0, 1.0]), sizes) == math.inf

    def test_glide_where_anything_is_slow_enough(self) -> None:
        """Beside something that does not move at all, nor by itself: exp(-t/4), exp(-50 t), 1."""
        flow = Flow(np.diag([-0.25, -50.0, 0.0]), np.zeros((0, 3)), np.eye(3), 3)
        assert flow.glides(0.999 * RESOLVED / 0.25)
        assert not flow.glides(1.001 * RESOLVED / 0.25)
        assert not Flow(np.zeros((1, 1)), np.zeros((0, 1)), np.eye(1), 1).glides(1e-9)

    @pytest.mark.parametrize("resolved", [RESOLVED, 0.7 * RESOLVED])
    def test_stand_on_a_lattice_of_their_own(self, resolved: float) -> None:
        flow, unit = decays(resolved=resolved), resolved / RESOLVED
        resolves(flow.finest / unit, FAST)
        assert flow.lattice(0.3) == 0.5 * unit
        assert flow.lattice(0.25 * unit) == 0.25 * unit
        assert flow.lattice(0.251 * unit) == 0.5 * unit

    def test_of_the_lattice_are_kept_and_others_are_not(self) -> None:
        flow = decays(resolved=0.7 * RESOLVED)
        for panel, kept in ((flow.unit * 2.0**-7, True), (2.0**-7, False)):
            flow.chunk(panel)
            assert flow.keeps(panel) is kept


class TestMotion:
    RATE = np.array([[0.0, 1.0, 0.0], [-9.0, -0.4, 1.0], [0.0, 0.0, -0.7]])
    STATE = np.array([0.3, -1.1, 0.8])

    def flow(self) -> Flow:
        return Flow(self.RATE, np.array([[1.0, 0.0, 0.0], [0.5, 2.0, 0.0]]), np.eye(3), 2)

    @pytest.mark.parametrize("count", [1, 3, 4, 9, MOST_PANELS])
    def test_goes_from_panel_to_panel(self, count: int) -> None:
        starts = self.flow().chunk(0.0625).starts(self.STATE, count)
        expected = [expm(self.RATE * 0.0625 * k) @ self.STATE for k in range(count + 1)]
        assert starts == pytest.approx(np.array(expected), rel=1e-13, abs=1e-14)
        assert self.flow().moved(self.STATE, 0.37) == pytest.approx(expm(self.RATE * 0.37) @ self.STATE, rel=1e-13)

    @pytest.mark.parametrize("doublings", [-3, 0, 1, 5])
    @pytest.mark.parametrize("kept", [(), (0,), (0, 3)])
    def test_the_end_of_a_panel_is_that_of_its_halves(self, doublings: int, kept: tuple[int, ...]) -> None:
        """However long, and whether panels of some lengths are at hand."""
        flow = self.flow()
        for one in kept:
            flow.chunk(flow.finest * 2.0**one)
        panel = flow.finest * 2.0**doublings
        expected = expm(self.RATE * panel) - np.eye(3)
        for _ in range(2):
            assert flow.end(panel) == pytest.approx(expected, rel=1e-12, abs=1e-15)

    def test_guards_have_a_value_and_a_slope(self) -> None:
        value, slope = self.flow().guard(1, self.STATE)
        assert value == pytest.approx(0.5 * 0.3 - 2 * 1.1, rel=1e-15)
        assert slope == pytest.approx(0.5 * -1.1 + 2 * (-9 * 0.3 + 0.4 * 1.1 + 0.8), rel=1e-15)

    def test_a_guard_that_starts_at_nothing_comes_back(self) -> None:
        """y = v t + b t^2/2 is 0 again after -2 v/b; twice that time is looked at."""
        state = np.array([0.0, 1.3, 0.2])
        bend = -0.4 * 1.3 + 0.2
        assert self.flow().soonest(state) == pytest.approx(-4 * 1.3 / bend, rel=1e-14)
        for other in ([1e-3, 1.3, 0.2], [0.0, -1.3, 0.2], [0.0, 1.3, 2.0]):
            assert self.flow().soonest(np.array(other)) == math.inf
        guard = np.array([0.5, 2.0, 0.0])
        for off, back in ((0.0, True), (2e-16, True), (1e-12, False)):  # no more than rounding of its parts
            beside = np.array([-0.4, 0.1 + off, -6.0])
            slope, bend = guard @ self.RATE @ beside, guard @ self.RATE @ self.RATE @ beside
            assert slope < 0 < bend
            assert self.flow().soonest(-beside) == (pytest.approx(-4 * slope / bend, rel=1e-13) if back else math.inf)

    def test_a_state_beside_a_guard_is_put_onto_it(self) -> None:
        """By the shortest way, and only what rounding may have left."""
        guard = np.array([0.5, 2.0])
        on = np.array([1.2, -0.3, 0.8])
        beside = on + np.array([*(guard * 3e-14), 0.0])
        found = self.flow().on(1, beside)
        assert guard @ found[:2] == pytest.approx(0.0, abs=1e-16)
        assert found == pytest.approx(on, abs=1e-16)
        far = on + np.array([*(guard * 3e-10), 0.0])
        assert np.array_equal(self.flow().on(1, far), far)

    def test_rounding_of_a_guard_is_that_of_its_parts(self) -> None:
        eps = float(np.finfo(float).eps)
        states = np.array([[1.0, -3.0, 0.0], [-2.0, 1.0, 5.0]])
        noise = self.flow().noise(states)
        assert noise == pytest.approx(np.array([2.0, 0.5 * 2 + 2 * 3]) * 16 * eps, rel=1e-6)
        assert np.all(noise > 4 * eps * np.array([2.0, 7.0]))
        none = Flow(self.RATE, np.array([[0.0, 1.0, 0.0]]), np.eye(3), 2).noise(np.array([[1.0, 0.0, 0.0]]))
        assert 0 < none[0] < 1e-20, "what no part of a guard has is dust"

    def test_what_is_watched_at_the_nodes(self) -> None:
        flow, nodes = self.flow(), self.flow().at_nodes(np.array([0.125, 0.3]))
        assert nodes[1, -1] == pytest.approx(expm(self.RATE * 0.3), rel=1e-13)
        flow.chunk(0.125)
        states = np.array([self.STATE, 2 * self.STATE])
        assert flow.seen(0.125, states)[-1, 1] == pytest.approx(expm(self.RATE * 0.125) @ states[1], rel=1e-13)
        assert flow.seen_once(np.array([0.125, 0.3]), states)[-1, 1] == pytest.approx(
            nodes[1, -1] @ states[1], rel=1e-13
        )
