"""Random drive trains as design files, and the same trains for the independent integration of `hybrid`."""

import itertools
import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from support import hybrid

# -- random trains ----------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Units:
    """The units of a train that turns, or of one that travels; all of them SI."""

    inertia: str
    torque: str
    stiffness: str
    damping: str
    travel: str
    speed: str


TURNING = Units("kg*m^2", "N*m", "N*m/rad", "N*m*s/rad", "rad", "rad/s")
TRAVELLING = Units("kg", "N", "N/m", "N*s/m", "m", "m/s")


def text(value: float, unit: str) -> str:
    return f"{float(value)!r} {unit}"


def number(written: str) -> float:
    """The value of a text in SI units."""
    return float(written.split()[0])


def linear_train(rng: np.random.Generator) -> dict[str, Any]:
    """A chain of inertias, springs and ideal gears under torques over time."""
    units = TURNING if rng.random() < 0.7 else TRAVELLING
    names = [f"b{k}" for k in range(int(rng.integers(2, 6)))]
    sizes = 10 ** rng.uniform(-0.5, 1.2, len(names))
    key = "inertia" if units is TURNING else "mass"
    data: dict[str, Any] = {
        "kind": "drivetrain",
        "inertias": {name: {key: text(size, units.inertia)} for name, size in zip(names, sizes, strict=True)},
        "links": {},
        "gears": {},
        "torques": {},
    }
    sprung = int(rng.integers(1, len(names)))
    for k in range(1, len(names)):
        if k != sprung and rng.random() < 0.25:
            ratio = float(rng.choice([-1, 1]) * 10 ** rng.uniform(-0.5, 0.8))
            data["gears"][f"g{k}"] = {"from": names[k - 1], "to": names[k], "ratio": ratio}
            continue
        stiffness = min(sizes[k - 1], sizes[k]) * 10 ** rng.uniform(1.5, 5.0)
        damping = 2 * rng.choice([0.0, 0.0, 0.005, 0.05, 1.0]) * math.sqrt(stiffness * min(sizes[k - 1], sizes[k]))
        data["links"][f"l{k}"] = {
            "between": [names[k - 1], names[k]],
            "stiffness": text(stiffness, units.stiffness),
            "damping": text(damping, units.damping),
        }
    fastest = math.sqrt(max(number(link["stiffness"]) for link in data["links"].values()) / min(sizes))
    end = float(rng.uniform(0.5, 60) / fastest * 10 ** rng.uniform(0, 0.8))
    gentle = rng.random() < 0.2
    for k in range(1 if gentle else int(rng.integers(1, 4))):
        torque = _gentle(rng, units, end) if gentle else _over_time(rng, units, end, fastest)
        data["torques"][f"t{k}"] = {"at": str(rng.choice(names)), **torque}
    scene = {"type": "run", "duration": text(end, "s"), "links": str(rng.choice(["relaxed", "relaxed", "loaded"]))}
    if rng.random() < 0.3:
        scene["speed"] = text(rng.normal(), units.speed)
    if rng.random() < 0.3:
        scene["of"] = str(rng.choice(names))
    if gentle:
        scene |= {"links": "relaxed", "duration": text(12 * end, "s")}
        data["torques"]["t0"]["time"] = text(12 * end, "s")
    return data | {"scenes": [scene]}


def _gentle(rng: np.random.Generator, units: Units, end: float) -> dict[str, Any]:
    """A torque that rises so slowly that hardly a link swings."""
    size = 10 ** rng.uniform(0.5, 2)
    return {"type": "ramp", "torque": text(size, units.torque), "first": f"0 {units.torque}", "time": text(end, "s")}


def _over_time(rng: np.random.Generator, units: Units, end: float, fastest: float) -> dict[str, Any]:
    """A torque that depends on time alone."""
    size = float(rng.choice([-1, 1]) * 10 ** rng.uniform(0.5, 2))
    kind = str(rng.choice(["constant", "delayed", "ramp", "sine", "table"]))
    if kind == "constant":
        return {"type": "constant", "torque": text(size, units.torque)}
    if kind == "delayed":
        return {"type": "constant", "torque": text(size, units.torque), "delay": text(rng.uniform(0, end), "s")}
    if kind == "ramp":
        first = text(rng.choice([0.0, 0.5 * size, -size]), units.torque)
        time = text(end * 10 ** rng.uniform(-2, 0.3), "s")
        return {"type": "ramp", "torque": text(size, units.torque), "first": first, "time": time}
    if kind == "sine":
        frequency = text(fastest * 10 ** rng.uniform(-2.5, 0.3), "rad/s")
        mean = text(rng.choice([0.0, size]), units.torque)
        phase = text(rng.uniform(0, 6), "rad")
        return {"type": "sine", "amplitude": text(size, units.torque), "angular_frequency": frequency,
                "mean": mean, "phase": phase}  # fmt: skip
    times = np.sort(rng.uniform(0, end, int(rng.integers(2, 7))))
    values = size * rng.normal(size=len(times))
    points = [
        {"time": text(time, "s"), "torque": text(value, units.torque)}
        for time, value in zip(times, values, strict=True)
    ]
    return {"type": "over_time", "points": points}


def train_with_play(rng: np.random.Generator) -> dict[str, Any]:
    """Two inertias with play between them, most of them under torques that do not change."""
    first, second = 10 ** rng.uniform(-0.5, 1.2, 2)
    torque = float(rng.choice([-1, 1]) * 10 ** rng.uniform(0.5, 2))
    stiffness = min(first, second) * 10 ** rng.uniform(2.0, 4.0)
    number_of_play = 10 ** rng.uniform(-2.5, 1.0)
    gap = number_of_play * abs(torque) * second / (first + second) / stiffness
    period = 2 * math.pi * math.sqrt(first * second / (first + second) / stiffness)
    closing = math.sqrt(2 * first * gap / abs(torque))
    damping = 2 * float(rng.choice([0.0, 0.0, 0.0, 0.01, 0.1])) * math.sqrt(stiffness * min(first, second))
    end = float(closing + period * rng.uniform(0.3, 8))
    steady = rng.random() < 0.75
    torques = {"t0": {"at": "b0", "type": "constant", "torque": text(torque, "N*m")}}
    if rng.random() < 0.4:
        torques["t1"] = {"at": "b1", "type": "constant", "torque": text(torque * rng.uniform(-0.8, 0.8), "N*m")}
    if not steady:
        torques["t2"] = {"at": "b0", **_over_time(rng, TURNING, end, 2 * math.pi / period)}
    link = {
        "between": ["b0", "b1"],
        "stiffness": text(stiffness, "N*m/rad"),
        "damping": text(damping, "N*m*s/rad"),
        "gap": text(gap if rng.random() < 0.95 else 0.0, "rad"),
        "law": str(rng.choice(["clamped", "clamped", "no_pull", "kelvin"])),
        "start": str(rng.choice(["centred", "centred", "driving", "braking"])),
    }
    return {
        "kind": "drivetrain",
        "inertias": {"b0": {"inertia": text(first, "kg*m^2")}, "b1": {"inertia": text(second, "kg*m^2")}},
        "links": {"l1": link},
        "gears": {},
        "torques": torques,
        "scenes": [{"type": "run", "duration": text(end, "s")}],
    }


def motor_train(rng: np.random.Generator) -> dict[str, Any]:
    """A motor over its curve, elastic links, a gear with losses, friction and a brake: nothing linear is left."""
    names = ["motor", "hub", "drum"][: int(rng.integers(2, 4))]
    sizes = 10 ** rng.uniform(-0.3, 0.8, len(names))
    speed = float(rng.uniform(0.93, 0.985))
    power, synchronous = float(10 ** rng.uniform(3.5, 4.3)), float(rng.choice([78.5, 104.7, 157.1]))
    motor = {
        "type": "induction",
        "power": text(power, "W"),
        "speed": text(speed * synchronous, "rad/s"),
        "synchronous_speed": text(synchronous, "rad/s"),
        "overload": float(rng.uniform(1.8, 3.0)),
    }
    rated = power / (speed * synchronous)
    stiffness = float(sizes[:2].min() * 10 ** rng.uniform(2.0, 4.0))
    data: dict[str, Any] = {
        "kind": "drivetrain",
        "inertias": {name: {"inertia": text(size, "kg*m^2")} for name, size in zip(names, sizes, strict=True)},
        "links": {
            "l1": {
                "between": ["motor", "hub"],
                "stiffness": text(stiffness, "N*m/rad"),
                "damping": text(0.04 * math.sqrt(stiffness * sizes[:2].min()), "N*m*s/rad"),
            }
        },
        "gears": {},
        "motors": {"main": {"at": "motor", "motor": motor}},
        "torques": {},
        "brakes": {},
        "resistances": {},
    }
    if len(names) == 3:
        ratio, forward = float(rng.uniform(1.5, 6)), float(rng.uniform(0.7, 0.98))
        data["gears"]["g1"] = {"from": "hub", "to": "drum", "ratio": ratio, "efficiency": forward}
    last = names[-1]
    turned = data["gears"]["g1"]["ratio"] if data["gears"] else 1.0
    if rng.random() < 0.6:
        weight = rated * rng.uniform(-0.9, 0.6) * turned
        data["torques"]["weight"] = {"at": last, "type": "constant", "torque": text(weight, "N*m")}
    if rng.random() < 0.5:
        friction = {"coulomb": text(rated * turned * rng.uniform(0.05, 0.3), "N*m"), "static_ratio": 1.2}
        if rng.random() < 0.5:
            friction["viscous"] = text(0.002 * rated * turned, "N*m*s/rad")
        data["resistances"]["bearing"] = {"at": last, **friction}
    if rng.random() < 0.4:
        delay, rise = text(rng.uniform(0.05, 0.2), "s"), text(rng.uniform(0.02, 0.1), "s")
        data["brakes"]["brake"] = {"at": "motor", "torque": text(2.5 * rated, "N*m"), "delay": delay,
                                   "rise_time": rise, "applied": "always"}  # fmt: skip
    kind = str(rng.choice(["run", "run", "start", "stop"]))
    scene: dict[str, Any] = {"type": kind, "duration": text(rng.uniform(0.2, 0.6), "s"), "links": "relaxed"}
    if kind == "start":
        scene["until"] = text(rng.uniform(1, 20), "rad/s")
    elif kind == "stop" or rng.random() < 0.5:
        scene["speed"] = text(synchronous * rng.uniform(0.2, 1.0), "rad/s")
    return data | {"scenes": [scene]}


# -- the same trains for the independent integration ------------------------------------------------------------------


def machine_of(data: dict[str, Any], play: bool = True) -> hybrid.Machine:
    """What a train of `linear_train` or its kin is to the integration of `hybrid`: nothing of ptmcalc is asked."""
    names = list(data["inertias"])
    sizes = [number(body.get("inertia", body.get("mass"))) for body in data["inertias"].values()]
    gears = [
        hybrid.Gear(
            names.index(gear["from"]), names.index(gear["to"]), gear["ratio"], gear.get("efficiency", 1.0),
            gear.get("reverse_efficiency", 2 - 1 / gear.get("efficiency", 1.0)),
        )
        for gear in data["gears"].values()
    ]  # fmt: skip
    torques = [hybrid.Torque(names.index(one["at"]), course_of(one)) for one in data["torques"].values()]
    motors = data.get("motors", {}).values() if data["scenes"][0]["type"] != "stop" else ()
    torques += [_kloss(names.index(one["at"]), one["motor"]) for one in motors]
    frictions = data.get("resistances", {}).values()
    torques += [_viscous(names.index(one["at"]), number(one["viscous"])) for one in frictions if "viscous" in one]
    brakes = [_brake(names.index(one["at"]), one) for one in data.get("brakes", {}).values()]
    brakes += [
        hybrid.Brake(names.index(one["at"]), None, hybrid.Course.constant(number(one["coulomb"])), one["static_ratio"])
        for one in frictions
    ]
    scene = data["scenes"][0]
    main = names.index(scene.get("of", names[0]))
    speeds = _speeds(data, names, gears, main)
    links = [_link(link, names, play) for link in data["links"].values()]
    if scene.get("links") == "loaded":
        links = _loaded(sizes, links, gears, torques, main)
    place = (0.0,) * len(names)
    return hybrid.Machine(tuple(sizes), place, speeds, tuple(links), tuple(gears), tuple(brakes), tuple(torques))


def loads_of(data: dict[str, Any], play: bool = True) -> dict[str, float]:
    """The loads of a train by the independent integration."""
    machine, end = machine_of(data, play), number(data["scenes"][0]["duration"])
    history = _smooth_history(machine, end) if _is_smooth(machine) else hybrid.simulate(machine, end)
    found = {}
    for k, name in enumerate(data["links"]):
        found[f"torque_peak[{name}]"] = max(history.highest["link", k], -history.lowest["link", k])
    for k, name in enumerate(data["inertias"]):
        found[f"speed_max[{name}]"], found[f"speed_min[{name}]"] = (
            history.highest["speed", k],
            history.lowest["speed", k],
        )
        found[f"speed_end[{name}]"], found[f"angle_end[{name}]"] = history.speeds[k], history.positions[k]
    return {name: float(value) for name, value in found.items()}


def _is_smooth(machine: hybrid.Machine) -> bool:
    """Whether torques depend on time alone and every link is a spring: nothing happens but breaks of torques."""
    springs = all(link.law == "linear" and link.second is not None for link in machine.links)
    lossless = all(gear.forward == gear.reverse == 1 for gear in machine.gears)
    return springs and lossless and not machine.brakes and all(torque.over is None for torque in machine.torques)


def _smooth_history(machine: hybrid.Machine, end: float) -> hybrid.History:
    """The motion of a linear train, many times as fast as with events: matrices, DOP853 from break to break."""
    groups = hybrid.Groups(machine)
    count, of, ratio = groups.count, groups.of, groups.ratio
    inertia = np.zeros(count)
    for body, size in enumerate(machine.inertias):
        inertia[of[body]] += size * ratio[body] ** 2
    rows = np.array([groups.row(link.first, link.second) for link in machine.links])
    stiffness, damping = (np.array([getattr(link, key) for link in machine.links]) for key in ("stiffness", "damping"))
    rest = np.array([link.rest for link in machine.links])
    start = np.zeros(2 * count)
    for body, speed in enumerate(machine.speeds):
        start[count + of[body]] = speed / ratio[body]
    watched = np.zeros((len(rows) + len(of), 2 * count))
    watched[: len(rows), :count], watched[: len(rows), count:] = stiffness[:, None] * rows, damping[:, None] * rows
    watched[len(rows) :, count:] = ratio[:, None] * np.eye(count)[of]
    offset = np.concatenate([-stiffness * rest, np.zeros(len(of))])
    light = rows / np.sqrt(inertia)
    fastest = math.sqrt(float(np.linalg.eigvalsh(light.T @ (stiffness[:, None] * light)).max()))
    quickest = max([fastest, *(frequency for torque in machine.torques for _, frequency, _ in torque.course.sines)])
    breaks = sorted({time for torque in machine.torques for time in torque.course.breaks if time < end} | {0.0, end})
    high, low = np.full(len(watched), -math.inf), np.full(len(watched), math.inf)
    for begin, stop in itertools.pairwise(breaks):
        inside = (begin + stop) / 2

        def rates(t: float, y: np.ndarray, inside: float = inside) -> np.ndarray:
            pushed = np.zeros(count)
            for torque in machine.torques:
                pushed[of[torque.body]] += ratio[torque.body] * torque.course.at(t, inside)
            pull = rows.T @ (stiffness * (rows @ y[:count] - rest) + damping * (rows @ y[count:]))
            return np.concatenate([y[count:], (pushed - pull) / inertia])

        step = 0.5 / fastest  # the dense output between long steps is worth less than the steps
        run = solve_ivp(
            rates, (begin, stop), start, method="DOP853", rtol=1e-12, atol=1e-14, dense_output=True, max_step=step
        )
        times = np.linspace(begin, stop, int(40 * quickest * (stop - begin)) + 20)
        seen = watched @ run.sol(times) + offset[:, None]
        for sign, best in ((1, high), (-1, low)):
            for k, value in enumerate(_summits(sign * seen)):
                best[k] = sign * max(sign * best[k], value)
        start = run.y[:, -1]
    names = [("link", k) for k in range(len(rows))] + [("speed", k) for k in range(len(of))]
    return hybrid.History(
        end,
        np.array(machine.positions) + ratio * start[:count][of],
        ratio * start[count:][of],
        highest=dict(zip(names, high.tolist(), strict=True)),
        lowest=dict(zip(names, low.tolist(), strict=True)),
    )


def _summits(seen: np.ndarray) -> np.ndarray:
    """Largest value of each signal on a dense grid: the summit of the polynomial through five points at the highest."""
    best = seen.max(axis=1)
    for k, place in enumerate(seen.argmax(axis=1)):
        first = min(max(place - 2, 0), seen.shape[1] - 5)
        curve = np.polynomial.Polynomial.fit(
            np.arange(-2, 3), seen[k, first : first + 5], 4, domain=[-2, 2], window=[-2, 2]
        )
        roots = curve.deriv().roots()
        inside = roots[np.isreal(roots)].real
        inside = inside[np.abs(inside) <= 2]
        best[k] = max([best[k], *curve(inside).tolist()])
    return best


def _kloss(body: int, motor: dict[str, Any]) -> hybrid.Torque:
    """The simplified curve of Kloss of a motor's rating plate."""
    synchronous, speed = number(motor["synchronous_speed"]), number(motor["speed"])
    rated, most = number(motor["power"]) / speed, motor["overload"]
    slip = 1 - speed / synchronous
    steepest = slip * (most + math.sqrt(most**2 - 1))

    def torque(position: float, now: float) -> float:
        s = 1 - now / synchronous
        return 2 * most * rated * s * steepest / (s**2 + steepest**2)

    return hybrid.Torque(body, over=torque)


def _viscous(body: int, damping: float) -> hybrid.Torque:
    return hybrid.Torque(body, over=lambda position, speed: -damping * speed)


def _brake(body: int, brake: dict[str, Any]) -> hybrid.Brake:
    delay, rise, full = (number(brake[key]) for key in ("delay", "rise_time", "torque"))
    course = hybrid.Course(((0.0, 0.0, 0.0), (delay, 0.0, full / rise), (delay + rise, full, 0.0)))
    return hybrid.Brake(body, None, course)


def course_of(torque: dict[str, Any]) -> hybrid.Course:
    """A torque over time."""
    kind = torque["type"]
    if kind == "constant":
        delay, value = number(torque.get("delay", "0 s")), number(torque["torque"])
        return hybrid.Course(((0.0, 0.0, 0.0), (delay, value, 0.0))) if delay else hybrid.Course.constant(value)
    if kind == "sine":
        sine = (number(torque["amplitude"]), number(torque["angular_frequency"]), number(torque["phase"]))
        return hybrid.Course(((0.0, number(torque["mean"]), 0.0),), (sine,))
    if kind == "ramp":
        points = [(0.0, number(torque["first"])), (number(torque["time"]), number(torque["torque"]))]
    else:
        points = [(number(point["time"]), number(point["torque"])) for point in torque["points"]]
    pieces = [] if points[0][0] == 0 else [(0.0, points[0][1], 0.0)]
    for (time, value), (later, other) in itertools.pairwise(points):
        pieces.append((time, value, (other - value) / (later - time)))
    return hybrid.Course((*pieces, (*points[-1], 0.0)))


def _link(link: dict[str, Any], names: list[str], play: bool) -> hybrid.Link:
    first, second = link["between"]
    gap = number(link["gap"]) if "gap" in link and play else 0.0
    law = link.get("law", "clamped") if "gap" in link and play else "linear"
    side = {"centred": 0, "driving": 1, "braking": -1}[link.get("start", "centred")]
    return hybrid.Link(
        names.index(first),
        None if second == "ground" else names.index(second),
        number(link["stiffness"]),
        number(link.get("damping", "0 N")),
        gap,
        law,
        rest=-side * gap / 2,
    )


def _speeds(data: dict[str, Any], names: list[str], gears: list[hybrid.Gear], main: int) -> tuple[float, ...]:
    """Speeds at the start: the scene's, handed on by gears and links."""
    speeds: dict[int, float] = {}
    if "speed" in data["scenes"][0]:
        speeds[main] = number(data["scenes"][0]["speed"])
    ties = [(gear.inner, gear.outer, gear.ratio) for gear in gears]
    pairs = [link["between"] for link in data["links"].values()]
    ties += [(names.index(one), names.index(two), 1.0) for one, two in pairs]
    for _ in names:
        for inner, outer, ratio in ties:
            if inner in speeds and outer not in speeds:
                speeds[outer] = speeds[inner] / ratio
            elif outer in speeds and inner not in speeds:
                speeds[inner] = speeds[outer] * ratio
    return tuple(speeds.get(k, 0.0) for k in range(len(names)))


def _loaded(
    sizes: list[float],
    links: list[hybrid.Link],
    gears: list[hybrid.Gear],
    torques: list[hybrid.Torque],
    main: int,
) -> list[hybrid.Link]:
    """Links with the forces that hold every torque of the start while the main inertia is held."""
    machine = hybrid.Machine(tuple(sizes), (0.0,) * len(sizes), (0.0,) * len(sizes), tuple(links), tuple(gears))
    groups = hybrid.Groups(machine)
    stiff, pushed = np.zeros((groups.count, groups.count)), np.zeros(groups.count)
    rows = [groups.row(link.first, link.second) for link in links]
    for row, link in zip(rows, links, strict=True):
        stiff += link.stiffness * np.outer(row, row)
    for torque in torques:
        pushed[groups.of[torque.body]] += groups.ratio[torque.body] * torque.course.at(0.0, 0.0)
    free = [group for group in range(groups.count) if group != groups.of[main]]
    turned = np.zeros(groups.count)
    turned[free] = np.linalg.solve(stiff[np.ix_(free, free)], pushed[free])
    return [replace(link, rest=-float(row @ turned)) for row, link in zip(rows, links, strict=True)]
