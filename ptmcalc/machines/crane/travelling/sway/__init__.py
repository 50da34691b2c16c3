"""Starting and stopping: sway of the load, wheel loads, adhesion."""
