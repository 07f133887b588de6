"""The page: its sections, its headlines, and the template that they fill."""
