"""Floor 7: the command line. Command bodies import what they need, so that `--help` stays fast."""
