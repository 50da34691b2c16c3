"""Effects that a file forces on: simulated, or refused with the reason."""

from collections.abc import Iterator, Sequence

from ptmcalc.base.diagnostic import Diagnostic, Severity
from ptmcalc.base.words import quote
from ptmcalc.contract.machine import AnyKind
from ptmcalc.engine.plan import PlannedEffect, ScenePlan
from ptmcalc.spec.machine import MachineSpec
from ptmcalc.text.document import Document


def refused(
    kind: AnyKind, spec: MachineSpec, scenes: Sequence[ScenePlan], document: Document, *, whole: bool
) -> Iterator[Diagnostic]:
    """Effects forced on that no solver can simulate: an error where that is so in every scene, else a warning.

    Of a file of which only some scenes are computed, what the others can simulate is not known: a warning too.
    """
    for name in (name for name, wish in spec.effects.items() if wish == "on"):
        about = [(one, planned) for one in scenes for planned in one.effects if planned.effect.name == name]
        reasons = {one.scene.label: why_not(kind, spec, one, planned) for one, planned in about}
        bad = {label: reason for label, reason in reasons.items() if reason}
        if about and not bad:
            continue
        path = ("effects", name)
        if not about:
            reason = "none of the scenes computed has this effect"
        else:
            reason = f"in scene {', '.join(map(quote, bad))}: {next(iter(bad.values()))}"
        severity = Severity.ERROR if whole and len(bad) == len(about) else Severity.WARNING
        message = f"effect {quote(name)} is forced on and cannot be simulated {reason}"
        if not about:
            message = f"effect {quote(name)} is forced on: {reason}"
        hint = f"write `{name}: auto`"
        yield Diagnostic("SPC205", message, document.value_span(path), path, hint, severity)


def why_not(kind: AnyKind, spec: MachineSpec, scene: ScenePlan, planned: PlannedEffect) -> str:
    """What keeps an effect from being simulated in a scene; empty where a run can carry it."""
    name = planned.effect.name
    if any(name in rung.carried for rung in scene.rungs):
        return ""
    if planned.criterion is None:
        return "a required input is not given"
    whole = planned.effect.part_of
    if whole and whole in scene.excluded:
        return f"it is part of {quote(whole)}, forced off in the file"
    able = [one for one in kind.solvers if one.decides and name in one.represents and type(scene.scene) in one.scenes]
    for solver in able:
        off = sorted(solver.always & scene.withheld)
        if off:
            return f"{quote(solver.name)} always simulates {quote(off[0])} too, forced off in the file"
        criterion = solver.valid(spec, scene.scene)
        if criterion is not None and criterion.exceeded:
            return f"{quote(solver.name)} cannot be used: {criterion.meaning}"
    return f"no solver simulates it in a scene of type {quote(scene.scene.type)}"
