"""Reproducible benchmarks of models of human motion.

To fill and compare recordings in memory there are `read`, `fill`, `evaluate`, `compare` and
`GapFiller`, and `mocapbench.figures` draws scores; all are loaded at first use. The parts are
`mocapbench.datasets`, `mocapbench.metrics`, `mocapbench.baselines`, `mocapbench.reports` and
`mocapbench.benchmark`, each a folder of its own in the source tree. They build on
`mocapbench.basics`.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)

__version__ = "0.1.0"
