"""The checks of a chain drive in steady running."""

import math
from collections.abc import Callable, Mapping

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import AnyCheck, Check, LimitState, Sense, at, blames, no_needs, no_repair, only
from ptmcalc.machines.chain_drive.layout import ConveyorLayout, TwoShafts
from ptmcalc.machines.chain_drive.model import tail_teeth, tension_key
from ptmcalc.machines.chain_drive.polygon.excitation import POLYGON, WEAK
from ptmcalc.machines.chain_drive.polygon.resonances import resonances
from ptmcalc.machines.chain_drive.spec import ChainDrive, Run

Loads = Mapping[str, Estimate]
RUNNING = frozenset({Run})

_SPEED = ("speed",)
_BREAKING = ("chain", "breaking_load")
_SAFETY = {ConveyorLayout: (10.0, 7.0), TwoShafts: (7.0, 5.0)}
_TEETH = {ConveyorLayout: 6, TwoShafts: 17}


def _between_shafts(spec: ChainDrive, scene: Run) -> bool:
    return isinstance(spec.layout, TwoShafts)


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


def _resonance_limit(spec: ChainDrive, scene: Run) -> Estimate:
    """The speed lies outside the band of every resonance that matters.

    **Range** bands of 15 % of the resonance speed by default, twice the damping ratio where that is more.
    **Error** none: a chosen limit.
    **Source** engineering rule; what matters by the weight 0.5 m a_max.
    """
    return Estimate.exact(spec.checks.resonance.band)


RESONANCE: Check[ChainDrive, Run] = only(lambda spec, scene: spec.effects.get(POLYGON) != "off")(
    Check(
        code="CHN101",
        title="polygon resonance separation",
        question="Is the chain speed far enough from every relevant polygon-effect resonance?",
        failure="chain speed is in the band of a polygon resonance",
        scenes=RUNNING,
        loads=("resonance_distance",),
        sense=Sense.AT_LEAST,
        limit=_resonance_limit,
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
    """Safety asked of the chain against the largest tension of steady running.

    **Range** 7 for conveyors, 5 for drives between shafts, or what the file says.
    **Error** none: a chosen limit.
    **Source** handbooks: 7 to 10 for traction chains; DIN 8195:1977: 5 under dynamic load for roller chains.
    """
    asked = spec.checks.safety_dynamic
    return Estimate.exact(asked if asked is not None else _SAFETY[type(spec.layout)][1])


def _static_limit(spec: ChainDrive, scene: Run) -> Estimate:
    """Safety asked of the chain against its static and centrifugal tension.

    **Range** 10 for conveyors, 7 for drives between shafts, or what the file says.
    **Error** none: a chosen limit.
    **Source** handbooks: 7 to 10 for traction chains; DIN 8195:1977: 7 at rest for roller chains.
    """
    asked = spec.checks.safety_static
    return Estimate.exact(asked if asked is not None else _SAFETY[type(spec.layout)][0])


def _blame_strength(spec: ChainDrive, scene: Run, loads: Loads) -> KeyPath:
    """The speed where it meets a resonance, else the chain."""
    return _SPEED if _near_resonance(spec, loads) else _BREAKING


DYNAMIC_SAFETY: Check[ChainDrive, Run] = Check(
    code="CHN102",
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
    source="chain makers' handbooks; lecture notes Kramatorsk 2007: S = S_C + S_D",
)

STATIC_SAFETY: Check[ChainDrive, Run] = Check(
    code="CHN103",
    title="chain safety factor, static",
    question="Is the breaking load high enough for the static and centrifugal tension?",
    failure="chain is overloaded by the static tension",
    scenes=RUNNING,
    loads=("safety_static",),
    sense=Sense.AT_LEAST,
    limit=_static_limit,
    needs=no_needs,
    blame=blames(*_BREAKING),
    repair=at(*_BREAKING),
    what="The breaking load is at least the safety factor times the sum of static and centrifugal tension.",
    why="Wear, shocks and the uneven load share of parallel chains consume the apparent reserve.",
    formula="F_B/(c (S_static + m V^2)) >= n",
    source="chain makers' handbooks; lecture notes Kramatorsk 2007",
)

# -- joints ---------------------------------------------------------------------------------------------------------


def _pressure_limit(spec: ChainDrive, scene: Run) -> Estimate:
    """Largest pressure in the joints of the file.

    **Range** 20 to 30 MPa is usual, less for fast chains and poor lubrication.
    **Error** none: a chosen limit.
    **Source** chain makers' handbooks.
    """
    asked = spec.checks.joint_pressure
    return Estimate.exact(math.inf if asked is None else asked)


PRESSURE = only(lambda spec, scene: spec.checks.joint_pressure is not None)(
    Check(
        code="CHN104",
        title="pin/bush bearing pressure",
        question="Is the bearing pressure between pin and bush within the permissible value?",
        failure="pin/bush bearing pressure is too high",
        scenes=RUNNING,
        loads=("joint_pressure",),
        sense=Sense.AT_MOST,
        limit=_pressure_limit,
        needs=lambda spec, scene: (("chain", "pin_diameter"), ("chain", "bush_length")),
        blame=lambda spec, scene, loads: _SPEED if _near_resonance(spec, loads) else ("chain", "pin_diameter"),
        repair=_unless_resonant(at("chain", "pin_diameter")),
        what="The bearing pressure between pin and bush at the maximum tension of a chain is at most the limit of the"
        " file.",
        why="Above the limit the oil film breaks, and the link joints wear many times as fast.",
        formula="c S/(d b) <= p",
        source="ISO 606:2015, bearing area; chain makers' handbooks",
    )
)

# -- slack ----------------------------------------------------------------------------------------------------------


def _slack_limit(spec: ChainDrive, scene: Run) -> Estimate:
    """Smallest tension of the file, 0 N by default.

    **Range** steady running; the ends of the strands, at drive and tail.
    **Error** none: a chosen limit.
    **Source** a chain does not push: where the tension is gone, it piles up and jumps teeth.
    """
    return Estimate.exact(spec.checks.least_tension)


def _tension_key(spec: ChainDrive, scene: Run) -> KeyPath:
    return tension_key(spec)


SLACK: Check[ChainDrive, Run] = Check(
    code="CHN105",
    title="minimum chain tension, steady running",
    question="Does every strand stay taut in steady running?",
    failure="chain tension falls below its minimum",
    limit_state=LimitState("chain goes slack", 0),
    scenes=RUNNING,
    loads=("tension_min",),
    sense=Sense.AT_LEAST,
    limit=_slack_limit,
    needs=no_needs,
    blame=lambda spec, scene, loads: _SPEED if _near_resonance(spec, loads) else _tension_key(spec, scene),
    repair=_unless_resonant(_tension_key),
    what="In steady running, the minimum tension of every strand is at least the limit, 0 N by default. This tension"
    " includes the oscillations of the polygon effect.",
    why="A slack chain piles up before the sprocket and jumps teeth. An impact loads it when it becomes taut again.",
    formula="min(S_static + S_polygon) >= S_least",
    source="equilibrium strand by strand",
)

# -- life -----------------------------------------------------------------------------------------------------------


def _life_limit(spec: ChainDrive, scene: Run) -> Estimate:
    """Wanted life of the file.

    **Range** any.
    **Error** none: a chosen limit.
    **Source** the design's own requirement; 15 000 h is usual for drives.
    """
    asked = spec.checks.life
    return Estimate.exact(math.inf if asked is None else asked)


def _life_needs(spec: ChainDrive, scene: Run) -> tuple[KeyPath, ...]:
    needs: tuple[KeyPath, ...] = (("checks", "life"), ("wear",), ("chain", "pin_diameter"))
    by_area = spec.wear is not None and spec.wear.archard is not None
    return (*needs, ("chain", "bush_length")) if by_area else needs


LIFE = only(lambda spec, scene: spec.checks.life is not None or spec.wear is not None)(
    Check(
        code="CHN106",
        title="chain wear life",
        question="Does the chain reach the required life before its permissible wear elongation?",
        failure="chain wears out before its required life",
        scenes=RUNNING,
        loads=("life",),
        sense=Sense.AT_LEAST,
        limit=_life_limit,
        needs=_life_needs,
        blame=lambda spec, scene, loads: (
            ("wear", "coefficient") if spec.wear is not None and spec.wear.archard is None else ("wear", "archard")
        ),
        repair=no_repair,
        what="The chain reaches the required life before the wear of its link joints elongates it by the permissible"
        " share.",
        why="An elongated chain rides up on its teeth and jumps them.",
        formula="T = (e p/D) L/V,   D = sum (S_in + S_out) l f t_B   or by pressure and path (archard)",
        source="lecture notes Kramatorsk 2007; Archard 1953",
    )
)


def _fatigue_limit(spec: ChainDrive, scene: Run) -> Estimate:
    """Largest use of the permissible stress amplitude.

    **Range** 1 uses all of it.
    **Error** none: a chosen limit.
    **Source** Goodman's line.
    """
    return Estimate.exact(spec.checks.fatigue)


FATIGUE = only(lambda spec, scene: spec.chain.fatigue_limit is not None)(
    Check(
        code="CHN107",
        title="link plate fatigue utilisation",
        question="Is the alternating stress of the link plates within the fatigue limit?",
        failure="link plates exceed the fatigue limit",
        scenes=RUNNING,
        loads=("fatigue_utilisation",),
        sense=Sense.AT_MOST,
        limit=_fatigue_limit,
        needs=lambda spec, scene: (("chain", "section"),),
        blame=lambda spec, scene, loads: _SPEED if _near_resonance(spec, loads) else ("chain", "section"),
        repair=no_repair,
        what="The fatigue utilisation of the link plates is at most the limit. It compares the stress amplitude of the"
        " polygon effect with the amplitude of the file. The amplitude of the file applies to the tooth passes of"
        " the required life. The mean stress counts by Goodman's line if the strength of the plates is given.",
        why="A chain passes millions of teeth. Overstressed plates crack at their holes.",
        formula="s_a/s_lim + s_m/R_m <= 1,   s_a = c (S_max - S_min)/(2 A)",
        source="J. Goodman 1899; limits by chain makers",
    )
)

# -- geometry -------------------------------------------------------------------------------------------------------


def _wrap_limit(spec: ChainDrive, scene: Run) -> Estimate:
    """Smallest wrap of a sprocket, 120 deg by default.

    **Range** drives between shafts.
    **Error** none: a chosen limit.
    **Source** handbooks (ACA): 120 deg.
    """
    return Estimate.exact(spec.checks.wrap)


def _distance_key(spec: ChainDrive, scene: Run) -> KeyPath:
    given = isinstance(spec.layout, TwoShafts) and spec.layout.centre_distance is not None
    return ("layout", "centre_distance") if given else ("layout", "pitches")


def _distance_repair(spec: ChainDrive, scene: Run) -> KeyPath:
    path = _distance_key(spec, scene)
    return path if path[-1] == "centre_distance" else ()


WRAP = only(_between_shafts)(
    Check(
        code="CHN108",
        title="wrap angle, smaller sprocket",
        question="Is the wrap angle of the smaller sprocket large enough?",
        failure="wrap angle of the smaller sprocket is too small",
        scenes=RUNNING,
        loads=("wrap",),
        sense=Sense.AT_LEAST,
        limit=_wrap_limit,
        needs=no_needs,
        blame=lambda spec, scene, loads: _distance_key(spec, scene),
        repair=_distance_repair,
        what="The wrap angle of the chain on the smaller sprocket is at least the limit, 120 deg by default.",
        why="Few teeth in mesh carry the whole chain tension. They wear, and the chain jumps them.",
        formula="gamma = pi - 2 arcsin((R_2 - R_1)/C) >= 120 deg",
        source="geometry of the tangents; ACA",
    )
)


def _teeth_limit(spec: ChainDrive, scene: Run) -> Estimate:
    """Fewest teeth: 6 for conveyors, 17 for drives, or what the file says.

    **Range** traction chains at low speed; roller chains.
    **Error** none: a chosen limit.
    **Source** ISO 1977:2006 for conveyor chains; ISO 10823:2004: 17 and more.
    """
    asked = spec.checks.teeth
    return Estimate.exact(asked if asked is not None else _TEETH[type(spec.layout)])


def _small_sprocket(spec: ChainDrive, scene: Run, loads: Loads) -> KeyPath:
    if spec.sprocket.teeth <= tail_teeth(spec):
        return ("sprocket", "teeth")
    return ("layout", "driven" if isinstance(spec.layout, TwoShafts) else "tail", "teeth")


TEETH: Check[ChainDrive, Run] = Check(
    code="CHN109",
    title="number of teeth, smaller sprocket",
    question="Has the smaller sprocket enough teeth?",
    failure="smaller sprocket has too few teeth",
    scenes=RUNNING,
    loads=("teeth_least",),
    sense=Sense.AT_LEAST,
    limit=_teeth_limit,
    needs=no_needs,
    blame=_small_sprocket,
    repair=no_repair,
    what="The number of teeth of the smaller sprocket is at least the limit. The default is 6 for a conveyor and 17"
    " for a drive.",
    why="With few teeth, the chain speed fluctuates by 1 - cos(pi/z). The link joints turn through large angles and"
    " engage with an impact.",
    formula="min(z_1, z_2) >= z",
    source="ISO 1977:2006; ISO 10823:2004",
)


def _ratio_limit(spec: ChainDrive, scene: Run) -> Estimate:
    """Largest ratio of the teeth, 6 by default.

    **Range** drives between shafts.
    **Error** none: a chosen limit.
    **Source** handbooks: up to 6, 7 and more at low speed.
    """
    return Estimate.exact(spec.checks.ratio)


RATIO = only(_between_shafts)(
    Check(
        code="CHN110",
        title="transmission ratio of one chain",
        question="Is the ratio z2/z1 within the range of a single chain drive?",
        failure="ratio is too large for one chain",
        scenes=RUNNING,
        loads=("ratio",),
        sense=Sense.AT_MOST,
        limit=_ratio_limit,
        needs=no_needs,
        blame=blames("layout", "driven", "teeth"),
        repair=no_repair,
        what="The ratio of the teeth of both sprockets is at most the limit, 6 by default.",
        why="A large ratio reduces the wrap angle of the small sprocket. A worn chain soon rides up on a large"
        " sprocket.",
        formula="z_2/z_1 <= 6",
        source="ISO 10823:2004; ACA",
    )
)


def _least_distance(spec: ChainDrive, scene: Run) -> Estimate:
    """Smallest distance of the shafts in pitches, 30 by default.

    **Range** drives between shafts.
    **Error** none: a chosen limit.
    **Source** handbooks: 30 to 50 pitches.
    """
    return Estimate.exact(spec.checks.centre_distance_least)


def _most_distance(spec: ChainDrive, scene: Run) -> Estimate:
    """Largest distance of the shafts in pitches, 80 by default.

    **Range** drives between shafts whose strands nothing supports.
    **Error** none: a chosen limit.
    **Source** handbooks: 30 to 50 pitches, 80 at most.
    """
    return Estimate.exact(spec.checks.centre_distance_most)


NEAR_SHAFTS = only(_between_shafts)(
    Check(
        code="CHN111",
        title="minimum centre distance",
        question="Is the centre distance long enough, in pitches?",
        failure="centre distance is too short",
        scenes=RUNNING,
        loads=("centre_distance_pitches",),
        sense=Sense.AT_LEAST,
        limit=_least_distance,
        needs=no_needs,
        blame=lambda spec, scene, loads: _distance_key(spec, scene),
        repair=_distance_repair,
        what="The centre distance of the shafts is at least the limit, 30 pitches by default.",
        why="In a short chain every link joint bends often and wears fast.",
        formula="C/p >= 30",
        source="ISO 10823:2004; ACA: 30 to 50 pitches",
    )
)

FAR_SHAFTS = only(_between_shafts)(
    Check(
        code="CHN112",
        title="maximum centre distance",
        question="Is the centre distance short enough for unsupported strands?",
        failure="centre distance is too long for unsupported strands",
        scenes=RUNNING,
        loads=("centre_distance_pitches",),
        sense=Sense.AT_MOST,
        limit=_most_distance,
        needs=no_needs,
        blame=lambda spec, scene, loads: _distance_key(spec, scene),
        repair=_distance_repair,
        what="The centre distance of the shafts is at most the limit, 80 pitches by default.",
        why="A long unsupported strand is heavy, oscillates and rubs.",
        formula="C/p <= 80",
        source="ISO 10823:2004; ACA",
    )
)

# -- choice of the chain --------------------------------------------------------------------------------------------


def _power_limit(spec: ChainDrive, scene: Run) -> Estimate:
    """Rated power of the chain from the maker's chart.

    **Range** one chain on 19 teeth at the speed of the file.
    **Error** none: the maker's figure.
    **Source** rating charts after ISO 10823.
    """
    rated = spec.layout.rated_power if isinstance(spec.layout, TwoShafts) else None
    return Estimate.exact(math.inf if rated is None else rated)


POWER = only(lambda spec, scene: isinstance(spec.layout, TwoShafts) and spec.layout.rated_power is not None)(
    Check(
        code="CHN113",
        title="design power of the chain",
        question="Is the design power within the rated power of the chain?",
        failure="design power exceeds the rated power of the chain",
        scenes=RUNNING,
        loads=("design_power",),
        sense=Sense.AT_MOST,
        limit=_power_limit,
        needs=no_needs,
        blame=blames("layout", "rated_power"),
        repair=at("layout", "rated_power"),
        what="The design power is at most the rated power of the manufacturer's chart. It includes the factors of"
        " service, teeth and rows.",
        why="The chart accounts for wear and fatigue of a chain of this pitch at this speed. A higher power shortens"
        " the chain life.",
        formula="P f_1 f_2/k <= P_rated,   f_2 = (19/z_1)^1.08",
        source="ISO 10823:2004; ACA for the rows",
    )
)

CHECKS: tuple[AnyCheck, ...] = (
    RESONANCE,
    DYNAMIC_SAFETY,
    STATIC_SAFETY,
    PRESSURE,
    SLACK,
    LIFE,
    FATIGUE,
    WRAP,
    TEETH,
    RATIO,
    NEAR_SHAFTS,
    FAR_SHAFTS,
    POWER,
)
