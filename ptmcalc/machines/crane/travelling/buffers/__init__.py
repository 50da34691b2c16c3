"""Buffers: collision, and the crane that yaws in it."""
