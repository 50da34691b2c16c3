"""Checks of the choice of a chain: static safety, wear life, geometry, power."""

from collections.abc import Mapping

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import Check, Sense, at, blames, no_needs, no_repair, only
from ptmcalc.contract.limits import key
from ptmcalc.machines.chain_drive.machine.layout import ConveyorLayout, TwoShafts
from ptmcalc.machines.chain_drive.machine.model import tail_teeth
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, Run
from ptmcalc.machines.chain_drive.machine.strength import SAFETY

Loads = Mapping[str, Estimate]
RUNNING = frozenset({Run})

_BREAKING = ("chain", "breaking_load")
_TEETH = {ConveyorLayout: 6, TwoShafts: 17}
"""Minimum number of teeth by default: 6 for conveyor chains (ISO 1977:2006), 17 for drives (ISO 10823:2004). A smaller
number accepts a larger polygon effect."""


def _between_shafts(spec: ChainDrive, scene: Run) -> bool:
    return isinstance(spec.layout, TwoShafts)


def _static_limit(spec: ChainDrive, scene: Run) -> Estimate:
    """Required safety factor of the chain for static and centrifugal tension.

    **Range** 10 for conveyors, 7 for drives between shafts, or the value of the file.
    **Error** none: a chosen limit.
    **Source** handbooks: 7 to 10 for traction chains; DIN 8195:1977: 7 for static load of roller chains.
    """
    asked = spec.checks.safety_static
    return Estimate.exact(asked if asked is not None else SAFETY[type(spec.layout)][0])


STATIC_SAFETY: Check[ChainDrive, Run] = Check(
    code="CHN103",
    hazard=True,
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
    source="chain manufacturers' handbooks; lecture notes Kramatorsk 2007",
)

# -- life -----------------------------------------------------------------------------------------------------------


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
        limit=key(
            "checks.life",
            meaning="Required life given in the file",
            valid="any",
            source="the design's own requirement; 15 000 h is usual for drives",
        ),
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

# -- geometry -------------------------------------------------------------------------------------------------------


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
        limit=key(
            "checks.wrap",
            meaning="Minimum wrap angle of a sprocket, 120 deg by default",
            valid="drives between shafts",
            source="handbooks (ACA): 120 deg",
        ),
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
    """Minimum number of teeth: 6 for conveyors, 17 for drives, or the value of the file.

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


RATIO = only(_between_shafts)(
    Check(
        code="CHN110",
        title="transmission ratio of one chain",
        question="Is the ratio z2/z1 within the range of a single chain drive?",
        failure="ratio is too large for one chain",
        scenes=RUNNING,
        loads=("ratio",),
        sense=Sense.AT_MOST,
        limit=key(
            "checks.ratio",
            meaning="Maximum transmission ratio, 6 by default",
            valid="drives between shafts",
            source="handbooks: up to 6, 7 and more at low speed",
        ),
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


NEAR_SHAFTS = only(_between_shafts)(
    Check(
        code="CHN111",
        title="minimum centre distance",
        question="Is the centre distance large enough, in chain pitches?",
        failure="centre distance is too small",
        scenes=RUNNING,
        loads=("centre_distance_pitches",),
        sense=Sense.AT_LEAST,
        limit=key(
            "checks.centre_distance_least",
            meaning="Minimum centre distance in pitches, 30 by default",
            valid="drives between shafts",
            source="handbooks: 30 to 50 pitches",
        ),
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
        failure="centre distance is too large for unsupported strands",
        scenes=RUNNING,
        loads=("centre_distance_pitches",),
        sense=Sense.AT_MOST,
        limit=key(
            "checks.centre_distance_most",
            meaning="Maximum centre distance in pitches, 80 by default",
            valid="drives between shafts with unsupported strands",
            source="handbooks: 30 to 50 pitches, 80 at most",
        ),
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


POWER = only(lambda spec, scene: isinstance(spec.layout, TwoShafts) and spec.layout.rated_power is not None)(
    Check(
        code="CHN113",
        title="design power of the chain",
        question="Is the design power within the rated power of the chain?",
        failure="design power exceeds the rated power of the chain",
        scenes=RUNNING,
        loads=("design_power",),
        sense=Sense.AT_MOST,
        limit=key(
            "layout.rated_power",
            meaning="Rated power of the chain from the manufacturer's chart",
            valid="one chain on the teeth of the chart, 19 by default, at the speed of the file",
            error="none: the manufacturer's figure",
            source="rating charts after ISO 10823",
        ),
        needs=no_needs,
        blame=blames("layout", "rated_power"),
        repair=at("layout", "rated_power"),
        what="The design power is at most the rated power of the manufacturer's chart. It includes the factors of"
        " service, teeth and rows.",
        why="The chart accounts for wear and fatigue of a chain of this pitch at this speed. A higher power shortens"
        " the chain life.",
        formula="P f_1 f_2/k <= P_rated,   f_2 = (z_r/z_1)^1.08",
        source="ISO 10823:2004; ACA for the rows",
    )
)
