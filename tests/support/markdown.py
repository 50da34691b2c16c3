"""Markdown cases: every ```yaml block is a design file; a trailing comment states what its line must be blamed for.

    friction: 0.10   # fail CNV101 [start_loaded]

means: CNV101 fails in that scene (in any scene without the bracket) and blames this line. `# pass CNV101` states
a pass and no line. A block without such a comment must pass as a whole. `check` and `ptmcalc` do the rest.

The first block of a page may leave assumed values to the program, which tries both ends of their intervals; the others
declare them, for each end is one more run.
"""

import re
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import pytest

from ptmcalc.contract.report import FileReport
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import load_text

_BLOCK = re.compile(r"^```yaml\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_EXPECTED = re.compile(r"#\s*(pass|fail|undecided|not_checked|error|warning)\s+([A-Z]{3}[0-9]{3})(?:\s+\[([^\]]+)\])?")


class MarkdownFile(pytest.File):
    def collect(self) -> Iterator["MarkdownCase"]:
        text, met = self.path.read_text("utf-8"), Counter[str]()
        for match in _BLOCK.finditer(text):
            headings = re.findall(r"^#+ (.*)$", text[: match.start()], re.MULTILINE)
            name = headings[-1] if headings else "case"
            met[name] += 1  # several processes run one test of each name
            numbered = f"{name} ({met[name]})" if met[name] > 1 else name
            yield MarkdownCase.from_parent(self, name=numbered, block=match[1])


class MarkdownCase(pytest.Item):
    def __init__(self, *, block: str, **kwargs: object) -> None:
        super().__init__(**kwargs)  # type: ignore[arg-type]
        self.block = block

    def runtest(self) -> None:
        report = check(load_text(self.block.encode(), self.path.name), Options(repairs=False))
        expected = list(_expected(self.block))
        missing = [entry for entry in expected if not _found(report, *entry)]
        if missing or (not expected and report.verdict != "pass"):
            raise MismatchError(f"expected {missing or 'a pass'}\nfound:\n" + "\n".join(_all(report)))

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException]) -> str:
        if isinstance(excinfo.value, MismatchError):
            return str(excinfo.value)
        return str(super().repr_failure(excinfo))

    def reportinfo(self) -> tuple[Path, int, str]:
        return self.path, 0, self.name


class MismatchError(AssertionError):
    """The report does not say what the case states."""


def _expected(block: str) -> Iterator[tuple[int, str, str, str]]:
    for number, line in enumerate(block.splitlines(), 1):
        for match in _EXPECTED.finditer(line):
            yield number, match[1], match[2], match[3] or ""


def _found(report: FileReport, line: int, verdict: str, code: str, scene: str) -> bool:
    if verdict in ("error", "warning"):
        return any(
            d.code == code and d.severity == verdict and d.span and d.span.line == line for d in report.diagnostics
        )
    return any(
        judgement.code == code
        and judgement.verdict == verdict
        and scene in ("", one.name)
        and (verdict == "pass" or judgement.blame.span.line == line)
        for one, judgement in report.judgements
    )


def _all(report: FileReport) -> Iterator[str]:
    for d in report.diagnostics:
        yield f"line {d.span.line if d.span else '?'}: {d.severity.value} {d.code} {d.message}"
    for scene, j in report.judgements:
        yield f"line {j.blame.span.line}: {j.verdict.value} {j.code} [{scene.name}] {j.reason}"
