"""Safety gear: fall and catch."""
