"""The problem of drawing new recordings."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mocapbench.baselines import Misinformed, Model, Synthesiser
from mocapbench.benchmark.problems.base import InvalidPredictionError, Problem, Solution
from mocapbench.datasets import FrameByChannel, Frames, ToyProcess
from mocapbench.metrics import Synthesis

__all__ = ["SynthesiseProblem"]


@dataclass(frozen=True, eq=False)
class SynthesiseProblem(Problem):
    """Draw new recordings that resemble the references.

    Parameters
    ----------
    times : ndarray of shape (N,)
        When to draw.
    n_samples : int
    references : tuple of ndarray (N, D)
        Recordings that no model sees.
    control : ToyProcess or None
        A process that generated neither the recordings nor the references, for models that must
        be told one.
    """

    times: Frames
    n_samples: int
    references: tuple[FrameByChannel, ...]
    control: ToyProcess | None = None

    def fit(self, model: Model) -> Model:
        """Fit ``model`` to what it may see."""
        if self.control is not None and isinstance(model, Misinformed):
            model.misinform(self.control)
        return super().fit(model)

    def solve(self, model: Synthesiser, random_state: int) -> Solution:
        """Return ``samples`` (n, N, D)."""
        samples = np.asarray(model.sample(self.times, self.n_samples, random_state))
        expected = (self.n_samples, *self.references[0].shape)
        if samples.shape != expected or not np.isfinite(samples).all():
            raise InvalidPredictionError(
                f"sample: expected finite samples of shape {expected}, got shape {samples.shape} "
                f"with {int((~np.isfinite(samples)).sum())} entries that are NaN or infinite"
            )
        return {"samples": samples}

    def outcome(self, solution: Solution) -> Synthesis:
        """Set the samples beside the references."""
        return Synthesis(solution["samples"], np.stack(self.references))
