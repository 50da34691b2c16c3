"""Seconds that are predicted for a drive train: by what rings and for how long, not by the stiffest link alone."""

import math

import pytest
import yaml
from support.machines import changed, report_of

from ptmcalc.base.errors import NumericsError
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import load_text
from ptmcalc.machines.drivetrain.machine.model import case_of, rigid
from ptmcalc.machines.drivetrain.machine.spec import Drivetrain
from ptmcalc.machines.drivetrain.motion import bounds, simulation
from ptmcalc.numerics.train.modes import damped
from ptmcalc.numerics.train.parts import Body, Spring, Train

DATA = {
    "kind": "drivetrain",
    "inertias": {"motor": {"inertia": "1 kg*m^2"}, "load": {"inertia": "3 kg*m^2"}},
    "links": {
        "gear": {"between": ["motor", "load"], "stiffness": "1e12 N*m/rad", "limit": "50 N*m"},
        "rope": {"between": ["load", "ground"], "stiffness": "4 N*m/rad", "limit": "20 N*m"},
    },
    "torques": {"motor": {"at": "motor", "type": "constant", "torque": "8 N*m"}},
    "scenes": [{"type": "run", "duration": "20 s"}],
}


@pytest.mark.parametrize("ratio", [1e-4, 1e-2, 0.3])
def test_each_vibration_fades_by_the_damping_of_its_own_links(ratio: float) -> None:
    """Two inertias on the ground, far apart in frequency: 2 zeta w of the gear alone, and nothing of the rope."""
    damping = 2 * ratio * math.sqrt(1e10 / (1 + 1 / 3))
    train = Train(
        (Body("motor", 1.0), Body("load", 3.0)),
        springs=(Spring("gear", 0, 1, 1e10, damping), Spring("r", 1, None, 4.0)),
    )
    values, fading = damped(train)
    assert values == pytest.approx([1.0, math.sqrt(1e10 * 4 / 3)], rel=1e-6)
    assert fading[1] == pytest.approx(damping / 2 * (1 + 1 / 3), rel=1e-6)
    assert fading[0] <= 1e-12 * fading[1]


@pytest.mark.parametrize("damping", ["0 N*m*s/rad", "1 MN*m*s/rad"])
def test_a_stiff_gear_beside_a_soft_rope_is_cheap(damping: str) -> None:
    (scene,) = report_of(changed(DATA, links__gear__damping=damping)).scenes
    run = next(one for one in scene.solvers if one.name == "elastic")
    assert run.predicted_seconds < 0.2
    assert run.work < 2000


def test_what_swings_alone_is_followed_and_said_to_be_dear() -> None:
    """1e6 rad/s against the ground and nothing slower: 20 million radians. Neither plan nor formula follows them."""
    stiff = changed(
        DATA,
        inertias={"load": {"inertia": "1 kg*m^2"}},
        links={"rope": {"between": ["load", "ground"], "stiffness": "1e12 N*m/rad", "gap": "1 mrad", "limit": "9 N*m"}},
        torques={"motor": {"at": "load", "type": "constant", "torque": "8 N*m"}},
    )
    report = report_of(stiff)
    assert {d.code for d in report.diagnostics} == {"NUM103"}
    (scene,) = report.scenes
    assert sum(one.work for one in scene.solvers) < 2000


def test_it_becomes_cheap_once_it_fades() -> None:
    rope = {**DATA["links"]["rope"], "stiffness": "1e10 N*m/rad", "damping": "1e5 N*m*s/rad"}
    push = {"at": "load", "type": "constant", "torque": "8 N*m"}
    alone = changed(DATA, inertias={"load": {"inertia": "1 kg*m^2"}}, links={"rope": rope}, torques={"push": push})
    spec = Drivetrain.model_validate(alone)
    case = case_of(spec, spec.all_scenes[0])
    assert simulation.seconds(case, 20.0) < 0.1  # 25 decay times of 2e-5 s at 1e5 rad/s: 50 rad
    assert simulation.seconds(rigid(case), 20.0) == simulation.seconds(case, 20.0)
    assert bounds.largest_share(spec, spec.all_scenes[0]) >= 0


def test_a_rigid_train_that_cannot_be_run_bounds_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    """The plan asks for it too: there it must not end in a traceback."""

    def broken(*_: object, **__: object) -> None:
        raise NumericsError("NUM101", "a nonlinear torque could not be resolved by any step")

    spec = Drivetrain.model_validate(changed(DATA, links__gear__gap="1 mrad", scenes=[{"type": "start"}]))
    scene = spec.all_scenes[0]
    monkeypatch.setattr(simulation, "run", broken)
    assert math.isfinite(simulation.window(scene, case_of(spec, scene)))
    assert bounds.largest_backlash(spec, scene) == math.inf


def test_a_run_that_takes_many_times_what_was_predicted_is_given_up() -> None:
    """Its limit is on what it does, not on how closely peaks are looked for."""
    spec = Drivetrain.model_validate(DATA)
    case = case_of(spec, spec.all_scenes[0])
    with pytest.raises(NumericsError, match=r"more than 1e\+02 steps .* given up"):
        simulation.run(case, 20.0, 1e-6, most_work=100.0)
    free, bound = (
        simulation.run(case, 20.0, 1e-6, most_work=most) for most in (math.inf, simulation.most_work(case, 20.0))
    )
    assert free.record.most_looks == bound.record.most_looks
    assert free.record.top.values.tolist() == bound.record.top.values.tolist()
    assert simulation.most_work(case, 20.0) > 30 * bound.record.work


def test_what_is_only_shown_beside_the_loads_is_not_run_beyond_the_budget() -> None:
    loaded = load_text(yaml.safe_dump(DATA).encode(), "train.yaml")
    for budget, shown in ((1.0, True), (1e-4, False)):
        report = check(loaded, Options(budget=budget, repairs=False))
        assert any(not one.decides for one in report.scenes[0].solvers) is shown
        assert any(one.code == "NUM103" for one in report.diagnostics) is not shown
