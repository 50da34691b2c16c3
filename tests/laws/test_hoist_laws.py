"""Laws of a hoist in even motion: tackle, rope, drum, torques, classes."""

import math
from fractions import Fraction

import numpy as np
import pytest
from support.hoists import balanced_falls, layers_turn_by_turn

from ptmcalc.laws import gearing, hoist_class, hoisting, reeving, rope_drum, wire_rope

G = 9.81


class TestTackle:
    @pytest.mark.parametrize("falls", [1, 2, 3, 4, 8, 12, 13])
    @pytest.mark.parametrize("efficiency", [0.9, 0.97, 0.985, 1.0])
    @pytest.mark.parametrize("hauling", [True, False])
    @pytest.mark.parametrize("weight", [0.0, 300.0, 4e3])
    def test_pulls_balance_every_sheave(self, falls: int, efficiency: float, hauling: bool, weight: float) -> None:
        found = reeving.fall_pulls(5e4, falls, efficiency, weight, hauling)
        assert found == pytest.approx(balanced_falls(5e4, falls, efficiency, weight, hauling)[1], rel=1e-11)

    @pytest.mark.parametrize("falls", [1, 2, 4, 12])
    def test_efficiency_is_that_of_the_weightless_rope(self, falls: int) -> None:
        up, down = (balanced_falls(1e4, falls, 0.97, 0.0, way)[1][0] for way in (True, False))
        assert 1e4 / falls / up == pytest.approx(reeving.tackle_efficiency(falls, 0.97), rel=1e-13)
        assert down / (1e4 / falls) == pytest.approx(reeving.lowering_tackle_efficiency(falls, 0.97), rel=1e-13)

    def test_the_closed_forms_of_handbooks(self) -> None:
        eta, m = Fraction(98, 100), 4
        up = (1 - eta**m) / (m * (1 - eta))
        down = m * (1 / eta - 1) / (eta**-m - 1)
        assert reeving.tackle_efficiency(m, 0.98) == pytest.approx(float(up), rel=1e-14)
        assert reeving.lowering_tackle_efficiency(m, 0.98) == pytest.approx(float(down), rel=1e-14)

    @pytest.mark.parametrize(("falls", "eta", "off"), [(4, 0.98, 0.0005), (12, 0.97, 0.011)])
    def test_lowering_is_not_hauling_backwards(self, falls: int, eta: float, off: float) -> None:
        ratio = reeving.lowering_tackle_efficiency(falls, eta) / reeving.tackle_efficiency(falls, eta)
        assert 1 - ratio == pytest.approx(off, rel=0.1)

    def test_without_friction_all_falls_pull_alike(self) -> None:
        assert reeving.fall_pulls(8e3, 4, 1.0, 0.0, hauling=True) == pytest.approx([2e3] * 4)
        assert reeving.tackle_efficiency(7, 1.0) == reeving.lowering_tackle_efficiency(7, 1.0) == 1.0

    def test_a_load_too_light_leaves_a_fall_that_would_have_to_push(self) -> None:
        lower, upper = balanced_falls(10.0, 4, 0.95, 2e3, hauling=False)
        assert lower.min() < 0
        assert reeving.fall_pulls(10.0, 4, 0.95, 2e3, hauling=False).min() == pytest.approx(upper.min())

    def test_the_power_of_the_rope_is_that_of_the_hook(self) -> None:
        pull, speed = 5e4 / 4, reeving.rope_speed(0.2, 8, 2)
        assert 2 * (pull / 2) * speed == pytest.approx(5e4 * 0.2)  # two ropes, each an eighth of the load


class TestRope:
    def test_stiffness_by_the_work_of_the_stretch(self) -> None:
        """A hook that sinks by x stretches each of two ropes by 2 x: their strain energy is K x^2/2."""
        modulus, area, length, x = 1.1e11, 1.18e-4, 26.2, 1e-3
        energy = 2 * modulus * area / length * (2 * x) ** 2 / 2
        assert wire_rope.hook_stiffness(modulus, area, 4, 2, length) * x**2 / 2 == pytest.approx(energy)

    def test_the_frequency_of_the_winding_paper_put_right(self) -> None:
        """C24: k = 21.8815 rad/s, four times the published one."""
        stiffness = wire_rope.hook_stiffness(2.1e11, 114e-6, 4, 1, 160.0)
        assert math.sqrt(stiffness * G / 49050) == pytest.approx(21.8815, rel=1e-5)
        assert math.sqrt(stiffness * G / 49050) / 4 == pytest.approx(5.47037, rel=1e-5)

    def test_area_and_safety(self) -> None:
        assert wire_rope.metallic_area(0.0175, 1.0) == pytest.approx(math.pi * 0.0175**2 / 4)
        assert wire_rope.rope_safety(9e4, 2e4) == 4.5
        assert wire_rope.rope_safety(9e4, 0.0) == math.inf


class TestDrum:
    def test_nested_centres_make_triangles(self) -> None:
        step = rope_drum.layer_step(0.0175, 0.0195, "nested")
        assert math.hypot(step, 0.0195 / 2) == pytest.approx(0.0175)
        assert rope_drum.layer_step(0.02, 0.02, "nested") == pytest.approx(0.02 * math.sqrt(3) / 2)
        assert rope_drum.layer_step(0.02, 0.024, "square") == 0.02

    def test_square_layers_have_the_diameters_of_handbooks(self) -> None:
        """D_i = D + (2 i - 1) d."""
        for layer in (1, 2, 5):
            radius = rope_drum.layer_radius(0.3, 0.0175, 0.0175, layer)
            assert 2 * radius == pytest.approx(0.3 + (2 * layer - 1) * 0.0175)

    @pytest.mark.parametrize("packing", ["nested", "square"])
    @pytest.mark.parametrize("length", [0.5, 20.0, 36.0, 71.3, 163.0, 900.0])
    def test_turns_are_those_laid_one_by_one(self, packing: str, length: float) -> None:
        step = 0.0152 if packing == "nested" else 0.0175
        turns, layers = rope_drum.turns_for_length(length, 0.3, 0.0175, 36.0, step, packing)
        expected = layers_turn_by_turn(length, 0.15875, step, 36, packing == "nested")
        assert (turns, layers) == (pytest.approx(expected[0], rel=1e-12), expected[1])

    def test_a_hundredth_of_a_micrometre_more_than_a_layer_begins_the_next(self) -> None:
        full = 36.0 * math.tau * (0.3 + 0.0175) / 2
        for more, layers in ((-1e-8, 1), (0.0, 1), (1e-8, 2)):
            turns, used = rope_drum.turns_for_length(full + more, 0.3, 0.0175, 36.0, 0.0152, "nested")
            assert used == layers
            assert turns == pytest.approx(36.0, abs=1e-7)

    @pytest.mark.parametrize("layers", [1.5, 2.5, 5.9, 8.0])
    def test_rope_on_a_wide_drum(self, layers: float) -> None:
        length = layers * 360 * math.tau * 0.76
        found = rope_drum.turns_for_length(length, 1.5, 0.0175, 360.0, 0.0152, "nested")
        expected = layers_turn_by_turn(length, 0.75875, 0.0152, 360, nested=True)
        assert found == (pytest.approx(expected[0], rel=1e-12), expected[1])

    @pytest.mark.parametrize("length", [0.3, 5.0, 60.0])
    def test_rope_on_a_thread(self, length: float) -> None:
        """A core thinner than the rope: the layers grow faster than their number."""
        found = rope_drum.turns_for_length(length, 0.001, 0.0175, 2.0, 0.0152, "nested")
        expected = layers_turn_by_turn(length, 0.00925, 0.0152, 2, nested=True)
        assert found == (pytest.approx(expected[0], rel=1e-12), expected[1])

    @pytest.mark.parametrize("packing", ["nested", "square"])
    def test_what_lies_below_a_layer_is_what_the_layers_below_take(self, packing: str) -> None:
        below = rope_drum.length_below(np.arange(1, 300), 0.3, 0.0175, 36.0, 0.0152, packing)
        rooms = [rope_drum.drum_capacity(0.3, 0.0175, 36.0, k, 0.0152, packing) for k in range(299)]
        assert below == pytest.approx(rooms, rel=1e-13)

    def test_a_drum_far_too_short_still_counts_its_layers(self) -> None:
        turns, layers = rope_drum.turns_for_length(4e4, 0.3, 0.0175, 3.0, 0.0152, "nested")
        expected = layers_turn_by_turn(4e4, 0.15875, 0.0152, 3, nested=True)
        assert (turns, layers) == (pytest.approx(expected[0], rel=1e-9), expected[1])

    @pytest.mark.parametrize("packing", ["nested", "square"])
    @pytest.mark.parametrize("layers", [1, 2, 3, 6])
    def test_the_required_length_is_just_full(self, packing: str, layers: int) -> None:
        step = rope_drum.layer_step(0.0175, 0.0195, packing)
        length = rope_drum.drum_length_required(163.0, 0.3, 0.0175, 0.0195, layers, step, packing)
        room = rope_drum.drum_capacity(0.3, 0.0175, length / 0.0195, layers, step, packing)
        assert room == pytest.approx(163.0, rel=1e-12)
        turns, used = rope_drum.turns_for_length(163.0, 0.3, 0.0175, length / 0.0195, step, packing)
        assert used in (layers, layers + 1)  # full to the last digit
        assert turns == pytest.approx(
            sum(rope_drum.turns_in_layer(length / 0.0195, packing, k) for k in range(1, layers + 1))
        )

    def test_between_turns_side_by_side_lies_one_fewer(self) -> None:
        for turns, even in ((0.4, 0.0), (1.0, 0.0), (2.5, 1.5), (36.0, 35.0)):
            assert [rope_drum.turns_in_layer(turns, "nested", k) for k in (1, 2, 3)] == [turns, even, turns]
            assert rope_drum.turns_in_layer(turns, "square", 2) == turns

    def test_the_helix_adds_as_little_as_claimed(self) -> None:
        turn = 2 * math.pi * (7.5 + 0.5)  # D = 15 d, p = d = 1
        assert math.hypot(turn, 1.0) / turn - 1 < 2e-4

    def test_a_ring_under_the_rope(self) -> None:
        """A ring one pitch wide: the rope's pull is held by two walls of the shell, on both sides of a cut."""
        pull, pitch, wall, radius = 3.2e4, 0.018, 0.014, 0.18
        pressure = pull / (pitch * radius)  # of the rope on the ring
        across = pressure * pitch * 2 * radius  # resultant on a half ring
        assert rope_drum.hoop_stress(pull, pitch, wall, 1.0) == pytest.approx(across / (2 * pitch * wall))
        assert [rope_drum.layer_factor(layers) for layers in (1, 2)] == [1.0, 1.75]

    def test_fleet_angle(self) -> None:
        assert math.tan(rope_drum.fleet_angle(0.4, 0.05, 5.0)) == pytest.approx(0.25 / 5)


class TestTorque:
    def test_lifting_and_lowering_through_a_lossy_gear(self) -> None:
        load, u, eta = 4e3, 40.0, 0.9
        up = hoisting.hoisting_torque(load, u, eta)
        down = hoisting.lowering_torque(load, u, gearing.reverse_efficiency(eta))
        assert up == pytest.approx(load / (u * eta))
        assert up - load / u == pytest.approx(load / u - down)  # equal loss both ways

    def test_a_self_locking_gear_must_be_pushed_down(self) -> None:
        assert hoisting.lowering_torque(4e3, 40.0, gearing.reverse_efficiency(0.4)) == pytest.approx(-50.0)

    @pytest.mark.parametrize("eta", [0.9, 0.6])
    def test_what_falls_keeps_its_energy(self, eta: float) -> None:
        """Work of the load less that of brake and mesh is the energy of motion, after any way."""
        back = 2 - 1 / eta
        load, brake, rotor, drum, u, way = 4e3, 20.0, 0.5, 130.0, 40.0, 6.0
        acceleration = hoisting.sinking_acceleration(load, brake, rotor, drum, u, eta, back)
        speed = math.sqrt(2 * acceleration * way)
        mesh = load - drum * acceleration / u  # on the drum shaft
        assert mesh > 0
        lost = mesh * (1 - back) * way / u + brake * way
        assert load * way / u - lost == pytest.approx(rotor * speed**2 / 2 + drum * (speed / u) ** 2 / 2)
        assert hoisting.speed_after_drop(acceleration, way) == pytest.approx(speed)

    def test_a_brake_that_holds_lets_nothing_sink(self) -> None:
        assert hoisting.sinking_acceleration(4e3, 90.0, 0.5, 130.0, 40.0, 0.9, 0.889) == 0.0
        assert hoisting.sinking_acceleration(4e3, 0.0, 0.5, 130.0, 40.0, 0.45, 2 - 1 / 0.45) == 0.0

    @pytest.mark.parametrize("up", [True, False])
    def test_start_time_by_energy(self, up: bool) -> None:
        load, mean, rotor, drum, u, eta, speed = 4e3, 200.0, 0.5, 130.0, 40.0, 0.9, 101.0
        time = hoisting.hoist_start_time(mean, load, rotor, drum, speed, u, eta, 2 - 1 / eta, up)
        angle = speed * time / 2
        mesh = load + (1 if up else -1) * drum * speed / time / u
        lost = abs(mesh) / u * angle * ((1 / eta - 1) if (mesh > 0) == up else (1 - (2 - 1 / eta)))
        gained = rotor * speed**2 / 2 + drum * (speed / u) ** 2 / 2
        assert mean * angle - lost - (1 if up else -1) * load * angle / u == pytest.approx(gained)

    def test_a_motor_that_stalls_never_arrives(self) -> None:
        assert hoisting.hoist_start_time(90.0, 4e3, 0.5, 130.0, 101.0, 40.0, 0.9, 0.89) == math.inf


class TestFrequency:
    @pytest.mark.parametrize("structure", [(6e6, 6500.0), (1e9, 10.0), (1e3, 1e6), (6e6, 1e-6)])
    def test_the_lower_of_two_modes(self, structure: tuple[float, float]) -> None:
        held, mass = structure
        stiffness = np.array([[held + 4e6, -4e6], [-4e6, 4e6]])
        root = np.diag(1 / np.sqrt([mass, 12850.0]))
        lowest = np.sqrt(np.linalg.eigvalsh(root @ stiffness @ root)[0])
        assert hoisting.load_frequency(4e6, 12850.0, held, mass) == pytest.approx(float(lowest), rel=1e-6)

    def test_a_rigid_structure_and_one_without_mass(self) -> None:
        assert hoisting.load_frequency(4e6, 12850.0, math.inf, 9e3) == pytest.approx(math.sqrt(4e6 / 12850))
        series = 1 / (1 / 4e6 + 1 / 6e6)
        assert hoisting.load_frequency(4e6, 12850.0, 6e6, 0.0) == pytest.approx(math.sqrt(series / 12850))


class TestClasses:
    def test_coefficients_of_ropes(self) -> None:
        """ISO 4308-1: a quarter more for molten metal, M5 at least and 9 at most."""
        assert [hoist_class.rope_safety_of_group(f"M{k}", 1) for k in (1, 5, 8)] == [3.15, 4.5, 9.0]
        assert [hoist_class.rope_safety_of_group(f"M{k}", 3) for k in (1, 6)] == [3.55, 5.6]
        assert hoist_class.rope_safety_of_group("M3", 1, dangerous=True) == pytest.approx(5.625)
        assert hoist_class.rope_safety_of_group("M8", 1, dangerous=True) == 9.0

    def test_tables_rise_with_the_group(self) -> None:
        for table in (
            hoist_class.ROPE_SAFETY,
            hoist_class.ROPE_SAFETY_LAYERS,
            hoist_class.DRUM_RATIO,
            hoist_class.SHEAVE_RATIO,
            hoist_class.EQUALISER_RATIO,
            hoist_class.BRAKE_RESERVE,
        ):
            assert list(table.values()) == sorted(table.values())
            assert list(table) == [f"M{k}" for k in range(1, len(table) + 1)]
