"""Reproducible benchmarks of models of human motion.

The parts are `mocapbench.datasets`, `mocapbench.metrics`, `mocapbench.baselines`,
`mocapbench.reports` and `mocapbench.benchmark`, each a folder of its own in the source tree. They
build on `mocapbench.basics`.
"""

__all__ = ["__version__"]

__version__ = "0.1.0"
