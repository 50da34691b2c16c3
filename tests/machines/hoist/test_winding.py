"""Scene `winding`: the paper's numbers from design files, what is right instead, the map against a general solver."""

import itertools
import math
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support.design_files import problems_of
from support.machines import changed, check_of, load_of, report_of, scene_of
from support.winding import DIAMETERS, PAPER, PRINTED, general, hoist, paper_force, variant

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.effect import EffectState
from ptmcalc.contract.report import FileReport, LoadReport
from ptmcalc.machines.hoist.winding.corrected import WINDING_CORRECTED
from ptmcalc.machines.hoist.winding.map import WINDING_MAP
from ptmcalc.machines.hoist.winding.paper import WINDING_PAPER

SPEED, MASS, G = 0.4 * math.pi, 5000.0, 9.81
STEP = 0.0175 * math.sqrt(3) / 2


def one(report: FileReport, name: str) -> LoadReport:
    return load_of(scene_of(report), name)


def number(data: dict[str, Any], name: str, solver: Any = WINDING_CORRECTED) -> float:
    spec = hoist(data)
    return float(solver.run(spec, spec.all_scenes[0], frozenset(), 0).loads[name].estimate.value)


class TestOfThePaper:
    @pytest.mark.parametrize(("length", "area"), PRINTED)
    def test_the_seven_printed_frequencies(self, length: str, area: str) -> None:
        printed = PRINTED[length, area]
        load = one(report_of(variant(length, area)), "winding_frequency")
        assert load.formula is not None
        assert load.formula.name == "winding_paper"
        assert f"{load.formula.value:.{len(printed.partition('.')[2])}f}".rstrip("0") == printed.rstrip("0")
        area_m2 = float(area.removesuffix(" mm^2")) * 1e-6
        right = 4 * math.sqrt(1.05e11 * area_m2 / (MASS * float(length.removesuffix(" m"))))
        assert load.estimate.value == pytest.approx(right, rel=1e-12)

    def test_takes_the_modulus_of_wire_by_itself(self) -> None:
        without = changed(PAPER, winding__paper_modulus=None)
        assert number(without, "winding_frequency", WINDING_PAPER) == number(PAPER, "winding_frequency", WINDING_PAPER)

    def test_of_the_worked_case(self) -> None:
        """C24: seven ratios with the amplitude w^2 d, and the stretch and stress of the first."""
        ratios = [0.00289878, 0.00299129, 0.00309695, 0.00321996, 0.00253049, 0.00217405, 0.00182758]
        for (length, area), expected in zip(PRINTED, ratios, strict=True):
            found = number(variant(length, area), "winding_stress_ratio", WINDING_PAPER)
            assert found == pytest.approx(expected, rel=3e-6)
        assert number(PAPER, "winding_displacement_max", WINDING_PAPER) == pytest.approx(0.000950277, rel=2e-6)
        assert number(PAPER, "winding_stress_max", WINDING_PAPER) == pytest.approx(1.24724e6, rel=3e-6)

    def test_with_tackle_and_climb_put_right(self) -> None:
        """C24: the paper's modulus in a tackle of four falls, 21.88 rad/s and 0.236 % of the mean stress."""
        wire = changed(PAPER, rope__modulus="210 GPa")
        assert number(wire, "winding_frequency") == pytest.approx(21.8815, rel=1e-5)
        assert number(wire, "winding_stress_ratio") == pytest.approx(0.00236005, rel=2e-5)

    def test_says_that_its_claim_does_not_follow(self) -> None:
        report = report_of(PAPER)
        (said,) = (d.message for d in report.diagnostics if d.code == "NUM107" and "published" in d.message)
        assert "7 % to 18 %" in said
        assert "0.2899 %" in said
        assert "0.2212 %" in said
        assert one(report, "winding_stress_ratio").estimate.value == pytest.approx(0.002212, rel=1e-3)
        assert one(report, "winding_stress_ratio").estimate.high < 0.07

    @pytest.mark.parametrize(("length", "area"), PRINTED)
    def test_its_figures(self, length: str, area: str) -> None:
        """Deflection and stress over time for four ropes and four lengths, against DOP853."""
        report = report_of(variant(length, area), histories=True)
        q, s = (one(report, f"winding_{what}_paper").history for what in ("displacement", "stress"))
        assert q is not None
        assert s is not None
        area_m2, rope = float(area.removesuffix(" mm^2")) * 1e-6, float(length.removesuffix(" m"))
        k = math.sqrt(2.1e11 * area_m2 * G / (MASS * G * rope))
        times = np.asarray(q.times)
        assert times[0] == 0.0
        assert times[-1] == pytest.approx(10.0)
        diameter = float(DIAMETERS[area].removesuffix(" mm")) * 1e-3
        expected = general(k, paper_force(SPEED**2 * diameter, 5.0), 10.0, times, (5.0,))
        assert np.abs(np.asarray(q.values) - expected).max() <= 1e-8 * expected.max()
        assert np.asarray(s.values) == pytest.approx(2.1e11 * np.asarray(q.values) / rope, rel=1e-12)
        largest = one(report, "winding_displacement_paper").estimate.value
        assert max(q.values) <= largest * (1 + 1e-12)
        assert max(q.values) >= 0.99 * largest


class TestCorrected:
    def test_against_a_general_solver(self) -> None:
        spec = hoist(changed(PAPER, rope__damping=0.0))
        result = WINDING_CORRECTED.run(spec, spec.all_scenes[0], frozenset(), 0)
        k = 4 * math.sqrt(1.05e11 * 114e-6 / (MASS * 160.0))
        p, q = 3 / SPEED, 96 / SPEED
        size = p * q / (q - p) * SPEED**2 * STEP
        times = np.linspace(0, 1, 40_001)
        moved = general(k, lambda t: size * (math.exp(-3 * t) - math.exp(-96 * t)), 1.0, times)
        loads = {name: found.estimate.value for name, found in result.loads.items()}
        assert loads["winding_displacement_max"] == pytest.approx(moved.max(), rel=1e-7)
        assert loads["winding_stress_max"] == pytest.approx(1.05e11 * moved.max() / 160.0, rel=1e-7)
        mean = MASS * G / 4 / 114e-6
        assert loads["winding_stress_ratio"] == pytest.approx(1.05e11 * moved.max() / 160.0 / mean, rel=1e-7)

    def test_goes_with_the_speed_of_the_drum(self) -> None:
        """A slow climb is followed without a swing: stress with the square of the speed."""
        slow, slower = (number(changed(PAPER, speed__drum=f"{n} rpm"), "winding_stress_ratio") for n in (0.04, 0.02))
        assert slow / slower == pytest.approx(4.0, rel=0.02)

    def test_a_twin_tackle_of_eight_falls_is_two_of_four(self) -> None:
        twin = changed(PAPER, load="10 t", reeving__falls=8, reeving__ropes=2)
        for name in ("winding_frequency", "winding_stress_ratio", "winding_stress_max"):
            assert number(twin, name) == pytest.approx(number(PAPER, name), rel=1e-12)

    def test_square_layers_climb_by_the_whole_rope(self) -> None:
        ratio = number(changed(PAPER, winding__packing="square"), "winding_stress_ratio")
        assert ratio / number(PAPER, "winding_stress_ratio") == pytest.approx(2 / math.sqrt(3), rel=1e-9)


class TestMap:
    @pytest.mark.parametrize("damping", [0.0, 0.02])
    @pytest.mark.parametrize("hook", ["0 m", "39 m"])
    def test_against_a_general_solver(self, hook: str, damping: float) -> None:
        """Lengths and strain coupled, from the climb over the first turns of the layer."""
        data = changed(
            PAPER, rope__damping=damping, scenes=[{"type": "winding", "hook_height": hook}], least_fall="9 m"
        )
        spec = hoist(data)
        result = WINDING_MAP.run(spec, spec.all_scenes[0], frozenset(), 0)
        history = result.histories()["winding_stress_max"]
        low, arc, rise = 0.15 + 0.00875, math.pi / 3, 0.0175 - STEP
        angles, radii = [0.0, arc / 2, arc / 2 + arc], [low, low, low + STEP]
        for k in range(1, 6):
            begin = arc / 2 + k * math.pi
            angles += [begin, begin + arc / 2, begin + arc]
            radii += [low + STEP, low + STEP + rise, low + STEP]
        tensile, rope = 1.05e11 * 114e-6, 4 * (49.0 - float(hook.removesuffix(" m")))
        strain = MASS * G / 4 / tensile
        rate = 16 * tensile / MASS
        state, found, at = [rope / (1 + strain), rope / 4, SPEED * low / 4], [], []

        def speed(t: Any) -> Any:
            return SPEED * np.interp(SPEED * t, angles, radii)

        def force(t: Any, y: Any) -> Any:
            return 4 * y[1] / y[0] - 1 + 2 * damping * (speed(t) - 4 * y[2]) / y[0] / np.sqrt(rate / y[0])

        until = float(result.window[1]) if result.window else 0.0
        for begin, end in itertools.pairwise(angles):
            if begin / SPEED >= until:
                break
            run = solve_ivp(
                lambda t, y: [-speed(t) / (4 * y[1] / y[0]), -y[2], 4 * tensile * force(t, y) / MASS - G],
                (begin / SPEED, end / SPEED), state, "DOP853", dense_output=True, rtol=1e-12, atol=1e-14, max_step=0.02,
            )  # fmt: skip
            state = run.y[:, -1].tolist()
            times = np.asarray(history.times)
            times = times[(times >= begin / SPEED) & (times <= end / SPEED)]
            at.append(times)
            found.append(1.05e11 * (force(times, run.sol(times)) - strain))
        expected = np.concatenate(found)
        drawn = np.interp(np.concatenate(at), history.times, history.values)
        assert len(expected) > 100
        assert np.abs(drawn - expected).max() <= 3e-3 * np.abs(expected).max()

    def test_at_the_same_frequency_as_the_corrected_one(self) -> None:
        for name in ("winding_frequency", "winding_crossover_ratio", "winding_detuning"):
            assert number(PAPER, name, WINDING_MAP) == number(PAPER, name)

    def test_a_rope_that_the_drum_takes_in_whole_is_undecided(self) -> None:
        short = changed(PAPER, scenes=[{"type": "winding", "hook_height": "39.9 m"}])
        report = report_of(changed(short, checks={"winding_stress_ratio": 1e-5}))
        assert any("more rope than is free" in d.message for d in report.diagnostics)
        assert check_of(scene_of(report), "HST140").verdict is Verdict.UNDECIDED


class TestEffect:
    def test_is_simulated_where_the_file_wants_it_and_bounded_elsewhere(self) -> None:
        quick = changed(PAPER, speed__drum="60 rpm", rope__damping=0.05)
        assert [e.state for e in scene_of(report_of(PAPER)).effects] == [EffectState.SKIPPED]
        assert [e.state for e in scene_of(report_of(quick)).effects] == [EffectState.BOUNDED]
        report = report_of(changed(PAPER, effects={"layer_map": "on"}))
        assert [e.state for e in scene_of(report).effects] == [EffectState.SIMULATED]
        load = one(report, "winding_stress_ratio")
        assert load.solver == "winding_map"
        assert load.estimate.value == pytest.approx(0.00138513, rel=1e-4)
        assert load.estimate.bar < 1e-3 * load.estimate.value

    def test_is_simulated_where_a_verdict_hangs_on_it(self) -> None:
        report = report_of(changed(PAPER, checks={"winding_stress_ratio": 0.0016}))
        assert check_of(scene_of(report), "HST140").verdict is Verdict.PASS
        assert one(report, "winding_stress_ratio").solver == "winding_map"


class TestBadInput:
    @pytest.mark.parametrize(
        ("changes", "path", "said"),
        [
            ({"scenes": [{"type": "winding", "load": "empty"}]}, "load", "without a mass"),
            ({"scenes": [{"type": "winding", "hook_height": "40 m"}]}, "hook_height", "the free rope length is zero"),
            ({"winding__crossover": "181 deg"}, "crossover", "exceed one turn"),
        ],
    )
    def test_is_told_at_its_key(self, changes: dict[str, Any], path: str, said: str) -> None:
        (problem,) = problems_of(changed(PAPER, **changes))
        assert problem.path[-1] == path
        assert said in problem.message
        assert problem.hint

    @pytest.mark.parametrize(
        "changes",
        [
            {"speed__drum": "1e6 rpm"},
            {"speed__drum": "1e-9 rpm"},
            {"load": "1e9 t"},
            {"load": "1e-9 kg"},
            {"rope__modulus": "1 Pa"},
            {"rope__damping": 1},
            {"height": "1 mm"},
        ],
    )
    def test_what_nobody_can_compute_is_undecided(self, changes: dict[str, Any]) -> None:
        report = report_of(changed(PAPER, **changes))
        assert any(d.code in ("NUM101", "NUM102") for d in report.diagnostics)
        assert check_of(scene_of(report), "HST140").verdict is Verdict.UNDECIDED

    @pytest.mark.parametrize(
        "changes",
        [
            {"rope__modulus": "1e6 GPa"},
            {"height": "100 km"},
            {"rope__damping": 0.999},
            {"winding__crossover": "179.9999 deg"},
            {"drum__length": "53 mm"},
        ],
    )
    def test_the_rest_is_computed(self, changes: dict[str, Any]) -> None:
        assert check_of(scene_of(report_of(changed(PAPER, **changes))), "HST140").verdict is Verdict.PASS


class TestFindings:
    def test_where_the_rope_really_climbs(self) -> None:
        (said,) = (d for d in report_of(PAPER).diagnostics if d.code == "NUM104")
        layers = 640.0 / 17.5
        height = (layers - 3) * 2 * math.pi * (0.15 + 0.00875) / 4
        assert f"{height:.4g} m" in said.message
        told = changed(PAPER, scenes=[{"type": "winding", "hook_height": "8.4 m"}])
        assert not [d for d in report_of(told).diagnostics if d.code == "NUM104"]

    def test_where_it_never_climbs(self) -> None:
        low = changed(PAPER, height="8 m", scenes=[{"type": "winding", "layer": 3}])
        (said,) = (d for d in report_of(low).diagnostics if d.code == "NUM104")
        assert "never reaches layer 3" in said.message
