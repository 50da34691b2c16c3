"""Loads that drive the motors above their no-load speed, and the torque with which the motors brake them.

The statics of the train at steady speed: from the outermost inertia inwards each gear passes on the sum of the torques
beyond it, with the efficiency of the direction of its power.
"""

import math
from bisect import bisect_right
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.components.motor import AnyMotor, ConverterMotor, InductionBase
from ptmcalc.components.motor_torque import overhauled_torque
from ptmcalc.contract.result import Found, of
from ptmcalc.machines.drivetrain.machine.keys.torques import MotorOn
from ptmcalc.machines.drivetrain.machine.model import REACHED, Case, case_of
from ptmcalc.machines.drivetrain.machine.spec import Drivetrain, Stop, TrainScene
from ptmcalc.numerics.train.parts import Drive, Grip, Law, Mesh, Smooth, Spring, Straight
from ptmcalc.numerics.train.signals import Signal

LOAD = "braking_reserve"
_STEPS = 65
"""Speeds from no-load speed to that of the largest braking torque at which the loads are compared. A numerical choice:
more find a narrow minimum more closely and take longer."""
_BISECTIONS = 60
"""Halvings of the braking share of several motors, to 1e-18 of it: beyond the resolution 2e-16 of the floating point.
Fewer are faster and coarser."""
_ENDLESS = 1e6
"""Speed relative to no-load speed [1] at which a torque that grows without limit exceeds any load. A numerical choice.
A smaller value reports a runaway of motors that hold the load."""

Edge = Mesh | Spring | Grip


@dataclass(frozen=True, slots=True)
class Overhauled:
    """Motors that a load drives, by the name of the first: the least reserve, and whether it lasts.

    `lasting` is True where the torques end as they are at a moment with a reserve below 1.
    """

    motor: str
    reserve: float
    lasting: bool


def overhauled(spec: Drivetrain, scene: TrainScene) -> tuple[Overhauled, ...]:
    """The parts of the train whose motors a load drives at their no-load speed, each with its least reserve.

    **Range** parts that no link ties to the ground and no prescribed motion leads.
    **Error** none for torques that become steady; the others are judged by their worst moment.
    **Source** torque balance at steady speed.
    """
    if isinstance(scene, Stop) or not spec.motors:
        return ()
    return tuple(_overhauled(spec, scene))


def _overhauled(spec: Drivetrain, scene: TrainScene) -> Iterator[Overhauled]:
    case = case_of(spec, scene, backlash=False)
    for part in parts_with_motors(spec, case):
        times = [time for time in part.times() if scene.duration is None or time <= scene.duration]
        loads = {time: part.load(part.no_load, time) for time in times if part.on(time)}
        found = {time: part.reserve(time) for time, load in loads.items() if load > 0}
        if not found or math.isinf(min(found.values())):
            continue
        last = max(times)
        lasting = not part.varies and found.get(last, math.inf) < 1
        yield Overhauled(part.motors[0][0], min(found.values()), lasting)


def braking_reserve(spec: Drivetrain, scene: TrainScene) -> dict[str, Found]:
    """Braking torque of the motors relative to the overhauling torque, at the worst moment.

        reserve = max over w >= w_0 of M_brake(w)/M_load(w)

    **Range** as `overhauled`.
    **Error** none for one motor; of several 1e-18 of their share. Loads over the speed are compared at 65 speeds.
    **Source** torque balance at steady speed.

    Where a lower reserve than 1 does not last, the train may pass through it: no upper bound.
    """
    found = {}
    for one in overhauled(spec, scene):
        decided = one.lasting or one.reserve >= 1
        high = one.reserve if decided else math.inf
        found[of(LOAD, one.motor)] = Found(Estimate(one.reserve, one.reserve, high, model=0.0 if decided else math.inf))
    return found


def path_of(spec: Drivetrain, name: str) -> KeyPath:
    """The key with which the torques of a motor grow, or the motor."""
    curve = spec.motors[name].motor
    brakes = bool(curve.size_key) and overhauled_torque(curve) > 0
    return ("motors", name, "motor", curve.size_key) if brakes else ("motors", name)


# -- the motors -----------------------------------------------------------------------------------------------------


def _greatest(curve: AnyMotor) -> float:
    """Speed above the no-load speed from which the braking torque of a motor no longer grows [rad/s]."""
    no_load = curve.no_load_speed
    if no_load is None:
        return 0.0
    if isinstance(curve, ConverterMotor):
        return no_load + curve.limit / curve.stiffness
    if isinstance(curve, InductionBase):
        return (1 + curve.breakdown_slip) * no_load
    last = curve.stages[-1]
    if last.extends or last.pieces is None:
        return _ENDLESS * no_load
    beyond = [(torque, speed) for speed, torque in last.pieces if speed >= no_load]
    return min(beyond)[1] if beyond else no_load


# -- the statics ----------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class MotorPart:
    """A part of the train with motors. `tree` lists for each body the body that it passes its torque to, outermost
    first; `ratio` is the speed of each body over that of the first motor's."""

    case: Case
    motors: tuple[tuple[str, MotorOn], ...]
    tree: tuple[tuple[int, int, Edge], ...]
    ratio: Mapping[int, float]

    @property
    def root(self) -> int:
        return self.case.index(self.motors[0][1].at)

    @property
    def no_load(self) -> float:
        """Lowest no-load speed of the motors on the shaft of the first one; that of the start where none has one."""
        known = [speed for _, one in self.motors if (speed := self._on_root(one, one.motor.no_load_speed))]
        if known:
            return min(known)
        until, main = self.case.until, self.case.main
        return abs(until / self.ratio[main]) if until is not None and main in self.ratio else 0.0

    @property
    def greatest(self) -> float:
        """Speed of the first motor's shaft up to which a motor brakes more and more; infinite where always."""
        found = max(self._on_root(one, _greatest(one.motor)) or 0.0 for _, one in self.motors)
        return math.inf if found >= _ENDLESS * self.no_load else max(found, self.no_load)

    def _on_root(self, one: MotorOn, speed: float | None) -> float | None:
        return None if speed is None else abs(speed / self.ratio[self.case.index(one.at)])

    def drives(self) -> Iterator[Drive]:
        """Torques on the part that are not motors."""
        motors = {name for name, _ in self.motors}
        for drive in self.case.train.drives:
            if drive.body in self.ratio and drive.name not in motors and not drive.name.startswith(REACHED):
                yield drive

    def brakes(self) -> Iterator[Grip]:
        """Friction of the part against the ground."""
        return (one for one in self.case.train.grips if one.second is None and one.first in self.ratio)

    @property
    def varies(self) -> bool:
        """Whether a torque never becomes steady."""
        laws = [drive.stages[0].law for drive in self.drives()]
        return any(
            (isinstance(law, Signal) and bool(law.sines)) or (isinstance(law, Straight) and law.on == "position")
            for law in laws
        )

    def times(self) -> set[float]:
        """Times at which a torque or friction is extreme."""
        signals = [law for drive in self.drives() if isinstance(law := drive.stages[0].law, Signal)]
        signals += [one.capacity for one in self.brakes()]
        signals += [self._gate(name) for name, _ in self.motors]
        return {0.0, *(time for signal in signals for time in signal.times)}

    def _gate(self, name: str) -> Signal:
        return next((one.gate for one in self.case.train.drives if one.name == name), Signal.constant(0.0))

    def on(self, time: float) -> bool:
        """Whether a motor is switched on."""
        return any(_at(self._gate(name), time) > 0 for name, _ in self.motors)

    def load(self, speed: float, time: float) -> float:
        """Torque of the loads and of the friction on the first motor's shaft; positive where it drives the motor."""
        return self._reduced(self._loads(speed, time))

    def reserve(self, time: float) -> float:
        """Largest braking torque of the motors over what the load requires, from the no-load speed on."""
        top = min(self.greatest, _ENDLESS * self.no_load)
        speeds = {self._on_root(one, _greatest(one.motor)) or 0.0 for _, one in self.motors} | {top, self.no_load}
        if math.isfinite(self.greatest):
            speeds |= set(np.linspace(self.no_load, self.greatest, _STEPS).tolist())
        known = [self.at_speed(speed, time) for speed in speeds if self.no_load <= speed <= top]
        largest = max(known)
        return math.inf if math.isinf(self.greatest) and largest >= 1 else largest

    def at_speed(self, speed: float, time: float) -> float:
        """Braking torque of the motors over the overhauling torque at a speed; infinite without an overhauling load."""
        loads, brakes = self._loads(speed, time), dict[int, float]()
        for name, one in self.motors:
            body = self.case.index(one.at)
            torque = (
                one.count * float(one.motor.torque(self.ratio[body] * speed, math.inf))
                if self._is_on(name, time)
                else 0.0
            )
            if torque * self.ratio[body] < 0:
                brakes[body] = brakes.get(body, 0.0) + torque
            else:
                loads[body] = loads.get(body, 0.0) + torque
        driven = self._reduced(loads)
        if driven <= 0:
            return math.inf
        if not brakes:
            return 0.0
        if set(brakes) == {self.root}:
            return -brakes[self.root] / driven
        return 1 / self._share(loads, brakes)

    def _is_on(self, name: str, time: float) -> bool:
        return _at(self._gate(name), time) > 0

    def _share(self, loads: Mapping[int, float], brakes: Mapping[int, float]) -> float:
        """The share of their braking torques with which all motors together hold the loads."""
        low, high = 0.0, 1.0
        while self._reduced(_sum(loads, brakes, high)) > 0:
            low, high = high, 2 * high
            if high > _ENDLESS:
                return math.inf
        for _ in range(_BISECTIONS):
            middle = (low + high) / 2
            low, high = (middle, high) if self._reduced(_sum(loads, brakes, middle)) > 0 else (low, middle)
        return high

    def _loads(self, speed: float, time: float) -> dict[int, float]:
        """Torques on the bodies at a speed of the first motor's shaft, and at the worst phase and place."""
        found = dict.fromkeys(self.ratio, 0.0)
        for drive in self.drives():
            found[drive.body] += _torque(
                drive.stages[0].law, self.ratio[drive.body] * speed, time, self.ratio[drive.body]
            )
        for one in self.brakes():
            found[one.first] -= math.copysign(_at(one.capacity, time) * _at(one.gate, time), self.ratio[one.first])
        return found

    def _reduced(self, torques: Mapping[int, float]) -> float:
        """Sum of the torques on the first motor's shaft."""
        total = dict(torques)
        for body, towards, edge in self.tree:
            total[towards] += _passed(edge, body, total[body], self.ratio[body], self.ratio[towards])
        return total[self.root]


def _sum(loads: Mapping[int, float], brakes: Mapping[int, float], share: float) -> dict[int, float]:
    return {body: torque + share * brakes.get(body, 0.0) for body, torque in loads.items()}


def _passed(edge: Edge, body: int, torque: float, way: float, onward: float) -> float:
    """Torque that a gear, link or clutch passes on from the body that has this torque; `way` is its direction."""
    if isinstance(edge, Mesh):
        drives = torque * way > 0
        if body == edge.outer:
            return torque * edge.reverse / edge.ratio if drives else torque / (edge.ratio * edge.forward)
        if drives:
            return torque * edge.ratio * edge.forward
        if edge.reverse > 0 or torque == 0:
            return torque * edge.ratio / edge.reverse if torque else 0.0
        return -math.copysign(math.inf, onward)
    if isinstance(edge, Grip):
        most = _at(edge.capacity, math.inf)
        return min(max(torque, -most), most)
    # a rope pulls its second body along the positive direction with side 1
    pulls = torque * (1 if body == edge.first else -1) * edge.side
    return 0.0 if pulls < 0 else torque


def _torque(law: Law, speed: float, time: float, way: float) -> float:
    if isinstance(law, Signal):
        worst = sum(abs(sine.size) for sine in law.sines)
        return _at(law, time) + math.copysign(worst, way)
    if isinstance(law, Smooth):
        return float(law.value(np.array([speed]))[0])
    assert isinstance(law, Straight)
    if law.on == "position":
        return max(law.values) if way > 0 else min(law.values)
    inside = float(np.interp(speed, law.knots, law.values))
    if not law.extends or len(law.knots) < 2:
        return inside
    first, last = ((law.values[k + 1] - law.values[k]) / (law.knots[k + 1] - law.knots[k]) for k in (0, -2))
    return inside + first * min(speed - law.knots[0], 0.0) + last * max(speed - law.knots[-1], 0.0)


def _at(signal: Signal, time: float) -> float:
    """Value of a signal without its sines; before a trigger has fired what it is before."""
    if signal.trigger is not None:
        return signal.before
    piece = bisect_right(signal.times, time) - 1
    since = time - signal.times[piece]
    value = signal.values[piece] + (signal.slopes[piece] * since if signal.slopes[piece] else 0.0)
    if signal.decay and time >= signal.decay_start:
        value += signal.decay * math.exp(-(time - signal.decay_start) / signal.decay_time)
    return value


def parts_with_motors(spec: Drivetrain, case: Case) -> Iterator[MotorPart]:
    """The parts of the train that have motors and can run away."""
    train, left = case.train, dict(spec.motors)
    held = {spring.first for spring in train.springs if spring.second is None} | {one.body for one in train.guides}
    while left:
        root = case.index(next(iter(left.values())).at)
        ratio, tree = _spread(case, root)
        motors = tuple((name, one) for name, one in left.items() if case.index(one.at) in ratio)
        for name, _ in motors:
            del left[name]
        if not held & ratio.keys():
            yield MotorPart(case, motors, tree, ratio)


def _spread(case: Case, root: int) -> tuple[dict[int, float], tuple[tuple[int, int, Edge], ...]]:
    """Speeds of all bodies tied to one over its own, and how their torques come there, outermost first."""
    train = case.train
    edges: list[tuple[int, int, float, Edge]] = [(one.inner, one.outer, one.ratio, one) for one in train.meshes]
    edges += [(one.first, one.second, 1.0, one) for one in train.springs if one.second is not None]
    edges += [(one.first, one.second, 1.0, one) for one in train.grips if one.second is not None]
    ratio, tree = {root: 1.0}, list[tuple[int, int, Edge]]()
    waiting = [root]
    while waiting:
        body = waiting.pop(0)
        for inner, outer, speeds, edge in edges:
            if body == inner and outer not in ratio:
                ratio[outer] = ratio[body] / speeds
            elif body == outer and inner not in ratio:
                ratio[inner] = ratio[body] * speeds
            else:
                continue
            other = outer if body == inner else inner
            tree.append((other, body, edge))
            waiting.append(other)
    return ratio, tuple(reversed(tree))
