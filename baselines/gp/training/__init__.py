"""Training by type-II maximum likelihood: starts, bounds, coordinates and search."""
