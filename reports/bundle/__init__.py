"""What a report is made of, as plain values: results, pages of tasks, pictures, a check."""
