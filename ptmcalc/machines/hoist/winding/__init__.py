"""Multilayer winding: the rope climbs to its next layer."""
