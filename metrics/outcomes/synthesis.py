"""Samples of a model, and the recordings to compare them with."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

from mocapbench.metrics.outcomes.arrays import Array, lock_numbers
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
        If samples or references are not real numbers; on access to `poses`, if the outcome has no
        ``place_joints``.
    """

    samples: Array
    references: Array
    place_joints: Callable[[], SampledPoses] | None = None

    def __post_init__(self) -> None:
        lock_numbers(self, "samples", "references")

    @cached_property
    def poses(self) -> SampledPoses:
        """The joints of samples and references in space."""
        return place(self.place_joints)
