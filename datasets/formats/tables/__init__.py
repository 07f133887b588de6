"""Formats that are tables: a column of times, and one column a channel."""
