"""Steady travel: resistance, power, wheel loads, duty, standard factors."""
