"""Shafts at the edge of what a file may say: right against an integration of its own, or said to be unknown.

Nothing here may end in a traceback, in a number that is none, or in one that is wrong with a small bar.
"""

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
import yaml
from scipy.integrate import quad, solve_ivp
from support.command import ROOT
from support.machines import changed, check_of, load_of, report_of, scene_of
from support.shafts import C23, Reference

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.report import FileReport
from ptmcalc.machines.shaft.machine import steady

LINEAR: dict[str, Any] = {
    "kind": "shaft",
    "inertia": {"type": "constant", "value": "2 kg*m^2"},
    "drive": {
        "motor": {
            "type": "linear",
            "starting_torque": "100 N*m",
            "no_load_speed": "10 rad/s",
            "rated_torque": "50 N*m",
            "largest_torque": "90 N*m",
        },
        "gear": {"ratio": 1, "efficiency": 1},
    },
    "brake": {"torque": "50 N*m", "delay": "0 s"},
    "scenes": [{"type": "run_up"}, {"type": "steady"}, {"type": "run_out", "from": "0 rad"}],
}
"""A straight motor: everything about it has a closed form."""


def sectors(*spans: tuple[float, float, float]) -> dict[str, Any]:
    return {
        "type": "sectors",
        "sectors": [{"from": f"{a!r} rad", "to": f"{b!r} rad", "torque": f"{m!r} N*m"} for a, b, m in spans],
    }


def sound(report: FileReport) -> FileReport:
    """Every load is a number or infinite, its value inside its bar; what is not known is said."""
    assert [d for d in report.diagnostics if d.severity == "error" and not d.code.startswith("NUM")] == []
    for scene in report.scenes:
        for load in scene.loads:
            one = load.estimate
            assert not any(math.isnan(part) for part in (one.value, one.low, one.high)), load.info.name
            assert one.low <= one.value <= one.high, load.info.name
        for check in scene.checks:
            assert check.verdict is not Verdict.UNDECIDED or check.reason
    return report


def of(report: FileReport, scene: str, load: str) -> Estimate:
    return load_of(scene_of(report, scene), load).estimate


def close(found: Estimate, exact: float, rel: float = 1e-7) -> bool:
    """Whether the bar holds the exact value, or the value is as good as it."""
    held = found.low <= exact <= found.high and found.high - found.low <= 0.05 * abs(exact)
    return held or found.value == pytest.approx(exact, rel=rel)


# --- size ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("inertia", [1e-9, 1e-3, 1.0, 1e4, 1e12])
def test_inertias_of_twenty_decades(inertia: float) -> None:
    """t = J w0/M0 ln 20, phi = J w0^2/M0 (ln 20 - 0.95), and J w0/50 for the brake."""
    report = sound(report_of(changed(LINEAR, inertia__value=f"{inertia!r} kg*m^2", accuracy="0.001 %")))
    assert close(of(report, "run_up", "run_up_time"), inertia * math.log(20) / 10)
    assert close(of(report, "run_up", "run_up_angle"), inertia * (math.log(20) - 0.95))
    assert close(of(report, "run_out", "run_out_time"), inertia * 10 / 50)
    assert close(of(report, "run_out", "run_out_angle"), inertia * 50 / 50)
    assert of(report, "steady", "speed_mean").value == pytest.approx(10.0)


@pytest.mark.parametrize("scale", [1e-6, 1e6])
def test_the_worked_case_in_other_sizes(scale: float) -> None:
    """All torques and inertias so many times: speeds, times and angles stay the same."""
    plain = report_of(changed(C23, accuracy="0.001 %"))

    def times(text: str) -> str:
        number, unit = text.split()
        return f"{float(number) * scale!r} {unit}"

    data = changed(
        C23,
        accuracy="0.001 %",
        inertia__mean=times("34 kg*m^2"),
        inertia__terms__0__cosine=times("-4 kg*m^2"),
        drive__motor__power=times("5500 W"),
        load__sectors__0__torque=times("900 N*m"),
        losses__torque=times("35 N*m"),
        brake__torque=times("300 N*m"),
    )
    report = sound(report_of(data))
    for scene, names in {
        "run_up": ("run_up_time", "run_up_angle"),
        "steady": ("speed_min", "speed_max", "irregularity", "cycle_efficiency"),
        "run_out": ("run_out_time", "run_out_angle"),
    }.items():
        for name in names:
            assert of(report, scene, name).value == pytest.approx(of(plain, scene, name).value, rel=1e-8), name


@pytest.mark.parametrize("inertia", [1e-6, 1e-3, 0.05])
def test_hardly_an_inertia_follows_the_load(inertia: float) -> None:
    """Where the load holds for long enough, speed and torque are those of the balance: 10 (1 - M/100) rad/s."""
    data = changed(LINEAR, inertia__value=f"{inertia!r} kg*m^2", load=sectors((1.0, 3.0, 60.0)))
    report = sound(report_of(data))
    slow, fast = 2.0 / 4.0, (2 * math.pi - 2.0) / 10
    wanted = {"speed_min": 4.0, "speed_max": 10.0, "torque_motor_max": 60.0}
    wanted["torque_motor_rms"] = 60 * math.sqrt(slow / (slow + fast))
    for name, exact in wanted.items():
        found = of(report, "steady", name)
        assert not found.bounded or close(found, exact, max(1e-4, inertia / 2)), name
    assert inertia < 0.05 or of(report, "steady", "speed_min").bounded


def test_a_flywheel_of_a_million_times_the_need() -> None:
    data = changed(LINEAR, inertia__value="1e7 kg*m^2", load=sectors((1.0, 3.0, 60.0)), accuracy="0.01 %")
    report = sound(report_of(data))
    mean = 60 * 2 / (2 * math.pi)
    speed = 10 * (1 - mean / 100)
    assert close(of(report, "steady", "speed_mean"), speed, 1e-6)
    swing = 2.0 * (60 - mean)
    assert close(of(report, "steady", "irregularity"), swing / 1e7 / speed**2, 1e-4)


# --- a load nearly as large as the motor -----------------------------------------------------------------------------


@pytest.mark.parametrize("spare", [1e-2, 1e-4, 1e-6, 1e-9, 1e-12])
def test_a_load_that_nearly_stalls_the_motor(spare: float) -> None:
    """100 (1 - w/10) = 100 - spare: w = spare/10 rad/s."""
    data = changed(LINEAR, load=sectors((0.0, 2 * math.pi, 100 - spare)), scenes=[{"type": "steady"}])
    report = sound(report_of(data))
    check = check_of(scene_of(report), "SHF101")
    assert check.verdict in (Verdict.PASS, Verdict.UNDECIDED)
    if check.verdict is Verdict.PASS:
        found = of(report, "steady", "speed_mean")
        assert not found.bounded or close(found, (100 - (100 - spare)) / 10, 1e-5)
    if spare >= 1e-6:
        assert check.verdict is Verdict.PASS


@pytest.mark.parametrize("over", [1e-2, 1e-4, 1e-6, 1e-9, 1e-12])
def test_a_load_that_just_stalls_the_motor(over: float) -> None:
    data = changed(LINEAR, load=sectors((0.0, 2 * math.pi, 100 + over)), scenes=[{"type": "steady"}])
    report = sound(report_of(data))
    assert check_of(scene_of(report), "SHF101").verdict is Verdict.FAIL


@pytest.mark.parametrize("spare", [1e-3, 1e-6, 1e-9])
def test_a_start_against_nearly_the_whole_torque(spare: float) -> None:
    """J w' = spare - 10 w: to half of the end speed in J/10 ln 2, however small that speed is."""
    data = changed(
        LINEAR, losses={"torque": f"{100 - spare!r} N*m"}, scenes=[{"type": "run_up", "to": f"{spare / 20!r} rad/s"}]
    )
    report = sound(report_of(data))
    assert close(of(report, "run_up", "run_up_time"), 0.2 * math.log(2), 1e-5)


@pytest.mark.parametrize("share", [0.9999, 0.999999])
def test_a_speed_asked_for_next_to_the_end_speed(share: float) -> None:
    data = changed(LINEAR, scenes=[{"type": "run_up", "to": f"{10 * share!r} rad/s"}])
    report = sound(report_of(data))
    assert close(of(report, "run_up", "run_up_time"), -0.2 * math.log1p(-share), 1e-6)


def test_a_speed_asked_for_that_is_never_reached() -> None:
    data = changed(LINEAR, losses={"torque": "10 N*m"}, scenes=[{"type": "run_up", "to": "9.0000001 rad/s"}])
    report = sound(report_of(data))
    assert of(report, "run_up", "run_up_time").value == math.inf


# --- curves ----------------------------------------------------------------------------------------------------------


def points(*pairs: tuple[float, float]) -> dict[str, Any]:
    listed = [{"speed": f"{w!r} rad/s", "torque": f"{m!r} N*m"} for w, m in pairs]
    return {"type": "table", "points": listed, "rated_torque": "50 N*m"}


@pytest.mark.parametrize("width", [1e-1, 1e-3, 1e-6])
def test_a_motor_with_a_steep_end(width: float) -> None:
    """100 N*m up to 10 rad/s, then down to -100 N*m within a hair's breadth: 10 rad/s whatever the load."""
    motor = points((0.0, 100.0), (10.0, 100.0), (10.0 + width, -100.0))
    data = changed(LINEAR, drive__motor=motor, load=sectors((1.0, 2.0, 80.0)))
    data = changed(data, scenes=[{"type": "run_up", "to": "9 rad/s"}, {"type": "steady"}])
    report = sound(report_of(data))
    assert close(of(report, "run_up", "run_up_time"), 2 * 9 / 100)
    found = of(report, "steady", "speed_mean")
    assert not found.bounded or 10 - 1e-9 <= found.value <= 10 + width


def test_a_motor_with_jagged_points() -> None:
    """Time of the run-up by a quadrature of J/M between the points."""
    rng = np.random.default_rng(11)
    speeds = np.sort(np.append(rng.uniform(0, 10, 60), [0.0, 10.0]))
    torques = np.append(rng.uniform(20, 100, 61), 0.0)
    motor = points(*zip(speeds.tolist(), torques.tolist(), strict=True))
    report = sound(report_of(changed(LINEAR, drive__motor=motor, scenes=[{"type": "run_up", "to": "9.5 rad/s"}])))
    inside = [w for w in speeds.tolist() if 0 < w < 9.5]
    edges = [0.0, *inside, 9.5]
    exact = sum(quad(lambda w: 2 / np.interp(w, speeds, torques), a, b)[0] for a, b in pairwise(edges))
    assert close(of(report, "run_up", "run_up_time"), exact)


@pytest.mark.parametrize("swing", [0.9, 0.999, 0.999999])
def test_an_inertia_that_nearly_vanishes(swing: float) -> None:
    """J = 2 (1 + swing cos 2 phi) without any torque of the load: the motion against scipy."""
    inertia = {"type": "harmonics", "mean": "2 kg*m^2", "terms": [{"order": 2, "cosine": f"{2 * swing!r} kg*m^2"}]}
    data = changed(LINEAR, inertia=inertia, scenes=[{"type": "run_up", "to": "3 rad/s"}], brake=None)
    report = sound(report_of(data))
    found = of(report, "run_up", "run_up_time")

    def rates(t: float, y: Any) -> list[float]:
        phi, w = y
        value, slope = 2 * (1 + swing * math.cos(2 * phi)), -4 * swing * math.sin(2 * phi)
        return [w, (100 * (1 - w / 10) - slope * w * w / 2) / value]

    def reached(t: float, y: Any) -> float:
        return float(y[1] - 3)

    reached.terminal = True  # type: ignore[attr-defined]
    done = solve_ivp(rates, (0, 10), [0.0, 0.0], method="DOP853", rtol=1e-12, atol=1e-12, events=reached)
    assert not found.bounded or close(found, float(done.t_events[0][0]), 1e-6)


@pytest.mark.parametrize("width", [1e-2, 1e-4, 1e-6])
def test_a_blow_of_a_sector(width: float) -> None:
    """A stroke of 20 J within less and less of a turn: it takes 20 J from 2 kg*m^2, however short it is."""
    data = changed(LINEAR, load=sectors((1.0, 1.0 + width, 20 / width)), scenes=[{"type": "steady"}])
    report = sound(report_of(data))
    slow, fast = (of(report, "steady", name) for name in ("speed_min", "speed_max"))
    assert slow.bounded
    assert fast.bounded
    assert of(report, "steady", "work_useful").value == pytest.approx(20.0, rel=1e-8)
    lost = (fast.value**2 - slow.value**2) * 2 / 2
    assert lost == pytest.approx(20.0, abs=100 * width + 1e-6)


# --- losses ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("useful", [1e-3, 1e-6, 1e-9, 0.0])
def test_a_machine_that_does_next_to_nothing_useful(useful: float) -> None:
    """psi = A_loss/A_drive towards 1: it still moves."""
    data = changed(LINEAR, losses={"torque": "50 N*m"}, scenes=[{"type": "steady"}])
    if useful:
        data = changed(data, load=sectors((0.0, 2 * math.pi, useful)))
    report = sound(report_of(data))
    assert check_of(scene_of(report), "SHF101").verdict is Verdict.PASS
    assert of(report, "steady", "loss_factor").value == pytest.approx(50 / (50 + useful), rel=1e-12)
    assert close(of(report, "steady", "speed_mean"), 10 * (1 - (50 + useful) / 100))


def test_no_losses_at_all() -> None:
    report = sound(report_of(changed(LINEAR, load=sectors((0.0, 2 * math.pi, 30.0)))))
    assert of(report, "steady", "cycle_efficiency").value == 1.0
    assert of(report, "steady", "loss_factor").value == 0.0
    assert close(of(report, "run_out", "run_out_angle"), 2 * 7**2 / 2 / 50)


def test_without_losses_and_brake_a_shaft_coasts_for_ever() -> None:
    data = changed(LINEAR, brake=None)
    report = sound(report_of(data))
    assert of(report, "run_out", "run_out_time").value == math.inf
    assert of(report, "run_out", "run_out_angle").value == math.inf


def test_viscous_losses_alone_never_stop_it() -> None:
    report = sound(report_of(changed(LINEAR, brake=None, losses={"viscous": "1 N*m*s/rad"})))
    assert of(report, "run_out", "run_out_time").value == math.inf


@pytest.mark.parametrize("friction", [1e-2, 1e-4])
def test_a_very_long_run_out(friction: float) -> None:
    """J w^2/(2 R): up to a million radians."""
    report = sound(report_of(changed(LINEAR, brake=None, losses={"torque": f"{friction!r} N*m"})))
    speed = 10 * (1 - friction / 100)
    assert close(of(report, "run_out", "run_out_angle"), speed**2 / friction)
    assert close(of(report, "run_out", "run_out_time"), 2 * speed / friction)


def test_a_long_run_out_of_an_inertia_that_swings() -> None:
    """Only the inertia at its beginning counts for the angle; the time against scipy over the angle."""
    data = changed(
        C23,
        brake=None,
        losses={"torque": "0.5 N*m"},
        load=None,
        checks={},
        scenes=[{"type": "run_out", "from": "0 rad"}],
    )
    report = sound(report_of(data))
    found, energy = of(report, "run_out", "run_out_angle"), of(report, "run_out", "kinetic_energy")
    assert not found.bounded or close(found, energy.value / 0.5, 1e-6)
    time = of(report, "run_out", "run_out_time")

    # dt over the angle, with the angle left put as u^2: nothing is singular at rest
    turns = np.sqrt(np.linspace(0, energy.value / 0.5, 40001))
    nodes, weights = np.polynomial.legendre.leggauss(6)
    middle, half = (turns[1:] + turns[:-1]) / 2, np.diff(turns) / 2
    u = (middle[:, None] + half[:, None] * nodes).ravel()
    phi = energy.value / 0.5 - u * u
    exact = float(np.sum(np.sqrt(34 - 4 * np.cos(2 * phi)) * 2 * (half[:, None] * weights).ravel()))
    assert not time.bounded or close(time, exact, 1e-6)


# --- angles ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("turns", [-1, 159155])
def test_angles_of_many_turns(turns: int) -> None:
    """Every angle moved by so many turns, up to a million radians, changes nothing."""
    off = turns * 2 * math.pi
    plain = changed(
        C23,
        accuracy="0.01 %",
        checks=None,
        load=sectors((4.7, 6.2, 900.0)),
        scenes=[{"type": "run_up", "from": "1 rad"}, {"type": "steady"}, {"type": "run_out", "from": "2 rad"}],
    )
    moved = changed(
        plain,
        load=sectors((4.7 + off, 6.2 + off, 900.0)),
        scenes__0__from=f"{1 + off!r} rad",
        scenes__2__from=f"{2 + off!r} rad",
    )
    one, other = report_of(plain), sound(report_of(moved))
    for scene in one.scenes:
        for load in scene.loads:
            found = of(other, scene.name, load.info.name)
            assert found.value == pytest.approx(load.estimate.value, rel=1e-7, abs=1e-12), load.info.name


def test_a_cycle_of_many_turns() -> None:
    """A load that repeats every turn is the same over a cycle of twenty."""
    plain = changed(C23, accuracy="0.01 %", checks=None, scenes=[{"type": "steady"}])
    plain = changed(plain, load=sectors((3 * math.pi / 2, 2 * math.pi, 900.0)))
    spans = [(3 * math.pi / 2 + 2 * math.pi * k, 2 * math.pi * (k + 1), 900.0) for k in range(20)]
    long = changed(plain, cycle_angle=f"{40 * math.pi!r} rad", load=sectors(*spans))
    one, other = report_of(plain), sound(report_of(long))
    for name in ("speed_min", "speed_max", "irregularity", "torque_motor_rms", "cycle_efficiency"):
        assert of(other, "steady", name).value == pytest.approx(of(one, "steady", name).value, rel=1e-8), name


def test_a_tiny_cycle() -> None:
    data = changed(
        LINEAR,
        cycle_angle="1e-3 rad",
        load=sectors((0.0, 5e-4, 60.0)),
        scenes=[{"type": "steady"}],
    )
    report = sound(report_of(data))
    found = of(report, "steady", "speed_mean")
    assert not found.bounded or close(found, 7.0, 1e-6)


def test_corners_next_to_each_other() -> None:
    """Sectors that meet, overlap and leave gaps of a thousandth of a milliradian, beside an inertia in points."""
    spans = [(1.0, 2.0, 300.0), (2.0, 3.0, 300.0), (3.0 + 1e-6, 4.0, 300.0), (3.5, 3.5 + 1e-9, 7.0)]
    plain = changed(C23, accuracy="0.01 %", load=sectors((1.0, 4.0, 300.0)), scenes=[{"type": "steady"}])
    one, other = report_of(plain), sound(report_of(changed(plain, load=sectors(*spans))))
    for name in ("speed_min", "speed_max", "irregularity"):
        assert of(other, "steady", name).value == pytest.approx(of(one, "steady", name).value, rel=1e-5), name


# --- gear, rotor, brake ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("rotor", [0.05, 0.5])
def test_a_rotor_that_pushes_the_shaft_and_is_pushed(rotor: float) -> None:
    """The power through the gear turns several times a cycle: speeds against an integration of its own."""
    data = changed(C23, drive__motor_inertia=f"{rotor!r} kg*m^2", accuracy="0.001 %", scenes=[{"type": "steady"}])
    report = sound(report_of(data))
    found = Reference(data).cycle()
    for name in ("speed_min", "speed_max", "irregularity", "torque_motor_rms"):
        assert of(report, "steady", name).value == pytest.approx(found[name], rel=3e-8), name


def test_two_corners_of_the_gear_in_one_stretch_are_both_seen() -> None:
    """The power turns back and forth within 0.17 rad: the balance of works closes, and the speeds are right."""
    data: dict[str, Any] = {
        "kind": "shaft",
        "inertia": {"type": "harmonics", "mean": "123.98187406242548 kg*m^2",
                    "terms": [{"order": 2, "cosine": "8.4700025489782576 kg*m^2"}]},
        "drive": {
            "motor": {"type": "induction", "power": "4340.4836303962884 W", "speed": "96.672024326155551 rad/s",
                      "synchronous_speed": "104.7 rad/s", "overload": 2.6930765647314425},
            "gear": {"ratio": 9.84139686238272, "efficiency": 0.9128282312951403},
            "motor_inertia": "0.38403071469108596 kg*m^2",
        },
        "load": sectors((0.45256147681226039, 1.7119101744245515, 1400.2327707185211)),
        "losses": {"torque": "38.662513740397941 N*m"},
        "scenes": [{"type": "steady"}],
    }  # fmt: skip
    report = sound(report_of(data))
    assert scene_of(report).health["energy_residual"] < 1e-9
    found = Reference(data, rtol=1e-13).cycle()
    for name in ("speed_min", "speed_max", "irregularity"):
        assert of(report, "steady", name).value == pytest.approx(found[name], rel=1e-9), name


@pytest.mark.parametrize("torque", [1e-6, 1e9])
def test_brakes_of_any_strength(torque: float) -> None:
    data = changed(LINEAR, brake__torque=f"{torque!r} N*m", losses={"torque": "1 N*m"}, scenes=[LINEAR["scenes"][2]])
    report = sound(report_of(data))
    assert close(of(report, "run_out", "run_out_angle"), 2 * 9.9**2 / 2 / (torque + 1))
    assert close(of(report, "run_out", "run_out_time"), 2 * 9.9 / (torque + 1))


def test_a_brake_that_comes_too_late() -> None:
    """Friction has stopped the shaft before the brake is on."""
    data = changed(LINEAR, brake={"torque": "50 N*m", "delay": "1e6 s", "rise": "1 s"}, losses={"torque": "1 N*m"})
    report = sound(report_of(data))
    assert close(of(report, "run_out", "run_out_time"), 2 * 9.9)


def test_limits_that_no_brake_keeps_and_that_none_is_needed_for() -> None:
    braked = changed(LINEAR, brake__delay="0.5 s", losses={"torque": "1 N*m"}, scenes=[LINEAR["scenes"][2]])
    never = sound(report_of(changed(braked, checks={"stop_angle": "1 rad"})))
    assert of(never, "run_out", "brake_torque_needed").value == math.inf
    assert check_of(scene_of(never), "SHF105").verdict is Verdict.FAIL
    idle = sound(report_of(changed(braked, checks={"stop_angle": "1000 rad", "stop_time": "1000 s"})))
    assert of(idle, "run_out", "brake_torque_needed").value == 0


# --- work ------------------------------------------------------------------------------------------------------------

PRESS: dict[str, Any] = yaml.safe_load((ROOT / "specs" / "shaft.yaml").read_text("utf-8"))
SPIKES = changed(PRESS, inertia__rod_inertia="2.5e14 kg*m^2", scenes=[{"type": "steady"}])
"""A rod that swings outweighs all else by 1e12 but at the two angles at which it turns back."""


def test_an_inertia_with_spikes_does_not_run_away(monkeypatch: pytest.MonkeyPatch) -> None:
    """Runs over a cycle begin on the stretches of the one before: 250 solutions, where each alone took 8000."""
    calls, ours = [], steady.solve
    monkeypatch.setattr(steady, "solve", lambda *given, **named: calls.append(given) or ours(*given, **named))
    report = sound(report_of(SPIKES, budget=0.5))
    assert len(calls) <= 400
    assert [(d.code, d.severity) for d in report.diagnostics if d.code == "NUM101"]
    assert check_of(scene_of(report), "SHF102").verdict is Verdict.UNDECIDED


def test_a_stiff_drive_is_refined_to_its_rounding_and_no_further(monkeypatch: pytest.MonkeyPatch) -> None:
    """A hundred stretches in all, where halving what was mere rounding took ten thousand."""
    sizes, ours = [], steady.solve
    monkeypatch.setattr(
        steady, "solve", lambda grid, *given, **named: sizes.append(len(grid.edges)) or ours(grid, *given, **named)
    )
    sound(report_of(changed(LINEAR, inertia__value="1.1e-3 kg*m^2", scenes=[{"type": "steady"}])))
    assert 0 < sum(sizes) <= 200


def test_the_search_for_a_cycle_ends(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(steady, "_MOST_MARCHED", 20)
    report = sound(report_of(changed(SPIKES, inertia__rod_inertia="2.4e14 kg*m^2"), budget=0.5))
    assert [d.message for d in report.diagnostics if "20 segments" in d.message and d.code == "NUM103"]
    assert check_of(scene_of(report), "SHF102").verdict is Verdict.UNDECIDED


# --- anything --------------------------------------------------------------------------------------------------------

EXTREMES: dict[str, list[str]] = {
    "inertia__mean": ["5 kg*m^2", "1e15 kg*m^2"],
    "inertia__terms__0__cosine": ["0 kg*m^2", "1e-12 kg*m^2", "-33.9999999 kg*m^2"],
    "drive__motor__power": ["1e-12 W"],
    "drive__motor_inertia": ["1e-12 kg*m^2", "1e3 kg*m^2"],
    "load__sectors__0__torque": ["-900 N*m", "1e-12 N*m", "1e15 N*m", "-1e15 N*m"],
    "losses__torque": ["0 N*m", "1e-12 N*m", "1e15 N*m"],
    "losses__viscous": ["1e-12 N*m*s/rad"],
    "brake__torque": ["0 N*m", "1e15 N*m"],
    "brake__delay": ["1e-12 s"],
    "checks__irregularity": ["1e-12", "1e15"],
    "checks__stop_angle": ["1e15 rad"],
}


@pytest.mark.parametrize(("key", "value"), [(key, value) for key in EXTREMES for value in EXTREMES[key]])
def test_whatever_a_file_may_say_ends_in_a_report(key: str, value: str) -> None:
    wide = changed(C23, **{key: float(value) if " " not in value else value})
    report = sound(report_of(wide, repairs=True, budget=0.5))
    assert [scene.name for scene in report.scenes] == ["run_up", "steady", "run_out"]
    assert all(check.verdict in set(Verdict) for scene in report.scenes for check in scene.checks)
