"""Starts, stops and speed ranges of chains nobody would build: nothing breaks, nothing is silently NaN."""

import math
from typing import Any

import pytest
from support.chain_starts import KIND, built, scraper

from ptmcalc.base.errors import NumericsError
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, ChainScene

SCENES: list[dict[str, Any]] = [
    {"type": "start"},
    {"type": "start", "name": "soft", "profile": {"shape": "cosine", "time": "1 s"}},
    {"type": "emergency_stop"},
    {"type": "coast"},
    {"type": "backstop"},
    {"type": "speed_range", "from": "0.3 m/s", "to": "0.4 m/s", "time": "2 s"},
]
ABSURD: dict[str, dict[str, Any]] = {
    "a motor of a mountain": {"drive": {"motor": {"inertia": "1 kg*m^2", "mean_starting_torque": "1e9 N*m"},
                                        "coupling_inertia": "0 kg*m^2", "gear": {"ratio": 42, "efficiency": 0.9}}},
    "a motor of a watch": {"drive": {"motor": {"inertia": "1e-9 kg*m^2", "mean_starting_torque": "1e-6 N*m"},
                                     "coupling_inertia": "0 kg*m^2", "gear": {"ratio": 42, "efficiency": 0.9}}},
    "a rotor like a planet": {"drive": {"motor": {"inertia": "1e9 kg*m^2", "mean_starting_torque": "400 N*m"},
                                        "coupling_inertia": "0 kg*m^2", "gear": {"ratio": 42, "efficiency": 0.9}}},
    "a rotor like a feather": {"drive": {"motor": {"inertia": "1e-9 kg*m^2", "mean_starting_torque": "400 N*m"},
                                         "coupling_inertia": "0 kg*m^2", "gear": {"ratio": 42, "efficiency": 0.9}},
                               "sprocket": {"teeth": 8, "inertia": "1e-9 kg*m^2"}},
    "a chain of rubber": {"chain": {"stiffness": "10 N"}},
    "a chain of diamond": {"chain": {"stiffness": "1e15 N"}},
    "no damping at all": {"chain": {"damping": {"ratio": 0}}},
    "critical damping": {"chain": {"damping": {"ratio": 1}}},
    "a conveyor of a thousand kilometres": {"layout": {"length": "1000 km"}},
    "a conveyor of an arm": {"layout": {"length": "0.6 m", "lift": "0 m"}},
    "straight down": {"layout": {"lift": "-40 m"}},
    "straight up": {"layout": {"lift": "40 m"}},
    "a brake like a wall": {"brake": {"torque": "1e9 N*m"}},
    "a brake like a breath": {"brake": {"torque": "1e-9 N*m", "delay": "100 s", "rise_time": "100 s"}},
    "no take-up to speak of": {"layout": {"takeup": {"type": "screw", "tension": "1 N"}}},
    "a flywheel at the tail": {"layout": {"tail": {"teeth": 8, "inertia": "1e9 kg*m^2"}}},
}  # fmt: skip


def changed(name: str) -> dict[str, Any]:
    data = scraper(brake={"torque": "100 N*m"}, backstop={"torque": "5 kN*m"}, scenes=SCENES)
    for key, value in ABSURD[name].items():
        data[key] = {**data[key], **value} if key in data and key != "brake" else value
    return data


def runs(spec: ChainDrive, scene: ChainScene) -> int:
    """Every cheap solver of a scene; how many loads they gave."""
    count = 0
    for solver in KIND.solvers:
        if not solver.usable_for(spec, scene) or not solver.cost(spec, scene, solver.always, 0) < 2.0:
            continue
        try:
            result = solver.run(spec, scene, solver.always, 0)
        except NumericsError:  # it says why: the engine makes a finding of it
            continue
        for name, found in result.loads.items():
            estimate = found.estimate
            assert not math.isnan(estimate.value), (solver.name, name)
            assert estimate.low <= estimate.high, (solver.name, name)
            count += 1
    for effect in KIND.effects:
        if effect.applies_to(scene):
            criterion = effect.criterion(spec, scene)
            assert criterion is None or not math.isnan(criterion.value), effect.name
    return count


@pytest.mark.parametrize("name", ABSURD)
def test_nothing_breaks(name: str) -> None:
    spec = built(changed(name))
    assert sum(runs(spec, scene) for scene in spec.all_scenes) >= 8
