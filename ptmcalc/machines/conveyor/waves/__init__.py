"""Belt waves: their bounds without simulation, and the simulations."""
