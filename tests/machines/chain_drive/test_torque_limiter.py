"""Torque limiters of chain conveyors against finite elements, hand-worked cases, and edges that turn a verdict."""

import math
from typing import Any

import numpy as np
import pytest
from support import limiter_ref
from support.chain_starts import KIND, built, random_chain, scraper
from support.limiter_ref import Rig
from support.machines import load_of, report_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.estimate import Estimate

LIMITER = {"torque": "20 kN*m", "tolerance": "10 %"}
RIGID_SHAPES = {
    "step": ({"shape": "step"}, lambda t: 1.0),
    "ramp": ({"shape": "ramp", "time": "0.4 s", "control": "torque"}, lambda t: min(t / 0.4, 1.0)),
}


def limited(data: dict[str, Any], **limiter: Any) -> dict[str, Any]:
    return data | {"torque_limiter": LIMITER | limiter}


def torque_of(data: dict[str, Any], solver: str, level: int = 0) -> Estimate:
    spec = built(data)
    run = next(one for one in KIND.solvers if one.name == solver)
    return run.run(spec, spec.all_scenes[0], run.always, level).loads["limiter_torque"].estimate


def drawn(seed: int, **scene: Any) -> dict[str, Any]:
    """A machine with Kelvin-Voigt damping whose load does not drive it, and no teeth."""
    rng = np.random.default_rng((3_104, seed))
    while True:
        data = random_chain(rng, **scene)
        data["chain"]["damping"] = {"ratio": 0.05}
        data["layout"]["resistance"]["stop_factor"] = 0.8
        rig = Rig(data)
        moves = rig.pull > 1.02 * rig.resistance(data["layout"]["resistance"]["start_factor"])
        if min(rig.rises(0.8)) > 0 and rig.leaving(1.5) > 0 and moves:
            return limited(data | {"effects": {"tooth_passing": "off"}})


class TestStart:
    @pytest.mark.parametrize("shape", RIGID_SHAPES)
    @pytest.mark.parametrize("takeup", ["gravity", "screw"])
    def test_the_scraper_against_elements(self, shape: str, takeup: str) -> None:
        profile, rise = RIGID_SHAPES[shape]
        data = limited(scraper(scenes=[{"type": "start", "profile": profile}], effects={"tooth_passing": "off"}))
        data["layout"]["takeup"] = {"type": takeup, "tension": "12 kN" if takeup == "gravity" else "40 kN"}
        found = torque_of(data, "limiter_start", 1)
        force, torque = limiter_ref.start(Rig(data), rise, 0.3)
        assert found.value == pytest.approx(Rig(data).arm * force, rel=0.01)
        assert found.low <= torque <= found.high

    @pytest.mark.parametrize("seed", range(8))
    def test_random_conveyors_against_elements(self, seed: int) -> None:
        data = drawn(seed)
        found = torque_of(data, "limiter_start", 1)
        force, _ = limiter_ref.start(Rig(data), lambda t: 1.0, 0.0)
        assert found.value == pytest.approx(Rig(data).arm * force, rel=0.015)

    def test_a_heavy_sprocket_takes_its_part(self) -> None:
        """The torque through the limiter accelerates the sprocket too: a rigid start by hand."""
        data = limited(scraper(effects={"chain_elasticity": "off"}), tolerance="5 %")
        data["sprocket"]["inertia"] = "400 kg*m^2"
        rig = Rig(data)
        drive = rig.rotor(rig.eta) + rig.sprocket
        still = rig.resistance(1.2)
        acceleration = (rig.pull - still) / (drive + rig.moving)
        by_hand = rig.arm * (still + (rig.moving + rig.sprocket) * acceleration)
        assert torque_of(data, "limiter_start").value == pytest.approx(by_hand, rel=1e-9)
        # what the motors give less what their own inertia takes
        assert by_hand == pytest.approx(rig.arm * (rig.pull - rig.rotor(rig.eta) * acceleration), rel=1e-9)

    def test_teeth_of_a_start_against_elements(self) -> None:
        data = limited(scraper())
        found = torque_of(data, "limiter_start_teeth", 1)
        rig = Rig(data)
        truth = [rig.arm * limiter_ref.toothed_start(rig, lead)[0] for lead in (0.0, 0.5)]
        assert found.low <= max(truth) <= found.high
        assert found.value == pytest.approx(max(truth), rel=0.04)

    def test_a_motor_curve_has_no_bound(self) -> None:
        data = limited(scraper())
        data["drive"]["motor"] = {"power": "30 kW", "speed": "1470 rpm"}
        report = report_of(data)
        assert ruling(report, "CHN134") is Verdict.UNDECIDED


class TestStop:
    @pytest.mark.parametrize("shaft", ["motor", "sprocket"])
    @pytest.mark.parametrize("seed", range(4))
    def test_random_conveyors_against_elements(self, shaft: str, seed: int) -> None:
        data = drawn(100 + seed)
        data["drive"]["gear"]["efficiency"] = 1.0
        taut = 5 * float(data["layout"]["takeup"]["tension"].split()[0])  # the brake must not make it slack
        data["layout"]["takeup"]["tension"] = f"{taut!r} N"
        rig = Rig(data)
        torque = 3 * rig.resistance(0.8) * rig.arm * (1.0 if shaft == "sprocket" else 1 / rig.ratio)
        brake = {"torque": f"{torque!r} N*m", "shaft": shaft, "delay": "0.1 s", "rise_time": "0.2 s"}
        data |= {"brake": brake, "scenes": [{"type": "stop"}]}
        found = torque_of(data, "limiter_stop", 1)
        assert found.bounded
        assert found.value == pytest.approx(rig.arm * limiter_ref.stop(rig, brake), rel=0.015)

    def test_a_coasting_chain_by_hand(self) -> None:
        """The motors drive the coasting chain through the limiter by their inertia."""
        data = limited(scraper(scenes=[{"type": "coast"}], effects={"chain_elasticity": "off"}))
        data["drive"]["gear"]["efficiency"] = 1.0
        rig = Rig(data)
        still, whole = rig.resistance(0.8), rig.rotor(1.0) + rig.sprocket + rig.moving
        by_hand = rig.arm * rig.rotor(1.0) * still / whole
        assert torque_of(data, "limiter_stop").value == pytest.approx(by_hand, rel=1e-9)


class TestRun:
    @pytest.mark.parametrize("seed", range(6))
    def test_random_conveyors_against_elements(self, seed: int) -> None:
        data = drawn(200 + seed)
        data["layout"]["takeup"]["type"] = "gravity"
        del data["drive"]
        data |= {"scenes": [{"type": "run"}]}
        found = torque_of(data, "limiter_run", 1)
        most, _ = limiter_ref.running(Rig(data))
        assert found.low * (1 - 1e-3) <= most <= found.high * (1 + 1e-3)

    def test_a_slow_chain_by_hand(self) -> None:
        """Without waves the torque of an even number of teeth is that of the effective pull at the largest arm."""
        data = limited(scraper(scenes=[{"type": "run"}], speed="1 mm/s"))
        found, rig = torque_of(data, "limiter_run"), Rig(data)
        assert found.value == pytest.approx(rig.arm * rig.resistance(1.0), rel=1e-3)
        assert found.high == pytest.approx(rig.radius * rig.resistance(1.0), rel=1e-3)


class TestJam:
    def test_by_hand(self) -> None:
        data = limited(scraper(scenes=[{"type": "run"}], speed="1 mm/s"), torque="8 kN*m")
        found = load_of(report_of(data).scenes[0], "tension_jam").estimate
        rig = Rig(data)
        assert found.value == pytest.approx(12e3 + 8.8e3 / rig.arm, rel=1e-9)
        assert found.low == pytest.approx(12e3 + 8.8e3 / rig.radius, rel=1e-9)
        assert found.high == pytest.approx(12e3 + 8.8e3 / rig.radius / math.cos(math.pi / 8), rel=0.01)
        safety = load_of(report_of(data).scenes[0], "safety_jam").estimate
        assert safety.value == pytest.approx(2 * 350e3 / 1.2 / found.value, rel=1e-9)

    def test_the_reserve_is_the_setting_over_the_mean_torque(self) -> None:
        data = limited(scraper(scenes=[{"type": "run"}]))
        rig = Rig(data)
        found = load_of(report_of(data).scenes[0], "limiter_reserve").estimate
        assert found.value == pytest.approx(20e3 / rig.arm / rig.resistance(1.0), rel=1e-9)


# -- edges ----------------------------------------------------------------------------------------------------------


def ruling(report: Any, code: str, scene: int = 0) -> Verdict:
    return next(one.verdict for one in report.scenes[scene].checks if one.code == code)


def test_a_setting_below_the_start_turns_the_verdict_and_opens_its_loads() -> None:
    data = scraper(scenes=[{"type": "start"}])
    holds = report_of(limited(data, torque="14 kN*m"))
    assert ruling(holds, "CHN134") is Verdict.PASS
    assert load_of(holds.scenes[0], "tension_start").estimate.bounded
    trips = report_of(limited(data, torque="8.5 kN*m"))
    assert ruling(trips, "CHN134") is Verdict.FAIL
    for name in ("tension_start", "safety_start", "start_time", "tension_min"):
        assert not load_of(trips.scenes[0], name).estimate.bounded, name
    assert ruling(trips, "CHN122") is Verdict.UNDECIDED
    assert any("the torque limiter slips" in one.message for one in trips.diagnostics)


def test_a_shear_pin_breaks() -> None:
    data = limited(scraper(scenes=[{"type": "start"}]), torque="8.5 kN*m", type="shear_pin")
    assert any("the torque limiter breaks" in one.message for one in report_of(data).diagnostics)


def test_an_assumed_tolerance_is_tried_at_both_ends() -> None:
    """At 5 % the limiter holds, at 20 % it may trip."""
    data = scraper(scenes=[{"type": "start"}]) | {"torque_limiter": {"torque": "10.5 kN*m"}}
    assert ruling(report_of(data), "CHN134") is Verdict.UNDECIDED
    assert ruling(report_of(scraper(scenes=[{"type": "start"}]) | {"torque_limiter": {"torque": "14 kN*m"}}),
                  "CHN134") is Verdict.PASS  # fmt: skip


@pytest.mark.parametrize(("torque", "verdict"), [("20 kN*m", Verdict.PASS), ("60 kN*m", Verdict.FAIL)])
def test_a_setting_too_high_does_not_protect_the_chain(torque: str, verdict: Verdict) -> None:
    data = limited(scraper(scenes=[{"type": "run"}], speed="0.1 m/s"), torque=torque)
    assert ruling(report_of(data), "CHN135") is verdict


@pytest.mark.parametrize(("reserve", "verdict"), [(1.25, Verdict.PASS), (1.5, Verdict.FAIL)])
def test_the_margin_of_the_file_decides(reserve: float, verdict: Verdict) -> None:
    data = limited(scraper(scenes=[{"type": "run"}]), torque="7 kN*m", reserve=reserve)
    assert ruling(report_of(data), "CHN136") is verdict


def test_without_a_limiter_nothing_changes() -> None:
    report = report_of(scraper(scenes=[{"type": "start"}]))
    assert all(check.code not in ("CHN134", "CHN135", "CHN136") for check in report.scenes[0].checks)
    assert all("limiter" not in load.info.name for load in report.scenes[0].loads)
