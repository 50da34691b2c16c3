"""The compiled steps of a belt: their equations solved by other means, and what may go wrong between Python and C."""

import math
import shutil
import sys
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pydantic import TypeAdapter
from scipy.optimize import brentq

from ptmcalc.base.errors import NumericsError, UsageError
from ptmcalc.components.motor import AnyMotor
from ptmcalc.numerics.belt import compiled
from ptmcalc.numerics.belt.compiled import OverTime
from ptmcalc.numerics.belt.course import Course, Reach, lay_out
from ptmcalc.numerics.belt.curve import CurveStage, MotorForce
from ptmcalc.numerics.belt.give import Give, Rubber
from ptmcalc.numerics.belt.march import Drawn, Until, march, place_at
from ptmcalc.numerics.belt.station import Drum, Seen, Station, TakeUp

EA, RHO, LENGTH = 1e7, 50.0, 100.0


# -- nodes ----------------------------------------------------------------------------------------------------------


class Nodes:
    """Spans and rubber at nodes, each step by a bracketed root of plain numbers."""

    def __init__(self, course: Course, rubber: Rubber | None, tension: np.ndarray) -> None:
        at = course.tail - 1
        halves = np.ones(course.cells - 1)
        halves[[0, -1, at - 1, at + 1]], halves[at] = 1.5, 0.0  # beside head and tail, whose own places give nothing
        self.k = halves * course.sag[0]
        self.z, self.step, self.climb = float(course.before[1]), course.step, course.climb[1:-1]
        stiffer, time = (rubber.stiffer, rubber.time) if rubber else (0.0, 1.0)
        self.yields = halves * 2 * LENGTH / course.cells * stiffer / (1 + stiffer) / EA
        self.slow = time * (1 + stiffer)
        self.strain = self.yields * tension
        self.hangs = np.where(self.k > 0, tension + self.climb, 1.0)

    def front(self, i: int) -> float:
        """How much of a front there is at a node: none beside head and tail, nor next to what does not sag."""
        near = range(i - 1, i + 2)
        if near[0] < 0 or near[-1] >= len(self.k) or not all(self.k[j] for j in near):
            return 0.0
        return min(abs(self.hangs[i + 1] - self.hangs[i - 1]) / self.hangs[i], 1.0)

    def pass_on(self, waves: np.ndarray, rubs: float, drag: float) -> tuple[np.ndarray, np.ndarray]:
        """Speeds before and behind the nodes."""
        fronts = [self.front(i) for i in range(len(self.k))]
        found = [self.one(i, *map(float, waves[:, i]), rubs, drag, front) for i, front in enumerate(fronts)]
        v, behind, self.hangs, self.strain = map(np.array, zip(*found, strict=True))
        return v, behind

    def one(self, i: int, n: float, p: float, rubs: float, drag: float, front: float) -> tuple[float, ...]:
        """Speeds, tension of the span and retarded strain of a node at the end of the step."""
        k, old, strain, dt = float(self.k[i]), float(self.hangs[i]), float(self.strain[i]), self.step
        late = max(0.3 * front, 0.02)
        damping = math.sqrt(k * self.z / (2 * dt)) * old**1.5 * front

        def passed(hang: float) -> float:
            """The mean tension of the span less gravity's part."""
            mean = (1 - late) * 2 / (1 / old + 1 / hang) + late * hang
            return mean + damping * (old**-2 - hang**-2) - float(self.climb[i])

        def both(s: float, gives: float) -> tuple[float, float, float]:
            """By friction and by what arrives from behind: speeds before the node; and the rate of retarded strain."""
            before = math.copysign(max(abs(s - n) - rubs, 0.0), s - n) / (self.z + drag)
            rate = (self.yields[i] * s - strain) / (self.slow + dt / 2)
            return before, (p - s) / self.z - gives - rate, rate

        def apart(hang: float) -> float:
            by_friction, by_waves, _ = both(passed(hang), k / dt * (old**-2 - hang**-2))
            return by_friction - by_waves

        if k:
            hang = float(brentq(apart, old / 100, old * 100, xtol=1e-12, rtol=1e-14))
            s, gives = passed(hang), k / dt * (old**-2 - hang**-2)
        else:
            hang, gives = 1.0, 0.0
            s = float(brentq(lambda s: both(s, 0.0)[0] - both(s, 0.0)[1], -1e6, 1e6, xtol=1e-9, rtol=1e-14))
        before, _, rate = both(s, gives)
        return before, (p - s) / self.z, hang, strain + rate * dt


@pytest.mark.parametrize("rubber", [None, Rubber(0.3, 0.02)], ids=["elastic", "Zener"])
@pytest.mark.parametrize("span", [900.0, 0.0], ids=["sags", "straight"])
def test_nodes_solve_their_equations(rubber: Rubber | None, span: float) -> None:
    """Random waves over thirty steps, with fronts as high as the tension and nodes that friction holds."""
    reaches = (replace(Reach.even(LENGTH, RHO, EA, climb=climb), span=span) for climb in (-20.0, 20.0))
    course = lay_out(tuple(reaches), 1, 20)
    start = np.full(course.cells - 1, 20e3)
    give, nodes = Give(course, rubber, EA), Nodes(course, rubber, start)
    give.begin(start)
    rng = np.random.default_rng(11)
    held = 0
    for _ in range(30):
        waves = rng.uniform(15e3, 40e3, (2, course.cells - 1))
        before, behind = give.pass_on(*waves, np.full(course.cells - 1, 4e3), np.full(course.cells - 1, 7e3))
        expected = nodes.pass_on(waves, 4e3, 7e3)
        assert before == pytest.approx(expected[0], rel=1e-7, abs=1e-9)
        assert behind == pytest.approx(expected[1], rel=1e-7, abs=1e-9)
        assert give.retarded == pytest.approx(nodes.strain, rel=1e-9, abs=1e-15)
        assert give.tension == pytest.approx(nodes.hangs, rel=1e-9)
        held += int((before == 0).sum())
    assert 0 < held < 400


# -- laws over time -------------------------------------------------------------------------------------------------


def belt(drum: Drum, imposed: Callable[[float], float] | OverTime | None = None, steps: int = 200) -> Drawn:
    reach = Reach.even(LENGTH, RHO, EA, friction=8.0)
    course = lay_out((reach, reach), 1, 12)
    head = Station(place_at(course, 0, 0.0), [drum], TakeUp(2e4), imposed)
    tail = Station(place_at(course, course.tail, 0.0), ())
    return march(course, head, tail, np.full(course.cells, 2e4), 2.0, steps * course.step)


STEP = belt(Drum("drum", 1e3), steps=1).times[1]
RAMPS = ((6e3, 0.31, 0.5), (2e3, 0.7, 0.0))


def pull(time: float) -> float:
    return 3e4 * math.sin(3 * time)


def hold(time: float) -> float:
    return 500.0 + sum(
        size * (min((time - delay) / rise, 1.0) if rise else 1.0) for size, delay, rise in RAMPS if time > delay
    )


def test_samples_with_ramps_are_the_functions_they_stand_for() -> None:
    """A drum that slips, is caught between two steps and braked by ramps between them."""
    times = np.arange(202) * STEP
    pulls = OverTime(np.array([pull(time) for time in times]), STEP)
    sampled = Drum("drum", 1e3, pulls, OverTime(np.full(202, 500.0), STEP, RAMPS), exponent=0.2)
    asked = Drum("drum", 1e3, lambda time, speed: (pulls.samples[round(time / STEP)], 0.0), hold, exponent=0.2)
    one, other = belt(sampled), belt(asked)
    assert {seen.slips for seen in one.head} == {(-1,), (0,), (1,)}
    for ours, theirs in zip(one.head, other.head, strict=True):
        assert ours.slips == theirs.slips
        assert (ours.belt, *ours.tensions) == pytest.approx((theirs.belt, *theirs.tensions), rel=1e-12)


def test_an_imposed_speed_may_be_sampled() -> None:
    speeds = 2.0 + np.arange(202) * 0.01
    one = belt(Drum("drum", 1e3), OverTime(speeds, STEP))
    assert one.head.belt == pytest.approx(speeds[:201], rel=1e-15)


def test_a_law_has_a_sample_for_every_step() -> None:
    with pytest.raises(IndexError, match="no sample"):
        belt(Drum("drum", 1e3, OverTime(np.zeros(150), STEP)))


@pytest.mark.parametrize("error", [ZeroDivisionError, KeyboardInterrupt, NumericsError])
def test_what_a_law_raises_comes_back(error: type[BaseException]) -> None:
    def fails(time: float, speed: float) -> tuple[float, float]:
        if time > 50 * STEP:
            raise error("NUM101", "here") if error is NumericsError else error("here")
        return 0.0, 0.0

    with pytest.raises(error, match="here"):
        belt(Drum("drum", 1e3, fails))


@pytest.mark.parametrize("force", [math.inf, math.nan, 1e308])
def test_what_is_no_number_is_refused(force: float) -> None:
    with pytest.raises(NumericsError, match="beyond all numbers"):
        belt(Drum("drum", 0.0, lambda time, speed: (force if time > 50 * STEP else 0.0, 0.0)), steps=400)


# -- what a station was seen to do ------------------------------------------------------------------------------------


def test_a_track_is_the_sequence_of_what_was_seen() -> None:
    drawn = belt(Drum("drum", 1e3, lambda time, speed: (pull(time), 0.0), exponent=0.2))
    track = drawn.head
    every = list(track)
    assert len(track) == len(every) == len(drawn.times)
    assert all(isinstance(seen, Seen) for seen in every)
    assert track[-1] == every[-1]
    assert list(track[3:9:2]) == every[3:9:2]
    assert track.belt.tolist() == [seen.belt for seen in every]
    assert track.behind.tolist() == [seen.behind for seen in every]
    assert track.tensions.tolist() == [list(seen.tensions) for seen in every]
    assert track.drums.tolist() == [list(seen.drums) for seen in every]
    assert track.slips.tolist() == [list(seen.slips) for seen in every]


def test_a_march_ends_when_the_head_has_rested_or_grips_again() -> None:
    reach = Reach.even(LENGTH, RHO, EA, friction=8.0)
    course = lay_out((reach, reach), 1, 12)

    def until(ends: Until, drum: Drum) -> Drawn:
        head, tail = Station(place_at(course, 0, 0.0), [drum], TakeUp(2e4)), Station(place_at(course, 6, 0.0), ())
        return march(course, head, tail, np.full(12, 2e4), 2.0, 2000 * course.step, ends)

    braked = Drum("drum", 1e3, brake=lambda time: 2e4)
    rest = until(Until(rests_for=20.5 * course.step), braked)
    first = int((rest.head.belt <= 0).argmax())
    assert len(rest.times) == first + 22
    slipping = Drum("drum", 1e3, lambda time, speed: (2e4 if time < 0.3 else 0.0, 0.0), exponent=0.2)
    grips = until(Until(grips_from=0.1), slipping)
    assert grips.times[-1] > 0.3
    assert grips.head[-2].slips != grips.head[-1].slips == (0,)
    assert not any(one.lost_grip for one in (rest, grips))
    assert until(Until(presses=1e6), slipping).lost_grip


# -- motors on their curves ------------------------------------------------------------------------------------------


MOTORS: dict[str, dict[str, Any]] = {
    "induction": {"type": "induction", "power": "90 kW", "speed": "1480 rpm", "synchronous_speed": "1500 rpm",
                  "overload": 2.6},
    "full": {"type": "induction", "power": "90 kW", "speed": "1450 rpm", "synchronous_speed": "1500 rpm",
             "overload": 2.2, "formula": "full"},
    "steps": {"type": "rheostat", "power": "90 kW", "speed": "1470 rpm", "synchronous_speed": "1500 rpm",
              "overload": 2.6, "steps": [9, 4, 2], "smallest_torque": "700 N*m"},
    "times": {"type": "rheostat", "power": "90 kW", "speed": "1470 rpm", "synchronous_speed": "1500 rpm",
              "overload": 2.6, "steps": [9, 4], "switch_times": ["2 s", "5 s"]},
    "converter": {"type": "converter", "power": "90 kW", "speed": "1480 rpm", "slip": 0.02, "ramp_time": "6 s",
                  "torque_limit": "900 N*m"},
    "linear": {"type": "linear", "starting_torque": "900 N*m", "no_load_speed": "1500 rpm"},
    "constant": {"type": "constant", "torque": "500 N*m"},
    "table": {"type": "table", "points": [{"speed": "0 rpm", "torque": "800 N*m"}, {"speed": "900 rpm",
              "torque": "1000 N*m"}, {"speed": "1500 rpm", "torque": "-20 N*m"}]},
}  # fmt: skip


@pytest.mark.parametrize("kind", MOTORS)
def test_a_motor_on_its_curve_pulls_in_c_and_in_python_what_the_laws_of_the_motor_say(kind: str) -> None:
    motor, random = TypeAdapter(AnyMotor).validate_python(MOTORS[kind]), np.random.default_rng(5)
    turns, force = 40.0, 40.0 * 2
    ramp = motor.ramp_time if kind == "converter" else 0.0
    given = MotorForce(motor.curve_stages, turns, force * 0.9, force / 0.9, delay=1.0, off=3.0, again=4.5,
                       reference=motor.speed if ramp else 0.0, ramp=ramp)  # fmt: skip
    laws = compiled.Laws()
    law = laws.of_speed(given)
    for time, speed in zip(random.uniform(0, 12, 400).tolist(), random.uniform(-2, 8, 400).tolist(), strict=True):
        since = time - (1.0 if time < 3.0 else 4.5)
        torque = float(motor.torque(speed * turns, since)) if since >= 0 else 0.0
        wanted = torque * force * (0.9 if torque > 0 else 1 / 0.9)
        slope = np.zeros(1)
        found = compiled.library().belt_force(compiled.address_of(law), time, speed, compiled.address(slope))
        assert found == pytest.approx(wanted, rel=1e-11, abs=1e-7)
        assert given(time, speed) == pytest.approx((found, slope[0]), rel=1e-12, abs=1e-7)
        near = 1e-6
        rise = (given(time, speed + near)[0] - given(time, speed - near)[0]) / (2 * near)
        if abs(rise) < 1e6:  # no stage begins there
            assert slope[0] == pytest.approx(rise, rel=1e-3, abs=0.1)


SHAPES = {
    "ramp": lambda u: u,
    "cosine": lambda u: (1 - math.cos(math.pi * u)) / 2,
    "parabolic": lambda u: 2 * u * u if u < 0.5 else 1 - 2 * (1 - u) ** 2,
    ((0.0, 0.0), (0.25, 0.1), (0.7, 0.8), (1.0, 1.0)): lambda u: float(
        np.interp(u, [0, 0.25, 0.7, 1], [0, 0.1, 0.8, 1])
    ),
}


@pytest.mark.parametrize("shape", SHAPES, ids=str)
def test_a_converter_moves_the_curve_by_what_its_reference_is_short_of(shape: Any) -> None:
    motor, random = TypeAdapter(AnyMotor).validate_python(MOTORS["induction"]), np.random.default_rng(6)
    top, turns, ramp = motor.synchronous_speed, 40.0, 8.0
    given = MotorForce(motor.curve_stages, turns, 70.0, 90.0, again=1.0, reference=top, ramp=ramp, shape=shape)
    times, speeds = random.uniform(0, 12, 300), random.uniform(-1, 5, 300)
    found = compiled.forces(given, times, speeds)
    for time, speed, force in zip(times.tolist(), speeds.tolist(), found.tolist(), strict=True):
        part = SHAPES[shape](min((time - 1.0) / ramp, 1.0)) if time >= 1.0 else 0.0
        torque = float(motor.torque(speed * turns + top * (1 - part), 0.0)) if time >= 1.0 else 0.0
        assert force == pytest.approx(torque * (70.0 if torque > 0 else 90.0), rel=1e-10, abs=1e-6)
        assert given(time, speed)[0] == pytest.approx(force, rel=1e-12, abs=1e-7)


# -- the library ------------------------------------------------------------------------------------------------------


@pytest.fixture
def unloaded() -> Iterator[None]:
    """The library is looked for again."""
    compiled.library.cache_clear()
    yield
    compiled.library.cache_clear()


@pytest.mark.usefixtures("unloaded")
def test_a_missing_library_is_compiled(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(compiled, "LIBRARY", tmp_path / "libbelt.so")
    belt(Drum("drum", 1e3))
    assert (tmp_path / "libbelt.so").exists()


@pytest.mark.usefixtures("unloaded")
def test_a_library_of_another_source_is_compiled_again(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    (tmp_path / "march.c").write_text(compiled.SOURCE.read_text("utf-8") + "/* changed */\n", "utf-8")
    (tmp_path / "libbelt.so").write_bytes(compiled.LIBRARY.read_bytes())
    monkeypatch.setattr(compiled, "SOURCE", tmp_path / "march.c")
    monkeypatch.setattr(compiled, "LIBRARY", tmp_path / "libbelt.so")
    belt(Drum("drum", 1e3))
    assert compiled.checksum(tmp_path / "march.c").encode() in compiled.LIBRARY.read_bytes()


@pytest.mark.usefixtures("unloaded")
@pytest.mark.parametrize(("program", "why"), [("", "no C compiler"), ("false", "the compiler failed")])
def test_a_library_that_cannot_be_compiled_is_one_sentence_with_its_cure(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, program: str, why: str
) -> None:
    if program and shutil.which(program) is None:
        pytest.skip(f"needs the program `{program}`")
    monkeypatch.setattr(compiled, "LIBRARY", tmp_path / "libbelt.so")
    monkeypatch.setenv("CC", program)
    if not program:
        monkeypatch.setenv("PATH", str(tmp_path))
        monkeypatch.setattr(sys, "executable", str(tmp_path / "python"))
    with pytest.raises(UsageError, match=f"is missing and cannot be compiled: {why}") as found:
        belt(Drum("drum", 1e3))
    assert "pip install" in found.value.hint


@pytest.mark.usefixtures("unloaded")
def test_a_library_of_another_platform_is_one_sentence(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(compiled, "LIBRARY", tmp_path / "libbelt.so")
    (tmp_path / "libbelt.so").write_text(compiled.checksum(compiled.SOURCE), "utf-8")
    with pytest.raises(UsageError, match="not usable"):
        belt(Drum("drum", 1e3))


# -- rigid start -----------------------------------------------------------------------------------------------------


def test_a_rigid_start_on_straight_motor_curves_has_its_closed_form() -> None:
    """m v' = A - B v - W of two drives: v = v_e (1 - exp(-t/T)), T = m/B; the second is late by its delay."""
    line = CurveStage(((0.0, 900.0), (150.0, 300.0)), extends=True)
    both = MotorForce((line,), 50.0, 60.0, 60.0), MotorForce((line,), 50.0, 30.0, 30.0, delay=0.8, off=math.inf)
    mass, resistance, goal = 4e4, 2e4, 1.2
    force, slope = 900.0 * 60.0, 4.0 * 50.0 * 60.0
    late = 0.8
    first = mass / slope
    ends = (force - resistance) / slope
    speed = ends * (1 - math.exp(-late / first))
    way = ends * (late - first * (1 - math.exp(-late / first)))
    second = mass / (1.5 * slope)
    last = (1.5 * force - resistance) / (1.5 * slope)
    more = second * math.log((last - speed) / (last - goal))
    way += last * more - (last - speed) * second * (1 - math.exp(-more / second))
    step = 0.001
    time, went, steady = compiled.start_on_curves(both, resistance, mass, goal, 1.5, step, 100_000)
    assert time == pytest.approx(late + more, rel=2e-4)
    assert went == pytest.approx(way, rel=4e-4)
    assert steady == pytest.approx(late + second * math.log((last - speed) / (last - 1.5)), abs=2 * step)


def test_a_rigid_start_that_does_not_get_there_ends_with_its_steps() -> None:
    weak = MotorForce((CurveStage(((0.0, 100.0),)),), 50.0, 60.0, 60.0)
    assert compiled.start_on_curves((weak,), 1e4, 1e4, 1.0, 1.0, 0.01, 100) == pytest.approx((1.0, 0.0, 1.0))
