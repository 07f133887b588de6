"""Calls of libraries that a damaged file can crash, in a process of their own."""
