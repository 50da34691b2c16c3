"""Rigid contacts, impulses and prescribed motion against balances of momentum and force by hand."""

import math

import numpy as np
import pytest
from support.trains import Run, run

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.train.parts import RIGID, Body, Drive, Grip, Guide, Impulse, Mesh, Spring, Train
from ptmcalc.numerics.train.react import _pushes
from ptmcalc.numerics.train.signals import Signal, Sine

G = 9.81
FLOOR = Spring("floor", 0, None, 0.0, law=RIGID, side=-1)
FALL = Drive.of("weight", 0, Signal.constant(-G))


class TestRigidContacts:
    @pytest.mark.parametrize("leaves", [1e-3, 1e-10])
    def test_what_leaves_is_not_held_back_however_slowly(self, leaves: float) -> None:
        """Beside a contact that is struck at 1 m/s, on a body of its own."""
        push, after = _pushes(np.diag([0.5, 0.25]), np.array([1.0, -leaves]), np.array([0.0, 0.0]), 0.0)
        assert push.tolist() == [2.0, 0.0]
        assert after.tolist() == [0.0, -leaves]

    def test_light_and_heavy_bodies_are_struck_at_once(self) -> None:
        """A hundred grammes on one contact and ten million tonnes on another."""
        push, after = _pushes(np.diag([10.0, 1e-10]), np.array([1.0, 2.0]), np.zeros(2), 0.0)
        assert push == pytest.approx([0.1, 2e10], rel=1e-12)
        assert after.tolist() == [0.0, 0.0]

    @pytest.mark.parametrize("restitution", [0.0, 0.3, 0.5, 0.9])
    def test_bounces_end_at_the_sum_of_their_series(self, restitution: float) -> None:
        floor = Spring("floor", 0, None, 0.0, law=RIGID, side=-1, restitution=restitution)
        found = run(Train((Body("m", 1.0, 0.1),), springs=(floor,), drives=(FALL,)), 5.0)
        first = math.sqrt(0.2 / G)
        exact = first * (1 + restitution) / (1 - restitution)
        assert found.times("floor")[-1] == pytest.approx(exact, rel=1e-9)
        assert found.last("speed") == found.last("position") == 0.0
        assert found.ledger.shocks == pytest.approx(G * 0.1, rel=1e-9)
        assert found.last("link") == pytest.approx(-G)

    def test_a_full_rebound_loses_nothing(self) -> None:
        floor = Spring("floor", 0, None, 0.0, law=RIGID, side=-1, restitution=1.0)
        found = run(Train((Body("m", 1.0, 0.1),), springs=(floor,), drives=(FALL,)), 5.0)
        assert found.top("position") == pytest.approx(0.1, rel=1e-9)
        assert found.ledger.shocks == pytest.approx(0.0, abs=1e-12)

    @pytest.mark.parametrize("restitution", [0.0, 0.4, 1.0])
    def test_two_free_masses_collide(self, restitution: float) -> None:
        train = Train(
            (Body("a", 2.0, 0.0, 3.0), Body("b", 5.0, 1.0, -1.0)),
            springs=(Spring("contact", 0, 1, 0.0, law=RIGID, side=1, restitution=restitution),),
        )
        found = run(train, 2.0)
        mean, relative = (2.0 * 3.0 - 5.0) / 7.0, 4.0
        exact = [mean - restitution * relative * 5 / 7, mean + restitution * relative * 2 / 7]
        assert [found.last("speed", body) for body in (0, 1)] == pytest.approx(exact, rel=1e-13, abs=1e-14)
        reduced = 2.0 * 5.0 / 7.0
        assert found.ledger.shocks == pytest.approx(reduced * relative**2 / 2 * (1 - restitution**2), abs=1e-12)

    def test_a_mass_that_rests_against_a_wall_does_not_go_through_when_struck(self) -> None:
        train = Train(
            (Body("a", 1.0, 0.0, 1.0), Body("b", 1.0, 1.0)),
            springs=(
                Spring("ab", 0, 1, 0.0, law=RIGID, side=1),
                Spring("wall", 1, None, 0.0, law=RIGID, side=1, rest=1.0),
            ),
            drives=(Drive.of("press", 1, Signal.constant(1e-3)),),
        )
        found = run(train, 3.0)
        assert found.top("position", 1) == pytest.approx(1.0, abs=1e-14)
        assert found.last("speed", 0) == found.last("speed", 1) == 0.0

    def test_prescribed_motion_into_a_wall_is_a_finding(self) -> None:
        wall = Spring("wall", 0, None, 0.0, law=RIGID, side=1, rest=1.0)
        with pytest.raises(NumericsError, match="prescribed") as raised:
            run(Train((Body("a", 1.0, 0.0, 1.0),), springs=(wall,), guides=(Guide("g", 0),)), 2.0)
        assert raised.value.code == "NUM101"


class TestImpulses:
    def struck(self, size: float, restitution: float = 0.0) -> Run:
        floor = Spring("floor", 0, None, 0.0, law=RIGID, side=-1, restitution=restitution)
        return run(Train((Body("m", 2.0),), springs=(floor,), drives=(FALL,), impulses=(Impulse(0, 0.5, size),)), 1.0)

    def test_of_a_free_mass(self) -> None:
        found = run(Train((Body("m", 2.0),), impulses=(Impulse(0, 0.25, 3.0),)), 1.0)
        assert (found.last("speed"), found.last("position")) == pytest.approx((1.5, 1.5 * 0.75), rel=1e-14)

    def test_into_the_floor_changes_nothing(self) -> None:
        found = self.struck(-4.0)
        assert found.last("speed") == found.last("position") == 0.0

    def test_into_the_floor_with_restitution_throws_up(self) -> None:
        found = self.struck(-4.0, restitution=0.5)
        assert found.top("speed") == pytest.approx(1.0, rel=1e-13)

    def test_up_from_the_floor(self) -> None:
        assert self.struck(4.0).top("position") == pytest.approx(4.0 / G, rel=1e-12)  # v^2/(2 a), a = g/2

    def test_breaks_a_locked_clutch_free_for_a_moment(self) -> None:
        """Friction is finite, the impulse is not: 3/1 m/s at once, then the clutch takes both along."""
        train = Train(
            (Body("a", 1.0), Body("b", 2.0)),
            grips=(Grip("clutch", 0, 1, Signal.constant(6.0)),),
            impulses=(Impulse(0, 0.5, 3.0),),
        )
        found = run(train, 2.0)
        assert found.top("speed", 0) == pytest.approx(3.0)
        assert found.last("speed", 0) == found.last("speed", 1) == pytest.approx(1.0, rel=1e-13)
        assert found.times("clutch") == pytest.approx([0.5, 0.5 + 3.0 / (6.0 + 3.0)], rel=1e-13)


class TestPrescribedMotion:
    def test_carries_the_friction_of_its_bearing(self) -> None:
        """v = 1.5 sin 2t: force m a + 10 sign v."""
        motion = Signal(sines=(Sine(3.0, 2.0, math.pi / 2),))
        train = Train(
            (Body("a", 2.0),), grips=(Grip("b", 0, None, Signal.constant(10.0)),), guides=(Guide("g", 0, motion),)
        )
        found = run(train, 4.0)
        assert found.top("guide") == pytest.approx(16.0, rel=1e-12)
        assert found.times("b") == pytest.approx([math.pi / 2, math.pi], rel=1e-12)
        assert found.top("position") == pytest.approx(1.5, rel=1e-12)

    def test_carries_the_losses_of_its_gear(self) -> None:
        """A load of 20 behind a ratio of 2 with efficiency 0.5 needs 20."""
        train = Train(
            (Body("a", 1.0, 0.0, 1.0), Body("b", 1.0, 0.0, 0.5)),
            (Mesh("gear", 0, 1, 2.0, 0.5, 0.0),),
            drives=(Drive.of("load", 1, Signal.constant(-20.0)),),
            guides=(Guide("g", 0),),
        )
        assert run(train, 1.0).last("guide") == pytest.approx(20.0, rel=1e-13)

    def test_comes_to_rest_and_stays(self) -> None:
        points = ((0.0, 0.0), (1.0, 0.0), (1.0001, 2.0), (2.0, 2.0), (2.0001, -2.0), (3.0, -2.0), (3.0001, 0.0))
        train = Train(
            (Body("a", 1.0),),
            grips=(Grip("b", 0, None, Signal.constant(5.0)),),
            guides=(Guide("g", 0, Signal.through(points)),),
        )
        found = run(train, 5.0)
        assert found.events("b")[-1][2] == "at rest"
        assert found.last("speed") == found.last("guide") == 0.0


class TestSelfLocking:
    def test_a_worm_holds_its_load_without_a_brake(self) -> None:
        worm = Mesh("worm", 0, 1, 20.0, 0.4, 2 - 1 / 0.4)
        train = Train((Body("a", 1.0), Body("b", 5.0)), (worm,), drives=(Drive.of("load", 1, Signal.constant(-20.0)),))
        found = run(train, 100.0)
        assert found.last("speed", 1) == 0.0
        assert found.events() == []

    def test_must_be_pushed_down(self) -> None:
        """T_in = 20 (2 - 1/0.4)/20 = -0.5: nothing at -0.49, and (J1 + e J2/u) a = -0.1 at -0.6."""
        worm = Mesh("worm", 0, 1, 20.0, 0.4, 2 - 1 / 0.4)

        def at(torque: float) -> float:
            drives = (Drive.of("load", 1, Signal.constant(-20.0)), Drive.of("motor", 0, Signal.constant(torque)))
            return run(Train((Body("a", 1.0), Body("b", 5.0)), (worm,), drives=drives), 1.0).last("speed", 0)

        assert at(-0.49) == 0.0
        assert at(-0.6) == pytest.approx(-0.1 / (1 - 0.5 * 5 / 400), rel=1e-12)

    def test_jams_when_braked_from_the_motor(self) -> None:
        """J1 < (1/0.4 - 2) J2/u^2: the load cannot be driven back through it, everything stops at once."""
        worm = Mesh("worm", 0, 1, 20.0, 0.4, 2 - 1 / 0.4)
        train = Train(
            (Body("a", 1.0, 0.0, 1.0), Body("b", 1e4, 0.0, 0.05)),
            (worm,),
            drives=(Drive.of("m", 0, Signal.constant(-20.0)),),
        )
        found = run(train, 5.0)
        assert found.events("worm")[0] == (0.0, "turning", "jammed")
        assert found.last("speed", 0) < 0
