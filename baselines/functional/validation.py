"""Checks of the parameters of the functional models."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

from mocapbench.baselines.common.validation import check_count, check_positive, check_seed

__all__ = ["check_settings"]

_CHECKS: dict[str, Callable[[str, object], None]] = {
    **dict.fromkeys(
        ("n_styles", "n_harmonics", "n_restarts", "max_iter"), partial(check_count, least=1)
    ),
    "n_components": partial(check_count, least=0),
    **dict.fromkeys(("smoothness", "tol"), check_positive),
    "random_state": check_seed,
}


def check_settings(**parameters: Any) -> None:
    """Check the parameters of an estimator, which have the names of those of `KFAM`.

    Raises
    ------
    ValueError
        If one is of the wrong type or out of range.
    """
    for name, value in parameters.items():
        _CHECKS[name](name, value)
