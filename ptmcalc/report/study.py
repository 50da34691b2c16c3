"""How a sweep is told: a table of what its checks say and where they turn, JSON, and a line for each point in CSV."""

import csv
import math
from collections.abc import Iterator, Sequence
from io import StringIO
from typing import Any

from ptmcalc.base.units import Quantity, show
from ptmcalc.contract.study import Points, Said, Track, Turning
from ptmcalc.report import json
from ptmcalc.report.table import listing

Row = dict[str, Any]


def part_of(track: Track) -> str:
    """A check with the part of the machine it is about."""
    return f"{track.code} {track.element}".strip()


def present(value: float, quantity: Quantity) -> str:
    """A number as a reader wants it; nothing where there is none."""
    if math.isnan(value):
        return ""
    return show(value, quantity) if math.isfinite(value) else "unlimited" if value > 0 else "-unlimited"


def keys_of(points: Points) -> list[Row]:
    """The keys that vary, and where they stand."""
    return [
        {
            "path": list(key.path),
            "unit": key.quantity.si,
            "present": key.present,
            "line": key.span.line,
            "column": key.span.column,
        }
        for key in points.keys
    ]


# -- sweeps ---------------------------------------------------------------------------------------------------------


def sweep_table(
    name: str, points: Points, least: Sequence[tuple[Track, int]], found: Sequence[Turning], width: int
) -> str:
    """What a sweep says on one screen."""
    text = f"{name}: {len(points)} points\n"
    for number, key in enumerate(points.keys):
        column = points.values[:, number]
        ends = " to ".join(show(float(end), key.quantity) for end in (column.min(), column.max()))
        now = f", now {show(key.present, key.quantity)}" if key.present is not None else ""
        text += f"  {name}:{key.span.line}  {key.name}: {ends}{now}\n"
    columns = ("check", "scene", "is there ...?", "pass", "fail", "open", "least margin", "there")
    rows = [
        (
            part_of(track),
            track.scene,
            track.title,
            *map(str, (track.count(Said.PASS), track.count(Said.FAIL), len(points) - _decided(track))),
            present(float(track.margin[index]), track.quantity) if index >= 0 else "",
            at(points, index) if index >= 0 else "",
        )
        for track, index in least
    ]
    text += listing(columns, rows, width=width)
    if found:
        text += "\nwhere they turn\n"
        rows_of = [(f"{one.code} {one.element}".strip(), one.scene, one.key.name, _turn(one)) for one in found]
        text += listing(("check", "scene", "key", "passes"), rows_of, width=width)
    return text + "".join(f"note: {note}\n" for note in points.notes)


def _decided(track: Track) -> int:
    return track.count(Said.PASS) + track.count(Said.FAIL)


def at(points: Points, index: int) -> str:
    """The values of a point in words."""
    values = zip(points.keys, points.values[index], strict=True)
    return ", ".join(f"{key.name} {show(float(value), key.quantity)}" for key, value in values)


def _turn(one: Turning) -> str:
    value = show(one.least, one.key.quantity)
    if show(one.most, one.key.quantity) != value:
        value += f" to {show(one.most, one.key.quantity)}"
    side = "above and below" if one.above and one.below else "from" if one.above else "up to"
    lines = f"   (on {max(one.above, one.below)} of {one.lines} lines)" if one.lines > 1 else ""
    return f"{side} {value}{lines}"


def sweep_json(points: Points, found: Sequence[Turning]) -> Iterator[str]:
    """The document bit by bit: a line for each point."""
    yield '{"schema_version": ' + json.line(json.SCHEMA_VERSION) + ",\n"
    yield f' "keys": {json.line(keys_of(points))},\n "turnings": {json.line([_turning(one) for one in found])},\n'
    yield f' "notes": {json.line(points.notes)},\n "rows": ['
    worst = points.worst()
    for index in range(len(points)):
        yield ("," if index else "") + "\n  " + json.line(_point(points, index, Said(worst[index])))
    yield "]}\n"


def _turning(one: Turning) -> Row:
    return {
        "scene": one.scene,
        "code": one.code,
        "element": one.element,
        "path": list(one.key.path),
        "least": one.least,
        "most": one.most,
        "unit": one.key.quantity.si,
        "passes_above": one.above,
        "passes_below": one.below,
        "lines": one.lines,
    }


def _point(points: Points, index: int, verdict: Said) -> Row:
    numbers = zip(points.keys, points.values[index], strict=True)
    return {
        "point": index,
        "values": [{"path": list(key.path), "value": float(value), "unit": key.quantity.si} for key, value in numbers],
        "verdict": verdict.word,
        "checks": [
            {
                "scene": track.scene,
                "code": track.code,
                "element": track.element,
                "verdict": Said(track.said[index]).word,
                "value": json.finite(track.value[index]),
                "limit": json.finite(track.limit[index]),
                "margin": json.finite(track.margin[index]),
                "unit": track.quantity.si,
            }
            for track in points.tracks.values()
        ],
        "loads": [
            {
                "scene": load.scene,
                "name": load.info.name,
                "value": json.finite(load.value[index]),
                "low": json.finite(load.low[index]),
                "high": json.finite(load.high[index]),
                "unit": load.info.quantity.si,
            }
            for load in points.loads.values()
        ],
    }


def sweep_csv(points: Points) -> Iterator[str]:
    """A line for each point: the keys, the verdict, of each check verdict and margin, the governing loads; SI units."""
    tracks, loads = list(points.tracks.values()), list(points.loads.values())
    heads = ["point", *(_head(key.name, key.quantity) for key in points.keys), "verdict"]
    for track in tracks:
        name = f"{track.scene} {part_of(track)}"
        heads += [name, _head(f"{name} margin", track.quantity)]
    heads += [_head(f"{load.scene} {load.info.name}", load.info.quantity) for load in loads]
    yield _csv([heads])
    worst = points.worst()
    margins = [track.margin for track in tracks]
    for index in range(len(points)):
        cells: list[Any] = [index, *map(float, points.values[index]), Said(worst[index]).word]
        for track, margin in zip(tracks, margins, strict=True):
            cells += [Said(track.said[index]).word, json.finite(margin[index])]
        yield _csv([[*cells, *(json.finite(load.value[index]) for load in loads)]])


def _head(name: str, quantity: Quantity) -> str:
    return f"{name} [{quantity.si}]"


def _csv(rows: Sequence[Sequence[Any]]) -> str:
    out = StringIO()
    csv.writer(out, lineterminator="\n").writerows(rows)
    return out.getvalue()
