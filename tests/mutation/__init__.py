"""Do the tests catch small faults of `laws` and `numerics`? A study: `python -m tests.mutation --help`."""
