"""Steps of a station that have closed forms: of any length, to the last digits, whatever sticks, slips or is held."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support.belt_steps import exponential, velocity

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.belt.station import Drum, Place, Seen, Station, TakeUp

ON, OFF = 184e3, 72e3
Wave = Callable[[float], float]


def place(
    friction: tuple[float, float] = (0.0, 0.0),
    drag: tuple[float, float] = (0.0, 0.0),
    climbs: tuple[float, float] = (0.0, 0.0),
    line_mass: float = 0.0,
) -> Place:
    return Place(ON, OFF, *climbs, *friction, *drag, line_mass)


def fed(
    station: Station, n_on: float | Wave, p_off: float | Wave, window: float, steps: int, speed: float = 0.0
) -> list[Seen]:
    """Histories of a station that gets these waves."""
    n, p = ((lambda t, wave=wave: wave) if isinstance(wave, float) else wave for wave in (n_on, p_off))
    step = window / steps
    seen = [station.begin(speed, n(0.0), p(0.0))]
    return seen + [station.advance(k * step, n(k * step), p(k * step), step) for k in range(1, steps + 1)]


# -- one step of one mass ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_weights_of_a_step_to_the_last_digits(sign: float) -> None:
    """exp(-x), int_0^1 exp(-x s) ds and int_0^1 (1 - s) exp(-x s) ds by their series."""
    for x in (0.0, 1e-12, 1e-6, 3e-4, 9.9e-4, 1.01e-3, 2e-3, 0.1, 1.0, 3.0):
        y = sign * x
        whole = math.fsum((-y) ** k / math.factorial(k + 1) for k in range(60))
        late = math.fsum((-y) ** k / math.factorial(k + 2) for k in range(60))
        decay, early, last = exponential(y)
        close = 1e-13 if x < 1e-3 else 1e-12
        assert decay == pytest.approx(math.exp(-y), rel=1e-15)
        assert last == pytest.approx(late, rel=close / 2, abs=0.0)
        assert early + last == pytest.approx(whole, rel=close / 4, abs=0.0)


@pytest.mark.parametrize("way", [1.0, -1.0])
class TestOneStep:
    """m v' + Z v + R sgn v = g over one step."""

    def test_without_mass_it_is_in_balance_at_the_end(self, way: float) -> None:
        for z, force, friction, speed in ((1e5, 3e4, 1e4, 0.2), (0.5, 1.0, 0.5, 1.0), (1e5, 1e4, 3e4, 0.0)):
            found = velocity(9.0, 0.0, z, (7e6, friction), (-5e5, way * force), 0.1)
            assert found == pytest.approx(way * speed, rel=1e-9, abs=0.0)

    def test_a_light_drum_is_not_one_without_mass(self, way: float) -> None:
        mass, z, step = 0.5, 40.0, 0.02
        found = velocity(way * 3.0, mass, z, (0.0, 0.0), (way * 10.0, way * 10.0), step)
        decay = math.exp(-z * step / mass)
        assert found == pytest.approx(way * (3.0 * decay + 10.0 / z * (1 - decay)), rel=1e-12)

    def test_what_friction_holds_stays(self, way: float) -> None:
        for force in (0.0, 0.5, 7e4):
            assert velocity(0.0, 1e3, 1e5, (8e4, 7e4), (0.0, way * force), 0.1) == 0.0
        assert velocity(0.0, 1e3, 1e5, (0.0, 0.5), (0.0, way * 0.75), 0.1) * way > 0

    def test_what_breaks_loose_is_pushed_from_0_on(self, way: float) -> None:
        """The excess over friction rises to its end from nothing, not from below."""
        mass, step = 1e3, 0.1
        found = velocity(0.0, mass, 0.0, (6e4, 6e4), (0.0, way * 8e4), step)
        assert found == pytest.approx(way * 2e4 / 2 * step / mass, rel=1e-12)
        found = velocity(0.0, mass, 0.0, (0.1, 0.1), (way * 0.6, way * 0.8), step)
        assert found == pytest.approx(way * 0.6 * step / mass, rel=1e-12)

    def test_it_stops_and_turns_back(self, way: float) -> None:
        """Even deceleration by push and friction together, from the stop on by what the push is above friction."""
        mass, speed, rub, step, rate, push = 2e3, 3.0, 2e4, 0.6, 1e4, 5e4
        # push and friction change in opposite ways, so that together they are even
        forcing = way * -push, way * -(push + rate * step)
        stops = mass * speed / (push + rub)
        found = velocity(way * speed, mass, 0.0, (rub, rub - rate * step), forcing, step)
        assert stops < step
        expected = -((push - rub) * (step - stops) + rate * (step**2 - stops**2)) / mass
        assert found == pytest.approx(way * expected, rel=1e-9)

    def test_it_stops_and_stays(self, way: float) -> None:
        assert velocity(way * 3.0, 2e3, 0.0, (2e4, 2e4), (way * -1e4, way * -1e4), 0.6) == 0.0
        found = velocity(way * 3.0, 2e3, 0.0, (2e4, 2e4), (way * -1e4, way * -1e4), 0.1)
        assert found == pytest.approx(way * 1.5, rel=1e-12)

    def test_growth_of_a_hundred_time_constants_is_too_much(self, way: float) -> None:
        assert velocity(0.0, 1.0, -95.0, (0.0, 0.0), (way, way), 1.0) * way > 1e30
        with pytest.raises(NumericsError, match="steeply"):
            velocity(0.0, 1.0, -105.0, (0.0, 0.0), (way, way), 1.0)


# -- where nothing is but the belt ------------------------------------------------------------------------------------


@pytest.mark.parametrize("push", [0.0, 0.5, 3e3, 4.0005e3, 4.6e3, 9e4])
@pytest.mark.parametrize("way", [1.0, -1.0])
def test_a_bare_place_is_in_balance(push: float, way: float) -> None:
    """Friction of both sides holds 4 kN; what is above moves the belt against impedances and drags."""
    station = Station(place((3e3, 1e3), (400.0, 700.0), (2e3, -5e2)), ())
    station.creep = 0.01
    n, z = 1e5, ON + 400.0 + OFF + 700.0
    on, off = n + 2e3, n + 2e3 + way * push
    p = off + 500.0 + (OFF + 700.0) * 0.01  # what leaves faster takes that of the wave
    seen = station.advance(0.1, n, p, 0.1)
    speed = max(push - 4e3, 0.0) / z
    held = min(push / 4e3, 1.0)
    assert seen.belt == pytest.approx(way * speed, rel=1e-7, abs=0.0)
    assert (seen.behind, seen.creep) == (pytest.approx(seen.belt + 0.01, rel=1e-12), 0.01)
    expected = on + way * ((ON + 400.0) * speed + 3e3 * held), off - way * ((OFF + 700.0) * speed + 1e3 * held)
    assert seen.tensions == pytest.approx(expected, rel=1e-12)
    assert seen.drums == seen.slips == ()


def test_nothing_without_friction_does_nothing() -> None:
    seen = Station(place(), ()).begin(0.0, 5e4, 5e4)
    assert seen == Seen((5e4, 5e4), 0.0, 0.0, (), ())
    assert seen.creep == 0.0


@pytest.mark.parametrize("friction", [0.0, 2e3])
def test_a_belt_that_leaves_faster_than_it_comes_has_the_tension_of_its_own_speed(friction: float) -> None:
    station = Station(place((friction, friction), (0.0, 5e3)), [Drum("drum", 3e3, lambda t, v: (9e4, 0.0))])
    station.creep = 0.02
    seen = fed(station, 1e5, 1.2e5, 0.5, 20)[-1]
    assert seen.behind == pytest.approx(seen.belt + 0.02, rel=1e-12)
    assert seen.tensions[-1] == pytest.approx(1.2e5 - (OFF + 5e3) * seen.behind - friction, rel=1e-12)
    assert seen.tensions[0] == pytest.approx(1e5 + ON * seen.belt + friction, rel=1e-12)


@pytest.mark.parametrize("steps", [1, 7])
def test_a_drum_between_two_heights(steps: int) -> None:
    """m v' + (Z_u + Z_d) v = F + P + climb behind - N - climb before: exact in any step."""
    station = Station(place(climbs=(700.0, -300.0)), [Drum("drum", 4e4, lambda t, v: (9e4, 0.0))])
    seen = fed(station, 1e5, 9e4, 0.3, steps)[-1]
    z = ON + OFF
    speed = (9e4 + 9e4 - 300.0 - 1e5 - 700.0) / z * -math.expm1(-z * 0.3 / 4e4)
    assert seen.belt == pytest.approx(speed, rel=1e-12)
    if steps == 1:  # what the drive did by the trapezium, and nothing else
        assert station.work == pytest.approx(9e4 * speed / 2 * 0.3, rel=1e-12)
    assert seen.tensions == pytest.approx((1e5 + 700.0 + ON * speed, 9e4 - 300.0 - OFF * speed), rel=1e-12)


# -- drums that stick, brakes, a backstop -----------------------------------------------------------------------------


@pytest.mark.parametrize("speed", [0.0, 1.5, -1.5])
def test_what_brakes_of_two_drums_do_to_the_tension_between_them(speed: float) -> None:
    """Each takes its own, forward or back; at rest as much of it as is asked for of both together."""
    brakes, forces, masses = (3e4, 5e4), (1e4, 2e4), (2e3, 6e3)
    drums = [Drum(f"{j}", masses[j], lambda t, v, j=j: (forces[j], 0.0), lambda t, j=j: brakes[j]) for j in range(2)]
    rub = 1e3
    station = Station(place((rub, 0.0)), drums)
    n, p = 1.2e5, 1.4e5
    seen = fed(station, n, p, 1e-3, 1, speed)[-1]
    way = np.sign(speed)
    if speed:
        whole = sum(forces) + p - n - way * (sum(brakes) + rub) - (ON + OFF) * seen.belt
        gains = whole / sum(masses)
        between = p - OFF * seen.belt + forces[1] - way * brakes[1] - masses[1] * gains
        assert seen.belt == pytest.approx(speed + whole / sum(masses) * 1e-3, rel=0.03)
    else:
        share = (sum(forces) + p - n) / (sum(brakes) + rub)
        between = p + forces[1] - share * brakes[1]
        assert seen.belt == 0.0
        assert seen.tensions[0] == pytest.approx(n + share * rub, rel=1e-12)
    assert seen.tensions[1] == pytest.approx(between, rel=1e-9)
    assert station.slid == station.heat == [0.0, 0.0]


@pytest.mark.parametrize("scale", [1.0, 1e-4])
@pytest.mark.parametrize("excess", [0.5, 500.0])
def test_a_backstop_holds_back_and_never_forward(excess: float, scale: float) -> None:
    """Half a newton forward at the start: both drums share it by their masses, and the backstop has no part in it."""
    drums = [
        Drum("one", 2e3 * scale, lambda t, v: (1e4, 0.0)),
        Drum("two", 6e3 * scale, lambda t, v: (2e4, 0.0), one_way=True),
    ]
    seen = Station(place(), drums).begin(0.0, 1.3e5, 1e5 + excess)
    assert seen.belt == 0.0
    assert seen.tensions == pytest.approx((1.3e5, 1.2e5 + excess - 0.75 * excess, 1e5 + excess), rel=1e-9)
    held = Station(place(), drums).begin(0.0, 1.3e5 + excess, 1e5)
    assert held.tensions == pytest.approx((1.3e5 + excess, 1.2e5 + excess, 1e5), rel=1e-12)


def test_a_drum_with_a_backstop_that_slips_is_never_turned_back() -> None:
    """The belt slides back over it: e^(mu alpha) while the drum stands."""
    station = Station(place(), [Drum("drum", 1e3, exponent=0.5, one_way=True)], TakeUp(5e4))
    seen = fed(station, 2e5, 5e4, 0.2, 20)
    assert all(one.drums == (0.0,) for one in seen)
    assert seen[-1].slips == (1,)
    assert seen[-1].belt == pytest.approx((5e4 * math.exp(0.5) - 2e5) / ON, rel=1e-9)
    assert station.slid[0] == pytest.approx(-seen[-1].belt * 0.2, rel=1e-9)
    assert station.heat[0] == pytest.approx(5e4 * math.expm1(0.5) * station.slid[0], rel=1e-9)
    assert station.work == 0.0


@pytest.mark.parametrize("speed", [0.5, -0.5, 0.0])
def test_equal_shares_where_none_are_told(speed: float) -> None:
    """At an even speed, from the first look on, with friction against it or, at rest, none."""
    drums = [Drum(f"{j}", 5e3, exponent=9.0) for j in range(3)]
    station = Station(place((2e3, 1e3)), drums, None, lambda t: speed)
    way = float(np.sign(speed))
    on, off = 1.8e5, 6e4
    for one in fed(station, on - ON * speed - way * 2e3, off + OFF * speed + way * 1e3, 0.1, 2, speed):
        assert one.tensions == pytest.approx((1.8e5, 1.4e5, 1e5, 6e4), rel=1e-12)


@pytest.mark.parametrize("push", [9e4, -9e4])
def test_a_backstop_takes_what_friction_leaves_and_a_push_all_of_it(push: float) -> None:
    """At the start, when nothing has moved yet: friction of the belt is at its limit either way."""
    station = Station(place((2e3, 1e3)), [Drum("drum", 1e3, one_way=True)])
    seen = station.begin(0.0, 1e5, 1e5 + push)
    way = math.copysign(1.0, push)
    assert seen.belt == 0.0
    assert seen.tensions == pytest.approx((1e5 + way * 2e3, 1e5 + push - way * 1e3), rel=1e-12)


def test_a_backstop_behind_a_drum_that_spins_takes_what_the_grip_passes_on() -> None:
    """The first drum spins on a belt that the second holds: S/e is between them, whatever either drives."""
    spins = Drum("one", 1e4, lambda t, v: (6e5, 0.0), exponent=0.4)
    holds = Drum("two", 2e4, lambda t, v: (1e3, 0.0), exponent=9.0, one_way=True)
    seen = fed(Station(place(), [spins, holds], TakeUp(5e4)), 9e4, 5e4, 0.1, 4)[-1]
    assert (seen.slips, seen.belt) == ((1, 0), 0.0)
    assert seen.tensions == pytest.approx((9e4, 9e4 / math.exp(0.4), 5e4), rel=1e-9)


@pytest.mark.parametrize("scale", [1.0, 1e-5])
def test_between_two_drums_with_curves_is_what_the_second_gives_less_what_it_takes(scale: float) -> None:
    """At the end of a step of any length, however light they are: m2 a with the acceleration there."""
    masses, starts, slopes = (2e4 * scale, 6e4 * scale), (3e5, 1e5), (-4e5, -1e5)
    drums = [Drum(f"{j}", masses[j], lambda t, v, j=j: (starts[j] + slopes[j] * v, slopes[j])) for j in range(2)]
    seen = fed(Station(place(), drums), 1.2e5, 1.1e5, 0.05 * scale, 1, 0.02)[-1]
    forces = [start + slope * seen.belt for start, slope in zip(starts, slopes, strict=True)]
    gains = (sum(forces) + seen.tensions[2] - seen.tensions[0]) / sum(masses)
    assert seen.belt > 0.05
    assert seen.tensions[1] == pytest.approx(seen.tensions[2] + forces[1] - masses[1] * gains, rel=1e-9)


# -- slip -------------------------------------------------------------------------------------------------------------

GRIP, TENSION = math.exp(0.5), 1e5
PULL = TENSION * (GRIP - 1)


@pytest.mark.parametrize("one_way", [False, True])
@pytest.mark.parametrize("steps", [4, 40])
def test_a_slipping_drum_with_its_brake_and_its_curve(steps: int, one_way: bool) -> None:
    """m w' = F - c w - pull - b t from rest, exact in steps of any length; the belt slides at an even speed."""
    mass, force, curve, brake, end = 1e4, 4e5, 2e4, 1e5, 1.0
    drum = Drum("drum", mass, lambda t, v: (force - curve * v, -curve), lambda t: brake * t, 0.5, one_way)
    station = Station(place(), [drum], TakeUp(TENSION))
    n = TENSION * GRIP + 1e4  # more than it grips from the start
    seen = fed(station, n, TENSION, end, steps)
    rate, slide = curve / mass, -1e4 / ON
    for k, one in enumerate(seen):
        t = end * k / steps
        # w = A (1 - e^(-r t)) - B t with B = b/c, A = (F - pull)/c + B/r
        slope = brake / curve
        size = (force - PULL) / curve + slope / rate
        assert one.slips == (1,)
        assert one.belt == pytest.approx(slide, rel=1e-9)
        assert one.drums[0] == pytest.approx(size * -math.expm1(-rate * t) - slope * t, rel=1e-9, abs=1e-12)
        assert one.tensions == pytest.approx((TENSION * GRIP, TENSION), rel=1e-12)


def test_what_drive_brake_and_slip_do_over_time() -> None:
    """The same drum on a fine grid: work of F and -b t at its speed, way and heat of slip, by its closed form."""
    mass, force, curve, brake, end, steps = 1e4, 4e5, 2e4, 1e5, 1.0, 2000
    drum = Drum("drum", mass, lambda t, v: (force - curve * v, -curve), lambda t: brake * t, 0.5)
    station = Station(place(), [drum], TakeUp(TENSION))
    fed(station, TENSION * GRIP + 1e4, TENSION, end, steps)
    rate, slope = curve / mass, brake / curve
    size = (force - PULL) / curve + slope / rate
    t = np.linspace(0.0, end, 200_001)
    speed = size * -np.expm1(-rate * t) - slope * t
    way = float(np.trapezoid(speed, t)) + 1e4 / ON * end
    assert station.slid[0] == pytest.approx(way, rel=1e-6)
    assert station.heat[0] == pytest.approx(PULL * way, rel=1e-6)
    power = (force - curve * speed - brake * t) * speed
    assert station.work == pytest.approx(float(np.trapezoid(power, t)), rel=1e-6)


@pytest.mark.parametrize("share", [0.004, 0.5, 0.93])
@pytest.mark.parametrize("pace", [0.0, 0.4, -0.4])
def test_a_drum_that_is_caught_goes_on_with_the_belt_from_then_on(share: float, pace: float) -> None:
    """Its force falls to less than the belt pulls: it slows down evenly to the speed of a belt that gets faster or
    slower inside a step, and from there both go on by m v' = F + P - N - (Z_u + Z_d) v."""
    mass, high, low, step = 1e4, 4e5, 2e4, 0.1
    slide = -1e4 / ON

    def belt(time: float) -> float:  # while it slips, by waves that leave both tensions as they are
        return slide + pace * time

    # the drum over the belt: driven for three steps, less and less for one, then slowed down
    gained = ((high - PULL) * 3 + (high + low) / 2 - PULL) / mass * step - pace * 4 * step - slide
    slows = (PULL - low) / mass + pace
    after = int(gained / slows / step)
    high += ((after + share) * step * slows - gained) * mass / (3.5 * step)

    def force(time: float, speed: float) -> tuple[float, float]:
        return high + (low - high) * min(max(time / step - 3, 0.0), 1.0), 0.0

    station = Station(place(), [Drum("drum", mass, force, exponent=0.5)])
    n, p = (lambda t: TENSION * GRIP - ON * belt(t)), (lambda t: TENSION + OFF * belt(t))
    end, z = (5 + after) * step, ON + OFF
    seen = fed(station, n, p, end, 5 + after)
    assert [one.slips for one in seen[-2:]] == [(1,), (0,)]
    assert seen[-2].belt == pytest.approx(belt(end - step), rel=1e-9)
    left = (1 - share) * step
    push, rate = low + p(end - left) - n(end - left), z * pace
    steady = push / z - mass * rate / z**2
    decay = math.exp(-z / mass * left)
    expected = (belt(end - left) - steady) * decay + steady + rate / z * left
    assert seen[-1].belt == seen[-1].drums[0] == pytest.approx(expected, rel=1e-7)
    assert seen[-1].tensions == pytest.approx((n(end) + ON * expected, p(end) - OFF * expected), rel=1e-7)


def test_a_drum_that_slips_before_one_that_sticks_passes_on_no_centrifugal_tension() -> None:
    """e m2 v' = e (F2 + T) + (1 - e) l - N - Z v with l = rho v^2."""
    e, rho = math.exp(0.4), 4e4
    drums = [
        Drum("one", 1e4, lambda t, v: (6e5, 0.0), exponent=0.4),
        Drum("two", 2e4, lambda t, v: (8e4, 0.0), exponent=9.0),
    ]
    station = Station(place(line_mass=rho), drums, TakeUp(5e4))
    seen = fed(station, 5e4, 5e4, 0.5, 4000)[-1]
    found = solve_ivp(
        lambda t, v: (e * (8e4 + 5e4) + (1 - e) * rho * v**2 - 5e4 - ON * v) / (e * 2e4), (0.0, 0.5), [0.0],
        rtol=1e-10, atol=1e-12,
    )  # fmt: skip
    assert seen.slips == (1, 0)
    assert rho * seen.belt**2 > 5e3
    assert seen.belt == pytest.approx(float(found.y[0, -1]), rel=2e-4)


@pytest.mark.parametrize("line_mass", [15.0, 2e3])
@pytest.mark.parametrize("speed", [0.0, 3.0])
def test_slip_at_the_start_presses_with_the_speed_after_the_jump(line_mass: float, speed: float) -> None:
    """N + Z v - l = e (T - l), l = rho v^2: a quadratic in v."""
    station = Station(place(line_mass=line_mass), [Drum("drum", 1e4, exponent=0.5)], TakeUp(TENSION))
    n = TENSION * GRIP + 3e4 - ON * speed
    seen = station.begin(speed, n, TENSION)
    a, b, c = line_mass * (GRIP - 1), ON, n - GRIP * TENSION
    expected = (-b + math.sqrt(b * b - 4 * a * c)) / (2 * a)
    assert seen.slips == (1,)
    assert seen.belt == pytest.approx(expected, rel=1e-9)
    assert seen.drums == (speed,)


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("share", [0.999, 1.001])
@pytest.mark.parametrize("single", [True, False])
def test_a_drum_sticks_up_to_its_grip_on_what_presses(sense: int, share: float, single: bool) -> None:
    """(S_on - l)/(S_off - l) = e^(+-mu alpha), l = rho v^2: a little less holds, a little more slips."""
    rho, speed, off = 2e3, 3.0, 9e4
    lift = rho * speed**2
    on = lift + (share * GRIP if sense > 0 else 1 / (share * GRIP)) * (off - lift)
    drums = [Drum("drum", 1e9, exponent=0.5)] + ([] if single else [Drum("none", 0.0, exponent=0.0)])
    seen = Station(place(line_mass=rho), drums, TakeUp(off)).begin(speed, on - ON * speed, off)
    assert seen.slips[0] == (0 if share < 1 else sense)


def test_the_second_of_two_drums_slips_on_what_presses_it() -> None:
    """(S_1 - l)/(T - l) = e while it does, between drums too."""
    drums = [
        Drum("one", 2e4, lambda t, v: (1.5e5, 0.0), exponent=3.0),
        Drum("two", 1e4, lambda t, v: (1.5e5, 0.0), exponent=0.5),
    ]
    seen = fed(Station(place(line_mass=4e4), drums, TakeUp(5e4)), 5e4, 5e4, 2.0, 400)[-1]
    lift = 4e4 * seen.belt**2
    assert seen.slips == (0, 1)
    assert lift > 5e3
    assert (seen.tensions[1] - lift) / (5e4 - lift) == pytest.approx(GRIP, rel=1e-9)


@pytest.mark.parametrize(("on", "off", "sense"), [(200e3, 60e3, 1), (60e3, 200e3, -1)], ids=["drive", "brake"])
def test_at_a_speed_drums_share_what_a_slipping_one_between_them_leaves(on: float, off: float, sense: int) -> None:
    """By 2 to 1, their own mass apart; what presses the one that slips is less by the centrifugal part."""
    rho, gains, shares = 3e3, 0.3, (0.4, 0.4, 0.2)
    drums = [Drum(f"{j}", 2e3 * (j + 1), exponent=exponent) for j, exponent in enumerate((4.0, 0.1, 4.0))]
    station = Station(place(line_mass=rho), drums, TakeUp(off), lambda time: 0.5 + gains * time, shares)
    seen = fed(station, lambda t: on - ON * (0.5 + gains * t), off, 0.1, 50, 0.5)[-1]
    lift = rho * seen.belt**2
    assert seen.slips == (0, sense, 0)
    assert (seen.tensions[1] - lift) / (seen.tensions[2] - lift) == pytest.approx(math.exp(0.1 * sense), rel=1e-9)
    first, third = seen.tensions[0] - seen.tensions[1], seen.tensions[2] - seen.tensions[3]
    assert first + 2e3 * gains == pytest.approx(2 * (third + 6e3 * gains), rel=1e-9)
    assert lift > 700.0


# -- a weight behind the drums ----------------------------------------------------------------------------------------


def sliding(push: Wave, friction: float, mass: float, end: float, speed: float = 0.0) -> float:
    """m v' + Z v + R sgn v = push by many small implicit steps, friction by its return map."""
    count, v = 100_000, speed
    dt = end / count
    for k in range(1, count + 1):
        free = v + dt / mass * push(k * dt)
        rest = max(abs(free) - friction * dt / mass, 0.0)
        v = math.copysign(rest, free) / (1 + dt * OFF / mass)
    return v


@pytest.mark.parametrize("end", [0.25, 0.7, 1.1, 1.9])
def test_a_belt_behind_a_weight_sticks_and_slides_on_its_own_idlers(end: float) -> None:
    """Drums held still: M/4 v' + Z v + R sgn v = P - T behind the weight."""
    weight, rest, friction = 6e4, 5e4, 2e4

    def wave(time: float) -> float:
        return rest + 4e4 * math.sin(3.0 * time)

    station = Station(place((0.0, friction)), [Drum("drum", 1e3)], TakeUp(rest, weight), lambda t: 0.0)
    seen = fed(station, 1e5, wave, end, 1000)[-1]
    expected = sliding(lambda t: wave(t) - rest, friction, weight / 4, end)
    assert seen.behind == pytest.approx(expected, abs=1e-3)
    if seen.behind:
        rub = math.copysign(friction, seen.behind)
        assert seen.tensions[-1] == pytest.approx(wave(end) - rub - OFF * seen.behind, rel=1e-9)


@pytest.mark.parametrize("over", [-0.99, 0.0, 0.99, -1.2, 1.2])
@pytest.mark.parametrize("weight", [100.0, 6e4])
@pytest.mark.parametrize("friction", [2e4, 0.25])
def test_a_weight_rests_while_friction_holds_the_belt_behind_it(over: float, weight: float, friction: float) -> None:
    """So long as P - T is within the friction of the idlers there; beyond, it moves the way of the difference."""
    rest, climb = 5e4, -4e3
    at = place((0.0, friction), climbs=(0.0, climb))
    station = Station(at, [Drum("drum", 1e3)], TakeUp(rest, weight), lambda t: 0.0)
    seen = fed(station, 1e5, rest + over * friction - climb, 5.0, 50)
    if abs(over) < 1:
        assert all((one.behind, one.tensions[-1]) == (0.0, rest) for one in seen)
    else:
        assert seen[-1].behind == pytest.approx(math.copysign(0.2, over) * friction / OFF, rel=1e-6)
        assert seen[-1].tensions[-1] == pytest.approx(rest, rel=1e-6)


@pytest.mark.parametrize(("weight", "friction"), [(4e3, 2e4), (0.8, 2e4), (4e3, 0.5)])
def test_a_belt_behind_a_weight_that_turns_back_comes_to_rest_first(weight: float, friction: float) -> None:
    """Pulled one way and in the next step the other: between both it stands, as friction has it."""
    rest = 5e4
    station = Station(place((0.0, friction)), [Drum("drum", 1e3)], TakeUp(rest, weight), lambda t: 0.0)
    seen = fed(station, 1e5, lambda t: rest + (3 if t < 0.95 else -3) * friction, 2.0, 20)
    senses = [int(np.sign(one.behind)) for one in seen]
    assert senses[1:10] == [1] * 9
    assert senses[10:] == [0] + [-1] * 10


def test_a_light_weight_has_its_own_time() -> None:
    """M/4 v' + Z v = P - T with drums that stand: exact in any step, of a kilogram too."""
    weight, rest = 2.0, 5e4
    station = Station(place(), [Drum("drum", 1e3)], TakeUp(rest, weight), lambda t: 0.0)
    seen = fed(station, 1e5, rest + 1e3, 2e-5, 8)
    for k, one in enumerate(seen):
        speed = 1e3 / OFF * -math.expm1(-OFF * k * 2.5e-6 / (weight / 4))
        assert one.behind == pytest.approx(speed, rel=1e-9, abs=1e-15)
        assert one.tensions[-1] == pytest.approx(rest + 1e3 - OFF * speed, rel=1e-12)


def test_a_weight_on_a_belt_that_rests_goes_with_the_drums() -> None:
    """The belt behind is held by its idlers: (m + M/4) v' = F + T - N - Z v."""
    mass, weight, force = 2e3, 8e4, 6e4
    gaps = []
    for steps in (200, 400):
        station = Station(place((0.0, 1e9)), [Drum("drum", mass, lambda t, v: (force, 0.0))], TakeUp(5e4, weight))
        before, seen = fed(station, 5e4, 5e4, 0.2, steps)[-2:]
        expected = force / ON * -math.expm1(-ON * 0.2 / (mass + weight / 4))
        gains = (seen.belt - before.belt) * steps / 0.2
        assert seen.behind == 0.0
        assert seen.tensions[-1] == pytest.approx(5e4 - weight / 4 * gains, rel=1e-9)
        gaps.append(abs(seen.belt / expected - 1))
    assert gaps[1] < 1e-3
    assert gaps[1] < 0.6 * gaps[0]


@pytest.mark.parametrize("weight", [0.0, 2e4])
@pytest.mark.parametrize("way", [1.0, -1.0])
def test_steady_motion_with_a_take_up_is_steady_from_the_start(weight: float, way: float) -> None:
    station = Station(place((2e3, 1e3), (3e3, 5e3), (700.0, -300.0)), [Drum("drum", 1e3)], TakeUp(6e4, weight))
    n = 6e4 - 700.0 - way * ((ON + 3e3) * 0.5 + 2e3)
    p = 6e4 + 300.0 + way * (1e3 + (OFF + 5e3) * 0.5)
    for one in fed(station, n, p, 1.0, 20, way * 0.5):
        assert (one.belt, one.behind) == pytest.approx((way * 0.5, way * 0.5), rel=1e-9)
        assert one.tensions == pytest.approx((6e4, 6e4), rel=1e-9)
    assert station.slid == station.heat == [0.0]
    assert station.work == 0.0


def test_a_speed_that_is_imposed_from_the_start_leaves_the_belt_behind_the_weight_its_own() -> None:
    station = Station(place((0.0, 1e3), (0.0, 5e3)), [Drum("drum", 1e3)], TakeUp(6e4, 2e4), lambda t: 0.7 + 3 * t)
    seen = station.begin(0.5, 1e5, 9e4)
    assert (seen.belt, seen.behind) == pytest.approx((0.7, 0.5), rel=1e-12)
    assert seen.tensions == pytest.approx((1e5 + ON * 0.7, 9e4 - 1e3 - (OFF + 5e3) * 0.5), rel=1e-12)


def test_a_belt_at_rest_behind_a_weight_stays_there_when_drums_start_at_a_speed() -> None:
    station = Station(place((0.0, 2e3)), [Drum("drum", 1e3)], TakeUp(6e4, 2e4), lambda t: 0.7)
    seen = station.begin(0.0, 1e5, 6.1e4)
    assert (seen.belt, seen.behind, seen.tensions[-1]) == (0.7, 0.0, 6e4)


def test_at_the_start_friction_holds_as_much_of_a_weight_as_it_can() -> None:
    for over, tension in ((0.5, 6e4), (-0.5, 6e4)):
        station = Station(place((0.0, 2e3)), [Drum("drum", 1e3, one_way=True)], TakeUp(6e4, 2e4))
        seen = station.begin(0.0, 6e4 + 5e3, 6e4 + over * 2e3)
        assert (seen.belt, seen.behind) == (0.0, 0.0)
        assert seen.tensions[-1] == pytest.approx(tension, rel=1e-12)
