"""What a run directory holds besides records and predictions: the plan, parts of keys, the lock."""
