"""A hoist in motion as a train of bodies: motor, gear, drum, rope, load, and the structure the drum stands on.

Motor and drum turn, positive while they haul; load and hook travel, positive up; the structure sinks, positive down.
The hook end of the rope belongs to the drum, its travel reduced by drum radius and falls. Losses of gear and tackle go
by the direction of the power through them; the rope only pulls, the load stands on the ground until the rope bears it.
"""

from dataclasses import dataclass

from ptmcalc.machines.hoist.machine.spec import Lift, LowerBrake, Release, Start, Stop
from ptmcalc.numerics.train.parts import Smooth, Train

TOLERANCES = (1e-6, 1e-8, 1e-10)
"""Largest remainder of a smooth torque curve by level, relative to its size [1]. A numerical choice: a smaller value
narrows the error bar and takes more steps."""
STRUCTURE, GEAR = "structure", "gear_elasticity"
"""Effects that a case carries or leaves out."""
BACKLASH = "gear_backlash"
MOTOR, NODE, DRUM, HOOK, LOAD, BRIDGE, MAINS = "motor", "gear", "drum", "hook", "load", "structure", "set speed"
ROPE, GROUND, GEARBOX, TACKLE = "rope", "ground", "gearbox", "tackle"
SHAFT, FLANK = "gear shaft", "gear shaft, back of the teeth"
BRAKE, DRIVE = "brake", "drive"
LONGEST = 600.0
"""Longest window of a scene [s]; a numerical choice. A larger value follows slower hoists and takes longer; a smaller
one reports more loads without an error bar."""
LEAST_LEFT = 1e-3
"""Mass that remains on the rope when the whole load is released, relative to the load [1]. A numerical choice, as a
rope without mass has no frequency. A larger value adds inertia that does not exist."""
Moving = Lift | Start | Stop | LowerBrake | Release


@dataclass(frozen=True, slots=True)
class Case:
    """A scene in numbers: the train, how long it is looked at, the weight at its beginning and end and the rope
    at the hook, and the torque on the drum while the load moves evenly in the scene's direction."""

    train: Train
    window: float
    weight: float
    left_weight: float
    stiffness: float
    even_torque: float
    lowers: bool
    stops: bool
    drop: float
    """way of the hook to the ground; all of the lift where the scene has it at its lowest [m]"""
    holds: bool
    """whether the scene is a stop whose brake is stronger than the load"""
    weak: bool
    """whether the scene is a lift by a drive whose largest force is less than the load's"""
    ringing: float = 0.0
    """time to observe after the last event [s]"""
    coarser: "Case | None" = None
    """the same with half as many chords of the smooth rise; None where nothing is replaced by chords"""

    def named(self, what: str, name: str) -> int | None:
        """Index of a body, link, mesh, grip or drive of this name."""
        train = self.train
        names = {
            "body": [part.name for part in train.bodies],
            "link": [part.name for part in train.springs],
            "mesh": [part.name for part in train.meshes],
            "grip": [part.name for part in train.grips],
            "drive": [part.name for part in train.drives],
        }[what]
        return names.index(name) if name in names else None

    @property
    def smooth(self) -> bool:
        """Whether a nonlinear torque takes part."""
        return any(isinstance(stage.law, Smooth) for drive in self.train.drives for stage in drive.stages)
