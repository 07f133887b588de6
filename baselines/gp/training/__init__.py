"""Training by type-II maximum likelihood: start, coordinates, search."""
