"""Travel of the take-up by its causes: elastic, thermal and permanent elongation, movement, mounting."""

from collections.abc import Iterator

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.memory import kept_for
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.conveyor.machine.drives import running
from ptmcalc.machines.conveyor.machine.loading import Filling, choices, in_operation, pieces
from ptmcalc.machines.conveyor.machine.loads import TAKEUP_CLEARANCES, TAKEUP_TOTAL
from ptmcalc.machines.conveyor.machine.model import BeltLine, FloatArray, Strand
from ptmcalc.machines.conveyor.machine.resistances import filled
from ptmcalc.machines.conveyor.machine.scenes import ANY_MOTION, ConveyorScene, Run
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.takeup.loads import SHARES


@kept_for(64)
def shares(spec: Conveyor) -> dict[str, float]:
    """Shares of the take-up travel that are equal in all scenes [m]; formulas in `run`."""
    takeup = spec.takeup
    empty, *loaded = (running(spec, Run(), filling) for filling in _fillings(spec))
    full = loaded[-1]
    half = (full.back.length + full.carry.length) / 2
    rest = _mean(empty, at_rest=True)
    ways = (
        [0.0] if full.fixed_length else [0.0, *(half * (_mean(one) - rest) / one.stiffness for one in (*loaded, empty))]
    )
    parts = (
        max(ways) - min(ways),
        half * filled(takeup.thermal_expansion) * filled(takeup.temperature_range),
        half * (takeup.permanent_elongation or 0.0),
        filled(takeup.installation),
    )
    return dict(zip(SHARES, parts, strict=True))


def _fillings(spec: Conveyor) -> Iterator[Filling]:
    """The empty belt, and the belt with every choice of its loading points."""
    lengths = pieces(spec)
    for names in choices(in_operation(spec, Run())):
        yield [tuple(name for name in one.points if name in names) for one in lengths]


def _mean(line: BeltLine, at_rest: bool = False) -> float:
    """Mean tension of a belt that runs evenly, or is at rest without friction [N]."""

    def area(strand: Strand, start: float) -> float:
        rises = strand.climb if at_rest else tuple(strand.rises.tolist())
        ends = zip(strand.marks, strand.marks[1:], rises, rises[1:], strict=False)
        return sum((right - left) * (start + (low + high) / 2) for left, right, low, high in ends)

    back, carry = (line.static_ends(which)[0] for which in (RETURN, CARRY))
    if at_rest:
        back = line.takeup_tension - (line.back.climb[-1] if line.weight_at_tail else 0.0)
        carry = back + line.back.climb[-1]
    return (area(line.back, back) + area(line.carry, carry)) / (line.back.length + line.carry.length)


def run(spec: Conveyor, scene: ConveyorScene, carried: frozenset[str], level: int) -> Result:
    """Take-up travel of a scene by its shares.

        s_e = max(0, s_full, s_empty) - min(0, s_full, s_empty),   s = L (S_mean - S_rest)/(2 EA)
        s_t = alpha_T dT L/2,   s_p = eps_p L/2
        s_all = s_e + s_t + s_p + s_i + s_m

    The movement s_m is 0 in steady running; the simulation of a start, a stop or a jam gives it and the sum of that
    scene. The rest is the empty belt without friction at the tension of the take-up. A fixed take-up keeps the length
    of the belt, and with it the mean tension: its elastic share is 0. With loading points, s_full is that of each
    choice of them. The movement of a start of a relaxed belt contains the elastic share too: the sum is then on the
    safe side.

    **Range** a gravity or a fixed take-up on two falls; one stiffness all round; files that give the travel and one of
    its shares.
    **Error** exact for given keys; assumed ones have an interval, the movement has the error bar of its simulation.
    **Source** Hooke's law over the loop; shares of the take-up travel in DIN 22101 and in manuals of belt makers.
    """
    found = shares(spec)
    whole = {TAKEUP_TOTAL: sum(found.values())} if isinstance(scene, Run) else {}
    return Result({name: Found(Estimate.exact(value)) for name, value in (found | whole).items()}, work=1)


def valid(spec: Conveyor, scene: ConveyorScene) -> Criterion:
    """Whether the file gives the travel and one of its shares.

        1 without them, else 0

    **Range** any scene.
    **Error** none: a yes or no.
    **Source** the file.
    """
    wanted = spec.takeup.budgeted
    return Criterion("budget", 0.0 if wanted else 1.0, 1.0, "the file gives no share of the take-up travel", "the file")


def moved(spec: Conveyor, way: FloatArray) -> dict[str, float]:
    """Travel and distances from the stops in a scene in which the weight sinks by a way over time [m]; nothing where
    the file gives no share of the travel."""
    takeup = spec.takeup
    if not takeup.budgeted:
        return {}
    least, most = float(way.min()), float(way.max())
    begins, stroke = filled(takeup.position), filled(takeup.stroke)
    return {
        TAKEUP_TOTAL: sum(shares(spec).values()) + most - least,
        **dict(zip(TAKEUP_CLEARANCES, (begins + least, stroke - begins - most), strict=True)),
    }


TRAVEL: Solver[Conveyor, ConveyorScene] = Solver(
    name="takeup_shares",
    title="take-up travel by its shares",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset(ANY_MOTION),
    represents=frozenset(),
    gives=frozenset({*SHARES, TAKEUP_TOTAL}),
    run=run,
    cost=lambda spec, scene, carried, level: 2e-4,
    source="Hooke's law over the loop; DIN 22101",
    valid=valid,
)
