"""Figures for papers: tidy tables drawn by seaborn and matplotlib, one module a kind."""
