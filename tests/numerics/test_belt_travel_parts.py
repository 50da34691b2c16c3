"""What a belt carries along in one go: everything comes from where it was, no sooner than the belt has run there."""

import math

import numpy as np
import pytest

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.belt.course import Course, Reach, lay_out
from ptmcalc.numerics.belt.give import Give, Rubber
from ptmcalc.numerics.belt.march import Drawn, march, place_at
from ptmcalc.numerics.belt.station import Drum, Seen, Station, TakeUp
from ptmcalc.numerics.belt.travel import Travel

EA, MASSES = 1e6, (40.0, 90.0)
LENGTHS, GOES, CLIMBS = (6.0, 8.0), (0.6, 0.8), (-300.0, 500.0)
RUBBER = Rubber(0.3, 2.0)
SETTLED = 0.3 / 1.3 / EA
"""retarded strain that comes with a tension in the end [1/N]"""


def course_of(cells: int = 40, rubber: Rubber | None = RUBBER) -> Course:
    """A short loop whose cells are below a metre."""
    ends, short = np.array([0.0, 1.0]), EA * (1 + (rubber.stiffer if rubber else 0.0))
    return lay_out(
        tuple(
            Reach(rho, short, length * ends, 0 * ends, 0 * ends, climb * ends, goes=goes)
            for rho, length, climb, goes in zip(MASSES, LENGTHS, CLIMBS, GOES, strict=True)
        ),
        1,
        cells,
    )


class Strand:
    """Fields along a strand: tension and retarded strain are parabolas that only rise or fall, speed a line."""

    def __init__(self, start: float, length: float, tension: tuple[float, float, float], speed: tuple[float, float]):
        self.start, self.length, self.parts, self.line = start, length, tension, speed

    def tension(self, x: np.ndarray) -> np.ndarray:
        s = (x - self.start) / self.length
        return self.parts[0] + self.parts[1] * s + self.parts[2] * s * s

    def speed(self, x: np.ndarray) -> np.ndarray:
        return self.line[0] + self.line[1] * (x - self.start) / self.length

    def strain(self, x: np.ndarray) -> np.ndarray:
        """At both ends the one that comes with the tension there: a station holds its belt long enough."""
        s = (x - self.start) / self.length
        return SETTLED * (self.tension(x) + 500.0 * s * (1 - s))


def station(on: float, off: float, comes: float, leaves: float) -> tuple[Seen, Seen]:
    """One step ago and now, so that half a step from now it is what is asked for."""
    ago, now = (
        Seen((on + 30.0 * k, 0.0, off - 20.0 * k), comes - 0.1 * k, leaves + 0.2 * k, (), ()) for k in (3.0, 1.0)
    )
    return ago, now


@pytest.mark.parametrize("way", [1.0, -1.0], ids=["forward", "back"])
@pytest.mark.parametrize("damped", [True, False])
def test_everything_comes_from_where_it_was(way: float, damped: bool) -> None:
    """S(x - w t), w(x - b w t) and the strain of x - w t, exact for parabolas, in every cell to both ends."""
    course = course_of(rubber=RUBBER if damped else None)
    back = Strand(0.0, 6.0, (40e3, 3e3, 1e3), (way * 2.0, way * 0.3))
    carry = Strand(6.0, 8.0, (52e3, -4e3, -1e3), (way * 2.2, way * -0.4))
    travel = Travel(course, EA, 2.3)
    give = Give(course, RUBBER, EA) if damped else None
    lapse = travel.every * course.step
    here = course.middles < 6.0
    x, z = course.middles, course.cell_impedance

    def both(what: str, places: np.ndarray) -> np.ndarray:
        return np.where(here, getattr(back, what)(places), getattr(carry, what)(places))

    tension, speed = both("tension", x), both("speed", x)
    against, along = (tension - course.climb_within + sense * z * speed for sense in (1.0, -1.0))
    inner = np.delete(np.arange(course.cells - 1), course.tail - 1)
    nodes = course.places[1:-1][inner]
    mine = np.where(nodes < 6.0, 0, 1)

    def at_nodes(what: str, places: np.ndarray) -> np.ndarray:
        return np.where(mine == 0, getattr(back, what)(places), getattr(carry, what)(places))

    if give:
        give.begin(np.full(course.cells - 1, 40e3))
        strain = give.strain.copy()
        strain[inner] = at_nodes("strain", nodes)
        give.restrain(strain)
        assert give.strain[inner] == pytest.approx(strain[inner], rel=1e-12)
    ends = {
        name: tuple(float(one) for one in (strand.tension(at), strand.speed(at)))
        for name, strand, at in (
            ("off", back, np.array(0.0)), ("comes", back, np.array(6.0)),
            ("leaves", carry, np.array(6.0)), ("on", carry, np.array(14.0)),
        )
    }  # fmt: skip
    head = station(ends["on"][0], ends["off"][0], ends["on"][1], ends["off"][1])
    tail = station(ends["comes"][0], ends["leaves"][0], ends["comes"][1], ends["leaves"][1])
    travel.carry(against, along, head, tail, give)
    found = (against + along) / 2 + course.climb_within
    assert found == pytest.approx(both("tension", x - speed * lapse), rel=1e-12)
    goes = np.where(here, *GOES)
    moved = (against - along) / (2 * z)
    assert moved == pytest.approx(both("speed", x - goes * speed * lapse), rel=1e-11)
    if give:
        gone = nodes - at_nodes("speed", nodes) * lapse
        assert give.strain[inner] == pytest.approx(at_nodes("strain", gone), rel=1e-11)


def test_no_front_rings_as_it_is_carried() -> None:
    """A jump is carried on between the values on both its sides."""
    course = course_of(rubber=None)
    travel = Travel(course, EA, 2.3)
    tension = np.where(course.middles < 3.0, 20e3, 60e3) + np.where(course.middles > 9.0, -50e3, 0.0)
    z = course.cell_impedance
    against, along = (tension - course.climb_within + sense * z * 2.3 for sense in (1.0, -1.0))
    head, tail = station(10e3, 20e3, 2.3, 2.3), station(60e3, 60e3, 2.3, 2.3)
    before = tension.copy()
    for _ in range(5):
        travel.carry(against, along, head, tail, None)
        found = (against + along) / 2 + course.climb_within
        upstream = np.concatenate([[20e3], before[:-1]])
        assert (found >= np.minimum(before, upstream) - 1e-6).all()
        assert (found <= np.maximum(before, upstream) + 1e-6).all()
        before = found


@pytest.mark.parametrize(
    ("share", "every"), [(0.02, 4), (0.07, 3), (0.0832, 3), (0.0834, 2), (0.1245, 2), (0.1255, 1), (0.6, 1)]
)
def test_it_is_carried_by_no_more_than_a_quarter_of_the_shortest_cell(share: float, every: int) -> None:
    """And every fourth step at least: by shares of the slowest wave, which takes a step for a cell of its strand."""
    course = course_of(4000, None)  # so many that a step is the same in both strands
    slowest = math.sqrt(EA / MASSES[1])
    assert Travel(course, EA, share * slowest).every == every


def test_a_belt_is_slower_than_its_waves() -> None:
    course, slowest = course_of(4000, None), math.sqrt(EA / MASSES[1])
    Travel(course, EA, 0.998 * slowest)
    with pytest.raises(NumericsError, match="none comes back"):
        Travel(course, EA, 1.002 * slowest)


def test_as_much_belt_goes_past_every_place() -> None:
    """v/(1 + S/EA) is the same everywhere, to first order in the strain: in the cells, and on both sides of a drum."""
    course = course_of(rubber=None)
    travel = Travel(course, EA, 2.0)
    tension = np.linspace(-100.0, 300.0, course.cells)
    on = tension[-1] + sum(CLIMBS)
    speeds = travel.running(tension, 2.0)
    unstretched = speeds / (1 + (tension + course.climb_within) / EA)
    assert unstretched == pytest.approx(2.0 / (1 + on / EA), rel=1e-6)
    assert travel.creep(2.0, on, on - 300.0) == pytest.approx(-2.0 * 300.0 / EA, rel=1e-12)


def run(steps: int, speed: float) -> tuple[Drawn, Travel]:
    """A loop with a drum that pulls a little, and with a jump of tension at the tail."""
    course = course_of(rubber=None)
    head = Station(place_at(course, 0, 0.0), [Drum("drive", 0.0, lambda t, v: (700.0, 0.0))], TakeUp(3e4))
    tail = Station(place_at(course, course.tail, 0.0), [Drum("tail", 1e9)])
    tension = np.where(course.middles < LENGTHS[0], 3e4, 3.4e4)
    travel = Travel(course, EA, speed)
    return march(course, head, tail, tension, speed, steps * course.step, travel=travel), travel


def test_the_creep_is_that_of_the_tensions_a_step_starts_with() -> None:
    drawn, _ = run(1, 2.0)
    climb = sum(CLIMBS)
    assert drawn.head[0].creep == pytest.approx(2.0 * (3e4 - 3.4e4 - climb) / EA, rel=1e-12)
    assert drawn.tail[0].creep == pytest.approx(2.0 * 4e3 / EA, rel=1e-12)
    for first, second in (drawn.head, drawn.tail):
        assert second.creep == pytest.approx(first.belt * (first.tensions[-1] - first.tensions[0]) / EA, rel=1e-12)


def test_energy_that_goes_with_the_belt_is_no_gap_in_the_ledger() -> None:
    """What comes and goes as the belt carries it is told apart from what friction and the drums do."""
    for speed in (2.0, 12.0, 60.0):
        assert run(70, speed)[0].energy_residual < 1e-12


@pytest.mark.parametrize("speed", [2.0, 12.0, 60.0])
def test_a_belt_carries_nothing_farther_than_it_runs(speed: float) -> None:
    """Every time it has run so far, not before: after k steps it was carried k//every times."""
    for steps in range(1, 10):
        _, travel = run(steps, speed)
        assert travel.carried == steps // travel.every
