"""Useful load of a main shaft over the angle: sectors, a table, or a force at the tool of a slider-crank."""

import numpy as np

from ptmcalc.laws import slider_crank
from ptmcalc.machines.shaft.machine.mechanism import SAME_ANGLE, FloatArray, OverAngle, linkage_of
from ptmcalc.machines.shaft.machine.spec import FULL_TURN, SectorLoad, Shaft, SliderCrank, TableLoad, ToolLoad


def useful_load(spec: Shaft) -> tuple[OverAngle | None, list[float]]:
    """Torque of the useful load over the angle, None without one, and the angles at which it is not smooth."""
    given = spec.load
    if given is None:
        return None, []
    if isinstance(given, SectorLoad):
        return _sectors(given, spec.cycle_angle)
    if isinstance(given, TableLoad):
        return _table(given, spec.cycle_angle)
    assert isinstance(spec.inertia, SliderCrank)
    return _tool(given, spec.inertia, max(round(spec.cycle_angle / FULL_TURN), 1))


def _sectors(load: SectorLoad, period: float) -> tuple[OverAngle, list[float]]:
    spans = []
    for sector in load.sectors:
        start = sector.start % period
        end = start + (sector.to - sector.start)
        spans += [(start, min(end, period), sector.torque), (0.0, end - period, sector.torque)]
    spans = [span for span in spans if span[1] > span[0]]
    edges = sorted({0.0, *(edge for low, high, _ in spans for edge in (low, high) if edge < period)})
    levels = np.array([sum(torque for low, high, torque in spans if low <= edge < high) for edge in edges])
    corners = np.array(edges)
    return lambda angle: levels[np.searchsorted(corners, angle % period, side="right") - 1], edges


def _table(load: TableLoad, period: float) -> tuple[OverAngle, list[float]]:
    angles, torques = [p.angle for p in load.points], [p.torque for p in load.points]
    return lambda angle: np.interp(angle, angles, torques, period=period), angles


def _tool(load: ToolLoad, crank: SliderCrank, turns: int) -> tuple[OverAngle, list[float]]:
    """Force times the arm dx/dphi, on the strokes in which it acts."""
    shape = crank.crank_radius, crank.rod_length, crank.offset
    linkage = linkage_of(crank)
    far = load.dead_centre == "far"
    centre, at = slider_crank.dead_centre(*shape, far)
    _, other = slider_crank.dead_centre(*shape, not far)
    outward = 1.0 if far else -1.0
    distances, forces = [p.distance for p in load.points], [p.force for p in load.points]
    end, start = distances[-1], distances[0]

    def torque(angle: FloatArray) -> FloatArray:
        position = linkage.at(angle)
        distance, arm = outward * (centre - position.along(1.0)), position.along_slope(1.0)
        slack = SAME_ANGLE * crank.crank_radius
        acts = (distance >= start - slack) & (distance <= end + slack)
        if load.stroke != "both":
            acts &= outward * arm > 0 if load.stroke == "approach" else outward * arm < 0
        return np.where(acts, np.interp(distance, distances, forces), 0.0) * np.abs(arm)

    breaks = [at, other]
    for distance in distances:
        breaks += slider_crank.crank_angles(centre - outward * distance, *shape)
    return torque, [angle + turn * FULL_TURN for angle in breaks for turn in range(turns)]
