"""Times of starts and stops by momentum: their bar holds the column in modes, on random machines."""

import math
from functools import cache
from typing import Any

import numpy as np
import pytest
from support.machines import loaded

from ptmcalc.machines.crane.stacking.machine.scenes import Brake, Start
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.mast.modal import MAST_MODAL
from ptmcalc.machines.crane.stacking.mechanisms import starts

COUNT = 12
WORDS = ("trolley", "travel", "bridge")


def _machine(seed: int) -> dict[str, Any]:
    """A stacker whose column is soft and heavy beside what carries it; every third one stands."""
    rng = np.random.default_rng([20261122, seed])
    length = float(rng.uniform(4, 9))
    climbing = 10 ** float(rng.uniform(2.5, 3.7))
    force = 10 ** float(rng.uniform(3, 4))
    data: dict[str, Any] = {
        "kind": "crane",
        "load": f"{climbing:.6g} kg",
        "column": {
            "length": f"{length:.6g} m",
            "mass": f"{10 ** rng.uniform(2.3, 3.5):.6g} kg",
            "second_moment": f"{10 ** rng.uniform(3.7, 4.6):.6g} cm^4",
        },
        "carriage": {"mass": "300 kg", "rollers": {"distance": "1 m", "diameter": "160 mm", "axle_diameter": "50 mm"}},
        "hoisting": {"speed": "0.2 m/s", "acceleration": "0.3 m/s^2", "rope": {"falls": 2}},
    }
    travel = {"speed": f"{rng.uniform(0.4, 1.5):.6g} m/s", "driving_force": f"{force:.6g} N"}
    travel["braking_force"] = f"{force * rng.uniform(0.5, 2):.6g} N"
    for key in ("driving_rise", "braking_rise"):
        travel[key] = f"{rng.choice([0.0, rng.uniform(0, 1)]):.6g} s"
    if seed % 3 == 1:
        base = {"mass": f"{10 ** rng.uniform(3, 4):.6g} kg", "wheel_base": "4 m", "wheel_diameter": "400 mm"}
        return data | {"type": "rack_stacker", "base": base, "travel": travel}
    bridge = {"mass": "6 t", "span": "14 m", "girder_vertical": "90000 cm^4", "girder_horizontal": "15000 cm^4"}
    trolley = {"mass": f"{10 ** rng.uniform(2.8, 3.8):.6g} kg", "gauge": "2 m"}
    moves = f"{WORDS[seed % 3]}_travel"
    return data | {"type": "overhead_stacker", "bridge": bridge, "trolley": trolley, moves: travel}


@cache
def _shares(seed: int) -> tuple[float, ...]:
    """How far the time of the modes is from that by momentum, over the bar on its side: of a start and of a stop."""
    spec = loaded(_machine(seed)).spec
    assert isinstance(spec, Stacker)
    word = WORDS[seed % 3]
    shares = []
    for scene, name in ((Start(mechanism=word), "start_time"), (Brake(mechanism=word), "brake_time")):
        told = starts.time(spec, scene)
        found = MAST_MODAL.run(spec, scene, MAST_MODAL.represents, 0).loads[name].estimate
        off = found.value - told.value
        bar = told.high - told.value if off > 0 else told.value - told.low
        assert math.isfinite(found.value)
        assert abs(off) <= bar + found.bar + 1e-9, (seed, name, told, found)
        shares.append(abs(off) / bar)
    return tuple(shares)


@pytest.mark.parametrize("seed", range(COUNT))
def test_the_time_lies_in_its_bar(seed: int) -> None:
    assert len(_shares(seed)) == 2


def test_a_third_of_the_bar_would_not_hold() -> None:
    assert max(max(_shares(seed)) for seed in range(COUNT)) > 1 / 3
