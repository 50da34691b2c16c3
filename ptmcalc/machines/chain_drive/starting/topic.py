"""Starting: starting force and time, the tension of the start."""

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo
from ptmcalc.contract.topic import Topic
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive
from ptmcalc.machines.chain_drive.starting.breakaway import BREAKAWAY
from ptmcalc.machines.chain_drive.starting.checks import SLACK, SLOW, STRENGTH, WEAK
from ptmcalc.machines.chain_drive.starting.motor_curve_waves import MOTOR_WAVES
from ptmcalc.machines.chain_drive.starting.permitted_starts import PERMITTED, STARTS
from ptmcalc.machines.chain_drive.starting.rigid import RIGID_START, START_NOTES
from ptmcalc.machines.chain_drive.starting.waves import ONE_MODE, WAVES

STARTING: Topic[ChainDrive] = Topic(
    loads=(
        LoadInfo("tension_start", "chain tension during start, maximum", units.FORCE, governing=True),
        LoadInfo("tension_dynamic_start", "dynamic component, start", units.FORCE),
        LoadInfo("starting_force", "mean starting force at the chain", units.FORCE),
        LoadInfo("starting_reserve", "starting force reserve", units.RATIO, governing=True),
        LoadInfo("start_time", "starting time", units.TIME, governing=True),
        LoadInfo("acceleration_motor", "motor angular acceleration", units.ANGULAR_ACCELERATION, headline=False),
        LoadInfo("reduced_inertia", "equivalent inertia at motor shaft", units.INERTIA, headline=False),
        LoadInfo("safety_start", "safety factor, start or stop", units.RATIO, governing=True),
        PERMITTED,
    ),
    solvers=(RIGID_START, START_NOTES, ONE_MODE, BREAKAWAY, WAVES, MOTOR_WAVES),
    checks=(WEAK, SLOW, STRENGTH, SLACK, STARTS),
)
