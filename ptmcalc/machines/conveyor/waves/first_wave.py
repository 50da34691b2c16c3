"""The textbook start: the direct wave. Shown beside the simulated value, never judged."""

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import wave
from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.conveyor.machine import tension_loads
from ptmcalc.machines.conveyor.machine.loads import AT_DRUM
from ptmcalc.machines.conveyor.machine.plain_start import plainness
from ptmcalc.machines.conveyor.machine.scenes import Start
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.machine.start_case import start_case


def run(spec: Conveyor, scene: Start, carried: frozenset[str], level: int) -> Result:
    """Maximum dynamic tension of the direct wave by the textbook formula.

        gravity take-up: S_d = F_d (1 - exp(-Z1 t_max/m)),  t_max = 2 (L/c1 + L/c2)
        fixed take-up:   S_on rises by Z1 v, S_off falls by Z2 v,  v = F_d/(Z1 + Z2) until the first echo

    **Range** a torque step; gravity take-up: strands of equal impedance; fixed take-up: until the first echo.
    **Error** no bound: -29 % to +23 % of the peak over the usual belts, and the drop with a fixed take-up is up to 2.9
    times the formula value. The formula never decides a verdict.
    **Source** N. Yu. Dorokhov, lecture notes, Kramatorsk 2007; fixed take-up derived from the same wave.
    """
    case = start_case(spec, scene)
    line = case.line
    z_carry, z_return = line.impedance(CARRY), line.impedance(RETURN)
    time = wave.first_wave_time(line.transit(CARRY), line.transit(RETURN))
    if line.fixed_length:
        speed = float(wave.first_wave_speed(case.excess, z_carry + z_return, line.drive_mass, time))
        rise, drop = z_carry * speed, z_return * speed
    else:
        rise, drop = wave.first_wave_peak(case.excess, z_carry, line.drive_mass, time), 0.0
    on, off = line.run_on + rise, line.run_off - drop
    loads = {
        "tension_dynamic_run_on_max": rise,
        "tension_run_on_max": on,
        "tension_run_off_min": off,
    }
    if line.grip_exponent is not None:
        loads |= tension_loads.slip_loads(line.grip_exponent, [tension_loads.Sides(on, off, 0.0)])
    return Result({name: Found(Estimate.unknown(value)) for name, value in loads.items()}, work=1, window=(0.0, time))


def valid(spec: Conveyor, scene: Start) -> Criterion:
    """The textbook knows a torque step only.

    **Range** any start.
    **Error** none: a yes or no.
    **Source** lecture notes Kramatorsk 2007.
    """
    plain = plainness(spec, scene)
    if plain.exceeded:
        return plain
    case = start_case(spec, scene)
    step = scene.profile.shape == "step" and case.moves
    return Criterion(
        "step",
        0.0 if step else 1.0,
        0.5,
        "0 for a torque step that moves the belt, else 1",
        "lecture notes 2007",
    )


FIRST_WAVE: Solver[Conveyor, Start] = Solver(
    name="first_wave",
    title="textbook first-wave formula",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Start}),
    represents=frozenset({"belt_wave"}),
    gives=AT_DRUM,
    run=run,
    cost=lambda spec, scene, carried, level: 5e-5,
    source="N. Yu. Dorokhov, lecture notes, Kramatorsk 2007",
    valid=valid,
    decides=False,
)
