"""The finite elements of a whole belt: what they begin with."""

import numpy as np
import pytest
from support.command import ROOT

from ptmcalc.engine.load import load_file
from ptmcalc.machines.conveyor.machine.motion import moving
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.reference import _moved

SCREW = "specs/conveyor/screw_takeup_conveyor.yaml"
CARRIED = frozenset({"belt_wave", "tail_jump", "tail_mass", "coulomb_idlers", "slip"})


@pytest.mark.parametrize("elements", [40, 160])
def test_a_running_belt_begins_in_balance(elements: int) -> None:
    """Drives off, and until the drum's slowing comes back from the tail nothing but that is felt at the head:

        v = v_0 - F/Z (1 - exp(-Z t/m)),   S_on = S - Z_on (v_0 - v),   S_off = S + Z_off (v_0 - v),   Z = Z_on + Z_off

    A pulse that sets out from the tail at the start, as high as the tail's force, would be there in half that time.
    """
    spec = load_file(ROOT / SCREW, SCREW).spec
    assert isinstance(spec, Conveyor)
    case = moving(spec, next(one for one in spec.scenes if one.label == "run_out_empty"))
    line = case.line
    motion = _moved(case, CARRIED, elements)
    step, behind, before = float(motion.times[1]), line.impedance(0), line.impedance(1)
    alone = motion.times < 2 * min(line.transit(0), line.transit(1)) - 4 * step
    rate = (behind + before) / line.drive_mass
    lost = -line.static_resistance / (behind + before) * np.expm1(-rate * motion.times[alone])
    near = 2 * line.static_resistance * rate * step
    assert near < line.tail_force / 10
    assert np.array(motion.head.on)[alone] == pytest.approx(line.run_on - before * lost, abs=near)
    assert np.array(motion.head.off)[alone] == pytest.approx(line.run_off + behind * lost, abs=near)
