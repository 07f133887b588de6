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
from mocapbench.benchmark.problems.internals import Internals
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
        _space(solved.task, label, of_label.latent_space, of_label.latent_walks)
        for label, of_label in internals.items()
        if of_label.latent_space is not None and "latent-cloud" in of_label.latent_space
    ]
    return [*spaces, *_walks(solved, internals)]


def _space(task: str, label: str, space: Arrays, walks: Arrays | None) -> Space:
    properties = with_prefix("property", space)
    listed = ", ".join(f"{name} {float(value):.3g}" for name, value in properties.items())
    walked = ""
    if walks is not None:
        n_frames = len(walks["latent-mean"])
        walked = f"; the mean prediction and fair samples of {n_frames} frames from the first one"
    caption = (
        f"latent positions of the training frames by {label}, and the confidence −ln σ² with "
        f"which poses are reconstructed around them{walked}. Kernels: {listed}."
    )
    cloud = np.asarray(space["latent-cloud"], dtype=np.float64)
    return Space(
        task,
        f"Latent space of {label}",
        caption,
        tuple(_paths(space, walks)),
        cloud[:, :3],
        cloud[:, 3],
        "−ln σ²",
    )


def _paths(space: Arrays, walks: Arrays | None) -> Iterator[tuple[str, Array]]:
    yield from ((TRAINING, points) for points in arrays_by_number("latent-path", space))
    if walks is not None:
        samples = arrays_by_number("latent-sample", walks)
        yield from ((SAMPLE, points) for points in samples)
        yield MEAN, walks["latent-mean"]


def _walks(
    solved: Solved[ImputeProblem, Predictions], internals: Mapping[str, Internals]
) -> Sequence[Illustration]:
    """Return stick figures of the mean prediction and of a fair sample of each entrant."""
    body, about = solved.problem.body, solved.problem.train[0]
    walks = {
        label: of_label.latent_walks
        for label, of_label in internals.items()
        if of_label.latent_walks is not None
    }
    if body is None or not walks:
        return ()
    step = float(np.diff(about.times).mean())
    longest = max(len(walk["walk-mean"]) for walk in walks.values())
    times = np.linspace(0.0, step * (longest - 1), longest)
    panels = tuple(
        strip(
            Recording(label, times[: len(poses)], poses, about.channels, about.units),
            body,
            [group] * len(poses),
            f"{label}: {group}, ",
        )
        for label, walk in walks.items()
        for poses, group in ((walk["walk-mean"], MEAN), (walk["walk-sample"], SAMPLE))
    )
    caption = (
        "mean poses along the mean prediction and along one fair sample of the latent dynamics, "
        "from the first training frame."
    )
    return (Illustration(solved.task, "Motions from the dynamics", caption, panels),)
