"""A whole belt in motion: idler friction that sticks and slips, several drums, brakes, take-ups."""
