"""Starting gear of chain drives against an integration of its own by scipy: formula of Kloss, voltage, filling."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
import yaml
from scipy.integrate import solve_ivp
from support.chain_starts import KIND, built, scraper
from support.limiter_ref import Rig
from support.machines import load_of, report_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.estimate import Estimate
from ptmcalc.engine.load import load_text

GEARS = {
    "star-delta": {"starter": {"type": "star_delta", "switch_over": 0.85}},
    "soft": {"starter": {"type": "soft", "initial_voltage": 0.35, "time": "2.5 s"}},
    "coupling": {"fluid_coupling": {"torque_limit": 1.5, "slip": 0.03, "rise_time": "6 s"}},
}


@dataclass(frozen=True)
class Cage:
    """A cage motor by its plate: rated and synchronous speed, rated and breakdown torque."""

    rated_speed: float
    synchronous: float
    power: float
    overload: float

    @property
    def rated(self) -> float:
        return self.power / self.rated_speed

    def kloss(self, speed: float) -> float:
        slip, rated = 1 - speed / self.synchronous, 1 - self.rated_speed / self.synchronous
        most = rated * (self.overload + math.sqrt(self.overload**2 - 1))
        return 2 * self.overload * self.rated * slip * most / (slip**2 + most**2)

    def geared(self, gear: dict[str, Any], time: float, speed: float, star: bool) -> float:
        """Torque on the input shaft of the gear."""
        if "fluid_coupling" in gear:
            one = gear["fluid_coupling"]
            slip = 1 - speed / self.synchronous
            full = self.rated * min(slip / (1 - self.rated_speed / self.synchronous + one["slip"]), one["torque_limit"])
            return full * (1 - math.exp(-3 * time / float(one["rise_time"].split()[0])))
        one = gear["starter"]
        if one["type"] == "star_delta":
            return self.kloss(speed) / (3 if star else 1)
        voltage = one["initial_voltage"] + (1 - one["initial_voltage"]) * min(time / float(one["time"].split()[0]), 1)
        return self.kloss(speed) * voltage**2

    @property
    def data(self) -> dict[str, Any]:
        return {
            "inertia": "0.9 kg*m^2",
            "curve": {
                "type": "induction",
                "power": f"{self.power!r} W",
                "speed": f"{self.rated_speed!r} rad/s",
                "synchronous_speed": f"{self.synchronous!r} rad/s",
                "overload": self.overload,
            },
        }


def start_by_scipy(rig: Rig, cage: Cage, gear: dict[str, Any]) -> float:
    """Time to the speed of the file."""
    still, turns = rig.resistance(1.2), rig.ratio / rig.arm
    rotor = rig.at("drive", "coupling_inertia") + (0.0 if "fluid_coupling" in gear else 0.9)
    mass = rig.moving + rig.sprocket + rig.eta * rotor * turns**2
    switch = gear.get("starter", {}).get("switch_over", 0.0) * cage.synchronous / turns

    def rates(t: float, y: np.ndarray, star: bool) -> list[float]:
        force = rig.eta * turns * cage.geared(gear, t, y[0] * turns, star) - still
        return [max(force, 0.0) / mass if y[0] <= 0 else force / mass]

    now, speed = 0.0, 0.0
    for star, goal in ((True, switch), (False, rig.speed)):
        if goal <= speed:
            continue

        def there(t: float, y: np.ndarray, star: bool, goal: float = goal) -> float:
            return float(y[0] - goal)

        there.terminal = True  # type: ignore[attr-defined]
        run = solve_ivp(rates, (now, now + 60), [speed], "RK45", events=there, args=(star,), rtol=1e-8, atol=1e-10,
                        max_step=0.02)  # fmt: skip
        if not len(run.t_events[0]):
            return math.inf
        now, speed = float(run.t_events[0][0]), goal
    return now


def machine(seed: int, gear: dict[str, Any], strong: float = 1.0) -> tuple[dict[str, Any], Rig, Cage]:
    """A scraper whose motors run a little below their rated speed at the speed of the file."""
    rng = np.random.default_rng((5_512, seed))
    data = scraper(speed=f"{float(rng.uniform(0.3, 0.7))!r} m/s")
    data["layout"]["load"] = f"{float(rng.uniform(30, 120))!r} kg/m"
    rig = Rig(data)
    synchronous = 157.08
    rated_speed = synchronous * float(rng.uniform(0.965, 0.985))
    share = 0.93 if "fluid_coupling" in gear else 0.95
    ratio = share * synchronous * rig.arm / rig.speed
    needed = rig.resistance(1.2) * rig.arm / ratio / rig.eta
    cage = Cage(rated_speed, synchronous, strong * 9 * needed * rated_speed, float(rng.uniform(2.2, 3)))
    gearbox = {"ratio": ratio, "efficiency": 0.93}
    data["drive"] = {"motor": cage.data, "coupling_inertia": "0.15 kg*m^2", "gear": gearbox, **gear}
    return data, Rig(data), cage


def rigid(data: dict[str, Any]) -> dict[str, Estimate]:
    spec = built(data)
    solver = next(one for one in KIND.solvers if one.name == "chain_rigid_start")
    found = solver.run(spec, spec.all_scenes[0], frozenset(), 0).loads
    return {name: one.estimate for name, one in found.items()}


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("gear", GEARS)
def test_the_starting_time_is_that_of_scipy(gear: str, seed: int) -> None:
    data, rig, cage = machine(seed, GEARS[gear])
    found = rigid(data)["start_time"]
    truth = start_by_scipy(rig, cage, GEARS[gear])
    assert math.isfinite(truth)
    assert found.low - 1e-4 * truth <= truth <= found.high + 1e-4 * truth
    assert found.value == pytest.approx(truth, rel=2e-3)


def test_the_reserve_is_the_smallest_torque_on_the_way_up() -> None:
    """Of a third of the torque in star, at standstill or at the lowest point of the curve, by hand."""
    data, rig, cage = machine(1, GEARS["star-delta"])
    speeds = np.linspace(0, max(0.9 * rig.speed * rig.ratio / rig.arm, 0.85 * cage.synchronous), 4001)[:-1]
    torques = [cage.kloss(w) / (3 if w < 0.85 * cage.synchronous else 1) for w in speeds]
    by_hand = min(torques) * rig.eta * rig.ratio / rig.arm / rig.resistance(1.2)
    assert rigid(data)["starting_reserve"].value == pytest.approx(by_hand, rel=2e-3)


def test_a_rotor_behind_a_fluid_coupling_is_not_accelerated_with_the_chain() -> None:
    data, rig, _ = machine(2, GEARS["coupling"])
    driven = (rig.moving + rig.sprocket) * (rig.arm / rig.ratio) ** 2 / rig.eta
    assert rigid(data)["reduced_inertia"].value == pytest.approx(0.15 + driven, rel=1e-9)


@pytest.mark.parametrize(("strong", "verdict"), [(1.0, Verdict.PASS), (0.35, Verdict.FAIL)])
def test_a_motor_that_starts_directly_may_stall_in_star(strong: float, verdict: Verdict) -> None:
    for gear in ({}, GEARS["star-delta"]):
        data, _, _ = machine(3, gear, strong)
        report = report_of(data)
        said = next(one.verdict for one in report.scenes[0].checks if one.code == "CHN120")
        assert said is (verdict if gear else Verdict.PASS)
        if gear and verdict is Verdict.FAIL:
            assert math.isinf(load_of(report.scenes[0], "start_time").estimate.value)


@pytest.mark.parametrize(
    ("motor", "words"),
    [
        ({"inertia": "0.3 kg*m^2", "mean_starting_torque": "300 N*m"}, "it requires the curve of a cage motor"),
        ({"power": "30 kW", "poles": 4, "mean_starting_torque": "300 N*m"}, "does not follow it"),
    ],
)
def test_gear_that_the_start_would_not_follow_is_refused(motor: dict[str, Any], words: str) -> None:
    data = scraper()
    data["drive"] |= {"motor": motor, "starter": {"type": "star_delta"}}
    result = load_text(yaml.safe_dump(data).encode(), "case.yaml")
    assert result.spec is None
    assert [words in one.message for one in result.diagnostics] == [True]
