"""The train of a hoist from its design file: what moves, what acts, and how long it is looked at."""

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ptmcalc.components.start import Profile
from ptmcalc.laws import bodies, start_profile, two_mass
from ptmcalc.laws import brake as braking
from ptmcalc.machines.hoist.drive import torques
from ptmcalc.machines.hoist.machine import model
from ptmcalc.machines.hoist.machine.spec import Hoist, Lift, LowerBrake, Release, Start, Stop
from ptmcalc.machines.hoist.motion.motor_stages import motor_stages
from ptmcalc.machines.hoist.motion.reduced import (
    braked_way,
    hauling_efficiency,
    hook_force,
    lowering_efficiency,
    motor_torque,
    moving_inertia,
    ratio,
    reduced,
    travel,
)
from ptmcalc.machines.hoist.motion.train import (
    BACKLASH,
    BRAKE,
    BRIDGE,
    DRIVE,
    DRUM,
    FLANK,
    GEAR,
    GEARBOX,
    GROUND,
    HOOK,
    LEAST_LEFT,
    LOAD,
    LONGEST,
    MAINS,
    MOTOR,
    NODE,
    ROPE,
    SHAFT,
    STRUCTURE,
    TACKLE,
    Case,
    Moving,
)
from ptmcalc.numerics.train.modes import frequencies
from ptmcalc.numerics.train.parts import CLAMPED, NO_PULL, RIGID, Body, Drive, Grip, Guide, Mesh, Spring, Train
from ptmcalc.numerics.train.signals import ONE, Signal, Trigger

_STEEL = 7850.0
"""Density of steel [kg/m^3], a handbook value. The inertia of a drum that the file omits is proportional to it."""
_PERIODS = 6
"""Periods of the slowest vibration in the window after the last event [1]. A numerical choice: a peak is within the
first. More periods take longer; fewer leave more of the vibration to the bound of `after_window`."""
_PIECES = 64
"""Chords of a smooth rise; a numerical choice. A cosine rise deviates by at most 1.5e-4 of its end value, a parabolic
one by less. The error falls with the square of the number; time grows with it. A run with half as many tells it."""
_CURVED = ("cosine", "parabolic")
"""Shapes of a rise that chords replace; steps, ramps and tables are straight already."""
_LOOKED_AT = 2001
"""Speeds at which the maximum of a torque curve is searched; a numerical choice. More find a narrow maximum more
closely and take longer."""


class TrainBuilder:
    """Builds the case of a scene; `carried` are the effects it carries."""

    def __init__(self, spec: Hoist, scene: Moving, carried: frozenset[str], pieces: int = _PIECES) -> None:
        self.spec, self.scene, self.carried, self.pieces = spec, scene, carried, pieces
        self.arm, self.ratio = travel(spec, scene), ratio(spec)
        self.stiffness = model.hook_stiffness(spec, model.hook_height(scene))
        self.before = model.hook_mass(spec, scene)
        self.mass = self._mass_after()
        self.weight = self.mass * spec.gravity
        self.held_weight = self.before * spec.gravity
        self.lifts, self.released = isinstance(scene, Lift), isinstance(scene, Release)
        self.stops = isinstance(scene, Stop | LowerBrake)
        self.way = self._direction()
        given = spec.structure
        self.bridge = given if STRUCTURE in carried and given is not None and given.mass > 0 else None
        self.soft = given if STRUCTURE in carried and given is not None and given.mass == 0 else None
        gear = spec.gearbox
        elastic = GEAR in carried and gear is not None and gear.stiffness is not None
        self.torsion = gear.stiffness if elastic and gear is not None else None
        self.play = gear.backlash if elastic and gear is not None and BACKLASH in carried else 0.0
        self.names = self._names()
        self.set_speed = model.drum_speed(spec, getattr(scene, "speed", "main")) * self.ratio

    def _mass_after(self) -> float:
        """What hangs on the rope in the scene; of a load that is gone a hook at least, a thousandth of it [kg]."""
        if not isinstance(self.scene, Release):
            return self.before
        left = self.before - self.scene.share * (self.before - self.spec.hook_block)
        return max(left, LEAST_LEFT * self.before)

    def _direction(self) -> int:
        """1 where the hoist moves up, -1 down, 0 where it stands."""
        scene = self.scene
        if isinstance(scene, Release):
            return 0
        if isinstance(scene, LowerBrake):
            return -1
        return -1 if isinstance(scene, Start | Stop) and scene.direction == "down" else 1

    def _names(self) -> list[str]:
        names = [MOTOR, *([NODE] if self.torsion is not None else []), DRUM, HOOK, LOAD]
        names += [BRIDGE] if self.bridge is not None else []
        return names + ([MAINS] if self._follows_speed else [])

    @property
    def _follows_speed(self) -> bool:
        """Whether the drive is a set speed with a limit of torque; else it is the motor's own curve, or off."""
        return isinstance(self.scene, Lift | Start) and self._profile.shape != "curve"

    @property
    def _profile(self) -> Profile:
        assert isinstance(self.scene, Lift | Start)
        return self.scene.profile

    def at(self, name: str) -> int:
        """Index of a body."""
        return self.names.index(name)

    def case(self) -> Case:
        """The case: the train with its window and the numbers beside it."""
        springs = tuple(self._springs())
        train = Train(
            bodies=tuple(self._bodies()),
            meshes=tuple(self._meshes()),
            springs=springs,
            grips=tuple(self._grips()),
            drives=tuple(self._drives()),
            guides=tuple(self._guides()),
        )
        window, ringing = self._window(train)
        losses = lowering_efficiency(self.spec) if self.way < 0 else 1 / hauling_efficiency(self.spec)
        even = self.held_weight * self.arm * losses
        stiffness = self._hook_stiffness
        scene, lowers = self.scene, self.way < 0
        drop = scene.hook_height or self.spec.height
        held = torques.held(self.spec, model.hook_mass(self.spec, scene), scene.hook_height)
        holds = isinstance(scene, Stop | LowerBrake) and held is not None and held.reserve > 1
        weak = self.lifts and self._most_force < self.weight
        return Case(
            train,
            window,
            self.held_weight,
            self.weight,
            stiffness,
            even,
            lowers,
            self.stops,
            drop,
            holds,
            weak,
            ringing,
            self._coarser(),
        )

    def _coarser(self) -> Case | None:
        """The case with half as many chords of a smooth rise."""
        scene = self.scene
        rises = isinstance(scene, Lift | Start) and scene.profile.shape in _CURVED and scene.profile.rise_time > 0
        if not rises or self.pieces < _PIECES:
            return None
        return TrainBuilder(self.spec, scene, self.carried, self.pieces // 2).case()

    @property
    def _most_force(self) -> float:
        """Largest force of the drive at the hook [N]: of its mean torque, or of its curve below the free speed."""
        motor = self.spec.motor
        if self._follows_speed or motor is None or motor.curve is None:
            return reduced(self.spec, self.scene).drive_force
        torques = motor.curve.torque(np.linspace(0.0, motor.curve.no_load_speed or 1.0, _LOOKED_AT), np.inf)
        return hook_force(self.spec, self.scene, motor.count * float(np.max(torques)))

    # -- what moves ---------------------------------------------------------------------------------------------

    @property
    def _hook_stiffness(self) -> float:
        """Of the rope, in series with a structure that has no mass."""
        if self.soft is None:
            return self.stiffness
        return self.stiffness / (1 + self.stiffness / self.soft.stiffness)

    @property
    def _start_speed(self) -> float:
        """Of the motor at the beginning, with its sign [rad/s]."""
        scene = self.scene
        if self.stops:
            return self.way * self.set_speed
        if isinstance(scene, Lift) and scene.rope == "slack" and scene.slack is None:
            curve = self.spec.motor.curve if self.spec.motor is not None else None
            free = curve.no_load_speed if self._profile.shape == "curve" and curve is not None else None
            return free if free is not None else self.set_speed
        return 0.0

    def _bodies(self) -> Iterator[Body]:
        spec, speed = self.spec, self._start_speed
        inertias = {MOTOR: model.motor_side_inertia(spec), MAINS: 1.0, LOAD: self.mass}
        speeds = {MOTOR: speed, NODE: speed / self.ratio, DRUM: speed / self.ratio, HOOK: speed / self.ratio * self.arm}
        if not self.lifts:
            speeds[LOAD] = speeds[HOOK]
        if self._follows_speed:
            ramped = self._profile.imposes_speed and not speed
            speeds[MAINS] = 0.0 if ramped else self.way * self.set_speed
        inertias[DRUM] = self._drum_inertia
        positions = {BRIDGE: self._sag} | {DRUM: 0.0}
        if self.bridge is not None:
            inertias[BRIDGE] = self.bridge.mass
        for name in self.names:
            yield Body(name, inertias.get(name, 0.0), positions.get(name, 0.0), speeds.get(name, 0.0))

    @property
    def _drum_inertia(self) -> float:
        """Of the drum [kg*m^2]; where the file leaves it out nothing, or behind an elastic gear that of a steel shell
        as thick as the rope, since a drum without mass between two springs has no motion of its own."""
        given = self.spec.drum
        if given.inertia or self.torsion is None:
            return given.inertia or 0.0
        thick = given.shell_thickness or self.spec.rope.diameter
        return bodies.thin_ring(_STEEL * math.pi * given.diameter * thick * given.length, given.diameter)

    @property
    def _sag(self) -> float:
        """Deflection of the structure at the beginning [m]."""
        return 0.0 if self.lifts or self.bridge is None else self.held_weight / self.bridge.stiffness

    def _meshes(self) -> Iterator[Mesh]:
        spec = self.spec
        outer = NODE if self.torsion is not None else DRUM
        yield Mesh(
            GEARBOX,
            self.at(MOTOR),
            self.at(outer),
            self.ratio,
            model.efficiency(spec),
            model.reverse_efficiency(spec),
        )
        forward, reverse = hauling_efficiency(spec), lowering_efficiency(spec)
        yield Mesh(TACKLE, self.at(DRUM), self.at(HOOK), 1 / self.arm, forward, reverse)

    def _springs(self) -> Iterator[Spring]:
        if self.bridge is not None:
            given = self.bridge
            damping = 2 * given.damping * math.sqrt(given.stiffness * given.mass)
            yield Spring(STRUCTURE, self.at(BRIDGE), None, given.stiffness, damping)
        if self.torsion is not None:
            motor = model.motor_side_inertia(self.spec) * self.ratio**2
            between = motor / (1 + motor / self._drum_inertia)
            assert self.spec.gearbox is not None
            damping = 2 * self.spec.gearbox.damping * math.sqrt(self.torsion * between)
            first, second = self.at(NODE), self.at(DRUM)
            if not self.play:
                yield Spring(SHAFT, first, second, self.torsion, damping, rest=-self._twist)
            else:  # a spring for each flank: from the middle of the play a small twist would be lost in rounding
                rest = self.play / 2 - self._twist
                yield Spring(SHAFT, first, second, self.torsion, damping, law=CLAMPED, side=1, rest=rest)
                yield Spring(FLANK, first, second, self.torsion, damping, law=CLAMPED, side=-1, rest=rest - self.play)
        k = self._hook_stiffness
        damping = 2 * self.spec.rope.damping * math.sqrt(k * self.mass)
        over = self.at(BRIDGE) if self.bridge is not None else None
        rest = self._slack - self._sag if self.lifts else -(self.held_weight / k) - self._sag
        yield Spring(ROPE, self.at(HOOK), self.at(LOAD), k, damping, law=NO_PULL, side=1, rest=rest, over=over)
        if self.lifts:
            yield Spring(GROUND, self.at(LOAD), None, 0.0, law=RIGID, side=-1)

    @property
    def _slack(self) -> float:
        """Way of the hook before the rope is taut [m]."""
        assert isinstance(self.scene, Lift)
        return self.scene.slack or 0.0 if self.scene.rope == "slack" else 0.0

    @property
    def _twist(self) -> float:
        """Twist of the gear at the beginning, with its play [rad]: under the load that hangs on it; in a lift against
        the drive as it runs, and with the whole play before it as it starts from rest."""
        assert self.torsion is not None
        if self.lifts:
            return self.play / 2 if self._start_speed else -self.play / 2
        torque = self.held_weight * self.arm
        if self.way:
            torque = torque / hauling_efficiency(self.spec) if self.way > 0 else torque * lowering_efficiency(self.spec)
        if isinstance(self.scene, Start):
            torque = self.held_weight * self.arm
        return self.play / 2 + torque / self.torsion

    # -- what acts ----------------------------------------------------------------------------------------------

    def _grips(self) -> Iterator[Grip]:
        if self._follows_speed:
            gate = self._limited(Signal.constant(1.0)) if self.spec.limiter is not None else ONE
            yield Grip(DRIVE, self.at(MOTOR), self.at(MAINS), self._capacity(), gate=gate)
        given = self.spec.brake
        if given is None:
            return
        body = self.at(MOTOR if given.shaft == "motor" else DRUM)
        if self.stops:
            yield Grip(BRAKE, body, None, self._closing(given.delay, given.rise_time))
        elif self.spec.limiter is not None and isinstance(self.scene, Lift | Start):
            since = self.spec.limiter.delay + given.delay
            yield Grip(BRAKE, body, None, replace(self._closing(since, given.rise_time), trigger=self._trip()))

    def _closing(self, delay: float, rise: float) -> Signal:
        """Torque of the brake from its command on."""
        given = self.spec.brake
        assert given is not None
        full = given.torque
        if given.rise == braking.EXPONENTIAL and rise > 0:
            times, values = ((0.0, delay), (0.0, full)) if delay > 0 else ((0.0,), (full,))
            return Signal(times, values, (0.0,) * len(times), (), -full, rise, delay)
        if rise == 0:
            return Signal((0.0, delay), (0.0, full), (0.0, 0.0)) if delay > 0 else Signal.constant(full)
        if delay == 0:
            return Signal((0.0, rise), (0.0, full), (full / rise, 0.0))
        return Signal((0.0, delay, delay + rise), (0.0, 0.0, full), (0.0, full / rise, 0.0))

    def _capacity(self) -> Signal:
        """Torque the drive can give over time."""
        full, profile = motor_torque(self.spec), self._profile
        if profile.imposes_speed or profile.rise_time == 0:
            return Signal.constant(full)
        return Signal.through(tuple((time, full * share) for time, share in self._points(profile)))

    def _points(self, profile: Profile) -> list[tuple[float, float]]:
        """Times and shares of a rise, straight in between."""
        time = profile.rise_time
        if profile.points is not None:
            return [(point.time, point.share) for point in profile.points]
        if profile.shape == "ramp":
            return [(0.0, 0.0), (time, 1.0)]
        times = np.linspace(0.0, time, self.pieces + 1)
        shares = start_profile.rise(profile.rise, time, times)
        return list(zip(times.tolist(), shares.tolist(), strict=True))

    def _limited(self, capacity: Signal) -> Signal:
        """A constant that ends when the limiter has switched the motor off."""
        limiter = self.spec.limiter
        if limiter is None or not isinstance(self.scene, Lift | Start):
            return capacity
        full, delay = capacity.values[0], limiter.delay
        trip = self._trip()
        if delay == 0:
            return Signal(values=(0.0,), trigger=trip, before=full)
        return Signal((0.0, delay), (full, 0.0), (0.0, 0.0), trigger=trip, before=full)

    def _trip(self) -> Trigger:
        limiter = self.spec.limiter
        assert limiter is not None
        level = limiter.factor * (self.spec.load + self.spec.hook_block) * self.spec.gravity
        before = (self.bridge is not None) + (self.torsion is not None) * (2 if self.play else 1)
        return Trigger(before, "force", level, rising=True)

    def _drives(self) -> Iterator[Drive]:
        yield Drive.of("weight", self.at(LOAD), Signal.constant(-self.weight))
        motor = self.spec.motor
        if motor is None or self._follows_speed or not isinstance(self.scene, Lift | Start):
            return
        assert motor.curve is not None
        gate = ONE
        if self.spec.limiter is not None:
            gate = self._limited(Signal.constant(1.0))
        stages = tuple(motor_stages(motor.curve, motor.count, self.way))
        yield Drive(DRIVE, self.at(MOTOR), stages, gate)

    def _guides(self) -> Iterator[Guide]:
        if self.released:
            yield Guide(MOTOR, self.at(MOTOR))
        if not self._follows_speed:
            return
        profile = self._profile
        if not profile.imposes_speed or self._start_speed:
            yield Guide(MAINS, self.at(MAINS))
            return
        points = self._points(profile)
        times, shares = zip(*points, strict=True)
        rates = self.way * self.set_speed * np.diff(shares) / np.diff(times)
        values = (*rates.tolist(), 0.0)
        yield Guide(MAINS, self.at(MAINS), Signal(tuple(times), values, (0.0,) * len(values)))

    # -- how long -----------------------------------------------------------------------------------------------

    def _window(self, train: Train) -> tuple[float, float]:
        """Window of the scene, and its part after the last event [s].

        The rigid hoist has its speed or stands, then follow six periods of the slowest vibration, as a peak lies within
        the first; times the `window_factor` of the scene.
        """
        slowest = float(frequencies(train).min(initial=math.inf))
        free = math.sqrt(self._hook_stiffness / self.mass)
        ringing = _PERIODS * 2 * math.pi / min(slowest, free)
        before = self._until_lift_off() if self.lifts else self._rigid_time()
        factor = self.scene.window_factor
        return min(factor * (before + ringing), LONGEST), factor * ringing

    def _until_lift_off(self) -> float:
        """Time in which the slack is run out and the rope tightened [s], or the drive has come to rest."""
        one = reduced(self.spec, self.scene)
        speed, slack = self._start_speed / self.ratio * self.arm, self._slack
        rising = self._profile.rise_time
        force = one.drive_force or self._most_force  # a curve that brakes in the mean may take up the slack
        if slack and force > 0:
            pull = force / one.drive_mass
            quick = math.sqrt(2 * slack / pull)
            full = one.speed / pull
            rising += quick if quick < full else full + (slack - pull * full**2 / 2) / one.speed
        least = two_mass.takeup(one.drive_mass, self.mass, self._hook_stiffness, one.weight, one.weight, 0.0).time
        slow = one.weight / self._hook_stiffness / (speed or one.speed)
        return 1.2 * (rising + least + slow)

    def _rigid_time(self) -> float:
        """Time of start or stop of the rigid hoist [s]."""
        if self.released:
            return 0.0
        load = self.weight * self.arm / self.ratio
        speed = self.set_speed
        if isinstance(self.scene, Stop | LowerBrake):
            time, _ = braked_way(self.spec, self.scene)
            given = self.spec.brake
            assert given is not None
            return 1.2 * time if math.isfinite(time) else given.delay + given.rise_time + 1.0
        torque = motor_torque(self.spec)
        spare = max(torque - self.way * load / (model.efficiency(self.spec) * hauling_efficiency(self.spec)), 0.0)
        empty = model.motor_side_inertia(self.spec) * speed / torque if torque else 0.0
        rising = moving_inertia(self.spec, self.scene) * speed / spare if spare else empty
        return self._profile.rise_time + 1.2 * (empty + min(rising, 20 * empty))
