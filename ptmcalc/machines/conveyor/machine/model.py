"""A conveyor in one scene as SI numbers: strands, resistances, static tensions, drive.

The belt runs drive run-off -> return strand -> tail drum -> carry strand -> drive run-on. Static tensions rise
along it by the idlers' resistance, by the lift of belt and load, and at the tail by the secondary resistances when
these are given as a force.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ptmcalc.base.memory import kept_for
from ptmcalc.laws import inertia, motor, wave
from ptmcalc.laws.loop_bounds import CARRY, RETURN, LoopMasses
from ptmcalc.machines.conveyor.machine.brakes import braked_shafts
from ptmcalc.machines.conveyor.machine.keys.belt import IdlerRow
from ptmcalc.machines.conveyor.machine.keys.drives import Drive
from ptmcalc.machines.conveyor.machine.loading import (
    Filling,
    Names,
    Piece,
    filling_of,
    force_in_zones,
    forces_in_zones,
    load_line_mass,
    pieces,
    sections,
)
from ptmcalc.machines.conveyor.machine.resistances import Extra, extra_forces, filled, idler_friction
from ptmcalc.machines.conveyor.machine.scenes import ConveyorScene, Run, Start, Stopping, steady
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.numerics import lanes

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Strand:
    """One strand: moving mass per length [kg/m] (the mean where only some sections are loaded), the weight of belt and
    load on one idler pitch [N], None when the pitch is not given, and, summed up from its upstream end at `marks` [m],
    idler friction [N] and the tension that gravity asks for [N]; `masses` [kg/m] lie between the marks."""

    line_mass: float
    span_weight: float | None
    marks: tuple[float, ...]
    friction: tuple[float, ...]
    climb: tuple[float, ...]
    masses: tuple[float, ...]
    goes: tuple[float, ...] = ()
    """part of the mass that goes with the belt: idlers turn where they are"""
    span_weights: tuple[float, ...] = ()
    """weight of belt and load on one idler pitch, section by section [N]; nothing where a pitch is not given"""

    @property
    def length(self) -> float:
        """[m]"""
        return self.marks[-1]

    @property
    def rises(self) -> FloatArray:
        """Static tension over that of the upstream end, at the marks [N]."""
        sums: FloatArray = np.add(self.friction, self.climb)
        return sums

    @property
    def rise(self) -> float:
        """Static tension of the downstream end over that of the upstream end [N]."""
        return self.friction[-1] + self.climb[-1]

    @property
    def mean_rise(self) -> float:
        """Mean over the strand of what the static tension has risen [N]."""
        rises = self.rises
        return lanes.number(np.sum(np.diff(self.marks) * (rises[1:] + rises[:-1]) / 2)) / self.length

    @property
    def even(self) -> bool:
        """Whether mass and static rise are the same all along, as those of one section are."""
        return len(self.masses) == 1 or _even(self)


@kept_for(256)
def _even(strand: Strand) -> bool:
    rises = strand.rise * np.array(strand.marks) / strand.length
    straight = (abs(one - other) <= 1e-12 * abs(other) for one, other in zip(strand.rises, rises, strict=True))
    return lanes.alike(strand.masses) and all(straight)


@dataclass(frozen=True, slots=True)
class BeltLine:
    """A conveyor in one load state: everything a run or a start needs, in SI."""

    gravity: float
    speed: float
    stiffness: float
    belt_line_mass: float
    carry: Strand
    back: Strand
    tail_force: float
    drive_mass: float
    tail_mass: float
    fixed_length: bool
    takeup_tension: float
    grip_exponent: float | None
    breaking_force: float | None
    slack_sag: float
    speed_share: float = 0.0
    """part of the idlers' resistance at rated speed that goes with the speed"""
    tail_pull: float = 0.0
    """what drives at the tail pull in steady motion [N]"""
    weight_at_tail: bool = False
    """True if the take-up tension is the mean of both sides of the tail pulley"""
    by_length: bool = False
    """whether the load has several steps, and each length its own sag and slack limit"""
    static_resistance: float = field(init=False, compare=False, repr=False)
    """static resistance left for the drums at the head, at the rim [N]"""

    def __post_init__(self) -> None:
        object.__setattr__(self, "static_resistance", self.carry.rise + self.back.rise + self.tail_step)

    @property
    def tail_step(self) -> float:
        """Static tension behind the tail over that before it [N]."""
        return self.tail_force - self.tail_pull

    @property
    def run_off(self) -> float:
        """Static tension at the drive's run-off [N]: the take-up's, or what keeps the mean of a fixed loop.

        S_off = T   (weight at the head)        S_off = T - D/2 - W_return   (weight at the tail)

        D is the step of the tension at the tail pulley, W_return what the return strand adds on the way there. Both
        sides of a tail pulley on a carriage pull at it: S_before + S_after = 2 T = M g.
        """
        if self.weight_at_tail:
            return self.takeup_tension - self.tail_step / 2 - self.back.rise
        return self.takeup_tension - self._mean_rise if self.fixed_length else self.takeup_tension

    @property
    def _mean_rise(self) -> float:
        """Mean tension of the loop over that at the run-off [N]."""
        before = self.back.rise + self.tail_step
        rises = self.back.mean_rise * self.back.length + (before + self.carry.mean_rise) * self.carry.length
        return rises / (self.back.length + self.carry.length)

    @property
    def mean_tension(self) -> float:
        """Mean static tension of the loop [N]."""
        return self.run_off + self._mean_rise

    @property
    def keeps_run_off(self) -> bool:
        """True if a weight at the head keeps the tension at the run-off."""
        return not (self.fixed_length or self.weight_at_tail)

    @property
    def run_on(self) -> float:
        """Static tension at the drive's run-on [N]."""
        return self.run_off + self.static_resistance

    def static_ends(self, strand: int) -> tuple[float, float]:
        """Static tension at the upstream and the downstream end of a strand [N]."""
        if strand == RETURN:
            return self.run_off, self.run_off + self.back.rise
        return self.run_on - self.carry.rise, self.run_on

    def static(self, strand: int, x: ArrayLike) -> FloatArray:
        """Static tension at fractions x of a strand [N]."""
        start, end = self.static_ends(strand)
        part = self.strand(strand)
        if part.even:
            return start + (end - start) * np.asarray(x)
        return start + lanes.interpolated(np.asarray(x) * part.length, part.marks, part.rises)

    def strand(self, which: int) -> Strand:
        """The return or the carry strand."""
        return self.back if which == RETURN else self.carry

    def wave_speed(self, which: int) -> float:
        """Wave speed of a strand [m/s]; the mean over its length, where the load has steps."""
        if self.by_length:
            return self.strand(which).length / self.transit(which)
        return wave.wave_speed(self.stiffness, self.strand(which).line_mass)

    def impedance(self, which: int) -> float:
        """Impedance of a strand [N*s/m]; the largest one, where the load has steps."""
        part = self.strand(which)
        return wave.impedance(self.stiffness, max(part.masses) if self.by_length else part.line_mass)

    def transit(self, which: int) -> float:
        """Travel time of a wave along a strand [s]."""
        if self.by_length:
            part = self.strand(which)
            speeds = [wave.wave_speed(self.stiffness, mass) for mass in part.masses]
            return lanes.number(np.sum(np.diff(part.marks) / np.array(speeds)))
        return self.strand(which).length / self.wave_speed(which)

    @property
    def contour_time(self) -> float:
        """Time for a wave once round the whole belt [s]."""
        return self.transit(CARRY) + self.transit(RETURN)

    @property
    def centrifugal_at_speed(self) -> float:
        """Centrifugal tension of the bare belt at rated speed [N]."""
        return self.belt_line_mass * self.speed**2


@kept_for(64)
def belt_line(spec: Conveyor, scene: ConveyorScene) -> BeltLine:
    """The conveyor in the load state of a scene; a start has the start's resistance."""
    return belt_line_filled(spec, scene, filling_of(spec, scene))


def belt_line_filled(spec: Conveyor, scene: ConveyorScene, filling: Filling) -> BeltLine:
    """The conveyor in a scene with the material of a filling on its pieces."""
    given = spec.resistance
    extra, drum = extra_forces(spec, load_line_mass(spec)), spec.main_drive.drum
    winds = keeps_length(spec, scene)
    return BeltLine(
        gravity=spec.gravity,
        speed=spec.speed,
        stiffness=belt_stiffness(spec),
        belt_line_mass=spec.belt.mass,
        carry=_carry_strand(spec, scene, filling, extra),
        back=_return_strand(spec, scene, extra),
        tail_force=(given.secondary_force or 0.0) + extra.at_tail(bool(filling[0])),
        drive_mass=sum(drive_masses(spec, scene).values()),
        tail_mass=filled(spec.tail_drum.inertia) * 4 / (spec.tail_drum.diameter or drum.diameter) ** 2,
        fixed_length=spec.takeup.type == "rigid" or winds,
        takeup_tension=_set_tension(spec, scene, filling) if winds else kept_tension(spec),
        grip_exponent=drum.friction * drum.wrap if drum.friction is not None else None,
        breaking_force=breaking_force(spec),
        slack_sag=spec.checks.slack_sag,
        speed_share=given.speed_share,
        weight_at_tail=spec.takeup.pulls_tail,
        by_length=spec.load.loading_points is not None,
    )


def kept_tension(spec: Conveyor) -> float:
    """Tension that the take-up keeps, or has when it is set [N]; that of a winch deviates within its dead band."""
    return spec.takeup.tension * (1 + (spec.takeup.deviation or 0.0))


def keeps_length(spec: Conveyor, scene: ConveyorScene) -> bool:
    """Whether a winch stands still in a scene: it is too slow for starts and stops."""
    return spec.takeup.type == "winch" and not isinstance(scene, Run)


def _set_tension(spec: Conveyor, scene: ConveyorScene, filling: Filling) -> float:
    """Mean tension of a loop whose winch has set it in steady running [N]; drives at the tail take no share yet."""
    return belt_line_filled(spec, steady(scene), filling).mean_tension


@dataclass(frozen=True, slots=True)
class OfPiece:
    """A length of a strand in numbers: its length [m], resistance and the tension that gravity asks for [N], mass of
    belt and load and of the idlers per length [kg/m], weight on one idler pitch [N], None when it is not given."""

    length: float
    friction: float
    climb: float
    on_it: float
    idlers: float
    span_weight: float | None


def carried_on(spec: Conveyor, scene: ConveyorScene, piece: Piece, names: Names, extra: Extra) -> OfPiece:
    """A length of the carrying strand with the material of some loading points on it."""
    load, part = load_line_mass(spec, names), piece.part
    pitch = part.carry_pitch or spec.idlers.carry.pitch
    special = extra.along("carry", load > 0) / spec.route.span + force_in_zones(spec, piece, names) / piece.length
    return _of_piece(spec, scene, piece, spec.belt.mass + load, (spec.idlers.carry, pitch, special))


def _of_piece(
    spec: Conveyor, scene: ConveyorScene, piece: Piece, on_it: float, under: tuple[IdlerRow, float | None, float]
) -> OfPiece:
    row, pitch, special = under  # special resistance per length
    carries = row is spec.idlers.carry
    cosine = 1.0 if spec.route.inclination == "small_angle" else piece.part.cosine
    idlers = row.mass_at(pitch)
    main = idler_friction(spec, _scene_factor(spec, scene), carries, on_it, idlers, cosine, pitch)
    climb = (1 if carries else -1) * on_it * spec.gravity * piece.lift
    span = on_it * cosine * spec.gravity * pitch if pitch is not None else None
    return OfPiece(piece.length, (main + special) * piece.length, climb, on_it, idlers, span)


def _carry_strand(spec: Conveyor, scene: ConveyorScene, filling: Filling, extra: Extra) -> Strand:
    """The carrying strand, summed up piece by piece."""
    return _strand([carried_on(spec, scene, *one, extra) for one in zip(pieces(spec), filling, strict=True)])


def _return_strand(spec: Conveyor, scene: ConveyorScene, extra: Extra) -> Strand:
    """The return strand, summed up section by section."""
    row, along = spec.idlers.back, extra.along("return", loaded=False) / spec.route.span
    parts = sections(spec)[::-1]
    return _strand([_of_piece(spec, scene, one, spec.belt.mass, (row, row.pitch, along)) for one in parts])


def _strand(parts: Sequence[OfPiece]) -> Strand:
    marks, friction, climb = [0.0], [0.0], [0.0]
    for part in parts:
        marks.append(marks[-1] + part.length)
        friction.append(friction[-1] + part.friction)
        climb.append(climb[-1] + part.climb)
    masses = [part.on_it + part.idlers for part in parts]
    spans = [part.span_weight for part in parts if part.span_weight is not None]
    mean = sum(mass * part.length for mass, part in zip(masses, parts, strict=True)) / marks[-1]
    known = len(spans) == len(parts)
    return Strand(
        masses[0] if lanes.alike(masses) else mean,
        max(spans) if known else None,
        tuple(marks),
        tuple(friction),
        tuple(climb),
        tuple(masses),
        tuple(part.on_it / (part.on_it + part.idlers) for part in parts),
        tuple(spans) if known else (),
    )


def _scene_factor(spec: Conveyor, scene: ConveyorScene) -> float:
    """Idler resistance in a scene relative to that in steady running."""
    if isinstance(scene, Start):
        return filled(spec.resistance.start_factor)
    return stop_factor(spec) if isinstance(scene, Stopping) else 1.0


def stop_factor(spec: Conveyor) -> float:
    """Resistance during a stop relative to that in motion; the assumption fills it in where a file has stops."""
    given = spec.resistance.stop_factor
    return 1.0 if given is None else given


def grips(spec: Conveyor) -> dict[str, float]:
    """mu alpha of every drum whose friction is given [1]."""
    drums = {name: drive.drum for name, drive in spec.all_drives.items()}
    return {name: drum.friction * drum.wrap for name, drum in drums.items() if drum.friction is not None}


def special_resistance(spec: Conveyor, scene: ConveyorScene) -> float:
    """Forces with a name along both strands and those of loading points [N]."""
    extra, filling = extra_forces(spec, load_line_mass(spec)), filling_of(spec, scene)
    loaded = zip(pieces(spec), filling, strict=True)
    carry = sum(extra.along("carry", bool(names)) * piece.length for piece, names in loaded) / spec.route.span
    return carry + forces_in_zones(spec, filling) + extra.along("return", loaded=False)


def belt_stiffness(spec: Conveyor) -> float:
    """Tensile stiffness EA of the belt [N]."""
    belt = spec.belt
    return belt.stiffness if belt.stiffness is not None else filled(belt.modulus) * filled(belt.width)


def breaking_force(spec: Conveyor) -> float | None:
    """Breaking force of the whole belt [N], when the file gives it."""
    belt = spec.belt
    if belt.strength is not None:
        return belt.strength * filled(belt.width)
    return belt.breaking_force


def drive_masses(spec: Conveyor, scene: ConveyorScene) -> dict[str, float]:
    """Motors, couplings and drum of each drive reduced to the rim in a scene [kg]."""
    shafts, starts = braked_shafts(spec, scene), isinstance(scene, Start)
    drives = spec.all_drives.items()
    return {name: drive_mass(drive, driven=name in shafts, starts=starts) for name, drive in drives}


def drive_mass(drive: Drive, driven: bool = False, *, starts: bool = False) -> float:
    """Motors, couplings and drum of a drive reduced to the rim [kg].

        m = J i^2 eta/R^2 + ...   where the motor drives        J i^2/(eta R^2) + ...   where the belt drives it

    With a brake on its shaft the motor is `driven`: the torque through the gear is what the brake takes less what the
    rotor gives, M - J e. Before the brake is closed the rotor still drives: the belt is then braked by more than this
    says, by a part (1/eta - eta) J i^2/R^2 of the moving mass at most, and comes to rest the earlier.

    In a start a fluid coupling accelerates only what is behind it: its turbine wheel, which is the coupling inertia of
    the file. In other scenes the rotor counts too.
    """
    rotor = 0.0 if starts and drive.fluid_coupling is not None else filled(drive.motor.inertia)
    per_motor = rotor + filled(drive.coupling_inertia)
    efficiency = filled(drive.gear.efficiency)
    return inertia.reduced_drive_mass(
        drive.motor.count * per_motor,
        drive.gear.ratio,
        1 / efficiency if driven else efficiency,
        filled(drive.drum.inertia),
        drive.drum.diameter / 2,
    )


def turns(drive: Drive) -> float:
    """Turn of the motor shaft per travel of the belt, i/R with the diameter as it is [rad/m]."""
    return drive.turns


@kept_for(64)
def drive_force(drive: Drive) -> float:
    """Mean starting force of all motors of a drive at the rim [N]."""
    torque = drive.mean_torque
    count, ratio = drive.motor.count, drive.gear.ratio
    return motor.rim_force(count * torque, ratio, filled(drive.gear.efficiency), drive.drum.diameter / 2)


def starting_force(spec: Conveyor) -> float:
    """Mean starting force of all drives at the rim [N]."""
    return sum(drive_force(drive) for drive in spec.all_drives.values())


def braking_force(spec: Conveyor) -> float:
    """Force of all drives at the rim, with the mean starting torque of their motors and losses that help [N]."""
    return sum(drive_force(one) / filled(one.gear.efficiency) ** 2 for one in spec.all_drives.values())


def loop_masses(line: BeltLine, imposed: bool) -> LoopMasses:
    """The loop as masses on a line, its drum driven by a force or at an imposed speed."""
    return LoopMasses(
        return_mass=line.back.line_mass * line.back.length,
        carry_mass=line.carry.line_mass * line.carry.length,
        tail_mass=line.tail_mass,
        drive_mass=line.drive_mass,
        return_compliance=line.back.length / line.stiffness,
        carry_compliance=line.carry.length / line.stiffness,
        fixed_length=line.fixed_length,
        imposed_speed=imposed,
    )
