"""Only what a scene calls for is computed: an effect that is skipped costs nothing, and the ledger says so."""

from dataclasses import dataclass, replace
from typing import Any

import pytest
from support.command import ROOT
from support.toys import Log, effect, effect_of, kind_of, pull, report, solver

from ptmcalc.base.estimate import Interval
from ptmcalc.base.memory import forget
from ptmcalc.contract.effect import EffectState
from ptmcalc.contract.machine import AnyKind
from ptmcalc.contract.report import FileReport, SceneReport
from ptmcalc.contract.result import Result
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import Loaded, load_file
from ptmcalc.report import Format, render

Called = list[tuple[str, str, frozenset[str], int]]
SIMPLE = {
    "specs/reference/bw_02.yaml": ("coulomb_idlers", "tail_mass"),
    "specs/short_conveyor.yaml": ("belt_wave", "slip"),
    "specs/hoist.yaml": ("structure", "rope_mass"),
    "specs/crane_travelling.yaml": ("large_sway", "wheel_slip"),
    "specs/shaft.yaml": ("varying_inertia",),
}
"""A file of several kinds, and effects that are below their thresholds in some scene of it."""


@dataclass(frozen=True)
class Watched:
    """A check whose solvers noted every call: scene, solver, effects, level."""

    path: str
    found: FileReport
    called: Called

    @property
    def skipped(self) -> dict[str, set[str]]:
        """Names of what was skipped, by scenes that have effects at all."""
        return {scene.name: skipped(scene) for scene in self.found.scenes if scene.effects}


def plainly(made: Loaded) -> FileReport:
    """The check without repairs and without the ends of assumed values, with nothing remembered."""
    forget()
    return check(replace(made, assumed=()), Options(repairs=False))


@pytest.fixture(scope="module", params=SIMPLE)
def watched(request: pytest.FixtureRequest) -> Watched:
    path, called = request.param, Called()
    made = load_file(ROOT / path, path)
    assert made.kind is not None

    def noting(one: Any) -> Any:
        def run(spec: Any, scene: Any, carried: frozenset[str], level: int) -> Result:
            called.append((scene.label, one.name, carried, level))
            return one.run(spec, scene, carried, level)

        return replace(one, run=run) if one.decides else one  # a formula beside it carries what its book carries

    kind: AnyKind = replace(made.kind, solvers=tuple(map(noting, made.kind.solvers)))
    return Watched(path, plainly(replace(made, kind=kind)), called)


def skipped(scene: SceneReport) -> set[str]:
    return {one.name for one in scene.effects if one.state is EffectState.SKIPPED}


def work(found: FileReport) -> dict[str, float]:
    return {scene.name: scene.health["evaluations"] for scene in found.scenes}


def test_no_run_carries_what_is_skipped(watched: Watched) -> None:
    """Neither for a verdict nor to show what another effect changes."""
    assert watched.called
    assert set(SIMPLE[watched.path]) <= set().union(*watched.skipped.values())
    assert [one for one in watched.called if one[2] & watched.skipped.get(one[0], set())] == []


def test_the_work_is_that_of_a_machine_that_knows_nothing_of_what_is_skipped(watched: Watched) -> None:
    """The same file with what every scene skips forced off: the same runs, the same count."""
    everywhere = set.intersection(*watched.skipped.values())
    off = load_file(ROOT / watched.path, watched.path, dict.fromkeys(sorted(everywhere), "off"))
    assert work(plainly(off)) == work(watched.found)


def test_the_ledger_lists_what_was_skipped_with_its_number(watched: Watched) -> None:
    """An effect that the machine does not have is in no list, and its number is 0."""
    text = " ".join(render(Format.TABLE, [watched.found], width=200).split())
    ledger = text.partition(" Effects ")[2].partition(" Solvers ")[0]
    listed = 0
    for scene in watched.found.scenes:
        for one in scene.effects:
            if one.state is EffectState.SKIPPED and one.criterion is not None:
                assert one.criterion.value < one.criterion.threshold
                assert not one.absent or one.criterion.value == 0
                assert one.absent or f"{one.name} {one.criterion.symbol} = " in ledger
                listed += 1
    assert listed >= len(SIMPLE[watched.path])


# -- a toy: the count to the last run --------------------------------------------------------------------------------


@pytest.mark.parametrize(("number", "runs"), [(0.01, ["plain"]), (1.0, ["plain", "windy"])])
def test_a_solver_runs_only_where_its_effect_is_called_for(number: float, runs: list[str]) -> None:
    """Bounded below the threshold; above it the bound does not allow the verdict, and the dearer solver runs."""
    log = Log()
    bound = Interval(-5e3 * number, 5e3 * number)
    kind = kind_of(
        solver("plain", pull(8), seconds=1e-3, log=log),
        solver("windy", pull(9), carries=("wind",), seconds=1.0, log=log),
        effects=[effect("wind", number, bound)],
    )
    found = report(kind)
    assert log.names == runs
    assert effect_of(found, "wind").state is (EffectState.SKIPPED if number < 0.1 else EffectState.SIMULATED)
