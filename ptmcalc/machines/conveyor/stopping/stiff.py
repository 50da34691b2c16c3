"""A stop of a belt so short that its waves cannot be counted: the rigid conveyor, with intervals that hold them."""

import math

import numpy as np

from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import loop_bounds
from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.conveyor.machine import tension_loads
from ptmcalc.machines.conveyor.machine.drives import running
from ptmcalc.machines.conveyor.machine.loads import DRIVE_OF_STOP, OF_BELT, OF_BRAKES, OF_STOP, PER_DRIVE, ways_of
from ptmcalc.machines.conveyor.machine.model import loop_masses
from ptmcalc.machines.conveyor.machine.motion import MOST_ROUNDS, rounds
from ptmcalc.machines.conveyor.machine.rigid_stop import deceleration, rigid_stop
from ptmcalc.machines.conveyor.machine.scenes import Coast, ControlledStop, ConveyorScene, EmergencyStop, Jam, Stop
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.stopping import controlled, stiff_bounds
from ptmcalc.machines.conveyor.stopping.brake_heat import rigid_heat


def run(spec: Conveyor, scene: ConveyorScene, carried: frozenset[str], level: int) -> Result:
    """Loads of a stop in which drive and belt move as one body.

        M v' = -(W + B(t)),   S(s) = S_static(s) - a r(s)

    **Range** a belt with a stopping time of at least a thousand wave circuits; one slope, one drive, brakes at the
    head.
    **Error** no error bar of its own: the wave bound is that of `stopping.stiff_bounds`.
    **Source** Newton's law.
    """
    stop = stiff_bounds.short_stop(spec, scene)
    if stop is None and spec.effects.get("belt_wave") == "off" and not isinstance(scene, Jam):
        return Result({name: Found(Estimate.exact(value)) for name, value in rigid_loads(spec, scene).items()}, work=1)
    if stop is None:
        raise NumericsError(
            "NUM103",
            f"a wave travels {rounds(spec, scene):.0f} times in the time of the scene, which is too much to"
            " simulate; what its waves can do is only known without simulation for a stop on one slope with one drive,"
            " brakes at the head, no take-up weight and little sag",
        )
    return Result({name: Found(Estimate.exact(value)) for name, value in stiff_bounds.loads(stop).items()}, work=1)


def rigid_loads(spec: Conveyor, scene: ConveyorScene) -> dict[str, float]:
    """Time and distance of the rigid conveyor to standstill, and its tensions at the largest deceleration.

        S(s) = S_static(s) - a r(s)

    **Range** any stop of a file that leaves the waves out.
    **Error** exact for that model on one slope; on several slopes the mass is taken as uniform along each strand.
    **Source** Newton's law.
    """
    line = running(spec, scene)
    time, way = rigid_stop(spec, scene, line)
    masses, most = loop_masses(line, imposed=False), deceleration(spec, scene, line)
    places = np.linspace(0.0, 1.0, 65)
    lows, highs = [], []
    for which in (RETURN, CARRY):
        static = line.static(which, places)
        slowed = static - most * loop_bounds.quasi_static(masses, which, places)
        lows.append(float(np.minimum(static, slowed).min()))
        highs.append(float(np.maximum(static, slowed).max()))
    found = tension_loads.derived_loads(line, max(highs), tuple(lows)) | {
        "tension_max": max(highs),
        "tension_min": min(lows),
    }
    found |= {"stop_time": time} | rigid_heat(spec, scene) | dict.fromkeys(ways_of(scene), way)
    return found | controlled.rigid_loads(spec, scene) if isinstance(scene, ControlledStop) else found


def valid(spec: Conveyor, scene: ConveyorScene) -> Criterion:
    """Whether the belt is so short that its waves are too many to simulate, or the file leaves them out.

        n = rounds of a wave in the time of the scene, as 1000/n

    **Range** any stop or jam.
    **Error** exact.
    **Source** work of `solvers.network`.
    """
    if spec.effects.get("belt_wave") == "off" and not isinstance(scene, Jam):
        return Criterion("off", 0.0, 1.0, "the file switches off the waves of the belt", "the file")
    count = rounds(spec, scene)
    share = MOST_ROUNDS / count if count >= MOST_ROUNDS else 2.0
    meaning = "simulated wave circuits / wave circuits during the scene: above 1 the belt is simulated"
    return Criterion("1000/n", share, math.nextafter(1, 2), meaning, "cost")


STIFF_STOP: Solver[Conveyor, ConveyorScene] = Solver(
    name="stiff_stop",
    title="stop, rigid-belt model for short belts",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Stop, EmergencyStop, ControlledStop, Coast, Jam}),
    represents=frozenset(),
    gives=OF_BELT.union(OF_STOP, PER_DRIVE, DRIVE_OF_STOP, OF_BRAKES),
    run=run,
    cost=lambda spec, scene, carried, level: 1e-4,
    source="Newton's law; bounds derived in ptmcalc.machines.conveyor.stopping.stiff_bounds",
    valid=valid,
)
