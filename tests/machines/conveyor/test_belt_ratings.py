"""Strength of the splice, rolls of the idlers and sag by strand, against arithmetic and geometry of their own."""

import itertools
import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from support.belt_scenes import Drive, Rig
from support.machines import changed, load_of, report_of, scene_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.report import Judgement, SceneReport

G = 9.81
RIG = Rig(sections=((200.0, -4.0), (300.0, 22.0), (100.0, 1.0)), drives={"head": Drive(torque=4000.0)})
TROUGH = {"angle": "35 deg", "middle_roll": "380 mm"}
BELT = {"belt__width": "1000 mm", "belt__strength": "2000 N/mm", "belt__carcass": "steel_cord"}
OPEN = {"conditions": "normal", "life": "normal"}
SPLICE = OPEN | {"reference_strength": 0.45}
ROW = {"carry": {"line_mass": "20 kg/m", "pitch": "1.2 m"}, "return": {"line_mass": "8 kg/m", "pitch": "3 m"}}


def ran(rig: Rig = RIG, scene: dict[str, Any] | None = None, **changes: Any) -> SceneReport:
    return scene_of(report_of(changed(rig.data(scene or {"type": "run"}), **changes)))


def value(scene: SceneReport, name: str) -> float:
    return load_of(scene, name).estimate.value


def check_of(scene: SceneReport, code: str, element: str = "") -> Judgement:
    (found,) = [one for one in scene.checks if one.code == code and one.element == element]
    return found


def tensions(rig: Rig = RIG, loaded: str = "full") -> list[float]:
    """Tensions at the ends of the sections from the head's run-off on: return strand, then carrying strand."""
    ends = [rig.tension]
    for one in rig.lengths(loaded):
        ends.append(ends[-1] + one.length * (one.friction + one.climb))
    return ends


def at_the_head() -> list[float]:
    """Tension entering the pulley for every choice of loaded sections."""
    full, empty = RIG.lengths(), RIG.lengths("empty")
    rises = [[one.length * (one.friction + one.climb) for one in part] for part in (empty, full)]
    fillings = itertools.product((0, 1), repeat=3)
    return [RIG.tension + sum(rises[0][:3]) + sum(rises[full][3 + k] for k, full in enumerate(one)) for one in fillings]


def edge_strain(length: float) -> float:
    """Strain of the edge over the mean of a belt of 1 m: straight fibres in space from the pulley to the trough."""
    y = np.linspace(0.0, 0.5, 200_001)
    wing, angle = np.maximum(y - 0.19, 0.0), math.radians(35)
    strain = np.sqrt(length**2 + (wing * (1 - math.cos(angle))) ** 2 + (wing * math.sin(angle)) ** 2) / length - 1
    return float(strain.max() - np.trapezoid(strain, y) / 0.5)


# --- splice ----------------------------------------------------------------------------------------------------------


def test_the_reserve_of_the_splice_counts_the_edge_at_the_head() -> None:
    splice = {"reference_strength": 0.42, "conditions": "poor", "life": "long"}
    scene = ran(
        **BELT, belt__splice=splice, idlers__carry__trough=TROUGH, transitions={"head": {"length": "2 m"}}
    )  # fmt: skip
    across, addition = value(scene, "belt_tension_width_max"), RIG.stiffness * edge_strain(2.0)
    assert across == pytest.approx(max(at_the_head()) + addition, rel=2e-3)
    judged = check_of(scene, "CNV130")
    assert judged.value is not None
    assert judged.value.value == pytest.approx(2e6 * 0.42 / (across * 1.2 * 1.9), rel=1e-12)
    assert judged.verdict is Verdict.PASS


def test_a_flat_belt_has_the_tension_of_the_belt() -> None:
    scene = ran(**BELT, belt__splice=SPLICE)
    assert value(scene, "belt_tension_width_max") == pytest.approx(max(tensions()), rel=1e-9)


def test_a_start_adds_the_edge_at_the_head_to_the_tension_entering_the_pulley() -> None:
    """The belt has its maximum at the head: both ends of the bar are that tension with the same edge addition."""
    start = {"type": "start", "profile": {"shape": "ramp", "control": "torque", "time": "12 s"}}
    more = {"idlers__carry__trough": TROUGH, "transitions": {"head": {"length": "2 m"}}}
    scene = ran(scene=start, **BELT, belt__splice=SPLICE, **more)
    bar, judged = load_of(scene, "tension_max").estimate, check_of(scene, "CNV130").value
    addition = RIG.stiffness * edge_strain(2.0)
    assert judged is not None
    for reserve, tension in ((judged.low, bar.high), (judged.high, bar.low), (judged.value, bar.value)):
        assert 2e6 * 0.45 / (reserve * 1.1 * 1.7) == pytest.approx(tension + addition, rel=2e-3)


def test_the_splice_of_a_belt_with_unknown_load_sharing_is_undecided() -> None:
    """Drives at both ends, of which only one has the curve of its motor: no tension has a bound."""
    drives = {"head": Drive(torque=3000.0), "booster": Drive(torque=1000.0, at="tail")}
    curve = {"type": "induction", "power": "300 kW", "speed": "1480 rpm", "synchronous_speed": "1500 rpm"}
    more = {"drives__head__motor__curve": curve | {"overload": 2.5}}
    scene = ran(replace(RIG, drives=drives), **BELT, belt__splice=SPLICE, **more)
    assert math.isinf(load_of(scene, "belt_tension_width_max").estimate.high)
    assert check_of(scene, "CNV130").verdict is Verdict.UNDECIDED


@pytest.mark.parametrize(("carcass", "ends"), [("steel_cord", (0.40, 0.50)), ("textile", (0.30, 0.35))])
def test_an_omitted_reference_strength_is_evaluated_at_both_ends(carcass: str, ends: tuple[float, float]) -> None:
    """A belt that needs a value between the ends of the interval is undecided; a stronger one passes."""
    most = max(tensions())
    for needed, verdict in ((sum(ends) / 2, Verdict.UNDECIDED), (0.99 * ends[0], Verdict.PASS)):
        strength = most * 1.1 * 1.7 / needed
        scene = ran(
            belt__width="1000 mm", belt__strength=f"{strength!r} N/m", belt__carcass=carcass, belt__splice=OPEN
        )  # fmt: skip
        assert check_of(scene, "CNV130").verdict is verdict


# --- sag by strand ---------------------------------------------------------------------------------------------------


def test_each_strand_has_its_own_sag() -> None:
    scene = ran(idlers=ROW, checks={"sag_carry": "0.5 %", "sag_return": "2 %"})
    ends = tensions()
    cosines = [math.sqrt(1 - (lift / length) ** 2) for length, lift in RIG.sections]
    back = [20 * c * G * 3 / 8 / min(ends[k], ends[k + 1]) for k, c in enumerate(reversed(cosines))]
    carry = [140 * c * G * 1.2 / 8 / min(ends[k + 3], ends[k + 4]) for k, c in enumerate(cosines)]
    assert value(scene, "sag_strand_max[carry]") == pytest.approx(max(carry), rel=1e-9)
    assert value(scene, "sag_strand_max[return]") == pytest.approx(max(back), rel=1e-9)
    assert check_of(scene, "CNV131", "carry").verdict is Verdict.PASS


def test_a_strand_without_a_limit_has_no_check() -> None:
    scene = ran(idlers=ROW, checks={"sag_return": "2 %"})
    assert [one.element for one in scene.checks if one.code == "CNV131"] == ["return"]


# --- rolls -----------------------------------------------------------------------------------------------------------

ROLL = {"diameter": "133 mm", "dynamic_load_rating": "20 kN", "dynamic_factor": 1.25}


def test_the_roll_in_a_convex_curve_carries_the_tension_of_the_curve() -> None:
    """Middle roll of three on the carrying strand and single roll on the return strand, each by hand."""
    radius = 60.0
    idlers = {
        "carry": ROW["carry"] | {"trough": TROUGH, "roll": ROLL | {"load_share": 0.66}},
        "return": ROW["return"] | {"roll": ROLL},
    }
    scene = ran(idlers=idlers, belt__width="1000 mm", route__sections__2__curve_radius=f"{radius!r} m")
    before, after = (math.asin(lift / length) for length, lift in RIG.sections[1:])
    reach = radius * math.tan(abs(after - before) / 2)
    ends, marks = tensions(), [0.0, *np.cumsum([one.length for one in RIG.lengths()])]
    loads = {}
    for strand, place, mass, pitch, own in (("carry", 1100.0, 140, 1.2, 20 * 1.2 / 3), ("return", 100.0, 20, 3.0, 24)):
        most = max(float(np.interp(place + side * reach, marks, ends)) for side in (-1, 1))
        weight = mass * G * pitch * max(math.cos(before), math.cos(after))
        share = 0.66 if strand == "carry" else 1.0
        loads[strand] = share * (1.25 * weight + most * pitch / radius) + own * G
        assert value(scene, f"roll_load_max[{strand}]") == pytest.approx(loads[strand], rel=1e-9)
        turns = 4.0 / (math.pi * 0.133)
        life = 1e6 / turns * (20e3 / (loads[strand] / 2)) ** 3
        assert value(scene, f"roll_speed[{strand}]") == pytest.approx(2 * math.pi * turns, rel=1e-9)
        assert value(scene, f"bearing_life[{strand}]") == pytest.approx(life, rel=1e-9)


def test_a_straight_belt_loads_the_rolls_by_weight_alone() -> None:
    idlers = {"carry": ROW["carry"] | {"roll": ROLL}, "return": ROW["return"]}
    scene = ran(replace(RIG, sections=((500.0, 0.0),)), idlers=idlers)
    assert value(scene, "roll_load_max[carry]") == pytest.approx(G * (1.25 * 140 * 1.2 + 24), rel=1e-9)
    assert not [one for one in scene.loads if one.info.name == "roll_load_max[return]"]


def test_a_required_life_names_the_missing_rating() -> None:
    idlers = {"carry": ROW["carry"] | {"roll": {"diameter": "133 mm"}}, "return": ROW["return"]}
    scene = ran(idlers=idlers, checks={"idler_life": "30000 h"})
    assert check_of(scene, "CNV134", "carry").verdict is Verdict.NOT_CHECKED
