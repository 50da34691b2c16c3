"""Floor 2: what every machine description is made of."""
