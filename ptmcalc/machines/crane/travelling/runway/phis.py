"""Dynamic factors of the actions on the runway: given, or computed by the laws of the other topics."""

from ptmcalc.laws import standard_factors
from ptmcalc.machines.crane.travelling.machine.keys.actions import Actions
from ptmcalc.machines.crane.travelling.machine.model import filled
from ptmcalc.machines.crane.travelling.machine.scenes import RailStep
from ptmcalc.machines.crane.travelling.machine.spec import Travelling
from ptmcalc.machines.crane.travelling.rail import rail_response
from ptmcalc.machines.crane.travelling.runway.groups import DYNAMIC_TEST, ONE, REMAINING, STATIC_TEST
from ptmcalc.machines.crane.travelling.statics import factors

PHIS = ("phi1", "phi2", "phi3", "phi4", "phi5", "phi6", "phi7")


def of_actions(spec: Travelling, given: Actions) -> dict[str, float]:
    """Those of which the file has the data; phi7 where the file states it, since otherwise the impact gives it."""
    found = factors.of_the_structure(spec)
    own = {name: value for name in PHIS if (value := getattr(given, name)) is not None}
    if "phi2" in own:
        found["phi6"] = standard_factors.load_test_factors(own["phi2"])[0]
    if "phi4" not in own:
        found["phi4"] = _of_the_rail(spec)
    return found | own


def _of_the_rail(spec: Travelling) -> float:
    """phi4 of a rail with a step or gap; 1 within the tolerances of EN 1993-6."""
    if not spec.rail.step and not spec.rail.gap:
        return 1.0
    return rail_response.run(spec, RailStep(), frozenset(), 0).loads["phi4"].estimate.value


def of_group(spec: Travelling, name: str, known: dict[str, float]) -> float | None:
    """A factor by its name in `groups`; None where the file lacks its data."""
    dynamic, static = standard_factors.TEST_LOADS["en_13001_2"]
    if name == ONE:
        return 1.0
    if name == STATIC_TEST:
        return static
    if name == DYNAMIC_TEST:
        return dynamic * known["phi6"] if "phi6" in known else None
    if name == REMAINING:
        block = filled(spec.hook_block)
        return block / (block + spec.load)
    return known.get(name)
