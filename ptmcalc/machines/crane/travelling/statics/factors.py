"""Dynamic factors of the crane standards that do not need a motion: phi1, phi2, phi3, phi5, phi6."""

from ptmcalc.laws import lift_off, lift_off_standard, standard_factors
from ptmcalc.machines.crane.travelling.machine.model import filled
from ptmcalc.machines.crane.travelling.machine.spec import Travelling

CREEPING = ("HD2", "HD3")
"""Drive classes whose load is lifted off the ground at the creep speed."""
_QUICKNESS = {"slow": 0.5, "quick": 1.0}
"""Factor beta_3 of a slow release (grab) and a quick one (magnet) [1], EN 13001-2 and ISO 8686-1. A larger value lowers
phi_3 = 1 - (dm/m) (1 + beta_3)."""


def of_the_structure(spec: Travelling) -> dict[str, float]:
    """Factors by class, those of which the file has the data."""
    given = spec.classes
    found = {"phi1": standard_factors.hoisting_factors(given.lifting_share)[1], "phi5": _drive_factor(spec)}
    speed = spec.suspension.hoist_speed
    if given.hoisting is not None and speed is not None:
        creep = spec.suspension.creep_speed if spec.suspension.creep_speed is not None else speed
        at = lift_off_standard.class_lift_off_speed(given.drive, lift_off_standard.REGULAR, speed, creep)
        phi2 = lift_off_standard.standard_lift_off_factor(given.hoisting, given.drive, at, given.edition)
        found["phi2"] = phi2
        found["phi6"] = standard_factors.load_test_factors(phi2)[0]
    share = given.released_share * spec.load / (spec.load + filled(spec.hook_block)) if given.release != "none" else 0.0
    found["phi3"] = float(lift_off.release_factor(share, _QUICKNESS.get(given.release, 0.0)))
    return found


def _drive_factor(spec: Travelling) -> float:
    """The larger end of the range of phi5; a drive that keeps to a ramp changes its force smoothly."""
    given = spec.classes
    smooth = spec.drive.ramp(spec.speed) is not None
    change = given.drive_change if given.drive_change is not None else "smooth" if smooth else "sudden"
    return standard_factors.drive_factor(change, given.play == "large")[1]
