"""Metrics: pure functions of an outcome, one module per family.

`BUILTIN` is the tuple of all of them. Formula, axis and ddof of each stand in the docstring of
the function behind it.
"""

from typing import Any

from mocapbench.metrics.base import (
    Clustering,
    Direction,
    Imputation,
    Metric,
    Recovery,
    Score,
    Synthesis,
)
from mocapbench.metrics.calibration import (
    coverage_50,
    coverage_80,
    coverage_90,
    coverage_95,
    crps,
    pit,
    sharpness,
)
from mocapbench.metrics.clustering import adjusted_rand, purity
from mocapbench.metrics.errors import mse, rms_per_frame, smse, smse_pooled
from mocapbench.metrics.likelihood import msll
from mocapbench.metrics.recovery import (
    frobenius_child,
    frobenius_parent,
    logdet_child,
    logdet_parent,
)
from mocapbench.metrics.similarity import mcc, mcc_best, mlc, mlc_best, spread

__all__ = [
    "BUILTIN",
    "Clustering",
    "Direction",
    "Imputation",
    "Metric",
    "Recovery",
    "Score",
    "Synthesis",
    "adjusted_rand",
    "coverage_50",
    "coverage_80",
    "coverage_90",
    "coverage_95",
    "crps",
    "frobenius_child",
    "frobenius_parent",
    "logdet_child",
    "logdet_parent",
    "mcc",
    "mcc_best",
    "mlc",
    "mlc_best",
    "mse",
    "msll",
    "pit",
    "purity",
    "rms_per_frame",
    "sharpness",
    "smse",
    "smse_pooled",
    "spread",
]

BUILTIN: tuple[Metric[Any], ...] = (
    mse,
    smse,
    smse_pooled,
    msll,
    rms_per_frame,
    coverage_50,
    coverage_80,
    coverage_90,
    coverage_95,
    pit,
    sharpness,
    crps,
    mcc,
    mcc_best,
    mlc,
    mlc_best,
    spread,
    purity,
    adjusted_rand,
    frobenius_child,
    frobenius_parent,
    logdet_child,
    logdet_parent,
)
