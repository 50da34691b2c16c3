"""The whole belt in cells against finite elements that stick and slide without smoothing, and its own balances.

The reference (`support.belt_fem`) has other nodes, another rule in time and another way to decide what sticks. Its
waves disperse, so fronts differ by more than the rest: both the root mean square and the largest deviation are held.
"""

import itertools
import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from support.belt_fem import Length, Motion, Plan, Roller, no_hold, simulate

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.belt import march as marching
from ptmcalc.numerics.belt.course import Course, Reach, lay_out
from ptmcalc.numerics.belt.march import Drawn, Until, march, place_at
from ptmcalc.numerics.belt.station import Drum, Station, TakeUp

EA = 138e6
BACK, CARRY = Length(1000.0, 38.0, EA, 9.3195), Length(1000.0, 245.0, EA, 60.0863)
UP = replace(BACK, climb=-12.0), replace(CARRY, climb=200.0)
MASS = 45_120.0
WRAP = 0.3 * math.pi
Set = tuple[Course, Station, Station, np.ndarray]


def ramp(force: float, rise: float, delay: float = 0.0) -> Callable[[float, float], float]:
    return lambda time, speed: force * min(max((time - delay) / rise, 0.0), 1.0)


def rising(force: float, rise: float, delay: float = 0.0) -> Callable[[float], float]:
    return lambda time: force * min(max((time - delay) / rise, 0.0), 1.0)


def kloss(time: float, speed: float) -> float:
    slip = 1 - speed / 3.2
    return 2 * 320e3 * 0.12 * slip / (slip**2 + 0.12**2)


def switched_in(time: float, speed: float) -> float:
    """The motor's curve, brought in over half a second."""
    return kloss(time, speed) * min(time / 0.5, 1.0)


def drum(name: str, roller: Roller) -> Drum:
    def force(time: float, speed: float) -> tuple[float, float]:
        slope = (roller.pull(time, speed + 1e-5) - roller.pull(time, speed - 1e-5)) / 2e-5
        return roller.pull(time, speed), slope

    return Drum(name, roller.mass, force, roller.hold, roller.exponent, roller.one_way)


def twin(plan: Plan, cells: int, off: float, frozen: bool) -> Set:
    """The same belt in cells, with its tension without gravity: even, or risen by the friction of a running belt."""
    reaches = tuple(
        replace(
            Reach.even(one.length, one.line_mass, one.stiffness, one.friction, one.climb),
            drag=np.array([0.0, one.drag * one.length]),
        )
        for one in plan.lengths
    )
    course = lay_out(reaches, plan.tail_after, cells)
    head = Station(
        place_at(course, 0, plan.belt_line_mass),
        [drum(f"head {j}", roller) for j, roller in enumerate(plan.head)],
        TakeUp(*plan.takeup) if plan.takeup else None,
        plan.head_speed,
    )
    tail = Station(
        place_at(course, course.tail, plan.belt_line_mass),
        [drum(f"tail {j}", roller) for j, roller in enumerate(plan.tail)],
        None,
        plan.tail_speed,
    )
    return course, head, tail, profile(plan, course.middles, off, frozen)


def profile(plan: Plan, places: np.ndarray, off: float, frozen: bool) -> np.ndarray:
    ends = np.cumsum([0.0, *(one.length for one in plan.lengths)])
    sums = np.cumsum([0.0, *(one.friction * one.length for one in plan.lengths)])
    return off + (np.interp(places, ends, sums) if frozen else np.zeros(len(places)))


def drawn(plan: Plan, cells: int, window: float, off: float, speed: float, frozen: bool) -> tuple[Set, Drawn]:
    ready = twin(plan, cells, off, frozen)
    return ready, march(*ready, speed, window)


def reference(plan: Plan, elements: int, window: float, off: float, speed: float, frozen: bool) -> Motion:
    transit = [one.length * math.sqrt(one.line_mass / one.stiffness) for one in plan.lengths]
    counts = [max(round(elements * part / sum(transit)), 1) for part in transit]
    start, places = 0.0, []
    for one, count in zip(plan.lengths, counts, strict=True):
        places.append(start + one.length * (np.arange(count) + 0.5) / count)
        start += one.length
    return simulate(plan, elements, window, profile(plan, np.concatenate(places), off, frozen), speed)


HEAD = (Roller(MASS, ramp(200e3, 0.5)),)
SCENES: dict[str, tuple[Plan, float, float, float, bool, float]] = {
    # plan, window, tension at the run-off, speed, frozen, largest deviation allowed
    "start relaxed": (Plan((BACK, CARRY), 1, HEAD, takeup=(100e3, 0.0)), 6.0, 100e3, 0.0, False, 6e-3),
    "start frozen": (Plan((BACK, CARRY), 1, HEAD, takeup=(100e3, 0.0)), 6.0, 100e3, 0.0, True, 6e-3),
    "fixed loop": (Plan((BACK, CARRY), 1, HEAD), 6.0, 150e3, 0.0, False, 6e-3),
    "massive take-up": (Plan((BACK, CARRY), 1, HEAD, takeup=(100e3, 20e3)), 6.0, 100e3, 0.0, False, 6e-3),
    "nearly rigid take-up": (Plan((BACK, CARRY), 1, HEAD, takeup=(100e3, 5e5)), 6.0, 100e3, 0.0, False, 6e-3),
    "massive take-up that friction holds back": (
        Plan((BACK, CARRY), 1, (Roller(MASS, ramp(90e3, 0.5)),), takeup=(100e3, 40e3)), 6.0, 100e3, 0.0, True, 8e-3,
    ),
    "viscous drag": (
        Plan((replace(BACK, drag=1.0), replace(CARRY, drag=4.0)), 1, HEAD, takeup=(100e3, 20e3)),
        6.0, 100e3, 0.0, True, 6e-3,
    ),
    "partial load": (
        Plan((BACK, replace(CARRY, length=400.0), Length(600.0, 60.0, EA, 15.0)), 1, HEAD, takeup=(100e3, 0.0)),
        6.0, 100e3, 0.0, True, 6e-3,
    ),
    "uphill from a brake that lets go": (
        Plan(
            (replace(BACK, climb=-12.0), replace(CARRY, climb=100.0)), 1,
            (Roller(MASS, ramp(350e3, 0.8), lambda time: 1e9 if time < 0.4 else 0.0),), takeup=(150e3, 0.0),
        ),
        6.0, 150e3, 0.0, True, 6e-3,
    ),
    "two drums, one slips": (
        Plan(
            (BACK, CARRY), 1,
            (Roller(20e3, ramp(200e3, 0.5), exponent=WRAP), Roller(10e3, ramp(100e3, 0.5), exponent=WRAP)),
            takeup=(72e3, 0.0),
        ),
        6.0, 72e3, 0.0, False, 8e-3,
    ),
    "two drums in a fixed loop, both slip and catch": (
        Plan(
            (BACK, CARRY), 1,
            (Roller(20e3, ramp(200e3, 0.5), exponent=WRAP), Roller(10e3, ramp(100e3, 0.5), exponent=WRAP)),
        ),
        6.0, 200e3, 0.0, False, 5e-2,
    ),
    "two drums slip for good": (
        Plan(
            (BACK, CARRY), 1,
            (Roller(20e3, ramp(230e3, 0.5), exponent=0.8 * WRAP), Roller(10e3, ramp(100e3, 0.5), exponent=WRAP)),
            takeup=(50e3, 0.0),
        ),
        6.0, 50e3, 0.0, False, 1e-2,
    ),
    "slip at speed": (
        Plan(
            (BACK, CARRY), 1, (Roller(MASS, ramp(300e3, 0.5), exponent=0.3 * math.radians(210)),),
            takeup=(130e3, 0.0), belt_line_mass=2e3,
        ),
        5.0, 130e3, 0.0, False, 6e-3,
    ),
    "drive at the tail": (
        Plan((BACK, CARRY), 1, (Roller(20e3, ramp(150e3, 0.5)),), (Roller(8e3, ramp(60e3, 0.5, 0.3)),), (100e3, 0.0)),
        6.0, 100e3, 0.0, True, 1.2e-2,
    ),
    "drive at the tail slips": (
        Plan(
            (BACK, CARRY), 1, (Roller(20e3, ramp(100e3, 0.5)),),
            (Roller(8e3, ramp(120e3, 0.5, 0.3), exponent=0.9),), (130e3, 0.0),
        ),
        6.0, 130e3, 0.0, True, 8e-3,
    ),
    "brake to rest": (
        Plan((BACK, CARRY), 1, (Roller(MASS, hold=rising(100e3, 0.6, 0.4)),), takeup=(300e3, 0.0)),
        9.0, 300e3, 3.0, True, 6e-3,
    ),
    "brake to rest uphill and held": (
        Plan(UP, 1, (Roller(MASS, hold=rising(300e3, 0.6, 0.4)),), takeup=(350e3, 0.0)), 9.0, 350e3, 2.0, True, 1.5e-2,
    ),
    "brake holds the drum while the belt slides": (
        Plan((BACK, CARRY), 1, (Roller(15e3, hold=rising(900e3, 0.2, 0.4), exponent=0.7),), takeup=(400e3, 0.0)),
        8.0, 400e3, 3.0, True, 5e-2,
    ),
    "runs back": (Plan(UP, 1, (Roller(MASS),), takeup=(350e3, 0.0)), 14.0, 350e3, 2.0, True, 8e-3),
    "backstop": (Plan(UP, 1, (Roller(MASS, one_way=True),), takeup=(350e3, 0.0)), 14.0, 350e3, 2.0, True, 8e-3),
    "backstop on the second drum": (
        Plan(UP, 1, (Roller(25e3), Roller(20e3, one_way=True)), takeup=(350e3, 0.0)), 14.0, 350e3, 2.0, True, 1e-2,
    ),
    "drive against its own brake": (
        Plan(
            (BACK, CARRY), 1,
            (Roller(MASS, ramp(250e3, 0.5), lambda time: 80e3 + 170e3 * min(max((time - 3.0) / 0.5, 0.0), 1.0)),),
            takeup=(200e3, 0.0),
        ),
        9.0, 200e3, 0.0, False, 1e-2,
    ),
    "head jams within 0.3 s": (
        Plan((BACK, CARRY), 1, (Roller(MASS),), head_speed=lambda time: 4 * max(1 - time / 0.3, 0.0)),
        6.0, 1e6, 4.0, True, 5e-2,
    ),
    "tail jams within 0.3 s": (
        Plan(
            (BACK, CARRY), 1, (Roller(MASS),), (Roller(1e3),), (600e3, 0.0),
            tail_speed=lambda time: 3 * max(1 - time / 0.3, 0.0),
        ),
        6.0, 600e3, 3.0, True, 6e-2,
    ),
    "speed imposed": (
        Plan((BACK, CARRY), 1, (Roller(MASS),), takeup=(150e3, 0.0), head_speed=lambda time: min(time, 3.0)),
        6.0, 150e3, 0.0, True, 6e-3,
    ),
    "motor curve": (
        Plan((BACK, CARRY), 1, (Roller(MASS, kloss),), takeup=(150e3, 0.0)), 9.0, 150e3, 0.0, True, 6e-3,
    ),
    "motor curve on a light drum that slips": (
        Plan((BACK, CARRY), 1, (Roller(5e3, switched_in, exponent=0.5),), takeup=(100e3, 0.0)),
        9.0, 100e3, 0.0, True, 3e-2,
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", SCENES)
def test_agrees_with_finite_elements(name: str) -> None:
    plan, window, off, speed, frozen, largest = SCENES[name]
    (_, head, tail, _), mine = drawn(plan, 400, window, off, speed, frozen)
    mesh = reference(plan, 1000, window, off, speed, frozen)
    when = np.linspace(0.02, 0.98, 500) * window
    top = max(np.abs(mesh.head.on).max(), np.abs(mesh.tail.on).max())
    fast = max(np.abs(mesh.head.belt).max(), np.abs(mesh.tail.belt).max())
    for station, history, spot in ((head, mine.head, mesh.head), (tail, mine.tail, mesh.tail)):
        pairs = [
            ("belt", [s.belt for s in history], spot.belt, fast),
            ("on", [s.tensions[0] for s in history], spot.on, top),
            ("off", [s.tensions[-1] for s in history], spot.off, top),
        ]
        for j in range(len(station.drums)):
            scale = max(fast, max(abs(d[j]) for d in spot.drums))
            pairs.append((f"drum {j}", [s.drums[j] for s in history], [d[j] for d in spot.drums], scale))
        pairs += [
            (f"behind drum {j - 1}", [s.tensions[j] for s in history], [t[j] for t in spot.between], top)
            for j in range(1, len(station.drums))
        ]
        for what, ours, theirs, scale in pairs:
            apart = (np.interp(when, mine.times, ours) - np.interp(when, mesh.times, theirs)) / scale
            assert np.sqrt(np.mean(apart**2)) < max(largest / 4, 3e-3), (what, np.sqrt(np.mean(apart**2)))
            assert np.abs(apart).max() < largest, (what, np.abs(apart).max())
        assert station.slid == pytest.approx(spot.slid.tolist(), rel=1e-2, abs=1e-3)
        assert station.heat == pytest.approx(spot.heat.tolist(), rel=2e-2, abs=1e-6 * top)
    behind = np.interp(when, mine.times, [s.behind for s in mine.head]) - np.interp(when, mesh.times, mesh.behind)
    if plan.takeup:
        assert np.sqrt(np.mean((behind / fast) ** 2)) < largest
    at = mesh.tail_element
    assert mine.carry_max.value == pytest.approx(mesh.highest[at:].max(), abs=largest * top)
    assert mine.back_max.value == pytest.approx(mesh.highest[:at].max(), abs=largest * top)
    assert mine.carry_min.value == pytest.approx(mesh.lowest[at:].min(), abs=largest * top)
    assert mine.back_min.value == pytest.approx(mesh.lowest[:at].min(), abs=largest * top)
    assert mine.energy_residual < 1e-9


def at_random(seed: int) -> tuple[Plan, float, float, bool]:
    """A belt of any kind: two or three reaches, up or down, one to three drums and perhaps one at the tail.

    A brake or backstop is there only on a drum that stands alone: what several held drums share is indeterminate.
    """
    draw = np.random.default_rng(seed)

    def chance(share: float) -> bool:
        return bool(draw.random() < share)

    def exponent() -> float | None:
        return draw.uniform(0.4, 1.5) if chance(0.5) else None

    length, up = draw.uniform(300, 1500), draw.uniform(-80, 150) * chance(0.5)
    parts = 1 + chance(0.4)
    lengths = [Length(length, draw.uniform(20, 60), EA, draw.uniform(2, 15), -0.15 * up, 1.0 * chance(0.3))]
    lengths += [
        Length(length / parts, draw.uniform(40, 350), EA, draw.uniform(5, 80), up, 2.0 * chance(0.3))
        for _ in range(parts)
    ]
    resistance = max(abs(sum(one.length * (one.friction + one.climb) for one in lengths)), 20e3)
    speed = draw.uniform(1, 5) * chance(0.4)
    whole, tension, count = draw.uniform(0.3, 2.5) * resistance, draw.uniform(50e3, 300e3), draw.integers(1, 4)
    alone = count == 1
    brake = rising(draw.uniform(0.2, 2) * whole, 0.4, draw.uniform(0, 2))
    head = tuple(
        Roller(
            draw.uniform(3e3, 60e3),
            ramp(whole / count * draw.uniform(0.5, 1.5), draw.uniform(0.2, 1.5), draw.uniform(0, 1) * chance(0.3)),
            brake if alone and chance(0.4) else no_hold,
            exponent(),
            alone and chance(0.3),
        )
        for _ in range(count)
    )
    tail = (Roller(draw.uniform(500, 20e3), ramp(0.3 * whole, draw.uniform(0.2, 1)), exponent=exponent()),)
    takeup = [None, (tension, 0.0), (tension, tension / 9.81 * 2)][draw.integers(3)]
    plan = Plan(tuple(lengths), 1, head, tail if chance(0.4) else (), takeup, belt_line_mass=15.0 * chance(0.5))
    return plan, tension, speed, chance(0.7)


@pytest.mark.parametrize("seed", [*range(8), *(pytest.param(seed, marks=pytest.mark.study) for seed in range(8, 64))])
def test_agrees_with_finite_elements_on_belts_of_any_kind(seed: int) -> None:
    plan, off, speed, frozen = at_random(seed)
    window = 6.0
    _, mine = drawn(plan, 300, window, off, speed, frozen)
    mesh = reference(plan, 800, window, off, speed, frozen)
    when = np.linspace(0.02, 0.98, 300) * window
    top = max(np.abs(mesh.head.on).max(), np.abs(mesh.tail.on).max())
    fast = max(np.abs(mesh.head.belt).max(), np.abs(mesh.tail.belt).max(), 0.05)
    for history, spot in ((mine.head, mesh.head), (mine.tail, mesh.tail)):
        pairs = [
            ([s.belt for s in history], spot.belt, fast),
            ([s.tensions[0] for s in history], spot.on, top),
            ([s.tensions[-1] for s in history], spot.off, top),
        ]
        for j in range(len(history[0].drums)):
            rim = [d[j] for d in spot.drums]
            pairs.append(([s.drums[j] for s in history], rim, max(fast, *map(abs, rim))))
        for ours, theirs, scale in pairs:
            apart = np.interp(when, mine.times, ours) - np.interp(when, mesh.times, theirs)
            assert np.sqrt(np.mean(apart**2)) < 1.5e-2 * scale
    assert mine.energy_residual < 1e-6


def test_scenes_do_what_they_are_named_after() -> None:
    """A comparison of two belts where nothing slips would say nothing of slip."""
    slips = {name: self_slips(name) for name in SCENES if "slip" in name or "slides" in name}
    assert slips["two drums, one slips"] == {(0, 0), (0, 1)}
    assert {(0, 1), (0, 0)} < slips["two drums in a fixed loop, both slip and catch"]
    assert any(first for first, _ in slips["two drums in a fixed loop, both slip and catch"])
    assert (1, 1) in slips["two drums slip for good"]
    assert (-1,) in slips["brake holds the drum while the belt slides"]
    assert (1,) in slips["motor curve on a light drum that slips"]
    assert (1,) in slips["slip at speed"]


def self_slips(name: str) -> set[tuple[int, ...]]:
    plan, window, off, speed, frozen, _ = SCENES[name]
    _, mine = drawn(plan, 100, window, off, speed, frozen)
    return {seen.slips for seen in mine.head}


# -- balances -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", SCENES)
def test_energy_of_the_belt_is_balanced(name: str) -> None:
    """Exactly, whatever sticks or slips: waves carry energy from node to node."""
    plan, window, off, speed, frozen, _ = SCENES[name]
    _, mine = drawn(plan, 60, window, off, speed, frozen)
    assert mine.energy_residual < 1e-10


def drum_balance(plan: Plan, cells: int, window: float, off: float, speed: float, frozen: bool) -> float:
    """Work of drives and brakes less kinetic energy of drums, heat of slip, and work into the belt, over the whole."""
    (_, head, tail, _), mine = drawn(plan, cells, window, off, speed, frozen)
    worst = 0.0
    for station, history in ((head, mine.head), (tail, mine.tail)):
        if not station.drums:
            continue
        pull = np.array([(s.tensions[0] - s.tensions[-1]) * s.belt for s in history])
        into = np.trapezoid(pull, mine.times)
        turnover = np.trapezoid(np.abs(pull), mine.times)
        stored = sum(
            one.mass * (b**2 - a**2) / 2
            for one, a, b in zip(station.drums, history[0].drums, history[-1].drums, strict=True)
        )
        gap = station.work - stored - sum(station.heat) - into
        worst = max(worst, abs(gap) / (abs(station.work) + abs(stored) + sum(station.heat) + turnover))
    return worst


@pytest.mark.parametrize("name", SCENES)
def test_energy_of_the_drums_is_balanced_ever_better(name: str) -> None:
    coarse, fine = (drum_balance(SCENES[name][0], cells, *SCENES[name][1:5]) for cells in (200, 800))
    assert fine < 1e-3
    assert fine < coarse / 2 or fine < 2e-5


@pytest.mark.parametrize("name", [name for name, scene in SCENES.items() if not scene[0].takeup])
def test_a_loop_of_fixed_length_keeps_its_elongation(name: str) -> None:
    plan, window, off, speed, frozen, _ = SCENES[name]
    (course, *_), mine = drawn(plan, 100, window, off, speed, frozen)
    swing = max(mine.carry_max.value, mine.back_max.value) / EA * course.places[-1]
    assert abs(mine.stretched) < 1e-11 * swing


def test_a_take_up_gives_what_the_belt_gets_longer() -> None:
    plan, window, off, speed, frozen, _ = SCENES["massive take-up"]
    _, mine = drawn(plan, 400, window, off, speed, frozen)
    given = np.trapezoid([s.belt - s.behind for s in mine.head], mine.times)
    assert mine.stretched == pytest.approx(given, rel=1e-3)


def test_work_of_friction_counts_every_metre_of_belt() -> None:
    """A belt in steady motion: all of its friction times the way, that at head and tail included."""
    plan = Plan((BACK, CARRY), 1, (Roller(MASS),), takeup=(200e3, 0.0), head_speed=lambda time: 2.0)
    drags = tuple(replace(one, drag=0.5) for one in plan.lengths)
    for lengths, pull in ((plan.lengths, 0.0), (drags, 1.0)):
        ready = twin(replace(plan, lengths=lengths), 50, 200e3, frozen=True)
        tension = ready[3] + ready[0].middles * pull
        mine = march(*ready[:3], tension, 2.0, 3.0)
        w = sum(one.friction * one.length for one in lengths) + 2000.0 * pull
        way = 2.0 * mine.times[-1]
        assert mine.friction_work == pytest.approx(w * way, rel=1e-9)
        assert mine.head[-1].tensions[0] == pytest.approx(200e3 + w, rel=1e-9)
        assert mine.tail[-1].tensions[0] == pytest.approx(200e3 + (9319.5 + 1000.0 * pull), rel=3e-2)
        assert mine.energy_residual < 1e-12


# -- symmetry -------------------------------------------------------------------------------------------------------


def test_a_loop_turned_round_and_driven_backward_gives_mirrored_loads() -> None:
    plan = Plan((BACK, CARRY), 1, (Roller(MASS, ramp(260e3, 0.5), exponent=0.8),))
    back = Plan((CARRY, BACK), 1, (Roller(MASS, ramp(-260e3, 0.5), exponent=0.8),))
    (_, head, _, _), mine = drawn(plan, 240, 6.0, 150e3, 0.0, False)
    (_, daeh, _, _), mirror = drawn(back, 240, 6.0, 150e3, 0.0, False)
    assert any(seen.slips[0] for seen in mine.head)
    for one, two in zip(mine.head, mirror.head, strict=True):
        assert two.tensions[::-1] == pytest.approx(one.tensions, rel=1e-9)
        assert two.belt == pytest.approx(-one.belt, abs=1e-9)
        assert two.drums[0] == pytest.approx(-one.drums[0], abs=1e-9)
        assert two.slips == tuple(-sense for sense in one.slips)
    assert mirror.back_max.value == pytest.approx(mine.carry_max.value, rel=1e-9)
    assert mirror.back_max.place == pytest.approx(2000.0 - mine.carry_max.place, rel=1e-9)
    assert mirror.carry_min.value == pytest.approx(mine.back_min.value, rel=1e-9)
    assert mirror.carry_min.time == mine.back_min.time
    assert daeh.heat == pytest.approx(head.heat, rel=1e-9)
    assert daeh.slid == pytest.approx(head.slid, rel=1e-9)


def test_two_drums_turned_round_change_places() -> None:
    rollers = (Roller(20e3, ramp(200e3, 0.5), exponent=WRAP), Roller(10e3, ramp(100e3, 0.5), exponent=WRAP))
    turned = tuple(
        replace(roller, pull=lambda time, speed, roller=roller: -roller.pull(time, -speed)) for roller in rollers[::-1]
    )
    _, mine = drawn(Plan((BACK, CARRY), 1, rollers), 200, 6.0, 200e3, 0.0, False)
    _, mirror = drawn(Plan((CARRY, BACK), 1, turned), 200, 6.0, 200e3, 0.0, False)
    assert {seen.slips for seen in mine.head} > {(0, 1)}
    for one, two in zip(mine.head, mirror.head, strict=True):
        assert two.tensions[::-1] == pytest.approx(one.tensions, rel=1e-7)
        assert two.slips[::-1] == tuple(-sense for sense in one.slips)
        assert two.drums[::-1] == pytest.approx([-speed for speed in one.drums], abs=1e-7)


def test_one_drum_or_two_halves_that_stick_are_the_same() -> None:
    whole = Plan((BACK, CARRY), 1, (Roller(MASS, ramp(200e3, 0.5)),), takeup=(100e3, 0.0))
    half = Roller(MASS / 2, ramp(100e3, 0.5), exponent=9.0)
    halves = replace(whole, head=(half, half))
    one, two = (drawn(plan, 200, 6.0, 100e3, 0.0, False)[1] for plan in (whole, halves))
    for a, b in zip(one.head, two.head, strict=True):
        assert (b.tensions[0], b.tensions[2]) == pytest.approx(a.tensions, rel=1e-10)
        assert b.tensions[1] == pytest.approx(sum(a.tensions) / 2, rel=1e-6)


def test_reaches_cut_in_two_are_the_same_belt() -> None:
    plan, window, off, speed, frozen, _ = SCENES["fixed loop"]
    parts = tuple(replace(one, length=one.length / 2) for one in plan.lengths for _ in range(2))
    _, one = drawn(plan, 200, window, off, speed, frozen)
    _, two = drawn(replace(plan, lengths=parts, tail_after=2), 200, window, off, speed, frozen)
    top = one.carry_max.value
    when = np.linspace(0, window, 200)
    for name, at in (("on", 0), ("off", -1)):
        a, b = (np.interp(when, d.times, [s.tensions[at] for s in d.head]) for d in (one, two))
        assert np.abs(a - b).max() < 6e-3 * top, name


# -- rest -----------------------------------------------------------------------------------------------------------


def test_forces_exactly_at_friction_move_nothing() -> None:
    """Drive and friction of all the belt in balance, and a belt wound up to it: it stays at rest for good."""
    w = 9.3195 * 1000 + 60.0863 * 1000
    plan = Plan((BACK, CARRY), 1, (Roller(MASS, lambda time, speed: w),), takeup=(100e3, 0.0))
    for frozen in (True, False):
        _, mine = drawn(plan, 100, 20.0, 100e3, 0.0, frozen)
        if frozen:
            assert max(abs(seen.belt) for seen in mine.head) < 1e-9
            assert mine.energy_residual < 1e-6
        else:  # from relaxed the front runs out, as far as the drive can pull
            assert mine.head[-1].belt >= 0.0


@pytest.mark.parametrize("share", [0.1, 0.45])
def test_less_pull_than_friction_winds_the_belt_up_and_stops(share: float) -> None:
    """A pull below half of the friction never reaches the end: the front stops where 2 F/w is used up, or where a
    drum of great mass has wound it up further; nothing moves from then on."""
    w = 60.0863
    pull = share * w * 1000
    plan = Plan((BACK, CARRY), 1, (Roller(1.0, lambda time, speed: pull),), takeup=(100e3, 0.0))
    (course, *_), mine = drawn(plan, 400, 30.0, 100e3, 0.0, False)
    assert mine.head[-1].belt == 0.0
    assert mine.tail[-1].belt == 0.0
    assert mine.head[-1].tensions[0] == pytest.approx(100e3 + pull, abs=2 * w * 1000 / course.cells)
    stretch = np.array(mine.carry_max.value - 100e3)
    assert stretch == pytest.approx(pull, rel=2e-2)


def test_a_belt_at_rest_without_forces_stays() -> None:
    plan = Plan((BACK, CARRY), 1, (Roller(MASS, hold=lambda time: 1e3, exponent=0.5, one_way=True),))
    _, mine = drawn(plan, 50, 5.0, 80e3, 0.0, False)
    assert all(seen.belt == 0.0 and seen.tensions == (80e3, 80e3) for seen in mine.head)
    assert mine.energy_residual == 0.0
    assert mine.friction_work == 0.0


def test_waves_go_from_node_to_node_by_the_rule() -> None:
    """A ring without drums, its nodes one by one in plain numbers: 0 is where the ring is closed."""
    reaches = tuple(replace(Reach.even(500.0, mass, EA, 15.0), drag=np.array([0.0, 900.0])) for mass in (40.0, 250.0))
    course = lay_out(reaches, 1, 24)
    cells, steps = course.cells, 150  # more than two blocks of the march
    tension = 1e5 + 6e4 * np.sin(np.arange(cells))
    head, tail = (Station(place_at(course, node, 0.0), ()) for node in (0, course.tail))
    found = march(course, head, tail, tension, 0.2, steps * course.step)

    z = course.cell_impedance.tolist()
    friction, drag = course.friction.copy(), course.drag.copy()
    friction[0], drag[0] = friction[0] + friction[-1], drag[0] + drag[-1]
    up, down = (tension + course.cell_impedance * 0.2).tolist(), (tension - course.cell_impedance * 0.2).tolist()
    on, highest, work = [], tension.tolist(), 0.0
    for _ in range(steps):
        new_up, new_down = [0.0] * cells, [0.0] * cells
        for i in range(cells):
            into, out, before, after = down[i - 1], up[i], z[i - 1], z[i]
            q = out - into
            v = math.copysign(max(abs(q) - friction[i], 0.0), q) / (before + after + drag[i])
            new_up[i - 1], new_down[i] = into + 2 * before * v, out - 2 * after * v
            work += (friction[i] * abs(v) + drag[i] * v * v) * course.step
            if not i:
                held = math.copysign(1.0, v) if v else q / friction[0]
                on.append(into + before * v + course.drag[-1] * v + held * course.friction[-1])
        up, down = new_up, new_down
        highest = [max(old, (p + n) / 2) for old, p, n in zip(highest, up, down, strict=True)]
    assert len(found.head) == steps + 1
    assert [seen.tensions[0] for seen in found.head[1:]] == pytest.approx(on, rel=1e-12)
    assert found.highest.tolist() == pytest.approx(highest, rel=1e-12)
    assert found.friction_work == pytest.approx(work, rel=1e-12)


def test_extremes_see_the_start() -> None:
    """The largest tension of a belt that runs out is the one it begins with."""
    plan = Plan((BACK, CARRY), 1, (Roller(MASS),), takeup=(200e3, 0.0))
    (_, _, _, tension), mine = drawn(plan, 100, 1.0, 200e3, 3.0, True)
    assert mine.carry_max.value == pytest.approx(tension[-1], rel=1e-12)
    assert mine.carry_max.time <= mine.times[1]


def test_still_ends_the_march() -> None:
    plan, window, off, speed, frozen, _ = SCENES["brake to rest"]
    ready = twin(plan, 100, off, frozen)
    mine = march(*ready, speed, window, Until(rests_for=0.0))
    assert mine.head[-1].belt == 0.0
    assert all(seen.belt > 0 for seen in mine.head[:-1])
    assert mine.times[-1] < window
    assert mine.updates == (len(mine.times) - 1) * ready[0].cells


def test_too_long_a_march_is_refused_before_it_begins(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(marching, "MOST_UPDATES", 1000)
    with pytest.raises(NumericsError, match="cells"):
        drawn(SCENES["fixed loop"][0], 100, 60.0, 100e3, 0.0, False)


# -- few cells, steep curves, light drums ---------------------------------------------------------------------------


def test_one_cell_per_reach_still_is_a_belt() -> None:
    equal = replace(CARRY, line_mass=38.0)
    plan = Plan((BACK, equal), 1, HEAD, takeup=(100e3, 0.0))
    (course, *_), mine = drawn(plan, 2, 30.0, 100e3, 0.0, True)
    assert course.cells == 2
    assert mine.energy_residual < 1e-12
    rigid = (200e3 - 60.0863e3 - 9.3195e3) / (MASS + 2 * 38e3)
    assert mine.head[-1].belt == pytest.approx(rigid * 29.75, rel=0.1)


@pytest.mark.parametrize("mass", [1e-6, 1.0, 1e3, 1e5])
@pytest.mark.parametrize("exponent", [None, 0.9])
def test_no_drum_is_too_light_for_the_step(mass: float, exponent: float | None) -> None:
    """A torque step, a steep motor curve and slip on a drum whose time constants are far below the step."""

    def motor(time: float, speed: float) -> float:
        return 1e7 * (2.0 - speed)

    plan = Plan((BACK, CARRY), 1, (Roller(mass, motor, exponent=exponent),), takeup=(300e3, 0.0))
    _, mine = drawn(plan, 100, 20.0, 300e3, 0.0, True)
    belt = np.array([seen.belt for seen in mine.head])
    rim = np.array([seen.drums[0] for seen in mine.head])
    assert np.isfinite([seen.tensions for seen in mine.head]).all()
    assert rim.max() < (2.4 if mass > 1e4 else 2.1)
    assert belt.min() >= -1e-9
    assert rim[-1] == pytest.approx(2.0, rel=0.02)
    assert mine.energy_residual < 1e-10


def test_a_massless_drum_equals_a_light_one() -> None:
    heads = [(Roller(mass, lambda time, speed: 1e5 * (3.0 - speed), exponent=0.5),) for mass in (0.0, 1e-3)]
    none, light = (
        drawn(Plan((BACK, CARRY), 1, head, takeup=(100e3, 0.0)), 100, 9.0, 100e3, 0.0, True)[1] for head in heads
    )
    assert any(seen.slips[0] for seen in none.head)
    tops = [max(seen.tensions[0] for seen in run.head) for run in (none, light)]
    assert tops[0] == pytest.approx(tops[1], rel=1e-6)
    assert none.head[-1].drums[0] == pytest.approx(light.head[-1].drums[0], rel=1e-3)


def test_long_runs_cost_by_the_second_and_stay_numbers() -> None:
    """An hour of a belt: cell updates grow with the window alone, and nothing blows up or fades."""
    plan = Plan((replace(BACK, friction=0.0), replace(CARRY, friction=0.0)), 1, HEAD, takeup=(300e3, 0.0))
    counts = []
    for window in (60.0, 3600.0):
        (course, *_), mine = drawn(plan, 12, window, 300e3, 0.0, False)
        counts.append(mine.updates / (mine.times[-1] / course.step))
        assert all(math.isfinite(value) for value in mine.head[-1].tensions)
        assert mine.energy_residual < 1e-6
    assert counts[0] == pytest.approx(counts[1], rel=1e-12)
    rigid = 200e3 / (MASS + 283e3)
    assert mine.head[-1].belt == pytest.approx(3600 * rigid, rel=2e-3)
    tops = np.array([seen.tensions[0] for seen in mine.head])
    early, late = tops[: len(tops) // 10].max(), tops[-len(tops) // 10 :].max()
    assert late == pytest.approx(early, rel=0.15)


def test_neighbouring_grids_approach_each_other() -> None:
    plan, window, off, speed, frozen, _ = SCENES["start relaxed"]
    when = np.linspace(0, window, 300)
    runs = [drawn(plan, cells, window, off, speed, frozen)[1] for cells in (100, 200, 400, 800)]
    on = [np.interp(when, run.times, [seen.tensions[0] for seen in run.head]) for run in runs]
    gaps = [float(np.sqrt(np.mean((a - b) ** 2))) for a, b in itertools.pairwise(on)]
    assert gaps[0] > 1.5 * gaps[1]
    assert gaps[1] > 1.5 * gaps[2]
