"""Extreme conveyors in every scene: absurd sizes and values end in a report, not in a traceback, NaN or endless run.

Only the report is judged: every load is a number inside its own bar, every verdict is given, and what was too much to
simulate says so.
"""

import math
from typing import Any

import pytest
import yaml
from support.machines import changed

from ptmcalc.base.diagnostic import Severity
from ptmcalc.contract.report import FileReport
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import load_text
from ptmcalc.engine.run import WORK_BUDGET

DRIVE: dict[str, Any] = {
    "motor": {"inertia": "5 kg*m^2", "mean_starting_torque": "3 kN*m"},
    "coupling_inertia": "1 kg*m^2",
    "gear": {"ratio": 20, "efficiency": 0.94},
    "drum": {"diameter": "1 m", "wrap": "200 deg", "friction": 0.35, "inertia": "200 kg*m^2"},
}
BASE: dict[str, Any] = {
    "kind": "conveyor",
    "route": {"sections": [{"length": "200 m", "lift": "-4 m"}, {"length": "300 m", "lift": "20 m"}]},
    "belt": {"mass": "20 kg/m", "stiffness": "40 MN", "breaking_force": "2 MN", "carcass": "textile"},
    "idlers": {"carry": {"line_mass": "20 kg/m", "pitch": "1 m"}, "return": {"line_mass": "8 kg/m", "pitch": "3 m"}},
    "load": {"mass": "120 kg/m"},
    "resistance": {"coefficient": 0.022, "secondary": 1.1, "start_factor": 1.1},
    "speed": "4 m/s",
    "drive": DRIVE,
    "brakes": {"disc": {"torque": "10 kN*m", "delay": "0.5 s", "rise_time": "1 s"}},
    "backstop": {"torque": "60 kN*m"},
    "takeup": {"type": "gravity", "tension": "150 kN"},
    "tail_drum": {"inertia": "50 kg*m^2", "diameter": "800 mm"},
    "checks": {"stop_distance": "30 m", "emergency_stop_distance": "30 m", "stop_time": "30 s", "slip_heat": "100 kJ"},
}
TORQUE_RAMP = {"shape": "ramp", "control": "torque", "time": "3 s"}
SCENES: dict[str, dict[str, Any]] = {
    "run": {"type": "run"},
    "stop": {"type": "stop"},
    "emergency_stop": {"type": "emergency_stop"},
    "coast": {"type": "coast", "measured_distance": "20 m"},
    "jam": {"type": "jam"},
    "jam_tail": {"type": "jam", "at": "tail"},
    "relaxed": {"type": "start", "belt": "relaxed"},
    "aborted": {"type": "start", "aborted": {"run": "2 s", "pause": "1 s"}, "profile": TORQUE_RAMP},
    "uphill": {"type": "start", "load": "uphill", "profile": {"shape": "cosine", "time": "20 s"}},
    "backstop": {"type": "backstop"},
}
TAIL_TOO = {"drive": None, "drives": {"one": DRIVE, "two": DRIVE | {"delay": "0.4 s"}, "tail": DRIVE | {"at": "tail"}}}
RIGID = {"takeup": {"type": "rigid", "tension": "300 kN"}}
WEIGHT = {"takeup__mass": "30.6 t"}

MACHINES: dict[str, dict[str, Any]] = {
    "as it is": {},
    "rigid": RIGID,
    "weight": WEIGHT,
    "three drives": TAIL_TOO,
    "three drives, rigid": TAIL_TOO | RIGID,
    "three drives, weight": TAIL_TOO | WEIGHT,
    "hardly moving": {"speed": "1e-6 m/s"},
    "as fast as sound": {"speed": "1000 m/s", "drive__drum__friction": None},
    "lifted off its drums by its speed": {"speed": "90 m/s"},
    "short": {"route": {"length": "1 m", "lift": "0.1 m"}},
    "very long": {"route": {"length": "1e5 m", "lift": "100 m"}},
    "a newton of tension": {"takeup__tension": "1 N"},
    "a newton of tension, rigid": {"takeup": {"type": "rigid", "tension": "1 N"}},
    "a teranewton of tension": {"takeup__tension": "1e12 N"},
    "no friction of the idlers": {"resistance__coefficient": 1e-9},
    "friction above weight": {"resistance__coefficient": 5.0},
    "no resistance while stopping": {"resistance__stop_factor": 1e-9},
    "no grip": {"drive__drum__friction": 1e-9},
    "all grip": {"drive__drum__friction": 100.0},
    "no friction given": {"drive__drum__friction": None},
    "hardly any wrap": {"drive__drum__wrap": "1e-6 deg"},
    "a brake like a wall": {"brakes__disc": {"torque": "1e12 N*m"}},
    "a brake like a feather": {"brakes__disc": {"torque": "1e-9 N*m"}},
    "a brake that never comes": {"brakes__disc": {"torque": "10 kN*m", "delay": "1e6 s"}},
    "a brake that rises for ever": {"brakes__disc": {"torque": "10 kN*m", "rise_time": "1e6 s"}},
    "a brake that rises at once": {"brakes__disc": {"torque": "10 kN*m", "rise_time": "1e-12 s"}},
    "no brake": {"brakes": None},
    "a brake at the tail": {"brakes__disc__at": "tail"},
    "a brake on the motor": {"brakes__disc__shaft": "motor"},
    "thirty brakes": {"brakes": {f"b{number}": {"torque": "1 kN*m", "delay": f"{number} s"} for number in range(30)}},
    "downhill": {"route": {"length": "400 m", "lift": "-60 m"}},
    "downhill, rigid": {"route": {"length": "400 m", "lift": "-60 m"}} | RIGID,
    "as steep as can be": {"route": {"length": "100 m", "lift": "99.999 m"}},
    "nearly balanced": {"route": {"length": "1000 m", "lift": "-20.8 m"}},
    "no load": {"load__mass": None, "load__capacity": "0 t/h"},
    "a load of lead": {"load__mass": "1e6 kg/m"},
    "tail without mass": {"tail_drum": {"inertia": "0 kg*m^2"}},
    "tail like a mill": {"tail_drum": {"inertia": "1e9 kg*m^2"}},
    "a drive without mass": {
        "drive__motor__inertia": "1e-12 kg*m^2",
        "drive__coupling_inertia": "0 kg*m^2",
        "drive__drum__inertia": "0 kg*m^2",
    },
    "a drive like a ship": {"drive__drum__inertia": "1e12 kg*m^2"},
    "a motor like a fly": {"drive__motor__mean_starting_torque": "1e-6 N*m"},
    "a motor like a rocket": {"drive__motor__mean_starting_torque": "1e9 N*m"},
    "a belt of rubber": {"belt__stiffness": "1 N"},
    "a belt of diamond": {"belt__stiffness": "1e15 N"},
    "a belt of paper": {"belt__mass": "1e-9 kg/m"},
    "a weight of a gram": {"takeup__mass": "1e-3 kg"},
    "a weight of a mountain": {"takeup__mass": "1e12 kg"},
    "on the moon of nothing": {"gravity": "1e-6 m/s^2"},
    "a drive an hour late": TAIL_TOO
    | {"drives": {"one": DRIVE, "two": DRIVE | {"delay": "3600 s"}, "tail": DRIVE | {"at": "tail"}}},
    "many sections": {
        "route": {"sections": [{"length": "2 m", "lift": f"{(-1) ** number} m"} for number in range(200)]}
    },
    "sections of all sizes": {
        "route": {"sections": [{"length": "1e-6 m"}, {"length": "100 m", "lift": "5 m"}, {"length": "1e4 m"}]}
    },
    "limits of nothing": {
        "checks": {
            "stop_distance": "1e-9 m",
            "emergency_stop_distance": "1e12 m",
            "stop_time": "1e-9 s",
            "slip_heat": "1e-9 J",
        }
    },
}


LONG = {
    (machine, name)
    for machine in ("short", "downhill", "downhill, rigid", "a teranewton of tension", "limits of nothing")
    for name in ("stop", "emergency_stop", "coast", "aborted", "relaxed")
} | {(machine, "uphill") for machine in MACHINES if machine != "as it is"}
"""Cost seconds: a belt that takes hundreds of its own periods to stop, or a cosine that many effects are tried on."""


BUDGET = 0.5
"""Predicted seconds of a scene: what is soft, short or hopeless would climb to every finer grid."""


def reported(data: dict[str, Any], budget: float = WORK_BUDGET, repairs: bool = False) -> FileReport:
    options = Options(budget=budget, repairs=repairs)
    return check(load_text(yaml.safe_dump(data, sort_keys=False).encode(), "case.yaml"), options)


def _part(machine: str) -> list[str]:
    """Some scenes for every machine, in turn, so that every scene meets a third of the machines."""
    turn = list(MACHINES).index(machine)
    return [name for number, name in enumerate(SCENES) if (turn + number) % 3 == 0 and (machine, name) not in LONG]


@pytest.mark.parametrize("machine", MACHINES)
def test_an_extreme_machine_ends_in_a_report_of_numbers(machine: str) -> None:
    _is_sound(machine, _part(machine), BUDGET)


@pytest.mark.study
@pytest.mark.parametrize("machine", MACHINES)
def test_an_extreme_machine_ends_in_a_report_in_every_scene(machine: str) -> None:
    _is_sound(machine, list(SCENES))


def _is_sound(machine: str, scenes: list[str], budget: float = WORK_BUDGET) -> None:
    data = changed(BASE, **MACHINES[machine]) | {"scenes": [SCENES[name] | {"name": name} for name in scenes]}
    report = reported(data, budget, repairs=True)
    assert len(report.scenes) == len(scenes), [d.message for d in report.diagnostics]
    for d in report.diagnostics:
        assert d.severity is not Severity.ERROR or d.code.startswith("NUM"), d.message
    for scene in report.scenes:
        for load in scene.loads:
            one = load.estimate
            assert not any(map(math.isnan, (one.value, one.low, one.high))), (scene.name, load.info.name, one)
            assert one.low <= one.value <= one.high, (scene.name, load.info.name, one)
        for judged in scene.checks:
            assert judged.verdict in ("pass", "fail", "undecided", "not_checked")
            assert judged.value is None or not math.isnan(judged.value.value)


def _loads(data: dict[str, Any], scene: dict[str, Any]) -> dict[str, float]:
    report = reported(data | {"scenes": [scene]})
    return {load.info.name: load.estimate.value for load in report.scenes[0].loads}


@pytest.mark.parametrize("changes", [{}, RIGID, TAIL_TOO], ids=["gravity", "rigid", "three drives"])
def test_a_belt_that_its_load_drives_never_comes_to_rest(changes: dict[str, Any]) -> None:
    data = changed(BASE, route={"length": "400 m", "lift": "-80 m"}, brakes=None, **changes)
    assert _loads(data, {"type": "stop"})["stop_distance"] == math.inf
    loads = _loads(data, {"type": "coast"})
    assert loads["stop_time"] == math.inf
    assert loads["coast_distance"] == math.inf


def test_nothing_that_brakes_stops_no_belt_and_a_wall_stops_it_at_once() -> None:
    ways = []
    for torque in ("1e-9 N*m", "10 kN*m", "1e12 N*m"):
        data = changed(BASE, brakes__disc={"torque": torque})
        ways.append(_loads(data, {"type": "emergency_stop"})["stop_distance"])
    assert ways[0] > ways[1] > ways[2] >= 0
    assert math.isfinite(ways[0])


@pytest.mark.parametrize("delay", ["1 s", "100 s", "1e6 s"])
def test_a_brake_that_comes_after_the_belt_has_stopped_does_nothing(delay: str) -> None:
    free = _loads(changed(BASE, brakes=None), {"type": "stop"})["stop_distance"]
    late = _loads(changed(BASE, brakes__disc={"torque": "10 kN*m", "delay": delay}), {"type": "stop"})
    assert (late["stop_distance"] < 0.999 * free) == (delay == "1 s")


def test_energy_is_kept_by_every_simulated_scene() -> None:
    for changes in ({}, RIGID, WEIGHT, TAIL_TOO):
        for name in ("stop", "relaxed", "aborted"):
            report = reported(changed(BASE, **changes) | {"scenes": [SCENES[name]]})
            (scene,) = report.scenes
            assert scene.health["energy_residual"] < 1e-4, (changes, name)
