"""`ptmcalc`: the commands and their options."""

import copy
import os
import sys
from collections.abc import Sequence
from enum import StrEnum
from pathlib import Path
from typing import Annotated, NoReturn

import typer

from ptmcalc import __version__
from ptmcalc.base.diagnostic import Severity
from ptmcalc.base.errors import UsageError
from ptmcalc.base.words import shown
from ptmcalc.cli.decode import decode
from ptmcalc.cli.output import is_full, let_go_of_all, say, say_all, steady_streams
from ptmcalc.cli.policy import (
    BaselineOption,
    ExitZeroOption,
    IgnoreOption,
    SelectOption,
    WriteOption,
    choice_of,
    what_counts,
)

app = typer.Typer(
    name="ptmcalc",
    help="Design check for material-handling machines: dynamic loads and pass/fail checks from a YAML description.",
    no_args_is_help=True,
    rich_markup_mode=None,  # help as plain text: the frames would import three times as much as all of typer
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 120},
)

app.command()(decode)

EXIT_USAGE, EXIT_BUG = 2, 4
_IN_JSON = "json"


class CheckFormat(StrEnum):
    """Formats of `check`."""

    TABLE = "table"
    PLAIN = "plain"
    JSON = "json"
    JUNIT = "junit"
    SARIF = "sarif"
    GITHUB = "github"
    MARKDOWN = "markdown"
    SUMMARY = "summary"
    CSV = "csv"


class ListFormat(StrEnum):
    """Formats of the commands that answer with rows."""

    TABLE = "table"
    JSON = "json"


class CostFormat(StrEnum):
    """Formats of `cost`."""

    TABLE = "table"
    JSON = "json"
    MARKDOWN = "markdown"


class StudyFormat(StrEnum):
    """Formats of the commands that compute many points."""

    TABLE = "table"
    JSON = "json"
    CSV = "csv"


class Sample(StrEnum):
    """How the points of a sweep are chosen."""

    GRID = "grid"
    LHS = "lhs"


class ExplainFormat(StrEnum):
    """Formats of `explain`."""

    TEXT = "text"
    MARKDOWN = "markdown"


class Law(StrEnum):
    """Laws of similarity of `scale`."""

    FULL = "full"
    GEOMETRIC = "geometric"
    BALLAST = "ballast"


ScenesOption = Annotated[list[str] | None, typer.Option("--scene", help="Only this scene; may be repeated.")]
AccuracyOption = Annotated[str, typer.Option("--accuracy", help="Relative error of the governing loads, e.g. 1%.")]
BudgetOption = Annotated[str, typer.Option("--budget", help="Maximum predicted time of a scene, e.g. 2s.")]
EffectsOption = Annotated[
    list[str] | None,
    typer.Option("--effects", help="NAME=on|off|auto; overrides the setting of the file; may be repeated."),
]
ExcludeOption = Annotated[
    list[str] | None,
    typer.Option("--exclude", metavar="PATTERN", help="Exclude files by a .gitignore pattern; may be repeated."),
]
GitignoreOption = Annotated[
    bool, typer.Option("--gitignore/--no-gitignore", help="Exclude the files that .gitignore excludes.")
]
JobsOption = Annotated[
    str,
    typer.Option(
        "--jobs", "-j", metavar="auto|N", help="Number of processes; auto: all cores if the work justifies them."
    ),
]
ShardOption = Annotated[
    str,
    typer.Option("--shard", metavar="I/N", help="Check every N-th file from the I-th; `merge` combines the reports."),
]
StoreOption = Annotated[
    str,
    typer.Option("--store", metavar="FILE", help="Store results there; reuse the results of unchanged files."),
]
ExecutorOption = Annotated[
    str,
    typer.Option(
        "--executor",
        metavar="local|dask://HOST:PORT",
        help="Workers: local processes, or a cluster of dask.",
    ),
]
StudyBudgetOption = Annotated[
    str, typer.Option("--budget", help="Maximum predicted time of all points that require separate runs, e.g. 5min.")
]
RepairsOption = Annotated[
    bool, typer.Option("--repairs/--no-repairs", help="Compute the value at which a failed check would pass.")
]
ListOption = Annotated[ListFormat, typer.Option("--format", help="Output format.")]


def main() -> None:
    """Entry point: maps what can go wrong to exit statuses."""
    try:
        steady_streams()
        sys.argv[1:] = history_with_its_value(sys.argv[1:])
        _with_one_command(sys.argv[1:])()
    except UsageError as error:
        _fail(error)
    except KeyboardInterrupt:
        sys.exit(130)
    except Exception as error:
        if isinstance(error, OSError) and is_full(error):  # help and usage are printed by typer
            say(f"ptmcalc: cannot write: {error.strerror}\n", err=True)
            let_go_of_all()
            sys.exit(EXIT_USAGE)
        if os.environ.get("PTMCALC_TRACEBACK"):
            raise
        say(
            f"ptmcalc: internal error: {type(error).__name__}: {shown(str(error))}\n"
            "This is an error of ptmcalc, not of the file. Please report it with the file and the output of the same"
            " command under PTMCALC_TRACEBACK=1.\n",
            err=True,
        )
        sys.exit(EXIT_BUG)


def _with_one_command(words: Sequence[str]) -> typer.Typer:
    """The command line with the command that is called alone: typer reads the options of every one it has."""
    called = [one for one in app.registered_commands if one.callback and [one.callback.__name__] == list(words[:1])]
    if not called:
        return app
    alone = copy.copy(app)
    alone.registered_commands = called
    return alone


def history_with_its_value(words: list[str]) -> list[str]:
    """The words of a command line in which `--history`, whose value may be left out, always has one.

    A word behind it that ends in .csv is the file to write; anything else is a path to check. Behind `--` no word is
    an option.
    """
    rewritten: list[str] = []
    options, alone = True, False
    for word in words:
        options = options and word != "--"
        if options and alone and is_csv(word):
            rewritten[-1] = f"--history={word}"
            alone = False
        else:
            alone = options and word == "--history"
            rewritten.append(f"--history={_IN_JSON}" if alone else word)
    return rewritten


def _fail(error: UsageError) -> NoReturn:
    say(f"ptmcalc: {shown(error.message)}" + (f" ({shown(error.hint)})" if error.hint else "") + "\n", err=True)
    sys.exit(EXIT_USAGE)


def _version(wanted: bool) -> None:
    if wanted:
        say(f"ptmcalc {__version__}\n")
        raise typer.Exit


@app.callback()
def common(
    context: typer.Context,
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Show the version.")
    ] = False,
) -> None:
    """Options before the command."""
    if context.invoked_subcommand == "check":
        from ptmcalc.cli.defaults import defaults

        context.default_map = {"check": defaults(Path.cwd())}


@app.command()
def check(
    paths: Annotated[
        list[str],
        typer.Argument(help="Design files, folders of them, patterns such as 'specs/**/*.yaml', and - for a list."),
    ],
    form: Annotated[
        CheckFormat | None,
        typer.Option("--format", help="Output format; a table on a terminal, otherwise plain lines."),
    ] = None,
    output: Annotated[
        list[str] | None,
        typer.Option("--output", "-o", help="FORMAT=FILE, in addition to the printed report; may be repeated."),
    ] = None,
    verbose: Annotated[
        bool,
        typer.Option("--verbose", "-v", help="The complete table: every load, check, effect, event and run."),
    ] = False,
    scene: ScenesOption = None,
    accuracy: AccuracyOption = "",
    effects: EffectsOption = None,
    budget: BudgetOption = "60 s",
    repairs: RepairsOption = True,
    validate_only: Annotated[
        bool, typer.Option("--validate-only", help="Read and validate the files without a computation.")
    ] = False,
    history: Annotated[
        list[str] | None,
        typer.Option(
            "--history",
            metavar="[FILE.csv]",
            help="Loads over time: in the JSON, and in a named CSV file; may be repeated.",
        ),
    ] = None,
    html: Annotated[
        str,
        typer.Option(
            "--html",
            metavar="PATH",
            help="Pages with figures: FILE.html for one design file, a folder with an index for any number.",
        ),
    ] = "",
    fail_level: Annotated[
        Severity, typer.Option("--fail-level", help="Findings from this severity up make the exit status 1.")
    ] = Severity.ERROR,
    select: SelectOption = None,
    ignore: IgnoreOption = None,
    baseline: BaselineOption = "",
    write_baseline: WriteOption = "",
    exit_zero: ExitZeroOption = False,
    exclude: ExcludeOption = None,
    gitignore: GitignoreOption = True,
    jobs: JobsOption = "auto",
    shard: ShardOption = "",
    store: StoreOption = "",
    executor: ExecutorOption = "local",
) -> None:
    """Check design files: loads, verdicts, and values at which failed checks would pass.

    Exit status: 0 all pass, 1 a check failed, 2 wrong usage or an invalid file, 3 undecided, 4 a program error.
    """
    if jobs.isdecimal() and int(jobs) > 1 and executor == "local" and not os.path.exists(store):
        from ptmcalc.cli import processes

        processes.begin(paths)
    from ptmcalc.cli.batch import Run, rendered, tallies_of, write
    from ptmcalc.contract.report import status_at
    from ptmcalc.engine.check import Options
    from ptmcalc.engine.policy import ANY
    from ptmcalc.report import Format
    from ptmcalc.report.json import RunInfo

    files = [_target(text) for text in output or ()]
    courses = _history_files(history)
    if html:
        from ptmcalc.cli.pages import begin, write_pages

        begin(html, paths)
    choice = choice_of(select, ignore)
    counted = what_counts(choice, baseline, write_baseline, whole=not scene and not shard)
    terminal = sys.stdout.isatty()
    chosen = Format(form.value if form else CheckFormat.TABLE if terminal else CheckFormat.PLAIN)
    shapes = chosen is Format.TABLE and len(paths) == 1 and os.path.isfile(paths[0])  # of one file somebody looks at
    asked = (tuple(scene or ()), accuracy, _effects(effects), bool(history), shapes, bool(html))
    sought = ANY if store else choice  # what is kept serves every choice
    options = Options(*asked, _budget(budget), repairs, sought, run=not validate_only)
    forms = {chosen, *(target for target, _ in files)}
    in_json, counts_all = Format.JSON in forms, not (select or ignore or baseline or write_baseline)
    whole = forms != {Format.JSON} or bool(courses or html) or not counts_all
    with Run(options, jobs, store, in_json=in_json, whole=whole, executor=executor) as run:
        reports = counted(run.reports(paths, exclude or (), shard, gitignore=gitignore))
        info = RunInfo(shard or None, run.files, fail_level.value, run.left_out, not run.interrupted)
        for target, name in files if not run.interrupted else ():
            write(Path(name), rendered(Format(target), reports, verbose, to_terminal=False, run=info))
        if courses and not run.interrupted:
            from ptmcalc.report import histories

            for name in courses:
                write(Path(name), [histories.render(reports)])
        if html and not run.interrupted:
            write_pages(html, reports, run.processes(len(reports)))
        as_it_is = chosen in (Format.GITHUB, Format.JSON)
        say_all(rendered(chosen, reports, verbose, to_terminal=terminal, run=info), as_it_is=as_it_is)
        if history and not courses and not in_json:
            say("ptmcalc: a history is in the JSON (--format json) or in a file (--history FILE.csv)\n", err=True)
        tallies = list(tallies_of(reports))
    if tallies and all(one.unchosen for one in tallies):
        say("ptmcalc: --select and --ignore exclude all checks; nothing was checked\n", err=True)
    elif unchosen := sum(one.unchosen for one in tallies):
        files_are = "1 file has" if unchosen == 1 else f"{unchosen} files have"
        say(f"ptmcalc: {files_are} no check that --select and --ignore leave\n", err=True)
    status = status_at(tallies, fail_level)
    if run.broken_off is not None:
        raise run.broken_off
    if run.interrupted:
        raise typer.Exit(130)
    raise typer.Exit(0 if exit_zero and status in (1, 3) else status)


def _target(text: str) -> tuple[str, str]:
    form, separator, name = text.partition("=")
    if not separator or not name or form not in list(CheckFormat):
        raise UsageError(f"`{text}` is not FORMAT=FILE", f"formats: {', '.join(CheckFormat)}")
    return form, name


def _history_files(given: list[str] | None) -> list[str]:
    for text in given or ():
        if text != _IN_JSON and not is_csv(text):
            raise UsageError(f"`--history={text}` names no .csv file", "write `--history`, or `--history FILE.csv`")
    return [text for text in given or () if text != _IN_JSON]


def is_csv(name: str) -> bool:
    """Whether a word names a CSV file."""
    return name.lower().endswith(".csv")


def _effects(given: list[str] | None) -> dict[str, str]:
    chosen = {}
    for text in given or ():
        name, separator, wish = text.partition("=")
        if not separator or wish not in ("on", "off", "auto"):
            raise UsageError(f"`{text}` is not NAME=on|off|auto", "e.g. --effects sag=off")
        chosen[name] = wish
    return chosen


def _budget(text: str) -> float:
    """Seconds of a budget."""
    from ptmcalc.base import units

    try:
        seconds = units.read(text, units.TIME)
    except units.UnitError as error:
        raise UsageError(f"--budget: {error.reason}", error.hint) from None
    if seconds < 0:
        raise UsageError(f"--budget: `{text}` is negative", "e.g. --budget 2s")
    return seconds


@app.command()
def merge(
    parts: Annotated[list[str], typer.Argument(help="JSON reports of the shards of a run, or their stores.")],
    output: Annotated[
        str, typer.Option("--output", "-o", metavar="FILE", help="Output file; without it a report is printed.")
    ] = "",
) -> None:
    """Combine the JSON reports, or the stores, of the shards of a run.

    Exit status: that of the combined report, as for `check`; 0 for stores.
    """
    from ptmcalc.cli.merge import united

    raise typer.Exit(united(parts, output))


@app.command()
def diff(
    old: Annotated[str, typer.Argument(help="Previous state: a design file, a folder of them, or a JSON report.")],
    new: Annotated[str, typer.Argument(help="Present state.")],
    form: Annotated[
        CostFormat, typer.Option("--format", help="Output format; markdown is a comment on a pull request.")
    ] = CostFormat.TABLE,
    scene: ScenesOption = None,
    accuracy: AccuracyOption = "",
    effects: EffectsOption = None,
    repairs: RepairsOption = True,
    jobs: JobsOption = "auto",
    store: StoreOption = "",
) -> None:
    """Show the changes between two states: verdicts, and loads relative to their error bars.

    Exit status: 0 nothing is worse, 1 a verdict is worse, 2 wrong usage or an invalid new file, 4 a program error.
    """
    from ptmcalc.cli.diff import show_diff
    from ptmcalc.engine.check import Options

    options = Options(tuple(scene or ()), accuracy, _effects(effects), repairs=False)
    raise typer.Exit(show_diff(old, new, options, jobs, store, form.value, repairs=repairs))


@app.command()
def plan(
    paths: Annotated[list[str], typer.Argument(help="Design files.")],
    form: ListOption = ListFormat.TABLE,
    scene: ScenesOption = None,
    accuracy: AccuracyOption = "",
    effects: EffectsOption = None,
) -> None:
    """Show the effects required by each scene, their criteria and the predicted cost."""
    from ptmcalc.cli.listing import show_plan
    from ptmcalc.engine.check import Options

    raise typer.Exit(
        show_plan(paths, Options(tuple(scene or ()), accuracy, _effects(effects)), form == ListFormat.JSON)
    )


@app.command()
def cost(
    paths: Annotated[list[str] | None, typer.Argument(help="Design files, and folders of them.")] = None,
    form: Annotated[
        CostFormat, typer.Option("--format", help="Output format; markdown is a table with one line per file.")
    ] = CostFormat.TABLE,
    accuracy: Annotated[
        list[str] | None,
        typer.Option(
            "--accuracy", help="Accuracy for which the cost is measured; may be repeated. Default: 5 %, 1 % and 0.1 %."
        ),
    ] = None,
    plot: Annotated[str, typer.Option("--plot", metavar="FILE.html", help="Draw error against time as a page.")] = "",
    all_files: Annotated[
        bool, typer.Option("--all", help="One line per file; without a path all files in specs/.")
    ] = False,
    scene: ScenesOption = None,
    effects: EffectsOption = None,
    budget: Annotated[
        str, typer.Option("--budget", help="Maximum predicted time of one run of every setting of a file, e.g. 10s.")
    ] = "10 s",
) -> None:
    """Measure the cost of accuracy: every solver and setting with its time, error bar and true error.

    Errors are relative to a setting of another method, never of the same method. Exit status 1 if an error bar does not
    cover the true error.
    """
    from ptmcalc.cli.cost import show_cost
    from ptmcalc.engine.check import Options

    options = Options(tuple(scene or ()), "", _effects(effects), budget=_budget(budget))
    raise typer.Exit(show_cost(paths or [], options, accuracy or [], form=form.value, plot=plot, summary=all_files))


@app.command()
def explain(
    name: Annotated[
        str, typer.Argument(help="A code such as CNV101, or the name of an effect, a solver or a load.")
    ] = "",
    everything: Annotated[bool, typer.Option("--all", help="Explain every name: the handbook.")] = False,
    form: Annotated[ExplainFormat, typer.Option("--format", help="Output format.")] = ExplainFormat.TEXT,
    where: Annotated[
        bool, typer.Option("--where", help="Print file and line of its definition and of its functions instead.")
    ] = False,
) -> None:
    """Explain a check, an effect, a solver, a load or a finding: formula, symbols, range, error, source, example."""
    from ptmcalc.cli.explain import explanation, handbook

    if bool(name) == everything:
        raise UsageError("explain takes a name, or --all", "e.g. `ptmcalc explain CNV101`")
    if where:
        from ptmcalc.cli.where import whereabouts

        say(whereabouts(name))
        return
    say(handbook(form) if everything else explanation(name, form))


@app.command()
def schema(kind: Annotated[str, typer.Argument(help="Machine kind; default: all kinds.")] = "") -> None:
    """Print the JSON Schema of design files, for completion and checks in an editor."""
    from ptmcalc.cli.listing import json_schema

    say(json_schema(kind))


@app.command()
def new(
    kind: Annotated[str, typer.Argument(help="A kind of `ptmcalc kinds`.")],
    type_of_it: Annotated[
        str, typer.Argument(metavar="[TYPE]", help="Type of a kind with several types; default: the first type.")
    ] = "",
) -> None:
    """Print a commented design file as a starting point."""
    from ptmcalc.cli.listing import starting_file

    say(starting_file(kind, type_of_it))


@app.command()
def kinds(form: ListOption = ListFormat.TABLE) -> None:
    """List the kinds of machines."""
    from ptmcalc.cli.listing import show_kinds

    say(show_kinds(form == ListFormat.JSON))


@app.command()
def solvers(
    kind: Annotated[str, typer.Argument(help="Machine kind; default: all kinds.")] = "",
    form: ListOption = ListFormat.TABLE,
) -> None:
    """List the solvers: scene, simulated effects, predicted cost on the template of the kind, error, source."""
    from ptmcalc.cli.listing import show_solvers

    say(show_solvers(kind, form == ListFormat.JSON))


@app.command()
def solve(
    path: Annotated[str, typer.Argument(help="A design file.")],
    code: Annotated[str, typer.Option("--check", help="The check to be passed, e.g. CNV101.")],
    vary: Annotated[
        list[str],
        typer.Option(
            "--vary",
            metavar="KEY",
            help="The key to be varied, e.g. takeup.tension. A second one with values, e.g. 'belt.mass=10 kg/m:30"
            " kg/m:5', gives the curve on which the check just passes.",
        ),
    ],
    margin: Annotated[
        str, typer.Option("--margin", help="Required distance from the limit: a share of it, e.g. 10%, or in its unit.")
    ] = "",
    scene: Annotated[str, typer.Option("--scene", help="Only this scene; default: all scenes of the check.")] = "",
    form: ListOption = ListFormat.TABLE,
) -> None:
    """Find the value of one key at which a check just passes, its error bar included, and the other verdicts there.

    Exit status 1 if no value within three decades changes the verdict.
    """
    from ptmcalc.cli.solution import show_solution

    raise typer.Exit(show_solution(path, code, vary, scene, margin, as_json=form == ListFormat.JSON))


@app.command()
def sweep(
    path: Annotated[str, typer.Argument(help="A design file.")],
    vary: Annotated[
        list[str] | None,
        typer.Option(
            "--vary",
            metavar="KEY=FROM:TO:N",
            help="A key and its values, e.g. 'takeup.tension=20 kN:60 kN:21'; `:log` behind it for equal ratios; may be"
            " repeated. With --sample lhs KEY=FROM:TO.",
        ),
    ] = None,
    sample: Annotated[
        Sample, typer.Option("--sample", help="All combinations, or a Latin hypercube of --points points.")
    ] = Sample.GRID,
    points: Annotated[int | None, typer.Option("--points", help="Points of a Latin hypercube.")] = None,
    seed: Annotated[int, typer.Option("--seed", min=0, help="Seed of the random points.")] = 0,
    form: Annotated[StudyFormat, typer.Option("--format", help="Output format.")] = StudyFormat.TABLE,
    scene: ScenesOption = None,
    accuracy: AccuracyOption = "",
    effects: EffectsOption = None,
    budget: StudyBudgetOption = "60 s",
    jobs: JobsOption = "auto",
    store: StoreOption = "",
    executor: ExecutorOption = "local",
) -> None:
    """Vary keys of a machine: verdicts, margins and loads at every point, and the limits of the verdicts.

    Closed forms are computed for all points at once; other points are computed as a batch as far as the budget
    permits; the remaining points are reported as open. Exit status: 0 every point is decided, 2 wrong usage or an
    invalid file, 3 points are open, 4 a program error.
    """
    from ptmcalc.cli.study import Means, show_sweep
    from ptmcalc.engine.check import Options

    options = Options(tuple(scene or ()), accuracy, _effects(effects), repairs=False)
    means = Means(jobs, store, executor, _budget(budget))
    raise typer.Exit(show_sweep(path, options, means, vary or [], sample.value, points, seed, form.value))


@app.command()
def tolerances(
    path: Annotated[str, typer.Argument(help="A design file with `tolerances:`.")],
    samples: Annotated[int, typer.Option("--samples", help="Number of random machines.")] = 10_000,
    seed: Annotated[int, typer.Option("--seed", min=0, help="Seed of the random machines.")] = 0,
    confidence: Annotated[
        str,
        typer.Option(
            "--confidence", help="Confidence level of the intervals, and share of machines with the stated margin."
        ),
    ] = "95 %",
    form: Annotated[StudyFormat, typer.Option("--format", help="Output format.")] = StudyFormat.TABLE,
    scene: ScenesOption = None,
    accuracy: AccuracyOption = "",
    effects: EffectsOption = None,
    budget: StudyBudgetOption = "60 s",
    jobs: JobsOption = "auto",
    store: StoreOption = "",
    executor: ExecutorOption = "local",
) -> None:
    """Random machines by the tolerances of a file: probability of failure, governing keys and margin of each check.

    Probabilities have the interval of Clopper and Pearson, margins that of order statistics; a machine with an
    undecided verdict counts as neither, and the upper end assumes that all of them fail. Exit status: 0 every
    machine is decided, 2 wrong usage or an invalid file, 3 some are open, 4 a program error.
    """
    from ptmcalc.cli.study import Means, show_tolerances
    from ptmcalc.engine.check import Options

    options = Options(tuple(scene or ()), accuracy, _effects(effects), repairs=False)
    means = Means(jobs, store, executor, _budget(budget))
    raise typer.Exit(show_tolerances(path, options, means, samples, seed, confidence, form.value))


@app.command()
def scale(
    path: Annotated[str, typer.Argument(help="A design file.")],
    length: Annotated[str, typer.Option("--length", help="Model to prototype, e.g. 1:10 or 0.1.")],
    law: Annotated[
        Law, typer.Option("--law", help="Similarity of the model: full, without gravity, or gravity by ballast.")
    ],
    modulus: Annotated[str, typer.Option("--modulus", help="Elastic modulus, model to prototype.")] = "",
    density: Annotated[str, typer.Option("--density", help="Density of the material, model to prototype.")] = "",
    gravity: Annotated[str, typer.Option("--gravity", help="Gravity, model to prototype: a centrifuge.")] = "",
    scene: ScenesOption = None,
    form: ListOption = ListFormat.TABLE,
) -> None:
    """Show loads, frequencies and times of a scaled physical model of the machine, and the distorted quantities.

    Similarity laws: `full` is complete similarity with a matching material or gravity; `geometric` is a copy with
    gravity out of scale; `ballast` adds masses to the copy. An omitted ratio is 1; under `full` one of modulus,
    density and gravity follows from the others.
    """
    from ptmcalc.cli.scale import show_scale

    others = {"modulus": modulus, "density": density, "gravity": gravity}
    raise typer.Exit(show_scale(path, tuple(scene or ()), law, length, others, as_json=form == ListFormat.JSON))
