"""Drums at one place, fed with waves of known course, against closed forms and scipy's DOP853 with events."""

import itertools
import math
from collections.abc import Callable, Sequence

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.belt.station import Drum, Place, Seen, Station, TakeUp, Torque, follow

ON, OFF = 184e3, 72e3
"""Impedances before and behind the drums, those of BW-02 [N*s/m]."""
Wave = Callable[[float], float]


def place(
    friction: tuple[float, float] = (0.0, 0.0),
    drag: tuple[float, float] = (0.0, 0.0),
    climb: float = 0.0,
    line_mass: float = 0.0,
) -> Place:
    return Place(ON, OFF, climb, 0.0, *friction, *drag, line_mass)


def constant(force: float) -> Torque:
    return lambda time, speed: (force, 0.0)


def over_time(force: Wave) -> Torque:
    return lambda time, speed: (force(time), 0.0)


def fed(station: Station, n_on: Wave, p_off: Wave, window: float, steps: int, speed: float = 0.0) -> list[Seen]:
    """Histories of a station that gets these waves."""
    step = window / steps
    seen = [station.begin(speed, n_on(0.0), p_off(0.0))]
    seen += [station.advance(k * step, n_on(k * step), p_off(k * step), step) for k in range(1, steps + 1)]
    return seen


def ode(rates: Callable[[float, np.ndarray], Sequence[float]], end: float, start: Sequence[float]) -> np.ndarray:
    return solve_ivp(rates, (0.0, end), start, "DOP853", rtol=1e-11, atol=1e-12).y[:, -1]


def swaying(mean: float, size: float, pace: float) -> Wave:
    return lambda time: mean + size * math.sin(pace * time)


# -- one drum that sticks -------------------------------------------------------------------------------------------


@given(
    st.floats(1e-9, 1e9), st.floats(1e-7, 1e3), st.floats(-1e6, 1e6), st.floats(-1e6, 1e6), st.floats(-1e6, 1e6)
)  # fmt: skip
def test_forces_linear_in_time_are_exact_whatever_the_step(
    mass: float, step: float, force: float, wave: float, rate: float
) -> None:
    """m v' + (Z_u + Z_d) v = F + P - N over one step of any length beside m/Z."""
    z = ON + OFF
    station = Station(place(), [Drum("drum", mass, constant(force))])
    seen = fed(station, lambda t: wave, lambda t: rate * t / step, step, 1)[-1]
    tau = mass / z
    x = step / tau
    settled = -math.expm1(-x)
    # particular solution of the ramp: rate (t - tau (1 - exp))/step
    ramp = x / 2 - x * x / 6 if x < 1e-4 else 1 - settled / x
    expected = (force - wave) / z * settled + rate / z * ramp
    scale = (abs(force) + abs(wave) + abs(rate)) / z * min(x, 1.0)
    assert seen.belt == pytest.approx(expected, abs=1e-7 * scale + 1e-300)


def test_tensions_are_those_of_the_waves_less_what_the_belt_speed_takes() -> None:
    station = Station(place(climb=5e3), [Drum("drum", 4e4, constant(2e5))])
    seen = fed(station, swaying(1e5, 2e4, 3.0), swaying(8e4, 1e4, 2.0), 1.0, 50)[-1]
    n, p = 1e5 + 2e4 * math.sin(3.0), 8e4 + 1e4 * math.sin(2.0)
    assert seen.tensions == (pytest.approx(n + 5e3 + ON * seen.belt), pytest.approx(p - OFF * seen.belt))
    assert seen.behind == seen.belt == seen.drums[0]


def test_second_order_for_smooth_waves_and_a_motor_curve() -> None:
    """A curve that first rises steeper than the belt resists: m v' = F(v) + P - N - (Z_u + Z_d) v."""
    mass, n, p = 30e3, swaying(1e5, 4e4, 3.0), swaying(9e4, 2e4, 2.0)

    def curve(speed: float) -> tuple[float, float]:
        slip = 1 - speed / 0.9
        bottom = slip**2 + 0.16
        return 3.6e5 * slip / bottom, -3.6e5 * (0.16 - slip**2) / bottom**2 / 0.9

    assert max(curve(v)[1] for v in np.linspace(0, 0.8, 99)) > ON + OFF - 1e5
    true = ode(lambda t, y: [(curve(y[0])[0] + p(t) - n(t) - (ON + OFF) * y[0]) / mass], 1.0, [0.0])[0]
    gaps = []
    for steps in (50, 100, 200):
        station = Station(place(), [Drum("drum", mass, lambda time, speed: curve(speed))])
        gaps.append(abs(fed(station, n, p, 1.0, steps)[-1].belt - true))
    assert gaps[2] < 1e-4 * abs(true)
    assert all(3.0 < a / b < 5.5 for a, b in itertools.pairwise(gaps))


def test_a_drive_that_pulls_harder_the_faster_it_turns_grows_as_it_must() -> None:
    """Z_u + Z_d - dF/dv below, at and above 0: exact exponentials in long steps."""
    for excess in (-2e5, 0.0, 1e-9, 2e5):
        slope = ON + OFF + excess
        station = Station(place(), [Drum("drum", 1e5, lambda time, speed, s=slope: (4e4 + s * speed, s))])
        seen = fed(station, lambda t: 0.0, lambda t: 0.0, 2.0, 4)[-1]
        rate = excess / 1e5
        expected = 4e4 / 1e5 * (2.0 if abs(rate) < 1e-12 else math.expm1(2 * rate) / rate)
        assert seen.belt == pytest.approx(expected, rel=1e-9)


def test_passing_through_zero_speed_without_friction_keeps_the_order() -> None:
    mass, n = 4e4, swaying(0.0, 2e5, 5.0)
    true = ode(lambda t, y: [(-n(t) - (ON + OFF) * y[0]) / mass], 3.0, [0.0])[0]
    found = [
        fed(Station(place(), [Drum("drum", mass)]), n, lambda t: 0.0, 3.0, steps)[-1].belt for steps in (60, 120, 240)
    ]
    gaps = [abs(belt - true) for belt in found]
    assert all(3.0 < a / b < 5.5 for a, b in itertools.pairwise(gaps))


# -- brakes and friction --------------------------------------------------------------------------------------------


def stop_and_go(force: Wave, hold: Wave, mass: float, end: float, speed: float) -> float:
    """m v' = F - B sgn v - (Z_u + Z_d) v by events: where it stops, it stays as long as |F| <= B."""
    z, now, v = ON + OFF, 0.0, speed
    while now < end:
        if v == 0.0 and abs(force(now)) <= hold(now) + 1e-6:
            ahead = np.linspace(now, end, 200_001)[1:]
            loose = [t for t in ahead if abs(force(t)) > hold(t)]
            if not loose:
                return 0.0
            now = loose[0]
        way = math.copysign(1.0, v or force(now))
        event = lambda t, y, way=way, now=now: way * y[0] + (1e-12 if t <= now + 1e-9 else 0.0)  # noqa: E731
        event.terminal, event.direction = True, -1  # type: ignore[attr-defined]
        run = solve_ivp(
            lambda t, y, way=way: [(force(t) - way * hold(t) - z * y[0]) / mass],
            (now, end), [v], "DOP853", rtol=1e-10, atol=1e-13, events=event,
        )  # fmt: skip
        now, v = float(run.t[-1]), 0.0 if run.status == 1 else float(run.y[0, -1])
    return v


@pytest.mark.parametrize("speed", [0.0, 0.8])
@pytest.mark.parametrize("end", [0.35, 0.8, 1.6, 2.3, 3.1])
def test_stops_holds_and_breaks_loose_as_the_set_valued_law_says(speed: float, end: float) -> None:
    mass, force, hold = 5e4, swaying(2e4, 1.4e5, 4.0), swaying(8e4, 3e4, 1.3)
    true = stop_and_go(force, hold, mass, end, speed)
    station = Station(place(), [Drum("drum", mass, over_time(force), hold)])
    found = fed(station, lambda t: 0.0, lambda t: 0.0, end, round(end * 2000), speed)[-1].belt
    assert found == pytest.approx(true, abs=2e-4)


def test_exactly_the_friction_holds_and_the_next_number_does_not() -> None:
    for way in (1.0, -1.0):
        for force, moves in ((7e4, False), (7e4 * (1 + 1e-12), True)):
            station = Station(place(friction=(3e4, 1e4)), [Drum("drum", 1e3, constant(way * force), lambda t: 3e4)])
            seen = fed(station, lambda t: 0.0, lambda t: 0.0, 1.0, 3)
            assert (seen[-1].belt * way > 0) is moves
            assert abs(seen[-1].belt) < 1e-12


def test_what_a_held_drum_takes_and_what_idlers_take_is_shared_by_their_limits() -> None:
    """At rest on half of all friction, each gives half of its own."""
    station = Station(place(friction=(2e4, 1e4)), [Drum("drum", 1e3, constant(6e4), lambda t: 9e4)])
    seen = fed(station, lambda t: 1e5, lambda t: 1e5, 1.0, 3)[-1]
    assert seen.belt == 0.0
    assert seen.tensions == (pytest.approx(1e5 + 1e4), pytest.approx(1e5 - 5e3))


def test_a_backstop_holds_whichever_drum_has_it() -> None:
    """Three drums held up against 90 kN: the drum with the backstop takes what the others' drives leave."""
    for at in range(3):
        drums = [Drum(f"{j}", 1e4, constant(1e4 * (j + 1)), exponent=9.0, one_way=j == at) for j in range(3)]
        station = Station(place(), drums)
        seen = fed(station, lambda t: 190e3, lambda t: 100e3, 1.0, 20)[-1]
        steps = [above - behind for above, behind in itertools.pairwise(seen.tensions)]
        expected = [1e4 * (j + 1) + (3e4 if j == at else 0.0) for j in range(3)]
        assert seen.belt == 0.0
        assert steps == pytest.approx(expected)


def test_a_backstop_lets_go_forward() -> None:
    station = Station(place(), [Drum("drum", 1e4, over_time(lambda t: 1e5 * t), one_way=True)])
    seen = fed(station, lambda t: 5e4, lambda t: 0.0, 1.0, 1000)
    assert all(one.belt == 0.0 for one in seen[:500])
    assert seen[-1].belt > 0.1


# -- take-ups -------------------------------------------------------------------------------------------------------


def test_a_constant_tension_behind_the_drums() -> None:
    station = Station(place(), [Drum("drum", 4e4, constant(1e5))], TakeUp(6e4))
    n, p = swaying(5e4, 1e4, 2.0), swaying(9e4, 3e4, 3.0)
    seen = fed(station, n, p, 2.0, 4000)[-1]
    true = ode(lambda t, y: [(1e5 + 6e4 - n(t) - ON * y[0]) / 4e4], 2.0, [0.0])[0]
    assert seen.belt == pytest.approx(true, rel=1e-6)
    assert seen.tensions[-1] == 6e4
    assert seen.behind == pytest.approx((p(2.0) - 6e4) / OFF)


@pytest.mark.parametrize("weight", [1e-3, 10.0, 4e3, 1e5, 1e9])
def test_a_weight_that_must_be_moved(weight: float) -> None:
    """m v' = F + T - N - Z_u v and M/4 (v - v_r)' = T0 - T with T = P - Z_d v_r, in second order."""
    mass, rest = 4e4, 6e4
    n, p = swaying(5e4, 2e4, 2.0), swaying(9e4, 3e4, 3.0)

    def rates(t: float, y: np.ndarray) -> list[float]:
        v, apart = y
        tension = p(t) - OFF * (v - apart)
        return [(1e5 + tension - n(t) - ON * v) / mass, (rest - tension) / (weight / 4)]

    if weight < 1:  # stiff: v_r follows at once
        v = ode(lambda t, y: [(1e5 + rest - n(t) - ON * y[0]) / mass], 2.0, [0.0])[0]
        apart = v - (p(2.0) - rest) / OFF
    else:
        v, apart = solve_ivp(rates, (0.0, 2.0), [0.0, 0.0], "Radau", rtol=1e-10, atol=1e-12).y[:, -1]
    gaps = []
    for steps in (200, 400):
        seen = fed(Station(place(), [Drum("drum", mass, constant(1e5))], TakeUp(rest, weight)), n, p, 2.0, steps)[-1]
        gaps.append(abs(seen.belt - v) + abs(seen.behind - (v - apart)))
    assert gaps[1] < 2e-4
    assert gaps[0] / gaps[1] > 3.0 or gaps[1] < 1e-6


def test_a_weight_feels_no_more_than_the_jump_of_a_drum_without_mass() -> None:
    """The drum jumps to F/(Z_u + Z_d) as if the weight were a wall, and both then come to where it is none."""
    station = Station(place(), [Drum("drum", 0.0, over_time(lambda t: 1e5 if t > 0 else 0.0))], TakeUp(6e4, 4e4))
    seen = fed(station, lambda t: 6e4, lambda t: 6e4, 4.0, 4000)
    jump = 1e5 / (ON + OFF)
    assert seen[1].belt == pytest.approx(jump, rel=1e-2)
    assert min(one.tensions[-1] for one in seen) == pytest.approx(6e4 - OFF * jump, rel=1e-2)
    assert seen[-1].belt == pytest.approx(1e5 / ON, rel=1e-3)
    assert seen[-1].tensions[-1] == pytest.approx(6e4, rel=1e-3)


def test_a_belt_that_jumps_at_once_takes_its_heavy_weight_along() -> None:
    """A held drum lets an overloaded belt slip from the start: v = v_r, and T is what that asks for, not the weight's.

    N + Z_u v = e T, P - Z_d v = T.
    """
    for friction in (0.0, 1e-3):
        drum = Drum("drum", 1e4, exponent=0.5, one_way=True)
        station = Station(place(friction=(0.0, friction)), [drum], TakeUp(1e5, 4e4))
        e, n = math.exp(0.5), 2.4e5
        seen = station.begin(0.0, n, 1e5)
        v = (e * 1e5 - n) / (ON + e * OFF)
        assert seen.slips == (1,)
        assert (seen.belt, seen.behind) == (pytest.approx(v), pytest.approx(v))
        assert seen.tensions == (pytest.approx(e * (1e5 - OFF * v)), pytest.approx(1e5 - OFF * v))


def test_drag_and_friction_behind_a_take_up_are_the_belts_own() -> None:
    for weight in (0.0, 2e4):
        station = Station(place(friction=(0.0, 1e3), drag=(0.0, 5e3)), [Drum("drum", 1e3)], TakeUp(6e4, weight))
        seen = fed(station, lambda t: 6e4 - ON * 0.5, lambda t: 6e4 + 1e3 + (OFF + 5e3) * 0.5, 20.0, 2000, 0.5)[-1]
        assert (seen.belt, seen.behind) == (pytest.approx(0.5), pytest.approx(0.5))
        assert seen.tensions[-1] == pytest.approx(6e4)


# -- slip -----------------------------------------------------------------------------------------------------------


class Slipping:
    """One drum on a closed belt under F(t) with constant waves: sticks, slips, sticks again, by DOP853 and events."""

    def __init__(self, force: Wave, mass: float, exponent: float, n: float, p: float) -> None:
        self.force, self.mass, self.e, self.n, self.p = force, mass, math.exp(exponent), n, p
        self.slip_belt = (self.e * p - n) / (ON + self.e * OFF)
        self.pull = self.n + ON * self.slip_belt - (p - OFF * self.slip_belt)

    def go(self, end: float) -> tuple[float, float, float, float, list[float]]:
        """Speeds of belt and drum, way and heat of slip, times of change."""
        v, now, slid, changes = 0.0, 0.0, 0.0, []
        slipping = False
        while now < end:
            if not slipping:
                limit = lambda t, y: self.slip_belt - y[0]  # noqa: E731
                rates = lambda t, y: [(self.force(t) + self.p - self.n - (ON + OFF) * y[0]) / self.mass, 0.0]  # noqa: E731
            else:
                limit = lambda t, y, now=now: y[0] - self.slip_belt + (1.0 if t < now + 1e-9 else 0.0)  # noqa: E731
                rates = lambda t, y: [(self.force(t) - self.pull) / self.mass, y[0] - self.slip_belt]  # noqa: E731
            limit.terminal, limit.direction = True, -1  # type: ignore[attr-defined]
            run = solve_ivp(rates, (now, end), [v, slid], "DOP853", rtol=1e-11, atol=1e-13, events=limit, max_step=0.01)
            now, v, slid = float(run.t[-1]), float(run.y[0, -1]), float(run.y[1, -1])
            if run.status == 1:
                slipping, v = not slipping, self.slip_belt
                changes.append(now)
        return (self.slip_belt if slipping else v), v, slid, slid * self.pull, changes


def test_slips_and_sticks_again_at_the_right_times() -> None:
    force = swaying(6e4, 1.6e5, 2.5)
    true = Slipping(force, 2e4, 0.5, 1.2e5, 1.1e5)
    belt, drum, slid, heat, changes = true.go(4.2)
    assert len(changes) >= 3
    gaps = []
    for steps in (1000, 2000, 4000):
        station = Station(place(), [Drum("drum", 2e4, over_time(force), exponent=0.5)])
        seen = fed(station, lambda t: 1.2e5, lambda t: 1.1e5, 4.2, steps)
        flips = [k * 4.2 / steps for k in range(1, steps + 1) if seen[k].slips != seen[k - 1].slips]
        assert flips == pytest.approx(changes, abs=2 * 4.2 / steps)
        assert (seen[-1].belt, seen[-1].drums[0]) == (pytest.approx(belt, abs=2e-3), pytest.approx(drum, abs=2e-3))
        gaps.append(abs(station.slid[0] - slid) / slid)
        assert station.heat[0] == pytest.approx(heat, rel=1e-2)
    assert gaps[2] < 1e-3
    assert gaps[2] < gaps[0]


def test_the_centrifugal_part_of_tension_presses_nothing() -> None:
    """(S_on - l)/(S_off - l) = e while it slips, l = rho v^2."""
    station = Station(place(line_mass=3e3), [Drum("drum", 1e4, constant(4e5), exponent=0.6)], TakeUp(1e5))
    seen = fed(station, lambda t: -1e5, lambda t: 1e5, 2.0, 4000)[-1]
    lift = 3e3 * seen.belt**2
    assert seen.slips == (1,)
    assert lift > 2e3
    assert (seen.tensions[0] - lift) / (1e5 - lift) == pytest.approx(math.exp(0.6), rel=1e-4)


@pytest.mark.parametrize(("split", "slips"), [((200e3, 100e3), (0, 1)), ((215.88e3, 84.12e3), (0, 0))])
def test_the_split_of_bw_10_slips_on_its_second_drum_alone(split: tuple[float, float], slips: tuple[int, int]) -> None:
    """60 kN behind, 360 kN before: 2:1 asks 2.67 of the second drum, which gives 2.57, though both have a tenth left.

    A heavy third party holds the belt, so that the drums' own inertia plays no part.
    """
    drums = [Drum(f"{j}", 1e3, constant(force), exponent=0.3 * math.pi) for j, force in enumerate(split)]
    station = Station(place(), drums, TakeUp(60e3))
    seen = fed(station, lambda t: 360e3 - ON * 0.5, lambda t: 60e3, 0.01, 2000, 0.5)
    assert seen[0].slips == slips
    between = 60e3 * math.exp(0.3 * math.pi) if slips[1] else 60e3 + split[1]
    assert seen[0].tensions == pytest.approx((360e3, between, 60e3))
    assert math.exp(0.6 * math.pi) / (360 / 60) == pytest.approx(1.09768, rel=1e-4)


def test_when_one_drum_slips_the_other_takes_the_rest() -> None:
    """Of two drums on a belt the second slips: e T0 between them, and the first carries the belt with its own force."""
    drums = [Drum("first", 2e4, constant(1.5e5), exponent=3.0), Drum("second", 1e4, constant(1.5e5), exponent=0.5)]
    station = Station(place(), drums, TakeUp(5e4))
    seen = fed(station, lambda t: 5e4, lambda t: 5e4, 3.0, 3000)
    last = seen[-1]
    assert last.slips == (0, 1)
    assert last.tensions[1] == pytest.approx(5e4 * math.exp(0.5))
    assert last.belt == pytest.approx((1.5e5 + 5e4 * math.exp(0.5) - 5e4) / ON, rel=1e-3)
    assert last.tensions[0] - last.tensions[1] == pytest.approx(1.5e5, rel=1e-3)
    traction = 5e4 * math.expm1(0.5)
    assert last.drums[1] == pytest.approx((1.5e5 - traction) / 1e4 * 3.0, rel=0.05)


def test_a_slipping_drum_multiplies_what_a_sticking_one_behind_it_gives() -> None:
    """The first slips: m v' of the second counts e-fold. e (m2 v' + ...) = e F2 + e T0 - N - Z v."""
    e = math.exp(0.4)
    drums = [Drum("first", 1e4, constant(6e5), exponent=0.4), Drum("second", 2e4, constant(4e4), exponent=9.0)]
    station = Station(place(), drums, TakeUp(5e4))
    seen = fed(station, lambda t: 5e4, lambda t: 5e4, 1.0, 4000)
    assert seen[-1].slips == (1, 0)
    true = ode(lambda t, y: [(e * (4e4 + 5e4) - 5e4 - ON * y[0]) / (e * 2e4)], 1.0, [0.0])[0]
    assert seen[-1].belt == pytest.approx(true, rel=1e-4)
    assert seen[-1].tensions[0] == pytest.approx(e * seen[-1].tensions[1])


def test_both_drums_slip_at_once() -> None:
    one = Drum("first", 1e4, constant(3e5), exponent=0.5)
    two = Drum("second", 1e4, constant(3e5), exponent=0.7)
    station = Station(place(), [one, two], TakeUp(5e4))
    seen = fed(station, lambda t: 0.0, lambda t: 5e4, 2.0, 500)[-1]
    assert seen.slips == (1, 1)
    assert seen.tensions == (
        pytest.approx(5e4 * math.exp(1.2)), pytest.approx(5e4 * math.exp(0.7)), pytest.approx(5e4),
    )  # fmt: skip
    assert seen.belt == pytest.approx(5e4 * math.exp(1.2) / ON)
    pulls = 5e4 * (math.exp(1.2) - math.exp(0.7)), 5e4 * math.expm1(0.7)
    for j, pull in enumerate(pulls):
        assert seen.drums[j] == pytest.approx((3e5 - pull) / 1e4 * 2.0, rel=2e-2)


def test_a_torque_step_on_two_drums_does_not_slip_for_what_their_own_mass_takes() -> None:
    """At t = 0 nothing of the force reaches the belt: it turns the drums."""
    drums = [Drum(f"{j}", 1e5, constant(2e5), exponent=1.2) for j in range(2)]
    station = Station(place(), drums, TakeUp(1e5))
    seen = fed(station, lambda t: 1e5, lambda t: 1e5, 0.3, 300)
    assert seen[0].slips == (0, 0)
    assert seen[0].tensions == pytest.approx((1e5, 1e5, 1e5))
    assert 1e5 * math.expm1(1.2) * 0.8 < 2e5  # what the second would ask for if it had no mass
    assert all(one.slips == (0, 0) for one in seen)


def test_slip_that_begins_at_once() -> None:
    """Hardly any mass and five times the grip: it slips from the first sample, and the belt feels the grip alone."""
    station = Station(place(), [Drum("drum", 10.0, constant(5e5), exponent=0.5)], TakeUp(1e5))
    seen = fed(station, lambda t: 1e5, lambda t: 1e5, 1.0, 100)
    assert all(one.slips == (1,) for one in seen[1:])
    assert all(one.tensions[0] == pytest.approx(1e5 * math.exp(0.5)) for one in seen[1:])


def test_a_brake_stops_a_drum_and_the_belt_slides_on() -> None:
    """Grip exp(-mu alpha) while the belt is ahead; the drum is held; both at rest in the end."""
    station = Station(place(), [Drum("drum", 1e3, brake=lambda t: 1e6, exponent=0.5)], TakeUp(1e5))
    seen = fed(station, lambda t: 1e5 - ON * 2.0 * math.exp(-2 * t), lambda t: 1e5, 3.0, 3000, 2.0)
    slid = [one for one in seen[1:] if one.slips == (-1,)]
    assert len(slid) > 500
    assert all(one.tensions[0] == pytest.approx(1e5 * math.exp(-0.5)) for one in slid)
    assert slid[-1].drums[0] == 0.0
    assert seen[-1].belt == 0.0
    assert seen[-1].slips == (0,)
    way = np.trapezoid([abs(one.belt - one.drums[0]) for one in seen], dx=1e-3)
    assert station.slid[0] == pytest.approx(way, rel=1e-3)
    assert station.heat[0] == pytest.approx(way * 1e5 * -math.expm1(-0.5), rel=1e-2)


def test_a_steep_motor_curve_on_a_slipping_drum_of_any_mass() -> None:
    """Slip at 2 m/s where the motor just gives what the grip passes on: F(w) = (e - 1) T0, whatever m."""
    pull = 1e5 * math.expm1(0.5)
    for mass in (0.0, 1e-3, 1.0, 1e3, 1e5):
        motor = lambda time, speed: (2e6 * (2.0 + pull / 2e6 - speed), -2e6)  # noqa: E731
        station = Station(place(), [Drum("drum", mass, motor, exponent=0.5)], TakeUp(1e5))
        seen = fed(station, lambda t: 1e5, lambda t: 1e5, 5.0, 100)
        assert seen[-1].slips == (1,)
        assert seen[-1].drums[0] == pytest.approx(2.0, rel=1e-6)
        assert all(0 <= one.drums[0] <= 2.0 + pull / 2e6 for one in seen)


def test_a_drum_without_mass_that_nothing_can_hold_is_refused() -> None:
    station = Station(place(), [Drum("drum", 0.0, constant(5e5), exponent=0.5)], TakeUp(1e5))
    with pytest.raises(NumericsError, match="without mass"):
        fed(station, lambda t: 1e5, lambda t: 1e5, 1.0, 10)


def test_a_drive_that_would_run_away_within_a_step_is_refused() -> None:
    station = Station(place(), [Drum("drum", 1.0, lambda time, speed: (1e5 + 1e6 * speed, 1e6))])
    with pytest.raises(NumericsError, match="steeply"):
        fed(station, lambda t: 1e5, lambda t: 1e5, 1.0, 10)


def test_a_brake_that_comes_while_the_force_turns_over() -> None:
    """At rest with force one way, then the other way with a brake it overcomes: it goes the new way, once."""
    hold = lambda time: 0.0 if time < 0.05 else 5e4  # noqa: E731
    for way in (1.0, -1.0):
        force = over_time(lambda t, way=way: way * (-1e5 if t < 0.05 else 2e5))
        seen = fed(
            Station(place(), [Drum("drum", 1e4, force, hold)], TakeUp(0.0)), lambda t: 0.0, lambda t: 0.0, 0.1, 1
        )
        assert seen[-1].belt * way > 0


def test_steps_far_longer_than_every_time_constant_neither_ring_nor_alternate() -> None:
    def motor(time: float, speed: float) -> tuple[float, float]:
        return (3e5, 0.0) if time < 5 else (2e4, 0.0)

    drums = [Drum(f"{j}", 5.0, motor, exponent=0.5) for j in range(2)]
    station = Station(place(friction=(1e3, 1e3)), drums, TakeUp(1e5, 5.0))
    seen = fed(station, swaying(1e5, 1e4, 0.3), swaying(1e5, 2e4, 0.2), 40.0, 40)
    assert all(math.isfinite(value) for one in seen for value in (*one.tensions, *one.drums, one.belt, one.behind))
    assert any(one.slips == (1, 1) for one in seen)


# -- imposed speed --------------------------------------------------------------------------------------------------


def test_an_imposed_speed_makes_tensions_of_the_waves_alone() -> None:
    drums = [Drum("first", 3e4, exponent=9.0), Drum("second", 1e4, exponent=9.0)]
    station = Station(place(), drums, None, lambda t: 0.6 * t, (2 / 3, 1 / 3))
    seen = fed(station, swaying(1e5, 1e4, 3.0), swaying(9e4, 1e4, 2.0), 1.0, 100)[-1]
    n, p = 1e5 + 1e4 * math.sin(3.0), 9e4 + 1e4 * math.sin(2.0)
    on, off = n + ON * 0.6, p - OFF * 0.6
    whole = on - off + 4e4 * 0.6
    assert seen.tensions == (pytest.approx(on), pytest.approx(off + whole / 3 - 1e4 * 0.6), pytest.approx(off))
    assert seen.drums == (0.6, 0.6)


def test_imposed_work_is_what_the_belt_takes_and_the_drum_keeps() -> None:
    station = Station(place(), [Drum("drum", 3e4)], None, lambda t: 0.6 * t)
    seen = fed(station, swaying(1e5, 1e4, 3.0), swaying(9e4, 1e4, 2.0), 1.0, 400)
    pull = [(one.tensions[0] - one.tensions[1]) * one.belt for one in seen]
    assert station.work == pytest.approx(np.trapezoid(pull, dx=1 / 400) + 3e4 * 0.36 / 2, rel=1e-4)


def test_a_drum_driven_at_a_speed_may_slip_on_its_belt() -> None:
    station = Station(place(), [Drum("drum", 3e4, exponent=0.5)], TakeUp(1e5), lambda t: 2.0)
    seen = fed(station, lambda t: 1e5, lambda t: 1e5, 1.0, 50)
    assert seen[-1].slips == (1,)
    assert seen[-1].drums == (2.0,)
    assert seen[-1].belt == pytest.approx(1e5 * math.expm1(0.5) / ON)


# -- no drum at all -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("friction", [(0.0, 0.0), (3e3, 1e3)])
def test_a_place_without_drums_is_one_with_a_drum_that_weighs_and_does_nothing(friction: tuple[float, float]) -> None:
    at, (on, off) = place(friction, (40.0, 10.0), climb=2e3), (swaying(1e5, 1e4, 3.0), swaying(9e4, 1e4, 2.0))
    bare, idle = (fed(Station(at, drums), on, off, 4.0, 400, 0.3) for drums in ((), (Drum("idle", 0.0),)))
    assert any(one.belt for one in bare)
    assert any(not one.belt for one in bare) is any(friction)
    for one, other in zip(bare, idle, strict=True):
        assert (one.belt, one.behind) == pytest.approx((other.belt, other.behind), rel=1e-12, abs=1e-12)
        assert one.tensions == pytest.approx(other.tensions, rel=1e-12)


# -- steady motion, and the whole ledger ----------------------------------------------------------------------------


@given(st.floats(0.1, 6.0), st.lists(st.floats(0.1, 1e5), min_size=1, max_size=3), st.floats(0, 1e4))
def test_steady_motion_stays_steady(speed: float, forces: list[float], rubbing: float) -> None:
    drums = [Drum(f"{j}", 1e4, constant(force), exponent=30.0) for j, force in enumerate(forces)]
    station = Station(place(friction=(rubbing, rubbing)), drums)
    off = 1e5
    on = off + sum(forces)
    n, p = on - rubbing - ON * speed, off + rubbing + OFF * speed
    seen = fed(station, lambda t: n, lambda t: p, 10.0, 50, speed)
    expected = [off + sum(forces[j:]) for j in range(len(forces) + 1)]
    for one in seen:
        assert one.belt == pytest.approx(speed, rel=1e-9)
        assert one.tensions == pytest.approx(expected, rel=1e-9)
    assert station.slid == [0.0] * len(forces)


def test_work_of_drives_is_kinetic_energy_heat_and_what_the_belt_gets() -> None:
    """Brake, two drives, slip and re-stick on a closed belt: gaps fall with the step."""
    gaps = []
    for steps in (1000, 4000):
        drums = [
            Drum("first", 2e4, over_time(swaying(6e4, 1.6e5, 2.5)), exponent=0.4),
            Drum("second", 3e4, over_time(swaying(2e4, 9e4, 4.0)), swaying(2e4, 1e4, 3.0), exponent=0.4),
        ]
        station = Station(place(), drums)
        seen = fed(station, lambda t: 1.2e5, lambda t: 1.1e5, 5.0, steps)
        assert {one.slips for one in seen} == {(1, 0), (1, 1), (1, -1)}
        into = np.trapezoid([(one.tensions[0] - one.tensions[-1]) * one.belt for one in seen], dx=5.0 / steps)
        stored = sum(drum.mass * speed**2 / 2 for drum, speed in zip(drums, seen[-1].drums, strict=True))
        gaps.append(abs(station.work - stored - sum(station.heat) - into) / (sum(station.heat) + stored))
    assert gaps[1] < 1e-3
    assert gaps[1] < gaps[0] / 2


@pytest.mark.parametrize(("exponents", "slips"), [((0.2, 3.0), (1, 0)), ((3.0, 0.2), (0, 1)), ((3.0, 2.0), (0, 0))])
def test_of_drums_at_a_speed_those_that_stick_take_what_a_slipping_one_leaves(
    exponents: tuple[float, float], slips: tuple[int, int]
) -> None:
    """Each asks for half of 120 kN: one that grips less passes on e^(mu alpha), whichever it is."""
    drums = [Drum(f"{j}", 1e3, exponent=exponent) for j, exponent in enumerate(exponents)]
    station = Station(place(), drums, TakeUp(60e3), lambda time: 0.5, (0.5, 0.5))
    seen = fed(station, lambda t: 180e3 - ON * 0.5, lambda t: 60e3, 0.1, 50, 0.5)[-1]
    assert seen.slips == slips
    between = {(1, 0): 180e3 / math.exp(0.2), (0, 1): 60e3 * math.exp(0.2), (0, 0): 120e3}[slips]
    assert seen.tensions == pytest.approx((180e3, between, 60e3))


def test_at_a_speed_the_sticking_ones_of_three_share_by_what_they_were_asked_for() -> None:
    """The middle one slips; the others share what is left 2 to 1, their own mass apart."""
    drums = [Drum(f"{j}", 2e3 * (j + 1), exponent=exponent) for j, exponent in enumerate((4.0, 0.1, 4.0))]
    station = Station(place(), drums, TakeUp(60e3), lambda time: 0.5 + 0.3 * time, (0.4, 0.4, 0.2))
    seen = fed(station, lambda t: 200e3 - ON * (0.5 + 0.3 * t), lambda t: 60e3, 0.1, 50, 0.5)[-1]
    first, second, third = (above - behind for above, behind in itertools.pairwise(seen.tensions))
    assert seen.slips == (0, 1, 0)
    assert seen.tensions[1] == pytest.approx(seen.tensions[2] * math.exp(0.1))
    assert first + second + third == pytest.approx(140e3)
    assert first + 2e3 * 0.3 == pytest.approx(2 * (third + 6e3 * 0.3))


# -- a drum that follows another one --------------------------------------------------------------------------------


@pytest.mark.parametrize("leads", ["the one that sticks", "the one that slips"])
def test_a_slipping_drum_or_its_follower_has_the_force_at_the_speed_of_the_leader(leads: str) -> None:
    """m v' = F + e S_off - S_on of the drum that sticks, m u' = F + S_off - e S_off of the one behind that slips."""
    on, off, exponent, masses, window = 60e3, 80e3, 0.05, (4000.0, 800.0), 0.1

    def law(time: float, speed: float) -> tuple[float, float]:
        return 40e3 * (1 - speed / 6), -40e3 / 6

    names = ("", "sticks") if leads == "the one that sticks" else ("slips", "")
    drums = (
        Drum("sticks", masses[0], law, leader=names[0]),
        Drum("slips", masses[1], law, exponent=exponent, leader=names[1]),
    )
    station = Station(place(), drums)
    follow(station)
    last = fed(station, lambda _: on, lambda _: off, window, 2000)[-1]

    def rates(time: float, state: np.ndarray) -> list[float]:
        belt, drum = state
        force, slack = law(time, belt if names[1] else drum)[0], off - OFF * belt
        first = force + math.exp(exponent) * slack - on - ON * belt
        return [first / masses[0], (force + slack - math.exp(exponent) * slack) / masses[1]]

    right = ode(rates, window, (0.0, 0.0))
    assert last.slips == (0, 1)
    assert (last.belt, last.drums[1]) == pytest.approx(tuple(right), rel=2e-3)


def test_a_drum_follows_one_at_another_place() -> None:
    """Its force is that at the speed which the leader had at the last step."""
    first = Station(place(), [Drum("first", 3000.0, lambda time, speed: (40e3 * (1 - speed / 2), -20e3))])
    second = Station(
        place(), [Drum("second", 500.0, lambda time, speed: (10e3 * (1 - speed / 2), -5e3), leader="first")]
    )
    follow(first, second)
    step, window = 1e-4, 0.05
    for station in (first, second):
        station.begin(0.0, 10e3, 20e3)
    for k in range(1, round(window / step) + 1):
        first.advance(k * step, 10e3, 20e3, step)
        seen = second.advance(k * step, 10e3, 20e3, step)

    def rates(time: float, state: np.ndarray) -> list[float]:
        push = 10e3 - (ON + OFF) * np.array(state)
        return [(40e3 * (1 - state[0] / 2) + push[0]) / 3000, (10e3 * (1 - state[0] / 2) + push[1]) / 500]

    assert seen.belt == pytest.approx(ode(rates, window, (0.0, 0.0))[1], rel=2e-3)
