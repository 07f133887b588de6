r"""What no resemblance scores: samples of a process that generated none of the recordings.

A measure of similarity makes sense only if such samples score worse than those of a model that has
learnt something (thesis §A.4.1).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Self

import numpy as np
from sklearn.utils.validation import check_is_fitted

from mocapbench.baselines.common.recordings import check_outputs, check_recordings
from mocapbench.baselines.protocols import Misinformed, SampleByFrameByChannel, Synthesiser
from mocapbench.datasets import Frames, Recording, ToyProcess
from mocapbench.datasets.process import draw_gaussian

__all__ = ["Control"]


class Control(Synthesiser, Misinformed):
    """Draw children of an unrelated process, each of a parent of its own.

    Attributes
    ----------
    process_ : ToyProcess
        The process that it was told.
    """

    def misinform(self, process: ToyProcess) -> Self:
        """Take a process that generated none of the recordings."""
        self.process_ = process
        return self

    def fit(self, recordings: Sequence[Recording]) -> Self:
        """Learn nothing.

        Raises
        ------
        ValueError
            If no process is known, or the recordings' channels differ or are not its outputs.
        """
        check_is_fitted(self, "process_", msg="expected a process: call misinform first")
        check_outputs(check_recordings(recordings), self.process_)
        return self

    def sample(
        self, times: Frames, n_samples: int, random_state: int | np.random.Generator
    ) -> SampleByFrameByChannel:
        """Return ``n_samples`` children of as many parents, noise included: (n, N, D)."""
        check_is_fitted(self, "process_")
        rng = np.random.default_rng(random_state)
        curves = draw_gaussian(rng, self.process_.covariance(np.asarray(times)), n_samples)
        return curves.reshape(n_samples, self.process_.n_outputs, -1).transpose(0, 2, 1)
