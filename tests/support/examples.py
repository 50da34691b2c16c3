"""The examples that `explain` shows, taken from one check of all design files of the project.

Of each name the first file and scene in which it occurs: a passed check before a failed one, a simulated effect before
one that is left out. A solver that no check comes to is shown by `cost`.
"""

import json
import math
import os
import re
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.effect import Criterion, EffectState
from ptmcalc.contract.example import EXAMPLES
from ptmcalc.contract.machine import AnyKind
from ptmcalc.contract.result import family
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import load_file, load_text
from ptmcalc.report import Format, render, words
from support.command import ROOT

Kept = tuple[str, str, str]
"""Command, line, and the design file where it is no file of the project."""

_NUMBER = re.compile(r"[0-9]+(?:\.[0-9]+)?(?:e[-+][0-9]+)?")

Said = dict[str, tuple[int, str, str]]
"""By name: how far it is from a good example, the command, and what is said."""

_STATES = {EffectState.SIMULATED.value: 0, EffectState.BOUNDED.value: 1, EffectState.SKIPPED.value: 2}


def from_checks(kind: AnyKind, files: Iterable[Mapping[str, Any]], lines: Iterable[str]) -> dict[str, Kept]:
    """Name, command and line, of all checks, effects, solvers and loads of a kind that occur in some files."""
    said: Said = {}
    plain = list(lines)
    ours = sorted((one for one in files if one["kind"] == kind.name), key=_plainest)
    for file in ours:
        path = _path(file)
        of_file = [line for line in plain if line.startswith(f"{path}:")]
        for scene in file["scenes"]:
            command = f"ptmcalc {{}} {path} --scene {scene['name']}"
            for name, far, verb, line in _of_scene(kind, scene, of_file):
                if name not in said or far < said[name][0]:
                    said[name] = (far, command.format(verb), line)
    found = {name: (command, line, "") for name, (_, command, line) in said.items()}
    return found | dict(_by_cost(kind, [_path(one) for one in ours], found))


def _plainest(file: Mapping[str, Any]) -> tuple[int, str]:
    path = _path(file)
    return path.count("/"), path


def _path(file: Mapping[str, Any]) -> str:
    path = Path(file["path"])
    return path.relative_to(ROOT).as_posix() if path.is_absolute() else path.as_posix()


def _of_scene(kind: AnyKind, scene: Mapping[str, Any], lines: Iterable[str]) -> Iterator[tuple[str, int, str, str]]:
    for one in scene["checks"]:
        verdict, mark = one["verdict"], f": {one['verdict']} {one['code']} "
        line = next((said for said in lines if mark in said and f" [{scene['name']}]" in said), None)
        if line is not None:
            yield one["code"], int(verdict != "pass"), "check", line
    for effect in scene["effects"]:
        if effect.get("absent"):
            continue  # no table lists it
        known = effect["criterion"] is not None and effect["criterion"]["value"] is not None
        number = Criterion(**effect["criterion"]) if known else None
        about = f", {words.compared(number)}: {number.meaning}" if number else ""
        yield effect["name"], _STATES[effect["state"]], "plan", f"{effect['name']} {effect['state']}{about}"
    for solver in scene["solvers"]:
        carried = ", ".join(solver["effects"]) or "no effect"
        yield solver["name"], 0, "check", f"{solver['name']} carries {carried}"
    infos = {info.name: info for info in kind.loads}
    for load in scene["loads"]:
        info = infos[family(load["name"])]
        if load["value"] is not None:
            known = None not in (load["low"], load["high"])
            one = Estimate(load["value"], load["low"], load["high"]) if known else Estimate.unknown(load["value"])
            shown = words.amount(one, info.quantity)
            yield info.name, int(not known), "check", f"{load['name']} {shown}, by {load['solver']}"


def _by_cost(kind: AnyKind, paths: list[str], found: Mapping[str, Any]) -> Iterator[tuple[str, Kept]]:
    """Solvers that are in no report: second methods, and settings that no verdict asked for."""
    for path in paths:
        loaded = load_file(ROOT / path, path)
        assert loaded.kind is not None
        assert loaded.spec is not None
        for solver in (*loaded.kind.solvers, *loaded.kind.reference_methods):
            for scene in loaded.spec.all_scenes if solver.name not in found else ():
                if solver.usable_for(loaded.spec, scene):
                    yield solver.name, (f"ptmcalc cost {path} --scene {scene.label}", "", "")
                    break


def names(kind: AnyKind) -> list[str]:
    """Everything of a kind that has a name, once."""
    solvers = [*kind.solvers, *(one for each in kind.manifests for one in each.reference_methods)]
    called = [check.code for check in kind.checks]
    called += [one.name for group in (kind.effects, solvers, kind.loads) for one in group]
    return list(dict.fromkeys(called))


def from_blocks(kind: AnyKind, wanted: Iterable[str], blocks: Iterable[str]) -> dict[str, Kept]:
    """Name, command, line and design file, of names that are in one of some design files."""
    left = set(wanted)
    found: dict[str, Kept] = {}
    for block in blocks:
        if not left:
            break
        report = check(load_text(block.encode(), "design.yaml"), Options(repairs=False))
        if report.kind.split(" ")[0] != kind.name:
            continue
        document = json.loads(render(Format.JSON, [report]))
        lines = render(Format.PLAIN, [report]).splitlines()
        for scene in document["files"][0]["scenes"]:
            for name, _, verb, line in _of_scene(kind, scene, lines):
                if name in left:
                    found[name] = (f"ptmcalc {verb} design.yaml --scene {scene['name']}", line, block)
                    left.discard(name)
        loaded = load_text(block.encode(), "design.yaml")
        for solver in (*loaded.kind.solvers, *loaded.kind.reference_methods) if loaded.kind and loaded.spec else ():
            for scene in loaded.spec.all_scenes if solver.name in left else ():
                if solver.usable_for(loaded.spec, scene):
                    found[solver.name] = (f"ptmcalc cost design.yaml --scene {scene.label}", "", block)
                    left.discard(solver.name)
    return found


def pages_of(kind: AnyKind, wanted: Iterable[str]) -> Iterator[str]:
    """Design files of the pages of a kind's checks, those first that name what is wanted."""
    texts = [path.read_text("utf-8") for path in sorted((ROOT / "tests" / "machines" / kind.name).glob("*.md"))]
    blocks = [block for text in texts for block in re.findall(r"^```yaml\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)]
    names = tuple(wanted)
    for block in sorted(blocks, key=lambda one: not any(f"{name}" in one for name in names)):
        yield re.sub(r" *# *(?:pass|fail|undecided|not_checked|error|warning) [A-Z]{3}[0-9]{3}.*", "", block)


# -- stored ---------------------------------------------------------------------------------------------------------

UPDATE = bool(os.environ.get("PTMCALC_UPDATE"))


def stored(kind: AnyKind) -> dict[str, Kept]:
    """The examples of a kind as they stand in its folder."""
    return {name: (one.command, one.says, one.file) for name, one in kind.examples().items()}


def keep(kind: AnyKind, found: Mapping[str, Kept]) -> None:
    """Writes them there."""
    texts = {name: list(one) if one[2] else list(one[:2]) for name, one in sorted(found.items())}
    path = ROOT / "ptmcalc" / "machines" / kind.name / EXAMPLES
    path.write_text(json.dumps(texts, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


def again(kind: AnyKind, found: Mapping[str, Kept]) -> dict[str, Kept]:
    """Those with a design file of their own, run again."""
    by_file: dict[str, list[str]] = {}
    for name, (_, _, file) in found.items():
        if file:
            by_file.setdefault(file, []).append(name)
    return {name: one for file, wanted in by_file.items() for name, one in from_blocks(kind, wanted, [file]).items()}


def as_said(line: str, kept: str) -> bool:
    """Whether a line is the kept one, but for the last digits of its numbers."""
    if _NUMBER.sub("#", line) != _NUMBER.sub("#", kept):
        return False
    pairs = zip(_NUMBER.findall(line), _NUMBER.findall(kept), strict=True)
    return all(math.isclose(float(one), float(other), rel_tol=2e-2, abs_tol=1e-12) for one, other in pairs)
