"""Mechanisms: carriage, ropes, starting and stopping times."""
