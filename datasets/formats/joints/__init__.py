"""Formats of the angles of joints in a hierarchy."""
