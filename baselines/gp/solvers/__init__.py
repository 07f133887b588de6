"""Exact inference in one block, by interchangeable methods with one interface (`solver`)."""
