"""What only the whole report shows: effects with their meaning, events, runs, sources of what is assumed."""

from collections.abc import Iterable

from rich.console import Console

from ptmcalc.base.span import dotted
from ptmcalc.base.units import digits
from ptmcalc.contract.report import EffectReport, FileReport, SceneReport
from ptmcalc.report import words
from ptmcalc.report.drawing import fill, glued, new_table
from ptmcalc.report.pick import MOST_EVENTS

_GRID = ("steps", "cells")


def effects(console: Console, scenes: Iterable[SceneReport]) -> None:
    """The ledger: what became of each effect, by what number, and what it changes where that is close."""
    rows = [(scene.name, effect) for scene in scenes for effect in scene.present]
    if not rows:
        return
    table = new_table("Effects", "scene", "effect", "state", "number", "meaning", "if neglected")
    console.print(fill(table, [_ledger_row(scene, effect) for scene, effect in rows], console.width))


def _ledger_row(scene: str, effect: EffectReport) -> list[str]:
    number = effect.criterion
    return [
        scene,
        effect.name,
        f"{effect.state.value}{' (forced)' if effect.forced else ''}",
        glued(words.compared(number)) if number else "",
        "; ".join(filter(None, (number.meaning if number else "", effect.note))),
        _change(effect),
    ]


def _change(effect: EffectReport) -> str:
    """What is without the effect; a change within the bars of the two runs may be none, or the other way round."""
    change = effect.change
    if change is None:
        return ""
    if not change.visible:
        return "no change"
    within = "" if change.clear else ", within the bars"
    return f"{change.load} {100 * change.relative:+.2g} %{within}"


def events(console: Console, scenes: tuple[SceneReport, ...]) -> None:
    """What changed its state and when, the first of each scene; the JSON has all."""
    if not any(scene.events for scene in scenes):
        return
    table = new_table("Events", "scene", "time", "element", "from", "to")
    rows = []
    for scene in scenes:
        rows += [
            [scene.name, f"{digits(event.time, 5)} s", event.element, event.before, event.after]
            for event in scene.events[:MOST_EVENTS]
        ]
        left = len(scene.events) - MOST_EVENTS
        if left > 0:
            rows.append([scene.name, f"... and {left} more", "", "", ""])
    console.print(fill(table, rows, console.width))


def solvers(console: Console, scenes: Iterable[SceneReport]) -> None:
    """The runs that were made, and the price of the next one."""
    table = new_table("Solvers", "scene", "solver", "effects simulated", "work", "predicted next")
    rows = [
        [
            scene.name,
            solver.name if solver.decides else f"{solver.name} (shown only)",
            ", ".join(scene.simulated(solver)) if solver.decides else "",
            str(solver.work),
            words.priced(solver.next) if solver.next else "",
        ]
        for scene in scenes
        for solver in scene.solvers
    ]
    console.print(fill(table, rows, console.width))


def notes(console: Console, scenes: Iterable[SceneReport]) -> None:
    """What there is to say of single loads."""
    rows = [(scene.name, load) for scene in scenes for load in scene.loads if load.note]
    if not rows:
        return
    table = new_table("Remarks", "scene", "load", "")
    cells = [[scene, load.info.title, load.note] for scene, load in rows]
    console.print(fill(table, cells, console.width))


def assumed(console: Console, report: FileReport) -> None:
    """Values that the file does not give."""
    if not report.assumed:
        return
    table = new_table("Assumptions (not given in the file)", "key", "value", "may be", "source")
    rows = [
        [dotted(value.path), words.number(value.value, value.quantity), words.interval(value), value.source]
        for value in report.assumed
    ]
    console.print(fill(table, rows, console.width))


def health(console: Console, scenes: Iterable[SceneReport]) -> None:
    """How well the energy of each scene balances, and in how fine a grid."""
    for scene in scenes:
        residual = words.balance(scene)
        if residual is not None:
            grid = "".join(f", {scene.health[name]:.0f} {name}" for name in _GRID if scene.health.get(name))
            console.print(f"{scene.name}: {words.closing(residual)}{grid}", style="dim")
