"""What `plan` predicts against the processor's clock: recorded in a study, judged only there; here the counts.

`python -m pytest tests/bench/test_plan_total.py -n 0 -m study -s` prints the table. On 2 virtual cores, Python 3.11,
2026-11-22, other work going on beside it (ratio = predicted over measured seconds of a check of the file as it stands,
without repairs and without the ends of assumed values; plain starts measured anew when their bounds were
remembered):

    chain_drive/inclined_scraper.yaml              0.1241 s   0.2091 s  0.59
    chain_drive/roller_drive.yaml                  0.0373 s   0.0557 s  0.67
    chain_drive.yaml                               0.1433 s   0.2499 s  0.57
    conveyor/decline_conveyor.yaml                 4.8293 s   2.4040 s  2.01
    conveyor/grain_conveyor.yaml                   5.8417 s   4.6017 s  1.27
    conveyor/hollow_conveyor.yaml                  0.8539 s   1.3741 s  0.62
    conveyor/overland_conveyor.yaml                8.7254 s  12.0045 s  0.73
    conveyor/screw_takeup_conveyor.yaml            9.2505 s   3.1519 s  2.93
    conveyor/two_drive_conveyor.yaml               1.5461 s   1.1244 s  1.38
    conveyor.yaml                                  0.9301 s   0.6464 s  1.44
    crane/container_gantry.yaml                    0.2164 s   0.2080 s  1.04
    crane/hoist_trolley.yaml                       0.2532 s   0.4912 s  0.52
    crane_slewing.yaml                             0.9784 s   0.3917 s  2.50
    crane_travelling.yaml                          0.1274 s   0.2282 s  0.56
    crusher_shaft.yaml                             1.0003 s   0.4242 s  2.36
    drivetrain.yaml                                0.2136 s   0.3379 s  0.63
    hoist/crane_hoist_m5.yaml                      0.3194 s   0.2901 s  1.10
    hoist/winding_paper/height_25_rope_17_5.yaml   0.0055 s   0.0045 s  1.23
    hoist/winding_paper/height_30_rope_17_5.yaml   0.0055 s   0.0042 s  1.31
    hoist/winding_paper/height_35_rope_17_5.yaml   0.0055 s   0.0040 s  1.38
    hoist/winding_paper/height_40_rope_13.yaml     0.0055 s   0.0059 s  0.93
    hoist/winding_paper/height_40_rope_14_5.yaml   0.0055 s   0.0040 s  1.36
    hoist/winding_paper/height_40_rope_16.yaml     0.0055 s   0.0042 s  1.32
    hoist/winding_paper/height_40_rope_17_5.yaml   0.0055 s   0.0043 s  1.29
    hoist.yaml                                     0.1847 s   0.2025 s  0.91
    plant_conveyor.yaml                            0.4894 s   0.4434 s  1.10
    reference/bw_02.yaml                           0.0198 s   0.0216 s  0.92
    shaft.yaml                                     0.0818 s   0.0716 s  1.14
    short_conveyor.yaml                            0.0125 s   0.0304 s  0.41
"""

import gc
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import pytest
from support.command import ROOT
from support.toys import Log, effect, kind_of, loaded, pull, solver

from ptmcalc.base.estimate import Interval
from ptmcalc.base.memory import forget
from ptmcalc.contract.machine import AnyKind
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.files import design_files
from ptmcalc.engine.forecast import Foreseen, foresee
from ptmcalc.engine.load import load_file
from ptmcalc.engine.plan import plan

SPECS = design_files(ROOT / "specs")
MOST = 3.0


@contextmanager
def uncollected() -> Iterator[None]:
    gc.disable()
    try:
        yield
    finally:
        gc.enable()


@pytest.mark.study
@pytest.mark.parametrize("path", SPECS, ids=lambda path: path.stem)
def test_seconds_predicted_and_measured(path: Path) -> None:
    """Of the processor, the least of three: other processes do not count."""
    made = load_file(path, path.name)
    assert made.kind is not None
    assert made.spec is not None
    predicted, measured = sum(one.seconds for one in foresee(plan(made.kind, made.spec))), []
    for _ in range(3):
        forget()
        with uncollected():
            start = time.process_time()
            check(replace(made, assumed=()), Options(repairs=False))
            measured.append(time.process_time() - start)
    ratio = predicted / min(measured)
    name = path.relative_to(ROOT / "specs").as_posix()
    print(f"{name:45} {predicted:8.4f} s {min(measured):8.4f} s  ratio {ratio:5.2f}")
    assert 1 / MOST <= ratio <= MOST


# -- counts ----------------------------------------------------------------------------------------------------------


def coming(kind: AnyKind, **data: object) -> Foreseen:
    made = loaded(kind, **data)
    assert made.spec is not None
    (found,) = foresee(plan(kind, made.spec))
    return found


def test_a_dear_run_is_foreseen_and_not_made() -> None:
    log = Log()
    wind = effect("wind", 1.0, Interval(-3e3, 3e3))
    kind = kind_of(
        solver("cheap", pull(8), seconds=1e-3, log=log),
        solver("dear", pull(8), carries=("wind",), seconds=1.0, log=log),
        effects=[wind],
    )
    found = coming(kind)
    assert log.names == ["cheap"]
    assert [rung.solver.name for rung in found.rungs] == ["cheap", "dear"]
    assert found.carried == {"wind"}
    assert found.seconds == pytest.approx(1e-3 + 1.1)


def test_what_the_cheap_run_decides_costs_nothing_more() -> None:
    kind = kind_of(
        solver("cheap", pull(8), seconds=1e-3),
        solver("dear", pull(8), carries=("wind",), seconds=1.0),
        effects=[effect("wind", 1.0, Interval(-1e3, 1e3))],
    )
    assert coming(kind).seconds == pytest.approx(1e-3)
    assert len(coming(kind, strength="8.5 kN").rungs) == 2, "the limit is inside the bound"


def test_the_accuracy_of_the_file_is_foreseen() -> None:
    kind = kind_of(
        solver("cheap", pull(8), seconds=1e-3),
        solver("dear", pull(8), carries=("wind",), seconds=1.0),
        effects=[effect("wind", 1.0, Interval(-1e3, 1e3))],
    )
    assert [rung.solver.name for rung in coming(kind, accuracy="1 %").rungs] == ["cheap", "dear"]


def test_a_run_without_an_effect_near_its_threshold_is_foreseen_too() -> None:
    """It is made to say what the effect changes."""
    kind = kind_of(solver("dear", pull(8), carries=("wind",), seconds=1.0), effects=[effect("wind", 0.11)])
    assert coming(kind).seconds == pytest.approx(2 * 1.1)


def test_nothing_is_foreseen_beyond_the_budget() -> None:
    found = coming(kind_of(solver("dear", pull(8), seconds=100.0)))
    assert (found.rungs, found.seconds) == ((), 0.0)


@pytest.mark.parametrize(
    "name",
    ["conveyor.yaml", "conveyor/two_drive_conveyor.yaml", "hoist.yaml", "shaft.yaml", "crane_slewing.yaml"],
)
def test_the_climb_of_a_spec_is_foreseen_rung_by_rung(name: str) -> None:
    """No dear run is made for it, and the rungs are those the check will run first."""
    from ptmcalc.engine.run import settle

    made = load_file(ROOT / "specs" / name, name)
    assert made.kind is not None
    assert made.spec is not None
    planned = plan(made.kind, made.spec)
    for scene, found in zip(planned.scenes, foresee(planned), strict=True):
        assert all(run.rung.seconds <= 0.01 for run in found.settled.runs)
        if found.seconds > 0.5:
            continue  # the dear ones are the study's
        climbed = settle(made.kind, made.spec, scene)
        foreseen = {rung.solver.name for rung in found.rungs}
        ran = {run.rung.solver.name for run in climbed.runs}
        assert foreseen == ran, scene.scene.label
