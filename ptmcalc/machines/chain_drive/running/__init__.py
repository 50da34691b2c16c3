"""Steady running: tensions, power, choice of the chain, motor torque."""
