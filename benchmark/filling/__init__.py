"""Filling the gaps of a user's own recordings: by which model, and what it puts there.

`read_input_files` reads files and finds what is to be filled, `fill` compares models in held-out
gaps and has the best fill the real ones, and `write` writes the results.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
