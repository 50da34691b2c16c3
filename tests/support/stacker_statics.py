"""Stacker cranes drawn by a number, and what balances of the carriage, beams and weights say of them.

`Statics` reads the data of a design file whose values are in SI units, and works everything out again: nothing of
`ptmcalc` is used.
"""

import math
from typing import Any

import numpy as np

from support.buffer_ode import Cushion, hit
from support.travelling_statics import G, number, text

STEEL = 210e9
POINTS = 2001
"""Of the quadrature along a girder: its moment is straight between the corners, its square a parabola."""


def random_stacker(rng: np.random.Generator, kind: str) -> dict[str, Any]:
    """A stacker of either kind with what standing, hoisting and, of one in an aisle, its buffers are checked for."""

    def even(low: float, high: float) -> float:
        return float(rng.uniform(low, high))

    def spread(low: float, high: float) -> float:
        return float(np.exp(rng.uniform(math.log(low), math.log(high))))

    load, length, ropes = spread(300, 4000), even(5, 25), int(rng.integers(1, 3))
    planes = str(rng.choice(["joint", "separate", "unsaid"]))
    column: dict[str, Any] = {
        "length": text(length, "m"),
        "foot": text(even(0.2, 1), "m"),
        "mass": text(even(0.5, 3) * load, "kg"),
        "second_moment": text(spread(2e-5, 2e-3), "m^4"),
        "root_stiffness": text(spread(1e7, 1e9), "N*m/rad"),
        "section_modulus": text(spread(1e-4, 1e-2), "m^3"),
        "section_modulus_across": text(spread(1e-4, 1e-2), "m^3"),
        "area": text(spread(0.004, 0.05), "m^2"),
    }
    hoist: dict[str, Any] = {
        "speed": text(even(0.1, 1), "m/s"),
        "acceleration": text(even(0.1, 1), "m/s^2"),
        "rope": {
            "falls": ropes * int(rng.integers(1, 5)),
            "ropes": ropes,
            "sheave_efficiency": even(0.94, 0.99),
            "breaking_force": text(even(2, 12) * load * G, "N"),
        },
        "starts_per_hour": int(rng.integers(30, 200)),
        "permitted_starts_per_hour": int(rng.integers(60, 300)),
    }
    data: dict[str, Any] = {
        "kind": "crane",
        "type": kind,
        "load": text(load, "kg"),
        "column": column,
        "carriage": {
            "mass": text(even(0.3, 1) * load, "kg"),
            "load_arm": text(even(-0.8, 0.8), "m"),
            "own_arm": text(even(-0.3, 0.3), "m"),
            "load_arm_across": text(even(-0.8, 0.8), "m"),
            "own_arm_across": text(even(-0.3, 0.3), "m"),
            "rollers": {
                "distance": text(even(0.5, 2.5), "m"),
                "diameter": text(even(0.08, 0.25), "m"),
                "axle_diameter": text(even(0.02, 0.07), "m"),
                "pin_friction": even(0.015, 0.15),
                "lever_arm": text(even(0.0003, 0.001), "m"),
                "per_set": int(rng.integers(1, 4)),
                "rating": "1e9 N",
                **({} if planes == "unsaid" else {"planes": planes}),
            },
        },
        "cab": {"mass": text(even(50, 300), "kg"), "arm": text(even(-1, 1), "m"), "arm_across": text(even(-1, 1), "m")},
        "hoisting": hoist,
        "effects": {"mast_gravity": "off"},
        "checks": {
            "rope_safety": 5.0,
            "column_stress": "1e12 Pa",
            "bridge_stress": "1e12 Pa",
            "catch_deceleration": "100 m/s^2",
        },
        "scenes": [
            {"type": "hoist", "direction": "up"},
            {"type": "hoist", "direction": "down", "load": str(rng.choice(["full", "empty"]))},
            {"type": "stand"},
        ],
    }
    if kind == "overhead_stacker":
        bridge_span = even(6, 25)
        girder = spread(1e-4, 1e-2)
        return data | {
            "bridge": {
                "mass": text(even(2, 8) * load, "kg"),
                "span": text(bridge_span, "m"),
                "girder_vertical": text(girder, "m^4"),
                "girder_horizontal": text(girder * even(0.2, 1), "m^4"),
                "section_modulus_vertical": text(spread(1e-3, 1e-2), "m^3"),
                "section_modulus_horizontal": text(spread(5e-4, 5e-3), "m^3"),
                "ends": "supported",
            },
            "trolley": {
                "mass": text(even(0.5, 3) * load, "kg"),
                "gauge": text(even(1.2, 3), "m"),
                "position": text(even(0.1, 0.9) * bridge_span, "m"),
                "wheels": "free",
            },
        }
    sort = str(rng.choice(["linear", "progressive", "constant", "hydraulic"]))
    stroke, force = even(0.1, 0.5), spread(10, 80) * load
    hard = {
        "linear": ("stiffness", text(force / stroke, "N/m")),
        "progressive": ("end_force", text(force, "N")),
        "constant": ("force", text(force, "N")),
        "hydraulic": ("orifice", text(force, "kg/m")),
    }[sort]
    base = even(2, 5)
    scene = {"type": "buffer", "speed_share": even(0.3, 1), "drive": str(rng.choice(["off", "on"]))}
    return data | {
        "base": {
            "mass": text(even(1, 4) * load, "kg"),
            "wheel_base": text(base, "m"),
            "wheel_diameter": "0.4 m",
            "column": text(even(0.2, 0.8) * base, "m"),
            "centre": text(even(0.3, 0.7) * base, "m"),
            "gauge": text(even(0.05, 0.5), "m"),
        },
        "travel": {
            "speed": text(even(0.5, 4), "m/s"),
            "driving_force": text(even(0.2, 1) * load, "N"),
            "braking_force": text(even(0.2, 1) * load, "N"),
            "buffers": {"type": sort, "count": 2, "stroke": text(stroke, "m"), hard[0]: hard[1], "rating": "1e12 N"},
        },
        "safety_gear": _gear(rng, load),
        "scenes": [*data["scenes"], scene, {"type": "safety_gear"}],
    }


def _gear(rng: np.random.Generator, load: float) -> dict[str, Any]:
    """About fit for a carriage with such a load."""
    stroke = float(rng.uniform(0.05, 0.6))
    force, common = load * G * float(rng.uniform(1.2, 8)), {"stroke": text(stroke, "m")}
    common |= {"trip_ratio": float(rng.uniform(1.2, 1.5)), "reaction_time": text(float(rng.uniform(0, 0.1)), "s")}
    common |= {"arm": text(float(rng.uniform(-0.4, 0.4)), "m")}
    if rng.random() < 0.5:
        return {"type": "progressive", "force": text(force, "N"), **common}
    return {"type": "instantaneous", "stiffness": text(20 * force, "N/m"), **common}


class Statics:
    """A stacker of such a file by its balances."""

    def __init__(self, data: dict[str, Any], *, joint: bool) -> None:
        self.data = data
        self.joint = {"joint": True, "separate": False}.get(data["carriage"]["rollers"].get("planes", ""), joint)
        self.load, self.carriage = number(data["load"]), number(data["carriage"]["mass"])
        self.cab, self.column = number(data["cab"]["mass"]), number(data["column"]["mass"])
        rope = data["hoisting"]["rope"]
        self.falls, self.ropes = rope["falls"], rope["ropes"]

    def climbing(self, scene: dict[str, Any]) -> float:
        return self.carriage + self.cab + (0.0 if scene.get("load") == "empty" else self.load)

    def moment(self, scene: dict[str, Any], across: bool) -> float:
        """Of the weights beside the line of the ropes, with its sign [N*m]."""
        on, tail = self.data["carriage"], "_across" if across else ""
        load = 0.0 if scene.get("load") == "empty" else self.load
        arms = (number(on[f"load_arm{tail}"]), number(on[f"own_arm{tail}"]), number(self.data["cab"][f"arm{tail}"]))
        return G * sum(mass * arm for mass, arm in zip((load, self.carriage, self.cab), arms, strict=True))

    # -- hoisting --------------------------------------------------------------------------------------------

    def hoist(self, scene: dict[str, Any]) -> dict[str, float]:
        rollers, hoisting = self.data["carriage"]["rollers"], self.data["hoisting"]
        up, times = scene["direction"] == "up", 1 + number(hoisting["acceleration"]) / G
        along, across = (abs(self.moment(scene, aside)) / number(rollers["distance"]) for aside in (False, True))
        w = (rollers["pin_friction"] * number(rollers["axle_diameter"]) + 2 * number(rollers["lever_arm"])) / number(
            rollers["diameter"]
        )
        borne = math.hypot(along, across) if self.joint else along + across
        resists, weight = 2 * w * borne * times, self.climbing(scene) * G
        # the falls of a rope, each the next one's times the loss of a sheave
        loss = hoisting["rope"]["sheave_efficiency"]
        each = [(loss if up else 1 / loss) ** k for k in range(self.falls // self.ropes)]
        carried = max(times * weight + (resists if up else -resists), 0.0)
        pull = carried / self.ropes / sum(each)
        reaction = times * math.hypot(along, across)
        found = {
            "roller_reaction": reaction,
            "roller_load": (reaction if self.joint else times * max(along, across)) / rollers["per_set"],
            "carriage_resistance": resists,
            "rope_force": pull,
            "rope_safety": number(hoisting["rope"]["breaking_force"]) / pull if pull else math.inf,
        }
        if up:
            return found | {"starts_ratio": hoisting["starts_per_hour"] / hoisting["permitted_starts_per_hour"]}
        return found | {"jamming": 2 * w * borne / weight}

    # -- standing --------------------------------------------------------------------------------------------

    def stand(self, scene: dict[str, Any]) -> dict[str, float]:
        column, climbs = self.data["column"], self.climbing(scene)
        length = number(column["length"])
        along, across = (self.moment(scene, aside) for aside in (False, True))
        gives = length**3 / 3 / STEEL / number(column["second_moment"]) + length**2 / number(column["root_stiffness"])
        bent = abs(along) / number(column["section_modulus"]) + abs(across) / number(column["section_modulus_across"])
        if self.data["type"] == "overhead_stacker":
            pulled = self.column * G
            more, whole = self._bridge(length, along, across, climbs)
            gives += more.pop("gives")
            more |= {f"combination_force[11.1,{k}]": whole for k in (1, 2, 6)}
        else:
            pulled = self.column * G + climbs * G * (1 + self.ropes / self.falls)
            more, whole = self._base(along, across, climbs)
            more |= {"combination_force[11.2,1]": whole}
        return more | {
            "total_weight": whole,
            "column_stiffness": 1 / gives,
            "column_stress": bent + pulled / number(column["area"]),
        }

    def _base(self, along: float, across: float, climbs: float) -> tuple[dict[str, float], float]:
        """What tips the crane over an axle or a rail, and what keeps it from that."""
        base = self.data["base"]
        wheels, foot, centre = (number(base[key]) for key in ("wheel_base", "column", "centre"))
        on_column, whole = (self.column + climbs) * G, (self.column + climbs + number(base["mass"])) * G
        over_front = on_column * (wheels - foot) + number(base["mass"]) * G * (wheels - centre)
        over_rear = whole * wheels - over_front
        found = {
            "stability_reserve[along]": over_front / along if along > 0 else over_rear / -along,
            "stability_reserve[across]": whole * number(base["gauge"]) / 2 / abs(across),
        }
        return found | {"stability_reserve": min(found.values())}, whole

    def _bridge(self, length: float, along: float, across: float, climbs: float) -> tuple[dict[str, float], float]:
        """How far the girders give under a unit force at the end of the column, and their stress under the trolley."""
        bridge, trolley = self.data["bridge"], self.data["trolley"]
        span, gauge, place = number(bridge["span"]), number(trolley["gauge"]), number(trolley["position"])
        gives = sum(self.girders(length))
        near = min(place, span - place)
        hung = (number(trolley["mass"]) + self.column + climbs) * G
        on_one = hung / 2 + abs(along) / gauge
        own = number(bridge["mass"]) / 2 * G / span
        most = on_one * near * (span - near) / span + own * near * (span - near) / 2
        most += abs(across) / 2 * (span - near) / span
        stress = most / number(bridge["section_modulus_vertical"])
        return {"gives": gives, "bridge_stress": stress}, hung + number(bridge["mass"]) * G

    def girders(self, length: float) -> tuple[float, float]:
        """How far a unit force at the end of the column moves it as the girders sag and as they bend aside [m/N]."""
        bridge, trolley = self.data["bridge"], self.data["trolley"]
        span, gauge, place = number(bridge["span"]), number(trolley["gauge"]), number(trolley["position"])
        down, aside = (number(bridge[f"girder_{way}"]) for way in ("vertical", "horizontal"))
        # bending moment of a girder on two supports under a unit force, and its work
        parts = [np.linspace(0, place, POINTS), np.linspace(place, span, POINTS)]
        unit = [parts[0] * (span - place) / span, (span - parts[1]) * place / span]
        work = sum(float(_simpson(moment**2, at)) for moment, at in zip(unit, parts, strict=True)) / STEEL
        return 2 * (length / gauge) ** 2 * work / down, work / 2 / aside

    # -- buffers ---------------------------------------------------------------------------------------------

    def buffer(self, scene: dict[str, Any]) -> dict[str, float]:
        travel = self.data["travel"]
        given = travel["buffers"]
        key = {"linear": "stiffness", "progressive": "end_force", "constant": "force", "hydraulic": "orifice"}
        hard = given["count"] * number(given[key[given["type"]]])
        cushion = Cushion(given["type"], hard, number(given["stroke"]))
        mass = number(self.data["base"]["mass"]) + self.column + self.climbing(scene)
        speed = scene["speed_share"] * number(travel["speed"])
        push = number(travel["driving_force"]) if scene["drive"] == "on" else 0.0
        found = hit(cushion, mass, speed, push)
        spent = 1 - math.exp(-2 * hard * cushion.stroke / mass)
        share = {
            "linear": 0.5,
            "progressive": 1 / 3,
            "constant": 1.0,
            "hydraulic": mass * spent / 2 / hard / cushion.stroke,
        }
        return {
            "collision_speed": speed,
            "buffer_force": found.force / given["count"],
            "buffer_stroke": found.way,
            "buffer_speed_left": found.left,
            "buffer_deceleration": (found.force - push) / mass,
            "phi7": 1.25 + 0.7 * max(share[cushion.kind] - 0.5, 0.0),
        }

    # -- safety gear -----------------------------------------------------------------------------------------

    def safety_gear(self, scene: dict[str, Any]) -> dict[str, float]:
        """A free fall from the sinking carriage to the gear that holds, and the way under its force and the weight."""
        gear, column, mass = self.data["safety_gear"], self.data["column"], self.climbing(scene)
        even, sinks = gear["type"] == "progressive", number(self.data["hoisting"]["speed"])
        catch = gear["trip_ratio"] * sinks + G * number(gear["reaction_time"])
        hard = number(gear["force" if even else "stiffness"])
        way = hit(Cushion("constant" if even else "linear", hard, number(gear["stroke"])), mass, catch, mass * G).way
        force = hard if even else hard * way
        times = max(force / mass / G, 1.0)
        along, across = (abs(self.moment(scene, aside)) for aside in (False, True))
        gripped = force * abs(number(gear["arm"]))
        bent = max(gripped, times * along) / number(column["section_modulus"])
        bent += times * across / number(column["section_modulus_across"])
        return {
            "safety_gear_force": force,
            "safety_gear_distance": way,
            "safety_gear_factor": force / mass / G,
            "safety_gear_deceleration": force / mass - G,
            "safety_gear_speed": catch,
            "safety_gear_drop": (catch**2 - sinks**2) / 2 / G,
            "safety_gear_moment": gripped,
            "safety_gear_shock": 2 * force if even else force,
            "combination_force[11.2,6]": force,
            "column_stress": bent + (self.column * G + force) / number(column["area"]),
        }


def _simpson(values: np.ndarray, at: np.ndarray) -> float:
    step = (at[-1] - at[0]) / (len(at) - 1)
    return float(step / 3 * (values[0] + values[-1] + 4 * values[1:-1:2].sum() + 2 * values[2:-1:2].sum()))
