"""The short summary of simulated and neglected effects, solvers and assumptions, with their criteria."""

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.span import dotted
from ptmcalc.base.units import TIME, digits, show
from ptmcalc.contract.effect import EffectState
from ptmcalc.contract.report import EffectReport, FileReport, SceneReport
from ptmcalc.report import words
from ptmcalc.report.drawing import GLUE, paragraph


def sections(report: FileReport, width: int) -> Iterator[tuple[str, list[str]]]:
    """Heading and lines of each section that has something to say."""
    found = {
        "Effects": _effects(report.scenes),
        "Events": map(_events, report.scenes),
        "Solvers": _solvers(report),
        "Assumptions (not given in the file)": [_assumed(report)],
    }
    for heading, paragraphs in found.items():
        lines = [line for parts in paragraphs if parts for line in flowed(parts, width)]
        if lines:
            yield heading, lines


def flowed(parts: Sequence[str], width: int) -> list[str]:
    """A paragraph that keeps each part in one line as far as the screen allows."""
    return paragraph(" ".join(part.replace(" ", GLUE) for part in parts), width, " ", "   ")


def _listed(parts: Iterable[str], mark: str = ",") -> list[str]:
    """The parts with a mark behind each but the last."""
    *most, last = parts
    return [*(part + mark for part in most), last]


def _effects(scenes: Iterable[SceneReport]) -> Iterator[list[str]]:
    """States of the effects with their criteria; scenes with equal states are combined."""
    found: dict[tuple[str, ...], list[str]] = {}
    for scene in scenes:
        if scene.present:
            found.setdefault(tuple(_states(scene.present)), []).append(scene.name)
    for said, names in found.items():
        yield [*_listed(names)[:-1], f"{names[-1]}:", *said]


def _states(effects: Iterable[EffectReport]) -> list[str]:
    """`simulated waves x = 3 ≥ 0.1, sag ...; skipped wind ...`, the simulated first."""
    groups: dict[str, list[str]] = {state.value: [] for state in reversed(EffectState)}
    for effect in effects:
        number = f" {words.compared(effect.criterion)}" if effect.criterion else ""
        forced = " (forced)" if effect.forced and effect.state is not EffectState.SKIPPED else ""
        groups.setdefault(_state(effect), []).append(f"{effect.name}{forced}{number}")
    told = [[f"{state} {names[0]}", *names[1:]] for state, names in groups.items() if names]
    ends = _listed((names[-1] for names in told), ";")
    return [part for names, end in zip(told, ends, strict=True) for part in (*_listed(names)[:-1], end)]


def _state(effect: EffectReport) -> str:
    """The state, or the reason where the number is not the reason."""
    if effect.criterion is None:
        return "not assessed (input missing)"
    off = effect.forced and effect.state is EffectState.SKIPPED
    return "switched off by the file" if off else effect.state.value


def _events(scene: SceneReport) -> list[str]:
    if not scene.events:
        return []
    first, last = (f"{digits(scene.events[end].time, 5)} s" for end in (0, -1))
    count = Counter(event.element for event in scene.events)
    times = f"at {first}" if len(scene.events) == 1 else f"from {first} to {last}"
    return [f"{scene.name}:", f"{len(scene.events)} {times},", *_listed(f"{name} {n}" for name, n in count.items())]


def _solvers(report: FileReport) -> Iterator[list[str]]:
    """Which solver the verdicts of each scene rest on, over what time, and how well the energy balances."""
    parts = [_decided(scene) for scene in report.scenes if scene.solvers]
    residuals = [(left, scene.name) for scene in report.scenes if (left := words.balance(scene)) is not None]
    if residuals:
        worst, name = max(residuals, key=lambda one: (math.isnan(one[0]), one[0]))
        where = f" at worst, in {name}" if len(residuals) > 1 and not worst < words.BALANCED else ""
        parts.append(words.closing(worst) + where)
    if parts:
        yield _listed(parts, ";")


def _decided(scene: SceneReport) -> str:
    """The solvers behind the loads that checks read; behind all loads where there is no check."""
    read = {name for judgement in scene.checks for name in judgement.loads}
    behind = [load for load in scene.loads if load.info.name in read] or scene.loads
    names = dict.fromkeys(load.solver for load in behind)
    windows = [load.window for load in behind if load.window]
    over = f" over {show(max(end for _, end in windows) - min(begin for begin, _ in windows), TIME)}" if windows else ""
    open_ = any(judgement.verdict is Verdict.UNDECIDED for judgement in scene.checks)
    price = next((f" (next: {words.priced(solver.next)})" for solver in scene.solvers if open_ and solver.next), "")
    return f"{scene.name} {', '.join(names) or 'none'}{over}{price}"


def _assumed(report: FileReport) -> list[str]:
    return (
        _listed(
            f"{dotted(value.path)} = {words.number(value.value, value.quantity)} ({words.interval(value)})"
            for value in report.assumed
        )
        if report.assumed
        else []
    )
