"""The lecture notes beside the swing of the column: two masses, a sudden force, a share of the column at its tip."""

import math

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Finding, Found, Result, of
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import mast, mast_modes
from ptmcalc.machines.crane.stacking.machine.columns import Swinging, swinging
from ptmcalc.machines.crane.stacking.machine.scenes import Brake, DrivenScene, Start
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.machine.travelling import push_of, travels
from ptmcalc.machines.crane.stacking.strength.derived import DERIVED, with_derived

LARGEST_ERROR = 0.05
"""Of the notes' coefficients against the consistent masses, above which the tool says so."""


def run(spec: Stacker, scene: DrivenScene, carried: frozenset[str], level: int) -> Result:
    """Deflection, force and frequency of the mast by the lecture notes.

        m_2 = m + k m_c,   k = 0.236 for a rigid root, 0.305 for a compliant root;   m_1 without the mast
        x = 2 P m_2/(c (m_1 + m_2)),   F = c x,   w = (c (m_1 + m_2)/(m_1 m_2))^(1/2)

    A base on a speed ramp has x = 2 a m_2/c and w = (c/m_2)^(1/2).

    **Range** a sudden force that lasts longer than half a period, no damping, no gravity effect.
    **Error** no bound: a slowly rising force causes half of this value, a light mast with a heavy load 6 % less.
    **Source** N. Yu. Dorokhov, lecture notes, Kramatorsk 2007 (stacker cranes).
    """
    push = push_of(spec, scene)
    one = swinging(spec, scene, push.rotors)
    kept, c = coefficient(one), one.stiffness
    tip = one.exact.tip_mass + kept * one.exact.column_mass
    base = one.base + one.exact.root_mass
    if push.size <= 0:
        return Result({}, work=1)
    if push.kind == "ramp":
        deflection, frequency = 2 * push.size * tip / c, math.sqrt(c / tip)
    else:
        deflection = mast.notes_deflection(push.size, c, base, one.exact.tip_mass, one.exact.column_mass, kept)
        frequency = math.sqrt(c / base + c / tip)
    loads = {
        "mast_deflection_max": deflection,
        "mast_force_max": c * deflection,
        "mast_moment_max": c * deflection * spec.column.length,
        of("natural_frequency", "1"): frequency,
        "period": 2 * math.pi / frequency,
    }
    found = {name: Found(Estimate.unknown(value)) for name, value in loads.items()}
    return Result(with_derived(spec, scene, found), work=1)


def coefficient(one: Swinging) -> float:
    """The notes' share of the column at its tip [1]."""
    return mast.NOTES_ELASTIC if one.compliance.rotation_share > 0 else mast.NOTES_RIGID


def lumping_error(one: Swinging, moved: bool) -> tuple[float, float]:
    """What the notes' masses have too much of frequency and deflection, as shares of the exact ones.

    The frequency is that of the exact beam; the deflection of the tip is exact by the consistent masses.
    """
    kept = coefficient(one)
    tip = one.exact.tip_mass + kept * one.exact.column_mass
    base = one.base + one.exact.root_mass
    m11, m12, m22 = one.masses
    if moved:
        exact = mast_modes.mast_frequency(one.held, 1)
        return math.sqrt(one.stiffness / tip) / exact - 1, tip / (m22 + m12) - 1
    exact = mast_modes.mast_frequency(one.exact, 1)
    notes = math.sqrt(one.stiffness / base + one.stiffness / tip)
    lag = mast.static_lag(1.0, 1.0, m11, m12, m22)
    return notes / exact - 1, tip / (base + tip) / lag - 1


def remarks(one: Swinging, scene: DrivenScene, moved: bool) -> tuple[Finding, ...]:
    """What the tool says of the notes' coefficients where they are far off."""
    frequency, deflection = lumping_error(one, moved)
    if max(abs(frequency), abs(deflection)) <= LARGEST_ERROR:
        return ()
    text = (
        f"scene `{scene.label}`: with the share {coefficient(one):g} of the mast mass at its tip, as in the notes, the"
        f" frequency is {_percent(frequency)} and the deflection {_percent(deflection)}"
    )
    return (Finding("NUM107", text, ("column", "mass"), "use the values of `mast_two_mass` or `mast_modal`"),)


def _percent(share: float) -> str:
    return f"{abs(share):.1%} too {'large' if share > 0 else 'small'}"


MAST_HANDBOOK: Solver[Stacker, DrivenScene] = Solver(
    name="mast_handbook",
    title="handbook mast: 0.236 or 0.305 of the mast mass at the tip",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Start, Brake}),
    represents=frozenset(),
    gives=frozenset(
        {
            "mast_deflection_max",
            "mast_force_max",
            "mast_moment_max",
            "natural_frequency",
            "period",
        }
    )
    | DERIVED,
    run=run,
    cost=lambda spec, scene, carried, level: 2e-3,
    valid=travels,
    source="N. Yu. Dorokhov, lecture notes, Kramatorsk 2007",
    decides=False,
)
