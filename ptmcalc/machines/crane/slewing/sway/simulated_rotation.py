"""A rotation of a slewing crane as a motion, piece by piece: the stages of the start with steady slewing, the stop."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np

from ptmcalc.base.errors import NumericsError
from ptmcalc.components.motor import ConverterMotor
from ptmcalc.components.motor_stage import Stage
from ptmcalc.contract.result import Event
from ptmcalc.machines.crane.slewing.machine import model
from ptmcalc.machines.crane.slewing.machine.spec import SlewingCrane, SlewingScene
from ptmcalc.numerics.pendulum.equations import KEEP
from ptmcalc.numerics.pendulum.parts import Axis, Case, Follow, Gear, Jib, Load, Peak, Push, Smooth, Straight
from ptmcalc.numerics.pendulum.pieces import Pieces
from ptmcalc.numerics.pendulum.swing import Swing, swing

_LONGER, _TRIES = 3.0, 3
"""Factor of the simulated time from attempt to attempt, and number of attempts of a start or stop [1]. A numerical
choice: a start may take 27 times and a stop 18 times as long as that of the rigid crane. Larger values refuse later and
cost longer runs."""
_PERIODS_AFTER = 3.0
"""Periods of the load that are looked at after the stop."""
_STATE = ("along", "across", "along_rate", "across_rate")
_INHERITED = 10.0
"""By how much an error of the state with which a piece begins may have grown by the end of it."""
_AT_SPEED = 1e-9
"""Relative deviation [1] from full speed up to which a drive has reached it at the end of its ramp. A numerical choice:
it is above the step tolerance of the pendulum, 1e-11. A larger value accepts a drive at its torque limit; a smaller one
misses the end of a ramp by rounding."""
_STANDS = 1e-9
"""Share of the full speed below which the crane stands."""
_WIDEST = math.radians(80.0)
"""Amplitude up to which the horizontal pull of the load stays below 2 m g sin(a/2) in every part of the swing."""
_PARTS = 3
"""Times the usual time after a stop that are looked at more where the load still drags the crane."""
_MOST_STEPS = 3000
"""Steps of one integration [1] after which it is refused with NUM103. A numerical choice: a smaller value refuses long
sway early, a larger one allows longer runs. No result that is reached depends on it."""


@dataclass(frozen=True, slots=True)
class Piece:
    """A motion from a time of the rotation on, looked at for so long."""

    motion: Swing
    begins: float
    lasts: float
    inherited: float
    """error of the load's angles with which it begins [rad]"""

    def farthest(self, name: str) -> Peak:
        """Largest size of a signal, in the time of the rotation."""
        peak = self.motion.farthest(name, 0.0, self.lasts)
        size = abs(peak.value)
        return Peak(size, self.begins + peak.time, peak.bar + self.inherited * max(size, 1.0))

    def events(self) -> Iterator[Event]:
        """What happened, in the time of the rotation."""
        for one in self.motion.events:
            if one.time <= self.lasts:
                yield Event(self.begins + one.time, one.element, one.before, one.after)


@dataclass(frozen=True, slots=True)
class Rotation:
    """All pieces, and the times [s] and angles [rad] that part them."""

    pieces: tuple[Piece, ...]
    phases: model.Phases
    bar: float
    """error of times and angles as a share of them"""
    creep: float = 0.0
    """angle by which the load may still drag the crane through its closed brake after the window [rad]"""

    def farthest(self, name: str) -> Peak:
        """Largest size of a signal in the whole rotation."""
        return max((piece.farthest(name) for piece in self.pieces), key=lambda peak: peak.value)

    def history(self, name: str) -> tuple[list[float], list[float]]:
        """A signal over time: where the motion was looked at, and where the signal is largest and smallest."""
        times: list[float] = []
        values: list[float] = []
        for piece in self.pieces:
            at, (seen,) = piece.motion.history((name,))
            ends = (0.0, piece.lasts)
            peaks = (piece.motion.largest(name, *ends), piece.motion.smallest(name, *ends))
            at = np.concatenate([at, [one.time for one in peaks]])
            seen = np.concatenate([seen, [one.value for one in peaks]])
            kept = np.flatnonzero(at <= piece.lasts)
            kept = kept[np.argsort(at[kept], kind="stable")]
            times += (piece.begins + at[kept]).tolist()
            values += seen[kept].tolist()
        return times, values


@dataclass(slots=True)
class _March:
    """Goes from piece to piece with the state of the load and of the crane."""

    spec: SlewingCrane
    scene: SlewingScene
    time: float = 0.0
    position: float = 0.0
    speed: float = 0.0
    inherited: float = 0.0
    state: Mapping[str, float] = field(default_factory=dict)
    pieces: list[Piece] = field(default_factory=list)

    def case(
        self,
        drive: Follow | Push | None,
        outer: Pieces,
        gear: Gear,
        brake: Pieces = Pieces.constant(0.0),  # noqa: B008
    ) -> Case:
        spec, load = self.spec, self.spec.load
        assert load is not None
        assert load.rope_length is not None
        rope = Pieces.constant(load.rope_length)
        at = {name: self.state.get(name, 0.0) for name in _STATE}
        hangs = Load(
            model.hanging_mass(spec, self.scene), rope, at["along"], at["across"], at["along_rate"], at["across_rate"]
        )
        axis = Axis(
            model.structure_inertia(spec), drive, spec.friction, brake, outer, gear=gear, position=self.position,
            speed=self.speed,
        )  # fmt: skip
        return Case(spec.gravity, Jib(Pieces.constant(load.radius)), axis, hangs)

    def keep(self, motion: Swing, lasts: float, speed: float) -> None:
        """Looks at a motion for so long, and goes on from where it is then."""
        omega = math.sqrt(self.spec.gravity / motion.case.load.length.coefficients[0][0])
        self.pieces.append(Piece(motion, self.time, lasts, self.inherited))
        known = {name: motion.known(name, lasts) for name in _STATE}
        self.state = {name: peak.value for name, peak in known.items()}
        self.position, self.speed = motion.known("position", lasts).value, speed
        self.inherited = _INHERITED * (
            self.inherited + sum(peak.bar / (omega if name.endswith("rate") else 1.0) for name, peak in known.items())
        )
        self.time += lasts


def rotation(spec: SlewingCrane, scene: SlewingScene, *, curve: bool, gust: bool) -> Rotation:
    """The motion of a whole rotation.

    Raises:
        NumericsError: the crane does not reach its speed, or does not stop; and what `numerics.pendulum.swing` raises.
    """
    march = _March(spec, scene)
    rest = model.stop(spec, scene) or model.allowed_stop(spec)
    if not math.isfinite(rest[0]):
        raise NumericsError("NUM102", "the brake does not stop the crane against the wind")
    start = _start(march, rest[1], curve=curve, gust=gust)
    steady = max(spec.cycle.rotation - start[1] - rest[1], 0.0)
    before, until = march.position, march.time
    stop = _stop(march, rest[0])
    phases = model.Phases(start, (until - start[0], steady), (stop[0], stop[1] - before))
    return Rotation(tuple(march.pieces), phases, 1e-9 + march.pieces[-1].inherited, stop[2])


# -- start ----------------------------------------------------------------------------------------------------------


def _start(march: _March, planned: float, *, curve: bool, gust: bool) -> tuple[float, float]:
    """Start and steady slewing: when the crane has come to its speed, and where."""
    spec, scene = march.spec, march.scene
    rigid = model.start_of(spec, scene)[0]
    if not math.isfinite(rigid):
        raise NumericsError("NUM102", "the motor stalls: the crane does not start")
    whole = spec.cycle.rotation / spec.speed
    drives: list[tuple[Follow | Push, float | None, float]] = list(_drives(spec, scene, rigid, curve=curve))
    gear = Gear() if _imposed(spec, scene) else _gear(spec)
    for index, (drive, until, ramp) in enumerate(drives):
        last = index == len(drives) - 1
        longest, behind = _LONGER * rigid + _period(spec), whole if last else 0.0
        for _ in range(_TRIES):
            case = march.case(drive, _against(spec, scene, march.time, gust=gust), gear)
            motion = swing(case, longest + behind, most_steps=_MOST_STEPS)
            reached = until if until is not None else _reached(motion, ramp, spec.speed if last else None)
            if reached is not None and reached <= longest:
                break
            longest *= _LONGER
        else:
            raise NumericsError("NUM102", f"the crane does not reach its speed within {march.time + longest:.3g} s")
        if last:
            turned = motion.known("position", reached).value
            begun = march.time + reached
            steady = max(spec.cycle.rotation - turned - planned, 0.0) / spec.speed
            march.keep(motion, reached + steady, spec.speed)
            return begun, turned
        march.keep(motion, reached, float(motion.at("speed", reached)))
    raise AssertionError("a start has a last stage")


def _reached(motion: Swing, ramp: float, speed: float | None) -> float | None:
    """When a drive has come to the speed it then keeps."""
    if ramp and speed is not None and abs(float(motion.at("speed", ramp)) / speed - 1) < _AT_SPEED:
        return ramp
    for event in motion.events:
        if event.element == "drive" and event.after in ("speed reached", KEEP) and event.time >= ramp:
            return event.time
    return None


def _drives(
    spec: SlewingCrane, scene: SlewingScene, rigid: float, *, curve: bool
) -> Iterator[tuple[Follow | Push, float | None, float]]:
    """The stages of the start: the drive, when it is over where that is known, and the time of its ramp [s]."""
    given, ratio, count = spec.motor.curve, spec.gear.ratio, spec.motor.count
    if _imposed(spec, scene):
        yield Follow(Pieces.through(((0.0, 0.0), (rigid, spec.speed)))), rigid, rigid
        return
    mean = model.motor_torque(spec, scene)
    assert mean is not None
    if isinstance(given, ConverterMotor) and given.ramp_time > 0:
        limit = count * given.torque_limit * ratio
        ramp = given.ramp_time
        yield Follow(Pieces.through(((0.0, 0.0), (ramp, spec.speed))), limit=limit), None, ramp
        return
    if given is None or not curve or isinstance(given, ConverterMotor):
        yield Push(mean * ratio, reaches=spec.speed), None, 0.0
        return
    before = 0.0
    for stage in given.stages:
        law = _law(stage, ratio, count)
        over = spec.speed if stage.until_speed is None else min(stage.until_speed / ratio, spec.speed)
        if stage.until_time is not None:
            yield Push(law), stage.until_time - before, 0.0
            before = stage.until_time
            continue
        yield Push(law, reaches=over), None, 0.0
        if over >= spec.speed:
            return


def _law(stage: Stage, ratio: float, count: int) -> Straight | Smooth | float:
    """A motor's curve over the speed of the crane, all motors, brought to the axis by the ratio alone."""
    many = count * ratio
    if stage.formula is not None:
        formula = stage.formula
        size = many * float(np.max(np.abs(formula(np.linspace(0.0, 1e-9, 2)))))
        return Smooth(lambda speed: many * formula(speed * ratio), size)
    assert stage.pieces is not None
    if len(stage.pieces) == 1:
        return many * stage.pieces[0][1]
    return Straight(tuple(speed / ratio for speed, _ in stage.pieces), tuple(many * value for _, value in stage.pieces))


def _against(spec: SlewingCrane, scene: SlewingScene, since: float, *, gust: bool) -> Pieces:
    """Steady wind, slope and a gust against the start, from a time of the rotation on."""
    steady = -(model.steady_torque(spec, scene) - spec.friction)
    if not gust or spec.wind.gust_torque == 0:
        return Pieces.constant(steady)
    rise, lasts, most = (spec.wind.gust_rise or 2.0), (spec.wind.gust_time or 5.0), spec.wind.gust_torque
    times, sizes = (0.0, rise, rise + lasts, 2 * rise + lasts), (0.0, most, most, 0.0)
    points = [(0.0, steady - float(np.interp(since, times, sizes)))]
    points += [(time - since, steady - size) for time, size in zip(times, sizes, strict=True) if time > since]
    return Pieces.through(tuple(points)) if len(points) > 1 else Pieces.constant(points[0][1])


# -- stop -----------------------------------------------------------------------------------------------------------


def _stop(march: _March, rigid: float) -> tuple[float, float, float]:
    """The stop: when the crane stands for the first time, the farthest position it gets to, and how far a load that
    swings on may still drag it through its closed brake after the window."""
    spec, brake = march.spec, march.spec.brake
    after = _PERIODS_AFTER * _period(spec)
    after += (march.scene.window_factor - 1) * (march.time + rigid + after)
    blown = Pieces.constant(model.driving_wind(spec, march.scene))
    if brake is None or spec.gear.back <= 0:
        ramp = max(rigid, 1e-3 * _period(spec))
        slope = -spec.speed / ramp
        left = spec.speed + slope * ramp  # 0 but for rounding, so that the speed does not jump
        drive = Follow(Pieces((0.0, ramp), ((spec.speed, slope), (left,))))
        motion = swing(march.case(drive, blown, Gear()), ramp + after, most_steps=_MOST_STEPS)
        march.keep(motion, ramp + after, 0.0)
        return ramp, march.position, 0.0
    on_motor = brake.shaft == "motor"
    full = brake.torque * (spec.gear.ratio if on_motor else 1.0)
    closes = brake.delay + brake.rise_time
    held = (
        Pieces.through(((0.0, 0.0), (brake.delay, 0.0), (brake.delay, full)))
        if brake.rise_time == 0
        else (Pieces.through(((0.0, 0.0), (brake.delay, 0.0), (closes, full))))
    )
    gear, outer = _gear(spec), Pieces.constant(0.0)
    if on_motor:
        gear = Gear(gear.rotor, gear.forward, gear.reverse, held)
    else:
        outer = held
    longest = 2 * rigid + after
    for _ in range(_TRIES):
        motion = swing(march.case(None, blown, gear, outer), longest + after, most_steps=_MOST_STEPS)
        stands = _stands(motion)
        if stands is not None and stands <= longest:
            resists = (
                full / (spec.gear.back if on_motor else 1.0) + spec.friction - model.driving_wind(spec, march.scene)
            )
            if _way_left(march, motion, resists):
                longest += _PARTS * _PERIODS_AFTER * _period(spec)
                motion = swing(march.case(None, blown, gear, outer), longest + after, most_steps=_MOST_STEPS)
            march.keep(motion, longest + after, 0.0)
            return stands, motion.largest("position").value, _way_left(march, motion, resists)
        longest *= _LONGER
    raise NumericsError("NUM102", f"the crane does not stop within {longest:.3g} s")


def _way_left(march: _March, motion: Swing, resists: float) -> float:
    """How far a load that swings on can still drag the crane through its closed brake, after the motion [rad].

        0   where m g R sin a cos a <= H
        2 (P - H)/(k R^2)   where P = 2 m g R sin(a/2) <= 2 H,  k = m g/L
        (m g L (1 - cos a) + J w^2/2)/H   else, and for a crane that turns yet

    a: amplitude of the swing by its energy E; its plane turns, so that all of it may come to pull along the circle. H:
    what resists, brake and friction less the wind. J: of the crane and its motor.

    **Range** amplitudes up to 80 degrees; above, and where nothing resists, no bound.
    **Error** an upper bound; of a swing that only just drags the crane, twice what follows.
    **Source** derived. A turn phi of the crane takes W <= P phi - k R^2 phi^2/2 of the energy E, since the pull is at
    most R sqrt(2 k E); it ends where W = H phi. Of several turns the last one begins with P >= H, and all of them
    together take H phi: the sum is largest for a single turn while P <= 2 H, and E/H beyond.
    """
    load, spec = march.spec.load, march.spec
    assert load is not None
    assert load.rope_length is not None
    swings, turns = (motion.known(name, motion.end) for name in ("amplitude", "speed"))
    angle, speed = swings.value + swings.bar, abs(turns.value) + turns.bar
    if resists <= 0 or angle > _WIDEST:
        return math.inf
    weight, stands = model.hanging_mass(spec, march.scene) * spec.gravity, speed <= _STANDS * spec.speed
    pull = math.sin(angle) * math.cos(angle) if angle < math.pi / 6 else 2 * math.sin(angle / 2)
    if stands and weight * load.radius * pull <= resists:
        return 0.0
    most = 2 * weight * load.radius * math.sin(angle / 2)
    if stands and most <= 2 * resists:
        return 2 * (most - resists) / (weight / load.rope_length * load.radius**2)
    inertia = model.structure_inertia(spec) + model.rotor_at_axis(spec)
    energy = weight * load.rope_length * (1 - math.cos(angle)) + inertia * speed**2 / 2
    return energy / resists


def _stands(motion: Swing) -> float | None:
    """When the crane comes to rest, or turns back, for the first time."""
    times = (event.time for event in motion.events if event.element == "axis" and event.before == "forward")
    return next(times, None)


def _period(spec: SlewingCrane) -> float:
    assert spec.load is not None
    assert spec.load.rope_length is not None
    return 2 * math.pi * math.sqrt(spec.load.rope_length / spec.gravity)


def _imposed(spec: SlewingCrane, scene: SlewingScene) -> bool:
    """Whether the file gives the time of the start, or the load cannot turn the gear: the motion is imposed."""
    return model.motor_torque(spec, scene) is None or spec.gear.back <= 0


def _gear(spec: SlewingCrane) -> Gear:
    return Gear(rotor=model.rotor_at_axis(spec), forward=spec.gear.efficiency, reverse=spec.gear.back)
