"""The problem of drawing new recordings."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from mocapbench.benchmark.problems.arrays import Arrays
from mocapbench.benchmark.problems.base import InvalidPredictionError, Problem
from mocapbench.benchmark.problems.body import Body
from mocapbench.benchmark.problems.placement import sampled_poses
from mocapbench.datasets import FrameByChannel, Frames
from mocapbench.metrics import SampledPoses, Synthesis

if TYPE_CHECKING:
    from mocapbench.baselines import SampleByFrameByChannel, Synthesiser

__all__ = ["SynthesiseProblem"]


@dataclass(frozen=True, eq=False)
class SynthesiseProblem(Problem["SampleByFrameByChannel"]):
    """Draw new recordings that resemble the references.

    Parameters
    ----------
    train : tuple of Recording
        What `fit` gets.
    times : ndarray of shape (N,)
        When to draw.
    n_samples : int
    references : tuple of ndarray (N, D)
        Recordings that no model sees.
    body : Body or None
        On which samples and references are placed in space, for metrics of positions.
    process : ToyProcess or None
        The process that generated them, for models that need it.
    control : ToyProcess or None
        A process that generated neither the recordings nor the references, for models that need it.
    parent : Recording or None
        The curves of the parent that a known process drew, which no model sees.
    """

    times: Frames
    n_samples: int
    references: tuple[FrameByChannel, ...]
    body: Body | None = None

    def solve(self, model: Synthesiser, random_state: int) -> SampleByFrameByChannel:
        """Return the model's samples (n, N, D)."""
        samples = np.asarray(model.sample(self.times, self.n_samples, random_state))
        expected = (self.n_samples, *self.references[0].shape)
        if samples.shape != expected or not np.isfinite(samples).all():
            raise InvalidPredictionError(
                f"sample: expected finite samples of shape {expected}, got shape {samples.shape} "
                f"with {int((~np.isfinite(samples)).sum())} entries that are NaN or infinite"
            )
        return samples

    def outcome(self, solution: SampleByFrameByChannel) -> Synthesis:
        """Set the samples beside the references."""
        return Synthesis(solution, np.stack(self.references), self._placement(solution))

    def to_arrays(self, solution: SampleByFrameByChannel) -> Arrays:
        """Return ``samples``."""
        return {"samples": solution}

    def from_arrays(self, arrays: Arrays) -> SampleByFrameByChannel:
        """Return the solution that `to_arrays` turned into ``arrays``."""
        return arrays["samples"]

    def _placement(self, solution: SampleByFrameByChannel) -> Callable[[], SampledPoses] | None:
        if self.body is None:
            return None
        like = replace(self.train[0], times=self.times, values=self.references[0])
        return partial(sampled_poses, self.body, like, tuple(solution), self.references)
