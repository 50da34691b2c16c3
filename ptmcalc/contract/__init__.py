"""Floor 3: the nouns a machine kind fills in and the nouns a report is made of."""
