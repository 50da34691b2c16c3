"""Emergency stops of hoists by integration in time: torques of both shafts solved at every moment, with events.

Nothing of `ptmcalc` is used.
"""

import math
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from support.hoist_statics import Statics, random_hoist
from support.travelling_statics import G, number, text

TIGHT = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-14}


def random_stop(rng: np.random.Generator) -> dict[str, Any]:
    """A hoist with an emergency stop, and all data of its brake."""
    data = random_hoist(rng)
    speed = number(data["motor"]["no_load_speed"]) / 1.02
    inertia = number(data["motor"]["inertia"]) + number(data["motor"]["coupling_inertia"])
    heat = data["motor"]["count"] * inertia * speed**2
    data["brake"] |= {
        "delay": text(rng.choice([0.0, 1.0, 3.0]) * rng.uniform(0.02, 0.5), "s"),
        "rise_time": text(rng.choice([0.0, 1.0]) * rng.uniform(0.02, 0.4), "s"),
        "rise": str(rng.choice(["linear", "linear", "exponential"])),
        "disc_mass": text(rng.uniform(5, 60), "kg"),
        "specific_heat": text(rng.uniform(460, 540), "J/kg*K"),
        "cooling_time": text(rng.uniform(600, 4000), "s"),
        "stops_per_hour": float(rng.uniform(2, 120)),
        "temperature_rise": text(rng.uniform(20, 400), "K"),
        "stop_heat": text(heat * rng.uniform(0.5, 3), "J"),
        "friction_work": text(heat * rng.uniform(1e3, 1e5), "J"),
        "stops_per_service": float(rng.uniform(1e3, 1e5)),
    }
    scene: dict[str, Any] = {"type": "emergency_stop", "direction": str(rng.choice(["down", "down", "up"]))}
    if rng.random() < 0.5:
        scene["motor_speed"] = text(speed * rng.uniform(0.5, 1.4), "rad/s")
    if rng.random() < 0.5:
        scene["hook_height"] = text(number(data["height"]) * rng.uniform(0.1, 1.0), "m")
    data["scenes"] = [scene]
    return data


class Stops(Statics):
    """Emergency stops of a hoist of such a file."""

    def __init__(self, data: dict[str, Any]) -> None:
        super().__init__(data)
        brake = data["brake"]
        self.brake, self.braked_drum = number(brake["torque"]), brake["shaft"] == "drum"
        self.delay, self.rise = number(brake["delay"]), number(brake["rise_time"])
        self.shape = brake.get("rise", "linear")

    def closing(self, time: float) -> float:
        """Torque of the brake [N*m]."""
        since = time - self.delay
        if since < 0:
            return 0.0
        if self.rise == 0:
            return self.brake
        return self.brake * (
            -math.expm1(-since / self.rise) if self.shape == "exponential" else min(since / self.rise, 1)
        )

    def rate(self, torque: float, way: int, loads: tuple[float, float], behind: float) -> float:
        """Acceleration of the motor shaft in the direction of the motion, both shafts solved with the torque between
        them [rad/s^2]."""
        on_motor, on_drum = (0.0, torque) if self.braked_drum else (torque, 0.0)
        for passed in (1 / self.eta, self.back):
            if way > 0:  # rotor: J1 a = -M - T f/u, drum: J2 a/u = T - M_L - M'
                sides, right = (
                    [[self.rotors, passed / self.ratio], [behind / self.ratio, -1.0]],
                    (-on_motor, -loads[0] - on_drum),
                )
                drives = passed != self.back
            else:  # rotor: J1 a = T f/u - M, drum: J2 a/u = M_L - T - M'
                sides, right = (
                    [[self.rotors, -passed / self.ratio], [behind / self.ratio, 1.0]],
                    (-on_motor, loads[1] - on_drum),
                )
                drives = passed == self.back
            a, through = np.linalg.solve(sides, right)
            if (through >= 0) == drives:
                break
        return float(a)

    def at(self, scene: dict[str, Any], height: float) -> dict[str, float]:
        """Loads of the stop at a height of the hook."""
        mass, layer = self.mass(scene), self.wound(height)[1]
        arm = self.radius(layer) / self.of_each
        loads = tuple(self.ropes * self.pull(mass, height, up) * self.radius(layer) for up in (True, False))
        drum = number(self.data["drum"]["inertia"])
        inertias = {way: drum + load * arm / G for way, load in zip((1, -1), loads, strict=True)}
        speed = number(scene["motor_speed"]) if "motor_speed" in scene else self.drum_speed * self.ratio
        time, fastest, angles, heat = 0.0, speed, {1: 0.0, -1: 0.0}, 0.0
        ways = [1, -1] if scene["direction"] == "up" else [-1]
        for way in ways:
            behind = inertias[way]
            if way == -1 and len(ways) == 2:
                speed = 0.0
                if self.rate(self.closing(time), -1, loads, behind) <= 0:
                    break
            if self.rate(self.brake, way, loads, behind) >= 0:
                time, fastest, angles[-1], heat = math.inf, math.inf, math.inf, math.inf
                break
            time, most, angles[way], work = self.part(time, speed, way, loads, behind)
            fastest, heat = max(fastest, most), heat + work
        found = {
            "emergency_speed_max": fastest,
            "emergency_stop_time": time,
            "emergency_travel": angles[1] + angles[-1],
            "emergency_descent": angles[-1] * arm / self.ratio,
            "brake_heat": heat,
        }
        return found | ({"emergency_rise": angles[1] * arm / self.ratio} if len(ways) == 2 else {})

    def part(
        self, begin: float, speed: float, way: int, loads: tuple[float, float], behind: float
    ) -> tuple[float, float, float, float]:
        """Time of rest, largest speed, angle and work of the brake of a motion in one direction."""
        share = 1 / self.ratio if self.braked_drum else 1.0
        marks = [self.delay, self.delay + self.rise, self.delay + 40 * self.rise, 1e7]
        state, now, fastest = [speed, 0.0, 0.0], begin, speed

        def motion(time: float, y: np.ndarray) -> list[float]:
            torque = self.closing(time)
            return [self.rate(torque, way, loads, behind), y[0], torque * share * max(y[0], 0.0)]

        def rest(time: float, y: np.ndarray) -> float:
            return float(y[0])

        rest.terminal, rest.direction = True, -1  # type: ignore[attr-defined]

        def turn(time: float, y: np.ndarray) -> float:
            return self.rate(self.closing(time), way, loads, behind)

        for mark in marks:
            if mark <= now:
                continue
            before = np.nextafter(mark, 0.0)

            def inner(time: float, y: np.ndarray, last: float = before) -> list[float]:
                return motion(min(time, last), y)

            run = solve_ivp(inner, (now, mark), state, events=[rest, turn], **TIGHT)
            fastest = max(fastest, float(run.y[0].max()), *(float(y[0]) for y in run.y_events[1]))
            if len(run.t_events[0]):
                last = run.y_events[0][0]
                return float(run.t_events[0][0]), fastest, float(last[1]), float(last[2])
            state, now = list(run.y[:, -1]), mark
        raise AssertionError("the drive does not come to rest")

    def elastic(self, scene: dict[str, Any], height: float) -> dict[str, float]:
        """Loads of the stop with the load on its elastic rope, until the drive is at rest for good."""
        mass, layer = self.mass(scene), self.wound(height)[1]
        arm = self.radius(layer) / self.of_each
        loads = {way: self.ropes * self.pull(mass, height, way > 0) * self.radius(layer) for way in (1, -1)}
        length = (self.least + self.height - height) * self.of_each + number(self.data["reeving"]["lead_length"])
        spring = self.ropes * self.of_each**2 * number(self.data["rope"]["modulus"])
        spring *= number(self.data["rope"]["area"]) / length * arm / (mass * G)  # force over weight, per drum angle
        drum = number(self.data["drum"]["inertia"])
        speed = number(scene["motor_speed"]) if "motor_speed" in scene else self.drum_speed * self.ratio
        work = 1 / self.ratio if self.braked_drum else 1.0
        way = 1 if scene["direction"] == "up" else -1
        # motor angle and speed, load angle and speed on the drum, heat; both in the direction of the motion
        state, now, angles, fastest = [0.0, speed, 0.0, speed / self.ratio, 0.0], 0.0, {1: 0.0, -1: 0.0}, speed

        def force(y: np.ndarray) -> float:
            """Of the rope over the weight."""
            return max(1 + way * spring * (y[0] / self.ratio - y[2]), 0.0)

        def motion(time: float, y: np.ndarray) -> list[float]:
            pull = force(y) * loads[way]
            torque = self.closing(time)
            a = self.rate(torque, way, (pull, pull), drum)
            return [
                y[1],
                a,
                y[3],
                way * (force(y) - 1) * loads[way] / (loads[way] * arm / G),
                torque * work * max(y[1], 0.0),
            ]

        def rest(time: float, y: np.ndarray) -> float:
            return float(y[1])

        rest.terminal, rest.direction = True, -1  # type: ignore[attr-defined]
        for _ in range(2):
            for mark in (self.delay, self.delay + self.rise, 1e6):
                if mark <= now:
                    continue

                def inner(time: float, y: np.ndarray, last: float = float(np.nextafter(mark, 0.0))) -> list[float]:
                    return motion(min(time, last), y)

                step = min(0.02, mark - now) if mark < 1e6 else 0.02
                run = solve_ivp(
                    inner, (now, mark), state, events=rest, method="DOP853", rtol=1e-9, atol=1e-10, max_step=step
                )
                fastest = max(fastest, float(run.y[1].max()))
                now, state = float(run.t[-1]), list(run.y[:, -1])
                if len(run.t_events[0]):
                    break
            angles[way] += state[0]
            if way == 1 and self.rate(self.closing(now), -1, (force(state) * loads[-1],) * 2, drum) > 0:
                way, state = -1, [0.0, 0.0, state[0] / self.ratio - state[2], -state[3], state[4]]
                continue
            break
        return {
            "emergency_speed_max": fastest,
            "emergency_stop_time": now,
            "emergency_travel": angles[1] + angles[-1],
            "emergency_descent": angles[-1] * arm / self.ratio,
            "brake_heat": state[4],
        } | ({"emergency_rise": angles[1] * arm / self.ratio} if scene["direction"] == "up" else {})

    def emergency_stop(self, scene: dict[str, Any]) -> dict[str, float]:
        """The worst of the heights."""
        given = scene.get("hook_height")
        places = [number(given)] if given else [0.0, *(min(h * (1 + 1e-9), self.height) for h in self.begins())]
        stops = [self.at(scene, height) for height in dict.fromkeys(places)]
        found = {name: max(stop[name] for stop in stops) for name in stops[0]}
        return self.of_the_disc(found)

    def of_the_disc(self, found: dict[str, float]) -> dict[str, float]:
        """The loads of a stop with those that the brake has of its heat."""
        brake = self.data["brake"]
        one = found["brake_heat"] / number(brake["disc_mass"]) / number(brake["specific_heat"])
        kept = math.exp(-3600 / brake["stops_per_hour"] / number(brake["cooling_time"]))
        return found | {
            "emergency_speed_ratio": found["emergency_speed_max"] / number(self.data["motor"]["no_load_speed"]),
            "brake_temperature_one": one,
            "brake_temperature_max": one / (1 - kept),
            "brake_stops": number(brake["friction_work"]) / found["brake_heat"],
        }
