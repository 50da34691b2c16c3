"""A crane that runs askew on its rails."""

import numpy as np

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import skew
from ptmcalc.machines.crane.travelling.machine import guides, model
from ptmcalc.machines.crane.travelling.machine.keys.runway import Guide
from ptmcalc.machines.crane.travelling.machine.model import filled
from ptmcalc.machines.crane.travelling.machine.scenes import Skew
from ptmcalc.machines.crane.travelling.machine.spec import Travelling


def run(spec: Travelling, scene: Skew, carried: frozenset[str], level: int) -> Result:
    """Skewing force of the rail on the front guide, for the worse rail and trolley position.

        alpha = s/a + w/a + alpha_t,   f = mu_0 (1 - exp(-250 alpha)),   S = sum of the wheels' forces across

    Flanges guide at the front wheels, guide rollers ahead of them. Wheel pairs on one shaft are coupled, all others
    rotate independently. The report also contains the force with the friction curve applied to the slip of each wheel.

    **Range** two pairs of wheels; a rigid crane.
    **Error** exact for friction proportional to the slip; the curve of f is empirical.
    **Source** EN 13001-2, ISO 8686-1, EN 1991-3 (`laws.skew`).
    """
    given = spec.guide
    assert given is not None
    least = skew.LEAST_PLAY[given.type]
    angle = skew.skew_angle(
        given.clearance, filled(given.wear), guides.guides_apart(spec), least, given.tolerance, given.edition
    )
    friction = float(skew.skew_friction(min(angle, skew.LARGEST_ANGLE), given.adhesion))
    found = [
        _guide_force(spec, scene, given, angle, hook, guiding)
        for hook in model.hook_places(spec, scene)
        for guiding in ("A", "B")
    ]
    force, hook, guiding = max(both[0] for both in found)
    note = f"guided by rail {guiding}, hook {hook:.3g} m from rail A"
    if angle > skew.LARGEST_ANGLE:
        note += f"; {angle:.3g} rad would be more than {skew.LARGEST_ANGLE} rad"
    return Result(
        {
            "skew_angle": Found(Estimate.exact(angle)),
            "skew_share": Found(Estimate.exact(friction)),
            "skew_force": Found(Estimate.exact(force), note=note),
            "skew_force_slip": Found(Estimate.exact(max(both[1] for both in found)[0])),
        },
        work=1,
    )


def _guide_force(
    spec: Travelling, scene: Skew, given: Guide, angle: float, hook: float, guiding: str
) -> tuple[tuple[float, float, str], tuple[float, float, str]]:
    """Force by the standard, and with the curve of friction at every wheel; hook and guiding rail with each."""
    bodies = [(body.mass, body.across) for body in model.bodies(spec, hook)] + [(model.hanging(spec, scene), hook)]
    whole = sum(mass for mass, _ in bodies)
    centre = sum(mass * across for mass, across in bodies) / whole / spec.gauge
    if guiding == "B":
        centre = 1 - centre
    weights = np.full(2, whole * spec.gravity / 2)
    limited = min(angle, skew.LARGEST_ANGLE)
    friction = float(skew.skew_friction(limited, given.adhesion))
    others = (guides.distances(spec), guides.coupled(spec), weights, centre, spec.gauge, given.rail_two)
    standard = float(skew.skew_forces(friction, *others)[:2].sum())
    each = float(skew.skew_equilibrium(given.adhesion, limited, *others)[:2].sum())
    return (standard, hook, guiding), (each, hook, guiding)


SKEWING: Solver[Travelling, Skew] = Solver(
    name="skewing",
    title="skewing forces",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Skew}),
    represents=frozenset(),
    gives=frozenset({"skew_angle", "skew_share", "skew_force", "skew_force_slip"}),
    run=run,
    cost=lambda spec, scene, carried, level: 1e-4,
    source="EN 13001-2, ISO 8686-1, EN 1991-3: skewing",
)
