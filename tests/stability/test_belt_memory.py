"""The C of a belt under the checks of its compiler, and its build without a compiler on the system: studies."""

import os
import shutil
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest
from support.command import ROOT, environment

SOURCE = ROOT / "ptmcalc" / "numerics" / "belt" / "march.c"
CHECKED = """
import hashlib, runpy, sys
from pathlib import Path
from ptmcalc.numerics.belt import compiled
compiled.LIBRARY = Path(sys.argv[1])
compiled.SOURCE = Path("not compared")
from ptmcalc.machines.conveyor.waves import network
from support.machines import spec_of
for scene in ("start", "emergency_stop", "jam"):
    data = {
        "kind": "conveyor",
        "route": {"length": "400 m", "lift": "20 m"},
        "belt": {"mass": "20 kg/m", "stiffness": "10 MN", "damping": {"model": "kelvin_voigt", "time": "0.02 s"}},
        "idlers": {
            "carry": {"line_mass": "15 kg/m", "pitch": "1.2 m"}, "return": {"line_mass": "6 kg/m", "pitch": "3 m"}
        },
        "load": {"mass": "60 kg/m"},
        "resistance": {"coefficient": 0.02, "secondary": 1.1, "speed_share": 0.2},
        "speed": "3 m/s",
        "drives": {
            name: {
                "motor": {"count": 1, "inertia": "1 kg*m^2", "mean_starting_torque": "900 N*m"},
                "gear": {"ratio": 18},
                "drum": {"diameter": "0.8 m", "wrap": "190 deg", "friction": 0.2},
            }
            for name in ("a", "b")
        },
        "brakes": {"one": {"torque": "900 N*m", "delay": "0.2 s", "rise_time": "0.5 s", "shaft": "motor"}},
        "takeup": {"type": "gravity", "tension": "30 kN"},
        "scenes": [{"type": scene} | ({"at": "tail"} if scene == "jam" else {})],
    }
    spec = spec_of(data)
    names = ("belt_wave tail_jump tail_mass coulomb_idlers viscous_idlers belt_damping moving_belt slip takeup_mass"
             " sag").split()
    result = network.run(spec, spec.all_scenes[0], frozenset(names), 0)
    print(scene, result.work)
"""


@pytest.mark.study
def test_no_step_leaves_its_arrays_or_does_what_c_leaves_open(tmp_path: Path) -> None:
    """Starts, stops and jams with all effects under AddressSanitizer and UndefinedBehaviorSanitizer of gcc."""
    gcc = shutil.which("gcc")
    if gcc is None or sys.platform != "linux":
        pytest.skip("needs gcc on Linux")
    library, flags = tmp_path / "libbelt.so", "-std=c11 -O1 -g -ffp-contract=off -fPIC -shared -Wall -Wextra -Werror"
    checks = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all"]
    subprocess.run([gcc, *flags.split(), *checks, "-o", library, SOURCE, "-lm"], check=True)
    found = subprocess.run([gcc, "-print-file-name=libasan.so"], capture_output=True, text=True, check=True)
    env = environment(ROOT, ROOT / "tests", LD_PRELOAD=found.stdout.strip(), ASAN_OPTIONS="detect_leaks=0")
    done = subprocess.run(
        [sys.executable, "-c", CHECKED, library], env=env, cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert [line.split()[0] for line in done.stdout.splitlines()] == ["start", "emergency_stop", "jam"]


@pytest.mark.study
def test_a_wheel_is_built_without_a_compiler_on_the_system(tmp_path: Path) -> None:
    """With that of the package index, where it is installed: the same numbers, since neither contracts nor reorders."""
    if find_spec("ziglang") is None or find_spec("hatchling") is None:
        pytest.skip("needs ziglang and hatchling")
    program = "import sys; from pathlib import Path; import compiler; compiler.compiled(*map(Path, sys.argv[1:]))"
    env = environment(ROOT, PATH=str(tmp_path)) | {"CC": ""}
    library = tmp_path / "libbelt.so"
    subprocess.run([sys.executable, "-c", program, SOURCE, library], env=env, cwd=SOURCE.parent, check=True)
    assert library.stat().st_size > 10_000
    assert os.listdir(tmp_path) == ["libbelt.so"]
