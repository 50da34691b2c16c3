"""Compiles the steps of a belt, one file of C, to a shared library beside it, which goes into the wheel.

It uses the compiler of the system. Where there is none, the build requires `ziglang` of the package index, which
contains one.
"""

import sys
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

FOLDER = "ptmcalc/numerics/belt"
sys.path.insert(0, str(Path(__file__).parent / FOLDER))
import compiler  # noqa: E402 - the file alone: the package's own requirements are not installed yet


class CustomBuildHook(BuildHookInterface[Any]):
    """Compiles before a wheel is made."""

    def dependencies(self) -> list[str]:
        """A compiler of the package index, where a wheel is built and the system has none."""
        return ["ziglang>=0.13"] if self.target_name == "wheel" and not compiler.compiler() else []

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Compile, and name the wheel after the platform."""
        if self.target_name != "wheel":
            return
        compiler.compiled()
        build_data["pure_python"] = False
        build_data["tag"] = f"py3-none-{compiler.PLATFORM}"
        build_data["artifacts"].append(f"/{FOLDER}/{compiler.LIBRARY.name}")  # though git ignores it
