"""Dynamic tension of an evenly running chain, and what tensions do to it: safety, pressure in the joints, fatigue."""

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from ptmcalc.base.estimate import Estimate
from ptmcalc.laws import chain_fatigue, chain_selection
from ptmcalc.machines.chain_drive.machine.layout import ConveyorLayout, TwoShafts
from ptmcalc.machines.chain_drive.machine.model import ChainLine, breaking_load, ends_at_tail
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive

SAFETY = {ConveyorLayout: (10.0, 7.0), TwoShafts: (7.0, 5.0)}
"""Required safety factors by default, static and in steady running [1]: for traction chains of the handbook range 7 to
10, for drives DIN 8195:1977. Larger values require a stronger chain."""
OF_TENSION = frozenset(
    {"tension_design", "tension_min", "safety_dynamic", "joint_pressure", "stress_amplitude", "fatigue_utilisation"}
)
"""Loads that move with the dynamic tension."""


@dataclass(frozen=True, slots=True)
class Tail:
    """Largest and smallest dynamic tension of the working and of the return strand at the tail [N]."""

    working_largest: Estimate
    working_smallest: Estimate
    back_largest: Estimate
    back_smallest: Estimate


STILL = Estimate.exact(0.0)
"""No dynamic tension [N]."""
QUIET = Tail(STILL, STILL, STILL, STILL)
"""A tail behind which nothing vibrates, or at which the far end is."""


@dataclass(frozen=True, slots=True)
class Answer:
    """Largest and smallest dynamic tension of steady running at run-on, far end and tail [N], and the most they can
    be."""

    largest: Estimate
    smallest: Estimate
    far_largest: Estimate
    far_smallest: Estimate
    tail: Tail
    bound: float
    place: float | None
    off_largest: Estimate = STILL
    off_smallest: Estimate = STILL
    """of the run-off, where it is the end of a return strand in front of a driven tail"""


AT_REST = Answer(STILL, STILL, STILL, STILL, tail=QUIET, bound=0.0, place=None)
"""A chain that runs evenly."""


def moved(value: Estimate, by: float) -> Estimate:
    """The same with a known number added."""
    return Estimate(value.value + by, value.low + by, value.high + by, value.numerical, value.model)


def through(value: Estimate, law: Callable[[float], float]) -> Estimate:
    """A rising or falling function of a number, at it and at its ends."""
    ends = sorted((law(value.low), law(value.high)))
    middle = law(value.value)
    if ends[0] == ends[1]:
        return Estimate.exact(middle)
    return Estimate(middle, ends[0], ends[1], numerical=max(middle - ends[0], ends[1] - middle))


def _extreme(values: Iterable[Estimate], of: Callable[..., float]) -> Estimate:
    known = list(values)
    top = known[[one.value for one in known].index(of(one.value for one in known))]
    low, high = of(one.low for one in known), of(one.high for one in known)
    return Estimate(top.value, low, high, top.numerical, top.model)


def loads_of_tension(spec: ChainDrive, line: ChainLine, given: Answer) -> dict[str, Estimate]:
    """Loads of a scene of even speed: static, centrifugal and dynamic tension together.

    The dynamic tension is known at the run-on, at the tail, and at the end of what vibrates where it has one there.
    """
    far, tail = (line.working.begin if ends_at_tail(spec) else line.run_off), given.tail
    most = [
        moved(given.largest, line.run_on),
        moved(given.far_largest, far),
        moved(tail.working_largest, line.working.begin),
        moved(tail.back_largest, line.back.end),
        moved(given.off_largest, line.run_off),
    ]
    least = [
        moved(given.smallest, line.run_on),
        moved(given.far_smallest, far),
        moved(tail.working_smallest, line.working.begin),
        moved(tail.back_smallest, line.back.end),
        moved(given.off_smallest, line.run_off),
    ]
    centrifugal = line.centrifugal
    design = moved(_extreme(most, max), centrifugal)
    loads = {"tension_design": design, "tension_min": _extreme(least, min)}
    loads["safety_dynamic"] = through(design, lambda tension: safety(spec, tension))
    chain = spec.chain
    if chain.pin_diameter is not None and chain.bush_length is not None:
        pin, bush = chain.pin_diameter, chain.bush_length
        loads["joint_pressure"] = through(
            design, lambda tension: float(chain_selection.articulation_pressure(of_one_chain(spec, tension), pin, bush))
        )
    if chain.section is not None:
        loads |= _fatigue(spec, line, given, chain.section)
    return loads


def of_one_chain(spec: ChainDrive, tension: float) -> float:
    """Tension of the most loaded chain of a strand [N]."""
    return tension / spec.chain.count * unevenness(spec)


def unevenness(spec: ChainDrive) -> float:
    """Load of the most loaded of parallel chains over an even share [1]."""
    return spec.chain.unevenness if spec.chain.unevenness is not None else 1.0


def safety(spec: ChainDrive, tension: float) -> float:
    """Safety of a strand against its breaking load [1]."""
    return float(chain_selection.chain_safety(breaking_load(spec), max(tension, 0.0), unevenness(spec)))


def _between(low: Estimate, high: Estimate) -> Estimate:
    """How far a tension swings."""
    if math.isinf(high.value):
        return high
    width = high.value - low.value
    error = high.numerical + low.numerical
    return Estimate(width, max(high.low - low.high, 0.0), high.high - low.low, error)


def _fatigue(spec: ChainDrive, line: ChainLine, given: Answer, section: float) -> dict[str, Estimate]:
    """The polygon effect swings the stress of the plates once a tooth, most where its tension swings most; the mean is
    that of the run-on."""

    def amplitude(swing: float) -> float:
        return float(chain_fatigue.stress_amplitude(of_one_chain(spec, swing), 0.0, section))

    tail = given.tail
    swing = _extreme(
        (
            _between(given.smallest, given.largest),
            _between(given.far_smallest, given.far_largest),
            _between(tail.working_smallest, tail.working_largest),
            _between(tail.back_smallest, tail.back_largest),
            _between(given.off_smallest, given.off_largest),
        ),
        max,
    )
    found = {"stress_amplitude": through(swing, amplitude)}
    limit = spec.chain.fatigue_limit
    if limit is not None:
        mean = of_one_chain(spec, line.run_on + line.centrifugal) / section
        strength = spec.chain.strength if spec.chain.strength is not None else float("inf")
        found["fatigue_utilisation"] = through(
            swing, lambda width: float(chain_fatigue.fatigue_utilisation(amplitude(width), mean, limit, strength))
        )
    return found
