"""Chain drives with a verdict at an edge: the right value by hand, or by an integration here."""

import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from scipy.integrate import solve_ivp
from support.chain_starts import KIND, built, scraper
from support.command import ROOT
from support.machines import changed, check_of, load_of, report_of, scene_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.machines.chain_drive.machine.spec import EmergencyStop, Run, Start
from ptmcalc.machines.chain_drive.starting.motion import start_case

HERE = Path(__file__).parent
INDUCTION = {"type": "induction", "power": "30 kW", "speed": "1470 rpm", "synchronous_speed": "1500 rpm",
             "overload": 2.6}  # fmt: skip


def kloss(speed: float) -> float:
    """Torque of the motor above at a speed in rad/s: the formula of Kloss without stator resistance [N*m]."""
    rated = 30e3 / (1470 * math.pi / 30)
    pull_out = 0.02 * (2.6 + math.sqrt(2.6**2 - 1))
    slip = max(1 - speed / (1500 * math.pi / 30), 1e-9)
    return 2 * 2.6 * rated / (slip / pull_out + pull_out / slip)


def with_curve(**changes: Any) -> dict[str, Any]:
    data: dict[str, Any] = changed(scraper(speed="1.4 m/s"), **changes)
    data["drive"]["motor"] = {"inertia": "0.35 kg*m^2", "curve": INDUCTION}
    return data


class TestCurves:
    def test_a_start_reads_the_smallest_torque_of_the_curve(self) -> None:
        data = with_curve(drive__gear__ratio=21)
        scene = scene_of(report_of(data))
        arm = 8 * 0.16 / (2 * math.pi)
        resistance = load_of(scene, "static_resistance").estimate.value
        expected = kloss(0.0) * 21 * 0.93 / arm / resistance
        assert expected < 1, "its torque at rest is the smallest of all, and too small"
        reserve = load_of(scene, "starting_reserve").estimate
        assert reserve.value == pytest.approx(expected, rel=1e-3)
        assert check_of(scene, "CHN120").verdict is Verdict.FAIL
        assert load_of(scene, "start_time").estimate.low == math.inf

    def test_its_mean_would_lift_it(self) -> None:
        rated = np.linspace(0.0, 1470 * math.pi / 30, 2000)
        mean = float(np.mean([kloss(one) for one in rated]))
        assert mean > 1.5 * kloss(0.0)

    def test_a_default_start_follows_it(self) -> None:
        spec = built(with_curve(scenes=None))
        starts = [one for one in spec.all_scenes if isinstance(one, Start)]
        assert {one.profile.shape for one in starts} == {"curve"}


def test_conveyors_are_computed_loaded_and_empty_where_a_file_names_no_scene() -> None:
    spec = built(changed(scraper(), scenes=None))
    assert [(type(one), one.load) for one in spec.all_scenes] == [
        (Run, "full"), (Run, "empty"), (Start, "full"), (Start, "empty")]  # fmt: skip


class TestBars:
    def test_the_bound_of_the_polygon_has_a_bar_that_meets_itself(self) -> None:
        found = []
        for name in ("exact-moves-a", "exact-moves-b"):
            report = report_of(yaml.safe_load((HERE / f"{name}.yaml").read_text()))
            found.append(load_of(scene_of(report, "run_loaded"), "tension_polygon_bound").estimate)
        one, other = found
        assert one.low < one.high, "no exact value"
        assert other.low < other.high
        assert max(one.low, other.low) <= min(one.high, other.high)
        assert max(one.value, other.value) <= min(one.high, other.high) * (1 + 1e-3)


class TestStops:
    LOADED = {"drive": scraper()["drive"], "brake": {"torque": "60 N*m", "delay": "0.2 s"}}

    def test_the_limit_of_a_stop_is_that_of_an_emergency_stop(self) -> None:
        scenes = [{"type": "emergency_stop"}]
        short = scraper(**self.LOADED, checks={"stop_distance": "1 mm"}, scenes=scenes)
        assert check_of(scene_of(report_of(short)), "CHN124").verdict is Verdict.FAIL
        own = changed(short, checks__emergency_stop_distance="10 m")
        assert check_of(scene_of(report_of(own)), "CHN124").verdict is Verdict.PASS
        spec = built(short)
        assert isinstance(spec.all_scenes[0], EmergencyStop)

    def test_a_chain_that_runs_away_fails(self) -> None:
        data = changed(
            scraper(scenes=[{"type": "coast"}, {"type": "stop"}]),
            layout__lift="-20 m", layout__resistance__coefficient=0.1, layout__resistance__load_coefficient=0.1,
            checks__stop_time="60 s",
        )  # fmt: skip
        for scene in report_of(data).scenes:
            assert load_of(scene, "stop_time").estimate.low == math.inf
            assert check_of(scene, "CHN125").verdict is Verdict.FAIL

    @pytest.mark.parametrize(("shaft", "torque", "verdict"), [
        ("motor", 400.0, Verdict.PASS), ("motor", 1.0, Verdict.FAIL),
        ("sprocket", 16800.0, Verdict.PASS), ("sprocket", 42.0, Verdict.FAIL),
    ])  # fmt: skip
    def test_closed_brakes_hold_what_runs_back(self, shaft: str, torque: float, verdict: Verdict) -> None:
        data = changed(
            scraper(scenes=[{"type": "backstop"}], brake={"torque": f"{torque} N*m", "shaft": shaft}),
            layout__lift="30 m", layout__resistance__coefficient=0.05, layout__resistance__load_coefficient=0.05,
        )  # fmt: skip
        scene = scene_of(report_of(data))
        assert load_of(scene, "backstop_torque").estimate.value > 42.0, "friction alone does not hold it"
        judged = check_of(scene, "CHN129")
        assert judged.verdict is verdict
        assert judged.limit is not None
        assert judged.limit.value == pytest.approx(torque * (42 if shaft == "motor" else 1) / 1.25), "with a reserve"

    def test_friction_at_rest_decides_nothing_by_a_default(self) -> None:
        """A lift that friction holds at 0.8 of itself but not at the least there may be."""
        data = changed(scraper(scenes=[{"type": "backstop"}]), layout__resistance__stop_factor=None)

        def pull(lift: float) -> float:
            scene = scene_of(report_of(changed(data, layout__lift=f"{lift} m")))
            return float(load_of(scene, "backstop_torque").estimate.high)

        lift = next(lift for lift in np.arange(0.0, 40.0, 0.25) if pull(lift) > 0)
        near = report_of(changed(data, layout__lift=f"{lift - 0.25} m"))
        assert check_of(scene_of(near), "CHN129").verdict is Verdict.UNDECIDED


class TestBeyondRatedSpeed:
    """The force that accelerates the chain ends when it has its speed: then it swings on."""

    def spec(self, factor: float = 1.0) -> Any:
        return built(scraper(speed="0.05 m/s", scenes=[{"type": "start", "window_factor": factor}]))

    def test_a_pulse_shorter_than_half_a_swing_is_felt_behind_its_end(self) -> None:
        """x'' + 2 zeta w x' + w^2 x = w^2 in the pulse, 0 after it; the spring's force is x and its damper's share."""
        spec = self.spec()
        case = start_case(spec, spec.all_scenes[0])
        solver = next(one for one in KIND.solvers if one.name == "chain_one_mode")
        found = solver.run(spec, spec.all_scenes[0], solver.always, 0)
        from ptmcalc.machines.chain_drive.starting.motion import ratios
        from ptmcalc.machines.chain_drive.starting.waves import natural_frequencies

        frequencies = natural_frequencies(case, 1)
        w, zeta = float(frequencies[0]), float(ratios(spec, spec.all_scenes[0], frequencies)[0])
        assert w * case.end < math.pi / 2

        def motion(t: float, y: np.ndarray) -> list[float]:
            push = case.acceleration if t < case.end else 0.0
            return [y[1], push - 2 * zeta * w * y[1] - w * w * y[0]]

        run = solve_ivp(motion, (0, case.window), [0.0, 0.0], max_step=case.end / 50, rtol=1e-9, atol=1e-14)
        forces = case.masses.belt_mass * (w * w * run.y[0] + 2 * zeta * w * run.y[1])
        dynamic = found.loads["tension_dynamic_start"].estimate
        assert dynamic.value == pytest.approx(float(forces.max()), rel=2e-3)
        inside = float(forces[run.t <= case.end].max())
        assert dynamic.value > 1.1 * inside, "the window that ended with the pulse missed it"

    @pytest.mark.parametrize("name", ["chain_one_mode", "chain_start_waves"])
    def test_a_longer_look_stays_within_the_bar(self, name: str) -> None:
        solver = next(one for one in KIND.solvers if one.name == name)
        runs = [
            solver.run(spec, spec.all_scenes[0], solver.always, 0)
            for spec in (self.spec(one) for one in (1.0, 2.0, 4.0))
        ]
        for load, first in runs[0].loads.items():
            for later in runs[1:]:
                assert later.window is not None
                now = later.loads[load].estimate
                slack = 1e-9 * abs(now.value)
                assert first.estimate.low - slack <= now.value <= first.estimate.high + slack, load


def test_a_chain_that_goes_slack_in_its_start_fails_with_the_cure() -> None:
    data = changed(scraper(), layout__takeup__tension="100 N", drive__motor__mean_starting_torque="450 N*m")
    judged = check_of(scene_of(report_of(data)), "CHN123")
    assert judged.verdict is Verdict.FAIL


ROLLER = yaml.safe_load((ROOT / "specs" / "chain_drive" / "roller_drive.yaml").read_text("utf-8"))


def test_rows_without_a_source_do_not_lower_the_design_power() -> None:
    """ACA states the capacity of up to six rows; seven rows counted as 7.0 where six count as 4.6."""

    def design_power(rows: int) -> float:
        report = report_of(changed(ROLLER, chain__count=rows))
        return next(one.estimate.value for one in report.scenes[0].loads if one.info.name == "design_power")

    assert design_power(6) == pytest.approx(design_power(1) / 4.6, rel=1e-12)
    assert design_power(7) == design_power(6)


def test_advised_pitches_are_not_warned_of() -> None:
    data = changed(ROLLER, layout__centre_distance="0.985 m", layout__pitches=110)
    (warned,) = (one for one in report_of(data).diagnostics if one.code == "SPC201")
    advised = int(re.search(r"pitches: ([0-9]+)", warned.hint)[1])  # type: ignore[index]
    again = report_of(changed(data, layout__pitches=advised)).diagnostics
    assert [one for one in again if one.code == "SPC201"] == []
