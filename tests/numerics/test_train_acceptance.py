"""Contact after contact, a brake that holds, a gear that sticks: against an independent integration and by hand."""

import math

import pytest
from scipy.optimize import brentq
from support.hybrid import Course, Link, Machine, Torque, simulate
from support.trains import run, train_of

from ptmcalc.numerics.train.parts import Body, Drive, Grip, Mesh, Train
from ptmcalc.numerics.train.signals import Signal, Sine


@pytest.mark.parametrize("law", ["clamped", "no_pull", "kelvin"])
def test_two_inertias_with_a_gap_over_many_contacts(law: str) -> None:
    """Started from rest with a torque that turns round: closings, limits of the damper and openings."""
    torque = Torque(0, Course(((0.0, 10.0, 0.0), (0.5, -8.0, 1.0))))
    chosen = Machine((1.0, 3.0), (0.0, 0.0), (0.0, 0.0), (Link(0, 1, 1e4, 5.0, 0.01, law),), torques=(torque,))
    other, found = simulate(chosen, 1.5), run(train_of(chosen), 1.5)
    changes = [event for event in found.events("l0") if event[1] != event[2]]
    assert len(changes) >= 20
    for what, index in (("link", 0), ("speed", 0), ("speed", 1), ("position", 1)):
        size = max(abs(other.highest[what, index]), abs(other.lowest[what, index]))
        assert found.top(what, index) == pytest.approx(other.highest[what, index], abs=1e-8 * size)
        assert found.bottom(what, index) == pytest.approx(other.lowest[what, index], abs=1e-8 * size)
    assert [found.last("position", body) for body in (0, 1)] == pytest.approx(other.positions, rel=1e-9)
    other_changes = [time for time, kind, _, to in other.events if kind == "link" and to[0] in ("open", "none")]
    opened = [time for time, _, after in found.events("l0") if after == "open"]
    assert opened == pytest.approx([t for t in other_changes if any(abs(t - o) < 1e-6 for o in opened)], abs=1e-9)


def test_a_brake_stops_a_mass_and_holds_it() -> None:
    """100 kg, 1 m/s, 50 N: at rest after 2 s and 1 m, with speed 0 to the last digit."""
    train = Train((Body("m", 100.0, 0.0, 1.0),), grips=(Grip("brake", 0, None, Signal.constant(50.0)),))
    found = run(train, 1000.0)
    assert found.events("brake") == [(pytest.approx(2.0, rel=1e-14), "forward", "at rest")]
    assert found.last("speed") == 0.0
    assert found.last("position") == pytest.approx(1.0, rel=1e-14)
    assert found.ledger.lost["brake"] == pytest.approx(50.0, rel=1e-13)


def test_two_brakes_with_a_locked_clutch_between_hold_no_more_than_both() -> None:
    """Neither side alone can move; together they can."""

    def at(torque: float, clutch: float) -> tuple[float, float]:
        train = Train(
            (Body("a", 1.0), Body("b", 1.0)),
            grips=(
                Grip("one", 0, None, Signal.constant(10.0)),
                Grip("other", 1, None, Signal.constant(10.0)),
                Grip("clutch", 0, 1, Signal.constant(clutch)),
            ),
            drives=(Drive.of("drive", 0, Signal.constant(torque)),),
        )
        found = run(train, 1.0)
        return found.last("speed", 0), found.last("speed", 1)

    assert at(19.9, 1000.0) == (0.0, 0.0)
    assert at(100.0, 1000.0) == pytest.approx((40.0, 40.0))
    assert at(12.9, 3.0) == (0.0, 0.0)
    assert at(15.0, 3.0) == pytest.approx((2.0, 0.0), abs=1e-14)


def test_a_lossy_gear_under_a_sine_torque_goes_backward_sticks_goes_forward_and_sticks() -> None:
    """J1 = 1, J2 = 8 behind a ratio of 2, efficiencies 0.5 and 0.2, a load of 6 that pulls backward, M = 3.3 - 4 sin t.

    At rest the gear holds any motor torque from 6 0.2/2 = 0.6 to 6/(2 0.5) = 6. Below it goes backward with
    (J1 + 0.2 J2/4) a = M - 0.6, above forward with (J1 + J2/(4 0.5)) a = M - 6, until its speed is 0 again: until the
    integral of the right side is. The torque on the outer body, 6 + J2 a/2, keeps its sign all the time.
    """
    down, up = 0.6, 6.0

    def torque(t: float) -> float:
        return 3.3 - 4 * math.sin(t)

    def gained(a: float, b: float, holding: float) -> float:
        return (3.3 - holding) * (b - a) + 4 * (math.cos(b) - math.cos(a))

    back = math.asin((3.3 - down) / 4)
    stuck = brentq(lambda t: gained(back, t, down), math.pi - back, 5.0, xtol=1e-15)
    forward = math.pi + math.asin((up - 3.3) / 4)
    stuck_again = brentq(lambda t: gained(forward, t, up), 3 * math.pi - forward, 8.0, xtol=1e-15)
    assert down < torque(stuck) < up
    assert down < torque(stuck_again) < up
    assert back < stuck < forward < stuck_again
    train = Train(
        (Body("motor", 1.0), Body("load", 8.0)),
        (Mesh("gear", 0, 1, 2.0, 0.5, 0.2),),
        drives=(
            Drive.of("motor", 0, Signal(values=(3.3,), sines=(Sine(4.0, 1.0, math.pi),))),
            Drive.of("load", 1, Signal.constant(-6.0)),
        ),
    )
    found = run(train, 6.9)
    after = [(time, now) for time, _, now in found.events("gear")]
    assert [now for _, now in after] == ["backward", "at rest", "forward", "at rest"]
    assert [time for time, _ in after] == pytest.approx([back, stuck, forward, stuck_again], abs=1e-9)
    assert found.last("speed", 0) == found.last("speed", 1) == 0.0
    turned = found.last("position", 0)
    assert found.last("position", 1) == pytest.approx(turned / 2, rel=1e-12)
