"""Strength: load combinations, stresses, stability."""
