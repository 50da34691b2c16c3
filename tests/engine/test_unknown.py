"""An open verdict on a load without a bound names who is to blame: effects left out, solvers out of range, notes."""

import pytest
import yaml
from support.decades import KINDS, Seeded
from support.zoo import checked

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.report import Judgement

BUDGET = 0.05


def open_ones(kind: str, seed: int) -> list[Judgement]:
    """Open verdicts of a machine over ten decades on loads that no run bounds."""
    report = checked(yaml.safe_dump(KINDS[kind](Seeded(seed)), sort_keys=False), budget=BUDGET).report
    judgements = [judgement for _, judgement in report.judgements if judgement.verdict is Verdict.UNDECIDED]
    return [one for one in judgements if one.value is None or not one.value.bounded]


def said(kind: str, seed: int, code: str) -> str:
    """The reason of a check, which is the same in every scene that has it open."""
    return next(one.reason for one in open_ones(kind, seed) if one.code == code)


def test_effects_without_a_bound_are_named_and_what_keeps_their_solvers_out() -> None:
    reason = said("conveyor", 5, "CNV102")
    assert "`belt_safety_min`: no error bound, `rigid` neglects `belt_wave`, `slip`" in reason
    assert "`characteristics` cannot be used: static resistance / drive force" in reason


def test_a_load_that_nobody_gives_names_who_might() -> None:
    reason = said("conveyor", 11, "CNV105")
    assert "`slack_margin_min`: not computed" in reason or "`slack_margin_min`: no error bound" in reason
    assert "cannot be used: " in reason


@pytest.mark.parametrize("seed", [5, 11])
def test_each_open_check_names_a_load_it_reads(seed: int) -> None:
    found = open_ones("conveyor", seed)
    assert found
    for one in found:
        assert any(f"`{load}`" in one.reason for load in one.loads), one.reason
        told = one.reason.split("; ")
        assert len(told) == len(set(told)), "what keeps a solver out is said once for all loads"
