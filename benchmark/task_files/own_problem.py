"""The problem that a task file poses: fill what is hidden of one recording."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np

from mocapbench import baselines
from mocapbench.benchmark.problems.body import Body, JointAngles
from mocapbench.benchmark.problems.impute import ImputeProblem
from mocapbench.benchmark.registry import METRICS
from mocapbench.benchmark.task_files.hiding import Hiding, HidingPlace
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import Archive, Recording, SkeletonUnavailable

__all__ = ["defined_metrics", "own_body", "own_problem"]


def own_problem(
    select: Callable[[Recording], Recording],
    hide: Hiding,
    uris: tuple[str, ...],
    seeds: Seeds,
    archive: Archive,
) -> ImputeProblem:
    """Hide the fold's entries of a recording; models see what is left of it.

    Parameters
    ----------
    select : callable
        Returns what is taken of a recording, here and of those that models learn from.
    hide : Hiding
        Returns what is hidden of that.
    uris : tuple of str
        Addresses of the recording to fill, and of what models learn from besides.
    seeds, archive
        See `mocapbench.benchmark.tasks.base.Case`.

    Raises
    ------
    ValueError
        If the recordings do not have what is asked of them.
    """
    recording, *others = (select(archive.recording(uri)) for uri in uris)
    place = HidingPlace(seeds.fold, seeds.generator("mask"), archive)
    return ImputeProblem.of_one(
        recording,
        hide(recording, place),
        [other.select(recording.channels) for other in others],
        body=own_body(recording, uris[0], archive),
    )


def own_body(recording: Recording, uri: str, archive: Archive) -> Body | None:
    """Return what places the joints, if the file has a skeleton and the recording all of it."""
    try:
        skeleton = archive.skeleton(uri)
    except SkeletonUnavailable:
        return None
    needed = {f"{segment}.{freedom}" for segment, of in skeleton.moving.items() for freedom in of}
    whole = needed <= {*recording.channels} and recording.visible.all()
    return JointAngles(skeleton) if whole else None


def defined_metrics(names: Iterable[str], problem: ImputeProblem) -> tuple[str, ...]:
    """Return the metrics that are defined for the true values, had a model found these."""
    (truth,) = problem.truth
    known = baselines.Prediction(np.nan_to_num(truth), np.ones(truth.shape))
    outcome = problem.outcome((known,))
    return tuple(name for name in names if METRICS.get(name).applies(outcome))
