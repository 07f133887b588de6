from .angles import cumulative_scaled_error, rms_angle
from .base import Direction, Metric, Score, has_poses, metric
from .calibration import coverage_50, coverage_80, coverage_90, coverage_95, crps, pit, sharpness
from .clustering import adjusted_rand, purity
from .contact import foot_skate, sample_foot_skate
from .errors import mae, mse, smse, smse_pooled
from .horizons import (
    mpjpe_at_2,
    mpjpe_at_4,
    mpjpe_at_8,
    mpjpe_at_10,
    mpjpe_at_14,
    mpjpe_at_25,
)
from .in_betweening import l2p, l2q
from .jerk import jerk_ratio, sample_jerk_ratio
from .likelihood import msll
from .norms import angle_error_per_frame, rms_per_frame, root_error_per_frame
from .outcomes.clustering import Clustering
from .outcomes.imputation import Imputation
from .outcomes.poses import ImputedPoses, SampledPoses
from .outcomes.recovery import Recovery
from .outcomes.synthesis import Synthesis
from .positions import bone_length_error, mpjpe, mpjpe_global
from .recovery import frobenius_child, frobenius_parent, logdet_child, logdet_parent
from .similarity import mcc, mcc_best, mlc, mlc_best, variance_ratio
from .spectrum import npss, npss_real_part, sample_npss

__all__ = [
    "Clustering",
    "Direction",
    "Imputation",
    "ImputedPoses",
    "Metric",
    "Recovery",
    "SampledPoses",
    "Score",
    "Synthesis",
    "adjusted_rand",
    "angle_error_per_frame",
    "bone_length_error",
    "coverage_50",
    "coverage_80",
    "coverage_90",
    "coverage_95",
    "crps",
    "cumulative_scaled_error",
    "foot_skate",
    "frobenius_child",
    "frobenius_parent",
    "has_poses",
    "jerk_ratio",
    "l2p",
    "l2q",
    "logdet_child",
    "logdet_parent",
    "mae",
    "mcc",
    "mcc_best",
    "metric",
    "mlc",
    "mlc_best",
    "mpjpe",
    "mpjpe_at_2",
    "mpjpe_at_4",
    "mpjpe_at_8",
    "mpjpe_at_10",
    "mpjpe_at_14",
    "mpjpe_at_25",
    "mpjpe_global",
    "mse",
    "msll",
    "npss",
    "npss_real_part",
    "pit",
    "purity",
    "rms_angle",
    "rms_per_frame",
    "root_error_per_frame",
    "sample_foot_skate",
    "sample_jerk_ratio",
    "sample_npss",
    "sharpness",
    "smse",
    "smse_pooled",
    "variance_ratio",
]
