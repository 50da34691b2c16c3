"""What `ptmcalc improve` prints: the keys whose change passes the failed checks, with what it costs elsewhere."""

from collections.abc import Iterable, Sequence

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.errors import UsageError
from ptmcalc.cli.listing import listed
from ptmcalc.cli.output import say
from ptmcalc.cli.progress import shown
from ptmcalc.cli.study import loaded_or_told
from ptmcalc.contract.report import FileReport, exit_status
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.ends import Key
from ptmcalc.engine.improve import Answer, Cost, Improvement, Move, improve, wanted_of
from ptmcalc.engine.levers import Lever, chosen, offered
from ptmcalc.engine.load import Loaded
from ptmcalc.report import Format, json, render, words

_COLUMNS = ("key", "now", "value", "passes", "change", "what gets worse")
_NAMED = 2
"""Checks that a line names as worse; the others are counted. An engineering choice: more do not fit a line."""


def show_improvement(
    path: str, scenes: tuple[str, ...], codes: Sequence[str], keys: str, accuracy: str, *, as_json: bool
) -> int:
    """Print what to change so that a file passes; the exit status."""
    options = Options(scenes=scenes, accuracy=accuracy, repairs=False)
    loaded = loaded_or_told(path, options)
    if isinstance(loaded, int):
        return loaded
    wanted = _codes(loaded, codes)
    with shown():
        report = check(loaded, options)
        if not report.valid:
            say(render(Format.PLAIN, [report]), err=True)
            return exit_status((report,))
        levers = chosen(loaded, keys, offered(loaded, report, scenes))
        found = improve(loaded, report, levers, options, wanted) if wanted_of(report, wanted) else None
    if found is None:
        say(json.dump(_document(Improvement(()))) if as_json else _nothing_wanted(report, wanted))
        return 0
    say(json.dump(_document(found)) if as_json else "".join(_text(report, found)))
    return 0 if found.solved else 1


def _codes(loaded: Loaded, codes: Sequence[str]) -> tuple[str, ...]:
    """The codes of the checks that are named.

    Raises:
        UsageError: the kind has no such check.
    """
    assert loaded.kind is not None
    known = [one.code for one in loaded.kind.checks]
    for code in codes:
        if code.upper() not in known:
            raise UsageError(f"a {loaded.kind.label} has no check `{code}`", f"checks: {', '.join(known)}")
    return tuple(code.upper() for code in codes)


def _nothing_wanted(report: FileReport, codes: Sequence[str]) -> str:
    """What to say where there is nothing to improve."""
    unmade = sum(one.verdict is Verdict.NOT_CHECKED for _, one in report.judgements)
    which = f"{', '.join(codes)} {'passes' if len(codes) == 1 else 'pass'}" if codes else "all checks pass"
    more = f"; {unmade} not checked, as keys are missing: see `ptmcalc check`" if unmade else ""
    return f"{words.printable(report.path)}: {which}: nothing to change{more}\n"


# -- table ----------------------------------------------------------------------------------------------------------


def _text(report: FileReport, found: Improvement) -> Iterable[str]:
    yield f"{words.printable(report.path)}: {_count(len(found.wanted), 'check')} to pass: {_wanted(found)}\n"
    whole = [one for one in found.answers if one.whole]
    if not any(one.clean for one in whole):
        yield (
            "Each key or pair that passes them makes another check fail or leaves it undecided\n"
            if whole
            else "No single key and no pair tried passes all of them; the best that can be had:\n"
            if found.answers
            else "No key that was tried passes any of them\n"
        )
    if found.answers:
        yield listed(_COLUMNS, [row for one in found.answers for row in _rows(one)])
    for one in found.answers:
        for note in one.notes:
            yield f"{' and '.join(move.lever.name for move in one.moves)}: {words.printable(note)}\n"
    for levers, about in (
        (found.idle, "without influence on them"),
        (found.useless, "with influence, but up to 10 times as large or small none passes"),
        (found.untried, "not tried within the work budget"),
    ):
        if levers:
            yield f"{_count(len(levers), 'key')} {about}: {', '.join(one.name for one in levers)}\n"
    if found.pairs_left:
        yield "not all pairs of keys were tried within the work budget\n"
    if any("[*]" in move.lever.name for one in found.answers for move in one.moves):
        yield "scenes[*]: one value in all scenes that write the key\n"


def _wanted(found: Improvement) -> str:
    """The wanted checks with their scenes, each once."""
    about: dict[str, list[str]] = {}
    for (scene, code, _), one in found.wanted:
        undecided = " (undecided)" if one.verdict is Verdict.UNDECIDED else ""
        about.setdefault(f"{code} {words.subject(one)}{undecided}", []).append(scene)
    return "; ".join(
        f"{words.printable(name)} in {', '.join(map(words.printable, scenes))}" for name, scenes in about.items()
    )


def _count(number: int, name: str) -> str:
    return f"{number} {name}{'' if number == 1 else 's'}"


def _rows(answer: Answer) -> Iterable[list[str]]:
    """A line for each key of an answer; what it does stands in the first."""
    for place, move in enumerate(answer.moves):
        first = place == 0
        yield [
            ("" if first else "and ") + words.printable(move.lever.name),
            move.lever.told(move.lever.present),
            move.lever.told(move.value),
            f"{len(answer.passes)} of {answer.wanted}" if first else "",
            f"{100 * move.change:+.3g} %",
            _worse(answer.costs) if first else "",
        ]


def _worse(costs: Sequence[Cost]) -> str:
    """The checks that get worse, each code once with the worst of its scenes."""
    once: dict[str, Cost] = {}
    for one in costs:
        once.setdefault(one.key[1], one)
    said = [_said(one) for one in list(once.values())[:_NAMED]]
    return ", ".join(said) + (f", {len(once) - _NAMED} more" if len(once) > _NAMED else "") if said else "nothing"


def _said(cost: Cost) -> str:
    """One check that gets worse."""
    scene, code, element = cost.key
    where = " ".join(filter(None, (code, words.printable(element))))
    if cost.verdict is Verdict.FAIL:
        return f"{where} fails in {words.printable(scene)}"
    if cost.broken:
        return f"{where} is {cost.verdict.value.replace('_', ' ')} in {words.printable(scene)}"
    assert cost.before is not None
    assert cost.after is not None
    return f"{where} margin {100 * cost.before:.0f} % to {100 * cost.after:.0f} %"


# -- JSON -----------------------------------------------------------------------------------------------------------


def _document(found: Improvement) -> dict[str, object]:
    """The answers as data."""
    return {
        "solved": found.solved or not found.wanted,
        "wanted": [_key(key) | {"verdict": one.verdict.value} for key, one in found.wanted],
        "answers": [
            {
                "changes": [_change(one) for one in answer.moves],
                "passes": [_key(key) for key in answer.passes],
                "passes_all": answer.whole,
                "worse": [_cost(one) for one in answer.costs],
                "notes": list(answer.notes),
            }
            for answer in found.answers
        ],
        "no_influence": _names(found.idle),
        "none_passes": _names(found.useless),
        "not_tried": _names(found.untried),
        "pairs_left": found.pairs_left,
    }


def _names(levers: Iterable[Lever]) -> list[str]:
    return [one.name for one in levers]


def _key(key: Key) -> dict[str, object]:
    scene, code, element = key
    named: dict[str, object] = {"scene": scene, "code": code}
    return named | ({"element": element} if element else {})


def _change(move: Move) -> dict[str, object]:
    lever = move.lever
    return {
        "key": lever.name,
        "paths": [list(path) for path in lever.paths],
        "now": lever.present,
        "value": move.value,
        "unit": lever.grid.quantity.si,
        "relative": move.change,
    }


def _cost(cost: Cost) -> dict[str, object]:
    return _key(cost.key) | {"verdict": cost.verdict.value, "margin_before": cost.before, "margin": cost.after}
