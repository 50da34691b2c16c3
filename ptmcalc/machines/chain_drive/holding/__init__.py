"""Holding the stopped chain: rollback torque."""
