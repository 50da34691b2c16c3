"""Keys of a hoist that its parts share: tackle and drive."""
