"""The drive train: what a file says of it, and its model."""
