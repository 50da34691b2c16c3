"""States of a mast over its base: sizes, blows, words, and that no unit of measure and no far thing changes a run."""

import math

import numpy as np
import pytest

from ptmcalc.numerics.mast.base import Base, Grip, Guide, Obstacle, Signal
from ptmcalc.numerics.mast.case import MOVED, Case, State
from ptmcalc.numerics.mast.modes import Mast
from ptmcalc.numerics.mast.parts import Column, Lump, Prop, Segment
from ptmcalc.numerics.mast.run import Course, play
from ptmcalc.numerics.mast.system import MastSystem

LENGTH, BENDING, ROLLS = 6.0, 600e3 * 72, 4000.0


def mast_of(mass: float = 1.0, length: float = 1.0, time: float = 1.0) -> Mast:
    """A column with a load at its head and one below, in units of one's own."""
    force = mass * length / time**2
    return Mast.of(
        Column(
            (Segment(LENGTH * length, BENDING * force * length**2, 200.0 * mass / length),),
            (Lump(LENGTH * length, 1800.0 * mass), Lump(2.0 * length, 300.0 * mass, 90.0 * mass * length**2)),
            props=(Prop(4.0 * length, 2e4 * force / length),),
        ),
        3,
    )


def braked(speed: float = 1.0, capacity: float = 9e3, **more: Signal) -> Base:
    return Base(ROLLS, speed, grips=(Grip("brake", Signal.constant(capacity)),), **more)


# -- sizes ------------------------------------------------------------------------------------------------------------

FORCES = {
    "speed": (Base(ROLLS, -3.0, grips=(Grip("brake", Signal.constant(900.0)),)), 3.0, 0.0),
    "speed of a grip": (Base(ROLLS, 0.5, grips=(Grip("drive", Signal.constant(900.0), 2.0),)), 2.0, 0.0),
    "push": (Base(ROLLS, 1e-3, Signal.constant(-9e5)), 0.0, 9e5),
    "capacity": (Base(ROLLS, 1e-3, grips=(Grip("brake", Signal.constant(8e5)),)), 0.0, 8e5),
    "rise": (Base(ROLLS, 1e-3, Signal((0.0, 0.5, 2.0), (0.0, 1.0, 0.0), (0.0, -5e5, 0.0))), 0.0, 7.5e5),
    "path": (Base(ROLLS, 1e-3, path=Signal((0.0, 2.0), (-70.0, 0.0), (0.0, 0.0))), 0.0, 70.0),
}  # fmt: skip


@pytest.mark.parametrize("name", FORCES)
def test_sizes_are_those_of_the_motion_that_speed_and_forces_excite(name: str) -> None:
    """The largest speed there is, or of the slowest mode under the largest force on all that rolls, F/(m w)."""
    base, speed, force = FORCES[name]
    column = Column((Segment(LENGTH, BENDING),), (Lump(LENGTH, 1800.0), Lump(2.0, 300.0), Lump(4.0, 1e-6)))
    mast = Mast.of(column, 3)
    system = MastSystem(Case(mast, np.zeros(len(mast.frequencies)), base, (LENGTH,)))
    w, taken = mast.frequencies, np.abs(mast.participation)
    total = ROLLS + 1800.0 + 300.0
    if force:
        speed = (force if name == "path" else force / total) / w[0]
    n = len(w)
    assert system.scale[:2] == pytest.approx([speed / w[0], speed], rel=1e-9)
    shares = np.maximum(taken, 1e-3 * taken.max())
    assert (taken < 1e-3 * taken.max()).any()
    assert system.scale[2 + n : 2 + 2 * n] == pytest.approx(shares * speed, rel=1e-9)
    assert system.scale[2 : 2 + n] == pytest.approx(shares * speed / w, rel=1e-9)
    assert system.scale[2 + 2 * n :] == pytest.approx([1.0, 1 / w[0]], rel=1e-9)


def test_where_nothing_moves_a_speed_of_one_is_the_size() -> None:
    mast = mast_of()
    assert MastSystem(Case(mast, np.zeros(1), Base(ROLLS), (LENGTH,))).scale[1] == 1.0


# -- units ------------------------------------------------------------------------------------------------------------


def run(mass: float, length: float, time: float, hard: bool) -> Course:
    """One run against an obstacle without damping, in units of so many kilograms, metres and seconds."""
    force, speed = mass * length / time**2, length / time
    obstacle = Obstacle(LENGTH * length, math.inf if hard else 3e5 * force / length, 0.05 * length)
    capacity = Signal((0.0, 0.2 * time), (0.0, 9e3 * force), (4.5e4 * force / time, 0.0))
    base = Base(ROLLS * mass, speed, grips=(Grip("brake", capacity),))
    case = Case(mast_of(mass, length, time), np.full(4, 0.02), base, (LENGTH * length,), obstacle)
    return play(case, 1.2 * time)


@pytest.mark.parametrize("hard", [False, True])
def test_no_unit_of_measure_changes_a_blow(hard: bool) -> None:
    """The same machine in numbers that are all below one or all above; `test_units` has the other contacts."""
    one = run(1.0, 1.0, 1.0, hard)
    for mass, length, time in ((1e-7, 1e-3, 1e-2), (3e3, 7e2, 11.0)):
        force, speed = mass * length / time**2, length / time
        other = run(mass, length, time, hard)
        for name, unit in {"deflection": length, "moment": force * length, "contact": force, "speed": speed}.items():
            for mine, theirs in ((one.top(name), other.top(name)), (one.bottom(name), other.bottom(name))):
                assert theirs[0] / unit == pytest.approx(mine[0], rel=1e-6, abs=1e-9 * abs(one.largest(name)[0]))
        mine, theirs = ([(e.element, e.before, e.after) for e in course.record.events] for course in (one, other))
        assert mine == theirs
        assert len(mine) >= 3
        assert other.record.lost / (force * length) == pytest.approx(one.record.lost, rel=1e-6, abs=1e-9)
        assert max(one.residual, other.residual) < 1e-8


@pytest.mark.parametrize("obstacle", [(1e6, 0.0), (1e6, 3e3), (math.inf, 0.0)])
def test_an_obstacle_that_is_never_reached_changes_nothing(obstacle: tuple[float, float]) -> None:
    stiff, damping = obstacle
    mast = mast_of()
    free, far = (
        play(Case(mast, np.full(4, 0.02), braked(), (LENGTH,), one), 1.2)
        for one in (None, Obstacle(LENGTH, stiff, 50.0, damping))
    )
    for name in ("deflection", "moment", "speed"):
        assert far.top(name)[0] == pytest.approx(free.top(name)[0], rel=1e-10)
        assert far.bottom(name)[0] == pytest.approx(free.bottom(name)[0], rel=1e-10)
    assert far.record.lost == 0.0
    assert [event.after for event in far.record.events] == [event.after for event in free.record.events]


# -- a point that stops dead ------------------------------------------------------------------------------------------


def blow(path: bool) -> tuple[MastSystem, np.ndarray, np.ndarray]:
    """A system before a blow, its state, and the point as a row over speeds of base and modes."""
    mast = mast_of()
    signal = Signal((0.0, 9.0), (0.5, 0.0), (0.0, 0.0)) if path else None
    case = Case(mast, np.zeros(5), braked(path=signal), (LENGTH,), Obstacle(LENGTH, math.inf, 0.05))
    system = MastSystem(case)
    z = system.start()[1]
    z[: system.own] = np.random.default_rng(5).normal(size=system.own) * 0.3
    z[1] = 1.3
    row = np.append(1.0, mast.at(LENGTH)[:5])
    if row @ np.append(z[1], z[7:12]) < 0:
        z[1], z[7:12] = -z[1], -z[7:12]
    return system, z, row


@pytest.mark.parametrize("path", [False, True])
def test_a_blow_takes_the_speed_of_the_point_and_the_energy_that_goes_with_it(path: bool) -> None:
    """Speeds projected by their masses: M v' = M v - c i with c v' = 0, which takes (c v)^2/(2 c M^-1 c).

    A base that is moved is as heavy as one likes: it keeps its speed.
    """
    system, z, row = blow(path)
    n = system.count
    mass = np.eye(n + 1)
    mass[0, 0], mass[0, 1:], mass[1:, 0] = system.total, system.shares, system.shares
    inverse = np.linalg.inv(mass)
    if path:
        inverse = np.diag(np.append(0.0, np.ones(n)))
    before = np.append(z[1], z[2 + n : 2 + 2 * n])
    spread = inverse @ row
    after = before - spread * float(row @ before) / float(row @ spread)
    gone = float(before @ mass @ before - after @ mass @ after) / 2
    lost = system._strike(State(0), z)
    assert np.append(z[1], z[2 + n : 2 + 2 * n]) == pytest.approx(after, rel=1e-9, abs=1e-12)
    assert lost == pytest.approx(gone, rel=1e-9)
    assert gone > 0 or path


def test_a_blow_is_a_point_at_the_obstacle_that_moves_into_it() -> None:
    """To rounding of the sizes of way and speed; of the point, which goes with base and modes."""
    system, z, row = blow(False)
    n = system.count
    way, speed = 1e-12 * system.scale[:2]
    for off, fast, meets in (
        (0.0, 0.3, True), (0.02, 0.3, True), (-0.02, 0.3, False), (0.0, -0.3, False),
        (-0.9 * way, 0.3, True), (-1.1 * way, 0.3, False), (0.01, 1.1 * speed, True), (0.01, 0.9 * speed, False),
    ):  # fmt: skip
        z[2 : 2 + n] *= -1.0  # unlike swings
        z[0] = 0.05 + off - row[1:] @ z[2 : 2 + n]
        z[1] = fast - row[1:] @ z[2 + n : 2 + 2 * n]
        assert system._meets(z) is meets, (off, fast)


def test_a_point_that_has_stood_still_is_where_it_was() -> None:
    """Whatever rounding did to it, at the obstacle and at rest, by the least change of the modes."""
    system, z, row = blow(False)
    n, base = system.count, z[:2].copy()
    before = z.copy()
    system._stand_still(z)
    assert z[:2].tolist() == base.tolist()
    assert z[0] + float(row[1:] @ z[2 : 2 + n]) == pytest.approx(0.05, abs=1e-12)
    assert z[1] + float(row[1:] @ z[2 + n : 2 + 2 * n]) == pytest.approx(0.0, abs=1e-12)
    for part in (slice(2, 2 + n), slice(2 + n, 2 + 2 * n)):
        change = z[part] - before[part]
        assert np.abs(change) == pytest.approx(np.abs(row[1:]) * np.linalg.norm(change) / np.linalg.norm(row[1:]))


# -- forces at rest ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("modes", [1, 3])
@pytest.mark.parametrize("at", [2.0, 4.0, LENGTH])
def test_a_guide_bends_the_column_by_its_whole_flexibility(modes: int, at: float) -> None:
    """However few modes are followed: those at the rest they have under its force, the others at once. A clamped bar
    under F at a, F x^2 (3 a - x)/(6 E I) below it and F a^2 (3 x - a)/(6 E I) above; F is what the spring says of its
    own place."""
    guide, places = Guide(at, 3e5, 0.01), (1.0, 2.0, 3.0, 4.0, LENGTH)
    mast = Mast.of(Column((Segment(LENGTH, BENDING, 200.0),), (Lump(LENGTH, 1800.0),)), 6)
    still = Base(ROLLS, path=Signal.constant(0.0))
    system = MastSystem(Case(mast, np.zeros(modes), still, places, guide=guide))
    force = guide.stiffness * guide.gap / (1 + guide.stiffness * at**3 / (3 * BENDING))
    z = system.start()[1]
    z[2 : 2 + modes] = mast.at(at)[:modes] * force / mast.frequencies[:modes] ** 2
    seen = system.motion(State(MOVED, guide=1)).watch @ z
    assert seen[system.watched["guide", 0]] == pytest.approx(force, rel=1e-9)
    for i, x in enumerate(places):
        low, high = sorted((x, at))
        bent = force * low**2 * (3 * high - low) / (6 * BENDING)
        assert seen[system.watched["deflection", i]] == pytest.approx(bent, rel=1e-9)


@pytest.mark.parametrize("modes", [1, 3])
def test_a_base_that_is_moved_evenly_bends_the_column_by_its_whole_flexibility(modes: int) -> None:
    """A bar under a line load -rho a with -m a at its head: w x^2 (6 L^2 - 4 L x + x^2)/(24 E I) and
    P x^2 (3 L - x)/(6 E I). The root carries rho a L^2/2 + m a L."""
    speeds_up, line, head, places = 0.7, 200.0, 1800.0, (1.0, 2.0, 3.0, 4.0, LENGTH)
    mast = Mast.of(Column((Segment(LENGTH, BENDING, line),), (Lump(LENGTH, head),)), 6)
    moved = Base(ROLLS, path=Signal.constant(speeds_up))
    system = MastSystem(Case(mast, np.zeros(modes), moved, places))
    state, z = system.start()
    z[2 : 2 + modes] = -system.shares * speeds_up / mast.frequencies[:modes] ** 2
    seen = system.motion(state).watch @ z
    for i, x in enumerate(places):
        bent = -speeds_up * x**2 * (
            line * (6 * LENGTH**2 - 4 * LENGTH * x + x**2) / 24 + head * (3 * LENGTH - x) / 6
        ) / BENDING  # fmt: skip
        assert seen[system.watched["deflection", i]] == pytest.approx(bent, rel=1e-9)
    root = speeds_up * (line * LENGTH**2 / 2 + head * LENGTH)
    assert abs(seen[system.watched["moment", 0]]) == pytest.approx(root, rel=1e-9)


# -- what is told -----------------------------------------------------------------------------------------------------


def test_of_three_grips_each_is_told_by_its_own_speed() -> None:
    """Pushed through -1, 0 and 1 m/s by a force that grows: held at each until its grip is too weak."""
    grips = tuple(Grip(f"{speed}", Signal.constant(1e3 + 500.0 * speed), speed) for speed in (-1.0, 0.0, 1.0))
    base = Base(ROLLS, -1.5, Signal((0.0,), (-3e3,), (100.0,)), grips)  # at first as much as they pull together
    mast = mast_of()
    course = play(Case(mast, np.full(2, 0.5), base, (LENGTH,)), 64.0)
    words = [event.after for event in course.record.events if event.element == "base"]
    assert words == ["at speed", "slips", "at rest", "slips", "at speed", "slips"]
    names = {("grip", j): course.system.watched["grip", j] for j in range(3)}
    assert len(names) == 3
    for j, size in enumerate((500.0, 1e3, 1.5e3)):
        assert course.top("grip", j)[0] == pytest.approx(size, rel=1e-6)
        assert course.bottom("grip", j)[0] == pytest.approx(-size, rel=1e-6)
    assert course.residual < 1e-9


def test_a_base_on_its_way_is_told_by_nothing_before_it_comes_to_rest() -> None:
    course = play(Case(mast_of(), np.full(4, 0.02), braked(), (LENGTH,)), 0.1)
    assert course.record.events == []
    assert course.record.mode == State(2)
    assert course.system.start()[0] == State(2, "free", 0, 0)
