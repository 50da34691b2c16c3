"""Steady hoisting and lowering: rope, sheaves, drum, classification."""
