"""Tensions, sizes and masses of a chain drive against sums by hand."""

import math
from typing import Any

import numpy as np
import pytest
from support.chains import CH_05, MOTOR, ROLLER, chain_of
from support.command import ROOT, ptmcalc
from support.machines import changed, load_of, report_of, scene_of

from ptmcalc.laws import inertia
from ptmcalc.machines.chain_drive.machine.model import (
    chain_line,
    drive_mass,
    natural_frequencies,
    pitches,
    span,
    vibrating,
    wrap,
)
from ptmcalc.numerics.harmonic.waves import dynamic_stiffness

G = 9.81
INCLINED = changed(
    CH_05,
    layout__length="60 m",
    layout__lift=f"{60 * math.sin(math.radians(20))} m",
    layout__load=f"{1500 / G} kg/m",
    layout__resistance={"coefficient": 0.08, "turn_factor": 1},
    chain__mass=f"{800 / G} kg/m",
)


def value(data: dict[str, Any], name: str) -> float:
    return load_of(scene_of(report_of(data)), name).estimate.value


def test_st01_the_pull_of_an_inclined_conveyor() -> None:
    """q_G 1500 and q_0 800 N/m over 60 m at 20 deg, 8 % of resistance: 44764.4 N."""
    assert value(INCLINED, "static_resistance") == pytest.approx(44764.4, rel=1e-5)
    assert value(INCLINED, "power_drive") == pytest.approx(44764.4 * 0.5, rel=1e-5)


def test_tensions_strand_by_strand() -> None:
    spec = chain_of(INCLINED)
    ends = chain_line(spec, spec.all_scenes[0]).ends
    level, up = 60 * math.cos(math.radians(20)), 60 * math.sin(math.radians(20))
    back = 800 * (0.08 * level - up)
    on = 2300 * (0.08 * level + up)
    assert ends == pytest.approx((20e3, 20e3 + back, 20e3 + back, 20e3 + back + on), rel=1e-12)
    assert value(INCLINED, "tension_static") == pytest.approx(max(ends))


def test_turns_the_load_in_the_trough_and_the_tail_add_their_share() -> None:
    data = changed(
        CH_05, layout__resistance={"coefficient": 0.1, "load_coefficient": 0.4, "turn_factor": 1.2, "force": "2 kN"}
    )
    expected = 1.2 * (0.1 * 160 + 0.4 * 120) * G * 40 + 2e3
    assert value(data, "static_resistance") == pytest.approx(expected, rel=1e-12)
    assert value(changed(data, scenes=[{"type": "run", "load": "empty"}]), "static_resistance") == pytest.approx(
        1.2 * 0.1 * 160 * G * 40 + 2e3
    )


def test_a_screw_sets_the_mean_round_the_loop() -> None:
    data = changed(INCLINED, layout__takeup={"type": "screw", "tension": "30 kN"}, layout__resistance__force="1 kN")
    spec = chain_of(data)
    a, b, c, d = chain_line(spec, spec.all_scenes[0]).ends
    assert (a + b + c + d) / 4 == pytest.approx(30e3, rel=1e-12)
    assert c - b == pytest.approx(1e3)


DRIVEN = changed(
    INCLINED,
    layout__tail={"teeth": 8, "driven": "on", "share": 0.3},
    layout__resistance__force="1 kN",
    scenes=[{"type": "run"}],
)


def test_a_driven_tail_takes_its_share_off_the_chain() -> None:
    """W = 44764.4 N + 1 kN; the tail pulls 13729.3 N. T_2 = 20000 + 800 (0.08 60 cos 20 - 60 sin 20) = 7191.4 N, T_3 =
    7191.4 + 1000 - 13729.3 = -5537.9 N, T_4 = 52035.1 N = 20000 + 0.7 W."""
    spec = chain_of(DRIVEN)
    line = chain_line(spec, spec.all_scenes[0])
    assert line.ends == pytest.approx((20e3, 7191.4, -5537.9, 52035.1), abs=0.1)
    assert line.head_pull == pytest.approx(0.7 * 45764.4, abs=0.1)
    assert value(DRIVEN, "static_resistance") == pytest.approx(45764.4, abs=0.1)
    assert value(DRIVEN, "power_drive") == pytest.approx(45764.4 * 0.5, abs=0.1)
    assert value(DRIVEN, "tension_static") == pytest.approx(52035.1, abs=0.1)


def test_a_driven_tail_moves_the_mean_of_a_screw() -> None:
    """The jump of the tension at the tail, 1000 - 13729.3 N, counts for the half of the loop behind it."""
    spec = chain_of(changed(DRIVEN, layout__takeup={"type": "screw", "tension": "30 kN"}))
    a, b, c, d = chain_line(spec, spec.all_scenes[0]).ends
    assert (a + b + c + d) / 4 == pytest.approx(30e3, rel=1e-12)
    assert (b - a, c - b, d - c) == pytest.approx((-12808.6, -12729.3, 57573.0), abs=0.1)
    assert a == pytest.approx(30e3 - (-12808.6 * 3 - 12729.3 * 2 + 57573.0) / 4, abs=0.2)


def test_a_stream_of_material_lies_on_the_chain_by_its_speed() -> None:
    assert value(changed(CH_05, layout__load=None, layout__capacity="216 t/h"), "static_resistance") == pytest.approx(
        value(CH_05, "static_resistance"), rel=1e-12
    )


def test_two_shafts_by_hand() -> None:
    """P/V pulls; q g l/(8 h) is the slack strand's own; V = z p n."""
    report = scene_of(report_of(ROLLER))
    radii = [0.0254 / (2 * math.sin(math.pi / z)) for z in (19, 57)]
    length = math.sqrt(1 - (radii[1] - radii[0]) ** 2)
    slack = 5.4 * G * length / (8 * 0.02)
    expected = {
        "static_resistance": 9e3,
        "tension_static": 9e3 + slack,
        "tension_run_off": slack,
        "tension_centrifugal": 5.4,
        "sprocket_speed": 2 * math.pi / (19 * 0.0254),
        "ratio": 3.0,
        "wrap": math.pi - 2 * math.asin(radii[1] - radii[0]),
        "centre_distance_pitches": 1 / 0.0254,
        "pitches": 118,
        "safety_static": 106e3 / 1.15 / (9e3 + slack + 5.4),
        "design_power": 9e3 * 1.4 / 1.7,
    }
    for name, number in expected.items():
        assert load_of(report, name).estimate.value == pytest.approx(number, rel=1e-12), name


@pytest.mark.parametrize(("given", "count"), [({}, 118), ({"layout__pitches": 118}, 118)])
def test_the_distance_that_fits_a_chain_of_whole_pitches(given: dict[str, Any], count: int) -> None:
    """118 pitches are 0.33 more than shafts 1 m apart take: nearly half of that is room to move them."""
    fitted, p = value(changed(ROLLER, **given), "centre_distance_fitted"), 0.0254
    assert 2 * fitted / p + (19 + 57) / 2 + ((57 - 19) / (2 * math.pi)) ** 2 * p / fitted == pytest.approx(count)
    assert fitted != pytest.approx(1, rel=1e-4)
    alone = changed(ROLLER, layout__pitches=count, layout__centre_distance=None)
    assert value(alone, "centre_distance") == value(alone, "centre_distance_fitted") == fitted


def test_a_cranked_link_closes_an_odd_chain_and_bears_a_fifth_less() -> None:
    odd = changed(ROLLER, layout__pitches=119, layout__cranked_link="yes", layout__centre_distance=None)
    plain = changed(ROLLER, layout__pitches=118, layout__centre_distance=None)
    assert pitches(chain_of(odd)) == 119
    assert value(odd, "safety_static") == pytest.approx(0.8 * value(plain, "safety_static"), rel=1e-3)


def test_a_search_that_puts_the_shafts_into_each_other_finds_no_wrap() -> None:
    """No file can say so; `solve` tries such values on its way."""
    spec = chain_of(ROLLER).with_value(("layout", "centre_distance"), 0.05)
    assert wrap(spec) == 0
    assert 0 < span(spec) < 0.05
    done = ptmcalc("solve", ROOT / "specs/chain_drive/roller_drive.yaml", "--check", "CHN111", "--vary", "chain.pitch")
    assert done.status == 0


def test_the_drive_at_the_chain() -> None:
    """J i^2 eta^s/r^2 with r = z p/(2 pi), the way of the chain per angle, by the direction of power."""
    spec = chain_of(changed(CH_05, drive=MOTOR, sprocket__inertia="3 kg*m^2"))
    arm = 8 * 0.32 / (2 * math.pi)
    for flow, efficiency in ((inertia.DRIVE, 0.93), (inertia.BRAKE, 1 / 0.93), (inertia.ENERGY, 1.0)):
        expected = (0.15 * 42.4**2 * efficiency + 3) / arm**2
        assert drive_mass(spec, flow) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize(
    "data",
    [
        CH_05,
        changed(CH_05, layout__tail={"teeth": 8, "inertia": "40 kg*m^2"}),
        changed(CH_05, layout__takeup__type="screw"),
        changed(CH_05, layout__tail={"teeth": 8, "driven": "on"}),
        ROLLER,
    ],
)
@pytest.mark.parametrize("drive", [math.inf, 5e4])
def test_natural_frequencies_are_where_the_chain_answers_most(data: dict[str, Any], drive: float) -> None:
    """Two ways to one number: roots of frequency equations, and peaks of the dynamic stiffness."""
    spec = chain_of(changed(data, chain__damping={"law": "hysteretic", "ratio": 1e-4}))
    scene = spec.all_scenes[0]
    frequencies = natural_frequencies(spec, scene, drive, 3)
    chain = vibrating(spec, scene, drive)
    for w in frequencies:
        near = [w * (1 + 1e-5 * step) for step in range(-40, 41)]
        sizes = [abs(complex(dynamic_stiffness(chain, one))) for one in near]
        assert abs(sizes.index(max(sizes)) - 40) <= 1
        assert max(sizes) > 3 * min(sizes)


def test_a_take_up_weight_against_a_drive_that_gives_way() -> None:
    """Held exactly so; a drive that gives way also moves the weight's falls, which the response leaves out: 2 % for a
    weight of a tenth of the chain."""
    spec = chain_of(changed(CH_05, chain__damping={"law": "hysteretic", "ratio": 1e-4}, layout__takeup__mass="4077 kg"))
    scene = spec.all_scenes[0]
    for drive, off in ((math.inf, 2e-4), (5e4, 0.03)):
        w = float(natural_frequencies(spec, scene, drive, 1)[0])
        near = w * np.linspace(0.95, 1.05, 2001)
        found = near[int(np.argmax(np.abs(dynamic_stiffness(vibrating(spec, scene, drive), near))))]
        assert found == pytest.approx(w, rel=off)
