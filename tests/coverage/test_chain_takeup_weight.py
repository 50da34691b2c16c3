"""Bound of the take-up weight's inertia in a start of a chain, against finite elements with and without it."""

import numpy as np
from scipy.linalg import expm, solve
from support import chain_fem
from support.chain_starts import KIND, built, random_chain

from ptmcalc.base.estimate import Estimate
from ptmcalc.machines.chain_drive.spec import ChainDrive
from ptmcalc.machines.chain_drive.start_bounds import loads_of
from ptmcalc.machines.chain_drive.starting import StartCase, start_case

WEIGHT = next(effect for effect in KIND.effects if effect.name == "takeup_weight")
PIECES, STEPS = 16, 900


def peak(case: StartCase, weight: float, force: float, window: float) -> float:
    """Largest run-on tension over the static one after a step of rim force; the weight hangs on both falls beside the
    drive and moves by half of what they differ."""
    loop = case.masses
    strands = (
        chain_fem.Strand(1.0, loop.carry_mass, 1 / loop.carry_compliance),
        chain_fem.Strand(1.0, loop.return_mass, 1 / loop.return_compliance),
    )
    mass, stiff = chain_fem.matrices(chain_fem.Chain(strands, loop.tail_mass), PIECES, lumped=True)
    mass[0, 0] += loop.drive_mass
    ends = np.ix_([0, -1], [0, -1])
    mass[ends] += weight / 4 * np.array([[1, -1], [-1, 1]])
    n, dt = len(mass), window / STEPS
    rate = np.zeros((2 * n + 1, 2 * n + 1))
    rate[:n, n : 2 * n] = np.eye(n)
    rate[n : 2 * n, :n] = -solve(mass, stiff)
    rate[n : 2 * n, -1] = solve(mass, np.eye(n)[0] * force)
    step, state, most = expm(rate * dt), np.append(np.zeros(2 * n), 1.0), 0.0
    for _ in range(STEPS):
        state = step @ state
        most = max(most, float(stiff[0, 1] * (state[1] - state[0])))
    return most


def light_enough(spec: ChainDrive, data: dict, share: float) -> tuple[ChainDrive, float]:
    """The same machine with a weight at so much of the threshold, and its mass."""
    low, high = 1e-6, 1e6
    for _ in range(60):
        mass = (low * high) ** 0.5
        spec = built(
            data | {"layout": data["layout"] | {"takeup": data["layout"]["takeup"] | {"mass": f"{mass:.9g} kg"}}}
        )
        criterion = WEIGHT.criterion(spec, spec.all_scenes[0])
        assert criterion is not None
        low, high = (mass, high) if criterion.value < share else (low, mass)
    return spec, low


def test_the_bound_of_the_weight_holds_what_it_changes() -> None:
    rng, found = np.random.default_rng(3_301), []
    while len(found) < 14:
        data = random_chain(rng)
        data["layout"]["takeup"]["type"] = "gravity"
        spec = built(data)
        bare = start_case(spec, spec.all_scenes[0])
        if not bare.moves or bare.acceleration * bare.whole_mass / bare.masses.drive_mass > 0.025 * 9.81:
            continue
        spec, mass = light_enough(spec, data, float(rng.uniform(0.4, 0.95)))
        case = start_case(spec, spec.all_scenes[0])
        force, window = case.acceleration * case.whole_mass, min(case.window, 2.0)
        one, other = (peak(case, weight, force, window) for weight in (0.0, mass))
        loads = loads_of(spec, case, Estimate.exact(one), Estimate.exact(1e9))
        offset = WEIGHT.bound(spec, spec.all_scenes[0], loads)["tension_dynamic_start"]
        assert offset.low <= other - one <= offset.high
        found.append(abs(other - one) / offset.high)
    assert max(found) > 0.05
