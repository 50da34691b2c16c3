"""Actions of travelling cranes on their runway, worked out again: reactions by a linear solve, the moment of the drives
by their positions, the skewing pole as the root of the moments about the guide, and buffers by energy.

`Balances` reads the data of a design file whose values are in SI units; nothing of `ptmcalc` is used.
"""

import math
from typing import Any

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq

from support.travelling_statics import CORNERS, STIFFNESS, G, number, random_crane, text

LEAST = {"flanges": 0.010, "rollers": 0.005}
BETA = {"none": 0.0, "slow": 0.5, "quick": 1.0}
GROUPS = ("1", "2", "3", "4", "5", "6", "7", "8 dynamic", "8 static", "9", "10")
Numbers = dict[str, float]


def random_runway(rng: np.random.Generator) -> dict[str, Any]:
    """A crane with all that its runway asks for; some stand askew too far, some lift a wheel."""

    def even(low: float, high: float) -> float:
        return float(rng.uniform(low, high))

    data = random_crane(rng)
    span, base = number(data["bridge"]["span"]), number(data["wheels"]["base"])
    data["rail"].pop("step")
    data["rail"].pop("gap")
    driven = [list(CORNERS), ["A1", "B1"], ["A2", "B2"], ["A1", "A2"]]
    data["wheels"]["driven"] = driven[int(rng.choice(4, p=[0.3, 0.4, 0.2, 0.1]))]
    data["class"] |= {"drive": "HD1", "lifting_share": even(0, 0.1)}
    if rng.random() < 0.4:
        data["travels"] = "gantry"
        data["bridge"] |= {"cantilever_a": text(0.4 * span, "m"), "cantilever_b": text(0.4 * span, "m")}
        data["trolley"] |= {"nearest": text(even(-0.38, 0.0) * span, "m")}
    if rng.random() < 0.3:
        data["guide"]["wear"] = text(even(0.01, 0.1), "m")
    data["guide"]["base"] = text(base + even(0, 2), "m")
    if data["buffers"]["type"] == "hydraulic":
        data["buffers"] = {"type": "constant", "force": text(even(5, 80) * 1e3, "N"), "stroke": "0.4 m"}
    data["runway"] = {
        "edition": "EN 1991-3:2006",
        "K_with_phi": bool(rng.random() < 0.5),
        "contact": str(rng.choice(["steel", "rubber"])),
        "fatigue_class": f"S{int(rng.integers(10))}",
        "fatigue_factor": str(rng.choice(["separate", "larger"])),
        "suspension": str(rng.choice(["swinging", "guided"])),
        "speed_share": even(0.5, 1),
    }
    for key, low, high in (("phi4", 1.0, 1.1), ("phi5", 1.0, 2.0), ("phi2", 1.05, 1.5), ("phi7", 1.25, 1.6)):
        if rng.random() < 0.4:
            data["runway"][key] = even(low, high)
    if rng.random() < 0.2:
        data["runway"]["skew_angle"] = text(even(0.0005, 0.02), "rad")
    data["scenes"] = [{"type": "runway"}]
    return data


class Balances:
    """One crane."""

    def __init__(self, data: dict[str, Any]) -> None:
        self.data, self.given = data, data["runway"]
        self.span, self.base = number(data["bridge"]["span"]), number(data["wheels"]["base"])
        self.load, self.block = number(data["load"]), number(data["hook_block"])
        self.count = 2 * int(data["wheels"]["per_corner"])
        self.phi = self._factors()

    def _factors(self) -> Numbers:
        least, slope = STIFFNESS[self.data["class"]["hoisting"]]
        phi2 = self.given.get("phi2", least + slope * number(self.data["suspension"]["hoist_speed"]))
        words = self.data["class"]
        released = words["released_share"] * self.load / (self.load + self.block) * (words["release"] != "none")
        sudden = 3.0 if words["play"] == "large" else 1.5 if "acceleration" in self.data["drive"] else 2.0
        return {
            "phi1": 1 + words["lifting_share"],
            "phi2": phi2,
            "phi3": 1 - released * (1 + BETA[words["release"]]),
            "phi4": self.given.get("phi4", 1.0),
            "phi5": self.given.get("phi5", sudden),
            "phi6": (1 + phi2) / 2,
        }

    def reactions(self, hook: float, on_crane: float, on_hoist: float) -> tuple[float, float]:
        """Of one wheel of rail A and of rail B."""
        bridge, trolley = self.data["bridge"], self.data["trolley"]
        weights = [
            (on_crane * number(bridge["mass"]) * G, number(bridge["centre"])),
            (on_crane * number(trolley["mass"]) * G, hook),
            (on_hoist * (self.load + self.block) * G, hook),
        ]
        both = np.linalg.solve(
            [[1.0, 1.0], [0.0, self.span]], [sum(w for w, _ in weights), sum(w * x for w, x in weights)]
        )
        return float(both[0]) / self.count, float(both[1]) / self.count

    def all_of(self, on_crane: float, on_hoist: float) -> list[tuple[float, float]]:
        """Larger and smaller wheel load for both ends of the trolley."""
        ends = [number(self.data["trolley"][key]) for key in ("nearest", "farthest")]
        pairs = [self.reactions(end, on_crane, on_hoist) for end in ends]
        return [(max(pair), min(pair)) for pair in pairs]

    def group(self, name: str) -> tuple[float, float | None, float | None]:
        """Factors of a group on the crane and on the hoist load, and that of the load shares of H_T."""
        p = self.phi
        eta = self.block / (self.load + self.block)
        test = 1.1 * p["phi6"]
        return {
            "1": (p["phi1"], p["phi2"], p["phi2"]),
            "2": (p["phi1"], p["phi3"], p["phi2"]),
            "3": (1.0, None, 1.0),
            "4": (p["phi4"], p["phi4"], p["phi4"]),
            "5": (p["phi4"], p["phi4"], None),
            "6": (p["phi4"], p["phi4"], None),
            "7": (1.0, eta, None),
            "8 dynamic": (p["phi1"], test, test),
            "8 static": (p["phi1"], 1.25, None),
            "9": (1.0, 1.0, None),
            "10": (1.0, 1.0, None),
        }[name]

    def runway(self) -> Numbers:
        """All loads of the table."""
        found: Numbers = {}
        for name in GROUPS:
            on_crane, on_hoist, shared = self.group(name)
            if on_hoist is not None:
                large, small = max(self.all_of(on_crane, on_hoist))
                found |= {f"runway_wheel_max[{name}]": large, f"runway_wheel_max_other[{name}]": small}
            empty = min(self.all_of(on_crane, 0.0), key=min)
            found |= {f"runway_wheel_min[{name}]": empty[1], f"runway_wheel_min_other[{name}]": empty[0]}
            if shared is not None:
                found |= {f"{key}[{name}]": value for key, value in self._drives(on_crane, shared).items()}
        found["runway_wheel_least"] = min(value for key, value in found.items() if key.startswith("runway_wheel_m"))
        trolley = 0.1 * G * (number(self.data["trolley"]["mass"]) + self.load + self.block)
        if self.given["suspension"] == "swinging":
            found |= {"runway_transverse_3[6]": trolley, "runway_buffer_trolley[9]": trolley}
        return found | self._wind() | self._buffers() | self._skewing() | self._fatigue()

    def _drives(self, on_crane: float, shared: float) -> Numbers:
        driven = self.data["wheels"]["driven"]
        each = int(self.data["wheels"]["driven_per_corner"])
        sides = [sum(each for corner in driven if corner[0] == rail) for rail in "AB"]
        if sides[0] != sides[1]:
            return {}
        empty = min(self.all_of(on_crane if self.given["K_with_phi"] else 1.0, 0.0), key=min)
        carried = sides[0] * (empty[1] + (empty[0] if self.data["drive"]["wheels"] == "coupled" else empty[1]))
        force = {"steel": 0.2, "rubber": 0.5}[self.given["contact"]] * carried
        large, small = max(self.all_of(on_crane, shared))
        across = np.array([0.0, self.span])  # of the light and the loaded rail
        centre = float(across @ np.array([small, large])) / (small + large)
        pushes = np.array([force / 2, force / 2])
        moment = float(pushes @ (centre - across))
        guide = self.data["guide"]
        arm = number(guide["base"]) if guide["type"] == "rollers" else self.base
        # a couple on each rail, in the ratio of its wheel loads
        light, loaded = np.linalg.solve([[1.0, 1.0], [large, -small]], [moment / arm, 0.0])
        factor = self.phi["phi5"]
        return {
            "runway_drive_force": force,
            "runway_longitudinal": factor * force / 2,
            "runway_transverse_1": factor * light,
            "runway_transverse_2": factor * loaded,
        }

    def _wind(self) -> Numbers:
        wind = self.data["wind"]
        own = wind["shape"] * number(wind["area"])
        load = wind["load_shape"] * number(wind["load_area"])
        most = number(wind["pressure_max"])
        found = {f"runway_wind[{name}]": most * (own + load) for name in ("1", "2", "4", "5", "8 dynamic")}
        return found | {"runway_wind[3]": most * own, "runway_wind[7]": number(wind["pressure_storm"]) * own}

    def _buffers(self) -> Numbers:
        buffers = self.data["buffers"]
        guided = 1.0 if self.given["suspension"] == "guided" else 0.0
        worst = max(range(2), key=lambda k: self.all_of(1.0, 1.0)[k])
        place = self.all_of(1.0, 1.0)[worst]
        hook = number(self.data["trolley"][("nearest", "farthest")[worst]])
        rail = self.reactions(hook, 1.0, 1.0).index(place[0])
        mass = self.count * self.reactions(hook, 1.0, guided)[rail] / G
        energy = mass * (self.given["speed_share"] * number(self.data["speed"])) ** 2 / 2
        stroke = number(buffers["stroke"])

        def force(u: float) -> float:
            if buffers["type"] == "linear":
                return number(buffers["stiffness"]) * u
            if buffers["type"] == "progressive":
                return float(number(buffers["end_force"]) * (u / stroke) ** buffers["power"])
            return number(buffers["force"])

        def work(u: float) -> float:
            return float(quad(force, 0, u, epsabs=0, epsrel=1e-12)[0])

        if work(stroke) < energy:
            return {}
        reached = float(brentq(lambda u: work(u) - energy, 0, stroke, xtol=1e-16, rtol=1e-14))
        share = work(stroke) / (force(stroke) * stroke)
        factor = self.given.get("phi7", 1.25 if share <= 0.5 else 1.25 + 0.7 * (share - 0.5))
        return {"runway_buffer[9]": factor * force(reached)}

    def _angle(self) -> float:
        if "skew_angle" in self.given:
            return number(self.given["skew_angle"])
        guide = self.data["guide"]
        used = max(0.75 * number(guide["clearance"]), LEAST[guide["type"]])
        return (used + number(guide["wear"])) / number(guide["base"]) + guide.get("tolerance", 0.001)

    def _skewing(self) -> Numbers:
        angle = self._angle()
        friction = 0.3 * (1 - math.exp(-250 * min(angle, 0.015)))
        found = {"runway_skew_angle": angle, "runway_skew_share": friction}
        large, small = max(self.all_of(1.0, 1.0))
        if small <= 0:
            return found
        guide, driven = self.data["guide"], self.data["wheels"]["driven"]
        front = (number(guide["base"]) - self.base) / 2 if guide["type"] == "rollers" else 0.0
        ends = np.array([front, front + self.base])
        alike = np.array([{f"A{k}", f"B{k}"} <= set(driven) for k in (1, 2)]) & (
            self.data["drive"]["wheels"] == "coupled"
        )
        for place, one, two in (("light rail", small, large), ("loaded rail", large, small)):
            forces = self._askew(ends, alike, friction, one * self.count / 2, two * self.count / 2)
            whole = float(forces[:2].sum())
            found[f"runway_guide_force[{place}]"] = whole
            for k in (0, 1):
                names = ("runway_skew_across_1", "runway_skew_across_2", "runway_skew_along")
                found |= {f"{name}[{place}, {k + 1}]": float(row[k]) for name, row in zip(names, forces, strict=True)}
            if guide["type"] == "flanges":
                found[f"runway_skew_net[{place}, 1]"] = whole - float(forces[0, 0])
        return found

    def _askew(self, ends: np.ndarray, alike: np.ndarray, friction: float, one: float, two: float) -> np.ndarray:
        """Forces across of rail 1 and rail 2, and along, of both pairs with the loads of a corner of each rail; slip
        grows with the distance from a pole, found where the moments about the guide vanish."""
        held = self.data["guide"]["rail_two"] == "fixed"
        zero = self.span * two / (one + two)  # where coupled wheels do not slip along: their forces cancel

        def forces(pole: float) -> np.ndarray:
            across = friction * (1 - ends / pole)
            along = friction * one * zero / pole * alike
            return np.array([one * across, two * across * held, along])

        def moment(pole: float) -> float:
            each = forces(pole)
            return float((each[0] + each[1]) @ ends - each[2].sum() * self.span)

        pole = float(brentq(lambda inverse: moment(1 / inverse), 1e-9, 1e3, xtol=1e-18, rtol=1e-14))
        return forces(1 / pole)

    def _fatigue(self) -> Numbers:
        crane, hoist = (1 + self.phi["phi1"]) / 2, (1 + self.phi["phi2"]) / 2
        if self.given["fatigue_factor"] == "larger":
            crane = hoist = max(crane, hoist)
        worst = max(range(2), key=lambda k: self.all_of(1.0, 1.0)[k])
        hook = number(self.data["trolley"][("nearest", "farthest")[worst]])
        rail = int(np.argmax(self.reactions(hook, 1.0, 1.0)))
        load = self.reactions(hook, crane, hoist)[rail]
        k = int(self.given["fatigue_class"][1])
        normal, shear = (
            (0.198, 0.25, 0.315, 0.397, 0.5, 0.63, 0.794, 1.0, 1.26, 1.587)[k],
            (0.379, 0.436, 0.5, 0.575, 0.66, 0.758, 0.871, 1.0, 1.149, 1.32)[k],
        )
        return {"runway_fatigue_normal": normal * load, "runway_fatigue_shear": shear * load}
