"""A hauled load at one instant: balances of each body, of power and of energy; what keeps a mode; lengths of panels."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.rope import rule
from ptmcalc.numerics.rope.equations import ZD, Hauled, Mode, Rod, S, U, V, W, X, Z
from ptmcalc.numerics.rope.march import March, Panel, Played
from ptmcalc.numerics.rope.parts import NONE, Course, Governed, Haul, Lines, Smooth, Stage, Structure, Tripped

G = 9.81
M, K = 5000.0, 1.2e6
Q = M * G
GEAR, TACKLE = (0.91, 0.87), (0.95, 0.93)
MOTOR, DRUM = 2100.0, 900.0
SPEED, RISE = 0.3, 0.7
"""of the set speed"""
HEAVY, SOFT = Structure(8 * K, 0.6 * M, 3e3), Structure(6 * K, 0.0, 0.0)
ROD, HAULED = Rod(K, 0.2 * M), Hauled(K * 10, 10.0, 2e3, 3e-3)
ROPES = pytest.mark.parametrize("rope", [ROD, HAULED], ids=["rod", "hauled"])
BRIDGES = pytest.mark.parametrize("structure", [None, HEAVY, SOFT], ids=["stiff", "heavy", "soft"])


def machine(structure: Structure | None = None, **changes: Any) -> Haul:
    """Every part that gives, takes or loses something."""
    one = Haul(
        MOTOR, DRUM, M, Q, GEAR, TACKLE, structure, False, 0.0, 0.2, 1,
        stages=(Stage(Lines(np.array([-4.0, 4.0]), np.array([3 * Q, 0.5 * Q]), True), until=3.5),
                Stage(Lines(np.zeros(1), np.array([Q])))),
        gate=Tripped(Course(values=(0.8,))),
        motor_brake=Tripped(Course((0.0,), (0.3 * Q,), (0.1 * Q,))),
        drum_brake=Tripped(Course((0.0,), (0.2 * Q,), (0.05 * Q,))),
    )  # fmt: skip
    return replace(one, **changes)


def kept(structure: Structure | None = None, **changes: Any) -> Haul:
    """The same under a set speed."""
    course = Course((0.0,), (SPEED,), (RISE,))
    return machine(structure, stages=(), set_speed=course, capacity=Course((0.0,), (4 * Q,), (Q,)), **changes)


def mode_of(turn: int = 1, power: int = 1, **changes: Any) -> Mode:
    return Mode(turn, power, False, 1, False, True, 0, 0, math.inf)._replace(**changes)


class Instant:
    """States drawn at the nodes of a panel, and what is known of them from each body alone."""

    def __init__(self, march: March, mode: Mode, seed: int = 3) -> None:
        self.march, self.mode, self.haul = march, mode, march.haul
        rng = np.random.default_rng(seed)
        self.begin, self.t = 1.25, 1.25 + 0.01 * rule.NODES
        y = np.zeros((rule.COUNT, 7))
        y[:, W] = mode.turn * rng.uniform(0.1, 0.5, rule.COUNT)
        y[:, V] = 0.0 if mode.ground else rng.uniform(-0.5, 0.5, rule.COUNT)
        y[:, Z], y[:, ZD] = rng.uniform(0.003, 0.01, rule.COUNT), rng.uniform(-0.1, 0.1, rule.COUNT)
        y[:, X], y[:, U] = rng.uniform(0, 0.02, rule.COUNT), rng.uniform(0.01, 0.02, rule.COUNT)
        if march.heavy is None:
            y[:, ZD] = 0.0
            y[:, Z] *= march.soft is not None and march.rod is not None
        y[:, S] = y[:, U] + y[:, Z] + rng.uniform(0.01, 0.06, rule.COUNT)
        if not mode.taut:
            y[:, S] = y[:, U] - 0.02
        self.y = y
        self.down, self.up = rng.uniform(0.2 * Q, 0.8 * Q, (2, rule.COUNT))

    @property
    def strain(self) -> np.ndarray:
        """By the distance that is left for the rope: the structure sags by what the rope pulls."""
        rope, y = self.march.rope, self.y
        assert isinstance(rope, Hauled)
        found = []
        for row in y:
            gives = 0.0 if self.march.soft is None else 1 / (6 * K)
            length = rope.length - row[S]
            found.append((row[S] - row[U] - row[Z]) / (length + rope.extensional * gives))
        return np.array(found)

    @property
    def forces(self) -> tuple[np.ndarray, np.ndarray]:
        """At the drum and at the load."""
        rope, y = self.march.rope, self.y
        if not self.mode.taut:
            return np.zeros(len(y)), np.zeros(len(y))
        if isinstance(rope, Rod):
            z = math.sqrt(rope.stiffness * rope.mass)
            top = 6 * K * y[:, Z] if self.march.soft else z * (y[:, W] - y[:, ZD]) + 2 * self.up
            return top, 2 * self.down - z * y[:, V]
        pull = rope.extensional * self.strain + rope.damping * (y[:, W] - y[:, V] - y[:, ZD])
        return pull, pull

    @property
    def brakes(self) -> tuple[np.ndarray, np.ndarray]:
        return 0.3 * Q + 0.1 * Q * self.t, 0.2 * Q + 0.05 * Q * self.t

    @property
    def curve(self) -> np.ndarray:
        """Force of the drive's own curve, or of one that pushes with all it has."""
        if self.haul.set_speed is not None:
            return self.mode.pushing * 0.8 * Q * (4 + self.t)
        return 0.8 * Q * (1.75 - 2.5 / 8 * self.y[:, W])

    def drive(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Acceleration, gear's force on the drum, drive's force, from motor and drum each on its own."""
        turn, (motor, drum) = self.mode.turn, self.brakes
        top = self.forces[0]
        lever = 1 / GEAR[0] if self.mode.power > 0 else GEAR[1]
        found = []
        for k in range(rule.COUNT):
            behind = (top[k] / TACKLE[0] if turn > 0 else top[k] * TACKLE[1]) + turn * drum[k]
            if self.mode.follows:  # acceleration known, force of the drive sought
                through = DRUM * RISE + behind
                found.append((RISE, through, MOTOR * RISE + lever * through + turn * motor[k]))
            else:
                push = self.curve[k]
                a, through = np.linalg.solve([[DRUM, -1], [MOTOR, lever]], [-behind, push - turn * motor[k]])
                found.append((a, through, push))
        a, through, push = np.array(found).T
        return a, through, push


MODES = [mode_of(turn, power) for turn in (1, -1) for power in (1, -1)]
MODES += [mode_of(1, 1, taut=False), mode_of(-1, 1, taut=False), mode_of(1, 1, ground=True)]


@ROPES
@BRIDGES
@pytest.mark.parametrize("follows", [False, True])
@pytest.mark.parametrize("mode", MODES, ids=str)
def test_each_body_and_the_power_are_in_balance(
    rope: Rod | Hauled, structure: Structure | None, follows: bool, mode: Mode
) -> None:
    march = March((kept if follows else machine)(structure), rope)
    now = Instant(march, mode._replace(follows=follows))
    y, mode, (top, bottom) = now.y, now.mode, now.forces
    a, through, push = now.drive()
    for found, expected in zip(march.ends_of(y, now.down, now.up, mode), (top, bottom), strict=True):
        assert found == pytest.approx(expected, rel=1e-12)
    rates = march.rate(y, now.t, now.begin, mode, now.down, now.up)
    assert rates[:, W] == pytest.approx(a, rel=1e-11)
    assert np.array_equal(rates[:, X], y[:, W])
    held = 0.0 if mode.ground else 1.0
    assert rates[:, V] == pytest.approx(held * (bottom - Q) / M, rel=1e-12)
    assert np.array_equal(rates[:, U], held * y[:, V])
    sagging = np.zeros(rule.COUNT)
    if march.heavy is not None:
        sagging = y[:, ZD]
        assert rates[:, ZD] * 0.6 * M == pytest.approx(top - 8 * K * y[:, Z] - 3e3 * y[:, ZD], rel=1e-10)
    elif march.soft is not None and march.rod is not None and mode.taut:
        sagging = y[:, W] - (6 * K * y[:, Z] - 2 * now.up) / ROD.impedance  # of a rope's end: F = Z (w - z') + 2 g
    assert rates[:, Z] == pytest.approx(sagging, rel=1e-12)
    strain = np.maximum(now.strain, 0.0) if march.hauled is not None else 0.0
    if march.hauled is not None:
        wound = 3e-3 if mode.turn < 0 else strain
        assert rates[:, S] == pytest.approx(y[:, W] / (1 + wound), rel=1e-13)

    gear, power = march._through(y, now.t, now.begin, mode, top)
    assert gear == pytest.approx(through, rel=1e-10)
    if follows:
        assert march.needed(y, now.t, now.begin, mode, top) == pytest.approx(push, rel=1e-12)
    put_in = push * y[:, W] - (0.0 if mode.ground else Q * y[:, V])
    assert power[:, 0] == pytest.approx(put_in, rel=1e-10)
    changes = (MOTOR + DRUM) * y[:, W] * a + held * y[:, V] * (bottom - Q)
    if march.heavy is not None:
        changes += 0.6 * M * y[:, ZD] * rates[:, ZD] + 8 * K * y[:, Z] * y[:, ZD]
    if march.rod is not None:  # what comes in at its ends
        changes += top * (y[:, W] - sagging) - held * bottom * y[:, V]
        changes += 6 * K * y[:, Z] * sagging if march.soft is not None else 0.0
    elif mode.taut:  # C e^2 s/2 and, under a spring alone, (C e)^2/2 k
        c, left = K * 10, 10.0 - y[:, S]
        gives = 1 / (6 * K) if march.soft is not None else 0.0
        apart = rates[:, S] - rates[:, U] - (rates[:, Z] if march.heavy is not None else 0.0)
        stretches = (apart + strain * rates[:, S]) / (left + c * gives)
        changes += c * strain * stretches * left - c * strain**2 * rates[:, S] / 2 + c**2 * gives * strain * stretches
    size = float(np.abs(power).max())
    assert power[:, 0] - power[:, 1] == pytest.approx(changes, abs=1e-11 * size)


@ROPES
@BRIDGES
def test_at_rest_the_gear_carries_the_rope_unless_the_drum_is_braked(
    rope: Rod | Hauled, structure: Structure | None
) -> None:
    for braked in (False, True):
        haul = machine(structure) if braked else machine(structure, drum_brake=Tripped())
        march = March(haul, rope)
        now = Instant(march, mode_of(0))
        gear, power = march._through(now.y, now.t, now.begin, now.mode, now.forces[0])
        assert gear == pytest.approx(np.zeros(rule.COUNT) if braked else now.forces[0], rel=1e-12)
        assert power[:, 0] == pytest.approx(-Q * now.y[:, V])
        rates = march.rate(now.y, now.t, now.begin, now.mode, now.down, now.up)
        assert not rates[:, [W, X]].any()


@ROPES
@BRIDGES
@pytest.mark.parametrize("lifts", [False, True])
def test_begins_in_balance_with_the_energy_of_its_parts(
    rope: Rod | Hauled, structure: Structure | None, lifts: bool
) -> None:
    """A hanging load moves with the drive, its weight in rope and structure; one on the ground carries nothing."""
    march = March(machine(structure, lifts=lifts, slack=0.4 if lifts else 0.0, speed=-0.2, way=-1), rope)
    mode, y = march.begin()
    assert mode == Mode(-1, -1, False, -1, lifts, not lifts, 0, 0, math.inf)
    assert march.begin()[0].power == -1
    pulls = 0.0 if lifts else Q
    v = 0.0 if lifts else -0.2
    assert (y[W], y[V]) == (-0.2, v)
    down, up = march._incoming(1e-6 * rule.NODES)
    moving = np.tile(y, (rule.COUNT, 1))
    for force in march.ends_of(moving, down, up, mode):
        assert force == pytest.approx(np.full(rule.COUNT, pulls), rel=1e-9)
    expected = (MOTOR + DRUM) * 0.2**2 / 2 + M * v**2 / 2
    if isinstance(rope, Rod):
        expected += pulls**2 / (2 * K) + 0.2 * M * v**2 / 2
    else:
        strain = pulls / (K * 10)
        left = (10.0 - (pulls / structure.stiffness if structure is not None else 0.0)) / (1 + strain)
        expected += pulls * strain * left / 2
        assert y[S] == pytest.approx(-0.4 if lifts else 10.0 - left, rel=1e-9)
    if structure is not None:
        expected += pulls**2 / (2 * structure.stiffness)
    assert march.stored(mode, y, []) == pytest.approx(expected, rel=1e-10)
    if march.heavy is not None:  # and the structure's own
        y[ZD] = 0.3
        assert march.stored(mode, y, []) == pytest.approx(expected + 0.6 * M * 0.3**2 / 2, rel=1e-10)


@pytest.mark.parametrize(("speed", "way", "pushing", "power"), [(0.0, 0, 1, -1), (0.5, 1, 1, 1), (-0.5, -1, -1, -1)])
def test_begins_the_way_it_turns(speed: float, way: int, pushing: int, power: int) -> None:
    mode, _ = March(machine(speed=speed, way=way), ROD).begin()
    assert (mode.turn, mode.pushing, mode.power, mode.taut) == (np.sign(speed), pushing, power, True)
    assert March(machine(lifts=True), ROD).begin()[0].taut
    steps = Stage(Lines(np.array([0.0, 0.4]), np.array([Q, 2 * Q])))
    assert March(machine(speed=speed, way=way, stages=(steps,)), ROD).begin()[0].piece == np.sign(speed)


def test_a_structure_of_a_gram_is_heavy_and_one_without_mass_a_spring() -> None:
    light = March(machine(Structure(K, 1e-3, 0.0)), ROD)
    assert (light.heavy is not None, light.soft) == (True, None)
    spring = March(machine(SOFT), ROD)
    assert (spring.heavy, spring.soft) == (None, SOFT)


# -- what keeps a mode ----------------------------------------------------------------------------------------------


def guards_of(now: Instant) -> dict[str, tuple[np.ndarray, float]]:
    found = now.march.guards(now.y, now.t, now.begin, now.mode, now.down, now.up)
    return {name: (values, size) for name, values, size in found}


@ROPES
@pytest.mark.parametrize("mode", MODES[:4], ids=str)
def test_guards_of_a_drive_on_its_curve(rope: Rod | Hauled, mode: Mode) -> None:
    """Each is what is left of its margin, small against the sum of what stands in it."""
    now = Instant(March(machine(level=2 * Q, lifts=True), rope), mode)
    _, through, push = now.drive()
    motor, drum = now.brakes
    top = now.forces[0]
    fastest = float(np.abs(now.y[:, [W, V]]).max())
    found = guards_of(now)
    assert found["rest"][0] == pytest.approx(np.abs(now.y[:, W]))
    assert found["stage"][0] == pytest.approx(3.5 - now.y[:, W])
    assert found["rest"][1] == found["stage"][1] == pytest.approx(max(0.2, fastest))
    # the gear's force has the sign of this whatever its losses: without them it is that force
    lossless = Instant(March(replace(now.haul, gear=(1.0, 1.0)), rope), mode)
    inertia = MOTOR * 1.0 + DRUM * (1 / GEAR[0] if mode.power > 0 else GEAR[1])
    expected = mode.power * mode.turn * through * inertia / (MOTOR + DRUM)
    assert found["power"][0] == pytest.approx(expected, rel=1e-10)
    assert guards_of(lossless)["power"][0] == pytest.approx(expected, rel=1e-10)
    size = Q + float(np.abs(push).max()) + float(motor.max() + drum.max())
    assert found["power"][1] == pytest.approx(size)
    assert found["land"][0] == pytest.approx(now.y[:, U])
    assert found["land"][1] == pytest.approx(float(now.y[:, U].max()))
    assert found["trip"][0] == pytest.approx(2 * Q - top)
    assert found["trip"][1] == found["slack"][1] * (1e-3 if isinstance(rope, Rod) else 1) == Q
    last = now.mode._replace(stage=1)
    assert "stage" not in guards_of(Instant(now.march, last))
    assert "trip" not in guards_of(Instant(now.march, now.mode._replace(trip=1.0)))
    assert "land" not in guards_of(Instant(March(machine(), rope), mode))


@ROPES
@pytest.mark.parametrize("mode", MODES[:4], ids=str)
def test_guards_of_a_drive_that_keeps_its_speed(rope: Rod | Hauled, mode: Mode) -> None:
    now = Instant(March(kept(), rope), mode._replace(follows=True))
    _, through, push = now.drive()
    cap = 0.8 * Q * (4 + now.t)
    found = guards_of(now)
    assert found["up to its limit"][0] == pytest.approx(cap - push)
    assert found["down to its limit"][0] == pytest.approx(cap + push)
    assert found["up to its limit"][1] == found["down to its limit"][1] == pytest.approx(Q + cap[0])
    assert found["power"][0] == pytest.approx(mode.power * mode.turn * through)
    assert found["power"][1] == Q
    for pushing in (1, -1):
        on = Instant(now.march, mode._replace(pushing=pushing))
        values, size = guards_of(on)["catches up"]
        assert values == pytest.approx(pushing * (SPEED + RISE * now.t - on.y[:, W]))
        assert size == pytest.approx(max(0.2, float(np.abs(on.y[:, [W, V]]).max())))


@ROPES
def test_at_rest_it_breaks_away_where_the_force_beats_gear_tackle_and_brakes(rope: Rod | Hauled) -> None:
    now = Instant(March(machine(drum_brake=Tripped(Course(values=(0.7 * Q,)))), rope), mode_of(0, ground=True))
    motor, drum = now.brakes[0], np.full(rule.COUNT, 0.7 * Q)
    top, bottom = now.forces
    pull = now.curve
    found = guards_of(now)
    assert found["up"][0] == pytest.approx((top / TACKLE[0] + drum) / GEAR[0] + motor - pull)
    down = top * TACKLE[1] - drum
    assert (down > 0).any()
    assert (down < 0).any()
    through = np.where(down > 0, down * GEAR[1], down / GEAR[0])
    assert found["down"][0] == pytest.approx(pull + motor - through)
    size = Q + float(np.abs(pull).max()) + float(motor.max() + drum.max())
    assert found["up"][1] == found["down"][1] == pytest.approx(size)
    assert found["lift"][0] == pytest.approx(Q - bottom)
    assert found["lift"][1] == Q


def test_what_is_missing_to_break_away_is_the_same_in_any_unit() -> None:
    """A load that pushes through the gear, one that pulls, each in newtons and in billionths of them."""
    march = March(machine(), HAULED)
    top, drum = np.array([9.0, 3.0, 0.5]), np.array([0.2, 4.0, 0.1])
    pull, motor = np.array([1.0, 0.3, 2.0]), np.array([0.4, 0.4, 0.0])
    down = top * TACKLE[1] - drum
    for size in (1.0, 1e-9):
        up, back = march._break_away(size * top, size * pull, size * motor, size * drum)
        assert up / size == pytest.approx((top / TACKLE[0] + drum) / GEAR[0] + motor - pull)
        assert back / size == pytest.approx(pull + motor - np.where(down > 0, down * GEAR[1], down / GEAR[0]))


def test_guards_of_a_slack_rope() -> None:
    rod = Instant(March(machine(slack=0.4), ROD), mode_of(taut=False))
    values, size = guards_of(rod)["taut"]
    assert values == pytest.approx(0.4 - rod.y[:, X])
    assert size == 0.4
    hauled = Instant(March(machine(), HAULED), mode_of(taut=False))
    elastic = K * 10 * hauled.strain
    whole = elastic + 2e3 * (hauled.y[:, W] - hauled.y[:, V])
    values, size = guards_of(hauled)["taut"]
    assert values == pytest.approx(-np.minimum(elastic, whole))
    assert size == Q


def test_sizes_go_down_with_what_moves() -> None:
    """To a billionth: a hook that creeps is no rest, a knot that is near is a knot."""
    haul = machine(speed=0.0, lifts=True, stages=(Stage(Lines(np.array([-1e-7, 1e-7]), np.array([Q, 0.5 * Q]))),))
    now = Instant(March(haul, HAULED), mode_of(piece=0))
    now.y[:] *= 1e-7
    found = guards_of(now)
    assert found["rest"][1] == pytest.approx(float(np.abs(now.y[:, [W, V]]).max()))
    assert found["land"][1] == pytest.approx(float(np.abs(now.y[:, U]).max()))
    for piece, values in ((-1, now.y[:, W] + 1e-7), (1, 1e-7 - now.y[:, W])):
        assert found[f"knot {piece}"][0] == pytest.approx(values)
        assert found[f"knot {piece}"][1] == pytest.approx(float(np.abs(values).max()))
    now.y[:] *= 1e-9
    found = guards_of(now)
    assert found["rest"][1] == found["land"][1] == 1e-9
    slack = Instant(March(machine(slack=1e-7), ROD), mode_of(taut=False))
    assert guards_of(slack)["taut"][1] == 1e-7


# -- events ---------------------------------------------------------------------------------------------------------


def settled(march: March, mode: Mode, fired: str, y: np.ndarray, time: float = 1.25) -> tuple[Mode, np.ndarray, Played]:
    done = Played([], [], mode, time, y, 0.0)
    after, state = march._settled(done, mode, y, time, fired)
    return after, state, done


@ROPES
@pytest.mark.parametrize("masses", [(MOTOR, DRUM), (5.0, 3e3), (1e-9, 1e-6)])
@pytest.mark.parametrize("motor", [-0.5, 0.2, 1.1])
@pytest.mark.parametrize("before", [1, -1])
@pytest.mark.parametrize(("fired", "turn"), [("up", 1), ("down", -1)])
def test_what_breaks_away_goes_that_way_with_the_power_that_the_gear_shows(
    rope: Rod | Hauled, fired: str, turn: int, before: int, motor: float, masses: tuple[float, float]
) -> None:
    stage = Stage(Lines(np.zeros(1), np.array([motor * Q])))
    haul = machine(stages=(stage,), gate=Tripped(Course(values=(1.0,))), motor_mass=masses[0], drum_mass=masses[1])
    march = March(haul, rope)
    march.begin()
    y = np.zeros(7)
    y[S] = 10 * 0.4 * Q / (K * 10)
    if march.rod is not None:
        march.history[0][2][:] = 0.2 * Q
    after, state, done = settled(march, mode_of(0, before), fired, y)
    assert after.turn == turn
    assert done.events == [(1.25, fired)]
    assert np.array_equal(state, y)
    down, up = march._incoming_at(1.25)
    top = float(march.ends_of(y[None], down, up, after)[0][0])
    on_motor, on_drum = 0.3 * Q + 0.1 * Q * 1.25, 0.2 * Q + 0.05 * Q * 1.25
    behind = top / TACKLE[0] + on_drum if turn > 0 else top * TACKLE[1] - on_drum
    rows = [[masses[1], -1], [masses[0], 1.0]]
    _, through = np.linalg.solve(rows, [-behind, motor * Q - turn * on_motor])
    assert after.power == np.sign(through * turn)


def test_waves_just_after_a_time_are_those_of_the_panel_that_holds_it() -> None:
    """Up to a ten millionth of a transit before the next one."""
    march = March(machine(), ROD)
    tau = ROD.transit
    first, second = (np.tile(pair, (rule.COUNT, 1)) for pair in ([1.0, 2.0], [5.0, 6.0]))
    for seam, expected in ((0.25 + 3e-5, [1.0, 2.0]), (0.25 - 3e-5, [5.0, 6.0]), (0.25, [5.0, 6.0])):
        march.history.clear()
        march.history.extend([(-tau, seam * tau, first), ((seam - 1) * tau, (1 - seam) * tau, second)])
        assert [float(one[0]) for one in march._incoming_at(0.25 * tau)] == pytest.approx(expected)


def test_a_march_starts_at_0(monkeypatch: pytest.MonkeyPatch) -> None:
    times: list[tuple[float, str]] = []
    whole = March._settled

    def settle(self: March, done: Played, mode: Mode, y: np.ndarray, time: float, fired: str) -> Any:
        times.append((time, fired))
        return whole(self, done, mode, y, time, fired)

    monkeypatch.setattr(March, "_settled", settle)
    March(machine(), HAULED).play(1e-3)
    assert times[0] == (0.0, "start")


def test_each_event_changes_what_it_says() -> None:
    march = March(machine(), HAULED)
    _, y = march.begin()
    y[V] = -0.3
    mode = mode_of()
    assert settled(march, mode, "power", y)[0] == mode._replace(power=-1)
    assert settled(march, mode._replace(power=-1), "power", y)[0] == mode
    assert settled(march, mode._replace(ground=True), "lift", y)[0] == mode
    after, state, done = settled(march, mode, "land", y)
    assert (after, done.lost, state[U], state[V]) == (mode._replace(ground=True), M * 0.3**2 / 2, 0.0, 0.0)
    assert settled(march, mode, "slack", y)[0] == mode._replace(taut=False)
    assert settled(march, mode._replace(taut=False), "taut", y)[0] == mode
    assert settled(march, mode, "trip", y)[0].trip == 1.25
    assert settled(march, mode, "knot 3", y)[0].piece == 3
    assert settled(march, mode, "stage", y)[0].stage == 1
    assert settled(march, mode._replace(follows=True), "up to its limit", y)[0]._replace(power=1) == mode
    down = settled(march, mode._replace(follows=True), "down to its limit", y)[0]
    assert (down.follows, down.pushing) == (False, -1)
    after, state, done = settled(march, mode, "rest", y)
    assert (after.turn, state[W], done.rests) == (0, 0.0, [1.25])


@pytest.mark.parametrize("start", [0.9, 1 - 1e-8, 1 - 1e-10, 1.0, 1 + 1e-10, 1 + 1e-8, 1.1])
def test_a_drive_at_its_set_speed_keeps_it_and_another_pushes_towards_it(start: float) -> None:
    """Equal to 1e-9 of it, which is rounding; else with all its force, up where it is too slow."""
    march = March(kept(), HAULED)
    _, y = march.begin()
    wanted = SPEED + RISE * 1.25
    y[W] = start * wanted
    after, state, _ = settled(march, mode_of(pushing=-1 if start < 1 else 1), "catches up", y)
    if abs(start - 1) < 1e-9:
        assert (after.follows, after.turn, state[W]) == (True, 1, wanted)
    else:
        assert (after.follows, after.pushing, state[W]) == (False, 1 if start < 1 else -1, y[W])


@pytest.mark.parametrize(("cap", "follows", "pushing"), [(1 - 5e-10, True, 0), (1 - 3e-9, False, 1)])
@pytest.mark.parametrize("way", [1, -1])
def test_a_set_speed_is_kept_as_far_as_the_force_goes(cap: float, follows: bool, pushing: int, way: int) -> None:
    """From rest at a set speed of 0 that rises, or falls: the force that takes is the capacity, to a billionth."""
    load = 10 * Q if way < 0 else 0.0
    course = Course((0.0,), (0.0,), (way * RISE,))
    bare = {"motor_brake": Tripped(), "drum_brake": Tripped(), "gate": Tripped(Course(values=(1.0,)))}
    haul = replace(kept(speed=0.0, way=way, **bare), set_speed=course, motor_mass=MOTOR + load)
    _, y = March(haul, HAULED).begin()
    through = DRUM * way * RISE + (Q / TACKLE[0] if way > 0 else Q * TACKLE[1])
    lever = 1 / GEAR[0] if through * way > 0 else GEAR[1]
    need = haul.motor_mass * way * RISE + lever * through
    march = March(replace(haul, capacity=Course(values=(cap * abs(need),))), HAULED)
    after, _, _ = settled(march, march.begin()[0], "start", y, 0.0)
    assert after.follows is follows
    if follows:
        assert (after.turn, after.power) == (way, np.sign(through * way))
    else:
        assert after.pushing == pushing * np.sign(need)


# -- panels ---------------------------------------------------------------------------------------------------------


def lines(slope: float) -> tuple[Stage, ...]:
    law = Lines(np.array([0.0, 0.1, 0.5]), np.array([0.0, slope * 0.05, -slope * 0.35]))
    return (Stage(Smooth(np.zeros_like)), Stage(law))


Z_ = math.sqrt(K * M)
LIGHT = Hauled(K * 10, 10.0, 0.0, 0.0)
LONGEST: dict[str, tuple[Haul, Rod | Hauled, float]] = {
    "the load against the wave": (machine(motor_mass=1e6, load_mass=1e3), Rod(K, M), 1e3 / Z_),
    "the drive against the wave": (machine(motor_mass=100.0, drum_mass=50.0), Rod(K, M), 150 / Z_),
    "the structure against the wave": (machine(Structure(K, 200.0, 0.0), motor_mass=1e6), Rod(K, M), 200 / Z_),
    "a spring against the wave": (machine(Structure(5 * K, 0.0, 0.0), motor_mass=1e6), Rod(K, M), Z_ / (5 * K)),
    "the load on its rope": (machine(load_mass=500.0), LIGHT, math.sqrt(500 / (3 * K))),
    "the drive on its rope": (machine(motor_mass=200.0, drum_mass=100.0), LIGHT, math.sqrt(300 / (3 * K))),
    "a structure on the rope": (machine(Structure(0.1 * K, 100.0, 0.0)), LIGHT, math.sqrt(100 / (3 * K))),
    "damping of the rope": (machine(), Hauled(K * 10, 10.0, 3e5, 0.0), (MOTOR + DRUM) / 9e5),
    "a stiff structure": (machine(Structure(50 * K, M, 0.0)), LIGHT, math.sqrt(M / (51 * K))),
    "a stiff structure of a rod": (machine(Structure(50 * K, M, 0.0)), Rod(K, 1e-3 * M), math.sqrt(1e-3 * M / K)),
    "a stiffer structure of a rod": (machine(Structure(5e4, 1.0, 0.0)), Rod(1e-3, 1e-6), math.sqrt(1 / 5e4)),
    "a damped structure": (machine(Structure(K, 1e3, 9e5)), LIGHT, 1e3 / 9e5),
    "hardly anything": (
        machine(motor_mass=1e-3, drum_mass=0.0, load_mass=1e-3, stages=()),
        Hauled(1e-12, 1.0, 0.0, 0.0),
        math.sqrt(1e-3 / 3e-12),
    ),
    "a rod that hardly pulls, without a drive": (
        machine(motor_mass=0.0, drum_mass=0.0, load_mass=1e-3, stages=()),
        Rod(1e-9, 1e-3),
        1e-3 / 1e-6,
    ),
    "a steep curve": (machine(stages=lines(2e6)), LIGHT, (MOTOR + DRUM) / 2e6),
    "a stiff control": (machine(stages=(Stage(Governed(NONE, 1e6, Q)),)), LIGHT, (MOTOR + DRUM) / 1e6),
}


@pytest.mark.parametrize("name", LONGEST)
def test_a_panel_takes_no_more_than_half_as_much_again_as_the_fastest_of_its_times(name: str) -> None:
    haul, rope, fastest = LONGEST[name]
    transit = rope.transit if isinstance(rope, Rod) else math.inf
    assert March(haul, rope).longest == pytest.approx(min(1.5 * fastest, transit), rel=1e-12)
    assert March(haul, rope, 3.0).longest == pytest.approx(min(1.5 * fastest, transit) / 3, rel=1e-12)


def test_rounding_is_nothing_beside_all_speeds_and_ways_so_far_and_a_fall_over_the_panel() -> None:
    march = March(machine(), HAULED)
    h = 0.01
    assert march._sizes(np.zeros((3, 7)), h)[[W, ZD, V]] == pytest.approx(G * h)
    assert march._sizes(np.zeros((3, 7)), h)[[X, Z, U, S]] == pytest.approx(G * h * h)
    y = np.zeros((3, 7))
    y[1, V], y[2, U] = -5.0, -3.0
    assert march._sizes(y, h) == pytest.approx([5.0, 3.0, 3.0, 5.0, 5.0, 3.0, 3.0])
    march.sizes = np.full(7, 9.0)
    assert march._sizes(y, h) == pytest.approx([9.0] * 7)


def test_a_panel_that_does_not_converge_is_halved_and_the_next_ones_double(monkeypatch: pytest.MonkeyPatch) -> None:
    tried: list[float] = []
    whole = March._panel

    def panel(self: March, done: Played, h: float) -> tuple[Panel | None, str | None]:
        tried.append(h)
        return (None, None) if len(tried) <= 3 else whole(self, done, h)

    monkeypatch.setattr(March, "_panel", panel)
    march = March(machine(motor_brake=Tripped(), drum_brake=Tripped()), HAULED)
    march.play(20 * march.longest)
    assert np.array(tried[:9]) / march.longest == pytest.approx([1, 1 / 2, 1 / 4, 1 / 8, 1 / 4, 1 / 2, 1, 1, 1])


def test_what_never_converges_is_given_up_below_a_hundred_thousandth_of_a_panel() -> None:
    """17 halvings; each panel in vain counts as five."""
    haul = machine(stages=(Stage(Smooth(lambda w: np.full(w.shape, np.nan))),))
    with pytest.raises(NumericsError, match="does not converge"):
        March(haul, HAULED).play(1.0, 5 * 16 + 1)
    with pytest.raises(NumericsError, match="given up"):
        March(haul, HAULED).play(1.0, 5 * 16)


def test_so_many_panels_and_no_more() -> None:
    haul = machine(motor_brake=Tripped(), drum_brake=Tripped())
    march = March(haul, HAULED)
    count = 6
    end = (count - 0.5) * march.longest
    found = march.play(end, count)
    assert (len(found.panels), found.events) == (count, [])
    assert found.time == end
    with pytest.raises(NumericsError, match="more than 5 steps"):
        March(haul, HAULED).play(end, count - 1)


@pytest.mark.parametrize("share", [1e-6, 1e-9, 1e-12])
def test_the_last_of_a_march_is_played_however_short(share: float) -> None:
    """A brake changes just before the end."""
    end = 0.02
    breaks = Course((0.0, end * (1 - share)), (0.0, 0.1 * Q), (0.0, 0.0))
    found = March(machine(motor_brake=Tripped(breaks), drum_brake=Tripped()), HAULED).play(end)
    assert found.time == end
    assert sum(panel.length for panel in found.panels) == pytest.approx(end, rel=1e-14)
    assert found.panels[-1].length == pytest.approx(share * end, rel=1e-3)


def test_what_ends_as_soon_as_it_begins_does_nothing() -> None:
    """A brake that would stop the drive at once, for a millionth of a millionth of a second."""
    blow = Course((0.0, 0.02, 0.02 + 1e-12), (0.0, 90 * Q, 0.0), (0.0, 0.0, 0.0))
    bare, struck = (
        March(machine(motor_brake=Tripped(one), drum_brake=Tripped()), HAULED).play(0.05) for one in (NONE, blow)
    )
    assert struck.events == bare.events
    assert struck.state == pytest.approx(bare.state, rel=1e-8, abs=1e-12)


def test_forty_events_at_once_are_too_many(monkeypatch: pytest.MonkeyPatch) -> None:
    looked: list[float] = []

    def panel(self: March, done: Played, h: float) -> tuple[Panel, str]:
        looked.append(done.time)
        return Panel(done.time, 0.0, done.state[None], *(np.zeros(1),) * 5, np.zeros((1, 2))), "power"

    monkeypatch.setattr(March, "_panel", panel)
    with pytest.raises(NumericsError, match="chatters"):
        March(machine(), HAULED).play(1.0)
    assert looked == [0.0] * 41


def test_forty_events_at_once_are_not_too_many_again_after_a_while(monkeypatch: pytest.MonkeyPatch) -> None:
    """Twice forty, a panel between them."""
    looked: list[float] = []
    whole = March._panel

    def panel(self: March, done: Played, h: float) -> tuple[Panel, str | None]:
        looked.append(done.time)
        if looked.count(done.time) <= 40 and done.time < 1.5 * self.longest:
            return Panel(done.time, 0.0, done.state[None], *(np.zeros(1),) * 5, np.zeros((1, 2))), "power"
        found, fired = whole(self, done, h)
        assert found is not None
        return found, fired

    monkeypatch.setattr(March, "_panel", panel)
    march = March(machine(motor_brake=Tripped(), drum_brake=Tripped()), HAULED)
    march.play(3.5 * march.longest)
    assert [looked.count(time) for time in dict.fromkeys(looked)] == [41, 41, 1, 1]


@pytest.mark.parametrize(("dip", "fires"), [(1e-12, False), (5e-12, False), (2e-11, True), (1e-9, True)])
@pytest.mark.parametrize("size", [1e-3, 1.0, 1e5])
def test_a_guard_is_below_0_beyond_1e11_of_its_size(dip: float, fires: bool, size: float) -> None:
    values = size * (0.5 - rule.NODES) * 2 * dip
    march = March(machine(motor_brake=Tripped(), drum_brake=Tripped()), HAULED)
    mode, y = march.begin()
    done = Played([], [], mode, 0.0, y, 0.0)
    march.guards = lambda *_: [("soon", values, size)]  # type: ignore[method-assign]
    panel, fired = march._panel(done, march.longest)
    assert panel is not None
    assert fired == ("soon" if fires else None)
    share = panel.length / march.longest
    assert 0.5 - 1e-9 <= share <= 0.75 + 1 / 56 if fires else share == 1


def test_the_first_of_two_guards_ends_a_panel() -> None:
    march = March(machine(motor_brake=Tripped(), drum_brake=Tripped()), HAULED)
    mode, y = march.begin()
    done = Played([], [], mode, 0.0, y, 0.0)
    roots = {"late": 0.7, "soon": 0.3, "between": 0.5}
    march.guards = lambda *_: [(name, at - rule.NODES, 1.0) for name, at in roots.items()]  # type: ignore[method-assign]
    panel, fired = march._panel(done, march.longest)
    assert panel is not None
    assert fired == "soon"
    assert panel.length == pytest.approx(0.3 * march.longest, rel=1e-12)


@pytest.mark.parametrize(("left", "runs_out"), [(1.005, False), (0.995, True)])
def test_a_hundredth_of_the_rope_is_the_last_that_is_followed(left: float, runs_out: bool) -> None:
    march = March(machine(), HAULED)
    mode, y = march.begin()
    y[S] = 10.0 - left * 0.1
    done = Played([], [], mode, 3.0, y, 0.0)
    if runs_out:
        with pytest.raises(NumericsError, match="all of the rope"):
            march._runs_out(done)
    else:
        march._runs_out(done)
    March(machine(), ROD)._runs_out(done)


@pytest.mark.parametrize(("share", "taken"), [(0.01, True), (0.9, True), (1.1, False), (30.0, False)])
def test_what_rounds_to_and_fro_has_converged_and_what_strays_more_has_not(share: float, taken: bool) -> None:
    """A force that is another in every round, by what changes the speed by so much of 1e-13 of the largest one."""
    rounds, by = 0, 0.0

    def force(w: np.ndarray) -> np.ndarray:
        nonlocal rounds
        rounds += 1
        return np.full(w.shape, Q + by * (-1) ** rounds)

    bare = {"motor_brake": Tripped(), "drum_brake": Tripped(), "gate": Tripped(Course(values=(1.0,)))}
    march = March(machine(stages=(Stage(Smooth(force)),), gear=(1.0, 1.0), **bare), HAULED)
    mode, y = march.begin()
    mode = mode._replace(turn=1, power=1)
    h = march.longest / 4
    panel, _ = march._panel(Played([], [], mode, 0.0, y, 0.0), h)
    assert panel is not None
    by = share * 1e-13 * float(np.abs(panel.states[:, [W, V]]).max()) * (MOTOR + DRUM) / (2 * h)
    assert (march._panel(Played([], [], mode, 0.0, y, 0.0), h)[0] is not None) is taken


@pytest.mark.parametrize(("share", "length", "taken"), [(0.8, 1, True), (1.25, 1, False), (1e3, 1.1e-3, False),
                                                        (1e3, 0.9e-3, True)])  # fmt: skip
def test_a_panel_whose_series_has_not_faded_is_too_long_unless_it_is_very_short(
    share: float, length: float, taken: bool
) -> None:
    """A wave with a last coefficient of so much of 1e-12: M v' = 2 f - Z v - Q."""
    march = March(machine(motor_brake=Tripped(), drum_brake=Tripped()), ROD)
    mode, y = march.begin()
    h = length * march.longest
    size = max(0.2, h * G)  # of the speeds
    values = np.tile(march.history[0][2][0], (rule.COUNT, 1))
    values[:, 0] += share * 1e-12 * size / h * M / 2 * np.cos(13 * np.arccos(np.clip(2 * rule.NODES - 1, -1, 1)))
    march.history.clear()
    march.history.append((-ROD.transit, h, values))
    assert (march._panel(Played([], [], mode, 0.0, y, 0.0), h)[0] is not None) is taken


def test_a_panel_begins_wherever_something_changes_after_the_limiter_has_tripped() -> None:
    """The drive is off 0.03 s after it and a brake comes 0.05 s after it: until then the drive puts in what it did."""
    late = Tripped(NONE, Course((0.0, 0.05), (0.0, 6 * Q), (0.0, 0.0)))
    gate = Tripped(Course(values=(1.0,)), Course((0.0, 0.03), (1.0, 0.0), (0.0, 0.0)))
    stages = (Stage(Lines(np.zeros(1), np.array([3 * Q]))),)
    haul = machine(stages=stages, gate=gate, motor_brake=late, drum_brake=Tripped(), level=1.2 * Q)
    found = March(haul, HAULED).play(0.4)
    trip = found.mode.trip
    assert 0 < trip < 0.3
    starts = [panel.start for panel in found.panels]
    for after in (0.03, 0.05):
        assert min(abs(start - (trip + after)) for start in starts) < 1e-12
    for panel in found.panels:
        force = 3 * Q if panel.start < trip + 0.03 - 1e-9 else 0.0
        assert panel.power[:, 0] + Q * panel.states[:, V] == pytest.approx(force * panel.states[:, W], abs=1e-9 * Q)


def test_the_last_stage_of_a_drive_goes_on_whatever_ends_it() -> None:
    now = Instant(March(machine(stages=(Stage(Lines(np.zeros(1), np.array([Q])), until=0.1),)), HAULED), mode_of())
    assert "stage" not in guards_of(now)
