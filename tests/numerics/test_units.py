"""Nothing knows the units it is told in: metre, kilogram and second a thousand or a million times as large or small.

The factors are powers of 2, so that rounding is the same too: a constant that should have a unit and has none is seen
whatever its size.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import pytest
from support.trains import run

from ptmcalc.numerics.belt.course import Reach, lay_out
from ptmcalc.numerics.belt.give import Give, Rubber
from ptmcalc.numerics.belt.march import Drawn, Until, march, place_at
from ptmcalc.numerics.belt.station import Drum, Place, Seen, Station, TakeUp
from ptmcalc.numerics.belt.travel import Travel
from ptmcalc.numerics.mast.base import Base, Guide, Obstacle
from ptmcalc.numerics.mast.base import Grip as Slips
from ptmcalc.numerics.mast.base import Signal as Force
from ptmcalc.numerics.mast.case import Case as Followed
from ptmcalc.numerics.mast.modes import Mast
from ptmcalc.numerics.mast.parts import Column, Lump, Prop, Segment
from ptmcalc.numerics.mast.run import play
from ptmcalc.numerics.pendulum.parts import Axis, Buffer, Case, Follow, Gear, Jib, Load, Push, Rail
from ptmcalc.numerics.pendulum.parts import Smooth as Curve
from ptmcalc.numerics.pendulum.parts import Straight as Knotted
from ptmcalc.numerics.pendulum.pieces import Pieces
from ptmcalc.numerics.pendulum.swing import swing
from ptmcalc.numerics.rope.equations import ZD, Hauled, Rod, S, U, V, W, X, Z
from ptmcalc.numerics.rope.march import March, energy
from ptmcalc.numerics.rope.parts import Course, Governed, Haul, Law, Lines, Smooth, Stage, Structure, Tripped
from ptmcalc.numerics.train.parts import Body, Drive, Grip, Impulse, Mesh, Spring, Straight, Train
from ptmcalc.numerics.train.signals import Signal, Sine, Trigger


@dataclass(frozen=True)
class Units:
    """How many of the new units one of the old ones is."""

    mass: float = 1.0
    length: float = 1.0
    time: float = 1.0

    @property
    def speed(self) -> float:
        return self.length / self.time

    @property
    def force(self) -> float:
        return self.mass * self.length / self.time**2

    @property
    def damping(self) -> float:
        return self.mass / self.time

    @property
    def energy(self) -> float:
        return self.force * self.length


LARGE, SMALL = Units(2.0**20, 2.0**10, 2.0**9), Units(2.0**-20, 2.0**-10, 2.0**-9)
OTHERS = pytest.mark.parametrize("units", [LARGE, SMALL], ids=["large", "small"])
G = 9.81

# -- a hauled load --------------------------------------------------------------------------------------------------

M, K, V0 = 5000.0, 1.2e6, 0.25
Q = M * G


def course(one: Course, size: float, time: float) -> Course:
    return Course(
        tuple(t * time for t in one.times), tuple(v * size for v in one.values),
        tuple(s * size / time for s in one.slopes), one.decay * size, one.constant * time, one.since * time,
    )  # fmt: skip


def tripped(one: Tripped, size: float, time: float) -> Tripped:
    return Tripped(course(one.before, size, time), course(one.after, size, time) if one.after is not None else None)


def law_in(law: Law, units: Units) -> Law:
    if isinstance(law, Lines):
        return Lines(law.knots * units.speed, law.values * units.force, law.extends)
    if isinstance(law, Governed):
        return Governed(course(law.reference, units.speed, units.time), law.stiffness * units.damping,
                        law.limit * units.force)  # fmt: skip
    return Smooth(lambda w: law.value(w / units.speed) * units.force)


def haul_in(one: Haul, units: Units) -> Haul:
    force, speed, time = units.force, units.speed, units.time
    bridge = one.structure
    return Haul(
        one.motor_mass * units.mass, one.drum_mass * units.mass, one.load_mass * units.mass, one.weight * force,
        one.gear, one.tackle,
        Structure(bridge.stiffness * units.mass / time**2, bridge.mass * units.mass, bridge.damping * units.damping)
        if bridge is not None else None,
        one.lifts, one.slack * units.length, one.speed * speed, one.way,
        course(one.set_speed, speed, time) if one.set_speed is not None else None, course(one.capacity, force, time),
        tuple(Stage(law_in(stage.law, units), None if stage.until is None else stage.until * speed,
                    None if stage.until_time is None else stage.until_time * time) for stage in one.stages),
        tripped(one.gate, 1.0, time), tripped(one.motor_brake, force, time), tripped(one.drum_brake, force, time),
        one.level * force,
    )  # fmt: skip


def rope_in(one: Rod | Hauled, units: Units) -> Rod | Hauled:
    if isinstance(one, Rod):
        return Rod(one.stiffness * units.mass / units.time**2, one.mass * units.mass)
    return Hauled(one.extensional * units.force, one.length * units.length, one.damping * units.damping,
                  one.wound_strain)  # fmt: skip


def lossy(**changes: object) -> Haul:
    one = Haul(18000.0, 900.0, M, Q, (0.93, 2 - 1 / 0.93), (0.97, 0.96), None, True, 0.0, 0.0, 1)
    return replace(one, **changes)  # type: ignore[arg-type]


BRAKE = Tripped(Course((0.0, 0.3, 0.4), (0.0, 0.0, 2 * Q), (0.0, 20 * Q, 0.0)))
ROD, HAULED = Rod(K, 0.2 * M), Hauled(K * 10, 10.0, 2e3, Q / (K * 10))
HAULS: dict[str, tuple[Haul, Rod | Hauled]] = {
    "limited speed": (
        lossy(speed=V0, set_speed=Course(values=(V0,)), capacity=Course(values=(1.5 * Q,)),
              structure=Structure(8 * K, 0.5 * M, 1e3)), HAULED),
    "ramp and limiter": (
        lossy(speed=0.0, slack=0.01, set_speed=Course((0.0, 0.4), (0.0, V0), (V0 / 0.4, 0.0)),
              capacity=Course(values=(2.5 * Q,)), gate=Tripped(Course(values=(1.0,)), Course((0.0, 0.05), (1.0, 0.0),
              (0.0, 0.0))), motor_brake=Tripped(Course(), Course((0.0,), (2 * Q,), (0.0,), -2 * Q, 0.1, 0.0)),
              level=1.1 * Q), ROD),
    "curve, spring and brake": (
        lossy(speed=0.1, stages=(Stage(Lines(np.array([0.0, V0]), np.array([3 * Q, 0.0]), True)),),
              structure=Structure(8 * K, 0.0, 0.0), drum_brake=BRAKE), ROD),
    "control": (
        lossy(stages=(Stage(Governed(Course((0.0, 0.2), (0.0, V0), (V0 / 0.2, 0.0)), 40 * Q, 2 * Q), 0.2),
                      Stage(Smooth(lambda w: 2.5 * Q * (1 - (w / V0) ** 3)))), motor_brake=BRAKE), HAULED),
    "lowered and caught": (
        lossy(lifts=False, speed=-0.4, way=-1, motor_brake=Tripped(Course((0.0,), (8 * Q,), (0.0,)))), HAULED),
}  # fmt: skip
END = 0.4


@OTHERS
@pytest.mark.parametrize("name", HAULS)
def test_of_a_hauled_load(name: str, units: Units) -> None:
    haul, rope = HAULS[name]
    marches = March(haul, rope), March(haul_in(haul, units), rope_in(rope, units))
    one, other = marches[0].play(END), marches[1].play(END * units.time)
    assert [what for _, what in one.events] == [what for _, what in other.events] != []
    assert [t for t, _ in other.events] == pytest.approx([t * units.time for t, _ in one.events], rel=1e-12)
    assert len(one.panels) == len(other.panels)
    states = np.empty(7)
    states[[W, ZD, V]], states[[X, Z, U, S]] = units.speed, units.length
    sizes = {"states": states, "top": units.force, "bottom": units.force, "down": units.force, "up": units.force,
             "gear": units.force, "power": units.force * units.speed}  # fmt: skip
    for what, size in sizes.items():
        ours, theirs = one.stack(what) * size, other.stack(what)
        assert theirs == pytest.approx(ours, rel=1e-9, abs=1e-9 * float(np.abs(ours).max())), what
    for whose, found, size in ((marches[0], one, 1.0), (marches[1], other, units.energy)):
        left, scale = energy(whose, found)
        assert left <= 1e-11 * scale
        assert scale == pytest.approx(energy(marches[0], one)[1] * size)
        assert found.lost == pytest.approx(one.lost * size, abs=0.0)


# -- drums on a belt ------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Belt:
    """A station and the waves that arrive there."""

    place: Place
    drums: tuple[Drum, ...]
    takeup: TakeUp | None = None
    imposed: Callable[[float], float] | None = None
    shares: tuple[float, ...] = ()
    n_on: Callable[[float], float] = lambda t: 1.2e5 + 4e4 * math.sin(3 * t)
    p_off: Callable[[float], float] = lambda t: 9e4 + 3e4 * math.sin(2 * t)
    speed: float = 0.0
    creep: float = 0.0


def motor(time: float, speed: float) -> tuple[float, float]:
    return 3e5 * math.sin(2.5 * time) - 4e4 * speed, -4e4


def holds(time: float) -> float:
    return 5e4 + 3e4 * math.sin(1.3 * time)


ON = Place(184e3, 72e3, 7e3, -4e3, 8e3, 5e3, 3e3, 2e3, 400.0)
BELTS = {
    "sticks and slips": Belt(ON, (Drum("a", 2e4, motor, holds, 0.5),), speed=0.3, creep=0.01),
    "two drums": Belt(ON, (Drum("a", 2e4, motor, exponent=0.9), Drum("b", 1e4, motor, exponent=0.4)), TakeUp(6e4)),
    "a heavy take-up": Belt(ON, (Drum("a", 3e4, motor, exponent=0.8),), TakeUp(6e4, 8e3)),
    "a take-up held by its belt": Belt(
        replace(ON, friction_off=2e4), (Drum("a", 3e4, motor),), TakeUp(9e4, 8e3), p_off=lambda t: 9e4 + 4e4 * t
    ),
    "a backstop": Belt(ON, (Drum("a", 2e4, motor, exponent=3.0, one_way=True), Drum("b", 1e4, motor, exponent=2.0))),
    "an imposed speed": Belt(
        ON, (Drum("a", 2e4, exponent=0.6), Drum("b", 1e4, exponent=0.7)), TakeUp(7e4), lambda t: 0.4 * t, (0.7, 0.3)
    ),
    "nothing but belt": Belt(ON, (), creep=0.02),
}


def fed(one: Belt, units: Units = Units(), steps: int = 150, end: float = 3.0) -> tuple[Station, list[Seen]]:
    """Histories of a station, told in other units."""
    force, speed, time, damping = units.force, units.speed, units.time, units.damping
    p = one.place
    place = Place(
        p.before * damping, p.after * damping, p.climb_on * force, p.climb_off * force, p.friction_on * force,
        p.friction_off * force, p.drag_on * damping, p.drag_off * damping, p.belt_line_mass * units.mass / units.length,
    )  # fmt: skip

    def drum(d: Drum) -> Drum:
        def pulls(t: float, v: float) -> tuple[float, float]:
            found, slope = d.force(t / time, v / speed)
            return found * force, slope * damping

        brake = d.brake if d.brake(0.0) == 0 else lambda t: d.brake(t / time) * force
        return replace(d, mass=d.mass * units.mass, force=pulls, brake=brake)

    takeup = TakeUp(one.takeup.tension * force, one.takeup.mass * units.mass) if one.takeup is not None else None
    drive = one.imposed
    imposed = (lambda t: drive(t / time) * speed) if drive is not None else None
    station = Station(place, [drum(d) for d in one.drums], takeup, imposed, one.shares)
    station.creep = one.creep * speed
    times = [end * k / steps for k in range(steps + 1)]
    seen = [station.begin(one.speed * speed, one.n_on(0.0) * force, one.p_off(0.0) * force)]
    seen += [
        station.advance(t * time, one.n_on(t) * force, one.p_off(t) * force, end / steps * time) for t in times[1:]
    ]
    return station, seen


@OTHERS
@pytest.mark.parametrize("name", BELTS)
def test_of_drums_on_a_belt(name: str, units: Units) -> None:
    (here, ours), (there, theirs) = fed(BELTS[name]), fed(BELTS[name], units)
    assert [one.slips for one in ours] == [one.slips for one in theirs]
    for one, other in zip(ours, theirs, strict=True):
        assert other.tensions == pytest.approx([x * units.force for x in one.tensions], rel=1e-11)
        moved = (one.belt, one.behind, *one.drums, one.creep)
        assert (other.belt, other.behind, *other.drums, other.creep) == pytest.approx(
            [x * units.speed for x in moved], rel=1e-11
        )
    assert there.slid == pytest.approx([x * units.length for x in here.slid])
    assert there.heat == pytest.approx([x * units.energy for x in here.heat])
    assert there.work == pytest.approx(here.work * units.energy)


@pytest.mark.parametrize("name", BELTS)
def test_height_is_tension_that_the_waves_bring_and_drag_impedance(name: str) -> None:
    """Where the belt climbs, the same waves with its weight in them; a drag is felt as an impedance is."""
    one = BELTS[name]
    p = one.place
    level = replace(
        one, place=replace(p, climb_on=0.0, climb_off=0.0, before=p.before + p.drag_on, after=p.after + p.drag_off,
                           drag_on=0.0, drag_off=0.0),
        n_on=lambda t: one.n_on(t) + p.climb_on, p_off=lambda t: one.p_off(t) + p.climb_off,
    )  # fmt: skip
    (here, ours), (there, theirs) = fed(one), fed(level)
    for a, b in zip(ours, theirs, strict=True):
        assert a.slips == b.slips
        assert (*a.tensions, *(1e5 * v for v in (a.belt, a.behind, *a.drums))) == pytest.approx(
            (*b.tensions, *(1e5 * v for v in (b.belt, b.behind, *b.drums))), rel=1e-9, abs=1e-4
        )
    assert here.work == pytest.approx(there.work, rel=1e-9)


@pytest.mark.parametrize("name", ["sticks and slips", "nothing but belt", "an imposed speed"])
def test_run_the_other_way_everything_is_a_mirror_image(name: str) -> None:
    """Both sides and all forces change places; without a take-up, which stands on one side, and the belt's own lift,
    which a step takes from its start."""
    p, drive = replace(BELTS[name].place, belt_line_mass=0.0), BELTS[name].imposed
    one = replace(BELTS[name], place=p, takeup=None, creep=0.0)
    back = replace(
        one, place=Place(p.after, p.before, p.climb_off, p.climb_on, p.friction_off, p.friction_on, p.drag_off,
                         p.drag_on, p.belt_line_mass),
        drums=tuple(replace(d, force=lambda t, v, d=d: (-d.force(t, -v)[0], d.force(t, -v)[1])) for d in
                    reversed(one.drums)),
        imposed=(lambda t: -drive(t)) if drive is not None else None, shares=one.shares[::-1], n_on=one.p_off,
        p_off=one.n_on, speed=-one.speed,
    )  # fmt: skip
    (here, ours), (there, theirs) = fed(one), fed(back)
    assert any(seen.belt < 0 for seen in ours) or name == "an imposed speed"
    for a, b in zip(ours, theirs, strict=True):
        assert a.slips == tuple(-sense for sense in reversed(b.slips))
        assert a.tensions == pytest.approx(b.tensions[::-1], rel=1e-9)
        assert (a.belt, *a.drums) == pytest.approx([-v for v in (b.belt, *reversed(b.drums))], rel=1e-9, abs=1e-12)
    assert here.work == pytest.approx(there.work, rel=1e-9)
    assert here.heat == pytest.approx(there.heat[::-1], rel=1e-9)


@OTHERS
@pytest.mark.parametrize("kind", ["elastic", "sags and yields", "runs"])
def test_of_a_whole_belt(kind: str, units: Units) -> None:
    """Both strands in cells, drums at head and tail, a heavy take-up; spans that sag, rubber, and what goes along."""
    force, speed, time = units.force, units.speed, units.time

    def drawn(u: Units) -> Drawn:
        def reach(length: float, line_mass: float, friction: float, climb: float, span: float) -> Reach:
            marks = np.array([0.0, length]) * u.length
            along = np.array([0.0, length])
            return Reach(line_mass * u.mass / u.length, 9e7 * u.force, marks, friction * along * u.force,
                         20.0 * along * u.damping, climb * along * u.force, span * u.force, 0.8)  # fmt: skip

        sags = kind == "sags and yields"
        reaches = reach(300.0, 38.0, 9.0, -3.0, 500.0 * sags), reach(300.0, 200.0, 50.0, 30.0, 900.0 * sags)
        cells = lay_out(reaches, 1, 16)

        def drum(name: str, mass: float, most: float) -> Drum:
            def pulls(t: float, v: float) -> tuple[float, float]:
                return most * min(t / u.time, 1.0) * u.force - 2e3 * v * u.damping, -2e3 * u.damping

            return Drum(name, mass * u.mass, pulls, exponent=0.9)

        at = place_at(cells, 0, 20.0 * u.mass / u.length), place_at(cells, cells.tail, 20.0 * u.mass / u.length)
        head = Station(at[0], [drum("head", 9e3, 9e4)], TakeUp(3e4 * u.force, 2e3 * u.mass))
        tail = Station(at[1], [drum("tail", 3e3, 1e4)])
        tension = np.linspace(3e4, 6e4, cells.cells) * u.force - cells.climb_within
        rubber = Rubber(0.3, 0.2 * u.time) if sags else None
        gives = Give(cells, rubber, 9e7 * u.force) if sags else None
        runs = Travel(cells, 9e7 * u.force, 4.0 * u.speed) if kind == "runs" else None
        return march(cells, head, tail, tension, 4.0 * u.speed if runs else 0.0, 3.0 * u.time, Until(), gives, runs)

    one, other = drawn(Units()), drawn(units)
    assert len(one.times) == len(other.times)
    assert other.times == pytest.approx(one.times * time)
    for what in ("head", "tail"):
        for a, b in zip(getattr(one, what), getattr(other, what), strict=True):
            assert a.slips == b.slips
            assert b.tensions == pytest.approx([x * force for x in a.tensions], rel=1e-9, abs=1e-6 * force)
            assert (b.belt, b.behind, *b.drums, b.creep) == pytest.approx(
                [x * speed for x in (a.belt, a.behind, *a.drums, a.creep)], rel=1e-8, abs=1e-9 * speed
            )
    for name in ("back_max", "back_min", "carry_max", "carry_min"):
        a, b = getattr(one, name), getattr(other, name)
        assert (b.value, b.time, b.place) == pytest.approx((a.value * force, a.time * time, a.place * units.length))
    assert other.friction_work == pytest.approx(one.friction_work * units.energy)
    assert other.stretched == pytest.approx(one.stretched * units.length)
    assert other.energy_residual == pytest.approx(one.energy_residual, rel=1e-3, abs=1e-12)
    assert other.highest == pytest.approx(one.highest * force)
    assert other.lows == pytest.approx(one.lows * force, abs=1e-6 * force)


# -- a swinging load ------------------------------------------------------------------------------------------------

HANGING = Load(700.0, Pieces((0.0, 2.0), ((5.0, -0.3), (4.4,))), 0.06, 0.03, -0.02, 0.05, Pieces.constant(30.0))
LOSSY = Gear(400.0, 0.9, 0.8, Pieces.through(((2.0, 0.0), (2.5, 300.0))))
SWINGS = {
    "pushed along straight pieces": Case(
        G, Rail(0.01), Axis(900.0, Push(Knotted((-0.2, 0.4, 1.0), (1200.0, 900.0, 300.0)), reaches=0.8, limit=700.0),
                            30.0, Pieces.steps(((2.5, 900.0),)), gear=LOSSY), HANGING),
    "kept speed with a limit": Case(
        G, Rail(), Axis(900.0, Follow(Pieces.through(((0.0, 0.0), (1.0, 1.2), (2.0, 1.2), (2.6, 0.0))), 900.0), 40.0,
                        gear=LOSSY), HANGING),
    "buffers": Case(
        G, Rail(), Axis(900.0, Push(Curve(lambda v: 400.0 / (1 + v**2), 400.0)), outer=Pieces.constant(50.0),
                        buffers=(Buffer(0.5, "linear", 3e4), Buffer(0.4, "constant", 900.0),
                                 Buffer(0.45, "orifice", 400.0)), speed=0.9), HANGING),
    "a jib on a slope": Case(
        G, Jib(Pieces((0.0,), ((9.0, 0.2),)), 0.01, 0.4, 5e4),
        Axis(8e4, Push(9e3, until=1.5), 2e3, Pieces.steps(((2.0, 3e4),)), position=0.2, gear=Gear(9e3, 0.9, 0.85)),
        HANGING),
}  # fmt: skip


def pieces(one: Pieces, size: float, time: float) -> Pieces:
    rows = tuple(tuple(c * size / time**k for k, c in enumerate(row)) for row in one.coefficients)
    return Pieces(tuple(t * time for t in one.starts), rows)


def case_in(case: Case, units: Units) -> Case:
    """Along a rail in metres, of a jib in radians."""
    axis, load, pivot, time = case.axis, case.load, case.pivot, units.time
    turns = isinstance(pivot, Jib)
    way = 1.0 if turns else units.length
    speed, push = way / time, units.energy if turns else units.force
    inertia = push / (way / time**2)
    drive = axis.drive
    if isinstance(drive, Follow):
        drive = Follow(pieces(drive.speed, speed, time), drive.limit * push, drive.until * time)
    elif isinstance(drive, Push):
        law = drive.law
        if isinstance(law, Knotted):
            law = Knotted(tuple(v * speed for v in law.knots), tuple(f * push for f in law.values))
        elif isinstance(law, Curve):
            law = Curve(lambda v, of=law.value: of(v / speed) * push, law.size * push)
        else:
            law = law * push
        reaches = None if drive.reaches is None else drive.reaches * speed
        drive = Push(law, pieces(drive.gate, 1.0, time), reaches, drive.limit * push, drive.until * time)
    sizes = {"linear": push / way, "constant": push, "orifice": push / speed**2}
    gear = replace(axis.gear, rotor=axis.gear.rotor * inertia, brake=pieces(axis.gear.brake, push, time))
    return Case(
        case.gravity * units.length / time**2,
        replace(pivot, radius=pieces(pivot.radius, units.length, time), unbalance=pivot.unbalance * units.mass
                * units.length) if isinstance(pivot, Jib) else pivot,
        Axis(axis.inertia * inertia, drive, axis.friction * push, pieces(axis.brake, push, time),
             pieces(axis.outer, push, time), None, gear,
             tuple(replace(b, place=b.place * way, size=b.size * sizes[b.law], stroke=b.stroke * way)
                   for b in axis.buffers), axis.position * way, axis.speed * speed),
        Load(load.mass * units.mass, pieces(load.length, units.length, time), load.along, load.across,
             load.along_rate / time, load.across_rate / time, pieces(load.wind_along, units.force, time),
             pieces(load.wind_across, units.force, time)),
    )  # fmt: skip


@OTHERS
@pytest.mark.parametrize("name", SWINGS)
def test_of_a_swinging_load(name: str, units: Units) -> None:
    case = SWINGS[name]
    end = 3.0
    one, other = swing(case, end), swing(case_in(case, units), end * units.time)
    assert [(e.element, e.after) for e in one.events] == [(e.element, e.after) for e in other.events]
    assert [e.time for e in other.events] == pytest.approx([e.time * units.time for e in one.events], rel=1e-9)
    assert one.steps == other.steps
    turns = isinstance(case.pivot, Jib)
    way, push = (1.0, units.energy) if turns else (units.length, units.force)
    sizes = {"position": way, "speed": way / units.time, "along": 1.0, "sway": 1.0, "across_rate": 1 / units.time,
             "tension": units.force, "motor": push, "grip": push, "buffer": push, "amplitude": 1.0}  # fmt: skip
    times = np.linspace(0.011, 2.97, 41)
    for signal, size in sizes.items():
        ours = one.at(signal, times) * size
        assert other.at(signal, times * units.time) == pytest.approx(ours, rel=1e-7, abs=1e-7 * np.abs(ours).max())
    works, theirs = one.works(), other.works()
    assert theirs.stored == pytest.approx(works.stored * units.energy, rel=1e-6)
    largest = max(abs(work) for work in works.works.values())
    for work, value in works.works.items():
        assert theirs.works[work] == pytest.approx(value * units.energy, abs=1e-8 * largest * units.energy), work
    assert max(works.residual, theirs.residual) < 1e-9


# -- a mast ---------------------------------------------------------------------------------------------------------

COLUMN = Column((Segment(4.0, 3e7, 150.0), Segment(2.0, 2e7, 90.0)), (Lump(5.0, 900.0, 40.0),),
                     root_rotation=9e7, root_mass=50.0, pull=-9.81, props=(Prop(3.0, 2e5),))  # fmt: skip
GRIPS = (Slips("brake", Force.rising(9000.0, 0.1, 0.2)), Slips("drive", Force.constant(2000.0), 0.9))
MASTS = {
    "braked": Base(4000.0, 0.9, grips=GRIPS),
    "pushed": Base(4000.0, 0.1, Force.rising(2000.0, 0.0, 0.3), GRIPS[:1]),
    "moved": Base(4000.0, 0.0, path=Force((0.0, 0.4), (0.0, 0.0), (2.0, 0.0))),
}


def mast_in(column: Column, units: Units) -> Column:
    bending, turns = units.force * units.length**2, units.energy
    return Column(
        tuple(Segment(s.length * units.length, s.bending * bending, s.mass * units.mass / units.length)
              for s in column.segments),
        tuple(Lump(o.place * units.length, o.mass * units.mass, o.inertia * units.mass * units.length**2)
              for o in column.lumps),
        column.root_rotation * turns, math.inf, column.root_mass * units.mass, 0.0,
        column.pull * units.length / units.time**2,
        tuple(Prop(o.place * units.length, o.stiffness * units.force / units.length) for o in column.props),
    )  # fmt: skip


def base_in(base: Base, units: Units) -> Base:
    def told(one: Force, size: float) -> Force:
        return Force(tuple(t * units.time for t in one.times), tuple(v * size for v in one.values),
                           tuple(v * size / units.time for v in one.slopes))  # fmt: skip

    return Base(
        base.mass * units.mass, base.speed * units.speed, told(base.push, units.force),
        tuple(Slips(g.name, told(g.capacity, units.force), g.speed * units.speed) for g in base.grips),
        told(base.path, units.length / units.time**2) if base.path is not None else None,
    )  # fmt: skip


@OTHERS
@pytest.mark.parametrize("contact", ["none", "obstacle", "guide"])
@pytest.mark.parametrize("name", MASTS)
def test_of_a_mast(name: str, contact: str, units: Units) -> None:
    courses = []
    for u in (Units(), units):
        soft = u.force / u.length
        obstacle = Obstacle(6.0 * u.length, 8e5 * soft, 0.2 * u.length, 4e3 * u.damping)
        guide = Guide(5.0 * u.length, 6e5 * soft, 0.003 * u.length)
        built = Mast.of(mast_in(COLUMN, u), 4)
        one = Followed(built, np.full(3, 0.01), base_in(MASTS[name], u), (6.0 * u.length,),
                        obstacle if contact == "obstacle" else None, guide if contact == "guide" else None)  # fmt: skip
        courses.append(play(one, 0.8 * u.time))
    ours, theirs = courses
    assert [(e.element, e.after) for e in ours.record.events] == [(e.element, e.after) for e in theirs.record.events]
    sizes = {"way": units.length, "speed": units.speed, "deflection": units.length, "moment": units.energy}
    for what, size in sizes.items():
        for one, other in ((ours.top(what)[0], theirs.top(what)[0]), (ours.bottom(what)[0], theirs.bottom(what)[0])):
            peak = max(abs(ours.top(what)[0]), abs(ours.bottom(what)[0])) * size
            assert other == pytest.approx(one * size, abs=1e-9 * peak), what
    assert max(ours.residual, theirs.residual) < 1e-10


# -- a train --------------------------------------------------------------------------------------------------------


def signal(one: Signal, size: float, units: Units) -> Signal:
    trigger = one.trigger
    if trigger is not None:
        level = {"speed": units.speed, "position": units.length, "force": units.force}[trigger.on]
        trigger = Trigger(trigger.body, trigger.on, trigger.level * level, trigger.rising)
    return Signal(
        tuple(t * units.time for t in one.times), tuple(v * size for v in one.values),
        tuple(s * size / units.time for s in one.slopes),
        tuple(Sine(s.size * size, s.frequency / units.time, s.phase) for s in one.sines), one.decay * size,
        one.decay_time * units.time, one.decay_start * units.time, trigger, one.before * size,
    )  # fmt: skip


TRAIN = Train(
    (Body("motor", 3.0), Body("gear", 1.0), Body("load", 8.0, 0.0, 0.1), Body("rope", 2.0)),
    (Mesh("mesh", 0, 1, 2.0, 0.9, 0.8),),
    (Spring("gap", 1, 2, 4e3, 3.0, 0.004), Spring("shaft", 2, 3, 900.0, 2.0), Spring("hold", 3, None, 90.0)),
    (Grip("brake", 2, None, Signal.through(((0.0, 0.0), (1.5, 0.0), (1.8, 40.0)))), Grip("clutch", 2, 3,
     Signal.constant(25.0), 1.3)),
    (Drive.of("drive", 0, Signal((0.0, 1.2), (20.0, -6.0), (5.0, 0.0), (Sine(2.0, 7.0, 0.3),), 6.0, 0.2)),),
    impulses=(Impulse(3, 0.5, 1.2),),
)  # fmt: skip
CURVE = replace(
    TRAIN,
    drives=(Drive.of("drive", 0, Straight("speed", (0.0, 1.5, 2.0), (30.0, 40.0, 0.0))),),
    springs=(*TRAIN.springs[:2], Spring("hold", 3, None, 90.0, 4.0, side=0)),
)


def train_in(one: Train, units: Units) -> Train:
    def drive(d: Drive) -> Drive:
        law = d.stages[0].law
        if isinstance(law, Straight):
            law = replace(law, knots=tuple(v * units.speed for v in law.knots), values=tuple(
                f * units.force for f in law.values))  # fmt: skip
        else:
            assert isinstance(law, Signal)
            law = signal(law, units.force, units)
        return Drive(d.name, d.body, (replace(d.stages[0], law=law),), d.gate)

    return replace(
        one,
        bodies=tuple(Body(b.name, b.inertia * units.mass, b.position * units.length, b.speed * units.speed)
                     for b in one.bodies),
        springs=tuple(replace(s, stiffness=s.stiffness * units.mass / units.time**2, damping=s.damping * units.damping,
                              play=s.play * units.length, rest=s.rest * units.length) for s in one.springs),
        grips=tuple(replace(g, capacity=signal(g.capacity, units.force, units)) for g in one.grips),
        drives=tuple(drive(d) for d in one.drives),
        impulses=tuple(Impulse(i.body, i.time * units.time, i.size * units.force * units.time) for i in one.impulses),
    )  # fmt: skip


@OTHERS
@pytest.mark.parametrize("train", [TRAIN, CURVE], ids=["over time", "over speed"])
def test_of_a_train(train: Train, units: Units) -> None:
    one, other = run(train, 2.5), run(train_in(train, units), 2.5 * units.time)
    assert [event[1:] for event in one.events()] == [event[1:] for event in other.events()] != []
    assert other.times() == pytest.approx([t * units.time for t in one.times()], rel=1e-9)
    for what, size in (("speed", units.speed), ("position", units.length)):
        for k in range(4):
            peak = max(abs(one.top(what, k)), abs(one.bottom(what, k))) * size
            assert other.top(what, k) == pytest.approx(one.top(what, k) * size, abs=1e-9 * peak)
            assert other.bottom(what, k) == pytest.approx(one.bottom(what, k) * size, abs=1e-9 * peak)
            assert other.last(what, k) == pytest.approx(one.last(what, k) * size, abs=1e-9 * peak)
    for k in range(3):
        peak = max(abs(one.top("link", k)), abs(one.bottom("link", k))) * units.force
        assert other.top("link", k) == pytest.approx(one.top("link", k) * units.force, abs=1e-9 * peak)
        assert other.bottom("link", k) == pytest.approx(one.bottom("link", k) * units.force, abs=1e-9 * peak)
    for name, lost in one.ledger.lost.items():
        total = sum(one.ledger.lost.values()) * units.energy
        assert other.ledger.lost[name] == pytest.approx(lost * units.energy, abs=1e-9 * total)
