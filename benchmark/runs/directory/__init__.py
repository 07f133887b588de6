"""The files of a run directory: records, predictions, the plan, parts of keys, check and lock."""
