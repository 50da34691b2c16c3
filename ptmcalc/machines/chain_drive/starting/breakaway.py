"""A start of a relaxed chain: the drive takes up its stretch, and its load breaks loose."""

import numpy as np

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import start_profile
from ptmcalc.machines.chain_drive.machine.model import has_driven_tail
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, Start
from ptmcalc.machines.chain_drive.starting.bounds import TENSIONS, loads_of
from ptmcalc.machines.chain_drive.starting.motion import StartCase, ratios, start_case
from ptmcalc.machines.chain_drive.starting.waves import natural_frequencies
from ptmcalc.numerics.two_mass_start import two_mass_start

_POINTS = 201
"""Points of a force that rises, straight between them; a numerical choice. The force of a cosine rise deviates by at
most 1.5e-5 of its end value. The error falls with the square of the number; time grows with it."""
_WINDOWS = 2.0
"""Window relative to the start time of the rigid body [1]: the chain is tensioned before it moves. A numerical choice.
A larger value takes longer; a smaller one may omit the peak."""


def run(spec: ChainDrive, scene: Start, carried: frozenset[str], level: int) -> Result:
    """Maximum entering tension when a drive tightens a relaxed chain until its load breaks away.

        S = S_off + K x,   K = w_1^2 m M/(m + M),   M sticks as long as K x <= W

    **Range** a torque over time; a constant tension of the leaving strand; the whole resistance as friction of the
    load.
    **Error** exact for two masses; no bound relative to a chain with distributed mass.
    **Source** derived in `numerics.two_mass_start`; the step in closed form is `laws.two_mass.takeup`.
    """
    case = start_case(spec, scene)
    drive, load = case.masses.drive_mass, case.masses.belt_mass
    w = natural_frequencies(case, 1)
    reduced = drive / (drive + load) * load
    damping = 2 * float(ratios(spec, scene, w)[0]) * float(w[0]) * reduced
    times = np.zeros(1)
    if case.shape != start_profile.STEP:
        times = np.linspace(0.0, case.rise_time, _POINTS)
    forces = case.available * start_profile.rise(case.shape, case.rise_time, times)
    window = _WINDOWS * case.duration * scene.window_factor
    found = two_mass_start(
        drive, load, float(w[0]) ** 2 * reduced, damping, case.line.static_resistance, times, forces, window
    )
    dynamic = case.line.run_off + found.largest - case.line.run_on
    loads = loads_of(spec, case, Estimate.exact(max(dynamic, 0.0)), None)
    at = {"time": found.largest_time}
    return Result({name: Found(load, at) for name, load in loads.items()}, work=found.work, window=(0.0, window))


def valid(spec: ChainDrive, scene: Start) -> Criterion:
    """Whether a drive takes up a relaxed chain by its torque.

        n = 1 for each of: running tensions in the chain, no motion, an imposed speed, a motor's curve, a fixed length,
        a load that drives, a driven tail

    **Range** any start.
    **Error** exact: a count.
    **Source** two masses and one spring.
    """
    case = start_case(spec, scene)
    found = [name for name, one in _hindrances(spec, scene, case).items() if one]
    meaning = ", ".join(found) if found else "features outside the two-mass model: none"
    return Criterion("n", float(len(found)), 1.0, meaning, "count")


def _hindrances(spec: ChainDrive, scene: Start, case: StartCase) -> dict[str, bool]:
    return {
        "chain with its running tensions": scene.chain != "relaxed",
        "no motion": not case.moves,
        "imposed speed": case.imposed_speed,
        "motor curve": case.follows_curve,
        "loop of fixed length": case.line.fixed_length,
        "load that drives": case.line.static_resistance <= 0,
        "driven tail": has_driven_tail(spec),
    }


BREAKAWAY: Solver[ChainDrive, Start] = Solver(
    name="chain_breakaway",
    title="breakaway of a slack chain, two-mass model",
    fidelity=Fidelity.TRANSIENT,
    scenes=frozenset({Start}),
    represents=frozenset({"chain_elasticity", "chain_sticking"}),
    gives=frozenset(TENSIONS) - {"tension_min"},
    run=run,
    cost=lambda spec, scene, carried, level: 2e-2,
    source="derived in ptmcalc.numerics.two_mass_start",
    valid=valid,
    always=frozenset({"chain_elasticity", "chain_sticking"}),
)
