"""The checks of the drive, and of a chain that changes its speed."""

from ptmcalc.contract.check import AnyCheck
from ptmcalc.machines.chain_drive.checks_drive import CHECKS_OF_THE_DRIVE
from ptmcalc.machines.chain_drive.checks_start import CHECKS_OF_STARTS
from ptmcalc.machines.chain_drive.checks_stop import CHECKS_OF_STOPS

CHECKS_OF_MOTION: tuple[AnyCheck, ...] = (*CHECKS_OF_THE_DRIVE, *CHECKS_OF_STARTS, *CHECKS_OF_STOPS)
