"""What moves and holds the load, as a designer writes it: motor, gearbox, brake, and what they are made for."""

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from ptmcalc.base import units
from ptmcalc.components import drive
from ptmcalc.laws.duty import DUTY_TYPES
from ptmcalc.spec.fields import (
    FactorFromOne,
    HourlyRate,
    Measure,
    PositiveEnergy,
    PositiveMass,
    PositivePower,
    PositiveShare,
    PositiveTime,
    PositiveTorque,
    ReverseEfficiency,
    RunningTime,
    Share,
    SignedTorque,
    Time,
)
from ptmcalc.spec.fragment import Conflict, Fragment, Given, together
from ptmcalc.spec.optional import Absent, Assumed, Checked, Limit

Mechanism = Literal["M1", "M2", "M3", "M4", "M5", "M6", "M7", "M8"]


class Gearbox(drive.Gear):
    """The gear between motor and drum."""

    reverse_efficiency: Annotated[ReverseEfficiency | None, Assumed()] = None
    """from drum to motor; 2 - 1/efficiency when left out, negative for a self-locking gear"""
    stiffness: Annotated[
        Annotated[float, Measure(units.TORSIONAL_STIFFNESS, above=0)] | None,
        Absent("rigid; impacts in the gear are checked only with this key"),
    ] = None
    """of shafts and gear between rotor and drum, on the drum shaft; rigid when left out"""
    backlash: Annotated[
        float, Measure(units.ANGLE, at_least=0), Absent("no backlash; its impact is checked only with this key")
    ] = 0.0
    """total backlash between rotor and drum, as an angle of the drum"""
    damping: Annotated[
        float,
        Measure(units.RATIO, at_least=0, at_most=1),
        Assumed(0.03, 0.02, 0.1, "damping ratio of shafts and teeth: 0.02 to 0.1"),
    ] = 0.03
    """damping ratio of the rotor oscillation against the drum; 0.02 to 0.1 for shafts and gears"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """Teeth meet through their play with a blow that goes by the stiffness behind them."""
        yield from super().conflicts(given)
        if given.number("backlash"):
            yield from together(
                given, "backlash", "stiffness", "the impact after the backlash depends on the stiffness"
            )


class Holding(Fragment):
    """Holding torque of the brake by a named rule, in addition to that of the mechanism group."""

    rule: Literal["cmaa_70", "osha_1910_179", "fem_1_001", "en_14492_2"]
    """CMAA 70, OSHA 1910.179, FEM 1.001 or EN 14492-2"""
    edition: Annotated[str, Field(min_length=1, max_length=100, examples=["3rd edition, 1998"])]
    """edition of the rule, for the report"""
    brakes: Literal[1, 2] = 1
    """holding brakes that share `torque`; each must hold alone with the factor of the rule"""
    control_braking: Literal["mechanical", "other"] = "other"
    """control braking of the lowered load, for CMAA 70 and OSHA 1910.179"""
    load_torque: Literal["hoisting", "without_losses", "holding"] | None = None
    """torque of the load to which the factor refers; default: hoisting with losses for CMAA 70 and OSHA 1910.179, else
    without losses, which is more than the brake holds"""
    factor: Annotated[FactorFromOne | None, Limit()] = None
    """required ratio; default: that of the rule"""
    torque_loss: Annotated[
        float, Measure(units.SHARE, at_least=0, at_most=0.9), Absent("the rules refer to the rated brake torque")
    ] = 0.0
    """loss of the brake torque by wear of the lining; 10 to 20 % for spring brakes before they are readjusted"""


class Brake(Fragment):
    """The holding brake."""

    torque: PositiveTorque
    """of all brakes together, fully applied"""
    shaft: Literal["motor", "drum"] = "motor"
    """shaft of the brake"""
    holding: Holding | None = None
    """named rule of the holding torque"""
    delay: Annotated[
        Time, Assumed(0.0, 0.0, 0.3, "brakes released by a magnet or thruster close within 0.1 to 0.3 s")
    ] = 0.0
    """from switch-off to the start of the braking torque"""
    rise_time: Annotated[Time, Absent("the interval of the assumed `delay` includes the rise")] = 0.0
    """from then to full torque"""
    rise: Literal["linear", "exponential"] = "linear"
    """how it rises; `rise_time` is the time constant of an exponential rise"""
    disc_mass: Annotated[PositiveMass | None, Checked()] = None
    """of all brake discs or drums together; needed for their temperature in emergency stops"""
    specific_heat: Annotated[Annotated[float, Measure(units.SPECIFIC_HEAT, above=0)] | None, Assumed()] = None
    """of the discs or drums, with `disc_mass`; 500 J/(kg K) is assumed, 460 to 540"""
    cooling_time: Annotated[PositiveTime | None, Assumed()] = None
    """time constant of the cooling of the discs, m c/(alpha A), with `stops_per_hour`; 2400 s is assumed"""
    stops_per_hour: Annotated[HourlyRate | None, Checked()] = None
    """emergency stops per hour at equal intervals; needed for the temperature of repeated stops"""
    temperature_rise: Annotated[Annotated[float, Measure(units.TEMPERATURE_DIFFERENCE, above=0)] | None, Limit()] = None
    """permissible mean temperature rise of the discs above the ambient air"""
    stop_heat: Annotated[PositiveEnergy | None, Limit()] = None
    """permissible friction work of one stop, from the data sheet"""
    friction_work: Annotated[PositiveEnergy | None, Checked()] = None
    """permissible friction work until the lining is readjusted or replaced, from the data sheet"""
    stops_per_service: Annotated[Annotated[float, Measure(units.FACTOR, above=0)] | None, Limit()] = None
    """emergency stops between two services of the brake; compared with `friction_work`"""

    @property
    def heats(self) -> bool:
        """Whether the file gives data of the heat or wear of the brake."""
        return any(one is not None for one in (self.disc_mass, self.stop_heat, self.friction_work))


class Classes(Fragment):
    """Classification of the hoist."""

    mechanism: Mechanism | None = None
    """mechanism group, M1 to M8; needed for the limits of rope, drum and sheaves"""
    hoisting: Literal["HC1", "HC2", "HC3", "HC4"] | None = None
    """hoisting class; with `drive` it determines phi_2 of the standard"""
    drive: Literal["HD1", "HD2", "HD3", "HD4", "HD5"] = "HD1"
    """hoist drive class; HD1 has no creep speed"""
    edition: Literal["by_class", "by_drive", "raised"] = "by_class"
    """minimum phi_2, different in the sources: by the hoisting class alone (ISO 8686-1), 1.05 for the drives HD3 and
    HD5 (`by_drive`), or 1.1 to 1.4 for HD1 (`raised`)"""
    combination: Literal["regular", "exceptional"] = "regular"
    """lift-off speed of the load combinations A1 and B1, or of C1"""
    dangerous_load: Literal["yes", "no"] = "no"
    """molten metal or a similarly dangerous load: 25 % more rope safety, at least group M5"""


class SpectrumPoint(Fragment):
    """A part of the load spectrum."""

    share: PositiveShare
    """of all cycles"""
    load: Share
    """relative to the rated load"""


class CyclePart(Fragment):
    """A part of a cycle of given motor torques."""

    torque: SignedTorque
    """of one motor, at the begin of the part; 0 at rest"""
    to: Annotated[SignedTorque | None, Absent("the torque is constant")] = None
    """torque at the end of the part, on a straight line; constant when left out"""
    time: PositiveTime
    """duration"""
    phase: Literal["running", "starting", "rest"] = "running"
    """running at speed; starting or stopping, with half of the loss of cooling; at rest"""

    @property
    def end(self) -> float:
        """Torque at the end [N*m]."""
        return self.torque if self.to is None else self.to

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """A motor at rest is switched off."""
        if given.word("phase") == "rest" and (given.number("torque") or given.number("to")):
            yield Conflict(
                ("phase",), "the brake holds the load at rest", "write `torque: 0 N*m`, or `phase: starting`"
            )


class Losses(Fragment):
    """Losses of one motor at its continuous rating."""

    constant: PositivePower
    """iron and friction losses, independent of the torque"""
    copper: PositivePower
    """losses in the windings at the rated torque"""
    temperature_rise: Annotated[Annotated[float, Measure(units.TEMPERATURE_DIFFERENCE, above=0)] | None, Limit()] = None
    """rated temperature rise of the winding; needed to check the peak of the cycle"""
    time_constant: Annotated[PositiveTime | None, Checked()] = None
    """time constant of the heating of the motor at speed, 20 to 60 min; needed to check the peak of the cycle"""


class Duty(Fragment):
    """Duty of the hoist."""

    type: Literal["S1", "S2", "S3", "S4", "S5", "S6", "S7", "S8", "S9", "S10"] = "S3"
    """duty type of IEC 60034-1"""
    factor: Annotated[PositiveShare | None, Assumed()] = None
    """cyclic duration factor of the motor; 40 % is assumed when it is left out"""
    starts_per_hour: Annotated[HourlyRate | None, Checked()] = None
    """of the motor"""
    load_spectrum: Annotated[tuple[SpectrumPoint, ...], Field(min_length=1, max_length=20)] | None = None
    """load spectrum of the service life; default: always the rated load"""
    cycle: Annotated[tuple[CyclePart, ...], Field(min_length=1, max_length=200)] | None = None
    """cycle of given motor torques, to check the heating by it"""
    losses: Losses | None = None
    """losses of a motor at its continuous rating, to check the heating by `cycle` with them"""
    hours: Annotated[RunningTime | None, Limit()] = None
    """operating time in the service life; with the spectrum it determines the mechanism group"""
    cycles: Annotated[Annotated[float, Measure(units.FACTOR, above=0)] | None, Limit()] = None
    """working cycles in the service life; with the spectrum they determine the crane group"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The shares of a spectrum are a whole; a continuous duty knows no factor."""
        points = given.blocks("load_spectrum")
        shares = [point.number("share") if point else None for point in points]
        known = [share for share in shares if share is not None]
        if known and len(known) == len(shares) and abs(sum(known) - 1) > 1e-6:
            reason = f"the shares add up to {sum(known):.3g}"
            yield Conflict(("load_spectrum",), reason, "correct them to a sum of 1, so that every cycle has a load")
        kind = given.word("type")
        if kind is None:
            return
        if not DUTY_TYPES[kind].at_rest and "factor" in given:
            yield Conflict(("factor",), f"{kind} has no rest", "delete `factor`, or write `type: S3`")
        if DUTY_TYPES[kind].counts_starts and "starts_per_hour" not in given:
            yield given.missing("starts_per_hour", f"the starts heat the motor in {kind}")
