"""The hoist: what a file says of it, and its model."""
