"""Statistics of the results: means over folds, ranks, contrasts, verdicts, negative control."""
