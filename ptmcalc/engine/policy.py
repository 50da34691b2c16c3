"""Which findings count in a run, chosen by code. Nothing vanishes without being counted."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from ptmcalc.base.diagnostic import Severity
from ptmcalc.contract.report import FileReport


@dataclass(frozen=True, slots=True)
class Choice:
    """Prefixes of codes that count, all when there are none, and of those that do not; the longer prefix wins."""

    select: tuple[str, ...] = ()
    ignore: tuple[str, ...] = ()

    def takes(self, code: str) -> bool:
        """Whether findings of a code count."""
        chosen = _longest(code, self.select or ("",))
        return chosen is not None and chosen > (-1 if (left := _longest(code, self.ignore)) is None else left)


ANY = Choice()


def _longest(code: str, prefixes: Iterable[str]) -> int | None:
    return max((len(prefix) for prefix in prefixes if code.startswith(prefix)), default=None)


def chosen(reports: Sequence[FileReport], choice: Choice) -> Sequence[FileReport]:
    """The reports without what does not count, of which they keep the number; what makes a file invalid always does."""
    return _Chosen(reports, choice) if choice.select or choice.ignore else reports


class _Chosen(Sequence[FileReport]):
    """Reports that lose what does not count when they are looked at: of a batch not all are in memory at once."""

    def __init__(self, reports: Sequence[FileReport], choice: Choice) -> None:
        self._reports, self._choice = reports, choice

    def __len__(self) -> int:
        return len(self._reports)

    def __getitem__(self, index):  # type: ignore[no-untyped-def]
        if isinstance(index, slice):
            return _Chosen(self._reports[index], self._choice)
        return _without(self._reports[index], self._choice)


def _without(report: FileReport, choice: Choice) -> FileReport:
    said = tuple(d for d in report.diagnostics if d.severity is Severity.ERROR or choice.takes(d.code))
    scenes = tuple(
        replace(scene, checks=tuple(one for one in scene.checks if choice.takes(one.code))) for scene in report.scenes
    )
    checks = sum(len(old.checks) - len(new.checks) for old, new in zip(report.scenes, scenes, strict=True))
    ignored = report.ignored + len(report.diagnostics) - len(said) + checks
    without = report.ignored_checks + checks
    return replace(report, diagnostics=said, scenes=scenes, ignored=ignored, ignored_checks=without)
