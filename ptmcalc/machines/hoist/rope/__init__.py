"""Rope and drum: life by bendings, proofs by EN 13001-3-2, fleet angle, drum shell and flanges."""
