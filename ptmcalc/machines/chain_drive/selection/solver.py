"""Choice of the chain: safety at rest, sizes, wear and life, blow of the joints."""

from collections.abc import Iterator

import numpy as np

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import chain_fatigue, chain_selection, chain_wear, equalising, sprocket
from ptmcalc.machines.chain_drive.machine.layout import TwoShafts
from ptmcalc.machines.chain_drive.machine.model import (
    ROWS,
    ChainLine,
    centre_distance,
    chain_length,
    chain_line,
    filled,
    fitted_distance,
    pitches,
    reaches_round,
    sprocket_inertia,
    tail_teeth,
    useful_pull,
    wrap,
)
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, Run
from ptmcalc.machines.chain_drive.machine.strength import of_one_chain, safety

_REFERENCE = 19
"""Teeth of the small sprocket of the charts by ISO 10823:2004. Charts of other numbers are named in the report."""


def run(spec: ChainDrive, scene: Run, carried: frozenset[str], level: int) -> Result:
    """Static safety, geometry of two shafts, design power, wear and life.

        n = F_B/(c (S + m V^2)),   P_c = P f_1 f_2/k,   life = (e p/D) L/V,  D = sum (S_in + S_out) l f t_B

    **Range** chains by ISO 606, drives by ISO 10823; wear of the textbook at the speed its coefficient was measured at.
    **Error** that of factors and coefficients given.
    **Source** `laws.chain_selection`, `laws.chain_wear`, `laws.sprocket`: ISO 606:2015, ISO 10823:2004, ACA; lecture
    notes Kramatorsk 2007.
    """
    line = chain_line(spec, scene)
    loads: dict[str, float] = dict(_sizes(spec))
    loads["safety_static"] = safety(spec, max(line.ends) + line.centrifugal)
    loads |= _blow(spec)
    if isinstance(spec.layout, TwoShafts):
        loads["design_power"] = _design_power(spec, spec.layout)
    if spec.equalising is not None:
        loads |= _equalising(spec)
    if spec.checks.life is not None:
        loads["tooth_passes"] = float(chain_fatigue.tooth_passes(spec.checks.life, spec.chain.pitch, spec.speed))
    found = {name: Found(Estimate.exact(value), note=_note(spec, name)) for name, value in loads.items()}
    found["chain_speed"] = Found(
        Estimate.exact(spec.speed),
        note=f"lubrication by ACA for roller chains: {chain_selection.lubrication(spec.chain.pitch, spec.speed)}",
    )
    return Result(found | dict(_life(spec, line)), work=1)


def _note(spec: ChainDrive, load: str) -> str:
    """Chart of the design power, where it is not that of 19 teeth."""
    layout = spec.layout
    if load != "design_power" or not isinstance(layout, TwoShafts) or layout.reference_teeth == _REFERENCE:
        return ""
    return f"by a chart of {layout.reference_teeth} teeth"


def _sizes(spec: ChainDrive) -> Iterator[tuple[str, float]]:
    one, other = spec.sprocket.teeth, tail_teeth(spec)
    yield "teeth_least", min(one, other)
    yield "ratio", max(one, other) / min(one, other)
    yield "wrap", wrap(spec)
    yield "pitches", pitches(spec)
    yield "centre_distance", centre_distance(spec)
    if isinstance(spec.layout, TwoShafts) and reaches_round(spec):
        yield "centre_distance_fitted", fitted_distance(spec)
    yield "centre_distance_pitches", centre_distance(spec) / spec.chain.pitch


def _blow(spec: ChainDrive) -> dict[str, float]:
    """A link with its share of flights meets the tooth, the whole of the speed on the safe side."""
    speed = sprocket.engagement_speed(spec.speed, spec.sprocket.teeth, sprocket.TRANSLATING)
    return {
        "engagement_speed": speed,
        "engagement_energy": sprocket.engagement_energy(spec.chain.mass * spec.chain.pitch, speed, 1.0),
    }


def _design_power(spec: ChainDrive, layout: TwoShafts) -> float:
    teeth = min(spec.sprocket.teeth, layout.driven.teeth)
    rows = layout.strand_factor if layout.strand_factor is not None else ROWS[min(spec.chain.rows, max(ROWS))]
    factor = chain_selection.tooth_factor(teeth, layout.tooth_exponent, layout.reference_teeth)
    return chain_selection.design_power(useful_pull(spec) * spec.speed, filled(layout.service_factor), factor, rows)


def _equalising(spec: ChainDrive) -> dict[str, float]:
    swing = equalising.equalising_acceleration(spec.speed, spec.chain.pitch, spec.sprocket.teeth)
    return {
        "equalising_ratio": equalising.equalising_ratio(spec.sprocket.teeth),
        "equalising_torque": sprocket_inertia(spec) * swing,
    }


def _life(spec: ChainDrive, line: ChainLine) -> Iterator[tuple[str, Found]]:
    """Every joint bends at both sprockets, twice each, under the tensions there."""
    wear, pin = spec.wear, spec.chain.pin_diameter
    if wear is None or pin is None:
        return
    centrifugal = line.centrifugal
    tensions = [max(of_one_chain(spec, end + centrifugal), 0.0) for end in line.ends]
    run_in, run_out = np.array([tensions[3], tensions[1]]), np.array([tensions[0], tensions[2]])
    path = np.array([chain_wear.sprocket_path(pin, z) for z in (spec.sprocket.teeth, tail_teeth(spec))])
    if wear.archard is not None:
        if spec.chain.bush_length is None:
            return
        given = wear.archard
        area = pin * spec.chain.bush_length
        grows = chain_wear.archard_wear(
            run_in, run_out, path, area, given.coefficient, given.reference_pressure, given.exponent
        )
        note = "by pressure and sliding path (Archard)"
    else:
        time = np.full(2, chain_wear.contact_time(spec.chain.pitch, spec.speed))
        rate = np.full(2, filled(wear.coefficient))
        grows = chain_wear.wear_per_revolution(run_in, run_out, path, time, rate, wear.tensions)
        note = f"entering and leaving tensions count by their {wear.tensions}"
    allowed = chain_wear.allowed_growth(spec.chain.pitch, filled(wear.elongation))
    life = float(chain_wear.chain_life(allowed, grows, chain_length(spec), spec.speed))
    yield "wear_per_revolution", Found(Estimate.exact(grows), note=note)
    yield "life", Found(Estimate.exact(life), note=note)


CHAIN_SELECTION: Solver[ChainDrive, Run] = Solver(
    name="chain_selection",
    title="chain selection: safety, geometry, wear, life",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Run}),
    represents=frozenset(),
    gives=frozenset(
        {
            "chain_speed",
            "safety_static",
            "teeth_least",
            "ratio",
            "wrap",
            "pitches",
            "centre_distance",
            "centre_distance_fitted",
            "centre_distance_pitches",
            "design_power",
            "engagement_speed",
            "engagement_energy",
            "equalising_ratio",
            "equalising_torque",
            "wear_per_revolution",
            "life",
            "tooth_passes",
        }
    ),
    run=run,
    cost=lambda spec, scene, carried, level: 6.1e-3,
    source="ISO 606:2015; ISO 10823:2004; ACA; lecture notes Kramatorsk 2007",
)
