"""Collision: buffers and obstacles."""
