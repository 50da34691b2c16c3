"""What the oscillation after the window of a scene can add to the loads of a hoist."""

import math
from dataclasses import replace

import numpy as np

from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.contract.result import Found
from ptmcalc.machines.hoist.motion.train import FLANK, GEARBOX, LEAST_LEFT, LOAD, ROPE, SHAFT, STRUCTURE, Case
from ptmcalc.numerics.components import components
from ptmcalc.numerics.record import Record
from ptmcalc.numerics.train.modes import frequencies
from ptmcalc.numerics.train.system import TrainSystem


def ringing_on(case: Case, system: TrainSystem, record: Record, found: dict[str, Found]) -> dict[str, Found]:
    """Loads with what the oscillation after the window can add: components of several frequencies meet later than any
    window ends.

        |y - y_0| <= sum_k |s_k c_k|

    c_k is the amplitude of a component at the end of the window, s_k its share in the signal y of steady part y_0.

    **Range** linear motion without further events; loads of a rope that becomes slack again have no bound.
    **Error** none where one rate does not move as another does: such a component counts with its size in the window.
    **Source** superposition of the components of a linear motion.
    """
    if case.left_weight <= LEAST_LEFT * case.weight or not _several(case):
        return found
    limits = {}
    rope, structure = case.named("link", ROPE), case.named("link", STRUCTURE)
    for force, index in (("rope_force", rope), ("bridge_force", structure if structure is not None else rope)):
        assert index is not None
        limits[force] = _rings(system, record, "link", index)
    changes = [event.after for event in record.events if event.element == ROPE]
    slack = limits["rope_force"].low < 0 or (bool(changes) and changes[-1] == "open")
    if slack:
        limits = {force: Interval(-math.inf, math.inf) for force in limits}
    result = dict(found)
    for force, limit in limits.items():
        if (largest := found.get(f"{force}_max")) is not None:
            result[f"{force}_max"] = _up_to(largest, limit.high)
        if (smallest := found.get(f"{force}_min")) is not None:
            low = max(limit.low, 0.0) if force == "rope_force" else limit.low
            result[f"{force}_min"] = _down_to(smallest, low)
    for way, sign in (("stop_distance", 1), ("stop_distance_lowering", -1)):
        if way in found and math.isfinite(found[way].estimate.value):
            load = case.named("body", LOAD)
            assert load is not None
            limit = _rings(system, record, "position", load)
            result[way] = _up_to(found[way], math.inf if slack else limit.high if sign > 0 else -limit.low)
    for name, force in _FACTORS.items():
        if name in found and force in result:
            result[name] = Found(over(result[force], case.weight).estimate, found[name].at)
    if "backlash_torque_peak" in found:
        shaft = case.named("link", SHAFT)
        mesh = case.named("mesh", GEARBOX)
        index = shaft if shaft is not None else mesh
        assert index is not None
        limit = _rings(system, record, "link" if shaft is not None else "mesh", index)
        most = math.inf if slack else max(limit.high, -limit.low)
        result["backlash_torque_peak"] = _up_to(found["backlash_torque_peak"], most)
        result["gear_impact_factor"] = over(result["backlash_torque_peak"], case.even_torque)
    return result


_FACTORS = {
    "lift_off_factor": "rope_force_max",
    "lowering_brake_factor": "rope_force_max",
    "start_factor": "rope_force_max",
    "stop_factor": "rope_force_max",
    "release_factor": "rope_force_min",
    "bridge_factor": "bridge_force_max",
    "rope_force_share": "rope_force_min",
}
"""Factors on the weight, by the force they are computed from."""


def _several(case: Case) -> bool:
    """Whether more than one natural frequency takes part."""
    springs = tuple(one for one in case.train.springs if one.name != FLANK)
    return len(frequencies(replace(case.train, springs=springs))) > 1


def _rings(system: TrainSystem, record: Record, what: str, index: int) -> Interval:
    """Bounds of a signal after the window, as long as no event comes."""
    motion, place = system.motion(record.mode), system.watched[what, index]
    if motion.curves:
        return Interval(-math.inf, math.inf)
    row = motion.watch[[place]]
    found = components(motion.rate, row, system.own)
    seen = (found.amplitudes(record.state[None])[0] * found.shapes[:, 0])[found.posed]
    steady, around = float(row[0] @ record.state) - float(seen.real.sum()), float(np.abs(seen).sum())
    return Interval(steady - around, steady + around)


def _up_to(one: Found, most: float) -> Found:
    extra = most - one.estimate.high
    return one if extra <= 0 else Found(one.estimate.widened(Interval(0.0, extra)), one.at)


def _down_to(one: Found, least: float) -> Found:
    extra = one.estimate.low - least
    return one if extra <= 0 else Found(one.estimate.widened(Interval(-extra, 0.0)), one.at)


def over(force: Found, weight: float) -> Found:
    """A force relative to a weight, or a torque relative to another."""
    one = force.estimate
    return Found(
        Estimate(one.value / weight, one.low / weight, one.high / weight, one.numerical / weight, one.model / weight),
        force.at,
    )
