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

from ptmcalc.base.estimate import Estimate
from ptmcalc.components.buffer import Buffer
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import buffer, skew
from ptmcalc.machines.crane.travelling import model
from ptmcalc.machines.crane.travelling.buffers import yawing
from ptmcalc.machines.crane.travelling.model import filled
from ptmcalc.machines.crane.travelling.scenes import Collision, RailStep, Skew, Storm
from ptmcalc.machines.crane.travelling.spec import Travelling
from ptmcalc.machines.crane.travelling.sway.effects import RAIL
from ptmcalc.witness import lumped

FloatArray = NDArray[np.float64]
_SOURCE = "Hairer, Nørsett and Wanner, Solving Ordinary Differential Equations I"
_LOOKS = 64
"""In a radian of the swing; 400 in the stroke of a buffer."""
_STROKE_LOOKS = 400
"""Samples of a buffer collision over time [1]. A numerical choice: more samples reduce the error of the largest force
and cost time in proportion."""
Path = Callable[[FloatArray], FloatArray]
"""Something over times, arrays alike."""
_MOST_TURNS = 1e4
"""Phase angle [rad] of the wheel vibration on a step or gap from which the reference method is not used. A numerical
choice: a smaller value refuses slow cranes, a larger one allows longer runs."""
_SLOW = 0.01
"""Share of the speed at which an orifice has stopped the crane, as the solver has it."""


# -- buffers ---------------------------------------------------------------------------------------------------------


def collide(spec: Travelling, scene: Collision, carried: frozenset[str], level: int) -> Result:
    """Motion of the crane on the buffers of both rails, with rotation and load sway, over time.

        M y'' + F(y) = P + H,   F = c u, F_e (u/s)^p, F_0 or k u'^2;   for two cranes u is half of their approach

    **Range** as `buffer_collision`.
    **Error** three times the difference of two runs, the second with a hundredth of the tolerance of the first.
    **Source** Newton's law; Hairer, Nørsett and Wanner, Solving Ordinary Differential Equations I, 2nd ed.
    """
    given = spec.buffers
    assert given is not None
    drive, ratio = spec.drive, model.rim_ratio(spec)
    wheels = model.wheel_count(spec) * filled(spec.wheels.inertia) / model.radius(spec) ** 2
    mass = sum(body.mass for body in model.bodies(spec, 0.0)) + wheels + drive.efficiency * drive.inertia * ratio**2
    mass += model.hanging(spec, scene) if scene.suspension == "guided" else 0.0
    push = drive.torque * ratio * drive.efficiency if scene.drive == "on" else 0.0
    start, struck = scene.speed_share * spec.speed, mass
    if scene.other_mass is not None:
        start = (start + scene.other_speed) / 2
        struck = 2 * mass * scene.other_mass / (mass + scene.other_mass)
    ever = _ever(given, push, start)
    loads = {
        "collision_speed": Found(Estimate.exact(start)),
        "collision_energy": Found(Estimate.within(struck * start**2 / 2, 1e-9 * struck * start**2)),
    }
    if not ever:
        loads |= _pushed_on(given, struck, push, start, mass)
    else:
        runs = [_pressed(yawing.places(spec, scene, struck / mass, start), one) for one in lumped.TOLERANCES[-2:]]
        for run in runs:
            run["buffer_deceleration"] *= struck / mass
        left = runs[-1].pop("left")
        before = runs[0].pop("left")
        loads |= lumped.compared(*runs)
        for name in ("buffer_force", "buffer_stroke", "buffer_deceleration"):
            loads[name] = _loosened(loads[name].estimate, given.type == "constant" and name != "buffer_force")
        if left > 0:  # whatever stands behind the buffers has the rest
            for name in ("buffer_force", "buffer_deceleration"):
                one = loads[name].estimate
                loads[name] = Found(Estimate(one.value, one.low, math.inf, one.numerical, math.inf))
        loads["buffer_speed_left"] = Found(_wide(lumped.estimate(before, left), 1e-4 * start))
    share = given.shape if given.shape is not None else _share(given, struck)
    factor = buffer.buffer_factor(min(share, 1.0), spec.classes.buffer_edition)
    loads["phi7"] = Found(Estimate.within(factor, 1e-8))
    return Result(loads, work=2)


def _loosened(one: Estimate, much: bool) -> Found:
    """With the error of looks at a course that has corners."""
    return Found(_wide(one, (1e-2 if much else 1e-5) * abs(one.value)))


def _wide(one: Estimate, more: float) -> Estimate:
    bar = one.bar + more
    return Estimate.within(one.value, bar)


def _ever(given: Buffer, push: float, start: float) -> bool:
    """Whether the buffers ever stop what is pushed onto them."""
    if given.type == "constant":
        return push < given.hardness
    return given.type != "hydraulic" or push == 0 or push / given.hardness < (_SLOW * start) ** 2


def _pushed_on(given: Buffer, struck: float, push: float, start: float, mass: float) -> dict[str, Found]:
    """A straight stop that never ends, at the end of the stroke: by quadrature of its energy."""
    from scipy.integrate import solve_ivp

    hard = given.hardness
    force = (lambda square: hard) if given.type == "constant" else (lambda square: hard * square)
    run: Any = solve_ivp(
        lambda u, square: [2 * (push - force(square[0])) / struck], (0.0, given.stroke), [start**2], rtol=1e-11,
        atol=1e-12 * start**2, method="DOP853",
    )  # fmt: skip
    left = math.sqrt(max(float(run.y[0, -1]), 0.0))
    most = max(force(start**2), force(left**2))
    numbers = {"buffer_force": most / given.count, "buffer_deceleration": (most - push) / mass}
    found = {name: Found(Estimate(value, value, math.inf, 0.0, math.inf)) for name, value in numbers.items()}
    found["buffer_stroke"] = Found(Estimate.exact(math.inf))
    found["buffer_speed_left"] = Found(Estimate.within(left, 1e-7 * start))
    return found


def _pressed(several: list[yawing.Yawing], tolerance: float) -> dict[str, float]:
    """The hardest pressed buffer over all places of the hook."""
    found = [_followed(one, tolerance) for one in several]
    return {name: max(one[name] for one in found) for name in found[0]}


def _followed(one: yawing.Yawing, tolerance: float) -> dict[str, float]:
    """Force, stroke and deceleration until the buffers of both rails are pressed no more."""
    from scipy.integrate import solve_ivp

    given, start = one.given, one.speed
    slow = _SLOW * start if given.type == "hydraulic" else 0.0
    slow = 1e-3 * start if given.type == "constant" else slow

    def slows(t: float, y: Any) -> float:
        return max(float(y[3]), float(y[4])) - slow

    slows.terminal = True  # type: ignore[attr-defined]
    slows.direction = -1  # type: ignore[attr-defined]
    length = given.stroke
    run: Any = solve_ivp(
        lambda t, y: one.rates(tuple(y)), (0.0, 1e9), [0.0, 0.0, 0.0, start, start, start], events=(slows,),
        rtol=tolerance, atol=[1e-3 * tolerance * length] * 3 + [1e-3 * tolerance * start] * 3, dense_output=True,
        method="DOP853" if given.type != "constant" else "Radau",
    )  # fmt: skip
    times = np.linspace(0.0, float(run.t[-1]), _STROKE_LOOKS)
    looks = run.sol(times)
    tops = [_deepest(looks[side], looks[side + 3], times) for side in (0, 1)]
    side = int(tops[1] > tops[0])
    forces = [one.force(min(float(u), given.stroke), float(v)) for u, v in looks[[side, side + 3]].T]
    most = max(forces) if given.type == "hydraulic" else one.force(min(tops[side], given.stroke), start)
    left, past = 0.0, np.flatnonzero(looks[side] > given.stroke)
    if len(past):
        left = _speed_at(run, side, given.stroke, float(times[past[0] - 1]), float(times[past[0]]))
        left = left if left > slow or given.type != "hydraulic" else 0.0
    rates = np.array([one.rates(tuple(look))[3:5] for look in looks.T])
    single = 1.0 if given.count > 1 else 2.0
    return {
        "buffer_force": single * most / max(given.count / 2, 1.0),
        "buffer_stroke": tops[side],
        "buffer_deceleration": float(-rates.min()),
        "left": left,
    }


def _deepest(strokes: Any, rates: Any, times: Any) -> float:
    """Largest stroke, where its rate vanishes between two looks too."""
    best = int(strokes.argmax())
    top = float(strokes[best])
    for one in (best - 1, best):
        if 0 <= one < len(times) - 1 and rates[one] > 0 >= rates[one + 1]:
            step, share = times[one + 1] - times[one], rates[one] / (rates[one] - rates[one + 1])
            top = max(top, float(strokes[one] + rates[one] * step * share / 2))
    return top


def _speed_at(run: Any, side: int, stroke: float, low: float, high: float) -> float:
    """Rate with which a stroke is passed between two times."""
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if run.sol(middle)[side] < stroke else (low, middle)
    return float(run.sol(high)[side + 3])


def _share(given: Buffer, struck: float) -> float:
    """Energy of the buffers over largest force times stroke, by quadrature of the force of a crane on its way."""
    from scipy.integrate import quad

    if given.type == "hydraulic":
        whole = quad(lambda u: math.exp(-2 * given.hardness * u / struck), 0.0, given.stroke, epsabs=0.0)[0]
        return float(whole / given.stroke)
    power = {"linear": 1.0, "progressive": given.power, "constant": 0.0}[given.type]
    return float(quad(lambda u: (u / given.stroke) ** power, 0.0, given.stroke)[0] / given.stroke)


# -- rail ------------------------------------------------------------------------------------------------------------


def climb(spec: Travelling, scene: RailStep, carried: frozenset[str], level: int) -> Result:
    """Motion of the sprung mass above a wheel whose centre follows a step or a gap.

        y'' = omega^2 (z - y),   phi_4 = 1 + omega^2 max(z - y)/g
        z = (h/2) (1 - cos(pi x/s)), s = (2 h r)^(1/2)  on a step,   z = -(e^2/(16 r)) (1 - cos(2 pi x/e))  in a gap

    **Range** as the closed form: one mode without damping, initially at rest.
    **Error** three times the difference of two runs, the second with a hundredth of the tolerance of the first.
    **Source** Newton's law; Hairer, Nørsett and Wanner, Solving Ordinary Differential Equations I, 2nd ed.
    """
    found = [_on_the_rail(spec, scene, tolerance) for tolerance in lumped.TOLERANCES[-2:]]
    return Result(lumped.compared(*found), work=2)


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
    return max(float(values.max()), lumped.summit(values[top - 1 : top + 2]))


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


# -- skewing ---------------------------------------------------------------------------------------------------------

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
    return Result(lumped.compared(*found), work=2)


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


# -- storm -----------------------------------------------------------------------------------------------------------


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
    return Result({name: Found(lumped.estimate(value, value)) for name, value in loads.items()}, work=len(corners))


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


def _priced(seconds: float) -> Any:
    return lambda spec, scene, carried, level: seconds


COLLISION_IN_TIME: Solver[Travelling, Collision] = Solver(
    name="collision_runge_kutta",
    title="buffer impact, Runge-Kutta (reference)",
    fidelity=Fidelity.TRANSIENT,
    scenes=frozenset({Collision}),
    represents=frozenset(),
    gives=frozenset(
        {
            "collision_speed", "collision_energy", "buffer_force", "buffer_stroke", "buffer_deceleration",
            "buffer_speed_left", "phi7",
        }
    ),
    run=collide,
    cost=_priced(4e-3),
    source=_SOURCE,
)  # fmt: skip
RAIL_IN_TIME: Solver[Travelling, RailStep] = Solver(
    name="rail_runge_kutta",
    title="wheel over a rail step or gap, Runge-Kutta (reference)",
    fidelity=Fidelity.TRANSIENT,
    scenes=frozenset({RailStep}),
    represents=frozenset({RAIL}),
    gives=frozenset({"phi4", "rail_contact"}),
    run=climb,
    cost=lambda spec, scene, carried, level: 0.02 + 5e-4 * turns_of(spec, scene).value,
    source=_SOURCE,
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
    cost=_priced(1e-3),
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
    cost=_priced(4e-3),
    source="equilibrium; linear programming",
)
OF_EVENTS = (COLLISION_IN_TIME, RAIL_IN_TIME, SKEW_BY_ROOTS, STORM_BALANCED)
