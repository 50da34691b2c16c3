"""The case of a scene: its train is built once for every set of effects that it carries."""

from dataclasses import dataclass

from ptmcalc.base.memory import remembered
from ptmcalc.machines.hoist.machine.spec import Hoist
from ptmcalc.machines.hoist.motion.train import Case, Moving


def case_of(spec: Hoist, scene: Moving, carried: frozenset[str]) -> Case:
    """The case of a scene with the effects it carries; without `structure` the drum stands fast, without
    `gear_elasticity` the gear is rigid, without `gear_backlash` it has no play."""
    return _case(_Key(spec, scene, carried))


@dataclass(frozen=True, slots=True)
class _Key:
    """What a case depends on; models are compared by identity, as they never change."""

    spec: Hoist
    scene: Moving
    carried: frozenset[str]

    def __hash__(self) -> int:
        return hash((id(self.spec), id(self.scene), self.carried))

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, _Key)
            and self.spec is other.spec
            and self.scene is other.scene
            and self.carried == other.carried
        )


@remembered(128)
def _case(key: _Key) -> Case:
    from ptmcalc.machines.hoist.motion.train_builder import TrainBuilder  # for the scenes that call for one

    return TrainBuilder(key.spec, key.scene, key.carried).case()
