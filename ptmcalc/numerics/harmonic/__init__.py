"""Strands under periodic motion of their ends: forces harmonic by harmonic, peaks by roots, errors by bounds."""
