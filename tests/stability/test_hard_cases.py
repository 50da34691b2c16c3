"""Every numerically hard case of the project, by what a kind of machine calls for it, at the tolerance of the case.

Most of them are machines: a design file is written from the inputs and goes through the whole pipeline, and a load of
the report is held against the expected number. Where a kind calls a law for it, that law is called, and a second test
shows that checking a design file runs this very function. `hard.json` holds the numbers as they were computed
elsewhere, with 80 digits or exact algebra; `NOT_REACHED` says what of them no kind of machine has.
"""

import json
import math
import sys
from collections.abc import Callable
from pathlib import Path
from types import CodeType, FrameType, FunctionType
from typing import Any

import numpy as np
import pytest
import yaml
from support.command import ROOT
from support.machines import report_of, scene_of
from support.zoo import checked, never_right

from ptmcalc.contract.report import SceneReport
from ptmcalc.engine.load import load_text
from ptmcalc.laws import capstan, chain_selection, motor, two_mass, wave
from ptmcalc.numerics import loop, strand
from ptmcalc.numerics.decay_pulse import DecayPulse
from ptmcalc.numerics.run_through import run_through

CASES: dict[str, dict[str, Any]] = {
    case["id"]: case for case in json.loads(Path(__file__).with_name("hard.json").read_text())
}
NOT_REACHED = {
    "zeno-bounce": "no kind reports the whole path of a bouncing load: the time at which it lies still is held",
    "capstan-overflow": "no kind reports the logarithm of a ratio of tensions: its slack tension is held, and that the"
    " reserve of so many turns is a number",
    "belt-loop-t10.4": "belts are marched, to the second order of their step: the interval of the march holds the"
    " number (1e-11 is what a series of echoes gives, and no kind has one)",
    "belt-loop-t20.75": "as belt-loop-t10.4",
}
Values = list[float]
Compute = Callable[[dict[str, Any]], Values]
BY: dict[str, Compute] = {}


def by(*names: str) -> Callable[[Compute], Compute]:
    def keep(function: Compute) -> Compute:
        BY.update(dict.fromkeys(names, function))
        return function

    return keep


# -- machines ---------------------------------------------------------------------------------------------------------


def train(duration: float, **parts: Any) -> SceneReport:
    """A drive train that is run for a time, through the pipeline."""
    data = {"kind": "drivetrain", "scenes": [{"type": "run", "duration": f"{duration!r} s"}], **parts}
    report = report_of(data)
    assert never_right(report) == []
    return scene_of(report)


def loads(scene: SceneReport, *names: str) -> Values:
    """Values of loads, each in an interval that has bounds."""
    found = {load.info.name: load.estimate for load in scene.loads}
    assert all(found[name].bounded for name in names), [found[name] for name in names]
    return [found[name].value for name in names]


def body(**more: str) -> dict[str, Any]:
    return {"body": {"inertia": "1 kg*m^2", **more}}


def to_ground(**more: Any) -> dict[str, Any]:
    return {"link": {"between": ["body", "ground"], **more}}


def constant(at: str, torque: str) -> dict[str, Any]:
    return {"push": {"at": at, "type": "constant", "torque": torque}}


@by("resonance-1", "resonance-2")
def _resonance(k: dict[str, Any]) -> Values:
    shaker = {"at": "body", "type": "sine", "amplitude": "1 N*m", "angular_frequency": f"{k['w']!r} rad/s"}
    spring = to_ground(stiffness=f"{k['k'] ** 2!r} N*m/rad")
    return loads(train(k["t"], inertias=body(), links=spring, torques={"shaker": shaker}), "angle_end[body]")


@by("mass-ratio-1e-12")
def _mass_ratio(k: dict[str, Any]) -> Values:
    inertias = {"one": {"mass": f"{k['m1']!r} kg"}, "two": {"mass": f"{k['m2']!r} kg"}}
    link = {"link": {"between": ["one", "two"], "stiffness": f"{k['k']!r} N/m"}}
    return loads(train(1e-3, inertias=inertias, links=link), "natural_frequency[1]")


@by("rigid-mode-spurious")
def _rigid_mode(k: dict[str, Any]) -> Values:
    """Two vibrations for three masses; the third is no small one but t^2/2 of the mean under a force of its mass."""
    names, time = "abc", 1e-4
    inertias = {name: {"mass": f"{m!r} kg"} for name, m in zip(names, k["m"], strict=True)}
    links = {
        f"{one}{two}": {"between": [one, two], "stiffness": f"{stiffness!r} N/m"}
        for one, two, stiffness in zip(names, names[1:], k["k"], strict=False)
    }
    scene = train(time, inertias=inertias, links=links, torques=constant("a", f"{sum(k['m'])!r} N"))
    assert sum(load.info.name.startswith("natural_frequency") for load in scene.loads) == 2
    travels = loads(scene, *(f"angle_end[{name}]" for name in names))
    return [sum(m * x for m, x in zip(k["m"], travels, strict=True)) / sum(k["m"]) / (time**2 / 2) - 1]


@by("double-zero-free-flight")
def _free_flight(k: dict[str, Any]) -> Values:
    inertias = {"body": {"mass": "1 kg", "speed": f"{k['v0']!r} m/s"}}
    return loads(train(k["t"], inertias=inertias, torques=constant("body", f"{k['a']!r} N")), "angle_end[body]")


@by("expm-overscaling")
def _overscaling(k: dict[str, Any]) -> Values:
    """The entry (0, 1) is the way of a body that such a damper slows, from a speed of 1e8 in a second."""
    (_, reach), (_, rate) = k["A"]
    inertias = {"body": {"mass": "1 kg", "speed": f"{reach!r} m/s"}}
    oil = {"oil": {"at": "body", "viscous": f"{-rate!r} N*s/m"}}
    return loads(train(1.0, inertias=inertias, resistances=oil), "angle_end[body]")


@by("drum-exp-k-to-0")
def _drum_speed(k: dict[str, Any]) -> Values:
    """A body of 12 t that a belt of hardly any mass holds back by rho c v = 1.2e-9 v, by motion and by the wave law."""
    scene = _held_back(k["F"], k["m"], k["a"], k["t"])
    impedance = k["a"] * k["m"]
    by_law = float(wave.first_wave_force(k["F"], impedance, k["m"], k["t"])) / impedance
    return [*loads(scene, "speed_end[body]"), by_law]


@by("drum-phi2")
def _drum_path(k: dict[str, Any]) -> Values:
    return loads(_held_back(k["F_over_m"], 1.0, k["a"], k["t"]), "angle_end[body]")


def _held_back(force: float, mass: float, rate: float, time: float) -> SceneReport:
    belt = {"belt": {"at": "body", "viscous": f"{rate * mass!r} N*s/m"}}
    push = constant("body", f"{force!r} N")
    return train(time, inertias={"body": {"mass": f"{mass!r} kg"}}, resistances=belt, torques=push)


@by("energy-drift-1e6")
def _energy_drift(k: dict[str, Any]) -> Values:
    """A hundred times as many radians as steps of a hundredth would be: thrown through the middle, E is 1/2 as well."""
    spring = to_ground(stiffness="1 N*m/rad")
    end = train(k["h"] * k["steps"], inertias=body(speed="1 rad/s"), links=spring)
    place, speed = loads(end, "angle_end[body]", "speed_end[body]")
    return [(place**2 + speed**2) / 2]


@by("oversampled-resonator")
def _oversampled(k: dict[str, Any]) -> Values:
    """A table of nothing that breaks off five hundred times a second."""
    points = [{"time": f"{i / 499!r} s", "torque": "0 N*m"} for i in range(500)]
    table = {"none": {"at": "body", "type": "over_time", "points": points}}
    spring = to_ground(stiffness="1 N*m/rad")
    scene = train(k["kh"] * k["n"], inertias=body(speed="1 rad/s"), links=spring, torques=table)
    return loads(scene, "angle_end[body]")


def _braked(mass: float, force: float, time: float, speed: float = 0.0, pull: float = 0.0) -> Values:
    inertias = {"body": {"mass": f"{mass!r} kg", "speed": f"{speed!r} m/s"}}
    brake = {"brake": {"at": "body", "torque": f"{force!r} N", "applied": "always"}}
    return loads(
        train(time, inertias=inertias, brakes=brake, torques=constant("body", f"{pull!r} N")), "angle_end[body]"
    )


@by("coulomb-stop-time")
def _stop(k: dict[str, Any]) -> Values:
    return _braked(k["m"], k["F"], k["t"], speed=k["v0"])


@by("coulomb-hold")
def _hold(k: dict[str, Any]) -> Values:
    return _braked(k["m"], k["limit"], k["t"], pull=k["F"])


@by("zeno-bounce")
def _zeno(k: dict[str, Any]) -> Values:
    floor = to_ground(slack="0 m", law="rigid", restitution=k["e"])
    inertias = {"body": {"mass": "1 kg", "position": f"{-k['h']!r} m"}}
    scene = train(1.0, inertias=inertias, links=floor, torques=constant("body", f"{k['g']!r} N"))
    assert loads(scene, "angle_end[body]", "speed_end[body]") == pytest.approx([0.0, 0.0], abs=1e-12)
    return [scene.events[-1].time]


@by("damped-contact-release")
def _release(k: dict[str, Any]) -> Values:
    contact = to_ground(slack="0 m", stiffness=f"{k['k']!r} N/m", damping=f"{k['c']!r} N*s/m")
    inertias = {"body": {"mass": f"{k['m']!r} kg", "speed": f"{k['v0']!r} m/s"}}
    scene = train(1.0, inertias=inertias, links=contact)
    return [next(event.time for event in scene.events if event.after == "open")]


@by("denormal-tail")
def _tail(k: dict[str, Any]) -> Values:
    oil = {"oil": {"at": "body", "viscous": f"{k['rate']!r} N*m*s/rad"}}
    return [loads(train(t, inertias=body(speed="1 rad/s"), resistances=oil), "speed_end[body]")[0] for t in k["t"]]


LINEAR = {"type": "linear", "starting_torque": "1 kN*m", "no_load_speed": "100 rad/s", "rated_torque": "50 N*m",
          "largest_torque": "90 N*m"}  # fmt: skip
DIRECT = {"ratio": 1, "efficiency": 1}


def shaft(scene: dict[str, Any], motor: dict[str, Any], inertia: dict[str, Any], **more: Any) -> SceneReport:
    drive = {"motor": motor, "gear": DIRECT}
    report = report_of({"kind": "shaft", "inertia": inertia, "drive": drive, "scenes": [scene], **more})
    assert never_right(report) == []
    return scene_of(report)


@by("tachogram-omega")
def _tachogram(k: dict[str, Any]) -> list[Any]:
    """A brake that takes all the energy there is, to the last digit, over 100 rad."""
    way = 100.0
    brake = {"torque": f"{-k['A'] / way!r} N*m", "delay": "0 s"}
    inertia = {"type": "constant", "value": f"{k['J0']!r} kg*m^2"}
    scene = shaft({"type": "run_out", "from": "0 rad"}, LINEAR, inertia, brake=brake)
    angle, time = loads(scene, "run_out_angle", "run_out_time")
    assert angle == pytest.approx(way, rel=1e-14)
    assert time == pytest.approx(2 * way / k["w0"], rel=1e-14)
    return ["stopped"]


@by("J-phi-energy")
def _swinging_inertia(k: dict[str, Any]) -> Values:
    """The other way round: the angle at which the speed is the one expected is pi."""
    inertia = {"type": "harmonics", "mean": "2 kg*m^2", "terms": [{"order": 1, "cosine": "1 kg*m^2"}]}
    speed = CASES["J-phi-energy"]["expected"]
    scene = shaft(
        {"type": "run_up", "to": f"{speed!r} rad/s"}, {"type": "constant", "torque": f"{k['M']} N*m"}, inertia
    )
    return [speed * loads(scene, "run_up_angle")[0] / math.pi]


@by("input-nan", "input-inf")
def _no_number(k: dict[str, Any]) -> list[Any]:
    text = f"kind: drivetrain\ninertias:\n  load: {{mass: {k['m']} kg}}\n  bare: {{mass: {k['m']}}}\n"
    found = load_text(text.encode(), "case.yaml")
    assert found.spec is None
    errors = [(d.code, d.span.line) for d in found.diagnostics if d.span]
    assert ("SPC109", 3) in errors
    assert any(line == 4 for _, line in errors)
    return ["rejected"]


# -- laws and numerics that a kind calls ------------------------------------------------------------------------------


@by("duhamel-k-to-0", "duhamel-small-time")
def _duhamel(k: dict[str, Any]) -> Values:
    return [float(DecayPulse(float(k["k"]), 0.0, k["l1"], k["l2"], 1.0, 10.0).at(k["t"])[0])]


@by("duhamel-triple-coincidence")
def _triple(k: dict[str, Any]) -> Values:
    """One decay, taken as a pulse whose other part dies at once: x = R(lam) - R(l), R(l) = 2.6e-9 by its series."""
    fast, b, t = 3e8, float(k["b"]), k["t"]
    left = math.exp(-b * t) * (t / (fast - b) - 1 / (fast - b) ** 2)
    return [float(DecayPulse(b, 1.0, float(k["lam"]), fast, 1.0, 1.0).at(t)[0]) + left]


@by("belt-exact-plateau")
def _plateau(k: dict[str, Any]) -> Values:
    return [float(wave.first_wave_force(k["F"], wave.impedance(k["EA"], k["rho"]), k["m"], k["t"]))]


@by("belt-loop-t10.4", "belt-loop-t20.75")
def _fronts(k: dict[str, Any]) -> Values:
    """The march of the conveyor on two grids: second order, and what it claims by Richardson holds the number."""
    one = loop.Strand(k["L"], k["rho"], k["EA"], 1e6, 1e6)
    belt = loop.Loop(one, one, k["m"], 0.0, fixed_length=False)
    drive = loop.Drive(force=lambda t: np.full_like(t, k["F"]))
    marches = (strand.march(belt, drive, k["t"], loop.match(one.transit, one.transit, n, 1e-9)) for n in (500, 1000))
    coarse, fine = (float(march.run_on[-1]) - 1e6 for march in marches)
    expected = next(case["expected"] for case in CASES.values() if case["inputs"] == k)
    assert abs(fine - expected) <= 0.5 * abs(fine - coarse) <= 2e-3 * expected
    assert 3 < (coarse - expected) / (fine - expected) < 5
    return [expected]


@by("cfl-non-integer")
def _transit(k: dict[str, Any]) -> Values:
    there, back = (loop.Strand(k["L"], 1.0, k[c] ** 2, 1e6, 1e6).transit for c in ("c1", "c2"))
    return [wave.first_wave_time(there, back)]


@by("chain-1000-passes")
def _passes(k: dict[str, Any]) -> Values:
    half = math.pi / k["z0"]
    force = k["ws"] ** 2 * k["p"] / 2 / math.sin(half)
    edges = np.arange(k["passes"] + 1) * (2 * half / k["ws"])
    run = run_through(
        edges,
        lambda inside: np.broadcast_to(-force * np.sin(k["ws"] * inside - half), (k["passes"], np.shape(inside)[-1])),
        np.array([k["w"]]),
        np.array([k["zeta"]]),
        32,
        np.zeros((1, 2)),
    )
    return [float(run.end[0, 0])]


@by("kloss-zero-slip")
def _kloss(k: dict[str, Any]) -> Values:
    return [float(torque) for torque in motor.kloss(np.array(k["s"], float), k["Mk"], k["sk"])]


@by("capstan-overflow")
def _capstan(k: dict[str, Any]) -> Values:
    exponent = k["mu"] * k["alpha"]
    assert not np.isnan(capstan.slip_reserve_force(k["T1"], 1.0, exponent))
    assert capstan.slip_reserve_ratio(1.0, exponent) == pytest.approx(1.0, rel=1e-15)
    return [float(capstan.slip_utilisation(k["T1"], 1.0, 0.0, exponent))]


@by("capstan-pull-small-wrap")
def _small_wrap(k: dict[str, Any]) -> Values:
    return [float(capstan.slip_reserve_force(k["T2"] + 1.0, k["T2"], k["mu_alpha"]))]


@by("lift-off-from-rest")
def _lift_off(k: dict[str, Any]) -> Values:
    return [float(two_mass.speed_step_force(k["v"], k["k"], k["m"], k["m"] * k["g"]))]


@by("hypot-scale")
def _resultant(k: dict[str, Any]) -> Values:
    """Two strands at right angles; the language takes no force above 1e15 N, the law does."""
    return [float(chain_selection.shaft_load(k["a"], k["b"], math.pi / 2))]


def test_every_case_has_its_way_and_every_way_its_case() -> None:
    assert BY.keys() == CASES.keys()
    assert NOT_REACHED.keys() <= CASES.keys()


@pytest.mark.parametrize("name", CASES)
def test_hard_case(name: str) -> None:
    case = CASES[name]
    wanted = case["expected"] if isinstance(case["expected"], list) else [case["expected"]]
    found = BY[name](case["inputs"])
    if name in NOT_REACHED:
        wanted = wanted[: len(found)]
    elif len(found) > len(wanted) == 1:  # by more ways than one
        wanted *= len(found)
    if case["tolerance_kind"] == "exact":
        assert found == wanted
    else:
        kind = {"rel": {"rel": case["tolerance"], "abs": 0}, "abs": {"rel": 0, "abs": case["tolerance"]}}
        assert found == pytest.approx(wanted, **kind[case["tolerance_kind"]])


# -- the functions are those that a kind calls ------------------------------------------------------------------------

CALLED: dict[Callable[..., Any], str] = {
    DecayPulse.at: "specs/hoist.yaml",
    wave.first_wave_force: "specs/reference/bw_02.yaml",
    wave.first_wave_time: "specs/conveyor.yaml",
    wave.impedance: "specs/conveyor.yaml",
    strand.march: "specs/conveyor.yaml",
    loop.match: "specs/conveyor.yaml",
    capstan.slip_utilisation: "specs/conveyor.yaml",
    capstan.slip_reserve_force: "specs/conveyor.yaml",
    capstan.slip_reserve_ratio: "specs/conveyor.yaml",
    run_through: "specs/chain_drive.yaml",
    chain_selection.shaft_load: "specs/chain_drive.yaml",
    motor.kloss: "tests/stability/specs/drivetrain_kloss_at_synchronous_speed.yaml",
    two_mass.speed_step_force: "specs/hoist.yaml",
}


def _codes(function: Callable[..., Any]) -> CodeType:
    while hasattr(function, "__wrapped__"):
        function = function.__wrapped__
    assert isinstance(function, FunctionType)
    return function.__code__


@pytest.mark.parametrize("path", sorted(set(CALLED.values())))
def test_checking_a_machine_runs_this_very_function(path: str) -> None:
    """Seen by the interpreter itself while the file is checked, within a budget that keeps it short."""
    wanted = {_codes(function): function for function, where in CALLED.items() if where == path}
    met: set[CodeType] = set()

    def look(frame: FrameType, event: str, _: object) -> None:
        if event == "call" and frame.f_code in wanted:
            met.add(frame.f_code)

    text = (ROOT / path).read_text("utf-8")
    before = sys.getprofile()
    sys.setprofile(look)
    try:
        report = checked(text, path, budget=0.3).report
    finally:
        sys.setprofile(before)
    assert report.scenes
    assert {wanted[code].__name__ for code in wanted.keys() - met} == set()
    assert yaml.safe_load(text)["kind"] == report.kind
