from . import baselines, basics, benchmark, datasets, metrics, reports
from .benchmark.in_memory.filled import Filled
from .benchmark.in_memory.gap_filling import fill
from .benchmark.in_memory.reading import read

__version__: str

__all__ = [
    "Filled",
    "__version__",
    "baselines",
    "basics",
    "benchmark",
    "datasets",
    "fill",
    "metrics",
    "read",
    "reports",
]
