"""The loads of drive trains, through the whole tool, against closed forms and independent integrations.

Every machine is a design file; nothing of the numerics is asked for a reference.
"""

import json
import math
from typing import Any

import pytest
from support import hybrid
from support.machines import changed, load_of, loaded, report_of, scene_of

from ptmcalc.contract.report import FileReport
from ptmcalc.engine.check import Options, check
from ptmcalc.report.json import render

JERK: dict[str, Any] = {
    "kind": "drivetrain",
    "inertias": {"motor": {"inertia": "1 kg*m^2"}, "wheel": {"inertia": "7 kg*m^2"}},
    "links": {"shaft": {"between": ["motor", "wheel"], "stiffness": "20 kN*m/rad", "limit": "1 MN*m"}},
    "torques": {"drive": {"at": "motor", "type": "constant", "torque": "120 N*m"}},
    "scenes": [{"type": "run", "duration": "0.5 s"}],
}
OMEGA = math.sqrt(20e3 * (1 + 1 / 7))


def value(report: FileReport, name: str, scene: str = "") -> float:
    return load_of(scene_of(report, scene), name).estimate.value


# -- two inertias -----------------------------------------------------------------------------------------------------


def test_a_step_swings_to_twice_what_it_carries() -> None:
    report = report_of(JERK)
    assert value(report, "torque_peak[shaft]") == pytest.approx(210, rel=1e-11)
    assert value(report, "torque_steady[shaft]") == pytest.approx(105, rel=1e-11)
    assert value(report, "dynamic_factor[shaft]") == pytest.approx(2, rel=1e-11)
    assert value(report, "natural_frequency[1]") == pytest.approx(OMEGA, rel=1e-14)
    swing = 120 / 8 * 7 / OMEGA  # of the motor's speed round that of the rigid train
    assert value(report, "speed_end[motor]") == pytest.approx(15 * 0.5 + swing * math.sin(OMEGA * 0.5), rel=1e-10)
    assert value(report, "angle_end[wheel]") == pytest.approx(
        7.5 * 0.25 - 15 * (1 - math.cos(OMEGA * 0.5)) / OMEGA**2, rel=1e-10
    )


@pytest.mark.parametrize("periods", [0.3, 0.5, 1.5, 2.2])
def test_a_ramp_swings_by_the_sinc_of_its_duration(periods: float) -> None:
    time = periods * 2 * math.pi / OMEGA
    data = changed(JERK, torques__drive={"at": "motor", "type": "ramp", "torque": "120 N*m", "time": f"{time!r} s"})
    swing = abs(math.sin(OMEGA * time / 2) / (OMEGA * time / 2))
    assert value(report_of(data), "torque_peak[shaft]") == pytest.approx(105 * (1 + swing), rel=1e-10)


@pytest.mark.parametrize("gap", [1e-4, 3.7012e-3, 2.6e-2])
def test_play_adds_the_energy_of_the_run_through_it(gap: float) -> None:
    data = changed(JERK, links__shaft__gap=f"{gap!r} rad")
    report = report_of(data)
    number = 2 * 20e3 * gap / 2 / 120 * 8 / 7
    assert value(report, "torque_peak[shaft]") == pytest.approx(105 * (1 + math.sqrt(1 + number)), rel=1e-10)
    first = scene_of(report).events[0]
    assert (first.element, first.before, first.after) == ("shaft", "open", "closed")
    assert first.time == pytest.approx(math.sqrt(2 * 1 * gap / 2 / 120), rel=1e-11)


@pytest.mark.parametrize("law", ["clamped", "no_pull", "kelvin"])
def test_damped_contacts_agree_with_an_independent_integration(law: str) -> None:
    data = changed(
        JERK,
        links__shaft={"between": ["motor", "wheel"], "stiffness": "20 kN*m/rad", "damping": "25 N*m*s/rad",
                      "gap": "0.05 rad", "law": law, "limit": "1 MN*m"},
        torques__load={"at": "wheel", "type": "sine", "amplitude": "300 N*m", "angular_frequency": "31 rad/s"},
    )  # fmt: skip
    machine = hybrid.Machine(
        (1.0, 7.0),
        (0.0, 0.0),
        (0.0, 0.0),
        (hybrid.Link(0, 1, 20e3, 25.0, 0.05, law),),
        (),
        (),
        (
            hybrid.Torque(0, hybrid.Course.constant(120.0)),
            hybrid.Torque(1, hybrid.Course(((0.0, 0.0, 0.0),), ((300.0, 31.0, 0.0),))),
        ),
    )
    history, report = hybrid.simulate(machine, 0.5), report_of(data)
    peak = max(history.highest["link", 0], -history.lowest["link", 0])
    assert value(report, "torque_peak[shaft]") == pytest.approx(peak, rel=1e-9)
    assert value(report, "speed_max[motor]") == pytest.approx(history.highest["speed", 0], rel=1e-9)
    assert value(report, "angle_end[wheel]") == pytest.approx(history.positions[1], rel=1e-8)


# -- hoists -----------------------------------------------------------------------------------------------------------

M, M1, K, V0 = 5000.0, 18000.0, 1.2e6, 0.25
Q = M * 9.81
HOIST: dict[str, Any] = {
    "kind": "drivetrain",
    "inertias": {"drive": {"mass": f"{M1} kg", "speed": f"{V0} m/s"}, "load": {"mass": f"{M} kg", "speed": "0 m/s"}},
    "links": {
        "rope": {"between": ["drive", "load"], "stiffness": f"{K} N/m", "slack": "0 mm", "limit": "1 MN"},
        "floor": {"between": ["ground", "load"], "slack": "0 mm", "law": "rigid"},
    },
    "torques": {
        "motor": {"at": "drive", "type": "constant", "torque": f"{Q!r} N"},
        "weight": {"at": "load", "type": "constant", "torque": f"{-Q!r} N"},
    },
    "scenes": [{"type": "run", "duration": "0.6 s"}],
}


@pytest.mark.parametrize(("force", "factor", "speed"), [(1.0, 1.58256, 0.416994), (1.6, 1.91609, 0.554568)])
def test_a_load_lifted_off_the_ground(force: float, factor: float, speed: float) -> None:
    """C14: the drive runs up on the rope until it carries the load; then two masses swing."""
    report = report_of(changed(HOIST, torques__motor__torque=f"{force * Q!r} N"))
    assert value(report, "torque_peak[rope]") / Q == pytest.approx(factor, abs=6e-6)
    stretch = Q / K
    lifted = math.sqrt(V0**2 + (2 * force * Q * stretch - K * stretch**2) / M1)
    assert lifted == pytest.approx(speed, abs=1e-6)
    even = Q + (force - 1) * Q * M / (M1 + M)
    omega = math.sqrt(K * (M1 + M) / (M1 * M))
    peak = even + math.hypot(even - Q, K * lifted / omega)
    assert value(report, "torque_peak[rope]") == pytest.approx(peak, rel=1e-9)


def test_a_load_that_hangs_already() -> None:
    data = changed(HOIST, torques__motor__torque=f"{1.6 * Q!r} N", links__floor=None, links__rope__start="driving")
    data = changed(data, links__rope__preload=f"{Q!r} N", inertias__drive__speed="0 m/s")
    peak = Q + 2 * 0.6 * Q * M / (M1 + M)
    assert value(report_of(data), "torque_peak[rope]") == pytest.approx(peak, rel=1e-10)
    assert peak / Q == pytest.approx(1.26087, abs=5e-6)


def test_a_brake_while_lowering() -> None:
    """C25: the drum is braked with 1.75 times the weight while the load sinks, and is held from then on."""
    data = {
        "kind": "drivetrain",
        "inertias": {"drum": {"mass": f"{M1} kg"}, "load": {"mass": f"{M} kg"}},
        "links": {"rope": {"between": ["drum", "load"], "stiffness": f"{K} N/m", "slack": "0 mm", "limit": "1 MN"}},
        "torques": {"weight": {"at": "load", "type": "constant", "torque": f"{-Q!r} N"}},
        "brakes": {"brake": {"at": "drum", "torque": f"{1.75 * Q!r} N"}},
        "scenes": [{"type": "stop", "of": "drum", "speed": "-0.4 m/s", "duration": "3 s"}],
    }
    report = report_of(data)
    assert value(report, "torque_peak[rope]") == pytest.approx(Q + 2 * 0.75 * Q * M / (M1 + M), rel=1e-9)
    assert value(report, "torque_peak[rope]") == pytest.approx(65044.6, abs=0.06)
    assert value(report, "stop_time") == pytest.approx(0.265923, abs=6e-7)
    assert value(report, "speed_end[drum]") == 0.0
    assert [(e.element, e.after) for e in scene_of(report).events if e.element == "brake"] == [("brake", "at rest")]


def test_a_hoist_starts_with_slack_under_an_induction_motor() -> None:
    """C16: slack, tensioning, lift-off under the curve of Kloss, two falls of rope, losses while driving."""
    motor = {
        "type": "induction",
        "power": "22 kW",
        "speed": "965 rpm",
        "synchronous_speed": "1000 rpm",
        "overload": 2.5,
    }
    data = {
        "kind": "drivetrain",
        "inertias": {
            "motor": {"inertia": "1.1 kg*m^2"},
            "drum": {"inertia": "0 kg*m^2"},
            "hook": {"mass": "0 kg"},
            "load": {"mass": "8 t"},
        },
        "links": {
            "rope": {"between": ["hook", "load"], "stiffness": "2 MN/m", "damping": "6 kN*s/m", "slack": "50 mm",
                     "limit": "1 MN"},
            "floor": {"between": ["ground", "load"], "slack": "0 mm", "law": "rigid"},
        },
        "gears": {
            "box": {"from": "motor", "to": "drum", "ratio": 40, "efficiency": 0.85},
            "winding": {"from": "drum", "to": "hook", "radius": "100 mm"},
        },
        "motors": {"main": {"at": "motor", "motor": motor}},
        "torques": {"weight": {"at": "load", "type": "constant", "torque": "-78.48 kN"}},
        "checks": {"DRV105": {"off": "one start"}},
        "scenes": [{"type": "run", "duration": "1.5 s"}],
    }  # fmt: skip
    report = report_of(data)
    assert value(report, "torque_peak[rope]") / 78480 == pytest.approx(1.38757, abs=6e-6)
    times = {(event.element, event.after): event.time for event in scene_of(report).events}
    assert times["rope", "closed"] == pytest.approx(0.41903, abs=6e-6)
    assert times["floor", "open"] == pytest.approx(0.568251, abs=6e-7)


# -- starts, stops, losses --------------------------------------------------------------------------------------------

LIFT: dict[str, Any] = {
    "kind": "drivetrain",
    "inertias": {"motor": {"inertia": "0.9 kg*m^2"}, "drum": {"inertia": "0 kg*m^2"}, "load": {"mass": "10 t"}},
    "gears": {
        "box": {"from": "motor", "to": "drum", "ratio": 40, "efficiency": 0.85, "reverse_efficiency": 0.85},
        "winding": {"from": "drum", "to": "load", "radius": "200 mm"},
    },
    "torques": {"weight": {"at": "load", "type": "constant", "torque": "-98.1 kN"}},
    "scenes": [{"type": "run", "duration": "0.2 s"}],
}


@pytest.mark.parametrize(
    ("torque", "speed", "acceleration"),
    [(648.706, 10.0, 60.0), (505.412, 50.0, -60.0), (350.175, -10.0, -60.0), (483.675, -50.0, 60.0)],
    ids=["hoisting starts", "hoisting is braked", "lowering starts", "lowering is braked"],
)
def test_losses_go_by_the_whole_torque_in_the_four_phases_of_hoisting(
    torque: float, speed: float, acceleration: float
) -> None:
    """C04: the motor torque that gives 60 rad/s^2."""
    data = changed(LIFT, torques__motor={"at": "motor", "type": "constant", "torque": f"{torque} N*m"})
    report = report_of(changed(data, scenes=[{"type": "run", "duration": "0.2 s", "speed": f"{speed} rad/s"}]))
    assert value(report, "speed_end[motor]") == pytest.approx(speed + acceleration * 0.2, abs=2e-4)
    assert value(report, "speed_end[load]") == pytest.approx((speed + acceleration * 0.2) / 200, abs=1e-6)


@pytest.mark.parametrize("sign", [1, -1])
def test_a_stop_takes_its_delay_its_rise_and_its_way(sign: int) -> None:
    data = {
        "kind": "drivetrain",
        "inertias": {"rotor": {"inertia": "2 kg*m^2"}},
        "brakes": {"brake": {"at": "rotor", "torque": "200 N*m", "delay": "0.2 s", "rise_time": "0.1 s"}},
        "scenes": [{"type": "stop", "speed": f"{100 * sign} rad/s"}],
    }
    report = report_of(data)
    assert value(report, "stop_time") == pytest.approx(1.25, rel=1e-11)
    risen = 100 - 100 * 0.1 / 2
    way = 100 * 0.2 + 100 * 0.1 - 100 * 0.1**2 / 6 + risen**2 / 200
    assert value(report, "stop_angle") == pytest.approx(way, rel=1e-10)
    assert value(report, "speed_end[rotor]") == 0.0


def test_the_heating_torque_of_a_linear_motor() -> None:
    """M = M0 exp(-t/T), T = J w0/M0: its mean square over t is M0^2 T (1 - exp(-2 t/T))/(2 t)."""
    motor = {"type": "linear", "starting_torque": "200 N*m", "no_load_speed": "100 rad/s"}
    data = {
        "kind": "drivetrain",
        "inertias": {"rotor": {"inertia": "2 kg*m^2"}},
        "motors": {"main": {"at": "rotor", "motor": motor}},
        "scenes": [{"type": "run", "duration": "3 s"}],
    }
    report = report_of(data)
    assert value(report, "motor_torque_rms[main]") == pytest.approx(200 * math.sqrt((1 - math.exp(-6)) / 6), rel=1e-10)
    assert value(report, "motor_torque_peak[main]") == pytest.approx(200)
    assert value(report, "speed_end[rotor]") == pytest.approx(100 * (1 - math.exp(-3)), rel=1e-10)


# -- what is reported -------------------------------------------------------------------------------------------------


def test_the_json_lists_the_events_in_order() -> None:
    report = report_of(changed(JERK, links__shaft__gap="0.02 rad"))
    (scene,) = json.loads(render((report,), width=80, color=False))["files"][0]["scenes"]
    times = [event["time"] for event in scene["events"]]
    assert len(times) >= 3
    assert times == sorted(times)
    assert all(set(event) == {"time", "element", "from", "to"} for event in scene["events"])
    states = [(event["element"], event["from"], event["to"]) for event in scene["events"]]
    assert states[:2] == [("shaft", "open", "closed"), ("shaft", "closed", "open")]


def test_one_scene_can_be_chosen() -> None:
    scenes = [{"type": "run", "name": "short", "duration": "0.1 s"}, {"type": "run", "name": "long", "duration": "1 s"}]
    report = report_of(changed(JERK, scenes=scenes), scenes=("short",))
    assert [scene.name for scene in report.scenes] == ["short"]


def test_histories_hold_the_loads_they_are_the_extremes_of() -> None:
    report = check(loaded(changed(JERK, links__shaft__gap="0.02 rad")), Options(histories=True))
    scene = scene_of(report)
    seen = 0
    for name in ("torque_peak[shaft]", "speed_max[motor]", "speed_max[wheel]", "angle_end[motor]"):
        load = load_of(scene, name)
        assert load.history is not None, name
        times, values = load.history.times, load.history.values
        assert len(times) == len(values) > 50
        assert list(times) == sorted(times)
        assert times[0] == 0.0
        assert times[-1] == pytest.approx(0.5)
        found = values[-1] if name.startswith("angle") else max(values)
        assert found == pytest.approx(load.estimate.value, rel=2e-3)
        assert found <= load.estimate.high
        seen += 1
    assert seen == 4
    assert load_of(scene_of(report_of(JERK)), "torque_peak[shaft]").history is None
