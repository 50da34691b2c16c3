"""Traction: belt slip at the drive pulleys."""
