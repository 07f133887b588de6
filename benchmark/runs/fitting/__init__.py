"""Fitting and asking one model: what it answers, what it costs, and what others can use of it."""
