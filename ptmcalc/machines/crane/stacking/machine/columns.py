"""The column of a stacker crane as the laws of a mast see it: what gives, what swings, what its weight does.

A column whose `stiffness` the file gives has a rigid root and the bending stiffness that makes that stiffness at its
far end. Of an overhead stacker whose bridge travels, girders that bend sideways lie between bridge and trolley: the
bridge is the base, the trolley sits at the root. The base of a rack stacker does not give.
"""

import math
from dataclasses import dataclass, replace

from ptmcalc.laws import mast, mast_compliance, mast_modes
from ptmcalc.machines.crane.stacking.machine import model
from ptmcalc.machines.crane.stacking.machine.overhead import OverheadStacker
from ptmcalc.machines.crane.stacking.machine.scenes import StackerScene
from ptmcalc.machines.crane.stacking.machine.spec import Stacker

_AT_ROOT = 1e-6
"""Share of the length of a column up to which a carriage is at its root."""


@dataclass(frozen=True, slots=True)
class Swinging:
    """A column, what it carries and what it moves with.

    `compliance` at its far end [m/N]; `exact`: the same as a beam, without what weight does; `weight`: what weight adds
    to the stiffness at the far end, below 0 where the column stands [N/m].
    """

    compliance: mast_compliance.Compliance
    exact: mast_modes.Mast
    weight: float

    @property
    def stiffness(self) -> float:
        """At the far end, without weight [N/m]."""
        return self.compliance.stiffness

    @property
    def base(self) -> float:
        """m1, without any part of the column [kg]."""
        return self.exact.base_mass

    @property
    def total(self) -> float:
        """All that travels [kg]."""
        one = self.exact
        return one.base_mass + one.root_mass + one.column_mass + one.tip_mass

    @property
    def masses(self) -> tuple[float, float, float]:
        """m_11, m_12, m_22 of the shape of a force at the far end [kg]."""
        one, gives = self.exact, self.compliance
        shares = gives.rotation_share, gives.translation_share
        return mast.consistent_masses(
            one.base_mass, one.tip_mass, one.column_mass, one.root_mass, *shares, min(one.place, 1.0)
        )

    @property
    def held(self) -> mast_modes.Mast:
        """With its base at rest."""
        return replace(self.exact, base_mass=math.inf)


def swinging(spec: Stacker, scene: StackerScene, rotor_mass: float = 0.0) -> Swinging:
    """The column of a scene, with the mass of rotors at the rims."""
    gives = compliance(spec, model.direction(spec, scene))
    length = spec.column.length
    base, root = model.base_mass(spec, scene, rotor_mass), 0.0
    if gives.translation > 0:
        assert isinstance(spec, OverheadStacker)
        base, root = base - spec.trolley.mass, spec.trolley.mass
    place, climbs = model.carriage_place(spec, scene) / length, model.climbing_mass(spec, scene)
    if place < _AT_ROOT:  # it moves with the root
        place, climbs, root = 1.0, 0.0, root + climbs
    exact = mast_modes.Mast(
        length=length,
        flexural_stiffness=length**3 / 3 / gives.bending,
        column_mass=spec.column.mass,
        base_mass=base,
        tip_mass=climbs,
        root_mass=root,
        root_rotation=gives.rotation / length**2,
        root_translation=gives.translation,
        place=place,
    )
    return Swinging(gives, exact, _weight(spec, scene, gives))


def standing(spec: Stacker, scene: StackerScene) -> mast_modes.Mast:
    """The column over a base at rest, its head held by a top guide without play."""
    guide = spec.column.top_guide
    stiff = guide.stiffness if guide is not None and guide.gap == 0 else None
    return replace(swinging(spec, scene).held, guide_stiffness=stiff or 0.0)


def compliance(spec: Stacker, direction: model.Direction) -> mast_compliance.Compliance:
    """How far the far end of the column gives along the travel of bridge or base, or across it [m/N]."""
    column = spec.column
    if column.stiffness is not None:
        return mast_compliance.Compliance(1 / column.stiffness, 0.0, 0.0)
    second = column.second_moment_across if direction == "across" else None
    moment = model.filled(second if second is not None else column.second_moment) * column.count
    length = column.length
    joint = length**2 / column.root_stiffness if column.root_stiffness is not None else 0.0
    bending = mast_compliance.column_bending(length, column.elasticity, moment)
    if not isinstance(spec, OverheadStacker):
        return mast_compliance.Compliance(bending, joint, 0.0)
    bridge, trolley, place = spec.bridge, spec.trolley, model.trolley_place(spec)
    vertical = model.filled(bridge.girder_vertical)
    if direction == "along":
        across = model.filled(bridge.girder_horizontal)
        girders = mast_compliance.bridge_travel_compliance(
            length, bridge.elasticity, moment, bridge.span, vertical, across, trolley.gauge, place, bridge.ends,
            trolley.wheels,
        )  # fmt: skip
    else:
        girders = mast_compliance.trolley_travel_compliance(
            length, bridge.elasticity, moment, bridge.span, vertical, place, bridge.ends
        )
    return mast_compliance.Compliance(bending, girders.rotation + joint, girders.translation)


def flexural_stiffness(spec: Stacker, direction: model.Direction) -> float:
    """E J of all masts; of a file that gives the whole stiffness, that of a column with a rigid root [N*m^2]."""
    return float(spec.column.length**3 / 3 / compliance(spec, direction).bending)


def compliance_at(spec: Stacker, scene: StackerScene, place: float) -> mast_compliance.Compliance:
    """Displacement per force so far from the root, in the direction of the scene, without a guide at the head [m/N]."""
    whole, share = compliance(spec, model.direction(spec, scene)), place / spec.column.length
    return mast_compliance.Compliance(whole.bending * share**3, whole.rotation * share**2, whole.translation)


def rest_deflection(spec: Stacker, scene: StackerScene) -> float:
    """Lean of the far end at rest under weights beside its axis, in the direction of a scene [m]."""
    one = swinging(spec, scene)
    moment = abs(model.eccentric_moment(spec, scene, model.direction(spec, scene)))
    beam = one.exact
    root = 1 / beam.root_rotation if beam.root_rotation else math.inf
    lean = mast.leaning(moment, beam.length, beam.flexural_stiffness, root, min(beam.place, 1.0))
    guide = spec.column.top_guide
    held = guide.stiffness if guide is not None and guide.stiffness is not None and guide.gap == 0 else 0.0
    return lean * one.stiffness / (one.stiffness + held)


def _weight(spec: Stacker, scene: StackerScene, gives: mast_compliance.Compliance) -> float:
    attitude = mast.HANGING if model.hangs(spec) else mast.STANDING
    shares = gives.rotation_share, gives.translation_share
    place = model.carriage_place(spec, scene) / spec.column.length
    load, own = (mass * spec.gravity for mass in (model.climbing_mass(spec, scene), spec.column.mass))
    below = mast.gravity_stiffness(load, 0.0, spec.column.length, *shares, attitude) * _slope_share(place, *shares)
    return below + mast.gravity_stiffness(0.0, own, spec.column.length, *shares, attitude)


def _slope_share(place: float, rotation: float, translation: float) -> float:
    """Integral of the square of the shape's slope up to a place, over that of the whole column."""

    def up_to(s: float) -> float:
        alpha = 1 - rotation - translation
        bent = 3 * s**3 - 9 / 4 * s**4 + 9 / 20 * s**5
        both = 3 / 2 * s**2 - s**3 / 2
        return alpha * alpha * bent + 2 * alpha * rotation * both + rotation * rotation * s

    return up_to(place) / up_to(1.0)


def buckling_share(spec: Stacker, scene: StackerScene) -> float:
    """Weight over the weight that would buckle the column, all of it taken to act at the far end [1].

    No work of the weights on any shape is more than this share of the strain energy of that shape: what buckles first
    is the shape with the largest share, and a weight lower down does no more work.
    """
    one = swinging(spec, scene).exact
    weight = (one.tip_mass + one.column_mass) * spec.gravity
    root = 1 / (one.root_rotation * one.flexural_stiffness / one.length) if one.root_rotation else math.inf
    low, high = 0.0, math.pi / 2
    for _ in range(80):  # z tan z = k l/(E J)
        z = (low + high) / 2
        low, high = (z, high) if z * math.tan(z) < root else (low, z)
    return weight / (low * low * one.flexural_stiffness / one.length**2)
