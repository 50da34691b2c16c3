"""`ptmcalc decode`: records made by an integration of their own give back what made them; faulty ones are explained.

The machines turn by Euler's equations of two shafts and a gear, integrated with DOP853; noise and sampling are seeded.
"""

import json
import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from support.command import Done, ptmcalc, unpainted

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Maker:
    """A shaft with J = mean + swing cos(2 phi), a straight motor behind a gear, losses a + b w, a weight, a brake."""

    mean: float = 30.0
    swing: float = 4.0
    ratio: float = 12.0
    efficiency: float = 0.94
    rotor: float = 0.02
    starting: float = 60.0
    free: float = 150.0
    friction: float = 40.0
    viscous: float = 3.0
    weight: float = 15.0
    brake: float = 300.0
    delay: float = 0.15
    rise: float = 0.1

    def yaml(self) -> str:
        return f"""\
kind: shaft
inertia:
  type: harmonics
  mean: {self.mean!r} kg*m^2
  terms: [{{order: 2, cosine: {self.swing!r} kg*m^2}}]
drive:
  motor: {{type: linear, starting_torque: 1 kN*m, no_load_speed: {self.free!r} rad/s}}
  motor_inertia: {self.rotor!r} kg*m^2
  gear: {{ratio: {self.ratio!r}, efficiency: {self.efficiency!r}}}
losses: {{torque: {self.friction!r} N*m, viscous: {self.viscous!r} N*m*s/rad}}
potential: [{{type: harmonic, order: 1, sine: {self.weight!r} N*m}}]
brake: {{torque: 1 N*m, delay: {self.delay!r} s, rise: {self.rise!r} s}}
"""

    def motor(self, w: float) -> float:
        """Torque of the motor at a speed of the main shaft."""
        return self.starting * (1 - self.ratio * w / self.free)

    def moved(self, begin: tuple[float, float], times: FloatArray, phase: str) -> FloatArray:
        """Speeds at some times. In a run-up the power goes through the gear from the motor, else from the rotor."""
        up = phase == "run_up"

        def rates(t: float, y: list[float]) -> list[float]:
            phi, w = y
            inertia, slope = self.mean + self.swing * math.cos(2 * phi), -2 * self.swing * math.sin(2 * phi)
            inertia += self.efficiency * self.ratio**2 * self.rotor
            resist = self.friction + self.viscous * w + self.weight * math.sin(phi) + slope * w * w / 2
            if phase == "brake":
                resist += self.brake * min(max((t - self.delay) / self.rise, 0.0), 1.0)
            return [w, ((self.efficiency * self.ratio * self.motor(w) if up else 0.0) - resist) / inertia]

        found = solve_ivp(
            rates, (0.0, float(times[-1])), list(begin), t_eval=times, method="DOP853", rtol=1e-11, atol=1e-12,
            max_step=0.02,
        )  # fmt: skip
        assert found.success
        return np.asarray(found.y[1])


def drawn(rng: np.random.Generator) -> Maker:
    """One of many such machines."""
    return Maker(
        mean=float(rng.uniform(20, 60)),
        swing=float(rng.uniform(0, 8)),
        rotor=float(rng.choice([0.0, 0.03])),
        starting=float(rng.uniform(30, 80)),
        friction=float(rng.uniform(10, 60)),
        viscous=float(rng.uniform(1, 6)),
        weight=float(rng.uniform(-20, 20)),
        brake=float(rng.uniform(150, 600)),
    )


def recorded(path: Path, times: FloatArray, speeds: FloatArray, head: str = "time,speed") -> Path:
    rows = "".join(f"{t!r},{w!r}\n" for t, w in zip(times.tolist(), speeds.tolist(), strict=True))
    path.write_text(f"{head}\n{rows}", "utf-8")
    return path


def decoded(spec: Path, record: Path, phase: str, *more: str) -> dict[str, Any]:
    done = ptmcalc("decode", spec, record, "--phase", phase, *more, "--format", "json")
    assert (done.status, done.err) == (0, "")
    found: dict[str, Any] = json.loads(done.out)
    return found


def value(found: dict[str, Any], name: str) -> tuple[float, float]:
    one = next(one for one in found["values"] if one["name"] == name)
    return one["value"], one["uncertainty"]


NOISE = {"run_up": 2e-3, "run_out": 3e-4, "brake": 2e-3}  # of the speed at the beginning or the end
START = 0.7  # rad


def record_of(
    maker: Maker, phase: str, rng: np.random.Generator, noise: float | None = None
) -> tuple[FloatArray, FloatArray]:
    """Times and speeds with noise of a machine that runs up from rest, coasts or is braked from 11 rad/s."""
    fastest = 11.0
    begin = (START, 0.0 if phase == "run_up" else fastest)
    lasting = {
        "run_up": 1.5 * maker.mean * fastest / (maker.ratio * maker.starting),
        "run_out": 0.8 * maker.mean * fastest / (maker.friction + maker.viscous * fastest),
        "brake": maker.delay + maker.rise + 0.7 * maker.mean * fastest / (maker.brake + maker.friction + 30),
    }[phase]
    times = np.linspace(0.0, lasting, 600)
    speeds = maker.moved(begin, times, phase)
    assert np.all(np.diff(speeds[:3]) != 0)
    size = NOISE[phase] if noise is None else noise
    return times, speeds + size * fastest * rng.normal(size=len(times))


SAMPLE = 16
SEED = 20261123
Case = tuple[Maker, dict[str, Any]]


@pytest.fixture(scope="module")
def sample(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], list[Case]]:
    folder, known = tmp_path_factory.mktemp("records"), dict[str, list[Case]]()

    def cases(phase: str) -> list[Case]:
        if phase not in known:
            rng, known[phase] = np.random.default_rng(SEED), []
            for index in range(SAMPLE):
                maker = drawn(rng)
                spec = folder / f"{phase}{index}.yaml"
                spec.write_text(maker.yaml(), "utf-8")
                record = recorded(folder / f"{phase}{index}.csv", *record_of(maker, phase, rng))
                known[phase].append((maker, decoded(spec, record, phase, "--from", f"{START} rad")))
        return known[phase]

    return cases


def covered(pairs: list[tuple[float, float, float]]) -> tuple[float, float]:
    """Shares of (truth, value, uncertainty) whose interval, and a third of it, hold the truth."""
    off = np.array([abs(found - truth) / bar for truth, found, bar in pairs])
    return float(np.mean(off <= 1)), float(np.mean(off <= 1 / 3))


def test_the_losses_of_a_run_out(sample: Callable[[str], list[Case]]) -> None:
    cases = sample("run_out")
    for name in ("friction", "viscous"):
        pairs = [(getattr(maker, name), *value(found, name)) for maker, found in cases]
        within, third = covered(pairs)
        assert within >= 0.9, (name, pairs)
        assert third < 0.8, "an uncertainty a third as large would not do"
    assert np.median([value(found, "friction")[1] / maker.friction for maker, found in cases]) < 0.2


def test_the_torque_of_a_brake(sample: Callable[[str], list[Case]]) -> None:
    cases = sample("brake")
    pairs = [(maker.brake, *value(found, "brake")) for maker, found in cases]
    within, third = covered(pairs)
    assert within >= 0.9, pairs
    assert third < 0.8
    assert np.median([bar / truth for truth, _, bar in pairs]) < 0.05


def test_the_curve_of_a_motor(sample: Callable[[str], list[Case]]) -> None:
    cases = sample("run_up")
    pairs = []
    for maker, found in cases:
        assert found["shaft"] == "motor"
        pairs += [(maker.motor(row["speed"] / maker.ratio), row["torque"], row["uncertainty"]) for row in found["rows"]]
    within, third = covered(pairs)
    assert within >= 0.9
    assert third < 0.8
    first = [(maker.starting, *value(found, "torque_first")) for maker, found in cases]
    assert covered(first)[0] >= 0.85
    assert np.median([bar / truth for truth, _, bar in first]) < 0.3


def test_the_noise_is_that_of_the_record(sample: Callable[[str], list[Case]]) -> None:
    for phase in ("run_up", "run_out", "brake"):
        found = [one["noise"] for _, one in sample(phase)]
        assert found == pytest.approx([NOISE[phase] * 11.0] * SAMPLE, rel=0.3)


@pytest.fixture
def spec(tmp_path: Path) -> Path:
    path = tmp_path / "shaft.yaml"
    path.write_text(Maker().yaml(), "utf-8")
    return path


def test_without_noise_the_torque_is_that_of_the_machine(spec: Path, tmp_path: Path) -> None:
    rng, maker = np.random.default_rng(1), Maker()
    times, speeds = record_of(maker, "run_out", rng, noise=0.0)
    found = decoded(spec, recorded(tmp_path / "r.csv", times, speeds), "run_out", "--from", f"{START} rad")
    assert value(found, "friction")[0] == pytest.approx(maker.friction, rel=1e-3)
    assert value(found, "viscous")[0] == pytest.approx(maker.viscous, rel=5e-3)


def test_less_noise_is_less_uncertainty(spec: Path, tmp_path: Path) -> None:
    bars = []
    for noise in (4e-3, 4e-4):
        times, speeds = record_of(Maker(), "run_out", np.random.default_rng(5), noise=noise)
        found = decoded(spec, recorded(tmp_path / "r.csv", times, speeds), "run_out", "--from", f"{START} rad")
        bars.append(value(found, "friction")[1])
    assert bars[1] < 0.4 * bars[0]


def test_units_of_the_heads_are_read(spec: Path, tmp_path: Path) -> None:
    """Milliseconds and revolutions per minute, in the other order, behind a comment, beside a column of no use."""
    times, speeds = record_of(Maker(), "run_out", np.random.default_rng(2))
    plain = decoded(spec, recorded(tmp_path / "a.csv", times, speeds), "run_out")
    rows = "".join(
        f"{w * 30 / math.pi!r};x;{1e3 * t!r}\n" for t, w in zip(times.tolist(), speeds.tolist(), strict=True)
    )
    (tmp_path / "b.csv").write_text(f"# a test\n\nspeed [rpm];note;time [ms]\n{rows}", "utf-8")
    other = decoded(spec, tmp_path / "b.csv", "run_out")
    for name in ("friction", "viscous"):
        assert value(other, name) == pytest.approx(value(plain, name), rel=1e-6)


def test_the_angle_at_the_beginning_counts(spec: Path, tmp_path: Path) -> None:
    times, speeds = record_of(Maker(), "run_out", np.random.default_rng(3), noise=0.0)
    record = recorded(tmp_path / "r.csv", times, speeds)
    right, wrong = (decoded(spec, record, "run_out", "--from", angle) for angle in (f"{START} rad", "130 deg"))
    assert abs(value(right, "friction")[0] - 40) < 0.1 < abs(value(wrong, "friction")[0] - 40)


def test_the_length_of_the_stretches_can_be_chosen(spec: Path, tmp_path: Path) -> None:
    times, speeds = record_of(Maker(), "run_out", np.random.default_rng(4))
    found = decoded(spec, recorded(tmp_path / "r.csv", times, speeds), "run_out", "--window", "250 ms")
    assert found["window"] == pytest.approx(0.25, abs=2 * (times[1] - times[0]))


def test_the_table_says_the_same(spec: Path, tmp_path: Path) -> None:
    times, speeds = record_of(Maker(), "brake", np.random.default_rng(6))
    record = recorded(tmp_path / "r.csv", times, speeds)
    done = ptmcalc("decode", spec, record, "--phase", "brake", "--from", f"{START} rad")
    assert (done.status, done.err) == (0, "")
    assert re.search(r"full torque of the brake: (30[0-9]|29[0-9])[.0-9]* N\*m ± [.0-9]+ N\*m", done.out)
    assert "torque, main shaft" in done.out
    assert "noise of a sample" in done.out
    assert len(done.out.splitlines()) > 25


# --- faults ----------------------------------------------------------------------------------------------------------

ROWS = "".join(f"{0.01 * k:.2f},{11 - 0.03 * k:.2f}\n" for k in range(60))


def faulty(spec: Path, tmp_path: Path, content: bytes, phase: str = "run_out") -> Done:
    path = tmp_path / "record.csv"
    path.write_bytes(content)
    return ptmcalc("decode", spec, path, "--phase", phase)


@pytest.mark.parametrize(
    ("content", "line", "said"),
    [
        (b"", 0, "the record is empty"),
        (b"\n \n# only a comment\n", 0, "the record is empty"),
        (b"time,speed\n", 0, "the record has 0 samples"),
        (b"time,speed\n0,1\n1,2\n2,3\n", 0, "the record has 3 samples"),
        (b"time,speed\n0,11\n1,\xff\n", 3, "the text is not UTF-8"),
        (ROWS.encode(), 1, "there is no column `time`"),
        (b"zeit,speed\n0,11\n", 1, "there is no column `time` among `zeit`, `speed`"),
        (b"time,tempo\n0,11\n", 1, "there is no column `speed`"),
        (b"time [min],speed [mm/s]\n0,11\n", 1, "`mm/s` is no unit of a rotational speed"),
        (b"time [parsec],speed\n0,11\n", 1, "parsec"),
        (b"time,speed\n0,11\n0.1,nan\n", 3, "not a finite number"),
        (b"time,speed\n0,11\n0.1,inf\n", 3, "not a finite number"),
        (b"time,speed\n0,11\n0.1,\n", 3, "`speed` is empty"),
        (b"time,speed\n0,11\n0.1,fast\n", 3, "`speed` is `fast`, not a number"),
        (b"time,speed\n0,11\n0.1\n", 3, "1 values under 2 columns"),
        (b"time;speed\n0;11\n0,1;10,5\n", 3, "not a number"),
        (b"time,speed\n0,11\n0.2,10\n0.1,9\n", 4, "`time` is 0.1, not later than 0.2 in the line before"),
        (b"time,speed\n0,11\n\n0.2,10\n# twice\n0.2,9\n", 6, "`time` is 0.2, not later than 0.2"),
        (b'time,speed\n0,"11\n', 2, "cannot be split"),
        (b"\x00\x01\x02\x00", 1, "there is no column `time`"),
    ],
)
def test_a_faulty_record_is_one_message(spec: Path, tmp_path: Path, content: bytes, line: int, said: str) -> None:
    done = faulty(spec, tmp_path, content)
    assert (done.status, done.out) == (2, "")
    assert done.err.startswith("ptmcalc: ")
    assert said in done.err
    assert "Traceback" not in done.err
    assert done.err.count("\n") == 1
    if line:
        assert f"record.csv:{line}: " in done.err


@pytest.mark.parametrize("name", ["absent.csv", "."])
def test_a_record_that_cannot_be_read(spec: Path, tmp_path: Path, name: str) -> None:
    done = ptmcalc("decode", spec, tmp_path / name, "--phase", "run_out")
    assert (done.status, done.out) == (2, "")
    assert "the record cannot be read" in done.err
    assert done.err.count("\n") == 1


def test_a_record_that_ends_before_the_brake(spec: Path, tmp_path: Path) -> None:
    done = faulty(spec, tmp_path, b"time,speed\n" + b"".join(b"%.3f,11\n" % (0.001 * k) for k in range(200)), "brake")
    assert (done.status, done.out) == (2, "")
    assert "before the brake is on" in done.err


def test_a_record_too_short_for_its_losses(spec: Path, tmp_path: Path) -> None:
    done = faulty(spec, tmp_path, b"time,speed\n" + b"".join(b"%.2f,%.1f\n" % (0.01 * k, 30 + 0.5 * (-1) ** k) for k in range(11)))
    assert (done.status, done.out) == (2, "")
    assert "too short" in done.err


@pytest.mark.parametrize(
    "content",
    [
        "".join(f"{k},0\n" for k in range(40)),
        "".join(f"{k},7\n" for k in range(40)),
        "".join(f"{k},{-7 - k}\n" for k in range(40)),
        "".join(f"{1e-9 * k},{1e9 - k}\n" for k in range(40)),
        "".join(f"{1e9 + 1e-3 * k!r},{5 - 0.1 * k}\n" for k in range(40)),
        "".join(f"{k},{(-1) ** k * 1e150}\n" for k in range(40)),
        "".join(f"{1e200 * k},{k}\n" for k in range(40)),
        "".join(f"{k * 10.0 ** (k % 3)},{5 - 0.1 * k}\n" for k in range(1))
        + "".join(f"{3.0**k},{k}\n" for k in range(40)),
    ],
    ids=["rest", "even", "backward", "fast", "late", "huge", "slow", "uneven"],
)
@pytest.mark.parametrize("phase", ["run_up", "run_out", "brake"])
def test_a_strange_record_ends_in_numbers_or_in_a_message(spec: Path, tmp_path: Path, content: str, phase: str) -> None:
    path = tmp_path / "record.csv"
    path.write_text("time,speed\n" + content, "utf-8")
    done = ptmcalc("decode", spec, path, "--phase", phase, "--format", "json")
    if done.status == 2:
        assert done.out == ""
        assert done.err.startswith("ptmcalc: ")
        assert done.err.count("\n") == 1
        return
    assert (done.status, done.err) == (0, "")
    found = json.loads(done.out)
    numbers = [one[key] for one in found["values"] for key in ("value", "uncertainty")]
    numbers += [row[key] for row in found["rows"] for key in ("time", "speed", "torque", "uncertainty")]
    assert all(isinstance(one, float) and math.isfinite(one) for one in numbers), numbers


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--phase", "run_out", "--from", "7"), "`--from`"),
        (("--phase", "run_out", "--from", "7 m"), "`--from`"),
        (("--phase", "run_out", "--window", "long"), "`--window`"),
        (("--phase", "run_out", "--window", "3 rad"), "`--window`"),
        (("--phase", "run_out", "--window", "-1 s"), "`--window`"),
        (("--phase", "coast"), "coast"),
        ((), "--phase"),
        (("--phase", "run_out", "--format", "xml"), "xml"),
    ],
)
def test_options_that_are_wrong(spec: Path, tmp_path: Path, arguments: tuple[str, ...], said: str) -> None:
    record = recorded(tmp_path / "r.csv", np.linspace(0, 1, 60), np.linspace(11, 9, 60))
    done = ptmcalc("decode", spec, record, *arguments)
    assert (done.status, done.out) == (2, "")
    assert said in unpainted(done.err)
    assert "Traceback" not in done.err


def test_a_file_of_another_kind(tmp_path: Path) -> None:
    record = recorded(tmp_path / "r.csv", np.linspace(0, 1, 60), np.linspace(11, 9, 60))
    done = ptmcalc("decode", Path(__file__).parent / "specs" / "passing.yaml", record, "--phase", "run_out")
    assert (done.status, done.out) == (2, "")
    assert "describes no shaft" in done.err


def test_a_faulty_design_file_is_explained(tmp_path: Path) -> None:
    record = recorded(tmp_path / "r.csv", np.linspace(0, 1, 60), np.linspace(11, 9, 60))
    spec = tmp_path / "shaft.yaml"
    spec.write_text(Maker().yaml().replace("mean:", "mena:"), "utf-8")
    done = ptmcalc("decode", spec, record, "--phase", "run_out")
    assert (done.status, done.out) == (2, "")
    assert "SPC104" in done.err
