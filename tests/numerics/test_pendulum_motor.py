"""Motors whose force is straight between knots, against the exponentials that follow from it, and where steps begin."""

import math
from dataclasses import replace

import numpy as np
import pytest

from ptmcalc.numerics.collocation import radau
from ptmcalc.numerics.pendulum.equations import HIGH, KEEP, LOW, SPEED, Mode
from ptmcalc.numerics.pendulum.march import March
from ptmcalc.numerics.pendulum.parts import Axis, Buffer, Case, Follow, Gear, Jib, Load, Push, Rail, Straight
from ptmcalc.numerics.pendulum.pieces import Pieces
from ptmcalc.numerics.pendulum.swing import Swing, swing

G = 9.81
FEATHER = Load(1e-9, Pieces.constant(1.0))
MASS = 4.0
KNOTS, FORCES = (0.5, 1.0, 1.5, 2.5), (8.0, 12.0, 6.0, 2.0)


def speed_after(time: float, speed: float, sign: int) -> float:
    """Of a mass that a motor pushes ahead (sign 1) or holds back, knot by knot: m v' = F_k + s_k (v - v_k)."""
    k = int(np.searchsorted(KNOTS, speed, "right" if sign > 0 else "left"))
    while True:
        inside = 0 < k < len(KNOTS)
        slope = sign * (FORCES[k] - FORCES[k - 1]) / (KNOTS[k] - KNOTS[k - 1]) if inside else 0.0
        force = sign * float(np.interp(speed, KNOTS, FORCES))
        ahead = k < len(KNOTS) if sign > 0 else k > 0
        to = (KNOTS[k] if sign > 0 else KNOTS[k - 1]) if ahead else math.inf * sign
        needs = MASS * (to - speed) / force if slope == 0 else MASS / slope * math.log1p(slope * (to - speed) / force)
        if needs >= time:
            grown = math.expm1(slope * time / MASS) / slope if slope else time / MASS
            return speed + force * grown
        speed, time, k = to, time - needs, k + sign


def pushed(sign: int, speed: float, **changes: float) -> Swing:
    law = Straight(KNOTS, tuple(sign * force for force in FORCES))
    return swing(Case(G, Rail(), Axis(MASS, Push(law), speed=speed, **changes), FEATHER), 2.0)


@pytest.mark.parametrize(
    ("sign", "speed"), [(1, 0.1), (1, 0.5), (1, 0.7), (1, 1.2), (-1, 3.0), (-1, 2.5), (-1, 2.0), (-1, 1.5), (-1, 1.2)]
)
def test_a_motor_takes_a_mass_through_its_knots(sign: int, speed: float) -> None:
    found = pushed(sign, speed)
    times = np.linspace(0.0, 2.0 if sign > 0 else 0.4, 23)
    wanted = [speed_after(time, speed, sign) for time in times.tolist()]
    assert found.at("speed", times) == pytest.approx(wanted, rel=1e-9)
    assert min(step.used * step.length for step in found._fine.steps) > 1e-6, "no piece that is left at once"


@pytest.mark.parametrize("way", [1, -1])
@pytest.mark.parametrize("demand", [1.2, 1.9, 3.0])
def test_a_drive_asked_for_more_than_it_has_pushes_with_what_it_has_at_once(demand: float, way: int) -> None:
    """A speed to be kept rises gently, then, from 0.7 s to 0.8 s, faster than the limit allows: no piece in between is
    left as soon as it has begun."""
    limit, gentle, begin, until = 10.0, 0.5, 0.7, 0.8
    steep = demand * limit / MASS
    kept = Pieces.through(
        ((0.0, 0.0), (begin, way * gentle * begin), (until, way * (gentle * begin + steep * (until - begin))))
    )
    found = swing(Case(G, Rail(), Axis(MASS, Follow(kept, limit)), FEATHER), 5.0)
    lags = (steep - limit / MASS) * (until - begin)
    met = until + lags * MASS / limit
    times = np.array([0.3, begin, 0.75, until, (until + met) / 2, met, met + 1])
    wanted = [gentle * 0.3, gentle * begin, *(gentle * begin + limit / MASS * (times[2:6] - begin)).tolist()]
    wanted.append(wanted[-1])
    assert found.at("speed", times) == pytest.approx(way * np.array(wanted), rel=1e-8)
    assert min(step.used * step.length for step in found._fine.steps) > 1e-6


@pytest.mark.parametrize("way", [1, -1])
def test_a_kept_speed_heads_where_it_goes_whatever_rounding_says_it_is(way: int) -> None:
    """At rest but for rounding, it has the sign of its slope; at rest for good, none."""
    for rest in (-1e-16, 0.0, 1e-16):
        for kept, heads in ((Pieces((0.0,), ((rest, way * 0.4),)), way), (Pieces.constant(rest), 0)):
            case = Case(G, Rail(), Axis(MASS, Follow(kept), outer=Pieces.constant(5.0)), FEATHER)
            assert March(case, 1.0, 1e-9, radau(4), 10)._heading(0.0) == heads


@pytest.mark.parametrize("seed", range(20))
def test_a_step_begins_wherever_a_force_changes(seed: int) -> None:
    """To the last digit: what rounding leaves of a piece would be a step of its own."""
    times = 3e-3 * 3.5 ** np.arange(6) * np.random.default_rng(seed).uniform(0.8, 1.2, 6)
    blows = Pieces.steps(tuple((time, 3.0 * (-1) ** k) for k, time in enumerate(times.tolist())))
    track = swing(Case(G, Rail(), Axis(MASS, outer=blows), FEATHER), 3.0)._fine
    assert set(times.tolist()) <= {step.start for step in track.steps}
    assert min(step.used * step.length for step in track.steps) > 1e-6
    spans = np.diff([*times, 3.0])
    pushed_on = 3.0 * (spans[::2].sum() - spans[1::2].sum()) / MASS
    assert track.at(("speed",), np.array([3.0]))[0, 0] == pytest.approx(pushed_on)


@pytest.mark.parametrize("side", [1, -1])
def test_the_farthest_is_on_the_side_that_the_wind_blows_to(side: int) -> None:
    """From the plumb line to twice the angle of rest, and back."""
    blown = Load(300.0, Pieces.constant(5.0), wind_along=Pieces.constant(side * 30.0))
    found = swing(Case(G, Rail(), Axis(1e9), blown), 20.0)
    assert found.farthest("along").value == pytest.approx(side * 2 * math.atan(30.0 / 300.0 / G), rel=1e-6)


def test_a_buffer_softer_than_a_newton_a_metre() -> None:
    soft = Axis(MASS, buffers=(Buffer(0.5, "linear", 0.25),), speed=1.0)
    found = swing(Case(G, Rail(), soft, FEATHER), 8.0)
    assert found.largest("position").value == pytest.approx(0.5 + math.sqrt(MASS / 0.25), rel=1e-8)


def test_a_force_that_comes_within_the_first_second_is_not_there_before() -> None:
    assert Pieces.steps(((0.5, 3.0),)).at(np.array([0.2, 0.6])).tolist() == [0.0, 3.0]


@pytest.mark.parametrize(("after", "jumps"), [(1e-4, False), (1e-2, True)])
def test_a_jump_is_more_than_the_rounding_of_large_terms(after: float, jumps: bool) -> None:
    """t^3 - 100 t^2 comes to 0 at 100, of terms of a million each."""
    assert Pieces((0.0, 100.0), ((0.0, 0.0, -100.0, 1.0), (after,))).jumps == jumps


# -- the mode that holds from a time on -------------------------------------------------------------------------------


def march_of(axis: Axis) -> tuple[March, np.ndarray]:
    march = March(Case(G, Rail(), axis, FEATHER), 2.0, 1e-10, radau(9), 1000)
    return march, march._start()


@pytest.mark.parametrize("size", [1e-6, 1.0, 1e6])
@pytest.mark.parametrize("way", [1, -1])
@pytest.mark.parametrize("faster", [True, False])
def test_power_of_a_kept_speed_flows_through_the_gear_as_it_speeds_up_or_slows_down(
    size: float, way: int, faster: bool
) -> None:
    kept = Pieces.through(((0.0, way * 1.0), (2.0, way * (1.4 if faster else 0.3))))
    march, state = march_of(Axis(MASS * size, Follow(kept), gear=Gear(0.1 * size, 0.9, 0.8), speed=way * 1.0))
    mode, _ = march._choose(0.0, state, None, {})
    assert (mode.drive, mode.side, mode.forward) == (KEEP, way, faster)


@pytest.mark.parametrize(("force", "piece"), [(5.0, 1), (-5.0, 0)])
def test_a_motor_at_rest_on_a_knot_is_on_the_piece_it_moves_into(force: float, piece: int) -> None:
    """Without a step of no length through the other one."""
    law = Straight((-1.0, 0.0, 1.0), (force,) * 3)
    march, state = march_of(Axis(MASS, Push(law), friction=1.0))
    mode, _ = march._choose(0.0, state, None, {})
    assert (mode.side, mode.piece) == (math.copysign(1, force), piece)


def test_a_drive_at_its_limit_meets_the_speed_it_is_to_keep_from_its_own_side() -> None:
    kept = Pieces.through(((0.0, 1.0), (2.0, 2.0)))
    march, state = march_of(Axis(MASS, Follow(kept, limit=1.0), speed=0.7))
    for drive, sign in ((HIGH, 1), (LOW, -1)):
        leg = march._leg(Mode(drive, -1, 1, True, ()), 0.0)
        names, values = march.guards.values(leg, np.array([0.4]), state[:, None])
        assert values[names.index("met"), 0] == pytest.approx(sign * (1.2 - state[SPEED]), rel=1e-12)


@pytest.mark.parametrize(("share", "ends"), [(1.0, True), (0.95, True), (0.3, False)])
def test_newtons_method_that_creeps_is_not_at_its_end(share: float, ends: bool) -> None:
    """A correction of only so much of what is missing leaves 1 - share of it each time: 0.7^14 is no solution, though
    each change is nearly as large as the one before."""
    march, state = march_of(Axis(MASS, None, speed=0.7))
    state[2:5] = np.sin(1.0), 0.0, -np.cos(1.0)
    leg, stepper = march._leg(march._choose(0.0, state, None, {})[0], 0.0), march.stepper
    whole = stepper._inverse
    stepper._inverse = lambda *given: share * whole(*given)  # type: ignore[method-assign]
    assert (stepper._solve(leg, 0.0, state, 0.2)[0] is not None) is ends


@pytest.mark.parametrize(("off", "drive"), [(0.5e-11, KEEP), (-0.5e-11, KEEP), (2e-11, LOW), (-2e-11, HIGH)])
@pytest.mark.parametrize("speed", [3.0, 5e3])
def test_a_speed_is_kept_that_is_the_one_to_keep_but_for_rounding_of_the_largest(
    speed: float, off: float, drive: str
) -> None:
    march, state = march_of(Axis(MASS, Follow(Pieces.constant(speed), limit=1.0), speed=speed))
    state[SPEED] = speed * (1 + off)
    assert march._drive(0.0, state) == drive


@pytest.mark.parametrize(("short", "drive"), [(-1e-6, KEEP), (0.0, KEEP), (0.5e-11, KEEP), (2e-11, HIGH), (1e-6, HIGH)])
def test_a_drive_that_has_just_what_its_speed_takes_keeps_it(short: float, drive: str) -> None:
    kept = Pieces.through(((0.0, 1.0), (2.0, 3.0)))
    axis = Axis(MASS, Follow(kept, limit=1e9), speed=1.0)
    march, state = march_of(axis)
    leg = march._leg(march._choose(0.0, state, None, {})[0], 0.0)
    at, z = np.zeros(1), state[:, None]
    takes = float(leg.forces(at, z, leg.now(at, z))[1][0])
    assert takes == pytest.approx(MASS * 1.0, rel=1e-6)
    weak, state = march_of(replace(axis, drive=Follow(kept, limit=takes * (1 - short))))
    assert weak._choose(0.0, state, None, {})[0].drive == drive


def test_guards_are_small_beside_the_largest_of_their_kind() -> None:
    """A rope's pull beside the weight, forces beside the largest of the axis, speeds and places beside the fastest."""
    load = Load(50.0, Pieces.constant(4.0))
    axis = Axis(MASS, Follow(Pieces.constant(9.0), limit=1e4), friction=700.0, speed=9.0)
    guards = March(Case(G, Rail(), axis, load), 2.0, 1e-10, radau(9), 1000).guards
    assert guards.weight == pytest.approx(50.0 * G, rel=1e-12)
    assert (guards.force, guards.speed) == (700.0, 9.0)
    assert guards.position == pytest.approx(9.0 * math.sqrt(4.0 / G), rel=1e-12)


def test_without_forces_of_its_own_an_axis_is_measured_by_a_thousandth_of_the_weight_at_its_arm() -> None:
    load = Load(50.0, Pieces.constant(4.0))
    for pivot, arm in ((Rail(), 1.0), (Jib(Pieces.constant(12.0)), 12.0)):
        march = March(Case(G, pivot, Axis(MASS, None, speed=1.0), load), 2.0, 1e-10, radau(9), 1000)
        assert march.guards.force == pytest.approx(1e-3 * 50.0 * G * arm, rel=1e-12)


@pytest.mark.parametrize("end", [0.9, 1.0, 1.1])
def test_a_buffer_in_the_first_step_is_met_however_long_that_is(end: float) -> None:
    """Half a second to it at 2 m/s, then v cos(w t): on a rope of a hundred metres that is one step to the end."""
    axis = Axis(MASS, None, speed=2.0, buffers=(Buffer(1.0, "linear", MASS * 4.0),))
    found = swing(Case(G, Rail(), axis, Load(1e-9, Pieces.constant(100.0))), end)
    assert found._fine.steps[0].length == end
    assert float(found.at("speed", end)) == pytest.approx(2.0 * math.cos(2.0 * (end - 0.5)), rel=1e-8)
