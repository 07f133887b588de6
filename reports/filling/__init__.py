"""The page of one filled file."""
