"""A wheel that runs over a step or a gap of the rail."""

import math

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import rail
from ptmcalc.machines.crane.travelling.machine import model
from ptmcalc.machines.crane.travelling.machine.model import filled
from ptmcalc.machines.crane.travelling.machine.scenes import RailStep
from ptmcalc.machines.crane.travelling.machine.spec import Travelling
from ptmcalc.machines.crane.travelling.rail.effects import RAIL

Numbers = dict[str, float]


def run(spec: Travelling, scene: RailStep, carried: frozenset[str], level: int) -> Result:
    """Maximum and minimum wheel load from the complete response of the mass above the wheels.

        u'' + omega^2 u = omega^2 a(t)/a_max:   phi_4 = 1 + (pi/2)^2 v^2/(g r) max u

    During the climb and after it, the worse of step and gap.

    **Range** one vertical mode without damping, initially at rest; steps and gaps small relative to the wheel.
    **Error** exact for that model; a minimum wheel load below 0 means that a wheel leaves the rail.
    **Source** `laws.rail`; the model of EN 13001-2 and ISO 8686-1.
    """
    pairs = [(number, rail.step_extremes(number)) for number in _step_numbers(spec, scene)] + [
        (number, rail.gap_extremes(number)) for number in _gap_numbers(spec, scene)
    ]
    more, less = max(pair[1][0] for pair in pairs), max(pair[1][1] for pair in pairs)
    loads = {"phi4": _factor(spec, scene, more), "rail_contact": _factor(spec, scene, -less)}
    return Result({name: Found(Estimate.exact(value)) for name, value in loads.items()}, work=1)


def standard(spec: Travelling, scene: RailStep, carried: frozenset[str], level: int) -> Result:
    """Factor of the standard from the residual oscillation after the step or gap.

        phi_4 = 1 + (pi/2)^2 v^2/(g r) xi(alpha)

    **Range** as `rail_response`.
    **Error** no bound: for alpha above 1 the acceleration of the mass is larger while the wheel still climbs.
    **Source** EN 13001-2, ISO 8686-1, travelling on an uneven surface.
    """
    answers = [float(rail.residual_step(number)) for number in _step_numbers(spec, scene)]
    answers += [float(rail.residual_gap(number)) for number in _gap_numbers(spec, scene)]
    return Result({"phi4": Found(Estimate.unknown(_factor(spec, scene, max(answers))))}, work=1)


def _speed(spec: Travelling, scene: RailStep) -> float:
    return scene.speed_share * spec.speed


def _frequency(spec: Travelling) -> float:
    return 2 * math.pi * filled(spec.rail.frequency)


def _step_numbers(spec: Travelling, scene: RailStep) -> list[float]:
    if not spec.rail.step:
        return []
    return [rail.step_number(_frequency(spec), _speed(spec, scene), model.radius(spec), spec.rail.step)]


def _gap_numbers(spec: Travelling, scene: RailStep) -> list[float]:
    return [rail.gap_number(_frequency(spec), _speed(spec, scene), spec.rail.gap)] if spec.rail.gap else []


def _factor(spec: Travelling, scene: RailStep, answer: float) -> float:
    return float(rail.rail_factor(_speed(spec, scene), model.radius(spec), spec.gravity, answer))


RAIL_RESPONSE: Solver[Travelling, RailStep] = Solver(
    name="rail_response",
    title="vertical response to a rail step or gap",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({RailStep}),
    represents=frozenset({RAIL}),
    gives=frozenset({"phi4", "rail_contact"}),
    run=run,
    cost=lambda spec, scene, carried, level: 1e-4,
    source="one vertical mode over a cosine step; derived in ptmcalc.laws.rail",
    always=frozenset({RAIL}),
)

RAIL_STANDARD: Solver[Travelling, RailStep] = Solver(
    name="rail_standard",
    title="phi4 of the standards",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({RailStep}),
    represents=frozenset(),
    gives=frozenset({"phi4"}),
    run=standard,
    cost=lambda spec, scene, carried, level: 5e-5,
    source="EN 13001-2, ISO 8686-1",
    decides=False,
)
