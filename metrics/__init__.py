"""Metrics: pure functions of an outcome, one module per family.

Each metric is a `Metric` object, such as `smse`. The docstring of the function that it calls
(``help(smse.statistic)``) states formula, axis, ddof, unit and direction.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
