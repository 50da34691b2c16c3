"""The column of a stacker crane in modes: from a design file to loads, against elements of another hand."""

import math
from typing import Any

import numpy as np
import pytest
import yaml
from support.machines import changed
from support.mast_fem import Reference, Wall, first_at_speed, run
from support.stacker_masts import OVERHEAD, RACK, random_stacker

from ptmcalc.base.errors import NumericsError
from ptmcalc.contract.result import Result
from ptmcalc.engine.load import load_text
from ptmcalc.machines.crane.stacking.machine import model
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.mast import modal
from ptmcalc.machines.crane.stacking.mast.names import GRAVITY

C = 600e3
BENDING = C * 6**3 / 3


def spec_of(data: dict[str, Any]) -> Stacker:
    loaded = load_text(yaml.safe_dump(data).encode(), "x.yaml")
    assert loaded.spec is not None, [one.message for one in loaded.diagnostics]
    assert isinstance(loaded.spec, Stacker)
    return loaded.spec


def solved(data: dict[str, Any], level: int = 0, *, gravity: bool = False, scene: int = 0) -> Result:
    spec = spec_of(data)
    carried = modal.ALWAYS | ({GRAVITY} if gravity else frozenset())
    return modal.run(spec, spec.all_scenes[scene], carried, level)


def inside(result: Result, name: str, value: float) -> None:
    estimate = result.loads[name].estimate
    assert estimate.low <= value <= estimate.high, (name, estimate, value)


def trolley(**parts: Any) -> Reference:
    values: dict[str, Any] = {"base": 4000.0, "length": 6.0, "bending": BENDING, "column": 1200.0, "load": 1800.0}
    return Reference(**(values | {"count": 3} | parts))


class TestStops:
    def test_c11(self) -> None:
        result = solved(OVERHEAD)
        inside(result, "mast_deflection_max", 0.00964556)
        assert result.loads["mast_deflection_max"].estimate.value == pytest.approx(0.00964556, rel=2e-6)
        assert result.loads["natural_frequency[1]"].estimate.value == pytest.approx(21.0059, rel=3e-6)
        inside(result, "column_stiffness", C)
        assert result.health["energy_residual"] < 1e-12

    @pytest.mark.parametrize("decrement", [None, 0.15])
    def test_a_trolley_against_the_reference(self, decrement: float | None) -> None:
        """Damped as the file says: the lowest mode over a trolley that rolls loses the decrement."""
        data = changed(OVERHEAD, column__log_decrement=decrement) if decrement else OVERHEAD
        ratio = 0.0
        if decrement:
            plain = trolley()
            zeta = decrement / math.hypot(2 * math.pi, decrement)
            ratio = zeta * float(plain.held()[0] / plain.rolling()[0])
        found = run(trolley(held_ratio=ratio), 1.0, lambda t: 9000.0, 1.1)
        result = solved(data)
        assert result.loads["brake_time"].estimate.value == pytest.approx(found.stands, rel=2e-4)
        assert result.loads["mast_force_max"].estimate.value == pytest.approx(C * found.high, rel=2e-4)

    def test_a_bridge_whose_girders_give(self) -> None:
        """The bridge is braked, the trolley hangs on girders that shift and turn, weights pull on the column."""
        girders = {"girder_vertical": "120000 cm^4", "girder_horizontal": "16000 cm^4"}
        data = changed(
            OVERHEAD,
            bridge=OVERHEAD["bridge"] | girders,
            column={"length": "6 m", "mass": "1200 kg", "second_moment": "20000 cm^4"},
            bridge_travel={"speed": "0.6 m/s", "braking_force": "6 kN"},
            scenes=[{"type": "brake", "mechanism": "bridge"}],
        )
        turn = 36 / 6.68471e-6
        other = Reference(
            3000.0, 6.0, 210e9 * 2e-4, 1200.0, 1800.0, 4, pull=9.81, turn=turn, shift=1 / 1.39265e-6, root=4000.0
        )
        found = run(other, 0.6, lambda t: 6000.0, 2.2)
        result = solved(data, 1, gravity=True)
        assert result.loads["mast_deflection_max"].estimate.value == pytest.approx(found.high, rel=2e-4)
        assert result.loads["brake_time"].estimate.value == pytest.approx(found.stands, rel=2e-4)
        assert result.loads["natural_frequency[1]"].estimate.value == pytest.approx(other.rolling()[0], rel=1e-4)

    def test_settling_against_dense_looks(self) -> None:
        data = changed(OVERHEAD, settling={"window": "3 mm", "wait": "5 s"}, column__log_decrement=0.3)
        plain = trolley(count=2)
        zeta = 0.3 / math.hypot(2 * math.pi, 0.3)
        reference = trolley(count=2, held_ratio=zeta * float(plain.held()[0] / plain.rolling()[0]))
        found = run(reference, 1.0, lambda t: 9000.0, 2.6)
        last = found.times[np.abs(found.tips) > 0.003].max() - found.stands
        estimate = solved(data, 1).loads["settling_time"].estimate
        assert estimate.value == pytest.approx(last, abs=1e-3)
        assert estimate.high - estimate.low < 1e-3 * estimate.value

    def test_a_leaning_column_settles_into_what_its_lean_leaves_of_the_window(self) -> None:
        """1 t at 0.2 m makes it lean by 0.82 mm: on the side where that is worse it stays within 3 mm for good."""
        data = changed(
            OVERHEAD,
            settling={"window": "3 mm", "wait": "9 s"},
            column__log_decrement=0.3,
            carriage__load_arm_across="0.2 m",
        )
        plain = trolley(count=2)
        zeta = 0.3 / math.hypot(2 * math.pi, 0.3)
        reference = trolley(count=2, held_ratio=zeta * float(plain.held()[0] / plain.rolling()[0]))
        found = run(reference, 1.0, lambda t: 9000.0, 3.2)
        lean = 1000 * 9.81 * 0.2 * 36 / 2 / BENDING
        last = [found.times[np.abs(found.tips + side) > 0.003].max() - found.stands for side in (lean, -lean)]
        estimate = solved(data, 1).loads["settling_time"].estimate
        assert estimate.value == pytest.approx(max(last), abs=1e-3)
        assert abs(last[0] - last[1]) > 1e-2

    def test_a_column_that_leans_out_of_the_window_never_settles(self) -> None:
        data = changed(OVERHEAD, settling={"window": "3 mm"}, column__log_decrement=0.3)
        found = solved(changed(data, carriage__load_arm_across="0.9 m")).loads["settling_time"]
        assert math.isinf(found.estimate.value)
        assert found.note == "at rest already outside the window"

    def test_a_start_reaches_its_speed(self) -> None:
        data = changed(OVERHEAD, scenes=[{"type": "start", "mechanism": "trolley"}])
        found = run(trolley(), 0.0, lambda t: 6000.0, 1.4, wanted=1.0)
        result = solved(data)
        assert result.loads["start_time"].estimate.value == pytest.approx(found.stands, rel=2e-4)
        assert result.loads["mast_deflection_max"].estimate.value == pytest.approx(-found.low, rel=2e-4)

    def test_a_ramp_of_speed(self) -> None:
        """The base stops when it is told to; the column swings by at most twice its lag."""
        ramp = {"speed": "2 m/s", "acceleration": "0.5 m/s^2", "deceleration": "0.5 m/s^2", "ramp_rise": "0.4 s"}
        result = solved(changed(RACK, travel=ramp))
        assert result.loads["brake_time"].estimate.value == pytest.approx(4.4, rel=1e-12)
        lag = 0.5 * (1500 + 3 / 8 * 1500) / result.loads["column_stiffness"].estimate.value
        assert 0.9 * lag < result.loads["mast_deflection_max"].estimate.value < 2.1 * lag


class TestCollision:
    @pytest.mark.parametrize("contact", ["elastic", "plastic"])
    def test_against_the_reference(self, contact: str) -> None:
        block = {"contact": contact} | ({"stiffness": "30 MN/m"} if contact == "elastic" else {})
        data = changed(
            OVERHEAD,
            obstacle=block,
            scenes=[{"type": "obstacle", "mechanism": "trolley"}],
            column__log_decrement=0.4,
        )
        plain = trolley(count=3)
        zeta = 0.4 / math.hypot(2 * math.pi, 0.4)
        reference = trolley(count=3, held_ratio=zeta * float(plain.held()[0] / plain.rolling()[0]))
        wall = Wall(30e6 if contact == "elastic" else None)
        found = run(reference, 1.0, lambda t: 9000.0, 0.3, wall=wall)
        result = solved(data, 1)
        assert result.loads["collision_deflection"].estimate.value == pytest.approx(-found.low, rel=5e-3)
        assert result.loads["collision_force"].estimate.value == pytest.approx(-found.low * C, rel=5e-3)
        if contact == "elastic":
            assert result.loads["contact_force"].estimate.value == pytest.approx(found.push, rel=5e-3)
        else:
            assert not result.loads["contact_force"].estimate.bounded

    @pytest.mark.parametrize("drive", ["off", "on"])
    @pytest.mark.parametrize("brake", ["off", "on"])
    def test_never_above_the_bound(self, drive: str, brake: str) -> None:
        """v (c m)^(1/2), and P + (P^2 + c m v^2)^(1/2) with the drive on."""
        scene = {"type": "obstacle", "mechanism": "trolley", "drive": drive, "brake": brake}
        data = changed(OVERHEAD, obstacle={"stiffness": "30 MN/m"}, scenes=[scene])
        force = solved(data).loads["collision_force"].estimate
        push = 6000.0 if drive == "on" else 0.0
        assert force.high <= push + math.hypot(push, math.sqrt(C * 7000))

    @pytest.mark.parametrize("restitution", [1.0, 0.6, 0.2])
    def test_a_restitution_takes_energy(self, restitution: float) -> None:
        """The contact force of a dashpot is one of its own; the column's stays within the bound."""
        block = {"stiffness": "30 MN/m", "restitution": restitution}
        scene = {"type": "obstacle", "mechanism": "trolley"}
        result = solved(changed(OVERHEAD, obstacle=block, scenes=[scene]))
        assert result.health["energy_residual"] < 1e-8
        assert result.loads["contact_force"].estimate.bounded == (restitution == 1.0)
        assert result.loads["collision_force"].estimate.high <= math.sqrt(C * 7000)


class TestBars:
    def test_coarse_bars_hold_the_fine_values(self) -> None:
        """On a seeded sample of machines everything the coarsest refinement says lies within its bars."""
        rng = np.random.default_rng(20)
        for _ in range(5):
            data = random_stacker(rng)
            coarse, fine = solved(data), solved(data, 1)
            for name, one in fine.loads.items():
                found = coarse.loads[name].estimate
                assert found.low - one.estimate.bar <= one.estimate.value <= found.high + one.estimate.bar, (name, data)


class TestHard:
    def test_a_load_that_pulls_its_base_through_the_brake(self) -> None:
        data = changed(OVERHEAD, trolley={"mass": "300 kg", "gauge": "2 m"}, load="4 t")
        data["trolley_travel"] = {"speed": "1 m/s", "braking_force": "3 kN"}
        result = solved(data)
        assert any("pulls the base through" in one.message for one in result.findings)
        assert sum(event.element == "base" for event in result.events) > 2
        assert result.health["energy_residual"] < 1e-9

    def test_a_column_that_buckles(self) -> None:
        data = changed(RACK, column__second_moment="50 cm^4")
        with pytest.raises(NumericsError, match="buckles"):
            solved(data, gravity=True)
        assert math.isfinite(solved(data).loads["mast_deflection_max"].estimate.value)

    @pytest.mark.parametrize("rise", ["1 ms", "1 h"])
    def test_rises_of_a_millisecond_and_of_an_hour(self, rise: str) -> None:
        data = changed(OVERHEAD, column__log_decrement=0.1)
        data["trolley_travel"] = {"speed": "1 m/s", "braking_force": "9 kN", "braking_rise": rise}
        result = solved(data)
        assert math.isfinite(result.loads["brake_time"].estimate.value)
        assert result.health["energy_residual"] < 1e-9

    def test_a_head_with_play(self) -> None:
        data = changed(RACK, column__top_guide={"stiffness": "2 MN/m", "gap": "3 mm"})
        loose, free = solved(data), solved(RACK)
        assert any(event.element == "guide" for event in loose.events)
        assert loose.loads["mast_deflection_max"].estimate.value < free.loads["mast_deflection_max"].estimate.value
        assert loose.health["energy_residual"] < 1e-9

    @pytest.mark.parametrize("contact", [{"contact": "plastic"}, {"contact": "elastic", "stiffness": "30 MN/m"}])
    def test_a_column_of_a_gram(self, contact: dict[str, Any]) -> None:
        """Modes too faint to be seen are not followed: the work is that of the two masses it really is."""
        hit = changed(
            OVERHEAD,
            column__mass="1 g",
            obstacle=contact,
            scenes=[{"type": "obstacle", "mechanism": "trolley", "speed_share": 0.8}],
        )
        fine = modal.run(spec_of(hit), spec_of(hit).all_scenes[0], modal.ALWAYS, 2)
        assert fine.work < 3000
        light = modal.run(spec_of(changed(hit, column__mass="1 kg")), spec_of(hit).all_scenes[0], modal.ALWAYS, 0)
        value, other = (one.loads["collision_force"].estimate.value for one in (fine, light))
        assert value == pytest.approx(other, rel=1e-3)

    def test_no_damping_never_settles(self) -> None:
        """Without a decrement there is no settling time to give."""
        data = changed(OVERHEAD, settling={"window": "3 mm", "wait": "5 s"})
        assert "settling_time" not in solved(data).loads

    def test_predicted_seconds_grow_with_the_refinement(self) -> None:
        spec = spec_of(OVERHEAD)
        scene = spec.all_scenes[0]
        costs = [modal.MAST_MODAL.cost(spec, scene, modal.ALWAYS, level) for level in range(3)]
        assert 0 < costs[0] < costs[1] < costs[2] < 2
        assert model.mechanism(spec, scene) == "trolley"


def test_a_guide_at_the_head_is_no_part_of_the_stiffness_of_the_column() -> None:
    """Which is what turns a swing into a force: with the guide in it standing told another stiffness than weights."""
    free, held = (
        modal.run(spec, spec.all_scenes[0], frozenset(), 0).loads["column_stiffness"].estimate
        for spec in (
            spec_of(changed(RACK, scenes=[{"type": "stand"}])),
            spec_of(changed(RACK, scenes=[{"type": "stand"}], column__top_guide={"stiffness": "2 MN/m"})),
        )
    )
    assert held.value == pytest.approx(free.value, rel=1e-9)


class TestTimes:
    @pytest.mark.parametrize("seed", [4007, 4009, 4012])
    def test_modes_left_out_are_in_the_bar_of_a_time(self, seed: int) -> None:
        """Half as many modes may by chance give the same time: of 4009 that difference was a fifth of the error."""
        data = random_stacker(np.random.default_rng(seed))
        spec = spec_of(data)
        assert spec.all_scenes[0].type == "start"
        column, load = spec.column, spec.load + spec.carriage.mass
        reference = Reference(
            float(data["base"]["mass"].split()[0]), column.length,
            model.filled(column.second_moment) * 210e9, column.mass, load, 40, turn=column.root_stiffness,
        )  # fmt: skip
        travel = data["travel"]
        force, rise = (float(travel.get(key, "0 x").split()[0]) for key in ("driving_force", "driving_rise"))
        exact = first_at_speed(reference, force, float(travel["speed"].split()[0]), rise)
        for level in (0, 1):
            found = solved(data, level).loads["start_time"].estimate
            assert found.low <= exact <= found.high
            assert found.bar <= 0.01 * found.value
