"""Fleet angles at the drum: the largest one at the top hook position, the least one at a flange."""

import math

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import Check, Sense, only
from ptmcalc.contract.result import Found, LoadInfo, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.contract.topic import Topic
from ptmcalc.laws import rope_drum
from ptmcalc.machines.hoist.machine import model
from ptmcalc.machines.hoist.machine.keys.rope import Fleet
from ptmcalc.machines.hoist.machine.model import loaded
from ptmcalc.machines.hoist.machine.spec import Hoist, HoistScene, Run

TOP, LEAST = "fleet_angle_top", "fleet_angle_least"
LOADS = (
    LoadInfo(TOP, "fleet angle at the top hook position", units.ANGLE),
    LoadInfo(LEAST, "least fleet angle at a flange, layer change", units.ANGLE),
)
_USUAL, _SENSITIVE, _STRICT = math.radians(4), math.radians(2), math.radians(1.5)
"""Largest fleet angle [rad]: 4 deg (`_USUAL`) of ropes of ordinary lay on grooved drums with one layer; 2 deg
(`_SENSITIVE`) of rotation-resistant and Lang lay ropes, smooth drums and several layers, or 1.5 deg (`_STRICT`). ISO
16625:2013, quoted from secondary sources, to be compared. Larger angles wear rope and grooves."""
_CLIMB = math.radians(0.5)
"""Least fleet angle at a flange of a drum with several layers [rad] (ISO 16625:2013, to be compared): with a smaller
one the rope piles up at the flange before it climbs."""


def sensitive(spec: Hoist, fleet: Fleet) -> bool:
    """Whether rope or drum require the smaller fleet angle."""
    several = model.wound(spec, spec.height).layers > 1
    return several or fleet.lay == "lang" or spec.rope.rotation_resistant == "yes" or spec.drum.surface == "smooth"


def distance(spec: Hoist, height: float) -> float:
    """Distance of the first sheave, or of the hook block, from the drum [m]."""
    return spec.reeving.lead_length or model.fall_length(spec, height)


def top_angle(spec: Hoist) -> float:
    """Fleet angle at the top hook position, where a rope to the hook block is shortest [rad].

        tan(a) = (e + p/2)/l;   p/2 of the crossover in several layers only

    **Range** a fixed sheave: the largest side travel of the lift, b/2 + o. A rope to the hook block: |b/2 - o| of the
    last wrap in one layer, the whole b/2 + o in several layers, where the rope may be at either flange.
    **Error** the slope of the groove, atan(p/(pi D)), is left out.
    **Source** geometry.
    """
    top, given = model.wound(spec, spec.height), spec.reeving
    one = top.layers == 1
    width = (top.turns - spec.drum.dead_wraps) * model.pitch(spec) if one else spec.drum.length
    away = width / 2 + given.lead_offset
    if one and given.lead_length == 0:
        away = abs(width / 2 - given.lead_offset)
    return math.atan2(away + (0.0 if one else model.pitch(spec) / 2), distance(spec, spec.height))


def least_angle(spec: Hoist) -> float | None:
    """Least fleet angle at a flange where the rope climbs to its next layer; None for one layer [rad].

        tan(a) = (b/2 -+ o)/l

    The first change is at the flange of the last wraps, towards which the sheave is offset, the next one at the other
    flange. Below 0 the sheave is beyond the flange.

    **Range** drums with several layers.
    **Error** the slope of the groove is left out.
    **Source** geometry; `rope_drum.length_below` for the heights of the changes.
    """
    heights = model.layer_heights(spec)[1:]
    sides = [
        rope_drum.fleet_angle(spec.drum.length, -spec.reeving.lead_offset * (-1) ** change, distance(spec, height))
        for change, height in enumerate(heights)
    ]
    return min(sides, default=None)


def run(spec: Hoist, scene: HoistScene, carried: frozenset[str], level: int) -> Result:
    """Fleet angles of the rope at the drum.

        tan(a) = (e + p/2)/l at the top,   tan(a) = (b/2 -+ o)/l at a layer change

    **Range** a sheave whose plane is square to the drum.
    **Error** exact for that geometry; the slope of the groove is left out.
    **Source** geometry.
    """
    fleet = spec.fleet
    if fleet is None or distance(spec, spec.height) <= 0:
        return Result({}, work=1)
    asked = "" if fleet.limit is not None else f"limit of {fleet.edition}, to be compared with the standard"
    found = {TOP: Found(Estimate.exact(top_angle(spec)), note=asked)}
    least = least_angle(spec)
    if least is not None:
        asked = "" if fleet.least is not None else f"limit of {fleet.edition}, to be compared with the standard"
        found[LEAST] = Found(Estimate.exact(least), note=asked)
    return Result(found, work=1)


SOLVER: Solver[Hoist, HoistScene] = Solver(
    name="fleet_angles",
    title="fleet angles at the drum",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Run}),
    represents=frozenset(),
    gives=frozenset(info.name for info in LOADS),
    run=run,
    cost=lambda spec, scene, carried, level: 5e-4,
    source="geometry",
)


def _wanted(spec: Hoist, scene: HoistScene) -> bool:
    return loaded(spec, scene) and spec.fleet is not None


def _climbs(spec: Hoist, scene: HoistScene) -> bool:
    return _wanted(spec, scene) and model.wound(spec, spec.height).layers > 1


def _largest(spec: Hoist, scene: Run) -> Estimate:
    """Largest fleet angle: that of the file, else 4 deg, or 2 deg (`strict`: 1.5 deg) where rope or drum require it.

    **Range** 2 deg for rotation-resistant and Lang lay ropes, smooth drums and several layers.
    **Error** none: a rule.
    **Source** ISO 16625:2013, quoted from secondary sources, to be compared with the standard.
    """
    fleet = spec.fleet
    if fleet is None or fleet.limit is not None:
        return Estimate.exact(math.inf if fleet is None else fleet.limit or math.inf)
    small = _STRICT if fleet.strict == "yes" else _SENSITIVE
    return Estimate.exact(small if sensitive(spec, fleet) else _USUAL)


def _smallest(spec: Hoist, scene: Run) -> Estimate:
    """Least fleet angle at a flange: that of the file, else 0.5 deg.

    **Range** drums with several layers.
    **Error** none: a rule.
    **Source** ISO 16625:2013, quoted from secondary sources, to be compared with the standard.
    """
    asked = spec.fleet.least if spec.fleet is not None else None
    return Estimate.exact(_CLIMB if asked is None else asked)


def _where(spec: Hoist, scene: HoistScene) -> KeyPath:
    return ("reeving", "lead_length") if spec.reeving.lead_length > 0 else ("least_fall",)


def _needs(spec: Hoist, scene: HoistScene) -> tuple[KeyPath, ...]:
    return () if distance(spec, spec.height) > 0 else (("reeving", "lead_length"),)


LARGEST: Check[Hoist, Run] = only(_wanted)(
    Check(
        code="HST156",
        title="fleet angle at the top hook position",
        question="Is the fleet angle at the top hook position within its limit?",
        failure="fleet angle at the top hook position is too large",
        scenes=frozenset({Run}),
        loads=(TOP,),
        sense=Sense.AT_MOST,
        limit=_largest,
        needs=_needs,
        blame=lambda spec, scene, loads: _where(spec, scene),
        repair=_where,
        what="With the hook at its highest, or with a fixed sheave anywhere in the lift, the fleet angle is at most its"
        " limit. In several layers it includes half a pitch of the crossover.",
        why="A rope that leaves the drum at an angle rubs on the groove and untwists. Rotation-resistant ropes form"
        " birdcages.",
        formula="tan(a) = (e + p/2)/l <= tan(a_max)",
        source="geometry; ISO 16625:2013, to be compared with the standard",
    )
)

CLIMBING: Check[Hoist, Run] = only(_climbs)(
    Check(
        code="HST157",
        title="least fleet angle at a flange",
        question="Is the fleet angle at the flanges large enough for the rope to return?",
        failure="rope piles up at the flange",
        scenes=frozenset({Run}),
        loads=(LEAST,),
        sense=Sense.AT_LEAST,
        limit=_smallest,
        needs=_needs,
        blame=lambda spec, scene, loads: _where(spec, scene),
        repair=_where,
        what="At every layer change the fleet angle towards the middle of the drum is at least its limit.",
        why="A rope that leaves the flange square to the drum is not drawn back. It piles up, and falls onto the layer"
        " below with an impact.",
        formula="tan(a) = (b/2 -+ o)/l >= tan(a_min)",
        source="geometry; ISO 16625:2013, to be compared with the standard",
    )
)

FLEET_ANGLES: Topic[Hoist] = Topic(loads=LOADS, solvers=(SOLVER,), checks=(LARGEST, CLIMBING))
