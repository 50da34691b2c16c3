"""Torque through a torque limiter by finite elements of the chain and Newton's law of the motors. Imports nothing from
`ptmcalc`.

The torque on the sprocket shaft is what the motors give less what their own inertia takes; the acceleration of the
sprocket comes from elements of both strands.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp
from scipy.linalg import eigh, expm

from support import chain_fem

G = 9.81
_UNITS = {"m": 1, "mm": 1e-3, "kg/m": 1, "N": 1, "kN": 1e3, "MN": 1e6, "kg*m^2": 1, "m/s": 1, "N*m": 1, "kN*m": 1e3,
          "s": 1}  # fmt: skip


def number(text: Any) -> float:
    """A quantity of a design file in SI."""
    if isinstance(text, int | float):
        return float(text)
    value, unit = text.split()
    return float(value) * _UNITS[unit]


@dataclass(frozen=True)
class Rig:
    """A conveyor as its file describes it."""

    data: Mapping[str, Any]

    def at(self, *path: str, default: Any = 0.0) -> float:
        node: Any = self.data
        for key in path:
            if key not in node:
                return float(default)
            node = node[key]
        return number(node)

    @property
    def pitch(self) -> float:
        return self.at("chain", "pitch")

    @property
    def teeth(self) -> int:
        return int(self.data["sprocket"]["teeth"])

    @property
    def arm(self) -> float:
        return self.pitch * self.teeth / (2 * math.pi)

    @property
    def radius(self) -> float:
        return self.pitch / (2 * math.sin(math.pi / self.teeth))

    @property
    def length(self) -> float:
        return self.at("layout", "length")

    @property
    def chain(self) -> float:
        return self.at("chain", "mass")

    @property
    def load(self) -> float:
        return self.at("layout", "load")

    @property
    def stiffness(self) -> float:
        return int(self.data["chain"]["count"]) * self.at("chain", "stiffness")

    @property
    def fixed(self) -> bool:
        return bool(self.data["layout"]["takeup"]["type"] == "screw")

    @property
    def speed(self) -> float:
        return self.at("speed")

    def rises(self, grown: float) -> tuple[float, float]:
        """What the tension rises along the return and the working strand."""
        layout = self.data["layout"]
        c = layout["resistance"]["coefficient"]
        of_load = layout["resistance"].get("load_coefficient", c)
        lift = self.at("layout", "lift")
        level = math.sqrt(self.length**2 - lift**2)
        factor = layout["resistance"]["turn_factor"] * grown * G * level
        return (
            factor * c * self.chain - self.chain * G * lift,
            factor * (c * self.chain + of_load * self.load) + (self.chain + self.load) * G * lift,
        )

    def resistance(self, grown: float) -> float:
        return sum(self.rises(grown))

    def leaving(self, grown: float) -> float:
        """Static tension of the leaving chain."""
        tension = self.at("layout", "takeup", "tension")
        if not self.fixed:
            return tension
        back, working = self.rises(grown)
        return tension - (back / 2 + back + working / 2) / 2

    @property
    def tail_mass(self) -> float:
        teeth = self.data["layout"]["tail"]["teeth"]
        return self.at("layout", "tail", "inertia") / (self.pitch * teeth / (2 * math.pi)) ** 2

    @property
    def moving(self) -> float:
        return self.length * (2 * self.chain + self.load) + self.tail_mass

    @property
    def sprocket(self) -> float:
        return self.at("sprocket", "inertia") / self.arm**2

    @property
    def eta(self) -> float:
        return float(self.data["drive"]["gear"]["efficiency"])

    @property
    def ratio(self) -> float:
        return float(self.data["drive"]["gear"]["ratio"])

    def rotor(self, losses: float) -> float:
        """Motors and couplings as a mass at the chain."""
        own = self.at("drive", "motor", "inertia") + self.at("drive", "coupling_inertia")
        return losses * own * (self.ratio / self.arm) ** 2

    @property
    def pull(self) -> float:
        """Of the motors at the chain."""
        return self.eta * self.at("drive", "motor", "mean_starting_torque") * self.ratio / self.arm

    def elements(self, pieces: int, drive: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Masses, stiffness, rows of the tensions at the run-on and at the run-off, extrapolated to the sprocket."""
        strands = tuple(chain_fem.Strand(self.length, line, self.stiffness) for line in (self.chain + self.load,
                                                                                         self.chain))  # fmt: skip
        mass, stiff = chain_fem.matrices(chain_fem.Chain(strands, self.tail_mass), pieces, lumped=True)
        count = len(mass)
        rows = np.zeros((count - 1, count))
        for k in range(count - 1):
            rows[k, [k, k + 1]] = stiff[k, k + 1] * np.array([-1, 1])
        ends = np.stack([(3 * rows[0] - rows[1]) / 2, (3 * rows[-1] - rows[-2]) / 2])
        mass[0, 0] += drive
        if self.fixed:
            join = np.eye(count, count - 1)
            join[-1, 0] = 1.0
            mass, stiff, ends = join.T @ mass @ join, join.T @ stiff @ join, ends @ join
        else:
            ends[1] = 0.0
        return np.diag(mass).copy(), stiff, ends

    @property
    def retardation(self) -> float:
        """Of Kelvin-Voigt damping whose ratio is that of the first mode with the sprocket held."""
        m, k, _ = self.elements(120, 0.0)
        first = math.sqrt(eigh(k[1:, 1:], np.diag(m[1:]), eigvals_only=True, subset_by_index=[0, 0])[0])
        return 2 * float(self.data["chain"]["damping"]["ratio"]) / first

    def arms(self, way: np.ndarray, lead: float) -> tuple[np.ndarray, np.ndarray]:
        """Lever arms of the entering and the leaving chain, half a turn apart, over the way of the chain."""
        places = [(way / self.pitch + lead + shift) % 1.0 - 0.5 for shift in (0.0, self.teeth / 2)]
        on, off = (self.radius * np.cos(2 * math.pi / self.teeth * place) for place in places)
        return on, off


@dataclass(frozen=True)
class Course:
    """Times, force of the motors at the chain over the resistance, acceleration of the sprocket, tensions above the
    static ones at both sides of it."""

    times: np.ndarray
    excess: np.ndarray
    acceleration: np.ndarray
    entering: np.ndarray
    leaving: np.ndarray


def simulated(
    rig: Rig, drive: float, excess: Callable[[float], float], window: float, pieces: int = 60, steps: int = 2000
) -> Course:
    """M u'' + eta K u' + K u = F(t) at the drive, from steady motion, F straight over each step: by the exponential of
    the first-order form. Each step has both of its ends."""
    m, k, ends = rig.elements(pieces, drive)
    n, dt, eta = len(m), window / steps, rig.retardation
    rate = np.zeros((2 * n + 2, 2 * n + 2))
    rate[:n, n : 2 * n] = np.eye(n)
    rate[n : 2 * n, :n], rate[n : 2 * n, n : 2 * n] = -k / m[:, None], -eta * k / m[:, None]
    rate[n, 2 * n] = 1 / m[0]
    rate[2 * n, 2 * n + 1] = 1.0
    step = expm(rate * dt)
    state, found = np.zeros(2 * n), []
    for j in range(steps):
        begin, end = excess(j * dt + 1e-9 * dt), excess((j + 1) * dt - 1e-9 * dt)
        found.append(_seen(j * dt, begin, state, m, k, ends, eta))
        state = (step @ np.concatenate([state, [begin, (end - begin) / dt]]))[: 2 * n]
        found.append(_seen((j + 1) * dt, end, state, m, k, ends, eta))
    return Course(*np.array(found).T)


def _seen(
    time: float, force: float, state: np.ndarray, m: np.ndarray, k: np.ndarray, ends: np.ndarray, eta: float
) -> tuple[float, float, float, float, float]:
    n = len(m)
    both = state[:n] + eta * state[n:]
    on, off = ends @ both
    return time, force, (force - float(k[0] @ both)) / m[0], float(on), float(off)


def start(rig: Rig, rise: Callable[[float], float], lead: float) -> tuple[float, float]:
    """Largest force through the limiter in a start, and the largest torque at the arms of a passing tooth."""
    grown = rig.data["layout"]["resistance"]["start_factor"]
    still, rotor = rig.resistance(grown), rig.rotor(rig.eta)
    drive = rotor + rig.sprocket
    whole = drive + rig.moving
    ticks = np.linspace(0.0, 60.0, 600_001)
    pulled = np.maximum(rig.pull * np.array([rise(t) for t in ticks]) - still, 0.0)
    speeds = np.concatenate([[0.0], np.cumsum((pulled[1:] + pulled[:-1]) / 2) * ticks[1]]) / whole
    held = float(ticks[int(np.argmax(pulled > 0))])
    at_speed = float(np.interp(rig.speed, speeds, ticks))

    def excess(t: float) -> float:
        return max(rig.pull * rise(t + held) - still, 0.0) if t + held < at_speed else 0.0

    transit = sum(rig.length * math.sqrt(line / rig.stiffness) for line in (rig.chain, rig.chain + rig.load))
    found = simulated(rig, drive, excess, at_speed - held + 4 * transit)
    force = still + found.excess - rotor * found.acceleration
    way = np.interp(found.times, ticks, np.cumsum(np.minimum(speeds, rig.speed)) * ticks[1])
    on, off = rig.arms(way, lead)
    leaving = rig.leaving(grown)
    tensions = on * (leaving + still + found.entering) - off * (leaving + found.leaving)
    torque = tensions + rig.sprocket * found.acceleration * rig.arm
    return float(np.abs(force).max()), float(np.abs(torque).max())


def stop(rig: Rig, brake: Mapping[str, Any]) -> float:
    """Largest force through the limiter of a running conveyor without gear losses that a brake stops."""
    grown = rig.data["layout"]["resistance"]["stop_factor"]
    still, rotor = rig.resistance(grown), rig.rotor(1.0)
    drive = rotor + rig.sprocket
    whole, behind = drive + rig.moving, brake["shaft"] == "sprocket"
    full = number(brake["torque"]) / rig.arm * (1.0 if behind else rig.ratio)
    delay, rise = number(brake["delay"]), number(brake["rise_time"])

    def braked(t: float) -> float:
        return full * min(max((t - delay) / rise, 0.0), 1.0)

    ticks = np.linspace(0.0, 30.0, 300_001)
    decelerations = (still + np.array([braked(t) for t in ticks])) / whole
    lost = np.concatenate([[0.0], np.cumsum((decelerations[1:] + decelerations[:-1]) / 2) * ticks[1]])
    rest = float(ticks[int(np.argmax(lost >= rig.speed))])
    found = simulated(rig, drive, lambda t: -still - braked(t), rest)
    motors = np.zeros(len(found.times)) if behind else still + found.excess
    return max(float(np.abs(motors - rotor * found.acceleration).max()), still)


def toothed_start(rig: Rig, lead: float, pieces: int = 16) -> tuple[float, float]:
    """Largest force through the limiter in a start by a step with every tooth that passes, and the largest torque at
    the arms of the teeth, of a gravity take-up, by DOP853."""
    grown = rig.data["layout"]["resistance"]["start_factor"]
    still, rotor = rig.resistance(grown), rig.rotor(rig.eta)
    drive = rotor + rig.sprocket
    m, k, ends = rig.elements(pieces, drive)
    n, eta, excess, leaving = len(m), rig.retardation, rig.pull - still, rig.leaving(grown)
    a, half = excess / (drive + rig.moving), math.pi / rig.teeth
    at_speed, gained = rig.speed / a, rig.speed**2 / a / 2
    transit = sum(rig.length * math.sqrt(line / rig.stiffness) for line in (rig.chain, rig.chain + rig.load))
    window, state, now, tooth = at_speed + 3 * transit, np.zeros(2 * n), 0.0, 0
    most, torque = still, still * rig.arm
    while now < window - 1e-12:
        way = (tooth + 1 - lead) * rig.pitch
        speeds_up = now < at_speed - 1e-12
        engages = math.sqrt(2 * way / a) if way < gained else at_speed + (way - gained) / rig.speed
        end = min(engages, at_speed if speeds_up else window)

        def polygon(t: float, tooth: int = tooth, speeds_up: bool = speeds_up) -> float:
            """Acceleration of the run-on against the mean motion of the sprocket."""
            rate, speed = (a, a * t) if speeds_up else (0.0, rig.speed)
            gone = a * t * t / 2 if speeds_up else gained + rig.speed * (t - at_speed)
            phi = 2 * half * (gone / rig.pitch + lead - tooth - 0.5)
            return rig.radius * (rate / rig.arm * math.cos(phi) - (speed / rig.arm) ** 2 * math.sin(phi)) - rate

        def force(t: float, y: np.ndarray, polygon: Any = polygon, speeds_up: bool = speeds_up) -> np.ndarray:
            found = -(k @ (y[:n] + eta * y[n:]))
            found[0] += (excess if speeds_up else 0.0) + drive * polygon(t)
            return found

        def motion(t: float, y: np.ndarray, force: Any = force) -> np.ndarray:
            return np.concatenate([y[n:], force(t, y) / m])

        looks = np.linspace(now, end, 40)
        run = solve_ivp(motion, (now, end), state, "DOP853", looks, rtol=1e-7, atol=1e-11)
        motors = still + (excess if speeds_up else 0.0)
        for t, y in zip(looks, run.y.T, strict=True):
            sprocket = force(t, y)[0] / m[0] - polygon(t)
            most = max(most, abs(motors - rotor * sprocket))
            gone = a * t * t / 2 if speeds_up else gained + rig.speed * (t - at_speed)
            place = 2 * half * (gone / rig.pitch + lead - tooth - 0.5)
            other = 2 * half * ((gone / rig.pitch + lead + rig.teeth / 2) % 1.0 - 0.5)
            entering = leaving + still + float(ends[0] @ (y[:n] + eta * y[n:]))
            arms = rig.radius * math.cos(place) * entering - rig.radius * math.cos(other) * leaving
            torque = max(torque, abs(arms + rig.sprocket * sprocket * rig.arm))
        state, now, tooth = run.y[:, -1], end, tooth + (end == engages)
    return most, torque


def running(rig: Rig) -> tuple[float, float]:
    """Largest torque on the shaft of a sprocket that turns evenly, and the smallest one, of a gravity take-up."""
    strands = tuple(chain_fem.Strand(rig.length, line, rig.stiffness) for line in (rig.chain + rig.load, rig.chain))
    chain, places = chain_fem.Chain(strands, rig.tail_mass), np.linspace(0.0, 1.0, 401)
    sprocket = chain_fem.Sprocket(rig.pitch, rig.teeth, rig.speed)
    swing = chain_fem.periodic_force(chain, sprocket, rig.retardation, places, 200)
    on, off = rig.arms(places[:-1] * rig.pitch, 0.0)
    still, leaving = rig.resistance(1.0), rig.leaving(1.0)
    torque = on * (leaving + still + swing[:-1]) - off * leaving
    return float(torque.max()), float(torque.min())


def jammed(mass: float, cap: float, trips: int = 40, looks: int = 400) -> float:
    """Largest tension at a rigid obstacle that stops a chain, over its tension before: unit impedance, speed and mass
    of the chain between obstacle and sprocket; `mass` of the sprocket, which the motors drive by at most `cap`.

    A wave that leaves the sprocket is back after two travel times with its sign kept by the obstacle. Until the limiter
    slips the sprocket keeps its speed, then m v' = cap - S, until it has its speed again.
    """
    left, dt = np.empty(looks * trips), 2.0 / looks
    speed, slips, most = 1.0, False, 1.0
    for k in range(len(left)):
        back = -0.5 if 2 * k < looks else 0.5 if k < looks else left[k - looks]
        slips = slips or 2 * back + speed >= cap
        if slips:
            final = cap - 2 * back
            speed = final + (speed - final) * math.exp(-dt / mass) if mass > 0 else final
            if speed > 1.0:
                speed, slips = 1.0, False
        left[k] = back + speed
        most = max(most, 2 * left[k])
    return most
