"""Holding the stopped belt: rollback torque."""
