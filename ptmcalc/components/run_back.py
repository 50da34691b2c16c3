"""A loaded belt or chain that may run back: scenes in which its rollback torque is checked, and the check."""

from collections.abc import Callable, Collection, Sequence
from dataclasses import replace
from typing import Any, Protocol, TypeVar

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import Check, LimitState, Sense, no_needs
from ptmcalc.contract.effect import C, Criterion, S
from ptmcalc.contract.result import Failure
from ptmcalc.spec.scene import Scene

USUAL_RESERVE = 1.25
"""Rated torque of a backstop over the torque it must hold [1], unless a file states another; practice: 1.25 to 1.75. A
larger value requires a larger backstop, a smaller one reduces the reserve."""


class LoadedScene(Protocol):
    """A scene that states where the machine is loaded."""

    @property
    def load(self) -> str: ...


L = TypeVar("L", bound=LoadedScene)


class Backstop(Protocol):
    """A backstop: the torque it holds [N*m], and its rated torque over the torque it must hold [1]."""

    @property
    def torque(self) -> float: ...

    @property
    def reserve(self) -> float: ...


def rollback_scene(
    scenes: Sequence[L], loads: Collection[str], standstill: type[Any], may_run_back: Callable[[L], bool]
) -> L | None:
    """The scene in which the rollback torque of a machine that climbs is checked without a `backstop` scene.

    It is the first loaded scene that ends at rest or begins with less than the full torque; of a file without scenes,
    the loaded run.

    Args:
        scenes: of the machine.
        loads: names of the loads that lie on a climbing part.
        standstill: type of a `backstop` scene.
        may_run_back: whether a scene ends at rest or begins with less than the full torque.
    """
    found = None
    for one in scenes:
        if one.load not in loads:
            continue
        if isinstance(one, standstill):
            return None
        if found is None and may_run_back(one):
            found = one
    return found


def checked_elsewhere(asks_for_hold: Callable[[S, C], bool]) -> Callable[[S, C], Criterion]:
    """The criterion of a solver of the rollback torque, by the scenes of its kind in which that torque is checked."""

    def elsewhere(spec: S, scene: C) -> Criterion:
        """Whether the rollback torque is checked in other scenes only: 1, else 0.

        **Range** any scene.
        **Error** exact.
        **Source** `asks_for_hold`.
        """
        meaning = "0 in the scene in which the rollback torque is checked, else 1"
        return Criterion("rollback", float(not asks_for_hold(spec, scene)), 1.0, meaning, "the scenes of the file")

    return elsewhere


def held_torque(backstop: Backstop | None, closed: float) -> Estimate:
    """Torque that a machine without drives holds, divided by the reserve [N*m].

        M = (M_backstop + M_brakes)/reserve

    Args:
        backstop: of the machine, if it has one.
        closed: torque of its closed brakes on the shaft of the backstop [N*m].

    **Range** standstill.
    **Error** none: a chosen reserve.
    **Source** practice: reserve 1.25 to 1.75.
    """
    if backstop is None:
        return Estimate.exact(closed / USUAL_RESERVE)
    return Estimate.exact((closed + backstop.torque) / backstop.reserve)


def rollback_check(
    code: str,
    part: str,
    scenes: frozenset[type[Scene]],
    asks_for_hold: Callable[[S, C], bool],
    limit: Callable[[S, C], Estimate],
    key: Callable[[S], KeyPath],
    *,
    what: str,
    why: str,
    formula: str,
) -> Check[S, C]:
    """The check of the rollback torque of a belt or chain; `key` is that of the torque which holds it, or of the
    backstop that is absent."""
    check: Check[S, C] = Check(
        code=code,
        hazard=True,
        title=f"{part} rollback torque",
        question=f"Is the rollback torque of the stopped loaded {part} held by friction or the backstop?",
        failure="rollback torque exceeds the permissible backstop torque",
        limit_state=LimitState(f"loaded {part} runs back"),
        scenes=scenes,
        loads=("backstop_torque",),
        sense=Sense.AT_MOST,
        limit=limit,
        needs=no_needs,
        each=lambda spec, scene: (replace(check, each=None),) if asks_for_hold(spec, scene) else (),
        blame=lambda spec, scene, loads: key(spec),
        repair=lambda spec, scene: key(spec) if len(key(spec)) > 1 else (),
        what=what,
        why=why,
        formula=formula,
        source="lecture notes Kramatorsk 2007",
    )
    return check


def runs_back(check: str, what: str, torque: float) -> Failure:
    """The failure of a machine without backstop and brake, and the backstop that holds its torque with a reserve."""
    pulls, holds = (units.show(value, units.TORQUE, 3) for value in (torque, 1.005 * USUAL_RESERVE * torque))
    message = f"loaded {what} runs back with {pulls}: neither a backstop nor a brake holds it"
    return Failure(check, message, ("backstop",), f"add `backstop: {{torque: {holds}}}`")
