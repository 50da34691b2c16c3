"""Slewing drive: reserves of motor and brake, heating, gearbox, duty."""
