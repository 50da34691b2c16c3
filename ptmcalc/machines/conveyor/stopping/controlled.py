"""Controlled stop: what the rigid conveyor requires of its drives, and the checks of it."""

from collections.abc import Mapping

import numpy as np

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import Check, Sense, no_needs
from ptmcalc.contract.limits import fixed, key
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import start_profile
from ptmcalc.machines.conveyor.machine.drives import moving_mass, running
from ptmcalc.machines.conveyor.machine.load_sharing import starting_shares
from ptmcalc.machines.conveyor.machine.loads import BRAKING_FORCE, BRAKING_POWER, BRAKING_RESERVE, DRIVE_OF_STOP
from ptmcalc.machines.conveyor.machine.model import braking_force
from ptmcalc.machines.conveyor.machine.resistances import filled
from ptmcalc.machines.conveyor.machine.scenes import ControlledStop
from ptmcalc.machines.conveyor.machine.spec import Conveyor

_TIMES = 4001
"""Times of a profile at which force and power are evaluated; a numerical choice. Their maximum has an error of a
millionth; more times take longer."""


def rigid_loads(spec: Conveyor, scene: ControlledStop) -> dict[str, float]:
    """What the rigid conveyor requires of its drives in a controlled stop.

    F_b = M |a| - W,   a = V p'(t)           P = sum q_i eta_i F_b v
    """
    line = running(spec, scene)
    times = np.linspace(0.0, scene.time, _TIMES)
    slowing = line.speed * start_profile.rise_rate(scene.shape, scene.time, times)
    force = moving_mass(line) * slowing - (line.static_resistance + line.tail_pull)
    speeds = line.speed * (1 - start_profile.rise(scene.shape, scene.time, times))
    shares = starting_shares(spec).items()
    losses = sum(share * filled(spec.all_drives[name].gear.efficiency) for name, share in shares)
    needed = float(force.max())
    return {
        BRAKING_FORCE: needed,
        BRAKING_RESERVE: braking_force(spec) / needed if needed > 0 else np.inf,
        BRAKING_POWER: losses * max(float((force * speeds).max()), 0.0),
    }


def run(spec: Conveyor, scene: ControlledStop, carried: frozenset[str], level: int) -> Result:
    """Braking force and power of the drives that lower the speed of the rigid conveyor.

        F_b = M |a| - W,   a = V p'(t)           P = sum q_i eta_i F_b v

    M includes all moving masses and rotors. Where W exceeds M |a|, the motors drive until standstill: F_b is negative.

    **Range** any controlled stop.
    **Error** exact for the rigid conveyor to a millionth; waves add to the force at the drives.
    **Source** Newton's law.
    """
    loads = rigid_loads(spec, scene)
    return Result({name: Found(Estimate.exact(value)) for name, value in loads.items()}, work=1)


RIGID_BRAKING: Solver[Conveyor, ControlledStop] = Solver(
    name="rigid_braking",
    title="textbook controlled stop, rigid conveyor",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({ControlledStop}),
    represents=frozenset(),
    gives=DRIVE_OF_STOP,
    run=run,
    cost=lambda spec, scene, carried, level: 2e-4,
    source="Newton's law",
    decides=False,
)


def time_key(spec: Conveyor, scene: ControlledStop) -> KeyPath:
    """Where the duration of a controlled stop stands in the file."""
    return ("scenes", list(spec.all_scenes).index(scene), "time")


def _blame(spec: Conveyor, scene: ControlledStop, loads: Mapping[str, Estimate]) -> KeyPath:
    return time_key(spec, scene)


FORCE: Check[Conveyor, ControlledStop] = Check(
    code="CNV125",
    hazard=True,
    title="braking force reserve, controlled stop",
    question="Can the drives hold the belt to the speed of the controlled stop?",
    failure="braking force of the drives is below the required force",
    scenes=frozenset({ControlledStop}),
    loads=(BRAKING_RESERVE,),
    sense=Sense.AT_LEAST,
    limit=fixed(
        1.0,
        meaning="1: the available braking force reaches the required force",
        valid="motors whose braking torque is at least their mean starting torque",
        source="Newton's law",
    ),
    needs=no_needs,
    blame=_blame,
    repair=time_key,
    what="The braking force of all drives at the pulley surface, with the mean starting torque of their motors, is at"
    " least the force that the falling speed requires.",
    why="A converter at its torque limit lets the belt overrun: it stops later than commanded, or trips and coasts.",
    formula="n M i/(eta R) >= max(m |a| - S_on + S_off)",
    source="Newton's law; losses of the gear help the motors",
)


POWER: Check[Conveyor, ControlledStop] = Check(
    code="CNV126",
    title="braking power, controlled stop",
    question="Can the converters take back the power of the controlled stop?",
    failure="power from the braking motors exceeds what the converters take back",
    scenes=frozenset({ControlledStop}),
    loads=(BRAKING_POWER,),
    sense=Sense.AT_MOST,
    limit=key(
        "checks.braking_power",
        meaning="Power that the converters take back, given in the file",
        valid="any controlled stop",
        error="that of the given value",
        source="the data sheet of the converters",
    ),
    needs=no_needs,
    blame=_blame,
    repair=time_key,
    what="The power from all motors that brake, behind their gears, is at most that of the brake resistors or of the"
    " feedback to the mains.",
    why="A converter without brake resistor or feedback raises the voltage of its intermediate circuit and trips; the"
    " belt then coasts.",
    formula="max over t of sum eta_i max(-F_i v_i, 0) <= limit",
    source="power through a gear; the data sheet of the converters",
)
