"""Numbers of the steadily running belt and of its vertical curves, against arithmetic and geometry of their own.

Cross-sections by quadrature, fibres by their lengths in space, CEMA in pounds and feet, the worst filling by trying all
of them, the start in a hollow by finite elements.
"""

import itertools
import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad
from support.belt_scenes import Drive, Rig, counts_of
from support.machines import changed, load_of, report_of, scene_of

from ptmcalc.contract.report import SceneReport

G = 9.81
RIG = Rig(sections=((200.0, -4.0), (300.0, 22.0), (100.0, 1.0)), drives={"head": Drive(torque=4000.0)})
TROUGH = {"angle": "35 deg", "middle_roll": "380 mm"}
WIDTH, MIDDLE, ANGLE = 1.0, 0.38, math.radians(35)
SIDE = (WIDTH - MIDDLE) / 2


def ran(rig: Rig = RIG, **changes: Any) -> SceneReport:
    return scene_of(report_of(changed(rig.data({"type": "run"}), **changes)))


def value(scene: SceneReport, name: str) -> float:
    return load_of(scene, name).estimate.value


# --- cross-section of the load ---------------------------------------------------------------------------------------


def bed_of(width: float, middle: float, trough: float, surcharge: float) -> float:
    """Area between the belt and a parabola of surcharge, by quadrature over the width."""
    bed = 0.9 * width - 0.05
    side = (bed - middle) / 2
    half = middle / 2 + side * math.cos(trough)

    def height(y: float) -> float:
        floor = max(abs(y) - middle / 2, 0.0) * math.tan(trough)
        rim = side * math.sin(trough)
        return rim + (half**2 - y**2) / (2 * half) * math.tan(surcharge) - floor

    return float(quad(height, -half, half, points=[-middle / 2, middle / 2])[0])


@pytest.mark.parametrize(("trough", "surcharge"), [(20, 10), (35, 15), (45, 20)])
def test_the_fill_is_the_stream_over_the_area_by_quadrature(trough: int, surcharge: int) -> None:
    level = replace(RIG, sections=((500.0, 0.0), (100.0, 0.0)))
    scene = ran(
        level,
        belt__width="1000 mm",
        idlers__carry__trough={"angle": f"{trough} deg", "middle_roll": "380 mm"},
        load={"capacity": "1500 t/h", "density": "1600 kg/m^3", "surcharge_angle": f"{surcharge} deg"},
    )
    most = bed_of(1.0, 0.38, math.radians(trough), math.radians(surcharge)) * 4.0 * 1600
    assert value(scene, "capacity_max") == pytest.approx(most, rel=1e-9)
    assert value(scene, "section_fill") == pytest.approx(1500 / 3.6 / most, rel=1e-9)


def test_the_steepest_slope_takes_its_part_of_the_surcharge() -> None:
    """Lowered as in DIN 22101; what lies below the edges of the bed stays."""
    scene = ran(
        belt__width="1000 mm",
        idlers__carry__trough=TROUGH,
        load={"mass": "118 kg/m", "density": "1600 kg/m^3", "surcharge_angle": "15 deg"},
    )
    whole, water = (bed_of(1.0, 0.38, ANGLE, math.radians(top)) for top in (15, 0))
    slope, rest = math.asin(22 / 300), math.radians(15)
    kept = math.sqrt((math.cos(slope) ** 2 - math.cos(rest) ** 2) / (1 - math.cos(rest) ** 2))
    most = (water + kept * (whole - water)) * 4.0 * 1600
    assert value(scene, "capacity_max") == pytest.approx(most, rel=1e-9)
    assert value(scene, "section_fill") == pytest.approx(118 * 4.0 / most, rel=1e-9)


# --- resistances -----------------------------------------------------------------------------------------------------

FT, LB, LBF = 0.3048, 0.45359237, 4.4482216152605


@pytest.mark.parametrize("loaded", ["full", "empty"])
@pytest.mark.parametrize("temperature", [1.0, 1.5])
def test_cema_gives_the_tension_of_its_formula_in_pounds_and_feet(loaded: str, temperature: float) -> None:
    """T_e = L K_t (K_x + K_y W_b + 0.015 W_b) + W_m (L K_y + H) + T_o, K_x = 0.00068 (W_b + W_m) + 1.5/S_i."""
    gravity = LBF / LB  # a pound weighs a pound
    length, lift, belt, load, spacing, pulleys = 2000.0, 75.0, 10.0, 55.0 * (loaded == "full"), 4.0, 600.0
    data = changed(
        RIG.data({"type": "run", "load": loaded}),
        route={"length": f"{length * FT!r} m", "lift": f"{lift * FT!r} m"},
        belt__mass=f"{belt * LB / FT!r} kg/m",
        load={"mass": f"{55.0 * LB / FT!r} kg/m"},
        idlers__carry={"pitch": f"{spacing * FT!r} m", "line_mass": "17 kg/m"},
        resistance={
            "cema": {"roll": "6in", "flexure": 0.025, "temperature": temperature},
            "secondary_force": f"{pulleys * LBF!r} N",
        },
        gravity=f"{gravity!r} m/s^2",
        takeup__tension="300 kN",
    )
    drag = 0.00068 * (belt + load) + 1.5 / spacing
    pounds = length * temperature * (drag + 0.025 * belt + 0.015 * belt) + load * (length * 0.025 + lift) + pulleys
    scene = scene_of(report_of(data))
    assert value(scene, "effective_tension") == pytest.approx(pounds * LBF, rel=1e-9)
    assert value(scene, "power_drive_running") == pytest.approx(pounds * LBF * 4.0, rel=1e-9)


def test_the_return_strand_of_cema_has_its_flexure_alone() -> None:
    rig = replace(RIG, sections=((500.0, 10.0),))
    pitched = {"pitch": "1.2 m", "line_mass": "20 kg/m"}
    scene = ran(rig, idlers__carry=pitched, resistance={"cema": {"idler_drag": "8 N", "flexure": 0.03}})
    rise = 500.0 * 0.015 * 20 * G - 20 * G * 10
    assert value(scene, "tension_min") == pytest.approx(120e3 + min(rise, 0.0), rel=1e-9)


def test_forces_with_a_name_follow_from_what_they_are_made_of() -> None:
    """Two scrapers, skirts and the loading point, each by its own arithmetic; without load only the scrapers."""
    resistance = {
        "coefficient": RIG.friction,
        "secondary_force": "0 N",
        "start_factor": 1,
        "forces": {
            "scrapers": {
                "scraper": {
                    "count": 2, "width": "900 mm", "thickness": "15 mm", "pressure": "50 kPa", "friction": 0.6
                },
                "at": "return",
            },
            "skirt": {"skirt": {"width": "600 mm", "length": "5 m", "friction": 0.65}},
            "chute": {"loading": {"speed": "1 m/s"}},
        },
    }  # fmt: skip
    scrapers = 2 * 0.9 * 0.015 * 50e3 * 0.6
    height = 120.0 / 1600 / 0.6  # of a load of 120 kg/m between the plates
    skirt = 0.65 * 1600 * G * height**2 * 5
    chute = 120.0 * 4.0 * (4.0 - 1.0)
    rig = replace(RIG, secondary=1.0)
    for loaded, extra in (("full", scrapers + skirt + chute), ("empty", scrapers)):
        data = changed(rig.data({"type": "run", "load": loaded}), resistance=resistance, load__density="1600 kg/m^3")
        pull = value(scene_of(report_of(data)), "effective_tension")
        assert pull == pytest.approx(rig.resistance(loaded) + extra, rel=1e-9), loaded


def test_motors_give_their_share_each_through_its_own_gear() -> None:
    drives = {"one": Drive(torque=2000.0, count=2), "two": Drive(torque=2000.0, efficiency=0.8)}
    rig = replace(RIG, drives=drives)
    forces = [4000.0 * 0.94, 2000.0 * 0.8]
    lost = (forces[0] / 0.94 + forces[1] / 0.8) / sum(forces)
    scene = ran(rig)
    for name, loaded in (("running", "full"), ("empty", "empty")):
        power = rig.resistance(loaded) * 4.0 * lost
        assert value(scene, f"power_motor_{name}") == pytest.approx(power, rel=1e-9)


def test_motors_that_brake_get_what_the_gear_leaves() -> None:
    rig = replace(RIG, sections=((500.0, -60.0),), tension=250e3)
    power = rig.resistance() * 4.0
    assert power < 0
    assert value(ran(rig), "power_motor_running") == pytest.approx(power * 0.94, rel=1e-9)


def test_the_load_at_the_tail_needs_a_loaded_first_section() -> None:
    """Loaded uphill only, the first section, which falls, is empty: the skirts there rub nothing."""
    skirt = {"skirt": {"width": "600 mm", "length": "5 m", "friction": 0.65}}
    data = changed(
        RIG.data({"type": "run", "load": "uphill"}), resistance__forces={"skirt": skirt}, load__density="1600 kg/m^3"
    )
    assert value(scene_of(report_of(data)), "effective_tension") == pytest.approx(RIG.resistance("uphill"), rel=1e-9)


# --- sag by sections -------------------------------------------------------------------------------------------------


def test_sag_is_that_of_each_section_at_its_own_pitch_and_tension() -> None:
    pitches = (1.0, 1.2, 1.5)
    scene = ran(
        idlers={"carry": {"line_mass": "20 kg/m", "pitch": "1.2 m"}, "return": {"line_mass": "8 kg/m", "pitch": "3 m"}},
        route__sections__0__carry_pitch="1 m",
        route__sections__2__carry_pitch="1.5 m",
    )
    ends = [RIG.tension]
    for one in RIG.lengths():
        ends.append(ends[-1] + one.length * (one.friction + one.climb))
    sags = []
    for number, (pitch, (length, lift)) in enumerate(zip(pitches, RIG.sections, strict=True), 1):
        cosine = math.sqrt(1 - (lift / length) ** 2)
        carry = 140 * cosine * G * pitch / (8 * min(ends[number + 2], ends[number + 3]))
        back = 20 * cosine * G * 3.0 / (8 * min(ends[3 - number], ends[4 - number]))
        assert value(scene, f"sag_carry[{number}]") == pytest.approx(carry, rel=1e-9)
        assert value(scene, f"sag_return[{number}]") == pytest.approx(back, rel=1e-9)
        sags += [carry, back]
    assert value(scene, "sag_relative_max") == pytest.approx(max(sags), rel=1e-9)


def test_sets_of_idlers_closer_together_are_heavier() -> None:
    """20 kg on 1 m in place of 1.25 m: 4 kg/m more on that section, in friction and in moving mass."""
    sets = {"carry": {"set_mass": "20 kg", "pitch": "1.25 m"}, "return": {"line_mass": "8 kg/m", "pitch": "3 m"}}
    wide, close = (
        ran(idlers=sets, **more) for more in ({}, {"route__sections__0__carry_pitch": "1 m"})
    )  # fmt: skip
    more = value(close, "effective_tension") - value(wide, "effective_tension")
    assert more == pytest.approx(0.022 * 1.1 * G * 4 * 200, rel=1e-9)


# --- vertical curves -------------------------------------------------------------------------------------------------


def tensions_along(rig: Rig, filling: tuple[bool, ...]) -> tuple[list[float], list[float]]:
    """Places along the carry strand from the tail, and the tensions there, for a choice of loaded sections."""
    full, empty = rig.lengths(), rig.lengths("empty")
    count = len(rig.sections)
    belt = [*empty[:count], *((full if loaded else empty)[count + k] for k, loaded in enumerate(filling))]
    rises = np.concatenate([[0.0], np.cumsum([one.length * (one.friction + one.climb) for one in belt])])
    marks = np.concatenate([[0.0], np.cumsum([one.length for one in belt])])
    forces = [drive.force for drive in rig.drives.values()]
    boosted = sum(drive.force for drive in rig.drives.values() if drive.at == "tail") / sum(forces) * rises[-1]
    mean = float(np.sum(np.diff(marks) * (rises[1:] + rises[:-1]) / 2)) / marks[-1] - boosted / 2
    start = rig.tension - (mean if rig.rigid else 0.0)
    return list(marks[count:] - marks[count]), list(start - boosted + rises[count:])


def turn(rig: Rig, number: int) -> tuple[float, float]:
    before, after = (math.asin(lift / length) for length, lift in rig.sections[number - 2 : number])
    return before, after


def in_curve(rig: Rig, number: int, radius: float) -> tuple[float, float]:
    """Least and most tension in a curve over all fillings."""
    before, after = turn(rig, number)
    place = sum(length for length, _ in rig.sections[: number - 1])
    reach = radius * math.tan(abs(after - before) / 2)
    found = []
    for filling in itertools.product((False, True), repeat=len(rig.sections)):
        marks, tensions = tensions_along(rig, filling)
        found += [float(np.interp(place + side * reach, marks, tensions)) for side in (-1, 0, 1)]
    return min(found), max(found)


BOTH = {"head": Drive(torque=3000.0), "booster": Drive(torque=1000.0, at="tail")}


@pytest.mark.parametrize(
    "rig",
    [
        RIG,
        replace(RIG, rigid=True, tension=190e3),
        replace(RIG, drives=BOTH),
        replace(RIG, rigid=True, tension=190e3, drives=BOTH),
    ],
    ids=["gravity", "rigid", "gravity, tail drive", "rigid, tail drive"],
)
def test_tension_in_a_hollow_is_the_largest_of_all_fillings(rig: Rig) -> None:
    scene = ran(rig, route__sections__1__curve_radius="800 m")
    _, most = in_curve(rig, 2, 800.0)
    assert value(scene, "tension_curve_max[2]") == pytest.approx(most, rel=1e-9)


def test_the_belt_lifts_off_where_its_weight_is_less_than_the_pull_round_the_curve() -> None:
    """The limit of the check: an arc of the bare belt in equilibrium, weight across against tension times angle."""
    report = report_of(changed(RIG.data({"type": "run"}), route__sections__1__curve_radius="800 m"))
    (check,) = [one for one in scene_of(report).checks if one.code == "CNV116"]
    angle = 1e-3  # a short arc at the steepest end
    weight = 20 * G * 800 * angle * math.cos(math.asin(22 / 300))
    assert check.limit is not None
    assert check.limit.value * 2 * math.sin(angle / 2) == pytest.approx(weight, rel=1e-6)


def heights() -> tuple[float, float]:
    """Height of the edge over the mean of the trough, and of the mean over the middle, by quadrature."""

    def height(y: float) -> float:
        return max(y - MIDDLE / 2, 0.0) * math.sin(ANGLE)

    mean = quad(height, 0, WIDTH / 2, points=[MIDDLE / 2])[0] / (WIDTH / 2)
    return height(WIDTH / 2) - mean, mean


@pytest.mark.parametrize(("number", "radius", "hollow"), [(2, 800.0, True), (3, 60.0, False)])
def test_fibres_in_a_curve_run_on_their_own_radius(number: int, radius: float, hollow: bool) -> None:
    curve = {f"route__sections__{number - 1}__curve_radius": f"{radius!r} m"}
    scene = ran(belt__width="1000 mm", idlers__carry__trough=TROUGH, **curve)
    edge, middle = heights()
    longer, shorter = (middle, edge) if hollow else (edge, middle)
    least, most = in_curve(RIG, number, radius)
    stiffness = RIG.stiffness / WIDTH
    name = f"curve_{number}"
    assert value(scene, f"fibre_tension_max[{name}]") == pytest.approx(most + stiffness * longer / radius, rel=1e-9)
    assert value(scene, f"fibre_tension_min[{name}]") == pytest.approx(least - stiffness * shorter / radius, rel=1e-9)


def fibre_strains(length: float, lift: float) -> tuple[float, float]:
    """Largest and smallest strain over the mean: straight fibres in space from the drum to the trough."""
    y = np.linspace(0.0, WIDTH / 2, 200_001)
    wing = np.maximum(y - MIDDLE / 2, 0.0)
    across = wing * (1 - math.cos(ANGLE))
    up = wing * math.sin(ANGLE) - lift
    strain = np.hypot(np.hypot(length, across), up) / length - 1
    mean = float(np.trapezoid(strain, y)) / (WIDTH / 2)
    return float(strain.max()) - mean, mean - float(strain.min())


@pytest.mark.parametrize(("length", "lift"), [(2.0, 0.0), (2.0, 0.06), (3.0, 0.1)])
@pytest.mark.parametrize("at", ["head", "tail"])
def test_fibres_of_a_transition_have_their_lengths_in_space(at: str, length: float, lift: float) -> None:
    scene = ran(
        belt__width="1000 mm",
        idlers__carry__trough=TROUGH,
        transitions={at: {"length": f"{length!r} m", "pulley_lift": f"{lift!r} m"}},
    )
    ends = [tensions_along(RIG, filling)[1] for filling in itertools.product((False, True), repeat=3)]
    there = [one[-1 if at == "head" else 0] for one in ends]
    more, less = fibre_strains(length, lift)
    swing = RIG.stiffness * (more + less)
    most, least = (value(scene, f"fibre_tension_{end}[{at}]") for end in ("max", "min"))
    assert most == pytest.approx(max(there) + RIG.stiffness * more, abs=5e-3 * swing)
    assert least == pytest.approx(min(there) - RIG.stiffness * less, abs=5e-3 * swing)


@pytest.mark.parametrize(("loaded", "ramp_time"), [("downhill", 6.0), ("full", 3.0)])
def test_a_start_pulls_in_the_hollow_as_finite_elements_say(loaded: str, ramp_time: float) -> None:
    radius = 800.0
    scene = {
        "type": "start",
        "load": loaded,
        "profile": {"shape": "ramp", "control": "torque", "time": f"{ramp_time} s"},
    }
    data = changed(RIG.data(scene), route__sections__1__curve_radius=f"{radius} m")
    load = load_of(scene_of(report_of(data)), "tension_curve_max[2]")
    assert load.window is not None
    before, after = turn(RIG, 2)
    reach = radius * math.tan(abs(after - before) / 2)
    found = []
    for elements in (200, 400):
        motion = RIG.started(lambda time: min(time / ramp_time, 1.0), load.window[1], elements, loaded)
        lengths = RIG.lengths(loaded)
        counts = counts_of(lengths, elements)
        ends = np.concatenate(
            [[0.0], np.cumsum(np.repeat([o.length / n for o, n in zip(lengths, counts, strict=True)], counts))]
        )
        place = sum(length for length, _ in RIG.sections) + RIG.sections[0][0]
        touched = (ends[:-1] <= place + reach) & (ends[1:] >= place - reach)
        found.append(float(motion.highest[touched].max()))
    own = 2 * abs(found[1] - found[0])
    assert abs(found[1] - load.estimate.value) <= load.estimate.bar + own
    assert found[1] == pytest.approx(load.estimate.value, rel=0.02)
    assert load.estimate.bar < 0.1 * load.estimate.value
