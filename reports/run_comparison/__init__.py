"""The page of two runs side by side: what changed between them, and by how much."""
