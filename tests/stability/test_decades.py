"""Machines over ten decades in every parameter: a report with numbers in intervals, or a clear word.

Hypothesis draws conveyors, hoists and cranes (`support.decades`); what `support.zoo` holds never right is asserted of
each: a traceback or a warning, a number that is none or lies outside its interval, a verdict that no number bears.
A cheap budget keeps runs of years out: what is too dear says so.
"""

from collections.abc import Callable
from typing import Any

import pytest
import yaml
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st
from support.decades import KINDS, Drawn, Seeded
from support.zoo import checked, contradictions, faulty, never_right

CHEAP = 0.05
EXAMPLES = {"conveyor": 12, "hoist": 4, "slewing": 20, "travelling": 12, "overhead_stacker": 12, "rack_stacker": 12}


def is_never_right(data: dict[str, Any]) -> list[str]:
    """Everything that is wrong with a machine whatever it is."""
    found = checked(yaml.safe_dump(data, sort_keys=False), budget=CHEAP)
    wrong = never_right(found.report)
    for _, _, settled in found.settled:
        wrong += [one for run in settled.runs for one in faulty(run)]
        wrong += contradictions(settled.runs)
    return wrong


def any_machine(build: Callable[..., dict[str, Any]]) -> st.SearchStrategy[dict[str, Any]]:
    """Machines of a kind."""
    return st.composite(lambda draw: build(Drawn(draw)))()


@pytest.mark.parametrize("kind", KINDS)
def test_any_machine_ends_in_numbers_or_a_word(kind: str) -> None:
    @settings(
        max_examples=EXAMPLES[kind],
        derandomize=True,
        deadline=None,
        database=None,
        suppress_health_check=list(HealthCheck),
        phases=[Phase.generate, Phase.shrink],
    )
    @given(any_machine(KINDS[kind]))
    def holds(data: dict[str, Any]) -> None:
        assert is_never_right(data) == []

    holds()


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", range(3))
def test_machines_of_a_third_of_a_decade_are_sound_files(kind: str, seed: int) -> None:
    """The strategies draw machines, not files that are refused: near a designer's numbers most are read."""
    found = checked(yaml.safe_dump(KINDS[kind](Seeded(7, seed), 0.3)), budget=CHEAP)
    assert found.report.valid, [d.message for d in found.report.diagnostics]


@pytest.mark.study
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", range(200))
def test_many_machines_end_in_numbers_or_a_word(kind: str, seed: int) -> None:
    assert is_never_right(KINDS[kind](Seeded(seed))) == []
