"""Stress of the drum: shell under the wound rope, edge of the winding, one wrap, and the flanges."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import Check, LimitState, Sense, at, blames, only
from ptmcalc.contract.limits import fixed
from ptmcalc.contract.result import Found, LoadInfo, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.contract.topic import Topic
from ptmcalc.laws import drum_shell, rope_drum
from ptmcalc.machines.hoist.machine import model
from ptmcalc.machines.hoist.machine.keys.tackle import DrumShell
from ptmcalc.machines.hoist.machine.model import filled, loaded
from ptmcalc.machines.hoist.machine.spec import Hoist, HoistScene, Run

FACTOR, HOOP, LEFT = "shell_layer_factor", "shell_hoop_stress", "shell_pull_left"
EDGE, WRAP, WRAP_HANDBOOK = "shell_edge_bending", "shell_wrap_bending", "shell_wrap_bending_handbook"
WRAP_HOOP, BEAM, SHEAR = "shell_wrap_hoop_handbook", "shell_beam_bending", "shell_torsion"
STRESS, THRUST, FLANGE = "shell_equivalent_stress", "flange_thrust_stress", "flange_stress"

LOADS = (
    LoadInfo(FACTOR, "pressure on the shell / that of the first layer", units.RATIO),
    LoadInfo(HOOP, "drum shell hoop stress, design pull", units.STRESS),
    LoadInfo(LEFT, "pull left in the first layer / rope pull", units.RATIO),
    LoadInfo(EDGE, "axial bending stress at the edge of the winding", units.STRESS, headline=False),
    LoadInfo(WRAP, "axial bending stress under one wrap", units.STRESS, headline=False),
    LoadInfo(WRAP_HANDBOOK, "axial bending stress under one wrap, handbook", units.STRESS, headline=False),
    LoadInfo(WRAP_HOOP, "hoop stress under one wrap, handbook", units.STRESS, headline=False),
    LoadInfo(BEAM, "bending stress of the drum as a beam", units.STRESS, headline=False),
    LoadInfo(SHEAR, "torsional stress of the drum", units.STRESS, headline=False),
    LoadInfo(THRUST, "axial stress of the shell by the flanges", units.STRESS, headline=False),
    LoadInfo(STRESS, "drum shell equivalent stress", units.STRESS, governing=True),
    LoadInfo(FLANGE, "flange bending stress at the shell", units.STRESS, governing=True),
)
_PLACES = np.linspace(0.0, 2 * math.pi, 2001)
"""Places from the edge of the winding at which the stress is evaluated, in units of 1/beta; a numerical choice. Steps
of 0.003 find a maximum to about 1e-6; beyond 2 pi the edge changes less than 0.2 %."""
_HANDBOOK_BENDING, _HANDBOOK_HOOP = 0.96, 0.85
"""Handbook values of one wrap, averages over the width of the rope [1]: bending relative to F/(sqrt(D) t^1.5), hoop
stress relative to F/(p t). They decide no verdict."""


@dataclass(frozen=True, slots=True)
class Shell:
    """A drum under its rope as numbers."""

    pull: float
    """of one rope, with the dynamic factor [N]"""
    layers: int
    radius: float
    """of the middle of the shell [m]"""
    thickness: float
    """m"""
    pitch: float
    """m"""
    factor: float
    """C_n, pressure of all layers over that of the first [1]"""
    elastic: tuple[float, ...]
    """C_1 ... C_n of elastic layers [1]"""
    left: float
    """pull left in the first layer [1]"""

    @property
    def first(self) -> float:
        """Hoop stress of the first layer [N/m^2]."""
        return self.pull / (self.pitch * self.thickness)


def load_factor(spec: Hoist, given: DrumShell) -> float | None:
    """phi of the file, else phi_2 of the hoisting class; None without either [1]."""
    return given.load_factor if given.load_factor is not None else model.class_factor(spec)


def layer_factor(spec: Hoist, given: DrumShell, layers: int, elastic: float) -> float | None:
    """C_n by the rule of the file; None where it has none for so many layers [1]."""
    if spec.checks.layer_factor is not None:
        return spec.checks.layer_factor
    if given.layers == "elastic":
        return elastic
    return rope_drum.layer_factor(layers) if layers <= model.MOST_LAYERS_KNOWN else None


def shell_of(spec: Hoist) -> Shell | None:
    """The shell with the hook at its highest and the rated load; None where the file lacks its data."""
    given, thickness = spec.drum.shell, spec.drum.shell_thickness
    if given is None or thickness is None:
        return None
    phi, layers, pitch = load_factor(spec, given), model.wound(spec, spec.height).layers, model.pitch(spec)
    if phi is None or layers > model.MOST_LAYERS:
        return None
    stiffness = filled(spec.rope.modulus) * model.metallic_area(spec)
    compliance = stiffness / (given.modulus * thickness * pitch)
    elastic = drum_shell.layer_pressures(layers, compliance)
    factor = layer_factor(spec, given, layers, elastic[-1])
    if factor is None:
        return None
    pull = phi * model.pulls(spec, spec.hook_block + spec.load, 0.0, hauling=True).drum
    radius = spec.drum.diameter / 2 - thickness / 2
    left = drum_shell.pull_left(layers, compliance)
    return Shell(pull, layers, radius, thickness, pitch, factor, elastic, left)


def beam_stresses(spec: Hoist, given: DrumShell, shell: Shell) -> tuple[float, float]:
    """Bending and torsion of the drum as a beam on two bearings [N/m^2].

        s_b = n F L/4/(pi R^2 t),   tau = n F R_n/(2 pi R^2 t)

    **Range** n ropes at the middle of the span L, the whole torque in every section.
    **Error** an upper bound: ropes away from the middle bend less.
    **Source** theory of beams.
    """
    ropes, section = spec.reeving.ropes, math.pi * shell.radius**2 * shell.thickness
    span = given.span if given.span is not None else ropes * spec.drum.length
    bending = ropes * shell.pull * span / 4 / section
    return bending, ropes * shell.pull * model.layer_radius(spec, shell.layers) / (2 * section)


def flange(spec: Hoist, given: DrumShell, shell: Shell) -> tuple[float, float]:
    """Thrust [N/m] and moment [N] of a flange at the shell; 0 in one layer, which does not press on it.

    Layer k presses with k_a C_(n-k+1) F/(p R), the pressure at its bottom, over its height.
    """
    if shell.layers == 1:
        return 0.0, 0.0
    radius, step, d = spec.drum.diameter / 2, model.layer_step(spec), spec.rope.diameter
    per_layer = given.flange_pressure * shell.pull / (shell.pitch * radius)
    per_layer *= shell.factor / shell.elastic[-1]
    pressures = [per_layer * one for one in reversed(shell.elastic)]
    radii = [radius + k * step for k in range(shell.layers)]
    return drum_shell.flange_loads(pressures, [*radii, radii[-1] + d], radius)


def largest_stress(shell: Shell, axial: tuple[float, ...], shear: float) -> float:
    """Largest equivalent stress inside the winding, near its edge and under one wrap [N/m^2].

    Args:
        shell: the drum under its rope.
        axial: possible membrane stresses along the shell [N/m^2].
        shear: torsional stress [N/m^2].
    """
    hoop, bending = (shell.factor * shell.first * one for one in drum_shell.edge_of_winding(_PLACES))
    wrap_hoop, wrap = drum_shell.single_wrap(shell.pull, shell.radius, shell.thickness)
    hoops = np.append(hoop, [shell.factor * shell.first, wrap_hoop])
    bends = np.append(bending, [0.0, wrap])
    found = 0.0
    for along in axial:
        for side in (1.0, -1.0):
            stress = drum_shell.equivalent_stress(
                along + side * bends, -hoops + side * drum_shell.POISSON * bends, shear
            )
            found = max(found, float(stress.max()))
    return found


def run(spec: Hoist, scene: HoistScene, carried: frozenset[str], level: int) -> Result:
    """Stresses of the drum under the design pull.

        F = phi S
        hoop: C F/(p t),   edge of the winding: 0.293 C F/(p t),   one wrap: 1.65 F/(sqrt(D) t^1.5)
        shell: max sqrt(s_x^2 - s_x s_t + s_t^2 + 3 tau^2),   flange: 6 M/t_f^2

    The maximum is over both faces of the shell, along the edge of the winding, and both signs of the bending of the
    drum as a beam.

    **Range** long thin shells without stiffeners, one dynamic factor; fatigue of welds and end discs is not covered.
    **Error** 1e-6 of the maximum along the shell; the layer factor, beam and flange are upper bounds.
    **Source** `laws.drum_shell`; DNV 2.22:2011 for two layers, to be confirmed.
    """
    given, shell = spec.drum.shell, shell_of(spec)
    if given is None or shell is None:
        return Result({}, work=1)
    beam, torsion = beam_stresses(spec, given, shell)
    thrust, moment = flange(spec, given, shell)
    pushed = thrust / shell.thickness
    axial = tuple(sign * beam + push for sign in (1.0, -1.0) for push in {0.0, pushed})
    whole, size = shell.factor * shell.first, shell.pull / math.sqrt(2 * shell.radius * shell.thickness**3)
    loads = {
        FACTOR: shell.factor,
        HOOP: whole,
        LEFT: shell.left,
        EDGE: whole * float(drum_shell.edge_of_winding(np.array([math.pi / 4]))[1][0]),
        WRAP: drum_shell.single_wrap(shell.pull, shell.radius, shell.thickness)[1],
        WRAP_HANDBOOK: _HANDBOOK_BENDING * size,
        WRAP_HOOP: _HANDBOOK_HOOP * shell.first,
        BEAM: beam,
        SHEAR: torsion,
        THRUST: pushed,
        STRESS: largest_stress(shell, axial, torsion),
    }
    found = {name: Found(Estimate.exact(value)) for name, value in loads.items()}
    note = "; ".join(_notes(spec, given))
    found[STRESS] = Found(Estimate.within(loads[STRESS], 1e-6 * loads[STRESS]), note=note)
    if given.flange_thickness is not None:
        found[FLANGE] = Found(Estimate.exact(6 * moment / given.flange_thickness**2))
    return Result(found, work=1)


def _notes(spec: Hoist, given: DrumShell) -> Iterator[str]:
    """What a reader of the stress must know."""
    rule = "of the file" if spec.checks.layer_factor is not None else {"elastic": "of elastic layers"}.get(given.layers)
    yield f"layer factor {rule or 'of DNV 2.22:2011, to be compared with the standard'}"
    if "safety" not in given.model_fields_set:
        yield "safety 1.5 (FEM 1.001, case I), to be compared with the standard"
    if given.material is not None:
        yield "yield strength of EN 10025-2, to be compared with the certificate"


SOLVER: Solver[Hoist, HoistScene] = Solver(
    name="drum_shell",
    title="stress of the drum shell and its flanges",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Run}),
    represents=frozenset(),
    gives=frozenset(info.name for info in LOADS),
    run=run,
    cost=lambda spec, scene, carried, level: 2e-3,
    source="theory of shells of revolution; DNV 2.22:2011 for two layers",
)


def _wanted(spec: Hoist, scene: HoistScene) -> bool:
    return loaded(spec, scene) and spec.drum.shell is not None


def _layered(spec: Hoist, scene: HoistScene) -> bool:
    return _wanted(spec, scene) and model.wound(spec, spec.height).layers > 1


def _flanged(spec: Hoist, scene: HoistScene) -> bool:
    given = spec.drum.shell
    return _layered(spec, scene) and given is not None and given.flange_thickness is not None


def _needs(spec: Hoist, scene: HoistScene) -> tuple[KeyPath, ...]:
    given = spec.drum.shell
    missing: tuple[KeyPath, ...] = (("drum", "shell_thickness"),)
    if given is not None and load_factor(spec, given) is None:
        missing += (("drum", "shell", "load_factor"),)
    if given is not None and layer_factor(spec, given, model.wound(spec, spec.height).layers, 1.0) is None:
        missing += (("checks", "layer_factor"),)
    return missing


def _permissible(spec: Hoist, thickness: float | None) -> Estimate:
    given = spec.drum.shell
    if given is None or thickness is None:
        return Estimate.exact(math.inf)
    strength = given.yield_strength
    if strength is None and given.material is not None:
        strength = drum_shell.yield_strength(given.material, thickness)
    return Estimate.exact(math.inf if strength is None else strength / given.safety)


def _of_shell(spec: Hoist, scene: Run) -> Estimate:
    """Yield strength of the shell over the safety of the file, 1.5 by default.

    **Range** ductile materials; steels of EN 10025-2 up to 100 mm.
    **Error** none: a chosen limit.
    **Source** FEM 1.001, case I: 1.5, to be compared; EN 13001-3-1 with gamma_p gamma_m = 1.34 1.1 is 1.474.
    """
    return _permissible(spec, spec.drum.shell_thickness)


def _of_flange(spec: Hoist, scene: Run) -> Estimate:
    """Yield strength of the flange over the safety of the file, 1.5 by default.

    **Range** as the shell, of the same material.
    **Error** none: a chosen limit.
    **Source** FEM 1.001, case I: 1.5, to be compared.
    """
    return _permissible(spec, spec.drum.shell.flange_thickness if spec.drum.shell is not None else None)


SHELL: Check[Hoist, Run] = only(_wanted)(
    Check(
        code="HST158",
        hazard=True,
        title="drum shell equivalent stress",
        question="Is the equivalent stress of the drum shell permissible?",
        failure="drum shell is overstressed",
        scenes=frozenset({Run}),
        loads=(STRESS,),
        sense=Sense.AT_MOST,
        limit=_of_shell,
        needs=_needs,
        blame=blames("drum", "shell_thickness"),
        repair=at("drum", "shell_thickness"),
        what="The largest equivalent stress of the shell under all layers, at the edge of the winding and under one"
        " wrap is at most the yield strength divided by the safety.",
        why="The wound rope compresses the shell and bends it at the edge of the winding. Drums crack or collapse.",
        formula="max sqrt(s_x^2 - s_x s_t + s_t^2 + 3 tau^2) <= f_y/nu",
        source="theory of shells; FEM 1.001 for the safety, to be compared",
    )
)

SLACK_LAYER: Check[Hoist, Run] = only(_layered)(
    Check(
        code="HST159",
        title="pull left in the first layer",
        question="Does the first layer stay taut under the layers wound on it?",
        failure="first layer goes slack under the upper layers",
        limit_state=LimitState("first layer is slack", 0),
        scenes=frozenset({Run}),
        loads=(LEFT,),
        sense=Sense.AT_LEAST,
        limit=fixed(
            0.0,
            meaning="0: the first layer keeps a tension",
            valid="several layers wound with one pull",
            error="none: a rope carries no compression",
            source="derived; `laws.drum_shell.pull_left`",
        ),
        needs=_needs,
        blame=blames("drum", "shell_thickness"),
        repair=at("drum", "shell_thickness"),
        what="After all layers are wound, the first layer keeps a part of its pull.",
        why="Upper layers cut into a slack layer. The layer factor of the shell is then not valid either.",
        formula="1 - sum kappa/(1 + (k - 1) kappa) >= 0,   kappa = E_r A_r/(E t p)",
        source="derived: each layer compresses the shell and the layers below",
    )
)

FLANGE_STRESS: Check[Hoist, Run] = only(_flanged)(
    Check(
        code="HST160",
        hazard=True,
        title="flange bending stress at the shell",
        question="Is the bending stress of the flanges permissible?",
        failure="drum flanges are overstressed",
        scenes=frozenset({Run}),
        loads=(FLANGE,),
        sense=Sense.AT_MOST,
        limit=_of_flange,
        needs=_needs,
        blame=blames("drum", "shell", "flange_thickness"),
        repair=at("drum", "shell", "flange_thickness"),
        what="The bending stress of a flange at the shell, under the axial pressure of the layers, is at most the yield"
        " strength divided by the safety.",
        why="The layers of a rope push the flanges apart. A weld at the shell cracks first.",
        formula="6 M/t_f^2 <= f_y/nu",
        source="equilibrium of a sector; the axial pressure an engineering value, to be compared",
    )
)

DRUM_SHELL: Topic[Hoist] = Topic(loads=LOADS, solvers=(SOLVER,), checks=(SHELL, SLACK_LAYER, FLANGE_STRESS))
