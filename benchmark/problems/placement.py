"""Places the joints of a truth, a solution, samples and references in space."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import accumulate
from typing import TYPE_CHECKING

import numpy as np

from mocapbench.benchmark.problems.body import Body
from mocapbench.datasets import FrameByChannel, FrameByJointBy3, Recording
from mocapbench.metrics import ImputedPoses, SampledPoses

if TYPE_CHECKING:
    from mocapbench.baselines import Prediction

__all__ = ["imputed_poses", "sampled_poses"]


def imputed_poses(
    body: Body,
    given: Sequence[Recording],
    truth: Sequence[FrameByChannel],
    predictions: Sequence[Prediction],
) -> ImputedPoses:
    """Return the joints of complete recordings and of what was filled in, in space.

    Parameters
    ----------
    body : Body
    given : sequence of Recording
        The recordings to fill; NaN marks what is hidden.
    truth : sequence of ndarray (N, D)
        Their values. What is NaN here too is taken as the prediction has it, and not scored.
    predictions : sequence of Prediction
        Of which only hidden entries count.
    """
    means = [
        np.where(recording.visible, values, prediction.mean)
        for recording, values, prediction in zip(given, truth, predictions, strict=True)
    ]
    known = [np.isfinite(values) for values in truth]
    truth = [np.where(seen, *pair) for seen, *pair in zip(known, truth, means, strict=True)]
    hidden = np.concatenate([~recording.visible for recording in given]) & np.concatenate(known)
    depends = body.dependence(given[0].channels)
    # What moves a joint and the root alike moves it not relative to the root.
    relative = depends ^ depends[0]
    lengths = [len(recording.times) for recording in given]
    placed = _place_joints(body, [*given, *given], [*truth, *means])
    return ImputedPoses(
        truth=placed[: len(hidden)],
        mean=placed[len(hidden) :],
        hidden=hidden @ depends.T,
        hidden_relative=hidden @ relative.T,
        joints=_joints(body),
        parents=body.skeleton.parents,
        times=np.concatenate([recording.times for recording in given]),
        starts=tuple(accumulate(lengths[:-1], initial=0)),
    )


def sampled_poses(
    body: Body,
    like: Recording,
    samples: Sequence[FrameByChannel],
    references: Sequence[FrameByChannel],
) -> SampledPoses:
    """Return the joints of samples and references in space, all on one body.

    Parameters
    ----------
    body : Body
    like : Recording
        With the times and channels of samples and references.
    samples, references : sequence of ndarray (N, D)
    """
    alike = [[like] * len(motions) for motions in (samples, references)]
    shape = (-1, len(like.times), len(body.skeleton.segments), 3)
    return SampledPoses(
        samples=_place_joints(body, alike[0], samples).reshape(shape),
        references=_place_joints(body, alike[1], references).reshape(shape),
        joints=_joints(body),
        times=like.times,
    )


def _place_joints(
    body: Body, recordings: Sequence[Recording], values: Sequence[FrameByChannel]
) -> FrameByJointBy3:
    """Return the joints of the recordings with other values, one below the other."""
    return body.positions(*map(Recording.with_values, recordings, values))


def _joints(body: Body) -> tuple[str, ...]:
    return tuple(segment.name for segment in body.skeleton.segments)
