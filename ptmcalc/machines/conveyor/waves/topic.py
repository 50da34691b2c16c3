"""Belt waves: effects, their bounds without simulation, and the simulations."""

from ptmcalc.contract.topic import Topic
from ptmcalc.machines.conveyor.spec import Conveyor
from ptmcalc.machines.conveyor.waves.characteristics import CHARACTERISTICS
from ptmcalc.machines.conveyor.waves.effects import EFFECTS
from ptmcalc.machines.conveyor.waves.first_wave import FIRST_WAVE
from ptmcalc.machines.conveyor.waves.network import NETWORK, RUNNING_NETWORK
from ptmcalc.machines.conveyor.waves.two_interval import TWO_INTERVAL

WAVES: Topic[Conveyor] = Topic(
    effects=EFFECTS,
    solvers=(FIRST_WAVE, TWO_INTERVAL, CHARACTERISTICS, NETWORK, RUNNING_NETWORK),
)
