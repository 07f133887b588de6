"""Choosing a model: copies of the gaps are held out, and models compared by their errors there."""
