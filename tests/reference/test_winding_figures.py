"""The six figures of the winding paper: the curves that one command writes, from the design files of its variants.

Figures of deflection and of stress over time, for four diameters of the rope and for four lifting heights, and their
largest values over either; every curve is integrated here by DOP853 from the equation of the paper.
"""

import csv
import math
from pathlib import Path

import numpy as np
import pytest
from support.command import ROOT, ptmcalc
from support.winding import general, paper_force

FOLDER = "specs/hoist/winding_paper"
AREAS = {"17_5": 114e-6, "16": 94.5e-6, "14_5": 77e-6, "13": 61e-6}
FREQUENCIES = {
    "height_40_rope_17_5": 5.47,
    "height_35_rope_17_5": 5.848,
    "height_30_rope_17_5": 6.317,
    "height_25_rope_17_5": 6.92,
    "height_40_rope_16": 4.981,
    "height_40_rope_14_5": 4.496,
    "height_40_rope_13": 4.002,
}
"""As printed [rad/s]."""
G, MASS, WIRE, SPEED, TURN = 9.81, 5000.0, 2.1e11, 2 * math.pi * 12 / 60, 5.0

Curves = dict[tuple[str, str], np.ndarray]


@pytest.fixture(scope="module")
def curves(tmp_path_factory: pytest.TempPathFactory) -> Curves:
    """What the command of the files' heads writes: (file, load) to rows of time and value."""
    path = tmp_path_factory.mktemp("figures") / "figures.csv"
    done = ptmcalc("check", ROOT / FOLDER, "--history", path)
    assert done.status == 0
    found: dict[tuple[str, str], list[tuple[float, float]]] = {}
    with path.open(encoding="utf-8") as file:
        for row in csv.DictReader(file):
            found.setdefault((Path(row["file"]).stem, row["load"]), []).append(
                (float(row["time"]), float(row["value"]))
            )
    return {key: np.array(rows).T for key, rows in found.items()}


@pytest.mark.parametrize("name", FREQUENCIES)
def test_a_curve_is_that_of_the_equation_of_the_paper(name: str, curves: Curves) -> None:
    _, height, _, rope = name.split("_", 3)
    length, diameter = 4 * float(height), float(rope.replace("_", ".")) * 1e-3
    k = math.sqrt(WIRE * AREAS[rope] / (MASS * length))
    assert k == pytest.approx(FREQUENCIES[name], rel=3e-4)
    times, deflection = curves[name, "winding_displacement_paper"]
    expected = general(k, paper_force(SPEED**2 * diameter, TURN), 2 * TURN, times, (TURN,))
    assert np.abs(deflection - expected).max() <= 1e-8 * expected.max()
    _, stress = curves[name, "winding_stress_paper"]
    assert stress == pytest.approx(WIRE * expected / length, rel=1e-7, abs=1e-7 * stress.max())


def test_the_higher_the_lift_the_more_it_stretches(curves: Curves) -> None:
    """What the figures show: the order of the curves."""
    largest = {name: curves[name, "winding_displacement_paper"][1].max() for name in FREQUENCIES}
    by_height = [largest[f"height_{h}_rope_17_5"] for h in (25, 30, 35, 40)]
    assert by_height == sorted(by_height)
    stress = [curves[f"height_40_rope_{d}", "winding_stress_paper"][1].max() for d in ("13", "14_5", "16", "17_5")]
    assert len(set(stress)) == 4


def test_every_variant_has_its_file() -> None:
    assert {path.stem for path in (ROOT / FOLDER).glob("*.yaml")} == set(FREQUENCIES)
