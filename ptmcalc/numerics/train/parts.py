"""The parts of a lumped train, in numbers. Bodies are named by their index; a ground is None."""

from collections.abc import Callable
from dataclasses import dataclass

from ptmcalc.numerics.train.signals import ONE, ZERO, FloatArray, Signal


@dataclass(frozen=True, slots=True)
class Body:
    """An inertia (or mass) with its position and speed at the start."""

    name: str
    inertia: float
    position: float = 0.0
    speed: float = 0.0


@dataclass(frozen=True, slots=True)
class Mesh:
    """A rigid gear: v_inner = ratio v_outer. `forward` and `reverse` are its efficiencies.

    T_inner = T_outer/(ratio forward)   while power flows from the inner to the outer body
    T_inner = T_outer reverse/ratio     while it flows back; a negative one must be pushed
    """

    name: str
    inner: int
    outer: int
    ratio: float
    forward: float = 1.0
    reverse: float = 1.0

    @property
    def lossy(self) -> bool:
        return self.forward != 1.0 or self.reverse != 1.0


LINEAR, KELVIN, NO_PULL, CLAMPED, HUNT_CROSSLEY, RIGID = (
    "linear",
    "kelvin",
    "no_pull",
    "clamped",
    "hunt_crossley",
    "rigid",
)


@dataclass(frozen=True, slots=True)
class Spring:
    """An elastic link between two bodies, or from a body to the ground.

    Its extension is x = position_first - position_second - rest. For a rope that runs `over` a body which gives way, a
    drum's structure, position_over is taken off too; a link named before this one must hold that body to the ground.
    `play` is the whole free travel, half of it to either side of x = 0; with `side` 1 it acts only beyond the play at
    x > 0 (a rope), with -1 only at x < 0. Laws of contact, d the overlap beyond the play:

        linear           C x + b v, no play
        kelvin           C d + b d'  as long as d > 0 (may pull at the end)
        no_pull          max(0, C d + b d')
        clamped          C d + min(max(b d', -C d), C d)
        hunt_crossley    C d^n (1 + 1.5 c d'), never below 0
        rigid            no overlap: an impact with restitution, then a push
    """

    name: str
    first: int
    second: int | None
    stiffness: float
    damping: float = 0.0
    play: float = 0.0
    law: str = LINEAR
    side: int = 0
    rest: float = 0.0
    restitution: float = 0.0
    dissipation: float = 0.0
    exponent: float = 1.0
    over: int | None = None


@dataclass(frozen=True, slots=True)
class Grip:
    """Coulomb friction: a brake or bearing against the ground, or a clutch between two bodies.

    `capacity` is the sliding friction over time, times a `gate` of steps (0 is off); at rest it holds `static` times
    as much.
    """

    name: str
    first: int
    second: int | None
    capacity: Signal
    static: float = 1.0
    gate: Signal = ONE


@dataclass(frozen=True, slots=True)
class Straight:
    """A torque of straight pieces over a body's speed or position; constant or going on straight beyond the ends."""

    on: str
    knots: tuple[float, ...]
    values: tuple[float, ...]
    extends: bool = False
    period: float = 0.0


@dataclass(frozen=True, slots=True)
class Smooth:
    """A smooth torque over a body's speed (or position), with its slope."""

    on: str
    value: Callable[[FloatArray], FloatArray]
    slope: Callable[[float], float]
    size: float
    grain: float


@dataclass(frozen=True, slots=True)
class Governed:
    """A speed control: clip(stiffness (reference - speed), -limit, limit)."""

    reference: Signal
    stiffness: float
    limit: float


Law = Signal | Straight | Smooth | Governed


@dataclass(frozen=True, slots=True)
class Stage:
    """A law that holds until the body's speed rises to `until`, or a time has come."""

    law: Law
    until: float | None = None
    until_time: float | None = None


@dataclass(frozen=True, slots=True)
class Drive:
    """A torque (or force) on a body: its stages one after the other, times a gate over time (0 is off)."""

    name: str
    body: int
    stages: tuple[Stage, ...]
    gate: Signal = ONE

    @classmethod
    def of(cls, name: str, body: int, law: Law, gate: Signal = ONE) -> "Drive":
        return cls(name, body, (Stage(law),), gate)


@dataclass(frozen=True, slots=True)
class Guide:
    """A body whose acceleration is prescribed, from its speed at the start."""

    name: str
    body: int
    acceleration: Signal = ZERO


@dataclass(frozen=True, slots=True)
class Impulse:
    """A sudden change of momentum of a body at a time."""

    body: int
    time: float
    size: float


@dataclass(frozen=True, slots=True)
class Train:
    """Everything that moves and acts."""

    bodies: tuple[Body, ...]
    meshes: tuple[Mesh, ...] = ()
    springs: tuple[Spring, ...] = ()
    grips: tuple[Grip, ...] = ()
    drives: tuple[Drive, ...] = ()
    guides: tuple[Guide, ...] = ()
    impulses: tuple[Impulse, ...] = ()
    rest_ends: bool = False
    """whether the motion is over when every body is held at rest"""
