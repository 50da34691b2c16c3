"""Starting: motor heat, sharpness, residual oscillation, the rigid conveyor."""
