"""Checks of the motors in steady running: strong enough to pull, to hold an overhauling load, and for their rating."""

from collections.abc import Iterable, Mapping
from dataclasses import replace

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.components.motor import number_at
from ptmcalc.contract.check import AnyCheck, Check, Sense, no_needs
from ptmcalc.machines.conveyor.running.motor_torque import motors_of
from ptmcalc.machines.conveyor.spec import Conveyor, ConveyorScene, Run, Start

Checks = Iterable[AnyCheck]
Loads = Mapping[str, Estimate]


def _curve_key(spec: Conveyor, path: KeyPath = ()) -> KeyPath:
    """The curve of a drive, by default of the main one."""
    return (*(path or spec.main_path), "motor", "curve")


def _curve_repair(spec: Conveyor, path: KeyPath = ()) -> KeyPath:
    key = _curve_key(spec, path)
    return number_at(key, spec.value_at(key))


def _at_least_once(spec: Conveyor, scene: ConveyorScene) -> bool:
    """Whether a scene is the one in which steady running with its load is checked: a run, else the first start."""
    if isinstance(scene, Run):
        return True
    alike = [one for one in spec.all_scenes if one.load == scene.load and isinstance(one, Run | Start)]
    return not any(isinstance(one, Run) for one in alike) and alike[0] == scene


def _reserve_limit(spec: Conveyor, scene: ConveyorScene) -> Estimate:
    """The motors reach at least the resistance.

    **Range** steady running.
    **Error** none.
    **Source** equilibrium.
    """
    return Estimate.exact(1.0)


def _reserve_checks(spec: Conveyor, scene: ConveyorScene) -> Checks:
    """Where every motor has a curve."""
    if motors_of(spec) and _at_least_once(spec, scene):
        yield replace(RESERVE, each=None)


RESERVE: Check[Conveyor, ConveyorScene] = Check(
    code="CNV121",
    title="motor torque reserve, steady running",
    question="Can the motors keep the belt at its speed, also with an overhauling load?",
    failure="load exceeds the motor torque: the belt runs too slowly, or runs away",
    scenes=frozenset({Run, Start}),
    loads=("steady_reserve",),
    sense=Sense.AT_LEAST,
    limit=_reserve_limit,
    needs=no_needs,
    blame=lambda spec, scene, loads: _curve_key(spec),
    repair=lambda spec, scene: _curve_repair(spec) if len(spec.all_drives) == 1 else (),
    each=_reserve_checks,
    what="By their curves, all motors together pull the belt at nine tenths of its speed or above. A load that drives"
    " the belt stays below the maximum braking torque of the motors.",
    why="A motor beyond its breakdown torque stalls. A load beyond the maximum braking torque accelerates the belt"
    " without limit.",
    formula="max over v >= 0.9 V of F(v) >= W   (W > 0)      max over v of -F(v) >= -W   (W < 0)",
    source="equilibrium on the torque curves",
)


def _rated_limit(spec: Conveyor, scene: ConveyorScene) -> Estimate:
    """The rated torque.

    **Range** continuous duty.
    **Error** none.
    **Source** IEC 60034-1: rated output in duty type S1.
    """
    return Estimate.exact(1.0)


def _rated_checks(spec: Conveyor, scene: ConveyorScene) -> Checks:
    """One for each drive whose curve has a rating."""
    if not _at_least_once(spec, scene):
        return
    for name, one in motors_of(spec).items():
        if one.curve.rated is not None:
            path = spec.drive_path(name)
            yield RATING.of(name, _rated_limit, _curve_key(spec, path), (), _curve_repair(spec, path))


RATING: Check[Conveyor, ConveyorScene] = Check(
    code="CNV122",
    title="motor torque utilisation, steady running",
    question="Is the motor torque of steady running within the rated torque?",
    failure="motor is overloaded in steady running",
    scenes=frozenset({Run, Start}),
    loads=("motor_utilisation",),
    sense=Sense.AT_MOST,
    limit=_rated_limit,
    needs=no_needs,
    blame=lambda spec, scene, loads: _curve_key(spec),
    repair=lambda spec, scene: _curve_repair(spec),
    each=_rated_checks,
    what="The torque of each motor in steady running, driving or braking, is at most its rated torque.",
    why="A motor above its rated torque overheats within minutes to hours.",
    formula="|M| <= M_n = P_n/w_n",
    source="IEC 60034-1, duty type S1",
)
