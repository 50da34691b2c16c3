"""Proof of competence of the rope by EN 13001-3-2: static strength and fatigue of one fall."""

import math
from collections.abc import Iterator

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import Check, Sense, at, blames, only
from ptmcalc.contract.limits import fixed
from ptmcalc.contract.result import Found, LoadInfo, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.contract.topic import Topic
from ptmcalc.laws import rope_proof
from ptmcalc.machines.hoist.machine import model
from ptmcalc.machines.hoist.machine.keys.rope import RopeProof
from ptmcalc.machines.hoist.machine.model import loaded
from ptmcalc.machines.hoist.machine.spec import Hoist, HoistScene, Run
from ptmcalc.machines.hoist.rope import bends
from ptmcalc.machines.hoist.rope.bends import Bends
from ptmcalc.machines.hoist.rope.life import spectrum

STATIC_FORCE, STATIC_RESISTANCE, STATIC = "rope_static_force", "rope_static_resistance", "rope_static_utilisation"
FATIGUE_FORCE, FATIGUE_RESISTANCE = "rope_fatigue_force", "rope_fatigue_resistance"
FATIGUE, HISTORY, LIFTS = "rope_fatigue_utilisation", "rope_force_history", "rope_design_lifts"

LOADS = (
    LoadInfo(STATIC_FORCE, "design rope force F_Sd, static", units.FORCE),
    LoadInfo(STATIC_RESISTANCE, "limit design rope force F_Rd, static", units.FORCE, headline=False),
    LoadInfo(STATIC, "utilisation of the rope, static (EN 13001-3-2)", units.SHARE, governing=True),
    LoadInfo(FATIGUE_FORCE, "design rope force F_Sd, fatigue", units.FORCE),
    LoadInfo(FATIGUE_RESISTANCE, "limit design rope force F_Rd, fatigue", units.FORCE, headline=False),
    LoadInfo(FATIGUE, "utilisation of the rope, fatigue (EN 13001-3-2)", units.SHARE, governing=True),
    LoadInfo(HISTORY, "rope force history parameter s_r", units.RATIO, headline=False),
    LoadInfo(LIFTS, "design lifts per rope (EN 13001-3-2)", units.RATIO),
)


def load_factor(spec: Hoist, proof: RopeProof) -> float | None:
    """phi of the file, else phi_2 of the hoisting class; None without either [1]."""
    return proof.load_factor if proof.load_factor is not None else model.class_factor(spec)


def strength(spec: Hoist, proof: RopeProof) -> float | None:
    """Breaking force of the rope with its termination; None where the file does not give it [N]."""
    kept = proof.termination_factor
    if kept is None:
        kept = rope_proof.TERMINATION[proof.termination or "socket"]
    return None if spec.rope.breaking_force is None else spec.rope.breaking_force * kept


def rated_pull(spec: Hoist) -> float:
    """Steady rope pull at the drum under the rated load, hook at its lowest [N]."""
    return model.pulls(spec, spec.hook_block + spec.load, 0.0, hauling=True).drum


def directions(proof: RopeProof) -> float:
    """Factors of the direction of the falls, f_S2 f_S3 [1]."""
    return proof.acceleration_factor / math.cos(proof.fall_angle)


def counted(proof: RopeProof, place: Bends) -> float:
    """Bendings that a lift counts [1]."""
    reverse = min(proof.reverse_sheaves, place.sheaves)
    simple = place.sheaves - reverse
    return float(simple * rope_proof.SHEAVE + reverse * rope_proof.REVERSED + place.drum * rope_proof.DRUM)


def cycles(spec: Hoist, proof: RopeProof) -> float | None:
    """Working cycles of the crane in its life; None where the file does not give them [1]."""
    return proof.cycles if proof.cycles is not None else spec.duty.cycles if spec.duty is not None else None


def product(proof: RopeProof) -> float:
    """f_f [1]."""
    return math.prod(1.0 if one is None else one for _, one in proof.factors)


def run(spec: Hoist, scene: HoistScene, carried: frozenset[str], level: int) -> Result:
    """Design rope forces and their limits.

        static: F_Sd = phi S f_S2 f_S3 gamma_p gamma_n,   F_Rd = F_u/gamma_rb
        fatigue: F_Sd = phi_f S f_S2 f_S3 gamma_n,   F_Rd = F_u f_f/(gamma_rf s_r^(1/3)),   s_r = k_r w C/(l_r w_D)

    S is the steady rope pull at the drum, which contains the efficiency of the reeving (f_S1) and the weight of the
    rope. w counts the bendings of the worst piece of rope in a lift (`rope.bends`). The design lifts of a rope follow
    from F_Sd = F_Rd.

    **Range** running ropes; several layers by the factor f_f5 of the file only.
    **Error** none: a rule. Its numbers are to be compared with the standard.
    **Source** EN 13001-3-2:2014, `laws.rope_proof`.
    """
    proof = spec.rope_proof
    if proof is None:
        return Result({}, work=1)
    phi, force = load_factor(spec, proof), strength(spec, proof)
    ratio = bends.smallest_ratio(spec)
    if phi is None or force is None or ratio is None:
        return Result({}, work=1)
    pull = rated_pull(spec) * directions(proof) * proof.risk_factor
    partial = proof.partial_factor or rope_proof.PARTIAL[proof.combination]
    bent = proof.static_resistance or rope_proof.static_resistance(ratio)
    acting, resisting = phi * pull * partial, force / bent
    found = {
        STATIC_FORCE: Found(Estimate.exact(acting)),
        STATIC_RESISTANCE: Found(Estimate.exact(resisting)),
        STATIC: Found(
            Estimate.exact(acting / resisting if resisting > 0 else math.inf),
            note=f"{proof.edition}: gamma_p {partial:.3g}, gamma_rb {bent:.3g}, to be compared with the standard",
        ),
    }
    return Result(found | _of_fatigue(spec, proof, pull * (proof.fatigue_load_factor or (1 + phi) / 2), force), work=1)


def _of_fatigue(spec: Hoist, proof: RopeProof, acting: float, force: float) -> dict[str, Found]:
    """Loads of the fatigue proof, as far as the file gives its data."""
    reference = proof.reference_bendings or rope_proof.REFERENCE_BENDINGS
    gamma, factor = proof.fatigue_resistance or rope_proof.FATIGUE_RESISTANCE, product(proof)
    bendings = proof.bendings or counted(proof, bends.worst(spec, lambda place: counted(proof, place)))
    shares, loads = zip(*spectrum(spec), strict=True)
    rated = rated_pull(spec)
    forces = [model.pulls(spec, spec.hook_block + load * spec.load, 0.0, hauling=True).drum / rated for load in loads]
    per_bending = rope_proof.history(shares, forces, 1.0, reference)
    used = per_bending * bendings
    lifts = (force * factor / (gamma * acting)) ** 3 / used if used > 0 else math.inf
    found = {
        FATIGUE_FORCE: Found(Estimate.exact(acting)),
        LIFTS: Found(
            Estimate.exact(lifts),
            note="a design number, not the attainable one: compare with the number of bendings (`rope_life`)",
        ),
    }
    total = cycles(spec, proof)
    if total is None or proof.ropes is None:
        return found
    parameter = used * total / proof.ropes
    resisting = rope_proof.fatigue_resistance(force, factor, gamma, parameter)
    return found | {
        HISTORY: Found(Estimate.exact(parameter)),
        FATIGUE_RESISTANCE: Found(Estimate.exact(resisting)),
        FATIGUE: Found(Estimate.exact(acting / resisting), note="; ".join(_notes(proof, gamma, reference))),
    }


def _notes(proof: RopeProof, gamma: float, reference: float) -> Iterator[str]:
    """What a reader of the fatigue proof must know."""
    yield f"{proof.edition}: w_D {reference:.6g}, gamma_rf {gamma:.3g}, to be compared with the standard"
    missing = [f"f_f{number}" for number, (_, one) in enumerate(proof.factors, 1) if one is None]
    if missing:
        yield f"{', '.join(missing)} not given: 1"


SOLVER: Solver[Hoist, HoistScene] = Solver(
    name="rope_proof",
    title="proof of competence of the rope, EN 13001-3-2",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Run}),
    represents=frozenset(),
    gives=frozenset(info.name for info in LOADS),
    run=run,
    cost=lambda spec, scene, carried, level: 1e-3,
    source="EN 13001-3-2:2014, to be compared with the standard",
)


def _wanted(spec: Hoist, scene: HoistScene) -> bool:
    return loaded(spec, scene) and spec.rope_proof is not None


def _fatigues(spec: Hoist, scene: HoistScene) -> bool:
    return _wanted(spec, scene) and spec.rope_proof is not None and spec.rope_proof.ropes is not None


def _needs(spec: Hoist, scene: HoistScene) -> tuple[KeyPath, ...]:
    proof = spec.rope_proof
    sheaves = (("reeving", "sheave_diameter"),) if bends.smallest_ratio(spec) is None else ()
    phi = () if proof is None or load_factor(spec, proof) is not None else (("rope_proof", "load_factor"),)
    return (("rope", "breaking_force"), *sheaves, *phi)


def _fatigue_needs(spec: Hoist, scene: HoistScene) -> tuple[KeyPath, ...]:
    proof = spec.rope_proof
    known = proof is None or cycles(spec, proof) is not None
    return (*_needs(spec, scene), *(() if known else (("rope_proof", "cycles"),)))


_FULL = fixed(
    1.0,
    meaning="1: the design rope force is at most its limit",
    valid="running ropes",
    error="none: a definition",
    source="EN 13001-3-2:2014",
)

STATIC_PROOF: Check[Hoist, Run] = only(_wanted)(
    Check(
        code="HST154",
        hazard=True,
        title="utilisation of the rope, static (EN 13001-3-2)",
        question="Is the static strength of the rope proved by EN 13001-3-2?",
        failure="static strength of the rope is not proved",
        scenes=frozenset({Run}),
        loads=(STATIC,),
        sense=Sense.AT_MOST,
        limit=_FULL,
        needs=_needs,
        blame=blames("rope", "breaking_force"),
        repair=at("rope", "breaking_force"),
        what="The design force of one rope fall is at most the breaking force with its termination, divided by the"
        " resistance factor gamma_rb.",
        why="The rope breaks under the load with its dynamic factor. A sharp bend reduces its strength.",
        formula="phi S f_S2 f_S3 gamma_p gamma_n <= F_u/gamma_rb,   gamma_rb = max(2.07, 1.35 + 5/((D/d)^0.8 - 4))",
        source="EN 13001-3-2:2014, to be compared with the standard",
    )
)

FATIGUE_PROOF: Check[Hoist, Run] = only(_fatigues)(
    Check(
        code="HST155",
        hazard=True,
        title="utilisation of the rope, fatigue (EN 13001-3-2)",
        question="Is the fatigue strength of the rope proved by EN 13001-3-2?",
        failure="fatigue strength of the rope is not proved",
        scenes=frozenset({Run}),
        loads=(FATIGUE,),
        sense=Sense.AT_MOST,
        limit=_FULL,
        needs=_fatigue_needs,
        blame=blames("rope", "breaking_force"),
        repair=at("rope", "breaking_force"),
        what="The design force of the fatigue proof is at most its limit. The limit follows from the bendings of one"
        " rope in its design life and the spectrum of its forces.",
        why="Bendings on sheaves and drum fatigue the rope. The number of the standard is not the attainable one:"
        " compare the number of bendings by Feyrer.",
        formula="phi_f S f_S2 f_S3 gamma_n <= F_u f_f/(gamma_rf s_r^(1/3)),   s_r = k_r w C/(l_r w_D)",
        source="EN 13001-3-2:2014, to be compared with the standard",
    )
)

ROPE_PROOF: Topic[Hoist] = Topic(loads=LOADS, solvers=(SOLVER,), checks=(STATIC_PROOF, FATIGUE_PROOF))
