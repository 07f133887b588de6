"""Motions as the page keeps them: positions in few bytes, and a player that shows them."""
