"""Inference by splitting outputs into what they share and their independent parts."""
