"""What `ptmcalc cost` prints."""

from collections.abc import Sequence
from pathlib import Path
from shutil import get_terminal_size

from ptmcalc.base import units
from ptmcalc.base.errors import UsageError
from ptmcalc.cli.output import say
from ptmcalc.contract.cost import CostReport, Held
from ptmcalc.contract.report import FileReport, exit_status
from ptmcalc.engine.check import Options, chosen_scenes
from ptmcalc.engine.cost import ACCURACIES, cost
from ptmcalc.engine.files import design_files
from ptmcalc.engine.load import load_file
from ptmcalc.report import Format, render, work_precision
from ptmcalc.report import cost as report

SPECS = "specs"


def show_cost(
    paths: Sequence[str], options: Options, accuracies: Sequence[str], *, form: str, plot: str, summary: bool
) -> int:
    """Measure some files and print what their accuracy costs; the exit status."""
    if plot and Path(plot).suffix.lower() not in (".html", ".htm"):
        raise UsageError(f"`--plot {plot}` is not a page", "name a file that ends in .html")
    asked = [_accuracy(text) for text in accuracies] or list(ACCURACIES)
    files = _files(paths or ([SPECS] if summary else []))
    if not files:
        raise UsageError("no design file is named", "e.g. `ptmcalc cost specs/conveyor.yaml`, or `ptmcalc cost --all`")
    if plot and len(files) > 1:
        raise UsageError("one page shows one machine", "name one file with `--plot`")
    status, found = 0, list[CostReport]()
    for file in files:
        loaded = load_file(file, file.as_posix(), options.effects)
        if loaded.kind is None or loaded.spec is None:
            problem = FileReport(loaded.document.name, diagnostics=loaded.diagnostics)
            say(render(Format.PLAIN, [problem]), err=True)
            status = max(status, exit_status((problem,)))
            continue
        scenes = chosen_scenes(loaded.spec, options.scenes)
        found.append(cost(file.as_posix(), loaded.kind, loaded.spec, scenes, budget=options.budget, accuracies=asked))
    if plot and found:
        _write(Path(plot), work_precision.render(found[0]))
    if found:
        say(_text(found, form, summary))
    if any(one.held is Held.NO for each in found for one in each.settings):
        status = max(status, 1)
    return status


def _text(found: Sequence[CostReport], form: str, summary: bool) -> str:
    width = get_terminal_size((120, 40)).columns
    if form == "json":
        return report.document(found)
    if form == "markdown":
        return report.markdown(found)
    if summary:
        return report.overview(found, width)
    return "\n".join(report.table(one, width) for one in found)


def _files(paths: Sequence[str]) -> list[Path]:
    files: list[Path] = []
    for path in map(Path, paths):
        files += design_files(path) if path.is_dir() else [path]
    return files


def _accuracy(text: str) -> float:
    try:
        value = units.read(text, units.SHARE)
    except units.UnitError as error:
        raise UsageError(f"--accuracy: {error.reason}", error.hint) from None
    if not 0 < value <= 1:
        raise UsageError(f"--accuracy: `{text}` is not between 0 and 100 %", "e.g. --accuracy 1%")
    return value


def _write(path: Path, text: str) -> None:
    try:
        path.write_text(text, encoding="utf-8")
    except OSError as error:
        raise UsageError(f"cannot write `{path}`: {error.strerror}") from None
