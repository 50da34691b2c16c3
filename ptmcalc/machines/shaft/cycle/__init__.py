"""The steady cycle: speed fluctuation, flywheel, cycles that are impossible."""
