"""Which registered models can fill what is hidden."""

from __future__ import annotations

from mocapbench.baselines.declarations.needs import describe_needs, find_met_needs
from mocapbench.benchmark.errors import UsageError
from mocapbench.benchmark.filling.costs import predict_seconds
from mocapbench.benchmark.filling.gap_problem import GapProblem, drop_unseen, pose_imputing
from mocapbench.benchmark.registry import MODELS, build_unfitted

__all__ = ["find_candidates", "require_candidate"]

_PROMISING = (
    "marker-kriging",
    "rigid-body",
    "pose-kriging",
    "channel-kriging",
    "lds",
)
"""Those that are the best in more files than others, after interpolation: they are never left out
for models that are seldom the best."""


def find_candidates(problem: GapProblem) -> tuple[str, ...]:
    """Return the models that can fill the gaps of a problem, in the order in which they start.

    Those that interpolate take little work and come first, then the most promising ones, then
    others by the work that they take, as predicted. All models learn from the recording that they
    fill, so that none has to fill new recordings.
    """
    ability, met = _find_ability(problem), find_met_needs(pose_imputing(problem))
    models = {name: build_unfitted(name) for name in MODELS.names()}
    able = [n for n, model in models.items() if ability in model.provides and model.needs <= met]
    first = (*(n for n in able if "interpolates" in models[n].provides), *_PROMISING)
    others = sorted({*able} - {*first}, key=lambda n: (predict_seconds(n, problem), n))
    return tuple(name for name in (*first, *others) if name in able)


def require_candidate(name: str, problem: GapProblem) -> None:
    """Refuse a model that cannot fill the gaps of a problem.

    Raises
    ------
    UsageError
        The message names the models that can.
    """
    model, ability = build_unfitted(name), _find_ability(problem)
    unmet = model.needs - find_met_needs(pose_imputing(problem))
    if ability in model.provides and not unmet:
        return
    texts = {"fills frames": "gaps", "fills entries": "frames of which some channels are visible"}
    raise UsageError(
        f"--model: expected a model that fills {texts[ability]}, got {name!r}"
        f"{', which needs ' if unmet else ''}{' and '.join(describe_needs(unmet))}; "
        f"choose {', '.join(find_candidates(problem))}"
    )


def _find_ability(problem: GapProblem) -> str:
    """Return the ability that it takes: the lesser one where every frame is whole or hidden."""
    visible = drop_unseen(problem).given.visible
    whole = bool((visible.all(axis=1) == visible.any(axis=1)).all())
    return "fills frames" if whole else "fills entries"
