"""The regression gate: whether a run is as good as its reference values, or as a control.

`reference` reads and writes the values, `rule` decides one metric, `checking` all of them by the
`tolerances`, and `output` says it to people and machines; `negative_control` compares samples with
those of an unrelated process.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
