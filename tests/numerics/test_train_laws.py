"""Laws of torques and signals as functionals: against their formulas, on every piece and beside every knot."""

import itertools
import math

import numpy as np
import pytest
from scipy.linalg import expm

from ptmcalc.numerics.train import links
from ptmcalc.numerics.train.drives import (
    Place,
    SignalRows,
    drive_guards,
    drive_row,
    knot,
    law_now,
    piece_at,
    stage_breaks,
)
from ptmcalc.numerics.train.parts import Drive, Governed, Spring, Stage, Straight
from ptmcalc.numerics.train.signals import ONE, Inputs, Now, Signal, Sine, Trigger

KNOTS, VALUES = (-1.5, 0.2, 2.0, 3.1), (4.0, -1.0, 7.0, 7.5)
TURN = 2 * math.pi
RIPPLE = Straight("position", (0.3, 1.0, 4.0, 0.3 + TURN), (5.0, 9.0, -2.0, 5.0), period=TURN)
GATE = Signal.constant(1.7)


def place(*signals: Signal) -> Place:
    """A body whose state is its speed and its position, the functional 1 behind them, then a signal each."""
    one = np.eye(3 + len(signals))
    rows = {signal: one[3 + k] for k, signal in enumerate(signals)}
    return Place(one[0], one[1], one[2], SignalRows(rows, dict.fromkeys((*signals, GATE, ONE), Now())))


def beside(knots: tuple[float, ...]) -> list[float]:
    inside = [(a + b) / 2 for a, b in itertools.pairwise(knots)]
    return [knots[0] - 2.3, *inside, *knots, knots[-1] + 1.9]


class TestStraight:
    @pytest.mark.parametrize("on", ["speed", "position"])
    def test_is_constant_beyond_its_ends(self, on: str) -> None:
        law = Straight(on, KNOTS, VALUES)
        for x in beside(KNOTS):
            state = np.array([x, 50.0, 1.0]) if on == "speed" else np.array([50.0, x, 1.0])
            piece = law_now(law, state[0], state[1])
            row = drive_row(Drive.of("d", 0, law, GATE), (0, piece), place())
            assert row @ state == pytest.approx(1.7 * np.interp(x, KNOTS, VALUES), rel=1e-13)

    def test_goes_on_straight_beyond_its_ends(self) -> None:
        law = Straight("speed", KNOTS, VALUES, extends=True)
        for x in beside(KNOTS):
            first = 0 if x < KNOTS[1] else 2 if x > KNOTS[2] else 1
            slope = (VALUES[first + 1] - VALUES[first]) / (KNOTS[first + 1] - KNOTS[first])
            row = drive_row(Drive.of("d", 0, law), (0, piece_at(law, x)), place())
            assert row @ [x, 9.0, 1.0] == pytest.approx(VALUES[first] + slope * (x - KNOTS[first]), rel=1e-13)

    def test_of_one_knot_is_constant_whichever_way_it_goes_on(self) -> None:
        for extends in (False, True):
            law = Straight("speed", (0.7,), (3.0,), extends)
            for x in (-4.0, 0.7, 5.0):
                assert drive_row(Drive.of("d", 0, law), (0, piece_at(law, x)), place()) @ [x, 9.0, 1.0] == 3.0

    @pytest.mark.parametrize("turns", [-3, -1, 0, 1, 2, 50])
    def test_comes_again_every_turn(self, turns: int) -> None:
        for x in (0.31, 0.9, 1.1, 3.9, 4.1, 6.2, 6.5):
            at = x + turns * TURN
            row = drive_row(Drive.of("d", 0, RIPPLE), (0, piece_at(RIPPLE, at)), place())
            assert row @ [9.0, at, 1.0] == pytest.approx(np.interp(x, RIPPLE.knots, RIPPLE.values), rel=1e-10)
        for index, x in enumerate(RIPPLE.knots[:-1]):
            assert knot(RIPPLE, index + 3 * turns) == pytest.approx(x + turns * TURN, rel=1e-14)
            assert piece_at(RIPPLE, x + turns * TURN + 1e-9) == index + 3 * turns

    @pytest.mark.parametrize("law", [
        Straight("speed", KNOTS, VALUES), Straight("speed", KNOTS, VALUES, extends=True),
        Straight("speed", RIPPLE.knots, RIPPLE.values, period=TURN),
    ])  # fmt: skip
    def test_its_guards_are_the_ends_of_its_piece(self, law: Straight) -> None:
        """Inside a piece all are above 0; beyond an end exactly one is below, and leads to the piece that holds there;
        where no piece follows there is none."""
        for x in [*beside(KNOTS)[:4], KNOTS[0] + 0.01, KNOTS[-1] + 5.0]:
            piece = piece_at(law, x)
            guards = list(drive_guards(Drive.of("d", 0, law), (0, piece), place()))
            assert all(row @ [x, 9.0, 1.0] > 0 for row, _ in guards)
            for y in (x - 1.2, x + 1.2):
                after = piece_at(law, y)
                fired = [state for row, state in guards if row @ [y, 9.0, 1.0] < 0]
                assert len(fired) == (after != piece)
                if abs(after - piece) == 1:
                    assert fired == [(0, after)]


class TestGoverned:
    REFERENCE = Signal.constant(2.0)
    LAW = Governed(REFERENCE, 6.0, 15.0)

    @pytest.mark.parametrize("speed", [-3.0, -0.6, 0.0, 2.0, 3.9, 4.6, 9.0])
    def test_is_clipped(self, speed: float) -> None:
        """clip(6 (2 - v), -15, 15): in its middle piece from -0.5 to 4.5."""
        free = 6.0 * (2.0 - speed)
        piece = int(np.sign(free)) if abs(free) > 15 else 0
        drive, at, state = Drive.of("d", 0, self.LAW, GATE), place(self.REFERENCE), np.array([speed, 0.0, 1.0, 2.0])
        assert drive_row(drive, (0, piece), at) @ state == pytest.approx(1.7 * np.clip(free, -15, 15), rel=1e-14)
        for wrong in {-1, 0, 1} - {piece}:
            assert min(row @ state for row, _ in drive_guards(drive, (0, wrong), at)) < 0 or wrong == -piece
        assert all(row @ state > 0 for row, _ in drive_guards(drive, (0, piece), at))
        fired = [(wrong, follows) for wrong in (-1, 0, 1) for row, follows in drive_guards(drive, (0, wrong), at)
                 if row @ state < 0]  # fmt: skip
        assert all(follows == (0, 0) if wrong else follows == (0, piece) for wrong, follows in fired)


def test_stages_follow_one_another_by_speed_and_by_time() -> None:
    law = Straight("speed", (0.0, 1.0), (5.0, 4.0))
    drive = Drive("d", 0, (Stage(law, until=3.0), Stage(law, until_time=7.0), Stage(law, until=9.0, until_time=8.0)))
    guards = list(drive_guards(drive, (0, 1), place()))
    assert guards[0][0] @ [2.0, 0.0, 1.0] == pytest.approx(1.0)
    assert guards[0][1] == (1, 0)
    assert [stage_breaks(drive, (k, 0)) for k in range(3)] == [math.inf, 7.0, math.inf], "the last one has no end"
    assert all(state[0] == 2 for _, state in drive_guards(drive, (2, 1), place()))


class TestSignals:
    SIGNAL = Signal(
        (0.0, 0.4, 1.5), (2.0, -1.0, 0.5), (3.0, -0.7, 0.2),
        (Sine(0.8, 11.0, 0.3), Sine(-0.2, 5.0, 0.0)), decay=1.4, decay_time=0.25,
    )  # fmt: skip
    OTHER = Signal((0.0,), (1.0,), (0.5,), (Sine(0.1, 5.0, -1.1),), decay=-0.3, decay_time=2.0)

    def test_rows_are_their_formulas(self) -> None:
        """u' = S u from its start: straight lines, sines and decays, whichever share the inputs."""
        inputs = Inputs.of((self.SIGNAL, self.OTHER, ONE))
        assert inputs.size == 2 + 4 + 2 == len(inputs.rate())
        begin = inputs.start()
        for decaying in (self.SIGNAL, self.OTHER):
            assert begin[inputs.decay_index(decaying)] == 0.0, "nothing decays before it has begun to"
            begin[inputs.decay_index(decaying)] = 1.0
        for t in (0.0, 0.1, 0.39, 0.41, 1.2, 1.6, 4.0):
            u = expm(inputs.rate() * t) @ begin
            for signal in (self.SIGNAL, self.OTHER, ONE):
                k = signal.piece(t)
                expected = signal.values[k] + signal.slopes[k] * (t - signal.times[k])
                expected += sum(sine.size * math.sin(sine.frequency * t + sine.phase) for sine in signal.sines)
                expected += signal.decay * math.exp(-t / signal.decay_time)
                assert inputs.row(signal, Now(k)) @ u == pytest.approx(expected, rel=1e-12)

    def test_a_late_start_moves_the_straight_lines(self) -> None:
        ramp = Signal((0.0, 0.5), (1.0, 3.0), (4.0, -1.0), trigger=Trigger(0, "speed", 1.0, True), before=-7.0)
        inputs = Inputs.of((ramp,))
        assert inputs.row(ramp, Now(-1)) @ [1.0, 2.0] == -7.0
        assert inputs.row(ramp, Now(0, 2.0)) @ [1.0, 2.3] == pytest.approx(1.0 + 4.0 * 0.3)
        assert inputs.row(ramp, Now(1, 2.0)) @ [1.0, 2.8] == pytest.approx(3.0 - 0.3)

    def test_through_points_it_is_the_line_between_them(self) -> None:
        points = ((0.5, 2.0), (1.0, -3.0), (4.0, 1.5))
        for some in (points, ((0.0, 1.0), *points)):
            signal = Signal.through(some)
            for t in (0.0, 0.2, 0.5, 0.7, 1.0, 3.0, 4.0, 9.0):
                k = signal.piece(t)
                value = signal.values[k] + signal.slopes[k] * (t - signal.times[k])
                assert value == pytest.approx(np.interp(t, *zip(*some, strict=True)), rel=1e-13)

    def test_its_fastest_part(self) -> None:
        assert self.SIGNAL.largest_frequency == 11.0
        short = Signal(decay=1.0, decay_time=0.02, sines=(Sine(1.0, 30.0, 0.7),))
        assert short.largest_frequency == pytest.approx(50.0)
        assert Signal(decay_time=0.02).largest_frequency == 0.0


class TestContacts:
    """Of a link with play: which state holds where, what it pulls with, and what follows where it does not hold."""

    STIFFNESS, DAMPING, PLAY, LOSS = 70.0, 13.0, 0.3, 0.4
    PHASES: dict[str, tuple[str, ...]] = {
        "kelvin": ("firm",),
        "no_pull": ("firm", "lift"),
        "clamped": ("firm", "lift", "over"),
        "hunt_crossley": ("firm", "lift"),
    }

    def phase(self, law: str, depth: float, rate: float) -> str:
        pull, push = self.STIFFNESS * depth, self.DAMPING * rate
        if law == "kelvin":
            return "firm"
        if law == "hunt_crossley":
            return "firm" if 1 + 1.5 * self.LOSS * rate > 0 else "lift"
        if pull + push < 0:
            return "lift"
        return "over" if law == "clamped" and push > pull else "firm"

    def pulls(self, law: str, depth: float, rate: float) -> float:
        pull, push = self.STIFFNESS * depth, self.DAMPING * rate
        if law == "kelvin":
            return pull + push
        if law == "no_pull":
            return max(0.0, pull + push)
        if law == "clamped":
            return pull + min(max(push, -pull), pull)
        return max(0.0, pull * (1 + 1.5 * self.LOSS * rate))

    @pytest.mark.parametrize("law", PHASES)
    @pytest.mark.parametrize("side", [0, 1, -1])
    def test_are_those_of_their_law(self, law: str, side: int) -> None:
        spring = Spring(
            "s", 0, None, self.STIFFNESS, self.DAMPING, self.PLAY, law, side, dissipation=self.LOSS
        )  # fmt: skip
        one = np.eye(3)
        of = links.Stretch(one[0], one[1], one[2])
        rng = np.random.default_rng(3)
        seen = set()
        still = 1 / (1.5 * self.LOSS)  # a rebound at which the dissipation takes all of the push
        beside = [(on * 0.4, -on * still * share) for on in (1, -1) for share in (0.998, 1.002)]
        for x, rate in [*(rng.normal(size=(300, 2)) * [0.4, 2.5]).tolist(), *beside]:
            state = np.array([x, rate, 1.0])
            on = next((way for way in (1, -1) if way * x > self.PLAY / 2 and side in (0, way)), 0)
            depth = abs(x) - self.PLAY / 2

            def broken(contact: links.Contact, state: np.ndarray = state) -> list[links.Contact]:
                return [to for row, to in links.guards(spring, contact, of) if row @ state < 0]

            if not on:
                assert broken(links.OPEN) == []
                assert links.force(spring, links.OPEN, of) @ state == links.stored(spring, links.OPEN, x) == 0.0
                continue
            true = self.phase(law, depth, on * rate), on
            seen.add(true)
            assert broken(links.OPEN) == [("firm", on)]
            for phase in self.PHASES[law]:
                assert broken((phase, on)) in ([true], []) or phase != "firm", "what follows is what holds"
                assert (broken((phase, on)) == []) == (phase == true[0])
                assert links.OPEN not in broken((phase, on))
            force = links.force(spring, true, of) @ state
            curve = links.curve(spring, true, of)
            if curve is not None:
                force += curve.value((curve.rows @ state)[:, None])[0]
            assert force == pytest.approx(on * self.pulls(law, depth, on * rate), rel=1e-12, abs=1e-12)
            assert links.elastic(spring, true, of) @ state == pytest.approx(on * self.STIFFNESS * depth, rel=1e-12)
            assert links.stored(spring, true, x) == pytest.approx(self.STIFFNESS * depth**2 / 2, rel=1e-12)
            behind = np.array([on * (self.PLAY / 2 - 0.01), on * 0.1, 1.0])  # it has just come apart
            if true[0] == "lift" or len(self.PHASES[law]) == 1:  # with a damper it lets go before
                assert links.OPEN in broken(true, behind)
        sides = (side,) if side else (1, -1)
        assert seen == {(phase, on) for phase in self.PHASES[law] for on in sides}
