"""A start by an imposed speed so sharp that its waves turn the belt back: the idlers' friction turns round with it.

Delay lines rub forward for ever; finite elements with Coulomb friction do not.
"""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest
from support.belt_fem import simulate
from support.belt_scenes import Drive, Rig
from support.machines import load_of, report_of, scene_of, spec_of

from ptmcalc.contract.report import SceneReport
from ptmcalc.machines.conveyor.machine.plain_start import thrown_back

RIG = Rig(sections=((400.0, 12.0),), stiffness=12e6, tension=400e3, drives={"head": Drive(friction=None)})
SHARP, GENTLE = 0.5, 3.2
"""Rise over the time a wave goes round the belt."""


def cosine(rise: float) -> Callable[[float], float]:
    return lambda time: RIG.speed / 2 * (1 - math.cos(math.pi * min(time / rise, 1.0)))


def told(rig: Rig, rise: float, **effects: str) -> SceneReport:
    return scene_of(report_of(data_of(rig, rise, **effects)))


def data_of(rig: Rig, rise: float, **effects: str) -> dict[str, Any]:
    profile = {"shape": "cosine", "time": f"{rise!r} s"}
    return rig.data(
        {"type": "start", "profile": profile},
        effects={"moving_belt": "off", "takeup_mass": "off"} | effects,
        accuracy="2 %",
    )


@pytest.mark.parametrize("rigid", [False, True], ids=["gravity", "rigid"])
def test_finite_elements_that_turn_back_come_to_the_same_tensions(rigid: bool) -> None:
    rig = replace(RIG, rigid=rigid, tension=600e3 if rigid else 400e3)
    rise = SHARP * rig.contour()
    scene = told(rig, rise)
    assert {solver.name for solver in scene.solvers if solver.decides} >= {"network"}
    lengths = rig.lengths(factor=rig.start_factor)
    high = load_of(scene, "tension_max")
    assert high.window is not None
    plan = replace(rig.plan(lengths, {}), head_speed=cosine(rise))
    motion = simulate(plan, 400, high.window[1], rig.running(lengths, 400), 0.0)
    low = load_of(scene, "tension_min").estimate
    assert high.estimate.low < motion.highest.max() < high.estimate.high
    assert low.low < motion.lowest.min() < low.high
    forward = load_of(told(rig, rise, coulomb_idlers="off"), "tension_max").estimate
    assert forward.low > motion.highest.max(), "without the turn of the friction it is wrong"


def test_a_gentler_start_slides_on_and_is_left_to_the_delay_lines() -> None:
    rise = GENTLE * RIG.contour()
    spec = spec_of(data_of(RIG, rise))
    assert not thrown_back(spec, spec.all_scenes[0])
    scene = told(RIG, rise)
    assert "network" not in {solver.name for solver in scene.solvers}
    lengths = RIG.lengths(factor=RIG.start_factor)
    motion = simulate(replace(RIG.plan(lengths, {}), head_speed=cosine(rise)), 400, 3 * rise, RIG.running(lengths, 400))
    high = load_of(scene, "tension_max").estimate
    assert abs(high.value - motion.highest.max()) < 0.002 * high.value
