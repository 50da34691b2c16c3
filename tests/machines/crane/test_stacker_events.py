"""The events of a stacker crane against integrations of their own, and what the acceptance asks of them."""

import math
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support import stacker_ode
from support.machines import changed, load_of, report_of
from support.stacker_events import RACK, load, machine, of_case, run, scene_report, value
from support.stacker_ode import Caught

from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import load_text
from ptmcalc.machines.crane.stacking.fork.cases import catch_of, push_of
from ptmcalc.machines.crane.stacking.fork.caught import CAUGHT_TRAIN
from ptmcalc.machines.crane.stacking.fork.pushed import PUSH_RIGID, PUSH_TRAIN
from ptmcalc.machines.crane.stacking.rail.base import roll_of
from ptmcalc.machines.crane.stacking.rail.roll import RAIL_JUMP, RAIL_RESPONSE

Q = 1600 * 9.81
C20 = Caught(9000.0, 1600.0, Q, 9e5, 2.5e6, 0.3, 1e9, 4e4)
STRONG = Caught(9000.0, 1600.0, Q, 9e5, 2.5e6, 0.3, 2.2 * Q, 0.0)
CUT = Caught(9000.0, 1600.0, Q, 9e5, 2.5e6, 0.3, 2.2 * Q, 4e4, 1.5 * Q, 0.05, 1.5 * Q)
AT_ONCE = Caught(9000.0, 1600.0, Q, 9e5, 2.5e6, 0.3, 2.2 * Q, 0.0, 1.5 * Q, 0.0, 1.2 * Q)
LIGHT = Caught(700.0, 1100.0, 1100 * 9.81, 6e5, 9e5, 0.6, 3e4, 2e4, 2.5e4, 0.03, 2.2e4)
BRISK = Caught(3000.0, 2600.0, 2600 * 9.81, 2e6, 4e5, 0.5, 6e4, 3e4)


@pytest.mark.parametrize("one", [C20, STRONG, CUT, AT_ONCE, LIGHT, BRISK])
def test_a_caught_fork_as_integrated(one: Caught) -> None:
    """Acceptance 3: agreement with an independent integration."""
    result = run(CAUGHT_TRAIN, of_case(one))
    assert result.window is not None
    rope, rack = one.peaks(result.window[1])
    assert value(result, "rope_force_caught") == pytest.approx(rope, rel=1e-6)
    assert value(result, "rack_force") == pytest.approx(rack, rel=1e-6)
    assert value(result, "fork_caught_factor") == pytest.approx(rope / one.weight, rel=1e-6)
    assert result.health["energy_residual"] < 1e-9


def test_c20_through_a_file() -> None:
    """The printed case: soft motor and elastic rack; the formula with a motor as strong as the weight beside it."""
    data = changed(RACK, hoisting__drive__slope="40 kN*s/m")
    scene = scene_report(data)
    rope = load_of(scene, "rope_force_caught")
    assert rope.estimate.value == pytest.approx(46537.4, rel=1e-5)
    assert load_of(scene, "rack_force").estimate.value == pytest.approx(37514.0, rel=1e-5)
    assert rope.formula is not None
    assert rope.formula.value == pytest.approx(42696.0, rel=1e-5)
    factor = load_of(scene, "fork_caught_factor")
    assert factor.formula is not None
    assert factor.formula.value == pytest.approx(2.72018, rel=1e-5)
    combination = load_of(scene, "combination_force[11.2,4]")
    assert combination.estimate.value == rope.estimate.value
    assert combination.solver == "caught_train"

    rigid = changed(RACK, hoisting__drive__largest_force="34531.2 N", rack__stiffness_vertical=None)
    assert load(rigid, "rope_force_caught").estimate.value == pytest.approx(67451.8, rel=1e-5)
    assert load(rigid, "fork_caught_factor").estimate.value == pytest.approx(4.29739, rel=1e-5)


def test_the_reduced_mass_is_that_of_the_driving_motor() -> None:
    """J u^2 eta/R^2 with the reeving, not the 1/eta^2 times as much of the braking mode."""
    parts = {"inertia": "0.3 kg*m^2", "ratio": 25, "gear_efficiency": 0.9, "drum_diameter": "400 mm"}
    spec = machine(changed(RACK, hoisting__drive=parts, hoisting__rope__efficiency=0.98))
    way = 0.2 / (25 * 2)
    scene = spec.all_scenes[0]
    assert catch_of(spec, scene).drive_mass == pytest.approx(0.3 * 0.9 * 0.98 / way**2, rel=1e-12)  # type: ignore[arg-type]


def test_only_the_speed_of_hoisting_moves_a_caught_fork() -> None:
    """Acceptance 4: changing one event's speed changes the combinations that hold it, and no other."""
    scenes = [{"type": "fork_caught"}, {"type": "fork_push"}, {"type": "rail"}]
    slow, fast = (report_of(changed(RACK, scenes=scenes, fork__speed=speed)) for speed in ("0.2 m/s", "0.3 m/s"))
    for one, other in zip(slow.scenes, fast.scenes, strict=True):
        marks = [item.info for item in one.loads if item.info.name.startswith("combination_force")]
        assert marks
        for mark in marks:
            same = load_of(other, mark.name).estimate.value == load_of(one, mark.name).estimate.value
            assert same == (mark.name != "combination_force[11.2,3]")


@pytest.mark.parametrize(("mass", "speed", "rack", "height"), [(400.0, 0.3, 5e5, 12.5), (60.0, 0.5, 2e5, 4.0)])
def test_a_push_as_integrated(mass: float, speed: float, rack: float, height: float) -> None:
    data = changed(
        RACK,
        fork={"mass": f"{mass} kg", "speed": f"{speed} m/s", "motor_force": "3 kN"},
        rack__stiffness_push=f"{rack} N/m",
        scenes=[{"type": "fork_push", "height": f"{height} m"}],
    )
    result = run(PUSH_TRAIN, data)
    support = 3 * 210e9 * 4e-4 / (height - 0.5) ** 3
    assert result.window is not None
    expected = stacker_ode.pushed(mass, 1600.0, rack, support, speed, 3000.0, result.window[1])
    assert value(result, "fork_push_force") == pytest.approx(expected, rel=1e-6)
    # without the column's way: energy of the fork and work of its drive
    rigid = 3000.0 + math.sqrt(3000.0**2 + rack * mass * speed**2)
    assert value(run(PUSH_RIGID, data), "fork_push_force") == pytest.approx(rigid, rel=1e-12)


def test_a_slip_clutch_limits_the_push() -> None:
    data = changed(RACK, fork__clutch_force="2 kN", fork__mass="50 kg", scenes=[{"type": "fork_push"}])
    found = run(PUSH_RIGID, data)
    assert value(found, "fork_push_force") == pytest.approx(2000.0 + 0.3 * math.sqrt(5e5 * 50.0), rel=1e-12)
    simulated = value(run(PUSH_TRAIN, data), "fork_push_force")
    assert 2000.0 < simulated <= push_of(machine(data), machine(data).all_scenes[0]).most  # type: ignore[arg-type]
    idle = changed(data, fork__clutch_force="5 kN")  # above the motor: it never slips
    pushes = 3000.0 + math.sqrt(3000.0**2 + 5e5 * 50.0 * 0.09)
    assert value(run(PUSH_RIGID, idle), "fork_push_force") == pytest.approx(pushes, rel=1e-12)


def _pushed_through_a_clutch(
    rotor: float, behind: float, speed: float, rack: float, motor: float, clutch: float
) -> float:
    """Largest force on the rack: rotor and motor, a clutch that sticks and slips, the fork; the column is rigid."""

    def sticks(time: float, state: np.ndarray) -> list[float]:
        return [state[1], (motor - rack * state[0]) / (rotor + behind)]

    def slips(time: float, state: np.ndarray) -> list[float]:
        return [state[1], (clutch - rack * state[0]) / behind]

    def given_way(time: float, state: np.ndarray) -> float:
        force = rack * state[0]
        return float(force + behind * (motor - force) / (rotor + behind) - clutch)

    given_way.terminal = True  # type: ignore[attr-defined]
    options = {"rtol": 1e-9, "atol": 1e-12, "max_step": 2e-4}
    first = solve_ivp(sticks, (0, 0.2), [0, speed], events=given_way, **options)
    tops = [first.y[0].max()]
    if first.status == 1:
        tops.append(solve_ivp(slips, (0, 0.2), first.y[:, -1], **options).y[0].max())
    return float(rack * max(tops))


@pytest.mark.parametrize("rotor", [50.0, 200.0, 1000.0])
def test_a_clutch_above_the_motor_slips_by_the_rotor_but_the_whole_mass_bounds_it(rotor: float) -> None:
    """With the mass behind the clutch alone the formula of the motor was up to 6 % too small."""
    fork = {"mass": f"{350 + rotor} kg", "speed": "0.3 m/s", "motor_force": "1.5 kN", "clutch_force": "2 kN"}
    data = changed(RACK, fork=fork, rack__stiffness_push="300 kN/m", scenes=[{"type": "fork_push"}])
    true = _pushed_through_a_clutch(rotor, 350.0, 0.3, 3e5, 1500.0, 2000.0)
    assert true > 1.03 * (1500.0 + math.sqrt(1500.0**2 + 3e5 * 350.0 * 0.3**2))
    assert true <= value(run(PUSH_RIGID, data), "fork_push_force") * (1 + 1e-9)


def test_a_column_guided_at_its_head_gives_less() -> None:
    free = machine(changed(RACK, scenes=[{"type": "fork_push", "height": "6.5 m"}]))
    held = machine(changed(RACK, scenes=[{"type": "fork_push", "height": "6.5 m"}], column__top_guide={}))
    stiff = [push_of(spec, spec.all_scenes[0]).support for spec in (free, held)]  # type: ignore[arg-type]
    assert stiff == pytest.approx([3 * 84e6 / 6**3, 48 * 84e6 / 12**3], rel=1e-12)
    bent = changed(RACK, scenes=[{"type": "fork_push"}], fork__arm="0.5 m", fork__torsion_stiffness="2 MN*m/rad")
    twists = push_of(machine(bent), machine(bent).all_scenes[0])  # type: ignore[arg-type]
    assert twists.support == pytest.approx(1 / (12**3 / (3 * 84e6) + 0.25 / 2e6), rel=1e-12)


C21: dict[str, Any] = changed(
    RACK,
    hoisting__speed="1 m/s",
    safety_gear={"type": "progressive", "force": "31392 N", "stroke": "300 mm", "trip_ratio": 1.4, "arm": "0.3 m"},
    column__section_modulus="2000 cm^3",
    scenes=[{"type": "safety_gear"}],
)


def test_c21_through_a_file() -> None:
    scene = scene_report(C21)
    printed = {
        "safety_gear_speed": 1.8905,
        "safety_gear_drop": 0.131192,
        "safety_gear_deceleration": 9.81,
        "safety_gear_distance": 0.182161,
        "safety_gear_factor": 2.0,
    }
    for name, number in printed.items():
        assert load_of(scene, name).estimate.value == pytest.approx(number, rel=1e-5), name
    bites = changed(C21, safety_gear__type="instantaneous", safety_gear__force=None, safety_gear__stiffness="4 MN/m")
    scene = scene_report(bites)
    assert load_of(scene, "safety_gear_force").estimate.value == pytest.approx(167748.0, rel=1e-5)
    assert load_of(scene, "safety_gear_factor").estimate.value == pytest.approx(10.6873, rel=1e-5)
    assert load_of(scene, "combination_force[11.2,6]").estimate.value == pytest.approx(167748.0, rel=1e-5)
    assert load_of(scene, "safety_gear_moment").estimate.value == pytest.approx(0.3 * 167748.0, rel=1e-5)
    assert load_of(scene, "column_stress").estimate.value > 0.3 * 167748.0 / 2e-3


@pytest.mark.parametrize("seed", range(4))
def test_a_safety_gear_as_integrated(seed: int) -> None:
    rng = np.random.default_rng(seed)
    speed, ratio, reaction = rng.uniform(0.2, 1.5), rng.uniform(1.2, 1.5), rng.uniform(0.0, 0.1)
    force, stiffness = rng.uniform(2e4, 6e4), 10 ** rng.uniform(6, 7)
    gear: dict[str, Any] = {"type": "progressive", "force": f"{force!r} N"}
    shared = {"stroke": "5 m", "trip_ratio": float(ratio), "reaction_time": f"{reaction!r} s"}
    data = changed(C21, hoisting__speed=f"{speed!r} m/s", safety_gear=gear | shared)
    begins, way, deep, _ = stacker_ode.caught_carriage(speed, ratio, reaction, 1600.0, force, 0.0)
    for name, expected in (("speed", begins), ("drop", way), ("distance", deep)):
        assert load(data, f"safety_gear_{name}").estimate.value == pytest.approx(expected, rel=1e-6), name
    gear = {"type": "instantaneous", "stiffness": f"{stiffness!r} N/m"}
    data = changed(C21, hoisting__speed=f"{speed!r} m/s", safety_gear=gear | shared)
    _, _, deep, most = stacker_ode.caught_carriage(speed, ratio, reaction, 1600.0, 0.0, stiffness)
    assert load(data, "safety_gear_distance").estimate.value == pytest.approx(deep, rel=1e-6)
    assert load(data, "safety_gear_force").estimate.value == pytest.approx(most, rel=1e-6)


def test_what_a_gear_leaves_at_the_end_of_its_stroke() -> None:
    short = scene_report(changed(C21, safety_gear__stroke="100 mm"))
    left = math.sqrt(1.8905**2 - 2 * 9.81 * 0.1)
    assert f"{left:.3g} m/s" in load_of(short, "safety_gear_distance").note
    loose = scene_report(changed(C21, safety_gear__force="15 kN"))
    assert math.isinf(load_of(loose, "safety_gear_distance").estimate.value)
    assert {item.code: item.verdict for item in loose.checks}["CRN291"] == "fail"


@pytest.mark.parametrize(("step", "speed"), [(1.0, 2.0), (4.0, 2.5), (6.0, 3.5)])
def test_a_step_of_the_rail_as_integrated(step: float, speed: float) -> None:
    """A wheel that climbs or comes down a step, and one that jumps."""
    data = changed(RACK, rail__step=f"{step} mm", travel__speed=f"{speed} m/s", scenes=[{"type": "rail"}])
    spec = machine(data)
    roll = roll_of(spec, spec.all_scenes[0])  # type: ignore[arg-type]
    seen = [
        stacker_ode.rolled(roll.frequency, speed, 0.2, step / 1000, 9.81, up, 0.1 + 6 * math.pi / roll.frequency)
        for up in (True, False)
    ]
    found = run(RAIL_JUMP, data)
    assert value(found, "phi4") == pytest.approx(max(high for high, _ in seen), rel=1e-6)
    least = min(low for _, low in seen)
    assert max(value(found, "rail_contact"), 0.0) == pytest.approx(least, rel=1e-6, abs=1e-9)
    if least > 0:
        closed = run(RAIL_RESPONSE, data)
        for name in ("phi4", "rail_contact", "wheel_force", "mast_deflection_max"):
            assert value(found, name) == pytest.approx(value(closed, name), rel=1e-9), name


def test_waves_of_the_rail() -> None:
    """Far below resonance a wave of 2 mm over 3 m at 1 m/s is followed: v = f lambda is far away."""
    waves = {"height": "2 mm", "length": "3 m"}
    data = changed(RACK, rail={"waviness": waves, "frequency": "10 Hz"}, travel__speed="1 m/s",
                   scenes=[{"type": "rail"}])  # fmt: skip
    rate = 2 * math.pi / 3
    growth = 1 / (1 - (rate / (20 * math.pi)) ** 2)
    assert load(data, "phi4").estimate.value == pytest.approx(1 + 0.001 * rate**2 / 9.81 * growth, rel=1e-9)
    resonance = changed(data, travel__speed="30 m/s")
    scene = scene_report(resonance)
    assert load_of(scene, "rail_detuning").estimate.value == pytest.approx(0.0, abs=1e-12)
    assert {item.code: item.verdict for item in scene.checks}["CRN294"] == "fail"


@pytest.mark.parametrize(("rail", "speed"), [({"step": "2 mm"}, 2.0), ({"step": "2 mm"}, 3.3), ({"gap": "30 mm"}, 0.7)])
def test_the_swing_of_the_column_as_integrated(rail: dict[str, str], speed: float) -> None:
    data = changed(RACK, rail=rail | {"frequency": "10 Hz"}, travel__speed=f"{speed} m/s", scenes=[{"type": "rail"}])
    # a cantilever of 12 m: 33/140 of its 1800 kg swing with the 1600 kg, 11/40 are driven by a tilt
    swings, stiff = 1600 + 1800 * 33 / 140, 3 * 84e6 / 12**3
    frequency, driven = math.sqrt(stiff / swings), 12 * (1600 + 1800 * 11 / 40) / swings
    step, gap = (0.002, 0.0) if "step" in rail else (0.0, 0.03)
    swing = stacker_ode.tilted(frequency, driven, 4.0, speed, 0.2, step, gap, 2 * math.pi / frequency)
    found = run(RAIL_RESPONSE, data)
    assert value(found, "mast_deflection_max") == pytest.approx(swing, rel=1e-6)
    assert value(found, "mast_force_max") == pytest.approx(swing * stiff, rel=1e-6)
    assert value(found, "mast_moment_max") == pytest.approx(swing * stiff * driven, rel=1e-6)


def test_a_tilting_base_swings_the_column() -> None:
    """A slow climb tilts the column without any swing; the head follows the base."""
    slow = changed(RACK, travel__speed="0.01 m/s", scenes=[{"type": "rail"}])
    fast = changed(RACK, scenes=[{"type": "rail"}])
    assert load(slow, "mast_deflection_max").estimate.value < 2e-4
    tilt = 0.001 * 12.0 / 4.0
    # a sudden tilt of the base is at most felt twice, and again by the other wheel
    assert 0.5 * tilt < load(fast, "mast_deflection_max").estimate.value < 4 * tilt * 1.1


def test_buffers_take_the_guided_load_too() -> None:
    scene = scene_report(changed(RACK, scenes=[{"type": "buffer", "speed_share": 0.7}]))
    mass, hard = 2500.0 + 1800.0 + 1600.0, 2 * 2e5
    force = 1.4 * math.sqrt(mass * hard)
    assert load_of(scene, "buffer_force").estimate.value == pytest.approx(force / 2, rel=1e-12)
    assert load_of(scene, "buffer_stroke").estimate.value == pytest.approx(force / hard, rel=1e-12)
    assert load_of(scene, "phi7").estimate.value == pytest.approx(1.25)
    pushed = scene_report(changed(RACK, scenes=[{"type": "buffer", "drive": "on"}]))
    push = 0.4 * mass
    expected = push + math.sqrt(push**2 + mass * hard * 4)
    assert load_of(pushed, "buffer_force").estimate.value == pytest.approx(expected / 2, rel=1e-12)


def test_a_motor_that_would_not_lift_is_told() -> None:
    report = report_of(changed(RACK, hoisting__drive__largest_force="9 kN"))
    said = [item.message for item in report.diagnostics if item.code == "NUM110"]
    assert len(said) == 1
    assert "below the weight" in said[0]
    weak = load_of(report.scenes[0], "rope_force_caught").estimate.value
    assert weak == load(RACK, "rope_force_caught").estimate.value


# -- both sides of a threshold ---------------------------------------------------------------------------------------


def matters(data: dict[str, Any], name: str) -> bool:
    """Whether an effect reaches its threshold; one that is not in every run is skipped below it."""
    effect = next(effect for effect in scene_report(data).effects if effect.name == name)
    assert effect.criterion is not None
    if name not in IN_EVERY_RUN:
        assert (str(effect.state) == "skipped") == (not effect.criterion.exceeded)
    return effect.criterion.exceeded


IN_EVERY_RUN = {"fork_catching", "fork_pushing", "aisle_rail", "safety_gear"}


def verdict(data: dict[str, Any], code: str) -> str:
    return next(str(item.verdict) for item in scene_report(data).checks if item.code == code)


@pytest.mark.parametrize(
    ("effect", "below", "above"),
    [
        ("fork_catching", {"hoisting__speed": "5 mm/s"}, {"hoisting__speed": "0.3 m/s"}),
        ("rack_elasticity", {"rack__stiffness_vertical": "20 MN/m"}, {"rack__stiffness_vertical": "2 MN/m"}),
        ("hoist_motor_slope", {"hoisting__drive__slope": "2 kN*s/m"}, {"hoisting__drive__slope": "40 kN*s/m"}),
        (
            "load_limiter",
            {"hoisting__limiter": {"force": "90 kN", "reaction": "20 ms"}},
            {"hoisting__limiter": {"force": "20 kN", "reaction": "20 ms"}},
        ),
    ],
)
def test_effects_of_a_caught_fork_on_both_sides(effect: str, below: dict[str, Any], above: dict[str, Any]) -> None:
    assert not matters(changed(RACK, **below), effect)
    assert matters(changed(RACK, **above), effect)


@pytest.mark.parametrize(
    ("effect", "scene", "below", "above"),
    [
        ("fork_pushing", "fork_push", {"fork__speed": "4 mm/s"}, {}),
        ("column_yield", "fork_push", {"column__second_moment": "4000000 cm^4"}, {}),
        ("aisle_rail", "rail", {"travel__speed": "0.05 m/s"}, {}),
        ("wheel_lift", "rail", {}, {"rail__step": "6 mm", "travel__speed": "3.5 m/s"}),
    ],
)
def test_effects_of_other_events_on_both_sides(
    effect: str, scene: str, below: dict[str, Any], above: dict[str, Any]
) -> None:
    data = changed(RACK, scenes=[{"type": scene}])
    assert not matters(changed(data, **below), effect)
    assert matters(changed(data, **above), effect)


STRONG_MOTOR = {"hoisting__drive__largest_force": "34 kN"}


@pytest.mark.parametrize(
    ("effect", "code", "changes"),
    [
        ("rack_elasticity", "CRN284", {"checks__fork_caught_factor": 2.7}),
        ("hoist_motor_slope", "CRN284", {"hoisting__drive__slope": "40 kN*s/m", "checks__fork_caught_factor": 3.0}),
        (
            "load_limiter",
            "CRN284",
            {
                **STRONG_MOTOR,
                "hoisting__limiter": {"force": "20 kN", "reaction": "10 ms", "braking_force": "20 kN"},
                "checks__fork_caught_factor": 3.2,
            },
        ),
    ],
)
def test_an_effect_decides_a_verdict(effect: str, code: str, changes: dict[str, Any]) -> None:
    """The same machine without the effect gets another verdict."""
    data = changed(RACK, **changes)
    assert verdict(data, code) != verdict(changed(data, effects={effect: "off"}), code)


def test_a_column_that_yields_decides_a_verdict() -> None:
    data = changed(RACK, scenes=[{"type": "fork_push"}], rack__rating_push="8.185 kN")
    assert verdict(data, "CRN287") == "pass"
    assert verdict(changed(data, effects={"column_yield": "off"}), "CRN287") == "fail"


def test_wheels_that_jump_decide_a_verdict() -> None:
    """The factor of a wheel that stays on the rail decides nothing where it does not stay."""
    data = changed(RACK, rail__step="6 mm", travel__speed="3.5 m/s", scenes=[{"type": "rail"}])
    assert verdict(data, "CRN293") == "fail"
    assert load(data, "phi4").solver == "aisle_rail_jump"
    assert load(changed(RACK, scenes=[{"type": "rail"}]), "phi4").solver == "aisle_rail_answer"


def test_a_bound_decides_where_it_is_enough() -> None:
    """A strong rope needs no run: the closed form with its bounds passes the check."""
    scene = scene_report(changed(RACK, hoisting__rope__breaking_force="400 kN"))
    assert [one.name for one in scene.solvers if one.decides][:1] == ["caught_stopped"]
    assert {item.code: str(item.verdict) for item in scene.checks}["CRN285"] == "pass"


# -- bad input -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("safety_gear: {type: progressive, force: 30 kN}", "stroke"),
        ("safety_gear: {type: progressive, force: 30 kN, stroke: 0 mm}", "stroke"),
        ("safety_gear: {type: instantaneous, stroke: 100 mm}", "stiffness"),
        ("safety_gear: {type: progressive, force: 30 kN, stroke: 100 mm, trip_ratio: 0.9}", "trip_ratio"),
        ("safety_gear: {type: progressive, force: .nan kN, stroke: 100 mm}", "force"),
        ("rack: {stiffness_push: 0 N/m}", "stiffness_push"),
        ("rack: {stiffness_vertical: 2 MN/m}", "stiffness_push"),
        ("fork: {mass: 0 kg, speed: 0.3 m/s, motor_force: 3 kN}", "mass"),
        ("fork: {mass: 400 kg, speed: -0.3 m/s, motor_force: 3 kN}", "speed"),
        ("rail: {waviness: {height: 2 mm}}", "length"),
        ("rail: {step: -1 mm}", "step"),
    ],
)
def test_bad_input_is_told_at_its_line(line: str, words: str) -> None:
    blocks = {
        "rack": "rack: {stiffness_vertical: 2.5 MN/m, stiffness_push: 500 kN/m}",
        "fork": "fork: {mass: 400 kg, speed: 0.3 m/s, motor_force: 3 kN}",
        "safety_gear": "safety_gear: {type: progressive, force: 31 kN, stroke: 300 mm}",
        "rail": "rail: {step: 1 mm}",
    }
    blocks[line.partition(":")[0]] = line
    text = "\n".join(
        [
            "kind: crane",
            "type: rack_stacker",
            "load: 1 t",
            "base: {mass: 2.5 t, wheel_base: 4 m, wheel_diameter: 400 mm}",
            "column: {length: 12 m, mass: 1800 kg, second_moment: 40000 cm^4}",
            "carriage: {mass: 600 kg, rollers: {distance: 1.2 m, diameter: 160 mm, axle_diameter: 50 mm}}",
            "hoisting: {speed: 0.3 m/s, acceleration: 0.4 m/s^2, rope: {falls: 2}}",
            "travel: {speed: 2 m/s, acceleration: 0.4 m/s^2, deceleration: 0.4 m/s^2}",
            *blocks.values(),
        ]
    )
    report = check(load_text(text.encode(), "bad.yaml"), Options())
    faults = [one for one in report.diagnostics if one.severity.value == "error"]
    assert len(faults) == 1, [one.message for one in faults]
    (fault,) = faults
    assert words in f"{fault.message} {fault.hint} {fault.path}"
    assert fault.span is not None
    assert text.splitlines()[fault.span.line - 1] == line
