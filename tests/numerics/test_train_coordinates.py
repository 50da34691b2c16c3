"""Groups of geared bodies, coordinates of travel and extension, natural frequencies; and what a ledger must show."""

import math

import numpy as np
import pytest
from scipy.linalg import eigh
from support.random_trains import machine
from support.trains import run, train_of

from ptmcalc.numerics.train.modes import frequencies
from ptmcalc.numerics.train.parts import Body, Drive, Grip, Guide, Mesh, Spring, Train
from ptmcalc.numerics.train.signals import Signal
from ptmcalc.numerics.train.system import TrainSystem
from ptmcalc.numerics.train.tree import Groups


def bodies(*inertias: float) -> tuple[Body, ...]:
    return tuple(Body(f"b{i}", inertia) for i, inertia in enumerate(inertias))


class TestGroups:
    def test_ratios_along_a_train_of_gears(self) -> None:
        train = Train(bodies(1.0, 1.0, 1.0, 1.0), (Mesh("a", 0, 1, 2.0), Mesh("b", 1, 2, -5.0)))
        groups = Groups.among(train)
        assert groups.of == (0, 0, 0, 1)
        assert groups.ratio[:3] / groups.ratio[0] == pytest.approx([1.0, 0.5, -0.1])
        assert groups.inertias(train)[0] == pytest.approx(1 + 0.25 + 0.01)

    def test_two_motors_on_one_wheel(self) -> None:
        train = Train(bodies(1.0, 2.0, 3.0), (Mesh("a", 0, 2, 4.0), Mesh("b", 1, 2, 4.0)))
        groups = Groups.among(train)
        assert groups.count == 1
        assert groups.ratio / groups.ratio[2] == pytest.approx([4.0, 4.0, 1.0])

    def test_a_loop_of_gears_is_refused(self) -> None:
        with pytest.raises(ValueError, match="loop"):
            Groups.among(Train(bodies(1.0, 1.0), (Mesh("a", 0, 1, 2.0), Mesh("b", 0, 1, 2.0))))


class TestCoordinates:
    @pytest.mark.parametrize("seed", range(30))
    def test_there_and_back(self, seed: int) -> None:
        train = train_of(machine(seed))
        found = TrainSystem(train).coordinates
        assert found.basis @ found.inverse == pytest.approx(np.eye(len(found.basis)), abs=1e-12)

    @pytest.mark.parametrize("ratio", [1.0, 1e6, 1e12])
    def test_forces_between_bodies_do_not_move_their_mean(self, ratio: float) -> None:
        """Two vibrate against each other for long; what they share stays where it is, exactly."""
        train = Train(
            (Body("a", 1.0, 0.0, 1.0), Body("b", ratio, 0.0, -1.0 / ratio)), springs=(Spring("s", 0, 1, 400.0, 0.1),)
        )
        found = run(train, 50.0)
        momentum = found.last("speed", 0) + ratio * found.last("speed", 1)
        assert momentum == pytest.approx(0.0, abs=1e-14)

    def test_a_train_without_links_travels(self) -> None:
        found = TrainSystem(Train(bodies(1.0, 2.0, 3.0))).coordinates
        assert found.travels == 3


class TestFrequencies:
    @pytest.mark.parametrize("seed", range(30))
    def test_against_the_eigenvalues_of_the_matrices(self, seed: int) -> None:
        random = np.random.default_rng(seed)
        count = int(random.integers(2, 7))
        masses, stiffness = 10 ** random.uniform(-1, 1, count), 10 ** random.uniform(1, 3, count)
        links = [Spring(f"s{i}", i, i + 1, float(stiffness[i])) for i in range(count - 1)]
        grounded = bool(random.integers(2))
        if grounded:
            links.append(Spring("g", 0, None, float(stiffness[-1])))
        matrix = np.zeros((count, count))
        for link in links:
            row = np.zeros(count)
            row[link.first] = 1.0
            if link.second is not None:
                row[link.second] = -1.0
            matrix += link.stiffness * np.outer(row, row)
        values = np.sqrt(np.maximum(eigh(matrix, np.diag(masses), eigvals_only=True), 0.0))
        expected = values if grounded else values[1:]
        found = frequencies(Train(bodies(*map(float, masses)), springs=tuple(links)))
        assert found == pytest.approx(expected, rel=1e-9)

    def test_of_a_prescribed_body_are_those_of_a_fixed_one(self) -> None:
        train = Train(bodies(1.0, 4.0), springs=(Spring("s", 0, 1, 100.0),), guides=(Guide("g", 0),))
        assert frequencies(train) == pytest.approx([5.0], rel=1e-14)


class TestLedger:
    def test_names_every_share(self) -> None:
        """A motor through a lossy gear against a brake: a fifth lost in the gear, the rest in brake and mass."""
        train = Train(
            bodies(1.0, 2.0), (Mesh("gear", 0, 1, 2.0, 0.8, 0.75),),
            grips=(Grip("brake", 1, None, Signal.constant(4.0)),),
            drives=(Drive.of("motor", 0, Signal.constant(10.0)),),
        )  # fmt: skip
        found = run(train, 3.0)
        shares, turned = found.ledger, found.last("position", 0)
        assert shares.put_in["motor"] == pytest.approx(10.0 * turned, rel=1e-12)
        assert shares.lost["brake"] == pytest.approx(4.0 * turned / 2, rel=1e-12)
        outer = (4.0 + 2.0 * found.last("speed", 1) / 3.0) / 2
        assert shares.lost["gear"] == pytest.approx((1 / 0.8 - 1) * outer * turned, rel=1e-12)
        assert shares.stored == pytest.approx(shares.put_in["motor"] - sum(shares.lost.values()), rel=1e-12)

    def test_of_a_motion_that_ends_as_it_began(self) -> None:
        """Thrown up and caught: nothing is stored or put in on the whole, and rounding is no residual of 1."""
        train = Train((Body("m", 1.0, 0.0, 2.0),), drives=(Drive.of("weight", 0, Signal.constant(-8.0)),))
        found = run(train, 0.5)
        assert found.ledger.residual < 1e-14
        assert found.last("speed") == pytest.approx(-2.0, rel=1e-14)

    def test_of_a_damper(self) -> None:
        train = Train((Body("m", 1.0, 0.0, 1.0),), springs=(Spring("s", 0, None, 25.0, 1.0),))
        found = run(train, 30.0)
        assert found.ledger.lost["s"] == pytest.approx(0.5 * (1 - math.exp(-30.0)), rel=1e-9)


@pytest.mark.parametrize("seed", range(30))
def test_links_begin_with_the_extension_of_their_bodies(seed: int) -> None:
    """x = x_1 - x_2 - rest and its rate, whether a link is a coordinate or closes a loop of others."""
    rng = np.random.default_rng(seed)
    speeds, places = rng.normal(size=(2, 4))
    chosen = tuple(Body(f"b{k}", float(k + 1), float(places[k]), float(speeds[k])) for k in range(4))
    pairs = [(0, 1), (1, 2), (2, 0), (2, 3), (3, 1), (3, None), (0, None)]
    order = rng.permutation(len(pairs))[: rng.integers(3, 8)].tolist()
    springs = tuple(
        Spring(f"s{k}", pairs[k][0], pairs[k][1], 10.0 + k, rest=float(rng.normal())) for k in order
    )  # fmt: skip
    system = TrainSystem(Train(chosen, springs=springs))
    _, z = system.start()
    for spring, stretch in zip(springs, system.stretches, strict=True):
        other = (0.0, 0.0) if spring.second is None else (places[spring.second], speeds[spring.second])
        assert stretch.x @ z == pytest.approx(places[spring.first] - other[0] - spring.rest, abs=1e-13)
        assert stretch.rate @ z == pytest.approx(speeds[spring.first] - other[1], abs=1e-13)
    for body, (place, speed) in enumerate(zip(places, speeds, strict=True)):
        assert system.seen(z, body) == pytest.approx((speed, place), abs=1e-13)
