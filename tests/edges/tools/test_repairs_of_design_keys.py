"""A repair changes the machine: a key that only states a limit, a rating or a wait is never offered."""

import re

import pytest
from support.keys import TYPES, fields_of

from ptmcalc.contract.machine import AnyKind
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import load_text
from ptmcalc.spec.optional import Limit, declaration_of
from ptmcalc.spec.shape import keys_of, measure_of

_STATES = re.compile(r"(^|_)(rating|limit|wait|window|permitted|allowed|irregularity)(_|$)")
_DEVICES = {"torque_limit", "window_factor", "dynamic_load_rating"}
"""The limit that a converter keeps, what is asked of the computation, and the size of a bearing."""
_DUTIES = {"cycle_time", "braking_power", "belt_drift"}
"""Duties, and limits that are assumed where a file leaves them out."""


@pytest.mark.parametrize("kind", TYPES.values(), ids=TYPES)
def test_keys_that_state_a_requirement_are_declared_as_limits(kind: AnyKind) -> None:
    faulty = []
    for model, key in fields_of(kind):
        field = keys_of(model)[key]
        requires = _STATES.search(key) and key not in _DEVICES
        requires = requires or (model.__name__.endswith("Checks") and key not in _DUTIES)
        if requires and measure_of(field) is not None and not isinstance(declaration_of(field), Limit):
            faulty.append(f"{model.__name__}.{key}")
    assert faulty == []


def test_the_torque_that_a_link_may_carry_is_not_offered() -> None:
    text = TYPES["drivetrain"].template
    weak = text.replace("limit: 500 N*m", "limit: 50 N*m")
    assert weak != text
    report = check(load_text(weak.encode(), "x.yaml"), Options())
    failed = [one for scene in report.scenes for one in scene.checks if one.code == "DRV101"]
    assert [one.verdict.value for one in failed] == ["fail", "fail"]
    assert [one.repair for one in failed] == [None, None]
