"""The column of a stacker crane on a base that moves: from a design file to `numerics.mast`."""

import math
from dataclasses import dataclass

import numpy as np

from ptmcalc.laws.contact_damping import dashpot_ratio
from ptmcalc.machines.crane.stacking.machine import model
from ptmcalc.machines.crane.stacking.machine.columns import swinging
from ptmcalc.machines.crane.stacking.machine.overhead import OverheadStacker
from ptmcalc.machines.crane.stacking.machine.rack import RackStacker
from ptmcalc.machines.crane.stacking.machine.scenes import Brake, ObstacleScene, StackerScene, Start
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.numerics.mast.base import Base, Grip, Guide, Obstacle, Signal
from ptmcalc.numerics.mast.case import Case
from ptmcalc.numerics.mast.modes import Mast
from ptmcalc.numerics.mast.parts import Column, Lump, Prop, Segment


@dataclass(frozen=True, slots=True)
class Built:
    """A column with what it carries and what guides its head.

    `base` is what moves below or above it, without what shifts with its root [kg]; `stiffness` that at the far end of
    column and root, without what weights do to it [N/m].
    """

    column: Column
    base: float
    stiffness: float
    guide: Guide | None = None

    @property
    def total(self) -> float:
        """All that travels [kg]."""
        column = self.column
        own = sum(segment.mass * segment.length for segment in column.segments)
        return self.base + column.root_mass + own + sum(lump.mass for lump in column.lumps)


def built(spec: Stacker, scene: StackerScene, *, gravity: bool, rotors: float = 0.0) -> Built:
    """The column of a scene; weights make it stiffer or softer, or are left out."""
    swings = swinging(spec, scene, rotors)
    beam = swings.exact
    pull = (spec.gravity if model.hangs(spec) else -spec.gravity) if gravity else 0.0
    props: tuple[Prop, ...] = ()
    guide = None
    head = spec.column.top_guide
    if isinstance(spec, RackStacker) and head is not None and head.stiffness is not None:
        if head.gap:
            guide = Guide(beam.length, head.stiffness, head.gap)
        else:
            props = (Prop(beam.length, head.stiffness),)
    column = Column(
        segments=(Segment(beam.length, beam.flexural_stiffness, beam.column_mass / beam.length),),
        lumps=(Lump(model.carriage_place(spec, scene), beam.tip_mass),),
        root_rotation=1 / beam.root_rotation if beam.root_rotation else math.inf,
        root_translation=1 / beam.root_translation if beam.root_translation else math.inf,
        root_mass=beam.root_mass,
        pull=pull,
        props=props,
    )
    return Built(column, beam.base_mass, swings.stiffness, guide)


@dataclass(frozen=True, slots=True)
class Happening:
    """What happens to a column in a scene.

    `base` is what moves it; `lasts` what a rigid crane would take for it [s]; `rise` the time in which its load comes
    up [s], `jump` the size of that: a force, or the acceleration of a base that follows a ramp.
    """

    column: Built
    base: Base
    lasts: float
    rise: float
    jump: float
    obstacle: Obstacle | None = None

    @property
    def follows(self) -> bool:
        """Whether the base keeps to a ramp of speed."""
        return self.base.path is not None

    @property
    def rolling(self) -> float:
        """Mass of a base that rolls, infinite for one that follows a ramp [kg]."""
        return math.inf if self.follows else self.base.mass


def happening(spec: Stacker, scene: StackerScene, *, gravity: bool) -> Happening:
    """The start, the stop or the collision of a scene."""
    speed = model.speed(spec, scene)
    if isinstance(scene, ObstacleScene):
        return _collision(spec, scene, speed, gravity)
    assert isinstance(scene, Start | Brake)
    starts = isinstance(scene, Start)
    push = model.driving(spec, scene) if starts else model.stopping(spec, scene)
    column = built(spec, scene, gravity=gravity, rotors=push.rotors)
    at_first = 0.0 if starts else speed
    if push.kind == "ramp":
        path, lasts = ramp(speed, push.size if starts else -push.size, push.rise)
        return Happening(column, Base(column.base, at_first, path=path), lasts, push.rise, push.size)
    size = max(push.size, 0.0)  # a drive that does not overcome the resistance moves nothing
    force = Signal.rising(size, push.delay, push.rise)
    grip = Grip("drive", force, speed) if starts else Grip("brake", force)
    lasts = push.delay + _rigid_time(column.total * speed, size, push.rise)
    return Happening(column, Base(column.base, at_first, grips=(grip,)), lasts, push.rise, size)


def _rigid_time(momentum: float, size: float, rise: float) -> float:
    """How long a force that rises evenly to its size takes to give or take a momentum; one that is none, its rise [s].

    One that rises slowly is done before it has come up to its size.
    """
    if size <= 0:
        return rise
    even = momentum / size - rise / 2
    return rise + even if even >= 0 else math.sqrt(2 * rise * momentum / size)


def _collision(spec: Stacker, scene: ObstacleScene, speed: float, gravity: bool) -> Happening:
    """The far end meets an obstacle, with the whole force of drive or brake from the first touch on."""
    assert isinstance(spec, OverheadStacker)
    assert spec.obstacle is not None
    hit = spec.obstacle
    drives = scene.drive == "on"
    size, rotors = collision_force(spec, scene)
    column = built(spec, scene, gravity=gravity, rotors=rotors)
    grip = Grip("drive", Signal.constant(size), speed) if drives else Grip("brake", Signal.constant(size))
    stiffness = model.filled(hit.stiffness) if hit.contact == "elastic" else math.inf
    damping = 0.0
    if hit.contact == "elastic" and hit.restitution < 1:
        damping = 2 * dashpot_ratio(hit.restitution) * math.sqrt(stiffness * model.climbing_mass(spec, scene))
    obstacle = Obstacle(spec.column.length, stiffness, 0.0, damping)
    return Happening(column, Base(column.base, speed, grips=(grip,) if size else ()), 0.0, 0.0, size, obstacle)


def collision_force(spec: Stacker, scene: ObstacleScene) -> tuple[float, float]:
    """The force that pushes on or brakes in a collision [N], and the mass of the rotors at the rims [kg]; that of a
    ramp of speed is what the ramp takes of all that travels."""
    if scene.drive == "off" and scene.brake == "off":
        return model.travel(spec, scene).resistance or 0.0, 0.0
    push = model.driving(spec, scene) if scene.drive == "on" else model.stopping(spec, scene)
    if push.kind == "force":
        return max(push.size, 0.0), push.rotors
    swings = swinging(spec, scene)
    return push.size * swings.total, 0.0


def ramp(speed: float, size: float, rise: float) -> tuple[Signal, float]:
    """An acceleration that comes up and goes down in straight lines until a speed is reached or left [m/s^2], and how
    long that lasts [s]; a short one does not come up to its size."""
    if rise <= 0:
        lasts = speed / abs(size)
        return Signal((0.0, lasts), (size, 0.0), (0.0, 0.0)), lasts
    steep = size / rise
    up = min(rise, math.sqrt(speed / abs(steep)))
    even = max(speed / abs(size) - rise, 0.0)
    rows = [(0.0, 0.0, steep), (up, steep * up, 0.0), (up + even, steep * up, -steep), (2 * up + even, 0.0, 0.0)]
    if not up < up + even:
        del rows[1]
    times, values, slopes = zip(*rows, strict=True)
    return Signal(times, values, slopes), 2 * up + even


def damping_ratio(decrement: float | None, moves: Happening, mast: Mast) -> float:
    """Damping ratio of every mode over a base that is held: the lowest one has the decrement of the file where the
    column swings beside a base that rolls, or beside one that follows a ramp."""
    if decrement is None:
        return 0.0
    ratio = decrement / math.hypot(2 * math.pi, decrement)
    if moves.follows:
        return ratio
    return ratio * float(mast.frequencies[0] / mast.rolling(moves.base.mass)[0][0])


def case_of(moves: Happening, decrement: float | None, elements: int, modes: int) -> Case:
    """What is marched: the mast in so many elements and modes."""
    length = moves.column.column.length
    mast = Mast.of(moves.column.column, elements, (length,))
    ratios = np.full(min(modes, len(mast.frequencies)), damping_ratio(decrement, moves, mast))
    return Case(mast, ratios, moves.base, (length,), moves.obstacle, moves.column.guide)
