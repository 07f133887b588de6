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
from mocapbench.benchmark.filling.question import GapQuestion, without_unseen
from mocapbench.benchmark.registry import MODELS

__all__ = ["able_models", "require_able"]

_TURNS = {Interpolator: 0, Spatial: 1, ChannelKriging: 2, BestOf: 4}
"""When models are tried; 3 for all others."""


def able_models(question: GapQuestion) -> tuple[str, ...]:
    """Return the models that have the abilities to answer, in the order in which they are tried.

    Those that interpolate take no time and come first, then those made for markers, where there are
    markers, and `ChannelKriging`, which is the best of the others more often than any: in a long
    recording there may be time for no more. The others come in the order of `max_frames`, no limit
    first. `BestOf`, which tries most of the others itself, is last. All models learn from the
    recording that they fill, so that none needs to be `Inductive`.
    """
    needed, barred = _ability_for(question), _marks_to_leave_out(question)
    names = [
        name
        for name in MODELS.names()
        if issubclass(MODELS.get(name), needed) and not issubclass(MODELS.get(name), barred)
    ]
    return tuple(sorted(names, key=lambda name: _turn(MODELS.get(name))))


def _turn(model: type[FrameImputer]) -> tuple[int, float]:
    turn = min((turn for kind, turn in _TURNS.items() if issubclass(model, kind)), default=3)
    return turn, -(model.max_frames or np.inf)


def require_able(name: str, question: GapQuestion) -> None:
    """Refuse a model that cannot answer.

    Raises
    ------
    UsageError
        The message names the models that can.
    """
    MODELS.get(name)
    able = able_models(question)
    if name in able:
        return
    reason = "frames of which some channels are visible"
    if issubclass(MODELS.get(name), Spatial):
        reason = "channels that are not the x, y and z of markers"
    elif _ability_for(question) is FrameImputer:
        reason = "gaps"
    raise UsageError(
        f"--model: expected a model that fills {reason}, got {name!r}; choose {', '.join(able)}"
    )


def _ability_for(question: GapQuestion) -> type[FrameImputer]:
    """Return the ability that it takes: the lesser one where every frame is whole or hidden."""
    visible = without_unseen(question).given.visible
    whole = bool((visible.all(axis=1) == visible.any(axis=1)).all())
    return FrameImputer if whole else Imputer


def _marks_to_leave_out(question: GapQuestion) -> tuple[type[Model], ...]:
    """Return the marks of models that take what there is not: a process, or markers."""
    has_markers = markers_of(question.given.channels, question.given.units)
    return (Informed, Misinformed) if has_markers else (Informed, Misinformed, Spatial)
