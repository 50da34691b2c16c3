"""Check of the distance from resonance."""

from collections.abc import Iterator

from ptmcalc.contract.check import Check, Sense, blames, no_needs, no_repair
from ptmcalc.contract.limits import key
from ptmcalc.machines.drivetrain.machine.judging import RUNNING, AnyCheck
from ptmcalc.machines.drivetrain.machine.keys.torques import SineTorque
from ptmcalc.machines.drivetrain.machine.spec import Drivetrain, TrainScene

_RESONANCE_LIMIT = key(
    "checks.resonance_margin",
    meaning="Minimum separation of an excitation frequency from a natural frequency: 20 % of the natural frequency, or"
    " the value of the file",
    valid="harmonic excitations",
    error="none: an engineering choice",
    source="usual practice; at 20 % an undamped amplitude is 2.3 to 2.8 times the static one",
)


def _resonance_checks(spec: Drivetrain, scene: TrainScene) -> Iterator[AnyCheck]:
    for name, torque in spec.torques.items():
        if isinstance(torque, SineTorque):
            key = "frequency" if torque.frequency is not None else "angular_frequency"
            path = ("torques", name, key)
            yield RESONANCE.of(name, _RESONANCE_LIMIT, path, repair=path)


RESONANCE: AnyCheck = Check(
    code="DRV107",
    title="excitation separation from resonance",
    question="Are all excitation frequencies far enough from the natural frequencies?",
    failure="excitation is close to a natural frequency",
    scenes=RUNNING,
    loads=("resonance_separation",),
    sense=Sense.AT_LEAST,
    limit=_RESONANCE_LIMIT,
    needs=no_needs,
    blame=blames("torques"),
    repair=no_repair,
    each=_resonance_checks,
    what="The frequency of every harmonic torque is separated from each natural frequency of the train by at least the"
    " margin.",
    why="Near resonance, only damping limits the torque. The damping is not known accurately.",
    formula="min_k |W/w_k - 1| >= margin",
    source="usual practice",
)
