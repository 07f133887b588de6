"""Estimated coregionalisation matrices, by layer and component.

After J. D. Gil López, *Hierarchical Multiple Output Gaussian Processes for Human Motion Data*, MSc
thesis, Universidad Tecnológica de Pereira, 2017, Figures 14–16.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mocapbench.benchmark.figures.solved import Solved
from mocapbench.benchmark.problems.arrays import with_prefix
from mocapbench.reports import HeatMaps

__all__ = ["draw_coregionalisation"]


def draw_coregionalisation(
    solved: Solved[Any, Any],
    /,
    label: str,
    joint_groups: Mapping[str, tuple[str, ...]] = MappingProxyType({}),
) -> Sequence[HeatMaps]:
    """Return the matrices of one entrant: of all joints, and of groups of joints by themselves.

    One picture of all joints, then one per group.

    Parameters
    ----------
    solved : Solved
    label : str
        The entrant; nothing is drawn if it did not run.
    joint_groups : mapping of str to tuple of str
        Joints whose part of the matrices is shown by itself, by a name for the group.
    """
    if label not in solved.internals:
        return ()
    channels = solved.problem.train[0].channels
    layers = _correlations(with_prefix("coregionalisation", solved.internals[label]))
    joints = [channel.partition(".")[0] for channel in channels]
    pictures = [_picture(solved.task, f"{label}, all joints", joints, layers)]
    for title, group in joint_groups.items():
        chosen = [place for place, joint in enumerate(joints) if joint in group]
        names = [channels[place] for place in chosen]
        parts = {name: matrices[:, chosen][:, :, chosen] for name, matrices in layers.items()}
        pictures.append(_picture(solved.task, f"{label}, {title}", names, parts))
    return pictures


def _picture(
    task: str, of: str, labels: Sequence[str], layers: Mapping[str, NDArray[np.float64]]
) -> HeatMaps:
    return HeatMaps(
        task=task,
        title=f"Coregionalisation by {of}",
        caption=(
            "the matrices B of each layer and component, divided by the roots of the layer's "
            "variances, so that the components of a layer add up to its matrix of correlations."
        ),
        labels=tuple(labels),
        maps={
            f"{layer}, component {q}": matrix
            for layer, matrices in layers.items()
            for q, matrix in enumerate(matrices, start=1)
        },
        limit=1.0,
        columns=max(map(len, layers.values())),
    )


def _correlations(
    layers: Mapping[str, NDArray[np.float64]],
) -> dict[str, NDArray[np.float64]]:
    """Return each layer's matrices (Q, D, D) over the roots of the layer's variances."""
    scaled = {}
    for layer, matrices in layers.items():
        scale = np.sqrt(np.diagonal(matrices.sum(axis=0)))
        scaled[layer] = matrices / np.outer(scale, scale)
    return scaled
