"""What a file may cost: a limit of predicted work for each scene, and one for all of them and what hangs on them."""

from collections.abc import Container, Iterator, Sequence
from dataclasses import dataclass, field

from ptmcalc.base.diagnostic import Diagnostic, Severity
from ptmcalc.contract.machine import AnyKind
from ptmcalc.engine.plan import RungKey, ScenePlan
from ptmcalc.engine.run import settle
from ptmcalc.engine.settled import Run, Settled
from ptmcalc.spec.machine import MachineSpec
from ptmcalc.text.document import Document

FILE_TIMES = 10.0
"""Work of a file with all scenes, assumptions and repairs, relative to the budget of a scene [1]. A numerical choice: a
larger value computes more scenes to the end and takes longer."""
_NAMED = 3
"""Scenes that a message names; the rest is counted. An engineering choice: the message stays short."""


@dataclass
class FilePurse:
    """Predicted seconds that each scene of a file may take, and those that are left to all of them together."""

    scene: float
    left: float = field(init=False)
    short: dict[str, None] = field(default_factory=dict)
    """labels of scenes that a file of their own would have taken further"""

    def __post_init__(self) -> None:
        self.left = FILE_TIMES * self.scene

    @property
    def most(self) -> float:
        """Seconds that the next scene may take."""
        return max(min(self.scene, self.left), 0.0)

    def settle(
        self,
        kind: AnyKind,
        spec: MachineSpec,
        scene: ScenePlan,
        verdicts: Container[tuple[str, str]] | None = None,
        known: Sequence[Run] = (),
        later: Container[RungKey] = (),
    ) -> Settled:
        """A scene, as far as what is left goes."""
        most = self.most
        settled = settle(kind, spec, scene, budget=most, verdicts=verdicts, known=known, later=later)
        if most < self.scene and settled.next_rung is not None:
            self.short[scene.scene.label] = None
        self.left -= settled.spent
        return settled

    def said(self, document: Document) -> Iterator[Diagnostic]:
        """What to say where that was not enough."""
        if self.short:
            labels = list(self.short)
            named = ", ".join(f"`{label}`" for label in labels[:_NAMED])
            more = f" and {len(labels) - _NAMED} more" if len(labels) > _NAMED else ""
            reason = (
                f"the file is predicted to take more than {FILE_TIMES * self.scene:.3g} s, {FILE_TIMES:.0f} budgets of"
                f" a scene: {named}{more} {'is' if len(labels) == 1 else 'are'} not computed to the end"
            )
            hint = (
                f"check some alone, as with `--scene {labels[0]}`, or give more, as with `--budget {2 * self.scene:g}s`"
            )
            place = document.key_span(("scenes",)) if document.holds(("scenes",)) else document.value_span(())
            yield Diagnostic("NUM103", reason, place, ("scenes",), hint, Severity.WARNING)
