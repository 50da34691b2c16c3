"""Courses of a chain's start and stop: their extremes are the loads that are told, their ends what is known of them."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support.chain_starts import KIND, built, scraper
from support.command import ROOT

from ptmcalc.contract.result import History, Result
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import load_file
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive
from ptmcalc.machines.chain_drive.starting.motion import start_case
from ptmcalc.machines.chain_drive.stopping.motion import stop_case

PROFILES = {
    "step": {"shape": "step"},
    "ramp of torque": {"shape": "ramp", "time": "0.4 s", "control": "torque"},
    "cosine of torque": {"shape": "cosine", "time": "0.5 s", "control": "torque"},
    "cosine of speed": {"shape": "cosine", "time": "2 s", "control": "speed"},
}
STOPS = {"stop": {"type": "stop"}, "coast": {"type": "coast"}}


def _solved(name: str, spec: ChainDrive, level: int = 0) -> Result:
    solver = next(one for one in KIND.solvers if one.name == name)
    return solver.run(spec, spec.all_scenes[0], solver.always, level)


def _at(course: History, time: float) -> float:
    """The sample at a time, which is one."""
    index = int(np.argmin(np.abs(np.array(course.times) - time)))
    assert course.times[index] == pytest.approx(time, rel=1e-9, abs=1e-12)
    return course.values[index]


@pytest.mark.parametrize("solver", ["chain_one_mode", "chain_start_waves", "chain_start_teeth"])
@pytest.mark.parametrize("profile", PROFILES)
def test_the_extremes_of_a_start_are_its_loads(profile: str, solver: str) -> None:
    spec = built(scraper(scenes=[{"type": "start", "profile": PROFILES[profile]}]))
    found, case = _solved(solver, spec), start_case(spec, spec.all_scenes[0])
    courses = found.histories()
    assert set(courses) == ({"tension_start"} if solver == "chain_one_mode" else {"tension_start", "tension_min"})
    for name, course in courses.items():
        load, extreme = found.loads[name], max if name == "tension_start" else min
        assert load.estimate.value == pytest.approx(extreme(course.values), rel=1e-9)
        assert _at(course, load.at["time"]) == pytest.approx(load.estimate.value, rel=1e-9)
        assert list(course.times) == sorted(course.times)
        assert course.times[0] == 0
        assert course.times[-1] <= case.held + case.window + 1e-12
    assert courses["tension_start"].values[0] == pytest.approx(case.line.run_on)


@pytest.mark.parametrize("profile", PROFILES)
def test_the_speed_of_a_start_is_that_of_one_body(profile: str) -> None:
    spec = built(scraper(scenes=[{"type": "start", "profile": PROFILES[profile]}]))
    case = start_case(spec, spec.all_scenes[0])
    course = _solved("chain_rigid_start", spec).histories()["start_time"]
    assert course.values[-1] == pytest.approx(case.line.speed, rel=1e-5)
    assert all(np.diff(course.values) >= 0)
    if case.imposed_speed:
        return
    shares = {
        "step": lambda t: 1.0,
        "ramp of torque": lambda t: min(t / 0.4, 1.0),
        "cosine of torque": lambda t: (1 - math.cos(math.pi * min(t / 0.5, 1.0))) / 2,
    }[profile]

    def rate(t: float, y: np.ndarray) -> list[float]:
        return [max(case.available * shares(t) - case.line.static_resistance, 0.0) / case.whole_mass]

    run = solve_ivp(rate, (0.0, course.times[-1]), [0.0], t_eval=course.times, rtol=1e-9, atol=1e-10, max_step=0.005)
    assert course.values == pytest.approx(np.minimum(run.y[0], case.line.speed), rel=1e-5, abs=1e-6)


@pytest.mark.parametrize("scene", STOPS)
def test_the_course_of_a_stop_has_its_least_and_ends_at_rest(scene: str) -> None:
    spec = built(scraper(scenes=[STOPS[scene]]))
    case = stop_case(spec, spec.all_scenes[0])
    rest, way = case.rest()
    found = _solved("chain_stop_waves", spec)
    course, load = found.histories()["tension_min"], found.loads["tension_min"]
    assert min(course.values) == pytest.approx(load.estimate.value, rel=1e-9)
    assert _at(course, load.at["time"]) == pytest.approx(load.estimate.value, rel=1e-9)
    assert course.times[-1] == pytest.approx(rest)
    speed = _solved("chain_stop", spec).histories()["stop_time"]
    assert speed.values[0] == pytest.approx(case.line.speed)
    assert speed.values[-1] == pytest.approx(0.0, abs=1e-9)
    assert np.trapezoid(speed.values, speed.times) == pytest.approx(way, rel=1e-4)


def test_the_page_draws_tension_and_speed_of_the_start_and_of_the_stop() -> None:
    path = "specs/chain_drive.yaml"
    report = check(load_file(ROOT / path, path), Options(figures=True, repairs=False))
    drawn = {(scene.name, one.name) for scene in report.scenes for one in scene.figures if one.curves}
    assert {(s, n) for s in ("start_loaded", "stop_loaded") for n in ("start_tension", "speed")} <= drawn
