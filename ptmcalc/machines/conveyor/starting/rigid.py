"""A start of the rigid body: closed form. Its error bar is the bound of the belt's waves."""

import math
from dataclasses import replace

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Found, Result, of
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.conveyor.drives import least_pull
from ptmcalc.machines.conveyor.loads import DRIVE, OF_BELT, OF_START, PER_DRIVE, SLIPS
from ptmcalc.machines.conveyor.model import is_plain, natural_frequencies, start_case
from ptmcalc.machines.conveyor.motion import moving
from ptmcalc.machines.conveyor.spec import Conveyor, Start
from ptmcalc.machines.conveyor.starting.loads import OF_STARTING, start_loads
from ptmcalc.machines.conveyor.waves import bounds


def run(spec: Conveyor, scene: Start, carried: frozenset[str], level: int) -> Result:
    """Loads of a start in which drive and belt move as one body.

        a = F_d/M,   F_d = F - W,   S(s) = S_static(s) + a r(s)

    r(s) is the mass accelerated by a section (gravity take-up), or this mass less its mean over the loop (fixed
    take-up).

    **Range** any start that moves the belt.
    **Error** no error bar of its own: the bounds of the neglected effects cover the difference.
    **Source** Newton's law; the split of a fixed loop from constant elongation (`laws.loop_bounds.quasi_static`).
    """
    case = start_case(spec, scene)
    loads = bounds.scalar_loads(case) | bounds.rigid_loads(case)
    if not is_plain(spec, scene):
        loads["start_time_rigid"] = moving(spec, scene).rigid_time if case.moves else math.inf
    if scene.profile.shape == "curve":  # the weakest moment of the motors decides whether they start
        loads |= bounds.drive_loads(replace(case, available_force=least_pull(spec, scene)), case.line.static_resistance)
        if loads["starting_reserve"] < 1:
            loads["start_time_rigid"] = math.inf
    loads["start_time"] = loads["start_time_rigid"]
    if len(spec.all_drives) == 1:
        loads |= _of_the_drive(next(iter(spec.all_drives)), loads)
    for number, frequency in enumerate(natural_frequencies(case.masses, spec.takeup_weight), 1):
        loads[of("natural_frequency", str(number))] = frequency
    window = (0.0, case.held + case.window)
    found = {name: Found(Estimate.exact(value)) for name, value in loads.items()}
    return Result(found | start_loads(spec, scene, case), work=1, window=window)


def _of_the_drive(name: str, loads: dict[str, float]) -> dict[str, float]:
    """What is known of the only drive by its own name; it sticks, and the effect `slip` says what that leaves out."""
    found = {of(load, name): value for load, value in loads.items() if load in PER_DRIVE}
    if "slip_utilisation_max" in loads:
        found |= {of(load, name): 0.0 for load in SLIPS}
    return found


RIGID: Solver[Conveyor, Start] = Solver(
    name="rigid",
    title="start, rigid-belt model with wave bounds",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Start}),
    represents=frozenset(),
    gives=OF_BELT.union(DRIVE, OF_START, OF_STARTING, PER_DRIVE),
    run=run,
    cost=lambda spec, scene, carried, level: 3e-3,
    source="Newton's law; bounds derived in ptmcalc.laws.loop_bounds",
)
