"""Bars of every solver of a chain's start and stop against the next better one, on seeded machines."""

from collections.abc import Iterator, Mapping

import numpy as np
import pytest
from support.chain_starts import KIND, built, profile, random_chain

from ptmcalc.base.estimate import NOTHING, Estimate
from ptmcalc.contract.effect import AnyEffect
from ptmcalc.contract.solver import AnySolver
from ptmcalc.machines.chain_drive.solvers.rigid_start import RIGID_START
from ptmcalc.machines.chain_drive.solvers.start_waves import ONE_MODE, WAVES
from ptmcalc.machines.chain_drive.solvers.stopping import STOP_WAVES, STOPPED
from ptmcalc.machines.chain_drive.solvers.tooth_passes import START_TEETH
from ptmcalc.machines.chain_drive.spec import ChainDrive, ChainScene

EFFECTS: dict[str, AnyEffect] = {effect.name: effect for effect in KIND.effects}
START_LOADS = ("tension_dynamic_start", "tension_start", "safety_start", "tension_min")
STOP_LOADS = ("safety_start", "tension_min")
_ROUNDING = 1e-9


def loads(
    solver: AnySolver, spec: ChainDrive, scene: ChainScene, level: int, left_out: tuple[str, ...]
) -> dict[str, Estimate]:
    """Loads of a run with the bounds of what it leaves out, as the engine widens them."""
    found = {name: one.estimate for name, one in solver.run(spec, scene, frozenset(), level).loads.items()}
    for name in left_out:
        offsets = EFFECTS[name].bound(spec, scene, found)
        found = {load: estimate.widened(offsets.get(load, NOTHING)) for load, estimate in found.items()}
    return found


def starts(seed: int, count: int, **scene: object) -> Iterator[tuple[ChainDrive, ChainScene]]:
    rng = np.random.default_rng(seed)
    for _ in range(count):
        spec = built(random_chain(rng, **(scene or {"profile": profile(rng)})))
        start = spec.all_scenes[0]
        if WAVES.usable_for(spec, start):
            yield spec, start


def inside(wide: Estimate, better: Estimate) -> bool:
    """Whether a bar leaves the better number possible; both may be off by the better one's own bar."""
    slack = _ROUNDING * (abs(better.value) + 1)
    return wide.low <= better.high + slack and better.low - slack <= wide.high


def share(wide: Estimate, better: Estimate) -> float:
    """Part of a bar that the better number takes at least."""
    off = better.value - wide.value
    room = wide.high - wide.value if off > 0 else wide.value - wide.low
    needed = max(abs(off) - better.bar, 0.0)
    return needed / room if room > 0 and np.isfinite(room) else 0.0


def compared(
    pairs: Iterator[tuple[Mapping[str, Estimate], Mapping[str, Estimate]]], names: tuple[str, ...]
) -> tuple[int, float]:
    """How many bounded loads were compared, and the largest part of a bar that was needed."""
    count, worst = 0, 0.0
    for wide, better in pairs:
        for name in names:
            if name in wide and name in better and wide[name].bounded and better[name].bounded:
                assert inside(wide[name], better[name]), (name, wide[name], better[name])
                worst, count = max(worst, share(wide[name], better[name])), count + 1
    return count, worst


def test_the_rigid_body_holds_the_waves() -> None:
    pairs = (
        (loads(RIGID_START, *machine, 0, ("chain_elasticity",)), loads(WAVES, *machine, 1, ()))
        for machine in starts(2_101, 60)
    )
    count, worst = compared(pairs, START_LOADS)
    assert count >= 120
    assert 1 / 3 < worst <= 1


def test_two_masses_hold_the_waves() -> None:
    pairs = (
        (loads(ONE_MODE, *machine, 0, ("higher_modes",)), loads(WAVES, *machine, 1, ()))
        for machine in starts(2_102, 60)
    )
    count, worst = compared(pairs, START_LOADS)
    assert count >= 90
    assert 1 / 3 < worst <= 1


def test_a_coarser_sum_of_modes_holds_a_finer_one() -> None:
    pairs = [(loads(WAVES, *machine, 0, ()), loads(WAVES, *machine, 1, ())) for machine in starts(2_103, 30)]
    count, worst = compared(iter(pairs), START_LOADS)
    assert count >= 60
    assert worst <= 1
    name = "tension_dynamic_start"
    bars = np.array([(one[name].bar, other[name].bar) for one, other in pairs if one[name].bounded])
    assert np.all(bars[:, 1] <= bars[:, 0] * (1 + 1e-9))
    assert bars[:, 1].sum() < 0.6 * bars[:, 0].sum()


RAMP = {"shape": "ramp", "time": "1.5 s"}


@pytest.mark.parametrize(
    "profile",
    [{}, RAMP, RAMP | {"control": "torque"}, {"shape": "cosine", "time": "2 s", "control": "torque"}],
    ids=["torque step", "ramp of speed", "ramp of torque", "cosine of torque"],
)
def test_waves_hold_the_teeth(profile: dict[str, str]) -> None:
    """Both bars granted: that of the waves with the bound of the teeth, that of the teeth from modes left out."""
    pairs = (
        (loads(WAVES, *machine, 0, ("tooth_passing",)), loads(START_TEETH, *machine, 0, ()))
        for machine in starts(2_104, 12, profile=profile)
    )
    count, worst = compared(pairs, START_LOADS)
    assert count >= 20
    assert 0 < worst <= 1


@pytest.mark.parametrize("kind", ["stop", "coast"])
def test_the_rigid_stop_holds_its_waves(kind: str) -> None:
    def pairs() -> Iterator[tuple[Mapping[str, Estimate], Mapping[str, Estimate]]]:
        rng = np.random.default_rng(2_105)
        for _ in range(40):
            data = random_chain(rng)
            motor = float(data["drive"]["motor"]["mean_starting_torque"].split()[0])
            brake = {
                "torque": f"{motor * float(rng.uniform(0.2, 1.5)):.6g} N*m",
                "delay": "0.1 s",
                "rise_time": "0.2 s",
            }
            spec = built(data | {"brake": brake, "scenes": [{"type": kind}]})
            scene = spec.all_scenes[0]
            if STOP_WAVES.usable_for(spec, scene):
                yield loads(STOPPED, spec, scene, 0, ("chain_elasticity",)), loads(STOP_WAVES, spec, scene, 0, ())

    count, worst = compared(pairs(), STOP_LOADS)
    assert count >= 40
    assert 0.2 < worst <= 1
