from .angles import cumulative_scaled_error, rms_angle
from .base import Clustering, Direction, Imputation, Metric, Recovery, Score, Synthesis
from .calibration import coverage_50, coverage_80, coverage_90, coverage_95, crps, pit, sharpness
from .clustering import adjusted_rand, purity
from .errors import mse, rms_per_frame, smse, smse_pooled
from .likelihood import msll
from .recovery import frobenius_child, frobenius_parent, logdet_child, logdet_parent
from .similarity import mcc, mcc_best, mlc, mlc_best, variance_ratio

__all__ = [
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
    "cumulative_scaled_error",
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
    "rms_angle",
    "rms_per_frame",
    "sharpness",
    "smse",
    "smse_pooled",
    "variance_ratio",
]
