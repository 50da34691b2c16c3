"""What of a chain drive people look at: the polygon effect over the speed, speeds to avoid, starts and stops."""

from collections.abc import Iterator

from ptmcalc.base.units import SPEED
from ptmcalc.contract.figure import Band, Course, Figure, Marks, Moment, Spot
from ptmcalc.contract.report import SceneReport
from ptmcalc.contract.result import of
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive
from ptmcalc.machines.chain_drive.polygon.resonances import operating_range

_MOMENTS = (("start_time", "full speed of the rigid chain"), ("stop_time", "at rest"))


def _speeds(spec: ChainDrive, scene: SceneReport) -> Marks:
    """The speed of the file, and between the safe ranges what resonances take."""
    loads = {load.info.name: load.estimate.value for load in scene.loads}
    polygon = loads.get("tension_dynamic_polygon")
    spots = (Spot(spec.speed, polygon, "operating point"),) if polygon is not None else ()
    return Marks(tuple(_between(spec, loads)), moments=(Moment(spec.speed, "speed of the file"),), spots=spots)


def _between(spec: ChainDrive, loads: dict[str, float]) -> Iterator[Band]:
    """The gaps between the safe ranges of the operating range; none where nobody looked for these."""
    if "resonance_distance" not in loads:
        return
    reached, highest = operating_range(spec)
    number = 1
    while (low := loads.get(of("safe_window_low", str(number)))) is not None:
        if low > reached:
            yield Band(reached, low, "near a resonance")
        reached = loads[of("safe_window_high", str(number))]
        number += 1
    if reached < highest:
        yield Band(reached, highest, "near a resonance")


FIGURES = (
    Figure(
        "polygon_over_speed",
        "Polygon effect over the speed, with the resonance ranges to be avoided",
        ("run",),
        (Course("tension_dynamic_polygon"),),
        "polygon tension",
        over=SPEED,
        across="chain speed",
        marks=_speeds,
    ),
    Figure(
        "start_tension",
        "Tension of the chain over time",
        ("start", "stop", "emergency_stop", "coast"),
        (
            Course("tension_start", title="entering tension at the drive"),
            Course("tension_min", title="tension at the position of the minimum"),
        ),
        "tension",
        moments=_MOMENTS,
    ),
    Figure(
        "speed",
        "Speed of the chain over time",
        ("start", "stop", "emergency_stop", "coast"),
        (Course("start_time", title="speed of the rigid chain"), Course("stop_time", title="speed of the rigid chain")),
        "speed",
        moments=_MOMENTS,
    ),
)
