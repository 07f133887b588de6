"""Filled channels beside the truth, after Pan and Torresani 2009 (HLM), Figure 4."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mocapbench.benchmark.figures.solved import Solved
from mocapbench.benchmark.problems.impute import ImputeProblem, Predictions
from mocapbench.reports import Axes, Curve, Illustration

__all__ = ["draw_filled_channels"]


def draw_filled_channels(
    solved: Solved[ImputeProblem, Predictions], /, channels: tuple[str, ...]
) -> Sequence[Illustration]:
    """Return channels of the first recording, by the papers' models and the best of the others.

    One picture, with a panel per channel.

    Parameters
    ----------
    solved : Solved
    channels : tuple of str
    """
    recording, truth = solved.problem.given[0], solved.problem.truth[0]
    filled = {
        label: np.where(recording.visible, np.nan, solved.solutions[label][0].mean)
        for label in _of_interest(solved)
    }
    caption = (
        f"{recording.name}: the truth, and the values that the paper’s models and the best of "
        "the other models of this run put where it is hidden."
    )
    panels = []
    for channel in channels:
        column = recording.channels.index(channel)
        curves = tuple(
            Curve(recording.times, values[:, column], label)
            for label, values in {"truth": truth, **filled}.items()
        )
        panels.append(Axes(channel, "time, s", recording.units[column], curves))
    return (Illustration(solved.task, "Filled channels", caption, tuple(panels)),)


def _of_interest(solved: Solved[ImputeProblem, Predictions]) -> list[str]:
    """Return the labels that the paper has too, and the best of the others."""
    hidden, truth = ~solved.problem.given[0].visible, solved.problem.truth[0]
    errors = {
        label: float(((solution[0].mean - truth)[hidden] ** 2).mean())
        for label, solution in solved.solutions.items()
    }
    papers = [label for label in errors if label in solved.papers]
    others = sorted(set(errors) - set(papers), key=errors.__getitem__)
    return [*papers, *others[:1]]
