"""Text files that keep what is not changed, byte for byte."""
