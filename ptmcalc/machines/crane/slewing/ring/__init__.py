"""Slewing ring: axial force, radial force and tilting moment."""
