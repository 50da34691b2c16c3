"""Polygon effect: excitation by the sprockets, natural frequencies, resonance speeds, dynamic tension."""
