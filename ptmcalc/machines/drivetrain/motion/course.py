"""One run of a train: its record, and where a value of a part stands in it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ptmcalc.machines.drivetrain.machine.model import Case
from ptmcalc.numerics.record import Record
from ptmcalc.numerics.train.ledger import Ledger
from ptmcalc.numerics.train.parts import HUNT_CROSSLEY, Smooth
from ptmcalc.numerics.train.system import TrainSystem


@dataclass(frozen=True, slots=True)
class Course:
    """One run of a case."""

    case: Case
    system: TrainSystem
    record: Record
    ledger: Ledger

    @property
    def smooth(self) -> bool:
        """Whether a nonlinear torque took part."""
        return is_smooth(self.case)

    def index(self, what: str, name: str) -> int | None:
        """Index of a watched signal of a body, link, gear, motor or brake."""
        train = self.case.train
        named: Mapping[str, Sequence[Any]] = {"link": train.springs, "mesh": train.meshes, "drive": train.drives}
        names = [part.name for part in named.get(what, train.bodies)]
        return self.system.watched[what, names.index(name)] if name in names else None

    def torque(self, name: str) -> int | None:
        """Index of the torque of a link, or of the gear a rigid train has in its place."""
        found = self.index("link", name)
        return found if found is not None else self.index("mesh", name)

    def largest(self, index: int) -> tuple[float, float]:
        """Largest magnitude of a signal and its time."""
        top, bottom = self.record.top, self.record.bottom
        high, low = float(top.values[index]), float(bottom.values[index])
        if high >= -low:
            return high, float(top.at[index])
        return -low, float(bottom.at[index])


def is_smooth(case: Case) -> bool:
    """Whether a nonlinear torque takes part, which is found by iteration from panel to panel."""
    train = case.train
    laws = (stage.law for drive in train.drives for stage in drive.stages)
    return any(isinstance(law, Smooth) for law in laws) or any(one.law == HUNT_CROSSLEY for one in train.springs)
