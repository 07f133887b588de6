"""Metrics: pure functions of an outcome, one module per family.

`BUILTIN` is the tuple of all of them. Formula, axis and ddof of each stand in the docstring of
the function behind it.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
