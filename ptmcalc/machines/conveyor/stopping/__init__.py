"""Stopping: brakes, stopping distance and time, the rigid and the stiff conveyor."""
