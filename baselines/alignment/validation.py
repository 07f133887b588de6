"""Checks of the parameters of the models of cyclic motion."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

from mocapbench.baselines.alignment.priors import PRIORS
from mocapbench.baselines.alignment.start import GROUPINGS
from mocapbench.baselines.common.validation import (
    check_choice,
    check_count,
    check_flag,
    check_positive,
    check_seed,
)

__all__ = ["check_settings"]

_CHECKS: dict[str, Callable[[str, object], None]] = {
    **dict.fromkeys(
        ("n_styles", "n_frames", "max_jump", "n_restarts", "max_iter", "n_inner"),
        partial(check_count, least=1),
    ),
    "refine_iter": partial(check_count, least=0),
    **dict.fromkeys(("regularisation", "closeness", "smoothness", "tol"), check_positive),
    "learn_closeness": check_flag,
    "prior": partial(check_choice, choices=PRIORS),
    "grouping": partial(check_choice, choices=GROUPINGS),
    "random_state": check_seed,
}


def check_settings(**parameters: Any) -> None:
    """Check the parameters of an estimator, which have the names of `CyclicAlignment` or `KMeans`.

    Raises
    ------
    ValueError
        If one is of the wrong type or out of range.
    """
    for name, check in _CHECKS.items():
        if name in parameters:
            check(name, parameters[name])
    if parameters.get("n_states") is not None:
        least = max(3, 2 * parameters["max_jump"] + 1)
        check_count("n_states (more than twice max_jump)", parameters["n_states"], least)
