"""Formats of users' own files: reading them as recordings, and writing back what was filled."""
