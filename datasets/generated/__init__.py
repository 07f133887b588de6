"""Recordings that are made on demand: a walker with a body, a style and noise of its own."""
