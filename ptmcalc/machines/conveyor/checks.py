"""The checks of a conveyor."""

import math
from collections.abc import Mapping

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import Check, Sense
from ptmcalc.machines.conveyor.model import belt_line, starting_force
from ptmcalc.machines.conveyor.spec import Conveyor, ConveyorScene, Run, Start

Loads = Mapping[str, Estimate]

_LEAST_WRAP = 2.8  # rad, 160 deg
_LEAST_GRIP = 0.6931471805599453  # mu alpha = ln 2: below it the drum transmits less than the run-off tension
_NO_RESERVE = math.nextafter(1, 0)  # just below any k_T
_STRONG_START = 1.5  # starting force over static resistance: the usual upper end of practice

_SAFETY = {
    ("textile", Run): 8.0,
    ("textile", Start): 5.4,
    ("steel_cord", Run): 6.7,
    ("steel_cord", Start): 4.8,
}

_TENSION: KeyPath = ("takeup", "tension")


def _no_needs(spec: Conveyor, scene: ConveyorScene) -> tuple[KeyPath, ...]:
    return ()


def _takeup_tension(spec: Conveyor, scene: ConveyorScene) -> KeyPath:
    return _TENSION


def _blame_tension(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> KeyPath:
    return _TENSION


# -- belt slip -----------------------------------------------------------------------------------------------------


def _slip_limit(spec: Conveyor, scene: ConveyorScene) -> Estimate:
    """k_T of the file.

    **Range** at least 1.
    **Error** none: a chosen limit.
    **Source** lecture notes Kramatorsk 2007: 1.1 to 1.5; 1.2 is the usual value of handbooks.
    """
    return Estimate.exact(spec.checks.slip.reserve)


def _slip_value(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> Estimate:
    """The reserve of grip by the definition of the file: of force, or of the ratio of tensions (1/U).

    The reserve of force leaves out the centrifugal tension; a belt at U = 1 slips whatever it says, and has none.

    **Range** any state of the drum; infinite where it transmits nothing.
    **Error** that of the load.
    **Source** `laws.capstan`.
    """
    used = loads["slip_utilisation_max"]
    if spec.checks.slip.definition == "force":
        left = loads["slip_reserve_min"]
        value, low, high = (
            min(reserve, _NO_RESERVE) if state >= 1 else reserve
            for reserve, state in ((left.value, used.value), (left.low, used.high), (left.high, used.low))
        )
        return Estimate(value, low, high, left.numerical, left.model)
    value, low, high = (_inverse(part) for part in (used.value, used.high, used.low))
    return Estimate(value, low, high, used.numerical / used.value**2, used.model / used.value**2)


def _inverse(value: float) -> float:
    return 1 / value if value > 0 else float("inf")


def _blame_slip(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> KeyPath:
    """The key that stands out: a small wrap, a poor friction, a violent start; else the take-up tension."""
    drum = spec.drive.drum
    line = belt_line(spec, scene)
    if drum.wrap < _LEAST_WRAP:
        return ("drive", "drum", "wrap")
    if line.grip_exponent is not None and line.grip_exponent < _LEAST_GRIP:
        return ("drive", "drum", "friction")
    if isinstance(scene, Start) and starting_force(spec) > _STRONG_START * max(line.static_resistance, 0):
        return _TENSION if scene.profile.imposes_speed else starting_torque_key(spec)
    return _TENSION


def starting_torque_key(spec: Conveyor) -> KeyPath:
    """The key of the starting torque the file uses."""
    one = spec.drive.motor
    key = "mean_starting_torque" if one.mean_starting_torque is not None else "largest_starting_torque"
    return ("drive", "motor", key)


SLIP: Check[Conveyor, ConveyorScene] = Check(
    code="CNV101",
    title="belt slip at the drive drum",
    scenes=frozenset({Run, Start}),
    loads=("slip_reserve_min", "slip_utilisation_max"),
    value=_slip_value,
    sense=Sense.AT_LEAST,
    limit=_slip_limit,
    needs=lambda spec, scene: (("drive", "drum", "friction"),),
    blame=_blame_slip,
    repair=_takeup_tension,
    what="The grip of the drum exceeds what it must transmit by the reserve k_T, at every moment and in both senses.",
    why="A belt that slips on the drum wears the lagging, overheats and can burn; it does not recover by itself.",
    formula="k = S_slack (exp(mu alpha) - 1)/(S_tight - S_slack) >= k_T, and U < 1   (definition `force`)\n"
    "1/U >= k_T,  U = (S_tight - rho_B v^2)/((S_slack - rho_B v^2) exp(mu alpha))   (definition `ratio`)",
    source="Euler-Eytelwein; k_T 1.1 to 1.5, lecture notes Kramatorsk 2007; 1.2 in handbooks",
)

# -- belt strength --------------------------------------------------------------------------------------------------


def _safety_limit(spec: Conveyor, scene: ConveyorScene) -> Estimate:
    """Safety the file asks, or the one usual for its carcass: textile 8.0 running and 5.4 starting, steel cord 6.7
    and 4.8.

    **Range** vulcanised splices, normal conditions.
    **Error** none: a chosen limit.
    **Source** DIN 22101:1982-02 as quoted by belt makers (superseded; the edition of 2011 computes the limit from
    splice and life); to be compared with the edition in force.
    """
    checks = spec.checks
    asked = checks.belt_safety_running if isinstance(scene, Run) else checks.belt_safety_starting
    return Estimate.exact(asked if asked is not None else _SAFETY[spec.belt.carcass or "textile", type(scene)])


def _safety_needs(spec: Conveyor, scene: ConveyorScene) -> tuple[KeyPath, ...]:
    key = "breaking_force" if spec.belt.strength is None and spec.belt.width is None else "strength"
    strength: KeyPath = ("belt", "breaking_force") if spec.belt.breaking_force is not None else ("belt", key)
    asked = spec.checks.belt_safety_running if isinstance(scene, Run) else spec.checks.belt_safety_starting
    return (strength,) if asked is not None else (strength, ("belt", "carcass"))


def _strength_key(spec: Conveyor, scene: ConveyorScene) -> KeyPath:
    return ("belt", "strength" if spec.belt.strength is not None else "breaking_force")


STRENGTH: Check[Conveyor, ConveyorScene] = Check(
    code="CNV102",
    title="too little belt strength",
    scenes=frozenset({Run, Start}),
    loads=("belt_safety_min",),
    sense=Sense.AT_LEAST,
    limit=_safety_limit,
    needs=_safety_needs,
    blame=lambda spec, scene, loads: _strength_key(spec, scene),
    repair=_strength_key,
    what="The belt's breaking force exceeds the largest tension of any section by the safety factor.",
    why="A belt that breaks runs off the conveyor; splices fail first and by fatigue.",
    formula="breaking force / S_max >= safety",
    source="DIN 22101:1982-02 as quoted by belt makers: 8.0/5.4 textile, 6.7/4.8 steel cord (running/starting)",
)

# -- sag ------------------------------------------------------------------------------------------------------------


def _sag_limit(spec: Conveyor, scene: Run) -> Estimate:
    """Largest sag over idler pitch of the file, 1 % by default.

    **Range** steady running; more is allowed for a moment.
    **Error** none: a chosen limit.
    **Source** DIN 22101: at most 1 % in steady running.
    """
    return Estimate.exact(spec.checks.sag)


def _idler_pitches(spec: Conveyor, scene: ConveyorScene) -> tuple[KeyPath, ...]:
    return (("idlers", "carry", "pitch"), ("idlers", "return", "pitch"))


SAG: Check[Conveyor, Run] = Check(
    code="CNV103",
    title="too much sag between the idlers",
    scenes=frozenset({Run}),
    loads=("sag_relative_max",),
    sense=Sense.AT_MOST,
    limit=_sag_limit,
    needs=_idler_pitches,
    blame=_blame_tension,
    repair=_takeup_tension,
    what="The belt sags no more than the limit between any two idlers in steady running.",
    why="A sagging belt spills its load, flexes it at every idler and costs power.",
    formula="w l/(8 S_min) <= limit",
    source="DIN 22101: at most 1 % in steady running",
)

# -- start ----------------------------------------------------------------------------------------------------------


def _start_limit(spec: Conveyor, scene: Start) -> Estimate:
    """The starting force must reach the force needed.

    **Range** any start.
    **Error** none.
    **Source** Newton's law.
    """
    return Estimate.exact(1.0)


START: Check[Conveyor, Start] = Check(
    code="CNV104",
    title="a drive too weak to start",
    scenes=frozenset({Start}),
    loads=("starting_reserve",),
    sense=Sense.AT_LEAST,
    limit=_start_limit,
    needs=_no_needs,
    blame=lambda spec, scene, loads: starting_torque_key(spec),
    repair=lambda spec, scene: starting_torque_key(spec),
    what="The mean starting force at the rim exceeds the static resistance (torque) or what the profile asks (speed).",
    why="A drive that cannot move the belt stalls, and its motors overheat.",
    formula="n M i eta/R > W   (torque)      n M i eta/R >= max(m a + S_on - S_off)   (imposed speed)",
    source="lecture notes Kramatorsk 2007",
)

# -- slack ----------------------------------------------------------------------------------------------------------


def _slack_limit(spec: Conveyor, scene: ConveyorScene) -> Estimate:
    """Nothing may be missing to the tension at which the belt counts as slack.

    **Range** with idler pitches given: 10 % sag by default, where the parabola ends; else no tension at all.
    **Error** none: a chosen limit.
    **Source** validity of the shallow parabola (`laws.sag.sag_ratio`), an engineering choice.
    """
    return Estimate.exact(0.0)


SLACK: Check[Conveyor, ConveyorScene] = Check(
    code="CNV105",
    title="a slack belt",
    scenes=frozenset({Run, Start}),
    loads=("slack_margin_min",),
    sense=Sense.AT_LEAST,
    limit=_slack_limit,
    needs=_no_needs,
    blame=_blame_tension,
    repair=_takeup_tension,
    what="Every section keeps more tension than a slack belt, at every moment.",
    why="A slack belt lifts off its idlers, folds, runs off, and snatches when it comes taut again.",
    formula="S_min - w l/(8 h_slack) >= 0 on either strand   (h_slack 10 %; without idler pitches S_min >= 0)",
    source="shallow parabola; slack as the end of the linear belt, lecture notes Kramatorsk 2007",
)

CHECKS = (SLIP, STRENGTH, SAG, START, SLACK)
