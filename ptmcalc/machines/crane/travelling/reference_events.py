"""Second methods for what happens to a travelling crane besides starts and stops; no plan offers them.

Buffers and rails by Runge-Kutta steps of the motion, where the solvers have closed forms of its energy or its answer;
skewing by roots of the balances, where they have the pole in closed form or the minimum of a work of friction; a storm
by the balances of the crane as equations, and the most that brakes and wheels can hold as a linear programme.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import skew
from ptmcalc.machines.crane.travelling.machine import model
from ptmcalc.machines.crane.travelling.machine.model import filled
from ptmcalc.machines.crane.travelling.machine.scenes import RailStep, Skew, Storm
from ptmcalc.machines.crane.travelling.machine.spec import Travelling
from ptmcalc.machines.crane.travelling.rail.effects import RAIL
from ptmcalc.machines.crane.travelling.reference_collision import COLLISION_IN_TIME, SOURCE, priced
from ptmcalc.reference import lumped, lumped_history, two_runs

FloatArray = NDArray[np.float64]
_LOOKS = 64
"""In a radian of the swing; 400 in the stroke of a buffer."""
Path = Callable[[FloatArray], FloatArray]
"""Something over times, arrays alike."""
_MOST_TURNS = 1e4
"""Phase angle [rad] of the wheel vibration on a step or gap from which the reference method is not used. A numerical
choice: a smaller value refuses slow cranes, a larger one allows longer runs."""


def climb(spec: Travelling, scene: RailStep, carried: frozenset[str], level: int) -> Result:
    """Motion of the sprung mass above a wheel whose centre follows a step or a gap.

        y'' = omega^2 (z - y),   phi_4 = 1 + omega^2 max(z - y)/g
        z = (h/2) (1 - cos(pi x/s)), s = (2 h r)^(1/2)  on a step,   z = -(e^2/(16 r)) (1 - cos(2 pi x/e))  in a gap

    **Range** as the closed form: one mode without damping, initially at rest.
    **Error** three times the difference of two runs, the second with a hundredth of the tolerance of the first.
    **Source** Newton's law; Hairer, Nørsett and Wanner, Solving Ordinary Differential Equations I, 2nd ed.
    """
    found = [_on_the_rail(spec, scene, tolerance) for tolerance in lumped.TOLERANCES[-2:]]
    return Result(two_runs.compared(*found), work=2)


def _places(spec: Travelling) -> Iterator[tuple[float, float, float]]:
    """Length of a step and a gap, half their height, and the phase they go through."""
    radius = model.radius(spec)
    if spec.rail.step:
        yield math.sqrt(2 * spec.rail.step * radius), spec.rail.step / 2, math.pi
    if spec.rail.gap:
        yield spec.rail.gap, -(spec.rail.gap**2) / (16 * radius), 2 * math.pi


def _on_the_rail(spec: Travelling, scene: RailStep, tolerance: float) -> dict[str, float]:
    omega = 2 * math.pi * filled(spec.rail.frequency)
    speed = scene.speed_share * spec.speed
    more, less = 0.0, 0.0
    for length, half, phase in _places(spec):
        high, low = _answer(omega, length / speed, half, phase, tolerance)
        more, less = max(more, high), min(less, low)
    return {"phi4": 1 + more / spec.gravity, "rail_contact": 1 + less / spec.gravity}


def _answer(omega: float, lasts: float, half: float, phase: float, tolerance: float) -> tuple[float, float]:
    """Largest and least acceleration of the mass on the place and in a swing behind it [m/s^2]."""
    from scipy.integrate import solve_ivp

    state, high, low = np.zeros(2), 0.0, 0.0
    behind = half * (1 - math.cos(phase))
    ways: tuple[tuple[float, Path], ...] = (
        (lasts, lambda t: half * (1 - np.cos(phase * t / lasts))),
        (1.1 * 2 * math.pi / omega, lambda t: behind + 0 * t),
    )
    for until, path in ways:
        run: Any = solve_ivp(
            lambda t, y, path=path: [y[1], omega**2 * (path(t) - y[0])],
            (0.0, until), state, method="DOP853", rtol=tolerance,
            atol=1e-3 * tolerance * abs(half) * np.array([1.0, omega]), max_step=1.0 / omega, dense_output=True,
        )  # fmt: skip
        state = run.y[:, -1]
        times = np.linspace(0.0, until, max(int(_LOOKS * (omega + phase / lasts) * until), 50))
        felt = partial(_felt, omega, path, run.sol)
        high, low = max(high, _top(felt, 1, times)), min(low, -_top(felt, -1, times))
    return high, low


def _felt(omega: float, path: Path, motion: Any, times: FloatArray) -> FloatArray:
    return np.asarray(omega**2 * (path(times) - motion(times)[0]))


def _top(felt: Path, way: int, times: FloatArray) -> float:
    """Farthest value to a side, by looks that close in on it."""
    for _ in range(3):
        values = way * felt(times)
        top = min(max(int(values.argmax()), 1), len(values) - 2)
        times = np.linspace(times[top - 1], times[top + 1], _LOOKS)
    return max(float(values.max()), lumped_history.summit(values[top - 1 : top + 2]))


def turns_of(spec: Travelling, scene: RailStep) -> Criterion:
    """Whether the mass swings few times on a step or gap.

        omega t

    **Range** any crane.
    **Error** none: a limit of the work.
    **Source** the file.
    """
    speed = scene.speed_share * spec.speed
    omega = 2 * math.pi * filled(spec.rail.frequency)
    turns = max((omega * length / speed for length, _, _ in _places(spec)), default=0.0)
    return Criterion("ωt", turns, _MOST_TURNS, "radians of the oscillation on a step: too much work", "the file")


Friction = Callable[[float], float]
"""Of a wheel over its slip."""


@dataclass(frozen=True, slots=True)
class _Wheel:
    load: float
    behind: float
    """the guide [m]"""
    aside: float
    """of the guiding rail [m]"""
    holds: bool
    coupled: bool


def lean(spec: Travelling, scene: Skew, carried: frozenset[str], level: int) -> Result:
    """Skewing angle and rolling slip of a crane with all wheel forces in equilibrium, by nested root finding.

        s_y = alpha - theta d,   s_x = theta y - rho,   F = N f(|s|) s/|s|
        rho: sum of F_x = 0,   theta: sum of F_y d - F_x y = 0,   S = sum of F_y

    The force of the standard assumes f proportional to the slip up to f(alpha), the other force the complete friction
    curve.

    **Range** as the solver.
    **Error** three times the difference of the roots for two tolerances.
    **Source** balance of forces and of moments about the guide; Brent's method.
    """
    given = spec.guide
    assert given is not None
    base = given.base if given.base is not None else spec.wheels.base
    whole = skew.skew_angle(
        given.clearance, filled(given.wear), base, skew.LEAST_PLAY[given.type], given.tolerance, given.edition
    )
    angle = min(whole, skew.LARGEST_ANGLE)
    full = given.adhesion * (1 - math.exp(-250 * angle))
    laws: dict[str, Friction] = {
        "skew_force": lambda slip: full * slip / angle,
        "skew_force_slip": lambda slip: given.adhesion * (1 - math.exp(-250 * slip)),
    }
    found: list[dict[str, float]] = []
    for tolerance in (1e-7, 1e-13):
        loads = {"skew_angle": whole, "skew_share": full}
        for name, law in laws.items():
            loads[name] = max(_guided(wheels, law, angle, tolerance) for wheels in _cranes(spec, scene))
        found.append(loads)
    return Result(two_runs.compared(*found), work=2)


def _cranes(spec: Travelling, scene: Skew) -> Iterator[list[_Wheel]]:
    """The four corners for every place of the hook and either guiding rail."""
    given, wheels = spec.guide, spec.wheels
    assert given is not None
    ahead = max((given.base or wheels.base) - wheels.base, 0.0) / 2 if given.type == "rollers" else 0.0
    driven = set(wheels.driven)
    for hook in model.hook_places(spec, scene):
        masses = [(body.mass, body.across) for body in model.bodies(spec, hook)]
        masses.append((model.hanging(spec, scene), hook))
        on_b = spec.gravity * sum(mass * across for mass, across in masses) / spec.gauge
        on_a = spec.gravity * sum(mass for mass, _ in masses) - on_b
        for guiding, other in ((on_a, on_b), (on_b, on_a)):
            yield [
                _Wheel(
                    load / 2,
                    ahead + (wheels.base if end == "2" else 0.0),
                    aside,
                    aside == 0 or given.rail_two == "fixed",
                    {f"A{end}", f"B{end}"} <= driven and spec.drive.wheels == "coupled",
                )
                for end in ("1", "2")
                for load, aside in ((guiding, 0.0), (other, spec.gauge))
            ]


def _guided(wheels: list[_Wheel], law: Friction, angle: float, tolerance: float) -> float:
    """Force of the guide [N]."""
    from scipy.optimize import brentq

    def forces(turn: float, roll: float) -> tuple[float, float, float]:
        """Sums along and across, and of the moments about the guide."""
        along, across, moment = 0.0, 0.0, 0.0
        for one in wheels:
            y = angle - turn * one.behind if one.holds else 0.0
            x = turn * one.aside - roll if one.coupled else 0.0
            slip = math.hypot(x, y)
            size = one.load * law(slip) / slip if slip else 0.0
            along, across = along + size * x, across + size * y
            moment += size * (y * one.behind - x * one.aside)
        return along, across, moment

    span = max(one.aside for one in wheels)

    def rolls(turn: float) -> float:
        if not any(one.coupled for one in wheels) or not turn:
            return 0.0
        return float(brentq(lambda roll: forces(turn, roll)[0], 0.0, turn * span, xtol=1e-18, rtol=tolerance))

    most = 2 * angle / min(one.behind for one in wheels if one.behind > 0)  # all of them slip backwards there
    turn = float(brentq(lambda turn: forces(turn, rolls(turn))[2], 0.0, most, xtol=1e-18, rtol=tolerance))
    return forces(turn, rolls(turn))[1]


def stand(spec: Travelling, scene: Storm, carried: frozenset[str], level: int) -> Result:
    """Corner loads from their four equilibrium equations, and the maximum holding force of wheels, brakes and clamps.

        sum N = G,   sum of N_B l = sum G y,   sum (N_1 - N_2) B/2 = -F h,   N_A1 - N_A2 = N_B1 - N_B2 of a rigid frame
        max sum T   with  0 <= T_k <= mu N_k  and  T_k <= F_b/n, or sum T <= F_b of coupled wheels

    **Range** as the closed form.
    **Error** rounding of the equations, and 1e-9 for the linear programme.
    **Source** equilibrium; linear programming.
    """
    assert spec.wind is not None
    blown = filled(spec.wind.pressure_storm) * spec.wind.shape * spec.wind.area
    brake, each = spec.drive.brake, spec.wheels.per_corner
    brakes = brake.torque * model.rim_ratio(spec) / spec.drive.reverse_efficiency if brake is not None else 0.0
    clamps = spec.parking.force if spec.parking is not None else 0.0
    corners = [_corners(spec, scene, hook, blown) for hook in model.hook_places(spec, scene)]
    held = min(_held(spec, found, brakes) for found in corners) + clamps
    slope = spec.rail.slope
    mass = sum(body.mass for body in model.bodies(spec, 0.0)) + model.hanging(spec, scene)
    force = blown + mass * spec.gravity * slope / math.sqrt(1 + slope**2)
    loads = {
        "storm_force": force,
        "holding_force": held,
        "storm_reserve": held / force,
        "wheel_load_max": max(max(found) for found in corners) / each,
        "wheel_load_min": min(min(found) for found in corners) / each,
    }
    return Result({name: Found(two_runs.estimate(value, value)) for name, value in loads.items()}, work=len(corners))


def _corners(spec: Travelling, scene: Storm, hook: float, blown: float) -> list[float]:
    """Loads of the corners A1, A2, B1, B2 in a wind against the front [N]."""
    weights = [(body.mass * spec.gravity, body.across) for body in model.bodies(spec, hook)]
    weights.append((model.hanging(spec, scene) * spec.gravity, hook))
    tilts = -blown * model.wind_height(spec)
    lever = spec.wheels.base / 2
    last = [1.0, -1.0, -1.0, 1.0] if spec.wheels.frame == "rigid" else [0.0, 0.0, lever, -lever]
    balances = [[1.0, 1.0, 1.0, 1.0], [0.0, 0.0, spec.gauge, spec.gauge], [lever, -lever, lever, -lever], last]
    given = [
        sum(weight for weight, _ in weights),
        sum(weight * across for weight, across in weights),
        tilts,
        0.0 if spec.wheels.frame == "rigid" else tilts / 2,  # girders hand it to either end carriage by levers
    ]
    return [float(load) for load in np.linalg.solve(np.array(balances), np.array(given))]


def _held(spec: Travelling, corners: list[float], brakes: float) -> float:
    """Most that the braked wheels hold [N]."""
    from scipy.optimize import linprog

    most: list[float] = []
    for corner, load in zip(model.CORNERS, corners, strict=True):
        grip = filled(spec.rail.adhesion) * max(load, 0.0) / spec.wheels.per_corner
        most += [grip] * model.driven_at(spec, corner)
    coupled = spec.drive.wheels == "coupled"
    if not coupled:
        most = [min(grip, brakes / len(most)) for grip in most]
    together: Any = {"A_ub": np.ones((1, len(most))), "b_ub": [brakes]} if coupled else {}
    found: Any = linprog(-np.ones(len(most)), bounds=[(0.0, grip) for grip in most], **together)
    return -float(found.fun)


RAIL_IN_TIME: Solver[Travelling, RailStep] = Solver(
    name="rail_runge_kutta",
    title="wheel over a rail step or gap, Runge-Kutta (reference)",
    fidelity=Fidelity.TRANSIENT,
    scenes=frozenset({RailStep}),
    represents=frozenset({RAIL}),
    gives=frozenset({"phi4", "rail_contact"}),
    run=climb,
    cost=lambda spec, scene, carried, level: 0.02 + 5e-4 * turns_of(spec, scene).value,
    source=SOURCE,
    valid=turns_of,
    always=frozenset({RAIL}),
)
SKEW_BY_ROOTS: Solver[Travelling, Skew] = Solver(
    name="skewing_roots",
    title="skewing, root finding on the force balance (reference)",
    fidelity=Fidelity.TRANSIENT,
    scenes=frozenset({Skew}),
    represents=frozenset(),
    gives=frozenset({"skew_angle", "skew_share", "skew_force", "skew_force_slip"}),
    run=lean,
    cost=priced(1e-3),
    source="balance of forces and moments; Brent, Algorithms for Minimization without Derivatives",
)
STORM_BALANCED: Solver[Travelling, Storm] = Solver(
    name="storm_balances",
    title="parked crane in wind, linear programme (reference)",
    fidelity=Fidelity.TRANSIENT,
    scenes=frozenset({Storm}),
    represents=frozenset(),
    gives=frozenset({"storm_force", "holding_force", "storm_reserve", "wheel_load_max", "wheel_load_min"}),
    run=stand,
    cost=priced(4e-3),
    source="equilibrium; linear programming",
)
OF_EVENTS = (COLLISION_IN_TIME, RAIL_IN_TIME, SKEW_BY_ROOTS, STORM_BALANCED)
