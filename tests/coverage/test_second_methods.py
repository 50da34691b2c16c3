"""The second method of every kind and the richest solver of the first: neither lies outside what both know."""

from typing import Any

import pytest
from support.command import ROOT

from ptmcalc.engine.load import load_file
from ptmcalc.engine.plan import plan

SCENES = [
    ("specs/drivetrain.yaml", "braking_while_lowering", "dormand_prince"),
    ("specs/hoist.yaml", "lift_loaded", "dormand_prince"),
    ("specs/hoist.yaml", "stop_up", "dormand_prince"),
    ("specs/shaft.yaml", "run_up", "runge_kutta_up"),
    ("specs/shaft.yaml", "steady", "runge_kutta_cycle"),
    ("specs/shaft.yaml", "coast", "runge_kutta_out"),
    ("specs/crane_slewing.yaml", "slew_loaded", "cartesian"),
    ("specs/crane_travelling.yaml", "start_loaded", "sway_cartesian"),
    ("specs/crane_travelling.yaml", "emergency_stop", "sway_cartesian"),
    ("specs/crane_travelling.yaml", "hoist_while_travelling_loaded", "sway_cartesian"),
    ("specs/crane/container_gantry.yaml", "start_loaded", "sway_cartesian"),
    ("specs/crane/container_gantry.yaml", "brake_loaded", "sway_cartesian"),
    ("specs/crane_travelling.yaml", "collision_loaded", "collision_runge_kutta"),
    ("specs/crane/container_gantry.yaml", "collision_loaded", "collision_runge_kutta"),
    ("specs/crane_travelling.yaml", "rail_step_loaded", "rail_runge_kutta"),
    ("specs/crane_travelling.yaml", "skew_loaded", "skewing_roots"),
    ("specs/crane/container_gantry.yaml", "storm_empty", "storm_balances"),
    ("specs/crane_rack_stacker.yaml", "fork_caught_loaded", "caught_runge_kutta"),
    ("specs/crane_rack_stacker.yaml", "fork_push_loaded", "push_runge_kutta"),
    ("specs/chain_drive.yaml", "run_loaded", "mesh"),
    ("specs/conveyor/decline_conveyor.yaml", "emergency_stop_loaded", "elements"),
    ("specs/conveyor/screw_takeup_conveyor.yaml", "jam_loaded", "elements"),
]
LONG = [
    ("specs/conveyor/screw_takeup_conveyor.yaml", "run_out_empty", "elements"),
    ("specs/conveyor/two_drive_conveyor.yaml", "start_on_the_hill", "elements"),
    ("specs/drivetrain.yaml", "hoisting", "dormand_prince"),
    ("specs/hoist.yaml", "lower_brake_loaded", "dormand_prince"),
    ("specs/shaft.yaml", "run_out", "runge_kutta_out"),
    ("specs/conveyor/decline_conveyor.yaml", "stop_empty", "elements"),
    ("specs/conveyor/overland_conveyor.yaml", "emergency_stop_loaded", "elements"),
    ("specs/conveyor/grain_conveyor.yaml", "stop_loaded", "elements"),
    ("specs/conveyor/two_drive_conveyor.yaml", "start_loaded", "elements"),
    ("specs/conveyor/two_drive_conveyor.yaml", "coast_loaded", "elements"),
]


def found(path: str, label: str, name: str) -> tuple[Any, Any]:
    """What both find, with the effects that both carry."""
    loaded = load_file(ROOT / path, path)
    assert loaded.kind is not None
    assert loaded.spec is not None
    scene = next(one for one in plan(loaded.kind, loaded.spec, None).scenes if one.scene.label == label)
    witness = next(one for one in loaded.kind.witnesses if one.name == name)
    allowed = frozenset(one.effect.name for one in scene.effects) - scene.excluded
    assert witness.usable_for(loaded.spec, scene.scene)
    carried = allowed & witness.represents
    shared = [rung for rung in scene.rungs if witness.gives & rung.solver.gives and rung.solver.always <= carried]
    rung = max(shared, key=lambda one: (len(one.carried & carried), one.seconds))
    own = rung.solver.run(loaded.spec, scene.scene, rung.carried & carried, rung.level)
    return witness.run(loaded.spec, scene.scene, rung.carried & carried | witness.always, 0), own


@pytest.mark.parametrize(
    ("path", "label", "name"),
    [*SCENES, *(pytest.param(*one, marks=pytest.mark.study) for one in LONG)],
)
def test_both_methods_hold_one_value(path: str, label: str, name: str) -> None:
    second, first = found(path, label, name)
    compared = [load for load in second.loads if load in first.loads and second.loads[load].estimate.bounded]
    assert compared
    for load in compared:
        one, two = first.loads[load].estimate, second.loads[load].estimate
        slack = 1e-9 * max(abs(one.value), abs(two.value)) if one.bounded else 0.0
        assert one.low - slack <= two.high, load
        assert two.low <= one.high + slack, load
