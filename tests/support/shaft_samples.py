"""Random main shafts whose bars are looked at, and the truth about them by the integration of `shafts.Reference`."""

import math
from typing import Any

import numpy as np
from scipy.optimize import brentq

from support.machines import changed
from support.shafts import Reference, number, random_shaft, text

TOLERANCE = 1e-13
"""Of the integration of its own."""
SHARE = 0.8
"""Of the speed without load, at which a run-up ends."""


def gentle_shaft(rng: np.random.Generator) -> dict[str, Any]:
    """A shaft with a flywheel whose effects lie about their thresholds: closed forms say something of most of them."""
    heaviness = float(np.exp(rng.uniform(np.log(1.2), np.log(6))))
    swing = float(np.exp(rng.uniform(np.log(1e-5), np.log(3e-2))))
    return _limited(rng, random_shaft(rng, heaviness=heaviness, swing=swing, inertia=_smooth(rng)))


def lively_shaft(rng: np.random.Generator) -> dict[str, Any]:
    """A shaft of any size whose effects count: inertia that swings, motor that works in the cycle."""
    heaviness = float(np.exp(rng.uniform(np.log(0.02), np.log(2))))
    swing = float(np.exp(rng.uniform(np.log(1e-3), np.log(0.4))))
    return _limited(rng, random_shaft(rng, heaviness=heaviness, swing=swing, inertia=_smooth(rng)))


def _smooth(rng: np.random.Generator) -> str:
    return str(rng.choice(["harmonics", "harmonics", "slider_crank", "table"]))


def _limited(rng: np.random.Generator, data: dict[str, Any]) -> dict[str, Any]:
    """With limits, so that every load is asked for; they are moved later on."""
    wide = {"irregularity": 0.5, "run_up_time": "1e6 s", "stop_angle": "1e6 rad", "stop_time": "1e6 s"}
    to = text(SHARE * free_speed(data), "rad/s")
    up = {"type": "run_up", "to": to, "from": text(float(rng.uniform(0, 6)), "rad")}
    return changed(data, checks=wide, scenes__0=up)


class Truth:
    """The loads of a shaft by an integration of its own, each found when it is asked for."""

    def __init__(self, data: dict[str, Any]) -> None:
        self.data = data
        self.reference = Reference(data, rtol=TOLERANCE)
        self._known: dict[str, dict[str, float]] = {}

    def of(self, scene: str) -> dict[str, float]:
        """The loads of a scene; none where the motor does not drive the machine."""
        if scene not in self._known:
            self._known[scene] = {"run_up": self._run_up, "steady": self._steady, "run_out": self._run_out}[scene]()
        return self._known[scene]

    def _run_up(self) -> dict[str, float]:
        one, target = self.reference, number(self.data["scenes"][0]["to"])
        spare = one.ratio * one.eta * one.motor(one.ratio * target) - one.friction - one.viscous * target
        if spare < 0.1 * one.friction and one.cycle(loaded=False)["speed_max"] < target:
            return {"run_up_time": math.inf, "run_up_angle": math.inf}
        time, angle = one.run_up(number(self.data["scenes"][0]["from"]), target)
        return {"run_up_time": time, "run_up_angle": angle}

    def _steady(self) -> dict[str, float]:
        try:
            found = self.reference.cycle()
        except ValueError:
            return {}
        ends = [self.reference.motor(self.reference.ratio * found[name]) for name in ("speed_min", "speed_max")]
        found["torque_motor_max"] = max(abs(torque) for torque in ends)
        return found

    def _run_out(self) -> dict[str, float]:
        cycle = self.of("steady")
        if not cycle:
            return {}
        start = self.start
        speed = self.reference.speed_at(start, cycle["start"])
        time, angle = self.reference.run_out(start, speed)
        return {"run_out_time": time, "run_out_angle": angle, "speed_run_out": speed}

    @property
    def start(self) -> float:
        """Angle at which the run-out begins [rad]."""
        return number(next(one for one in self.data["scenes"] if one["type"] == "run_out")["from"])

    def works_on_the_stable_branch(self) -> bool:
        """Whether the largest torque of the cycle is one at its slowest or fastest."""
        cycle = self.of("steady")
        w = np.linspace(cycle["speed_min"], cycle["speed_max"], 200) * self.reference.ratio
        torques = np.array([self.reference.motor(one) for one in w])
        return bool(np.all(np.diff(torques) < 0))

    def brake_for(self, angle: float) -> float:
        """Brake torque with which the run-out turns by an angle."""
        speed = self.of("run_out")["speed_run_out"]

        def over(torque: float) -> float:
            braked = Reference(self.data, brake=torque, rtol=100 * TOLERANCE)
            return angle / braked.run_out(self.start, speed)[1] - 1

        guess = self.reference.brake_torque
        low, high = guess, guess
        while over(low) > 0:
            low /= 1.5
        while over(high) < 0:
            high *= 1.5
        return low if low == high else float(brentq(over, low, high, xtol=1e-10 * high, rtol=1e-12))


def free_speed(data: dict[str, Any]) -> float:
    """Speed of the main shaft without load [rad/s]."""
    motor = data["drive"]["motor"]
    free = number(motor["synchronous_speed" if motor["type"] == "induction" else "no_load_speed"])
    return free / float(data["drive"]["gear"]["ratio"])


def finite(values: dict[str, float]) -> bool:
    """Whether all of them are numbers."""
    return all(math.isfinite(value) for value in values.values())


__all__ = ["TOLERANCE", "Truth", "finite", "free_speed", "gentle_shaft", "lively_shaft", "text"]
