"""Checks of what lies on the belt, and of what drums, transitions and vertical curves ask of it."""

import math
from collections.abc import Iterable

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import AnyCheck, Check, Sense, blames, no_needs, no_repair
from ptmcalc.contract.limits import fixed, key
from ptmcalc.laws import vertical_curve
from ptmcalc.machines.conveyor.machine.keys.belt import Transition
from ptmcalc.machines.conveyor.machine.keys.route import Bend, Curve
from ptmcalc.machines.conveyor.machine.model import breaking_force
from ptmcalc.machines.conveyor.machine.scenes import IN_MOTION, ConveyorScene, Jam, Run
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.running.belt_safety import safety_limit, safety_needs
from ptmcalc.machines.conveyor.running.limits import given
from ptmcalc.machines.conveyor.running.loads import bent, has_drum_data
from ptmcalc.numerics.lanes import value

Checks = Iterable[AnyCheck]

_WIDTH: KeyPath = ("belt", "width")
_TROUGH: KeyPath = ("idlers", "carry", "trough")


# -- cross-section of the load --------------------------------------------------------------------------------------


def _fill_checks(spec: Conveyor, scene: Run) -> Checks:
    """Where the file gives the bulk density."""
    return (FILL,) if spec.load.density is not None else ()


FILL: Check[Conveyor, Run] = Check(
    code="CNV112",
    title="belt filling ratio",
    question="Does the load cross-section carry the mass flow at the steepest section?",
    failure="belt is overfilled",
    scenes=frozenset({Run}),
    loads=("section_fill",),
    sense=Sense.AT_MOST,
    limit=key(
        "checks.section_fill",
        meaning="Permissible filling ratio of the file, 1 by default",
        valid="uniform feed; a smaller ratio leaves room for surges and lumps",
        source="DIN 22101: filling ratio 0.7 to 1.1",
    ),
    needs=lambda spec, scene: (_TROUGH, _WIDTH),
    blame=lambda spec, scene, loads: _WIDTH,
    repair=lambda spec, scene: _WIDTH,
    each=_fill_checks,
    what="The load cross-section carries the mass flow at the steepest point of the route. The filling ratio is at"
    " most the limit. `load.section_edition` selects the cross-section of ISO 5048, DIN 22101 or CEMA.",
    why="An overfilled belt spills its load over the edges and at the loading point.",
    formula="Q/(rho v (S_2 + k S_1)) <= limit,   S_2 = (l + e cos(lambda)) e sin(lambda),\n"
    "S_1 = (l + 2 e cos(lambda))^2 tan(theta)/6,   e = (0.9 B - 0.05 m - l)/2,   k^2 = 1 - sin^2 delta/sin^2 theta\n"
    "S_1 = (l + 2 e cos(lambda))^2 tan(theta)/4   (DIN 22101)\n"
    "S_1 = (l + 2 e cos(lambda))^2 (theta - sin(theta) cos(theta))/(4 sin^2 theta),   e = (0.89 B - 0.0457 m - l)/2"
    "   (CEMA)",
    source="ISO 5048:1989; DIN 22101 (k); by `load.section_edition` DIN 22101:2011 or CEMA; k is applied to each",
)

# -- drums ----------------------------------------------------------------------------------------------------------


def _drum_limit(spec: Conveyor, scene: Run) -> Estimate:
    """Diameter of the drive pulley.

    **Range** drive pulleys (group A); other pulleys may be smaller according to the tables of the standard.
    **Error** none: a given value.
    **Source** the file.
    """
    return Estimate.exact(spec.main_drive.drum.diameter)


def _drum_checks(spec: Conveyor, scene: Run) -> Checks:
    """One for each drive, where the file says what the belt bears."""
    for name, drive in spec.all_drives.items() if has_drum_data(spec) else ():
        key = (*spec.drive_path(name), "drum", "diameter")
        yield DRUM.of(name, given(drive.drum.diameter), key, repair=key)


DRUM: Check[Conveyor, Run] = Check(
    code="CNV113",
    title="required drive pulley diameter",
    question="Is every drive pulley large enough for the belt carcass?",
    failure="drive pulley is too small for the belt",
    scenes=frozenset({Run}),
    loads=("drum_diameter_required",),
    sense=Sense.AT_MOST,
    limit=_drum_limit,
    needs=no_needs,
    blame=lambda spec, scene, loads: (*spec.main_path, "drum", "diameter"),
    repair=lambda spec, scene: (*spec.main_path, "drum", "diameter"),
    each=_drum_checks,
    what="The diameter of every drive pulley is at least the diameter that the belt manufacturer or the belt carcass"
    " requires.",
    why="A belt bent too sharply at full tension breaks its plies or cords, first at the splice.",
    formula="c d <= D,   c = 80 cotton, 90 polyamide, 108 polyester, 138 aramid, 145 steel cord\n"
    "D_min <= D   (minimum diameter of the belt manufacturer)",
    source="DIN 22101, drums of group A",
)

# -- fibres across the belt -----------------------------------------------------------------------------------------


def _place_key(place: Curve | Transition | Bend, name: str) -> KeyPath:
    if isinstance(place, Bend):
        return bend_key(place, "radius")
    return curve_key(place) if isinstance(place, Curve) else ("transitions", name, "length")


def bend_key(bend: Bend, key: str) -> KeyPath:
    """Where a key of a horizontal curve stands in the file."""
    return ("route", "sections", bend.number - 1, "horizontal_curve", key)


def curve_key(curve: Curve) -> KeyPath:
    """Where the radius of a curve stands in the file."""
    return ("route", "sections", curve.number - 1, "curve_radius")


def _fibre_limit(spec: Conveyor, scene: Run) -> Estimate:
    """Permissible tension per width of a single fibre: that of the safety factor in steady running, times a permissible
    overload.

        k = (breaking force/W) m/safety,   m = 1.15 by default

    **Range** steady running; the rest of the belt carries the mean tension.
    **Error** none: a chosen limit.
    **Source** CEMA, "Belt Conveyors for Bulk Materials": edges up to 115 % of the rated tension, as quoted in public
    handbooks; to be compared with the edition in force.
    """
    strength = breaking_force(spec)
    if strength is None or spec.belt.width is None:
        return Estimate.exact(math.inf)
    most = strength / spec.belt.width / safety_limit(spec, scene).value
    return Estimate.exact(most * spec.checks.edge_overload)


_LEAST_LIMIT = fixed(
    0.0,
    meaning="0: no fibre is under compression",
    valid="steady running",
    source="a belt has no stiffness in compression: it buckles",
)


def _places(spec: Conveyor) -> dict[str, Curve | Transition | Bend]:
    """Transitions, horizontal curves and crests, which nothing else checks, and hollows of a belt whose trough is
    given."""
    troughed = spec.idlers.carry.trough is not None
    return {
        name: place
        for name, place in bent(spec).items()
        if troughed or not isinstance(place, Curve) or not place.hollow
    }


def _fibre_checks(spec: Conveyor, scene: Run) -> Checks:
    for name, place in _places(spec).items():
        key = _place_key(place, name)
        needs = (_TROUGH, _WIDTH, *safety_needs(spec, scene))
        yield FIBRE.of(name, _fibre_limit, key, needs, key)


def _least_checks(spec: Conveyor, scene: Run) -> Checks:
    for name, place in _places(spec).items():
        key = _place_key(place, name)
        yield PRESSED.of(name, _LEAST_LIMIT, key, (_TROUGH, _WIDTH), key)


_FIBRES = (
    "k = S/W + (EA/W) eps,   eps = z/R in a vertical curve, z the height of edge or middle over the mean of the\n"
    "trough; z = +-(l + 2 e cos(lambda))/2 in a horizontal curve, half the width of the trough; eps of a transition\n"
    "from the path of each fibre from the pulley to the trough"
)

FIBRE: Check[Conveyor, Run] = Check(
    code="CNV114",
    hazard=True,
    title="maximum belt fibre tension",
    question="Is the tension of edge and centre within its limit in transitions and curves?",
    failure="belt edge or centre is overstressed",
    scenes=frozenset({Run}),
    loads=("fibre_tension_max",),
    sense=Sense.AT_MOST,
    limit=_fibre_limit,
    needs=no_needs,
    blame=blames("transitions"),
    repair=no_repair,
    each=_fibre_checks,
    what="The maximum fibre tension per width is at most the limit in every transition, convex curve, concave curve and"
    " horizontal curve. The criterion applies to every partial loading of the belt.",
    why="Edges stretched beyond their strength crack, and the belt then runs off permanently.",
    formula=_FIBRES,
    source="DIN 22101 and CEMA: transition lengths and radii of curves; derived from lengths of fibres",
)

PRESSED: Check[Conveyor, Run] = Check(
    code="CNV115",
    title="minimum belt fibre tension",
    question="Do edge and centre stay in tension in transitions and curves?",
    failure="belt edge or centre buckles",
    scenes=frozenset({Run}),
    loads=("fibre_tension_min",),
    sense=Sense.AT_LEAST,
    limit=_LEAST_LIMIT,
    needs=no_needs,
    blame=blames("transitions"),
    repair=no_repair,
    each=_least_checks,
    what="Every fibre of the belt stays in tension in every transition, convex curve, concave curve and horizontal"
    " curve. The criterion applies to every partial loading of the belt.",
    why="A fibre under compression folds. The centre buckles in a convex curve, the edges flutter in a concave curve,"
    " and load spills. The inner edge flutters in a horizontal curve.",
    formula=_FIBRES + "; k >= 0",
    source="DIN 22101 and CEMA: transition lengths and radii of curves; derived from lengths of fibres",
)

# -- hollows --------------------------------------------------------------------------------------------------------


def _lift_limit(spec: Conveyor, scene: ConveyorScene) -> Estimate:
    """Lift-off tension of the empty belt in each concave curve of the file.

        T = rho g R cos(delta),   delta the steeper slope of both sides

    **Range** a belt at standstill or at low speed, which is on the safe side; a curve longer than a few idler pitches.
    **Error** a belt without bending stiffness.
    **Source** `laws.vertical_curve.lift_off_tension`.
    """
    return Estimate.exact(min((_lift_off(spec, curve) for curve in spec.route.hollows), default=math.inf))


def _lift_off(spec: Conveyor, curve: Curve) -> float:
    return value(
        vertical_curve.lift_off_tension, curve.radius, spec.belt.mass, 0.0, spec.gravity, curve.steepest_cosine
    )


def _lift_checks(spec: Conveyor, scene: ConveyorScene) -> Checks:
    for curve in spec.route.hollows:
        key = curve_key(curve)
        yield LIFT.of(str(curve.number), given(_lift_off(spec, curve)), key, repair=key)


LIFT: Check[Conveyor, ConveyorScene] = Check(
    code="CNV116",
    title="belt tension in concave curves",
    question="Does the empty belt stay on its idlers in every concave curve?",
    failure="belt lifts off its idlers in a concave curve",
    scenes=(IN_MOTION | {Run}) - {Jam},
    loads=("tension_curve_max",),
    sense=Sense.AT_MOST,
    limit=_lift_limit,
    needs=no_needs,
    blame=blames("route"),
    repair=no_repair,
    each=_lift_checks,
    what="The empty belt stays on its idlers in every concave curve: its tension there is at most the lift-off"
    " tension. In steady running, the criterion applies to every partial loading of the belt. Every scene of the"
    " file is verified with its own tension in the curve.",
    why="A belt that lifts off drops its load next to the conveyor, or comes down next to its idlers.",
    formula="S_max in the curve <= rho_belt g R cos(delta)",
    source="DIN 22101 and CEMA, concave vertical curves; derived from the equilibrium of an element",
)
