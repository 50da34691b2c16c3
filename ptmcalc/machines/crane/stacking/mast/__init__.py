"""Mast: deflection, oscillation, settling, second-order effects."""
