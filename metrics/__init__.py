"""Metrics: pure functions of an outcome, one module per family.

Each metric is a function that `metric` declares, such as `smse`. Its docstring (``help(smse)``)
states formula, axis and ddof; unit, range and direction are attributes, such as ``smse.unit``.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
