"""Models whose variances a recording's own trials can check."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence

from sklearn.base import clone
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.common.checks import check_channels, pool
from mocapbench.baselines.protocols import FrameImputer, Prediction
from mocapbench.datasets import Recording

__all__ = ["OneByOne", "Relearning", "Widened"]


class Widened(FrameImputer):
    """A model whose variances are checked by trials when it fills recordings."""

    channels_: tuple[str, ...]
    """The channels of the recordings given to ``fit``, which sets them."""
    units_: tuple[str, ...]
    """Their units."""

    @abstractmethod
    def as_claimed(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return the predictions of `impute`, with the variances that the model itself claims."""

    def as_tried(self, trials: Sequence[Recording]) -> list[Prediction]:
        """Return what it claims of recordings of which more is hidden."""
        return self.as_claimed(trials)

    def least_claimed(self, recordings: Sequence[Recording]) -> Sequence[Prediction | None]:
        """Return predictions with the least variances that the visible entries bear out.

        Where trials of a recording show what it claims to be too large, variances are made smaller,
        but no smaller than these. A model that knows of none returns None for each recording.
        """
        return [None] * len(recordings)

    def _check_given(self, recordings: Sequence[Recording]) -> None:
        """Check that the model is fitted, and to recordings of these channels and units."""
        check_is_fitted(self)
        check_channels(recordings, self.channels_, self.units_)


class OneByOne(Widened):
    """A model that claims something of each recording by itself, whatever others are given."""

    def as_claimed(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return the predictions of `impute`, with the variances that the model itself claims."""
        self._check_given(recordings)
        return [self._claimed(recording) for recording in recordings]

    @abstractmethod
    def _claimed(self, recording: Recording) -> Prediction:
        """Return what the fitted model claims of a recording with its channels and units."""


class Relearning(Widened):
    """A model that learns anew for the trials of a recording from which it has learnt.

    Otherwise its parameters would have seen what a trial hides, and it would err less in trials
    than in gaps.
    """

    recordings_: Sequence[Recording]
    """The recordings given to ``fit``, which sets them."""

    def as_tried(self, trials: Sequence[Recording]) -> list[Prediction]:
        """Return what it claims of recordings of which more is hidden, not having seen that."""
        self._check_given(trials)
        known = {recording.name for recording in self.recordings_}
        strangers = [trial for trial in trials if trial.name not in known]
        answers = iter(self.as_claimed(strangers) if strangers else ())
        return [self._anew(trial) if trial.name in known else next(answers) for trial in trials]

    def _anew(self, trial: Recording) -> Prediction:
        relearnt: Relearning = clone(self)
        try:
            return relearnt.fit(pool(self.recordings_, [trial])).as_claimed([trial])[0]
        except ValueError:  # a trial may leave too little to learn from
            return self.as_claimed([trial])[0]
