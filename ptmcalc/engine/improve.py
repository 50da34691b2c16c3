"""What to change so that the checks of a file pass: one key, or two, with the nearest value and what it costs."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.estimate import Estimate
from ptmcalc.base.progress import step
from ptmcalc.contract.report import FileReport, Judgement
from ptmcalc.engine.check import Options, judged_again
from ptmcalc.engine.ends import Key
from ptmcalc.engine.judge import Ruling
from ptmcalc.engine.levers import Lever
from ptmcalc.engine.load import Loaded
from ptmcalc.engine.purse import FILE_TIMES, FilePurse
from ptmcalc.engine.solve import SearchPurse, SpentError
from ptmcalc.engine.trial import OPEN, OVERHEAD, Machine

KEY_SECONDS, PAIR_SECONDS = 7.5, 2.5
"""Predicted seconds of the search for single keys, and for pairs. Numerical choices: larger values find more and take
longer."""
_LOST = 0.5
"""Share of its margin that a check loses to be named as worse [1]. An engineering choice: a larger value names fewer.
"""
_FIRSTS, _SECONDS, _PAIRS = 3, 4, 2
"""Keys that others are combined with, others that are tried with each, and pairs that are enough. Numerical choices:
larger values find more pairs and take longer."""


class _Every:
    """All checks."""

    def __contains__(self, one: object) -> bool:
        return True


@dataclass(frozen=True, slots=True)
class Move:
    """A key with another value."""

    lever: Lever
    value: float

    @property
    def change(self) -> float:
        """Relative to the present value [1]."""
        return self.value / self.lever.present - 1


@dataclass(frozen=True, slots=True)
class Cost:
    """A check that a change makes worse: it passed, and fails or is undecided, or has lost most of its margin."""

    key: Key
    verdict: Verdict
    before: float | None
    """margin relative to the limit [1]"""
    after: float | None

    @property
    def broken(self) -> bool:
        """Whether it no longer passes."""
        return self.verdict is not Verdict.PASS


@dataclass(frozen=True, slots=True)
class Answer:
    """A change that was put into the file and checked."""

    moves: tuple[Move, ...]
    passes: tuple[Key, ...]
    wanted: int
    costs: tuple[Cost, ...]
    notes: tuple[str, ...] = ()
    """values of the file that disagree with the new one"""

    @property
    def whole(self) -> bool:
        """Whether all wanted checks pass."""
        return len(self.passes) == self.wanted

    @property
    def clean(self) -> bool:
        """Whether all wanted checks pass, and all others that did."""
        return self.whole and not self.broken

    @property
    def broken(self) -> int:
        """Checks that passed and no longer do."""
        return sum(one.broken for one in self.costs)

    @property
    def order(self) -> tuple[float, ...]:
        """The best first: what passes all and breaks nothing, then by the least change."""
        change = sum(abs(one.change) for one in self.moves)
        rest = (self.broken - len(self.passes), len(self.moves), len(self.notes), change)
        return (not self.clean, not self.whole, *rest)


@dataclass
class Improvement:
    """What may be changed in a file, and what not."""

    wanted: tuple[tuple[Key, Judgement], ...]
    answers: list[Answer] = field(default_factory=list)
    """single keys and pairs, the best first"""
    idle: list[Lever] = field(default_factory=list)
    """keys that move none of the wanted checks"""
    useless: list[Lever] = field(default_factory=list)
    """keys that move some of them and pass none"""
    untried: list[Lever] = field(default_factory=list)
    """keys for which the work budget did not suffice"""
    pairs_left: bool = False
    """whether pairs were left out for want of it"""

    @property
    def solved(self) -> bool:
        """Whether a key or a pair passes everything."""
        return any(one.clean for one in self.answers)


def wanted_of(report: FileReport, codes: Sequence[str] = ()) -> tuple[tuple[Key, Judgement], ...]:
    """The failed and undecided checks of a report, of some codes where they are named."""
    return tuple(
        ((scene.name, one.code, one.element), one)
        for scene, one in report.judgements
        if one.verdict in OPEN and (not codes or one.code in codes)
    )


def improve(
    loaded: Loaded,
    report: FileReport,
    levers: Sequence[Lever],
    options: Options,
    codes: Sequence[str] = (),
    seconds: tuple[float, float] = (KEY_SECONDS, PAIR_SECONDS),
) -> Improvement:
    """The keys, and pairs of keys, whose change passes the failed and undecided checks of a report.

    Of each key two trial values show whether it moves them. The nearest value is found at which all of them pass in
    all their scenes, or as many as can; it is then put into the file and everything is checked. Only what passes there
    is told. Keys that seem to need the least change come first; the work is limited to so many predicted seconds, of
    keys and of pairs.
    """
    found = Improvement(wanted_of(report, codes))
    search = _Whole(loaded, report, options, tuple(key for key, _ in found.wanted), SearchPurse(seconds[0]))
    machine = Machine(search.purse, loaded, search.wanted)
    moving = _ranked(machine, levers, found)
    for place, lever in enumerate(moving):
        try:
            answer = search.best(lever, machine)
        except SpentError:
            found.untried += moving[place:]
            break
        if answer is None:
            found.useless.append(lever)
        else:
            found.answers.append(answer)
    found.answers.sort(key=lambda one: one.order)
    if found.answers and not found.solved:
        search.purse = SearchPurse(seconds[1])
        found.answers += list(_pairs(search, found, levers))
        found.answers.sort(key=lambda one: one.order)
    return found


def _ranked(machine: Machine, levers: Sequence[Lever], found: Improvement) -> list[Lever]:
    """The keys that move the wanted checks: their own repairs first, then what seems to need the least change."""
    own = {code for _, code, _ in machine.wanted}
    needed: list[tuple[tuple[bool, float, float], Lever]] = []
    for place, lever in enumerate(levers):
        try:
            change = machine.trial(lever).seems_to_need()
        except SpentError:
            found.untried += levers[place:]
            break
        if change is None:
            found.idle.append(lever)
        else:
            needed.append(((own.isdisjoint(lever.repairs), *change), lever))
    return [lever for _, lever in sorted(needed, key=lambda one: one[0])]


def _pairs(search: "_Whole", found: Improvement, levers: Sequence[Lever]) -> Iterator[Answer]:
    """Pairs that pass more than their first key alone: to the best keys one is added that passes what is left, be it
    that the first made it worse."""
    told = 0
    firsts = [one for one in found.answers if len(one.moves) == 1][:_FIRSTS]
    seen: set[frozenset[str]] = set()
    try:
        for first in firsts:
            move = first.moves[0]
            there = move.lever.set_to(search.loaded, move.value)
            broken = tuple(one.key for one in first.costs if one.broken)
            left = tuple(key for key in search.wanted if key not in first.passes) + broken
            seconds = _seconds(Machine(search.purse, there, left), move.lever, levers)
            machine = Machine(search.purse, there, (*search.wanted, *broken))
            for second in seconds:
                both = frozenset((move.lever.name, second.name))
                answer = None if both in seen else search.best(second, machine, (move,))
                seen.add(both)
                if answer is not None and answer.order[:3] < first.order[:3]:
                    told += answer.clean
                    yield answer
                if told >= _PAIRS:
                    return
    except SpentError:
        found.pairs_left = True


def _seconds(machine: Machine, first: Lever, levers: Sequence[Lever]) -> list[Lever]:
    """The keys that move what a first one leaves, those that seem to need the least change first."""
    needed = [(machine.trial(one).seems_to_need(), one) for one in levers if one.name != first.name]
    moving = [(change, one) for change, one in needed if change is not None]
    return [one for _, one in sorted(moving, key=lambda pair: pair[0])[:_SECONDS]]


@dataclass
class _Whole:
    """The file as it is, its report, and what is wanted."""

    loaded: Loaded
    report: FileReport
    options: Options
    wanted: tuple[Key, ...]
    purse: SearchPurse

    def best(self, lever: Lever, machine: Machine, before: tuple[Move, ...] = ()) -> Answer | None:
        """The value of a key nearest to the present one at which all that is wanted passes, or as much as can, put in
        and checked; None where nothing passes.

        Raises:
            SpentError: there are no seconds left.
        """
        trial = machine.trial(lever)
        best, tried = None, None
        for search in (trial.best, partial(trial.sound, trial.wanted)):
            value = search()
            if value is None or value == tried:
                continue
            tried = value
            found = self._checked(lever.set_to(machine.loaded, value), (*before, Move(lever, value)))
            if found is not None and found.passes and (best is None or found.order < best.order):
                best = found
            if best is not None and best.whole:
                break
        return best

    def _checked(self, changed: Loaded, moves: tuple[Move, ...]) -> Answer | None:
        """What passes in a changed file, and what gets worse."""
        if changed.spec is None:
            return None
        step(f"{', '.join(f'{one.lever.name} = {one.lever.told(one.value)}' for one in moves)}: all checks")
        purse = FilePurse(self.options.budget)
        rulings, _ = judged_again(self.options, changed, _Every(), purse)
        self.purse.spent += FILE_TIMES * purse.scene - purse.left + OVERHEAD * len({scene for scene, _, _ in rulings})
        passes = tuple(key for key in self.wanted if key in rulings and rulings[key].verdict is Verdict.PASS)
        kind, spec = self.loaded.kind, self.loaded.spec
        assert kind is not None
        assert spec is not None
        known = {one.code for one in kind.inspect(spec)}
        notes = tuple(one.message for one in kind.inspect(changed.spec) if one.code not in known)
        return Answer(moves, passes, len(self.wanted), tuple(self._costs(rulings)), notes)

    def _costs(self, rulings: Mapping[Key, Ruling]) -> Iterator[Cost]:
        """The checks that passed and are worse, those that fail first, then those with the least margin."""
        found = []
        for scene, one in self.report.judgements:
            key = (scene.name, one.code, one.element)
            ruling = rulings.get(key)
            if one.verdict is not Verdict.PASS or ruling is None:
                continue
            before, after = (_share(each.margin, each.limit) for each in (one, ruling))
            lost = before is not None and after is not None and after < (1 - _LOST) * before
            if ruling.verdict is not Verdict.PASS or lost:
                found.append(Cost(key, ruling.verdict, before, after))
        worst = {Verdict.FAIL: 0, Verdict.PASS: 2}
        yield from sorted(found, key=lambda one: (worst.get(one.verdict, 1), one.after if one.after is not None else 0))


def _share(margin: float | None, limit: Estimate | None) -> float | None:
    """A margin relative to its limit; None where that is no number."""
    value = limit.value if limit is not None else None
    if margin is None or not value or not math.isfinite(margin) or not math.isfinite(value):
        return None
    return margin / abs(value)
