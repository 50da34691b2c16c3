"""The worked cases of travelling cranes, through design files: C19 (skid of driven wheels), C27 (spectrum, group)."""

from typing import Any

import pytest
from support.machines import changed, load_of
from support.travelling import scene_report, value

PRINTED = 1e-5

C19: dict[str, Any] = {
    "kind": "crane",
    "type": "travelling",
    "load": "11 t",
    "bridge": {"mass": "10 t", "span": "20 m"},
    "trolley": {"mass": "3 t", "nearest": "2 m"},
    "wheels": {"diameter": "400 mm", "base": "4 m", "driven": ["A1", "B1"], "rating": "1 MN"},
    "rolling": {"coefficient": 0.01},
    "rail": {"adhesion": 0.14},
    "speed": "1 m/s",
    "drive": {
        "motor": {"inertia": "0.8 kg*m^2", "coupling_inertia": "0 kg*m^2", "mean_starting_torque": "150 N*m"},
        "gear": {"ratio": 20, "efficiency": 0.9},
        "brake": {"torque": "100 N*m"},
    },
    "suspension": {"length": "8 m"},
    "scenes": [{"type": "start"}],
}


class TestC19:
    """24 t on four wheels of 0.2 m, two of them driven through 20:1 at 0.9 by 150 N*m with 0.8 kg*m^2."""

    def test_the_handbook_beside_the_swing(self) -> None:
        scene = scene_report(C19)
        printed = {"acceleration_max": 0.357231, "skid_reserve_min": 1.50813, "start_time": 1 / 0.357231}
        for name, number in printed.items():
            formula = load_of(scene, name).formula
            assert formula is not None
            assert formula.value == pytest.approx(number, rel=PRINTED)

    def test_a_crane_whose_load_does_not_swing(self) -> None:
        """All of its mass in the bridge, and a load of a gram: the case is the motion itself."""
        stiff = changed(C19, load="1 g", bridge__mass="21 t", trolley__nearest="10 m", trolley__farthest="10 m")
        scene = scene_report(stiff)
        printed = {"acceleration_max": 0.357231, "skid_reserve_min": 1.50813, "traction_max": 10927.9}
        for name, number in printed.items():
            assert load_of(scene, name).estimate.value == pytest.approx(number, rel=2e-5)
        assert load_of(scene, "start_time").estimate.value == pytest.approx(1 / 0.357231, rel=2e-5)

    def test_the_torque_at_which_the_wheels_slip(self) -> None:
        stiff = changed(C19, load="1 g", bridge__mass="21 t", trolley__nearest="10 m", trolley__farthest="10 m")
        at_limit = changed(stiff, drive__motor__mean_starting_torque="230.208 N*m")
        assert value(at_limit, "skid_reserve_min") == pytest.approx(1.0, rel=2e-5)
        assert value(at_limit, "acceleration_max") == pytest.approx(0.5886, rel=2e-5)

    def test_the_even_travel(self) -> None:
        running = changed(C19, scenes=[{"type": "run", "trolley": "middle"}])
        assert value(running, "travel_resistance") == pytest.approx(2354.4, rel=PRINTED)
        assert 2 * value(running, "wheel_load_max") == pytest.approx(117720.0, rel=PRINTED)


class TestC27:
    """20 000, 30 000 and 50 000 cycles with 1, 0.6 and 0.3 of the rated load."""

    def test_spectrum_and_group(self) -> None:
        spectrum = [{"share": 0.2, "load": 1}, {"share": 0.3, "load": 0.6}, {"share": 0.5, "load": 0.3}]
        duty = {"factor": 0.4, "cycles": 100000, "load_spectrum": spectrum}
        scene = scene_report(changed(C19, duty=duty, scenes=[{"type": "run"}]))
        assert load_of(scene, "spectrum_factor").estimate.value == pytest.approx(0.2783, rel=PRINTED)
        assert load_of(scene, "crane_group").estimate.value == 4
