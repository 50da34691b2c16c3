"""Check of the holding force in a storm."""

from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import Check, LimitState, Sense, no_needs
from ptmcalc.contract.limits import key
from ptmcalc.machines.crane.travelling.machine.judging import OneCheck
from ptmcalc.machines.crane.travelling.machine.scenes import Storm, TravelScene
from ptmcalc.machines.crane.travelling.machine.spec import Travelling


def _storm_key(spec: Travelling, scene: TravelScene) -> KeyPath:
    return ("parking", "force") if spec.parking is not None else ("wind", "pressure_storm")


STORM: OneCheck = Check(
    code="CRN175",
    hazard=True,
    title="holding reserve, out-of-service wind",
    question="Do brakes and rail clamps hold the parked crane in out-of-service wind?",
    failure="holding reserve in out-of-service wind is too small",
    limit_state=LimitState("parked crane drifts away", 1),
    scenes=frozenset({Storm}),
    loads=("storm_reserve",),
    sense=Sense.AT_LEAST,
    limit=key(
        "checks.wind_reserve",
        meaning="Minimum reserve against the out-of-service wind, 1.1 by default",
        valid="outdoor cranes",
        error="none: an engineering rule",
        source="handbooks of lifting machines; instead of it the partial factors of the standards, if they apply",
    ),
    needs=no_needs,
    blame=lambda spec, scene, loads: _storm_key(spec, scene),
    repair=lambda spec, scene: _storm_key(spec, scene) if spec.parking is not None else (),
    what="Brakes and rail clamps hold the crane in the out-of-service wind with the required reserve. The brake forces"
    " are limited by the adhesion of their wheels.",
    why="Only the end stops stop a crane that moves in a storm.",
    formula="(sum of min(M_b u/(r eta_r)/n, mu N_k) + clamps)/(q c A + G sin(alpha)) >= 1.1",
    source="balance along the rails; winds of EN 13001-2, ISO 4302",
)
