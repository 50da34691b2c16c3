"""Mutation check: small faults drawn at random in `laws` and `numerics`; do the tests that reach them fail?

    python -m tests.mutation reach            which test runs which function; once, as long as the whole suite takes
    python -m tests.mutation run --seed 1     draws 50 faults and tries them; the log names the seed and each fault

Each fault is tried in a copy of the project with the files of tests that run the function it stands in, the nearest
and cheapest first, up to a limit of processor seconds, in a fork of a process that has collected them all (`warm`);
what such a fork cannot show, in a process of its own. Caught is what a test fails on and what runs without end.
What no test can see stands in `equivalent.toml` with its reason and leaves the count. Fewer than 95 % caught is a
failure. mutmut and cosmic-ray were left: neither draws a sample by a seed, chooses tests by what they reach, nor keeps
a reason for a survivor, and each would need most of what stands here around it.
"""

import argparse
import collections
import json
import math
import os
import random
import re
import resource
import shutil
import sys
import tempfile
import time
import tomllib
import traceback
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path

import pytest

from .mutants import Mutant, population
from .reach import CHOSEN, KEPT, make_speak
from .warm import Session

ROOT = Path(__file__).parents[2]
EQUIVALENT = Path(__file__).parent / "equivalent.toml"
PARTS = (
    "ptmcalc",
    "tests",
    "specs",
    "docs",
    ".ci",
    "pyproject.toml",
    "README.md",
    "CHANGELOG.md",
    "LICENSE",
    "uv.lock",
)
ROOMS = ("laws", "numerics", "reference", "order", "stability", "coverage", "machines", "engine")
FIRST, MOST = 15.0, 240.0
"""Processor seconds of tests: in the first batch of a fault (each further one is twice as long), and for all of it."""
LIMIT, START = 3, 5.0
"""Tests that take so many times their seconds of the processor, and those of a start, have no end."""
LIBRARIES = (
    "numpy",
    "pydantic",
    "yaml",
    "typer",
    "rich",
    "hypothesis",
    "scipy.integrate",
    "scipy.linalg",
    "scipy.optimize",
)
Reach = dict[str, tuple[float, set[str]]]


@dataclass(frozen=True)
class Outcome:
    """How a fault ended: `killed`, `endless`, `equivalent` or `survived`, by which test and after what was tried."""

    mutant: Mutant
    end: str
    by: str

    def __str__(self) -> str:
        old, new = self.mutant.lines
        place = f"{self.mutant.path.relative_to(ROOT).as_posix()}:{self.mutant.line}"
        return f"{self.end:10} {place}  {self.by}\n    - {old}\n    + {new}"


def copy_project(place: Path) -> None:
    for part in PARTS:
        source = ROOT / part
        if source.is_dir():
            shutil.copytree(source, place / part, ignore=shutil.ignore_patterns("__pycache__", ".hypothesis"))
        elif source.exists():
            shutil.copy(source, place / part)


def run_tests(
    place: Path, *arguments: str, limit: float = 0, plugins: tuple[object, ...] = (), **more: str
) -> tuple[int | None, list[str]]:
    """Tests of the copy, in a fork that has the libraries already: (exit status, None without an end, output)."""
    out = place / "out.txt"
    child = os.fork()
    if not child:
        with out.open("w") as file:
            os.dup2(file.fileno(), 1)
            os.dup2(file.fileno(), 2)
        if limit:
            resource.setrlimit(resource.RLIMIT_CPU, (math.ceil(limit), math.ceil(limit) + 1))  # ends the process
        os.chdir(place)
        os.environ.update(more, PYTHONPATH=os.pathsep.join(map(str, (place, place / "tests"))))
        os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
        sys.dont_write_bytecode = False
        sys.path[:0] = [str(place), str(place / "tests")]
        for name in [name for name in sys.modules if name.partition(".")[0] in ("tests", "mutation")]:
            del sys.modules[name]  # those of the copy
        status = 70
        try:
            ours = "-q -n 0 -p no:cacheprovider -p mutation.reach -W ignore::pytest.PytestAssertRewriteWarning"
            status = pytest.main([*ours.split(), *arguments], plugins)
        except BaseException:
            traceback.print_exc()
        finally:
            sys.stdout.flush()
            sys.stderr.flush()
            os._exit(status)
    status = os.waitpid(child, 0)[1]
    return os.waitstatus_to_exitcode(status) if os.WIFEXITED(status) else None, out.read_text("utf-8").splitlines()


def read_reach(kept: Path) -> Reach:
    found: Reach = {}
    for path in sorted(kept.glob("reach-*.json")):
        found |= {test: (cost, set(noted)) for test, (cost, noted) in json.loads(path.read_text("utf-8")).items()}
    return found or sys.exit(f"nothing in {kept}: `python -m tests.mutation reach` comes first")


def _names(file: Path, module: str) -> bool:
    """Whether a file of tests may read a number of a module without running anything of it."""
    return file.exists() and re.search(rf"\b{module}\b", file.read_text("utf-8")) is not None


def batches(mutant: Mutant, reach: Reach, most: float) -> list[list[str]]:
    """The tests to try, by files: those of the law first, then by rooms and cost; of a dear file only what reaches."""
    module = mutant.function.partition(":")[0]
    runs = any(mutant.function in noted for _, noted in reach.values())  # neither a module does nor a class

    stem = mutant.path.stem
    reads = {} if runs else {file: _names(ROOT / file, stem) for file in {test.partition("::")[0] for test in reach}}

    def reaches(noted: set[str]) -> bool:
        return mutant.function in noted if runs else any(name.startswith(f"{module}:") for name in noted)

    files: dict[str, list[str]] = collections.defaultdict(list)
    for test in reach:
        files[test.partition("::")[0]].append(test)
    options = []
    for file, tests in files.items():
        hits = [test for test in tests if reads.get(file) or reaches(reach[test][1])]
        if hits:
            chosen = tests if sum(reach[test][0] for test in tests) < FIRST / 2 else hits
            room = Path(file).parts[1]
            near = module.rpartition(".")[2] in Path(file).stem
            cost = sum(reach[test][0] for test in chosen)
            options.append((not near, ROOMS.index(room) // 2 if room in ROOMS else len(ROOMS), cost, chosen))
    found: list[list[str]] = [[]]
    size, total = 0.0, 0.0
    for _, _, cost, chosen in sorted(options):
        if total + cost > most and total:
            continue
        if found[-1] and size + cost > FIRST * 2 ** (len(found) - 1):
            found.append([])
            size = 0.0
        found[-1] += chosen
        size, total = size + cost, total + cost
    return found if found[0] else []


def attempt(mutant: Mutant, tests: list[list[str]], place: Path, reach: Reach, tried: int) -> Outcome:
    """Tries one fault in the copy, which is as before afterwards."""
    copy = place / mutant.path.relative_to(ROOT)
    copy.write_bytes(mutant.source)
    os.utime(copy, (tried, tried))  # another time than any before: compiled code of a change within a second is stale
    done = 0
    try:
        for batch in tests:
            predicted = sum(reach[test][0] for test in batch)
            (place / "chosen.json").write_text(json.dumps(batch), "utf-8")
            files = list(dict.fromkeys(test.partition("::")[0] for test in batch))
            limit = LIMIT * (predicted + START)
            status, said = run_tests(place, "-x", *files, limit=limit, **{CHOSEN: str(place / "chosen.json")})
            if status is None:
                return Outcome(mutant, "endless", f"in {len(batch)} tests from {files[0]}")
            if status == pytest.ExitCode.NO_TESTS_COLLECTED:  # all of them renamed since `reach`
                continue
            if status:
                failed = [line for line in said if line.startswith(("FAILED", "ERROR"))]
                if not failed:  # neither a test nor its file: pytest itself
                    sys.exit("\n".join(said))
                return Outcome(mutant, "killed", failed[0].partition(" - ")[0])
            done += len(batch)
        return Outcome(mutant, "survived", f"{done} tests")
    finally:
        shutil.copy2(mutant.path, copy)


def attempt_all(drawn: list[tuple[int, Mutant]], place: Path, reach: Reach, most: float) -> dict[int, Outcome]:
    """Tries faults one after the other in forks of one process, telling of each; without those that are stale there."""
    tests = {k: [test for batch in batches(mutant, reach, most) for test in batch] for k, mutant in drawn}
    files = sorted({test.partition("::")[0] for chosen in tests.values() for test in chosen})
    limits = {test: LIMIT * (cost + START) for test, (cost, _) in reach.items()}
    told, screen = place / "told.json", os.dup(sys.stdout.fileno())

    def work(session: Session) -> None:
        found = {}
        for k, mutant in drawn:
            start, copy = time.perf_counter(), place / mutant.path.relative_to(ROOT)
            copy.write_bytes(mutant.source)  # for processes that tests start
            os.utime(copy, (10**9 + k, 10**9 + k))  # see `attempt`
            module = ".".join(copy.relative_to(place).with_suffix("").parts)
            end, by = session.attempt(tests[k], limits, module, mutant.source)
            shutil.copy2(mutant.path, copy)
            if end != "stale":
                found[k] = end, by if end == "killed" else f"{len(tests[k])} tests, the last {by}"
                line = f"{k:3} {Outcome(mutant, *found[k])}  ({time.perf_counter() - start:.1f} s)\n"
                os.write(screen, line.encode())
        told.write_text(json.dumps(found), "utf-8")

    told.unlink(missing_ok=True)
    said = run_tests(place, *files, plugins=(Session(work),))[1] if files else []
    if not told.exists():
        sys.exit("\n".join(said))
    chosen = dict(drawn)
    return {int(k): Outcome(chosen[int(k)], *one) for k, one in json.loads(told.read_text("utf-8")).items()}


def reasons() -> dict[tuple[str, str, str], str]:
    """Why a fault changes nothing a test could see, by its file and its line before and after.

    A reason may hold for several faults of one line; each of them is named.
    """
    found: dict[tuple[str, str, str], str] = {}
    for entry in tomllib.loads(EQUIVALENT.read_text("utf-8")).get("mutant", []):
        several = entry["becomes"]
        for one in several if isinstance(several, list) else [several]:
            found[entry["file"], entry["line"], one] = entry["because"]
    return found


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m tests.mutation", description=__doc__.split("\n", 1)[0])
    parser.add_argument("what", choices=["reach", "run"])
    parser.add_argument("--kept", type=Path, default=Path(tempfile.gettempdir(), "ptmcalc-mutation"))
    parser.add_argument("--rooms", nargs="*", default=["."], help="of the tests, for reach")
    parser.add_argument("--seed", type=int, default=random.SystemRandom().randrange(10**6))
    parser.add_argument("--number", type=int, default=50)
    parser.add_argument("--most", type=float, default=MOST, help="processor seconds of tests for a fault")
    parser.add_argument("--doubt", action="store_true", help="try what is explained too: a reason may be none")
    parser.add_argument("--only", nargs="*", type=int, help="of the faults drawn, these: to try survivors again")
    parser.add_argument("--of", default="", help="only faults of files with this in their path: to go through one")
    given = parser.parse_args()
    given.kept.mkdir(parents=True, exist_ok=True)
    for library in LIBRARIES:
        import_module(library)
    with tempfile.TemporaryDirectory() as name:
        copy_project(place := Path(name).resolve())
        if given.what == "reach":
            make_speak(place / "ptmcalc")
            for room in given.rooms:
                print(room, *run_tests(place, f"tests/{room}", **{KEPT: str(given.kept)})[1][-1:], flush=True)
            return
        reach, known = read_reach(given.kept), reasons()
        faults = [one for one in population(ROOT / "ptmcalc") if given.of in one.path.relative_to(ROOT).as_posix()]
        drawn = random.Random(given.seed).sample(faults, min(given.number, len(faults)))
        ends: collections.Counter[str] = collections.Counter()
        print(f"seed {given.seed}: {len(drawn)} faults", flush=True)
        chosen = [(k, mutant) for k, mutant in enumerate(drawn) if not given.only or k in given.only]
        keys = {k: (mutant.path.relative_to(ROOT).as_posix(), *mutant.lines) for k, mutant in chosen}
        for k, mutant in chosen:
            if keys[k] in known and not given.doubt:
                ends["equivalent"] += 1
                print(f"{k:3} {Outcome(mutant, 'equivalent', known[keys[k]])}", flush=True)
        open_ones = [(k, mutant) for k, mutant in chosen if keys[k] not in known or given.doubt]
        found = attempt_all(open_ones, place, reach, given.most)
        for k, mutant in open_ones:
            if k not in found:
                start = time.perf_counter()
                found[k] = attempt(mutant, batches(mutant, reach, given.most), place, reach, 10**9 + 10**4 + k)
                print(f"{k:3} {found[k]}  ({time.perf_counter() - start:.0f} s)", flush=True)
            explained = keys[k] in known and found[k].end == "survived"
            ends["equivalent" if explained else found[k].end] += 1
        caught, counted = ends["killed"] + ends["endless"], sum(ends.values()) - ends["equivalent"]
        print(f"seed {given.seed}: {dict(ends)}, {caught} of {counted} caught")
        sys.exit(caught < 0.95 * counted)


if __name__ == "__main__":
    main()
