"""Words and numbers common to all text formats."""

import dataclasses
import math
from collections.abc import Iterable
from typing import Any

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import Span, dotted
from ptmcalc.base.units import TIME, Quantity, digits, display_unit, show, unit_of
from ptmcalc.base.words import shown
from ptmcalc.contract.check import Sense
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.report import AssumedReport, FileReport, Judgement, NextSolver, SceneReport

SIGN = {Sense.AT_LEAST: "≥", Sense.AT_MOST: "≤"}
"""Relation of a value to its limit."""

BALANCED = 1e-11
"""A balance of works that closes to less closes to rounding."""

_DIGITS, _MOST_DIGITS = 4, 10
"""Significant digits of a number, and the most that tell a value from its limit."""
_BARS = "▁▂▃▄▅▆▇█"


def printable(node: Any) -> Any:
    """Reports, or texts in lists and mappings, in which what a terminal would obey or not show is written as an escape.

    Names, keys and values of a file reach the report; an escape sequence or a line break among them must not go on to
    a terminal. JSON has its own escapes and needs none of this.
    """
    if isinstance(node, str):
        return shown(node)
    if isinstance(node, list | tuple):
        return type(node)(map(printable, node))
    if isinstance(node, dict):
        return {printable(key): printable(value) for key, value in node.items()}
    if dataclasses.is_dataclass(node) and not isinstance(node, type):
        parts = {field.name: getattr(node, field.name) for field in dataclasses.fields(node)}
        changed = {name: new for name, old in parts.items() if (new := printable(old)) != old}
        return dataclasses.replace(node, **changed) if changed else node
    return node


def amount(estimate: Estimate, quantity: Quantity, unit: str = "") -> str:
    """A number with its bar: `83.56 ±0.36 kN`, `134.2 [134.2, 268.5] kN`, `189.5 kN` when the bar is invisible.

    With `unit` given the number is in that unit, which is not written again.
    """
    value = estimate.value
    if math.isinf(value):
        return "unlimited" if value > 0 else "none"
    if math.isnan(value):
        return "unknown"
    chosen = unit or display_unit(value, quantity)
    factor = unit_of(chosen)[0]
    suffix = "" if unit or chosen == "1" else f" {chosen}"
    low, high, middle = estimate.low / factor, estimate.high / factor, value / factor
    if not (math.isfinite(low) and math.isfinite(high)):
        return f"{digits(middle)}{suffix} (no bound)"
    bar = max(high - middle, middle - low)
    if quantity.aside:
        other, share = quantity.aside
        suffix += f" ({digits(value * share)} {other})"
    if bar <= 5e-5 * abs(middle):
        return f"{digits(middle)}{suffix}"
    if min(high - middle, middle - low) < 0.75 * bar:
        if digits(low) == digits(middle) == digits(high):
            return f"{digits(middle)}{suffix}"
        return f"{digits(middle)} [{digits(low)}, {digits(high)}]{suffix}"
    places = max(1 - math.floor(math.log10(bar)), 0)
    rounded = round(middle, places) + 0.0  # of a zero without its sign
    return f"{rounded:.{places}f} ±{bar:.{places}f}{suffix}"


def value(judgement: Judgement) -> str:
    """The value of a check as it stands beside its limit: with more digits where both would read the same; empty
    without a value."""
    found, limit, quantity = judgement.value, judgement.limit, judgement.quantity
    if found is None:
        return ""
    text = amount(found, quantity)
    if limit is None or found.value == limit.value or text != amount(limit, quantity):
        return text
    for places in range(_DIGITS + 1, _MOST_DIGITS):
        if show(found.value, quantity, places) != show(limit.value, quantity, places):
            return show(found.value, quantity, places)
    return text


def common_unit(values: Iterable[float], quantity: Quantity) -> str:
    """The unit in which the largest of several values reads best."""
    return display_unit(max((abs(value) for value in values if math.isfinite(value)), default=0.0), quantity)


def number(value: float, quantity: Quantity) -> str:
    """A number without a bar."""
    return amount(Estimate.exact(value), quantity)


def margin(judgement: Judgement) -> str:
    """Distance from the limit: relative, or in the unit when the limit is 0."""
    if judgement.margin is None or judgement.limit is None:
        return ""
    if math.isinf(judgement.margin):
        return "unlimited" if judgement.margin > 0 else "none"
    if judgement.limit.value == 0:
        return f"{'+' if judgement.margin >= 0 else ''}{number(judgement.margin, judgement.quantity)}"
    return f"{100 * judgement.margin / abs(judgement.limit.value) + 0.0:+.1f} %"  # a limit just kept has no minus


def sparkline(course: tuple[float, ...]) -> str:
    """A curve one line high, from its least to its largest value."""
    if not course:
        return ""
    least, span = min(course), max(course) - min(course)
    return "".join(_BARS[min(int(len(_BARS) * (value - least) / span), len(_BARS) - 1)] for value in course)


def relative_margin(judgement: Judgement) -> float:
    """The margin as a share of the limit, or of the value where the limit is 0: what sorts verdicts."""
    if judgement.margin is None or judgement.limit is None or judgement.value is None:
        return -math.inf if judgement.verdict is Verdict.FAIL else math.inf
    scale = abs(judgement.limit.value) or abs(judgement.value.value) or 1.0
    return judgement.margin / scale


def subject(judgement: Judgement) -> str:
    """What a check is about, with the part of the machine it looked at."""
    return f"{judgement.title}: {judgement.element}" if judgement.element else judgement.title


def remark(judgement: Judgement) -> str:
    """What a verdict says besides its numbers: what it means or why, the value that would pass, what was left out."""
    parts = [judgement.meaning, judgement.reason]
    if judgement.repair:
        value = number(judgement.repair.value, judgement.repair.quantity)
        other = judgement.repair.other
        beyond = f" or {number(other, judgement.repair.quantity)}" if other is not None else ""
        parts.append(f"passes with {dotted(judgement.repair.path)} = {value}{beyond}")
    parts.append(judgement.tried)
    if judgement.without:
        parts.append(f"without {', '.join(judgement.without)}")
    return "; ".join(filter(None, parts))


def compared(number: Criterion) -> str:
    """The number that decided about an effect, beside its threshold: `E = 0.663 ≥ 0.05`."""
    relation = "≥" if number.exceeded else "<"
    value = digits(number.value, 3) if math.isfinite(number.value) else "unlimited"
    return f"{number.symbol} = {value} {relation} {digits(number.threshold, 3)}"


def priced(following: NextSolver) -> str:
    """The next solver of the ladder with its price."""
    return f"{following.name}, {show(following.predicted_seconds, TIME, 2)}"


def interval(value: AssumedReport) -> str:
    """What an assumed value may be."""
    low, high = (number(end, value.quantity) for end in (value.interval.low, value.interval.high))
    return f"{low} to {high}"


def balance(scene: SceneReport) -> float | None:
    """What the balance of works of a scene leaves over, relative; None where nothing moved that has one."""
    return scene.health.get("energy_residual")


def closing(residual: float) -> str:
    """How well the energy balances; mere rounding has no digits: they would be others on another processor."""
    return f"energy balance error {'at rounding level' if residual < BALANCED else f'{residual:.1e}'}"


def place(span: Span | None) -> str:
    """`line:column`, or nothing where there is none."""
    return f"{span.line}:{span.column}" if span else ""


def head(report: FileReport) -> list[tuple[str, str]]:
    """Project number, revision, author and checker of a file, with labels."""
    labels = {"number": "project", "checked_by": "checked by"}
    return [(labels.get(key, key), text) for key, text in report.project]


def worst_first(report: FileReport) -> list[tuple[str, Judgement]]:
    """(scene, judgement) of a file, the worst verdict first; of those that are no pass the hazards, then the smallest
    margin."""
    rows = [(scene.name, judgement) for scene, judgement in report.judgements]
    return sorted(rows, key=lambda row: _badness(row[1]))


def _badness(judgement: Judgement) -> tuple[float, ...]:
    mild = judgement.verdict is not Verdict.PASS and not judgement.hazard
    return judgement.verdict.rank, mild, relative_margin(judgement), judgement.margin or 0.0


def summary(totals: dict[str, int]) -> str:
    """One line that counts everything."""
    files = f"{totals['files']} file{'' if totals['files'] == 1 else 's'}"
    counted = [
        f"{totals[key]} {label}"
        for key, label in (
            ("invalid", "invalid"),
            ("fail", "failed"),
            ("undecided", "undecided"),
            ("not_checked", "not checked"),
            ("waived", "waived"),
            ("off", "switched off"),
            ("ignored", "ignored"),
        )
        if totals[key]
    ]
    passed = f"{totals['pass']} check{'' if totals['pass'] == 1 else 's'} passed"
    return ", ".join([files, passed, *counted])
