"""Filling and comparing recordings in memory, as notebooks do by the names of mocapbench itself."""
