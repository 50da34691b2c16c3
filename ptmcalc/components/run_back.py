"""A loaded belt or chain that nothing keeps from running back."""

from ptmcalc.base import units
from ptmcalc.contract.result import Failure


def runs_back(check: str, what: str, torque: float, reserve: float) -> Failure:
    """The failure of a machine without backstop and brake, and the backstop that holds its torque with a reserve."""
    pulls, holds = (units.show(value, units.TORQUE, 3) for value in (torque, 1.005 * reserve * torque))
    message = f"loaded {what} runs back with {pulls}: neither a backstop nor a brake holds it"
    return Failure(check, message, ("backstop",), f"add `backstop: {{torque: {holds}}}`")
