"""Our numbers beside the published ones: pairs, verdicts, and totals that count each value once."""
