"""What results mean: estimates, ranks, verdicts beside published values, the negative control."""
