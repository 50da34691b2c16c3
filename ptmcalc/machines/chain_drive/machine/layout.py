"""Where the chain runs and what it pulls: a conveyor with two strands, or two shafts."""

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from ptmcalc.base import units
from ptmcalc.machines.chain_drive.machine.chain_data import DrivenSprocket, TailSprocket, even
from ptmcalc.spec.fields import (
    FactorFromOne,
    Force,
    LineMass,
    MassFlow,
    Measure,
    PositiveForce,
    PositiveLength,
    PositiveMass,
    PositivePower,
    PositiveRatio,
    PositiveSpan,
    PositiveTorque,
    SignedSpan,
)
from ptmcalc.spec.fragment import Conflict, Fragment, Given, at_most_one, exactly_one
from ptmcalc.spec.optional import Absent, Assumed, Limit, OneOf, Setting

Exponent = Annotated[float, Measure(units.RATIO, at_least=0, at_most=3)]


class Resistance(Fragment):
    """Resistance to motion of a conveyor."""

    coefficient: PositiveRatio
    """resistance of the chain / its weight: 0.1 to 0.15 on rollers, 0.2 to 0.35 sliding"""
    load_coefficient: Annotated[PositiveRatio | None, Absent("the load rides on the chain")] = None
    """resistance of the dragged load / its weight; `coefficient` when left out"""
    turn_factor: Annotated[FactorFromOne | None, Assumed()] = None
    """factor k on all resistances for deflection at sprockets and guides; 1.1 is assumed when it is left out"""
    force: Annotated[Force, Absent("no other resistance")] = 0.0
    """further resistance at the tail end: feeding, boot, cleaning"""
    start_factor: Annotated[FactorFromOne | None, Assumed()] = None
    """resistance at the start / resistance in motion; 1.2 is assumed when it is left out"""
    stop_factor: Annotated[Annotated[float, Measure(units.RATIO, above=0, at_most=1)] | None, Assumed()] = None
    """lowest possible resistance of the warm machine / resistance in motion: for stops and backstops; 0.8 is assumed
    when it is left out"""


class TakeUp(Fragment):
    """Take-up of the chain of a conveyor."""

    type: Literal["gravity", "screw"]
    """`gravity`: a weight next to the drive keeps the leaving tension; `screw`: a fixed length of loop"""
    tension: PositiveForce
    """of the strand: leaving tension (gravity), or the mean of the loop when it was set (screw)"""
    mass: Annotated[
        PositiveMass | None, Absent("the take-up tension is constant; its inertia is covered by a bound")
    ] = None
    """of the weight with its carriage (gravity, on two falls); without it the tension stays constant"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """Only a weight has a mass."""
        if given.word("type") == "screw" and "mass" in given:
            yield Conflict(("mass",), "a screw does not move", "delete `mass`, or write `type: gravity`")


class ConveyorLayout(Fragment):
    """A conveyor: a working strand with the load, a return strand, the drive at the head."""

    type: Literal["conveyor"]
    length: PositiveSpan
    """between the shafts, one strand"""
    lift: Annotated[SignedSpan, Absent("a level conveyor")] = 0.0
    """lifting height of the load; negative when it is lowered"""
    load: Annotated[LineMass | None, OneOf("capacity")] = None
    """on the working strand, per length; or give `capacity`"""
    capacity: Annotated[MassFlow | None, OneOf("load")] = None
    """mass flow, instead of `load`"""
    resistance: Resistance
    """resistance to motion"""
    takeup: TakeUp
    """the take-up"""
    tail: TailSprocket = TailSprocket()
    """the sprocket at the tail"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The load is given in one way; a conveyor cannot rise more than it is long."""
        yield from exactly_one(given, "load", "capacity")
        length, lift = given.number("length"), given.number("lift")
        if length is not None and lift is not None and abs(lift) > length:
            yield Conflict(("lift",), "the lift exceeds the length", "write a `lift` within the `length`")


_SLACK_SAG = Assumed(0.02, 0.01, 0.03, "slack strands of chain drives: sag 1 to 3 % of the span")


class Service(Fragment):
    """Shocks of driver and driven machine, by the classes of ISO 10823:2004."""

    driver: Literal["smooth", "slight", "moderate"]
    """`smooth`: electric motor, turbine, engine with hydraulic coupling; `slight`: electric motor with frequent starts,
    engine of six cylinders and more; `moderate`: engine of fewer cylinders"""
    machine: Literal["smooth", "moderate", "heavy"]
    """`smooth`: fan, centrifugal pump, uniformly loaded conveyor; `moderate`: unevenly loaded conveyor, mixer, piston
    pump of three cylinders and more; `heavy`: crusher, press, mill, excavator"""


class TwoShafts(Fragment):
    """A chain drive between two shafts."""

    type: Literal["drive"]
    driven: DrivenSprocket
    """the driven sprocket"""
    centre_distance: Annotated[PositiveLength | None, OneOf("pitches")] = None
    """of the shafts; follows from `pitches` when left out"""
    pitches: Annotated[Annotated[int, Field(ge=6, le=100_000, strict=True)] | None, OneOf("centre_distance")] = None
    """chain length in pitches, even; default: from `centre_distance`, rounded up to even"""
    cranked_link: Literal["yes", "no"] = "no"
    """an odd number of pitches, closed by a cranked link, which has 80 % of the breaking load"""
    power: Annotated[PositivePower | None, OneOf("torque")] = None
    """on the driven shaft, or give `torque`"""
    torque: Annotated[PositiveTorque | None, OneOf("power")] = None
    """on the driven shaft, instead of `power`"""
    slack_sag: Annotated[PositiveRatio, _SLACK_SAG] = 0.02
    """sag of the slack strand / its length; 1 to 3 % is usual"""
    slack_sag_least: Annotated[PositiveRatio | None, Assumed()] = None
    """smallest sag in service, after tensioning, for the natural frequencies of the spans; half of `slack_sag` is
    assumed"""
    slack_sag_most: Annotated[PositiveRatio | None, Assumed()] = None
    """largest sag in service, of a worn chain before tensioning; one and a half times `slack_sag` is assumed"""
    rated_power: Annotated[PositivePower | None, Limit()] = None
    """of one chain at this speed, from the manufacturer's chart; needed to check the design power"""
    reference_teeth: Annotated[int, Field(ge=9, le=40, strict=True), Setting("ISO 10823: 19")] = 19
    """teeth of the small sprocket of that chart: 19 by ISO 10823:2004, 17 in older handbooks"""
    service: Service | None = None
    """classes of driver and driven machine, from which `service_factor` follows by ISO 10823"""
    service_factor: Annotated[FactorFromOne | None, Assumed()] = None
    """f_1 of ISO 10823 for driver and driven machine, 1 to 2.1; 1.4 is assumed when it is left out"""
    tooth_exponent: Annotated[Exponent, Setting("ISO 10823: 1.08")] = 1.08
    """of the tooth factor (19/z_1)^e: 1.08 by ISO 10823, 1 in some course cards"""
    strand_factor: Annotated[PositiveRatio | None, Limit()] = None
    """capacity of the multiplex chain / simplex chain; default by ACA: 1, 1.7, 2.5 for one, two, three rows"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """One of length and distance, one of power and torque; an even number of pitches."""
        yield from at_most_one(given, "service", "service_factor")
        yield from exactly_one(given, "power", "torque")
        if "centre_distance" not in given and "pitches" not in given:
            yield from exactly_one(given, "centre_distance", "pitches")
        yield from _sag_out_of_range(given)
        pitches = given.raw.get("pitches")
        if isinstance(pitches, int) and not isinstance(pitches, bool) and pitches % 2 == 1:
            if given.word("cranked_link") != "yes":
                reason = f"an odd number of {pitches} pitches cannot be closed: inner and outer links alternate"
                hint = f"write `pitches: {even(pitches)}`, or `cranked_link: yes`"
                yield Conflict(("pitches",), reason, hint)
        elif given.word("cranked_link") == "yes":
            reason = "an even number of pitches needs no cranked link"
            yield Conflict(("cranked_link",), reason, "delete `cranked_link`, or give odd `pitches`")


def _sag_out_of_range(given: Given) -> Iterator[Conflict]:
    """The sag lies between its smallest and its largest value."""
    middle, least, most = (given.number(key) for key in ("slack_sag", "slack_sag_least", "slack_sag_most"))
    if middle is not None and least is not None and least > middle:
        yield Conflict(("slack_sag_least",), "it is larger than `slack_sag`", "correct one of them")
    if middle is not None and most is not None and most < middle:
        yield Conflict(("slack_sag_most",), "it is smaller than `slack_sag`", "correct one of them")


Layout = Annotated[ConveyorLayout | TwoShafts, Field(discriminator="type")]
