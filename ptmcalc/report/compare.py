"""Changes between two JSON documents of `check`: files, verdicts, loads relative to their error bars, findings."""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from pathlib import PurePosixPath
from typing import Any

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.span import dotted
from ptmcalc.contract.result import family

Entry = Mapping[str, Any]
"""A part of a document."""
_ROUNDING = 1e-9
"""A smaller relative change is rounding."""
_WORST = [*(verdict.value for verdict in Verdict if verdict is not Verdict.PASS), Verdict.PASS.value]
_FILES = ["invalid", "fail", "undecided", "pass"]


class Turn(StrEnum):
    """Where a verdict went."""

    WORSE = "worse"
    BETTER = "better"
    NEW = "new"
    GONE = "gone"
    SAME = "same"


class Move(StrEnum):
    """Significance of a change, by the error bars."""

    CLEAR = "clear"
    """the intervals do not overlap: a real change"""
    WITHIN = "within_bars"
    """they overlap: the change may be numerical"""
    BAR = "bar_only"
    """the same value, known more or less closely"""


@dataclass(frozen=True, slots=True)
class Number:
    """A value with the interval it is known to lie in; None where it is not finite."""

    value: float | None
    low: float | None
    high: float | None

    @property
    def bounded(self) -> bool:
        return self.low is not None and self.high is not None


@dataclass(frozen=True, slots=True)
class LoadChange:
    """A load that is not what it was."""

    scene: str
    name: str
    unit: str
    old: Number
    new: Number
    move: Move
    shown_in: str = ""
    """another unit in which people read it"""

    @property
    def relative(self) -> float | None:
        """The change as a share of the old value."""
        old, new = self.old.value, self.new.value
        return (new - old) / abs(old) if old and new is not None else None

    @property
    def against(self) -> float | None:
        """How many times the two bars together the change is; None where there are none."""
        old, new = self.old, self.new
        if old.value is None or new.value is None or not (old.bounded and new.bounded):
            return None
        bars = max(old.high - old.value, old.value - old.low) + max(new.high - new.value, new.value - new.low)  # type: ignore[operator]
        return abs(new.value - old.value) / bars if bars > 0 else None


@dataclass(frozen=True, slots=True)
class CheckChange:
    """A check whose verdict or margin is not what it was; an entry is None where there is no such check."""

    scene: str
    turn: Turn
    old: Entry | None
    new: Entry | None

    @property
    def either(self) -> Entry:
        """The check as it is now, or was."""
        found = self.new if self.new is not None else self.old
        assert found is not None
        return found


@dataclass(frozen=True, slots=True)
class KeyChange:
    """A key of a design file that is not what it was, as written; None where it is not written."""

    path: str
    old: str | None
    new: str | None
    line: int | None


@dataclass(frozen=True, slots=True)
class FileChange:
    """All that changed of one file; a verdict is empty where there was, or is, no such file."""

    path: str
    old: str
    new: str
    keys: tuple[KeyChange, ...] = ()
    checks: tuple[CheckChange, ...] = ()
    loads: tuple[LoadChange, ...] = ()
    said: tuple[tuple[Turn, Entry], ...] = ()

    @property
    def turn(self) -> Turn:
        """Where the file went."""
        if not self.old or not self.new:
            return Turn.GONE if self.old else Turn.NEW
        return _turn(_FILES.index(self.old), _FILES.index(self.new))

    @property
    def changed(self) -> bool:
        """Whether there is anything to tell."""
        return self.turn is not Turn.SAME or bool(self.keys or self.checks or self.loads or self.said)

    @property
    def told_loads(self) -> list[LoadChange]:
        """The loads, without those of a part that say again what one of the whole machine says."""
        whole = {(one.scene, one.name): (one.old, one.new) for one in self.loads}
        return [
            one
            for one in self.loads
            if (base := family(one.name)) == one.name or whole.get((one.scene, base)) != (one.old, one.new)
        ]

    def turned(self, *turns: Turn) -> list[CheckChange]:
        """The checks that went there."""
        return [one for one in self.checks if one.turn in turns]


@dataclass(frozen=True, slots=True)
class Pair:
    """A file as it was and as it is, under one name."""

    path: str
    old: Entry | None
    new: Entry | None
    keys: tuple[KeyChange, ...] = ()


def pairs(old: Sequence[Entry], new: Sequence[Entry]) -> list[Pair]:
    """Files that belong together: by their paths; where none is the same, by what is behind the folder of all; a single
    file and another single one."""
    if len(old) == len(new) == 1:
        return [Pair(new[0]["path"], old[0], new[0])]
    names = [{entry["path"]: entry for entry in entries} for entries in (old, new)]
    if not names[0].keys() & names[1].keys():
        names = [{_behind(entry["path"], entries): entry for entry in entries} for entries in (old, new)]
    before, after = names
    every = sorted({*before, *after}, key=lambda path: PurePosixPath(path).parts)
    return [Pair(path, before.get(path), after.get(path)) for path in every]


def _behind(path: str, entries: Iterable[Entry]) -> str:
    """A path without the folders that all have in common."""
    folders = [PurePosixPath(entry["path"]).parts[:-1] for entry in entries]
    common = 0
    while all(len(one) > common and one[common] == folders[0][common] for one in folders):
        common += 1
    return PurePosixPath(*PurePosixPath(path).parts[common:]).as_posix()


def compared(pair: Pair) -> FileChange:
    """What changed of one file."""
    old, new = pair.old, pair.new
    if old is None or new is None:
        was, now = (entry["verdict"] if entry is not None else "" for entry in (old, new))
        return FileChange(pair.path, was, now)
    return FileChange(
        pair.path,
        old["verdict"],
        new["verdict"],
        pair.keys,
        tuple(sorted(_checks(old, new), key=_weight)),
        tuple(_loads(old, new)),
        tuple(_said(old, new)),
    )


def _checks(old: Entry, new: Entry) -> Iterator[CheckChange]:
    before, after = (dict(_by_scene(entry, "checks", "code", "element")) for entry in (old, new))
    for key in dict.fromkeys((*before, *after)):
        was, now = before.get(key), after.get(key)
        if was is None or now is None:
            yield CheckChange(key[0], Turn.NEW if was is None else Turn.GONE, was, now)
            continue
        turn = _turn(_WORST.index(was["verdict"]), _WORST.index(now["verdict"]))
        same = all(_same(was.get(name), now.get(name)) for name in ("value", "limit", "margin"))
        if turn is not Turn.SAME or not same:
            yield CheckChange(key[0], turn, was, now)


def _weight(change: CheckChange) -> tuple[int, int, float]:
    """The worst first."""
    order = [Turn.WORSE, Turn.NEW, Turn.GONE, Turn.BETTER, Turn.SAME]
    margin, limit = change.either.get("margin"), change.either.get("limit")
    relative = math.inf if margin is None else margin / (abs(limit) if limit else 1.0)
    return order.index(change.turn), _WORST.index(change.either["verdict"]), relative


def _loads(old: Entry, new: Entry) -> Iterator[LoadChange]:
    before, after = (dict(_by_scene(entry, "loads", "name")) for entry in (old, new))
    for key, was in before.items():
        now = after.get(key)
        if now is None:
            continue
        first, second = (Number(one["value"], one["low"], one["high"]) for one in (was, now))
        move = _move(first, second)
        if move is not None:
            yield LoadChange(key[0], key[1], now["unit"], first, second, move, now.get("shown_in", ""))


def _move(old: Number, new: Number) -> Move | None:
    if _same(old.value, new.value):
        return None if _same(old.low, new.low) and _same(old.high, new.high) else Move.BAR
    if not (old.bounded and new.bounded):
        return Move.WITHIN
    assert old.low is not None
    assert old.high is not None
    assert new.low is not None
    assert new.high is not None
    return Move.CLEAR if new.low > old.high or new.high < old.low else Move.WITHIN


def _same(old: float | None, new: float | None) -> bool:
    if old is None or new is None:
        return old is new
    return abs(new - old) <= _ROUNDING * max(abs(old), abs(new))


def _said(old: Entry, new: Entry) -> Iterator[tuple[Turn, Entry]]:
    """Findings besides verdicts that are new or gone, by code and key."""
    before, after = ({(d["code"], dotted(tuple(d["path"]))): d for d in entry["diagnostics"]} for entry in (old, new))
    yield from ((Turn.NEW, after[key]) for key in after if key not in before)
    yield from ((Turn.GONE, before[key]) for key in before if key not in after)


def _by_scene(entry: Entry, part: str, *names: str) -> Iterator[tuple[tuple[str, ...], Entry]]:
    for scene in entry["scenes"]:
        for one in scene[part]:
            yield (scene["name"], *(one.get(name, "") for name in names)), one


def _turn(old: int, new: int) -> Turn:
    return Turn.SAME if old == new else Turn.WORSE if new < old else Turn.BETTER
