"""Compiles the steps of a belt, one file of C, to a shared library beside it, which goes into the wheel.

It uses the compiler of the system: `$CC`, cc, gcc or clang. Where there is none, the build requires `ziglang` of the
package index, which contains one.
"""

import hashlib
import os
import shlex
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

FOLDER = "ptmcalc/numerics/belt"
ENDING = {"win32": ".dll", "darwin": ".dylib"}.get(sys.platform, ".so")
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
    """The command of the system's compiler; nothing where there is none."""
    named = shlex.split(os.environ.get("CC", ""))
    for command in (named, ["cc"], ["gcc"], ["clang"]):
        if command and shutil.which(command[0]):
            return command
    return []


def compiled(source: Path, library: Path, *more: str) -> None:
    """Compile a file; the library contains the checksum of the text that it is from."""
    command = compiler() or [sys.executable, "-m", "ziglang", "cc"]
    checksum = hashlib.sha256(source.read_bytes()).hexdigest()
    flags = [*FLAGS, *([] if sys.platform == "win32" else ["-fPIC"]), f'-DSOURCE="{checksum}"', *more]
    made = library.with_name(f"{library.name}.{os.getpid()}")
    subprocess.run([*command, *flags, "-o", str(made), str(source), *([] if sys.platform == "win32" else ["-lm"])],
                   check=True)  # fmt: skip
    made.replace(library)  # at once: a process that runs keeps the one it has


class CustomBuildHook(BuildHookInterface[Any]):
    """Compiles before a wheel is made."""

    def dependencies(self) -> list[str]:
        """A compiler of the package index, where a wheel is built and the system has none."""
        return ["ziglang>=0.13"] if self.target_name == "wheel" and not compiler() else []

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Compile, and name the wheel after the platform."""
        if self.target_name != "wheel":
            return
        folder = Path(self.root) / FOLDER
        library = folder / f"libbelt{ENDING}"
        compiled(folder / "march.c", library)
        build_data["pure_python"] = False
        build_data["tag"] = f"py3-none-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"
        build_data["artifacts"].append(f"/{FOLDER}/{library.name}")  # though git ignores it
