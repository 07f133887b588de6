"""Samples of a model, and the recordings to compare them with."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mocapbench.basics.arrays import Array
from mocapbench.metrics.outcomes.arrays import lock_numbers
from mocapbench.metrics.outcomes.poses import SampledPoses, place

__all__ = ["Synthesis"]


@dataclass(frozen=True, eq=False)
class Synthesis:
    """Sampled recordings, and the reference recordings to compare them with.

    Nested lists are taken as arrays, which are read-only.

    Parameters
    ----------
    samples : ndarray of shape (S, N, D)
        Sampled recordings, noise included.
    references : ndarray of shape (M, N, D)
        Reference recordings on the same number of frames.
    place_joints : callable or None
        Places the joints of samples and references in space, where the outputs say how; called at
        most once, and only if a metric asks for `poses`.

    Raises
    ------
    ValueError
        If samples or references are not real numbers, shapes disagree, there is no sample or no
        reference, or a value is not finite; on access to `poses`, if the outcome has no
        ``place_joints``.
    """

    samples: Array
    references: Array
    place_joints: Callable[[], SampledPoses] | None = None

    def __post_init__(self) -> None:
        lock_numbers(self, "samples", "references")
        samples, references = self.samples, self.references
        same = samples.ndim == references.ndim == 3 and samples.shape[1:] == references.shape[1:]
        if not same or min(samples.size, references.size) == 0:
            raise ValueError(
                "expected at least one sample and one reference with equal (frames, outputs), "
                f"got shapes {samples.shape} and {references.shape}"
            )
        if not (np.isfinite(samples).all() and np.isfinite(references).all()):
            raise ValueError("expected finite samples and references, got NaN or infinity")

    @cached_property
    def poses(self) -> SampledPoses:
        """The joints of samples and references in space."""
        return place(self.place_joints)
