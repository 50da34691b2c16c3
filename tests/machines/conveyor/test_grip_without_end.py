"""A friction beyond all rubber is said to be so, and is computed with nevertheless."""

from decimal import Decimal

import pytest
from support.machines import changed, load_of, report_of, scene_of, template

RUN = changed(template(), scenes=[{"type": "run"}])


@pytest.mark.parametrize("friction", [1.01, 300.0, 1e5])
def test_a_friction_no_lagging_has_is_noticed_at_its_line(friction: float) -> None:
    report = report_of(changed(RUN, drive__drum__friction=friction))
    found = [d for d in report.diagnostics if d.path == ("drive", "drum", "friction")]
    assert [d.code for d in found] == ["SPC201"]
    assert found[0].span is not None
    assert "write `friction: 0.35`" in found[0].hint


def test_a_friction_of_good_lagging_is_not() -> None:
    assert not [d for d in report_of(changed(RUN, drive__drum__friction=0.8)).diagnostics if "friction" in d.path]


@pytest.mark.parametrize("friction", [1e-6, 0.35, 30.0, 300.0, 1e5])
def test_the_slack_side_needs_less_the_better_the_grip(friction: float) -> None:
    """S_off (exp(mu alpha) - 1) = k W; exp of 1e5 is beyond all numbers, and nothing is needed."""
    data = changed(RUN, drive__drum__friction=friction, drive__drum__wrap="3.5 rad")
    scene = scene_of(report_of(data))
    needed = load_of(scene, "slack_side_tension_required").estimate.value
    pull = load_of(scene, "static_resistance").estimate.value * 1.2
    exact = Decimal(pull) / ((Decimal(friction) * Decimal("3.5")).exp() - 1)
    assert needed == pytest.approx(float(exact), rel=1e-9, abs=1e-300)
