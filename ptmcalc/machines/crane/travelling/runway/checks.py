"""Checks of the actions on the runway."""

from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import Check, LimitState, Sense, no_needs
from ptmcalc.contract.limits import fixed
from ptmcalc.laws.skew import LARGEST_ANGLE
from ptmcalc.machines.crane.travelling.machine.judging import OneCheck
from ptmcalc.machines.crane.travelling.machine.scenes import Runway, TravelScene
from ptmcalc.machines.crane.travelling.machine.spec import Travelling


def _angle_key(spec: Travelling) -> KeyPath:
    given, guide = spec.runway, spec.guide
    if given is not None and given.skew_angle is not None:
        return ("runway", "skew_angle")
    worn = guide is not None and guide.wear is not None and guide.wear > guide.clearance
    return ("guide", "wear" if worn else "clearance")


def _end_key(spec: Travelling) -> KeyPath:
    """The end of the trolley that is farther towards, or beyond, its rail."""
    near, far = spec.trolley.nearest, spec.trolley.farthest
    outer = near is not None and far is not None and spec.gauge - far < near
    return ("trolley", "farthest" if outer else "nearest")


def _angle_needs(spec: Travelling, scene: TravelScene) -> tuple[KeyPath, ...]:
    return () if spec.guide is not None else (("runway", "skew_angle"),)


def _angle_repair(spec: Travelling, scene: TravelScene) -> KeyPath:
    path = _angle_key(spec)
    return path if path[0] == "guide" else ()


ANGLE: OneCheck = Check(
    code="CRN176",
    title="skewing angle, EN 1991-3",
    question="Is the skewing angle within the maximum of the standard?",
    failure="skewing angle exceeds the maximum of EN 1991-3",
    scenes=frozenset({Runway}),
    loads=("runway_skew_angle",),
    sense=Sense.AT_MOST,
    limit=fixed(
        LARGEST_ANGLE,
        meaning="0.015 rad: the maximum skewing angle of a crane",
        valid="bridge and gantry cranes on two rails",
        error="none: a limit of the standard",
        source="EN 1991-3:2006, 2.7.4",
    ),
    needs=_angle_needs,
    blame=lambda spec, scene, loads: _angle_key(spec),
    repair=_angle_repair,
    what="The skewing angle by clearance, wear and tolerances of the guide, or that of the file, is at most 0.015 rad.",
    why="The formula of the skewing forces is not valid beyond this angle. The crane wears and leaves its rails.",
    formula="alpha = 0.75 x/a_e + y/a_e + alpha_t <= 0.015",
    source="EN 1991-3:2006, 2.7.4",
)

UPLIFT: OneCheck = Check(
    code="CRN177",
    hazard=True,
    title="smallest wheel load, EN 1991-3",
    question="Are all wheel loads on the runway compressive in every group of loads?",
    failure="wheel lifts off the runway",
    limit_state=LimitState("wheel lifts off the runway", 0),
    scenes=frozenset({Runway}),
    loads=("runway_wheel_least",),
    sense=Sense.AT_LEAST,
    limit=fixed(
        0.0,
        meaning="0: the wheel stays on its rail",
        valid="any crane",
        error="none: a wheel transmits no tension",
        source="equilibrium",
    ),
    needs=no_needs,
    blame=lambda spec, scene, loads: _end_key(spec),
    repair=lambda spec, scene: _end_key(spec),
    what="The smallest wheel load of all groups of loads, loaded and unloaded, with their dynamic factors, is at least"
    " zero.",
    why="The formulas of the standard are not valid for a wheel that lifts off. The crane may tip.",
    formula="Q_min >= 0,   Q_(max) >= 0",
    source="equilibrium; EN 1991-3:2006, 2.6",
)

CHECKS_OF_RUNWAY: tuple[OneCheck, ...] = (ANGLE, UPLIFT)
