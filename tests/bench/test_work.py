"""What a check costs: gates on counts, which are the same on every machine; seconds are recorded, never judged.

`python -m pytest tests/bench -n 0 -m "study or not study" --benchmark-enable` prints the seconds.
"""

from pathlib import Path
from typing import Any

import pytest
from support.machines import BW_02, report_of, scene_of, spec_of

from ptmcalc.engine.check import Options, check_file
from ptmcalc.engine.plan import plan_scene
from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.conveyor.waves import characteristics

SPECS = Path(__file__).parents[2] / "specs"


@pytest.mark.study
@pytest.mark.parametrize("path", sorted(SPECS.rglob("*.yaml")), ids=lambda path: path.stem)
def test_seconds_of_a_check(path: Path, benchmark: Any) -> None:
    """What it may cost in counts stands in `tests/house/test_specs.py`, where all are checked once."""
    report = benchmark.pedantic(check_file, (path, Options()), rounds=1)
    assert report.verdict == "pass"


def test_the_price_of_a_run_is_predicted_from_its_work() -> None:
    """Predicted seconds grow with the work that is really done, refinement by refinement."""
    spec = spec_of(BW_02)
    scene = spec.all_scenes[0]
    carried = frozenset({"belt_wave", "tail_jump"})
    runs = [characteristics.run(spec, scene, carried, level).work for level in range(3)]
    prices = [characteristics.cost(spec, scene, carried, level) for level in range(3)]
    assert runs == sorted(runs)
    assert prices == sorted(prices)
    assert prices[2] / prices[0] == pytest.approx(runs[2] / runs[0], rel=0.8)


def test_closed_forms_alone_cost_next_to_nothing() -> None:
    scene = scene_of(report_of(BW_02 | {"takeup": {"type": "gravity", "tension": "900 kN"}}))
    assert [solver.name for solver in scene.solvers if solver.decides] == ["rigid"]
    assert scene.health["evaluations"] == 1
    plan = plan_scene(load_kind("conveyor"), spec_of(BW_02), spec_of(BW_02).all_scenes[0])
    assert plan.rungs[0].seconds < 0.05 * plan.rungs[-1].seconds
