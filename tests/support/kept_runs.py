"""Runs of solvers that a session of tests keeps: commands read the same few design files again and again.

Only what the command line does in this process takes part (`support.command.ptmcalc`): its tests are about files,
options, texts and exit statuses. The solvers themselves are tested by other ways to them, each time anew.
"""

import pickle
from collections.abc import Iterator
from contextlib import contextmanager
from unittest import mock

from ptmcalc.contract.result import Result
from ptmcalc.contract.solver import AnySolver
from ptmcalc.engine import run
from ptmcalc.engine.plan import Rung
from ptmcalc.engine.settled import Settled
from ptmcalc.spec.machine import MachineSpec

_MOST = 500
"""Runs that are kept: those of the repairs of a few files."""
_KEPT: dict[tuple[object, ...], tuple[AnySolver, Result]] = {}
"""By machine and run; a solver that is held has its identity alone."""
_made = run._made


def _once(settled: Settled, spec: MachineSpec, rung: Rung) -> Result | None:
    """The result of a rung: an immutable one, which depends on machine, scene, effects and level alone. What fails is
    done again, for it leaves findings."""
    key = (id(rung.solver), pickle.dumps((spec, settled.plan.scene)), rung.carried, rung.level)
    _, found = _KEPT.pop(key, (None, None))
    if found is None:
        found = _made(settled, spec, rung)
    if found is not None:
        _KEPT[key] = rung.solver, found
        if len(_KEPT) > _MOST:
            del _KEPT[next(iter(_KEPT))]
    return found


@contextmanager
def kept_runs() -> Iterator[None]:
    """Within it, no solver computes what it has computed within it before."""
    with mock.patch.object(run, "_made", _once):
        yield
