"""The worked cases of stacker cranes in statics, through design files: C08 (carriage), C09 (stiffness)."""

from typing import Any

import pytest
from support.machines import changed, load_of, report_of, scene_of

from ptmcalc.contract.report import SceneReport

PRINTED = 1e-5

C08: dict[str, Any] = {
    "kind": "crane",
    "type": "overhead_stacker",
    "load": "1 t",
    "bridge": {"mass": "6 t", "span": "16.5 m", "girder_vertical": "0.0012 m^4", "girder_horizontal": "0.00016 m^4"},
    "trolley": {"mass": "4 t", "gauge": "2 m"},
    "column": {"length": "6 m", "mass": "1200 kg", "second_moment": "0.0002 m^4"},
    "carriage": {
        "mass": "600 kg",
        "load_arm": "0.9 m",
        "own_arm": "0.35 m",
        "rollers": {"distance": "1.2 m", "diameter": "160 mm", "axle_diameter": "50 mm", "rating": "20 kN"},
    },
    "hoisting": {
        "speed": "0.2 m/s",
        "acceleration": "0.3 m/s^2",
        "rope": {"falls": 2, "efficiency": 0.97, "breaking_force": "60 kN"},
    },
    "checks": {"rope_safety": 5},
    "scenes": [{"type": "hoist"}],
}
STILL = "0.000000001 m/s^2"


def _scene(data: dict[str, Any], name: str = "") -> SceneReport:
    return scene_of(report_of(data), name)


def _value(data: dict[str, Any], load: str) -> float:
    estimate = load_of(_scene(data), load).estimate
    assert estimate.low == estimate.high
    return estimate.value


class TestC08:
    """1000 kg at 0.9 m and 600 kg at 0.35 m on rollers 1.2 m apart, hoisted on two falls of 0.97."""

    @pytest.mark.parametrize(
        ("load", "still", "moving"),
        [
            ("roller_reaction", 9074.25, 9351.75),
            ("carriage_resistance", 198.499, 204.57),
            ("rope_force", 8193.04, 8443.59),
        ],
    )
    def test_with_and_without_inertia(self, load: str, still: float, moving: float) -> None:
        assert _value(C08, load) == pytest.approx(moving, rel=PRINTED)
        assert _value(changed(C08, hoisting__acceleration=STILL), load) == pytest.approx(still, rel=PRINTED)

    def test_sheaves_of_0_98_are_a_tackle_of_0_99(self) -> None:
        rope = {"hoisting__rope__efficiency": None, "hoisting__rope__sheave_efficiency": 0.98}
        assert _value(changed(C08, **rope), "rope_force") == pytest.approx(8443.59 * 0.97 / 0.99, rel=PRINTED)

    def test_on_the_way_down_friction_helps_the_rope(self) -> None:
        """Two falls of sheaves of 0.94: the lower fall is the drum's times 1/0.94."""
        down = changed(C08, scenes=[{"type": "hoist", "direction": "down"}])
        carried = 15696.0 * (1 + 0.3 / 9.81) - 204.57
        assert _value(down, "rope_force") == pytest.approx(carried / (1 + 1 / 0.94), rel=PRINTED)
        assert _value(down, "jamming") == pytest.approx(198.499 / 15696.0, rel=PRINTED)

    def test_two_planes_add_as_vectors_or_each_for_itself(self) -> None:
        """A load half as far out across; the friction of separate rollers is that of the sum of both reactions."""
        both = changed(C08, carriage__load_arm_across="0.45 m")
        along, across = 9351.75, 9810 * 0.45 / 1.2 * (1 + 0.3 / 9.81)
        joint, separate = (along**2 + across**2) ** 0.5, along + across
        assert _value(both, "roller_reaction") == pytest.approx(joint, rel=PRINTED)
        for planes, friction, roller in (("joint", joint, joint), ("separate", separate, along)):
            known = changed(both, carriage__rollers__planes=planes)
            assert _value(known, "carriage_resistance") == pytest.approx(204.57 * friction / along, rel=PRINTED)
            assert _value(known, "roller_load") == pytest.approx(roller, rel=PRINTED)
        unknown = load_of(_scene(both), "carriage_resistance").estimate
        assert (unknown.low, unknown.high) == pytest.approx(
            (204.57 * joint / along, 204.57 * separate / along), rel=1e-5
        )


class TestC09:
    """A column of 6 m under a bridge of 16.5 m, girders 2 m apart."""

    def test_the_stiffness_along_the_travel_of_the_bridge(self) -> None:
        standing = changed(C08, scenes=[{"type": "stand"}])
        assert load_of(_scene(standing), "column_stiffness").estimate.value == pytest.approx(102128.0, rel=PRINTED)

    def test_a_root_that_turns_and_two_masts(self) -> None:
        """In series with the girders; two masts bend half as much."""
        soft = changed(C08, scenes=[{"type": "stand"}], column__root_stiffness="36 MN*m/rad", column__count=2)
        by_hand = 1.71429e-06 / 2 + 6.68471e-06 + 1.39265e-06 + 36 / 36e6
        assert load_of(_scene(soft), "column_stiffness").estimate.value == pytest.approx(1 / by_hand, rel=PRINTED)
