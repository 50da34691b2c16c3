"""What a measured run-out of a machine tells, and what it cannot tell."""

from collections.abc import Sequence

from ptmcalc.base import units
from ptmcalc.contract.result import Finding
from ptmcalc.spec.scene import Scene


def too_long_a_way(scenes: Sequence[Scene], scene: Scene, way: float, coefficient: float) -> tuple[Finding, ...]:
    """A coefficient below 0: the climbing load alone stops the machine sooner than that."""
    if coefficient >= 0:
        return ()
    return (
        Finding(
            "SPC201",
            f"without friction it would stop within less than the measured {units.show(way, units.LENGTH)}: the"
            " coefficient identified from it is negative",
            ("scenes", list(scenes).index(scene), "measured_distance"),
            "correct `measured_distance`, the speed, the load or the lift",
        ),
    )
