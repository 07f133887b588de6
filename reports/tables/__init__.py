"""Tables as values, one module per kind of table."""
