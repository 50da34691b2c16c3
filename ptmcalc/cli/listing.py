"""What the commands besides `check` print."""

import inspect
import re
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from shutil import get_terminal_size
from typing import Any

from ptmcalc.base.errors import UsageError
from ptmcalc.base.units import TIME, show
from ptmcalc.cli.output import say
from ptmcalc.contract.effect import EffectState
from ptmcalc.contract.machine import AnyKind
from ptmcalc.contract.report import FileReport, exit_status
from ptmcalc.engine.check import Options, chosen_scenes
from ptmcalc.engine.forecast import Foreseen, foresee
from ptmcalc.engine.load import Loaded, load_file, load_text
from ptmcalc.engine.plan import ScenePlan, plan
from ptmcalc.engine.registry import kind_names, load_kind
from ptmcalc.engine.widen import absent
from ptmcalc.report import Format, json, render, words
from ptmcalc.report.table import listing
from ptmcalc.spec.machine import MachineSpec
from ptmcalc.spec.shape import did_you_mean

Row = dict[str, Any]


def listed(columns: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    return listing(columns, rows, width=get_terminal_size((120, 40)).columns)


def _loaded(path: str, options: Options) -> Loaded:
    return load_file(Path(path), Path(path).as_posix(), options.effects, options.accuracy)


def _reported(loaded: Loaded) -> int:
    """Prints what is wrong with a file that could not be loaded."""
    report = FileReport(loaded.document.name, diagnostics=loaded.diagnostics)
    say(render(Format.PLAIN, [report]), err=True)
    return exit_status((report,))


# -- plan -----------------------------------------------------------------------------------------------------------


def show_plan(paths: Sequence[str], options: Options, as_json: bool) -> int:
    """Print the plans of some files; the exit status."""
    status, rows, tables = 0, [], []
    for path in paths:
        loaded = _loaded(path, options)
        if loaded.kind is None or loaded.spec is None:
            status = max(status, _reported(loaded))
            continue
        made = plan(loaded.kind, loaded.spec, chosen_scenes(loaded.spec, options.scenes))
        for scene, coming in zip(made.scenes, foresee(made), strict=True):
            found = list(_plan_rows(loaded.spec, scene, coming))
            rows += [{"path": path} | row | {"criterion": json.criterion(row["criterion"])} for row in found]
            tables.append(_planlisted(path, found))
    say(json.rows(rows) if as_json else "\n".join(tables))
    return status


def _planlisted(path: str, rows: Sequence[Row]) -> str:
    """The effects of one scene under the solver it comes to."""
    first = rows[0]
    about = show(first["predicted_seconds"], TIME, 2)
    title = f"{words.printable(path)}  {first['scene']}: {first['solver']}, predicted {about}\n"
    columns = ("effect", "will be", "number", "meaning")
    cells = [_plan_cells(row) for row in rows if row["effect"] and not row["absent"]]
    return title + (listed(columns, cells) if cells else "")


def _plan_rows(spec: MachineSpec, scene: ScenePlan, coming: Foreseen) -> Iterator[Row]:
    """A row per effect, with the solver that the ladder comes to; cheap runs are made to see how far."""
    common = {
        "scene": scene.scene.label,
        "solver": coming.rungs[-1].solver.name if coming.rungs else "none",
        "predicted_seconds": coming.seconds,
    }
    for planned in scene.effects:
        carried = planned.effect.name in coming.carried
        state = EffectState.SIMULATED if carried else EffectState.BOUNDED if planned.active else EffectState.SKIPPED
        yield common | {
            "effect": planned.effect.name,
            "state": state.value,
            "forced": planned.forced,
            "criterion": planned.criterion,
            "absent": absent(planned, spec, scene, coming.settled.estimates, coming.carried),
        }
    if not scene.effects:
        yield common | {"effect": None, "state": None, "forced": False, "criterion": None, "absent": False}


def _plan_cells(row: Row) -> list[str]:
    number = row["criterion"]
    return [
        row["effect"],
        row["state"] + (" (forced)" if row["forced"] else ""),
        words.compared(number) if number else "",
        number.meaning if number else "",
    ]


# -- schema, kinds, solvers -----------------------------------------------------------------------------------------


def json_schema(kind: str) -> str:
    """JSON Schema of one kind, or of any design file."""
    chosen = [kind] if kind else list(kind_names())
    manifests = [one for name in chosen for one in load_kind(name).manifests]
    names = [one.label.replace(" ", ".") for one in manifests]
    schemas = [one.spec.model_json_schema() for one in manifests]
    top: Row = {"$schema": "https://json-schema.org/draft/2020-12/schema"}
    if len(schemas) == 1:
        return json.dump(top | schemas[0])
    definitions: Row = {}
    for name, one in zip(names, schemas, strict=True):
        inner = {f"{name}.{key}": value for key, value in one.pop("$defs", {}).items()}
        definitions |= {key: _renamed(value, name) for key, value in inner.items()}
        definitions[name] = _renamed(one, name)
    return json.dump(top | {"oneOf": [{"$ref": f"#/$defs/{name}"} for name in names], "$defs": definitions})


def _renamed(node: Any, kind: str) -> Any:
    """A schema whose references point at definitions of its own kind."""
    if isinstance(node, dict):
        return {
            key: re.sub("^#/\\$defs/", f"#/$defs/{kind}.", value) if key == "$ref" else _renamed(value, kind)
            for key, value in node.items()
        }
    if isinstance(node, list):
        return [_renamed(item, kind) for item in node]
    return node


def show_kinds(as_json: bool) -> str:
    """The list of kinds."""
    kinds = [load_kind(name) for name in kind_names()]
    rows = [
        {"kind": kind.name, "title": kind.title} | ({"types": [one.type for one in kind.types]} if kind.types else {})
        for kind in kinds
    ]
    if as_json:
        return json.rows(rows)
    cells = [(kind.name, ", ".join(one.type for one in kind.types), kind.title) for kind in kinds]
    return listed(("kind", "types", "what it checks"), cells)


def starting_file(kind: str, type_of_it: str) -> str:
    """A commented design file to start from: of a type of the kind, of its first one when none is named.

    Raises:
        UsageError: the kind has no such type.
    """
    chosen = load_kind(kind)
    types = {one.type: one for one in chosen.types}
    if type_of_it and type_of_it not in types:
        if not types:
            raise UsageError(f"a {kind} is of no type", f"write `ptmcalc new {kind}`")
        raise UsageError(f"unknown type of {kind}: `{type_of_it}`", did_you_mean(type_of_it, types, "types: "))
    shown = types.get(type_of_it, chosen)
    others = [name for name in types if name != (type_of_it or next(iter(types)))]
    if not others or type_of_it:
        return shown.template
    commands = ", ".join(f"`ptmcalc new {kind} {name}`" for name in others)
    return f"# The first of several types of {kind}; the others: {commands}\n{shown.template}"


def show_solvers(kind: str, as_json: bool) -> str:
    """The list of solvers with their predicted cost on the kind's own template."""
    rows = [row for one in map(load_kind, [kind] if kind else kind_names()) for row in _solver_rows(one)]
    if as_json:
        return json.rows(rows)
    columns = (
        "kind",
        "scene",
        "solver",
        "fidelity",
        "simulated effects",
        "cost on template",
        "error",
        "source",
    )
    cells = [
        [
            f"{row['kind']} {row.get('type', '')}".strip(),
            row["scene"],
            row["solver"],
            row["fidelity"] + ("" if row["decides"] else ", shown only"),
            ", ".join(row["effects"]),
            show(row["predicted_seconds"], TIME, 2) if row["predicted_seconds"] is not None else "not valid there",
            row["error"],
            row["source"],
        ]
        for row in rows
    ]
    return listed(columns, cells)


def _solver_rows(kind: AnyKind) -> Iterator[Row]:
    if kind.types:
        for one in kind.types:
            yield from _solver_rows(one)
        return
    template = load_text(kind.template.encode(), kind.name).spec
    assert template is not None, "a template passes its own check"
    scenes = {type(scene): scene for scene in reversed(template.all_scenes)}
    for solver in kind.solvers:
        for scene_type in sorted(solver.scenes, key=lambda one: one.__name__):
            scene = scenes.get(scene_type)
            fits = scene is not None and solver.usable_for(template, scene)
            yield {
                "kind": kind.name,
                **({"type": kind.type} if kind.type else {}),
                "scene": scene_type.model_fields["type"].default,
                "solver": solver.name,
                "fidelity": solver.fidelity.value,
                "decides": solver.decides,
                "effects": sorted(solver.represents),
                "predicted_seconds": solver.cost(template, scene, solver.represents, 0) if fits else None,
                "error": _part(solver.run, "Error"),
                "source": solver.source,
            }


def _part(function: Any, name: str) -> str:
    """One marked paragraph of a docstring on one line."""
    text = inspect.cleandoc(function.__doc__ or "")
    match = re.search(rf"\*\*{name}\*\*(.*?)(?=\*\*[A-Z]|\Z)", text, re.DOTALL)
    return " ".join(match[1].split()) if match else ""
