"""Rolls of the idlers in steady running: speed, load, and life of their bearings."""

import math
from collections.abc import Iterable, Iterator

import numpy as np

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import AnyCheck, Check, Sense, no_needs, no_repair
from ptmcalc.contract.limits import key
from ptmcalc.contract.result import LoadInfo, of
from ptmcalc.laws import idler_roll
from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.conveyor.machine.keys.belt import IdlerRoll, IdlerRow
from ptmcalc.machines.conveyor.machine.keys.route import Curve
from ptmcalc.machines.conveyor.machine.loading import Piece, pieces, sections
from ptmcalc.machines.conveyor.machine.model import BeltLine
from ptmcalc.machines.conveyor.machine.resistances import filled
from ptmcalc.machines.conveyor.machine.scenes import Run
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.running.limits import given
from ptmcalc.numerics.lanes import number, value

Checks = Iterable[AnyCheck]

ROLL_LOADS = (
    LoadInfo("roll_speed", "idler roll speed", units.ANGULAR_SPEED, headline=False),
    LoadInfo("roll_load_max", "idler roll load, maximum", units.FORCE, headline=False),
    LoadInfo("bearing_life", "idler bearing rating life L10h", units.RUNNING_TIME, headline=False),
)
"""Loads of the most loaded roll, once for each strand whose roll the file describes."""


def rolls(spec: Conveyor) -> dict[str, tuple[IdlerRow, IdlerRoll]]:
    """The strands whose roll the file describes, by name."""
    rows: dict[str, IdlerRow] = {"carry": spec.idlers.carry, "return": spec.idlers.back}
    return {strand: (row, row.roll) for strand, row in rows.items() if row.roll is not None}


def life_strands(spec: Conveyor) -> list[str]:
    """Strands whose bearing life is a load; the carrying strand where a life is required and no roll is described."""
    return list(rolls(spec)) or (["carry"] if spec.checks.idler_life is not None else [])


def rolls_of_a_set(spec: Conveyor, strand: str) -> int:
    """Rolls of an idler set by its trough: three, or two without a centre roll; one of a flat strand."""
    trough = (spec.idlers.carry if strand == "carry" else spec.idlers.back).trough
    if trough is None:
        return 1
    return 3 if trough.middle_roll > 0 else 2


def roll_loads(spec: Conveyor, line: BeltLine) -> dict[str, float]:
    """What the file gives enough for."""
    found: dict[str, float] = {}
    for strand, (row, roll) in rolls(spec).items():
        turns = value(idler_roll.roll_speed, spec.speed, roll.diameter)
        found[of("roll_speed", strand)] = turns
        if not line.strand(_WHICH[strand]).span_weights:
            continue
        share = 1.0 if rolls_of_a_set(spec, strand) == 1 and roll.load_share is None else filled(roll.load_share)
        count = rolls_of_a_set(spec, strand)
        most = max(
            value(idler_roll.roll_load, share, weight, filled(roll.dynamic_factor), curve, own / count)
            for weight, curve, own in _idler_sets(spec, line, strand, row)
        )
        found[of("roll_load_max", strand)] = most
        if roll.dynamic_load_rating is not None:
            found[of("bearing_life", strand)] = value(idler_roll.bearing_life, roll.dynamic_load_rating, most, turns)
    return found


_WHICH = {"carry": CARRY, "return": RETURN}
"""Number of each strand in `BeltLine` [1]. Other numbers would exchange the strands."""


def _idler_sets(spec: Conveyor, line: BeltLine, strand: str, row: IdlerRow) -> Iterator[tuple[float, float, float]]:
    """Weight of belt and load, force of the curve, weight of the rotating parts of one set [N], for each length with
    one load and each convex curve, from the tail on."""
    weights = list(line.strand(_WHICH[strand]).span_weights)
    lengths = pieces(spec) if strand == "carry" else sections(spec)
    if strand == "return":
        weights.reverse()
    pitches = [filled((one.part.carry_pitch if strand == "carry" else None) or row.pitch) for one in lengths]
    own = [row.mass_at(pitch) * pitch * spec.gravity for pitch in pitches]
    for weight, mass in zip(weights, own, strict=True):
        yield weight, 0.0, mass
    whole = spec.route.span
    for curve in spec.route.curves:
        if curve.hollow:
            continue
        places = np.clip([curve.place - curve.tangent, curve.place + curve.tangent], 0, whole) / whole
        tensions = line.static(_WHICH[strand], places if strand == "carry" else 1 - places)
        for index, one in enumerate(lengths):
            beside = one.section in (curve.number - 2, curve.number - 1)
            if beside and (len(lengths) == len(spec.route.parts) or _touches(one, curve)):
                yield weights[index], max(number(tensions.max()), 0.0) * pitches[index] / curve.radius, own[index]


def _touches(piece: Piece, curve: Curve) -> bool:
    """Whether a piece has a part of a curve."""
    return piece.start < curve.place + curve.tangent and piece.start + piece.length > curve.place - curve.tangent


# -- checks -----------------------------------------------------------------------------------------------------------


def _roll_path(strand: str, key: str) -> KeyPath:
    return ("idlers", strand, "roll", key)


def _speed_limit(spec: Conveyor, scene: Run) -> Estimate:
    """Rated speed of the rolls, of the file.

    **Range** the smaller one, where both strands have a roll.
    **Error** none: a given limit.
    **Source** the data sheet of the roll; 600 to 750 rpm is usual.
    """
    rated = [roll.rated_speed for _, roll in rolls(spec).values() if roll.rated_speed is not None]
    return Estimate.exact(min(rated, default=math.inf))


def _speed_checks(spec: Conveyor, scene: Run) -> Checks:
    """One for each strand with a rated speed."""
    for strand, (_, roll) in rolls(spec).items():
        if roll.rated_speed is not None:
            key = _roll_path(strand, "diameter")
            yield ROLL_SPEED.of(strand, given(roll.rated_speed), key, repair=key)


ROLL_SPEED: Check[Conveyor, Run] = Check(
    code="CNV133",
    title="idler roll speed",
    question="Is the speed of the idler rolls within their rated speed?",
    failure="idler rolls are too small for the belt speed",
    scenes=frozenset({Run}),
    loads=("roll_speed",),
    sense=Sense.AT_MOST,
    limit=_speed_limit,
    needs=no_needs,
    blame=lambda spec, scene, loads: _roll_path("carry", "diameter"),
    repair=no_repair,
    each=_speed_checks,
    what="The rotational speed of the idler rolls is at most their rated speed.",
    why="Fast rolls vibrate, heat their bearings and seals, and are noisy.",
    formula="n = v/(pi d) <= limit",
    source="kinematics of rolling; the data sheet of the roll: 600 to 750 rpm is usual",
)


_LIFE_LIMIT = key(
    "checks.idler_life",
    meaning="Required rating life of the idler bearings, of the file",
    valid="ball bearings",
    absent=0.0,
)


def _life_checks(spec: Conveyor, scene: Run) -> Checks:
    """One for each strand with a roll, where the file requires a life; the carrying strand where none has one."""
    if spec.checks.idler_life is None:
        return
    for strand in life_strands(spec):
        key, pitch = _roll_path(strand, "dynamic_load_rating"), ("idlers", strand, "pitch")
        yield BEARING_LIFE.of(strand, _LIFE_LIMIT, key, (pitch, key), key)


BEARING_LIFE: Check[Conveyor, Run] = Check(
    code="CNV134",
    title="idler bearing rating life",
    question="Do the bearings of the most loaded idler roll reach the required life?",
    failure="idler bearings do not reach the required life",
    scenes=frozenset({Run}),
    loads=("bearing_life",),
    sense=Sense.AT_LEAST,
    limit=_LIFE_LIMIT,
    needs=no_needs,
    blame=lambda spec, scene, loads: _roll_path("carry", "dynamic_load_rating"),
    repair=no_repair,
    each=_life_checks,
    what="The basic rating life of the bearings of the most loaded roll is at least the required life. Its load"
    " includes the belt tension in convex curves.",
    why="Idlers whose bearings fail block, wear the belt cover and can set the belt on fire.",
    formula="L_10h = 1e6/n (C/P)^3 >= limit,   P = F/2,   F = phi (k_d w a + S a/R) + G,   n = v/(pi d)",
    source="ISO 281:2007, basic rating life; phi and k_d as in handbooks of idler manufacturers",
)
