"""Teeth that pass while a chain changes its speed, as numbers: the ride, what excites the modes, what bounds them."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ptmcalc.laws import chain_start, held_strands, polygon, sprocket, start_profile
from ptmcalc.laws.loop_bounds import CARRY, RETURN, LoopMasses
from ptmcalc.machines.chain_drive.machine import loops
from ptmcalc.machines.chain_drive.machine.layout import TwoShafts
from ptmcalc.machines.chain_drive.machine.loops import HeldStrands
from ptmcalc.machines.chain_drive.machine.model import (
    FloatArray,
    damping,
    damping_ratios,
    loop_masses,
    natural_frequencies,
    of_loop,
    tail_teeth,
)
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, SpeedRange, Start
from ptmcalc.machines.chain_drive.polygon.excitation import residual
from ptmcalc.machines.chain_drive.starting.motion import StartCase, ratios, start_case, swinging_loop
from ptmcalc.machines.chain_drive.starting.rigid_curve import rigid_start
from ptmcalc.numerics import tooth_passes

_FOR_BOUNDS = 12
"""Modes that are bounded one by one; the rest is bounded together. A numerical choice: more narrow the bound and take
longer."""
_POINTS = 4001
"""Points of time between which a travel is a cubic. A numerical choice: Simpson's rule has an error of fourth order.
More take longer."""
_END = np.ones(1)


@dataclass(frozen=True, slots=True)
class Passing:
    """A change of speed: the loop and its modes, the chain's way, speed and acceleration over time, the fastest speed,
    and the largest acceleration."""

    masses: LoopMasses
    frequencies: FloatArray
    damping_ratios: FloatArray
    way: Callable[[FloatArray], FloatArray]
    speed: Callable[[FloatArray], FloatArray]
    acceleration: Callable[[FloatArray], FloatArray]
    kinks: tuple[float, ...]
    window: float
    fastest: float
    sharpest: float
    started: bool = True
    """False for the teeth alone, without the mean acceleration of the start"""

    def shapes(self, strand: int, x: FloatArray) -> FloatArray:
        """Tensions of the modes at sections, shape (k, n) [kg]."""
        return loops.modal_shapes(self.masses, self.frequencies, strand, x)

    def edges(self, spec: ChainDrive, *leads: float) -> FloatArray:
        """Times between which all is smooth: engagements at the ends with these leads in pitches, and kinks."""
        pitch = spec.chain.pitch
        engaged = [tooth_passes.engagements(lambda t: self.way(t) / pitch, self.window, lead) for lead in leads]
        return tooth_passes.passes(self.window, *engaged, np.array(self.kinks))

    def places(self, spec: ChainDrive, times: FloatArray, middles: FloatArray, lead: float) -> FloatArray:
        """Places in the pitch of an end, from -1/2 after an engagement to 1/2 before the next one."""
        pitch = spec.chain.pitch
        teeth = np.floor(self.way(middles) / pitch + lead)[:, None]
        return np.asarray(self.way(times) / pitch + lead - teeth - 0.5)

    def polygon(self, spec: ChainDrive, times: FloatArray, places: FloatArray, teeth: int) -> FloatArray:
        """Acceleration of an end of the chain against the mean motion of its sprocket [m/s^2]."""
        pitch = spec.chain.pitch
        arm = pitch * teeth / (2 * math.pi)
        mean, turning, angle = self.acceleration(times), self.speed(times) / arm, 2 * np.pi / teeth * places
        turned = polygon.ramped_acceleration(angle, turning, 0.0, pitch, teeth)
        return np.asarray(turned + mean * (sprocket.pitch_radius(pitch, teeth) / arm * np.cos(angle) - 1))

    def stretch(self, spec: ChainDrive, times: FloatArray, places: FloatArray, teeth: int) -> FloatArray:
        """Way by which an end of the chain runs ahead of the mean motion of its sprocket [m]; of a strand held at both
        ends with what its damping adds, the way in the damping time of the first mode."""
        pitch = spec.chain.pitch
        ahead = polygon.polygon_displacement(places, pitch, teeth)
        if not isinstance(self.masses, HeldStrands):
            return ahead
        radius, arm = sprocket.pitch_radius(pitch, teeth), pitch * teeth / (2 * math.pi)
        faster = self.speed(times) * (radius / arm * np.cos(2 * np.pi / teeth * places) - 1)
        return np.asarray(ahead + self.damping_time * faster)

    @property
    def damping_time(self) -> float:
        """2 zeta/w of the first mode: that of a Kelvin-Voigt chain [s]."""
        return 2 * float(self.damping_ratios[0] / self.frequencies[0])

    def follow(self, spec: ChainDrive, teeth: int) -> FloatArray:
        """Most that each mode, and any above them, follows the teeth of a sprocket [m/s^2]."""
        pitch = spec.chain.pitch
        arm = pitch * teeth / (2 * math.pi)
        passes = float(self.way(np.array([self.window]))[0]) / pitch + 2
        high = np.append(self.frequencies, 1e6 * self.frequencies[-1])
        zeta = np.append(self.damping_ratios, self.damping_ratios[-1])
        return chain_start.passing_bound(high, zeta, self.fastest / arm, self.sharpest / arm, pitch, teeth, passes)

    def far_bound(self, spec: ChainDrive) -> float:
        """Most that the teeth of the driven one of two sprockets add at the run-on [N]."""
        if not isinstance(spec.layout, TwoShafts):
            return 0.0
        follow = self.follow(spec, tail_teeth(spec))
        on, far = (self.shapes(CARRY, x)[:, 0] for x in (_END, np.zeros(1)))
        known = float(np.abs(on * far) @ follow[:-1]) / self.masses.belt_mass
        greens = (float(loops.tension_green(self.masses, CARRY, x)) for x in (1.0, 0.0))
        rests = [
            max(green - float(one @ one) / self.masses.belt_mass, 0.0)
            for green, one in zip(greens, (on, far), strict=True)
        ]
        return known + math.sqrt(rests[0] * rests[1]) * float(follow[-2:].max())

    def teeth_bound(self, spec: ChainDrive) -> float:
        """Most that the teeth can add to the run-on tension or take from it, whatever the phase [N].

            sum B_on,k^2 x_k + R x_max      constant tension at the run-off
            (G_on + (G_on G_off)^(1/2)) x_max + 2 (EA/L) u_max      a loop of fixed length, both its ends on the teeth

            G^(1/2) (G_h^(1/2) x_h + G_t^(1/2) x_t) + EA/L (e u_h + u_t)      each strand, held at both sprockets

        Under a torque the ends of both strands count in the bracket: they move each other through the sprockets. x_k
        are the bounds of `chain_start.passing_bound`, x_max the largest of them and of a mode beyond all others.
        """
        if isinstance(self.masses, HeldStrands):
            return self._held_bound(spec, self.masses)
        follow = residual(spec) * self.follow(spec, spec.sprocket.teeth)
        on, off = (float(loops.tension_green(self.masses, *at)) for at in ((CARRY, 1.0), (RETURN, 0.0)))
        if self.masses.fixed_length:
            stretch = 2 * residual(spec) * self.ahead(spec) * self.stiffness
            return (on + math.sqrt(on * off)) * float(follow.max()) + stretch
        at_run_on = self.shapes(CARRY, _END)[:, 0] ** 2 / self.masses.belt_mass
        behind = max(on - float(at_run_on.sum()), 0.0) * float(follow[-2:].max())
        return float(at_run_on @ follow[:-1]) + behind + self.far_bound(spec)

    def _held_bound(self, spec: ChainDrive, strands: HeldStrands) -> float:
        """The same where the teeth of both sprockets move either end of each strand [N]: the larger of both strands."""
        share, worst = residual(spec), 0.0
        head = share * float(self.follow(spec, spec.sprocket.teeth).max())
        tail = float(self.follow(spec, tail_teeth(spec)).max())
        stretch = share * self._most_stretch(spec, spec.sprocket.teeth) + self._most_stretch(spec, tail_teeth(spec))
        roots, pushed = {}, {}
        for strand in (RETURN, CARRY):
            at = (0.0, 1.0) if strand == RETURN else (1.0, 0.0)
            near, far = (math.sqrt(float(loops.tension_green(strands, strand, x))) for x in at)
            roots[strand], pushed[strand] = max(near, far), near * head + far * tail
        for strand in (RETURN, CARRY):
            ends = pushed[strand] if strands.imposed_speed else sum(pushed.values())
            worst = max(worst, roots[strand] * ends + strands.stiffness_of(strand) * stretch)
        return worst

    def _most_stretch(self, spec: ChainDrive, teeth: int) -> float:
        """Most of `stretch` [m]."""
        radius, arm = sprocket.pitch_radius(spec.chain.pitch, teeth), spec.chain.pitch * teeth / (2 * math.pi)
        slower = max(radius / arm - 1, 1 - radius / arm * math.cos(math.pi / teeth))
        return self.ahead(spec, teeth) + self.damping_time * self.fastest * slower

    def left_out(self, spec: ChainDrive, strand: int, x: FloatArray) -> FloatArray:
        """Most that modes above those taken add at sections, shape (n,) [N].

        (R_s R_on)^(1/2) x_max + (R_s R_off)^(1/2) x_max + 2 |e| R sum |M_k(s)|,   R_s = G_s - sum B_k(s)^2/M_belt
        """
        follow = residual(spec) * float(self.follow(spec, spec.sprocket.teeth)[-2:].max())
        if isinstance(self.masses, HeldStrands):
            tail, ends = float(self.follow(spec, tail_teeth(spec))[-2:].max()), 0.0
            for one in (strand,) if self.masses.imposed_speed else (RETURN, CARRY):
                near, far = (np.zeros(1), _END) if one == RETURN else (_END, np.zeros(1))
                ends += float(self._rest(one, near)[0]) * follow + float(self._rest(one, far)[0]) * tail
            begun = loops.modal_rest(self.masses, self._moved_by_start, strand, x)
            return np.asarray(self._rest(strand, x) * ends + 2 * self.sharpest * begun)
        ends = float(self._rest(CARRY, _END)[0]) * follow
        if self.masses.fixed_length:
            ends += float(self._rest(RETURN, np.zeros(1))[0]) * follow
        begun = loops.modal_rest(self.masses, self.frequencies, strand, x)
        driven = self.driven_left_out(spec, strand, x)
        return np.asarray(self._rest(strand, x) * ends + driven + 2 * self.sharpest * begun)

    def driven_left_out(self, spec: ChainDrive, strand: int, x: FloatArray) -> FloatArray:
        """The same of the teeth of the driven one of two sprockets, shape (n,) [N]."""
        if not isinstance(spec.layout, TwoShafts):
            return np.zeros(len(x))
        follow = float(self.follow(spec, tail_teeth(spec))[-2:].max())
        return np.asarray(self._rest(strand, x) * float(self._rest(CARRY, np.zeros(1))[0]) * follow)

    def _rest(self, strand: int, x: FloatArray) -> FloatArray:
        """R_s^(1/2) of `left_out`, shape (n,) [kg^(1/2)]."""
        taken = np.sum(self.shapes(strand, x) ** 2, axis=0) / self.masses.belt_mass
        return np.asarray(np.sqrt(np.maximum(loops.tension_green(self.masses, strand, x) - taken, 0.0)))

    def ahead(self, spec: ChainDrive, teeth: int | None = None) -> float:
        """Most that a polygon, of the driving sprocket or of these teeth, lets the chain run ahead of its mean motion
        [m]."""
        places = np.linspace(-0.5, 0.5, 201)
        moved = polygon.polygon_displacement(places, spec.chain.pitch, teeth or spec.sprocket.teeth)
        return float(np.abs(moved).max())

    @property
    def stiffness(self) -> float:
        """Of a loop of fixed length [N/m]; 0 with a constant tension at the run-off."""
        if not self.masses.fixed_length:
            return 0.0
        return 1 / (self.masses.carry_compliance + self.masses.return_compliance)

    @property
    def _moved_by_start(self) -> FloatArray:
        """Frequencies of the modes taken that the mean acceleration moves [rad/s]."""
        if not isinstance(self.masses, HeldStrands) or self.masses.imposed_speed:
            return self.frequencies
        return np.array([w for w in of_loop(self.masses, 0.0, len(self.frequencies)) if w <= self.frequencies[-1]])

    @property
    def excited_by_start(self) -> FloatArray:
        """What excites each mode per mean acceleration, as `modal_shapes` at an end do per polygon's [kg]."""
        if not self.started:
            return np.zeros(len(self.frequencies))
        if isinstance(self.masses, HeldStrands):
            ends = (self.shapes(strand, _END) - self.shapes(strand, np.zeros(1)) for strand in (RETURN, CARRY))
            strands = self.masses.return_mass + self.masses.carry_mass
            share = 1.0 if self.masses.imposed_speed else self.masses.total_mass / (self.masses.total_mass - strands)
            return np.asarray(share * sum(ends))[:, 0]
        share = 1.0 if self.masses.imposed_speed else self.masses.total_mass / self.masses.drive_mass
        return share * (self.shapes(CARRY, _END) - self.shapes(RETURN, np.zeros(1)))[:, 0]


def swinging(damping_ratios: FloatArray) -> int:
    """How many of the lowest modes are followed tooth by tooth: those that swing, at least the first.

    A mode beyond critical damping follows its input within the time of the chain's damping: it counts with those left
    out, whose bound holds it.
    """
    return max(int(np.argmax(damping_ratios > 1)) if np.any(damping_ratios > 1) else len(damping_ratios), 1)


def range_passing(spec: ChainDrive, scene: SpeedRange, count: int = _FOR_BOUNDS) -> Passing:
    """A range of speeds through which the sprocket, and a driven tail, is turned evenly faster or slower."""
    masses = swinging_loop(spec, loop_masses(spec, scene))
    w = natural_frequencies(spec, scene, count=count)
    if isinstance(masses, HeldStrands):
        w = np.array(of_loop(masses, 0.0, count))
    w = w[: swinging(damping_ratios(damping(spec, scene), w))]
    first, last, time = scene.start, scene.end, scene.time
    rate = (last - first) / time
    return Passing(
        masses=masses,
        frequencies=w,
        damping_ratios=damping_ratios(damping(spec, scene), w),
        way=lambda t: np.asarray(first * t + rate * t**2 / 2),
        speed=lambda t: np.asarray(first + rate * t),
        acceleration=lambda t: np.full_like(t, rate),
        kinks=(),
        window=time,
        fastest=max(first, last),
        sharpest=abs(rate),
    )


def _moved_by_teeth(masses: LoopMasses, count: int) -> FloatArray:
    """The lowest natural frequencies: of coupled sprockets also those of modes that leave them at rest, which only the
    teeth move [rad/s]."""
    if isinstance(masses, HeldStrands) and not masses.imposed_speed:
        return held_strands.all_frequencies(masses, count)
    return np.array(of_loop(masses, 0.0, count))


def start_passing(spec: ChainDrive, scene: Start, count: int = _FOR_BOUNDS) -> Passing:
    """The teeth of a start, its sprocket turned as the rigid body is."""
    case = start_case(spec, scene)
    way, speed, acceleration, kinks = _motion(case)
    w = _moved_by_teeth(case.masses, count)
    w = w[: swinging(ratios(spec, scene, w))]
    return Passing(
        masses=case.masses,
        frequencies=w,
        damping_ratios=ratios(spec, scene, w),
        way=way,
        speed=speed,
        acceleration=acceleration,
        kinks=kinks,
        window=case.window,
        fastest=case.line.speed,
        sharpest=case.acceleration,
    )


def curve_teeth(spec: ChainDrive, scene: Start) -> float:
    """Most that the teeth of a start on a motor curve add to the entering tension or take from it [N].

        |S| <= |S_m| + |S_v|,   S = H u (A + B)/(H + A + B) = ((H + A) S_m + B S_v)/(H + A + B)

    u is the polygon motion, H the dynamic stiffness of the chain, A = -m w^2 that of the drive mass, B = -i w dF/dv
    that of motors whose torque falls with the speed. S_m is the tension of a torque that does not depend on the speed,
    S_v that of a constant speed. Imaginary parts of H and B have one sign: no weight exceeds 1.

    The teeth of both sprockets of a driven tail that is synchronised move either strand, at both ends: with u_j at an
    end j, S_v = sum c_j u_j and S_m = sum (c_j - c H_j/(H + A)) u_j, and the same weights.

    **Range** any start; infinite where the motors do not move the chain.
    **Error** a bound for every harmonic of a motor line of constant slope; the change of slope during the start, and
    the slow growth where the torque rises with the speed, are not in it.
    **Source** derived; `Passing.teeth_bound` for both parts.
    """
    parts = curve_passings(spec, scene)
    return sum(one.teeth_bound(spec) for one in parts) if parts else math.inf


def curve_passings(spec: ChainDrive, scene: Start, count: int = _FOR_BOUNDS) -> tuple[Passing, ...]:
    """The teeth of a start on a motor curve without its mean acceleration, the sprocket turned as that of the rigid
    chain: for a torque that does not depend on the speed, and for a constant speed; nothing where the rigid chain is
    not followed."""
    found, case = rigid_start(spec, scene), start_case(spec, scene)
    if found is None:
        return ()
    passings = []
    for masses in (case.masses, replace(case.masses, drive_mass=0.0, imposed_speed=True)):
        w = _moved_by_teeth(masses, count)
        w = w[: swinging(ratios(spec, scene, w))]
        passings.append(
            Passing(
                masses=masses,
                frequencies=w,
                damping_ratios=ratios(spec, scene, w),
                way=found.way,
                speed=found.speed,
                acceleration=found.acceleration,
                kinks=found.kinks,
                window=found.end - found.release,
                fastest=found.fastest,
                sharpest=found.sharpest,
                started=False,
            )
        )
    return tuple(passings)


Motion = tuple[
    Callable[[FloatArray], FloatArray],
    Callable[[FloatArray], FloatArray],
    Callable[[FloatArray], FloatArray],
    tuple[float, ...],
]


def _motion(case: StartCase) -> Motion:
    """Way, speed and acceleration of the rigid body over time, and the kinks between smooth pieces; on a motor's curve
    those of the mean torque.

    The way under a torque that rises is the integral of a speed in closed form: cubics between many points of it.
    """
    v, a, shape, t_s = case.line.speed, case.acceleration, case.shape, case.rise_time
    marks: tuple[float, ...] = () if shape == start_profile.STEP else (t_s / 2, t_s)
    if isinstance(shape, tuple):
        marks = tuple(t_s * share for share, _ in shape if share > 0)
    if case.imposed_speed:
        return (
            lambda t: v * start_profile.rise_integral(shape, t_s, t),
            lambda t: v * start_profile.rise(shape, t_s, t),
            lambda t: v * start_profile.rise_rate(shape, t_s, t),
            marks,
        )
    if shape == start_profile.STEP:
        return _brought_to_speed(
            case,
            lambda t: np.asarray(a * t**2 / 2),
            lambda t: np.asarray(a * t),
            lambda t: np.full_like(t, a),
            (),
        )
    held, force, resistance = case.held, case.available / case.whole_mass, case.line.static_resistance / case.whole_mass
    before = float(start_profile.rise_integral(shape, t_s, held))

    def speed(t: FloatArray) -> FloatArray:
        gained = start_profile.rise_integral(shape, t_s, t + held) - before
        return np.asarray(np.maximum(force * gained - resistance * t, 0.0))

    def acceleration(t: FloatArray) -> FloatArray:
        return np.asarray(force * start_profile.rise(shape, t_s, t + held) - resistance)

    kinks = tuple(mark - held for mark in marks if mark > held)
    return _brought_to_speed(case, _way(speed, case.end), speed, acceleration, kinks)


def _brought_to_speed(
    case: StartCase,
    way: Callable[[FloatArray], FloatArray],
    speed: Callable[[FloatArray], FloatArray],
    acceleration: Callable[[FloatArray], FloatArray],
    kinks: tuple[float, ...],
) -> Motion:
    """A motion that goes on evenly once the chain has its speed."""
    end, v = case.end, case.line.speed

    def ways(t: FloatArray) -> FloatArray:
        return np.asarray(way(np.minimum(t, end)) + v * np.maximum(np.asarray(t) - end, 0.0))

    return (
        ways,
        lambda t: np.asarray(np.where(np.asarray(t) < end, speed(np.minimum(t, end)), v)),
        lambda t: np.asarray(np.where(np.asarray(t) <= end, acceleration(np.minimum(t, end)), 0.0)),
        (*(kink for kink in kinks if kink < end), end),
    )


def _way(speed: Callable[[FloatArray], FloatArray], window: float) -> Callable[[FloatArray], FloatArray]:
    """Integral of a speed: Simpson's rule between points, cubics through them and the speed there."""
    times = np.linspace(0.0, window, _POINTS)
    step, speeds = float(times[1]), speed(times)
    gained = step / 6 * (speeds[:-1] + 4 * speed((times[:-1] + times[1:]) / 2) + speeds[1:])
    ways = np.concatenate([[0.0], np.cumsum(gained)])

    def found(t: FloatArray) -> FloatArray:
        at = np.clip((np.asarray(t, float) / step).astype(int), 0, _POINTS - 2)
        x = np.asarray(t, float) / step - at
        rise, first, last = ways[at + 1] - ways[at], step * speeds[at], step * speeds[at + 1]
        return np.asarray(ways[at] + x * (first + x * (3 * rise - 2 * first - last + x * (first + last - 2 * rise))))

    return found
