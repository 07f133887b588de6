"""Inference by splitting outputs into shared latent functions and independent parts."""
