"""Storm: wind out of service."""

from ptmcalc.contract.topic import Topic
from ptmcalc.machines.crane.travelling.machine.loads import OF_THE_STORM
from ptmcalc.machines.crane.travelling.machine.spec import Travelling
from ptmcalc.machines.crane.travelling.storm.checks import STORM
from ptmcalc.machines.crane.travelling.storm.storm_parking import STORM_PARKING

STORM_PARKED: Topic[Travelling] = Topic(
    loads=OF_THE_STORM,
    solvers=(STORM_PARKING,),
    checks=(STORM,),
)
