"""Hoist: a load on a tackle, a drum, a gearbox, a motor and a brake."""

from importlib import resources

from ptmcalc.contract.machine import MachineKind
from ptmcalc.machines.hoist.assumptions import assumptions
from ptmcalc.machines.hoist.checks import CHECKS
from ptmcalc.machines.hoist.loads import LOADS
from ptmcalc.machines.hoist.solvers import SOLVERS
from ptmcalc.machines.hoist.spec import Hoist

KIND = MachineKind(
    name="hoist",
    title="hoist: rope, drum, motor, brake",
    spec=Hoist,
    loads=LOADS,
    effects=(),
    solvers=SOLVERS,
    checks=CHECKS,
    template=resources.files(__package__).joinpath("template.yaml").read_text("utf-8"),
    assumed=assumptions,
)
