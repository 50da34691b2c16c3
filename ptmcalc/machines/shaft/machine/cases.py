"""A scene of a main shaft as numbers: its machine and its steady cycle."""

from collections import OrderedDict, deque
from dataclasses import dataclass

from ptmcalc.base.errors import NumericsError
from ptmcalc.contract.effect import Criterion
from ptmcalc.machines.shaft.machine.model import Machine, machine_of
from ptmcalc.machines.shaft.machine.spec import RunOut, RunUp, Shaft, ShaftScene, Steady
from ptmcalc.machines.shaft.machine.steady import Cycle, closed_cycle

_KEPT = 8
"""Machines and steady cycles kept in memory, each [1]. A numerical choice: fewer repeat computations for scenes of the
same file, more take memory. No load depends on it."""


@dataclass
class _Known:
    """What has been found out about one file in one load state."""

    spec: Shaft
    load: str
    machine: Machine
    cycles: dict[bool, Cycle | NumericsError | None]


_known: deque[_Known] = deque(maxlen=_KEPT)
"""The last machines: every scene of a file, its effects and its solvers ask for the same ones."""
_cycles: OrderedDict[str, Cycle | NumericsError | None] = OrderedDict()
_NOT_OF_A_CYCLE = {
    *("kind", "name", "description", "project"),
    *("accuracy", "effects", "speed", "brake", "checks", "scenes"),
}


def _of(spec: Shaft, load: str) -> _Known:
    for one in _known:
        if one.spec is spec and one.load == load:
            return one
    found = _Known(spec, load, machine_of(spec, load), {})
    _known.append(found)
    return found


def machine_for(spec: Shaft, load: str) -> Machine:
    """The machine of a file with its useful load (`full`) or without it (`idle`)."""
    return _of(spec, load).machine


def machine_in(spec: Shaft, scene: ShaftScene) -> Machine:
    """The machine in the load state of a scene."""
    assert isinstance(scene, RunUp | Steady | RunOut)
    return machine_for(spec, scene.load)


def cycle_of(spec: Shaft, load: str, *, mean_inertia: bool = False) -> Cycle | None:
    """The steady cycle with or without the useful load, None where the motor stalls.

    Raises:
        NumericsError: there is none that is determined.
    """
    known = _of(spec, load)
    if mean_inertia not in known.cycles:
        known.cycles[mean_inertia] = _cycle(spec, known.machine, f"{load} {mean_inertia}")
    found = known.cycles[mean_inertia]
    if isinstance(found, NumericsError):
        raise NumericsError(found.code, found.message)
    return found


def _cycle(spec: Shaft, machine: Machine, case: str) -> Cycle | NumericsError | None:
    """The cycle, or that of a file that differs only in what a cycle does not know: brake, limits, scenes."""
    key = f"{case} {spec.model_dump_json(exclude=_NOT_OF_A_CYCLE)}"
    if key not in _cycles:
        try:
            _cycles[key] = closed_cycle(machine.with_mean_inertia() if case.endswith("True") else machine)
        except NumericsError as error:
            _cycles[key] = error
        while len(_cycles) > _KEPT:
            _cycles.popitem(last=False)
    return _cycles[key]


def inertia_forced_off(spec: Shaft, scene: ShaftScene) -> Criterion:
    """A run with the mean inertia is made only where the file leaves its change out: no bar covers it else.

    **Range** any machine.
    **Error** none: a yes or no.
    **Source** `effects` of the file.
    """
    value = 0.0 if spec.effects.get("varying_inertia") == "off" else 1.0
    return Criterion("o", value, 0.5, "0 if the file forces the varying inertia off, otherwise 1", "the design file")
