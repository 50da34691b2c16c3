"""How what changed between two states of design files is told: a table, a comment that reads like a review, JSON."""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from rich.console import Console
from rich.text import Text

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import dotted
from ptmcalc.base.units import Quantity, digits
from ptmcalc.report import json, words
from ptmcalc.report.compare import CheckChange, Entry, FileChange, KeyChange, LoadChange, Move, Number, Turn
from ptmcalc.report.drawing import STYLE, fill, new_table, printed, put, tell
from ptmcalc.report.markdown import code, escape

_QUANTITIES: Mapping[tuple[str, str], Quantity] = {
    (one.si, ""): one
    for one in (
        *(units.FORCE, units.TORQUE, units.TIME, units.ENERGY, units.POWER, units.STRESS, units.STIFFNESS),
        *(units.MASS, units.LENGTH, units.ANGLE, units.FLOW, units.IMPULSE, units.TORSIONAL_STIFFNESS),
    )
} | {(units.ANGULAR_SPEED.si, unit): units.ANGULAR_SPEED for unit in units.ANGULAR_SPEED.display}
"""How numbers are shown, by their unit and the one they are read in; those of others in SI units."""
_SIGNS = {
    "pass": "✅",
    "fail": "❌",
    "undecided": "❓",
    "not_checked": "❓",
    "waived": "➖",
    "off": "➖",
    "invalid": "❌",
}
_NOW = {
    "pass": "passes now",
    "fail": "fails now",
    "undecided": "is undecided now",
    "not_checked": "is not checked now",
    "waived": "is waived now",
    "off": "is switched off now",
}
_WAS = {
    "pass": "it passed",
    "fail": "it failed",
    "undecided": "it was undecided",
    "not_checked": "it was not checked",
    "waived": "it was waived",
    "off": "it was switched off",
}
_FAR = 100.0
"""Times both bars from which nobody wants to know how many."""
_MOST_KEYS = 20
_MOST_LOADS = 20
_MOST_FILES = 50
"""What a comment shows of each, of keys the table too; the rest is counted. JSON has everything."""


# -- words ----------------------------------------------------------------------------------------------------------


def summary(changes: Sequence[FileChange]) -> str:
    """One sentence."""
    changed = [one for one in changes if one.changed]
    if not changed:
        return f"Nothing changed in {_counted(len(changes), 'file')}."
    checks = [check for one in changed for check in one.checks]
    loads = [load for one in changed for load in one.told_loads]
    files = [one.turn for one in changed]
    counts = (
        (sum(check.turn is Turn.WORSE for check in checks), "check", "worse"),
        (sum(check.turn is Turn.BETTER for check in checks), "check", "better"),
        (sum(check.turn is Turn.SAME for check in checks), "margin", "moved"),
        (sum(load.move is Move.CLEAR for load in loads), "load", "changed beyond the error bars"),
        (sum(load.move is Move.WITHIN for load in loads), "load", "changed within them"),
        (sum(one.new == "invalid" != one.old for one in changed), "file", "invalid"),
        (files.count(Turn.NEW), "file", "new"),
        (files.count(Turn.GONE), "file", "gone"),
    )
    told = [f"{_counted(number, what)} {how}" for number, what, how in counts if number]
    where = f"in {len(changed)} of {_counted(len(changes), 'file')}"
    return f"{', '.join(told) or 'No verdict and no load changed'} {where}."


def _counted(number: int, what: str) -> str:
    return f"{number} {what}{'' if number == 1 else 's'}"


def _amount(number: Number, unit: str, shown_in: str = "") -> str:
    if number.value is None:
        return "unlimited"
    low = number.low if number.low is not None else float("-inf")
    high = number.high if number.high is not None else float("inf")
    return words.amount(Estimate(number.value, low, high), _quantity(unit, shown_in))


def _quantity(unit: str, shown_in: str = "") -> Quantity:
    return _QUANTITIES.get((unit, shown_in)) or Quantity(unit, unit, (unit,), "")


def _exact(check: Entry, value: float) -> str:
    """A number in the unit of a check, without a bar."""
    return _amount(Number(value, value, value), check["unit"], check.get("shown_in", ""))


def _value(check: Entry) -> str:
    if check["value"] is None and not check.get("unbounded"):
        return "no value"
    return _amount(Number(check["value"], check["low"], check["high"]), check["unit"], check.get("shown_in", ""))


def _limit(check: Entry) -> str:
    if check["limit"] is None:
        return ""
    relation = {"at_least": "≥", "at_most": "≤"}.get(check["sense"], check["sense"])
    return f"{relation} {_exact(check, check['limit'])}"


def _margin(check: Entry) -> str:
    margin, limit = check["margin"], check["limit"]
    if margin is None:
        return ""
    if not limit:
        return _exact(check, margin)
    return f"{100 * margin / abs(limit) + 0.0:+.1f} %"


def _subject(check: Entry) -> str:
    element = check.get("element", "")
    return f"{check['code']} {check['title']}{f': {element}' if element else ''}"


def _load_cells(load: LoadChange) -> tuple[str, ...]:
    numbers = (_amount(one, load.unit, load.shown_in) for one in (load.old, load.new))
    return load.name, load.scene, *numbers, _share(load), _bars(load)


def _share(load: LoadChange) -> str:
    return "" if load.relative is None else f"{100 * load.relative + 0.0:+.3g} %"


def _bars(load: LoadChange) -> str:
    if load.move is Move.BAR:
        return "the same value"
    against = load.against
    if load.move is Move.WITHIN:
        return "within them" if against is None else f"within them ({digits(against, 2)} of both)"
    if against is None:
        return "beyond them"
    return "far beyond them" if against > _FAR else f"beyond them ({digits(against, 2)} times both)"


def _key(change: KeyChange) -> str:
    where = f" (line {change.line})" if change.line else ""
    if change.old is None:
        return f"{change.path} is new: {change.new}{where}"
    if change.new is None:
        return f"{change.path} is gone, it was {change.old}"
    return f"{change.path} {change.old} → {change.new}{where}"


def _keys(change: FileChange) -> list[str]:
    """The keys that changed, as far as somebody would read them."""
    more = len(change.keys) - _MOST_KEYS
    return [_key(key) for key in change.keys[:_MOST_KEYS]] + [f"{_counted(more, 'more key')}"] * (more > 0)


# -- table ----------------------------------------------------------------------------------------------------------


def table(changes: Sequence[FileChange], *, width: int, color: bool) -> str:
    """What changed, file by file, the worst first, and the summary."""

    def write(console: Console) -> None:
        for change in (words.printable(one) for one in changes if one.changed):
            _draw(console, change)
        console.print(summary(changes))

    return printed(write, width, color)


def _draw(console: Console, change: FileChange) -> None:
    title = Text(change.path, style="bold")
    states = [one.upper() for one in (change.old, change.new)]
    title.append("  " + (states[1] if states[0] == states[1] else f"{states[0] or 'NEW'} → {states[1] or 'GONE'}"))
    console.print(title)
    for key in _keys(change):
        console.print(Text(f" {key}"))
    for turn, said in change.said:
        tell(console, Text(f" {turn.value}: {said['severity']} {said['code']} {said['message']}"))
    console.print()
    if change.checks:
        headings = ("verdict", "check", "scene", "before", "after", "limit", "margin before", "after")
        drawn = new_table("Checks", *headings)
        rows, styles = [], []
        for one in change.checks:
            old, new = one.old, one.new
            verdict = " → ".join(dict.fromkeys(each["verdict"] for each in (old, new) if each is not None))
            cells = [_subject(one.either), one.scene, *(_value(each) if each else "" for each in (old, new))]
            cells += [_limit(one.either), *(_margin(each) if each else "" for each in (old, new))]
            rows.append([verdict, *cells])
            styles.append(STYLE[one.either["verdict"]])
        put(console, fill(drawn, rows, console.width, styles))
    if change.told_loads:
        drawn = new_table("Loads", "load", "scene", "before", "after", "change", "against the error bars")
        put(console, fill(drawn, [list(_load_cells(load)) for load in change.told_loads], console.width))


# -- Markdown -------------------------------------------------------------------------------------------------------


def markdown(changes: Sequence[FileChange]) -> str:
    """A comment on a pull request: what got worse first, with what was written, its numbers, and what would mend it."""
    blocks = ["## ptmcalc diff", f"**{escape(summary(changes))}**"]
    changed = [words.printable(one) for one in changes if one.changed]
    order = [Turn.WORSE, Turn.NEW, Turn.GONE, Turn.BETTER, Turn.SAME]
    changed.sort(key=lambda one: (not one.turned(Turn.WORSE), order.index(one.turn)))
    for change in changed[:_MOST_FILES]:
        blocks += _review(change)
    if len(changed) > _MOST_FILES:
        blocks.append(f"{len(changed) - _MOST_FILES} more files changed; `ptmcalc diff` prints them all.")
    return "\n\n".join(blocks) + "\n"


def _review(change: FileChange) -> Iterator[str]:
    sign = _SIGNS.get(change.new, "")
    yield f"### {sign} {escape(change.path)}".replace("  ", " ")
    if not change.old or not change.new:
        what = f"This file is new; its verdict: {change.new}" if change.new else "This file is gone"
        yield f"{what}."
        return
    if change.keys:
        yield f"Changed: {'; '.join(map(escape, _keys(change)))}."
    said = [f"- {_told(turn, one)}" for turn, one in change.said if one["severity"] != "note"]
    broken = change.new == "invalid"
    if said and broken:
        yield "\n".join(said)
    turned = [f"- {_judged(one)}" for one in change.checks if one.turn is not Turn.SAME and one.new]
    turned += _gone([one for one in change.checks if one.new is None])
    if turned:
        yield "\n".join(turned)
    if said and not broken:
        yield "\n".join(said)
    moved = change.turned(Turn.SAME)
    if moved:
        rows = [
            (_subject(one.either), one.scene, _margin(one.old or {}), _margin(one.new or {}), one.either["verdict"])
            for one in moved
        ]
        yield _markdown_table("Changed margins", ("Check", "Scene", "Before", "After", "Verdict"), rows)
    clear = [load for load in change.told_loads if load.move is Move.CLEAR]
    if clear:
        heads = ("Load", "Scene", "Before", "After", "Change", "Against the error bars")
        loads = [_load_cells(load) for load in clear[:_MOST_LOADS]]
        yield _markdown_table("Loads changed beyond their error bars", heads, loads)
    rest = len(change.told_loads) - len(clear)
    more = max(len(clear) - _MOST_LOADS, 0)
    told = [f"{_counted(more, 'more load')} changed so"] * bool(more)
    told += [f"{_counted(rest, 'load')} changed within the error bars, possibly without a real change"] * bool(rest)
    if told:
        yield f"{'; '.join(told)}."


def _markdown_table(title: str, heads: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    lines = [f"| {' | '.join(heads)} |", f"|{'---|' * len(heads)}"]
    lines += [f"| {' | '.join(map(escape, row))} |" for row in rows]
    return "\n".join([f"<details><summary>{title}</summary>", "", *lines, "", "</details>"])


def _told(turn: Turn, said: Entry) -> str:
    """A finding of the file itself."""
    where = f", line {said['line']}" if said["line"] else ""
    how = "new" if turn is Turn.NEW else "no longer reported"
    return f"{how}: **{said['severity']}** {escape(said['code'])}{where}: {escape(said['message'])}"


def _gone(changes: Sequence[CheckChange]) -> Iterator[str]:
    """Checks that are no longer made: those that did not pass one by one, the others together."""
    for one in changes:
        if one.either["verdict"] != "pass":
            name = f"**{escape(_subject(one.either))}** ({escape(one.scene)})"
            yield f"- {name} is gone; before, {_WAS[one.either['verdict']]}."
    passed = [one.either["code"] for one in changes if one.either["verdict"] == "pass"]
    if passed:
        codes = ", ".join(
            f"{code}{f' ({times} times)' if times > 1 else ''}" for code, times in sorted(Counter(passed).items())
        )
        yield f"- {_counted(len(passed), 'check')} that passed {'is' if len(passed) == 1 else 'are'} gone: {codes}."


def _judged(change: CheckChange) -> str:
    """What a reviewer says of a verdict that changed."""
    old, new, either = change.old, change.new, change.either
    name = f"**{escape(_subject(either))}** ({escape(change.scene)})"
    assert new is not None
    sign = _SIGNS[new["verdict"]]
    if old is None:
        return f"{sign} {name} is new and {_NOW[new['verdict']]}: {escape(_numbers(new))}."
    before = f"before, {_WAS[old['verdict']]} at {_value(old)}"
    if old["limit"] != new["limit"]:
        before += f", limit {_limit(old)}"
    blame, repair = new["blame"], new.get("repair")
    parts = [f"{sign} {name} {_NOW[new['verdict']]}: {escape(f'{_numbers(new)}; {before}')}."]
    if change.turn is Turn.WORSE:
        parts.append(f"{code(dotted(tuple(blame['path'])))} (line {blame['line']}) governs it.")
    if repair:
        parts.append(
            f"It passes with {code(dotted(tuple(repair['path'])))} = {escape(_exact(repair, repair['value']))}."
        )
    if new.get("reason"):
        parts.append(f"{escape(new['reason'])}.")
    return " ".join(parts)


def _numbers(check: Entry) -> str:
    limit = _limit(check)
    return f"{_value(check)}, limit {limit}" if limit else _value(check)


# -- JSON -----------------------------------------------------------------------------------------------------------


def document(changes: Sequence[FileChange]) -> str:
    """A row for each change of a file, a key, a finding, a check and a load."""
    return json.rows([row for change in changes if change.changed for row in _rows(change)])


def _rows(change: FileChange) -> Iterator[dict[str, Any]]:
    file = {"file": change.path}
    yield file | {"what": "file", "change": change.turn.value, "old": change.old or None, "new": change.new or None}
    for key in change.keys:
        yield file | {"what": "key", "key": key.path, "old": key.old, "new": key.new, "line": key.line}
    for turn, said in change.said:
        yield (
            file | {"what": "finding", "change": turn.value} | {key: said[key] for key in ("code", "severity", "path")}
        )
    for check in change.checks:
        either = check.either
        about = {"scene": check.scene, "code": either["code"], "title": either["title"]}
        yield (
            file
            | {"what": "check", "change": check.turn.value}
            | about
            | {
                "element": either.get("element", ""),
                "old": _picked(check.old),
                "new": _picked(check.new),
            }
        )
    for load in change.loads:
        yield (
            file
            | {"what": "load", "change": load.move.value, "scene": load.scene, "name": load.name}
            | {
                "unit": load.unit,
                "old": _listed(load.old),
                "new": _listed(load.new),
                "relative": json.finite(load.relative),
                "over_bars": json.finite(load.against),
            }
        )


def _picked(check: Entry | None) -> dict[str, Any] | None:
    names = ("verdict", "value", "low", "high", "limit", "margin", "unit", "blame", "repair")
    return {name: check[name] for name in names if name in check} if check is not None else None


def _listed(number: Number) -> dict[str, float | None]:
    return {"value": number.value, "low": number.low, "high": number.high}
