"""The polygon effect on strands with mass and elasticity all along: the Fourier series of the dynamic tension."""

import math

import numpy as np

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Finding, Found, History, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import polygon
from ptmcalc.machines.chain_drive.machine.layout import ConveyorLayout
from ptmcalc.machines.chain_drive.machine.model import chain_line, vibrating
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, Run
from ptmcalc.machines.chain_drive.machine.strength import OF_TENSION, loads_of_tension
from ptmcalc.machines.chain_drive.polygon.answers import answer
from ptmcalc.machines.chain_drive.polygon.excitation import (
    FAR,
    HARMONICS,
    POLYGON,
    WEAK,
    mass_of_drive,
    swept,
    undamped,
)
from ptmcalc.machines.chain_drive.polygon.resonances import operating_range

SWEEP = 200
"""Speeds of a sweep over the operating range. A numerical choice: more resolve narrow resonances in the figure and take
longer."""
_NEAR_A_STEP = 0.05
"""Distance from a step of the textbook's table, relative to the length [1], within which NUM108 is reported. An
engineering choice: a larger value reports more lengths; a smaller one omits lengths that rounding moves across the
step. No load depends on it."""


def run(spec: ChainDrive, scene: Run, carried: frozenset[str], level: int) -> Result:
    """Maximum and minimum dynamic tension of a chain under the polygon effect.

        S(t) = sum Im(D(w_n) (-b_n/w_n^2) e^(i w_n t)),   w_n = 2 pi n V/p

    D is the dynamic stiffness of the strands with the ends of the machine: constant tension with or without a moving
    mass, a fixed end, or the other strand of the same sprocket. The far end may have a polygon effect of its own. In
    front of a driven tail the return strand vibrates on its own, its sprockets at constant speed. The
    maximum tension over a range of speeds is the curve of the load `tension_dynamic_polygon`.

    **Range** linear taut strands; tensions at both ends of the vibrating strands and at the tail.
    **Error** bounded: harmonics after the last one and values between samples; rounding.
    **Source** `numerics.harmonic`; N. Yu. Dorokhov, lecture notes, Kramatorsk 2007, for the motion of the sprocket.
    """
    count = HARMONICS[level]
    found = answer(spec, scene, carried, count)
    loads = {name: Found(one) for name, one in loads_of_tension(spec, chain_line(spec, scene), found).items()}
    at = {"pitch": found.place} if found.place is not None else {}
    loads["tension_dynamic_polygon"] = Found(found.largest, at)
    loads["tension_dynamic_polygon_min"] = Found(found.smallest)
    loads["tension_dynamic_polygon_far"] = Found(found.far_largest)
    loads["tension_polygon_bound"] = Found(_bounded_by(found.largest.low, found.bound))

    def histories() -> dict[str, History]:
        speeds = sweep_speeds(spec)
        chain = vibrating(spec, scene, mass_of_drive(spec, carried))
        peaks = swept(spec, chain, speeds, carried, count).largest
        return {"tension_dynamic_polygon": History(units.FORCE, speeds.tolist(), peaks.tolist(), units.SPEED)}

    findings = _near_a_step(spec) + (_without_damping(spec, scene) or _without_bound(found.bound, count))
    return Result(loads, work=count, findings=findings, histories=histories)


def _bounded_by(largest: float, bound: float) -> Estimate:
    """The least bound of the tension: no less than what it reaches, no more than the sum of its absolute harmonics with
    all that lies behind the last one."""
    if not math.isfinite(bound):
        return Estimate.exact(bound)
    low = min(largest, bound)
    return Estimate(bound, low, bound, numerical=bound - low)


def sweep_speeds(spec: ChainDrive) -> np.ndarray:
    """The speeds of the operating range, that of the file among them [m/s]."""
    speeds = np.linspace(*operating_range(spec), SWEEP)
    speeds[int(np.argmin(np.abs(speeds - spec.speed)))] = spec.speed
    return speeds


def _near_a_step(spec: ChainDrive) -> tuple[Finding, ...]:
    """The textbook's table of lengths jumps at 25 and at 60 m."""
    if not isinstance(spec.layout, ConveyorLayout) or spec.layout.tail.driven == "on":
        return ()
    threshold, distance = polygon.nearest_threshold(spec.layout.length)
    if abs(distance) > _NEAR_A_STEP:
        return ()
    step = units.show(threshold, units.SPAN)
    message = f"the textbook's polygon force jumps at a length of {step}, {abs(distance):.1%} from here: see the bars"
    return (Finding("NUM108", message, ("layout", "length")),)


def _without_damping(spec: ChainDrive, scene: Run) -> tuple[Finding, ...]:
    if not undamped(spec, scene):
        return ()
    message = (
        "the polygon tension of a chain without damping has no bound: at any speed, high harmonics coincide with modes"
    )
    return (Finding("NUM102", message, ("chain", "damping"), "write `damping: {ratio: 0.05}`, or a measured ratio"),)


def _without_bound(bound: float, count: int) -> tuple[Finding, ...]:
    if math.isfinite(bound):
        return ()
    message = f"the polygon tension has no bound: the part beyond harmonic {count} of the teeth is unknown"
    return (Finding("NUM102", message, ("chain", "damping")),)


DISTRIBUTED_STRAND: Solver[ChainDrive, Run] = Solver(
    name="distributed_strand",
    title="polygon effect on continuous elastic strands",
    fidelity=Fidelity.MODAL,
    scenes=frozenset({Run}),
    represents=frozenset({POLYGON, FAR, WEAK}),
    gives=OF_TENSION
    | {
        "tension_dynamic_polygon",
        "tension_dynamic_polygon_min",
        "tension_dynamic_polygon_far",
        "tension_polygon_bound",
    },
    run=run,
    cost=lambda spec, scene, carried, level: 6.4e-3 * 2**level,
    source="Fourier series of the polygon acceleration; dynamic stiffness of the strands",
    always=frozenset({POLYGON}),
    levels=len(HARMONICS),
)
