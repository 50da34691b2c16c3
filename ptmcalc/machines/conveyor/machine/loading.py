"""What the carrying strand carries where: lengths with one slope and one load, and what each loading point adds."""

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import chain, combinations, pairwise

from ptmcalc.base.memory import kept_for
from ptmcalc.laws import belt_resistance
from ptmcalc.machines.conveyor.machine.keys.loading import NEAR, LoadingPoint
from ptmcalc.machines.conveyor.machine.keys.route import Section
from ptmcalc.machines.conveyor.machine.resistances import filled
from ptmcalc.machines.conveyor.machine.scenes import ConveyorScene
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.numerics.lanes import value

Names = tuple[str, ...]
Filling = Sequence[Names]
"""The loading points whose material lies on the belt, piece by piece."""

_ANYWHERE = ""
"""Name of what loads the whole belt of a file without loading points."""
_SLIDES = 0.6
"""Friction of material on the belt in the acceleration zone [1]; ISO 5048: 0.5 to 0.7. It spreads a force over that
zone: a smaller value makes the zone longer, no force larger."""
_SHORTEST = 1.0
"""Shortest loading zone [m]; an engineering choice: the size of a chute. It spreads a force: a smaller value puts it
nearer to the point."""


@dataclass(frozen=True, slots=True)
class Piece:
    """A length of the carrying strand: its section, counted from 0, its start from the tail and its length [m], the
    loading points before it, and those in whose loading zone it is, with its share of that zone [1]."""

    part: Section
    section: int
    start: float
    length: float
    points: Names
    zones: tuple[tuple[str, float], ...] = ()

    @property
    def lift(self) -> float:
        """[m]"""
        return self.part.lift * (self.length / self.part.length)


def pieces(spec: Conveyor, cuts: Collection[float] = ()) -> tuple[Piece, ...]:
    """The sections of the route, divided where the load changes, at the ends of loading zones and at `cuts` [m]."""
    return _divided(spec, cuts) if cuts and spec.load.loading_points is not None else _as_loaded(spec)


@kept_for(64)
def _as_loaded(spec: Conveyor) -> tuple[Piece, ...]:
    return sections(spec) if spec.load.loading_points is None else _divided(spec, ())


@kept_for(64)
def sections(spec: Conveyor) -> tuple[Piece, ...]:
    """The sections of the route as they are in the file."""
    start, found = 0.0, []
    for index, part in enumerate(spec.route.parts):
        found.append(Piece(part, index, start, part.length, (_ANYWHERE,)))
        start = start + part.length
    return tuple(found)


def _divided(spec: Conveyor, cuts: Collection[float]) -> tuple[Piece, ...]:
    points = points_of(spec)
    ends = {name: point.at + zone_length(spec, name) for name, point in points.items()}
    marks = sorted([*(point.at for point in points.values()), *ends.values(), *cuts])
    found, start = [], 0.0
    for index, part in enumerate(spec.route.parts):
        end, edges = start + part.length, [start]
        for mark in marks:
            if edges[-1] + NEAR < mark < end - NEAR:
                edges.append(mark)
        for first, last in pairwise([*edges, end]):
            middle = (first + last) / 2
            before = tuple(name for name, point in points.items() if point.at < middle)
            zones = tuple((name, last - first) for name in before if middle < ends[name])
            found.append(Piece(part, index, first, last - first, before, zones))
        start = end
    return tuple(replace(one, zones=_shares(one, found)) for one in found)


def _shares(piece: Piece, every: Sequence[Piece]) -> tuple[tuple[str, float], ...]:
    """Shares of the loading zones that are on a piece: a zone that the head cuts off is as long as it can be."""
    whole = {name: sum(dict(one.zones).get(name, 0.0) for one in every) for name, _ in piece.zones}
    return tuple((name, length / whole[name]) for name, length in piece.zones)


def points_of(spec: Conveyor) -> dict[str, LoadingPoint]:
    """The loading points from the tail to the head; none of a belt that is loaded all over."""
    return dict(sorted((spec.load.loading_points or {}).items(), key=lambda one: one[1].at))


def in_operation(spec: Conveyor, scene: ConveyorScene) -> Names:
    """The loading points that feed the belt in a scene, wherever it carries."""
    if spec.load.loading_points is None:
        return (_ANYWHERE,)
    named = scene.loading_points
    return tuple(name for name in points_of(spec) if named is None or name in named)


def filling_of(spec: Conveyor, scene: ConveyorScene) -> list[Names]:
    """What lies on each piece in a scene."""
    feeding = in_operation(spec, scene)
    return [
        tuple(name for name in piece.points if name in feeding) if _is_loaded(scene, piece.part) else ()
        for piece in pieces(spec)
    ]


def _is_loaded(scene: ConveyorScene, part: Section) -> bool:
    """Whether a section carries load in a scene."""
    return {"full": True, "empty": False, "uphill": part.lift > 0, "downhill": part.lift < 0}[scene.load]


def choices(names: Names) -> Iterator[Names]:
    """Every choice of loading points, the empty one first."""
    return chain.from_iterable(combinations(names, count) for count in range(len(names) + 1))


def load_line_mass(spec: Conveyor, names: Collection[str] | None = None) -> float:
    """Load per length behind all loading points, or behind some of them [kg/m]."""
    if spec.load.loading_points is not None:
        points = points_of(spec)
        return (
            sum((point.capacity for name, point in points.items() if names is None or name in names), 0.0) / spec.speed
        )
    if names is not None and not names:
        return 0.0
    if spec.load.mass is not None:
        return spec.load.mass
    return filled(spec.load.capacity) / spec.speed


# -- forces at loading points ---------------------------------------------------------------------------------------


def accelerates(spec: Conveyor, name: str) -> bool:
    """Whether the acceleration of the material at a point is a force of its own.

    The length factor C is that of a belt with one loading point: it has the force of the one nearest to the tail.
    Material as fast as the belt has none.
    """
    separate, points = spec.resistance.secondary_force is not None or spec.resistance.cema is not None, points_of(spec)
    return (separate or name != next(iter(points))) and points[name].speed != spec.speed


def zone_length(spec: Conveyor, name: str) -> float:
    """Length of belt over which the forces of a loading point are spread [m]: that of its skirt plates, at least that
    over which friction accelerates the material; 0 of a point without forces."""
    point = points_of(spec)[name]
    plates = point.skirt.length if point.skirt is not None else 0.0
    if not accelerates(spec, name):
        return plates
    slides = abs(value(belt_resistance.acceleration_length, spec.speed, point.speed, _SLIDES, spec.gravity))
    return max(plates, slides, _SHORTEST)


def force_in_zones(spec: Conveyor, piece: Piece, names: Names) -> float:
    """Forces of the loading points in whose zone a piece is, with the material of some points on it [N].

        F = Q_k (v - v_k) + mu_2 (Q/rho)^2 rho g l/(v b)^2

    Q_k is the mass flow of the point, where it feeds, Q that of all points before the piece that feed.
    """
    return sum((_force(spec, name, names) * share for name, share in piece.zones), 0.0)


def _force(spec: Conveyor, name: str, names: Names) -> float:
    """Acceleration of the material and friction at the skirt plates of a loading point [N]."""
    point, force = points_of(spec)[name], 0.0
    if name in names and accelerates(spec, name):
        force = value(belt_resistance.loading_resistance, point.capacity, spec.speed, point.speed)
    if point.skirt is not None and names:
        stream = load_line_mass(spec, names) * spec.speed
        force = force + value(
            belt_resistance.skirt_resistance,
            stream,
            filled(spec.load.density),
            spec.speed,
            point.skirt.width,
            point.skirt.length,
            filled(point.skirt.friction),
            spec.gravity,
        )
    return force


def forces_in_zones(spec: Conveyor, filling: Filling) -> float:
    """Forces of all loading points [N]."""
    return sum((force_in_zones(spec, piece, names) for piece, names in zip(pieces(spec), filling, strict=True)), 0.0)
