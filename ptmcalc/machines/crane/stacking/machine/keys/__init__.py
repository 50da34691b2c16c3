"""Keys of a stacker crane that both types share: structure, drives, hazards, limits."""
