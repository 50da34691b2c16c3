"""Take-up: travel over all scenes, and the stops of its weight."""
