"""The values that a report is made of: results, layouts, task pages, pictures, and a check."""
