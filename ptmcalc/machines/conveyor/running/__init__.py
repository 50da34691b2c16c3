"""Steady running: tensions, power, trough, curves, motor torque."""
