"""Tensions in horizontal curves in steady running, over all choices of loaded sections."""

import math

from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.conveyor.curves.loads import LEAST, MOST, bend_names
from ptmcalc.machines.conveyor.machine.load_sharing import sharing_is_known
from ptmcalc.machines.conveyor.machine.scenes import Run
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.running.fillings import fillings


def run(spec: Conveyor, scene: Run, carried: frozenset[str], level: int) -> Result:
    """Least and largest tension in each horizontal curve, its own section loaded or empty, whatever else is loaded.

        S(x) = S_empty(x) + sum_k x_k dS_k(x),   x_k = 0 or 1 of the curve, 0 to 1 of all other sections

    With loading points the material moves along the curve: x_k = 0 to 1 of its own lengths too.

    **Range** steady running; sections loaded evenly, or whatever loading points bring.
    **Error** exact: a linear function has its extremes at the ends of the section and of the loads.
    **Source** `running.fillings`; ISO 5048:1989 and DIN 22101 for the resistances.
    """
    every, found = fillings(spec, scene), dict[str, Found]()
    for least, most, strand, bend in bend_names(spec, scene):
        if strand == "return":
            ends = every.on_return(bend.number - 1)
        else:
            ends = every.within(bend.number - 1, most.endswith("full]"))
        found |= {name: Found(Estimate.exact(end)) for name, end in zip((least, most), ends, strict=True)}
    several = {drive.at for drive in spec.all_drives.values()} == {"head", "tail"}
    unknown = several and not sharing_is_known(spec)
    return Result(
        found,
        work=1,
        beyond=dict.fromkeys(found, Interval(-math.inf, math.inf)) if unknown else {},
        open_end="the `curve` of each motor determines the load sharing of unequal drives" if unknown else "",
    )


def valid(spec: Conveyor, scene: Run) -> Criterion:
    """Whether the route has horizontal curves.

        1 without them, else 0

    **Range** any scene.
    **Error** none: a yes or no.
    **Source** the file.
    """
    return Criterion("curves", 0.0 if spec.route.bends else 1.0, 1.0, "the route has no horizontal curve", "the file")


BEND_TENSIONS: Solver[Conveyor, Run] = Solver(
    name="bend_tensions",
    title="tensions in horizontal curves",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Run}),
    represents=frozenset(),
    gives=frozenset({LEAST, MOST}),
    run=run,
    cost=lambda spec, scene, carried, level: 2e-4,
    source="ISO 5048:1989; DIN 22101",
    valid=valid,
)
