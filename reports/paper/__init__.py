"""The papers: their published values, and footnotes to them."""
