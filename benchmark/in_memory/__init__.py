"""Filling and comparing recordings in memory, as a notebook does by the names of mocapbench itself."""
