"""Polygon effect: dynamic tension and resonance."""

from collections.abc import Iterator

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo
from ptmcalc.contract.topic import Topic
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive
from ptmcalc.machines.chain_drive.polygon.bound import POLYGON_BOUND
from ptmcalc.machines.chain_drive.polygon.chain_modes import CHAIN_MODES, FREQUENCIES, ORDERS, WINDOWS
from ptmcalc.machines.chain_drive.polygon.checks import DYNAMIC_SAFETY, FATIGUE, PRESSURE, RESONANCE, SLACK
from ptmcalc.machines.chain_drive.polygon.distributed_strand import DISTRIBUTED_STRAND
from ptmcalc.machines.chain_drive.polygon.effects import EFFECTS
from ptmcalc.machines.chain_drive.polygon.textbook import CHAIN_TEXTBOOK

LOADS = (
    LoadInfo("tension_polygon_bound", "polygon-effect tension, upper bound", units.FORCE, headline=False),
    LoadInfo("tension_dynamic_polygon", "polygon-effect tension, maximum", units.FORCE, governing=True),
    LoadInfo("tension_dynamic_polygon_min", "polygon-effect tension, minimum", units.FORCE),
    LoadInfo("tension_dynamic_polygon_far", "polygon-effect tension at far end, maximum", units.FORCE, headline=False),
    LoadInfo("natural_frequency", "longitudinal natural frequency", units.ANGULAR_FREQUENCY, headline=False),
    LoadInfo("resonance_speed", "resonance speed (harmonic, mode)", units.SPEED, headline=False),
    LoadInfo("resonance_speed_first", "resonance speed, first mode", units.SPEED),
    LoadInfo("frequency_ratio", "tooth / first natural frequency", units.RATIO, governing=True),
    LoadInfo("resonance_distance", "separation from nearest resonance", units.SHARE, governing=True),
    LoadInfo("safe_speed_below", "next safe speed below", units.SPEED),
    LoadInfo("safe_speed_above", "next safe speed above", units.SPEED),
    LoadInfo("resonance_factor_textbook", "textbook resonance factor K", units.RATIO, headline=False),
    LoadInfo("safe_window_low", "safe speed range, lower end", units.SPEED, headline=False),
    LoadInfo("safe_window_high", "safe speed range, upper end", units.SPEED, headline=False),
)


def parts(spec: ChainDrive) -> Iterator[LoadInfo]:
    """The loads of one chain drive; `resonance_speed[n,k]` of the harmonic n with the mode k."""
    for info in LOADS:
        if info.name == "natural_frequency":
            yield from (info.of(str(mode)) for mode in range(1, FREQUENCIES + 1))
        elif info.name == "resonance_speed":
            yield from (
                info.of(f"{order},{mode}") for order in range(1, ORDERS + 1) for mode in range(1, FREQUENCIES + 1)
            )
        elif info.name in ("safe_window_low", "safe_window_high"):
            yield from (info.of(str(window)) for window in range(1, WINDOWS + 1))
        else:
            yield info


POLYGON: Topic[ChainDrive] = Topic(
    loads=LOADS,
    parts=parts,
    effects=EFFECTS,
    solvers=(CHAIN_TEXTBOOK, CHAIN_MODES, POLYGON_BOUND, DISTRIBUTED_STRAND),
    checks=(RESONANCE, DYNAMIC_SAFETY, PRESSURE, SLACK, FATIGUE),
)
