"""Hard cases of the belt: drums without mass, steep fronts after long travel, machines over many decades of size.

Expected values are literature or closed forms evaluated with 80 digits elsewhere; nothing here comes from the solver.
"""

import math
from typing import Any

import numpy as np
import pytest
from support.conveyors import text
from support.machines import BW_02, changed, check_of, load_of, report_of, scene_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.report import FileReport
from ptmcalc.laws import wave
from ptmcalc.numerics import loop, strand

LINE_MASS, STIFFNESS, DRUM, FORCE_STEP = 235.0, 1.4e8, 12_000.0, 60_000.0


def _uniform(length: float, drum_mass: float = DRUM, tail_mass: float = 0.0) -> loop.Loop:
    one = loop.Strand(length, LINE_MASS, STIFFNESS, 1e6, 1e6)
    return loop.Loop(one, one, drum_mass, tail_mass, fixed_length=False)


def _march(length: float, window: float, cells: int, drum_mass: float = DRUM, tail_mass: float = 0.0) -> loop.Motion:
    belt = _uniform(length, drum_mass, tail_mass)
    drive = loop.Drive(force=lambda t: np.full_like(t, FORCE_STEP))
    return strand.march(belt, drive, window, loop.match(belt.carry.transit, belt.back.transit, cells, 1e-9))


def test_plateau_before_the_first_echo() -> None:
    """S = F (1 - exp(-Z t/m)) at 0.05 s, where elements of 80 m see nothing faster than 0.1 s."""
    impedance = math.sqrt(LINE_MASS * STIFFNESS)
    force = float(wave.first_wave_force(FORCE_STEP, impedance, DRUM, 0.05))
    assert force == pytest.approx(31820.925004096323, rel=1e-13)
    motion = _march(2000.0, 0.05, 2000)
    assert motion.run_on[-1] - 1e6 == pytest.approx(31820.925004096323, rel=1e-6)


@pytest.mark.parametrize("share", [0.0, 1e-15, 1e-9, 1e-4, 1.0, 1e4])
def test_no_drum_mass_makes_the_march_ring_or_blow_up(share: float) -> None:
    """A gravity loop under a step stays between 0 and twice the rigid body's tension, whatever the drum weighs."""
    motion = _march(500.0, 6.0, 200, drum_mass=share * DRUM)
    belt = 2 * 500.0 * LINE_MASS
    rigid = FORCE_STEP * belt / (belt + share * DRUM)
    dynamic = motion.run_on - 1e6
    assert np.isfinite(motion.run_on).all()
    assert dynamic.min() >= -1e-9 * FORCE_STEP
    assert dynamic.max() <= 2 * rigid * (1 + 1e-6)
    assert abs(motion.energy_residual) < 1e-5


@pytest.mark.parametrize("share", [1e-15, 1e-9, 1e-3, 1.0, 1e3, 1e9])
def test_no_tail_mass_makes_the_march_ring_or_blow_up(share: float) -> None:
    motion = _march(500.0, 6.0, 200, tail_mass=share * DRUM)
    assert np.isfinite(motion.run_on).all()
    assert motion.carry_max.value < 1e6 + 10 * FORCE_STEP
    assert abs(motion.energy_residual) < 1e-4


# -- whole machines -------------------------------------------------------------------------------------------------


def _scaled(mass: float, length: float, time: float) -> dict[str, Any]:
    """The worked case in other units: every quantity scaled by its dimension, so that the physics is the same."""
    force = mass * length / time**2

    def of(value: float, unit: str, factor: float) -> str:
        return text(value * factor, unit)

    return changed(
        BW_02,
        gravity=of(9.81, "m/s^2", length / time**2),
        route={"length": of(1000, "m", length), "lift": of(60, "m", length), "inclination": "small_angle"},
        belt={"mass": of(20, "kg/m", mass / length), "stiffness": of(138e6, "N", force)},
        idlers={
            "carry": {"line_mass": of(25, "kg/m", mass / length)},
            "return": {"line_mass": of(18, "kg/m", mass / length)},
        },
        load={"mass": of(200, "kg/m", mass / length)},
        speed=of(4, "m/s", length / time),
        drive__motor={
            "count": 3,
            "inertia": of(6, "kg*m^2", mass * length**2),
            "mean_starting_torque": of(3038.6666666667, "N*m", force * length),
        },
        drive__coupling_inertia=of(4, "kg*m^2", mass * length**2),
        drive__drum={"diameter": of(1, "m", length), "wrap": "210 deg", "inertia": "0 kg*m^2"},
        takeup={"type": "gravity", "tension": of(240e3, "N", force)},
        tail_drum={"inertia": "0 kg*m^2"},
    )


@pytest.mark.parametrize(
    ("mass", "length", "time"),
    [(1e-6, 1.0, 1.0), (1e6, 1.0, 1.0), (1e-3, 1e-2, 1e-1), (1e3, 30.0, 5.0), (1.0, 1.0, 1e3)],
)
def test_a_machine_of_another_size_has_the_same_numbers(mass: float, length: float, time: float) -> None:
    """No tolerance, threshold or grid of the program knows how large a machine is."""
    force = mass * length / time**2
    plain, scaled = (scene_of(report_of(data)) for data in (_scaled(1, 1, 1), _scaled(mass, length, time)))
    for name, factor in (
        ("tension_dynamic_run_on_max", force),
        ("tension_min", force),
        ("first_wave_time_max", time),
        ("start_time_rigid", time),
        ("reduced_drive_mass", mass),
    ):
        one, other = load_of(plain, name).estimate, load_of(scaled, name).estimate
        assert other.value / factor == pytest.approx(one.value, rel=1e-9), name
        assert other.bar / factor == pytest.approx(one.bar, rel=1e-6, abs=1e-9 * abs(one.value)), name
    assert [j.verdict for j in plain.checks] == [j.verdict for j in scaled.checks]


EXTREMES: dict[str, dict[str, Any]] = {
    "a belt of 20 km": {"route__length": "20 km", "drive__motor__mean_starting_torque": "60 kN*m"},
    "a belt of 1 m": {"route__length": "1 m", "route__lift": "0 m"},
    "hardly any drive inertia": {"drive__motor__inertia": "1e-9 kg*m^2", "drive__coupling_inertia": "0 kg*m^2"},
    "a flywheel of a drive": {"drive__motor__inertia": "1e6 kg*m^2"},
    "a start just possible": {"drive__motor__mean_starting_torque": "1659 N*m"},
    "a start just impossible": {"drive__motor__mean_starting_torque": "1658 N*m"},
    "a rubber band": {"belt__stiffness": "10 kN"},
    "a steel bar": {"belt__stiffness": "1e13 N"},
    "a crawling belt": {"speed": "1 mm/s"},
    "a standing belt": {"speed": "1e-11 m/s"},
    "a flying belt": {"speed": "400 m/s"},
    "a tail drum of a needle": {"tail_drum": {"inertia": "1 kg*m^2", "diameter": "1e-12 m"}},
    "a tail drum of lead": {"tail_drum": {"inertia": "1e9 kg*m^2", "diameter": "1 m"}},
    "no weight on the take-up": {"takeup__tension": "1 N"},
    "a mountain on the take-up": {"takeup__tension": "1e12 N"},
    "no gravity to speak of": {"gravity": "1e-9 m/s^2"},
    "hundreds of turns": {"drive__drum__wrap": "100000 deg", "drive__drum__friction": 0.5},
    "a ramp of a microsecond": {"scenes": [{"type": "start", "profile": {"shape": "ramp", "time": "1e-6 s"}}]},
    "a ramp of a day": {"scenes": [{"type": "start", "profile": {"shape": "ramp", "time": "24 h"}}]},
    "a steep belt": {"route__lift": "999.9999 m", "route__inclination": "exact"},
    "a falling belt": {"route__lift": "-500 m"},
}


@pytest.mark.parametrize("takeup", ["gravity", "rigid"])
@pytest.mark.parametrize("name", EXTREMES)
def test_an_extreme_machine_gets_verdicts_or_a_reason(name: str, takeup: str) -> None:
    """Whatever cannot be computed is a finding and an open verdict, never NaN, never a pass without a number."""
    report = report_of(changed(BW_02, takeup__type=takeup, **EXTREMES[name]), repairs=True, budget=0.5)
    assert report.scenes
    for scene in report.scenes:
        for load in scene.loads:
            assert not math.isnan(load.estimate.value), load.info.name
            assert load.estimate.low <= load.estimate.value <= load.estimate.high, load.info.name
    _open_verdicts_have_reasons(report)


def _open_verdicts_have_reasons(report: FileReport) -> None:
    for _, judgement in report.judgements:
        if judgement.verdict in (Verdict.PASS, Verdict.FAIL):
            assert judgement.value is not None
            assert judgement.limit is not None
            sound = judgement.value.low >= judgement.limit.high or judgement.value.high <= judgement.limit.low
            assert sound or judgement.verdict is Verdict.FAIL
        else:
            assert judgement.reason


@pytest.mark.parametrize(
    ("torque", "verdict"), [(1658.92, Verdict.PASS), (1658.91, Verdict.FAIL), (0.001, Verdict.FAIL)]
)
def test_a_start_is_possible_or_not_to_the_last_digit(torque: float, verdict: Verdict) -> None:
    """W = 9.81 (0.025 x 283 x 1000 + 200 x 60) N at the rim, from three motors through i = 20 and 94 %."""
    needed = 9.81 * (0.025 * 283 * 1000 + 200 * 60) * 0.5 / (20 * 0.94) / 3
    assert (torque > needed) == (verdict is Verdict.PASS)
    scene = scene_of(report_of(changed(BW_02, drive__motor__mean_starting_torque=text(torque, "N*m"))))
    assert check_of(scene, "CNV104").verdict is verdict
    assert load_of(scene, "starting_reserve").estimate.value == pytest.approx(torque / needed, rel=1e-9)
