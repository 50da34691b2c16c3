"""Bookkeeping of the march: when and where extremes are, how long it is, what its claim on energy is measured by."""

import math

import numpy as np
import pytest

from ptmcalc.numerics.belt.course import Course, Reach, lay_out
from ptmcalc.numerics.belt.give import Give
from ptmcalc.numerics.belt.march import Drawn, march, place_at
from ptmcalc.numerics.belt.station import Drum, Station, TakeUp

EA, LENGTH, MASSES = 138e6, 1000.0, (38.0, 245.0)
Z = tuple(math.sqrt(EA * mass) for mass in MASSES)


def course_of(cells: int, friction: float = 0.0, climb: float = 0.0, mass: float | None = None) -> Course:
    masses = MASSES if mass is None else (mass, mass)
    reaches = (
        Reach.even(LENGTH, masses[0], EA, friction, climb),
        Reach.even(LENGTH, masses[1], EA, friction, -climb),
    )
    return lay_out(reaches, 1, cells)


def marched(
    course: Course,
    tension: float,
    steps: float,
    *,
    speed: float = 0.0,
    drum: Drum | None = None,
    imposed: bool = False,
    leak: float | None = None,
    takeup: bool = False,
) -> tuple[Drawn, Station]:
    head = Station(
        place_at(course, 0, 0.0), [drum] if drum else [], TakeUp(tension) if takeup else None,
        (lambda time: speed) if imposed else None,
    )  # fmt: skip
    tail = Station(place_at(course, course.tail, 0.0), [])
    give = None if leak is None else Leaking(course, leak)
    start = np.full(course.cells, tension)
    return march(course, head, tail, start, speed, steps * course.step, give=give), head


class Leaking(Give):
    """Nodes that give nothing but say that they took some energy."""

    def __init__(self, course: Course, leak: float) -> None:
        super().__init__(course, None, EA)
        self.leak = leak

    @property
    def lost(self) -> float:
        return self.leak


@pytest.mark.parametrize("steps", [30, 63, 64, 130])
def test_extremes_of_a_wave_that_rises_are_where_and_when_it_is(steps: int) -> None:
    """A drum without mass whose force rises from 0: F/(Z_u + Z_d) is its speed, and a wave of Z v goes either way.

    Before any echo the field is that of d'Alembert; the middle of a cell is half a step from its nodes.
    """
    course = course_of(500, climb=3.0)
    rate, first = 2e5, 300e3
    drawn, _ = marched(course, first, steps, drum=Drum("drum", 0.0, lambda t, v: (rate * t, 0.0)))
    t = (np.arange(steps + 1) + 0.5)[:, None] * course.step  # tensions in the middle of cells are those of half a step
    middles = course.middles
    far = np.where(middles < LENGTH, middles / math.sqrt(EA / MASSES[0]), 0.0)
    far = np.where(middles > LENGTH, (2 * LENGTH - middles) / math.sqrt(EA / MASSES[1]), far)
    assert far[0] == pytest.approx(course.step / 2, rel=0.01)
    climb = 3.0 * np.minimum(middles, 2 * LENGTH - middles)
    before = np.where(middles < LENGTH, -Z[0], Z[1])
    field = first + climb + before * rate * np.maximum(t - far, 0.0) / sum(Z)
    size = float(np.ptp(field))
    back, carry = field[:, : course.tail], field[:, course.tail :]
    assert drawn.highest == pytest.approx(field.max(axis=0), abs=2e-3 * size)
    assert drawn.lows.shape == (steps + 1, 2)
    assert drawn.lows == pytest.approx(np.array([back.min(axis=1), carry.min(axis=1)]).T, abs=2e-3 * size)
    for extreme, part, at, time in (
        (drawn.back_min, back.min(), middles[0], t[-1, 0]),
        (drawn.back_max, back.max(), middles[course.tail - 1], t[0, 0]),
        (drawn.carry_max, carry.max(), middles[-1], t[-1, 0]),
        (drawn.carry_min, carry.min(), middles[-1], t[0, 0]),
    ):
        assert extreme.value == pytest.approx(part, abs=2e-3 * size)
        assert (extreme.place, extreme.time) == pytest.approx((at, time), rel=1e-9)


@pytest.mark.parametrize("steps", [0, 1, 7, 64, 65])
def test_a_window_of_whole_steps_takes_so_many(steps: int) -> None:
    course = course_of(12)
    drawn, _ = marched(course, 1e5, steps)
    assert drawn.times == pytest.approx(np.arange(steps + 1) * course.step, rel=1e-12)
    assert len(drawn.head) == len(drawn.tail) == len(drawn.lows) == steps + 1
    assert drawn.updates == steps * course.cells
    assert len(marched(course, 1e5, steps + 0.5)[0].times) == steps + 2


@pytest.mark.parametrize("steps", [0, 1, 7, 65])
def test_a_belt_without_friction_that_runs_evenly_has_no_rates(steps: int) -> None:
    """Also where the window ends before the first step: then no step has been made from which rates could be taken."""
    row = marched(course_of(12), 1e5, steps, speed=3.0)[0].row
    assert row.rate_energy == pytest.approx(0.0, abs=1e-12)
    assert row.speeds == pytest.approx(np.zeros(len(row.masses)), abs=1e-12)


def test_at_the_end_the_tail_has_the_speed_of_its_drum() -> None:
    """Also where nodes of the belt give on their own."""
    course = course_of(12)
    head = Station(place_at(course, 0, 0.0), [], None, lambda time: 1.0)
    tail = Station(place_at(course, course.tail, 0.0), [Drum("tail", 1e6)])
    start = np.full(course.cells, 1e5)
    drawn = march(course, head, tail, start, 0.0, 20 * course.step, give=Leaking(course, 0.0))
    assert drawn.row.speeds[course.tail] == pytest.approx(drawn.tail[-1].belt - drawn.head[-1].belt, rel=1e-12)


def test_head_and_tail_have_their_lumps_once() -> None:
    """The head is where the course begins and ends; the tail is one node, all of whose friction is before it."""
    ends = np.array([0.0, 100.0])
    one, two = (Reach(mass, EA, ends, ends * 3, ends * 5, ends * climb) for mass, climb in ((38.0, -2.0), (245.0, 7.0)))
    course = lay_out((one, two), 1, 30)
    head, tail = place_at(course, 0, 11.0), place_at(course, course.tail, 13.0)
    assert (head.before, head.after, tail.before, tail.after) == pytest.approx((Z[1], Z[0], Z[0], Z[1]))
    assert (head.climb_on, head.climb_off, tail.climb_on, tail.climb_off) == pytest.approx((500.0, 0.0, -200.0, -200.0))
    first, last = (course.places[1] / 2, (course.places[-1] - course.places[-2]) / 2)
    assert (head.friction_on, head.friction_off) == pytest.approx((3 * last, 3 * first))
    assert (head.drag_on, head.drag_off) == pytest.approx((5 * last, 5 * first))
    beside = (course.places[course.tail + 1] - course.places[course.tail - 1]) / 2
    assert (tail.friction_on, tail.friction_off) == pytest.approx((3 * beside, 0.0), abs=0.0, rel=1e-9)
    assert (tail.drag_on, tail.drag_off) == pytest.approx((5 * beside, 0.0), abs=0.0, rel=1e-9)
    assert (head.belt_line_mass, tail.belt_line_mass) == (11.0, 13.0)


# -- the claim on energy ---------------------------------------------------------------------------------------------


def test_a_belt_at_rest_loses_nothing_and_a_millionth_would_be_told() -> None:
    """The scale of a belt that does nothing is a rounding of what is in it."""
    course = course_of(40, friction=5.0)
    assert marched(course, 200e3, 80)[0].friction_work == 0.0
    assert marched(course, 200e3, 80)[0].energy_residual < 1e-6
    stored = 200e3**2 / (2 * EA) * 2 * LENGTH
    drawn, _ = marched(course, 200e3, 80, leak=1e-6 * stored)
    assert drawn.energy_residual == pytest.approx(100 / 101, rel=1e-6)


def test_a_belt_without_tension_at_rest_has_no_energy_to_miss() -> None:
    drawn, _ = marched(course_of(12), 0.0, 10)
    assert drawn.energy_residual == 0.0
    assert drawn.carry_max.value == drawn.back_min.value == 0.0


def test_what_a_running_belt_misses_is_measured_by_its_motion() -> None:
    course, leak = course_of(40, mass=60.0), 1.0
    drawn, _ = marched(course, 10.0, 80, speed=2.0, leak=leak)
    motion = 60.0 * 2 * LENGTH * 2.0**2 / 2
    assert drawn.energy_residual == pytest.approx(leak / (motion + leak), rel=1e-5)
    assert drawn.friction_work == pytest.approx(leak, rel=1e-9)


def test_what_a_driven_belt_misses_is_measured_by_what_it_got_and_what_it_became() -> None:
    """From rest without friction: the drive's work goes into the belt, and both count."""
    course, force = course_of(400), 2e5
    drum = Drum("drum", 0.0, lambda t, v: (force * min(t / 0.5, 1.0), 0.0))
    gains = marched(course, 10.0, 300, drum=drum)[1].work
    drawn, _ = marched(course, 10.0, 300, drum=drum, leak=1e-3 * gains)
    assert drawn.energy_residual == pytest.approx(1e-3 / 2.001, rel=2e-3)


def test_what_a_rubbing_belt_misses_is_measured_by_what_it_rubs_off_too() -> None:
    """At an even speed under tensions that rise by the friction: what the stations pass on to the belt between them is
    rubbed off there, and both count."""
    course, speed, steps = course_of(40, friction=4.0, mass=60.0), 2.0, 90
    head = Station(place_at(course, 0, 0.0), [Drum("drum", 0.0)], TakeUp(50.0), lambda time: speed)
    tail = Station(place_at(course, course.tail, 0.0), [])
    leak = 1.0
    start = 50.0 + 4.0 * course.middles
    drawn = march(course, head, tail, start, speed, steps * course.step, give=Leaking(course, leak))
    cell, way = LENGTH / (course.cells / 2), speed * steps * course.step
    inner = 4.0 * (2 * LENGTH - 2 * cell)
    motion = 60.0 * 2 * LENGTH * speed**2 / 2
    whole = motion + 2 * inner * way + leak
    assert drawn.energy_residual == pytest.approx(leak / whole, rel=1e-4)
    assert drawn.friction_work == pytest.approx(4.0 * 2 * LENGTH * way + leak, rel=1e-9)
