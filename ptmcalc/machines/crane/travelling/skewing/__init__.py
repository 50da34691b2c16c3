"""Skewing of the crane on its rails."""
