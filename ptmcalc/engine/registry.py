"""Machine kinds: found by listing, imported only when named.

A kind is a package in `ptmcalc.machines` that defines `KIND`, or an entry point of the group `ptmcalc.machines`.
"""

import pkgutil
from collections.abc import Mapping
from functools import cache
from importlib import import_module, metadata

from ptmcalc import machines
from ptmcalc.base.errors import UsageError
from ptmcalc.contract.machine import AnyKind, MachineKind

_GROUP = "ptmcalc.machines"


def kind_names() -> tuple[str, ...]:
    """Names of all installed kinds, sorted."""
    return tuple(sorted(_places()))


@cache
def _places() -> Mapping[str, str]:
    """Where each kind's manifest is: `module:attribute`."""
    ours = {
        module.name: f"{machines.__name__}.{module.name}:KIND"
        for module in pkgutil.iter_modules(machines.__path__)
        if module.ispkg
    }
    theirs = {entry.name: entry.value for entry in metadata.entry_points(group=_GROUP)}
    return theirs | ours


def load_kind(name: str) -> AnyKind:
    """The manifest of a kind.

    Raises:
        UsageError: no such kind, or its package does not define a manifest of its own name.
    """
    place = _places().get(name)
    if place is None:
        raise UsageError(f"no machine kind is called `{name}`", f"kinds: {', '.join(kind_names())}")
    module, _, attribute = place.partition(":")
    kind = getattr(import_module(module), attribute or "KIND", None)
    if not isinstance(kind, MachineKind) or kind.name != name:
        raise UsageError(f"the package of kind `{name}` defines no manifest of that name", f"expected at {place}")
    return kind
