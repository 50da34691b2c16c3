"""Writes every derived file anew, after results have changed on purpose:

    python tests/update.py                  all of them
    python tests/update.py golden docs      some of them

examples: what `ptmcalc explain` shows (`examples.json` of each kind); docs: README.md and docs/ as their commands print
them; golden: the reports in tests/golden; validation: docs/validation.md. Read the difference before committing it.

On two slow cores, `golden` takes some seconds, `examples` about four minutes and `docs` about ten.
"""

import os
import subprocess
import sys
from pathlib import Path

DERIVED = {
    "examples": ("tests/house/test_specs.py", "tests/house/test_explain.py"),
    "docs": ("tests/house/test_docs.py",),
    "golden": ("tests/report/test_golden.py",),
    "validation": ("tests/reference",),
}
"""The tests that hold each of them, in this order: pages print examples."""

if __name__ == "__main__":
    wanted = sys.argv[1:] or list(DERIVED)
    if unknown := [name for name in wanted if name not in DERIVED]:
        sys.exit(f"nothing is called {', '.join(unknown)}: {', '.join(DERIVED)}")
    failed = False
    for name in (name for name in DERIVED if name in wanted):
        command = [sys.executable, "-m", "pytest", "-q", "-n", "0", *DERIVED[name]]
        done = subprocess.run(
            command, cwd=Path(__file__).parents[1], env={**os.environ, "PTMCALC_UPDATE": "1"}, check=False
        )
        failed |= done.returncode != 0
    sys.exit(failed)
