"""The textbook's polygon force and resonance speed. Shown beside the computed ones, never judged."""

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import chain_resonance, polygon
from ptmcalc.machines.chain_drive.machine.layout import ConveyorLayout
from ptmcalc.machines.chain_drive.machine.model import filled, load_line_mass
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, Run
from ptmcalc.machines.chain_drive.polygon.chain_modes import TEXTBOOK_K
from ptmcalc.machines.chain_drive.polygon.excitation import POLYGON


def run(spec: ChainDrive, scene: Run, carried: frozenset[str], level: int) -> Result:
    """Polygon force of the textbook, and its resonance speed.

        S_D = 3 m a_max,   m = (m_G + lambda m_K) L        V = K (p/L) (A/q)^(1/2),  K = 3500

    **Range** conveyors without a driven tail; lambda from a table of lengths with steps at 25 m and 60 m.
    **Error** no bound: on the unsafe side near every resonance if the first mode has less than 10 % damping, too high
    above the first resonance. The formula never decides a verdict.
    **Source** N. Yu. Dorokhov, lecture notes, Kramatorsk 2007 (`laws.polygon`, `laws.chain_resonance`).
    """
    length, load = filled(getattr(spec.layout, "length", None)), load_line_mass(spec, scene)
    mass = polygon.textbook_mass(load, spec.chain.mass, length, polygon.return_share(length))
    peak = float(polygon.peak_acceleration(spec.speed, spec.chain.pitch, spec.sprocket.teeth))
    loads = {"tension_dynamic_polygon": polygon.textbook_polygon_force(mass, peak)}
    if spec.chain.section is not None:
        section, weight = spec.chain.section * spec.chain.count, (load + spec.chain.mass) * spec.gravity
        loads["resonance_speed_first"] = chain_resonance.textbook_resonance_speed(
            TEXTBOOK_K, spec.chain.pitch, length, section, weight
        )
    return Result({name: Found(Estimate.unknown(value)) for name, value in loads.items()}, work=1)


def valid(spec: ChainDrive, scene: Run) -> Criterion:
    """The textbook knows conveyors with one drive.

    **Range** any chain drive.
    **Error** none: a yes or no.
    **Source** lecture notes Kramatorsk 2007.
    """
    plain = isinstance(spec.layout, ConveyorLayout) and spec.layout.tail.driven == "off" and spec.equalising is None
    return Criterion(
        "conveyor",
        0.0 if plain else 1.0,
        0.5,
        "0 for a conveyor with one drive of uniform speed, else 1",
        "lecture notes 2007",
    )


CHAIN_TEXTBOOK: Solver[ChainDrive, Run] = Solver(
    name="chain_textbook",
    title="textbook formulas: polygon force, resonance speed",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Run}),
    represents=frozenset({POLYGON}),
    gives=frozenset({"tension_dynamic_polygon", "resonance_speed_first"}),
    run=run,
    cost=lambda spec, scene, carried, level: 2e-5,
    source="N. Yu. Dorokhov, lecture notes, Kramatorsk 2007",
    valid=valid,
    decides=False,
)
