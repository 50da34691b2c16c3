"""Random machines of every kind: the design files of the project with some of their numbers changed.

Each machine is a function of its kind and number alone. Files stay valid: a change that the loader refuses is taken
back. The machines are not sound designs; a test that uses them compares what is computed, not verdicts.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from random import Random
from typing import Any

import yaml

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.machine import AnyKind
from ptmcalc.engine.forced import why_not
from ptmcalc.engine.load import Loaded, load_text
from ptmcalc.engine.plan import plan_scene
from ptmcalc.engine.registry import kind_names, load_kind
from ptmcalc.engine.run import settle
from ptmcalc.engine.settled import Settled
from ptmcalc.spec.machine import MachineSpec
from ptmcalc.spec.scene import Scene, TransientScene
from support.command import ROOT

KINDS: tuple[AnyKind, ...] = tuple(one for name in kind_names() for one in load_kind(name).manifests)
"""The manifests of all kinds and types."""
_CHANGED = 6
"""Numbers that are changed at most in one machine."""
_FACTORS = (0.5, 0.7, 0.85, 0.95, 1.05, 1.2, 1.5, 2.0)
_NOT_OURS = ("tolerances", "waive", "checks", "accuracy", "gravity")
"""Blocks that are no part of the machine."""
SECONDS = 4.0
"""Predicted seconds of work of one scene: machines that need more are compared as far as they get."""


@dataclass(frozen=True)
class Machine:
    """A random machine; `name` says how it was made."""

    name: str
    loaded: Loaded

    @property
    def kind(self) -> AnyKind:
        assert self.loaded.kind is not None
        return self.loaded.kind

    @property
    def spec(self) -> MachineSpec:
        assert self.loaded.spec is not None
        return self.loaded.spec


@cache
def texts(kind: AnyKind) -> tuple[str, ...]:
    """The template and the design files of a kind, and a file that leaves out what these give."""
    found = [kind.template]
    for path in (*sorted((ROOT / "specs").rglob("*.yaml")), *sorted((ROOT / "tests/edges").rglob("little-said.yaml"))):
        if path.parent.name == "winding_paper" and "17_5" not in path.name:
            continue
        text = path.read_text(encoding="utf-8")
        head = yaml.load(text, yaml.BaseLoader)
        if (head.get("kind"), head.get("type", "")) == (kind.name, kind.type):
            found.append(text)
    return tuple(found)


def machines(kind: AnyKind, seed: int, number: int) -> Iterator[Machine]:
    """So many random machines of a kind."""
    for index in range(number):
        yield machine(kind, seed, index)


def machine(kind: AnyKind, seed: int, index: int) -> Machine:
    """A random machine."""
    draw = Random(f"{kind.label} {seed} {index}")
    base = draw.randrange(len(texts(kind)))
    data = yaml.load(texts(kind)[base], yaml.BaseLoader)
    loaded = _read(data)
    assert loaded.spec is not None
    numbers = [path for path in _numbers(data) if path[0] not in _NOT_OURS]
    changed = []
    for _ in range(draw.randint(1, _CHANGED)):
        path, factor = draw.choice(numbers), draw.choice(_FACTORS)
        other = _scaled(data, path, factor)
        again = _read(other)
        if again.spec is not None:
            data, loaded = other, again
            changed.append(f"{'.'.join(map(str, path))} x {factor}")
    return Machine(f"{kind.label} {seed}/{index}: file {base}; {', '.join(changed)}", loaded)


def _read(data: Any) -> Loaded:
    return load_text(written(data), "random.yaml")


def written(data: Any) -> bytes:
    """The file of plain data in which every scalar is a text, as `yaml.BaseLoader` reads it."""
    return yaml.safe_dump(_typed(data), sort_keys=False).encode()


def _typed(node: Any) -> Any:
    if isinstance(node, dict):
        return {key: _typed(value) for key, value in node.items()}
    if isinstance(node, list):
        return [_typed(value) for value in node]
    for kind in (int, float):
        try:
            return kind(node)
        except ValueError:
            continue
    return node


def _numbers(node: Any, path: KeyPath = ()) -> Iterator[KeyPath]:
    """Paths of the texts that begin with a number."""
    items = node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ()
    for key, value in items:
        if isinstance(value, dict | list):
            yield from _numbers(value, (*path, key))
        elif isinstance(value, str) and _number(value) is not None:
            yield (*path, key)


def _number(text: str) -> tuple[float, str] | None:
    first, _, unit = text.partition(" ")
    try:
        return float(first), unit
    except ValueError:
        return None


def _scaled(node: Any, path: KeyPath, factor: float) -> Any:
    step, rest = path[0], path[1:]
    if not rest:
        number = _number(node[step])
        assert number is not None
        value, unit = number
        whole = "." not in node[step].split(" ")[0] and not unit
        scaled = round(value * factor) if whole else value * factor
        new: Any = f"{scaled!r} {unit}".strip()
    else:
        new = _scaled(node[step], rest, factor)
    if isinstance(node, list):
        return [new if index == step else one for index, one in enumerate(node)]
    return {**node, step: new}


# -- computing ------------------------------------------------------------------------------------------------------


def settled(spec: MachineSpec, kind: AnyKind, scene: Scene, *, budget: float = SECONDS) -> Settled:
    """A scene as the engine computes it: one of the machine's own, or in its place."""
    scenes = tuple(scene if one.label == scene.label else one for one in spec.all_scenes)
    whole = spec.model_copy(update={"scenes": scenes})
    return settle(kind, whole, plan_scene(kind, whole, scene), budget=budget)


def longer(scene: Scene, factor: float) -> Scene:
    """The scene with a longer window; itself where it has none."""
    return scene.model_copy(update={"window_factor": factor}) if isinstance(scene, TransientScene) else scene


def with_scene(spec: MachineSpec, scene: Scene) -> MachineSpec:
    """The machine with one scene only."""
    return spec.model_copy(update={"scenes": (scene,)})


def all_on(kind: AnyKind, spec: MachineSpec, scene: Scene) -> MachineSpec:
    """The machine with each effect forced on that a run of the scene can simulate."""
    made = plan_scene(kind, spec, scene)
    able = {p.effect.name: "on" for p in made.effects if not p.excluded and not why_not(kind, spec, made, p)}
    return spec.model_copy(update={"effects": {**spec.effects, **able}})


def meet(one: Estimate, other: Estimate, *, rounding: float = 1e-8) -> bool:
    """Whether two intervals intersect; ends that differ by rounding do."""
    size = max(abs(one.value), abs(other.value))
    room = rounding * size if size < float("inf") else 0.0
    return one.low <= other.high + room and other.low <= one.high + room
