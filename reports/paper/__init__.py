"""The papers: published values, remarks on them, and citations."""
