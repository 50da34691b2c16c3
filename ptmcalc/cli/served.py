"""What the server of forks imports first: it begins like the command itself."""

import gc

from ptmcalc.cli.start import ALLOCATIONS

gc.set_threshold(ALLOCATIONS)
