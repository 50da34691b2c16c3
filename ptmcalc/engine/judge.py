"""Loads -> verdicts: a margin smaller than its error bar is not a pass."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath, dotted
from ptmcalc.contract.check import AnyCheck, Sense
from ptmcalc.contract.machine import AnyKind
from ptmcalc.contract.result import Failure
from ptmcalc.spec.machine import MachineSpec
from ptmcalc.spec.scene import Scene


@dataclass(frozen=True, slots=True)
class Ruling:
    """The verdict of one check on one scene, before anyone looks up where its key stands."""

    check: AnyCheck
    verdict: Verdict
    value: Estimate | None
    limit: Estimate | None
    blame: KeyPath
    reason: str = ""
    found: bool = False
    """whether it fails by what a run found, whatever its number"""

    @property
    def margin(self) -> float | None:
        """Signed distance of the value from the limit, positive within it; none where the number does not decide."""
        if self.value is None or self.limit is None or self.found:
            return None
        value, limit = self.value.value, self.limit.value
        return value - limit if self.check.sense is Sense.AT_LEAST else limit - value


def judge(kind: AnyKind, spec: MachineSpec, scene: Scene, loads: Mapping[str, Estimate]) -> tuple[Ruling, ...]:
    """The rulings of every check that applies to this scene; of one switched off by the file, that it is."""
    return tuple(rule(one, spec, scene, loads) for one in checks_of(kind, spec, scene)) + tuple(_off(kind, spec, scene))


def _off(kind: AnyKind, spec: MachineSpec, scene: Scene) -> Iterator[Ruling]:
    """The checks that the file switches off, with its reason."""
    for check in kind.checks:
        reason = spec.settings.switched_off(check.code) if check.applies_to(scene) else ""
        if reason and any(check.on(spec, scene)):
            yield Ruling(check, Verdict.OFF, None, None, ("checks", check.code, "off"), reason)


def checks_of(kind: AnyKind, spec: MachineSpec, scene: Scene) -> Iterator[AnyCheck]:
    """Every check that applies to a scene and is not switched off by the file."""
    for check in kind.checks:
        if check.applies_to(scene) and not spec.settings.switched_off(check.code):
            yield from check.on(spec, scene)


def rule(check: AnyCheck, spec: MachineSpec, scene: Scene, loads: Mapping[str, Estimate]) -> Ruling:
    """The ruling of one check."""
    for path in check.needs(spec, scene):
        if spec.value_at(path) is None:
            return Ruling(check, Verdict.NOT_CHECKED, None, None, path, f"`{dotted(path)}` is not given")
    missing = [name for name in check.loads if name not in loads]
    limit = check.limit(spec, scene)
    if missing:
        reason = f"no solver could compute {', '.join(missing)}"
        return Ruling(check, Verdict.UNDECIDED, None, limit, check.blame(spec, scene, loads), reason)
    value = check.read(spec, scene, loads)
    verdict = decide(value, limit, check.sense)
    reason = "the error bar straddles the limit" if verdict is Verdict.UNDECIDED else ""
    return Ruling(check, verdict, value, limit, check.blame(spec, scene, loads), reason)


def found_to_fail(ruling: Ruling, failure: Failure) -> Ruling:
    """The ruling of a check that fails by what a run found."""
    reason = "; ".join(filter(None, (failure.message, failure.hint)))
    return replace(ruling, verdict=Verdict.FAIL, blame=failure.path or ruling.blame, reason=reason, found=True)


def contradicted(ruling: Ruling, broken: Mapping[str, str]) -> Ruling:
    """The ruling of a check: undecided where a load that it reads contradicts another one."""
    why = next((broken[name] for name in ruling.check.loads if name in broken), "")
    if not why or ruling.verdict not in (Verdict.PASS, Verdict.FAIL):
        return ruling
    return replace(ruling, verdict=Verdict.UNDECIDED, reason=f"loads contradict each other: {why}")


def decide(value: Estimate, limit: Estimate, sense: Sense) -> Verdict:
    """Pass or fail when the whole bar lies on one side; a value that equals the limit without a bar passes."""
    sound, bad = sides(value, limit, sense)
    return Verdict.PASS if sound else Verdict.FAIL if bad else Verdict.UNDECIDED


def sides(value: Estimate, limit: Estimate, sense: Sense) -> tuple[bool, bool]:
    """Whether the whole bar lies on the sound side, and whether on the other."""
    if sense is Sense.AT_LEAST:
        return value.low >= limit.high, value.high < limit.low
    return value.high <= limit.low, value.low > limit.high
