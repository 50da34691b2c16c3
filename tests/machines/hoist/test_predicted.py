"""What a run of a hoist is predicted to take, and where one that takes far more is given up: counts, never seconds."""

from typing import Any

import pytest
import yaml
from support.hoists import CRANE
from support.machines import changed

from ptmcalc.base.errors import NumericsError
from ptmcalc.engine.load import load_text
from ptmcalc.engine.plan import Rung, plan_scene

BUDGET = 5.0
INDUCTION = {"type": "induction", "power": "22 kW", "speed": "1 rpm", "synchronous_speed": "1500 rpm", "overload": 2.5}


def rungs(data: dict[str, Any], solver: str) -> tuple[Any, list[Rung]]:
    """The first scene of a file, and its rungs of a solver at their coarsest."""
    loaded = load_text(yaml.safe_dump(data).encode(), "case.yaml")
    assert loaded.spec is not None, loaded.diagnostics
    scene = loaded.spec.all_scenes[0]
    made = plan_scene(loaded.kind, loaded.spec, scene)
    return (loaded.spec, scene), [rung for rung in made.rungs if rung.solver.name == solver and rung.level == 0]


def undamped(scene: dict[str, Any], **changes: Any) -> dict[str, Any]:
    return changed(CRANE, rope__damping=0, scenes=[scene], **changes)


@pytest.mark.parametrize(
    "changes",
    [
        {"rope__area": "1e6 m^2", "rope__modulus": "1e15 Pa"},
        {"load": "1e-12 kg", "hook_block": "0 kg"},
    ],
    ids=["rope_of_1e6_m2", "load_of_a_picogram"],
)
@pytest.mark.parametrize("scene", ["start", "lower_brake"])
def test_what_rings_alone_for_the_whole_window_is_beyond_any_budget(scene: str, changes: dict[str, Any]) -> None:
    _, found = rungs(undamped({"type": scene}, **changes), "two_mass")
    assert found
    assert all(rung.seconds > 100 * BUDGET for rung in found)


def test_damping_makes_the_same_rope_cheap() -> None:
    data = undamped({"type": "start"}, rope__area="1e6 m^2", rope__modulus="1e15 Pa")
    (spec, scene), found = rungs(changed(data, rope__damping=0.02), "two_mass")
    assert found
    for rung in found:
        assert rung.seconds < 0.1
        assert rung.solver.run(spec, scene, rung.carried, 0).spent < 2 * rung.seconds


@pytest.mark.parametrize("scene", ["lift", "release"])
def test_a_structure_without_mass_to_speak_of_is_given_up(scene: str) -> None:
    """It rings at 1e9 rad/s under every event of a rope a million times slower."""
    data = undamped({"type": scene}, structure={"stiffness": "6 MN/m", "mass": "1e-12 kg"})
    (spec, which), found = rungs(data, "hoist_train")
    assert found
    assert min(rung.seconds for rung in found) < BUDGET
    with pytest.raises(NumericsError, match=r"given up|cannot be separated"):
        found[0].solver.run(spec, which, found[0].carried, 0)


def test_a_motor_of_one_turn_a_minute_on_a_hauled_rope_is_given_up() -> None:
    data = undamped({"type": "start", "profile": {"shape": "curve"}})
    data["motor"] = {"inertia": "0.13 kg*m^2", "curve": INDUCTION}
    (spec, scene), found = rungs(data, "rope_hauled")
    assert found
    assert found[0].seconds < BUDGET
    with pytest.raises(NumericsError, match="given up"):
        found[0].solver.run(spec, scene, found[0].carried, 0)
