"""Rail: steps and gaps."""
