"""Comparisons of two runs, or of two models of one run, with their statistics."""
