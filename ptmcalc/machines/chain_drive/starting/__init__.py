"""Starting: the rigid chain, its waves, a relaxed chain that breaks loose."""
