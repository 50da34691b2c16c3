"""The second method of every kind and the richest solver of the first: neither lies outside what both know."""

from typing import Any

import pytest
from support.chains import CH_05, MOTOR, ROLLER, chain_of
from support.command import ROOT
from support.machines import changed

from ptmcalc.contract.result import Result
from ptmcalc.engine.load import load_file
from ptmcalc.engine.plan import plan
from ptmcalc.machines.chain_drive.polygon.distributed_strand import DISTRIBUTED_STRAND
from ptmcalc.machines.chain_drive.polygon.excitation import FAR, POLYGON, WEAK
from ptmcalc.machines.chain_drive.reference import MESH, MESH_HARMONICS

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
    ("specs/chain_drive/roller_drive.yaml", "run_loaded", "mesh_harmonics"),
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
    ("specs/conveyor/overland_conveyor.yaml", "e_stop", "elements"),
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
    reference = next(one for one in loaded.kind.reference_methods if one.name == name)
    allowed = frozenset(one.effect.name for one in scene.effects) - scene.excluded
    assert reference.usable_for(loaded.spec, scene.scene)
    carried = allowed & reference.represents
    shared = [rung for rung in scene.rungs if reference.gives & rung.solver.gives and rung.solver.always <= carried]
    rung = max(shared, key=lambda one: (len(one.carried & carried), one.seconds))
    own = rung.solver.run(loaded.spec, scene.scene, rung.carried & carried, rung.level)
    return reference.run(loaded.spec, scene.scene, rung.carried & carried | reference.always, 0), own


@pytest.mark.parametrize(
    ("path", "label", "name"),
    [*SCENES, *(pytest.param(*one, marks=pytest.mark.study) for one in LONG)],
)
def test_both_methods_hold_one_value(path: str, label: str, name: str) -> None:
    agree(*found(path, label, name))


def agree(second: Result, first: Result, near: float = 1e3) -> None:
    """Both hold one value of every load, and differ by no more than a share of it."""
    compared = [load for load in second.loads if load in first.loads and second.loads[load].estimate.bounded]
    assert compared
    for load in compared:
        one, two = first.loads[load].estimate, second.loads[load].estimate
        slack = 1e-9 * max(abs(one.value), abs(two.value)) if one.bounded else 0.0
        assert one.low - slack <= two.high, load
        assert two.low <= one.high + slack, load
        assert abs(one.value - two.value) <= near * abs(two.value), load


DRIVEN = changed(CH_05, drive=MOTOR, speed="0.9 m/s")
CHAINS = {
    "even sprocket": CH_05,
    "drive that gives way": DRIVEN,
    "take-up weight": changed(DRIVEN, layout__takeup__mass="4000 kg"),
    "screw take-up": changed(DRIVEN, layout__takeup={"type": "screw", "tension": "30 kN"}),
    "driven tail": changed(DRIVEN, layout__tail={"teeth": 9, "driven": "on", "phase": 0.3}),
    "driven tail anywhere": changed(DRIVEN, layout__tail={"teeth": 9, "driven": "on"}),
    "hysteresis": changed(DRIVEN, chain__damping={"law": "hysteretic", "ratio": 0.05}),
    "two shafts": changed(ROLLER, drive=MOTOR),
    "Zener": changed(ROLLER, chain__damping={"law": "zener", "time": "2 ms", "stiffening": 0.3}),
}


@pytest.mark.parametrize("name", CHAINS)
def test_the_polygon_effect_is_that_of_finite_elements(name: str) -> None:
    """Of every far end and damping, with all that a chain can be moved by; a mesh of 120 elements comes to some 1e-3,
    at the jump of an engagement to 1e-2."""
    spec = chain_of(CHAINS[name])
    (scene,) = spec.all_scenes
    carried = frozenset({POLYGON, FAR, WEAK})
    first = DISTRIBUTED_STRAND.run(spec, scene, carried, 1)
    useful = [one for one in (MESH, MESH_HARMONICS) if one.usable_for(spec, scene)]
    assert len(useful) == 1
    agree(useful[0].run(spec, scene, carried & useful[0].represents, 0), first, near=1e-2)


def test_both_meshes_are_one_where_both_can_tell() -> None:
    spec = chain_of(DRIVEN)
    (scene,) = spec.all_scenes
    assert not MESH_HARMONICS.usable_for(spec, scene)
    agree(*(one.run(spec, scene, frozenset({POLYGON, WEAK}), 0) for one in (MESH, MESH_HARMONICS)), near=1e-2)
