"""Verdicts with every assumed value at both ends of its interval."""

from collections.abc import Iterable, Iterator, Mapping

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.progress import step
from ptmcalc.base.span import dotted
from ptmcalc.base.units import show
from ptmcalc.contract.machine import AnyKind
from ptmcalc.contract.report import AssumedReport
from ptmcalc.engine.judge import Ruling
from ptmcalc.engine.plan import Plan, RungKey, plan
from ptmcalc.engine.purse import FilePurse
from ptmcalc.engine.settled import Settled
from ptmcalc.engine.solve import variants
from ptmcalc.spec.machine import MachineSpec

Key = tuple[str, str, str]
"""Scene, code of a check, part of the machine."""
Flips = Mapping[Key, tuple[AssumedReport, float, Verdict]]
"""For a check: the assumed value that changes its verdict, the end of the interval, and the new verdict."""


def flips_of(
    kind: AnyKind,
    spec: MachineSpec,
    made: Plan,
    settled: list[Settled],
    assumed: Iterable[AssumedReport],
    purse: FilePurse,
) -> Flips:
    """Verdicts that change if an assumed value is at an end of its interval.

    A passing check passes only if it does so at both ends; a failing check fails unless it passes at an end. An open
    check, or one already changed by an earlier end, is not evaluated again, and runs whose loads do not depend on the
    value are not made again. Runs that did not decide at an earlier end come last.
    """
    rulings = dict(by_key(made, settled))
    runs = {one.plan.scene.label: one.runs for one in settled}
    base = {key: ruling.verdict for key, ruling in rulings.items()}
    found: dict[Key, tuple[AssumedReport, float, Verdict]] = {}
    later: dict[str, set[RungKey]] = {label: set() for label in runs}
    for value, end, other in variants(spec, assumed):
        left: dict[str, set[tuple[str, str]]] = {}
        readers = {one.label for one in spec.all_scenes if value.read_in(one)}
        for key, ruling in rulings.items():
            settled_once = ruling.verdict in (Verdict.PASS, Verdict.FAIL) and key not in found
            if settled_once and key[0] in readers and value.read_by(ruling.check):
                left.setdefault(key[0], set()).add((key[1], key[2]))
        if not left:
            continue
        step(f"assumption {dotted(value.path)} = {show(end, value.quantity)}")
        again = plan(kind, other, [one for one in other.all_scenes if one.label in left])
        same = {label: [run for run in runs[label] if not value.changes(run.result.loads)] for label in left}
        ends = [
            purse.settle(kind, other, one, left[label], same[label], later[label])
            for one in again.scenes
            for label in (one.scene.label,)
        ]
        for one in ends:
            later[one.plan.scene.label].update(one.superseded)
        found |= {
            key: (value, end, ruling.verdict)
            for key, ruling in by_key(again, ends)
            if _turns(base[key], ruling.verdict)
        }
    return found


def _turns(verdict: Verdict, at_end: Verdict) -> bool:
    """Whether a verdict changes with an assumed value at its end: a fail can only change into a pass."""
    return at_end is Verdict.PASS if verdict is Verdict.FAIL else at_end is not verdict


def by_key(made: Plan, settled: list[Settled]) -> Iterator[tuple[Key, Ruling]]:
    """The verdict of each check in each scene."""
    for scene, result in zip(made.scenes, settled, strict=True):
        for ruling in result.rulings:
            yield (scene.scene.label, ruling.check.code, ruling.check.element), ruling
