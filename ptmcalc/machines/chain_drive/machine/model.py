"""A chain drive as numbers: strands, tensions at rest in steady motion, masses, damping, and the chain as waves see it.

The chain is followed from the run-off of the driving sprocket: return (slack) strand, tail or driven sprocket, working
(tight) strand, run-on.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base.memory import remembered
from ptmcalc.base.span import KeyPath
from ptmcalc.laws import belt_modes, chain_selection, held_strands, inertia, motor, sag, sprocket
from ptmcalc.laws.held_strands import HeldStrands
from ptmcalc.laws.loop_bounds import LoopMasses
from ptmcalc.machines.chain_drive.machine.layout import ConveyorLayout, TwoShafts
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, ChainScene, Drive
from ptmcalc.numerics.harmonic import parts

FloatArray = NDArray[np.float64]

CRANKED = 0.8
"""Breaking load of a cranked link relative to that of the chain [1] (ACA: about 20 % less). All safety factors of a
chain with such a link are proportional to it."""
ROWS = {1: 1.0, 2: 1.7, 3: 2.5, 4: 3.3, 5: 3.9, 6: 4.6}
"""Capacity of several rows of roller chain relative to one row [1] (ACA), by number of rows. Rows above the sixth, for
which no source is known, do not count. The transmitted power is proportional to it."""
MODES = 12
"""Natural frequencies that are computed by default. A numerical choice: more find resonances at higher orders and take
longer."""
_LIGHT = 1e-12
"""Mass of the slack strand between two shafts relative to the tight one [1]: the strand is an elastic spring without
mass. A numerical choice, as 0 would divide by 0. A larger value adds inertia that does not exist."""


_CLOSEST = 1e-6
"""Length of a strand relative to the centre distance when a search overlaps the shafts [1]. A numerical choice: it
keeps the length above 0 where a file would be rejected. No file reaches it."""


def filled(value: float | None) -> float:
    """A value the file or an assumption has given by now."""
    assert value is not None, "assumptions are filled in before anything is computed"
    return value


# -- chain and sprockets --------------------------------------------------------------------------------------------


def tension_key(spec: ChainDrive) -> KeyPath:
    """What of the file keeps the chain taut."""
    return ("layout", "takeup", "tension") if isinstance(spec.layout, ConveyorLayout) else ("layout", "slack_sag")


def stiffness(spec: ChainDrive) -> float:
    """EA of a strand, all its chains together [N]."""
    chain = spec.chain
    one = chain.stiffness if chain.stiffness is not None else filled(chain.modulus) * filled(chain.section)
    return chain.count * one


def breaking_load(spec: ChainDrive) -> float:
    """Of a strand, all its chains together; a cranked link takes a fifth of it [N]."""
    cranked = isinstance(spec.layout, TwoShafts) and spec.layout.cranked_link == "yes"
    return spec.chain.count * spec.chain.breaking_load * (CRANKED if cranked else 1.0)


def tail_teeth(spec: ChainDrive) -> int:
    """Teeth of the other sprocket."""
    if isinstance(spec.layout, TwoShafts):
        return spec.layout.driven.teeth
    return spec.layout.tail.teeth if spec.layout.tail.teeth is not None else spec.sprocket.teeth


def radius(spec: ChainDrive) -> float:
    """Radius through the pins on the driving sprocket [m]."""
    return sprocket.pitch_radius(spec.chain.pitch, spec.sprocket.teeth)


def mean_arm(spec: ChainDrive) -> float:
    """Way of the chain per angle of the driving sprocket, z p/(2 pi): the arm of its pull on average [m]."""
    return spec.chain.pitch * spec.sprocket.teeth / (2 * math.pi)


def tail_arm(spec: ChainDrive) -> float:
    """The same of the other sprocket [m]."""
    return spec.chain.pitch * tail_teeth(spec) / (2 * math.pi)


def tail_mass(spec: ChainDrive) -> float:
    """Tail sprocket, or driven sprocket with its machine, as a mass that moves with the chain [kg]."""
    own = spec.layout.driven.inertia if isinstance(spec.layout, TwoShafts) else spec.layout.tail.inertia or 0.0
    return own / tail_arm(spec) ** 2


def sprocket_inertia(spec: ChainDrive) -> float:
    """The driving sprocket on its own shaft; 0 where the file leaves it out [kg*m^2]."""
    return spec.sprocket.inertia or 0.0


def motor_side_inertia(spec: ChainDrive) -> float:
    """Rotors and couplings of all motors on the motor shaft [kg*m^2]; 0 without a drive."""
    if spec.drive is None:
        return 0.0
    return spec.drive.motor.count * (filled(spec.drive.motor.inertia) + filled(spec.drive.coupling_inertia))


def gear_side_inertia(spec: ChainDrive) -> float:
    """What a rigid shaft connects with the gear [kg*m^2]: no rotors in front of fluid couplings.

    Of a coupling, `coupling_inertia` is that of the turbine wheel and the brake disc.
    """
    if spec.drive is not None and spec.drive.fluid_coupling is not None:
        return spec.drive.motor.count * filled(spec.drive.coupling_inertia)
    return motor_side_inertia(spec)


def drive_mass(spec: ChainDrive, flow: str) -> float:
    """Motors, couplings and driving sprocket as a mass that moves with the chain, `flow` as in `laws.inertia` [kg].

    Without a `drive` nothing is known of it: it counts as infinite, a sprocket whose speed nothing changes.
    """
    if spec.drive is None:
        return math.inf
    gear = spec.drive.gear
    slow = inertia.inertia_on_slow_shaft(gear_side_inertia(spec), gear.ratio, filled(gear.efficiency), flow)
    return (slow + sprocket_inertia(spec)) / mean_arm(spec) ** 2


def starting_force(spec: ChainDrive) -> float:
    """Mean starting force of all motors at the chain [N]; 0 without a drive."""
    if spec.drive is None:
        return 0.0
    count, gear = spec.drive.motor.count, spec.drive.gear
    return motor.rim_force(count * spec.drive.mean_torque, gear.ratio, filled(gear.efficiency), mean_arm(spec))


# -- strands --------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Strand:
    """A strand: length [m], what moves per length [kg/m], stiffness EA [N], tensions at its beginning and its end [N],
    what friction and gravity take of it [N]."""

    length: float
    line_mass: float
    stiffness: float
    begin: float
    end: float
    resistance: float
    weight: float

    @property
    def mass(self) -> float:
        return self.length * self.line_mass

    @property
    def compliance(self) -> float:
        return self.length / self.stiffness

    def tension(self, x: float) -> float:
        """Static tension at a share of the length from the beginning [N]."""
        return self.begin + x * (self.end - self.begin)


@dataclass(frozen=True, slots=True)
class ChainLine:
    """The strands of a scene, without the centrifugal tension, and what follows from them."""

    back: Strand
    working: Strand
    tail_mass: float
    tail_force: float
    """resistance at the other sprocket: what feeding takes, or the driven machine [N]"""
    chain_mass: float
    """per length, without load [kg/m]"""
    speed: float
    fixed_length: bool
    takeup_mass: float
    tail_pull: float = 0.0
    """what a driven tail pulls in steady motion [N]"""

    @property
    def static_resistance(self) -> float:
        """W: what all drives pull in steady motion, negative where the load drives [N]."""
        return self.head_pull + self.tail_pull

    @property
    def head_pull(self) -> float:
        """What the driving sprocket pulls in steady motion [N]."""
        return self.working.end - self.back.begin

    @property
    def run_off(self) -> float:
        return self.back.begin

    @property
    def run_on(self) -> float:
        return self.working.end

    @property
    def ends(self) -> tuple[float, float, float, float]:
        """Tensions from the run-off on: drive, tail, tail, drive [N]."""
        return self.back.begin, self.back.end, self.working.begin, self.working.end

    @property
    def centrifugal(self) -> float:
        """Tension that the chain has from running round curves [N]."""
        return float(chain_selection.centrifugal_force(self.chain_mass, self.speed))

    @property
    def moving_mass(self) -> float:
        """Everything the driving sprocket moves [kg]."""
        return self.back.mass + self.working.mass + self.tail_mass

    def masses(self, drive: float, imposed_speed: bool) -> LoopMasses:
        """The loop as the laws of waves and modes take it, with the drive as a mass at the chain [kg]."""
        return LoopMasses(
            return_mass=self.back.mass,
            carry_mass=self.working.mass,
            tail_mass=self.tail_mass,
            drive_mass=drive,
            return_compliance=self.back.compliance,
            carry_compliance=self.working.compliance,
            fixed_length=self.fixed_length,
            imposed_speed=imposed_speed,
        )


def load_line_mass(spec: ChainDrive, scene: ChainScene) -> float:
    """Load on the working strand of a conveyor [kg/m]."""
    if isinstance(spec.layout, TwoShafts) or scene.load == "empty":
        return 0.0
    return spec.layout.load if spec.layout.load is not None else filled(spec.layout.capacity) / spec.speed


def chain_line(spec: ChainDrive, scene: ChainScene, grown: float = 1.0) -> ChainLine:
    """The strands of a scene in steady motion, `grown` times the running resistance.

        T_1 = take-up, T_2 = T_1 + W_return, T_3 = T_2 + F - s W, T_4 = T_3 + W_working,   W = W_return + F + W_working

    s is the share of a driven tail, 0 without one; the driving sprocket pulls (1 - s) W = T_4 - T_1.
    """
    if isinstance(spec.layout, TwoShafts):
        return _between_shafts(spec, spec.layout, scene)
    return _conveyor(spec, spec.layout, scene, grown)


def _conveyor(spec: ChainDrive, layout: ConveyorLayout, scene: ChainScene, grown: float) -> ChainLine:
    chain, load, g = spec.chain.mass, load_line_mass(spec, scene), spec.gravity
    given = layout.resistance
    factor = filled(given.turn_factor) * grown
    rubbing = given.load_coefficient if given.load_coefficient is not None else given.coefficient
    level = math.sqrt((layout.length - layout.lift) * (layout.length + layout.lift))  # L cos(beta)
    drag_back = factor * given.coefficient * chain * g * level
    drag_on = factor * (given.coefficient * chain + rubbing * load) * g * level
    down, up = -chain * g * layout.lift, (chain + load) * g * layout.lift
    rises = (drag_back + down, drag_on + up)
    pull = filled(layout.tail.share) * (sum(rises) + given.force) if layout.tail.driven == "on" else 0.0
    jump = given.force - pull  # where the chain passes the tail
    run_off = layout.takeup.tension
    if layout.takeup.type == "screw":  # the mean of both linear courses
        run_off -= (rises[0] / 2 + rises[0] + jump + rises[1] / 2) / 2
    at_tail = run_off + rises[0]
    ea = stiffness(spec)
    return ChainLine(
        back=Strand(layout.length, chain, ea, run_off, at_tail, drag_back, down),
        working=Strand(layout.length, chain + load, ea, at_tail + jump, at_tail + jump + rises[1], drag_on, up),
        tail_mass=tail_mass(spec),
        tail_force=given.force,
        chain_mass=chain,
        speed=spec.speed,
        fixed_length=layout.takeup.type == "screw",
        takeup_mass=0.0 if spec.effects.get("takeup_mass") == "off" else layout.takeup.mass or 0.0,
        tail_pull=pull,
    )


def _between_shafts(spec: ChainDrive, layout: TwoShafts, scene: ChainScene) -> ChainLine:
    """The slack strand hangs through: its weight keeps its tension, and it holds nothing back that is fast."""
    length, chain = span(spec), spec.chain.mass
    slack = sag.tension_at_sag(chain * spec.gravity * length, layout.slack_sag)
    pull = useful_pull(spec) if scene.load == "full" else 0.0
    ea = stiffness(spec)
    return ChainLine(
        back=Strand(length, chain, ea, slack, slack, 0.0, 0.0),
        working=Strand(length, chain, ea, slack + pull, slack + pull, 0.0, 0.0),
        tail_mass=tail_mass(spec),
        tail_force=pull,
        chain_mass=chain,
        speed=spec.speed,
        fixed_length=False,
        takeup_mass=0.0,
    )


# -- two shafts -----------------------------------------------------------------------------------------------------


def useful_pull(spec: ChainDrive) -> float:
    """Pull that the driven machine takes [N]."""
    layout = spec.layout
    assert isinstance(layout, TwoShafts)
    if layout.torque is not None:
        return layout.torque / tail_arm(spec)
    return filled(layout.power) / spec.speed


def pitches(spec: ChainDrive) -> float:
    """Length of the chain in pitches: of two shafts a whole number, of a conveyor 2 L/p + (z_1 + z_2)/2."""
    layout, one, other = spec.layout, spec.sprocket.teeth, tail_teeth(spec)
    if isinstance(layout, ConveyorLayout):
        return 2 * layout.length / spec.chain.pitch + (one + other) / 2
    if layout.pitches is not None:
        return layout.pitches
    exact = chain_selection.chain_pitches(filled(layout.centre_distance), spec.chain.pitch, one, other)
    return chain_selection.even_pitches(exact)


def chain_length(spec: ChainDrive) -> float:
    """Of the whole chain [m]."""
    return pitches(spec) * spec.chain.pitch


def centre_distance(spec: ChainDrive) -> float:
    """Distance of the shafts [m]: of two shafts as given, or for the number of pitches."""
    layout = spec.layout
    if isinstance(layout, ConveyorLayout):
        return layout.length
    return fitted_distance(spec) if layout.centre_distance is None else layout.centre_distance


def fitted_distance(spec: ChainDrive) -> float:
    """Distance of two shafts at which a chain of whole pitches lies straight on both sides [m]."""
    return chain_selection.centre_distance(pitches(spec), spec.chain.pitch, spec.sprocket.teeth, tail_teeth(spec))


def reaches_round(spec: ChainDrive) -> bool:
    """Whether the chain is longer than round sprockets that touch; a search may try another, a file cannot say so."""
    return pitches(spec) > chain_selection.chain_pitches(
        sum(_radii(spec)), spec.chain.pitch, spec.sprocket.teeth, tail_teeth(spec)
    )


def _radii(spec: ChainDrive) -> tuple[float, float]:
    one, other = (sprocket.pitch_radius(spec.chain.pitch, z) for z in (spec.sprocket.teeth, tail_teeth(spec)))
    return min(one, other), max(one, other)


def span(spec: ChainDrive) -> float:
    """Length of a strand between the points where it leaves the sprockets [m]."""
    if isinstance(spec.layout, ConveyorLayout):
        return spec.layout.length
    small, large = _radii(spec)
    distance, step = centre_distance(spec), large - small
    return math.sqrt(max(distance - step, _CLOSEST * distance) * (distance + step))


def wrap(spec: ChainDrive) -> float:
    """Angle over which the chain lies on the smaller sprocket; half a turn on a conveyor [rad]."""
    if isinstance(spec.layout, ConveyorLayout):
        return math.pi
    small, large = _radii(spec)
    distance = centre_distance(spec)
    return chain_selection.wrap_angle(distance, small, large) if distance > large - small else 0.0


def driver_wrap(spec: ChainDrive) -> float:
    """The same of the driving sprocket [rad]."""
    least = wrap(spec)
    return least if spec.sprocket.teeth <= tail_teeth(spec) else 2 * math.pi - least


# -- the chain as waves see it --------------------------------------------------------------------------------------


def lines(line: ChainLine, spec: ChainDrive) -> tuple[parts.Line, ...]:
    """The strands that vibrate, from the run-on against the travel.

    Behind a driven tail, and behind the driven sprocket of two shafts, the return strand takes no part.
    """
    strands = (line.working,) if ends_at_tail(spec) else (line.working, line.back)
    return tuple(parts.Line(one.length, one.line_mass, one.stiffness) for one in strands)


def has_driven_tail(spec: ChainDrive) -> bool:
    """Whether another drive turns the tail."""
    return isinstance(spec.layout, ConveyorLayout) and spec.layout.tail.driven == "on"


def shares_torque(spec: ChainDrive) -> bool:
    """Whether both sprockets may turn apart under a torque, so that it counts how their drives share it."""
    return (
        isinstance(spec.layout, ConveyorLayout)
        and spec.layout.tail.driven == "on"
        and spec.layout.tail.synchronised == "off"
    )


def ends_at_tail(spec: ChainDrive) -> bool:
    """Whether what vibrates ends at the other sprocket."""
    return isinstance(spec.layout, TwoShafts) or has_driven_tail(spec)


def undamped(spec: ChainDrive, scene: ChainScene, drive: float = math.inf) -> parts.Chain:
    """The chain of a scene without damping, its drive as a mass at the chain [kg]."""
    line, none = chain_line(spec, scene), parts.Damping(parts.HYSTERETIC)
    strands = lines(line, spec)
    if isinstance(spec.layout, TwoShafts):
        return parts.Chain(strands, none, parts.FREE, far_mass=line.tail_mass, drive_mass=drive)
    if spec.layout.tail.driven == "on":
        return parts.Chain(strands, none, parts.HELD, drive_mass=drive)
    if line.fixed_length:
        return parts.Chain(strands, none, parts.ON_SPROCKET, joint_mass=line.tail_mass, drive_mass=drive)
    return parts.Chain(
        strands, none, parts.FREE, joint_mass=line.tail_mass, far_mass=line.takeup_mass / 4, drive_mass=drive
    )


def vibrating(spec: ChainDrive, scene: ChainScene, drive: float = math.inf) -> parts.Chain:
    """The chain of a scene with its damping."""
    bare = undamped(spec, scene, drive)
    return parts.Chain(bare.lines, damping(spec, scene), bare.far, bare.joint_mass, bare.far_mass, bare.drive_mass)


def damping(spec: ChainDrive, scene: ChainScene) -> parts.Damping:
    """The damping of the file; a ratio is that of the first natural frequency with the sprocket held."""
    given = spec.chain.damping
    if given.law == parts.ZENER:
        return parts.Damping(parts.ZENER, filled(given.time), filled(given.stiffening))
    if given.law == parts.HYSTERETIC:
        return parts.Damping(parts.HYSTERETIC, share=2 * filled(given.ratio))
    if given.time is not None:
        return parts.Damping(parts.KELVIN_VOIGT, given.time)
    return parts.Damping(parts.KELVIN_VOIGT, 2 * filled(given.ratio) / float(natural_frequencies(spec, scene)[0]))


def natural_frequencies(spec: ChainDrive, scene: ChainScene, drive: float = math.inf, count: int = MODES) -> FloatArray:
    """The lowest natural circular frequencies of the chain, its sprocket held or its drive a mass at the chain, shape
    (count,) [rad/s]."""
    line = chain_line(spec, scene)
    if has_driven_tail(spec):
        return held_frequencies(line.working, drive, count)
    return np.array(of_loop(loop_masses(spec, scene, drive), line.takeup_mass, count))


def loop_masses(spec: ChainDrive, scene: ChainScene, drive: float = math.inf) -> LoopMasses:
    """What vibrates, as the laws of waves and modes take it; an infinite drive imposes the speed.

    Between two shafts that is one strand with the driven machine at its end: the slack one has next to no mass here.
    """
    held = not math.isfinite(drive)
    loop = chain_line(spec, scene).masses(0.0 if held else drive, imposed_speed=held)
    if not isinstance(spec.layout, TwoShafts):
        return loop
    return replace(loop, return_mass=loop.carry_mass * _LIGHT, return_compliance=loop.carry_compliance)


@remembered(64)
def of_loop(loop: LoopMasses, takeup_mass: float, count: int) -> tuple[float, ...]:
    """Natural frequencies by `belt_modes` or `held_strands`, which the prices of all settings ask for over and over."""
    if isinstance(loop, HeldStrands):
        return tuple(held_strands.natural_frequencies(loop, count).tolist())
    return tuple(belt_modes.natural_frequencies(loop, takeup_mass, count).tolist())


def held_frequencies(strand: Strand, drive: float, count: int) -> FloatArray:
    """Of a strand held at its far end: theta = k pi with a held sprocket, theta tan(theta) = m/m_drive else, with the
    mass of the drive, or of a take-up [kg]."""
    transit = math.sqrt(strand.mass * strand.compliance)
    order = np.arange(count)
    if not math.isfinite(drive):
        return np.asarray((order + 1) * np.pi / transit)
    low, high = order * np.pi, order * np.pi + np.pi / 2
    for _ in range(60):
        middle = (low + high) / 2
        above = middle * np.tan(middle) > strand.mass / drive
        low, high = np.where(above, low, middle), np.where(above, middle, high)
    return np.asarray((low + high) / 2 / transit)


def damping_ratios(kind: parts.Damping, frequencies: FloatArray) -> FloatArray:
    """Damping ratios of modes: half the loss factor at their frequencies [1]."""
    modulus = kind.modulus(np.asarray(frequencies, float))
    return np.asarray(modulus.imag / modulus.real / 2)


def drive_of(spec: ChainDrive) -> Drive:
    """The motors and the gear, without which the file has no start."""
    assert spec.drive is not None, "a start without a drive is rejected when the file is read"
    return spec.drive
