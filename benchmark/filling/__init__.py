"""Filling the gaps of a user's own recordings: by which model, and what it puts there.

`read_sources` reads files and finds what is to be filled, `fill` has models try themselves on gaps
like these and the best fill them, and `write` writes the results.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
