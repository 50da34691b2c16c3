"""The value of a key at which a failed check passes in every scene, looked for once and seen to pass."""

from collections.abc import Callable
from dataclasses import dataclass, field

from pydantic import BaseModel

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.errors import UsageError
from ptmcalc.base.progress import step
from ptmcalc.base.span import KeyPath, dotted
from ptmcalc.base.units import RATIO, show
from ptmcalc.contract.check import AnyCheck
from ptmcalc.contract.report import Repair
from ptmcalc.engine.judge import Ruling
from ptmcalc.engine.load import Loaded, changed, measure_at
from ptmcalc.engine.purse import FilePurse
from ptmcalc.engine.solve import FARTHEST, REPAIR_SECONDS, SearchPurse, solve
from ptmcalc.spec.machine import MachineSpec
from ptmcalc.spec.optional import Limit, declaration_of
from ptmcalc.spec.scene import Scene
from ptmcalc.spec.shape import keys_of

Again = Callable[[Loaded, AnyCheck, tuple[str, ...], float], tuple[list[Verdict], float]]
"""The verdicts of a check of a changed file in some scenes, with so many predicted seconds at most for each, and the
predicted seconds of its runs."""
Found = tuple[Repair | None, str]
"""A repair, or what was tried without one."""


@dataclass
class Repairs:
    """The repairs of a file: one value for each check and key, whatever number of scenes the check fails in."""

    loaded: Loaded
    scenes: tuple[str, ...]
    """the scenes asked about"""
    purse: FilePurse
    again: Again
    _known: dict[tuple[str, str, KeyPath], Found] = field(default_factory=dict)

    def of(self, ruling: Ruling, scene: Scene) -> Found:
        """The repair of a check that fails in a scene: of the key that a run found to be the cause, where that is one
        number, or of the check's own key.

        A key that only states a limit, a rating or a waiting time is never offered: it changes what is required, not
        the machine. A failure that a run found of a check without a limit names its own cure: there is no margin that
        a search could follow.
        """
        spec = self.loaded.spec
        assert spec is not None
        check = ruling.check
        found = ruling.found and isinstance(spec.value_at(ruling.blame), int | float)
        path = ruling.blame if check.repairs_blame or found else check.repair(spec, scene)
        followed = ruling.limit is not None or not ruling.found
        if not path or not followed or not self.purse.most or states_a_limit(spec, path):
            return None, ""
        key = (check.code, check.element, path)
        if key not in self._known:
            self._known[key] = self._looked_for(spec, check, path)
        return self._known[key]

    def _looked_for(self, spec: MachineSpec, check: AnyCheck, path: KeyPath) -> Found:
        labels = tuple(one.label for one in spec.all_scenes if check.applies_to(one))
        labels = tuple(one for one in labels if not self.scenes or one in self.scenes)
        search = SearchPurse(min(REPAIR_SECONDS, self.purse.most))
        step(f"value of {dotted(path)} that passes {check.code}")
        try:
            found = solve(self.loaded, check, path, labels, purse=search)
        except UsageError:
            return None, ""
        self.purse.left -= search.spent
        edges = (found.value, found.other) if found else ()
        passing = [one for one in edges if one is not None and self._passes_with(path, one, check, labels)]
        if found and passing:
            return Repair(path, passing[0], found.quantity, *passing[1:]), ""
        return None, self._tried(spec, path, labels, ended=found is None and search.spent <= search.most)

    def _tried(self, spec: MachineSpec, path: KeyPath, labels: tuple[str, ...], *, ended: bool) -> str:
        """What was tried: all values there are, or as many as the work budget allows."""
        where = "" if len(labels) == 1 else " in all scenes"
        if not ended:
            return f"no value of {dotted(path)} that passes{where} was found within the work budget"
        present = spec.value_at(path)
        measure = measure_at(spec, path)
        quantity = measure.quantity if measure else RATIO
        low, high = (show(present * factor, quantity) for factor in (1 / FARTHEST, FARTHEST))
        return f"no value of {dotted(path)} from {low} to {high} passes{where}"

    def _passes_with(self, path: KeyPath, value: float, wanted: AnyCheck, labels: tuple[str, ...]) -> bool:
        """Whether the file with another value at a key passes a check in these scenes."""
        verdicts, spent = self.again(changed(self.loaded, path, value), wanted, labels, self.purse.most)
        self.purse.left -= spent
        return bool(verdicts) and all(verdict is Verdict.PASS for verdict in verdicts)


def states_a_limit(spec: MachineSpec, path: KeyPath) -> bool:
    """Whether a key only states a limit, a rating or another requirement."""
    node = spec.value_at(path[:-1])
    known = keys_of(type(node)).get(str(path[-1])) if isinstance(node, BaseModel) else None
    return known is not None and isinstance(declaration_of(known), Limit)
