"""The stacker crane: what a file says of it, and the models that several topics share."""
