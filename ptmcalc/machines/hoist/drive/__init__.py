"""The drive in steady motion: motor, gearbox, brake, duty."""
