"""Records as tables, and as the bundle that a report is made of."""
