"""Checks of the parameters of models of cyclic motion, which have the same names in all of them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

from mocapbench.baselines.common.validation import (
    check_count,
    check_flag,
    check_positive,
    check_seed,
)

__all__ = ["check_settings"]

_CHECKS: Mapping[str, Callable[[str, object], None]] = {
    **dict.fromkeys(
        ("n_styles", "n_frames", "n_harmonics", "max_jump", "n_restarts", "max_iter", "n_inner"),
        partial(check_count, least=1),
    ),
    **dict.fromkeys(("n_components", "refine_iter"), partial(check_count, least=0)),
    **dict.fromkeys(("regularisation", "closeness", "smoothness", "tol"), check_positive),
    "learn_closeness": check_flag,
    "random_state": check_seed,
}


def check_settings(parameters: Mapping[str, Any]) -> None:
    """Check those parameters of a model that are numbers, flags or seeds.

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
