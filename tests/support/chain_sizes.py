"""Chains drawn by a number, and what levers, lengths and the wear of their joints come to.

`Sizes` reads the data of a design file whose values are in SI units, and works everything out again: nothing of
`ptmcalc` is used.
"""

import math
from typing import Any

import numpy as np

from support.travelling_statics import G, number, text

ROWS = {1: 1.0, 2: 1.7, 3: 2.5}
"""Capacity of rows of roller chain (ACA)."""


def random_sizes(rng: np.random.Generator) -> dict[str, Any]:
    """A conveyor, or a drive between two shafts, with all that the choice of its chain is checked for."""

    def even(low: float, high: float) -> float:
        return float(rng.uniform(low, high))

    def spread(low: float, high: float) -> float:
        return float(np.exp(rng.uniform(math.log(low), math.log(high))))

    conveyor = bool(rng.random() < 0.5)
    count, teeth = int(rng.integers(1, 4)), int(rng.integers(6, 15) if conveyor else rng.integers(15, 30))
    pitch, mass = spread(0.1, 0.3) if conveyor else spread(0.0127, 0.05), spread(8, 60) if conveyor else spread(1, 8)
    speed = even(0.2, 1.0) if conveyor else even(0.5, 6.0)
    chain: dict[str, Any] = {
        "pitch": text(pitch, "m"),
        "mass": text(mass, "kg/m"),
        "count": count,
        "stiffness": text(spread(5e6, 1e8), "N"),
        "pin_diameter": text(pitch * even(0.1, 0.3), "m"),
        **({"unevenness": even(1.0, 1.4)} if count > 1 else {}),
    }
    data: dict[str, Any] = {
        "kind": "chain_drive",
        "chain": chain,
        "sprocket": {"teeth": teeth, "inertia": text(even(0.1, 20), "kg*m^2")},
        "speed": text(speed, "m/s"),
        "wear": {
            "coefficient": text(spread(1e-12, 1e-10), "Hz/N"),
            "elongation": even(0.02, 0.05),
            "tensions": str(rng.choice(["sum", "mean"])),
        },
        "equalising": {},
        "checks": {"life": text(spread(1e6, 1e9), "s"), "safety_static": 8.0},
        "scenes": [{"type": "run"}],
    }
    if conveyor:
        length, load, rubs = even(8, 80), mass * even(0.2, 4), even(0.05, 0.35)
        pull = G * length * (2 * mass + load) * rubs
        data["layout"] = {
            "type": "conveyor",
            "length": text(length, "m"),
            "lift": text(even(-0.05, 0.3) * length, "m"),
            "load": text(load, "kg/m"),
            "resistance": {
                "coefficient": rubs,
                "load_coefficient": even(0.1, 0.6),
                "turn_factor": even(1, 1.3),
                "force": text(even(0, 0.1) * pull, "N"),
            },
            "takeup": {"type": str(rng.choice(["gravity", "screw"])), "tension": text(even(0.5, 3) * pull, "N")},
            "tail": {"teeth": int(rng.integers(6, 15)), "inertia": text(even(1, 20), "kg*m^2")},
        }
    else:
        pull, driven = spread(1e3, 2e4), int(rng.integers(15, 80))
        arm = driven * pitch / 2 / math.pi
        place = {"centre_distance": text(even(25, 90) * pitch, "m")}
        if rng.random() < 0.4:
            place = {"pitches": 2 * int(rng.integers(60, 110))}
        data["layout"] = {
            "type": "drive",
            "driven": {"teeth": driven, "inertia": text(even(0.1, 20), "kg*m^2")},
            **place,
            "torque": text(pull * arm, "N*m"),
            "slack_sag": even(0.01, 0.03),
            "service_factor": even(1, 2),
            "tooth_exponent": even(1, 1.1),
            "rated_power": text(pull * speed * even(0.5, 3), "W"),
        }
    chain["breaking_load"] = text(pull * even(4, 20) / count, "N")
    return data


class Sizes:
    """A chain of such a file."""

    def __init__(self, data: dict[str, Any]) -> None:
        self.data, chain = data, data["chain"]
        self.pitch, self.mass, self.speed = number(chain["pitch"]), number(chain["mass"]), number(data["speed"])
        self.count, self.uneven = chain["count"], chain.get("unevenness", 1.0)
        self.one = data["sprocket"]["teeth"]
        layout = data["layout"]
        self.conveyor = layout["type"] == "conveyor"
        self.other = layout["tail" if self.conveyor else "driven"]["teeth"]

    def run(self) -> dict[str, float]:
        layout, small, large = self.data["layout"], min(self.one, self.other), max(self.one, self.other)
        half = math.pi / self.one
        radius, blow = self.pitch / 2 / math.sin(half), 2 * half * self.speed
        found = {
            "chain_speed": self.speed,
            "teeth_least": float(small),
            "ratio": large / small,
            "engagement_speed": blow,
            "engagement_energy": self.mass * self.pitch * blow**2 / 2,
            "equalising_ratio": 1 / math.cos(half),
            "tooth_passes": number(self.data["checks"]["life"]) * self.speed / self.pitch,
            # w = V/(R cos phi): dw/dt = w^2 tan phi, largest where a tooth takes over
            "equalising_torque": number(self.data["sprocket"]["inertia"])
            * (self.speed / radius / math.cos(half)) ** 2
            * math.tan(half),
        }
        if self.conveyor:
            length = number(layout["length"])
            links, ends = 2 * length / self.pitch + (small + large) / 2, self._of_conveyor(layout, length)
            found |= {"wrap": math.pi, "centre_distance": length}
        else:
            length, links, fitted, ends, wrap, power = self._of_drive(layout, small, large)
            found |= {"wrap": wrap, "centre_distance": length, "centre_distance_fitted": fitted, "design_power": power}
        found |= {"pitches": links, "centre_distance_pitches": found["centre_distance"] / self.pitch}
        return found | self._strength(ends, links)

    def _of_conveyor(self, layout: dict[str, Any], length: float) -> tuple[float, float, float, float]:
        """Tensions from the run-off on: drive, tail, tail, drive [N]."""
        given, lift = layout["resistance"], number(layout["lift"])
        load, flat = number(layout["load"]), math.cos(math.asin(lift / length)) * length
        drag = given["turn_factor"] * given["coefficient"] * self.mass * G * flat
        back = drag - self.mass * G * lift
        on = drag + given["turn_factor"] * given["load_coefficient"] * load * G * flat + (self.mass + load) * G * lift
        steps = np.array([0.0, back, back + number(given["force"]), back + number(given["force"]) + on])
        tension = number(layout["takeup"]["tension"])
        if layout["takeup"]["type"] == "screw":  # the mean over both strands stays
            tension -= (steps[0] + steps[1] + steps[2] + steps[3]) / 4
        return tuple((tension + steps).tolist())  # type: ignore[return-value]

    def _of_drive(
        self, layout: dict[str, Any], small: int, large: int
    ) -> tuple[float, float, float, tuple[float, float, float, float], float, float]:
        more = ((large - small) / 2 / math.pi) ** 2
        if "pitches" in layout:
            links = float(layout["pitches"])
        else:
            over = number(layout["centre_distance"]) / self.pitch
            links = 2 * math.ceil((2 * over + (small + large) / 2 + more / over) / 2)
        # the distance at which that many pitches lie round both: 2 c + z + d^2/c = X
        c = max(np.roots([2.0, (small + large) / 2 - links, more]).real)
        fitted = float(c) * self.pitch
        distance = number(layout["centre_distance"]) if "centre_distance" in layout else fitted
        radii = [self.pitch / 2 / math.sin(math.pi / z) for z in (small, large)]
        lean = math.asin((radii[1] - radii[0]) / distance)
        slack = self.mass * G * distance * math.cos(lean) / 8 / layout["slack_sag"]
        pull = number(layout["torque"]) / (self.other * self.pitch / 2 / math.pi)
        tooth = (19 / small) ** layout["tooth_exponent"]
        power = pull * self.speed * layout["service_factor"] * tooth / ROWS[self.count]
        return distance, links, fitted, (slack, slack, slack + pull, slack + pull), math.pi - 2 * lean, power

    def _strength(self, ends: tuple[float, float, float, float], links: float) -> dict[str, float]:
        """Safety at rest; every joint bends twice at either sprocket, by a pitch under the tension there."""
        lifted, wear = self.mass * self.speed**2, self.data["wear"]
        most = max(max(ends) + lifted, 0.0) * self.uneven / self.count
        breaking, pin = number(self.data["chain"]["breaking_load"]), number(self.data["chain"]["pin_diameter"])
        off, tail_in, tail_out, on = (max(end + lifted, 0.0) * self.uneven / self.count for end in ends)
        rubbed = (on + off) * pin / 2 * 2 * math.pi / self.one + (
            tail_in + tail_out
        ) * pin / 2 * 2 * math.pi / self.other
        grows = rubbed * number(wear["coefficient"]) * self.pitch / self.speed
        grows /= 2 if wear["tensions"] == "mean" else 1
        revolution = links * self.pitch / self.speed
        return {
            "safety_static": breaking / most if most else math.inf,
            "wear_per_revolution": grows,
            "life": wear["elongation"] * self.pitch / grows * revolution if grows else math.inf,
        }
