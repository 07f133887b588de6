"""Latent spaces of three dimensions and walks through them.

After Wang, Fleet and Hertzmann 2008 (GPDM), Figures 3 to 11.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from mocapbench.basics.arrays import Array
from mocapbench.benchmark.figures.solved import Solved
from mocapbench.benchmark.figures.stick_figures import strip
from mocapbench.benchmark.problems.arrays import Arrays, arrays_by_number, with_prefix
from mocapbench.benchmark.problems.impute import ImputeProblem, Predictions
from mocapbench.datasets import Recording
from mocapbench.reports import Illustration, Picture, Space

__all__ = ["draw_latent_spaces"]

TRAINING, MEAN, SAMPLE = "training", "mean prediction", "fair sample"


def draw_latent_spaces(
    solved: Solved[ImputeProblem, Predictions], /, labels: tuple[str, ...]
) -> Sequence[Picture]:
    """Return the latent space of each entrant named, then motions along walks through them.

    One picture per latent space, and one of all walks.

    Parameters
    ----------
    solved : Solved
    labels : tuple of str
        Entrants; those that did not run, or have no such space, are left out.
    """
    internals = {label: solved.internals[label] for label in labels if label in solved.internals}
    spaces = [
        _space(solved.task, label, arrays)
        for label, arrays in internals.items()
        if "latent-cloud" in arrays
    ]
    return [*spaces, *_walks(solved, internals)]


def _space(task: str, label: str, arrays: Arrays) -> Space:
    properties = with_prefix("property", arrays)
    listed = ", ".join(f"{name} {float(value):.3g}" for name, value in properties.items())
    walked = ""
    if "latent-mean" in arrays:
        n_frames = len(arrays["latent-mean"])
        walked = f"; the mean prediction and fair samples of {n_frames} frames from the first one"
    caption = (
        f"latent positions of the training frames by {label}, and the confidence −ln σ² with "
        f"which poses are reconstructed around them{walked}. Kernels: {listed}."
    )
    cloud = np.asarray(arrays["latent-cloud"], dtype=np.float64)
    return Space(
        task,
        f"Latent space of {label}",
        caption,
        tuple(_paths(arrays)),
        cloud[:, :3],
        cloud[:, 3],
        "−ln σ²",
    )


def _paths(arrays: Arrays) -> Iterator[tuple[str, Array]]:
    yield from ((TRAINING, points) for points in arrays_by_number("latent-path", arrays))
    yield from ((SAMPLE, points) for points in arrays_by_number("latent-sample", arrays))
    if "latent-mean" in arrays:
        yield MEAN, arrays["latent-mean"]


def _walks(
    solved: Solved[ImputeProblem, Predictions], internals: Mapping[str, Arrays]
) -> Sequence[Illustration]:
    """Return stick figures of the mean prediction and of a fair sample of each entrant."""
    body, about = solved.problem.body, solved.problem.train[0]
    walks = {label: arrays for label, arrays in internals.items() if "walk-mean" in arrays}
    if body is None or not walks:
        return ()
    panels = tuple(
        strip(poses, body, [group] * len(poses.times), f"{label}: {group}, ")
        for label, arrays in walks.items()
        for group, poses in (
            (MEAN, _record_walk(label, arrays["walk-mean"], about)),
            (SAMPLE, _record_walk(label, arrays["walk-sample"], about)),
        )
    )
    caption = (
        "mean poses along the mean prediction and along one fair sample of the latent dynamics, "
        "from the first training frame."
    )
    return (Illustration(solved.task, "Motions from the dynamics", caption, panels),)


def _record_walk(label: str, poses: Array, about: Recording) -> Recording:
    """Return poses (N, D) as a recording at the rate of another one."""
    duration = float(np.diff(about.times).mean()) * (len(poses) - 1)
    times = np.linspace(0.0, duration, len(poses))
    return Recording(label, times, poses, about.channels, about.units)
