"""Checks of estimators' parameters, with messages that say what was expected and what was given."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from numbers import Integral, Real
from typing import TypeGuard

import numpy as np
from numpy.typing import ArrayLike

from mocapbench.basics.numbers import real_numbers
from mocapbench.datasets import Frames

__all__ = [
    "check_choice",
    "check_count",
    "check_flag",
    "check_jobs",
    "check_not_negative",
    "check_positive",
    "check_sampling",
    "check_seed",
    "check_share",
    "check_times",
    "components_of",
]


def check_count(name: str, value: object, least: int) -> None:
    """Raise ValueError unless ``value`` is an integer of at least ``least``."""
    if not _is_integer(value) or value < least:
        raise ValueError(f"expected {name} to be an integer of at least {least}, got {value!r}")


def check_positive(name: str, value: object) -> None:
    """Raise ValueError unless ``value`` is a finite positive number."""
    if not _is_number(value) or not 0.0 < float(value) < np.inf:
        raise ValueError(f"expected {name} to be a finite positive number, got {value!r}")


def check_not_negative(name: str, value: object) -> None:
    """Raise ValueError unless ``value`` is a finite number of at least 0."""
    if not _is_number(value) or not 0.0 <= float(value) < np.inf:
        raise ValueError(f"expected {name} to be a finite number of at least 0, got {value!r}")


def check_share(name: str, value: object) -> None:
    """Raise ValueError unless ``value`` is a number from 0 to 1."""
    if not _is_number(value) or not 0.0 <= float(value) <= 1.0:
        raise ValueError(f"expected {name} to be a number from 0 to 1, got {value!r}")


def check_flag(name: str, value: object) -> None:
    """Raise ValueError unless ``value`` is True or False."""
    if not isinstance(value, bool | np.bool_):
        raise ValueError(f"expected {name} to be True or False, got {value!r}")


def check_seed(name: str, value: object) -> None:
    """Raise ValueError unless ``value`` seeds a `numpy.random.Generator`, is one, or is None."""
    if value is None or isinstance(value, np.random.Generator):
        return
    if not _is_integer(value) or value < 0:
        raise ValueError(
            f"expected {name} to be None, an integer of at least 0 or a numpy.random.Generator, "
            f"got {value!r}"
        )


def check_times(times: ArrayLike, *, increasing: bool = False) -> Frames:
    """Return times as an array (N,) of floats.

    Raises
    ------
    ValueError
        If there is none, they are not finite numbers, or do not increase where they should.
    """
    checked = real_numbers("times", times)
    if checked.ndim != 1 or not checked.size:
        raise ValueError(f"expected one or more times of shape (N,), got shape {checked.shape}")
    if not np.isfinite(checked).all():
        raise ValueError("expected finite times, got NaN or infinity")
    falls = np.flatnonzero(np.diff(checked) <= 0)
    if increasing and falls.size:
        before, after = checked[falls[0]], checked[falls[0] + 1]
        raise ValueError(f"expected increasing times, got {after} after {before}; sort them")
    return checked


def check_sampling(
    times: ArrayLike, n_samples: object, random_state: object, *, increasing: bool = True
) -> Frames:
    """Return the times (N,) of samples to draw, after checking their number and seed too.

    Raises
    ------
    ValueError
        If one of them is invalid; see `check_times`.
    """
    check_count("n_samples", n_samples, 1)
    check_seed("random_state", random_state)
    return check_times(times, increasing=increasing)


def check_jobs(value: object) -> None:
    """Raise ValueError unless ``value`` is None or an integer other than 0."""
    if value is not None and (not _is_integer(value) or value == 0):
        raise ValueError(
            "expected n_jobs to be None, a positive integer, or a negative one that counts down "
            f"from all processors at -1, got {value!r}"
        )


def check_choice(name: str, value: object, choices: Collection[str]) -> None:
    """Raise ValueError unless ``value`` is one of ``choices``."""
    if not isinstance(value, str) or value not in choices:
        raise ValueError(f"expected {name} to be one of {sorted(choices)}, got {value!r}")


def components_of(
    n_components: int | Mapping[str, int], layers: Sequence[str]
) -> Mapping[str, int]:
    """Return the number of components of each layer; a single number is that of every layer.

    Raises
    ------
    ValueError
        If a layer is missing or unknown, or a number is not a positive integer.
    """
    by_layer = (
        n_components if isinstance(n_components, Mapping) else dict.fromkeys(layers, n_components)
    )
    if set(by_layer) != set(layers):
        raise ValueError(
            f"expected n_components to be an integer or a mapping with a number for each of the "
            f"layers {sorted(layers)}, got {n_components!r}"
        )
    for layer in layers:
        check_count(f"n_components of {layer!r}", by_layer[layer], 1)
    return {layer: by_layer[layer] for layer in layers}


def _is_integer(value: object) -> TypeGuard[Integral]:
    """Return whether ``value`` is an integer other than True and False."""
    return isinstance(value, Integral) and not isinstance(value, bool)


def _is_number(value: object) -> TypeGuard[Real]:
    """Return whether ``value`` is a real number other than True and False."""
    return isinstance(value, Real) and not isinstance(value, bool)
