"""Hoists drawn by a number, and what balances of sheaves, turns laid one by one and power say of them.

`Statics` reads the data of a design file whose values are in SI units, and works everything out again: nothing of
`ptmcalc` is used.
"""

import math
from typing import Any

import numpy as np
from scipy.optimize import brentq

from support.hoists import balanced_falls
from support.travelling_statics import COOLING, HOURS, SPECTRA, USE, G, number, text


def random_hoist(rng: np.random.Generator) -> dict[str, Any]:
    """A hoist with all that its even motion is checked for."""

    def even(low: float, high: float) -> float:
        return float(rng.uniform(low, high))

    def spread(low: float, high: float) -> float:
        return float(np.exp(rng.uniform(math.log(low), math.log(high))))

    ropes, of_each, layers = int(rng.integers(1, 3)), int(rng.integers(1, 5)), int(rng.integers(1, 5))
    load, height, d = spread(1e3, 5e4), spread(4, 60), even(0.008, 0.03)
    block, drum, pitch = even(0.005, 0.05) * load, even(12, 30) * d, even(1.0, 1.2) * d
    dead, turns = float(rng.integers(2, 6)), int(rng.integers(15, 60))
    hook, falls = even(0.03, 0.5), ropes * of_each
    arm = (drum + d) / 2 / of_each
    motor_speed, efficiency = even(70, 300), even(0.75, 0.98)
    ratio = motor_speed / (hook / arm)
    static = (load + block) * G * arm / ratio
    gear: dict[str, Any] = {"ratio": ratio, "efficiency": efficiency}
    if rng.random() < 0.5:
        gear["reverse_efficiency"] = even(0.4, efficiency)
    on_drum = rng.random() < 0.3
    sort = str(rng.choice(["S1", "S3", "S4", "S5"]))
    shares = rng.dirichlet([1, 1, 1])
    count = int(rng.integers(1, 3))
    return {
        "kind": "hoist",
        "load": text(load, "kg"),
        "hook_block": text(block, "kg"),
        "height": text(height, "m"),
        "least_fall": text(even(0.5, 3), "m"),
        "speed": {"main": text(hook, "m/s")},
        "reeving": {
            "falls": falls,
            "ropes": ropes,
            "sheave_efficiency": even(0.94, 0.995),
            "deflection_sheaves": int(rng.integers(0, 4)),
            "lead_length": text(even(2, 20), "m"),
            "lead_offset": text(even(0, 0.2), "m"),
            "sheave_diameter": text(even(14, 30) * d, "m"),
            "equaliser_diameter": text(even(10, 25) * d, "m"),
        },
        "rope": {
            "diameter": text(d, "m"),
            "area": text(even(0.4, 0.6) * math.pi * d**2 / 4, "m^2"),
            "modulus": text(even(80e9, 120e9), "Pa"),
            "mass": text(even(3500, 5000) * d**2, "kg/m"),
            "breaking_force": text(even(2, 9) * (load + block) * G / falls, "N"),
        },
        "drum": {
            "diameter": text(drum, "m"),
            "length": text(turns * pitch, "m"),
            "pitch": text(pitch, "m"),
            "layers": layers,
            "flange_height": text((layers + even(0.2, 3)) * d, "m"),
            "dead_wraps": dead,
            "shell_thickness": text(even(0.5, 1.5) * d, "m"),
            "inertia": text(even(0, 0.3) * load * arm**2, "kg*m^2"),
        },
        "winding": {"packing": str(rng.choice(["nested", "square"]))},
        "gearbox": gear,
        "motor": {
            "count": count,
            "inertia": text(spread(0.5, 10) * load * (arm / ratio) ** 2, "kg*m^2"),
            "coupling_inertia": text(spread(0.05, 1) * load * (arm / ratio) ** 2, "kg*m^2"),
            "no_load_speed": text(1.02 * motor_speed, "rad/s"),
            "mean_starting_torque": text(even(0.9, 3) * static / count, "N*m"),
            "rated_torque": text(even(0.7, 1.5) * static / count, "N*m"),
            "rated_duty": even(0.25, 1.0),
            "starts_per_hour": int(rng.integers(60, 400)),
            "cooling": str(rng.choice(list(COOLING))),
        },
        "brake": {
            "torque": text(even(0.6, 2.5) * static * (ratio if on_drum else 1.0), "N*m"),
            "shaft": "drum" if on_drum else "motor",
        },
        "class": {"mechanism": f"M{int(rng.integers(1, 9))}"},
        "duty": {
            "type": sort,
            **({} if sort == "S1" else {"factor": even(0.2, 0.7)}),
            **({"starts_per_hour": int(rng.integers(60, 300))} if sort in ("S4", "S5") else {}),
            "load_spectrum": [
                {"share": float(s), "load": q}
                for s, q in zip(shares, [1.0, even(0.4, 0.9), even(0.05, 0.4)], strict=True)
            ],
            "cycles": spread(1e4, 8e6),
            "hours": f"{spread(100, 1e5)!r} h",
        },
        "checks": {"layer_factor": even(1, 2), "hoop_stress": "1e9 Pa", "motor_reserve": 1.4},
        "scenes": [
            {"type": "run", "load": str(rng.choice(["full", "full", "empty"]))},
            {"type": "start"},
            {"type": "lower_brake"},
        ],
    }


class Statics:
    """A hoist of such a file by its balances."""

    def __init__(self, data: dict[str, Any]) -> None:
        self.data = data
        given, rope, drum = data["reeving"], data["rope"], data["drum"]
        self.load, self.block = number(data["load"]), number(data["hook_block"])
        self.height, self.least = number(data["height"]), number(data["least_fall"])
        self.ropes, self.of_each = given["ropes"], given["falls"] // given["ropes"]
        self.sheave, self.lost = given["sheave_efficiency"], given["sheave_efficiency"] ** given["deflection_sheaves"]
        self.d, self.barrel, self.pitch = number(rope["diameter"]), number(drum["diameter"]), number(drum["pitch"])
        self.turns, self.dead = round(number(drum["length"]) / self.pitch), drum["dead_wraps"]
        self.nested = data["winding"]["packing"] == "nested"
        self.ratio, self.eta = data["gearbox"]["ratio"], data["gearbox"]["efficiency"]
        self.back = data["gearbox"].get("reverse_efficiency", 2 - 1 / self.eta)
        motor = data["motor"]
        self.motors = motor["count"]
        self.rotors = self.motors * (number(motor["inertia"]) + number(motor["coupling_inertia"]))
        self.torque = self.motors * number(motor["mean_starting_torque"])
        self.drum_speed = number(data["speed"]["main"]) * self.of_each / self.radius(1)

    # -- rope ------------------------------------------------------------------------------------------------

    def falls(self, mass: float, height: float, hauling: bool) -> np.ndarray:
        """Pulls at the lower and upper ends of the falls of one rope, that of the drum first [N]."""
        weight = number(self.data["rope"]["mass"]) * G * (self.least + self.height - height)
        return balanced_falls(mass * G / self.ropes, self.of_each, self.sheave, weight, hauling)

    def pull(self, mass: float, height: float, hauling: bool) -> float:
        """Of one rope at the drum [N]."""
        end = float(self.falls(mass, height, hauling)[1, 0])
        return end / self.lost if hauling else end * self.lost

    def step(self, nested: bool) -> float:
        """From layer to layer: a rope on the two below it, its centre above the middle between theirs [m]."""
        return math.sqrt(self.d**2 - self.pitch**2 / 4) if nested else self.d

    def radius(self, layer: int) -> float:
        return self.barrel / 2 + self.d / 2 + (layer - 1) * self.step(self.nested)

    def room(self, layer: int, turns: float, nested: bool) -> float:
        return turns - 1 if nested and layer % 2 == 0 else turns

    def on_drum(self, layers: int, turns: float, nested: bool) -> float:
        """Rope in so many full layers [m]."""
        first, step = self.barrel / 2 + self.d / 2, self.step(nested)
        return sum(
            2 * math.pi * (first + (layer - 1) * step) * self.room(layer, turns, nested)
            for layer in range(1, layers + 1)
        )

    def wound(self, height: float) -> tuple[float, int]:
        """Turns and layers of one rope with the hook so high."""
        rest, layer, done = self.length_on_drum(height), 1, 0.0
        while True:
            turn, room = 2 * math.pi * self.radius(layer), self.room(layer, self.turns, self.nested)
            if rest <= turn * room:
                return done + rest / turn, layer
            rest, done, layer = rest - turn * room, done + room, layer + 1

    def length_on_drum(self, height: float) -> float:
        return self.dead * 2 * math.pi * self.radius(1) + height * self.of_each

    def begins(self) -> list[float]:
        """Heights of the hook at which the layers begin [m]."""
        most = self.wound(self.height)[1]
        below = [self.on_drum(layer - 1, self.turns, self.nested) for layer in range(1, most + 1)]
        return [min(max((length - self.length_on_drum(0.0)) / self.of_each, 0.0), self.height) for length in below]

    def drum_torque(self, mass: float, hauling: bool) -> float:
        """Largest of all heights: where a layer begins, or with the hook at its lowest [N*m]."""
        first = self.wound(0.0)[1]
        places = [(0.0, first), *((h, k) for k, h in enumerate(self.begins(), 1) if k > first)]
        return max(self.ropes * self.pull(mass, h, hauling) * self.radius(k) for h, k in places)

    # -- scenes ----------------------------------------------------------------------------------------------

    def mass(self, scene: dict[str, Any]) -> float:
        return self.block + (0.0 if scene.get("load") == "empty" else self.load)

    def run(self, scene: dict[str, Any]) -> dict[str, float]:
        mass = self.mass(scene)
        up, down = (self.drum_torque(mass, hauling) for hauling in (True, False))
        on_motor = up / self.ratio / self.eta
        found = {
            "motor_speed": self.drum_speed * self.ratio,
            "torque_motor_static_up": on_motor,
            "torque_motor_static_down": down / self.ratio * self.back,
            "power_hoisting": on_motor * self.drum_speed * self.ratio,
            "torque_drum": up,
        }
        return (
            found | self._rope(mass) | self._drum(mass) | self.start(scene) | self.lower_brake(scene) | self._duty(mass)
        )

    def _rope(self, mass: float) -> dict[str, float]:
        data = self.data
        pull, area = self.pull(mass, 0.0, True), number(data["rope"]["area"])
        free = balanced_falls(1.0, self.of_each, self.sheave, 0.0, True)[1, 0]
        length = (self.least + self.height) * self.of_each + number(data["reeving"]["lead_length"])
        stiffness = self.ropes * self.of_each**2 * number(data["rope"]["modulus"]) * area / length
        found = {
            "reeving_efficiency": self.lost / self.of_each / free,
            "rope_pull_max": pull,
            "rope_pull_lowering": self.pull(mass, 0.0, False),
            "rope_pull_empty": float(self.falls(self.block, 0.0, False)[0].min()),
            "rope_length": length,
            "rope_speed": self.drum_speed * self.radius(1),
            "rope_stiffness": stiffness,
            "static_stretch": mass * G / stiffness,
            "natural_frequency": self.swing(stiffness, mass),
            "rope_safety": number(data["rope"]["breaking_force"]) / pull,
            "drum_ratio": (self.barrel + self.d) / self.d,
            "sheave_ratio": number(data["reeving"]["sheave_diameter"]) / self.d + 1,
            "equaliser_ratio": number(data["reeving"]["equaliser_diameter"]) / self.d + 1,
        }
        ends = self.falls(mass, 0.0, True)[1]
        return found | {f"rope_pull_fall[{fall}]": float(end) for fall, end in enumerate(ends, 1)}

    def swing(self, stiffness: float, mass: float) -> float:
        """Lowest frequency of the mass on the falls as one rod that is held at its top: x tan(x) = rod/mass [rad/s]."""
        rod = number(self.data["rope"]["mass"]) * (self.least + self.height) * self.of_each * self.ropes
        x = brentq(lambda at: at * math.sin(at) - rod / mass * math.cos(at), 0.0, math.pi / 2, xtol=1e-15, rtol=1e-14)
        return x * math.sqrt(stiffness / rod)

    def _drum(self, mass: float) -> dict[str, float]:
        drum, given = self.data["drum"], self.data["reeving"]
        turns, layers = self.wound(self.height)
        asked = drum["layers"]
        length = self.length_on_drum(self.height)
        needed = brentq(lambda n: self.on_drum(asked, n, self.nested) - length, 0.1, 1e6, xtol=1e-12, rtol=1e-14)
        travel = (turns - self.dead) * self.pitch if layers == 1 else number(drum["length"])
        rated = self.pull(self.block + self.load, 0.0, True)
        found = {
            "hook_speed": self.drum_speed * self.radius(1) / self.of_each,
            "hook_speed_max": self.drum_speed * self.radius(layers) / self.of_each,
            "drum_speed": self.drum_speed,
            "drum_turns": turns,
            "drum_layers": float(layers),
            "drum_length_required": needed * self.pitch,
            "drum_capacity_nested": self.on_drum(asked, self.turns, True),
            "drum_capacity_square": self.on_drum(asked, self.turns, False),
            "drum_slenderness": self.ropes * number(drum["length"]) / self.barrel,
            "dead_wraps": self.dead,
            "flange_margin": (number(drum["flange_height"]) - self.d - (layers - 1) * self.step(self.nested)) / self.d,
            "fleet_angle": math.atan((travel / 2 + number(given["lead_offset"])) / number(given["lead_length"])),
            "hoop_stress": self.data["checks"]["layer_factor"] * rated / self.pitch / number(drum["shell_thickness"]),
        }
        for layer, height in enumerate(self.begins()[:asked], 1):
            found[f"layer_speed[{layer}]"] = self.drum_speed * self.radius(layer) / self.of_each
            found[f"layer_torque[{layer}]"] = self.ropes * self.pull(mass, height, True) * self.radius(layer)
            found[f"layer_pull[{layer}]"] = self.pull(mass, 0.0, True) * self.radius(1) / self.radius(layer)
        return found

    def behind(self, mass: float) -> float:
        """Inertia of drum and hanging mass on the drum shaft [kg*m^2]."""
        return number(self.data["drum"]["inertia"]) + mass * (self.radius(1) / self.of_each) ** 2

    def rising(self, mass: float) -> float:
        """Acceleration of the motor shaft upwards: the torque of the gear goes through with its loss [rad/s^2]."""
        load, inertia = self.drum_torque(mass, True), self.behind(mass)
        # motor: J1 a = M - T/(u eta), drum: J2 a/u = T - M_L
        a, _ = np.linalg.solve(
            [[self.rotors, 1 / self.ratio / self.eta], [inertia / self.ratio, -1.0]], [self.torque, -load]
        )
        return float(a)

    def sinking(self, mass: float) -> float:
        """Acceleration of the motor shaft downwards, helped by the motor, the gear either way [rad/s^2]."""
        load, inertia = self.drum_torque(mass, False), self.behind(mass)
        for passed in (self.back, 1 / self.eta):
            a, through = np.linalg.solve(
                [[self.rotors, -passed / self.ratio], [inertia / self.ratio, 1.0]], [self.torque, load]
            )
            if (through >= 0) == (passed == self.back):
                break
        return float(a)

    def start(self, scene: dict[str, Any]) -> dict[str, float]:
        mass = self.mass(scene)
        a = self.rising(mass)
        return {
            "starting_reserve": self.torque / (self.drum_torque(mass, True) / self.ratio / self.eta),
            "start_time": self.drum_speed * self.ratio / a if a > 0 else math.inf,
        }

    def lower_brake(self, scene: dict[str, Any]) -> dict[str, float]:
        mass, brake = self.mass(scene), self.data["brake"]
        load, torque, on_drum = self.drum_torque(mass, False), number(brake["torque"]), brake["shaft"] == "drum"
        asked = load if on_drum else load / self.ratio * self.back
        found = {
            "brake_torque_static": asked,
            "brake_reserve_static": torque / asked,
            "drop_distance": 0.0,
            "drop_speed": 0.0,
        }
        if torque >= asked:
            return found
        # motor: J1 a = T eta_r/u - M_b, drum: J2 a/u = M_L - T - M_b'
        a, _ = np.linalg.solve(
            [[self.rotors, -self.back / self.ratio], [self.behind(mass) / self.ratio, 1.0]],
            [0.0 if on_drum else -torque, load - (torque if on_drum else 0.0)],
        )
        hook = float(a) / self.ratio * self.radius(1) / self.of_each
        before = number(self.data["speed"]["main"]) if scene["type"] == "lower_brake" else 0.0
        return found | {"drop_distance": self.height, "drop_speed": math.sqrt(before**2 + 2 * hook * self.height)}

    # -- duty ------------------------------------------------------------------------------------------------

    def _duty(self, mass: float) -> dict[str, float]:
        duty, motor = self.data["duty"], self.data["motor"]
        counted = duty["type"] in ("S4", "S5")
        share = 1.0 if duty["type"] == "S1" else duty["factor"]
        on = share * 3600 / duty["starts_per_hour"] if counted else 1.0
        speed, field = self.drum_speed * self.ratio, number(motor["no_load_speed"])
        heat = 0.0
        for point in duty["load_spectrum"]:
            part = self.block + point["load"] * self.load
            even_up = self.drum_torque(part, True) / self.ratio / self.eta
            even_down = self.drum_torque(part, False) / self.ratio * self.back
            for even, rate in ((even_up, self.rising(part)), (even_down, self.sinking(part))):
                begin = (min(speed / rate, on) if rate > 0 else on) if counted else 0.0
                heat += point["share"] / 2 * (self.torque**2 * begin + even**2 * (on - begin)) / on
        rest = COOLING[motor["cooling"]]
        cooled, rated = ((ed + rest * (1 - ed)) / ed for ed in (share, motor["rated_duty"]))
        borne = self.motors * number(motor["rated_torque"]) * math.sqrt(cooled / rated)
        factor = sum(point["share"] * point["load"] ** 3 for point in duty["load_spectrum"])
        heavy = next(k for k, most in enumerate(SPECTRA) if factor <= most)

        def group(many: float, classes: tuple[float, ...]) -> float:
            return float(min(max(sum(many > most for most in classes) + heavy - 1, 1), 8))

        # heat of a start: the torque over the slip, w from rest to the speed of the field
        rate = self.rising(mass)
        found = {
            "start_heat": self.torque * field**2 / 2 / rate / self.motors if rate > 0 else math.inf,
            "torque_motor_rms": math.sqrt(heat),
            "heating_utilisation": math.sqrt(heat) / borne,
            "spectrum_factor": factor,
            "equivalent_load_share": factor ** (1 / 3),
            "crane_group": group(duty["cycles"], USE),
            "mechanism_group": group(number(duty["hours"]), HOURS),
        }
        return found | ({"starts_per_hour": float(duty["starts_per_hour"])} if counted else {})
