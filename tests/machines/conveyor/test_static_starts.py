"""Numbers that a start is held against besides its tensions: heat of the rotors, swings left behind, margins.

Finite elements for the drum's speed, an oscillator for the mode, arithmetic for the rest.
"""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support import fem
from support.belt_scenes import Drive, Rig
from support.machines import changed, check_of, load_of, report_of, scene_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.report import LoadReport, SceneReport

G = 9.81
FAST = 1530 * math.pi / 30
TURNS = 20 / 0.5
GRAVITY = Rig(sections=((300.0, 12.0), (200.0, 6.0)), start_factor=1.2, drives={"head": Drive(torque=4000.0)})
RIGID = replace(GRAVITY, rigid=True, tension=200e3, drives={"head": Drive(torque=3000.0)})
PLAIN = replace(GRAVITY, sections=((500.0, 18.0),))


def started(rig: Rig, profile: dict[str, Any], repairs: bool = False, **changes: Any) -> SceneReport:
    return scene_of(report_of(changed(rig.data({"type": "start", "profile": profile}), **changes), repairs=repairs))


def heat_of(scene: SceneReport) -> LoadReport:
    return load_of(scene, "motor_start_heat[head]")


HEATED: dict[str, Any] = {"drive__motor__start_heat": "1 MJ", "drive__motor__no_load_speed": "1530 rpm"}


@pytest.mark.parametrize("rig", [GRAVITY, RIGID], ids=["gravity", "rigid"])
@pytest.mark.parametrize("rise_time", [0.0, 3.0])
def test_heat_of_a_rotor_is_that_of_its_drum_in_finite_elements(rig: Rig, rise_time: float) -> None:
    profile = {"shape": "ramp", "control": "torque", "time": f"{rise_time} s"} if rise_time else {"shape": "step"}

    def rise(time: float) -> float:
        return min(time / rise_time, 1.0) if rise_time else 1.0

    scene = started(rig, profile, **HEATED)
    load = heat_of(scene).estimate
    window = load_of(scene, "start_time").estimate.value
    motion = rig.started(rise, window, 300)
    times = motion.times[motion.times <= window]
    speed = np.array(motion.head.belt)[: len(times)] * TURNS
    torque = rig.drives["head"].torque * np.array([rise(time) for time in times])
    heat = float(np.trapezoid(torque * np.maximum(FAST - speed, 0), times))
    assert load.low <= heat <= load.high
    assert heat == pytest.approx(load.value, rel=0.03)


def test_a_stiff_belt_heats_its_rotor_as_the_rigid_conveyor_does() -> None:
    """M (w_0 t - phi) of a constant torque."""
    scene = started(replace(PLAIN, stiffness=4e10), {"shape": "step"}, **HEATED)
    force = PLAIN.drives["head"].force
    acceleration = (force - PLAIN.resistance(factor=1.2)) / PLAIN.mass()
    time = 4.0 / acceleration
    assert heat_of(scene).estimate.value == pytest.approx(4000 * (FAST * time - TURNS * 4.0 * time / 2), rel=1e-3)


def test_two_motors_on_a_drum_share_its_heat() -> None:
    one, two = (
        replace(PLAIN, stiffness=4e10, drives={"head": Drive(torque=4000.0 / count, rotor=5.0 / count, count=count)})
        for count in (1, 2)
    )
    heats = [heat_of(started(rig, {"shape": "step"}, **HEATED)).estimate.value for rig in (one, two)]
    assert heats[1] == pytest.approx(heats[0] / 2, rel=1e-6)


def test_a_drive_that_does_not_start_heats_without_end() -> None:
    weak = replace(PLAIN, drives={"head": Drive(torque=800.0)})
    scene = started(weak, {"shape": "step"}, **HEATED)
    assert heat_of(scene).estimate.value == math.inf
    assert check_of(scene, "CNV117").verdict is Verdict.FAIL


def test_heat_along_a_curve_by_an_ode_solver() -> None:
    """The upper end of the bar is the rigid conveyor, which no belt helps away."""
    rig = PLAIN
    points = ((0.0, 5200.0), (1200.0, 4600.0), (1450.0, 5000.0), (1528.0, 4000.0), (1560.0, 0.0))
    curve = {"type": "table", "points": [{"speed": f"{n} rpm", "torque": f"{m} N*m"} for n, m in points]}
    data = changed(
        rig.data({"type": "start", "profile": {"shape": "curve"}}), drive__motor__curve=curve, **HEATED,
    )  # fmt: skip
    data["drive"]["motor"].pop("mean_starting_torque")
    mass, resistance = rig.mass(), rig.resistance(factor=1.2)

    def torque(speed: float) -> float:
        return float(np.interp(speed * TURNS * 30 / math.pi, [n for n, _ in points], [m for _, m in points]))

    def rate(time: float, state: np.ndarray) -> list[float]:
        pull = torque(state[0]) * TURNS * 0.94
        return [(pull - resistance) / mass, torque(state[0]) * max(FAST - state[0] * TURNS, 0.0)]

    def reached(time: float, state: np.ndarray) -> float:
        return float(state[0] - 4.0)

    reached.terminal = True  # type: ignore[attr-defined]
    motion = solve_ivp(rate, (0, 60), [0.0, 0.0], events=reached, rtol=1e-9, max_step=0.01)
    found = heat_of(scene_of(report_of(data))).estimate
    assert found.high == pytest.approx(motion.y_events[0][0][1], rel=3e-3)
    assert found.low < found.value < found.high


# --- swings and pulsation --------------------------------------------------------------------------------------------


def modes(imposed: bool) -> np.ndarray:
    """Lowest natural circular frequencies of the plain belt, by finite elements."""
    belt = fem.Belt(
        (500.0, 500.0),
        (PLAIN.belt + PLAIN.load + PLAIN.carry_idlers, PLAIN.belt + PLAIN.back_idlers),
        PLAIN.stiffness,
        PLAIN.drives["head"].mass,
        PLAIN.tail_mass,
        PLAIN.rigid,
    )
    return np.asarray(fem.natural_frequencies(belt, (200, 200), clamped_drum=imposed, how_many=3), float)


@pytest.mark.parametrize("shape", ["ramp", "cosine", "parabolic"])
@pytest.mark.parametrize("control", ["torque", "speed"])
def test_the_swing_left_is_that_of_an_oscillator_of_the_lowest_frequency(shape: str, control: str) -> None:
    """Of a torque only what exceeds the static resistance acts."""
    profile = {"shape": shape, "control": control, "time": "4 s"}
    quiet = {code: {"off": "only the swing is asked for"} for code in ("CNV101", "CNV104", "CNV119")}
    scene = started(PLAIN, profile, checks={"start_residual": 0.5, **quiet})
    frequency = float(modes(control == "speed")[0])
    u = np.linspace(0.0, 1.0, 200_001)
    rise = {
        "ramp": u,
        "cosine": (1 - np.cos(math.pi * u)) / 2,
        "parabolic": np.where(u < 0.5, 2 * u**2, 1 - 2 * (1 - u) ** 2),
    }[shape]
    if control == "torque":
        share = PLAIN.resistance(factor=1.2) / PLAIN.drives["head"].force
        rise = np.maximum((rise - share) / (1 - share), 0.0)
    swing = abs(np.sum(np.diff(rise) * np.exp(4j * frequency * (u[1:] + u[:-1]) / 2)))
    assert load_of(scene, "start_residual").estimate.value == pytest.approx(swing, abs=1e-4)


def test_a_pulsation_is_measured_from_the_nearest_of_three_frequencies() -> None:
    found = modes(imposed=True) / (2 * math.pi)
    for ripple in (0.1, 0.3, 0.6, 4.0):
        scene = started(PLAIN, {"shape": "cosine", "time": "30 s", "ripple": f"{ripple} Hz"})
        distance = min(abs(ripple / one - 1) for one in found)
        assert load_of(scene, "resonance_distance").estimate.value == pytest.approx(distance, abs=1e-3)


# --- margins ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("rig", [PLAIN, replace(PLAIN, rigid=True, tension=200e3)], ids=["gravity", "rigid"])
@pytest.mark.parametrize("shape", ["ramp", "cosine"])
def test_a_start_at_the_margins_neither_slips_nor_goes_slack(rig: Rig, shape: str) -> None:
    """The profile that is just sharp enough, simulated: the reserve of grip is there, with room to spare."""
    strong = replace(rig, drives={"head": Drive(torque=40e3)})
    sharp: dict[str, Any] = {"shape": shape, "time": "2 s"}
    off = {code: {"off": "-"} for code in ("CNV104",)}
    scene = started(strong, sharp, repairs=True, checks={"start_margins": "on", **off})
    check = check_of(scene, "CNV118")
    assert check.verdict is Verdict.FAIL
    assert check.repair is not None
    soft = started(strong, sharp | {"time": f"{check.repair.value!r} s"}, checks={"start_margins": "on", **off})
    assert check_of(soft, "CNV118").verdict is Verdict.PASS
    for code in ("CNV101", "CNV105"):
        assert check_of(soft, code).verdict is Verdict.PASS, code
    hard = started(strong, sharp | {"time": f"{0.35 * check.repair.value!r} s"}, checks=off)
    assert Verdict.FAIL in {check_of(hard, code).verdict for code in ("CNV101", "CNV105")}


def test_margins_of_a_ramp_under_a_constant_take_up_by_hand() -> None:
    """Twice the mass of the belt times the acceleration, over what the grip leaves; the tail pulls no more."""
    rig = replace(PLAIN, tension=60e3, drives={"head": Drive(torque=40e3)}, tail_inertia=1e-6)
    scene = started(rig, {"shape": "ramp", "time": "20 s"}, checks={"start_margins": "on"})
    grip = (math.exp(0.35 * 3.5) - 1) / 1.2
    allowed = (60e3 * grip - rig.resistance(factor=1.2)) / (2 * rig.belt_mass())
    limit = check_of(scene, "CNV118").limit
    assert limit is not None
    assert limit.value == pytest.approx(allowed, rel=1e-3)
