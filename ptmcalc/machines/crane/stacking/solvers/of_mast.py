"""Solvers of the column's motion, from the cheapest to the richest."""

from dataclasses import replace

from ptmcalc.contract.solver import AnySolver, Fidelity
from ptmcalc.machines.crane.stacking.names_mast import GRAVITY
from ptmcalc.machines.crane.stacking.scenes import Stand
from ptmcalc.machines.crane.stacking.solvers.mast_beam import MAST_BEAM
from ptmcalc.machines.crane.stacking.solvers.mast_handbook import MAST_HANDBOOK
from ptmcalc.machines.crane.stacking.solvers.mast_modal import COLLISION_MODAL, MAST_MODAL, STANDING_MODAL
from ptmcalc.machines.crane.stacking.solvers.mast_two_mass import MAST_TWO_MASS
from ptmcalc.machines.crane.stacking.solvers.obstacle_energy import OBSTACLE_BOUND, OBSTACLE_ENERGY

MAST_ELEMENTS = replace(
    MAST_MODAL,
    name="mast_elements",
    title="frequencies of the column in finite elements, with its weights",
    fidelity=Fidelity.MODAL,
    scenes=frozenset({Stand}),
    represents=frozenset({GRAVITY}),
    gives=frozenset({"natural_frequency", "period"}),
    always=frozenset(),
    levels=1,
)
"""The same elements where nothing moves."""

SOLVERS_OF_MAST: tuple[AnySolver, ...] = (
    MAST_HANDBOOK,
    OBSTACLE_ENERGY,
    OBSTACLE_BOUND,
    MAST_BEAM,
    MAST_ELEMENTS,
    MAST_TWO_MASS,
    MAST_MODAL,
    COLLISION_MODAL,
    STANDING_MODAL,
)
