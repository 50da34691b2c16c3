"""What a physical model of a machine would show: its loads by the scales of a law of similarity.

A model that keeps a law is the machine with every value of its file times the scale of its dimension, and so is every
load of it:

    C = C_m^a C_l^b C_t^c     of a quantity in kg^a m^b s^c; ratios and angles keep their size

One value is not the builder's to choose: gravity. The law asks for C_l/C_t^2, the place of the model gives C_g. This
is the group E/(rho g L) of the table of scales, the only one that a law leaves open: `full` and `ballast` keep it,
`geometric` does not. A model with the wrong gravity does what the prototype, scaled by the law, would do in

    g' = g C_g C_t^2/C_l      geometric: g C_rho C_g C_l/C_E

**Rule**: gravity affects the loads that a second settling of the scenes in g' moves by more than their numerical bars
and rounding. They have no scale: they are named as distorted, and the model's value is that of the second settling.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from ptmcalc.base.errors import UsageError
from ptmcalc.base.estimate import Estimate
from ptmcalc.base.units import Quantity
from ptmcalc.contract.machine import AnyKind
from ptmcalc.contract.result import Finding, LoadInfo
from ptmcalc.engine.check import chosen_scenes
from ptmcalc.engine.load import measure_at
from ptmcalc.engine.plan import plan
from ptmcalc.engine.run import settle
from ptmcalc.engine.settled import Settled
from ptmcalc.laws import similarity
from ptmcalc.laws.similarity import FULL, Scales
from ptmcalc.spec.machine import MachineSpec

_GRAVITY = ("gravity",)
_ROUNDING = 1e-9
"""Rounding of a difference of two loads relative to the larger [1], above the resolution 2e-16 of the floating point. A
smaller value reports rounding as an effect of gravity; a larger one hides small effects."""
_SAME = 1e-9
"""Relative tolerance at which a scale counts as that of the law [1], above the resolution 2e-16 of the floating point.
A smaller value adds remarks for rounding; a larger one hides a deviation from the law."""
_LEFT_OPEN = "of modulus, density and gravity one that is left out follows"


@dataclass(frozen=True, slots=True)
class PhysicalModel:
    """How a model is built: the law, and model over prototype of length, elastic modulus, density and gravity [1].

    `follows` names the ratio that nobody gave and the law asks for.

    Raises:
        UsageError: no model of this law has these ratios.
    """

    law: str
    length: float
    modulus: float = 1.0
    density: float = 1.0
    gravity: float = 1.0
    follows: str = ""

    def __post_init__(self) -> None:
        try:
            _ = self.scales
        except ValueError as error:
            raise UsageError(str(error), _LEFT_OPEN if self.law == FULL else "") from None

    @property
    def scales(self) -> Scales:
        """The scales of its law."""
        return similarity.scales(self.law, self.length, self.modulus, self.density, self.gravity)

    @property
    def gravity_over_law(self) -> float:
        """The model's gravity over the one that its law asks for [1]."""
        of = self.scales.acceleration
        return 1.0 if math.isclose(self.gravity, of, rel_tol=_SAME) else self.gravity / of


def physical_model(
    law: str,
    length: float,
    modulus: float | None = None,
    density: float | None = None,
    gravity: float | None = None,
) -> PhysicalModel:
    """A model of which some ratios may be left open.

        full:  C_E = C_rho C_g C_l

    A ratio that is not given is 1. Under `full` one of them cannot be chosen: the first not given of modulus, density
    and gravity follows from the others, in this order, as a soft material is easier to come by than a heavy one, and
    both than a centrifuge.

    Raises:
        UsageError: no model of this law has these ratios.
    """
    open_ones = {"modulus": modulus, "density": density, "gravity": gravity}
    follows = next((name for name, ratio in open_ones.items() if law == FULL and ratio is None), "")
    ratios = {name: 1.0 if ratio is None else ratio for name, ratio in open_ones.items()}
    if follows == "modulus":
        ratios[follows] = ratios["density"] * ratios["gravity"] * length
    elif follows:
        ratios[follows] = ratios["modulus"] / (ratios["density"] * ratios["gravity"] * length)
    return PhysicalModel(law, length, **ratios, follows=follows)


@dataclass(frozen=True, slots=True)
class ModelLoad:
    """A load of the machine and of its model; without a scale where the law does not give one.

    `model` is None where the model's state has no such load.
    """

    scene: str
    info: LoadInfo
    prototype: Estimate
    model: Estimate | None
    scale: float | None
    similar: float
    """the prototype's value times the scale of its quantity: what the model would show if it were similar"""


@dataclass(frozen=True, slots=True)
class ModelReport:
    """What a model shows, and what it shows wrongly."""

    model: PhysicalModel
    loads: tuple[ModelLoad, ...]
    distortions: tuple[str, ...]
    findings: tuple[Finding, ...] = ()


def scale_of(quantity: Quantity, of: Scales) -> float:
    """Model over prototype of a quantity, from its dimension [1]."""
    mass, length, time = quantity.dimension[:3]
    return of.mass**mass * of.length**length * of.time**time


def report_on(kind: AnyKind, spec: MachineSpec, model: PhysicalModel, scenes: tuple[str, ...] = ()) -> ModelReport:
    """The loads of a machine and of its model, for all scenes or for some.

    Raises:
        UsageError: no scene of that name, or a gravity that no machine can be computed in.
    """
    of, wrong = model.scales, model.gravity_over_law
    settled = _settled(kind, spec, scenes)
    again = settled if wrong == 1 else _settled(kind, _in_gravity(spec, wrong), scenes)
    loads = [
        _load(one, other, info, scale_of(info.quantity, of))
        for one, other in zip(settled, again, strict=True)
        for info in kind.loads_of(spec)
        if info.name in one.loads and info.name not in _figures_of_health(one)
    ]
    findings = dict.fromkeys(finding for one in (*settled, *again) for finding in one.said)
    return ModelReport(model, tuple(loads), _distortions(model, loads), tuple(findings))


def _settled(kind: AnyKind, spec: MachineSpec, scenes: tuple[str, ...]) -> list[Settled]:
    return [settle(kind, spec, scene) for scene in plan(kind, spec, chosen_scenes(spec, scenes)).scenes]


def _in_gravity(spec: MachineSpec, factor: float) -> MachineSpec:
    changed, measure = spec.gravity * factor, measure_at(spec, _GRAVITY)
    limit = measure.broken_by(changed) if measure else ""
    if limit:
        raise UsageError(
            f"the gravity of such a model is {factor:.4g} times the one that its law requires, out of range",
            f"in the prototype's terms it must be {limit}",
        )
    return spec.with_value(_GRAVITY, changed)


def _figures_of_health(settled: Settled) -> set[str]:
    """Names of what a run says of its own numerics: no model has them."""
    return {name for run in settled.runs for name in run.result.health}


def _load(one: Settled, other: Settled, info: LoadInfo, scale: float) -> ModelLoad:
    prototype = one.loads[info.name].estimate
    found = other.loads.get(info.name)
    changed = found.estimate if found else None
    moved = changed is None or _moved(prototype, changed)
    return ModelLoad(
        scene=one.plan.scene.label,
        info=info,
        prototype=prototype,
        model=_times(changed if moved else prototype, scale),
        scale=None if moved else scale,
        similar=prototype.value * scale,
    )


def _moved(one: Estimate, other: Estimate) -> bool:
    if one.value == other.value or not math.isfinite(one.value - other.value):
        return one.value != other.value
    rounding = _ROUNDING * max(abs(one.value), abs(other.value))
    return not abs(one.value - other.value) <= one.numerical + other.numerical + rounding


def _times(estimate: Estimate | None, scale: float) -> Estimate | None:
    if estimate is None:
        return None
    return Estimate(
        estimate.value * scale,
        estimate.low * scale,
        estimate.high * scale,
        estimate.numerical * scale,
        estimate.model * scale,
    )


def _distortions(model: PhysicalModel, loads: Sequence[ModelLoad]) -> tuple[str, ...]:
    """What a model shows wrongly, in sentences: by its law, and by what no law of similarity scales."""
    of, wrong = model.scales, model.gravity_over_law
    said = list(similarity.distortions(model.law, model.length, model.modulus, model.density, model.gravity))
    if wrong != 1:
        names = ", ".join(dict.fromkeys(f"`{load.info.name}`" for load in loads if load.scale is None))
        said.append(
            f"gravity affects {names}: the model shows of them what the prototype would show under {wrong:.4g} times"
            " its gravity, not the scale times their value"
            if names
            else "gravity affects no load of this machine as the file describes it"
        )
        said.append(
            f"a weight that the file gives as a force or a torque counts as external, to be applied as {of.force:.4g}"
            f" of the prototype's force, {of.moment:.4g} of its torque; the weight of the copied mass is {wrong:.4g}"
            " times that"
        )
    if not math.isclose(of.stress, 1, rel_tol=_SAME):
        said.append(
            f"the strength of a material does not follow its modulus: a safety against breaking is the prototype's"
            f" only with a strength {of.stress:.4g} times the prototype's"
        )
    said += [
        f"clearance due to tolerances does not shrink with the machine: it has to be {of.length:.4g} times the"
        " prototype's, as an angle the same",
        f"delays, rise times and ramps are those of the model's controls: they have to be {of.time:.4g} times the"
        f" prototype's, rotational speeds {of.frequency:.4g} times",
    ]
    return tuple(said)
