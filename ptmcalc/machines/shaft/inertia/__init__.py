"""Inertia that changes with the angle: what its change adds to every scene."""
