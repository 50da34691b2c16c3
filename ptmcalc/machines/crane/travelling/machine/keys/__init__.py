"""Keys of a travelling crane that its topics share: runway and duty."""
