"""Motors on their torque curves in steady running: solver and checks of a kind whose motors pull a belt or a chain."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any, Generic

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.components.motor_rating import number_at
from ptmcalc.components.steady_drive import Motors, shared_forces, steady_reserve
from ptmcalc.contract.check import Check, Sense, no_needs
from ptmcalc.contract.effect import C, Criterion, S
from ptmcalc.contract.limits import fixed
from ptmcalc.contract.result import Found, Result, of
from ptmcalc.contract.solver import Fidelity, Solver

LOADS = ("steady_reserve", "motor_utilisation")
"""Loads of the solver: the reserve of all motors, and the torque of each over its rated torque."""


@dataclass(frozen=True, slots=True)
class SteadyMotors(Generic[S, C]):
    """Motors of a kind in steady running."""

    pulled: str
    """what they pull, in texts for users: `belt`, `chain`"""
    several: bool
    """whether a machine may have several drives"""
    motors: Callable[[S], Mapping[str, Motors]]
    """motors of each drive by its name, `""` where a machine has only one; empty where one of them has no curve"""
    curve_key: Callable[[S, str], KeyPath]
    """key of the curve of a drive; of the main one for `""`"""
    resistance: Callable[[S, C], float]
    """of the whole machine in the steady running of a scene; negative where the load drives it [N]"""
    run: type[C]
    start: type[C]

    @property
    def scenes(self) -> frozenset[type[C]]:
        """Scenes with steady running: a start is compared with the running that follows it."""
        return frozenset({self.run, self.start})

    @property
    def curves(self) -> str:
        """The curves of the motors, in texts for users."""
        return "curves" if self.several else "curve"


def steady_loads(
    motors: Mapping[str, Motors], resistance: float, speed: float, forces: Mapping[str, float] | None = None
) -> Result:
    """Reserve of all motors in steady running, and the share of its rated torque that each gives or brakes with.

        steady_reserve = max of sum F(v) / W,   motor_utilisation = |M|/M_n

    Args:
        motors: of each drive by its name; a load of a drive without a name is no element of a family.
        resistance: W, of the whole machine at the pulley or sprocket; negative where the load drives it [N].
        speed: V, rated speed of belt or chain [m/s].
        forces: of each drive at pulley or sprocket [N]; as all drives share W at one speed when left out.

    **Range** as `components.steady_drive.steady_reserve`.
    **Error** as there.
    **Source** derived: equilibrium on the torque curves.
    """
    drives = list(motors.values())
    loads = {"steady_reserve": steady_reserve(drives, resistance, speed)}
    if forces is None:
        forces = dict(zip(motors, shared_forces(drives, resistance, speed), strict=True))
    for name, one in motors.items():
        if one.curve.rated is not None:
            load = of("motor_utilisation", name) if name else "motor_utilisation"
            loads[load] = abs(one.torque(forces[name])) / one.curve.rated
    return Result({name: Found(Estimate.exact(value)) for name, value in loads.items()}, work=1)


def steady_solver(
    name: str, kind: SteadyMotors[S, C], run: Callable[[S, C, frozenset[str], int], Result]
) -> Solver[S, C]:
    """The solver of a kind; `run` calls `steady_loads` with the resistance of its machine."""

    def has_curve(spec: S, scene: C) -> Criterion:
        """Whether each motor has a curve: 0 where it has, else 1.

        **Range** any machine.
        **Error** exact.
        **Source** the file.
        """
        whose = "each motor" if kind.several else "the motor"
        lacks = float(not kind.motors(spec))
        return Criterion("curve", lacks, 1.0, f"0 where the file gives {whose} a curve, else 1", "the file")

    return Solver(
        name=name,
        title=f"steady running on the motor {kind.curves}",
        fidelity=Fidelity.FORMULA,
        scenes=kind.scenes,
        represents=frozenset(),
        gives=frozenset(LOADS),
        run=run,
        cost=lambda spec, scene, carried, level: 5e-3,
        valid=has_curve,
        source=f"equilibrium on the torque {kind.curves}",
    )


_RATED_LIMIT = fixed(
    1.0, meaning="The rated torque", valid="continuous duty", source="IEC 60034-1: rated output in duty type S1"
)


def _checked_in(kind: SteadyMotors[S, C], spec: S, scene: Any) -> bool:
    """Whether a scene is the one in which steady running with its load is checked: a run, else the first start."""
    if isinstance(scene, kind.run):
        return True
    alike: list[Any] = [one for one in spec.all_scenes if isinstance(one, kind.run | kind.start)]
    alike = [one for one in alike if one.load == scene.load]
    return not any(isinstance(one, kind.run) for one in alike) and alike[0] == scene


def _size_key(kind: SteadyMotors[S, C], spec: S, name: str | None = None) -> KeyPath:
    """The number of the curve of a drive, or of the only one, that its torques grow with; none for one of several."""
    motors = kind.motors(spec)
    if name is None and len(motors) != 1:
        return ()
    name = next(iter(motors)) if name is None else name
    return number_at(kind.curve_key(spec, name), motors[name].curve)


def steady_reserve_check(code: str, kind: SteadyMotors[S, C]) -> Check[S, C]:
    """The check that all motors together pull or hold their machine in steady running."""

    def checks(spec: S, scene: C) -> Iterable[Check[S, C]]:
        """Where every motor has a curve; whether it would stall or run away is known by the sign of the resistance."""
        if kind.motors(spec) and _checked_in(kind, spec, scene):
            runs = "runs too slowly" if kind.resistance(spec, scene) > 0 else "runs away"
            yield replace(check, each=None, failure=f"{check.failure}: the {pulled} {runs}")

    pulled = kind.pulled
    pull = "By their curves, all motors together pull" if kind.several else "By their curve, the motors pull"
    check: Check[S, C] = Check(
        code=code,
        hazard=True,
        title="motor torque reserve, steady running",
        question=f"Do the motors pull the {pulled} at its speed, or hold the load that drives it?",
        failure="load exceeds the motor torque",
        scenes=kind.scenes,
        loads=("steady_reserve",),
        sense=Sense.AT_LEAST,
        limit=fixed(
            1.0, meaning="The motors reach at least the resistance", valid="steady running", source="equilibrium"
        ),
        needs=no_needs,
        blame=lambda spec, scene, loads: kind.curve_key(spec, ""),
        repair=lambda spec, scene: _size_key(kind, spec),
        each=checks,
        what=f"{pull} the {pulled} at nine tenths of its speed or above. A load that drives the {pulled} stays below"
        " the maximum braking torque of the motors.",
        why=f"A motor beyond its breakdown torque stalls. A load beyond the maximum braking torque accelerates the"
        f" {pulled} without limit.",
        formula="max over v >= 0.9 V of F(v) >= W   (W > 0)      max over v of -F(v) >= -W   (W < 0)",
        source=f"equilibrium on the torque {kind.curves}",
    )
    return check


def rated_torque_check(code: str, kind: SteadyMotors[S, C]) -> Check[S, C]:
    """The check of the torque of each motor in steady running against its rated torque."""

    def checks(spec: S, scene: C) -> Iterable[Check[S, C]]:
        """One for each drive whose curve has a rating."""
        if not _checked_in(kind, spec, scene):
            return
        for name, one in kind.motors(spec).items():
            if one.curve.rated is None:
                continue
            if name:
                yield check.of(name, _RATED_LIMIT, kind.curve_key(spec, name), (), _size_key(kind, spec, name))
            else:
                yield replace(check, each=None)

    check: Check[S, C] = Check(
        code=code,
        title="motor torque utilisation, steady running",
        question="Is the motor torque of steady running within the rated torque?",
        failure="motor is overloaded in steady running",
        scenes=kind.scenes,
        loads=("motor_utilisation",),
        sense=Sense.AT_MOST,
        limit=_RATED_LIMIT,
        needs=no_needs,
        blame=lambda spec, scene, loads: kind.curve_key(spec, ""),
        repair=lambda spec, scene: _size_key(kind, spec),
        each=checks,
        what="The torque of each motor in steady running, driving or braking, is at most its rated torque.",
        why="A motor above its rated torque overheats within minutes to hours.",
        formula="|M| <= M_n = P_n/w_n",
        source="IEC 60034-1, duty type S1",
    )
    return check
