"""The march of a mast against an integrator with events over elements of another hand, and against closed forms."""

import math

import numpy as np
import pytest
from support.mast_fem import Reference, Wall, run

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.mast.base import Base, Grip, Guide, Obstacle, Signal
from ptmcalc.numerics.mast.case import Case
from ptmcalc.numerics.mast.modes import Mast
from ptmcalc.numerics.mast.parts import Column, Lump, Prop, Segment
from ptmcalc.numerics.mast.run import Course, play, ring_of

STIFFNESS, LENGTH = 600e3, 6.0
BENDING = STIFFNESS * LENGTH**3 / 3


def case(
    base: Base,
    *,
    column: float = 1200.0,
    load: float = 1800.0,
    count: int = 4,
    modes: int = 99,
    ratio: float = 0.0,
    obstacle: Obstacle | None = None,
    guide: Guide | None = None,
    **parts: float,
) -> Case:
    mast = Mast.of(Column((Segment(LENGTH, BENDING, column / LENGTH),), (Lump(LENGTH, load),), **parts), count)
    kept = min(modes, len(mast.frequencies))
    return Case(mast, np.full(kept, ratio), base, (LENGTH,), obstacle, guide)


def braked(force: float, speed: float = 1.0, mass: float = 4000.0, **signal: float) -> Base:
    return Base(mass, speed, grips=(Grip("brake", Signal.rising(force, **signal)),))


def reference(**parts: float) -> Reference:
    values = {"base": 4000.0, "length": LENGTH, "bending": BENDING, "column": 1200.0, "load": 1800.0, "count": 4}
    return Reference(**(values | parts))  # type: ignore[arg-type]


def deflections(course: Course) -> tuple[float, float]:
    return course.top("deflection")[0], course.bottom("deflection")[0]


class TestBraking:
    @pytest.mark.parametrize("count", [8, 16])
    def test_c11(self, count: int) -> None:
        """The largest deflection of the mast in the worked case."""
        course = play(case(braked(9000.0), count=count, modes=6), 0.5)
        assert course.largest("deflection")[0] == pytest.approx(0.00964556, rel=2e-6)

    def test_c11_damped_as_two_masses(self) -> None:
        """Printed: 8.60536 mm while it slips, at rest after 0.778533 s, 7.52749 mm after that."""
        load = 2083.2
        one = case(
            braked(9000.0, 1.0, 4916.8), column=0.0, load=load, ratio=1414.73 / (2 * math.sqrt(STIFFNESS * load))
        )
        course = play(one, 1.5)
        assert course.largest("deflection")[0] == pytest.approx(0.00860536, rel=1e-6)
        assert course.held_since == pytest.approx(0.778533, rel=1e-6)
        stopped = play(one, course.held_since + 1e-9)
        ring = ring_of(stopped.system, stopped.record.state, one.mast.at(LENGTH)[:1])
        after = max(abs(ring.at(time)) for time in np.linspace(0.0, 0.4, 40_001))
        assert after == pytest.approx(0.00752749, rel=1e-5)

    @pytest.mark.parametrize(
        ("force", "ratio", "parts"),
        [
            (9000.0, 0.0, {}),
            (9000.0, 0.02, {}),
            (2.5e4, 0.01, {"pull": 9.81}),
            (4e4, 0.0, {"pull": -9.81, "turn": 2e7, "shift": 3e6, "root": 500.0}),
        ],
    )
    def test_against_the_reference(self, force: float, ratio: float, parts: dict[str, float]) -> None:
        """Braked, at rest, held, and the swing after it: the same elements, none left out."""
        names = {"turn": "root_rotation", "shift": "root_translation", "root": "root_mass"}
        mine = {names.get(name, name): value for name, value in parts.items()}
        course = play(case(braked(force), ratio=ratio, count=2, **mine), 1.1)
        other = run(reference(held_ratio=ratio, count=2, **parts), 1.0, lambda t: force, 1.1)
        high, low = deflections(course)
        assert (high, low) == pytest.approx((other.high, other.low), rel=2e-5)
        assert course.held_since == pytest.approx(other.stands, rel=1e-6)
        assert course.residual < 1e-11

    def test_a_brake_that_comes_up_slowly(self) -> None:
        def force(t: float) -> float:
            return float(np.clip((t - 0.1) / 0.25, 0, 1)) * 9000.0

        course = play(case(braked(9000.0, delay=0.1, rise=0.25), count=2), 1.3)
        other = run(reference(count=2), 1.0, force, 1.3, breaks=(0.1, 0.35))
        assert deflections(course) == pytest.approx((other.high, other.low), rel=2e-5)
        assert course.held_since == pytest.approx(other.stands, rel=1e-6)

    def test_a_brake_too_weak_to_hold_the_swing(self) -> None:
        """A heavy load on a light base pulls it through the brake again and again."""
        course = play(case(braked(3000.0, mass=300.0), load=3000.0, column=200.0, count=1), 2.0)
        other = run(reference(base=300.0, load=3000.0, column=200.0, count=1), 1.0, lambda t: 3000.0, 2.0)
        assert sum(event.element == "base" for event in course.record.events) > 2
        assert deflections(course) == pytest.approx((other.high, other.low), rel=2e-5)
        assert course.held_since == pytest.approx(other.stands, rel=1e-6)
        assert course.residual < 1e-11

    def test_held_by_a_ramp(self) -> None:
        """A base that follows a ramp: the swing of an undamped load is twice a/w^2, or less after a whole period."""
        load, slope = 1800.0, 1.25
        omega = math.sqrt(STIFFNESS / load)
        lasts = 3.5 * 2 * math.pi / omega
        base = Base(1.0, slope * lasts, path=Signal((0.0, lasts), (-slope, 0.0), (0.0, 0.0)))
        course = play(case(base, column=0.0, load=load), 2 * lasts)
        assert deflections(course) == pytest.approx((2 * slope / omega**2, -2 * slope / omega**2), rel=1e-7)
        assert course.record.state[1] == pytest.approx(0.0, abs=1e-12)
        assert course.held_since == lasts


class TestStart:
    def test_a_drive_keeps_its_speed(self) -> None:
        """Seen from what moves at full speed a start is a stop."""
        base = Base(4000.0, 0.0, grips=(Grip("drive", Signal.constant(9000.0), 1.0),))
        course = play(case(base, ratio=0.01, count=2), 1.1)
        other = run(reference(held_ratio=0.01, count=2), 0.0, lambda t: 9000.0, 1.1, wanted=1.0)
        high, low = deflections(course)
        assert (high, low) == pytest.approx((other.high, other.low), rel=2e-5)
        assert course.first("base", "at speed") == pytest.approx(other.stands, rel=1e-6)

    @pytest.mark.parametrize("force", [9000.0, 4000.0])
    def test_the_drive_that_holds_has_to_hold_what_swings(self, force: float) -> None:
        """The third of three, from 0.9 to 1 m/s; friction of the other two is far below what the swing asks for."""
        weak = (Grip("rolling", Signal.constant(10.0)), Grip("other", Signal.constant(10.0), 0.5))
        course = play(case(Base(4000.0, 0.9, grips=(*weak, Grip("drive", Signal.constant(force), 1.0))), ratio=0.02), 2)
        assert course.first("base", "at speed") == course.held_since > 0
        assert course.stays

    def test_rolling_friction_holds_what_pushes_too_little(self) -> None:
        grips = (Grip("rolling", Signal.constant(1000.0)), Grip("drive", Signal.rising(5000.0, rise=1.0), 1.0))
        course = play(case(Base(4000.0, 0.0, grips=grips)), 0.4)
        assert course.first("base", "slips") == pytest.approx(0.2, rel=1e-12)


class TestObstacle:
    """C12: 5000 kg below, 2100 kg at the tip of a column without mass, 0.8 m/s, 4000 N of friction."""

    def hit(self, obstacle: Obstacle, **more: float) -> Course:
        base = braked(4000.0, 0.8, 5000.0) if not more else Base(5000.0, 0.8, **more)  # type: ignore[arg-type]
        return play(case(base, column=0.0, load=2100.0, obstacle=obstacle), 0.3)

    def test_plastic_with_a_dashpot(self) -> None:
        """Printed 39 835 N: a critically damped contact of 50 c."""
        stiff = 50 * STIFFNESS
        course = self.hit(Obstacle(LENGTH, stiff, 0.0, 2 * math.sqrt(stiff * 2100)))
        assert -course.bottom("deflection")[0] * STIFFNESS == pytest.approx(39835.3, rel=2e-5)
        assert course.residual < 1e-10

    def test_elastic(self) -> None:
        """Printed 46 302.6 N of the column and 275 804 N of the contact of 50 c."""
        course = self.hit(Obstacle(LENGTH, 50 * STIFFNESS))
        assert -course.bottom("deflection")[0] * STIFFNESS == pytest.approx(46302.6, rel=2e-6)
        assert course.top("contact")[0] == pytest.approx(275804, rel=2e-6)
        assert course.residual < 1e-11

    def test_stopped_dead(self) -> None:
        """-W + (W^2 + c m_1 v^2)^(1/2) = 40 000 N; the energy of the tip is lost at once."""
        course = self.hit(Obstacle(LENGTH, math.inf))
        assert -course.bottom("deflection")[0] * STIFFNESS == pytest.approx(40000.0, rel=1e-9)
        assert course.record.lost == pytest.approx(2100 * 0.8**2 / 2, rel=1e-12)

    def test_without_friction_never_above_the_bound(self) -> None:
        """v (c (m_1 + m_2))^(1/2), whatever the contact is like."""
        bound = 0.8 * math.sqrt(STIFFNESS * 7100)
        for share in (0.01, 1.0, 3.0, 50.0, 1e4):
            course = play(
                case(Base(5000.0, 0.8), column=0.0, load=2100.0, obstacle=Obstacle(LENGTH, share * STIFFNESS)), 0.8
            )
            assert abs(course.largest("deflection")[0]) * STIFFNESS <= bound * (1 + 1e-12)

    @pytest.mark.parametrize("stiff", [50 * STIFFNESS, None])
    def test_a_column_with_mass_against_the_reference(self, stiff: float | None) -> None:
        """A point that stops dead is caught again and again: after some blows only damping keeps two runs together."""
        obstacle = Obstacle(LENGTH, math.inf if stiff is None else stiff, 0.05)
        one = case(braked(4000.0, 0.8, 5000.0), load=2100.0, obstacle=obstacle, count=2, ratio=0.03)
        other = reference(base=5000.0, load=2100.0, count=2, held_ratio=0.03)
        course = play(one, 0.45)
        found = run(other, 0.8, lambda t: 4000.0, 0.45, wall=Wall(stiff, 0.05))
        assert deflections(course) == pytest.approx((found.high, found.low), rel=3e-5)
        assert course.residual < 1e-10
        if stiff is not None:
            assert course.top("contact")[0] == pytest.approx(found.push, rel=1e-3)

    @pytest.mark.parametrize(
        ("count", "load", "ratio"), [(8, 2100.0, 0.01), (2, 0.0, 0.03), (8, 10.0, 0.01), (6, 0.0, 0.0)]
    )
    def test_blow_after_blow(self, count: int, load: float, ratio: float) -> None:
        """Many catches of a point that stops dead: each leaves the point where it was, and energy closes."""
        obstacle = Obstacle(LENGTH, math.inf, 0.05)
        course = play(
            case(braked(4000.0, 0.8, 5000.0), load=load, obstacle=obstacle, count=count, ratio=ratio, modes=8), 0.45
        )
        assert sum(event.after == "jammed" for event in course.record.events) > 3
        assert course.residual < 1e-9

    def test_drive_on_within_its_bound(self) -> None:
        """P + (P^2 + c (m_1 + m_2) v^2)^(1/2)."""
        base = Base(5000.0, 0.8, grips=(Grip("drive", Signal.constant(6000.0), 0.8),))
        course = play(case(base, load=2100.0, column=600.0, obstacle=Obstacle(LENGTH, 50 * STIFFNESS)), 0.6)
        assert abs(course.largest("deflection")[0]) * STIFFNESS <= 6000 + math.hypot(
            6000, 0.8 * math.sqrt(STIFFNESS * 7700)
        )
        assert course.residual < 1e-11

    def test_modes_left_out_are_in_series_with_the_contact(self) -> None:
        """Few modes and a hard contact: the load's own place is soft by what was left out."""
        obstacle = Obstacle(LENGTH, 1e12)
        forces = [
            -play(case(braked(4000.0, 0.8), load=50.0, count=8, modes=modes, obstacle=obstacle), 0.3).bottom(
                "deflection"
            )[0]
            * STIFFNESS
            for modes in (3, 6, 12)
        ]
        assert forces[0] == pytest.approx(forces[2], rel=0.03)
        assert abs(forces[1] - forces[2]) < abs(forces[0] - forces[2])


class TestMoment:
    @pytest.mark.parametrize(
        "parts",
        [
            {},
            {"obstacle": Obstacle(LENGTH, 4 * STIFFNESS, 0.05)},
            {"obstacle": Obstacle(LENGTH, 4 * STIFFNESS, 0.05, 3e3)},
            {"guide": Guide(LENGTH, 2 * STIFFNESS, 0.002)},
        ],
    )
    def test_of_a_column_without_mass_is_its_bend(self, parts: dict[str, Obstacle | Guide]) -> None:
        """Whatever acts at the tip bends it by F L^3/(3 E I) and turns its root by F L."""
        course = play(case(braked(9000.0), column=0.0, **parts), 0.5)  # type: ignore[arg-type]
        low, high = sorted(abs(one) for one in deflections(course))
        found = sorted(abs(one) for one in (course.top("moment")[0], course.bottom("moment")[0]))
        assert found == pytest.approx([STIFFNESS * LENGTH * low, STIFFNESS * LENGTH * high], rel=1e-9, abs=1e-9)


class TestGuide:
    def test_a_gap_that_is_never_closed_changes_nothing(self) -> None:
        free = play(case(braked(9000.0)), 1.0)
        guided = play(case(braked(9000.0), guide=Guide(LENGTH, 1e6, 0.05)), 1.0)
        assert deflections(guided) == pytest.approx(deflections(free), rel=1e-11)

    def test_no_gap_is_a_spring_to_both_sides(self) -> None:
        """As stiff as a prop of the column."""
        guided = play(case(braked(9000.0), guide=Guide(LENGTH, 1e6, 1e-9)), 0.6)
        mast = Mast.of(
            Column((Segment(LENGTH, BENDING, 200.0),), (Lump(LENGTH, 1800.0),), props=(Prop(LENGTH, 1e6),)), 4
        )
        propped = play(Case(mast, np.zeros(len(mast.frequencies)), braked(9000.0), (LENGTH,)), 0.6)
        assert deflections(guided) == pytest.approx(deflections(propped), rel=1e-4)
        assert guided.residual < 1e-10

    def test_it_takes_energy_from_nothing(self) -> None:
        course = play(case(braked(9000.0), guide=Guide(LENGTH, 3e6, 0.003)), 2.0)
        assert sum(event.element == "guide" for event in course.record.events) > 6
        assert course.residual < 1e-11
        assert course.top("deflection")[0] < 0.00964


class TestHard:
    @pytest.mark.parametrize("mass", [1e-3, 1.0, 1e9])
    def test_any_ratio_of_masses(self, mass: float) -> None:
        """A braked base of any mass under a load of a ton: 2 P m_2/(c (m_1 + m_2)) while it slips."""
        total = mass + 1000.0
        force = 1e-3 * total * math.sqrt(STIFFNESS / 1000.0)
        course = play(case(braked(force, 1.0, mass), column=0.0, load=1000.0), 0.3)
        assert course.largest("deflection")[0] == pytest.approx(2 * force * 1000 / (STIFFNESS * total), rel=1e-6)
        assert course.residual < 1e-9

    def test_a_contact_like_a_wall(self) -> None:
        soft = play(case(braked(4000.0, 0.8), obstacle=Obstacle(LENGTH, 1e20), count=4), 0.2)
        assert soft.residual < 1e-8
        assert math.isfinite(soft.largest("deflection")[0])

    @pytest.mark.parametrize("rise", [1e-3, 3600.0])
    def test_rises_of_a_millisecond_and_of_an_hour(self, rise: float) -> None:
        force = 9000.0
        course = play(case(braked(force, 5000.0, rise=rise), ratio=0.01, modes=3), rise + 0.5)
        still = force * (1800 + 3 / 8 * 1200) / (7000 * STIFFNESS)
        overshoot = 1 + math.exp(-0.01 * 21.0059 / 16.96796 * math.pi)
        assert course.largest("deflection")[0] == pytest.approx(still * (1 if rise > 1 else overshoot), rel=2e-3)
        assert course.residual < 1e-9

    def test_a_brake_that_stops_exactly_at_the_end_of_a_swing(self) -> None:
        """Base and load come to rest together after a whole period: nothing swings on."""
        load, mass, force = 1000.0, 3000.0, 8000.0
        omega = math.sqrt(STIFFNESS * (1 / load + 1 / mass))
        speed = force / (load + mass) * 2 * math.pi / omega
        course = play(case(braked(force, speed, mass), column=0.0, load=load), 3.0)
        assert course.held_since == pytest.approx(2 * math.pi / omega, rel=1e-6)
        later = play(case(braked(force, speed, mass), column=0.0, load=load), 3.0, keep=True)
        times, tips = later.over_time("deflection")
        assert np.abs(tips[times > course.held_since + 1e-6]).max() < 1e-6 * course.largest("deflection")[0]

    def test_modes_that_ring_on_are_not_asked_for_their_own_summits(self) -> None:
        """Without damping every swing of every mode is as high as the one before: what is watched for its work alone
        is not looked at again in each of them, and what is read has its summits all the same."""
        one = case(braked(9000.0), column=3000.0, count=12, modes=24)
        course = play(one, 4.0)
        assert course.record.long > 10
        assert course.record.looks < 3000  # 97 000 with them
        finer = play(one, 4.0, 0.7)  # it shares no panel
        for what in ("deflection", "moment", "acceleration"):
            value, time = course.largest(what)
            assert value == pytest.approx(finer.largest(what)[0], rel=1e-9)
            assert 0 <= time <= 4.0

    def test_looks_for_summits_count_as_work(self) -> None:
        """A run whose march is soon over is given up for its looks, a fifteenth as many as panels."""
        one = case(braked(9000.0), column=3000.0, count=12, modes=24)
        found = play(one, 4.0, most_work=1e6).record
        assert found.work < 3e4
        assert found.looks > 3e4 / 25
        with pytest.raises(NumericsError, match="cannot be separated"):
            play(one, 4.0, most_work=3e4)

    def test_at_rest_from_the_beginning(self) -> None:
        course = play(case(braked(9000.0, 0.0)), 1.0)
        assert deflections(course) == (0.0, 0.0)
        assert course.held_since == 0.0

    def test_energy_of_many_machines(self) -> None:
        rng = np.random.default_rng(8)
        for _ in range(12):
            guide = Guide(LENGTH, 10 ** rng.uniform(4, 8), 10 ** rng.uniform(-4, -2)) if rng.random() < 0.4 else None
            rigid = rng.random() < 0.5
            obstacle = Obstacle(LENGTH, math.inf if rigid else 10 ** rng.uniform(5, 9), 10 ** rng.uniform(-2, -1))
            base = braked(
                10 ** rng.uniform(3, 5), rng.uniform(0.1, 2), 10 ** rng.uniform(2, 4), rise=rng.uniform(0, 0.5)
            )
            one = case(
                base, column=10 ** rng.uniform(1, 4), load=10 ** rng.uniform(1, 4), ratio=rng.uniform(0, 0.05), modes=5,
                obstacle=obstacle if rng.random() < 0.6 else None, guide=guide, pull=rng.choice([0.0, 9.81, -9.81]),
            )  # fmt: skip
            assert play(one, 1.5).residual < 1e-9


class TestRefused:
    def test_a_base_without_mass(self) -> None:
        with pytest.raises(NumericsError, match="mass above 0"):
            Base(0.0)

    def test_two_grips_of_one_speed(self) -> None:
        with pytest.raises(NumericsError, match="rising speed"):
            Base(1.0, grips=(Grip("a", Signal.constant(1.0)), Grip("b", Signal.constant(1.0))))
