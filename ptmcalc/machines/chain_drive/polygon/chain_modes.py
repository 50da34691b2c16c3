"""Natural frequencies of the chain, and the speeds at which the teeth meet them."""

import math

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Finding, Found, Result, of
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import chain_resonance
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, Run
from ptmcalc.machines.chain_drive.polygon.excitation import POLYGON, WEAK, tooth_frequency
from ptmcalc.machines.chain_drive.polygon.resonances import Resonances, operating_range, resonances, safe_speeds


def run(spec: ChainDrive, scene: Run, carried: frozenset[str], level: int) -> Result:
    """Resonance speeds of all tooth harmonics and modes, and the safe speed ranges between them.

        V_nk = p f_k/n,   too near: |V/V_nk - 1| < max(band, 2 zeta_k) where W_nk reaches the weight of the file

    **Range** light damping; the modes of the whole chain with its ends, 64 harmonics and 12 modes.
    **Error** rounding of the frequencies, which are roots of the exact frequency equations.
    **Source** `laws.chain_resonance`, `laws.belt_modes`.
    """
    found = resonances(spec, scene, carried)
    loads = {name: Found(Estimate.exact(value)) for name, value in loads_of(spec, found).items()}
    if spec.chain.section is not None and spec.chain.modulus is not None:
        factor = chain_resonance.textbook_resonance_factor(spec.chain.modulus, spec.gravity, "quarter")
        steel = chain_resonance.textbook_resonance_modulus(TEXTBOOK_K, spec.gravity, "quarter")
        note = (
            f"for A in cm2, q in N/m, V in m/s; the printed range of 3000 to 4000 has {TEXTBOOK_K:.0f} in its middle,"
            f" which implies a modulus of {units.show(steel, units.STRESS)}"
        )
        loads["resonance_factor_textbook"] = Found(Estimate.exact(factor), note=note)
    return Result(loads, work=1, findings=_findings(spec, scene, carried, found))


TEXTBOOK_K = 3500.0
"""Coefficient of the resonance speed of lecture notes Kramatorsk 2007, for A in cm2, q in N/m and V in m/s [1]: the
middle of the printed range 3000 to 4000. The textbook's resonance speed is proportional to it."""

FREQUENCIES, ORDERS, WINDOWS = 3, 6, 8
"""Numbers of natural frequencies (`FREQUENCIES`), tooth harmonics (`ORDERS`) and safe speed ranges (`WINDOWS`) that are
reported. Engineering choices: more lengthen the report. Different numbers change the names of the loads."""


def loads_of(spec: ChainDrive, found: Resonances) -> dict[str, float]:
    """Resonance speeds, the distance of the speed from the nearest that matters (in the band of the file, where twice
    the damping ratio makes a wider one), and what is safe."""
    nearest = found.nearest(spec.speed)
    below, above = chain_resonance.nearest_safe_speeds(spec.speed, found.bands)
    loads = {
        "resonance_speed_first": float(found.speeds[0, 0]),
        "frequency_ratio": float(tooth_frequency(spec, spec.speed)) / float(found.frequencies[0]),
        "resonance_distance": nearest[0] * spec.checks.resonance.band if nearest else math.inf,
        "safe_speed_below": below,
        "safe_speed_above": above,
    }
    for mode in range(FREQUENCIES):
        loads[of("natural_frequency", str(mode + 1))] = float(found.frequencies[mode])
        for order in range(ORDERS):
            loads[of("resonance_speed", f"{order + 1},{mode + 1}")] = float(found.speeds[order, mode])
    windows = chain_resonance.safe_windows(found.bands, *operating_range(spec))
    for index, (low, high) in enumerate(windows[:WINDOWS].tolist(), 1):
        loads[of("safe_window_low", str(index))], loads[of("safe_window_high", str(index))] = low, high
    return loads


def _findings(spec: ChainDrive, scene: Run, carried: frozenset[str], found: Resonances) -> tuple[Finding, ...]:
    """Where the speed is too near a resonance: which one, and the nearest speeds that are not, in any run."""
    nearest = found.nearest(spec.speed)
    if nearest is None or nearest[0] >= 1:
        return ()
    _, order, mode = nearest
    below, above = safe_speeds(spec, scene, carried)
    meets = units.show(float(found.speeds[order - 1, mode - 1]), units.SPEED)
    known = [
        (_outward(speed, up), abs(speed - spec.speed)) for speed, up in ((below, False), (above, True)) if speed > 0
    ]
    safe = [units.show(speed, units.SPEED) for speed, _ in known]
    nearer = units.show(min(known, key=lambda one: one[1])[0], units.SPEED)
    message = (
        f"scene `{scene.label}`: harmonic {order} of the teeth coincides with natural frequency {mode} of the chain at"
        f" {meets}; the nearest speeds outside the bands of resonances are {' and '.join(safe)}"
    )
    return (Finding("NUM109", message, ("speed",), f"write e.g. `speed: {nearer}`"),)


def _outward(speed: float, up: bool) -> float:
    """Three digits of a speed, away from the band it ends."""
    scale = 10.0 ** (2 - math.floor(math.log10(speed)))
    return (math.ceil if up else math.floor)(speed * scale) / scale


CHAIN_MODES: Solver[ChainDrive, Run] = Solver(
    name="chain_modes",
    title="natural frequencies and resonance speeds",
    fidelity=Fidelity.MODAL,
    scenes=frozenset({Run}),
    represents=frozenset({POLYGON, WEAK}),
    gives=frozenset(
        {
            "resonance_speed_first",
            "frequency_ratio",
            "resonance_distance",
            "safe_speed_below",
            "safe_speed_above",
            "natural_frequency",
            "resonance_speed",
            "safe_window_low",
            "safe_window_high",
            "resonance_factor_textbook",
        }
    ),
    run=run,
    cost=lambda spec, scene, carried, level: 6.2e-3,
    source="frequency equations of two strands in series; tooth frequency V/p",
    always=frozenset({POLYGON}),
)
