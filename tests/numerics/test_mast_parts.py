"""Parts of a mast in closed form: matrices, nodes, signals, bounds of what is left out, when it stays."""

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.linalg import eigh
from support.mast_fem import beam

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.mast import elements as elementary
from ptmcalc.numerics.mast.assumed import one_shape
from ptmcalc.numerics.mast.base import Base, Grip, Guide, Obstacle, Signal
from ptmcalc.numerics.mast.case import Case
from ptmcalc.numerics.mast.elements import elements
from ptmcalc.numerics.mast.modes import Mast, frequencies, left_out, moment_left_out, speed_left_out, wanted
from ptmcalc.numerics.mast.parts import Column, Lump, Prop, Segment
from ptmcalc.numerics.mast.run import Course, play, ring_of, settled
from ptmcalc.numerics.mast.system import MastSystem

EPS = float(np.finfo(float).eps)


# -- elements ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("length", [0.3, 1.0, 7.0])
def test_matrices_of_an_element_are_the_integrals_of_its_shapes(length: float) -> None:
    bent, massed = beam(length, 1.0, 1.0, lambda x: 0.0)
    pulled, _ = beam(length, 0.0, 1.0, lambda x: 3.0 + 2.0 * (length - x))
    for mine, other in (
        (elementary._bent(length), bent),
        (elementary._massed(length), massed),
        (elementary._pulled(length, 3.0, 2.0), pulled),
    ):
        assert mine == pytest.approx(other, rel=1e-12, abs=1e-13 * float(np.abs(other).max()))


def test_a_column_that_turns_as_a_rigid_body() -> None:
    """int z dm, int z^2 dm, and what weights and props do against the turn: pull int (mass beyond z) dz + sum k z^2."""
    column = Column(
        (Segment(2.0, 5e5, 30.0), Segment(1.5, 4e5, 20.0)),
        (Lump(2.0, 40.0, 3.0), Lump(3.5, 70.0, 5.0)),
        root_rotation=6e5, root_translation=8e5, root_mass=11.0, root_inertia=13.0, pull=9.81,
        props=(Prop(1.0, 700.0), Prop(3.5, 500.0)),
    )  # fmt: skip
    built = elements(column, 7)
    z = np.linspace(0.0, 3.5, 350_001)
    density = np.where(z < 2.0, 30.0, 20.0)
    total = 60.0 + 30.0 + 40.0 + 70.0 + 11.0
    first = float(np.trapezoid(density * z, z)) + 40.0 * 2.0 + 70.0 * 3.5
    second = float(np.trapezoid(density * z**2, z)) + 40.0 * 4.0 + 70.0 * 3.5**2 + 3.0 + 5.0 + 13.0
    righted = 9.81 * (first - 0.0) + 700.0 * 1.0 + 500.0 * 3.5**2  # int_0^l (mass beyond z) dz = int z dm
    assert built.total == pytest.approx(total, rel=1e-12)
    assert built.moment == pytest.approx(first, rel=1e-5)
    assert built.carried[:2] == pytest.approx([total, first], rel=1e-5)
    assert built.turned[:2] == pytest.approx([first, second], rel=1e-5)
    props = 700.0 * 1.0 + 500.0 * 3.5
    assert built.righted[:2] == pytest.approx([props, righted], rel=1e-5)
    assert built.mass[:2, :2] == pytest.approx(np.array([[total, first], [first, second]]), rel=1e-5)
    assert built.stiffness[:2, :2] == pytest.approx(
        np.array([[8e5 + 1200.0, props], [props, 6e5 + righted]]), rel=1e-5
    )  # fmt: skip
    assert built.stiffness == pytest.approx(built.stiffness.T, rel=1e-12)
    assert built.mass == pytest.approx(built.mass.T, rel=1e-12)
    for place in (0.0, 1.0, 2.0, 3.5):
        assert built.row(place)[:2].tolist() == [1.0, place]


def test_a_root_with_inertia_on_a_spring() -> None:
    """w^2 = k_t/(J + m l^2/3) of a rigid column."""
    column = Column((Segment(2.0, 1e14, 3.0),), root_rotation=900.0, root_inertia=5.0)
    assert Mast.of(column, 4).frequencies[0] == pytest.approx(math.sqrt(900.0 / (5.0 + 6.0 * 4.0 / 3)), rel=1e-6)


def test_a_stepped_column_gives_as_its_parts_do() -> None:
    """int (l - z)^2/(E I) dz at the far end, by three stretches of unlike stiffness and mass."""
    segments = Segment(1.0, 8e5, 90.0), Segment(0.5, 3e5, 40.0), Segment(1.5, 1e5, 10.0)
    mast = Mast.of(Column(segments), 6)
    ends, gives = np.cumsum([0.0, *(segment.length for segment in segments)]), 0.0
    for segment, (low, high) in zip(segments, pairwise(ends), strict=True):
        gives += ((3.0 - low) ** 3 - (3.0 - high) ** 3) / 3 / segment.bending
    assert mast.gives(3.0, 3.0) == pytest.approx(gives, rel=1e-10)
    assert mast.elements.total == pytest.approx(90.0 + 20.0 + 15.0, rel=1e-12)
    moment = sum(s.mass * (high**2 - low**2) / 2 for s, (low, high) in zip(segments, pairwise(ends), strict=True))
    assert mast.elements.moment == pytest.approx(moment, rel=1e-12)


class TestNodes:
    def test_as_many_elements_as_asked_for_and_no_more(self) -> None:
        tenths = Column(tuple(Segment(0.1, 1.0, 1.0) for _ in range(7)))
        assert len(elements(tenths, 7).places) == 8
        assert len(elements(tenths, 1).places) == 8
        assert len(elements(Column((Segment(2.0, 1.0, 1.0),)), 4).places) == 5

    def test_wherever_something_is_and_between_at_even_distances(self) -> None:
        places = elements(Column((Segment(2.0, 1.0, 1.0),), (Lump(0.3, 1.0),)), 4, (1.0,)).places
        assert places == pytest.approx([0.0, 0.3, 0.65, 1.0, 1.5, 2.0])

    @pytest.mark.parametrize("length", [1e3, 1e-3])
    def test_places_a_billionth_apart_are_one_and_a_millionth_are_two(self, length: float) -> None:
        column = Column((Segment(length, 1.0, 1.0),), (Lump(length / 2, 1.0),))
        one = elements(column, 2, (length / 2 * (1 + 1e-10), length * (1 + 1e-10)))
        assert len(one.places) == 3
        assert one.node(length / 2 * (1 - 1e-10)) == 1
        two = elements(column, 2, (length / 2 * (1 + 1e-6),))
        assert len(two.places) == 4
        with pytest.raises(NumericsError, match="no node"):
            one.node(length / 2 * (1 + 1e-6))

    def test_nothing_is_beyond_the_column(self) -> None:
        column = Column((Segment(2.0, 1.0, 1.0),))
        for place in (2.00001, 3.0):
            with pytest.raises(NumericsError, match="beyond"):
                elements(column, 2, (place,))


def test_a_light_mass_beside_a_heavy_one_still_vibrates() -> None:
    """A billionth of the mass at the tip, halfway: it vibrates against a tip that all but rests, 7 l^3/(768 E I)."""
    column = Column((Segment(1.0, 1.0),), (Lump(0.5, 1e-9), Lump(1.0, 1.0)))
    found = Mast.of(column, 4).frequencies
    assert found == pytest.approx([math.sqrt(3.0), math.sqrt(768 / 7 / 1e-9)], rel=1e-4)


def test_what_nothing_is_told_of_is_not_there() -> None:
    column = Column((Segment(1.0, 1.0),), (Lump(1.0, 2.0),))
    assert (column.segments[0].mass, column.lumps[0].inertia) == (0.0, 0.0)
    assert (column.root_mass, column.root_inertia, column.pull) == (0.0, 0.0, 0.0)
    assert Obstacle(1.0, 2.0) == Obstacle(1.0, 2.0, 0.0, 0.0)
    assert Base(1.0).speed == Grip("brake", Signal.constant(1.0)).speed == 0.0
    assert Base(1.0).breaks == (0.0,)
    assert [Base(1.0).push.now(time) for time in (0.0, 7.0)] == [(0.0, 0.0), (0.0, 0.0)]


@pytest.mark.parametrize("share", [0.25, 0.75])
def test_sizes_below_one_are_sizes(share: float) -> None:
    Column((Segment(share, share, share),), (Lump(share / 2, share, share),), share, share, share, share)
    with pytest.raises(NumericsError, match="on the mast"):
        Column((Segment(share, 1.0),), (Lump(share * (1 + 1e-9), 1.0),))
    with pytest.raises(NumericsError, match="on the mast"):
        Column((Segment(share, 1.0),), (Lump(-1e-9, 1.0),))


# -- signals ----------------------------------------------------------------------------------------------------------


def test_a_signal_that_rises() -> None:
    late = Signal.rising(9e3, 0.1, 0.25)
    for time, value, slope in ((0.0, 0.0, 0.0), (0.05, 0.0, 0.0), (0.1, 0.0, 36e3), (0.2, 3600.0, 36e3),
                               (0.35, 9e3, 0.0), (5.0, 9e3, 0.0)):  # fmt: skip
        assert late.now(time) == pytest.approx((value, slope))
    assert late.times == pytest.approx((0.0, 0.1, 0.35))
    assert Signal.rising(9e3).times == Signal.constant(9e3).times == (0.0,)
    assert Signal.rising(9e3).now(0.0) == Signal.constant(9e3).now(4.0) == (9e3, 0.0)
    assert Signal.rising(9e3, 0.0, 0.5).times == (0.0, 0.5)
    assert Signal.rising(9e3, 0.5).times == (0.0, 0.5)
    assert Signal.rising(9e3, 0.5).now(0.4) == (0.0, 0.0)


def test_grips_go_by_rising_speed() -> None:
    grips = tuple(Grip(f"{speed}", Signal.constant(1.0), speed) for speed in (-1.0, 0.0, 2.0))
    assert Base(1.0, grips=grips).grips == grips
    with pytest.raises(NumericsError, match="rising speed"):
        Base(1.0, grips=grips[::-1])
    for mass in (0.0, -1.0, math.inf, math.nan):
        with pytest.raises(NumericsError, match="mass above 0"):
            Base(mass)


# -- modes left out ---------------------------------------------------------------------------------------------------

BASE, PLACES, MASSES, EI, PROP = 40.0, (1.2, 2.0), (9.0, 5.0), 3e4, 2e4


def two_lumps() -> Mast:
    """A column without mass, two lumps, a prop at the lower one."""
    return Mast.of(
        Column((Segment(2.0, EI),), tuple(Lump(*one) for one in zip(PLACES, MASSES, strict=True)),
               props=(Prop(PLACES[0], PROP),)), 5
    )  # fmt: skip


def stiffness() -> np.ndarray:
    """Of both lumps beside the base: the inverse of a cantilever's a^2 (3 b - a)/(6 E I), and the prop."""
    gives = np.zeros((2, 2))
    for i, one in enumerate(PLACES):
        for j, other in enumerate(PLACES):
            near, far = min(one, other), max(one, other)
            gives[i, j] = near**2 * (3 * far - near) / (6 * EI)
    return np.asarray(np.linalg.inv(gives) + np.diag([PROP, 0.0]))


def rolling() -> tuple[np.ndarray, np.ndarray]:
    """Frequencies and shapes (base, lower, upper lump; unit modal mass) of all that rolls, free travel left out."""
    beside = np.array([[-1.0, 1.0, 0.0], [-1.0, 0.0, 1.0]])
    squares, shapes = eigh(beside.T @ stiffness() @ beside, np.diag([BASE, *MASSES]))
    return np.sqrt(squares[1:]), shapes[:, 1:]


@pytest.mark.parametrize("kept", [0, 1, 2])
@pytest.mark.parametrize("rise", [0.0, 0.01, 0.2])
def test_what_modes_over_a_rolling_base_stray_by(kept: int, rise: float) -> None:
    """A force F that comes at once makes x_k = p_k p_k(base) F (1 - cos w t)/w^2: shares of tip, speed and moment."""
    force, mast = 700.0, two_lumps()
    w, p = rolling()
    share = np.minimum(1.0, 2 / (w * rise)) if rise else np.ones(2)
    beside = p[1:] - p[0]
    tip, speed = np.abs(beside[1] * p[0]) / w**2, p[0] ** 2 / w
    moment = np.abs(sum(m * z * one for m, z, one in zip(MASSES, PLACES, p[1:], strict=True))
                    - PROP * PLACES[0] * beside[0] / w**2) * np.abs(p[0])  # fmt: skip
    for found, parts in (
        (left_out(mast, BASE, 2.0, kept, rise, -force), tip),
        (speed_left_out(mast, BASE, kept, rise, -force), speed),
        (moment_left_out(mast, BASE, kept, rise, -force), moment),
    ):
        assert found == pytest.approx(force * float((parts * share)[kept:].sum()), rel=1e-9)


@pytest.mark.parametrize("rise", [0.0, 0.03])
def test_what_modes_over_a_held_base_stray_by(rise: float) -> None:
    """An acceleration a of the base: q_k = -p_k L_k a (1 - cos w t)/w^2."""
    mast, pace = two_lumps(), 1.7
    squares, p = eigh(stiffness(), np.diag(MASSES))
    w, taken = np.sqrt(squares), np.array(MASSES) @ p
    share = np.minimum(1.0, 2 / (w * rise)) if rise else np.ones(2)
    tip = np.abs(p[1] * taken) / w**2
    moment = np.abs((np.array(MASSES) * PLACES) @ p - PROP * PLACES[0] * p[0] / w**2) * np.abs(taken)
    assert left_out(mast, math.inf, 2.0, 0, rise, pace) == pytest.approx(pace * float(tip @ share), rel=1e-9)
    assert moment_left_out(mast, math.inf, 0, rise, pace) == pytest.approx(pace * float(moment @ share), rel=1e-9)
    assert left_out(mast, math.inf, 2.0, 1, rise, pace) == pytest.approx(pace * tip[1] * share[1], rel=1e-9)


def test_modes_up_to_five_over_the_rise_in_hertz() -> None:
    rise = 0.4
    edge = 2 * math.pi * 5 / rise
    assert wanted(edge * np.array([0.1, 0.2, 0.5, 0.999, 1.001, 3.0]), rise) == 4
    assert wanted(edge * np.array([0.1, 3.0, 5.0]), rise) == 2
    assert wanted(edge * np.array([3.0]), rise) == 1


def test_the_bar_of_a_frequency_is_what_half_as_many_elements_change() -> None:
    """And rounding by the fourth power of their number, at every place it may be asked."""
    column = Column((Segment(1.0, 1.0, 1.0),), (Lump(1.0, 0.3),))
    fine, coarse = (Mast.of(column, count).frequencies[:4] for count in (32, 16))
    found = frequencies(column, 4)
    assert found.values.tolist() == fine.tolist()
    assert found.bars == pytest.approx(coarse - fine + 4 * EPS * 32**4 * fine, rel=1e-6)
    assert len(frequencies(column, 99, count=2).values) == 4


# -- one shape --------------------------------------------------------------------------------------------------------


def test_a_column_that_keeps_to_one_shape() -> None:
    """Stiffness k and mass int f^2 dm: one frequency, and every place moves as the shape says."""
    mast = one_shape(
        Column((Segment(2.0, 1.0),), (Lump(2.0, 3.0),)), lambda z: (z / 2.0) ** 2, 50.0, (8.0, 10.0), 20.0,
        (16.0, 12.0, 7.0),
    )  # fmt: skip
    assert mast.frequencies == pytest.approx([2.5], rel=1e-12)
    assert mast.gives(2.0, 1.0) == pytest.approx(0.25 / 50.0, rel=1e-12)
    assert mast.rolling(30.0)[0] == pytest.approx([math.sqrt(50.0 / (8.0 - 100.0 / 50.0))], rel=1e-12)
    assert mast.at(0.0).tolist() == [0.0]
    built = mast.elements
    assert (built.total, built.moment, built.turned.tolist(), built.righted.tolist()) == (20.0, 16.0, [12.0], [7.0])


# -- a run and what is read of it -------------------------------------------------------------------------------------

STIFFNESS, LENGTH, LOAD, ROLLS = 600e3, 6.0, 1800.0, 4000.0
PACE = math.sqrt(STIFFNESS / LOAD)


def light(base: Base, ratio: float = 0.0, **more: Obstacle | Guide) -> Case:
    """A load on a column without mass: one mode."""
    column = Column((Segment(LENGTH, STIFFNESS * LENGTH**3 / 3),), (Lump(LENGTH, LOAD),))
    return Case(Mast.of(column, 2), np.full(1, ratio), base, (LENGTH,), **more)


def braked(force: float = 9e3, speed: float = 1.0, push: float = 0.0, later: Signal | None = None) -> Base:
    capacity = Signal.constant(force) if later is None else later
    return Base(ROLLS, speed, Signal.constant(push), (Grip("brake", capacity),))


def swing_of(course: Course) -> float:
    """Size of the swing of a held base without damping."""
    system, z = course.system, course.record.state
    q, v = float(z[2]), float(z[2 + system.count])
    return math.hypot(q, v / PACE) * float(abs(course.case.mast.at(LENGTH)[0]))


class TestLargest:
    def test_is_the_larger_of_both_sides_with_its_time(self) -> None:
        for sign in (1.0, -1.0):
            grips = (Grip("brake", Signal.constant(9e3)),)
            course = play(light(Base(ROLLS, sign, grips=grips), 0.05), 0.9)
            high, low = course.top("deflection"), course.bottom("deflection")
            assert high[0] > 0 > low[0]
            assert course.largest("deflection") == ((high[0], high[1]) if sign > 0 else (-low[0], low[1]))
            assert course.largest("deflection")[0] == pytest.approx(max(high[0], -low[0]), rel=1e-12)


class TestHeld:
    def test_by_the_second_of_two_grips(self) -> None:
        grips = (Grip("rolling", Signal.constant(500.0)), Grip("drive", Signal.constant(9e3), 1.0))
        base = Base(ROLLS, 0.0, grips=grips)
        slipping, held = play(light(base), 0.2), play(light(base), 2.0)
        assert slipping.held_since == math.inf
        assert held.held_since == held.first("base", "at speed") < 2.0
        assert not slipping.stays
        assert held.stays

    def test_by_a_path_from_its_end_on(self) -> None:
        base = Base(1.0, 1.0, path=Signal((0.0, 0.8), (-1.25, 0.0), (0.0, 0.0)))
        assert play(light(base), 0.79).held_since == math.inf
        assert not play(light(base), 0.79).stays
        assert play(light(base), 0.81).held_since == 0.8
        assert play(light(base), 0.81).stays

    @pytest.mark.parametrize(("more", "stays"), [(1.01, True), (0.99, False)])
    @pytest.mark.parametrize("push", [0.0, 1500.0, -1500.0])
    def test_for_good_if_the_brake_holds_push_and_swing(self, more: float, stays: bool, push: float) -> None:
        """|push| + c A, A the swing that is left; the brake is as weak as that long after the stop."""
        first = play(light(braked(push=push)), 2.0)
        since = first.held_since
        assert since < 1.5
        at_stop = play(light(braked(push=push)), since + 1e-9)
        needed = abs(push) + STIFFNESS * swing_of(at_stop)
        later = Signal((0.0, since + 1e-6), (9e3, more * needed), (0.0, 0.0))
        course = play(light(braked(push=push, later=later)), since + 2e-6)
        assert course.held_since == pytest.approx(since, rel=1e-9)
        assert course.stays is stays
        assert not play(light(braked(push=push, later=later)), since + 5e-7).stays  # before the last break

    @pytest.mark.parametrize(("share", "stays"), [(1.001, True), (0.999, False)])
    @pytest.mark.parametrize("ratio", [0.0, 0.03])
    def test_for_good_if_the_swing_meets_nothing(self, share: float, stays: bool, ratio: float) -> None:
        free = play(light(braked(), ratio), 2.0)
        end = free.held_since + 1e-9
        stopped = play(light(braked(), ratio), end)
        z = stopped.record.state
        room = ring_of(stopped.system, z, stopped.case.mast.at(LENGTH)[:1]).envelope(0.0)
        wall = Obstacle(LENGTH, 1e6, float(z[0]) + share * room)
        course = play(light(braked(), ratio, obstacle=wall), end)
        assert course.record.mode.contact == "free"
        assert course.stays is stays
        if share * room > free.largest("deflection")[0]:
            assert play(light(braked(), ratio, guide=Guide(LENGTH, 1e6, share * room)), end).stays is stays


def test_a_guide_that_is_touched_when_the_run_ends_may_wake_it() -> None:
    course = play(light(braked(), guide=Guide(LENGTH, 1e6, 1e-3)), 2.0)
    assert course.held_since < 2.0
    assert not course.stays


class TestBalance:
    def test_is_measured_by_the_fastest_motion_of_all_that_rolls(self, monkeypatch: pytest.MonkeyPatch) -> None:
        """A base that is moved from rest to rest: m v^2/2 at its fastest, of which a joule is missing."""
        pace, lasts = 0.5, 3 * 2 * math.pi / PACE  # whole periods: nothing swings on
        path = Signal((0.0, lasts, 2 * lasts), (pace, -pace, 0.0), (0.0, 0.0, 0.0))
        own = MastSystem.works

        def spoiled(self: MastSystem, integrals: np.ndarray) -> tuple[dict[str, float], float]:
            put, damped = own(self, integrals)
            return put, damped + 1.0

        case = light(Base(ROLLS, 0.0, path=path))
        assert play(case, 2.5 * lasts).residual < 1e-9
        monkeypatch.setattr(MastSystem, "works", spoiled)
        whole = (ROLLS + LOAD) * (pace * lasts) ** 2 / 2
        assert play(case, 2.5 * lasts).residual == pytest.approx(1 / whole, rel=1e-6)


class TestSettled:
    @pytest.mark.parametrize("window", [3e-3, 1.5e-3])
    def test_one_mode_is_let_go_at_the_stop(self, window: float) -> None:
        """From the state of the stop on a free swing, whose last time outside is told by dense looks."""
        ratio = 0.02
        course = play(light(braked(), ratio), 3.0)
        found = settled(course, LENGTH, window)
        z = play(light(braked(), ratio), course.held_since + 1e-9).record.state
        shape = float(course.case.mast.at(LENGTH)[0])
        q, v = float(z[2]) * shape, float(z[3]) * shape
        turning = PACE * math.sqrt(1 - ratio**2)
        t = np.linspace(0.0, 5.0, 1_000_001)
        x = np.exp(-ratio * PACE * t) * (
            q * np.cos(turning * t) + (v + ratio * PACE * q) / turning * np.sin(turning * t)
        )
        last = float(t[np.abs(x) > window][-1])
        assert found.time == pytest.approx(last, abs=1e-5)
        assert found.low <= last + 1e-5
        assert last <= found.high
        assert found.high - found.low < 1e-6

    def test_modes_left_out_widen_it_by_twice_what_the_stop_could_set_off(self) -> None:
        """One of two modes is followed; the other may stray by twice its share of the largest acceleration, whether it
        is fast or slow."""
        mast = two_lumps()
        base = Base(BASE, 1.0, grips=(Grip("brake", Signal.constant(120.0)),))
        case = Case(mast, np.full(1, 0.02), base, (2.0,))
        course = play(case, 4.0)
        squares, p = eigh(stiffness(), np.diag(MASSES))
        w = np.sqrt(squares)
        assert w[1] * 0.01 > 2  # fast enough to be left out, too slow to follow a stop at once
        stray = 2 * abs(p[1, 1] * (np.array(MASSES) @ p[:, 1])) / w[1] ** 2 * course.largest("acceleration")[0]
        z = play(case, course.held_since + 1e-9).record.state
        shape = float(mast.at(2.0)[0])
        q, v = float(z[2]) * shape, float(z[3]) * shape
        turning = w[0] * math.sqrt(1 - 0.02**2)
        t = np.linspace(0.0, 4.0, 1_000_001)
        x = np.exp(-0.02 * w[0] * t) * (q * np.cos(turning * t) + (v + 0.02 * w[0] * q) / turning * np.sin(turning * t))
        window = 12 * stray
        found = settled(course, 2.0, window)
        for told, edge in ((found.low, window + stray), (found.time, window), (found.high, window - stray)):
            assert told == pytest.approx(float(t[np.abs(x) > edge][-1]), abs=2e-5)
        wider = settled(course, 2.0, window, doubt=stray)
        assert wider.high == pytest.approx(float(t[np.abs(x) > window - 2 * stray][-1]), abs=2e-5)

    def test_after_a_guide_was_touched_not_before_the_run_ends_if_it_is_still_outside(self) -> None:
        """The stop sets it swinging into the guide; at its end it swings free and is looked at from there."""
        case = light(braked(), 0.02, guide=Guide(LENGTH, 1e6, 2e-3))
        course = play(case, 3.5)
        assert any(event.element == "guide" and event.time > course.held_since for event in course.record.events)
        passed = course.record.time - course.held_since
        late = settled(course, LENGTH, 1e-3)
        kept = play(case, 9.0, keep=True)
        times, tips = kept.over_time("deflection")
        last = times[np.abs(tips) > 1e-3].max() - kept.held_since
        assert passed < late.low <= late.time <= late.high
        assert late.time == pytest.approx(last, abs=0.02)
        done = settled(course, LENGTH, 1.9e-3)
        assert (done.low, done.time, done.high) == (0.0, passed, passed)
