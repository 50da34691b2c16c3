"""Lifting, lowering, stopping, release: oscillation of load, rope, drive and structure."""
