"""Slewing crane: a load on a jib that turns about a vertical axis."""

from importlib import resources

from ptmcalc.contract.machine import MachineKind
from ptmcalc.machines.crane.slewing.checks import CHECKS
from ptmcalc.machines.crane.slewing.loads import LOADS
from ptmcalc.machines.crane.slewing.solvers import SOLVERS
from ptmcalc.machines.crane.slewing.spec import SlewingCrane

SLEWING = MachineKind(
    name="crane",
    type="slewing",
    title="slewing crane: jib, slewing drive, brake, ring",
    spec=SlewingCrane,
    loads=LOADS,
    effects=(),
    solvers=SOLVERS,
    checks=CHECKS,
    template=resources.files(__package__).joinpath("template.yaml").read_text("utf-8"),
)
