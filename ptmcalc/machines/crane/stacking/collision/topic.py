"""Collision: buffers and obstacles."""

from ptmcalc.contract.topic import Topic
from ptmcalc.machines.crane.stacking.collision.buffer_stop import BUFFER_STOP
from ptmcalc.machines.crane.stacking.collision.checks import CHECKS_OF_BUFFERS
from ptmcalc.machines.crane.stacking.collision.obstacle_energy import (
    OBSTACLE_BOUND,
    OBSTACLE_ENERGY,
    OBSTACLE_TIP_STOPPED,
)
from ptmcalc.machines.crane.stacking.machine.loads import OF_THE_BUFFERS, OF_THE_OBSTACLE
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.mast.modal import COLLISION_MODAL

COLLISION: Topic[Stacker] = Topic(
    loads=(*OF_THE_OBSTACLE, *OF_THE_BUFFERS),
    solvers=(OBSTACLE_TIP_STOPPED, OBSTACLE_ENERGY, OBSTACLE_BOUND, COLLISION_MODAL, BUFFER_STOP),
    checks=CHECKS_OF_BUFFERS,
)
