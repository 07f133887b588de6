"""Gaussian processes around a common trend, whose posterior can be computed."""

from __future__ import annotations

from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.common.validation import check_times
from mocapbench.baselines.gp.estimator import GaussianProcess
from mocapbench.baselines.gp.reduction.reduction import PosteriorTerm
from mocapbench.baselines.protocols import Trended
from mocapbench.datasets import FrameByChannel, Frames

__all__ = ["TrendedProcess"]


class TrendedProcess(GaussianProcess, Trended):
    """A `GaussianProcess` whose recordings vary around a common function g."""

    def trend(self, times: Frames) -> tuple[FrameByChannel, FrameByChannel]:
        """Return the posterior mean and variance of the trend g.

        Parameters
        ----------
        times : ndarray of shape (N,)
            In seconds, in any order.

        Returns
        -------
        mean, variance : ndarray of shape (N, D)
            In the outputs' own units and their squares, noise left out.

        Raises
        ------
        sklearn.exceptions.NotFittedError
            If `fit` has not been called.
        ValueError
            If times are not finite numbers.
        """
        check_is_fitted(self)
        return self._infer(self.reduction_.trend, times)

    def _infer(
        self, curve: tuple[PosteriorTerm, ...], times: Frames
    ) -> tuple[FrameByChannel, FrameByChannel]:
        """Return the posterior mean and variance of a curve."""
        with self._threaded_process() as process:
            (inferred,) = process.infer([curve], [check_times(times)])
        return inferred
