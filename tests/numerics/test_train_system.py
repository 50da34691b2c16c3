"""What the system of a train is made of: coordinates, sizes, modes, prices and steady forces by closed forms."""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import eigvals, null_space
from support.trains import run

from ptmcalc.numerics.train import links, price
from ptmcalc.numerics.train.balance import Balances, _solution
from ptmcalc.numerics.train.drives import Place, SignalRows, drive_curve
from ptmcalc.numerics.train.held import Part
from ptmcalc.numerics.train.ledger import ledger
from ptmcalc.numerics.train.modes import damped
from ptmcalc.numerics.train.parts import HUNT_CROSSLEY, RIGID, Body, Drive, Grip, Guide, Mesh, Smooth, Spring, Train
from ptmcalc.numerics.train.signals import ONE, Now, Signal
from ptmcalc.numerics.train.state import State
from ptmcalc.numerics.train.statics import link_forces
from ptmcalc.numerics.train.system import TrainSystem
from ptmcalc.numerics.train.tree import Coordinates, Groups


def bodies(*inertias: float) -> tuple[Body, ...]:
    return tuple(Body(f"b{i}", inertia) for i, inertia in enumerate(inertias))


def test_a_train_without_signals_is_resolved_by_its_own_motion_alone() -> None:
    assert TrainSystem(Train(bodies(1.0, 2.0), springs=(Spring("shaft", 0, 1, 5.0),))).input_speed == 0.0


@pytest.mark.parametrize("seed", range(30))
@pytest.mark.parametrize("doubled", [False, True])
def test_balances_are_met_to_the_last_digit(seed: int, doubled: bool) -> None:
    """|B - A X| <= eps (|A| |X| + |B|) of badly scaled ones too, and of some that say a thing twice."""
    rng = np.random.default_rng(seed)
    turned, other = (np.linalg.qr(rng.normal(size=(5, 5)))[0] for _ in range(2))
    matrix, right = turned @ np.diag(10.0 ** -np.linspace(0, 6, 5)) @ other, rng.normal(size=(5, 3))
    if doubled:
        matrix[-1], right[-1] = matrix[0], right[0]
    found, fits = _solution(matrix, right)
    assert fits
    share = np.abs(right - matrix @ found) / (np.abs(matrix) @ np.abs(found) + np.abs(right))
    assert share.max() <= np.finfo(float).eps


class TestTravel:
    """Geared bodies joined by links in any order: what can travel, and its mean."""

    @pytest.mark.parametrize("seed", range(40))
    def test_is_what_stretches_no_link(self, seed: int) -> None:
        """Shapes s of the null space of the links; the coordinate of each is sum(J s q)/sum(J s^2), for some s that is
        1 at one of its groups, and is blind to what a force of a link does, M^-1 row."""
        rng = np.random.default_rng(seed)
        count = int(rng.integers(2, 7))
        inertias, ratios = 10 ** rng.uniform(-1, 1, (2, count))
        ratios *= rng.choice([-1, 1], count)
        chosen = bodies(*np.repeat(inertias, 2).tolist())
        meshes = tuple(Mesh(f"g{k}", 2 * k, 2 * k + 1, float(ratio)) for k, ratio in enumerate(ratios))
        pairs = [pair for pair in itertools.permutations(range(2 * count), 2) if pair[0] // 2 != pair[1] // 2]
        picked = [pairs[k] for k in rng.choice(len(pairs), int(rng.integers(1, count + 1)), replace=False)]
        springs = [Spring(f"s{k}", first, second, 10.0) for k, (first, second) in enumerate(picked)]
        if rng.random() < 0.3:
            springs.insert(
                int(rng.integers(len(springs) + 1)), Spring("ground", int(rng.integers(2 * count)), None, 1.0)
            )
        speed = np.array([1.0 if body % 2 == 0 else 1 / ratios[body // 2] for body in range(2 * count)])
        rows = np.zeros((len(springs), count))
        for row, spring in zip(rows, springs, strict=True):
            row[spring.first // 2] += speed[spring.first]
            if spring.second is not None:
                row[spring.second // 2] -= speed[spring.second]
        mass = inertias * (1 + 1 / ratios**2)
        train = Train(chosen, meshes, tuple(springs))
        found = Coordinates.of(train, Groups.among(train))
        shapes = null_space(rows, rcond=1e-12)
        assert found.travels == shapes.shape[1]
        for line, place in enumerate(found.places):
            if place is not None:
                assert found.inverse[place] == pytest.approx(rows[line], rel=1e-14)
        means = found.inverse[count - found.travels :]
        assert means @ (rows / mass).T == pytest.approx(np.zeros((len(means), len(rows))), abs=1e-12)
        for mean in means:
            shape = mean / mass
            size = float(np.abs(shape).max())
            assert rows @ shape == pytest.approx(np.zeros(len(rows)), abs=1e-11 * size)
            travel = float(mean @ shape)  # as large as the mean is blind to what the others do
            assert np.abs(shape / travel - 1).min() < 1e-12

    @pytest.mark.parametrize("apart", [0.0, 1e-10])
    @pytest.mark.parametrize("size", [1e-7, 1.0, 1e7])
    def test_of_a_ring_of_gears_is_told_by_their_ratios(self, size: float, apart: float) -> None:
        """A ring that a link closes travels if its ratios fit, be they ever so awkward; a ten thousand millionth beside
        them it is held."""
        ratio = 0.7 / size
        train = Train(
            bodies(1.0, 1.0, 1.0, 1.0),
            (Mesh("g", 0, 1, ratio), Mesh("h", 2, 3, ratio * (1 + apart))),
            (Spring("one", 0, 2, 10.0), Spring("other", 1, 3, 10.0)),
        )
        assert Coordinates.of(train, Groups.among(train)).travels == (apart == 0)


class TestModes:
    @pytest.mark.parametrize("seed", range(12))
    def test_fade_as_the_quadratic_eigenvalues_do(self, seed: int) -> None:
        """lambda = -d +- i w of M s^2 + C s + K, with little damping; loops of links and a rigid one beside."""
        rng = np.random.default_rng(seed)
        count = 4
        masses = 10 ** rng.uniform(-1, 1, count)
        pairs = [(0, 1), (1, 2), (2, 3), (3, 0), (1, 3), (2, None)]
        grounded, held = bool(seed % 2), seed % 3 == 0
        springs = [
            Spring(f"s{k}", first, second, float(10 ** rng.uniform(1, 3)), float(rng.uniform(0.5, 2) * 1e-5))
            for k, (first, second) in enumerate(pairs[: 5 + grounded])
        ]
        stiffness, damping = np.zeros((2, count, count))
        for spring in springs:
            row = np.zeros(count)
            row[spring.first] = 1.0
            if spring.second is not None:
                row[spring.second] = -1.0
            stiffness += spring.stiffness * np.outer(row, row)
            damping += spring.damping * np.outer(row, row)
        free = list(range(int(held), count))
        k, c, m = (matrix[np.ix_(free, free)] for matrix in (stiffness, damping, np.diag(masses)))
        lines = np.block([[np.zeros_like(k), np.eye(len(k))], [-np.linalg.solve(m, k), -np.linalg.solve(m, c)]])
        values = sorted((one for one in eigvals(lines) if one.imag > 1e-3), key=lambda one: one.imag)
        springs.insert(2, Spring("stop", 0, 2, 0.0, law=RIGID))
        train = Train(bodies(*masses.tolist()), springs=tuple(springs), guides=(Guide("g", 0),) if held else ())
        frequency, fading = damped(train)
        assert frequency == pytest.approx([one.imag for one in values], rel=1e-8)
        assert fading == pytest.approx([-one.real for one in values], rel=1e-5)

    def test_of_what_has_none(self) -> None:
        alone = Train(bodies(1.0, 2.0))
        geared = Train(bodies(1.0, 2.0), (Mesh("g", 0, 1, 1.0),), (Spring("s", 0, 1, 10.0),))
        held = Train(bodies(1.0), springs=(Spring("s", 0, None, 10.0),), guides=(Guide("g", 0),))
        for train in (alone, geared, held):
            assert [one.tolist() for one in damped(train)] == [[], []]

    def test_beside_a_body_that_nothing_holds(self) -> None:
        train = Train(bodies(1.0, 4.0, 2.0), springs=(Spring("s", 0, 1, 100.0, 0.8),), guides=(Guide("g", 0),))
        frequency, fading = damped(train)
        assert frequency == pytest.approx([5.0], rel=1e-14)
        assert fading == pytest.approx([0.8 / 4 / 2], rel=1e-12)


class TestPrices:
    """Of two vibrations without coupling, 3 rad/s that fades and 40 rad/s that fades not or soon."""

    def train(self, fast: float) -> Train:
        return Train(
            bodies(1.0, 1.0), springs=(Spring("slow", 0, None, 9.0, 0.2), Spring("fast", 1, None, 1600.0, 2 * fast))
        )  # fmt: skip

    def test_radians_are_those_of_the_fastest_or_of_the_longest(self) -> None:
        assert price.radians(self.train(0.0), 100.0) == pytest.approx(4000.0)
        assert price.radians(self.train(50.0), 100.0) == pytest.approx(300.0)
        assert price.radians(Train(bodies(1.0)), 100.0) == 1.0
        slow = replace(self.train(5.0), springs=self.train(5.0).springs[:1])
        assert price.radians(slow, 1e4) / price.radians(slow, 1e5) == 1.0, "it has faded by then"

    def test_of_what_is_followed_and_what_is_passed_over(self) -> None:
        """The slow one is followed all the time; beside it of the fast one only what is seen of it counts."""
        radian, long = price.RADIAN, price.LONG_RADIAN
        soon = 40.0 * 1.0  # the fast one fades within the first seconds: never alone
        assert price.linear(self.train(25.0), 50.0) == pytest.approx(radian * 150 + long * (150 + soon), rel=1e-12), (
            "25/25 s"
        )
        passed = price.linear(self.train(0.0), 50.0) - price.linear(self.train(0.0), 10.0)
        assert passed == pytest.approx(radian * 120 + long * 120, rel=1e-12), "of the fast one no more than its most"
        lone = Train(bodies(1.0), springs=(Spring("s", 0, None, 1600.0),))
        assert price.linear(lone, 2.0) == pytest.approx((radian + long) * 80, rel=1e-12)


class TestLedgers:
    @pytest.mark.parametrize(
        ("train", "end", "size"),
        [
            (Train((Body("m", 3.0, 0.0, 2.0),)), 1.0, 12.0),  # energy at both ends
            (Train((Body("m", 3.0, 0.0, 2.0),), drives=(Drive.of("d", 0, Signal.constant(-6.0)),)), 1.0, 6.0),
            (Train((Body("m", 3.0),), guides=(Guide("g", 0, Signal((0.0, 1.0), (4.0, -4.0), (0.0, 0.0))),)), 2.0, 24.0),
            (Train((Body("m", 3.0),), drives=(Drive.of("d", 0, Signal.constant(6.0)),)), 2.0, 24.0),
            (
                Train(
                    (Body("m", 3.0, 0.0, 2.0), Body("n", 3.0, 0.0, 1.0)), (Mesh("g", 0, 1, 2.0),),
                    drives=(Drive.of("d", 0, Signal.constant(50.0)), Drive.of("load", 1, Signal.constant(-100.0))),
                ), 3.0, 300.0,
            ),
        ],
        ids=["speed", "braking", "and back", "work", "through a gear"],
    )  # fmt: skip
    @pytest.mark.parametrize("share", [1e-3, -0.01])
    def test_what_is_left_over_is_a_share_of_what_was_turned_over(
        self, train: Train, end: float, size: float, share: float
    ) -> None:
        """An impact that lost energy which nobody missed: all of it, beside energies at both ends, kinetic energy at
        the largest speeds, work put in, or what went through the gears."""
        found = run(train, end)
        system = TrainSystem(train)
        wrong = replace(found.record, lost=share * size)
        assert ledger(system, system.start(), wrong).residual == pytest.approx(abs(share), rel=2e-9)


class TestSteadyForces:
    def test_of_drives_that_act_at_the_start_and_brakes_that_always_do(self) -> None:
        """What begins later, is gated off or is a brake that closes is not there yet."""
        train = Train(
            (Body("a", 1.0, 0.0, 2.0), Body("b", 1.0, 0.0, 2.0)),
            springs=(
                Spring("play", 0, 1, 50.0, play=0.1, law="kelvin", side=1),
                Spring("stop", 1, None, 0.0, law=RIGID),
            ),
            grips=(
                Grip("bearing", 1, None, Signal.constant(3.0)),
                Grip("brake", 1, None, Signal((0.0, 0.005), (0.0, 70.0), (0.0, 0.0))),
                Grip("slow", 1, None, Signal(values=(5.0,), decay=-5.0)),
            ),
            drives=(
                Drive.of("load", 1, Signal((0.0, 0.005), (-10.0, -90.0), (0.0, 0.0))),
                Drive.of("off", 1, Signal.constant(-500.0), Signal.constant(0.0)),
                Drive.of("half", 1, Signal.constant(-500.0), Signal.constant(0.5)),
            ),
        )
        assert link_forces(train, 0) == [pytest.approx(13.0, rel=1e-13), 0.0]
        backward = replace(train, bodies=(Body("a", 1.0, 0.0, -2.0), Body("b", 1.0, 0.0, -2.0)))
        assert link_forces(backward, 0) == [pytest.approx(7.0, rel=1e-13), 0.0]

    def test_of_nothing_elastic(self) -> None:
        train = Train(bodies(1.0, 2.0), springs=(Spring("stop", 0, 1, 0.0, law=RIGID),))
        assert link_forces(train, 0) == [0.0]


@pytest.mark.parametrize("law", ["linear", "clamped"])
@pytest.mark.parametrize("stiffness", [1.0, 1e6, 1e12])
def test_sizes_of_extension_and_rate_are_those_of_the_closed_train(stiffness: float, law: str) -> None:
    """A rate is as large as its extension times w, to the next power of two, whether a play is open at the start or all
    of it is at rest."""
    for part in np.geomspace(1.0, 4.0, 9):
        train = Train(
            bodies(1.0, 3.0),
            springs=(Spring("s", 0, 1, part * stiffness, play=0.0 if law == "linear" else 0.1, law=law),),
            grips=(Grip("brake", 0, None, Signal.constant(2.0)),),
        )
        system = TrainSystem(train)
        rate = system.scale[2] / system.scale[0]
        assert math.sqrt(0.5) <= rate / math.sqrt(part * stiffness * (1 + 1 / 3)) <= math.sqrt(2.0)


def test_only_loads_that_no_balance_tells_apart_are_shared_out(monkeypatch: pytest.MonkeyPatch) -> None:
    """By the smallest of all solutions, which is dear: a regular train never asks for it, be its torques ever so large;
    two prescribed motions that a locked clutch joins do."""
    asked = []
    smallest = np.linalg.pinv
    monkeypatch.setattr(np.linalg, "pinv", lambda *given, **more: asked.append(1) or smallest(*given, **more))
    train = Train(
        bodies(0.3, 0.7, 1.1, 1.3),
        (Mesh("g", 0, 1, 3.7, 0.83, 0.79), Mesh("h", 2, 3, -0.17, 0.9, 0.7)),
        springs=(Spring("s", 1, 2, 1e9 / 3, 1e4),),
        drives=(Drive.of("d", 0, Signal.constant(1e9 / 7)), Drive.of("e", 3, Signal.constant(-1e8 / 3))),
    )
    run(train, 1e-3)
    assert not asked
    guides = Guide("one", 0), Guide("other", 1)
    run(Train(bodies(1.0, 1.0), grips=(Grip("c", 0, 1, ONE),), guides=guides), 1.0)
    assert asked


def test_what_is_held_by_a_gear_is_named_after_its_own() -> None:
    train = Train(
        bodies(1.0, 1.0, 1.0, 1.0, 1.0),
        (Mesh("one", 0, 1, 2.0, 0.9), Mesh("other", 2, 3, 2.0, 0.8)),
        grips=(Grip("brake", 4, None, ONE), Grip("second", 4, None, ONE)),
    )
    system = TrainSystem(train)
    assert [system.friction_name(group) for group in range(3)] == ["one", "other", "brake"]
    assert TrainSystem(Train(bodies(1.0))).friction_name(0) == ""


class TestCurves:
    @pytest.mark.parametrize("exponent", [1.0, 1.5, 2.2])
    @pytest.mark.parametrize("side", [1, -1])
    def test_of_a_contact(self, exponent: float, side: int) -> None:
        """C d^n (1 + 1.5 c d') without what is linear in it; its slope is that of its values, none before contact."""
        spring = Spring("c", 0, None, 70.0, play=0.2, law=HUNT_CROSSLEY, dissipation=0.4, exponent=exponent)
        one = np.eye(3)
        curve = links.curve(spring, ("firm", side), links.Stretch(one[0], one[1], one[2]))
        assert curve is not None
        for extension, rate in ((0.3, 0.7), (0.5, -1.1), (0.11, 0.2), (0.05, 0.3)):
            depth = max(extension - 0.1, 0.0)
            y = curve.rows @ [side * extension, side * rate, 1.0]
            assert y == pytest.approx([extension - 0.1, rate], rel=1e-13)
            whole = 70.0 * depth**exponent * (1 + 0.6 * rate) - (70.0 * depth if exponent == 1 else 0.0)
            assert curve.value(y[:, None])[0] == pytest.approx(side * whole, rel=1e-12, abs=1e-13)
            if depth:
                step = np.array([[-1e-6, 1e-6], [0.0, 0.0]])
                low, high = curve.value(y[:, None] + step)
                assert curve.slope(y) == pytest.approx((high - low) / 2e-6, rel=1e-7)
        if exponent > 1:
            assert curve.slope(np.array([-0.05, 0.3])) == 0.0

    def test_of_a_drive_grows_with_its_gate(self) -> None:
        one, gate = np.eye(3), Signal.constant(-1.7)
        at = Place(one[0], one[1], one[2], SignalRows({}, {gate: Now(), ONE: Now()}))
        law = Smooth("speed", lambda v: v**3, lambda v: 3 * v**2, 9.0, 0.1)
        curve = drive_curve(Drive.of("d", 0, law, gate), (0, 0), at)
        assert curve is not None
        assert (curve.size, curve.grain) == pytest.approx((15.3, 0.17))
        assert curve.value(np.array([[2.0]]))[0] == pytest.approx(-13.6)
        assert curve.slope(np.array([2.0])) == pytest.approx(-20.4)


def test_pieces_of_what_is_held_are_all_that_hang_together() -> None:
    """Of a chain of four every run of neighbours."""
    rows = {("clutch", k): np.eye(4)[k] - 2 * np.eye(4)[k + 1] for k in range(3)}
    part = Part((0, 1, 2, 3), (0, 3), rows, 2)
    runs = [tuple(range(first, last)) for first, last in itertools.combinations(range(5), 2)]
    assert sorted(part.pieces()) == sorted(runs)
    assert part.motion((1, 2, 3), -1, 4).tolist() == [0.0, -1.0, -0.5, -0.25]


def test_a_light_train_is_solved_as_well_as_a_heavy_one() -> None:
    """A locked clutch between 1 and 1e12 kg m^2: it bears the small one's share, to the last digits."""
    for light, heavy in ((1.0, 1e12), (1e-9, 3.0), (7.0, 11.0)):
        train = Train(
            bodies(light, heavy), grips=(Grip("c", 0, 1, Signal.constant(1e9)),),
            drives=(Drive.of("d", 1, Signal.constant(5.0)),),
        )  # fmt: skip
        system = TrainSystem(train)
        state, z = system.start()
        held = system.react(state, 0.0, z, None).mode
        assert isinstance(held, State)
        solved, _ = Balances(system, held).solve(held)
        acceleration = 5.0 / (light + heavy)
        assert solved.acceleration @ z == pytest.approx([acceleration, acceleration], rel=4e-16)
        assert abs(float(solved.holds[0] @ z)) == pytest.approx(light * acceleration, rel=4e-16)
