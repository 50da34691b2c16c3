"""Converters that follow the torque of another drive: load sharing by hand, starts and stops by finite elements."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq
from support.belt_fem import Motion, simulate
from support.belt_scenes import Drive, Rig
from support.machines import check_of, load_of, report_of, scene_of

from ptmcalc.base.diagnostic import Verdict

SYNCHRONOUS, SLIP = 157.08, 0.02
RATED = (1 - SLIP) * SYNCHRONOUS
DROOP, LIMIT, TIME = 0.01, 1.5, 6.0


def motor(power: float) -> dict[str, Any]:
    """A cage motor with a straight slip line."""
    return {"type": "induction", "power": f"{power} W", "speed": f"{RATED} rad/s", "overload": 2.4} | {
        "synchronous_speed": f"{SYNCHRONOUS} rad/s"
    }


def data_of(rig: Rig, powers: dict[str, float], follows: dict[str, dict[str, Any]], *scenes: Any) -> dict[str, Any]:
    data = rig.data(*scenes, accuracy="1 %")
    data["resistance"]["stop_factor"] = 1
    for name, drive in data["drives"].items():
        drive["motor"] |= {"curve": motor(powers[name])}
        drive["converter"] = {"droop": DROOP, "torque_limit": LIMIT}
        if name in follows:
            drive["converter"] = {"torque_limit": LIMIT, "deviation": 0.0} | follows[name]
    return data


def used(scene: Any, names: Any) -> dict[str, float]:
    return {name: load_of(scene, f"motor_utilisation[{name}]").estimate.value for name in names}


PAIR = {"first": Drive(friction=None), "second": Drive(friction=None, diameter=0.96, efficiency=0.91)}
POWERS = {"first": 90e3, "second": 70e3}


@pytest.mark.parametrize("places", [("head", "head"), ("head", "tail"), ("tail", "head")])
@pytest.mark.parametrize("follower", ["first", "second"])
@pytest.mark.parametrize(("ratio", "deviation"), [(1.0, 0.0), (0.7, 0.03)])
def test_one_drive_leads_and_the_torques_have_one_ratio(
    places: tuple[str, str], follower: str, ratio: float, deviation: float
) -> None:
    """sum of F_i = W and M_i/M_ni in the ratio r (1 + d), whatever slip, creep and diameters are."""
    drives = {name: replace(PAIR[name], at=at) for name, at in zip(PAIR, places, strict=True)}
    rig = Rig(sections=((900.0, 6.0),), drives=drives, stiffness=60e6)
    leader = "second" if follower == "first" else "first"
    more = {"follows": leader, "torque_ratio": ratio, "deviation": deviation}
    scene = scene_of(report_of(data_of(rig, POWERS, {follower: more}, {"type": "run"})))
    whole = {name: POWERS[name] / RATED * one.ratio * one.efficiency * 2 / one.diameter for name, one in drives.items()}
    part = ratio * (1 + deviation)
    first = rig.resistance() / (whole[leader] + part * whole[follower])
    found = used(scene, drives)
    assert found[leader] == pytest.approx(first, rel=1e-6)
    assert found[follower] == pytest.approx(part * first, rel=1e-6)


def test_two_groups_share_on_the_slip_lines_of_their_leaders() -> None:
    """Belt speed by the balance of three forces; the third drive follows the first, at the speed of the first."""
    drives = {
        "first": Drive(friction=None),
        "second": Drive(friction=None, diameter=0.997),
        "third": Drive(friction=None, diameter=1.04),
    }
    rig = Rig(sections=((900.0, 9.0),), drives=drives, stiffness=60e6)
    powers = dict.fromkeys(drives, 90e3)
    scene = scene_of(report_of(data_of(rig, powers, {"third": {"follows": "first"}}, {"type": "run"})))
    on = rig.tension + rig.resistance()

    def pulls(still: float) -> dict[str, float]:
        found, tension, share = {}, on, {}
        for name, drive in drives.items():
            turns = drive.ratio * 2 / drive.diameter
            own = (1 - still * (1 + tension / rig.stiffness) * turns / SYNCHRONOUS) / (SLIP + DROOP)
            share[name] = float(np.clip(share["first"] if name == "third" else own, -LIMIT, LIMIT))
            found[name] = share[name] * 90e3 / RATED * turns * drive.efficiency
            tension -= found[name]
        return found

    still = brentq(lambda speed: sum(pulls(speed).values()) - rig.resistance(), 3.7, 3.95, xtol=1e-13)
    found = used(scene, drives)
    for name, force in pulls(still).items():
        drive = drives[name]
        right = force / (drive.ratio * 2 / drive.diameter * drive.efficiency) / (90e3 / RATED)
        assert found[name] == pytest.approx(right, rel=1e-6), name
    assert found["third"] == pytest.approx(found["first"], rel=1e-9)


def test_a_follower_ends_at_its_own_limit() -> None:
    """Beyond its limit the leader takes the rest."""
    rig = Rig(sections=((900.0, 6.0),), drives=PAIR, stiffness=60e6)
    data = data_of(rig, dict.fromkeys(PAIR, 120e3), {"second": {"follows": "first"}}, {"type": "run"})
    data["drives"]["second"]["converter"]["torque_limit"] = 0.6
    found = used(scene_of(report_of(data)), PAIR)
    unit = {name: 120e3 / RATED * one.ratio * one.efficiency * 2 / one.diameter for name, one in PAIR.items()}
    assert found["second"] == pytest.approx(0.6, rel=1e-6)
    assert found["first"] == pytest.approx((rig.resistance() - 0.6 * unit["second"]) / unit["first"], rel=1e-6)


# -- starts and stops -----------------------------------------------------------------------------------------------

SHORT = Rig(sections=((300.0, 3.0), (200.0, 6.0)), speed=3.7, tension=90e3, stiffness=30e6)


def machine(at: str, leader: str) -> tuple[Rig, dict[str, float], str]:
    """Two unequal drives, of which one follows the other."""
    drives = {"first": replace(PAIR["first"], rotor=6.0), "second": replace(PAIR["second"], at=at, diameter=0.98)}
    rig = replace(SHORT, drives=drives)
    rig = replace(rig, tension=(0.9 * rig.resistance() if at == "tail" else 0.0) + 60e3)
    return rig, {"first": 75e3, "second": 60e3}, leader


def elements(rig: Rig, powers: dict[str, float], leader: str, window: float, count: int, *, stops: bool) -> Motion:
    """The belt with motors whose frequency rises or falls in a straight line; the follower has the torque that the
    leader had at the last speed which its pulley showed."""
    units = {name: powers[name] / RATED * one.ratio * 2 / one.diameter for name, one in rig.drives.items()}
    whole = rig.resistance()
    share = whole / sum(units[name] * one.efficiency for name, one in rig.drives.items())
    forces = {name: share * units[name] * one.efficiency for name, one in rig.drives.items()}
    first = rig.drives[leader]
    before = sum(
        force
        for name, force in forces.items()
        if rig.drives[name].at == first.at and list(rig.drives).index(name) < list(rig.drives).index(leader)
    )
    turns = first.ratio * 2 / first.diameter * (1 - before / rig.stiffness)
    top = rig.speed * turns / SYNCHRONOUS + share * (SLIP + DROOP)
    shown = {"speed": rig.speed if stops else 0.0}

    def pull(name: str, time: float, speed: float, *, still: bool = False) -> float:
        if name == leader and not still:
            shown["speed"] = speed
        rise, turning = min(time / TIME, 1.0), 0.0 if still else shown["speed"] * turns
        part = top * (1 - rise) if stops else rise
        one = float(np.clip((part - turning / SYNCHRONOUS) / (SLIP + DROOP), -LIMIT, LIMIT))
        efficiency = rig.drives[name].efficiency
        return one * units[name] * (efficiency if one > 0 else 1 / efficiency)

    pulls = {name: (lambda time, speed, name=name: pull(name, time, speed)) for name in rig.drives}
    shared = {}
    for name, drive in rig.drives.items():
        one = replace(drive, torque=forces[name] / (drive.force / drive.torque))
        shared[name] = replace(one, rotor=one.rotor / one.efficiency**2) if stops else one
    there = replace(rig, drives=shared)
    lengths, holds = there.lengths(), None
    if not stops:
        at_ends = {at: sum(forces[name] for name, one in rig.drives.items() if one.at == at) for at in ("head", "tail")}
        at_rest = {name: (lambda time, speed, name=name: pull(name, time, 0.0, still=True)) for name in rig.drives}
        holds = {at: there._held(at_rest, at, force) for at, force in at_ends.items() if force}
    plan = there.plan(lengths, pulls, holds=holds)
    return simulate(plan, count, window, there.running(lengths, count), rig.speed if stops else 0.0)


def extremes(rig: Rig, motion: Motion) -> dict[str, float]:
    found = {"tension_max": float(motion.highest.max()), "tension_min": float(motion.lowest.min())}
    for at, spot in (("head", motion.head), ("tail", motion.tail)):
        between = np.array(spot.between)
        for j, name in enumerate(name for name, drive in rig.drives.items() if drive.at == at):
            found[f"tension_run_on_max[{name}]"] = float(between[:, j].max())
            found[f"tension_run_off_min[{name}]"] = float(between[:, j + 1].min())
    return found


@pytest.mark.parametrize("stops", [False, True], ids=["start", "stop"])
@pytest.mark.parametrize(
    ("at", "leader"), [("head", "first"), ("head", "second"), ("tail", "first"), ("tail", "second")]
)
def test_the_follower_has_the_torque_of_its_leader_in_motion(at: str, leader: str, stops: bool) -> None:
    rig, powers, leader = machine(at, leader)
    follower = next(name for name in rig.drives if name != leader)
    scene = {"type": "start", "profile": {"shape": "ramp", "time": f"{TIME} s"}}
    if stops:
        scene = {"type": "controlled_stop", "time": f"{TIME} s"}
    report = scene_of(report_of(data_of(rig, powers, {follower: {"follows": leader}}, scene)))
    window = load_of(report, "tension_max").window
    assert window is not None
    floats = (at, leader, stops) == ("tail", "second", False)  # nothing holds the speed at the head after the start
    assert load_of(report, "tension_max").estimate.bounded != floats
    coarse, fine = (extremes(rig, elements(rig, powers, leader, window[1], count, stops=stops)) for count in (150, 300))
    for name, value in fine.items():
        one = load_of(report, name).estimate
        slack = 1.5 * abs(value - coarse[name]) + 2e-3 * fine["tension_max"]
        assert one.bounded or floats, name
        assert one.low - slack <= value <= one.high + slack, (name, one, value, slack)


# -- verdicts and errors --------------------------------------------------------------------------------------------


def test_following_turns_the_verdict_of_unequal_pulleys() -> None:
    """2 % more diameter overload one motor on its own frequency; a motor that follows takes its share."""
    drives = {"first": Drive(friction=None), "second": Drive(friction=None, diameter=0.98)}
    rig = Rig(sections=((900.0, 1.0),), drives=drives, stiffness=60e6)
    powers = dict.fromkeys(drives, 90e3)
    apart = scene_of(report_of(data_of(rig, powers, {}, {"type": "run"})))
    assert Verdict.FAIL in {one.verdict for one in apart.checks if one.code == "CNV122"}
    together = scene_of(report_of(data_of(rig, powers, {"second": {"follows": "first"}}, {"type": "run"})))
    assert {one.verdict for one in together.checks if one.code == "CNV122"} == {Verdict.PASS}


def test_the_deviation_is_tried_at_both_ends() -> None:
    rig = Rig(sections=((900.0, 6.0),), drives=PAIR, stiffness=60e6)
    exact = used(scene_of(report_of(data_of(rig, POWERS, {"second": {"follows": "first"}}, {"type": "run"}))), PAIR)
    powers = {name: 1.01 * exact["first"] * power for name, power in POWERS.items()}
    data = data_of(rig, powers, {"second": {"follows": "first"}}, {"type": "run"})
    assert check_of(scene_of(report_of(data)), "CNV122").verdict is Verdict.PASS
    del data["drives"]["second"]["converter"]["deviation"]
    assert check_of(scene_of(report_of(data)), "CNV122").verdict is Verdict.UNDECIDED


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"second": {"follows": "second"}}, "follows itself"),
        ({"second": {"follows": "frist"}}, "no drive is called `frist`"),
        ({"first": {"follows": "second"}, "second": {"follows": "first"}}, "in a circle"),
        ({"second": {"follows": "first", "droop": 0.02}}, "holds no frequency"),
        ({"second": {"torque_ratio": 0.8}}, "belongs to a converter that follows"),
        ({"second": {"follows": "first", "deviation": -1}}, "deviation"),
    ],
)
def test_faults_of_a_follower(changes: dict[str, Any], message: str) -> None:
    rig = Rig(sections=((900.0, 6.0),), drives=PAIR, stiffness=60e6)
    with pytest.raises(AssertionError, match=message):
        report_of(data_of(rig, POWERS, changes, {"type": "run"}))


def test_a_follower_needs_a_converter_that_leads() -> None:
    rig = Rig(sections=((900.0, 6.0),), drives=PAIR, stiffness=60e6)
    data = data_of(rig, POWERS, {"second": {"follows": "first"}}, {"type": "run"})
    del data["drives"]["first"]["converter"]
    with pytest.raises(AssertionError, match="`first` has no converter"):
        report_of(data)
    data = data_of(rig, POWERS, {"second": {"follows": "first"}}, {"type": "run"})
    data["drives"]["second"]["delay"] = "2 s"
    with pytest.raises(AssertionError, match="starts with `first`"):
        report_of(data)
    data = Rig(drives={"head": Drive(friction=None)}).data({"type": "run"})
    data["drive"]["motor"] |= {"curve": motor(90e3)}
    data["drive"]["converter"] = {"follows": "head"}
    with pytest.raises(AssertionError, match="no other drive"):
        report_of(data)
