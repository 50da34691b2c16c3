"""Run-up and run-out: the tachogram, the worst angle, the brake."""
