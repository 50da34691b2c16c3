"""A conveyor in one scene as SI numbers: strands, resistances, static tensions, drive.

The belt runs drive run-off -> return strand -> tail drum -> carry strand -> drive run-on. Static tensions rise
along it by the idlers' resistance, by the lift of belt and load, and at the tail by the secondary resistances when
these are given as a force.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ptmcalc.base.memory import kept_for, remembered
from ptmcalc.contract.effect import Criterion
from ptmcalc.laws import belt_modes, capstan, inertia, loop_bounds, motor, start_profile, wave
from ptmcalc.laws.loop_bounds import CARRY, RETURN, LoopMasses
from ptmcalc.machines.conveyor.brakes import braked_shafts
from ptmcalc.machines.conveyor.keys.route import Section
from ptmcalc.machines.conveyor.loads import FREQUENCIES
from ptmcalc.machines.conveyor.resistances import extra_forces, filled, idler_friction
from ptmcalc.machines.conveyor.spec import Conveyor, ConveyorScene, Drive, Start, Stopping
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
        """Static tension at the drive's run-off [N]: the take-up's, or what keeps the mean of a fixed loop."""
        if not self.fixed_length:
            return self.takeup_tension
        before = self.back.rise + self.tail_step
        rises = self.back.mean_rise * self.back.length + (before + self.carry.mean_rise) * self.carry.length
        return self.takeup_tension - rises / (self.back.length + self.carry.length)

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
        """Wave speed of a strand [m/s]."""
        return wave.wave_speed(self.stiffness, self.strand(which).line_mass)

    def impedance(self, which: int) -> float:
        """Impedance of a strand [N*s/m]."""
        return wave.impedance(self.stiffness, self.strand(which).line_mass)

    def transit(self, which: int) -> float:
        """Travel time of a wave along a strand [s]."""
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


def belt_line_filled(spec: Conveyor, scene: ConveyorScene, filling: Sequence[bool]) -> BeltLine:
    """The conveyor in a scene with the sections of `filling` loaded."""
    g, route = spec.gravity, spec.route
    flat = route.inclination == "small_angle"
    given = spec.resistance
    grown = 1.0
    if isinstance(scene, Start):
        grown = filled(given.start_factor)
    elif isinstance(scene, Stopping):
        grown = stop_factor(spec)

    parts = route.parts
    cosines = [1.0 if flat else part.cosine for part in parts]
    loads = [load_line_mass(spec) if full else 0.0 for full in filling]
    extra, span = extra_forces(spec, load_line_mass(spec)), route.span

    def strand(carries: bool) -> Strand:
        uphill = 1 if carries else -1
        row, over = (spec.idlers.carry, "carry") if carries else (spec.idlers.back, "return")
        marks, friction, climb, masses, goes, spans = [0.0], [0.0], [0.0], [], [], []
        for part, cosine, load in zip(parts[::uphill], cosines[::uphill], loads[::uphill], strict=True):
            on_it = spec.belt.mass + (load if carries else 0.0)
            pitch = (part.carry_pitch if carries else None) or row.pitch
            idlers = row.mass_at(pitch)
            main = idler_friction(spec, grown, carries, on_it, idlers, cosine, pitch)
            marks.append(marks[-1] + part.length)
            special = extra.along(over, carries and load > 0) / span
            friction.append(friction[-1] + (main + special) * part.length)
            climb.append(climb[-1] + uphill * on_it * g * part.lift)
            masses.append(on_it + idlers)
            goes.append(on_it / (on_it + idlers))
            if pitch is not None:
                spans.append(on_it * cosine * g * pitch)
        mean = sum(mass * part.length for mass, part in zip(masses, parts[::uphill], strict=True)) / marks[-1]
        known = len(spans) == len(parts)
        masses_all_one = lanes.alike(masses)
        return Strand(
            masses[0] if masses_all_one else mean,
            max(spans) if known else None,
            tuple(marks),
            tuple(friction),
            tuple(climb),
            tuple(masses),
            tuple(goes),
            tuple(spans) if known else (),
        )

    drum, shafts = spec.main_drive.drum, braked_shafts(spec, scene)
    return BeltLine(
        gravity=g,
        speed=spec.speed,
        stiffness=belt_stiffness(spec),
        belt_line_mass=spec.belt.mass,
        carry=strand(carries=True),
        back=strand(carries=False),
        tail_force=(given.secondary_force or 0.0) + extra.at_tail(filling[0]),
        drive_mass=sum(drive_mass(drive, driven=name in shafts) for name, drive in spec.all_drives.items()),
        tail_mass=filled(spec.tail_drum.inertia) * 4 / (spec.tail_drum.diameter or drum.diameter) ** 2,
        fixed_length=spec.takeup.type == "rigid",
        takeup_tension=spec.takeup.tension,
        grip_exponent=drum.friction * drum.wrap if drum.friction is not None else None,
        breaking_force=breaking_force(spec),
        slack_sag=spec.checks.slack_sag,
        speed_share=given.speed_share,
    )


def stop_factor(spec: Conveyor) -> float:
    """Resistance during a stop relative to that in motion; the assumption fills it in where a file has stops."""
    given = spec.resistance.stop_factor
    return 1.0 if given is None else given


def is_plain(spec: Conveyor, scene: ConveyorScene) -> bool:
    """Whether a scene is a start of a uniform belt on one slope by one drive."""
    return not plainness(spec, scene).exceeded


SPEED_SHARE_THRESHOLD = 0.05
"""Share of the idler resistance that is proportional to the speed [1] from which on it is simulated. An engineering
choice. Below it the error bar is at most 15 % of the idler resistance in a start; in other scenes it is 60 %, and 10 %
of the lowest tensions and the worst traction of a stop."""


def delay_lines_do(spec: Conveyor, scene: Start) -> bool:
    """Whether strands that are pure delays carry all of a start: nothing sticks, turns back or damps on the way, and no
    weight swings."""
    steady = spec.resistance.speed_share < SPEED_SHARE_THRESHOLD
    damped = spec.belt.damping is not None and spec.effects.get("belt_damping") != "off"
    slides = scene.belt == "frozen" and not (spec.effects.get("coulomb_idlers") != "off" and thrown_back(spec, scene))
    light = not spec.takeup_weight or takeup_inertia(spec, scene) < 1
    return is_plain(spec, scene) and slides and light and steady and not damped


def takeup_inertia(spec: Conveyor, scene: Start) -> float:
    """Inertia of the take-up weight in a start relative to the threshold of its effect.

        max(kappa/0.1, (a_0/g)/0.03),   kappa = T_0 w_1/(2 g Z_2),   a_0 = |F|/m_drive

    **Range** a gravity take-up with the weight that its tension requires.
    **Error** an estimate: w_1 is a lower bound of the lowest natural frequency.
    **Source** take-up weight on two falls; thresholds are an engineering choice.
    """
    line = belt_line(spec, scene)
    return inertia_of_weight(spec, line, start_case(spec, scene).excess)


def inertia_of_weight(spec: Conveyor, line: BeltLine, force: float) -> float:
    """`takeup_inertia` for a force on the drive drum alone [N]."""
    kappa, drum = takeup_numbers(spec, line, force)
    return max(kappa / 0.1, drum / spec.gravity / 0.03)


def takeup_numbers(spec: Conveyor, line: BeltLine, force: float) -> tuple[float, float]:
    """kappa [1], and the acceleration of the drum alone under a force [m/s^2]."""
    slowest = math.pi / (2 * line.contour_time)
    kappa = line.takeup_tension * slowest / (2 * spec.gravity * line.impedance(RETURN))
    return kappa, force / line.drive_mass


_SHARP = 0.75
"""Rise of an imposed speed relative to the longest period of the waves [1] from which on no part of the belt turns
back. Calibrated: none of 600 random belts turned back above 0.57. A larger value simulates stick-slip more often; a
smaller one loses the safety."""


def grips(spec: Conveyor) -> dict[str, float]:
    """mu alpha of every drum whose friction is given [1]."""
    drums = {name: drive.drum for name, drive in spec.all_drives.items()}
    return {name: drum.friction * drum.wrap for name, drum in drums.items() if drum.friction is not None}


def thrown_back(spec: Conveyor, scene: Start) -> bool:
    """Whether an imposed speed rises so sharply that waves may turn some of the belt back.

        t_rise w_1/(2 pi) < 0.75

    **Range** one drive; a force never turns the belt back that it starts.
    **Error** w_1 is a lower bound. A uniform loop turns back below 0.39 (ramp), 0.5 (cosine); of 600 random ones none
    did above 0.57.
    **Source** residual of a rise at the free end of a quarter-wave, 4/pi times that of an oscillator.
    """
    case = start_case(spec, scene)
    if not case.imposed_speed:
        return False
    return case.rise_time * lowest_frequency(case) < _SHARP * 2 * math.pi


DAMPING_THRESHOLD = 0.001
"""Change of the complex frequency of the slowest wave [1] from which on damping is simulated. An engineering choice: an
oscillation loses 0.3 %, the fifth echo 3 %. Below it the error bar is at most 19 % of the amplitude times (1 + n)^(1/2)
for n contour times."""


TRAVEL_THRESHOLD = 0.03
"""Belt speed relative to that of its slowest wave [1] from which on convection is simulated. An engineering choice;
theory of moving strings requires no smaller one. Below it the error bar is at most 12 % of half the tension range in a
start, 30 % in a stop and 60 % in a jam."""


def belt_travel(line: BeltLine) -> float:
    """Speed of the belt over that of its slowest wave, v/c."""
    return line.speed / wave.wave_speed(line.stiffness, max(*line.carry.masses, *line.back.masses))


def damping_change(spec: Conveyor, line: BeltLine) -> float:
    """Change by damping of the frequency of a wave as slow as the slowest of a uniform loop, w = pi/(2 T)."""
    return spec.belt.damping.change(math.pi / (2 * line.contour_time)) if spec.belt.damping else 0.0


@kept_for(64)
def slides_at_rest(spec: Conveyor, scene: Start) -> Criterion:
    """Whether the drum cannot hold the belt that lies with the friction of its running frozen in it.

        U_0 = S_tight/(S_slack exp(mu alpha)),   0 without friction given, or where slip is forced off

    Such a belt slides back on its drum before it starts, and the friction of its idlers turns round.

    **Range** one drive.
    **Error** exact.
    **Source** Euler-Eytelwein.
    """
    line = belt_line(spec, scene)
    used = 0.0
    if line.grip_exponent is not None and spec.effects.get("slip") != "off":
        tight, slack = max(line.run_on, line.run_off), min(line.run_on, line.run_off)
        used = float(capstan.slip_utilisation(tight, slack, 0.0, line.grip_exponent))
    meaning = "traction utilisation at standstill: at 1 the belt slips on its pulley before it starts"
    return Criterion("U_0", used, 1.0, meaning, "laws.capstan")


@kept_for(64)
def plainness(spec: Conveyor, scene: ConveyorScene) -> Criterion:
    """Whether a solver of the plain start can take the machine.

        n = slopes and loads along a strand + drives + 1 for an aborted start, + 1 for a motor's curve or a table

    A relaxed belt is taken as one with the running friction frozen in it; the effect `coulomb_idlers` says by how much.

    **Range** any start.
    **Error** exact: a count.
    **Source** the plain start has one of each, n = 2.
    """
    line = belt_line(spec, scene)
    parts = max(1 if strand.even else len(strand.masses) for strand in (line.carry, line.back))
    unusual = isinstance(scene, Start) and (scene.aborted is not None) + (scene.profile.shape in ("curve", "table"))
    count = parts + len(spec.all_drives) + unusual
    meaning = "slopes, drives, aborted starts, curves and tables: 2 for one slope and one drive"
    return Criterion("n", count, 3, meaning, "count")


def filling_of(spec: Conveyor, scene: ConveyorScene) -> list[bool]:
    """Which sections carry load in a scene."""
    return [_is_loaded(scene, part) for part in spec.route.parts]


def _is_loaded(scene: ConveyorScene, part: Section) -> bool:
    """Whether a section carries load in a scene."""
    return {"full": True, "empty": False, "uphill": part.lift > 0, "downhill": part.lift < 0}[scene.load]


def load_line_mass(spec: Conveyor) -> float:
    """Load per length of the full carry strand [kg/m]."""
    if spec.load.mass is not None:
        return spec.load.mass
    return filled(spec.load.capacity) / spec.speed


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


def drive_mass(drive: Drive, driven: bool = False) -> float:
    """Motors, couplings and drum of a drive reduced to the rim [kg].

        m = J i^2 eta/R^2 + ...   where the motor drives        J i^2/(eta R^2) + ...   where the belt drives it

    With a brake on its shaft the motor is `driven`: the torque through the gear is what the brake takes less what the
    rotor gives, M - J e. Before the brake is closed the rotor still drives: the belt is then braked by more than this
    says, by a part (1/eta - eta) J i^2/R^2 of the moving mass at most, and comes to rest the earlier.
    """
    per_motor = drive.motor.inertia + filled(drive.coupling_inertia)
    efficiency = filled(drive.gear.efficiency)
    return inertia.reduced_drive_mass(
        drive.motor.count * per_motor,
        drive.gear.ratio,
        1 / efficiency if driven else efficiency,
        filled(drive.drum.inertia),
        drive.drum.diameter / 2,
    )


@kept_for(64)
def drive_force(drive: Drive) -> float:
    """Mean starting force of all motors of a drive at the rim [N]."""
    torque = drive.motor.mean_torque
    count, ratio = drive.motor.count, drive.gear.ratio
    return motor.rim_force(count * torque, ratio, filled(drive.gear.efficiency), drive.drum.diameter / 2)


def starting_force(spec: Conveyor) -> float:
    """Mean starting force of all drives at the rim [N]."""
    return sum(drive_force(drive) for drive in spec.all_drives.values())


@dataclass(frozen=True, slots=True)
class StartCase:
    """A start as numbers: the line, what the drive imposes, and the rigid body's answer.

    The drum is held (by friction, brake or backstop) until the drive's force exceeds the static resistance, so the
    force over it, `excess`, starts from 0 under a ramp and at once under a step.
    """

    line: BeltLine
    masses: LoopMasses
    shape: start_profile.Shape
    rise_time: float
    imposed_speed: bool
    available_force: float
    acceleration: float
    held: float
    window: float
    damped: bool = False
    """whether the belt damps: its waves are those of an elastic one at most, and may be less"""

    @property
    def rise(self) -> float:
        """How long force or speed still rise after the belt is released, within the window [s]."""
        return min(self.rise_time - self.held, self.window)

    @property
    def moves(self) -> bool:
        """Whether the drive can move the belt at all."""
        return self.imposed_speed or self.available_force > self.line.static_resistance

    @property
    def excess(self) -> float:
        """Largest force of the drive over the static resistance that comes to act [N], M a."""
        return self.acceleration * self.masses.total_mass

    def force(self, time: FloatArray) -> FloatArray:
        """Force over the static resistance at times after the belt is released [N]."""
        full = start_profile.rise(self.shape, self.rise_time, time + self.held)
        return np.maximum(self.available_force * full - self.line.static_resistance, 0.0)

    def drum_speed(self, time: FloatArray) -> FloatArray:
        """Imposed speed of the drum [m/s]."""
        return self.line.speed * start_profile.rise(self.shape, self.rise_time, time)

    def drum_acceleration(self, time: FloatArray) -> FloatArray:
        """Rate of the imposed speed of the drum [m/s^2]."""
        return self.line.speed * start_profile.rise_rate(self.shape, self.rise_time, time)

    def phases(self, lowest_frequency: float) -> tuple[start_profile.Phase, ...]:
        """Bounds on the answer of every mode of at least this frequency [rad/s], relative to the plateau's.

        Of a torque that rises through the static resistance only the part above it acts, and only until the rated
        speed is reached: a part of a ramp is a ramp, a part of anything else is only known to rise. A resistance that
        drives acts at once, as a step.
        """
        if not self.moves:
            return (start_profile.Phase(0.0, 0.0, 0.0),)
        if self.imposed_speed or self.shape == start_profile.STEP:
            return start_profile.phases(self.shape, self.imposed_speed, self.rise_time, lowest_frequency)
        if self.shape not in (start_profile.STEP, start_profile.RAMP) and self.rise < self.rise_time:
            return (start_profile.Phase(0.0, 1.0, 1.0),)
        at_once = max(-self.line.static_resistance / self.excess, 0.0)
        rising = start_profile.phases(self.shape, False, self.rise, lowest_frequency)
        return tuple(
            start_profile.Phase(
                at_once + (1 - at_once) * phase.low,
                at_once + (1 - at_once) * phase.high,
                at_once + (1 - at_once) * phase.stray,
            )
            for phase in rising
        )


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


@kept_for(64)
def start_case(spec: Conveyor, scene: Start) -> StartCase:
    """A start of this conveyor.

    The window of a torque start ends when the rigid body reaches the rated speed; that of an imposed speed four
    contour times after the end of the profile, which is a period of the lowest mode of a uniform loop.
    """
    line = belt_line(spec, scene)
    profile = scene.profile
    imposed = profile.imposes_speed
    masses = loop_masses(line, imposed)
    rise_time = profile.rise_time
    available = starting_force(spec)
    if imposed:
        acceleration = line.speed * start_profile.peak_rate(profile.rise, rise_time)
        window = rise_time + 4 * line.contour_time
        held = 0.0
    else:
        acceleration = held = window = 0.0
        if available > line.static_resistance:
            rise, resistance = profile.rise, line.static_resistance
            held = float(start_profile.time_of_share(rise, rise_time, resistance / available))
            needed = masses.total_mass * line.speed
            window = float(start_profile.time_to_momentum(rise, rise_time, available, resistance, held, needed))
            reached = available * float(start_profile.rise(profile.rise, rise_time, held + window))
            acceleration = (reached - line.static_resistance) / masses.total_mass
    damped = spec.belt.damping is not None and spec.effects.get("belt_damping") != "off"
    return StartCase(line, masses, profile.rise, rise_time, imposed, available, acceleration, held, window, damped)


@kept_for(64)
def lowest_frequency(case: StartCase) -> float:
    """Lower bound of every natural frequency of the belt in a start [rad/s]."""
    return loop_bounds.lowest_frequency_bound(case.masses)


@remembered(64)
def natural_frequencies(masses: LoopMasses, takeup_mass: float) -> tuple[float, ...]:
    """The lowest natural frequencies of a belt [rad/s], which no tension and no resistance changes."""
    return tuple(belt_modes.natural_frequencies(masses, takeup_mass, FREQUENCIES).tolist())


def start_duration(case: StartCase) -> float:
    """Duration of the start of the rigid body, from switching on [s]; infinite when it cannot move."""
    if case.imposed_speed:
        return case.rise_time
    return case.held + case.window if case.moves else math.inf
