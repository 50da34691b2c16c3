"""The load combinations of stacker cranes as data, and which event of a file gives each its force.

A dynamic load is never a weight times a stored factor: it is the load of an event that has been run.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from ptmcalc.contract.effect import EffectState
from ptmcalc.contract.report import Amount, Cell, Column, LoadReport, SceneReport, TableReport
from ptmcalc.contract.result import of
from ptmcalc.machines.crane.stacking.machine.spec import Stacker

CRANE, LOAD = "weight of the crane", "weight of the lifted load"
MECHANISMS, OBSTACLE = "dynamic: starting and braking of mechanisms", "dynamic: collision with an obstacle"
PUSH, CAUGHT = "dynamic: fork pushing against the rack", "dynamic: fork snagged in the rack while hoisting"
RAIL, GEAR = "dynamic: irregularities of the rail", "dynamic: safety gear"


@dataclass(frozen=True, slots=True)
class Row:
    """A load of a table, and the combinations that take it."""

    load: str
    taken: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Combinations:
    """A table of the notes: its loads, what each combination is for, and what the source leaves open."""

    name: str
    title: str
    rows: tuple[Row, ...]
    uses: tuple[str, ...]
    notes: tuple[str, ...]
    count: int = 6

    def loads(self, number: int) -> tuple[str, ...]:
        """The loads of a combination, from 1 on."""
        return tuple(row.load for row in self.rows if number in row.taken)


_ALL = (1, 2, 3, 4, 5, 6)
"""Numbers of all load combinations of tables 11.1 and 11.2, lecture notes Kramatorsk 2007. The weights of crane and
load are part of each; without a number they are missing from that combination."""
_INERTIA = (
    "combination 1 excludes starting and braking although the rope formula of the same source has inertia in it:"
    " inertia is included in the rope force (scene `hoist`), and the combination contains weights only"
)
_STRUCTURE = "bridge structure, mast, mechanisms"

OVERHEAD = Combinations(
    "11.1",
    "Load combinations of overhead stackers, table 11.1",
    (
        Row(CRANE, _ALL),
        Row(LOAD, _ALL),
        Row(MECHANISMS, (3,)),
        Row(OBSTACLE, (4,)),
        Row(CAUGHT, (5,)),
    ),
    (
        "start and brake times, starts per hour, rope breaking force",
        _STRUCTURE,
        _STRUCTURE,
        _STRUCTURE,
        "elements of the hoisting mechanism",
        "structures and intermediate elements",
    ),
    (
        "combinations 1, 2 and 6 have the same loads: they can differ only by partial factors or limit states (rated,"
        " test, fatigue), which the source does not state",
        _INERTIA,
        "the last printed line, `while hoisting`, has empty cells: it is the end of the line above it, as table 11.2"
        " shows",
    ),
)
RACK = Combinations(
    "11.2",
    "Load combinations of rack stackers, table 11.2",
    (
        Row(CRANE, _ALL),
        Row(LOAD, _ALL),
        Row(MECHANISMS, (2,)),
        Row(PUSH, (3,)),
        Row(CAUGHT, (4,)),
        Row(RAIL, (5,)),
        Row(GEAR, (6,)),
    ),
    (
        "motors and brakes of all mechanisms, ropes",
        "stability",
        "the mast across the aisle and the rack (not stated in the source)",
        "the hoisting mechanism and the carriage (not stated in the source)",
        "wheels, base and mast (not stated in the source)",
        "mast and safety gear (not stated in the source)",
    ),
    (
        "lines of the printed table have five or seven cells instead of six: read diagonally, the only reading in"
        " which each combination contains one dynamic load",
        _INERTIA,
    ),
)
TABLES = {"overhead_stacker": OVERHEAD, "rack_stacker": RACK}

EVENTS = {
    MECHANISMS: "start or brake",
    OBSTACLE: "obstacle",
    PUSH: "fork_push",
    CAUGHT: "fork_caught",
    RAIL: "rail",
} | {GEAR: "safety_gear"}
"""The scene of a file that gives a dynamic load."""

_DYNAMIC = frozenset(EVENTS)


def tables(spec: Stacker, scenes: Sequence[SceneReport]) -> Iterator[TableReport]:
    """The table of a machine as the source prints it, and the force, the run and the stresses of each combination."""
    given = TABLES[spec.type]
    yield _matrix(given)
    yield _forces(given, scenes)


def _matrix(given: Combinations) -> TableReport:
    numbers = range(1, given.count + 1)
    columns = (Column("load", "load"), *(Column(str(n), str(n)) for n in numbers))
    rows = tuple((row.load, *("+" if n in row.taken else "-" for n in numbers)) for row in given.rows)
    uses: dict[str, list[str]] = {}
    for number, use in zip(numbers, given.uses, strict=True):
        uses.setdefault(use, []).append(str(number))
    notes = tuple(f"{', '.join(ones)} for {use}" for use, ones in uses.items())
    return TableReport(given.name, given.title, columns, rows, notes)


_COLUMNS = (
    Column("combination", ""),
    Column("dynamic_load", "dynamic load", detail=True),
    Column("force", "force"),
    Column("scene", "scene"),
    Column("solver", "solver"),
    Column("effects", "effects of the run"),
    Column("column_stress", "mast stress"),
    Column("bridge_stress", "bridge stress"),
    Column("use", "for", detail=True),
)


def _forces(given: Combinations, scenes: Sequence[SceneReport]) -> TableReport:
    rows = tuple(row for number in range(1, given.count + 1) for row in _rows(given, number, scenes))
    shown = tuple(
        index
        for index, column in enumerate(_COLUMNS)
        if column.key not in ("column_stress", "bridge_stress") or any(row[index] for row in rows)
    )
    return TableReport(
        f"{given.name} forces",
        f"Forces of table {given.name}: the leading load of each combination, and the run that computes it",
        tuple(_COLUMNS[index] for index in shown),
        tuple(tuple(row[index] for index in shown) for row in rows),
        given.notes,
    )


def _rows(given: Combinations, number: int, scenes: Sequence[SceneReport]) -> Iterator[tuple[Cell, ...]]:
    """A row for the run with the largest force, and one more where another run stresses column or bridge more: force
    and stresses of a row are of one run."""
    dynamic = next((load for load in given.loads(number) if load in _DYNAMIC), "")
    first: tuple[Cell, ...] = (f"{given.name},{number}", dynamic or "none: weights alone")
    name = of("combination_force", f"{given.name},{number}")
    marked = [(scene, load) for scene in scenes for load in scene.loads if load.info.name == name]
    if not marked:
        event = EVENTS.get(dynamic, "stand")
        yield (*first, "", f"no scene `{event}` was run", "", (), "", "", given.uses[number - 1])
        return
    largest = max(marked, key=lambda one: (_size(one[1]), *(_stress(name, one[0])[0] for name in _STRESSES)))
    chosen = [largest]
    for stress in _STRESSES:
        worst = max(marked, key=lambda one: _stress(stress, one[0])[0])
        if _stress(stress, worst[0])[0] > max(_stress(stress, scene)[0] for scene, _ in chosen):
            chosen.append(worst)
    for scene, force in chosen:
        yield (
            *first,
            Amount(force.estimate, force.info.quantity),
            scene.name,
            force.solver,
            tuple(_ledger(scene, force.solver)),
            *(_stress(stress, scene)[1] for stress in _STRESSES),
            given.uses[number - 1],
        )


_STRESSES = ("column_stress", "bridge_stress")


def _size(load: LoadReport) -> float:
    value = load.estimate.value
    return -math.inf if math.isnan(value) else value


def _ledger(scene: SceneReport, solver: str) -> Iterator[str]:
    """The effects of a scene's ledger that its run carried, or whose bound is in its bar; not those it skips."""
    carried = next((one.effects for one in scene.solvers if one.name == solver and one.decides), ())
    for effect in scene.present:
        if effect.name in carried:
            yield effect.name
        elif effect.state is not EffectState.SKIPPED:
            yield f"{effect.name} (bounded)"


def _stress(name: str, scene: SceneReport) -> tuple[float, Cell]:
    """Size of a stress in a scene, and how the table shows it; nothing where the scene has none."""
    found = next((load for load in scene.loads if load.info.name == name), None)
    if found is None:
        return -math.inf, ""
    return _size(found), Amount(found.estimate, found.info.quantity)
