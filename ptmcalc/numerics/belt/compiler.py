"""Compiles `march.c` to a shared library beside it.

The installation does so (`hatch_build.py` imports this file alone, so it uses the standard library only), and a working
copy does so again when it first simulates a belt after `march.c` changed.
"""

import hashlib
import os
import shlex
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

SOURCE = Path(__file__).with_name("march.c")
LIBRARY = SOURCE.with_name("libbelt" + {"win32": ".dll", "darwin": ".dylib"}.get(sys.platform, ".so"))
PLATFORM = sysconfig.get_platform().replace("-", "_").replace(".", "_")
FLAGS = (
    "-std=c11",
    "-O3",
    "-ffp-contract=off",  # the same digits on every processor
    "-fno-math-errno",
    "-fno-trapping-math",
    "-fvisibility=hidden",
    "-shared",
)


def compiler() -> list[str]:
    """The command of the system's compiler, `$CC`, cc, gcc or clang; nothing where there is none."""
    named = shlex.split(os.environ.get("CC", ""))
    for command in (named, ["cc"], ["gcc"], ["clang"]):
        if command and shutil.which(command[0]):
            return command
    return []


def checksum(source: Path = SOURCE) -> str:
    """What a library compiled from a text contains."""
    return hashlib.sha256(source.read_bytes()).hexdigest()


def compiled(source: Path = SOURCE, library: Path = LIBRARY, *more: str) -> None:
    """Compile a file; the library contains the checksum of the text that it is from.

    Raises:
        OSError: there is no compiler, or the folder cannot be written.
        CalledProcessError: the compiler failed.
    """
    command = compiler() or [sys.executable, "-m", "ziglang", "cc"]
    flags = [*FLAGS, *([] if sys.platform == "win32" else ["-fPIC"]), f'-DSOURCE="{checksum(source)}"', *more]
    made = library.with_name(f"{library.name}.{os.getpid()}")
    subprocess.run([*command, *flags, "-o", str(made), str(source), *([] if sys.platform == "win32" else ["-lm"])],
                   check=True, capture_output=True)  # fmt: skip
    made.replace(library)  # at once: a process that runs keeps the one it has
