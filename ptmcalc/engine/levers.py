"""The keys of a file that may be changed so that checks pass: what the machine is made of, and how it is set."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.errors import UsageError
from ptmcalc.base.span import KeyPath, dotted, key_path, known
from ptmcalc.base.units import show
from ptmcalc.contract.report import FileReport
from ptmcalc.engine.judge import checks_of
from ptmcalc.engine.load import Loaded, changed, measure_at
from ptmcalc.engine.repair import states_a_limit
from ptmcalc.engine.solve import Grid, grid_of
from ptmcalc.spec.alias import key_of
from ptmcalc.spec.shape import did_you_mean

DIGITS = 3
"""Significant digits of a value that is found. A numerical choice: nobody orders a part or sets a drive more closely,
and `solve` finds more; more digits take longer."""
_EVERY = "[*]"


@dataclass(frozen=True, slots=True)
class Lever:
    """A key that may be changed, or one that has the same value in several scenes."""

    name: str
    paths: tuple[KeyPath, ...]
    present: float
    """SI"""
    grid: Grid
    repairs: frozenset[str] = frozenset()
    """codes of the checks that offer it as repair"""

    def set_to(self, loaded: Loaded, value: float) -> Loaded:
        """The machine with another value of the key; without a spec where that would not be a valid file."""
        for path in self.paths:
            if loaded.spec is None:
                return loaded
            measure = measure_at(loaded.spec, path)
            loaded = changed(loaded, path, value if measure else int(value))
        return loaded

    def told(self, value: float) -> str:
        """A value of it, in its unit."""
        return show(value, self.grid.quantity, 6)


def offered(loaded: Loaded, report: FileReport, scenes: Iterable[str] = ()) -> tuple[Lever, ...]:
    """The keys that the checks of a machine offer as repair, those that a run found to be the cause of a failure, and
    those that the kind names; never one that only states a limit, a rating or a waiting time."""
    assert loaded.kind is not None
    assert loaded.spec is not None
    paths: dict[KeyPath, set[str]] = {}
    for code, path in (*_of_causes(loaded, report), *_of_checks(loaded, frozenset(scenes))):
        if path and not states_a_limit(loaded.spec, path):
            paths.setdefault(path, set()).add(code)
    levers = [lever for path in paths if (lever := _of_path(loaded, path, paths[path])) is not None]
    known_paths = set(paths)
    for name in loaded.kind.levers:
        lever = _named(loaded, name)
        if lever is not None and not known_paths.intersection(lever.paths):
            levers.append(lever)
    return tuple(levers)


def chosen(loaded: Loaded, text: str, own: tuple[Lever, ...]) -> tuple[Lever, ...]:
    """The keys of a list such as `takeup.tension,belt.strength`; with a `+` before the first they are added to the
    machine's own.

    Raises:
        UsageError: one of them is not a number of this file.
    """
    if not text.strip():
        return own
    found = {one.name: one for one in own} if text.strip().startswith("+") else {}
    for name in filter(None, (part.strip() for part in text.strip().removeprefix("+").split(","))):
        lever = next((one for one in own if one.name == name), None) or _named(loaded, name)
        if lever is None:
            hint = did_you_mean(name, [one.name for one in own], "keys of this machine: ")
            raise UsageError(f"`{name}` is not a number of this file that can be varied", hint)
        found[lever.name] = lever
    return tuple(found.values())


def _of_causes(loaded: Loaded, report: FileReport) -> Iterator[tuple[str, KeyPath]]:
    """What runs found to be the cause of failures, and what checks that say so blame."""
    assert loaded.kind is not None
    blaming = {one.code for one in loaded.kind.checks if one.repairs_blame}
    for _, one in report.judgements:
        found = one.verdict is Verdict.FAIL and one.margin is None
        if found or (one.code in blaming and one.verdict in (Verdict.FAIL, Verdict.UNDECIDED)):
            yield one.code, known(one.blame.path)


def _of_checks(loaded: Loaded, scenes: frozenset[str]) -> Iterator[tuple[str, KeyPath]]:
    """What the checks offer as repair."""
    kind, spec = loaded.kind, loaded.spec
    assert kind is not None
    assert spec is not None
    for scene in spec.all_scenes:
        if not scenes or scene.label in scenes:
            for one in checks_of(kind, spec, scene):
                yield one.code, one.repair(spec, scene)


def _named(loaded: Loaded, name: str) -> Lever | None:
    """A key by its name, or the numbers that have it in the scenes of the file, where these are the same."""
    spec = loaded.spec
    assert spec is not None
    if _EVERY not in name:
        path = key_of(key_path(name), type(spec), loaded.document.data)
        return _of_path(loaded, path)
    before, _, after = name.partition(_EVERY)
    places = range(len(spec.value_at(key_path(before)) or ()))
    paths = [(*key_path(before), place, *key_path(after)) for place in places]
    written = [path for path in paths if loaded.document.holds(path) and grid_of(spec, path, DIGITS) is not None]
    if len({spec.value_at(path) for path in written}) != 1:
        return None
    if len(written) == 1:
        return _of_path(loaded, written[0])
    first = grid_of(spec, written[0], DIGITS)
    assert first is not None
    return Lever(name, tuple(written), float(spec.value_at(written[0])), first)


def _of_path(loaded: Loaded, path: KeyPath, codes: Iterable[str] = ()) -> Lever | None:
    """A key that the file writes; what it does not is an assumption, and no part of the design."""
    spec = loaded.spec
    assert spec is not None
    grid = grid_of(spec, path, DIGITS)
    if grid is None or not loaded.document.holds(path):
        return None
    name = dotted(loaded.document.as_written(path))
    return Lever(name, (path,), float(spec.value_at(path)), grid, frozenset(codes))
