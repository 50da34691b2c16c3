"""Rail: steps, gaps and waviness, wheels that lift off."""
