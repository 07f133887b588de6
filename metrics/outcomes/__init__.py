"""Outcomes: what metrics score, one module per kind, and the joints in space of some of them."""
