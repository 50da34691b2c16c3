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


def load_kind(name: str) -> AnyKind:
    """The manifest of a kind.

    Raises:
        UsageError: no such kind, or its package does not define a manifest of its own name.
    """
    place = _ours().get(name) or _theirs().get(name)
    if place is None:
        raise UsageError(f"no machine kind is called `{name}`", f"kinds: {', '.join(kind_names())}")
    module, _, attribute = place.partition(":")
    kind = getattr(import_module(module), attribute or "KIND", None)
    if not isinstance(kind, MachineKind) or kind.name != name:
        raise UsageError(f"the package of kind `{name}` defines no manifest of that name", f"expected at {place}")
    return kind
