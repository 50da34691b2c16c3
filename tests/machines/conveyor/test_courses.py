"""Courses that a conveyor keeps of its tensions: they hold the extremes that are told of them, where these are."""

from collections.abc import Callable, Sequence
from functools import cache
from itertools import pairwise

import pytest
from support.command import ROOT

from ptmcalc.contract.report import LoadReport
from ptmcalc.engine.check import Options, check_file


@cache
def loads(scene: str) -> dict[str, LoadReport]:
    """The loads of a scene of the overland conveyor with their courses."""
    options = Options(histories=True, repairs=False, scenes=(scene,), effects={"takeup_mass": "off"})
    (found,) = check_file(ROOT / "specs" / "conveyor.yaml", options).scenes
    return {load.info.name: load for load in found.loads if load.history is not None}


@pytest.mark.parametrize("scene", ["run_loaded", "start_loaded", "start_empty"])
@pytest.mark.parametrize(("name", "pick"), [("tension_max", max), ("tension_min", min)])
def test_the_extreme_of_all_places_is_that_of_the_whole_belt(
    scene: str, name: str, pick: Callable[[Sequence[float]], float]
) -> None:
    """The extremes are found over every pair of waves, the course place by place on some of the nodes."""
    load = loads(scene)[name]
    assert load.history is not None
    places, values = load.history.times, load.history.values
    top = pick(values)
    assert top == pytest.approx(load.estimate.value, rel=3e-3)
    assert places[list(values).index(top)] == pytest.approx(load.at["position"], abs=2000 / 60)
    assert (places[0], places[-1]) == pytest.approx((0.0, 2000.0))
    assert all(after >= before for before, after in pairwise(places))


@pytest.mark.parametrize("scene", ["start_loaded", "start_empty"])
def test_over_the_places_and_over_time_it_is_one_motion(scene: str) -> None:
    """At the run-on the largest tension of the place is the largest of the time, at the run-off the smallest."""
    known = loads(scene)
    ends = [known["tension_max"].history, known["tension_run_on_max"].history]
    assert ends[0].values[-1] == pytest.approx(max(ends[1].values), rel=1e-3)
    lows = [known["tension_min"].history, known["tension_run_off_min"].history]
    assert lows[0].values[0] == pytest.approx(min(lows[1].values), rel=1e-3)
    tail = [index for index, place in enumerate(ends[0].times) if place == 1000.0]
    assert len(tail) == 2  # the end of one strand and the start of the other, where the tail's mass may part them


def test_before_the_first_wave_comes_a_place_rests() -> None:
    """Highest and lowest lie around the tension of the running belt at rest, which the first scene knows."""
    rest = loads("run_loaded")["tension_max"].history
    known = loads("start_loaded")
    for place, value in zip(rest.times, rest.values, strict=True):
        low, high = (
            next(v for at, v in zip(one.times, one.values, strict=True) if at == pytest.approx(place))
            for one in (known["tension_min"].history, known["tension_max"].history)
        )
        assert low * (1 - 1e-3) <= value <= high * (1 + 1e-3)


def test_the_grip_in_use_is_largest_when_it_is_told_to_be() -> None:
    load = loads("start_loaded")["slip_utilisation_max"]
    values, times = list(load.history.values), load.history.times
    assert max(values) == pytest.approx(load.estimate.value, rel=1e-4)
    assert times[values.index(max(values))] == pytest.approx(load.at["time"], abs=0.01)
