"""The column as a spring under a force anywhere along it."""

from ptmcalc.laws import mast_compliance
from ptmcalc.machines.crane.stacking import model
from ptmcalc.machines.crane.stacking.mast import properties
from ptmcalc.machines.crane.stacking.scenes import StackerScene
from ptmcalc.machines.crane.stacking.spec import Stacker


def flexural_stiffness(spec: Stacker, direction: model.Direction) -> float:
    """E J of all masts; of a file that gives the whole stiffness, that of a column with a rigid root [N*m^2]."""
    return float(spec.column.length**3 / 3 / properties.compliance(spec, direction).bending)


def compliance(spec: Stacker, scene: StackerScene, place: float) -> mast_compliance.Compliance:
    """Displacement per force so far from the root, in the direction of the scene, without a guide at the head [m/N]."""
    whole, share = properties.compliance(spec, model.direction(spec, scene)), place / spec.column.length
    return mast_compliance.Compliance(whole.bending * share**3, whole.rotation * share**2, whole.translation)
