"""A chain that changes its speed: the effects of starts and stops, teeth that pass meanwhile."""
