"""Lumped trains: inertias, elastic links with play, meshes with losses, friction and torques, as piecewise-linear
systems for `numerics.piecewise`."""
