"""Safety of the belt against its breaking force: what is asked, and which keys say it."""

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.machines.conveyor.machine.scenes import ConveyorScene, Run
from ptmcalc.machines.conveyor.machine.spec import Conveyor

_SAFETY = {
    ("textile", True): 8.0,
    ("textile", False): 5.4,
    ("steel_cord", True): 6.7,
    ("steel_cord", False): 4.8,
}
"""Required safety factor of the belt by carcass and by steady running [1], DIN 22101:1982-02 as quoted by belt makers;
the edition of 2011 computes it. A larger value requires a stronger belt."""


def safety_limit(spec: Conveyor, scene: ConveyorScene) -> Estimate:
    """Safety factor of the file, or the usual one of the carcass: textile 8.0 running and 5.4 starting, steel cord 6.7
    and 4.8.

    **Range** vulcanised splices, normal conditions.
    **Error** none: a chosen limit.
    **Source** DIN 22101:1982-02 as quoted by belt makers (superseded; the edition of 2011 computes the limit from
    splice and life); to be compared with the edition in force.
    """
    checks = spec.checks
    asked = checks.belt_safety_running if isinstance(scene, Run) else checks.belt_safety_starting
    usual = _SAFETY[spec.belt.carcass or "textile", isinstance(scene, Run)]
    return Estimate.exact(asked if asked is not None else usual)


def safety_needs(spec: Conveyor, scene: ConveyorScene) -> tuple[KeyPath, ...]:
    """Keys without which the safety or its limit is not known."""
    key = "breaking_force" if spec.belt.strength is None and spec.belt.width is None else "strength"
    strength: KeyPath = ("belt", "breaking_force") if spec.belt.breaking_force is not None else ("belt", key)
    asked = spec.checks.belt_safety_running if isinstance(scene, Run) else spec.checks.belt_safety_starting
    return (strength,) if asked is not None else (strength, ("belt", "carcass"))


def strength_key(spec: Conveyor, scene: ConveyorScene) -> KeyPath:
    """Where the strength of the belt stands in the file."""
    return ("belt", "strength" if spec.belt.strength is not None else "breaking_force")
