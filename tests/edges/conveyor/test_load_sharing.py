"""Load sharing of several drives, by a root search on the curves of Kloss with the creep of the belt."""

import math
from typing import Any

import pytest
from scipy.optimize import brentq
from support import machines
from support.edges import load, report_on

from ptmcalc.base.diagnostic import Verdict

G, LENGTH, BELT, CARRY, BACK, LOAD, F, STIFFNESS = 9.81, 900.0, 20.0, 26.0, 12.0, 100.0, 0.02, 60e6
TENSION, RATIO, EFFICIENCY, RPM = 150e3, 20.0, 0.94, math.pi / 30
RETURN_PULL = F * G * (BELT + BACK) * LENGTH
WHOLE = RETURN_PULL + F * G * (BELT + LOAD + CARRY) * LENGTH


def drive(diameter: float = 1.0, power: float = 160.0, speed: float = 1485.0, **more: Any) -> dict[str, Any]:
    curve = {"type": "induction", "power": f"{power} kW", "speed": f"{speed} rpm", "synchronous_speed": "1500 rpm",
             "overload": 2.5}  # fmt: skip
    return {
        "motor": {"count": 1, "inertia": "3 kg*m^2", "curve": curve},
        "gear": {"ratio": RATIO, "efficiency": EFFICIENCY},
        "drum": {"diameter": f"{diameter} m", "wrap": "200 deg", "friction": 0.35},
        **more,
    }


def conveyor(takeup: str = "gravity", **drives: Any) -> dict[str, Any]:
    return {
        "kind": "conveyor",
        "route": {"length": f"{LENGTH} m"},
        "belt": {"mass": f"{BELT} kg/m", "stiffness": f"{STIFFNESS} N", "breaking_force": "3 MN"},
        "idlers": {"carry": {"line_mass": f"{CARRY} kg/m"}, "return": {"line_mass": f"{BACK} kg/m"}},
        "load": {"mass": f"{LOAD} kg/m"},
        "resistance": {"coefficient": F, "secondary": 1},
        "gravity": f"{G} m/s^2",
        "speed": "3.9 m/s",
        "drives": drives,
        "takeup": {"type": takeup, "tension": f"{TENSION} N"},
        "scenes": [{"type": "run"}],
    }


def force(one: dict[str, Any], speed: float) -> float:
    """Force of a drive at the speed of its pulley, by the formula of Kloss."""
    curve, radius = one["motor"]["curve"], float(one["drum"]["diameter"].split()[0]) / 2
    power, rated = float(curve["power"].split()[0]) * 1e3, float(curve["speed"].split()[0])
    rated_slip, overload = (1500 - rated) / 1500, curve["overload"]
    breakdown = rated_slip * (overload + math.sqrt(overload**2 - 1))
    slip = 1 - speed * RATIO / radius / (1500 * RPM)
    torque = overload * power / (rated * RPM) * 2 / (slip / breakdown + breakdown / slip)
    return torque * RATIO / radius * (EFFICIENCY if torque > 0 else 1 / EFFICIENCY)


def shared(*drives: dict[str, Any]) -> list[float]:
    """Forces of drives at the head, in the sequence of the belt over their pulleys, or at the tail (`at`)."""

    def pulled(still: float) -> list[float]:
        tension, found = TENSION + RETURN_PULL, {}
        for index, one in enumerate(drives):
            if one.get("at") == "tail":
                found[index] = force(one, still * (1 + tension / STIFFNESS))
                tension -= found[index]
        tension = TENSION + WHOLE - sum(found.values())
        for index, one in enumerate(drives):
            if one.get("at") != "tail":
                found[index] = force(one, still * (1 + tension / STIFFNESS))
                tension -= found[index]
        return [found[index] for index in range(len(drives))]

    full = max(float(one["drum"]["diameter"].split()[0]) for one in drives) / 2 / RATIO * 1500 * RPM
    still = brentq(lambda speed: sum(pulled(speed)) - WHOLE, 0.985 * full, 1.01 * full, xtol=1e-14)
    return pulled(still)


CASES = {
    "equal": {"a": drive(), "b": drive()},
    "slips": {"a": drive(speed=1494), "b": drive(speed=1470)},
    "diameters": {"a": drive(1.0, 250), "b": drive(0.99, 250)},
    "second_larger": {"a": drive(0.99, 250), "b": drive(1.0, 250)},
    "three": {"a": drive(), "b": drive(power=90), "c": drive(0.998)},
    "tail": {"a": drive(), "b": drive(), "c": drive(power=90, at="tail")},
}


@pytest.mark.parametrize("name", CASES)
def test_drives_share_on_their_curves_with_the_creep_of_the_belt(name: str) -> None:
    drives = CASES[name]
    scene = machines.scene_of(machines.report_of(conveyor(**drives)))
    for (key, one), pull in zip(drives.items(), shared(*drives.values()), strict=True):
        on = machines.load_of(scene, f"tension_run_on_max[{key}]").estimate
        off = machines.load_of(scene, f"tension_run_off_min[{key}]").estimate
        assert on.value - off.value == pytest.approx(pull, rel=1e-6, abs=1)
        rated = float(one["motor"]["curve"]["power"].split()[0]) * 1e3
        radius = float(one["drum"]["diameter"].split()[0]) / 2
        torque = abs(pull) * radius / RATIO * (1 / EFFICIENCY if pull > 0 else EFFICIENCY)
        speed = float(one["motor"]["curve"]["speed"].split()[0]) * RPM
        used = machines.load_of(scene, f"motor_utilisation[{key}]").estimate
        assert used.value == pytest.approx(torque * speed / rated, rel=1e-6, abs=1e-5)


def test_one_per_cent_of_diameter_turns_a_drive_into_a_brake() -> None:
    """Rated slip 1 %: the belt between the pulleys then has less tension than anywhere else."""
    scene = machines.scene_of(machines.report_of(conveyor(**CASES["diameters"])))
    between = machines.load_of(scene, "tension_run_off_min[a]").estimate.value
    assert between < machines.load_of(scene, "tension_run_off_min[b]").estimate.value
    assert machines.load_of(scene, "tension_min").estimate.value == between
    assert machines.check_of(scene, "CNV122").verdict is Verdict.PASS


@pytest.mark.parametrize("tail", [40.0, 90.0, 132.0])
def test_a_fixed_loop_has_the_mean_tension_of_its_take_up_whatever_the_tail_pulls(tail: float) -> None:
    drives = {"a": drive(), "b": drive(power=tail, at="tail")}
    scene = machines.scene_of(machines.report_of(conveyor("rigid", **drives)))
    on, off = (
        {key: machines.load_of(scene, f"tension_run_{side}[{key}]").estimate.value for key in drives}
        for side in ("on_max", "off_min")
    )
    assert off["a"] + RETURN_PULL == pytest.approx(on["b"])
    assert (off["a"] + on["b"] + off["b"] + on["a"]) / 4 == pytest.approx(TENSION)
    still = [
        brentq(lambda speed, one=one, pull=pull: force(one, speed) - pull, 3.88, 3.9269, xtol=1e-14)
        / (1 + on[key] / STIFFNESS)
        for (key, one), pull in zip(drives.items(), (on[key] - off[key] for key in drives), strict=True)
    ]
    assert still[0] == pytest.approx(still[1], rel=1e-9)


def test_two_curves_of_one_power_share_unequally() -> None:
    """Rated slips of 0.4 % and 2 %: 83 % and 17 % at one speed, 79 % and 21 % with the creep of the belt."""
    report = report_on("conveyor/two-curves")
    assert load(report, "motor_utilisation[primary]", "run_loaded").value == pytest.approx(1.036, abs=2e-3)
    assert load(report, "motor_utilisation[secondary]", "run_loaded").value == pytest.approx(0.2746, abs=2e-3)


def test_unequal_drives_without_curves_share_in_an_unknown_way() -> None:
    drives = {"a": drive(), "b": drive(0.99)}
    for one in drives.values():
        one["motor"] = {"count": 1, "inertia": "3 kg*m^2", "speed": "1485 rpm", "mean_starting_torque": "1 kN*m"}
    scene = machines.scene_of(machines.report_of(conveyor(**drives)))
    assert machines.check_of(scene, "CNV101").verdict is Verdict.UNDECIDED
    drives["b"]["motor"]["speed"] = "1500 rpm"  # its pulley then has the speed of the other one
    scene = machines.scene_of(machines.report_of(conveyor(**drives)))
    assert machines.check_of(scene, "CNV101").verdict is Verdict.PASS


def test_what_follows_a_start_of_drives_that_work_against_each_other_has_no_bound() -> None:
    """The second pulley brakes against the first one: how they share what waves add later is not known."""
    start = {"type": "start", "profile": {"shape": "cosine", "time": "30 s"}}
    data = conveyor(**CASES["diameters"]) | {"scenes": [start]}
    scene = machines.scene_of(machines.report_of(data))
    assert machines.load_of(scene, "tension_run_on_max[a]").estimate.bounded
    assert not machines.load_of(scene, "slip_utilisation_max[a]").estimate.bounded
    grips = [one.verdict for one in scene.checks if one.code == "CNV101"]
    assert grips == [Verdict.UNDECIDED, Verdict.UNDECIDED]
