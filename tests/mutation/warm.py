"""Faults tried in a process that has the tests already: collected once, then a fork for each fault.

Starting pytest and importing the package takes longer than most tests that see a fault. Here the code of the functions
of a module is put in place of what they had, so that whoever holds one of them runs the fault; numbers of a module go
to all modules that took them by name. What a module works out of another one's numbers while it is imported stays as
it was: a fault that changes such a number is said to be `stale`, unless a test fails on it, and is for a new process.
"""

import enum
import functools
import os
import resource
import sys
import types
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

LEFT_OUT = {"__dict__", "__weakref__", "__slots__", "__match_args__", "__qualname__"}


def _function(one: object) -> types.FunctionType | None:
    """The function inside a method, a property or a cache."""
    if isinstance(one, property):
        return _function(one.fget)
    if isinstance(one, functools.cached_property):
        return _function(one.func)
    if isinstance(one, staticmethod | classmethod):
        return _function(one.__func__)
    found = one if isinstance(one, types.FunctionType) else getattr(one, "__wrapped__", None)
    return found if isinstance(found, types.FunctionType) else None


def _take(old: types.FunctionType, new: types.FunctionType) -> None:
    old.__code__, old.__defaults__, old.__kwdefaults__ = new.__code__, new.__defaults__, new.__kwdefaults__
    for cell, other in zip(old.__closure__ or (), new.__closure__ or (), strict=True):
        if not isinstance(cell.cell_contents, type):
            cell.cell_contents = other.cell_contents


def _same(one: object, other: object) -> bool:
    if isinstance(one, np.ndarray):
        return np.array_equal(one, np.asarray(other), equal_nan=one.dtype.kind in "fc")
    return bool(one == other) or repr(one) == repr(other)


def _take_class(old: type, new: type) -> None:
    for name, one in list(vars(new).items()):
        if name.startswith("__") and not callable(one):
            continue
        before = vars(old).get(name)
        function, other = _function(before), _function(one)
        if name in LEFT_OUT or isinstance(one, types.MemberDescriptorType | types.GetSetDescriptorType):
            continue
        if function is not None and other is not None:
            _take(function, other)
        elif isinstance(before, type) and isinstance(one, type):
            _take_class(before, one)
        elif not _same(before, one):
            setattr(old, name, one)


def change(name: str, source: bytes) -> bool:
    """A module that is there already is as if its source were this one; whether a number of it is another."""
    module = sys.modules[name]
    space, before, moved = vars(module), dict(vars(module)), False
    exec(compile(source, str(module.__file__), "exec"), space)
    for key, old in before.items():
        new = space.get(key)
        if old is new or key.startswith("__"):
            continue
        function, other = _function(old), _function(new)
        if isinstance(old, type) and isinstance(new, type):
            if old.__module__ == name and not issubclass(old, enum.Enum):
                _take_class(old, new)
        elif function is not None and other is not None:
            _take(function, other)
            getattr(old, "cache_clear", bool)()
        elif not isinstance(old, types.ModuleType) and not _same(old, new):
            moved = True
            for holder in list(sys.modules.values()):
                if vars(holder).get(key) is old:
                    vars(holder)[key] = new
            continue
        space[key] = old
    return moved


class Session:
    """A plugin of pytest that runs nothing itself but hands out what tests a fork, as often as it is asked."""

    def __init__(self, work: Callable[["Session"], None]) -> None:
        self.work = work
        self.items: dict[str, pytest.Item] = {}

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtestloop(self, session: pytest.Session) -> bool:
        self.items = {item.nodeid: item for item in session.items}
        self.work(self)
        return True

    def attempt(self, tests: list[str], limits: dict[str, float], module: str, source: bytes) -> tuple[str, str]:
        """How a fault ends, `killed`, `endless`, `survived` or `stale`, and the test that told."""
        chosen = [self.items[test] for test in tests if test in self.items]
        read, write = os.pipe()
        child = os.fork()
        if not child:
            os.close(read)
            status = 70
            try:
                status = self._run(chosen, limits, module, source, write)
            finally:
                os._exit(status)
        os.close(write)
        with os.fdopen(read, "rb") as told:
            at = told.read().decode().splitlines() or [""]
        status = os.waitpid(child, 0)[1]
        if not os.WIFEXITED(status):
            return "endless", at[-1]
        code = os.waitstatus_to_exitcode(status)
        if code == 70:
            sys.exit(f"{module} could not be changed: {at[-1]}")
        return {0: "survived", 1: "killed", 2: "stale"}[code], at[-1]

    def _run(self, chosen: list[Any], limits: dict[str, float], module: str, source: bytes, write: int) -> int:
        try:
            moved = change(module, source)
        except Exception as error:  # a fault that does not let the module be imported
            os.write(write, f"import: {error!r}".encode())
            return 1
        for item, following in zip(chosen, [*chosen[1:], None], strict=True):
            used = resource.getrusage(resource.RUSAGE_SELF)
            soft = int(used.ru_utime + used.ru_stime + limits[item.nodeid]) + 1
            resource.setrlimit(resource.RLIMIT_CPU, (soft, resource.RLIM_INFINITY))  # ends the process
            os.write(write, f"{item.nodeid}\n".encode())
            item.config.hook.pytest_runtest_protocol(item=item, nextitem=following)
            if item.session.testsfailed:
                return 1
        return 2 if moved else 0
