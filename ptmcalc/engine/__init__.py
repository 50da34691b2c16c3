"""Floor 6: text to verdicts, one arrow a file."""
