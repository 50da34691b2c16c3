"""The slewing crane: what a file says of it, and its model."""
