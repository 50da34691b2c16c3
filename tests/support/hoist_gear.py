"""Hoists whose gear gives and has play, drawn by a number and integrated by DOP853: nothing of ptmcalc is used.

Motor, gear, drum, rope, load; all that turns is counted on the drum shaft. The tackle has no losses: a drum that swings
on its gear would stick in them. The gear's own go by the direction of the power through it.
"""

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp
from scipy.linalg import eigh

from support.travelling_statics import G, text

_TIGHT = {"method": "DOP853", "rtol": 1e-10, "atol": 1e-12, "dense_output": True}
_SEEN = 6001
MOTOR_SPEED = 100.0


@dataclass(frozen=True)
class Geared:
    """A hoist in SI: motor and drum on the drum shaft, `torsion` and `play` of the gear there; `back` is what reaches
    the motor of a torque that drives it."""

    load: float
    stiffness: float
    arm: float
    ratio: float
    motor: float
    drum: float
    torsion: float
    play: float
    damping: float
    gear: float
    speed: float
    starting: float
    brake: float
    delay: float

    @property
    def weight(self) -> float:
        return self.load * G

    @property
    def back(self) -> float:
        return 2 - 1 / self.gear

    @property
    def dashpot(self) -> float:
        """Of the gear [N*m*s]."""
        return 2 * self.damping * math.sqrt(self.torsion * self.motor * self.drum / (self.motor + self.drum))

    def frequency(self) -> float:
        """Lowest of the free train [rad/s]."""
        c, k, r = self.torsion, self.stiffness, self.arm
        stiff = np.array([[c, -c, 0.0], [-c, c + k * r * r, -k * r], [0.0, -k * r, k]])
        return math.sqrt(eigh(stiff, np.diag([self.motor, self.drum, self.load]), eigvals_only=True)[1])

    def torque(self, twist: Any, rate: Any) -> Any:
        """Of the gear, by the flank that touches; its damping neither pulls nor more than doubles the push."""
        if not self.play:
            return self.torsion * twist + self.dashpot * rate
        side = np.sign(twist)
        deep = self.torsion * np.maximum(np.abs(twist) - self.play / 2, 0.0)
        return side * (deep + np.clip(self.dashpot * rate * side, -deep, deep))


def random_geared(rng: np.random.Generator) -> tuple[Geared, dict[str, Any]]:
    """A hoist as the reference knows it and as a file says it; two of three have play."""
    load, falls = float(rng.uniform(2e3, 2e4)), int(rng.choice([2, 4]))
    weight, length, deflection = load * G, float(rng.uniform(6, 20)), float(10 ** rng.uniform(-2.2, -1))
    stiffness, speed = weight / deflection, float(rng.uniform(0.1, 0.5)) * math.sqrt(G * deflection)
    arm = (0.4 + 0.02) / 2 / falls
    ratio, gear = MOTOR_SPEED * arm / speed, float(rng.uniform(0.8, 0.98))
    motor = float(10 ** rng.uniform(0, 1)) * load * arm**2
    drum = float(rng.uniform(0.05, 0.5)) * load * arm**2
    torsion = stiffness * arm**2 * float(10 ** rng.uniform(-0.3, 1.3))
    play = float(rng.choice([0.0, 1.0, 1.0])) * float(10 ** rng.uniform(-1, 0.7)) * weight * arm / torsion
    static = weight * arm / ratio
    one = Geared(
        load, stiffness, arm, ratio, motor, drum, torsion, play, float(rng.choice([0.0, rng.uniform(0.01, 0.1)])), gear,
        speed, float(rng.uniform(4, 12)) * static, float(rng.uniform(1.6, 4)) * static, float(rng.uniform(0, 0.2)),
    )  # fmt: skip
    data: dict[str, Any] = {
        "kind": "hoist",
        "load": text(load, "kg"),
        "height": text(length, "m"),
        "speed": {"main": text(speed, "m/s")},
        "reeving": {"falls": falls, "sheave_efficiency": 1},
        "rope": {
            "diameter": "0.02 m",
            "area": "200 mm^2",
            "modulus": text(stiffness * length / falls / 200e-6, "Pa"),
            "mass": "1e-9 kg/m",
        },
        "drum": {"diameter": "0.4 m", "length": "40 m", "pitch": "22 mm", "inertia": text(drum, "kg*m^2")},
        "gearbox": {
            "ratio": ratio,
            "efficiency": gear,
            "stiffness": text(torsion, "N*m/rad"),
            "backlash": text(play, "rad"),
            "damping": one.damping,
        },
        "motor": {
            "inertia": text(motor / ratio**2, "kg*m^2"),
            "coupling_inertia": "0 kg*m^2",
            "curve": {
                "type": "linear",
                "starting_torque": text(one.starting, "N*m"),
                "no_load_speed": text(MOTOR_SPEED, "rad/s"),
                "rated_torque": text(static, "N*m"),
            },
        },
        "brake": {"torque": text(one.brake, "N*m"), "delay": text(one.delay, "s")},
        "effects": {"rope_mass": "off", "rope_shortening": "off"},
        "scenes": [
            {"type": "lift", "profile": {"shape": "curve"}, "slack": text(deflection * rng.uniform(0.2, 2), "m")},
            {"type": "lower_brake"},
        ],
        "checks": {"gear_impact": float(rng.uniform(1.2, 3))},
    }
    return one, data


@dataclass
class Run:
    """A motion in pieces; y is turn of gear and drum, way of the load, and their speeds."""

    one: Geared
    start: np.ndarray
    twist: float
    pulled: float = 0.0
    """of the rope at the beginning [m]"""
    time: float = 0.0
    most: float = 0.0
    least: float = math.inf
    peak: float = 0.0
    lowest: float = math.inf
    backwards: float = 0.0
    """how fast the motor ran against its way [rad/s]"""
    y: np.ndarray = field(init=False)

    def __post_init__(self) -> None:
        self.y = self.start

    def rope(self, y: np.ndarray) -> Any:
        return np.maximum(self.one.stiffness * (self.one.arm * y[1] - y[2] + self.pulled), 0.0)

    def gear(self, y: np.ndarray) -> Any:
        return self.one.torque(y[0] - y[1] + self.twist, y[3] - y[4])

    def go(self, end: float, push: Any, *, ground: bool = False, held: bool = False, event: Any = None) -> bool:
        """A piece under the torque `push(t, speed)` on the drum shaft; whether an event ended it."""
        one = self.one

        def rate(t: float, y: np.ndarray) -> list[float]:
            torque, pull = float(self.gear(y)), float(self.rope(y))
            loss = 1 / one.gear if torque * y[3] > 0 else one.back
            turns = 0.0 if held else (push(t, y[3]) - loss * torque) / one.motor
            lifts = 0.0 if ground else (pull - one.weight) / one.load
            return [y[3], y[4], y[5], turns, (torque - pull * one.arm) / one.drum, lifts]

        if event is not None:
            event.terminal = True
        run = solve_ivp(rate, (self.time, end), self.y, events=event, **_TIGHT)
        seen = run.sol(np.linspace(self.time, run.t[-1], _SEEN))
        pull, torque = self.rope(seen), self.gear(seen)
        self.most, self.least = max(self.most, _peak(pull)), min(self.least, max(-_peak(-pull), 0.0))
        self.peak = max(self.peak, _peak(np.abs(torque)))
        self.lowest = min(self.lowest, -_peak(-seen[2]))
        self.time, self.y = float(run.t[-1]), run.y[:, -1]
        return event is not None and len(run.t_events[0]) > 0


def _peak(values: np.ndarray) -> float:
    """Largest value, between the looks by a parabola."""
    k = int(np.argmax(values))
    if not 0 < k < len(values) - 1:
        return float(values[k])
    left, middle, right = (float(one) for one in values[k - 1 : k + 2])
    bend = left - 2 * middle + right
    return middle - (right - left) ** 2 / 8 / bend if bend < 0 else middle


def lift(one: Geared, slack: float, end: float) -> dict[str, float] | None:
    """A load lifted off the ground from a motor at rest, which runs through the play and the slack of the rope; None
    where the load comes down again."""
    free = MOTOR_SPEED / one.ratio
    run = Run(one, np.zeros(6), -one.play / 2, -slack)

    def push(t: float, speed: float) -> float:
        return one.starting * one.ratio * (1 - speed / free)

    if not run.go(end, push, ground=True, event=lambda t, y: float(run.rope(y)) - one.weight):
        return None
    time, speed = run.time, float(run.y[4]) * one.arm
    run.lowest = math.inf
    run.go(end, push)
    if run.lowest < -1e-9:
        return None
    return {
        "rope_force_max": run.most,
        "bridge_force_max": run.most,
        "lift_off_factor": run.most / one.weight,
        "bridge_factor": run.most / one.weight,
        "lift_off_time": time,
        "lift_off_speed": speed,
        "backlash_torque_peak": run.peak,
        "gear_impact_factor": run.peak / one.weight / one.arm,
    }


def lower(one: Geared, end: float) -> dict[str, float] | None:
    """A lowered load that a brake on the motor's shaft stops; None where it pulls the motor through the brake again."""
    down, held = -one.speed / one.arm, one.weight * one.arm
    run = Run(
        one, np.array([0.0, 0.0, 0.0, down, down, -one.speed]), one.play / 2 + held / one.torsion,
        one.weight / one.stiffness,
    )  # fmt: skip
    if one.delay:
        run.go(one.delay, lambda t, speed: 0.0)
    if not run.go(end, lambda t, speed: one.brake * one.ratio, event=lambda t, y: float(y[3])):
        return None
    stopped, before = run.time, run.peak
    run.y[3], run.peak = 0.0, 0.0
    run.go(end, lambda t, speed: 0.0, held=True)
    if run.peak * one.back / one.ratio > one.brake:
        return None
    peak = max(before, run.peak)
    return {
        "rope_force_max": run.most,
        "rope_force_min": run.least,
        "bridge_force_max": run.most,
        "bridge_force_min": run.least,
        "lowering_brake_factor": run.most / one.weight,
        "bridge_factor": run.most / one.weight,
        "rope_force_share": run.least / one.weight,
        "stop_time": stopped,
        "stop_distance_lowering": -run.lowest,
        "backlash_torque_peak": peak,
        "gear_impact_factor": peak / one.weight / one.arm,
    }
