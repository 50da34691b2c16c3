"""What `ptmcalc sweep` and `tolerances` do: points by lanes, the rest as files of their own through the batch."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from shutil import get_terminal_size
from tempfile import TemporaryDirectory

import numpy as np

from ptmcalc.base import units
from ptmcalc.base.errors import UsageError
from ptmcalc.cli.batch import Run
from ptmcalc.cli.output import say
from ptmcalc.contract.report import FileReport, exit_status
from ptmcalc.contract.study import Points, Said
from ptmcalc.engine import sweep, tolerances
from ptmcalc.engine.batch import predicted
from ptmcalc.engine.check import Options, chosen_scenes
from ptmcalc.engine.load import Loaded, load_file
from ptmcalc.engine.points import Study
from ptmcalc.report import Format, render
from ptmcalc.report import study as report

_TRIED = 3
"""Points that are planned to see what one of them may take."""
_OPEN, _INTERRUPTED = 3, 130


@dataclass(frozen=True, slots=True)
class Means:
    """Who works on the points that need a file of their own, and how many predicted seconds that may take."""

    jobs: str = "auto"
    store: str = ""
    executor: str = "local"
    budget: float = 60.0


def show_sweep(
    path: str, options: Options, means: Means, vary: Sequence[str], sample: str, count: int | None, seed: int, form: str
) -> int:
    """Sweep a machine and print what was found; the exit status."""
    loaded = loaded_or_told(path, options)
    if isinstance(loaded, int):
        return loaded
    drawn = sample == "lhs"
    if not drawn and count is not None:
        raise UsageError("the keys define the number of points of a grid", "leave --points out, or add --sample lhs")
    if drawn and count is None:
        raise UsageError("a Latin hypercube needs to know how many points", "add e.g. --points 200")
    axes = sweep.axes(loaded, vary, counted=not drawn)
    values = sweep.hypercube(axes, count or 0, seed) if drawn else sweep.grid(axes)
    points = Points([one.key for one in axes], values)
    status, broken_off = computed(Study(loaded, points, options), means)
    turnings = [] if drawn else sweep.turnings(points, axes)
    if form == "json":
        pieces: Iterable[str] = report.sweep_json(points, turnings)
    elif form == "csv":
        pieces = report.sweep_csv(points)
    else:
        width = get_terminal_size((120, 40)).columns
        pieces = [report.sweep_table(path, points, list(sweep.lowest(points)), turnings, width)]
    for piece in pieces:
        say(piece)
    return told(points, status, broken_off, form)


def told(points: Points, status: int, broken_off: UsageError | None, form: str) -> int:
    """What has to be said of how it was computed, beside a document; the exit status."""
    for note in points.notes if form != "table" else ():
        say(f"ptmcalc: {note}\n", err=True)
    if broken_off is not None:
        raise broken_off
    return status


def show_tolerances(
    path: str, options: Options, means: Means, count: int, seed: int, confidence: str, form: str
) -> int:
    """Draw machines by the tolerances of a file and print how often they fail; the exit status."""
    sure = _confidence(confidence)
    loaded = loaded_or_told(path, options)
    if isinstance(loaded, int):
        return loaded
    points = tolerances.drawn(loaded, count, seed)
    status, broken_off = computed(Study(loaded, points, options), means)
    found = tolerances.risks(points, sure)
    if form == "json":
        say(report.risk_json(points, found, sure, seed))
    elif form == "csv":
        say(report.risk_csv(found))
    else:
        say(report.risk_table(path, points, found, sure, seed, get_terminal_size((120, 40)).columns))
    return told(points, status, broken_off, form)


def _confidence(text: str) -> float:
    try:
        value = units.read(text, units.SHARE)
    except units.UnitError as error:
        raise UsageError(f"--confidence: {error.reason}", error.hint) from None
    if not 0.5 <= value < 1:
        raise UsageError(f"--confidence: `{text}` is not from 50 % to below 100 %", "e.g. --confidence 95%")
    return round(value, 12)  # 95 %, not 95 times a hundredth


def loaded_or_told(path: str, options: Options) -> Loaded | int:
    """A design file; or, where it is none, the exit status behind what is wrong with it."""
    loaded = load_file(Path(path), Path(path).as_posix(), options.effects, options.accuracy)
    if loaded.kind is None or loaded.spec is None:
        problem = FileReport(loaded.document.name, diagnostics=loaded.diagnostics)
        say(render(Format.PLAIN, [problem]), err=True)
        return exit_status((problem,))
    chosen_scenes(loaded.spec, options.scenes)
    return loaded


def computed(study: Study, means: Means) -> tuple[int, UsageError | None]:
    """Compute all points, as far as the budget goes; the exit status, and what broke it off for good."""
    study.run_by_lanes()
    left, points = means.budget, study.points
    for labels, where in study.open_points():
        options = Options(labels, study.options.accuracy, study.options.effects, repairs=False)
        tried = where[:: max(len(where) // _TRIED, 1)][:_TRIED]
        seconds = sum(predicted(study.text_of(index), options) for index in tried) / len(tried)
        chosen = where[: int(left / seconds)]
        left -= seconds * len(chosen)
        if len(chosen) < len(where):
            points.notes.append(
                f"{len(chosen)} of {len(where)} open points are computed one by one in {', '.join(labels)}: each is"
                f" predicted to take {seconds:.2g} s, all {seconds * len(where):.3g} s; --budget sets the limit"
            )
        if chosen.size:
            interrupted, broken_off = _by_files(study, labels, chosen, options, means)
            if interrupted:
                return _INTERRUPTED, broken_off
    verdicts = points.worst()
    return _OPEN if np.any((verdicts == Said.UNDECIDED) | (verdicts == Said.NOT_COMPUTED)) else 0, None


def _by_files(
    study: Study, labels: tuple[str, ...], where: Iterable[int], options: Options, means: Means
) -> tuple[bool, UsageError | None]:
    """Points as design files of their own; whether that was interrupted, and what broke it off for good."""
    with TemporaryDirectory(prefix="ptmcalc-") as folder:
        files = []
        for index in where:
            files.append(Path(folder) / f"{index}.yaml")
            files[-1].write_bytes(study.text_of(index))
        with Run(options, means.jobs, means.store, in_json=False, executor=means.executor) as run:
            for one in run.batch(files, ()):
                study.take(int(Path(one.path).stem), one, labels)
            return run.interrupted, run.broken_off
