"""Loads over time as CSV: one line a moment, every digit, and back."""

import csv
from dataclasses import replace
from io import StringIO

import pytest
from support.samples import SAMPLES

from ptmcalc.report import histories

HEAD = "file,scene,load,unit,time,value,over"


def test_every_moment_of_every_history_is_a_line() -> None:
    assert histories.render([SAMPLES["moving"]]).splitlines() == [
        HEAD,
        "toy.yaml,gust,pull[hook],N,0.0,0.0,time",
        "toy.yaml,gust,pull[hook],N,0.5,8000.0,time",
        f"toy.yaml,gust,pull[hook],N,1.0,{1 / 3!r},time",
        "toy.yaml,calm,pull[hook],N,0.0,0.0,time",
        "toy.yaml,calm,pull[hook],N,0.5,8000.0,time",
        f"toy.yaml,calm,pull[hook],N,1.0,{1 / 3!r},time",
    ]


@pytest.mark.parametrize("names", [(), ("passing",), ("invalid", "unreadable")])
def test_where_nothing_moves_there_is_the_heading_alone(names: tuple[str, ...]) -> None:
    assert histories.render([SAMPLES[name] for name in names]) == HEAD + "\n"


def test_files_stand_in_their_order() -> None:
    one, other = (replace(SAMPLES["moving"], path=path) for path in ("b.yaml", "a.yaml"))
    found = [row["file"] for row in csv.DictReader(StringIO(histories.render([one, other])))]
    assert found == ["b.yaml"] * 6 + ["a.yaml"] * 6


def test_a_name_with_commas_and_quotes_is_read_back() -> None:
    odd = replace(SAMPLES["moving"].scenes[0], name='to, "fro"\nand back')
    text = histories.render([replace(SAMPLES["moving"], scenes=(odd,))])
    rows = list(csv.DictReader(StringIO(text)))
    assert {row["scene"] for row in rows} == {odd.name}
    assert [(float(row["time"]), float(row["value"])) for row in rows] == [(0.0, 0.0), (0.5, 8000.0), (1.0, 1 / 3)]
