"""Output of sweeps and tolerances: a table for one screen, JSON, and CSV with a line for each point or check."""

import csv
import math
from collections.abc import Iterator, Sequence
from io import StringIO
from typing import Any

import numpy as np

from ptmcalc.base.units import SHARE, Quantity, digits, show
from ptmcalc.contract.study import Points, Risk, Said, Share, Track, Turning
from ptmcalc.report import json
from ptmcalc.report.table import listing

Row = dict[str, Any]

_NAMED = 2


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
    columns = ("check", "scene", "title", "pass", "fail", "open", "least margin", "there")
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
        text += "\nlimits of the verdicts\n"
        rows_of = [(f"{one.code} {one.element}".strip(), one.scene, one.key.name, _turn(one)) for one in found]
        text += listing(("check", "scene", "key", "verdicts"), rows_of, width=width)
    return text + "".join(f"note: {note}\n" for note in points.notes)


def _decided(track: Track) -> int:
    return track.count(Said.PASS) + track.count(Said.FAIL)


def at(points: Points, index: int) -> str:
    """The values of a point in words."""
    values = zip(points.keys, points.values[index], strict=True)
    return ", ".join(f"{key.name} {show(float(value), key.quantity)}" for key, value in values)


def _turn(one: Turning) -> str:
    """Of one line its stretches; of many where the verdict changes, and on how many of them."""
    if one.lines == 1:
        return _along(one)
    value = show(one.least, one.key.quantity)
    if show(one.most, one.key.quantity) != value:
        value += f" to {show(one.most, one.key.quantity)}"
    changing = len({stretch.line for stretch in one.stretches})
    simple = {stretch.said for stretch in one.stretches} == {Said.PASS, Said.FAIL}
    if simple and 0 in (one.above, one.below) and max(one.above, one.below) == changing:
        return f"passes {'from' if one.above else 'up to'} {value}   (on {changing} of {one.lines} lines)"
    states = sorted({stretch.said for stretch in one.stretches})
    named = ", ".join(said.word.replace("_", " ") for said in states)
    return f"{named}: changes at {value}   (on {changing} of {one.lines} lines; --format json has each)"


def _along(one: Turning) -> str:
    """The stretches of each verdict on one line: `passes 0.29 m/s to 0.44 m/s; fails 0.2 m/s to 0.29 m/s`."""
    first, *rest = one.stretches
    if len(rest) == 1 and {first.said, rest[0].said} == {Said.PASS, Said.FAIL}:
        passing, is_above = (first, False) if first.said is Said.PASS else (rest[0], True)
        end = passing.low if is_above else passing.high
        return f"passes {'from' if is_above else 'up to'} {show(end, one.key.quantity)}"
    parts = []
    for said, word in _VERDICTS.items():
        there = [stretch for stretch in one.stretches if stretch.said is said]
        ends = [[show(end, one.key.quantity) for end in (stretch.low, stretch.high)] for stretch in there]
        if ends:
            parts.append(f"{word} {', '.join(low if low == high else f'{low} to {high}' for low, high in ends)}")
    return "; ".join(parts)


_VERDICTS = {
    Said.PASS: "passes",
    Said.FAIL: "fails",
    Said.UNDECIDED: "undecided",
    Said.NOT_CHECKED: "not checked",
    Said.NOT_COMPUTED: "not computed",
}


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
        "intervals": [
            {
                "verdict": stretch.said.word,
                "low": stretch.low,
                "high": stretch.high,
                "line": stretch.line,
                "at": [
                    {"path": list(key.path), "value": value, "unit": key.quantity.si}
                    for key, value in zip(one.others, stretch.others, strict=True)
                ],
            }
            for stretch in one.stretches
        ],
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


# -- tolerances -----------------------------------------------------------------------------------------------------


def risk_table(name: str, points: Points, found: Sequence[Risk], confidence: float, seed: int, width: int) -> str:
    """What machines drawn at random say, on one screen."""
    sure = show(confidence, SHARE)
    text = f"{name}: {len(points)} machines, seed {seed}\n"
    for number, key in enumerate(points.keys):
        column = points.values[:, number]
        low, middle, high = (show(float(np.quantile(column, q)), key.quantity) for q in (0.025, 0.5, 0.975))
        text += f"  {name}:{key.span.line}  {key.name}: {middle} mean, 95 % from {low} to {high}\n"
    columns = ("check", "scene", "title", "fails", "open", f"margin of {sure}", "driven by")
    rows = [
        (
            part_of(one.track),
            one.track.scene,
            one.track.title,
            _shares(one),
            f"{one.undecided.hits} of {one.size}" if one.undecided.hits or one.size < len(points) else "",
            _margin(one),
            ", ".join([f"{d.key.name} {d.correlation:+.2f}" for d in one.drivers if d.clear][:_NAMED]),
        )
        for one in found
    ]
    text += listing(columns, rows, width=width)
    text += f"in brackets: confidence interval (at {sure}); after a key: its rank correlation with the margin\n"
    return text + "".join(f"note: {note}\n" for note in points.notes)


def _shares(one: Risk) -> str:
    """How often a check fails, and where the probability lies: up to where the undecided machines would all fail."""
    if not one.size:
        return ""
    ends = f"{_percent(one.fails.low)} to {_percent(one.fails_or_undecided.high)}"
    return f"{_percent(one.fails.value)} % ({ends})"


def _percent(share: float) -> str:
    return digits(100 * share, 3)


def _margin(one: Risk) -> str:
    if math.isnan(one.margin):
        return ""
    ends = (present(end, one.track.quantity) for end in (one.margin_low, one.margin_high))
    return f"{present(one.margin, one.track.quantity)} ({' to '.join(ends)})"


def risk_rows(found: Sequence[Risk]) -> list[Row]:
    """A row for each check."""
    return [
        {
            "scene": one.track.scene,
            "code": one.track.code,
            "element": one.track.element,
            "title": one.track.title,
            "samples": one.size,
            "fail": _share_row(one.fails),
            "undecided": _share_row(one.undecided),
            "fail_or_undecided": _share_row(one.fails_or_undecided),
            "margin": {
                "value": json.finite(one.margin),
                "low": json.finite(one.margin_low),
                "high": json.finite(one.margin_high),
                "unit": one.track.quantity.si,
            },
            "drivers": [
                {"path": list(d.key.path), "rank_correlation": d.correlation, "noise": d.noise, "clear": d.clear}
                for d in one.drivers
            ],
        }
        for one in found
    ]


def _share_row(share: Share) -> Row:
    return {"hits": share.hits, "value": json.finite(share.value), "low": share.low, "high": share.high}


def risk_json(points: Points, found: Sequence[Risk], confidence: float, seed: int) -> str:
    """The document."""
    about = {"samples": len(points), "seed": seed, "confidence": confidence, "keys": keys_of(points)}
    return json.dump({"schema_version": json.SCHEMA_VERSION, **about, "notes": points.notes, "rows": risk_rows(found)})


def risk_csv(found: Sequence[Risk]) -> str:
    """A line for each check; SI units."""
    heads = (
        *("scene", "code", "part", "samples", "fails", "fail", "fail_low", "fail_high", "undecided"),
        *("fail_or_undecided_high", "margin", "margin_low", "margin_high", "unit", "driver", "rank_correlation"),
    )
    rows: list[Sequence[Any]] = [heads]
    for one in found:
        first = next(iter(one.drivers), None)
        rows.append(
            (
                *(one.track.scene, one.track.code, one.track.element, one.size, one.fails.hits),
                *map(json.finite, (one.fails.value, one.fails.low, one.fails.high)),
                *(one.undecided.hits, one.fails_or_undecided.high),
                *map(json.finite, (one.margin, one.margin_low, one.margin_high)),
                one.track.quantity.si,
                *((first.key.name, first.correlation) if first else ("", None)),
            )
        )
    return _csv(rows)
