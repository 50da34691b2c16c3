"""Life of the rope by its number of bendings (Feyrer): lifts until it is discarded, and until it breaks."""

import math
from collections.abc import Callable, Iterator

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import Check, Sense, blames, no_repair, only
from ptmcalc.contract.limits import fixed, key
from ptmcalc.contract.result import Found, LoadInfo, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.contract.topic import Topic
from ptmcalc.laws import rope_life
from ptmcalc.machines.hoist.machine import model
from ptmcalc.machines.hoist.machine.keys.rope import BendingConstants, RopeLife
from ptmcalc.machines.hoist.machine.model import loaded
from ptmcalc.machines.hoist.machine.spec import Hoist, HoistScene, Run
from ptmcalc.machines.hoist.rope import bends
from ptmcalc.machines.hoist.rope.bends import Bends

FORCE, COUNT = "rope_life_force", "rope_bendings"
ON_SHEAVE, ON_DRUM = "bendings_sheave", "bendings_drum"
DISCARD, BREAK, YEARS = "rope_lifts_discard", "rope_lifts_break", "rope_life_years"
WIRES, WIRE_FORCE, DONANDT = "rope_wire_breaks", "wire_break_force_ratio", "donandt_force_ratio"

LOADS = (
    LoadInfo(FORCE, "rope force in use, rated load", units.FORCE, headline=False),
    LoadInfo(COUNT, "bendings of the worst piece of rope per lift", units.RATIO),
    LoadInfo(ON_SHEAVE, "bendings to discard on a sheave, rated load", units.RATIO, headline=False),
    LoadInfo(ON_DRUM, "bendings to discard on the drum, rated load", units.RATIO, headline=False),
    LoadInfo(DISCARD, "lifts until the rope is discarded", units.RATIO, governing=True),
    LoadInfo(BREAK, "lifts until the rope breaks", units.RATIO),
    LoadInfo(YEARS, "years until the rope is discarded", units.RATIO),
    LoadInfo(WIRES, "wire breaks at discard on 30 rope diameters", units.RATIO, headline=False),
    LoadInfo(WIRE_FORCE, "rope force / force of enough wire breaks", units.RATIO),
    LoadInfo(DONANDT, "rope force / Donandt force", units.RATIO),
)
_RANGE = (10.0, 100.0)
"""Range of D/d in which the number of bendings is valid [1] (Feyrer 2015); outside, the report says so."""
_ONCE = 1.0
"""Lifts of the empty hook for each lift of a load [1]: a working cycle lifts and lowers the load once, and the empty
hook once. More of them shorten the life of ropes under heavy grabs."""


def of_core(life: RopeLife) -> float:
    """Endurance factor of core and strands [1]."""
    if life.core_factor is not None:
        return life.core_factor
    return rope_life.CORE_FACTOR[life.core or "FC"][life.strands or 6]


def spectrum(spec: Hoist) -> tuple[tuple[float, float], ...]:
    """Shares of the working cycles and their loads relative to the rated load [1]."""
    points = spec.duty.load_spectrum if spec.duty is not None else None
    return tuple((point.share, point.load) for point in points) if points else ((1.0, 1.0),)


class Endurance:
    """The number of bendings of one rope by its force, on sheaves and on the drum."""

    def __init__(self, spec: Hoist, life: RopeLife, constants: BendingConstants) -> None:
        self.spec, self.life = spec, life
        self.constants = rope_life.Constants(constants.b0, constants.b1, constants.b2, constants.b3)
        d = spec.rope.diameter
        length = life.bending_length or spec.height * model.falls_of_a_rope(spec)
        self.factor = rope_life.diameter_factor(d) * rope_life.length_factor(length, d) * of_core(life)

    def force(self, load: float) -> float:
        """Rope force in use with a mass on the hook block, hook at its lowest [N]."""
        return model.pulls(self.spec, self.spec.hook_block + load, 0.0, hauling=True).drum * self.life.force_factor

    def number(self, force: float, ratio: float) -> float:
        """Bendings that the rope endures [1]."""
        d, strength = self.spec.rope.diameter, self.life.wire_strength
        return rope_life.bending_number(force, d, ratio, strength, self.constants, self.factor)

    def damage(self, force: float, place: Bends) -> float:
        """Share of the life of a piece of rope that a lift and a lowering take [1]."""
        used = place.drum * _inverse(self.number(force, bends.drum_ratio(self.spec)))
        ratio = bends.sheave_ratio(self.spec)
        if not place.sheaves or ratio is None:
            return used
        simple, reverse = self.number(force, ratio), min(self.life.reverse_sheaves, place.sheaves)
        used += 2 * (place.sheaves - reverse) * _inverse(simple)
        law = self.life.reversal
        if reverse and law is not None:
            used += 2 * reverse * _inverse(rope_life.reversed_number(simple, law.a1, law.a2))
        return used

    def of_cycle(self, place: Bends) -> float:
        """Share of the life of a piece of rope that a mean working cycle takes [1]."""
        rated = sum(
            share * self.damage(self.force(load * self.spec.load), place) for share, load in spectrum(self.spec)
        )
        return rated + _ONCE * self.damage(self.force(0.0), place)

    def lifts(self) -> float:
        """Working cycles of the worst piece [1]."""
        return _inverse(self.of_cycle(bends.worst(self.spec, self.of_cycle)))


def _inverse(number: float) -> float:
    return 1 / number if number > 0 else math.inf


def run(spec: Hoist, scene: HoistScene, carried: frozenset[str], level: int) -> Result:
    """Lifts until the rope is discarded or breaks, by the bendings of its worst piece.

        1/Z = sum u_i (2 n_s/N_s(S_i) + 2 n_r/N_r(S_i) + n_d/N_d(S_i)),   S_i = c S_up(m_i)

    The sum is over the loads of the spectrum with their shares, and once the empty hook. n_s sheaves with bendings to
    one side, n_r with reverse bendings and n_d = 1 on the drum are those that the worst piece passes in a lift
    (`rope.bends`). N follows from `laws.rope_life`.

    **Range** 10 <= D/d <= 100, forces below the Donandt force, lifts over the whole height. Crossings of the rope on a
    drum in several layers are not covered: they shorten the life.
    **Error** exact for that model; the scatter of ropes is in the choice of the constants (mean or 10 %).
    **Source** K. Feyrer, Wire Ropes, 2nd edition 2015, chapter 3.4; Palmgren-Miner.
    """
    life = spec.rope_life
    ratio = bends.smallest_ratio(spec)
    if life is None or ratio is None:
        return Result({}, work=1)
    discard = Endurance(spec, life, life.discarding)
    force = discard.force(spec.load)
    place = bends.worst(spec, discard.of_cycle)
    lifts, note = discard.lifts(), "; ".join(_notes(spec, life, ratio))
    loads: dict[str, float] = {
        FORCE: force,
        COUNT: 2.0 * place.sheaves + place.drum,
        ON_DRUM: discard.number(force, bends.drum_ratio(spec)),
    }
    if (on_sheave := bends.sheave_ratio(spec)) is not None:
        loads[ON_SHEAVE] = discard.number(force, on_sheave)
    if life.breaking is not None:
        loads[BREAK] = Endurance(spec, life, life.breaking).lifts()
    if life.lifts_per_year is not None:
        loads[YEARS] = lifts / life.lifts_per_year
    if (wires := life.wire_breaks) is not None:
        loads[WIRES] = rope_life.wire_breaks(force, spec.rope.diameter, ratio, wires.rope)
        enough = rope_life.discard_force(spec.rope.diameter, ratio, wires.rope, wires.count)
        loads[WIRE_FORCE] = force / enough if enough > 0 else math.inf
    if life.donandt_force is not None:
        loads[DONANDT] = force / life.donandt_force
    found = {name: Found(Estimate.exact(value)) for name, value in loads.items()}
    return Result(found | {DISCARD: Found(Estimate.exact(lifts), note=note)}, work=1)


def _notes(spec: Hoist, life: RopeLife, ratio: float) -> Iterator[str]:
    """What a reader of the number of lifts must know."""
    yield f"constants of {life.source}"
    if not (_RANGE[0] <= ratio <= _RANGE[1]):
        yield f"D/d = {ratio:.3g} is outside the range of the formula, 10 to 100"
    if model.wound(spec, spec.height).layers > 1:
        yield "crossings of the rope on the drum in several layers are not covered"
    if life.wire_breaks is not None:
        yield "signs of the constants of the wire breaks to be compared with the book"


SOLVER: Solver[Hoist, HoistScene] = Solver(
    name="rope_bending_life",
    title="life of the rope by its number of bendings",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Run}),
    represents=frozenset(),
    gives=frozenset(info.name for info in LOADS),
    run=run,
    cost=lambda spec, scene, carried, level: 1e-3,
    source="Feyrer, Wire Ropes, 2nd edition 2015, chapter 3.4; Palmgren-Miner",
)


def _has(name: str) -> Callable[[Check[Hoist, Run]], Check[Hoist, Run]]:
    def wanted(spec: Hoist, scene: HoistScene) -> bool:
        return loaded(spec, scene) and spec.rope_life is not None and getattr(spec.rope_life, name) is not None

    return only(wanted)


def _bent_at(spec: Hoist, scene: HoistScene) -> KeyPath:
    """Sheaves bend the rope more often than the drum."""
    return ("reeving", "sheave_diameter") if bends.runs_over_sheaves(spec) else ("drum", "diameter")


def _needs_sheaves(spec: Hoist, scene: HoistScene) -> tuple[KeyPath, ...]:
    return (("reeving", "sheave_diameter"),) if bends.smallest_ratio(spec) is None else ()


def _needs_rate(spec: Hoist, scene: HoistScene) -> tuple[KeyPath, ...]:
    known = spec.rope_life is not None and spec.rope_life.lifts_per_year is not None
    return (*_needs_sheaves(spec, scene), *(() if known else (("rope_life", "lifts_per_year"),)))


LIFTS: Check[Hoist, Run] = _has("lifts")(
    Check(
        code="HST150",
        title="lifts until the rope is discarded",
        question="Does the rope endure the required number of lifts?",
        failure="rope fatigues before the required number of lifts",
        scenes=frozenset({Run}),
        loads=(DISCARD,),
        sense=Sense.AT_LEAST,
        limit=key(
            "rope_life.lifts", meaning="Required lifts of the file", valid="any rope", error="none: a given value"
        ),
        needs=_needs_sheaves,
        blame=lambda spec, scene, loads: _bent_at(spec, scene),
        repair=_bent_at,
        what="The number of lifts until the worst piece of the rope is discarded is at least the required one.",
        why="A running rope is bent at every sheave and breaks wire by wire. Its life is always limited.",
        formula="Z >= Z_req,   1/Z = sum u_i (2 n_s/N_s + 2 n_r/N_r + n_d/N_d)",
        source="Feyrer, Wire Ropes, 2nd edition 2015, chapter 3.4; constants of the file",
    )
)

LIFE: Check[Hoist, Run] = _has("years")(
    Check(
        code="HST151",
        title="years until the rope is discarded",
        question="Does the rope last the required number of years?",
        failure="rope is discarded before the required time",
        scenes=frozenset({Run}),
        loads=(YEARS,),
        sense=Sense.AT_LEAST,
        limit=key(
            "rope_life.years", meaning="Required years of the file", valid="any rope", error="none: a given value"
        ),
        needs=_needs_rate,
        blame=lambda spec, scene, loads: _bent_at(spec, scene),
        repair=_bent_at,
        what="The lifts until the rope is discarded, divided by the working cycles per year, are at least the required"
        " years.",
        why="Corrosion and wear come in addition. A rope that lasts one inspection interval only may break before it.",
        formula="Z/C >= years",
        source="Feyrer, Wire Ropes, 2nd edition 2015, chapter 3.4; constants of the file",
    )
)

_ONE = fixed(
    1.0,
    meaning="1: the rope force is at most the force of the limit",
    valid="ropes with data in the file",
    error="none: a definition",
    source="Feyrer, Wire Ropes, 2nd edition 2015, chapter 3.4",
)

ENOUGH_BREAKS: Check[Hoist, Run] = _has("wire_breaks")(
    Check(
        code="HST152",
        hazard=True,
        title="rope force relative to the force of enough wire breaks",
        question="Does the rope show enough wire breaks before it breaks?",
        failure="rope breaks with too few visible wire breaks",
        scenes=frozenset({Run}),
        loads=(WIRE_FORCE,),
        sense=Sense.AT_MOST,
        limit=_ONE,
        needs=_needs_sheaves,
        blame=lambda spec, scene, loads: _bent_at(spec, scene),
        repair=_bent_at,
        what="The rope force in use is at most the force at which the rope shows the required number of wire breaks at"
        " discard.",
        why="An inspection finds a worn rope by its broken wires. A rope under a large force breaks without warning.",
        formula="S/S_G <= 1,   S_G = d^2 sqrt((g_0 - g_2 (d/D)^2 - B)/(g_1 + g_3 (d/D)^2))",
        source="Feyrer, Wire Ropes, 2nd edition 2015, chapter 3.4; signs of the constants to be compared",
    )
)

BELOW_DONANDT: Check[Hoist, Run] = _has("donandt_force")(
    Check(
        code="HST153",
        hazard=True,
        title="rope force relative to the Donandt force",
        question="Is the rope force below the Donandt force?",
        failure="rope force exceeds the Donandt force",
        scenes=frozenset({Run}),
        loads=(DONANDT,),
        sense=Sense.AT_MOST,
        limit=_ONE,
        needs=_needs_sheaves,
        blame=blames("rope_life", "donandt_force"),
        repair=no_repair,
        what="The rope force in use is at most the Donandt force of the rope on its smallest sheave.",
        why="Above the Donandt force the wires yield, and the number of bendings drops steeply.",
        formula="S/S_D <= 1",
        source="Feyrer, Wire Ropes, 2nd edition 2015, chapter 3.4",
    )
)

ROPE_LIFE: Topic[Hoist] = Topic(
    loads=LOADS,
    solvers=(SOLVER,),
    checks=(LIFTS, LIFE, ENOUGH_BREAKS, BELOW_DONANDT),
)
