"""Horizontal curves of whole conveyors: sums over every filling, energy of a ribbon, finite elements of a start."""

import itertools
import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.optimize import minimize_scalar
from support.belt_fem import Motion
from support.belt_scenes import Drive, Rig, counts_of
from support.machines import changed, load_of, report_of, scene_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.report import Judgement, SceneReport

G = 9.81
WIDTH, MIDDLE, ANGLE, V_ANGLE = 1.2, 0.465, math.radians(35), math.radians(15)
RIG = Rig(sections=((300.0, 3.0), (400.0, -6.0), (200.0, 8.0)), tension=60e3, drives={"head": Drive(torque=3000.0)})
BOTH = {"head": Drive(torque=2000.0), "booster": Drive(torque=1000.0, at="tail")}
CURVE = {"radius": "2000 m", "banking": "5 deg", "banking_return": "4 deg"}


def curved(rig: Rig, scene: dict[str, Any], curve: dict[str, Any] = CURVE, **more: Any) -> dict[str, Any]:
    """A rig whose second section is curved."""
    data = changed(
        rig.data(scene),
        belt__width=f"{WIDTH!r} m",
        idlers__carry__trough={"angle": "35 deg", "middle_roll": f"{MIDDLE!r} m"},
        load__density="1600 kg/m^3",
        load__surcharge_angle="15 deg",
        checks={"belt_drift": "95 mm"},
        route__sections__1__horizontal_curve=curve,
    )
    data["idlers"]["return"]["trough"] = {"angle": "15 deg", "middle_roll": "0 mm"}
    return changed(data, **more)


def ran(rig: Rig = RIG, **more: Any) -> SceneReport:
    return scene_of(report_of(curved(rig, {"type": "run"}, **more)))


def check_of(scene: SceneReport, code: str, element: str) -> Judgement:
    (found,) = [one for one in scene.checks if (one.code, one.element) == (code, element)]
    return found


# --- tensions --------------------------------------------------------------------------------------------------------


def around(rig: Rig, filling: tuple[bool, ...], at_tail: bool = False) -> tuple[np.ndarray, np.ndarray]:
    """Tension of the return and of the carrying strand at the ends of the sections, counted from the tail."""
    full, empty = rig.lengths(), rig.lengths("empty")
    count = len(rig.sections)
    belt = [*empty[:count], *((full if loaded else empty)[count + k] for k, loaded in enumerate(filling))]
    rises = np.concatenate([[0.0], np.cumsum([one.length * (one.friction + one.climb) for one in belt])])
    marks = np.concatenate([[0.0], np.cumsum([one.length for one in belt])])
    forces = [drive.force for drive in rig.drives.values()]
    boosted = sum(drive.force for drive in rig.drives.values() if drive.at == "tail") / sum(forces) * rises[-1]
    mean = float(np.sum(np.diff(marks) * (rises[1:] + rises[:-1]) / 2)) / marks[-1] - boosted / 2
    start = rig.tension - (mean if rig.rigid else 0.0)
    if at_tail:  # the mean of both sides of the tail pulley is the tension of the weight
        start = rig.tension - rises[count] + boosted / 2
    return (start + rises[: count + 1])[::-1], start - boosted + rises[count:]


@pytest.mark.parametrize(
    ("rig", "at_tail"),
    [
        (RIG, False),
        (replace(RIG, rigid=True, tension=70e3), False),
        (replace(RIG, drives=BOTH), False),
        (replace(RIG, rigid=True, tension=70e3, drives=BOTH), False),
        (replace(RIG, tension=80e3), True),
    ],
    ids=["gravity", "rigid", "gravity, tail drive", "rigid, tail drive", "weight at the tail"],
)
def test_tensions_in_a_curve_are_the_extremes_of_all_fillings(rig: Rig, at_tail: bool) -> None:
    scene = ran(rig, **({"takeup__at": "tail"} if at_tail else {}))
    ends: dict[str, list[float]] = {"2_carry_full": [], "2_carry_empty": [], "2_return": []}
    for filling in itertools.product((False, True), repeat=3):
        back, carry = around(rig, filling, at_tail)
        ends[f"2_carry_{'full' if filling[1] else 'empty'}"] += carry[1:3].tolist()
        ends["2_return"] += back[1:3].tolist()
    for name, tensions in ends.items():
        assert load_of(scene, f"tension_bend_min[{name}]").estimate.value == pytest.approx(min(tensions), rel=1e-9)
        assert load_of(scene, f"tension_bend_max[{name}]").estimate.value == pytest.approx(max(tensions), rel=1e-9)


def test_unlike_drives_at_both_ends_leave_the_drift_open() -> None:
    """Without curves of the motors, unequal pulleys share the pull nobody knows how."""
    drives = {"head": Drive(torque=2000.0), "booster": Drive(torque=1000.0, at="tail", ratio=20.4)}
    scene = ran(replace(RIG, drives=drives))
    assert check_of(scene, "CNV150", "2_carry").verdict is Verdict.UNDECIDED


# --- drift -----------------------------------------------------------------------------------------------------------


def lowest(belt: tuple[float, float, float], weight: float, pull: float, load: tuple[float, float]) -> float:
    """Drift of least energy of a belt in strips with a load of so many kg/m that pushes outward by so much [N/m]."""
    middle, angle, banking = belt
    s = np.linspace(-WIDTH / 2, WIDTH / 2, 60_001)
    share = np.full(len(s), 1 / len(s))
    carried = np.zeros(len(s))
    if load[0]:
        carried = _spread(s, middle, angle, load[0] / 1600, math.radians(15))

    def energy(y: float) -> float:
        wing = np.sign(s + y) * np.maximum(np.abs(s + y) - middle / 2, 0.0)
        x = np.clip(s + y, -middle / 2, middle / 2) + wing * math.cos(angle)
        z = np.abs(wing) * math.sin(angle)
        inward, up = x * math.cos(banking) - z * math.sin(banking), x * math.sin(banking) + z * math.cos(banking)
        whole = share @ (weight * up - pull * inward) + carried @ (load[0] * G * up + load[1] * inward)
        return float(whole)

    found = minimize_scalar(energy, bounds=(-WIDTH / 2, WIDTH / 2), method="bounded", options={"xatol": 1e-9})
    return float(found.x)


def _spread(s: np.ndarray, middle: float, angle: float, area: float, surcharge: float) -> np.ndarray:
    """Share of a load on each strip: the bed is widened until its cross-section is right."""

    def depths(side: float) -> np.ndarray:
        wing = np.maximum(np.abs(s) - middle / 2, 0.0)
        x = np.clip(np.abs(s), 0, middle / 2) + wing * math.cos(angle)
        half = middle / 2 + side * math.cos(angle)
        deep = np.maximum(side - wing, 0.0) * math.sin(angle)
        deep += np.maximum(math.tan(surcharge) * (half**2 - x**2) / (2 * half), 0.0)
        return np.where(wing <= side, deep, 0.0) * np.where(wing > 0, math.cos(angle), 1.0)

    step, low, high = float(s[1] - s[0]), 0.0, (WIDTH - middle) / 2
    for _ in range(50):
        half = (low + high) / 2
        low, high = (half, high) if depths(half).sum() * step < area else (low, half)
    found = depths(low)
    return found / found.sum()


@pytest.mark.parametrize("seed", range(6))
def test_the_interval_of_the_drift_begins_at_the_ribbon_of_lowest_energy(seed: int) -> None:
    """The drift by its energy is one of the three rules, so it lies in the interval; inward it is the least of them."""
    rng = np.random.default_rng(seed)
    heights = rng.uniform(-0.01, 0.02, 3).tolist()
    sections = tuple((length, length * climb) for length, climb in zip((300.0, 400.0, 200.0), heights, strict=True))
    rig = replace(
        RIG, sections=sections, belt=rng.uniform(15, 30), load=rng.uniform(60, 200), tension=rng.uniform(40e3, 90e3)
    )
    radius, banking = rng.uniform(900, 2500), math.radians(rng.uniform(0, 8))
    curve = {"radius": f"{radius!r} m", "banking": f"{banking!r} rad", "banking_return": f"{banking!r} rad"}
    scene = ran(rig, curve=curve)
    cosine = math.cos(math.asin(heights[1]))
    shapes = {"carry": (MIDDLE, ANGLE, banking), "return": (0.0, V_ANGLE, banking)}
    states = {"carry": (("2_carry_full", rig.load), ("2_carry_empty", 0.0)), "return": (("2_return", 0.0),)}
    for strand, shape in shapes.items():
        for code, end, side in (("CNV150", "max", 1), ("CNV151", "min", -1)):
            drifts = []
            for state, load in states[strand]:
                tension = load_of(scene, f"tension_bend_{end}[{state}]").estimate.value
                pull = (tension - rig.belt * rig.speed**2) / radius
                push = load * rig.speed**2 / radius / cosine  # energy per weight square to the slope
                found = lowest(shape, rig.belt * G, pull / cosine, (load, push))
                drifts.append(side * found)
            check = check_of(scene, code, f"2_{strand}")
            assert check.value is not None
            reach = 1e-5 + 1e-9
            assert check.value.low - reach <= max(drifts) <= check.value.high + reach
            if side > 0 and 0.02 < max(drifts) < 0.35 and strand == "return":
                assert check.value.low == pytest.approx(max(drifts), abs=2e-5)
            assert check.value.low <= check.value.value <= check.value.high


def test_a_curve_by_hand() -> None:
    """An empty level belt of one filling: T = 60 kN + 0.022 1.1 9.81 (28 200 + 40 300) at the tail and so on; rule of
    part II: y = (p B/W - sin(beta) (l + 2 e cos(lambda)))/(2 sin(lambda) cos(beta))."""
    rig = replace(RIG, sections=((300.0, 0.0), (400.0, 0.0), (200.0, 0.0)), load=1e-9)
    per = 0.022 * 1.1 * G
    tension = 60e3 + per * (28 * 900 + 40 * 700)  # at the end of the curve on the carrying strand
    pull = (tension - 20 * 16) / 2000
    beta, level = math.radians(5), MIDDLE + (WIDTH - MIDDLE) * math.cos(ANGLE)
    expected = (pull * WIDTH / (20 * G) - math.sin(beta) * level) / (2 * math.sin(ANGLE) * math.cos(beta))
    check = check_of(ran(rig), "CNV150", "2_carry")
    assert check.value is not None
    assert check.value.value == pytest.approx(expected, rel=1e-7)
    outer = math.cos(ANGLE)
    first = (pull * WIDTH / (20 * G) - math.sin(beta) * (MIDDLE + (WIDTH - MIDDLE) * outer**2)) / (
        2 * math.sin(ANGLE) * outer * math.cos(beta)
    )
    ribbon = level / (2 * math.sin(ANGLE)) * math.tan(math.atan(pull / (20 * G)) - beta)
    assert (check.value.low, check.value.high) == pytest.approx((ribbon, first), rel=1e-7)


def test_the_verdict_turns_at_the_radii_of_the_rules() -> None:
    """Fails below the radius at which the ribbon drifts by 95 mm, passes above that of part I."""
    tension = load_of(ran(), "tension_bend_max[2_carry_empty]").estimate.value - 20 * 16
    cosine, beta, y = math.sqrt(1 - (6 / 400) ** 2), math.radians(5), 0.095
    level, per_width = MIDDLE + (WIDTH - MIDDLE) * math.cos(ANGLE), 20 * G * cosine / WIDTH
    ribbon = WIDTH * per_width * math.tan(beta + math.atan(2 * y * math.sin(ANGLE) / level))
    first = per_width * (
        math.sin(beta) * (MIDDLE + (WIDTH - MIDDLE) * math.cos(ANGLE) ** 2)
        + 2 * y * math.sin(ANGLE) * math.cos(ANGLE) * math.cos(beta)
    )
    turns = {
        tension / ribbon * 0.999: Verdict.FAIL,
        tension / ribbon * 1.001: Verdict.UNDECIDED,
        tension / first * 0.999: Verdict.UNDECIDED,
        tension / first * 1.001: Verdict.PASS,
    }
    for radius, verdict in turns.items():
        assert check_of(ran(curve=CURVE | {"radius": f"{radius!r} m"}), "CNV150", "2_carry").verdict is verdict


def test_the_free_edge_of_the_standards_is_assumed() -> None:
    """0.05 B + 25 mm of 1200 mm: 85 mm, tried 20 % to either side."""
    data = curved(RIG, {"type": "run"})
    del data["checks"]
    report = report_of(data)
    (assumed,) = [one for one in report.assumed if one.path == ("checks", "belt_drift")]
    assert assumed.value == pytest.approx(0.085)
    assert (assumed.interval.low, assumed.interval.high) == pytest.approx((0.068, 0.102))


# --- edges -----------------------------------------------------------------------------------------------------------


def test_the_outer_edge_is_stretched_and_the_inner_one_relieved() -> None:
    scene = ran()
    for strand, half in (("carry", (MIDDLE + (WIDTH - MIDDLE) * math.cos(ANGLE)) / 2),
                         ("return", WIDTH * math.cos(V_ANGLE) / 2)):  # fmt: skip
        states = ("2_carry_full", "2_carry_empty") if strand == "carry" else ("2_return",)
        least = min(load_of(scene, f"tension_bend_min[{one}]").estimate.value for one in states)
        most = max(load_of(scene, f"tension_bend_max[{one}]").estimate.value for one in states)
        more = RIG.stiffness * half / 2000
        for end, value in (("max", most + more), ("min", least - more)):
            found = load_of(scene, f"fibre_tension_{end}[bend_2_{strand}]").estimate.value
            assert found == pytest.approx(value / WIDTH, rel=1e-9)


# --- starts ----------------------------------------------------------------------------------------------------------


RAMP = 4.0
SCENES: dict[str, tuple[dict[str, Any], dict[str, Any], Callable[[Rig, float, int], Motion]]] = {
    "start": (
        {"type": "start", "profile": {"shape": "ramp", "control": "torque", "time": f"{RAMP} s"}},
        {},
        lambda rig, window, elements: rig.started(lambda time: min(time / RAMP, 1.0), window, elements),
    ),
    "stop": (
        {"type": "stop"},
        {"resistance__stop_factor": 1.0},
        lambda rig, window, elements: rig.stopped(window, elements),
    ),
}


@pytest.mark.parametrize("scene_type", SCENES)
def test_starts_and_stops_pull_in_the_curve_as_finite_elements_say(scene_type: str) -> None:
    written, more, simulated = SCENES[scene_type]
    scene = scene_of(report_of(curved(RIG, written, **more)))
    ends = {f"tension_bend_{end}[{state}]": (end, state) for end in ("min", "max")
            for state in ("2_carry_full", "2_return")}  # fmt: skip
    window = load_of(scene, "tension_bend_max[2_return]").window
    assert window is not None
    found: dict[str, list[float]] = {name: [] for name in ends}
    for elements in (200, 400):
        motion = simulated(RIG, window[1], elements)
        counts = counts_of(RIG.lengths(), elements)
        sizes = np.repeat([o.length / n for o, n in zip(RIG.lengths(), counts, strict=True)], counts)
        marks = np.concatenate([[0.0], np.cumsum(sizes)])
        for name, (end, state) in ends.items():
            start = 200.0 if state == "2_return" else 900.0 + 300.0  # from the head's run-off
            touched = (marks[:-1] < start + 400.0 - 1e-6) & (marks[1:] > start + 1e-6)
            tensions = (motion.highest if end == "max" else motion.lowest)[touched]
            found[name].append(float(tensions.max() if end == "max" else tensions.min()))
    for name, (coarse, fine) in found.items():
        estimate = load_of(scene, name).estimate
        assert abs(fine - estimate.value) <= estimate.bar + 2 * abs(fine - coarse)
        assert fine == pytest.approx(estimate.value, abs=0.02 * RIG.tension)
    assert "tension_bend_max[2_carry_empty]" not in {one.info.name for one in scene.loads}


# --- straight conveyors ----------------------------------------------------------------------------------------------


def test_a_straight_conveyor_has_no_line_of_curves() -> None:
    report = report_of(changed(curved(RIG, {"type": "run"}), route__sections__1__horizontal_curve=None))
    scene = scene_of(report)
    assert not [one for one in scene.checks if one.code in ("CNV150", "CNV151")]
    assert not [one for one in scene.loads if "bend" in one.info.name]
