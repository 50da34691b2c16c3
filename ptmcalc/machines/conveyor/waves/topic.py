"""Belt waves: effects, their bounds without simulation, and the simulations."""

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo
from ptmcalc.contract.topic import Topic
from ptmcalc.machines.conveyor.machine.loads import BELT_SPEED, MOTOR_SPEED, parts_of
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.waves.characteristics import CHARACTERISTICS
from ptmcalc.machines.conveyor.waves.effects.damping import BELT_DAMPING
from ptmcalc.machines.conveyor.waves.effects.feed import FEED
from ptmcalc.machines.conveyor.waves.effects.gear import GEAR_LOSSES
from ptmcalc.machines.conveyor.waves.effects.idlers import COULOMB_IDLERS, VISCOUS_IDLERS
from ptmcalc.machines.conveyor.waves.effects.moving_belt import MOVING_BELT
from ptmcalc.machines.conveyor.waves.effects.sag import SAG
from ptmcalc.machines.conveyor.waves.effects.slip import SLIP
from ptmcalc.machines.conveyor.waves.effects.tail import TAIL_JUMP, TAIL_MASS
from ptmcalc.machines.conveyor.waves.effects.takeup import TAKEUP_MASS
from ptmcalc.machines.conveyor.waves.effects.wave import BELT_WAVE
from ptmcalc.machines.conveyor.waves.first_wave import FIRST_WAVE
from ptmcalc.machines.conveyor.waves.network import NETWORK, RUNNING_NETWORK
from ptmcalc.machines.conveyor.waves.two_interval import TWO_INTERVAL

LOADS = (
    LoadInfo(BELT_SPEED, "belt speed, maximum in the simulated window", units.SPEED, headline=False),
    LoadInfo(MOTOR_SPEED, "motor speed, maximum in the simulated window", units.ANGULAR_SPEED, headline=False),
)

WAVES: Topic[Conveyor] = Topic(
    loads=LOADS,
    parts=lambda spec: parts_of(LOADS, spec),
    effects=(
        BELT_WAVE,
        TAIL_JUMP,
        TAIL_MASS,
        SAG,
        COULOMB_IDLERS,
        TAKEUP_MASS,
        VISCOUS_IDLERS,
        BELT_DAMPING,
        MOVING_BELT,
        SLIP,
        GEAR_LOSSES,
        FEED,
    ),
    solvers=(FIRST_WAVE, TWO_INTERVAL, CHARACTERISTICS, NETWORK, RUNNING_NETWORK),
)
