"""Filling and comparing in memory: what ``import mocapbench`` offers to a notebook."""
