"""Stopping distances of any point of a belt, and values that no conveyor has."""

from pathlib import Path
from typing import Any

import pytest
import yaml
from support.machines import changed, check_of, load_of, loaded, report_of, scene_of, template

from ptmcalc.base.diagnostic import Verdict

HERE = Path(__file__).parent


def data_of(name: str) -> dict[str, Any]:
    data = yaml.safe_load((HERE / f"{name}.yaml").read_text(encoding="utf-8"))
    assert isinstance(data, dict)
    return data


def test_the_tail_runs_on_until_the_wave_of_the_stop_arrives() -> None:
    """d'Alembert: nothing changes at the tail before L/c, so that it runs v L/c = 29 m at least. A lumped integration
    with Coulomb friction gave 28.9 m at 9.7 s, and 48 m in all beside the take-up; the head stops after 5.8 m."""
    line_mass = 20 + 16 / 3
    arrival = 3048 * (line_mass / (9000e3 * 1.2)) ** 0.5  # by the return strand, the faster one
    scene = scene_of(report_of(data_of("tail-way")))
    longest, head = (load_of(scene, name).estimate for name in ("stop_distance_max", "stop_distance"))
    assert longest.low > 3 * arrival
    assert longest.low > 29
    assert longest.value == pytest.approx(48, rel=0.15)
    assert head.high < 8
    assert check_of(scene, "CNV106").verdict is Verdict.FAIL


@pytest.mark.parametrize(
    ("path", "value"),
    [
        ("drive__drum__wrap", "190 rad"),
        ("belt__width", "800 m"),
        ("resistance__start_factor", 130),
        ("load__capacity", "400 kg/h"),
        ("idlers__carry__set_mass", "1200 kg"),
        ("speed", "250 m/s"),
    ],
)
def test_values_that_no_conveyor_has_are_warned_of_with_an_example(path: str, value: object) -> None:
    key = path.rpartition("__")[-1]
    named = [one for one in loaded(changed(template(), **{path: value})).diagnostics if one.path[-1:] == (key,)]
    assert any(f"`{key}: " in one.hint for one in named)


@pytest.mark.parametrize("name", ["wrap-rad", "absurd-idler"])
def test_machines_with_such_values_are_warned_of(name: str) -> None:
    assert "belt conveyors have" in " ".join(one.message for one in loaded(data_of(name)).diagnostics)


def test_real_conveyors_are_not_warned_of() -> None:
    assert loaded(template()).diagnostics == ()
