"""Rope proofs of random hoists by other means: pieces of rope followed through the lift, laws as products of powers.

`Ropes` reads the data of a design file whose values are in SI units; nothing of `ptmcalc` is used.
"""

import math
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np
from scipy.integrate import quad
from scipy.linalg import solve_banded

from support.hoist_statics import Statics
from support.travelling_statics import number, text

CORES = {("FC", 8): 1.0, ("FC", 6): 0.94, ("IWRC", 6): 0.81, ("PWRC", 8): 1.86, ("EFWRC", 6): 0.86}
PARTIAL = {"A": 1.34, "B": 1.22, "C": 1.1}
KEPT = {"socket": 1.0, "ferrule": 0.9, "wedge": 0.8}
BREAKS = {"FC-8x19": (18, 1.74e-4, 1550, 0.026), "WRC-8x36": (44.5, 2.22e-4, 2200, 0.0536)}


def random_life(rng: np.random.Generator) -> dict[str, Any]:
    """Constants, rope and use of a number of bendings, and its limits."""
    core, strands = list(CORES)[int(rng.integers(len(CORES)))]
    constants = {
        "b0": float(rng.uniform(0.8, 1.8)),
        "b1": float(rng.uniform(1.0, 1.5)),
        "b2": float(rng.uniform(7.5, 8.5)),
        "b3": float(rng.uniform(-4.0, -3.3)),
    }
    life: dict[str, Any] = {
        "source": "drawn by a number",
        "discarding": constants,
        "breaking": constants | {"b0": constants["b0"] + 0.5},
        "wire_strength": text(rng.uniform(1500e6, 2200e6), "Pa"),
        "core": core,
        "strands": strands,
        "force_factor": float(rng.uniform(1.0, 1.2)),
        "lifts_per_year": float(rng.uniform(1e3, 1e5)),
        "lifts": float(np.exp(rng.uniform(math.log(1e3), math.log(1e6)))),
        "years": float(rng.uniform(0.1, 20)),
        "wire_breaks": {"rope": str(rng.choice(list(BREAKS))), "count": float(rng.uniform(2, 20))},
        "donandt_force": text(np.exp(rng.uniform(math.log(5e3), math.log(5e5))), "N"),
    }
    if rng.random() < 0.5:
        life["bending_length"] = text(rng.uniform(0.1, 100), "m")
    if rng.random() < 0.4:
        life |= {"reverse_sheaves": int(rng.integers(1, 4)), "reversal": {"a1": 9.026, "a2": 0.618}}
    return life


def random_proof(rng: np.random.Generator) -> dict[str, Any]:
    """Data of a proof by EN 13001-3-2."""
    proof: dict[str, Any] = {
        "edition": "EN 13001-3-2:2014",
        "combination": str(rng.choice(list(PARTIAL))),
        "load_factor": float(rng.uniform(1, 1.6)),
        "risk_factor": float(rng.uniform(1, 1.2)),
        "termination": str(rng.choice(list(KEPT))),
        "fall_angle": text(rng.uniform(0, 0.3), "rad"),
        "acceleration_factor": float(rng.uniform(1, 1.1)),
        "ropes": float(rng.integers(1, 60)),
        "reverse_sheaves": int(rng.integers(0, 3)),
    }
    optional = {
        "fatigue_load_factor": float(rng.uniform(1, 1.4)),
        "partial_factor": float(rng.uniform(1, 1.5)),
        "static_resistance": float(rng.uniform(2, 3)),
        "fatigue_resistance": float(rng.uniform(5, 8)),
        "bendings": float(rng.integers(1, 20)),
        "reference_bendings": float(rng.uniform(1e5, 1e6)),
        "cycles": float(np.exp(rng.uniform(math.log(1e4), math.log(5e6)))),
        "factors": {"bending": float(rng.uniform(0.7, 1.2)), "layers": float(rng.uniform(0.5, 1))},
    }
    return proof | {name: value for name, value in optional.items() if rng.random() < 0.4}


def random_fleet(rng: np.random.Generator) -> dict[str, Any]:
    """Limits of the fleet angles."""
    fleet: dict[str, Any] = {
        "edition": "ISO 16625:2013",
        "lay": str(rng.choice(["ordinary", "lang"])),
        "strict": str(rng.choice(["yes", "no"])),
    }
    if rng.random() < 0.3:
        fleet |= {"limit": text(rng.uniform(0.01, 0.2), "rad"), "least": text(rng.uniform(0.001, 0.05), "rad")}
    return fleet


def random_shell(rng: np.random.Generator) -> dict[str, Any]:
    """Data of a drum shell with flanges."""
    shell: dict[str, Any] = {
        "yield_strength": text(np.exp(rng.uniform(math.log(1e8), math.log(9e8))), "Pa"),
        "safety": float(rng.uniform(1, 2)),
        "load_factor": float(rng.uniform(1, 1.6)),
        "modulus": text(rng.uniform(1e11, 2.2e11), "Pa"),
        "flange_thickness": text(np.exp(rng.uniform(math.log(0.002), math.log(0.06))), "m"),
        "flange_pressure": float(rng.uniform(0.2, 0.6)),
    }
    return shell | ({"span": text(rng.uniform(0.3, 4), "m")} if rng.random() < 0.5 else {})


@cache
def half_loaded() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Deflection w and curvature of a beam on an elastic foundation, loaded on x > 0, by finite differences.

    Fourth derivative of w + 4 w = 4 on x > 0: relative to the deflection far inside, lengths in units of 1/beta.
    """
    step = 0.01
    x = np.arange(-1200, 1201) * step
    bands = np.empty((5, x.size))
    for band, weight in zip(bands, (1, -4, 6, -4, 1), strict=True):
        band[:] = weight / step**4
    bands[2] += 4
    load = 4 * np.where(np.abs(x) < step / 2, 0.5, x > 0)
    load[-1] -= -4 / step**4 + 1 / step**4  # the deflection beyond the loaded end is 1
    load[-2] -= 1 / step**4
    w = solve_banded((2, 2), bands, load)
    curvature = np.gradient(np.gradient(w, step), step)
    keep = (x > 0) & (x < 8)
    return x[keep], w[keep], curvature[keep]


def random_holding(rng: np.random.Generator) -> dict[str, Any]:
    """A named rule of the holding torque."""
    holding: dict[str, Any] = {
        "rule": str(rng.choice(["cmaa_70", "osha_1910_179", "fem_1_001", "en_14492_2"])),
        "edition": "drawn by a number",
        "brakes": int(rng.integers(1, 3)),
        "control_braking": str(rng.choice(["mechanical", "other"])),
        "torque_loss": float(rng.uniform(0, 0.2)),
    }
    if rng.random() < 0.5:
        holding["load_torque"] = str(rng.choice(["hoisting", "without_losses", "holding"]))
    return holding


def followed(falls: int, deflections: int, lead: float, lowest: float, highest: float) -> set[tuple[int, int]]:
    """Numbers of sheaves passed and of windings on the drum of pieces of rope in a lift.

    Each piece is followed: at each height of the hook it is on a fall, on the lead or on the drum. A lead with
    deflection sheaves has them, for one piece at a time, where they bend it in any case: all at either end.
    """
    found = set()
    whole = falls * lowest + lead
    for place in np.linspace(0, whole, 20011)[1:-1]:
        before, after = (
            min(int(place / length), falls) if length > 0 else falls for length in (lowest, highest)
        )  # number of the fall, `falls` for the lead and what follows
        sheaves = min(after, falls - 1) - min(before, falls - 1)
        if falls * highest < place < whole:
            sheaves += deflections
        found.add((sheaves, int(place > falls * highest + lead)))
    return found


class Ropes(Statics):
    """The rope of a hoist with `rope_life` and `rope_proof`."""

    def bends(self) -> set[tuple[int, int]]:
        given = self.data["reeving"]
        lead = number(given["lead_length"])
        return followed(self.of_each, given["deflection_sheaves"], lead, self.least + self.height, self.least)

    def number(self, force: float, size: float, constants: dict[str, float]) -> float:
        """N = 10^b0 (D/d)^b2 f (S/d^2 (1770/R0)^0.4)^(b1 + b3 lg(D/d))."""
        life, d = self.data["rope_life"], self.d * 1e3
        bend = size / self.d + 1
        length = number(life["bending_length"]) if "bending_length" in life else self.of_each * self.height
        slender = max(length / self.d, 10)
        factor = 0.52 / ((d / 16) ** 0.3 - 0.48) * 1.49 / (2.49 - (57.5 / (slender - 2.5)) ** 0.14)
        factor *= CORES[life["core"], life["strands"]]
        stress = force / d**2 * (1770e6 / number(life["wire_strength"])) ** 0.4
        slope = constants["b1"] + constants["b3"] * math.log10(bend)
        return float(10 ** constants["b0"] * bend ** constants["b2"] * factor * stress**slope)

    def use(self, load: float) -> float:
        """Rope force in use [N]."""
        return self.pull(self.block + load, 0.0, True) * self.data["rope_life"]["force_factor"]

    def lifts(self, constants: dict[str, float]) -> float:
        """Of the piece of rope that endures least."""
        life, sheave = self.data["rope_life"], number(self.data["reeving"]["sheave_diameter"])
        loads = [(point["share"], self.use(point["load"] * self.load)) for point in self.data["duty"]["load_spectrum"]]
        loads.append((1.0, self.use(0.0)))
        on_drum = sum(share / self.number(force, self.barrel, constants) for share, force in loads)
        simple = sum(share / self.number(force, sheave, constants) for share, force in loads)
        reverse = sum(
            share / min(n := self.number(force, sheave, constants), 9.026 * n**0.618) for share, force in loads
        )
        other = life.get("reverse_sheaves", 0)
        return 1 / max(
            2 * (sheaves - min(other, sheaves)) * simple + 2 * min(other, sheaves) * reverse + drum * on_drum
            for sheaves, drum in self.bends()
        )

    def life(self) -> dict[str, float]:
        life, force = self.data["rope_life"], self.use(self.load)
        sheave, runs = number(self.data["reeving"]["sheave_diameter"]), max(one for one, _ in self.bends()) > 0
        small = (min(sheave, self.barrel) if runs else self.barrel) / self.d + 1
        g0, g1, g2, g3 = BREAKS[life["wire_breaks"]["rope"]]
        square = (g0 - g2 / small**2 - life["wire_breaks"]["count"]) / (g1 + g3 / small**2)
        stress = force / (self.d * 1e3) ** 2
        lifts = self.lifts(life["discarding"])
        found = {
            "rope_life_force": force,
            "bendings_drum": self.number(force, self.barrel, life["discarding"]),
            "rope_lifts_discard": lifts,
            "rope_lifts_break": self.lifts(life["breaking"]),
            "rope_life_years": lifts / life["lifts_per_year"],
            "rope_wire_breaks": max(g0 - g1 * stress**2 - (g2 + g3 * stress**2) / small**2, 0.0),
            "wire_break_force_ratio": stress / math.sqrt(square) if square > 0 else math.inf,
            "donandt_force_ratio": force / number(life["donandt_force"]),
        }
        return found | ({"bendings_sheave": self.number(force, sheave, life["discarding"])} if runs else {})

    def proof(self) -> dict[str, float]:
        """The rope of which the proof is used up: force over strength, and the cube of it by Palmgren and Miner."""
        proof = self.data["rope_proof"]
        rated = self.pull(self.block + self.load, 0.0, True)
        phi, kept = proof["load_factor"], KEPT[proof["termination"]] * number(self.data["rope"]["breaking_force"])
        sheave, runs = number(self.data["reeving"]["sheave_diameter"]), max(one for one, _ in self.bends()) > 0
        ratio = (min(sheave, self.barrel) if runs else self.barrel) / self.d + 1
        bent = proof.get("static_resistance", max(2.07, 1.35 + 5 / (math.exp(0.8 * math.log(ratio)) - 4)))
        tilted = proof["acceleration_factor"] / math.cos(number(proof["fall_angle"])) * proof["risk_factor"]
        static = rated * tilted * phi * proof.get("partial_factor", PARTIAL[proof["combination"]])
        acting = rated * tilted * proof.get("fatigue_load_factor", (1 + phi) / 2)
        factor = math.prod(proof.get("factors", {}).values())
        other = proof["reverse_sheaves"]
        bends = max(2 * sheaves + 2 * min(other, sheaves) + drum for sheaves, drum in self.bends())
        bends = proof.get("bendings", bends)
        reference, gamma = proof.get("reference_bendings", 5e5), proof.get("fatigue_resistance", 7.0)
        # at F_u f_f/gamma_rf the rope endures w_D bendings, at other forces w_D (ratio)^-3
        cycle = sum(
            point["share"] * (self.pull(self.block + point["load"] * self.load, 0.0, True) / rated) ** 3
            for point in self.data["duty"]["load_spectrum"]
        )
        damage = bends * cycle * (acting * gamma / (kept * factor)) ** 3 / reference
        turned = damage * proof.get("cycles", self.data["duty"]["cycles"]) / proof["ropes"]
        parameter = turned / (acting * gamma / (kept * factor)) ** 3
        return {
            "rope_static_force": static,
            "rope_static_resistance": kept / bent,
            "rope_static_utilisation": static * bent / kept,
            "rope_fatigue_force": acting,
            "rope_fatigue_resistance": acting / turned ** (1 / 3),
            "rope_fatigue_utilisation": turned ** (1 / 3),
            "rope_force_history": parameter,
            "rope_design_lifts": 1 / damage,
        }

    def fleet(self) -> dict[str, float]:
        """Angles between the rope and the normal of the drum, from places along it; the middle of the travel is 0."""
        given = self.data["reeving"]
        turns, layers = self.wound(self.height)
        lead, sheave = number(given["lead_length"]), number(given["lead_offset"])

        def angle(place: float, height: float) -> float:
            far = lead if lead > 0 else self.least + self.height - height
            return math.asin((place - sheave) / math.hypot(place - sheave, far))

        end = (turns - self.dead) * self.pitch / 2 if layers == 1 else number(self.data["drum"]["length"]) / 2
        if layers == 1:
            ends = (end,) if lead == 0 else (end, -end)
            return {"fleet_angle_top": max(abs(angle(place, self.height)) for place in ends)}
        ends = (end + self.pitch / 2, -end - self.pitch / 2)
        # the rope reaches the end of the last wraps (+) first; there it must be drawn back, towards the sheave
        changes = [(end, 1.0) if change % 2 == 0 else (-end, -1.0) for change in range(layers - 1)]
        return {
            "fleet_angle_top": max(abs(angle(place, self.height)) for place in ends),
            "fleet_angle_least": min(
                side * angle(place, height) for (place, side), height in zip(changes, self.begins()[1:], strict=True)
            ),
        }

    def shell(self) -> dict[str, float]:
        """Layers wound one after another on springs, a beam on an elastic foundation, and sectors of the flange."""
        data, drum = self.data, self.data["drum"]
        given, t, layers = drum["shell"], number(drum["shell_thickness"]), self.wound(self.height)[1]
        modulus = number(given["modulus"])
        pull = given["load_factor"] * self.pull(self.block + self.load, 0.0, True)
        pulls, after_each = self.wind(layers, pull, modulus * t * self.pitch)
        factor = data["checks"].get("layer_factor", after_each[-1])
        radius = (self.barrel - t) / 2
        hoop = pull / self.pitch / t
        beta = (3 * (1 - 0.09) / radius**2 / t**2) ** 0.25
        line = pull / radius  # of one wrap, per length of the circumference
        plate = modulus * t**3 / 12 / (1 - 0.09)
        bend, sunk = 6 * line / 4 / beta / t**2, line / (8 * beta**3 * plate) * modulus / radius
        span = number(given["span"]) if "span" in given else self.ropes * number(drum["length"])
        second = math.pi * radius**3 * t
        beam = self.ropes * pull * span / 4 * radius / second
        twist = self.ropes * pull * self.radius(layers) * radius / (2 * second)
        push, moment = self.flange(layers, [factor * one / after_each[-1] for one in after_each], pull)
        _, deflection, curvature = half_loaded()
        # stresses at the faces from strains: s = E/(1 - nu^2) z w_xx and hoop E w/R + nu s
        scale = factor * hoop * radius / modulus
        faces = [
            (scale * curvature * beta**2 * modulus / (1 - 0.09) * t / 2, -factor * hoop * deflection),
            (np.array([bend]), np.array([-sunk])),
            (np.array([0.0]), np.array([-factor * hoop])),
        ]
        along = [sign * beam + thrust for sign in (1, -1) for thrust in (0, push / t)]
        return {
            "shell_layer_factor": factor,
            "shell_hoop_stress": factor * hoop,
            "shell_pull_left": pulls[0] / pull,
            "shell_edge_bending": float(np.abs(faces[0][0]).max()),
            "shell_wrap_bending": bend,
            "shell_wrap_bending_handbook": 0.96 * pull / math.sqrt(2 * radius * t) / t,
            "shell_wrap_hoop_handbook": 0.85 * pull / self.pitch / t,
            "shell_beam_bending": beam,
            "shell_torsion": twist,
            "flange_thrust_stress": push / t,
            "shell_equivalent_stress": max(
                worst(one, axial, around, twist) for one in along for axial, around in faces
            ),
            "flange_stress": 6 * moment / number(given["flange_thickness"]) ** 2,
        }

    def holding(self) -> dict[str, float]:
        """Power of the load at the shaft of the brake, with losses against it, without them, or with it."""
        given = self.data["brake"]
        rule, on_motor = given["holding"], given["shaft"] == "motor"
        usual = "hoisting" if rule["rule"] in ("cmaa_70", "osha_1910_179") else "without_losses"
        which = rule.get("load_torque", usual)
        turns, gear = (self.ratio, (self.eta, self.back)) if on_motor else (1.0, (1.0, 1.0))
        if which == "hoisting":
            power = self.drum_torque(self.block + self.load, True) / gear[0]
        elif which == "holding":
            power = self.drum_torque(self.block + self.load, False) * gear[1]
        else:
            free = Ropes(self.data | {"reeving": self.data["reeving"] | {"sheave_efficiency": 1.0}})
            power = free.drum_torque(self.block + self.load, True)
        one = number(given["torque"]) / rule["brakes"] * (1 - rule["torque_loss"])
        return {"holding_load_torque": power / turns, "holding_torque_ratio": one * turns / power}

    def wind(self, layers: int, pull: float, shell: float) -> tuple[list[float], list[float]]:
        """Pulls of the layers in the end, and the force on the shell after each layer relative to the pull."""
        rope = number(self.data["rope"]["modulus"]) * number(self.data["rope"]["area"])
        on_shell, pulls, after_each = 0.0, [], []
        for _ in range(layers):
            shrink = pull / (shell + rope * len(pulls))  # strain of shell and lower layers under the new layer
            on_shell += shell * shrink
            pulls = [*(one - rope * shrink for one in pulls), pull]
            after_each.append(on_shell / pull)
        return pulls, after_each

    def flange(self, layers: int, factors: list[float], pull: float) -> tuple[float, float]:
        """Thrust and moment of a sector of the flange at the shell, per length of its circumference."""
        if layers == 1:
            return 0.0, 0.0
        inside = self.barrel / 2
        edges = [inside + k * self.step(self.nested) for k in range(layers)]
        edges.append(edges[-1] + self.d)
        push = moment = 0.0
        for factor, (low, high) in zip(reversed(factors), pairwise(edges), strict=True):
            pressure = self.data["drum"]["shell"]["flange_pressure"] * factor * pull / self.pitch / inside
            push += quad(lambda r, q=pressure: q * r, low, high)[0] / inside
            moment += quad(lambda r, q=pressure: q * r * (r - inside), low, high)[0] / inside
        return push, moment


def worst(along: float, axial: np.ndarray, around: np.ndarray, twist: float) -> float:
    """Largest equivalent stress of both faces, from principal stresses."""
    found = 0.0
    for side in (1, -1):
        x, y = along + side * axial, around + side * 0.3 * axial
        stress = np.array([[x, twist + 0 * x], [twist + 0 * x, y]])
        one, two = np.linalg.eigvalsh(np.moveaxis(stress, -1, 0)).T
        found = max(found, float(np.sqrt((one**2 + two**2 + (one - two) ** 2) / 2).max()))
    return found
