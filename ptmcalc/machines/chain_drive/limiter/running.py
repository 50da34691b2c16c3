"""Torque through the limiter in steady running, and the chain in a jam."""

import math

from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import inertia
from ptmcalc.machines.chain_drive.limiter.torque import arms, larger, of_pull
from ptmcalc.machines.chain_drive.limiter.trips import fitted, limiter_of
from ptmcalc.machines.chain_drive.machine.model import chain_line, drive_mass, ends_at_tail, mean_arm
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, Run
from ptmcalc.machines.chain_drive.machine.strength import AT_REST, Answer, safety, through
from ptmcalc.machines.chain_drive.polygon.answers import answer
from ptmcalc.machines.chain_drive.polygon.excitation import FAR, HARMONICS, POLYGON, WEAK
from ptmcalc.machines.chain_drive.starting.motion import sprocket_mass

_CHAIN_SHARE = 2.5
"""Part of the chain in the tension that a rigid jam adds, over Z V [1]. Calibrated on 800 cases of `jam`, whose largest
excess was 2.15; a larger value widens the error bar."""


def run(spec: ChainDrive, scene: Run, carried: frozenset[str], level: int) -> Result:
    """Largest torque that the limiter transmits in steady running.

        M = R |S_on - S_off|,   r cos(pi/z) <= R <= r,   M >= |W_h| z p/(2 pi)

    The tensions include the polygon effect of both ends on a drive of finite mass, as in `distributed_strand`. W_h is
    what this sprocket pulls: W, less the part of a driven tail. The mean torque is a lower bound of the largest one.

    **Range** a sprocket that turns evenly: the inertia torque of an equalising drive is not contained.
    **Error** bounded: harmonics, arms, and the part of the sprocket in the mass of the drive.
    **Source** equilibrium of the sprocket; `numerics.harmonic`.
    """
    line = chain_line(spec, scene)
    on = frozenset(name for name in (POLYGON, FAR, WEAK) if spec.effects.get(name) != "off")
    found = answer(spec, scene, on, HARMONICS[level]) if POLYGON in on else AT_REST
    most, least = _swings(spec, found)
    still, mean = line.head_pull, mean_arm(spec) * abs(line.head_pull)
    leaving = Interval(0.0, line.run_off + _at_run_off(spec, found).high)
    torque = larger(
        of_pull(spec, _of(still, most), leaving),
        of_pull(spec, _of(-still, Estimate(-least.value, -least.high, -least.low, least.numerical)), leaving),
    )
    if math.isfinite(torque.value):
        value = max(torque.value, mean)
        torque = Estimate(value, max(torque.low, mean), max(torque.high, value), torque.numerical, torque.model)
    return Result({"limiter_torque": Found(torque)}, work=HARMONICS[level])


def _of(static: float, swing: Estimate) -> Estimate:
    return Estimate(static + swing.value, static + swing.low, static + swing.high, swing.numerical, swing.model)


def _swings(spec: ChainDrive, found: Answer) -> tuple[Estimate, Estimate]:
    """Largest and smallest part of the polygon effect in the force through the limiter [N].

    The sprocket takes its part of what turns the drive: the force is that of the tensions at most, and by the share of
    the sprocket in the mass of the drive less at least.
    """
    own = sprocket_mass(spec) / drive_mass(spec, inertia.ENERGY)
    off = _at_run_off(spec, found)
    off_least, off_most = off.low, off.high
    largest, smallest = found.largest, found.smallest
    most = Estimate(
        largest.value, (1 - own) * max(largest.low - off_most, 0.0), largest.high - off_least, largest.numerical
    )
    least = Estimate(
        smallest.value, smallest.low - off_most, (1 - own) * min(smallest.high - off_least, 0.0), smallest.numerical
    )
    return _containing(most), _containing(least)


def _at_run_off(spec: ChainDrive, found: Answer) -> Interval:
    """Dynamic tension of the leaving strand [N]."""
    if ends_at_tail(spec):
        return Interval(found.off_smallest.low, found.off_largest.high)
    return Interval(found.far_smallest.low, found.far_largest.high)


def _containing(one: Estimate) -> Estimate:
    return Estimate(min(max(one.value, one.low), one.high), one.low, one.high, one.numerical, one.model)


def jam(spec: ChainDrive, scene: Run, carried: frozenset[str], level: int) -> Result:
    """Tension of the entering chain in a jam that trips the limiter, its safety factor, and the margin of the setting.

        S = S_off + M_max/R,   r cos(pi/z) <= R <= r,   M_max the highest trip torque
        dS <= V (2.5 Z + (Z^2 + (EA/L) m_s)^(1/2)),   Z = (EA m_K)^(1/2)
        limiter_reserve = M/(|W_h| z p/(2 pi)),   M the setting

    The value is the tension of a slow jam at the mean arm. The upper end of the error bar adds dS: the momentum of the
    chain and of the sprocket, m_s, that a rigid obstacle stops at the far end of the working strand, and their waves.

    **Range** a jam at the far end of the working strand. Nearer to the drive, the part of the sprocket increases with
    (L/x)^(1/2). The load slides on and is not contained, nor are the parts of the gear in front of the limiter.
    **Error** a bound of the arms; dS is calibrated on a sample of waves with reflections between obstacle and sprocket.
    **Source** equilibrium of the sprocket; impact of a mass on a rod with a fixed end (S. P. Timoshenko, J. N. Goodier,
    "Theory of Elasticity", 3rd edition, longitudinal impact) for the form of dS.
    """
    line, lever, limiter = chain_line(spec, scene), arms(spec), limiter_of(spec)
    least = 0.0 if line.fixed_length else line.run_off  # the stretch of a jam relaxes the other strand
    low = limiter.most / lever.most + least * (1.0 if lever.equal else lever.least / lever.most)
    high = limiter.most / lever.least + line.run_off * (1.0 if lever.equal else lever.most / lever.least)
    still = limiter.most / lever.mean + line.run_off
    added = _of_momentum(spec, scene)
    tension = Estimate(still, min(low, still), high + added, model=high + added - still)
    found = {"tension_jam": tension, "safety_jam": through(tension, lambda one: safety(spec, one))}
    if line.head_pull != 0:
        running = lever.mean * abs(line.head_pull)
        found["limiter_reserve"] = Estimate.exact(limiter.torque / running)
    return Result({name: Found(one) for name, one in found.items()}, work=1)


def _of_momentum(spec: ChainDrive, scene: Run) -> float:
    """Bound of the tension that the momentum of chain and sprocket adds in a rigid jam [N]."""
    strand = chain_line(spec, scene).working
    impedance = math.sqrt(strand.stiffness * spec.chain.mass)
    sprocket = strand.stiffness / strand.length * sprocket_mass(spec)
    return spec.speed * (_CHAIN_SHARE * impedance + math.sqrt(impedance**2 + sprocket))


LIMITER_RUN: Solver[ChainDrive, Run] = Solver(
    name="limiter_run",
    title="torque of the torque limiter, steady running",
    fidelity=Fidelity.MODAL,
    scenes=frozenset({Run}),
    represents=frozenset(),
    gives=frozenset({"limiter_torque"}),
    run=run,
    cost=lambda spec, scene, carried, level: 6.5e-3 * 2**level,
    source="equilibrium of the sprocket; Fourier series of the polygon acceleration",
    valid=fitted,
    levels=len(HARMONICS),
)
LIMITER_JAM: Solver[ChainDrive, Run] = Solver(
    name="limiter_jam",
    title="chain tension when a jam trips the torque limiter",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Run}),
    represents=frozenset(),
    gives=frozenset({"tension_jam", "safety_jam", "limiter_reserve"}),
    run=jam,
    cost=lambda spec, scene, carried, level: 1e-4,
    source="equilibrium of the sprocket; momentum of chain and sprocket",
    valid=fitted,
)
