"""The effects that steady running of a chain drive may call for."""

import math
from collections.abc import Mapping

from ptmcalc.base.estimate import ANYTHING, Estimate, Interval
from ptmcalc.contract.effect import Criterion, Effect
from ptmcalc.laws import inertia
from ptmcalc.machines.chain_drive.machine.model import breaking_load, chain_line, drive_mass
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, Run
from ptmcalc.machines.chain_drive.machine.strength import of_one_chain, unevenness
from ptmcalc.machines.chain_drive.polygon.answers import answer_bound
from ptmcalc.machines.chain_drive.polygon.chain_modes import loads_of
from ptmcalc.machines.chain_drive.polygon.excitation import (
    FAR,
    POLYGON,
    WEAK,
    change_by_drive,
    static_scale,
)
from ptmcalc.machines.chain_drive.polygon.resonances import resonances

Loads = Mapping[str, Estimate]
Offsets = Mapping[str, Interval]

POLYGON_THRESHOLD = 0.05
"""Bound of the polygon tension relative to the largest static tension [1] from which on the effect is simulated. An
engineering choice. Below it the error bar of a tension is at most 5 % of that static tension."""
FAR_THRESHOLD = 0.05
"""Share of the far end in the bound of the polygon tension [1] from which on its motion is simulated. An engineering
choice. Below it the error bar of a tension is at most 5 % of that bound."""
WEAK_THRESHOLD = 0.05
"""Mass of the chain relative to that of the drive [1] from which on the compliance of the drive is simulated. An
engineering choice. Below it the error is about 5 % of the polygon effect except at resonances; the error bar bounds it
harmonic by harmonic."""

_TENSIONS = (
    "tension_design",
    "tension_min",
    "tension_dynamic_polygon",
    "tension_dynamic_polygon_min",
    "tension_dynamic_polygon_far",
)


def _moved(spec: ChainDrive, loads: Loads, by: float) -> Offsets:
    """Offsets of all loads when every dynamic tension may be off by so much [N]."""
    section = spec.chain.section
    found = {name: Interval(-by, by) for name in _TENSIONS}
    found["tension_polygon_bound"] = Interval(-by, by)
    if spec.chain.pin_diameter is not None and spec.chain.bush_length is not None:
        pressure = of_one_chain(spec, by) / spec.chain.pin_diameter / spec.chain.bush_length
        found["joint_pressure"] = Interval(-pressure, pressure)
    if section is not None:  # both ends of the swing may move
        stress = of_one_chain(spec, by) / section
        found["stress_amplitude"] = Interval(-stress, stress)
        if spec.chain.fatigue_limit is not None:
            share = stress / spec.chain.fatigue_limit
            found["fatigue_utilisation"] = Interval(-share, share)
    if "safety_dynamic" in loads and "tension_design" in loads:
        found["safety_dynamic"] = _of_safety(spec, loads["safety_dynamic"], loads["tension_design"], by)
    return {name: offset if math.isfinite(by) else ANYTHING for name, offset in found.items() if name in loads}


def _of_safety(spec: ChainDrive, known: Estimate, tension: Estimate, by: float) -> Interval:
    strength = breaking_load(spec) / unevenness(spec)
    least, most = tension.low - by, tension.high + by
    low = strength / most if most > 0 else math.inf
    high = strength / least if least > 0 else math.inf
    return Interval(min(low - known.low, 0.0) if math.isfinite(known.low) else 0.0, max(high - known.high, 0.0)
                    if math.isfinite(known.high) else 0.0)  # fmt: skip


def polygon_criterion(spec: ChainDrive, scene: Run) -> Criterion:
    """Upper bound of the tension added by the polygon effect, relative to the maximum static tension.

        E = sum |D(w_n)| |b_n|/w_n^2 / (S_static + m V^2)

    **Range** any end conditions, including a loop of fixed length, whose polygon tension does not vanish at low speed,
    and a heavy far end.
    **Error** an upper bound of the ratio.
    **Source** triangle inequality on the Fourier series; the threshold of 5 % is an engineering choice.
    """
    scale, bound = static_scale(spec, scene), answer_bound(spec, scene, frozenset({FAR}), near=True)
    value = bound / scale if scale > 0 else math.inf if bound > 0 else 0.0
    return Criterion(
        "E",
        value,
        POLYGON_THRESHOLD,
        "maximum tension added by the polygon effect / static tension",
        "numerics.harmonic",
    )


def polygon_bound(spec: ChainDrive, scene: Run, loads: Loads) -> Offsets:
    """Bound of the change of each load if the polygon effect is neglected: plus or minus the sum of its absolute
    harmonics.

    **Range** linear strands that stay taut; unbounded at a resonance without damping.
    **Error** a bound.
    **Source** triangle inequality on the Fourier series; `numerics.harmonic.rest` after the last harmonic.
    """
    return _moved(spec, loads, answer_bound(spec, scene, frozenset({FAR}), near=True))


def far_criterion(spec: ChainDrive, scene: Run) -> Criterion:
    """Upper bound of the tension added by the motion of the far end, relative to the bound of both ends.

        E = sum |D_12(w_n)| |b_n|/w_n^2 / sum (|D_11(w_n)| |b_n| + |D_12(w_n)| |b_n|)/w_n^2

    **Range** the leaving strand of the same sprocket with a screw or a take-up weight, a driven tail, a driven
    sprocket; 0 if the far end has a constant tension.
    **Error** exact except for the harmonics after the last one.
    **Source** triangle inequality on the Fourier series; the threshold of 5 % is an engineering choice.
    """
    whole, bound = answer_bound(spec, scene, frozenset({FAR}), near=True), _far(spec, scene)
    value = min(bound / whole, 1.0) if 0 < whole < math.inf else float(bound > 0)
    return Criterion(
        "E_2",
        value,
        FAR_THRESHOLD,
        "share of the far end motion in the polygon effect",
        "numerics.harmonic",
    )


def _far(spec: ChainDrive, scene: Run) -> float:
    """With the drive held and, where there is one, with the drive that gives way [N]."""
    kinds = [frozenset({FAR})] + ([frozenset({FAR, WEAK})] if spec.drive is not None else [])
    return max(answer_bound(spec, scene, kind, near=False) for kind in kinds)


def far_bound(spec: ChainDrive, scene: Run, loads: Loads) -> Offsets:
    """Bound of the change of each load if the motion of the far end is neglected: the sum of its absolute harmonics.

    **Range** as the criterion.
    **Error** a bound.
    **Source** superposition, triangle inequality on the Fourier series.
    """
    return _moved(spec, loads, _far(spec, scene))


def weak_criterion(spec: ChainDrive, scene: Run) -> Criterion | None:
    """Ratio of the mass of chain and load to the drive mass reduced to the chain.

        e = m/(J/r^2)

    **Range** drives with given motors and gear; a drive without them counts as infinitely heavy.
    **Error** exact; away from resonances, the drive moves by about this share of the chain motion.
    **Source** S. Mahalingam, "Polygonal action in chain drives": the drive in series; the threshold of 5 % is an
    engineering choice.
    """
    if spec.drive is None:
        return None
    value = chain_line(spec, scene).moving_mass / drive_mass(spec, inertia.ENERGY)
    return Criterion("e", value, WEAK_THRESHOLD, "mass of the chain / mass of the drive", "Mahalingam")


def weak_bound(spec: ChainDrive, scene: Run, loads: Loads) -> Offsets:
    """Bound of the change due to the compliance of the drive: tensions per harmonic, resonance speeds from both
    frequencies.

        |dS| <= sum |D'_n - D_n| |b_n|/w_n^2,   dV = V' - V

    **Range** linear strands; unbounded at a resonance without damping of either chain.
    **Error** a bound for tensions; exact for frequencies and speeds.
    **Source** triangle inequality on the difference of two Fourier series.
    """
    found = dict(_moved(spec, loads, change_by_drive(spec, scene)))
    if "frequency_ratio" in loads:
        truth = loads_of(spec, resonances(spec, scene, frozenset({WEAK})))
        plain = loads_of(spec, resonances(spec, scene, frozenset()))
        for name in loads.keys() & plain.keys():
            found[name] = _towards(plain[name], truth.get(name, math.nan))
    return found


def _towards(plain: float, truth: float) -> Interval:
    change = truth - plain if truth != plain else 0.0
    if not math.isfinite(change):
        return ANYTHING
    return Interval(min(change, 0.0), max(change, 0.0))


EFFECTS = (
    Effect(
        POLYGON, "polygon effect (chordal action) of the sprocket", frozenset({Run}), polygon_criterion, polygon_bound
    ),
    Effect(
        FAR,
        "polygon effect at the far end",
        frozenset({Run}),
        far_criterion,
        far_bound,
        part_of=POLYGON,
    ),
    Effect(WEAK, "compliance of the drive against the chain", frozenset({Run}), weak_criterion, weak_bound),
)
