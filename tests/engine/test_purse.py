"""What a file may cost: not only each of its scenes, but all of them and what hangs on them."""

from dataclasses import replace
from typing import Any

import pytest
from support.toys import Log, kind_of, loaded, pull, solver

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.errors import NumericsError
from ptmcalc.contract.report import FileReport
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.purse import FILE_TIMES


def scenes(number: int) -> list[dict[str, str]]:
    return [{"type": "hang", "name": f"s{index}"} for index in range(number)]


def verdicts(found: FileReport) -> list[Verdict]:
    return [one.verdict for _, one in found.judgements]


def test_scenes_that_are_too_much_together_are_undecided_and_told() -> None:
    """Thirteen scenes of 50 s, each within its own 60 s: of 600 s twelve can be had."""
    log = Log()
    kind = kind_of(solver("fine", pull(9), seconds=50.0, log=log))
    found = check(loaded(kind, scenes=scenes(14)), Options(repairs=False))
    assert len(log.runs) == 12
    assert verdicts(found) == [Verdict.PASS] * 12 + [Verdict.UNDECIDED] * 2
    (said,) = [one for one in found.diagnostics if one.path == ("scenes",)]
    assert (said.code, said.span and said.span.line) == ("NUM103", 4)
    assert "more than 600 s, 10 budgets of a scene: `s12`, `s13` are not computed" in said.message
    assert said.hint == "check some alone, as with `--scene s12`, or give more, as with `--budget 120s`"
    alone = check(loaded(kind, scenes=scenes(14)), Options(("s12",), repairs=False))
    assert verdicts(alone) == [Verdict.PASS]
    more = check(loaded(kind, scenes=scenes(14)), Options(budget=120.0, repairs=False))
    assert verdicts(more) == [Verdict.PASS] * 14


@pytest.mark.parametrize("number", [1, 12])
def test_a_file_within_its_budget_says_nothing_of_it(number: int) -> None:
    kind = kind_of(solver("fine", pull(9), seconds=50.0))
    assert check(loaded(kind, scenes=scenes(number)), Options(repairs=False)).diagnostics == ()


def test_repairs_stop_where_the_file_has_nothing_left() -> None:
    """Every scene fails and looks for the load that would pass, some seconds each."""
    log = Log()
    kind = kind_of(solver("fine", pull(11), seconds=1.0, log=log))
    check(loaded(kind, scenes=scenes(40)), Options(budget=6.0))
    assert 40 < len(log.runs) <= FILE_TIMES * 6.0 + 1


@pytest.mark.parametrize(("spent", "runs"), [(10.0, 2), (59.5, 1), (5000.0, 1)])
def test_a_run_that_is_given_up_counts_with_what_it_came_to(spent: float, runs: int) -> None:
    log = Log()

    def gives_up(*given: Any) -> Any:
        log.runs.append(("rash", frozenset(), 0))
        raise NumericsError("NUM101", "given up", spent)

    rash = replace(solver("rash", pull(9), seconds=0.1), run=gives_up)
    kind = kind_of(rash, solver("fine", pull(9), seconds=1.0, log=log))
    found = check(loaded(kind), Options(repairs=False))
    assert len(log.runs) == runs
    assert [one.code for one in found.diagnostics] == ["NUM101"] + ["NUM103"] * (runs == 1)
    assert verdicts(found) == [Verdict.PASS if runs == 2 else Verdict.UNDECIDED]
