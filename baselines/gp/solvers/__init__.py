"""Exact inference in one block, by interchangeable solvers of one contract (`solver`)."""
