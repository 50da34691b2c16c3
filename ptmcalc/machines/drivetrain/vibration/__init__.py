"""Vibration of the train: natural frequencies and their distance from excitations."""
