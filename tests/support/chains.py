"""Chain drives for tests, and the same machines as finite elements."""

import math
from typing import Any

import numpy as np

from ptmcalc.machines.chain_drive.machine.spec import ChainDrive
from support import chain_fem
from support.machines import loaded

CH_05: dict[str, Any] = {
    "kind": "chain_drive",
    "layout": {
        "type": "conveyor",
        "length": "40 m",
        "load": "120 kg/m",
        "resistance": {"coefficient": 0.1, "turn_factor": 1},
        "takeup": {"type": "gravity", "tension": "20 kN"},
        "tail": {"teeth": 8},
    },
    "chain": {
        "pitch": "320 mm",
        "mass": "80 kg/m",
        "breaking_load": "1300 kN",
        "section": "1600 mm^2",
        "modulus": "206 GPa",
        "damping": {"ratio": 0.05},
    },
    "sprocket": {"teeth": 8},
    "speed": "0.5 m/s",
    "scenes": [{"type": "run"}],
}
"""The conveyor of the worked cases CH-02 to CH-05: 200 kg/m on the working strand, 80 on the return strand."""

FIRST = 1.78187
"""Its resonance speed of the first mode by the worked case, m/s: 5.56835 Hz times 320 mm."""

ROLLER: dict[str, Any] = {
    "kind": "chain_drive",
    "layout": {
        "type": "drive",
        "driven": {"teeth": 57, "inertia": "6 kg*m^2"},
        "centre_distance": "1 m",
        "power": "9 kW",
        "service_factor": 1.4,
    },
    "chain": {
        "pitch": "25.4 mm",
        "mass": "5.4 kg/m",
        "count": 2,
        "unevenness": 1.15,
        "breaking_load": "53 kN",
        "stiffness": "5.5 MN",
        "damping": {"law": "hysteretic", "ratio": 0.04},
    },
    "sprocket": {"teeth": 19, "inertia": "0.02 kg*m^2"},
    "speed": "1 m/s",
    "scenes": [{"type": "run"}],
}
"""A roller chain between two shafts."""

MOTOR: dict[str, Any] = {
    "motor": {"inertia": "0.12 kg*m^2", "mean_starting_torque": "200 N*m"},
    "coupling_inertia": "0.03 kg*m^2",
    "gear": {"ratio": 42.4, "efficiency": 0.93},
}


def chain_of(data: dict[str, Any]) -> ChainDrive:
    """The filled-in spec of a chain drive."""
    spec = loaded(data).spec
    assert isinstance(spec, ChainDrive)
    return spec


def number(text: Any) -> float:
    """SI value of a text in kg, m, s, N and their usual multiples."""
    if not isinstance(text, str):
        return float(text)
    value, _, unit = text.partition(" ")
    factors = {"mm": 1e-3, "kN": 1e3, "MN": 1e6, "GPa": 1e9, "mm^2": 1e-6, "kW": 1e3, "ms": 1e-3}
    return float(value) * factors.get(unit, 1.0)


class Reference:
    """A conveyor with a constant tension at its run-off and Kelvin-Voigt damping, from its file alone: finite elements
    between two engagements in closed form, which know neither Fourier series nor complex moduli."""

    def __init__(self, data: dict[str, Any], pieces: int = 150) -> None:
        layout, chain = data["layout"], data["chain"]
        self.pieces = pieces
        count = chain.get("count", 1)
        if "stiffness" in chain:
            stiffness = count * number(chain["stiffness"])
        else:
            stiffness = count * number(chain["section"]) * number(chain["modulus"])
        length, own = number(layout["length"]), number(chain["mass"])
        self.own, self.load = own, number(layout["load"])
        tail = layout.get("tail", {})
        arm = tail.get("teeth", data["sprocket"]["teeth"]) * number(chain["pitch"]) / (2 * math.pi)
        strands = (chain_fem.Strand(length, own + self.load, stiffness), chain_fem.Strand(length, own, stiffness))
        self.chain = chain_fem.Chain(strands, joint_mass=number(tail.get("inertia", 0.0)) / arm**2)
        self.first = float(chain_fem.modes(self.chain, pieces)[0][0])
        self.retardation = 2 * chain["damping"]["ratio"] / self.first
        self.sprocket = chain_fem.Sprocket(number(chain["pitch"]), data["sprocket"]["teeth"], number(data["speed"]))
        self.mass = length * (2 * own + self.load)

    @property
    def force(self) -> np.ndarray:
        """Dynamic tension at the run-on over one pitch [N]."""
        places = np.concatenate([np.linspace(0.0, 1.0, 4001), [1 - 1e-9]])
        return chain_fem.periodic_force(self.chain, self.sprocket, self.retardation, places, self.pieces)
