"""Tables for papers: means with their intervals and tests, in LaTeX and Markdown."""
