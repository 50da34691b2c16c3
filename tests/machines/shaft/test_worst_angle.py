"""The worst angle of a stop lies between those that are run from first, where only a closer look finds it."""

import numpy as np
import pytest
from support.command import ROOT

from ptmcalc.engine.load import load_file
from ptmcalc.machines.shaft.machine.spec import RunOut, Shaft
from ptmcalc.machines.shaft.speed_changes import worst
from ptmcalc.machines.shaft.speed_changes.cases import departure
from ptmcalc.machines.shaft.speed_changes.motion import ORDERS, run_out


@pytest.mark.parametrize("which", [worst.TIME, worst.ANGLE])
def test_no_angle_is_worse_than_the_worst(which: int) -> None:
    spec = load_file(ROOT / "specs/shaft.yaml", "shaft.yaml").spec
    assert isinstance(spec, Shaft)
    scene = next(one for one in spec.all_scenes if isinstance(one, RunOut) and one.brake != "off")
    start = departure(spec, scene)
    found = worst.Search(start).worst(which)
    values = [
        worst.measured(run_out(start.machine, angle, start.cycle.speed_at(angle), ORDERS[0]), which)
        for angle in np.linspace(0.0, start.machine.period, 72, endpoint=False).tolist()
    ]
    assert max(values) <= found.value.high
    assert found.value.value == pytest.approx(max(values), rel=1e-4)
