"""The problem that a task file poses: fill what is hidden of one recording."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from mocapbench.baselines import Prediction
from mocapbench.benchmark.problems.body import Body, JointAngles
from mocapbench.benchmark.problems.impute import FilledRecordings, ImputeProblem
from mocapbench.benchmark.registry import METRICS
from mocapbench.benchmark.task_files.hiding.base import Hiding, HidingPlace
from mocapbench.benchmark.task_files.selection import Selection
from mocapbench.benchmark.tasks.seeds import Seeds
from mocapbench.datasets import Archive, Recording, SkeletonUnavailable

__all__ = ["Protocol", "defined_metrics", "own_body", "own_problem"]


@dataclass(frozen=True)
class Protocol:
    """What is done with a recording, whichever it is.

    Parameters
    ----------
    selection : Selection
        What is taken of it, and of those that models learn from.
    hiding : Hiding
        What is hidden of that.
    """

    selection: Selection
    hiding: Hiding


def own_problem(
    protocol: Protocol, test: str, training: tuple[str, ...], seeds: Seeds, archive: Archive
) -> ImputeProblem:
    """Hide the fold's entries of the recording at ``test``; models see what is left of it.

    Parameters
    ----------
    protocol : Protocol
    test : str
        Address of the recording.
    training : tuple of str
        Addresses of what models learn from besides.
    seeds, archive
        See `mocapbench.benchmark.tasks.base.Case`.

    Raises
    ------
    ValueError
        If the recordings do not have what the protocol asks for.
    """
    recording = protocol.selection.of(archive.recording(test))
    place = HidingPlace(seeds.fold, seeds.generator("mask"), archive)
    return ImputeProblem.of_one(
        recording,
        protocol.hiding.mask(recording, place),
        [
            protocol.selection.of(archive.recording(uri)).select(recording.channels)
            for uri in training
        ],
        body=own_body(recording, test, archive),
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
    known = Prediction(np.nan_to_num(truth), np.ones(truth.shape))
    outcome = problem.outcome(FilledRecordings((known,)))
    return tuple(name for name in names if METRICS.get(name).applies(outcome))
