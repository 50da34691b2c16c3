"""Stresses and stability of stacker cranes by hand, and that what follows from bars holds all that is within them."""

import itertools
import math
from typing import Any

import numpy as np
import pytest
from support.machines import changed, loaded

from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.contract.result import Found
from ptmcalc.machines.crane.stacking.machine.scenes import Brake, ObstacleScene, SafetyGearScene, Stand
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.strength.derived import bounds_of_derived, derived, with_derived

G = 9.81
OVERHEAD: dict[str, Any] = {
    "kind": "crane",
    "type": "overhead_stacker",
    "load": "1 t",
    "bridge": {
        "mass": "6 t",
        "span": "16 m",
        "girder_vertical": "120000 cm^4",
        "girder_horizontal": "16000 cm^4",
        "section_modulus_vertical": "3400 cm^3",
        "section_modulus_horizontal": "1300 cm^3",
    },
    "trolley": {"mass": "4 t", "gauge": "2 m", "position": "4 m"},
    "column": {
        "length": "6 m",
        "mass": "1200 kg",
        "second_moment": "20000 cm^4",
        "section_modulus": "1300 cm^3",
        "area": "160 cm^2",
    },
    "carriage": {
        "mass": "600 kg",
        "load_arm": "0.9 m",
        "load_arm_across": "-0.5 m",
        "rollers": {"distance": "1.2 m", "diameter": "160 mm", "axle_diameter": "50 mm"},
    },
    "hoisting": {"speed": "0.2 m/s", "acceleration": "0.3 m/s^2", "rope": {"falls": 2}},
    "bridge_travel": {"speed": "1 m/s", "deceleration": "0.5 m/s^2"},
    "trolley_travel": {"speed": "1 m/s", "braking_force": "2 kN"},
    "obstacle": {"stiffness": "8 MN/m"},
}
RACK: dict[str, Any] = {
    "kind": "crane",
    "type": "rack_stacker",
    "load": "1 t",
    "base": {"mass": "2 t", "wheel_base": "4 m", "wheel_diameter": "400 mm", "column": "1.5 m", "height": "0.4 m"},
    "column": OVERHEAD["column"] | {"foot": "0.5 m", "count": 2},
    "carriage": OVERHEAD["carriage"],
    "hoisting": OVERHEAD["hoisting"],
    "travel": {"speed": "1 m/s", "deceleration": "0.5 m/s^2"},
    "safety_gear": {"type": "progressive", "force": "40 kN", "stroke": "1 m", "arm": "0.2 m"},
}


def _spec(data: dict[str, Any]) -> Stacker:
    spec = loaded(data).spec
    assert isinstance(spec, Stacker)
    return spec


class TestByHand:
    def test_weights_on_a_bridge(self) -> None:
        """A quarter of the span: 4 m and 12 m to the ends. One girder takes half of all that hangs, the couple of the
        leaning load over the gauge, its own weight, and half of the moment along it."""
        found = derived(_spec(OVERHEAD), Stand(), {"total_weight": 1.0})
        hung, sag = (4000 + 1200 + 1600) * G, 4 * 12 / 16
        moment = (hung / 2 + 900 * G / 2.0) * sag + 3000 * G / 16 * 4 * 12 / 2 + 500 * G / 2 * 12 / 16
        assert found["bridge_stress"] == pytest.approx(moment / 3400e-6, rel=1e-12)
        column = (900 + 500) * G / 1300e-6 + 1200 * G / 160e-4
        assert found["column_stress"] == pytest.approx(column, rel=1e-12)

    def test_a_bridge_that_brakes_on_a_ramp(self) -> None:
        """The moment of the column goes to the girders as a couple; all that hangs pushes them sideways."""
        spec, scene = _spec(OVERHEAD), Brake(mechanism="bridge")
        still = derived(spec, scene, {"mast_moment_max": 0.0, "mast_force_max": 0.0})
        found = derived(spec, scene, {"mast_moment_max": 6e3, "mast_force_max": 0.0})
        assert found["bridge_stress"] - still["bridge_stress"] == pytest.approx(6e3 / 2 * 3 / 3400e-6, rel=1e-9)
        assert found["column_stress"] - still["column_stress"] == pytest.approx(6e3 / 1300e-6, rel=1e-9)
        standing = derived(spec, Stand(), {"total_weight": 1.0})["bridge_stress"]
        sideways = (4000 * 0.5 / 2 + 3000 * 0.5 / 2) * 3 / 1300e-6
        assert still["bridge_stress"] - standing == pytest.approx(sideways, rel=1e-9)

    def test_a_trolley_that_brakes_bends_the_girders_down_alone(self) -> None:
        spec, scene = _spec(OVERHEAD), Brake(mechanism="trolley")
        still = derived(spec, scene, {"mast_moment_max": 0.0, "mast_force_max": 1e3})
        found = derived(spec, scene, {"mast_moment_max": 6e3, "mast_force_max": 1e3})
        assert found["bridge_stress"] - still["bridge_stress"] == pytest.approx(3e3 * 12 / 16 / 3400e-6, rel=1e-9)

    def test_a_machine_that_brakes_on_its_wheels(self) -> None:
        """The front wheel is 2.5 m from the column, the rear one 1.5 m; the load leans to the front."""
        spec, scene = _spec(RACK), Brake()
        found = derived(spec, scene, {"mast_moment_max": 8e3, "mast_force_max": 0.0})
        dynamic = 8e3 + 2000 * 0.5 * 0.4
        front = (2000 * 2.0 + (1200 + 1600) * 2.5) * G / (900 * G + dynamic)
        rear = (2000 * 2.0 + (1200 + 1600) * 1.5) * G / dynamic
        assert found["stability_reserve[along]"] == pytest.approx(min(front, rear), rel=1e-12)
        assert "stability_reserve[across]" not in found

    def test_two_rails_and_a_guide_hold_across(self) -> None:
        held = changed(RACK, base__gauge="600 mm", column__top_guide={"rating": "2 kN"})
        found = derived(_spec(held), Stand(), {"total_weight": 1.0})
        by_hand = (4800 * G * 0.3 + 2e3 * 6.5) / (500 * G)
        assert found["stability_reserve[across]"] == pytest.approx(by_hand, rel=1e-12)
        assert found["stability_reserve"] == min(found["stability_reserve[across]"], found["stability_reserve[along]"])

    def test_a_safety_gear_stops_what_leans(self) -> None:
        """40 kN are 2.55 weights: the load leans with as much more; two masts share."""
        found = derived(_spec(RACK), SafetyGearScene(), {"safety_gear_force": 40e3})
        times = 40e3 / (1600 * G)
        bending = times * (900 + 500) * G / 1300e-6 / 2
        assert found["column_stress"] == pytest.approx(bending + (1200 * G + 40e3) / 160e-4 / 2, rel=1e-12)


LOADS = {"mast_moment_max": 8e3, "mast_force_max": 1.2e3}


class TestBars:
    @pytest.mark.parametrize(
        ("data", "scene"),
        [(OVERHEAD, Brake(mechanism="bridge")), (OVERHEAD, Brake(mechanism="trolley")), (RACK, Brake())],
    )
    def test_what_follows_lies_in_its_bar_wherever_the_loads_lie_in_theirs(self, data: Any, scene: Brake) -> None:
        spec, rng = _spec(data), np.random.default_rng(8)
        bars = {"mast_moment_max": (6e3, 9e3), "mast_force_max": (1.1e3, 1.5e3)}
        found = {name: Found(Estimate(LOADS[name], *bars[name])) for name in LOADS}
        told = {name: one.estimate for name, one in with_derived(spec, scene, found).items()}
        sampled = [
            derived(spec, scene, {name: float(rng.uniform(*bars[name])) for name in LOADS}) for _ in range(50)
        ] + [derived(spec, scene, dict(zip(LOADS, ends, strict=True))) for ends in itertools.product(*bars.values())]
        for name in sampled[0]:
            seen = [one[name] for one in sampled]
            assert told[name].low == pytest.approx(min(seen), rel=1e-12)
            assert told[name].high == pytest.approx(max(seen), rel=1e-12)

    def test_the_bounds_of_an_effect_move_what_follows(self) -> None:
        spec, scene = _spec(RACK), Brake()
        exact = {name: Estimate.exact(value) for name, value in LOADS.items()}
        spread = bounds_of_derived(spec, scene, exact, {"mast_moment_max": Interval(-1e3, 2e3)})
        here = derived(spec, scene, LOADS)
        worse = derived(spec, scene, LOADS | {"mast_moment_max": 10e3})
        assert spread["column_stress"].high == pytest.approx(worse["column_stress"] - here["column_stress"])
        lost = worse["stability_reserve[along]"] - here["stability_reserve[along]"]
        assert spread["stability_reserve[along]"].low == pytest.approx(lost)
        assert spread["combination_force[11.2,2]"] == Interval(0.0, 0.0)

    def test_what_follows_from_a_load_without_a_bound_has_none(self) -> None:
        spec, scene = _spec(OVERHEAD), ObstacleScene(mechanism="bridge")
        found = {"collision_force": Found(Estimate(9e3, 0.0, math.inf)), "mast_moment_max": Found(Estimate.exact(5e4))}
        told = with_derived(spec, scene, found)
        assert not told["bridge_stress"].estimate.bounded
        assert told["column_stress"].estimate.bounded
        assert told["combination_force[11.1,4]"].estimate.high == math.inf
