"""Travelling cranes drawn by a number, and what balances of forces, levers and energy say of them.

`Statics` reads the data of a design file whose values are in SI units, and works everything out again: nothing of
`ptmcalc` is used.
"""

import math
from typing import Any

import numpy as np
from scipy.optimize import brentq, fsolve, minimize_scalar

from support.buffer_ode import Cushion, Hit, hit, meeting
from support.yaw_ode import turned

G = 9.81
CORNERS = ("A1", "A2", "B1", "B2")
USE = (16e3, 32e3, 63e3, 125e3, 250e3, 500e3, 1e6, 2e6, 4e6)
"""Cycles up to which a crane is of class U0, U1 ... (ISO 4301-1)."""
HOURS = (200, 400, 800, 1600, 3200, 6300, 12500, 25e3, 50e3)
SPECTRA = (0.125, 0.25, 0.5, 1.0)
STIFFNESS = {"HC1": (1.05, 0.17), "HC2": (1.10, 0.34), "HC3": (1.15, 0.51), "HC4": (1.20, 0.68)}
"""Smallest phi2 and what a speed of 1 m/s adds (EN 13001-2)."""
COOLING = {"self_ventilated": 0.33, "self_ventilated_closed": 0.5, "unventilated": 0.95, "separately_ventilated": 1.0}
"""At rest over that at speed (Chilikin and Sandler)."""


def text(value: float, unit: str) -> str:
    return f"{float(value)!r} {unit}"


def number(given: Any) -> float:
    """The number of a value with an SI unit, or of a bare one."""
    return float(str(given).split()[0])


def random_crane(rng: np.random.Generator) -> dict[str, Any]:
    """A bridge crane with all that its scenes ask for."""

    def even(low: float, high: float) -> float:
        return float(rng.uniform(low, high))

    def spread(low: float, high: float) -> float:
        return float(np.exp(rng.uniform(math.log(low), math.log(high))))

    span, base, load = even(8, 32), even(2.5, 6), spread(2e3, 4e4)
    corners = [list(CORNERS), ["A1", "B1"], ["A1", "A2"], ["A2", "B2"], ["A1", "B1", "B2"]][int(rng.integers(5))]
    many = int(rng.integers(1, 4))
    wheels: dict[str, Any] = {
        "diameter": text(even(0.2, 0.8), "m"),
        "base": text(base, "m"),
        "per_corner": many,
        "driven": corners,
        "driven_per_corner": int(rng.integers(1, many + 1)),
        "frame": str(rng.choice(["hinged", "rigid"])),
        "inertia": text(even(0, 3), "kg*m^2"),
        "rating": "1e9 N",
    }
    rolling: dict[str, Any] = {"coefficient": even(0.004, 0.02)}
    if rng.random() < 0.5:
        rolling = {
            "lever_arm": text(even(3e-4, 1e-3), "m"),
            "bearing_friction": even(0.01, 0.1),
            "axle_diameter": text(even(0.05, 0.15), "m"),
            "flange_factor": even(1, 2.5),
        }
    efficiency = even(0.75, 0.98)
    gear: dict[str, Any] = {"ratio": even(10, 60), "efficiency": efficiency}
    if rng.random() < 0.5:
        gear["reverse_efficiency"] = even(0.5, efficiency)
    drive: dict[str, Any] = {
        "motor": {
            "count": int(rng.integers(1, 5)),
            "inertia": text(spread(0.003, 0.3), "kg*m^2"),
            "coupling_inertia": text(spread(0.001, 0.1), "kg*m^2"),
            "mean_starting_torque": text(spread(8, 300), "N*m"),
            "rated_torque": text(spread(8, 200), "N*m"),
            "rated_duty": even(0.25, 1.0),
            "starts_per_hour": int(rng.integers(60, 400)),
            "cooling": str(rng.choice(list(COOLING))),
        },
        "gear": gear,
        "brake": {"torque": text(spread(20, 400), "N*m")},
        "wheels": str(rng.choice(["separate", "coupled"])),
    }
    if rng.random() < 0.5:
        drive["acceleration"] = text(even(0.05, 0.4), "m/s^2")
    pressure = even(80, 250)
    loads = [1.0, even(0.4, 0.9), even(0.05, 0.4)]
    shares = rng.dirichlet([1, 1, 1])
    duty = {
        "type": (sort := str(rng.choice(["S1", "S3", "S4", "S5"]))),
        **({} if sort == "S1" else {"factor": even(0.2, 0.7)}),
        **({"starts_per_hour": int(rng.integers(60, 300))} if sort in ("S4", "S5") else {}),
        "load_spectrum": [{"share": float(s), "load": q} for s, q in zip(shares, loads, strict=True)],
        "cycles": spread(1e4, 8e6),
        "hours": f"{spread(100, 1e5)!r} h",
    }
    near = even(0.5, 0.3 * span)
    return {
        "kind": "crane",
        "type": "travelling",
        "travels": "bridge",
        "load": text(load, "kg"),
        "hook_block": text(even(0, 0.1) * load, "kg"),
        "bridge": {
            "mass": text(even(0.4, 2.5) * load, "kg"),
            "span": text(span, "m"),
            "centre": text(even(0.45, 0.55) * span, "m"),
            "height": text(even(0, 3), "m"),
        },
        "trolley": {
            "mass": text(even(0.1, 0.4) * load, "kg"),
            "nearest": text(near, "m"),
            "farthest": text(even(0.7 * span, span - 0.5), "m"),
            "height": text(even(0, 3), "m"),
        },
        "wheels": wheels,
        "rolling": rolling,
        "rail": {
            "slope": float(rng.choice([0.0, even(0, 0.01)])),
            "adhesion": even(0.1, 0.25),
            "step": text(float(rng.choice([0.0, even(0.0002, 0.005)])), "m"),
            "gap": text(even(0.001, 0.02), "m"),
            "frequency": text(even(3, 15), "Hz"),
        },
        "guide": {
            "type": str(rng.choice(["flanges", "rollers"])),
            "clearance": text(even(0.004, 0.03), "m"),
            "wear": text(even(0, 0.005), "m"),
            "base": text(base + even(0, 1.5), "m"),
            "rail_two": str(rng.choice(["fixed", "movable"])),
            "adhesion": even(0.2, 0.3),
            "edition": str(rng.choice(["en_13001_2", "en_1991_3", "full"])),
            "rating": "1e9 N",
        },
        "wind": {
            "area": text(even(5, 60), "m^2"),
            "load_area": text(even(1, 15), "m^2"),
            "shape": even(1, 2),
            "load_shape": even(1, 1.5),
            "height": text(even(0, 4), "m"),
            "pressure": text(pressure, "Pa"),
            "pressure_max": text(1.5 * pressure, "Pa"),
            "pressure_storm": text(even(500, 1500), "Pa"),
        },
        "speed": text(even(0.3, 2.5), "m/s"),
        "drive": drive,
        "suspension": {"length": text(even(3, 12), "m"), "hoist_speed": text(even(0.02, 1.0), "m/s")},
        "buffers": _buffers(rng, load),
        "parking": {"force": text(spread(1e3, 1e5), "N")},
        "class": {
            "hoisting": str(rng.choice(list(STIFFNESS))),
            "drive": str(rng.choice(["HD1", "HD4", "HD5"])),
            "crane": f"A{int(rng.integers(1, 9))}",
            "release": str(rng.choice(["none", "slow", "quick"])),
            "released_share": even(0.2, 1),
            "play": str(rng.choice(["small", "large"])),
        },
        "declared": {f"phi{k}": even(1.0, 2.5) for k in (1, 2, 4, 5, 6, 7)},
        "duty": duty,
        "checks": {"collision_speed": "100 m/s"},
        "scenes": [
            {"type": "run", "load": str(rng.choice(["full", "empty"]))},
            {"type": "start"},
            {"type": "storm"},
            {"type": "skew"},
            _collision(rng),
            {"type": "rail_step", "speed_share": even(0.5, 1)},
        ],
    }


def _buffers(rng: np.random.Generator, load: float) -> dict[str, Any]:
    """About fit for a crane of this load."""
    sort = str(rng.choice(["linear", "progressive", "constant", "hydraulic"]))
    stroke = float(rng.uniform(0.05, 0.3))
    force = load * float(np.exp(rng.uniform(math.log(5.0), math.log(150.0))))
    hard = {
        "linear": ("stiffness", text(force / stroke, "N/m")),
        "progressive": ("end_force", text(force, "N")),
        "constant": ("force", text(force, "N")),
        "hydraulic": ("orifice", text(force, "kg/m")),
    }[sort]
    power = {"power": float(rng.uniform(1.5, 3))} if sort == "progressive" else {}
    return {"type": sort, "count": 2, "stroke": text(stroke, "m"), hard[0]: hard[1], "rating": "1e12 N", **power}


def _collision(rng: np.random.Generator) -> dict[str, Any]:
    scene: dict[str, Any] = {
        "type": "collision",
        "speed_share": float(rng.choice([1.0, 0.7, 0.5])),
        "suspension": str(rng.choice(["swinging", "guided"])),
        "drive": str(rng.choice(["off", "on"])),
    }
    if rng.random() < 0.3:
        scene["other_mass"] = text(float(rng.uniform(1e4, 1e5)), "kg")
        scene["other_speed"] = text(float(rng.uniform(0, 1)), "m/s")
    return scene


class Statics:
    """A crane of such a file by its balances."""

    def __init__(self, data: dict[str, Any]) -> None:
        self.data = data
        self.load, self.block = number(data["load"]), number(data["hook_block"])
        bridge, trolley, wheels, drive = data["bridge"], data["trolley"], data["wheels"], data["drive"]
        self.bridge, self.trolley = number(bridge["mass"]), number(trolley["mass"])
        self.own = self.bridge + self.trolley
        self.span, self.base, self.centre = number(bridge["span"]), number(wheels["base"]), number(bridge["centre"])
        self.hooks = number(trolley["nearest"]), number(trolley["farthest"])
        self.radius, self.per_corner = number(wheels["diameter"]) / 2, wheels["per_corner"]
        self.driven = dict.fromkeys(wheels["driven"], wheels["driven_per_corner"])
        self.wheel = number(wheels["inertia"])
        self.ratio, self.eta = drive["gear"]["ratio"], drive["gear"]["efficiency"]
        self.back = drive["gear"].get("reverse_efficiency", 2 - 1 / self.eta)
        motor = drive["motor"]
        self.motors = motor["count"]
        self.rotors = self.motors * (number(motor["inertia"]) + number(motor["coupling_inertia"]))
        self.torque = self.motors * number(motor["mean_starting_torque"])
        self.speed = number(data["speed"])
        self.climb = math.atan(data["rail"]["slope"])

    # -- travel ----------------------------------------------------------------------------------------------

    @property
    def coefficient(self) -> float:
        given = self.data["rolling"]
        if "coefficient" in given:
            return float(given["coefficient"])
        turned = number(given["bearing_friction"]) * number(given["axle_diameter"]) / 2 + number(given["lever_arm"])
        return turned / self.radius * number(given["flange_factor"])

    def wind(self, pressure: str, on_load: bool) -> float:
        given = self.data["wind"]
        area = number(given["area"]) * given["shape"]
        area += number(given["load_area"]) * given["load_shape"] if on_load else 0.0
        return number(given[pressure]) * area

    def parts(self, hanging: float, pressure: str, on_load: bool = True) -> tuple[float, float]:
        """What the wheels resist with, and wind and slope besides [N]."""
        weight = (self.own + hanging) * G
        outside = weight * math.sin(self.climb) + self.wind(pressure, on_load)
        return self.coefficient * math.cos(self.climb) * weight, outside

    def motor_torque(self, force: float) -> float:
        """In even travel, with the power that the gear takes on its way either way [N*m]."""
        power = force * self.speed
        through = power / self.eta if power >= 0 else power * self.back
        return through / (self.speed / self.radius * self.ratio)

    def hanging(self, scene: dict[str, Any]) -> float:
        empty = scene.get("load", "empty" if scene["type"] == "storm" else "full") == "empty"
        return self.block + (0.0 if empty else self.load)

    def start(self, scene: dict[str, Any]) -> dict[str, float]:
        resistance = sum(self.parts(self.hanging(scene), "pressure"))
        return {"starting_reserve": self.torque / self.motor_torque(resistance)}

    def run(self, scene: dict[str, Any]) -> dict[str, float]:
        full = scene["load"] == "full"
        hanging = self.hanging(scene)
        resistance = sum(self.parts(hanging, "pressure", full))
        found = {
            "travel_resistance": resistance,
            "travel_coefficient": self.coefficient,
            "torque_motor_travel": self.motor_torque(resistance),
            "power_travel": resistance * self.speed / self.eta,
            "motor_speed": self.speed / self.radius * self.ratio,
            "starting_reserve": self.torque / self.motor_torque(resistance),
            "wind_reserve": self.torque * self.ratio / self.radius * self.eta
            / sum(self.parts(hanging, "pressure_max", full)),
        }  # fmt: skip
        return found | self._wheels(hanging) | self._of_duty() | self._factors(hanging)

    # -- wheels ----------------------------------------------------------------------------------------------

    def corners(self, hook: float, hanging: float, pitching: float = 0.0) -> dict[str, float]:
        """Loads of the corners by moments about the rails, and about the rear wheels for a moment that presses them
        down, shared alike by both rails [N]."""
        masses = ((self.bridge, self.centre), (self.trolley, hook), (hanging, hook))
        on_b = sum(mass * G * across for mass, across in masses) / self.span
        on_a = sum(mass * G for mass, _ in masses) - on_b
        back = pitching / 2 / self.base
        return {
            f"{rail}{end}": load / 2 + side * back
            for rail, load in (("A", on_a), ("B", on_b))
            for end, side in (("1", -1), ("2", 1))
        }

    def _wheels(self, hanging: float) -> dict[str, float]:
        places = [self.corners(hook, hanging) for hook in self.hooks]
        each = np.array([[place[corner] for corner in CORNERS] for place in places]) / self.per_corner
        worst = each[:, each.max(axis=0).argmax()]
        ratio = max(worst.min() / worst.max(), 0.0)
        loads = np.linspace(ratio, 1.0, 20001)
        found = {
            "wheel_load_max": each.max(),
            "wheel_load_min": each.min(),
            "wheel_load_mean": (max(each.min(), 0.0) + 2 * each.max()) / 3,
            "wheel_spectrum_factor": float(np.trapezoid(loads ** (10 / 3), loads) / (1 - ratio)),
        }
        for corner in CORNERS:
            found[f"corner_load_max[{corner}]"] = max(place[corner] for place in places)
            found[f"corner_load_min[{corner}]"] = min(place[corner] for place in places)
        return {name: float(value) for name, value in found.items()}

    # -- duty, classes ---------------------------------------------------------------------------------------

    def _of_duty(self) -> dict[str, float]:
        duty, motor = self.data["duty"], self.data["drive"]["motor"]
        counted = duty["type"] in ("S4", "S5")
        share = 1.0 if duty["type"] == "S1" else duty["factor"]
        on = share * 3600 / number(duty["starts_per_hour"]) if counted else 1.0
        heat = time = 0.0
        for point in duty["load_spectrum"]:
            rolls, outside = self.parts(point["load"] * self.load + self.block, "pressure")
            for sign in (1, -1):
                resistance = rolls + sign * outside
                long, torque = self._start(point["load"] * self.load + self.block, resistance) if counted else (0, 0)
                long = min(long, on)
                even = self.motor_torque(resistance)
                heat += point["share"] * (torque**2 * long + even**2 * (on - long))
                time += point["share"] * on
        rms = math.sqrt(heat / time)
        rest = COOLING[motor["cooling"]]
        cooled, rated = ((ed + rest * (1 - ed)) / ed for ed in (share, motor["rated_duty"]))
        borne = self.motors * number(motor["rated_torque"]) * math.sqrt(cooled / rated)
        factor = sum(point["share"] * point["load"] ** 3 for point in duty["load_spectrum"])
        heavy = next(k for k, most in enumerate(SPECTRA) if factor <= most)

        def group(many: float, classes: tuple[float, ...]) -> float:
            used = sum(many > most for most in classes)
            return float(min(max(used + heavy - 1, 1), 8))

        found = {
            "torque_motor_rms": rms,
            "heating_utilisation": rms / borne,
            "spectrum_factor": factor,
            "crane_group": group(duty["cycles"], USE),
            "mechanism_group": group(number(duty["hours"]), HOURS),
        }
        return found | ({"starts_per_hour": number(duty["starts_per_hour"])} if counted else {})

    def _start(self, hanging: float, resistance: float) -> tuple[float, float]:
        """Time and torque of the motors of a start of one body [s, N*m]."""
        driven = sum(self.driven.values())
        rim = self.ratio / self.radius
        moved = self.own + hanging + (4 * self.per_corner - driven) * self.wheel / self.radius**2
        ramp = self.data["drive"].get("acceleration")
        on_wheels = driven * self.wheel / self.radius**2
        if ramp is not None:
            a = number(ramp)
            force = (moved + on_wheels) * a + resistance
            through = force / self.eta if force >= 0 else force * self.back
            return self.speed / a, self.rotors * rim * a + through / rim
        net = self.torque * rim * self.eta - resistance
        whole = moved + on_wheels + self.rotors * rim**2 * self.eta
        return (self.speed * whole / net if net > 0 else math.inf), self.torque

    def _factors(self, hanging: float) -> dict[str, float]:
        given = self.data["class"]
        least, slope = STIFFNESS[given["hoisting"]]
        lifted = number(self.data["suspension"]["hoist_speed"]) * {"HD1": 1.0, "HD4": 0.5, "HD5": 0.0}[given["drive"]]
        phi2 = least + slope * lifted
        smooth = "acceleration" in self.data["drive"]
        lost = given["released_share"] * self.load / (self.load + self.block)
        back = {"none": None, "slow": 0.5, "quick": 1.0}[given["release"]]
        bare, all_of_it = (
            np.array([[self.corners(hook, mass)[corner] for corner in CORNERS] for hook in self.hooks])
            for mass in (0.0, hanging)
        )
        factored = (1.1 * bare + phi2 * (all_of_it - bare)).max() / self.per_corner
        return {
            "phi1": 1.1,
            "phi2": phi2,
            "phi3": 1.0 if back is None else 1 - lost * (1 + back),
            "phi5": 3.0 if given["play"] == "large" else 1.5 if smooth else 2.0,
            "phi6": (1 + phi2) / 2,
            "wheel_load_factored": float(factored),
        }

    # -- storm -----------------------------------------------------------------------------------------------

    def storm(self, scene: dict[str, Any]) -> dict[str, float]:
        hanging = self.hanging(scene)
        blown = self.wind("pressure_storm", False)
        force = blown + (self.own + hanging) * G * math.sin(self.climb)
        brakes = number(self.data["drive"]["brake"]["torque"]) * self.ratio / self.back / self.radius
        moment = blown * number(self.data["wind"]["height"])
        places = [self.corners(hook, hanging, moment) for hook in self.hooks]
        held = min(self._gripped(place, brakes) for place in places) + number(self.data["parking"]["force"])
        each = [load / self.per_corner for place in places for load in place.values()]
        return {
            "storm_force": force,
            "holding_force": held,
            "storm_reserve": held / force,
            "wheel_load_max": max(each),
            "wheel_load_min": min(each),
        }

    def _gripped(self, place: dict[str, float], brakes: float) -> float:
        adhesion = self.data["rail"]["adhesion"]
        grips = [
            adhesion * max(place[corner], 0.0) / self.per_corner
            for corner, count in self.driven.items()
            for _ in range(count)
        ]
        if self.data["drive"]["wheels"] == "coupled":
            return float(min(brakes, sum(grips)))
        return float(sum(min(grip, brakes / len(grips)) for grip in grips))

    # -- skew ------------------------------------------------------------------------------------------------

    def skew(self, scene: dict[str, Any]) -> dict[str, float]:
        guide = self.data["guide"]
        play, base, wear = (number(guide[key]) for key in ("clearance", "base", "wear"))
        least = {"rollers": 0.005, "flanges": 0.010}[guide["type"]]
        counted = {
            "full": play,
            "en_1991_3": max(least, 0.75 * play),
            "en_13001_2": play if play <= 4 * least / 3 else 0.75 * play,
        }[guide["edition"]]
        angle = (counted + wear) / base + 0.001
        limited = min(angle, 0.015)
        ways = [self._askew(guide, limited, hook, rail) for hook in self.hooks for rail in ("A", "B")]
        return {
            "skew_angle": angle,
            "skew_share": guide["adhesion"] * (1 - math.exp(-250 * limited)),
            "skew_force": max(straight for straight, _ in ways),
            "skew_force_slip": max(curved for _, curved in ways),
        }

    def _askew(self, guide: dict[str, Any], angle: float, hook: float, rail: str) -> tuple[float, float]:
        """Force of the guide on one rail, with friction in proportion to the slip and along its curve [N]."""
        masses = ((self.bridge, self.centre), (self.trolley, hook), (self.load + self.block, hook))
        whole = sum(mass for mass, _ in masses)
        on_two = sum(mass * across for mass, across in masses) / whole / self.span
        on_two = on_two if rail == "A" else 1 - on_two
        front = (number(guide["base"]) - self.base) / 2 if guide["type"] == "rollers" else 0.0
        pairs = (front, front + self.base)
        alike = [
            self.data["drive"]["wheels"] == "coupled" and {f"A{end}", f"B{end}"} <= set(self.driven) for end in "12"
        ]
        # wheels: distance behind the guide, across from rail one, load, whether it holds across, whether it is coupled
        wheels = [
            (d, y, whole * G / 2 * share, y == 0 or guide["rail_two"] == "fixed", together)
            for d, together in zip(pairs, alike, strict=True)
            for y, share in ((0.0, 1 - on_two), (self.span, on_two))
        ]

        def forces(turn: float, middle: float, curved: bool) -> np.ndarray:
            """Across and along of each wheel that turns about a pole 1/turn behind the guide and so far across."""
            out = []
            for d, y, load, holds, together in wheels:
                slip = np.array([(1 - d * turn) * holds, (y - middle) * turn * together])
                size = float(np.hypot(*slip))
                mu0 = guide["adhesion"]
                if curved:
                    share = mu0 * (1 - math.exp(-250 * angle * size)) / size if size else mu0 * 250 * angle
                else:
                    share = mu0 * (1 - math.exp(-250 * angle))
                out.append(load * share * slip)
            return np.array(out)

        d, y = (np.array([wheel[k] for wheel in wheels]) for k in (0, 1))

        def moment(turn: float, middle: float, curved: bool) -> float:
            across, along = forces(turn, middle, curved).T
            return float(across @ d - along @ y)

        unit = self.span * whole * G
        resting = on_two * self.span  # where forces along cancel if they grow with the slip
        turn = brentq(lambda one: moment(one, resting, False) / unit, 0.0, 10.0, xtol=1e-15, rtol=1e-14)
        straight = float(forces(turn, resting, False)[:, 0].sum())
        if not any(alike):
            turn = brentq(lambda one: moment(one, 0.0, True) / unit, 0.0, 10.0, xtol=1e-15, rtol=1e-14)
            return straight, float(forces(turn, 0.0, True)[:, 0].sum())

        def rests(state: np.ndarray) -> list[float]:
            one, middle = state[0] / self.span, state[1] * self.span
            return [moment(one, middle, True) / unit, float(forces(one, middle, True)[:, 1].sum()) / (whole * G)]

        found, _, right, _ = fsolve(rests, [turn * self.span, on_two], xtol=1e-13, full_output=True)
        assert right == 1 or max(map(abs, rests(found))) < 1e-11
        return straight, float(forces(found[0] / self.span, found[1] * self.span, True)[:, 0].sum())

    # -- collision -------------------------------------------------------------------------------------------

    def collision(self, scene: dict[str, Any]) -> dict[str, float]:
        given = self.data["buffers"]
        key = {"linear": "stiffness", "progressive": "end_force", "constant": "force", "hydraulic": "orifice"}
        hard = given["count"] * number(given[key[given["type"]]])
        cushion = Cushion(given["type"], hard, number(given["stroke"]), given.get("power", 2.0))
        driven, rim = sum(self.driven.values()), self.ratio / self.radius
        mass = self.own + 4 * self.per_corner * self.wheel / self.radius**2 + self.rotors * rim**2 * self.eta
        assert driven
        mass += self.hanging(scene) if scene["suspension"] == "guided" else 0.0
        speed = scene["speed_share"] * self.speed
        push = self.torque * rim * self.eta if scene["drive"] == "on" else 0.0
        if "other_mass" in scene:
            other, closing = number(scene["other_mass"]), number(scene["other_speed"])
            found = meeting(cushion, (mass, other), (speed, closing), push)
            speed, moved = (speed + closing) / 2, 2 * mass * other / (mass + other)
        else:
            found, moved = hit(cushion, mass, speed, push), mass
        slows = (found.force - push) / mass
        if math.isfinite(found.way):
            both = [self._turned(scene, cushion, hook, moved / mass, speed, push) for hook in self.hooks]
            found = max((one for one, _ in both), key=lambda one: one.way)
            force, left = max(one.force for one, _ in both), max(one.left for one, _ in both)
            found, slows = Hit(force, found.way, left), max(rate for _, rate in both) * moved / mass
        spent = 1 - math.exp(-2 * hard * cushion.stroke / moved)
        share = {
            "linear": 0.5,
            "progressive": 1 / (cushion.power + 1),
            "constant": 1.0,
            "hydraulic": moved * spent / (2 * hard * cushion.stroke),
        }[cushion.kind]
        return {
            "collision_speed": speed,
            "collision_energy": moved * speed**2 / 2,
            "buffer_force": found.force / given["count"],
            "buffer_stroke": found.way,
            "buffer_speed_left": found.left,
            "buffer_deceleration": slows,
            "phi7": 1.25 + 0.7 * max(share - 0.5, 0.0),
        }

    def _turned(
        self, scene: dict[str, Any], cushion: Cushion, hook: float, share: float, speed: float, push: float
    ) -> tuple[Hit, float]:
        """With the hook in one place: the bridge an even rod about its centre, the trolley a point."""
        rim, wheel = self.ratio / self.radius, self.wheel / self.radius**2
        rails = [sum(many for corner, many in self.driven.items() if corner[0] == rail) for rail in "AB"]
        driven = [many / sum(rails) for many in rails]
        rotors = self.rotors * rim**2 * self.eta + sum(rails) * wheel
        parts = [(self.bridge, self.centre / self.span, 1 / 12), (self.trolley, hook / self.span, 0.0)]
        guided = scene["suspension"] == "guided"
        parts += [(self.hanging(scene) * guided, hook / self.span, 0.0)]
        for rail in (0, 1):
            parts += [((2 * self.per_corner - rails[rail]) * wheel + rotors * driven[rail], float(rail), 0.0)]
        swings = (
            share**2 * self.hanging(scene) * (not guided),
            hook / self.span,
            G / number(self.data["suspension"]["length"]),
        )
        pushes = (push * driven[0], push * driven[1])
        return turned(cushion, [(share * m, x, s) for m, x, s in parts], pushes, swings, speed)

    # -- rail ------------------------------------------------------------------------------------------------

    def rail_step(self, scene: dict[str, Any]) -> dict[str, float]:
        """A mass on a spring whose foot goes up a step, or into a gap and out again, along cosines (EN 13001-2)."""
        rail, speed = self.data["rail"], scene["speed_share"] * self.speed
        step, gap = number(rail["step"]), number(rail["gap"])
        ways = []
        if step:  # half a wave over the way in which a wheel climbs it
            ways.append((step / 2, math.pi * speed / math.sqrt(2 * self.radius * step), math.pi))
        if gap:  # a whole wave as deep as a wheel sinks between its edges
            ways.append((-(gap**2) / 16 / self.radius, 2 * math.pi * speed / gap, 2 * math.pi))
        omega = 2 * math.pi * number(rail["frequency"])
        ends = [_pushed(height, drive, phase, omega) for height, drive, phase in ways]
        return {"phi4": 1 + max(high for _, high in ends) / G, "rail_contact": 1 + min(low for low, _ in ends) / G}


def _pushed(height: float, drive: float, phase: float, omega: float) -> tuple[float, float]:
    """Least and largest acceleration of a mass on a spring whose foot moves by A (1 - cos W t), to a phase [m/s^2]."""
    share = height / (omega**2 - drive**2)

    def acceleration(time: float) -> float:
        return omega**2 * drive**2 * share * (math.cos(drive * time) - math.cos(omega * time))

    until = phase / drive
    ends = [acceleration(until)]
    times = np.linspace(0, until, max(200, round(40 * omega * until)))
    for sign in (1, -1):
        values = [sign * acceleration(one) for one in times.tolist()]
        at = min(max(int(np.argmax(values)), 1), len(times) - 2)
        near = (float(times[at - 1]), float(times[at + 1]))
        found = minimize_scalar(lambda one, sign=sign: -sign * acceleration(one), bounds=near, options={"xatol": 1e-13})
        ends.append(acceleration(float(found.x)))
    # then it swings on by itself: x'' = -omega^2 (x - y), and its rate -omega^2 x'
    rate = omega**2 * drive**2 * share * (omega * math.sin(omega * until) - drive * math.sin(drive * until))
    rest = math.hypot(acceleration(until), rate / omega)
    return min(*ends, -rest), max(*ends, rest)
