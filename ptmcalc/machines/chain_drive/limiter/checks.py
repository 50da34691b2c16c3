"""Checks of the torque limiter: it holds in operation, protects the chain in a jam, and has the usual margin."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import replace

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.check import AnyCheck, Check, Sense, at, blames, no_needs
from ptmcalc.contract.limits import key
from ptmcalc.machines.chain_drive.limiter.stops import STOPS
from ptmcalc.machines.chain_drive.limiter.trips import ACTS, limiter_of
from ptmcalc.machines.chain_drive.machine.model import chain_line
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, ChainScene, Run, Start
from ptmcalc.spec.scene import Scene

Loads = Mapping[str, Estimate]
_SCENES: frozenset[type[Scene]] = STOPS | {Run, Start}
_TORQUE = ("torque_limiter", "torque")

# -- trip -----------------------------------------------------------------------------------------------------------


def _trip_limit(spec: ChainDrive, scene: ChainScene) -> Estimate:
    """Lowest trip torque of the limiter.

        M_min = M (1 - tolerance)

    **Range** a limiter in the state of its setting.
    **Error** that of the tolerance, which is tried at both ends where it is assumed.
    **Source** the manufacturer's data.
    """
    return Estimate.exact(limiter_of(spec).least if spec.torque_limiter is not None else math.inf)


def _where_fitted(spec: ChainDrive, scene: ChainScene) -> Iterable[AnyCheck]:
    """Where the file gives a limiter."""
    if spec.torque_limiter is not None:
        yield replace(TRIP, each=None, failure=f"torque limiter {ACTS[limiter_of(spec).type]}")


TRIP: Check[ChainDrive, ChainScene] = Check(
    code="CHN134",
    title="torque of the torque limiter",
    question="Does the torque limiter hold in starts, stops and steady running?",
    failure="torque limiter trips",
    scenes=_SCENES,
    loads=("limiter_torque",),
    sense=Sense.AT_MOST,
    limit=_trip_limit,
    needs=no_needs,
    blame=blames(*_TORQUE),
    repair=at(*_TORQUE),
    each=_where_fitted,
    what="The largest torque on the sprocket shaft in operation stays below the lowest trip torque of the limiter.",
    why="A slip clutch that slips in every start overheats and wears. A shear pin that breaks disconnects the motors"
    " and a brake on the motor shaft. The other loads of such a scene are computed as if the limiter held.",
    formula="R (S_on - S_off) + J_s a_s/R <= M (1 - tolerance)",
    source="equilibrium of the sprocket; the manufacturer's data",
)

# -- jam ------------------------------------------------------------------------------------------------------------


JAM: Check[ChainDrive, Run] = Check(
    code="CHN135",
    hazard=True,
    title="chain safety factor, jam",
    question="Does the torque limiter protect the chain in a jam?",
    failure="chain is overloaded before the torque limiter trips",
    scenes=frozenset({Run}),
    loads=("safety_jam",),
    sense=Sense.AT_LEAST,
    limit=key(
        "checks.safety_jam",
        meaning="Required ratio of breaking load to maximum tension in a jam, from the file or 3.3",
        valid="jams, which are rare",
        source="manufacturers preload chains with 30 % of the breaking load (ISO 606:2004; ZMC for conveyor chains of"
        " ISO 1977): links lengthen permanently above that tension",
    ),
    needs=no_needs,
    blame=blames(*_TORQUE),
    repair=at(*_TORQUE),
    each=lambda spec, scene: (replace(JAM, each=None),) if spec.torque_limiter is not None else (),
    what="The breaking load is at least the safety factor times the tension at the highest trip torque of the limiter."
    " The error bar includes the momentum of chain and sprocket in a rigid jam at the far end of the working strand.",
    why="A jam stops the chain while the motors pull on: the limiter is the weakest part only if it trips before links"
    " lengthen. A jam close to the drive is harder: the momentum of the sprocket is then not covered.",
    formula="F_B/(c (S_off + M (1 + tolerance)/R)) >= limit",
    source="equilibrium of the sprocket; preload of chains, ISO 606:2004",
)

# -- margin ---------------------------------------------------------------------------------------------------------


def _margin_limit(spec: ChainDrive, scene: Run) -> Estimate:
    """Required ratio of setting to torque of steady running, from the file or 1.25.

    **Range** shaft speeds below 500 rpm; above them the starting torque of the motor counts (CHN134).
    **Error** none: a chosen limit.
    **Source** Tsubakimoto, technical data of mechanical protectors, selection of the trip torque: 1.25 for normal
    starts and stops, 1.5 for severe shocks or reversing.
    """
    return Estimate.exact(limiter_of(spec).reserve if spec.torque_limiter is not None else 1.0)


def _where_it_pulls(spec: ChainDrive, scene: Run) -> Iterable[AnyCheck]:
    """Where the file gives a limiter and the chain has a resistance."""
    if spec.torque_limiter is not None and chain_line(spec, scene).head_pull != 0:
        yield replace(MARGIN, each=None)


MARGIN: Check[ChainDrive, Run] = Check(
    code="CHN136",
    title="torque limiter setting / running torque",
    question="Is the setting of the torque limiter far enough above the running torque?",
    failure="torque limiter is set too close to the running torque",
    scenes=frozenset({Run}),
    loads=("limiter_reserve",),
    sense=Sense.AT_LEAST,
    limit=_margin_limit,
    needs=no_needs,
    blame=blames(*_TORQUE),
    repair=at(*_TORQUE),
    each=_where_it_pulls,
    what="The setting of the limiter is at least 1.25 times the torque of steady running, or the ratio of the file.",
    why="Wear, cold grease and small overloads trip a limiter without margin.",
    formula="M/(W_h z p/(2 pi)) >= limit",
    source="Tsubakimoto, technical data of mechanical protectors: service factors 1.25 and 1.5",
)
