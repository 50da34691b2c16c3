"""`ptmcalc`: the commands and their options."""

import os
import sys
from pathlib import Path
from typing import Annotated

import typer

from ptmcalc import __version__
from ptmcalc.base.diagnostic import Severity
from ptmcalc.base.errors import UsageError
from ptmcalc.cli.decode import decode
from ptmcalc.cli.options import (
    AccuracyOption,
    BudgetOption,
    CheckFormat,
    CodesOption,
    ConfidenceOption,
    CostFormat,
    EffectsOption,
    ExcludeOption,
    ExecutorOption,
    ExplainFormat,
    GitignoreOption,
    JobsOption,
    KeysOption,
    LawOption,
    ListFormat,
    ListOption,
    RangesOption,
    RepairsOption,
    Sample,
    SampleOption,
    ScenesOption,
    ShardOption,
    StoreOption,
    StudyBudgetOption,
    StudyFormat,
    effects_of,
    format_and_file,
    history_files,
    seconds_of,
)
from ptmcalc.cli.output import say, say_all
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
    ledger: Annotated[
        bool,
        typer.Option(
            "--ledger", help="Change of a load without each effect near its threshold; with -v and --html too."
        ),
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

    files = [format_and_file(text) for text in output or ()]
    courses = history_files(history)
    if html:
        from ptmcalc.cli.pages import begin, write_pages

        begin(html, paths)
    choice = choice_of(select, ignore)
    counted = what_counts(choice, baseline, write_baseline, whole=not scene and not shard)
    terminal = sys.stdout.isatty()
    chosen = Format(form.value if form else CheckFormat.TABLE if terminal else CheckFormat.PLAIN)
    shapes = chosen is Format.TABLE and len(paths) == 1 and os.path.isfile(paths[0])  # of one file somebody looks at
    shown = (bool(history), shapes, bool(html), ledger or verbose or bool(html))
    asked = (tuple(scene or ()), accuracy, effects_of(effects), *shown)
    sought = ANY if store else choice  # what is kept serves every choice
    options = Options(*asked, seconds_of(budget), repairs, sought, run=not validate_only)
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

    options = Options(tuple(scene or ()), accuracy, effects_of(effects), repairs=False)
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
        show_plan(paths, Options(tuple(scene or ()), accuracy, effects_of(effects)), form == ListFormat.JSON)
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

    options = Options(tuple(scene or ()), "", effects_of(effects), budget=seconds_of(budget))
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
def improve(
    path: Annotated[str, typer.Argument(help="A design file.")],
    code: CodesOption = None,
    keys: KeysOption = "",
    scene: ScenesOption = None,
    accuracy: AccuracyOption = "",
    form: ListOption = ListFormat.TABLE,
) -> None:
    """Find what to change so that all failed and undecided checks pass: one key, or two, and what gets worse.

    Every value is put into the machine and checked. Limits, ratings, requirements and waiting times are not changed.
    Exit status: 0 if a key or a pair passes all and makes no other check fail, else 1; 2 wrong usage or an invalid
    file.
    """
    from ptmcalc.cli.improve import show_improvement

    as_json = form == ListFormat.JSON
    raise typer.Exit(show_improvement(path, tuple(scene or ()), code or (), keys, accuracy, as_json=as_json))


@app.command()
def sweep(
    path: Annotated[str, typer.Argument(help="A design file.")],
    vary: RangesOption = None,
    sample: SampleOption = Sample.GRID,
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

    options = Options(tuple(scene or ()), accuracy, effects_of(effects), repairs=False)
    means = Means(jobs, store, executor, seconds_of(budget))
    raise typer.Exit(show_sweep(path, options, means, vary or [], sample.value, points, seed, form.value))


@app.command()
def tolerances(
    path: Annotated[str, typer.Argument(help="A design file with `tolerances:`.")],
    samples: Annotated[int, typer.Option("--samples", help="Number of random machines.")] = 10_000,
    seed: Annotated[int, typer.Option("--seed", min=0, help="Seed of the random machines.")] = 0,
    confidence: ConfidenceOption = "95 %",
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

    options = Options(tuple(scene or ()), accuracy, effects_of(effects), repairs=False)
    means = Means(jobs, store, executor, seconds_of(budget))
    raise typer.Exit(show_tolerances(path, options, means, samples, seed, confidence, form.value))


@app.command()
def scale(
    path: Annotated[str, typer.Argument(help="A design file.")],
    length: Annotated[str, typer.Option("--length", help="Model to prototype, e.g. 1:10 or 0.1.")],
    law: LawOption,
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
