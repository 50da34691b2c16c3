"""The loads of the scene `runway`."""

from collections.abc import Iterator

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo
from ptmcalc.machines.crane.travelling.machine.spec import Travelling
from ptmcalc.machines.crane.travelling.runway.groups import FRONT, GROUPS, LIGHT, LOADED, NAMES, PAIRS


def _force(name: str, title: str) -> LoadInfo:
    return LoadInfo(name, title, units.FORCE, headline=False)


WHEELS = (
    _force("runway_wheel_max", "Q_r,max, EN 1991-3, group"),
    _force("runway_wheel_max_other", "Q_r,(max), EN 1991-3, group"),
    _force("runway_wheel_min_other", "Q_r,(min), EN 1991-3, group"),
    _force("runway_wheel_min", "Q_r,min, EN 1991-3, group"),
)
DRIVES = (
    _force("runway_drive_force", "drive force K, EN 1991-3, group"),
    _force("runway_longitudinal", "H_L on each rail, EN 1991-3, group"),
    _force("runway_transverse_1", "H_T,1, EN 1991-3, group"),
    _force("runway_transverse_2", "H_T,2, EN 1991-3, group"),
)
TROLLEY = _force("runway_transverse_3", "H_T,3, EN 1991-3, group")
WIND = _force("runway_wind", "wind along the rails, EN 1991-3, group")
BUFFER = _force("runway_buffer", "H_B,1 on the rail of larger force, EN 1991-3, group")
TROLLEY_BUFFER = _force("runway_buffer_trolley", "H_B,2, EN 1991-3, group")
BY_GROUP = (*WHEELS, *DRIVES, TROLLEY, WIND, BUFFER, TROLLEY_BUFFER)
GUIDE = _force("runway_guide_force", "skewing force S, EN 1991-3, front guide on")
NET = _force("runway_skew_net", "S - H_S,1,T of a wheel with guiding flange, EN 1991-3, front guide on")
BY_PAIR = (
    _force("runway_skew_along", "H_S,L of a wheel pair, EN 1991-3, front guide on"),
    _force("runway_skew_across_1", "H_S,1,T of a wheel pair, EN 1991-3, front guide on"),
    _force("runway_skew_across_2", "H_S,2,T of a wheel pair, EN 1991-3, front guide on"),
    NET,
)
SINGLE = (
    LoadInfo("runway_wheel_least", "smallest wheel load, EN 1991-3, all groups", units.FORCE, governing=True),
    LoadInfo("runway_skew_angle", "skewing angle alpha, EN 1991-3", units.ANGLE, governing=True),
    LoadInfo("runway_skew_share", "skewing friction factor f, EN 1991-3", units.RATIO, headline=False),
    LoadInfo("runway_fatigue_normal", "fatigue wheel load Q_e, normal stress, EN 1991-3", units.FORCE),
    LoadInfo("runway_fatigue_shear", "fatigue wheel load Q_e, shear stress, EN 1991-3", units.FORCE),
)
OF_THE_RUNWAY = (*SINGLE, *BY_GROUP, GUIDE, *BY_PAIR)


def parts(spec: Travelling) -> Iterator[LoadInfo]:
    """The loads of a crane, group by group; none without a `runway`."""
    if spec.runway is None:
        return
    yield from SINGLE
    for info in BY_GROUP:
        yield from (info.of(name) for name in NAMES if _in(info, name))
    yield from (GUIDE.of(rail) for rail in (LIGHT, LOADED))
    for info in BY_PAIR:
        yield from (info.of(pair) for pair in PAIRS if info is not NET or pair in FRONT)


def _in(info: LoadInfo, name: str) -> bool:
    """Whether a group contains an action."""
    group = next(one for one in GROUPS if one.name == name)
    if info in DRIVES:
        return bool(group.drives)
    if info in WHEELS:
        return group.hoist is not None or info not in WHEELS[:2]
    return bool({TROLLEY: group.trolley, WIND: group.wind}.get(info, group.buffers))
