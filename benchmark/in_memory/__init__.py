"""Filling and comparing recordings in memory, by the names that `mocapbench` itself offers."""
