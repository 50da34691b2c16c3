"""What follows an event, where it is easily got wrong: by closed forms, by scaling, and to the last digit."""

import math

import pytest
from support.trains import Run, run

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.motion import Reaction
from ptmcalc.numerics.piecewise import march
from ptmcalc.numerics.train.parts import (
    HUNT_CROSSLEY,
    RIGID,
    Body,
    Drive,
    Governed,
    Grip,
    Guide,
    Impulse,
    Mesh,
    Spring,
    Stage,
    Train,
)
from ptmcalc.numerics.train.signals import FloatArray, Signal, Trigger
from ptmcalc.numerics.train.state import NO_FRICTION, State
from ptmcalc.numerics.train.system import TrainSystem

UP = Trigger(0, "speed", 1.0, rising=True)


def pushed(law: Signal, speed: float = 0.0, **more: object) -> Train:
    return Train((Body("m", 2.0, 0.0, speed),), drives=(Drive.of("d", 0, law),), **more)  # type: ignore[arg-type]


class TestDecays:
    def test_from_the_start(self) -> None:
        found = run(pushed(Signal(decay=6.0, decay_time=0.5)), 2.0)
        assert found.last("speed") == pytest.approx(6.0 * 0.5 * (1 - math.exp(-4.0)) / 2, rel=1e-13)

    @pytest.mark.parametrize("late", [0.0, 1.0])
    def test_beside_no_other_break(self, late: float) -> None:
        """5 N, from a time on less 5 exp(-t/0.2)."""
        found = run(pushed(Signal(values=(5.0,), decay=-5.0, decay_time=0.2, decay_start=late)), 3.0)
        gained = 5.0 * 3.0 - 5.0 * 0.2 * (1 - math.exp(-(3.0 - late) / 0.2))
        assert found.last("speed") == pytest.approx(gained / 2, rel=1e-13)

    @pytest.mark.parametrize("late", [0.0, 0.7])
    @pytest.mark.parametrize("wait", [1.0, 1e3 / 3])
    def test_of_a_signal_that_was_set_off(self, late: float, wait: float) -> None:
        """Set off at the speed 1, which comes after a wait: then 3 and, some time later, 8 exp(-t/0.3) beside."""
        law = Signal(values=(3.0,), decay=8.0, decay_time=0.3, decay_start=late, trigger=UP, before=2.0 / wait)
        found = run(pushed(law), wait + 2.0)
        gained = 3.0 * 2.0 + 8.0 * 0.3 * (1 - math.exp(-(2.0 - late) / 0.3))
        assert found.events("d") == [(pytest.approx(wait, rel=1e-12), "waiting", "started")]
        assert found.last("speed") == pytest.approx(1.0 + gained / 2, rel=1e-10)

    @pytest.mark.parametrize("time", [1.0, 1e3])
    def test_a_break_just_before_it_does_not_begin_it(self, time: float) -> None:
        """A step of another torque, a billionth earlier; it begins at its own time, be that off by rounding."""
        late = Signal(decay=2.0, decay_start=time * (1 + 1e-9))
        system = TrainSystem(pushed(late))
        state, z = system.start()
        place = system.own + system.inputs.decay_index(late)
        for at, begun in ((time, 0.0), (late.decay_start * (1 + 4e-16), 1.0), (late.decay_start, 1.0)):
            assert system.react(state, at, z, None).state[place] == begun


def test_a_signal_set_off_late_goes_through_its_pieces() -> None:
    """From the speed 1 at t = 1 on: 2 for 0.5, a line down from 4 for 1, then -1."""
    law = Signal((0.0, 0.5, 1.5), (2.0, 4.0, -1.0), (0.0, -4.0, 0.0), trigger=UP, before=2.0)
    found = run(pushed(law), 4.0)
    assert found.last("speed") == pytest.approx(1.0 + (2.0 * 0.5 + 4.0 - 2.0 - 1.5) / 2, rel=1e-13)


def test_stages_end_one_after_the_other_by_time() -> None:
    stages = tuple(
        Stage(Signal.constant(force), until_time=end) for force, end in ((4.0, 1.0), (-2.0, 1.5), (7.0, 2.0))
    )
    found = run(Train((Body("m", 2.0),), drives=(Drive("d", 0, (*stages, Stage(Signal.constant(1.0)))),)), 4.0)
    assert found.times("d") == pytest.approx([1.0, 1.5, 2.0], rel=1e-14)
    assert found.last("speed") == pytest.approx((4.0 - 1.0 + 3.5 + 2.0) / 2, rel=1e-14)


class TestEnds:
    """A motion that is over when everything rests ends there."""

    def ended(self, *grips: Grip, second: float = 0.0, **more: object) -> tuple[float, str]:
        train = Train((Body("a", 4.0, 0.0, 2.0), Body("b", 1.0, 0.0, second)), grips=grips, rest_ends=True, **more)  # type: ignore[arg-type]
        system = TrainSystem(train)
        record = march(system, *system.start(), end=9.0)
        return record.time, "ends" if record.finished else "goes on"

    def test_at_rest(self) -> None:
        one, other = (Grip(name, k, None, Signal.constant(2.0)) for k, name in enumerate("ab"))
        assert self.ended(one, other) == (4.0, "ends")
        assert self.ended(one, other, second=12.0) == (6.0, "ends")
        assert self.ended(one) == (9.0, "goes on"), "nothing holds the second"

    def test_not_before_what_waits(self) -> None:
        one, other = (Grip(name, k, None, Signal.constant(2.0)) for k, name in enumerate("ab"))
        push = Drive.of("d", 0, Signal((0.0, 5.0), (0.0, 1.0), (0.0, 0.0)))
        assert self.ended(one, other, drives=(push,)) == (5.0, "ends")
        assert self.ended(one, other, impulses=(Impulse(1, 7.0, 1.0),)) == (7.5, "ends")


class TestImpulses:
    @pytest.mark.parametrize("ratio", [2.0, -5.0])
    def test_behind_a_gear(self, ratio: float) -> None:
        """p on the outer body is p/i on the inner one: v = (p/i)/(J_1 + J_2/i^2)."""
        train = Train(
            (Body("a", 3.0), Body("b", 7.0)), (Mesh("g", 0, 1, ratio),), impulses=(Impulse(1, 0.5, 4.0),)
        )  # fmt: skip
        found = run(train, 1.0)
        assert found.last("speed", 0) == pytest.approx(4.0 / ratio / (3.0 + 7.0 / ratio**2), rel=1e-14)

    def test_where_one_of_two_contacts_gives_way(self) -> None:
        """A body on the floor is lifted by a rope that tightens at 0.5 m/s: the rope pulls, the floor does not push."""
        train = Train(
            (Body("low", 2.0), Body("high", 3.0, 1.0, 0.5)),
            springs=(
                Spring("floor", 0, None, 0.0, law=RIGID, side=-1),
                Spring("rope", 1, 0, 0.0, law=RIGID, side=1, rest=1.25),
            ),
            drives=(Drive.of("weight", 0, Signal.constant(-1e-3)),),
        )
        found = run(train, 0.500001)
        assert found.last("speed", 0) == found.last("speed", 1) == pytest.approx(0.3, rel=1e-8)
        assert [after for _, _, after in found.events("floor")] == ["open"]
        assert found.events("rope")[-1][2] == "closed"
        assert found.ledger.shocks == pytest.approx(2.0 * 3.0 / 5.0 * 0.25 / 2, rel=1e-12)

    def test_of_a_prescribed_body_that_is_met(self) -> None:
        """A wall that comes at 2 m/s: a mass at rest flies off with (1 + e) 2, the wall goes on."""
        train = Train(
            (Body("wall", 5.0, 0.0, 2.0), Body("m", 3.0, 1.0)),
            springs=(Spring("contact", 0, 1, 0.0, law=RIGID, side=1, restitution=0.25),),
            guides=(Guide("g", 0),),
        )
        found = run(train, 1.0, closes=2.0)  # what the guide puts in at the blow is in no entry
        assert found.last("speed", 0) == 2.0
        assert found.last("speed", 1) == pytest.approx(2.5, rel=1e-14)


class Counting(TrainSystem):
    """A system that counts the guards that cross."""

    fired = 0

    def react(self, mode: State, time: float, state: FloatArray, fired: int | None) -> Reaction:
        self.fired += fired is not None
        return super().react(mode, time, state, fired)


class TestRigidPlay:
    """Half of a play lies to either side."""

    @pytest.mark.parametrize("way", [1, -1])
    def test_a_body_stops_at_its_end_exactly(self, way: int) -> None:
        train = Train(
            (Body("m", 2.0, 0.0, 0.3 * way),),
            springs=(Spring("gap", 0, None, 0.0, law=RIGID, play=0.14),),
            drives=(Drive.of("press", 0, Signal.constant(1e-3 * way)),),
        )
        found = run(train, 2.0)
        assert found.last("position") == way * 0.07
        assert found.last("speed") == 0.0
        assert found.last("link") == pytest.approx(1e-3 * way)
        assert found.events("gap")[0][2] == ("closed" if way > 0 else "closed backward")

    @pytest.mark.parametrize("play", [1e-3, 0.2, 50.0])
    def test_bounces_are_followed_down_to_the_last_digits_of_the_place(self, play: float) -> None:
        """The height of a bounce, v^2/(2 a), falls by e^2 each time: from where it began to 1e-14 of play and place."""
        restitution, pull = 0.8, 5.0
        train = Train(
            (Body("m", 1.0),), springs=(Spring("gap", 0, None, 0.0, law=RIGID, play=play, restitution=restitution),),
            drives=(Drive.of("weight", 0, Signal.constant(pull)),),
        )  # fmt: skip
        time = math.sqrt(play / pull) * (1 + restitution) / (1 - restitution)
        system = Counting(train)
        record = march(system, *system.start(), end=2 * time)
        last, hidden = (play / 2 * restitution ** (2 * k) for k in (system.fired - 1, system.fired))
        assert last > 1e-14 * 1.5 * play / 3
        assert hidden < 1e-14 * 1.5 * play * 3
        assert record.events[-1].time == pytest.approx(time, rel=1e-6)
        assert float(record.last[system.watched["position", 0]]) == play / 2
        assert float(record.last[system.watched["speed", 0]]) == 0.0

    @pytest.mark.parametrize("restitution", [0.3, 0.7])
    @pytest.mark.parametrize("other", [1e-3, 1e3])
    def test_bounces_end_beside_whatever_else_moves(self, restitution: float, other: float) -> None:
        """As they do alone, in as many impacts at most, with a body that runs past: rounding of its motion is none."""
        floor = Spring("floor", 0, None, 0.0, law=RIGID, side=-1, restitution=restitution)
        system = Counting(
            Train(
                (Body("ball", 1.0, 0.3), Body("by", 3.0, 0.0, other)), springs=(floor,),
                drives=(Drive.of("weight", 0, Signal.constant(-2.0)),),
            )
        )  # fmt: skip
        time = math.sqrt(0.3) * (1 + restitution) / (1 - restitution)
        record = march(system, *system.start(), end=1.1 * time)
        assert record.events[-1].time == pytest.approx(time, rel=1e-6)
        assert float(record.last[system.watched["speed", 0]]) == 0.0
        assert system.fired <= 2 + math.log(1e-14) / math.log(restitution)

    def test_bounces_that_lose_little_end_too(self) -> None:
        """With e = 0.95 from a height of 1e-13 beside a speed of 1: where a fall gains what the impact before it lost,
        rounding would keep them up for ever."""
        floor = Spring("floor", 0, None, 0.0, law=RIGID, side=-1, restitution=0.95)
        drive = Drive.of("weight", 0, Signal.constant(-2.0))
        system = Counting(
            Train((Body("ball", 1.0, 1e-13), Body("by", 3.0, 0.0, 1.0)), springs=(floor,), drives=(drive,))
        )
        time = math.sqrt(1e-13) * 1.95 / 0.05
        record = march(system, *system.start(), end=1.5 * time)
        assert record.events[-1].time == pytest.approx(time, rel=0.01)
        assert 100 < system.fired < 200
        assert float(record.last[system.watched["speed", 0]]) == 0.0

    @pytest.mark.parametrize("of", [1.0, 2.0**-20])
    def test_a_ball_by_itself_bounces_as_often_in_any_unit(self, of: float) -> None:
        """Thrown up from the floor: beside nothing else its bounces end where they are 1e-14 of the first."""
        floor = Spring("floor", 0, None, 0.0, law=RIGID, side=-1, restitution=0.5)
        drive = Drive.of("weight", 0, Signal.constant(-2.0 * of))
        system = Counting(Train((Body("ball", 1.0, 0.0, of),), springs=(floor,), drives=(drive,)))
        record = march(system, *system.start(), end=3.0)
        assert float(record.last[system.watched["speed", 0]]) == 0.0
        assert record.events[-1].time == pytest.approx(2.0, rel=1e-9)
        assert system.fired == pytest.approx(-math.log2(1e-14), abs=3)


@pytest.mark.parametrize("side", [1, -1])
def test_a_contact_of_hunt_and_crossley_without_loss_is_a_spring(side: int) -> None:
    """n = 1, c = 0: half a period pi (m/C)^(1/2) in contact, at most v (C m)^(1/2)."""
    spring = Spring("c", 0, None, 400.0, play=0.2, law=HUNT_CROSSLEY, exponent=1.0)
    found = run(Train((Body("m", 4.0, 0.0, 0.5 * side),), springs=(spring,)), 0.6)
    assert found.times("c") == pytest.approx([0.2, 0.2 + math.pi / 10], rel=1e-9)
    assert side * (found.top("link") if side > 0 else found.bottom("link")) == pytest.approx(20.0, rel=1e-9)
    assert found.last("speed") == pytest.approx(-0.5 * side, rel=1e-9)


class TestClutches:
    @pytest.mark.parametrize("way", [1, -1])
    @pytest.mark.parametrize("static", [1.0, 1.5])
    def test_slip_where_they_would_have_to_bear_more(self, way: int, static: float) -> None:
        """T on the first body: the second follows with T J_2/(J_1 + J_2) as long as the clutch bears it."""
        ramp = Signal((0.0,), (0.0,), (2.0 * way,))
        train = Train(
            (Body("a", 1.0), Body("b", 3.0)),
            grips=(Grip("clutch", 0, 1, Signal.constant(6.0), static),),
            drives=(Drive.of("d", 0, ramp),),
        )
        loose = 6.0 * static * 4.0 / 3.0 / 2.0
        found = run(train, loose + 1.0)
        word = "slips forward" if way > 0 else "slips backward"
        assert found.events("clutch") == [(pytest.approx(loose, rel=1e-12), "locked", word)]
        assert found.last("speed", 1) == pytest.approx(way * (loose**2 / 4 + 6.0 / 3.0), rel=1e-12)
        assert found.last("speed", 0) == pytest.approx(way * (loose**2 / 4 + 2.0 * loose + 1.0 - 6.0), rel=1e-12)

    @pytest.mark.parametrize("of", [2.0**-40, 1.0, 2.0**40])
    def test_slip_until_their_sides_turn_alike_however_slowly_or_fast_they_do(self, of: float) -> None:
        """From 3 and 0 rad/s under 2 N m, 9/8 s; both in any unit."""
        train = Train(
            (Body("a", 1.0, 0.0, 3.0 * of), Body("b", 3.0)), grips=(Grip("clutch", 0, 1, Signal.constant(2.0 * of)),)
        )
        found = run(train, 2.0)
        assert found.events("clutch") == [(pytest.approx(9 / 8, rel=1e-12), "slips forward", "locked")]
        assert [found.last("speed", k) for k in (0, 1)] == pytest.approx([0.75 * of] * 2, rel=1e-12)
        assert found.ledger.lost["clutch"] == pytest.approx(0.75 * 9 / 2 * of**2, rel=1e-12)
        assert found.ledger.stored == pytest.approx(-0.75 * 9 / 2 * of**2, rel=1e-12)

    @pytest.mark.parametrize("way", [1, -1])
    def test_lock_where_their_sides_turn_alike(self, way: int) -> None:
        """Behind gears of 3 and -7: speeds in the ratio of both, to the last digit, for as long as nothing slips."""
        train = Train(
            (Body("a", 1.0, 0.0, 9.0 * way), Body("b", 2.0, 0.0, 3.0 * way), Body("c", 5.0), Body("d", 0.1)),
            (Mesh("one", 0, 1, 3.0), Mesh("other", 2, 3, -7.0)),
            grips=(Grip("clutch", 1, 3, Signal.constant(4.0)),),
        )
        found = run(train, 50.0)
        inner, outer = 2.0 + 9.0, 0.1 + 49.0 * 5.0
        together = 3.0 * way * inner / (inner + outer)
        word = "slips forward" if way > 0 else "slips backward"
        assert found.events("clutch") == [(pytest.approx((3.0 - way * together) * inner / 4.0), word, "locked")]
        assert [found.last("speed", k) for k in range(4)] == pytest.approx(
            [3 * together, together, -7 * together, together], rel=1e-12
        )
        assert found.last("speed", 1) == pytest.approx(found.last("speed", 3), rel=4e-16)

    @pytest.mark.parametrize("part", [0.5, 1.0, 2.0])
    def test_a_gate_of_a_half_halves_it(self, part: float) -> None:
        gate = Signal((0.0, 1.0), (part, 0.0), (0.0, 0.0))
        train = Train((Body("m", 2.0, 0.0, 5.0),), grips=(Grip("b", 0, None, Signal.constant(4.0), gate=gate),))
        assert run(train, 3.0).last("speed") == pytest.approx(5.0 - 2.0 * part, rel=1e-14)


class TestPrescribed:
    @pytest.mark.parametrize(
        ("apart", "stiffness", "torque"),
        [(0.0, 0.0, 0.0), (1e-3, 0.0, 0.0), (-1e-3, 0.0, 0.0), (1e-3, 1e9, 0.0), (-1.0, 0.0, 1e9)],
    )
    def test_two_motions_joined_by_a_clutch(self, apart: float, stiffness: float, torque: float) -> None:
        """Accelerations a thousandth apart cannot be shared by a clutch that is locked, even beside a stiff link; ones
        as far apart as they are large not beside a large torque either."""
        train = Train(
            (Body("a", 1.0), Body("b", 1.0), Body("far", 1.0)),
            springs=(Spring("stiff", 2, None, stiffness),) if stiffness else (),
            grips=(Grip("clutch", 0, 1, Signal.constant(5.0)),),
            drives=(Drive.of("d", 2, Signal.constant(torque)),),
            guides=(Guide("one", 0, Signal.constant(1.0 + apart)), Guide("other", 1, Signal.constant(1.0))),
        )
        found = run(train, 2.0)
        assert found.last("speed", 0) == pytest.approx(2.0 * (1 + apart), rel=1e-13, abs=1e-15)
        assert found.last("speed", 1) == pytest.approx(2.0, rel=1e-13)
        assert found.last("grip") == pytest.approx(5.0 * (apart > 0) - 5.0 * (apart < 0), abs=1e-9)

    @pytest.mark.parametrize("acceleration", [3.0, -3.0])
    def test_takes_along_what_is_locked_to_it(self, acceleration: float) -> None:
        """Through a clutch on the outer body of a gear: b = -i a, and the clutch bears the other side's J b."""
        train = Train(
            (Body("a", 1.0), Body("b", 2.0), Body("c", 4.0)),
            (Mesh("gear", 0, 1, -0.25),),
            grips=(Grip("clutch", 1, 2, Signal.constant(100.0)),),
            guides=(Guide("g", 0, Signal.constant(acceleration)),),
        )
        found = run(train, 20.0)
        assert found.events() == []
        assert found.last("speed", 2) == pytest.approx(-4.0 * acceleration * 20.0, rel=1e-14)
        assert found.last("speed", 2) == found.last("speed", 1)
        assert found.last("grip") == pytest.approx(4.0 * -4.0 * acceleration, rel=1e-13)
        assert found.last("guide") == pytest.approx(acceleration * (1.0 + 6.0 * 16.0), rel=1e-13)

    @pytest.mark.parametrize("way", [1, -1])
    def test_begins_to_move_against_the_friction_of_its_bearing(self, way: int) -> None:
        motion = Signal((0.0, 1.0), (0.0, 2.0 * way), (0.0, 0.0))
        train = Train(
            (Body("a", 3.0),), grips=(Grip("b", 0, None, Signal.constant(5.0)),), guides=(Guide("g", 0, motion),)
        )
        found = run(train, 2.0)
        assert found.events("b") == [(pytest.approx(1.0), "at rest", "forward" if way > 0 else "backward")]
        assert found.last("guide") == pytest.approx(11.0 * way, rel=1e-14)


def begins(train: Train) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """How the groups of a train begin to turn, and its clutches to slip."""
    system = TrainSystem(train)
    state, z = system.start()
    begun = system.react(state, 0.0, z, None).mode
    assert isinstance(begun, State)
    return begun.turning, begun.clutches


@pytest.mark.parametrize(("torque", "speed"), [(12.9, 0.0), (15.0, 2.0), (-12.9, 0.0), (-15.0, -2.0)])
@pytest.mark.parametrize("brake", [10.0, 3.0])
def test_what_a_brake_and_a_clutch_to_a_prescribed_body_hold_is_what_both_do(
    torque: float, speed: float, brake: float
) -> None:
    """10 and 3 or 3 and 10, on a body beside one that is told to stay; what is held tells nothing."""
    train = Train(
        (Body("told", 1.0), Body("b", 1.0)),
        grips=(Grip("brake", 1, None, Signal.constant(brake)), Grip("clutch", 1, 0, Signal.constant(13.0 - brake))),
        drives=(Drive.of("d", 1, Signal.constant(torque)),),
        guides=(Guide("g", 0),),
    )
    found = run(train, 1.0)
    assert (found.last("speed", 0), found.last("speed", 1)) == pytest.approx((0.0, speed), abs=1e-14)
    assert speed or begins(train) == ((NO_FRICTION, 0), (0,))


@pytest.mark.parametrize("way", [1, -1])
def test_what_a_brake_and_a_stop_hold_is_held_until_it_is_pulled_off_the_stop(way: int) -> None:
    """20 N into a rigid stop, falling by 10 N/s; the brake of 5 N gives way at -5 N, and never before."""
    train = Train(
        (Body("m", 2.0),),
        springs=(Spring("stop", 0, None, 0.0, law=RIGID, side=way),),
        grips=(Grip("brake", 0, None, Signal.constant(5.0)),),
        drives=(Drive.of("d", 0, Signal((0.0,), (20.0 * way,), (-10.0 * way,))),),
    )
    assert begins(train)[0] == (0,)
    found = run(train, 3.5)
    assert found.events("brake") == [(pytest.approx(2.5), "at rest", "backward" if way > 0 else "forward")]
    assert found.last("speed") == pytest.approx(-way * 10.0 / 2 / 2.0, rel=1e-12)


class TestBreakingLoose:
    """From rest, under a torque that rises by 1 a second: friction holds as much as it slides with, if nothing else
    is said, and what is between it and the torque has its losses against the motion."""

    @pytest.mark.parametrize("way", [1, -1])
    @pytest.mark.parametrize("ratio", [4.0, -4.0])
    def test_in_front_of_a_gear(self, ratio: float, way: int) -> None:
        train = Train(
            (Body("a", 1.0), Body("b", 5.0)), (Mesh("gear", 0, 1, ratio, 0.8, 0.75),),
            grips=(Grip("brake", 0, None, Signal.constant(3.0)),),
            drives=(Drive.of("load", 1, Signal((0.0,), (0.0,), (1.0 * way,))),),
        )  # fmt: skip
        loose = 3.0 * 4.0 / 0.75
        found = run(train, loose + 1.0)
        word = "forward" if way * ratio > 0 else "backward"
        assert found.events() == [(pytest.approx(loose, rel=1e-12), "at rest", word)]
        assert found.last("speed", 1) == pytest.approx(way * (0.5 / (5.0 + 16.0 / 0.75)), rel=1e-9)

    @pytest.mark.parametrize("way", [1, -1])
    @pytest.mark.parametrize("ratio", [4.0, -4.0])
    def test_behind_a_gear(self, ratio: float, way: int) -> None:
        train = Train(
            (Body("a", 1.0), Body("b", 5.0)), (Mesh("gear", 0, 1, ratio, 0.8, 0.75),),
            grips=(Grip("brake", 1, None, Signal.constant(16.0)),),
            drives=(Drive.of("motor", 0, Signal((0.0,), (0.0,), (1.0 * way,))),),
        )  # fmt: skip
        loose = 16.0 / 4.0 / 0.8
        found = run(train, loose + 1.0)
        assert found.events() == [(pytest.approx(loose, rel=1e-12), "at rest", "forward" if way > 0 else "backward")]
        assert found.last("speed", 0) == pytest.approx(way * (0.5 / (1.0 + 5.0 / 16.0 / 0.8)), rel=1e-9)

    @pytest.mark.parametrize("way", [1, -1])
    def test_behind_a_clutch_that_bears_more(self, way: int) -> None:
        train = Train(
            (Body("a", 1.0), Body("b", 5.0)),
            grips=(Grip("brake", 0, None, Signal.constant(3.0)), Grip("clutch", 0, 1, Signal.constant(4.0))),
            drives=(Drive.of("load", 1, Signal((0.0,), (0.0,), (1.0 * way,))),),
        )
        found = run(train, 4.0)
        assert found.events() == [(pytest.approx(3.0, rel=1e-12), "at rest", "forward" if way > 0 else "backward")]
        assert [found.last("speed", k) for k in (0, 1)] == pytest.approx([way * 0.5 / 6.0] * 2, rel=1e-12)


def test_a_gear_without_slip_in_its_brake_carries_the_load_as_its_ratio_says() -> None:
    """At rest there is no direction for the losses: the brake in front of the gear holds T/i."""
    train = Train(
        (Body("a", 1.0), Body("b", 5.0)),
        (Mesh("gear", 0, 1, 4.0, 0.8, 0.75),),
        grips=(Grip("brake", 0, None, Signal.constant(50.0)),),
        drives=(Drive.of("load", 1, Signal.constant(-20.0)),),
    )
    found = run(train, 1.0)
    assert found.last("grip") == pytest.approx(-5.0, rel=1e-14)
    assert found.last("mesh") == pytest.approx(20.0, rel=1e-14)
    assert found.last("mesh_inner") == pytest.approx(5.0, rel=1e-14)


class TestJams:
    WORM = Mesh("worm", 0, 1, 20.0, 0.4, 2 - 1 / 0.4)

    def test_only_the_gear_that_locks_itself_and_only_if_it_moves(self) -> None:
        """Beside a gear that jams, one that can be driven back runs on, and one at rest tells nothing."""
        train = Train(
            (Body("a", 1.0, 0.0, 3.0), Body("b", 1e4, 0.0, 0.15), Body("c", 1.0, 0.0, 2.0), Body("d", 1.0, 0.0, 1.0),
             Body("e", 1.0), Body("f", 1e4)),
            (self.WORM, Mesh("good", 2, 3, 2.0, 0.9, 0.85), Mesh("still", 4, 5, 20.0, 0.4, 2 - 1 / 0.4)),
            drives=(Drive.of("m", 0, Signal.constant(-20.0)),),
        )  # fmt: skip
        found = run(train, 0.1)
        assert [event for event in found.events() if event[2] == "jammed"] == [(0.0, "turning", "jammed")]
        assert found.events("worm")[0] == (0.0, "turning", "jammed")
        assert found.events("good") == found.events("still") == []
        assert [found.last("speed", k) for k in (2, 3, 4, 5)] == pytest.approx([2.0, 1.0, 0.0, 0.0], rel=1e-14)
        assert found.ledger.shocks == pytest.approx((9.0 + 1e4 * 0.15**2) / 2, rel=1e-12)


def test_a_governed_speed_driven_from_both_sides_of_its_limit() -> None:
    """clip(10 (r - v), -2, 2) with r from 1 to -1: in control, at its limit backward, in control again."""
    reference = Signal((0.0, 4.0), (1.0, -1.0), (0.0, 0.0))
    train = Train((Body("m", 2.0, 0.0, 1.0),), drives=(Drive.of("d", 0, Governed(reference, 10.0, 2.0)),))
    found = run(train, 9.0)
    assert [word for _, _, word in found.events("d")] == ["at its limit backward", "in control"]
    assert found.times("d") == pytest.approx([4.0, 4.0 + 1.8], rel=1e-12)
    assert found.last("speed") == pytest.approx(-1.0 + 0.2 * math.exp(-5.0 * 3.2), rel=1e-10)


def test_what_creeps_beside_something_fast_is_not_at_rest() -> None:
    """A ten thousand millionth of the other's speed, until its own friction stops it."""
    train = Train(
        (Body("fast", 1.0, 0.0, 1.0), Body("slow", 2.0, 0.0, 1e-10), Body("c", 1.0, 0.0, 3e-10), Body("d", 1.0)),
        grips=(Grip("b", 1, None, Signal.constant(4e-10)), Grip("clutch", 2, 3, Signal.constant(2e-10))),
    )
    found = run(train, 2.0)
    assert found.events("b") == [(pytest.approx(0.5, rel=1e-9), "forward", "at rest")]
    assert found.events("clutch") == [(pytest.approx(0.75, rel=1e-9), "slips forward", "locked")]


class TestSizes:
    """Forces, speeds and places many times as small or large: the same events, and all else in scale."""

    def moved(self, of: float) -> Run:
        train = Train(
            (Body("a", 1.0, 0.0, 2.0 * of), Body("b", 3.0), Body("c", 1.0, 0.0, -of), Body("ball", 1.0, 0.3 * of)),
            springs=(Spring("floor", 3, None, 0.0, law=RIGID, side=-1, restitution=0.5),),
            grips=(
                Grip("brake", 1, None, Signal.constant(1.5 * of), 1.2),
                Grip("clutch", 0, 2, Signal.constant(0.5 * of)),
            ),
            drives=(Drive.of("weight", 3, Signal.constant(-2.0 * of)),),
            impulses=(Impulse(1, 2.0, 4.0 * of),),
        )
        return run(train, 5.0)

    @pytest.mark.parametrize("of", [2.0**-20, 2.0**50])
    def test_change_nothing(self, of: float) -> None:
        one, other = self.moved(1.0), self.moved(of)
        assert len(one.events()) >= 4
        assert [event[1:] for event in one.events()] == [event[1:] for event in other.events()]
        assert one.times() == pytest.approx(other.times(), rel=1e-7)
        for body in range(4):
            assert other.last("speed", body) == pytest.approx(of * one.last("speed", body), rel=1e-9, abs=1e-12 * of)

    @pytest.mark.parametrize("of", [1e-17, 1e17])
    def test_of_what_is_light_or_heavy_do_not_either(self, of: float) -> None:
        """Inertias and torques of a watch: v = T t/(J_1 + J_2/i^2)."""
        train = Train(
            (Body("a", 1.0 * of), Body("b", 8.0 * of)), (Mesh("g", 0, 1, 2.0, 0.8, 0.75),),
            drives=(Drive.of("d", 0, Signal.constant(7.0 * of)), Drive.of("load", 1, Signal.constant(-4.0 * of))),
        )  # fmt: skip
        found = run(train, 3.0)
        assert found.last("speed", 0) == pytest.approx(3.0 * (7.0 - 4.0 / 1.6) / (1.0 + 8.0 / 3.2), rel=1e-13)

    def test_a_blow_however_small_is_one(self) -> None:
        """Against a brake that stops it within half a second."""
        train = Train(
            (Body("m", 1.0),), grips=(Grip("b", 0, None, Signal.constant(2e-17)),), impulses=(Impulse(0, 0.5, 1e-17),)
        )
        found = run(train, 2.0)
        assert [after for _, _, after in found.events("b")] == ["forward", "at rest"]
        assert found.times("b") == pytest.approx([0.5, 1.0], rel=1e-12)

    def test_a_prescribed_speed_however_small_is_one(self) -> None:
        train = Train(
            (Body("a", 1.0, 0.0, 1e-17),), grips=(Grip("b", 0, None, Signal.constant(2.0)),),
            guides=(Guide("g", 0, Signal((0.0, 1.0), (0.0, -1e-17), (0.0, 0.0))),),
        )  # fmt: skip
        found = run(train, 3.0)
        assert [after for _, _, after in found.events("b")][-1] == "backward"
        assert found.times("b")[0] == pytest.approx(2.0, rel=1e-12)


def test_two_prescribed_bodies_in_contact_do_not_push_each_other() -> None:
    """They go side by side; a blow elsewhere says nothing of them."""
    train = Train(
        (Body("a", 1.0, 0.0, 1.0), Body("b", 1.0, 0.0, 1.0), Body("c", 1.0, 0.5), Body("d", 1.0, 0.5)),
        springs=(
            Spring("ab", 0, 1, 0.0, law=RIGID, side=1),
            Spring("cd", 2, 3, 0.0, law=RIGID, side=1),
        ),
        guides=(Guide("g", 0), Guide("h", 1)),
        impulses=(Impulse(2, 0.5, 1.0),),
    )
    found = run(train, 1.0)
    assert [found.last("speed", k) for k in range(4)] == pytest.approx([1.0, 1.0, 0.5, 0.5], rel=1e-14)


def test_what_no_state_can_hold_is_told() -> None:
    with pytest.raises(NumericsError, match="prescribed motions") as told:
        run(
            Train(
                (Body("a", 1.0, 0.0, 1.0), Body("b", 1.0, 1.0, -1.0)),
                springs=(Spring("ab", 0, 1, 0.0, law=RIGID, side=1),),
                guides=(Guide("g", 0), Guide("h", 1)),
            ),
            2.0,
        )
    assert told.value.code == "NUM101"
