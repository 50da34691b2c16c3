"""Machines with other ends than a constant tension, against finite elements summed harmonic by harmonic."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from support import chain_fem
from support.chains import CH_05, FIRST, MOTOR, ROLLER, Reference, chain_of
from support.machines import changed, check_of, load_of, report_of, scene_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.machines.chain_drive.polygon.resonances import resonances

FILE = Path(__file__).parents[3] / "specs" / "chain_drive.yaml"
EA, P = 206e9 * 1.6e-3, 0.32
ZETA = 0.1
LOSSY = {"law": "hysteretic", "ratio": ZETA}
BASE = changed(CH_05, chain__damping=LOSSY, speed="0.9 m/s", accuracy="0.5 %")
WORKING, BACK = chain_fem.Strand(40.0, 200.0, EA), chain_fem.Strand(40.0, 80.0, EA)


def value(data: dict[str, Any], name: str) -> float:
    return load_of(scene_of(report_of(data)), name).estimate.value


def motion(teeth: int, pitch: float, count: int) -> np.ndarray:
    """Fourier coefficients of the polygon's displacement, by a fast transform of its definition."""
    x = (np.arange(2**16) + 0.5) / 2**16 - 0.5
    half = math.pi / teeth
    u = pitch / (2 * math.sin(half)) * np.sin(2 * half * x) - pitch * x
    n = np.arange(1, count + 1)
    return np.array([2 * np.mean(u * np.sin(2 * np.pi * k * x)) for k in n])


def force(
    chain: chain_fem.Chain, near: np.ndarray, far: np.ndarray, place: float, w: float, end: int
) -> tuple[float, float]:
    """Largest and smallest dynamic tension at an end over one pitch."""
    x = np.linspace(0.0, 1.0, 2001)
    total = np.zeros_like(x)
    for n, (one, other) in enumerate(zip(near, far, strict=True), 1):
        shifted = other * np.exp(-2j * np.pi * n * place)
        total += np.imag(
            chain_fem.forces(chain, complex(1, 2 * ZETA), n * w, one, shifted)[end] * np.exp(2j * np.pi * n * x)
        )
    return float(total.max()), float(total.min())


COUNT = 24


def compare(data: dict[str, Any], expected: tuple[float, float], names: tuple[str, ...], share: float = 0.02) -> None:
    size = max(map(abs, expected))
    for name, number in zip(names, expected, strict=False):
        assert value(data, name) == pytest.approx(number, abs=share * size), name


ON = ("tension_dynamic_polygon", "tension_dynamic_polygon_min")
FAR = ("tension_dynamic_polygon_far",)


@pytest.mark.parametrize("teeth", [8, 9])
def test_a_screw_moves_both_runs_of_the_same_sprocket(teeth: int) -> None:
    """Half a turn is four pitches and a half for nine teeth: the runs are out of step."""
    data = changed(
        BASE,
        layout__takeup={"type": "screw", "tension": "60 kN"},
        layout__tail={"teeth": 8, "inertia": "40 kg*m^2"},
        sprocket__teeth=teeth,
    )
    chain = chain_fem.Chain((WORKING, BACK), joint_mass=40 / (8 * P / (2 * math.pi)) ** 2, far="on_sprocket")
    u, w = motion(teeth, P, COUNT), 2 * math.pi * 0.9 / P
    place = teeth / 2 % 1
    compare(data, force(chain, u, u, place, w, 0), ON)
    compare(data, force(chain, u, u, place, w, 1), FAR)


def test_a_driven_tail_with_its_phase() -> None:
    data = changed(BASE, layout__tail={"teeth": 10, "driven": "on", "phase": 0.3})
    chain = chain_fem.Chain((WORKING,), far="held")
    w = 2 * math.pi * 0.9 / P
    near, far = motion(8, P, COUNT), motion(10, P, COUNT)
    compare(data, force(chain, near, far, 0.3, w, 0), ON)
    compare(data, force(chain, near, far, 0.3, w, 1), FAR)


def test_a_take_up_weight_moves_with_its_falls() -> None:
    data = changed(BASE, layout__takeup__mass="4077 kg")
    chain = chain_fem.Chain((WORKING, BACK), far_mass=4077 / 4)
    u, w = motion(8, P, COUNT), 2 * math.pi * 0.9 / P
    compare(data, force(chain, u, u, 0.0, w, 0), ON)
    compare(data, force(chain, u, u, 0.0, w, 1), FAR)


def test_a_drive_that_gives_way() -> None:
    arm = 8 * P / (2 * math.pi)
    data = changed(BASE, drive=MOTOR, sprocket__inertia="15 kg*m^2")
    chain = chain_fem.Chain((WORKING, BACK), drive_mass=(0.15 * 42.4**2 + 15) / arm**2)
    u, w = motion(8, P, COUNT), 2 * math.pi * 0.9 / P
    compare(data, force(chain, u, np.zeros(COUNT), 0.0, w, 0), ON[:1])  # the smallest lies in a corner


def roller(phase: float | None) -> tuple[dict[str, Any], chain_fem.Chain]:
    data = changed(ROLLER, chain__damping=LOSSY, speed="1.1 m/s", accuracy="0.5 %", layout__driven__phase=phase)
    radii = [0.0254 / (2 * math.sin(math.pi / z)) for z in (19, 57)]
    length = math.sqrt(1 - (radii[1] - radii[0]) ** 2)
    arm = 57 * 0.0254 / (2 * math.pi)
    return data, chain_fem.Chain((chain_fem.Strand(length, 5.4, 1.1e7),), far_mass=6 / arm**2)


@pytest.mark.parametrize("phase", [0.0, 0.3, 0.5])
def test_a_driven_sprocket_with_its_phase(phase: float) -> None:
    data, chain = roller(phase)
    w = 2 * math.pi * 1.1 / 0.0254
    near, far = motion(19, 0.0254, COUNT), motion(57, 0.0254, COUNT)
    compare(data, force(chain, near, far, phase, w, 0), ON)
    compare(data, force(chain, near, far, phase, w, 1), FAR)


def test_where_nobody_knows_the_phase_the_worst_counts() -> None:
    worst = value(roller(None)[0], "tension_dynamic_polygon")
    known = [value(roller(phase)[0], "tension_dynamic_polygon") for phase in np.linspace(0.0, 0.95, 20).tolist()]
    assert max(known) <= worst * (1 + 1e-6)
    assert max(known) > 0.97 * worst
    assert min(known) < 0.97 * worst


def test_the_damping_of_the_file_is_that_of_the_first_mode() -> None:
    """Half the width of the peak at half power is the damping ratio, by any law."""
    zener = {"law": "zener", "time": "28.6 ms", "stiffening": 0.2}
    for damping, ratio in (({"ratio": 0.02}, 0.02), ({"law": "hysteretic", "ratio": 0.02}, 0.02), (zener, 0.0456)):
        data = changed(CH_05, chain__damping=damping, operating={"lowest": "1.4 m/s", "highest": "2.4 m/s"})
        course = load_of(scene_of(report_of(data, histories=True)), "tension_dynamic_polygon").history
        assert course is not None
        speeds = np.array(course.times)
        stiff = np.array(course.values) / speeds**2  # over the amplitude of the acceleration
        top = int(np.argmax(stiff))
        above = speeds[stiff > stiff[top] / math.sqrt(2)]
        assert (above[-1] - above[0]) / 2 / speeds[top] == pytest.approx(ratio, rel=0.2)


def test_what_a_resonance_weighs_is_the_force_of_finite_elements_in_it() -> None:
    """(2/(pi n)) |D|/(m w^2) of every harmonic in the first three modes."""
    spec = chain_of(BASE)
    found = resonances(spec, spec.all_scenes[0], frozenset())
    chain, mass = chain_fem.Chain((WORKING, BACK)), 40.0 * (200 + 80)
    for mode in range(3):
        w = float(found.frequencies[mode])
        stiff = abs(chain_fem.forces(chain, complex(1, 2 * ZETA), w, 1.0, pieces=80)[0])
        for order in (1, 2, 5):
            expected = 2 / (math.pi * order) * stiff / (mass * w**2)
            assert found.weights[order - 1, mode] == pytest.approx(expected, rel=1e-3)
            assert found.matter[order - 1, mode] == (expected >= 0.5)


def test_inside_a_safe_window_a_speed_is_safe_and_outside_it_is_not() -> None:
    data = changed(CH_05, operating={"lowest": "0.4 m/s", "highest": "2.6 m/s"}, effects={"weak_drive": "off"})
    loads = {load.info.name: load.estimate.value for load in scene_of(report_of(data)).loads}
    windows = [
        (loads[f"safe_window_low[{k}]"], loads[f"safe_window_high[{k}]"])
        for k in range(1, 9)
        if f"safe_window_low[{k}]" in loads
    ]
    assert len(windows) >= 2
    passed = {True: 0, False: 0}
    for speed in np.linspace(0.41, 2.59, 40).tolist():
        inside = any(low <= speed <= high for low, high in windows)
        verdict = check_of(scene_of(report_of(changed(data, speed=f"{speed!r} m/s"))), "CHN101").verdict
        assert verdict is (Verdict.PASS if inside else Verdict.FAIL), speed
        passed[inside] += 1
    assert min(passed.values()) > 5


def test_the_bound_is_above_what_finite_elements_find_and_not_far_in_resonance() -> None:
    for ratio, most in ((0.37, 3.0), (1.0, 1.3), (1.4, 6.0)):
        data = changed(CH_05, speed=f"{ratio * FIRST} m/s")
        force = Reference(data).force
        bound = value(data, "tension_polygon_bound")
        assert max(force.max(), -force.min()) <= bound <= most * max(force.max(), -force.min())


def test_a_chain_that_goes_slack_says_in_which_scene_and_what_would_keep_it_taut() -> None:
    data = yaml.safe_load(FILE.read_text())
    data["layout"]["takeup"]["tension"] = "10 N"
    report = report_of(data)
    assert not [one for one in report.diagnostics if one.code == "NUM102"], "no warning beside a verdict"
    found = [one for scene in report.scenes for one in scene.checks if one.code in ("CHN123", "CHN127")]
    assert {one.code for one in found} == {"CHN123", "CHN127"}
    for one in found:
        assert one.verdict is Verdict.FAIL
