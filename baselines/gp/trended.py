"""Gaussian processes around a trend that can be inferred."""

from __future__ import annotations

import numpy as np
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.gp.estimator import GaussianProcess
from mocapbench.baselines.gp.reduction.reduction import Share
from mocapbench.baselines.protocols import Trended
from mocapbench.datasets import FrameByChannel, Frames

__all__ = ["TrendedProcess"]


class TrendedProcess(GaussianProcess, Trended):
    """A `GaussianProcess` whose recordings have the function g in common."""

    def trend(self, times: Frames) -> tuple[FrameByChannel, FrameByChannel]:
        """Return the posterior mean and variance of g at ``times`` (N,): (N, D) each."""
        check_is_fitted(self)
        return self._infer(self.reduction_.trend, times)

    def _infer(
        self, curve: tuple[Share, ...], times: Frames
    ) -> tuple[FrameByChannel, FrameByChannel]:
        """Return the posterior mean and variance of a curve."""
        with self._at_work() as process:
            (inferred,) = process.infer([curve], [np.asarray(times, dtype=np.float64)])
        return inferred
