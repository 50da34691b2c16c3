"""A hoist in even motion against numbers worked out by hand, and what its checks say where something is wrong."""

import math
from typing import Any

import numpy as np
import pytest
from support.hoists import CRANE, PAPER, balanced_falls, hoist_of, hoist_scene, layers_turn_by_turn, value
from support.machines import changed, check_of, load_of, report_of, scene_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.report import SceneReport

G = 9.81
FREE: dict[str, Any] = changed(PAPER, reeving__sheave_efficiency=1, rope__mass="1e-9 kg/m", gearbox__efficiency=1)
"""The hoist of the paper without losses and with next to no rope."""


def verdict(scene: SceneReport, code: str) -> Verdict:
    return check_of(scene, code).verdict


class TestThePaper:
    """One rope on four falls, four nested layers of turns that touch."""

    def test_pulls(self) -> None:
        scene = hoist_scene(PAPER)
        weight = 1.1 * 40 * G
        up, down = (balanced_falls(5000 * G, 4, 0.98, weight, way)[1][0] for way in (True, False))
        assert value(scene, "rope_pull_max") == pytest.approx(up, rel=1e-12)
        assert value(scene, "rope_pull_lowering") == pytest.approx(down, rel=1e-12)
        assert value(scene, "rope_safety") == pytest.approx(168e3 / up, rel=1e-12)
        assert value(scene, "reeving_efficiency") == pytest.approx((1 - 0.98**4) / (4 * 0.02), rel=1e-12)

    def test_the_rope_as_a_spring(self) -> None:
        scene = hoist_scene(PAPER)
        assert value(scene, "rope_length") == pytest.approx(160.0)
        assert value(scene, "rope_stiffness") == pytest.approx(4 * 105e9 * 114e-6 / 40)
        assert value(scene, "static_stretch") == pytest.approx(5000 * G * 40 / (4 * 105e9 * 114e-6))

    def test_the_drum_layer_by_layer(self) -> None:
        scene = hoist_scene(PAPER)
        d, first = 0.0175, 0.3 / 2 + 0.0175 / 2
        step, turns = d * math.sqrt(3) / 2, 640 / 17.5
        length = 160 + 3 * 2 * math.pi * first
        assert value(scene, "drum_layers") == 4
        per_layer = [turns, turns - 1, turns, turns - 1]
        lengths = [2 * math.pi * (first + k * step) * n for k, n in enumerate(per_layer)]
        last = (length - sum(lengths[:3])) / (2 * math.pi * (first + 3 * step))
        assert value(scene, "drum_turns") == pytest.approx(sum(per_layer[:3]) + last)
        assert value(scene, "drum_capacity_nested") == pytest.approx(sum(lengths))
        square = [2 * math.pi * (0.3 + (2 * k + 1) * d) / 2 * turns for k in range(4)]
        assert value(scene, "drum_capacity_square") == pytest.approx(sum(square))
        assert value(scene, "flange_margin") == pytest.approx((0.095 - d - 3 * step) / d)
        assert value(scene, "hook_speed_max") / value(scene, "hook_speed") == pytest.approx((first + 3 * step) / first)

    def test_whole_turns_laid_one_by_one(self) -> None:
        data = changed(PAPER, drum__length="630 mm")
        turns, layers = layers_turn_by_turn(
            160 + 3 * 2 * math.pi * 0.15875, 0.15875, 0.0175 * math.sqrt(3) / 2, 36, True
        )
        scene = hoist_scene(data)
        assert value(scene, "drum_layers") == layers
        assert value(scene, "drum_turns") == pytest.approx(turns)

    def test_layer_by_layer(self) -> None:
        """The pull a constant torque gives falls as D_1/D_k; the torque of the hanging load grows."""
        scene = hoist_scene(PAPER)
        radii = [0.15875 + k * 0.0175 * math.sqrt(3) / 2 for k in range(4)]
        pull = value(scene, "rope_pull_max")
        for k, radius in enumerate(radii, 1):
            assert value(scene, f"layer_pull[{k}]") == pytest.approx(pull * radii[0] / radius)
            assert value(scene, f"layer_speed[{k}]") == pytest.approx(12 * 2 * math.pi / 60 * radius / 4)
        torques = [value(scene, f"layer_torque[{k}]") for k in range(1, 5)]
        assert torques == sorted(torques)
        assert torques[-1] == pytest.approx(value(scene, "torque_drum"))

    def test_fall_by_fall(self) -> None:
        scene = hoist_scene(PAPER)
        pulls = [value(scene, f"rope_pull_fall[{k}]") for k in range(1, 5)]
        assert pulls == pytest.approx(list(balanced_falls(5000 * G, 4, 0.98, 1.1 * 40 * G, True)[1]))

    def test_the_torque_is_largest_where_the_last_layer_begins(self) -> None:
        scene = hoist_scene(FREE)
        radius = 0.15875 + 3 * 0.0175 * math.sqrt(3) / 2
        assert value(scene, "torque_drum") == pytest.approx(5000 * G / 4 * radius, rel=1e-9)
        assert value(scene, "torque_motor_static_up") == pytest.approx(5000 * G / 4 * radius / 80, rel=1e-9)
        assert value(scene, "torque_motor_static_down") == pytest.approx(5000 * G / 4 * radius / 80, rel=1e-9)

    def test_the_power_is_that_of_the_load_on_the_first_layer(self) -> None:
        low = hoist_scene(changed(FREE, scenes=[{"type": "run", "hook_height": "0 m"}]))
        power = 5000 * G * value(low, "hook_speed")
        assert value(low, "power_hoisting") == pytest.approx(power, rel=1e-9)
        assert value(low, "hook_speed") == pytest.approx(12 * 2 * math.pi / 60 * 0.15875 / 4)

    def test_a_smooth_drum_takes_turns_that_touch(self) -> None:
        scene = hoist_scene(changed(PAPER, drum__surface="smooth", drum__pitch=None))
        assert value(scene, "drum_turns") == value(hoist_scene(PAPER), "drum_turns")


class TestTheCrane:
    """Two ropes, two falls of each, one layer."""

    def test_pulls_and_torques(self) -> None:
        scene = hoist_scene(CRANE)
        weight = 1.05 * 13.1 * G
        up, down = (balanced_falls(12850 * G / 2, 2, 0.985, weight, way)[1][0] for way in (True, False))
        radius = (0.355 + 0.016) / 2
        assert value(scene, "torque_drum") == pytest.approx(2 * up * radius)
        assert value(scene, "torque_motor_static_up") == pytest.approx(2 * up * radius / (106 * 0.93))
        assert value(scene, "torque_motor_static_down") == pytest.approx(2 * down * radius * (2 - 1 / 0.93) / 106)
        held = 2 * down * radius * (2 - 1 / 0.93) / 106
        assert value(scene, "brake_torque_static") == pytest.approx(held)
        assert value(scene, "brake_reserve_static") == pytest.approx(250 / held)
        assert value(scene, "starting_reserve") == pytest.approx(240 / (2 * up * radius / (106 * 0.93)))

    def test_drum_and_rope(self) -> None:
        scene = hoist_scene(CRANE)
        turns = 24 / (math.pi * 0.371) + 3
        assert value(scene, "drum_turns") == pytest.approx(turns)
        assert value(scene, "drum_length_required") == pytest.approx(turns * 0.018)
        assert value(scene, "rope_length") == pytest.approx(26.2)
        assert value(scene, "rope_stiffness") == pytest.approx(4 * 110e9 * 118e-6 / 13.1)
        assert value(scene, "rope_speed") == pytest.approx(0.266)
        assert value(scene, "drum_speed") == pytest.approx(0.266 / 0.1855)
        assert value(scene, "hoop_stress") == pytest.approx(value(scene, "rope_pull_max") / (0.018 * 0.014))
        assert value(scene, "drum_ratio") == pytest.approx(371 / 16)
        assert value(scene, "drum_slenderness") == pytest.approx(920 / 355)

    def test_the_fleet_angle_is_that_of_the_nearest_hook(self) -> None:
        travel = 24 / (math.pi * 0.371) * 0.018
        top, bottom = (travel / 2 - 0.12) / 1.1, (travel / 2 + 0.12) / 13.1
        assert math.tan(value(hoist_scene(CRANE), "fleet_angle")) == pytest.approx(max(top, bottom))
        led = changed(CRANE, reeving__lead_length="4 m", reeving__lead_offset="0 m")
        assert math.tan(value(hoist_scene(led), "fleet_angle")) == pytest.approx(travel / 2 / 4)

    def test_a_lead_and_deflection_sheaves(self) -> None:
        led = changed(CRANE, reeving__lead_length="4 m", reeving__deflection_sheaves=2, reeving__lead_offset="0 m")
        scene, bare = hoist_scene(led), hoist_scene(CRANE)
        assert value(scene, "rope_length") == pytest.approx(30.2)
        assert value(scene, "rope_stiffness") / value(bare, "rope_stiffness") == pytest.approx(26.2 / 30.2)
        assert value(scene, "rope_pull_max") == pytest.approx(value(bare, "rope_pull_max") / 0.985**2)
        assert value(scene, "rope_pull_lowering") == pytest.approx(value(bare, "rope_pull_lowering") * 0.985**2)

    def test_the_load_swings_on_its_rope(self) -> None:
        stiffness = 4 * 110e9 * 118e-6 / 13.1
        light = changed(CRANE, effects={"rope_mass": "off"})
        assert value(hoist_scene(light), "natural_frequency") == pytest.approx(math.sqrt(stiffness / 12850))
        soft = hoist_scene(changed(light, structure={"stiffness": "6 MN/m", "mass": "0 kg"}))
        series = 1 / (1 / stiffness + 1 / 6e6)
        assert value(soft, "natural_frequency") == pytest.approx(math.sqrt(series / 12850))

    @pytest.mark.parametrize("structure", [None, 6e6])
    def test_its_rope_swings_with_it(self, structure: float | None) -> None:
        """Four falls of rope between what gives and the load: a chain of many small masses on springs."""
        stiffness, rope, parts = 4 * 110e9 * 118e-6 / 13.1, 4 * 1.05 * 13.1, 400
        masses = np.full(parts + 1, rope / parts)
        masses[0], masses[-1] = rope / parts / 2, 12850 + rope / parts / 2
        matrix = parts * stiffness * (2 * np.eye(parts + 1) - np.eye(parts + 1, k=1) - np.eye(parts + 1, k=-1))
        matrix[0, 0] = parts * stiffness + (structure or 1e16)
        matrix[-1, -1] = parts * stiffness
        root = np.sqrt(masses)
        frequency = math.sqrt(np.linalg.eigvalsh(matrix / root / root[:, None])[0])
        given = {"stiffness": f"{structure} N/m", "mass": "0 kg"} if structure else None
        scene = hoist_scene(changed(CRANE, structure=given))
        assert value(scene, "natural_frequency") == pytest.approx(frequency, rel=1e-5)

    def test_the_height_of_the_hook(self) -> None:
        high = hoist_scene(changed(CRANE, scenes=[{"type": "run", "hook_height": "12 m"}]))
        assert value(high, "rope_stiffness") == pytest.approx(4 * 110e9 * 118e-6 / 1.1)
        assert value(high, "rope_length") == pytest.approx(2.2)

    def test_heat_of_the_spectrum(self) -> None:
        """S3: hoisting and lowering in turn, each load with its share."""
        points = [{"share": 0.4, "load": 1}, {"share": 0.6, "load": 0.5}]
        data = changed(CRANE, duty={"type": "S3", "factor": 0.4, "load_spectrum": points})
        squares = 0.0
        for point in points:
            mass, weight = 350 + 12500 * point["load"], 1.05 * 13.1 * G
            for way, through in ((True, 1 / 0.93), (False, 2 - 1 / 0.93)):
                pull = balanced_falls(mass * G / 2, 2, 0.985, weight, way)[1][0]
                squares += point["share"] / 2 * (2 * pull * 0.1855 * through / 106) ** 2
        scene = hoist_scene(data)
        assert value(scene, "torque_motor_rms") == pytest.approx(math.sqrt(squares))
        rated = 22e3 / (1460 * 2 * math.pi / 60)
        assert value(scene, "heating_utilisation") == pytest.approx(math.sqrt(squares) / rated)
        assert value(scene, "spectrum_factor") == pytest.approx(0.4 + 0.6 / 8)

    def test_starts_heat_in_s4(self) -> None:
        calm, busy = (
            value(hoist_scene(changed(CRANE, duty__type="S4", duty__starts_per_hour=z)), "torque_motor_rms")
            for z in (30, 240)
        )
        plain = value(hoist_scene(CRANE), "torque_motor_rms")
        assert plain < calm < busy
        up = value(hoist_scene(CRANE), "start_time")
        on = 3600 * 0.4 / 240
        assert busy**2 - plain**2 == pytest.approx(8 * (calm**2 - plain**2))  # so many more starts in the hour
        assert busy**2 - plain**2 < 240**2 * up / on  # no start down takes as long

    def test_the_rotor_takes_up_the_slip_of_a_start(self) -> None:
        """Integrated over the start: the field turns on while the rotor comes up, and the difference is heat."""
        data = changed(CRANE, motor__no_load_speed="1500 rpm", motor__start_heat="9 kJ")
        scene = hoist_scene(data)
        field = 1500 * 2 * math.pi / 60
        time = value(scene, "start_time") * field / value(scene, "motor_speed")
        rise = field / time  # to the speed of the field, evenly
        at = np.linspace(0, time, 20001)
        heat = float(np.trapezoid(240 * (field - rise * at), at))
        assert value(scene, "start_heat") == pytest.approx(heat, rel=1e-4)
        assert verdict(scene, "HST119") is Verdict.PASS
        assert verdict(hoist_scene(changed(data, motor__start_heat="1 kJ")), "HST119") is Verdict.FAIL
        assert verdict(hoist_scene(changed(data, motor__no_load_speed=None)), "HST119") is Verdict.NOT_CHECKED

    def test_a_motor_without_rest_is_rated_for_all_of_it(self) -> None:
        data = changed(CRANE, duty={"type": "S1"}, motor__rated_duty=None)
        scene = hoist_scene(data)
        rated = 22e3 / (1460 * 2 * math.pi / 60)
        assert value(scene, "heating_utilisation") == pytest.approx(value(scene, "torque_motor_rms") / rated)


class TestAssumptions:
    def test_what_the_file_leaves_out_is_reported(self) -> None:
        data = changed(PAPER, rope__area=None, rope__modulus=None, rope__mass=None, drum__pitch="17.5 mm")
        report = report_of(data)
        assumed = {one.path: one.value for one in report.assumed}
        assert assumed[("rope", "modulus")] == 1.05e11
        assert assumed[("rope", "fill_factor")] == 0.5
        assert assumed[("rope", "mass")] == pytest.approx(3800 * 0.0175**2)
        assert hoist_of(data).rope.modulus is not None

    def test_grooves_are_assumed_wider_than_the_rope(self) -> None:
        report, given = report_of(changed(CRANE, drum__pitch=None)), report_of(CRANE)
        (added,) = {one.path: one for one in report.assumed}.keys() - {one.path for one in given.assumed}
        assert added == ("drum", "pitch")
        (pitch,) = (one for one in report.assumed if one.path == added)
        assert (pitch.value, pitch.interval.low) == (pytest.approx(1.12 * 0.016), pytest.approx(1.06 * 0.016))

    def test_dead_wraps_are_assumed_and_may_decide(self) -> None:
        """Five of them would need a second layer on this drum; two or three do not."""
        report = report_of(changed(CRANE, drum__dead_wraps=None))
        assert {one.path: one.value for one in report.assumed}["drum", "dead_wraps"] == 3
        judged = check_of(scene_of(report), "HST107")
        assert judged.verdict is Verdict.UNDECIDED
        assert "`drum.dead_wraps` is 5" in judged.reason


class TestWhatIsWrong:
    def test_a_brake_weaker_than_the_load_says_how_far_it_drops(self) -> None:
        scene = hoist_scene(changed(CRANE, brake__torque="60 N*m"), repairs=True)
        judged = check_of(scene, "HST118")
        assert judged.verdict is Verdict.FAIL
        assert value(scene, "drop_distance") == 12.0
        assert "drops 12 m to the ground" in load_of(scene, "brake_reserve_static").note
        assert judged.blame.path == ("brake", "torque")
        assert judged.repair is not None
        assert judged.repair.value == pytest.approx(1.75 * value(scene, "brake_torque_static"), rel=0.02)

    def test_so_does_the_braking_of_a_lowered_load(self) -> None:
        report = report_of(changed(CRANE, brake__torque="60 N*m", scenes=[{"type": "lower_brake"}]))
        reasons = [one.reason for _, one in report.judgements]
        assert any("by up to 12 m" in one for one in reasons)
        assert report.verdict == "fail"

    @pytest.mark.parametrize(
        ("torque", "layer", "hook"),
        [(24.0, 2, None), (26.0, 3, None), (27.5, 4, None), (29.0, 0, None), (20.0, 0, None), (24.0, 0, "0 m")],
    )
    @pytest.mark.parametrize("scene", [{"type": "lower_brake"}, {"type": "stop", "direction": "down"}])
    def test_a_brake_that_holds_at_the_bottom_only_says_from_where_on_it_does_not(
        self, torque: float, layer: int, hook: str | None, scene: dict[str, Any]
    ) -> None:
        """Pull on the drum falls with the rope's weight, the radius grows by the rope's diameter a layer."""
        report = report_of(
            changed(PAPER, brake__torque=f"{torque} N*m", scenes=[scene | ({"hook_height": hook} if hook else {})])
        )
        said = [one for one in report.diagnostics if one.code == "NUM104"]
        assert [f"on layer {layer}, the brake does not" in one.message for one in said] == [True] * bool(layer)

    @pytest.mark.parametrize(
        ("brake", "scene"),
        [
            ({"torque": "60 N*m"}, {"type": "stop", "direction": "up"}),
            ({"torque": "10 kN*m", "shaft": "drum"}, {"type": "lower_brake"}),
        ],
    )
    def test_a_brake_too_weak_stops_a_hoisted_load_but_does_not_hold_it(
        self, brake: dict[str, Any], scene: dict[str, Any]
    ) -> None:
        """Nor does a brake on the drum that would hold behind the losses of a gear: they do not help it."""
        report = report_of(changed(CRANE, brake=brake, gearbox__efficiency=0.8, scenes=[scene]))
        said = [one.reason for _, one in report.judgements if one.code == "HST118"]
        assert said
        assert all("does not hold the load" in one for one in said)

    @pytest.mark.parametrize("gearbox", [{}, {"stiffness": "1.5 MN*m/rad"}, {"backlash": "0.1 deg"}])
    def test_a_brake_on_the_drum_stops_the_load_while_the_rotor_swings_on(self, gearbox: dict[str, Any]) -> None:
        data = changed(CRANE, brake={"torque": "25 kN*m", "shaft": "drum"}, scenes=[{"type": "lower_brake"}])
        data["gearbox"] |= gearbox | ({"stiffness": "1.5 MN*m/rad"} if gearbox else {})
        scene = hoist_scene(data)
        held = 2 * balanced_falls(12850 * G / 2, 2, 0.985, 1.05 * 13.1 * G, False)[1][0] * 0.1855
        moved = 14 + 0.93 * 0.16 * 106**2 + 12850 * (0.1855 / 2) ** 2  # the rotor drives the drum on, through the gear
        rigid = 0.133**2 / 2 / ((25e3 - held) / moved * 0.1855 / 2)
        stretch = 12850 * G * 13.1 / (4 * 110e9 * 118e-6)
        assert rigid < value(scene, "stop_distance_lowering") < rigid + stretch / 4
        assert verdict(scene, "HST122") is Verdict.PASS

    def test_no_distance_of_the_file_reaches_below_the_ground(self) -> None:
        scenes = [{"type": "lower_brake", "hook_height": "5 mm"}]
        scene = hoist_scene(changed(CRANE, checks__stop_distance="1 m", scenes=scenes))
        assert value(scene, "stop_distance_lowering") > 0.005
        assert verdict(scene, "HST122") is Verdict.FAIL

    def test_the_speed_at_which_it_lands_by_energy(self) -> None:
        data = changed(FREE, brake__torque="20 N*m", drum__layers=4)
        scene = hoist_scene(data)
        load = value(scene, "torque_drum")  # without losses the same both ways
        inertia = 0.045 + (9 + 5000 * (0.15875 / 4) ** 2) / 80**2
        motor_angle = 40 / (0.15875 / 4) * 80
        work = (load / 80 - 20) * motor_angle
        speed = math.sqrt(2 * work / inertia) / 80 * 0.15875 / 4
        assert value(scene, "drop_speed") == pytest.approx(speed, rel=1e-6)

    def test_a_self_locking_gear_needs_no_brake(self) -> None:
        scene = hoist_scene(changed(CRANE, gearbox__efficiency=0.45, motor__mean_starting_torque="500 N*m"))
        assert value(scene, "torque_motor_static_down") < 0
        assert math.isinf(value(scene, "brake_reserve_static"))
        assert verdict(scene, "HST118") is Verdict.PASS

    def test_a_self_locking_gear_that_jams_stops_the_load_at_once(self) -> None:
        """A drum so heavy cannot be braked through it: the load swings on its rope from the speed it had."""
        data = changed(CRANE, gearbox__efficiency=0.4, drum__inertia="9000 kg*m^2", scenes=[{"type": "lower_brake"}])
        scene = hoist_scene(data)
        stiffness = 4 * 110e9 * 118e-6 * 2 / (2 * 13.1)
        assert value(scene, "stop_time") == 0
        assert value(scene, "stop_distance_lowering") == pytest.approx(0.133 * math.sqrt(12850 / stiffness), rel=1e-6)
        assert value(scene, "rope_force_max") == pytest.approx(12850 * G + 0.133 * math.sqrt(stiffness * 12850))

    def test_a_brake_on_the_drum_gets_no_help_from_the_gear(self) -> None:
        scene = hoist_scene(changed(CRANE, brake__shaft="drum", brake__torque="25 kN*m"))
        down = balanced_falls(12850 * G / 2, 2, 0.985, 1.05 * 13.1 * G, False)[1][0]
        assert value(scene, "brake_torque_static") == pytest.approx(2 * down * 0.1855)

    def test_a_motor_that_stalls(self) -> None:
        scene = hoist_scene(changed(CRANE, motor__mean_starting_torque="100 N*m"), repairs=True)
        assert verdict(scene, "HST114") is Verdict.FAIL
        assert "stall" in load_of(scene, "starting_reserve").note
        assert check_of(scene, "HST114").repair is not None

    @pytest.mark.parametrize("direction", ["up", "down"])
    def test_a_start_is_held_against_the_motor_too(self, direction: str) -> None:
        data = changed(CRANE, motor__mean_starting_torque="100 N*m")
        scene = hoist_scene(changed(data, scenes=[{"type": "start", "direction": direction}]))
        judged = [one.verdict for one in scene.checks if one.code == "HST114"]
        assert judged == ([Verdict.FAIL] if direction == "up" else [])
        assert value(scene, "starting_reserve") == pytest.approx(value(hoist_scene(data), "starting_reserve"))

    def test_a_motor_five_times_too_strong(self) -> None:
        scene = hoist_scene(changed(CRANE, motor__mean_starting_torque="1200 N*m"), repairs=True)
        judged = check_of(scene, "HST115")
        assert judged.verdict is Verdict.FAIL
        assert judged.repair is not None
        assert judged.repair.value == pytest.approx(4 * value(scene, "torque_motor_static_up"), rel=0.02)

    def test_a_drum_of_ten_metres(self) -> None:
        scene = hoist_scene(changed(CRANE, height="280 m", drum__length="10 m"), repairs=True)
        judged = check_of(scene, "HST109")
        assert judged.verdict is Verdict.FAIL
        assert judged.repair is not None
        assert judged.repair.path == ("drum", "diameter")
        assert judged.repair.value == pytest.approx(4.0, rel=0.02)

    def test_a_drum_too_short_needs_more_layers_than_it_has(self) -> None:
        scene = hoist_scene(changed(CRANE, drum__length="300 mm"), repairs=True)
        assert value(scene, "drum_layers") == 2
        assert verdict(scene, "HST106") is verdict(scene, "HST107") is Verdict.FAIL
        repair = check_of(scene, "HST106").repair
        assert repair is not None
        again = hoist_scene(changed(CRANE, drum__length=f"{repair.value * 1e3:.6f} mm"))
        assert verdict(again, "HST106") is verdict(again, "HST107") is Verdict.PASS

    @pytest.mark.parametrize(("falls", "comes_down"), [(4, True), (8, False)])
    def test_a_hook_block_comes_down_against_the_friction_of_the_upper_sheaves(
        self, falls: int, comes_down: bool
    ) -> None:
        """Two falls of a rope have none: both pull the block, however light, down with the rope the drum gives."""
        scene = hoist_scene(changed(CRANE, hook_block="0.2 kg", reeving__falls=falls))
        lower = balanced_falls(0.2 * G / 2, falls // 2, 0.985, 1.05 * 13.1 * G, False)[0]
        assert (float(lower.min()) > 0) is comes_down
        assert value(scene, "rope_pull_empty") == pytest.approx(lower.min(), rel=1e-6)
        assert (verdict(scene, "HST105") is Verdict.PASS) is comes_down

    @pytest.mark.parametrize(
        ("code", "key", "value_"),
        [
            ("HST101", "rope__breaking_force", "120 kN"),
            ("HST102", "drum__diameter", "260 mm"),
            ("HST103", "reeving__sheave_diameter", "280 mm"),
            ("HST104", "reeving__equaliser_diameter", "200 mm"),
            ("HST110", "drum__dead_wraps", 1),
            ("HST112", "drum__shell_thickness", "9 mm"),
            ("HST117", "duty__starts_per_hour", 300),
        ],
    )
    def test_what_fails_blames_its_key_and_says_what_passes(self, code: str, key: str, value_: Any) -> None:
        path = tuple(key.split("__"))
        judged = check_of(hoist_scene(changed(CRANE, **{key: value_}), repairs=True), code)
        assert judged.verdict is Verdict.FAIL
        assert judged.blame.path == path
        assert judged.repair is not None
        assert judged.repair.path == path

    @pytest.mark.parametrize(
        ("code", "key", "value_"), [("HST101", "checks__rope_safety", 20), ("HST116", "motor__power", "14 kW")]
    )
    def test_no_limit_and_no_rating_is_offered(self, code: str, key: str, value_: Any) -> None:
        """A part of another strength is."""
        judged = check_of(hoist_scene(changed(CRANE, **{key: value_}), repairs=True), code)
        assert judged.verdict is Verdict.FAIL
        assert (judged.repair.path if judged.repair else ()) == (("rope", "breaking_force") if code == "HST101" else ())

    def test_a_flange_just_over_the_rope(self) -> None:
        assert verdict(hoist_scene(changed(PAPER, drum__flange_height="80 mm")), "HST108") is Verdict.FAIL

    def test_a_rotation_resistant_rope_bears_half_the_fleet_angle(self) -> None:
        assert verdict(hoist_scene(CRANE), "HST111") is Verdict.PASS
        assert verdict(hoist_scene(changed(CRANE, rope__rotation_resistant="yes")), "HST111") is Verdict.FAIL

    def test_a_group_that_is_too_low(self) -> None:
        scene = hoist_scene(changed(CRANE, duty__hours="9000 h"))
        assert value(scene, "mechanism_group") == 8  # T6, L4
        assert verdict(scene, "HST113") is Verdict.FAIL

    def test_groups_m7_and_m8_want_one_layer(self) -> None:
        data = changed(PAPER, class__mechanism="M7")
        assert verdict(hoist_scene(data), "HST107") is Verdict.FAIL
        allowed = changed(data, checks={"layers": 4, "rope_safety": 7.1})
        assert verdict(hoist_scene(allowed), "HST107") is Verdict.PASS

    def test_dangerous_loads_ask_for_a_quarter_more(self) -> None:
        scene = hoist_scene(changed(CRANE, class__dangerous_load="yes"))
        limit = check_of(scene, "HST101").limit
        assert limit is not None
        assert limit.value == pytest.approx(1.25 * 4.5)


class TestWhatIsNotKnown:
    @pytest.mark.parametrize(
        ("code", "key"),
        [
            ("HST101", "rope__breaking_force"),
            ("HST101", "class"),
            ("HST102", "class"),
            ("HST103", "reeving__sheave_diameter"),
            ("HST112", "checks__hoop_stress"),
            ("HST114", "gearbox"),
            ("HST116", "motor__power"),
            ("HST117", "motor__starts_per_hour"),
            ("HST118", "brake"),
        ],
    )
    def test_a_check_names_the_key_it_lacks(self, code: str, key: str) -> None:
        judged = check_of(hoist_scene(changed(CRANE, **{key: None})), code)
        assert judged.verdict is Verdict.NOT_CHECKED
        lacking = "motor.rated_torque" if key == "motor__power" else key.replace("__", ".")
        assert lacking.replace("class", "class.mechanism") in judged.reason

    def test_three_layers_on_a_shell_need_a_factor(self) -> None:
        data = changed(PAPER, drum__shell_thickness="14 mm", checks={"hoop_stress": "200 MPa"})
        judged = check_of(hoist_scene(data), "HST112")
        assert judged.verdict is Verdict.NOT_CHECKED
        assert "checks.layer_factor" in judged.reason
        assert verdict(hoist_scene(changed(data, checks__layer_factor=2.4)), "HST112") is Verdict.PASS

    def test_a_hoist_of_rope_and_drum_alone_is_asked_no_more(self) -> None:
        data = changed(CRANE, motor=None, gearbox=None, brake=None, duty=None)
        assert report_of(data).verdict == "pass"

    def test_an_empty_hook_is_not_held_against_limits_of_the_load(self) -> None:
        scene = scene_of(report_of(changed(CRANE, scenes=[{"type": "run", "load": "empty"}])))
        assert scene.name == "run_empty"
        assert [one.code for one in scene.checks] == ["HST105"]
        pull = balanced_falls(350 * G / 2, 2, 0.985, 1.05 * 13.1 * G, True)[1][0]
        assert value(scene, "rope_pull_max") == pytest.approx(pull)


class TestDisagreement:
    def test_motor_gear_and_speed(self) -> None:
        (found,) = report_of(changed(CRANE, gearbox__ratio=90)).diagnostics
        assert found.code == "SPC201"
        assert "result in a drum speed of 16.22 rpm" in found.message

    @pytest.mark.parametrize("power", ["22 kW", "2200 kW"])
    def test_a_motor_that_starts_with_less_than_its_rated_torque(self, power: str) -> None:
        found = report_of(changed(CRANE, motor__power=power)).diagnostics
        assert [one.code for one in found] == (["SPC201"] if power == "2200 kW" else [])
        assert all("mean starting torque of 240 N*m" in one.message and "14.39 kN*m" in one.message for one in found)

    def test_the_modulus_of_wire(self) -> None:
        (found,) = report_of(changed(CRANE, rope__modulus="210 GPa")).diagnostics
        assert (found.code, found.path) == ("SPC201", ("rope", "modulus"))

    def test_a_creep_speed_that_is_missing(self) -> None:
        (found,) = report_of(changed(CRANE, speed__creep=None)).diagnostics
        assert "has a creep speed" in found.message
