"""Variances that a recording's own trials have checked.

A model may claim too much of a recording that is unlike its training, such as the walk of a
stranger. Trials hide more of the recording where the truth is visible, and the variances of the
gaps are multiplied by what they show (`variance_check`). Means stay as they are.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from itertools import islice

from sklearn.base import clone

from mocapbench.baselines.common.recordings import pool
from mocapbench.baselines.protocols import Model, Prediction
from mocapbench.baselines.rehearsal.variance_check import VarianceCheck
from mocapbench.datasets import Recording

__all__ = ["Relearning", "Widened", "widened"]


class Widened(Model):
    """A model whose variances are checked by trials when it fills recordings."""

    @abstractmethod
    def as_claimed(self, recordings: Sequence[Recording]) -> list[Prediction]:
        """Return the predictions of `impute`, with the variances that the model itself claims."""

    def as_tried(self, trials: Sequence[Recording]) -> list[Prediction]:
        """Return what it claims of recordings of which more is hidden."""
        return self.as_claimed(trials)


class Relearning(Widened):
    """A model that learns anew for the trials of a recording from which it has learnt.

    Otherwise its parameters would have seen what a trial hides, and it would err less in trials
    than in gaps.
    """

    learnt_from_: Sequence[Recording]
    """The recordings given to ``fit``, which sets them."""

    def as_tried(self, trials: Sequence[Recording]) -> list[Prediction]:
        """Return what it claims of recordings of which more is hidden, not having seen that."""
        known = {recording.name for recording in self.learnt_from_}
        strangers = [trial for trial in trials if trial.name not in known]
        answers = iter(self.as_claimed(strangers) if strangers else ())
        return [self._anew(trial) if trial.name in known else next(answers) for trial in trials]

    def _anew(self, trial: Recording) -> Prediction:
        relearnt: Relearning = clone(self)
        try:
            return relearnt.fit(pool(self.learnt_from_, [trial])).as_claimed([trial])[0]
        except ValueError:  # a trial may leave too little to learn from
            return self.as_claimed([trial])[0]


def widened(model: Widened, recordings: Sequence[Recording]) -> list[Prediction]:
    """Return a model's predictions of recordings, with variances that their trials bear out.

    Parameters
    ----------
    model : Widened
        What it claims of one recording may not depend on the others.
    recordings : sequence of Recording
    """
    checks = [VarianceCheck.of(recording) for recording in recordings]
    trials = [trial for check in checks for trial in check.trials()]
    answers = iter(model.as_tried(trials) if trials else ())
    return [
        check.applied(claimed, list(islice(answers, check.n_trials)))
        for check, claimed in zip(checks, model.as_claimed(recordings), strict=True)
    ]
