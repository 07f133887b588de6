"""Which registered models can fill what is hidden."""

from __future__ import annotations

import numpy as np

from mocapbench.baselines import (
    BestOf,
    ChannelKriging,
    FrameImputer,
    Imputer,
    Informed,
    Interpolator,
    Misinformed,
    Model,
    Spatial,
)
from mocapbench.baselines.common.markers import markers_of
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.filling.problem import GapProblem, drop_unseen
from mocapbench.benchmark.registry import MODELS

__all__ = ["find_candidates", "require_candidate"]

_ORDER = {Interpolator: 0, Spatial: 1, ChannelKriging: 2, BestOf: 4}
"""In which models start; 3 for all others."""


def find_candidates(problem: GapProblem) -> tuple[str, ...]:
    """Return the models that can fill the gaps of a problem, in the order in which they start.

    Those that interpolate take no time and come first, then those made for markers, where there are
    markers, and `ChannelKriging`, which is the best of the others more often than any: in a long
    recording there may be time for no more. The others come in the order of `max_frames`, no limit
    first. `BestOf`, which tries most of the others itself, is last. All models learn from the
    recording that they fill, so that none needs to be `Inductive`.
    """
    needed, barred = _find_ability(problem), _find_marks_to_leave_out(problem)
    names = [
        name
        for name in MODELS.names()
        if issubclass(MODELS.get(name), needed) and not issubclass(MODELS.get(name), barred)
    ]
    return tuple(sorted(names, key=lambda name: _order_key(MODELS.get(name))))


def _order_key(model: type[FrameImputer]) -> tuple[int, float]:
    first = min((place for kind, place in _ORDER.items() if issubclass(model, kind)), default=3)
    return first, -(model.max_frames or np.inf)


def require_candidate(name: str, problem: GapProblem) -> None:
    """Refuse a model that cannot fill the gaps of a problem.

    Raises
    ------
    UsageError
        The message names the models that can.
    """
    MODELS.get(name)
    candidates = find_candidates(problem)
    if name in candidates:
        return
    reason = "frames of which some channels are visible"
    if issubclass(MODELS.get(name), Spatial):
        reason = "channels that are not the x, y and z of markers"
    elif _find_ability(problem) is FrameImputer:
        reason = "gaps"
    raise UsageError(
        f"--model: expected a model that fills {reason}, got {name!r}; "
        f"choose {', '.join(candidates)}"
    )


def _find_ability(problem: GapProblem) -> type[FrameImputer]:
    """Return the ability that it takes: the lesser one where every frame is whole or hidden."""
    visible = drop_unseen(problem).given.visible
    whole = bool((visible.all(axis=1) == visible.any(axis=1)).all())
    return FrameImputer if whole else Imputer


def _find_marks_to_leave_out(problem: GapProblem) -> tuple[type[Model], ...]:
    """Return the marks of models that take what there is not: a process, or markers."""
    has_markers = markers_of(problem.given.channels, problem.given.units)
    return (Informed, Misinformed) if has_markers else (Informed, Misinformed, Spatial)
