"""Where a process begins: what makes it start fast is set before the first import.

While the libraries and the models of a kind are built, the collector of reference cycles would go over every object a
few hundred times and find next to nothing; that was a quarter of the time of a check. It stays on, but looks rarely.
pydantic would read what every installed package announces, to find plug-ins that look into models. At the end nothing
is left to collect that the end of the process does not free by itself: to look for it was another quarter.
Matrices are small (a few hundred rows): several threads of the linear algebra library wait for each other longer than
they compute, on a busy machine fifty times as long, so that it has one unless the environment says otherwise.
"""

import gc
import os

ALLOCATIONS = 100_000
"""New objects after which cycles are looked for."""
THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
"""Settings of the threads of the linear algebra library, read when numpy is imported."""


def main() -> None:
    """The command line."""
    gc.set_threshold(ALLOCATIONS)
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")
    for name in THREADS:
        os.environ.setdefault(name, "1")
    from ptmcalc.cli.main import main as run

    try:
        run()
    finally:
        gc.freeze()
