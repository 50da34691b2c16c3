"""Checks of the motors in steady running: strong enough to pull, to hold an overhauling load, and for their rating."""

from collections.abc import Iterable
from dataclasses import replace

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.components.motor import number_at
from ptmcalc.contract.check import AnyCheck, Check, Sense, no_needs
from ptmcalc.machines.chain_drive.running.motor_torque import motors_of
from ptmcalc.machines.chain_drive.spec import ChainDrive, ChainScene, Run, Start
from ptmcalc.machines.chain_drive.starting.motion import drive_of

_CURVE: KeyPath = ("drive", "motor", "curve")


def _repair(spec: ChainDrive, scene: ChainScene) -> KeyPath:
    return number_at(_CURVE, drive_of(spec).motor.curve)


def _at_least_once(spec: ChainDrive, scene: ChainScene) -> bool:
    """Whether a scene is the one in which steady running with its load is checked: a run, else the first start."""
    if isinstance(scene, Run):
        return True
    alike = [one for one in spec.all_scenes if one.load == scene.load and isinstance(one, Run | Start)]
    return not any(isinstance(one, Run) for one in alike) and alike[0] == scene


def _reserve_limit(spec: ChainDrive, scene: ChainScene) -> Estimate:
    """The motors reach at least the resistance.

    **Range** steady running.
    **Error** none.
    **Source** equilibrium.
    """
    return Estimate.exact(1.0)


def _reserve_checks(spec: ChainDrive, scene: ChainScene) -> Iterable[AnyCheck]:
    """Where the motors have a curve."""
    if motors_of(spec) is not None and _at_least_once(spec, scene):
        yield replace(RESERVE, each=None)


RESERVE: Check[ChainDrive, ChainScene] = Check(
    code="CHN130",
    title="motor torque reserve, steady running",
    question="Can the motors keep the chain at its speed, also with an overhauling load?",
    failure="load exceeds the motor torque: the chain runs too slowly, or runs away",
    scenes=frozenset({Run, Start}),
    loads=("steady_reserve",),
    sense=Sense.AT_LEAST,
    limit=_reserve_limit,
    needs=no_needs,
    blame=lambda spec, scene, loads: _CURVE,
    repair=_repair,
    each=_reserve_checks,
    what="By their curve, the motors pull the chain at nine tenths of its speed or above. A load that drives the chain"
    " stays below the maximum braking torque of the motors.",
    why="A motor beyond its breakdown torque stalls. A load beyond the maximum braking torque accelerates the chain"
    " without limit.",
    formula="max over v >= 0.9 V of F(v) >= W   (W > 0)      max over v of -F(v) >= -W   (W < 0)",
    source="equilibrium on the torque curve",
)


def _rated_limit(spec: ChainDrive, scene: ChainScene) -> Estimate:
    """The rated torque.

    **Range** continuous duty.
    **Error** none.
    **Source** IEC 60034-1: rated output in duty type S1.
    """
    return Estimate.exact(1.0)


def _rated_checks(spec: ChainDrive, scene: ChainScene) -> Iterable[AnyCheck]:
    """Where the curve has a rating."""
    motors = motors_of(spec)
    if motors is not None and motors.curve.rated is not None and _at_least_once(spec, scene):
        yield replace(RATING, each=None)


RATING: Check[ChainDrive, ChainScene] = Check(
    code="CHN131",
    title="motor torque utilisation, steady running",
    question="Is the motor torque of steady running within the rated torque?",
    failure="motor is overloaded in steady running",
    scenes=frozenset({Run, Start}),
    loads=("motor_utilisation",),
    sense=Sense.AT_MOST,
    limit=_rated_limit,
    needs=no_needs,
    blame=lambda spec, scene, loads: _CURVE,
    repair=_repair,
    each=_rated_checks,
    what="The torque of each motor in steady running, driving or braking, is at most its rated torque.",
    why="A motor above its rated torque overheats within minutes to hours.",
    formula="|M| <= M_n = P_n/w_n",
    source="IEC 60034-1, duty type S1",
)
