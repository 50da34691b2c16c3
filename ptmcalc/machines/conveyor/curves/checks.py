"""Checks of horizontal curves: the drift of the belt on its idlers, to the inner and to the outer side."""

from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import partial

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import AnyCheck, Check, Sense, blames, no_needs, no_repair
from ptmcalc.contract.limits import key
from ptmcalc.contract.result import of
from ptmcalc.laws import horizontal_curve
from ptmcalc.machines.conveyor.curves.loads import LEAST, MOST, STRANDS, loads_on, states
from ptmcalc.machines.conveyor.machine.keys.route import Bend
from ptmcalc.machines.conveyor.machine.resistances import filled
from ptmcalc.machines.conveyor.machine.scenes import IN_MOTION, ConveyorScene, Jam, Run
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.running.checks_belt import bend_key

Loads = Mapping[str, Estimate]

_DRIFT_KEY: KeyPath = ("checks", "belt_drift")
_WIDTH: KeyPath = ("belt", "width")


_LIMIT = key(
    "checks.belt_drift",
    meaning="Distance from the edge of the belt to the end of the wing roll; by default 5 % of the belt width and"
    " 25 mm",
    valid="idlers with rolls of the standard lengths; side rolls that hold the belt at its edge are left out",
    error="of the default 20 %, tried at both ends",
    source="free edge of the usable width 0.9 B - 50 mm of ISO 5048:1989; wing rolls of ISO 1537 (380 mm for B ="
    " 1000 mm, 465 mm for 1200 mm) are longer than the belt on them by that within 15 %",
)


def _drift(spec: Conveyor, bend: Bend, strand: str, load: float, tension: float, speed: float, rule: str) -> float:
    """Drift of one strand at a tension, positive inward [m]; the load is per length [kg/m]."""
    row = spec.idlers.carry if strand == "carry" else spec.idlers.back
    trough = row.trough
    assert trough is not None
    weight = spec.gravity * bend.cosine
    return horizontal_curve.drift(
        filled(spec.belt.width),
        trough.middle_roll,
        trough.angle,
        bend.banking(strand),
        spec.belt.mass * weight,
        load * weight,
        load / filled(spec.load.density) if load else 0.0,
        filled(spec.load.surcharge_angle) if load else 0.0,
        horizontal_curve.inward_force(tension, spec.belt.mass, speed, bend.curve.radius),
        load * speed**2 / bend.curve.radius,
        rule,
    )


def _worst(spec: Conveyor, scene: ConveyorScene, loads: Loads, bend: Bend, strand: str, side: int) -> Estimate:
    """Largest drift of a strand to one side, 1 inward and -1 outward [m]; its interval spans the rules, the interval of
    the tension and, of a start or a stop, the belt at standstill and at rated speed."""
    slow = spec.speed if isinstance(scene, Run) else 0.0
    found = []
    every = [
        (state, load) for state in states(spec, bend, strand, scene) for load in loads_on(spec, bend, state, scene)
    ]
    for state, load in every:
        tension = loads[of(MOST if side > 0 else LEAST, state)]
        speeds = (slow, spec.speed) if side > 0 else (spec.speed, slow)

        def at(pull: float, speed: float, rule: str, load: float = load) -> float:
            return side * _drift(spec, bend, strand, load, pull, speed, rule)

        rules = horizontal_curve.RULES
        value = at(tension.value, speeds[0], rules[0])
        far, near = (tension.high, tension.low) if side > 0 else (tension.low, tension.high)
        low, high = min(at(near, speeds[1], one) for one in rules), max(at(far, speeds[0], one) for one in rules)
        error = tension.numerical
        ends = [at(tension.value + sign * error, speeds[0], rules[0]) for sign in (-1, 1)] if error else [value]
        numerical = max(abs(end - value) for end in ends)
        found.append(Estimate(value, min(low, value), max(high, value), numerical, max(high - value, value - low)))
    value, low, high = (max(getattr(one, end) for one in found) for end in ("value", "low", "high"))
    return Estimate(value, low, high, max(one.numerical for one in found), max(one.model for one in found))


def _inward(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> Estimate:
    """Largest drift to the inner side, of the largest tension in the curve.

        F(y) = (S_max - rho v^2)/R

    F is the force of the weight of belt and load on the banked and troughed rolls (`laws.horizontal_curve`). In steady
    running the curve is loaded or empty, and all other sections are as they are worst. In a start or a stop the belt
    takes the drift of its largest tension at once, at standstill, which is on the safe side.

    **Range** belts that only their idlers guide; rolls square to the belt.
    **Error** the interval spans three rules of the balance, from the ribbon to Grimmer and Kessler, part I.
    **Source** K.-J. Grimmer and F. Kessler (1987), part II; `laws.horizontal_curve`.
    """
    return _all(spec, scene, loads, 1)


def _outward(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> Estimate:
    """Largest drift to the outer side, of the least tension in the curve.

        F(-y) = (S_min - rho v^2)/R

    F as for the drift inward; in a start or a stop at rated speed, which is on the safe side.

    **Range** belts that only their idlers guide; rolls square to the belt.
    **Error** the interval spans three rules of the balance, from the ribbon to Grimmer and Kessler, part I.
    **Source** K.-J. Grimmer and F. Kessler (1987), part II; `laws.horizontal_curve`.
    """
    return _all(spec, scene, loads, -1)


def _all(spec: Conveyor, scene: ConveyorScene, loads: Loads, side: int) -> Estimate:
    places = [(bend, strand) for bend in spec.route.bends for strand in STRANDS]
    return max((_worst(spec, scene, loads, *place, side) for place in places), key=lambda one: one.high)


def _needs(spec: Conveyor, scene: ConveyorScene, bend: Bend, strand: str) -> tuple[KeyPath, ...]:
    """Keys without which the drift is not known."""
    loaded = any(state.endswith("full") for state in states(spec, bend, strand, scene))
    density: tuple[KeyPath, ...] = (("load", "density"),) if loaded else ()
    return (_WIDTH, ("idlers", strand, "trough"), *density)


def _sides(check: AnyCheck, side: int, key: str) -> AnyCheck:
    """A check with one part for each strand of each curve; `key` of the curve governs it."""

    def each(spec: Conveyor, scene: ConveyorScene) -> Iterable[AnyCheck]:
        for bend in spec.route.bends:
            for strand in STRANDS:
                governs = bend_key(bend, key if key == "radius" or strand == "carry" else f"{key}_return")
                part = check.of(f"{bend.number}_{strand}", _LIMIT, governs, _needs(spec, scene, bend, strand), governs)
                names = (of(MOST if side > 0 else LEAST, state) for state in states(spec, bend, strand, scene))
                value = partial(_worst, bend=bend, strand=strand, side=side)
                yield replace(part, loads=tuple(names), value=value)

    return replace(check, each=each)


_SCENES = (IN_MOTION | {Run}) - {Jam}
_BALANCE = (
    "F(y) = (S - rho v^2)/R - rho_load v^2/R,\n"
    "F(y) = g cos(delta) (m_i(y) sin(lambda + beta) + m_m(y) sin(beta) - m_o(y) sin(lambda - beta))"
)
_SOURCE = (
    "K.-J. Grimmer and F. Kessler, Spezielle Betrachtungen zur Gurtfuehrung bei Gurtfoerderern mit Horizontalkurven"
    " (1987), parts I and II, as restated in the public library eytelwein; derived in `laws.horizontal_curve`"
)

INWARD: AnyCheck = _sides(
    Check(
        code="CNV150",
        hazard=True,
        title="belt drift to the inner side of horizontal curves",
        question="Does the belt stay on its idlers in horizontal curves where its tension is largest?",
        failure="belt drifts off its idlers to the inner side of the curve",
        scenes=frozenset(_SCENES),
        loads=(MOST,),
        sense=Sense.AT_MOST,
        limit=_LIMIT,
        needs=no_needs,
        value=_inward,
        blame=blames("route", "sections"),
        repair=no_repair,
        quantity=units.LENGTH,
        what="The belt drifts inward in a horizontal curve by at most the distance from its edge to the end of the wing"
        " roll. The weight of belt and load on the banked and troughed idlers balances the inward pull of the tension."
        " Steady running covers the loaded and the empty curve with every partial loading of the rest of the belt;"
        " every start and stop is verified with its own largest tension in the curve.",
        why="A belt that leaves its idlers rubs on the frame, tears its edge and spills the load.",
        formula=_BALANCE + ",   S = S_max,   y <= limit",
        source=_SOURCE,
    ),
    1,
    "radius",
)

OUTWARD: AnyCheck = _sides(
    Check(
        code="CNV151",
        hazard=True,
        title="belt drift to the outer side of horizontal curves",
        question="Does the belt stay on its idlers in horizontal curves where its tension is smallest?",
        failure="belt drifts off its idlers to the outer side of the curve",
        scenes=frozenset(_SCENES),
        loads=(LEAST,),
        sense=Sense.AT_MOST,
        limit=_LIMIT,
        needs=no_needs,
        value=_outward,
        blame=blames("route", "sections"),
        repair=no_repair,
        quantity=units.LENGTH,
        what="The belt drifts outward in a horizontal curve by at most the distance from its edge to the end of the"
        " wing roll. Banking and centrifugal force move it outward where its tension is small, most of all when it is"
        " loaded. Scenes as for the drift inward, with their least tension in the curve.",
        why="A curve that is banked for the largest tension lets the belt drift outward where the tension is small.",
        formula=_BALANCE + ",   S = S_min,   -y <= limit",
        source=_SOURCE,
    ),
    -1,
    "banking",
)
