"""Shafts, drive trains and chain drives over ten decades in every size: numbers in intervals that agree, or a word.

The same is asserted as of the machines of the zoo: no number that is none, no verdict that no number bears, energy
that closes, work below a cap, and no two runs without a common value. Warnings are errors.
"""

from typing import Any

import pytest
import yaml
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st
from support.any_drive import any_chain, any_shaft, any_train
from support.zoo import wrong_anyway

BUDGET, TRIED = 0.3, 0.05
"""Predicted seconds of a scene, and of one run that is held against the others."""
EVALUATIONS = 10_000_000
FEW = settings(
    max_examples=8,
    derandomize=True,
    deadline=None,
    database=None,
    suppress_health_check=list(HealthCheck),
    phases=[Phase.generate],
)
MANY = settings(FEW, max_examples=1500)


def is_sound(data: dict[str, Any]) -> None:
    text = yaml.safe_dump(data, sort_keys=False)
    assert wrong_anyway(text, budget=BUDGET, tried=TRIED, evaluations=EVALUATIONS) == [], text


@FEW
@given(any_train())
def test_any_drive_train(data: dict[str, Any]) -> None:
    is_sound(data)


@FEW
@given(any_shaft())
def test_any_main_shaft(data: dict[str, Any]) -> None:
    is_sound(data)


@FEW
@given(any_chain())
def test_any_chain_drive(data: dict[str, Any]) -> None:
    is_sound(data)


@pytest.mark.study
@MANY
@given(st.one_of(any_train(), any_shaft(), any_chain()))
def test_any_of_many(data: dict[str, Any]) -> None:
    is_sound(data)
