"""Tables of standard parts, one CSV file each, read when a design file names a part."""
