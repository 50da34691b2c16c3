"""A hoist as a file writes it: what it says, and what it answers where something is wrong."""

from typing import Any

import pytest
import yaml
from support.hoists import CRANE, PAPER, hoist_of
from support.machines import changed

from ptmcalc.base.diagnostic import Diagnostic
from ptmcalc.engine.load import load_text
from ptmcalc.machines.hoist.machine.spec import Lift, LowerBrake, Release, Run, WindUp


def problems(data: dict[str, Any]) -> list[Diagnostic]:
    return list(load_text(yaml.safe_dump(data, sort_keys=False).encode(), "case.yaml").diagnostics)


def faulty(data: dict[str, Any], *path: str | int) -> Diagnostic:
    """The only error of a file, at a place that has a line."""
    found = [one for one in problems(data) if one.severity == "error"]
    assert [one.path for one in found] == [path], [(one.path, one.message) for one in found]
    assert found[0].span is not None
    assert found[0].hint
    return found[0]


class TestReeving:
    @pytest.mark.parametrize("falls", [0, -4])
    def test_a_load_hangs_on_a_rope(self, falls: int) -> None:
        found = faulty(changed(PAPER, reeving__falls=falls), "reeving", "falls")
        assert f"a load cannot hang on {falls} rope falls" in found.message
        assert "falls: 4" in found.hint

    def test_more_falls_than_any_tackle(self) -> None:
        assert "at most `falls: 64`" in faulty(changed(PAPER, reeving__falls=100), "reeving", "falls").hint

    @pytest.mark.parametrize("falls", [2.5, "four", True])
    def test_a_part_of_a_fall(self, falls: Any) -> None:
        assert faulty(changed(PAPER, reeving__falls=falls), "reeving", "falls").code == "SPC111"

    def test_two_ropes_share_the_falls_out(self) -> None:
        found = faulty(changed(CRANE, reeving__falls=5), "reeving", "falls")
        assert "5 falls cannot be divided between two ropes" in found.message
        assert "falls: 6" in found.hint

    def test_ropes_are_one_or_two(self) -> None:
        found = faulty(changed(CRANE, reeving__ropes=3), "reeving", "ropes")
        assert "is `3`, not one of `1`, `2`" in found.message
        assert "1" in found.hint


class TestRopeAndDrum:
    @pytest.mark.parametrize("drum", ["17.5 mm", "10 mm"])
    def test_a_rope_thicker_than_its_drum(self, drum: str) -> None:
        found = faulty(changed(PAPER, drum__diameter=drum), "drum", "diameter")
        assert "a rope of 17.5 mm cannot be wound on a drum of" in found.message
        assert "diameter: 315 mm" in found.hint

    def test_more_layers_than_the_flanges_hold(self) -> None:
        found = faulty(changed(PAPER, drum__layers=7), "drum", "layers")
        assert "flanges of 95 mm are high enough for 6 layers, not 7" in found.message
        assert "layers: 6" in found.hint
        assert "flange_height: 134.7 mm" in found.hint

    def test_square_layers_are_thicker(self) -> None:
        data = changed(PAPER, drum__layers=6, winding={"packing": "square"})
        assert "high enough for 5 layers, not 6" in faulty(data, "drum", "layers").message

    def test_a_flange_lower_than_the_rope(self) -> None:
        assert (
            "high enough for 0 layers" in faulty(changed(PAPER, drum__flange_height="10 mm"), "drum", "layers").message
        )

    def test_layers_need_flanges(self) -> None:
        found = faulty(changed(PAPER, drum__flange_height=None), "drum", "layers")
        assert "their height is missing" in found.message
        assert "flange_height: 105 mm" in found.hint

    @pytest.mark.parametrize(("pitch", "reason"), [("10 mm", "at least"), ("35 mm", "less than two"), ("40 mm", "two")])
    def test_turns_lie_side_by_side(self, pitch: str, reason: str) -> None:
        """Between turns two diameters apart a rope falls to the drum: (d^2 - (2 d/2)^2)^(1/2) = 0."""
        for packing in ("nested", "square"):
            data = changed(PAPER, drum__pitch=pitch, drum__layers=1, winding={"packing": packing})
            found = faulty(data, "drum", "pitch")
            assert reason in found.message
            assert f"not {pitch}" in found.message
            assert "pitch: 19.6 mm" in found.hint
        assert problems(changed(PAPER, drum__pitch="34.99 mm", drum__layers=1)) == []

    def test_a_third_layer_lies_clear_of_the_first(self) -> None:
        """3^(1/2) 17.5 mm = 30.31 mm: two steps of (d^2 - (p/2)^2)^(1/2) are d then."""
        third = changed(PAPER, drum__layers=3)
        assert problems(changed(third, drum__pitch="30.3 mm")) == []
        found = faulty(changed(third, drum__pitch="30.32 mm"), "drum", "pitch")
        assert "a third nested layer" in found.message
        assert problems(changed(PAPER, drum__layers=2, drum__pitch="30.32 mm")) == []

    def test_a_drum_for_no_turn(self) -> None:
        found = faulty(changed(PAPER, drum__length="20 mm"), "drum", "length")
        assert "three adjacent wraps" in found.message

    def test_an_area_given_twice(self) -> None:
        assert "not both" in faulty(changed(PAPER, rope__fill_factor=0.5), "rope", "fill_factor").message

    def test_no_layer_at_all(self) -> None:
        assert faulty(changed(PAPER, drum__layers=0), "drum", "layers").code == "SPC110"


class TestDrive:
    def test_a_speed_given_twice_or_never(self) -> None:
        assert "not both" in faulty(changed(PAPER, speed__main="0.05 m/s"), "speed", "drum").message
        assert "main" in faulty(changed(PAPER, speed={"creep": "0.01 m/s"}), "speed").hint

    def test_a_creep_speed_that_is_the_faster_one(self) -> None:
        assert "swap" in faulty(changed(CRANE, speed__creep="0.2 m/s"), "speed", "creep").hint

    def test_a_rating_given_twice(self) -> None:
        assert "not both" in faulty(changed(CRANE, motor__rated_torque="140 N*m"), "motor", "power").message

    def test_a_power_without_a_speed(self) -> None:
        assert "`speed` is missing" in faulty(changed(CRANE, motor__speed=None), "motor").message

    def test_a_play_with_nothing_elastic_behind_it(self) -> None:
        found = faulty(changed(PAPER, gearbox__backlash="0.2 deg"), "gearbox")
        assert "stiffness" in found.hint
        assert not problems(changed(PAPER, gearbox__backlash="0 deg"))

    def test_a_spectrum_that_is_no_whole(self) -> None:
        data = changed(CRANE, duty__load_spectrum=[{"share": 0.5, "load": 1}, {"share": 0.2, "load": 0.5}])
        assert "add up to 0.7" in faulty(data, "duty", "load_spectrum").message

    def test_a_duty_without_rest_has_no_factor(self) -> None:
        assert "S1 has no rest" in faulty(changed(CRANE, duty__type="S1"), "duty", "factor").message

    def test_starts_that_heat_are_counted(self) -> None:
        data = changed(CRANE, duty__type="S4", duty__starts_per_hour=None)
        assert "starts_per_hour" in faulty(data, "duty").hint

    @pytest.mark.parametrize("efficiency", [0, 1.2])
    def test_an_efficiency_out_of_range(self, efficiency: float) -> None:
        assert faulty(changed(CRANE, gearbox__efficiency=efficiency), "gearbox", "efficiency").code == "SPC110"


class TestSeveralFaults:
    def test_all_are_told_at_once(self) -> None:
        data = changed(PAPER, reeving__falls=0, drum__diameter="10 mm", load="5000", speed__creep="1 furlong")
        paths = {one.path for one in problems(data)}
        assert paths == {("reeving", "falls"), ("drum", "diameter"), ("load",), ("speed", "creep")}


class TestScenes:
    def test_a_run_is_the_default(self) -> None:
        spec = hoist_of(changed(PAPER, scenes=None, brake=None))
        assert [type(scene) for scene in spec.all_scenes] == [Run]
        assert spec.all_scenes[0].label == "run_loaded"

    def test_a_whole_hoist_lifts_and_lowers_too(self) -> None:
        assert [type(scene) for scene in hoist_of(changed(PAPER, scenes=None)).all_scenes] == [Run, Lift, LowerBrake]

    @pytest.mark.parametrize(("drive", "speed"), [("HD1", "main"), ("HD2", "creep"), ("HD4", "main")])
    def test_a_load_is_lifted_off_as_its_drive_is_classed(self, drive: str, speed: str) -> None:
        lift = hoist_of(changed(CRANE, scenes=None, class__drive=drive)).all_scenes[1]
        assert isinstance(lift, Lift)
        assert lift.speed == speed

    def test_what_moves_the_load_needs_a_drive(self) -> None:
        data = changed(PAPER, motor=None, scenes=[{"type": "start"}])
        assert "add `motor:" in faulty(data, "scenes", 0).hint
        data = changed(PAPER, brake=None, scenes=[{"type": "lower_brake"}])
        assert "add `brake:" in faulty(data, "scenes", 0).hint
        data = changed(PAPER, gearbox=None, scenes=[{"type": "lift"}])
        assert "add `gearbox:" in faulty(data, "scenes", 0).hint

    def test_a_creep_speed_the_hoist_has_not(self) -> None:
        data = changed(PAPER, scenes=[{"type": "lower_brake", "speed": "creep"}])
        assert "creep" in faulty(data, "scenes", 0, "speed").message

    def test_a_hook_above_its_highest_place(self) -> None:
        data = changed(PAPER, scenes=[{"type": "run", "hook_height": "41 m"}])
        assert "only 40 m" in faulty(data, "scenes", 0, "hook_height").message

    @pytest.mark.parametrize("scene", ["run", "lift", "start", "stop", "lower_brake", "release", "winding"])
    def test_a_hook_so_high_that_no_rope_is_free(self, scene: str) -> None:
        data = changed(PAPER, motor__speed="960 rpm", scenes=[{"type": scene, "hook_height": "40 m"}])
        assert "least_fall: 1 m" in faulty(data, "scenes", 0, "hook_height").hint
        assert not problems(changed(data, least_fall="1 m"))

    @pytest.mark.parametrize("scene", ["lift", "start", "stop", "lower_brake", "release", "winding"])
    def test_an_empty_hook_without_a_mass(self, scene: str) -> None:
        data = changed(PAPER, scenes=[{"type": scene, "load": "empty"}])
        assert "hook_block: 90 kg" in faulty(data, "scenes", 0, "load").hint
        assert not problems(changed(data, hook_block="90 kg"))

    def test_a_layer_that_is_never_wound(self) -> None:
        data = changed(CRANE, scenes=[{"type": "winding"}])
        assert "never reaches layer 2" in faulty(data, "scenes", 0).message

    def test_a_curve_that_the_motor_has_not(self) -> None:
        data = changed(PAPER, scenes=[{"type": "start", "profile": {"shape": "curve"}}])
        assert "no `curve`" in faulty(data, "scenes", 0, "profile", "shape").message

    def test_scenes_are_told_apart_by_their_load(self) -> None:
        data = changed(PAPER, scenes=[{"type": "run"}, {"type": "run", "load": "empty"}])
        assert [scene.label for scene in hoist_of(data).all_scenes] == ["run_loaded", "run_empty"]

    def test_what_else_may_happen(self) -> None:
        data = changed(
            PAPER,
            scenes=[
                {"type": "release", "share": 0.5, "manner": "slow"},
                {"type": "winding", "layer": 3},
                {"type": "lower_brake"},
            ],
        )
        assert [type(scene) for scene in hoist_of(data).all_scenes] == [Release, WindUp, LowerBrake]
