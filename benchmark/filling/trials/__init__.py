"""Which model fills gaps like these best: trials where the truth is visible."""
