"""The equations of a load under a pivot at drawn instants: Newton's laws of load and axis, energy, every signal."""

import math
from dataclasses import replace

import numpy as np
import pytest

from ptmcalc.numerics.pendulum.equations import (
    HIGH,
    KEEP,
    LAW,
    LOW,
    OFF,
    SIGNALS,
    WORKS,
    Held,
    Leg,
    Mode,
    _amplitude,
)
from ptmcalc.numerics.pendulum.parts import (
    Axis,
    Buffer,
    Case,
    Follow,
    Gear,
    Jib,
    Load,
    Push,
    Rail,
    Smooth,
    Straight,
)
from ptmcalc.numerics.pendulum.pieces import Pieces

G, MASS, INERTIA, ROTOR = 9.7, 700.0, 900.0, 150.0
BEND = Pieces((0.0,), ((6.0, -0.4, 0.05),))
RADIUS = Pieces((0.0,), ((9.0, 0.5, -0.06),))
TILT, DOWNHILL, UNBALANCE = 0.07, 0.4, 5e4
GEAR = Gear(ROTOR, 0.9, 0.8, Pieces((0.0,), ((90.0, 11.0),)))
LOAD = Load(MASS, BEND, wind_along=Pieces((0.0,), ((60.0, 9.0),)), wind_across=Pieces((0.0,), ((-45.0, 5.0),)))
BUFFERS = (Buffer(0.1, "linear", 800.0), Buffer(0.2, "constant", 130.0), Buffer(0.3, "orifice", 60.0),
           Buffer(-0.2, "constant", 70.0, side=-1), Buffer(9.0, "linear", 1e9))  # fmt: skip
MET = (True, True, True, True, False)
PLACES = (0.13, 0.2, 0.3, -0.2, 9.0)
CURVE = Straight((-0.5, 0.4, 1.6), (800.0, 500.0, 150.0))
COUNT = 9
KEPT = Pieces((0.0,), ((0.2, 0.31, 0.04),))


def field(t: np.ndarray, s: np.ndarray, v: np.ndarray) -> np.ndarray:
    return np.asarray(20.0 * t - 31.0 * s + 7.0 * v)


DRIVES = {
    LAW: Push(CURVE, Pieces((0.0,), ((0.6, 0.1),)), limit=420.0),
    KEEP: Follow(KEPT, 420.0),
    HIGH: Follow(KEPT, 420.0),
    LOW: Follow(KEPT, 420.0),
    OFF: None,
}
PIVOTS = {
    "rail": Rail(0.06),
    "jib": Jib(RADIUS),
    "tilted jib": Jib(RADIUS, TILT, DOWNHILL, UNBALANCE),
}


class Instant:
    """Nine drawn states of one mode and what is known of them."""

    def __init__(self, pivot: str, mode: Mode, **changes: object) -> None:
        axis = Axis(INERTIA, DRIVES[mode.drive], 40.0, Pieces((0.0,), ((30.0, 8.0),)), Pieces((0.0,), ((55.0, -6.0),)),
                    field, GEAR, BUFFERS)  # fmt: skip
        self.case = Case(G, PIVOTS[pivot], replace(axis, **changes), LOAD)  # type: ignore[arg-type]
        self.mode, self.jib = mode, pivot != "rail"
        self.leg = Leg(self.case, mode, 0.7, PLACES, KEPT if mode.drive == KEEP else None)
        rng = np.random.default_rng(5)
        self.t = 0.7 + rng.uniform(0, 1, COUNT)
        n = rng.normal([[0.3], [0.2], [-1.5]], 0.3, (3, COUNT))
        n /= np.linalg.norm(n, axis=0)
        w = rng.normal(0, 0.3, (3, COUNT))
        w -= (w * n).sum(axis=0) * n
        s = rng.uniform(0.35, 0.6, COUNT)
        v = rng.uniform(0.5, 1.5, COUNT) * (mode.side or int(mode.drive == KEEP))
        if mode.side < 0:
            v /= 4  # within the same piece of the curve
        self.z = np.concatenate([[s, v], n, w])

    def frame(self, u: np.ndarray, z: np.ndarray) -> np.ndarray:
        """What a vector's components gain as their frame turns: omega x u."""
        turn = z[1] if self.jib else 0 * z[1]
        return np.stack([turn * u[1], -turn * u[0], 0 * turn])

    def gravity(self, z: np.ndarray) -> np.ndarray:
        if not self.jib:
            return np.outer([-G * math.sin(0.06), 0.0, -G * math.cos(0.06)], np.ones(COUNT))
        tilt, downhill = (TILT, DOWNHILL) if self.case.pivot != PIVOTS["jib"] else (0.0, 0.0)
        flat = G * math.sin(tilt)  # its direction in space, turned back into the frame
        return np.stack([-flat * np.sin(z[0] - downhill), flat * np.cos(z[0] - downhill),
                         np.full(COUNT, -G * math.cos(tilt))])  # fmt: skip

    def inputs(self, pieces: Pieces, t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return pieces.at(t), pieces.derivative().at(t)

    def velocity(self, t: np.ndarray, z: np.ndarray) -> np.ndarray:
        """Of the load against space, told in the frame."""
        (length, hoists), (radius, luffs) = self.inputs(BEND, t), self.inputs(RADIUS, t)
        found = hoists * z[2:5] + length * z[5:8]
        found[0] += z[1] * (radius if self.jib else 1.0)
        found[1] += luffs if self.jib else 0.0
        return found

    def along(self, function: object, step: float = 1e-5) -> np.ndarray:
        """Rate of change of a function of time and state along the motion."""
        rate = self.leg.rate(self.t, self.z)
        first, last = (function(self.t + h, self.z + h * rate) for h in (-step, step))  # type: ignore[operator]
        return np.asarray((last - first) / (2 * step))

    @property
    def arm(self) -> np.ndarray:
        return RADIUS.at(self.t) if self.jib else np.ones(COUNT)

    @property
    def motor(self) -> np.ndarray:
        """What the drive gives in front of the gear where it keeps no speed."""
        curve = np.interp(self.z[1], CURVE.knots, CURVE.values)
        return {LAW: (0.6 + 0.1 * self.t) * curve, HIGH: 420.0 + 0 * curve, LOW: -420.0 + 0 * curve}.get(
            self.mode.drive, 0 * curve
        )

    @property
    def holds(self) -> np.ndarray:
        return 40.0 + 30.0 + 8.0 * self.t

    @property
    def inner(self) -> np.ndarray:
        return 90.0 + 11.0 * self.t

    @property
    def buffers(self) -> np.ndarray:
        found = -800.0 * (self.z[0] - 0.13)
        if self.mode.side > 0:
            found = found - 130.0 - 60.0 * self.z[1] ** 2
        return found + (70.0 if self.mode.side < 0 else 0.0)

    @property
    def outer(self) -> np.ndarray:
        return 55.0 - 6.0 * self.t + field(self.t, self.z[0], self.z[1])

    @property
    def weight(self) -> np.ndarray:
        """Of what moves without the load, along its way."""
        unbalanced = UNBALANCE if self.case.pivot == PIVOTS["tilted jib"] else 0.0
        return (unbalanced if self.jib else INERTIA) * self.gravity(self.z)[0]


MOVING = [Mode(drive, 1 if side > 0 and drive == LAW else (0 if drive == LAW else -1), side, forward, MET)
          for drive in (LAW, HIGH, LOW, OFF) for side in (1, -1) for forward in (True, False)]  # fmt: skip
KEEPING = [Mode(KEEP, 0, side, forward, MET) for side in (1, -1) for forward in (True, False)]
PIVOT = pytest.mark.parametrize("pivot", PIVOTS)


@PIVOT
@pytest.mark.parametrize("mode", [*MOVING, *KEEPING], ids=str)
def test_load_axis_gear_and_powers_are_in_balance(pivot: str, mode: Mode) -> None:
    now = Instant(pivot, mode)
    leg, t, z = now.leg, now.t, now.z
    of = leg.now(t, z)
    rate = leg.rate(t, z)
    n, v, a = z[2:5], z[1], rate[1]
    if mode.drive == LAW:
        assert (mode.piece == 1) == (float(v.min()) > 0.4)
    # the load: M u' = M g + wind - T n
    tension = leg.tension(of, z)
    moves = now.along(now.velocity) + now.frame(now.velocity(t, z), z)
    wind = np.stack([60 + 9 * t, -45 + 5 * t, 0 * t])
    gravity = now.gravity(z)
    assert MASS * moves == pytest.approx(MASS * gravity + wind - tension * n, abs=2e-6 * G * MASS)
    assert rate[2:5] == pytest.approx(z[5:8] - now.frame(n, z), abs=1e-14)
    assert (rate[0] == v).all()
    # the gear and what is behind it
    drive, motor, grip = leg.forces(t, z, of)
    assert grip == pytest.approx(-mode.side * now.holds, rel=1e-13)
    rope = tension * n[0] * now.arm
    assert (INERTIA * a) == pytest.approx(
        drive + grip + now.buffers + now.outer + now.weight + rope, rel=1e-10, abs=1e-7
    )
    if mode.drive == KEEP:
        assert a == pytest.approx(0.31 + 0.08 * t)
    else:
        assert motor == pytest.approx(now.motor, rel=1e-13)
        assert leg.into_gear(t, z, of) == pytest.approx(motor - mode.side * now.inner - ROTOR * a, rel=1e-10, abs=1e-8)
    into = motor - mode.side * now.inner - ROTOR * a
    assert drive == pytest.approx(into * 0.9 if mode.forward else into / 0.8, rel=1e-10, abs=1e-8)
    # energy
    works = dict(zip(WORKS, leg.powers(t, z), strict=True))
    assert works["motor"] == pytest.approx(motor * v)
    assert works["inner_brake"] == pytest.approx(-mode.side * now.inner * v)
    assert works["gear"] == pytest.approx((drive - into) * v, abs=1e-8)
    assert works["grip"] == pytest.approx(grip * v)
    assert works["buffer"] == pytest.approx(now.buffers * v)
    assert works["outer"] == pytest.approx(now.outer * v)
    load = now.velocity(t, z)
    assert works["wind"] == pytest.approx((wind * load).sum(axis=0))
    assert works["hoist"] == pytest.approx(-tension * BEND.derivative().at(t))
    assert works["luff"] == pytest.approx(-tension * n[1] * RADIUS.derivative().at(t) * now.jib)
    moving = leg.stored(t, z)[0]
    rotating = INERTIA + ROTOR
    assert moving == pytest.approx(rotating * v**2 / 2 + MASS * (load**2).sum(axis=0) / 2, rel=1e-13)
    change = now.along(lambda t, z: sum(leg.stored(t, z)))
    total = sum(works.values())
    assert change == pytest.approx(total, abs=2e-6 * float(np.abs(list(works.values())).max() + G * MASS))
    assert leg.load_speed(z, of) == pytest.approx(load, rel=1e-13)


@PIVOT
@pytest.mark.parametrize("drive", [LAW, HIGH, OFF])
def test_at_rest_the_margins_are_what_is_missing_to_move_either_way(pivot: str, drive: str) -> None:
    """What holds, less what pulls, less what comes out of the gear: less where power flows in, more where it is
    driven from behind."""
    now = Instant(pivot, Mode(drive, 0 if drive == LAW else -1, 0, True, MET))
    leg, t, z = now.leg, now.t, now.z
    of = leg.now(t, z)
    assert not leg.rate(t, z)[1].any()
    pulls = now.buffers + now.outer + now.weight + leg.tension(of, z) * z[2] * now.arm
    ahead, back = leg.margins(t, z)
    through = {}
    for side in (1, -1):
        into = now.motor - side * now.inner
        through[side] = np.array([one * 0.9 if one * side >= 0 else one / 0.8 for one in into])
    assert ahead == pytest.approx(now.holds + 130.0 - pulls - through[1], rel=1e-10)
    assert back == pytest.approx(now.holds + 70.0 + pulls + through[-1], rel=1e-10)
    behind, motor, grip = leg.forces(t, z, of)
    assert behind == pytest.approx(now.motor)
    assert motor == pytest.approx(now.motor)
    assert grip == pytest.approx(-pulls - now.motor, rel=1e-10)
    powers = dict(zip(WORKS, leg.powers(t, z), strict=True))
    assert not any(powers[name].any() for name in ("motor", "inner_brake", "gear", "grip", "buffer", "outer"))


@PIVOT
@pytest.mark.parametrize("outer", [-9000.0, 0.0, 9000.0])
def test_a_speed_kept_at_rest_is_held_by_the_grip_first(pivot: str, outer: float) -> None:
    """A drive that keeps 0: friction and brake give what they can, the drive the rest."""
    mode = Mode(KEEP, 0, 0, True, MET)
    now = Instant(pivot, mode, outer=Pieces.constant(outer))
    leg = Leg(now.case, mode, 0.7, PLACES, Pieces.constant(0.0))
    z = now.z.copy()
    z[1] = 0.0
    of = leg.now(now.t, z)
    pulls = outer + field(now.t, z[0], z[1]) + now.buffers + now.weight + leg.tension(of, z) * z[2] * now.arm
    drive, motor, grip = leg.forces(now.t, z, of)
    assert grip == pytest.approx(np.clip(-pulls, -now.holds, now.holds), rel=1e-10)
    assert drive == pytest.approx(-pulls - grip, rel=1e-9, abs=1e-7)
    assert np.array_equal(motor, drive)


@PIVOT
def test_signals_are_what_they_are_called(pivot: str) -> None:
    now = Instant(pivot, Mode(LAW, 1, 1, True, MET))
    leg, t, z = now.leg, now.t, now.z
    of = leg.now(t, z)
    found = dict(zip(SIGNALS, leg.signals(SIGNALS, t, z), strict=True))
    n, g = z[2:5], now.gravity(z)
    assert np.array_equal(found["position"], z[0])
    assert np.array_equal(found["speed"], z[1])
    assert found["acceleration"] == pytest.approx(leg.rate(t, z)[1])
    for k, name in enumerate(("along", "across")):
        assert found[name] == pytest.approx(np.arctan(n[k] / -n[2]) - np.arctan(g[k] / -g[2]), abs=1e-14)
        changes = now.along(lambda t, z, name=name: leg.signals((name,), t, z)[0])
        assert found[f"{name}_rate"] == pytest.approx(changes, abs=1e-8)
        assert found[f"pull_{name}"] == pytest.approx(found["tension"] * n[k])
    assert np.cos(found["sway"]) == pytest.approx((n * g).sum(axis=0) / np.linalg.norm(g, axis=0), abs=1e-14)
    assert found["tension"] == pytest.approx(leg.tension(of, z))
    for name, one in zip(("drive", "motor", "grip"), leg.forces(t, z, of), strict=True):
        assert found[name] == pytest.approx(one)
    assert found["buffer"] == pytest.approx(now.buffers)
    with pytest.raises(ValueError, match="no colour"):
        leg.signals(("colour",), t, z)


@pytest.mark.parametrize("seed", range(6))
def test_amplitude_is_the_highest_point_of_a_free_swing(seed: int) -> None:
    """There w is level and square to the direction: energy and turn about the plumb line meet in it."""
    rng = np.random.default_rng(seed)
    length, weight = rng.uniform(1, 9), rng.uniform(1, 12)
    top, turn = rng.uniform(0.05, 1.4), rng.uniform(0, 0.9)
    # a state at its highest point, below the speed of a level circle
    circle = math.sqrt(weight / length / math.cos(top)) * math.sin(top)
    n, w = np.array([math.sin(top), 0, -math.cos(top)]), np.array([0.0, turn * circle, 0.0])
    g = (0.0, 0.0, -weight)
    for _ in range(150):  # and down from there, by steps of Runge-Kutta of our own
        found = _amplitude(n[:, None], w[:, None], g, length)
        assert float(found[0]) == pytest.approx(top, rel=1e-8)
        h = 1e-2 * math.sqrt(length / weight)

        def rate(n: np.ndarray, w: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            pull = np.array([0, 0, -weight / length])
            return w, pull - n * (n @ pull) - n * (w @ w)

        a1, b1 = rate(n, w)
        a2, b2 = rate(n + h / 2 * a1, w + h / 2 * b1)
        a3, b3 = rate(n + h / 2 * a2, w + h / 2 * b2)
        a4, b4 = rate(n + h * a3, w + h * b3)
        n, w = n + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4), w + h / 6 * (b1 + 2 * b2 + 2 * b3 + b4)


def test_over_the_top_the_amplitude_is_half_a_turn() -> None:
    n, g = np.array([[0.0], [0.0], [-1.0]]), (0.0, 0.0, -9.0)
    for share, expected in ((0.9, 2 * math.asin(0.9)), (1.01, math.pi), (3.0, math.pi)):
        w = np.array([[share * 2 * math.sqrt(9.0 / 4.0)], [0.0], [0.0]])  # 2 (g/L)^(1/2) reaches the top
        assert float(_amplitude(n, w, g, 4.0)[0]) == pytest.approx(expected, rel=1e-12)


def test_a_piece_of_a_quantity_has_its_derivatives() -> None:
    pieces = Pieces((0.0, 2.0), ((1.0,), (3.0, -1.0, 0.5, 0.2)))
    late, t = Held(pieces, 2.5), np.array([2.0, 2.5, 3.1])
    for derivative in range(3):
        assert late(t, derivative) == pytest.approx(pieces.at(t))
        pieces = pieces.derivative()
    assert Held(Pieces.constant(3.0), 1.0)(t) == 3.0
    assert Held(Pieces.constant(3.0), 1.0)(t, 2) == 0.0
    assert [Held(Pieces.constant(one), 0.0).zero for one in (0.0, 1.0)] == [True, False]


@pytest.mark.parametrize("size", [1e-9, 1.0, 1e9])
def test_a_gear_takes_its_share_from_where_the_power_comes(size: float) -> None:
    case = Case(G, Rail(), Axis(INERTIA, gear=Gear(forward=0.9, reverse=0.8)), LOAD)
    for side in (1, -1):
        leg = Leg(case, Mode(OFF, -1, side, True, ()), 0.0, (), None)
        assert leg.behind(side * size, side) == pytest.approx(0.9 * side * size, rel=1e-14)
        assert leg.behind(-side * size, side) == pytest.approx(-side * size / 0.8, rel=1e-14)


def test_only_what_depends_on_the_sign_of_the_motion_is_sided() -> None:
    def sided(**changes: object) -> bool:
        case = Case(G, Rail(), replace(Axis(INERTIA), **changes), LOAD)  # type: ignore[arg-type]
        return Leg(case, Mode(OFF, -1, 1, True, ()), 0.0, (), None).sided

    assert not sided()
    assert sided(friction=0.5)
    assert sided(brake=Pieces.constant(0.5))
    assert sided(gear=Gear(brake=Pieces.constant(0.5)))
    assert sided(gear=Gear(forward=0.99))
    assert sided(gear=Gear(reverse=0.99))
    assert not sided(buffers=(BUFFERS[0],))
    assert sided(buffers=(BUFFERS[1],))


@pytest.mark.parametrize(
    ("piece", "speed", "expected"), [(-1, -0.7, 800.0), (0, 0.1, 600.0), (1, 1.0, 325.0), (2, 2.0, 150.0)]
)
def test_pieces_of_a_curve(piece: int, speed: float, expected: float) -> None:
    now = Instant("rail", Mode(LAW, piece, 1, True, MET))
    assert now.leg.driven(np.array([1.0]), np.array([speed])) == pytest.approx([0.7 * expected])
    smooth = Push(Smooth(lambda v: 3 * v, 3.0), Pieces.constant(0.5))
    other = Instant("rail", Mode(LAW, -1, 1, True, MET), drive=smooth)
    assert other.leg.driven(np.array([1.0]), np.array([speed])) == pytest.approx([1.5 * speed])
    same = Instant("rail", Mode(LAW, -1, 1, True, MET), drive=Push(7.0, Pieces.constant(0.5)))
    assert same.leg.driven(np.array([1.0]), np.array([speed])) == 3.5
