"""What a user asks to be run."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["Request"]


@dataclass(frozen=True)
class Request:
    """What to run; an empty tuple or None leaves the choice to the profile.

    Parameters
    ----------
    profile : str
        ``smoke``, ``quick`` or ``paper``.
    tasks, models, cases, metrics : tuple of str
        Names. A model is an entrant's label or, where a task has no such label, the model of all
        entrants that have it; a case is what ``matching_cases`` finds.
    folds : int or None
        How many folds of each case.
    seed : int
        The root seed.
    """

    profile: str = "quick"
    tasks: tuple[str, ...] = ()
    models: tuple[str, ...] = ()
    cases: tuple[str, ...] = ()
    metrics: tuple[str, ...] = ()
    folds: int | None = None
    seed: int = 0
