"""Machine kinds: found by listing, imported only when named.

A kind is a package in `ptmcalc.machines` that defines `KIND`, or an entry point of the group `ptmcalc.machines`.
"""

import pkgutil
from collections.abc import Mapping
from functools import cache
from importlib import import_module

from ptmcalc import machines
from ptmcalc.base.errors import UsageError
from ptmcalc.contract.machine import AnyKind, MachineKind

_GROUP = "ptmcalc.machines"


def kind_names() -> tuple[str, ...]:
    """Names of all installed kinds, sorted."""
    return tuple(sorted({*_theirs(), *_ours()}))


@cache
def _ours() -> Mapping[str, str]:
    """Where the manifest of each of our kinds is: `module:attribute`."""
    return {
        module.name: f"{machines.__name__}.{module.name}:KIND"
        for module in pkgutil.iter_modules(machines.__path__)
        if module.ispkg
    }


@cache
def _theirs() -> Mapping[str, str]:
    """Where those of other packages are. To read what all installed packages announce takes as long as to import
    numpy, so this is asked only where ours do not do."""
    from importlib import metadata

    return {entry.name: entry.value for entry in metadata.entry_points(group=_GROUP)}


def begins_a_code(word: str) -> bool:
    """Whether a check of some kind has a code that begins so. Only kinds whose codes may are imported."""
    known = machines.PREFIXES
    if any(prefix.startswith(word) for name, prefix in known.items() if name in _ours()):
        return True
    for name in _ours():
        if name in known and word.startswith(known[name]) and _has(name, word):
            return True
    unknown = [name for name in kind_names() if name not in known or name not in _ours()]
    return any(_has(name, word) for name in unknown)


def _has(name: str, word: str) -> bool:
    """Whether a kind has a code that begins so; of one with several types, asked type by type."""
    types = getattr(import_module(_place(name).partition(":")[0]), "TYPES", {})
    kinds = (load_type(name, one) for one in types) if types else iter((load_kind(name),))
    return any(
        check.code.startswith(word) for kind in kinds if kind for one in (kind, *kind.types) for check in one.checks
    )


def is_kind(name: object) -> bool:
    """Whether a kind is called so."""
    return isinstance(name, str) and (name in _ours() or name in _theirs())


def load_type(name: str, word: object) -> AnyKind | None:
    """The manifest of one type of a kind without the others, where its package lists them in `TYPES`, by the word its
    files write behind `type`; else None."""
    module = import_module(_place(name).partition(":")[0])
    place = getattr(module, "TYPES", {}).get(word) if isinstance(word, str) else None
    if place is None:
        return None
    module_of_type, _, attribute = place.partition(":")
    kind = getattr(import_module(module_of_type), attribute, None)
    if not isinstance(kind, MachineKind) or (kind.name, kind.type) != (name, word):
        raise UsageError(f"type `{word}` of kind `{name}` defines no manifest of that name", f"expected at {place}")
    return kind


def load_kind(name: str) -> AnyKind:
    """The manifest of a kind.

    Raises:
        UsageError: no such kind, or its package does not define a manifest of its own name.
    """
    place = _place(name)
    module, _, attribute = place.partition(":")
    kind = getattr(import_module(module), attribute or "KIND", None)
    if not isinstance(kind, MachineKind) or kind.name != name:
        raise UsageError(f"the package of kind `{name}` defines no manifest of that name", f"expected at {place}")
    return kind


def package_of(name: str) -> str:
    """The package that a kind is defined in, whose modules hold its checks, effects, solvers and loads."""
    module = import_module(_place(name).partition(":")[0])
    return module.__package__ or module.__name__


def _place(name: str) -> str:
    place = _ours().get(name) or _theirs().get(name)
    if place is None:
        raise UsageError(f"unknown machine kind `{name}`", f"kinds: {', '.join(kind_names())}")
    return place
