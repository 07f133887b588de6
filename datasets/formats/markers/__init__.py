"""Formats of the positions of markers, which cameras saw or did not see."""
