"""Motion of the train: start, stop, speeds, clutches."""
