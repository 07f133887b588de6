"""Positions of joints in space: what metrics in centimetres compare."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from mocapbench.basics.arrays import Mask
from mocapbench.metrics.outcomes.arrays import lock_fields

__all__ = ["ImputedPoses", "SampledPoses", "place"]

Positions = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class ImputedPoses:
    """Joint positions of the truth and of a prediction, recordings one below the other.

    Its arrays are read-only.

    Parameters
    ----------
    truth, mean : ndarray of shape (N, J, 3)
        Centimetres; the second axis points up. Where nothing is hidden, both are equal.
    hidden : ndarray of bool, shape (N, J)
        True where a joint's position depends on a hidden entry.
    hidden_relative : ndarray of bool, shape (N, J)
        True where its position relative to the root does.
    joints : tuple of J str
        Names; the first is the root.
    parents : tuple of J int
        Index of the joint at the other end of each bone, -1 for the root.
    times : ndarray of shape (N,)
        Seconds, increasing within a recording.
    starts : tuple of int
        The first frame of each recording.
    spread : ndarray of shape (J, 3) or None
        Standard deviations of coordinates in training, by which errors may be divided.

    Raises
    ------
    ValueError
        If shapes disagree.
    """

    truth: Positions
    mean: Positions
    hidden: Mask
    hidden_relative: Mask
    joints: tuple[str, ...]
    parents: tuple[int, ...]
    times: NDArray[np.float64]
    starts: tuple[int, ...] = (0,)
    spread: Positions | None = None

    def __post_init__(self) -> None:
        shape = (len(self.times), len(self.joints))
        shapes = [self.truth.shape[:2], self.mean.shape[:2], self.hidden.shape]
        if {*shapes, self.hidden_relative.shape} != {shape} or len(self.parents) != shape[1]:
            raise ValueError(
                f"expected positions and masks of {shape} frames and joints, a time per frame and "
                f"a parent per joint; got shapes {shapes} and {len(self.parents)} parents"
            )
        fields = ("truth", "mean", "hidden", "hidden_relative", "times")
        lock_fields(self, **{name: getattr(self, name) for name in fields})

    @property
    def errors(self) -> NDArray[np.float64]:
        """(N, J) Distance of each predicted joint from the true one, in centimetres."""
        return np.asarray(np.linalg.norm(self.mean - self.truth, axis=2))

    @property
    def relative(self) -> tuple[Positions, Positions]:
        """Positions of the truth and of the prediction relative to the root, each (N, J, 3)."""
        return self.truth - self.truth[:, :1], self.mean - self.mean[:, :1]


@dataclass(frozen=True, eq=False)
class SampledPoses:
    """Joint positions of samples and of references, all on one body.

    Its arrays are read-only.

    Parameters
    ----------
    samples : ndarray of shape (S, N, J, 3)
        Centimetres; the second axis points up.
    references : ndarray of shape (M, N, J, 3)
    joints : tuple of J str
        Names; the first is the root.
    times : ndarray of shape (N,)
        Seconds.
    """

    samples: Positions
    references: Positions
    joints: tuple[str, ...]
    times: NDArray[np.float64]

    def __post_init__(self) -> None:
        lock_fields(self, samples=self.samples, references=self.references, times=self.times)


PosesT = TypeVar("PosesT", ImputedPoses, SampledPoses)


def place(place_joints: Callable[[], PosesT] | None) -> PosesT:
    """Return the joints of an outcome in space.

    Raises
    ------
    ValueError
        If it has no function that places them.
    """
    if place_joints is None:
        raise ValueError(
            "expected an outcome with poses, got one without a skeleton: give place_joints"
        )
    return place_joints()
