"""Sway of the load below the slewing jib."""
