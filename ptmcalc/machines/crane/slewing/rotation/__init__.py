"""Rotation of the rigid crane: times, angles and torques of start, steady slewing and stop."""
