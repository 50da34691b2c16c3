"""The course of a small swing beside that of any swing: two methods that share no step."""

import numpy as np
import pytest
from support.command import ROOT

from ptmcalc.engine.load import load_file
from ptmcalc.machines.crane.travelling.machine.spec import Travelling
from ptmcalc.machines.crane.travelling.sway.sway_linear import SWAY_LINEAR
from ptmcalc.machines.crane.travelling.sway.sway_simulated import SWAY_SIMULATED


@pytest.mark.parametrize("label", ["start_loaded", "brake_loaded", "hoist_while_travelling_loaded"])
def test_small_swing_and_simulated_swing_go_together(label: str) -> None:
    """Angles below 2 degrees: what finite angles change is below a thousandth of them."""
    loaded = load_file(ROOT / "specs" / "crane_travelling.yaml", "crane_travelling.yaml")
    assert isinstance(loaded.spec, Travelling)
    (scene,) = (one for one in loaded.spec.all_scenes if one.label == label)
    courses = [solver.run(loaded.spec, scene, solver.always, 0).histories() for solver in (SWAY_LINEAR, SWAY_SIMULATED)]
    for name in ("sway_angle_max", "horizontal_force"):
        small, simulated = (course[name] for course in courses)
        until = min(small.times[-1], simulated.times[-1])
        assert until > 5.0
        times = np.linspace(0.05, until - 0.05, 200)
        values = np.interp(times, small.times, small.values), np.interp(times, simulated.times, simulated.values)
        size = max(map(abs, simulated.values))
        assert size > 0
        jumps = np.abs(np.gradient(values[1])) > 0.2 * size  # an imposed ramp ends at once
        assert np.abs(values[0] - values[1])[~jumps].max() < 0.01 * size
