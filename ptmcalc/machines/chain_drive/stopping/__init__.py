"""Stopping: brakes, stopping distance and time."""
