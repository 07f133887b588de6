"""Which registered models can fill what is hidden."""

from __future__ import annotations

from typing import Any

import numpy as np

from mocapbench.baselines.declarations.needs import describe_needs, find_met_needs
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.filling.gap_problem import GapProblem, drop_unseen, pose_imputing
from mocapbench.benchmark.registry import MODELS, build_unfitted

__all__ = ["find_candidates", "require_candidate"]

_ORDER = {"channel-kriging": 2, "best-of": 4}
"""In which models start, by their names; 3 for all others that need nothing but recordings."""


def find_candidates(problem: GapProblem) -> tuple[str, ...]:
    """Return the models that can fill the gaps of a problem, in the order in which they start.

    Those that interpolate take no time and come first, then those made for what there is, such as
    markers, and ``channel-kriging``, which is the best of the others more often than any: in a long
    recording there may be time for no more. The others come in the order of `max_frames`, no limit
    first. ``best-of``, which tries most of the others itself, is last. All models learn from the
    recording that they fill, so that none has to fill new recordings.
    """
    ability, met = _find_ability(problem), find_met_needs(pose_imputing(problem))
    models = {name: build_unfitted(name) for name in MODELS.names()}
    able = [
        name for name, model in models.items() if ability in model.provides and model.needs <= met
    ]
    return tuple(sorted(able, key=lambda name: _order_key(name, models[name])))


def _order_key(name: str, model: Any) -> tuple[int, float]:
    first = 0 if "interpolates" in model.provides else _ORDER.get(name, 1 if model.needs else 3)
    return first, -(model.max_frames or np.inf)


def require_candidate(name: str, problem: GapProblem) -> None:
    """Refuse a model that cannot fill the gaps of a problem.

    Raises
    ------
    UsageError
        The message names the models that can.
    """
    model, candidates = build_unfitted(name), find_candidates(problem)
    if name in candidates:
        return
    texts = {"fills frames": "gaps", "fills entries": "frames of which some channels are visible"}
    unmet = describe_needs(model.needs - find_met_needs(pose_imputing(problem)))
    raise UsageError(
        f"--model: expected a model that fills {texts[_find_ability(problem)]}, got {name!r}"
        f"{', which needs ' if unmet else ''}{' and '.join(unmet)}; "
        f"choose {', '.join(candidates)}"
    )


def _find_ability(problem: GapProblem) -> str:
    """Return the ability that it takes: the lesser one where every frame is whole or hidden."""
    visible = drop_unseen(problem).given.visible
    whole = bool((visible.all(axis=1) == visible.any(axis=1)).all())
    return "fills frames" if whole else "fills entries"
