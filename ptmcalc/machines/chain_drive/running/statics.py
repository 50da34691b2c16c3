"""Steady running without the polygon effect: kinematics, tensions, power, waves."""

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import chain_selection, polygon, sprocket, wave
from ptmcalc.machines.chain_drive.machine.model import ChainLine, chain_line, driver_wrap, lines
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, Run
from ptmcalc.machines.chain_drive.machine.strength import AT_REST, OF_TENSION, loads_of_tension
from ptmcalc.machines.chain_drive.polygon.excitation import residual


def run(spec: ChainDrive, scene: Run, carried: frozenset[str], level: int) -> Result:
    """Loads of a chain in steady running.

        S_tail = S_off + W_return - q_0 g H,   S_on = S_tail + F - s W + W_working + (q_0 + q_G) g H

    W is what all drives pull, W_return + F + W_working + q_G g H.

    **Range** straight strands; between two shafts the slack strand hangs in a flat arc.
    **Error** no error bar of its own; the bound of the polygon effect covers the added tension.
    **Source** equilibrium of each strand; kinematics of the polygon (`laws.sprocket`, `laws.polygon`).
    """
    line = chain_line(spec, scene)
    loads = _of_motion(spec) | _of_tensions(line)
    loads["shaft_load"] = float(chain_selection.shaft_load(line.run_on, line.run_off, driver_wrap(spec)))
    own = lines(line, spec)
    loads["wave_speed"] = wave.wave_speed(line.working.stiffness, line.working.line_mass)
    loads["wave_travel_time"] = sum(strand.transit for strand in own)
    found = {name: Found(Estimate.exact(value)) for name, value in loads.items()}
    return Result(found | {name: Found(one) for name, one in loads_of_tension(spec, line, AT_REST).items()}, work=1)


def _of_motion(spec: ChainDrive) -> dict[str, float]:
    """An equalising drive leaves a share of what is uneven."""
    speed, pitch, teeth, share = spec.speed, spec.chain.pitch, spec.sprocket.teeth, residual(spec)
    return {
        "sprocket_speed": sprocket.sprocket_speed(speed, pitch, teeth),
        "speed_max": speed + share * (sprocket.speed_extremes(speed, teeth)[1] - speed),
        "speed_ripple": share * sprocket.speed_ripple(teeth, sprocket.OF_LARGEST),
        "acceleration_polygon_max": share * float(polygon.peak_acceleration(speed, pitch, teeth)),
        "transverse_travel": sprocket.transverse_travel(pitch, teeth),
        "transverse_speed": sprocket.transverse_speed(speed, teeth),
    }


def _of_tensions(line: ChainLine) -> dict[str, float]:
    return {
        "static_resistance": line.static_resistance,
        "power_drive": line.static_resistance * line.speed,
        "tension_static": max(line.ends),
        "tension_run_off": line.run_off,
        "tension_centrifugal": line.centrifugal,
    }


STATICS: Solver[ChainDrive, Run] = Solver(
    name="chain_statics",
    title="steady-running strand tensions",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Run}),
    represents=frozenset(),
    gives=OF_TENSION.union(
        {
            "sprocket_speed",
            "speed_max",
            "speed_ripple",
            "acceleration_polygon_max",
            "transverse_travel",
            "transverse_speed",
            "static_resistance",
            "power_drive",
            "tension_static",
            "tension_run_off",
            "tension_centrifugal",
            "shaft_load",
            "wave_speed",
            "wave_travel_time",
        }
    ),
    run=run,
    cost=lambda spec, scene, carried, level: 6e-3,
    source="lecture notes Kramatorsk 2007; equilibrium",
)
