"""Parameters as `CyclicAlignment` takes them, checked."""

from __future__ import annotations

from typing import Any

from mocapbench.baselines.alignment.priors import PRIORS

__all__ = ["check_settings"]

_COUNTS = {
    "n_styles": 1,
    "max_jump": 1,
    "n_restarts": 1,
    "max_iter": 1,
    "n_inner": 1,
    "refine_iter": 0,
}
_POSITIVE = ("regularisation", "closeness", "smoothness")


def check_settings(**parameters: Any) -> None:
    """Check the parameters of `CyclicAlignment`, as far as they are given.

    Raises
    ------
    ValueError
        If one is out of range.
    """
    for name in _COUNTS.keys() & parameters:
        if parameters[name] < _COUNTS[name]:
            raise ValueError(f"expected {name} >= {_COUNTS[name]}, got {parameters[name]}")
    for name in set(_POSITIVE) & parameters.keys():
        if not parameters[name] > 0:
            raise ValueError(f"expected {name} > 0, got {parameters[name]}")
    n_states, least = parameters["n_states"], max(3, 2 * parameters["max_jump"] + 1)
    if n_states is not None and n_states < least:
        raise ValueError(
            f"expected n_states >= {least}, so that a jump goes less than half the way round, got "
            f"{n_states}: raise n_states or lower max_jump"
        )
    if parameters.get("prior", "paper") not in PRIORS:
        raise ValueError(f"expected prior in {sorted(PRIORS)}, got {parameters['prior']!r}")
