"""Checks of the polygon effect: resonance, and what the largest and smallest tension of steady running do."""

from collections.abc import Callable, Mapping

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import Check, LimitState, Sense, at, blames, needs, no_needs, no_repair, only
from ptmcalc.contract.limits import key
from ptmcalc.machines.chain_drive.machine.model import tension_key
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, Run
from ptmcalc.machines.chain_drive.machine.strength import SAFETY
from ptmcalc.machines.chain_drive.polygon.excitation import POLYGON, WEAK
from ptmcalc.machines.chain_drive.polygon.resonances import resonances

Loads = Mapping[str, Estimate]
RUNNING = frozenset({Run})

_SPEED = ("speed",)
_BREAKING = ("chain", "breaking_load")


def _near_resonance(spec: ChainDrive, loads: Loads) -> bool:
    distance = loads.get("resonance_distance")
    return distance is not None and distance.value < spec.checks.resonance.band


def _unless_resonant(path: Callable[[ChainDrive, Run], KeyPath]) -> Callable[[ChainDrive, Run], KeyPath]:
    """A stronger chain is no way out of a resonance: nothing is offered there."""

    def repair(spec: ChainDrive, scene: Run) -> KeyPath:
        carried = frozenset({WEAK}) if spec.drive is not None and spec.effects.get(WEAK) != "off" else frozenset[str]()
        nearest = resonances(spec, scene, carried).nearest(spec.speed)
        return () if nearest is not None and nearest[0] < 1 else path(spec, scene)

    return repair


# -- resonance ------------------------------------------------------------------------------------------------------


RESONANCE: Check[ChainDrive, Run] = only(lambda spec, scene: spec.effects.get(POLYGON) != "off")(
    Check(
        code="CHN101",
        title="polygon resonance separation",
        question="Is the chain speed far enough from every relevant polygon-effect resonance?",
        failure="chain speed is in the band of a polygon resonance",
        scenes=RUNNING,
        loads=("resonance_distance",),
        sense=Sense.AT_LEAST,
        limit=key(
            "checks.resonance.band",
            meaning="The speed is outside the band of every relevant resonance",
            valid="bands of 15 % of the resonance speed by default, or twice the damping ratio if that is larger",
            source="engineering rule; a resonance is relevant from a force of 0.5 m a_max",
        ),
        needs=no_needs,
        blame=blames(*_SPEED),
        repair=at(*_SPEED),
        forbids_band=True,
        what="The relative distance of the chain speed from every relevant resonance speed is at least the band. At a"
        " resonance speed, a harmonic of the tooth frequency equals a natural frequency of the chain. A resonance"
        " is relevant if its force reaches at least half of m a_max. The loads `safe_speed_below` and"
        " `safe_speed_above` state the nearest speeds that meet the criterion.",
        why="In resonance, the polygon effect loads the chain ten times as much as away from it. This load acts"
        " continuously, once per tooth.",
        formula="|V/V_nk - 1| >= max(15 %, 2 zeta_k),   V_nk = p f_k/n,   for (2/(pi n)) |D(w_k)|/(m w_k^2) >= 0.5",
        source="tooth frequency V/p and the frequency equations of the strands; the band is an engineering rule",
    )
)

# -- safety ---------------------------------------------------------------------------------------------------------


def _dynamic_limit(spec: ChainDrive, scene: Run) -> Estimate:
    """Required safety factor of the chain for the maximum tension of steady running.

    **Range** 7 for conveyors, 5 for drives between shafts, or the value of the file.
    **Error** none: a chosen limit.
    **Source** handbooks: 7 to 10 for traction chains; DIN 8195:1977: 5 under dynamic load for roller chains.
    """
    asked = spec.checks.safety_dynamic
    return Estimate.exact(asked if asked is not None else SAFETY[type(spec.layout)][1])


def _blame_strength(spec: ChainDrive, scene: Run, loads: Loads) -> KeyPath:
    """The speed where it meets a resonance, else the chain."""
    return _SPEED if _near_resonance(spec, loads) else _BREAKING


DYNAMIC_SAFETY: Check[ChainDrive, Run] = Check(
    code="CHN102",
    hazard=True,
    title="chain safety factor, steady running",
    question="Is the breaking load high enough for the largest tension of steady running, polygon effect included?",
    failure="chain is overloaded in steady running",
    scenes=RUNNING,
    loads=("safety_dynamic",),
    sense=Sense.AT_LEAST,
    limit=_dynamic_limit,
    needs=no_needs,
    blame=_blame_strength,
    repair=_unless_resonant(at(*_BREAKING)),
    what="The breaking load is at least the safety factor times the maximum tension of steady running. This tension"
    " includes the polygon effect and the centrifugal force.",
    why="The polygon effect loads the chain once per tooth and fatigues plates and pins. A broken chain runs away.",
    formula="F_B/(c (S_static + S_polygon + m V^2)) >= n",
    source="chain manufacturers' handbooks; lecture notes Kramatorsk 2007: S = S_C + S_D",
)

# -- joints ---------------------------------------------------------------------------------------------------------


PRESSURE = only(lambda spec, scene: spec.checks.joint_pressure is not None)(
    Check(
        code="CHN104",
        title="pin/bush bearing pressure",
        question="Is the bearing pressure between pin and bush within the permissible value?",
        failure="pin/bush bearing pressure is too high",
        scenes=RUNNING,
        loads=("joint_pressure",),
        sense=Sense.AT_MOST,
        limit=key(
            "checks.joint_pressure",
            meaning="Permissible bearing pressure of the link joints, given in the file",
            valid="20 to 30 MPa is usual, less for fast chains and poor lubrication",
            source="chain manufacturers' handbooks",
        ),
        needs=needs(("chain", "pin_diameter"), ("chain", "bush_length")),
        blame=lambda spec, scene, loads: _SPEED if _near_resonance(spec, loads) else ("chain", "pin_diameter"),
        repair=_unless_resonant(at("chain", "pin_diameter")),
        what="The bearing pressure between pin and bush at the maximum tension of a chain is at most the limit of the"
        " file.",
        why="Above the limit the oil film breaks, and the link joints wear many times as fast.",
        formula="c S/(d b) <= p",
        source="ISO 606:2015, bearing area; chain manufacturers' handbooks",
    )
)

# -- slack ----------------------------------------------------------------------------------------------------------


def _tension_key(spec: ChainDrive, scene: Run) -> KeyPath:
    return tension_key(spec)


SLACK: Check[ChainDrive, Run] = Check(
    code="CHN105",
    hazard=True,
    title="minimum chain tension, steady running",
    question="Does every strand stay taut in steady running?",
    failure="chain tension falls below its minimum",
    limit_state=LimitState("chain goes slack", 0),
    scenes=RUNNING,
    loads=("tension_min",),
    sense=Sense.AT_LEAST,
    limit=key(
        "checks.least_tension",
        meaning="Minimum tension given in the file, 0 N by default",
        valid="steady running; the ends of the strands, at drive and tail",
        source="a chain carries no compression: without tension it piles up and jumps teeth",
    ),
    needs=no_needs,
    blame=lambda spec, scene, loads: _SPEED if _near_resonance(spec, loads) else _tension_key(spec, scene),
    repair=_unless_resonant(_tension_key),
    what="In steady running, the minimum tension of every strand is at least the limit, 0 N by default. This tension"
    " includes the oscillations of the polygon effect.",
    why="A slack chain piles up before the sprocket and jumps teeth. An impact loads it when it becomes taut again.",
    formula="min(S_static + S_polygon) >= S_least",
    source="equilibrium strand by strand",
)

# -- fatigue -------------------------------------------------------------------------------------------------------


FATIGUE: Check[ChainDrive, Run] = only(lambda spec, scene: spec.chain.fatigue_limit is not None)(
    Check(
        code="CHN107",
        hazard=True,
        title="link plate fatigue utilisation",
        question="Is the alternating stress of the link plates within the fatigue limit?",
        failure="link plates exceed the fatigue limit",
        scenes=RUNNING,
        loads=("fatigue_utilisation",),
        sense=Sense.AT_MOST,
        limit=key(
            "checks.fatigue",
            meaning="Maximum utilisation of the permissible stress amplitude",
            valid="1 is full utilisation",
            source="Goodman's line",
        ),
        needs=needs(("chain", "section")),
        blame=lambda spec, scene, loads: _SPEED if _near_resonance(spec, loads) else ("chain", "section"),
        repair=no_repair,
        what="The fatigue utilisation of the link plates is at most the limit. It compares the stress amplitude of the"
        " polygon effect with the amplitude of the file. The amplitude of the file applies to the tooth passes of"
        " the required life. The mean stress counts by Goodman's line if the strength of the plates is given.",
        why="A chain passes millions of teeth. Overstressed plates crack at their holes.",
        formula="s_a/s_lim + s_m/R_m <= 1,   s_a = c (S_max - S_min)/(2 A)",
        source="J. Goodman 1899; limits by chain manufacturers",
    )
)
