"""Measured speed records: motor curve, losses and brake torque from them."""
