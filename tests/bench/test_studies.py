"""How much work a study is: runs of a solver, not seconds."""

from pathlib import Path
from unittest import mock

import numpy as np
from support.command import ROOT

from ptmcalc.contract.study import Points
from ptmcalc.engine.check import Options
from ptmcalc.engine.load import load_file
from ptmcalc.engine.points import BLOCK, Study, varied_key
from ptmcalc.machines.conveyor.running import statics


def test_a_hundred_thousand_machines_are_a_few_runs_for_each_block() -> None:
    """The closed forms of the overland conveyor, five keys varied, what nobody gave at both ends:
    the runs grow with the blocks, not the machines."""
    loaded = load_file(Path(ROOT / "specs" / "conveyor.yaml"), "conveyor.yaml")
    chance, runs, solve = np.random.default_rng(1), [0], statics._of_running
    ranges = {
        "takeup.tension": (150e3, 300e3),
        "drive.drum.friction": (0.2, 0.4),
        "route.lift": (50, 70),
        "belt.mass": (18, 22),
        "speed": (3.5, 4.5),
    }

    def counted(*arguments):  # type: ignore[no-untyped-def]
        runs[0] += 1
        return solve(*arguments)

    for count in (BLOCK, 100_000):
        keys = [varied_key(loaded, name)[0] for name in ranges]
        values = np.stack([chance.uniform(*ends, count) for ends in ranges.values()], axis=1)
        study, runs[0] = Study(loaded, Points(keys, values), Options(("run_loaded",))), 0
        with mock.patch.object(statics, "_of_running", counted):
            study.run_by_lanes()
        assert study.by_lanes == count
        assert study.points.notes == []
        blocks = -(-count // BLOCK)
        assert blocks <= runs[0] <= 24 + 37 * blocks
