"""Every effect counts: the design files stand on both sides of its threshold, and it changes some verdict.

Each machine below is a changed template; the effect is left to the planner, then switched off.
"""

from functools import cache
from pathlib import Path
from typing import Any

import pytest
from support.machines import changed, check_of, load_of, report_of, scene_of, spec_of, template

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.effect import EffectState
from ptmcalc.contract.report import FileReport
from ptmcalc.engine.check import Options, check_file
from ptmcalc.engine.load import load_file
from ptmcalc.engine.plan import plan
from ptmcalc.engine.registry import load_kind
from ptmcalc.engine.run import settle
from ptmcalc.machines.conveyor.waves import characteristics

SPECS = Path(__file__).parents[3] / "specs"
KIND = load_kind("conveyor")
ONE_START = changed(template(), scenes=[{"type": "start"}])
SLOW = {"moving_belt": "off"}
"""what is far slower than its waves, for verdicts that another effect is to change"""
LIGHT = {"takeup_mass": "off"}
"""a take-up that keeps its tension, likewise"""
HEAVY_TAIL = changed(ONE_START, tail_drum__inertia="900 kg*m^2", accuracy="2 %")
LATE_TAIL = changed(
    HEAVY_TAIL,
    scenes=[{"type": "start", "profile": {"shape": "ramp", "time": "8 s"}}],
    checks={"slip": {"reserve": 1.3}},
)
STEEP = {"type": "start", "profile": {"shape": "ramp", "control": "torque", "time": "1.5 s"}}
"""a torque that rises while the wave of its start goes to the tail: with steps the waves at the end are as high"""
WEAK_GRIP = changed(
    ONE_START,
    takeup={"type": "rigid", "tension": "30 kN"},
    scenes=[{"type": "start", "profile": {"shape": "ramp", "time": "4 s"}}],
    checks={"belt_safety_starting": 9.5},
)
STIFF_AND_LOOSE = changed(
    ONE_START,
    belt__modulus="60000 N/mm",
    belt__strength="1600 N/mm",
    belt__carcass="steel_cord",
    belt__mass="22 kg/m",
    takeup__tension="27 kN",
    scenes=[{"type": "start", "profile": {"shape": "ramp", "time": "5 s"}}],
    accuracy="1 %",
    checks={"slack_sag": "1.01 %"},
    effects=SLOW | LIGHT,
)
RELAXED = changed(
    template(),
    scenes=[{"type": "start", "belt": "relaxed", "profile": {"shape": "cosine", "time": "7 s"}}],
    effects={"sag": "off"} | LIGHT,
    checks={"belt_safety_starting": 8.4},
)
SWINGING_WEIGHT = changed(
    ONE_START,
    takeup__mass="20 t",
    scenes=[{"type": "start", "profile": {"shape": "ramp", "control": "torque", "time": "2 s"}}],
    effects={"sag": "off"} | SLOW,
    checks={"slip": {"reserve": 1.17}},
)
FASTER_RUN_OUT = changed(
    template(),
    scenes=[{"type": "stop"}],
    resistance__speed_share=0.9,
    resistance__stop_factor=1,
    effects={"sag": "off"} | LIGHT,
    checks={"stop_distance": "5.56 m"},
)
STIFFER_WHEN_PULLED = changed(
    template(),
    belt__damping={"model": "zener", "time": "3 s", "stiffening": 1.0},
    takeup__tension="80 kN",
    scenes=[{"type": "start", "profile": {"shape": "cosine", "time": "2 s"}}],
    effects={"sag": "off"} | LIGHT,
    checks={"belt_safety_starting": 3.95},
)
SOFT_AND_FAST = changed(
    template(),
    belt__modulus="1500 N/mm",
    speed="6 m/s",
    takeup={"type": "rigid", "tension": "60 kN"},
    scenes=[{"type": "start", "profile": {"shape": "cosine", "time": "5 s"}}],
    effects={"sag": "off"},
    checks={"belt_safety_starting": 7.094},
)
BRAKE_BEHIND_THE_GEAR = changed(
    template(),
    scenes=[{"type": "stop"}],
    takeup__tension="60 kN",
    drive__motor__inertia="8 kg*m^2",
    drive__gear__efficiency=0.8,
    brakes={"disc": {"torque": "300 N*m", "shaft": "motor", "delay": "1 s"}},
    resistance__stop_factor=1,
    effects={"sag": "off"} | LIGHT,
    checks={"stop_distance": "5.7 m"},
)
"""The rotor drives the belt on until the brake closes; the simulation has its losses on the other side already."""
FED = changed(
    template(),
    scenes=[{"type": "stop"}],
    resistance={
        "coefficient": 0.022,
        "secondary_force": "4 kN",
        "forces": {"chute": {"loading": {"speed": "6 m/s"}}},
        "stop_factor": 1,
    },
    effects={"sag": "off"} | LIGHT,
    checks={"stop_distance": "5.05 m"},
)
"""The fast feed pushes the belt, or stops with it; the simulation has its force in steady running."""
CHANGED_VERDICTS = [
    ("belt_wave", changed(ONE_START, checks={"slip": {"reserve": 1.35}}), "CNV101"),
    ("tail_jump", changed(ONE_START, scenes=[STEEP], checks={"slip": {"reserve": 1.28}}), "CNV101"),
    ("tail_mass", LATE_TAIL, "CNV101"),
    ("slip", WEAK_GRIP, "CNV102"),
    ("sag", STIFF_AND_LOOSE, "CNV105"),
    ("coulomb_idlers", RELAXED, "CNV102"),
    ("takeup_mass", SWINGING_WEIGHT, "CNV101"),
    ("viscous_idlers", FASTER_RUN_OUT, "CNV106"),
    ("moving_belt", SOFT_AND_FAST, "CNV102"),
    ("belt_damping", STIFFER_WHEN_PULLED, "CNV102"),
]
OPENED_VERDICTS = [("gear_losses", BRAKE_BEHIND_THE_GEAR, "CNV106"), ("feed", FED, "CNV106")]
"""of effects that have a bound and no simulation"""


@cache
def _criteria() -> dict[str, list[tuple[float, float]]]:
    """(number, threshold) of every effect over all scenes of all design files.

    No design file here has a brake on the shaft of a motor or a force of the feed: these machines stand beside them.
    """
    found: dict[str, list[tuple[float, float]]] = {}
    specs = [load_file(path, path.name).spec for path in sorted(SPECS.rglob("*conveyor*.yaml"))]
    for spec in (*specs, spec_of(BRAKE_BEHIND_THE_GEAR), spec_of(FED)):
        assert spec is not None
        for scene in plan(KIND, spec).scenes:
            for planned in scene.effects:
                if planned.criterion is not None:
                    number = planned.criterion
                    found.setdefault(planned.effect.name, []).append((number.value, number.threshold))
    return found


@pytest.mark.parametrize("effect", [effect.name for effect in KIND.effects])
def test_design_files_stand_on_both_sides_of_the_threshold(effect: str) -> None:
    sides = {value >= threshold for value, threshold in _criteria()[effect]}
    assert sides == {True, False}


def test_every_effect_is_shown_to_change_a_verdict() -> None:
    assert {effect for effect, _, _ in (*CHANGED_VERDICTS, *OPENED_VERDICTS)} == {
        effect.name for effect in KIND.effects
    }


@pytest.mark.parametrize(("effect", "data", "code"), CHANGED_VERDICTS, ids=lambda value: str(value)[:9])
def test_leaving_the_effect_out_turns_a_fail_into_a_pass(effect: str, data: dict[str, Any], code: str) -> None:
    auto, off = report_of(data), report_of(changed(data, **{f"effects__{effect}": "off"}))
    states = {line.name: line.state for line in scene_of(auto).effects}
    assert states[effect] is EffectState.SIMULATED
    assert check_of(scene_of(auto), code).verdict is Verdict.FAIL
    without = check_of(scene_of(off), code)
    assert without.verdict is Verdict.PASS
    assert effect in without.without, "a verdict without an effect says so"


@pytest.mark.parametrize(("effect", "data", "code"), OPENED_VERDICTS, ids=lambda value: str(value)[:9])
def test_the_bound_of_an_effect_opens_a_verdict_that_leaving_it_out_decides(
    effect: str, data: dict[str, Any], code: str
) -> None:
    auto, off = report_of(data), report_of(changed(data, **{f"effects__{effect}": "off"}))
    line = next(line for line in scene_of(auto).effects if line.name == effect)
    assert line.state is EffectState.BOUNDED
    assert line.criterion is not None
    assert line.criterion.value >= line.criterion.threshold
    assert check_of(scene_of(auto), code).verdict is Verdict.UNDECIDED
    without = check_of(scene_of(off), code)
    assert without.verdict is Verdict.FAIL
    assert effect in without.without, "a verdict without an effect says so"


def _report(name: str, **effects: str) -> FileReport:
    return check_file(SPECS / name, Options(effects=effects, repairs=False))


@pytest.mark.parametrize("name", ["start_loaded", "start_empty"])
def test_a_short_gently_started_belt_skips_the_waves_and_names_the_number(name: str) -> None:
    scene = scene_of(_report("short_conveyor.yaml"), name)
    wave = next(effect for effect in scene.effects if effect.name == "belt_wave")
    assert wave.state is EffectState.SKIPPED
    assert wave.criterion is not None
    assert wave.criterion.value < wave.criterion.threshold
    assert [solver.name for solver in scene.solvers if solver.decides] == ["rigid"]


def test_the_long_belt_simulates_them() -> None:
    for scene in _report("conveyor.yaml").scenes:
        if scene.type == "start":
            assert {effect.name: effect.state for effect in scene.effects}["belt_wave"] is EffectState.SIMULATED


def test_forcing_the_waves_on_in_the_short_belt_changes_no_verdict_and_stays_inside_the_bars() -> None:
    auto, forced = _report("short_conveyor.yaml"), _report("short_conveyor.yaml", belt_wave="on")
    for name in ("start_loaded", "start_empty"):
        cheap, dear = scene_of(auto, name), scene_of(forced, name)
        assert any(solver.name == "characteristics" for solver in dear.solvers)
        assert [j.verdict for j in cheap.checks] == [j.verdict for j in dear.checks] == [Verdict.PASS] * 4
        moved = 0
        for load in cheap.loads:
            other = load_of(dear, load.info.name)
            slack = other.estimate.numerical + 1e-9 * abs(load.estimate.value)
            assert load.estimate.low - slack <= other.estimate.value <= load.estimate.high + slack, load.info.name
            moved += other.estimate.value != load.estimate.value
        assert moved >= 5, "the waves do move the loads, by less than the bars"


def test_jump_tail_mass_and_slip_make_one_run_whose_loads_are_no_sum_of_single_runs(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    data = changed(HEAVY_TAIL, effects={"sag": "off"} | SLOW | LIGHT, takeup__tension="26 kN", accuracy=None)
    carried: list[tuple[bool, bool]] = []
    march = characteristics.strand.march

    def counted(loop: Any, *rest: Any) -> Any:
        carried.append((loop.tail_mass > 0, loop.grip is not None))
        return march(loop, *rest)

    monkeypatch.setattr(characteristics.strand, "march", counted)
    spec = spec_of(data)
    settled = settle(KIND, spec, plan(KIND, spec).scenes[0])
    assert [run.rung.solver.name for run in settled.runs] == ["rigid", "characteristics"]
    assert settled.carried == {"belt_wave", "tail_jump", "tail_mass", "slip"}
    assert carried == [(True, True)] * 2, "one run: a grid and its refinement"

    def peak(*wanted: str) -> float:
        off = {name: "off" for name in ("tail_jump", "tail_mass", "slip") if name not in wanted}
        report = report_of(changed(data, effects={"sag": "off", "belt_wave": "on"} | SLOW | LIGHT | off))
        return load_of(scene_of(report), "tension_run_on_max").estimate.value

    plain, together = peak(), settled.estimates["tension_run_on_max"]
    summed = plain + sum(peak(one) - plain for one in ("tail_jump", "tail_mass", "slip"))
    assert abs(summed - together.value) > 0.02 * together.value > 10 * together.numerical
