"""Floor 0: words every other floor uses. Standard library only."""
