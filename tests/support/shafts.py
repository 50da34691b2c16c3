"""Main shafts for tests: random machines as design files, and a second way to compute them that shares nothing.

`Reference` reads the data of a design file whose values are in SI units, writes the equations of motion from the
textbook, and integrates them with scipy's DOP853 from break to break.
"""

import math
from collections.abc import Callable
from itertools import pairwise
from typing import Any

import numpy as np
import yaml
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from scipy.optimize import brentq

from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.shaft.machine.spec import Shaft
from support.machines import loaded

TURN = 2 * math.pi

C23: dict[str, Any] = {
    "kind": "shaft",
    "inertia": {
        "type": "harmonics",
        "mean": "34 kg*m^2",
        "terms": [{"order": 2, "cosine": "-4 kg*m^2"}],
    },
    "drive": {
        "motor": {
            "type": "induction",
            "power": "5500 W",
            "speed": f"{1440 * TURN / 60!r} rad/s",
            "synchronous_speed": f"{1500 * TURN / 60!r} rad/s",
            "overload": 2.3,
        },
        "gear": {"ratio": 12, "efficiency": 0.94},
    },
    "load": {
        "type": "sectors",
        "sectors": [{"from": "4.71239 rad", "to": "6.28319 rad", "torque": "900 N*m"}],
    },
    "losses": {"torque": "35 N*m"},
    "brake": {"torque": "300 N*m", "delay": "0 s", "rise": "0 s"},
    "checks": {"irregularity": 0.02, "run_up_time": "2 s", "stop_angle": "7 rad", "stop_time": "2 s"},
    "scenes": [{"type": "run_up"}, {"type": "steady"}, {"type": "run_out", "from": "0 rad"}],
}
"""The worked case: a main shaft with J = 30 + 8 sin^2, induction motor, useful torque in the last quarter."""


def template() -> dict[str, Any]:
    """The data of the shaft's own template."""
    data = yaml.safe_load(load_kind("shaft").template)
    assert isinstance(data, dict)
    return data


def spec_of(data: dict[str, Any]) -> Shaft:
    """The filled-in spec of a shaft."""
    spec = loaded(data).spec
    assert isinstance(spec, Shaft)
    return spec


def text(value: float, unit: str) -> str:
    return f"{value:.17g} {unit}"


def number(value: Any) -> float:
    """The number of a value in SI units."""
    return float(str(value).split()[0])


def random_shaft(rng: np.random.Generator, **fixed: Any) -> dict[str, Any]:
    """One machine as the data of a design file, in SI units: two decades of size, several kinds of inertia and load.

    `fixed` sets `inertia`, `motor`, `swing` (share of the inertia that changes), `heaviness` (inertia over what the
    motor masters in a cycle) or `loaded` (mean load over rated torque) instead of drawing them.
    """
    ratio = float(np.exp(rng.uniform(np.log(1.0), np.log(30))))
    rated = float(np.exp(rng.uniform(np.log(5), np.log(500))))  # N*m on the motor shaft
    synchronous = float(rng.choice([78.5, 104.7, 157.1]))
    slip = float(rng.uniform(0.02, 0.1))
    efficiency = float(rng.uniform(0.85, 0.97))
    torque = rated * ratio * efficiency
    speed = synchronous / ratio
    slope = torque / (slip * speed)
    heaviness = fixed.get("heaviness") or float(np.exp(rng.uniform(np.log(0.05), np.log(20))))
    inertia = slope * TURN / speed * heaviness
    kind = fixed.get("motor") or rng.choice(["induction", "induction", "linear"])
    motor: dict[str, Any] = {
        "type": str(kind),
        "power": text(rated * synchronous * (1 - slip), "W"),
        "speed": text(synchronous * (1 - slip), "rad/s"),
        "synchronous_speed": text(synchronous, "rad/s"),
        "overload": float(rng.uniform(1.8, 3.0)),
    }
    if kind == "linear":
        motor = {
            "type": "linear",
            "starting_torque": text(rated * rng.uniform(2, 6), "N*m"),
            "no_load_speed": text(synchronous, "rad/s"),
            "rated_torque": text(rated, "N*m"),
            "largest_torque": text(3 * rated, "N*m"),
        }
    load = fixed.get("loaded") or float(rng.uniform(0.2, 0.7))
    width, start = float(rng.uniform(0.4, 3.0)), float(rng.uniform(0, TURN))
    friction = 0.05 * torque * float(rng.uniform(0.5, 2))
    data: dict[str, Any] = {
        "kind": "shaft",
        "inertia": _random_inertia(rng, inertia, fixed),
        "drive": {"motor": motor, "gear": {"ratio": ratio, "efficiency": efficiency}},
        "load": {
            "type": "sectors",
            "sectors": [
                {
                    "from": text(start, "rad"),
                    "to": text(start + width, "rad"),
                    "torque": text(load * torque * TURN / width, "N*m"),
                }
            ],
        },
        "losses": {
            "torque": text(friction, "N*m"),
            "viscous": text(friction / speed * float(rng.choice([0.0, 0.5])), "N*m*s/rad"),
            "share": float(rng.choice([0.0, 0.05])),
        },
        "brake": {
            "torque": text(torque * float(rng.uniform(0.5, 5)), "N*m"),
            "delay": text(float(rng.choice([0.0, 0.2, 0.5])) / speed, "s"),
            "rise": text(float(rng.choice([0.0, 0.3])) / speed, "s"),
        },
        "checks": {"irregularity": 0.1},
        "scenes": [{"type": "run_up"}, {"type": "steady"}, {"type": "run_out", "from": text(rng.uniform(0, 6), "rad")}],
    }
    if rng.random() < 0.4:
        data["potential"] = [
            {"type": "harmonic", "order": 1, "sine": text(0.3 * friction * float(rng.normal()), "N*m")}
        ]
    if rng.random() < 0.3:
        data["drive"]["motor_inertia"] = text(0.3 * inertia / ratio**2, "kg*m^2")
    return data


def _random_inertia(rng: np.random.Generator, mean: float, fixed: dict[str, Any]) -> dict[str, Any]:
    swing = fixed.get("swing")
    swing = float(np.exp(rng.uniform(np.log(1e-4), np.log(0.4)))) if swing is None else swing
    kind = fixed.get("inertia") or rng.choice(["harmonics", "table", "slider_crank"])
    if kind == "harmonics":
        order = int(rng.choice([1, 2]))
        return {
            "type": "harmonics",
            "mean": text(mean, "kg*m^2"),
            "terms": [{"order": order, "cosine": text(mean * swing * 0.6, "kg*m^2"), "sine": text(0.0, "kg*m^2")}],
        }
    if kind == "table":
        angles = np.linspace(0, TURN, 9)[:-1]
        values = mean * (1 + swing * np.sin(angles + rng.uniform(0, 6)))
        points = [{"angle": text(a, "rad"), "inertia": text(v, "kg*m^2")} for a, v in zip(angles, values, strict=True)]
        return {"type": "table", "points": points}
    radius = 0.1
    return {
        "type": "slider_crank",
        "crank_radius": text(radius, "m"),
        "rod_length": text(0.45, "m"),
        "crank_inertia": text(mean, "kg*m^2"),
        "slider_mass": text(max(mean * swing / radius**2, 1e-3), "kg"),
        "rod_mass": "0 kg",
        "rod_centre": 0.3,
        "rod_inertia": "0 kg*m^2",
    }


class Reference:
    """A shaft by the equations of the textbook, integrated with DOP853 from break to break."""

    def __init__(
        self, data: dict[str, Any], added: float = 0.0, brake: float | None = None, rtol: float = 1e-12
    ) -> None:
        self.data, self.added, self.rtol = data, added, rtol
        drive = data["drive"]
        self.ratio, self.eta = float(drive["gear"]["ratio"]), float(drive["gear"]["efficiency"])
        self.multiplies = drive["gear"].get("braking") == "multiplies"
        self.rotor = number(drive.get("motor_inertia", 0))
        losses = data.get("losses", {})
        self.friction, self.viscous = number(losses.get("torque", 0)), number(losses.get("viscous", 0))
        self.share = number(losses.get("share", 0))
        self.brake = data.get("brake") or {"torque": 0, "delay": 0}
        self.brake_torque = number(self.brake["torque"]) if brake is None else brake
        self.inertia = self._inertia(data["inertia"])
        self.breaks, self.useful = self._load(data.get("load"))
        self.knots = [number(p["angle"]) for p in data["inertia"].get("points", ())]
        self.motor, self.free = self._motor(drive["motor"])

    # -- parts

    def _inertia(self, given: dict[str, Any]) -> Callable[[float], tuple[float, float]]:
        kind = given["type"]
        if kind == "constant":
            value = number(given["value"])
            return lambda phi: (value, 0.0)
        if kind == "harmonics":
            mean = number(given["mean"])
            terms = [(t["order"], number(t.get("cosine", 0)), number(t.get("sine", 0))) for t in given["terms"]]
            return lambda phi: (
                mean + sum(c * math.cos(k * phi) + s * math.sin(k * phi) for k, c, s in terms),
                sum(k * (s * math.cos(k * phi) - c * math.sin(k * phi)) for k, c, s in terms),
            )
        if kind == "table":
            x = np.array([number(p["angle"]) for p in given["points"]])
            y = np.array([number(p["inertia"]) for p in given["points"]])
            curve = CubicSpline(np.append(x, x[0] + TURN), np.append(y, y[0]), bc_type="periodic")
            slope = curve.derivative()
            return lambda phi: (float(curve(phi)), float(slope(phi)))
        r, length = number(given["crank_radius"]), number(given["rod_length"])
        base, mass = number(given["crank_inertia"]), number(given["slider_mass"])

        def crank(phi: float) -> tuple[float, float]:
            """x' = -r sin - r^2 sin cos/q,  q = sqrt(l^2 - r^2 sin^2)."""
            s, c = math.sin(phi), math.cos(phi)
            q = math.sqrt(length**2 - r * r * s * s)
            first = -r * s - r * r * s * c / q
            second = -r * c - r * r * ((c * c - s * s) / q + r * r * s * s * c * c / q**3)
            return base + mass * first**2, 2 * mass * first * second

        return crank

    def _load(self, given: dict[str, Any] | None) -> tuple[list[float], Callable[[float], float]]:
        if given is None:
            return [], lambda phi: 0.0
        parts = [[number(sector[key]) for key in ("from", "to", "torque")] for sector in given["sectors"]]
        spans = [(start % TURN, to - start, torque) for start, to, torque in parts]
        breaks = sorted({edge % TURN for start, width, _ in spans for edge in (start, start + width)})
        return breaks, lambda phi: sum(m for start, width, m in spans if (phi - start) % TURN < width)

    def _motor(self, given: dict[str, Any]) -> tuple[Callable[[float], float], float]:
        """Torque over the speed of the motor."""
        if given["type"] == "linear":
            start, free = number(given["starting_torque"]), number(given["no_load_speed"])
            return lambda w: start * (1 - w / free), free
        if given["type"] == "constant":
            value = number(given["torque"])
            return lambda w: value, math.inf
        free, at = number(given["synchronous_speed"]), number(given["speed"])
        rated, s_n, overload = number(given["power"]) / at, 1 - at / free, float(given["overload"])
        s_k = s_n * (overload + math.sqrt(overload**2 - 1))

        def kloss(w: float) -> float:
            s = 1 - w / free
            return 2 * overload * rated * s * s_k / (s * s + s_k * s_k)

        return kloss, free

    def potential(self, phi: float) -> float:
        """Torque of weights and springs."""
        total = 0.0
        for p in self.data.get("potential", ()):
            total += number(p.get("cosine", 0)) * math.cos(p["order"] * phi)
            total += number(p.get("sine", 0)) * math.sin(p["order"] * phi)
        return total

    def epsilon(self, phi: float, w: float, useful: float, motor: float, brake: float) -> float:
        """From the equations of both shafts, with the sense of the power through the gear that agrees with itself."""
        return self.both_ways(phi, w, useful, motor, brake)[0]

    def both_ways(self, phi: float, w: float, useful: float, motor: float, brake: float) -> tuple[float, float]:
        """Acceleration, and the torque through the gear that decides."""
        inertia, slope = self.inertia(phi)
        inertia += self.added
        resist = self.friction + self.viscous * w + useful + self.share * abs(useful) + self.potential(phi) + brake
        resist += slope * w * w / 2
        u, found = self.ratio, []
        for factor in (self.eta, self.eta if self.multiplies else 1 / self.eta):
            e = (u * factor * motor - resist) / (inertia + factor * u * u * self.rotor)
            found.append((e, motor - self.rotor * u * e))
        return found[0] if self.multiplies or found[0][1] >= 0 else found[1]

    # -- the cycle

    def _stretches(self, low: float, high: float, loaded: bool) -> list[tuple[float, float, float]]:
        """(begin, end, useful torque) between the breaks of the load."""
        turns = range(math.floor(low / TURN) - 1, math.ceil(high / TURN) + 2)
        breaks = [*self.breaks, *self.knots]
        edges = sorted({low, high, *(b + k * TURN for b in breaks for k in turns if low < b + k * TURN < high)})
        return [(a, b, self.useful((a + b) / 2) if loaded else 0.0) for a, b in pairwise(edges)]

    def once_round(self, w: float, loaded: bool = True, dense: bool = False) -> Any:
        """Speed a turn later; with `dense` the solutions over the angle as well. Raises ValueError at rest."""
        solutions = []
        for low, high, useful in self._stretches(0.0, TURN, loaded):

            def slope(phi: float, y: Any, useful: float = useful) -> list[float]:
                speed = math.sqrt(2 * max(y[0], 1e-300))
                motor = self.motor(self.ratio * speed)
                return [self.epsilon(phi, speed, useful, motor, 0.0), 1 / speed, motor**2 / speed, speed]

            done = solve_ivp(
                slope, (low, high), [w * w / 2, 0.0, 0.0, 0.0], method="DOP853", rtol=self.rtol, atol=1e-14 * w * w,
                max_step=0.1, dense_output=dense,
            )  # fmt: skip
            if not done.success or done.y[0, -1] <= 0:
                raise ValueError("stalled")
            solutions.append((low, high, useful, done))
            w = math.sqrt(2 * done.y[0, -1])
        return (w, solutions) if dense else w

    def cycle(self, loaded: bool = True) -> dict[str, float]:
        """The steady cycle from the root of the Poincare map, near the speed without load."""
        top = 1.3 * self.free / self.ratio

        def gain(w: float) -> float:
            try:
                return float(self.once_round(w, loaded)) - w
            except ValueError:
                return -w

        low = top
        while gain(low) <= 0:
            low *= 0.97
            if low < 0.02 * top:
                raise ValueError("no cycle")
        start = float(brentq(gain, low, top, xtol=1e-14 * top, rtol=1e-14))
        _, solutions = self.once_round(start, loaded, dense=True)
        lowest, highest, square, time, lost, useful_work = math.inf, 0.0, 0.0, 0.0, 0.0, 0.0
        for a, b, useful, done in solutions:
            phi = np.linspace(a, b, 4001)
            e = done.sol(phi)[0]
            for sign in (-1.0, 1.0):
                top_at = int(np.argmax(sign * e))
                value = self._vertex(done, phi, top_at, sign)
                lowest, highest = min(lowest, value), max(highest, value)
            time, square = time + float(done.y[1, -1]), square + float(done.y[2, -1])
            lost += (self.friction + self.share * abs(useful)) * (b - a) + self.viscous * float(done.y[3, -1])
            useful_work += useful * (b - a)
        slow, fast = math.sqrt(2 * lowest), math.sqrt(2 * highest)
        mean, drive = (slow + fast) / 2, lost + useful_work
        return {
            "start": start,
            "speed_min": slow,
            "speed_max": fast,
            "speed_mean": mean,
            "irregularity": (fast - slow) / mean,
            "torque_motor_rms": math.sqrt(square / time),
            "work_loss": lost,
            "work_useful": useful_work,
            "work_drive": drive,
            "cycle_efficiency": useful_work / drive,
            "loss_factor": lost / drive,
        }

    @staticmethod
    def _vertex(done: Any, phi: Any, at: int, sign: float) -> float:
        """The extreme near a sample, by golden section on the dense solution."""
        low, high = phi[max(at - 1, 0)], phi[min(at + 1, len(phi) - 1)]
        share = (math.sqrt(5) - 1) / 2
        for _ in range(60):
            left, right = high - share * (high - low), low + share * (high - low)
            if sign * done.sol(left)[0] > sign * done.sol(right)[0]:
                high = right
            else:
                low = left
        return float(max((done.sol(x)[0] for x in (low, high, phi[at])), key=lambda v: sign * v))

    def speed_at(self, phi: float, start: float) -> float:
        """Speed at an angle of the cycle that begins with a speed."""
        _, solutions = self.once_round(start, dense=True)
        for low, high, _, done in solutions:
            if low <= phi % TURN <= high:
                return math.sqrt(2 * float(done.sol(phi % TURN)[0]))
        raise AssertionError(phi)

    # -- run-up and run-out

    def _edge(self, phi: float, breaks: list[float]) -> float:
        """The next break after an angle."""
        turn = math.floor(phi / TURN)
        later = [b + k * TURN for b in breaks for k in (turn - 1, turn, turn + 1, turn + 2)]
        return min((edge for edge in later if edge > phi + 1e-9), default=math.inf)

    def _moved(
        self, rates: Any, begin: tuple[float, list[float]], until: float, ends: Any, turns: Any, w: float
    ) -> Any:
        """(time, state, whether it ended) from one break, kink or end to the next."""
        time, state = begin
        edge = self._edge(state[0], self.breaks + self.knots)

        def at_edge(t: float, y: Any) -> float:
            return float(min(edge, 1e6) - y[0])

        for event in (ends, at_edge, turns):
            event.terminal = True
        if abs(turns(time, state)) < 1e-6 * abs(self.motor(0.0)):  # a step off the kink, or it is found again
            little = min(1e-6 / w, until - time)
            done = solve_ivp(rates, (time, time + little), state, method="DOP853", rtol=self.rtol, atol=1e-14 * w)
            time, state = float(done.t[-1]), done.y[:, -1].tolist()
            if time >= until:
                return time, state, False
        done = solve_ivp(
            rates, (time, until), state, method="DOP853", rtol=self.rtol, atol=self.rtol / 10 * w, max_step=0.2 / w,
            events=(ends, at_edge, turns),
        )  # fmt: skip
        return float(done.t[-1]), done.y[:, -1].tolist(), len(done.t_events[0]) > 0

    def run_up(self, phi: float, target: float, loaded: bool = False) -> tuple[float, float]:
        """Time and angle from rest to a speed."""
        time, state = 0.0, [phi, 0.0]
        while True:
            useful = self.useful(state[0] + 1e-9) if loaded else 0.0

            def rates(t: float, y: Any, useful: float = useful) -> list[float]:
                return [y[1], self.epsilon(y[0], y[1], useful, self.motor(self.ratio * y[1]), 0.0)]

            def turns(t: float, y: Any, useful: float = useful) -> float:
                return self.both_ways(y[0], y[1], useful, self.motor(self.ratio * y[1]), 0.0)[1] if self.rotor else 1.0

            def reached(t: float, y: Any) -> float:
                return float(y[1] - target)

            time, state, ended = self._moved(rates, (time, state), time + 1e4, reached, turns, target)
            if ended:
                return time, state[0] - phi

    def run_out(self, phi: float, w: float) -> tuple[float, float]:
        """Time and angle to rest with the drive off and the brake on, without the useful load."""
        delay, rise = number(self.brake["delay"]), number(self.brake.get("rise", 0))
        time, state = 0.0, [phi, w]
        for until in sorted({delay, delay + rise, 1e5}):
            middle = (time + min(until, time + 1)) / 2

            def brake(t: float, middle: float = middle) -> float:
                if middle < delay:
                    return 0.0
                return self.brake_torque * ((t - delay) / rise if middle < delay + rise else 1.0)

            def rates(t: float, y: Any, brake: Any = brake) -> list[float]:
                return [y[1], self.epsilon(y[0], y[1], 0.0, 0.0, brake(t))]

            def turns(t: float, y: Any, brake: Any = brake) -> float:
                return self.both_ways(y[0], y[1], 0.0, 0.0, brake(t))[1] if self.rotor else 1.0

            def rest(t: float, y: Any) -> float:
                return float(y[1])

            while time < until:
                time, state, ended = self._moved(rates, (time, state), until, rest, turns, w)
                if ended:
                    return time, state[0] - phi
        raise AssertionError("it does not come to rest")

    def flywheel(self, wanted: float) -> float:
        """Inertia to be added for an irregularity."""

        def over(added: float) -> float:
            other = Reference(self.data, added)
            return wanted / other.cycle()["irregularity"] - 1

        if over(0.0) >= 0:
            return 0.0
        high = self.inertia(0.0)[0]
        while over(high) < 0:
            high *= 2
        return float(brentq(over, 0.0, high, xtol=1e-10 * high))
