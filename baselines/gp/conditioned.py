"""Imputation by a process that knows the recordings, with variances that its errors bear out."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence

import numpy as np

from mocapbench.baselines.protocols import Imputer, Prediction
from mocapbench.baselines.rehearsal.checkable import Widened
from mocapbench.baselines.rehearsal.left_out import LeftOut
from mocapbench.baselines.rehearsal.trials import long_copies
from mocapbench.baselines.rehearsal.variance_check import VarianceCheck
from mocapbench.datasets import Recording

__all__ = ["Conditioned"]


class Conditioned(Widened, Imputer):
    """A model that is conditioned on the recordings given to `fit`."""

    @abstractmethod
    def left_out(self, recordings: Sequence[Recording]) -> list[LeftOut]:
        """Return what the model claims of recordings given to `fit`, and its errors there.

        It raises what `impute` raises. Errors of a recording that registration has moved mean
        nothing; it is complete, and nothing of it is widened.
        """

    @abstractmethod
    def as_tried(self, trials: Sequence[Recording]) -> list[Prediction]:
        """Return what the model claims of recordings given to `fit` of which more is hidden.

        Its parameters are kept. Trials of a recording that registration has moved mean nothing.
        """

    def impute(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return the predictive distributions of recordings given to `fit`.

        Each is conditioned on the visible entries of *all* recordings given to `fit`. The variances
        of a channel are those of the posterior, times the larger of two mean ratios of squared
        errors to variances: that of the recording's own visible entries if they are left out one by
        one, and that of trials, with the parameters kept. It is less than 1 only as far as all
        entries together bear out. Trials hide
        copies of gaps of three frames or more; where copies have to be shorter than the gap, the
        ratio grows with the distance to visible frames as it does in them. The mean over all
        channels counts as ten entries in each (``docs/calibration.md``). `as_claimed` has the
        posterior itself.

        Parameters
        ----------
        recordings : sequence of Recording
            Recordings given to `fit`, in any order, with the same names, times and values.

        Returns
        -------
        list of Prediction
            One for each recording, with a mean and a variance of shape (N, D) in the channels' own
            units and their squares. Variances include the noise. Visible entries are copied, with
            variance 0.

        Raises
        ------
        sklearn.exceptions.NotFittedError
            If `fit` has not been called.
        ValueError
            If a recording was not given to `fit`, or not with these times and values.
        """
        return [
            self._borne_out(recording, errors)
            for recording, errors in zip(recordings, self.left_out(recordings), strict=True)
        ]

    def as_claimed(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return the predictions of `impute` with the variances of the exact posterior."""
        return [errors.claimed for errors in self.left_out(recordings)]

    def _borne_out(self, recording: Recording, errors: LeftOut) -> Prediction:
        check, factors = VarianceCheck.of(recording, long_copies), errors.factors()
        if check.copies:
            factors = np.maximum(factors, check.factors(self.as_tried(check.trials())))
        return Prediction(errors.claimed.mean, np.asarray(errors.claimed.variance) * factors)
